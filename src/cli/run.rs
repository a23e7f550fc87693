//! `sinew run`: a motion through the physics, offline, as fast as it goes; measured, drawn and written.

use super::args::{
    BodyArgs, ConstraintSpec, ControllerArg, LoadSpec, ObstacleSpec, PaperOptions, PresetArg,
    PushSpec, StepperArg, person_name, sex_name,
};
use super::output::{extension, for_clip, write};
use super::source::{Source, load};
use crate::evaluate::strip::{Frame, StripOptions, Thing, View, draw, evenly_spaced, raster, svg};
use crate::evaluate::table::{Torques, header, row};
use crate::evaluate::{Metrics, RunReport, Tick};
use crate::sim::body::topology::{DOF_COUNT, DOF_NAMES};
use crate::sim::body::{Body, Posture, SegmentId};
use crate::sim::collide::{Mobility, ObstacleSetup, Shape};
use crate::sim::figure::{Constraint, ControlParams, FigureOptions, StrengthScale};
use crate::sim::math::{Quat, Vec3};
use crate::sim::motion::retarget::RetargetOptions;
use crate::sim::motion::{Clip, cycle, write_bvh};
use crate::sim::strength::fatigue::MAX_TIME_SCALE;
use crate::sim::world::{
    ClipPlayback, Drive, Figure, FigureEvent, FigureSetup, World, WorldParams,
};
use anyhow::{Context, Result, ensure};
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use serde::Serialize;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Instant;

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
    /// Begin and end standing, with the steps that it takes before the first frame and after the last one.
    #[arg(long, conflicts_with = "looped")]
    pub standing: bool,
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

    /// The body; the preset takes the rotors out of its joints.
    fn build_body(&self) -> Result<Body> {
        let mut body = self.body.build()?;
        if self.paper.preset.is_some() {
            body.armature = [0.0; DOF_COUNT];
        }
        Ok(body)
    }
}

/// From where a strip is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum ViewArg {
    /// From the right side.
    Side,
    /// From the front.
    Front,
    /// From the front and right, from a little above.
    #[default]
    ThreeQuarter,
}

impl From<ViewArg> for View {
    fn from(arg: ViewArg) -> Self {
        match arg {
            ViewArg::Side => Self::Side,
            ViewArg::Front => Self::Front,
            ViewArg::ThreeQuarter => Self::ThreeQuarter,
        }
    }
}

/// What is run, apart from the motion.
struct Scenario<'a> {
    args: &'a RunArgs,
    body: Arc<Body>,
    params: WorldParams,
}

/// `report.json`: the scenario, how the motion was fitted, and the measures.
#[derive(Serialize)]
struct Document<'a> {
    clip: &'a str,
    duration_s: f64,
    body: BodyEntry,
    controller: ControllerArg,
    stepper: StepperArg,
    strength: f64,
    percentile: f64,
    effort: f64,
    fatigue_time_scale: f64,
    assist: f64,
    substeps: u32,
    gravity_mps2: f64,
    loads: Vec<LoadEntry>,
    pushes: Vec<PushEntry>,
    /// As they were given.
    obstacles: Vec<&'a str>,
    #[serde(flatten)]
    measures: &'a RunReport,
    /// `null` for built-in motions, which are made for the body.
    retarget: serde_json::Value,
}

#[derive(Serialize)]
struct BodyEntry {
    sex: &'static str,
    age_years: f64,
    height_m: f64,
    mass_kg: f64,
}

#[derive(Serialize)]
struct LoadEntry {
    segment: &'static str,
    /// `null`: one hand.
    second_segment: Option<&'static str>,
    mass_kg: f64,
    from_s: f64,
    /// `null`: never put down.
    to_s: Option<f64>,
}

#[derive(Serialize)]
struct PushEntry {
    segment: &'static str,
    impulse_ns: f64,
    at_s: f64,
    duration_s: f64,
    direction: [f64; 3],
}

/// Runs the command. A figure that falls is a result, not an error: the report says so.
///
/// # Errors
/// Bad arguments, unreadable clips, files that cannot be written.
pub fn run(args: &RunArgs) -> Result<()> {
    check(args)?;
    let scenario = Scenario {
        body: Arc::new(args.build_body()?),
        params: WorldParams {
            rate_hz: args.rate_hz(),
            substeps: args.substeps,
            ..WorldParams::default()
        },
        args,
    };
    // Bad parameters are worth knowing before clips are read.
    World::new(scenario.params).context("no such world")?;
    let options = RetargetOptions::default();
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
    if let Some(csv) = csv {
        csv.finish()?;
    }
    if let Some((path, postures)) = postures {
        write(&path, bvh_text(&scenario.body, &postures, args.rate_hz()))?;
    }
    if let Some(path) = &args.strip {
        let path = for_clip(path, &source.name, several);
        write_strip(scenario, &source.name, &frames, &path)?;
    }
    let document = document(scenario, source, ticks as f64 / args.rate_hz(), &report);
    serde_json::to_value(document).context("the report cannot be written as JSON")
}

/// The motion as BVH in metres.
fn bvh_text(body: &Body, postures: &[Posture], rate_hz: f64) -> String {
    write_bvh(body, postures, rate_hz)
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
    let args = scenario.args;
    let body = &scenario.body;
    let mut world = World::new(scenario.params).context("no such world")?;
    let first = if args.standing { -clip.lead_in() } else { 0.0 };
    let start = clip.sample(first);
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
                start.state(),
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
    let constraints: Vec<_> = args.constrain.iter().map(|c| c.constraint(body)).collect();
    world
        .set_constraints(key, &constraints)
        .context("--constrain")?;
    for o in &args.obstacle {
        world.add_obstacle(o.0.clone()).context("--obstacle")?;
    }
    let figure = world.figure_mut(key).expect("the figure was just added");
    figure.set_drive(Drive::Clip(ClipPlayback {
        looped: args.looped,
        ..ClipPlayback::new(Arc::new(clip.clone()), -first)
    }));
    let mut metrics = Metrics::new(args.rate_hz(), &start.posture);
    let mut frames = Vec::with_capacity(shown.len());
    for n in 0..ticks {
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

/// A small ball where all three coordinates of a part are wanted at `time` (s).
fn goal_mark(c: &Constraint, time: f64) -> Option<Thing> {
    let holds = c.from <= time && time < c.to && c.axes == [1.0; 3];
    let setup = ObstacleSetup {
        position: c.position.filter(|_| holds)?,
        name: String::new(),
        shape: Shape::Sphere { radius: 0.03 },
        mobility: Mobility::Fixed,
        friction: 1.0,
        rotation: Quat::identity(),
        velocity: Vec3::zero(),
        angular_velocity: Vec3::zero(),
    };
    Some(Thing::obstacle(&setup))
}

/// Loads in the figure's hands at `time` (s).
fn held_loads(scenario: &Scenario<'_>, time: f64) -> Vec<(usize, Vec3, f64)> {
    let held = |l: &&LoadSpec| l.from_s < time && time <= l.to_s && l.mass_kg > 0.0;
    let place = |l: &LoadSpec| {
        let load = l.perturbation(&scenario.body, f64::INFINITY).load();
        let shares = load.into_iter().flat_map(|l| l.shares());
        shares.map(|(s, p, kg)| (s.index(), p, kg))
    };
    scenario
        .args
        .load
        .iter()
        .filter(held)
        .flat_map(place)
        .collect()
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

fn document<'a>(
    scenario: &Scenario<'a>,
    source: &'a Source,
    duration_s: f64,
    measures: &'a RunReport,
) -> Document<'a> {
    let args = scenario.args;
    let profile = scenario.body.profile;
    Document {
        clip: &source.name,
        duration_s,
        body: BodyEntry {
            sex: sex_name(profile.sex),
            age_years: profile.age,
            height_m: profile.height,
            mass_kg: profile.mass,
        },
        controller: args.controller_kind(),
        stepper: args.stepper_kind(),
        strength: args.strength,
        percentile: args.percentile,
        effort: args.effort,
        fatigue_time_scale: args.fatigue,
        assist: args.assist,
        substeps: args.substeps,
        gravity_mps2: scenario.params.gravity,
        loads: args
            .load
            .iter()
            .map(|l| LoadEntry {
                segment: l.segment.name(),
                second_segment: l.second.map(SegmentId::name),
                mass_kg: l.mass_kg,
                from_s: l.from_s,
                to_s: Some(l.to_s).filter(|t| t.is_finite()),
            })
            .collect(),
        pushes: args
            .push
            .iter()
            .map(|p| PushEntry {
                segment: p.segment.name(),
                impulse_ns: p.impulse_ns,
                at_s: p.at_s,
                duration_s: args.push_duration,
                direction: p.direction.to_array(),
            })
            .collect(),
        obstacles: args.obstacle.iter().map(|o| o.0.name.as_str()).collect(),
        measures,
        retarget: source
            .retarget
            .as_ref()
            .map_or(serde_json::Value::Null, super::lint::to_json),
    }
}

fn write_strip(scenario: &Scenario<'_>, name: &str, frames: &[Frame], path: &Path) -> Result<()> {
    let args = scenario.args;
    let profile = scenario.body.profile;
    let mut title = format!(
        "{name}: {}, {:.2} m, {:.0} kg, strength {}",
        person_name(&profile),
        profile.height,
        profile.mass,
        args.strength
    );
    for l in &args.load {
        title += &format!(", {} kg in {}", l.mass_kg, l.segment.name());
    }
    for p in &args.push {
        title += &format!(", push {} Ns at {} s", p.impulse_ns, p.at_s);
    }
    let options = StripOptions {
        view: args.view.into(),
        title,
        ..StripOptions::default()
    };
    let drawing = draw(&scenario.body, frames, &options);
    if extension("--strip", path, &["svg", "png"])? == "svg" {
        write(path, svg::write(&drawing))
    } else {
        let png =
            raster::png(&drawing).with_context(|| format!("cannot draw {}", path.display()))?;
        write(path, png)
    }
}

/// The CSV file, written as the run goes.
struct Csv {
    path: PathBuf,
    file: BufWriter<File>,
    line: String,
}

impl Csv {
    fn create(path: &Path) -> Result<Self> {
        let file =
            File::create(path).with_context(|| format!("cannot write {}", path.display()))?;
        let mut out = Self {
            path: path.to_owned(),
            file: BufWriter::new(file),
            line: header(true),
        };
        out.flush_line()?;
        Ok(out)
    }

    fn row(&mut self, time: f64, figure: &Figure) -> Result<()> {
        let report = figure.report().expect("a stepped figure has a report");
        let torques = Torques {
            torque: &report.torque,
            lower: &report.torque_lower,
            upper: &report.torque_upper,
        };
        row(&mut self.line, time, &figure.state().posture, Some(torques));
        self.flush_line()
    }

    fn flush_line(&mut self) -> Result<()> {
        let done = self.file.write_all(self.line.as_bytes());
        self.line.clear();
        done.with_context(|| format!("cannot write {}", self.path.display()))
    }

    fn finish(mut self) -> Result<()> {
        self.file
            .flush()
            .with_context(|| format!("cannot write {}", self.path.display()))
    }
}

fn progress_bar(name: &str, ticks: u64) -> ProgressBar {
    let style = ProgressStyle::with_template(
        "{prefix:>14} {wide_bar:.cyan/dim} {pos}/{len} ticks, {per_sec}, {eta} left",
    )
    .expect("the template is a constant")
    .progress_chars("━╸─");
    ProgressBar::new(ticks)
        .with_style(style)
        .with_prefix(name.to_owned())
}

fn summary_header() -> String {
    format!(
        "{:<14} {:>7} {:>8} {:>8} {:>8} {:>9} {:>7} {:>9} {:>8} {:>8}  result",
        "clip",
        "time s",
        "rms deg",
        "max deg",
        "root mm",
        "global mm",
        "use max",
        "margin m",
        "slip mm",
        "us/tick"
    )
}

fn summary_line(name: &str, r: &RunReport) -> String {
    let mut result = match r.fell_at_s {
        Some(t) => format!("fell at {t:.2} s"),
        None => "stood".to_owned(),
    };
    if let Some(t) = r.quarantined_at_s {
        result += &format!(", frozen at {t:.2} s");
    }
    let margin = r
        .margin_min_m
        .map_or_else(|| "none".to_owned(), |m| format!("{m:.3}"));
    let longest = r.longest_saturated().map_or_else(String::new, |(d, s)| {
        format!(", {d} at its limit for {s:.2} s")
    });
    format!(
        "{name:<14} {:>7.2} {:>8.3} {:>8.2} {:>8.1} {:>9.1} {:>7.2} {margin:>9} {:>8.1} {:>8.0}  {result}{longest}",
        r.ticks as f64 / r.rate_hz,
        r.joint_rms_deg,
        r.joint_max_deg,
        r.mpjpe_root_mm,
        r.mpjpe_global_mm,
        r.max_utilisation,
        r.foot_slip_mm_per_s,
        r.us_per_tick_p50,
    )
}
