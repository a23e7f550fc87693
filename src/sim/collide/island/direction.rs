//! Newton's matrix of an island and the resulting direction.

use super::{
    Articulated, ArticulatedParts, Block, BlockKind, Contact, CouplingColumn, Island, dot,
};
use crate::body::topology::{DOF_COUNT, NV, SEGMENT_COUNT};
use crate::contact::SparseSystem;
use crate::contact::cone::squared;
use crate::contact::newton::System;
use crate::contact::projection::{Region, derivative};
use crate::contact::rows::{CHAIN_WIDTH, add_point_stiffness};
use crate::dynamics::factor::{factor, solve};
use crate::dynamics::mass_matrix::{CHAIN, DEPTH};
use crate::math::Vec3;
use crate::math::dense::{factor_columns, factor_rows, solve_lower, solve_rows, solve_upper};
use multiversion::multiversion;

impl Island {
    /// Computes Newton's direction of the whole island; returns false if there is none.
    ///
    /// Bodies that touch each other couple their matrices. The coupling is solved in the smaller space: by the Woodbury
    /// identity in the directions of the touching contacts or, with many contacts, in one matrix of all velocities.
    /// Either way, the work of an iteration grows with the cube of the smaller number.
    ///
    /// `inside`: with the slopes of the interior-point method instead of those at the present velocities.
    pub(super) fn direction<F: Articulated>(&mut self, figures: &mut [F], inside: bool) -> bool {
        let coupled =
            |c: &&Contact| c.region != Region::Open && c.block[0].is_some() && c.block[1].is_some();
        let directions: usize = self
            .contacts
            .iter()
            .filter(coupled)
            .map(|c| if c.region == Region::Stick { 3 } else { 2 })
            .sum();
        let velocities: usize = self.blocks.iter().map(Block::len).sum();
        self.block_matrices(figures, inside);
        let solved = if directions <= velocities {
            self.by_contacts(figures)
        } else {
            self.by_velocities(figures, velocities)
        };
        solved
            && self
                .blocks
                .iter()
                .all(|b| b.d.iter().all(|x| x.is_finite()))
    }

    /// Newton's matrix of every block, without contacts between two moving bodies.
    fn block_matrices<F: Articulated>(&mut self, figures: &mut [F], inside: bool) {
        for (k, b) in self.blocks.iter_mut().enumerate() {
            match b.kind {
                BlockKind::Figure(i) => {
                    let mut p = figures[i].parts();
                    own_matrix(&mut p, b, inside);
                    for c in &self.contacts {
                        let Some(side) = one_sided(c, k) else {
                            continue;
                        };
                        let kr = stiff_rows(c, side);
                        for i in c.used(side) {
                            let row = &mut p.hessian.rows[i];
                            for j in c.used(side).take_while(|j| *j <= i) {
                                row[DEPTH[j]] += quadratic(&c.rows[side], &kr, i, j);
                            }
                        }
                    }
                }
                BlockKind::Free(_) => {
                    b.l = b.a;
                    for c in &self.contacts {
                        let Some(side) = one_sided(c, k) else {
                            continue;
                        };
                        let kr = stiff_rows(c, side);
                        for i in 0..6 {
                            for j in 0..=i {
                                b.l[i][j] += quadratic(&c.rows[side], &kr, i, j);
                            }
                        }
                    }
                }
            }
        }
    }

    /// In the directions of the contacts: (1 + Bᵀ H⁻¹ B) z = Bᵀ d₀, then d = d₀ − H⁻¹ B z.
    fn by_contacts<F: Articulated>(&mut self, figures: &mut [F]) -> bool {
        for b in &mut self.blocks {
            factor_block(b, figures);
            b.d = std::array::from_fn(|i| -b.grad[i]);
            let mut x = b.d;
            solve_block(b, figures, &mut x);
            b.d = x;
        }
        self.columns.clear();
        for c in &self.contacts {
            let ([Some(a), Some(b)], true) = (c.block, c.region != Region::Open) else {
                continue;
            };
            let (e, n) = root(c);
            for e in e.iter().take(n) {
                let mut column = CouplingColumn {
                    block: [a, b],
                    v: [[0.0; NV]; 2],
                    y: [[0.0; NV]; 2],
                };
                for side in 0..2 {
                    for (row, w) in c.rows[side].iter().zip(e) {
                        for (v, r) in column.v[side].iter_mut().zip(row) {
                            *v += w * r;
                        }
                    }
                    column.y[side] = column.v[side];
                    solve_block(
                        &self.blocks[column.block[side]],
                        figures,
                        &mut column.y[side],
                    );
                }
                self.columns.push(column);
            }
        }
        let n = self.columns.len();
        if n == 0 {
            return true;
        }
        self.matrix.clear();
        self.matrix.resize(n * n, 0.0);
        self.rhs.clear();
        for (i, p) in self.columns.iter().enumerate() {
            for (j, q) in self.columns.iter().enumerate().take(i + 1) {
                let mut z = if i == j { 1.0 } else { 0.0 };
                for s in 0..2 {
                    for t in 0..2 {
                        if p.block[s] == q.block[t] {
                            z += dot(&p.v[s], &q.y[t]);
                        }
                    }
                }
                self.matrix[j * n + i] = z;
            }
            let z =
                dot(&p.v[0], &self.blocks[p.block[0]].d) + dot(&p.v[1], &self.blocks[p.block[1]].d);
            self.rhs.push(z);
        }
        if !cholesky_solve(&mut self.matrix, &mut self.rhs) {
            return false;
        }
        for (p, z) in self.columns.iter().zip(&self.rhs) {
            for s in 0..2 {
                for (d, y) in self.blocks[p.block[s]].d.iter_mut().zip(&p.y[s]) {
                    *d -= z * y;
                }
            }
        }
        true
    }

    /// In the `n` velocities of all bodies: one matrix with the blocks on its diagonal and the contacts between them
    /// off it.
    fn by_velocities<F: Articulated>(&mut self, figures: &mut [F], n: usize) -> bool {
        self.matrix.clear();
        self.matrix.resize(n * n, 0.0);
        self.rhs.clear();
        self.first.clear();
        for b in &self.blocks {
            let first = self.rhs.len();
            self.first.push(first);
            self.rhs.extend(b.grad[..b.len()].iter().map(|g| -g));
            match b.kind {
                BlockKind::Figure(k) => {
                    let hessian = &figures[k].parts().hessian;
                    for i in 0..NV {
                        for (depth, j) in CHAIN[i].iter().enumerate().take(DEPTH[i] + 1) {
                            self.matrix[(first + j) * n + first + i] = hessian.rows[i][depth];
                        }
                    }
                }
                BlockKind::Free(_) => {
                    for i in 0..6 {
                        for j in 0..=i {
                            self.matrix[(first + j) * n + first + i] = b.l[i][j];
                        }
                    }
                }
            }
        }
        for c in &self.contacts {
            let ([Some(a), Some(b)], true) = (c.block, c.region != Region::Open) else {
                continue;
            };
            let block = [a, b];
            for (s, t) in [(0, 0), (1, 1), if a < b { (0, 1) } else { (1, 0) }] {
                // The earlier block supplies the row and the later one the columns, because only the part with column ≥
                // row is read.
                let (row, column) = (self.first[block[s]], self.first[block[t]]);
                let len = self.blocks[block[t]].len();
                let kr = stiff_rows(c, t);
                for i in c.used(s) {
                    let start = (row + i) * n + column;
                    let line = &mut self.matrix[start..start + len];
                    for (axis, kr) in c.rows[s].iter().zip(&kr) {
                        for (o, y) in line.iter_mut().zip(kr) {
                            *o += axis[i] * y;
                        }
                    }
                }
            }
        }
        if !cholesky_solve(&mut self.matrix, &mut self.rhs) {
            return false;
        }
        for (b, first) in self.blocks.iter_mut().zip(&self.first) {
            let len = b.len();
            b.d = [0.0; NV];
            b.d[..len].copy_from_slice(&self.rhs[*first..first + len]);
        }
        true
    }
}

/// The side on which an active contact with something fixed has `block`.
fn one_sided(c: &Contact, block: usize) -> Option<usize> {
    if c.region == Region::Open {
        return None;
    }
    match c.block {
        [Some(b), None] if b == block => Some(0),
        [None, Some(b)] if b == block => Some(1),
        _ => None,
    }
}

fn stiffness(c: &Contact) -> [[f64; 3]; 3] {
    if let Some(root) = &c.inside {
        return squared(root);
    }
    let mut d = derivative((c.u + c.c) * -c.inverse_r, c.mu, c.region);
    for row in &mut d {
        for x in row {
            *x *= c.inverse_r;
        }
    }
    d
}

/// The stiffness of an active contact times its rows on one side.
fn stiff_rows(c: &Contact, side: usize) -> [[f64; NV]; 3] {
    let d = stiffness(c);
    let mut out = [[0.0; NV]; 3];
    for (out, weights) in out.iter_mut().zip(&d) {
        for i in c.used(side) {
            let mut z = 0.0;
            for (w, row) in weights.iter().zip(&c.rows[side]) {
                z += w * row[i];
            }
            out[i] = z;
        }
    }
    out
}

/// `rowsᵀ (d rows)` at (i, j); `kr` is the second factor.
fn quadratic(rows: &[[f64; NV]; 3], kr: &[[f64; NV]; 3], i: usize, j: usize) -> f64 {
    rows[0][i] * kr[0][j] + rows[1][i] * kr[1][j] + rows[2][i] * kr[2][j]
}

/// Columns e with `Σ e eᵀ` the stiffness of an active contact.
fn root(c: &Contact) -> ([[f64; 3]; 3], usize) {
    if let Some(root) = c.inside {
        return (root.map(Vec3::to_array), 3);
    }
    let s = c.inverse_r.sqrt();
    if c.region == Region::Stick {
        return ([[s, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, s]], 3);
    }
    let u = (c.u + c.c) * -c.inverse_r;
    let t = (u.x * u.x + u.y * u.y).sqrt();
    let q = 1.0 / (1.0 + c.mu * c.mu);
    let along = s * q.sqrt();
    let side = s * (c.mu * (u.z + c.mu * t) * q / t).max(0.0).sqrt();
    (
        [
            [c.mu * u.x / t * along, c.mu * u.y / t * along, along],
            [-u.y / t * side, u.x / t * side, 0.0],
            [0.0; 3],
        ],
        2,
    )
}

/// Writes the matrix of one figure's own problem into its storage, as in [`crate::contact::minimise`].
fn own_matrix(p: &mut ArticulatedParts<'_>, b: &Block, inside: bool) {
    type S<'a> = SparseSystem<'a>;
    SparseSystem(p.m).load(p.hessian);
    for j in 0..DOF_COUNT {
        S::add(p.hessian, 6 + j, 6 + j, b.slope[j]);
    }
    for (k, row) in p.limits.rows.iter().enumerate() {
        let slope = if inside {
            p.interior.walls[k].slope
        } else {
            row.stiffness
        };
        if inside || row.rate(&b.x) < -row.allowed {
            for i in 0..row.len {
                for j in 0..=i {
                    let v = slope * row.coefficients[i] * row.coefficients[j];
                    S::add(p.hessian, row.first + i, row.first + j, v);
                }
            }
        }
    }
    let mut stiffness = [[[0.0; 6]; 6]; SEGMENT_COUNT];
    let mut touching = [false; SEGMENT_COUNT];
    for (k, point) in p.contacts.points.iter().enumerate() {
        let region = p.newton.region[k];
        if inside {
            let d = &p.interior.stiffness[k];
            add_point_stiffness(&mut stiffness[point.slot], point.r, d);
            touching[point.slot] = true;
        } else if region != Region::Open {
            let d = p.contacts.stiffness(k, p.newton.velocity[k], region);
            add_point_stiffness(&mut stiffness[point.slot], point.r, &d);
            touching[point.slot] = true;
        }
    }
    for (slot, s) in p.contacts.segments.iter().enumerate() {
        if touching[slot] {
            let mut kj = [[0.0; CHAIN_WIDTH]; 6];
            for a in 0..6 {
                for c in 0..6 {
                    let y = stiffness[slot][a][c];
                    for i in 0..CHAIN_WIDTH {
                        kj[a][i] += y * s.jacobian[c][i];
                    }
                }
            }
            S::add_segment(p.hessian, s, &kj);
        }
    }
}

fn factor_block<F: Articulated>(b: &mut Block, figures: &mut [F]) {
    match b.kind {
        BlockKind::Figure(i) => factor(figures[i].parts().hessian),
        BlockKind::Free(_) => factor_rows(&mut b.l, 6),
    }
}

fn solve_block<F: Articulated>(b: &Block, figures: &mut [F], x: &mut [f64; NV]) {
    match b.kind {
        BlockKind::Figure(i) => solve(figures[i].parts().hessian, x),
        BlockKind::Free(_) => solve_rows(&b.l, 6, x),
    }
}

/// Solves the symmetric positive definite system `m x = b` in place; `m[j n + i]`, i ≥ j, is its lower triangle, `x`
/// holds b. Returns false if it is not positive definite.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn cholesky_solve(m: &mut [f64], x: &mut [f64]) -> bool {
    let positive = factor_columns(m, x.len());
    if positive {
        solve_lower(m, x);
        solve_upper(m, x);
    }
    positive
}

#[cfg(test)]
pub(super) mod tests;
