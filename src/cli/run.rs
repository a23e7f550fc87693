//! `sinew run`: a motion through the physics, offline, as fast as it goes; measured, drawn and written.

mod csv;
mod document;
mod forecast;
mod strip;
mod summary;

use super::args::{
    BodyArgs, ConstraintSpec, ControllerArg, LoadSpec, ObstacleSpec, PaperOptions, PresetArg,
    PushSpec, StepperArg, ThenSpec,
};
use super::output::{extension, for_clip, write};
use super::source::{Source, load};
use crate::evaluate::strip::{Frame, Thing, evenly_spaced};
use crate::evaluate::{Metrics, RunReport, Tick};
use crate::sim::body::Body;
use crate::sim::body::topology::{DOF_COUNT, DOF_NAMES};
use crate::sim::figure::{Constraint, ControlParams, FigureOptions, StrengthScale};
use crate::sim::motion::retarget::RetargetOptions;
use crate::sim::motion::{Clip, cycle, write_bvh};
use crate::sim::strength::fatigue::MAX_TIME_SCALE;
use crate::sim::world::{
    ClipPlayback, Drive, Figure, FigureEvent, FigureKey, FigureSetup, World, WorldParams,
};
use anyhow::{Context, Result, ensure};
use csv::Csv;
use document::document;
use indicatif::MultiProgress;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Instant;
use strip::{goal_mark, held_loads, write_strip};
use summary::{progress_bar, summary_header, summary_line};

pub use strip::ViewArg;

/// Longest run that can be asked for, s.
const MAX_DURATION: f64 = 86_400.0;

/// Runs motions through the physics and reports how well the figure followed.
#[derive(Clone, Debug, clap::Args)]
pub struct RunArgs {
    /// Motions: BVH files or builtin:NAME (idle, lift, crate, squat, wave, step, walk). Each gets a world of its own.
    #[arg(required = true, value_name = "CLIP")]
    pub clips: Vec<String>,
    /// Who the figure stands for.
    #[command(flatten)]
    pub body: BodyArgs,
    /// Factor on the strength of every joint, 0.01 to 100.
    #[arg(long, value_name = "F", default_value_t = 1.0)]
    pub strength: f64,
    /// Percentile of strength among people of that sex, age and size, 5 to 95.
    #[arg(long, value_name = "P", default_value_t = 50.0)]
    pub percentile: f64,
    /// Share of its strength that the figure is willing to use, 0 to 1.
    #[arg(long, value_name = "E", default_value_t = 1.0)]
    pub effort: f64,
    /// Seconds of muscle fatigue per simulated second, 0 to 1000; 0: muscles never tire.
    #[arg(long, value_name = "X", default_value_t = 0.0)]
    pub fatigue: f64,
    /// Help towards the desired pose of the pelvis, 0 to 1; reported, not physical.
    #[arg(long, value_name = "A", default_value_t = 0.0)]
    pub assist: f64,
    /// Load held by one or two segments, for example 3@r_hand, 8@l_hand+r_hand or 3@r_hand@1..2.5 (repeatable).
    #[arg(long, value_name = "KG@SEGMENT[+SEGMENT][@T0..T1]")]
    pub load: Vec<LoadSpec>,
    /// Force at one hand beyond which a load slips, N; loads never slip unless given.
    #[arg(long, value_name = "N", default_value_t = f64::INFINITY)]
    pub grip: f64,
    /// Push on a segment, for example 20@chest@1.5:1,0,0 (N·s, start in s, world direction; repeatable).
    #[arg(long, value_name = "NS@SEGMENT@T:x,y,z", allow_hyphen_values = true)]
    pub push: Vec<PushSpec>,
    /// Where a segment or the centre of mass (com) is wanted (repeatable): r_hand@0.4,-0.25,1.1, with times r_hand@0.4,-0.25,1.1@1..3, turned
    /// r_hand@0.4,-0.25,1.1:0,-0.7,0,0.714, single axes com@_,0.08,_.
    #[arg(
        long,
        value_name = "PART@x,y,z[@T0..T1][:qx,qy,qz,qw]",
        allow_hyphen_values = true
    )]
    pub constrain: Vec<ConstraintSpec>,
    /// A thing that the figure can touch (repeatable): a seat box:0.4,0.5,0.45@-0.3,0,0.225, a thrown ball sphere:0.11@2,0,1.2:5kg:-5,0,1,
    /// a wall plane:-1,0,0@0.6,0,0.
    #[arg(
        long,
        value_name = "SHAPE:SIZE@x,y,z[:KGkg][:vx,vy,vz]",
        allow_hyphen_values = true
    )]
    pub obstacle: Vec<ObstacleSpec>,
    /// How long a push lasts, s.
    #[arg(long, value_name = "S", default_value_t = 0.2)]
    pub push_duration: f64,
    /// Who computes torques.
    #[arg(long, value_enum, default_value_t)]
    pub controller: ControllerArg,
    /// Who moves the body.
    #[arg(long, value_enum, default_value_t)]
    pub stepper: StepperArg,
    /// Step when the capture point has left the feet (modern controller).
    #[arg(long, value_name = "BOOL", default_value_t = true, num_args = 0..=1, require_equals = true, default_missing_value = "true", action = clap::ArgAction::Set)]
    pub protective_steps: bool,
    /// Choices of the paper's controller.
    #[command(flatten)]
    pub paper: PaperOptions,
    /// Ticks per second; 60 unless the preset says otherwise.
    #[arg(long, value_name = "HZ")]
    pub rate: Option<f64>,
    /// Physics steps per tick.
    #[arg(long, value_name = "N", default_value_t = WorldParams::default().substeps)]
    pub substeps: u32,
    /// Length of the run, s; the length of the motion unless given.
    #[arg(long, value_name = "S")]
    pub duration: Option<f64>,
    /// Repeat the motion until --duration is over.
    #[arg(long = "loop", requires = "duration")]
    pub looped: bool,
    /// Asks for another clip at T seconds (repeatable): turn.bvh@5. A figure that walks goes over to it from step to step where the two are alike, else by
    /// a stand; one that stands begins at once.
    #[arg(long, value_name = "CLIP@T", requires = "duration")]
    pub then: Vec<ThenSpec>,
    /// Begin and end standing, with the steps that it takes before the first frame and after the last one.
    #[arg(long, conflicts_with = "looped")]
    pub standing: bool,
    /// Leave runs as they were recorded. Otherwise they are walked, slower and with shorter steps: measured strength does not run.
    #[arg(long)]
    pub keep_runs: bool,
    /// Times as fast as recorded, 0.5 to 2: steps and balance of recordings are prepared for that pace; built-in motions keep theirs.
    #[arg(long, value_name = "F", default_value_t = 1.0)]
    pub tempo: f64,
    /// Writes the measures as JSON (a list for several clips).
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,
    /// Writes the motion that came out: BVH, or CSV with angles, torques and limits.
    #[arg(long, value_name = "FILE.bvh|.csv")]
    pub out: Option<PathBuf>,
    /// Draws evenly spaced frames side by side.
    #[arg(long, value_name = "FILE.svg|.png")]
    pub strip: Option<PathBuf>,
    /// Frames of the strip.
    #[arg(long, value_name = "N", default_value_t = 8)]
    pub strip_frames: usize,
    /// From where the strip is drawn.
    #[arg(long, value_enum, default_value_t)]
    pub view: ViewArg,
    /// Clips that are run at the same time.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub threads: usize,
}

impl RunArgs {
    fn rate_hz(&self) -> f64 {
        self.rate.unwrap_or(match self.paper.preset {
            Some(PresetArg::Paper2000) => 30.0,
            None => WorldParams::default().rate_hz,
        })
    }

    fn controller_kind(&self) -> ControllerArg {
        match self.paper.preset {
            Some(PresetArg::Paper2000) => ControllerArg::Paper,
            None => self.controller,
        }
    }

    fn stepper_kind(&self) -> StepperArg {
        match self.paper.preset {
            Some(PresetArg::Paper2000) => StepperArg::Kinematic,
            None => self.stepper,
        }
    }

    /// Time of the clip at which the run begins, s.
    fn first(&self, clip: &Clip) -> f64 {
        if self.standing { -clip.lead_in() } else { 0.0 }
    }

    /// The body; the preset takes the rotors out of its joints.
    fn build_body(&self) -> Result<Body> {
        let mut body = self.body.build()?;
        if self.paper.preset.is_some() {
            body.armature = [0.0; DOF_COUNT];
        }
        Ok(body)
    }
}

/// What is run, apart from the motion.
struct Scenario<'a> {
    args: &'a RunArgs,
    body: Arc<Body>,
    params: WorldParams,
    /// Clips that follow, and when they are asked for, s.
    then: Vec<(f64, Arc<Clip>)>,
}

/// Runs the command. A figure that falls is a result, not an error: the report says so.
///
/// # Errors
/// Bad arguments, unreadable clips, files that cannot be written.
pub fn run(args: &RunArgs) -> Result<()> {
    check(args)?;
    let mut scenario = Scenario {
        body: Arc::new(args.build_body()?),
        then: Vec::new(),
        params: WorldParams {
            rate_hz: args.rate_hz(),
            substeps: args.substeps,
            ..WorldParams::default()
        },
        args,
    };
    // Bad parameters are worth knowing before clips are read.
    World::new(scenario.params).context("no such world")?;
    let options = RetargetOptions {
        walk_runs: !args.keep_runs,
        tempo: args.tempo,
        ..RetargetOptions::default()
    };
    for then in &args.then {
        let source = load(&then.clip, &scenario.body, &options)?;
        scenario.then.push((then.at_s, Arc::new(source.clip)));
    }
    let sources = args
        .clips
        .iter()
        .map(|spec| load(spec, &scenario.body, &options))
        .collect::<Result<Vec<_>>>()?;
    let documents = run_all(&scenario, &sources)?;
    if let Some(path) = &args.report {
        let text = match documents.as_slice() {
            [one] => serde_json::to_string_pretty(one),
            several => serde_json::to_string_pretty(several),
        };
        write(
            path,
            text.context("the report cannot be written as JSON")? + "\n",
        )?;
    }
    Ok(())
}

/// Checks what clap cannot.
fn check(args: &RunArgs) -> Result<()> {
    args.paper.params()?;
    ensure!(
        (0.01..=100.0).contains(&args.strength),
        "--strength {}: outside 0.01…100",
        args.strength
    );
    for (name, value, [low, high]) in [
        ("--percentile", args.percentile, [5.0, 95.0]),
        ("--effort", args.effort, [0.0, 1.0]),
        ("--fatigue", args.fatigue, [0.0, MAX_TIME_SCALE]),
        ("--grip", args.grip, [0.0, f64::INFINITY]),
        ("--assist", args.assist, [0.0, 1.0]),
    ] {
        ensure!(
            (low..=high).contains(&value),
            "{name} {value}: outside {low}…{high}"
        );
    }
    ensure!(
        (1e-3..=10.0).contains(&args.push_duration),
        "--push-duration {} s: outside 0.001…10",
        args.push_duration
    );
    if let Some(duration) = args.duration {
        ensure!(
            duration > 0.0 && duration <= MAX_DURATION,
            "--duration {duration} s: outside 0…{MAX_DURATION}"
        );
    }
    ensure!(
        (1..=64).contains(&args.strip_frames),
        "--strip-frames {}: outside 1…64",
        args.strip_frames
    );
    ensure!(
        (1..=256).contains(&args.threads),
        "--threads {}: outside 1…256",
        args.threads
    );
    if let Some(path) = &args.out {
        extension("--out", path, &["bvh", "csv"])?;
    }
    if let Some(path) = &args.strip {
        extension("--strip", path, &["svg", "png"])?;
    }
    Ok(())
}

/// Runs every clip, several at a time if asked for, and prints a line as each one ends; the results are in the order of the clips.
fn run_all(scenario: &Scenario<'_>, sources: &[Source]) -> Result<Vec<serde_json::Value>> {
    let bars = MultiProgress::new();
    let next = AtomicUsize::new(0);
    let results: Mutex<Vec<Option<Result<serde_json::Value>>>> =
        Mutex::new(sources.iter().map(|_| None).collect());
    println!("{}", summary_header());
    std::thread::scope(|scope| {
        for _ in 0..scenario.args.threads.min(sources.len()) {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    let Some(source) = sources.get(i) else { break };
                    let result = run_one(scenario, source, sources.len() > 1, &bars);
                    let mut results = results
                        .lock()
                        .expect("no thread panics while it holds the results");
                    results[i] = Some(result);
                }
            });
        }
    });
    results
        .into_inner()
        .expect("all threads have ended")
        .into_iter()
        .map(|r| r.expect("every clip was taken by a thread"))
        .collect()
}

fn run_one(
    scenario: &Scenario<'_>,
    source: &Source,
    several: bool,
    bars: &MultiProgress,
) -> Result<serde_json::Value> {
    let args = scenario.args;
    let clip = &source.clip;
    let ends = if args.standing {
        clip.lead_in() + clip.lead_out()
    } else {
        0.0
    };
    let duration = args.duration.unwrap_or_else(|| clip.duration() + ends);
    let ticks = ((duration * args.rate_hz()).round() as u64).max(1);
    let mut csv = None;
    let mut postures = None;
    if let Some(path) = &args.out {
        let path = for_clip(path, &source.name, several);
        if extension("--out", &path, &["bvh", "csv"])? == "csv" {
            csv = Some(Csv::create(&path)?);
        } else {
            postures = Some((path, Vec::new()));
        }
    }
    let bar = bars.add(progress_bar(&source.name, ticks));
    let shown = if args.strip.is_some() {
        evenly_spaced(ticks, args.strip_frames)
    } else {
        Vec::new()
    };
    let repeats = args.looped.then(|| cycle(&scenario.body, clip)).flatten();
    let played = repeats.as_ref().unwrap_or(clip);
    let (report, frames) = simulate(scenario, played, ticks, &shown, |figure, time| {
        bar.inc(1);
        if let Some(csv) = &mut csv {
            csv.row(time, figure)?;
        }
        if let Some((_, postures)) = &mut postures {
            postures.push(figure.state().posture);
        }
        Ok(())
    })?;
    bar.finish_and_clear();
    bars.suspend(|| println!("{}", summary_line(&source.name, &report)));
    let forecast = forecast::of(scenario, played);
    bars.suspend(|| println!("{}", forecast::line(&forecast)));
    if let Some(csv) = csv {
        csv.finish()?;
    }
    if let Some((path, postures)) = postures {
        write(&path, write_bvh(&scenario.body, &postures, args.rate_hz()))?;
    }
    if let Some(path) = &args.strip {
        let path = for_clip(path, &source.name, several);
        write_strip(scenario, &source.name, &frames, &path)?;
    }
    let measures = (&report, &forecast);
    let document = document(scenario, source, ticks as f64 / args.rate_hz(), measures);
    serde_json::to_value(document).context("the report cannot be written as JSON")
}

/// Steps a world with one figure that follows `clip` for `ticks` ticks; `each` is called after every tick with the time (s).
///
/// Returns the measures and what there was to see at the ticks in `shown`.
fn simulate(
    scenario: &Scenario<'_>,
    clip: &Clip,
    ticks: u64,
    shown: &[u64],
    mut each: impl FnMut(&Figure, f64) -> Result<()>,
) -> Result<(RunReport, Vec<Frame>)> {
    let constraints: Vec<_> = scenario
        .args
        .constrain
        .iter()
        .map(|c| c.constraint(&scenario.body))
        .collect();
    let (mut world, key) = scene(scenario, clip, &constraints)?;
    let start = clip.sample(scenario.args.first(clip)).posture;
    let mut metrics = Metrics::new(scenario.args.rate_hz(), &start);
    let mut frames = Vec::with_capacity(shown.len());
    for n in 0..ticks {
        ask_for_clips(scenario, &mut world, key);
        let began = Instant::now();
        world.step();
        let us = began.elapsed().as_secs_f64() * 1e6;
        let figure = world.figure(key).expect("nobody removes the figure");
        let tick = Tick::of(figure, scenario.params.gravity);
        metrics.observe(tick, us);
        for event in figure.events() {
            note(&mut metrics, event);
        }
        if shown.binary_search(&n).is_ok() {
            let loads = held_loads(scenario, metrics.time_s());
            let things = world.obstacles().map(|(_, o)| Thing::obstacle(o.setup()));
            let goals = constraints
                .iter()
                .filter_map(|c| goal_mark(c, metrics.time_s()));
            let things = things.chain(goals);
            frames.push(Frame::of(&tick, metrics.time_s(), loads).among(things));
        }
        each(figure, metrics.time_s())?;
    }
    Ok((metrics.finish(world.state_hash()), frames))
}

/// Tells the figure to play the clips that are due in the tick to come.
fn ask_for_clips(scenario: &Scenario<'_>, world: &mut World, key: FigureKey) {
    let (time, dt) = (world.time(), world.dt());
    let figure = world.figure_mut(key).expect("nobody removes the figure");
    for (at, clip) in &scenario.then {
        if (time - 0.5 * dt..time + 0.5 * dt).contains(at) {
            let play = ClipPlayback::new(Arc::clone(clip), time + clip.lead_in());
            figure.play(play, false, time);
        }
    }
}

/// A world with one figure that begins the clip, what happens to it, and the things around it.
fn scene(
    scenario: &Scenario<'_>,
    clip: &Clip,
    constraints: &[Constraint],
) -> Result<(World, FigureKey)> {
    let args = scenario.args;
    let body = &scenario.body;
    let mut world = World::new(scenario.params).context("no such world")?;
    let first = args.first(clip);
    let key = world
        .add_figure(FigureSetup {
            strength: StrengthScale {
                all: args.strength,
                percentile: args.percentile,
                effort: args.effort,
                ..StrengthScale::default()
            },
            stepper: args.stepper_kind().into(),
            params: ControlParams {
                protective_steps: args.protective_steps,
                ..args.paper.params()?
            },
            options: FigureOptions {
                fatigue_time_scale: args.fatigue,
                assist: args.assist,
            },
            name: clip.name().to_owned(),
            ..FigureSetup::new(
                Arc::clone(body),
                args.controller_kind().into(),
                clip.sample(first).state(),
            )
        })
        .context("no such figure")?;
    for load in &args.load {
        world
            .perturb(key, load.perturbation(body, args.grip))
            .context("--load")?;
    }
    for push in &args.push {
        world
            .perturb(key, push.perturbation(body, args.push_duration))
            .context("--push")?;
    }
    world
        .set_constraints(key, constraints)
        .context("--constrain")?;
    for o in &args.obstacle {
        world.add_obstacle(o.0.clone()).context("--obstacle")?;
    }
    let figure = world.figure_mut(key).expect("the figure was just added");
    figure.set_drive(Drive::Clip(ClipPlayback {
        looped: args.looped,
        ..ClipPlayback::new(Arc::new(clip.clone()), -first)
    }));
    Ok((world, key))
}

fn note(metrics: &mut Metrics, event: &FigureEvent) {
    use FigureEvent as E;
    let (kind, segment, dof, mass) = match *event {
        E::SupportGained { segment } => ("support_gained", Some(segment), None, None),
        E::SupportLost { segment } => ("support_lost", Some(segment), None, None),
        E::Saturated { dof } => ("saturated", None, Some(dof), None),
        E::Relieved { dof } => ("relieved", None, Some(dof), None),
        E::BalanceLost => ("balance_lost", None, None, None),
        E::Recovered => ("recovered", None, None, None),
        E::Fell => ("fell", None, None, None),
        E::GotUp => ("got_up", None, None, None),
        E::LoadTaken { segment, mass } => ("load_taken", Some(segment), None, Some(mass)),
        E::LoadDropped { segment, mass } => ("load_dropped", Some(segment), None, Some(mass)),
        E::LoadSlipped { segment, mass } => ("load_slipped", Some(segment), None, Some(mass)),
        E::Quarantined => ("quarantined", None, None, None),
        E::Touched { segment, .. } => ("touched", Some(segment), None, None),
        E::Parted { segment, .. } => ("parted", Some(segment), None, None),
    };
    metrics.event(
        kind,
        segment.map(|s| s.name()),
        dof.map(|d| DOF_NAMES[d]),
        mass,
    );
}
