//! Three-vectors over lanes.

use super::Lane;
use serde::{Deserialize, Serialize};
use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

/// A vector of three components, in the frame that its variable's name states.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Vec3<L = f64> {
    /// Forward.
    pub x: L,
    /// Left.
    pub y: L,
    /// Up.
    pub z: L,
}

/// Shorthand for `Vec3 { x, y, z }`.
#[inline(always)]
pub const fn vec3<L>(x: L, y: L, z: L) -> Vec3<L> {
    Vec3 { x, y, z }
}

impl<L: Lane> Vec3<L> {
    /// The null vector.
    #[inline(always)]
    pub fn zero() -> Self {
        vec3(L::zero(), L::zero(), L::zero())
    }
    /// The same vector in every lane.
    #[inline(always)]
    pub fn splat(v: Vec3<f64>) -> Self {
        vec3(L::splat(v.x), L::splat(v.y), L::splat(v.z))
    }
    /// Scalar product.
    #[inline(always)]
    pub fn dot(self, b: Self) -> L {
        self.x * b.x + self.y * b.y + self.z * b.z
    }
    /// Vector product.
    #[inline(always)]
    pub fn cross(self, b: Self) -> Self {
        vec3(
            self.y * b.z - self.z * b.y,
            self.z * b.x - self.x * b.z,
            self.x * b.y - self.y * b.x,
        )
    }
    /// Euclidean length.
    #[inline(always)]
    pub fn norm(self) -> L {
        self.dot(self).sqrt()
    }
    /// Length of the projection onto the floor, ignoring z.
    #[inline(always)]
    pub fn level(self) -> L {
        (self.x * self.x + self.y * self.y).sqrt()
    }
    /// Vector of lane `k`.
    #[inline(always)]
    pub fn lane(self, k: usize) -> Vec3<f64> {
        vec3(self.x.lane(k), self.y.lane(k), self.z.lane(k))
    }
    /// Replaces the vector of lane `k`.
    #[inline(always)]
    pub fn set_lane(&mut self, k: usize, v: Vec3<f64>) {
        self.x.set_lane(k, v.x);
        self.y.set_lane(k, v.y);
        self.z.set_lane(k, v.z);
    }
}

impl Vec3<f64> {
    /// Unit vector along x.
    pub const X: Self = vec3(1.0, 0.0, 0.0);
    /// Unit vector along y.
    pub const Y: Self = vec3(0.0, 1.0, 0.0);
    /// Unit vector along z.
    pub const Z: Self = vec3(0.0, 0.0, 1.0);
    /// Components as an array.
    #[inline(always)]
    pub const fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }
    /// Vector from an array.
    #[inline(always)]
    pub const fn from_array(a: [f64; 3]) -> Self {
        vec3(a[0], a[1], a[2])
    }
    /// A point of the floor, or a direction along it.
    #[inline(always)]
    pub const fn on_floor([x, y]: [f64; 2]) -> Self {
        vec3(x, y, 0.0)
    }
    /// Components along the floor as an array.
    #[inline(always)]
    pub const fn xy(self) -> [f64; 2] {
        [self.x, self.y]
    }
    /// The projection onto the floor: z is 0.
    #[inline(always)]
    pub const fn horizontal(self) -> Self {
        vec3(self.x, self.y, 0.0)
    }
    /// Whether every component is finite.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }
    /// Shortened to the length `most` if it is longer.
    #[inline(always)]
    pub fn capped(self, most: f64) -> Self {
        let length = self.norm();
        if length > most {
            self * (most / length)
        } else {
            self
        }
    }
    /// Unit vector of the same direction; `fallback` if the length is below 1e-12.
    pub fn normalized_or(self, fallback: Self) -> Self {
        let n = self.norm();
        if n > 1e-12 {
            self * (1.0 / n)
        } else {
            fallback
        }
    }
}

impl<L: Lane> Add for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        vec3(self.x + b.x, self.y + b.y, self.z + b.z)
    }
}
impl<L: Lane> Sub for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        vec3(self.x - b.x, self.y - b.y, self.z - b.z)
    }
}
impl<L: Lane> Mul<L> for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: L) -> Self {
        vec3(self.x * s, self.y * s, self.z * s)
    }
}
impl<L: Lane> Neg for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        vec3(-self.x, -self.y, -self.z)
    }
}
impl<L: Lane> AddAssign for Vec3<L> {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}
impl<L: Lane> SubAssign for Vec3<L> {
    #[inline(always)]
    fn sub_assign(&mut self, b: Self) {
        *self = *self - b;
    }
}
