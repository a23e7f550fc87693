//! A rehearsed motion within the tick: motors, help, and the end of it.

use super::{Figure, TickContext};
use crate::sim::figure::drive::Drive;
use crate::sim::figure::torque_step::MotorCommand;
use crate::sim::report::Flags;

impl Figure {
    /// Leaves a rehearsed motion that is over, that this world is not for, or whose path is out of reach.
    pub(super) fn leave_rehearsal_if_over(&mut self, world: &TickContext) {
        let Drive::Rehearsed(play) = self.motion.source() else {
            return;
        };
        let time = world.time();
        let follows = self.motion.rehearsed().is_some();
        if !(follows && play.goes_on(time, &self.physical.state, world)) {
            self.leave_rehearsal();
        }
    }

    /// Stands as the motion does now, or recovers or falls on the way there: what comes next is as after any motion.
    pub(super) fn leave_rehearsal(&mut self) {
        let posture = self.desired.target.next.posture;
        self.set_drive(Drive::Hold(posture));
        self.surroundings.balance.reset();
        self.start_afresh();
    }

    /// What a rehearsed motion asks of the motors; `None` if none is played. No allocation.
    pub(super) fn rehearsed_command(&mut self, world: &TickContext) -> Option<MotorCommand> {
        let play = self.motion.rehearsed()?;
        let mut target = self.desired.target.clone();
        play.offset(world.time()).add_to(&mut target);
        let motors = play.motion.motors;
        let law = motors.law(world.dt);
        let out = motors.command(&law, &self.setup.body, &self.physical.state, &target);
        let report = &mut self.outcome.report;
        (report.joints.saturated, report.joints.saturated_secondary) = (0, 0);
        report.control_iterations = 0;
        report.flags = Flags::default();
        self.stepping.tips = false;
        Some(out)
    }
}
