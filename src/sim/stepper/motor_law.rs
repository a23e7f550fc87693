//! The law by which stiff motors follow a motion without a controller.

use crate::body::topology::DOF_COUNT;
use crate::body::{Body, State};
use crate::control::{Law, tracking};
use crate::motion::TargetPair;
use crate::setup::ControlParams;
use crate::stepper::command::MotorCommand;
use serde::{Deserialize, Serialize};

/// How motors follow a rehearsed motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotorLaw {
    /// Time constant of the demand, s.
    pub horizon: f64,
    /// Rate error at which a motor gives its full torque, rad/s.
    pub saturation_speed: f64,
}

impl MotorLaw {
    /// Stiff motors: they give their full torque at an error of a tenth of a rad/s, so that joints follow within
    /// strength.
    pub const STIFF: Self = Self {
        horizon: 0.03,
        saturation_speed: 0.1,
    };

    /// The law of tracking, for ticks of `dt` s.
    pub fn law(&self, dt: f64) -> Law {
        let params = ControlParams {
            horizon: Some(self.horizon),
            ..ControlParams::default()
        };
        Law::new(&params, dt)
    }

    /// The command that makes the joints of a body in `state` follow `target`. No allocation.
    pub fn command(
        &self,
        law: &Law,
        body: &Body,
        state: &State,
        target: &TargetPair,
    ) -> MotorCommand {
        let demand = tracking::initial_acceleration(body, state, target, law);
        let mut acceleration = [0.0; DOF_COUNT];
        acceleration.copy_from_slice(&demand[..DOF_COUNT]);
        MotorCommand {
            acceleration,
            torque: [0.0; DOF_COUNT],
            saturation_speed: self.saturation_speed,
        }
    }
}
