//! Tree-sparse Cholesky factor of the inertia matrix: M = LᵀL, leaves first, no fill-in (Featherstone 2008, §6.5).

use super::mass_matrix::{CHAIN, DEPTH, MassMatrix};
use crate::sim::body::topology::NV;
use crate::sim::math::Lane;

/// Replaces M by its factor L in place. M must be positive definite, as every validated body's is.
#[inline(always)]
pub fn factor<L: Lane>(m: &mut MassMatrix<L>) {
    for i in (0..NV).rev() {
        let di = DEPTH[i];
        let root = m.rows[i][di].sqrt();
        let inv = L::one() / root;
        let mut row = m.rows[i];
        row[di] = root;
        for k in 0..di {
            row[k] *= inv;
        }
        m.rows[i] = row;
        for k in 0..di {
            let x = row[k];
            let target = &mut m.rows[CHAIN[i][k]];
            for c in 0..=k {
                target[c] -= x * row[c];
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
