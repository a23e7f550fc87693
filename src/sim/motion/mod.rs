//! Desired motion: reading, retargeting, preparing, sampling (paper §3.2).

pub mod target;

pub use target::{Target, TargetPair};
