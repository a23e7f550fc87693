//! How the desired body follows when the map from the plan to the world moves.
//!
//! At a touch-down the map moves by `δ`, so that every foothold to come is exact at once. A body cannot jump: its
//! target stays where it is and follows. It is `Δ` away from its mapped place, with `Δ = −δ` at first, on the stable
//! mode of the pendulum, `Δ̇ = −ω Δ`. The target's capture point `c + Δ + (ċ − ω Δ)/ω = ξ` is then that of the moved
//! plan at once, and the error that the displaced foothold removes does not come back through the target. Feet do not
//! wait for the body: they are led to where the map has them, and follow it within [`SETTLING_TIME`].
//!
//! Legs are solved for those feet while `Δ` is small: they would press on the floor otherwise. A larger `Δ` would
//! stretch them; then they keep the angles of the plan.

use super::filter_gain;
use super::params::common::SETTLED_OFFSET;
use super::params::world_map::SETTLING_TIME;
use crate::body::topology::{DOF_LEN, DOF_START, FEET};
use crate::body::{Body, Posture};
use crate::control::FootTarget;
use crate::math::Vec3;
use crate::math::curve::fall;
use crate::math::exp::exp;
use crate::motion::leg_ik::{forward, leg_segments, solve_leg};
use crate::motion::{PlanarTransform, Target, TargetPair};
use crate::plan::toe_hinge;
use serde::{Deserialize, Serialize};

/// Displacements that body and feet of the target have still to make up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Trailing {
    /// The map that they come from.
    map: PlanarTransform,
    /// Displacement of the body on the stable mode, m.
    swaying: Vec3,
    /// Displacement of the body that is made up as feet make up theirs, m.
    settling: Vec3,
    /// Displacements of the ankles, m.
    feet: [Vec3; 2],
    /// Whether the body settles after the next move of the map.
    settles: bool,
    /// Whether legs are solved for their feet.
    legs_stand: bool,
}

impl Trailing {
    /// The map is now `map`, and the motion is expressed in its coordinates already.
    pub(super) fn rebase(&mut self, map: PlanarTransform) {
        self.map = map;
    }

    /// After the next move of the map the body settles as its feet do: something else leads its mass.
    pub(super) fn settle(&mut self) {
        self.settles = true;
    }

    /// The map has moved to `map`: what it now has at `pelvis` and `ankles` (world, m) stays where it was.
    pub(super) fn move_to(&mut self, map: PlanarTransform, pelvis: Vec3, ankles: [Vec3; 2]) {
        let (before, back) = (self.map, map.power(-1.0));
        let moved = |p: Vec3| (before.point(back.point(p)) - p).horizontal();
        if self.settles {
            self.settling += moved(pelvis);
        } else {
            self.swaying += moved(pelvis);
        }
        self.settles = false;
        for (foot, ankle) in self.feet.iter_mut().zip(ankles) {
            *foot += moved(ankle);
        }
        self.map = map;
    }

    /// Whether the map is still `map`.
    pub(super) fn is_at(&self, map: &PlanarTransform) -> bool {
        self.map == *map
    }

    /// Follows for `dt` seconds; `omega`: rate of the pendulum, 1/s. `legs_stand`: whether feet stand as the plan has
    /// them.
    pub(super) fn advance(&mut self, omega: f64, dt: f64, legs_stand: bool) {
        *self = self.after(omega, dt);
        self.legs_stand = legs_stand;
    }

    fn after(&self, omega: f64, dt: f64) -> Self {
        let settled = 1.0 - filter_gain(dt, SETTLING_TIME);
        let rest = |displacement: Vec3, left: f64| {
            if displacement.level() < f64::EPSILON.sqrt() {
                Vec3::zero()
            } else {
                displacement * left
            }
        };
        Self {
            swaying: rest(self.swaying, exp(-omega * dt)),
            settling: rest(self.settling, settled),
            feet: self.feet.map(|foot| rest(foot, settled)),
            ..*self
        }
    }

    /// Displacement of the body from its mapped place, m.
    fn body(&self) -> Vec3 {
        self.swaying + self.settling
    }

    /// Share of the solved legs, 0 to 1.
    fn solved(&self) -> f64 {
        if self.legs_stand {
            fall(self.body().level(), (SETTLED_OFFSET / 3.0, SETTLED_OFFSET))
        } else {
            0.0
        }
    }

    /// Displaces a target that the map has placed.
    pub(super) fn apply(&self, out: &mut TargetPair, body: &Body, omega: f64, dt: f64) {
        let later = self.after(omega, dt);
        self.displace(&mut out.now, body, omega, dt);
        later.displace(&mut out.next, body, omega, dt);
    }

    fn displace(&self, target: &mut Target, body: &Body, omega: f64, dt: f64) {
        let [left, right] = self.feet;
        let all = [self.swaying, self.settling, left, right];
        if all == [Vec3::zero(); 4] {
            return;
        }
        let solved = self.solved();
        if solved > 0.0 {
            let soon = dt / 16.0;
            let mut ahead = target.posture;
            ahead.integrate(&target.velocity, soon);
            self.solve_legs(&mut target.posture, body, solved);
            let later = self.after(omega, soon);
            later.solve_legs(&mut ahead, body, solved);
            let way = target.posture.joint_difference(&ahead);
            for i in leg_coordinates() {
                target.velocity[6 + i] = way[i] / soon;
            }
        }
        target.posture.root_position += self.body();
        target.velocity[3] -= omega * self.swaying.x;
        target.velocity[4] -= omega * self.swaying.y;
    }

    /// Solves the legs of a posture that is still at its mapped place for a body that will be displaced.
    fn solve_legs(&self, posture: &mut Posture, body: &Body, solved: f64) {
        let poses = forward(body, posture);
        for (side, foot) in FEET.into_iter().enumerate() {
            let (ankle, rotation) = poses[foot.index()];
            let at = ankle + (self.feet[side] - self.body()) * solved;
            let toe = posture.hinge[toe_hinge(side)];
            solve_leg(body, posture, side == 0, (at, rotation), toe);
        }
    }

    /// Places the feet of that target. Their velocity is the map's: a foot that would be asked to make up the rest in
    /// [`SETTLING_TIME`] would be thrown.
    pub(super) fn release(&self, feet: &mut [FootTarget; 2], omega: f64, dt: f64) {
        let later = self.after(omega, dt);
        let [now, next] = [self, &later].map(|t| 1.0 - t.solved());
        for (side, foot) in feet.iter_mut().enumerate() {
            let ankle = &mut foot.ankle;
            ankle.now += (self.feet[side] - self.body()) * now;
            ankle.next += (later.feet[side] - later.body()) * next;
            ankle.now_velocity += self.swaying * (omega * now);
            ankle.next_velocity += later.swaying * (omega * next);
        }
    }
}

/// Coordinates of the joints of the legs.
fn leg_coordinates() -> impl Iterator<Item = usize> {
    let segments = [true, false].into_iter().flat_map(leg_segments);
    segments.flat_map(|s| DOF_START[s.index()]..DOF_START[s.index()] + DOF_LEN[s.index()])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::{PointTarget, RotationTarget};
    use crate::math::Quat;
    use crate::motion::builtin::at_ease;
    use crate::motion::leg_ik::center_of_mass;

    const OMEGA: f64 = 3.2;
    const DT: f64 = 1.0 / 120.0;

    /// A body that stands still while the map moves by `by` (m), `ticks` ticks later.
    struct Moved {
        body: Body,
        /// Target at the mapped place, and as displaced.
        placed: Target,
        out: TargetPair,
        trailing: Trailing,
    }

    impl Moved {
        fn new(by: Vec3, ticks: usize) -> Self {
            let body = Body::adult_man();
            let map = PlanarTransform {
                x: by.x,
                y: by.y,
                yaw: 0.0,
            };
            let placed = map.apply(&Target::still(at_ease(&body)));
            let mut trailing = Trailing::default();
            let ankles = Self::ankles(&body, &placed);
            trailing.move_to(map, placed.posture.root_position, ankles);
            for _ in 0..ticks {
                trailing.advance(OMEGA, DT, true);
            }
            let mut out = TargetPair {
                now: placed.clone(),
                next: placed.clone(),
            };
            trailing.apply(&mut out, &body, OMEGA, DT);
            Self {
                body,
                placed,
                out,
                trailing,
            }
        }

        fn ankles(body: &Body, target: &Target) -> [Vec3; 2] {
            let poses = forward(body, &target.posture);
            FEET.map(|s| poses[s.index()].0)
        }

        fn com(&self, target: &Target) -> Vec3 {
            center_of_mass(&self.body, &forward(&self.body, &target.posture))
        }

        /// Ankles at the start of the tick, as they are led.
        fn led(&self) -> [Vec3; 2] {
            let at = |now: Vec3, next: Vec3| FootTarget {
                ankle: PointTarget {
                    now,
                    next,
                    now_velocity: Vec3::zero(),
                    next_velocity: Vec3::zero(),
                },
                rotation: RotationTarget {
                    now: Quat::identity(),
                    next: Quat::identity(),
                    now_velocity: Vec3::zero(),
                    next_velocity: Vec3::zero(),
                },
            };
            let (now, next) = (&self.out.now, &self.out.next);
            let [a, b] = [now, next].map(|t| Self::ankles(&self.body, t));
            let mut feet = [at(a[0], b[0]), at(a[1], b[1])];
            self.trailing.release(&mut feet, OMEGA, DT);
            feet.map(|foot| foot.ankle.now)
        }
    }

    #[test]
    fn the_body_stays_where_it_was_and_its_capture_point_is_that_of_the_moved_plan() {
        let by = Vec3::X * 0.08 - Vec3::Y * 0.05;
        for ticks in [0, 1, 40] {
            let moved = Moved::new(by, ticks);
            let mapped = moved.com(&moved.placed);
            let now = moved.com(&moved.out.now);
            let rate = (moved.com(&moved.out.next) - now) * (1.0 / DT);
            let v = moved.out.now.velocity;
            let capture = now + Vec3::on_floor([v[3], v[4]]) * (1.0 / OMEGA);
            assert!((capture - mapped).horizontal().norm() < 1e-12);
            assert!((rate - Vec3::on_floor([v[3], v[4]])).norm() < 0.5 * OMEGA * OMEGA * 0.1 * DT);
            let left = by * exp(-OMEGA * DT * ticks as f64);
            assert!((mapped - now - left).norm() < 1e-12, "{ticks}");
        }
    }

    #[test]
    fn feet_start_where_they_were_and_are_in_place_long_before_the_body() {
        let by = Vec3::X * 0.1;
        let [start, later] = [0, 24].map(|ticks| Moved::new(by, ticks));
        for side in 0..2 {
            let mapped = Moved::ankles(&start.body, &start.placed)[side];
            assert!((start.led()[side] - (mapped - by)).norm() < 1e-12);
            assert!((later.led()[side] - mapped).norm() < 1e-3);
        }
        assert!((later.com(&later.out.now) - later.com(&later.placed)).norm() > 0.04);
    }

    #[test]
    fn a_body_that_is_nearly_in_place_stands_on_its_footholds() {
        let moved = Moved::new(Vec3::X * 0.02, 60);
        let now = &moved.out.now;
        let off = (moved.com(now) - moved.com(&moved.placed)).norm();
        assert!(off > 0.002);
        let mut ahead = now.posture;
        ahead.integrate(&now.velocity, DT);
        let ahead = Target::still(ahead);
        let stand = Moved::ankles(&moved.body, &moved.placed);
        for target in [now, &moved.out.next, &ahead] {
            let ankles = Moved::ankles(&moved.body, target);
            for (ankle, foothold) in ankles.into_iter().zip(stand) {
                assert!((ankle - foothold).norm() < 0.02 * off);
            }
        }
    }
}
