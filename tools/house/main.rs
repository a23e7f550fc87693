//! Measures the house: `cargo run -p tools --bin house [-- [--json] [FOLDER]]` prints sizes, tunable numbers, circles,
//! duplicates and turns of phrase of the source.
//!
//! `FOLDER` is another checkout, to compare with. `tests/source/house.rs` holds the numbers to their limits.

use serde_json::{Map, Value};
use sinew_source::{
    FIELDS, Item, PARAMETERS, Source, decisions, imports, measures, packages, reused_names,
    sources, submodules_of_figure,
};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Functions that decide from positions, speeds or forces which foot stands, under their present and earlier names. A
/// new one has to be added here.
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

/// A number, and the items that it counts.
struct Line {
    name: String,
    count: usize,
    items: Vec<String>,
}

fn line(name: &str, items: Vec<String>) -> Line {
    Line {
        name: name.to_owned(),
        count: items.len(),
        items,
    }
}

fn number(name: &str, count: usize) -> Line {
    Line {
        name: name.to_owned(),
        count,
        items: Vec::new(),
    }
}

fn said(items: impl IntoIterator<Item = impl std::borrow::Borrow<Item>>) -> Vec<String> {
    let text = |i: &Item| format!("{} {} ({})", i.place, i.name, i.count);
    items.into_iter().map(|i| text(i.borrow())).collect()
}

fn main() {
    let mut json = false;
    let mut root = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    for argument in std::env::args().skip(1) {
        match argument.as_str() {
            "--json" => json = true,
            folder => root = PathBuf::from(folder),
        }
    }
    let lines = house(&root);
    if json {
        let all: Map<String, Value> = lines
            .into_iter()
            .map(|l| (l.name, l.count.into()))
            .collect();
        println!("{:#}", Value::Object(all));
        return;
    }
    for line in lines {
        println!("{:>7}  {}", line.count, line.name);
        for item in line.items {
            println!("             {item}");
        }
    }
}

fn house(root: &Path) -> Vec<Line> {
    let mut out: Vec<Line> = measures(root)
        .into_iter()
        .map(|(name, n)| number(name, n))
        .collect();
    if let Some(crates) = crates_of_the_physics(root) {
        out.push(line("crates of the physics, by cargo tree", crates));
    }
    let graph = imports::graph(root);
    for circle in graph.circles() {
        let files = circle.iter().map(|file| {
            let within = graph.uses[*file].iter().filter(|to| circle.contains(to));
            let within: Vec<&str> = within.map(|to| graph.names[*to].as_str()).collect();
            format!("{} uses {}", graph.names[*file], within.join(", "))
        });
        out.push(line("files in one circle", files.collect()));
    }
    out.push(line(
        "modules directly below figure, by name",
        submodules_of_figure(root),
    ));
    let names = reused_names(root);
    let names = names.iter().map(|(name, n)| format!("{name} ({n})"));
    out.push(line("reused names of types, by name", names.collect()));
    let all = sources(root);
    let tuples = all.iter().filter(|s| s.is_without_tuples());
    out.push(line(
        "tuple parameters of plan, figure and reference, by name",
        said(tuples.flat_map(|s| &s.tuples)),
    ));
    out.extend(sizes(&all));
    out.push(number("decision records", decisions(root)));
    out.push(number("lines wider than 120 columns", wide_lines(root)));
    out.push(number("packages in the lock file", packages::locked(root)));
    out
}

/// Sizes of the locomotion, and the number of things of which there should be only one.
fn sizes(all: &[Source]) -> Vec<Line> {
    let locomotion: Vec<&Source> = all.iter().filter(|s| s.is_locomotion()).collect();
    let labelling: Vec<&Source> = all
        .iter()
        .filter(|s| !s.module.starts_with("sim/figure") && !s.module.starts_with("sim/stepper"))
        .filter(|s| s.is_locomotion() || s.module == "server/engine")
        .collect();
    let sim: Vec<&Source> = all
        .iter()
        .filter(|s| s.module.starts_with("sim/"))
        .collect();
    let lines = |of: &[&Source]| of.iter().map(|s| s.lines).sum();
    let named = |sources: &[&Source], wanted: &dyn Fn(&str) -> bool| {
        let functions = sources.iter().flat_map(|s| &s.functions);
        said(functions.filter(|f| wanted(&f.name)))
    };
    let solver = |n: &str| {
        let begins = ["factor", "cholesky", "ldl", "eliminate"];
        n == "solve" || begins.iter().any(|w| n.starts_with(w))
    };
    let house = all.iter().filter(|s| s.is_of_the_house());
    let large = house.flat_map(|s| &s.types).filter(|t| t.count > FIELDS);
    let functions = all.iter().flat_map(|s| &s.functions);
    let many = functions.filter(|f| f.count > PARAMETERS);
    vec![
        number(
            "lines of code in src",
            lines(&all.iter().collect::<Vec<_>>()),
        ),
        number("lines of code of locomotion", lines(&locomotion)),
        number(
            "other numbers in the code of locomotion",
            locomotion.iter().map(|s| s.literals).sum(),
        ),
        line(
            "classifiers of contacts",
            named(&labelling, &|n| CLASSIFIERS.contains(&n)),
        ),
        line("convex hulls", named(&sim, &|n| n.contains("hull"))),
        line("linear solvers", named(&sim, &solver)),
        line(
            &format!("types with more than {FIELDS} fields"),
            said(large),
        ),
        line(
            &format!("functions with more than {PARAMETERS} parameters"),
            said(many),
        ),
    ]
}

/// The crates that `cargo tree` lists below the physics; `None` where the physics is no package.
fn crates_of_the_physics(root: &Path) -> Option<Vec<String>> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let arguments = [
        "tree",
        "--locked",
        "-p",
        "sinew-physics",
        "-e",
        "normal",
        "--prefix",
        "none",
    ];
    let tree = Command::new(cargo)
        .args(arguments)
        .current_dir(root)
        .output()
        .ok()?;
    if !tree.status.success() {
        return None;
    }
    let text = String::from_utf8_lossy(&tree.stdout);
    let names = text.lines().filter_map(|l| l.split_whitespace().next());
    let mut names: Vec<String> = names
        .filter(|n| *n != "sinew-physics")
        .map(str::to_owned)
        .collect();
    names.sort();
    names.dedup();
    Some(names)
}

fn wide_lines(root: &Path) -> usize {
    let script = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/..")).join("tests/width.sh");
    let wide = Command::new(script)
        .arg(root)
        .output()
        .expect("the script runs");
    wide.stdout.iter().filter(|c| **c == b'\n').count()
}
