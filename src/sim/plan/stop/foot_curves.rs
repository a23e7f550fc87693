//! How the feet move between the footholds of a stop.

use super::footsteps::PlannedStep;
use super::initial_state::InitialState;
use super::turned;
use crate::math::curve::{self, min_jerk_3, smootherstep};
use crate::math::{Quat, Vec3};
use crate::plan::foot_lock::{Sole, yaw_pitch};
use crate::plan::params::stop;

/// Stance of a foot between two of its steps.
struct StanceCurve {
    place: Vec3,
    yaw: f64,
    /// Start and end, s.
    on: f64,
    off: f64,
    /// Pitch at landing, in the middle, and at lift-off, rad.
    pitch: [f64; 3],
}

impl StanceCurve {
    /// Pose `t` seconds into the stop. The heel of a foot that is left behind rises before lift-off, over
    /// [`stop::ROLL_TIME`].
    fn pose(&self, sole: &Sole, t: f64) -> (Vec3, Quat) {
        let [first, middle, last] = self.pitch;
        let half = 0.5 * (self.off - self.on);
        let rise = smootherstep(1.0 - (self.off - t) / stop::ROLL_TIME.min(half).max(1e-9));
        let settle = smootherstep((t - self.on) / stop::ROLL_TIME.min(half).max(1e-9));
        let pitch = first + (middle - first) * settle + (last - middle) * rise;
        let pose = sole.stand(self.place, self.yaw, pitch);
        (pose.ankle, pose.rotation)
    }
}

/// Pitch of a foot at `place` that is left behind by the other one at `other`, rad: heel up.
fn left_behind(place: Vec3, other: Vec3, heading: f64) -> f64 {
    let behind = turned(-heading, other - place).x;
    -(stop::ROLL_GAIN * (behind - stop::ROLL_FROM)).clamp(0.0, stop::MOST_ROLL)
}

/// A foot of a motion that comes to a stop.
pub(super) struct EndingFoot {
    /// Left (0) or right (1).
    pub(super) side: usize,
    /// Heading at its last foothold, rad.
    pub(super) yaw: f64,
    /// See [`stop::OVER_TIME`]; false where time runs backwards, so that an apparent landing is really a lift-off.
    pub(super) lands: bool,
}

/// A foot at one time.
pub(super) struct FootMoment {
    pub(super) ankle: Vec3,
    /// `world_from_foot`.
    pub(super) rotation: Quat,
    pub(super) down: bool,
}

/// Pose of the foot `t` seconds into the stop.
pub(super) fn pose(
    from: &InitialState,
    steps: &[PlannedStep],
    sole: &Sole,
    ending: EndingFoot,
    t: f64,
) -> FootMoment {
    let EndingFoot { side, yaw, lands } = ending;
    let stands = |ankle, rotation| FootMoment {
        ankle,
        rotation,
        down: true,
    };
    let other = |t: f64| {
        let landed = steps.iter().rev().find(|s| s.side != side && s.on <= t);
        landed.map_or(from.feet[1 - side].place, |s| s.place)
    };
    let mine: Vec<&PlannedStep> = steps.iter().filter(|s| s.side == side).collect();
    let foot = &from.feet[side];
    let pitch = yaw_pitch(foot.rotation).1;
    let lifts = |k: usize| mine.get(k).map_or(f64::INFINITY, |s| s.off);
    let stance = |k: usize| {
        let off = lifts(k);
        let lifted = |place: Vec3| left_behind(place, other(off), from.heading);
        match k.checked_sub(1) {
            None => {
                let place = foot.place;
                let last = if off.is_finite() {
                    lifted(place).min(pitch)
                } else {
                    pitch
                };
                StanceCurve {
                    place,
                    yaw: foot.yaw,
                    on: 0.0,
                    off,
                    pitch: [pitch, pitch, last],
                }
            }
            Some(before) => {
                let PlannedStep { place, on, .. } = *mine[before];
                let first = left_behind(place, other(on), from.heading);
                let last = if off.is_finite() { lifted(place) } else { 0.0 };
                StanceCurve {
                    place,
                    yaw,
                    on,
                    off,
                    pitch: [first, 0.0, last],
                }
            }
        }
    };
    let k = (0..=mine.len())
        .find(|k| t <= lifts(*k))
        .unwrap_or(mine.len());
    let under_way = k
        .checked_sub(1)
        .map(|k| (k, mine[k]))
        .filter(|(_, s)| t < s.on);
    let Some((k, step)) = under_way else {
        if k == 0 && !foot.down {
            return stands(foot.ankle, foot.rotation);
        }
        let (ankle, rotation) = stance(k).pose(sole, t);
        return stands(ankle, rotation);
    };
    let in_air = k == 0 && !foot.down;
    // A foot in the air, and one that lifts at once, continues its motion, with the toes as far up as they are.
    let (start, rotation, velocity, spin) = if in_air || k == 0 && step.off <= 0.0 {
        (foot.ankle, foot.rotation, foot.velocity, foot.spin)
    } else {
        let (ankle, rotation) = stance(k).pose(sole, step.off);
        (ankle, rotation, Vec3::zero(), Vec3::zero())
    };
    let (goal, flat) = stance(k + 1).pose(sole, step.on);
    let long = step.on - step.off;
    let u = (t - step.off) / long;
    let down = min_jerk_3(start, velocity, goal, long, t - step.off);
    let before = if lands { stop::OVER_TIME } else { 0.0 };
    let over = min_jerk_3(start, velocity, goal, long - before, t - step.off);
    let mut p = Vec3 { z: down.z, ..over };
    // The rest of a swing under way does not rise any more.
    let arc = if in_air {
        stop::ARC_HEIGHT * ((long - stop::SHORTEST_SWING) / stop::SHORTEST_SWING).clamp(0.0, 1.0)
    } else {
        stop::ARC_HEIGHT
    };
    p.z += curve::arc(arc, u);
    let way = (flat * rotation.conjugate()).log();
    let way = min_jerk_3(Vec3::zero(), spin, way, long, t - step.off);
    FootMoment {
        ankle: p,
        rotation: Quat::exp(way) * rotation,
        down: false,
    }
}
