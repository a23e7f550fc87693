//! The result of one run, and of its noisy copies.

use super::stats::{Quartiles, wilson};
use sinew_physics::math::rounding::short;

/// Mean errors against one motion that is fixed in the world.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct TrackingErrors {
    /// Mean distance of the segment origins with both pelvis origins in one place, mm.
    pub mpjpe_root_mm: f64,
    /// Mean distance of the segment origins in the world, mm.
    pub mpjpe_global_mm: f64,
    /// Root mean square of the differences of all 39 joint coordinates, degrees.
    pub joint_rms_deg: f64,
}

/// Touch-downs against the labels of the recording.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct TouchDowns {
    /// Touch-downs of the recording.
    pub recorded: usize,
    /// Touch-downs of the recording that the figure lacks within 0.3 s.
    pub missed: usize,
    /// Touch-downs of the figure that the recording lacks: added steps.
    pub added: usize,
    /// Median deviation of matched touch-downs, ms; `None` without any.
    pub median_ms: Option<f64>,
    /// Largest deviation, ms.
    pub worst_ms: Option<f64>,
}

/// The result of one run. Times are on the clip's clock (negative in the way into the clip).
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct SurveyOutcome {
    /// The mean distance from the recording never exceeded 0.5 m (PHC's rule) to the clip's end.
    pub completed: bool,
    /// Time at which it exceeded that, s.
    pub lost_at_s: Option<f64>,
    /// Largest mean distance from the recording, m.
    #[serde(default)]
    pub farthest_m: Option<f64>,
    /// Time at which the pelvis was off by 0.25 m in height or 0.8 in tilt, s.
    pub anchor_lost_at_s: Option<f64>,
    /// Time at which the mean distance from the motion as prepared exceeded 0.5 m, before that motion's end, s: a
    /// forecast is about this.
    pub prepared_lost_at_s: Option<f64>,
    /// Time of our own event `fell`, s: also on the way in, and in the second after the way out.
    pub fell_at_s: Option<f64>,
    /// Whether it lay on the floor 1 s after the clip's end, where the clip does not end there.
    #[serde(default)]
    pub down_after: bool,
    /// Time at which the state ran away and the figure was frozen, s.
    pub frozen_at_s: Option<f64>,
    /// Time of the clip over which errors and contacts are measured, s: until it is lost or fell.
    pub followed_s: f64,
    /// Errors against the recording as fitted to the body.
    pub recorded: TrackingErrors,
    /// Errors against the motion as prepared.
    pub prepared: TrackingErrors,
    /// Touch-downs.
    pub touch_downs: TouchDowns,
    /// Share of the figure's foot contacts that the recording has too.
    pub contact_precision: Option<f64>,
    /// Share of the recording's foot contacts that the figure has too.
    pub contact_recall: Option<f64>,
    /// Stances.
    pub stances: usize,
    /// Distance that a foot slides in one stance, mm: median of all stances.
    pub skate_median_mm: Option<f64>,
    /// Largest, mm.
    pub skate_worst_mm: Option<f64>,
    /// Largest change of the velocity of the desired centre of mass in a tick beyond the recording's, until balance is
    /// lost, m/s.
    #[serde(default)]
    pub target_jump_m_s: Option<f64>,
    /// Deepest contact point below the floor, mm.
    pub penetration_mm: f64,
    /// Largest vertical push of the floor in a tick, body weights.
    pub peak_force_weights: f64,
    /// Vertical impulse of the floor and the assist, less the change of momentum, over weight (at 9.81 m/s²) × time,
    /// minus 1: 0 if the laws hold. `None` if loads came or went.
    pub impulse_balance: Option<f64>,
    /// Jerk of the segments over that of the recording.
    pub jerk_ratio: Option<f64>,
    /// Impulse of the assist over weight × time.
    pub assist_share: f64,
    /// The same within the recorded part of the clip: neither the way in nor the time after it dilutes it.
    #[serde(default)]
    pub assist_recorded_share: f64,
    /// Largest force of the assist, N.
    pub assist_max_n: f64,
    /// Largest moment of the assist about the pelvis, N·m.
    #[serde(default)]
    pub assist_max_nm: f64,
    /// Mean change of the assist's force from tick to tick over its mean; `None` without assist.
    #[serde(default)]
    pub assist_change: Option<f64>,
    /// Time with some DOF at the limit of its strength, s.
    pub limit_s: f64,
    /// The DOF that was longest at its limit; empty if none was.
    pub limit_dof: String,
    /// Time for which it was, s.
    pub limit_dof_s: f64,
}

/// Errors over less time than this do not count, s.
const LEAST_S: f64 = 0.1;

impl SurveyOutcome {
    /// Errors against the recording, if it was followed for 0.1 s or more.
    pub fn to_recorded(&self) -> Option<&TrackingErrors> {
        (self.followed_s >= LEAST_S).then_some(&self.recorded)
    }

    /// Errors against the motion as prepared, on the same condition.
    pub fn to_prepared(&self) -> Option<&TrackingErrors> {
        (self.followed_s >= LEAST_S).then_some(&self.prepared)
    }

    /// Whether the motion as prepared was followed to its end, within 0.5 m and without a frozen state.
    pub fn followed_as_prepared(&self) -> bool {
        self.prepared_lost_at_s.is_none() && self.frozen_at_s.is_none()
    }
}

/// The results of the noisy copies of a clip.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Copies {
    /// Number of copies.
    pub count: usize,
    /// Number of completed copies.
    pub completed: usize,
    /// 95 % interval of that share (Wilson).
    pub completed_share: [f64; 2],
    /// Number of copies that fell.
    pub fell: usize,
    /// [`SurveyOutcome::farthest_m`] of each copy, m; `None` where it did not complete.
    #[serde(default)]
    pub farthest_m: Vec<Option<f64>>,
    /// Measures over the copies, in the order of [`MEASURES`]; `None` where no copy has a value.
    pub measures: Vec<Option<Quartiles>>,
}

impl Copies {
    /// From these outcomes.
    pub fn of(outcomes: &[SurveyOutcome]) -> Self {
        let completed = outcomes.iter().filter(|o| o.completed).count();
        Self {
            count: outcomes.len(),
            completed,
            completed_share: wilson(completed, outcomes.len()).map(short),
            fell: outcomes.iter().filter(|o| o.fell_at_s.is_some()).count(),
            farthest_m: (outcomes.iter())
                .map(|o| o.farthest_m.filter(|_| o.completed))
                .collect(),
            measures: MEASURES
                .iter()
                .map(|m| {
                    let values: Vec<f64> = outcomes.iter().filter_map(|o| (m.of)(o)).collect();
                    Quartiles::of(&values)
                })
                .collect(),
        }
    }
}

/// The direction in which a measure is better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Better {
    /// Less is better.
    Less,
    /// More is better.
    More,
    /// Nearer to zero is better.
    Zero,
}

/// A number of an outcome by which surveys are compared.
#[derive(Clone, Copy, Debug)]
pub struct SurveyMeasure {
    /// Name with unit, for people.
    pub name: &'static str,
    /// The number, if the outcome has it.
    pub of: fn(&SurveyOutcome) -> Option<f64>,
    /// The better direction.
    pub better: Better,
    /// Tolerance: a change of a single run below this, or below `share` of the old value, does not count, since builds
    /// round differently.
    pub least: f64,
    /// See `least`.
    pub share: f64,
}

const fn measure(
    name: &'static str,
    of: fn(&SurveyOutcome) -> Option<f64>,
    better: Better,
    (least, share): (f64, f64),
) -> SurveyMeasure {
    SurveyMeasure {
        name,
        of,
        better,
        least,
        share,
    }
}

/// The measures by which surveys are compared.
pub const MEASURES: [SurveyMeasure; 18] = [
    measure(
        "followed, s",
        |o| Some(o.followed_s),
        Better::More,
        (0.05, 0.0),
    ),
    measure(
        "root-relative error to the recording, mm",
        |o| o.to_recorded().map(|e| e.mpjpe_root_mm),
        Better::Less,
        (2.0, 0.05),
    ),
    measure(
        "global error to the recording, mm",
        |o| o.to_recorded().map(|e| e.mpjpe_global_mm),
        Better::Less,
        (5.0, 0.05),
    ),
    measure(
        "joint error to the recording, deg",
        |o| o.to_recorded().map(|e| e.joint_rms_deg),
        Better::Less,
        (0.1, 0.05),
    ),
    measure(
        "root-relative error to the prepared motion, mm",
        |o| o.to_prepared().map(|e| e.mpjpe_root_mm),
        Better::Less,
        (2.0, 0.05),
    ),
    measure(
        "global error to the prepared motion, mm",
        |o| o.to_prepared().map(|e| e.mpjpe_global_mm),
        Better::Less,
        (5.0, 0.05),
    ),
    measure(
        "joint error to the prepared motion, deg",
        |o| o.to_prepared().map(|e| e.joint_rms_deg),
        Better::Less,
        (0.1, 0.05),
    ),
    measure(
        "touch-down error, median, ms",
        |o| o.touch_downs.median_ms,
        Better::Less,
        (17.0, 0.0),
    ),
    measure(
        "contact precision",
        |o| o.contact_precision,
        Better::More,
        (0.02, 0.0),
    ),
    measure(
        "contact recall",
        |o| o.contact_recall,
        Better::More,
        (0.02, 0.0),
    ),
    measure(
        "steps missed or added",
        |o| Some((o.touch_downs.missed + o.touch_downs.added) as f64),
        Better::Less,
        (0.5, 0.0),
    ),
    measure(
        "skate, worst, mm",
        |o| o.skate_worst_mm,
        Better::Less,
        (3.0, 0.1),
    ),
    measure(
        "jump of the target's velocity, m/s",
        |o| o.target_jump_m_s,
        Better::Less,
        (0.1, 0.1),
    ),
    measure(
        "penetration, mm",
        |o| Some(o.penetration_mm),
        Better::Less,
        (2.0, 0.2),
    ),
    measure(
        "vertical impulse balance",
        |o| o.impulse_balance,
        Better::Zero,
        (0.005, 0.0),
    ),
    measure("jerk ratio", |o| o.jerk_ratio, Better::Less, (0.2, 0.1)),
    measure(
        "assist, share of weight",
        |o| Some(o.assist_share),
        Better::Less,
        (0.005, 0.05),
    ),
    measure(
        "time at the strength limit, s",
        |o| Some(o.limit_s),
        Better::Less,
        (0.1, 0.1),
    ),
];
