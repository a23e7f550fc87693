//! The modes of a figure: a controller's assumptions about body, support and motion.
//!
//! A tick asks its [`Mode`] and never which controller is in use. The modes are [`WholeBodyMode`], the default,
//! [`MotorsMode`], and [`PaperMode`](crate::paper::mode::PaperMode).

use crate::control::params::saturation::{ALONE_SPEED, MODERN_SPEED};
use crate::setup::{ControlParams, Share};

/// The means that bring the capture point back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BalanceReach {
    /// Arms and trunk, by a controller that uses everything it has.
    Body,
    /// The paper's controller, which keeps trying on an edge of its feet.
    Paper,
    /// Steps.
    Step,
}

/// Rests whose reaction a controller chooses itself: those that carry more than a given force, N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ChosenRests {
    /// None.
    None,
    /// Seats and tables.
    Level(f64),
    /// Walls, too.
    All(f64),
}

/// A mode of a figure.
///
/// The first half of the questions goes to the mode that is set, the second half to the one in charge, which is motors
/// only while the figure is falling, lying, or playing a rehearsed motion.
pub trait Mode: std::fmt::Debug + Sync {
    /// Whether desired velocities belong to the middle of the last substep, rather than to the ends of the tick.
    fn sets_velocities_back(&self) -> bool {
        true
    }

    /// Whether stretched tissue acts on the body.
    fn has_tissue(&self) -> bool {
        true
    }

    /// Whether steps follow events, and the motion follows its steps.
    fn makes_steps(&self) -> bool {
        false
    }

    /// Whether the figure gets up by itself.
    fn gets_up(&self) -> bool {
        false
    }

    /// Whether a clip may be played as it was rehearsed.
    fn plays_rehearsals(&self) -> bool {
        false
    }

    /// Whether the figure may be helped while its motion is being lost.
    fn can_be_helped(&self) -> bool {
        false
    }

    /// Whether the arms brace a fall.
    fn braces_falls(&self, _params: &ControlParams) -> bool {
        false
    }

    /// The means that bring the capture point back. `None` if no balance is watched.
    fn balance_reach(&self, params: &ControlParams) -> Option<BalanceReach>;

    /// Whether a rest carries from the first tick on.
    fn rests_at_once(&self) -> bool {
        false
    }

    /// Rests whose reactions the controller chooses, of those that carry `least` newtons, for a figure with or without
    /// a support.
    fn chosen_rests(&self, least: f64, has_support: bool) -> ChosenRests;

    /// Whether a controller decides, so that its accelerations may be applied as they are.
    fn decides(&self) -> bool {
        true
    }

    /// Whether prescribed accelerations take the controller's torques, regardless of the ground forces.
    fn keeps_torques(&self, _share: Share) -> bool {
        false
    }

    /// Rate error at which a motor gives its full torque, rad/s.
    fn saturation_speed(&self) -> f64;
}

/// The default: one convex problem for the whole body.
#[derive(Clone, Copy, Debug)]
pub struct WholeBodyMode;

impl Mode for WholeBodyMode {
    fn makes_steps(&self) -> bool {
        true
    }

    fn gets_up(&self) -> bool {
        true
    }

    fn plays_rehearsals(&self) -> bool {
        true
    }

    fn can_be_helped(&self) -> bool {
        true
    }

    fn braces_falls(&self, params: &ControlParams) -> bool {
        params.protective_steps
    }

    fn balance_reach(&self, params: &ControlParams) -> Option<BalanceReach> {
        Some(if params.protective_steps {
            BalanceReach::Step
        } else {
            BalanceReach::Body
        })
    }

    fn chosen_rests(&self, least: f64, _has_support: bool) -> ChosenRests {
        ChosenRests::Level(least)
    }

    fn saturation_speed(&self) -> f64 {
        MODERN_SPEED
    }
}

/// Motors that follow the joints, without a controller.
#[derive(Clone, Copy, Debug)]
pub struct MotorsMode;

impl Mode for MotorsMode {
    fn balance_reach(&self, _params: &ControlParams) -> Option<BalanceReach> {
        None
    }

    fn chosen_rests(&self, _least: f64, _has_support: bool) -> ChosenRests {
        ChosenRests::None
    }

    fn decides(&self) -> bool {
        false
    }

    fn saturation_speed(&self) -> f64 {
        ALONE_SPEED
    }
}
