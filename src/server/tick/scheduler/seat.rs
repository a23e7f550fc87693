//! The work of one worker.
//!
//! Its mutex is held for the few instructions that change a heap, by workers and by those who wake a world. Nothing
//! else is done while holding it.

use super::priority::{Id, WorkerPriority};
use super::slot::{WorldSlot, lock};
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// No world of a seat needs another worker.
const NONE: u64 = u64::MAX;

/// A world that is due at some time.
#[derive(Debug)]
pub(super) struct DueWorld {
    pub at: Instant,
    /// It is void if the world has another stamp.
    pub stamp: u64,
    pub slot: Arc<WorldSlot>,
}

impl PartialEq for DueWorld {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for DueWorld {}
impl PartialOrd for DueWorld {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for DueWorld {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        let key = |e: &Self| (e.at, e.slot.number, e.stamp);
        key(self).cmp(&key(other))
    }
}

/// Worlds by the time of their next round, and the one that runs.
#[derive(Debug, Default)]
pub(super) struct SeatQueue {
    heap: BinaryHeap<Reverse<DueWorld>>,
    /// The thread that has the seat.
    pub epoch: u64,
    /// The world that it runs.
    pub running: Option<Arc<WorldSlot>>,
    /// Counts what it has begun to run.
    pub rounds: u64,
    /// Its thread, and how urgent that is.
    pub thread: Option<(Id, WorkerPriority)>,
    /// The thread was made less urgent because a round took long.
    pub lowered: bool,
    /// Until when it sleeps.
    sleeps: Option<Option<Instant>>,
}

impl SeatQueue {
    /// When the first one is due.
    pub fn top(&self) -> Option<Instant> {
        self.heap.peek().map(|Reverse(e)| e.at)
    }

    pub fn pop(&mut self) -> Option<DueWorld> {
        self.heap.pop().map(|Reverse(e)| e)
    }

    pub fn push(&mut self, entry: DueWorld) {
        self.heap.push(Reverse(entry));
    }

    /// Notes what its thread runs now.
    pub fn begin(&mut self, entry: &DueWorld) {
        self.running = Some(entry.slot.clone());
        self.rounds += 1;
    }
}

/// The place of one worker.
#[derive(Debug)]
pub(super) struct WorkerSeat {
    pub queue: Mutex<SeatQueue>,
    wake: Condvar,
    /// When the first world is due that its worker may have no time for, ns after the start.
    hint: AtomicU64,
    idle: AtomicBool,
}

impl Default for WorkerSeat {
    fn default() -> Self {
        Self {
            queue: Mutex::default(),
            wake: Condvar::new(),
            hint: AtomicU64::new(NONE),
            idle: AtomicBool::new(false),
        }
    }
}

impl WorkerSeat {
    /// Notes whose seat it is now.
    pub fn name_thread(&self, priority: WorkerPriority) {
        lock(&self.queue).thread = Some((Id::own(), priority));
    }

    /// Its worker sleeps, or looks for something to do.
    pub fn is_idle(&self) -> bool {
        self.idle.load(Ordering::SeqCst)
    }

    /// Its worker looks for something to do, or has found it. What others tell after it began to look reaches it: they
    /// tell first, then see who is idle; it does both the other way round.
    pub fn set_idle(&self, idle: bool) {
        self.idle.store(idle, Ordering::SeqCst);
    }

    /// Lets an idle worker look again.
    pub fn nudge(&self) {
        let _sleeps = lock(&self.queue);
        self.wake.notify_one();
    }

    /// Tells other workers what they may find here. A single world that does not run is its worker's own affair.
    /// Whether there was none before.
    pub fn hint(&self, queue: &SeatQueue, start: Instant) -> bool {
        let shared = queue.running.is_some() || queue.heap.len() > 1;
        let at = queue.top().filter(|_| shared);
        let ns = at.map_or(NONE, |at| (at - start).as_nanos() as u64);
        self.hint.swap(ns, Ordering::SeqCst) == NONE && ns != NONE
    }

    /// The hint that the seat has given.
    pub fn hinted(&self, start: Instant) -> Option<Instant> {
        let ns = self.hint.load(Ordering::SeqCst);
        (ns != NONE).then(|| start + Duration::from_nanos(ns))
    }

    /// Its worker runs nothing: the entry was void.
    pub fn rest(&self, start: Instant) {
        let mut queue = lock(&self.queue);
        queue.running = None;
        self.hint(&queue, start);
    }

    /// Adds a world, and wakes the worker if that sleeps for longer. Whether the worker may be too busy for it.
    pub fn push(&self, entry: DueWorld, start: Instant) -> bool {
        let mut queue = lock(&self.queue);
        let late = queue
            .sleeps
            .is_some_and(|until| until.is_none_or(|until| entry.at < until));
        queue.push(entry);
        let news = self.hint(&queue, start);
        if late {
            self.wake.notify_one();
        }
        news || queue.running.is_some()
    }

    /// Takes the first world if it was due before some time.
    pub fn steal(&self, before: Instant, start: Instant) -> Option<DueWorld> {
        let mut queue = lock(&self.queue);
        let overdue = queue.top().is_some_and(|at| at <= before);
        let entry = if overdue { queue.pop() } else { None };
        self.hint(&queue, start);
        entry
    }

    /// Sleeps until then, or until something comes.
    pub fn wait<'a>(
        &self,
        mut queue: MutexGuard<'a, SeatQueue>,
        until: Option<Instant>,
        now: Instant,
    ) -> MutexGuard<'a, SeatQueue> {
        queue.sleeps = Some(until);
        let mut queue = match until {
            Some(until) => {
                let time = until.saturating_duration_since(now);
                let waited = self.wake.wait_timeout(queue, time);
                waited.unwrap_or_else(PoisonError::into_inner).0
            }
            None => {
                let waited = self.wake.wait(queue);
                waited.unwrap_or_else(PoisonError::into_inner)
            }
        };
        queue.sleeps = None;
        queue
    }

    /// Takes all worlds, and wakes the worker so that it ends.
    pub fn clear(&self) -> Vec<DueWorld> {
        let mut queue = lock(&self.queue);
        let all = std::mem::take(&mut queue.heap);
        self.wake.notify_all();
        all.into_iter().map(|Reverse(e)| e).collect()
    }
}
