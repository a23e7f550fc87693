//! What an arm does of a motion with a load in its hand.
//!
//! The motion was made by an empty hand. The same path with 10 kg would take several times the force, which a shoulder
//! does not have, and the body would have to stand against it. So the arm moves the load about with the force of the
//! motion: what it does slowly stays as it is, what it does quickly becomes the less the more it carries.

use crate::body::topology::{PARENT, SEGMENT_COUNT};
use crate::body::{Body, Posture, SegmentId};
use crate::figure::params::load::{
    BENT_ELBOW, HABIT_TIME, HALF_SWING, HANGS_ELBOW, HANGS_SWING, QUICK, RAISED_SWING,
};
use crate::math::curve::fall;
use crate::math::exp::exp;
use crate::math::{Quat, Vec3, trig};
use crate::motion::arm_ik::{Arm, joints};
use crate::motion::leg_ik::forward;
use serde::{Deserialize, Serialize};

/// Positions and rotations of all segments, m.
pub(super) type ArmPoses = [(Vec3, Quat); SEGMENT_COUNT];

/// What an arm has done lately.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Habit {
    /// How much it is used to hang, 0…1.
    pub(super) hangs: f64,
    /// How it has been held.
    held: Arm,
}

impl Habit {
    /// False if it cannot be what was written into a checkpoint.
    pub(super) fn is_valid(&self) -> bool {
        (0.0..=1.0).contains(&self.hangs) && self.held.is_finite()
    }

    /// Of an arm that has always been as in `posture`.
    pub(super) fn of(body: &Body, posture: &Posture, arm: [SegmentId; 3]) -> Self {
        let (_, [elbow, _]) = joints(arm);
        Self {
            hangs: hanging(swing(&forward(body, posture), arm), posture.hinge[elbow]),
            held: Arm::of(posture, arm),
        }
    }

    /// What it is `seconds` later, when the motion has the arm `held` like this and, all the time, hanging by so much.
    pub(super) fn after(&self, seconds: f64, hung: f64, held: Arm) -> Self {
        Self {
            hangs: hung + (self.hangs - hung) * exp(-seconds / HABIT_TIME),
            held: self.held.toward(&held, 1.0 - exp(-seconds / QUICK)),
        }
    }
}

/// Share of what an arm does quickly that it leaves undone with a load, kg.
fn left_undone(load: f64) -> f64 {
    load / (load + HALF_SWING)
}

/// Takes from what an arm does quickly as much as its load, kg, asks for.
pub(super) fn slow(posture: &mut Posture, arm: [SegmentId; 3], load: f64, habit: &Habit) {
    let planned = Arm::of(posture, arm);
    let held = planned.toward(&habit.held, left_undone(load));
    held.hold(posture, arm);
}

/// Lets an arm that hangs in the motion, and is used to it, hang straighter and swing less, by what its hand carries,
/// kg.
pub(super) fn hang(
    body: &Body,
    posture: &mut Posture,
    planned: &ArmPoses,
    arm: [SegmentId; 3],
    load: f64,
    habit: &Habit,
) {
    let (shoulder, [elbow, wrist]) = joints(arm);
    let upper = arm[0].index();
    let hung = hanging(swing(planned, arm), posture.hinge[elbow]);
    let less = habit.hangs * hung * left_undone(load);
    // The forearm keeps its turn about its own axis, which is its second angle.
    for angle in [elbow, wrist, wrist + 1] {
        posture.hinge[angle] *= 1.0 - less;
    }
    let poses = forward(body, posture);
    let back = Quat::exp(Vec3::Z.cross(ahead(planned)) * (less * swing(&poses, arm)));
    let turned = back * poses[upper].1;
    posture.ball[shoulder] = (poses[PARENT[upper]].1.conjugate() * turned).normalized();
}

/// How much an arm with these angles of swing and elbow hangs, 0…1.
fn hanging(swing: f64, elbow: f64) -> f64 {
    fall(swing.abs(), (HANGS_SWING, RAISED_SWING)) * fall(elbow.abs(), (HANGS_ELBOW, BENT_ELBOW))
}

/// Angle of an arm before the vertical through its shoulder, rad, as the pelvis looks.
fn swing(poses: &ArmPoses, [upper, _, hand]: [SegmentId; 3]) -> f64 {
    let line = poses[hand.index()].0 - poses[upper.index()].0;
    trig::atan2(line.dot(ahead(poses)), -line.z)
}

/// Where the pelvis looks, level.
fn ahead(poses: &ArmPoses) -> Vec3 {
    let x = poses[0].1.rotate(Vec3::X);
    Vec3 { z: 0.0, ..x }.normalized_or(Vec3::X)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::arm_ik::ARMS;
    use crate::motion::builtin::at_ease;

    const RIGHT: [SegmentId; 3] = ARMS[1];

    /// A figure at ease with its right arm swung by `swing` rad from where it hangs, forwards if it is positive.
    fn swung(body: &Body, swing: f64) -> Posture {
        let mut out = at_ease(body);
        let (shoulder, _) = joints(RIGHT);
        out.ball[shoulder] = Quat::exp(Vec3::Y * -swing) * out.ball[shoulder];
        out
    }

    fn hand(body: &Body, posture: &Posture) -> Vec3 {
        let poses = forward(body, posture);
        poses[RIGHT[2].index()].0 - poses[RIGHT[0].index()].0
    }

    /// How far the hand of an arm with 5 kg is from where the motion has it as the arm comes down once more after
    /// `raised` seconds, m.
    fn let_down(raised: f64) -> f64 {
        let body = Body::adult_man();
        let up = Habit::of(&body, &swung(&body, 2.0), RIGHT);
        assert_eq!(up.hangs, 0.0, "it is raised");
        let before = Habit::of(&body, &swung(&body, 0.0), RIGHT);
        let habit = before.after(raised, up.hangs, up.held);
        let planned = swung(&body, 0.5);
        let mut out = planned;
        hang(
            &body,
            &mut out,
            &forward(&body, &planned),
            RIGHT,
            5.0,
            &habit,
        );
        (hand(&body, &out) - hand(&body, &planned)).norm()
    }

    #[test]
    fn an_arm_that_comes_down_between_two_movements_goes_on_as_the_motion_has_it() {
        let [used, once, busy] = [0.0, 0.3, 3.0].map(let_down);
        assert!(used > 0.1, "{used}");
        assert!(once < used && once > 0.5 * used, "{once} of {used}");
        assert!(busy < 0.03 * used, "{busy} of {used}");
    }

    /// Furthest that the hand gets up from where it is with the arm level when the arm swings by ±`most` rad about
    /// there in `period` seconds, m.
    fn swings(load: f64, most: f64, period: f64) -> f64 {
        let body = Body::adult_man();
        let at = |t: f64| {
            let angle = most * trig::sin_cos(t / period * std::f64::consts::TAU).0;
            swung(&body, std::f64::consts::FRAC_PI_2 + angle)
        };
        let dt = 1.0 / 60.0;
        let mut habit = Habit::of(&body, &at(0.0), RIGHT);
        let level = hand(&body, &at(0.0)).z;
        let mut furthest: f64 = 0.0;
        for k in 0..(5.0 * period / dt) as u32 {
            let t = f64::from(k) * dt;
            let mut out = at(t);
            habit = habit.after(dt, 0.0, Arm::of(&out, RIGHT));
            slow(&mut out, RIGHT, load, &habit);
            if t > 3.0 * period {
                furthest = furthest.max((hand(&body, &out).z - level).abs());
            }
        }
        furthest
    }

    #[test]
    fn a_loaded_arm_does_less_of_what_is_quick_and_all_of_what_is_slow() {
        let empty = swings(0.0, 0.4, 1.0);
        assert!(empty > 0.2, "{empty}");
        for load in [4.0, 12.0] {
            // 1 − less · iωτ/(1 + iωτ): what is left of a swing whose quick part, a high-pass of the first order,
            // becomes less.
            let less = load / (load + HALF_SWING);
            let x = std::f64::consts::TAU * QUICK;
            let quick = [x * x, x].map(|part| part / (1.0 + x * x));
            let meant = (1.0 - less * quick[0]).hypot(less * quick[1]);
            let share = swings(load, 0.4, 1.0) / empty;
            assert!(
                (share / meant - 1.0).abs() < 0.03,
                "{share} with {load} kg, {meant} meant"
            );
            let slowly = swings(load, 0.4, 40.0) / empty;
            assert!(slowly > 0.97, "{slowly} with {load} kg");
        }
    }
}
