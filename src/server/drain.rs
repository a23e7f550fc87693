//! How the server ends: it announces the end, lets running work finish, writes its state to disk, and exits.

use super::app::App;
use super::edge::Edge;
use super::health::Health;
use std::future::Future;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::watch;

/// How long the states of all worlds may take to be written.
const WRITING: Duration = Duration::from_secs(30);

/// The parts of the server that have to end.
pub(super) struct Drain {
    pub app: Arc<App>,
    pub edge: Arc<Edge>,
    pub health: Health,
    /// Streams end when it turns true.
    pub stop: watch::Sender<bool>,
}

impl Drain {
    /// Ends everything once `shutdown` completes. When it returns, connections should close.
    pub(super) async fn run(self, shutdown: impl Future<Output = ()>) {
        shutdown.await;
        let Self {
            app,
            edge,
            health,
            stop,
        } = self;
        let config = &app.config;
        let seconds = Duration::from_secs_f64;
        tracing::info!("shutting down");
        // The announcement comes first, so that load balancers and supervisors see the end before it happens.
        app.worlds.refuse_new();
        health.end().await;
        tokio::time::sleep(seconds(config.lame_duck_s)).await;
        // New requests are told to try again later, elsewhere. Streams end; calls may finish.
        stop.send_replace(true);
        if !edge.finish(seconds(config.shutdown_grace_s)).await {
            tracing::warn!("calls were still worked on after the grace time");
        }
        app.conversions.close();
        app.simulations.close();
        if let Some(persistence) = &app.persistence {
            let written = tokio::time::timeout(WRITING, persistence.checkpoint_all(&app)).await;
            if written.is_err() {
                tracing::error!("the last states of worlds were not written within {WRITING:?}");
            }
        }
        app.worlds.drain().await; // ticks finish; waiting steps learn the reason
        if let Some(persistence) = &app.persistence {
            persistence.close().await;
        }
    }
}
