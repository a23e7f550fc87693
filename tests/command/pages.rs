//! Goal: `docs/paper` is a page of this build. Method: `sinew paper` writes it again into a folder of the test, and
//! every line is compared with the one that is committed: its words exactly, its numbers within a tolerance. Times of
//! the machine that wrote the page are left out. When this test fails after an intended change, `sinew paper` writes
//! the page again; check its strips.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Numbers agree within this share of the larger one …
const SHARE: f64 = 0.02;
/// … or within this many units of their last printed digit.
const DIGITS: f64 = 2.0;
/// Columns with one of these in their heading hold times of the machine, or rounding errors.
const NOT_COMPARED: [&str; 4] = ["µs", "speed", "computing time", "relative difference"];

/// A line without its numbers, and the numbers with the unit of their last digit.
#[derive(Debug, PartialEq)]
struct Line {
    words: String,
    numbers: Vec<(f64, f64)>,
}

impl Line {
    fn of(text: &str) -> Self {
        let mut out = Self {
            words: String::new(),
            numbers: Vec::new(),
        };
        let mut rest = text;
        while let Some(c) = rest.chars().next() {
            if !c.is_ascii_digit() {
                out.words.push(c);
                rest = &rest[c.len_utf8()..];
                continue;
            }
            let end = rest
                .find(|c: char| !(c.is_ascii_digit() || c == '.'))
                .unwrap_or(rest.len());
            // A full stop after a number ends a sentence.
            let number = rest[..end].trim_end_matches('.');
            let decimals = number.split_once('.').map_or(0, |(_, d)| d.len());
            out.numbers.push((
                number.parse().unwrap_or(f64::NAN),
                10f64.powi(-(decimals as i32)),
            ));
            out.words.push('#');
            rest = &rest[number.len()..];
        }
        out
    }

    /// Whether the words are the same and the numbers agree.
    fn agrees(&self, other: &Self) -> bool {
        self.words == other.words
            && self.numbers.len() == other.numbers.len()
            && self.numbers.iter().zip(&other.numbers).all(|(a, b)| {
                let bound = (SHARE * a.0.abs().max(b.0.abs())).max(DIGITS * a.1.max(b.1));
                (a.0 - b.0).abs() <= bound
            })
    }
}

/// The lines of a page without the columns that are not compared.
fn lines(page: &str) -> Vec<String> {
    let mut left_out: Vec<usize> = Vec::new();
    let mut in_table = false;
    page.lines()
        .map(|line| {
            if !line.starts_with('|') {
                in_table = false;
                return line.to_owned();
            }
            let cells: Vec<&str> = line.split('|').collect();
            if !in_table {
                in_table = true;
                let is_left_out = |c: &&str| NOT_COMPARED.iter().any(|t| c.contains(t));
                left_out = (0..cells.len())
                    .filter(|k| is_left_out(&cells[*k]))
                    .collect();
                return line.to_owned();
            }
            let kept = cells
                .iter()
                .enumerate()
                .map(|(k, c)| if left_out.contains(&k) { "" } else { c });
            kept.collect::<Vec<_>>().join("|")
        })
        .collect()
}

/// The differences, line by line; empty if the pages agree.
fn differences(committed: &str, written: &str) -> Vec<String> {
    let (a, b) = (lines(committed), lines(written));
    let mut out = Vec::new();
    if a.len() != b.len() {
        out.push(format!(
            "{} lines are committed, {} were written",
            a.len(),
            b.len()
        ));
    }
    for (n, (x, y)) in a.iter().zip(&b).enumerate() {
        if !Line::of(x).agrees(&Line::of(y)) {
            out.push(format!("line {}:\n  committed {x}\n  written   {y}", n + 1));
        }
    }
    out
}

#[test]
fn numbers_agree_within_tolerance_and_words_exactly() {
    let same = |a: &str, b: &str| differences(a, b).is_empty();
    assert!(same("falls, 2.10 s", "falls, 2.12 s"));
    assert!(!same("falls, 2.10 s", "falls, 2.20 s"));
    assert!(!same("falls, 2.10 s", "stands, 2.10 s"));
    assert!(!same("a\nb", "a"));
    let table =
        |us: u32, stood: u32| format!("| who | median, µs |\n|---|---|\n| modern {stood} | {us} |");
    assert!(same(&table(29, 35), &table(84, 35)));
    assert!(!same(&table(29, 35), &table(29, 32)));
}

#[test]
fn the_page_about_the_paper_is_written_by_this_build() {
    let folder: PathBuf = std::env::temp_dir().join(format!("sinew-paper-{}", std::process::id()));
    let written = Command::new(env!("CARGO_BIN_EXE_sinew"))
        .arg("paper")
        .arg("--out")
        .arg(&folder)
        .output()
        .expect("the binary runs");
    let page = |name: &str| std::fs::read_to_string(folder.join(name));
    let pages = ["README.md", "rows.md"].map(|name| (name, page(name)));
    let made = std::fs::read_dir(&folder).map(|files| files.filter_map(Result::ok).count());
    let _ = std::fs::remove_dir_all(&folder);
    assert!(
        written.status.success(),
        "{}",
        String::from_utf8_lossy(&written.stderr)
    );
    let committed = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("docs/paper");
    for (name, page) in pages {
        let text = std::fs::read_to_string(committed.join(name)).expect("the page is committed");
        let found = differences(&text, &page.expect("a page was written"));
        assert!(
            found.is_empty(),
            "docs/paper/{name} is not of this build; `sinew paper` writes it again:\n{}",
            found.join("\n")
        );
    }
    // Pictures are not compared, but their number is: `recorded.md` comes from `sinew paper --recordings`.
    let kept = std::fs::read_dir(&committed).expect("the folder").count();
    assert_eq!(made.expect("a folder was written") + 1, kept);
}
