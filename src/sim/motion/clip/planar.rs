//! Places on the floor and headings.

use crate::body::Posture;
use crate::math::{Quat, Vec3, trig};
use crate::motion::target::Target;
use serde::{Deserialize, Serialize};

/// A turn about the vertical through the origin, then a shift along the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlanarTransform {
    /// Shift forward, m.
    pub x: f64,
    /// Shift to the left, m.
    pub y: f64,
    /// Turn to the left, rad.
    pub yaw: f64,
}

/// The angle of the same direction within −π…π.
fn reduced(angle: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    angle - (angle / turn).round_ties_even() * turn
}

impl PlanarTransform {
    /// Whether every component is finite.
    pub fn is_finite(self) -> bool {
        [self.x, self.y, self.yaw].iter().all(|x| x.is_finite())
    }

    /// Its turn.
    pub fn rotation(self) -> Quat {
        Quat::exp(Vec3::Z * reduced(self.yaw))
    }

    /// Image of a point.
    pub fn point(self, p: Vec3) -> Vec3 {
        let q = self.rotation().rotate(p);
        Vec3 {
            x: q.x + self.x,
            y: q.y + self.y,
            z: q.z,
        }
    }

    /// `self` after `first`.
    pub fn after(self, first: Self) -> Self {
        let p = self.point(Vec3 {
            x: first.x,
            y: first.y,
            z: 0.0,
        });
        Self {
            x: p.x,
            y: p.y,
            yaw: self.yaw + first.yaw,
        }
    }

    /// `self` applied `count` times (backwards if negative), in closed form.
    pub fn power(self, count: f64) -> Self {
        // Σ_{j<n} R^j p = sin(nψ/2)/sin(ψ/2) · R((n−1)ψ/2) p
        let n = count;
        let half = 0.5 * reduced(self.yaw);
        let (s, _) = trig::sin_cos(half);
        let gain = if s.abs() < 1e-9 {
            n // nearly no turn: the steps line up
        } else {
            trig::sin_cos(reduced(n * half)).0 / s
        };
        let p = Quat::exp(Vec3::Z * reduced((n - 1.0) * half)).rotate(Vec3 {
            x: self.x * gain,
            y: self.y * gain,
            z: 0.0,
        });
        Self {
            x: p.x,
            y: p.y,
            yaw: reduced(2.0 * n * half),
        }
    }

    /// Moves a posture.
    pub fn apply_posture(self, posture: &mut Posture) {
        posture.root_position = self.point(posture.root_position);
        posture.root_rotation = (self.rotation() * posture.root_rotation).normalized();
    }

    /// A target, moved: pelvis pose, velocity and acceleration.
    pub fn apply(self, target: &Target) -> Target {
        let mut moved = target.clone();
        self.apply_to(&mut moved);
        moved
    }

    /// Like [`Self::apply`], in place.
    pub fn apply_to(self, target: &mut Target) {
        self.apply_posture(&mut target.posture);
        let rotation = self.rotation();
        for v in [&mut target.velocity, &mut target.acceleration] {
            for start in [0, 3] {
                let turned = rotation.rotate(Vec3 {
                    x: v[start],
                    y: v[start + 1],
                    z: v[start + 2],
                });
                v[start..start + 3].copy_from_slice(&turned.to_array());
            }
        }
    }
}
