//! Least squares with unknowns that are not negative: forces that only push.

/// Upper bound on rounds; each adds the unknown that helps most. The cones of a few contacts need far fewer.
const ROUNDS: usize = 60;
/// A gain below this counts as no improvement, in the units of `b` squared.
const TOLERANCE: f64 = 1e-9;
/// An unknown below this leaves the active set.
const GONE: f64 = 1e-14;

/// The `x ≥ 0` that makes `‖A x − b‖² + ridge ‖x‖²` least (Lawson & Hanson 1974, ch. 23, on the normal equations).
///
/// * `columns`: those of A, R rows each.
/// * `ridge`: > 0 keeps the normal equations solvable where columns depend on each other.
///
/// O(rounds × columns × R); allocates.
pub fn nnls<const R: usize>(columns: &[[f64; R]], b: &[f64; R], ridge: f64) -> Vec<f64> {
    let n = columns.len();
    let mut x = vec![0.0; n];
    // `gain[k]`: how much the cost falls with x_k; `gram[i]`: products of active column i with all columns.
    let pull: Vec<f64> = columns.iter().map(|c| dot(c, b)).collect();
    let mut gain = pull.clone();
    let mut active: Vec<usize> = Vec::new();
    let mut gram: Vec<Vec<f64>> = Vec::new();
    let mut is_active = vec![false; n];
    for _ in 0..ROUNDS {
        let best = (0..n)
            .filter(|k| !is_active[*k])
            .max_by(|a, b| gain[*a].total_cmp(&gain[*b]));
        match best {
            Some(k) if gain[k] > TOLERANCE => {
                active.push(k);
                is_active[k] = true;
                gram.push(columns.iter().map(|c| dot(c, &columns[k])).collect());
            }
            _ => break,
        }
        while !active.is_empty() {
            let z = solve(&active, &gram, &pull, ridge);
            // The longest step that keeps all unknowns positive. An unknown that would turn negative leaves the active
            // set.
            let step = (0..active.len())
                .filter(|i| z[*i] <= 0.0)
                .map(|i| x[active[i]] / (x[active[i]] - z[i]).max(1e-300))
                .fold(1.0, f64::min);
            for (i, &k) in active.iter().enumerate() {
                x[k] += step * (z[i] - x[k]);
            }
            if step >= 1.0 {
                break;
            }
            let mut i = 0;
            while i < active.len() {
                let k = active[i];
                if x[k] > GONE {
                    i += 1;
                } else {
                    x[k] = 0.0;
                    is_active[k] = false;
                    active.remove(i);
                    gram.remove(i);
                }
            }
        }
        gain.copy_from_slice(&pull);
        for (row, &k) in gram.iter().zip(&active) {
            for (g, product) in gain.iter_mut().zip(row) {
                *g -= product * x[k];
            }
        }
    }
    x
}

fn dot<const R: usize>(a: &[f64; R], b: &[f64; R]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The unconstrained solution over the active columns, by elimination of a positive definite system whose size is known
/// only at run time. `dense::cholesky_solve` rounds differently, which would change the seventh digit of a survey.
fn solve(active: &[usize], gram: &[Vec<f64>], pull: &[f64], ridge: f64) -> Vec<f64> {
    let m = active.len();
    let mut a = vec![0.0; m * (m + 1)];
    for i in 0..m {
        for j in 0..m {
            a[i * (m + 1) + j] = gram[i][active[j]];
        }
        a[i * (m + 1) + i] += ridge;
        a[i * (m + 1) + m] = pull[active[i]];
    }
    for k in 0..m {
        for i in k + 1..m {
            let w = a[i * (m + 1) + k] / a[k * (m + 1) + k];
            for j in k..=m {
                a[i * (m + 1) + j] -= w * a[k * (m + 1) + j];
            }
        }
    }
    let mut x = vec![0.0; m];
    for i in (0..m).rev() {
        let row = &a[i * (m + 1)..(i + 1) * (m + 1)];
        let known: f64 = (i + 1..m).map(|j| row[j] * x[j]).sum();
        x[i] = (row[m] - known) / row[i];
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_can_be_reached_is_reached() {
        let columns = [[1.0, 0.0, 1.0], [0.0, 1.0, 1.0], [0.0, 0.0, 1.0]];
        let x = nnls(&columns, &[2.0, 3.0, 9.0], 1e-12);
        for (got, want) in x.iter().zip([2.0, 3.0, 4.0]) {
            assert!((got - want).abs() < 1e-9, "{x:?}");
        }
    }

    #[test]
    fn what_would_have_to_pull_stays_zero() {
        let x = nnls(&[[1.0, 0.0], [0.0, 1.0]], &[-1.0, 2.0], 1e-12);
        assert_eq!(x[0], 0.0);
        assert!((x[1] - 2.0).abs() < 1e-9);
        assert!(nnls::<2>(&[], &[1.0, 1.0], 1e-12).is_empty());
    }

    proptest! {
        /// Karush–Kuhn–Tucker: no unknown is negative, the gradient of a zero unknown is not positive, and the gradient
        /// of a positive unknown is zero.
        #[test]
        fn the_conditions_of_optimality_hold(
            values in prop::collection::vec(-1.0f64..1.0, 6 * 12),
            b in prop::array::uniform6(-2.0f64..2.0),
        ) {
            let columns: Vec<[f64; 6]> =
                values.chunks(6).map(|c| std::array::from_fn(|i| c[i])).collect();
            let ridge = 1e-9;
            let x = nnls(&columns, &b, ridge);
            let mut rest = b;
            for (c, x) in columns.iter().zip(&x) {
                for (r, a) in rest.iter_mut().zip(c) {
                    *r -= a * x;
                }
            }
            for (c, x) in columns.iter().zip(&x) {
                let gradient = dot(c, &rest) - ridge * x;
                prop_assert!(*x >= 0.0);
                prop_assert!(gradient < 1e-6, "{gradient}");
                prop_assert!(*x == 0.0 || gradient.abs() < 1e-6, "{gradient} at {x}");
            }
        }
    }
}
