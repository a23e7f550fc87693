//! Detects which fast stretches of a recording are runs, by gait rather than by speed.
//!
//! A backflip, a dive and a punch are as fast as a run. In a run, the body is upright, the feet land in turns with a
//! flight before each landing, and the body gets somewhere by that. The flights show in the motion of the mass: when
//! the lead changes from one foot to the other, a runner falls freely, while a walker is lifted by both legs.

use super::run_to_walk::{leads, paces, turning_points};
use crate::math::Vec3;
use crate::math::runs::runs;
use crate::motion::GRAVITY;
use crate::motion::filter::{low_pass, low_pass_points};
use crate::reference::params::run_detection;
use std::ops::Range;

/// Points of a recorded figure, per sample, m, z up.
pub(crate) struct RecordedPoints<'a> {
    /// Middle of all joints.
    pub middle: &'a [Vec3],
    /// Ankle of the left and of the right foot.
    pub feet: [&'a [Vec3]; 2],
    /// Middle of the hips and middle of the shoulders.
    pub trunk: [&'a [Vec3]; 2],
}

/// Whether a fast stretch is a run and, if not, why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Gait {
    /// A run: upright, steps in turns with flights between them, and real progress.
    Run,
    /// The trunk is not upright throughout.
    NotUpright,
    /// It ends near where it began.
    GoesNowhere,
    /// The feet do not take turns, or do so only a few times.
    FewSteps,
    /// The body does not fall between the steps.
    NoFlights,
}

impl Gait {
    /// The feature that a run has and this stretch lacks.
    fn reason(self) -> &'static str {
        match self {
            Self::Run => "it is a run",
            Self::NotUpright => "the trunk is not upright",
            Self::GoesNowhere => "it goes nowhere",
            Self::FewSteps => "the feet do not take several steps in turns",
            Self::NoFlights => "there are no flights between its steps",
        }
    }
}

/// A stretch that is faster than people walk.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FastStretch {
    /// First sample, and one past the last.
    pub samples: (usize, usize),
    /// Highest speed over the floor, m/s.
    pub speed: f64,
    /// Changes of the leading foot, and how many of them have a flight.
    pub steps: usize,
    /// See `steps`.
    pub flights: usize,
    /// Its gait.
    pub gait: Gait,
}

impl FastStretch {
    /// Message for the user about a stretch that is not a run.
    pub(crate) fn why_not_a_run(&self, rate_hz: f64) -> String {
        format!(
            "from {:.2} s to {:.2} s it moves at up to {:.1} m/s, but {}: no run, kept as recorded",
            self.samples.0 as f64 / rate_hz,
            self.samples.1 as f64 / rate_hz,
            self.speed,
            self.gait.reason()
        )
    }
}

/// The stretches of a recording that are faster than people walk, in order. O(n).
pub(crate) fn fast_stretches(figure: &RecordedPoints<'_>, rate_hz: f64) -> Vec<FastStretch> {
    let speed = paces(figure.middle, rate_hz);
    let moves: Vec<bool> = speed
        .iter()
        .map(|v| *v > run_detection::WALK_SPEED)
        .collect();
    let most = |i: usize, j: usize| speed[i..j].iter().copied().fold(0.0, f64::max);
    runs(&moves)
        .into_iter()
        .filter(|(i, j, fast)| *fast && most(*i, *j) > run_detection::RUN_SPEED)
        .map(|(i, j, _)| classify(figure, i..j, most(i, j), rate_hz))
        .collect()
}

fn classify(
    figure: &RecordedPoints<'_>,
    samples: Range<usize>,
    speed: f64,
    rate_hz: f64,
) -> FastStretch {
    let Range { start: i, end: j } = samples;
    let turns = lead_turns(figure, i..j, rate_hz);
    let falls = falling(figure.middle, rate_hz);
    let steps = turns.windows(2).map(|w| w[1] - w[0]);
    let step = steps
        .min()
        .unwrap_or((run_detection::LONGEST_STEP * rate_hz) as usize);
    let half = (run_detection::FALL_WINDOW * step as f64) as usize;
    let flies = |k: &&usize| {
        let around = k.saturating_sub(half).max(i)..(*k + half + 1).min(j);
        falls[around].contains(&true)
    };
    let flights = turns.iter().filter(flies).count();
    let [hips, shoulders] = figure.trunk;
    let upright = (i..j)
        .filter(|k| {
            let up = (shoulders[*k] - hips[*k]).normalized_or(Vec3::zero());
            up.z > run_detection::UPRIGHT
        })
        .count();
    let start = figure.middle[i];
    let far = figure.middle[i..j].iter().map(|p| {
        let way = *p - start;
        way.x.hypot(way.y)
    });
    let gait = if (upright as f64) < run_detection::UPRIGHT_SHARE * (j - i) as f64 {
        Gait::NotUpright
    } else if turns.len() < run_detection::FEWEST_STEPS {
        Gait::FewSteps
    } else if far.fold(0.0, f64::max) < run_detection::LEAST_WAY {
        Gait::GoesNowhere
    } else if (flights as f64) < run_detection::FLYING_SHARE * turns.len() as f64 {
        Gait::NoFlights
    } else {
        Gait::Run
    };
    FastStretch {
        samples: (i, j),
        speed,
        steps: turns.len(),
        flights,
        gait,
    }
}

/// The `samples` in which one foot's lead over the other, along the path, is at its largest and the other foot takes
/// over.
fn lead_turns(figure: &RecordedPoints<'_>, samples: Range<usize>, rate_hz: f64) -> Vec<usize> {
    let mut slow = figure.middle.to_vec();
    low_pass_points(&mut slow, run_detection::PATH_CUTOFF, rate_hz);
    let lead = leads(&slow, figure.feet, rate_hz);
    let turns = turning_points(&lead, samples);
    // Each must be the lead of the expected foot, in turns, soon after the one before.
    let mut steps: Vec<usize> = Vec::new();
    let mut best: Vec<usize> = Vec::new();
    for k in turns {
        let follows = steps.last().is_none_or(|before| {
            lead[k].signum() != lead[*before].signum()
                && (k - before) as f64 <= run_detection::LONGEST_STEP * rate_hz
        });
        if lead[k].abs() < run_detection::LEAST_LEAD {
            continue;
        }
        if !follows {
            steps.clear();
        }
        steps.push(k);
        if steps.len() > best.len() {
            best.clone_from(&steps);
        }
    }
    best
}

/// Samples in which the middle of the body falls.
fn falling(middle: &[Vec3], rate_hz: f64) -> Vec<bool> {
    let n = middle.len();
    let mut height: Vec<f64> = middle.iter().map(|p| p.z).collect();
    low_pass(&mut height, run_detection::FALL_CUTOFF, rate_hz);
    (0..n)
        .map(|k| {
            if k == 0 || k + 1 >= n {
                return false;
            }
            let bend = height[k - 1] - 2.0 * height[k] + height[k + 1];
            bend * rate_hz * rate_hz < -run_detection::FALL_SHARE * GRAVITY
        })
        .collect()
}

#[cfg(test)]
mod tests;
