//! Motions: recordings, built-in motions, clips and how they are sampled (paper §3.2).

pub mod arm_ik;
pub mod builtin;
pub mod bvh;
pub mod bvh_write;
pub mod clip;
pub mod filter;
pub mod leg_ik;
pub mod read;
pub mod recording;
pub mod skeleton;
pub mod skeleton_map;
pub mod table;
pub mod target;

pub use bvh::{Bvh, BvhError};
pub use bvh_write::write_bvh;
pub use clip::{Clip, ClipError, PlanarTransform};
pub use read::read;
pub use recording::{Recording, RecordingError, UpAxis};
pub use target::{Target, TargetPair};

/// Gravity for which motions are made and planned, and on which shares of the weight are based, m/s².
pub const GRAVITY: f64 = 9.81;
