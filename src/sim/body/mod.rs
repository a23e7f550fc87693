//! The articulated body: tree, segments, limits, mass and shape, and the positions and velocities of one figure.

pub mod age;
pub mod angles;
pub mod export;
pub mod geometry;
pub mod humanoid;
pub mod links;
pub mod model;
pub mod palm;
pub mod provenance;
mod shape;
pub mod state;
pub mod topology;

pub use links::Links;
pub use model::{Body, Mesh, Profile, Segment, Sex};
pub use state::{Posture, State};
pub use topology::{DOF_COUNT, NV, SEGMENT_COUNT, SegmentId};
