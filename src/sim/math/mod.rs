//! Scalars, lanes and small fixed-size algebra that the kernels are written in.
//!
//! Every kernel is generic over [`Lane`]: `f64` steps one figure, [`F64x8`] steps eight in lock-step. One rounding rule
//! holds for all of them: no fused multiply-add, and sine, cosine and arc tangent come from [`trig`], never from the
//! platform, so a figure gets the same bits alone, in a batch, and on any instruction set.

pub mod banded;
pub mod curve;
pub mod dense;
pub mod exp;
pub mod hash;
pub mod lane;
pub mod mat3;
mod nalgebra;
pub mod nnls;
pub mod polygon;
pub mod quat;
pub mod rotation_vector;
pub mod rounding;
pub mod runs;
pub mod trig;
pub mod vec3;

pub use lane::{F64x8, Lane};
pub use mat3::{Mat3, Sym3};
pub use quat::Quat;
pub use vec3::Vec3;
