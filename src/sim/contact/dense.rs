//! The kernel's matrix for the modern controller: A = M P⁻¹ M, dense.

use super::newton::System;
use super::rows::{CHAIN_WIDTH, SegmentRows};
use crate::sim::body::topology::NV;
use crate::sim::dynamics::terms::WIDTH;

/// A square matrix with rows padded to vector width.
pub type Dense = [[f64; WIDTH]; NV];

/// A borrowed dense symmetric matrix.
pub struct DenseSystem<'a>(pub &'a Dense);

/// Cholesky factor in place: reads the part `l[c][r]`, r ≥ c, of a symmetric matrix and leaves L there (column c of L
/// is row c).
#[inline(always)]
pub fn cholesky(l: &mut Dense) -> bool {
    for j in 0..NV {
        let d = l[j][j];
        if d.is_nan() || d <= 0.0 {
            return false;
        }
        let s = 1.0 / d.sqrt();
        let (head, tail) = l.split_at_mut(j + 1);
        let col = &mut head[j];
        for x in &mut col[j..] {
            *x *= s;
        }
        for (k, c) in tail.iter_mut().enumerate() {
            let row = j + 1 + k;
            let a = col[row];
            for i in row & !7..WIDTH {
                c[i] -= a * col[i];
            }
        }
    }
    true
}

/// `x ← L⁻¹ x`.
#[inline(always)]
pub fn solve_lower(l: &Dense, x: &mut [f64; WIDTH]) {
    for j in 0..NV {
        let y = x[j] / l[j][j];
        x[j] = y;
        for i in j + 1..WIDTH {
            x[i] -= y * l[j][i];
        }
    }
}

/// `x ← L⁻ᵀ x`.
#[inline(always)]
pub fn solve_upper(l: &Dense, x: &mut [f64; WIDTH]) {
    for j in (0..NV).rev() {
        let mut y = x[j];
        for i in j + 1..NV {
            y -= l[j][i] * x[i];
        }
        x[j] = y / l[j][j];
    }
}

impl System for DenseSystem<'_> {
    type Hessian = Dense;

    #[inline(always)]
    fn mul(&self, x: &[f64; NV], y: &mut [f64; NV]) {
        let mut z = [0.0; WIDTH];
        for (row, a) in self.0.iter().zip(x) {
            for i in 0..WIDTH {
                z[i] += a * row[i];
            }
        }
        y.copy_from_slice(&z[..NV]);
    }
    #[inline(always)]
    fn load(&self, g: &mut Dense) {
        *g = *self.0;
    }
    #[inline(always)]
    fn add(g: &mut Dense, i: usize, j: usize, x: f64) {
        g[j][i] += x; // i ≥ j: column j of the lower triangle
    }
    #[inline(always)]
    fn add_segment(g: &mut Dense, s: &SegmentRows, kj: &[[f64; CHAIN_WIDTH]; 6]) {
        let chain = s.chain();
        for (i, ci) in chain.iter().enumerate() {
            for (k, ck) in chain.iter().enumerate().take(i + 1) {
                let mut z = 0.0;
                for a in 0..6 {
                    z += s.jacobian[a][i] * kj[a][k];
                }
                g[*ck][*ci] += z;
            }
        }
    }
    #[inline(always)]
    fn solve(g: &mut Dense, x: &mut [f64; NV]) -> bool {
        if !cholesky(g) {
            return false;
        }
        let mut y = [0.0; WIDTH];
        y[..NV].copy_from_slice(x);
        solve_lower(g, &mut y);
        solve_upper(g, &mut y);
        x.copy_from_slice(&y[..NV]);
        true
    }
}
