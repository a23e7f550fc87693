//! The table of calls, read from the descriptor set that reflection serves: whether a call takes, and is answered with,
//! one message. The role that each call needs is in `access::roles`, from an option in the same set.

use crate::config::Config;
use prost::Message as _;
use sinew_wire::DESCRIPTOR_SET;
use std::collections::HashMap;
use std::sync::LazyLock;

/// Prefix of the paths of our own calls.
const OURS: &str = "/sinew.v1.";

/// Calls that carry a clip or a checkpoint in their request: up to `max_clip_bytes`. All others take up to
/// `max_request_bytes`.
const UPLOADS: [&str; 7] = [
    "/sinew.v1.MotionService/CreateClip",
    "/sinew.v1.MotionService/StreamCreateClip",
    "/sinew.v1.SimulationService/SimulateClip",
    "/sinew.v1.SimulationService/StreamSimulateClip",
    "/sinew.v1.OperationService/StartOperation",
    "/sinew.v1.CheckpointService/RestoreWorld",
    "/sinew.v1.CheckpointService/ForkWorld",
];

/// The form of a call.
#[derive(Clone, Copy, Debug)]
struct CallForm {
    /// The client sends a stream.
    streams_requests: bool,
    /// The server sends a stream.
    streams_responses: bool,
}

static CALLS: LazyLock<HashMap<String, CallForm>> = LazyLock::new(|| {
    let set = prost_types::FileDescriptorSet::decode(DESCRIPTOR_SET);
    let set = set.expect("the embedded descriptor set is one");
    let mut calls = HashMap::new();
    for file in &set.file {
        for service in &file.service {
            let path = |m: &str| format!("/{}.{}/{m}", file.package(), service.name());
            calls.extend(service.method.iter().map(|m| {
                let form = CallForm {
                    streams_requests: m.client_streaming(),
                    streams_responses: m.server_streaming(),
                };
                (path(m.name()), form)
            }));
        }
    }
    calls
});

/// Whether a call takes exactly one message. Calls of other packages, reflection for example, are not in the table.
pub fn takes_one_message(path: &str) -> bool {
    path.starts_with(OURS) && CALLS.get(path).is_none_or(|c| !c.streams_requests)
}

/// Whether a call of the table is answered with exactly one message.
pub fn answers_one_message(path: &str) -> bool {
    CALLS.get(path).is_some_and(|c| !c.streams_responses)
}

/// Whether a call carries a clip or a checkpoint in its request.
pub fn is_upload(path: &str) -> bool {
    UPLOADS.contains(&path)
}

/// Bytes of the largest request: a file arrives whole in one message, with a few fields around it.
pub fn largest_request(config: &Config) -> usize {
    config.max_clip_bytes.max(config.max_request_bytes) as usize + 65_536
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uploads_are_calls_of_the_protos_and_only_driving_streams_requests() {
        assert!(UPLOADS.iter().all(|path| CALLS.contains_key(*path)));
        let ours = CALLS.iter().filter(|(path, _)| path.starts_with(OURS));
        let streams: Vec<&str> = ours
            .filter(|(_, c)| c.streams_requests)
            .map(|(path, _)| path.as_str())
            .collect();
        assert_eq!(streams, ["/sinew.v1.MotionService/DriveFigures"]);
    }
}
