//! How the feet move between the footholds of an end.

use super::footsteps::Step;
use super::initial_state::Start;
use super::{SWING, turned};
use crate::sim::math::curve::{self, min_jerk_3, smootherstep};
use crate::sim::math::{Quat, Vec3};
use crate::sim::plan::foot_lock::{Sole, yaw_pitch};

/// Height of the ankle's arc, m. Clearance proper is the preparation's business.
const ARC: f64 = 0.05;
/// A foot is over its place so long before it comes down on it, s: one that is late would slide there.
const OVER: f64 = 0.03;
/// The heel of a foot that is left behind by more than this, m, rises by so much per m, up to the last, rad, within
/// this time, s.
const ROLL_FROM: f64 = 0.15;
const ROLL_GAIN: f64 = 1.0;
const MOST_ROLL: f64 = 0.5;
const ROLL: f64 = 0.2;

/// Stance of a foot between two of its steps.
struct Stance {
    place: Vec3,
    yaw: f64,
    /// From when to when, s.
    on: f64,
    off: f64,
    /// Pitch when it comes down, in the middle, and when it is lifted, rad.
    pitch: [f64; 3],
}

impl Stance {
    /// Pose `t` seconds into the end. The heel of a foot that is left behind rises before it is lifted, over [`ROLL`].
    fn pose(&self, sole: &Sole, t: f64) -> (Vec3, Quat) {
        let [first, middle, last] = self.pitch;
        let half = 0.5 * (self.off - self.on);
        let rise = smootherstep(1.0 - (self.off - t) / ROLL.min(half).max(1e-9));
        let settle = smootherstep((t - self.on) / ROLL.min(half).max(1e-9));
        let pitch = first + (middle - first) * settle + (last - middle) * rise;
        let pose = sole.stand(self.place, self.yaw, pitch);
        (pose.ankle, pose.rotation)
    }
}

/// Pitch of a foot at `place` that is left behind by the other one at `other`, rad: heel up.
fn left_behind(place: Vec3, other: Vec3, heading: f64) -> f64 {
    let behind = turned(-heading, other - place).x;
    -(ROLL_GAIN * (behind - ROLL_FROM)).clamp(0.0, MOST_ROLL)
}

/// Ankle and rotation of a foot `t` seconds into the end, and whether it is down.
///
/// * `lands`: see [`OVER`]; not where time runs backwards, and what looks like a landing is a foot that leaves.
pub(super) fn pose(
    from: &Start,
    steps: &[Step],
    sole: &Sole,
    (side, yaw, lands): (usize, f64, bool),
    t: f64,
) -> (Vec3, Quat, bool) {
    let other = |t: f64| {
        let landed = steps.iter().rev().find(|s| s.side != side && s.on <= t);
        landed.map_or(from.place[1 - side], |s| s.place)
    };
    let mine: Vec<&Step> = steps.iter().filter(|s| s.side == side).collect();
    let pitch = yaw_pitch(from.foot[side]).1;
    let stance = |k: usize| {
        let off = mine.get(k).map_or(f64::INFINITY, |s| s.off);
        let lifted = |place: Vec3| left_behind(place, other(off), from.heading);
        match k.checked_sub(1) {
            None => {
                let place = from.place[side];
                let last = if off.is_finite() {
                    lifted(place).min(pitch)
                } else {
                    pitch
                };
                Stance {
                    place,
                    yaw: from.yaw[side],
                    on: 0.0,
                    off,
                    pitch: [pitch, pitch, last],
                }
            }
            Some(before) => {
                let Step { place, on, .. } = *mine[before];
                let first = left_behind(place, other(on), from.heading);
                let last = if off.is_finite() { lifted(place) } else { 0.0 };
                Stance {
                    place,
                    yaw,
                    on,
                    off,
                    pitch: [first, 0.0, last],
                }
            }
        }
    };
    let begins = |k: usize| mine.get(k).map_or(f64::INFINITY, |s| s.off);
    let k = (0..=mine.len())
        .find(|k| t <= begins(*k))
        .unwrap_or(mine.len());
    let under_way = k
        .checked_sub(1)
        .map(|k| (k, mine[k]))
        .filter(|(_, s)| t < s.on);
    let Some((k, step)) = under_way else {
        if k == 0 && !from.down[side] {
            return (from.ankle[side], from.foot[side], true);
        }
        let (ankle, rotation) = stance(k).pose(sole, t);
        return (ankle, rotation, true);
    };
    let in_air = k == 0 && !from.down[side];
    // A foot in the air, and one that lifts at once, goes on as it moves, toe-up as it may be.
    let (start, rotation, velocity, spin) = if in_air || k == 0 && step.off <= 0.0 {
        let (velocity, spin) = (from.ankle_velocity[side], from.foot_spin[side]);
        (from.ankle[side], from.foot[side], velocity, spin)
    } else {
        let (ankle, rotation) = stance(k).pose(sole, step.off);
        (ankle, rotation, Vec3::zero(), Vec3::zero())
    };
    let (goal, flat) = stance(k + 1).pose(sole, step.on);
    let long = step.on - step.off;
    let u = (t - step.off) / long;
    let down = min_jerk_3(start, velocity, goal, long, t - step.off);
    let before = if lands { OVER } else { 0.0 };
    let over = min_jerk_3(start, velocity, goal, long - before, t - step.off);
    let mut p = Vec3 { z: down.z, ..over };
    // What is left of a swing rises no more.
    let arc = if in_air {
        ARC * ((long - SWING.0) / SWING.0).clamp(0.0, 1.0)
    } else {
        ARC
    };
    p.z += curve::arc(arc, u);
    let way = (flat * rotation.conjugate()).log();
    let way = min_jerk_3(Vec3::zero(), spin, way, long, t - step.off);
    (p, Quat::exp(way) * rotation, false)
}
