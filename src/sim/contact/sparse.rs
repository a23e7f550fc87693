//! The kernel's matrix for the simulator: A = M; contacts and limits preserve its tree pattern.

use super::newton::System;
use super::rows::{CHAIN_WIDTH, SegmentRows};
use crate::body::topology::NV;
use crate::dynamics::factor::{factor, solve};
use crate::dynamics::mass_matrix::{BLOCK, DEPTH, MassMatrix};

/// A borrowed inertia matrix.
///
/// Problem 14.3.
pub struct SparseSystem<'a>(pub &'a MassMatrix<f64>);

impl System for SparseSystem<'_> {
    type Hessian = MassMatrix<f64>;

    #[inline(always)]
    fn mul(&self, x: &[f64; NV], y: &mut [f64; NV]) {
        self.0.mul(x, y);
    }
    #[inline(always)]
    fn load(&self, g: &mut MassMatrix<f64>) {
        g.rows = self.0.rows;
    }
    #[inline(always)]
    fn add(g: &mut MassMatrix<f64>, i: usize, j: usize, x: f64) {
        g.rows[i][DEPTH[j]] += x;
    }
    #[inline(always)]
    fn add_segment(g: &mut MassMatrix<f64>, s: &SegmentRows, kj: &[[f64; CHAIN_WIDTH]; 6]) {
        for (i, c) in s.chain().iter().enumerate() {
            let row = &mut g.rows[*c];
            for a in 0..6 {
                let y = s.jacobian[a][i];
                if y == 0.0 {
                    continue;
                }
                // Update whole blocks, as in [`factor`].
                for k in 0..(i / BLOCK + 1) * BLOCK {
                    row[k] += y * kj[a][k];
                }
            }
        }
    }
    #[inline(always)]
    fn solve(g: &mut MassMatrix<f64>, x: &mut [f64; NV]) -> bool {
        factor(g);
        solve(g, x);
        x.iter().all(|v| v.is_finite())
    }
}
