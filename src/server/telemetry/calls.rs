//! The outcome of each call: its duration, its result, and, in a build with traces, its span.

use crate::access::roles;
use axum::body::{Body, Bytes};
use axum::extract::Request;
use axum::http::HeaderMap;
use axum::middleware::Next;
use axum::response::Response;
use http_body::{Body as HttpBody, Frame, SizeHint};
use metrics::{Counter, Histogram};
use std::collections::HashMap;
use std::pin::Pin;
use std::sync::{Arc, LazyLock, OnceLock};
use std::task::{Context, Poll, ready};
use std::time::Instant;

/// Names of the gRPC codes, by number.
const CODES: [&str; 17] = [
    "OK",
    "CANCELLED",
    "UNKNOWN",
    "INVALID_ARGUMENT",
    "DEADLINE_EXCEEDED",
    "NOT_FOUND",
    "ALREADY_EXISTS",
    "PERMISSION_DENIED",
    "RESOURCE_EXHAUSTED",
    "FAILED_PRECONDITION",
    "ABORTED",
    "OUT_OF_RANGE",
    "UNIMPLEMENTED",
    "INTERNAL",
    "UNAVAILABLE",
    "DATA_LOSS",
    "UNAUTHENTICATED",
];
/// A call that the client gave up before its end.
const CANCELLED: usize = 1;
/// A call that ended without a code.
const UNKNOWN: usize = 2;

/// Meters of calls. Methods are those of the protos, so their number is fixed.
struct Meters {
    methods: HashMap<&'static str, Histogram>,
    /// Health, reflection, and unknown methods.
    other: Histogram,
    codes: [Counter; CODES.len()],
}

static METERS: LazyLock<Meters> = LazyLock::new(|| {
    super::metrics(); // before: handles of no recorder count nothing
    let seconds = |name: &'static str| metrics::histogram!("sinew_call_seconds", "method" => name);
    Meters {
        methods: roles::paths()
            .map(|path| (path, seconds(short(path))))
            .collect(),
        other: seconds("other"),
        codes: CODES.map(|code| metrics::counter!("sinew_calls_total", "code" => code)),
    }
});

/// `/sinew.v1.WorldService/GetWorld` as `WorldService/GetWorld`.
fn short(path: &'static str) -> &'static str {
    path.strip_prefix("/sinew.v1.").unwrap_or(path)
}

/// Notes about a call from its handlers.
#[derive(Debug, Default)]
pub(crate) struct Note {
    principal_kind: OnceLock<&'static str>,
}

impl Note {
    /// Notes the kind of principal: `user`, `cert` or `anonymous`.
    pub(crate) fn principal(&self, name: &str) {
        let kinds = ["user", "cert"];
        let kind = kinds.into_iter().find(|k| name.starts_with(k));
        let _ = self.principal_kind.set(kind.unwrap_or("anonymous"));
    }
}

/// Sees a call from its arrival to the end of its answer.
pub(crate) async fn observe(mut request: Request, next: Next) -> Response {
    let method = roles::known(request.uri().path());
    let call = ObservedCall {
        seconds: method
            .and_then(|m| METERS.methods.get(m))
            .unwrap_or(&METERS.other),
        begun: Instant::now(),
        note: Arc::default(),
        #[cfg(feature = "otlp")]
        span: super::traces::begin(method, request.headers()),
    };
    request.extensions_mut().insert(call.note.clone());
    let mut call = Observed {
        call: Some(call),
        code: None,
    };
    // A client that disconnects in the meantime drops this, so the call is counted as cancelled.
    let response = next.run(request).await;
    call.code = code(response.headers());
    response.map(|body| Body::new(ObservedAnswer { body, call }))
}

/// The code that headers or trailers name.
fn code(headers: &HeaderMap) -> Option<usize> {
    let value = headers.get("grpc-status")?.to_str().ok()?;
    Some(
        value
            .parse()
            .ok()
            .filter(|c| *c < CODES.len())
            .unwrap_or(UNKNOWN),
    )
}

/// A call.
struct ObservedCall {
    seconds: &'static Histogram,
    begun: Instant,
    note: Arc<Note>,
    #[cfg(feature = "otlp")]
    span: Option<super::traces::CallSpan>,
}

/// A call that is counted once: when its answer has ended, or is no longer wanted.
struct Observed {
    call: Option<ObservedCall>,
    code: Option<usize>,
}

impl Observed {
    fn end(&mut self, code: usize) {
        let Some(call) = self.call.take() else { return };
        call.seconds.record(call.begun.elapsed());
        METERS.codes[code].increment(1);
        #[cfg(feature = "otlp")]
        if let Some(span) = call.span {
            let kind = call.note.principal_kind.get().copied();
            span.end(CODES[code], code, kind);
        }
    }
}

impl Drop for Observed {
    fn drop(&mut self) {
        self.end(self.code.unwrap_or(CANCELLED));
    }
}

/// The body of an answer on its way.
struct ObservedAnswer {
    body: Body,
    call: Observed,
}

impl HttpBody for ObservedAnswer {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        let next = ready!(Pin::new(&mut self.body).poll_frame(cx));
        match &next {
            Some(Ok(frame)) => {
                if let Some(trailers) = frame.trailers_ref() {
                    let code = code(trailers).unwrap_or(UNKNOWN);
                    self.call.end(code);
                }
            }
            Some(Err(_)) => self.call.end(UNKNOWN),
            None => {
                let code = self.call.code.unwrap_or(UNKNOWN);
                self.call.end(code);
            }
        }
        Poll::Ready(next)
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_have_their_numbers() {
        for (i, name) in CODES.iter().enumerate() {
            let code = tonic::Code::from_i32(i as i32);
            let said = format!("{code:?}").to_uppercase();
            assert_eq!(said.trim_matches('"'), name.replace('_', ""), "{i}");
        }
    }

    #[test]
    fn principals_are_known_by_kind_only() {
        for (name, kind) in [
            ("user:ann", "user"),
            ("cert:desk", "cert"),
            ("anonymous", "anonymous"),
        ] {
            let note = Note::default();
            note.principal(name);
            assert_eq!(note.principal_kind.get(), Some(&kind));
        }
    }
}
