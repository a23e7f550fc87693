//! Help within the tick: when it begins and ends, the wrench that the controller may plan in between, and the command
//! of the stiff motors of a figure on the floor.

use crate::figure::balance::live_help::{HelpTerms, LossForecast, Situation};
use crate::figure::motion::clip_playback::ClipPlayback;
use crate::figure::motion::following::FollowMode;
use crate::figure::motion::source::MotionSource;
use crate::figure::params::fall::{FALLEN_HEIGHT, RISEN_HEIGHT};
use crate::figure::params::help::FORECAST_TIME;
use crate::figure::state::figure::Figure;
use crate::figure::tick::fall_detection::FEET;
use crate::motion::GRAVITY;
use crate::stepper::command::MotorCommand;
use crate::stepper::motor_law::MotorLaw;
use crate::stepper::pelvis_wrench::PelvisHold;
use crate::stepper::pelvis_wrench::pull;
use crate::tick_context::TickContext;

impl Figure {
    /// Whether help keeps it with its motion.
    pub fn is_carried(&self) -> bool {
        self.surroundings.help.carries()
    }

    /// Whether it is carried by stiff motors and a pull on the pelvis, because it is on the floor.
    pub(in crate::figure) fn is_stiff(&self) -> bool {
        self.surroundings.help.is_stiff()
    }

    /// Price and bound of the wrench that the controller may plan in a tick of `dt` s.
    pub(in crate::figure) fn help_terms(&self, dt: f64) -> Option<HelpTerms> {
        let most = self.allowed_help();
        self.surroundings.help.terms(&self.setup.body, most, dt)
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

    /// The same once it plays this clip, if it may be helped at all.
    pub(in crate::figure) fn help_for(&self, play: &ClipPlayback) -> f64 {
        let able = self.setup.options.assist == 0.0 && self.mode().can_be_helped();
        let most = self.setup.options.max_help.max(play.max_help);
        if able { most } else { 0.0 }
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
        let before = (self.is_carried(), self.is_stiff());
        if !self.may_be_helped() {
            self.surroundings.help.stop();
        } else {
            let seen = Situation {
                forecast: LossForecast::of(&self.desired.target, &self.physical.state, world.dt),
                on_feet: self.is_on_feet(),
                on_floor: self.is_low(self.desired.com.now.z) && !self.only_feet_touch(),
                begins: self.has_just_begun(),
                falls: self.surroundings.balance.lost() || self.lies(),
            };
            self.surroundings.help.observe(&seen, world.dt);
        }
        if self.is_carried() != before.0 {
            self.surroundings.balance.reset();
        }
        if before.1 && !self.is_stiff() {
            // Its last decision was for another body.
            self.workspace.reset_modern();
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
        let [own, desired] = [self.workspace.terms.com.z, self.desired.com.now.z];
        !self.is_low(own) && !self.is_low(desired) && self.only_feet_touch()
    }

    /// Whether its motion has begun within the time of a forecast: it may have begun in another state than that of the
    /// figure, and nothing has struck the floor yet.
    fn has_just_begun(&self) -> bool {
        let following = self.motion.following();
        let weight = self.setup.body.profile.mass * GRAVITY;
        following.mode != FollowMode::Nothing && following.time(weight) < FORECAST_TIME
    }

    /// Whether a centre of mass at this height, m, is lower than in standing.
    pub(in crate::figure) fn is_low(&self, height: f64) -> bool {
        height <= RISEN_HEIGHT * self.constants.standing_com_height
    }

    /// The spring that leads the pelvis of a stiff figure back to the motion.
    pub(in crate::figure) fn pull(&self) -> Option<PelvisHold> {
        let help = &self.surroundings.help;
        let most = self.most_help() * help.share();
        (self.is_stiff() && most > 0.0).then(|| pull(&self.setup.body, most))
    }

    /// The command to the motors while the figure is carried on the floor; `None` if it is not. No allocation.
    pub(in crate::figure) fn carried_command(
        &mut self,
        world: &TickContext,
    ) -> Option<MotorCommand> {
        let target = self.is_stiff().then(|| self.desired.target.clone())?;
        Some(self.stiff_command(MotorLaw::STIFF, &target, world.dt))
    }
}
