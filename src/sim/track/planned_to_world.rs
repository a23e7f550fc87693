//! Where the motion lies in the world: a planar transform that follows the places where the feet really landed (WALKING
//! §2).

use crate::sim::math::exp::exp;
use crate::sim::math::{Quat, Vec3, trig};
use crate::sim::motion::PlanarTransform;

/// Time constant with which the motion moves to a new anchor, s.
const SETTLE: f64 = 0.04;
/// Share of the heading error of a landed foot that the motion takes over, and share of its heading that is given back
/// per step.
const HEADING_GAIN: f64 = 0.3;
const HEADING_HOME: f64 = 0.2;

/// Maps the motion as planned to the world. Pivots on the last foothold, so that a change of heading moves nothing far
/// away.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Anchor {
    /// Foothold as planned, m.
    planned: Vec3,
    /// Where it is now, m, and where it goes.
    at: Vec3,
    goal: Vec3,
    /// Turn about the vertical, rad, and where it goes.
    yaw: f64,
    yaw_goal: f64,
}

impl Anchor {
    /// Maps a planned place and heading to a real one at once.
    pub fn between(planned: (Vec3, f64), real: (Vec3, f64)) -> Self {
        let yaw = trig::wrapped(real.1 - planned.1);
        let level = |p: Vec3| Vec3 { z: 0.0, ..p };
        Self {
            planned: level(planned.0),
            at: level(real.0),
            goal: level(real.0),
            yaw,
            yaw_goal: yaw,
        }
    }

    /// What is mapped to `mapped` now goes to `real`; the heading stays.
    pub fn pin(&mut self, mapped: Vec3, real: Vec3) {
        let back = Quat::exp(Vec3::Z * -self.yaw).rotate(Vec3 {
            x: mapped.x - self.at.x,
            y: mapped.y - self.at.y,
            z: 0.0,
        });
        self.planned += back;
        self.at = Vec3 { z: 0.0, ..mapped };
        self.goal = Vec3 { z: 0.0, ..real };
    }

    /// Image of a planned point.
    pub fn point(&self, p: Vec3) -> Vec3 {
        let level = Vec3 {
            x: p.x - self.planned.x,
            y: p.y - self.planned.y,
            z: 0.0,
        };
        let q = Quat::exp(Vec3::Z * self.yaw).rotate(level);
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

    /// As a transform of whole targets.
    pub fn transform(&self) -> PlanarTransform {
        let origin = self.point(Vec3::zero());
        PlanarTransform {
            x: origin.x,
            y: origin.y,
            yaw: self.yaw,
        }
    }

    /// A foot planned at `planned`, heading `planned_yaw`, stands at `actual`, heading `actual_yaw`: the motion goes
    /// there.
    pub fn land(&mut self, planned: Vec3, planned_yaw: f64, actual: Vec3, actual_yaw: f64) {
        self.at = self.point(Vec3 { z: 0.0, ..planned });
        self.planned = Vec3 { z: 0.0, ..planned };
        self.goal = Vec3 { z: 0.0, ..actual };
        let off = trig::wrapped(actual_yaw - planned_yaw - self.yaw);
        self.yaw_goal = (1.0 - HEADING_HOME) * (self.yaw + HEADING_GAIN * off);
    }

    /// What is left of the way to the new anchor, m.
    pub fn rest(&self) -> Vec3 {
        self.goal - self.at
    }

    /// Moves on by `dt` seconds.
    pub fn settle(&mut self, dt: f64) {
        let a = 1.0 - exp(-dt / SETTLE);
        self.at += (self.goal - self.at) * a;
        self.yaw += (self.yaw_goal - self.yaw) * a;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_of_the_way_leads_from_the_motion_as_it_lies_to_the_foot() {
        let mut anchor = Anchor::default();
        let (planned, actual) = (Vec3::X * 0.4, Vec3::X * 0.5 + Vec3::Y * 0.2);
        assert_eq!(anchor.rest(), Vec3::zero());
        anchor.land(planned, 0.0, actual, 0.3);
        assert!((anchor.rest() - (actual - planned)).norm() < 1e-15);
        for _ in 0..60 {
            anchor.settle(1.0 / 60.0);
            assert!((anchor.point(planned) + anchor.rest() - actual).norm() < 1e-15);
        }
        assert!(anchor.rest().norm() < 1e-9);
    }
}
