//! The movement of an arm with a load in its hand.
//!
//! The motion was made by an empty hand. Moving 10 kg along the same path would take several times the force, which a
//! shoulder does not have, and the body would have to resist it. So the arm moves the load with the force of the
//! motion: slow movements stay as they are, and quick ones become smaller the more it carries.

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

/// The recent movement of an arm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Habit {
    /// How much it usually hangs, 0…1.
    pub(super) hangs: f64,
    /// How it has been held on average.
    held: Arm,
}

impl Habit {
    /// Whether this value is one that a checkpoint could hold.
    pub(super) fn is_valid(&self) -> bool {
        (0.0..=1.0).contains(&self.hangs) && self.held.is_finite()
    }

    /// For an arm that has always been as in `posture`.
    pub(super) fn of(body: &Body, posture: &Posture, arm: [SegmentId; 3]) -> Self {
        let (_, [elbow, _]) = joints(arm);
        Self {
            hangs: hanging(swing(&forward(body, posture), arm), posture.hinge[elbow]),
            held: Arm::of(posture, arm),
        }
    }

    /// The habit `seconds` later, if the motion has had the arm `held` like this and hanging by `hung` all that time.
    pub(super) fn after(&self, seconds: f64, hung: f64, held: Arm) -> Self {
        Self {
            hangs: hung + (self.hangs - hung) * exp(-seconds / HABIT_TIME),
            held: self.held.toward(&held, 1.0 - exp(-seconds / QUICK)),
        }
    }
}

/// Share of an arm's quick movement that it leaves out with a load, kg.
fn left_undone(load: f64) -> f64 {
    load / (load + HALF_SWING)
}

/// Reduces the quick movement of an arm according to its load, kg.
pub(super) fn slow(posture: &mut Posture, arm: [SegmentId; 3], load: f64, habit: &Habit) {
    let planned = Arm::of(posture, arm);
    let held = planned.toward(&habit.held, left_undone(load));
    held.hold(posture, arm);
}

/// Makes an arm that hangs in the motion, and usually does, hang straighter and swing less, according to the load in
/// its hand, kg.
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

/// Angle of an arm in front of the vertical through its shoulder, rad, in the direction of the pelvis.
fn swing(poses: &ArmPoses, [upper, _, hand]: [SegmentId; 3]) -> f64 {
    let line = poses[hand.index()].0 - poses[upper.index()].0;
    trig::atan2(line.dot(ahead(poses)), -line.z)
}

/// The direction in which the pelvis faces, level.
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

    /// A figure at ease with its right arm swung by `swing` rad from hanging, positive forwards.
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

    /// Distance, m, between the hand of an arm with 5 kg and its place in the motion, as the arm comes down again after
    /// being raised for `raised` seconds.
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

    /// The greatest height, m, of the hand above its place with the arm level, when the arm swings by ±`most` rad about
    /// level in `period` seconds.
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
            // 1 − less · iωτ/(1 + iωτ): the remainder of a swing whose quick part, a first-order high-pass, is reduced.
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
