//! Tree-sparse Cholesky factor of the inertia matrix: M = LᵀL, leaves first, no fill-in (Featherstone 2008, §6.5).

use super::mass_matrix::{BLOCK, CHAIN, DEPTH, MassMatrix, ROW};
use crate::body::topology::{DOF_LEN, DOF_START, NV, SEGMENT_COUNT};
use crate::math::Lane;

/// Replaces M by its factor L in place. M must be positive definite, as every validated body's is.
///
/// Works segment by segment, each from the rows of the segments that it carries. The rows of a segment stay in
/// registers until they are complete. They are updated in whole blocks, because a few superfluous products cost less
/// than loops of varying length. The elements beyond a diagonal are overwritten, and no entry depends on them.
#[inline(always)]
pub fn factor<L: Lane>(m: &mut MassMatrix<L>) {
    for (first, count, end) in COMPONENTS.into_iter().rev() {
        let range = (first, end);
        match (count, DEPTH[first + count - 1] / BLOCK) {
            (6, 0) => factor_segment::<L, 6, BLOCK>(m, range),
            (3, 1) => factor_segment::<L, 3, { 2 * BLOCK }>(m, range),
            (1, 1) => factor_segment::<L, 1, { 2 * BLOCK }>(m, range),
            (2, 2) => factor_segment::<L, 2, { 3 * BLOCK }>(m, range),
            _ => unreachable!("no segment of the tree is like that"),
        }
    }
}

/// For each segment: its first velocity component, the number of its components, and the end of the components that it
/// carries.
const COMPONENTS: [(usize, usize, usize); SEGMENT_COUNT] = {
    let mut out = [(0, 6, NV); SEGMENT_COUNT];
    let mut s = SEGMENT_COUNT - 1;
    while s > 0 {
        let (first, count) = (6 + DOF_START[s], DOF_LEN[s]);
        let mut end = first + count;
        while end < NV && CHAIN[end][DEPTH[first]] == first {
            end += 1;
        }
        out[s] = (first, count, end);
        s -= 1;
    }
    out
};

/// Computes the N rows of L of a segment, W numbers each, from the rows of the segments that it carries.
///
/// * `first`, `end`: its first component, and the end of the components that it carries.
#[inline(always)]
fn factor_segment<L: Lane, const N: usize, const W: usize>(
    m: &mut MassMatrix<L>,
    (first, end): (usize, usize),
) {
    let (own, carried) = m.rows[first..end].split_at_mut(N);
    let depth = DEPTH[first];
    let mut z = [[L::zero(); W]; N];
    for n in 0..N {
        z[n] = start_of(&own[n]);
    }
    for row in carried.iter().rev() {
        let y = start_of::<L, W>(row);
        for n in 0..N {
            let x = row[depth + n];
            for c in 0..W {
                z[n][c] -= x * y[c];
            }
        }
    }
    for n in (0..N).rev() {
        own[n][..W].copy_from_slice(&z[n]);
        let root = own[n][depth + n].sqrt();
        let inv = L::one() / root;
        for c in 0..W {
            z[n][c] *= inv;
        }
        own[n][..W].copy_from_slice(&z[n]);
        own[n][depth + n] = root;
        for k in 0..n {
            let x = own[n][depth + k];
            for c in 0..W {
                z[k][c] -= x * z[n][c];
            }
        }
    }
}

/// The first W numbers of a row.
#[inline(always)]
fn start_of<L: Lane, const W: usize>(row: &[L; ROW]) -> [L; W] {
    *row.first_chunk().expect("W ≤ ROW")
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
