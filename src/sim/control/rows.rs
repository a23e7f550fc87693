//! Rows of 39 joint components and their orthogonal factor: the algebra of the two active sets, without allocation and
//! with sums in a fixed order.

use crate::body::DOF_COUNT;
use crate::math::dense::cholesky_solve;

/// Joint components padded to a multiple of 8 (with zeros).
pub const ROW: usize = 40;
/// One padded row.
pub type JointRow = [f64; ROW];
/// A matrix with one row per DOF.
pub type Square = [JointRow; DOF_COUNT];

/// Diagonal entries of R below this part of the largest count as dependent rows.
const DEPENDENT: f64 = 1e-10;
/// Damping of dependent rows, relative to the trace.
const DAMPING: f64 = 1e-12;

/// Scalar product. Eight partial sums in a fixed order: the same bits on every instruction set.
#[inline(always)]
pub fn dot(a: &JointRow, b: &JointRow) -> f64 {
    let mut s = [0.0; 8];
    for i in 0..ROW / 8 {
        for k in 0..8 {
            s[k] += a[8 * i + k] * b[8 * i + k];
        }
    }
    ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]))
}

/// `y += s x`.
#[inline(always)]
pub fn add_scaled(y: &mut JointRow, s: f64, x: &JointRow) {
    for k in 0..ROW {
        y[k] += s * x[k];
    }
}

/// Rows of joint components as a padded row.
#[inline(always)]
pub fn padded(a: &[f64; DOF_COUNT]) -> JointRow {
    let mut r = [0.0; ROW];
    r[..DOF_COUNT].copy_from_slice(a);
    r
}

/// Householder QR of `Aᵀ` for rows of A that arrive one after another (an active set that only grows).
///
/// Rows are scaled to unit length. With Aᵀ = Q R the least-norm solution of `A x = t` is Q R⁻ᵀ t; the normal matrix,
/// whose condition is squared, is formed only for dependent rows.
#[derive(Clone, Debug)]
pub struct RowQr {
    len: usize,
    rows: Box<Square>,    // scaled rows of A
    scale: [f64; ROW],    // 1/length
    reflect: Box<Square>, // Householder vectors
    beta: [f64; ROW],     // 2/|v|²
    r: Box<Square>,       // r[k][i] = R_ik, i ≤ k
    gram: Box<Square>,    // only for dependent rows
}

impl Default for RowQr {
    fn default() -> Self {
        let z = || Box::new([[0.0; ROW]; DOF_COUNT]);
        Self {
            len: 0,
            rows: z(),
            scale: [0.0; ROW],
            reflect: z(),
            beta: [0.0; ROW],
            r: z(),
            gram: z(),
        }
    }
}

impl RowQr {
    /// Forgets all rows.
    pub fn clear(&mut self) {
        self.len = 0;
    }
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.len
    }
    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Appends a row of A. At most 39. O(39·len).
    #[inline(always)]
    pub fn push(&mut self, row: &JointRow) {
        assert!(self.len < DOF_COUNT, "more rows than joint components");
        let k = self.len;
        let length = dot(row, row).sqrt();
        let scale = if length > 1e-300 { 1.0 / length } else { 1.0 };
        let mut u = row.map(|x| x * scale);
        self.rows[k] = u;
        self.scale[k] = scale;
        for i in 0..k {
            let s = self.beta[i] * dot(&self.reflect[i], &u);
            add_scaled(&mut u, -s, &self.reflect[i]);
        }
        self.r[k][..k].copy_from_slice(&u[..k]);
        u[..k].fill(0.0);
        let sigma = dot(&u, &u).sqrt();
        let alpha = if u[k] > 0.0 { -sigma } else { sigma };
        u[k] -= alpha;
        let v2 = dot(&u, &u);
        self.beta[k] = if v2 > 0.0 { 2.0 / v2 } else { 0.0 };
        self.r[k][k] = alpha;
        self.reflect[k] = u;
        self.len += 1;
    }

    /// Takes in the rows `members[first..]` of `h`; those before them are already in. The rows `held` come before all
    /// of them while there is room: when there is none left, it starts over without them. `fixed` of them are in;
    /// returns how many are in afterwards.
    #[inline(always)]
    pub fn grow(
        &mut self,
        h: &Square,
        members: &[usize],
        first: usize,
        held: &[JointRow],
        mut fixed: usize,
    ) -> usize {
        let k = members.len();
        if first == 0 && held.len() + k < DOF_COUNT {
            held.iter().for_each(|r| self.push(r));
            fixed = held.len();
        }
        if fixed > 0 && fixed + k >= DOF_COUNT {
            self.clear();
            fixed = 0;
            members[..first].iter().for_each(|&j| self.push(&h[j]));
        }
        members[first..].iter().for_each(|&j| self.push(&h[j]));
        fixed
    }

    /// Whether the rows are (nearly) dependent; then [`Self::solve`] is damped.
    pub fn is_dependent(&self) -> bool {
        let (mut least, mut most) = (f64::INFINITY, 0.0f64);
        for k in 0..self.len {
            least = least.min(self.r[k][k].abs());
            most = most.max(self.r[k][k].abs());
        }
        self.len > 0 && (least.is_nan() || least <= DEPENDENT * most)
    }

    /// Least-norm `x` with `A x = t`; damped least squares if the rows are dependent. `t` has one entry per row.
    #[inline(always)]
    pub fn solve(&mut self, t: &[f64], x: &mut JointRow) {
        let n = self.len;
        assert_eq!(t.len(), n);
        *x = [0.0; ROW];
        if self.is_dependent() {
            self.solve_damped(t, x);
            return;
        }
        for k in 0..n {
            let mut y = t[k] * self.scale[k];
            for i in 0..k {
                y -= self.r[k][i] * x[i];
            }
            x[k] = y / self.r[k][k];
        }
        self.apply_q(x);
    }

    /// Removes from `x` its part in the row space: `x − A⁺A x`.
    #[inline(always)]
    pub fn project_out(&self, x: &mut JointRow) {
        for i in 0..self.len {
            let s = self.beta[i] * dot(&self.reflect[i], x);
            add_scaled(x, -s, &self.reflect[i]);
        }
        x[..self.len].fill(0.0);
        self.apply_q(x);
    }

    #[inline(always)]
    fn apply_q(&self, x: &mut JointRow) {
        for i in (0..self.len).rev() {
            let s = self.beta[i] * dot(&self.reflect[i], x);
            add_scaled(x, -s, &self.reflect[i]);
        }
    }

    fn solve_damped(&mut self, t: &[f64], x: &mut JointRow) {
        let n = self.len;
        for i in 0..n {
            for j in 0..=i {
                self.gram[i][j] = dot(&self.rows[i], &self.rows[j]);
            }
            self.gram[i][i] += DAMPING * n as f64; // unit rows: the trace is n
        }
        let mut y = [0.0; ROW];
        for i in 0..n {
            y[i] = t[i] * self.scale[i];
        }
        cholesky_solve(&mut self.gram[..], n, &mut y);
        for i in 0..n {
            add_scaled(x, y[i], &self.rows[i]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::support::testing::Rng;
    use nalgebra::{DMatrix, DVector};

    fn random_row(rng: &mut Rng) -> JointRow {
        let mut r = [0.0; ROW];
        (0..DOF_COUNT).for_each(|i| r[i] = rng.unit() * 10f64.powf(2.0 * rng.unit()));
        r
    }

    #[test]
    fn least_norm_solution_and_projection_equal_the_svd_pseudo_inverse() {
        let mut rng = Rng::new(1);
        for k in [1, 2, 5, 17, 38, 39] {
            let rows: Vec<JointRow> = (0..k).map(|_| random_row(&mut rng)).collect();
            let t: Vec<f64> = (0..k).map(|_| 100.0 * rng.unit()).collect();
            let mut qr = RowQr::default();
            rows.iter().for_each(|r| qr.push(r));
            assert!(!qr.is_dependent());
            let mut x = [0.0; ROW];
            qr.solve(&t, &mut x);
            let a = DMatrix::from_fn(k, DOF_COUNT, |i, j| rows[i][j]);
            let pinv = a.clone().pseudo_inverse(1e-12).unwrap();
            let oracle = &pinv * DVector::from_vec(t);
            let scale = oracle.norm().max(1.0);
            for j in 0..DOF_COUNT {
                assert!((x[j] - oracle[j]).abs() < 1e-8 * scale, "k = {k}");
            }
            let v = random_row(&mut rng);
            let mut p = v;
            qr.project_out(&mut p);
            let v0 = DVector::from_fn(DOF_COUNT, |j, _| v[j]);
            let oracle = &v0 - &pinv * (&a * &v0);
            for j in 0..DOF_COUNT {
                assert!((p[j] - oracle[j]).abs() < 1e-9 * v0.norm(), "k = {k}");
            }
            if k == DOF_COUNT {
                assert!(p.iter().all(|x| *x == 0.0));
            }
        }
    }

    #[test]
    fn dependent_rows_are_damped_and_still_consistent() {
        let mut rng = Rng::new(2);
        let (a, b) = (random_row(&mut rng), random_row(&mut rng));
        let mut qr = RowQr::default();
        qr.push(&a);
        qr.push(&b);
        qr.push(&a.map(|x| 2.0 * x));
        assert!(qr.is_dependent());
        let mut x = [0.0; ROW];
        qr.solve(&[1.0, -2.0, 2.0], &mut x);
        assert!((dot(&a, &x) - 1.0).abs() < 1e-6 && (dot(&b, &x) + 2.0).abs() < 1e-6);
        let mut qr = RowQr::default();
        qr.push(&[0.0; ROW]);
        assert!(qr.is_dependent());
        qr.solve(&[1.0], &mut x);
        assert!(x.iter().all(|v| v.is_finite()));
    }
}
