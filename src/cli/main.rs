//! The `sinew` command: parses arguments and calls the command, one module each.

#![warn(clippy::print_stdout, clippy::print_stderr)] // `terminal` writes: it survives a closed pipe

mod args;
mod bench;
mod bodies;
mod compare;
mod completions;
mod config;
mod convert;
mod exit;
mod grant;
mod health;
mod interrupt;
mod lint;
mod number;
mod output;
mod page;
mod paper;
mod parameters;
mod push;
mod rehearse;
mod remote;
mod run;
mod serve;
mod source;
mod strength;
mod survey;
mod terminal;
mod token;
mod walking;
mod watch;

use clap::{Arg, CommandFactory, FromArgMatches, Parser, Subcommand};
use std::process::ExitCode;

#[cfg(all(unix, not(target_os = "macos")))]
#[global_allocator]
static MEMORY: tikv_jemallocator::Jemalloc = tikv_jemallocator::Jemalloc;

/// Physically simulated human figures that track reference motions within human strength.
#[derive(Parser)]
#[command(name = "sinew", version, about, after_help = exit::EXIT_CODES)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Subcommands>,
}

#[derive(Subcommand)]
enum Subcommands {
    /// Serve worlds over gRPC (the default): a demo world, and the worlds that clients create
    Serve(serve::ServeArgs),
    /// Stream a BVH file to a server as live motion for a figure
    Push(push::PushArgs),
    /// Print the frames of a world
    Watch(watch::WatchArgs),
    /// Ask a server whether it takes new clients, or whether it lives
    Health(health::HealthArgs),
    /// Check or show the settings of a server
    Config(config::ConfigArgs),
    /// Load a server by a schedule and report how late ticks and frames are
    Bench(bench::BenchArgs),
    /// Make a bearer token, or the secret that signs tokens
    Token(token::TokenArgs),
    /// Grant roles in a world, take them back, or list them
    Grant(grant::GrantArgs),
    /// Simulate motions offline and report how closely the figure tracks them
    #[command(after_help = exit::EXIT_CODES)]
    Run(Box<run::RunArgs>),
    /// Run every clip of a corpus, judge it by published rules, and compare with an earlier survey
    Survey(Box<survey::SurveyArgs>),
    /// Find out what has to be added to a motion, or how much help it takes, so that a figure does it
    Rehearse(Box<rehearse::RehearseArgs>),
    /// Estimate the strength that motions need, as a file for `run --strength-file` and for requests
    Strength(Box<strength::StrengthArgs>),
    /// Report how recordings fit the body: what was found, estimated and changed
    Lint(lint::LintArgs),
    /// Fit a recording to the body and write the prepared motion
    Convert(convert::ConvertArgs),
    /// Repeat the experiments of the paper and write a page with the results
    Paper(paper::PaperArgs),
    /// Simulate walks with pushes, loads, other bodies and noise, and write a page with the results
    Walking(walking::WalkingArgs),
    /// List the bodies, or the segments, degrees of freedom, limits and strength of one
    Bodies(bodies::BodiesArgs),
    /// List the tunable numbers of the physics, with unit, range, meaning and source
    Parameters(parameters::ParametersArgs),
    /// Write a completion script for a shell, for example `source <(sinew completions bash)`
    Completions(completions::CompletionsArgs),
}

/// Makes a negative number after an option its value rather than an unknown option, so that a range check can report
/// it.
fn with_negative_numbers(command: clap::Command) -> clap::Command {
    let allow = |arg: Arg| match arg.is_positional() || !arg.get_action().takes_values() {
        true => arg,
        false => arg.allow_negative_numbers(true),
    };
    command.mut_subcommands(|c| c.mut_args(allow))
}

fn main() -> ExitCode {
    let given = with_negative_numbers(Arguments::command()).get_matches();
    let arguments = match Arguments::from_arg_matches(&given).unwrap_or_else(|e| e.exit()) {
        // Settings from the environment count as well.
        Arguments { command: None } => Arguments::parse_from(["sinew", "serve"]),
        given => given,
    };
    let done = match arguments.command {
        Some(Subcommands::Serve(args)) => serve::run(&args).map(Into::into),
        Some(Subcommands::Push(args)) => push::run(&args).map(Into::into),
        Some(Subcommands::Watch(args)) => watch::run(&args).map(Into::into),
        Some(Subcommands::Health(args)) => health::run(&args).map(Into::into),
        Some(Subcommands::Config(args)) => config::run(&args).map(Into::into),
        Some(Subcommands::Bench(args)) => bench::run(&args).map(Into::into),
        Some(Subcommands::Token(args)) => token::run(&args).map(Into::into),
        Some(Subcommands::Grant(args)) => grant::run(&args).map(Into::into),
        Some(Subcommands::Run(args)) => run::run(&args),
        Some(Subcommands::Survey(args)) => survey::run(&args).map(Into::into),
        Some(Subcommands::Rehearse(args)) => rehearse::run(&args).map(Into::into),
        Some(Subcommands::Strength(args)) => strength::run(&args).map(Into::into),
        Some(Subcommands::Lint(args)) => lint::run(&args).map(Into::into),
        Some(Subcommands::Convert(args)) => convert::run(&args).map(Into::into),
        Some(Subcommands::Paper(args)) => paper::run(&args).map(Into::into),
        Some(Subcommands::Walking(args)) => walking::run(&args).map(Into::into),
        Some(Subcommands::Bodies(args)) => bodies::run(&args).map(Into::into),
        Some(Subcommands::Parameters(args)) => parameters::run(&args).map(Into::into),
        Some(Subcommands::Completions(args)) => {
            completions::run(&args, Arguments::command()).map(Into::into)
        }
        None => unreachable!("`serve` was put in its place"),
    };
    exit::code(done).into()
}
