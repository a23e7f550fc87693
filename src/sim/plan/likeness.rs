//! How alike two motions are at a moment of each, regardless of place and heading.

use crate::body::Posture;
use crate::body::topology::{DOF_COUNT, DOF_START, L_THIGH, L_UPPER_ARM};
use crate::math::{Quat, Vec3};
use crate::motion::GRAVITY;
use crate::plan::params::{likeness, stop, stream, transition};

/// Unlikeness of the postures and their rates, rad rms over trunk and legs. Takes three samples of each motion, 1/60 s
/// apart, and compares the middle ones.
pub fn unlike(a: &[Posture; 3], b: &[Posture; 3]) -> f64 {
    let rates = |m: &[Posture; 3]| {
        let way = m[0].joint_difference(&m[2]);
        way.map(|w| 0.5 * stop::RATE * w)
    };
    let (p, q) = (&a[1], &b[1]);
    let angles = p.joint_difference(q);
    let (before, after) = (rates(a), rates(b));
    let arms = DOF_START[L_UPPER_ARM.index()]..DOF_START[L_THIGH.index()];
    let mut sum = 0.0;
    for k in 0..DOF_COUNT {
        let rate = likeness::RATE_SHARE * (before[k] - after[k]);
        let share = if arms.contains(&k) {
            likeness::ARM_WEIGHT
        } else {
            1.0
        };
        sum += share * (angles[k] * angles[k] + rate * rate);
    }
    sum += pelvis_unlike(p, q);
    (sum / (DOF_COUNT - arms.len()) as f64).sqrt()
}

/// Unlikeness of tilt and height of the pelvis, squared, rad².
pub(super) fn pelvis_unlike(p: &Posture, q: &Posture) -> f64 {
    // Tilt: the direction of the vertical in the pelvis frame.
    let up = |p: &Posture| p.root_rotation.conjugate().rotate(Vec3::Z);
    let tilt = up(p) - up(q);
    let height = p.root_position.z - q.root_position.z;
    likeness::TILT_WEIGHT * tilt.dot(tilt) + likeness::HEIGHT_WEIGHT * height * height
}

/// The cost of entering a stream at a moment that resembles the one at which a motion is left, and whether a body can
/// bear the change.
#[derive(Clone, Copy, Debug)]
pub struct Seam {
    /// Cost.
    pub cost: f64,
    /// Whether a body can bear it.
    pub fits: bool,
}

impl Seam {
    /// * `left`, `entered`: three samples of each motion, 1/60 s apart.
    /// * `hip`: height of the pelvis of a standing body, m.
    /// * `delay`: how far behind its schedule the entered motion is then, s.
    pub fn new(left: &[Posture; 3], entered: &[Posture; 3], hip: f64, delay: f64) -> Self {
        let most_speed = transition::MOST_CAPTURE * (GRAVITY / hip).sqrt();
        let unlike = unlike(left, entered) / likeness::CLOSED_CYCLE;
        let speed = drift(left, entered) / most_speed;
        Self {
            cost: unlike * unlike + speed * speed + stream::DELAY_COST * delay * delay,
            fits: unlike <= 1.0 && speed <= 1.0,
        }
    }
}

/// Difference of the velocities over the floor, seen from the pelvis, m/s.
fn drift(a: &[Posture; 3], b: &[Posture; 3]) -> f64 {
    let speed = |m: &[Posture; 3]| {
        let v = (m[2].root_position - m[0].root_position) * (0.5 * stream::RATE);
        let turn = Quat::exp(Vec3::Z * -m[1].root_rotation.heading());
        turn.rotate(v)
    };
    (speed(a) - speed(b)).level()
}
