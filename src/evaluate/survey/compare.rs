//! Two surveys of the same clips under the same settings: the improvements, the regressions, and which of them exceed
//! noise.
//!
//! Without copies runs are deterministic: a verdict that turns is a change, and so is a measure that moves by more than
//! its stated tolerance ([`SurveyMeasure::least`], [`SurveyMeasure::share`]), which covers the rounding of different
//! builds. With copies, the share of completed runs is compared by the 95 % interval of the difference of two shares,
//! and measures by their medians: they differ if their 95 % intervals (notches) do not overlap and the tolerance is
//! exceeded.

use super::outcome::{Better, MEASURES, SurveyMeasure, SurveyOutcome};
use super::stats::{Quartiles, difference};
use super::{MeasuredClip, SurveyRow};
use std::fmt::Write;

/// A change.
#[derive(Clone, Debug, PartialEq)]
pub struct SurveyChange {
    /// The clip; empty for the survey as a whole.
    pub clip: String,
    /// The change, with the old and the new value.
    pub text: String,
    /// Whether it is for the worse.
    pub worse: bool,
}

/// The result of a comparison.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurveyComparison {
    /// Changes beyond noise, by clip in the order of the new survey, then of the survey as a whole.
    pub changes: Vec<SurveyChange>,
    /// Clips that were not compared, with reasons.
    pub skipped: Vec<(String, &'static str)>,
    /// Clips that were compared.
    pub compared: usize,
}

impl SurveyComparison {
    /// Number of changes for the worse.
    pub fn regressions(&self) -> usize {
        self.changes.iter().filter(|c| c.worse).count()
    }

    /// As text, one line per change.
    pub fn text(&self) -> String {
        let mut out = String::new();
        for (clip, why) in &self.skipped {
            // Writing to a string cannot fail.
            let _ = writeln!(out, "  not compared  {clip}: {why}");
        }
        for c in &self.changes {
            let word = if c.worse { "worse " } else { "better" };
            let clip = if c.clip.is_empty() {
                "all clips"
            } else {
                &c.clip
            };
            let _ = writeln!(out, "  {word}  {clip}: {}", c.text);
        }
        let worse = self.regressions();
        let _ = writeln!(
            out,
            "{} compared: {} better, {worse} worse beyond noise",
            match self.compared {
                1 => "1 clip".to_owned(),
                n => format!("{n} clips"),
            },
            self.changes.len() - worse
        );
        out
    }
}

/// Compares two surveys; the caller has checked that their settings agree.
pub fn compare(old: &[SurveyRow], new: &[SurveyRow]) -> SurveyComparison {
    let mut out = SurveyComparison::default();
    let mut totals = [(0, 0); 2];
    for row in new {
        let Some(before) = old.iter().find(|o| o.clip == row.clip) else {
            out.skipped
                .push((row.clip.clone(), "only in the new survey"));
            continue;
        };
        if before.input != row.input {
            out.skipped.push((row.clip.clone(), "the file has changed"));
            continue;
        }
        let mut add = |text: String, worse: bool| {
            out.changes.push(SurveyChange {
                clip: row.clip.clone(),
                text,
                worse,
            });
        };
        match (&before.result, &row.result) {
            (Some(_), None) => {
                let why = row.error.as_deref().unwrap_or("no result");
                add(format!("can no longer be run: {why}"), true);
            }
            (None, Some(_)) => add("can be run now".to_owned(), false),
            (None, None) => {}
            (Some(a), Some(b)) => {
                out.compared += 1;
                for (total, m) in totals.iter_mut().zip([a, b]) {
                    let (k, n) = completed(m);
                    *total = (total.0 + k, total.1 + n);
                }
                clip_changes(a, b, add);
            }
        }
    }
    for row in old {
        if !new.iter().any(|n| n.clip == row.clip) {
            out.changes.push(SurveyChange {
                clip: row.clip.clone(),
                text: "is missing in the new survey".to_owned(),
                worse: true,
            });
        }
    }
    let [a, b] = totals;
    if let Some(worse) = differs(a, b) {
        out.changes.push(SurveyChange {
            clip: String::new(),
            text: format!(
                "{} of {} completed (PHC), were {} of {}",
                b.0, b.1, a.0, a.1
            ),
            worse,
        });
    }
    out
}

/// Completed runs, and all runs: of the copies if there are any, otherwise of the clip itself.
fn completed(m: &MeasuredClip) -> (usize, usize) {
    match &m.copies {
        Some(c) => (c.completed, c.count),
        None => (usize::from(m.outcome.completed), 1),
    }
}

/// Whether two shares differ beyond their 95 % interval, and if so, whether the second is worse.
fn differs(a: (usize, usize), b: (usize, usize)) -> Option<bool> {
    let [low, high] = difference(a, b);
    match (low > 0.0, high < 0.0) {
        (true, _) => Some(false),
        (_, true) => Some(true),
        _ => None,
    }
}

fn clip_changes(a: &MeasuredClip, b: &MeasuredClip, mut add: impl FnMut(String, bool)) {
    match (&a.copies, &b.copies) {
        (Some(x), Some(y)) => {
            let (x_share, y_share) = ((x.completed, x.count), (y.completed, y.count));
            if let Some(worse) = differs(x_share, y_share) {
                let text = format!(
                    "{} of {} copies completed (PHC), were {} of {}",
                    y.completed, y.count, x.completed, x.count
                );
                add(text, worse);
            }
            for (k, m) in MEASURES.iter().enumerate() {
                let of = |c: &super::Copies| c.measures.get(k).copied().flatten();
                if let (Some(old), Some(new)) = (of(x), of(y)) {
                    of_copies(m, &old, &new, &mut add);
                }
            }
        }
        _ => of_runs(&a.outcome, &b.outcome, &mut add),
    }
}

fn of_copies(
    m: &SurveyMeasure,
    old: &Quartiles,
    new: &Quartiles,
    add: &mut impl FnMut(String, bool),
) {
    let apart = (new.median - old.median).abs() > old.notch() + new.notch();
    if let Some(worse) = moved(m, old.median, new.median).filter(|_| apart) {
        let text = format!(
            "{}: {} of {} copies in the middle, was {}",
            m.name,
            number(new.median),
            new.count,
            number(old.median)
        );
        add(text, worse);
    }
}

fn of_runs(a: &SurveyOutcome, b: &SurveyOutcome, add: &mut impl FnMut(String, bool)) {
    let verdicts: [(&str, fn(&SurveyOutcome) -> Option<f64>); 6] = [
        ("lost by PHC's rule", |o| o.lost_at_s),
        ("lost against the prepared motion", |o| o.prepared_lost_at_s),
        ("lost by the rule of height and tilt", |o| {
            o.anchor_lost_at_s
        }),
        ("fell", |o| o.fell_at_s),
        ("on the floor after its end", |o| {
            o.down_after.then_some(o.followed_s)
        }),
        ("frozen", |o| o.frozen_at_s),
    ];
    for (what, of) in verdicts {
        match (of(a), of(b)) {
            (None, Some(t)) => add(format!("{what} at {t:.2} s, was not"), true),
            (Some(t), None) => add(format!("no longer {what} (at {t:.2} s)"), false),
            _ => {}
        }
    }
    for m in &MEASURES {
        if let (Some(old), Some(new)) = ((m.of)(a), (m.of)(b))
            && let Some(worse) = moved(m, old, new)
        {
            let text = format!("{}: {}, was {}", m.name, number(new), number(old));
            add(text, worse);
        }
    }
}

/// Whether a measure moved beyond its tolerance, and if so, whether for the worse.
fn moved(m: &SurveyMeasure, old: f64, new: f64) -> Option<bool> {
    let rise = match m.better {
        Better::Less => new - old,
        Better::More => old - new,
        Better::Zero => new.abs() - old.abs(),
    };
    (rise.abs() > m.least.max(m.share * old.abs())).then_some(rise > 0.0)
}

/// Three significant digits, without an exponent for readability.
fn number(x: f64) -> String {
    let digits = match x.abs() {
        a if a >= 100.0 => 0,
        a if a >= 10.0 => 1,
        a if a >= 1.0 => 2,
        _ => 3,
    };
    let text = format!("{x:.digits$}");
    let is_zero = text.chars().all(|c| "-0.".contains(c));
    text.trim_start_matches(|c| is_zero && c == '-').to_owned()
}

#[cfg(test)]
mod tests {
    use super::super::outcome::Copies;
    use super::*;
    use crate::survey::{Lacks, MotionKind};
    use sinew_physics::forecast::Forecast;

    fn row(change: impl Fn(&mut MeasuredClip)) -> SurveyRow {
        let mut m = MeasuredClip {
            kind: MotionKind::Walk,
            clip_s: 2.0,
            walked: false,
            prepared_off_m: 0.02,
            warnings: Vec::new(),
            recorded_lacks: None,
            prepared_lacks: Lacks::default(),
            forecast: Forecast::default(),
            outcome: SurveyOutcome {
                completed: true,
                followed_s: 2.0,
                contact_recall: Some(0.95),
                impulse_balance: Some(0.0),
                ..SurveyOutcome::default()
            },
            copies: None,
            followed: None,
        };
        m.outcome.recorded.mpjpe_global_mm = 60.0;
        change(&mut m);
        SurveyRow {
            clip: "a.bvh".into(),
            input: "1".into(),
            error: None,
            result: Some(m),
        }
    }

    fn of(change: impl Fn(&mut MeasuredClip)) -> SurveyComparison {
        compare(&[row(|_| {})], &[row(change)])
    }

    #[test]
    fn numbers_are_short_and_zero_has_no_sign() {
        let all = [-1e-7, 0.05, -0.05, 1.234, 56.78, 901.2].map(number);
        assert_eq!(all, ["0.000", "0.050", "-0.050", "1.23", "56.8", "901"]);
    }

    #[test]
    fn the_same_is_clean_and_rounding_is_no_change() {
        assert_eq!(of(|_| {}).changes, []);
        assert_eq!(
            of(|m| m.outcome.recorded.mpjpe_global_mm = 62.0).changes,
            []
        );
    }

    #[test]
    fn a_lost_clip_a_larger_error_and_a_wrong_label_are_worse() {
        let lost = of(|m| {
            m.outcome.completed = false;
            m.outcome.lost_at_s = Some(1.0);
        });
        assert_eq!(lost.regressions(), 1, "{lost:?}");
        assert!(
            lost.text()
                .contains("worse   a.bvh: lost by PHC's rule at 1.00 s"),
            "{}",
            lost.text()
        );
        assert_eq!(
            of(|m| m.outcome.recorded.mpjpe_global_mm = 90.0).regressions(),
            1
        );
        assert_eq!(
            of(|m| m.outcome.contact_recall = Some(0.6)).regressions(),
            1
        );
        let better = of(|m| m.outcome.recorded.mpjpe_global_mm = 30.0);
        assert_eq!((better.regressions(), better.changes.len()), (0, 1));
        // Away from zero is worse in either direction.
        assert_eq!(
            of(|m| m.outcome.impulse_balance = Some(-0.05)).regressions(),
            1
        );
        assert_eq!(
            of(|m| m.outcome.impulse_balance = Some(0.05)).regressions(),
            1
        );
    }

    #[test]
    fn copies_are_judged_by_the_interval_of_their_share() {
        let copies = |completed: usize| {
            row(|m| {
                m.copies = Some(Copies {
                    count: 20,
                    completed,
                    measures: vec![None; MEASURES.len()],
                    ..Copies::default()
                });
            })
        };
        let few = compare(&[copies(20)], &[copies(18)]);
        assert_eq!(few.regressions(), 0, "{few:?}");
        let many = compare(&[copies(20)], &[copies(10)]);
        // The clip, and the survey as a whole.
        assert_eq!(many.regressions(), 2, "{many:?}");
    }

    #[test]
    fn clips_that_went_missing_or_changed_are_told() {
        let gone = compare(&[row(|_| {})], &[]);
        assert_eq!(gone.regressions(), 1);
        let mut other = row(|m| m.outcome.recorded.mpjpe_global_mm = 900.0);
        other.input = "2".into();
        let changed = compare(&[row(|_| {})], &[other]);
        assert_eq!((changed.regressions(), changed.skipped.len()), (0, 1));
        let mut broken = row(|_| {});
        (broken.result, broken.error) = (None, Some("frame 3".into()));
        assert_eq!(compare(&[row(|_| {})], &[broken]).regressions(), 1);
    }
}
