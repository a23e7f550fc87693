//! The import table of the architecture, read from the source.
//!
//! Goal: a module uses only what lies to its right in the table below, and the physics names nothing of network, clock,
//! files or platform mathematics. Method: a small reader of Rust tokens resolves every path that starts with `crate`,
//! `super`, `self` or one of our crates (imports, re-exports and paths in code alike) to a module, and looks the pair up. Test
//! modules are left out: they may look anywhere.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What each top-level part may use.
const PARTS: &[(&str, &[&str])] = &[
    ("cli", &["client", "server", "evaluate", "wire", "sim"]),
    ("client", &["wire", "sim"]),
    ("server", &["evaluate", "wire", "sim"]),
    ("evaluate", &["sim"]),
    ("wire", &["sim"]),
    ("sim", &[]),
];

/// Layers of the physics, from the left to the right; modules of one layer do not use each other. `contact` (the Newton
/// kernel of motors, limits and friction) lies right of `control`, because the modern controller is solved by the same
/// kernel. `setup`, `report` and `touch` are plain data: how a figure is set up, and what it says.
/// `saved` helps the derives of all of them to write a checkpoint.
const SIM: &[&[&str]] = &[
    &["world"],
    &["rehearsal"],
    &["figure"],
    &["track", "get_up"],
    &["control"],
    &["collide"],
    &["contact"],
    &["retarget"],
    &["plan"],
    &["support", "motion"],
    &["setup"],
    &["strength"],
    &["dynamics"],
    &["report"],
    &["touch"],
    &["body"],
    &["math", "params"],
    &["saved"],
];

/// Layers of the server, likewise.
const SERVER: &[&[&str]] = &[&["api"], &["worlds"], &["tick"], &["ingest", "fanout"]];

/// Words that the physics does not say: network, clock, disk, hash iteration.
const FORBIDDEN_IN_SIM: &[&str] = &[
    "tokio",
    "tonic",
    "prost",
    "tracing",
    "serde_json",
    "Instant",
    "SystemTime",
    "HashMap",
    "HashSet",
    "println",
    "eprintln",
    "unsafe",
];

/// Paths that the physics does not say.
const FORBIDDEN_PATHS_IN_SIM: &[&str] =
    &["std::fs", "std::net", "std::time", "std::io", "std::env"];

/// Platform functions whose last bit differs between systems; the kernels of a tick use `math::trig` instead.
const FORBIDDEN_METHODS_IN_TICK: &[&str] = &[
    "sin", "cos", "sin_cos", "tan", "asin", "acos", "atan", "atan2", "exp", "exp2", "ln", "log10",
    "log2", "powf", "hypot", "cbrt", "sinh", "cosh", "tanh", "mul_add",
];
/// Modules that run within a tick.
const TICK_MODULES: &[&str] = &[
    "sim::dynamics",
    "sim::support",
    "sim::control",
    "sim::contact",
    "sim::collide",
    "sim::figure",
    "sim::track",
    "sim::get_up",
    "sim::plan",
    "sim::rehearsal",
    "sim::world",
    "server::ingest",
    "server::tick",
];

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Word(String),
    Number,
    Sign(char),
}

/// Words and signs of Rust source; comments, strings and character literals are gone.
fn tokens(source: &str) -> Vec<Token> {
    let c: Vec<char> = source.chars().collect();
    let mut out = Vec::new();
    let mut i = 0;
    while i < c.len() {
        let next = c.get(i + 1).copied().unwrap_or(' ');
        match c[i] {
            '/' if next == '/' => {
                while i < c.len() && c[i] != '\n' {
                    i += 1;
                }
            }
            '/' if next == '*' => {
                let mut depth = 0;
                while i < c.len() {
                    let pair = (c[i], c.get(i + 1).copied().unwrap_or(' '));
                    if pair == ('/', '*') {
                        depth += 1;
                        i += 2;
                    } else if pair == ('*', '/') {
                        depth -= 1;
                        i += 2;
                        if depth == 0 {
                            break;
                        }
                    } else {
                        i += 1;
                    }
                }
            }
            '"' => i = after_string(&c, i + 1),
            '\'' => {
                // A character literal, or a lifetime.
                if next == '\\' {
                    i += 3;
                    while i < c.len() && c[i] != '\'' {
                        i += 1;
                    }
                    i += 1;
                } else if c.get(i + 2) == Some(&'\'') {
                    i += 3;
                } else {
                    i += 1;
                }
            }
            x if x.is_alphabetic() || x == '_' => {
                let start = i;
                while i < c.len() && (c[i].is_alphanumeric() || c[i] == '_') {
                    i += 1;
                }
                let word: String = c[start..i].iter().collect();
                let hashes = c[i..].iter().take_while(|x| **x == '#').count();
                let quoted = c.get(i + hashes) == Some(&'"');
                match word.as_str() {
                    "r" | "br" | "cr" if quoted => i = after_raw_string(&c, i + hashes + 1, hashes),
                    "b" | "c" if quoted && hashes == 0 => i = after_string(&c, i + 1),
                    _ => out.push(Token::Word(word)),
                }
            }
            x if x.is_ascii_digit() => {
                while i < c.len()
                    && (c[i].is_alphanumeric()
                        || c[i] == '_'
                        || (c[i] == '.' && c.get(i + 1).is_some_and(char::is_ascii_digit)))
                {
                    i += 1;
                }
                out.push(Token::Number);
            }
            x => {
                if !x.is_whitespace() {
                    out.push(Token::Sign(x));
                }
                i += 1;
            }
        }
    }
    out
}

fn after_string(c: &[char], mut i: usize) -> usize {
    while i < c.len() && c[i] != '"' {
        i += if c[i] == '\\' { 2 } else { 1 };
    }
    i + 1
}

fn after_raw_string(c: &[char], mut i: usize, hashes: usize) -> usize {
    while i < c.len() {
        if c[i] == '"'
            && c[i + 1..]
                .iter()
                .take(hashes)
                .filter(|x| **x == '#')
                .count()
                == hashes
        {
            return i + 1 + hashes;
        }
        i += 1;
    }
    i
}

fn word(t: Option<&Token>) -> Option<&str> {
    match t {
        Some(Token::Word(w)) => Some(w),
        _ => None,
    }
}

fn sign(t: Option<&Token>, c: char) -> bool {
    t == Some(&Token::Sign(c))
}

/// Index just after the bracket that closes the one at `open`.
fn after_block(t: &[Token], open: usize) -> usize {
    let mut depth = 0usize;
    for (k, token) in t.iter().enumerate().skip(open) {
        match token {
            Token::Sign('{' | '[' | '(') => depth += 1,
            Token::Sign('}' | ']' | ')') => {
                depth -= 1;
                if depth == 0 {
                    return k + 1;
                }
            }
            _ => {}
        }
    }
    t.len()
}

/// The same tokens without items marked `#[cfg(test)]`.
fn without_tests(t: &[Token]) -> Vec<Token> {
    let mut out = Vec::new();
    let mut i = 0;
    while i < t.len() {
        let is_test = sign(t.get(i), '#')
            && sign(t.get(i + 1), '[')
            && word(t.get(i + 2)) == Some("cfg")
            && sign(t.get(i + 3), '(')
            && word(t.get(i + 4)) == Some("test")
            && sign(t.get(i + 5), ')');
        if !is_test {
            out.push(t[i].clone());
            i += 1;
            continue;
        }
        i = after_block(t, i + 1);
        while sign(t.get(i), '#') {
            i = after_block(t, i + 1);
        }
        // The item ends with its block, or with a semicolon.
        while i < t.len() && !sign(t.get(i), ';') && !sign(t.get(i), '{') {
            i = if sign(t.get(i), '(') || sign(t.get(i), '[') {
                after_block(t, i)
            } else {
                i + 1
            };
        }
        i = if sign(t.get(i), '{') {
            after_block(t, i)
        } else {
            i + 1
        };
    }
    out
}

/// Every path of a file that begins at the crate, as words from the part on. `module` is the file's own module.
fn paths(t: &[Token], module: &[String]) -> Vec<Vec<String>> {
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
                if (matches!(w.as_str(), "crate" | "super" | "self") || part(w).is_some())
                    && sign(t.get(i + 1), ':')
                    && sign(t.get(i + 2), ':')
                    && !(i >= 1 && sign(t.get(i - 1), ':')) =>
            {
                let here: Vec<String> = module
                    .iter()
                    .cloned()
                    .chain(inner.iter().map(|(n, _)| n.clone()))
                    .collect();
                i = tree(t, i, &here, &[], &mut out);
                continue;
            }
            _ => {}
        }
        i += 1;
    }
    out
}

/// The part that a crate is, by its name in code.
fn part(krate: &str) -> Option<&'static str> {
    Some(match krate {
        "sinew_physics" => "sim",
        "sinew_evaluate" => "evaluate",
        "sinew_wire" => "wire",
        "sinew_client" => "client",
        "sinew_server" => "server",
        _ => return None,
    })
}

/// Reads one path, or a brace-group of them, from token `i` on; returns the index after it.
fn tree(
    t: &[Token],
    mut i: usize,
    here: &[String],
    prefix: &[String],
    out: &mut Vec<Vec<String>>,
) -> usize {
    let mut path = prefix.to_vec();
    let mut started = !prefix.is_empty();
    loop {
        match t.get(i) {
            Some(Token::Word(w)) => {
                match w.as_str() {
                    "crate" if !started => path.extend(here.first().cloned()),
                    w if !started && part(w).is_some() => path.extend(part(w).map(str::to_owned)),
                    "self" if !started => path = here.to_vec(),
                    "super" => {
                        if !started {
                            path = here.to_vec();
                        }
                        path.pop();
                    }
                    "self" => {}
                    w => path.push(w.to_owned()),
                }
                started = true;
                i += 1;
            }
            Some(Token::Sign('*')) => i += 1,
            Some(Token::Sign('{')) => {
                let end = after_block(t, i);
                i += 1;
                while i + 1 < end {
                    i = tree(t, i, here, &path, out);
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
            // `::<` begins type arguments: the path is over.
            if sign(t.get(i), '<') {
                break;
            }
        } else {
            break;
        }
    }
    out.push(path);
    i.max(1)
}

struct File {
    path: PathBuf,
    module: Vec<String>,
    tokens: Vec<Token>,
    paths: Vec<Vec<String>>,
}

fn root() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn collect(dir: &Path, module: &[String], out: &mut Vec<File>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(dir)
        .unwrap()
        .map(|e| e.unwrap().path())
        .collect();
    entries.sort();
    for path in entries {
        let stem = path.file_stem().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() {
            // Generated code follows its generator.
            if stem != "gen" {
                let inner: Vec<String> = module.iter().cloned().chain([stem]).collect();
                collect(&path, &inner, out);
            }
        } else if path.extension().is_some_and(|e| e == "rs") {
            let mut name = module.to_vec();
            if stem == "tests" {
                continue;
            }
            if !matches!(stem.as_str(), "mod" | "lib" | "main") {
                name.push(stem);
            }
            let tokens = without_tests(&tokens(&std::fs::read_to_string(&path).unwrap()));
            let paths = paths(&tokens, &name);
            out.push(File {
                path,
                module: name,
                tokens,
                paths,
            });
        }
    }
}

fn files() -> Vec<File> {
    let mut out = Vec::new();
    collect(&root().join("src"), &[], &mut out);
    out
}

/// Names that `mod.rs` files re-export from their own submodules: (module, name) → submodule.
fn reexports(files: &[File]) -> BTreeMap<(String, String), Vec<String>> {
    let mut out = BTreeMap::new();
    for f in files.iter().filter(|f| f.path.ends_with("mod.rs")) {
        let t = &f.tokens;
        for i in 0..t.len() {
            if word(t.get(i)) == Some("pub")
                && word(t.get(i + 1)) == Some("use")
                && !matches!(word(t.get(i + 2)), Some("crate" | "super" | "std"))
            {
                let mut found = Vec::new();
                tree(t, i + 2, &f.module, &f.module, &mut found);
                for p in found {
                    if let Some(name) = p.last() {
                        out.insert((f.module.join("::"), name.clone()), p);
                    }
                }
            }
        }
    }
    out
}

/// The layer of `module` (words after the part's own name): the longest name of the table that it begins with.
fn layer(table: &[&[&str]], module: &[String]) -> Option<(usize, String)> {
    let full = module.join("::");
    let mut best: Option<(usize, String)> = None;
    for (rank, names) in table.iter().enumerate() {
        for name in *names {
            let inside = full == *name || full.starts_with(&format!("{name}::"));
            if inside && best.as_ref().is_none_or(|(_, b)| b.len() < name.len()) {
                best = Some((rank, (*name).to_owned()));
            }
        }
    }
    best
}

#[test]
fn parts_use_only_what_lies_to_their_right() {
    let mut wrong = Vec::new();
    for f in files() {
        let Some(from) = f.module.first() else {
            continue; // the crate root lists the parts
        };
        let Some((_, allowed)) = PARTS.iter().find(|(p, _)| p == from) else {
            wrong.push(format!(
                "{}: part `{from}` is not in the table",
                f.path.display()
            ));
            continue;
        };
        for p in &f.paths {
            if let Some(to) = p.first()
                && to != from
                && PARTS.iter().any(|(n, _)| n == to)
                && !allowed.contains(&to.as_str())
            {
                wrong.push(format!(
                    "{}: {from} uses {}",
                    f.path.display(),
                    p.join("::")
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn check_layers(part: &str, table: &[&[&str]]) {
    let files = files();
    let names = reexports(&files);
    let mut wrong = Vec::new();
    for f in files
        .iter()
        .filter(|f| f.module.first().is_some_and(|m| m == part))
    {
        if f.module.len() < 2 {
            continue; // the part's own mod.rs lists its modules
        }
        let Some((rank, from)) = layer(table, &f.module[1..]) else {
            if part == "sim" {
                wrong.push(format!("{}: not in the table", f.path.display()));
            }
            continue; // server: config, auth, telemetry and the like are used by any
        };
        // A directory's mod.rs presents its submodules, also those of another layer.
        let presents = f.path.ends_with("mod.rs") && f.module.len() == 2;
        for p in f
            .paths
            .iter()
            .filter(|p| p.first().is_some_and(|m| m == part) && p.len() > 1)
        {
            let mut p = p.clone();
            for k in 2..p.len() {
                if let Some(full) = names.get(&(p[..k].join("::"), p[k].clone())) {
                    p = full.clone();
                    break;
                }
            }
            if presents && p[1] == f.module[1] {
                continue;
            }
            if let Some((other, to)) = layer(table, &p[1..])
                && to != from
                && other <= rank
            {
                wrong.push(format!(
                    "{}: {from} uses {}",
                    f.path.display(),
                    p.join("::")
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn layers_of_the_physics_use_only_what_lies_to_their_right() {
    check_layers("sim", SIM);
}

#[test]
fn layers_of_the_server_use_only_what_lies_to_their_right() {
    check_layers("server", SERVER);
}

#[test]
fn the_physics_names_no_network_clock_or_file() {
    let mut wrong = Vec::new();
    for f in files() {
        if f.module.first().is_none_or(|m| m != "sim") {
            continue;
        }
        for (i, t) in f.tokens.iter().enumerate() {
            let Token::Word(w) = t else { continue };
            if FORBIDDEN_IN_SIM.contains(&w.as_str()) {
                wrong.push(format!("{}: {w}", f.path.display()));
            }
            if w == "std" && sign(f.tokens.get(i + 1), ':') {
                let mut found = Vec::new();
                tree(&f.tokens, i, &[], &[], &mut found);
                for p in found {
                    let p = p.join("::");
                    if FORBIDDEN_PATHS_IN_SIM
                        .iter()
                        .any(|b| p == *b || p.starts_with(&format!("{b}::")))
                    {
                        wrong.push(format!("{}: {p}", f.path.display()));
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_tick_calls_no_platform_mathematics() {
    let mut wrong = Vec::new();
    for f in files() {
        let module = f.module.join("::");
        if !TICK_MODULES
            .iter()
            .any(|m| module == *m || module.starts_with(&format!("{m}::")))
        {
            continue;
        }
        for i in 1..f.tokens.len() {
            if let Token::Word(w) = &f.tokens[i]
                && sign(f.tokens.get(i + 1), '(')
                && FORBIDDEN_METHODS_IN_TICK.contains(&w.as_str())
                && (sign(f.tokens.get(i - 1), '.')
                    || word(f.tokens.get(i.wrapping_sub(3))) == Some("f64"))
            {
                wrong.push(format!("{}: {w}()", f.path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_reader_of_this_test_sees_what_it_should() {
    let source = r##"
        //! use sinew_wire::x;
        use crate::{body::{self, Links as L}, math::*};
        use super::model::Body; use sinew_wire::pb; /* sinew_server::a */
        const S: &str = "sinew_wire::y"; const R: &str = r#"crate::"wire"#; const C: char = '"';
        mod ids { pub use super::SegmentId; }
        fn f<'a>() -> crate::dynamics::Terms { super::super::world::step::<f64>(); 1.0.sin() }
        #[cfg(test)] mod tests { use sinew_server::z; }
    "##;
    let module = ["sim", "body", "links"].map(str::to_owned);
    let found: Vec<String> = paths(&without_tests(&tokens(source)), &module)
        .iter()
        .map(|p| p.join("::"))
        .collect();
    assert_eq!(
        found,
        [
            "sim::body",
            "sim::body::Links",
            "sim::math",
            "sim::body::model::Body",
            "wire::pb",
            "sim::body::links::SegmentId",
            "sim::dynamics::Terms",
            "sim::world::step",
        ]
    );
    let module = ["figure", "tick", "state"].map(str::to_owned);
    assert_eq!(layer(SIM, &module).unwrap().1, "figure");
}
