//! Client constraints, as both controllers see them: the desired place of a point of a segment, the segment's desired
//! rotation, and the acceleration that brings it there.
//!
//! A goal is not a trajectory. From its present place the part moves at a speed proportional to the distance, with an
//! upper bound, and its acceleration is bounded: a goal out of reach pulls with a bounded acceleration, however far
//! away it is. If the place itself moves, all this is relative to it.

use crate::body::SegmentId;
use crate::body::topology::{HEAD, L_UPPER_ARM, PARENT, R_HAND};
use crate::dynamics::Terms;
use crate::math::{Quat, Vec3};

/// Most goals of one figure at once: the most constraints that can be set, plus the same number that may be fading.
pub const MAX_GOALS: usize = 16;
/// Share of an arm's length to which it stretches, and the distance beyond that which is still demanded of a point, m:
/// the trunk bends a little to follow.
const STRETCH: f64 = 0.97;
const BEYOND: f64 = 0.01;

/// Pace at which goals are approached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GoalPace {
    /// Time constant T, s: the speed settles at rate 1/T to 0.25/T times the distance, critically damped with 0.25/T²
    /// and 1/T; at most 4 T times the largest acceleration, so that it can be braked.
    pub horizon: f64,
    /// Largest acceleration of a point, m/s².
    pub most: f64,
    /// The same for a point that is not on an arm: whole-body motion.
    pub most_trunk: f64,
    /// Largest angular acceleration, rad/s².
    pub most_turn: f64,
}

/// The desired place of one part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstraintGoal {
    /// Segment.
    pub segment: SegmentId,
    /// Point, segment frame, m.
    pub point: Vec3,
    /// Desired position of the point, world, m.
    pub position: Option<Vec3>,
    /// Velocity of that place, world, m/s.
    pub velocity: Vec3,
    /// Weight of each world axis of the position, 0…1.
    pub axes: [f64; 3],
    /// `world_from_segment`.
    pub rotation: Option<Quat>,
    /// Weight, 0…1; a goal that comes or goes rises or falls.
    pub weight: f64,
}

impl ConstraintGoal {
    /// Difference of the desired position from the present one along the axes that count, world, m; zero without a
    /// desired position.
    pub fn distance(&self, terms: &Terms) -> Vec3 {
        let Some(wanted) = self.position else {
            return Vec3::zero();
        };
        self.difference(terms, wanted)
    }

    /// The displacement demanded of the point: not much more than an arm's reach, or the figure would be pulled along.
    fn reachable(&self, terms: &Terms) -> Vec3 {
        let Some(wanted) = self.position else {
            return Vec3::zero();
        };
        if !self.is_on_arm() {
            return self.difference(terms, wanted);
        }
        let s = self.segment.index();
        let mut length = self.point.norm();
        let mut root = terms.segment_position(s);
        for parent in self.limb().skip(1) {
            let next = terms.segment_position(parent);
            length += (root - next).norm();
            root = next;
        }
        let reach = STRETCH * length + BEYOND;
        self.difference(terms, root + (wanted - root).capped(reach))
    }

    fn difference(&self, terms: &Terms, wanted: Vec3) -> Vec3 {
        self.along_axes(wanted - terms.point_world(self.segment.index(), self.point))
    }

    /// The part of a vector along the axes that count.
    pub fn along_axes(&self, e: Vec3) -> Vec3 {
        let on = |e: f64, axis: f64| if axis > 0.0 { e } else { 0.0 };
        Vec3 {
            x: on(e.x, self.axes[0]),
            y: on(e.y, self.axes[1]),
            z: on(e.z, self.axes[2]),
        }
    }

    /// Rotation vector from the present to the desired rotation, world axes, rad; zero without a desired rotation.
    pub fn turn(&self, terms: &Terms) -> Vec3 {
        let Some(wanted) = self.rotation else {
            return Vec3::zero();
        };
        let now = Quat::from_mat3(&terms.segment_rotation(self.segment.index()));
        (wanted * now.conjugate()).log()
    }

    /// Demanded acceleration of the point along the axes that count, m/s².
    pub fn acceleration(&self, terms: &Terms, pace: &GoalPace) -> Vec3 {
        let v = terms.point_velocity(self.segment.index(), self.point) - self.velocity;
        let v = self.along_axes(v);
        let most = if self.is_on_arm() {
            pace.most
        } else {
            pace.most_trunk
        };
        demand(self.reachable(terms), v, pace.horizon, most)
    }

    /// The segments of the limb that the goal moves, from its own up to the trunk; none if it is on the trunk or on a
    /// leg, which carries.
    pub fn limb(&self) -> impl Iterator<Item = usize> + use<> {
        let free =
            |s: usize| s == HEAD.index() || (L_UPPER_ARM.index()..=R_HAND.index()).contains(&s);
        let first = Some(self.segment.index()).filter(|s| free(*s));
        std::iter::successors(first, move |s| Some(PARENT[*s]).filter(|p| free(*p)))
    }

    /// Whether it is on an arm.
    pub fn is_on_arm(&self) -> bool {
        (L_UPPER_ARM.index()..=R_HAND.index()).contains(&self.segment.index())
    }

    /// Demanded angular acceleration of the segment, world axes, rad/s².
    pub fn angular_acceleration(&self, terms: &Terms, pace: &GoalPace) -> Vec3 {
        let w = terms.kin.omega[self.segment.index()];
        demand(self.turn(terms), w, pace.horizon, pace.most_turn)
    }
}

fn demand(error: Vec3, rate: Vec3, t: f64, most: f64) -> Vec3 {
    (((error * (0.25 / t)).capped(4.0 * t * most) - rate) * (1.0 / t)).capped(most)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec3::vec3;

    #[test]
    fn a_point_comes_to_rest_at_its_goal_without_overshoot_and_within_bounds() {
        let dt = 1.0 / 60.0;
        for (distance, (t, bound)) in [0.02, 0.3, 2.0, 1e4]
            .into_iter()
            .flat_map(|d| [(0.033, 5.0), (0.05, 4.0)].map(|p| (d, p)))
        {
            let (mut x, mut v, mut most) = (0.0, 0.0, 0.0f64);
            for _ in 0..600 {
                let a = demand(vec3(distance - x, 0.0, 0.0), vec3(v, 0.0, 0.0), t, bound).x;
                v += a * dt;
                x += v * dt;
                most = most.max(a.abs());
                assert!(x < distance * 1.005 + 1e-3, "{x} of {distance}");
                assert!(v <= 4.0 * t * bound + 1e-9);
            }
            assert!(most <= bound * (1.0 + 1e-12));
            if distance < 5.0 {
                assert!((x - distance).abs() < 1e-4 && v.abs() < 1e-4);
            }
        }
    }
}
