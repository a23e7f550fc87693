//! One figure, one tick. The stages are listed in [`step`].

pub mod assist;
pub mod balance;
mod carrying;
pub mod constraints;
pub mod drive;
pub mod events;
pub mod kinematic_step;
pub mod loads;
mod planning;
pub mod report;
mod rising;
pub mod setup;
pub mod step;
pub mod tasks;
pub mod torque_step;
pub mod touches;

pub use constraints::{Constrained, Constraint, MAX_CONSTRAINTS};
pub use drive::{ClipPlayback, Drive, LivePlayback};
pub use events::FigureEvent;
pub use report::{Audit, ContactPoint, Flags, TickReport};
pub use setup::{
    ControlParams, ControllerKind, FigureOptions, FigureSetup, HeldLoad, Metric, Perturbation,
    Priority, Share, StepperKind, StrengthScale,
};
pub use step::{Figure, TickContext};

/// Identity of a figure in a world; never used again after removal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FigureKey(pub u64);
