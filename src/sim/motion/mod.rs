//! Desired motion: reading, retargeting, preparing, sampling (paper §3.2).

pub mod builtin;
pub mod bvh;
pub mod bvh_write;
mod chart;
pub mod clip;
pub mod leg_ik;
pub mod target;

pub use bvh::{Bvh, BvhError};
pub use bvh_write::write_bvh;
pub use clip::{Clip, ClipError, PlanarTransform};
pub use target::{Target, TargetPair};
