//! Worlds by name: [`registry`] has them all, [`handle`] is one of them, [`waiting`] counts what its clients want of
//! it, [`usage`] when it was used last.

pub mod handle;
pub mod registry;
pub mod usage;

mod waiting;

pub use handle::{Stored, WorldHandle};
pub use registry::{Leaving, Registry};
