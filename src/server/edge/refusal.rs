//! Refusals before a service is reached, in the form that the sender understands.

use crate::telemetry::count_refusal;
use axum::body::Body;
use axum::extract::Request;
use axum::http::header;
use axum::response::{IntoResponse as _, Response};
use sinew_wire::status::Fault;
use tonic::Status;

/// Characters of a path that a message repeats.
const ECHO: usize = 80;

/// The answer to a call of an unknown method.
pub(crate) fn unknown_method(path: &str) -> Response {
    let shown: String = path.chars().take(ECHO).collect();
    let fault = Fault::Unimplemented(format!("the method {shown}"));
    count_refusal(&fault);
    Status::from(fault).into_http::<Body>()
}

/// A refusal as the sender understands it: a gRPC status, or a page with a sentence.
pub(super) fn refused(fault: Fault, request: &Request) -> Response {
    count_refusal(&fault);
    let kind = request.headers().get(header::CONTENT_TYPE);
    if let Some(kind) = kind.filter(|k| k.as_bytes().starts_with(b"application/grpc")) {
        let mut response: Response = Status::from(fault).into_http::<Body>();
        response
            .headers_mut()
            .insert(header::CONTENT_TYPE, kind.clone());
        return response;
    }
    let code = match fault {
        Fault::Refused { .. } => axum::http::StatusCode::FORBIDDEN,
        _ => axum::http::StatusCode::SERVICE_UNAVAILABLE,
    };
    (code, format!("{fault}\n")).into_response()
}
