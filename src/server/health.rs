//! The answers to probes over `grpc.health.v1`. `/livez` and `/readyz` answer the same.
//!
//! The empty name and `readiness` report whether new clients are welcome; `liveness` whether the process answers; the
//! name of a service whether that service does.

use super::api;
use super::app::App;
use std::time::Duration;
use tonic_health::ServingStatus::{self, NotServing, Serving};
use tonic_health::server::HealthReporter;

/// Answers as long as the process does.
pub const LIVENESS: &str = "liveness";
/// New clients are welcome.
pub const READINESS: &str = "readiness";
/// Names that report whether new clients are welcome.
const READY: [&str; 2] = ["", READINESS];
/// Interval at which readiness is checked.
const EVERY: Duration = Duration::from_millis(250);

/// Updates the health service.
#[derive(Clone)]
pub(super) struct Health(HealthReporter);

impl Health {
    /// Everything serves.
    pub(super) async fn new(reporter: HealthReporter) -> Self {
        let health = Self(reporter);
        health.set(&[LIVENESS], Serving).await;
        health.set(&READY, Serving).await;
        health.set(&api::SERVICE_NAMES, Serving).await;
        health
    }

    async fn set(&self, names: &[&str], status: ServingStatus) {
        for name in names {
            self.0.set_service_status(*name, status).await;
        }
    }

    /// Follows the readiness of the server; never ends.
    pub(super) async fn follow(&self, app: &App) {
        let mut before = true;
        loop {
            tokio::time::sleep(EVERY).await;
            let ready = app.unready().is_none();
            if ready != before {
                let status = if ready { Serving } else { NotServing };
                self.set(&READY, status).await;
                before = ready;
            }
        }
    }

    /// Reports that no service will serve for much longer. The server must have reported before that it is not ready.
    pub(super) async fn end(&self) {
        self.set(&READY, NotServing).await;
        self.set(&api::SERVICE_NAMES, NotServing).await;
    }
}
