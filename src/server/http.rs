//! Plain HTTP on the same port: the viewer, the status page and the metrics.

use super::access::roles::Role;
use super::app::App;
use super::edge::connections::Peer;
use super::edge::{Edge, unknown_method};
use super::telemetry;
use super::viewer;
use super::worlds::WorldHandle;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, Uri, header};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use axum::{Extension, Router};
use std::fmt::Write as _;
use std::sync::Arc;

/// Lets browser pages of known origins call gRPC-Web and read its trailers.
pub(super) fn cors(edge: Arc<Edge>) -> tower_http::cors::CorsLayer {
    use tower_http::cors::{AllowHeaders, AllowOrigin, CorsLayer};
    let known = AllowOrigin::predicate(move |origin, _| {
        origin
            .to_str()
            .is_ok_and(|origin| edge.hosts.allows(origin))
    });
    CorsLayer::new()
        .allow_origin(known)
        .allow_methods([http::Method::POST])
        .allow_headers(AllowHeaders::mirror_request()) // `*` does not stand for authorization
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
        .route("/livez", get(live))
        .route("/readyz", get(ready));
    let pages = if app.config.viewer {
        pages.merge(viewer::router())
    } else {
        pages.route("/", get(status_page))
    };
    pages.with_state(app)
}

/// The answer to a path that is neither page nor service. gRPC callers get a gRPC answer.
pub(super) async fn unknown(uri: Uri, headers: HeaderMap) -> Response {
    let kind = headers.get(header::CONTENT_TYPE);
    if let Some(kind) = kind.filter(|k| k.as_bytes().starts_with(b"application/grpc")) {
        let mut response = unknown_method(uri.path());
        response
            .headers_mut()
            .insert(header::CONTENT_TYPE, kind.clone());
        response
    } else {
        StatusCode::NOT_FOUND.into_response()
    }
}

/// The process answers.
async fn live() -> Response {
    "live\n".into_response()
}

/// Whether new clients are welcome.
async fn ready(State(app): State<Arc<App>>) -> Response {
    match app.unready() {
        Some(why) => (StatusCode::SERVICE_UNAVAILABLE, format!("{why}\n")).into_response(),
        None => "ready\n".into_response(),
    }
}

async fn metrics_page(State(app): State<Arc<App>>) -> Response {
    let budget = &app.worlds.budget;
    metrics::gauge!("sinew_budget_used_ratio").set(budget.used());
    metrics::gauge!("sinew_budget_limit_ratio").set(budget.limit());
    match telemetry::metrics::render() {
        Some(text) => ([(header::CONTENT_TYPE, "text/plain; version=0.0.4")], text).into_response(),
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

async fn status_page(
    State(app): State<Arc<App>>,
    peer: Option<Extension<Arc<Peer>>>,
    headers: HeaderMap,
) -> Response {
    let mut rows = String::new();
    // Only callers that may watch the world see its name.
    let peer = peer.as_deref().map(|p| &**p);
    let known = app.access.identity(&headers, peer).await.ok();
    let seen = |w: &WorldHandle| {
        let rights = known.as_ref().map(|i| w.grants.rights(i, &w.id));
        rights.is_some_and(|r| r.roles.contain(Role::Viewer))
    };
    for world in app.worlds.list().into_iter().filter(|w| seen(w)) {
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
        let text = if known.is_some() {
            "No worlds yet."
        } else {
            "Worlds are shown to those who may watch them."
        };
        let _ = write!(rows, "<tr><td colspan=6>{text}</td></tr>");
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
