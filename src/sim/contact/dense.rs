//! The kernel's matrix for the modern controller: A = M P⁻¹ M, dense.

use super::newton::System;
use super::rows::{CHAIN_WIDTH, SegmentRows};
use crate::body::topology::NV;
use crate::dynamics::terms::WIDTH;
use crate::math::dense::{factor_body_columns, solve_lower, solve_upper};

/// A square matrix with rows padded to vector width.
pub type Dense = [[f64; WIDTH]; NV];

/// A borrowed dense symmetric matrix.
///
/// Problem 14.2.
pub struct DenseSystem<'a>(pub &'a Dense);

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
        if !factor_body_columns(g) {
            return false;
        }
        let mut y = [0.0; WIDTH];
        y[..NV].copy_from_slice(x);
        solve_lower(g.as_flattened(), &mut y);
        solve_upper(g.as_flattened(), &mut y);
        x.copy_from_slice(&y[..NV]);
        true
    }
}
