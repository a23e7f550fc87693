//! Places of feet: their actual and planned places, and the points on which they stand.

use super::params::contact::TOUCH_HEIGHT;
use super::{Footfall, Legs, StepTracker};
use crate::body::topology::{FEET, TOES};
use crate::body::{Body, Posture};
use crate::control::FootTarget;
use crate::dynamics::{Placement, Terms};
use crate::math::{Quat, Vec3, trig};
use crate::motion::leg_ik::forward;
use crate::plan::foot_lock::{AnklePose, FootPlacement};
use crate::support::Support;
use serde::{Deserialize, Serialize};

/// The place of a foot, or of a stance on both feet.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FootPlace {
    /// Point of the floor under the flat ankle, or the middle between those of both feet, m.
    pub at: Vec3,
    /// Heading of the foot, or the mean of both headings, rad.
    pub yaw: f64,
}

impl FootPlace {
    /// A world point (m) as seen from the foot: `x` ahead, `y` to the left.
    pub(super) fn local(&self, p: Vec3) -> Vec3 {
        turn(-self.yaw).rotate(p - self.at)
    }

    /// World point at `offset` (m) in the axes of the foot.
    pub(super) fn offset(&self, offset: Vec3) -> Vec3 {
        self.at + turn(self.yaw).rotate(offset)
    }
}

/// Places of the left and of the right foot.
pub(super) type FootPlaces = [FootPlace; 2];

/// Rotation by `yaw` (rad) about the vertical.
pub(super) fn turn(yaw: f64) -> Quat {
    Quat::exp(Vec3::Z * yaw)
}

/// Touching points, on the floor, of the foot that stands while `side` swings. The swinging foot no longer carries
/// anything, even while it still touches.
pub(super) fn stance_points(support: &Support, side: usize) -> impl Iterator<Item = [f64; 2]> + '_ {
    let stance = [FEET[1 - side], TOES[1 - side]];
    let points = support.points().iter();
    points
        .filter(move |p| stance.contains(&p.segment))
        .map(|p| p.position.xy())
}

/// The middle between two feet with the mean of their headings.
pub(super) fn middle(feet: &FootPlaces) -> FootPlace {
    FootPlace {
        at: (feet[0].at + feet[1].at) * 0.5,
        yaw: feet[0].yaw + 0.5 * trig::wrapped(feet[1].yaw - feet[0].yaw),
    }
}

impl Legs {
    /// Corners of the sole of a foot, world, m.
    pub(super) fn sole_points<'a>(
        &'a self,
        terms: &'a Terms,
        side: usize,
    ) -> impl Iterator<Item = Vec3> + 'a {
        let parts = self.soles[side].parts().into_iter();
        parts.flat_map(move |(s, points)| {
            points.iter().map(move |p| terms.point_world(s.index(), *p))
        })
    }
}

impl StepTracker {
    /// The stance of the feet.
    pub fn stance(&self, placement: &Placement) -> FootPlace {
        middle(&self.places(placement))
    }

    /// The stance of the feet in a posture.
    pub fn stance_of(&self, body: &Body, posture: &Posture) -> FootPlace {
        let poses = forward(body, posture);
        let places = std::array::from_fn(|k| self.place_of(k, AnklePose::of(&poses, k)));
        middle(&places)
    }

    /// Place of a foot with this pose.
    pub(super) fn place_of(&self, side: usize, pose: AnklePose) -> FootPlace {
        let FootPlacement { place, yaw, .. } = self.legs.soles[side].footing(pose);
        FootPlace { at: place, yaw }
    }

    /// Places of the feet.
    pub(super) fn places(&self, placement: &Placement) -> FootPlaces {
        [0, 1].map(|side| {
            let s = FEET[side].index();
            let rotation = Quat::from_mat3(&placement.segment_rotation(s));
            let at = placement.segment_position(s);
            self.place_of(side, AnklePose { at, rotation })
        })
    }

    /// Places of the feet in the desired motion.
    pub(super) fn planned_places(&self, feet: &[FootTarget; 2]) -> FootPlaces {
        std::array::from_fn(|k| {
            let (at, rotation) = (feet[k].ankle.now, feet[k].rotation.now);
            self.place_of(k, AnklePose { at, rotation })
        })
    }

    /// Height of the lowest point of a sole, m.
    pub(super) fn lowest(&self, terms: &Terms, side: usize) -> f64 {
        self.legs
            .sole_points(terms, side)
            .map(|p| p.z)
            .fold(f64::INFINITY, f64::min)
    }

    /// Whether a sole touches the floor.
    pub(super) fn touches(&self, terms: &Terms, side: usize) -> bool {
        self.lowest(terms, side) < TOUCH_HEIGHT
    }

    /// A foothold of the plan, placed by the origin of the plan.
    pub(super) fn placed(&self, f: &Footfall) -> FootPlace {
        let origin = self.followed.as_ref().map(|f| f.origin).unwrap_or_default();
        FootPlace {
            at: origin.point(f.place),
            yaw: f.yaw + origin.yaw,
        }
    }

    /// A foothold of the plan, as the map places it in the world now.
    pub(super) fn mapped(&self, f: &Footfall) -> FootPlace {
        let placed = self.placed(f);
        FootPlace {
            at: self.anchor.point(placed.at),
            yaw: self.anchor.yaw() + placed.yaw,
        }
    }

    /// Ankle of a foot, world, m.
    pub(super) fn ankle(terms: &Terms, side: usize) -> Vec3 {
        terms.segment_position(FEET[side].index())
    }
}
