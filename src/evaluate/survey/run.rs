//! One clip through the physics, measured against motions that are fixed in the world.

use super::contacts::{match_touch_downs, precision_recall, settled};
use super::errors::{Placed, Sample, errors, jerk_ratio};
use super::outcome::Outcome;
use super::stats::{median, short};
use super::verdict::{anchor_lost, phc_lost};
use crate::experiments::walk::Stance;
use crate::metrics::{Metrics, Tick};
use sinew_physics::body::topology::{DOF_COUNT, DOF_NAMES, L_FOOT, L_TOES, R_FOOT, R_TOES};
use sinew_physics::body::{Body, State};
use sinew_physics::dynamics::{Kinematics, momentum};
use sinew_physics::figure::{ControllerKind, FigureOptions, Flags, Perturbation, StrengthScale};
use sinew_physics::motion::{Clip, GRAVITY};
use sinew_physics::plan::StreamPlan;
use sinew_physics::plan::contact_labels::ContactPhase;
use sinew_physics::plan::stream::RATE;
use sinew_physics::world::{
    ClipPlayback, Drive, Figure, FigureSetup, LivePlayback, RehearsedMotion, RehearsedPlayback,
    World, WorldError, WorldParams,
};
use std::sync::Arc;

/// How long a figure is watched after a prepared clip has ended, s, and after a stream has.
const AFTER: f64 = 1.0;
/// See [`AFTER`]; the stream's last posture is held.
const AFTER_STREAM: f64 = 3.0;
/// A foot is on the floor while that pushes it with more than this, N.
const STANDS: f64 = 20.0;
const FEET: [[sinew_physics::body::SegmentId; 2]; 2] = [[L_FOOT, L_TOES], [R_FOOT, R_TOES]];

/// What a clip is measured against.
#[derive(Clone, Debug)]
pub struct Reference {
    /// The recording as fitted to the body: no foot lock, no shift for balance, no steps before or after it, runs as
    /// they were.
    pub recorded: Arc<Clip>,
    /// The motion as prepared, in the same place of the world.
    pub prepared: Arc<Clip>,
    /// Which feet the recording has on the floor.
    pub phases: Vec<ContactPhase>,
}

impl Reference {
    /// A motion that is made for the body: it is its own recording.
    pub fn authored(clip: Arc<Clip>) -> Self {
        let label: Vec<[bool; 2]> = (0..clip.len()).map(|i| clip.planted(i)).collect();
        Self {
            phases: sinew_physics::plan::contact_labels::phases(&label, clip.rate_hz()),
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

    /// Largest mean distance of the prepared motion from the recording, m, at 30 samples a second.
    pub fn prepared_off(&self, body: &Body) -> f64 {
        let n = (self.recorded.duration() * 30.0) as usize;
        (0..=n)
            .map(|i| {
                let t = i as f64 / 30.0;
                let at = |clip: &Clip| Placed::new(body, &clip.sample(t).posture);
                at(&self.prepared).distance(&at(&self.recorded))
            })
            .fold(0.0, f64::max)
    }
}

/// Everything that a run depends on besides its motion.
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

/// A rehearsed motion, and the state that a figure begins it in.
#[derive(Clone, Debug)]
pub struct RehearsedRun {
    /// The motion.
    pub motion: Arc<RehearsedMotion>,
    /// Its own beginning, or one near it.
    pub from: State,
}

/// What accumulates over a run.
struct Course {
    samples: Vec<Sample>,
    stances: [Stance; 2],
    /// Way of the present stance, m, and the ways of those that have ended.
    way: [f64; 2],
    ways: Vec<f64>,
    peak: f64,
    impulse: f64,
    assist: f64,
    assist_max: f64,
    limit_ticks: usize,
    fell_at: Option<f64>,
    frozen_at: Option<f64>,
}

/// Runs the clip from its beginning to a little after its end, and measures.
///
/// # Errors
/// Conditions that no world or figure accepts.
pub fn run(conditions: &Conditions, reference: &Reference) -> Result<Outcome, WorldError> {
    watched(conditions, reference, |_, _| ())
}

/// As [`run`]; `watch` sees the figure after each tick, with the time on the clip's clock, s.
///
/// # Errors
/// As [`run`].
pub fn watched(
    conditions: &Conditions,
    reference: &Reference,
    mut watch: impl FnMut(&Figure, f64),
) -> Result<Outcome, WorldError> {
    let c = conditions;
    let mut world = World::new(c.world)?;
    let (drive, lead, length) = match (&c.rehearsed, c.live_window) {
        (Some(run), _) => {
            let play = RehearsedPlayback::new(Arc::clone(&run.motion), 0.0);
            let length = run.motion.duration() + AFTER;
            (Drive::Rehearsed(play), run.motion.lead_in(), length)
        }
        (None, Some(window)) => {
            let drive = stream(c, reference, window);
            (drive, 0.0, reference.recorded.duration() + AFTER_STREAM)
        }
        (None, None) => {
            let clip = &reference.prepared;
            let lead = clip.lead_in();
            let play = ClipPlayback::new(Arc::clone(clip), lead);
            let length = lead + clip.duration() + clip.lead_out() + AFTER;
            (Drive::Clip(play), lead, length)
        }
    };
    let state = match &c.rehearsed {
        Some(run) => run.from,
        None => drive.targets(0.0, world.dt()).now.state(),
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

    let mut metrics = Metrics::new(c.world.rate_hz, &state.posture);
    let mut course = Course::new();
    let mut fed = fed(c.live_window);
    let (mass, before) = vertical(world.figure(key).expect("it was just added"));
    let ticks = (length * c.world.rate_hz).round().max(1.0) as u64;
    for _ in 0..ticks {
        let end = world.time() + world.dt();
        if let Some(live) = world.figure_mut(key).and_then(|f| f.stream_mut()) {
            // The stream comes at its own rate, whatever that of the world is.
            while (fed as f64) / RATE <= live.stream_time(end) + live.motion.window() {
                live.motion.push(&posture(reference, fed), None);
                fed += 1;
            }
        }
        world.step();
        let time = world.time() - lead;
        let figure = world.figure(key).expect("nobody removes the figure");
        metrics.observe(Tick::of(figure, c.world.gravity), 0.0);
        course.observe(figure, reference, time, world.dt());
        watch(figure, time);
    }
    let figure = world.figure(key).expect("nobody removes the figure");
    let report = metrics.finish(world.state_hash());
    let time = world.time();
    let mut out = course.outcome(reference, world.dt());
    let (mass_after, after) = vertical(figure);
    let weight = mass_after * GRAVITY;
    let steady = course.frozen_at.is_none() && mass == mass_after;
    out.impulse_balance =
        steady.then(|| short((course.impulse - (after - before)) / (weight * time) - 1.0));
    out.assist_share = short(course.assist / (weight * time));
    out.assist_max_n = short(course.assist_max);
    out.penetration_mm = short(report.penetration_max_mm);
    if let Some((dof, s)) = (0..DOF_COUNT)
        .map(|d| (d, report.saturated_s[d]))
        .filter(|(_, s)| *s > 0.0)
        .reduce(|a, b| if b.1 > a.1 { b } else { a })
    {
        out.limit_dof = DOF_NAMES[dof].to_owned();
        out.limit_dof_s = short(s);
    }
    Ok(out)
}

/// Mass, kg, and vertical momentum, kg·m/s.
fn vertical(figure: &Figure) -> (f64, f64) {
    let mut kin = Kinematics::default();
    kin.set_state(figure.links(), figure.state());
    let (mass, sum) = (figure.links().total_mass(), momentum(figure.links(), &kin));
    (mass, sum.linear.z)
}

/// Sample `i` of the stream: the recording, then its last posture.
fn posture(reference: &Reference, i: usize) -> sinew_physics::body::Posture {
    let clip = &reference.recorded;
    clip.sample((i as f64 / RATE).min(clip.duration())).posture
}

/// Samples that are fed before the first tick.
fn fed(window: Option<f64>) -> usize {
    window.map_or(0, |w| (w * RATE).floor() as usize + 1)
}

/// A stream whose window is full.
fn stream(c: &Conditions, reference: &Reference, window: f64) -> Drive {
    let mut motion = StreamPlan::new(Arc::clone(&c.body), window);
    for i in 0..fed(Some(window)) {
        motion.push(&posture(reference, i), None);
    }
    motion.advance(1.0 / RATE);
    Drive::Live(Box::new(LivePlayback {
        motion,
        offset: 0.0,
    }))
}

impl Course {
    fn new() -> Self {
        Self {
            samples: Vec::new(),
            stances: [Stance::default(), Stance::default()],
            way: [0.0; 2],
            ways: Vec::new(),
            peak: 0.0,
            impulse: 0.0,
            assist: 0.0,
            assist_max: 0.0,
            limit_ticks: 0,
            fell_at: None,
            frozen_at: None,
        }
    }

    /// Takes in a tick of `dt` s that ended at `time` on the clip's clock.
    fn observe(&mut self, figure: &Figure, reference: &Reference, time: f64, dt: f64) {
        let report = figure.report().expect("a stepped figure has a report");
        if report.flags.has(Flags::QUARANTINED) {
            self.frozen_at.get_or_insert(time);
            return;
        }
        let weight = figure.links().total_mass() * GRAVITY;
        let floor: f64 = report.contacts.iter().map(|c| c.force.z).sum();
        let help = &report.assist[3..];
        let force = help.iter().map(|f| f * f).sum::<f64>().sqrt();
        self.impulse += (floor + help[2]) * dt;
        self.assist += force * dt;
        self.assist_max = self.assist_max.max(force);
        self.limit_ticks += usize::from(report.joints.saturated != 0);
        if figure.is_fallen() {
            self.fell_at.get_or_insert(time);
        }
        let end = (reference.recorded.duration()).max(reference.prepared.duration());
        let within = time > -1e-9 && time < end + 1e-9;
        if self.fell_at.is_none() {
            self.peak = self.peak.max(floor / weight);
            for (k, segments) in FEET.into_iter().enumerate() {
                let way = self.stances[k].observe(&report.contacts, segments);
                if self.stances[k].load() < STANDS {
                    if self.way[k] > 0.0 {
                        self.ways.push(self.way[k]);
                    }
                    self.way[k] = 0.0;
                } else {
                    self.way[k] = way;
                }
            }
        }
        if within {
            let body = figure.body();
            let at = |clip: &Clip| Placed::new(body, &clip.sample(time).posture);
            let down = FEET.map(|f| {
                let mine = report.contacts.iter().filter(|c| f.contains(&c.segment));
                mine.map(|c| c.force.z).sum::<f64>() > STANDS
            });
            self.samples.push(Sample {
                time,
                actual: Placed::new(body, &figure.state().posture),
                recorded: at(&reference.recorded),
                prepared: at(&reference.prepared),
                down,
                labelled: reference.labelled(time),
            });
        }
    }

    fn outcome(&self, reference: &Reference, dt: f64) -> Outcome {
        let end = reference.recorded.duration();
        // A motion whose runs are walked lasts longer than its recording.
        let until = |t: f64| self.samples.partition_point(|s| s.time < t + 1e-9);
        let recorded = &self.samples[..until(end)];
        let whole = &self.samples[..until(reference.prepared.duration())];
        let lost = phc_lost(recorded, |s| &s.recorded);
        let until = [lost, self.fell_at, self.frozen_at]
            .into_iter()
            .flatten()
            .fold(f64::INFINITY, f64::min);
        let followed = recorded.partition_point(|s| s.time < until);
        let samples = &recorded[..followed];
        let feet = |of: &dyn Fn(&Sample) -> [bool; 2]| -> [Vec<bool>; 2] {
            [0, 1].map(|k| {
                let all: Vec<bool> = samples.iter().map(|s| of(s)[k]).collect();
                settled(&all, dt)
            })
        };
        let (down, label) = (feet(&|s| s.down), feet(&|s| s.labelled));
        let (contact_precision, contact_recall) = precision_recall(&down, &label);
        let mut ways: Vec<f64> = self.ways.iter().map(|w| 1e3 * w).collect();
        ways.extend(self.way.iter().filter(|w| **w > 0.0).map(|w| 1e3 * w));
        Outcome {
            // A frozen figure has no samples any more: what it did not reach it did not complete.
            completed: lost.is_none() && self.frozen_at.is_none_or(|t| t > end),
            lost_at_s: lost.map(short),
            anchor_lost_at_s: anchor_lost(recorded).map(short),
            prepared_lost_at_s: phc_lost(whole, |s| &s.prepared).map(short),
            fell_at_s: self.fell_at.map(short),
            frozen_at_s: self.frozen_at.map(short),
            followed_s: short(until.clamp(0.0, end)),
            recorded: errors(samples, |s| &s.recorded),
            prepared: errors(samples, |s| &s.prepared),
            touch_downs: match_touch_downs(&down, &label, dt),
            contact_precision,
            contact_recall,
            stances: ways.len(),
            skate_median_mm: median(&ways).map(short),
            skate_worst_mm: ways.iter().copied().reduce(f64::max).map(short),
            peak_force_weights: short(self.peak),
            jerk_ratio: jerk_ratio(samples),
            limit_s: short(self.limit_ticks as f64 * dt),
            ..Outcome::default()
        }
    }
}
