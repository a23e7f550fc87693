//! The map from the plan to the world: a planar transform that follows the real footholds.
//!
//! A point `p` of the plan lies at `a + R(ψ)(p − q)`: `q` is the last foothold as planned, `a` its place in the world,
//! `ψ` the turn of the plan. At a touch-down `q` becomes the new foothold and `a` its measured place, and `ψ`
//! approaches a share of the measured heading error, as a first-order filter. The map pivots on the last foothold, so a
//! change of heading moves nothing far away. How the body follows a map that moves: [`super::trailing`].

use super::filter_gain;
use super::foot_places::{FootPlace, turn};
use super::params::world_map::{HEADING_GAIN, HEADING_RETURN, SETTLING_TIME};
use crate::math::{Vec3, trig};
use crate::motion::PlanarTransform;
use serde::{Deserialize, Serialize};

/// The map at one time, and the map that it approaches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Anchor {
    /// Foothold as planned, m.
    planned: Vec3,
    /// Its place in the world, m.
    at: Vec3,
    /// Turn about the vertical now, rad.
    yaw: f64,
    /// The turn that it approaches, rad.
    yaw_goal: f64,
}

impl Anchor {
    /// Maps a planned place to a real one at once.
    pub fn between(planned: FootPlace, real: FootPlace) -> Self {
        let yaw = trig::wrapped(real.yaw - planned.yaw);
        Self {
            planned: planned.at.horizontal(),
            at: real.at.horizontal(),
            yaw,
            yaw_goal: yaw,
        }
    }

    /// Moves the image that is now at `mapped` (world, m) to `real`; the heading stays.
    pub fn pin(&mut self, mapped: Vec3, real: Vec3) {
        self.planned += turn(-self.yaw).rotate((mapped - self.at).horizontal());
        self.at = real.horizontal();
    }

    /// Image of a planned point, m.
    pub fn point(&self, p: Vec3) -> Vec3 {
        let q = turn(self.yaw).rotate((p - self.planned).horizontal());
        Vec3 {
            x: self.at.x + q.x,
            y: self.at.y + q.y,
            z: p.z,
        }
    }

    /// Turn about the vertical, rad.
    pub fn yaw(&self) -> f64 {
        self.yaw
    }

    /// The map as a transform of whole targets.
    pub fn transform(&self) -> PlanarTransform {
        let origin = self.point(Vec3::zero());
        PlanarTransform {
            x: origin.x,
            y: origin.y,
            yaw: self.yaw,
        }
    }

    /// Re-anchors the plan: a foot planned at `planned` with heading `planned_yaw` stands at `actual` with heading
    /// `actual_yaw`.
    pub fn land(&mut self, planned: Vec3, planned_yaw: f64, actual: Vec3, actual_yaw: f64) {
        self.planned = planned.horizontal();
        self.at = actual.horizontal();
        let off = trig::wrapped(actual_yaw - planned_yaw - self.yaw);
        self.yaw_goal = (1.0 - HEADING_RETURN) * (self.yaw + HEADING_GAIN * off);
    }

    /// Turns to the heading of the new anchor for `dt` seconds.
    pub fn settle(&mut self, dt: f64) {
        let a = filter_gain(dt, SETTLING_TIME);
        self.yaw += (self.yaw_goal - self.yaw) * a;
    }

    /// Leads the plan back to its own place by this share of the way: a carried figure is with its motion, not with its
    /// footholds.
    pub fn go_home(&mut self, share: f64) {
        self.at += (self.planned - self.at) * share;
        self.yaw *= 1.0 - share;
        self.yaw_goal *= 1.0 - share;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_foothold_is_exact_at_once_and_the_plan_turns_about_it() {
        let mut anchor = Anchor::default();
        let (planned, actual) = (Vec3::X * 0.4, Vec3::X * 0.5 + Vec3::Y * 0.2);
        anchor.land(planned, 0.0, actual, 0.3);
        let before = anchor.yaw();
        for _ in 0..60 {
            assert!((anchor.point(planned) - actual).norm() < 1e-15);
            anchor.settle(1.0 / 60.0);
        }
        assert!(before == 0.0 && anchor.yaw() > 0.05);
    }

    #[test]
    fn a_plan_that_goes_home_comes_to_lie_where_it_was_planned() {
        let planned = FootPlace {
            at: Vec3::X,
            yaw: 0.1,
        };
        let real = FootPlace {
            at: Vec3::X * 1.3 + Vec3::Y * 0.2,
            yaw: 0.6,
        };
        let mut anchor = Anchor::between(planned, real);
        let far = Vec3::X * 3.0 - Vec3::Y;
        let mut last = (anchor.point(far) - far).norm();
        for _ in 0..600 {
            anchor.go_home(0.03);
            let off = (anchor.point(far) - far).norm();
            assert!(off < last);
            last = off;
        }
        assert!(last < 1e-6 && anchor.yaw().abs() < 1e-6, "{last} m");
    }
}
