//! The cost of storing worlds: the same load on servers that store in different ways, as a table of ratios.

use super::args::Storing;
use super::report::{BenchReport, Delays};
use serde::Serialize;
use std::fmt::Write as _;

/// The reports of several servers.
#[derive(Debug, Serialize)]
pub(super) struct BenchComparison {
    rows: Vec<ComparisonRow>,
}

/// The reports of servers that store in one way, one per round.
#[derive(Debug, Serialize)]
struct ComparisonRow {
    durability: Storing,
    reports: Vec<BenchReport>,
}

/// A column of the table.
struct ComparisonColumn {
    head: &'static str,
    digits: usize,
    /// The column's value in a report.
    value: fn(&BenchReport) -> Option<f64>,
    /// Whether the ratio to the first row is shown beside it.
    compared: bool,
}

const fn compared(
    head: &'static str,
    digits: usize,
    value: fn(&BenchReport) -> Option<f64>,
) -> ComparisonColumn {
    ComparisonColumn {
        head,
        digits,
        value,
        compared: true,
    }
}

const fn plain(
    head: &'static str,
    digits: usize,
    value: fn(&BenchReport) -> Option<f64>,
) -> ComparisonColumn {
    ComparisonColumn {
        compared: false,
        ..compared(head, digits, value)
    }
}

fn p50(delays: &Option<Delays>) -> Option<f64> {
    delays.as_ref().map(|d| d.p50_ms)
}

fn p99(delays: &Option<Delays>) -> Option<f64> {
    delays.as_ref().map(|d| d.p99_ms)
}

const COLUMNS: [ComparisonColumn; 11] = [
    compared("ticks", 0, |r| Some(r.server.ticks)),
    plain("left out", 0, |r| Some(r.server.ticks_skipped)),
    compared("processors", 2, |r| Some(r.server.processors)),
    compared("lateness p50, ms", 3, |r| p50(&r.server.tick_lateness)),
    compared("p99, ms", 3, |r| p99(&r.server.tick_lateness)),
    compared("input to frame p99, ms", 1, |r| {
        p99(&r.clients.input_to_frame)
    }),
    compared("change p50, ms", 1, |r| p50(&r.clients.changes)),
    compared("p99, ms", 1, |r| p99(&r.clients.changes)),
    plain("commits/s", 0, |r| Some(r.disk.commits_per_s)),
    plain("kB/s", 0, |r| Some(r.disk.bytes_per_s * 1e-3)),
    // Some systems do not count it.
    plain("kB/s on disk", 0, |r| {
        r.disk.disk_bytes_per_s.map(|b| b * 1e-3)
    }),
];

/// The median of some numbers.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let upper = *values.get(values.len() / 2)?;
    let lower = values[(values.len() - 1) / 2];
    Some(0.5 * (lower + upper))
}

impl ComparisonRow {
    fn value(&self, column: &ComparisonColumn) -> Option<f64> {
        median(self.reports.iter().filter_map(column.value).collect())
    }
}

impl BenchComparison {
    /// Rows in this order, without reports. A method that is named twice has one row.
    pub(super) fn new(ways: &[Storing]) -> Self {
        let mut rows: Vec<ComparisonRow> = Vec::new();
        for way in ways {
            if !rows.iter().any(|r| r.durability == *way) {
                rows.push(ComparisonRow {
                    durability: *way,
                    reports: Vec::new(),
                });
            }
        }
        Self { rows }
    }

    /// Adds the report of one round.
    pub(super) fn add(&mut self, way: Storing, report: BenchReport) {
        if let Some(row) = self.rows.iter_mut().find(|r| r.durability == way) {
            row.reports.push(report);
        }
    }

    /// A table in Markdown: medians of the rounds, with their ratio to the first row in brackets.
    pub(super) fn text(&self) -> String {
        let mut out = String::from("| durability |");
        for column in &COLUMNS {
            let _ = write!(out, " {} |", column.head);
        }
        let _ = write!(out, "\n|{}", "---|".repeat(COLUMNS.len() + 1));
        for row in &self.rows {
            let _ = write!(out, "\n| `{}` |", row.durability.name());
            for column in &COLUMNS {
                let Some(value) = row.value(column) else {
                    out.push_str(" – |");
                    continue;
                };
                let _ = write!(out, " {value:.*}", column.digits);
                let first = self.rows[0].value(column).filter(|f| *f > 0.0);
                if let (true, Some(first)) = (column.compared, first) {
                    let _ = write!(out, " ({:.2})", value / first);
                }
                out.push_str(" |");
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_are_the_middle() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(vec![4.0, 1.0]), Some(2.5));
        assert_eq!(median(Vec::new()), None);
    }

    #[test]
    fn each_way_has_one_row() {
        let ways = [Storing::Group, Storing::Off, Storing::Group];
        let text = BenchComparison::new(&ways).text();
        assert_eq!(text.matches("`group`").count(), 1, "{text}");
        let widths: Vec<usize> = text.lines().map(|l| l.matches('|').count()).collect();
        assert_eq!(widths, [13; 4], "{text}");
    }
}
