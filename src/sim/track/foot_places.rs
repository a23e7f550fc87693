//! Where the feet stand, are meant to stand, and what they stand on.

use super::{FOOT, Footfall, StepTracker, TOES, recovery_step};
use crate::sim::body::{Body, Posture};
use crate::sim::control::{PointTarget, RotationTarget};
use crate::sim::dynamics::Terms;
use crate::sim::math::{Quat, Vec3, trig};
use crate::sim::motion::leg_ik::forward;
use crate::sim::support::Support;

/// Touching points of the foot that stands while `side` swings, on the floor: the swinging one carries nothing any
/// more, even while it still touches.
pub(super) fn stance_points(support: &Support, side: usize) -> impl Iterator<Item = [f64; 2]> + '_ {
    let stance = [FOOT[1 - side], TOES[1 - side]];
    let points = support.points().iter();
    points
        .filter(move |p| stance.contains(&p.segment))
        .map(|p| [p.position.x, p.position.y])
}

/// The middle between two feet, and the mean of their headings, rad.
pub(super) fn middle(feet: &recovery_step::Places) -> (Vec3, f64) {
    let yaw = feet[0].1 + 0.5 * trig::wrapped(feet[1].1 - feet[0].1);
    ((feet[0].0 + feet[1].0) * 0.5, yaw)
}

/// A point of the floor.
pub(super) fn level(p: [f64; 2]) -> Vec3 {
    Vec3 {
        x: p[0],
        y: p[1],
        z: 0.0,
    }
}

impl StepTracker {
    /// Where the feet stand: the middle between them and the mean of their headings, rad.
    pub fn stance(&self, terms: &Terms) -> (Vec3, f64) {
        middle(&self.places(terms))
    }

    /// The same of a posture.
    pub fn stance_of(&self, body: &Body, posture: &Posture) -> (Vec3, f64) {
        let poses = forward(body, posture);
        middle(&std::array::from_fn(|k| {
            self.place_of(k, poses[FOOT[k].index()])
        }))
    }

    /// Point of the floor on which a foot with this pose stands, or would, and its heading.
    pub(super) fn place_of(&self, side: usize, pose: (Vec3, Quat)) -> (Vec3, f64) {
        self.soles[side].footing(pose).place_and_yaw()
    }

    /// Where a foot is.
    pub(super) fn place(&self, terms: &Terms, side: usize) -> (Vec3, f64) {
        let s = FOOT[side].index();
        let rotation = Quat::from_mat3(&terms.segment_rotation(s));
        self.place_of(side, (terms.segment_position(s), rotation))
    }

    /// Where the feet are.
    pub(super) fn places(&self, terms: &Terms) -> recovery_step::Places {
        [0, 1].map(|k| self.place(terms, k))
    }

    /// Where they are meant to be.
    pub(super) fn meant(&self, feet: &[(PointTarget, RotationTarget); 2]) -> recovery_step::Places {
        std::array::from_fn(|k| {
            let (p, r) = &feet[k];
            self.place_of(k, (p.now, r.now))
        })
    }

    /// Height of the lowest point of a sole, m.
    pub(super) fn lowest(&self, terms: &Terms, side: usize) -> f64 {
        let mut low = f64::INFINITY;
        for (s, points) in [
            (FOOT[side].index(), self.soles[side].foot_points()),
            (TOES[side].index(), self.soles[side].toe_points()),
        ] {
            for p in points {
                low = low.min(terms.point_world(s, *p).z);
            }
        }
        low
    }

    /// A foothold of the clip where its origin puts it.
    pub(super) fn placed(&self, f: &Footfall) -> Footfall {
        Footfall {
            place: self.origin.point(f.place),
            yaw: f.yaw + self.origin.yaw,
            ..*f
        }
    }
}
