//! One clip of a survey.

use super::kind::MotionKind;
use super::outcome::{Copies, SurveyOutcome};
use sinew_physics::forecast::Forecast;
use sinew_physics::math::rounding::short;
use sinew_physics::plan::feasibility::Consistency;
use sinew_physics::rehearsal::follow::Followed;

/// One clip of a survey.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct SurveyRow {
    /// The requested clip: path below the corpus folder, or `builtin:NAME`.
    pub clip: String,
    /// Hash of the clip's bytes.
    pub input: String,
    /// The reason why there is no result; `None` if the clip was run.
    pub error: Option<String>,
    /// The measurement.
    pub result: Option<MeasuredClip>,
}

/// The known facts about a clip that was run.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct MeasuredClip {
    /// Kind of motion, by measurement of the fitted recording.
    pub kind: MotionKind,
    /// Length of the fitted recording, s.
    pub clip_s: f64,
    /// Whether runs of the recording are walked in the prepared motion, which is longer in that case.
    pub walked: bool,
    /// Largest mean distance of the prepared motion from the recording at the same time, m: more than 0.5 cannot be
    /// completed.
    pub prepared_off_m: f64,
    /// Warnings of the reader.
    pub warnings: Vec<String>,
    /// Wrench that the feet lack: in the recording as fitted (`None` for built-in motions), and in the prepared motion.
    pub recorded_lacks: Option<Lacks>,
    /// See `recorded_lacks`.
    pub prepared_lacks: Lacks,
    /// Difficulty and forecast, from the prepared motion, before it was run.
    pub forecast: Forecast,
    /// The clip itself.
    pub outcome: SurveyOutcome,
    /// Its noisy copies, if there are any.
    pub copies: Option<Copies>,
    /// How it was followed, if more than plain tracking was requested.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub followed: Option<Followed>,
}

/// The wrench that the ground lacks for a motion on its feet (`sinew lint`), in weights and weight × m.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Lacks {
    /// Force, root mean square.
    pub force_rms: f64,
    /// Largest force.
    pub force_max: f64,
    /// Moment about the centre of mass, root mean square.
    pub moment_rms: f64,
    /// Share of the samples on feet whose zero-moment point is outside the support polygon.
    pub zmp_outside: f64,
    /// Share of the samples that something other than the feet carries.
    pub carried: f64,
}

impl From<&Consistency> for Lacks {
    fn from(c: &Consistency) -> Self {
        Self {
            force_rms: short(c.force.rms),
            force_max: short(c.force.max),
            moment_rms: short(c.moment.rms),
            zmp_outside: short(c.outside),
            carried: short(c.carried),
        }
    }
}
