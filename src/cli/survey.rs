//! `sinew survey`: runs every clip of a corpus through the physics and judges all by one set of rules; prints a table
//! of the results.

mod args;
mod corpus;
mod file;
mod identity;
mod jobs;
mod page;
mod push;
mod pushes;
mod pushes_spec;
mod summary;

pub use args::SurveyArgs;

use super::args::{FollowArg, LoadSpec};
use super::exit::within;
use super::number::counted;
use super::output::check_folder;
use anyhow::{Result, bail};
use sinew_evaluate::survey::compare::compare;
use sinew_evaluate::survey::tables;
use sinew_physics::body::Body;
use sinew_physics::rehearsal::follow::Follow;
use sinew_physics::world::WorldParams;
use std::io::Write;
use std::sync::Arc;

/// Largest number of copies of a clip.
const MAX_COPIES: u32 = 1000;

/// Runs the command.
///
/// # Errors
/// Bad arguments, an empty corpus, files that cannot be written, settings that differ from those compared with,
/// regressions.
pub fn run(args: &SurveyArgs) -> Result<()> {
    check(args).map_err(super::exit::usage)?;
    let body = Arc::new(args.body.build()?);
    let clips = corpus::gather(&args.corpus)?;
    // Check the survey to compare with, and the place to write to, before an hour of work.
    let old = args.compare.as_deref().map(file::read).transpose()?;
    if let Some(page) = &args.page {
        page.check()?;
    }
    if !args.pushes.is_empty() {
        return pushes::run(args, &body, &clips);
    }
    let settings = settings(args, &body);
    if let Some(old) = &old {
        file::check_settings(&old.settings, &settings, &args.across)?;
    }
    let rows = jobs::run_all(args, &body, &settings, &clips)?;
    file::write_survey(&args.out, &settings, &rows)?;
    jobs::forget_partial(&args.out);
    say(&tables::text(&rows));
    let failed = rows.iter().filter(|r| r.error.is_some()).count();
    say(&format!(
        "{}, {failed} of them could not be read; {}\n",
        counted(rows.len(), "clip"),
        args.out.display()
    ));
    if let Some(folder) = &args.summary {
        summary::write_page(folder)?;
    }
    if let Some(page) = &args.page {
        page.fill(&tables::summary(&rows), std::env::args())?;
    }
    let Some(old) = old else { return Ok(()) };
    let found = compare(&old.rows, &rows);
    say(&found.text());
    match found.regressions() {
        0 => Ok(()),
        n => bail!("{} beyond noise", counted(n, "regression")),
    }
}

/// Prints; a reader that has gone away is no reason to stop.
fn say(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}

fn check(args: &SurveyArgs) -> Result<()> {
    args.help.check()?;
    for (name, value, range) in [
        ("--strength", args.strength, [0.01, 100.0]),
        ("--percentile", args.percentile, [5.0, 95.0]),
        ("--assist", args.assist, [0.0, 1.0]),
        ("--push-duration", args.push_duration, [1e-3, 10.0]),
        ("--live-window", args.live_window.unwrap_or(1.0), [0.3, 1.0]),
        ("--gravity", args.gravity, [0.0, 30.0]),
        ("--rate", args.rate, [30.0, 240.0]),
        (
            "--copies",
            f64::from(args.copies),
            [0.0, f64::from(MAX_COPIES)],
        ),
        ("--jobs", args.jobs.unwrap_or(1) as f64, [1.0, 256.0]),
    ] {
        within(name, value, range)?;
    }
    check_folder("--out", Some(&args.out))?;
    if let Some(folder) = &args.summary {
        check_folder("--summary", Some(&folder.join("README.md")))?;
    }
    if args.rehearse && args.follow == FollowArg::Strict {
        bail!("--rehearse needs --follow rehearsed, assisted or always");
    }
    if !args.rehearses() {
        return Ok(());
    }
    args.load.iter().try_for_each(LoadSpec::check_rehearsable)
}

/// Everything besides clips and build on which the numbers depend, by name.
fn settings(args: &SurveyArgs, body: &Body) -> serde_json::Map<String, serde_json::Value> {
    let p = &body.profile;
    let loads: Vec<String> = (args.load.iter())
        .map(|l| {
            let all_the_time = LoadSpec {
                from_s: 0.0,
                to_s: f64::INFINITY,
                ..*l
            };
            format!("{all_the_time}@{}..{}", l.from_s, l.to_s)
        })
        .collect();
    let pushes: Vec<String> = args.push.iter().map(ToString::to_string).collect();
    let world = WorldParams::default();
    let all = serde_json::json!({
        "sex": sinew_physics::body::names::sex_name(p.sex),
        "age_years": p.age,
        "height_m": p.height,
        "mass_kg": p.mass,
        "strength": args.strength,
        "percentile": args.percentile,
        "assist": args.assist,
        "loads": loads,
        "pushes": pushes,
        "push_duration_s": args.push_duration,
        "live_window_s": args.live_window,
        "keep_runs": args.keeps_runs(),
        "gravity_mps2": args.gravity,
        "friction": world.friction,
        "rate_hz": args.rate,
        "substeps": world.substeps,
        "copies": args.copies,
        "noise_mm": sinew_physics::math::rounding::short(1e3 * args.noise.metres),
        "noise_deg": args.noise.degrees,
    });
    match all {
        // Surveys of plain tracking keep the form they had before other ways to follow existed.
        serde_json::Value::Object(map) if args.follow == FollowArg::Strict => map,
        serde_json::Value::Object(mut map) => {
            let follow = Follow::from(args.follow).name();
            map.insert("follow".to_owned(), follow.into());
            map.insert("max_help".to_owned(), args.help.most(args.follow).into());
            if args.rehearses() {
                map.insert("rehearsed".to_owned(), true.into());
                map.insert("seed".to_owned(), args.help.seed.into());
            }
            map
        }
        _ => unreachable!("it was written as an object"),
    }
}
