//! The ways to solve a substep: once, again for points that slide, with the springs of an assist, with softer motors.

use crate::body::State;
use crate::body::topology::{DOF_COUNT, NV};
use crate::contact::{
    ConvexProblem, NewtonWorkspace, SolveOutcome, SparseSystem, StopRule, minimise,
};
use crate::dynamics::MassMatrix;
use crate::dynamics::{factor, solve};
use crate::math::Vec3;
use crate::stepper::command::StepInput;
use crate::stepper::params::bar;
use crate::stepper::params::{contact, motors, self_contact};
use crate::stepper::pelvis_wrench::Spring;
use crate::stepper::torque_step::bar::BarRow;
use crate::stepper::torque_step::{SubstepProblem, SubstepSolver, TorqueStepper};
use multiversion::multiversion;

impl TorqueStepper {
    /// Solves for the velocity at the end of the substep.
    ///
    /// Problem 14.3.
    pub(super) fn solve_substep(
        &mut self,
        input: &StepInput<'_>,
        h: f64,
        state: &State,
        spring: Option<&Spring>,
    ) {
        let t = &self.dynamics;
        let mut momentum = [0.0; NV];
        t.mass_matrix.mul(&state.velocity, &mut momentum);
        for i in 0..NV {
            momentum[i] -= h * t.h[i]; // M v_free
        }
        let mut v = state.velocity;
        if self.solver.accuracy.motors_first {
            self.begin_at_motors(h, &mut v);
        } else {
            let acceleration = match self.solution.saturated {
                None => input.last_acceleration,
                Some(_) => &self.forces.audit.acceleration,
            };
            for (v, a) in v.iter_mut().zip(acceleration) {
                *v += h * a;
            }
        }
        self.bar.impulse = self.bar.start;
        self.solution.assist = [0.0; 6];
        self.solution.outcome = SolveOutcome::default();
        self.problem.slides.begin(
            &mut self.problem.contacts,
            &state.velocity,
            &mut self.solver.newton,
        );
        let (body, own) = (input.body, input.own.as_ref());
        let mass = &self.dynamics.mass_matrix;
        self.own.correct(body, own, mass, None, &state.velocity);
        let mut x = momentum;
        for round in 0..=self_contact::ROUNDS {
            x = momentum;
            self.own.add_to(&mut x);
            self.solve_sliding(&x, spring, &mut v);
            let last = round + 1 >= self_contact::ROUNDS;
            let known = self.solution.outcome.iterations > 0 && !last;
            let solved = known.then_some(&self.solver.hessian);
            let mass = &self.dynamics.mass_matrix;
            if round == self_contact::ROUNDS || !self.own.correct(body, own, mass, solved, &v) {
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
    }

    /// Stores the starting values of the next substep. This happens when a substep is closed: a figure near others
    /// opens it twice, and must have the same bits as if it were alone.
    pub(super) fn keep_starts(&mut self) {
        let motors = &self.problem.motors;
        let given = self.solver.newton.motor.iter().enumerate();
        let saturated = given.filter(|(j, t)| **t >= motors.upper[*j] || **t <= motors.lower[*j]);
        self.solution.saturated = Some(saturated.fold(0, |all, (j, _)| all | 1 << j));
        self.bar.start = self.bar.impulse;
    }

    /// Repeats the solve as often as sliding points require.
    fn solve_sliding(&mut self, momentum: &[f64; NV], spring: Option<&Spring>, v: &mut [f64; NV]) {
        loop {
            let outcome = match self.problem.row {
                None => self.solve_with(momentum, spring, v),
                Some(bar) => self.solve_barred(momentum, spring, &bar, v),
            };
            self.solution.outcome = SolveOutcome {
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

    /// Starting point of Newton's method if the motors come first: `v` is the velocity at the start of the substep of
    /// `h` s.
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

    /// Solves with or without assist.
    pub(super) fn solve_with(
        &mut self,
        momentum: &[f64; NV],
        spring: Option<&Spring>,
        v: &mut [f64; NV],
    ) -> SolveOutcome {
        match spring {
            None => self.solve_freely(momentum, v, false),
            Some(spring) => self.solve_assisted(momentum, spring, v),
        }
    }

    /// Solves for the velocity at the end of the substep; with `assisted`, for the matrix that carries the springs of
    /// the assist.
    fn solve_freely(
        &mut self,
        momentum: &[f64; NV],
        v: &mut [f64; NV],
        assisted: bool,
    ) -> SolveOutcome {
        let outcome = self.solve_once(momentum, v, assisted);
        if outcome.converged {
            outcome
        } else {
            self.solve_softer(momentum, v, outcome, assisted)
        }
    }

    /// One run of Newton's method with the motors as they are.
    fn solve_once(
        &mut self,
        momentum: &[f64; NV],
        v: &mut [f64; NV],
        assisted: bool,
    ) -> SolveOutcome {
        let SubstepSolver {
            newton,
            hessian,
            assisted: springs,
            accuracy,
            ..
        } = &mut self.solver;
        let stop = StopRule {
            iterations: contact::ITERATIONS,
            tolerance: accuracy.tolerance,
        };
        let matrix = if assisted {
            springs
        } else {
            &self.dynamics.mass_matrix
        };
        substep_kernel(matrix, &self.problem, momentum, stop, v, hessian, newton)
    }

    /// Solves with the springs of the assist. A part whose impulse exceeds its bound is replaced by a constant impulse
    /// at the bound, and the rest is solved again. Leaves the impulse in `solution.assist`.
    fn solve_assisted(
        &mut self,
        momentum: &[f64; NV],
        spring: &Spring,
        v: &mut [f64; NV],
    ) -> SolveOutcome {
        let mut fixed: [Option<Vec3>; 2] = [None; 2];
        let mut total = SolveOutcome::default();
        loop {
            self.solver.assisted.rows = self.dynamics.mass_matrix.rows;
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
            total = SolveOutcome {
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

    /// Second try of a substep in which stiff motors, limits and contacts kept Newton's method zigzagging: the same
    /// strength and friction, with motors that saturate later. Closing an unconverged step would turn its residual into
    /// the speed of a light joint.
    fn solve_softer(
        &mut self,
        momentum: &[f64; NV],
        v: &mut [f64; NV],
        first: SolveOutcome,
        assisted: bool,
    ) -> SolveOutcome {
        for j in 0..DOF_COUNT {
            // The same torque at the joint's present rate, and a hundredth of the gain around it.
            let (m, now) = (
                &mut self.problem.motors,
                self.dynamics.state.velocity[6 + j],
            );
            let torque = (m.gain[j] * (m.rest[j] - now)).clamp(m.lower[j], m.upper[j]);
            m.gain[j] *= motors::SOFTENING;
            m.rest[j] = now + torque / m.gain[j];
        }
        let second = self.solve_once(momentum, v, assisted);
        SolveOutcome {
            iterations: first.iterations + second.iterations,
            ..second
        }
    }
}

/// The kernel of one substep, compiled for the available vector instructions.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn substep_kernel(
    m: &MassMatrix<f64>,
    problem: &SubstepProblem,
    momentum: &[f64; NV],
    stop: StopRule,
    v: &mut [f64; NV],
    hessian: &mut MassMatrix<f64>,
    ws: &mut NewtonWorkspace,
) -> SolveOutcome {
    let problem = ConvexProblem {
        system: SparseSystem(m),
        b: momentum,
        motors: &problem.motors,
        limits: &problem.limits,
        contacts: &problem.contacts,
        wrench: None,
    };
    minimise(&problem, stop, hessian, v, ws)
}

impl TorqueStepper {
    /// Solves with a bar: one unknown impulse along it, found by Newton and secant steps on the rate of its length,
    /// which grows with the impulse. Leaves the impulse in `bar.impulse`; it is the next substep's first guess.
    pub(super) fn solve_barred(
        &mut self,
        momentum: &[f64; NV],
        spring: Option<&Spring>,
        bar: &BarRow,
        v: &mut [f64; NV],
    ) -> SolveOutcome {
        let mut total = SolveOutcome::default();
        let earlier = self.solution.outcome.iterations;
        let mut before: Option<(f64, f64)> = None;
        let mut slope = 0.0;
        for _ in 0..bar::ITERATIONS {
            let mut b = *momentum;
            bar.add(self.bar.impulse, &mut b);
            let outcome = self.solve_with(&b, spring, v);
            total = SolveOutcome {
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
            slope = secant.unwrap_or_else(|| self.slope(bar, earlier + total.iterations > 0));
            before = Some((self.bar.impulse, off));
            self.bar.impulse -= off / slope;
        }
        total
    }

    /// Change of the rate of the bar's length per unit impulse along it: by the last matrix that Newton's method has
    /// factored, with motors, limits and contacts in their state at that time. If nothing was `factored` in this
    /// substep, the stored factor belongs to another substep, maybe of another figure; then the mass matrix is used.
    fn slope(&mut self, bar: &BarRow, factored: bool) -> f64 {
        if !factored {
            self.solver.hessian.rows = self.dynamics.mass_matrix.rows;
            factor(&mut self.solver.hessian);
        }
        let mut x = [0.0; NV];
        bar.add(1.0, &mut x);
        solve(&self.solver.hessian, &mut x);
        bar.rate(&x).max(1e-4)
    }

    /// Adds the bar's forces to the means, and to the audit of the last substep.
    pub(super) fn account_bar(&mut self, row: &BarRow, h: f64, dt: f64, last: bool) {
        self.forces.bar += row.direction * (self.bar.impulse / dt);
        if last {
            let force = row.direction * (self.bar.impulse / h);
            self.bar.forces = Some([
                (row.ends[0].0, row.ends[0].1, force * -1.0),
                (row.ends[1].0, row.ends[1].1, force),
            ]);
        }
    }
}
