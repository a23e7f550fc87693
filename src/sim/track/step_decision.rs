//! When a step is made that no clip planned, and which: to catch the body, to uncross the feet, to bring them home.

use super::recovery_step;
use super::recovery_step::{Purpose, RecoveryStep};
use super::step_plan::StepPlan;
use super::{FOOT, Landing, SETTLED, StepTracker, TOES, TOUCH, TaskTargets, level, stance_points};
use crate::sim::dynamics::Terms;
use crate::sim::math::{Quat, Vec3, trig};
use crate::sim::support::Support;

/// A capture point this far from where the clip has it is not where it is meant to be, m.
pub(super) const ASTRAY: f64 = 0.06;

impl StepTracker {
    /// Steps that no clip planned: catches a body whose capture point has left its feet, then brings the feet back
    /// together.
    pub(super) fn catch(
        &mut self,
        terms: &Terms,
        support: &Support,
        dt: f64,
        (now, home): (&recovery_step::Places, &recovery_step::Places),
        tasks: &mut TaskTargets<'_>,
    ) {
        let xi = self.capture.point();
        let Some(nearest) = support.polygon().closest(xi) else {
            return;
        };
        if self.step.is_none() {
            self.decide(terms, support, now, home, (xi, nearest.margin));
        }
        // Lean over the foot that is going to stand alone, and back.
        let leaning = self.tidying.map(|side| {
            let (place, yaw) = now[1 - side];
            place + Quat::exp(Vec3::Z * yaw).rotate(Vec3::X * recovery_step::SOLE_MIDDLE)
                - tasks.com.now
        });
        let wanted = leaning.unwrap_or_default();
        let way = Vec3 {
            z: 0.0,
            ..wanted - self.lean
        };
        let most = recovery_step::LEAN_SPEED * dt;
        let far = way.norm();
        self.lean += if far > most { way * (most / far) } else { way };
        tasks.com.now += self.lean;
        tasks.com.next += self.lean;

        let Some(step) = &mut self.step else { return };
        let zmp = self.capture.hold(stance_points(support, step.side), xi);
        step.aim(xi, zmp, self.capture.omega(), (home, now), self.leg);
        step.lead(&self.soles[step.side], dt, &mut tasks.feet[step.side]);
        let step = *step;
        let ankle = terms.segment_position(FOOT[step.side].index()).z;
        if step.overdue()
            || (step.may_land(self.soles[step.side].ankle_height, ankle)
                && self.lowest(terms, step.side) < TOUCH)
        {
            self.step = None;
            self.tidying = None;
            self.feet[step.side].down = true;
            self.landing = Some(Landing {
                side: step.side,
                late: step.since - step.duration(),
                off: now[step.side].0 - home[step.side].0,
            });
            let mut off = terms.com - (tasks.com.now - self.wait.shift());
            if step.purpose != Purpose::Tidy && !self.wait.is_for(step.side) {
                self.anchor.pin(home[step.side].0, now[step.side].0);
                off -= now[step.side].0 - home[step.side].0;
            }
            self.wait.begin_at(off);
        }
    }

    /// Begins a step if the body needs one.
    fn decide(
        &mut self,
        terms: &Terms,
        support: &Support,
        now: &recovery_step::Places,
        home: &recovery_step::Places,
        (xi, margin): ([f64; 2], f64),
    ) {
        let points = support.points().iter();
        let on_feet = support.rests().is_empty()
            && points
                .map(|p| p.support)
                .all(|s| FOOT.contains(&s) || TOES.contains(&s));
        let start = |side: usize, purpose: Purpose| {
            let ankle = terms.segment_position(FOOT[side].index());
            Some(RecoveryStep::new(side, purpose, ankle, now[side].1))
        };
        if !on_feet || margin < -recovery_step::HOPELESS {
            return;
        }
        // The foot that carries less swings.
        let carried =
            |side: usize| support.load()[FOOT[side].index()] + support.load()[TOES[side].index()];
        let uncrosses = self.uncrosses(now, xi);
        let side = uncrosses.unwrap_or_else(|| usize::from(carried(1) <= carried(0)));
        // Places to the own side of the stance foot are positive.
        let outward = |p: Vec3| {
            let (at, yaw) = now[1 - side];
            let y = Quat::exp(Vec3::Z * -yaw).rotate(p - at).y;
            if side == 0 { y } else { -y }
        };
        // Feet that a clip is about to move again stay where it has them, if they hold the body.
        let goes_on = |p: &StepPlan| !p.is_live() && !p.is_over(self.phase);
        let own = self.ended.is_none() && self.plan.as_ref().is_some_and(goes_on);
        let crossed = !own && outward(now[side].0) < 0.5 * recovery_step::BESIDE;
        // A body that walks leaves its feet on purpose; one that is off its plan does not.
        let meant = own && self.capture.off() < ASTRAY;
        let lost = if uncrosses.is_some() {
            0.0
        } else {
            -recovery_step::LOST
        };
        if (margin < lost && !meant) || crossed {
            self.tidying = None;
            self.step = start(
                side,
                if crossed {
                    Purpose::CatchBeside
                } else {
                    Purpose::Catch
                },
            );
            return;
        }
        if own {
            return;
        }
        if let Some(side) = self.tidying {
            let over = now[1 - side];
            let stance =
                over.0 + Quat::exp(Vec3::Z * over.1).rotate(Vec3::X * recovery_step::SOLE_MIDDLE);
            if (level(xi) - level([stance.x, stance.y])).norm() < SETTLED.1 {
                self.step = start(side, Purpose::Tidy);
            }
            return;
        }
        let settled = terms.com_velocity.norm() < SETTLED.0
            && self.capture.off() < SETTLED.1
            && self.lean.norm() < 1e-3;
        if settled {
            self.tidying = (0..2).find(|k| is_untidy(now[*k], home[*k]));
        }
    }
}

/// True if a foot is not where it is meant to be.
pub(super) fn is_untidy(is: (Vec3, f64), meant: (Vec3, f64)) -> bool {
    (is.0 - meant.0).norm() > recovery_step::UNTIDY.0
        || trig::wrapped(is.1 - meant.1).abs() > recovery_step::UNTIDY.1
}
