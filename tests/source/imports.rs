//! Imports of the source: the files that use names of another file, and circles among files.
//!
//! A path counts where it is used, not where a module is imported: after `use super::plan`, the path `plan::stop::Stop`
//! uses the file of `plan::stop`. A name that a file imports or re-exports is followed to the file that defines it.
//! Methods are not followed, because a call does not name the file that it calls.

use crate::tokens::{Token, after_block, sign, tokens, without_tests, word};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Crates by their names in code, with the part of the source that each of them is.
const CRATES: &[(&str, &str)] = &[
    ("sinew_physics", "sim"),
    ("sinew_evaluate", "evaluate"),
    ("sinew_wire", "wire"),
    ("sinew_client", "client"),
    ("sinew_server", "server"),
];

/// A path in the source, starting with the part.
#[derive(Clone, Debug, PartialEq)]
pub struct Use {
    /// Its words.
    pub path: Vec<String>,
    /// The name that an import gives it.
    pub name: String,
    /// Whether it ends with `*`.
    pub glob: bool,
}

/// A file of the source, without its tests.
#[derive(Clone, Debug)]
pub struct File {
    /// Its path.
    pub path: PathBuf,
    /// Its module: words starting with the part.
    pub module: Vec<String>,
    /// Its tokens.
    pub tokens: Vec<Token>,
    /// Every path in it that begins at a crate, at `self` or at `super`.
    pub paths: Vec<Vec<String>>,
    /// Words before the paths of its crate: the part, or none if one crate has all parts.
    crate_root: Vec<String>,
}

/// The part of the source that is this crate.
fn part(name: &str) -> Option<&'static str> {
    CRATES
        .iter()
        .find(|(n, _)| *n == name)
        .map(|(_, part)| *part)
}

/// Every path of a file that begins at a crate, at `self` or at `super`. `module` is the module of the file, and
/// `crate_root` the path of its crate.
pub fn paths(t: &[Token], module: &[String], crate_root: &[String]) -> Vec<Vec<String>> {
    let begins = |w: &str| matches!(w, "crate" | "super" | "self") || part(w).is_some();
    let uses = uses_that(t, module, crate_root, &begins);
    uses.into_iter().map(|u| u.path).collect()
}

/// Every path of a file whose first word `begins` accepts.
fn uses_that(
    t: &[Token],
    module: &[String],
    crate_root: &[String],
    begins: &dyn Fn(&str) -> bool,
) -> Vec<Use> {
    let mut out = Vec::new();
    let mut inner: Vec<(String, usize)> = Vec::new(); // inline modules and the depth of their braces
    let mut depth = 0usize;
    let mut i = 0;
    while i < t.len() {
        match &t[i] {
            Token::Sign('{') => depth += 1,
            Token::Sign('}') => {
                depth = depth.saturating_sub(1);
                if inner.last().is_some_and(|(_, d)| *d == depth) {
                    inner.pop();
                }
            }
            Token::Word(w) if w == "mod" && sign(t.get(i + 2), '{') => {
                if let Some(name) = word(t.get(i + 1)) {
                    inner.push((name.to_owned(), depth));
                }
            }
            Token::Word(w)
                if begins(w)
                    && sign(t.get(i + 1), ':')
                    && sign(t.get(i + 2), ':')
                    && !(i >= 2 && sign(t.get(i - 1), ':') && sign(t.get(i - 2), ':')) =>
            {
                let names = inner.iter().map(|(n, _)| n.clone());
                let here = module.iter().cloned().chain(names).collect();
                i = Tree {
                    t,
                    here,
                    crate_root,
                }
                .read(i, &[], &mut out);
                continue;
            }
            _ => {}
        }
        i += 1;
    }
    out
}

/// Reads one path, or a group of them in braces.
struct Tree<'a> {
    t: &'a [Token],
    /// The module for `self`.
    here: Vec<String>,
    /// The path for `crate`.
    crate_root: &'a [String],
}

impl Tree<'_> {
    /// Reads from token `i` on, below `prefix`; returns the index after the path.
    fn read(&self, mut i: usize, prefix: &[String], out: &mut Vec<Use>) -> usize {
        let t = self.t;
        let mut path = prefix.to_vec();
        let mut started = !prefix.is_empty();
        let mut glob = false;
        loop {
            match t.get(i) {
                Some(Token::Word(w)) => {
                    match w.as_str() {
                        "crate" if !started => path.extend_from_slice(self.crate_root),
                        w if !started && part(w).is_some() => {
                            path.extend(part(w).map(str::to_owned))
                        }
                        "self" if !started => path = self.here.clone(),
                        "super" => {
                            if !started {
                                path = self.here.clone();
                            }
                            path.pop();
                        }
                        "self" => {}
                        w => path.push(w.to_owned()),
                    }
                    started = true;
                    i += 1;
                }
                Some(Token::Sign('*')) => {
                    glob = true;
                    i += 1;
                }
                Some(Token::Sign('{')) => {
                    let end = after_block(t, i);
                    i += 1;
                    while i + 1 < end {
                        i = self.read(i, &path, out);
                        if word(t.get(i)) == Some("as") {
                            i += 2;
                        }
                        if sign(t.get(i), ',') {
                            i += 1;
                        }
                    }
                    return end;
                }
                _ => break,
            }
            if sign(t.get(i), ':') && sign(t.get(i + 1), ':') {
                i += 2;
                // `::<` begins type arguments, so the path ends here.
                if sign(t.get(i), '<') {
                    break;
                }
            } else {
                break;
            }
        }
        let renamed = (word(t.get(i)) == Some("as"))
            .then(|| word(t.get(i + 1)))
            .flatten();
        let name = renamed
            .or(path.last().map(String::as_str))
            .unwrap_or_default()
            .to_owned();
        out.push(Use { path, name, glob });
        i.max(1)
    }
}

/// Every path after `std`.
pub fn paths_of_std(t: &[Token]) -> Vec<Vec<String>> {
    let uses = uses_that(t, &[], &[], &|w| w == "std");
    uses.into_iter().map(|u| u.path).collect()
}

/// The files below `src`, without generated code, tests and test helpers.
pub fn files(root: &Path) -> Vec<File> {
    let mut out = Vec::new();
    let one_crate = !root.join("src/sim/Cargo.toml").exists();
    collect(&root.join("src"), &[], one_crate, &mut out);
    out
}

fn collect(folder: &Path, module: &[String], one_crate: bool, out: &mut Vec<File>) {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut entries: Vec<PathBuf> = entries.map(|e| e.path()).collect();
    entries.sort();
    for path in entries {
        let Some(stem) = path.file_stem().and_then(|s| s.to_str()).map(str::to_owned) else {
            continue;
        };
        if path.is_dir() {
            // Generated code follows its generator.
            if stem != "gen" {
                let inner: Vec<String> = module.iter().cloned().chain([stem]).collect();
                collect(&path, &inner, one_crate, out);
            }
        } else if path.extension().is_some_and(|e| e == "rs") && stem != "tests" {
            let mut name = module.to_vec();
            if !matches!(stem.as_str(), "mod" | "lib" | "main") {
                name.push(stem);
            }
            let text = std::fs::read_to_string(&path).expect("the file was listed");
            let tokens = without_tests(&tokens(&text));
            let crate_root: Vec<String> = match one_crate {
                true => Vec::new(),
                false => name.first().cloned().into_iter().collect(),
            };
            let paths = paths(&tokens, &name, &crate_root);
            out.push(File {
                path,
                module: name,
                tokens,
                paths,
                crate_root,
            });
        }
    }
}

/// Names that `mod.rs` files re-export from their own submodules: (module, name) → submodule.
pub fn reexports(files: &[File]) -> BTreeMap<(String, String), Vec<String>> {
    let mut out = BTreeMap::new();
    for f in files.iter().filter(|f| f.path.ends_with("mod.rs")) {
        let t = &f.tokens;
        for i in 0..t.len() {
            if word(t.get(i)) == Some("pub")
                && word(t.get(i + 1)) == Some("use")
                && !matches!(word(t.get(i + 2)), Some("crate" | "super" | "std"))
            {
                for found in read_use(f, i + 2, &f.module) {
                    if let Some(name) = found.path.last() {
                        out.insert((f.module.join("::"), name.clone()), found.path);
                    }
                }
            }
        }
    }
    out
}

/// The paths of the `use` whose first word is token `i`, below `prefix`.
fn read_use(file: &File, i: usize, prefix: &[String]) -> Vec<Use> {
    let tree = Tree {
        t: &file.tokens,
        here: file.module.clone(),
        crate_root: &file.crate_root,
    };
    let mut out = Vec::new();
    tree.read(i, prefix, &mut out);
    out
}

/// The use of names between files.
pub struct Graph {
    /// Paths of the files, from the root of the repository.
    pub names: Vec<String>,
    /// For each file, those whose names it uses.
    pub uses: Vec<BTreeSet<usize>>,
    /// For each file, the one whose module it is directly below.
    pub parents: Vec<Option<usize>>,
}

/// Modules, and the names that they import or re-export.
struct Names {
    /// Files by module.
    files: BTreeMap<Vec<String>, usize>,
    /// (Module, name) → path.
    imported: BTreeMap<(Vec<String>, String), Vec<String>>,
    /// Module → modules whose names it re-exports with `*`.
    globs: BTreeMap<Vec<String>, Vec<Vec<String>>>,
    /// (Module, name) of every item.
    defined: BTreeSet<(Vec<String>, String)>,
}

impl Names {
    fn of(files: &[File]) -> Self {
        let mut out = Self {
            files: BTreeMap::new(),
            imported: BTreeMap::new(),
            globs: BTreeMap::new(),
            defined: BTreeSet::new(),
        };
        for (i, f) in files.iter().enumerate() {
            out.files.insert(f.module.clone(), i);
        }
        for f in files {
            out.read(f);
        }
        out
    }

    /// Whether `name` is a module below `module` with a file of its own.
    fn is_child(&self, module: &[String], name: &str) -> bool {
        let child: Vec<String> = module.iter().cloned().chain([name.to_owned()]).collect();
        self.files.contains_key(&child)
    }

    fn read(&mut self, f: &File) {
        let t = &f.tokens;
        for i in 0..t.len() {
            match word(t.get(i)) {
                Some("use") => {
                    let Some(first) = word(t.get(i + 1)) else {
                        continue;
                    };
                    let known =
                        matches!(first, "crate" | "super" | "self") || part(first).is_some();
                    let prefix: &[String] = match known {
                        true => &[],
                        false if self.is_child(&f.module, first) => &f.module,
                        false => continue,
                    };
                    for found in read_use(f, i + 1, prefix) {
                        if found.glob {
                            let all = self.globs.entry(f.module.clone()).or_default();
                            all.push(found.path);
                        } else {
                            let key = (f.module.clone(), found.name);
                            self.imported.insert(key, found.path);
                        }
                    }
                }
                Some(
                    "struct" | "enum" | "trait" | "type" | "fn" | "const" | "static"
                    | "macro_rules",
                ) => {
                    let at = if sign(t.get(i + 1), '!') {
                        i + 2
                    } else {
                        i + 1
                    };
                    if let Some(name) = word(t.get(at)) {
                        self.defined.insert((f.module.clone(), name.to_owned()));
                    }
                }
                _ => {}
            }
        }
    }

    /// The longest module with a file of its own with which `path` begins.
    fn module(&self, path: &[String]) -> Option<usize> {
        (1..=path.len())
            .rev()
            .find(|n| self.files.contains_key(&path[..*n]))
    }

    /// The file that defines the item at `path`; `None` for a module, and for names from elsewhere.
    fn defines(&self, path: &[String]) -> Option<usize> {
        let mut path = path.to_vec();
        for _ in 0..12 {
            let n = self.module(&path)?;
            let (module, rest) = path.split_at(n);
            let name = rest.first()?;
            let key = (module.to_vec(), name.clone());
            if let Some(to) = self.imported.get(&key)
                && *to != path
            {
                path = to.iter().chain(&rest[1..]).cloned().collect();
                continue;
            }
            let presented = self.globs.get(module).into_iter().flatten();
            let from = presented.filter_map(|g| {
                let n = self.module(g)?;
                (n == g.len() && self.defined.contains(&(g.clone(), name.clone()))).then_some(g)
            });
            if !self.defined.contains(&key)
                && let Some(g) = from.into_iter().next()
            {
                path = g.iter().chain(rest).cloned().collect();
                continue;
            }
            return self.files.get(module).copied();
        }
        None
    }
}

/// Reads the use of names between files.
pub fn graph(root: &Path) -> Graph {
    let files = files(root);
    let names = Names::of(&files);
    let mut out = Graph {
        names: Vec::new(),
        uses: Vec::new(),
        parents: Vec::new(),
    };
    for (i, f) in files.iter().enumerate() {
        let here = |w: &str| (f.module.clone(), w.to_owned());
        let absolute = f.paths.iter().cloned();
        // Paths that begin at a name which this file imports, or at a module below it.
        let begins = |w: &str| {
            !matches!(w, "crate" | "super" | "self")
                && part(w).is_none()
                && (names.is_child(&f.module, w) || names.imported.contains_key(&here(w)))
        };
        let relative = uses_that(&f.tokens, &f.module, &f.crate_root, &begins);
        let relative = relative.into_iter().map(|found| {
            let start = match names.imported.get(&here(&found.path[0])) {
                Some(to) => to.clone(),
                None => f.module.iter().chain(&found.path[..1]).cloned().collect(),
            };
            start
                .into_iter()
                .chain(found.path.into_iter().skip(1))
                .collect()
        });
        let paths = absolute.chain(relative);
        let used: BTreeSet<usize> = paths
            .filter_map(|p: Vec<String>| names.defines(&p))
            .collect();
        let parent = (f.module.len() > 1).then(|| &f.module[..f.module.len() - 1]);
        let relative = f.path.strip_prefix(root).unwrap_or(&f.path);
        out.names.push(relative.to_string_lossy().into_owned());
        out.uses
            .push(used.into_iter().filter(|to| *to != i).collect());
        out.parents
            .push(parent.and_then(|p| names.files.get(p).copied()));
    }
    out
}

impl Graph {
    /// Circles: groups of files in which each uses all the others, directly or through others; the largest first.
    ///
    /// A module is composed of the modules below it and may use them, and they may use its definitions. So the use of a
    /// module below does not close a circle, except one that leaves the module: `a` uses `b`, `b` uses `b::c` below it,
    /// and `b::c` uses `a`.
    pub fn circles(&self) -> Vec<Vec<usize>> {
        let count = self.names.len();
        let outwards = |from: usize| {
            let uses = self.uses[from].iter().copied();
            uses.filter(|to| !self.is_below(*to, from)).collect()
        };
        let outwards: Vec<Vec<usize>> = (0..count).map(outwards).collect();
        let reached: Vec<Vec<bool>> = (0..count).map(|i| reach(&outwards, i, None)).collect();
        let mut tied: Vec<Vec<usize>> = Vec::new();
        for i in (0..count).filter(|i| reached[*i][*i]) {
            let both = |j: &usize| reached[i][*j] && reached[*j][i];
            tied.push((0..count).filter(both).collect());
        }
        for above in 0..count {
            for below in self.uses[above]
                .iter()
                .filter(|b| self.is_below(**b, above))
            {
                let on_the_way = reach(&outwards, *below, Some(above));
                let between = |j: &usize| (j == below || on_the_way[*j]) && reached[*j][above];
                let between: Vec<usize> = (0..count).filter(between).collect();
                let leaves = |j: &usize| *j != above && !self.is_below(*j, above);
                if between.iter().any(leaves) {
                    tied.push(between.into_iter().chain([above]).collect());
                }
            }
        }
        let mut out: Vec<BTreeSet<usize>> = Vec::new();
        for group in tied {
            let mut group: BTreeSet<usize> = group.into_iter().collect();
            out.retain(|o| {
                let shares = !o.is_disjoint(&group);
                if shares {
                    group.extend(o);
                }
                !shares
            });
            out.push(group);
        }
        let mut out: Vec<Vec<usize>> = out.into_iter().map(|c| c.into_iter().collect()).collect();
        out.sort_by_key(|c| (std::cmp::Reverse(c.len()), c[0]));
        out
    }

    /// Whether a module lies below another one.
    fn is_below(&self, module: usize, above: usize) -> bool {
        let mut at = self.parents[module];
        while let Some(parent) = at {
            if parent == above {
                return true;
            }
            at = self.parents[parent];
        }
        false
    }
}

/// The files that `from` uses, directly or through others, but not through `without`.
fn reach(uses: &[Vec<usize>], from: usize, without: Option<usize>) -> Vec<bool> {
    let mut seen = vec![false; uses.len()];
    let mut open = vec![from];
    while let Some(i) = open.pop() {
        for to in &uses[i] {
            if Some(*to) != without && !std::mem::replace(&mut seen[*to], true) {
                open.push(*to);
            }
        }
    }
    seen
}
