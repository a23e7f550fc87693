//! Share of its isometric peak that a muscle group can give at an angle and a speed: the factors f_len and f_vel of
//! equation (5).
//!
//! Every curve, whatever its data, is continuous and positive, and gives less the faster the muscle shortens
//! (`docs/model.md#strength`). Published fits that break this are repaired here (Anderson 2007: eccentric branch,
//! plantarflexion, cosine beyond its half wave). Evaluated within the tick: no allocation and no platform libm.

use crate::math::trig;

/// Least angle factor: the groups reach beyond the postures in which they were measured, and none drops to zero at the
/// end of its range.
pub const ANGLE_FLOOR: f64 = 0.1;
/// Least factor of a published cosine. In the postures used for the fit it stays above about one half. Farther out it
/// is an extrapolation, and a wrong one: it leaves the knee a tenth of its torque in a full squat, from which people do
/// rise. Half the peak is held there instead.
pub const COSINE_FLOOR: f64 = 0.5;
/// Least velocity factor.
pub const VELOCITY_FLOOR: f64 = 0.05;
/// Largest factor in lengthening.
pub const ECCENTRIC_MOST: f64 = 1.4;
/// Least factor at fast lengthening: no muscle gives less there than when it holds still.
const ECCENTRIC_LEAST: f64 = 1.05;

/// Torque over peak torque against the joint angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AngleFactor {
    /// `cos(width·(θ − peak))` within its half wave (Anderson 2007).
    Cosine {
        /// C2, 1/rad.
        width: f64,
        /// C3, rad.
        peak: f64,
    },
    /// A bell `1/(1 + y + y²/2)`, `y = ½((θ − peak)·narrowness)²`: a Gaussian to second order whose flanks fall more
    /// slowly.
    Bell {
        /// Angle of the peak, rad.
        peak: f64,
        /// One over the standard deviation, 1/rad.
        narrowness: f64,
    },
}

impl AngleFactor {
    /// Factor at angle `theta` (rad), [`ANGLE_FLOOR`]…1.
    #[inline]
    pub fn at(&self, theta: f64) -> f64 {
        let f = match *self {
            Self::Cosine { width, peak } => {
                let half = std::f64::consts::PI;
                trig::sin_cos((width * (theta - peak)).clamp(-half, half))
                    .1
                    .max(COSINE_FLOOR)
            }
            Self::Bell { peak, narrowness } => {
                let z = (theta - peak) * narrowness;
                let y = 0.5 * z * z;
                1.0 / (1.0 + y + 0.5 * y * y)
            }
        };
        f.max(ANGLE_FLOOR)
    }

    /// Largest factor between two angles (rad, `lower` ≤ `upper`), [`ANGLE_FLOOR`]…1: both shapes fall on either side
    /// of their peak.
    pub fn largest(&self, lower: f64, upper: f64) -> f64 {
        let (Self::Cosine { peak, .. } | Self::Bell { peak, .. }) = *self;
        self.at(peak.max(lower).min(upper))
    }
}

/// Torque over isometric torque against the speed of shortening. C¹ except where it meets its floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityFactor {
    shortening: Shortening,
    /// Factor at infinitely fast lengthening, less 1.
    gain: f64,
    /// Lengthening speed at half the gain, rad/s.
    half: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Shortening {
    /// `(1 − u)/(1 + bend·u)`, `u = ω·slowness`, zero at 1/slowness.
    Hill { slowness: f64, bend: f64 },
    /// `(1 + a ω)/(1 + b ω)` up to `until`, where it is ½; beyond that `½/(1 + tail (ω − until))` with the same slope.
    Measured {
        a: f64,
        b: f64,
        until: f64,
        tail: f64,
    },
}

impl VelocityFactor {
    /// Hill hyperbola that vanishes at `fastest` (rad/s) and is `at_half` (0.05…0.5) at half that speed; `eccentric` is
    /// the plateau.
    pub fn hill(fastest: f64, at_half: f64, eccentric: f64) -> Self {
        let bend = 1.0 / at_half - 2.0;
        let slope = (1.0 + bend) / fastest;
        let slowness = 1.0 / fastest;
        Self::with_eccentric(Shortening::Hill { slowness, bend }, slope, eccentric)
    }

    /// The concentric curve of Anderson 2007, which is ¾ at `c4` and ½ at `c5` (rad/s, 0 < c4 < c5).
    ///
    /// It was measured to about `c5`. Extrapolated, it crosses zero at 6…9 rad/s at the hip, speeds that a brisk step
    /// reaches, or never (plantarflexion); here it continues as a hyperbola instead. The eccentric branch, which falls
    /// below 1 or even below 0 as published, is replaced.
    pub fn anderson(c4: f64, c5: f64, eccentric: f64) -> Self {
        let a = (c5 - 3.0 * c4) / (2.0 * c4 * c5);
        let b = (2.0 * c5 - 4.0 * c4) / (2.0 * c4 * c5);
        let tail = c4 / (c5 * (c5 - c4)); // twice the slope at c5, since the value there is ½
        let slope = b - a;
        let shortening = Shortening::Measured {
            a,
            b,
            until: c5,
            tail,
        };
        Self::with_eccentric(shortening, slope, eccentric)
    }

    /// Lengthening rises from 1 with the `slope` of the concentric side (no kink at rest) towards the plateau.
    fn with_eccentric(shortening: Shortening, slope: f64, eccentric: f64) -> Self {
        let gain = eccentric.clamp(ECCENTRIC_LEAST, ECCENTRIC_MOST) - 1.0;
        Self {
            shortening,
            gain,
            half: gain / slope,
        }
    }

    /// Factor at shortening speed `speed` (rad/s; negative = lengthening), [`VELOCITY_FLOOR`]…[`ECCENTRIC_MOST`], not
    /// increasing.
    #[inline]
    pub fn at(&self, speed: f64) -> f64 {
        if speed <= 0.0 {
            return 1.0 - self.gain * speed / (self.half - speed);
        }
        let f = match self.shortening {
            Shortening::Hill { slowness, bend } => {
                let u = speed * slowness;
                (1.0 - u) / (1.0 + bend * u)
            }
            Shortening::Measured { a, b, until, tail } => {
                if speed < until {
                    (1.0 + a * speed) / (1.0 + b * speed)
                } else {
                    0.5 / (1.0 + tail * (speed - until))
                }
            }
        };
        f.max(VELOCITY_FLOOR)
    }

    /// Speed of shortening (rad/s, > 0) at which the factor meets its floor, [`VELOCITY_FLOOR`].
    pub fn fastest(&self) -> f64 {
        match self.shortening {
            Shortening::Hill { slowness, bend } => {
                (1.0 - VELOCITY_FLOOR) / (slowness * (1.0 + VELOCITY_FLOOR * bend))
            }
            Shortening::Measured { until, tail, .. } => until + (0.5 / VELOCITY_FLOOR - 1.0) / tail,
        }
    }
}

/// One direction of one DOF: isometric peak and the two factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Muscle {
    /// Isometric torque at the angle of the peak, N·m.
    pub peak: f64,
    /// f_len.
    pub angle: AngleFactor,
    /// f_vel.
    pub velocity: VelocityFactor,
}

impl Muscle {
    /// Largest torque at `angle` (rad) and shortening `speed` (rad/s), N·m, > 0: equation (5).
    #[inline]
    pub fn torque(&self, angle: f64, speed: f64) -> f64 {
        self.peak * self.angle.at(angle) * self.velocity.at(speed)
    }

    /// Largest isometric torque between two angles (rad, `lower` ≤ `upper`), N·m, > 0.
    pub fn strongest(&self, lower: f64, upper: f64) -> f64 {
        self.peak * self.angle.largest(lower, upper)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curves() -> Vec<VelocityFactor> {
        vec![
            VelocityFactor::hill(19.1, 0.25, 1.23),
            VelocityFactor::hill(36.5, 0.12, 1.17),
            VelocityFactor::hill(11.8, 0.41, 1.159),
            VelocityFactor::anderson(2.095, 4.267, 1.14),
            VelocityFactor::anderson(0.987, 3.558, 1.159),
        ]
    }

    #[test]
    fn velocity_is_one_at_rest_smooth_there_and_monotone() {
        for c in curves() {
            assert_eq!(c.at(0.0), 1.0);
            let h = 1e-6;
            let (left, right) = ((c.at(0.0) - c.at(-h)) / h, (c.at(h) - c.at(0.0)) / h);
            assert!(
                (left - right).abs() < 1e-4 * right.abs(),
                "slopes {left}, {right}"
            );
            let mut before = ECCENTRIC_MOST;
            for i in -4000..=4000 {
                let f = c.at(f64::from(i) * 0.02);
                assert!(f <= before && f >= VELOCITY_FLOOR, "{f} after {before}");
                before = f;
            }
        }
    }

    #[test]
    fn measured_curve_passes_its_points_and_hill_its_middle() {
        let c = VelocityFactor::anderson(2.095, 4.267, 1.14);
        assert!((c.at(2.095) - 0.75).abs() < 1e-12);
        assert!((c.at(4.267) - 0.5).abs() < 1e-12);
        let h = 1e-6;
        let (left, right) = (c.at(4.267) - c.at(4.267 - h), c.at(4.267 + h) - c.at(4.267));
        assert!((left / right - 1.0).abs() < 1e-4, "slope is kept");
        let hill = VelocityFactor::hill(11.8, 0.41, 1.2);
        assert!((hill.at(5.9) - 0.41).abs() < 1e-12);
        assert_eq!(hill.at(12.0), VELOCITY_FLOOR);
    }

    #[test]
    fn fastest_is_where_the_velocity_factor_meets_its_floor() {
        for c in curves() {
            let w = c.fastest();
            assert!((c.at(w) - VELOCITY_FLOOR).abs() < 1e-12, "{}", c.at(w));
            assert!(c.at(0.999 * w) > VELOCITY_FLOOR && c.at(1.5 * w) == VELOCITY_FLOOR);
        }
    }

    #[test]
    fn largest_angle_factor_is_that_of_a_fine_scan() {
        let cosine = AngleFactor::Cosine {
            width: 1.391,
            peak: 0.408,
        };
        let bell = AngleFactor::Bell {
            peak: 0.9,
            narrowness: 1.0 / 1.2,
        };
        for f in [cosine, bell] {
            for (lower, upper) in [(-1.0, 2.0), (1.2, 2.4), (-3.0, -0.5)] {
                let scan = (0..=10_000).map(|i| f.at(lower + (upper - lower) * f64::from(i) / 1e4));
                let most = scan.fold(0.0, f64::max);
                let largest = f.largest(lower, upper);
                assert!(largest >= most && largest - most < 1e-7, "{largest} {most}");
            }
        }
    }

    #[test]
    fn angle_factors_peak_at_one_and_never_vanish() {
        let cosine = AngleFactor::Cosine {
            width: 1.391,
            peak: 0.408,
        };
        let bell = AngleFactor::Bell {
            peak: 0.9,
            narrowness: 1.0 / 1.2,
        };
        assert!((cosine.at(0.408) - 1.0).abs() < 1e-15 && bell.at(0.9) == 1.0);
        for f in [cosine, bell] {
            let mut before = f.at(-6.0);
            for i in -600..=600 {
                let x = f.at(f64::from(i) * 0.01);
                assert!((ANGLE_FLOOR..=1.0).contains(&x) && (x - before).abs() < 0.02);
                before = x;
            }
        }
    }
}
