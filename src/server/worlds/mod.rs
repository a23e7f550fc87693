//! Worlds by name.

pub mod registry;

pub use registry::{Registry, WorldHandle};
