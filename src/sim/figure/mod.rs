//! One figure, one tick.

pub mod report;
pub mod setup;

pub use report::{Audit, ContactPoint, Flags, TickReport};
pub use setup::{
    ControlParams, ControllerKind, Metric, Perturbation, Priority, Share, StepperKind,
    StrengthScale,
};
