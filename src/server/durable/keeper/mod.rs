//! The writing thread.
//!
//! Worlds put their entries into a queue bounded by its bytes and continue; the thread commits the entries of 10 ms as
//! one group. Only this thread waits for the disk. When it cannot keep up or the disk accepts no more, entries are
//! dropped and counted, their worlds are told to hand in a whole checkpoint, and the store counts as degraded until one
//! is on disk again.
//!
//! Worlds hand in entries through a [`recorder`]; [`queue`] holds the waiting entries, and [`writer`] is the thread.

mod queue;
mod recorder;
#[cfg(test)]
mod tests;
mod writer;

pub use queue::{KeeperSizes, KeeperTicket};
pub use recorder::Recorder;

use super::store::{CheckpointStore, StoreError, WorldRecord};
use queue::{KeeperShared, WorldState, locked};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use tokio::sync::oneshot;
use writer::StoreWriter;

/// Requests that wait for the thread.
const MAX_REQUESTS: usize = 1024;

/// A request that has its place in the order of all.
#[derive(Debug)]
pub struct HandedIn<T>(oneshot::Receiver<Result<T, StoreError>>);

impl<T> HandedIn<T> {
    /// Waits until it is done.
    ///
    /// # Errors
    /// Its own; the store has ended.
    pub async fn done(self) -> Result<T, StoreError> {
        self.0.await.unwrap_or(Err(StoreError::Ended))
    }

    /// The same. Blocks: not on an async thread.
    ///
    /// # Errors
    /// Its own; the store has ended.
    pub fn wait(self) -> Result<T, StoreError> {
        self.0.blocking_recv().unwrap_or(Err(StoreError::Ended))
    }
}

/// Hands entries to the writing thread.
pub struct Keeper {
    shared: Arc<KeeperShared>,
    thread: Mutex<Option<JoinHandle<()>>>,
}

impl Keeper {
    /// Starts the thread.
    ///
    /// # Errors
    /// There is no thread for it.
    pub fn start(store: Box<dyn CheckpointStore>, sizes: KeeperSizes) -> Result<Self, StoreError> {
        let shared = Arc::new(KeeperShared::new(sizes));
        metrics::gauge!("sinew_store_degraded").set(0.0);
        let own = shared.clone();
        let thread = std::thread::Builder::new()
            .name("store".to_owned())
            .spawn(move || StoreWriter::new(own, store).run());
        let thread = thread.map_err(|e| StoreError::Io(format!("no thread for the store: {e}")))?;
        Ok(Self {
            shared,
            thread: Mutex::new(Some(thread)),
        })
    }

    /// The recorder of one world. Its first entry must be a checkpoint.
    pub fn recorder(&self, world: &WorldRecord) -> Recorder {
        let world = Arc::new(WorldState::new(world));
        let mut queue = locked(&self.shared.queue);
        queue.worlds.retain(|w| w.strong_count() > 0);
        queue.worlds.push(Arc::downgrade(&world));
        Recorder {
            shared: self.shared.clone(),
            world,
        }
    }

    /// Does something with the store on its thread, after everything that was handed in before.
    ///
    /// # Errors
    /// Those of `f`; too many requests wait; the store has ended.
    pub async fn call<T: Send + 'static>(
        &self,
        f: impl FnOnce(&mut dyn CheckpointStore) -> Result<T, StoreError> + Send + 'static,
    ) -> Result<T, StoreError> {
        self.hand_in(f)?.done().await
    }

    /// [`Self::call`] without waiting: when this returns, the request has its place in the order of everything handed
    /// in.
    ///
    /// # Errors
    /// Too many requests wait; the store has ended.
    pub fn hand_in<T: Send + 'static>(
        &self,
        f: impl FnOnce(&mut dyn CheckpointStore) -> Result<T, StoreError> + Send + 'static,
    ) -> Result<HandedIn<T>, StoreError> {
        let (tx, rx) = oneshot::channel();
        {
            let mut queue = locked(&self.shared.queue);
            if queue.closing || queue.ended {
                return Err(StoreError::Ended);
            }
            if queue.requests.len() >= MAX_REQUESTS {
                return Err(StoreError::Io(format!(
                    "{MAX_REQUESTS} requests wait for the disk"
                )));
            }
            queue.requests.push(Box::new(move |store| {
                let _ = tx.send(f(store)); // the caller may have given up
            }));
        }
        self.shared.filled.notify_one();
        Ok(HandedIn(rx))
    }

    /// Reason why less is written than promised; `None` if everything is.
    pub fn degraded(&self) -> Option<String> {
        self.shared.degraded.borrow().clone()
    }

    /// Writes the remaining entries and ends. Blocks until it is done.
    pub fn close(&self) {
        locked(&self.shared.queue).closing = true;
        self.shared.filled.notify_one();
        let thread = locked(&self.thread).take();
        if let Some(thread) = thread {
            let _ = thread.join(); // its panic was reported where it happened
        }
    }
}

impl Drop for Keeper {
    fn drop(&mut self) {
        self.close();
    }
}
