//! The commands of the `sinew` binary, one module each.

pub mod args;
pub mod bodies;
pub mod compare;
pub mod convert;
pub mod lint;
pub mod output;
pub mod page;
pub mod paper;
pub mod push;
pub mod run;
pub mod serve;
pub mod source;
pub mod survey;
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

/// A status of the server as a sentence: its message, and the field where it names one.
pub fn explain(status: &tonic::Status) -> anyhow::Error {
    anyhow::anyhow!("{} ({:?})", status.message(), status.code())
}
