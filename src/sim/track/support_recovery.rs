//! Support recovery: balance lost in a long stance on one foot.
//!
//! When the stance foot cannot keep the capture point, and the planned step comes too late or cannot reach far enough,
//! the raised foot is put down early, at a place where it catches the body. It is lifted again when the body is back
//! over the other foot. Until then the plan waits: its pace `r` goes from 1 to 0 and back, and its raised leg turns
//! into a standing one. A stream does not wait; its foot stands until its own step is due.
//!
//! A motion that stands still has its capture point under its centre of mass, so it stands at `c + (1 − r) ċ/ω`, which
//! was its capture point and from which it can continue.

use super::StepTracker;
use super::capture_point::within_reach;
use super::foot_places::{FootPlace, FootPlaces, stance_points, turn};
use super::params::capture::REACH_ALONG;
use super::params::common::SETTLED_OFFSET;
use super::params::recovery::{ASTRAY, SHIFT_DONE, SHIFT_SPEED, STANCE_WIDTH};
use super::params::support_recovery::{
    ERROR, LONGEST, OBSERVED_PACE, OUTSIDE, PASSING_TIME, PLANNED_STEP_ERROR, PLANNED_STEP_TIME,
    SLOWING_TIME, STREAM_LIFTS,
};
use super::recovery_step::RecoveryStep;
use crate::body::Posture;
use crate::body::topology::{DOF_LEN, DOF_START, NV, outward};
use crate::control::{FootTarget, PointTarget, RotationTarget};
use crate::dynamics::Terms;
use crate::math::Vec3;
use crate::math::curve::smoothstep;
use crate::motion::TargetPair;
use crate::motion::leg_ik::leg_segments;
use crate::plan::params::common::REST_SPEED;
use crate::support::Support;
use serde::{Deserialize, Serialize};

/// The foot that was put down, and the plan that waits for it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct SupportRecovery {
    /// The foot that was put down early, or is about to be, and the time since that began, s.
    foot: Option<(usize, f64)>,
    /// Time for which the stance foot has not been able to keep the body, s.
    lost: f64,
    /// The last foot that was put down.
    leg: usize,
    /// Pace of the plan in this tick.
    pace: f64,
    /// Pace of the plan in the last tick.
    last_pace: f64,
    /// Velocity of the motion's centre of mass at full pace, m/s.
    velocity: Vec3,
    /// Displacement of the desired centre of mass, m.
    shift: Vec3,
}

impl Default for SupportRecovery {
    fn default() -> Self {
        Self {
            foot: None,
            lost: 0.0,
            leg: 0,
            pace: 1.0,
            last_pace: 1.0,
            velocity: Vec3::zero(),
            shift: Vec3::zero(),
        }
    }
}

impl SupportRecovery {
    /// Whether this value is one that a checkpoint could hold: there are two feet.
    pub(super) fn is_valid(&self) -> bool {
        self.leg < 2 && self.foot.is_none_or(|(side, _)| side < 2)
    }

    /// Whether a foot stands that is raised in the plan.
    pub(super) fn is_active(&self) -> bool {
        self.foot.is_some()
    }

    /// Ends it, so that the plan continues.
    pub(super) fn end(&mut self) {
        self.foot = None;
    }

    /// The foot that stands although it is raised in the plan.
    pub(super) fn foot(&self) -> Option<usize> {
        self.foot.map(|(side, _)| side)
    }

    /// Places for the feet of a waiting body: the raised one beside the other. `leg`: length of a leg, m.
    pub(super) fn home(&self, mut planned: FootPlaces, leg: f64) -> FootPlaces {
        if let Some(raised) = self.foot() {
            let stance = planned[1 - raised];
            let aside = Vec3::Y * (outward(raised) * STANCE_WIDTH * leg);
            planned[raised] = FootPlace {
                at: stance.offset(aside),
                ..stance
            };
        }
        planned
    }

    /// The pace of a plan that waits or has waited; `None` if nothing holds it up.
    pub(super) fn pace(&self) -> Option<f64> {
        (self.is_active() || self.pace < 1.0).then_some(self.pace)
    }

    /// Updates the pace over a tick of `dt` seconds.
    pub(super) fn update_pace(&mut self, dt: f64) {
        self.last_pace = self.pace;
        let change = if self.is_active() { -dt } else { dt } / SLOWING_TIME;
        self.pace = (self.pace + change).clamp(0.0, 1.0);
    }

    /// Adapts the motion of a tick to this pace: its velocities, and its raised leg, which stands as in `at_ease` while
    /// the plan waits.
    pub(super) fn slow(&self, out: &mut TargetPair, at_ease: &Posture, dt: f64) {
        let (now, next) = (self.last_pace, self.pace);
        if (now, next) == (1.0, 1.0) {
            return;
        }
        out.now.velocity.iter_mut().for_each(|v| *v *= now);
        out.next.velocity.iter_mut().for_each(|v| *v *= next);
        let (from, to) = (smoothstep(1.0 - now), smoothstep(1.0 - next));
        for (target, share) in [(&mut out.now, from), (&mut out.next, to)] {
            let way = target.posture.joint_difference(at_ease);
            let mut turns = [0.0; NV];
            for s in leg_segments(self.leg == 0) {
                let dofs = DOF_START[s.index()]..DOF_START[s.index()] + DOF_LEN[s.index()];
                for d in dofs {
                    turns[6 + d] = share * way[d];
                    let v = &mut target.velocity[6 + d];
                    *v = (1.0 - share) * *v + way[d] * (to - from) / dt;
                }
            }
            target.posture.integrate(&turns, 1.0);
        }
    }

    /// Shifts the desired centre of mass to the capture point of the motion at full pace.
    pub(super) fn shift_com(&mut self, com: &mut PointTarget, omega: f64, dt: f64) {
        if self.last_pace > OBSERVED_PACE {
            self.velocity = com.now_velocity * (1.0 / self.last_pace);
        }
        let wanted = self.wanted_shift(omega);
        if self.is_active() {
            self.shift += (wanted - self.shift).capped(SHIFT_SPEED * dt);
        } else {
            self.shift = wanted;
        }
        com.shift(self.shift);
    }

    fn wanted_shift(&self, omega: f64) -> Vec3 {
        (self.velocity * ((1.0 - self.pace) / omega)).horizontal()
    }

    /// Begins the shift at the actual place of the body, which is `off` from its place in the motion, m.
    pub(super) fn begin_shift_at(&mut self, off: Vec3) {
        if self.is_active() {
            self.shift = off.horizontal();
        }
    }

    /// Remaining shift, m.
    fn rest(&self, omega: f64) -> f64 {
        (self.wanted_shift(omega) - self.shift).norm()
    }

    /// The displacement now, m.
    pub(super) fn shift(&self) -> Vec3 {
        self.shift
    }
}

impl StepTracker {
    /// Begins to put the raised foot down if the stance foot has been unable to hold the body for a while. `now`:
    /// places of the feet.
    pub(super) fn begin_support_recovery(
        &mut self,
        terms: &Terms,
        support: &Support,
        now: &FootPlaces,
        dt: f64,
    ) {
        let lost = self.foot_to_put_down(terms);
        let xi = self.capture.point();
        let held = |side: usize| support.holds(Vec3::on_floor(xi) - now[1 - side].at.horizontal());
        let Some(side) = lost.filter(|side| !held(*side)) else {
            self.recovery.support.lost = 0.0;
            return;
        };
        let state = &mut self.recovery.support;
        state.lost += dt;
        if state.lost < PASSING_TIME {
            return;
        }
        *state = SupportRecovery {
            foot: Some((side, 0.0)),
            lost: 0.0,
            leg: side,
            ..*state
        };
        let ankle = Self::ankle(terms, side);
        let behind = now[1 - side].local(ankle).x < 0.0;
        let step = RecoveryStep::of_raised_foot(side, ankle, now[side].yaw, behind);
        self.recovery.step.begin(step);
    }

    /// The raised foot, if the other one cannot keep the body and the planned step does not catch it.
    fn foot_to_put_down(&mut self, terms: &Terms) -> Option<usize> {
        let stance = self.only_stance()?;
        let side = 1 - stance;
        let (plan, phase) = (self.plan()?, self.clock.phase);
        if plan.current(side, phase).is_some() || self.capture.off() < ERROR {
            return None;
        }
        let remaining = self.until(plan.earliest(side, phase));
        if remaining < PLANNED_STEP_TIME {
            return None;
        }
        let too_far = self.next(side).is_none_or(|f| {
            let d = self.capture.left_over(remaining);
            let ankle = Self::ankle(terms, stance);
            let can = within_reach(d, self.mapped(&f), ankle, side, REACH_ALONG);
            Vec3::on_floor([d[0] - can[0], d[1] - can[1]]).norm() > PLANNED_STEP_ERROR
        });
        // The whole sole counts: a body on its toes can put the heel down.
        let corners = self.legs.sole_points(terms, stance);
        let margin = self.capture.margin(corners.map(|p| [p.x, p.y]))?;
        (too_far && margin < -OUTSIDE).then_some(side)
    }

    /// The foot that uncrosses legs crossed by a raised foot, if it is on the side to which the body falls; `xi`: the
    /// capture point, m.
    pub(super) fn uncrossing_foot(&self, now: &FootPlaces, xi: [f64; 2]) -> Option<usize> {
        let raised = self.recovery.support.foot()?;
        let side = 1 - raised;
        let beside = |p: Vec3| now[side].local(p).y * outward(side);
        let crossed = beside(now[raised].at) > 0.0;
        let falls = beside(Vec3::on_floor(xi)) > 0.0;
        (crossed && falls).then_some(side)
    }

    /// Keeps the foot that was put down where it stands, and lifts it when the body is back over the other one.
    pub(super) fn hold_support(
        &mut self,
        terms: &Terms,
        support: &Support,
        now: &FootPlaces,
        dt: f64,
        feet: &mut [FootTarget; 2],
    ) {
        let Some((side, since)) = &mut self.recovery.support.foot else {
            return;
        };
        *since += dt;
        let (side, since) = (*side, *since);
        if self.recovery_step().is_some_and(|s| s.side == side) {
            return;
        }
        let xi = self.capture.point();
        let held = self.capture.holding_zmp(stance_points(support, side)) == xi;
        let off = self.capture.off();
        let phase = self.clock.phase;
        let (live, earliest) = self.plan().map_or((false, f64::INFINITY), |p| {
            (p.is_live(), p.earliest(side, phase))
        });
        let state = &self.recovery.support;
        let back = state.rest(self.capture.omega()) < SHIFT_DONE
            && (off < SETTLED_OFFSET || (held && off < ASTRAY))
            && (live || terms.com_velocity.norm() < REST_SPEED);
        let due = live && self.until(earliest) < STREAM_LIFTS;
        if self.recovery_step().is_none() && (back || due || since > LONGEST) {
            self.recovery.support.end();
            let foot = &mut self.feet[side];
            foot.lift(phase);
            foot.release = Self::ankle(terms, side) - feet[side].ankle.now;
            return;
        }
        let FootPlace { at, yaw } = now[side];
        feet[side] = FootTarget {
            ankle: PointTarget::still(at + Vec3::Z * self.legs.soles[side].ankle_height),
            rotation: RotationTarget::still(turn(yaw)),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f64 = 1.0 / 60.0;
    const OMEGA: f64 = 3.3;

    fn moving(pace: f64) -> PointTarget {
        let v = Vec3 {
            x: 0.2,
            y: -0.1,
            z: 0.05,
        };
        PointTarget {
            now: Vec3::Z,
            now_velocity: v * pace,
            next: Vec3::Z,
            next_velocity: v * pace,
        }
    }

    /// The capture point of a plan that waits, or has waited, is where it is at full pace, so the plan can continue at
    /// any time.
    #[test]
    fn a_plan_that_slows_down_keeps_its_capture_point() {
        let point = |com: &PointTarget| com.now + com.now_velocity * (1.0 / OMEGA);
        let meant = point(&moving(1.0));
        let mut wait = SupportRecovery::default();
        let (mut least, mut stood) = (1.0f64, 0);
        for tick in 0..240 {
            match tick {
                10 => wait.foot = Some((0, 0.0)),
                120 => wait.end(),
                _ => {}
            }
            wait.update_pace(DT);
            let mut com = moving(wait.last_pace);
            wait.shift_com(&mut com, OMEGA, DT);
            least = least.min(wait.pace);
            stood += usize::from((wait.pace, wait.last_pace) == (0.0, 0.0));
            let off = point(&com) - meant;
            // While the plan slows down, the shift is no faster than a body.
            let follows = !(10..=60).contains(&tick);
            let most = if follows { 0.02 } else { 0.08 };
            assert!(off.level() < most, "{tick}: {off:?}");
            assert!(
                !follows || (wait.pace, wait.last_pace) != (0.0, 0.0) || wait.rest(OMEGA) < 1e-9
            );
        }
        assert!(least == 0.0 && stood > 60 && wait.pace().is_none());
        assert!(wait.shift().norm() < 1e-12);
    }
}
