//! Swinging feet are led to displaced footholds, clear of the floor, around the stance leg, and, in a flight, with the
//! centre of mass.
//!
//! With `s(u)` from 0 to 1 (minimum jerk) over the swing, the target of the ankle is that of the clip plus `r (1 −
//! t/T)²` (the offset `r` at lift-off, given up in `T`) plus `s d` (the displacement `d` of the foothold) plus the
//! missing clearance of the sole.

use super::capture_point::{smoothing, within_reach};
use super::foot_places::{FootPlace, turn};
use super::leg_collision::StanceLeg;
use super::params::capture::REACH_ALONG;
use super::params::common::{FREEZE_TIME, LOWERING_SPEED};
use super::params::step_plan::{PAUSE_AFTER, PAUSE_BEFORE};
use super::params::step_timing::EARLIEST_DECISION;
use super::params::swing::{
    CLEARANCE, CLEARANCE_SPEED, RELEASE_TIME, RETURN_MOST, RETURN_SHARE, SHIFT_SHARE, SHORTEST,
};
use super::step_plan::Footfall;
use super::{StepTracker, TaskTargets};
use crate::body::topology::FEET;
use crate::control::{FootTarget, PointTarget};
use crate::dynamics::Terms;
use crate::math::curve::smootherstep;
use crate::math::{Quat, Vec3, trig};

impl StepTracker {
    /// Gives planted feet the heading with which they landed, because they could be turned only by scraping.
    pub(super) fn keep_headings(&self, terms: &Terms, feet: &mut [FootTarget; 2]) {
        for (side, foot) in feet.iter_mut().enumerate() {
            let swings = self.recovery_step().is_some_and(|s| s.side == side)
                || (self.is_stepping() && !self.feet[side].down);
            if swings {
                continue;
            }
            let actual = Quat::from_mat3(&terms.kin.rotation[FEET[side].index()]);
            let target = &mut foot.rotation;
            let off = actual.heading() - target.now.heading();
            let turn = turn(trig::wrapped(off));
            target.now = turn * target.now;
            target.next = turn * target.next;
        }
    }

    /// Updates the target of a foot in a planned step.
    pub(super) fn update_swing(
        &mut self,
        terms: &Terms,
        side: usize,
        dt: f64,
        target: &mut FootTarget,
    ) {
        if self.feet[side].down {
            if self.feet[side].early {
                self.lower_early(side, target);
            }
            return;
        }
        let (current, next) = (self.planned(side), self.next(side));
        let coming = current.or(next);
        if let Some(f) = coming {
            self.update_foothold(terms, side, &f, dt);
        }
        let (foot, phase) = (self.feet[side], self.clock.phase);
        let since = (phase - foot.lifted).max(0.0) / self.speed();
        let on = match (current, next) {
            (Some(_), _) => phase,
            (None, Some(f)) => f.on,
            (None, None) => phase + self.speed(),
        };
        let remaining = self.until(on).max(0.0);
        let whole = (since + remaining).max(SHORTEST) * SHIFT_SHARE;
        let share = |t: f64| smootherstep((t / whole).clamp(0.0, 1.0));
        let s = share(since);
        let kept = (1.0 - since / RELEASE_TIME).max(0.0);
        let mut offset = foot.release * (kept * kept);
        offset.x += s * foot.shift[0];
        offset.y += s * foot.shift[1];
        let wanted = CLEARANCE
            .min(CLEARANCE_SPEED * since)
            .min(CLEARANCE_SPEED * remaining);
        offset.z += (wanted - self.lowest(terms, side)).clamp(0.0, CLEARANCE);
        let target = &mut target.ankle;
        let clip = target.now;
        if let Some(early) = self.timing.early.filter(|_| remaining > 0.0) {
            // In an early step, a foot lags by a tenth of a second unless its target has the velocity of the shift.
            let ahead = |t: f64| share(since + t * early.rate);
            let (next, after) = (ahead(dt), ahead(2.0 * dt));
            let way = Vec3::on_floor(foot.shift);
            target.now_velocity += way * ((next - s) / dt);
            target.next_velocity += way * ((after - next) / dt);
            target.next += way * (next - s);
        }
        if foot.late > 0.0 {
            offset.z -= LOWERING_SPEED * foot.late;
            target.now_velocity = Vec3::Z * -LOWERING_SPEED;
            target.next_velocity = Vec3::Z * -LOWERING_SPEED;
        }
        target.shift(offset);
        if let Some(f) = coming.filter(|_| self.feet[1 - side].down) {
            let stance = FootPlace {
                at: Self::ankle(terms, 1 - side),
                yaw: self.mapped(&f).yaw,
            };
            let leg = StanceLeg::new(stance, side);
            if let Some(leg) = leg.crossed(Vec3::on_floor(foot.shift), foot.release, clip) {
                let depth = leg.depth(Self::ankle(terms, side), Vec3::zero());
                let foot = &mut self.feet[side];
                let initial = *foot.initial_depth.get_or_insert(depth.max(0.0));
                avoid(&leg, initial, since, dt, target);
            }
        }
    }

    /// Lowers the target of a foot that landed early and is still in the air in the plan.
    fn lower_early(&self, side: usize, target: &mut FootTarget) {
        let ankle = &mut target.ankle;
        let low = ankle.next.z + self.legs.soles[side].lowest(target.rotation.next, 0.0);
        ankle.now.z -= low.max(0.0);
        ankle.next.z -= low.max(0.0);
    }

    /// Displacement of the foothold `f` of foot `side` for each metre of error at its touch-down. 1 if that, or the end
    /// of the double support, is beyond the forecast of the pendulum: feet that stand together for that long leave time
    /// to bring the body to its place.
    pub(super) fn displacement_gain(&self, side: usize, f: &Footfall) -> f64 {
        let stance = self.planned(1 - side).filter(|_| self.feet[1 - side].down);
        let both = stance.map_or(0.0, |s| (s.off - f.on) / self.speed());
        if both.max(self.until(f.on)) >= EARLIEST_DECISION {
            return 1.0;
        }
        self.capture
            .displacement_gain(both.clamp(0.0, PAUSE_BEFORE + PAUSE_AFTER))
    }

    /// Updates the displacement of the foothold `f` of a swinging foot.
    fn update_foothold(&mut self, terms: &Terms, side: usize, f: &Footfall, dt: f64) {
        let remaining = self.until(f.on).max(0.0);
        let (planned, home) = (self.placed(f).at, self.mapped(f));
        let d = match self.timing.early.filter(|early| early.side == side) {
            Some(early) => [early.place.x - home.at.x, early.place.y - home.at.y],
            None => {
                let away = home.at - planned;
                let pull = RETURN_SHARE.min(RETURN_MOST / away.level().max(1e-9));
                let gain = self.displacement_gain(side, f);
                let mut d = self.capture.left_over(remaining).map(|e| gain * e);
                d[0] -= pull * away.x;
                d[1] -= pull * away.y;
                within_reach(d, home, Self::ankle(terms, 1 - side), side, REACH_ALONG)
            }
        };
        let foot = &mut self.feet[side];
        if remaining > FREEZE_TIME || foot.shift == [0.0; 2] {
            let a = smoothing(dt);
            for (x, y) in foot.shift.iter_mut().zip(d) {
                *x += a * (y - *x);
            }
        }
    }
}

/// Leads a foot that will cross, or has crossed, around the stance leg, `since` seconds after it lifted off `initial`
/// metres inside the space of that leg.
fn avoid(leg: &StanceLeg, initial: f64, since: f64, dt: f64, target: &mut PointTarget) {
    let (v0, v1) = (target.now_velocity, target.next_velocity);
    let aside = |p: Vec3, v: Vec3, t: f64| leg.aside(p, v, since + t, initial);
    let now = aside(target.now, v0, 0.0);
    let next = aside(target.next, v1, dt);
    let after = aside(target.next + v1 * dt, v1 * 2.0 - v0, 2.0 * dt);
    target.now += now;
    target.next += next;
    target.now_velocity += (next - now) * (1.0 / dt);
    target.next_velocity += (after - next) * (1.0 / dt);
}

/// Shifts the feet of a body in flight with its centre of mass, whose path cannot be changed. Feet led to their places
/// in the motion would bend or stretch the legs, and turn the trunk.
pub(super) fn follow_com(terms: &Terms, dt: f64, tasks: &mut TaskTargets<'_>) {
    let off = terms.com - tasks.com.now;
    let drift = terms.com_velocity - tasks.com.now_velocity;
    for foot in tasks.feet.iter_mut() {
        let ankle = &mut foot.ankle;
        ankle.now += off;
        ankle.next += off + drift * dt;
        ankle.now_velocity += drift;
        ankle.next_velocity += drift;
    }
}
