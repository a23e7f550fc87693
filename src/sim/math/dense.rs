//! Small dense linear systems without allocation and with a fixed order of operations.
//!
//! There are two Cholesky factorisations, because a tick's bits depend on the order of sums: by rows for a few rows, by
//! columns for vector units. The tree-sparse factorisation of the inertia matrix is `dynamics::factor`, that of a
//! body's root over lanes is in `dynamics::aba`, and equations along a trajectory are [`super::banded`].

use crate::math::{Mat3, Vec3, vec3::vec3};

/// `s − Σ aᵢ bᵢ`, product by product.
#[inline(always)]
fn less_each(s: f64, a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(s, |s, (a, b)| s - a * b)
}

/// `s − (Σ aᵢ bᵢ)`.
#[inline(always)]
fn less_sum(s: f64, a: &[f64], b: &[f64]) -> f64 {
    s - a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>()
}

/// Cholesky factor L of the leading `n`×`n` block, in place: row i of `a` becomes row i of L up to its diagonal. A
/// pivot that rounding made non-positive is treated as infinitely stiff.
#[inline(always)]
fn factor_rows_with<const W: usize>(
    a: &mut [[f64; W]],
    n: usize,
    less: impl Fn(f64, &[f64], &[f64]) -> f64,
) {
    for i in 0..n {
        let (above, below) = a.split_at_mut(i);
        let row = &mut below[0];
        for (j, other) in above.iter().enumerate() {
            let s = less(row[j], &row[..j], &other[..j]);
            row[j] = if other[j].is_finite() {
                s / other[j]
            } else {
                0.0
            };
        }
        let s = less(row[i], &row[..i], &row[..i]);
        row[i] = if s > 0.0 { s.sqrt() } else { f64::INFINITY };
    }
}

/// `x ← L⁻¹ x` with the factor by rows.
#[inline(always)]
fn solve_rows_lower<const W: usize>(
    l: &[[f64; W]],
    n: usize,
    x: &mut [f64],
    less: impl Fn(f64, &[f64], &[f64]) -> f64,
) {
    for i in 0..n {
        x[i] = less(x[i], &l[i][..i], &x[..i]) / l[i][i];
    }
}

/// Cholesky factor L of the leading `n`×`n` block of a symmetric positive definite matrix, in place: the lower triangle
/// is read, row i becomes row i of L. A pivot that rounding made non-positive is treated as infinitely stiff.
#[inline(always)]
pub fn factor_rows<const W: usize>(a: &mut [[f64; W]], n: usize) {
    factor_rows_with(a, n, less_each);
}

/// Solves L Lᵀ x = b in place with the factor of [`factor_rows`]; `x` holds b.
#[inline(always)]
pub fn solve_rows<const W: usize>(l: &[[f64; W]], n: usize, x: &mut [f64]) {
    solve_rows_lower(l, n, x, less_each);
    for i in (0..n).rev() {
        let mut s = x[i];
        for k in i + 1..n {
            s -= l[k][i] * x[k];
        }
        x[i] = s / l[i][i];
    }
}

/// Solves the leading `n`×`n` block of a symmetric positive definite matrix (lower triangle given, overwritten by its
/// factor); `x` holds the right-hand side.
#[inline(always)]
pub fn cholesky_solve<const W: usize>(a: &mut [[f64; W]], n: usize, x: &mut [f64]) {
    factor_rows(a, n);
    solve_rows(a, n, x);
}

/// [`cholesky_solve`] of a whole matrix with every inner product summed before it is subtracted, which may use vector
/// registers, and the back substitution by rows of L: for systems of 45 unknowns.
pub fn cholesky_solve_summed<const N: usize>(a: &mut [[f64; N]; N], x: &mut [f64; N]) {
    factor_rows_with(a, N, less_sum);
    solve_rows_lower(a, N, x, less_sum);
    for i in (0..N).rev() {
        x[i] /= a[i][i];
        let xi = x[i];
        for (x, a) in x[..i].iter_mut().zip(&a[i][..i]) {
            *x -= a * xi;
        }
    }
}

/// Length of a row of the matrices of a whole body: 45 numbers, padded for vector registers.
pub const WIDTH: usize = 48;

/// Cholesky factor of a symmetric positive definite matrix by columns, in place: `m[j stride + i]`, i ≥ j, is read and
/// becomes column j of L; the other elements are overwritten. Returns false if the matrix is not positive definite.
/// Runs of zeros cost nothing.
///
/// * `stride`: length of a row; columns beyond the number of rows are padding, for vector registers.
#[inline(always)]
pub fn factor_columns(m: &mut [f64], stride: usize) -> bool {
    for j in 0..m.len() / stride {
        let (head, tail) = m.split_at_mut((j + 1) * stride);
        let column = &mut head[j * stride..];
        let d = column[j];
        if d.is_nan() || d <= 0.0 {
            return false;
        }
        let s = 1.0 / d.sqrt();
        for z in &mut column[j..] {
            *z *= s;
        }
        for (k, other) in tail.chunks_exact_mut(stride).enumerate() {
            let row = j + 1 + k;
            let a = column[row];
            if a == 0.0 {
                continue;
            }
            // Start at a multiple of eight so that loads are aligned. Elements before the diagonal are never read.
            let from = row & !7;
            for (z, y) in other[from..].iter_mut().zip(&column[from..]) {
                *z -= a * y;
            }
        }
    }
    true
}

/// Calls `$f::<LENGTH>`, where LENGTH is the rest of a row from the block of eight that contains column `$j`. Loops of
/// a known length stay in registers.
macro_rules! from_block_of {
    ($j:expr, $f:ident($($x:expr),*)) => {
        match $j / 8 {
            0 => $f::<48>($($x),*),
            1 => $f::<40>($($x),*),
            2 => $f::<32>($($x),*),
            3 => $f::<24>($($x),*),
            4 => $f::<16>($($x),*),
            _ => $f::<8>($($x),*),
        }
    };
}

/// [`factor_columns`] of a matrix of a whole body, column by column from those before it: the same sums in the same
/// order, but without a round trip to memory for each product.
#[inline(always)]
pub fn factor_body_columns<const N: usize>(m: &mut [[f64; WIDTH]; N]) -> bool {
    // A loop rather than `all`: the closure would be compiled separately, without the caller's vector instructions.
    for j in 0..N {
        if !from_block_of!(j, factor_column(m, j)) {
            return false;
        }
    }
    true
}

/// Column `j` of [`factor_body_columns`], from the block of its diagonal on.
#[inline(always)]
fn factor_column<const LENGTH: usize>(m: &mut [[f64; WIDTH]], j: usize) -> bool {
    let from = WIDTH - LENGTH;
    let (before, rest) = m.split_at_mut(j);
    let mut z = rest_of::<LENGTH>(&rest[0]);
    for column in before.iter() {
        let (a, y) = (column[j], rest_of::<LENGTH>(column));
        for (z, y) in z.iter_mut().zip(y) {
            *z -= a * y;
        }
    }
    let d = z[j - from];
    if d.is_nan() || d <= 0.0 {
        return false;
    }
    let s = 1.0 / d.sqrt();
    for (x, z) in rest[0][from..].iter_mut().zip(z) {
        *x = z * s;
    }
    true
}

/// The last LENGTH numbers of a row.
#[inline(always)]
fn rest_of<const LENGTH: usize>(row: &[f64; WIDTH]) -> [f64; LENGTH] {
    *row.last_chunk().expect("LENGTH ≤ WIDTH")
}

/// Elements of each row that [`solve_lower_rows`] keeps in registers at a time, for three rows.
const TILE: usize = 16;

/// `Y = L⁻¹ M` with the factor of [`factor_body_columns`]: three rows at a time from those before them, in tiles that
/// stay in registers.
#[inline(always)]
pub fn solve_lower_rows<const N: usize>(
    l: &[[f64; WIDTH]; N],
    m: &[[f64; WIDTH]; N],
    y: &mut [[f64; WIDTH]; N],
) {
    const { assert!(N.is_multiple_of(3) && WIDTH.is_multiple_of(TILE)) };
    for j in (0..N).step_by(3) {
        for from in (0..WIDTH).step_by(TILE) {
            solve_tile(l, &m[j..], y, (j, from));
        }
    }
}

/// Columns from `from` on of rows `j` to `j + 2` of [`solve_lower_rows`], given the rows of M from `j` on.
#[inline(always)]
fn solve_tile(
    l: &[[f64; WIDTH]],
    m: &[[f64; WIDTH]],
    y: &mut [[f64; WIDTH]],
    (j, from): (usize, usize),
) {
    let (before, rest) = y.split_at_mut(j);
    let (mut z0, mut z1, mut z2) = (
        tile_of(&m[0], from),
        tile_of(&m[1], from),
        tile_of(&m[2], from),
    );
    for (column, row) in l.iter().zip(before.iter()) {
        let (a0, a1, a2) = (column[j], column[j + 1], column[j + 2]);
        let x = tile_of(row, from);
        for k in 0..TILE {
            z0[k] -= a0 * x[k];
            z1[k] -= a1 * x[k];
            z2[k] -= a2 * x[k];
        }
    }
    let (l0, l1) = (&l[j], &l[j + 1]);
    let (s0, s1, s2) = (1.0 / l0[j], 1.0 / l1[j + 1], 1.0 / l[j + 2][j + 2]);
    for k in 0..TILE {
        z0[k] *= s0;
        z1[k] = (z1[k] - l0[j + 1] * z0[k]) * s1;
        z2[k] = (z2[k] - l0[j + 2] * z0[k] - l1[j + 2] * z1[k]) * s2;
    }
    for (row, z) in rest.iter_mut().zip([z0, z1, z2]) {
        row[from..from + TILE].copy_from_slice(&z);
    }
}

/// [`TILE`] numbers of a row.
#[inline(always)]
fn tile_of(row: &[f64; WIDTH], from: usize) -> [f64; TILE] {
    *row[from..].first_chunk().expect("tiles fill a row")
}

/// Lower triangle of `D + Σ w r rᵀ` by columns, as [`factor_body_columns`] reads it; the upper triangle may hold
/// anything.
///
/// * `diagonal`: D.
/// * `rows`: w and r of each term.
#[inline(always)]
pub fn weighted_gram<'a, const N: usize>(
    diagonal: &[f64; N],
    rows: impl Iterator<Item = (f64, &'a [f64; WIDTH])> + Clone,
    m: &mut [[f64; WIDTH]; N],
) {
    for (j, column) in m.iter_mut().enumerate() {
        from_block_of!(j, gram_column(column, (j, diagonal[j]), rows.clone()));
    }
}

/// Column `j` of [`weighted_gram`], from the block of its diagonal on, given `j` and its entry of D.
#[inline(always)]
fn gram_column<'a, const LENGTH: usize>(
    column: &mut [f64; WIDTH],
    (j, diagonal): (usize, f64),
    rows: impl Iterator<Item = (f64, &'a [f64; WIDTH])>,
) {
    column[j & !7..].fill(0.0);
    column[j] = diagonal;
    let mut z = rest_of::<LENGTH>(column);
    for (weight, row) in rows {
        let (a, y) = (weight * row[j], rest_of::<LENGTH>(row));
        if a != 0.0 {
            for (z, y) in z.iter_mut().zip(y) {
                *z += a * y;
            }
        }
    }
    column[WIDTH - LENGTH..].copy_from_slice(&z);
}

/// `A = YᵀY`, three rows at a time from the block of their diagonal on; the rest is its mirror image.
#[inline(always)]
pub fn gram_of_columns<const N: usize>(y: &[[f64; WIDTH]; N], a: &mut [[f64; WIDTH]; N]) {
    const { assert!(N.is_multiple_of(3) && N <= WIDTH) };
    for i in (0..N).step_by(3) {
        from_block_of!(i, gram_rows(y, a, i));
    }
    for i in 0..N {
        for k in 0..i {
            a[i][k] = a[k][i];
        }
    }
}

/// Rows `i` to `i + 2` of [`gram_of_columns`].
#[inline(always)]
fn gram_rows<const LENGTH: usize>(y: &[[f64; WIDTH]], a: &mut [[f64; WIDTH]], i: usize) {
    let mut sum = [[0.0; LENGTH]; 3];
    for row in y {
        let (a0, a1, a2) = (row[i], row[i + 1], row[i + 2]);
        let x = rest_of::<LENGTH>(row);
        for k in 0..LENGTH {
            sum[0][k] += a0 * x[k];
            sum[1][k] += a1 * x[k];
            sum[2][k] += a2 * x[k];
        }
    }
    for (row, sum) in a[i..i + 3].iter_mut().zip(sum) {
        row[WIDTH - LENGTH..].copy_from_slice(&sum);
    }
}

/// `x ← L⁻¹ x` with the factor by columns, whose rows are as long as `x`.
#[inline(always)]
pub fn solve_lower(l: &[f64], x: &mut [f64]) {
    for (j, column) in l.chunks_exact(x.len()).enumerate() {
        let y = x[j] / column[j];
        x[j] = y;
        for (z, l) in x[j + 1..].iter_mut().zip(&column[j + 1..]) {
            *z -= y * l;
        }
    }
}

/// `x ← L⁻ᵀ x` with the factor by columns, whose rows are as long as `x`.
#[inline(always)]
pub fn solve_upper(l: &[f64], x: &mut [f64]) {
    let n = l.len() / x.len();
    for (j, column) in l.chunks_exact(x.len()).enumerate().rev() {
        x[j] = less_each(x[j], &column[j + 1..n], &x[j + 1..n]) / column[j];
    }
}

/// Solves the leading `n`×`n` system `a x = b` by elimination with row pivoting; `a` and `b` are overwritten, `b`
/// becomes x. Returns false if the matrix is singular to rounding (then `b` is not a solution).
#[inline(always)]
pub fn eliminate<const W: usize>(a: &mut [[f64; W]], n: usize, b: &mut [f64]) -> bool {
    let mut largest = 0.0f64;
    for k in 0..n {
        let mut p = k;
        for i in k + 1..n {
            if a[i][k].abs() > a[p][k].abs() {
                p = i;
            }
        }
        a.swap(k, p);
        b.swap(k, p);
        let pivot = a[k][k].abs();
        largest = largest.max(pivot);
        if pivot.is_nan() || pivot <= 1e-14 * largest {
            return false;
        }
        let row = a[k];
        for i in k + 1..n {
            let f = a[i][k] / row[k];
            if f != 0.0 {
                for (z, y) in a[i].iter_mut().zip(&row) {
                    *z += -f * y;
                }
                b[i] -= f * b[k];
            }
        }
    }
    for k in (0..n).rev() {
        b[k] = less_each(b[k], &a[k][k + 1..n], &b[k + 1..n]) / a[k][k];
    }
    true
}

/// Solves the leading `n`×`n` block (n = 1 or 2) of a positive definite system.
pub fn solve_up_to_2(g: &[[f64; 2]; 2], b: [f64; 2], n: usize) -> [f64; 2] {
    if n == 1 {
        return [b[0] / g[0][0], 0.0];
    }
    let det = g[0][0] * g[1][1] - g[0][1] * g[1][0];
    [
        (b[0] * g[1][1] - b[1] * g[0][1]) / det,
        (b[1] * g[0][0] - b[0] * g[1][0]) / det,
    ]
}

/// Solves three rows (Cramer); `None` if they are dependent.
pub fn solve_3(rows: &[Vec3; 3], b: [f64; 3]) -> Option<Vec3> {
    let m = Mat3 {
        x: rows[1].cross(rows[2]),
        y: rows[2].cross(rows[0]),
        z: rows[0].cross(rows[1]),
    };
    let det = rows[0].dot(m.x);
    (det.abs() > 1e-9).then(|| (m * vec3(b[0], b[1], b[2])) * (1.0 / det))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{SMatrix, SVector};
    use rand::{Rng, SeedableRng};
    use rand_pcg::Pcg64;

    const N: usize = 13;

    /// A positive definite matrix, a right-hand side and the solution that nalgebra finds.
    fn problem(random: &mut Pcg64) -> (SMatrix<f64, N, N>, SVector<f64, N>, SVector<f64, N>) {
        let b = SMatrix::<f64, N, N>::from_fn(|_, _| random.random_range(-1.0..1.0));
        let m = b * b.transpose() + SMatrix::identity() * 0.1;
        let rhs = SVector::from_fn(|_, _| random.random_range(-1.0..1.0));
        (m, rhs, m.lu().solve(&rhs).expect("positive definite"))
    }

    #[test]
    fn every_solver_finds_the_solution_of_nalgebra() {
        let mut random = Pcg64::seed_from_u64(9);
        for _ in 0..50 {
            let (m, b, x) = problem(&mut random);
            let close = |found: &[f64]| {
                for (a, b) in found.iter().zip(&x) {
                    assert!((a - b).abs() < 1e-9 * x.norm(), "{found:?} {x:?}");
                }
            };
            let a: [[f64; N]; N] = std::array::from_fn(|i| std::array::from_fn(|j| m[(i, j)]));
            let b: [f64; N] = b.into();
            let (mut l, mut found) = (a, b);
            cholesky_solve(&mut l, N, &mut found);
            close(&found);
            let (mut l, mut found) = (a, b);
            cholesky_solve_summed(&mut l, &mut found);
            close(&found);
            let (mut l, mut found) = (a, b);
            assert!(eliminate(&mut l, N, &mut found));
            close(&found);
            let mut l = [[0.0; 16]; N];
            let mut found = [0.0; 16];
            (0..N).for_each(|i| l[i][..N].copy_from_slice(&a[i]));
            found[..N].copy_from_slice(&b);
            assert!(factor_columns(l.as_flattened_mut(), 16));
            solve_lower(l.as_flattened(), &mut found);
            solve_upper(l.as_flattened(), &mut found);
            close(&found[..N]);
        }
    }

    #[test]
    fn matrices_of_a_body_are_factored_bit_for_bit_as_others_are() {
        const N: usize = 45;
        let mut random = Pcg64::seed_from_u64(10);
        let y: [[f64; WIDTH]; N] = std::array::from_fn(|_| {
            std::array::from_fn(|j| {
                if j < N {
                    random.random_range(-1.0..1.0)
                } else {
                    0.0
                }
            })
        });
        let mut a = [[0.0; WIDTH]; N];
        gram_of_columns(&y, &mut a);
        let dense = SMatrix::<f64, N, N>::from_fn(|i, j| y[i][j]);
        let gram = dense.transpose() * dense;
        for i in 0..N {
            for j in 0..N {
                assert!((a[i][j] - gram[(i, j)]).abs() < 1e-12 && a[i][j] == a[j][i]);
            }
            a[i][i] += 0.1;
        }
        let (mut l, mut other) = (a, a);
        assert!(factor_body_columns(&mut l));
        assert!(factor_columns(other.as_flattened_mut(), WIDTH));
        let lower = |l: &[[f64; WIDTH]; N]| -> Vec<u64> {
            (0..N)
                .flat_map(|j| (j..N).map(move |i| (i, j)))
                .map(|(i, j)| l[j][i].to_bits())
                .collect()
        };
        assert_eq!(lower(&l), lower(&other));
        let mut solved = [[f64::NAN; WIDTH]; N];
        solve_lower_rows(&l, &y, &mut solved);
        for j in 0..N {
            let mut column: [f64; WIDTH] =
                std::array::from_fn(|i| if i < N { y[i][j] } else { 0.0 });
            solve_lower(l.as_flattened(), &mut column);
            for i in 0..N {
                assert!((solved[i][j] - column[i]).abs() < 1e-9 * column[i].abs().max(1.0));
            }
        }
        a[30][30] = -1.0;
        assert!(!factor_body_columns(&mut a));
    }

    #[test]
    fn closed_forms_solve_their_systems() {
        let g = [[2.0, 0.5], [0.5, 3.0]];
        let x = solve_up_to_2(&g, [1.0, -2.0], 2);
        assert!((g[0][0] * x[0] + g[0][1] * x[1] - 1.0).abs() < 1e-15);
        assert!((g[1][0] * x[0] + g[1][1] * x[1] + 2.0).abs() < 1e-15);
        assert_eq!(solve_up_to_2(&g, [1.0, 9.0], 1), [0.5, 0.0]);
        let rows = [
            vec3(1.0, 2.0, 0.0),
            vec3(0.0, 1.0, -1.0),
            vec3(3.0, 0.0, 1.0),
        ];
        let x = solve_3(&rows, [1.0, 2.0, 3.0]).expect("independent");
        for (row, b) in rows.iter().zip([1.0, 2.0, 3.0]) {
            assert!((row.dot(x) - b).abs() < 1e-14);
        }
        assert!(solve_3(&[Vec3::X, Vec3::Y, Vec3::X + Vec3::Y], [0.0; 3]).is_none());
    }

    #[test]
    fn what_cannot_be_solved_is_reported() {
        let mut a = [[1.0; 3]; 3];
        assert!(!eliminate(&mut a, 3, &mut [1.0; 3]));
        assert!(!factor_columns(&mut [1.0, 2.0, 2.0, 1.0], 2));
        let mut x = [1.0, 1.0];
        cholesky_solve(&mut [[1.0, 0.0], [1.0, 1.0]], 2, &mut x);
        assert!(
            x.iter().all(|x| x.is_finite()),
            "a dependent row does not move"
        );
    }
}
