//! Help within the tick: when it begins and ends, and the command of the stiff motors in between.

use crate::figure::balance::live_help::{LossForecast, Situation};
use crate::figure::motion::source::MotionSource;
use crate::figure::params::fall::{FALLEN_HEIGHT, RISEN_HEIGHT};
use crate::figure::state::figure::Figure;
use crate::figure::tick::fall_detection::FEET;
use crate::stepper::command::MotorCommand;
use crate::stepper::motor_law::MotorLaw;
use crate::stepper::pelvis_wrench::PelvisHold;
use crate::stepper::pelvis_wrench::pull;
use crate::tick_context::TickContext;

impl Figure {
    /// Whether stiff motors and a pull on the pelvis keep it with its motion.
    pub fn is_carried(&self) -> bool {
        self.surroundings.help.carries()
    }

    /// Whether it would be helped, rather than left to fall, if it lost its motion.
    pub(in crate::figure) fn is_held_up(&self) -> bool {
        self.may_be_helped() && self.surroundings.help.is_ready()
    }

    /// Largest force of its help over the weight: its own setting, or that of its clip.
    fn most_help(&self) -> f64 {
        let own = self.setup.options.max_help;
        match self.motion.source() {
            MotionSource::Clip(play) => own.max(play.max_help),
            _ => own,
        }
    }

    /// Largest force over the weight of the help that it gets if its motion is being lost; 0 disables help.
    pub fn allowed_help(&self) -> f64 {
        if self.may_be_helped() {
            self.most_help()
        } else {
            0.0
        }
    }

    fn may_be_helped(&self) -> bool {
        self.most_help() > 0.0
            && self.setup.options.assist == 0.0
            && self.mode().can_be_helped()
            && self.motion.rehearsed().is_none()
            && !self.motion.has_fallen()
    }

    /// Stage 3: decides whether the motion is being lost, and whether to help the figure.
    pub(in crate::figure) fn update_help(&mut self, world: &TickContext) {
        let before = self.is_carried();
        if !self.may_be_helped() {
            self.surroundings.help.stop();
        } else {
            let seen = Situation {
                forecast: LossForecast::of(&self.desired.target, &self.physical.state, world.dt),
                on_feet: self.is_on_feet(),
                falls: self.surroundings.balance.lost() || self.lies(),
            };
            self.surroundings.help.observe(&seen, world.dt);
        }
        match (before, self.is_carried()) {
            (false, true) => self.surroundings.balance.reset(),
            (true, false) => {
                self.workspace.reset_modern();
                self.surroundings.balance.reset();
            }
            _ => {}
        }
    }

    /// Whether the centre of mass is low and something other than the feet touches.
    fn lies(&self) -> bool {
        let height = self.workspace.terms.com.z / self.constants.standing_com_height;
        height < FALLEN_HEIGHT && !self.only_feet_touch()
    }

    fn only_feet_touch(&self) -> bool {
        let support = &self.surroundings.support;
        let points = support.points();
        points.iter().all(|p| FEET.contains(&p.segment)) && support.rests().is_empty()
    }

    /// Whether the figure is up and on its feet, and its motion is too.
    fn is_on_feet(&self) -> bool {
        let standing = self.constants.standing_com_height;
        let is_up = |height: f64| height > RISEN_HEIGHT * standing;
        is_up(self.workspace.terms.com.z) && is_up(self.desired.com.now.z) && self.only_feet_touch()
    }

    /// The spring that leads the pelvis back to the motion, if there is one.
    pub(in crate::figure) fn pull(&self) -> Option<PelvisHold> {
        let help = &self.surroundings.help;
        let most = self.most_help() * help.share();
        (most > 0.0).then(|| pull(&self.setup.body, most))
    }

    /// The command to the motors while the figure is carried; `None` if it is not. No allocation.
    pub(in crate::figure) fn carried_command(
        &mut self,
        world: &TickContext,
    ) -> Option<MotorCommand> {
        let target = self.is_carried().then(|| self.desired.target.clone())?;
        Some(self.stiff_command(MotorLaw::STIFF, &target, world.dt))
    }
}
