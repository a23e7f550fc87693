//! Many clips, each run once or with copies, judged by one set of rules: the measures behind `sinew survey`.
//!
//! Every error is against a motion that is fixed in the world: the recording as fitted to the body
//! ([`TrackingReference::recorded`](sinew_physics::rehearsal::TrackingReference::recorded)) or the motion as prepared
//! ([`TrackingReference::prepared`](sinew_physics::rehearsal::TrackingReference::prepared)), at the same time on the
//! clip's clock. Nothing is re-anchored to the figure's place. `docs/survey.md` defines every column.

pub mod compare;
pub mod contacts;
pub mod errors;
pub mod kind;
pub mod outcome;
pub mod pushes;
pub mod row;
pub mod run;
pub mod stats;
pub mod tables;
pub mod verdict;

pub use compare::{SurveyComparison, compare};
pub use kind::MotionKind;
pub use outcome::{Copies, SurveyOutcome, TouchDowns, TrackingErrors};
pub use row::{Lacks, MeasuredClip, SurveyRow};
pub use run::{prepared_off, run, watched};
