//! One figure, one tick. The stages are listed in [`tick`].

pub mod balance;
pub mod constraints;
pub mod events;
pub mod loads;
pub mod motion;
pub mod params;
pub mod state;
pub mod tick;
pub mod touches;

pub use crate::report::{Audit, ContactPoint, Flags, TickReport};
pub use crate::setup::{
    ControlParams, ControllerKind, FigureOptions, FigureSetup, HeldLoad, Metric, Perturbation,
    Priority, SecondHand, Share, StepperKind, StrengthScale,
};
pub use crate::tick_context::{Planning, TickContext};
pub use constraints::{Constrained, Constraint, MAX_CONSTRAINTS};
pub use events::FigureEvent;
pub use loads::disturbances::LoadShare;
pub use motion::clip_playback::ClipPlayback;
pub use motion::following::{FollowMode, Following};
pub use motion::plan_task::{LatePlans, PlanRequest};
pub use motion::rehearsal_playback::RehearsedPlayback;
pub use motion::rehearsed::RehearsedMotion;
pub use motion::source::{LivePlayback, MotionSource};
pub(crate) use state::saved::SavedFigure;
pub(crate) use state::workspace::WorkspaceSlot;
pub use state::{Figure, FigureKey};
