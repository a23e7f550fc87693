//! How high a pelvis may be for its legs to reach their ankles.

use crate::body::Body;
use crate::body::topology::THIGHS;
use crate::math::Vec3;
use crate::plan::params::leg;

/// Hip joint of a side in the pelvis frame, m, and length of the leg from hip to ankle, m.
pub(super) fn leg_geometry(body: &Body, side: usize) -> (Vec3, f64) {
    let hip = body.joint_offset[THIGHS[side].index()];
    (hip, body.leg_length(side))
}

/// By how much a pelvis may be higher for a leg to reach its ankle, m; below 0, by how much it has to be lower.
///
/// * `line`: from the ankle to the hip, m; `most`: how far apart they may be, m; `stands`: the foot is on the floor.
pub(super) fn room_above(line: Vec3, most: f64, stands: bool) -> f64 {
    let level = line.level();
    let height = (most * most - level * level)
        .max(leg::LEAST_HEIGHT2 * most * most)
        .sqrt();
    let room = height - line.z;
    if stands || room > 0.0 {
        return room;
    }
    // A swinging leg must not be straight when it lands either; one that kicks or lies is its own affair.
    let near = (leg::SWING_FAR - level / most) / leg::SWING_FAR_RANGE;
    room.max(-leg::SWING_DROP) * near.clamp(0.0, 1.0)
}
