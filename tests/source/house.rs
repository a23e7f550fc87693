//! Goal: the source stays small enough to understand. Method: the numbers that `cargo run -p tools --bin house` prints
//! are held to limits that may only shrink.

use sinew_source::{FIELDS, Item, PARAMETERS, Source, decisions, measures, packages, sources};
use std::path::Path;

/// A measure and its limit. A change that improves a number lowers its limit.
struct Limit {
    /// Its name, as in [`measures`].
    measure: &'static str,
    /// Largest accepted number.
    limit: usize,
    /// The number to reach.
    goal: usize,
}

const fn limit(measure: &'static str, limit: usize, goal: usize) -> Limit {
    Limit {
        measure,
        limit,
        goal,
    }
}

/// In the order of [`measures`].
const LIMITS: &[Limit] = &[
    limit("links of cargo test", 14, 14),
    limit("crates of the physics, by the lock file", 32, 30),
    limit("circles of files", 0, 0),
    limit("files in the largest circle", 0, 0),
    limit("modules directly below figure", 9, 9),
    limit("reused names of types", 19, 19),
    limit("tuple parameters of plan, figure and reference", 0, 0),
    limit("tuple parameters", 70, 60),
    limit("tunable numbers of locomotion", 451, 250),
    limit("numbers of locomotion outside a params module", 32, 0),
    limit("words of documents written by hand", 50_900, 45_000),
    limit("words of documents written by commands", 18_430, 15_000),
    limit("sentences that begin with \"What\" as a noun", 1, 0),
    limit("who, whoever, nobody", 8, 0),
    limit("True if", 0, 0),
    limit("so many, so far", 2, 0),
    limit("goes over, goes on", 1, 0),
    limit("anew", 0, 0),
    limit("meanwhile", 0, 0),
    limit("False if it cannot be", 0, 0),
];

/// Most decision records.
const DECISIONS: usize = 20;

/// Crates of the network and of its storage: the physics needs none of them.
const NETWORK: &[&str] = &[
    "axum",
    "http",
    "hyper",
    "mio",
    "prost",
    "rusqlite",
    "rustls",
    "serde_json",
    "socket2",
    "tokio",
    "tonic",
    "tower",
    "tracing",
];

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn said(items: &[&Item]) -> String {
    let line = |i: &&Item| format!("{} {} ({})", i.place, i.name, i.count);
    items.iter().map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn measures_are_within_their_limits() {
    let found = measures(root());
    let names: Vec<&str> = found.iter().map(|(name, _)| *name).collect();
    let limited: Vec<&str> = LIMITS.iter().map(|l| l.measure).collect();
    assert_eq!(names, limited, "each measure has a limit");
    let over: Vec<String> = LIMITS
        .iter()
        .zip(&found)
        .filter(|(l, (_, n))| *n > l.limit)
        .map(|(l, (name, n))| format!("{name}: {n}, at most {} (goal: {})", l.limit, l.goal))
        .collect();
    assert!(
        over.is_empty(),
        "`cargo run -p tools --bin house` lists what counts:\n{}",
        over.join("\n")
    );
}

#[test]
fn limits_are_not_below_their_goals() {
    for l in LIMITS {
        assert!(l.goal <= l.limit, "{}", l.measure);
    }
}

#[test]
fn the_physics_needs_no_crate_of_the_network() {
    let crates = packages::closure(root(), "src/sim");
    assert!(
        crates.contains("nalgebra"),
        "the lock file was read: {crates:?}"
    );
    let strays: Vec<&String> = crates
        .iter()
        .filter(|c| {
            let begins = |n: &&str| {
                c.strip_prefix(*n)
                    .is_some_and(|r| r.is_empty() || r.starts_with(['-', '_']))
            };
            NETWORK.iter().any(begins)
        })
        .collect();
    assert!(strays.is_empty(), "{strays:?}");
}

#[test]
fn types_have_few_fields() {
    let all = sources(root());
    let house = all.iter().filter(|s| s.is_of_the_house());
    let large: Vec<&Item> = house
        .flat_map(|s| &s.types)
        .filter(|t| t.count > FIELDS)
        .collect();
    assert!(
        large.is_empty(),
        "more than {FIELDS} fields:\n{}",
        said(&large)
    );
}

#[test]
fn functions_have_few_parameters() {
    let all: Vec<Source> = sources(root());
    let functions = all.iter().flat_map(|s| &s.functions);
    let many: Vec<&Item> = functions.filter(|f| f.count > PARAMETERS).collect();
    assert!(
        many.is_empty(),
        "more than {PARAMETERS} parameters:\n{}",
        said(&many)
    );
}

#[test]
fn decision_records_are_few() {
    let count = decisions(root());
    assert!(count <= DECISIONS, "{count} decision records");
}

#[test]
fn turns_of_phrase_are_found_in_comments_only() {
    use sinew_source::words::{comments, patterns};
    // The comment signs are inserted later, so that these lines are not counted.
    let source = [
        "##/ What is kept. True if somebody",
        "##/ who moves goes on so far. What is it?",
        "let nobody = 1; ## meanwhile, nobody is written anew",
    ];
    let found = comments(&source.join("\n").replace("##", "//"));
    assert_eq!(found.len(), 2);
    assert_eq!(patterns(&found[0]), [1, 1, 1, 1, 1, 0, 0, 0]);
    assert_eq!(patterns(&found[1]), [0, 1, 0, 0, 0, 1, 1, 0]);
}
