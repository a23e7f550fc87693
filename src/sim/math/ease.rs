//! Ways from 0 to 1 that begin and end at rest: the polynomials of lowest degree.

/// 0 until u = 0, 1 from u = 1 on, C¹ between: 3u² − 2u³.
#[inline]
pub fn smoothstep(u: f64) -> f64 {
    let u = u.clamp(0.0, 1.0);
    u * u * (3.0 - 2.0 * u)
}

/// 0 until u = 0, 1 from u = 1 on, C² between: 10u³ − 15u⁴ + 6u⁵, the way of least jerk (Flash & Hogan 1985).
#[inline]
pub fn smootherstep(u: f64) -> f64 {
    let u = u.clamp(0.0, 1.0);
    u * u * u * (10.0 - 15.0 * u + 6.0 * u * u)
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
        // ∫ jerk² over the way is 720; any bump that keeps its ends adds to it.
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
}
