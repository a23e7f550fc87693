//! Tunable numbers of prescribed accelerations.

use crate::params::Param;

/// The prescribed step: accelerations and inelastic impacts.
pub mod prescribed_step {
    crate::params::params! {
        /// A point that arrives faster than this strikes the ground; a slower one settles.
        IMPACT_SPEED: f64 = 0.05, "m/s", 0.01..=0.2, "docs/adr/0012-kinematic-stepper.md";
        /// Points below this height take part in an impact.
        IMPACT_HEIGHT: f64 = 0.006, "m", 0.001..=0.02, "docs/tick.md";
        /// While tilting, only points this close to the pivot line carry load.
        PIVOT_REACH: f64 = 0.012, "m", 0.001..=0.05, "docs/adr/0012-kinematic-stepper.md";
        /// Compliance of a touching point in an impact.
        COMPLIANCE: f64 = 1e-6, "1/kg", 1e-9..=1e-4, "numerical";
        /// Residual of an impact.
        TOLERANCE: f64 = 1e-9, "N·m·s", 1e-12..=1e-6, "numerical";
        /// Torque beyond strength that counts as rounding, relative to the limit.
        LIMIT_TOLERANCE: f64 = 1e-9, "1", 0..=1e-6, "numerical";
        /// A foot tilted less than this when it comes to hold is laid flat: 1 − cos of 3°.
        NEARLY_FLAT: f64 = 1.4e-3, "1", 0..=0.01, "docs/adr/0012-kinematic-stepper.md";
        /// Part of the remaining tilt that is laid flat per tick.
        SETTLE: f64 = 0.2, "1", 0.05..=1, "docs/adr/0012-kinematic-stepper.md";
        /// Joint speed that prescribed accelerations may reach; beyond it torques take over.
        SPEED_CAP: f64 = 15.0, "rad/s", 5..=50, "docs/adr/0012-kinematic-stepper.md";
        /// Torques give back to prescribed accelerations after the figure has stood so long on flat feet with
        /// strength to spare.
        CALM_TIME: f64 = 0.5, "s", 0.1..=2, "docs/adr/0012-kinematic-stepper.md";
        /// A part other than a foot arrives if it would reach the floor within this number of ticks.
        ARRIVAL_TICKS: f64 = 2.0, "1", 1..=5, "docs/adr/0012-kinematic-stepper.md";
    }
}

/// All groups with their names.
pub fn groups() -> [(&'static str, &'static [Param]); 1] {
    [("prescribed_step", prescribed_step::ALL)]
}
