//! The `sinew` command: parses arguments and calls the library.

use clap::{Parser, Subcommand};
use sinew::cli;

/// Physically simulated human figures that track desired motions within human strength.
#[derive(Parser)]
#[command(name = "sinew", version)]
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
}

fn main() -> anyhow::Result<()> {
    let arguments = match Arguments::parse() {
        // Settings from the environment count as well.
        Arguments { command: None } => Arguments::parse_from(["sinew", "serve"]),
        given => given,
    };
    match arguments.command {
        Some(Command::Serve(args)) => cli::serve::run(&args),
        Some(Command::Push(args)) => cli::push::run(&args),
        Some(Command::Watch(args)) => cli::watch::run(&args),
        None => unreachable!("`serve` was put in its place"),
    }
}
