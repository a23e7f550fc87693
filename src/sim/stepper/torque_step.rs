//! Full rigid-body dynamics driven by strength-limited motors, with contact and joint limits.
//!
//! One substep solves, implicitly and all at once, for the velocity at its end: motors that pull towards the commanded
//! motion within the strength of that instant, unilateral joint limits, and speculative frictional contact with the
//! ground. Then the step is *closed*: the velocity is recomputed from the impulses of the last iterate, so that
//! torques, contact forces and accelerations satisfy the equations of motion to rounding, regardless of the residual at
//! which the iteration stopped.

mod bar;
mod solve;

use crate::body::angles::{angles_of, swings};
use crate::body::topology::{DOF_COUNT, NV, SEGMENT_COUNT, SegmentId};
use crate::body::{Body, State};
use crate::collide::island::{Articulated, ArticulatedParts};
use crate::contact::rows::PointRow;
use crate::contact::{
    ContactRows, Interior, LimitRows, Motors, NewtonWorkspace, Slides, SolveOutcome,
    collect_limits, slides,
};
use crate::dynamics::terms::AppliedForce;
use crate::dynamics::{Dynamics, MassMatrix, factor, solve};
use crate::math::Vec3;
use crate::report::{ContactPoint, Flags, MAX_CONTACTS, POINTS_PER_SEGMENT};
use crate::stepper::command::{StepForces, StepInput, Stepper, TorqueRange};
use crate::stepper::forces::MAX_EXTERNAL;
use crate::stepper::forces::TickForces;
use crate::stepper::params::contact;
use crate::stepper::self_contact::SelfContact;
use crate::tick_context::TickContext;
use bar::BarRow;
use multiversion::multiversion;

/// Accuracy with which a substep is solved. At any accuracy the step is closed: all forces are within strength and
/// friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Residual at which a substep counts as solved, N·m·s.
    pub tolerance: f64,
    /// Most additional solves for points that slide.
    pub slide_rounds: u32,
    /// Newton's method begins with the joints at the rates that the motors demand, instead of extrapolating the last
    /// acceleration: stiff motors reach them, and it need not find out which ones do. After the first substep of a
    /// tick, the pelvis, and joints whose motors gave their full torque, are still extrapolated.
    pub motors_first: bool,
}

impl Accuracy {
    /// The accuracy of rehearsals, and of figures that play a rehearsed motion: looser, and 1.5 times as fast.
    pub const REHEARSED: Self = Self {
        tolerance: 3e-4,
        slide_rounds: 0,
        motors_first: true,
    };
}

impl Default for Accuracy {
    /// The accuracy of every other figure.
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
    /// Dynamics of the current substep.
    pub dynamics: Dynamics,
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

/// The problem of a substep.
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
    interior: Interior,
    hessian: MassMatrix<f64>,
    /// M with the springs of the assist on its first six diagonal entries.
    assisted: MassMatrix<f64>,
    accuracy: Accuracy,
}

/// The solution of a substep.
#[derive(Clone, Debug)]
struct SubstepSolution {
    /// Velocity at its end.
    velocity: [f64; NV],
    /// Its momentum without motors, limits and contacts; assist and bar included.
    pushed: [f64; NV],
    /// Impulse of the assist.
    assist: [f64; 6],
    outcome: SolveOutcome,
    /// Joints whose motors gave their full torque in the last closed substep, by bit; `None` before the first substep
    /// of a tick.
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

/// The effect of a bar between two points.
#[derive(Clone, Copy, Debug, Default)]
struct BarImpulse {
    /// Impulse along the bar, N·s; positive pushes its ends apart.
    impulse: f64,
    /// Impulse of the last closed substep: first guess of the next one.
    start: f64,
    /// Its forces in the last substep of a tick: segment, world point, world force, N.
    forces: Option<[(SegmentId, Vec3, Vec3); 2]>,
}

/// Sums over the substeps of a tick.
#[derive(Clone, Debug)]
struct TickMeans {
    /// Joint rates at the start of the tick.
    start: [f64; DOF_COUNT],
    /// Sum of contact impulses by segment × 8 + vertex, N·s, and the place of the point when it first touched.
    impulse: Box<[(Vec3, Vec3); MAX_CONTACTS]>,
    penetration: f64,
}

impl TorqueStepper {
    /// A stepper on ground with friction coefficient `friction`.
    pub fn new(friction: f64) -> Self {
        Self {
            dynamics: Dynamics::default(),
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
                outcome: SolveOutcome::default(),
                saturated: None,
            },
            external: ExternalContacts {
                impulse: None,
                forces: Vec::with_capacity(crate::stepper::forces::MAX_APPLIED),
            },
            own: SelfContact::default(),
            bar: BarImpulse::default(),
            means: TickMeans {
                start: [0.0; DOF_COUNT],
                impulse: Box::new([(Vec3::zero(), Vec3::zero()); MAX_CONTACTS]),
                penetration: 0.0,
            },
            forces: TickForces::new(MAX_CONTACTS, crate::stepper::forces::MAX_APPLIED),
        }
    }

    /// Uses another accuracy from now on.
    pub fn set_accuracy(&mut self, accuracy: Accuracy) {
        self.solver.accuracy = accuracy;
        self.problem.slides.limit_rounds(accuracy.slide_rounds);
    }

    /// Ground with friction coefficient `friction` from now on.
    pub fn set_friction(&mut self, friction: f64) {
        self.problem.contacts.friction = friction;
    }

    /// Its memory from tick to tick: impulse along the bar between two hands, N·s, and its mean force, N.
    pub(crate) fn memory(&self) -> (f64, Vec3) {
        (self.bar.start, self.forces.bar)
    }

    /// Takes on the memory of this figure.
    pub(crate) fn remember(&mut self, impulse: f64, force: Vec3) {
        self.bar.start = impulse;
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

    /// Substep `i`: everything that depends on the state, and the velocity at its end if only the ground is touched.
    pub(crate) fn open_substep(&mut self, input: &StepInput<'_>, state: &State, i: u32) {
        let StepInput {
            body,
            links,
            strength,
            scale,
            start,
            command,
            tissue,
            forces: StepForces { applied, .. },
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
            self.dynamics.clone_from(start.terms);
        } else {
            self.dynamics.compute(links, state, applied, gravity);
        }
        let now;
        let swings = if i == 0 {
            self.problem.range = *start.available;
            start.swings
        } else {
            now = swings(&state.posture);
            let angles = angles_of(&now, &state.posture);
            let rates: [f64; DOF_COUNT] = std::array::from_fn(|j| state.velocity[6 + j]);
            let TorqueRange { lower, upper } = &mut self.problem.range;
            strength.range(&angles, &rates, scale, lower, upper);
            &now
        };
        let tissue = tissue.map(|_| strength);
        collect_limits(body, tissue, (state, swings), h, &mut self.problem.limits);
        let TorqueRange { lower, upper } = &self.problem.range;
        for j in 0..DOF_COUNT {
            // The gain follows strength: a motor gives its full torque at an error of `saturation_speed`.
            let k = 0.5 * (start.available.upper[j] - start.available.lower[j])
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
        self.problem.row = input
            .forces
            .bar
            .map(|bar| BarRow::new(bar, &self.dynamics, h));
        self.external.impulse = None;
        self.external.forces.clear();
        self.own.open(input.own.as_ref(), &self.dynamics, h);
        self.solve_substep(input, h, state, spring.as_ref());
    }

    /// The impulse of other bodies in this substep, after an island has been solved for the velocity left in
    /// [`Self::parts`].
    pub(crate) fn touch(&mut self, impulse: [f64; NV], outcome: SolveOutcome) {
        self.external.impulse = Some(impulse);
        self.solution.outcome = SolveOutcome {
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
        self.keep_starts();
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
    /// would creep by ½h²J̇v, 0.3 mm a tick. A resting point is therefore held in place, not at zero velocity. A point
    /// that lands or slides moves differently after the substep than before, so its J̇v is of no use.
    ///
    /// Problem 14.3.
    fn collect_contacts(&mut self, body: &Body, h: f64) {
        self.problem.contacts.clear();
        let (t, root) = (&self.dynamics, self.dynamics.state.posture.root_position);
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
                    let slot = self.problem.contacts.slot(&self.dynamics.kin, s);
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

    /// Recomputes the velocity from the impulses of the last iterate and writes it to `state.velocity`.
    fn close(&mut self, h: f64, state: &mut State) {
        let t = &self.dynamics;
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

    /// Adds a substep to the means of the tick, and stores the last one.
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
        let root = self.dynamics.state.posture.root_position;
        if last {
            f.audit.contacts.clear();
            f.audit.applied.clear();
            for (s, p, force) in applied {
                f.audit
                    .applied
                    .push((*s, self.dynamics.point_world(s.index(), *p), *force));
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
            let position = root + self.dynamics.kin.position[p.segment] + p.r;
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
    fn parts(&mut self) -> ArticulatedParts<'_> {
        ArticulatedParts {
            m: &self.dynamics.mass_matrix,
            hessian: &mut self.solver.hessian,
            b: &self.solution.pushed,
            motors: &self.problem.motors,
            limits: &self.problem.limits,
            contacts: &self.problem.contacts,
            newton: &mut self.solver.newton,
            interior: &mut self.solver.interior,
            x: &mut self.solution.velocity,
        }
    }
}

/// `x ← M⁻¹ x`.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn close_kernel(m: &MassMatrix<f64>, scratch: &mut MassMatrix<f64>, x: &mut [f64; NV]) {
    scratch.rows = m.rows;
    factor(scratch);
    solve(scratch, x);
}
