//! Requests that carry a `request_id`.

use super::pb;

/// A request that is done once, however often it is sent with the same id.
pub trait Repeatable: prost::Message {
    /// Its id; empty: it counts each time.
    fn request_id(&self) -> &str;
    /// Whether it is a trial: it does nothing, so its id is free afterwards.
    fn is_trial(&self) -> bool;
}

macro_rules! repeatable {
    ($($name:ident $(: $trial:ident)?,)*) => {
        $(impl Repeatable for pb::$name {
            fn request_id(&self) -> &str {
                &self.request_id
            }

            fn is_trial(&self) -> bool {
                [false $(, self.$trial)?].contains(&true)
            }
        })*
        #[cfg(test)]
        const ALL: &[&str] = &[$(stringify!($name)),*];
    };
}

repeatable! {
    AcceptControlRequest,
    AcquireControlRequest,
    ApplyPerturbationsRequest: validate_only,
    CheckpointWorldRequest,
    ClearPerturbationsRequest,
    CreateClipRequest: validate_only,
    CreateFigureRequest: validate_only,
    CreateGrantRequest: validate_only,
    CreateObstacleRequest: validate_only,
    CreateWorldRequest: validate_only,
    DeleteCheckpointRequest,
    DeleteClipRequest,
    DeleteFigureRequest,
    DeleteGrantRequest,
    DeleteObstacleRequest,
    DeleteRecordingRequest,
    DeleteWorldRequest,
    ForkWorldRequest,
    PlayClipRequest,
    RehearseClipRequest,
    ReleaseControlRequest,
    ResetFigureRequest,
    RestoreWorldRequest,
    SeekWorldRequest,
    StartOperationRequest,
    StartRecordingRequest,
    StepWorldRequest,
    StopClipRequest,
    StopRecordingRequest,
    TransferControlRequest,
}

#[cfg(test)]
mod tests {
    use super::*;
    use prost::Message as _;

    #[test]
    fn every_request_with_a_name_is_repeatable() {
        let set = prost_types::FileDescriptorSet::decode(super::super::DESCRIPTOR_SET).unwrap();
        let all = set.file.iter().flat_map(|f| &f.message_type);
        let named = all.filter(|m| m.field.iter().any(|f| f.name() == "request_id"));
        let mut named: Vec<&str> = named.map(|m| m.name()).collect();
        named.sort_unstable();
        assert_eq!(named, ALL);
    }

    #[test]
    fn a_request_that_only_tries_says_so() {
        let trial = pb::CreateWorldRequest {
            validate_only: true,
            ..Default::default()
        };
        assert!(trial.is_trial() && !pb::CreateWorldRequest::default().is_trial());
        assert!(!pb::StepWorldRequest::default().is_trial());
    }
}
