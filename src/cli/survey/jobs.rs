//! The work of a survey: clips and copies on several threads, continued where an interrupted run stopped.
//!
//! A job is one run of one clip: the clip itself, or one noisy copy. Each result becomes a line of the partial file as
//! soon as it is available, under a key made of the bytes of the clip, the settings, the build and the copy, so that a
//! job is run again if any of these has changed.

use super::args::SurveyArgs;
use super::corpus::{ClipSource, CorpusClip};
use super::identity;
use crate::args::LoadSpec;
use anyhow::{Context, Result, anyhow};
use indicatif::{ProgressBar, ProgressStyle};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use sinew_evaluate::noise::noisy;
use sinew_evaluate::survey::{self, Copies, Lacks, MeasuredClip, SurveyOutcome, SurveyRow};
use sinew_physics::body::{Body, Links, State};
use sinew_physics::figure::{FigureOptions, Perturbation, StrengthScale};
use sinew_physics::forecast::{Forecast, forecast};
use sinew_physics::math::rounding::short;
use sinew_physics::motion::builtin::{BUILTIN_NAMES, builtin};
use sinew_physics::motion::{Bvh, Clip};
use sinew_physics::plan::feasibility::consistency;
use sinew_physics::plan::{ReadingReport, prepare_recording};
use sinew_physics::reference::{Preparation, RetargetOptions};
use sinew_physics::rehearsal::follow::{Follow, FollowResult, RehearsalOptions, follow};
use sinew_physics::rehearsal::{Conditions, RehearsedRun, TrackingReference};
use sinew_physics::strength::Strength;
use sinew_physics::world::WorldParams;
use std::collections::HashMap;
use std::fs::File;
use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock};

/// The result of one job.
#[derive(Clone, Debug, Serialize, Deserialize)]
enum JobResult {
    /// The clip itself.
    Clip(Box<MeasuredClip>),
    /// A copy of it.
    Copy(Box<SurveyOutcome>),
    /// It cannot be run; the reason.
    Failed(String),
}

/// A line of the partial file.
#[derive(Serialize, Deserialize)]
struct PartialLine {
    key: String,
    done: JobResult,
}

/// A clip that was read.
struct JobInput {
    entry: CorpusClip,
    bytes: Result<Vec<u8>, String>,
    /// The plan for it and its copies, made by the first job that needs it.
    plan: OnceLock<Result<FollowPlan, String>>,
}

/// How a clip is followed.
struct FollowPlan {
    fitted: FittedRecording,
    found: FollowResult,
}

/// Runs every job without a result in the partial file, and collects the rows in the order of the clips.
///
/// # Errors
/// The partial file cannot be written.
pub(super) fn run_all(
    args: &SurveyArgs,
    body: &Arc<Body>,
    settings: &Map<String, Value>,
    clips: &[CorpusClip],
) -> Result<Vec<SurveyRow>> {
    let settings =
        serde_json::to_string(settings).context("the settings cannot be written as JSON")?;
    let build = identity::build()?;
    let inputs: Vec<JobInput> = clips
        .iter()
        .map(|entry| JobInput {
            entry: entry.clone(),
            bytes: match &entry.source {
                ClipSource::Builtin(name) => Ok(name.clone().into_bytes()),
                // The tables report that it cannot be read.
                ClipSource::File(path) => std::fs::read(path).map_err(|e| e.to_string()),
            },
            plan: OnceLock::new(),
        })
        .collect();
    let jobs: Vec<(usize, u32)> = (0..inputs.len())
        .flat_map(|i| (0..=copies(args, &inputs[i])).map(move |k| (i, k)))
        .collect();
    let keys: Vec<String> = jobs
        .iter()
        .map(|(i, k)| {
            let bytes = inputs[*i].bytes.as_deref().unwrap_or_default();
            let name = inputs[*i].entry.name.as_bytes();
            identity::hash(&[
                name,
                bytes,
                settings.as_bytes(),
                build.as_bytes(),
                &k.to_le_bytes(),
            ])
        })
        .collect();
    let path = partial(&args.out);
    let known = read_partial(&path);
    let file = File::options()
        .create(true)
        .append(true)
        .open(&path)
        .with_context(|| format!("cannot write {}", path.display()))?;
    let file = Mutex::new((file, Ok(())));
    let bar = progress(jobs.len() as u64);
    let next = AtomicUsize::new(0);
    let results: Mutex<Vec<Option<JobResult>>> = Mutex::new(vec![None; jobs.len()]);
    let threads = args.threads();
    std::thread::scope(|scope| {
        for _ in 0..threads.min(jobs.len()) {
            scope.spawn(|| {
                loop {
                    let j = next.fetch_add(1, Ordering::Relaxed);
                    let Some(&(i, copy)) = jobs.get(j) else { break };
                    let done = known.get(&keys[j]).cloned().unwrap_or_else(|| {
                        let done = one(args, body, &inputs[i], copy);
                        keep(&file, &keys[j], &done);
                        done
                    });
                    bar.set_message(inputs[i].entry.name.clone());
                    bar.inc(1);
                    results
                        .lock()
                        .expect("no thread panics while it holds the results")[j] = Some(done);
                }
            });
        }
    });
    bar.finish_and_clear();
    let (_, written) = file.into_inner().expect("all threads have ended");
    written.with_context(|| format!("cannot write {}", path.display()))?;
    let results = results.into_inner().expect("all threads have ended");
    let mut done = jobs.iter().zip(results);
    Ok(inputs
        .iter()
        .map(|input| {
            let count = 1 + copies(args, input) as usize;
            let mine = done.by_ref().take(count).filter_map(|(_, d)| d).collect();
            row(input, mine)
        })
        .collect())
}

/// Number of copies; 0 for a built-in motion, which has no file to which noise could be added.
fn copies(args: &SurveyArgs, input: &JobInput) -> u32 {
    match input.entry.source {
        ClipSource::File(_) if input.bytes.is_ok() => args.copies,
        _ => 0,
    }
}

/// The row of a clip from its own result and those of its copies. A copy that cannot be run counts as lost if the clip
/// can be run.
fn row(input: &JobInput, done: Vec<JobResult>) -> SurveyRow {
    let mut row = SurveyRow {
        clip: input.entry.name.clone(),
        input: input
            .bytes
            .as_ref()
            .map_or(String::new(), |b| identity::hash(&[b])),
        error: None,
        result: None,
    };
    let mut outcomes = Vec::new();
    for d in done {
        match d {
            JobResult::Clip(measured) => row.result = Some(*measured),
            JobResult::Copy(outcome) => outcomes.push(*outcome),
            JobResult::Failed(why) if row.result.is_none() => row.error = row.error.or(Some(why)),
            JobResult::Failed(_) => outcomes.push(SurveyOutcome::default()),
        }
    }
    if let Some(measured) = &mut row.result
        && !outcomes.is_empty()
    {
        measured.copies = Some(Copies::of(&outcomes));
    }
    row
}

fn progress(jobs: u64) -> ProgressBar {
    // Drawn to standard error, and not at all if that is not a terminal.
    let style =
        ProgressStyle::with_template("{wide_bar:.cyan/dim} {pos}/{len} runs, {eta} left, {msg}")
            .expect("the template is a constant")
            .progress_chars("━╸─");
    ProgressBar::new(jobs).with_style(style)
}

/// File of the results until the survey is written.
fn partial(out: &Path) -> PathBuf {
    let mut name = out.file_name().map(ToOwned::to_owned).unwrap_or_default();
    name.push(".partial");
    out.with_file_name(name)
}

/// Removes the partial file of a finished survey.
pub(super) fn forget_partial(out: &Path) {
    // A file that stays is read again and does no harm.
    let _ = std::fs::remove_file(partial(out));
}

/// Results of an interrupted run; a line that was cut short is left out.
fn read_partial(path: &Path) -> HashMap<String, JobResult> {
    let text = std::fs::read(path).unwrap_or_default();
    text.split(|b| *b == b'\n')
        .filter_map(|line| serde_json::from_slice::<PartialLine>(line).ok())
        .map(|line| (line.key, line.done))
        .collect()
}

fn keep(file: &Mutex<(File, std::io::Result<()>)>, key: &str, done: &JobResult) {
    let line = PartialLine {
        key: key.to_owned(),
        done: done.clone(),
    };
    let mut text =
        serde_json::to_string(&line).expect("results have string keys and finite numbers");
    // Ends an incomplete line before this one.
    text.insert(0, '\n');
    text.push('\n');
    let mut held = file
        .lock()
        .expect("no thread panics while it holds the file");
    let (file, written) = &mut *held;
    if written.is_ok() {
        *written = file.write_all(text.as_bytes());
    }
}

/// Runs one job. A panic becomes a row with its message and does not end the survey.
fn one(args: &SurveyArgs, body: &Arc<Body>, input: &JobInput, copy: u32) -> JobResult {
    let work = || match &input.bytes {
        Err(why) => Err(anyhow!("{why}")),
        Ok(bytes) => job(args, body, input, bytes, copy),
    };
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(done)) => done,
        Ok(Err(error)) => JobResult::Failed(format!("{error:#}")),
        Err(panic) => {
            let text = panic.downcast_ref::<String>().map(String::as_str);
            let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
            JobResult::Failed(format!(
                "the program failed: {}",
                text.unwrap_or("no message")
            ))
        }
    }
}

/// A fitted recording with its report.
struct FittedRecording {
    reference: TrackingReference,
    prepared: Option<ReadingReport>,
}

fn job(
    args: &SurveyArgs,
    body: &Arc<Body>,
    input: &JobInput,
    bytes: &[u8],
    copy: u32,
) -> Result<JobResult> {
    let source = &input.entry.source;
    if args.rehearses() {
        let plan = input
            .plan
            .get_or_init(|| plan(args, body, source, bytes).map_err(|e| format!("{e:#}")));
        let plan = plan.as_ref().map_err(|why| anyhow!("{why}"))?;
        if copy == 0 {
            return Ok(JobResult::Clip(Box::new(planned(args, body, plan, bytes)?)));
        }
        if let Some(motion) = &plan.found.motion {
            let reference = &plan.fitted.reference;
            let lead = motion.lead_in();
            let mut conditions = conditions(args, body, reference, (bytes, copy), lead);
            conditions.rehearsed = Some(RehearsedRun {
                motion: Arc::clone(motion),
                from: disturbed(args, motion.start(), seed(bytes, copy, 0)),
            });
            let outcome = survey::run(&conditions, reference)?;
            return Ok(JobResult::Copy(Box::new(outcome)));
        }
    }
    let fitted = fitted(args, body, source, bytes, copy)?;
    let reference = &fitted.reference;
    let lead = match args.live_window {
        Some(_) => 0.0,
        None => reference.prepared.lead_in(),
    };
    let conditions = conditions(args, body, reference, (bytes, copy), lead);
    let outcome = survey::run(&conditions, reference)?;
    if copy > 0 {
        return Ok(JobResult::Copy(Box::new(outcome)));
    }
    let measured = measured(args, &conditions, &fitted, outcome);
    Ok(JobResult::Clip(Box::new(measured)))
}

/// A clip as figures track it, and the conditions under which they do.
pub(super) fn prepared(
    args: &SurveyArgs,
    body: &Arc<Body>,
    source: &ClipSource,
    bytes: &[u8],
) -> Result<(Arc<Clip>, Conditions)> {
    let reference = fitted(args, body, source, bytes, 0)?.reference;
    let lead = reference.prepared.lead_in();
    let conditions = conditions(args, body, &reference, (bytes, 0), lead);
    Ok((reference.prepared, conditions))
}

/// A built-in motion, or a recording fitted to the body.
fn fitted(
    args: &SurveyArgs,
    body: &Body,
    source: &ClipSource,
    bytes: &[u8],
    copy: u32,
) -> Result<FittedRecording> {
    let ClipSource::Builtin(name) = source else {
        return fit(args, body, bytes, copy);
    };
    let clip = builtin(body, name).with_context(|| {
        format!(
            "no built-in motion is called {name:?}; there are {}",
            BUILTIN_NAMES.join(", ")
        )
    })?;
    Ok(FittedRecording {
        reference: TrackingReference::authored(Arc::new(clip)),
        prepared: None,
    })
}

/// Loads and pushes of a run whose clip begins `lead` seconds after its start, and everything else on which the run
/// depends. Pushes are determined by the clip's bytes and the copy.
fn conditions(
    args: &SurveyArgs,
    body: &Arc<Body>,
    reference: &TrackingReference,
    (bytes, copy): (&[u8], u32),
    lead: f64,
) -> Conditions {
    let loads: Vec<Perturbation> = (args.load.iter())
        .map(|l| l.perturbation(body, f64::INFINITY))
        .collect();
    let clip = (lead, lead + reference.recorded.duration());
    let pushes = args.push.iter().enumerate().map(|(k, push)| {
        let seed = seed(bytes, copy, k as u32 + 1);
        push.perturbation(body, args.push_duration, clip, seed)
    });
    Conditions {
        body: Arc::clone(body),
        world: WorldParams {
            rate_hz: args.rate,
            gravity: args.gravity,
            ..WorldParams::default()
        },
        strength: StrengthScale {
            all: args.strength,
            percentile: args.percentile,
            ..StrengthScale::default()
        },
        options: FigureOptions {
            assist: args.assist,
            max_help: match Follow::from(args.follow).takes_help() {
                true => args.help.most(args.follow),
                false => 0.0,
            },
            ..FigureOptions::default()
        },
        perturbations: loads.into_iter().chain(pushes).collect(),
        live_window: args.live_window,
        rehearsed: None,
    }
}

/// Decides how a clip is followed, without pushes, which nothing can know in advance.
fn plan(
    args: &SurveyArgs,
    body: &Arc<Body>,
    source: &ClipSource,
    bytes: &[u8],
) -> Result<FollowPlan> {
    let fitted = fitted(args, body, source, bytes, 0)?;
    let reference = &fitted.reference;
    let as_recorded = match source {
        ClipSource::Builtin(_) => Arc::clone(&reference.recorded),
        ClipSource::File(_) => {
            let bvh = Bvh::parse(bytes).context("not a BVH file")?;
            let recording = bvh.recording().context("does not fit the body")?;
            let options = RetargetOptions {
                preparation: Preparation::REHEARSED,
                ..RetargetOptions::default()
            };
            Arc::new(
                prepare_recording(&recording, body, &options)
                    .context("does not fit the body")?
                    .clip,
            )
        }
    };
    let lead = reference.prepared.lead_in();
    let mut conditions = conditions(args, body, reference, (bytes, 0), lead);
    let is_load = |p: &Perturbation| p.load().is_some();
    conditions.perturbations.retain(is_load);
    let forecast = forecast_of(args, &conditions, &reference.prepared);
    let options = RehearsalOptions {
        follow: args.follow.into(),
        most_help: args.help.most(args.follow),
        seed: args.help.seed,
        ..RehearsalOptions::default()
    };
    let clip = (&*as_recorded, &forecast);
    let found = follow(&conditions, reference, clip, &options, &mut |_| true)?;
    Ok(FollowPlan { fitted, found })
}

/// The facts known about a clip once the way to follow it has been decided.
fn planned(
    args: &SurveyArgs,
    body: &Arc<Body>,
    plan: &FollowPlan,
    bytes: &[u8],
) -> Result<MeasuredClip> {
    let reference = &plan.fitted.reference;
    let lead = match &plan.found.motion {
        Some(motion) => motion.lead_in(),
        None => reference.prepared.lead_in(),
    };
    let conditions = conditions(args, body, reference, (bytes, 0), lead);
    let conditions = plan.found.conditions(&conditions);
    let outcome = survey::run(&conditions, reference)?;
    Ok(MeasuredClip {
        followed: Some(plan.found.followed.clone()),
        ..measured(args, &conditions, &plan.fitted, outcome)
    })
}

/// The state with the noise of a copy added: to the place of the pelvis, its rotation and all joints.
fn disturbed(args: &SurveyArgs, mut state: State, seed: u64) -> State {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let angle = args.noise.degrees.to_radians();
    let off = std::array::from_fn(|k| {
        let most = if (3..6).contains(&k) {
            args.noise.metres
        } else {
            angle
        };
        most * rng.random_range(-1.0..=1.0)
    });
    state.posture.integrate(&off, 1.0);
    state
}

/// Fits a recording, or a copy of it with noise, to the body: as it is, and prepared.
fn fit(args: &SurveyArgs, body: &Body, bytes: &[u8], copy: u32) -> Result<FittedRecording> {
    let as_recorded = RetargetOptions {
        preparation: Preparation::NONE,
        ..RetargetOptions::default()
    };
    let options = RetargetOptions {
        preparation: Preparation::walking(!args.keeps_runs()),
        ..RetargetOptions::default()
    };
    let mut bvh = Bvh::parse(bytes).context("not a BVH file")?;
    let mut recording = bvh.recording().context("does not fit the body")?;
    let mut recorded =
        prepare_recording(&recording, body, &as_recorded).context("does not fit the body")?;
    if copy > 0 {
        let mut rng = Pcg64Mcg::seed_from_u64(seed(bytes, copy, 0));
        let distance = args.noise.metres / recorded.report.size.unit_m;
        let random = || rng.random_range(-1.0..=1.0);
        let text = noisy(bytes, &bvh, distance, args.noise.degrees, random)
            .context("has no motion that could have noise")?;
        bvh = Bvh::parse(text.as_bytes()).context("the copy is not a BVH file")?;
        recording = bvh.recording().context("the copy does not fit the body")?;
        recorded = prepare_recording(&recording, body, &as_recorded)
            .context("the copy does not fit the body")?;
    }
    let prepared =
        prepare_recording(&recording, body, &options).context("does not fit the body")?;
    Ok(FittedRecording {
        reference: TrackingReference {
            phases: recorded.report.feet.phases.clone(),
            recorded: Arc::new(recorded.clip),
            prepared: Arc::new(prepared.clip),
        },
        prepared: Some(prepared.report),
    })
}

/// A different seed for each clip, copy and purpose.
fn seed(bytes: &[u8], copy: u32, purpose: u32) -> u64 {
    let text = identity::hash(&[bytes, &copy.to_le_bytes(), &purpose.to_le_bytes()]);
    u64::from_str_radix(&text, 16).expect("a hash is sixteen hexadecimal digits")
}

/// The facts known about a clip besides the result of its run.
fn measured(
    args: &SurveyArgs,
    conditions: &Conditions,
    fitted: &FittedRecording,
    outcome: SurveyOutcome,
) -> MeasuredClip {
    let (body, reference) = (&conditions.body, &fitted.reference);
    let (recorded, prepared) = (&reference.recorded, &reference.prepared);
    let postures = |clip: &Clip| -> Vec<_> { (0..clip.len()).map(|i| *clip.posture(i)).collect() };
    let label: Vec<[bool; 2]> = (0..recorded.len())
        .map(|i| reference.labelled((i as f64 + 0.5) / recorded.rate_hz()))
        .collect();
    let raw = postures(recorded);
    let own: Vec<[bool; 2]> = (0..prepared.len()).map(|i| prepared.planted(i)).collect();
    let lacks = |postures: &[_], label: &[[bool; 2]], clip: &Clip| {
        Lacks::from(&consistency(body, postures, label, clip.rate_hz()))
    };
    MeasuredClip {
        kind: survey::kind::kind(body, &raw, &label, recorded.rate_hz()),
        clip_s: short(recorded.duration()),
        walked: fitted.prepared.as_ref().is_some_and(|r| r.runs.walked),
        prepared_off_m: short(survey::prepared_off(reference, body)),
        warnings: fitted
            .prepared
            .as_ref()
            .map_or(Vec::new(), |r| r.warnings.clone()),
        recorded_lacks: fitted
            .prepared
            .as_ref()
            .map(|_| lacks(&raw, &label, recorded)),
        prepared_lacks: lacks(&postures(prepared), &own, prepared),
        forecast: forecast_of(args, conditions, prepared),
        outcome,
        copies: None,
        followed: None,
    }
}

/// The forecast of plain tracking, with the loads that are carried from the start.
fn forecast_of(args: &SurveyArgs, conditions: &Conditions, clip: &Clip) -> Forecast {
    let body = &conditions.body;
    let mut links = Links::new(body);
    for load in args.load.iter().filter(|l| l.from_s <= 0.0) {
        add(&mut links, body, load);
    }
    let strength = Strength::at_percentile(body, conditions.strength.percentile);
    forecast(body, &links, &strength, &conditions.strength, clip)
}

/// Adds a load that is carried from the start.
fn add(links: &mut Links, body: &Body, load: &LoadSpec) {
    if let Some(held) = load.perturbation(body, f64::INFINITY).load() {
        for (segment, point, mass) in held.shares() {
            links.add_load(segment, point, mass);
        }
    }
}
