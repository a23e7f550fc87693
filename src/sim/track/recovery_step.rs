//! Recovery steps: unplanned steps that catch a body which its feet can no longer stop (the paper's future work), or
//! bring the feet back to their places.
//!
//! The foot goes where the capture point will be at the landing, `ξ(t) = p + (ξ − p) e^{ωt}` about the best zero-moment
//! point `p` of the stance foot. The unloaded foot swings, and crosses the other one if the body falls to that side. A
//! step is a function of the state and of a few numbers of memory; nothing allocates.

use super::foot_places::{FootPlaces, turn};
use super::params::capture::LONGEST_FORECAST;
use super::params::common::{FREEZE_TIME, LOWERING_SPEED};
use super::params::contact::LATEST;
use super::params::recovery::{
    ARC_HEIGHT, BEYOND, CROSSED_LENGTH, FARTHEST_ACROSS, FARTHEST_ASIDE, FARTHEST_BACKWARD,
    FARTHEST_FORWARD, FOOTHOLD_DISTANCE, HANGING_HEIGHT, LANDS_AFTER, RAISED_STEP_TIME,
    RETURN_STEP_TIME, SOLE_HALF_WIDTH, STANCE_WIDTH, STEP_TIME,
};
use crate::body::topology::outward;
use crate::control::{FootTarget, PointTarget, RotationTarget};
use crate::math::curve::{arc, smootherstep};
use crate::math::exp::exp;
use crate::math::{Vec3, trig};
use crate::plan::foot_lock::Sole;
use crate::plan::params::common::{MISPLACED_BY, SOLE_MIDDLE};
use serde::{Deserialize, Serialize};

/// Purpose of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Purpose {
    /// To catch the body, crossing the stance foot if necessary.
    Recover,
    /// To catch the body on the foot's own side, because feet have crossed or a clip has just ended.
    RecoverOnOwnSide,
    /// To catch the body with the raised foot, in a long stance on the other one.
    RecoverWithRaisedFoot,
    /// To bring a misplaced foot back to its place.
    Return,
}

/// A step under way.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecoveryStep {
    /// Swinging foot: 0 left, 1 right.
    pub side: usize,
    /// Time since lift-off, s.
    pub since: f64,
    /// Its purpose.
    pub purpose: Purpose,
    start: Vec3,
    start_yaw: f64,
    goal: Vec3,
    goal_yaw: f64,
    /// Distance of the capture point from the sole as it lands, m.
    leaves: f64,
    /// Whether a raised foot passes behind the other one rather than before it.
    behind: bool,
}

/// The data with which a step is aimed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aim<'a> {
    /// Capture point, m.
    pub(super) xi: [f64; 2],
    /// Zero-moment point that slows it most, m.
    pub(super) zmp: [f64; 2],
    /// Frequency of the pendulum, 1/s.
    pub(super) omega: f64,
    /// Places of the feet.
    pub(super) now: &'a FootPlaces,
    /// Places of the feet in the motion.
    pub(super) home: &'a FootPlaces,
    /// Length of a leg, m.
    pub(super) leg: f64,
}

impl RecoveryStep {
    /// A step of foot `side`, whose present ankle (world, m) and heading (rad) are given.
    pub(super) fn new(side: usize, purpose: Purpose, ankle: Vec3, yaw: f64) -> Self {
        Self {
            side,
            since: 0.0,
            purpose,
            start: ankle,
            start_yaw: yaw,
            goal: ankle.horizontal(),
            goal_yaw: yaw,
            leaves: 0.0,
            behind: false,
        }
    }

    /// A step of a raised foot, which passes the other one on its own side, behind or before it.
    pub(super) fn of_raised_foot(side: usize, ankle: Vec3, yaw: f64, behind: bool) -> Self {
        Self {
            behind,
            ..Self::new(side, Purpose::RecoverWithRaisedFoot, ankle, yaw)
        }
    }

    /// Length of the swing, s.
    pub fn duration(&self) -> f64 {
        match self.purpose {
            Purpose::Return => RETURN_STEP_TIME,
            Purpose::Recover | Purpose::RecoverOnOwnSide => STEP_TIME,
            Purpose::RecoverWithRaisedFoot => RAISED_STEP_TIME,
        }
    }

    /// Whether the step is over: the foot `touches` with this ankle (m), or it has missed the floor for too long. A
    /// foot whose toes are still where they stood rolls off.
    pub(super) fn has_landed(&self, sole: &Sole, ankle: Vec3, touches: bool) -> bool {
        let raised = self.purpose == Purpose::RecoverWithRaisedFoot;
        let hangs = raised && ankle.z > sole.ankle_height + HANGING_HEIGHT;
        let rolls_off = self.since < 0.9 * self.duration() && self.covered(ankle) < LANDS_AFTER;
        let may_land = self.since > LANDS_AFTER * self.duration() && !hangs && !rolls_off;
        self.since > self.duration() + LATEST || (may_land && touches)
    }

    /// Updates the landing place.
    pub(super) fn update_goal(&mut self, aim: &Aim<'_>) {
        let (side, now, home) = (self.side, aim.now, aim.home);
        let raised = self.purpose == Purpose::RecoverWithRaisedFoot;
        // The motion turns a raised foot in any direction.
        let yaw = if raised {
            now[1 - side].yaw
        } else {
            home[side].yaw
        };
        self.goal_yaw = yaw;
        if self.purpose == Purpose::Return {
            self.goal = home[side].at;
            return;
        }
        let remaining = (self.duration() - self.since).clamp(0.0, LONGEST_FORECAST);
        let grows = exp(aim.omega * remaining);
        let landing = std::array::from_fn(|k| aim.zmp[k] + (aim.xi[k] - aim.zmp[k]) * grows);
        let stance = now[1 - side].at.horizontal();
        let back = turn(-yaw);
        let outward = outward(side);
        // From here on, as seen from the stance foot: `x` ahead, `y` to the side of the swinging foot.
        let local = back.rotate(Vec3::on_floor(landing) - stance);
        let apart = back.rotate(home[side].at - home[1 - side].at).y * outward;
        let mut x = local.x - SOLE_MIDDLE;
        let wanted = local.y * outward;
        let crosses = |x: f64, behind: bool| {
            if behind {
                x.min(-CROSSED_LENGTH)
            } else {
                x.max(CROSSED_LENGTH)
            }
        };
        let y = if raised && wanted > -SOLE_HALF_WIDTH {
            wanted.max(STANCE_WIDTH * aim.leg)
        } else if raised {
            x = crosses(x, self.behind);
            (wanted - BEYOND).min(-FOOTHOLD_DISTANCE)
        } else if wanted > FOOTHOLD_DISTANCE {
            wanted.max(apart)
        } else if wanted > -FOOTHOLD_DISTANCE || self.purpose == Purpose::RecoverOnOwnSide {
            apart.max(FOOTHOLD_DISTANCE)
        } else {
            x = crosses(x, x <= -SOLE_MIDDLE);
            wanted
        };
        let x = x.clamp(-FARTHEST_BACKWARD * aim.leg, FARTHEST_FORWARD * aim.leg);
        let y = y.clamp(-FARTHEST_ACROSS * aim.leg, FARTHEST_ASIDE * aim.leg) * outward;
        // A goal that changes late makes the foot trip.
        if remaining > FREEZE_TIME {
            self.goal = turn(yaw).rotate(Vec3::on_floor([x, y])) + stance;
        }
        self.leaves = (Vec3::on_floor(landing) - self.lands_on()).level();
    }

    /// Distance that a step which catches the body leaves between it and the capture point, m; `None` for a return.
    pub(super) fn leaves(&self) -> Option<f64> {
        (self.purpose != Purpose::Return).then_some(self.leaves)
    }

    /// The middle of the sole where it lands, m.
    pub(super) fn lands_on(&self) -> Vec3 {
        self.goal.horizontal() + turn(self.goal_yaw).rotate(Vec3::X * SOLE_MIDDLE)
    }

    /// Share of its way over the floor that a foot with this ankle (m) has covered.
    fn covered(&self, ankle: Vec3) -> f64 {
        let way = (self.goal - self.start).horizontal();
        let gone = (ankle - self.start).horizontal();
        if way.level() < MISPLACED_BY {
            1.0
        } else {
            gone.dot(way) / way.dot(way)
        }
    }

    /// Pose of the swinging foot `ahead` seconds from now: ankle, heading.
    fn pose(&self, sole: &Sole, ahead: f64) -> (Vec3, f64) {
        let u = ((self.since + ahead) / self.duration()).clamp(0.0, 1.0);
        let s = smootherstep(u);
        let mut p = self.start + (self.goal - self.start) * s;
        let over = (self.since + ahead - self.duration()).max(0.0);
        let flat = self.start.z + (sole.ankle_height - self.start.z) * s;
        p.z = flat + arc(ARC_HEIGHT, u) - LOWERING_SPEED * over;
        (
            p,
            self.start_yaw + trig::wrapped(self.goal_yaw - self.start_yaw) * s,
        )
    }

    /// Target of the swinging foot over the tick of `dt` seconds that begins now.
    pub(super) fn target(&self, sole: &Sole, dt: f64) -> FootTarget {
        let at = |t: f64| self.pose(sole, t);
        let (p0, p1, p2) = (at(0.0), at(dt), at(2.0 * dt));
        FootTarget {
            ankle: PointTarget {
                now: p0.0,
                now_velocity: (p1.0 - p0.0) * (1.0 / dt),
                next: p1.0,
                next_velocity: (p2.0 - p1.0) * (1.0 / dt),
            },
            rotation: RotationTarget {
                now: turn(p0.1),
                now_velocity: Vec3::Z * ((p1.1 - p0.1) / dt),
                next: turn(p1.1),
                next_velocity: Vec3::Z * ((p2.1 - p1.1) / dt),
            },
        }
    }
}
