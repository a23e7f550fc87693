//! Views of a world: snapshots, events, and the selection of a viewer.

use super::figure::Follows;
use super::obstacle::ObstacleInfo;
use sinew_physics::body::{Body, SegmentId, State};
use sinew_physics::figure::TickReport;
use sinew_physics::math::Vec3;
use sinew_physics::motion::Target;
use std::sync::Arc;

/// The format of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NumberFormat {
    /// 32-bit floating point.
    Float,
    /// 64-bit floating point.
    Double,
    /// 16-bit fixed point.
    Fixed16,
}

/// A set of the optional fields of a figure's frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FieldSet(pub u32);

/// The selection of a viewer; equal views share encoded frames.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ViewSpec {
    /// Last parts of figure names, sorted; empty: all.
    pub figures: Vec<String>,
    /// Fields.
    pub fields: FieldSet,
    /// Number format.
    pub format: NumberFormat,
    /// Ticks per frame.
    pub divisor: u32,
}

/// One figure of a roster.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RosterEntry {
    /// Index in frames.
    pub index: i32,
    /// Last part of the figure's name.
    pub figure: String,
    /// Last part of the body's name.
    pub body: String,
}

/// A world after one tick: everything that any view can show.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// Last part of the world's name.
    pub world: Arc<str>,
    /// Ticks per second.
    pub rate_hz: f64,
    /// Gravity, m/s².
    pub gravity: f64,
    /// Ticks computed.
    pub tick: u64,
    /// World time, s.
    pub time: f64,
    /// State hash.
    pub hash: u64,
    /// Epoch.
    pub epoch: i32,
    /// Server clock, ns since 1970.
    pub server_ns: i64,
    /// Version of the roster.
    pub roster_version: i32,
    /// The figures by index; same order as `figures`.
    pub roster: Arc<[RosterEntry]>,
    /// Figures, in the order of creation.
    pub figures: Vec<FigureSnapshot>,
    /// Obstacles, in the order in which they were added.
    pub obstacles: Vec<ObstacleInfo>,
}

/// One figure after one tick.
#[derive(Clone, Debug)]
pub struct FigureSnapshot {
    /// Its body.
    pub body: Arc<Body>,
    /// Positions and velocities.
    pub state: State,
    /// The report of the tick; `None` before the first.
    pub report: Option<TickReport>,
    /// The target at the end of the tick.
    pub desired: Target,
    /// Sequence of the desired-motion frame in use; −1 if not driven live.
    pub applied_sequence: i64,
    /// Its source time, ns.
    pub applied_source_ns: i64,
    /// Loads carried: segment, point (segment frame, m), mass (kg).
    pub loads: Vec<(SegmentId, Vec3, f64)>,
    /// The other side of each of the report's touches: `figures/{figure}` or `obstacles/{obstacle}`.
    pub touched: Vec<String>,
    /// How it follows its motion.
    pub follows: Follows,
}

/// An event of a world.
#[derive(Clone, Debug, PartialEq)]
pub enum EventKind {
    /// A segment began to support the figure.
    SupportGained(SegmentId),
    /// A segment no longer supports it.
    SupportLost(SegmentId),
    /// A DOF reached the limit of its strength.
    Saturated(usize),
    /// A DOF is no longer at its limit.
    Relieved(usize),
    /// Balance was lost.
    BalanceLost,
    /// Balance was regained.
    Recovered,
    /// The figure fell.
    Fell,
    /// The figure stands again after a fall.
    GotUp,
    /// A load was taken: segment, kg.
    LoadTaken(SegmentId, f64),
    /// A load was dropped: segment, kg.
    LoadDropped(SegmentId, f64),
    /// A load slipped from the hand: segment, kg.
    LoadSlipped(SegmentId, f64),
    /// The other hand took hold of a load too: segment, kg, that hand, and the share of its strength that the arm needs
    /// alone and with help.
    LoadShared(SegmentId, f64, SegmentId, [f64; 2]),
    /// The other hand let go: the same values.
    LoadUnshared(SegmentId, f64, SegmentId, [f64; 2]),
    /// A push was accepted: segment, N·s.
    Pushed(SegmentId, f64),
    /// A segment began to touch a figure or an obstacle: name and, of a figure, its segment.
    Touched(SegmentId, String, Option<SegmentId>),
    /// A segment no longer touches it.
    Parted(SegmentId, String, Option<SegmentId>),
    /// An obstacle is in the way of its steps, so the figure broke off its motion.
    WayBarred,
    /// A step had to catch it, so it left its clip, and begins it again from a stand.
    ClipRestarts,
    /// The same again: it stays where it stands.
    ClipGivenUp,
    /// The figure is frozen at its last good state.
    Quarantined,
    /// An obstacle was added.
    ObstacleAdded(String),
    /// An obstacle was removed.
    ObstacleRemoved(String),
    /// A figure was added.
    FigureAdded,
    /// A figure was removed.
    FigureRemoved,
    /// A driver took the figure.
    DriveBegan(String),
    /// A driver no longer has the figure: driver and reason.
    DriveEnded(String),
    /// The stream of a drive restarted: driver and reason.
    DriveResynced(String),
    /// A lease began: holder, and previous holder.
    ControlAcquired(String),
    /// A lease ended: holder and reason.
    ControlReleased(String),
    /// A lease was taken by one of higher priority: new and previous holder.
    ControlPreempted(String),
    /// A lease is offered: the holder and the receiver.
    ControlOffered(String),
    /// A caller was refused: caller and call.
    AccessRefused(String),
    /// The world was paused.
    Paused,
    /// The world was put into the state of a checkpoint of this tick.
    Restored(u64),
    /// The world was resumed.
    Resumed,
    /// The world failed: reason.
    Failed(String),
    /// The world was deleted: caller or reason.
    Deleted(String),
    /// A clip of this id began to play.
    ClipBegan(String),
    /// A clip of this id ended, or was ended.
    ClipEnded(String),
}

/// One event.
#[derive(Clone, Debug, PartialEq)]
pub struct WorldEvent {
    /// Tick after which it happened.
    pub tick: u64,
    /// World time, s.
    pub time: f64,
    /// Last part of the figure's name; empty for events of the world.
    pub figure: String,
    /// The event.
    pub kind: EventKind,
}

/// The events that a viewer wants.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EventFilter {
    /// Last parts of figure names; empty: all, and events of the world.
    pub figures: Vec<String>,
    /// Wanted types as on the wire; empty: all.
    pub types: Vec<i32>,
}
