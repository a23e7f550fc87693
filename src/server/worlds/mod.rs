//! Worlds by name: [`registry`] has them all, [`handle`] is one of them, [`waiting`] counts its waiting commands by
//! client, and [`usage`] records its last use.

pub mod handle;
pub mod registry;
pub mod usage;

mod waiting;

pub use handle::{Persisted, WorldHandle};
pub use registry::{Leaving, Registry};
