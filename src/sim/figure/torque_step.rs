//! Full rigid-body dynamics driven by strength-limited motors, with contact and joint limits.
//!
//! One substep solves, implicitly and all at once, for the velocity at its end: motors that pull towards the commanded
//! motion within the strength of that instant, unilateral joint limits, and speculative frictional contact with the
//! ground. Then the step is *closed*: the velocity is recomputed from the impulses of the last iterate, so that
//! torques, contact forces and accelerations satisfy the equations of motion to rounding whatever residual the
//! iteration stopped at.

use super::assist::{PelvisHelp, Spring};
use super::loads::{Bar, MAX_EXTERNAL};
use super::params::{bar, contact, motors, self_contact};
use super::self_contact::{OwnBody, SelfContact};
use super::tick::TickContext;
use crate::sim::body::topology::{DOF_COUNT, NV, SEGMENT_COUNT, SegmentId};
use crate::sim::body::{Body, Links, State};
use crate::sim::collide::island::{Articulated, Parts};
use crate::sim::contact::rows::PointRow;
use crate::sim::contact::{
    ContactRows, LimitRows, Motors, NewtonWorkspace, Outcome, Problem, Slides, SparseSystem,
    StopRule, Tissue, collect_limits, minimise, slides,
};
use crate::sim::dynamics::jacobian::for_each_column;
use crate::sim::dynamics::terms::AppliedForce;
use crate::sim::dynamics::{MassMatrix, Terms, factor, solve};
use crate::sim::math::Vec3;
use crate::sim::report::{Audit, ContactPoint, Flags, MAX_CONTACTS, POINTS_PER_SEGMENT};
use crate::sim::strength::{MuscleScale, Strength};
use multiversion::multiversion;

/// What a stepper reads in one tick.
#[derive(Clone, Copy, Debug)]
pub struct StepInput<'a> {
    /// The body.
    pub body: &'a Body,
    /// Its mass properties, loads included.
    pub links: &'a Links,
    /// Its strength.
    pub strength: &'a Strength,
    /// Factors on the muscles.
    pub scale: &'a MuscleScale,
    /// Terms of the state at the start of the tick, those the controller used.
    pub terms: &'a Terms,
    /// What the motors are asked to do.
    pub command: &'a MotorCommand,
    /// Available torque at the start of the tick.
    pub available: &'a TorqueRange,
    /// Stretched tissue as the controller counts on it; without it none acts.
    pub tissue: Option<&'a Tissue>,
    /// Forces that neither muscles nor contact give.
    pub forces: ExternalForces<'a>,
    /// What the body needs to meet itself; without it it passes through itself.
    pub own: Option<OwnBody<'a>>,
    /// Tick, substeps and gravity.
    pub world: &'a TickContext,
}

/// Torque that muscles can give, N·m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorqueRange {
    /// Least of each DOF.
    pub lower: [f64; DOF_COUNT],
    /// Largest of each DOF.
    pub upper: [f64; DOF_COUNT],
}

/// Forces on the body that neither muscles nor contact give.
#[derive(Clone, Copy, Debug)]
pub struct ExternalForces<'a> {
    /// Forces of perturbations, constant over the tick.
    pub applied: &'a [AppliedForce],
    /// A bar between two points of the body, if two hands hold one load.
    pub bar: Option<&'a Bar>,
    /// Help on the pelvis, if there is any.
    pub assist: Option<PelvisHelp<'a>>,
}

/// What moves the body.
pub trait Stepper {
    /// Advances `state` by one tick. Allocates nothing.
    fn step(&mut self, input: &StepInput<'_>, state: &mut State);
}

/// What the motors are asked to do during one tick.
#[derive(Clone, Debug)]
pub struct MotorCommand {
    /// Commanded joint acceleration, rad/s².
    pub acceleration: [f64; DOF_COUNT],
    /// Feed-forward torque, N·m.
    pub torque: [f64; DOF_COUNT],
    /// Speed error at which a motor gives all it has, rad/s: 1 with a feed-forward torque, 0.005 for motors alone.
    pub saturation_speed: f64,
}

impl MotorCommand {
    /// True if every number is finite.
    pub fn is_finite(&self) -> bool {
        let numbers = self.acceleration.iter().chain(&self.torque);
        numbers
            .chain([&self.saturation_speed])
            .all(|x| x.is_finite())
    }
}

/// The bar as a row of the solve.
#[derive(Clone, Copy, Debug)]
struct BarRow {
    /// Segments and world points of its ends.
    ends: [(SegmentId, Vec3); 2],
    /// Unit vector from the first end to the second, world axes.
    direction: Vec3,
    /// Derivative of its length by the velocity.
    row: [f64; NV],
    /// Rate of its length that takes an error back, m/s.
    wanted: f64,
}

impl BarRow {
    fn new(bar: &Bar, terms: &Terms, h: f64) -> Self {
        let ends = bar.ends.map(|(s, p)| (s, terms.point_world(s.index(), p)));
        let span = ends[1].1 - ends[0].1;
        let length = span.norm();
        let direction = if length > 1e-6 {
            span * (1.0 / length)
        } else {
            Vec3::Y
        };
        let mut row = [0.0; NV];
        let root = terms.state.posture.root_position;
        for (sign, (s, p)) in [-1.0, 1.0].into_iter().zip(ends) {
            for_each_column(&terms.kin, s.index(), p - root, |i, _, v| {
                row[i] += sign * v.dot(direction)
            });
        }
        Self {
            ends,
            direction,
            row,
            wanted: (bar::RETURN * (bar.length - length) / h)
                .clamp(-bar::RETURN_SPEED, bar::RETURN_SPEED),
        }
    }

    fn rate(&self, v: &[f64; NV]) -> f64 {
        self.row.iter().zip(v).map(|(a, b)| a * b).sum()
    }

    fn add(&self, impulse: f64, x: &mut [f64; NV]) {
        for (x, r) in x.iter_mut().zip(&self.row) {
            *x += impulse * r;
        }
    }
}

/// Means over a tick and the last substep.
#[derive(Clone, Debug)]
pub struct TickForces {
    /// Mean muscle torque, N·m.
    pub torque: [f64; DOF_COUNT],
    /// Mean torque of joint limits and stretched tissue, N·m.
    pub ligament_torque: [f64; DOF_COUNT],
    /// Mean assist on the pelvis: moment about its origin, N·m, then force, N.
    pub assist: [f64; 6],
    /// Mean force of the bar on its second end, N; the first end feels the opposite.
    pub bar: Vec3,
    /// Mean contact force by segment and vertex; zero where nothing touched.
    pub contact: Vec<ContactPoint>,
    /// Largest relative violation of strength by any substep.
    pub over_limit: f64,
    /// Newton iterations of all substeps.
    pub iterations: u32,
    /// Flags raised while stepping.
    pub flags: Flags,
    /// The last substep.
    pub audit: Audit,
}

impl TickForces {
    /// Nothing, with room for so many contacts and applied forces.
    pub fn new(contacts: usize, applied: usize) -> Self {
        Self {
            torque: [0.0; DOF_COUNT],
            ligament_torque: [0.0; DOF_COUNT],
            assist: [0.0; 6],
            bar: Vec3::zero(),
            contact: Vec::with_capacity(contacts),
            over_limit: 0.0,
            iterations: 0,
            flags: Flags::default(),
            audit: Audit::with_capacity(applied),
        }
    }
}

/// How exactly a substep is solved. Whatever it is, the step is closed: what acts is within strength and friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Residual at which a substep counts as solved, N·m·s.
    pub tolerance: f64,
    /// Most solves for points that slide, after the first.
    pub slide_rounds: u32,
    /// Begins with the joints at the rates that the motors want, not at those they have: stiff motors get there, and
    /// Newton's method need not find out which of them do. After the first substep of a tick the pelvis, and joints
    /// whose motors gave all they had, begin where their last acceleration leads.
    pub motors_first: bool,
}

impl Accuracy {
    /// That of rehearsals, and of figures that play what was rehearsed: looser, half as fast again.
    pub const REHEARSED: Self = Self {
        tolerance: 3e-4,
        slide_rounds: 0,
        motors_first: true,
    };
}

impl Default for Accuracy {
    /// That of every figure.
    fn default() -> Self {
        Self {
            tolerance: contact::TOLERANCE,
            slide_rounds: u32::MAX,
            motors_first: false,
        }
    }
}

/// Moves a body by torques; made once per figure.
///
/// Repair S5.
#[derive(Clone, Debug)]
pub struct TorqueStepper {
    /// Terms of the current substep.
    pub terms: Terms,
    problem: SubstepProblem,
    solver: SubstepSolver,
    solution: SubstepSolution,
    external: ExternalContacts,
    own: SelfContact,
    bar: BarImpulse,
    means: TickMeans,
    /// Result of the last tick.
    pub forces: TickForces,
}

/// What a substep solves.
#[derive(Clone, Debug)]
struct SubstepProblem {
    contacts: ContactRows,
    slides: Slides,
    limits: LimitRows,
    motors: Motors,
    row: Option<BarRow>,
    /// Strength of the substep.
    range: TorqueRange,
}

/// Buffers of the solver.
#[derive(Clone, Debug, Default)]
struct SubstepSolver {
    newton: NewtonWorkspace,
    hessian: MassMatrix<f64>,
    /// M with the springs of the assist on its first six diagonal entries.
    assisted: MassMatrix<f64>,
    accuracy: Accuracy,
}

/// What solves a substep.
#[derive(Clone, Debug)]
struct SubstepSolution {
    /// Velocity at its end.
    velocity: [f64; NV],
    /// Its momentum without motors, limits and contacts; assist and bar included.
    pushed: [f64; NV],
    /// Impulse of the assist.
    assist: [f64; 6],
    outcome: Outcome,
    /// Joints whose motors gave all they had, by bit; `None` before the first substep of a tick.
    saturated: Option<u64>,
}

/// Contacts with other bodies in the current substep.
#[derive(Clone, Debug)]
struct ExternalContacts {
    /// Their impulse in velocity components.
    impulse: Option<[f64; NV]>,
    /// Their forces: segment, world point, world force, N.
    forces: Vec<(SegmentId, Vec3, Vec3)>,
}

/// What a bar between two points gives.
#[derive(Clone, Copy, Debug, Default)]
struct BarImpulse {
    /// Impulse along the bar, N·s; positive pushes its ends apart. First guess of the next substep.
    impulse: f64,
    /// Its forces in the last substep of a tick: segment, world point, world force, N.
    forces: Option<[(SegmentId, Vec3, Vec3); 2]>,
}

/// What is collected over the substeps of a tick.
#[derive(Clone, Debug)]
struct TickMeans {
    /// Joint rates at the start of the tick.
    start: [f64; DOF_COUNT],
    /// Sum of contact impulses by segment × 8 + vertex, N·s, and where the point was when it first touched.
    impulse: Box<[(Vec3, Vec3); MAX_CONTACTS]>,
    penetration: f64,
}

impl TorqueStepper {
    /// A stepper on ground with friction coefficient `friction`.
    pub fn new(friction: f64) -> Self {
        Self {
            terms: Terms::default(),
            problem: SubstepProblem {
                contacts: ContactRows::new(friction),
                slides: Slides::default(),
                limits: LimitRows::new(),
                motors: Motors::default(),
                row: None,
                range: TorqueRange {
                    lower: [0.0; DOF_COUNT],
                    upper: [0.0; DOF_COUNT],
                },
            },
            solver: SubstepSolver::default(),
            solution: SubstepSolution {
                velocity: [0.0; NV],
                pushed: [0.0; NV],
                assist: [0.0; 6],
                outcome: Outcome::default(),
                saturated: None,
            },
            external: ExternalContacts {
                impulse: None,
                forces: Vec::with_capacity(super::loads::MAX_APPLIED),
            },
            own: SelfContact::default(),
            bar: BarImpulse::default(),
            means: TickMeans {
                start: [0.0; DOF_COUNT],
                impulse: Box::new([(Vec3::zero(), Vec3::zero()); MAX_CONTACTS]),
                penetration: 0.0,
            },
            forces: TickForces::new(MAX_CONTACTS, super::loads::MAX_APPLIED),
        }
    }

    /// Solves with another accuracy from now on.
    pub fn set_accuracy(&mut self, accuracy: Accuracy) {
        self.solver.accuracy = accuracy;
        self.problem.slides.limit_rounds(accuracy.slide_rounds);
    }

    /// What it remembers from tick to tick: impulse along the bar between two hands, N·s, and its mean force, N.
    pub(super) fn memory(&self) -> (f64, Vec3) {
        (self.bar.impulse, self.forces.bar)
    }

    /// Remembers what was read from a checkpoint.
    pub(super) fn remember(&mut self, impulse: f64, force: Vec3) {
        self.bar.impulse = impulse;
        self.forces.bar = force;
    }

    /// Deepest contact point below the surface at the start of any substep of the last tick, m.
    pub fn penetration(&self) -> f64 {
        self.means.penetration
    }
}

impl Stepper for TorqueStepper {
    /// Advances `state` by one tick of `dt` seconds in `substeps` substeps. Fills [`Self::forces`]. No allocation.
    fn step(&mut self, input: &StepInput<'_>, state: &mut State) {
        self.begin(state);
        for i in 0..input.world.substeps {
            self.open_substep(input, state, i);
            self.close_substep(input, state, i);
        }
        self.end(input);
    }
}

impl TorqueStepper {
    /// Starts a tick.
    pub(crate) fn begin(&mut self, state: &State) {
        self.solution.saturated = None;
        self.own.begin();
        self.means.start = std::array::from_fn(|j| state.velocity[6 + j]);
        let f = &mut self.forces;
        f.torque.fill(0.0);
        f.ligament_torque.fill(0.0);
        f.assist.fill(0.0);
        f.bar = Vec3::zero();
        f.over_limit = 0.0;
        f.iterations = 0;
        f.flags = Flags::default();
        f.contact.clear();
        self.means.impulse.fill((Vec3::zero(), Vec3::zero()));
        self.means.penetration = 0.0;
    }

    /// Substep `i`: everything that depends on the state, and the velocity at its end if nothing but the ground is
    /// touched.
    pub(crate) fn open_substep(&mut self, input: &StepInput<'_>, state: &State, i: u32) {
        let StepInput {
            body,
            links,
            strength,
            scale,
            command,
            tissue,
            forces: ExternalForces { applied, .. },
            world:
                &TickContext {
                    dt,
                    substeps,
                    gravity,
                    ..
                },
            ..
        } = *input;
        let h = dt / f64::from(substeps);
        if i == 0 {
            self.terms.clone_from(input.terms);
        } else {
            self.terms.compute(links, state, applied, gravity);
        }
        let angles = collect_limits(
            body,
            tissue.map(|_| strength),
            state,
            h,
            &mut self.problem.limits,
        );
        let rates: [f64; DOF_COUNT] = std::array::from_fn(|j| state.velocity[6 + j]);
        let TorqueRange { lower, upper } = &mut self.problem.range;
        strength.range(&angles, &rates, scale, lower, upper);
        for j in 0..DOF_COUNT {
            // The gain follows strength: a motor gives all it has when it is `saturation_speed` off.
            let k = 0.5 * (input.available.upper[j] - input.available.lower[j])
                / command.saturation_speed;
            let aim = self.means.start[j] + f64::from(i + 1) * h * command.acceleration[j];
            self.problem.motors.gain[j] = h * k;
            self.problem.motors.rest[j] = aim + command.torque[j] / k;
            self.problem.motors.lower[j] = h * lower[j];
            self.problem.motors.upper[j] = h * upper[j];
        }
        self.collect_contacts(body, h);
        let spring = input
            .forces
            .assist
            .map(|help| help.spring(state, i, substeps, dt));
        self.problem.row = input.forces.bar.map(|bar| BarRow::new(bar, &self.terms, h));
        self.external.impulse = None;
        self.external.forces.clear();
        self.own.open(input.own.as_ref(), &self.terms, h);
        self.solve_substep(input, h, state, spring.as_ref());
    }

    /// What other bodies give in this substep, after an island has been solved for the velocity that it left in
    /// [`Self::parts`].
    pub(crate) fn touch(&mut self, impulse: [f64; NV], outcome: Outcome) {
        self.external.impulse = Some(impulse);
        self.solution.outcome = Outcome {
            iterations: self.solution.outcome.iterations + outcome.iterations,
            ..outcome
        };
    }

    /// One of the forces that [`Self::touch`] summed up: segment, world point, world force (N).
    pub(crate) fn push(&mut self, segment: SegmentId, at: Vec3, force: Vec3) {
        if self.external.forces.len() < MAX_EXTERNAL {
            self.external.forces.push((segment, at, force));
        }
    }

    /// Closes substep `i` and moves.
    pub(crate) fn close_substep(&mut self, input: &StepInput<'_>, state: &mut State, i: u32) {
        let (h, last) = (
            input.world.dt / f64::from(input.world.substeps),
            i + 1 == input.world.substeps,
        );
        self.close(h, state);
        if let Some(row) = self.problem.row.take() {
            self.account_bar(&row, h, input.world.dt, last);
        }
        self.account(h, input.world.dt, last, input.forces.applied);
        let v = state.velocity;
        state.posture.integrate(&v, h);
    }

    /// Finishes a tick: mean forces of the points that touched the ground.
    pub(crate) fn end(&mut self, input: &StepInput<'_>) {
        let (body, dt) = (input.body, input.world.dt);
        for s in 0..SEGMENT_COUNT {
            for vertex in 0..body.segments[s]
                .contact_points
                .len()
                .min(POINTS_PER_SEGMENT)
            {
                let (p, position) = self.means.impulse[s * POINTS_PER_SEGMENT + vertex];
                if p.z > 0.0 {
                    let segment = SegmentId::new(s).expect("s < SEGMENT_COUNT");
                    self.forces.contact.push(ContactPoint {
                        segment,
                        vertex,
                        position,
                        force: p * (1.0 / dt),
                    });
                }
            }
        }
    }
}

impl TorqueStepper {
    /// Rows for every contact point that is low or arrives within the substep.
    ///
    /// A point with velocity Jv moves by h(Jv + ½h J̇v): limbs turn, and a foot that rolls over its toes with Jv = 0
    /// would creep by ½h²J̇v, 0.3 mm a tick. What rests is therefore held where it is, not at rest. What lands or
    /// slides moves otherwise after the substep than before, and its J̇v says nothing.
    ///
    /// Problem 14.3.
    fn collect_contacts(&mut self, body: &Body, h: f64) {
        self.problem.contacts.clear();
        let (t, root) = (&self.terms, self.terms.state.posture.root_position);
        for s in 0..SEGMENT_COUNT {
            let origin = root.z + t.kin.position[s].z;
            for (vertex, p) in body.segments[s]
                .contact_points
                .iter()
                .enumerate()
                .take(POINTS_PER_SEGMENT)
            {
                let r = t.kin.rotation[s] * *p;
                let z = origin + r.z;
                self.means.penetration = self.means.penetration.max(-z);
                let velocity = t.kin.velocity[s] + t.kin.omega[s].cross(r);
                if z < contact::SPECULATIVE_HEIGHT || z + h * velocity.z < 0.0 {
                    let mut c = if velocity.norm() < slides::CREEP {
                        t.bias_at(s, r) * (0.5 * h)
                    } else {
                        Vec3::zero()
                    };
                    c.z += if z > 0.0 {
                        z / h
                    } else {
                        -(contact::PENETRATION_RETURN * (-z - contact::PENETRATION_SLOP).max(0.0)
                            / h)
                            .min(contact::PENETRATION_SPEED)
                    };
                    let slot = self.problem.contacts.slot(&self.terms.kin, s);
                    let inverse_r = 1.0 / contact::COMPLIANCE;
                    self.problem.contacts.points.push(PointRow {
                        slot,
                        r,
                        c,
                        inverse_r,
                        segment: s,
                        vertex,
                        turn: None,
                    });
                }
            }
        }
    }

    /// Solves for the velocity at the end of the substep.
    ///
    /// Problem 14.3.
    fn solve_substep(
        &mut self,
        input: &StepInput<'_>,
        h: f64,
        state: &State,
        spring: Option<&Spring>,
    ) {
        let t = &self.terms;
        let mut momentum = [0.0; NV];
        t.mass_matrix.mul(&state.velocity, &mut momentum);
        for i in 0..NV {
            momentum[i] -= h * t.h[i]; // M v_free
        }
        let mut v = state.velocity;
        if self.solver.accuracy.motors_first {
            self.begin_at_motors(h, &mut v);
        }
        self.solution.assist = [0.0; 6];
        self.solution.outcome = Outcome::default();
        self.problem.slides.begin(
            &mut self.problem.contacts,
            &state.velocity,
            &mut self.solver.newton,
        );
        let body = (input.body, input.own.as_ref());
        let mass = &self.terms.mass_matrix;
        self.own.correct(body, mass, None, &state.velocity);
        let mut x = momentum;
        for round in 0..=self_contact::ROUNDS {
            x = momentum;
            self.own.add_to(&mut x);
            self.solve_sliding(&x, spring, &mut v);
            let last = round + 1 >= self_contact::ROUNDS;
            let known = self.solution.outcome.iterations > 0 && !last;
            let solved = known.then_some(&self.solver.hessian);
            let mass = &self.terms.mass_matrix;
            if round == self_contact::ROUNDS || !self.own.correct(body, mass, solved, &v) {
                break;
            }
        }
        for i in 0..6 {
            x[i] += self.solution.assist[i];
        }
        if let Some(bar) = &self.problem.row {
            bar.add(self.bar.impulse, &mut x);
        } else {
            self.bar.impulse = 0.0;
        }
        (self.solution.velocity, self.solution.pushed) = (v, x);
        let motors = &self.problem.motors;
        let given = self.solver.newton.motor.iter().enumerate();
        let saturated = given.filter(|(j, t)| **t >= motors.upper[*j] || **t <= motors.lower[*j]);
        self.solution.saturated = Some(saturated.fold(0, |all, (j, _)| all | 1 << j));
    }

    /// Solves as often as points that slide take.
    fn solve_sliding(&mut self, momentum: &[f64; NV], spring: Option<&Spring>, v: &mut [f64; NV]) {
        loop {
            let outcome = match self.problem.row {
                None => self.solve_with(momentum, spring, v),
                Some(bar) => self.solve_barred(momentum, spring, &bar, v),
            };
            self.solution.outcome = Outcome {
                iterations: self.solution.outcome.iterations + outcome.iterations,
                ..outcome
            };
            if !self
                .problem
                .slides
                .again(&mut self.problem.contacts, &self.solver.newton)
            {
                break;
            }
        }
    }

    /// Where Newton's method begins if the motors come first: `v` is the velocity at the start of the substep of `h` s.
    fn begin_at_motors(&self, h: f64, v: &mut [f64; NV]) {
        let saturated = self.solution.saturated.unwrap_or(0);
        let acceleration = &self.forces.audit.acceleration;
        for j in 0..DOF_COUNT {
            v[6 + j] = match saturated >> j & 1 {
                0 => self.problem.motors.rest[j],
                _ => v[6 + j] + h * acceleration[6 + j],
            };
        }
        if self.solution.saturated.is_some() {
            for (v, a) in v[..6].iter_mut().zip(acceleration) {
                *v += h * a;
            }
        }
    }

    /// Recomputes the velocity from the impulses of the last iterate and writes it to `state.velocity`.
    fn close(&mut self, h: f64, state: &mut State) {
        let t = &self.terms;
        let mut x = self.solution.pushed;
        for j in 0..DOF_COUNT {
            x[6 + j] += self.solver.newton.motor[j] + self.solver.newton.limit[j];
        }
        self.problem
            .contacts
            .add_transposed(&self.solver.newton.force, 1.0, &mut x);
        if let Some(external) = &self.external.impulse {
            for (x, p) in x.iter_mut().zip(external) {
                *x += p;
            }
        }
        close_kernel(&t.mass_matrix, &mut self.solver.hessian, &mut x);
        self.forces.audit.state = *state;
        for i in 0..NV {
            self.forces.audit.acceleration[i] = (x[i] - state.velocity[i]) / h;
        }
        state.velocity = x;
        if state.brake(contact::LARGEST_SPEED) {
            self.forces.flags.set(Flags::SPEED_BOUND);
        }
    }

    /// Solves with or without assist.
    fn solve_with(
        &mut self,
        momentum: &[f64; NV],
        spring: Option<&Spring>,
        v: &mut [f64; NV],
    ) -> Outcome {
        match spring {
            None => self.solve_freely(momentum, v, false),
            Some(spring) => self.solve_assisted(momentum, spring, v),
        }
    }

    /// Solves with a bar: one unknown impulse along it, found by Newton and secant steps on the rate of its length,
    /// which grows with the impulse. Leaves the impulse in [`Self::bar_impulse`]; it is the next substep's first guess.
    fn solve_barred(
        &mut self,
        momentum: &[f64; NV],
        spring: Option<&Spring>,
        bar: &BarRow,
        v: &mut [f64; NV],
    ) -> Outcome {
        let mut total = Outcome::default();
        let mut before: Option<(f64, f64)> = None;
        let mut slope = 0.0;
        for _ in 0..bar::ITERATIONS {
            let mut b = *momentum;
            bar.add(self.bar.impulse, &mut b);
            let outcome = self.solve_with(&b, spring, v);
            total = Outcome {
                iterations: total.iterations + outcome.iterations,
                ..outcome
            };
            let off = bar.rate(v) - bar.wanted;
            if off.abs() < bar::TOLERANCE {
                break;
            }
            let secant = before
                .map(|(p, o)| (off - o) / (self.bar.impulse - p))
                .filter(|s| s.is_finite() && *s > 0.1 * slope && *s < 10.0 * slope);
            slope = secant.unwrap_or_else(|| {
                // The last matrix that was factored: motors, limits and contacts as they stood then.
                let mut x = [0.0; NV];
                bar.add(1.0, &mut x);
                solve(&self.solver.hessian, &mut x);
                bar.rate(&x).max(1e-4)
            });
            before = Some((self.bar.impulse, off));
            self.bar.impulse -= off / slope;
        }
        total
    }

    /// Adds the bar's forces to the means, and to the audit of the last substep.
    fn account_bar(&mut self, row: &BarRow, h: f64, dt: f64, last: bool) {
        self.forces.bar += row.direction * (self.bar.impulse / dt);
        if last {
            let force = row.direction * (self.bar.impulse / h);
            self.bar.forces = Some([
                (row.ends[0].0, row.ends[0].1, force * -1.0),
                (row.ends[1].0, row.ends[1].1, force),
            ]);
        }
    }

    /// Solves for the velocity at the end of the substep; with `assisted`, for the matrix that carries the springs of
    /// the assist.
    fn solve_freely(&mut self, momentum: &[f64; NV], v: &mut [f64; NV], assisted: bool) -> Outcome {
        let outcome = self.solve_once(momentum, v, assisted);
        if outcome.converged {
            outcome
        } else {
            self.solve_softer(momentum, v, outcome, assisted)
        }
    }

    /// One run of Newton's method with the motors as they are.
    fn solve_once(&mut self, momentum: &[f64; NV], v: &mut [f64; NV], assisted: bool) -> Outcome {
        let SubstepSolver {
            newton,
            hessian,
            assisted: springs,
            accuracy,
        } = &mut self.solver;
        let stop = StopRule {
            iterations: contact::ITERATIONS,
            tolerance: accuracy.tolerance,
        };
        let matrix = if assisted {
            springs
        } else {
            &self.terms.mass_matrix
        };
        substep_kernel(matrix, &self.problem, momentum, stop, v, hessian, newton)
    }

    /// Solves with the springs of the assist; a part whose impulse exceeds its bound becomes a constant one at the
    /// bound, and the rest is solved again. Leaves the impulse in [`Self::assist`].
    fn solve_assisted(
        &mut self,
        momentum: &[f64; NV],
        spring: &Spring,
        v: &mut [f64; NV],
    ) -> Outcome {
        let mut fixed: [Option<Vec3>; 2] = [None; 2];
        let mut total = Outcome::default();
        loop {
            self.solver.assisted.rows = self.terms.mass_matrix.rows;
            let mut b = *momentum;
            let given = spring.given.unwrap_or([Vec3::zero(); 2]);
            if spring.given.is_some() {
                for (x, g) in b.iter_mut().zip(given.iter().flat_map(|g| g.to_array())) {
                    *x += g;
                }
            }
            for (k, constant) in fixed.iter().enumerate() {
                let add = constant.unwrap_or(spring.rest[k] * spring.gain[k]);
                for (i, x) in add.to_array().into_iter().enumerate() {
                    b[3 * k + i] += x;
                    if constant.is_none() {
                        self.solver.assisted.rows[3 * k + i][3 * k + i] += spring.gain[k];
                    }
                }
            }
            let outcome = self.solve_freely(&b, v, true);
            total = Outcome {
                iterations: total.iterations + outcome.iterations,
                ..outcome
            };
            let root: [f64; 6] = std::array::from_fn(|i| v[i]);
            let mut again = false;
            for k in 0..2 {
                let (impulse, cut) = spring.cut(k, &root);
                if fixed[k].is_none() && cut {
                    fixed[k] = Some(impulse);
                    again = true;
                }
                let mut acts = fixed[k].unwrap_or(impulse);
                if spring.given.is_some() {
                    acts += given[k];
                }
                self.solution.assist[3 * k..3 * k + 3].copy_from_slice(&acts.to_array());
            }
            if !again {
                return total;
            }
        }
    }

    /// Second try of a substep whose stiff motors, limits and contacts kept Newton's method zigzagging: the same
    /// strength and friction with motors that saturate later. Closing an unconverged step would turn its residual into
    /// the speed of a light joint.
    fn solve_softer(
        &mut self,
        momentum: &[f64; NV],
        v: &mut [f64; NV],
        first: Outcome,
        assisted: bool,
    ) -> Outcome {
        for j in 0..DOF_COUNT {
            // The same torque at the speed the joint has now, and a hundredth of the gain around it.
            let (m, now) = (&mut self.problem.motors, self.terms.state.velocity[6 + j]);
            let torque = (m.gain[j] * (m.rest[j] - now)).clamp(m.lower[j], m.upper[j]);
            m.gain[j] *= motors::SOFTENING;
            m.rest[j] = now + torque / m.gain[j];
        }
        let second = self.solve_once(momentum, v, assisted);
        Outcome {
            iterations: first.iterations + second.iterations,
            ..second
        }
    }

    /// Adds a substep to the means of the tick, and keeps the last one.
    ///
    /// Problem 14.3.
    fn account(&mut self, h: f64, dt: f64, last: bool, applied: &[AppliedForce]) {
        let (f, outcome) = (&mut self.forces, self.solution.outcome);
        let TorqueRange { lower, upper } = &self.problem.range;
        f.iterations += outcome.iterations;
        if !outcome.converged {
            f.flags.set(Flags::STEP_BOUND);
        }
        for j in 0..DOF_COUNT {
            let tau = self.solver.newton.motor[j] / h;
            f.torque[j] += self.solver.newton.motor[j] / dt;
            f.ligament_torque[j] += self.solver.newton.limit[j] / dt;
            f.over_limit = f
                .over_limit
                .max(tau / upper[j] - 1.0)
                .max(tau / lower[j] - 1.0);
            f.audit.torque[j] = tau;
            f.audit.ligament_torque[j] = self.solver.newton.limit[j] / h;
        }
        for i in 0..6 {
            f.assist[i] += self.solution.assist[i] / dt;
            f.audit.assist[i] = self.solution.assist[i] / h;
        }
        f.over_limit = f.over_limit.max(0.0);
        let root = self.terms.state.posture.root_position;
        if last {
            f.audit.contacts.clear();
            f.audit.applied.clear();
            for (s, p, force) in applied {
                f.audit
                    .applied
                    .push((*s, self.terms.point_world(s.index(), *p), *force));
            }
            f.audit
                .applied
                .extend(self.bar.forces.take().into_iter().flatten());
            f.audit.applied.extend(&self.external.forces);
            f.audit.applied.extend(self.own.forces());
        }
        for (k, p) in self.problem.contacts.points.iter().enumerate() {
            let impulse = self.solver.newton.force[k];
            if impulse.z <= 0.0 {
                continue;
            }
            let position = root + self.terms.kin.position[p.segment] + p.r;
            let slot = &mut self.means.impulse[p.segment * POINTS_PER_SEGMENT + p.vertex];
            if slot.0.z == 0.0 {
                slot.1 = position;
            }
            slot.0 += impulse;
            if last {
                let segment = SegmentId::new(p.segment).expect("rows hold valid segments");
                f.audit.contacts.push(ContactPoint {
                    segment,
                    vertex: p.vertex,
                    position,
                    force: impulse * (1.0 / h),
                });
            }
        }
    }
}

impl Articulated for TorqueStepper {
    fn parts(&mut self) -> Parts<'_> {
        Parts {
            m: &self.terms.mass_matrix,
            hessian: &mut self.solver.hessian,
            b: &self.solution.pushed,
            motors: &self.problem.motors,
            limits: &self.problem.limits,
            contacts: &self.problem.contacts,
            newton: &mut self.solver.newton,
            x: &mut self.solution.velocity,
        }
    }
}

/// The kernel of one substep, compiled for the vector instructions at hand.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn substep_kernel(
    m: &MassMatrix<f64>,
    problem: &SubstepProblem,
    momentum: &[f64; NV],
    stop: StopRule,
    v: &mut [f64; NV],
    hessian: &mut MassMatrix<f64>,
    ws: &mut NewtonWorkspace,
) -> Outcome {
    let problem = Problem {
        system: SparseSystem(m),
        b: momentum,
        motors: &problem.motors,
        limits: &problem.limits,
        contacts: &problem.contacts,
    };
    minimise(&problem, stop, hessian, v, ws)
}

/// `x ← M⁻¹ x`.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn close_kernel(m: &MassMatrix<f64>, scratch: &mut MassMatrix<f64>, x: &mut [f64; NV]) {
    scratch.rows = m.rows;
    factor(scratch);
    solve(scratch, x);
}
