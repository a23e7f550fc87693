//! `sinew run`: simulates motions offline, as fast as the machine allows; measures, draws and writes the result.

mod args;
mod csv;
mod document;
mod forecast;
mod scenario;
mod strip;
mod summary;
mod unused;

use super::args::check_tempo;
use super::exit::{ExitOutcome, UsageError, usage, within};
use super::output::{check_folder, check_names, extension, for_clip, write};
use super::source::{self, LoadedClip, load, warn};
use super::terminal::print;
use anyhow::{Context, Result};
use csv::RunCsv;
use document::document;
use indicatif::MultiProgress;
use sinew_evaluate::strip::{StripFrame, Thing, evenly_spaced};
use sinew_evaluate::{Metrics, RunEvent, RunReport, Tick};
use sinew_physics::body::SegmentId;
use sinew_physics::body::topology::DOF_NAMES;
use sinew_physics::figure::{Constraint, ControlParams, FigureOptions};
use sinew_physics::motion::{Clip, write_bvh};
use sinew_physics::plan::cycle;
use sinew_physics::reference::{Preparation, RetargetOptions};
use sinew_physics::strength::fatigue::MAX_TIME_SCALE;
use sinew_physics::time::WorldTime;
use sinew_physics::world::{
    ClipPlayback, Figure, FigureEvent, FigureKey, FigureSetup, MotionSource, World, WorldError,
    WorldParams,
};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Instant;
use strip::{goal_mark, held_loads, write_strip};
use summary::{SummaryTable, progress_bar};

pub use args::{RunArgs, ViewArg};
use scenario::Scenario;

/// Longest accepted duration of a run, s.
const MAX_DURATION: f64 = 86_400.0;

/// Runs the command. A figure that falls is a result, not an error: the report says so, and with `--fail-on-fall` so
/// does the outcome.
///
/// # Errors
/// Bad arguments, unreadable clips, files that cannot be written.
pub fn run(args: &RunArgs) -> Result<ExitOutcome> {
    check(args)?;
    let mut scenario = Scenario {
        body: Arc::new(args.build_body()?),
        strength: args.strength_scale()?,
        then: Vec::new(),
        params: WorldParams {
            rate_hz: args.rate_hz(),
            substeps: args.substeps,
            ..WorldParams::default()
        },
        args,
    };
    // Report bad parameters before clips are read.
    World::new(scenario.params).map_err(refused)?;
    let options = args.file.apply(RetargetOptions {
        tempo: args.tempo,
        preparation: Preparation::walking(!args.keep_runs && args.help.most() == 0.0),
        ..RetargetOptions::default()
    });
    for then in &args.then {
        let source = load(&then.clip, &scenario.body, &options)?;
        warn(&source);
        scenario.then.push((then.at_s, Arc::new(source.clip)));
    }
    let sources = args
        .clips
        .iter()
        .map(|spec| load(spec, &scenario.body, &options))
        .collect::<Result<Vec<_>>>()?;
    sources.iter().for_each(warn);
    unused::warn(args, &sources);
    let documents = run_all(&scenario, &sources)?;
    let text = match documents.as_slice() {
        [one] => serde_json::to_string_pretty(one),
        several => serde_json::to_string_pretty(several),
    };
    let text = text.context("the report cannot be written as JSON")? + "\n";
    if let Some(path) = &args.report {
        write(path, &text)?;
    }
    let fell = documents
        .iter()
        .any(|d| !d["fell_at_s"].is_null() || !d["quarantined_at_s"].is_null());
    let outcome = if args.fail_on_fall && fell {
        ExitOutcome::Fell
    } else {
        ExitOutcome::Done
    };
    if args.json {
        match print(&text) {
            // The exit code does not depend on the reader of the output.
            Err(e) if e.is::<super::terminal::OutputClosed>() => {}
            other => other?,
        }
    }
    Ok(outcome)
}

/// Describes the error in the parameters of the world, naming the flag that has to be changed.
fn refused(error: WorldError) -> anyhow::Error {
    match error {
        WorldError::Range {
            field: field @ ("rate_hz" | "substeps"),
            value,
            lower,
            upper,
        } => {
            let flag = if field == "substeps" {
                "--substeps"
            } else {
                "--rate"
            };
            UsageError(format!("{flag} {value}: outside {lower}…{upper}")).into()
        }
        other => usage(other),
    }
}

/// Checks the conditions that clap cannot.
fn check(args: &RunArgs) -> Result<()> {
    args.paper.params().map_err(usage)?;
    check_tempo(args.tempo)?;
    for (name, value, range) in [
        ("--strength", args.strength, [0.01, 100.0]),
        ("--percentile", args.percentile, [5.0, 95.0]),
        ("--effort", args.effort, [0.0, 1.0]),
        ("--fatigue", args.fatigue, [0.0, MAX_TIME_SCALE]),
        ("--grip", args.grip, [0.0, f64::INFINITY]),
        ("--assist", args.assist, [0.0, 1.0]),
        ("--max-help", args.help.most(), [0.0, 2.0]),
        ("--push-duration", args.push_duration, [1e-3, 10.0]),
    ] {
        within(name, value, range)?;
    }
    if args.assist > 0.0 && args.help.most() > 0.0 {
        let text = "--assist and help while the motion is being lost (--follow, --max-help) exclude each other";
        return Err(UsageError(text.to_owned()).into());
    }
    if let Some(duration) = args.duration
        && !(duration > 0.0 && duration <= MAX_DURATION)
    {
        let text = format!("--duration {duration} s: outside 0…{MAX_DURATION}");
        return Err(UsageError(text).into());
    }
    for (name, value, high) in [
        ("--strip-frames", args.strip_frames, 64),
        ("--threads", args.threads, 256),
    ] {
        if !(1..=high).contains(&value) {
            return Err(UsageError(format!("{name} {value}: outside 1…{high}")).into());
        }
    }
    if let Some(path) = &args.out {
        extension("--out", path, &["bvh", "csv"])?;
    }
    if let Some(path) = &args.strip {
        extension("--strip", path, &["svg", "png"])?;
    }
    for (flag, path) in [
        ("--report", &args.report),
        ("--out", &args.out),
        ("--strip", &args.strip),
    ] {
        check_folder(flag, path.as_deref())?;
    }
    if args.out.is_some() || args.strip.is_some() {
        check_names(args.clips.iter().map(|c| source::name(c)).collect())?;
    }
    Ok(())
}

/// Runs every clip, several at a time if `--threads` says so, and prints a line as each one ends; the results are in
/// the order of the clips.
fn run_all(scenario: &Scenario<'_>, sources: &[LoadedClip]) -> Result<Vec<serde_json::Value>> {
    let bars = MultiProgress::new();
    let table = SummaryTable::new(
        &bars,
        scenario.args,
        sources.iter().map(|s| s.name.as_str()),
    );
    let next = AtomicUsize::new(0);
    let results: Mutex<Vec<Option<Result<serde_json::Value>>>> =
        Mutex::new(sources.iter().map(|_| None).collect());
    table.heading()?;
    std::thread::scope(|scope| {
        for _ in 0..scenario.args.threads.min(sources.len()) {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    let Some(source) = sources.get(i) else { break };
                    let result = run_one(scenario, source, sources.len() > 1, &table);
                    if result.is_err() {
                        // The command has failed: start no further clip.
                        next.store(sources.len(), Ordering::Relaxed);
                    }
                    let mut results = results
                        .lock()
                        .expect("no thread panics while it holds the results");
                    results[i] = Some(result);
                }
            });
        }
    });
    // A clip that was not started has no result; in that case another one has an error.
    let results = results.into_inner().expect("all threads have ended");
    let documents = results.into_iter().flatten().collect::<Result<Vec<_>>>()?;
    table.legend()?;
    Ok(documents)
}

fn run_one(
    scenario: &Scenario<'_>,
    source: &LoadedClip,
    several: bool,
    table: &SummaryTable<'_>,
) -> Result<serde_json::Value> {
    let args = scenario.args;
    let clip = &source.clip;
    let ticks = ((args.seconds(clip) * args.rate_hz()).round() as u64).max(1);
    let mut csv = None;
    let mut postures = None;
    if let Some(path) = &args.out {
        let path = for_clip(path, &source.name, several);
        if extension("--out", &path, &["bvh", "csv"])? == "csv" {
            csv = Some(RunCsv::create(&path)?);
        } else {
            postures = Some((path, Vec::new()));
        }
    }
    let bar = table.add(progress_bar(&source.name, ticks));
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
    let forecast = forecast::of(scenario, played);
    table.rows(&source.name, &report, &forecast)?;
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

/// Steps a world with one figure that follows `clip` for `ticks` ticks; `each` is called after every tick with the time
/// (s).
///
/// Returns the measures, and the frames of the ticks in `shown`.
fn simulate(
    scenario: &Scenario<'_>,
    clip: &Clip,
    ticks: u64,
    shown: &[u64],
    mut each: impl FnMut(&Figure, f64) -> Result<()>,
) -> Result<(RunReport, Vec<StripFrame>)> {
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
        let figure = world.figure(key).expect("the figure is never removed");
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
            frames.push(StripFrame::of(&tick, metrics.time_s(), loads).among(things));
        }
        each(figure, metrics.time_s())?;
    }
    Ok((metrics.finish(world.state_hash()), frames))
}

/// Starts the clips of `--then` that are due in the coming tick.
fn ask_for_clips(scenario: &Scenario<'_>, world: &mut World, key: FigureKey) {
    let (time, dt) = (world.time(), world.dt());
    let figure = world.figure_mut(key).expect("the figure is never removed");
    for (at, clip) in &scenario.then {
        if (time - 0.5 * dt..time + 0.5 * dt).contains(&WorldTime(*at)) {
            let play = ClipPlayback::new(Arc::clone(clip), time + clip.lead_in());
            figure.play(play, false, time);
        }
    }
}

/// A world with one figure at the beginning of the clip, its perturbations, and the obstacles.
fn scene(
    scenario: &Scenario<'_>,
    clip: &Clip,
    constraints: &[Constraint],
) -> Result<(World, FigureKey)> {
    let args = scenario.args;
    let body = &scenario.body;
    let mut world = World::new(scenario.params).context("the world cannot be created")?;
    let first = args.first(clip);
    let key = world
        .add_figure(FigureSetup {
            strength: scenario.strength.clone(),
            stepper: args.stepper_kind().into(),
            params: ControlParams {
                protective_steps: args.protective_steps,
                ..args.paper.params()?
            },
            options: FigureOptions {
                fatigue_time_scale: args.fatigue,
                assist: args.assist,
                max_help: args.help.most(),
                self_contact: args.self_contact,
            },
            name: clip.name().to_owned(),
            ..FigureSetup::new(
                Arc::clone(body),
                args.controller_kind().into(),
                clip.sample(first).state(),
            )
        })
        .context("the figure cannot be created")?;
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
    figure.set_drive(MotionSource::Clip(ClipPlayback {
        looped: args.looped,
        ..ClipPlayback::new(Arc::new(clip.clone()), WorldTime(-first))
    }));
    Ok((world, key))
}

fn note(metrics: &mut Metrics, event: &FigureEvent) {
    use FigureEvent as E;
    let kind = |kind| RunEvent {
        kind,
        ..RunEvent::default()
    };
    let on = |name, segment: SegmentId| RunEvent {
        segment: Some(segment.name()),
        ..kind(name)
    };
    let of = |name, dof: usize| RunEvent {
        dof: Some(DOF_NAMES[dof]),
        ..kind(name)
    };
    let load = |name, segment, mass| RunEvent {
        mass_kg: Some(mass),
        ..on(name, segment)
    };
    metrics.event(match *event {
        E::SupportGained { segment } => on("support_gained", segment),
        E::SupportLost { segment } => on("support_lost", segment),
        E::Saturated { dof } => of("saturated", dof),
        E::Relieved { dof } => of("relieved", dof),
        E::BalanceLost => kind("balance_lost"),
        E::Recovered => kind("recovered"),
        E::Fell => kind("fell"),
        E::GotUp => kind("got_up"),
        E::LoadTaken { segment, mass } => load("load_taken", segment, mass),
        E::LoadDropped { segment, mass } => load("load_dropped", segment, mass),
        E::LoadSlipped { segment, mass } => load("load_slipped", segment, mass),
        E::LoadShared {
            segment,
            mass,
            hand,
            need,
        } => RunEvent {
            hand: Some(hand.name()),
            need: Some(need),
            ..load("load_shared", segment, mass)
        },
        E::LoadUnshared {
            segment,
            mass,
            hand,
            need,
        } => RunEvent {
            hand: Some(hand.name()),
            need: Some(need),
            ..load("load_unshared", segment, mass)
        },
        E::WayBarred => kind("way_barred"),
        E::ClipRestarts => kind("clip_restarts"),
        E::ClipGivenUp => kind("clip_given_up"),
        E::Quarantined => kind("quarantined"),
        E::Touched { segment, .. } => on("touched", segment),
        E::Parted { segment, .. } => on("parted", segment),
    });
}
