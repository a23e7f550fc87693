//! Judging a run from outside: the behaviour of a figure, measured from its reports and checked against the laws of
//! motion.
//!
//! [`metrics`] accumulates a run tick by tick into a [`RunReport`]; [`audit`] rebuilds the equations of motion from the
//! body alone, without any number of the solver; [`strip`] draws the motion, [`plot`] its numbers; [`survival`] shows
//! which cases were survived; [`noise`] tests whether that was luck; [`experiments`] are those of `sinew paper` and
//! `sinew walking`; [`survey`] judges a whole corpus by published rules against references that are fixed in the world,
//! and compares surveys; [`envelope`] gives the strength that a motion requires. Nothing here reads a clock or a file.

pub mod audit;
pub mod envelope;
pub mod experiments;
pub mod metrics;
pub mod noise;
pub mod plot;
pub mod pose;
pub mod report;
pub mod strip;
pub mod survey;
pub mod survival;

pub use audit::{AuditResult, audit};
pub use metrics::{Metrics, Tick};
pub use report::{RunEvent, RunReport};
