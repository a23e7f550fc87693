//! A rehearsed motion within the tick: motors, help, and the end of it.

use crate::figure::motion::rehearsed::{RehearsedMotion, RehearsedPlayback};
use crate::figure::motion::source::MotionSource;
use crate::figure::state::figure::Figure;
use crate::motion::TargetPair;
use crate::report::Flags;
use crate::stepper::command::MotorCommand;
use crate::stepper::motor_law::MotorLaw;
use crate::tick_context::TickContext;
use crate::track::planned_to_world::Anchor;
use std::sync::Arc;

impl Figure {
    /// Plays the most recently requested clip from its rehearsal, provided that the clip starts from a stand.
    pub fn rehearse(&mut self, motion: Arc<RehearsedMotion>) {
        if self.motion.next().is_some() {
            self.motion.update_next(|q| q.play.rehearsed = Some(motion));
        } else if let MotionSource::Clip(play) = self.motion.source_mut() {
            play.rehearsed = Some(motion);
        }
    }

    /// Begins the rehearsal of a clip in the tick in which the clip begins, if the figure stands as the rehearsal does;
    /// otherwise the clip is tracked as it is.
    pub(in crate::figure) fn begin_rehearsal_if_due(&mut self, world: &TickContext) {
        let MotionSource::Clip(play) = self.motion.source() else {
            return;
        };
        let Some(motion) = &play.rehearsed else {
            return;
        };
        let time = world.time();
        let late = time - (play.start - play.clip.lead_in());
        if late < -1e-9 {
            return;
        }
        // The place of the clip, or of the feet: prepared clip and recording need not begin in one place.
        let (tracker, state) = (&self.desired.tracker, &self.physical.state);
        let first = tracker.stance_of(&self.setup.body, &motion.start().posture);
        let feet = Anchor::between(first, tracker.stance(&self.scratch.placement)).transform();
        let able = self.mode().plays_rehearsals() && !self.motion.has_fallen();
        let here = RehearsedPlayback::new(Arc::clone(motion), time);
        let way = [play.origin, feet].map(|origin| here.clone().at(origin));
        let begins = |way: &RehearsedPlayback| {
            able && late < world.dt && way.begins_at(state) && way.goes_on(time, state, world)
        };
        if let Some(way) = way.into_iter().find(begins) {
            self.set_drive(MotionSource::Rehearsed(way));
        } else if let MotionSource::Clip(play) = self.motion.source_mut() {
            play.rehearsed = None;
        }
    }

    /// Leaves a rehearsed motion that is over, is for another world, or has a path out of reach.
    pub(in crate::figure) fn leave_rehearsal_if_over(&mut self, world: &TickContext) {
        let MotionSource::Rehearsed(play) = self.motion.source() else {
            return;
        };
        let time = world.time();
        let follows = self.motion.rehearsed().is_some();
        if !(follows && play.goes_on(time, &self.physical.state, world)) {
            self.leave_rehearsal();
        }
    }

    /// Stands as the motion does now, or recovers or falls on the way there: the sequel is the same as after any
    /// motion.
    pub(in crate::figure) fn leave_rehearsal(&mut self) {
        let mut next = self.desired.target.next.clone();
        let tracker = &self.desired.tracker;
        let asked = tracker.stance_of(&self.setup.body, &next.posture);
        // The place of its feet, which need not have come down where the recording has them.
        let feet = Anchor::between(asked, tracker.stance(&self.scratch.placement)).transform();
        feet.apply_to(&mut next);
        let posture = next.posture;
        self.set_drive(MotionSource::Hold(posture));
        self.surroundings.balance.reset();
        self.start_afresh();
    }

    /// The command of a rehearsed motion to the motors; `None` if none is played. No allocation.
    pub(in crate::figure) fn rehearsed_command(
        &mut self,
        world: &TickContext,
    ) -> Option<MotorCommand> {
        let play = self.motion.rehearsed()?;
        let mut target = self.desired.target.clone();
        play.offset(world.time()).add_to(&mut target);
        let motors = play.motion.motors;
        Some(self.stiff_command(motors, &target, world.dt))
    }

    /// The command that makes stiff motors follow a target in a tick of `dt` s, without a controller's decision.
    pub(in crate::figure) fn stiff_command(
        &mut self,
        motors: MotorLaw,
        target: &TargetPair,
        dt: f64,
    ) -> MotorCommand {
        let law = motors.law(dt);
        let out = motors.command(&law, &self.setup.body, &self.physical.state, target);
        let report = &mut self.outcome.report;
        (report.joints.saturated, report.joints.saturated_secondary) = (0, 0);
        report.control_iterations = 0;
        report.flags = Flags::default();
        self.stepping.note_tipping(false);
        out
    }
}
