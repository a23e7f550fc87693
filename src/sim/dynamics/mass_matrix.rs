//! The inertia matrix with the sparsity of the tree.

use crate::body::topology::{NV, VELOCITY_PARENT};
use crate::math::Lane;

/// Longest chain of velocity components from the pelvis to a hand.
pub const MAX_DEPTH: usize = 19;

/// Lanes of a vector register; inner loops of the factorisation run over whole blocks of this size.
pub const BLOCK: usize = 8;

/// Stored length of a row: [`MAX_DEPTH`] in whole blocks. Elements beyond the diagonal are never read as entries.
pub const ROW: usize = MAX_DEPTH.next_multiple_of(BLOCK);

/// Depth of each velocity component: the number of others between it and the root of the tree.
pub const DEPTH: [usize; NV] = {
    let mut out = [0; NV];
    let mut i = 0;
    while i < NV {
        if VELOCITY_PARENT[i] != usize::MAX {
            out[i] = out[VELOCITY_PARENT[i]] + 1;
        }
        i += 1;
    }
    out
};

/// `CHAIN[i][k]`: the component of depth `k` on the path from the root to component `i` (`k ≤ DEPTH[i]`).
pub const CHAIN: [[usize; MAX_DEPTH]; NV] = {
    let mut out = [[0; MAX_DEPTH]; NV];
    let mut i = 0;
    while i < NV {
        let mut j = i;
        loop {
            out[i][DEPTH[j]] = j;
            if VELOCITY_PARENT[j] == usize::MAX {
                break;
            }
            j = VELOCITY_PARENT[j];
        }
        i += 1;
    }
    out
};

/// Symmetric 45×45 matrix whose entry (i, j), j ≤ i, is nonzero only if j lies on the chain of i.
///
/// Row `i` is stored by depth, so that the rows of a chain line up and the factorisation runs over contiguous memory.
#[derive(Clone, Debug, PartialEq)]
pub struct MassMatrix<L = f64> {
    /// `rows[i][k]` is entry `(i, CHAIN[i][k])`.
    pub rows: [[L; ROW]; NV],
}

impl<L: Lane> Default for MassMatrix<L> {
    fn default() -> Self {
        Self {
            rows: [[L::zero(); ROW]; NV],
        }
    }
}

impl<L: Lane> MassMatrix<L> {
    /// Entry (i, j) in either order.
    pub fn get(&self, i: usize, j: usize) -> L {
        let (i, j) = if i >= j { (i, j) } else { (j, i) };
        if DEPTH[j] <= DEPTH[i] && CHAIN[i][DEPTH[j]] == j {
            self.rows[i][DEPTH[j]]
        } else {
            L::zero()
        }
    }

    /// `y = M x`. 2 kflop.
    #[inline(always)]
    pub fn mul(&self, x: &[L; NV], y: &mut [L; NV]) {
        for i in 0..NV {
            y[i] = self.rows[i][DEPTH[i]] * x[i];
        }
        for i in 0..NV {
            let mut z = y[i];
            for k in 0..DEPTH[i] {
                let (j, m) = (CHAIN[i][k], self.rows[i][k]);
                z += m * x[j];
                y[j] += m * x[i];
            }
            y[i] = z;
        }
    }
}

impl From<&MassMatrix<f64>> for nalgebra::DMatrix<f64> {
    fn from(m: &MassMatrix<f64>) -> Self {
        Self::from_fn(NV, NV, |i, j| m.get(i, j))
    }
}

impl MassMatrix<f64> {
    /// Writes the full symmetric matrix. Entries that are zero because of the tree, and the padding in columns 45…47,
    /// are not written: they must be zero already.
    pub fn to_dense(&self, out: &mut [[f64; 48]; NV]) {
        for i in 0..NV {
            for k in 0..=DEPTH[i] {
                let j = CHAIN[i][k];
                out[i][j] = self.rows[i][k];
                out[j][i] = self.rows[i][k];
            }
        }
    }
}
