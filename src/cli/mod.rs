//! The commands of the `sinew` binary, one module each.

#![warn(clippy::print_stdout, clippy::print_stderr)] // `terminal` writes: it survives a closed pipe

pub mod args;
pub mod bench;
pub mod bodies;
pub mod compare;
pub mod completions;
pub mod config;
pub mod convert;
pub mod exit;
pub mod grant;
pub mod health;
mod interrupt;
pub mod lint;
pub mod number;
pub mod output;
pub mod page;
pub mod paper;
pub mod push;
pub mod rehearse;
pub mod run;
pub mod serve;
pub mod source;
pub mod strength;
pub mod survey;
pub mod terminal;
pub mod token;
pub mod walking;
pub mod watch;

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
