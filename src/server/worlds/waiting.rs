//! Commands that wait for a world, by client: one client fills no more than its share of a queue.

use crate::shares::part;
use sinew_wire::status::Fault;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Number of waiting commands of each client.
#[derive(Clone, Debug)]
pub(super) struct WaitingCommands {
    by_client: Arc<Mutex<HashMap<Arc<str>, u64>>>,
    most: u64,
    share: f64,
}

/// A command that waits, as long as this is there.
pub(super) struct Waits {
    waiting: WaitingCommands,
    client: Arc<str>,
}

impl Drop for Waits {
    fn drop(&mut self) {
        let mut all = self.waiting.lock();
        if let Some(count) = all.get_mut(&self.client) {
            *count -= 1;
            if *count == 0 {
                all.remove(&self.client);
            }
        }
    }
}

impl WaitingCommands {
    /// No commands yet, for a queue that holds `most`, of which one client may have `share`.
    pub fn new(most: u64, share: f64) -> Self {
        Self {
            by_client: Arc::default(),
            most,
            share,
        }
    }

    /// Commands that the queue holds.
    pub fn most(&self) -> u64 {
        self.most
    }

    fn lock(&self) -> MutexGuard<'_, HashMap<Arc<str>, u64>> {
        // One number more or less at a time.
        self.by_client
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    /// Counts one more command of a client.
    ///
    /// # Errors
    /// The client already has its share.
    pub fn enter(&self, client: &Arc<str>) -> Result<Waits, Fault> {
        let mut all = self.lock();
        let count = all.entry(client.clone()).or_default();
        let own = part(self.most, self.share);
        if *count >= own {
            return Err(Fault::Exhausted {
                limit: "command_queue",
                value: self.most,
                message: format!("one client may have {own} of them (max_client_share)"),
                retry: Some(Duration::from_millis(20)),
            });
        }
        *count += 1;
        Ok(Waits {
            waiting: self.clone(),
            client: client.clone(),
        })
    }
}
