//! The state of the edge: its limits, and the places that are taken.

use super::connections::Doors;
use super::hosts::Hosts;
use super::replies::Unread;
use super::uploads::Uploads;
use crate::config::Config;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use tokio::sync::Semaphore;

/// The state of the edge.
pub(crate) struct Edge {
    /// Connections.
    pub(crate) doors: Arc<Doors>,
    /// Known names.
    pub(crate) hosts: Hosts,
    pub(super) uploads: Uploads,
    pub(super) unread: Arc<Unread>,
    pub(super) requests: Arc<Semaphore>,
    pub(super) max_requests: u64,
    /// Whether the server is ending: new requests are refused.
    pub(super) ending: AtomicBool,
    pub(super) max_requests_of_one: u64,
    /// How long a request may take before its response begins.
    pub(super) timeout: Duration,
}

impl Edge {
    /// With the limits of the settings.
    pub(crate) fn new(config: &Config) -> Arc<Self> {
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

    /// Refuses new requests, and waits for the end of those that are worked on: whether all have ended within
    /// `patience`.
    pub(crate) async fn finish(&self, patience: Duration) -> bool {
        self.ending.store(true, Ordering::SeqCst);
        // Each request has one of these places.
        let all = u32::try_from(self.max_requests).unwrap_or(u32::MAX);
        let done = tokio::time::timeout(patience, self.requests.acquire_many(all)).await;
        done.is_ok()
    }
}
