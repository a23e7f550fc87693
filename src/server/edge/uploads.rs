//! Memory for requests: the bytes that are set aside for messages which are read or worked on.

use crate::calls::largest_request;
use crate::config::Config;
use std::sync::{Arc, Mutex, PoisonError};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

/// Bytes of requests that are read or worked on.
#[derive(Debug)]
pub(super) struct Uploads {
    /// Bytes that are free.
    pub free: Arc<Semaphore>,
    /// Most bytes.
    pub most: u64,
    /// Limit of most calls.
    pub small: Limit,
    /// Limit of calls that carry a file.
    pub large: Limit,
}

/// The part of `max_pending_bytes` that a request takes. Work that keeps the request also keeps this: it may outlast
/// the call, because it waits for its turn in an operation or continues after its client has gone.
#[derive(Clone, Debug, Default)]
pub(crate) struct Upload(Arc<Mutex<Option<OwnedSemaphorePermit>>>);

impl Upload {
    pub(super) fn set(&self, permit: Option<OwnedSemaphorePermit>) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = permit;
    }
}

/// Largest message of a call, and the setting that limits it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limit {
    /// The setting.
    pub name: &'static str,
    /// Bytes.
    pub bytes: usize,
}

impl Uploads {
    pub(super) fn new(config: &Config) -> Self {
        // The largest request fits in any case.
        let most = config.max_pending_bytes.max(largest_request(config) as u64);
        Self {
            free: Arc::new(Semaphore::new(most as usize)),
            most,
            small: Limit {
                name: "max_request_bytes",
                bytes: config.max_request_bytes as usize,
            },
            large: Limit {
                name: "max_clip_bytes",
                bytes: largest_request(config),
            },
        }
    }
}
