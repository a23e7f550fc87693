//! Motors without a controller: the demand of the tracking law (4), joint by joint.

use super::tracking::{Law, initial_acceleration};
use super::{Command, ControlInput, Controller};
use crate::body::DOF_COUNT;

/// Motors alone.
#[derive(Clone, Debug, Default)]
pub struct MotorsAlone {
    command: Command,
}

impl Controller for MotorsAlone {
    /// Asks for accelerations only, and for no torque.
    fn control(&mut self, input: &ControlInput<'_>) -> &Command {
        let law = Law::new(input.params, input.dt);
        let demand = initial_acceleration(input.body, &input.terms.state, input.target, &law);
        self.command
            .joint_acceleration
            .copy_from_slice(&demand[..DOF_COUNT]);
        &self.command
    }

    fn command(&self) -> &Command {
        &self.command
    }

    fn reset(&mut self) {}
}
