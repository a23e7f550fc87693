//! Modern mode: whole-body tracking as one convex program, solved through its dual (ALGORITHM §14.1–14.2).
//!
//! Unknowns are the 45 accelerations, 39 torques and the forces of the planned contact points; the dual has 45 unknowns and is the same
//! kernel as the simulator's substep. Torques stay within strength and forces within friction at every iterate, the solution is a
//! continuous function of the state, and the work is bounded.

use super::goals::{MAX_GOALS, Pace};
use super::tracking::{Law, initial_acceleration};
use super::{Command, ControlInput, Controller, Goal, PointTarget, com_law};
use crate::sim::body::SegmentId;
use crate::sim::body::topology::{
    DOF_COUNT, DOF_LEN, DOF_START, L_FOOT, L_HAND, L_THIGH, L_TOES, NV, PELVIS, R_FOOT, R_HAND,
    R_THIGH, R_TOES, SEGMENT_COUNT,
};
use crate::sim::contact::dense::{Dense, cholesky, solve_lower, solve_upper};
use crate::sim::contact::rows::{CHAIN_WIDTH, PointRow, add_point_stiffness};
use crate::sim::contact::{
    ContactRows, DenseSystem, LimitRows, Motors, NewtonWorkspace, Outcome, interior, minimise,
};
use crate::sim::dynamics::Terms;
use crate::sim::dynamics::terms::WIDTH;
use crate::sim::figure::Flags;
use crate::sim::figure::report::MAX_CONTACTS;
use crate::sim::math::{Quat, Vec3};
use crate::sim::motion::TargetPair;
use crate::sim::support::{Polygon, Rest};
use multiversion::multiversion;

mod take_off;

/// Weights in units of force: the cost of a task is about (inertia × acceleration error)², so that a foot's hundred rad/s² cost less than one
/// m/s² of the body (WALKING §5). Hands, joints and planted feet were set on recorded motion: docs/adr/0004.
mod weight {
    pub(super) const COM: [f64; 3] = [1000.0, 1000.0, 300.0];
    pub(super) const HAND: f64 = 1.0;
    /// Constraints from outside, fully in force: a bounded pull that moves the centre of mass by 3 cm when it cannot be met.
    pub(super) const GOAL: f64 = 100.0;
    pub(super) const GOAL_ARM: f64 = 200.0;
    pub(super) const GOAL_ROTATION: f64 = 20.0;
    pub(super) const SWING_FOOT: f64 = 100.0;
    /// A hand that is clear of the floor it leans on before and after.
    pub(super) const SWING_HAND: f64 = 10.0;
    pub(super) const SWING_ROTATION: f64 = 4.0;
    pub(super) const PLANTED_ROTATION: f64 = 1.0;
    pub(super) const PELVIS: f64 = 20.0;
    /// The same of who lies and rolls over.
    pub(super) const ROLLING: f64 = 300.0;
    pub(super) const HOLD: f64 = 5000.0;
    pub(super) const BASE: f64 = 1e-6;
    /// ε: pull of a torque, relative to its half-range, towards the last tick's.
    pub(super) const TORQUE: f64 = 10.0;
    /// w_f: pull of a contact force towards the last tick's.
    pub(super) const FORCE: f64 = 1e-3;
}
/// Weight of a joint while the body is where the motion has it. Where it is about to fall, `clip(M_jj, …)` between the least and this: light joints
/// give way then, but with less than the least wrists and toes would pay for every other task.
const JOINT_WEIGHT: f64 = 1.0;
const LEAST_JOINT_WEIGHT: f64 = 0.05;
/// How constraints from outside are approached.
const GOAL_PACE: Pace = Pace {
    horizon: 1.0 / 30.0,
    most: 8.0,
    most_trunk: 2.0,
    most_turn: 20.0,
};
/// Weights of the joints of a limb that a constraint from outside leads, and of its wrist, which is light and would go to its limit first.
const LED_LIMB: f64 = 0.02;
const LED_WRIST: f64 = 0.2;
/// Friction the plan counts on; below the simulator's.
const FRICTION_MARGIN: f64 = 0.7 / 0.9;
/// Horizons of joints and rotations, and of swinging feet, as shares of the one that is set (0.1 s): 278/s² and 33/s, 400/s² and 40/s. Gait
/// needs limbs that are on time; the continuous program stays free of chatter with them, unlike the paper's active set.
const SHARPNESS: f64 = 0.3;
/// That of joints and rotations where the body is about to fall (149/s², 24/s): balance must not have to fight the posture.
const YIELDING_SHARPNESS: f64 = 0.41;
const SWING_SHARPNESS: f64 = 0.25;
/// Largest feedback of a hand, of a swinging foot, m/s², and of a rotation, rad/s².
const HAND_FEEDBACK: f64 = 20.0;
const SWING_FEEDBACK: f64 = 60.0;
const ROTATION_FEEDBACK: f64 = 50.0;
/// Time constant that brings a planted point to rest, s.
const HOLD_TIME: f64 = 0.05;
/// A point that comes down faster than the first beyond what its height leaves room for begins to strike, from the second on it does, m/s.
const STRIKES: (f64, f64) = (0.1, 0.3);
/// Hardest stop of a planted point that is planned, m/s².
const STOP: f64 = 150.0;
/// Fastest correction of a planted point's height, m/s.
const HOLD_SPEED: f64 = 0.3;
/// A planted point counts fully below the first height and not at all above the second, m.
const FADE: (f64, f64) = (0.004, 0.010);
/// A point of a planted foot is planned down fully where the motion has it below the first height, not at all above the second, m.
const PLANNED_FADE: (f64, f64) = (0.001, 0.006);
/// The same while the whole body works on the floor: heights of what touches, m, and of what the motion means to touch.
const FLOOR_FADE: (f64, f64) = (0.006, 0.020);
const MEANT_FADE: (f64, f64) = (0.004, 0.012);
/// There knees bear weight more easily than feet, and hands less, for what they cost the program: a knee has one contact point where a palm has
/// four, and hands that carry what knees could cannot be lifted.
const EASE: (f64, f64, f64) = (5.0, 0.5, 0.2);
/// Factor on the weight of the centre of mass of who lies: it is where the floor holds it.
const LYING: f64 = 1e-3;
/// What is kept of the last tick's contact force.
const FORCE_MEMORY: f64 = 0.98;
/// Weight with which a part that rests on a seat is held there when it carries all it may count for, and that share of the weight. Little while
/// the motion does not need the seat: who is nailed to it topples with it. Else as much along the surface and across it as in the second: a
/// plan in which the body sinks into its seat, or slides over it, lets the feet push with forces that the floor does not give, and they creep.
const REST_HOLD: f64 = 5.0;
const NEEDED_HOLD: (f64, f64) = (50.0, 500.0);
const REST_FULL: f64 = 0.2;
/// A part is held where it rests while the motion has it no higher than the first above that, not at all from the second on, m: a hand
/// that is to leave the seat is not nailed to it.
const LIFTED: (f64, f64) = (0.02, 0.06);
/// Distance of the capture point from the motion's at which balance begins to count more, and at which it counts most, m; how much more.
const DANGER: (f64, f64) = (0.04, 0.12);
const DANGER_FACTOR: f64 = 10.0;
/// Share of the weight on a seat from which the centre of mass counts least, and its factor then.
const SEATED_FULL: f64 = 0.3;
const SEATED_LEAST: f64 = 0.05;
/// The motion needs the seat where its capture point is less than the first inside the soles; from the second on it is about to get up, m.
const NEEDS_SEAT: (f64, f64) = (-0.02, 0.03);
/// A motion sits down that has its centre of mass over neither of two planted feet: wholly where it is farther inside than the first (outside,
/// being negative), not yet from the second on, m.
const SITS_DOWN: (f64, f64) = (-0.05, -0.01);
/// What one sits on. Hands that lean on a seat do not make it one.
const SEATED_ON: [SegmentId; 3] = [PELVIS, L_THIGH, R_THIGH];
/// Share of hold and force that segments other than feet get.
const OTHER_SEGMENT: f64 = 1e-3;
/// Iterations after which Newton's method has jammed and the interior-point method leads it on, and most of that. In gait the median is 3. From
/// prices of an unrelated problem both together, and Newton's last steps, take 52 at most in 320 cases.
const NEWTON_ITERATIONS: u32 = 20;
const INTERIOR_ITERATIONS: u32 = 30;
/// Newton's last steps go on to this share of the tolerance: coming from the interior, the first iterate within it has not converged
/// quadratically yet.
const POLISHED: f64 = 1e-2;
/// Most iterations of all kinds; residual of the equations of motion at which it stops, N·m.
const MAX_ITERATIONS: u32 = 60;
const TOLERANCE: f64 = 1e-3;
/// Points of one segment.
const POINTS: usize = MAX_CONTACTS / SEGMENT_COUNT;

/// The modern controller with its buffers and its memory of the last tick (warm start).
pub struct Modern {
    price: [f64; NV],
    last_torque: [f64; DOF_COUNT],
    last_force: Box<[Vec3; MAX_CONTACTS]>,
    p: Box<Dense>,
    y: Box<Dense>,
    a: Box<Dense>,
    hessian: Box<Dense>,
    contacts: ContactRows,
    /// Weight of each contact point's acceleration, world axes, and that acceleration.
    hold: Vec<(Hold, Vec3)>,
    limits: LimitRows,
    soles: Polygon,
    motors: Motors,
    newton: NewtonWorkspace,
    rows: Vec<TaskRow>,
    assist: [f64; 2],
    seat: Seat,
    command: Command,
}

/// Symmetric, world axes.
type Hold = [[f64; 3]; 3];

/// What seats and tables mean to the figure in this tick.
#[derive(Clone, Copy, Debug, Default)]
struct Seat {
    /// Share of the weight that they carry.
    carries: f64,
    /// 1 where the motion could not stand without, 0 where it could or is about to get up.
    needed: f64,
}

#[derive(Clone)]
struct TaskRow {
    row: [f64; WIDTH],
    weight: f64,
    value: f64,
}

impl std::fmt::Debug for Modern {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Modern")
            .field("command", &self.command)
            .finish_non_exhaustive()
    }
}

impl Modern {
    /// The last decision.
    pub fn command(&self) -> &Command {
        &self.command
    }

    /// A controller that plans with a little less friction than the simulator's `friction`.
    pub fn new(friction: f64) -> Self {
        let dense = || Box::new([[0.0; WIDTH]; NV]);
        Self {
            price: [0.0; NV],
            last_torque: [0.0; DOF_COUNT],
            last_force: Box::new([Vec3::zero(); MAX_CONTACTS]),
            p: dense(),
            y: dense(),
            a: dense(),
            hessian: dense(),
            contacts: ContactRows::new(friction * FRICTION_MARGIN),
            hold: Vec::with_capacity(MAX_CONTACTS),
            limits: LimitRows::default(),
            soles: Polygon::with_capacity(MAX_CONTACTS),
            motors: Motors::default(),
            newton: NewtonWorkspace::default(),
            rows: Vec::with_capacity(24 + 6 * MAX_GOALS),
            assist: [0.0; 2],
            seat: Seat::default(),
            command: Command::default(),
        }
    }

    /// Rows of the CoM, the end-effectors and the swing feet.
    fn collect_tasks(&mut self, input: &ControlInput<'_>, law: &Law) {
        self.rows.clear();
        let t = input.terms;
        let hand_law = Law::new(input.params, input.dt);
        let swing_law = hand_law.sharpened(SWING_SHARPNESS);
        if input.params.track_com {
            let mut a = com_law(input.com, t.com, t.com_velocity, input.dt);
            if let Some(balance) = input.balance {
                [a.x, a.y] = balance.acceleration;
            }
            let urgency = self.urgency(input);
            let a = a - t.com_bias;
            for (k, value) in [a.x, a.y, a.z].into_iter().enumerate() {
                self.rows.push(TaskRow {
                    row: t.jc[k],
                    weight: weight::COM[k] * urgency,
                    value,
                });
            }
        }
        self.take_off_task(input);
        if input.params.track_hands {
            for e in input.effectors {
                if input
                    .on_floor
                    .is_some_and(|f| is_clear(f.heights, e.segment))
                {
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
                    weight::HAND,
                );
            }
        }
        for goal in input.goals.iter().take(MAX_GOALS) {
            self.goal_task(t, goal, 1.0 / input.goals.len() as f64);
        }
        let next = &input.target.next;
        for (side, foot) in [(0, L_FOOT.index()), (1, R_FOOT.index())] {
            let (position, rotation) = &input.feet[side];
            // A planted foot is held where it touches; a swinging one is led. Both are turned as the motion turns them: a heel that
            // has come up is out of reach of the contact rows.
            let turn = if next.planted[side] {
                weight::PLANTED_ROTATION
            } else {
                weight::SWING_ROTATION
            };
            if !next.planted[side] && input.on_floor.is_none() {
                self.point_task(
                    t,
                    &swing_law,
                    (foot, Vec3::zero()),
                    position,
                    SWING_FEEDBACK,
                    weight::SWING_FOOT,
                );
            }
            let error = rotation_error(t, foot, rotation.now);
            let w = t.kin.omega[foot];
            let feedback = law_feedback(law, error, rotation.now_velocity - w);
            let ff = (rotation.next_velocity - rotation.now_velocity) * (1.0 / input.dt);
            let (bias, _) = t.segment_bias(foot);
            let a = ff + soft(feedback, ROTATION_FEEDBACK) - bias;
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

    /// Factor on the weight of the centre of mass. Who cannot step and is about to fall lets the posture go rather than the balance. Who
    /// sits has no balance to keep, and would bend to put its centre of mass where another seat would have had it; not so while
    /// the motion is getting up, which takes a centre of mass over the feet. Who sits down lets himself fall onto the seat as the motion does.
    fn urgency(&mut self, input: &ControlInput<'_>) -> f64 {
        let planted = [input.target.now.planted, input.target.next.planted];
        if let Some(floor) = input.on_floor {
            return if floor.lies { LYING } else { 1.0 };
        }
        let mut most = 1.0;
        if planted == [[true; 2]; 2] {
            let margin = self.margin_on_feet(input, [input.com.now.x, input.com.now.y]);
            most -= (1.0 - SEATED_LEAST) * smooth_step(margin, SITS_DOWN);
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

    /// What seats carry, and whether the motion needs them.
    fn sit(&mut self, input: &ControlInput<'_>) -> Seat {
        let mg = input.terms.mass * input.gravity.max(1.0);
        let level = input.support.rests().iter().filter(|r| r.is_level());
        let seats = level.filter(|r| SEATED_ON.contains(&r.segment));
        let carries = seats.map(|r| r.force.z).sum::<f64>() / mg;
        if carries <= 0.0 {
            return Seat::default();
        }
        let capture = input.com.now + input.com.now_velocity * pendulum_time(input);
        let margin = self.margin_on_feet(input, [capture.x, capture.y]);
        let needed = smooth_step(margin, NEEDS_SEAT);
        Seat { carries, needed }
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

    /// A constraint from outside. Its weight grows with the cube of how far it is in force: that spreads the passage from the posture's hold to its
    /// own over the time in which it comes or goes. Several share what one may pull with, or together they would pull a figure off its feet.
    fn goal_task(&mut self, t: &Terms, goal: &Goal, share: f64) {
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
        let a = ff + soft(feedback, most) - t.point_bias(s, point);
        let mut j = [[0.0; WIDTH]; 3];
        t.point_jacobian(s, point, &mut j);
        for (row, value) in j.into_iter().zip([a.x, a.y, a.z]) {
            self.rows.push(TaskRow { row, weight, value });
        }
    }

    /// Contact points that the plan keeps down, faded by height, with the acceleration that brings them to rest.
    fn collect_contacts(&mut self, input: &ControlInput<'_>) {
        self.contacts.clear();
        self.hold.clear();
        let t = input.terms;
        let planted = input.target.next.planted;
        let mg = t.mass * input.gravity.max(1.0);
        for s in 0..SEGMENT_COUNT {
            for rest in input.support.rests().iter().filter(|r| r.is_level()) {
                if rest.segment.index() != s || self.contacts.points.len() >= MAX_CONTACTS {
                    continue;
                }
                // What rests on a seat or a table is pushed by it as the solution needs, starting from what it gave.
                let stays = smooth_step(rest.lift, LIFTED);
                let share = stays * (rest.force.norm() / (REST_FULL * mg)).min(1.0);
                let r = rest.position - t.segment_position(s);
                let local = t.kin.rotation[s].transpose_mul(r);
                let v = t.kin.velocity[s] + t.kin.omega[s].cross(r);
                let a = v * (-1.0 / HOLD_TIME) - t.point_bias(s, local);
                let inverse_r = share.max(OTHER_SEGMENT) / weight::FORCE;
                let slot = self.contacts.slot(&t.kin, s);
                self.contacts.points.push(PointRow {
                    slot,
                    r,
                    c: rest.force * (-FORCE_MEMORY / inverse_r),
                    inverse_r,
                    segment: s,
                    vertex: POINTS,
                    turn: Rest::frame(rest.normal),
                });
                let weight =
                    |most: f64| share * (REST_HOLD + self.seat.needed * (most - REST_HOLD));
                let (along, across) = (weight(NEEDED_HOLD.0), weight(NEEDED_HOLD.1));
                self.hold.push((hold(along, across, rest.normal), a));
            }
            let foot = s == L_FOOT.index()
                || s == L_TOES.index()
                || s == R_FOOT.index()
                || s == R_TOES.index();
            let steps = input.on_floor.is_none();
            if steps && foot && !planted[usize::from(s >= R_FOOT.index())] {
                self.last_force[s * POINTS..(s + 1) * POINTS].fill(Vec3::zero());
                continue;
            }
            for (vertex, p) in input.body.segments[s]
                .contact_points
                .iter()
                .enumerate()
                .take(POINTS)
            {
                let r = t.kin.rotation[s] * *p;
                let z = t.segment_position(s).z + r.z;
                let mut fade = smooth_step(z, FADE);
                let (mut slides, mut held) = (false, 1.0);
                if let Some(floor) = input.on_floor {
                    slides = floor.slides[s];
                    let meant = smooth_step(floor.heights[s * POINTS + vertex], MEANT_FADE);
                    fade = smooth_step(z, FLOOR_FADE);
                    // Who rolls over carries itself with whatever touches, also where that is about to come off.
                    if floor.rolls {
                        held = meant;
                    } else {
                        fade *= meant;
                    }
                } else if foot {
                    fade *= planned(input, s, *p);
                } else {
                    fade *= OTHER_SEGMENT;
                }
                if fade <= 0.0 {
                    self.last_force[s * POINTS + vertex] = Vec3::zero();
                    continue;
                }
                let v = t.kin.velocity[s] + t.kin.omega[s].cross(r);
                let rise = (-0.2 * z / input.dt).clamp(-HOLD_SPEED, HOLD_SPEED);
                // What strikes the floor within the tick is at rest at its end, whatever is planned.
                let strikes = 1.0 - smooth_step(-v.z - z.max(0.0) / input.dt, STRIKES);
                let pace = blend(1.0 / HOLD_TIME, 1.0 / input.dt, strikes);
                let to_rest = Vec3 {
                    x: -v.x,
                    y: -v.y,
                    z: rise - v.z,
                };
                let a = soft(to_rest * pace, STOP) - t.point_bias(s, *p);
                let ease = if steps { 1.0 } else { ease(s, foot) };
                let inverse_r = ease * fade.max(OTHER_SEGMENT) / weight::FORCE;
                let c = self.last_force[s * POINTS + vertex] * (-FORCE_MEMORY / inverse_r);
                let slot = self.contacts.slot(&t.kin, s);
                self.contacts.points.push(PointRow {
                    slot,
                    r,
                    c,
                    inverse_r,
                    segment: s,
                    vertex,
                    turn: None,
                });
                let w = weight::HOLD * fade * held;
                let along = if slides { 0.0 } else { w };
                self.hold.push((hold(along, w, Vec3::Z), a));
            }
        }
    }
}

/// √(height of the centre of mass / gravity), s.
fn pendulum_time(input: &ControlInput<'_>) -> f64 {
    (input.terms.com.z.max(0.1) / input.gravity.max(1.0)).sqrt()
}

/// How easily a segment bears weight on the floor.
fn ease(s: usize, foot: bool) -> f64 {
    if foot {
        EASE.1
    } else if s == L_HAND.index() || s == R_HAND.index() {
        EASE.2
    } else {
        EASE.0
    }
}

/// True if the motion has all contact points of a segment, at `heights`, clear of the floor.
fn is_clear(heights: &[f64; MAX_CONTACTS], segment: SegmentId) -> bool {
    let first = segment.index() * POINTS;
    heights[first..first + POINTS]
        .iter()
        .all(|z| *z > MEANT_FADE.0)
}

/// 0 where the capture point is where the motion has it, 1 where it is far off.
fn danger(input: &ControlInput<'_>) -> f64 {
    let (t, goal) = (input.terms, input.com);
    let time = pendulum_time(input);
    let off = (t.com - goal.now) + (t.com_velocity - goal.now_velocity) * time;
    1.0 - smooth_step((off.x * off.x + off.y * off.y).sqrt(), DANGER)
}

/// The law of joints and rotations.
fn sharp_law(input: &ControlInput<'_>, danger: f64) -> Law {
    let share = blend(SHARPNESS, YIELDING_SHARPNESS, danger);
    Law::new(input.params, input.dt).sharpened(share)
}

/// From `a` to `b`.
fn blend(a: f64, b: f64, share: f64) -> f64 {
    a + share * (b - a)
}

/// Weights along a surface and across it.
fn hold(along: f64, across: f64, normal: Vec3) -> Hold {
    let n = normal.to_array();
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let own = if i == j { along } else { 0.0 };
            own + (across - along) * n[i] * n[j]
        })
    })
}

/// `(0.25/T²) error + (1/T) rate error`: the feedback part of the law with horizon.
fn law_feedback(law: &Law, error: Vec3, rate: Vec3) -> Vec3 {
    let t = law.horizon_or_step();
    error * (0.25 / (t * t)) + rate * (1.0 / t)
}

/// 1 below the first height, 0 above the second, C¹ between.
fn smooth_step(z: f64, (low, high): (f64, f64)) -> f64 {
    let u = ((high - z) / (high - low)).clamp(0.0, 1.0);
    u * u * (3.0 - 2.0 * u)
}

/// How far the plan keeps a point of a planted foot down: a heel that the motion lifts is not held.
fn planned(input: &ControlInput<'_>, s: usize, point: Vec3) -> f64 {
    let side = usize::from(s >= R_FOOT.index());
    if s == L_TOES.index() || s == R_TOES.index() {
        return 1.0;
    }
    let (position, rotation) = &input.feet[side];
    smooth_step(
        position.next.z + rotation.next.rotate(point).z,
        PLANNED_FADE,
    )
}

/// Capped in norm.
fn soft(a: Vec3, most: f64) -> Vec3 {
    let n = a.norm();
    if n > most { a * (most / n) } else { a }
}

/// Rotation vector from the segment's present rotation to `desired`, world axes.
fn rotation_error(t: &Terms, s: usize, desired: Quat) -> Vec3 {
    (desired * Quat::from_mat3(&t.kin.rotation[s]).conjugate()).log()
}

fn pelvis_demand(t: &Terms, target: &TargetPair, law: &Law, dt: f64) -> Vec3 {
    let w = |v: &[f64; NV]| Vec3 {
        x: v[0],
        y: v[1],
        z: v[2],
    };
    let (now, next) = (w(&target.now.velocity), w(&target.next.velocity));
    let error =
        (target.now.posture.root_rotation * t.state.posture.root_rotation.conjugate()).log();
    (next - now) * (1.0 / dt)
        + soft(
            law_feedback(law, error, now - w(&t.state.velocity)),
            ROTATION_FEEDBACK,
        )
}

impl Controller for Modern {
    fn control(&mut self, input: &ControlInput<'_>) -> &Command {
        let danger = if input.on_floor.is_some() {
            0.0
        } else {
            danger(input)
        };
        let law = sharp_law(input, danger);
        let least = blend(JOINT_WEIGHT, LEAST_JOINT_WEIGHT, danger);
        let t = input.terms;
        self.seat = self.sit(input);
        self.collect_tasks(input, &law);
        self.collect_contacts(input);
        let demand = initial_acceleration(input.body, &t.state, input.target, &law);

        // Diagonal part of P and p: base, joints, pelvis rotation.
        let mut diagonal = [weight::BASE; NV];
        let mut linear = [0.0; WIDTH];
        let w = pelvis_demand(t, input.target, &law, input.dt);
        let rolls = input.on_floor.is_some_and(|f| f.rolls);
        let turns = if rolls {
            weight::ROLLING
        } else {
            weight::PELVIS
        };
        for (k, value) in [w.x, w.y, w.z].into_iter().enumerate() {
            diagonal[k] += turns;
            linear[k] += turns * value;
        }
        for j in 0..DOF_COUNT {
            let wj = t.m[6 + j][6 + j].max(least).min(JOINT_WEIGHT);
            diagonal[6 + j] = wj;
            linear[6 + j] = wj * demand[j];
            let rho = 0.5 * (input.upper[j] - input.lower[j]);
            self.motors.gain[j] = rho * rho / weight::TORQUE;
            self.motors.lower[j] = input.lower[j];
            self.motors.upper[j] = input.upper[j];
            self.motors.rest[j] =
                self.last_torque[j].clamp(input.lower[j], input.upper[j]) / self.motors.gain[j];
        }
        // A limb that is led from outside lets go of its posture, or that would hold it back.
        for goal in input.goals.iter().take(MAX_GOALS) {
            for s in goal.limb() {
                let wrist = s == L_HAND.index() || s == R_HAND.index();
                let led = if wrist { LED_WRIST } else { LED_LIMB };
                for d in 6 + DOF_START[s]..6 + DOF_START[s] + DOF_LEN[s] {
                    let keep = diagonal[d] + goal.weight * (led - diagonal[d]);
                    linear[d] *= keep / diagonal[d];
                    diagonal[d] = keep;
                }
            }
        }
        self.assist = input.assist;
        let outcome = kernel(self, t, &diagonal, &mut linear);
        if !outcome.converged {
            // An iterate that got nowhere is no place to start the next tick from.
            self.price = [0.0; NV];
        }
        let c = &mut self.command;
        c.flags = Flags::default();
        if !outcome.converged {
            c.flags.set(Flags::CONTROL_BOUND);
        }
        c.iterations = outcome.iterations;
        c.saturated = 0;
        c.saturated_secondary = 0;
        for j in 0..DOF_COUNT {
            let tau = self.newton.motor[j];
            c.torque[j] = tau;
            self.last_torque[j] = tau;
            if tau <= input.lower[j] || tau >= input.upper[j] {
                c.saturated |= 1 << j;
            }
            c.joint_acceleration[j] = c.acceleration[6 + j];
        }
        let (mut force, mut moment) = (Vec3::zero(), Vec3::zero());
        for (k, p) in self.contacts.points.iter().enumerate() {
            let f = self.newton.force[k];
            if p.vertex < POINTS {
                self.last_force[p.segment * POINTS + p.vertex] = f;
            }
            force += f;
            moment += (t.segment_position(p.segment) + p.r).cross(f);
        }
        c.zmp = (force.z > 1.0).then(|| Vec3 {
            x: -moment.y / force.z,
            y: moment.x / force.z,
            z: 0.0,
        });
        c.margin = c.zmp.and_then(|z| input.support.margin(z));
        c.pivot = None;
        if input.support.main().is_none() && input.support.rests().is_empty() {
            c.flags.set(Flags::FLIGHT);
        }
        &self.command
    }

    fn reset(&mut self) {
        self.price = [0.0; NV];
        self.last_torque = [0.0; DOF_COUNT];
        self.last_force.fill(Vec3::zero());
    }
}

/// Builds P, A and b, solves for the price x, and leaves v̇ in the command.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn kernel(c: &mut Modern, t: &Terms, diagonal: &[f64; NV], linear: &mut [f64; WIDTH]) -> Outcome {
    // 1. P: diagonal + task rows + held points. Column j of the lower triangle is row j.
    for (j, row) in c.p.iter_mut().enumerate() {
        row.fill(0.0);
        row[j] = diagonal[j];
    }
    for task in &c.rows {
        for j in 0..NV {
            let a = task.weight * task.row[j];
            if a != 0.0 {
                linear[j] += a * task.value;
                for (x, y) in c.p[j].iter_mut().zip(&task.row) {
                    *x += a * y;
                }
            }
        }
    }
    let mut stiffness = [[[0.0; 6]; 6]; SEGMENT_COUNT];
    let mut pull = [[0.0; 6]; SEGMENT_COUNT];
    for (p, (w, a)) in c.contacts.points.iter().zip(&c.hold) {
        add_point_stiffness(&mut stiffness[p.slot], p.r, w);
        let a = a.to_array();
        let f = Vec3::from_array(w.map(|row| row[0] * a[0] + row[1] * a[1] + row[2] * a[2]));
        let n = p.r.cross(f);
        for (x, y) in pull[p.slot].iter_mut().zip([n.x, n.y, n.z, f.x, f.y, f.z]) {
            *x += y;
        }
    }
    for (slot, s) in c.contacts.segments.iter().enumerate() {
        let mut kj = [[0.0; CHAIN_WIDTH]; 6];
        for a in 0..6 {
            for b in 0..6 {
                let y = stiffness[slot][a][b];
                for i in 0..CHAIN_WIDTH {
                    kj[a][i] += y * s.jacobian[b][i];
                }
            }
        }
        for (i, ci) in s.chain().iter().enumerate() {
            for (k, ck) in s.chain().iter().enumerate().take(i + 1) {
                let mut z = 0.0;
                for a in 0..6 {
                    z += s.jacobian[a][i] * kj[a][k];
                }
                c.p[*ck][*ci] += z;
            }
            for a in 0..6 {
                linear[*ci] += s.jacobian[a][i] * pull[slot][a];
            }
        }
    }
    // 2. Y = L⁻¹ M, A = YᵀY = M P⁻¹ M, b = −(Yᵀ L⁻¹ p + h). P is positive definite: every diagonal entry has its own weight.
    let positive = cholesky(&mut c.p);
    debug_assert!(positive, "P is positive definite by construction");
    *c.y = *t.m;
    for j in 0..NV {
        let (head, tail) = c.y.split_at_mut(j + 1);
        let row = &mut head[j];
        let s = 1.0 / c.p[j][j];
        for x in row.iter_mut() {
            *x *= s;
        }
        for (k, other) in tail.iter_mut().enumerate() {
            let a = c.p[j][j + 1 + k];
            if a != 0.0 {
                for (x, y) in other.iter_mut().zip(row.iter()) {
                    *x -= a * y;
                }
            }
        }
    }
    for i in (0..NV).step_by(3) {
        let mut acc = [[0.0; WIDTH]; 3];
        for row in c.y.iter() {
            let (a0, a1, a2) = (row[i], row[i + 1], row[i + 2]);
            for k in 0..WIDTH {
                acc[0][k] += a0 * row[k];
                acc[1][k] += a1 * row[k];
                acc[2][k] += a2 * row[k];
            }
        }
        c.a[i..i + 3].copy_from_slice(&acc);
    }
    // Assist: forces on the pelvis at a price of their own add their compliance to the root's diagonal of the dual.
    for i in 0..6 {
        c.a[i][i] += c.assist[i / 3];
    }
    let mut lp = *linear;
    solve_lower(&c.p, &mut lp);
    let mut b = [0.0; NV];
    for i in 0..NV {
        b[i] = -t.h[i];
    }
    for (row, l) in c.y.iter().zip(&lp) {
        for i in 0..NV {
            b[i] -= row[i] * l;
        }
    }
    // 3. Newton on the dual; 4. v̇ = P⁻¹(p + M x).
    let system = DenseSystem(&c.a);
    let mut outcome = minimise(
        &system,
        &mut c.hessian,
        &b,
        &c.motors,
        &c.limits,
        &c.contacts,
        NEWTON_ITERATIONS,
        TOLERANCE,
        &mut c.price,
        &mut c.newton,
    );
    if !outcome.converged {
        // Jammed between the corners of motors and cones, as happens far from the last tick's problem.
        let used = interior::approach(
            &system,
            &mut c.hessian,
            &b,
            &c.motors,
            &c.contacts,
            INTERIOR_ITERATIONS,
            &mut c.price,
            &mut c.newton,
        );
        let before = outcome.iterations + used;
        outcome = minimise(
            &system,
            &mut c.hessian,
            &b,
            &c.motors,
            &c.limits,
            &c.contacts,
            MAX_ITERATIONS.saturating_sub(before),
            POLISHED * TOLERANCE,
            &mut c.price,
            &mut c.newton,
        );
        outcome.iterations += before;
        outcome.converged = outcome.residual < TOLERANCE;
    }
    let mut v = *linear;
    for (row, x) in t.m.iter().zip(&c.price) {
        for i in 0..WIDTH {
            v[i] += row[i] * x;
        }
    }
    solve_lower(&c.p, &mut v);
    solve_upper(&c.p, &mut v);
    c.command.acceleration.copy_from_slice(&v[..NV]);
    outcome
}

#[cfg(test)]
mod tests;
