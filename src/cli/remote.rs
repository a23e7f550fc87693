//! Names and errors of servers, for the commands that talk to one.

/// A world's resource name from the user's input: `demo` or `worlds/demo`.
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
