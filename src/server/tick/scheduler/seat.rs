//! The queue of one worker.
//!
//! Its mutex is held for the few instructions that change a heap, by workers and by those that wake a world. No other
//! work is done while holding it.

use super::priority::{Id, WorkerPriority};
use super::slot::{WorldSlot, lock};
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// No world in a seat needs another worker.
const NONE: u64 = u64::MAX;

/// A world that is due at some time.
#[derive(Debug)]
pub(super) struct DueWorld {
    pub at: Instant,
    /// The entry is void if the world has another stamp.
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

/// Worlds by the time of their next round, and the running one.
#[derive(Debug, Default)]
pub(super) struct SeatQueue {
    heap: BinaryHeap<Reverse<DueWorld>>,
    /// The thread that has the seat.
    pub epoch: u64,
    /// The world that the worker is running.
    pub running: Option<Arc<WorldSlot>>,
    /// Number of rounds begun.
    pub rounds: u64,
    /// Its thread, and the priority of that.
    pub thread: Option<(Id, WorkerPriority)>,
    /// Whether the priority of the thread was lowered because a round took long.
    pub lowered: bool,
    /// The time until which it sleeps.
    sleeps: Option<Option<Instant>>,
}

impl SeatQueue {
    /// The time when the first one is due.
    pub fn top(&self) -> Option<Instant> {
        self.heap.peek().map(|Reverse(e)| e.at)
    }

    pub fn pop(&mut self) -> Option<DueWorld> {
        self.heap.pop().map(|Reverse(e)| e)
    }

    pub fn push(&mut self, entry: DueWorld) {
        self.heap.push(Reverse(entry));
    }

    /// Notes which world its thread runs now.
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
    /// Time when the first world is due for which its worker may be too busy, ns after the start.
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
    /// Notes that this thread has the seat now.
    pub fn name_thread(&self, priority: WorkerPriority) {
        lock(&self.queue).thread = Some((Id::own(), priority));
    }

    /// Whether its worker sleeps, or looks for work.
    pub fn is_idle(&self) -> bool {
        self.idle.load(Ordering::SeqCst)
    }

    /// Notes whether its worker is looking for work. News that others give after the search began cannot be missed:
    /// others first give their news, then check which worker is idle; the worker does both in the opposite order.
    pub fn set_idle(&self, idle: bool) {
        self.idle.store(idle, Ordering::SeqCst);
    }

    /// Makes an idle worker look again.
    pub fn nudge(&self) {
        let _sleeps = lock(&self.queue);
        self.wake.notify_one();
    }

    /// Tells other workers what they may find here. A single world that is not running is left to its own worker.
    /// Returns whether there was no hint before.
    pub fn hint(&self, queue: &SeatQueue, start: Instant) -> bool {
        let shared = queue.running.is_some() || queue.heap.len() > 1;
        let at = queue.top().filter(|_| shared);
        let ns = at.map_or(NONE, |at| (at - start).as_nanos() as u64);
        self.hint.swap(ns, Ordering::SeqCst) == NONE && ns != NONE
    }

    /// The current hint of the seat.
    pub fn hinted(&self, start: Instant) -> Option<Instant> {
        let ns = self.hint.load(Ordering::SeqCst);
        (ns != NONE).then(|| start + Duration::from_nanos(ns))
    }

    /// Notes that its worker runs nothing, because the entry was void.
    pub fn rest(&self, start: Instant) {
        let mut queue = lock(&self.queue);
        queue.running = None;
        self.hint(&queue, start);
    }

    /// Adds a world, and wakes the worker if it would sleep for longer. Returns whether the worker may be too busy for
    /// it.
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

    /// Takes the first world if it was due before this time.
    pub fn steal(&self, before: Instant, start: Instant) -> Option<DueWorld> {
        let mut queue = lock(&self.queue);
        let overdue = queue.top().is_some_and(|at| at <= before);
        let entry = if overdue { queue.pop() } else { None };
        self.hint(&queue, start);
        entry
    }

    /// Sleeps until then, or until news arrives.
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
