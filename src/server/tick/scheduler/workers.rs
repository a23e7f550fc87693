//! The workers: each runs the worlds of its seat and helps others.

use super::news::News;
use super::priority::{self, Duty, WorkerPriority};
use super::seat::{DueWorld, WorkerSeat};
use super::slot::{SlotPlace, SlotState, WorldSlot, lock};
use crate::tick::{Next, Runner};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

/// Processor time of one round from which a world belongs to the long lane. It returns when its mean is half of that.
const LONG: Duration = Duration::from_millis(1);
/// How long a world is overdue before another worker takes it, so that its own worker has time to wake up.
const STEAL_AFTER: Duration = Duration::from_micros(200);
/// Least time between two checks by an idle worker of the seats of others.
const STEAL_EVERY: Duration = Duration::from_millis(1);
/// How worlds are run.
#[derive(Clone, Copy, Debug)]
pub struct SchedulerPlan {
    /// Workers in each lane; 0: one less than there are processors, and at least one.
    pub workers: usize,
    /// Highest priority of workers.
    pub priority: WorkerPriority,
    /// A round that takes longer is reported.
    pub slow: Duration,
    /// A round that takes longer is given up, with its world and its thread.
    pub stuck: Duration,
}

impl SchedulerPlan {
    pub(super) fn width(&self) -> usize {
        match self.workers {
            0 => thread::available_parallelism().map_or(1, |n| n.get().saturating_sub(1).max(1)),
            n => n,
        }
    }
}

/// The state that all threads share.
#[derive(Debug)]
pub(super) struct Workers {
    pub plan: SchedulerPlan,
    /// Short lane, then long lane.
    pub seats: Vec<WorkerSeat>,
    pub width: usize,
    pub start: Instant,
    pub next: AtomicU64,
    pub ending: AtomicBool,
    /// The lowest priority among the workers of the short lane.
    pub obtained: Mutex<Option<WorkerPriority>>,
    /// Worlds whose rounds do not end, by the number of their thread.
    pub stuck: Mutex<Vec<(u64, Arc<str>)>>,
    pub threads: AtomicU64,
}

impl Workers {
    /// Starts a thread for a seat. A thread that had the seat before leaves it.
    pub(super) fn spawn(self: Arc<Self>, seat: usize) -> std::io::Result<()> {
        let epoch = self.threads.fetch_add(1, Ordering::Relaxed) + 1;
        lock(&self.seats[seat].queue).epoch = epoch;
        let name = match seat.checked_sub(self.width) {
            None => format!("tick {seat}"),
            Some(seat) => format!("long tick {seat}"),
        };
        let builder = thread::Builder::new().name(name);
        builder.spawn(move || self.work(seat, epoch)).map(|_| ())
    }

    /// The loop of a worker.
    fn work(&self, seat: usize, epoch: u64) {
        let duty = if seat < self.width {
            Duty::Short
        } else {
            Duty::Long
        };
        let obtained = priority::raise(duty, self.plan.priority);
        self.seats[seat].name_thread(obtained);
        if duty == Duty::Short {
            let mut least = lock(&self.obtained);
            *least = Some(least.map_or(obtained, |l| l.max(obtained)));
            if seat == 0 {
                let (workers, priority) = (self.width, obtained.to_string());
                tracing::info!(
                    workers,
                    priority,
                    "workers for short ticks, and as many for long ones"
                );
            }
        }
        let mut news = News::default();
        while let Some(entry) = self.next_entry(seat, epoch, &mut news) {
            if std::mem::take(&mut lock(&self.seats[seat].queue).lowered) {
                priority::raise(duty, self.plan.priority);
            }
            let Some(mut runner) = self.take(&entry, seat) else {
                self.seats[seat].rest(self.start);
                continue;
            };
            let begun = Instant::now();
            let next = catch_unwind(AssertUnwindSafe(|| runner.round()));
            let took = begun.elapsed();
            if let Some(outlet) = runner.take_news() {
                news.add(outlet);
            }
            if took > self.plan.slow {
                let (world, tick) = (&*entry.slot.world, runner.tick());
                let seconds = took.as_secs_f64();
                metrics::counter!("sinew_slow_ticks_total").increment(1);
                tracing::warn!(world, tick, seconds, "a tick took long");
            }
            let next = next.unwrap_or_else(|_| {
                // Code that may panic is guarded where it is called, so this is an error of the loop itself.
                entry.slot.give_up("a round of its loop panicked");
                Next::Ended
            });
            if !self.give_back(&entry.slot, runner, next, (seat, epoch)) {
                let mut stuck = lock(&self.stuck);
                stuck.retain(|(thread, _)| *thread != epoch);
                metrics::gauge!("sinew_stuck_worlds").set(stuck.len() as f64);
                drop(stuck);
                let (world, seconds) = (&*entry.slot.world, took.as_secs_f64());
                tracing::warn!(world, seconds, "a tick that was given up has ended");
                return;
            }
            // The next tick of the long lane may take long, and no frame should wait for it.
            if duty == Duty::Long || news.is_due() {
                news.tell();
            }
        }
    }

    /// Waits for the next world to run, and announces the news before. `None`: the thread has to end.
    fn next_entry(&self, own: usize, epoch: u64, news: &mut News) -> Option<DueWorld> {
        let seat = &self.seats[own];
        let mut queue = lock(&seat.queue);
        let found = loop {
            if self.ending.load(Ordering::SeqCst) || queue.epoch != epoch {
                break None;
            }
            seat.set_idle(true);
            let now = Instant::now();
            // The world that has been due for the longest, among its own and those that others leave overdue.
            let due = queue.top().filter(|at| *at <= now);
            let hint = self.others(own);
            let overdue = hint.filter(|(at, _)| *at + STEAL_AFTER <= now);
            if let Some((at, other)) = overdue
                && due.is_none_or(|own| at < own)
            {
                drop(queue);
                let stolen = self.seats[other].steal(now - STEAL_AFTER, self.start);
                queue = lock(&seat.queue);
                if let Some(entry) = stolen {
                    metrics::counter!("sinew_worlds_stolen_total").increment(1);
                    queue.push(entry); // it is the first, or this thread no longer has the seat
                    seat.hint(&queue, self.start);
                }
                continue;
            }
            if due.is_some() {
                break queue.pop();
            }
            if !news.is_empty() {
                drop(queue);
                news.tell();
                queue = lock(&seat.queue);
                continue;
            }
            let look = hint.map(|(at, _)| (at + STEAL_AFTER).max(now + STEAL_EVERY));
            let until = [queue.top(), look].into_iter().flatten().min();
            queue = seat.wait(queue, until, now);
        };
        seat.set_idle(false);
        if let Some(entry) = &found {
            queue.begin(entry);
            seat.hint(&queue, self.start);
        }
        found
    }

    /// The seat of another worker with the world that is due first while that worker may be busy.
    fn others(&self, own: usize) -> Option<(Instant, usize)> {
        // Workers for long rounds help with short ones, but not the other way round.
        let reach = if own < self.width {
            self.width
        } else {
            self.seats.len()
        };
        let others = (0..reach).filter(|s| *s != own);
        let hints = others.filter_map(|s| Some((self.seats[s].hinted(self.start)?, s)));
        hints.min()
    }

    /// Takes a world out of its slot, unless the entry is void.
    fn take(&self, entry: &DueWorld, seat: usize) -> Option<Box<Runner>> {
        let mut place = lock(&entry.slot.place);
        if place.stamp != entry.stamp || !matches!(place.state, SlotState::Queued { .. }) {
            return None;
        }
        place.state = SlotState::Running { woken: false };
        place.seat = seat % self.width;
        drop(place);
        lock(&entry.slot.runner).take()
    }

    /// Puts a world back after a round. Returns whether the thread has not been given up during it.
    fn give_back(
        &self,
        slot: &Arc<WorldSlot>,
        mut runner: Box<Runner>,
        next: Next,
        (own, epoch): (usize, u64),
    ) -> bool {
        let long = runner.is_long(LONG);
        let mut runner = Some(runner);
        {
            let mut place = lock(&slot.place);
            let mut queue = lock(&self.seats[own].queue);
            if queue.epoch != epoch {
                return false;
            }
            queue.running = None;
            let woken = matches!(place.state, SlotState::Running { woken: true });
            place.stamp += 1;
            place.long = long;
            let (at, eager) = match next {
                Next::Ended => (None, false),
                Next::Idle if woken => (Some(Instant::now()), true),
                Next::Idle => (None, true),
                Next::At(_, true) if woken => (Some(Instant::now()), true),
                Next::At(at, eager) => (Some(at), eager),
            };
            place.state = match (next, at) {
                (Next::Ended, _) => SlotState::Gone,
                (_, None) => SlotState::Idle,
                (_, Some(_)) => SlotState::Queued { eager },
            };
            if next != Next::Ended {
                *lock(&slot.runner) = runner.take();
            }
            let entry = at.map(|at| DueWorld {
                at,
                stamp: place.stamp,
                slot: slot.clone(),
            });
            let seat = self.seat(&place);
            let mut news = false;
            if let Some(entry) = entry {
                if seat == own {
                    queue.push(entry);
                } else {
                    drop(queue);
                    news = self.seats[seat].push(entry, self.start);
                    queue = lock(&self.seats[own].queue);
                }
            }
            news |= self.seats[own].hint(&queue, self.start);
            drop(queue);
            if news {
                self.call_help(seat);
            }
        }
        if next == Next::Ended {
            drop(runner.take());
            slot.gone();
        }
        true
    }

    fn seat(&self, place: &SlotPlace) -> usize {
        place.seat + if place.long { self.width } else { 0 }
    }

    /// Makes a waiting world due.
    pub(super) fn wake(&self, slot: &Arc<WorldSlot>) {
        let mut place = lock(&slot.place);
        match place.state {
            SlotState::Running { .. } => place.state = SlotState::Running { woken: true },
            SlotState::Idle | SlotState::Queued { eager: true } => {
                self.due(slot, &mut place, Instant::now());
            }
            SlotState::Queued { eager: false } | SlotState::Gone => {}
        }
    }

    /// Puts a world into a heap from outside.
    pub(super) fn due(&self, slot: &Arc<WorldSlot>, place: &mut SlotPlace, at: Instant) {
        place.stamp += 1;
        place.state = SlotState::Queued { eager: false };
        let entry = DueWorld {
            at,
            stamp: place.stamp,
            slot: slot.clone(),
        };
        // An idle worker takes it at once.
        let home = self.seat(place);
        let lane = home - place.seat;
        let mut lane = lane..lane + self.width;
        let idle = lane.find(|s| *s != home && self.seats[*s].is_idle());
        let seat = idle.filter(|_| !self.seats[home].is_idle());
        let seat = seat.unwrap_or(home);
        if self.seats[seat].push(entry, self.start) {
            self.call_help(seat);
        }
    }

    /// Makes an idle worker look at a seat.
    fn call_help(&self, seat: usize) {
        let helpers = if seat < self.width { 0 } else { self.width }..self.seats.len();
        let idle = helpers
            .rev()
            .find(|s| *s != seat && self.seats[*s].is_idle());
        if let Some(idle) = idle {
            self.seats[idle].nudge();
        }
    }
}
