//! `sinew convert`: writes the prepared motion, the reference that the figure tracks.

use super::args::{BodyArgs, RecordingArgs, check_tempo};
use super::number::{counted, hertz};
use super::output::{check_folder, extension, write};
use super::source::{LoadedClip, load, warn};
use super::terminal::print_line;
use anyhow::{Context, Result};
use serde_json::json;
use sinew_physics::body::Body;
use sinew_physics::body::angles::anatomical_angles;
use sinew_physics::body::topology::DOF_NAMES;
use sinew_physics::motion::table::{header, row};
use sinew_physics::motion::write_bvh;
use sinew_physics::reference::{Preparation, RetargetOptions};
use std::path::PathBuf;

/// Fits a recording to the body and writes the prepared motion.
#[derive(Clone, Debug, clap::Args)]
pub struct ConvertArgs {
    /// Motion: a BVH file or builtin:NAME.
    #[arg(value_name = "CLIP")]
    pub clip: String,
    /// Output file: BVH on the skeleton of the figure, CSV, or JSON with the retargeting report.
    #[arg(value_name = "FILE.bvh|.csv|.json")]
    pub to: PathBuf,
    /// Body that the motion is fitted to.
    #[command(flatten)]
    pub body: BodyArgs,
    /// How the file is read.
    #[command(flatten)]
    pub recording: RecordingArgs,
    /// Leaves foot skate as recorded.
    #[arg(long)]
    pub no_foot_lock: bool,
}

/// Runs the command.
///
/// # Errors
/// Bad names, unreadable or malformed files, skeletons that cannot be mapped.
pub fn run(args: &ConvertArgs) -> Result<()> {
    let format = extension("convert", &args.to, &["bvh", "csv", "json"])?;
    check_folder("convert", Some(&args.to))?;
    check_tempo(args.recording.tempo)?;
    let body = args.body.build()?;
    let ordinary = args.recording.options();
    let options = RetargetOptions {
        preparation: Preparation {
            lock_feet: !args.no_foot_lock,
            ..ordinary.preparation
        },
        ..ordinary
    };
    let source = load(&args.clip, &body, &options)?;
    let text = match format {
        "bvh" => as_bvh(&source, &body),
        "csv" => as_csv(&source),
        _ => as_json(&source)?,
    };
    write(&args.to, text)?;
    warn(&source);
    print_line(&format!(
        "{}: {} at {}, written to {}",
        source.name,
        counted(source.clip.len(), "sample"),
        hertz(source.clip.rate_hz()),
        args.to.display()
    ))
}

fn as_bvh(source: &LoadedClip, body: &Body) -> String {
    let clip = &source.clip;
    let postures: Vec<_> = (0..clip.len()).map(|i| *clip.posture(i)).collect();
    write_bvh(body, &postures, clip.rate_hz())
}

fn as_csv(source: &LoadedClip) -> String {
    let clip = &source.clip;
    let mut out = header(false);
    for i in 0..clip.len() {
        row(&mut out, i as f64 / clip.rate_hz(), clip.posture(i), None);
    }
    out
}

fn as_json(source: &LoadedClip) -> Result<String> {
    let clip = &source.clip;
    let samples: Vec<_> = (0..clip.len())
        .map(|i| {
            let p = clip.posture(i);
            json!({
                "root_position_m": p.root_position.to_array(),
                "root_rotation_xyzw": p.root_rotation.to_xyzw(),
                "angles_rad": anatomical_angles(p).to_vec(),
                "planted": clip.planted(i),
            })
        })
        .collect();
    let document = json!({
        "clip": source.name,
        "rate_hz": clip.rate_hz(),
        "dofs": DOF_NAMES.to_vec(),
        "samples": samples,
        "retarget": source.retarget.as_ref().map_or(serde_json::Value::Null, super::lint::to_json),
    });
    serde_json::to_string(&document).context("the motion cannot be written as JSON")
}
