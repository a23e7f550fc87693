//! The table that leads from each equation to its code and its tests, `docs/equations.md`, held against the source.
//!
//! Goal: readers in search of an equation find the functions that compute it and the tests that check it, and both
//! name the equation. Method: the rows of the tables are read; each path in them is looked up among the items of
//! `src/`, each test among the tests of the repository, and the comments above them must name the subject of the row.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// An item and the place of its definition.
struct Item {
    /// Modules, without the crate: `sim::contact::newton`. Empty outside `src/`.
    module: String,
    /// The type of which it is a method.
    owner: String,
    name: String,
    /// Comments and attributes above it; in Python the line below it.
    docs: String,
    is_test: bool,
}

/// A row with a function and a test.
struct Row {
    /// `(7)–(11)`, `S4 metric`, `§3.1`, `–`.
    about: String,
    code: Vec<String>,
    tests: Vec<String>,
}

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn files(dir: &Path, out: &mut Vec<std::path::PathBuf>) {
    for entry in fs::read_dir(dir).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, out);
        } else if path.extension().is_some_and(|e| e == "rs" || e == "py") {
            out.push(path);
        }
    }
}

/// The word after one of these, if the line defines something.
fn defined(line: &str) -> Option<&str> {
    let mut words = line.split_whitespace().peekable();
    while let Some(word) = words.next() {
        if matches!(word, "fn" | "def" | "struct" | "enum" | "trait") {
            let name = words.next()?;
            let end = name.find(|c: char| !c.is_alphanumeric() && c != '_');
            return Some(&name[..end.unwrap_or(name.len())]).filter(|n| !n.is_empty());
        }
        if !(word.starts_with("pub") || matches!(word, "const" | "async" | "unsafe" | "crate)")) {
            return None;
        }
    }
    None
}

/// The type of a line like `impl<'a> Trait for Type<'a> {`.
fn implemented(line: &str) -> Option<String> {
    let rest = line.strip_prefix("impl")?;
    let rest = rest.split(" for ").last()?.trim_start();
    let rest = if let Some(generic) = rest.strip_prefix('<') {
        generic.split_once('>')?.1.trim_start()
    } else {
        rest
    };
    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_');
    Some(rest[..end.unwrap_or(rest.len())].to_owned())
}

fn module(path: &Path) -> String {
    let Ok(inner) = path.strip_prefix(root().join("src")) else {
        return String::new();
    };
    let inner = inner.with_extension("");
    let parts = inner.iter().map(|p| p.to_str().unwrap());
    let parts: Vec<_> = parts.filter(|p| *p != "mod").collect();
    parts.join("::")
}

fn items() -> Vec<Item> {
    let mut paths = Vec::new();
    for dir in ["src", "tests"] {
        files(&root().join(dir), &mut paths);
    }
    let mut out = Vec::new();
    for path in &paths {
        let text = fs::read_to_string(path).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        let mut owner = String::new();
        for (i, line) in lines.iter().enumerate() {
            if let Some(name) = implemented(line) {
                owner = name;
            } else if *line == "}" {
                owner.clear();
            }
            let Some(name) = defined(line) else { continue };
            let python = path.extension().is_some_and(|e| e == "py");
            let above = |l: &&&str| {
                let l = l.trim_start();
                l.starts_with("//") || l.starts_with("#[")
            };
            let mut docs: Vec<&str> = lines[..i].iter().rev().take_while(above).copied().collect();
            docs.reverse();
            if python {
                docs = lines.get(i + 1).copied().into_iter().collect();
            }
            let attribute = |d: &&str| d.trim_start().starts_with("#[") && d.contains("test");
            let is_test = docs.iter().any(attribute) || python && name.starts_with("test_");
            out.push(Item {
                module: module(path),
                owner: owner.clone(),
                name: name.to_owned(),
                docs: docs.join("\n"),
                is_test,
            });
        }
    }
    out
}

/// `a::{b, c}` as `a::b` and `a::c`.
fn each(path: &str) -> Vec<String> {
    match path.split_once("::{") {
        Some((before, names)) => {
            let names = names.trim_end_matches('}').split(',');
            names.map(|n| format!("{before}::{}", n.trim())).collect()
        }
        None => vec![path.to_owned()],
    }
}

/// The text between backticks.
fn quoted(cell: &str) -> Vec<String> {
    let parts = cell.split('`').skip(1).step_by(2);
    parts.flat_map(each).collect()
}

fn rows(page: &str) -> Vec<Row> {
    let mut out = Vec::new();
    let mut is_about_tests = false;
    for line in page.lines() {
        let Some(inner) = line.strip_prefix('|') else {
            is_about_tests = false;
            continue;
        };
        let cells: Vec<&str> = inner
            .trim_end_matches('|')
            .split('|')
            .map(str::trim)
            .collect();
        if cells.last() == Some(&"tests") {
            is_about_tests = true;
        } else if is_about_tests && !cells[0].starts_with('-') {
            let (tests, code) = (cells.len() - 1, cells.len() - 2);
            out.push(Row {
                about: cells[0].to_owned(),
                code: quoted(cells[code]),
                tests: quoted(cells[tests]),
            });
        }
    }
    out
}

/// The names under which a row may be referred to.
fn names(about: &str) -> Vec<String> {
    let numbers: Vec<u32> = about
        .split(['(', ')'])
        .filter_map(|n| n.parse().ok())
        .collect();
    match (about.contains('–'), &numbers[..]) {
        (true, [first, last]) => (*first..=*last).map(|n| format!("({n})")).collect(),
        (_, []) => {
            let first = about.split_whitespace().next().unwrap_or_default();
            let known =
                first.starts_with(['§', 'S']) || first.starts_with(|c: char| c.is_ascii_digit());
            // A section may also be named in words.
            let words = first.strip_prefix('§').map(|n| format!("Section {n}"));
            let short = Some(first.to_owned()).filter(|_| known);
            short.into_iter().chain(words).collect()
        }
        _ => numbers.iter().map(|n| format!("({n})")).collect(),
    }
}

/// Items to which a path may refer.
fn meant<'a>(items: &'a [Item], path: &str) -> Vec<&'a Item> {
    let mut parts: Vec<&str> = path.split("::").collect();
    let name = parts.pop().unwrap();
    let owner = parts.pop_if(|p| p.starts_with(|c: char| c.is_uppercase()));
    let module = parts.join("::");
    let found = items.iter().filter(|item| {
        let inside = item.module == module || item.module.starts_with(&format!("{module}::"));
        item.name == name && inside && owner.is_none_or(|o| item.owner == o)
    });
    found.collect()
}

/// The faults of the table.
fn faults(page: &str, items: &[Item]) -> Vec<String> {
    let mut out = Vec::new();
    for row in rows(page) {
        let Row { about, code, tests } = row;
        let names = names(&about);
        let says =
            |item: &&Item| names.is_empty() || names.iter().any(|n| item.docs.contains(n.as_str()));
        // A path from the root of the crate is exact; a shorter one is relative to it.
        let code: Vec<_> = code
            .iter()
            .filter(|p| p.starts_with("sim::") || p.starts_with("evaluate::"))
            .collect();
        let tests: Vec<_> = tests.iter().filter(|t| !t.contains("::")).collect();
        if about == "(1)" {
            continue; // the page gives a reason
        }
        if code.is_empty() || tests.is_empty() {
            out.push(format!("{about}: no function or no test"));
        }
        for path in code {
            let found = meant(items, path);
            if names.is_empty() && items.iter().any(|i| i.module == *path) {
                continue; // a module
            }
            if found.is_empty() {
                out.push(format!("{about}: there is no {path}"));
            } else if !found.iter().any(says) {
                out.push(format!("{about}: {path} does not say that it is about it"));
            }
        }
        let mut real = 0;
        for test in tests {
            let found: Vec<_> = items.iter().filter(|i| i.name == *test).collect();
            if found.is_empty() {
                continue; // a quantity that a test observes, not a test
            }
            real += 1;
            if !found.iter().any(|i| i.is_test) {
                out.push(format!("{about}: {test} is no test"));
            } else if !found.iter().any(says) {
                out.push(format!("{about}: {test} does not say that it is about it"));
            }
        }
        if real == 0 {
            out.push(format!("{about}: none of its tests exists"));
        }
    }
    out
}

fn page() -> String {
    fs::read_to_string(root().join("docs/equations.md")).unwrap()
}

#[test]
fn each_equation_has_code_and_tests_that_name_it() {
    let faults = faults(&page(), &items());
    assert!(faults.is_empty(), "{faults:#?}");
}

#[test]
fn no_equation_of_the_paper_is_left_out() {
    let there: BTreeSet<String> = rows(&page()).iter().flat_map(|r| names(&r.about)).collect();
    let equations = (1..=17).map(|n| format!("({n})"));
    let others = [
        "§3.1", "§3.2", "S1", "S2", "S3", "S4", "S5", "14.1", "14.2", "14.3",
    ];
    let missing: Vec<_> = equations
        .chain(others.map(str::to_owned))
        .filter(|n| !there.contains(n))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn mistakes_in_the_table_are_found() {
    let (page, items) = (page(), items());
    for (right, wrong) in [
        ("support_ratios`", "support_rations`"),
        (
            "`members_keep_their_torque_and_the_others_get_the_wish`",
            "–",
        ),
        ("| (5) |", "| (6) |"),
        (
            "`legs_have_the_published_strength`, `limits_straddle_zero_everywhere_and_are_continuous`, \
             `faster_shortening_never_gives_more`",
            "`nobody_wrote_this`",
        ),
    ] {
        assert!(page.contains(right), "{right}");
        assert!(
            !faults(&page.replacen(right, wrong, 1), &items).is_empty(),
            "{wrong}"
        );
    }
}
