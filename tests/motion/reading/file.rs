//! Motions of the body written as BVH files of any kind, and read back.

use sinew_physics::body::topology::SEGMENT_COUNT;
use sinew_physics::body::topology::{
    BONE_NAMES, DOF_START, L_FOOT, L_TOES, PARENT, R_FOOT, R_TOES,
};
use sinew_physics::body::{Body, Posture, angles};
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::motion::builtin::builtin;
use sinew_physics::motion::leg_ik::forward;
use sinew_physics::motion::{Bvh, Clip};
use sinew_physics::plan::PreparedRecording;
use sinew_physics::plan::foot_lock::Sole;
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::Preparation;
use sinew_physics::reference::RetargetOptions;
use std::fmt::Write;

/// Samples per second of the built-in motions.
pub const RATE: f64 = 120.0;

/// A BVH file in parts. A row has three position channels, unless they are taken out, then Z, X and Y rotation of each
/// segment.
#[derive(Clone)]
pub struct File {
    pub head: String,
    pub rows: Vec<Vec<f64>>,
    pub rate: f64,
}

/// World axes (x forward, y left, z up) to file axes (x left, y up, z forward).
fn to_file(v: Vec3) -> Vec3 {
    Vec3 {
        x: v.y,
        y: v.z,
        z: v.x,
    }
}

/// Angles in degrees with `q = Rz Rx Ry`, `q` in world axes.
fn zxy(q: Quat) -> [f64; 3] {
    let axis = to_file(Vec3 {
        x: q.x,
        y: q.y,
        z: q.z,
    });
    let m = Quat {
        x: axis.x,
        y: axis.y,
        z: axis.z,
        w: q.w,
    }
    .to_mat3();
    let x = m.y.z.atan2(m.x.z.hypot(m.z.z));
    [(-m.y.x).atan2(m.y.y), x, (-m.x.z).atan2(m.z.z)].map(f64::to_degrees)
}

fn offset(text: &mut String, v: Vec3) {
    let v = to_file(v) * 100.0;
    writeln!(text, "OFFSET {:.6} {:.6} {:.6}", v.x, v.y, v.z).unwrap();
}

impl File {
    /// `postures` of `body` in centimetres, y up.
    pub fn new(body: &Body, postures: &[Posture]) -> Self {
        Self::with_axes(body, postures, &[Quat::identity(); SEGMENT_COUNT])
    }

    /// [`Self::new`] with other bone axes: `axes` are `segment_from_bone`, so the zero pose of the file differs.
    pub fn with_axes(body: &Body, postures: &[Posture], axes: &[Quat; SEGMENT_COUNT]) -> Self {
        let mut head = String::from("HIERARCHY\n");
        let mut open: Vec<usize> = Vec::new();
        for s in 0..=SEGMENT_COUNT {
            while open
                .last()
                .is_some_and(|top| s == SEGMENT_COUNT || s > 0 && *top != PARENT[s])
            {
                let top = open.pop().unwrap();
                if top + 1 == s {
                    head += "End Site\n{\n";
                    offset(
                        &mut head,
                        axes[top].conjugate().rotate(body.segments[top].tip),
                    );
                    head += "}\n";
                }
                head += "}\n";
            }
            if s == SEGMENT_COUNT {
                break;
            }
            let (kind, channels) = if s == 0 {
                ("ROOT", "6 Xposition Yposition Zposition")
            } else {
                ("JOINT", "3")
            };
            writeln!(head, "{kind} {}\n{{", BONE_NAMES[s]).unwrap();
            let from_parent = if s == 0 {
                Vec3::zero()
            } else {
                axes[PARENT[s]].conjugate().rotate(body.joint_offset[s])
            };
            offset(&mut head, from_parent);
            writeln!(head, "CHANNELS {channels} Zrotation Xrotation Yrotation").unwrap();
            open.push(s);
        }
        let row = |posture: &Posture| {
            let poses = forward(body, posture);
            let root = to_file(posture.root_position) * 100.0;
            let mut row = vec![root.x, root.y, root.z];
            for s in 0..SEGMENT_COUNT {
                let bone = poses[s].1 * axes[s];
                let local = if s == 0 {
                    bone
                } else {
                    (poses[PARENT[s]].1 * axes[PARENT[s]]).conjugate() * bone
                };
                row.extend(zxy(local));
            }
            row
        };
        Self {
            head,
            rows: postures.iter().map(row).collect(),
            rate: RATE,
        }
    }

    pub fn text(&self) -> String {
        let mut text = format!(
            "{}MOTION\nFrames: {}\nFrame Time: {:.10}\n",
            self.head,
            self.rows.len(),
            1.0 / self.rate
        );
        for row in &self.rows {
            let words: Vec<String> = row.iter().map(|x| format!("{x:.7}")).collect();
            writeln!(text, "{}", words.join(" ")).unwrap();
        }
        text
    }

    /// A pose in which all rotations are 0 and the root is at its place in the first frame.
    pub fn rest_row(&self) -> Vec<f64> {
        let mut row = vec![0.0; self.rows[0].len()];
        row[..3].copy_from_slice(&self.rows[0][..3]);
        row
    }

    /// Removes the position channels of the root.
    pub fn without_positions(mut self) -> Self {
        self.head = self.head.replace("6 Xposition Yposition Zposition", "3");
        self.rows.iter_mut().for_each(|r| {
            r.drain(..3);
        });
        self
    }

    pub fn read(&self, body: &Body, options: &RetargetOptions) -> PreparedRecording {
        let bvh = Bvh::parse(self.text().as_bytes()).unwrap();
        prepare_recording(&bvh.recording().unwrap(), body, options).unwrap()
    }
}

/// A rotation that takes the file's forward axis, world x, to the bone of each segment: all bones lie along one axis in
/// the zero pose.
pub fn bones_along_one_axis(body: &Body) -> [Quat; SEGMENT_COUNT] {
    std::array::from_fn(|s| {
        if s == 0 {
            return Quat::identity();
        }
        let child = (s + 1..SEGMENT_COUNT).find(|c| PARENT[*c] == s);
        let bone = child.map_or(body.segments[s].tip, |c| body.joint_offset[c]);
        let bone = bone.normalized_or(Vec3::Z);
        let axis = Vec3::X.cross(bone);
        let angle = axis.norm().atan2(bone.x);
        Quat::exp(axis.normalized_or(Vec3::Y) * angle)
    })
}

/// Postures of a built-in motion.
pub fn motion(body: &Body, name: &str) -> Vec<Posture> {
    let clip = builtin(body, name).unwrap();
    (0..clip.len()).map(|i| *clip.posture(i)).collect()
}

/// The whole figure turned by `turn` about the origin.
pub fn turned(postures: &[Posture], turn: Quat) -> Vec<Posture> {
    let of = |p: &Posture| Posture {
        root_position: turn.rotate(p.root_position),
        root_rotation: (turn * p.root_rotation).normalized(),
        ..*p
    };
    postures.iter().map(of).collect()
}

/// Options that keep only the recording itself: no steps before or after it.
pub fn bare() -> RetargetOptions {
    RetargetOptions {
        preparation: Preparation {
            ends: false,
            ..Preparation::default()
        },
        ..RetargetOptions::default()
    }
}

/// Lowest point of each sole, m.
pub fn soles(body: &Body, posture: &Posture) -> [f64; 2] {
    let poses = forward(body, posture);
    let angles = angles::anatomical_angles(posture);
    [(L_FOOT, L_TOES, 0), (R_FOOT, R_TOES, 1)].map(|(foot, toes, side)| {
        let (ankle, rotation) = poses[foot.index()];
        let toe = angles[DOF_START[toes.index()]];
        ankle.z + Sole::new(body, side).lowest(rotation, toe)
    })
}

/// The lower sole of each sample, m.
pub fn lower_soles(body: &Body, clip: &Clip) -> Vec<f64> {
    (0..clip.len())
        .map(|i| soles(body, clip.posture(i)))
        .map(|[l, r]| l.min(r))
        .collect()
}

pub fn range(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    values
        .into_iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| {
            (l.min(v), h.max(v))
        })
}
