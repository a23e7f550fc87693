//! `sinew rehearse`: finds the changes to a recording, or the help, with which a body can do it.

use super::args::{BodyArgs, FileArgs, FollowArg, HelpArgs, LoadSpec};
use super::exit::{usage, within};
use super::number::{counted, seconds};
use super::output::{check_folder, extension, write};
use super::run::ViewArg;
use super::source::{load, warn};
use super::terminal::print;
use anyhow::{Context, Result};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};
use sinew_evaluate::Tick;
use sinew_evaluate::strip::{Drawing, StripFrame, StripOptions, draw, evenly_spaced, raster};
use sinew_evaluate::survey::{SurveyOutcome, run as measure, watched};
use sinew_physics::body::Body;
use sinew_physics::figure::{FigureOptions, StrengthScale};
use sinew_physics::forecast::{Forecast, forecast};
use sinew_physics::motion::{Clip, write_bvh};
use sinew_physics::reference::{Preparation, RetargetOptions};
use sinew_physics::rehearsal::follow::{FollowResult, RehearsalOptions, RehearsalReport, follow};
use sinew_physics::rehearsal::trial::TrialResult;
use sinew_physics::rehearsal::{Conditions, Progress, TrackingReference};
use sinew_physics::strength::Strength;
use sinew_physics::world::WorldParams;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Rehearses a recording offline: where plain tracking loses it, searches for what has to be added to its joints so
/// that strength does it, and for the least help where strength does not. docs/rehearsal.md says how.
#[derive(Clone, Debug, clap::Args)]
pub struct RehearseArgs {
    /// Motion: a BVH file or builtin:NAME.
    #[arg(value_name = "CLIP")]
    pub clip: String,
    /// Body of the figure.
    #[command(flatten)]
    pub body: BodyArgs,
    /// Unit and axes of the file.
    #[command(flatten)]
    pub file: FileArgs,
    /// How far it may go.
    #[arg(long, value_enum, default_value_t)]
    pub follow: FollowArg,
    /// Help and random numbers.
    #[command(flatten)]
    pub help: HelpArgs,
    /// Factor on the strength of every joint, 0.01 to 100.
    #[arg(long, value_name = "F", default_value_t = 1.0)]
    pub strength: f64,
    /// Percentile of strength among people of that sex, age and size, 5 to 95.
    #[arg(long, value_name = "P", default_value_t = 50.0)]
    pub percentile: f64,
    /// Load held all the time by one segment, for example 3@r_hand (repeatable).
    #[arg(long, value_name = "KG@SEGMENT", allow_hyphen_values = true)]
    pub load: Vec<LoadSpec>,
    /// Most time for the search, s: the best that was found until then is the result, which depends on the machine
    /// then. Otherwise the search ends by itself, and the result is the same everywhere.
    #[arg(long, value_name = "S")]
    pub budget_s: Option<f64>,
    /// Threads; the result does not depend on their number. Default: one for each core.
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
    /// Ticks per second, 30 to 240.
    #[arg(long, value_name = "HZ", default_value_t = 60.0)]
    pub rate: f64,
    /// Draws plain tracking above and the result below it.
    #[arg(long, value_name = "FILE.png")]
    pub strip: Option<PathBuf>,
    /// Number of frames in each row of the strip.
    #[arg(long, value_name = "N", default_value_t = 10)]
    pub strip_frames: usize,
    /// Camera view of the strip.
    #[arg(long, value_enum, default_value_t)]
    pub view: ViewArg,
    /// Writes the simulated motion as BVH.
    #[arg(long, value_name = "FILE.bvh")]
    pub out: Option<PathBuf>,
    /// Prints the report as JSON on standard output, and nothing else there.
    #[arg(long)]
    pub json: bool,
}

/// A recording in the forms needed by a rehearsal.
pub(super) struct Forms {
    /// The reference by which it is judged: as recorded and as prepared.
    pub reference: TrackingReference,
    /// The clip that is rehearsed.
    pub as_recorded: Arc<Clip>,
}

/// Runs the command.
///
/// # Errors
/// Bad arguments, an unreadable clip, loads that cannot be rehearsed, files that cannot be written.
pub fn run(args: &RehearseArgs) -> Result<()> {
    check(args).map_err(usage)?;
    let body = Arc::new(args.body.build()?);
    let (name, forms) = read(args, &body)?;
    let conditions = conditions(args, &body);
    let options = RehearsalOptions {
        follow: args.follow.into(),
        most_help: args.help.most(args.follow),
        threads: args.threads.unwrap_or_else(cores),
        seed: args.help.seed,
        ..RehearsalOptions::default()
    };
    let forecast = forecast_of(&conditions, &forms.reference.prepared);
    let bar = progress_bar(&name);
    let begun = Instant::now();
    let before = processor_time();
    let found = {
        let mut go_on = |p: &Progress| {
            show(&bar, p);
            args.budget_s
                .is_none_or(|s| begun.elapsed().as_secs_f64() < s)
        };
        let clip = (&*forms.as_recorded, &forecast);
        follow(&conditions, &forms.reference, clip, &options, &mut go_on)?
    };
    bar.finish_and_clear();
    let took = processor_time()
        .zip(before)
        .map(|(a, b)| (a - b).as_secs_f64());
    let played = found.conditions(&conditions);
    if let Some(path) = &args.strip {
        let frames = args.strip_frames;
        let title = |what: &str| format!("{name}: {what}, strength {}", args.strength);
        let rows = [
            (&conditions, title("plain tracking")),
            (&played, title(found.followed.way.name())),
        ];
        let drawn = rows.map(|(c, title)| row(c, &forms.reference, args.view, frames, title));
        let [above, below] = drawn;
        let drawing = above?.above(below?);
        let png =
            raster::png(&drawing).with_context(|| format!("cannot draw {}", path.display()))?;
        write(path, png)?;
    }
    if let Some(path) = &args.out {
        let mut postures = Vec::new();
        watched(&played, &forms.reference, |f, _| {
            postures.push(f.state().posture)
        })?;
        write(path, write_bvh(&body, &postures, args.rate))?;
    }
    let text = if args.json {
        let [tracked, outcome] = [&conditions, &played].map(|c| measure(c, &forms.reference));
        let measured = [tracked?, outcome?];
        let all = json(&name, &found, measured, &forecast, took);
        serde_json::to_string_pretty(&all).context("the report cannot be written as JSON")? + "\n"
    } else {
        text(&name, &found, took)
    };
    print(&text)
}

fn check(args: &RehearseArgs) -> Result<()> {
    args.help.check()?;
    for (name, value, range) in [
        ("--strength", args.strength, [0.01, 100.0]),
        ("--percentile", args.percentile, [5.0, 95.0]),
        ("--budget-s", args.budget_s.unwrap_or(1.0), [0.0, 1e6]),
        ("--rate", args.rate, [30.0, 240.0]),
        ("--threads", args.threads.unwrap_or(1) as f64, [1.0, 64.0]),
        ("--strip-frames", args.strip_frames as f64, [1.0, 64.0]),
    ] {
        within(name, value, range)?;
    }
    if let Some(path) = &args.strip {
        extension("--strip", path, &["png"])?;
    }
    if let Some(path) = &args.out {
        extension("--out", path, &["bvh"])?;
    }
    check_folder("--strip", args.strip.as_deref())?;
    check_folder("--out", args.out.as_deref())?;
    if args.follow == FollowArg::Strict {
        return Ok(());
    }
    args.load.iter().try_for_each(LoadSpec::check_rehearsable)
}

fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

fn conditions(args: &RehearseArgs, body: &Arc<Body>) -> Conditions {
    let loads = args.load.iter();
    Conditions {
        body: Arc::clone(body),
        world: WorldParams {
            rate_hz: args.rate,
            ..WorldParams::default()
        },
        strength: StrengthScale {
            all: args.strength,
            percentile: args.percentile,
            ..StrengthScale::default()
        },
        options: FigureOptions::default(),
        perturbations: loads.map(|l| l.perturbation(body, f64::INFINITY)).collect(),
        live_window: None,
        rehearsed: None,
    }
}

/// The clip, fitted to the body in three forms: for judging, for tracking and for the rehearsal.
fn read(args: &RehearseArgs, body: &Body) -> Result<(String, Forms)> {
    let fitted = |preparation: Preparation| {
        let options = args.file.apply(RetargetOptions {
            preparation,
            ..RetargetOptions::default()
        });
        load(&args.clip, body, &options)
    };
    let prepared = fitted(Preparation::walking(false))?;
    warn(&prepared);
    let clip = Arc::new(prepared.clip);
    let Some(report) = prepared.retarget else {
        let reference = TrackingReference::authored(Arc::clone(&clip));
        let forms = Forms {
            reference,
            as_recorded: clip,
        };
        return Ok((prepared.name, forms));
    };
    let reference = TrackingReference {
        phases: report.feet.phases.clone(),
        recorded: Arc::new(fitted(Preparation::NONE)?.clip),
        prepared: clip,
    };
    let as_recorded = Arc::new(fitted(Preparation::REHEARSED)?.clip);
    Ok((
        prepared.name,
        Forms {
            reference,
            as_recorded,
        },
    ))
}

/// The forecast of plain tracking, including the loads.
fn forecast_of(conditions: &Conditions, clip: &Clip) -> Forecast {
    let mut links = sinew_physics::body::Links::new(&conditions.body);
    for load in conditions.perturbations.iter().filter_map(|p| p.load()) {
        for (segment, point, mass) in load.shares() {
            links.add_load(segment, point, mass);
        }
    }
    let strength = Strength::at_percentile(&conditions.body, conditions.strength.percentile);
    forecast(
        &conditions.body,
        &links,
        &strength,
        &conditions.strength,
        clip,
    )
}

fn progress_bar(name: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(
        "{prefix:>14} {wide_bar:.cyan/dim} {pos}/{len} windows, {elapsed}, {msg}",
    )
    .expect("the template is a constant")
    .progress_chars("━╸─");
    ProgressBar::new(1)
        .with_style(style)
        .with_prefix(name.to_owned())
}

fn show(bar: &ProgressBar, p: &Progress) {
    let [reached, all] = p.reached;
    bar.set_length(all as u64);
    bar.set_position(reached as u64);
    let helps = if p.helps { ", with help" } else { "" };
    let polished = match p.polished {
        0 => String::new(),
        n => format!(", polished {}", counted(n, "time")),
    };
    bar.set_message(format!(
        "round {}{polished}{helps}, {} ticks",
        p.round + 1,
        p.ticks
    ));
}

/// Processor time that this process has used.
fn processor_time() -> Option<Duration> {
    #[cfg(target_os = "linux")]
    {
        use rustix::time::{ClockId, clock_gettime};
        let t = clock_gettime(ClockId::ProcessCPUTime);
        Some(Duration::new(
            u64::try_from(t.tv_sec).ok()?,
            u32::try_from(t.tv_nsec).ok()?,
        ))
    }
    #[cfg(not(target_os = "linux"))]
    None
}

/// How long a strip continues after the recording, s.
const AFTER: f64 = 1.0;

/// A row of frames of one run.
fn row(
    conditions: &Conditions,
    reference: &TrackingReference,
    view: ViewArg,
    frames: usize,
    title: String,
) -> Result<Drawing> {
    let seconds = reference.recorded.duration() + AFTER;
    let ticks = (seconds * conditions.world.rate_hz).round().max(1.0) as u64;
    let shown = evenly_spaced(ticks, frames);
    let mut all = Vec::new();
    let gravity = conditions.world.gravity;
    watched(conditions, reference, |figure, time| {
        let tick = (time * conditions.world.rate_hz).round() - 1.0;
        if tick >= 0.0 && shown.binary_search(&(tick as u64)).is_ok() {
            all.push(StripFrame::of(&Tick::of(figure, gravity), time, Vec::new()));
        }
    })?;
    let options = StripOptions {
        view: view.into(),
        title,
        ..StripOptions::default()
    };
    Ok(draw(&conditions.body, &all, &options))
}

fn json(
    name: &str,
    found: &FollowResult,
    [tracked, outcome]: [SurveyOutcome; 2],
    forecast: &Forecast,
    took: Option<f64>,
) -> Value {
    json!({
        "clip": name,
        "followed": found.followed,
        "forecast": forecast,
        "outcome": outcome,
        "tracked": tracked,
        "processor_s": took,
        "processor_s_per_clip_s": per_second(found, took),
    })
}

/// Processor seconds per second of the rehearsed motion.
fn per_second(found: &FollowResult, took: Option<f64>) -> Option<f64> {
    let report = found.followed.rehearsal.as_ref()?;
    Some(took? / report.duration_s)
}

/// The report in words.
fn text(name: &str, found: &FollowResult, took: Option<f64>) -> String {
    let line = |what: &str, t: &TrialResult| {
        let end = match t.lost_at {
            None if t.completed => "completed".to_owned(),
            Some(t) => format!("lost at {t:.2} s"),
            None => "lost".to_owned(),
        };
        format!(
            "  {what:<14} {end}; mean distance {:.0} mm in the world, {:.0} mm from the pelvis; help {:.1} % of \
             weight × time, at most {:.0} N\n",
            t.global_mm,
            t.root_relative_mm,
            100.0 * t.help.share,
            t.help.most
        )
    };
    let mut out = format!("{name}: {}\n", found.followed.way.name());
    out += &line("tracking", &found.tracked);
    if found.motion.is_some() || found.helped.is_some() {
        out += &line("as played", &found.trial);
    }
    if let Some(r) = &found.followed.rehearsal {
        out += &describe(r, took);
    }
    out + &format!("  {:<14} {}\n", "why", found.followed.reason)
}

fn describe(r: &RehearsalReport, took: Option<f64>) -> String {
    let end = match (r.completed, r.lost_at_s, r.stopped) {
        (true, ..) => "found".to_owned(),
        (_, _, true) => format!("stopped with {:.0} % of the windows", 100.0 * r.reached),
        (_, lost, _) => {
            let at = lost.map_or("late".to_owned(), |t| format!("at {t:.2} s"));
            format!(
                "not found: lost {at}, {:.0} % of the windows reached",
                100.0 * r.reached
            )
        }
    };
    let cost = took.map_or(String::new(), |s| {
        let per = s / r.duration_s.max(1e-3);
        format!(
            ", {} of processor time, {per:.1} s for each second",
            seconds(s)
        )
    });
    format!(
        "  {:<14} {end}; {}, {}{cost}\n",
        "rehearsal",
        counted(r.rounds, "round"),
        counted(r.ticks, "tick")
    )
}
