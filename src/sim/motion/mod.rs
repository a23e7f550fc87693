//! Desired motion: reading, retargeting, preparing, sampling (paper §3.2).

pub mod ascent;
pub mod balance;
mod banded;
pub mod builtin;
pub mod bvh;
pub mod bvh_write;
mod chart;
pub mod clip;
pub mod consistency;
pub mod contacts;
pub mod cycle;
pub mod ends;
pub mod envelope;
pub mod filter;
pub mod foot_lock;
pub mod join;
pub mod leg_ik;
pub mod live;
pub mod one_foot;
pub mod polygon;
pub mod prepare;
pub mod retarget;
mod run_gait;
mod running;
pub mod skeleton_map;
pub mod target;
pub mod transition;
mod walked;

/// Gravity that motions are prepared for, m/s².
const GRAVITY: f64 = 9.81;

pub use bvh::{Bvh, BvhError};
pub use bvh_write::write_bvh;
pub use clip::{Clip, ClipError, PlanarTransform};
pub use cycle::cycle;
pub use live::LiveMotion;
pub use retarget::{RetargetError, RetargetOptions, RetargetReport, Retargeted, UpAxis, retarget};
pub use target::{Target, TargetPair};
