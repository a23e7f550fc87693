//! `sinew config`: checks whether a server could start with its settings, and shows them.

use super::exit::usage;
use super::number::counted;
use super::serve;
use super::terminal::{note, print, print_line};
use sinew_server::config::check::problems;
use std::fmt::Write as _;

/// Arguments of `sinew config`.
#[derive(Clone, Debug, clap::Args)]
pub struct ConfigArgs {
    #[command(subcommand)]
    action: ConfigAction,
}

/// Commands of `sinew config`.
#[derive(Clone, Debug, clap::Subcommand)]
enum ConfigAction {
    /// Check the settings and what they name: certificates, keys, directories, the address; takes the flags of `serve`
    Check(serve::ServeArgs),
    /// Show the settings and where each comes from: default, file, variable or flag; takes the flags of `serve`
    Show(serve::ServeArgs),
}

/// Checks or shows settings.
///
/// # Errors
/// Settings that are not usable (usage); files or addresses named by them that cannot be used.
pub fn run(args: &ConfigArgs) -> anyhow::Result<()> {
    match &args.action {
        ConfigAction::Check(args) => check(args),
        ConfigAction::Show(args) => show(args),
    }
}

fn check(args: &serve::ServeArgs) -> anyhow::Result<()> {
    let (config, _) = args.settings().map_err(usage)?;
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()?;
    let problems = runtime.block_on(problems(&config));
    for problem in &problems {
        note(&format!("{}: {}", problem.setting, problem.what));
    }
    match problems.len() {
        0 => print_line("the settings can be used"),
        n => Err(anyhow::anyhow!(counted(n, "problem"))),
    }
}

fn show(args: &serve::ServeArgs) -> anyhow::Result<()> {
    let (config, sources) = args.settings().map_err(usage)?;
    let rows = config.shown();
    let values = rows
        .iter()
        .map(|(name, _, value)| format!("{name} = {value}"));
    let values: Vec<String> = values.collect();
    let width = values.iter().map(|v| v.chars().count()).max().unwrap_or(0);
    let mut out = String::new();
    for ((name, ..), value) in rows.iter().zip(&values) {
        let source = sources.get(name).map_or("default", String::as_str);
        let _ = writeln!(out, "{value:width$}  # {source}");
    }
    print(&out)
}
