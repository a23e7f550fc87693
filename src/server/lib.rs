//! Everything that touches the network or the clock.
//!
//! [`run`] serves one port: gRPC, gRPC-Web, reflection, health, the viewer, a status page and metrics. A few threads
//! run the ticks of all worlds ([`tick::scheduler`]); services send worlds commands and read what they publish.

pub mod access;
pub mod api;
pub mod app;
pub mod calls;
pub mod checkpoints;
pub mod config;
pub mod demo;
pub mod durable;
pub mod encoded;
pub mod engine;
pub mod export;
pub mod fanout;
pub mod ingest;
pub mod late_viewers;
pub mod library;
pub mod operations;
pub mod persistence;
pub mod progress;
pub mod recordings;
pub mod rehearsals;
pub mod repeats;
pub mod shares;
pub mod simulate;
pub mod telemetry;
pub mod tick;
pub mod workers;
pub mod worlds;

pub mod health;

mod drain;
mod edge;
mod http;
#[cfg(test)]
mod testing;
mod viewer;

use app::App;
use axum::middleware::{from_fn, from_fn_with_state};
use config::Config;
use drain::Drain;
use edge::connections::{AGE_SPREAD, Connection};
use futures_util::{Stream, StreamExt as _};
use sinew_wire::DESCRIPTOR_SET;
use std::future::Future;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::TcpListener;
use tokio::sync::watch;
use tonic::service::Routes;
use tonic::transport::Server;

/// Any error, for `main` and for callers that only report.
pub type BoxError = Box<dyn std::error::Error + Send + Sync>;

/// Flow-control window of one stream: a few frames, so that a slow sender or reader is felt soon.
const STREAM_WINDOW: u32 = 256 * 1024;
/// Flow-control window of one connection.
const CONNECTION_WINDOW: u32 = 1024 * 1024;
/// Largest HTTP/2 frame.
const HTTP2_FRAME: u32 = 16 * 1024;
/// Largest set of request headers.
const HEADER_LIST: u32 = 16 * 1024;
/// Streams that were reset and not yet forgotten, per connection (rapid reset).
const RESET_STREAMS: usize = 32;
/// Streams of one connection that the server resets because the other side violated the protocol on them; one more ends
/// the connection ("made you reset"). tonic's own default is no limit.
const BROKEN_STREAMS: usize = 64;
/// Different ages at which connections are asked to close.
const AGES: usize = 8;

/// Serves until `shutdown` completes. Then it announces the end for the lame-duck time, ends streams, lets calls and
/// ticks finish, writes the states of worlds to disk and closes connections.
///
/// # Errors
/// The built-in data cannot be prepared, or the listener fails.
pub async fn run(
    config: Config,
    listener: TcpListener,
    shutdown: impl Future<Output = ()> + Send + 'static,
) -> Result<(), BoxError> {
    let (stop, stopping) = watch::channel(false);
    let app = Arc::new(App::new(Arc::new(config), stopping)?);
    app.restore().await;
    serve(app, listener, shutdown, stop).await
}

/// As [`run`], with an application that the caller has prepared; `stop` must be the sender of the receiver it was made
/// with.
///
/// # Errors
/// The listener fails.
pub async fn serve(
    app: Arc<App>,
    listener: TcpListener,
    shutdown: impl Future<Output = ()> + Send + 'static,
    stop: watch::Sender<bool>,
) -> Result<(), BoxError> {
    let config = app.config.clone();
    #[cfg(feature = "otlp")]
    let traces = telemetry::traces::start(&config)?;
    let (reporter, health_service) = tonic_health::server::health_reporter();
    let health = health::Health::new(reporter).await;
    let described = || {
        tonic_reflection::server::Builder::configure()
            .register_encoded_file_descriptor_set(DESCRIPTOR_SET)
            .register_encoded_file_descriptor_set(tonic_health::pb::FILE_DESCRIPTOR_SET)
    };
    let mut routes = Routes::builder();
    routes
        .add_service(health_service)
        .add_service(described().build_v1()?)
        .add_service(described().build_v1alpha()?); // ghz and other older tools ask for this one
    api::add_services(&mut routes, &app);
    // Without this, tonic's own fallback would answer for the pages below.
    let edge = edge::Edge::new(&config);
    let grpc = routes
        .routes()
        .into_axum_router()
        .reset_fallback()
        .layer(from_fn_with_state(edge.clone(), edge::sizes))
        .layer(from_fn_with_state(edge.clone(), edge::answers))
        .layer(from_fn_with_state(edge.clone(), edge::reasons))
        .layer(from_fn_with_state(app.access.clone(), access::identify))
        .layer(from_fn(telemetry::calls::observe))
        .layer(tonic_web::GrpcWebLayer::new())
        .layer(http::cors(edge.clone()));
    let router = grpc
        .merge(http::router(app.clone()))
        .fallback(http::unknown)
        .layer(from_fn_with_state(edge.clone(), edge::admit));

    let seconds = Duration::from_secs_f64;
    let server = Server::builder()
        .accept_http1(true) // status page, metrics, gRPC-Web from browsers
        .max_concurrent_streams(Some(config.max_streams_per_connection as u32))
        .initial_stream_window_size(STREAM_WINDOW)
        .initial_connection_window_size(CONNECTION_WINDOW)
        .max_frame_size(HTTP2_FRAME)
        .http2_max_header_list_size(HEADER_LIST)
        .http2_max_pending_accept_reset_streams(Some(RESET_STREAMS))
        .http2_max_local_error_reset_streams(Some(BROKEN_STREAMS))
        .http2_keepalive_interval(Some(seconds(config.keepalive_s)))
        .http2_keepalive_timeout(Some(seconds(config.keepalive_timeout_s)))
        .tcp_nodelay(true);

    let drain = Drain {
        app: app.clone(),
        edge: edge.clone(),
        health: health.clone(),
        stop,
    };
    let tls = app.access.tls.clone();
    let incoming = edge::connections::incoming(listener, edge.doors.clone(), tls);
    let (close, closing) = watch::channel(false);
    let serving = serve_ages(
        server,
        Routes::from(router),
        incoming,
        closing,
        config.max_connection_age_s,
    );
    tokio::pin!(serving);
    tokio::select! {
        ended = &mut serving => ended?,
        () = async {
            drain.run(shutdown).await;
            close.send_replace(true);
            tokio::time::sleep(seconds(config.shutdown_grace_s)).await;
        } => tracing::warn!("connections were still open after the grace time"),
        () = app.access.keep_fresh() => {} // never ends
        () = health.follow(&app) => {} // likewise
        () = app.end_idle_worlds() => {}
    }
    #[cfg(feature = "otlp")]
    if let Some(traces) = traces {
        traces.close().await;
    }
    tracing::info!("stopped");
    Ok(())
}

/// Serves connections. Those that may not grow older than `age_s` are asked to close at ages around it: each of the
/// transport's servers asks at one age, and connections are dealt out to them in turn.
async fn serve_ages(
    server: Server,
    routes: Routes,
    incoming: impl Stream<Item = std::io::Result<Connection>> + Send + 'static,
    closing: watch::Receiver<bool>,
    age_s: f64,
) -> Result<(), tonic::transport::Error> {
    let count = if age_s > 0.0 { AGES } else { 1 };
    let closed = || {
        let mut closing = closing.clone();
        async move {
            let _ = closing.wait_for(|c| *c).await; // an error says the same
        }
    };
    let (hands, taken): (Vec<_>, Vec<_>) =
        (0..count).map(|_| tokio::sync::mpsc::channel(1)).unzip();
    let all = taken.into_iter().enumerate().map(|(n, taken)| {
        let mut server = server.clone();
        if age_s > 0.0 {
            let spread = (n as f64 + 0.5) / count as f64 * 2.0 - 1.0;
            let age = age_s * (1.0 + AGE_SPREAD * spread);
            server = server.max_connection_age(Duration::from_secs_f64(age));
        }
        let incoming = futures_util::stream::unfold(taken, |mut taken| async move {
            let next = taken.recv().await?;
            Some((next, taken))
        });
        let server = server.add_routes(routes.clone());
        server.serve_with_incoming_shutdown(incoming, closed())
    });
    let deal = async {
        let mut incoming = std::pin::pin!(incoming);
        for hand in hands.iter().cycle() {
            let Some(next) = incoming.next().await else {
                break;
            };
            if hand.send(next).await.is_err() {
                break; // it closes
            }
        }
    };
    let mut served = std::pin::pin!(futures_util::future::try_join_all(all));
    let served = tokio::select! {
        served = &mut served => served,
        () = closed() => served.await,
        () = deal => served.await,
    };
    served.map(|_| ())
}
