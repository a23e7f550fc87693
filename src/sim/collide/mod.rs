//! Collisions between figures and with obstacles (docs/adr/0009-collisions.md).
//!
//! * [`shape`]: capsules fitted to the segments, and the shapes of obstacles.
//! * [`obstacle`]: bodies that are not figures: fixed, led, or free.
//! * [`broad`]: finds the bodies that may meet within a tick.
//! * [`narrow`]: nearest points of two shapes.
//! * [`island`]: one convex problem for all bodies that touch each other.

pub mod broad;
pub mod island;
pub mod narrow;
pub mod obstacle;
pub mod shape;

pub use crate::touch::{MAX_TOUCHES, ObstacleKey, Other, Touch};
pub use obstacle::{MAX_OBSTACLES, Mobility, OBSTACLE_FRICTION, Obstacle, ObstacleSetup, Shape};
