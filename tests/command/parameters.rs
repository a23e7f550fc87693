//! Goal: `sinew parameters` lists every tunable number of the physics. Method: its three forms are compared with the
//! declarations and with each other.

use std::process::{Command, Output};

fn sinew(args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_sinew"));
    command.arg("parameters").args(args).output().unwrap()
}

fn said(args: &[&str]) -> String {
    let out = sinew(args);
    let error = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.success(), "{args:?}: {error}");
    String::from_utf8(out.stdout).unwrap()
}

fn json(args: &[&str]) -> Vec<serde_json::Value> {
    serde_json::from_str(&said(args)).unwrap()
}

#[test]
fn every_declared_number_is_listed_with_all_that_is_known_about_it() {
    let listed = json(&["--json"]);
    let declared = sinew_physics::parameters();
    let declared: Vec<_> = declared
        .iter()
        .flat_map(|g| g.all.iter().map(move |p| (g, p)))
        .collect();
    assert_eq!(listed.len(), declared.len());
    for (row, (group, p)) in listed.iter().zip(declared) {
        assert_eq!(row["name"], p.name);
        assert_eq!(row["module"], group.module());
        assert_eq!(row["value"], p.value);
        assert_eq!(row["unit"], p.unit);
        assert_eq!([&row["min"], &row["max"]], [&p.range[0], &p.range[1]]);
        assert_eq!(row["source"], p.source);
        assert!(!row["what"].as_str().unwrap().is_empty());
    }
}

#[test]
fn a_text_selects_numbers_in_all_forms() {
    let all = json(&["--json"]).len();
    let name = "settling_time";
    let rows = json(&["--json", name]);
    assert!(!rows.is_empty() && rows.len() < all);
    let table = said(&["--table", name]);
    assert_eq!(table.lines().count(), 2 + rows.len());
    let text = said(&[name]);
    for row in rows {
        let name = row["name"].as_str().unwrap();
        assert!(table.contains(name) && text.contains(&format!("{name} = {}", row["value"])));
    }
}

#[test]
fn a_text_that_no_number_contains_is_an_error() {
    let out = sinew(&["no such number"]);
    assert_eq!(out.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&out.stderr).contains("no such number"));
}
