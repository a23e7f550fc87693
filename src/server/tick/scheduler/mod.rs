//! Threads that run the ticks of all worlds.
//!
//! Each worker has a *seat*: a heap of worlds by the time of their next round. It runs the earliest world that is due,
//! and puts it back. An idle worker takes overdue worlds from the seats of others, between two of their rounds, and
//! keeps them; so a world is never on two threads. A world that waits for a command is in no heap and costs nothing;
//! the command wakes it.
//!
//! There are two lanes, each with the same number of workers. Worlds whose rounds take less than a millisecond share
//! the *short* lane, which has the higher system priority. All others, and those that are stepped by hand, share the
//! *long* lane. A worker's round cannot be interrupted by another of its rounds, but long rounds run on other threads
//! than short ones, and the system interrupts those threads. So a world that needs little is delayed at most by the
//! short rounds of others, even on one processor.
//!
//! [`watchdog`] watches for rounds that do not end.

mod news;
mod priority;
mod seat;
mod slot;
#[cfg(test)]
mod tests;
mod watchdog;
mod workers;

pub use priority::WorkerPriority;
pub use workers::SchedulerPlan;

use super::command::CommandQueue;
use super::hosted_world::HostedWorld;
use super::{Next, Outlet, Runner};
use seat::WorkerSeat;
use slot::{Outside, SlotPlace, SlotState, WorldSlot, lock};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Instant;
use tokio::sync::watch;
use workers::Workers;

/// Golden section: its multiples, modulo 1, are evenly spread however many there are.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The threads. They end when it is dropped, and so do their worlds.
#[derive(Debug)]
pub struct Scheduler(Arc<Workers>);

/// The handle to one world, for those that send something to it.
#[derive(Debug)]
pub struct WorldTicket {
    slot: Arc<WorldSlot>,
    shared: Arc<Workers>,
}

impl Drop for WorldTicket {
    fn drop(&mut self) {
        // No more questions can reach it.
        self.slot.outside.commands.close();
        self.wake();
    }
}

impl WorldTicket {
    /// Makes a world check its commands at once if its clock stands still; a running clock checks by itself.
    pub fn wake(&self) {
        self.shared.wake(&self.slot);
    }

    /// Abandons a world whose round does not end, so that those waiting for its end can continue.
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
    /// The system provides no thread.
    pub fn start(plan: SchedulerPlan) -> std::io::Result<Self> {
        let width = plan.width();
        let shared = Arc::new(Workers {
            plan,
            seats: (0..2 * width).map(|_| WorkerSeat::default()).collect(),
            width,
            start: Instant::now(),
            next: AtomicU64::new(0),
            ending: AtomicBool::new(false),
            obtained: Mutex::default(),
            stuck: Mutex::default(),
            threads: AtomicU64::new(0),
        });
        let scheduler = Self(shared.clone()); // if one cannot be started, this ends the others
        for seat in 0..shared.seats.len() {
            shared.clone().spawn(seat)?;
        }
        watchdog::start(&shared)?;
        Ok(scheduler)
    }

    /// Runs a world from now on. Its ticks are placed between those of all other worlds in a period.
    pub fn add(
        &self,
        mut hosted: HostedWorld,
        commands: &Arc<CommandQueue>,
        outlet: &Arc<Outlet>,
    ) -> Added {
        let shared = &self.0;
        let number = shared.next.fetch_add(1, Ordering::Relaxed);
        hosted.stagger(shared.start, (number as f64 * GOLDEN).fract());
        let (alive, closed) = watch::channel(());
        let (account, budget) = hosted.books();
        let world: Arc<str> = hosted.id().into();
        let mailboxes = hosted.mailboxes();
        let runner = Runner::new(hosted, commands, outlet);
        // A world whose clock stands still is shown once.
        let first = match runner.next() {
            Next::At(at, false) => at,
            _ => Instant::now(),
        };
        let slot = Arc::new(WorldSlot {
            world,
            number,
            place: Mutex::new(SlotPlace {
                state: SlotState::Idle,
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
            ticket: WorldTicket { slot, shared },
            closed,
        }
    }

    /// Workers for short rounds, and the priority that the system grants them; there are as many for long rounds.
    pub fn workers(&self) -> (usize, WorkerPriority) {
        let obtained = lock(&self.0.obtained).unwrap_or(WorkerPriority::Plain);
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
    /// The handle to it.
    pub ticket: WorldTicket,
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
