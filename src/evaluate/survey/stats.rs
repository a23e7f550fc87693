//! Medians, quartiles and intervals of shares.

use sinew_physics::math::rounding::short;

/// Standard deviations to either side of a 95 % interval.
const Z: f64 = 1.959964;

/// Value at `share` (0…1) of the sorted values, linear between neighbours; `None` without values.
pub fn quantile(values: &[f64], share: f64) -> Option<f64> {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    let at = share.clamp(0.0, 1.0) * last as f64;
    let (i, u) = (at.floor() as usize, at.fract());
    let next = sorted[(i + 1).min(last)];
    Some(sorted[i] + (next - sorted[i]) * u)
}

/// The middle value; `None` without values.
pub fn median(values: &[f64]) -> Option<f64> {
    quantile(values, 0.5)
}

/// First quartile, median and third quartile.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Quartiles {
    /// A quarter of the values are below.
    pub q1: f64,
    /// Half of the values are below.
    pub median: f64,
    /// Three quarters of the values are below.
    pub q3: f64,
    /// Number of values.
    pub count: usize,
}

impl Quartiles {
    /// For `values`; `None` without values.
    pub fn of(values: &[f64]) -> Option<Self> {
        Some(Self {
            q1: short(quantile(values, 0.25)?),
            median: short(median(values)?),
            q3: short(quantile(values, 0.75)?),
            count: values.len(),
        })
    }

    /// Half width of the 95 % interval of the median, 1.57 × interquartile range / √n (McGill, Tukey & Larsen 1978).
    pub fn notch(&self) -> f64 {
        1.57 * (self.q3 - self.q1) / (self.count.max(1) as f64).sqrt()
    }
}

/// 95 % interval of a share of which `k` of `n` were seen (Wilson 1927).
pub fn wilson(k: usize, n: usize) -> [f64; 2] {
    if n == 0 {
        return [0.0, 1.0];
    }
    let (n, p) = (n as f64, k as f64 / n as f64);
    let centre = p + Z * Z / (2.0 * n);
    let half = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
    let scale = 1.0 / (1.0 + Z * Z / n);
    [
        ((centre - half) * scale).max(0.0),
        ((centre + half) * scale).min(1.0),
    ]
}

/// 95 % interval of the difference `b − a` of two shares (Newcombe 1998, method 10).
pub fn difference((ka, na): (usize, usize), (kb, nb): (usize, usize)) -> [f64; 2] {
    let share = |k: usize, n: usize| k as f64 / n.max(1) as f64;
    let (pa, pb) = (share(ka, na), share(kb, nb));
    let ([la, ua], [lb, ub]) = (wilson(ka, na), wilson(kb, nb));
    let d = pb - pa;
    [
        d - ((pb - lb).powi(2) + (ua - pa).powi(2)).sqrt(),
        d + ((ub - pb).powi(2) + (pa - la).powi(2)).sqrt(),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_are_those_of_the_sorted_values() {
        let q = Quartiles::of(&[4.0, 1.0, 3.0, 2.0, 5.0]).expect("five values");
        assert_eq!((q.q1, q.median, q.q3), (2.0, 3.0, 4.0));
        assert!((q.notch() - 1.57 * 2.0 / 5f64.sqrt()).abs() < 1e-12);
        assert_eq!(median(&[]), None);
        assert_eq!(median(&[1.0, 2.0]), Some(1.5));
    }

    #[test]
    fn intervals_of_shares_are_the_published_ones() {
        // Newcombe 1998, table II: 56/70 − 48/80 = 0.2, interval 0.0524…0.3339.
        let d = difference((48, 80), (56, 70));
        assert!(
            (d[0] - 0.0524).abs() < 1e-4 && (d[1] - 0.3339).abs() < 1e-4,
            "{d:?}"
        );
        // Wilson's interval of 81/263, Newcombe 1998 (one sample): 0.2553…0.3662.
        let w = wilson(81, 263);
        assert!(
            (w[0] - 0.2553).abs() < 1e-4 && (w[1] - 0.3662).abs() < 1e-4,
            "{w:?}"
        );
        assert_eq!(wilson(0, 0), [0.0, 1.0]);
    }
}
