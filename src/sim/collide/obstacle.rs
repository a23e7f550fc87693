//! Bodies of a world that are not figures.

use super::shape::Capsule;
use crate::math::hash::Fnv;
use crate::math::vec3::vec3;
use crate::math::{Mat3, Quat, Vec3};
use serde::{Deserialize, Serialize};

/// Largest number of obstacles in one world.
pub const MAX_OBSTACLES: usize = 256;
/// Default friction coefficient of an obstacle, also used between two figures: wood or cloth on skin and cloth.
pub const OBSTACLE_FRICTION: f64 = 0.6;

/// Shape of an obstacle in its own frame, whose origin is its centre of mass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Shape {
    /// A ball.
    Sphere {
        /// m.
        radius: f64,
    },
    /// A cylinder along z with round ends.
    Capsule {
        /// m.
        radius: f64,
        /// Half the length of the cylinder, m.
        half_length: f64,
    },
    /// A box.
    Box {
        /// Half of its edges, m.
        half: Vec3,
    },
    /// The half-space below z = 0 of its frame; cannot move freely.
    Plane,
}

impl Shape {
    /// Axis of a round shape.
    pub fn capsule(&self) -> Option<Capsule> {
        match *self {
            Self::Sphere { radius } => Some((radius, 0.0)),
            Self::Capsule {
                radius,
                half_length,
            } => Some((radius, half_length)),
            _ => None,
        }
        .map(|(r, l)| Capsule {
            a: vec3(0.0, 0.0, -l),
            b: vec3(0.0, 0.0, l),
            ra: r,
            rb: r,
        })
    }

    /// Radius of a ball around the origin that holds the shape; infinite for a plane.
    pub fn reach(&self) -> f64 {
        match *self {
            Self::Sphere { radius } => radius,
            Self::Capsule {
                radius,
                half_length,
            } => radius + half_length,
            Self::Box { half } => half.norm(),
            Self::Plane => f64::INFINITY,
        }
    }

    /// Principal moments of inertia of a solid of uniform density and unit mass, m².
    pub fn unit_inertia(&self) -> Vec3 {
        match *self {
            Self::Sphere { radius } => vec3(1.0, 1.0, 1.0) * (0.4 * radius * radius),
            Self::Capsule {
                radius: r,
                half_length: l,
            } => {
                // A cylinder of length 2l and a ball cut in two; shares by volume.
                let (cylinder, ball) = (2.0 * l, 4.0 / 3.0 * r);
                let total = cylinder + ball;
                let (c, b) = (cylinder / total, ball / total);
                let across =
                    c * (r * r / 4.0 + l * l / 3.0) + b * (0.4 * r * r + l * l + 0.75 * l * r);
                let around = c * 0.5 * r * r + b * 0.4 * r * r;
                vec3(across, across, around)
            }
            Self::Box { half: h } => {
                let s = |a: f64, b: f64| (a * a + b * b) / 3.0;
                vec3(s(h.y, h.z), s(h.x, h.z), s(h.x, h.y))
            }
            Self::Plane => vec3(1.0, 1.0, 1.0),
        }
    }
}

/// How an obstacle moves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Mobility {
    /// Not at all.
    Fixed,
    /// With its given velocity, whatever it hits.
    Led,
    /// As a rigid body of this mass, kg.
    Free(f64),
}

/// All properties of an obstacle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ObstacleSetup {
    /// Name, for people.
    pub name: String,
    /// Shape.
    pub shape: Shape,
    /// How it moves.
    pub mobility: Mobility,
    /// Coulomb friction coefficient; the smaller one of a pair counts.
    pub friction: f64,
    /// Centre, world, m.
    pub position: Vec3,
    /// `world_from_obstacle`.
    pub rotation: Quat,
    /// Velocity of the centre, m/s.
    pub velocity: Vec3,
    /// Angular velocity, world axes, rad/s.
    pub angular_velocity: Vec3,
}

/// One obstacle of a world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Obstacle {
    pub(crate) setup: ObstacleSetup,
    /// Angular momentum about the centre, world axes, kg·m²/s, which a free body conserves.
    pub(crate) spin: Vec3,
    /// Mean force on it over the last tick, world axes, N.
    pub(crate) force: Vec3,
    /// The cluster of bodies that it is near in this tick.
    #[serde(skip)]
    pub(crate) cluster: usize,
}

/// A free body that turns faster is slowed down to this, rad/s.
const MAX_SPIN: f64 = 200.0;
/// A free body that flies faster is slowed down to this, m/s.
const MAX_SPEED: f64 = 200.0;

impl Obstacle {
    pub(crate) fn new(setup: ObstacleSetup) -> Self {
        let mut out = Self {
            setup,
            spin: Vec3::zero(),
            force: Vec3::zero(),
            cluster: 0,
        };
        out.setup.rotation = out.setup.rotation.normalized();
        if out.setup.mobility == Mobility::Fixed {
            out.setup.velocity = Vec3::zero();
            out.setup.angular_velocity = Vec3::zero();
        }
        out.spin = out.inertia_times(out.setup.angular_velocity);
        out
    }

    /// Its properties, with its present pose and velocity.
    pub fn setup(&self) -> &ObstacleSetup {
        &self.setup
    }
    /// Mean contact force on it over the last tick, world axes, N.
    pub fn force(&self) -> Vec3 {
        self.force
    }
    /// Mass, kg; `None` unless it moves freely.
    pub fn mass(&self) -> Option<f64> {
        match self.setup.mobility {
            Mobility::Free(m) => Some(m),
            _ => None,
        }
    }
    /// Angular momentum about its centre, world axes, kg·m²/s.
    pub fn spin(&self) -> Vec3 {
        self.spin
    }
    /// Axes of its frame in the world.
    pub fn axes(&self) -> Mat3 {
        self.setup.rotation.to_mat3()
    }

    fn moments(&self) -> Vec3 {
        self.setup.shape.unit_inertia() * self.mass().unwrap_or(1.0)
    }
    fn inertia_times(&self, w: Vec3) -> Vec3 {
        let (r, i) = (self.axes(), self.moments());
        let l = r.transpose_mul(w);
        r * vec3(i.x * l.x, i.y * l.y, i.z * l.z)
    }
    /// Inverse of the inertia about the centre, applied to a moment of momentum.
    pub(crate) fn solve_inertia(&self, l: Vec3) -> Vec3 {
        let (r, i) = (self.axes(), self.moments());
        let w = r.transpose_mul(l);
        r * vec3(w.x / i.x, w.y / i.y, w.z / i.z)
    }
    /// Inertia about the centre, world axes: columns.
    pub(crate) fn inertia(&self) -> [Vec3; 3] {
        [Vec3::X, Vec3::Y, Vec3::Z].map(|e| self.inertia_times(e))
    }
    /// Position and axes after `t` seconds at its present velocity.
    pub(crate) fn pose_after(&self, t: f64) -> (Vec3, Mat3) {
        let s = &self.setup;
        if t == 0.0 || s.mobility == Mobility::Fixed {
            return (s.position, self.axes());
        }
        let turned = Quat::exp(s.angular_velocity * t) * s.rotation;
        (s.position + s.velocity * t, turned.normalized().to_mat3())
    }
    /// Velocity of a world point that moves with it.
    pub(crate) fn point_velocity(&self, p: Vec3) -> Vec3 {
        self.setup.velocity + self.setup.angular_velocity.cross(p - self.setup.position)
    }

    /// Adds pose and momenta to a hash.
    pub(crate) fn add_to(&self, h: &mut Fnv) {
        let s = &self.setup;
        h.f64s(&s.position.to_array());
        h.f64s(&s.rotation.to_xyzw());
        h.f64s(&s.velocity.to_array());
        h.f64s(&self.spin.to_array());
    }

    /// Takes an impulse and a moment impulse about the centre.
    pub(crate) fn push(&mut self, impulse: Vec3, moment: Vec3) {
        let Some(m) = self.mass() else { return };
        self.setup.velocity += impulse * (1.0 / m);
        self.spin += moment;
    }

    /// Moves for `h` seconds with its present momenta.
    pub(crate) fn advance(&mut self, h: f64) {
        if self.setup.mobility == Mobility::Fixed {
            return;
        }
        if self.mass().is_some() {
            // Conserve angular momentum and derive the angular velocity: a long body may tumble, but gains no energy.
            let w = self.solve_inertia(self.spin);
            let fast = w.norm();
            if fast > MAX_SPIN {
                self.spin = self.spin * (MAX_SPIN / fast);
            }
            let speed = self.setup.velocity.norm();
            if speed > MAX_SPEED {
                self.setup.velocity = self.setup.velocity * (MAX_SPEED / speed);
            }
            self.setup.angular_velocity = self.solve_inertia(self.spin);
        }
        let s = &mut self.setup;
        s.position += s.velocity * h;
        s.rotation = (Quat::exp(s.angular_velocity * h) * s.rotation).normalized();
        if self.mass().is_some() {
            self.setup.angular_velocity = self.solve_inertia(self.spin);
        }
    }
}
