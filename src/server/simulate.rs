//! One clip tracked by one figure, without clock and world: as fast as it can be computed.

use super::encoded::{Encoded, List};
use super::engine::{self, Clip, FigureKey, Motion, World};
use super::ingest::time::SourceTime;
use super::progress::WorkProgress;
use super::tick::stage_times::percentiles;
use super::workers::Turn;
use sinew_physics::body::{Body, DOF_COUNT};
use sinew_physics::figure::{Flags, TickReport};
use sinew_physics::motion::GRAVITY;
use sinew_physics::time::WorldTime;
use sinew_physics::world::WorldParams;
use sinew_wire::frame::world_frame;
use sinew_wire::pb;
use sinew_wire::status::Fault;
use sinew_wire::types::{
    Overrun, RosterEntry, SimulationSettings, SimulationSummary, Snapshot, ViewSpec, WorldEvent,
    WorldPace, WorldSettings,
};
use std::sync::Arc;
use std::time::Instant;

/// The result of a simulation.
#[derive(Debug)]
pub struct SimulationOutcome {
    /// Figures of merit.
    pub summary: SimulationSummary,
    /// Frames of the view: field [`FRAMES`] of the answer.
    pub frames: Encoded,
    /// Events in order.
    pub events: Vec<WorldEvent>,
}

/// Limits of one simulation.
#[derive(Clone, Copy, Debug)]
pub struct SimulationLimits {
    /// Longest simulated time, s.
    pub seconds: f64,
    /// Most bytes of frames.
    pub bytes: u64,
}

/// The field of `SimulateClipResponse` that holds the frames.
pub const FRAMES: u32 = 2;

/// Most events that are kept: a figure in trouble changes support and saturation in every tick.
const MAX_EVENTS: usize = 20_000;

/// Name of the only figure.
const FIGURE: &str = "figure";

#[derive(Default)]
struct Merit {
    square: f64,
    most: f64,
    utilisation: f64,
    over_limit: f64,
    saturated: Vec<u64>,
    margin: Option<f64>,
    penetration: f64,
    fell_at: Option<f64>,
    micros: Vec<f32>,
}

impl Merit {
    fn count(&mut self, r: &TickReport, time: f64) {
        for d in 0..DOF_COUNT {
            let e = r.joints.joint_error[d].abs();
            self.square += e * e;
            self.most = self.most.max(e);
            let limit = if r.joints.torque[d] < 0.0 {
                r.joints.torque_lower[d]
            } else {
                r.joints.torque_upper[d]
            };
            if limit.abs() > 0.0 {
                self.utilisation = self.utilisation.max((r.joints.torque[d] / limit).abs());
            }
            self.saturated[d] += r.joints.saturated >> d & 1;
        }
        self.over_limit = self.over_limit.max(r.joints.over_limit);
        self.penetration = self.penetration.max(r.penetration);
        if let Some(m) = r.balance.margin {
            self.margin = Some(self.margin.map_or(m, |least| least.min(m)));
        }
        if r.flags.has(Flags::FALLEN) && self.fell_at.is_none() {
            self.fell_at = Some(time);
        }
    }

    fn summary(&self, ticks: u64, rate_hz: f64, hash: u64) -> SimulationSummary {
        let times = percentiles(self.micros.iter().copied());
        SimulationSummary {
            ticks,
            rate_hz,
            fell_at: self.fell_at,
            tracking_joint_rms: (self.square / (ticks as f64 * DOF_COUNT as f64)).sqrt(),
            tracking_joint_max: self.most,
            utilisation: self.utilisation,
            over_limit: self.over_limit,
            saturated: self.saturated.iter().map(|n| *n as f64 / rate_hz).collect(),
            margin: self.margin,
            penetration: self.penetration,
            hash,
            tick_us: [times.p50, times.p99],
        }
    }
}

/// The receiver of frames as they are computed.
pub trait FrameSink {
    /// Takes the share that is done, and a frame if this tick has one for the view.
    ///
    /// # Errors
    /// The frames have no receiver any more.
    fn take(&mut self, frame: Option<pb::WorldFrame>, share: f64) -> Result<(), Fault>;

    /// There are no more frames.
    ///
    /// # Errors
    /// The last frames have no receiver any more.
    fn end(&mut self) -> Result<(), Fault>;
}

/// The receiver of frames during the simulation.
pub struct Sink<'a> {
    /// Receives the progress.
    pub progress: &'a WorkProgress,
    /// Takes the frames instead of the outcome.
    pub parts: Option<&'a mut dyn FrameSink>,
}

/// Simulates, tick by tick, as long as its turn lasts.
///
/// # Errors
/// The physics refuses the settings; there are more frames than the limit allows; or no client waits any more.
pub fn run(
    s: &SimulationSettings,
    body: &Arc<Body>,
    clip: Arc<Clip>,
    limits: SimulationLimits,
    (turn, mut sink): (&Turn, Sink<'_>),
) -> Result<SimulationOutcome, Fault> {
    let duration = s.duration.unwrap_or_else(|| clip.duration());
    if duration > limits.seconds {
        return Err(Fault::Exhausted {
            limit: "max_simulation_s",
            value: limits.seconds as u64,
            message: format!("the clip is {duration:.1} s long; give duration_s"),
            retry: None,
        });
    }
    let (mut world, key) = scene(s, body, clip)?;
    let ticks = ((duration * s.rate_hz).round() as u64).max(1);
    let mut merit = Merit {
        saturated: vec![0; DOF_COUNT],
        ..Merit::default()
    };
    let mut frames = EncodedFrames::new(s, limits.bytes);
    let mut events = Vec::new();
    for _ in 0..ticks {
        if turn.stop() {
            return Err(Turn::gone());
        }
        let before = world.time();
        let start = Instant::now();
        world.step();
        merit.micros.push(start.elapsed().as_secs_f32() * 1e6);
        let figure = world.figure(key).expect("it is still there");
        let (tick, time) = (world.tick(), world.time().0);
        if let Some(r) = figure.report() {
            merit.count(r, time);
        }
        for e in figure.events() {
            if events.len() < MAX_EVENTS {
                events.push(WorldEvent {
                    tick,
                    time,
                    figure: FIGURE.into(),
                    kind: engine::event_kind(e, |_| String::new()),
                });
            }
        }
        let view = s.view.as_ref();
        let view = view.filter(|v| tick % u64::from(v.divisor) == 0);
        let frame = view.map(|view| frames.frame(&world, key, before, view));
        match (&mut sink.parts, frame) {
            (Some(parts), frame) => parts.take(frame, tick as f64 / ticks as f64)?,
            (None, Some(frame)) => frames.keep(&frame)?,
            (None, None) => {}
        }
        sink.progress.tell(tick as f64, ticks as f64);
    }
    if let Some(parts) = sink.parts {
        parts.end()?;
    }
    Ok(SimulationOutcome {
        summary: merit.summary(ticks, s.rate_hz, world.state_hash()),
        frames: frames.taken.into_encoded(),
        events,
    })
}

/// A world with one figure that begins the clip, and the disturbances to come.
fn scene(
    s: &SimulationSettings,
    body: &Arc<Body>,
    clip: Arc<Clip>,
) -> Result<(World, FigureKey), Fault> {
    let mut world = engine::new_world(&WorldSettings {
        rate_hz: s.rate_hz,
        substeps: s.substeps,
        gravity: GRAVITY,
        friction: WorldParams::default().friction,
        collisions: false,
        pace: WorldPace {
            display_name: String::new(),
            overrun: Overrun::Dilate,
            catch_up_limit: 1,
            speed: 1.0,
            idle_ttl: None,
        },
    })?;
    let key = engine::add_figure(&mut world, FIGURE, &s.figure, body.clone())?;
    let place = engine::place_of(clip.posture(0));
    let figure = world.figure_mut(key).expect("it was just added");
    let state = engine::first_state(&clip, place);
    figure.set_drive(Motion::Clip(engine::playback(
        clip,
        WorldTime(0.0),
        1.0,
        s.looped,
        (place, false),
    )));
    engine::reset(&mut world, key, state)?;
    for (from, what) in &s.disturbances {
        let p = engine::perturbation(body, what, *from);
        engine::perturb(&mut world, key, p)?;
    }
    Ok((world, key))
}

/// Frames of the view, as many as fit into the response. They are kept encoded: a small frame takes a hundred times as
/// much memory as bytes on the wire.
struct EncodedFrames {
    taken: List,
    most: u64,
    roster: Arc<[RosterEntry]>,
}

impl EncodedFrames {
    fn new(s: &SimulationSettings, most: u64) -> Self {
        Self {
            taken: List::new(FRAMES),
            most,
            roster: Arc::new([RosterEntry {
                index: 0,
                figure: FIGURE.into(),
                body: s.figure.body.id.clone(),
            }]),
        }
    }

    /// The world after a tick that began at `before`.
    fn frame(
        &self,
        world: &World,
        key: FigureKey,
        before: WorldTime,
        view: &ViewSpec,
    ) -> pb::WorldFrame {
        let figure = world.figure(key).expect("it is still there");
        let snapshot = Snapshot {
            world: "".into(),
            rate_hz: world.params().rate_hz,
            gravity: GRAVITY,
            tick: world.tick(),
            time: world.time().0,
            hash: world.state_hash(),
            epoch: 1,
            server_ns: 0,
            roster_version: 1,
            roster: self.roster.clone(),
            figures: vec![engine::snapshot(
                figure,
                (before, world.dt()),
                (-1, SourceTime(0)),
                |_| String::new(),
            )],
            obstacles: Vec::new(),
        };
        world_frame(&snapshot, view)
    }

    /// Keeps a frame for the outcome.
    fn keep(&mut self, frame: &pb::WorldFrame) -> Result<(), Fault> {
        self.taken.push(frame);
        if self.taken.len() as u64 > self.most {
            return Err(Fault::Exhausted {
                limit: "max_response_bytes",
                value: self.most,
                message: "frames of this view; ask for fewer fields or a larger rate_divisor"
                    .into(),
                retry: None,
            });
        }
        Ok(())
    }
}
