//! Decides when an unplanned step is made, and which one: to catch the body, to uncross the feet, or to bring them
//! back.

use super::capture_point::within_reach;
use super::foot_places::{FootPlace, FootPlaces, stance_points};
use super::params::capture::REACH_ALONG;
use super::params::contact::FASTEST_RATE;
use super::params::recovery::{
    ASTRAY, FOOTHOLD_DISTANCE, HOPELESS_MARGIN, LOST_MARGIN, RETURN_STEP_TIME, SHIFT_DONE,
    SHIFT_SPEED, STARTING_STEPS,
};
use super::params::support_recovery::PLANNED_STEP_ERROR;
use super::recovery_step::{Aim, Purpose, RecoveryStep};
use super::step_plan::StepPlan;
use super::{Landing, StepTracker, TaskTargets};
use crate::body::topology::{FEET, TOES, outward};
use crate::dynamics::Terms;
use crate::math::polygon::Closest;
use crate::math::{Vec3, trig};
use crate::plan::params::common::{MISPLACED_BY, MISPLACED_TURN, REST_SPEED, SOLE_MIDDLE};
use crate::support::Support;
use serde::{Deserialize, Serialize};

/// The unplanned step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) enum UnplannedStep {
    /// None is made.
    #[default]
    None,
    /// The weight shifts from this foot to the other one, so that this foot can be brought back.
    Unloading(usize),
    /// A foot swings.
    Swinging {
        /// Its step.
        step: RecoveryStep,
        /// The foot that was unloaded before.
        unloaded: Option<usize>,
    },
}

impl UnplannedStep {
    /// Whether this value is one that a checkpoint could hold: there are two feet.
    pub(super) fn is_valid(&self) -> bool {
        match self {
            Self::None => true,
            Self::Unloading(side) => *side < 2,
            Self::Swinging { step, unloaded } => step.side < 2 && unloaded.is_none_or(|s| s < 2),
        }
    }

    /// The step, while the foot swings.
    pub(super) fn swing(&self) -> Option<&RecoveryStep> {
        match self {
            Self::Swinging { step, .. } => Some(step),
            _ => None,
        }
    }

    /// The step to change it, while the foot swings.
    pub(super) fn swing_mut(&mut self) -> Option<&mut RecoveryStep> {
        match self {
            Self::Swinging { step, .. } => Some(step),
            _ => None,
        }
    }

    /// The foot that the weight is kept off.
    fn unloaded(&self) -> Option<usize> {
        match *self {
            Self::None => None,
            Self::Unloading(side) => Some(side),
            Self::Swinging { unloaded, .. } => unloaded,
        }
    }

    /// Begins a step. A foot that was unloaded stays unloaded.
    pub(super) fn begin(&mut self, step: RecoveryStep) {
        *self = Self::Swinging {
            step,
            unloaded: self.unloaded(),
        };
    }
}

/// The point of the floor over which a body stands on one foot.
fn sole_middle(foot: &FootPlace) -> Vec3 {
    foot.offset(Vec3::X * SOLE_MIDDLE)
}

impl StepTracker {
    /// Updates the unplanned step: one is made when the capture point has left the feet, and afterwards the feet are
    /// brought back. `places`: the places of the feet, actual and in the motion.
    pub(super) fn update_recovery_step(
        &mut self,
        terms: &Terms,
        support: &Support,
        dt: f64,
        [now, home]: [&FootPlaces; 2],
        tasks: &mut TaskTargets<'_>,
    ) {
        let xi = self.capture.point();
        let Some(nearest) = support.polygon().closest(xi) else {
            return;
        };
        if self.recovery_step().is_none() {
            self.recovery.step = self.decide_step(terms, support, [now, home], &nearest);
        }
        // The centre of mass moves over the foot that will stand alone, and back.
        let over = self.recovery.step.unloaded().map(|k| &now[1 - k]);
        let wanted = over.map(|foot| sole_middle(foot) - tasks.com.now);
        let way = (wanted.unwrap_or_default() - self.recovery.shift).horizontal();
        self.recovery.shift += way.capped(SHIFT_SPEED * dt);
        tasks.com.shift(self.recovery.shift);

        let Some(step) = self.recovery.step.swing_mut() else {
            return;
        };
        let side = step.side;
        let sole = &self.legs.soles[side];
        step.update_goal(&Aim {
            xi,
            zmp: self.capture.holding_zmp(stance_points(support, side)),
            omega: self.capture.omega(),
            now,
            home,
            leg: self.legs.length,
        });
        tasks.feet[side] = step.target(sole, dt);
        let step = *step;
        let ankle = Self::ankle(terms, side);
        if step.has_landed(sole, ankle, self.touches(terms, side)) {
            self.recovery.step = UnplannedStep::None;
            self.feet[side].down = true;
            let moved = now[side].at - home[side].at;
            self.events.landing = Some(Landing {
                side,
                late: step.since - step.duration(),
                off: moved,
            });
            let waiting = &mut self.recovery.support;
            let mut off = terms.com - (tasks.com.now - waiting.shift());
            if step.purpose != Purpose::Return && waiting.foot() != Some(side) {
                self.anchor.pin(home[side].at, now[side].at);
                off -= moved;
                if waiting.is_active() {
                    self.trailing.settle();
                }
            }
            waiting.begin_shift_at(off);
        }
    }

    /// Begins a recovery step in a double support with which a clip starts, if the body falls and the next planned step
    /// would not catch it. Later the planned step, early and displaced, is better than a stop.
    pub(super) fn step_out_of_start(
        &mut self,
        terms: &Terms,
        support: &Support,
        [now, home]: [&FootPlaces; 2],
    ) {
        let starts = self.clock.landings <= STARTING_STEPS && !self.is_live();
        let stands = self.feet[0].down && self.feet[1].down;
        if !(starts && stands) || self.recovery_step().is_some() || self.capture.off() < ASTRAY {
            return;
        }
        let xi = self.capture.point();
        let Some(nearest) = support.polygon().closest(xi) else {
            return;
        };
        let outside = (-HOPELESS_MARGIN..-LOST_MARGIN).contains(&nearest.margin);
        let falls = Vec3::on_floor(xi) - Vec3::on_floor(nearest.point);
        if !outside || support.holds(falls) || !on_feet(support) || self.catches(terms) {
            return;
        }
        let side = self.easier_foot(terms, support, [now, home]);
        let ankle = Self::ankle(terms, side);
        self.timing.early = None;
        let step = RecoveryStep::new(side, Purpose::Recover, ankle, now[side].yaw);
        self.recovery.step.begin(step);
    }

    /// Whether the next planned step, as early and as far displaced as it can be, leaves little of the error.
    fn catches(&self, terms: &Terms) -> bool {
        let next = (0..2).filter_map(|side| Some((side, self.next(side)?)));
        let Some((side, f)) = next.min_by(|a, b| a.1.on.total_cmp(&b.1.on)) else {
            return false;
        };
        let remaining = self.until(f.on);
        let d = self.capture.left_over(remaining / FASTEST_RATE);
        let stance = Self::ankle(terms, 1 - side);
        let can = within_reach(d, self.mapped(&f), stance, side, REACH_ALONG);
        let left = Vec3::on_floor([d[0] - can[0], d[1] - can[1]]).level();
        left < PLANNED_STEP_ERROR
    }

    /// The foot whose recovery step leaves the capture point nearer to the line between the feet: `ξ` at its landing,
    /// about the best zero-moment point of the other foot, against the two soles; a loaded foot has to be unloaded
    /// first.
    fn easier_foot(
        &mut self,
        terms: &Terms,
        support: &Support,
        [now, home]: [&FootPlaces; 2],
    ) -> usize {
        let load =
            |side: usize| support.load()[FEET[side].index()] + support.load()[TOES[side].index()];
        let all = (load(0) + load(1)).max(1e-6);
        let left = [0, 1].map(|side| {
            if load(1 - side) <= 0.0 {
                return f64::INFINITY;
            }
            let zmp = self.capture.holding_zmp(stance_points(support, side));
            let mut step = RecoveryStep::new(
                side,
                Purpose::Recover,
                Self::ankle(terms, side),
                now[side].yaw,
            );
            step.update_goal(&Aim {
                xi: self.capture.point(),
                zmp,
                omega: self.capture.omega(),
                now,
                home,
                leg: self.legs.length,
            });
            let xi = Vec3::on_floor(self.capture.pendulum(zmp, step.duration()));
            let stance = sole_middle(&now[1 - side]).horizontal();
            let way = step.lands_on() - stance;
            let share = ((xi - stance).dot(way) / way.dot(way).max(1e-6)).clamp(0.0, 1.0);
            (xi - stance - way * share).level() + PLANNED_STEP_ERROR * load(side) / all
        });
        usize::from(left[1] <= left[0])
    }

    /// The step that the body needs, while none is under way; `nearest`: the point of the support nearest to the
    /// capture point.
    fn decide_step(
        &mut self,
        terms: &Terms,
        support: &Support,
        [now, home]: [&FootPlaces; 2],
        nearest: &Closest,
    ) -> UnplannedStep {
        let (before, xi, margin) = (self.recovery.step, self.capture.point(), nearest.margin);
        let falls = Vec3::on_floor(xi) - Vec3::on_floor(nearest.point);
        let held = support.holds(falls);
        if held || !on_feet(support) || margin < -HOPELESS_MARGIN {
            return before;
        }
        let swings = |side: usize, purpose: Purpose, unloaded: Option<usize>| {
            let step = RecoveryStep::new(side, purpose, Self::ankle(terms, side), now[side].yaw);
            UnplannedStep::Swinging { step, unloaded }
        };
        let uncrosses = self.uncrossing_foot(now, xi);
        // Feet that a clip will move again stay where it has them, if they hold the body.
        let goes_on = |p: &StepPlan| !p.is_live() && !p.is_over(self.clock.phase);
        let own = !self.is_stopping() && self.plan().is_some_and(goes_on);
        let beside = |side: usize| now[1 - side].local(now[side].at).y * outward(side);
        let crossed = |side: usize| !own && beside(side) < 0.5 * FOOTHOLD_DISTANCE;
        // In walking the capture point leaves the feet on purpose; for a body off its plan it does not.
        let meant = own && self.capture.off() < ASTRAY;
        let lost = if uncrosses.is_some() {
            0.0
        } else {
            -LOST_MARGIN
        };
        let side = match uncrosses {
            Some(side) => side,
            None if margin < lost || crossed(0) || crossed(1) => {
                self.easier_foot(terms, support, [now, home])
            }
            None => 0,
        };
        if crossed(side) {
            return swings(side, Purpose::RecoverOnOwnSide, None);
        }
        if margin < lost && !meant {
            return swings(side, Purpose::Recover, None);
        }
        if own {
            return before;
        }
        // Steps of a stream that come soon put its feet in place by themselves.
        let due = |side: usize| {
            let stance = self.planned(side);
            stance.is_some_and(|f| self.until(f.off) < RETURN_STEP_TIME)
        };
        if self.is_live() && !self.is_stopping() && (due(0) || due(1)) {
            return UnplannedStep::None;
        }
        if let UnplannedStep::Unloading(side) = before {
            let way = Vec3::on_floor(xi) - sole_middle(&now[1 - side]).horizontal();
            return if way.norm() < ASTRAY {
                swings(side, Purpose::Return, Some(side))
            } else {
                before
            };
        }
        let settled = terms.com_velocity.norm() < REST_SPEED
            && self.capture.off() < ASTRAY
            && self.recovery.shift.norm() < SHIFT_DONE;
        let misplaced = (0..2).find(|k| settled && is_misplaced(&now[*k], &home[*k]));
        misplaced.map_or(UnplannedStep::None, UnplannedStep::Unloading)
    }
}

/// Whether nothing but feet carries the body.
fn on_feet(support: &Support) -> bool {
    let mut supports = support.points().iter().map(|p| p.support);
    supports.all(|s| FEET.contains(&s) || TOES.contains(&s))
}

/// Whether a foot is not where it is meant to be.
pub(super) fn is_misplaced(is: &FootPlace, meant: &FootPlace) -> bool {
    (is.at - meant.at).norm() > MISPLACED_BY
        || trig::wrapped(is.yaw - meant.yaw).abs() > MISPLACED_TURN
}
