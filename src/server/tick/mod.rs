//! The rate keeper: each world has a thread that runs [`run`].
//!
//! A tick is: wait for the deadline, carry out commands in order, sample desired motion, step the physics, publish the
//! frame, account for time. The thread never waits for a client, for a lock held elsewhere, or for the disk. Commands
//! come through a bounded queue, frames leave through latest-wins cells.

pub mod budget;
pub mod clock;
pub mod command;
pub mod drives;
pub mod history;
pub mod leases;
pub mod planners;
pub mod shard;
pub mod stage_times;

use crate::wire::status::Fault;
use crate::wire::types::{Described, EventKind, Snapshot, WorldEvent};
use command::Inbox;
use history::History;
use shard::Shard;
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

/// What leaves a world's thread.
#[derive(Debug)]
pub struct Outlet {
    /// Latest frame.
    pub latest: watch::Sender<Arc<Snapshot>>,
    /// Frames of the last ticks. Whoever looks into it copies pointers, so the world's thread does not wait for long.
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

/// Runs one world until it is closed or all its handles are gone.
pub fn run(mut shard: Shard, mut inbox: Inbox, outlet: &Outlet) {
    let mut meter = shard.meter();
    loop {
        // Wait: for the deadline, for a command if the clock stands still, not at all if someone waits for steps.
        let stopped = shard.paused || shard.failed.is_some();
        let wait = match (stopped, shard.steps.is_empty()) {
            (true, true) => PATIENCE,
            (true, false) => Duration::ZERO,
            (false, _) => shard
                .clock
                .deadline()
                .saturating_duration_since(Instant::now())
                .min(PATIENCE),
        };
        if !inbox.wait(wait, stopped) {
            break;
        }
        let start = Instant::now();
        let late = start.saturating_duration_since(shard.clock.deadline());

        // Motion that drivers have left, then commands in (client, sequence) order.
        guarded(&mut shard, "taking motion", Shard::collect_motion);
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
            guarded(&mut shard, "a command", |s| (c.action)(s));
            shard.touch();
            if start.elapsed() >= allowance {
                break;
            }
        }
        metrics::counter!("sinew_commands_deferred_total").increment(inbox.left() as u64);
        guarded(&mut shard, "drives and plans", |s| {
            s.expire_drives(start);
            s.offer_plans();
        });
        if shard.closing.is_some() {
            publish_events(&mut shard, outlet); // that it was deleted is the last one
            break;
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
            if shard.changed {
                publish(&mut shard, outlet);
            }
            describe(&mut shard, outlet);
            publish_events(&mut shard, outlet);
            shard.send_replies();
            continue;
        }

        guarded(&mut shard, "sampling desired motion", Shard::sample_motion);
        let motion_done = Instant::now();
        if shard.failed.is_none() {
            guarded(&mut shard, "the physics", Shard::step_world);
        }
        let step_done = Instant::now();
        let snapshot = match shard.failed {
            None => publish(&mut shard, outlet),
            Some(_) => None,
        };
        describe(&mut shard, outlet);
        publish_events(&mut shard, outlet);

        shard.send_replies();

        // Account for time.
        let end = Instant::now();
        let rest = meter.tick(step_done - motion_done, shard.figure_count());
        if !stopped {
            shard.clock.advance(end);
            shard.clock.rest(end + rest);
        }
        outlet.ticks.fetch_add(1, Ordering::Relaxed);
        let (overruns, skipped) = (shard.clock.overruns, shard.clock.skipped);
        let overran = overruns - outlet.overruns.swap(overruns, Ordering::Relaxed);
        let left_out = skipped - outlet.skipped.swap(skipped, Ordering::Relaxed);
        metrics::counter!("sinew_ticks_overrun_total").increment(overran);
        metrics::counter!("sinew_ticks_skipped_total").increment(left_out);
        metrics::counter!("sinew_ticks_total").increment(1);
        let stages = [
            if stopped { Duration::ZERO } else { late },
            commands_done - start,
            motion_done - commands_done,
            step_done - motion_done,
            end - step_done,
            end - start,
        ];
        stage_times::count(&stages, !stopped);
        if let Ok(mut times) = outlet.times.try_lock() {
            times.record(stages);
        }
        if let Some(snapshot) = snapshot {
            finish_steps(&mut shard, &snapshot); // last, so that who waits finds everything done
        }
    }
    shard.send_replies();
    let why = shard.closing.take().unwrap_or(Fault::Draining);
    for step in shard.steps.drain(..) {
        (step.done)(Err(why.clone()));
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

/// Shows the world as it is now; `None` if that fails.
fn publish(shard: &mut Shard, outlet: &Outlet) -> Option<Arc<Snapshot>> {
    let snapshot = guarded(shard, "the frame", |s| {
        s.publish_feedback();
        s.snapshot()
    })?;
    let mut history = outlet
        .history
        .lock()
        .unwrap_or_else(PoisonError::into_inner);
    history.push(snapshot.clone());
    drop(history);
    outlet.latest.send_replace(snapshot.clone());
    shard.note_shown();
    Some(snapshot)
}

/// Tells what changed of world and figures, before who changed it gets an answer.
fn describe(shard: &mut Shard, outlet: &Outlet) {
    if let Some(described) = guarded(shard, "the description", Shard::describe).flatten() {
        outlet.described.send_replace(described);
    }
}

fn publish_events(shard: &mut Shard, outlet: &Outlet) {
    let events = shard.take_events();
    if !events.is_empty() {
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
