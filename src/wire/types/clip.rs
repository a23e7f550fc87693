//! Stored motions: how they are read, described, followed and played.

use super::world::Place;
use serde::{Deserialize, Serialize};
use sinew_physics::body::Posture;
use std::sync::Arc;

/// How a clip is played.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Playback {
    /// Speed factor.
    pub speed: f64,
    /// Repeat.
    pub looped: bool,
    /// World time of the start, s; `None`: the next tick.
    pub start: Option<f64>,
    /// Put the figure into the first posture.
    pub reset: bool,
    /// Where the clip begins; `None`: where the figure is.
    pub place: Option<Place>,
    /// Most help while it is being lost, body weights.
    pub max_help: f64,
}

/// How a BVH file is read; `None` leaves the choice to the reader.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BvhReading {
    /// Length of a file unit, m.
    pub unit_m: Option<f64>,
    /// True: z is up; false: y.
    pub z_up: Option<bool>,
    /// Frames per second.
    pub rate_hz: Option<f64>,
    /// Put the feet on the floor.
    pub floor: Option<bool>,
    /// Keep planted feet from sliding.
    pub lock_feet: Option<bool>,
    /// Low-pass corner, Hz.
    pub cutoff_hz: Option<f64>,
    /// Walk what the recording runs.
    pub walk_runs: Option<bool>,
}

/// Where a motion comes from.
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
        /// Which feet are planted, one per posture; empty: decided from height and speed.
        planted: Vec<[bool; 2]>,
    },
}

/// A stored motion as it is described to clients.
#[derive(Clone, Debug)]
pub struct ClipInfo {
    /// Last part of its name.
    pub id: String,
    /// Name for people.
    pub display_name: String,
    /// Comes with the server.
    pub builtin: bool,
    /// Whose it is; `None`: everybody's.
    pub owner: Option<Arc<str>>,
    /// Last part of the name of the body it was prepared for.
    pub body: String,
    /// Frames per second.
    pub rate_hz: f64,
    /// Number of frames.
    pub frames: usize,
    /// Length, s.
    pub duration: f64,
    /// How the file was understood.
    pub report: Option<Arc<ReadingReport>>,
    /// When it was stored.
    pub created: Option<std::time::SystemTime>,
    /// What will come of it.
    pub forecast: Option<Arc<ForecastInfo>>,
    /// How far it may go so that a figure keeps to it.
    pub follow: FollowSettings,
}

/// How far it may go so that a figure keeps to a clip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Follow {
    /// As it is.
    Strict,
    /// A rehearsal, by strength alone.
    Rehearsed,
    /// A rehearsal with as little help as will do.
    Assisted,
}

/// The same, with the bound of the help.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FollowSettings {
    /// How far.
    pub follow: Follow,
    /// Largest force of the help over the weight.
    pub most_help: f64,
}

impl Default for FollowSettings {
    fn default() -> Self {
        Self {
            follow: Follow::Strict,
            most_help: 0.3,
        }
    }
}

/// In which way a figure keeps to a clip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FollowWay {
    /// As it is.
    Tracked,
    /// Rehearsed, by strength alone.
    Rehearsed,
    /// Rehearsed, with help.
    Helped,
    /// Not at all.
    Lost,
}

/// What came of a rehearsal.
#[derive(Clone, Debug, PartialEq)]
pub struct RehearsalInfo {
    /// In which way the figure keeps to the clip.
    pub way: FollowWay,
    /// Why not in an easier one.
    pub reason: String,
    /// When it is lost, s.
    pub lost_at: Option<f64>,
    /// Mean distance of the segments from the recording in the world, and with both pelvis origins in one place, m.
    pub error: [f64; 2],
    /// Impulse of the help, N·s; the same over weight × time; its largest force, N; share of the time with help.
    pub help: [f64; 4],
    /// The DOF that uses most of its strength, and that share.
    pub hardest: (String, f64),
    /// The budget stopped the search.
    pub stopped: bool,
}

/// Verdict of a forecast.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForecastVerdict {
    /// The figure follows.
    Follows,
    /// It deviates or falls, unless it is helped.
    NeedsHelp,
    /// No help short of carrying it will do.
    Cannot,
}

/// What will come of a clip, in the words of the API.
#[derive(Clone, Debug, PartialEq)]
pub struct ForecastInfo {
    /// What will come of it.
    pub verdict: ForecastVerdict,
    /// Why.
    pub reason: String,
    /// Hardest demand over what is believed to be followed.
    pub demand: f64,
    /// Force that the floor lacks: rms and peak, weights, and time of the peak, s.
    pub lacking_force: [f64; 3],
    /// Peak of the moment that it lacks, weight × m.
    pub lacking_moment: f64,
    /// How far that drives the capture point, m.
    pub drift_m: f64,
    /// Largest torque of `strength_dof` over its strength, and its time, s.
    pub strength_peak: [f64; 2],
    /// The DOF that carries and is closest to its strength.
    pub strength_dof: String,
    /// Its 95th percentile.
    pub strength_p95: f64,
    /// Times in flight, in the longest flight, on something other than the feet, and upside down, s.
    pub times_s: [f64; 4],
}

/// How a file was understood, in the words of the API.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadingReport {
    /// Bone and the joints of the file that drive it.
    pub mapped: Vec<(String, Vec<String>)>,
    /// Bones without a counterpart.
    pub missing: Vec<String>,
    /// Bones were found by shape.
    pub by_structure: bool,
    /// Left and right were swapped.
    pub sides_swapped: bool,
    /// Length of a file unit, m.
    pub unit_m: f64,
    /// File axis that points up.
    pub up_axis: String,
    /// Stature of the captured person, m.
    pub stature_m: f64,
    /// Scale of the pelvis motion.
    pub scale: f64,
    /// Frames per second of the file.
    pub source_rate_hz: f64,
    /// Speed of the fastest run, m/s, if there is one.
    pub run_speed: Option<f64>,
    /// Runs are walked.
    pub runs_walked: bool,
    /// Height taken off, m.
    pub floor_offset_m: f64,
    /// DOF, fraction of frames clamped, largest excess (rad).
    pub clamped: Vec<(String, f64, f64)>,
    /// Largest distance of a planted foot from its place, as recorded and as prepared, m.
    pub foot_slide_m: [f64; 2],
    /// Frames bridged.
    pub bridged: usize,
    /// Calibration frames dropped at the start.
    pub dropped: usize,
    /// Left foot?, start, end (s).
    pub phases: Vec<(bool, f64, f64)>,
    /// Anything else.
    pub warnings: Vec<String>,
}
