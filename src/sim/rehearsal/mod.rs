//! Rehearsal: finds the offsets with which a body of human strength performs a recording in our own simulator.
//!
//! The problem: given a body, its strength and loads, a world and a recording, find offsets of the desired joints, one
//! for each window of a tenth of a second and reached halfway through it, for which stiff motors within strength keep
//! the body near the recording: posture, turn, feet and hands over the floor, centre of mass and its velocity, angular
//! momentum. There is no model but the simulator: samples are simulated, and the best survive ([`search`]). If strength
//! is not enough, a bounded wrench on the pelvis helps, as little as possible. The result ([`RehearsedMotion`]) is
//! played by a figure, and runs there exactly as it did here.
//!
//! [`follow`] chooses the easiest way in which a clip is followed, by trials ([`trial`]): plain tracking, a rehearsal,
//! help.
//!
//! Everything is deterministic: random numbers belong to (seed, round, window, sample), and any number of threads finds
//! the same result. `docs/rehearsal.md` has the problem, the limits and the figures.

pub mod follow;
pub mod look;
pub mod problem;
pub mod random;
pub mod result;
mod sample;
pub mod search;
pub mod settings;
pub mod simulator;
pub mod trial;

pub use problem::{Problem, ProblemError, Reference};
pub use result::{Rehearsal, rehearse};
pub use search::Progress;
pub use settings::Settings;
pub use trial::{Conditions, RehearsedRun, TrackingReference};
