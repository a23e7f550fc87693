//! Calculus of rotation vectors, for curves of the form `q(t) = q₀ · exp(φ(t))`.
//!
//! With φ a smooth curve, the angular velocity in child axes is `ω = Jr(φ) φ̇` (right Jacobian of the exponential map)
//! and its derivative `α = Jr φ̈ + J̇r φ̇`; see for example Chirikjian, *Stochastic Models, Information Theory, and Lie
//! Groups*, vol. 2.

use crate::math::{Vec3, trig};

/// Below this squared angle the coefficients come from their series, which are exact to rounding there.
const SERIES: f64 = 0.25;

fn series(x: f64, coefficients: [f64; 6]) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// `(1 − cos θ)/θ²`, `(θ − sin θ)/θ³`, and the derivative of each by θ divided by θ.
fn coefficients(theta2: f64) -> [f64; 4] {
    if theta2 < SERIES {
        // Σ (−x)^k/(2k+2)!, Σ (−x)^k/(2k+3)!, and twice the derivatives by x = θ²
        return [
            series(
                theta2,
                [
                    1.0 / 2.0,
                    -1.0 / 24.0,
                    1.0 / 720.0,
                    -1.0 / 40_320.0,
                    1.0 / 3_628_800.0,
                    -1.0 / 479_001_600.0,
                ],
            ),
            series(
                theta2,
                [
                    1.0 / 6.0,
                    -1.0 / 120.0,
                    1.0 / 5040.0,
                    -1.0 / 362_880.0,
                    1.0 / 39_916_800.0,
                    -1.0 / 6_227_020_800.0,
                ],
            ),
            series(
                theta2,
                [
                    -1.0 / 12.0,
                    1.0 / 180.0,
                    -1.0 / 6720.0,
                    1.0 / 453_600.0,
                    -1.0 / 47_900_160.0,
                    12.0 / 87_178_291_200.0,
                ],
            ),
            series(
                theta2,
                [
                    -1.0 / 60.0,
                    1.0 / 1260.0,
                    -1.0 / 60_480.0,
                    1.0 / 4_989_600.0,
                    -10.0 / 6_227_020_800.0,
                    12.0 / 1_307_674_368_000.0,
                ],
            ),
        ];
    }
    let theta = theta2.sqrt();
    let (s, c) = trig::sin_cos(theta);
    let theta4 = theta2 * theta2;
    [
        (1.0 - c) / theta2,
        (theta - s) / (theta2 * theta),
        (theta * s - 2.0 * (1.0 - c)) / theta4,
        (theta * (1.0 - c) - 3.0 * (theta - s)) / (theta4 * theta),
    ]
}

/// Angular velocity and acceleration in child axes of `q₀ · exp(φ(t))`.
pub fn rates(phi: Vec3, phi_dot: Vec3, phi_ddot: Vec3) -> (Vec3, Vec3) {
    let [a, b, a_slope, b_slope] = coefficients(phi.dot(phi));
    let d = phi.dot(phi_dot);
    let (a_dot, b_dot) = (a_slope * d, b_slope * d);
    let jacobian = |v: Vec3| {
        let c = phi.cross(v);
        v - c * a + phi.cross(c) * b
    };
    let c = phi.cross(phi_dot);
    let omega = jacobian(phi_dot);
    let alpha = jacobian(phi_ddot) - c * a_dot + phi.cross(c) * b_dot + phi_dot.cross(c) * b;
    (omega, alpha)
}

/// `φ̇` and `φ̈` of the curve that has angular velocity `omega` and acceleration `alpha` (child axes) at φ, |φ| ≤ π;
/// inverse of [`rates`].
pub fn vector_rates(phi: Vec3, omega: Vec3, alpha: Vec3) -> (Vec3, Vec3) {
    let theta2 = phi.dot(phi);
    let k = if theta2 < 0.01 {
        1.0 / 12.0 + theta2 * (1.0 / 720.0 + theta2 * (1.0 / 30_240.0 + theta2 / 1_209_600.0))
    } else {
        let half = 0.5 * theta2.sqrt();
        let (s, c) = trig::sin_cos(half);
        (1.0 - half * c / s) / theta2
    };
    let inverse = |v: Vec3| {
        let c = phi.cross(v);
        v + c * 0.5 + phi.cross(c) * k
    };
    let phi_dot = inverse(omega);
    let (_, drift) = rates(phi, phi_dot, Vec3::zero()); // J̇r φ̇
    (phi_dot, inverse(alpha - drift))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Quat;
    use rand::{Rng, SeedableRng};

    #[test]
    fn rates_match_differences_of_the_curve_and_invert() {
        let mut random = rand_pcg::Pcg64::seed_from_u64(5);
        let mut vector =
            |m: f64| Vec3::from_array([0.0; 3].map(|_: f64| random.random_range(-m..m)));
        for i in 0..3000 {
            let size = [1e-7, 1e-3, 0.28, 0.3, 1.0, 1.75][i % 6]; // |φ| up to 3.03
            let (p, v, a) = (vector(size), vector(2.0), vector(5.0));
            let (omega, alpha) = rates(p, v, a);
            let h = 1e-5;
            let at = |t: f64| p + v * t + a * (0.5 * t * t);
            let q = |t: f64| Quat::exp(at(t));
            let measured = (q(-h).conjugate() * q(h)).log() * (0.5 / h);
            assert!((measured - omega).norm() < 1e-7, "{measured:?} {omega:?}");
            let w = |t: f64| rates(at(t), v + a * t, a).0;
            let measured = (w(h) - w(-h)) * (0.5 / h);
            assert!((measured - alpha).norm() < 1e-6, "{measured:?} {alpha:?}");
            let (v2, a2) = vector_rates(p, omega, alpha);
            assert!((v2 - v).norm() < 1e-10 && (a2 - a).norm() < 1e-9);
        }
    }
}
