//! The loop of one world, with commands that take long and with commands that break it.

use super::command::{Command, Inbox, Origin};
use super::planners::Planners;
use super::shard::{Limits, Shard};
use super::*;
use crate::wire::convert;
use crate::wire::types::WorldCondition;
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread::JoinHandle;

struct Running {
    commands: SyncSender<Command>,
    outlet: Arc<Outlet>,
    thread: JoinHandle<()>,
}

impl Running {
    fn start(rate_hz: f64) -> Self {
        let settings = convert::world::settings(Some(crate::wire::pb::World {
            rate_hz,
            ..Default::default()
        }))
        .unwrap();
        let limits = Limits {
            figures: 4,
            window: 0.0,
        };
        let planners = Arc::new(Planners::start());
        let budget = Arc::new(budget::Budget::new(100.0));
        let mut shard = Shard::new("w".into(), settings, false, limits, planners, budget).unwrap();
        let outlet = Arc::new(Outlet {
            latest: watch::Sender::new(shard.snapshot()),
            history: Mutex::new(History::new(4)),
            described: watch::Sender::new(shard.describe().unwrap()),
            events: broadcast::Sender::new(16),
            times: Mutex::default(),
            ticks: AtomicU64::new(0),
            overruns: AtomicU64::new(0),
            skipped: AtomicU64::new(0),
        });
        let (commands, queue) = sync_channel(1024);
        let out = outlet.clone();
        let thread = std::thread::spawn(move || run(shard, Inbox::new(queue, 1024), &out));
        Self {
            commands,
            outlet,
            thread,
        }
    }

    fn send(&self, action: impl FnOnce(&mut Shard) + Send + 'static) {
        let origin = Origin {
            client: "c".into(),
            sequence: 0,
        };
        let action = Box::new(action);
        self.commands.send(Command { origin, action }).unwrap();
    }

    fn ask<T: Send + 'static>(&self, f: impl FnOnce(&mut Shard) -> T + Send + 'static) -> T {
        let (tx, rx) = sync_channel(64);
        self.send(move |s| tx.send(f(s)).unwrap());
        rx.recv().expect("its thread lives")
    }

    fn end(self) {
        self.send(|s| s.close(Fault::Draining, None));
        self.thread.join().unwrap();
    }
}

#[test]
fn commands_that_take_long_are_spread_over_ticks_in_order() {
    let world = Running::start(50.0); // 5 ms of each tick are for commands
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
    let world = Running::start(100.0);
    world.ask(|s| s.pause().unwrap()); // so that no tick comes before the frame
    let body = Arc::new(crate::sim::body::Body::adult_man());
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
