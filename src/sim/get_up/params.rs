//! Every tunable number of getting up. Reference poses and goals of the stages have their own tables.

use crate::params::Param;

/// Layout on the floor. Lengths refer to the reference body of the built-in motions.
pub mod layout {
    crate::params::params! {
        /// Time constant with which what is on the floor counts as where it really is.
        UPDATE_TIME: f64 = 0.1, "s", 0.05..=1, "docs/locomotion.md#getting-up";
        /// A part lower than this is on the floor.
        TOUCH_HEIGHT: f64 = 0.02, "m", 0.005..=0.05, "docs/locomotion.md#getting-up";
        /// A part lower than this will be on the floor as soon as it is leant on.
        NEAR_HEIGHT: f64 = 0.05, "m", 0.01..=0.1, "docs/locomotion.md#getting-up";
        /// A body lies on its belly whose front looks down by more than this, as a sine.
        PRONE: f64 = 0.7, "1", 0.3..=0.95, "docs/locomotion.md#getting-up";
        /// A body lies on its side that is turned by less than this from its belly.
        ON_SIDE: f64 = 1.9, "rad", 1.6..=2.5, "docs/locomotion.md#getting-up";
        /// Half the distance between the hands, reference body.
        ARMS_APART: f64 = 0.25, "m", 0.15..=0.4, "docs/locomotion.md#getting-up";
        /// A wrist is this high over a hand that lies flat, reference body.
        WRIST_HEIGHT: f64 = 0.045, "m", 0.02..=0.08, "docs/locomotion.md#getting-up";
        /// The balls of the feet lie this far behind the knees of a body that kneels with tucked toes, reference
        /// body.
        SHANK: f64 = 0.4, "m", 0.3..=0.5, "docs/locomotion.md#getting-up";
        /// A body whose centre of mass is higher has not come to lie, reference body: on hands and knees it is at 0.45.
        LYING_HEIGHT: f64 = 0.35, "m", 0.2..=0.45, "docs/locomotion.md#getting-up";
        /// Height of a hand's step, reference body.
        HAND_STEP_HEIGHT: f64 = 0.08, "m", 0.02..=0.2, "docs/locomotion.md#getting-up";
    }
}

/// Weights of the goals, squared errors in m, rad and their rates.
pub mod weights {
    crate::params::params! {
        /// Firmness of a part that carries.
        FIRM: f64 = 10.0, "1", 1..=100, "docs/locomotion.md#getting-up";
        /// Hands that lie flat.
        HAND: f64 = 5.0, "1", 1..=50, "docs/locomotion.md#getting-up";
        /// The centre of mass.
        COM: f64 = 10.0, "1", 1..=50, "docs/locomotion.md#getting-up";
        /// Joint angles of the reference pose.
        POSE: f64 = 0.01, "1", 0.001..=0.1, "docs/locomotion.md#getting-up";
        /// Change of a rate within `APPROACH`.
        STEADY: f64 = 1e-3, "1", 1e-4..=0.1, "docs/locomotion.md#getting-up";
        /// A rate.
        DAMPING: f64 = 3e-4, "1", 1e-5..=0.01, "docs/locomotion.md#getting-up";
        /// Nothing in the floor.
        FLOOR: f64 = 30.0, "1", 5..=200, "docs/locomotion.md#getting-up";
        /// Fingers to the front.
        FINGERS: f64 = 0.3, "1", 0..=2, "docs/locomotion.md#getting-up";
        /// A joint that is held at its limit.
        JOINT_LIMIT: f64 = 1e3, "1", 100..=1e5, "numerical";
    }
}

/// Inverse kinematics.
pub mod solver {
    crate::params::params! {
        /// Time constant with which goals and joint limits are approached.
        APPROACH: f64 = 0.05, "s", 0.03..=0.3, "docs/locomotion.md#getting-up";
        /// Fastest joint.
        FASTEST: f64 = 5.0, "rad/s", 1..=10, "docs/locomotion.md#getting-up";
        /// Joints stay this far from their limits.
        LIMIT_MARGIN: f64 = 0.02, "rad", 0..=0.1, "docs/locomotion.md#getting-up";
        /// Rounds of finding the joints at their limits.
        LIMIT_ROUNDS: usize = 4, "rounds", 1..=10, "numerical";
        /// A rate that is beyond its limit by less than this is at it.
        RATE_TOLERANCE: f64 = 1e-9, "rad/s", 0..=1e-6, "numerical";
    }
}

/// All groups with their names.
pub fn groups() -> [(&'static str, &'static [Param]); 3] {
    [
        ("layout", layout::ALL),
        ("weights", weights::ALL),
        ("solver", solver::ALL),
    ]
}
