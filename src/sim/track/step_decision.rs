//! Decides when an unplanned step is made, and which one: to catch the body, to uncross the feet, or to bring them
//! back.

use super::foot_places::{FootPlace, FootPlaces, stance_points};
use super::params::common::SETTLED_OFFSET;
use super::params::recovery::{
    ASTRAY, FOOTHOLD_DISTANCE, HOPELESS_MARGIN, LOST_MARGIN, SHIFT_DONE, SHIFT_SPEED,
};
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
        let height = Self::ankle(terms, side).z;
        if step.has_landed(sole, height, self.touches(terms, side)) {
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
            }
            waiting.begin_shift_at(off);
        }
    }

    /// The step that the body needs, while none is under way; `nearest`: the point of the support nearest to the
    /// capture point.
    fn decide_step(
        &self,
        terms: &Terms,
        support: &Support,
        [now, home]: [&FootPlaces; 2],
        nearest: &Closest,
    ) -> UnplannedStep {
        let (before, xi, margin) = (self.recovery.step, self.capture.point(), nearest.margin);
        let mut supports = support.points().iter().map(|p| p.support);
        let falls = Vec3::on_floor(xi) - Vec3::on_floor(nearest.point);
        let held = support.holds(falls);
        let on_feet = supports.all(|s| FEET.contains(&s) || TOES.contains(&s));
        if held || !on_feet || margin < -HOPELESS_MARGIN {
            return before;
        }
        let swings = |side: usize, purpose: Purpose, unloaded: Option<usize>| {
            let step = RecoveryStep::new(side, purpose, Self::ankle(terms, side), now[side].yaw);
            UnplannedStep::Swinging { step, unloaded }
        };
        // The foot that carries less swings.
        let carried =
            |side: usize| support.load()[FEET[side].index()] + support.load()[TOES[side].index()];
        let uncrosses = self.uncrossing_foot(now, xi);
        let side = uncrosses.unwrap_or_else(|| usize::from(carried(1) <= carried(0)));
        let beside = now[1 - side].local(now[side].at).y * outward(side);
        // Feet that a clip will move again stay where it has them, if they hold the body.
        let goes_on = |p: &StepPlan| !p.is_live() && !p.is_over(self.clock.phase);
        let own = !self.is_stopping() && self.plan().is_some_and(goes_on);
        let crossed = !own && beside < 0.5 * FOOTHOLD_DISTANCE;
        // In walking the capture point leaves the feet on purpose; for a body off its plan it does not.
        let meant = own && self.capture.off() < ASTRAY;
        let lost = if uncrosses.is_some() {
            0.0
        } else {
            -LOST_MARGIN
        };
        if crossed {
            return swings(side, Purpose::RecoverOnOwnSide, None);
        }
        if margin < lost && !meant {
            return swings(side, Purpose::Recover, None);
        }
        if own {
            return before;
        }
        if let UnplannedStep::Unloading(side) = before {
            let way = Vec3::on_floor(xi) - sole_middle(&now[1 - side]).horizontal();
            return if way.norm() < SETTLED_OFFSET {
                swings(side, Purpose::Return, Some(side))
            } else {
                before
            };
        }
        let settled = terms.com_velocity.norm() < REST_SPEED
            && self.capture.off() < SETTLED_OFFSET
            && self.recovery.shift.norm() < SHIFT_DONE;
        let misplaced = (0..2).find(|k| settled && is_misplaced(&now[*k], &home[*k]));
        misplaced.map_or(UnplannedStep::None, UnplannedStep::Unloading)
    }
}

/// Whether a foot is not where it is meant to be.
pub(super) fn is_misplaced(is: &FootPlace, meant: &FootPlace) -> bool {
    (is.at - meant.at).norm() > MISPLACED_BY
        || trig::wrapped(is.yaw - meant.yaw).abs() > MISPLACED_TURN
}
