//! How like two motions are at a moment of each, whatever their place and heading.

use crate::sim::body::Posture;
use crate::sim::body::topology::{DOF_COUNT, DOF_START, L_THIGH, L_UPPER_ARM};
use crate::sim::math::Vec3;
use crate::sim::plan::params::{likeness, stop};

/// Unlikeness of the postures and their rates, rad rms over trunk and legs. Of each motion three samples, 1/60 s apart;
/// the middle ones are compared.
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
    // Tilt: where the vertical is in the pelvis.
    let up = |p: &Posture| p.root_rotation.conjugate().rotate(Vec3::Z);
    let tilt = up(p) - up(q);
    let height = p.root_position.z - q.root_position.z;
    sum += likeness::TILT_WEIGHT * tilt.dot(tilt) + likeness::HEIGHT_WEIGHT * height * height;
    (sum / (DOF_COUNT - arms.len()) as f64).sqrt()
}
