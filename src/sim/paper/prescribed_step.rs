//! The paper's own way to move a figure: the controller's accelerations are applied as they are, and the support holds
//! still, rotates about the minimum-moment point, or flies.
//!
//! Nothing here can push back: the forces that the ground would have to give follow from inverse dynamics and are
//! shared among the touching points. Forces that the points cannot give appear as a residual of the audit, which is not
//! hidden.

use crate::body::topology::{DOF_COUNT, L_FOOT, L_TOES, NV, R_FOOT, R_TOES, SEGMENT_COUNT};
use crate::body::{Posture, SegmentId, State};
use crate::contact::limits::LimitRows;
use crate::contact::newton::{ConvexProblem, Motors, NewtonWorkspace, StopRule, minimise};
use crate::contact::rows::{ContactRows, PointRow};
use crate::contact::sparse::SparseSystem;
use crate::control::Command;
use crate::dynamics::factor::{factor, solve};
use crate::dynamics::terms::WIDTH;
use crate::dynamics::{Kinematics, MassMatrix, Terms};
use crate::math::{Quat, Vec3};
use crate::paper::params::prescribed_step::{
    COMPLIANCE, IMPACT_HEIGHT, IMPACT_SPEED, LIMIT_TOLERANCE, NEARLY_FLAT, PIVOT_REACH, SETTLE,
    TOLERANCE,
};
use crate::paper::reroot::shift;
use crate::report::{ContactPoint, Flags, MAX_CONTACTS, POINTS_PER_SEGMENT};
use crate::stepper::command::StepInput;
use crate::stepper::forces::TickForces;
use crate::stepper::params::contact::{ITERATIONS, LARGEST_SPEED};
use crate::support::{NO_VERTEX, Pivot, Sharing, Support, SupportPoint, tipping_acceleration};
use crate::touch::MAX_TOUCHES;
use serde::{Deserialize, Serialize};

/// Input of this stepper besides the common input.
#[derive(Clone, Copy, Debug)]
pub struct Decision<'a> {
    /// The controller's decision for the tick.
    pub command: &'a Command,
    /// Whether accelerations are rejected if their torques exceed strength.
    pub within_strength: bool,
    /// Supports at the start of the tick.
    pub support: &'a Support,
    /// The feet that the desired motion keeps on the floor.
    pub planted: [bool; 2],
    /// Touching points that carry nothing by the controller's decision, by index, if it has decided.
    pub left_out: Option<&'a [bool; MAX_CONTACTS]>,
    /// Reports the controller's torques regardless of the ground forces found here: its sharing has no point forces
    /// (ratios (2)).
    pub as_commanded: bool,
}

/// The place where a support stands.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct SupportAnchor {
    /// The supporting segment.
    pub segment: SegmentId,
    /// Its origin, m.
    pub position: Vec3,
    /// World from segment.
    pub rotation: Quat,
}

/// Applies accelerations; remembers the place of the support.
#[derive(Clone, Debug)]
pub struct KinematicStepper {
    anchor: Option<SupportAnchor>,
    kin: Kinematics<f64>,
    terms: Terms,
    contacts: ContactRows,
    limits: LimitRows,
    motors: Motors,
    newton: NewtonWorkspace,
    hessian: MassMatrix<f64>,
    sharing: Sharing,
    penetration: f64,
    /// Result of the last tick.
    pub forces: TickForces,
}

/// Place and motion of the support.
#[derive(Clone, Copy)]
struct Rigid {
    position: Vec3,
    rotation: Quat,
    omega: Vec3,
    velocity: Vec3,
}

impl KinematicStepper {
    /// A stepper on ground with friction coefficient `friction`.
    pub fn new(friction: f64) -> Self {
        Self {
            anchor: None,
            kin: Kinematics::default(),
            terms: Terms::default(),
            contacts: ContactRows::new(friction),
            limits: LimitRows::new(),
            motors: Motors::default(),
            newton: NewtonWorkspace::default(),
            hessian: MassMatrix::default(),
            sharing: Sharing::default(),
            penetration: 0.0,
            forces: TickForces::new(
                2 * MAX_CONTACTS,
                crate::setup::MAX_PERTURBATIONS + MAX_TOUCHES,
            ),
        }
    }

    /// Forgets the place of the support (after a reset, or when torques moved the figure).
    pub fn reset(&mut self) {
        self.anchor = None;
    }

    /// Ground with friction coefficient `friction` from now on.
    pub fn set_friction(&mut self, friction: f64) {
        self.contacts.friction = friction;
    }

    /// Its memory from tick to tick: the supporting segment, and its place.
    pub(crate) fn memory(&self) -> Option<SupportAnchor> {
        self.anchor
    }

    /// Takes on the memory of this figure.
    pub(crate) fn remember(&mut self, anchor: Option<SupportAnchor>) {
        self.anchor = anchor;
    }

    /// Deepest contact point below the surface at the start of the last tick, m.
    pub fn penetration(&self) -> f64 {
        self.penetration
    }

    /// Advances `state` by one tick: the commanded accelerations, the support as decided, and impacts of points that
    /// arrive. Returns `false`, with nothing moved, if the decision must be within strength and is not. Allocates
    /// nothing.
    #[must_use]
    pub fn step(
        &mut self,
        input: &StepInput<'_>,
        decision: &Decision<'_>,
        state: &mut State,
    ) -> bool {
        let command = decision.command;
        let f = &mut self.forces;
        (f.iterations, f.flags) = (0, Flags::default());
        f.contact.clear();
        self.penetration = deepest(input, input.start.terms);
        self.account(input, decision, state);
        if decision.within_strength && self.forces.over_limit > LIMIT_TOLERANCE {
            return false;
        }
        let main = decision
            .support
            .main()
            .filter(|_| !command.flags.has(Flags::FLIGHT));
        // A support that should hold but still moves has just come down: it stops inelastically.
        if let (Some(s), None) = (main, command.pivot)
            && touching_speed(input.start.terms, decision.support.points(), s) > IMPACT_SPEED
        {
            self.terms.clone_from(input.start.terms);
            self.impact(input, state);
        }
        let start = *state;
        for (v, a) in state.velocity.iter_mut().zip(&command.acceleration) {
            *v += input.world.dt * a;
        }
        if state.brake(LARGEST_SPEED) {
            self.forces.flags.set(Flags::SPEED_BOUND);
        }
        self.advance(input, main, command.pivot, &start, input.world.dt, state);
        let arrival = self.arrival(input, &start.posture, &state.posture);
        if let Some(fraction) = arrival {
            // The tick up to the moment of arrival, the impact, and the rest of the tick with the velocity after it.
            let velocity = state.velocity;
            *state = start;
            state.velocity = velocity;
            state
                .posture
                .integrate(&velocity, fraction * input.world.dt);
            self.terms.compute(
                input.links,
                state,
                input.forces.applied,
                input.world.gravity,
            );
            self.impact(input, state);
            let v = state.velocity;
            state
                .posture
                .integrate(&v, (1.0 - fraction) * input.world.dt);
            self.anchor = None;
        }
        true
    }

    /// Moves the posture with the new velocity, and puts the pelvis where the support requires it.
    fn advance(
        &mut self,
        input: &StepInput<'_>,
        main: Option<SegmentId>,
        pivot: Option<Pivot>,
        start: &State,
        dt: f64,
        state: &mut State,
    ) {
        let velocity = state.velocity;
        state.posture.integrate(&velocity, dt);
        let Some(main) = main else {
            self.anchor = None;
            return;
        };
        let (t, s) = (input.start.terms, main.index());
        let rotation = Quat::from_mat3(&t.segment_rotation(s));
        let wanted = match pivot {
            None => {
                let (position, rotation) = match self.anchor {
                    Some(a) if a.segment == main => (a.position, a.rotation),
                    _ => (t.segment_position(s), rotation),
                };
                let (position, rotation) = settle(input, main, position, rotation);
                self.anchor = Some(SupportAnchor {
                    segment: main,
                    position,
                    rotation,
                });
                Rigid {
                    position,
                    rotation,
                    omega: Vec3::zero(),
                    velocity: Vec3::zero(),
                }
            }
            Some(p) => {
                self.anchor = None;
                let mut jacobian = [[0.0; WIDTH]; 6];
                t.segment_jacobian(s, &mut jacobian);
                let a = &input_acceleration(start, &velocity, dt);
                let row = |k: usize| (0..NV).map(|i| jacobian[k][i] * a[i]).sum::<f64>();
                let alpha = Vec3 {
                    x: row(0),
                    y: row(1),
                    z: row(2),
                } + t.segment_bias(s).0;
                // With torques that take the tilt into account (S1) no moment is left about the pivot; with the paper's
                // torques the whole moment turns the figure.
                let (force, moment) = t.ground_wrench(a);
                let alpha = alpha + tipping_acceleration(t, &p, force, moment);
                // The weight turns with the figure. A single step forward would neglect this, with an error of several
                // per cent of the energy of a fall.
                let before = p.project(t.kin.omega[s]);
                let alpha = p.project(alpha);
                let turn = Quat::exp((before + alpha * (0.5 * dt)) * dt);
                let arm = t.com - p.point;
                let weight = Vec3::Z * (input.world.gravity * t.mass);
                let moment = (turn.rotate(arm) - arm).cross(weight);
                let change = tipping_acceleration(t, &p, Vec3::zero(), moment);
                let omega = before + (alpha + change * 0.5) * dt;
                let position = p.point + turn.rotate(t.segment_position(s) - p.point);
                Rigid {
                    position,
                    rotation: (turn * rotation).normalized(),
                    omega,
                    velocity: omega.cross(position - p.point),
                }
            }
        };
        self.place(input, s, &wanted, state);
    }

    /// Moves the whole body rigidly so that segment `s` has the desired pose and velocity; joints keep their angles and
    /// rates.
    fn place(&mut self, input: &StepInput<'_>, s: usize, wanted: &Rigid, state: &mut State) {
        self.kin.set_state(input.links, state);
        let p = &mut state.posture;
        let at = p.root_position + self.kin.position[s];
        let turn =
            (wanted.rotation * Quat::from_mat3(&self.kin.rotation[s]).conjugate()).normalized();
        let arm = turn.rotate(p.root_position - at);
        p.root_position = wanted.position + arm;
        p.root_rotation = (turn * p.root_rotation).normalized();
        let v = &mut state.velocity;
        let pelvis = |o: usize, v: &[f64; NV]| {
            turn.rotate(Vec3 {
                x: v[o],
                y: v[o + 1],
                z: v[o + 2],
            })
        };
        // The excess twist, about the segment origin.
        let spin = turn.rotate(self.kin.omega[s]) - wanted.omega;
        let drift = turn.rotate(self.kin.velocity[s]) - wanted.velocity;
        let omega = pelvis(0, v) - spin;
        let velocity = pelvis(3, v) - drift - spin.cross(arm);
        v[..3].copy_from_slice(&omega.to_array());
        v[3..6].copy_from_slice(&velocity.to_array());
    }

    /// Earliest part of the tick at which a point above the floor strikes it; `None` if none does.
    fn arrival(&mut self, input: &StepInput<'_>, before: &Posture, after: &Posture) -> Option<f64> {
        let heights = |kin: &mut Kinematics<f64>, p: &Posture| {
            kin.set_posture(input.links, p);
            let root = p.root_position.z;
            let mut out = [[f64::INFINITY; POINTS_PER_SEGMENT]; SEGMENT_COUNT];
            for (s, segment) in input.body.segments.iter().enumerate() {
                for (z, local) in out[s].iter_mut().zip(&segment.contact_points) {
                    *z = root + kin.position[s].z + (kin.rotation[s] * *local).z;
                }
            }
            out
        };
        let (z0, z1) = (
            heights(&mut self.kin, before),
            heights(&mut self.kin, after),
        );
        let mut first = None;
        for (a, b) in z0.iter().flatten().zip(z1.iter().flatten()) {
            if *b < 0.0 && (a - b) > IMPACT_SPEED * input.world.dt {
                let fraction = (a / (a - b)).max(0.0);
                if first.is_none_or(|f| fraction < f) {
                    first = Some(fraction);
                }
            }
        }
        first
    }

    /// Inelastic impact of all touching points of the whole body: the least change of velocity in the metric of M that
    /// stops every point from moving into the floor; friction within its cone. Kinetic energy cannot rise. The
    /// workspace holds the terms of `state`.
    fn impact(&mut self, input: &StepInput<'_>, state: &mut State) {
        let terms = &self.terms;
        self.contacts.clear();
        for (s, segment) in input.body.segments.iter().enumerate() {
            for (vertex, local) in segment
                .contact_points
                .iter()
                .enumerate()
                .take(POINTS_PER_SEGMENT)
            {
                if terms.point_world(s, *local).z < IMPACT_HEIGHT {
                    let slot = self.contacts.slot(&terms.kin, s);
                    self.contacts.points.push(PointRow {
                        slot,
                        r: terms.kin.rotation[s] * *local,
                        c: Vec3::zero(),
                        inverse_r: 1.0 / COMPLIANCE,
                        segment: s,
                        vertex,
                        turn: None,
                    });
                }
            }
        }
        let mut momentum = [0.0; NV];
        terms.mass_matrix.mul(&state.velocity, &mut momentum);
        let mut v = state.velocity;
        let problem = ConvexProblem {
            system: SparseSystem(&terms.mass_matrix),
            b: &momentum,
            motors: &self.motors,
            limits: &self.limits,
            contacts: &self.contacts,
            wrench: None,
        };
        let stop = StopRule {
            iterations: ITERATIONS,
            tolerance: TOLERANCE,
        };
        let outcome = minimise(&problem, stop, &mut self.hessian, &mut v, &mut self.newton);
        self.contacts
            .add_transposed(&self.newton.force, 1.0, &mut momentum);
        self.hessian.rows = terms.mass_matrix.rows;
        factor(&mut self.hessian);
        solve(&self.hessian, &mut momentum);
        state.velocity = momentum;
        self.forces.iterations += outcome.iterations;
        if !outcome.converged {
            self.forces.flags.set(Flags::STEP_BOUND);
        }
        for (k, p) in self.contacts.points.iter().enumerate() {
            let impulse = self.newton.force[k];
            if impulse.z > 0.0 {
                let segment = SegmentId::new(p.segment).expect("rows hold valid segments");
                add_contact(
                    &mut self.forces.contact,
                    ContactPoint {
                        segment,
                        vertex: p.vertex,
                        position: terms.point_world(
                            p.segment,
                            input.body.segments[p.segment].contact_points[p.vertex],
                        ),
                        force: impulse * (1.0 / input.world.dt),
                    },
                );
            }
        }
    }

    /// The forces that the applied accelerations require: ground forces at the touching points and joint torques, by
    /// inverse dynamics.
    fn account(&mut self, input: &StepInput<'_>, decision: &Decision<'_>, state: &State) {
        let (t, command) = (input.start.terms, decision.command);
        let mut r = t.h; // M v̇ + h
        let mut ma = [0.0; NV];
        t.mass_matrix.mul(&command.acceleration, &mut ma);
        for (r, m) in r.iter_mut().zip(ma) {
            *r += m;
        }
        let points = decision.support.carriers();
        let holds = |p: &SupportPoint| match p.segment {
            L_FOOT | L_TOES => decision.planted[0],
            R_FOOT | R_TOES => decision.planted[1],
            _ => true,
        };
        let any = points.iter().any(holds);
        let mut out = match decision.left_out {
            Some(out) => *out,
            None => std::array::from_fn(|i| {
                points.get(i).is_some_and(|p| {
                    let far = command
                        .pivot
                        .is_some_and(|t| t.distance(p.position) >= PIVOT_REACH);
                    (any && !holds(p)) || far
                })
            }),
        };
        let passive = input
            .tissue
            .map_or([0.0; DOF_COUNT], |t| t.at(&command.acceleration[6..]));
        let f = &mut self.forces;
        f.audit.contacts.clear();
        f.audit.applied.clear();
        for (s, p, force) in input.forces.applied {
            f.audit
                .applied
                .push((*s, t.point_world(s.index(), *p), *force));
        }
        let root = t.state.posture.root_position;
        let wrench: [f64; 6] = std::array::from_fn(|k| r[k]);
        let total = |about: Vec3| shift(&wrench, about - root);
        let ratio = decision.support.ratio();
        let shares = !command.flags.has(Flags::FLIGHT)
            && if decision.left_out.is_some() {
                self.sharing.set_balanced(points, ratio, &out)
            } else {
                self.sharing.set_unilateral(points, ratio, &mut out, total)
            };
        if shares {
            let y = self.sharing.multiplier(&total(self.sharing.reference));
            for (p, _) in points.iter().zip(out).filter(|(_, out)| !out) {
                let force = self.sharing.point_force(p, ratio, &y);
                let s = p.segment.index();
                let local = match p.vertex {
                    NO_VERTEX => t
                        .segment_rotation(s)
                        .transpose_mul(p.position - t.segment_position(s)),
                    vertex => input.body.segment(p.segment).contact_points[vertex],
                };
                let mut jacobian = [[0.0; WIDTH]; 3];
                t.point_jacobian(s, local, &mut jacobian);
                for (row, f) in jacobian.iter().zip(force.to_array()) {
                    for (r, j) in r[6..].iter_mut().zip(&row[6..NV]) {
                        *r -= j * f;
                    }
                }
                if p.vertex == NO_VERTEX {
                    f.audit.applied.push((p.segment, p.position, force));
                    continue;
                }
                let contact = ContactPoint {
                    segment: p.segment,
                    vertex: p.vertex,
                    position: p.position,
                    force,
                };
                f.audit.contacts.push(contact);
                f.contact.push(contact);
            }
        }
        if decision.as_commanded {
            f.torque = command.torque;
        } else {
            for ((f, r), p) in f.torque.iter_mut().zip(&r[6..]).zip(&passive) {
                *f = r - p;
            }
        }
        f.ligament_torque = passive;
        f.audit.ligament_torque = passive;
        f.audit.torque = f.torque;
        f.audit.state = *state;
        f.audit.acceleration = command.acceleration;
        f.over_limit = 0.0;
        for j in 0..DOF_COUNT {
            f.over_limit = f
                .over_limit
                .max(f.torque[j] / input.start.available.upper[j] - 1.0)
                .max(f.torque[j] / input.start.available.lower[j] - 1.0);
        }
    }
}

/// The acceleration that leads from a state to a velocity in `dt`.
fn input_acceleration(start: &State, velocity: &[f64; NV], dt: f64) -> [f64; NV] {
    std::array::from_fn(|i| (velocity[i] - start.velocity[i]) / dt)
}

/// A holding foot is laid flat on the floor gradually: contact has a tolerance of some millimetres, and standing has
/// none.
fn settle(input: &StepInput<'_>, main: SegmentId, position: Vec3, rotation: Quat) -> (Vec3, Quat) {
    if main != L_FOOT && main != R_FOOT {
        return (position, rotation);
    }
    let up = rotation.rotate(Vec3::Z);
    if 1.0 - up.z > NEARLY_FLAT {
        return (position, rotation);
    }
    let points = &input.body.segment(main).contact_points;
    let turn = Quat::exp(up.cross(Vec3::Z) * SETTLE);
    let rotation = (turn * rotation).normalized();
    let low = |q: Quat| {
        points
            .iter()
            .map(|p| q.rotate(*p).z)
            .fold(f64::INFINITY, f64::min)
    };
    let mut position = position;
    position.z -= SETTLE * (position.z + low(rotation));
    (position, rotation)
}

/// Largest speed of the touching points of a support, m/s.
fn touching_speed(t: &Terms, points: &[SupportPoint], main: SegmentId) -> f64 {
    points
        .iter()
        .filter(|p| p.segment == main)
        .map(|p| {
            let s = p.segment.index();
            let r = p.position - t.segment_position(s);
            (t.kin.velocity[s] + t.kin.omega[s].cross(r)).norm()
        })
        .fold(0.0, f64::max)
}

/// Depth of the deepest contact point, m; 0 when none is below the surface.
fn deepest(input: &StepInput<'_>, t: &Terms) -> f64 {
    let mut depth = 0.0f64;
    for (s, segment) in input.body.segments.iter().enumerate() {
        for p in segment.contact_points.iter().take(POINTS_PER_SEGMENT) {
            depth = depth.max(-t.point_world(s, *p).z);
        }
    }
    depth
}

/// Adds a mean force to the list, or to an entry for the same point.
fn add_contact(list: &mut Vec<ContactPoint>, c: ContactPoint) {
    match list
        .iter_mut()
        .find(|p| p.segment == c.segment && p.vertex == c.vertex)
    {
        Some(p) => p.force += c.force,
        None => list.push(c),
    }
}
