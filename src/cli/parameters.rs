//! `sinew parameters`: the tunable numbers of the physics, from their declarations.

use super::terminal::print;
use anyhow::{Context, Result};
use serde_json::json;
use sinew_physics::params::{Param, ParamGroup};

/// Lists the tunable numbers of planning, tracking and figures, with unit, range, meaning and source.
#[derive(Clone, Debug, clap::Args)]
pub struct ParametersArgs {
    /// Lists only numbers whose name, module, meaning or source contains this text; case does not matter.
    #[arg(value_name = "TEXT")]
    pub text: Option<String>,
    /// Prints JSON: an array of objects.
    #[arg(long, conflicts_with = "table")]
    pub json: bool,
    /// Prints one table in Markdown.
    #[arg(long)]
    pub table: bool,
}

/// Runs the command.
///
/// # Errors
/// No number contains the text, or standard output cannot be written.
pub fn run(args: &ParametersArgs) -> Result<()> {
    let text = args.text.as_deref().unwrap_or_default().to_lowercase();
    let all = sinew_physics::parameters();
    let found: Vec<(&ParamGroup, Vec<&Param>)> = all
        .iter()
        .map(|g| (g, g.all.iter().filter(|p| contains(g, p, &text)).collect()))
        .filter(|(_, of): &(_, Vec<_>)| !of.is_empty())
        .collect();
    anyhow::ensure!(!found.is_empty(), "no tunable number contains {text:?}");
    if args.json {
        let rows: Vec<_> = rows(&found).map(|(g, p)| as_json(g, p)).collect();
        let text = serde_json::to_string_pretty(&rows).context("the numbers cannot be written")?;
        print(&(text + "\n"))
    } else if args.table {
        print(&as_table(&found))
    } else {
        print(&as_text(&found))
    }
}

fn rows<'a>(
    found: &'a [(&ParamGroup, Vec<&Param>)],
) -> impl Iterator<Item = (&'a ParamGroup, &'a Param)> {
    found.iter().flat_map(|(g, of)| of.iter().map(|p| (*g, *p)))
}

fn contains(group: &ParamGroup, p: &Param, text: &str) -> bool {
    let module = group.module();
    [p.name, &module, p.what, p.source]
        .iter()
        .any(|t| t.to_lowercase().contains(text))
}

/// The meaning on one line.
fn meaning(p: &Param) -> String {
    p.what.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn as_json(group: &ParamGroup, p: &Param) -> serde_json::Value {
    json!({
        "name": p.name, "module": group.module(), "value": p.value, "unit": p.unit, "min": p.range[0],
        "max": p.range[1], "what": meaning(p), "source": p.source,
    })
}

fn as_text(found: &[(&ParamGroup, Vec<&Param>)]) -> String {
    let mut out = String::new();
    for (group, of) in found {
        out += &format!("{}\n", group.module());
        for p in of {
            let [low, high] = p.range;
            out += &format!(
                "    {} = {} {} ({low} to {high})\n",
                p.name, p.value, p.unit
            );
            out += &format!("        {} [{}]\n", meaning(p), p.source);
        }
    }
    out
}

fn as_table(found: &[(&ParamGroup, Vec<&Param>)]) -> String {
    let mut out = "| module | name | value | unit | range | meaning | source |\n".to_owned();
    out += "|---|---|---|---|---|---|---|\n";
    for (group, p) in rows(found) {
        let [low, high] = p.range;
        let meaning = meaning(p).replace('|', "\\|");
        out += &format!(
            "| `{}` | `{}` | {} | {} | {low} – {high} | {meaning} | {} |\n",
            group.module(),
            p.name,
            p.value,
            p.unit,
            p.source
        );
    }
    out
}
