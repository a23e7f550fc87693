//! Reports of contacts with other bodies: plain data.

use crate::body::SegmentId;
use crate::math::Vec3;
use serde::{Deserialize, Serialize};

/// Identity of an obstacle in a world; never used again after removal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct ObstacleKey(pub u64);

/// An object that a body touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Other {
    /// A segment of another figure, by the number of its key.
    Figure(u64, SegmentId),
    /// An obstacle.
    Obstacle(ObstacleKey),
}

/// One pair of parts that touched during a tick, seen from one of the two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Touch {
    /// Own segment.
    pub segment: SegmentId,
    /// The object that it touches.
    pub other: Other,
    /// Place, world, m: mean of the touching points, weighted by their normal impulse.
    pub position: Vec3,
    /// Mean force over the tick on this body, world axes, N.
    pub force: Vec3,
    /// Unit vector from the other body to this one, world axes.
    pub normal: Vec3,
    /// Deepest overlap of the two at the start of any substep, m; 0 if they only touch.
    pub depth: f64,
}

/// Largest number of pairs of parts that one figure reports in a tick.
pub const MAX_TOUCHES: usize = 64;

/// Largest number of contacts between bodies in one island; beyond this, the shallowest are left out.
pub const MAX_ISLAND_CONTACTS: usize = 160;
