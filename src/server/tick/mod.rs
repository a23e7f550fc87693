//! The rate keeper: the [`scheduler`]'s threads call [`Runner::round`] of each world when it is due.
//!
//! A tick has these stages: run commands in order, sample desired motion, step the physics, publish the frame, account
//! for time. The thread never waits for a client, for a lock that is held for long, or for the disk. Commands come
//! through a bounded queue, frames leave through latest-wins cells.

pub mod budget;
pub mod clock;
pub mod command;
pub mod drives;
pub mod history;
pub mod hosted_world;
pub mod journal;
pub mod leases;
pub mod planners;
pub mod replay;
pub mod scene;
pub mod scheduler;
pub mod stage_times;

use crate::telemetry::metrics::ticks;
use budget::Meter;
use command::{CommandQueue, Inbox};
use history::FrameHistory;
use hosted_world::HostedWorld;
use sinew_wire::status::Fault;
use sinew_wire::types::{Described, EventKind, Snapshot, WorldEvent};
use stage_times::StageTimes;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::{broadcast, watch};

/// Longest wait before the commands of a slow or paused world are checked.
const PATIENCE: Duration = Duration::from_millis(50);
/// Share of the period that commands may take in one tick, so that a flood cannot stop the clock. The rest waits for
/// the next tick.
const COMMAND_SHARE: f64 = 0.25;
/// Least time for the commands of one tick, so that fast clocks still get through them.
const COMMAND_LEAST: Duration = Duration::from_micros(200);

/// The output of the thread that runs a world.
#[derive(Debug)]
pub struct Outlet {
    /// Reason why no caller should wait for it any more: its tick does not end.
    pub lost: watch::Sender<Option<Fault>>,
    /// Latest frame. Readers find it at once; waiters for the next one are woken by [`Outlet::tell`].
    pub latest: watch::Sender<Arc<Snapshot>>,
    /// Frames of the last ticks. Readers only copy pointers, so a tick does not wait for long.
    pub history: Mutex<FrameHistory>,
    /// World and figures as of their last change.
    pub described: watch::Sender<Arc<Described>>,
    /// Events of each tick that has some.
    pub events: broadcast::Sender<Arc<Vec<WorldEvent>>>,
    /// Times of recent ticks.
    pub times: Mutex<StageTimes>,
    /// Ticks computed.
    pub ticks: AtomicU64,
    /// Ticks that took longer than their period.
    pub overruns: AtomicU64,
    /// Skipped deadlines.
    pub skipped: AtomicU64,
}

impl Outlet {
    /// Shows a new world, with this number of frames and of event messages held for late readers.
    pub fn new(hosted: &mut HostedWorld, frames: usize, events: usize) -> Self {
        let first = hosted.snapshot(None);
        let mut history = FrameHistory::new(frames);
        history.push(first.clone());
        let described = Described {
            world: hosted.info(),
            figures: hosted.figures(),
            controls: hosted.controls(),
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
    /// Wakes everyone waiting for the next frame.
    pub fn tell(&self) {
        self.latest.send_modify(|_| {});
    }
}

/// When a world wants to be run again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Next {
    /// At this time; with true, a command makes it due at once.
    At(Instant, bool),
    /// When a command arrives.
    Idle,
    /// It has ended.
    Ended,
}

/// A world, and what it takes to run it.
pub struct Runner {
    hosted: HostedWorld,
    inbox: Inbox,
    outlet: Arc<Outlet>,
    meter: Meter,
    /// Whether its last round took long, or it was stepped by hand.
    long: bool,
    /// Processor time of the last round.
    took: Duration,
    /// Whether there is a frame that has not been announced.
    untold: bool,
}

impl Runner {
    /// A world with the queue of its commands.
    pub fn new(hosted: HostedWorld, commands: &Arc<CommandQueue>, outlet: &Arc<Outlet>) -> Self {
        Self {
            meter: hosted.meter(),
            hosted,
            inbox: Inbox::new(commands.clone()),
            outlet: outlet.clone(),
            long: false,
            took: Duration::ZERO,
            untold: false,
        }
    }

    /// The outlet with a new frame since the last call, if there is one.
    pub fn take_news(&mut self) -> Option<Arc<Outlet>> {
        std::mem::take(&mut self.untold).then(|| self.outlet.clone())
    }

    /// Its present tick.
    pub fn tick(&self) -> u64 {
        self.outlet.latest.borrow().tick
    }

    /// Whether its rounds should not delay those of others: they take longer than `limit`, or were requested by hand.
    pub fn is_long(&mut self, limit: Duration) -> bool {
        if self.hosted.paused {
            self.long |= self.took > limit || !self.hosted.steps.is_empty();
        } else {
            self.long = self.took > limit || (self.long && self.meter.mean() > limit / 2);
        }
        self.long
    }

    /// Does everything that is due: commands, a tick, or neither. Returns when it wants to be called again.
    pub fn round(&mut self) -> Next {
        self.meter.begin();
        let mut goes_on = self.inbox.fetch();
        let mut ticked = None;
        if goes_on {
            ticked = self.step();
            goes_on = self.hosted.closing.is_none();
        }
        self.took = self.meter.end();
        if let Some(physics) = ticked {
            let rest = self.meter.tick(physics, self.hosted.figure_count());
            if !rest.is_zero() && !self.hosted.paused {
                self.hosted.clock.rest(Instant::now() + rest);
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
        let Self { hosted, inbox, .. } = self;
        let now = Instant::now();
        if !hosted.paused && hosted.failed.is_none() {
            return Next::At(hosted.clock.deadline().min(now + PATIENCE), false);
        }
        let steps = hosted.failed.is_none() && !hosted.steps.is_empty();
        if steps || inbox.left() > 0 {
            Next::At(now, true)
        } else if hosted.needs_looks() {
            Next::At(now + PATIENCE, true)
        } else {
            Next::Idle
        }
    }

    /// Tells the remaining waiters that the world has ended.
    fn end(&mut self) {
        guarded(&mut self.hosted, "the record", |s| {
            s.note(false, Instant::now());
        });
        self.hosted.send_replies();
        let why = self.hosted.closing.take().unwrap_or(Fault::Draining);
        for step in self.hosted.steps.drain(..) {
            (step.done)(Err(why.clone()));
        }
    }

    /// A round without its account. Returns the time of the physics if there was a tick.
    fn step(&mut self) -> Option<Duration> {
        let Self {
            hosted,
            inbox,
            outlet,
            untold,
            ..
        } = self;
        let meters = ticks();
        let stopped = hosted.paused || hosted.failed.is_some();
        let start = Instant::now();
        let late = start.saturating_duration_since(hosted.clock.deadline());

        // First the motion that drivers have left, then commands in (client, sequence) order.
        guarded(hosted, "taking motion", HostedWorld::collect_motion);
        let allowance = if stopped {
            PATIENCE
        } else {
            hosted
                .clock
                .period()
                .mul_f64(COMMAND_SHARE)
                .max(COMMAND_LEAST)
        };
        while let Some(c) = inbox.take() {
            guarded(hosted, "a command", |s| (c.action)(s));
            hosted.touch();
            if start.elapsed() >= allowance {
                break;
            }
        }
        count(&meters.deferred, inbox.left() as u64);
        guarded(hosted, "drives and plans", |s| {
            s.expire_drives(start);
            s.offer_plans();
        });
        if hosted.closing.is_some() {
            publish_events(hosted, outlet); // the event of its deletion is the last one
            return None;
        }
        let commands_done = Instant::now();

        // Is a tick due?
        hosted.steps.retain(|s| !(s.abandoned)());
        let stopped = hosted.paused || hosted.failed.is_some();
        let due = if stopped {
            hosted.failed.is_none() && !hosted.steps.is_empty()
        } else {
            hosted.clock.deadline() <= start
        };
        if !due {
            guarded(hosted, "the record", |s| s.note(false, start));
            if hosted.changed {
                *untold |= publish(hosted, outlet, None).is_some();
            }
            describe(hosted, outlet);
            publish_events(hosted, outlet);
            hosted.send_replies();
            return None;
        }

        guarded(
            hosted,
            "sampling desired motion",
            HostedWorld::sample_motion,
        );
        let motion_done = Instant::now();
        if hosted.failed.is_none() {
            guarded(hosted, "the physics", HostedWorld::step_world);
        }
        let step_done = Instant::now();
        let hash = guarded(hosted, "the record", |s| s.note(true, start)).flatten();
        let snapshot = match hosted.failed {
            None => publish(hosted, outlet, hash),
            Some(_) => None,
        };
        *untold |= snapshot.is_some();
        describe(hosted, outlet);
        publish_events(hosted, outlet);

        hosted.send_replies();

        // Account for time.
        let end = Instant::now();
        if !stopped {
            hosted.clock.advance(end);
        }
        outlet.ticks.fetch_add(1, Ordering::Relaxed);
        let (overruns, skipped) = (hosted.clock.overruns, hosted.clock.skipped);
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
            finish_steps(hosted, &snapshot); // last, so that the waiting client finds everything done
        }
        Some(physics)
    }
}

/// Adds to a counter; mostly the increment is zero.
fn count(counter: &metrics::Counter, more: u64) {
    if more > 0 {
        counter.increment(more);
    }
}

/// Calls `f`; a panic fails this world and no other.
fn guarded<T>(
    hosted: &mut HostedWorld,
    what: &str,
    f: impl FnOnce(&mut HostedWorld) -> T,
) -> Option<T> {
    let done = catch_unwind(AssertUnwindSafe(|| f(hosted)));
    done.map_err(|panic| fail(hosted, what, &*panic)).ok()
}

/// Notes that a world has failed, and tells its waiters. It keeps its last frame and its first reason.
fn fail(hosted: &mut HostedWorld, what: &str, panic: &(dyn Any + Send)) {
    let message = panic
        .downcast_ref::<&str>()
        .map(|s| (*s).to_owned())
        .or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no message".to_owned());
    tracing::error!(world = hosted.id(), what, message, "world failed");
    hosted.changed = false;
    if hosted.failed.is_some() {
        return;
    }
    metrics::counter!("sinew_worlds_failed_total").increment(1);
    let why = format!("{what} panicked: {message}");
    hosted.failed = Some(why.clone());
    hosted.needs_nothing();
    hosted.touch();
    if let Some(fault) = hosted.failure() {
        hosted.close_mailboxes(&fault);
    }
    hosted.world_event(EventKind::Failed(why.clone()));
    for step in hosted.steps.drain(..) {
        (step.done)(Err(Fault::Internal(why.clone())));
    }
}

/// Shows the world as it is now; `None` if that fails. Waiters for a frame are woken later ([`Outlet::tell`]).
///
/// * `hash`: of its state, if known.
fn publish(hosted: &mut HostedWorld, outlet: &Outlet, hash: Option<u64>) -> Option<Arc<Snapshot>> {
    let snapshot = guarded(hosted, "the frame", |s| {
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
        false // no waiter is woken yet
    });
    hosted.note_shown();
    Some(snapshot)
}

/// Publishes changes of world and figures, before the client that changed them gets an answer.
fn describe(hosted: &mut HostedWorld, outlet: &Outlet) {
    if let Some(described) = guarded(hosted, "the description", HostedWorld::describe).flatten() {
        // The watchdog has already reported the failure; do not overwrite it.
        outlet.described.send_if_modified(|shown| {
            let goes_on = outlet.lost.borrow().is_none();
            if goes_on {
                *shown = described;
            }
            goes_on
        });
    }
}

fn publish_events(hosted: &mut HostedWorld, outlet: &Outlet) {
    let events = hosted.take_events();
    if !events.is_empty() {
        let history = outlet.history.lock();
        history
            .unwrap_or_else(PoisonError::into_inner)
            .note(&events);
        // An error only means that there are no listeners.
        let _ = outlet.events.send(Arc::new(events));
    }
}

fn finish_steps(hosted: &mut HostedWorld, snapshot: &Arc<Snapshot>) {
    let Some(first) = hosted.steps.front_mut() else {
        return;
    };
    first.left -= 1;
    if first.left == 0
        && let Some(step) = hosted.steps.pop_front()
    {
        (step.done)(Ok(snapshot.clone()));
    }
}

#[cfg(test)]
mod tests;
