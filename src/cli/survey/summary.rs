//! `--summary`: one page about all surveys of a folder, made from their files alone.

use super::file::{self, Survey};
use crate::output::write;
use anyhow::{Context, Result};
use serde_json::{Map, Value};
use sinew_evaluate::survey::stats::median;
use sinew_evaluate::survey::tables::SurveyTable;
use sinew_evaluate::survey::{MeasuredClip, SurveyOutcome, TrackingErrors};
use sinew_physics::rehearsal::follow::FollowWay;
use sinew_physics::rehearsal::result::LOST;
use std::path::Path;

/// The page, in the folder.
const PAGE: &str = "README.md";
/// The survey whose settings the others are compared with.
const USUAL: &str = "strict";
/// The survey whose clips are listed, because it says how each of them is kept.
const LISTED: &str = "assisted";

/// A survey of the folder.
struct NamedSurvey {
    /// File name without its extension.
    name: String,
    survey: Survey,
}

impl NamedSurvey {
    /// The clips that could be read, with their names.
    fn clips(&self) -> impl Iterator<Item = (&str, &MeasuredClip)> {
        let rows = self.survey.rows.iter();
        rows.filter_map(|r| Some((r.clip.as_str(), r.result.as_ref()?)))
    }
}

/// Writes the page of `folder` from all surveys in it.
///
/// # Errors
/// A file that cannot be read or is no survey; a page that cannot be written.
pub(super) fn write_page(folder: &Path) -> Result<()> {
    write(&folder.join(PAGE), page(&read(folder)?))
}

/// The surveys of a folder by name.
fn read(folder: &Path) -> Result<Vec<NamedSurvey>> {
    let cannot = || format!("cannot read {}", folder.display());
    let mut all = Vec::new();
    for entry in std::fs::read_dir(folder).with_context(cannot)? {
        let path = entry.with_context(cannot)?.path();
        if path.extension().is_some_and(|e| e == "json") {
            let stem = path.file_stem().unwrap_or_default();
            all.push(NamedSurvey {
                name: stem.to_string_lossy().into_owned(),
                survey: file::read(&path)?,
            });
        }
    }
    all.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(all)
}

fn page(all: &[NamedSurvey]) -> String {
    let mut out = "# Surveys\n\nWritten by `sinew survey … --summary` from the surveys in this folder; \
        `tests/survey.sh --store NAME` makes one again.\n[survey.md](../survey.md) defines the columns. Errors are \
        medians against the recordings.\n\n"
        .to_owned();
    out += &surveys(all).markdown();
    let helped = with_help(all);
    if !helped.rows.is_empty() {
        out += &format!(
            "\n## With help against alone\n\nKept runs (clips and their noisy copies) alone and with help. Of \
             those that alone stay within {:.1} m of the recording, *safely*, and of the others: lost at 30 % + at \
             100 % / all. Help is the median within the recording.\n\n{}",
            LOST - SPARE,
            helped.markdown()
        );
    }
    if let Some(listed) = all.iter().find(|s| s.name == LISTED) {
        out += &format!(
            "\n## Clips\n\nHow the survey *{LISTED}* keeps the clips that tracking alone does not, and with how much \
             help.\n\n{}",
            kept(listed).markdown()
        );
    }
    out
}

/// Distance from losing with which a run is kept safely, m.
const SPARE: f64 = 0.1;

/// The settings that say that clips are helped, and rehearsed.
const FOLLOW: &str = "follow";
const REHEARSED: &str = "rehearsed";

/// Settings of help: surveys that differ in no others have the same runs, with and without help.
const HELP: [&str; 5] = [FOLLOW, "max_help", "keep_runs", REHEARSED, "seed"];

/// The setting of streams.
const WINDOW: &str = "live_window_s";

/// The largest distances of all runs, m, with `None` for those that are lost, by clip.
type Distances<'a> = Vec<(&'a str, Vec<Option<f64>>)>;

impl NamedSurvey {
    fn is_helped(&self) -> bool {
        self.survey.settings.contains_key(FOLLOW)
    }

    /// Its settings but those of help.
    fn without_help(&self) -> Map<String, Value> {
        let mut out = self.survey.settings.clone();
        out.retain(|name, _| !HELP.contains(&name.as_str()));
        out
    }

    /// Whether it streams under conditions other than the usual ones, which *With help against alone* is about.
    fn is_condition(&self, usual: &Map<String, Value>) -> bool {
        let own = self.without_help();
        let differs = |name: &&str| usual.get(*name) != own.get(*name);
        let names = own.keys().map(String::as_str);
        !usual.is_empty() && differs(&WINDOW) && names.filter(|n| *n != WINDOW).any(|n| differs(&n))
    }

    fn distances(&self) -> Distances<'_> {
        let of = |m: &MeasuredClip| {
            let own = m.outcome.farthest_m.filter(|_| m.outcome.completed);
            let copies = m.copies.iter().flat_map(|c| c.farthest_m.iter().copied());
            std::iter::once(own).chain(copies).collect()
        };
        self.clips().map(|(name, m)| (name, of(m))).collect()
    }
}

/// Runs alone, and the same runs with help.
#[derive(Default)]
struct HelpAgainstAlone {
    /// Safely kept alone, and of these lost with help.
    safely: [usize; 2],
    /// Kept less safely alone, and of these lost with help.
    barely: [usize; 2],
    /// Kept with help.
    kept: usize,
}

impl HelpAgainstAlone {
    fn new(alone: &NamedSurvey, helped: &NamedSurvey) -> Self {
        let mut out = Self::default();
        let helped = helped.distances();
        for (name, before) in alone.distances() {
            let Some((_, after)) = helped.iter().find(|(n, _)| *n == name) else {
                continue;
            };
            for (before, after) in before.iter().zip(after) {
                out.kept += usize::from(after.is_some());
                let counted = match before {
                    Some(d) if *d <= LOST - SPARE => &mut out.safely,
                    Some(_) => &mut out.barely,
                    None => continue,
                };
                counted[0] += 1;
                counted[1] += usize::from(after.is_none());
            }
        }
        out
    }
}

/// One row per survey of which there is one with help of up to 30 % and one of up to 100 % of the weight.
fn with_help(all: &[NamedSurvey]) -> SurveyTable {
    let row = |alone: &NamedSurvey| {
        let settings = alone.without_help();
        let helped = |follow: &str| {
            all.iter().find(|s| {
                s.survey.settings.get(FOLLOW).and_then(Value::as_str) == Some(follow)
                    && !s.survey.settings.contains_key(REHEARSED)
                    && s.without_help() == settings
                    && s.clips().map(|c| c.0).eq(alone.clips().map(|c| c.0))
            })
        };
        let both = [helped("assisted")?, helped("always")?];
        if alone.is_helped() {
            return None;
        }
        let [some, all] = both.map(|s| HelpAgainstAlone::new(alone, s));
        let help = both.map(|s| {
            let shares = s
                .clips()
                .map(|(_, m)| 100.0 * m.outcome.assist_recorded_share);
            median(&shares.collect::<Vec<_>>()).unwrap_or_default()
        });
        let lost = |of: fn(&HelpAgainstAlone) -> [usize; 2]| {
            format!("{}+{}/{}", of(&some)[1], of(&all)[1], of(&some)[0])
        };
        let runs: usize = alone.distances().iter().map(|(_, runs)| runs.len()).sum();
        Some(vec![
            alone.name.clone(),
            runs.to_string(),
            (some.safely[0] + some.barely[0]).to_string(),
            some.kept.to_string(),
            all.kept.to_string(),
            lost(|c| c.safely),
            lost(|c| c.barely),
            help.map(|h| format!("{h:.1}")).join("/"),
        ])
    };
    SurveyTable {
        head: vec![
            "survey",
            "runs",
            "kept alone",
            "at 30 %",
            "at 100 %",
            "safely kept, lost",
            "barely kept, lost",
            "help, %",
        ],
        rows: all.iter().filter_map(row).collect(),
    }
}

/// The settings of a survey that differ from the usual ones.
fn differing(settings: &Map<String, Value>, usual: &Map<String, Value>) -> String {
    let show = |v: &Value| match v {
        Value::Array(values) => {
            let texts = values.iter().map(|v| v.as_str().unwrap_or_default());
            texts.collect::<Vec<_>>().join(", ")
        }
        Value::String(text) => text.clone(),
        other => other.to_string(),
    };
    let parts: Vec<String> = (settings.iter())
        .filter(|(name, value)| usual.get(*name) != Some(value))
        .map(|(name, value)| format!("`{name}` {}", show(value)))
        .collect();
    parts.join(", ")
}

/// One row per survey.
fn surveys(all: &[NamedSurvey]) -> SurveyTable {
    let none = Map::new();
    let usual = all.iter().find(|s| s.name == USUAL);
    let usual = usual.map_or(&none, |s| &s.survey.settings);
    let row = |s: &NamedSurvey| {
        let of = |yes: &dyn Fn(&MeasuredClip) -> bool| {
            s.clips().filter(|(_, m)| yes(m)).count().to_string()
        };
        let middle = |value: &dyn Fn(&TrackingErrors) -> f64, decimals: usize| {
            let errors = s.clips().filter_map(|(_, m)| m.outcome.to_recorded());
            let values: Vec<f64> = errors.map(value).collect();
            median(&values).map_or("–".to_owned(), |m| format!("{m:.decimals$}"))
        };
        let help = |value: &dyn Fn(&SurveyOutcome) -> f64| {
            let shares: Vec<f64> = s.clips().map(|(_, m)| 100.0 * value(&m.outcome)).collect();
            median(&shares).map_or("–".to_owned(), |m| format!("{m:.1}"))
        };
        let copies = s.clips().filter_map(|(_, m)| m.copies.as_ref());
        let (kept, run) = copies.fold((0, 0), |(kept, run), c| (kept + c.completed, run + c.count));
        vec![
            s.name.clone(),
            differing(&s.survey.settings, usual),
            s.clips().count().to_string(),
            of(&|m| m.outcome.completed),
            if run == 0 {
                "–".to_owned()
            } else {
                format!("{kept} of {run}")
            },
            of(&|m| m.outcome.anchor_lost_at_s.is_none() && m.outcome.frozen_at_s.is_none()),
            of(&|m| m.outcome.fell_at_s.is_none()),
            of(&|m| m.outcome.down_after),
            middle(&|e| e.mpjpe_root_mm, 0),
            middle(&|e| e.mpjpe_global_mm, 0),
            middle(&|e| e.joint_rms_deg, 1),
            help(&|o| o.assist_recorded_share),
            help(&|o| o.assist_share),
        ]
    };
    SurveyTable {
        head: vec![
            "survey",
            "settings other than of *strict*",
            "clips",
            "kept (PHC)",
            "copies kept",
            "height/tilt kept",
            "did not fall",
            "on the floor 1 s after",
            "root-rel., mm",
            "global, mm",
            "joints, °",
            "help within the recording, %",
            "help in all, %",
        ],
        rows: all
            .iter()
            .filter(|s| !s.is_condition(usual))
            .map(row)
            .collect(),
    }
}

/// How a clip is kept by tracking alone.
const TRACKING: &str = "tracking";

/// One row per clip that tracking alone does not keep.
fn kept(survey: &NamedSurvey) -> SurveyTable {
    let row = |(name, m): (&str, &MeasuredClip)| {
        let by = match m.followed.as_ref().map(|f| f.way) {
            _ if !m.outcome.completed => "lost",
            Some(FollowWay::Lost) => "lost",
            Some(FollowWay::Rehearsed) => "rehearsal",
            Some(FollowWay::Helped) => "help",
            _ if m.outcome.assist_share > 0.0 => "help",
            Some(FollowWay::Tracked) | None => TRACKING,
        };
        vec![
            name.to_owned(),
            m.kind.name().to_owned(),
            by.to_owned(),
            format!("{:.1}", 100.0 * m.outcome.assist_recorded_share),
        ]
    };
    SurveyTable {
        head: vec![
            "clip",
            "kind",
            "kept by",
            "help within the recording, % of weight × time",
        ],
        rows: survey
            .clips()
            .map(row)
            .filter(|cells| cells[2] != TRACKING)
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_page_is_that_of_the_stored_surveys() {
        let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/survey"));
        let all = read(folder).unwrap();
        assert!(all.iter().any(|s| s.name == USUAL) && all.iter().any(|s| s.name == LISTED));
        assert!(
            std::fs::read_to_string(folder.join(PAGE)).unwrap() == page(&all),
            "tests/survey.sh --store writes docs/survey/{PAGE}"
        );
    }

    #[test]
    fn runs_that_help_loses_are_counted_by_how_safely_they_were_kept_alone() {
        let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/survey"));
        let mut all = read(folder).unwrap();
        let at = |all: &[NamedSurvey], name: &str| all.iter().position(|s| s.name == name).unwrap();
        let row = |all: &[NamedSurvey]| {
            let rows = with_help(all).rows;
            rows.into_iter().find(|r| r[0] == "live").unwrap()
        };
        let (alone, helped) = (at(&all, "live"), at(&all, "live-30"));
        let before = row(&all);
        let kept: Vec<usize> = (0..before[1].parse().unwrap())
            .filter(|k| all[alone].distances()[*k].1[0].is_some_and(|d| d < LOST - SPARE))
            .take(2)
            .collect();
        let lose = |s: &mut NamedSurvey, k: usize| {
            s.survey.rows[k].result.as_mut().unwrap().outcome.completed = false;
        };
        for k in &kept {
            lose(&mut all[helped], *k);
        }
        let barely = all[alone].survey.rows[kept[1]].result.as_mut().unwrap();
        barely.outcome.farthest_m = Some(LOST - 0.5 * SPARE);
        let after = row(&all);
        let number = |cell: &str| cell.parse::<usize>().unwrap();
        assert_eq!(number(&after[3]), number(&before[3]) - 2);
        assert_eq!([&after[2], &after[4]], [&before[2], &before[4]]);
        let of = |cell: &str| number(cell.rsplit('/').next().unwrap());
        let (safely, barely) = (of(&before[5]) - 1, of(&before[6]) + 1);
        assert_eq!(after[5], format!("1+0/{safely}"));
        assert_eq!(after[6], format!("1+0/{barely}"));
    }

    #[test]
    fn settings_are_shown_where_they_differ() {
        let map = |v: Value| v.as_object().unwrap().clone();
        let usual = map(json!({ "loads": [], "copies": 0, "strength": 1.0 }));
        let new = map(
            json!({ "loads": ["10@r_hand"], "copies": 20, "strength": 1.0, "follow": "assisted" }),
        );
        assert_eq!(
            differing(&new, &usual),
            "`copies` 20, `follow` assisted, `loads` 10@r_hand"
        );
    }
}
