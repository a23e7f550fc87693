//! The rate keeper: the [`scheduler`]'s threads call [`Runner::round`] of each world when it is due.
//!
//! A tick is: carry out commands in order, sample desired motion, step the physics, publish the frame, account for
//! time. The thread never waits for a client, for a lock that is held for long, or for the disk. Commands come through
//! a bounded queue, frames leave through latest-wins cells.

pub mod budget;
pub mod clock;
pub mod command;
pub mod drives;
pub mod history;
pub mod journal;
pub mod leases;
pub mod planners;
pub mod replay;
pub mod scene;
pub mod scheduler;
pub mod shard;
pub mod stage_times;

use crate::telemetry::metrics::ticks;
use budget::Meter;
use command::{Inbox, Queue};
use history::History;
use shard::Shard;
use sinew_wire::status::Fault;
use sinew_wire::types::{Described, EventKind, Snapshot, WorldEvent};
use stage_times::StageTimes;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::{broadcast, watch};

/// Longest wait before commands of a slow or paused world are looked at.
const PATIENCE: Duration = Duration::from_millis(50);
/// Share of the period that commands may take in one tick, so that a flood cannot keep the clock from running. What
/// does not fit waits for the next tick.
const COMMAND_SHARE: f64 = 0.25;
/// Least time for the commands of one tick: fast clocks must not take all day over a few of them.
const COMMAND_LEAST: Duration = Duration::from_micros(200);

/// What leaves the thread that runs a world.
#[derive(Debug)]
pub struct Outlet {
    /// Why nobody waits for it any more: its tick does not end.
    pub lost: watch::Sender<Option<Fault>>,
    /// Latest frame. Who reads it finds it at once; who waits for the next one is told by [`Outlet::tell`].
    pub latest: watch::Sender<Arc<Snapshot>>,
    /// Frames of the last ticks. Whoever looks into it copies pointers, so a tick does not wait for long.
    pub history: Mutex<History>,
    /// World and figures, as they were when something of them changed last.
    pub described: watch::Sender<Arc<Described>>,
    /// Events of each tick that has some.
    pub events: broadcast::Sender<Arc<Vec<WorldEvent>>>,
    /// Times of recent ticks.
    pub times: Mutex<StageTimes>,
    /// Ticks computed.
    pub ticks: AtomicU64,
    /// Ticks that took longer than their period.
    pub overruns: AtomicU64,
    /// Deadlines left out.
    pub skipped: AtomicU64,
}

impl Outlet {
    /// Shows a new world, with so many frames and messages of events held for those who read late.
    pub fn new(shard: &mut Shard, frames: usize, events: usize) -> Self {
        let first = shard.snapshot(None);
        let mut history = History::new(frames);
        history.push(first.clone());
        let described = Described {
            world: shard.info(),
            figures: shard.figures(),
            controls: shard.controls(),
            at: Instant::now(),
        };
        Self {
            lost: watch::Sender::new(None),
            latest: watch::Sender::new(first),
            history: Mutex::new(history),
            described: watch::Sender::new(Arc::new(described)),
            events: broadcast::Sender::new(events),
            times: Mutex::default(),
            ticks: AtomicU64::new(0),
            overruns: AtomicU64::new(0),
            skipped: AtomicU64::new(0),
        }
    }
}

impl Outlet {
    /// Tells who waits for the next frame that it is there.
    pub fn tell(&self) {
        self.latest.send_modify(|_| {});
    }
}

/// When a world wants to be run again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Next {
    /// Then; with true, a command makes it due at once.
    At(Instant, bool),
    /// When a command comes.
    Idle,
    /// It has ended.
    Ended,
}

/// A world, and what it takes to run it.
pub struct Runner {
    shard: Shard,
    inbox: Inbox,
    outlet: Arc<Outlet>,
    meter: Meter,
    /// Its last round took long, or it was stepped by hand.
    long: bool,
    /// Processor time of the last round.
    took: Duration,
    /// There is a frame that nobody was told of.
    untold: bool,
}

impl Runner {
    /// A world with the queue of its commands.
    pub fn new(shard: Shard, commands: &Arc<Queue>, outlet: &Arc<Outlet>) -> Self {
        Self {
            meter: shard.meter(),
            shard,
            inbox: Inbox::new(commands.clone()),
            outlet: outlet.clone(),
            long: false,
            took: Duration::ZERO,
            untold: false,
        }
    }

    /// What is to be told of the rounds since the last call: where there is a new frame, if there is one.
    pub fn take_news(&mut self) -> Option<Arc<Outlet>> {
        std::mem::take(&mut self.untold).then(|| self.outlet.clone())
    }

    /// The tick that it has come to.
    pub fn tick(&self) -> u64 {
        self.outlet.latest.borrow().tick
    }

    /// Whether its rounds should not keep those of others waiting: they take longer than `limit`, or were asked for by
    /// hand.
    pub fn is_long(&mut self, limit: Duration) -> bool {
        if self.shard.paused {
            self.long |= self.took > limit || !self.shard.steps.is_empty();
        } else {
            self.long = self.took > limit || (self.long && self.meter.mean() > limit / 2);
        }
        self.long
    }

    /// Does what is due: commands, a tick, none of both. Says when it wants to be called again.
    pub fn round(&mut self) -> Next {
        self.meter.begin();
        let mut goes_on = self.inbox.fetch();
        let mut ticked = None;
        if goes_on {
            ticked = self.step();
            goes_on = self.shard.closing.is_none();
        }
        self.took = self.meter.end();
        if let Some(physics) = ticked {
            let rest = self.meter.tick(physics, self.shard.figure_count());
            if !rest.is_zero() && !self.shard.paused {
                self.shard.clock.rest(Instant::now() + rest);
            }
        }
        if !goes_on {
            self.end();
            return Next::Ended;
        }
        self.next()
    }

    /// When it wants to be called.
    pub fn next(&self) -> Next {
        let Self { shard, inbox, .. } = self;
        let now = Instant::now();
        if !shard.paused && shard.failed.is_none() {
            return Next::At(shard.clock.deadline().min(now + PATIENCE), false);
        }
        let steps = shard.failed.is_none() && !shard.steps.is_empty();
        if steps || inbox.left() > 0 {
            Next::At(now, true)
        } else if shard.needs_looks() {
            Next::At(now + PATIENCE, true)
        } else {
            Next::Idle
        }
    }

    /// Tells who still waits that there is no more.
    fn end(&mut self) {
        guarded(&mut self.shard, "the record", |s| {
            s.note(false, Instant::now());
        });
        self.shard.send_replies();
        let why = self.shard.closing.take().unwrap_or(Fault::Draining);
        for step in self.shard.steps.drain(..) {
            (step.done)(Err(why.clone()));
        }
    }

    /// A round but for its account. Returns the time of the physics if there was a tick.
    fn step(&mut self) -> Option<Duration> {
        let Self {
            shard,
            inbox,
            outlet,
            untold,
            ..
        } = self;
        let meters = ticks();
        let stopped = shard.paused || shard.failed.is_some();
        let start = Instant::now();
        let late = start.saturating_duration_since(shard.clock.deadline());

        // Motion that drivers have left, then commands in (client, sequence) order.
        guarded(shard, "taking motion", Shard::collect_motion);
        let allowance = if stopped {
            PATIENCE
        } else {
            shard
                .clock
                .period()
                .mul_f64(COMMAND_SHARE)
                .max(COMMAND_LEAST)
        };
        while let Some(c) = inbox.take() {
            guarded(shard, "a command", |s| (c.action)(s));
            shard.touch();
            if start.elapsed() >= allowance {
                break;
            }
        }
        count(&meters.deferred, inbox.left() as u64);
        guarded(shard, "drives and plans", |s| {
            s.expire_drives(start);
            s.offer_plans();
        });
        if shard.closing.is_some() {
            publish_events(shard, outlet); // that it was deleted is the last one
            return None;
        }
        let commands_done = Instant::now();

        // Is a tick due?
        shard.steps.retain(|s| !(s.abandoned)());
        let stopped = shard.paused || shard.failed.is_some();
        let due = if stopped {
            shard.failed.is_none() && !shard.steps.is_empty()
        } else {
            shard.clock.deadline() <= start
        };
        if !due {
            guarded(shard, "the record", |s| s.note(false, start));
            if shard.changed {
                *untold |= publish(shard, outlet, None).is_some();
            }
            describe(shard, outlet);
            publish_events(shard, outlet);
            shard.send_replies();
            return None;
        }

        guarded(shard, "sampling desired motion", Shard::sample_motion);
        let motion_done = Instant::now();
        if shard.failed.is_none() {
            guarded(shard, "the physics", Shard::step_world);
        }
        let step_done = Instant::now();
        let hash = guarded(shard, "the record", |s| s.note(true, start)).flatten();
        let snapshot = match shard.failed {
            None => publish(shard, outlet, hash),
            Some(_) => None,
        };
        *untold |= snapshot.is_some();
        describe(shard, outlet);
        publish_events(shard, outlet);

        shard.send_replies();

        // Account for time.
        let end = Instant::now();
        if !stopped {
            shard.clock.advance(end);
        }
        outlet.ticks.fetch_add(1, Ordering::Relaxed);
        let (overruns, skipped) = (shard.clock.overruns, shard.clock.skipped);
        let overran = overruns - outlet.overruns.swap(overruns, Ordering::Relaxed);
        let left_out = skipped - outlet.skipped.swap(skipped, Ordering::Relaxed);
        count(&meters.overrun, overran);
        count(&meters.skipped, left_out);
        count(&meters.ticks, 1);
        let stages = [
            if stopped { Duration::ZERO } else { late },
            commands_done - start,
            motion_done - commands_done,
            step_done - motion_done,
            end - step_done,
            end - start,
        ];
        let physics = step_done - motion_done;
        stage_times::count(&stages, !stopped);
        if let Ok(mut times) = outlet.times.try_lock() {
            times.record(stages);
        }
        if let Some(snapshot) = snapshot {
            finish_steps(shard, &snapshot); // last, so that who waits finds everything done
        }
        Some(physics)
    }
}

/// Adds to a counter what there is to add, which mostly is nothing.
fn count(counter: &metrics::Counter, more: u64) {
    if more > 0 {
        counter.increment(more);
    }
}

/// Calls `f`; a panic fails this world and no other.
fn guarded<T>(shard: &mut Shard, what: &str, f: impl FnOnce(&mut Shard) -> T) -> Option<T> {
    let done = catch_unwind(AssertUnwindSafe(|| f(shard)));
    done.map_err(|panic| fail(shard, what, &*panic)).ok()
}

/// Notes that a world has failed, and tells who waits for it. It keeps its last frame and its first reason.
fn fail(shard: &mut Shard, what: &str, panic: &(dyn Any + Send)) {
    let message = panic
        .downcast_ref::<&str>()
        .map(|s| (*s).to_owned())
        .or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no message".to_owned());
    tracing::error!(world = shard.id(), what, message, "world failed");
    shard.changed = false;
    if shard.failed.is_some() {
        return;
    }
    metrics::counter!("sinew_worlds_failed_total").increment(1);
    let why = format!("{what} panicked: {message}");
    shard.failed = Some(why.clone());
    shard.needs_nothing();
    shard.touch();
    if let Some(fault) = shard.failure() {
        shard.close_mailboxes(&fault);
    }
    shard.world_event(EventKind::Failed(why.clone()));
    for step in shard.steps.drain(..) {
        (step.done)(Err(Fault::Internal(why.clone())));
    }
}

/// Shows the world as it is now; `None` if that fails. Who waits for a frame is told later ([`Outlet::tell`]).
///
/// * `hash`: of its state, if that is known.
fn publish(shard: &mut Shard, outlet: &Outlet, hash: Option<u64>) -> Option<Arc<Snapshot>> {
    let snapshot = guarded(shard, "the frame", |s| {
        s.publish_feedback();
        s.snapshot(hash)
    })?;
    if outlet.lost.borrow().is_some() {
        return None;
    }
    let mut history = outlet
        .history
        .lock()
        .unwrap_or_else(PoisonError::into_inner);
    history.push(snapshot.clone());
    drop(history);
    let shown = snapshot.clone();
    outlet.latest.send_if_modified(|latest| {
        *latest = shown;
        false // nobody is told yet
    });
    shard.note_shown();
    Some(snapshot)
}

/// Tells what changed of world and figures, before who changed it gets an answer.
fn describe(shard: &mut Shard, outlet: &Outlet) {
    if let Some(described) = guarded(shard, "the description", Shard::describe).flatten() {
        // Who gave it up says that it has failed, after `lost`: that stands.
        outlet.described.send_if_modified(|shown| {
            let goes_on = outlet.lost.borrow().is_none();
            if goes_on {
                *shown = described;
            }
            goes_on
        });
    }
}

fn publish_events(shard: &mut Shard, outlet: &Outlet) {
    let events = shard.take_events();
    if !events.is_empty() {
        let history = outlet.history.lock();
        history
            .unwrap_or_else(PoisonError::into_inner)
            .note(&events);
        // An error only means that nobody listens.
        let _ = outlet.events.send(Arc::new(events));
    }
}

fn finish_steps(shard: &mut Shard, snapshot: &Arc<Snapshot>) {
    let Some(first) = shard.steps.front_mut() else {
        return;
    };
    first.left -= 1;
    if first.left == 0
        && let Some(step) = shard.steps.pop_front()
    {
        (step.done)(Ok(snapshot.clone()));
    }
}

#[cfg(test)]
mod tests;
