//! The layer between the network and the services. It limits connections, checks the host of requests, limits their
//! size, and limits the bytes that wait for slow readers.
//!
//! It protects against strangers; a client within the limits does not notice it.

mod answers;
pub(super) mod connections;
mod errors;
pub(super) mod hosts;
mod replies;
mod requests;

pub(super) use answers::answers;
pub(super) use errors::reasons;
pub(super) use requests::{Upload, sizes};

use super::config::Config;
use super::telemetry::count_refusal;
use axum::body::Body;
use axum::extract::{Request, State};
use axum::http::header;
use axum::middleware::Next;
use axum::response::{IntoResponse as _, Response};
use connections::{Doors, Peer};
use hosts::Hosts;
use replies::{Reply, Unread};
use requests::Uploads;
use sinew_wire::status::Fault;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use tokio::sync::Semaphore;
use tonic::Status;
use tonic::transport::server::TcpConnectInfo;

/// Answers that are given even when all places are taken, and while the server ends.
const VITAL: [&str; 5] = [
    "/grpc.health.v1.Health/Check",
    "/grpc.health.v1.Health/Watch",
    "/livez",
    "/metrics",
    "/readyz",
];

/// The state of the edge.
pub(super) struct Edge {
    /// Connections.
    pub doors: Arc<Doors>,
    /// Known names.
    pub hosts: Hosts,
    uploads: Uploads,
    unread: Arc<Unread>,
    requests: Arc<Semaphore>,
    max_requests: u64,
    /// Whether the server is ending, so that new requests are refused.
    ending: AtomicBool,
    max_requests_of_one: u64,
    /// Longest time of a request before its response begins.
    timeout: Duration,
}

impl Edge {
    /// An edge with the limits of the settings.
    pub(super) fn new(config: &Config) -> Arc<Self> {
        Arc::new(Self {
            doors: Doors::new(config),
            hosts: Hosts::new(config),
            uploads: Uploads::new(config),
            unread: Unread::new(config.max_unread_bytes),
            requests: Arc::new(Semaphore::new(config.max_requests as usize)),
            max_requests: config.max_requests,
            ending: AtomicBool::new(false),
            max_requests_of_one: config.max_requests_per_connection,
            timeout: Duration::from_secs_f64(config.request_timeout_s),
        })
    }

    /// Refuses requests from now on, and waits for the end of those in progress. Returns false if some are left after
    /// `patience`.
    pub(super) async fn finish(&self, patience: Duration) -> bool {
        self.ending.store(true, Ordering::SeqCst);
        // Each request has one of these places.
        let all = u32::try_from(self.max_requests).unwrap_or(u32::MAX);
        let done = tokio::time::timeout(patience, self.requests.acquire_many(all)).await;
        done.is_ok()
    }
}

/// Lets a request pass: for this server, over a connection that may make it, and while there is a place for it.
pub(super) async fn admit(
    State(edge): State<Arc<Edge>>,
    mut request: Request,
    next: Next,
) -> Response {
    let Some(peer) = request.extensions().get::<Arc<Peer>>().cloned() else {
        return next.run(request).await; // not over the network
    };
    // Services read the sender's address from this.
    request.extensions_mut().insert(TcpConnectInfo {
        local_addr: None,
        remote_addr: Some(peer.address),
    });
    let open = Arc::new(peer.open());
    let vital = VITAL.contains(&request.uri().path());
    if let Err(fault) = edge.hosts.check(request.uri(), request.headers()) {
        return refused(fault, &request);
    }
    if peer.reserved && !vital {
        return refused(
            Fault::Exhausted {
                limit: "max_connections",
                value: edge.doors.most(),
                message: "only health and /metrics are answered over one more connection".into(),
                retry: Some(Duration::from_secs(1)),
            },
            &request,
        );
    }
    if edge.ending.load(Ordering::SeqCst) && !vital {
        return refused(Fault::Draining, &request);
    }
    if peer.open_requests() > edge.max_requests_of_one && !vital {
        return refused(
            Fault::Exhausted {
                limit: "max_requests_per_connection",
                value: edge.max_requests_of_one,
                message: "one more request at a time over this connection".into(),
                retry: Some(Duration::from_millis(100)),
            },
            &request,
        );
    }
    let place = if vital {
        None
    } else {
        edge.requests.clone().try_acquire_owned().ok()
    };
    if place.is_none() && !vital {
        return refused(
            Fault::Exhausted {
                limit: "max_requests",
                value: edge.max_requests,
                message: "one more request at a time".into(),
                retry: Some(Duration::from_millis(100)),
            },
            &request,
        );
    }
    let unread = (!vital).then(|| edge.unread.clone());
    request.extensions_mut().insert(open.clone());
    let response = next.run(request).await;
    // No part of an answer that is counted as a whole waits for room.
    let whole = response.extensions().get::<answers::Counted>().is_some();
    let unread = unread.filter(|_| !whole);
    response.map(|body| Body::new(Reply::new(body, unread, open, place)))
}

/// A refusal in the sender's protocol: a gRPC status, or a page with a sentence.
fn refused(fault: Fault, request: &Request) -> Response {
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
