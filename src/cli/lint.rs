//! `sinew lint`: reports the findings, estimates and changes of retargeting for a recording.

use super::args::{BodyArgs, RecordingArgs, check_tempo};
use super::number::{counted, fixed, hertz, metres, rounded, seconds};
use super::source::{LoadedClip, load};
use super::terminal::{print, print_line};
use anyhow::{Context, Result};
use serde_json::{Value, json};
use sinew_physics::body::Body;
use sinew_physics::plan::ReadingReport;
use sinew_physics::plan::feasibility::{Consistency, Spread, consistency};
use sinew_physics::plan::prepare::Compared;
use sinew_physics::reference::{Preparation, RetargetOptions, UpAxis};
use std::fmt::Write;

/// Reads recordings and reports how they fit the body.
#[derive(Clone, Debug, clap::Args)]
pub struct LintArgs {
    /// Motions: BVH files or builtin:NAME.
    #[arg(required = true, value_name = "CLIP")]
    pub clips: Vec<String>,
    /// Body that the motion is fitted to.
    #[command(flatten)]
    pub body: BodyArgs,
    /// How the file is read.
    #[command(flatten)]
    pub recording: RecordingArgs,
    /// Prints JSON on standard output, and nothing else there.
    #[arg(long)]
    pub json: bool,
}

/// Runs the command.
///
/// # Errors
/// Unreadable or malformed files, and skeletons that cannot be mapped.
pub fn run(args: &LintArgs) -> Result<()> {
    check_tempo(args.recording.tempo)?;
    let body = args.body.build()?;
    let options = args.recording.options();
    let mut all = Vec::new();
    for spec in &args.clips {
        let source = load(spec, &body, &options)?;
        let clip = &source.clip;
        let (before, after) = consistencies(&source, &body, &options)?;
        if args.json {
            all.push(json!({
                "consistency": {
                    "recorded": before.as_ref().map_or(Value::Null, consistency_json),
                    "prepared": consistency_json(&after),
                },
                "clip": source.name,
                "duration_s": clip.duration(),
                "rate_hz": clip.rate_hz(),
                "samples": clip.len(),
                "retarget": source.retarget.as_ref().map_or(Value::Null, to_json),
            }));
        } else {
            let mut text = format!(
                "{}: {}, {} at {}\n",
                source.name,
                seconds(clip.duration()),
                counted(clip.len(), "sample"),
                hertz(clip.rate_hz())
            );
            text += &match &source.retarget {
                Some(report) => describe(report),
                None => "  built in: generated for the body, nothing to retarget\n".into(),
            };
            if let Some(before) = &before {
                text += &describe_consistency("as recorded", before);
            }
            text += &describe_consistency("as prepared", &after);
            print(&text)?;
        }
    }
    if args.json {
        let text = match all.as_slice() {
            [one] => serde_json::to_string_pretty(one),
            several => serde_json::to_string_pretty(several),
        };
        print_line(&text.context("the report cannot be written as JSON")?)?;
    }
    Ok(())
}

/// How far the motion is from one that a body on its feet can do: as recorded (bones on the body, nothing else; `None`
/// for built-in motions) and as prepared, on the same feet.
fn consistencies(
    source: &LoadedClip,
    body: &Body,
    options: &RetargetOptions,
) -> Result<(Option<Consistency>, Consistency)> {
    let clip = &source.clip;
    let rate = clip.rate_hz();
    let postures: Vec<_> = (0..clip.len()).map(|i| *clip.posture(i)).collect();
    let Some(report) = &source.retarget else {
        let label: Vec<_> = (0..clip.len()).map(|i| clip.planted(i)).collect();
        return Ok((None, consistency(body, &postures, &label, rate)));
    };
    let at = |i: usize| {
        let t = (i as f64 + 0.5) / rate;
        let phase = report.feet.phases.iter().find(|p| t < p.end);
        phase.map_or([false; 2], |p| p.planted)
    };
    let label: Vec<_> = (0..clip.len()).map(at).collect();
    let bare = RetargetOptions {
        preparation: Preparation {
            lock_feet: false,
            balance: false,
            ends: false,
            ..options.preparation
        },
        ..options.clone()
    };
    let recorded = load(&source.spec, body, &bare)?.clip;
    let raw: Vec<_> = (0..recorded.len()).map(|i| *recorded.posture(i)).collect();
    Ok((
        Some(consistency(body, &raw, &label, rate)),
        consistency(body, &postures, &label, rate),
    ))
}

/// Measures of consistency as JSON: lengths in mm, forces in shares of the weight, moments in weight × m.
fn consistency_json(c: &Consistency) -> Value {
    let spread = |s: &Spread, unit: f64| json!({ "rms": unit * s.rms, "max": unit * s.max });
    json!({
        "zmp_outside_share": c.outside,
        "zmp_outside_mm": spread(&c.distance, 1e3),
        "residual_force_weights": spread(&c.force, 1.0),
        "residual_moment_weight_m": spread(&c.moment, 1.0),
        "flight_share": c.flight,
        "carried_share": c.carried,
        "stances": c.stances,
        "slip_per_stance_mm": { "mean": 1e3 * c.slip.0, "max": 1e3 * c.slip.1 },
        "floor_mm": { "deepest": 1e3 * c.floor.0, "highest": 1e3 * c.floor.1 },
    })
}

/// Measures of consistency in words, four lines.
fn describe_consistency(name: &str, c: &Consistency) -> String {
    let other_support = if c.carried > 0.0 {
        format!(
            ", {:.0} % supported by other body parts than the feet (not judged)",
            100.0 * c.carried
        )
    } else {
        String::new()
    };
    let lines = [
        format!(
            "zero-moment point outside the support polygon {:.0} % of the time, distance {:.0} mm rms, {:.0} mm max",
            100.0 * c.outside,
            1e3 * c.distance.rms,
            1e3 * c.distance.max
        ),
        format!(
            "residual wrench that the ground cannot provide: force {:.3} body weights rms, {:.2} max; moment {:.3} \
             body weights × m rms, {:.2} max",
            c.force.rms, c.force.max, c.moment.rms, c.moment.max
        ),
        format!(
            "flight {:.0} %{other_support}; {} stances, foot skate {:.1} mm mean, {:.1} mm max",
            100.0 * c.flight,
            c.stances,
            1e3 * c.slip.0,
            1e3 * c.slip.1
        ),
        format!(
            "soles up to {:.1} mm below the floor and {:.1} mm above it",
            1e3 * c.floor.0,
            1e3 * c.floor.1
        ),
    ];
    let mut out = String::new();
    for (i, line) in lines.iter().enumerate() {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "  {:<14} {line}", if i == 0 { name } else { "" });
    }
    out
}

/// The report as JSON: errors in mm, other lengths in m, angles in degrees.
pub fn to_json(r: &ReadingReport) -> Value {
    serde_json::to_value(r).expect("the names of a report are text")
}

fn up_name(up: UpAxis) -> &'static str {
    match up {
        UpAxis::Y => "y",
        UpAxis::Z => "z",
    }
}

/// The report in words, one finding per line.
pub fn describe(r: &ReadingReport) -> String {
    let lines = reading(r)
        .into_iter()
        .chain(preparation(r))
        .chain(oddities(r));
    let mut out = String::new();
    for (name, text) in lines {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "  {name:<14} {text}");
    }
    out
}

/// A name and the text that belongs to it.
type LintLine = (&'static str, String);

/// How the file was understood.
fn reading(r: &ReadingReport) -> Vec<LintLine> {
    let bones: usize = r.skeleton.mapped.iter().map(|m| m.bones.len()).sum();
    let how = if r.skeleton.by_structure {
        "by structure"
    } else {
        "by name"
    };
    let swapped = if r.skeleton.sides_swapped {
        ", left and right swapped"
    } else {
        ""
    };
    let mut lines = vec![(
        "skeleton",
        format!(
            "{} mapped {how} to {}{swapped}",
            counted(bones, "bone"),
            counted(r.skeleton.mapped.len(), "segment")
        ),
    )];
    if !r.skeleton.missing.is_empty() {
        lines.push(("missing", r.skeleton.missing.join(", ")));
    }
    let given = if r.size.unit_given {
        "given"
    } else {
        "estimated"
    };
    lines.push((
        "size",
        format!(
            "1 file unit = {} ({given}), {} axis up, stature {:.2} m, scaled by {:.3}",
            metres(r.size.unit_m),
            up_name(r.size.up),
            r.size.stature,
            r.size.scale
        ),
    ));
    lines.push((
        "rate",
        format!(
            "recorded at {}, resampled to {}, {} skipped",
            hertz(r.frames.source_rate_hz),
            hertz(r.frames.rate_hz),
            counted(r.frames.skipped_frames, "frame")
        ),
    ));
    lines.push((
        "floor",
        format!(
            "height {} mm, slope {}",
            fixed(1e3 * r.place.floor_offset, 1),
            rounded(r.place.floor_slope, 2)
        ),
    ));
    let phases: Vec<String> = r
        .feet
        .phases
        .iter()
        .map(|p| format!("{} {:.2}-{:.2}", p.letter(), p.start, p.end))
        .collect();
    let legend = "L left foot, R right foot, D both feet, - flight";
    lines.push(("support, s", format!("{} ({legend})", phases.join("; "))));
    lines
}

/// Condition of the recording, and how far the preparation changed it.
fn preparation(r: &ReadingReport) -> Vec<LintLine> {
    let before_after = |c: Compared<f64>| {
        format!(
            "{:.1} mm recorded, {:.1} mm prepared",
            1e3 * c.recorded,
            1e3 * c.prepared
        )
    };
    let Compared {
        recorded: z0,
        prepared: z1,
    } = &r.balance.zmp_outside;
    let pair = |v: [f64; 2]| format!("{:.1}° and {:.1}°", v[0].to_degrees(), v[1].to_degrees());
    vec![
        ("foot skate", before_after(r.feet.slide)),
        ("penetration", before_after(r.feet.penetration)),
        (
            "balance",
            format!(
                "zero-moment point outside the support polygon: {:.0} % of the clip recorded (95th percentile {:.0} \
                 mm), {:.0} % prepared ({:.0} mm)",
                100.0 * z0.fraction,
                1e3 * z0.p95,
                100.0 * z1.fraction,
                1e3 * z1.p95
            ),
        ),
        (
            "changed",
            format!(
                "smoothing {:.1} mm rms, pelvis shifted by up to {:.0} mm and lowered by up to {:.0} mm",
                1e3 * r.frames.smoothing_rms,
                1e3 * r.pelvis.shift,
                1e3 * r.pelvis.drop
            ),
        ),
        (
            "off axis",
            format!(
                "knees {}, elbows {}",
                pair(r.joints.knee_off_axis),
                pair(r.joints.elbow_off_axis)
            ),
        ),
    ]
}

/// Irregularities.
fn oddities(r: &ReadingReport) -> Vec<LintLine> {
    let mut lines = Vec::new();
    for c in &r.clamped {
        lines.push((
            "clamped",
            format!(
                "{} by up to {:.1}° over {:.1} % of the clip",
                c.dof,
                c.max.to_degrees(),
                100.0 * c.fraction
            ),
        ));
    }
    for b in &r.frames.bridged {
        lines.push((
            "bridged",
            format!(
                "{}: {} interpolated from frame {}",
                b.bone,
                counted(b.count, "frame"),
                b.first
            ),
        ));
    }
    if r.balance.carried > 0.0 {
        lines.push((
            "other support",
            format!(
                "{:.0} % of the clip is supported by other body parts than the feet",
                100.0 * r.balance.carried
            ),
        ));
    }
    lines.extend(r.warnings.iter().map(|w| ("warning", w.clone())));
    lines
}
