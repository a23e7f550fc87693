//! Unit quaternions (x, y, z, w), active rotations, over lanes.

use super::{Lane, Mat3, Vec3, trig, vec3::vec3};
use serde::{Deserialize, Serialize};
use std::ops::Mul;

/// A unit quaternion, stored x, y, z, w.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)]
pub struct Quat<L = f64> {
    pub x: L,
    pub y: L,
    pub z: L,
    pub w: L,
}

impl<L: Lane> Default for Quat<L> {
    fn default() -> Self {
        Self::identity()
    }
}

impl<L: Lane> Quat<L> {
    /// No rotation.
    #[inline(always)]
    pub fn identity() -> Self {
        Self {
            x: L::zero(),
            y: L::zero(),
            z: L::zero(),
            w: L::one(),
        }
    }
    /// The inverse rotation.
    #[inline(always)]
    pub fn conjugate(self) -> Self {
        Self {
            x: -self.x,
            y: -self.y,
            z: -self.z,
            w: self.w,
        }
    }
    /// Scaled to unit length (one Newton-free square root).
    #[inline(always)]
    pub fn normalized(self) -> Self {
        let s = L::one()
            / (self.x * self.x + self.y * self.y + self.z * self.z + self.w * self.w).sqrt();
        Self {
            x: self.x * s,
            y: self.y * s,
            z: self.z * s,
            w: self.w * s,
        }
    }
    /// Rotation matrix; exact for unit quaternions.
    #[inline(always)]
    pub fn to_mat3(self) -> Mat3<L> {
        let two = L::splat(2.0);
        let one = L::one();
        let (x, y, z, w) = (self.x, self.y, self.z, self.w);
        let (xx, yy, zz) = (x * x, y * y, z * z);
        let (xy, xz, yz) = (x * y, x * z, y * z);
        let (wx, wy, wz) = (w * x, w * y, w * z);
        Mat3 {
            x: vec3(one - two * (yy + zz), two * (xy + wz), two * (xz - wy)),
            y: vec3(two * (xy - wz), one - two * (xx + zz), two * (yz + wx)),
            z: vec3(two * (xz + wy), two * (yz - wx), one - two * (xx + yy)),
        }
    }
    /// Rotates a vector.
    #[inline(always)]
    pub fn rotate(self, v: Vec3<L>) -> Vec3<L> {
        let u = vec3(self.x, self.y, self.z);
        let t = u.cross(v) * L::splat(2.0);
        v + t * self.w + u.cross(t)
    }
    /// Exponential map: rotation by `|v|` rad about `v`.
    #[inline(always)]
    pub fn exp(v: Vec3<L>) -> Self {
        let half = L::splat(0.5);
        let a2 = v.dot(v) * L::splat(0.25); // (angle/2)²
        let small = L::splat(1e-6);
        let a = a2.max(small).sqrt();
        let (s, c) = trig::sin_cos(a);
        // sin(a)/a and cos(a) by series below the threshold, where the next term is under 1e-19.
        let sinc = a2.select_lt(
            small,
            L::one() - a2 * L::splat(1.0 / 6.0) * (L::one() - a2 * L::splat(0.05)),
            s / a,
        );
        let cosa = a2.select_lt(
            small,
            L::one() - a2 * half * (L::one() - a2 * L::splat(1.0 / 12.0)),
            c,
        );
        let k = sinc * half;
        Self {
            x: v.x * k,
            y: v.y * k,
            z: v.z * k,
            w: cosa,
        }
    }
    /// Logarithm: the rotation vector (rad) of least length, |v| ≤ π.
    #[inline(always)]
    pub fn log(self) -> Vec3<L> {
        // Choose the sign with w ≥ 0, so that the shorter way round is taken.
        let sgn = self.w.select_lt(L::zero(), -L::one(), L::one());
        let v = vec3(self.x * sgn, self.y * sgn, self.z * sgn);
        let w = self.w * sgn;
        let s2 = v.dot(v);
        let small = L::splat(1e-12);
        let s = s2.max(small).sqrt();
        let angle_over_s = s2.select_lt(
            small,
            L::splat(2.0) / w.max(L::splat(0.5)),
            L::splat(2.0) * trig::atan2(s, w) / s,
        );
        v * angle_over_s
    }
    /// Quaternion of lane `k`.
    #[inline(always)]
    pub fn lane(self, k: usize) -> Quat<f64> {
        Quat {
            x: self.x.lane(k),
            y: self.y.lane(k),
            z: self.z.lane(k),
            w: self.w.lane(k),
        }
    }
    /// Replaces the quaternion of lane `k`.
    pub fn set_lane(&mut self, k: usize, q: Quat<f64>) {
        self.x.set_lane(k, q.x);
        self.y.set_lane(k, q.y);
        self.z.set_lane(k, q.z);
        self.w.set_lane(k, q.w);
    }
}

impl Quat<f64> {
    /// From stored order x, y, z, w.
    pub const fn from_xyzw(a: [f64; 4]) -> Self {
        Self {
            x: a[0],
            y: a[1],
            z: a[2],
            w: a[3],
        }
    }
    /// Stored order x, y, z, w.
    pub const fn to_xyzw(self) -> [f64; 4] {
        [self.x, self.y, self.z, self.w]
    }
    /// Rotation about a unit axis by an angle (rad).
    pub fn from_axis_angle(axis: Vec3<f64>, angle: f64) -> Self {
        Self::exp(axis * angle)
    }
    /// Quaternion of a rotation matrix (Shepperd's method), w ≥ 0.
    pub fn from_mat3(m: &Mat3<f64>) -> Self {
        let t = m.x.x + m.y.y + m.z.z;
        let q = if t > 0.0 {
            let s = (t + 1.0).sqrt() * 2.0;
            Self {
                w: 0.25 * s,
                x: (m.y.z - m.z.y) / s,
                y: (m.z.x - m.x.z) / s,
                z: (m.x.y - m.y.x) / s,
            }
        } else if m.x.x > m.y.y && m.x.x > m.z.z {
            let s = (1.0 + m.x.x - m.y.y - m.z.z).sqrt() * 2.0;
            Self {
                w: (m.y.z - m.z.y) / s,
                x: 0.25 * s,
                y: (m.y.x + m.x.y) / s,
                z: (m.z.x + m.x.z) / s,
            }
        } else if m.y.y > m.z.z {
            let s = (1.0 + m.y.y - m.x.x - m.z.z).sqrt() * 2.0;
            Self {
                w: (m.z.x - m.x.z) / s,
                x: (m.y.x + m.x.y) / s,
                y: 0.25 * s,
                z: (m.z.y + m.y.z) / s,
            }
        } else {
            let s = (1.0 + m.z.z - m.x.x - m.y.y).sqrt() * 2.0;
            Self {
                w: (m.x.y - m.y.x) / s,
                x: (m.z.x + m.x.z) / s,
                y: (m.z.y + m.y.z) / s,
                z: 0.25 * s,
            }
        };
        let q = q.normalized();
        if q.w < 0.0 {
            Self {
                x: -q.x,
                y: -q.y,
                z: -q.z,
                w: -q.w,
            }
        } else {
            q
        }
    }
    /// Shortest-way spherical interpolation, `u` in 0…1.
    pub fn slerp(self, to: Self, u: f64) -> Self {
        (self * Self::exp((self.conjugate() * to).log() * u)).normalized()
    }

    /// Direction of the x axis seen from above, rad about z from x, −π…π.
    pub fn heading(self) -> f64 {
        let x = self.rotate(Vec3::X);
        trig::atan2(x.y, x.x)
    }
    /// Whether every component is finite.
    pub fn is_finite(self) -> bool {
        self.to_xyzw().iter().all(|c| c.is_finite())
    }
}

impl<L: Lane> Mul for Quat<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        let a = self;
        Self {
            x: a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            y: a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            z: a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
            w: a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
        }
    }
}
