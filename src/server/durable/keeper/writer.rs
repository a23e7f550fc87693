//! The writing thread: it takes groups out of the queue, commits them, and maintains the disk.

use super::queue::{KeeperShared, Queued, Request, TOO_LATE, WorldState, locked};
use crate::durable::store::{
    CheckpointStore, Durability, Remedy, StoreEntry, StoreError, StoreItem, WorldKey,
};
use std::collections::HashSet;
use std::sync::atomic::Ordering;
use std::sync::{Arc, PoisonError, Weak};
use std::time::{Duration, Instant};

/// Time within which inputs are committed together.
const GROUP: Duration = Duration::from_millis(10);
/// Interval at which old history is cut off.
const UPKEEP: Duration = Duration::from_secs(1);
/// The same while there is more to delete; groups are committed in between.
const UPKEEP_AGAIN: Duration = Duration::from_millis(50);
/// Time between two attempts on a failed disk.
const RETRY: Duration = Duration::from_secs(1);

/// The thread that writes.
pub(super) struct StoreWriter {
    shared: Arc<KeeperShared>,
    store: Box<dyn CheckpointStore>,
    upkeep_at: Instant,
}

/// A group taken out of the queue.
struct TakenRequests {
    entries: Vec<Queued>,
    requests: Vec<Request>,
    /// Tickets of the first entry and the last.
    tickets: (u64, u64),
    closing: bool,
}

impl StoreWriter {
    pub fn new(shared: Arc<KeeperShared>, store: Box<dyn CheckpointStore>) -> Self {
        Self {
            shared,
            store,
            upkeep_at: Instant::now() + UPKEEP,
        }
    }

    /// Writes until the queue is closed.
    pub fn run(&mut self) {
        loop {
            let taken = self.take();
            if !taken.entries.is_empty() {
                self.write(taken.entries, taken.tickets.0);
            }
            self.shared.done.send_replace(taken.tickets.1);
            for request in taken.requests {
                request(&mut *self.store);
            }
            if self.upkeep_at <= Instant::now() {
                self.upkeep();
            }
            if taken.closing {
                break;
            }
        }
        self.end();
        if let Err(error) = self.store.close() {
            tracing::error!(%error, "the store did not end in good order");
        }
    }

    /// Lets no caller wait for this thread any more.
    fn end(&self) {
        let mut queue = locked(&self.shared.queue);
        queue.ended = true;
        queue.requests.clear();
        let (first, last) = (queue.taken + 1, queue.sent);
        let mut late: Vec<_> = queue.entries.drain(..).map(|q| q.world).collect();
        late.retain(|world| world.lose(first, last));
        drop(queue);
        for world in late {
            world.tell_loss(TOO_LATE);
        }
        self.shared.done.send_replace(u64::MAX);
    }

    /// Waits for a group, for requests, or for the time of the next upkeep.
    fn take(&self) -> TakenRequests {
        let mut queue = locked(&self.shared.queue);
        loop {
            let now = Instant::now();
            let group_at = queue.begun.map(|begun| begun + GROUP);
            let ready = queue.closing
                || !queue.requests.is_empty()
                || queue.urgent
                || group_at.is_some_and(|at| at <= now)
                || self.upkeep_at <= now;
            if ready {
                break;
            }
            let until = group_at.map_or(self.upkeep_at, |at| at.min(self.upkeep_at));
            let wait = until.saturating_duration_since(now);
            let waited = self.shared.filled.wait_timeout(queue, wait);
            queue = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
        metrics::gauge!("sinew_store_queue_bytes").set(queue.bytes as f64);
        let first = queue.taken + 1;
        queue.taken = queue.sent;
        TakenRequests {
            entries: queue.take_entries(),
            requests: std::mem::take(&mut queue.requests),
            tickets: (first, queue.sent),
            closing: queue.closing,
        }
    }

    fn write(&mut self, entries: Vec<Queued>, first: u64) {
        let begun = Instant::now();
        let (entries, states): (Vec<StoreEntry>, Vec<Arc<WorldState>>) =
            entries.into_iter().map(Queued::ready).unzip();
        let result = self.commit(&entries);
        metrics::histogram!("sinew_store_commit_seconds").record(begun.elapsed().as_secs_f64());
        match result {
            Ok(()) => {
                let bytes: usize = entries.iter().map(StoreEntry::size).sum();
                metrics::counter!("sinew_store_written_bytes_total").increment(bytes as u64);
                self.written(&entries, &states);
            }
            Err(fault) => self.failed(&fault, first, &states),
        }
    }

    /// Commits, with one more attempt if that may help.
    fn commit(&mut self, entries: &[StoreEntry]) -> Result<(), StoreError> {
        let mut before = None;
        loop {
            let Err(fault) = self.store.commit(entries) else {
                return Ok(());
            };
            let remedy = fault.remedy(before.as_ref());
            match self.store.repair(remedy) {
                Ok(Some(done)) => tracing::warn!(%fault, done, "the store was repaired"),
                Ok(None) => {}
                Err(error) => {
                    tracing::warn!(%fault, %error, "the store could not be repaired");
                    return Err(fault);
                }
            }
            match remedy {
                Remedy::Retry | Remedy::Free => before = Some(fault),
                // A new log begins with checkpoints of all worlds, so these entries are lost, too.
                Remedy::Pause | Remedy::NewLog => return Err(fault),
            }
        }
    }

    fn written(&self, entries: &[StoreEntry], states: &[Arc<WorldState>]) {
        for (entry, state) in entries.iter().zip(states) {
            let before = state.tick.swap(entry.tick, Ordering::Relaxed);
            let is_checkpoint = matches!(entry.item, StoreItem::Checkpoint { .. });
            if is_checkpoint && state.lossy.swap(false, Ordering::Relaxed) {
                let (world, tick) = (&*state.name, entry.tick);
                tracing::warn!(world, after_tick = before, tick, "history is whole again");
            }
        }
        let mut queue = locked(&self.shared.queue);
        queue.retry_at = None;
        let calm = queue.bytes < self.shared.sizes.queue_bytes / 2;
        drop(queue);
        if calm && !states.iter().any(|s| s.lossy.load(Ordering::Relaxed)) {
            self.shared.recover();
        }
    }

    /// Gives up everything that was handed in: all worlds start again with a checkpoint. `tried`: the worlds of which
    /// something should have been written.
    fn failed(&self, fault: &StoreError, first: u64, tried: &[Arc<WorldState>]) {
        let mut queue = locked(&self.shared.queue);
        queue.retry_at = Some(Instant::now() + RETRY);
        // Later entries no longer have a predecessor.
        let given_up = queue.take_entries();
        let last = queue.sent;
        let mut worlds: Vec<_> = queue.worlds.iter().filter_map(Weak::upgrade).collect();
        // A world that hands in only its last state loses nothing until it does.
        let waited = given_up.iter().map(|q| q.world.key);
        let handed_in: HashSet<WorldKey> = waited.chain(tried.iter().map(|w| w.key)).collect();
        worlds.retain(|w| w.durability != Durability::None || handed_in.contains(&w.key));
        for world in &worlds {
            world.gap.store(true, Ordering::Relaxed);
        }
        let was_whole: Vec<bool> = (worlds.iter()).map(|w| w.lose(first, last)).collect();
        drop(queue);
        drop(given_up); // megabytes, perhaps
        // Worlds wait for the queue, so log nothing while it is locked: logging may wait for a disk, too.
        for (world, _) in worlds.iter().zip(was_whole).filter(|(_, whole)| *whole) {
            world.tell_loss(&fault.to_string());
        }
        metrics::counter!("sinew_store_lost_entries_total")
            .increment((last + 1).saturating_sub(first));
        self.shared.degrade(&fault.to_string());
    }

    fn upkeep(&mut self) {
        self.upkeep_at = Instant::now() + UPKEEP;
        let begun = Instant::now();
        match self.store.cut(&self.shared.sizes.retention) {
            Ok(usage) => {
                metrics::gauge!("sinew_store_history_bytes").set(usage.history_bytes as f64);
                if usage.unswept {
                    self.upkeep_at = Instant::now() + UPKEEP_AGAIN;
                }
            }
            // The next commit meets the error too, and applies its remedy.
            Err(error) => tracing::warn!(%error, "old history was not cut off"),
        }
        metrics::histogram!("sinew_store_upkeep_seconds").record(begun.elapsed().as_secs_f64());
    }
}

/// A panic of the thread loses the entries that it was about to write, and this reports it.
impl Drop for StoreWriter {
    fn drop(&mut self) {
        if std::thread::panicking() {
            // Once it has ended, nothing is waiting that could be lost.
            let first = self.shared.done.borrow().saturating_add(1);
            let fault = StoreError::Io("the thread that writes has panicked".to_owned());
            self.failed(&fault, first, &[]);
            self.end();
        }
    }
}
