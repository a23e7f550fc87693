//! The smoothest curve under a ceiling (offline).
//!
//! A pelvis must come down where a leg does not reach, and the way it comes down decides the load on the legs: a dip of
//! 4 cm in a tenth of a second takes the whole weight off the floor and then doubles it. The dip chosen is therefore
//! the one that costs the least acceleration.

use crate::math::banded::Pentadiagonal;
use crate::plan::params::leg;

/// The curve `d ≤ ceiling` that minimises `Σ d² + τ⁴ d̈²`: it leaves 0 as little, and bends as little, as the ceiling
/// allows.
///
/// * `ceiling`: largest value per sample; only where it is below 0 does the curve leave 0.
/// * `tau`: time over which it may bend, s: a dip of depth `z` takes about this long and accelerates by about `z/τ²`.
/// * `rate_hz`: samples per second.
///
/// The ceiling is a stiff spring, so the curve may pass it by a fraction of a millimetre per metre of depth. Newton's
/// method on the samples that are held; each round is one banded solve, O(n).
pub fn smoothest_below(ceiling: &[f64], tau: f64, rate_hz: f64) -> Vec<f64> {
    let n = ceiling.len();
    if n < 3 {
        return ceiling.iter().map(|c| c.min(0.0)).collect();
    }
    if !ceiling.iter().any(|c| 0.0 > *c) {
        return vec![0.0; n];
    }
    let bend = (tau * rate_hz).powi(4);
    bent_below(ceiling, |_| (bend, None))
}

/// The curve `d ≤ ceiling` that minimises `Σ d² + Σ weight (d̈ − wanted)²`, with accelerations per squared sample.
///
/// * `bend`: weight of an inner sample, and the acceleration wanted there, if not 0.
pub(super) fn bent_below(ceiling: &[f64], bend: impl Fn(usize) -> (f64, Option<f64>)) -> Vec<f64> {
    let n = ceiling.len();
    let mut d = vec![0.0; n];
    let mut held = vec![false; n];
    for round in 0..leg::CEILING_ROUNDS {
        let now: Vec<bool> = d.iter().zip(ceiling).map(|(d, c)| d > c).collect();
        if round > 0 && now == held {
            break;
        }
        held = now;
        let spring: Vec<f64> = held
            .iter()
            .map(|h| f64::from(*h) * leg::CEILING_STIFFNESS)
            .collect();
        let pull = |(h, c): (&bool, &f64)| if *h { leg::CEILING_STIFFNESS * c } else { 0.0 };
        d = held.iter().zip(ceiling).map(pull).collect();
        let mut matrix = Pentadiagonal::new(spring.iter().map(|s| 1.0 + s).collect());
        for i in 1..n - 1 {
            let (weight, wanted) = bend(i);
            matrix.add_row(i as isize - 1, [1.0, -2.0, 1.0], weight);
            if let Some(wanted) = wanted {
                for (k, r) in [(i - 1, 1.0), (i, -2.0), (i + 1, 1.0)] {
                    d[k] += weight * r * wanted;
                }
            }
        }
        matrix.factor().solve(d.as_chunks_mut::<1>().0);
    }
    d
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_to_avoid_leaves_the_curve_alone() {
        assert!(
            smoothest_below(&[0.3; 50], 0.2, 120.0)
                .iter()
                .all(|d| *d == 0.0)
        );
    }

    #[test]
    fn a_dip_stays_below_and_costs_less_acceleration_than_one_by_windows() {
        let (rate, tau) = (120.0, 0.15);
        let ceiling: Vec<f64> = (0..240)
            .map(|i| if (100..112).contains(&i) { -0.04 } else { 0.02 })
            .collect();
        let d = smoothest_below(&ceiling, tau, rate);
        let acceleration = |d: &[f64]| {
            d.windows(3)
                .map(|w| (w[0] - 2.0 * w[1] + w[2]).abs() * rate * rate)
                .fold(0.0, f64::max)
        };
        assert!(d.iter().zip(&ceiling).all(|(d, c)| *d < c + 5e-4));
        assert!(d[0].abs() < 4e-3 && d[239].abs() < 4e-3, "it comes back");
        let windows = crate::motion::filter::smooth_minimum(
            &ceiling.iter().map(|c| c.min(0.0)).collect::<Vec<_>>(),
            12,
        );
        assert!(acceleration(&d) < 4.0, "{}", acceleration(&d));
        let (a, b) = (acceleration(&d), acceleration(&windows));
        assert!(2.0 * a < b, "{a} {b}");
    }
}
