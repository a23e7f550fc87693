//! The `sinew` command: parses arguments and calls the library.

use clap::{Parser, Subcommand};
use sinew::cli;
use std::process::ExitCode;

/// Physically simulated human figures that track motions within human strength.
#[derive(Parser)]
#[command(version, about)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run motions through the physics, offline, and report how well the figure followed.
    Run(Box<cli::run::RunArgs>),
    /// Say how recordings fit the body: what was found, guessed and changed.
    Lint(cli::lint::LintArgs),
    /// Fit a recording to the body and write the prepared motion.
    Convert(cli::convert::ConvertArgs),
    /// List segments, degrees of freedom, limits and strength of a body.
    Bodies(cli::bodies::BodiesArgs),
}

fn main() -> ExitCode {
    let done = match Cli::parse().command {
        Command::Run(args) => cli::run::run(&args),
        Command::Lint(args) => cli::lint::run(&args),
        Command::Convert(args) => cli::convert::run(&args),
        Command::Bodies(args) => cli::bodies::run(&args),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
