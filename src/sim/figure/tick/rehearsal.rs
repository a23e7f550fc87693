//! A rehearsed motion within the tick: motors, help, and the end of it.

use crate::figure::motion::clip_playback::ClipPlayback;
use crate::figure::motion::rehearsal_playback::{RehearsalEntry, RehearsedPlayback};
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
    /// Puts the figure into the first state of a rehearsed motion, which it plays from there. Returns `false`, without
    /// any effect, if its controller plays none.
    pub fn rehearse_from_start(&mut self, play: RehearsedPlayback) -> bool {
        let able = self.mode().plays_rehearsals();
        if able {
            let state = play.sample(play.start).state();
            self.set_drive(MotionSource::Rehearsed(play));
            self.reset(state);
        }
        able
    }

    /// How it would come into the rehearsed motion of a clip; `None` if it would play the clip without.
    pub fn rehearsal_entry(&self, play: &ClipPlayback) -> Option<RehearsalEntry> {
        let motion = play.rehearsed.as_ref()?;
        let entry = if motion.begins_at_rest() {
            RehearsalEntry::FromStand
        } else {
            RehearsalEntry::Led
        };
        let able = entry == RehearsalEntry::FromStand || self.help_for(play) > 0.0;
        (able && self.mode().plays_rehearsals()).then_some(entry)
    }

    /// Begins the rehearsal of a clip in the tick in which the clip begins, if the figure stands as the rehearsal does
    /// or may be led into it; otherwise the clip is tracked as it is.
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
        let able = self.mode().plays_rehearsals() && !self.motion.has_fallen() && late < world.dt;
        let here = RehearsedPlayback::new(Arc::clone(motion), time);
        let way = [play.origin, feet].map(|origin| here.clone().at(origin));
        let reaches = |way: &RehearsedPlayback| able && way.goes_on(time, state, world);
        let begins = |way: &RehearsedPlayback| reaches(way) && way.begins_at(state);
        let help = self.allowed_help();
        let led = |way: RehearsedPlayback| way.led_from(state.posture, help, play.clone());
        let found = match way.iter().find(|way| begins(way)) {
            Some(way) => Some(way.clone()),
            None => way
                .into_iter()
                .find(|way| help > 0.0 && reaches(way))
                .map(led),
        };
        if let Some(way) = found {
            self.set_drive(MotionSource::Rehearsed(way));
        } else if let MotionSource::Clip(play) = self.motion.source_mut() {
            play.rehearsed = None;
        }
    }

    /// Leaves a rehearsed motion that is over, is for another world, or has a path out of reach. A figure that could
    /// not be led into it plays its clip.
    pub(in crate::figure) fn leave_rehearsal_if_over(&mut self, world: &TickContext) {
        let (time, state) = (world.time(), self.physical.state);
        let follows = self.motion.rehearsed().is_some();
        let MotionSource::Rehearsed(play) = self.motion.source_mut() else {
            return;
        };
        if follows && play.goes_on(time, &state, world) {
            play.end_entry_if_over(time);
            return;
        }
        match play.take_instead() {
            Some(clip) => self.set_drive(MotionSource::Clip(clip)),
            None => self.leave_rehearsal(),
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
