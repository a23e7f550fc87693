//! `--summary`: one page about all stored surveys, and the few numbers of each clip from which it is made.

use super::page::{PageSpec, command};
use crate::output::write;
use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};
use sinew_evaluate::survey::stats::median;
use sinew_evaluate::survey::tables::SurveyTable;
use sinew_evaluate::survey::{MeasuredClip, MotionKind, SurveyRow};
use sinew_physics::rehearsal::follow::FollowWay;
use std::path::Path;

/// File of the numbers, in the folder.
const NUMBERS: &str = "summary.json";
/// File of the page, in the folder.
const PAGE: &str = "README.md";
/// Survey whose clips are listed, with the way in which each is kept.
const LISTED: &str = "assisted";

/// A survey in short.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct SurveyDigest {
    /// Its name.
    name: String,
    /// The command that reproduces it.
    command: String,
    /// Its clips.
    clips: Vec<ClipDigest>,
}

/// A clip in short. Numbers are rounded as tables show them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct ClipDigest {
    clip: String,
    kind: MotionKind,
    /// Whether it was never further than 0.5 m from the recording (PHC).
    completed: bool,
    /// Whether height and tilt of the pelvis were kept.
    upright: bool,
    fell: bool,
    /// Mean distance from the recording relative to the pelvis, mm.
    root_mm: Option<f64>,
    /// Mean distance from the recording in the world, mm.
    global_mm: Option<f64>,
    joints_deg: Option<f64>,
    touch_down_ms: Option<f64>,
    /// Impulse of help over weight × time, %.
    help_percent: f64,
    /// In what way the clip was followed, if rehearsals were allowed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    way: Option<FollowWay>,
    /// Copies completed, and run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    copies: Option<[usize; 2]>,
}

fn rounded(x: f64, decimals: i32) -> f64 {
    let unit = 10f64.powi(decimals);
    (x * unit).round() / unit
}

impl ClipDigest {
    fn of(name: &str, m: &MeasuredClip) -> Self {
        let o = &m.outcome;
        let errors = o.to_recorded();
        Self {
            clip: name.to_owned(),
            kind: m.kind,
            completed: o.completed,
            upright: o.anchor_lost_at_s.is_none() && o.frozen_at_s.is_none(),
            fell: o.fell_at_s.is_some(),
            root_mm: errors.map(|e| rounded(e.mpjpe_root_mm, 0)),
            global_mm: errors.map(|e| rounded(e.mpjpe_global_mm, 0)),
            joints_deg: errors.map(|e| rounded(e.joint_rms_deg, 1)),
            touch_down_ms: o.touch_downs.median_ms.map(|t| rounded(t, 0)),
            help_percent: rounded(100.0 * o.assist_share, 1),
            way: m.followed.as_ref().map(|f| f.way),
            copies: m.copies.as_ref().map(|c| [c.completed, c.count]),
        }
    }
}

/// Digests of the clips that could be read.
fn clips(rows: &[SurveyRow]) -> Vec<ClipDigest> {
    let read = rows.iter().filter_map(|r| Some((r, r.result.as_ref()?)));
    read.map(|(row, m)| ClipDigest::of(&row.clip, m)).collect()
}

/// Puts a survey under the name of `spec` into its folder, and writes the page of the folder.
///
/// # Errors
/// Files that cannot be read or written.
pub(super) fn put(
    spec: &PageSpec,
    rows: &[SurveyRow],
    arguments: impl Iterator<Item = String>,
) -> Result<()> {
    let mut all = read(&spec.file)?;
    let digest = SurveyDigest {
        name: spec.section.clone(),
        command: command(arguments),
        clips: clips(rows),
    };
    match all.iter_mut().find(|d| d.name == digest.name) {
        Some(old) => *old = digest,
        None => all.push(digest),
    }
    write(&spec.file.join(NUMBERS), numbers(&all)?)?;
    write(&spec.file.join(PAGE), page(&all))
}

/// The surveys of a folder; empty if the folder has no file of surveys.
fn read(folder: &Path) -> Result<Vec<SurveyDigest>> {
    let path = folder.join(NUMBERS);
    if !path.exists() {
        return Ok(Vec::new());
    }
    let text = std::fs::read_to_string(&path)
        .with_context(|| format!("cannot read {}", path.display()))?;
    serde_json::from_str(&text).with_context(|| format!("{} is no summary", path.display()))
}

/// All surveys as JSON, one clip per line.
fn numbers(all: &[SurveyDigest]) -> Result<String> {
    let mut surveys = Vec::new();
    for d in all {
        let mut lines = Vec::new();
        for clip in &d.clips {
            lines.push(serde_json::to_string(clip).context("a clip cannot be written as JSON")?);
        }
        surveys.push(format!(
            "{{\"name\": {}, \"command\": {}, \"clips\": [\n{}\n]}}",
            serde_json::json!(d.name),
            serde_json::json!(d.command),
            lines.join(",\n")
        ));
    }
    Ok(format!("[\n{}\n]\n", surveys.join(",\n")))
}

fn page(all: &[SurveyDigest]) -> String {
    let mut out = "# Surveys\n\nEach survey that is stored, in short. `sinew survey … --summary docs/survey#NAME` puts \
        one into\n[summary.json](summary.json) and writes this page. [survey.md](../survey.md) defines the columns; \
        errors are medians\nagainst the recordings.\n\n"
        .to_owned();
    out += &surveys(all).markdown();
    out += "\n| survey | command |\n|---|---|\n";
    for d in all {
        out += &format!("| {} | `{}` |\n", d.name, d.command);
    }
    if let Some(listed) = all.iter().find(|d| d.name == LISTED) {
        out += &format!(
            "\n## Clips\n\nHow each clip of the survey *{LISTED}* is kept, and with how much help.\n\n{}",
            kept(listed).markdown()
        );
    }
    out
}

/// One row per survey.
fn surveys(all: &[SurveyDigest]) -> SurveyTable {
    let row = |d: &SurveyDigest| {
        let of = |yes: &dyn Fn(&ClipDigest) -> bool| {
            d.clips.iter().filter(|c| yes(c)).count().to_string()
        };
        let middle = |value: &dyn Fn(&ClipDigest) -> Option<f64>, decimals: usize| {
            let values: Vec<f64> = d.clips.iter().filter_map(value).collect();
            median(&values).map_or("–".to_owned(), |m| format!("{m:.decimals$}"))
        };
        let copies = d.clips.iter().filter_map(|c| c.copies);
        let [kept, run] = copies.fold([0, 0], |[k, n], c| [k + c[0], n + c[1]]);
        let copies = if run == 0 {
            "–".to_owned()
        } else {
            format!("{kept} of {run}")
        };
        vec![
            d.name.clone(),
            d.clips.len().to_string(),
            of(&|c| c.completed),
            copies,
            of(&|c| c.upright),
            of(&|c| !c.fell),
            middle(&|c| c.root_mm, 0),
            middle(&|c| c.global_mm, 0),
            middle(&|c| c.joints_deg, 1),
            middle(&|c| c.touch_down_ms, 0),
        ]
    };
    SurveyTable {
        head: vec![
            "survey",
            "clips",
            "kept (PHC)",
            "copies kept",
            "height/tilt kept",
            "did not fall",
            "root-rel., mm",
            "global, mm",
            "joints, °",
            "touch-down, ms",
        ],
        rows: all.iter().map(row).collect(),
    }
}

/// One row per clip: how it is kept.
fn kept(survey: &SurveyDigest) -> SurveyTable {
    let row = |c: &ClipDigest| {
        let by = match c.way {
            Some(FollowWay::Rehearsed) => "rehearsal",
            Some(FollowWay::Helped) => "help",
            Some(FollowWay::Lost) => "lost",
            Some(FollowWay::Tracked) | None => "tracking",
        };
        let by = if c.completed { by } else { "lost" };
        vec![
            c.clip.clone(),
            c.kind.name().to_owned(),
            by.to_owned(),
            format!("{:.1}", c.help_percent),
        ]
    };
    SurveyTable {
        head: vec!["clip", "kind", "kept by", "help, % of weight × time"],
        rows: survey.clips.iter().map(row).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::file;
    use super::*;

    fn folder() -> &'static Path {
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/survey"))
    }

    /// `SINEW_REWRITE=1` writes the page instead.
    #[test]
    fn the_page_is_that_of_the_stored_numbers() {
        let all = read(folder()).unwrap();
        assert!(all.len() >= 7, "surveys are missing");
        let path = folder().join(PAGE);
        if std::env::var_os("SINEW_REWRITE").is_some() {
            std::fs::write(&path, page(&all)).unwrap();
            std::fs::write(folder().join(NUMBERS), numbers(&all).unwrap()).unwrap();
        }
        assert!(
            std::fs::read_to_string(path).unwrap() == page(&all),
            "SINEW_REWRITE=1 cargo test summary writes docs/survey/README.md"
        );
    }

    /// A survey whose measures are all stored as well has the same numbers there.
    #[test]
    fn the_summary_agrees_with_the_stored_surveys() {
        let all = read(folder()).unwrap();
        let stored = |name: &str| clips(&file::read(&folder().join(name)).unwrap().rows);
        for (name, mut full) in [
            ("own-corpus", stored("corpus.json")),
            ("recordings", stored("strict.json")),
        ] {
            let digest = all.iter().find(|d| d.name == name).unwrap();
            let mut short = digest.clips.clone();
            short.sort_by(|a, b| a.clip.cmp(&b.clip));
            full.sort_by(|a, b| a.clip.cmp(&b.clip));
            assert_eq!(short, full, "{name}");
        }
    }
}
