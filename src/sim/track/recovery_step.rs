//! Steps that no clip plans: to catch a body that its feet can no longer stop (the paper's future work), and to bring
//! the feet back together.
//!
//! Where the capture point will be when the foot lands is where the foot goes; the unloaded foot swings, across the
//! other one if the body falls to the side it would have to come from. Pure functions of the state plus a few numbers
//! of memory; nothing allocates.

use crate::sim::control::{PointTarget, RotationTarget};
use crate::sim::math::curve::{arc, smootherstep};
use crate::sim::math::exp::exp;
use crate::sim::math::{Quat, Vec3, trig};
use crate::sim::plan::foot_lock::Sole;

/// The capture point is lost when it leaves the support by this much, m: what arms and trunk bring back without a step.
pub(super) const LOST: f64 = 0.02;
/// Beyond this distance no step helps, m.
pub(super) const HOPELESS: f64 = 0.6;
/// Length of a swing that catches, and of one that only tidies up, s. People who are pushed take 0.15–0.3 s; at 0.35 s
/// a push to the side is lost before the foot is there.
const CATCH_TIME: f64 = 0.25;
const TIDY_TIME: f64 = 0.5;
const ALONE_TIME: f64 = 0.35;
/// Least time in the air before touching the floor counts as landing, share of the swing.
const LANDS_AFTER: f64 = 0.5;
/// A raised foot whose ankle is this much higher than where it stands has not landed if its toes touch, m.
const HANGS: f64 = 0.04;
/// Height of the ankle's arc, m.
const ARC: f64 = 0.07;
/// Farthest step forward, backward, to the side, and across, in leg lengths.
const FARTHEST: (f64, f64, f64, f64) = (0.75, 0.65, 0.6, 0.35);
/// A foot that crosses passes this far before or behind the other, m.
const CROSS_ROOM: f64 = 0.18;
/// Closer than this to the stance foot counts as crossing, m.
pub(super) const BESIDE: f64 = 0.1;
/// A capture point this far on the other side of the stance foot is beyond its sole, m; who crosses it lands this much
/// beyond that, m; who does not stands this wide, leg lengths.
const UNDER: f64 = 0.03;
const BEYOND: f64 = 0.12;
pub(super) const WIDTH: f64 = 0.18;
/// Distance of the middle of the sole before the ankle, m.
pub(super) const SOLE_MIDDLE: f64 = 0.05;
/// Speed of a foot that looks for the floor, m/s.
const LOWERING: f64 = 0.5;
/// Speed at which the body is leaned over one foot, m/s.
pub(super) const LEAN_SPEED: f64 = 0.25;
/// Feet farther than this from where the motion has them are brought back, m and rad.
pub(super) const UNTIDY: (f64, f64) = (0.04, 0.2);

/// What a step is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// To catch the body, across the stance foot if it has to be.
    Catch,
    /// To catch the body on the foot's own side, where feet have crossed or a clip has just ended.
    CatchBeside,
    /// To catch the body with the raised foot, where the other one stands alone for long.
    CatchAlone,
    /// To bring the foot back to its place.
    Tidy,
}

/// A step under way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecoveryStep {
    /// Swinging foot: 0 left, 1 right.
    pub side: usize,
    /// Time since lift-off, s.
    pub since: f64,
    /// What it is for.
    pub purpose: Purpose,
    start: Vec3,
    start_yaw: f64,
    goal: Vec3,
    goal_yaw: f64,
    /// Of a raised foot: it comes from behind the other one.
    behind: bool,
}

/// Places of both feet: point of the floor under the flat ankle and heading.
pub(super) type Places = [(Vec3, f64); 2];

impl RecoveryStep {
    /// A step of foot `side` whose ankle and heading are these now.
    pub(super) fn new(side: usize, purpose: Purpose, ankle: Vec3, yaw: f64) -> Self {
        Self {
            side,
            since: 0.0,
            purpose,
            start: ankle,
            start_yaw: yaw,
            goal: Vec3 { z: 0.0, ..ankle },
            goal_yaw: yaw,
            behind: false,
        }
    }

    /// The same of a raised foot, which passes the other one on its own side, behind or before it.
    pub(super) fn alone(side: usize, ankle: Vec3, yaw: f64, behind: bool) -> Self {
        Self {
            behind,
            ..Self::new(side, Purpose::CatchAlone, ankle, yaw)
        }
    }

    /// Length of the swing, s.
    pub fn duration(&self) -> f64 {
        match self.purpose {
            Purpose::Tidy => TIDY_TIME,
            Purpose::Catch | Purpose::CatchBeside => CATCH_TIME,
            Purpose::CatchAlone => ALONE_TIME,
        }
    }

    /// True once touching the floor means having landed.
    pub(super) fn may_land(&self, flat: f64, ankle: f64) -> bool {
        let hangs = self.purpose == Purpose::CatchAlone && ankle > flat + HANGS;
        self.since > LANDS_AFTER * self.duration() && !hangs
    }

    /// True if the floor did not come for long after it should have.
    pub(super) fn overdue(&self) -> bool {
        self.since > self.duration() + 0.15
    }

    /// Aims at where the capture point will be at landing.
    ///
    /// * `xi`: capture point, m; `zmp`: where the zero-moment point can hold it best, m; `omega`: of the pendulum, 1/s.
    /// * `home`: places that the motion has for the feet, `now`: where they are; `leg`: length of a leg, m.
    pub(super) fn aim(
        &mut self,
        xi: [f64; 2],
        zmp: [f64; 2],
        omega: f64,
        (home, now): (&Places, &Places),
        leg: f64,
    ) {
        let side = self.side;
        let alone = self.purpose == Purpose::CatchAlone;
        // The motion has a raised foot turned as it likes.
        self.goal_yaw = if alone { now[1 - side].1 } else { home[side].1 };
        if self.purpose == Purpose::Tidy {
            self.goal = home[side].0;
            return;
        }
        let remaining = (self.duration() - self.since).clamp(0.0, 1.0);
        let grows = exp(omega * remaining);
        let away = [xi[0] - zmp[0], xi[1] - zmp[1]];
        let level = |x: f64, y: f64| Vec3 { x, y, z: 0.0 };
        let landing = level(zmp[0] + away[0] * grows, zmp[1] + away[1] * grows);
        let stance = now[1 - side].0;
        let yaw = self.goal_yaw;
        let back = Quat::exp(Vec3::Z * -yaw);
        let local = back.rotate(landing - level(stance.x, stance.y));
        let outward = if side == 0 { 1.0 } else { -1.0 };
        let apart = back.rotate(home[side].0 - home[1 - side].0).y * outward;
        let mut x = local.x - SOLE_MIDDLE;
        let wanted = local.y * outward;
        let y = if alone {
            if wanted > -UNDER {
                wanted.max(WIDTH * leg)
            } else {
                x = if self.behind {
                    x.min(-CROSS_ROOM)
                } else {
                    x.max(CROSS_ROOM)
                };
                (wanted - BEYOND).min(-BESIDE)
            }
        } else if wanted > BESIDE {
            wanted.max(apart)
        } else if wanted > -BESIDE || self.purpose == Purpose::CatchBeside {
            apart.max(BESIDE)
        } else {
            let room = if x > -0.05 { CROSS_ROOM } else { -CROSS_ROOM };
            x = if room > 0.0 { x.max(room) } else { x.min(room) };
            wanted
        };
        let x = x.clamp(-FARTHEST.1 * leg, FARTHEST.0 * leg);
        let y = y.clamp(-FARTHEST.3 * leg, FARTHEST.2 * leg) * outward;
        let goal = Quat::exp(Vec3::Z * yaw).rotate(level(x, y)) + level(stance.x, stance.y);
        // Late changes of mind trip.
        if remaining > 0.06 {
            self.goal = goal;
        }
    }

    /// Pose of the swinging foot `ahead` seconds from now: ankle, heading.
    fn pose(&self, sole: &Sole, ahead: f64) -> (Vec3, f64) {
        let u = ((self.since + ahead) / self.duration()).clamp(0.0, 1.0);
        let s = smootherstep(u);
        let mut p = self.start + (self.goal - self.start) * s;
        let over = (self.since + ahead - self.duration()).max(0.0);
        let flat = self.start.z + (sole.ankle_height - self.start.z) * s;
        p.z = flat + arc(ARC, u) - LOWERING * over;
        (
            p,
            self.start_yaw + trig::wrapped(self.goal_yaw - self.start_yaw) * s,
        )
    }

    /// Target of the swinging foot over the tick of `dt` seconds that begins now.
    pub(super) fn lead(&self, sole: &Sole, dt: f64, target: &mut (PointTarget, RotationTarget)) {
        let at = |t: f64| self.pose(sole, t);
        let (p0, p1, p2) = (at(0.0), at(dt), at(2.0 * dt));
        let turn = |yaw: f64| Quat::exp(Vec3::Z * yaw);
        target.0 = PointTarget {
            now: p0.0,
            now_velocity: (p1.0 - p0.0) * (1.0 / dt),
            next: p1.0,
            next_velocity: (p2.0 - p1.0) * (1.0 / dt),
        };
        target.1 = RotationTarget {
            now: turn(p0.1),
            now_velocity: Vec3::Z * ((p1.1 - p0.1) / dt),
            next: turn(p1.1),
            next_velocity: Vec3::Z * ((p2.1 - p1.1) / dt),
        };
    }
}
