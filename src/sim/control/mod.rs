//! Tracking controllers: accelerations and torques that follow the desired motion within strength.
//!
//! [`Modern`] is the default. The controller of Oshita & Makinouchi 2000 is in [`crate::paper`].

pub mod goals;
pub mod mode;
pub mod modern;
pub mod motors;
pub mod params;
pub mod rows;
#[cfg(test)]
pub(crate) mod testing;
pub mod tracking;

pub use goals::ConstraintGoal;
pub use mode::Mode;
pub use modern::{Modern, ModernMemory};
pub use motors::MotorsAlone;
pub use tracking::Law;

use crate::body::topology::{L_HAND, R_HAND, SEGMENT_COUNT};
use crate::body::{Body, DOF_COUNT, NV, SegmentId};
use crate::dynamics::Terms;
use crate::math::{Quat, Vec3};
use crate::motion::TargetPair;
use crate::report::Flags;
use crate::report::MAX_CONTACTS;
use crate::setup::ControlParams;
use crate::support::Support;
use serde::{Deserialize, Serialize};

/// Desired position and velocity of a point, world axes, at the start and at the end of the tick.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PointTarget {
    /// Position at the start, m.
    pub now: Vec3,
    /// Velocity at the start, m/s.
    pub now_velocity: Vec3,
    /// Position at the end, m.
    pub next: Vec3,
    /// Velocity at the end, m/s.
    pub next_velocity: Vec3,
}

impl PointTarget {
    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        let all = [self.now, self.now_velocity, self.next, self.next_velocity];
        all.iter().all(|v| v.is_finite())
    }

    /// Moves the point by the same amount at both times.
    pub fn shift(&mut self, by: Vec3) {
        self.now += by;
        self.next += by;
    }

    /// A point that rests at `p` (world, m).
    pub fn still(p: Vec3) -> Self {
        Self {
            now: p,
            next: p,
            ..Self::default()
        }
    }
}

/// Desired rotation of a segment, at the start and at the end of the tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RotationTarget {
    /// `world_from_segment` at the start.
    pub now: Quat,
    /// Angular velocity at the start, world axes, rad/s.
    pub now_velocity: Vec3,
    /// `world_from_segment` at the end.
    pub next: Quat,
    /// Angular velocity at the end, world axes, rad/s.
    pub next_velocity: Vec3,
}

impl RotationTarget {
    /// A segment that rests with this rotation, `world_from_segment`.
    pub fn still(rotation: Quat) -> Self {
        Self {
            now: rotation,
            next: rotation,
            ..Self::default()
        }
    }
}

/// The desired pose of a foot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FootTarget {
    /// Its ankle.
    pub ankle: PointTarget,
    /// Its rotation.
    pub rotation: RotationTarget,
}

/// An end-effector: a point of a segment with its target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effector {
    /// Segment, mostly a hand.
    pub segment: SegmentId,
    /// Point, segment frame, m.
    pub point: Vec3,
    /// Desired motion of the point.
    pub position: PointTarget,
    /// Desired rotation of the segment, if it matters.
    pub rotation: Option<RotationTarget>,
}

/// The input of a controller in one tick.
#[derive(Clone, Copy, Debug)]
pub struct ControlInput<'a> {
    /// Dynamics of the present state.
    pub terms: &'a Terms,
    /// The body (limits of angles).
    pub body: &'a Body,
    /// Contacts, ratios, polygon of the present state.
    pub support: &'a Support,
    /// Desired motion at the start and the end of the tick.
    pub target: &'a TargetPair,
    /// Centre of mass and angular momentum.
    pub centroidal: CentroidalTarget<'a>,
    /// Feet and other parts on the floor.
    pub contacts: ContactTargets<'a>,
    /// Hands that follow the desired motion in space; at most two count.
    pub effectors: &'a [Effector],
    /// Client constraints, the most important first: at most [`goals::MAX_GOALS`], of which the paper's controller
    /// takes eight.
    pub goals: &'a [ConstraintGoal],
    /// The loads in the left and the right hand of a stepping figure, kg.
    pub carried: [f64; 2],
    /// Least available torques, N·m (negative).
    pub lower: &'a [f64; DOF_COUNT],
    /// Largest available torques, N·m.
    pub upper: &'a [f64; DOF_COUNT],
    /// Choices and gains.
    pub params: &'a ControlParams,
    /// Magnitude of gravity, m/s².
    pub gravity: f64,
    /// Length of the tick, s.
    pub dt: f64,
    /// Compliance of the assist on which a plan may rely, [N²·m², N²] per unit of cost: moment and force on the pelvis;
    /// zeros without assist.
    pub assist: [f64; 2],
    /// A wrench on the pelvis that the plan may use, if there is one; it acts exactly as planned.
    pub help: Option<HelpAllowance<'a>>,
    /// Whether the accelerations are applied as they are. The controller then keeps planted feet in place, and answers
    /// overload with the accelerations of the clipped torques; strength-limited motors settle both by themselves.
    pub kinematic: bool,
}

impl ControlInput<'_> {
    /// The load in a hand, kg; loads of other segments are not known.
    pub fn carried_by(&self, segment: SegmentId) -> f64 {
        match segment {
            L_HAND => self.carried[0],
            R_HAND => self.carried[1],
            _ => 0.0,
        }
    }
}

/// A wrench on the pelvis that a plan may use: its price, its bound, and the facts by which the floor, rather than the
/// wrench, carries what it can.
#[derive(Clone, Copy, Debug)]
pub struct HelpAllowance<'a> {
    /// Compliance: [N²·m², N²] of moment and force per unit of cost.
    pub compliance: [f64; 2],
    /// Largest moment, N·m, and force, N.
    pub most: [f64; 2],
    /// Share of the last tick's wrench that costs nothing, 0…1: the price on its change.
    pub kept: f64,
    /// Heights of all contact points in the motion, by segment × 8 + vertex, m.
    pub heights: &'a [f64; MAX_CONTACTS],
    /// Force of the floor on each of them in the last tick, N.
    pub floor: &'a [Vec3; MAX_CONTACTS],
    /// Whether the motion is followed where it lies in the world, without steps of its own.
    pub as_it_lies: bool,
}

/// Desired centre of mass and centroidal angular momentum.
#[derive(Clone, Copy, Debug)]
pub struct CentroidalTarget<'a> {
    /// Centre of mass, computed with the present loads.
    pub com: &'a PointTarget,
    /// Its horizontal acceleration, world axes, m/s²; `None` for that of [`com_law`].
    pub acceleration: Option<[f64; 2]>,
    /// Angular momentum that takes precedence over the posture.
    pub momentum: Option<MomentumTarget>,
}

/// Centroidal angular momentum at a coming time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentumTarget {
    /// Angular momentum, world axes, N·m·s.
    pub value: Vec3,
    /// Time until it must be reached, s.
    pub within: f64,
}

/// How the body should touch the floor. The posture target says which feet are planted.
#[derive(Clone, Copy, Debug)]
pub struct ContactTargets<'a> {
    /// Left and right foot.
    pub feet: &'a [FootTarget; 2],
    /// Phase of the planted feet.
    pub phase: StancePhase,
    /// Whether the places of feet are known before they touch. A foot that lands turning is then stopped sooner.
    pub places_known: bool,
    /// Set while the whole body works on the floor, as when it gets up: then everything that touches, and should,
    /// carries. With `None`, feet and seats carry.
    pub floor: Option<OnFloor<'a>>,
}

/// Phase of the contact of the planted feet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StancePhase {
    /// At least one foot stays on the floor.
    #[default]
    Stance,
    /// All of them are about to leave it.
    LiftOff,
}

/// Heights between which a point of a motion of our own comes to touch the floor, m.
pub const MEANT_BY_US: (f64, f64) = (0.004, 0.012);
/// The same for a recording, which is seldom that precise, m.
pub const MEANT_BY_RECORDING: (f64, f64) = (0.02, 0.06);

/// How the body should touch the floor in the motion.
#[derive(Clone, Copy, Debug)]
pub struct OnFloor<'a> {
    /// Heights of all contact points at the end of the tick, by segment × 8 + vertex, m.
    pub heights: &'a [f64; MAX_CONTACTS],
    /// A point should touch if it is below the first height in the motion, and not at all above the second, m.
    pub meant: (f64, f64),
    /// The trunk lies on the floor: there is no balance to keep.
    pub lies: bool,
    /// It rolls over.
    pub rolls: bool,
    /// Segments that may slide.
    pub slides: &'a [bool; SEGMENT_COUNT],
}

/// The decision of a controller.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// θ̈, rad/s².
    pub joint_acceleration: [f64; DOF_COUNT],
    /// v̇ = N θ̈ + b, layout of `State::velocity`.
    pub acceleration: [f64; NV],
    /// τ within the available range, N·m.
    pub torque: [f64; DOF_COUNT],
    /// DOFs at their limit after the primary constraint, K (bit = DOF).
    pub saturated: u64,
    /// DOFs held back by the secondary constraints, L.
    pub saturated_secondary: u64,
    /// Rounds of both active sets in the last pass.
    pub iterations: u32,
    /// Safeguards that acted.
    pub flags: Flags,
    /// Zero-moment point of the decision, with the support at rest, world, m; `None` in flight.
    pub zmp: Option<Vec3>,
    /// Its signed distance inside the support polygon, m.
    pub margin: Option<f64>,
    /// The pivot about which the support tips, if it does.
    pub pivot: Option<crate::support::Pivot>,
    /// Planned moment on the pelvis, N·m, and force, N: zero without help.
    pub wrench: [Vec3; 2],
}

impl Default for Command {
    fn default() -> Self {
        Self {
            joint_acceleration: [0.0; DOF_COUNT],
            acceleration: [0.0; NV],
            torque: [0.0; DOF_COUNT],
            saturated: 0,
            saturated_secondary: 0,
            iterations: 0,
            flags: Flags::default(),
            zmp: None,
            margin: None,
            pivot: None,
            wrench: [Vec3::zero(); 2],
        }
    }
}

/// Gains of the modern controller's law for the centre of mass, 1/s² and 1/s.
pub const COM_GAIN: (f64, f64) = (25.0, 10.0);

/// Acceleration of the centre of mass at `com` moving with `velocity` that follows `target` over a tick of `dt`
/// seconds, m/s².
pub fn com_law(target: &PointTarget, com: Vec3, velocity: Vec3, dt: f64) -> Vec3 {
    (target.next_velocity - target.now_velocity) * (1.0 / dt)
        + (target.now - com) * COM_GAIN.0
        + (target.now_velocity - velocity) * COM_GAIN.1
}

/// A tracking controller. It keeps its workspace and its memory of the last tick; nothing allocates.
pub trait Controller {
    /// Decides one tick.
    fn control(&mut self, input: &ControlInput<'_>) -> &Command;
    /// The last decision.
    fn command(&self) -> &Command;
    /// Touching points that carry nothing in the last decision, by index, if the controller has decided which ones
    /// carry.
    fn left_out(&self) -> Option<&[bool; MAX_CONTACTS]> {
        None
    }
    /// Forgets the last tick (the figure was reset).
    fn reset(&mut self);
}
