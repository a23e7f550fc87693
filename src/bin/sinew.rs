//! The `sinew` command: parses arguments and calls the library.

use clap::{Parser, Subcommand};
use sinew::cli;
use std::process::ExitCode;

/// Physically simulated human figures that track desired motions within human strength.
#[derive(Parser)]
#[command(name = "sinew", version, about)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    /// Serve worlds over gRPC (the default): a demo world, and whatever clients create
    Serve(cli::serve::Args),
    /// Stream a BVH file to a server as the live driver of a figure
    Push(cli::push::Args),
    /// Print the frames of a world
    Watch(cli::watch::Args),
    /// Run motions through the physics, offline, and report how well the figure followed
    Run(Box<cli::run::RunArgs>),
    /// Run every clip of a corpus, judge it by published rules, and compare with an earlier survey
    Survey(Box<cli::survey::SurveyArgs>),
    /// Say how recordings fit the body: what was found, guessed and changed
    Lint(cli::lint::LintArgs),
    /// Fit a recording to the body and write the prepared motion
    Convert(cli::convert::ConvertArgs),
    /// Run the paper's experiments again and write a page about them
    Paper(cli::paper::PaperArgs),
    /// Run walks with pushes, loads, other people and noise, and write a page about what is survived
    Walking(cli::walking::WalkingArgs),
    /// List segments, degrees of freedom, limits and strength of a body
    Bodies(cli::bodies::BodiesArgs),
}

fn main() -> ExitCode {
    let arguments = match Arguments::parse() {
        // Settings from the environment count as well.
        Arguments { command: None } => Arguments::parse_from(["sinew", "serve"]),
        given => given,
    };
    let done = match arguments.command {
        Some(Command::Serve(args)) => cli::serve::run(&args),
        Some(Command::Push(args)) => cli::push::run(&args),
        Some(Command::Watch(args)) => cli::watch::run(&args),
        Some(Command::Run(args)) => cli::run::run(&args),
        Some(Command::Survey(args)) => cli::survey::run(&args),
        Some(Command::Lint(args)) => cli::lint::run(&args),
        Some(Command::Convert(args)) => cli::convert::run(&args),
        Some(Command::Paper(args)) => cli::paper::run(&args),
        Some(Command::Walking(args)) => cli::walking::run(&args),
        Some(Command::Bodies(args)) => cli::bodies::run(&args),
        None => unreachable!("`serve` was put in its place"),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
