//! Threads that run the ticks of all worlds.
//!
//! Each worker has a *seat*: a heap of worlds by the time of their next round. It runs the earliest that is due, and
//! puts it back. A worker that has nothing to do takes worlds that are overdue from the seats of others, between two
//! rounds of theirs, and keeps them; so a world is never on two threads. A world that waits for a command is in no heap
//! and costs nothing; the command wakes it.
//!
//! There are two lanes of as many workers each. Worlds whose rounds take less than a millisecond share the *short*
//! lane, which is the more urgent one to the system. All others, and those that are stepped by hand, share the *long*
//! lane. A round cannot be interrupted by another one of the same worker, but long ones are on other threads than short
//! ones, and the system interrupts those. So a world that needs little is late by the short rounds of others at most,
//! also on one processor.
//!
//! [`watchdog`] looks after rounds that do not end.

mod news;
mod priority;
mod seat;
#[cfg(test)]
mod tests;
mod watchdog;

pub use priority::Priority;

use super::budget::{Account, Budget};
use super::command::Queue;
use super::shard::Shard;
use super::{Next, Outlet, Runner};
use crate::ingest::mailbox::Mailboxes;
use news::News;
use priority::Duty;
use seat::{Entry, Seat};
use sinew_wire::status::Fault;
use sinew_wire::types::{EventKind, WorldCondition, WorldEvent};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use tokio::sync::watch;

/// Processor time of one round from which on a world is in the long lane. It comes back when its mean is half of that.
const LONG: Duration = Duration::from_millis(1);
/// How long a world is overdue before another worker takes it: its own worker is to have the time to wake up.
const STEAL_AFTER: Duration = Duration::from_micros(200);
/// Least time between two looks of an idle worker at the seats of others.
const STEAL_EVERY: Duration = Duration::from_millis(1);
/// Golden section: multiples of it, modulo 1, are evenly spread however many there are.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // What the mutexes of this module hold is changed by steps that cannot panic half-way.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// How worlds are run.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// Workers in each lane; 0: one less than there are processors, and at least one.
    pub workers: usize,
    /// As urgent as workers may be.
    pub priority: Priority,
    /// A round that takes longer is reported.
    pub slow: Duration,
    /// A round that takes longer is given up, with its world and its thread.
    pub stuck: Duration,
}

impl Plan {
    fn width(&self) -> usize {
        match self.workers {
            0 => thread::available_parallelism().map_or(1, |n| n.get().saturating_sub(1).max(1)),
            n => n,
        }
    }
}

/// Where a world is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// In no heap: a command wakes it.
    Idle,
    /// In a heap. `eager`: a command makes it due at once.
    Queued { eager: bool },
    /// On a worker. `woken`: a command came meanwhile.
    Running { woken: bool },
    /// It has ended, or was given up.
    Gone,
}

#[derive(Debug)]
struct Place {
    state: State,
    /// Which entry of a heap is meant: those with an earlier stamp are void.
    stamp: u64,
    /// The seat that has it, in either lane.
    seat: usize,
    /// It is in the long lane.
    long: bool,
}

/// A world on the scheduler.
struct Slot {
    world: Arc<str>,
    number: u64,
    place: Mutex<Place>,
    /// The world itself, unless it is on a worker.
    runner: Mutex<Option<Box<Runner>>>,
    /// Dropped when it has ended.
    alive: Mutex<Option<watch::Sender<()>>>,
    outside: Outside,
}

/// What can be reached of a world while a worker has it.
struct Outside {
    outlet: Arc<Outlet>,
    commands: Arc<Queue>,
    mailboxes: Arc<Mailboxes>,
    account: Arc<Account>,
    budget: Arc<Budget>,
}

impl std::fmt::Debug for Slot {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "world {:?} {:?}", self.world, self.place)
    }
}

impl Slot {
    /// Ends it for all who wait.
    fn gone(&self) {
        lock(&self.place).state = State::Gone;
        // Nobody looks at commands any more: those that wait are dropped, with what they hold, and later ones refused.
        self.outside.commands.close();
        lock(&self.alive).take();
    }

    /// Fails it from outside: its round does not end.
    fn give_up(&self, why: &str) {
        let Outside {
            outlet,
            commands,
            mailboxes,
            account,
            budget,
        } = &self.outside;
        lock(&self.place).state = State::Gone;
        let fault = Fault::Precondition {
            reason: "WORLD_FAILED",
            message: format!("world {:?} failed: {why}", self.world),
            facts: vec![],
        };
        outlet.lost.send_replace(Some(fault.clone()));
        commands.close();
        mailboxes.close_all(&fault);
        // Less than before is never refused.
        let _ = budget.set_pace(account, 0.0);
        metrics::counter!("sinew_worlds_failed_total").increment(1);
        outlet.described.send_modify(|described| {
            let mut failed = (**described).clone();
            failed.world.condition = WorldCondition::Failed(why.to_owned());
            *described = Arc::new(failed);
        });
        let latest = outlet.latest.borrow().clone();
        let event = WorldEvent {
            tick: latest.tick,
            time: latest.time,
            figure: String::new(),
            kind: EventKind::Failed(why.to_owned()),
        };
        let _ = outlet.events.send(Arc::new(vec![event])); // nobody may listen
    }
}

/// What all threads share.
#[derive(Debug)]
struct Shared {
    plan: Plan,
    /// Short lane, then long lane.
    seats: Vec<Seat>,
    width: usize,
    start: Instant,
    next: AtomicU64,
    ending: AtomicBool,
    /// What the least urgent worker of the short lane has been given.
    obtained: Mutex<Option<Priority>>,
    /// Worlds whose rounds do not end, by the number of their thread.
    stuck: Mutex<Vec<(u64, Arc<str>)>>,
    threads: AtomicU64,
}

/// The threads. They end when it is dropped; so do their worlds.
#[derive(Debug)]
pub struct Scheduler(Arc<Shared>);

/// One world, for those who have something for it.
#[derive(Debug)]
pub struct Ticket {
    slot: Arc<Slot>,
    shared: Arc<Shared>,
}

impl Drop for Ticket {
    fn drop(&mut self) {
        // Nobody can ask anything of it any more.
        self.slot.outside.commands.close();
        self.wake();
    }
}

impl Ticket {
    /// Lets a world look at its commands at once if its clock stands still; a clock that runs looks by itself.
    pub fn wake(&self) {
        self.shared.wake(&self.slot);
    }

    /// Lets go of a world whose round does not end; others wait for its end.
    pub fn abandon(&self) {
        if self.slot.outside.outlet.lost.borrow().is_some() {
            self.slot.gone();
        }
    }
}

impl Scheduler {
    /// Starts the threads.
    ///
    /// # Errors
    /// The system gives no thread.
    pub fn start(plan: Plan) -> std::io::Result<Self> {
        let width = plan.width();
        let shared = Arc::new(Shared {
            plan,
            seats: (0..2 * width).map(|_| Seat::default()).collect(),
            width,
            start: Instant::now(),
            next: AtomicU64::new(0),
            ending: AtomicBool::new(false),
            obtained: Mutex::default(),
            stuck: Mutex::default(),
            threads: AtomicU64::new(0),
        });
        let scheduler = Self(shared.clone()); // ends those that were started if one cannot be
        for seat in 0..shared.seats.len() {
            shared.clone().spawn(seat)?;
        }
        watchdog::start(&shared)?;
        Ok(scheduler)
    }

    /// Runs a world from now on. Its ticks are spread over the period among those of all other worlds.
    pub fn add(&self, mut shard: Shard, commands: &Arc<Queue>, outlet: &Arc<Outlet>) -> Added {
        let shared = &self.0;
        let number = shared.next.fetch_add(1, Ordering::Relaxed);
        shard.stagger(shared.start, (number as f64 * GOLDEN).fract());
        let (alive, closed) = watch::channel(());
        let (account, budget) = shard.books();
        let world: Arc<str> = shard.id().into();
        let mailboxes = shard.mailboxes();
        let runner = Runner::new(shard, commands, outlet);
        // One whose clock stands still is shown once.
        let first = match runner.next() {
            Next::At(at, false) => at,
            _ => Instant::now(),
        };
        let slot = Arc::new(Slot {
            world,
            number,
            place: Mutex::new(Place {
                state: State::Idle,
                stamp: 0,
                seat: number as usize % shared.width,
                long: false,
            }),
            outside: Outside {
                outlet: outlet.clone(),
                commands: commands.clone(),
                mailboxes,
                account,
                budget,
            },
            runner: Mutex::new(Some(Box::new(runner))),
            alive: Mutex::new(Some(alive)),
        });
        let shared = shared.clone();
        shared.due(&slot, &mut lock(&slot.place), first);
        Added {
            ticket: Ticket { slot, shared },
            closed,
        }
    }

    /// Workers for short rounds, and what the system lets them be; as many have long rounds.
    pub fn workers(&self) -> (usize, Priority) {
        let obtained = lock(&self.0.obtained).unwrap_or(Priority::Plain);
        (self.0.width, obtained)
    }

    /// Worlds whose rounds do not end.
    pub fn stuck(&self) -> Vec<Arc<str>> {
        lock(&self.0.stuck).iter().map(|(_, w)| w.clone()).collect()
    }
}

/// A world that was added.
#[derive(Debug)]
pub struct Added {
    /// For those who have something for it.
    pub ticket: Ticket,
    /// Ends when the world has ended.
    pub closed: watch::Receiver<()>,
}

impl Drop for Scheduler {
    fn drop(&mut self) {
        self.0.ending.store(true, Ordering::SeqCst);
        for seat in &self.0.seats {
            for entry in seat.clear() {
                entry.slot.gone();
                lock(&entry.slot.runner).take();
            }
        }
    }
}

impl Shared {
    /// Starts a thread for a seat; one that had it before leaves it.
    fn spawn(self: Arc<Self>, seat: usize) -> std::io::Result<()> {
        let epoch = self.threads.fetch_add(1, Ordering::Relaxed) + 1;
        lock(&self.seats[seat].queue).epoch = epoch;
        let name = match seat.checked_sub(self.width) {
            None => format!("tick {seat}"),
            Some(seat) => format!("long tick {seat}"),
        };
        let builder = thread::Builder::new().name(name);
        builder.spawn(move || self.work(seat, epoch)).map(|_| ())
    }

    /// What a worker does.
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
                // What may panic is guarded where it is called: this is an error of the loop itself.
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
            // The next tick of the long lane may take long: nothing waits for it.
            if duty == Duty::Long || news.is_due() {
                news.tell();
            }
        }
    }

    /// Waits for the next world to run; tells the news before. None: the thread is to end.
    fn next_entry(&self, own: usize, epoch: u64, news: &mut News) -> Option<Entry> {
        let seat = &self.seats[own];
        let mut queue = lock(&seat.queue);
        let found = loop {
            if self.ending.load(Ordering::SeqCst) || queue.epoch != epoch {
                break None;
            }
            seat.set_idle(true);
            let now = Instant::now();
            // The one that is due the longest, of its own and of those that others leave overdue.
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
                    queue.push(entry); // it is the first, or this one is not the right thread any more
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

    /// The seat of another worker with the world that is due first while its worker may be busy.
    fn others(&self, own: usize) -> Option<(Instant, usize)> {
        // Workers for long rounds help with short ones, and not the other way round.
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
    fn take(&self, entry: &Entry, seat: usize) -> Option<Box<Runner>> {
        let mut place = lock(&entry.slot.place);
        if place.stamp != entry.stamp || !matches!(place.state, State::Queued { .. }) {
            return None;
        }
        place.state = State::Running { woken: false };
        place.seat = seat % self.width;
        drop(place);
        lock(&entry.slot.runner).take()
    }

    /// Puts a world back after a round. False: the thread was given up meanwhile.
    fn give_back(
        &self,
        slot: &Arc<Slot>,
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
            let woken = matches!(place.state, State::Running { woken: true });
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
                (Next::Ended, _) => State::Gone,
                (_, None) => State::Idle,
                (_, Some(_)) => State::Queued { eager },
            };
            if next != Next::Ended {
                *lock(&slot.runner) = runner.take();
            }
            let entry = at.map(|at| Entry {
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

    fn seat(&self, place: &Place) -> usize {
        place.seat + if place.long { self.width } else { 0 }
    }

    /// Makes a world due that waits for commands.
    fn wake(&self, slot: &Arc<Slot>) {
        let mut place = lock(&slot.place);
        match place.state {
            State::Running { .. } => place.state = State::Running { woken: true },
            State::Idle | State::Queued { eager: true } => {
                self.due(slot, &mut place, Instant::now());
            }
            State::Queued { eager: false } | State::Gone => {}
        }
    }

    /// Puts a world into a heap from outside.
    fn due(&self, slot: &Arc<Slot>, place: &mut Place, at: Instant) {
        place.stamp += 1;
        place.state = State::Queued { eager: false };
        let entry = Entry {
            at,
            stamp: place.stamp,
            slot: slot.clone(),
        };
        // A worker that has nothing to do takes it at once.
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

    /// Lets an idle worker see what a seat has.
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
