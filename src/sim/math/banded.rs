//! Equations along a trajectory: every row couples a sample with its neighbours, so a matrix has two bands beside its
//! diagonal.

/// Symmetric positive definite matrix with two bands above its diagonal, and after [`Self::factor`] its LDLᵀ.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pentadiagonal {
    diagonal: Vec<f64>,
    /// Elements (i, i+1) and (i, i+2).
    next: Vec<f64>,
    over: Vec<f64>,
}

impl Pentadiagonal {
    /// `diagonal` alone.
    pub fn new(diagonal: Vec<f64>) -> Self {
        let n = diagonal.len();
        Self {
            diagonal,
            next: vec![0.0; n],
            over: vec![0.0; n],
        }
    }

    /// A diagonal, and the same element next to it everywhere.
    pub fn tridiagonal(diagonal: Vec<f64>, next: f64) -> Self {
        let mut matrix = Self::new(diagonal);
        matrix.next.fill(next);
        matrix
    }

    /// Resets to `n` rows and a multiple of the identity. Allocates only when `n` exceeds every earlier size.
    pub fn reset(&mut self, n: usize, diagonal: f64) {
        for (band, value) in [
            (&mut self.diagonal, diagonal),
            (&mut self.next, 0.0),
            (&mut self.over, 0.0),
        ] {
            band.clear();
            band.resize(n, value);
        }
    }

    /// Adds `weight · rᵀr`, where the row `r` holds these elements from column `first` on. Elements outside the matrix
    /// are ignored.
    pub fn add_row(&mut self, first: isize, row: [f64; 3], weight: f64) {
        let n = self.diagonal.len() as isize;
        for (k, a) in row.into_iter().enumerate() {
            let i = first + k as isize;
            if !(0..n).contains(&i) {
                continue;
            }
            let i = i as usize;
            self.diagonal[i] += weight * a * a;
            if k < 2 && i + 1 < n as usize {
                self.next[i] += weight * a * row[k + 1];
            }
            if k < 1 && i + 2 < n as usize {
                self.over[i] += weight * a * row[k + 2];
            }
        }
    }

    /// LDLᵀ in place, O(n).
    pub fn factor(mut self) -> Factor {
        let n = self.diagonal.len();
        for i in 0..n {
            let (d, b, c) = (self.diagonal[i], self.next[i], self.over[i]);
            if i + 1 < n {
                self.diagonal[i + 1] -= b * b / d;
                self.next[i + 1] -= b * c / d;
            }
            if i + 2 < n {
                self.diagonal[i + 2] -= c * c / d;
            }
            self.next[i] = b / d;
            self.over[i] = c / d;
            self.diagonal[i] = 1.0 / d;
        }
        Factor(self)
    }
}

/// LDLᵀ of a [`Pentadiagonal`]; its diagonal inverted.
#[derive(Clone, Debug)]
pub(crate) struct Factor(Pentadiagonal);

impl Factor {
    /// Gives the buffers back for another matrix.
    pub fn into_matrix(self) -> Pentadiagonal {
        self.0
    }

    /// Solves in place for `K` right-hand sides at once, O(n).
    pub fn solve<const K: usize>(&self, x: &mut [[f64; K]]) {
        let Pentadiagonal {
            diagonal,
            next,
            over,
        } = &self.0;
        let n = x.len();
        let less = |a: &mut [f64; K], factor: f64, b: [f64; K]| {
            for (a, b) in a.iter_mut().zip(b) {
                *a -= factor * b;
            }
        };
        for i in 0..n {
            let at = x[i];
            if i + 1 < n {
                less(&mut x[i + 1], next[i], at);
            }
            if i + 2 < n {
                less(&mut x[i + 2], over[i], at);
            }
        }
        for i in (0..n).rev() {
            let mut at = x[i].map(|a| a * diagonal[i]);
            if i + 1 < n {
                less(&mut at, next[i], x[i + 1]);
            }
            if i + 2 < n {
                less(&mut at, over[i], x[i + 2]);
            }
            x[i] = at;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_its_rows_make() {
        let n = 40;
        let x: Vec<f64> = (0..n).map(|i| (f64::from(i) * 0.7).sin()).collect();
        let n = x.len();
        let diagonal: Vec<f64> = (0..n).map(|i| 1.0 + (i % 7) as f64).collect();
        let mut rhs: Vec<f64> = diagonal.iter().zip(&x).map(|(d, x)| d * x).collect();
        let mut matrix = Pentadiagonal::new(diagonal);
        for first in -1..n as isize {
            let row = [1.0, -2.0 + 0.1 * first as f64, 0.7];
            matrix.add_row(first, row, 30.0);
            let inside = |k: usize| usize::try_from(first + k as isize).ok().filter(|i| *i < n);
            let value: f64 = (0..3)
                .filter_map(|k| inside(k).map(|i| row[k] * x[i]))
                .sum();
            for k in 0..3 {
                if let Some(i) = inside(k) {
                    rhs[i] += 30.0 * row[k] * value;
                }
            }
        }
        let mut both: Vec<[f64; 2]> = rhs.iter().map(|a| [*a, -2.0 * a]).collect();
        matrix.factor().solve(&mut both);
        for (a, b) in both.iter().zip(&x) {
            assert!(
                (a[0] - b).abs() < 1e-12 && (a[1] + 2.0 * b).abs() < 2e-12,
                "{a:?} {b}"
            );
        }
    }
}
