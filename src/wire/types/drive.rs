//! Desired motion as it is streamed, and the answers of the jitter buffer.

use super::control::ControlKey;
use serde::{Deserialize, Serialize};
use sinew_physics::body::{NV, Posture};

/// Most figures that one driver can drive.
pub const MAX_DRIVEN_FIGURES: usize = 64;

/// Delay between arrival and use of live motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Delay {
    /// Always this many seconds.
    Fixed(f64),
    /// As long as the arrival jitter requires, at most this many seconds.
    Adaptive {
        /// Largest delay, s.
        most: f64,
    },
}

/// How a drive handles late frames, and how long it lasts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DriveSettings {
    /// Expected frames per second.
    pub rate_hz: f64,
    /// Delay between arrival and use.
    pub delay: Delay,
    /// Time for which the last velocity is continued, s; 0 holds at once.
    pub extrapolation: f64,
    /// Time for which the last posture is held before relaxing, s.
    pub hold: f64,
    /// Time for which the figures are kept without a connection or push, s.
    pub grace: f64,
    /// Whether to put each figure into its first desired posture.
    pub reset: bool,
    /// Window in which motion is prepared, s; 0: frames are used as they come; `None`: the server's setting.
    pub window: Option<f64>,
}

/// Header of a drive.
#[derive(Clone, Debug, PartialEq)]
pub struct DriveOpen {
    /// Last part of the world's name.
    pub world: String,
    /// Last parts of the figures' names.
    pub figures: Vec<String>,
    /// Name of the driver; empty: the server chooses.
    pub driver: String,
    /// The principal that drives, and the tokens of its leases.
    pub who: ControlKey,
    /// Settings.
    pub settings: DriveSettings,
}

/// Desired motion of one figure at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureSample {
    /// Position in the drive's list of figures.
    pub slot: usize,
    /// Desired posture. Without `has_root` its pelvis pose is meaningless.
    pub posture: Posture,
    /// Whether the sender gave the pelvis pose.
    pub has_root: bool,
    /// Desired velocity, layout of `State::velocity`.
    pub velocity: Option<Box<[f64; NV]>>,
    /// The planted feet.
    pub planted: Option<[bool; 2]>,
}

/// Desired motion at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionSample {
    /// Sequence.
    pub sequence: i64,
    /// Source time, ns on the driver's clock.
    pub source_ns: i64,
    /// Driven figures.
    pub figures: Vec<FigureSample>,
}

/// The kind of an answer of the jitter buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Supply {
    /// No request yet.
    #[default]
    None,
    /// A frame exactly at the requested time.
    Present,
    /// Between two frames.
    Interpolated,
    /// Beyond the newest frame.
    Extrapolated,
    /// The last posture.
    Held,
    /// On the way to, or in, quiet standing.
    Relaxed,
    /// Before the first frame.
    Waiting,
}

/// State of the buffer of one figure.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FigureFeedback {
    /// Last part of the figure's name.
    pub figure: String,
    /// Sequence of the newest frame in use; −1 if none.
    pub applied_sequence: i64,
    /// Source time in use, ns.
    pub applied_source_ns: i64,
    /// Duration of the motion held but not used, s.
    pub buffered: f64,
    /// Present delay, s.
    pub delay: f64,
    /// p99 of the arrival jitter, s.
    pub jitter: f64,
    /// Last answer.
    pub supply: Supply,
    /// Ticks by kind of answer: present, interpolated, extrapolated, held, relaxed.
    pub ticks: [u64; 5],
    /// Frames too late to be used.
    pub late: u64,
    /// Frames not newer than the newest one held.
    pub stale: u64,
    /// Frames dropped for want of room.
    pub overflow: u64,
    /// Times that the stream restarted.
    pub resyncs: u64,
    /// How far it is behind because its world skips ticks, s; contained in the delay.
    pub behind: f64,
    /// Window in which motion is prepared, s; contained in the delay.
    pub window: f64,
}

/// State of a drive.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Feedback {
    /// Name of the driver.
    pub driver: String,
    /// Tick of the world.
    pub tick: u64,
    /// Largest sequence taken; −1 if none.
    pub received_sequence: i64,
    /// Refused batches.
    pub refused: u64,
    /// Figures.
    pub figures: Vec<FigureFeedback>,
}
