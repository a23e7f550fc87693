//! The actor: a skeleton with its own proportions and mass table, forward kinematics, and the inverse kinematics of its
//! legs.
//!
//! World: x forward, y left, z up, metres. A segment's frame sits at its proximal joint; in the zero pose (upright,
//! arms hanging, palms to the thighs) all frames are parallel to the world. Angles follow docs/notation.md of this
//! repository, restated here independently of the code: a ball joint is swing · twist about the segment's z; signs
//! are carried by the axes.

use super::tracks::v3;
use sinew_physics::math::{Mat3, Quat, Vec3, trig};

/// Segments: order of docs/model.md.
pub const SEGMENTS: [&str; 18] = [
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
/// Angle names, in the order of [`Pose::angles`].
pub const ANGLES: [&str; 39] = [
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
pub const PELVIS: usize = 0;
pub const ABDOMEN: usize = 1;
pub const CHEST: usize = 2;
pub const HEAD: usize = 3;
/// First segment of each arm (left, right).
pub const ARM: [usize; 2] = [4, 7];
/// First segment of each leg.
pub const LEG: [usize; 2] = [10, 14];
/// First angle of each arm and leg.
const ARM_ANGLE: [usize; 2] = [9, 16];
const LEG_ANGLE: [usize; 2] = [23, 31];

/// Proportions, m.
#[derive(Clone, Debug)]
pub struct Actor {
    pub name: &'static str,
    /// Half the distance of the hip centres.
    pub hip: f64,
    /// Waist joint above the middle of the hips.
    pub waist: Vec3,
    /// Thorax joint above the waist.
    pub thorax: Vec3,
    /// Neck joint above the thorax joint.
    pub neck: Vec3,
    /// Skull joint above the neck joint.
    pub skull: Vec3,
    /// Top of the head above the skull joint.
    pub top: Vec3,
    /// Left clavicle joint from the thorax joint.
    pub clavicle: Vec3,
    /// Left shoulder joint from the thorax joint.
    pub shoulder: Vec3,
    pub upper_arm: f64,
    pub forearm: f64,
    pub hand: f64,
    pub thigh: f64,
    pub shank: f64,
    /// Ankle over the sole.
    pub ankle: f64,
    /// Back of the heel behind the ankle.
    pub heel: f64,
    /// Toe joint ahead of the ankle.
    pub ball: f64,
    /// Toe joint over the sole.
    pub ball_height: f64,
    /// Toe joint to toe tip.
    pub toe: f64,
}

/// Shares of the body's mass (Winter, Biomechanics and Motor Control of Human Movement, table of segments), in
/// segment order; the toes belong to the foot.
pub const MASS_SHARE: [f64; 18] = [
    0.142, 0.139, 0.216, 0.081, 0.028, 0.016, 0.006, 0.028, 0.016, 0.006, 0.100, 0.0465, 0.0135,
    0.001, 0.100, 0.0465, 0.0135, 0.001,
];

impl Actor {
    /// An adult of 1.78 m with longer shanks and a shorter trunk than the simulator's body.
    pub fn medium() -> Self {
        Self {
            name: "medium",
            hip: 0.092,
            waist: v3(-0.01, 0.0, 0.112),
            thorax: v3(-0.005, 0.0, 0.165),
            neck: v3(0.0, 0.0, 0.265),
            skull: v3(0.015, 0.0, 0.085),
            top: v3(0.015, 0.0, 0.185),
            clavicle: v3(0.0, 0.03, 0.225),
            shoulder: v3(-0.005, 0.178, 0.205),
            upper_arm: 0.292,
            forearm: 0.262,
            hand: 0.185,
            thigh: 0.428,
            shank: 0.431,
            ankle: 0.082,
            heel: 0.058,
            ball: 0.132,
            ball_height: 0.022,
            toe: 0.068,
        }
    }

    fn scaled(&self, name: &'static str, trunk: f64, arm: f64, leg: f64, head: f64) -> Self {
        Self {
            name,
            hip: self.hip * trunk,
            waist: self.waist * trunk,
            thorax: self.thorax * trunk,
            neck: self.neck * trunk,
            skull: self.skull * head,
            top: self.top * head,
            clavicle: self.clavicle * trunk,
            shoulder: self.shoulder * trunk,
            upper_arm: self.upper_arm * arm,
            forearm: self.forearm * arm,
            hand: self.hand * arm,
            thigh: self.thigh * leg,
            shank: self.shank * leg,
            ankle: self.ankle * leg,
            heel: self.heel * leg,
            ball: self.ball * leg,
            ball_height: self.ball_height * leg,
            toe: self.toe * leg,
        }
    }

    /// 1.95 m, long legs.
    pub fn tall() -> Self {
        Self::medium().scaled("tall", 1.06, 1.11, 1.14, 1.03)
    }

    /// 1.55 m, short legs.
    pub fn short() -> Self {
        Self::medium().scaled("short", 0.92, 0.86, 0.83, 0.97)
    }

    /// 1.40 m with the proportions of a child of ten: large head, short legs, narrow shoulders.
    pub fn child() -> Self {
        Self::medium().scaled("child", 0.78, 0.75, 0.77, 0.92)
    }

    /// Length of the straight leg from hip to ankle.
    pub fn leg(&self) -> f64 {
        self.thigh + self.shank
    }

    /// Stature, standing straight.
    pub fn stature(&self) -> f64 {
        self.ankle
            + self.leg()
            + self.waist.z
            + self.thorax.z
            + self.neck.z
            + self.skull.z
            + self.top.z
    }

    /// Segment lengths by name, for the truth.
    pub fn lengths(&self) -> Vec<(&'static str, f64)> {
        vec![
            ("stature", self.stature()),
            ("hip_half_width", self.hip),
            ("thigh", self.thigh),
            ("shank", self.shank),
            ("ankle_height", self.ankle),
            ("heel_behind_ankle", self.heel),
            ("toe_joint_ahead_of_ankle", self.ball),
            ("toes", self.toe),
            ("pelvis", self.waist.norm()),
            ("abdomen", self.thorax.norm()),
            ("chest", self.neck.norm()),
            ("neck", self.skull.norm()),
            ("head", self.top.norm()),
            ("shoulder_half_width", self.shoulder.y),
            ("upper_arm", self.upper_arm),
            ("forearm", self.forearm),
            ("hand", self.hand),
        ]
    }
}

/// Angles of trunk, head and arms, rad.
#[derive(Clone, Copy, Debug, Default)]
pub struct Upper {
    /// Pelvis: forward tilt, list (right side down positive), turn to the left.
    pub pelvis: [f64; 3],
    pub waist: [f64; 3],
    pub thorax: [f64; 3],
    pub neck: [f64; 3],
    /// Flexion, abduction, internal rotation.
    pub shoulder: [[f64; 3]; 2],
    /// Flexion, pronation.
    pub elbow: [[f64; 2]; 2],
    /// Flexion, radial deviation.
    pub wrist: [[f64; 2]; 2],
}

/// Pose of one foot in the world.
#[derive(Clone, Copy, Debug)]
pub struct FootPose {
    /// Ankle.
    pub ankle: Vec3,
    pub yaw: f64,
    /// Toes up positive.
    pub pitch: f64,
    /// Toe extension.
    pub toe: f64,
}

/// The actor in one instant.
#[derive(Clone, Debug)]
pub struct Pose {
    /// World frame of every segment.
    pub turn: [Quat; 18],
    /// World position of every segment's proximal joint; the pelvis: middle of the hips.
    pub place: [Vec3; 18],
    /// Half-way frame between chest and head, which the neck follows.
    pub neck: Quat,
    /// Upper arm frame turned by the elbow's flexion alone, left and right.
    pub bend: [Quat; 2],
    /// Skull joint.
    pub skull: Vec3,
    /// Top of the head.
    pub top: Vec3,
    /// Finger tips and toe tips, left and right.
    pub fingers: [Vec3; 2],
    pub tips: [Vec3; 2],
    /// 39 anatomical angles, rad.
    pub angles: [f64; 39],
    /// Length that each leg lacks to reach its foot, m (0 unless the motion is authored wrongly).
    pub short: [f64; 2],
}

fn about(axis: usize, angle: f64) -> Quat {
    let mut v = [0.0; 3];
    v[axis] = angle;
    Quat::exp(Vec3::from_array(v))
}

/// Swing (about x and y) after twist (about z), rad.
fn ball(x: f64, y: f64, z: f64) -> Quat {
    Quat::exp(v3(x, y, 0.0)) * about(2, z)
}

/// Spine joint from bend forward (+y), lean right (+x), turn left (+z).
fn spine(a: [f64; 3]) -> Quat {
    ball(a[1], a[0], a[2])
}

/// +1 left, −1 right.
pub fn sign(side: usize) -> f64 {
    if side == 0 { 1.0 } else { -1.0 }
}

/// Shoulder, hip or ankle from flexion (−y), abduction (+x left), internal rotation (−z left).
fn limb(a: [f64; 3], side: usize) -> Quat {
    ball(sign(side) * a[1], -a[0], -sign(side) * a[2])
}

/// The three anatomical angles (about x, y, z, unsigned axes) of a rotation, swing · twist.
fn split(q: Quat) -> [f64; 3] {
    let c = (q.w * q.w + q.z * q.z).sqrt().max(1e-12);
    let mut twist = 2.0 * trig::atan2(q.z, q.w);
    if twist > std::f64::consts::PI {
        twist -= 2.0 * std::f64::consts::PI;
    }
    if twist < -std::f64::consts::PI {
        twist += 2.0 * std::f64::consts::PI;
    }
    let swing = q * about(2, -twist);
    let s = (swing.x * swing.x + swing.y * swing.y).sqrt();
    let k = if s > 1e-9 {
        2.0 * trig::atan2(s, c) / s
    } else {
        2.0
    };
    let flip = if swing.w < 0.0 { -1.0 } else { 1.0 };
    [swing.x * k * flip, swing.y * k * flip, twist]
}

/// Flexion, abduction, internal rotation of a limb's ball joint.
fn limb_angles(q: Quat, side: usize) -> [f64; 3] {
    let [x, y, z] = split(q);
    [-y, sign(side) * x, -sign(side) * z]
}

fn frame(x: Vec3, y: Vec3, z: Vec3) -> Quat {
    Quat::from_mat3(&Mat3 { x, y, z })
}

/// Pelvis frame of a heading and the pelvis angles of `upper`.
pub fn pelvis_turn(heading: f64, upper: &Upper) -> Quat {
    let [tilt, list, turn] = upper.pelvis;
    about(2, heading + turn) * about(1, tilt) * about(0, list)
}

/// Foot frame of yaw and pitch.
pub fn foot_turn(yaw: f64, pitch: f64) -> Quat {
    about(2, yaw) * about(1, -pitch)
}

impl Actor {
    /// The whole pose: pelvis at `middle` with frame `pelvis`, trunk and arms by angles, legs to the feet.
    pub fn pose(&self, middle: Vec3, pelvis: Quat, upper: &Upper, feet: [FootPose; 2]) -> Pose {
        let mut turn = [Quat::identity(); 18];
        let mut place = [Vec3::zero(); 18];
        let mut angles = [0.0; 39];
        turn[PELVIS] = pelvis;
        place[PELVIS] = middle;
        turn[ABDOMEN] = pelvis * spine(upper.waist);
        place[ABDOMEN] = middle + pelvis.rotate(self.waist);
        turn[CHEST] = turn[ABDOMEN] * spine(upper.thorax);
        place[CHEST] = place[ABDOMEN] + turn[ABDOMEN].rotate(self.thorax);
        let chest = turn[CHEST];
        let nod = spine(upper.neck);
        let neck = chest * Quat::exp(nod.log() * 0.5);
        turn[HEAD] = chest * nod;
        place[HEAD] = place[CHEST] + chest.rotate(self.neck);
        let skull = place[HEAD] + neck.rotate(self.skull);
        let top = skull + turn[HEAD].rotate(self.top);
        angles[0..3].copy_from_slice(&upper.waist);
        angles[3..6].copy_from_slice(&upper.thorax);
        angles[6..9].copy_from_slice(&upper.neck);
        let mut fingers = [Vec3::zero(); 2];
        let mut tips = [Vec3::zero(); 2];
        let mut bend = [Quat::identity(); 2];
        let mut short = [0.0; 2];
        for side in 0..2 {
            let s = sign(side);
            let a = ARM[side];
            let o = self.shoulder;
            place[a] = place[CHEST] + chest.rotate(v3(o.x, s * o.y, o.z));
            turn[a] = chest * limb(upper.shoulder[side], side);
            place[a + 1] = place[a] + turn[a].rotate(v3(0.0, 0.0, -self.upper_arm));
            let [flexion, pronation] = upper.elbow[side];
            bend[side] = turn[a] * about(1, -flexion);
            turn[a + 1] = bend[side] * about(2, -s * pronation);
            place[a + 2] = place[a + 1] + turn[a + 1].rotate(v3(0.0, 0.0, -self.forearm));
            let [flexion, deviation] = upper.wrist[side];
            turn[a + 2] = turn[a + 1] * about(0, -s * flexion) * about(1, -deviation);
            fingers[side] = place[a + 2] + turn[a + 2].rotate(v3(0.0, 0.0, -self.hand));
            let k = ARM_ANGLE[side];
            angles[k..k + 3].copy_from_slice(&upper.shoulder[side]);
            angles[k + 3..k + 5].copy_from_slice(&upper.elbow[side]);
            angles[k + 5..k + 7].copy_from_slice(&upper.wrist[side]);

            let l = LEG[side];
            let foot = feet[side];
            let hip = middle + pelvis.rotate(v3(0.0, s * self.hip, 0.0));
            let (thigh, shank, knee, missing) = self.leg_to(hip, foot.ankle, pelvis, foot.yaw);
            short[side] = missing;
            place[l] = hip;
            turn[l] = thigh;
            place[l + 1] = knee;
            turn[l + 1] = shank;
            place[l + 2] = knee + shank.rotate(v3(0.0, 0.0, -self.shank));
            turn[l + 2] = foot_turn(foot.yaw, foot.pitch);
            place[l + 3] = place[l + 2]
                + turn[l + 2].rotate(v3(self.ball, 0.0, self.ball_height - self.ankle));
            turn[l + 3] = turn[l + 2] * about(1, -foot.toe);
            tips[side] =
                place[l + 3] + turn[l + 3].rotate(v3(self.toe, 0.0, -0.3 * self.ball_height));
            let k = LEG_ANGLE[side];
            angles[k..k + 3].copy_from_slice(&limb_angles(pelvis.conjugate() * thigh, side));
            let knee = split(thigh.conjugate() * shank);
            angles[k + 3] = knee[1];
            angles[k + 4..k + 7]
                .copy_from_slice(&limb_angles(shank.conjugate() * turn[l + 2], side));
            angles[k + 7] = foot.toe;
        }
        Pose {
            turn,
            place,
            neck,
            bend,
            skull,
            top,
            fingers,
            tips,
            angles,
            short,
        }
    }

    /// Frames of thigh and shank, knee position, and by how much the leg is too short.
    ///
    /// The knee bends in the plane through hip and ankle that is normal to the lateral axis half-way between pelvis
    /// and foot.
    fn leg_to(&self, hip: Vec3, ankle: Vec3, pelvis: Quat, yaw: f64) -> (Quat, Quat, Vec3, f64) {
        let lateral = pelvis.rotate(Vec3::Y) + about(2, yaw).rotate(Vec3::Y);
        let d = ankle - hip;
        let most = 0.9995 * self.leg();
        let reach = d.norm();
        let r = reach.min(most);
        let along = d * (1.0 / reach.max(1e-9));
        let out = along.cross(lateral).normalized_or(Vec3::X);
        let axis = out.cross(along).normalized_or(Vec3::Y);
        // Law of cosines: distance of the knee's foot point from the hip, and its height over the line.
        let p = (r * r + self.thigh * self.thigh - self.shank * self.shank) / (2.0 * r);
        let h = (self.thigh * self.thigh - p * p).max(0.0).sqrt();
        let knee = hip + along * p + out * h;
        let foot = hip + along * r;
        let up = |a: Vec3, b: Vec3| (a - b).normalized_or(Vec3::Z);
        let (zt, zs) = (up(hip, knee), up(knee, foot));
        (
            frame(axis.cross(zt), axis, zt),
            frame(axis.cross(zs), axis, zs),
            knee,
            reach - r,
        )
    }

    /// Centres of mass of the segments: placed along each segment by Winter's table.
    pub fn centres(&self, pose: &Pose) -> [Vec3; 18] {
        let mut out = [Vec3::zero(); 18];
        let mix = |a: Vec3, b: Vec3, u: f64| a + (b - a) * u;
        out[PELVIS] = mix(pose.place[PELVIS], pose.place[ABDOMEN], 0.4);
        out[ABDOMEN] = mix(pose.place[ABDOMEN], pose.place[CHEST], 0.5);
        out[CHEST] = mix(pose.place[CHEST], pose.place[HEAD], 0.5);
        out[HEAD] = mix(pose.skull, pose.top, 0.35);
        for side in 0..2 {
            let a = ARM[side];
            out[a] = mix(pose.place[a], pose.place[a + 1], 0.436);
            out[a + 1] = mix(pose.place[a + 1], pose.place[a + 2], 0.430);
            out[a + 2] = mix(pose.place[a + 2], pose.fingers[side], 0.45);
            let l = LEG[side];
            out[l] = mix(pose.place[l], pose.place[l + 1], 0.433);
            out[l + 1] = mix(pose.place[l + 1], pose.place[l + 2], 0.433);
            out[l + 2] =
                pose.place[l + 2] + pose.turn[l + 2].rotate(v3(0.04, 0.0, -0.5 * self.ankle));
            out[l + 3] = mix(pose.place[l + 3], pose.tips[side], 0.5);
        }
        out
    }

    /// Height of the lowest point of a foot: heel, toe joint, toe tip.
    pub fn lowest(&self, pose: &Pose, side: usize) -> f64 {
        let l = LEG[side];
        let heel = pose.place[l + 2] + pose.turn[l + 2].rotate(v3(-self.heel, 0.0, -self.ankle));
        let tip = pose.place[l + 3] + pose.turn[l + 3].rotate(v3(self.toe, 0.0, -self.ball_height));
        heel.z
            .min(tip.z)
            .min(pose.place[l + 3].z - self.ball_height)
    }

    /// Heights of heel, toe joint and toe tip over the floor, by the pose of the foot alone.
    pub fn points_of(&self, foot: &FootPose) -> [f64; 3] {
        let turn = foot_turn(foot.yaw, foot.pitch);
        let heel = foot.ankle + turn.rotate(v3(-self.heel, 0.0, -self.ankle));
        let joint = foot.ankle + turn.rotate(v3(self.ball, 0.0, self.ball_height - self.ankle));
        let tip = joint + (turn * about(1, -foot.toe)).rotate(v3(self.toe, 0.0, -self.ball_height));
        [heel.z, joint.z - self.ball_height, tip.z]
    }

    /// Centre of mass by the table.
    pub fn centre(&self, pose: &Pose) -> Vec3 {
        self.centres(pose)
            .iter()
            .zip(MASS_SHARE)
            .fold(Vec3::zero(), |sum, (c, m)| sum + *c * m)
    }
}
