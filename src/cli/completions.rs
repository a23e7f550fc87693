//! `sinew completions`: prints a script with which a shell completes the arguments of `sinew`.

use super::terminal::print;
use anyhow::{Context, Result};
use clap_complete::Shell;

/// Arguments of `sinew completions`.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct CompletionsArgs {
    /// Shell to write the script for.
    #[arg(value_enum)]
    pub shell: Shell,
}

/// Writes the completion script of `command` to standard output.
///
/// # Errors
/// Standard output that cannot be written.
pub fn run(args: &CompletionsArgs, mut command: clap::Command) -> Result<()> {
    let mut script = Vec::new();
    let name = command.get_name().to_owned();
    clap_complete::generate(args.shell, &mut command, name, &mut script);
    print(&String::from_utf8(script).context("the script is not UTF-8")?)
}
