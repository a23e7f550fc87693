//! Cargo's files: how many programs a build links, and which crates a package needs.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// A table of a manifest or of a lock file, in the parts that are read here: its head and its lines.
struct Table {
    head: String,
    values: BTreeMap<String, String>,
}

impl Table {
    fn is_true(&self, key: &str, default: bool) -> bool {
        self.values.get(key).map_or(default, |v| v == "true")
    }

    /// The strings of a list.
    fn list(&self, key: &str) -> Vec<&str> {
        let value = self.values.get(key).map_or("", String::as_str);
        value.split('"').skip(1).step_by(2).collect()
    }
}

/// The tables of a file. Comments are left out, and a list may take several lines.
fn tables(path: &Path) -> Vec<Table> {
    let text = fs::read_to_string(path).unwrap_or_default();
    let mut out = vec![Table {
        head: String::new(),
        values: BTreeMap::new(),
    }];
    let mut open: Option<String> = None;
    for line in text.lines() {
        let line = line.split(" #").next().unwrap_or_default().trim();
        let table = out.last_mut().expect("there is one");
        if let Some(key) = &open {
            let value = table.values.entry(key.clone()).or_default();
            value.push_str(line);
            if line.starts_with(']') {
                open = None;
            }
        } else if line.starts_with('[') {
            out.push(Table {
                head: line.trim_matches(['[', ']']).to_owned(),
                values: BTreeMap::new(),
            });
        } else if let Some((key, value)) = line.split_once('=') {
            let (key, value) = (key.trim().trim_matches('"').to_owned(), value.trim());
            if value.starts_with('[') && !value.ends_with(']') {
                open = Some(key.clone());
            }
            table.values.insert(key, value.trim_matches('"').to_owned());
        }
    }
    out
}

fn find<'a>(tables: &'a [Table], head: &str) -> Option<&'a Table> {
    tables.iter().find(|t| t.head == head)
}

/// Programs that `cargo build` and `cargo test` link: binaries, examples, tests, and the tests within libraries and
/// binaries, of the packages that are built by default.
pub fn links(root: &Path) -> usize {
    let manifest = tables(&root.join("Cargo.toml"));
    let members = find(&manifest, "workspace").map(|w| w.list("default-members"));
    match members {
        Some(members) => members.iter().map(|m| links_of(&root.join(m))).sum(),
        None => links_of(root),
    }
}

fn links_of(package: &Path) -> usize {
    let manifest = tables(&package.join("Cargo.toml"));
    let features = find(&manifest, "features").map_or(Vec::new(), |f| f.list("default"));
    let built = |t: &&Table| {
        t.list("required-features")
            .iter()
            .all(|f| features.contains(f))
    };
    let found = |folder: &str| {
        let entries = fs::read_dir(package.join(folder))
            .into_iter()
            .flatten()
            .flatten();
        let names = entries.filter_map(|e| {
            let path = e.path();
            let is_program =
                path.extension().is_some_and(|x| x == "rs") || path.join("main.rs").exists();
            is_program.then(|| path.file_stem().map(|s| s.to_string_lossy().into_owned()))?
        });
        names.collect::<BTreeSet<String>>()
    };
    let mut out = 0;
    for (kind, folder, switch) in [
        ("test", "tests", "autotests"),
        ("example", "examples", "autoexamples"),
        ("bin", "src/bin", "autobins"),
    ] {
        let declared: Vec<&Table> = manifest.iter().filter(|t| t.head == kind).collect();
        let switched = find(&manifest, "package").is_none_or(|p| p.is_true(switch, true));
        let mut others = if switched {
            found(folder)
        } else {
            BTreeSet::new()
        };
        for t in &declared {
            others.remove(t.values.get("name").map_or("", String::as_str));
        }
        for t in declared.iter().filter(|t| built(t)) {
            let tested = t.is_true("test", kind != "example");
            out += match kind {
                "test" => usize::from(tested),
                _ => 1 + usize::from(tested),
            };
        }
        out += others.len() * if kind == "bin" { 2 } else { 1 };
    }
    let library = find(&manifest, "lib");
    let has_library = library.is_some() || package.join("src/lib.rs").exists();
    out + usize::from(has_library && library.is_none_or(|l| l.is_true("test", true)))
}

/// Crates that the library of the package in `folder` needs on any system, by the lock file; without the package
/// itself.
///
/// The lock file does not separate the needs of a crate at run time from those of its build, so this is an upper bound.
pub fn closure(root: &Path, folder: &str) -> BTreeSet<String> {
    let manifest = tables(&root.join(folder).join("Cargo.toml"));
    let lock = tables(&root.join("Cargo.lock"));
    let mut needs: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for package in lock.iter().filter(|t| t.head == "package") {
        let name = package.values.get("name").map_or("", String::as_str);
        // An entry is a name, with a version if there are several.
        let all = package.list("dependencies").into_iter();
        let names = all.map(|d| d.split(' ').next().unwrap_or(d));
        needs.entry(name).or_default().extend(names);
    }
    let is_normal = |t: &&Table| t.head == "dependencies" || t.head.ends_with(".dependencies");
    let mut open: Vec<&str> = Vec::new();
    for key in manifest
        .iter()
        .filter(is_normal)
        .flat_map(|t| t.values.keys())
    {
        open.push(key.strip_suffix(".workspace").unwrap_or(key));
    }
    let mut out = BTreeSet::new();
    while let Some(name) = open.pop() {
        if out.insert(name.to_owned()) {
            open.extend(needs.get(name).into_iter().flatten());
        }
    }
    out
}

/// Packages in the lock file.
pub fn locked(root: &Path) -> usize {
    tables(&root.join("Cargo.lock"))
        .iter()
        .filter(|t| t.head == "package")
        .count()
}
