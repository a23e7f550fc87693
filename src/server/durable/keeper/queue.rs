//! Entries that wait to be written, and the progress of writing: shared by the worlds and the writing thread.

use crate::durable::store::{
    CheckpointStore, Durability, Retention, StoreEntry, StoreItem, WorldKey, WorldRecord,
};
use bytes::Bytes;
use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, Weak};
use std::time::Instant;
use tokio::sync::watch;

/// Sizes of the queue and of the retained past.
#[derive(Clone, Copy, Debug)]
pub struct KeeperSizes {
    /// Bytes that wait to be written.
    pub queue_bytes: usize,
    /// The retained past.
    pub retention: Retention,
}

/// Times of losses of one world that are remembered for callers that are still waiting to learn of them.
const MAX_LOSSES: usize = 16;

/// Reason for the loss of entries that were handed in at the end.
pub(super) const TOO_LATE: &str = "the store has ended";

pub(super) type Request = Box<dyn FnOnce(&mut dyn CheckpointStore) + Send>;

/// Bytes that are produced when they are written, with their approximate number.
pub(super) type Later = (usize, Box<dyn FnOnce() -> Bytes + Send>);

/// An entry that waits.
pub(super) struct Queued {
    pub entry: StoreEntry,
    pub world: Arc<WorldState>,
    /// Produces its content, if that happens when it is written.
    pub later: Option<Box<dyn FnOnce() -> Bytes + Send>>,
}

impl Queued {
    /// The entry with its bytes. Slow, so call it on the writing thread.
    pub fn ready(self) -> (StoreEntry, Arc<WorldState>) {
        let mut entry = self.entry;
        if let Some(later) = self.later {
            entry.item = StoreItem::Input(later());
        }
        (entry, self.world)
    }
}

/// Place of an entry in the order of all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KeeperTicket(pub(super) u64);

#[derive(Default)]
pub(super) struct KeeperQueue {
    pub entries: Vec<Queued>,
    pub bytes: usize,
    /// Arrival of the first of them.
    pub begun: Option<Instant>,
    /// Whether a caller waits for one of them.
    pub urgent: bool,
    pub requests: Vec<Request>,
    /// Number of entries handed in.
    pub sent: u64,
    /// Entries that were taken out.
    pub taken: u64,
    /// All worlds that are written.
    pub worlds: Vec<Weak<WorldState>>,
    /// Set after a failure of the disk: until then only requested checkpoints are tried.
    pub retry_at: Option<Instant>,
    pub closing: bool,
    pub ended: bool,
}

impl KeeperQueue {
    /// Takes all entries out.
    pub fn take_entries(&mut self) -> Vec<Queued> {
        self.bytes = 0;
        self.begun = None;
        self.urgent = false;
        std::mem::take(&mut self.entries)
    }
}

/// Progress of writing of one world.
#[derive(Debug)]
pub(super) struct WorldState {
    pub key: WorldKey,
    pub name: String,
    pub durability: Durability,
    /// Only a checkpoint can be written, because something before it is missing or nothing was written yet. Changed
    /// with the queue locked.
    pub gap: AtomicBool,
    /// Whether something that should be written is missing.
    pub lossy: AtomicBool,
    /// Dropped entries: the first and the last of each gap before the next whole state, the oldest gap first.
    lost: Mutex<VecDeque<(u64, u64)>>,
    /// Last tick on disk.
    pub tick: AtomicU64,
}

impl WorldState {
    /// The state of a world of which nothing is written yet.
    pub fn new(world: &WorldRecord) -> Self {
        Self {
            key: world.key,
            name: world.name.clone(),
            durability: world.durability,
            gap: AtomicBool::new(true),
            lossy: AtomicBool::new(false),
            lost: Mutex::default(),
            tick: AtomicU64::new(0),
        }
    }

    /// Notes that entries are dropped. Returns whether they are the first since it was whole.
    pub fn lose(&self, first: u64, last: u64) -> bool {
        let went_on = self.lossy.swap(true, Ordering::Relaxed);
        let mut lost = locked(&self.lost);
        match lost.back_mut().filter(|_| went_on) {
            Some(before) => *before = (before.0.min(first), last),
            None => lost.push_back((first, last)),
        }
        if lost.len() > MAX_LOSSES {
            lost.pop_front();
        }
        !went_on
    }

    /// Logs the world of which something is not written.
    pub fn tell_loss(&self, why: &str) {
        let world = &*self.name;
        if self.durability == Durability::None {
            // The world hands in nothing else.
            tracing::error!(world, why, "the last state of the world is not written");
        } else {
            let tick = self.tick.load(Ordering::Relaxed);
            tracing::error!(
                world,
                after_tick = tick,
                why,
                "ticks of the world are not written"
            );
        }
    }

    /// Whether an entry was left out.
    pub fn has_lost(&self, ticket: KeeperTicket) -> bool {
        let lost = locked(&self.lost);
        lost.iter()
            .any(|(first, last)| (*first..=*last).contains(&ticket.0))
    }
}

pub(super) fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // Every holder leaves the value consistent.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

pub(super) struct KeeperShared {
    pub queue: Mutex<KeeperQueue>,
    pub filled: Condvar,
    /// Entries that are written or given up.
    pub done: watch::Sender<u64>,
    /// Reason why less is written than promised.
    pub degraded: watch::Sender<Option<String>>,
    pub sizes: KeeperSizes,
}

impl KeeperShared {
    /// An empty queue.
    pub fn new(sizes: KeeperSizes) -> Self {
        Self {
            queue: Mutex::default(),
            filled: Condvar::new(),
            done: watch::Sender::new(0),
            degraded: watch::Sender::new(None),
            sizes,
        }
    }

    /// Notes and logs that less is written than promised.
    pub fn degrade(&self, why: &str) {
        let new = self.degraded.send_if_modified(|now| {
            let new = now.is_none();
            *now = Some(why.to_owned());
            new
        });
        if new {
            tracing::error!(why, "worlds are not written as promised");
            metrics::gauge!("sinew_store_degraded").set(1.0);
        }
    }

    /// Notes and logs that everything is written again.
    pub fn recover(&self) {
        if self.degraded.send_if_modified(|now| now.take().is_some()) {
            tracing::info!("worlds are written as promised again");
            metrics::gauge!("sinew_store_degraded").set(0.0);
        }
    }
}
