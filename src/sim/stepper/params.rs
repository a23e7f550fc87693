//! Tunable numbers of everything that moves a body in a tick.

use crate::params::Param;

/// The motors of a substep.
pub mod motors {
    crate::params::params! {
        /// Gain that is left for the second try of a substep that did not converge.
        SOFTENING: f64 = 0.01, "1", 1e-3..=0.5, "numerical";
    }
}

/// Contact with the ground in a substep.
pub mod contact {
    crate::params::params! {
        /// Compliance R of a contact.
        COMPLIANCE: f64 = 1e-4, "1/kg", 1e-6..=1e-2, "docs/equations.md";
        /// Contact points lower than this take part in the solve even if they move away.
        SPECULATIVE_HEIGHT: f64 = 0.02, "m", 0.005..=0.05, "docs/tick.md";
        /// Share of a penetration beyond the slop that is taken back per substep.
        PENETRATION_RETURN: f64 = 0.2, "1", 0.05..=1, "numerical";
        /// Penetration that is left alone: resting feet neither hover nor chatter. With 1 mm the feet of a standing
        /// figure sink by that much, and nearly straight knees drift.
        PENETRATION_SLOP: f64 = 1e-4, "m", 0..=1e-3, "numerical";
        /// Fastest push-out of a penetrating point.
        PENETRATION_SPEED: f64 = 1.0, "m/s", 0.1..=5, "numerical";
        /// Most Newton iterations of one substep. 2 to 6 are typical; a foot that strikes while joints are near
        /// their limits takes up to 70, and a step cut short at 30 there flings light joints.
        ITERATIONS: u32 = 80, "rounds", 20..=200, "numerical";
        /// Residual at which a substep counts as solved.
        TOLERANCE: f64 = 1e-6, "N·m·s", 1e-9..=1e-4, "numerical";
        /// Rates, and speeds in m/s, beyond this are braked: far above what bodies do (a pitcher's shoulder turns
        /// at 130 rad/s), low enough that a substep resolves it.
        LARGEST_SPEED: f64 = 200.0, "rad/s", 140..=1000, "docs/tick.md";
    }
}

/// Contact of a body with itself.
pub mod self_contact {
    crate::params::params! {
        /// Most solves of one substep after its first, each with corrected impulses.
        ROUNDS: u32 = 3, "rounds", 1..=10, "docs/tick.md#self-contact";
        /// How much deeper than in the motion a pair may be without a force: capsules are off from the surface by as
        /// much.
        SLACK: f64 = 0.03, "m", 0..=0.05, "docs/tick.md#self-contact";
        /// Stiffness of what is between bones where limbs press on each other or on the trunk: 100 N press 1 cm.
        STIFFNESS: f64 = 1e4, "N/m", 2e3..=1e5, "docs/tick.md#self-contact";
        /// Damping over stiffness: about critical for an arm.
        RELAXATION: f64 = 0.02, "s", 0..=0.1, "docs/tick.md#self-contact";
        /// Rate at which a pair may still come nearer than it may: 0.1 mm in a substep.
        TOLERANCE: f64 = 0.01, "m/s", 1e-6..=0.1, "numerical";
    }
}

/// A load in two hands: a bar of fixed length between them.
pub mod bar {
    crate::params::params! {
        /// Share of an error of the bar's length that is taken back per substep.
        RETURN: f64 = 0.3, "1", 0.05..=1, "numerical";
        /// Fastest way back to its length.
        RETURN_SPEED: f64 = 0.5, "m/s", 0.1..=2, "numerical";
        /// Most solves for the impulse of a bar.
        ITERATIONS: u32 = 6, "rounds", 2..=20, "numerical";
        /// Rate of the bar's length that is left.
        TOLERANCE: f64 = 1e-6, "m/s", 1e-9..=1e-4, "numerical";
    }
}

/// Non-physical help on the pelvis.
pub mod assist {
    crate::params::params! {
        /// κ of the force over the body mass at assist 1.
        STIFFNESS: f64 = 50.0, "1", 10..=200, "docs/tick.md";
        /// Part of a pose error that is taken back per substep.
        RETURN: f64 = 0.5, "1", 0.1..=1, "numerical";
        /// Fastest way back to the desired position.
        RETURN_SPEED: f64 = 1.5, "m/s", 0.5..=5, "numerical";
        /// Fastest way back to the desired rotation.
        RETURN_RATE: f64 = 3.0, "rad/s", 1..=10, "numerical";
        /// Largest force over the body's weight at assist 1.
        LARGEST_FORCE: f64 = 2.0, "1", 0.5..=5, "docs/tick.md";
        /// Largest moment over weight times stature at assist 1.
        LARGEST_MOMENT: f64 = 0.5, "1", 0.1..=2, "docs/tick.md";
        /// Inertia about the pelvis over mass times stature squared.
        INERTIA: f64 = 0.05, "1", 0.02..=0.1, "derivation";
        /// Cost to a plan of half the largest force or moment, at assist 1.
        PLANNED_COST: f64 = 10.0, "1", 1..=100, "docs/tick.md";
    }
}

/// The pull on the pelvis of a figure whose motion is being lost.
pub mod pull {
    crate::params::params! {
        /// Angular frequency of the pull.
        FREQUENCY: f64 = 8.0, "rad/s", 4..=16, "docs/rehearsal.md#live-help";
        /// Largest moment over largest force times stature: the force acts within half a stature of the pelvis.
        LEVER: f64 = 0.5, "1", 0.1..=0.5, "docs/rehearsal.md#live-help";
    }
}

/// All groups with their names.
pub fn groups() -> [(&'static str, &'static [Param]); 6] {
    [
        ("motors", motors::ALL),
        ("contact", contact::ALL),
        ("self_contact", self_contact::ALL),
        ("bar", bar::ALL),
        ("assist", assist::ALL),
        ("pull", pull::ALL),
    ]
}
