//! How late ticks begin when many worlds share a few threads, against a thread for each world, in one run.
//!
//! ```sh
//! cargo run --release -p tools --bin lateness -- 10      # seconds of each measurement
//! ```
//!
//! 1,000 empty worlds, then 120 worlds with one figure each, all at 60 Hz. Lateness is the time from the deadline of a
//! tick to its start. The output is the median and p99 of the last 600 ticks of each world, as the mean over the worlds
//! and the worst world. Both variants use plain threads; afterwards the shared threads run in real time, if the system
//! allows it.
use sinew_physics::body::Body;
use sinew_server::tick::budget::Budget;
use sinew_server::tick::command::CommandQueue;
use sinew_server::tick::hosted_world::{HostedWorld, WorldLimits};
use sinew_server::tick::planners::Planners;
use sinew_server::tick::scheduler::{Scheduler, SchedulerPlan, WorkerPriority};
use sinew_server::tick::{Next, Outlet, Runner};
use sinew_wire::{convert, pb};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// State shared by all worlds.
struct Common {
    planners: Arc<Planners>,
    budget: Arc<Budget>,
    body: Arc<Body>,
}

struct World {
    shard: HostedWorld,
    commands: Arc<CommandQueue>,
    outlet: Arc<Outlet>,
}

/// Median and p99 as the mean over worlds, p99 of the worst one, ms; ticks per second; processors.
struct Measured([f64; 5]);

fn world(common: &Common, figures: usize) -> World {
    let settings = convert::world::settings(Some(pb::World::default())).expect("defaults");
    let limits = WorldLimits {
        figures: 64,
        window: 0.0,
    };
    let (planners, budget) = (common.planners.clone(), common.budget.clone());
    let mut shard =
        HostedWorld::new("w".into(), settings, false, limits, planners, budget).expect("a world");
    for _ in 0..figures {
        let settings = convert::figure::settings("figure", None).expect("defaults");
        let made = shard.create_figure(None, settings, common.body.clone());
        made.expect("there is room");
    }
    World {
        outlet: Arc::new(Outlet::new(&mut shard, 64, 1024)),
        commands: Arc::new(CommandQueue::new(1024)),
        shard,
    }
}

fn processor_time() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after = stat.rsplit(')').next().unwrap_or_default();
    let ticks = after.split_whitespace().skip(11).take(2);
    ticks.filter_map(|t| t.parse::<f64>().ok()).sum::<f64>() / 100.0
}

fn resident_kib() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|l| l.strip_prefix("VmRSS:"));
    let number = line.and_then(|l| l.split_whitespace().next()?.parse().ok());
    number.unwrap_or(f64::NAN)
}

fn threads() -> usize {
    std::fs::read_dir("/proc/self/task").map_or(0, Iterator::count)
}

#[allow(clippy::disallowed_methods, reason = "time has to pass")]
fn pass(time: Duration) {
    thread::sleep(time);
}

fn measure(outlets: &[Arc<Outlet>], seconds: f64) -> Measured {
    pass(Duration::from_secs(2)); // until all are running
    let ticks = || -> u64 {
        outlets
            .iter()
            .map(|o| o.ticks.load(Ordering::Relaxed))
            .sum()
    };
    let begun = (Instant::now(), processor_time(), ticks());
    pass(Duration::from_secs_f64(seconds));
    let time = begun.0.elapsed().as_secs_f64();
    let late: Vec<_> = outlets
        .iter()
        .map(|o| o.times.lock().map(|t| t.summary()[0]).unwrap_or_default())
        .collect();
    let mean = |of: fn(&sinew_server::tick::stage_times::Percentiles) -> f64| {
        late.iter().map(of).sum::<f64>() / late.len() as f64 * 1e-3
    };
    Measured([
        mean(|p| p.p50),
        mean(|p| p.p99),
        late.iter().map(|p| p.p99).fold(0.0, f64::max) * 1e-3,
        (ticks() - begun.2) as f64 / time,
        (processor_time() - begun.1) / time,
    ])
}

/// A thread for each world, as it was before.
fn apart(worlds: Vec<World>, seconds: f64) -> Measured {
    let outlets: Vec<_> = worlds.iter().map(|w| w.outlet.clone()).collect();
    let over = Arc::new(AtomicBool::new(false));
    let all: Vec<_> = worlds
        .into_iter()
        .map(|w| {
            let over = over.clone();
            thread::spawn(move || {
                let mut runner = Runner::new(w.shard, &w.commands, &w.outlet);
                while !over.load(Ordering::Relaxed) {
                    if let Next::At(at, _) = runner.next() {
                        pass(at.saturating_duration_since(Instant::now()));
                    }
                    runner.round();
                }
            })
        })
        .collect();
    println!("  {} threads", threads());
    let measured = measure(&outlets, seconds);
    over.store(true, Ordering::Relaxed);
    all.into_iter().for_each(|t| drop(t.join()));
    measured
}

/// The scheduler's threads.
fn shared(worlds: Vec<World>, priority: WorkerPriority, seconds: f64) -> Measured {
    let plan = SchedulerPlan {
        workers: 0,
        priority,
        slow: Duration::from_secs(1),
        stuck: Duration::from_secs(10),
    };
    let scheduler = Scheduler::start(plan).expect("threads");
    let outlets: Vec<_> = worlds.iter().map(|w| w.outlet.clone()).collect();
    let added: Vec<_> = worlds
        .into_iter()
        .map(|w| scheduler.add(w.shard, &w.commands, &w.outlet))
        .collect();
    pass(Duration::from_millis(100));
    let (workers, obtained) = scheduler.workers();
    println!(
        "  {} threads, {workers} workers in each lane, {obtained}",
        threads()
    );
    let measured = measure(&outlets, seconds);
    drop(added);
    measured
}

fn main() {
    let seconds = std::env::args().nth(1).and_then(|s| s.parse().ok());
    let seconds: f64 = seconds.unwrap_or(10.0);
    let common = Common {
        planners: Arc::new(Planners::start()),
        budget: Arc::new(Budget::new(1000.0)),
        body: Arc::new(Body::adult_man()),
    };
    for (count, figures) in [(1000, 0), (120, 1)] {
        println!("{count} worlds with {figures} figures");
        let before = resident_kib();
        let make = || -> Vec<World> { (0..count).map(|_| world(&common, figures)).collect() };
        let worlds = make();
        let each = (resident_kib() - before) / f64::from(count);
        println!("  {each:.0} KiB of memory each, before the first tick");
        let old = apart(worlds, seconds);
        let plain = shared(make(), WorkerPriority::Plain, seconds);
        let real = shared(make(), WorkerPriority::Fifo, seconds);
        println!("                      a thread each   shared   ratio   real time   ratio");
        let names = [
            "late, median, ms",
            "late, p99, ms",
            "worst world's p99, ms",
            "ticks per second",
            "processors",
        ];
        for (i, name) in names.iter().enumerate() {
            let (old, plain, real) = (old.0[i], plain.0[i], real.0[i]);
            println!(
                "  {name:22} {old:10.3} {plain:8.3} {:7.2} {real:11.3} {:7.2}",
                plain / old,
                real / old
            );
        }
    }
}
