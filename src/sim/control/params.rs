//! Tunable numbers of the modes of control.

use crate::params::Param;

/// Stiffness of motors: the rate error at which a motor gives its full torque.
pub mod saturation {
    crate::params::params! {
        /// Motors alone.
        ALONE_SPEED: f64 = 0.005, "rad/s", 0.001..=0.1, "numerical";
        /// With the torque of the paper's controller as feed-forward.
        FEED_FORWARD_SPEED: f64 = 1.0, "rad/s", 0.1..=5, "docs/tick.md";
        /// With that of the modern controller: legs give a little when a foot lands.
        MODERN_SPEED: f64 = 3.0, "rad/s", 0.5..=10, "docs/tick.md";
    }
}

/// All groups with their names.
pub fn groups() -> [(&'static str, &'static [Param]); 1] {
    [("saturation", saturation::ALL)]
}
