//! The thread that writes. Worlds leave what is to be written in a queue that is bounded by its bytes and go on; the
//! thread commits what has come within 10 ms as one group.
//!
//! Nothing waits for the disk but this thread. When it cannot keep up or the disk takes no more, entries are left out
//! and counted, the worlds they belong to are told to hand in a whole checkpoint, and the store is called degraded
//! until one is on disk again.

use super::store::{
    CheckpointStore, Durability, Entry, Item, Retention, StoreError, WorldKey, WorldRecord,
};
use bytes::Bytes;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, Weak};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tokio::sync::{oneshot, watch};

/// Time within which inputs are committed together.
pub const GROUP: Duration = Duration::from_millis(10);
/// Time between two looks at what can be cut off.
const UPKEEP: Duration = Duration::from_secs(1);
/// The same while there is more to delete: between them groups are committed.
const UPKEEP_AGAIN: Duration = Duration::from_millis(50);
/// Time between two tries on a disk that has failed.
const RETRY: Duration = Duration::from_secs(1);
/// Requests that wait for the thread.
const MAX_REQUESTS: usize = 1024;

/// Sizes of the queue and of what is held.
#[derive(Clone, Copy, Debug)]
pub struct Sizes {
    /// Bytes that wait to be written.
    pub queue_bytes: usize,
    /// What is held.
    pub retention: Retention,
}

type Request = Box<dyn FnOnce(&mut dyn CheckpointStore) + Send>;

/// Bytes that are worked out when they are written, and how many they are, about.
type Later = (usize, Box<dyn FnOnce() -> Bytes + Send>);

/// An entry that waits.
struct Queued {
    entry: Entry,
    world: Arc<WorldState>,
    /// What it holds, if that is worked out when it is written.
    later: Option<Box<dyn FnOnce() -> Bytes + Send>>,
}

impl Queued {
    fn ready(self) -> (Entry, Arc<WorldState>) {
        let mut entry = self.entry;
        if let Some(later) = self.later {
            entry.item = Item::Input(later());
        }
        (entry, self.world)
    }
}

/// Place of an entry in the order of all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ticket(u64);

#[derive(Default)]
struct Queue {
    entries: Vec<Queued>,
    bytes: usize,
    /// When the first of them came.
    begun: Option<Instant>,
    /// Somebody waits for one of them.
    urgent: bool,
    requests: Vec<Request>,
    /// Entries so far.
    sent: u64,
    /// Entries that were taken out.
    taken: u64,
    /// All worlds that are written.
    worlds: Vec<Weak<WorldState>>,
    /// The disk has failed; until then only checkpoints that were asked for are tried.
    retry_at: Option<Instant>,
    closing: bool,
    ended: bool,
}

/// What is known of the writing of one world.
#[derive(Debug)]
struct WorldState {
    key: WorldKey,
    name: String,
    durability: Durability,
    /// Nothing but a checkpoint can be written: something before it is missing, or nothing was written yet. Changed
    /// with the queue locked.
    gap: AtomicBool,
    /// Something that was to be written is missing.
    lossy: AtomicBool,
    /// Entries that were left out since the last checkpoint: the first and the last.
    lost: Mutex<Option<(u64, u64)>>,
    /// Last tick on disk.
    tick: AtomicU64,
}

impl WorldState {
    /// Notes that entries are left out.
    fn lose(&self, first: u64, last: u64) {
        let went_on = self.lossy.swap(true, Ordering::Relaxed);
        let mut lost = locked(&self.lost);
        let before = lost.filter(|_| went_on);
        *lost = Some((before.map_or(first, |l| l.0.min(first)), last));
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // Every holder leaves the value whole.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

struct Shared {
    queue: Mutex<Queue>,
    filled: Condvar,
    /// Entries that are written or given up.
    done: watch::Sender<u64>,
    /// Why less is written than was promised.
    degraded: watch::Sender<Option<String>>,
    sizes: Sizes,
}

impl Shared {
    fn degrade(&self, why: &str) {
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

    fn recover(&self) {
        if self.degraded.send_if_modified(|now| now.take().is_some()) {
            tracing::info!("worlds are written as promised again");
            metrics::gauge!("sinew_store_degraded").set(0.0);
        }
    }
}

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

/// Hands what is to be written to the thread that writes.
pub struct Keeper {
    shared: Arc<Shared>,
    thread: Mutex<Option<JoinHandle<()>>>,
}

impl Keeper {
    /// Starts the thread.
    ///
    /// # Errors
    /// There is no thread for it.
    pub fn start(store: Box<dyn CheckpointStore>, sizes: Sizes) -> Result<Self, StoreError> {
        let shared = Arc::new(Shared {
            queue: Mutex::default(),
            filled: Condvar::new(),
            done: watch::Sender::new(0),
            degraded: watch::Sender::new(None),
            sizes,
        });
        metrics::gauge!("sinew_store_degraded").set(0.0);
        let own = shared.clone();
        let thread = std::thread::Builder::new()
            .name("store".to_owned())
            .spawn(move || {
                let mut writer = Writer {
                    shared: own,
                    store,
                    upkeep_at: Instant::now() + UPKEEP,
                };
                writer.run();
            });
        let thread = thread.map_err(|e| StoreError::Io(format!("no thread for the store: {e}")))?;
        Ok(Self {
            shared,
            thread: Mutex::new(Some(thread)),
        })
    }

    /// What writes one world. Its first entry must be a checkpoint.
    pub fn recorder(&self, world: &WorldRecord) -> Recorder {
        let world = Arc::new(WorldState {
            key: world.key,
            name: world.name.clone(),
            durability: world.durability,
            gap: AtomicBool::new(true),
            lossy: AtomicBool::new(false),
            lost: Mutex::default(),
            tick: AtomicU64::new(0),
        });
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

    /// The same without waiting: it has its place in the order of all that is handed in when this returns.
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
                let _ = tx.send(f(store)); // who asked may have given up
            }));
        }
        self.shared.filled.notify_one();
        Ok(HandedIn(rx))
    }

    /// Why less is written than was promised; `None`: everything is.
    pub fn degraded(&self) -> Option<String> {
        self.shared.degraded.borrow().clone()
    }

    /// Writes what is left and ends. Blocks until it is done.
    pub fn close(&self) {
        locked(&self.shared.queue).closing = true;
        self.shared.filled.notify_one();
        let thread = locked(&self.thread).take();
        if let Some(thread) = thread {
            let _ = thread.join(); // a panic of it was reported where it happened
        }
    }
}

impl Drop for Keeper {
    fn drop(&mut self) {
        self.close();
    }
}

/// Writes one world. Its methods do not wait.
#[derive(Clone)]
pub struct Recorder {
    shared: Arc<Shared>,
    world: Arc<WorldState>,
}

impl std::fmt::Debug for Recorder {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Recorder").field(&self.world).finish()
    }
}

impl Recorder {
    /// Number of the world.
    pub fn world(&self) -> WorldKey {
        self.world.key
    }

    /// How much of the world may be lost.
    pub fn durability(&self) -> Durability {
        self.world.durability
    }

    /// Hands in what changed the world before a tick.
    pub fn input(&self, tick: u64, bytes: Bytes) -> Ticket {
        self.push(tick, Item::Input(bytes), None)
    }

    /// The same, with bytes that are worked out by the thread that writes: `size` of them, about.
    pub fn input_later(
        &self,
        tick: u64,
        size: usize,
        bytes: impl FnOnce() -> Bytes + Send + 'static,
    ) -> Ticket {
        self.push(
            tick,
            Item::Input(Bytes::new()),
            Some((size, Box::new(bytes))),
        )
    }

    /// Hands in the hash of the state after a tick.
    pub fn hash(&self, tick: u64, hash: u64) -> Ticket {
        self.push(tick, Item::Hash(hash), None)
    }

    /// Hands in the state after a tick.
    pub fn checkpoint(&self, tick: u64, bytes: Bytes) -> Ticket {
        let item = Item::Checkpoint {
            bytes,
            after_gap: false,
        };
        self.push(tick, item, None)
    }

    /// True if nothing is written until there is a new checkpoint, and one could be written now.
    pub fn needs_checkpoint(&self) -> bool {
        if self.world.durability == Durability::None || !self.world.gap.load(Ordering::Relaxed) {
            return false;
        }
        let queue = locked(&self.shared.queue);
        let room = queue.bytes < self.shared.sizes.queue_bytes / 2;
        room && queue.retry_at.is_none_or(|at| at <= Instant::now())
    }

    fn push(&self, tick: u64, mut item: Item, later: Option<Later>) -> Ticket {
        let world = &self.world;
        let mut queue = locked(&self.shared.queue);
        queue.sent += 1;
        let ticket = queue.sent;
        let is_checkpoint = matches!(item, Item::Checkpoint { .. });
        if world.durability == Durability::None && !is_checkpoint {
            return Ticket(ticket);
        }
        if queue.ended || world.gap.load(Ordering::Relaxed) && !is_checkpoint {
            world.lose(ticket, ticket);
            metrics::counter!("sinew_store_lost_entries_total").increment(1);
            return Ticket(ticket);
        }
        if let Item::Checkpoint { after_gap, .. } = &mut item {
            *after_gap = world.gap.load(Ordering::Relaxed);
        }
        let entry = Entry {
            world: world.key,
            tick,
            item,
        };
        let size = entry.size() + later.as_ref().map_or(0, |l| l.0);
        if queue.bytes + size > self.shared.sizes.queue_bytes {
            world.gap.store(true, Ordering::Relaxed);
            world.lose(ticket, ticket);
            drop(queue);
            metrics::counter!("sinew_store_lost_entries_total").increment(1);
            self.shared.degrade(&format!(
                "the disk is too slow: more than {} bytes wait for it",
                self.shared.sizes.queue_bytes
            ));
            return Ticket(ticket);
        }
        if is_checkpoint {
            world.gap.store(false, Ordering::Relaxed);
        }
        queue.bytes += size;
        queue.urgent |= world.durability == Durability::Each;
        let first = queue.entries.is_empty();
        queue.begun.get_or_insert_with(Instant::now);
        queue.entries.push(Queued {
            entry,
            world: world.clone(),
            later: later.map(|l| l.1),
        });
        let wake = first || queue.urgent;
        drop(queue);
        if wake {
            self.shared.filled.notify_one();
        }
        Ticket(ticket)
    }

    /// Waits until something that was handed in is on disk.
    ///
    /// # Errors
    /// It was left out, or the store has ended.
    pub async fn durable(&self, ticket: Ticket) -> Result<(), StoreError> {
        let mut done = self.shared.done.subscribe();
        let waited = done.wait_for(|done| *done >= ticket.0).await.is_ok();
        let lost = *locked(&self.world.lost);
        if lost.is_some_and(|(first, last)| (first..=last).contains(&ticket.0)) {
            let why = self.shared.degraded.borrow().clone();
            return Err(StoreError::Io(
                why.unwrap_or_else(|| "it was not written".to_owned()),
            ));
        }
        if waited {
            Ok(())
        } else {
            Err(StoreError::Ended)
        }
    }

    /// Last tick of it that is on disk.
    pub fn durable_tick(&self) -> u64 {
        self.world.tick.load(Ordering::Relaxed)
    }
}

struct Writer {
    shared: Arc<Shared>,
    store: Box<dyn CheckpointStore>,
    upkeep_at: Instant,
}

/// What the thread takes out of the queue.
struct Taken {
    entries: Vec<Queued>,
    requests: Vec<Request>,
    /// Tickets of the first entry and the last.
    tickets: (u64, u64),
    closing: bool,
}

impl Writer {
    fn run(&mut self) {
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

    /// From now on nobody waits for this thread.
    fn end(&self) {
        let mut queue = locked(&self.shared.queue);
        queue.ended = true;
        queue.requests.clear();
        let (first, last) = (queue.taken + 1, queue.sent);
        for late in queue.entries.drain(..) {
            late.world.lose(first, last);
        }
        drop(queue);
        self.shared.done.send_replace(u64::MAX);
    }

    /// Waits for a group, for requests, or for the time of the next upkeep.
    fn take(&self) -> Taken {
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
        queue.bytes = 0;
        queue.begun = None;
        queue.urgent = false;
        let first = queue.taken + 1;
        queue.taken = queue.sent;
        Taken {
            entries: std::mem::take(&mut queue.entries),
            requests: std::mem::take(&mut queue.requests),
            tickets: (first, queue.sent),
            closing: queue.closing,
        }
    }

    fn write(&mut self, entries: Vec<Queued>, first: u64) {
        let begun = Instant::now();
        let (entries, states): (Vec<Entry>, Vec<Arc<WorldState>>) =
            entries.into_iter().map(Queued::ready).unzip();
        let mut result = self.store.commit(&entries);
        if let Err(fault) = &result {
            // One more try where something could be done about it; a new log begins with checkpoints of all worlds.
            let repaired = self.store.repair(fault);
            if let Ok(Some(done)) = &repaired {
                tracing::warn!(%fault, done, "the store was repaired");
            }
            if matches!((fault, repaired), (StoreError::Full(_), Ok(_))) {
                result = self.store.commit(&entries);
            }
        }
        metrics::histogram!("sinew_store_commit_seconds").record(begun.elapsed().as_secs_f64());
        match result {
            Ok(()) => {
                let bytes: usize = entries.iter().map(Entry::size).sum();
                metrics::counter!("sinew_store_written_bytes_total").increment(bytes as u64);
                self.written(&entries, &states);
            }
            Err(fault) => self.failed(&fault, first),
        }
    }

    fn written(&self, entries: &[Entry], states: &[Arc<WorldState>]) {
        for (entry, state) in entries.iter().zip(states) {
            let before = state.tick.swap(entry.tick, Ordering::Relaxed);
            let is_checkpoint = matches!(entry.item, Item::Checkpoint { .. });
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

    /// Gives everything up that was handed in so far: all worlds begin anew with a checkpoint.
    fn failed(&self, fault: &StoreError, first: u64) {
        let mut queue = locked(&self.shared.queue);
        queue.retry_at = Some(Instant::now() + RETRY);
        // What has come since does not follow on anything any more.
        queue.entries.clear();
        queue.bytes = 0;
        queue.begun = None;
        queue.urgent = false;
        let last = queue.sent;
        let worlds: Vec<_> = queue.worlds.iter().filter_map(Weak::upgrade).collect();
        for world in worlds.iter().filter(|w| w.durability != Durability::None) {
            world.gap.store(true, Ordering::Relaxed);
            if !world.lossy.load(Ordering::Relaxed) {
                let tick = world.tick.load(Ordering::Relaxed);
                let name = &*world.name;
                tracing::error!(world = name, after_tick = tick, %fault, "ticks of the world are not written");
            }
            world.lose(first, last);
        }
        drop(queue);
        metrics::counter!("sinew_store_lost_entries_total").increment(last + 1 - first);
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
            // The next commit meets it too, and does something about it.
            Err(error) => tracing::warn!(%error, "old history was not cut off"),
        }
        metrics::histogram!("sinew_store_upkeep_seconds").record(begun.elapsed().as_secs_f64());
    }
}

/// A panic of the thread loses what it was about to write, and says so.
impl Drop for Writer {
    fn drop(&mut self) {
        if std::thread::panicking() {
            let first = *self.shared.done.borrow() + 1;
            let fault = StoreError::Io("the thread that writes has panicked".to_owned());
            self.failed(&fault, first);
            self.end();
        }
    }
}
