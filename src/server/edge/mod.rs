//! The layer between the network and the services. It limits connections, checks the host of requests, limits their
//! size, and limits the bytes that wait for slow readers.
//!
//! It protects against strangers; a client within the limits does not notice it.

mod answers;
pub(super) mod connections;
mod errors;
pub(super) mod hosts;
mod refusal;
mod replies;
mod requests;
mod state;
mod uploads;

pub(super) use answers::answers;
pub(super) use errors::reasons;
pub(super) use refusal::unknown_method;
pub(super) use requests::sizes;
pub(super) use state::Edge;
pub(super) use uploads::Upload;

use axum::body::Body;
use axum::extract::{Request, State};
use axum::middleware::Next;
use axum::response::Response;
use connections::Peer;
use refusal::refused;
use replies::Reply;
use sinew_wire::status::Fault;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;
use tonic::transport::server::TcpConnectInfo;

/// Answers that are given even when all places are taken, and while the server ends.
const VITAL: [&str; 5] = [
    "/grpc.health.v1.Health/Check",
    "/grpc.health.v1.Health/Watch",
    "/livez",
    "/metrics",
    "/readyz",
];

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
