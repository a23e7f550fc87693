//! Modern mode: whole-body tracking as one convex program, solved through its dual (`docs/equations.md`, 14.1–14.2).
//!
//! Unknowns are the 45 accelerations, 39 torques and the forces of the planned contact points; the dual has 45 unknowns
//! and is the same kernel as the simulator's substep. Torques stay within strength and forces within friction at every
//! iterate, the solution is a continuous function of the state, and the work is bounded.
//!
//! A figure that is helped has one more unknown, a wrench on its pelvis with a price and a bound
//! ([`HelpAllowance`](super::HelpAllowance)). It does whatever strength, soles and friction cannot, and acts exactly as
//! planned.

use super::goals::MAX_GOALS;
use super::tracking::{Law, initial_acceleration};
use super::{Command, ControlInput, Controller, HelpAllowance};
use crate::body::topology::{
    DOF_COUNT, DOF_LEN, DOF_START, L_HAND, L_UPPER_ARM, NV, R_HAND, R_UPPER_ARM, SEGMENT_COUNT,
};
use crate::contact::dense::Dense;
use crate::contact::rows::{CHAIN_WIDTH, add_point_stiffness};
use crate::contact::{
    BallForce, ContactRows, ConvexProblem, DenseSystem, Interior, LimitRows, Motors,
    NewtonWorkspace, RootWrench, SolveOutcome, StopRule, interior, minimise,
};
use crate::dynamics::Terms;
use crate::dynamics::terms::WIDTH;
use crate::math::curve::fall;
use crate::math::dense::{
    factor_body_columns, gram_of_columns, solve_lower, solve_lower_rows, solve_upper, weighted_gram,
};
use crate::math::{Quat, Vec3};
use crate::motion::TargetPair;
use crate::report::Flags;
use crate::report::MAX_CONTACTS;
use crate::support::{Polygon, zmp_above};
use multiversion::multiversion;
use pendulum::pendulum_time;

pub use memory::ModernMemory;

mod contacts;
mod memory;
mod momentum;
mod pendulum;
mod roll;
mod tasks;

/// Weights in units of force: the cost of a task is about (inertia × acceleration error)², so that 100 rad/s² of a foot
/// cost less than 1 m/s² of the body (`docs/locomotion.md#balance`). The weights of hands, joints and planted feet were
/// tuned on recorded motion: docs/adr/0004.
mod weight {
    pub(super) const COM: [f64; 3] = [1000.0, 1000.0, 300.0];
    /// Upwards at lift-off: a deficit then cannot be made up for in the air.
    pub(super) const COM_LIFT_OFF: f64 = 1000.0;
    /// The same in all directions for a helped figure: help carries what the legs do not.
    pub(super) const COM_HELPED: [f64; 3] = [1000.0; 3];
    pub(super) const HAND: f64 = 1.0;
    /// Client constraints, fully in force: a bounded pull that moves the centre of mass by 3 cm when it cannot be met.
    pub(super) const GOAL: f64 = 100.0;
    pub(super) const GOAL_ARM: f64 = 200.0;
    pub(super) const GOAL_ROTATION: f64 = 20.0;
    pub(super) const SWING_FOOT: f64 = 100.0;
    /// A hand that is clear of the floor, between two phases of leaning on it.
    pub(super) const SWING_HAND: f64 = 10.0;
    pub(super) const SWING_ROTATION: f64 = 4.0;
    pub(super) const PLANTED_ROTATION: f64 = 1.0;
    pub(super) const PELVIS: f64 = 20.0;
    /// The same for a figure that lies and rolls over.
    pub(super) const ROLLING: f64 = 300.0;
    pub(super) const HOLD: f64 = 5000.0;
    pub(super) const BASE: f64 = 1e-6;
    /// ε: pull of a torque, relative to its half-range, towards the last tick's.
    pub(super) const TORQUE: f64 = 10.0;
    /// w_f: pull of a contact force towards the last tick's.
    pub(super) const FORCE: f64 = 1e-3;
}
/// Weight of a joint while the body is at its place in the motion. When the body is about to fall, the weight is
/// `clip(M_jj, …)` between the least and this: light joints give way then, but with less than the least weight, wrists
/// and toes would pay for every other task.
const JOINT_WEIGHT: f64 = 1.0;
const LEAST_JOINT_WEIGHT: f64 = 0.05;
/// Weights of the joints of a limb that a client constraint leads, and of its wrist, which is light and would reach its
/// limit first.
const LED_LIMB: f64 = 0.02;
const LED_WRIST: f64 = 0.2;
/// Load in a hand at which arm and hand have a quarter of their weight, kg.
const HALF_ARM: f64 = 2.0;
/// Degrees of freedom from the shoulder to the wrist; they are consecutive.
const ARM_DOFS: usize = 7;
/// Friction that the plan assumes; less than the simulator's.
const FRICTION_MARGIN: f64 = 0.7 / 0.9;
/// Horizon of joints and rotations as a share of the one that is set (0.1 s): 278/s² and 33/s. Contacts need limbs that
/// are on time, and unlike the paper's active set, the continuous program does not chatter with these gains.
const SHARPNESS: f64 = 0.3;
/// The same when the body is about to fall (149/s², 24/s): balance must not have to fight the posture.
const YIELDING_SHARPNESS: f64 = 0.41;
/// Largest feedback of a rotation, rad/s².
const ROTATION_FEEDBACK: f64 = 50.0;
/// Distance of the capture point from the motion's at which the weight of balance begins to rise, and at which it is
/// largest, m.
const DANGER: (f64, f64) = (0.04, 0.12);
/// Number of iterations after which Newton's method has jammed and the interior-point method takes over, and the most
/// iterations of the latter. In walks the median is 3. Started from the multipliers of an unrelated problem, the two
/// methods together, with Newton's last steps, needed at most 52 iterations in 320 tests.
const NEWTON_ITERATIONS: u32 = 20;
const INTERIOR_ITERATIONS: u32 = 30;
/// Newton's last steps continue to this share of the tolerance: coming from the interior, the first iterate within the
/// tolerance has not converged quadratically yet.
const POLISHED: f64 = 1e-2;
/// Most iterations of all kinds; residual of the equations of motion at which it stops, N·m.
const MAX_ITERATIONS: u32 = 60;
const TOLERANCE: f64 = 1e-3;
/// Points of one segment.
const POINTS: usize = MAX_CONTACTS / SEGMENT_COUNT;

/// The modern controller with its buffers and its memory of the last tick (warm start).
///
/// Problem 14.1.
pub struct Modern {
    memory: ModernMemory,
    p: Box<Dense>,
    y: Box<Dense>,
    a: Box<Dense>,
    hessian: Box<Dense>,
    contacts: ContactRows,
    /// Weight of each contact point's acceleration, world axes, and that acceleration.
    hold: Vec<(HoldStiffness, Vec3)>,
    limits: LimitRows,
    soles: Polygon,
    motors: Motors,
    newton: NewtonWorkspace,
    interior: Box<Interior>,
    rows: Vec<TaskRow>,
    assist: [f64; 2],
    wrench: Option<RootWrench>,
    seat: SeatLoad,
    command: Command,
}

/// Symmetric, world axes.
type HoldStiffness = [[f64; 3]; 3];

/// The role of seats and tables in this tick.
#[derive(Clone, Copy, Debug, Default)]
struct SeatLoad {
    /// Share of the weight that they carry.
    carries: f64,
    /// 1 if the motion could not stand without them, 0 if it could or is about to get up.
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
    /// Exchanges its memory for `memory`: that of a figure when its tick begins, and the same back when it ends.
    pub fn swap_memory(&mut self, memory: &mut ModernMemory) {
        std::mem::swap(&mut self.memory, memory);
    }

    /// Plans from now on with a little less friction than the simulator's `friction`.
    pub fn set_friction(&mut self, friction: f64) {
        self.contacts.friction = friction * FRICTION_MARGIN;
    }

    /// A controller that plans with a little less friction than the simulator's `friction`.
    pub fn new(friction: f64) -> Self {
        let dense = || Box::new([[0.0; WIDTH]; NV]);
        Self {
            memory: ModernMemory::default(),
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
            interior: Box::default(),
            rows: Vec::with_capacity(24 + 6 * MAX_GOALS),
            assist: [0.0; 2],
            wrench: None,
            seat: SeatLoad::default(),
            command: Command::default(),
        }
    }
}

/// 0 if the capture point is at its place in the motion, 1 if it is far off.
fn danger(input: &ControlInput<'_>) -> f64 {
    let (t, goal) = (input.terms, input.centroidal.com);
    let time = pendulum_time(input);
    let off = (t.com - goal.now) + (t.com_velocity - goal.now_velocity) * time;
    1.0 - fall((off.x * off.x + off.y * off.y).sqrt(), DANGER)
}

/// Factor on the weights of an arm whose hand carries `load`, kg. A joint at its limit can still be turned by moving
/// the segment that it hangs on: an arm too weak for its load would twist the trunk under it. So the arm gives way; if
/// it has the strength, the weight does not matter.
fn gives_way(load: f64) -> f64 {
    let share = HALF_ARM / (HALF_ARM + load);
    share * share
}

/// The law of joints and rotations.
fn sharp_law(input: &ControlInput<'_>, danger: f64) -> Law {
    let share = blend(SHARPNESS, YIELDING_SHARPNESS, danger);
    Law::new(input.params, input.dt).sharpened(share)
}

/// Linear interpolation from `a` to `b`.
fn blend(a: f64, b: f64, share: f64) -> f64 {
    a + share * (b - a)
}

/// `(0.25/T²) error + (1/T) rate error`: the feedback part of the law with horizon.
fn law_feedback(law: &Law, error: Vec3, rate: Vec3) -> Vec3 {
    let t = law.horizon_or_step();
    error * (0.25 / (t * t)) + rate * (1.0 / t)
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
        + law_feedback(law, error, now - w(&t.state.velocity)).capped(ROTATION_FEEDBACK)
}

impl HelpAllowance<'_> {
    /// The wrench in the dual. Its cost is `½ |w|²/c + ½ |w − last|² k/((1 − k) c)`, with the compliance c and the
    /// share k that is kept; together `½ |w − k last|²/((1 − k) c)`.
    fn ball(&self, last: &[Vec3; 2]) -> RootWrench {
        RootWrench(std::array::from_fn(|k| BallForce {
            gain: (1.0 - self.kept) * self.compliance[k],
            rest: last[k].capped(self.most[k]) * self.kept,
            most: self.most[k],
        }))
    }
}

impl Controller for Modern {
    fn control(&mut self, input: &ControlInput<'_>) -> &Command {
        let danger = if input.contacts.floor.is_some() {
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
        let rolls = input.contacts.floor.is_some_and(|f| f.rolls);
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
                self.memory.torque[j].clamp(input.lower[j], input.upper[j]) / self.motors.gain[j];
        }
        for (upper, load) in [L_UPPER_ARM, R_UPPER_ARM].into_iter().zip(input.carried) {
            if load > 0.0 {
                let keep = gives_way(load);
                let first = 6 + DOF_START[upper.index()];
                for d in first..first + ARM_DOFS {
                    diagonal[d] *= keep;
                    linear[d] *= keep;
                }
            }
        }
        // A limb that a client leads gives up its posture, which would otherwise hold it back.
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
        self.wrench = (input.help.as_ref()).map(|help| help.ball(&self.memory.wrench));
        let Some(outcome) = kernel(self, t, &diagonal, &mut linear) else {
            self.command = Command {
                acceleration: [f64::NAN; NV],
                joint_acceleration: [f64::NAN; DOF_COUNT],
                torque: [f64::NAN; DOF_COUNT],
                ..Command::default()
            };
            return &self.command;
        };
        if !outcome.converged {
            // An iterate without progress is no starting point for the next tick.
            self.memory.price = [0.0; NV];
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
            self.memory.torque[j] = tau;
            if tau <= input.lower[j] || tau >= input.upper[j] {
                c.saturated |= 1 << j;
            }
            c.joint_acceleration[j] = c.acceleration[6 + j];
        }
        c.wrench = match self.wrench {
            Some(_) => self.newton.wrench.map(|w| w.force),
            None => [Vec3::zero(); 2],
        };
        self.memory.wrench = c.wrench;
        let (mut force, mut moment) = (Vec3::zero(), Vec3::zero());
        for (k, p) in self.contacts.points.iter().enumerate() {
            let f = self.newton.force[k];
            if p.vertex < POINTS {
                self.memory.force[p.segment * POINTS + p.vertex] = f;
            }
            force += f;
            moment += (t.segment_position(p.segment) + p.r).cross(f);
        }
        c.zmp = zmp_above(1.0, force, moment);
        c.margin = c.zmp.and_then(|z| input.support.margin(z));
        c.pivot = None;
        if input.support.main().is_none() && input.support.rests().is_empty() {
            c.flags.set(Flags::FLIGHT);
        }
        &self.command
    }

    fn command(&self) -> &Command {
        &self.command
    }

    fn reset(&mut self) {
        self.memory.reset();
    }
}

/// Builds P, A and b, solves for the price x, and leaves v̇ in the command. `None`: numbers of the desired motion or of
/// the state make no valid problem.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn kernel(
    c: &mut Modern,
    t: &Terms,
    diagonal: &[f64; NV],
    linear: &mut [f64; WIDTH],
) -> Option<SolveOutcome> {
    // 1. P: diagonal + task rows + held points. Column j of the lower triangle is row j.
    let rows = c.rows.iter().map(|task| (task.weight, &task.row));
    weighted_gram(diagonal, rows, &mut c.p);
    for task in &c.rows {
        for (x, r) in linear.iter_mut().zip(&task.row) {
            *x += task.weight * r * task.value;
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
    // 2. Y = L⁻¹ M, A = YᵀY = M P⁻¹ M, b = −(Yᵀ L⁻¹ p + h). P is positive definite, since every diagonal entry has its
    //    own weight, unless one of its numbers is out of range.
    if !factor_body_columns(&mut c.p) {
        return None;
    }
    solve_lower_rows(&c.p, &t.m, &mut c.y);
    gram_of_columns(&c.y, &mut c.a);
    // Assist: forces on the pelvis at their own price add their compliance to the root's diagonal of the dual.
    for i in 0..6 {
        c.a[i][i] += c.assist[i / 3];
    }
    let mut lp = *linear;
    solve_lower(c.p.as_flattened(), &mut lp);
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
    let problem = ConvexProblem {
        system: DenseSystem(&c.a),
        b: &b,
        motors: &c.motors,
        limits: &c.limits,
        contacts: &c.contacts,
        wrench: c.wrench.as_ref(),
    };
    let (hessian, price, newton) = (&mut c.hessian, &mut c.memory.price, &mut c.newton);
    let stop = StopRule {
        iterations: NEWTON_ITERATIONS,
        tolerance: TOLERANCE,
    };
    let mut outcome = minimise(&problem, stop, hessian, price, newton);
    if !outcome.converged {
        // Jammed between the corners of motors and cones, as happens far from the last tick's problem.
        let used = interior::approach(
            &problem,
            INTERIOR_ITERATIONS,
            hessian,
            price,
            &mut c.interior,
            newton,
        );
        let before = outcome.iterations + used;
        let stop = StopRule {
            iterations: MAX_ITERATIONS.saturating_sub(before),
            tolerance: POLISHED * TOLERANCE,
        };
        outcome = minimise(&problem, stop, hessian, price, newton);
        outcome.iterations += before;
        outcome.converged = outcome.residual < TOLERANCE;
    }
    let mut v = *linear;
    for (row, x) in t.m.iter().zip(&c.memory.price) {
        for i in 0..WIDTH {
            v[i] += row[i] * x;
        }
    }
    solve_lower(c.p.as_flattened(), &mut v);
    solve_upper(c.p.as_flattened(), &mut v);
    c.command.acceleration.copy_from_slice(&v[..NV]);
    Some(outcome)
}

#[cfg(test)]
mod tests;
