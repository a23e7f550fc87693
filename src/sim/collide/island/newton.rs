//! Newton's method for an island: gradients, line search and when to stop.

use super::{Articulated, Block, BlockKind, Island, dot, relative};
use crate::body::topology::{DOF_COUNT, NV};
use crate::contact::SolveOutcome;
use crate::contact::newton::{LineSearch, largest};
use crate::contact::projection::Region;

/// Newton iterations after which it counts as jammed; 5 to 15 are typical.
const NEWTON_ITERATIONS: u32 = 30;
/// Largest number of iterations of the interior-point method that then takes over.
const INTERIOR_ITERATIONS: u32 = 50;
/// Largest number of iterations of both kinds. It is generous because an unfinished solve would let bodies sink into
/// each other.
pub(super) const MAX_ITERATIONS: u32 = 120;
/// Largest number of evaluations in one line search.
const LINE_SEARCH: usize = 16;
/// Residual at which the island counts as solved, N·m·s.
const TOLERANCE: f64 = 1e-6;
/// Residual above which rounding cannot be its cause, whatever the velocities, N·m·s.
const MOST_ROUNDED: f64 = 1e-3;

impl Island {
    /// Solves from the velocities that the figures hold and leaves the solution there. Bounded work.
    pub fn solve<F: Articulated>(&mut self, figures: &mut [F]) -> SolveOutcome {
        self.start(figures);
        let mut out = SolveOutcome::default();
        loop {
            (out.residual, out.converged) = self.judge(figures);
            if out.converged || out.iterations >= MAX_ITERATIONS || !out.residual.is_finite() {
                break;
            }
            if out.iterations == NEWTON_ITERATIONS {
                out.iterations += self.approach(figures, INTERIOR_ITERATIONS);
                continue;
            }
            out.iterations += 1;
            if !self.direction(figures, false) {
                break;
            }
            self.line_search(figures);
        }
        for b in &self.blocks {
            if let BlockKind::Figure(i) = b.kind {
                *figures[i].parts().x = b.x;
            }
        }
        out
    }

    /// Takes the velocities of the figures.
    pub(super) fn start<F: Articulated>(&mut self, figures: &mut [F]) {
        for b in &mut self.blocks {
            match b.kind {
                BlockKind::Figure(i) => {
                    let p = figures[i].parts();
                    b.x = *p.x;
                    p.m.mul(&b.x, &mut b.ax);
                    p.contacts.velocities(&b.x, &mut p.newton.velocity);
                }
                BlockKind::Free(_) => {
                    b.ax = [0.0; NV];
                    for i in 0..6 {
                        b.ax[i] = (0..6).map(|j| b.a[i][j] * b.x[j]).sum();
                    }
                }
            }
        }
        self.velocities();
    }

    /// The largest gradient at the present velocities, and whether it counts as zero: below the tolerance, or within
    /// rounding.
    pub(super) fn judge<F: Articulated>(&mut self, figures: &mut [F]) -> (f64, bool) {
        self.gradients(figures);
        let largest = |m: f64, b: &Block| m.max(largest(&b.grad));
        let residual = self.blocks.iter().fold(0.0, largest);
        let rounded = |island: &Self, figures| residual < island.rounding(figures);
        let none = residual < TOLERANCE || (residual < MOST_ROUNDED && rounded(self, figures));
        (residual, none)
    }

    /// Rounding error of a gradient, N·m·s: the last digit of its terms. Stiffness times velocity is the largest term:
    /// a led plane that turns may move at 9 km/s at 500 m from its centre, where contacts of 10⁴ kg have an arm of 500
    /// m; and the angles of a raised arm change by 300 rad per radian of its turn.
    fn rounding<F: Articulated>(&self, figures: &mut [F]) -> f64 {
        let mut sum = 0.0;
        for b in &self.blocks {
            sum += largest(&b.ax);
            let BlockKind::Figure(i) = b.kind else {
                continue;
            };
            let p = figures[i].parts();
            let within = (0..DOF_COUNT).filter(|j| b.slope[*j] > 0.0);
            sum += within
                .map(|j| p.motors.gain[j] * (p.motors.rest[j].abs() + b.x[6 + j].abs()))
                .sum::<f64>();
            for row in &p.limits.rows {
                if row.impulse(row.rate(&b.x)) > 0.0 {
                    let used = row.coefficients[..row.len].iter();
                    let arm = used.clone().fold(0.0f64, |m, c| m.max(c.abs()));
                    let rates = used.zip(&b.x[row.first..]).map(|(c, x)| (c * x).abs());
                    sum += row.stiffness * arm * (row.allowed.abs() + rates.sum::<f64>());
                }
            }
            for (point, v) in p.contacts.points.iter().zip(p.newton.velocity.iter()) {
                sum += point.inverse_r * (v.norm() + point.c.norm());
            }
        }
        for c in self.contacts.iter().filter(|c| c.region != Region::Open) {
            let rows = c.rows.iter().flatten().flatten();
            let arm = rows.fold(0.0f64, |m, r| m.max(r.abs()));
            sum += arm * c.inverse_r * (c.u.norm() + c.c.norm());
        }
        f64::EPSILON * sum
    }

    pub(super) fn gradients<F: Articulated>(&mut self, figures: &mut [F]) {
        for b in &mut self.blocks {
            match b.kind {
                BlockKind::Figure(i) => {
                    let p = figures[i].parts();
                    for k in 0..NV {
                        b.grad[k] = b.ax[k] - p.b[k];
                    }
                    for j in 0..DOF_COUNT {
                        let (t, s) = p.motors.value(j, b.x[6 + j]);
                        p.newton.motor[j] = t;
                        b.slope[j] = s;
                        b.grad[6 + j] -= t;
                    }
                    p.newton.limit.fill(0.0);
                    for row in &p.limits.rows {
                        let q = row.impulse(row.rate(&b.x));
                        if q > 0.0 {
                            for k in 0..row.len {
                                p.newton.limit[row.first - 6 + k] += q * row.coefficients[k];
                            }
                        }
                    }
                    for j in 0..DOF_COUNT {
                        b.grad[6 + j] -= p.newton.limit[j];
                    }
                    for k in 0..p.contacts.points.len() {
                        (p.newton.force[k], p.newton.region[k]) =
                            p.contacts.force(k, p.newton.velocity[k]);
                    }
                    p.contacts
                        .add_transposed(&p.newton.force, -1.0, &mut b.grad);
                }
                BlockKind::Free(_) => {
                    // Clear all entries: values that an interior point outside its cone wrote behind the sixth entry
                    // would stay there.
                    b.grad = [0.0; NV];
                    for k in 0..6 {
                        b.grad[k] = b.ax[k] - b.b[k];
                    }
                }
            }
        }
        for c in &mut self.contacts {
            (c.impulse, c.region) = c.at(c.u);
            if c.region == Region::Open {
                continue;
            }
            for side in 0..2 {
                if let Some(b) = c.block[side] {
                    for (row, f) in c.rows[side].iter().zip(c.impulse.to_array()) {
                        for (g, r) in self.blocks[b].grad.iter_mut().zip(row) {
                            *g -= f * r;
                        }
                    }
                }
            }
        }
    }

    /// Exact line search along the common direction, and the step.
    fn line_search<F: Articulated>(&mut self, figures: &mut [F]) {
        let (mut q0, mut q1, mut slope0) = (0.0, 0.0, 0.0);
        for b in &mut self.blocks {
            match b.kind {
                BlockKind::Figure(i) => {
                    let p = figures[i].parts();
                    p.m.mul(&b.d, &mut b.ad);
                    p.newton.aim(p.limits, p.contacts, [&b.x, &b.d]);
                    for k in 0..NV {
                        q0 += b.d[k] * (b.ax[k] - p.b[k]);
                    }
                }
                BlockKind::Free(_) => {
                    b.ad = [0.0; NV];
                    for k in 0..6 {
                        b.ad[k] = (0..6).map(|j| b.a[k][j] * b.d[j]).sum();
                        q0 += b.d[k] * (b.ax[k] - b.b[k]);
                    }
                }
            }
            q1 += dot(&b.d, &b.ad);
            slope0 += dot(&b.d, &b.grad);
        }
        let blocks = &self.blocks;
        for c in &mut self.contacts {
            c.du = relative(c, |b| &blocks[b].d);
        }
        let contacts = &self.contacts;
        let mut slope = |a: f64| {
            let mut z = q0 + a * q1;
            for b in blocks {
                if let BlockKind::Figure(i) = b.kind {
                    let p = figures[i].parts();
                    let along = [&b.x, &b.d];
                    z = p
                        .newton
                        .less_given((z, a), p.motors, p.limits, p.contacts, along);
                }
            }
            for c in contacts {
                z -= c.du.dot(c.at(c.u + c.du * a).0);
            }
            z
        };
        let mut search = LineSearch::new(slope0, LINE_SEARCH);
        while !search.ends_at(slope(search.step)) {}
        let a = search.step;
        for b in &mut self.blocks {
            for k in 0..NV {
                b.x[k] += a * b.d[k];
                b.ax[k] += a * b.ad[k];
            }
            if let BlockKind::Figure(i) = b.kind {
                let p = figures[i].parts();
                for k in 0..p.contacts.points.len() {
                    p.newton.velocity[k] += p.newton.direction[k] * a;
                }
            }
        }
        for c in &mut self.contacts {
            c.u += c.du * a;
        }
    }
}
