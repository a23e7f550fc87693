//! The tasks of the body's mass, hands and feet, and their weights.

use super::pendulum::pendulum_time;
use super::{
    Law, Modern, POINTS, ROTATION_FEEDBACK, SeatLoad, TaskRow, danger, gives_way, law_feedback,
    rotation_error, weight,
};
use crate::body::SegmentId;
use crate::body::topology::{L_FOOT, L_THIGH, L_TOES, PELVIS, R_FOOT, R_THIGH, R_TOES};
use crate::control::goals::{GoalPace, MAX_GOALS};
use crate::control::{
    ConstraintGoal, ControlInput, FootTarget, OnFloor, PointTarget, StancePhase, com_law,
};
use crate::dynamics::Terms;
use crate::dynamics::terms::WIDTH;
use crate::math::Vec3;
use crate::math::curve::fall;

/// Pace at which client constraints are approached.
const GOAL_PACE: GoalPace = GoalPace {
    horizon: 1.0 / 30.0,
    most: 8.0,
    most_trunk: 2.0,
    most_turn: 20.0,
};
/// Largest feedback of a hand and of a swinging foot, m/s².
const HAND_FEEDBACK: f64 = 20.0;
const SWING_FEEDBACK: f64 = 60.0;
/// Horizon of swinging feet as a share of the one that is set (0.1 s): 400/s² and 40/s.
const SWING_SHARPNESS: f64 = 0.25;
/// Factor on the weight of the centre of mass of a lying figure: the floor holds it in place.
const LYING: f64 = 1e-3;
/// Factor on the weight of balance when the capture point is farthest off.
const DANGER_FACTOR: f64 = 10.0;
/// Share of the weight on a seat from which the centre of mass has its smallest weight, and the factor then.
const SEATED_FULL: f64 = 0.3;
const SEATED_LEAST: f64 = 0.05;
/// The motion needs the seat if its capture point is inside the soles by less than the first; from the second on it is
/// about to get up, m.
const NEEDS_SEAT: (f64, f64) = (-0.02, 0.03);
/// A motion sits down if its centre of mass is over neither of two planted feet: fully if it is inside by less than the
/// first, not yet from the second on, m (negative: outside).
const SITS_DOWN: (f64, f64) = (-0.05, -0.01);
/// A planted foot of a helped figure whose sole is higher than this hovers, and is led to its place, m.
const HOVERS: f64 = 0.01;
/// Segments on which a figure sits. Hands that lean on a seat do not make it one.
const SEATED_ON: [SegmentId; 3] = [PELVIS, L_THIGH, R_THIGH];

impl Modern {
    /// Rows of the CoM, the end-effectors and the swing feet.
    pub(super) fn collect_tasks(&mut self, input: &ControlInput<'_>, law: &Law) {
        self.rows.clear();
        let t = input.terms;
        let hand_law = Law::new(input.params, input.dt);
        let swing_law = hand_law.sharpened(SWING_SHARPNESS);
        if input.params.track_com {
            let mut a = com_law(input.centroidal.com, t.com, t.com_velocity, input.dt);
            if let Some(level) = input.centroidal.acceleration {
                [a.x, a.y] = level;
            }
            let urgency = self.urgency(input);
            let a = a - t.com_bias;
            let mut com = match input.help {
                Some(_) => weight::COM_HELPED,
                None => weight::COM,
            };
            if input.contacts.phase == StancePhase::LiftOff {
                com[2] = weight::COM_LIFT_OFF;
            }
            for (k, value) in [a.x, a.y, a.z].into_iter().enumerate() {
                self.rows.push(TaskRow {
                    row: t.jc[k],
                    weight: com[k] * urgency,
                    value,
                });
            }
        }
        self.momentum_task(input);
        if input.params.track_hands {
            for e in input.effectors {
                if input.contacts.floor.is_some_and(|f| is_clear(f, e.segment)) {
                    self.point_task(
                        t,
                        &swing_law,
                        (e.segment.index(), e.point),
                        &e.position,
                        SWING_FEEDBACK,
                        weight::SWING_HAND,
                    );
                    continue;
                }
                self.point_task(
                    t,
                    &hand_law,
                    (e.segment.index(), e.point),
                    &e.position,
                    HAND_FEEDBACK,
                    weight::HAND * gives_way(input.carried_by(e.segment)),
                );
            }
        }
        for goal in input.goals.iter().take(MAX_GOALS) {
            self.goal_task(t, goal, 1.0 / input.goals.len() as f64);
        }
        let next = &input.target.next;
        for (side, foot) in [(0, L_FOOT.index()), (1, R_FOOT.index())] {
            let FootTarget { ankle, rotation } = &input.contacts.feet[side];
            // A planted foot is held where it touches; a swinging one is led. Both are turned as the motion turns them:
            // a heel that has come up is out of reach of the contact rows.
            let turn = if next.planted[side] {
                weight::PLANTED_ROTATION
            } else {
                weight::SWING_ROTATION
            };
            let is_led = !next.planted[side] || hovers(input, foot);
            if is_led && input.contacts.floor.is_none() {
                self.point_task(
                    t,
                    &swing_law,
                    (foot, Vec3::zero()),
                    ankle,
                    SWING_FEEDBACK,
                    weight::SWING_FOOT,
                );
            }
            let error = rotation_error(t, foot, rotation.now);
            let w = t.kin.omega[foot];
            let feedback = law_feedback(law, error, rotation.now_velocity - w);
            let ff = (rotation.next_velocity - rotation.now_velocity) * (1.0 / input.dt);
            let (bias, _) = t.segment_bias(foot);
            let a = ff + feedback.capped(ROTATION_FEEDBACK) - bias;
            let mut j = [[0.0; WIDTH]; 6];
            t.segment_jacobian(foot, &mut j);
            for (k, value) in [a.x, a.y, a.z].into_iter().enumerate() {
                self.rows.push(TaskRow {
                    row: j[k],
                    weight: turn,
                    value,
                });
            }
        }
    }

    /// Factor on the weight of the centre of mass. A figure that cannot step and is about to fall gives up its posture
    /// rather than its balance. A sitting figure has no balance to keep, and would bend to put its centre of mass where
    /// another seat would have had it. This does not apply while the motion is getting up, which requires a centre of
    /// mass over the feet. A figure that sits down falls onto the seat as the motion does.
    fn urgency(&mut self, input: &ControlInput<'_>) -> f64 {
        let planted = [input.target.now.planted, input.target.next.planted];
        if let Some(floor) = input.contacts.floor {
            return if floor.lies { LYING } else { 1.0 };
        }
        let mut most = 1.0;
        if planted == [[true; 2]; 2] {
            let margin = self.margin_on_feet(
                input,
                [input.centroidal.com.now.x, input.centroidal.com.now.y],
            );
            most -= (1.0 - SEATED_LEAST) * fall(margin, SITS_DOWN);
        }
        if self.seat.carries > 0.0 {
            let least = 1.0 - (1.0 - SEATED_LEAST) * self.seat.needed;
            let left = 1.0 - self.seat.carries / SEATED_FULL;
            return left.max(least).min(most);
        }
        if most < 1.0 {
            return most;
        }
        if input.params.protective_steps || planted != [[true; 2]; 2] {
            return 1.0;
        }
        1.0 + (DANGER_FACTOR - 1.0) * danger(input)
    }

    /// The share that seats carry, and whether the motion needs them.
    pub(super) fn sit(&mut self, input: &ControlInput<'_>) -> SeatLoad {
        let mg = input.terms.mass * input.gravity.max(1.0);
        let level = input.support.rests().iter().filter(|r| r.is_level());
        let seats = level.filter(|r| SEATED_ON.contains(&r.segment));
        let carries = seats.map(|r| r.force.z).sum::<f64>() / mg;
        if carries <= 0.0 {
            return SeatLoad::default();
        }
        let capture =
            input.centroidal.com.now + input.centroidal.com.now_velocity * pendulum_time(input);
        let margin = self.margin_on_feet(input, [capture.x, capture.y]);
        let needed = fall(margin, NEEDS_SEAT);
        SeatLoad { carries, needed }
    }

    /// Signed distance of a point on the ground inside the soles of the planted feet, m.
    fn margin_on_feet(&mut self, input: &ControlInput<'_>, point: [f64; 2]) -> f64 {
        let planted = input.target.next.planted;
        let feet = [(L_FOOT, 0), (L_TOES, 0), (R_FOOT, 1), (R_TOES, 1)];
        let corners = feet
            .iter()
            .filter(|(_, side)| planted[*side])
            .flat_map(|(s, _)| {
                let points = &input.body.segment(*s).contact_points;
                points
                    .iter()
                    .map(|p| input.terms.point_world(s.index(), *p))
            });
        self.soles.set_hull(corners.map(|p| [p.x, p.y]));
        self.soles
            .closest(point)
            .map_or(f64::NEG_INFINITY, |c| c.margin)
    }

    /// A client constraint. Its weight grows with the cube of its level, which spreads the transition from the
    /// posture's hold to its own over the time in which it comes or goes. Several constraints share the weight of one;
    /// together they would otherwise pull a figure off its feet.
    fn goal_task(&mut self, t: &Terms, goal: &ConstraintGoal, share: f64) {
        let s = goal.segment.index();
        let level = share * goal.weight * goal.weight * goal.weight;
        let mut push = |jacobian: &[[f64; WIDTH]], a: Vec3, weight: [f64; 3]| {
            for ((row, value), weight) in jacobian.iter().zip(a.to_array()).zip(weight) {
                if weight > 0.0 {
                    let row = *row;
                    self.rows.push(TaskRow { row, weight, value });
                }
            }
        };
        if goal.position.is_some() {
            let a = goal.acceleration(t, &GOAL_PACE) - t.point_bias(s, goal.point);
            let mut j = [[0.0; WIDTH]; 3];
            t.point_jacobian(s, goal.point, &mut j);
            let arm = goal.is_on_arm();
            let most = if arm { weight::GOAL_ARM } else { weight::GOAL };
            push(&j, a, goal.axes.map(|axis| most * level * axis));
        }
        if goal.rotation.is_some() {
            let (bias, _) = t.segment_bias(s);
            let a = goal.angular_acceleration(t, &GOAL_PACE) - bias;
            let mut j = [[0.0; WIDTH]; 6];
            t.segment_jacobian(s, &mut j);
            push(&j[..3], a, [weight::GOAL_ROTATION * level; 3]);
        }
    }

    fn point_task(
        &mut self,
        t: &Terms,
        law: &Law,
        (s, point): (usize, Vec3),
        target: &PointTarget,
        most: f64,
        weight: f64,
    ) {
        let (x, v) = (t.point_world(s, point), t.point_velocity(s, point));
        let ff = (target.next_velocity - target.now_velocity) * (1.0 / law.step());
        let feedback = law_feedback(law, target.now - x, target.now_velocity - v);
        let a = ff + feedback.capped(most) - t.point_bias(s, point);
        let mut j = [[0.0; WIDTH]; 3];
        t.point_jacobian(s, point, &mut j);
        for (row, value) in j.into_iter().zip([a.x, a.y, a.z]) {
            self.rows.push(TaskRow { row, weight, value });
        }
    }
}

/// Whether a foot that a helped figure should have on the floor is above it: contact rows do not lead it down.
fn hovers(input: &ControlInput<'_>, foot: usize) -> bool {
    let low = |s: usize| {
        let points = input.body.segments[s].contact_points.iter();
        let heights = points.map(|p| input.terms.point_world(s, *p).z);
        heights.fold(f64::INFINITY, f64::min)
    };
    let helped = input.help.is_some_and(|help| help.as_it_lies);
    helped && low(foot).min(low(foot + 1)) > HOVERS
}

/// Whether all contact points of a segment are clear of the floor in the motion.
fn is_clear(floor: OnFloor<'_>, segment: SegmentId) -> bool {
    let first = segment.index() * POINTS;
    floor.heights[first..first + POINTS]
        .iter()
        .all(|z| *z > floor.meant.0)
}
