//! Goal: islands are solved within their bound, and to the solution. Method: random figures and free bodies with weak
//! motors, joint limits, ground and up to a hundred contacts are thrown at each other. The same problem in its dual
//! form (velocities, motor values, limits, forces) is built from inertia and rows alone, and solved by another
//! interior-point method (clarabel).

use super::super::direction::tests::{Puppet, numbers, scene};
use super::super::newton::MAX_ITERATIONS;
use super::*;
use crate::contact::limits::LIMIT_STIFFNESS;
use crate::contact::rows::PointRow;
use crate::contact::{LimitRow, SolveOutcome};
use crate::dynamics::terms::WIDTH;
use crate::math::vec3::vec3;
use crate::support::testing::Rng;
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT,
};

/// An island with all kinds of bodies and contacts, whose bodies are `fast` times as fast as usual.
fn hard(rng: &mut Rng, contacts: usize, fast: f64) -> (Island, Vec<Puppet>) {
    let (island, mut figures) = scene(rng, contacts);
    for p in &mut figures {
        let v = numbers(rng).map(|v| v * fast);
        p.terms.mass_matrix.mul(&v, &mut p.b);
        p.x = numbers(rng);
        for j in 0..DOF_COUNT {
            p.motors.gain[j] = rng.between(0.1, 20.0);
            p.motors.rest[j] = fast * rng.unit();
            let most = rng.between(0.001, 3.0);
            (p.motors.lower[j], p.motors.upper[j]) = (-most * rng.between(0.2, 1.0), most);
        }
        // A motor without strength.
        (p.motors.lower[7], p.motors.upper[7]) = (0.0, 0.0);
        for d in 0..DOF_COUNT {
            p.limits.rows.push(LimitRow {
                first: 6 + d,
                len: 1,
                coefficients: [if rng.unit() > 0.0 { 1.0 } else { -1.0 }, 0.0, 0.0],
                allowed: rng.between(-3.0, 20.0),
                stiffness: LIMIT_STIFFNESS,
            });
        }
        for segment in [6, 12, 16] {
            let slot = p.contacts.slot(&p.terms.kin, segment);
            for vertex in 0..4 {
                p.contacts.points.push(PointRow {
                    slot,
                    r: vec3(rng.unit(), rng.unit(), rng.unit()) * 0.1,
                    c: vec3(0.0, 0.0, rng.unit()),
                    inverse_r: 1e4,
                    segment,
                    vertex,
                    turn: None,
                });
            }
        }
    }
    (island, figures)
}

/// The problem as `min ½ zᵀP z + qᵀz`, `A z + s = b`; z: velocities of all blocks, then t, limits and forces.
#[derive(Default)]
struct Dual {
    p: Vec<(usize, usize, f64)>,
    q: Vec<f64>,
    /// Equations of motion: row, column, value.
    a: Vec<(usize, usize, f64)>,
    motion: Vec<f64>,
    /// Boxes: unknown, bounds. One-sided: unknown. Cones: first unknown, μ.
    boxes: Vec<(usize, f64, f64)>,
    pushes: Vec<usize>,
    cones: Vec<(usize, f64)>,
}

impl Dual {
    fn unknown(&mut self, square: f64, linear: f64) -> usize {
        let i = self.q.len();
        self.p.push((i, i, square));
        self.q.push(linear);
        i
    }

    /// Three forces with rows `j` on the velocities from `first` on.
    fn force(&mut self, r: f64, c: Vec3, mu: f64, rows: &[(usize, [[f64; NV]; 3])]) {
        let c = c.to_array();
        let at = self.q.len();
        for axis in 0..3 {
            let z = self.unknown(r, c[axis]);
            for (first, j) in rows {
                for (i, v) in j[axis].iter().enumerate().filter(|(_, v)| **v != 0.0) {
                    self.a.push((first + i, z, -v));
                }
            }
        }
        self.cones.push((at, mu));
    }

    fn of(island: &Island, figures: &[Puppet]) -> Self {
        let mut out = Self::default();
        let mut first = Vec::new();
        for b in &island.blocks {
            first.push(out.q.len());
            let at = out.q.len();
            let n = b.len();
            let mut m = [[0.0; WIDTH]; NV];
            match b.kind {
                BlockKind::Figure(i) => {
                    figures[i].terms.mass_matrix.to_dense(&mut m);
                    out.motion.extend(figures[i].b);
                }
                BlockKind::Free(_) => {
                    for i in 0..6 {
                        m[i][..6].copy_from_slice(&b.a[i]);
                    }
                    out.motion.extend(b.b);
                }
            }
            out.q.resize(at + n, 0.0);
            for i in 0..n {
                for k in 0..n {
                    out.a.push((at + i, at + k, m[i][k]));
                    if k >= i {
                        out.p.push((at + i, at + k, m[i][k]));
                    }
                }
            }
        }
        for (b, at) in island.blocks.iter().zip(first.clone()) {
            let BlockKind::Figure(i) = b.kind else {
                continue;
            };
            let f = &figures[i];
            for j in 0..DOF_COUNT {
                let z = out.unknown(1.0 / f.motors.gain[j], -f.motors.rest[j]);
                out.a.push((at + 6 + j, z, -1.0));
                out.boxes.push((z, f.motors.lower[j], f.motors.upper[j]));
            }
            for row in &f.limits.rows {
                let z = out.unknown(1.0 / row.stiffness, row.allowed);
                for k in 0..row.len {
                    out.a.push((at + row.first + k, z, -row.coefficients[k]));
                }
                out.pushes.push(z);
            }
            for p in &f.contacts.points {
                let local = f.terms.kin.rotation[p.segment].transpose_mul(p.r);
                let mut j = [[0.0; WIDTH]; 3];
                f.terms.point_jacobian(p.segment, local, &mut j);
                let rows = j.map(|row| std::array::from_fn(|i| row[i]));
                out.force(1.0 / p.inverse_r, p.c, f.contacts.friction, &[(at, rows)]);
            }
        }
        for c in &island.contacts {
            let sides = (0..2).filter_map(|s| Some((first[c.block[s]?], c.rows[s])));
            let rows: Vec<_> = sides.collect();
            out.force(1.0 / c.inverse_r, c.c, c.mu, &rows);
        }
        out
    }

    fn solve(mut self) -> Vec<f64> {
        let n = self.q.len();
        let mut b = self.motion.clone();
        let mut cones = vec![SupportedConeT::ZeroConeT(b.len())];
        cones.push(SupportedConeT::NonnegativeConeT(
            2 * self.boxes.len() + self.pushes.len(),
        ));
        for (z, lower, upper) in &self.boxes {
            self.a.push((b.len(), *z, 1.0));
            b.push(*upper);
            self.a.push((b.len(), *z, -1.0));
            b.push(-*lower);
        }
        for z in &self.pushes {
            self.a.push((b.len(), *z, -1.0));
            b.push(0.0);
        }
        for (at, mu) in &self.cones {
            cones.push(SupportedConeT::SecondOrderConeT(3));
            for (axis, scale) in [(2, *mu), (0, 1.0), (1, 1.0)] {
                self.a.push((b.len(), at + axis, -scale));
                b.push(0.0);
            }
        }
        let sparse = |m: usize, entries: &[(usize, usize, f64)]| {
            let mut e: Vec<_> = entries.iter().filter(|e| e.2 != 0.0).collect();
            e.sort_by_key(|e| (e.1, e.0));
            let mut colptr = vec![0; n + 1];
            e.iter().for_each(|e| colptr[e.1 + 1] += 1);
            (0..n).for_each(|k| colptr[k + 1] += colptr[k]);
            let rows = e.iter().map(|e| e.0).collect();
            CscMatrix::new(m, n, colptr, rows, e.iter().map(|e| e.2).collect())
        };
        let settings = DefaultSettingsBuilder::default()
            .verbose(false)
            .tol_gap_abs(1e-9)
            .tol_gap_rel(1e-11)
            .tol_feas(1e-11)
            .max_iter(300)
            .build()
            .unwrap();
        let (p, a) = (sparse(n, &self.p), sparse(b.len(), &self.a));
        let mut solver = DefaultSolver::new(&p, &self.q, &a, &b, &cones, settings).unwrap();
        solver.solve();
        let status = solver.solution.status;
        assert!(
            matches!(status, SolverStatus::Solved | SolverStatus::AlmostSolved),
            "{status:?}"
        );
        solver.solution.x
    }
}

#[test]
fn islands_are_solved_within_their_bound() {
    let mut rng = Rng::new(11);
    let (mut most, mut worst, mut jammed) = (0, 0.0f64, 0);
    for case in 0..60 {
        let (contacts, fast) = ([2, 10, 30, 100][case % 4], [1.0, 30.0, 1000.0][case % 3]);
        let (mut island, mut figures) = hard(&mut rng, contacts, fast);
        let exact = Dual::of(&island, &figures).solve();
        let out: SolveOutcome = island.solve(&mut figures);
        let text = format!("case {case}: {contacts} contacts, {fast} times, {out:?}");
        assert!(out.converged && out.iterations <= MAX_ITERATIONS, "{text}");
        jammed += u32::from(out.iterations > 30);
        most = most.max(out.iterations);
        let scale = exact[..102].iter().fold(1.0f64, |m, x| m.max(x.abs()));
        let mut at = 0;
        for b in &island.blocks {
            for x in &b.x[..b.len()] {
                worst = worst.max((x - exact[at]).abs() / scale);
                at += 1;
            }
        }
        assert!(worst < 1e-5, "{text}: off by {worst:e}");
    }
    println!(
        "at most {most} iterations, {jammed} of 60 jammed, velocities within {worst:e} of the exact ones"
    );
}

/// A free body has six velocities in a block with room for those of a figure. An interior point that has left its cone
/// writes NaN into the unused gradients; Newton's method must ignore them.
#[test]
fn what_an_interior_point_left_behind_does_not_stop_newton() {
    let (mut island, mut figures) = hard(&mut Rng::new(3), 10, 30.0);
    for b in &mut island.blocks {
        b.grad = [f64::NAN; NV];
    }
    assert!(island.solve(&mut figures).converged);
}
