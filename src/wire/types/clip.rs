//! Stored motions: reading, describing, following and playing them.

use super::place::Place;
use serde::{Deserialize, Serialize};
use sinew_physics::body::Posture;
use sinew_physics::forecast::Forecast;
use sinew_physics::plan::ReadingReport;
use sinew_physics::rehearsal::follow::{Follow, FollowWay};
use sinew_physics::time::WorldTime;
use std::sync::Arc;

/// The manner of playing a clip.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Playback {
    /// Speed factor.
    pub speed: f64,
    /// Whether it repeats.
    pub looped: bool,
    /// World time of the start, s; `None`: the next tick.
    pub start: Option<f64>,
    /// Whether to put the figure into the first posture.
    pub reset: bool,
    /// Place at which the clip begins; `None`: the place of the figure.
    pub place: Option<Place>,
    /// Most help while the motion is being lost, body weights.
    pub max_help: f64,
}

/// How a figure comes into a clip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClipStart {
    /// It was put into the first state.
    Reset,
    /// As it stands.
    AtOnce,
    /// It ends what it does first, or steps into the clip.
    Switch,
    /// Led by help into the first state of the rehearsal.
    Led,
}

/// How a clip begins, as far as is known when it is requested.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipBeginning {
    /// When its first frame plays.
    pub time: WorldTime,
    /// How the figure comes into it.
    pub start: ClipStart,
    /// Whether what was rehearsed is played.
    pub rehearsed: bool,
}

/// The reading options of a BVH file; `None` leaves the choice to the reader.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BvhReading {
    /// Length of a file unit, m.
    pub unit_m: Option<f64>,
    /// Whether z is up; otherwise y.
    pub z_up: Option<bool>,
    /// Frames per second.
    pub rate_hz: Option<f64>,
    /// Whether to put the feet on the floor.
    pub floor: Option<bool>,
    /// Whether to keep planted feet from sliding.
    pub lock_feet: Option<bool>,
    /// Low-pass corner, Hz.
    pub cutoff_hz: Option<f64>,
    /// Whether to walk where the recording runs.
    pub walk_runs: Option<bool>,
}

/// The source of a motion.
#[derive(Clone, Debug)]
pub enum MotionSource {
    /// Bytes of a BVH file.
    Bvh(prost::bytes::Bytes, BvhReading),
    /// Postures at a constant rate.
    Postures {
        /// Frames per second.
        rate_hz: f64,
        /// At least two.
        postures: Vec<Posture>,
        /// The planted feet, one entry per posture; empty: decided from height and speed.
        planted: Vec<[bool; 2]>,
    },
}

/// The description of a stored motion for clients.
#[derive(Clone, Debug)]
pub struct ClipInfo {
    /// Last part of its name.
    pub id: String,
    /// Name for people.
    pub display_name: String,
    /// Whether it is built in.
    pub builtin: bool,
    /// Its owner; `None`: it belongs to all callers.
    pub owner: Option<Arc<str>>,
    /// Last part of the name of the body for which it was prepared.
    pub body: String,
    /// Frames per second.
    pub rate_hz: f64,
    /// Number of frames.
    pub frames: usize,
    /// Length, s.
    pub duration: f64,
    /// The reading report of its file.
    pub report: Option<Arc<ReadingReport>>,
    /// Creation time.
    pub created: Option<std::time::SystemTime>,
    /// The forecast of how well it is followed.
    pub forecast: Option<Arc<Forecast>>,
    /// The means that a figure may use to follow it.
    pub follow: FollowSettings,
}

/// The means that a figure may use to follow a motion, and the bound of the help.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FollowSettings {
    /// The means.
    pub follow: Follow,
    /// Largest force of the help over the weight; `None`: as [`Self::follow`] says.
    pub most_help: Option<f64>,
}

/// Changes of [`FollowSettings`]; `None` leaves a part unchanged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FollowUpdate {
    /// The means.
    pub follow: Option<Follow>,
    /// The bound of the help.
    pub most_help: Option<Option<f64>>,
}

impl FollowSettings {
    /// Largest force of the help over the weight; 0: none.
    pub fn most_help(&self) -> f64 {
        match self.follow.takes_help() {
            true => self.most_help.unwrap_or(self.follow.most_help()),
            false => 0.0,
        }
    }

    /// The settings after a change. A bound is that of its means, so other means begin without; a bound above 0 alone
    /// asks for help.
    #[must_use]
    pub fn changed(self, update: FollowUpdate) -> Self {
        let stays = update.follow.is_none_or(|f| f == self.follow);
        let kept = self.most_help.filter(|_| stays);
        let most_help = update.most_help.unwrap_or(kept);
        let asks = most_help.is_some_and(|m| m > 0.0) && !self.follow.takes_help();
        let unless = if asks { Follow::Assisted } else { self.follow };
        Self {
            follow: update.follow.unwrap_or(unless),
            most_help,
        }
    }
}

/// The help that a rehearsal found to be needed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RehearsalHelp {
    /// Impulse, N·s.
    pub impulse: f64,
    /// The same over weight × time.
    pub share: f64,
    /// Largest force, N.
    pub most_force: f64,
    /// Largest moment about the pelvis, N·m.
    pub most_moment: f64,
    /// Share of the time with help.
    pub acts: f64,
}

/// Result of a rehearsal.
#[derive(Clone, Debug, PartialEq)]
pub struct RehearsalInfo {
    /// The way in which the figure follows the clip.
    pub way: FollowWay,
    /// Reason why no easier way was possible.
    pub reason: String,
    /// Time at which it is lost, s.
    pub lost_at: Option<f64>,
    /// Mean distance of the segments from the recording in the world, and with both pelvis origins in one place, m.
    pub error: [f64; 2],
    /// The help.
    pub help: RehearsalHelp,
    /// The DOF that uses most of its strength, and that share.
    pub hardest: (String, f64),
    /// Whether the budget stopped the search.
    pub stopped: bool,
    /// Whether what was found begins in motion.
    pub begins_in_motion: bool,
}
