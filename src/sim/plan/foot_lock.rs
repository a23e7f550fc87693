//! Planted feet that do not slide, and swinging feet that clear the floor.
//!
//! Each stance gets one placement (place and heading). The whole pose of the foot follows from it and the pitch: flat,
//! rolled up about the heel edge, or heel up about the toe joint with flat toes. Between stances the foot follows the
//! recording plus an offset that fades from one lock and grows into the next with continuous velocity and acceleration,
//! raised where it would scrape.

mod sole;
mod stances;

pub(in crate::plan) use sole::FootOffset;
pub use sole::{AnklePose, FootPlacement, FootPose, Sole, turn, yaw_pitch};
pub use stances::{Stance, stances};

use crate::body::topology::outward;
use crate::math::curve::{fade, smoothstep_to};
use crate::math::runs::runs;
use crate::math::{Quat, Vec3};
use crate::motion::filter::low_pass;
use crate::plan::params::{contact, pitch, swing};
use stances::FootTrack;
use std::ops::Range;

/// A foot locked to the floor by the body's sole, and how much that changed.
#[derive(Clone, Debug)]
pub struct LockedFoot {
    /// Pose per sample.
    pub poses: Vec<FootPose>,
    /// Whether the foot is locked to the floor, per sample.
    pub planted: Vec<bool>,
    /// Placement of the locked foot, per sample; zero elsewhere.
    pub placements: Vec<FootPlacement>,
    /// How far the recorded foot point strayed in stance, m: largest distance between any sample and the anchor.
    pub slide_before: f64,
}

/// Largest value of u (1 − u)³ (1 + 3 u), about: an offset that fades grows first, by its speed times this share of the
/// time over which it fades.
const GROWS: f64 = 0.2;
fn median(mut v: Vec<f64>) -> f64 {
    v.sort_by(f64::total_cmp);
    v.get(v.len() / 2).copied().unwrap_or(0.0)
}

/// Ankle (m) and `world_from_foot` of a foot as it was recorded, per sample; floor at z = 0, body scale.
#[derive(Clone, Copy, Debug)]
pub struct RecordedFoot<'a> {
    /// Ankle, m.
    pub ankles: &'a [Vec3],
    /// `world_from_foot`.
    pub rotations: &'a [Quat],
}

impl RecordedFoot<'_> {
    /// Pose of a sample with toes extended by `toe`, rad.
    fn pose(&self, i: usize, toe: f64) -> FootPose {
        FootPose {
            ankle: self.ankles[i],
            rotation: self.rotations[i],
            toe,
        }
    }
}

/// By how much a foot in stance is turned differently from the recording, rad per sample.
#[derive(Clone, Debug)]
pub struct StanceTurns {
    /// Heel raised further.
    pub heel_up: Vec<f64>,
    /// Foot turned outwards on the floor; one value per stance.
    pub toe_out: Vec<f64>,
    /// Toes turned up about their tip.
    pub tip: Vec<f64>,
}

impl StanceTurns {
    /// No turns, for `n` samples.
    pub fn none(n: usize) -> Self {
        Self {
            heel_up: vec![0.0; n],
            toe_out: vec![0.0; n],
            tip: vec![0.0; n],
        }
    }
}

/// Extension of the toes of a foot that swings with this pitch, rad.
pub(in crate::plan) fn swing_toe(pitch: f64) -> f64 {
    (-pitch).clamp(0.0, swing::MOST_TOE)
}

/// Locks one foot.
///
/// * `stances`, `other`: the stances of this foot and of the other one (from [`stances`]).
/// * `side`: 0 left, 1 right.
/// * `rate_hz`: samples per second.
///
/// The result is continuous in position, velocity and acceleration up to the recording's own smoothness. A planted
/// foot's pivot (heel edge or toe joint) does not move, and no point of the sole is below the floor in stance. Without
/// any stance of either foot, the foot stays as it was recorded. O(n log n) per stance.
pub fn lock_foot(
    sole: &Sole,
    recorded: RecordedFoot<'_>,
    stances: &[Stance],
    other: &[Stance],
    turns: &StanceTurns,
    side: usize,
    rate_hz: f64,
) -> LockedFoot {
    let RecordedFoot { ankles, rotations } = recorded;
    let n = ankles.len();
    let track = FootTrack::new(sole, ankles, rotations);
    let toes: Vec<f64> = track.pitch.iter().map(|p| swing_toe(*p)).collect();
    let mut out = LockedFoot {
        poses: (0..n).map(|i| recorded.pose(i, toes[i])).collect(),
        planted: vec![false; n],
        placements: vec![FootPlacement::default(); n],
        slide_before: 0.0,
    };
    if stances.is_empty() && other.is_empty() {
        // A swing leads from one stance to another. Without any, the whole recording would count as one swing, and a
        // sole that stands on the floor would be raised by the clearance of a step.
        return out;
    }
    for &Stance { start: i, end: j } in stances {
        let (place, yaw) = track.anchor(i, j);
        let pitch = stance_pitch(&track.pitch[i..j], rate_hz);
        let ball = sole.toe_joint.horizontal();
        let arm = |yaw: f64| Quat::exp(Vec3::Z * yaw).rotate(ball);
        // A foot turns outwards about its ball.
        let stays = place + arm(yaw);
        for k in i..j {
            let yaw = yaw + outward(side) * turns.toe_out[k];
            let at = FootPlacement {
                place: stays - arm(yaw),
                yaw,
                pitch: (pitch[k - i] - turns.heel_up[k]).max(contact::LEAST_PITCH),
                tip: turns.tip[k],
            };
            out.slide_before = out.slide_before.max((track.point[k] - at.place).norm());
            out.planted[k] = true;
            out.placements[k] = at;
            out.poses[k] = sole.stand_on_tip(&at);
        }
    }
    let off = |k: usize| !other.iter().any(|s| (s.start..s.end).contains(&k));
    let long = (contact::SHORTEST_FLIGHT * rate_hz) as usize;
    for (i, j, on) in runs(&out.planted.clone()) {
        if !on {
            let flies = [off((i + long).min(n - 1)), off(j.saturating_sub(long))];
            swing(sole, &mut out, recorded, &toes, i..j, flies, rate_hz);
        }
    }
    out
}

/// Pitch profile of a stance. A dead band makes the foot flat. A walking foot rolls one way only before its flat middle
/// and one way only after it: first toe-up, then heel-up, unless it comes down on its toes or leaves from its heel.
fn stance_pitch(raw: &[f64], rate_hz: f64) -> Vec<f64> {
    let n = raw.len();
    let long = n as f64 > pitch::LONG_STANCE * rate_hz;
    let band = if long {
        pitch::LONG_DEAD_BAND
    } else {
        pitch::DEAD_BAND
    };
    let mut p: Vec<f64> = raw
        .iter()
        .map(|x| (x - x.clamp(-band, band)).clamp(contact::LEAST_PITCH, contact::MOST_TILT))
        .collect();
    if !long {
        let flat: Vec<usize> = (0..n)
            .filter(|k| raw[*k].abs() < pitch::MIDSTANCE)
            .collect();
        if let Some(&mid) = flat.get(flat.len() / 2) {
            // Walking backwards, or in a dance, a foot comes down on the toes and may leave from the heel.
            let toes_first = raw[0] < -pitch::MIDSTANCE;
            let heel_last = raw[n - 1] > pitch::MIDSTANCE;
            for (k, p) in p.iter_mut().enumerate() {
                let toe_up = if k < mid { !toes_first } else { heel_last };
                *p = if toe_up { p.max(0.0) } else { p.min(0.0) };
            }
        } else if median(raw.to_vec()) < 0.0 {
            p.iter_mut().for_each(|p| *p = p.min(0.0));
        } else {
            p.iter_mut().for_each(|p| *p = p.max(0.0));
        }
    } else {
        p.iter_mut().for_each(|p| *p = p.min(0.0));
    }
    low_pass(&mut p, swing::JOINT_CUTOFF, rate_hz);
    p
}

/// The end of a swing at which it leaves a lock, or comes into one.
struct End {
    sample: usize,
    /// Samples over which the offset fades.
    span: f64,
    /// Value, slope and curvature of the offset, per span.
    offset: [FootOffset; 3],
}

/// Fills the samples of a swing between the locks on either side. `flies`: whether the other foot is in the air as
/// well, at the beginning and at the end of the swing.
fn swing(
    sole: &Sole,
    out: &mut LockedFoot,
    recorded: RecordedFoot<'_>,
    toes: &[f64],
    samples: Range<usize>,
    flies: [bool; 2],
    rate_hz: f64,
) {
    let (i, j, n) = (samples.start, samples.end, toes.len());
    let recorded_pose = |k: usize| recorded.pose(k, toes[k]);
    let at = |k: usize, out: &LockedFoot| out.poses[k].offset_from(&recorded_pose(k));
    // Between two locks each offset is gone where the other begins; a swing cut off by the recording has no other lock.
    let fade_time = ((swing::DEPARTURE * rate_hz) as usize).max(1);
    let span = if i > 0 && j < n {
        fade_time.min(j - i + 1)
    } else {
        fade_time
    } as f64;
    // One-sided differences inside the stance.
    let both = [
        (i > 0, i.wrapping_sub(1), -1isize, flies[0]),
        (j < n, j, 1, flies[1]),
    ];
    let ends: Vec<End> = both
        .into_iter()
        .filter(|e| e.0)
        .map(|(_, k, inward, flies)| {
            let step = |m: isize| (k as isize + inward * m).clamp(0, n as isize - 1) as usize;
            let inside = |m: isize| {
                out.planted[step(m)] && (0..n as isize).contains(&(k as isize + inward * m))
            };
            let x0 = at(k, out);
            let (mut v, mut a) = ([0.0; 7], [0.0; 7]);
            if inside(1) && inside(2) {
                let (x1, x2) = (at(step(1), out), at(step(2), out));
                for c in 0..7 {
                    // Outward slope: minus the inward difference.
                    v[c] = -(-1.5 * x0[c] + 2.0 * x1[c] - 0.5 * x2[c]);
                    a[c] = x0[c] - 2.0 * x1[c] + x2[c];
                }
            }
            let speed = v[..3].iter().map(|v| v * v).sum::<f64>().sqrt();
            let span = if flies && speed > 0.0 {
                span.min(
                    (swing::MOST_GROWTH / (GROWS * speed)).max(swing::LEAST_DEPARTURE * rate_hz),
                )
            } else {
                span
            };
            End {
                sample: k,
                span,
                offset: [x0, v.map(|v| v * span), a.map(|a| a * span * span)],
            }
        })
        .collect();
    for k in i..j {
        let mut o = [0.0; 7];
        for end in &ends {
            let u = k.abs_diff(end.sample) as f64 / end.span;
            let [x, v, a] = &end.offset;
            if u < 1.0 {
                for c in 0..7 {
                    o[c] += fade(x[c], v[c], a[c], u);
                }
            }
        }
        let mut pose = recorded_pose(k).moved(&o);
        pose.toe = pose.toe.clamp(sole.toe_range.0, sole.toe_range.1);
        out.poses[k] = pose;
    }
    // Clearance in proportion to the step: a shuffle of some centimetres need not rise like a stride.
    let (a, b) = (i.saturating_sub(1), j.min(n - 1));
    let reach = (out.poses[b].ankle - out.poses[a].ankle).norm();
    let most = (swing::CLEARANCE_SHARE * reach).clamp(swing::LEAST_CLEARANCE, swing::CLEARANCE);
    // Time since lift-off and until touch-down, s; one second where the recording cuts the swing off.
    let since_until = |k: usize| {
        let time = |known: bool, samples: usize| if known { samples as f64 / rate_hz } else { 1.0 };
        (time(i > 0, k + 1 - i), time(j < n, j - k))
    };
    let mut lift: Vec<f64> = (i..j)
        .map(|k| {
            let (since, until) = since_until(k);
            let need = most
                .min(swing::RISE_SPEED * since)
                .min(swing::SINK_SPEED * until);
            let p = &out.poses[k];
            (need - (p.ankle.z + sole.lowest(p.rotation, p.toe))).max(0.0)
        })
        .collect();
    low_pass(&mut lift, swing::HEIGHT_CUTOFF, rate_hz);
    for (k, l) in (i..j).zip(lift) {
        let (since, until) = since_until(k);
        let w = (since.min(until) / swing::LIFT_TIME).min(1.0);
        out.poses[k].ankle.z += smoothstep_to(l.max(0.0), w);
    }
}

#[cfg(test)]
mod tests;
