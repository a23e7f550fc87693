//! Many clips, each run once or with copies, judged by one set of rules: the measures behind `sinew survey`.
//!
//! Every error is against a motion that is fixed in the world: the recording as fitted to the body
//! ([`Reference::recorded`]) or the motion as prepared ([`Reference::prepared`]), at the same time on the clip's
//! clock. Nothing is re-anchored to where the figure is. `docs/survey.md` defines every column.

pub mod compare;
pub mod contacts;
pub mod errors;
pub mod kind;
pub mod outcome;
pub mod run;
pub mod stats;
pub mod tables;
pub mod verdict;

pub use compare::{Comparison, compare};
pub use kind::Kind;
pub use outcome::{Copies, Errors, Outcome, TouchDowns};
pub use run::{Conditions, Reference, RehearsedRun, run, watched};

use super::follow::Followed;
use super::forecast::Forecast;
use sinew_physics::plan::feasibility::Consistency;

/// One clip of a survey.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Row {
    /// What was asked for: path below the corpus folder, or `builtin:NAME`.
    pub clip: String,
    /// Hash of the clip's bytes.
    pub input: String,
    /// Why there is nothing else; `None` if the clip was run.
    pub error: Option<String>,
    /// What was measured.
    pub result: Option<Measured>,
}

/// What is known of a clip that was run.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Measured {
    /// Kind of motion, by measurement of the fitted recording.
    pub kind: Kind,
    /// Length of the fitted recording, s.
    pub clip_s: f64,
    /// True if runs of the recording are walked in the prepared motion, which is longer then.
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
    pub outcome: Outcome,
    /// Its noisy copies, if there are any.
    pub copies: Option<Copies>,
    /// How it was followed, if it was asked for more than plain tracking.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub followed: Option<Followed>,
}

/// What the ground lacks for a motion on its feet (`sinew lint`), in weights and weight × m.
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
            force_rms: stats::short(c.force.rms),
            force_max: stats::short(c.force.max),
            moment_rms: stats::short(c.moment.rms),
            zmp_outside: stats::short(c.outside),
            carried: stats::short(c.carried),
        }
    }
}
