//! Which contact points of which segments touch the floor, with hysteresis (`docs/tick.md`, stage 3).

use crate::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES};
use crate::body::{Body, SEGMENT_COUNT, SegmentId};
use crate::dynamics::Terms;
use crate::math::Vec3;
use crate::report::MAX_CONTACTS;
use serde::{Deserialize, Serialize};

/// A point that comes below this height touches, m.
pub const ENTER_HEIGHT: f64 = 0.006;
/// A touching point that rises above this height stops touching, m.
pub const LEAVE_HEIGHT: f64 = 0.010;
/// Number of contact points per segment that are checked, as in the stepper.
const POINTS_PER_SEGMENT: usize = MAX_CONTACTS / SEGMENT_COUNT;

/// One touching point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SupportPoint {
    /// Segment it belongs to.
    pub segment: SegmentId,
    /// Index in [`Segment::contact_points`](crate::body::Segment::contact_points).
    pub vertex: usize,
    /// The support to which it counts: the foot, for toes that touch together with their foot; otherwise the segment
    /// itself.
    pub support: SegmentId,
    /// World position, m.
    pub position: Vec3,
    /// Unit vector out of the surface, world axes: up, on the floor.
    #[serde(skip, default = "up")]
    pub normal: Vec3,
}

fn up() -> Vec3 {
    Vec3::Z
}

/// Touching points of one figure; remembers the last tick.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ContactSet {
    touching: [u64; SEGMENT_COUNT],
    points: Vec<SupportPoint>,
}

impl Default for ContactSet {
    fn default() -> Self {
        Self {
            touching: [0; SEGMENT_COUNT],
            points: Vec::with_capacity(MAX_CONTACTS),
        }
    }
}

impl ContactSet {
    /// Touching points, by segment, then by vertex.
    pub fn points(&self) -> &[SupportPoint] {
        &self.points
    }

    /// Forgets the last tick (after a reset of the figure).
    pub fn clear(&mut self) {
        self.touching = [0; SEGMENT_COUNT];
        self.points.clear();
    }

    /// Updates the contact points of the body: one below [`ENTER_HEIGHT`] enters, one above [`LEAVE_HEIGHT`] leaves.
    ///
    /// Only the first 8 points of each segment are checked, and at most [`MAX_CONTACTS`] touch. Allocates nothing.
    pub fn update(&mut self, terms: &Terms, body: &Body) {
        self.points.clear();
        for s in 0..SEGMENT_COUNT {
            let Some(segment) = SegmentId::new(s) else {
                continue;
            };
            let (origin, rotation) = (terms.segment_position(s), terms.segment_rotation(s));
            let mut touching = 0;
            let points = body.segments[s].contact_points.iter();
            for (vertex, local) in points.enumerate().take(POINTS_PER_SEGMENT) {
                let position = origin + rotation * *local;
                let bit = 1 << vertex;
                let limit = if self.touching[s] & bit != 0 {
                    LEAVE_HEIGHT
                } else {
                    ENTER_HEIGHT
                };
                if position.z < limit {
                    touching |= bit;
                    self.points.push(SupportPoint {
                        segment,
                        vertex,
                        support: segment,
                        position,
                        normal: Vec3::Z,
                    });
                }
            }
            self.touching[s] = touching;
        }
        // Toes count with their foot if the foot touches.
        for (toes, foot) in [(L_TOES, L_FOOT), (R_TOES, R_FOOT)] {
            if self.touching[foot.index()] != 0 {
                for p in self.points.iter_mut().filter(|p| p.segment == toes) {
                    p.support = foot;
                }
            }
        }
    }
}
