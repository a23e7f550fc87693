//! The input of a stepper: the body, the motors' command and the forces of one tick.

use crate::body::angles::Swings;
use crate::body::topology::{DOF_COUNT, NV, SegmentId};
use crate::body::{Body, Links, State};
use crate::contact::Tissue;
use crate::dynamics::Terms;
use crate::dynamics::terms::AppliedForce;
use crate::math::Vec3;
use crate::stepper::pelvis_wrench::PelvisHelp;
use crate::stepper::self_contact::OwnBody;
use crate::strength::{MuscleScale, Strength};
use crate::tick_context::TickContext;
use serde::{Deserialize, Serialize};

/// The input of a stepper in one tick.
#[derive(Clone, Copy, Debug)]
pub struct StepInput<'a> {
    /// The body.
    pub body: &'a Body,
    /// Its mass properties, loads included.
    pub links: &'a Links,
    /// Its strength.
    pub strength: &'a Strength,
    /// Factors on the muscles.
    pub scale: &'a MuscleScale,
    /// The known state at the start of the tick.
    pub start: TickStart<'a>,
    /// Acceleration in the last substep of the previous tick, from which the first solve starts; zeros without one.
    pub last_acceleration: &'a [f64; NV],
    /// The command to the motors.
    pub command: &'a MotorCommand,
    /// Stretched tissue on which the controller relies; `None` if none acts.
    pub tissue: Option<&'a Tissue>,
    /// Forces other than those of muscles and contact.
    pub forces: StepForces<'a>,
    /// Data for contact of the body with itself; without them it passes through itself.
    pub own: Option<OwnBody<'a>>,
    /// Tick, substeps and gravity.
    pub world: &'a TickContext,
}

/// Known facts about the state at the start of a tick: the first substep takes them from here.
#[derive(Clone, Copy, Debug)]
pub struct TickStart<'a> {
    /// Its terms, the same that the controller used.
    pub terms: &'a Terms,
    /// Swings and twists of its joints.
    pub swings: &'a Swings,
    /// Torque that is available in this state: the strength, with the factors of [`StepInput::scale`].
    pub available: &'a TorqueRange,
}

/// Torque that muscles can give, N·m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorqueRange {
    /// Least of each DOF.
    pub lower: [f64; DOF_COUNT],
    /// Largest of each DOF.
    pub upper: [f64; DOF_COUNT],
}

/// Forces on the body other than those of muscles and contact.
#[derive(Clone, Copy, Debug)]
pub struct StepForces<'a> {
    /// Forces of perturbations, constant over the tick.
    pub applied: &'a [AppliedForce],
    /// A bar between two points of the body, if two hands hold one load.
    pub bar: Option<&'a Bar>,
    /// Help on the pelvis, if there is any.
    pub assist: Option<PelvisHelp<'a>>,
}

/// Moves the body.
pub trait Stepper {
    /// Advances `state` by one tick. Allocates nothing.
    fn step(&mut self, input: &StepInput<'_>, state: &mut State);
}

/// The command to the motors for one tick.
#[derive(Clone, Debug)]
pub struct MotorCommand {
    /// Commanded joint acceleration, rad/s².
    pub acceleration: [f64; DOF_COUNT],
    /// Feed-forward torque, N·m.
    pub torque: [f64; DOF_COUNT],
    /// Rate error at which a motor gives its full torque, rad/s: 1 with a feed-forward torque, 0.005 for motors alone.
    pub saturation_speed: f64,
}

impl MotorCommand {
    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        let numbers = self.acceleration.iter().chain(&self.torque);
        numbers
            .chain([&self.saturation_speed])
            .all(|x| x.is_finite())
    }
}

/// A rigid bar between two points of the body: a load in two hands.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bar {
    /// Segments and points (segment frame, m) of its ends.
    pub ends: [(SegmentId, Vec3); 2],
    /// Its length, m.
    pub length: f64,
}
