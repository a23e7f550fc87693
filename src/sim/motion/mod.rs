//! Desired motion: reading, retargeting, preparing, sampling (paper §3.2).

pub mod bvh;
pub mod target;

pub use bvh::{Bvh, BvhError};
pub use target::{Target, TargetPair};
