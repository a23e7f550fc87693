//! The tree that all figures share: 18 segments, 17 joints, 39 joint DOFs, in depth-first order (each subtree is
//! contiguous).
//!
//! Joint `i` joins segment `i` to its parent and carries the segment's name. A 3-DOF joint is a ball joint: its rate is
//! the angular velocity of the child relative to the parent along the *signed child axes* listed here; 1- and 2-DOF
//! joints are hinges in series. Angles are anatomically signed (flexion, abduction, internal rotation positive on both
//! sides): the sign is carried by the axis. The tree is a constant so that kernels unroll it.

use serde::{Deserialize, Serialize};

/// Segments, pelvis first.
pub const SEGMENT_COUNT: usize = 18;
/// Joint degrees of freedom.
pub const DOF_COUNT: usize = 39;
/// Velocity components: pelvis twist (angular, linear; world axes) and the joint rates.
pub const NV: usize = 6 + DOF_COUNT;
/// Ball joints: waist, thorax, neck, shoulders, hips, ankles.
pub const BALL_COUNT: usize = 9;
/// Hinge angles: elbows 2, wrists 2, knees 1, toes 1 on each side.
pub const HINGE_COUNT: usize = 12;

/// One of the 18 segments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "u8")]
pub struct SegmentId(u8);

impl TryFrom<u8> for SegmentId {
    type Error = &'static str;

    fn try_from(index: u8) -> Result<Self, Self::Error> {
        Self::new(index.into()).ok_or("no such segment")
    }
}

impl SegmentId {
    /// All segments, in order.
    pub fn all() -> impl Iterator<Item = Self> + Clone {
        (0..SEGMENT_COUNT as u8).map(Self)
    }

    /// Segment by index 0…17; `None` beyond.
    pub const fn new(index: usize) -> Option<Self> {
        if index < SEGMENT_COUNT {
            Some(Self(index as u8))
        } else {
            None
        }
    }
    /// Segment by its name, for example `r_hand`.
    pub fn from_name(name: &str) -> Option<Self> {
        SEGMENT_NAMES
            .iter()
            .position(|n| *n == name)
            .and_then(Self::new)
    }
    /// Index 0…17.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
    /// Name, for example `r_hand`.
    pub const fn name(self) -> &'static str {
        SEGMENT_NAMES[self.0 as usize]
    }
}

#[allow(missing_docs)]
mod ids {
    use super::SegmentId;
    pub const PELVIS: SegmentId = SegmentId(0);
    pub const ABDOMEN: SegmentId = SegmentId(1);
    pub const CHEST: SegmentId = SegmentId(2);
    pub const HEAD: SegmentId = SegmentId(3);
    pub const L_UPPER_ARM: SegmentId = SegmentId(4);
    pub const L_FOREARM: SegmentId = SegmentId(5);
    pub const L_HAND: SegmentId = SegmentId(6);
    pub const R_UPPER_ARM: SegmentId = SegmentId(7);
    pub const R_FOREARM: SegmentId = SegmentId(8);
    pub const R_HAND: SegmentId = SegmentId(9);
    pub const L_THIGH: SegmentId = SegmentId(10);
    pub const L_SHANK: SegmentId = SegmentId(11);
    pub const L_FOOT: SegmentId = SegmentId(12);
    pub const L_TOES: SegmentId = SegmentId(13);
    pub const R_THIGH: SegmentId = SegmentId(14);
    pub const R_SHANK: SegmentId = SegmentId(15);
    pub const R_FOOT: SegmentId = SegmentId(16);
    pub const R_TOES: SegmentId = SegmentId(17);
}
pub use ids::*;

/// Sign of the body's y axis towards a side: 1 for the left side (0), −1 for the right side (1).
pub const fn outward(side: usize) -> f64 {
    if side == 0 { 1.0 } else { -1.0 }
}

/// Left and right thigh.
pub const THIGHS: [SegmentId; 2] = [L_THIGH, R_THIGH];
/// Left and right shank.
pub const SHANKS: [SegmentId; 2] = [L_SHANK, R_SHANK];
/// Left and right foot.
pub const FEET: [SegmentId; 2] = [L_FOOT, R_FOOT];
/// Left and right toes.
pub const TOES: [SegmentId; 2] = [L_TOES, R_TOES];
/// Left and right hand.
pub const HANDS: [SegmentId; 2] = [L_HAND, R_HAND];

/// Segment names, in segment order.
pub const SEGMENT_NAMES: [&str; SEGMENT_COUNT] = [
    "pelvis",
    "abdomen",
    "chest",
    "head",
    "l_upper_arm",
    "l_forearm",
    "l_hand",
    "r_upper_arm",
    "r_forearm",
    "r_hand",
    "l_thigh",
    "l_shank",
    "l_foot",
    "l_toes",
    "r_thigh",
    "r_shank",
    "r_foot",
    "r_toes",
];

/// Canonical bone names on the wire (VRM humanoid), in segment order.
pub const BONE_NAMES: [&str; SEGMENT_COUNT] = [
    "hips",
    "spine",
    "chest",
    "head",
    "leftUpperArm",
    "leftLowerArm",
    "leftHand",
    "rightUpperArm",
    "rightLowerArm",
    "rightHand",
    "leftUpperLeg",
    "leftLowerLeg",
    "leftFoot",
    "leftToes",
    "rightUpperLeg",
    "rightLowerLeg",
    "rightFoot",
    "rightToes",
];

/// Joint names, in segment order (entry 0 is the free root joint).
pub const JOINT_NAMES: [&str; SEGMENT_COUNT] = [
    "root",
    "waist",
    "thorax",
    "neck",
    "l_shoulder",
    "l_elbow",
    "l_wrist",
    "r_shoulder",
    "r_elbow",
    "r_wrist",
    "l_hip",
    "l_knee",
    "l_ankle",
    "l_toe",
    "r_hip",
    "r_knee",
    "r_ankle",
    "r_toe",
];

/// Parent segment of each segment; the pelvis is its own.
pub const PARENT: [usize; SEGMENT_COUNT] =
    [0, 0, 1, 2, 2, 4, 5, 2, 7, 8, 0, 10, 11, 12, 0, 14, 15, 16];

/// The kind of a joint, and the place of its positions and rates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joint {
    /// The free pelvis.
    Free,
    /// Ball joint: index of its quaternion.
    Ball(usize),
    /// Two hinges in series: index of the first angle.
    Hinge2(usize),
    /// One hinge: index of its angle.
    Hinge1(usize),
}

/// Joint kinds, in segment order.
pub const JOINT: [Joint; SEGMENT_COUNT] = [
    Joint::Free,
    Joint::Ball(0),
    Joint::Ball(1),
    Joint::Ball(2),
    Joint::Ball(3),
    Joint::Hinge2(0),
    Joint::Hinge2(2),
    Joint::Ball(4),
    Joint::Hinge2(4),
    Joint::Hinge2(6),
    Joint::Ball(5),
    Joint::Hinge1(8),
    Joint::Ball(6),
    Joint::Hinge1(9),
    Joint::Ball(7),
    Joint::Hinge1(10),
    Joint::Ball(8),
    Joint::Hinge1(11),
];

/// First joint DOF (0…38) of each segment's joint; 0 for the pelvis, which has none.
pub const DOF_START: [usize; SEGMENT_COUNT] = [
    0, 0, 3, 6, 9, 12, 14, 16, 19, 21, 23, 26, 27, 30, 31, 34, 35, 38,
];
/// Number of joint DOFs of each segment's joint.
pub const DOF_LEN: [usize; SEGMENT_COUNT] = [0, 3, 3, 3, 3, 2, 2, 3, 2, 2, 3, 1, 3, 1, 3, 1, 3, 1];

/// A signed coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SignedAxis {
    /// 0 = x, 1 = y, 2 = z.
    pub axis: usize,
    /// +1 or −1.
    pub sign: i8,
}

impl SignedAxis {
    /// The unit vector.
    pub const fn vector(self) -> [f64; 3] {
        let mut v = [0.0; 3];
        v[self.axis] = self.sign as f64;
        v
    }
}

const fn ax(axis: usize, sign: i8) -> SignedAxis {
    SignedAxis { axis, sign }
}

/// Axis of each joint DOF: child axes for ball joints; for hinges the axis in the frame before that hinge turns.
pub const DOF_AXIS: [SignedAxis; DOF_COUNT] = [
    // waist, thorax, neck: bend forward +y, roll +x, turn left +z
    ax(1, 1),
    ax(0, 1),
    ax(2, 1),
    ax(1, 1),
    ax(0, 1),
    ax(2, 1),
    ax(1, 1),
    ax(0, 1),
    ax(2, 1),
    // left arm: shoulder flexion −y, abduction +x, internal rotation −z; elbow flexion −y, pronation −z; wrist flexion
    // −x, radial deviation −y
    ax(1, -1),
    ax(0, 1),
    ax(2, -1),
    ax(1, -1),
    ax(2, -1),
    ax(0, -1),
    ax(1, -1),
    // right arm: mirrored
    ax(1, -1),
    ax(0, -1),
    ax(2, 1),
    ax(1, -1),
    ax(2, 1),
    ax(0, 1),
    ax(1, -1),
    // left leg: hip flexion −y, abduction +x, internal rotation −z; knee +y; ankle dorsiflexion −y, roll outward +x,
    // internal rotation −z; toe −y
    ax(1, -1),
    ax(0, 1),
    ax(2, -1),
    ax(1, 1),
    ax(1, -1),
    ax(0, 1),
    ax(2, -1),
    ax(1, -1),
    // right leg: mirrored
    ax(1, -1),
    ax(0, -1),
    ax(2, 1),
    ax(1, 1),
    ax(1, -1),
    ax(0, -1),
    ax(2, 1),
    ax(1, -1),
];

/// Joint DOF names, in DOF order.
pub const DOF_NAMES: [&str; DOF_COUNT] = [
    "waist_flexion",
    "waist_lateral",
    "waist_rotation",
    "thorax_flexion",
    "thorax_lateral",
    "thorax_rotation",
    "neck_flexion",
    "neck_lateral",
    "neck_rotation",
    "l_shoulder_flexion",
    "l_shoulder_abduction",
    "l_shoulder_rotation",
    "l_elbow_flexion",
    "l_elbow_pronation",
    "l_wrist_flexion",
    "l_wrist_deviation",
    "r_shoulder_flexion",
    "r_shoulder_abduction",
    "r_shoulder_rotation",
    "r_elbow_flexion",
    "r_elbow_pronation",
    "r_wrist_flexion",
    "r_wrist_deviation",
    "l_hip_flexion",
    "l_hip_abduction",
    "l_hip_rotation",
    "l_knee_flexion",
    "l_ankle_flexion",
    "l_ankle_inversion",
    "l_ankle_rotation",
    "l_toe_extension",
    "r_hip_flexion",
    "r_hip_abduction",
    "r_hip_rotation",
    "r_knee_flexion",
    "r_ankle_flexion",
    "r_ankle_inversion",
    "r_ankle_rotation",
    "r_toe_extension",
];

/// Segment whose joint owns each joint DOF.
pub const DOF_SEGMENT: [usize; DOF_COUNT] = {
    let mut out = [0; DOF_COUNT];
    let mut s = 1;
    while s < SEGMENT_COUNT {
        let mut k = 0;
        while k < DOF_LEN[s] {
            out[DOF_START[s] + k] = s;
            k += 1;
        }
        s += 1;
    }
    out
};

/// Whether `ancestor` lies on the path from `segment` to the pelvis (a segment is its own ancestor).
pub const IS_ANCESTOR: [[bool; SEGMENT_COUNT]; SEGMENT_COUNT] = {
    let mut out = [[false; SEGMENT_COUNT]; SEGMENT_COUNT]; // [segment][ancestor]
    let mut s = 0;
    while s < SEGMENT_COUNT {
        let mut a = s;
        loop {
            out[s][a] = true;
            if a == 0 {
                break;
            }
            a = PARENT[a];
        }
        s += 1;
    }
    out
};

/// For every velocity component, the component before it on the path to the root; `usize::MAX` for the first. The
/// pattern of the inertia matrix and of its factor: entry (i, j), j < i, is nonzero only if j is reached from i.
pub const VELOCITY_PARENT: [usize; NV] = {
    let mut out = [usize::MAX; NV];
    let mut i = 1;
    while i < 6 {
        out[i] = i - 1;
        i += 1;
    }
    let mut s = 1;
    while s < SEGMENT_COUNT {
        let p = PARENT[s];
        let last = if p == 0 {
            5
        } else {
            6 + DOF_START[p] + DOF_LEN[p] - 1
        };
        out[6 + DOF_START[s]] = last;
        let mut k = 1;
        while k < DOF_LEN[s] {
            out[6 + DOF_START[s] + k] = 6 + DOF_START[s] + k - 1;
            k += 1;
        }
        s += 1;
    }
    out
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tree_is_depth_first_and_counts_add_up() {
        assert_eq!(DOF_LEN.iter().sum::<usize>(), DOF_COUNT);
        let mut next = 0;
        for s in 1..SEGMENT_COUNT {
            assert_eq!(
                DOF_START[s], next,
                "DOFs of {} are contiguous",
                SEGMENT_NAMES[s]
            );
            next += DOF_LEN[s];
            assert!(PARENT[s] < s);
            // Depth first: the parent is the previous segment or one of its ancestors.
            assert!(
                IS_ANCESTOR[s - 1][PARENT[s]],
                "{} breaks depth-first order",
                SEGMENT_NAMES[s]
            );
        }
        let pairs: usize = (0..NV)
            .map(|i| {
                std::iter::successors(Some(i), |j| {
                    Some(VELOCITY_PARENT[*j]).filter(|p| *p != usize::MAX)
                })
                .count()
            })
            .sum();
        assert_eq!(pairs, 512, "structural nonzeros of the lower triangle");
    }
}
