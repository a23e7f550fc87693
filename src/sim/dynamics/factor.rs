//! Tree-sparse Cholesky factor of the inertia matrix: M = LᵀL, leaves first, no fill-in (Featherstone 2008, §6.5).

use super::mass_matrix::{BLOCK, CHAIN, DEPTH, MassMatrix};
use crate::sim::body::topology::NV;
use crate::sim::math::Lane;

/// Replaces M by its factor L in place. M must be positive definite, as every validated body's is.
///
/// Rows are changed in whole blocks: a few products too many cost less than loops of all lengths. What lies beyond a
/// diagonal is overwritten by them; no entry depends on it.
#[inline(always)]
pub fn factor<L: Lane>(m: &mut MassMatrix<L>) {
    for i in (0..NV).rev() {
        let depth = DEPTH[i];
        let root = m.rows[i][depth].sqrt();
        let inv = L::one() / root;
        let mut row = m.rows[i];
        for x in &mut row {
            *x *= inv;
        }
        row[depth] = root;
        m.rows[i] = row;
        let ancestors = CHAIN[i][..depth].chunks(BLOCK).zip(row.chunks(BLOCK));
        for (block, (ancestors, factors)) in ancestors.enumerate() {
            for (j, x) in ancestors.iter().zip(factors) {
                let target = &mut m.rows[*j];
                for c in 0..(block + 1) * BLOCK {
                    target[c] -= *x * row[c];
                }
            }
        }
    }
}

/// Solves `M x = b` in place with the factor of [`factor`]. O(n·depth), no allocation.
#[inline(always)]
pub fn solve<L: Lane>(l: &MassMatrix<L>, x: &mut [L; NV]) {
    for i in (0..NV).rev() {
        let y = x[i] / l.rows[i][DEPTH[i]];
        x[i] = y;
        for k in 0..DEPTH[i] {
            x[CHAIN[i][k]] -= l.rows[i][k] * y;
        }
    }
    for i in 0..NV {
        let mut y = x[i];
        for k in 0..DEPTH[i] {
            y -= l.rows[i][k] * x[CHAIN[i][k]];
        }
        x[i] = y / l.rows[i][DEPTH[i]];
    }
}
