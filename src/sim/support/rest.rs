//! What carries a figure besides the floor: parts that lean on things that do not give way.

use super::contact_set::SupportPoint;
use crate::body::SegmentId;
use crate::math::{Mat3, Vec3};
use serde::{Deserialize, Serialize};

/// A part of the body that rests on an obstacle: a seat, a table, a wall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rest {
    /// The part.
    pub segment: SegmentId,
    /// Where, world, m.
    pub position: Vec3,
    /// Unit vector from the obstacle to the part, world axes.
    pub normal: Vec3,
    /// Reaction that can be counted on, world axes, N: that of the last ticks.
    pub force: Vec3,
    /// How much farther from the surface the motion has the part, as seen from the pelvis, m: a hand that is to leave
    /// the seat.
    pub lift: f64,
}

/// Vertex of a support point that is no contact point of its segment.
pub const NO_VERTEX: usize = usize::MAX;

/// Least height of the normal of a surface that weight can be put on (60° of slope).
const LEVEL: f64 = 0.5;

impl Rest {
    /// True if weight can be put there: a seat or a table, not a wall.
    pub fn is_level(&self) -> bool {
        Self::level(self.normal)
    }

    /// True if it keeps a body from falling this `way` (horizontal): a seat does, and a wall on that side.
    pub fn holds(&self, way: Vec3) -> bool {
        self.is_level() || self.normal.dot(way) <= 0.0
    }

    /// The same as a point of a support that the reaction can be shared with.
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

    /// The same of a surface with this normal.
    pub fn level(normal: Vec3) -> bool {
        normal.z > LEVEL
    }
}
