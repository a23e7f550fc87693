//! How a clip is followed: by plain tracking if possible, otherwise by a rehearsal, otherwise with the least help.

use super::problem::{Problem, ProblemError};
use super::result::{Rehearsal, rehearse};
use super::search::Progress;
use super::settings::Settings;
use super::trial::{Conditions, RehearsedRun, TrackingReference, TrialResult, try_out};
use crate::body::topology::{DOF_COUNT, DOF_NAMES};
use crate::figure::motion::rehearsed::RehearsalWorld;
use crate::figure::{FigureOptions, Perturbation};
use crate::forecast::{Forecast, ForecastVerdict};
use crate::math::rounding::short;
use crate::motion::Clip;
use crate::world::{RehearsedMotion, WorldError};
use std::sync::Arc;

/// The means that a figure may use to follow a clip.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Follow {
    /// Plain tracking: physics alone; if it falls, it falls.
    #[default]
    Strict,
    /// A rehearsal, without help.
    Rehearsed,
    /// Help while the motion is being lost. A rehearsal searches for less than that.
    Assisted,
    /// The same to the end of the motion, with as much help as that takes.
    Always,
}

impl Follow {
    /// Name as one word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Strict => "strict",
            Self::Rehearsed => "rehearsed",
            Self::Assisted => "assisted",
            Self::Always => "always",
        }
    }

    /// Largest force of the help over the weight, if nothing else is said.
    pub fn most_help(self) -> f64 {
        match self {
            Self::Strict | Self::Rehearsed => 0.0,
            Self::Assisted => 0.3,
            Self::Always => 1.0,
        }
    }

    /// Whether the means include help.
    pub fn takes_help(self) -> bool {
        self.most_help() > 0.0
    }
}

/// The way in which a clip is followed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FollowWay {
    /// By plain tracking, as it is.
    #[default]
    Tracked,
    /// Rehearsed: strength alone is enough.
    Rehearsed,
    /// With help: rehearsed, or plain tracking with help while the motion is being lost.
    Helped,
    /// Not at all: plain tracking falls, and no rehearsal was found.
    Lost,
}

impl FollowWay {
    /// Name as one word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tracked => "tracked",
            Self::Rehearsed => "rehearsed",
            Self::Helped => "helped",
            Self::Lost => "lost",
        }
    }
}

/// How a clip was followed, and the reason for this way.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Followed {
    /// The way.
    pub way: FollowWay,
    /// Why no easier way was possible.
    pub reason: String,
    /// The rehearsal, if there was one.
    pub rehearsal: Option<RehearsalReport>,
}

/// Figures of a rehearsal.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct RehearsalReport {
    /// The mean distance from the recording never exceeded 0.5 m.
    pub completed: bool,
    /// Time at which it did, s.
    pub lost_at_s: Option<f64>,
    /// Length of the recording, s.
    pub duration_s: f64,
    /// Mean distance of the segment origins from the recording, mm, until it was lost.
    pub global_mm: f64,
    /// The same with both pelvis origins in one place, mm.
    pub root_relative_mm: f64,
    /// Impulse of the help, N·s.
    pub help_ns: f64,
    /// The same over weight × time.
    pub help_share: f64,
    /// Largest force of the help, N.
    pub help_most_n: f64,
    /// Largest moment of the help, N·m.
    pub help_most_nm: f64,
    /// Share of the windows that were helped.
    pub helped_windows: f64,
    /// The DOF that used the largest share of its strength (95th percentile of the ticks), and that share.
    pub hardest_dof: String,
    /// See `hardest_dof`.
    pub hardest_share: f64,
    /// Ticks of the motion, with the ways in and out.
    pub motion_ticks: u64,
    /// Ticks that were simulated.
    pub ticks: u64,
    /// Rounds of the search.
    pub rounds: usize,
    /// Share of the windows that the search reached.
    pub reached: f64,
    /// Whether the caller stopped it.
    pub stopped: bool,
}

impl RehearsalReport {
    /// Simulated ticks for each tick of the motion.
    pub fn samples_per_tick(&self) -> u64 {
        self.ticks / self.motion_ticks.max(1)
    }
}

impl From<&Rehearsal> for RehearsalReport {
    fn from(r: &Rehearsal) -> Self {
        let hardest = (0..DOF_COUNT).reduce(|a, b| if r.effort[b] > r.effort[a] { b } else { a });
        let hardest = hardest.unwrap_or(0);
        let share = |[part, all]: [usize; 2]| short(part as f64 / all.max(1) as f64);
        Self {
            completed: r.completed(),
            lost_at_s: r.errors.lost_at.map(short),
            duration_s: short(r.recorded),
            global_mm: short(1e3 * r.errors.global),
            root_relative_mm: short(1e3 * r.errors.from_root),
            help_ns: short(r.help.impulse),
            help_share: short(r.help.share),
            help_most_n: short(r.help.most[0]),
            help_most_nm: short(r.help.most[1]),
            helped_windows: share(r.help.windows),
            hardest_dof: DOF_NAMES[hardest].to_owned(),
            hardest_share: short(r.effort[hardest]),
            motion_ticks: r.motion.ticks() as u64,
            ticks: r.work.ticks,
            rounds: r.work.rounds,
            reached: share(r.work.reached),
            stopped: r.work.stopped,
        }
    }
}

/// Why a clip cannot be followed as requested.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FollowError {
    /// No world accepts the conditions.
    #[error(transparent)]
    World(#[from] WorldError),
    /// There is nothing to rehearse.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// A rehearsal supports loads in one hand only.
    #[error("a load held in two hands cannot be rehearsed yet")]
    TwoHands,
    /// Loads that come or go.
    #[error("a load that is taken up or let go within the motion cannot be rehearsed yet")]
    ChangingLoad,
}

/// Options of a rehearsal, besides the conditions of a trial.
#[derive(Clone, Debug, PartialEq)]
pub struct RehearsalOptions {
    /// The means that it may use.
    pub follow: Follow,
    /// Largest force of the help over the weight.
    pub most_help: f64,
    /// Number of threads; the result does not depend on it.
    pub threads: usize,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Numbers of the search.
    pub settings: Settings,
}

impl RehearsalOptions {
    /// Largest force of the help over the weight; 0: none.
    pub fn allowed_help(&self) -> f64 {
        match self.follow.takes_help() {
            true => self.most_help,
            false => 0.0,
        }
    }
}

impl Default for RehearsalOptions {
    fn default() -> Self {
        Self {
            follow: Follow::Assisted,
            most_help: Follow::Assisted.most_help(),
            threads: 1,
            seed: 1,
            settings: Settings::default(),
        }
    }
}

/// How a clip can be followed under given conditions.
#[derive(Clone, Debug)]
pub struct FollowResult {
    /// The way and its reason.
    pub followed: Followed,
    /// The trial in that way.
    pub trial: TrialResult,
    /// The trial by plain tracking.
    pub tracked: TrialResult,
    /// The rehearsed motion that is played, if the clip is rehearsed.
    pub motion: Option<Arc<RehearsedMotion>>,
    /// The help that plain tracking needs, if that is how the clip is followed.
    pub helped: Option<LiveHelp>,
}

/// Help that a clip gets while it is being lost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiveHelp {
    /// Largest force that is allowed over the weight.
    pub most: f64,
    /// Impulse of the help, N·s.
    pub impulse: f64,
    /// Share of the time in which it acts.
    pub acts: f64,
}

impl FollowResult {
    /// The same conditions, with the rehearsed motion or the help by which the clip is followed.
    pub fn conditions(&self, conditions: &Conditions) -> Conditions {
        Conditions {
            options: FigureOptions {
                max_help: self.helped.as_ref().map_or(0.0, |h| h.most),
                ..conditions.options
            },
            rehearsed: self.motion.as_ref().map(|motion| RehearsedRun {
                from: motion.start(),
                motion: Arc::clone(motion),
            }),
            ..conditions.clone()
        }
    }
}

/// The rehearsal problem of a run under these conditions, without its pushes.
///
/// # Errors
/// Loads that a rehearsal does not support.
pub fn problem(
    conditions: &Conditions,
    options: &RehearsalOptions,
) -> Result<Problem, FollowError> {
    let world = &conditions.world;
    let stage = RehearsalWorld {
        dt: 1.0 / world.rate_hz,
        substeps: world.substeps,
        gravity: world.gravity,
    };
    let body = Arc::clone(&conditions.body);
    let mut problem = Problem::new(body, &conditions.strength, world.friction, stage);
    for given in &conditions.perturbations {
        let Some(load) = given.load() else {
            continue;
        };
        // The other hand may join at any moment of the motion.
        if load.second.is_some() || matches!(given, Perturbation::Helped { .. }) {
            return Err(FollowError::TwoHands);
        }
        if load.from > 0.0 || load.to.is_finite() {
            return Err(FollowError::ChangingLoad);
        }
        for (segment, point, mass) in load.shares() {
            problem.links.add_load(segment, point, mass);
        }
    }
    problem.most_help = options.allowed_help();
    problem.seed = options.seed;
    Ok(problem)
}

/// Plain tracking with help while the motion is being lost; `None` if the motion is lost even so, or if no help is
/// allowed.
fn live_help(
    conditions: &Conditions,
    reference: &TrackingReference,
    options: &RehearsalOptions,
) -> Result<Option<(LiveHelp, TrialResult)>, WorldError> {
    let conditions = with_help(conditions, options);
    if conditions.options.max_help == 0.0 {
        return Ok(None);
    }
    let trial = try_out(&conditions, reference)?;
    let help = LiveHelp {
        most: options.most_help,
        impulse: trial.help.impulse,
        acts: trial.help.acts,
    };
    Ok(trial.completed.then_some((help, trial)))
}

/// The same conditions with the permitted help while a motion is being lost.
pub fn with_help(conditions: &Conditions, options: &RehearsalOptions) -> Conditions {
    Conditions {
        options: FigureOptions {
            max_help: options.allowed_help(),
            ..conditions.options
        },
        ..conditions.clone()
    }
}

/// Follows a clip in the easiest way that keeps it: never more than 0.5 m from the recording (PHC's rule).
///
/// * `as_recorded`: the recording with its feet locked and with ways in and out, and no other change.
/// * `go_on`: gets the progress of a rehearsal; returning `false` stops it.
///
/// # Errors
/// Conditions that no world accepts, or that cannot be rehearsed.
pub fn follow(
    conditions: &Conditions,
    reference: &TrackingReference,
    (as_recorded, forecast): (&Clip, &Forecast),
    options: &RehearsalOptions,
    go_on: &mut dyn FnMut(&Progress) -> bool,
) -> Result<FollowResult, FollowError> {
    let strict = Conditions {
        options: FigureOptions {
            max_help: 0.0,
            ..conditions.options
        },
        ..conditions.clone()
    };
    let tracked = try_out(&strict, reference)?;
    let said = match forecast.verdict {
        ForecastVerdict::Follows => "forecast: follows".to_owned(),
        verdict => format!("forecast: {}, {}", verdict.name(), forecast.reason),
    };
    if tracked.completed || options.follow == Follow::Strict {
        let way = if tracked.completed {
            FollowWay::Tracked
        } else {
            FollowWay::Lost
        };
        return Ok(FollowResult {
            followed: Followed {
                way,
                reason: said,
                rehearsal: None,
            },
            trial: tracked.clone(),
            tracked,
            motion: None,
            helped: None,
        });
    }
    let mut problem = problem(conditions, options)?;
    let ends = [f64::NEG_INFINITY, f64::INFINITY];
    problem.stands = Some(ends.map(|t| reference.prepared.sample(t).posture));
    let (settings, threads) = (&options.settings, options.threads);
    let rehearsal = rehearse(&problem, as_recorded, settings, threads, go_on)?;
    let report = RehearsalReport::from(&rehearsal);
    let motion = Arc::new(rehearsal.motion);
    let played = Conditions {
        rehearsed: Some(RehearsedRun {
            from: motion.start(),
            motion: Arc::clone(&motion),
        }),
        ..strict
    };
    let trial = try_out(&played, reference)?;
    let helped = match report.stopped || trial.completed && trial.help.share == 0.0 {
        true => None,
        false => live_help(conditions, reference, options)?,
    };
    let least = |h: &TrialResult| !trial.completed || h.help.share < trial.help.share;
    if let Some((help, trial)) = helped.filter(|(_, h)| least(h)) {
        let reason = format!(
            "plain tracking loses it ({said}), and a rehearsal does not do it with less help: {:.1} % of weight × \
             time while it is being lost, at most {:.0} N",
            100.0 * trial.help.share,
            trial.help.most
        );
        return Ok(FollowResult {
            followed: Followed {
                way: FollowWay::Helped,
                reason,
                rehearsal: Some(report),
            },
            trial,
            tracked,
            motion: None,
            helped: Some(help),
        });
    }
    let when = |t: Option<f64>| t.map_or("to the end".to_owned(), |t| format!("at {t:.2} s"));
    let mut reason = format!("plain tracking loses it {} ({said})", when(tracked.lost_at));
    let way = match trial.completed {
        true if report.help_ns > 0.0 => {
            reason += &format!(
                "; strength alone was not found to do it: {:.1} N·s of help, {:.1} % of weight × time, at most {:.0} N",
                report.help_ns,
                100.0 * report.help_share,
                report.help_most_n
            );
            FollowWay::Helped
        }
        true => FollowWay::Rehearsed,
        false => {
            reason += &format!("; the rehearsal loses it {}", when(trial.lost_at));
            FollowWay::Lost
        }
    };
    reason += &format!(
        "; hardest: {} with {:.0} % of its strength for 5 % of the time",
        report.hardest_dof,
        100.0 * report.hardest_share
    );
    let kept = way != FollowWay::Lost;
    Ok(FollowResult {
        followed: Followed {
            way,
            reason,
            rehearsal: Some(report),
        },
        trial: if kept { trial } else { tracked.clone() },
        tracked,
        motion: kept.then_some(motion),
        helped: None,
    })
}
