//! The mode of the paper's controller.

use crate::control::mode::{BalanceReach, ChosenRests, Mode};
use crate::control::params::saturation::FEED_FORWARD_SPEED;
use crate::setup::{ControlParams, Share};

/// The paper as published: a body without tissue, and a motion that keeps its clock.
#[derive(Clone, Copy, Debug)]
pub struct PaperMode;

impl Mode for PaperMode {
    fn sets_velocities_back(&self) -> bool {
        false
    }

    fn has_tissue(&self) -> bool {
        false
    }

    fn balance_reach(&self, _params: &ControlParams) -> Option<BalanceReach> {
        Some(BalanceReach::Paper)
    }

    fn rests_at_once(&self) -> bool {
        true
    }

    fn chosen_rests(&self, least: f64, has_support: bool) -> ChosenRests {
        if has_support {
            ChosenRests::All(least)
        } else {
            ChosenRests::None
        }
    }

    /// Ratios (2) have no point forces.
    fn keeps_torques(&self, share: Share) -> bool {
        share == Share::Paper
    }

    fn saturation_speed(&self) -> f64 {
        FEED_FORWARD_SPEED
    }
}
