//! 3×3 matrices and symmetric 3×3 tensors over lanes.

use super::{Lane, Vec3, vec3::vec3};
use serde::{Deserialize, Serialize};
use std::ops::{Add, AddAssign, Mul, Sub};

/// A 3×3 matrix, held by its columns; mostly a rotation `world_from_segment`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Mat3<L = f64> {
    /// First column (image of x).
    pub x: Vec3<L>,
    /// Second column (image of y).
    pub y: Vec3<L>,
    /// Third column (image of z).
    pub z: Vec3<L>,
}

impl<L: Lane> Mat3<L> {
    /// The identity.
    #[inline(always)]
    pub fn identity() -> Self {
        let (o, i) = (L::zero(), L::one());
        Self {
            x: vec3(i, o, o),
            y: vec3(o, i, o),
            z: vec3(o, o, i),
        }
    }
    /// The transposed matrix (the inverse of a rotation).
    #[inline(always)]
    pub fn transpose(self) -> Self {
        Self {
            x: vec3(self.x.x, self.y.x, self.z.x),
            y: vec3(self.x.y, self.y.y, self.z.y),
            z: vec3(self.x.z, self.y.z, self.z.z),
        }
    }
    /// `selfᵀ v` without forming the transpose.
    #[inline(always)]
    pub fn transpose_mul(self, v: Vec3<L>) -> Vec3<L> {
        vec3(self.x.dot(v), self.y.dot(v), self.z.dot(v))
    }
    /// Matrix of lane `k`.
    #[inline(always)]
    pub fn lane(self, k: usize) -> Mat3<f64> {
        Mat3 {
            x: self.x.lane(k),
            y: self.y.lane(k),
            z: self.z.lane(k),
        }
    }
}

impl<L: Lane> Mul<Vec3<L>> for Mat3<L> {
    type Output = Vec3<L>;
    #[inline(always)]
    fn mul(self, v: Vec3<L>) -> Vec3<L> {
        self.x * v.x + self.y * v.y + self.z * v.z
    }
}
impl<L: Lane> Mul for Mat3<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        Self {
            x: self * b.x,
            y: self * b.y,
            z: self * b.z,
        }
    }
}

/// A symmetric 3×3 tensor, mostly a rotational inertia (kg·m²).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)]
pub struct Sym3<L = f64> {
    pub xx: L,
    pub yy: L,
    pub zz: L,
    pub xy: L,
    pub xz: L,
    pub yz: L,
}

impl<L: Lane> Sym3<L> {
    /// The null tensor.
    #[inline(always)]
    pub fn zero() -> Self {
        Self {
            xx: L::zero(),
            yy: L::zero(),
            zz: L::zero(),
            xy: L::zero(),
            xz: L::zero(),
            yz: L::zero(),
        }
    }
    /// The tensor `R self Rᵀ`, that is `self` seen from the frame that `R` turns into.
    #[inline(always)]
    pub fn rotated(self, r: Mat3<L>) -> Self {
        let a = Mat3 {
            x: vec3(self.xx, self.xy, self.xz),
            y: vec3(self.xy, self.yy, self.yz),
            z: vec3(self.xz, self.yz, self.zz),
        };
        let b = r * a; // columns R·A; row i of the product with Rᵀ needs rows of both
        let row = |m: &Mat3<L>, i: usize| match i {
            0 => vec3(m.x.x, m.y.x, m.z.x),
            1 => vec3(m.x.y, m.y.y, m.z.y),
            _ => vec3(m.x.z, m.y.z, m.z.z),
        };
        let (r0, r1, r2) = (row(&r, 0), row(&r, 1), row(&r, 2));
        let (b0, b1, b2) = (row(&b, 0), row(&b, 1), row(&b, 2));
        Self {
            xx: b0.dot(r0),
            yy: b1.dot(r1),
            zz: b2.dot(r2),
            xy: b0.dot(r1),
            xz: b0.dot(r2),
            yz: b1.dot(r2),
        }
    }
    /// `m (|c|² 1 − c cᵀ)`: the contribution of a point mass at `c` to an inertia about the origin.
    #[inline(always)]
    pub fn point_mass(m: L, c: Vec3<L>) -> Self {
        let (x, y, z) = (c.x * m, c.y * m, c.z * m);
        Self {
            xx: y * c.y + z * c.z,
            yy: x * c.x + z * c.z,
            zz: x * c.x + y * c.y,
            xy: -(x * c.y),
            xz: -(x * c.z),
            yz: -(y * c.z),
        }
    }
    /// Tensor of lane `k`.
    #[inline(always)]
    pub fn lane(self, k: usize) -> Sym3<f64> {
        Sym3 {
            xx: self.xx.lane(k),
            yy: self.yy.lane(k),
            zz: self.zz.lane(k),
            xy: self.xy.lane(k),
            xz: self.xz.lane(k),
            yz: self.yz.lane(k),
        }
    }
    /// Replaces the tensor of lane `k`.
    pub fn set_lane(&mut self, k: usize, s: Sym3<f64>) {
        self.xx.set_lane(k, s.xx);
        self.yy.set_lane(k, s.yy);
        self.zz.set_lane(k, s.zz);
        self.xy.set_lane(k, s.xy);
        self.xz.set_lane(k, s.xz);
        self.yz.set_lane(k, s.yz);
    }
}

impl Sym3<f64> {
    /// The same tensor in every lane.
    #[inline(always)]
    pub fn diagonal(xx: f64, yy: f64, zz: f64) -> Self {
        Self {
            xx,
            yy,
            zz,
            xy: 0.0,
            xz: 0.0,
            yz: 0.0,
        }
    }
}

impl<L: Lane> Mul<Vec3<L>> for Sym3<L> {
    type Output = Vec3<L>;
    #[inline(always)]
    fn mul(self, v: Vec3<L>) -> Vec3<L> {
        vec3(
            self.xx * v.x + self.xy * v.y + self.xz * v.z,
            self.xy * v.x + self.yy * v.y + self.yz * v.z,
            self.xz * v.x + self.yz * v.y + self.zz * v.z,
        )
    }
}
impl<L: Lane> Add for Sym3<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self {
            xx: self.xx + b.xx,
            yy: self.yy + b.yy,
            zz: self.zz + b.zz,
            xy: self.xy + b.xy,
            xz: self.xz + b.xz,
            yz: self.yz + b.yz,
        }
    }
}
impl<L: Lane> Sub for Sym3<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self {
            xx: self.xx - b.xx,
            yy: self.yy - b.yy,
            zz: self.zz - b.zz,
            xy: self.xy - b.xy,
            xz: self.xz - b.xz,
            yz: self.yz - b.yz,
        }
    }
}
impl<L: Lane> Mul<L> for Sym3<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: L) -> Self {
        Self {
            xx: self.xx * s,
            yy: self.yy * s,
            zz: self.zz * s,
            xy: self.xy * s,
            xz: self.xz * s,
            yz: self.yz * s,
        }
    }
}
impl<L: Lane> AddAssign for Sym3<L> {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}
