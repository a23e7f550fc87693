//! A trial: one figure follows one motion in a world of its own, from the beginning of the motion to a little after its
//! end, and is judged by its distance from the recording.

use super::result::LOST;
use crate::body::topology::SEGMENT_COUNT;
use crate::body::{Body, Posture, State};
use crate::figure::{ControllerKind, FigureOptions, Flags, Perturbation, StrengthScale};
use crate::math::Vec3;
use crate::math::rounding::short;
use crate::motion::leg_ik::forward;
use crate::motion::{Clip, GRAVITY};
use crate::plan::StreamPlan;
use crate::plan::contact_labels::{ContactPhase, phases};
use crate::plan::stream::RATE;
use crate::time::{StreamTime, WorldTime};
use crate::world::{
    ClipPlayback, Figure, FigureKey, FigureSetup, LivePlayback, MotionSource, RehearsedMotion,
    RehearsedPlayback, World, WorldError, WorldParams,
};
use std::sync::Arc;

/// Time for which a figure is watched after a prepared clip has ended, s.
const AFTER: f64 = 1.0;
/// A pelvis below this share of the height at which the clip ends is on the floor.
const DOWN: f64 = 0.5;
/// The same as [`AFTER`] after a stream, s, whose last posture is held.
const AFTER_STREAM: f64 = 3.0;

/// The motions that a trial is measured against.
#[derive(Clone, Debug)]
pub struct TrackingReference {
    /// The recording as fitted to the body: no foot lock, no shift for balance, no steps before or after it, runs
    /// unchanged.
    pub recorded: Arc<Clip>,
    /// The motion as prepared, at the same place in the world.
    pub prepared: Arc<Clip>,
    /// The feet that the recording has on the floor.
    pub phases: Vec<ContactPhase>,
}

impl TrackingReference {
    /// A motion that was made for the body: it is its own recording.
    pub fn authored(clip: Arc<Clip>) -> Self {
        let label: Vec<[bool; 2]> = (0..clip.len()).map(|i| clip.planted(i)).collect();
        Self {
            phases: phases(&label, clip.rate_hz()),
            recorded: Arc::clone(&clip),
            prepared: clip,
        }
    }

    /// Feet on the floor at time `t` of the recording, s.
    pub fn labelled(&self, t: f64) -> [bool; 2] {
        let phase = self.phases.iter().find(|p| t < p.end);
        phase
            .or(self.phases.last())
            .map_or([false; 2], |p| p.planted)
    }
}

/// Everything that a trial depends on besides its motion.
#[derive(Clone, Debug)]
pub struct Conditions {
    /// The body.
    pub body: Arc<Body>,
    /// The world.
    pub world: WorldParams,
    /// Strength.
    pub strength: StrengthScale,
    /// Assist and fatigue.
    pub options: FigureOptions,
    /// Loads and pushes, in world time: 0 is the beginning of the way into the clip.
    pub perturbations: Vec<Perturbation>,
    /// Streams the recording through a preparation window of this length, s, instead of playing the prepared motion.
    pub live_window: Option<f64>,
    /// Plays this instead: world time 0 is the beginning of its way in.
    pub rehearsed: Option<RehearsedRun>,
}

/// A rehearsed motion, and the state from which a figure begins it.
#[derive(Clone, Debug)]
pub struct RehearsedRun {
    /// The motion.
    pub motion: Arc<RehearsedMotion>,
    /// Its own beginning, or one near it.
    pub from: State,
}

/// A world with one figure that follows a motion. Each [`step`](Self::step) is a tick.
#[derive(Debug)]
pub struct Trial<'a> {
    reference: &'a TrackingReference,
    world: World,
    key: FigureKey,
    /// When the motion's first frame is due.
    lead: WorldTime,
    ticks_left: u64,
    /// Samples of the stream that have been fed.
    fed: usize,
}

impl<'a> Trial<'a> {
    /// A trial at the beginning of the motion.
    ///
    /// # Errors
    /// Conditions that no world or figure accepts.
    pub fn new(c: &Conditions, reference: &'a TrackingReference) -> Result<Self, WorldError> {
        let mut world = World::new(c.world)?;
        let (drive, lead, length) = match (&c.rehearsed, c.live_window) {
            (Some(run), _) => {
                let play = RehearsedPlayback::new(Arc::clone(&run.motion), WorldTime(0.0));
                let length = run.motion.duration() + AFTER;
                (MotionSource::Rehearsed(play), run.motion.lead_in(), length)
            }
            (None, Some(window)) => {
                let drive = stream(c, reference, window);
                (drive, 0.0, reference.recorded.duration() + AFTER_STREAM)
            }
            (None, None) => {
                let clip = &reference.prepared;
                let lead = clip.lead_in();
                let play = ClipPlayback::new(Arc::clone(clip), WorldTime(lead));
                let length = lead + clip.duration() + clip.lead_out() + AFTER;
                (MotionSource::Clip(play), lead, length)
            }
        };
        let state = match &c.rehearsed {
            Some(run) => run.from,
            None => drive.targets(WorldTime(0.0), world.dt()).now.state(),
        };
        let key = world.add_figure(FigureSetup {
            strength: c.strength.clone(),
            options: c.options,
            ..FigureSetup::new(Arc::clone(&c.body), ControllerKind::Modern, state)
        })?;
        for what in &c.perturbations {
            world.perturb(key, *what)?;
        }
        let figure = world.figure_mut(key).expect("it was just added");
        figure.set_drive(drive);
        Ok(Self {
            reference,
            world,
            key,
            lead: WorldTime(lead),
            ticks_left: (length * c.world.rate_hz).round().max(1.0) as u64,
            fed: fed(c.live_window),
        })
    }

    /// The world.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The figure.
    pub fn figure(&self) -> &Figure {
        self.world.figure(self.key).expect("it is never removed")
    }

    /// One tick; its end on the clip's clock, s, or `None` once the trial is over.
    pub fn step(&mut self) -> Option<f64> {
        self.ticks_left = self.ticks_left.checked_sub(1)?;
        let end = self.world.time() + self.world.dt();
        let figure = self.world.figure_mut(self.key);
        if let Some(live) = figure.and_then(|f| f.stream_mut()) {
            // The stream arrives at its own rate, regardless of that of the world.
            while (self.fed as f64) / RATE <= live.stream_time(end).0 + live.motion.window() {
                live.motion.push(&posture(self.reference, self.fed), None);
                self.fed += 1;
            }
        }
        self.world.step();
        Some(self.world.time() - self.lead)
    }
}

/// Sample `i` of the stream: the recording, then its last posture.
fn posture(reference: &TrackingReference, i: usize) -> Posture {
    let clip = &reference.recorded;
    clip.sample((i as f64 / RATE).min(clip.duration())).posture
}

/// Samples that are fed before the first tick.
fn fed(window: Option<f64>) -> usize {
    window.map_or(0, |w| (w * RATE).floor() as usize + 1)
}

/// A stream whose window is full.
fn stream(c: &Conditions, reference: &TrackingReference, window: f64) -> MotionSource {
    let mut motion = StreamPlan::new(Arc::clone(&c.body), window);
    for i in 0..fed(Some(window)) {
        motion.push(&posture(reference, i), None);
    }
    motion.advance(StreamTime(1.0 / RATE));
    MotionSource::Live(Box::new(LivePlayback {
        motion,
        offset: 0.0,
    }))
}

/// The result of a trial. Times are on the clip's clock (negative in the way into the clip).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TrialResult {
    /// The mean distance from the recording never exceeded 0.5 m (PHC's rule) to the clip's end.
    pub completed: bool,
    /// Time at which it exceeded that, s.
    pub lost_at: Option<f64>,
    /// Time at which the figure fell, s: also on the way in, and in the second after the way out.
    pub fell_at: Option<f64>,
    /// Whether it lay on the floor 1 s after the clip's end, where the clip does not end there.
    pub down_after: bool,
    /// Time at which the state ran away and the figure was frozen, s.
    pub frozen_at: Option<f64>,
    /// Time of the clip over which distances are measured, s: until the motion is lost or the figure falls.
    pub followed: f64,
    /// Ticks in that time.
    pub measured_ticks: usize,
    /// Mean distance of the segment origins from the recording, mm.
    pub global_mm: f64,
    /// The same with both pelvis origins in one place, mm.
    pub root_relative_mm: f64,
    /// Help that the figure got.
    pub help: TrialHelp,
}

/// Help that a figure got in a trial.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TrialHelp {
    /// Impulse, N·s.
    pub impulse: f64,
    /// Impulse over weight × time.
    pub share: f64,
    /// The same within the recording: neither the way in nor the time after it dilutes it.
    pub share_within: f64,
    /// Largest force, N.
    pub most: f64,
    /// Largest moment about the pelvis, N·m.
    pub most_moment: f64,
    /// Mean change of the force from tick to tick over its mean, within the recording; `None` without help.
    pub change: Option<f64>,
    /// Share of the ticks in which it acted.
    pub acts: f64,
}

/// Judges a trial by its ticks.
#[derive(Clone, Debug, Default)]
pub struct Judge {
    distances: Vec<Distance>,
    fell_at: Option<f64>,
    frozen_at: Option<f64>,
    down_after: bool,
    impulse: f64,
    most: f64,
    most_moment: f64,
    within: HelpWithin,
    helped: usize,
    ticks: usize,
}

/// Sums over the ticks within the recording.
#[derive(Clone, Debug, Default)]
struct HelpWithin {
    /// Impulse of the force, N·s.
    impulse: f64,
    /// Sum of its changes from tick to tick, times the length of a tick, N·s.
    changes: f64,
    /// Time, s.
    time: f64,
    last: Option<Vec3>,
}

impl HelpWithin {
    fn add(&mut self, force: Vec3, dt: f64) {
        let last = self.last.replace(force).unwrap_or(force);
        self.impulse += force.norm() * dt;
        self.changes += (force - last).norm() * dt;
        self.time += dt;
    }
}

/// Distance of a figure from the recording at one time.
#[derive(Clone, Copy, Debug)]
struct Distance {
    time: f64,
    /// Mean distance of the segment origins, m.
    global: f64,
    /// The same with both pelvis origins in one place, m.
    root_relative: f64,
}

impl Distance {
    fn new(time: f64, body: &Body, [is, wanted]: [&Posture; 2]) -> Self {
        let (a, b) = (forward(body, is), forward(body, wanted));
        let mean = |shift| {
            let far = |s: usize| (a[s].0 - b[s].0 - shift).norm();
            (0..SEGMENT_COUNT).map(far).sum::<f64>() / SEGMENT_COUNT as f64
        };
        Self {
            time,
            global: mean(Vec3::zero()),
            root_relative: mean(a[0].0 - b[0].0),
        }
    }
}

impl Judge {
    /// Takes in a tick of `dt` s that ended at `time` on the clip's clock.
    pub fn observe(&mut self, figure: &Figure, reference: &TrackingReference, time: f64, dt: f64) {
        let report = figure.report().expect("a stepped figure has a report");
        self.ticks += 1;
        self.helped += usize::from(report.assist != [0.0; 6]);
        if report.flags.has(Flags::QUARANTINED) {
            self.frozen_at.get_or_insert(time);
            return;
        }
        let [mx, my, mz, fx, fy, fz] = report.assist;
        let (moment, force) = (
            Vec3::from_array([mx, my, mz]),
            Vec3::from_array([fx, fy, fz]),
        );
        self.impulse += force.norm() * dt;
        self.most = self.most.max(force.norm());
        self.most_moment = self.most_moment.max(moment.norm());
        if figure.is_fallen() {
            self.fell_at.get_or_insert(time);
        }
        let clip = &reference.recorded;
        if time > -1e-9 && time < clip.duration() + 1e-9 {
            let wanted = clip.sample(time).posture;
            let both = [&figure.state().posture, &wanted];
            let distance = Distance::new(time, figure.body(), both);
            self.distances.push(distance);
            self.within.add(force, dt);
        }
        if time < clip.duration() + AFTER + 1e-9 {
            let height = |p: &Posture| p.root_position.z;
            let ends = height(&clip.sample(clip.duration()).posture);
            self.down_after = height(&figure.state().posture) < DOWN * ends;
        }
    }

    /// The result, once the trial is over.
    pub fn result(&self, trial: &Trial<'_>) -> TrialResult {
        let end = trial.reference.recorded.duration();
        let lost = self.distances.iter().find(|d| d.global > LOST);
        let lost = lost.map(|d| d.time);
        let until = [lost, self.fell_at, self.frozen_at]
            .into_iter()
            .flatten()
            .fold(f64::INFINITY, f64::min);
        let followed = self.distances.partition_point(|d| d.time < until);
        let measured = &self.distances[..followed];
        let n = measured.len().max(1) as f64;
        let mean = |of: fn(&Distance) -> f64| {
            let sum = measured.iter().map(|d| 1e3 * of(d) / n).sum::<f64>();
            short(sum)
        };
        let weight = trial.figure().links().total_mass() * GRAVITY;
        TrialResult {
            // A frozen figure has no further samples: the part that it did not reach is not completed.
            completed: lost.is_none() && self.frozen_at.is_none_or(|t| t > end),
            lost_at: lost.map(short),
            fell_at: self.fell_at.map(short),
            down_after: self.down_after,
            frozen_at: self.frozen_at.map(short),
            followed: short(until.clamp(0.0, end)),
            measured_ticks: followed,
            global_mm: mean(|d| d.global),
            root_relative_mm: mean(|d| d.root_relative),
            help: TrialHelp {
                impulse: self.impulse,
                share: short(self.impulse / (weight * trial.world.time().0)),
                share_within: short(self.within.impulse / (weight * self.within.time.max(1e-9))),
                most: short(self.most),
                most_moment: short(self.most_moment),
                change: (self.within.impulse > 0.0)
                    .then(|| short(self.within.changes / self.within.impulse)),
                acts: self.helped as f64 / self.ticks.max(1) as f64,
            },
        }
    }
}

/// Runs a trial to its end and judges it.
///
/// # Errors
/// Conditions that no world or figure accepts.
pub fn try_out(
    conditions: &Conditions,
    reference: &TrackingReference,
) -> Result<TrialResult, WorldError> {
    let mut trial = Trial::new(conditions, reference)?;
    let mut judge = Judge::default();
    while let Some(time) = trial.step() {
        judge.observe(trial.figure(), reference, time, trial.world.dt());
    }
    Ok(judge.result(&trial))
}
