//! A survey as tables: by clip, by kind of motion, and its forecasts against the results.

use super::stats::median;
use super::{MeasuredClip, MotionKind, SurveyRow, TrackingErrors};
use sinew_physics::forecast::ForecastVerdict;

/// Heads and rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurveyTable {
    /// Heads of the columns.
    pub head: Vec<&'static str>,
    /// Cells, row by row.
    pub rows: Vec<Vec<String>>,
}

impl SurveyTable {
    /// In the form of Markdown.
    pub fn markdown(&self) -> String {
        let cell = |c: &str| c.replace('|', "\\|").replace('\n', " ");
        let mut out = format!(
            "| {} |\n|{}\n",
            self.head.join(" | "),
            "---|".repeat(self.head.len())
        );
        for row in &self.rows {
            let cells: Vec<String> = row.iter().map(|c| cell(c)).collect();
            out += &format!("| {} |\n", cells.join(" | "));
        }
        out
    }

    /// Without the columns that have one of these heads.
    pub fn without(&self, heads: &[&str]) -> Self {
        let stays = |k: &usize| !heads.contains(&self.head[*k]);
        let columns: Vec<usize> = (0..self.head.len()).filter(stays).collect();
        let cell = |row: &Vec<String>, k: usize| row.get(k).cloned().unwrap_or_default();
        Self {
            head: columns.iter().map(|k| self.head[*k]).collect(),
            rows: (self.rows.iter())
                .map(|row| columns.iter().map(|k| cell(row, *k)).collect())
                .collect(),
        }
    }

    /// Columns of equal width, numbers to the right.
    pub fn text(&self) -> String {
        let width = |k: usize| {
            let cells = self.rows.iter().filter_map(|r| r.get(k));
            let widest = cells.map(|c| c.chars().count()).max().unwrap_or(0);
            widest.max(self.head[k].chars().count())
        };
        let widths: Vec<usize> = (0..self.head.len()).map(width).collect();
        let is_number =
            |c: &str| c.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '−');
        let mut out = String::new();
        let mut line = |cells: &mut dyn Iterator<Item = &str>| {
            let mut text = String::new();
            for (k, (cell, width)) in cells.zip(&widths).enumerate() {
                let space = " ".repeat(width - cell.chars().count());
                let right = k > 0 && is_number(cell);
                text += &if right {
                    format!("{space}{cell}  ")
                } else {
                    format!("{cell}{space}  ")
                };
            }
            out += text.trim_end();
            out.push('\n');
        };
        line(&mut self.head.iter().copied());
        for row in &self.rows {
            line(&mut row.iter().map(String::as_str));
        }
        out
    }
}

const NONE: &str = "–";

fn digits(x: Option<f64>, digits: usize) -> String {
    x.map_or_else(|| NONE.to_owned(), |x| format!("{x:.digits$}"))
}

fn at(t: Option<f64>) -> String {
    t.map_or_else(|| NONE.to_owned(), |t| format!("{t:.2}"))
}

/// `38/76` for two numbers, `–` for missing ones.
fn pair(a: Option<f64>, b: Option<f64>, decimals: usize) -> String {
    match (a, b) {
        (None, None) => NONE.to_owned(),
        (a, b) => format!("{}/{}", digits(a, decimals), digits(b, decimals)),
    }
}

/// One row per clip: verdicts, errors, contacts.
pub fn by_clip(rows: &[SurveyRow]) -> SurveyTable {
    let copies = rows
        .iter()
        .any(|r| r.result.as_ref().is_some_and(|m| m.copies.is_some()));
    let mut head = vec![
        "clip",
        "kind",
        "s",
        "completed (PHC)",
        "fell at, s",
        "height/tilt lost at, s",
        "to recording: root-rel./global, mm",
        "joints to recording, °",
        "to prepared: root-rel./global, mm",
        "joints to prepared, °",
        "touch-down median/worst, ms",
        "missed/added",
        "precision/recall",
        "skate median/worst, mm",
        "target jump, m/s",
        "depth, mm",
        "F_z, weights",
        "jerk ratio",
        "assist, %",
        "within the recording, %",
        "at limit, s",
    ];
    if copies {
        head.insert(4, "copies completed");
    }
    let followed = (rows.iter().filter_map(|r| r.result.as_ref())).any(|m| m.followed.is_some());
    if followed {
        head.insert(3, "way");
    }
    let mut out = SurveyTable {
        head,
        rows: Vec::new(),
    };
    for row in rows {
        let Some(m) = &row.result else {
            let error = row.error.clone().unwrap_or_default();
            let mut cells = vec![row.clip.clone(), format!("cannot be read: {error}")];
            cells.resize(out.head.len(), String::new());
            out.rows.push(cells);
            continue;
        };
        let o = &m.outcome;
        let completed = match o.lost_at_s {
            None if o.completed && o.down_after => "yes, on the floor 1 s after".to_owned(),
            None if o.completed => "yes".to_owned(),
            lost => format!("lost {}", at(lost.or(o.frozen_at_s))),
        };
        let limit = if o.limit_dof.is_empty() {
            NONE.to_owned()
        } else {
            format!("{:.1} ({} {:.1})", o.limit_s, o.limit_dof, o.limit_dof_s)
        };
        let walked = if m.walked { ", walked" } else { "" };
        let e = [o.to_recorded(), o.to_prepared()];
        let mm = |k: usize| {
            let of = |f: fn(&TrackingErrors) -> f64| e[k].map(f);
            pair(of(|e| e.mpjpe_root_mm), of(|e| e.mpjpe_global_mm), 0)
        };
        let joints = |k: usize| digits(e[k].map(|e| e.joint_rms_deg), 1);
        let t = &o.touch_downs;
        let mut cells = vec![
            row.clip.clone(),
            format!("{}{walked}", m.kind.name()),
            digits(Some(m.clip_s), 1),
            completed,
            at(o.fell_at_s),
            at(o.anchor_lost_at_s),
            mm(0),
            joints(0),
            mm(1),
            joints(1),
            pair(t.median_ms, t.worst_ms, 0),
            format!("{}/{} of {}", t.missed, t.added, t.recorded),
            pair(o.contact_precision, o.contact_recall, 2),
            pair(o.skate_median_mm, o.skate_worst_mm, 1),
            digits(o.target_jump_m_s, 2),
            digits(Some(o.penetration_mm), 1),
            digits(Some(o.peak_force_weights), 1),
            digits(o.jerk_ratio, 1),
            digits(Some(100.0 * o.assist_share), 1),
            digits(Some(100.0 * o.assist_recorded_share), 1),
            limit,
        ];
        if copies {
            let text = m.copies.as_ref().map_or(NONE.to_owned(), |c| {
                let [low, high] = c.completed_share;
                format!(
                    "{} of {} ({:.0}–{:.0} %)",
                    c.completed,
                    c.count,
                    100.0 * low,
                    100.0 * high
                )
            });
            cells.insert(4, text);
        }
        if followed {
            let way = m.followed.as_ref().map(|f| f.way.name());
            cells.insert(3, way.unwrap_or(NONE).to_owned());
        }
        out.rows.push(cells);
    }
    out
}

/// One row per clip for which every way of following was allowed: the way, its cost, and the reason.
pub fn ways(rows: &[SurveyRow]) -> SurveyTable {
    let mut out = SurveyTable {
        head: vec![
            "clip",
            "way",
            "rehearsed: root-rel./global, mm",
            "help, N·s",
            "help, % of weight × time",
            "most, N/N·m",
            "windows helped, %",
            "hardest joint, % of strength",
            "rounds",
            "ticks for each of the clip",
            "because",
        ],
        rows: Vec::new(),
    };
    let known = rows
        .iter()
        .filter_map(|r| Some((r, r.result.as_ref()?.followed.as_ref()?)));
    for (row, followed) in known {
        let mut cells = vec![row.clip.clone(), followed.way.name().to_owned()];
        match &followed.rehearsal {
            Some(r) => {
                cells.extend([
                    pair(Some(r.root_relative_mm), Some(r.global_mm), 0),
                    digits(Some(r.help_ns), 1),
                    digits(Some(100.0 * r.help_share), 1),
                    pair(Some(r.help_most_n), Some(r.help_most_nm), 0),
                    digits(Some(100.0 * r.helped_windows), 0),
                    format!("{} {:.0}", r.hardest_dof, 100.0 * r.hardest_share),
                    r.rounds.to_string(),
                    r.samples_per_tick().to_string(),
                ]);
            }
            None => cells.extend(std::iter::repeat_n(NONE.to_owned(), 8)),
        }
        cells.push(followed.reason.clone());
        out.rows.push(cells);
    }
    out
}

/// One row per clip: the facts known before it was run.
pub fn difficulties(rows: &[SurveyRow]) -> SurveyTable {
    let mut out = SurveyTable {
        head: vec![
            "clip",
            "forecast",
            "demand",
            "came of it (as prepared)",
            "floor lacks rms/peak, weights",
            "moment rms/peak, weight·m",
            "strength of what carries: peak/95 %",
            "of any joint: peak/95 %",
            "flight/longest, s",
            "floor, s",
            "inverted, s",
            "prepared off, mm",
            "because",
        ],
        rows: Vec::new(),
    };
    for row in rows {
        let Some(m) = &row.result else { continue };
        let d = &m.forecast.difficulty;
        out.rows.push(vec![
            row.clip.clone(),
            m.forecast.verdict.name().to_owned(),
            digits(Some(m.forecast.demand), 2),
            outcome_word(m),
            pair(Some(d.lacking_force_rms), Some(d.lacking_force_peak), 2),
            pair(Some(d.lacking_moment_rms), Some(d.lacking_moment_peak), 2),
            pair(Some(d.support_peak), Some(d.support_p95), 2),
            pair(Some(d.torque_peak), Some(d.torque_p95), 1),
            pair(Some(d.flight_s), Some(d.longest_flight_s), 2),
            digits(Some(d.floor_s), 1),
            digits(Some(d.inverted_s), 1),
            digits(Some(1e3 * m.prepared_off_m), 0),
            m.forecast.reason.clone(),
        ]);
    }
    out
}

fn outcome_word(m: &MeasuredClip) -> String {
    let o = &m.outcome;
    match o.prepared_lost_at_s.or(o.frozen_at_s) {
        None => "followed".to_owned(),
        lost => format!("lost {}", at(lost)),
    }
}

/// One row per kind of motion, and one for all.
pub fn by_kind(rows: &[SurveyRow]) -> SurveyTable {
    let mut out = SurveyTable {
        head: vec![
            "kind",
            "clips",
            "completed (PHC)",
            "height/tilt kept",
            "did not fall",
            "root-rel. to recording, mm",
            "global to recording, mm",
            "joints to recording, °",
            "joints to prepared, °",
            "touch-down, ms",
            "recall",
            "skate worst, mm",
            "at limit, s",
        ],
        rows: Vec::new(),
    };
    let measured: Vec<&MeasuredClip> = rows.iter().filter_map(|r| r.result.as_ref()).collect();
    let copied = measured.iter().any(|m| m.copies.is_some());
    if copied {
        out.head.insert(3, "copies completed");
    }
    let mut add = |name: &str, of: &[&MeasuredClip]| {
        let count = |yes: &dyn Fn(&MeasuredClip) -> bool| {
            let k = of.iter().filter(|m| yes(m)).count();
            format!("{k} of {}", of.len())
        };
        // Medians over the followed part; errors of a lost clip are those until it was lost.
        let middle = |value: &dyn Fn(&MeasuredClip) -> Option<f64>, decimals: usize| {
            let values: Vec<f64> = of.iter().filter_map(|m| value(m)).collect();
            digits(median(&values), decimals)
        };
        let mut row = vec![
            name.to_owned(),
            of.len().to_string(),
            count(&|m| m.outcome.completed),
            count(&|m| m.outcome.anchor_lost_at_s.is_none() && m.outcome.frozen_at_s.is_none()),
            count(&|m| m.outcome.fell_at_s.is_none()),
            middle(&|m| m.outcome.to_recorded().map(|e| e.mpjpe_root_mm), 0),
            middle(&|m| m.outcome.to_recorded().map(|e| e.mpjpe_global_mm), 0),
            middle(&|m| m.outcome.to_recorded().map(|e| e.joint_rms_deg), 1),
            middle(&|m| m.outcome.to_prepared().map(|e| e.joint_rms_deg), 1),
            middle(&|m| m.outcome.touch_downs.median_ms, 0),
            middle(&|m| m.outcome.contact_recall, 2),
            middle(&|m| m.outcome.skate_worst_mm, 1),
            middle(&|m| Some(m.outcome.limit_s), 1),
        ];
        if copied {
            let all = of.iter().filter_map(|m| m.copies.as_ref());
            let [completed, run] = all.fold([0, 0], |[k, n], c| [k + c.completed, n + c.count]);
            row.insert(3, format!("{completed} of {run}"));
        }
        out.rows.push(row);
    };
    for kind in MotionKind::ALL {
        let of: Vec<&MeasuredClip> = measured
            .iter()
            .copied()
            .filter(|m| m.kind == kind)
            .collect();
        if !of.is_empty() {
            add(kind.name(), &of);
        }
    }
    add("all", &measured);
    out
}

/// For each forecast, the number of clips that were followed as prepared, and of those that were lost.
pub fn confusion(rows: &[SurveyRow]) -> SurveyTable {
    let mut out = SurveyTable {
        head: vec!["forecast", "followed as prepared", "lost", "followed, %"],
        rows: Vec::new(),
    };
    for verdict in ForecastVerdict::ALL {
        let of: Vec<&MeasuredClip> = (rows.iter().filter_map(|r| r.result.as_ref()))
            .filter(|m| m.forecast.verdict == verdict)
            .collect();
        let k = of
            .iter()
            .filter(|m| m.outcome.followed_as_prepared())
            .count();
        let share = (!of.is_empty()).then(|| 100.0 * k as f64 / of.len() as f64);
        out.rows.push(vec![
            verdict.name().to_owned(),
            k.to_string(),
            (of.len() - k).to_string(),
            digits(share, 0),
        ]);
    }
    out
}

/// The tables that fit on a page for readers, in Markdown: by kind of motion, and forecasts against results.
pub fn summary(rows: &[SurveyRow]) -> String {
    let [kinds, _, _, forecasts] = titled(rows);
    in_markdown([kinds, forecasts])
}

fn in_markdown<const N: usize>(tables: [(&'static str, SurveyTable); N]) -> String {
    let mut out = String::new();
    for (title, table) in tables {
        out += &format!("{title}\n\n{}\n", table.markdown());
    }
    out.trim_end().to_owned() + "\n"
}

/// All tables one after the other, for a terminal: those by clip with fewer columns than the Markdown has.
pub fn text(rows: &[SurveyRow]) -> String {
    let mut out = String::new();
    for (title, table) in titled(rows) {
        out += &format!("{title}\n\n{}\n", table.without(&WIDE).text());
    }
    let ways = ways(rows);
    if !ways.rows.is_empty() {
        out += &format!("{WAYS}\n\n{}\n", ways.text());
    }
    out
}

/// Title of [`ways`].
const WAYS: &str = "How clips were followed, and why so:";

/// Columns for which a terminal has no room.
const WIDE: [&str; 10] = [
    "to prepared: root-rel./global, mm",
    "missed/added",
    "depth, mm",
    "F_z, weights",
    "jerk ratio",
    "floor lacks rms/peak, weights",
    "moment rms/peak, weight·m",
    "of any joint: peak/95 %",
    "floor, s",
    "inverted, s",
];

fn titled(rows: &[SurveyRow]) -> [(&'static str, SurveyTable); 4] {
    [
        ("By kind of motion (medians):", by_kind(rows)),
        (
            "By clip (errors until the clip is lost or the figure fell):",
            by_clip(rows),
        ),
        (
            "Difficulty and forecast, before the run:",
            difficulties(rows),
        ),
        (
            "Forecasts and what came of them (within 0.5 m of the prepared motion, to its end):",
            confusion(rows),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up_and_markdown_escapes_bars() {
        let t = SurveyTable {
            head: vec!["a", "long head"],
            rows: vec![
                vec!["x|y".into(), "1.5".into()],
                vec!["z".into(), "text".into()],
            ],
        };
        assert_eq!(t.text(), "a    long head\nx|y        1.5\nz    text\n");
        assert_eq!(t.without(&["a"]).head, ["long head"]);
        assert_eq!(t.without(&["a"]).rows[1], ["text"]);
        assert_eq!(
            t.markdown(),
            "| a | long head |\n|---|---|\n| x\\|y | 1.5 |\n| z | text |\n"
        );
    }

    #[test]
    fn a_clip_that_cannot_be_read_is_a_row() {
        let row = SurveyRow {
            clip: "bad.bvh".into(),
            input: "0".into(),
            error: Some("line 3: no number".into()),
            result: None,
        };
        let t = by_clip(std::slice::from_ref(&row));
        assert!(t.rows[0][1].contains("line 3"));
        assert_eq!(t.rows[0].len(), t.head.len());
        assert_eq!(by_kind(&[row]).rows[0][1], "0");
    }
}
