//! Projection onto the friction cone `|f_t| ≤ μ f_n` (normal = z) and its derivative.

use crate::math::Vec3;

/// Region of the projected point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Region {
    /// Apart: no force.
    Open,
    /// On the cone: slipping.
    Slip,
    /// Inside the cone: sticking.
    Stick,
}

/// Nearest point of the cone to `u` (`docs/equations.md`, 14.2).
#[inline(always)]
pub fn project(u: Vec3, mu: f64) -> (Vec3, Region) {
    let t = (u.x * u.x + u.y * u.y).sqrt();
    if t <= mu * u.z {
        (u, Region::Stick)
    } else if mu * t <= -u.z {
        (Vec3::zero(), Region::Open)
    } else {
        let s = (u.z + mu * t) / (1.0 + mu * mu);
        let k = mu * s / t;
        (
            Vec3 {
                x: k * u.x,
                y: k * u.y,
                z: s,
            },
            Region::Slip,
        )
    }
}

/// Derivative of [`project`] at `u` in a region other than `Open`, a symmetric positive semidefinite 3×3 matrix.
#[inline(always)]
pub fn derivative(u: Vec3, mu: f64, region: Region) -> [[f64; 3]; 3] {
    match region {
        Region::Open => [[0.0; 3]; 3],
        Region::Stick => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        Region::Slip => {
            let t = (u.x * u.x + u.y * u.y).sqrt();
            let q = 1.0 / (1.0 + mu * mu);
            let s = (u.z + mu * t) * q;
            let e = [mu * u.x / t, mu * u.y / t, 1.0];
            let w = [-u.y / t, u.x / t];
            let side = mu * s / t;
            let mut d = [[0.0; 3]; 3];
            for a in 0..3 {
                for b in 0..3 {
                    d[a][b] = e[a] * e[b] * q;
                }
            }
            for a in 0..2 {
                for b in 0..2 {
                    d[a][b] += w[a] * w[b] * side;
                }
            }
            d
        }
    }
}
