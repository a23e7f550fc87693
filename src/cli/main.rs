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
mod push;
mod rehearse;
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
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    /// Serve worlds over gRPC (the default): a demo world, and the worlds that clients create
    Serve(serve::Args),
    /// Stream a BVH file to a server as live motion for a figure
    Push(push::Args),
    /// Print the frames of a world
    Watch(watch::Args),
    /// Ask a server whether it takes new clients, or whether it lives
    Health(health::Args),
    /// Check or show the settings of a server
    Config(config::ConfigArgs),
    /// Load a server by a schedule and report how late ticks and frames are
    Bench(bench::Args),
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
    /// Write a completion script for a shell, for example `source <(sinew completions bash)`
    Completions(completions::CompletionsArgs),
}

/// A negative number after an option is its value, not an option that there is not: what has a range then says it.
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
        Some(Command::Serve(args)) => serve::run(&args).map(Into::into),
        Some(Command::Push(args)) => push::run(&args).map(Into::into),
        Some(Command::Watch(args)) => watch::run(&args).map(Into::into),
        Some(Command::Health(args)) => health::run(&args).map(Into::into),
        Some(Command::Config(args)) => config::run(&args).map(Into::into),
        Some(Command::Bench(args)) => bench::run(&args).map(Into::into),
        Some(Command::Token(args)) => token::run(&args).map(Into::into),
        Some(Command::Grant(args)) => grant::run(&args).map(Into::into),
        Some(Command::Run(args)) => run::run(&args),
        Some(Command::Survey(args)) => survey::run(&args).map(Into::into),
        Some(Command::Rehearse(args)) => rehearse::run(&args).map(Into::into),
        Some(Command::Strength(args)) => strength::run(&args).map(Into::into),
        Some(Command::Lint(args)) => lint::run(&args).map(Into::into),
        Some(Command::Convert(args)) => convert::run(&args).map(Into::into),
        Some(Command::Paper(args)) => paper::run(&args).map(Into::into),
        Some(Command::Walking(args)) => walking::run(&args).map(Into::into),
        Some(Command::Bodies(args)) => bodies::run(&args).map(Into::into),
        Some(Command::Completions(args)) => {
            completions::run(&args, Arguments::command()).map(Into::into)
        }
        None => unreachable!("`serve` was put in its place"),
    };
    exit::code(done).into()
}

/// A world's resource name from what a user typed: `demo` or `worlds/demo`.
pub fn world_resource(name: &str) -> String {
    if name.starts_with("worlds/") {
        name.to_owned()
    } else {
        format!("worlds/{name}")
    }
}

/// A status of the server as an error: its message and its code.
pub fn explain(status: &tonic::Status) -> anyhow::Error {
    anyhow::anyhow!("{} ({:?})", status.message(), status.code())
}
