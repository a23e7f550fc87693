//! Desired motion: reading, retargeting, preparing, sampling (paper §3.2).

pub mod bvh;
pub mod leg_ik;
pub mod target;
#[cfg(test)]
mod test_body;

pub use bvh::{Bvh, BvhError};
pub use target::{Target, TargetPair};
