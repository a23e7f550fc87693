//! The import table of the architecture, read from the source.
//!
//! Goal: a module uses only what lies to its right in the table below, and the physics names nothing of network, clock,
//! files or platform mathematics. No files use each other in a circle. Method: a small reader of Rust tokens resolves
//! every path that starts with `crate`, `super`, `self` or one of our crates (imports, re-exports and paths in code
//! alike) to a module, and looks the pair up. Test modules are left out, because they may use anything.
//!
//! A parent may use the modules below it, and they may use its definitions, because a module is composed of those below
//! it. A circle consists of other files, such as two modules below one parent. Or it leaves the parent: a parent uses a
//! module below it, which uses a file elsewhere, which uses the parent.

use sinew_source::imports::{self, File, Graph, paths, reexports};
use sinew_source::tokens::{Token, sign, tokens, without_tests, word};
use std::path::PathBuf;

/// The parts that each top-level part may use.
const PARTS: &[(&str, &[&str])] = &[
    ("cli", &["client", "server", "evaluate", "wire", "sim"]),
    ("client", &["wire", "sim"]),
    ("server", &["wire", "sim"]),
    ("evaluate", &["sim"]),
    ("wire", &["sim"]),
    ("sim", &[]),
];

/// Files that use a part without permission. The list may only shrink.
const EXCEPTIONS: &[(&str, &str)] = &[];

/// Files that use each other in a circle. The list may only shrink.
const IN_CIRCLES: &[&str] = &[];

/// Layers of the physics, from left to right; modules of one layer do not use each other. `contact` (the Newton kernel
/// of motors, limits and friction) is to the right of `control`, because the modern controller is solved by the same
/// kernel. `setup`, `report` and `touch` are plain data: the setup of a figure and its output. `saved` helps the
/// derives of all of them to write a checkpoint.
const SIM: &[&[&str]] = &[
    &["rehearsal"],
    &["world"],
    &["figure"],
    &["paper"],
    &["track", "get_up"],
    &["stepper"],
    &["control"],
    &["collide"],
    &["contact"],
    &["plan", "forecast"],
    &["reference"],
    &["support", "motion"],
    &["setup"],
    &["tick_context"],
    &["strength"],
    &["dynamics"],
    &["report"],
    &["touch"],
    &["body"],
    &["math", "params", "time"],
    &["saved"],
];

/// Layers of the server, likewise.
const SERVER: &[&[&str]] = &[&["api"], &["worlds"], &["tick"], &["ingest", "fanout"]];

/// Words that the physics does not contain: network, clock, disk, hash iteration.
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

/// Paths that the physics does not contain.
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
    "sim::stepper",
    "sim::paper",
    "sim::figure",
    "sim::track",
    "sim::get_up",
    "sim::plan",
    "sim::rehearsal",
    "sim::world",
    "server::ingest",
    "server::tick",
];

fn root() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn files() -> Vec<File> {
    imports::files(&root())
}

/// The layer of `module` (words after the part's own name): the longest name in the table with which it begins.
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
                && !EXCEPTIONS
                    .iter()
                    .any(|(file, part)| f.path.ends_with(file) && part == to)
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
            continue; // server: any module may use config, auth, telemetry and the like
        };
        // A directory's mod.rs re-exports its submodules, also those of another layer.
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
        for t in &f.tokens {
            let Token::Word(w) = t else { continue };
            if FORBIDDEN_IN_SIM.contains(&w.as_str()) {
                wrong.push(format!("{}: {w}", f.path.display()));
            }
        }
        for p in imports::paths_of_std(&f.tokens) {
            let p = p.join("::");
            if FORBIDDEN_PATHS_IN_SIM
                .iter()
                .any(|b| p == *b || p.starts_with(&format!("{b}::")))
            {
                wrong.push(format!("{}: {p}", f.path.display()));
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
    let found: Vec<String> = paths(&without_tests(&tokens(source)), &module, &module[..1])
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

#[test]
fn no_files_use_each_other_in_a_circle() {
    let graph = imports::graph(&root());
    let named = |circle: &Vec<usize>| circle.iter().map(|f| graph.names[*f].clone()).collect();
    let circles: Vec<Vec<String>> = graph.circles().iter().map(named).collect();
    let new = |circle: &&Vec<String>| !circle.iter().all(|f| IN_CIRCLES.contains(&f.as_str()));
    let new: Vec<String> = circles.iter().filter(new).map(|c| c.join(", ")).collect();
    assert!(
        new.is_empty(),
        "`cargo run -p tools --bin house` says what uses what:\n{}",
        new.join("\n")
    );
}

#[test]
fn a_module_and_those_below_it_are_no_circle_but_others_are() {
    // 0: a/mod.rs, 1: a/b.rs, 2: a/c.rs, 3: d.rs
    let circles = |uses: &[(usize, usize)]| {
        let of = |i: usize| {
            uses.iter()
                .filter(|(from, _)| *from == i)
                .map(|(_, to)| *to)
                .collect()
        };
        let graph = Graph {
            names: ["a/mod.rs", "a/b.rs", "a/c.rs", "d.rs"]
                .map(str::to_owned)
                .to_vec(),
            uses: (0..4).map(of).collect(),
            parents: vec![None, Some(0), Some(0), None],
        };
        graph.circles()
    };
    assert!(circles(&[(0, 1), (1, 0)]).is_empty());
    assert!(circles(&[(0, 1), (1, 2), (2, 0)]).is_empty());
    assert!(circles(&[(0, 1), (1, 3)]).is_empty());
    assert_eq!(circles(&[(1, 2), (2, 1)]), [[1, 2]]);
    assert_eq!(circles(&[(0, 3), (3, 0)]), [[0, 3]]);
    assert_eq!(circles(&[(3, 0), (0, 1), (1, 3)]), [[0, 1, 3]]);
    assert_eq!(circles(&[(1, 3), (3, 1), (0, 1)]), [[1, 3]]);
}
