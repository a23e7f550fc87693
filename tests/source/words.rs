//! Words of comments and documents.

use std::fs;
use std::path::{Path, PathBuf};

/// Turns of phrase that a native reader understands at the second reading only.
pub const PATTERNS: [&str; 8] = [
    "sentences that begin with \"What\" as a noun",
    "who, whoever, nobody",
    "True if",
    "so many, so far",
    "goes over, goes on",
    "anew",
    "meanwhile",
    "False if it cannot be",
];

/// Pages that a command writes as a whole, besides those of surveys.
const GENERATED: &[&str] = &[
    "docs/parameters.md",
    "docs/paper",
    "docs/walking",
    "docs/survey",
];

/// The comments of a Rust source, one text for neighbouring lines.
pub fn comments(source: &str) -> Vec<String> {
    let mut out: Vec<String> = Vec::new();
    let mut open = false;
    for line in source.lines() {
        let whole = line.trim_start();
        let text = match whole.strip_prefix("//") {
            Some(text) => Some((text, open)),
            // Behind code: not within a string.
            None => line
                .match_indices("//")
                .find(|(i, _)| {
                    line[..*i].matches('"').count() % 2 == 0 && !line[..*i].ends_with(':')
                })
                .map(|(i, _)| (&line[i + 2..], false)),
        };
        open = text.is_some() && whole.starts_with("//");
        let Some((text, goes_on)) = text else {
            continue;
        };
        let text = text.trim_start_matches(['/', '!']).trim();
        match out.last_mut().filter(|_| goes_on && !text.is_empty()) {
            Some(last) => {
                last.push(' ');
                last.push_str(text);
            }
            None => out.push(text.to_owned()),
        }
    }
    out
}

/// How often each of [`PATTERNS`] is in a comment.
pub fn patterns(comment: &str) -> [usize; 8] {
    let mut out = [0; 8];
    let plain: String = comment
        .chars()
        .map(|c| if c.is_alphanumeric() { c } else { ' ' })
        .collect();
    let plain = plain.split_whitespace().collect::<Vec<_>>().join(" ");
    let padded = format!(" {plain} ");
    let lower = padded.to_lowercase();
    let count = |text: &str, words: &[&str]| -> usize {
        words
            .iter()
            .map(|w| text.matches(&format!(" {w} ")).count())
            .sum()
    };
    let sentences = comment.split_inclusive(['.', '?', '!', ':', ';']);
    out[0] = sentences
        .filter(|s| s.trim_start().starts_with("What ") && !s.trim_end().ends_with('?'))
        .count();
    out[1] = count(&lower, &["who", "whoever", "nobody"]);
    out[2] = count(&padded, &["True if"]);
    out[3] = count(&lower, &["so many", "so far"]);
    out[4] = count(&lower, &["goes over", "goes on"]);
    out[5] = count(&lower, &["anew"]);
    out[6] = count(&lower, &["meanwhile"]);
    out[7] = count(&padded, &["False if it cannot be"]);
    out
}

/// How often each of [`PATTERNS`] is in the comments of all Rust files.
pub fn patterns_of_all(root: &Path) -> [usize; 8] {
    let mut out = [0; 8];
    for folder in ["src", "tests", "tools", "benches", "examples"] {
        for file in crate::files(&root.join(folder), ".rs") {
            let text = fs::read_to_string(file).expect("the file was listed");
            for comment in comments(&text) {
                for (sum, n) in out.iter_mut().zip(patterns(&comment)) {
                    *sum += n;
                }
            }
        }
    }
    out
}

/// Words of README, CHANGELOG and docs: those that people wrote, and those that commands wrote.
pub fn of_documents(root: &Path) -> [usize; 2] {
    let mut pages: Vec<PathBuf> = crate::files(&root.join("docs"), ".md");
    pages.extend(["README.md", "CHANGELOG.md"].map(|p| root.join(p)));
    let [mut written, mut generated] = [0, 0];
    for page in pages {
        let text = fs::read_to_string(&page).unwrap_or_default();
        let name = page.strip_prefix(root).unwrap_or(&page);
        if GENERATED.iter().any(|g| name.starts_with(g)) {
            generated += text.split_whitespace().count();
            continue;
        }
        let mut in_section = false;
        for line in text.lines() {
            let mark = line.trim_start().starts_with("<!--");
            in_section |= mark && line.contains(" begin");
            *(if in_section {
                &mut generated
            } else {
                &mut written
            }) += line.split_whitespace().count();
            in_section &= !(mark && line.contains(" end "));
        }
    }
    [written, generated]
}
