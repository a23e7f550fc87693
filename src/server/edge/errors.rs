//! Errors made outside this server's code: those of tonic, of health and of reflection get an `ErrorInfo`, like all
//! others, and requests that take too long end with that reason.

use super::Edge;
use crate::telemetry::count_refusal;
use axum::body::{Body, Bytes};
use axum::extract::{Request, State};
use axum::http::HeaderMap;
use axum::middleware::Next;
use axum::response::Response;
use http_body::Frame;
use http_body_util::BodyExt as _;
use sinew_wire::status::{Fault, is_explained};
use std::sync::Arc;
use std::time::Duration;
use tonic::{Code, Status};

/// Time by which a client's deadline ends its request here before tonic would, which gives no reason.
const SOONER: Duration = Duration::from_millis(5);

/// Adds the missing details to a status in headers or trailers.
fn explain(headers: &mut HeaderMap) {
    let Some(status) = Status::from_header_map(headers) else {
        return;
    };
    if status.code() == Code::Ok || is_explained(&status) {
        return;
    }
    let fault = Fault::Foreign {
        code: status.code(),
        message: status.message().to_owned(),
    };
    count_refusal(&fault);
    // It fails for a message that cannot be a header, and then leaves the status unchanged.
    let _ = Status::from(fault).add_header(headers);
}

fn explained(frame: Frame<Bytes>) -> Frame<Bytes> {
    match frame.into_trailers() {
        Ok(mut trailers) => {
            explain(&mut trailers);
            Frame::trailers(trailers)
        }
        Err(data) => data,
    }
}

/// The deadline of the client: `grpc-timeout` is a number and a unit.
fn timeout(headers: &HeaderMap) -> Option<Duration> {
    let text = headers.get("grpc-timeout")?.to_str().ok()?;
    let (digits, unit) = text.split_at_checked(text.len().checked_sub(1)?)?;
    if digits.is_empty() || digits.len() > 8 || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let n: u64 = digits.parse().ok()?;
    Some(match unit {
        "H" => Duration::from_secs(n * 3600),
        "M" => Duration::from_secs(n * 60),
        "S" => Duration::from_secs(n),
        "m" => Duration::from_millis(n),
        "u" => Duration::from_micros(n),
        "n" => Duration::from_nanos(n),
        _ => return None,
    })
}

/// Ends requests that take too long, and ensures that every error has a reason.
pub(crate) async fn reasons(
    State(edge): State<Arc<Edge>>,
    request: Request,
    next: Next,
) -> Response {
    let asked = timeout(request.headers());
    let most = asked.map_or(edge.timeout, |asked| {
        asked.saturating_sub(SOONER).min(edge.timeout)
    });
    let Ok(mut response) = tokio::time::timeout(most, next.run(request)).await else {
        let fault = Fault::Late {
            limit: edge.timeout,
        };
        count_refusal(&fault);
        return Status::from(fault).into_http::<Body>();
    };
    explain(response.headers_mut());
    response.map(|body| Body::new(body.map_frame(explained)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn headers(list: &[(&'static str, &str)]) -> HeaderMap {
        let all = list.iter().map(|(k, v)| (*k, v.parse().unwrap()));
        all.map(|(k, v)| (axum::http::HeaderName::from_static(k), v))
            .collect()
    }

    #[test]
    fn deadlines_are_a_number_and_a_unit() {
        for (text, time) in [
            ("1S", Some(Duration::from_secs(1))),
            ("250m", Some(Duration::from_millis(250))),
            ("99999999H", Some(Duration::from_secs(99_999_999 * 3600))),
            ("7n", Some(Duration::from_nanos(7))),
            ("123456789S", None),
            ("S", None),
            ("-1S", None),
            ("1 S", None),
            ("1x", None),
            ("", None),
        ] {
            assert_eq!(
                timeout(&headers(&[("grpc-timeout", text)])),
                time,
                "{text:?}"
            );
        }
        assert_eq!(timeout(&HeaderMap::new()), None);
    }

    #[test]
    fn a_bare_status_is_explained_and_others_stay_as_they_are() {
        let mut bare = headers(&[
            ("grpc-status", "12"),
            ("grpc-message", "gzip%20is%20not%20read"),
        ]);
        explain(&mut bare);
        let status = Status::from_header_map(&bare).unwrap();
        assert_eq!(status.code(), Code::Unimplemented);
        assert_eq!(status.message(), "gzip is not read");
        assert!(is_explained(&status));

        let mut own = HeaderMap::new();
        let fault = Fault::invalid("speed", "is too high");
        Status::from(fault).add_header(&mut own).unwrap();
        let before = own.clone();
        explain(&mut own);
        assert_eq!(own, before);
        for other in [headers(&[("grpc-status", "0")]), HeaderMap::new()] {
            let mut same = other.clone();
            explain(&mut same);
            assert_eq!(same, other);
        }
    }
}
