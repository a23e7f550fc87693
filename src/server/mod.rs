//! Everything that touches the network or the clock.
//!
//! [`run`] serves one port: gRPC, gRPC-Web, reflection, health, the viewer, a status page and metrics. Each world has a
//! thread of its own that runs [`tick::run`]; services send it commands and read what it publishes.

pub mod access;
pub mod api;
pub mod checkpoints;
pub mod config;
pub mod demo;
pub mod durable;
pub mod engine;
pub mod fanout;
pub mod ingest;
pub mod library;
pub mod operations;
pub mod persistence;
pub mod progress;
pub mod repeats;
pub mod shares;
pub mod simulate;
pub mod telemetry;
pub mod tick;
pub mod workers;
pub mod worlds;

mod edge;
mod http;
mod viewer;

use crate::wire::DESCRIPTOR_SET;
use api::App;
use axum::middleware::{from_fn, from_fn_with_state};
use config::Config;
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
/// Streams of one connection that the server resets because the other side broke the protocol on them; one more ends
/// the connection ("made you reset"). tonic's own default is no limit.
const BROKEN_STREAMS: usize = 64;

/// Serves until `shutdown` completes, then says so for the lame-duck time, tells streams, finishes the ticks and
/// returns within the grace time.
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
    let (health, health_service) = tonic_health::server::health_reporter();
    for name in api::SERVICE_NAMES {
        health
            .set_service_status(name, tonic_health::ServingStatus::Serving)
            .await;
    }
    let described = || {
        tonic_reflection::server::Builder::configure()
            .register_encoded_file_descriptor_set(DESCRIPTOR_SET)
            .register_encoded_file_descriptor_set(tonic_health::pb::FILE_DESCRIPTOR_SET)
            .register_encoded_file_descriptor_set(tonic_types::pb::FILE_DESCRIPTOR_SET)
    };
    let mut routes = Routes::builder();
    routes
        .add_service(health_service)
        .add_service(described().build_v1()?)
        .add_service(described().build_v1alpha()?); // what ghz and other older tools ask for
    api::add_services(&mut routes, &app);
    // tonic's own fallback would answer for the pages below.
    let edge = edge::Edge::new(&config);
    let grpc = routes
        .routes()
        .into_axum_router()
        .reset_fallback()
        .layer(from_fn_with_state(edge.clone(), edge::sizes))
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
    let mut server = Server::builder()
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

    let mut stopping = stop.subscribe();
    let drain = {
        let app = app.clone();
        async move {
            shutdown.await;
            tracing::info!("shutting down");
            for name in api::SERVICE_NAMES {
                health
                    .set_service_status(name, tonic_health::ServingStatus::NotServing)
                    .await;
            }
            // Whoever looks after this server sees that it ends before it does.
            app.worlds.refuse_new();
            tokio::time::sleep(seconds(app.config.lame_duck_s)).await;
            stop.send_replace(true); // streams end with UNAVAILABLE
            app.conversions.close();
            app.simulations.close();
            if let Some(persistence) = &app.persistence {
                persistence.checkpoint_all(&app).await;
            }
            app.worlds.drain().await; // ticks end whole
            if let Some(persistence) = &app.persistence {
                persistence.close().await;
            }
        }
    };
    let tls = app.access.tls.as_ref().map(|tls| tls.acceptor.clone());
    let incoming = edge::connections::incoming(listener, edge.doors.clone(), tls);
    let serving = server
        .add_routes(Routes::from(router))
        .serve_with_incoming_shutdown(incoming, drain);
    tokio::pin!(serving);
    tokio::select! {
        ended = &mut serving => ended?,
        () = async {
            // The sender lives in the future above; it only goes when that one ends.
            let _ = stopping.wait_for(|s| *s).await;
            tokio::time::sleep(seconds(config.shutdown_grace_s)).await;
        } => tracing::warn!("connections were still open after the grace time"),
        () = app.access.keep_fresh() => {} // never ends
        () = app.end_idle_worlds() => {}   // nor does this
    }
    #[cfg(feature = "otlp")]
    if let Some(traces) = traces {
        traces.close().await;
    }
    #[cfg(feature = "otlp")]
    if let Some(traces) = traces {
        traces.close().await;
    }
    tracing::info!("stopped");
    Ok(())
}
