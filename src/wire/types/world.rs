//! Worlds: their settings, their state, and changes.

use super::control::ControlInfo;
use super::figure::FigureInfo;
use serde::{Deserialize, Serialize};
use std::time::{Duration, Instant};

/// The handling of a tick that takes longer than its period.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Overrun {
    /// Skips the missed deadlines.
    Skip,
    /// Computes up to this many missed ticks back to back, then skips the rest.
    CatchUp(u32),
    /// World time runs slower.
    Dilate,
}

/// Settings of a world that may change while it runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldPace {
    /// Name for people.
    pub display_name: String,
    /// Overrun policy.
    pub overrun: Overrun,
    /// Catch-up limit as set; used by `Overrun::CatchUp`.
    pub catch_up_limit: u32,
    /// World seconds per wall second.
    pub speed: f64,
    /// Time for which the world may be idle before it is deleted; `None`: for ever.
    pub idle_ttl: Option<Duration>,
}

/// Settings of a new world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldSettings {
    /// Ticks per second.
    pub rate_hz: f64,
    /// Substeps per tick.
    pub substeps: u32,
    /// Gravity, m/s².
    pub gravity: f64,
    /// Friction of the ground.
    pub friction: f64,
    /// Whether figures and obstacles touch each other.
    pub collisions: bool,
    /// The settings that may change later.
    pub pace: WorldPace,
}

/// Condition of a world.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WorldCondition {
    /// Its clock runs.
    Running,
    /// Its clock is stopped.
    Paused,
    /// A step ended abnormally: reason.
    Failed(String),
}

/// A world as it is now.
#[derive(Clone, Debug)]
pub struct WorldInfo {
    /// Last part of its name.
    pub id: String,
    /// Settings.
    pub settings: WorldSettings,
    /// Its condition.
    pub condition: WorldCondition,
    /// Ticks computed.
    pub tick: u64,
    /// World time, s.
    pub time: f64,
    /// Number of figures.
    pub figures: usize,
    /// Epoch.
    pub epoch: i32,
    /// Creation time.
    pub created: std::time::SystemTime,
}

/// Changes of a world; `None` leaves a setting unchanged.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WorldUpdate {
    /// Name for people.
    pub display_name: Option<String>,
    /// Overrun policy; `CatchUp` carries a limit that `catch_up_limit` replaces.
    pub overrun: Option<Overrun>,
    /// Catch-up limit.
    pub catch_up_limit: Option<u32>,
    /// Speed.
    pub speed: Option<f64>,
    /// Time for which it may be idle; `Some(None)`: for ever.
    pub idle_ttl: Option<Option<Duration>>,
}

impl WorldUpdate {
    /// Applies the changes to these settings.
    pub fn apply(self, pace: &mut WorldPace) {
        if let Some(name) = self.display_name {
            pace.display_name = name;
        }
        if let Some(limit) = self.catch_up_limit {
            pace.catch_up_limit = limit;
        }
        if let Some(overrun) = self.overrun {
            pace.overrun = overrun;
        }
        if let Overrun::CatchUp(limit) = &mut pace.overrun {
            *limit = pace.catch_up_limit;
        }
        if let Some(speed) = self.speed {
            pace.speed = speed;
        }
        if let Some(ttl) = self.idle_ttl {
            pace.idle_ttl = ttl;
        }
    }
}

/// A world with its figures, ready for clients that ask at any time.
#[derive(Clone, Debug)]
pub struct Described {
    /// The world; its tick and time are those of the last change.
    pub world: WorldInfo,
    /// Its figures, in the order of creation.
    pub figures: Vec<FigureInfo>,
    /// The control of each of them, in the same order.
    pub controls: Vec<ControlInfo>,
    /// The time of the description.
    pub at: Instant,
}
