//! Places on the ground.

use serde::{Deserialize, Serialize};

/// A place on the ground: world x, y (m) and heading about z (rad).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// World x, m.
    pub x: f64,
    /// World y, m.
    pub y: f64,
    /// Heading about z, rad.
    pub yaw: f64,
}
