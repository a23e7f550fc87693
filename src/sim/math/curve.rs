//! Curves between two values: polynomials that join with a given slope and curvature.
//!
//! [`min_jerk`], [`fade`] and [`quintic`] are the same polynomial with different boundary conditions. Each keeps its
//! own order of operations, so that recorded motions keep their bits.

use crate::math::Vec3;

/// 0 until u = 0, 1 from u = 1 on, C¹ between: 3u² − 2u³.
#[inline]
pub fn smoothstep(u: f64) -> f64 {
    smoothstep_to(1.0, u.clamp(0.0, 1.0))
}

/// `height` times the [`smoothstep`] at `u` in 0…1.
#[inline]
pub fn smoothstep_to(height: f64, u: f64) -> f64 {
    height * u * u * (3.0 - 2.0 * u)
}

/// 0 until u = 0, 1 from u = 1 on, C² between: 10u³ − 15u⁴ + 6u⁵, the curve of least jerk (Flash & Hogan 1985).
#[inline]
pub fn smootherstep(u: f64) -> f64 {
    let u = u.clamp(0.0, 1.0);
    u * u * u * (10.0 - 15.0 * u + 6.0 * u * u)
}

/// [`smootherstep`] from 0 at `start` to 1 at `end`, by Horner's rule: it rounds differently, and the built-in motions
/// keep their bits.
pub fn ramp(t: f64, start: f64, end: f64) -> f64 {
    let u = ((t - start) / (end - start)).clamp(0.0, 1.0);
    u * u * u * (10.0 + u * (-15.0 + 6.0 * u))
}

/// 0 at the first bound and before, 1 at the second and beyond, C¹ between.
#[inline]
pub fn rise(x: f64, (none, full): (f64, f64)) -> f64 {
    smoothstep((x - none) / (full - none))
}

/// 1 at the first bound and before, 0 at the second and beyond, C¹ between.
#[inline]
pub fn fall(x: f64, (full, none): (f64, f64)) -> f64 {
    smoothstep((none - x) / (none - full))
}

/// 0 at both ends of 0…1 with slope 0, `height` in the middle: 16 u² (1 − u)².
#[inline]
pub fn arc(height: f64, u: f64) -> f64 {
    height * 16.0 * u * u * (1.0 - u) * (1.0 - u)
}

/// Value at `u` in 0…1 of the quintic that begins with this value, slope and curvature and ends at 0 at rest.
pub fn fade(value: f64, slope: f64, curvature: f64, u: f64) -> f64 {
    let v = 1.0 - u;
    let v3 = v * v * v;
    v3 * (value * (1.0 + 3.0 * u + 6.0 * u * u)
        + slope * u * (1.0 + 3.0 * u)
        + 0.5 * curvature * u * u)
}

/// Value at time `t` of the quintic from `x0`, with slope `v0`, to rest at `x1` at time `end`; its curvature is 0 at
/// both ends.
pub fn min_jerk(x0: f64, v0: f64, x1: f64, end: f64, t: f64) -> f64 {
    let u = (t / end).clamp(0.0, 1.0);
    let (d, w) = (x1 - x0, v0 * end);
    let (c3, c4, c5) = (10.0 * d - 6.0 * w, 8.0 * w - 15.0 * d, 6.0 * d - 3.0 * w);
    x0 + u * (w + u * u * (c3 + u * (c4 + u * c5)))
}

/// [`min_jerk`] of each component.
pub fn min_jerk_3(x0: Vec3, v0: Vec3, x1: Vec3, end: f64, t: f64) -> Vec3 {
    let (a, v, b) = (x0.to_array(), v0.to_array(), x1.to_array());
    Vec3::from_array(std::array::from_fn(|k| min_jerk(a[k], v[k], b[k], end, t)))
}

/// The polynomial of fifth degree on `0…h` from value 0 with slope `d0` and curvature `a0`, to value `p1`,
/// slope `d1`, curvature `a1`: its value, slope and curvature at `x`.
pub fn quintic(h: f64, x: f64, d0: f64, a0: f64, p1: f64, d1: f64, a1: f64) -> [f64; 3] {
    let u = x / h;
    // In units of h: value p(u) = d u + a u²/2 + c3 u³ + c4 u⁴ + c5 u⁵
    let (d, a) = (d0 * h, a0 * h * h);
    let p = p1 - d - 0.5 * a;
    let v = d1 * h - d - a;
    let w = a1 * h * h - a;
    let c3 = 10.0 * p - 4.0 * v + 0.5 * w;
    let c4 = -15.0 * p + 7.0 * v - w;
    let c5 = 6.0 * p - 3.0 * v + 0.5 * w;
    [
        u * (d + u * (0.5 * a + u * (c3 + u * (c4 + u * c5)))),
        (d + u * (a + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)))) / h,
        (a + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5))) / (h * h),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Value, slope and curvature at `u` by differences.
    fn rates(f: fn(f64) -> f64, u: f64) -> [f64; 3] {
        let h = 1e-4;
        let [a, b, c] = [f(u - h), f(u), f(u + h)];
        [b, (c - a) / (2.0 * h), (a - 2.0 * b + c) / (h * h)]
    }

    #[test]
    fn they_rise_from_rest_to_rest() {
        for f in [smoothstep, smootherstep] {
            assert_eq!([f(-1.0), f(0.0), f(1.0), f(7.0)], [0.0, 0.0, 1.0, 1.0]);
            assert!((f(0.5) - 0.5).abs() < 1e-15);
            let [_, begin, _] = rates(f, 0.0);
            let [_, end, _] = rates(f, 1.0);
            assert!(begin.abs() < 1e-3 && end.abs() < 1e-3);
            for i in 1..100 {
                let [_, slope, _] = rates(f, f64::from(i) * 0.01);
                assert!(slope > 0.0);
            }
        }
        assert!(rates(smootherstep, 0.0)[2].abs() < 0.01);
        assert!(rates(smootherstep, 1.0)[2].abs() < 0.01);
    }

    #[test]
    fn what_rises_and_what_falls_between_bounds_are_one() {
        let bounds = (0.2, 0.6);
        assert_eq!([rise(0.1, bounds), rise(0.7, bounds)], [0.0, 1.0]);
        assert_eq!([fall(0.1, bounds), fall(0.7, bounds)], [1.0, 0.0]);
        for i in 0..100 {
            let x = f64::from(i) * 0.01;
            assert!((rise(x, bounds) + fall(x, bounds) - 1.0).abs() < 1e-15);
        }
        assert!(rise(0.3, bounds) < rise(0.31, bounds));
    }

    #[test]
    fn the_smoother_one_has_the_least_jerk() {
        // ∫ jerk² along the curve is 720; adding a bump that vanishes at both ends can only increase it.
        let jerk = |bump: f64| {
            let n = 2000;
            let h = 1.0 / f64::from(n);
            let f = |u: f64| smootherstep(u) + bump * (u * (1.0 - u)).powi(3);
            let third = |u: f64| {
                (f(u + 1.5 * h) - 3.0 * f(u + 0.5 * h) + 3.0 * f(u - 0.5 * h) - f(u - 1.5 * h))
                    / (h * h * h)
            };
            (4..n - 4)
                .map(|i| third(f64::from(i) * h).powi(2) * h)
                .sum::<f64>()
        };
        assert!((jerk(0.0) - 720.0).abs() < 25.0, "{}", jerk(0.0));
        assert!(jerk(0.5) > jerk(0.0) && jerk(-0.5) > jerk(0.0));
    }

    #[test]
    fn quintic_meets_both_ends() {
        let ends = (0.3, -2.0, 0.7, 1.1, 4.0);
        let f = |x| quintic(0.25, x, ends.0, ends.1, ends.2, ends.3, ends.4);
        let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|k| (a[k] - b[k]).abs() < 1e-10);
        assert!(near(f(0.0), [0.0, ends.0, ends.1]));
        assert!(near(f(0.25), [ends.2, ends.3, ends.4]));
    }

    #[test]
    fn fade_meets_value_slope_and_curvature_and_ends_at_rest() {
        let f = |u: f64| fade(0.3, -0.7, 1.1, u);
        let h = 1e-4;
        assert!((f(0.0) - 0.3).abs() < 1e-12);
        assert!(((f(h) - f(0.0)) / h + 0.7).abs() < 1e-3);
        assert!(((f(2.0 * h) - 2.0 * f(h) + f(0.0)) / (h * h) - 1.1).abs() < 1e-2);
        assert!(f(1.0).abs() < 1e-15 && (f(1.0 - h) / h).abs() < 1e-6);
    }
}
