//! The loop of one world, with commands that take long and commands that break it.

use super::command::{CommandOrigin, CommandQueue, WorldCommand};
use super::hosted_world::{HostedWorld, WorldLimits};
use super::planners::Planners;
use super::scheduler::{Added, Scheduler, SchedulerPlan, WorkerPriority};
use super::*;
use sinew_wire::convert;
use sinew_wire::types::{Overrun, WorldCondition, WorldUpdate};
use std::sync::mpsc::sync_channel;

/// Workers of a test: plain threads, so that tests beside it are not delayed.
pub(super) fn workers(workers: usize) -> SchedulerPlan {
    SchedulerPlan {
        workers,
        priority: WorkerPriority::Plain,
        slow: Duration::from_secs(60),
        stuck: Duration::from_secs(60),
    }
}

/// A world of a scheduler.
pub(super) struct Running {
    commands: Arc<CommandQueue>,
    pub(super) outlet: Arc<Outlet>,
    pub(super) added: Added,
}

impl Running {
    pub(super) fn start(scheduler: &Scheduler, rate_hz: f64) -> Self {
        let settings = convert::world::settings(Some(sinew_wire::pb::World {
            rate_hz,
            ..Default::default()
        }))
        .unwrap();
        let limits = WorldLimits {
            figures: 4,
            window: 0.0,
        };
        let planners = Arc::new(Planners::start());
        let budget = Arc::new(budget::Budget::new(100.0));
        let mut hosted =
            HostedWorld::new("w".into(), settings, false, limits, planners, budget).unwrap();
        let outlet = Arc::new(Outlet::new(&mut hosted, 4, 16));
        let commands = Arc::new(CommandQueue::new(1024));
        let added = scheduler.add(hosted, &commands, &outlet);
        Self {
            commands,
            outlet,
            added,
        }
    }

    pub(super) fn commands(&self) -> &Arc<CommandQueue> {
        &self.commands
    }

    pub(super) fn ticks(&self) -> u64 {
        self.outlet.ticks.load(Ordering::Relaxed)
    }

    /// Median and largest lateness of recent ticks, µs.
    pub(super) fn late(&self) -> [f64; 2] {
        let late = self.outlet.times.lock().unwrap().summary()[0];
        [late.p50, late.max]
    }

    /// Returns false if it takes no more commands.
    pub(super) fn send(&self, action: impl FnOnce(&mut HostedWorld) + Send + 'static) -> bool {
        let origin = CommandOrigin {
            client: "c".into(),
            sequence: 0,
        };
        let action = Box::new(action);
        let sent = self.commands.push(WorldCommand { origin, action }).is_ok();
        self.added.ticket.wake();
        sent
    }

    pub(super) fn ask<T: Send + 'static>(
        &self,
        f: impl FnOnce(&mut HostedWorld) -> T + Send + 'static,
    ) -> T {
        let (tx, rx) = sync_channel(64);
        assert!(self.send(move |s| tx.send(f(s)).unwrap()));
        rx.recv().expect("it goes on")
    }

    /// Waits until it has ended.
    fn end(self) {
        self.send(|s| s.close(Fault::Draining, None));
        while self.added.closed.has_changed().is_ok() {
            std::thread::yield_now();
        }
    }
}

#[test]
fn commands_that_take_long_are_spread_over_ticks_in_order() {
    let scheduler = Scheduler::start(workers(1)).unwrap();
    let world = Running::start(&scheduler, 50.0); // 5 ms of each tick go to commands
    let (tx, rx) = sync_channel(64);
    for n in 0..40 {
        let tx = tx.clone();
        world.send(move |s| {
            let begun = Instant::now();
            while begun.elapsed() < Duration::from_millis(2) {
                std::hint::spin_loop();
            }
            tx.send((n, s.info().tick)).unwrap();
        });
    }
    drop(tx);
    let done: Vec<(i32, u64)> = rx.iter().collect();
    assert!(done.iter().map(|(n, _)| *n).eq(0..40), "{done:?}");
    for tick in done.chunk_by(|a, b| a.1 == b.1) {
        assert!(tick.len() <= 3, "too many in one tick: {tick:?}");
    }
    world.end();
}

#[test]
fn a_frame_that_cannot_be_made_fails_the_world_and_not_its_thread() {
    let scheduler = Scheduler::start(workers(1)).unwrap();
    let world = Running::start(&scheduler, 100.0);
    world.ask(|s| s.pause().unwrap()); // so that no tick comes before the frame
    let body = Arc::new(sinew_physics::body::Body::adult_man());
    let settings = convert::figure::settings("figure", None).unwrap();
    world.ask(move |s| {
        s.create_figure(Some("a".into()), settings, body).unwrap();
        s.forget_in_physics("a");
    });
    let condition = loop {
        let info = world.ask(|s| s.info());
        if info.condition != WorldCondition::Paused {
            break info.condition;
        }
    };
    assert!(
        matches!(&condition, WorldCondition::Failed(why) if why.starts_with("the frame panicked")),
        "{condition:?}"
    );
    assert!(world.outlet.latest.borrow().figures.len() <= 1);
    world.end();
}

/// Ticks delayed by a long command are computed back to back, and none is skipped.
#[test]
fn missed_ticks_are_caught_up_where_that_is_asked_for() {
    let scheduler = Scheduler::start(workers(1)).unwrap();
    let world = Running::start(&scheduler, 20.0);
    let update = WorldUpdate {
        overrun: Some(Overrun::CatchUp(100)),
        ..WorldUpdate::default()
    };
    world.ask(|s| s.update(update).unwrap());
    let (begun, before) = (Instant::now(), world.ticks());
    world.ask(|_| {
        let begun = Instant::now();
        while begun.elapsed() < Duration::from_millis(180) {
            std::hint::spin_loop();
        }
    });
    let missed = world.outlet.latest.borrow().tick;
    while world.outlet.overruns.load(Ordering::Relaxed) == 0 || world.ticks() < before + 6 {
        assert!(begun.elapsed() < Duration::from_secs(20), "it stands still");
        std::thread::yield_now();
    }
    let ticks = world.outlet.latest.borrow().tick;
    assert!(ticks > missed);
    assert_eq!(world.outlet.skipped.load(Ordering::Relaxed), 0);
    world.end();
}

/// Frames of several worlds that are due at once are announced together, and none is kept back: every waiter sees the
/// present tick, even when the worker has no work left.
#[test]
fn who_waits_for_a_frame_is_told_of_the_latest_one() {
    let scheduler = Scheduler::start(workers(1)).unwrap();
    let worlds: Vec<_> = (0..5).map(|_| Running::start(&scheduler, 50.0)).collect();
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_time()
        .build()
        .unwrap();
    for world in &worlds {
        let mut frames = world.outlet.latest.subscribe();
        let mut last = frames.borrow_and_update().tick;
        for _ in 0..5 {
            let told =
                async { tokio::time::timeout(Duration::from_secs(10), frames.changed()).await };
            runtime.block_on(told).expect("a frame in time").unwrap();
            let tick = frames.borrow_and_update().tick;
            assert!(tick > last, "{tick} after {last}");
            last = tick;
        }
        // The last frame is announced, too, although no frame follows it.
        world.ask(|s| s.pause().unwrap());
        while last != world.outlet.latest.borrow().tick {
            let told =
                async { tokio::time::timeout(Duration::from_secs(10), frames.changed()).await };
            runtime.block_on(told).expect("the last frame").unwrap();
            last = frames.borrow_and_update().tick;
        }
    }
    for world in worlds {
        world.end();
    }
}
