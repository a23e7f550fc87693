//! The bar between two hands that hold one load: one more unknown of a substep.

use super::TorqueStepper;
use crate::body::topology::{NV, SegmentId};
use crate::contact::Outcome;
use crate::dynamics::jacobian::for_each_column;
use crate::dynamics::{Dynamics, factor, solve};
use crate::figure::assist::Spring;
use crate::figure::loads::Bar;
use crate::figure::params::bar;
use crate::math::Vec3;

/// The bar as a row of the solve.
#[derive(Clone, Copy, Debug)]
pub(super) struct BarRow {
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
    pub(super) fn new(bar: &Bar, terms: &Dynamics, h: f64) -> Self {
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

    pub(super) fn add(&self, impulse: f64, x: &mut [f64; NV]) {
        for (x, r) in x.iter_mut().zip(&self.row) {
            *x += impulse * r;
        }
    }
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
    ) -> Outcome {
        let mut total = Outcome::default();
        let earlier = self.solution.outcome.iterations;
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
            slope = secant.unwrap_or_else(|| self.slope(bar, earlier + total.iterations > 0));
            before = Some((self.bar.impulse, off));
            self.bar.impulse -= off / slope;
        }
        total
    }

    /// How much a unit impulse along the bar changes the rate of its length: by the last matrix that Newton's method
    /// has factored, with motors, limits and contacts as they stood then. If nothing was `factored` in this substep,
    /// what is there is of another one, and maybe of another figure: then by the mass matrix.
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
