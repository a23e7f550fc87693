//! Goal: the source of planning and tracking can be held in mind. Method: the same measure that `cargo run --example
//! house` prints is held to its limits, and the page of parameters to their declarations.

#[path = "../../tools/parameters/page.rs"]
mod page;

use sinew_source::{FIELDS, Item, PARAMETERS, Source, sources};
use std::path::Path;

/// Tunable numbers of locomotion. They may only become fewer; the goal is 250.
const TUNABLE: usize = 453;
/// Numeric constants of locomotion that are not in a params module: capacities, indices, series. The goal is 0.
const ELSEWHERE: usize = 32;
/// Most decision records.
const DECISIONS: usize = 20;

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn said(items: &[&Item]) -> String {
    let line = |i: &&Item| format!("{} {} ({})", i.place, i.name, i.count);
    items.iter().map(line).collect::<Vec<_>>().join("\n")
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
    let all = sources(root());
    let functions = all.iter().flat_map(|s| &s.functions);
    let many: Vec<&Item> = functions.filter(|f| f.count > PARAMETERS).collect();
    assert!(
        many.is_empty(),
        "more than {PARAMETERS} parameters:\n{}",
        said(&many)
    );
}

#[test]
fn tunable_numbers_are_declared_in_params_modules() {
    let all = sources(root());
    let house = |s: &&Source| s.is_locomotion() && !s.has_params();
    let strays: Vec<&Item> = all
        .iter()
        .filter(house)
        .flat_map(|s| &s.constants)
        .collect();
    let elsewhere: usize = strays.iter().map(|s| s.count).sum();
    assert!(
        elsewhere <= ELSEWHERE,
        "not in a params module:\n{}",
        said(&strays)
    );
    let count: usize = all
        .iter()
        .filter(|s| s.is_locomotion())
        .flat_map(|s| &s.constants)
        .map(|c| c.count)
        .sum();
    assert!(count <= TUNABLE, "{count} tunable numbers");
}

#[test]
fn parameters_say_what_they_are() {
    for (part, groups) in page::parts() {
        for p in groups.iter().flat_map(|(_, all)| *all) {
            let [low, high] = p.range;
            assert!(
                low <= p.value && p.value <= high,
                "{part} {}: {} is outside {low} to {high}",
                p.name,
                p.value
            );
            assert!(
                ![p.unit, p.what.trim(), p.source].contains(&""),
                "{part} {}: unit, text or source is missing",
                p.name
            );
        }
    }
}

#[test]
fn the_page_of_parameters_is_of_this_source() {
    let page = std::fs::read_to_string(root().join("docs/parameters.md")).unwrap();
    assert!(
        page == page::page(),
        "write it anew: cargo run --example parameters > docs/parameters.md"
    );
}

#[test]
fn decision_records_are_few() {
    let count = sinew_source::decisions(root());
    assert!(count <= DECISIONS, "{count} decision records");
}
