//! Figures: their settings, their state, and changes.

use super::clip::{FollowSettings, FollowUpdate};
use super::place::Place;
use serde::{Deserialize, Serialize};
use sinew_physics::body::{Profile, SegmentId};
use sinew_physics::figure::{
    ControlParams, ControllerKind, FigureOptions, Following, StepperKind, StrengthScale,
};
use sinew_physics::math::{Quat, Vec3};

/// The body, by a name that states its profile; see [`crate::convert::body`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyRef {
    /// Last part of the name.
    pub id: String,
    /// The person that it represents.
    pub profile: Profile,
}

/// Settings of a new figure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FigureSettings {
    /// Name for people.
    pub display_name: String,
    /// Body.
    pub body: BodyRef,
    /// Strength.
    pub strength: StrengthScale,
    /// Controller.
    pub controller: ControllerKind,
    /// Stepper.
    pub stepper: StepperKind,
    /// Choices of the paper's controller.
    pub params: ControlParams,
    /// Fatigue, assist and help.
    pub options: FigureOptions,
    /// The means by which it keeps its motion. `options` have the bound that follows from them.
    pub follow: FollowSettings,
    /// Its place at the start.
    pub place: Place,
    /// Constraints from the start.
    pub constraints: Vec<ConstraintSettings>,
}

/// The desired place of a part of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ConstraintSettings {
    /// Segment and point, segment frame; no point: the middle of a hand, else the centre of mass. `None`: the figure's
    /// centre of mass.
    pub on: Option<(SegmentId, Option<Vec3>)>,
    /// Wanted position, world, m.
    pub position: Option<Vec3>,
    /// Weight of each axis, 0…1.
    pub axes: [f64; 3],
    /// Wanted rotation, `world_from_segment`.
    pub rotation: Option<Quat>,
    /// Weight of the rotation, 0…1.
    pub weight: f64,
    /// Time over which it begins and ends, s.
    pub ease: f64,
    /// Duration, s; infinite until it is removed.
    pub duration: f64,
}

/// A figure as it is now.
#[derive(Clone, Debug)]
pub struct FigureInfo {
    /// Last part of its world's name.
    pub world: String,
    /// Last part of its name.
    pub id: String,
    /// Settings.
    pub settings: FigureSettings,
    /// Last part of the name of the clip it plays.
    pub clip: Option<String>,
    /// Last part of the name of the clip that begins once it stands.
    pub next_clip: Option<String>,
    /// Its driver.
    pub driver: Option<String>,
    /// Index in frames.
    pub index: i32,
    /// Active constraints, with their remaining time.
    pub constraints: Vec<ConstraintSettings>,
    /// How it follows its motion, as of the last tick.
    pub follows: Follows,
}

/// How a figure follows its motion, with the help that it may get.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Follows {
    /// The way of following, and the help taken.
    pub so_far: Following,
    /// Largest force of the help over the weight while the motion is being lost; 0: none.
    pub most_help: f64,
}

/// Changes of a figure; `None` leaves a setting unchanged.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FigureUpdate {
    /// Name for people.
    pub display_name: Option<String>,
    /// Strength.
    pub strength: Option<StrengthScale>,
    /// Controller.
    pub controller: Option<ControllerKind>,
    /// Choices of the paper's controller.
    pub params: Option<ControlParams>,
    /// Time scale of fatigue.
    pub fatigue_time_scale: Option<f64>,
    /// Assist.
    pub assist: Option<f64>,
    /// The means by which it keeps its motion.
    pub follow: FollowUpdate,
    /// Whether the body collides with itself.
    pub self_contact: Option<bool>,
    /// All constraints.
    pub constraints: Option<Vec<ConstraintSettings>>,
    /// Protective steps.
    pub protective_steps: Option<bool>,
}

impl FigureUpdate {
    /// The options of a figure after this update.
    pub fn options(&self, settings: &FigureSettings) -> FigureOptions {
        let now = settings.options;
        FigureOptions {
            fatigue_time_scale: self.fatigue_time_scale.unwrap_or(now.fatigue_time_scale),
            assist: self.assist.unwrap_or(now.assist),
            max_help: settings.follow.changed(self.follow).most_help(),
            self_contact: self.self_contact.unwrap_or(now.self_contact),
        }
    }

    /// The settings of a figure after this update.
    #[must_use]
    pub fn applied(self, now: FigureSettings) -> FigureSettings {
        let options = self.options(&now);
        // The paper's controller has no choice of stepping.
        let params = ControlParams {
            protective_steps: self.protective_steps.unwrap_or(now.params.protective_steps),
            ..self.params.unwrap_or(now.params)
        };
        FigureSettings {
            display_name: self.display_name.unwrap_or(now.display_name),
            strength: self.strength.unwrap_or(now.strength),
            controller: self.controller.unwrap_or(now.controller),
            params,
            options,
            follow: now.follow.changed(self.follow),
            constraints: self.constraints.unwrap_or(now.constraints),
            ..now
        }
    }
}
