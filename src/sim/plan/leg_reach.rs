//! How high the pelvis may be for the legs to reach their ankles.

use crate::body::Body;
use crate::body::topology::THIGHS;
use crate::math::Vec3;
use crate::plan::params::leg;

/// Hip joint of a side in the pelvis frame, m, and length of the leg from hip to ankle, m.
pub(super) fn leg_geometry(body: &Body, side: usize) -> (Vec3, f64) {
    let hip = body.joint_offset[THIGHS[side].index()];
    (hip, body.leg_length(side))
}

/// How much higher a pelvis may be for a leg to reach its ankle, m; below 0, how much lower it has to be.
///
/// * `line`: from the ankle to the hip, m; `most`: their largest possible distance, m; `stands`: whether the foot is on
///   the floor.
pub(super) fn room_above(line: Vec3, most: f64, stands: bool) -> f64 {
    let level = line.level();
    let height = (most * most - level * level)
        .max(leg::LEAST_HEIGHT2 * most * most)
        .sqrt();
    let room = height - line.z;
    if stands || room > 0.0 {
        return room;
    }
    // A swinging leg must not be straight when it lands either. Legs that kick or lie are not restricted.
    let near = (leg::SWING_FAR - level / most) / leg::SWING_FAR_RANGE;
    room.max(-leg::SWING_DROP) * near.clamp(0.0, 1.0)
}
