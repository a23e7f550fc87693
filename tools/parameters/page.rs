//! The page of tunable numbers, from their declarations.

use sinew_physics::params::Param;
use sinew_physics::{figure, get_up, plan, retarget, track};
use std::fmt::Write;

/// Groups of parameters of a part of the house, with its module.
pub fn parts() -> Vec<(&'static str, Vec<(&'static str, &'static [Param])>)> {
    vec![
        ("sim::retarget", retarget::params::groups().to_vec()),
        ("sim::plan", plan::params::groups().to_vec()),
        ("sim::track", track::params::groups().to_vec()),
        ("sim::get_up", get_up::params::groups().to_vec()),
        ("sim::figure", figure::params::groups().to_vec()),
    ]
}

/// `docs/parameters.md`.
pub fn page() -> String {
    let parts = parts();
    let count: usize = parts
        .iter()
        .flat_map(|(_, groups)| groups)
        .map(|(_, all)| all.len())
        .sum();
    let mut out = format!(
        "# Parameters\n\nAll {count} tunable numbers of planning and tracking, written from their declarations by\n\
         `cargo run --example parameters > docs/parameters.md`. The range is where the code that uses a number still \
         makes\nsense. A source is a publication, a derivation, a numerical tolerance, or the section of\n\
         [locomotion.md](locomotion.md) that speaks of it; what a change of it does, `sinew survey tests/corpus --out\n\
         new.json --compare old.json` shows.\n"
    );
    for (part, groups) in parts {
        for (group, all) in groups {
            let _ = write!(
                out,
                "\n## `{part}::params::{group}`\n\n| name | value | unit | range | what | source |\n\
                 |---|---|---|---|---|---|\n"
            );
            for p in all {
                let [low, high] = p.range;
                let what = p.what.split_whitespace().collect::<Vec<_>>().join(" ");
                let _ = writeln!(
                    out,
                    "| `{}` | {} | {} | {low} – {high} | {what} | {} |",
                    p.name, p.value, p.unit, p.source
                );
            }
        }
    }
    out
}
