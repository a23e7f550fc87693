//! Runs as they were recorded: when the feet are planted, how the mass moves, and how the feet roll off.
//!
//! A runner's foot is on the floor for two tenths of a second. It touches while it still moves at 1 m/s and leaves the
//! same way, heel first, so labels by the speed of the foot see only the middle half of the stance. The body tells
//! stance from flight instead: its mass falls freely in flight, and a motion that can be followed has to allow that.

use super::envelope::bent_below;
use super::foot_lock::{FootPlacement, LockedFoot, Sole, Stance, StanceTurns};
use super::free_fall::in_free_fall;
use super::pelvis_shift::{MassTrack, mass_track};
use crate::body::{Body, Posture};
use crate::math::Vec3;
use crate::math::runs::{remove_short, runs, stretches};
use crate::motion::GRAVITY;
use crate::motion::filter::low_pass;
use crate::motion::leg_ik::forward;
use crate::plan::params::{balance, contact, leg, run};
use crate::reference::params::run_detection;
use std::ops::RangeInclusive;

/// Speed over the floor around the samples `during`, from [`run_detection::PACE_TIME`] before to as long after, m/s.
fn pace(at: impl Fn(usize) -> Vec3, during: RangeInclusive<usize>, n: usize, rate_hz: f64) -> f64 {
    let half = (run_detection::PACE_TIME * rate_hz) as usize;
    let (a, b) = (
        during.start().saturating_sub(half),
        (during.end() + half).min(n - 1),
    );
    let way = at(b) - at(a);
    way.level() * rate_hz / (b - a).max(1) as f64
}

/// Labels the feet where the body of `postures` runs, by the load that the floor carries.
///
/// * `postures`: as recorded, in body scale, feet not locked; `label`: left and right foot on the floor, per sample;
///   `rate_hz`: samples per second.
///
/// O(n).
pub(crate) fn label_runs(body: &Body, postures: &[Posture], label: &mut [[bool; 2]], rate_hz: f64) {
    let n = postures.len();
    if n < 8 {
        return;
    }
    let shortest = contact::SHORTEST_TOLD * rate_hz;
    let track = mass_track(body, postures, rate_hz);
    let mut loaded: Vec<bool> = track.load.iter().map(|l| *l > run::STANCE_LOAD).collect();
    remove_short(&mut loaded, shortest);
    let soles = [Sole::new(body, 0), Sole::new(body, 1)];
    let points: Vec<[Vec<Vec3>; 2]> = postures
        .iter()
        .map(|p| {
            let poses = forward(body, p);
            std::array::from_fn(|s| soles[s].points_at(&poses).collect())
        })
        .collect();
    // Speed and height of the slowest point of a foot.
    let rest = |i: usize, s: usize, height: f64| {
        let (a, b) = (i.saturating_sub(1), (i + 1).min(n - 1));
        let time = (b - a) as f64 / rate_hz;
        let of = |k: usize| {
            (points[b][s][k] - points[a][s][k]).norm() / time + height * points[i][s][k].z
        };
        (0..points[i][s].len())
            .map(of)
            .fold(f64::INFINITY, f64::min)
    };
    let fast = |i: usize| pace(|k| track.com[k], i..=i, n, rate_hz) > run::SPEED;
    let fast: Vec<bool> = (0..n).map(fast).collect();
    for (i, j) in stretches(&fast) {
        let mut left: Vec<bool> = (i..j)
            .map(|k| rest(k, 0, run::HEIGHT_SPEED) < rest(k, 1, run::HEIGHT_SPEED))
            .collect();
        remove_short(&mut left, shortest);
        for k in i..j {
            let stands = usize::from(!left[k - i]);
            let arrives =
                k > 0 && !label[k - 1][stands] && rest(k, stands, 0.0) > run::ARRIVAL_SPEED;
            label[k] = [false; 2];
            label[k][stands] = loaded[k] && !arrives;
        }
    }
}

/// The flights of a running motion, and how hard it pushes between them.
pub(crate) struct FlightPhases {
    /// Whether no foot is on the floor, per sample.
    air: Vec<bool>,
    /// Vertical acceleration that the centre of mass should have where it should differ from the recorded one, m/s².
    push: Vec<Option<f64>>,
    /// Vertical acceleration of the centre of mass with the pelvis at the recorded height, m/s².
    plain: Vec<f64>,
    rate_hz: f64,
}

impl FlightPhases {
    /// `None` if the motion does not run.
    ///
    /// * `upper`: the motion; `label`: left and right foot on the floor, per sample.
    pub(crate) fn of(upper: &[Posture], label: &[[bool; 2]], rate_hz: f64) -> Option<Self> {
        let n = upper.len();
        let none: Vec<bool> = label.iter().map(|l| *l == [false; 2]).collect();
        let mut air = vec![false; n];
        for (i, j) in stretches(&none) {
            let speed = pace(|k| upper[k].root_position, i..=j - 1, n, rate_hz);
            if speed > run::SPEED && (j - i) as f64 >= contact::SHORTEST_TOLD * rate_hz {
                air[i..j].fill(true);
            }
        }
        air.contains(&true).then(|| Self {
            push: pushes(&air, rate_hz),
            plain: vec![0.0; n],
            air,
            rate_hz,
        })
    }

    /// Whether no foot is on the floor, per sample.
    pub(crate) fn air(&self) -> &[bool] {
        &self.air
    }

    /// Takes over how the mass moves with the pelvis raised by `height` (m).
    pub(crate) fn observe(&mut self, track: &MassTrack, height: &[f64]) {
        let z = |i: usize| track.com[i].z - height[i] / balance::PELVIS_LEAD;
        for i in 1..height.len() - 1 {
            let bend = z(i - 1) - 2.0 * z(i) + z(i + 1);
            self.plain[i] = bend * self.rate_hz * self.rate_hz;
        }
    }

    /// Raise of the pelvis per sample, at most `most` (m): the least that lets the mass fall freely while no foot is
    /// planted, and be pushed evenly while one is. Newton's method on the samples that are held down; each round is one
    /// banded solve, O(n).
    pub(crate) fn heights(&self, most: &[f64]) -> Vec<f64> {
        let bend = (leg::DROP_TIME * self.rate_hz).powi(4);
        bent_below(most, |i| {
            let free = in_free_fall(&self.air, i);
            let weight = if free { run::FLIGHT_PRICE * bend } else { bend };
            let to = if free { Some(-GRAVITY) } else { self.push[i] };
            let lacks = |to: f64| balance::PELVIS_LEAD * (to - self.plain[i]);
            (
                weight,
                to.map(|to| lacks(to) / (self.rate_hz * self.rate_hz)),
            )
        })
    }
}

/// Vertical acceleration of the centre of mass in stances between two flights: within the stance the floor makes up for
/// gravity over the whole time.
fn pushes(air: &[bool], rate_hz: f64) -> Vec<Option<f64>> {
    let mut out = vec![None; air.len()];
    let share = |u: f64| {
        let late = 1.0
            - (1.0 - run::LAST_LOAD) * (u - run::UNLOADING_SHARE) / (1.0 - run::UNLOADING_SHARE);
        (u / run::LOADING_SHARE).min(1.0).min(late)
    };
    for w in runs(air).windows(3) {
        let [(a, i, _), (_, j, flies), (_, b, _)] = *w else {
            unreachable!("windows of three")
        };
        let (stance, flight) = ((j - i) as f64, 0.5 * ((i - a) + (b - j)) as f64);
        if flies || stance > run::LONGEST_STANCE * rate_hz {
            continue;
        }
        let at = |k: usize| share(((k - i) as f64 + 0.5) / stance);
        let mean = (i..j).map(at).sum::<f64>() / stance;
        let force = GRAVITY * (1.0 + flight / stance) / mean;
        for (k, o) in out.iter_mut().enumerate().take(j).skip(i) {
            *o = Some(force * at(k) - GRAVITY);
        }
    }
    out
}

/// How far a foot rolls up onto its toes, and onto their tip, so that its ankle is where it was recorded. A runner's
/// foot that is held flat on its toes to the last has its ankle 5 cm behind and 5 cm below that, and its leg is too
/// short for it.
///
/// * `turns`: heel and tip are changed in the `stances` of the `locked` foot.
///
/// O(n).
pub(crate) fn roll_off(
    sole: &Sole,
    ankle: &[Vec3],
    locked: &LockedFoot,
    stances: &[Stance],
    turns: &mut StanceTurns,
    rate_hz: f64,
) {
    for st in stances {
        let flat = |k: &usize| locked.placements[*k].pitch > -run::ROLL_FROM;
        let from = (st.start..st.end).rev().find(flat);
        let from = from.map_or(st.start, |k| k + 1);
        let mut up = vec![0.0; ankle.len()];
        let mut on = vec![0.0; ankle.len()];
        for k in from..st.end {
            (up[k], on[k]) = roll(sole, &locked.placements[k], ankle[k]);
        }
        for (v, out) in [(&mut up, &mut turns.heel_up), (&mut on, &mut turns.tip)] {
            // Do not smooth across the take-off.
            let last = v[st.end - 1];
            v[st.end..].fill(last);
            low_pass(v, run::ROLL_CUTOFF, rate_hz);
            for k in st.start..st.end {
                out[k] += v[k];
            }
        }
        turns.tip[st.start..st.end]
            .iter_mut()
            .for_each(|t| *t = t.max(0.0));
    }
}

/// The smallest heel and tip angles, rad, that bring the ankle of a foot placed at `at` nearest to `ankle`.
fn roll(sole: &Sole, at: &FootPlacement, ankle: Vec3) -> (f64, f64) {
    let mut best = (f64::INFINITY, 0.0, 0.0);
    for a in -run::HEEL_STEPS..=run::HEEL_STEPS {
        let up = f64::from(a) * run::HEEL_STEP;
        let pitch = at.pitch - up;
        if !(contact::LEAST_PITCH..=-run::LEAST_RAISE).contains(&pitch) {
            continue;
        }
        for b in 0..=run::TIP_STEPS {
            let tip = f64::from(b) * run::TIP_STEP;
            let pose = sole.stand_on_tip(&FootPlacement { pitch, tip, ..*at });
            let off = (pose.ankle - ankle).norm();
            let cost =
                off + run::TURN_PRICE * (up + tip).abs() + run::BEND_PRICE * (up.abs() + tip);
            if cost < best.0 {
                best = (cost, up, tip);
            }
        }
    }
    (best.1, best.2)
}

#[cfg(test)]
mod tests;
