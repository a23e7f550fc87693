//! One figure, one tick. The loop is [`Figure::step`](step::Figure).

pub mod assist;
pub mod balance;
pub mod drive;
pub mod events;
pub mod kinematic_step;
pub mod loads;
pub mod report;
pub mod setup;
pub mod step;
pub mod tasks;
pub mod torque_step;

pub use drive::{ClipPlayback, Drive};
pub use events::FigureEvent;
pub use report::{Audit, ContactPoint, Flags, TickReport};
pub use setup::{
    ControlParams, ControllerKind, FigureOptions, HeldLoad, Metric, Perturbation, Priority, Share,
    StepperKind, StrengthScale,
};
pub use step::{Figure, FigureSetup, TickContext};
