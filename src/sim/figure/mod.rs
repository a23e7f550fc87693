//! One figure, one tick. The stages are listed in [`tick`].

use serde::{Deserialize, Serialize};

mod activity;
pub mod assist;
pub mod balance_loss;
mod bracing;
pub mod constraints;
pub mod drive;
pub mod events;
pub mod following;
mod get_up;
pub mod help;
pub mod kinematic_step;
mod load_compensation;
pub mod loads;
pub mod params;
pub mod plan_task;
pub mod rehearsed;
mod second_hand;
pub mod self_contact;
pub mod tasks;
pub mod tick;
pub mod torque_step;
pub mod touches;

pub use crate::report::{Audit, ContactPoint, Flags, TickReport};
pub use crate::setup::{
    ControlParams, ControllerKind, FigureOptions, FigureSetup, HeldLoad, Metric, Perturbation,
    Priority, SecondHand, Share, StepperKind, StrengthScale,
};
pub use constraints::{Constrained, Constraint, MAX_CONSTRAINTS};
pub use drive::{ClipPlayback, Drive, LivePlayback};
pub use events::FigureEvent;
pub use following::{FollowMode, Following};
pub use plan_task::{LatePlans, PlanRequest, Planning};
pub use rehearsed::{RehearsedMotion, RehearsedPlayback};
pub use second_hand::Help;
pub(crate) use tick::SavedFigure;
pub(crate) use tick::Slot;
pub use tick::{Figure, TickContext};

/// Identity of a figure in a world; never used again after removal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct FigureKey(pub u64);
