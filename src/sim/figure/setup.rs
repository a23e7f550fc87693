//! What a figure is made of and how it is controlled: set at creation, changeable between ticks.

use crate::sim::body::SegmentId;
use crate::sim::math::Vec3;

pub use crate::sim::strength::StrengthScale;

/// Who computes accelerations and torques.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ControllerKind {
    /// The paper's controller, equations (4)–(17), with the safeguards of ALGORITHM §7–9.
    Paper,
    /// Whole-body quadratic program solved through its dual, ALGORITHM §14.1–14.2.
    Modern,
    /// Strength-limited motors alone, ALGORITHM §14.3; what is left after balance is lost.
    Motors,
}

/// Who moves the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepperKind {
    /// Torques drive full rigid-body dynamics with contact, ALGORITHM §14.3.
    Torque,
    /// The controller's accelerations are applied as they are; the support holds, tips about an edge or a vertex, or flies (ALGORITHM §6).
    /// For the paper's controller. Motors alone need torques: with them this is `Torque`.
    Kinematic,
}

/// Norm in which the change of acceleration is least (10), ALGORITHM §8.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Metric {
    /// `W = I`, the paper's.
    Identity,
    /// `W = H`.
    Inertia,
    /// `W = H²`: torques are clipped.
    Torque,
}

/// How (12) orders centre of mass and end-effectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Priority {
    /// As printed.
    Paper,
    /// Exact task priority.
    Nested,
}

/// How the ground reaction is shared between supports, ALGORITHM §5.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Share {
    /// Ratios (2) times the total force.
    Paper,
    /// Least weighted forces with the right total wrench (S2).
    Balanced,
}

/// Choices and gains of the tracking controllers. Defaults are those of ALGORITHM.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlParams {
    /// Blend of position and velocity demand in (4) per 1/30 s; used when `horizon` is `None`.
    pub alpha: f64,
    /// Time constant T of the demand, s (S3); `None` is the paper's dead-beat law.
    pub horizon: Option<f64>,
    /// Norm of (10).
    pub metric: Metric,
    /// Order of (12).
    pub priority: Priority,
    /// Sharing rule.
    pub share: Share,
    /// Let members of L go to their limit instead of staying where (7)–(11) left them.
    pub to_limit: bool,
    /// Tilting support (S1).
    pub tilt: bool,
    /// Keep the demanded CoM acceleration feasible for the ZMP (ALGORITHM §9).
    pub zmp_feasible: bool,
    /// Control both hands as end-effectors.
    pub track_hands: bool,
    /// Control the centre of mass.
    pub track_com: bool,
    /// Let torques move a figure with the kinematic stepper while prescribed accelerations cannot go on (ALGORITHM §6).
    pub hand_over: bool,
    /// Step when the capture point has left the feet (modern controller).
    pub protective_steps: bool,
}

impl Default for ControlParams {
    fn default() -> Self {
        Self {
            alpha: 0.2,
            horizon: Some(0.1),
            metric: Metric::Identity,
            priority: Priority::Nested,
            share: Share::Balanced,
            to_limit: false,
            tilt: true,
            zmp_feasible: true,
            track_hands: true,
            track_com: true,
            hand_over: true,
            protective_steps: true,
        }
    }
}

impl ControlParams {
    /// The paper to the letter, all safeguards off: dead-beat demand, W = I, (12) as printed, sharing by ratios (2), a support that tips but
    /// whose torques do not know it. Meant for [`StepperKind::Kinematic`], 30 ticks a second and a body without armature; for comparison only.
    pub fn paper2000() -> Self {
        Self {
            horizon: None,
            metric: Metric::Identity,
            priority: Priority::Paper,
            share: Share::Paper,
            tilt: false,
            zmp_feasible: false,
            hand_over: false,
            ..Self::default()
        }
    }
}

/// A disturbance of one figure. Times are world seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Perturbation {
    /// A point mass held by a segment.
    Load {
        /// Carrying segment.
        segment: SegmentId,
        /// Where, segment frame, m.
        point: Vec3,
        /// Mass, kg, 0…500.
        mass: f64,
        /// Picked up at, s.
        from: f64,
        /// Dropped at, s; `f64::INFINITY` = never.
        to: f64,
    },
    /// A force over time (a push of J N·s over d seconds is a force of J/d).
    Force {
        /// Pushed segment.
        segment: SegmentId,
        /// Where, segment frame, m.
        point: Vec3,
        /// World axes, N.
        force: Vec3,
        /// Begins at, s.
        from: f64,
        /// Ends at, s.
        to: f64,
    },
}
