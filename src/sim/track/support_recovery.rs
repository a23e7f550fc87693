//! Who stands on one foot for long and loses his balance there puts the raised foot down, early and where it catches
//! him, and lifts it again when he stands over the other one as the motion has it. The motion waits for him; a stream
//! goes on without him.

use super::recovery_step;
use super::recovery_step::{Places, RecoveryStep};
use super::step_decision::ASTRAY;
use super::{FOOT, SETTLED, StepTracker, TOES, capture_point, level, stance_points};
use crate::sim::body::topology::{
    DOF_LEN, DOF_START, L_FOOT, L_SHANK, L_THIGH, L_TOES, NV, R_FOOT, R_SHANK, R_THIGH, R_TOES,
};
use crate::sim::body::{Posture, SegmentId};
use crate::sim::control::{PointTarget, RotationTarget};
use crate::sim::dynamics::Terms;
use crate::sim::math::curve::smoothstep;
use crate::sim::math::{Quat, Vec3};
use crate::sim::motion::TargetPair;
use crate::sim::support::Support;

/// Who stands alone is not where the motion has him, and cannot come back, if his capture point is this far from its
/// place and this far outside the sole, m. Both grow threefold while the raised foot comes down.
const AWAY: f64 = 0.045;
const OUTSIDE: f64 = 0.005;
/// What passes within this time is a jolt, s: a heel that comes down, a leg that is braked.
const PASSES: f64 = 0.09;
/// A planned step that is nearer than this is made instead, s.
const NEAR: f64 = 0.6;
/// A planned step that would leave more than this of the error does not catch the body, m.
const LEFT: f64 = 0.1;
/// Time in which a motion that waits slows down, and goes on, s.
const SLOWING: f64 = 0.2;
/// The foot is lifted again after this time, whether the body is back or not, s.
const LONGEST: f64 = 3.0;
/// A stream, which does not wait, lifts it so long before it lands, s.
const RETURNS: f64 = 0.4;

const LEG: [[SegmentId; 4]; 2] = [
    [L_THIGH, L_SHANK, L_FOOT, L_TOES],
    [R_THIGH, R_SHANK, R_FOOT, R_TOES],
];

/// A motion that waits for its body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SupportRecovery {
    /// The foot that was put down out of its turn, or is about to be, and the time since that began, s.
    foot: Option<(usize, f64)>,
    /// For how long the foot that stands alone has not been able to keep the body, s.
    lost: f64,
    /// The last such foot.
    leg: usize,
    /// Pace of the motion in this tick and in the last one.
    pace: (f64, f64),
    /// Velocity of its centre of mass at full pace, m/s.
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
            pace: (1.0, 1.0),
            velocity: Vec3::zero(),
            shift: Vec3::zero(),
        }
    }
}

impl SupportRecovery {
    /// True while a foot stands that should not.
    pub(super) fn waits(&self) -> bool {
        self.foot.is_some()
    }

    /// The motion goes on.
    pub(super) fn end(&mut self) {
        self.foot = None;
    }

    /// The foot that stands out of its turn.
    pub(super) fn foot(&self) -> Option<usize> {
        self.foot.map(|(side, _)| side)
    }

    /// True for the foot that the motion waits for.
    pub(super) fn is_for(&self, side: usize) -> bool {
        self.foot.is_some_and(|(raised, _)| raised == side)
    }

    /// Where the feet of a body that waits belong: the one that the motion has raised stands beside the other.
    pub(super) fn standing(&self, mut home: Places, leg: f64) -> Places {
        if let Some((raised, _)) = self.foot {
            let (place, yaw) = home[1 - raised];
            let outward = if raised == 0 { 1.0 } else { -1.0 };
            let aside = Vec3::Y * (outward * recovery_step::WIDTH * leg);
            home[raised] = (place + Quat::exp(Vec3::Z * yaw).rotate(aside), yaw);
        }
        home
    }

    /// The pace of a motion that waits or has waited; `None` if nothing holds it up.
    pub(super) fn pace(&self) -> Option<f64> {
        (self.waits() || self.pace.0 < 1.0).then_some(self.pace.0)
    }

    /// Slows down while the motion waits.
    pub(super) fn keep(&mut self, dt: f64) {
        self.pace.1 = self.pace.0;
        let change = if self.waits() { -dt } else { dt } / SLOWING;
        self.pace.0 = (self.pace.0 + change).clamp(0.0, 1.0);
    }

    /// A motion that is played at this pace: its velocities, and the leg that it has raised, which stands as at `ease`
    /// while it waits.
    pub(super) fn slow(&self, out: &mut TargetPair, ease: &Posture, dt: f64) {
        if self.pace == (1.0, 1.0) {
            return;
        }
        let (next, now) = self.pace;
        out.now.velocity.iter_mut().for_each(|v| *v *= now);
        out.next.velocity.iter_mut().for_each(|v| *v *= next);
        let (from, to) = (smoothstep(1.0 - now), smoothstep(1.0 - next));
        for (target, share) in [(&mut out.now, from), (&mut out.next, to)] {
            let way = target.posture.joint_difference(ease);
            let mut turns = [0.0; NV];
            for s in LEG[self.leg] {
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

    /// A motion that is stopped stands where its capture point was: from there it can go on.
    pub(super) fn lean(&mut self, com: &mut PointTarget, omega: f64, dt: f64) {
        const SEEN: f64 = 0.1;
        if self.pace.1 > SEEN {
            self.velocity = com.now_velocity * (1.0 / self.pace.1);
        }
        let wanted = self.wanted(omega);
        if self.waits() {
            let way = wanted - self.shift;
            let far = way.norm();
            let most = recovery_step::LEAN_SPEED * dt;
            self.shift += if far > most { way * (most / far) } else { way };
        } else {
            self.shift = wanted;
        }
        com.now += self.shift;
        com.next += self.shift;
    }

    fn wanted(&self, omega: f64) -> Vec3 {
        let v = self.velocity * ((1.0 - self.pace.0) / omega);
        Vec3 { z: 0.0, ..v }
    }

    /// The body is `off` its place as the motion has it.
    pub(super) fn begin_at(&mut self, off: Vec3) {
        if self.waits() {
            self.shift = Vec3 { z: 0.0, ..off };
        }
    }

    /// How far the body was led back: the rest, m.
    fn rest(&self, omega: f64) -> f64 {
        (self.wanted(omega) - self.shift).norm()
    }

    /// The displacement now, m.
    pub(super) fn shift(&self) -> Vec3 {
        self.shift
    }
}

impl StepTracker {
    /// Puts the raised foot down if the other one cannot keep the body, and the planned step comes too late or cannot
    /// reach far enough.
    pub(super) fn fall_alone(&mut self, terms: &Terms, support: &Support, now: &Places, dt: f64) {
        let falls = self.falls_alone(terms);
        let Some(side) = falls.filter(|_| support.rests().is_empty()) else {
            self.wait.lost = 0.0;
            return;
        };
        self.wait.lost += dt;
        if self.wait.lost < PASSES {
            return;
        }
        self.wait.lost = 0.0;
        let ankle = terms.segment_position(FOOT[side].index());
        let (stance, yaw) = now[1 - side];
        let behind = Quat::exp(Vec3::Z * -yaw).rotate(ankle - stance).x < 0.0;
        self.step = Some(RecoveryStep::alone(side, ankle, now[side].1, behind));
        self.wait.foot = Some((side, 0.0));
        self.wait.leg = side;
    }

    fn falls_alone(&mut self, terms: &Terms) -> Option<usize> {
        let side = match [self.feet[0].down, self.feet[1].down] {
            [true, false] => 1,
            [false, true] => 0,
            _ => return None,
        };
        let plan = self.plan.as_ref()?;
        if plan.current(side, self.phase).is_some() || self.capture.off() < AWAY {
            return None;
        }
        let remaining = (plan.earliest(side, self.phase) - self.phase) / self.speed;
        if remaining < NEAR {
            return None;
        }
        let next = self.next(side);
        let left = next.is_none_or(|f| {
            let f = self.placed(&f);
            let home = self.anchor.point(f.place);
            let d = self.capture.left_over(remaining);
            let heading = self.anchor.yaw() + f.yaw;
            let stance = terms.segment_position(FOOT[1 - side].index());
            let can =
                capture_point::within_reach(d, home, stance, heading, side, capture_point::REACH.0);
            level([d[0] - can[0], d[1] - can[1]]).norm() > LEFT
        });
        // The whole sole counts: who stands on his toes can put the heel down.
        let stance = 1 - side;
        let (foot, toes) = (
            self.soles[stance].foot_points(),
            self.soles[stance].toe_points(),
        );
        let at = |s: SegmentId, p: &Vec3| {
            let p = terms.point_world(s.index(), *p);
            [p.x, p.y]
        };
        let corners = foot.iter().map(|p| at(FOOT[stance], p));
        let corners = corners.chain(toes.iter().map(|p| at(TOES[stance], p)));
        let margin = self.capture.margin(corners)?;
        (left && margin < -OUTSIDE).then_some(side)
    }

    /// The foot that uncrosses legs which a raised foot has crossed, if it lies on the side to which the body falls.
    pub(super) fn uncrosses(&self, now: &Places, xi: [f64; 2]) -> Option<usize> {
        let (raised, _) = self.wait.foot?;
        let side = 1 - raised;
        let (at, yaw) = now[side];
        let outward = |p: Vec3| {
            let y = Quat::exp(Vec3::Z * -yaw).rotate(p - at).y;
            if side == 0 { y } else { -y }
        };
        let crossed = outward(now[raised].0) > 0.0;
        let falls = outward(Vec3 {
            x: xi[0],
            y: xi[1],
            z: 0.0,
        }) > 0.0;
        (crossed && falls).then_some(side)
    }

    /// Keeps the foot that was put down where it stands, and lifts it when the body is back over the other one.
    pub(super) fn stand_by(
        &mut self,
        (terms, support): (&Terms, &Support),
        now: &Places,
        dt: f64,
        feet: &mut [(PointTarget, RotationTarget); 2],
    ) {
        let Some((side, since)) = &mut self.wait.foot else {
            return;
        };
        *since += dt;
        let (side, since) = (*side, *since);
        if self.step.is_some_and(|s| s.side == side) {
            return;
        }
        let xi = self.capture.point();
        let held = self.capture.hold(stance_points(support, side), xi) == xi;
        let off = self.capture.off();
        let (live, earliest) = self.plan.as_ref().map_or((false, f64::INFINITY), |p| {
            (p.is_live(), p.earliest(side, self.phase))
        });
        let back = self.wait.rest(self.capture.omega()) < 1e-3
            && (off < SETTLED.1 || (held && off < ASTRAY))
            && (live || terms.com_velocity.norm() < SETTLED.0);
        let due = live && (earliest - self.phase) / self.speed < RETURNS;
        if self.step.is_none() && (back || due || since > LONGEST) {
            self.wait.end();
            let foot = &mut self.feet[side];
            foot.lift(self.phase);
            foot.release = terms.segment_position(FOOT[side].index()) - feet[side].0.now;
            return;
        }
        let (place, yaw) = now[side];
        let at = place + Vec3::Z * self.soles[side].ankle_height;
        let turn = Quat::exp(Vec3::Z * yaw);
        feet[side] = (
            PointTarget {
                now: at,
                now_velocity: Vec3::zero(),
                next: at,
                next_velocity: Vec3::zero(),
            },
            RotationTarget {
                now: turn,
                now_velocity: Vec3::zero(),
                next: turn,
                next_velocity: Vec3::zero(),
            },
        );
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

    /// The capture point of a motion that waits, or has waited, is where it is at full pace: there it can go on at any
    /// time.
    #[test]
    fn a_motion_that_slows_down_keeps_its_capture_point() {
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
            wait.keep(DT);
            let mut com = moving(wait.pace.1);
            wait.lean(&mut com, OMEGA, DT);
            least = least.min(wait.pace.0);
            stood += usize::from(wait.pace == (0.0, 0.0));
            let off = point(&com) - meant;
            // While it slows down it leans no faster than a body does.
            let follows = !(10..=60).contains(&tick);
            let most = if follows { 0.02 } else { 0.08 };
            assert!(level([off.x, off.y]).norm() < most, "{tick}: {off:?}");
            assert!(!follows || wait.pace != (0.0, 0.0) || wait.rest(OMEGA) < 1e-9);
        }
        assert!(least == 0.0 && stood > 60 && wait.pace().is_none());
        assert!(wait.shift().norm() < 1e-12);
    }
}
