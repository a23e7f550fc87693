//! Obstacles and their changes.

use crate::status::Fault;
use sinew_physics::collide::{Mobility, ObstacleSetup, Shape};
use sinew_physics::math::{Quat, Vec3};

/// The mobility of an obstacle, without its mass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObstacleMobility {
    /// Not at all.
    Fixed,
    /// It moves with its given velocity.
    Led,
    /// It moves as a rigid body.
    Free,
}

/// Reason why a plane cannot be free.
pub const FREE_PLANE: &str = "a plane cannot move freely";

/// Changes of an obstacle; `None` leaves the value that it has at that tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObstacleUpdate {
    /// Shape.
    pub shape: Option<Shape>,
    /// Mobility.
    pub mobility: Option<ObstacleMobility>,
    /// Mass of a free one, kg.
    pub mass: Option<f64>,
    /// Friction.
    pub friction: Option<f64>,
    /// Position (m) and rotation.
    pub pose: Option<(Vec3, Quat)>,
    /// Velocity, m/s.
    pub velocity: Option<Vec3>,
    /// Angular velocity, rad/s.
    pub angular_velocity: Option<Vec3>,
}

impl ObstacleUpdate {
    /// The obstacle after the update.
    ///
    /// # Errors
    /// A free plane, or a free obstacle without mass.
    pub fn apply(self, now: &ObstacleSetup) -> Result<ObstacleSetup, Fault> {
        let shape = self.shape.unwrap_or(now.shape);
        let free = |mass: Option<f64>| match mass {
            _ if shape == Shape::Plane => Err(Fault::invalid("obstacle.mobility", FREE_PLANE)),
            Some(mass) => Ok(Mobility::Free(mass)),
            None => Err(Fault::invalid("obstacle.mass_kg", "must be given")),
        };
        let had = match now.mobility {
            Mobility::Free(mass) => Some(mass),
            Mobility::Fixed | Mobility::Led => None,
        };
        let mobility = match self.mobility {
            Some(ObstacleMobility::Fixed) => Mobility::Fixed,
            Some(ObstacleMobility::Led) => Mobility::Led,
            Some(ObstacleMobility::Free) => free(self.mass.or(had))?,
            None if had.is_some() => free(self.mass.or(had))?,
            None => now.mobility,
        };
        let (position, rotation) = self.pose.unwrap_or((now.position, now.rotation));
        Ok(ObstacleSetup {
            name: now.name.clone(),
            shape,
            mobility,
            friction: self.friction.unwrap_or(now.friction),
            position,
            rotation,
            velocity: self.velocity.unwrap_or(now.velocity),
            angular_velocity: self.angular_velocity.unwrap_or(now.angular_velocity),
        })
    }
}

/// One obstacle.
#[derive(Clone, Debug)]
pub struct ObstacleInfo {
    /// Last part of its name.
    pub id: String,
    /// Its number; numbers count up in a world.
    pub number: u64,
    /// Its setup, with its present pose and velocity.
    pub setup: ObstacleSetup,
    /// Mean force on it over the last tick, N.
    pub force: Vec3,
}
