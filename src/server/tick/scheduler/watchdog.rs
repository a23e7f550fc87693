//! Watches for rounds that do not end: reports them, then gives their worlds up, and lets a fresh thread continue with
//! the others.
//!
//! Time only counts while this thread runs: after a pause of the whole process no world counts as stuck.

use super::priority::{self, Duty, WorkerPriority};
use super::slot::lock;
use super::workers::Workers;
use std::sync::atomic::Ordering;
use std::sync::{Arc, Weak};
use std::thread;
use std::time::Duration;

/// Number of checks within the shorter limit.
const LOOKS: u32 = 8;
/// Least and most time between two checks.
const EVERY: (Duration, Duration) = (Duration::from_millis(1), Duration::from_millis(250));

/// The round last seen on one seat.
#[derive(Clone, Copy, Debug, Default)]
struct SeatWatch {
    round: u64,
    /// How long this round has been seen.
    time: Duration,
    reported: bool,
}

/// Starts it. It ends with the scheduler.
pub(super) fn start(shared: &Arc<Workers>) -> std::io::Result<()> {
    let (slow, stuck) = (shared.plan.slow, shared.plan.stuck);
    let every = (slow.min(stuck) / LOOKS).clamp(EVERY.0, EVERY.1);
    let most = shared.plan.priority;
    let shared = Arc::downgrade(shared);
    let builder = thread::Builder::new().name("watchdog".into());
    builder
        .spawn(move || {
            priority::raise(Duty::Watch, most);
            watch(&shared, every);
        })
        .map(|_| ())
}

#[allow(
    clippy::disallowed_methods,
    reason = "it looks at regular times, and nobody waits for it"
)]
fn watch(shared: &Weak<Workers>, every: Duration) {
    let mut seen: Vec<SeatWatch> = Vec::new();
    loop {
        thread::sleep(every);
        let Some(shared) = shared.upgrade() else {
            return;
        };
        if shared.ending.load(Ordering::SeqCst) {
            return;
        }
        seen.resize(shared.seats.len(), SeatWatch::default());
        for (seat, seen) in seen.iter_mut().enumerate() {
            look(&shared, seat, seen, every);
        }
    }
}

fn look(shared: &Arc<Workers>, seat: usize, seen: &mut SeatWatch, every: Duration) {
    let mut queue = lock(&shared.seats[seat].queue);
    let Some(slot) = queue.running.clone() else {
        *seen = SeatWatch::default();
        return;
    };
    if queue.rounds != seen.round {
        *seen = SeatWatch {
            round: queue.rounds,
            ..SeatWatch::default()
        };
        return;
    }
    seen.time += every;
    let tick = slot.outside.outlet.latest.borrow().tick + 1;
    let (world, seconds) = (&*slot.world, seen.time.as_secs_f64());
    if seen.time >= shared.plan.stuck {
        // The thread keeps this world. When it ends the round it sees that it has lost its seat.
        let lost = queue.epoch;
        if let Some((thread, had)) = queue.thread {
            priority::lower(thread, had); // for good
        }
        queue.running = None;
        queue.epoch = 0;
        drop(queue);
        let mut stuck = lock(&shared.stuck);
        stuck.push((lost, slot.world.clone()));
        metrics::gauge!("sinew_stuck_worlds").set(stuck.len() as f64);
        drop(stuck);
        metrics::counter!("sinew_slow_ticks_total").increment(1);
        tracing::error!(
            world,
            tick,
            seconds,
            "a tick does not end: the world is given up"
        );
        slot.give_up(&format!("tick {tick} did not end within {seconds:.1} s"));
        if let Err(error) = shared.clone().spawn(seat) {
            tracing::error!(%error, "no thread in place of one that does not come back");
        }
        *seen = SeatWatch::default();
    } else if seen.time >= shared.plan.slow && !seen.reported {
        seen.reported = true;
        if let Some((thread, had)) = queue.thread
            && had != WorkerPriority::Plain
        {
            // The thread has the seat, so it is alive. In real time it could keep all others from theirs. A plain
            // thread is not lowered, because raising it again may not be allowed.
            priority::lower(thread, had);
            queue.lowered = true;
        }
        drop(queue);
        tracing::warn!(world, tick, seconds, "a tick takes long");
    }
}
