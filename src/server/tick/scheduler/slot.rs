//! A world on the scheduler.

use crate::ingest::mailbox::Mailboxes;
use crate::tick::budget::{Account, Budget};
use crate::tick::command::CommandQueue;
use crate::tick::{Outlet, Runner};
use sinew_wire::status::Fault;
use sinew_wire::types::{EventKind, WorldCondition, WorldEvent};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::sync::watch;

/// Locks a mutex of the scheduler. Its value is changed by steps that cannot panic half-way.
pub(super) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The place of a world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SlotState {
    /// In no heap; a command wakes it.
    Idle,
    /// In a heap. `eager`: a command makes it due at once.
    Queued { eager: bool },
    /// On a worker. `woken`: a command came in the meantime.
    Running { woken: bool },
    /// It has ended, or was given up.
    Gone,
}

/// The place of a world on the scheduler.
#[derive(Debug)]
pub(super) struct SlotPlace {
    pub state: SlotState,
    /// The valid entry of a heap: entries with an earlier stamp are void.
    pub stamp: u64,
    /// Its seat in either lane.
    pub seat: usize,
    /// Whether it is in the long lane.
    pub long: bool,
}

/// A world on the scheduler.
pub(super) struct WorldSlot {
    pub world: Arc<str>,
    pub number: u64,
    pub place: Mutex<SlotPlace>,
    /// The world itself, unless it is on a worker.
    pub runner: Mutex<Option<Box<Runner>>>,
    /// Dropped when it has ended.
    pub alive: Mutex<Option<watch::Sender<()>>>,
    pub outside: Outside,
}

/// The parts of a world that can be reached while a worker has it.
pub(super) struct Outside {
    pub outlet: Arc<Outlet>,
    pub commands: Arc<CommandQueue>,
    pub mailboxes: Arc<Mailboxes>,
    pub account: Arc<Account>,
    pub budget: Arc<Budget>,
}

impl std::fmt::Debug for WorldSlot {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "world {:?} {:?}", self.world, self.place)
    }
}

impl WorldSlot {
    /// Ends it for all waiters.
    pub(super) fn gone(&self) {
        lock(&self.place).state = SlotState::Gone;
        // No more commands are taken: waiting ones are dropped with everything they hold, and later ones are refused.
        self.outside.commands.close();
        lock(&self.alive).take();
    }

    /// Fails it from outside: its round does not end.
    pub(super) fn give_up(&self, why: &str) {
        let Outside {
            outlet,
            commands,
            mailboxes,
            account,
            budget,
        } = &self.outside;
        lock(&self.place).state = SlotState::Gone;
        let fault = Fault::Precondition {
            reason: "WORLD_FAILED",
            message: format!("world {:?} failed: {why}", self.world),
            facts: vec![],
        };
        outlet.lost.send_replace(Some(fault.clone()));
        commands.close();
        mailboxes.close_all(&fault);
        // A lower need is never refused.
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
        let _ = outlet.events.send(Arc::new(vec![event])); // there may be no listener
    }
}
