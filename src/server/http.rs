//! Plain HTTP on the same port: the viewer, the status page and the metrics.

use super::api::App;
use super::telemetry;
use super::viewer;
use axum::Router;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use std::fmt::Write as _;
use std::sync::Arc;

/// Lets browser pages of any origin of the same machine call gRPC-Web and read its trailers.
pub(super) fn cors() -> tower_http::cors::CorsLayer {
    use tower_http::cors::{AllowOrigin, Any, CorsLayer};
    let local = AllowOrigin::predicate(|origin, _| {
        let host = origin
            .to_str()
            .ok()
            .and_then(|o| o.split_once("://"))
            .map(|(_, rest)| rest);
        host.is_some_and(|h| {
            let name = h.rsplit_once(':').map_or(h, |(name, port)| {
                if port.bytes().all(|b| b.is_ascii_digit()) {
                    name
                } else {
                    h
                }
            });
            matches!(name, "localhost" | "127.0.0.1" | "[::1]")
        })
    });
    CorsLayer::new()
        .allow_origin(local)
        .allow_methods([http::Method::POST])
        .allow_headers(Any)
        .expose_headers(
            ["grpc-status", "grpc-message", "grpc-status-details-bin"]
                .map(header::HeaderName::from_static),
        )
}

/// The pages.
pub(super) fn router(app: Arc<App>) -> Router {
    let pages = Router::new()
        .route("/status", get(status_page))
        .route("/metrics", get(metrics_page))
        .route("/ready", get(ready));
    let pages = if app.config.viewer {
        pages.merge(viewer::router())
    } else {
        pages.route("/", get(status_page))
    };
    pages.with_state(app)
}

/// What is neither page nor service. gRPC callers get a gRPC answer.
pub(super) async fn unknown(headers: HeaderMap) -> Response {
    let grpc = headers
        .get(header::CONTENT_TYPE)
        .is_some_and(|v| v.as_bytes().starts_with(b"application/grpc"));
    if grpc {
        let unimplemented = (tonic::Code::Unimplemented as i32).to_string();
        [
            ("content-type", "application/grpc"),
            ("grpc-status", unimplemented.as_str()),
        ]
        .into_response()
    } else {
        StatusCode::NOT_FOUND.into_response()
    }
}

/// Whether new clients are welcome.
async fn ready(State(app): State<Arc<App>>) -> Response {
    if app.worlds.is_draining() {
        (StatusCode::SERVICE_UNAVAILABLE, "shutting down\n").into_response()
    } else {
        "ready\n".into_response()
    }
}

async fn metrics_page() -> Response {
    match telemetry::metrics() {
        Some(handle) => (
            [(header::CONTENT_TYPE, "text/plain; version=0.0.4")],
            handle.render(),
        )
            .into_response(),
        // Another recorder was installed by the program that embeds this one.
        None => StatusCode::NOT_FOUND.into_response(),
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

const PAGE: &str = include_str!("status_page.html");

async fn status_page(State(app): State<Arc<App>>, headers: HeaderMap) -> Response {
    let mut rows = String::new();
    for world in app.worlds.list() {
        let stats = world.stats();
        let snapshot = world.outlet.latest.borrow().clone();
        let names: Vec<&str> = snapshot.roster.iter().map(|e| e.figure.as_str()).collect();
        let _ = write!(
            rows,
            "<tr><td>worlds/{}</td><td>{}</td><td>{:.0} Hz</td><td>{:.1} s</td><td>{:.0} %</td><td>{}</td></tr>",
            escaped(&world.id),
            escaped(&names.join(", ")),
            world.rate_hz,
            snapshot.time,
            stats.budget_used * 100.0,
            stats.viewers,
        );
    }
    if rows.is_empty() {
        rows.push_str("<tr><td colspan=6>No worlds yet.</td></tr>");
    }
    let address = headers
        .get(header::HOST)
        .and_then(|h| h.to_str().ok())
        .map_or_else(|| app.config.listen.to_string(), escaped);
    let page = PAGE
        .replace("{{version}}", env!("CARGO_PKG_VERSION"))
        .replace("{{address}}", &address)
        .replace("{{worlds}}", &rows);
    (
        [
            (header::CONTENT_TYPE, "text/html; charset=utf-8"),
            (header::CACHE_CONTROL, "no-store"),
            (
                header::CONTENT_SECURITY_POLICY,
                "default-src 'none'; style-src 'unsafe-inline'",
            ),
        ],
        page,
    )
        .into_response()
}
