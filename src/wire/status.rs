//! Faults of requests and their form on the wire: a gRPC code with `google.rpc` details (AIP-193).
//!
//! Every status carries an `ErrorInfo` with a reason in UPPER_SNAKE. Bad input names the field in a `BadRequest`, an
//! unknown resource its name in a `ResourceInfo`, a limit its name in a `QuotaFailure`. A request that may work later
//! gets the time in a `RetryInfo`.

use std::time::Duration;
use tonic::{Code, Status};
use tonic_types::{ErrorDetails, StatusExt};

/// Domain of the reasons in `ErrorInfo`.
pub const DOMAIN: &str = "sinew";

/// Reason why a request was not carried out. Nothing was changed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Fault {
    /// A field has a value that is not allowed.
    #[error("{field}: {problem}")]
    Invalid {
        /// Path of the field, for example `batch.frames[3].figures[0].velocity[7]`.
        field: String,
        /// The problem, and the expected value.
        problem: String,
    },
    /// The bytes of a request are not a message.
    #[error("{}{problem}", spaced(field))]
    Malformed {
        /// Path of the field; empty for the message as a whole.
        field: String,
        /// The problem.
        problem: &'static str,
    },
    /// A message is larger than the server takes, on the wire or decoded.
    #[error("{}{message}; {limit} is {value}", spaced(field))]
    TooLarge {
        /// Path of the field with which it becomes too large; empty for the message as a whole.
        field: String,
        /// Name of the limit.
        limit: &'static str,
        /// Its value.
        value: u64,
        /// The amount that exceeds it.
        message: String,
    },
    /// There is no such resource.
    #[error("{kind} {name:?} does not exist{valid}", valid = valid_names(kind))]
    NotFound {
        /// Kind of resource: `world`, `figure`, `clip`, `body`, `segment`, `dof`, `bone`.
        kind: &'static str,
        /// The requested name.
        name: String,
    },
    /// The name is taken.
    #[error("{kind} {name:?} exists already")]
    Exists {
        /// Kind of resource.
        kind: &'static str,
        /// The name.
        name: String,
    },
    /// The server does not answer requests with this property.
    #[error("{message}")]
    Refused {
        /// Reason in UPPER_SNAKE.
        reason: &'static str,
        /// The message.
        message: String,
        /// Name of the setting that lists the accepted values.
        setting: &'static str,
    },
    /// The caller is not authenticated, or cannot prove its identity.
    #[error("{message}")]
    Unauthenticated {
        /// Reason in UPPER_SNAKE.
        reason: &'static str,
        /// The problem. Never the credentials themselves.
        message: String,
    },
    /// The caller may not do this.
    #[error("{message}")]
    Denied {
        /// Reason in UPPER_SNAKE.
        reason: &'static str,
        /// The missing role.
        message: String,
        /// Further facts.
        facts: Vec<(&'static str, String)>,
    },
    /// The request does not fit the state of the resource.
    #[error("{message}")]
    Precondition {
        /// Reason in UPPER_SNAKE.
        reason: &'static str,
        /// The obstacle to the request.
        message: String,
        /// Further facts.
        facts: Vec<(&'static str, String)>,
    },
    /// A limit of the server is reached.
    #[error("{limit} is {value}: {message}")]
    Exhausted {
        /// Name of the limit in the configuration.
        limit: &'static str,
        /// Its value.
        value: u64,
        /// The amount that would exceed it.
        message: String,
        /// Time after which another attempt may succeed; `None` if only giving something up helps.
        retry: Option<Duration>,
    },
    /// The ticks of running worlds would need more of the processors than allowed.
    #[error(
        "{whose} would need {percent:.0} % of its processor time for ticks; {limit:.0} % may be used"
    )]
    Budget {
        /// `the world` or `the machine`.
        whose: &'static str,
        /// The needed share, %.
        percent: f64,
        /// The allowed share, %.
        limit: f64,
    },
    /// A tick is no longer held, or not computed yet.
    #[error("tick {asked} is not held; held are {oldest} to {newest}")]
    Expired {
        /// Requested tick.
        asked: i64,
        /// Oldest tick that is held.
        oldest: i64,
        /// Newest tick.
        newest: i64,
    },
    /// Another request or a failure interrupted it.
    #[error("{message}")]
    Aborted {
        /// Reason in UPPER_SNAKE.
        reason: &'static str,
        /// The message.
        message: String,
    },
    /// Stored data can no longer be read.
    #[error("{message}")]
    DataLoss {
        /// Reason in UPPER_SNAKE.
        reason: &'static str,
        /// The lost data.
        message: String,
    },
    /// This server cannot do it.
    #[error("{0} is not available in this server")]
    Unimplemented(String),
    /// The request took too long.
    #[error("the request took longer than its deadline, or than request_timeout_s = {}", .limit.as_secs_f64())]
    Late {
        /// The longest time for any request.
        limit: Duration,
    },
    /// A status that a library made without a reason.
    #[error("{message}")]
    Foreign {
        /// Its code.
        code: Code,
        /// Its message.
        message: String,
    },
    /// The server shuts down.
    #[error("the server is shutting down")]
    Draining,
    /// It could not be written to disk, so it was not done.
    #[error("it could not be stored: {0}")]
    Storage(String),
    /// The resource failed; the server's log has more.
    #[error("{0}")]
    Internal(String),
}

/// The start of a sentence about a field, or about the message as a whole.
fn spaced(field: &str) -> String {
    if field.is_empty() {
        String::new()
    } else {
        format!("{field}: ")
    }
}

/// Most characters of `worlds/{world}/obstacles/{obstacle}`, with the longest ids.
const LONGEST_NAME: usize = 144;

/// The existing names, for kinds of resource that are the same on every server.
fn valid_names(kind: &str) -> String {
    match kind {
        "body" => format!(
            "; the bodies are {}",
            sinew_physics::body::names::body_name_forms()
        ),
        _ => String::new(),
    }
}

impl Fault {
    /// Bad input in `field`.
    pub fn invalid(field: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Invalid {
            field: field.into(),
            problem: problem.into(),
        }
    }

    /// Unknown resource. The name is cut to the length of the longest existing one, because errors travel in headers,
    /// which are short.
    pub fn not_found(kind: &'static str, name: impl Into<String>) -> Self {
        let mut name = name.into();
        if let Some((end, _)) = name.char_indices().nth(LONGEST_NAME) {
            name.truncate(end);
        }
        Self::NotFound { kind, name }
    }

    /// The same fault with `prefix` put before the field path, for messages inside messages.
    #[must_use]
    pub fn within(self, prefix: &str) -> Self {
        match self {
            Self::Invalid { field, problem } => Self::Invalid {
                field: if field.is_empty() {
                    prefix.to_owned()
                } else {
                    format!("{prefix}.{field}")
                },
                problem,
            },
            other => other,
        }
    }

    /// Reason in UPPER_SNAKE, as `ErrorInfo` carries it.
    pub fn reason(&self) -> &'static str {
        match self {
            Self::Invalid { .. } => "INVALID_FIELD",
            Self::Malformed { .. } => "MALFORMED_MESSAGE",
            Self::TooLarge { .. } => "MESSAGE_TOO_LARGE",
            Self::NotFound { .. } => "RESOURCE_NOT_FOUND",
            Self::Exists { .. } => "ALREADY_EXISTS",
            Self::Precondition { reason, .. }
            | Self::Aborted { reason, .. }
            | Self::Unauthenticated { reason, .. }
            | Self::Denied { reason, .. }
            | Self::DataLoss { reason, .. }
            | Self::Refused { reason, .. } => reason,
            Self::Exhausted { .. } => "LIMIT_REACHED",
            Self::Budget { .. } => "TICK_BUDGET",
            Self::Expired { .. } => "RESUME_EXPIRED",
            Self::Unimplemented(_) => "NOT_AVAILABLE",
            Self::Late { .. } => "DEADLINE_EXCEEDED",
            Self::Foreign { code, .. } => foreign_reason(*code),
            Self::Draining => "DRAINING",
            Self::Storage(_) => "STORAGE",
            Self::Internal(_) => "INTERNAL",
        }
    }
}

/// The reason for a code without one.
fn foreign_reason(code: Code) -> &'static str {
    match code {
        Code::Cancelled => "CANCELLED",
        Code::InvalidArgument => "MALFORMED_MESSAGE",
        Code::DeadlineExceeded => "DEADLINE_EXCEEDED",
        Code::NotFound => "RESOURCE_NOT_FOUND",
        Code::PermissionDenied => "ROLE_REQUIRED",
        Code::ResourceExhausted => "LIMIT_REACHED",
        Code::OutOfRange => "MESSAGE_TOO_LARGE", // tonic uses this code
        Code::Unimplemented => "NOT_AVAILABLE",
        Code::Unavailable => "UNAVAILABLE",
        Code::Unauthenticated => "CREDENTIALS_REQUIRED",
        _ => "INTERNAL",
    }
}

/// Whether a status gives a reason.
pub fn is_explained(status: &Status) -> bool {
    status.get_error_details().error_info().is_some()
}

/// Type of a kind of resource in the protos: `sinew/World`.
fn resource_type(kind: &str) -> String {
    let (first, rest) = kind.split_at(kind.len().min(1));
    format!("sinew/{}{rest}", first.to_uppercase())
}

/// A fault as a message, for operations that report later the error that a call would have returned.
pub fn rpc_status(fault: Fault) -> tonic_types::Status {
    let status = Status::from(fault);
    // The details of a status are a whole `Status` message.
    prost::Message::decode(status.details()).unwrap_or_else(|_| tonic_types::Status {
        code: status.code().into(),
        message: status.message().to_owned(),
        details: Vec::new(),
    })
}

impl From<Fault> for Status {
    fn from(fault: Fault) -> Self {
        let mut details = ErrorDetails::new();
        let mut facts = std::collections::HashMap::new();
        let code = match &fault {
            Fault::Invalid { field, problem } => {
                details.add_bad_request_violation(field, problem);
                facts.insert("field".to_owned(), field.clone());
                Code::InvalidArgument
            }
            Fault::Malformed { field, problem } => {
                details.add_bad_request_violation(field, *problem);
                facts.insert("field".to_owned(), field.clone());
                Code::InvalidArgument
            }
            Fault::TooLarge {
                field,
                limit,
                value,
                message,
            } => {
                details.add_bad_request_violation(field, message);
                details.add_quota_failure_violation(*limit, message);
                facts.insert("field".to_owned(), field.clone());
                facts.insert("limit".to_owned(), (*limit).to_owned());
                facts.insert("value".to_owned(), value.to_string());
                Code::ResourceExhausted
            }
            Fault::NotFound { kind, name } => {
                details.set_resource_info(resource_type(kind), name, "", fault.to_string());
                Code::NotFound
            }
            Fault::Exists { kind, name } => {
                details.set_resource_info(resource_type(kind), name, "", fault.to_string());
                Code::AlreadyExists
            }
            Fault::Precondition {
                message,
                facts: more,
                reason,
            } => {
                details.add_precondition_failure_violation(*reason, "", message);
                facts.extend(more.iter().map(|(k, v)| ((*k).to_owned(), v.clone())));
                Code::FailedPrecondition
            }
            Fault::Exhausted {
                limit,
                value,
                message,
                retry,
            } => {
                details.add_quota_failure_violation(*limit, message);
                if retry.is_some() {
                    details.set_retry_info(*retry);
                }
                facts.insert("limit".to_owned(), (*limit).to_owned());
                facts.insert("value".to_owned(), value.to_string());
                Code::ResourceExhausted
            }
            Fault::Budget { percent, limit, .. } => {
                details.add_quota_failure_violation("max_tick_budget", fault.to_string());
                facts.insert("needed_percent".to_owned(), format!("{percent:.1}"));
                facts.insert("limit_percent".to_owned(), format!("{limit:.1}"));
                Code::ResourceExhausted
            }
            Fault::Expired { oldest, newest, .. } => {
                facts.insert("oldest_tick".to_owned(), oldest.to_string());
                facts.insert("newest_tick".to_owned(), newest.to_string());
                Code::OutOfRange
            }
            Fault::Refused { setting, .. } => {
                facts.insert("setting".to_owned(), (*setting).to_owned());
                Code::PermissionDenied
            }
            Fault::Unauthenticated { .. } => Code::Unauthenticated,
            Fault::Denied { facts: more, .. } => {
                facts.extend(more.iter().map(|(k, v)| ((*k).to_owned(), v.clone())));
                Code::PermissionDenied
            }
            Fault::Aborted { .. } => Code::Aborted,
            Fault::DataLoss { .. } => Code::DataLoss,
            Fault::Unimplemented(_) => Code::Unimplemented,
            Fault::Late { .. } => Code::DeadlineExceeded,
            Fault::Foreign { code, .. } => *code,
            Fault::Draining => {
                details.set_retry_info(Some(Duration::from_secs(5)));
                Code::Unavailable
            }
            Fault::Storage(_) => {
                details.set_retry_info(Some(Duration::from_secs(5)));
                Code::Unavailable
            }
            Fault::Internal(_) => Code::Internal,
        };
        details.set_error_info(fault.reason(), DOMAIN, facts);
        Status::with_error_details(code, fault.to_string(), details)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_status_carries_reason_and_field() {
        let status: Status = Fault::invalid("mass_kg", "must be 0…500, got NaN")
            .within("perturbations[2].load")
            .into();
        assert_eq!(status.code(), Code::InvalidArgument);
        let details = status.get_error_details();
        assert_eq!(
            details.bad_request().unwrap().field_violations[0].field,
            "perturbations[2].load.mass_kg"
        );
        assert_eq!(details.error_info().unwrap().reason, "INVALID_FIELD");
        let status: Status = Fault::Exhausted {
            limit: "max_worlds",
            value: 3,
            message: "one more world".into(),
            retry: None,
        }
        .into();
        assert_eq!(status.code(), Code::ResourceExhausted);
        assert_eq!(
            status
                .get_error_details()
                .quota_failure()
                .unwrap()
                .violations[0]
                .subject,
            "max_worlds"
        );
    }
}
