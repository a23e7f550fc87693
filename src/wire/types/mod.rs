//! Domain types of requests and frames: checked once at the edge, trusted afterwards.

mod clip;
mod control;
mod drive;
mod figure;
mod obstacle;
mod perturbation;
mod place;
mod simulation;
mod state;
mod world;

pub use clip::*;
pub use control::*;
pub use drive::*;
pub use figure::*;
pub use obstacle::*;
pub use perturbation::*;
pub use place::*;
pub use simulation::*;
pub use state::*;
pub use world::*;
