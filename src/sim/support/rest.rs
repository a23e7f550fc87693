//! Supports other than the floor: parts of the body that lean on immovable things.

use super::contact_set::SupportPoint;
use crate::body::SegmentId;
use crate::math::{Mat3, Vec3};
use serde::{Deserialize, Serialize};

/// A part of the body that rests on an obstacle: a seat, a table, a wall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rest {
    /// The part.
    pub segment: SegmentId,
    /// Its position, world, m.
    pub position: Vec3,
    /// Unit vector from the obstacle to the part, world axes.
    pub normal: Vec3,
    /// Reaction that can be relied on, taken from the last ticks, world axes, N.
    pub force: Vec3,
    /// How much farther from the surface the motion places the part, as seen from the pelvis, m; positive for a hand
    /// that is about to leave the seat.
    pub lift: f64,
}

/// Vertex of a support point that is not a contact point of its segment.
pub const NO_VERTEX: usize = usize::MAX;

/// Smallest vertical component of the normal of a surface that can bear weight (60° of slope).
const LEVEL: f64 = 0.5;

impl Rest {
    /// Whether it can bear weight: a seat or a table can, a wall cannot.
    pub fn is_level(&self) -> bool {
        Self::level(self.normal)
    }

    /// Whether it keeps a body from falling this `way` (horizontal): a seat does, and so does a wall on that side.
    pub fn holds(&self, way: Vec3) -> bool {
        self.is_level() || self.normal.dot(way) <= 0.0
    }

    /// This rest as a support point, among which the reaction can be shared.
    pub fn as_point(&self) -> SupportPoint {
        SupportPoint {
            segment: self.segment,
            vertex: NO_VERTEX,
            support: self.segment,
            position: self.position,
            normal: self.normal,
        }
    }

    /// Two tangents and the normal as columns, if the surface with this normal is not horizontal.
    pub fn frame(normal: Vec3) -> Option<Mat3> {
        (normal != Vec3::Z).then(|| {
            let other = if normal.x.abs() < 0.6 {
                Vec3::X
            } else {
                Vec3::Y
            };
            let y = normal.cross(other).normalized_or(Vec3::X);
            Mat3 {
                x: y.cross(normal),
                y,
                z: normal,
            }
        })
    }

    /// Whether a surface with this normal can bear weight.
    pub fn level(normal: Vec3) -> bool {
        normal.z > LEVEL
    }
}
