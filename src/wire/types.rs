//! What requests and frames are about, as domain types: checked once at the edge, trusted afterwards.

use super::status::Fault;
use crate::sim::body::{Body, NV, Posture, Profile, SegmentId, State};
use crate::sim::collide::{Mobility, ObstacleSetup, Shape};
use crate::sim::figure::{
    ControlParams, ControllerKind, FigureOptions, Following, SecondHand, StepperKind,
    StrengthScale, TickReport,
};
use crate::sim::math::{Quat, Vec3};
use crate::sim::motion::Target;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A place on the ground: world x, y (m) and heading about z (rad).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// World x, m.
    pub x: f64,
    /// World y, m.
    pub y: f64,
    /// Heading about z, rad.
    pub yaw: f64,
}

/// What the clock does when a tick takes longer than its period.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Overrun {
    /// Leaves out the deadlines that were missed.
    Skip,
    /// Computes up to this many missed ticks back to back, then leaves out the rest.
    CatchUp(u32),
    /// World time runs slower.
    Dilate,
}

/// Settings of a world that may change while it runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pace {
    /// Name for people.
    pub display_name: String,
    /// Overrun policy.
    pub overrun: Overrun,
    /// Catch-up limit as it was set; used by `Overrun::CatchUp`.
    pub catch_up_limit: u32,
    /// World seconds per wall second.
    pub speed: f64,
    /// How long the world may be idle before it is deleted; `None`: for ever.
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
    /// Figures and obstacles touch each other.
    pub collisions: bool,
    /// What may change later.
    pub pace: Pace,
}

/// What a world is doing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WorldCondition {
    /// Its clock runs.
    Running,
    /// Its clock is stopped.
    Paused,
    /// A step ended abnormally: why.
    Failed(String),
}

/// A world as it is now.
#[derive(Clone, Debug)]
pub struct WorldInfo {
    /// Last part of its name.
    pub id: String,
    /// Settings.
    pub settings: WorldSettings,
    /// What it is doing.
    pub condition: WorldCondition,
    /// Ticks computed.
    pub tick: u64,
    /// World time, s.
    pub time: f64,
    /// Number of figures.
    pub figures: usize,
    /// Epoch.
    pub epoch: i32,
    /// When it was created.
    pub created: std::time::SystemTime,
}

/// Changes of a world; `None` leaves a setting as it is.
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
    /// How long it may be idle; `Some(None)`: for ever.
    pub idle_ttl: Option<Option<Duration>>,
}

impl WorldUpdate {
    /// Changes the settings that it holds.
    pub fn apply(self, pace: &mut Pace) {
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

/// Which body: a name that says its profile, see [`super::convert::body`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyRef {
    /// Last part of the name.
    pub id: String,
    /// Who it stands for.
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
    /// Where it stands.
    pub place: Place,
    /// Constraints from the start.
    pub constraints: Vec<ConstraintSettings>,
}

/// Where a part of a figure is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ConstraintSettings {
    /// Segment and point, segment frame; no point: the middle of a hand, else the centre of mass. `None`: the figure's
    /// centre of mass.
    pub on: Option<(SegmentId, Option<Vec3>)>,
    /// Wanted position, world, m.
    pub position: Option<Vec3>,
    /// How much each axis counts, 0…1.
    pub axes: [f64; 3],
    /// Wanted rotation, `world_from_segment`.
    pub rotation: Option<Quat>,
    /// How much it counts, 0…1.
    pub weight: f64,
    /// Time to come and to go, s.
    pub ease: f64,
    /// How long, s; infinite until it is taken off.
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
    /// Who drives it.
    pub driver: Option<String>,
    /// Index in frames.
    pub index: i32,
    /// Constraints that hold, with the time that they have left.
    pub constraints: Vec<ConstraintSettings>,
    /// How it follows its motion, as of the last tick.
    pub follows: Follows,
}

/// How a figure follows its motion, with the help that it may get.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Follows {
    /// In which way, and what help that took.
    pub so_far: Following,
    /// Largest force of the help over the weight if the motion is being lost; 0: none.
    pub most_help: f64,
}

/// A world with its figures, as clients may ask for them at any time.
#[derive(Clone, Debug)]
pub struct Described {
    /// The world; its tick and time are those of the last change.
    pub world: WorldInfo,
    /// Its figures, in the order of creation.
    pub figures: Vec<FigureInfo>,
    /// Who controls each of them, in the same order.
    pub controls: Vec<ControlInfo>,
    /// When that was so.
    pub at: Instant,
}

/// Changes of a figure; `None` leaves a setting as it is.
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
    /// Most help while its motion is being lost, body weights.
    pub max_help: Option<f64>,
    /// Whether the body meets itself.
    pub self_contact: Option<bool>,
    /// All constraints.
    pub constraints: Option<Vec<ConstraintSettings>>,
    /// Protective steps.
    pub protective_steps: Option<bool>,
}

impl FigureUpdate {
    /// The options that it makes of those that a figure has.
    pub fn options(&self, now: FigureOptions) -> FigureOptions {
        FigureOptions {
            fatigue_time_scale: self.fatigue_time_scale.unwrap_or(now.fatigue_time_scale),
            assist: self.assist.unwrap_or(now.assist),
            max_help: self.max_help.unwrap_or(now.max_help),
            self_contact: self.self_contact.unwrap_or(now.self_contact),
        }
    }

    /// The settings that it makes of those that a figure has.
    #[must_use]
    pub fn applied(self, now: FigureSettings) -> FigureSettings {
        let options = self.options(now.options);
        // Whether a figure steps is no choice of the paper's controller.
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
            constraints: self.constraints.unwrap_or(now.constraints),
            ..now
        }
    }
}

/// How an obstacle moves, without its mass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObstacleMobility {
    /// Not at all.
    Fixed,
    /// With its velocity.
    Led,
    /// As a rigid body.
    Free,
}

/// Why a plane is not free.
pub const FREE_PLANE: &str = "a plane cannot move freely";

/// Changes of an obstacle; `None` leaves what it has at that tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObstacleUpdate {
    /// Shape.
    pub shape: Option<Shape>,
    /// How it moves.
    pub mobility: Option<ObstacleMobility>,
    /// Mass of a free one, kg.
    pub mass: Option<f64>,
    /// Friction.
    pub friction: Option<f64>,
    /// Position (m) and rotation.
    pub pose: Option<(Vec3, Quat)>,
    /// Velocity, m/s.
    pub velocity: Option<Vec3>,
    /// Angular velocity, rad/s.
    pub angular_velocity: Option<Vec3>,
}

impl ObstacleUpdate {
    /// The obstacle as it is to be.
    ///
    /// # Errors
    /// A free plane, or a free obstacle without mass.
    pub fn apply(self, now: &ObstacleSetup) -> Result<ObstacleSetup, Fault> {
        let shape = self.shape.unwrap_or(now.shape);
        let free = |mass: Option<f64>| match mass {
            _ if shape == Shape::Plane => Err(Fault::invalid("obstacle.mobility", FREE_PLANE)),
            Some(mass) => Ok(Mobility::Free(mass)),
            None => Err(Fault::invalid("obstacle.mass_kg", "must be given")),
        };
        let had = match now.mobility {
            Mobility::Free(mass) => Some(mass),
            Mobility::Fixed | Mobility::Led => None,
        };
        let mobility = match self.mobility {
            Some(ObstacleMobility::Fixed) => Mobility::Fixed,
            Some(ObstacleMobility::Led) => Mobility::Led,
            Some(ObstacleMobility::Free) => free(self.mass.or(had))?,
            None if had.is_some() => free(self.mass.or(had))?,
            None => now.mobility,
        };
        let (position, rotation) = self.pose.unwrap_or((now.position, now.rotation));
        Ok(ObstacleSetup {
            name: now.name.clone(),
            shape,
            mobility,
            friction: self.friction.unwrap_or(now.friction),
            position,
            rotation,
            velocity: self.velocity.unwrap_or(now.velocity),
            angular_velocity: self.angular_velocity.unwrap_or(now.angular_velocity),
        })
    }
}

/// What holds a load besides its segment. In bytes, the first two are an option.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum SecondSegment {
    /// Nothing.
    Never,
    /// Another segment from the beginning on, at a point as for the first.
    Holds(SegmentId, Option<Vec3>),
    /// The other hand reaches for it.
    Helps(SecondHand),
}

/// What disturbs a figure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Disturbance {
    /// A carried mass, kg.
    Load {
        /// Carrying segment.
        segment: SegmentId,
        /// Where, segment frame; `None`: the tip of hands and feet, else the centre of mass.
        point: Option<Vec3>,
        /// Mass, kg.
        mass: f64,
        /// Velocity before it is taken, world axes, m/s.
        velocity: Vec3,
        /// What else holds it.
        second: SecondSegment,
        /// Force at one hand beyond which it is lost, N.
        grip: f64,
        /// How long, s; infinite until cleared.
        duration: f64,
    },
    /// A force, N, world axes. An impulse is the force that gives it over its duration.
    Force {
        /// Pushed segment.
        segment: SegmentId,
        /// Where, segment frame; `None`: the centre of mass.
        point: Option<Vec3>,
        /// Force, N.
        force: Vec3,
        /// How long, s; infinite until cleared.
        duration: f64,
    },
}

/// A disturbance of one figure of a world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FigureDisturbance {
    /// Last part of the figure's name.
    pub figure: String,
    /// Tick at whose start it begins; `None`: the next.
    pub tick: Option<i64>,
    /// What happens.
    pub what: Disturbance,
}

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

/// Delay between arrival and use of live motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Delay {
    /// Always this many seconds.
    Fixed(f64),
    /// As the arrival jitter needs, at most this many seconds.
    Adaptive {
        /// Largest delay, s.
        most: f64,
    },
}

/// How a drive answers when frames are late, and how long it lasts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DriveSettings {
    /// Expected frames per second.
    pub rate_hz: f64,
    /// Delay between arrival and use.
    pub delay: Delay,
    /// How long the last velocity is continued, s; 0 holds at once.
    pub extrapolation: f64,
    /// How long the last posture is held before relaxing, s.
    pub hold: f64,
    /// How long the figures are kept without a connection or push, s.
    pub grace: f64,
    /// Put each figure into its first desired posture.
    pub reset: bool,
    /// Window in which motion is prepared, s; 0: frames are used as they come; `None`: as the server is set.
    pub window: Option<f64>,
}

/// Header of a drive.
#[derive(Clone, Debug, PartialEq)]
pub struct DriveOpen {
    /// Last part of the world's name.
    pub world: String,
    /// Last parts of the figures' names.
    pub figures: Vec<String>,
    /// Who drives; empty: the server chooses.
    pub driver: String,
    /// Whose drive it is, and by which leases.
    pub who: ControlKey,
    /// Settings.
    pub settings: DriveSettings,
}

/// Desired motion of one figure at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureSample {
    /// Position in the drive's list of figures.
    pub slot: usize,
    /// Desired posture. Without `has_root` its pelvis pose means nothing.
    pub posture: Posture,
    /// True if the sender gave the pelvis pose.
    pub has_root: bool,
    /// Desired velocity, layout of `State::velocity`.
    pub velocity: Option<Box<[f64; NV]>>,
    /// Which feet are planted.
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

/// How the jitter buffer answered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Supply {
    /// Nothing was asked yet.
    #[default]
    None,
    /// A frame exactly at the wanted time.
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
    /// Sequence of the newest frame that acts; −1 if none.
    pub applied_sequence: i64,
    /// Source time that acts, ns.
    pub applied_source_ns: i64,
    /// Motion held but not used, s.
    pub buffered: f64,
    /// Present delay, s.
    pub delay: f64,
    /// p99 of the arrival jitter, s.
    pub jitter: f64,
    /// Last answer.
    pub supply: Supply,
    /// Ticks by answer: present, interpolated, extrapolated, held, relaxed.
    pub ticks: [u64; 5],
    /// Frames too late to act.
    pub late: u64,
    /// Frames not newer than what was there.
    pub stale: u64,
    /// Frames dropped for want of room.
    pub overflow: u64,
    /// Times that the stream began anew.
    pub resyncs: u64,
    /// How far it is behind because its world leaves ticks out, s; contained in the delay.
    pub behind: f64,
    /// Window in which motion is prepared, s; contained in the delay.
    pub window: f64,
}

/// State of a drive.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Feedback {
    /// Who drives.
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

/// How numbers are written.
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
pub struct Fields(pub u32);

/// What a viewer wants; equal views share encoded frames.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ViewSpec {
    /// Last parts of figure names, sorted; empty: all.
    pub figures: Vec<String>,
    /// Fields.
    pub fields: Fields,
    /// Number format.
    pub format: NumberFormat,
    /// One frame for every so many ticks.
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

/// What a world looks like after one tick: everything that any view can show.
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
    /// Who is who; same order as `figures`.
    pub roster: Arc<[RosterEntry]>,
    /// Figures, in the order of creation.
    pub figures: Vec<FigureSnapshot>,
    /// Obstacles, in the order they were added.
    pub obstacles: Vec<ObstacleInfo>,
}

/// One obstacle.
#[derive(Clone, Debug)]
pub struct ObstacleInfo {
    /// Last part of its name.
    pub id: String,
    /// Counts up from obstacle to obstacle of a world.
    pub number: u64,
    /// What it is, with its present pose and velocity.
    pub setup: ObstacleSetup,
    /// Mean force on it over the last tick, N.
    pub force: Vec3,
}

/// One figure after one tick.
#[derive(Clone, Debug)]
pub struct FigureSnapshot {
    /// Its body.
    pub body: Arc<Body>,
    /// Positions and velocities.
    pub state: State,
    /// What the tick did; `None` before the first.
    pub report: Option<TickReport>,
    /// What was asked for at the end of the tick.
    pub desired: Target,
    /// Sequence of the desired-motion frame that acts; −1 if not driven live.
    pub applied_sequence: i64,
    /// Its source time, ns.
    pub applied_source_ns: i64,
    /// Loads carried: segment, point (segment frame, m), mass (kg).
    pub loads: Vec<(SegmentId, Vec3, f64)>,
    /// What each of the report's touches touches: `figures/{figure}` or `obstacles/{obstacle}`.
    pub touched: Vec<String>,
    /// How it follows its motion.
    pub follows: Follows,
}

/// What happened in a world.
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
    /// Balance was found again.
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
    /// The other hand took hold of a load too: segment, kg, that hand, share of its strength that the arm needs alone
    /// and with help.
    LoadShared(SegmentId, f64, SegmentId, [f64; 2]),
    /// It let go: the same.
    LoadUnshared(SegmentId, f64, SegmentId, [f64; 2]),
    /// A push was accepted: segment, N·s.
    Pushed(SegmentId, f64),
    /// A segment began to touch a figure or an obstacle: name and, of a figure, its segment.
    Touched(SegmentId, String, Option<SegmentId>),
    /// A segment no longer touches it.
    Parted(SegmentId, String, Option<SegmentId>),
    /// Something is in the way of its steps: the figure broke off what it did.
    WayBarred,
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
    /// A driver no longer has the figure: driver, why.
    DriveEnded(String),
    /// The stream of a drive began anew: driver and reason.
    DriveResynced(String),
    /// A lease began: holder, and from whom.
    ControlAcquired(String),
    /// A lease ended: holder, why.
    ControlReleased(String),
    /// A lease was taken by higher priority: by whom, from whom.
    ControlPreempted(String),
    /// A lease is offered: by whom, to whom.
    ControlOffered(String),
    /// Someone was refused: who, which call.
    AccessRefused(String),
    /// The world was paused.
    Paused,
    /// The world was put into the state of a checkpoint of this tick.
    Restored(u64),
    /// The world was resumed.
    Resumed,
    /// The world failed: why.
    Failed(String),
    /// The world was deleted: by whom, or why.
    Deleted(String),
    /// A clip of this id began to play.
    ClipBegan(String),
    /// A clip of this id is over, or was ended.
    ClipEnded(String),
}

/// One event.
#[derive(Clone, Debug, PartialEq)]
pub struct WorldEvent {
    /// Tick after which it was true.
    pub tick: u64,
    /// World time, s.
    pub time: f64,
    /// Last part of the figure's name; empty for events of the world.
    pub figure: String,
    /// What happened.
    pub kind: EventKind,
}

/// Who wants to control a figure, and by which tokens.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlKey {
    /// Who.
    pub principal: Arc<str>,
    /// Tokens of leases.
    pub tokens: Vec<String>,
}

/// How a lease is wanted.
#[derive(Clone, Debug)]
pub struct Acquire {
    /// Token of a new lease.
    pub token: String,
    /// Priority.
    pub priority: i32,
    /// How long it is kept unused.
    pub grace: Duration,
    /// Who wants it is known, not anonymous.
    pub known: bool,
}

/// How a lease is offered.
#[derive(Clone, Debug)]
pub struct Transfer {
    /// To whom; `None`: to who has the token.
    pub to: Option<Arc<str>>,
    /// Token of the offer.
    pub token: String,
    /// How long the figure goes over, s.
    pub blend: f64,
    /// How long it stands.
    pub lasts: Duration,
}

/// SHA-256 of a secret.
pub type TokenHash = [u8; 32];

/// A lease as it outlives the server.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptLease {
    /// Who has it.
    pub holder: Arc<str>,
    /// What is known of its secret.
    pub token: TokenHash,
    /// Its priority.
    pub priority: i32,
    /// How long it is kept unused.
    pub grace: Duration,
}

/// Who controls a figure.
#[derive(Clone, Debug, Default)]
pub struct ControlInfo {
    /// Last part of the figure's name.
    pub figure: String,
    /// Who; `None`: nobody.
    pub holder: Option<Arc<str>>,
    /// How often that changed.
    pub epoch: i64,
    /// Priority.
    pub priority: i32,
    /// When it ends; `None`: not as long as it is used.
    pub expires_in: Option<Duration>,
    /// It came with a drive.
    pub implicit: bool,
    /// To whom it is offered.
    pub offered_to: Option<Arc<str>>,
    /// What of it outlives the server. Not for clients.
    pub kept: Option<KeptLease>,
}

/// Which events a viewer wants.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EventFilter {
    /// Last parts of figure names; empty: all, and events of the world.
    pub figures: Vec<String>,
    /// Wanted types as on the wire; empty: all.
    pub types: Vec<i32>,
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

/// What an offline simulation is asked for.
#[derive(Clone, Debug)]
pub struct SimulationSettings {
    /// The figure.
    pub figure: FigureSettings,
    /// Ticks per second.
    pub rate_hz: f64,
    /// Substeps per tick.
    pub substeps: u32,
    /// How long, s; `None`: the length of the clip.
    pub duration: Option<f64>,
    /// Repeat the clip.
    pub looped: bool,
    /// Disturbances by time, s.
    pub disturbances: Vec<(f64, Disturbance)>,
    /// Frames wanted.
    pub view: Option<ViewSpec>,
}

/// Figures of merit of a simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulationSummary {
    /// Ticks.
    pub ticks: u64,
    /// Ticks per second.
    pub rate_hz: f64,
    /// When the figure fell, s.
    pub fell_at: Option<f64>,
    /// Root mean square of the joint angle errors against the target that moves along with the feet, rad.
    pub tracking_joint_rms: f64,
    /// Largest joint angle error against that target, rad.
    pub tracking_joint_max: f64,
    /// Largest torque relative to the torque available.
    pub utilisation: f64,
    /// Largest violation of the strength.
    pub over_limit: f64,
    /// Time at the limit per DOF, s.
    pub saturated: Vec<f64>,
    /// Least margin, m.
    pub margin: Option<f64>,
    /// Largest penetration, m.
    pub penetration: f64,
    /// State hash at the end.
    pub hash: u64,
    /// Median and p99 of the time of a tick, µs.
    pub tick_us: [f64; 2],
}
