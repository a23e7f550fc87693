//! From the plan of one instant to a posture.

use super::super::arm_ik::{ARMS, bend_elbow, joints};
use super::super::leg_ik::{
    center_of_mass, forward, leg_segments, point_and_roll, solve_leg_in_plane,
};
use crate::body::angles::{anatomical_angles, set_anatomical_angles};
use crate::body::topology::{CHEST, DOF_COUNT, DOF_START, L_FOOT, L_SHANK, PARENT, R_HAND};
use crate::body::{Body, Posture, SegmentId};
use crate::math::{Quat, Vec3};

/// Leg length (hip to ankle) for which distances in plans are written, m.
pub const REFERENCE_LEG: f64 = 0.867;
/// Distance of the balanced centre of mass in front of the ankles, reference body, m: mid-foot.
pub const COM_AHEAD: f64 = 0.045;
/// Shift of the pelvis below which balancing is finished, m.
const BALANCED: f64 = 1e-13;
/// Each round leaves about a third of the error (the share of the legs, which stay behind).
const ROUNDS: usize = 60;

/// Wanted pose of one foot.
#[derive(Clone, Copy, Debug)]
pub struct Foot {
    /// Ankle, world, m.
    pub ankle: Vec3,
    /// World rotation.
    pub rotation: Quat,
    /// Toe extension, rad.
    pub toe: f64,
}

/// Everything needed to make a posture; smooth functions of time make smooth motions.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// Anatomical angles of trunk, head and arms, rad; those of the legs are ignored.
    pub angles: [f64; DOF_COUNT],
    /// Rotation vector of the pelvis, rad.
    pub pelvis: Vec3,
    /// Height of the hip centres over flat-footed ankles, in leg lengths.
    pub height: f64,
    /// Centre of mass over the floor, world x and y, m.
    pub com: [f64; 2],
    /// Left and right.
    pub feet: [Foot; 2],
}

impl Plan {
    /// A plan in between, `u` = 0…1, for plans with the same feet.
    pub fn mix(&self, to: &Self, u: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * u;
        Self {
            angles: std::array::from_fn(|d| mix(self.angles[d], to.angles[d])),
            pelvis: self.pelvis + (to.pelvis - self.pelvis) * u,
            height: mix(self.height, to.height),
            com: std::array::from_fn(|k| mix(self.com[k], to.com[k])),
            feet: self.feet,
        }
    }
}

/// Measures of a body, in which plans are written.
#[derive(Clone, Copy, Debug)]
pub struct Measures {
    /// Length scale against the reference body.
    pub scale: f64,
    /// Hip to ankle with a straight knee, m.
    pub leg: f64,
    /// Ankle over the sole, m.
    pub ankle: f64,
    /// Heel behind the ankle, m.
    pub heel: f64,
    /// Toe joint from the ankle, foot frame, m.
    pub ball: Vec3,
}

impl Measures {
    pub fn of(body: &Body) -> Self {
        let [_, shank, foot, toes] = leg_segments(true).map(|s| s.index());
        debug_assert_eq!((shank, foot), (L_SHANK.index(), L_FOOT.index()));
        let leg = body.leg_length(0);
        let sole = &body.segments[foot].contact_points;
        let least = |f: fn(&Vec3) -> f64| sole.iter().map(f).fold(0.0, f64::min);
        Self {
            scale: leg / REFERENCE_LEG,
            leg,
            ankle: -least(|p| p.z),
            heel: -least(|p| p.x),
            ball: body.joint_offset[toes],
        }
    }

    /// A flat foot with its ankle over `x`, `y` (m).
    pub fn flat(&self, x: f64, y: f64) -> Foot {
        Foot {
            ankle: Vec3 {
                x,
                y,
                z: self.ankle,
            },
            rotation: Quat::identity(),
            toe: 0.0,
        }
    }
}

/// The posture of a plan.
pub fn posture(body: &Body, plan: &Plan) -> Posture {
    let measures = Measures::of(body);
    let mut out = Posture::default();
    set_anatomical_angles(&mut out, &plan.angles);
    out.root_rotation = Quat::exp(plan.pelvis);
    out.root_position = Vec3 {
        x: plan.com[0],
        y: plan.com[1],
        z: measures.ankle + plan.height * measures.leg,
    };
    let across = out.root_rotation.rotate(Vec3::Y);
    for _ in 0..ROUNDS {
        for (side, foot) in plan.feet.iter().enumerate() {
            // Knees bend in a plane between the directions in which the pelvis and the foot point.
            let axis = across + foot.rotation.rotate(Vec3::Y);
            let pose = (foot.ankle, foot.rotation);
            solve_leg_in_plane(body, &mut out, side == 0, pose, foot.toe, axis);
        }
        let com = center_of_mass(body, &forward(body, &out));
        let (dx, dy) = (plan.com[0] - com.x, plan.com[1] - com.y);
        if dx.hypot(dy) < BALANCED {
            break;
        }
        out.root_position.x += dx;
        out.root_position.y += dy;
    }
    out
}

/// Grip of the right hand, hand frame, m.
pub fn grip(body: &Body) -> Vec3 {
    body.segments[R_HAND.index()].tip * 0.45
}

/// Changes the right shoulder and elbow of `plan` so that the balanced posture grips `target` (world, m), with the
/// elbow's hinge axis near `axis`. Balance and reach depend on each other and are solved in turn.
pub fn reach_right(body: &Body, plan: &mut Plan, target: Vec3, axis: Vec3) {
    let [upper, fore, hand] = ARMS[1].map(SegmentId::index);
    debug_assert_eq!(PARENT[upper], CHEST.index());
    for _ in 0..ROUNDS {
        let mut out = posture(body, plan);
        let poses = forward(body, &out);
        let off = poses[hand].0 + poses[hand].1.rotate(grip(body)) - target;
        if off.norm() < 1e-10 {
            break;
        }
        let chest = poses[CHEST.index()].1;
        let to_target = target - poses[upper].0;
        let (n, elbow, reach) = bend_elbow(body, ARMS[1], grip(body), to_target.norm());
        let direction = to_target.normalized_or(-Vec3::Z);
        let world = point_and_roll(reach, n, direction, axis, chest.rotate(Vec3::X));
        let (s, [e, _]) = joints(ARMS[1]);
        out.ball[s] = (chest.conjugate() * world).normalized();
        out.hinge[e] = elbow;
        let found = anatomical_angles(&out);
        for s in [upper, fore] {
            let d = DOF_START[s];
            let count = if s == upper { 3 } else { 1 };
            plan.angles[d..d + count].copy_from_slice(&found[d..d + count]);
        }
    }
}

/// Index of a DOF by name. Panics on an unknown name: that is a bug here.
pub fn dof(name: &str) -> usize {
    crate::body::topology::DOF_NAMES
        .iter()
        .position(|n| *n == name)
        .expect("DOF names in plans are written out")
}

/// Sets angles given in degrees.
pub fn set(angles: &mut [f64; DOF_COUNT], degrees: &[(&str, f64)]) {
    for (name, value) in degrees {
        angles[dof(name)] = value.to_radians();
    }
}
