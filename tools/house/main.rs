//! Measures the house: `cargo run --example house [-- FOLDER]` prints sizes, tunable numbers and duplicates of the
//! source.
//!
//! `FOLDER` is another checkout, to compare with. `tests/house.rs` holds the numbers to their limits.

use sinew_source::{FIELDS, Item, PARAMETERS, Source, decisions, sources};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Functions that decide from positions, speeds or forces which foot stands, under their names of now and before. A new
/// one has to be added here.
const CLASSIFIERS: &[&str] = &[
    "label_feet",
    "label_runs",
    "label",
    "touch",
    "carried",
    "supporting_feet",
    "relabel_prepared",
    "planted_between",
];

fn list(title: &str, items: &[&Item]) {
    println!("{title}: {}", items.len());
    for item in items {
        println!("    {} {} ({})", item.place, item.name, item.count);
    }
}

fn main() {
    let root = std::env::args().nth(1).map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/..")),
        PathBuf::from,
    );
    let all = sources(&root);
    let locomotion: Vec<&Source> = all.iter().filter(|s| s.is_locomotion()).collect();
    let house: Vec<&Source> = all.iter().filter(|s| s.is_of_the_house()).collect();
    let labelling: Vec<&Source> = all
        .iter()
        .filter(|s| !s.module.starts_with("sim/figure"))
        .filter(|s| s.is_locomotion() || s.module == "server/engine")
        .collect();
    let sim: Vec<&Source> = all
        .iter()
        .filter(|s| s.module.starts_with("sim/"))
        .collect();

    println!(
        "lines of code in src: {}",
        all.iter().map(|s| s.lines).sum::<usize>()
    );
    println!(
        "lines of code of locomotion: {}",
        locomotion.iter().map(|s| s.lines).sum::<usize>()
    );
    let numbers = |s: &Source| s.constants.iter().map(|c| c.count).sum::<usize>();
    println!(
        "tunable numbers of locomotion: {}",
        locomotion.iter().map(|s| numbers(s)).sum::<usize>()
    );
    let outside = locomotion
        .iter()
        .filter(|s| !s.has_params())
        .map(|s| numbers(s))
        .sum::<usize>();
    println!("    of these outside a params module: {outside}");
    println!(
        "    other numbers in its code: {}",
        locomotion.iter().map(|s| s.literals).sum::<usize>()
    );

    let named = |sources: &[&Source], wanted: &dyn Fn(&str) -> bool| -> Vec<Item> {
        let functions = sources.iter().flat_map(|s| &s.functions);
        functions.filter(|f| wanted(&f.name)).cloned().collect()
    };
    let show = |title: &str, items: &[Item]| list(title, &items.iter().collect::<Vec<_>>());
    show(
        "classifiers of contacts",
        &named(&labelling, &|n| CLASSIFIERS.contains(&n)),
    );
    show("convex hulls", &named(&sim, &|n| n.contains("hull")));
    show(
        "linear solvers",
        &named(&sim, &|n| {
            n == "solve"
                || ["factor", "cholesky", "ldl", "eliminate"]
                    .iter()
                    .any(|w| n.starts_with(w))
        }),
    );
    let types: Vec<&Item> = house
        .iter()
        .flat_map(|s| &s.types)
        .filter(|t| t.count > FIELDS)
        .collect();
    list(&format!("types with more than {FIELDS} fields"), &types);
    let functions: Vec<&Item> = all
        .iter()
        .flat_map(|s| &s.functions)
        .filter(|f| f.count > PARAMETERS)
        .collect();
    list(
        &format!("functions with more than {PARAMETERS} parameters"),
        &functions,
    );
    println!("decision records: {}", decisions(&root));
    let width = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/..")).join("tests/width.sh");
    let wide = Command::new(width)
        .arg(&root)
        .output()
        .expect("the script runs");
    let lines = wide.stdout.iter().filter(|c| **c == b'\n').count();
    println!("lines wider than 120 columns: {lines}");
}
