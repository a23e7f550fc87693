//! Worlds by name.

pub mod registry;
pub mod usage;

pub use registry::{Leaving, Registry, Stored, WorldHandle};
