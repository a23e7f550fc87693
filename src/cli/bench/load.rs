//! The load: drivers that send by a schedule, viewers that record the frames they receive, and calls.

use super::args::{BenchArgs, TAIL};
use crate::remote::explain;
use hdrhistogram::Histogram;
use sinew_client::Client;
use sinew_physics::body::topology::DOF_COUNT;
use sinew_wire::pb;
use sinew_wire::watched::WatchWorldResponse;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::{Semaphore, mpsc};
use tokio::task::JoinHandle;
use tonic::Status;

/// Largest delay that is resolved, µs: a minute.
const LONGEST_US: u64 = 60_000_000;
/// Significant digits of a delay.
const DIGITS: u8 = 3;
/// The joint that drivers move: the right elbow.
const ELBOW: usize = 19;
/// Frames of a driver that wait for its connection, 17 s at 60 Hz. The schedule does not wait for the connection;
/// frames that do not fit are lost, and counted.
const QUEUE: usize = 1024;
/// Calls that wait for their answers.
const CALLS: usize = 4096;
/// Fields that viewers request: enough to draw a figure.
const FIELDS: [&str; 2] = ["root_pose", "joint_rotations"];

/// Name of a figure.
pub(super) fn figure(i: u32) -> String {
    format!("f{i}")
}

/// The schedule of a measurement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Schedule {
    /// Time before the measurement.
    pub warm_up: Duration,
    /// Duration of the measurement.
    pub length: Duration,
}

/// Due time of number `i` of `rate` per second. Streams begin at different phases (0…1) of the period, so that they do
/// not all send at once.
fn due(begun: Instant, (rate, phase): (f64, f64), i: u64) -> Instant {
    begun + Duration::from_secs_f64((i as f64 + phase) / rate)
}

/// The measurements of the clients.
#[derive(Debug)]
pub(super) struct LoadMeasures {
    /// From the time a frame of motion was due to be sent until a viewer had the frame that shows it, µs.
    pub shown: Histogram<u64>,
    /// From the time a frame of motion was due to be sent until it was sent, µs: the part of the delay caused by the
    /// clients.
    pub sent: Histogram<u64>,
    /// From the time a read was due until its answer, µs.
    pub calls: Histogram<u64>,
    /// From the time a change was due until its answer, µs.
    pub changes: Histogram<u64>,
    /// Errors, by where and code.
    pub errors: BTreeMap<String, u64>,
}

/// The state of a bench.
pub(super) struct Load {
    schedule: Schedule,
    /// Start of the schedule; empty until all streams are open.
    begun: OnceLock<Instant>,
    stopped: AtomicBool,
    measured: Mutex<LoadMeasures>,
    /// Frames of motion due during the measurement.
    pub due: AtomicU64,
    /// Frames that viewers received during the measurement.
    pub frames: AtomicU64,
    /// Ticks that viewers missed during the measurement.
    pub missed: AtomicU64,
}

impl Load {
    /// A load that has not begun yet.
    pub(super) fn new(schedule: Schedule) -> anyhow::Result<Self> {
        let histogram = || Histogram::new_with_bounds(1, LONGEST_US, DIGITS);
        Ok(Self {
            schedule,
            begun: OnceLock::new(),
            stopped: AtomicBool::new(false),
            measured: Mutex::new(LoadMeasures {
                shown: histogram()?,
                sent: histogram()?,
                calls: histogram()?,
                changes: histogram()?,
                errors: BTreeMap::new(),
            }),
            due: AtomicU64::new(0),
            frames: AtomicU64::new(0),
            missed: AtomicU64::new(0),
        })
    }

    /// The time of the measurement.
    pub(super) fn window(&self) -> Range<Instant> {
        let begun = *self.begun.get_or_init(Instant::now);
        let from = begun + self.schedule.warm_up;
        from..from + self.schedule.length
    }

    pub(super) fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
    }

    fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }

    pub(super) fn measured(&self) -> MutexGuard<'_, LoadMeasures> {
        // Entries are always complete, so a poisoned lock does no harm.
        self.measured.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn error(&self, what: &str, why: &Status) {
        if self.is_stopped() {
            return; // streams end now
        }
        let key = format!("{what}: {} ({:?})", why.message(), why.code());
        *self.measured().errors.entry(key).or_default() += 1;
    }
}

fn micros(since: Instant) -> u64 {
    (since.elapsed().as_micros() as u64).clamp(1, LONGEST_US)
}

/// One of a series of scheduled calls: its number, and its due time.
type DueCall = (u64, Instant);

/// Opens all streams, then begins.
pub(super) async fn start(
    load: &Arc<Load>,
    args: &BenchArgs,
    clients: &[Client],
    names: &[String],
) -> anyhow::Result<Vec<JoinHandle<()>>> {
    let mut tasks = Vec::new();
    let mut paced = Vec::new();
    let mut next = clients.iter().cycle();
    let mut client = || next.next().expect("there is a connection at least");
    for (i, name) in names.iter().enumerate() {
        let pace = (args.traffic.rate, i as f64 / names.len() as f64);
        for _ in 0..args.viewers {
            tasks.push(viewer(load, client(), name, pace).await?);
        }
        if args.figures > 0 {
            let (queue, task) = driver(load, client(), name, args).await?;
            paced.push((pace, queue));
            tasks.push(task);
        }
    }
    let changes = if args.figures > 0 {
        args.traffic.changes
    } else {
        0.0
    };
    for (kind, rate) in [
        (WorldCall::Read, args.traffic.calls),
        (WorldCall::Change, changes),
    ] {
        if rate > 0.0 {
            let (queue, task) = calls(load, clients, names, kind);
            paced.push(((rate, 0.0), queue));
            tasks.push(task);
        }
    }
    load.window(); // begins
    let load = load.clone();
    std::thread::Builder::new()
        .name("pace".to_owned())
        .spawn(move || pace(&load, &paced))?;
    Ok(tasks)
}

/// Announces calls when they are due. A separate thread sleeps more exactly than the timer of the runtime, which counts
/// in milliseconds.
#[allow(
    clippy::disallowed_methods,
    reason = "the schedule is one of absolute times"
)]
fn pace(load: &Load, paced: &[((f64, f64), mpsc::Sender<DueCall>)]) {
    let window = load.window();
    let (begun, end) = (window.start - load.schedule.warm_up, window.end);
    let mut waiting: BinaryHeap<Reverse<(Instant, usize, u64)>> = paced
        .iter()
        .enumerate()
        .map(|(k, (pace, _))| Reverse((due(begun, *pace, 0), k, 0)))
        .collect();
    while let Some(Reverse((at, k, i))) = waiting.pop() {
        if at >= end || load.is_stopped() {
            break;
        }
        std::thread::sleep(at.saturating_duration_since(Instant::now()));
        let (pace, queue) = &paced[k];
        if queue.try_send((i, at)).is_err() {
            load.error(
                "sending",
                &Status::resource_exhausted("too much waits already"),
            );
        }
        waiting.push(Reverse((due(begun, *pace, i + 1), k, i + 1)));
    }
}

/// Frame `i` of the motion of all figures of a world: they stand and bend an elbow.
fn motion(rate: f64, figures: u32, i: u64) -> pb::MotionFrame {
    let t = i as f64 / rate;
    let mut angles = vec![0.0; DOF_COUNT];
    angles[ELBOW] = 0.6 - 0.6 * (1.5 * t).cos();
    let one = |f| pb::FigureMotion {
        figure_id: figure(f),
        joint_angles_rad: angles.clone(),
        planted: vec![true, true],
        ..Default::default()
    };
    pb::MotionFrame {
        sequence: i as i64,
        source_time_ns: (t * 1e9) as i64,
        figures: (0..figures).map(one).collect(),
    }
}

/// Opens the stream of a driver.
async fn driver(
    load: &Arc<Load>,
    client: &Client,
    world: &str,
    args: &BenchArgs,
) -> anyhow::Result<(mpsc::Sender<DueCall>, JoinHandle<()>)> {
    let header = pb::DriveHeader {
        world: format!("worlds/{world}"),
        figure_ids: (0..args.figures).map(figure).collect(),
        driver_id: "bench".into(),
        nominal_rate_hz: args.traffic.rate,
        playout_delay_ms: Some(args.traffic.playout),
        ..Default::default()
    };
    let mut driver = client.drive(header).await.map_err(|e| explain(&e))?;
    let (queue, mut waiting) = mpsc::channel::<DueCall>(QUEUE);
    let (load, rate, figures) = (load.clone(), args.traffic.rate, args.figures);
    let task = tokio::spawn(async move {
        let ended = loop {
            tokio::select! {
                next = waiting.recv() => {
                    let Some((i, at)) = next else { break None };
                    if !driver.send(vec![motion(rate, figures, i)]).await {
                        break Some(Status::unavailable("the server ended the stream"));
                    }
                    if load.window().contains(&at) {
                        load.due.fetch_add(1, Ordering::Relaxed);
                        load.measured().sent.saturating_record(micros(at));
                    }
                }
                told = driver.feedback() => match told {
                    Ok(Some(_)) => {}
                    Ok(None) => break Some(Status::unavailable("the server ended the stream")),
                    Err(e) => break Some(e),
                },
            }
        };
        match ended {
            Some(why) => load.error("driving", &why),
            // Keeps the figures until viewers have seen the last frame.
            None => tokio::time::sleep(TAIL).await,
        }
    });
    Ok((queue, task))
}

/// Opens the stream of a viewer, for a world whose driver sends at this pace.
async fn viewer(
    load: &Arc<Load>,
    client: &Client,
    world: &str,
    pace: (f64, f64),
) -> anyhow::Result<JoinHandle<()>> {
    let view = pb::View {
        fields: Some(prost_types::FieldMask {
            paths: FIELDS.map(str::to_owned).into(),
        }),
        rate_divisor: 1,
        ..Default::default()
    };
    let watched = client.watch(&format!("worlds/{world}"), view, None).await;
    let mut frames = watched.map_err(|e| explain(&e))?;
    let load = load.clone();
    Ok(tokio::spawn(async move {
        let mut seen = ViewerLog::default();
        while !load.is_stopped() {
            match frames.message().await {
                Ok(Some(WatchWorldResponse::Frame(frame))) => seen.frame(&load, pace, &frame),
                Ok(Some(_)) => {}
                Ok(None) => break,
                Err(e) => {
                    load.error("watching", &e);
                    break;
                }
            }
        }
    }))
}

/// The frames that a viewer has received.
#[derive(Default)]
struct ViewerLog {
    tick: Option<i64>,
    /// Newest sequence by figure.
    newest: BTreeMap<i32, i64>,
}

impl ViewerLog {
    fn frame(&mut self, load: &Load, pace: (f64, f64), frame: &pb::WorldFrame) {
        if load.begun.get().is_none() {
            return;
        }
        let window = load.window();
        let begun = window.start - load.schedule.warm_up;
        let before = self.tick.replace(frame.tick);
        if window.contains(&Instant::now()) {
            let missed = before.map_or(0, |b| (frame.tick - b - 1).max(0));
            load.frames.fetch_add(1, Ordering::Relaxed);
            load.missed.fetch_add(missed as u64, Ordering::Relaxed);
        }
        // A frame that shows one sequence number accounts for the earlier ones, too: later frames replaced them.
        let mut delays = Vec::new();
        for f in &frame.figures {
            let newest = self.newest.entry(f.figure_index).or_insert(-1);
            for i in *newest + 1..=f.applied_sequence {
                let at = due(begun, pace, i as u64);
                if window.contains(&at) {
                    delays.push(micros(at));
                }
            }
            *newest = f.applied_sequence.max(*newest);
        }
        if !delays.is_empty() {
            let mut measured = load.measured();
            for delay in delays {
                measured.shown.saturating_record(delay);
            }
        }
    }
}

/// The calls made to one world after the other.
#[derive(Clone, Copy, Debug)]
enum WorldCall {
    /// Reads its latest frame.
    Read,
    /// Clears all perturbations of its first figure. The next tick executes this, and it is recorded like any change.
    Change,
}

impl WorldCall {
    async fn carry_out(self, client: &Client, world: String) -> Result<(), Status> {
        match self {
            Self::Read => {
                let request = pb::GetWorldFrameRequest {
                    world,
                    ..Default::default()
                };
                client.states().get_world_frame(request).await.map(drop)
            }
            Self::Change => {
                let request = pb::ClearPerturbationsRequest {
                    figure: format!("{world}/figures/{}", figure(0)),
                    ..Default::default()
                };
                let mut client = client.perturbations();
                client.clear_perturbations(request).await.map(drop)
            }
        }
    }
}

/// Makes calls when they are due.
fn calls(
    load: &Arc<Load>,
    clients: &[Client],
    names: &[String],
    kind: WorldCall,
) -> (mpsc::Sender<DueCall>, JoinHandle<()>) {
    let (queue, mut waiting) = mpsc::channel::<DueCall>(QUEUE);
    let (load, clients, names) = (load.clone(), clients.to_vec(), names.to_vec());
    let places = Arc::new(Semaphore::new(CALLS));
    let task = tokio::spawn(async move {
        while let Some((i, at)) = waiting.recv().await {
            let Ok(place) = places.clone().try_acquire_owned() else {
                load.error(
                    "calling",
                    &Status::resource_exhausted("too many calls wait already"),
                );
                continue;
            };
            let client = clients[i as usize % clients.len()].clone();
            let world = format!("worlds/{}", names[i as usize % names.len()]);
            let load = load.clone();
            tokio::spawn(async move {
                match kind.carry_out(&client, world).await {
                    Ok(()) if load.window().contains(&at) => {
                        let mut measured = load.measured();
                        let delays = match kind {
                            WorldCall::Read => &mut measured.calls,
                            WorldCall::Change => &mut measured.changes,
                        };
                        delays.saturating_record(micros(at));
                    }
                    Ok(()) => {}
                    Err(e) => load.error("calling", &e),
                }
                drop(place);
            });
        }
    });
    (queue, task)
}
