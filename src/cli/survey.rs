//! `sinew survey`: every clip of a corpus through the physics, judged by one set of rules; a table of what came of it.

mod corpus;
mod file;
mod jobs;
mod page;
mod push;

use super::args::{BodyArgs, LoadSpec};
use super::exit::within;
use super::number::counted;
use super::output::{check_folder, write};
use super::rehearse::{FollowArg, HelpArgs};
use anyhow::{Context, Result, bail};
use page::PageSpec;
use push::SurveyPush;
use sinew_evaluate::follow::Follow;
use sinew_evaluate::survey::compare::compare;
use sinew_evaluate::survey::tables;
use sinew_physics::body::Body;
use sinew_physics::world::WorldParams;
use std::io::Write;
use std::path::PathBuf;
use std::str::FromStr;
use std::sync::Arc;

/// Most copies of a clip.
const MAX_COPIES: u32 = 1000;

/// Runs every clip of a corpus and says how well it was followed, by kind of motion, with a forecast of each before
/// it is run.
///
/// Exit code 0: the survey is written; clips that cannot be read are rows with their error. 1: it could not be made,
/// or `--compare` found regressions beyond noise. 2: bad arguments, or a motion that is not there. docs/survey.md
/// defines every column.
#[derive(Clone, Debug, clap::Args)]
pub struct SurveyArgs {
    /// Motions: BVH files, folders (all *.bvh in them) or builtin:NAME.
    #[arg(required = true, value_name = "CORPUS")]
    pub corpus: Vec<String>,
    /// Writes the survey as JSON. An interrupted run is continued from FILE.json.partial.
    #[arg(long, value_name = "FILE.json")]
    pub out: PathBuf,
    /// Also runs this many noisy copies of every recording.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub copies: u32,
    /// Noise of the copies, evenly distributed up to: positions, then angles.
    #[arg(
        long,
        value_name = "MM,DEG",
        default_value = "1mm,0.2deg",
        allow_hyphen_values = true
    )]
    pub noise: NoiseSpec,
    /// Compares with an earlier survey of the same clips under the same settings.
    #[arg(long, value_name = "OLD.json")]
    pub compare: Option<PathBuf>,
    /// Settings that may differ from those of the earlier survey, besides build and gravity_mps2 (repeatable).
    #[arg(long, value_name = "SETTING", requires = "compare")]
    pub across: Vec<String>,
    /// Body of the figure.
    #[command(flatten)]
    pub body: BodyArgs,
    /// Factor on the strength of every joint, 0.01 to 100.
    #[arg(long, value_name = "F", default_value_t = 1.0)]
    pub strength: f64,
    /// Percentile of strength among people of that sex, age and size, 5 to 95.
    #[arg(long, value_name = "P", default_value_t = 50.0)]
    pub percentile: f64,
    /// Help towards the desired pose of the pelvis, 0 to 1; reported, not physical.
    #[arg(long, value_name = "A", default_value_t = 0.0)]
    pub assist: f64,
    /// Load held by one or two segments, for example 3@r_hand or 8@l_hand+r_hand (repeatable).
    #[arg(
        long,
        value_name = "KG@SEGMENT[+SEGMENT][@T0..T1]",
        allow_hyphen_values = true
    )]
    pub load: Vec<LoadSpec>,
    /// Push on a segment: 20@chest@1.5:1,0,0 (N·s, start in s from the beginning of the run, world direction), or
    /// 10@random, 10@pelvis@random at a time and in a level direction that follow from the clip and the copy
    /// (repeatable).
    #[arg(
        long,
        value_name = "NS@SEGMENT@T:x,y,z|NS@random",
        allow_hyphen_values = true
    )]
    pub push: Vec<SurveyPush>,
    /// How long a push lasts, s.
    #[arg(long, value_name = "S", default_value_t = 0.2)]
    pub push_duration: f64,
    /// Streams each recording through a preparation window of 0.3 to 1 s instead of preparing it as a whole.
    #[arg(long, value_name = "S")]
    pub live_window: Option<f64>,
    /// What may be done with a clip that plain tracking loses: nothing (strict), a rehearsal, or a rehearsal and as
    /// little help as will do. Noise is then on the state that a rehearsed clip begins in.
    #[arg(long, value_enum, default_value_t = FollowArg::Strict, conflicts_with = "assist")]
    pub follow: FollowArg,
    /// Help and random numbers of rehearsals.
    #[command(flatten)]
    pub help: HelpArgs,
    /// Leave runs as they were recorded. Otherwise they are walked, slower and with shorter steps.
    #[arg(long)]
    pub keep_runs: bool,
    /// Gravity of the world, m/s², 0 to 30; motions are prepared for 9.81 whatever it is.
    #[arg(long, value_name = "G", default_value_t = WorldParams::default().gravity)]
    pub gravity: f64,
    /// Ticks per second, 30 to 240.
    #[arg(long, value_name = "HZ", default_value_t = 60.0)]
    pub rate: f64,
    /// Runs at the same time; the result does not depend on it. Default: one for each core.
    #[arg(long, value_name = "N")]
    pub jobs: Option<usize>,
    /// Writes all tables in Markdown.
    #[arg(long, value_name = "FILE.md")]
    pub markdown: Option<PathBuf>,
    /// Puts the table by kind of motion, what came of the forecasts, and the command that makes them between the marks
    /// of a section in a file: `<!-- survey SECTION begin: … -->` and `<!-- survey SECTION end -->`.
    #[arg(long, value_name = "FILE#SECTION")]
    pub page: Option<PageSpec>,
}

/// `1mm,0.2deg`: largest error of positions and of angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseSpec {
    /// m.
    pub metres: f64,
    /// Degrees.
    pub degrees: f64,
}

impl FromStr for NoiseSpec {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = || format!("{text:?} is not of the form MMmm,DEGdeg, for example 1mm,0.2deg");
        let (mm, deg) = text.split_once(',').ok_or_else(form)?;
        let number = |text: &str, unit: &str, most: f64| {
            let n: f64 = text
                .trim()
                .strip_suffix(unit)
                .ok_or_else(form)?
                .trim()
                .parse()
                .map_err(|_| form())?;
            if (0.0..=most).contains(&n) {
                Ok(n)
            } else {
                Err(format!("noise {n} {unit}: outside 0…{most}"))
            }
        };
        Ok(Self {
            metres: 1e-3 * number(mm, "mm", 100.0)?,
            degrees: number(deg, "deg", 30.0)?,
        })
    }
}

/// Runs the command.
///
/// # Errors Bad arguments, an empty corpus, files that cannot be written, settings that differ from those compared
/// with, regressions.
pub fn run(args: &SurveyArgs) -> Result<()> {
    check(args).map_err(super::exit::usage)?;
    let body = Arc::new(args.body.build()?);
    let clips = corpus::gather(&args.corpus)?;
    // What it is compared with, and where it is to be written, is worth knowing before an hour of work.
    let old = args.compare.as_deref().map(file::read).transpose()?;
    if let Some(page) = &args.page {
        page.check()?;
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
    if let Some(path) = &args.markdown {
        let command = page::command(std::env::args());
        let text = format!("# Survey\n\n`{command}`\n\n{}", tables::markdown(&rows));
        write(path, text)?;
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
    check_folder("--markdown", args.markdown.as_deref())?;
    // Streams are not rehearsed.
    if args.follow == FollowArg::Strict || args.live_window.is_some() {
        return Ok(());
    }
    args.load.iter().try_for_each(LoadSpec::check_rehearsable)
}

/// Everything that the numbers depend on besides clips and build, by name.
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
        "keep_runs": args.keep_runs,
        "gravity_mps2": args.gravity,
        "friction": world.friction,
        "rate_hz": args.rate,
        "substeps": world.substeps,
        "copies": args.copies,
        "noise_mm": sinew_evaluate::survey::stats::short(1e3 * args.noise.metres),
        "noise_deg": args.noise.degrees,
    });
    match all {
        // Surveys of plain tracking are as they were before there was anything else.
        serde_json::Value::Object(map) if args.follow == FollowArg::Strict => map,
        serde_json::Value::Object(mut map) => {
            let follow = Follow::from(args.follow).name();
            map.insert("follow".to_owned(), follow.into());
            map.insert("max_help".to_owned(), args.help.max_help.into());
            map.insert("seed".to_owned(), args.help.seed.into());
            map
        }
        _ => unreachable!("it was written as an object"),
    }
}

/// A hash of bytes as sixteen digits.
fn hash(parts: &[&[u8]]) -> String {
    let mut h = sinew_physics::math::hash::Fnv::default();
    for part in parts {
        h.u64(part.len() as u64);
        for word in part.chunks(8) {
            let mut bytes = [0; 8];
            bytes[..word.len()].copy_from_slice(word);
            h.u64(u64::from_le_bytes(bytes));
        }
    }
    format!("{:016x}", h.finish())
}

/// What was built: version, and a hash of the program itself.
fn build() -> Result<String> {
    let path = std::env::current_exe().context("cannot find this program's own file")?;
    let bytes = std::fs::read(&path).with_context(|| format!("cannot read {}", path.display()))?;
    Ok(format!("{} {}", env!("CARGO_PKG_VERSION"), hash(&[&bytes])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_read_with_its_units() {
        let n: NoiseSpec = "1.5mm, 0.2deg".parse().expect("noise");
        assert!((n.metres - 0.0015).abs() < 1e-12 && n.degrees == 0.2);
        for bad in [
            "1,0.2",
            "1mm",
            "1mm,0.2",
            "xmm,1deg",
            "-1mm,1deg",
            "nanmm,1deg",
            "1mm,90deg",
        ] {
            assert!(bad.parse::<NoiseSpec>().is_err(), "{bad}");
        }
    }

    #[test]
    fn hashes_tell_parts_apart() {
        assert_ne!(hash(&[b"ab", b"c"]), hash(&[b"a", b"bc"]));
        assert_ne!(hash(&[b"a\0"]), hash(&[b"a"]));
        assert_eq!(hash(&[b"abc"]), hash(&[b"abc"]));
    }
}
