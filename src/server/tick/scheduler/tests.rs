//! Many worlds on few threads: each gets its ticks, whatever the others do.

use super::priority::Duty;
use super::*;
use crate::tick::command::{CommandOrigin, WorldCommand};
use crate::tick::tests::{Running, workers};
use sinew_wire::status::Fault;
use sinew_wire::types::{EventKind, WorldCondition};
use std::sync::mpsc::sync_channel;
use std::thread;
use std::time::Duration;

fn rounds(scheduler: &Scheduler) -> u64 {
    let seats = scheduler.0.seats.iter();
    seats.map(|s| lock(&s.queue).rounds).sum()
}

/// Waits until a condition holds.
fn until(what: impl Fn() -> bool) {
    let begun = Instant::now();
    while !what() {
        assert!(begun.elapsed() < Duration::from_secs(30), "it never is so");
        pause(Duration::from_millis(1));
    }
}

#[allow(clippy::disallowed_methods, reason = "time has to pass")]
fn pause(time: Duration) {
    thread::sleep(time);
}

fn spin(time: Duration) {
    let begun = Instant::now();
    while begun.elapsed() < time {
        std::hint::spin_loop();
    }
}

#[test]
fn two_hundred_worlds_have_two_workers() {
    let scheduler = Scheduler::start(workers(2)).unwrap();
    let worlds: Vec<_> = (0..200).map(|_| Running::start(&scheduler, 20.0)).collect();
    let before: Vec<u64> = worlds.iter().map(Running::ticks).collect();
    until(|| worlds.iter().zip(&before).all(|(w, b)| w.ticks() > b + 10));
    assert_eq!(
        scheduler.0.threads.load(Ordering::Relaxed),
        4,
        "two of each lane"
    );
    // Their phases differ: no two of them are due together.
    let clocks = worlds.iter().map(|w| w.ask(|s| s.clock.deadline()));
    let period = Duration::from_millis(50).as_nanos();
    let mut phases: Vec<u128> = clocks
        .map(|at| (at - scheduler.0.start).as_nanos() % period)
        .collect();
    phases.sort_unstable();
    let gap = phases.windows(2).map(|w| w[1] - w[0]).min().unwrap();
    assert!(
        gap > period / 1000,
        "{gap} ns between two of 200 in {period} ns"
    );
}

#[test]
fn worlds_go_to_another_worker_when_theirs_is_held_up() {
    for width in [1, 2] {
        let scheduler = Scheduler::start(workers(width)).unwrap();
        let held = Running::start(&scheduler, 100.0);
        let others: Vec<_> = (0..8).map(|_| Running::start(&scheduler, 100.0)).collect();
        let (go, wait) = sync_channel::<()>(1);
        let (tell, told) = sync_channel::<()>(1);
        held.send(move |_| {
            tell.send(()).unwrap();
            wait.recv().unwrap();
        });
        told.recv().unwrap();
        let before: Vec<u64> = others.iter().map(Running::ticks).collect();
        let still = held.ticks();
        until(|| others.iter().zip(&before).all(|(w, b)| w.ticks() > b + 20));
        assert_eq!(held.ticks(), still);
        go.send(()).unwrap();
        until(|| held.ticks() > still);
    }
}

/// Four worlds with rounds of 10 ms fill their worker. One that needs microseconds is still on time, with one worker in
/// each lane.
#[test]
fn worlds_that_need_little_do_not_wait_for_those_that_need_much() {
    let scheduler = Scheduler::start(workers(1)).unwrap();
    let small = Running::start(&scheduler, 100.0);
    let large: Vec<_> = (0..4).map(|_| Running::start(&scheduler, 20.0)).collect();
    let over = Arc::new(AtomicBool::new(false));
    /// A command that takes 10 ms and queues another one for the next round.
    fn again(over: Arc<AtomicBool>, queue: Arc<CommandQueue>) -> WorldCommand {
        let origin = CommandOrigin {
            client: "c".into(),
            sequence: 0,
        };
        let action = Box::new(move |_: &mut HostedWorld| {
            spin(Duration::from_millis(10));
            if !over.load(Ordering::Relaxed) {
                let _ = queue.clone().push(again(over, queue));
            }
        });
        WorldCommand { origin, action }
    }
    for world in &large {
        let queue = world.commands();
        queue.push(again(over.clone(), queue.clone())).unwrap();
    }
    until(|| large.iter().all(|w| lock(&w.added.ticket.slot.place).long));
    small.ask(|_| ());
    let before = small.ticks();
    until(|| small.ticks() > before + 600); // the window of its times
    over.store(true, Ordering::Relaxed);
    let [median, most] = small.late();
    eprintln!("late by {median:.0} µs (median), {most:.0} µs (most)");
    assert!(median < 1500.0, "late by {median} µs");
    assert!(!lock(&small.added.ticket.slot.place).long);
    // The worlds that need little come back again.
    until(|| large.iter().all(|w| !lock(&w.added.ticket.slot.place).long));
}

#[test]
fn a_world_whose_clock_stands_still_costs_nothing_and_wakes_at_once() {
    let scheduler = Scheduler::start(workers(1)).unwrap();
    let world = Running::start(&scheduler, 100.0);
    world.ask(|s| s.pause().unwrap());
    let idle = || lock(&world.added.ticket.slot.place).state == SlotState::Idle;
    until(idle);
    let before = rounds(&scheduler);
    pause(Duration::from_millis(200));
    assert_eq!(rounds(&scheduler), before);
    for _ in 0..1000 {
        world.ask(|_| ()); // a missed command would wait for ever
    }
    let ticks = world.ticks();
    world.ask(|s| s.resume().unwrap());
    until(|| world.ticks() > ticks);
}

#[test]
fn a_round_that_does_not_end_keeps_its_world_and_no_other() {
    let scheduler = Scheduler::start(SchedulerPlan {
        slow: Duration::from_millis(20),
        stuck: Duration::from_millis(200),
        ..workers(1)
    })
    .unwrap();
    let held = Running::start(&scheduler, 100.0);
    let other = Running::start(&scheduler, 100.0);
    let mut events = held.outlet.events.subscribe();
    let (go, wait) = sync_channel::<()>(1);
    let (tell, told) = sync_channel::<()>(1);
    held.send(move |_| {
        tell.send(()).unwrap();
        wait.recv().unwrap();
    });
    told.recv().unwrap();
    let (answer, answered) = sync_channel::<()>(1);
    held.send(move |_| answer.send(()).unwrap());
    until(|| !scheduler.stuck().is_empty());
    assert_eq!(scheduler.stuck(), ["w".into()]);
    until(|| held.outlet.lost.borrow().is_some());
    // Waiters are told, readers see it, and no more commands are taken.
    assert!(answered.recv().is_err());
    let condition = &held.outlet.described.borrow().world.condition.clone();
    let failed = |c: &WorldCondition| matches!(c, WorldCondition::Failed(why) if why.contains("did not end"));
    assert!(failed(condition), "{condition:?}");
    let event = events.blocking_recv().unwrap();
    assert!(matches!(event[0].kind, EventKind::Failed(_)));
    assert!(!held.send(|_| ()));
    // A fresh thread continues with the other one.
    assert_eq!(scheduler.0.threads.load(Ordering::Relaxed), 3);
    let before = other.ticks();
    until(|| other.ticks() > before + 20);
    // The stuck round ends: so does its thread, and nothing else.
    go.send(()).unwrap();
    until(|| scheduler.stuck().is_empty());
    let (before, still) = (other.ticks(), held.ticks());
    until(|| other.ticks() > before + 20);
    assert_eq!(held.ticks(), still);
    assert!(failed(&held.outlet.described.borrow().world.condition));
    // The world ends when it is abandoned, like any other.
    assert!(held.added.closed.has_changed().is_ok());
    held.added.ticket.abandon();
    assert!(held.added.closed.has_changed().is_err());
}

#[test]
fn worlds_end_with_their_scheduler() {
    let scheduler = Scheduler::start(workers(1)).unwrap();
    let world = Running::start(&scheduler, 100.0);
    let idle = Running::start(&scheduler, 100.0);
    idle.ask(|s| s.pause().unwrap());
    let shared = Arc::downgrade(&scheduler.0);
    drop(scheduler);
    until(|| world.added.closed.has_changed().is_err());
    drop((world, idle));
    until(|| shared.strong_count() == 0);
}

#[test]
fn a_world_that_has_ended_takes_no_commands_and_holds_none() {
    let scheduler = Scheduler::start(workers(1)).unwrap();
    let world = Running::start(&scheduler, 100.0);
    let held = Arc::new(());
    // Both arrive while a round ends the world: too late for it, and before others can see that it has ended.
    let (queue, late) = (world.commands().clone(), held.clone());
    world.send(move |s| {
        s.close(Fault::Draining, None);
        let origin = CommandOrigin {
            client: "c".into(),
            sequence: 0,
        };
        let action = Box::new(move |_: &mut HostedWorld| drop(late));
        queue.push(WorldCommand { origin, action }).unwrap();
    });
    until(|| world.added.closed.has_changed().is_err());
    assert_eq!(
        Arc::strong_count(&held),
        1,
        "a command is left in the queue"
    );
    assert!(!world.send(|_| ()));
}

#[test]
fn what_a_thread_is_given_is_what_the_system_says() {
    for most in [
        WorkerPriority::Fifo,
        WorkerPriority::Nice,
        WorkerPriority::Plain,
    ] {
        let done = thread::spawn(move || priority::raise(Duty::Short, most))
            .join()
            .unwrap();
        assert!(done >= most, "{done} is more than {most}");
        #[cfg(target_os = "linux")]
        {
            let (real, nice) = thread::spawn(move || {
                priority::raise(Duty::Short, most);
                // A replacement thread for long rounds is never in real time.
                let child = thread::spawn(move || {
                    priority::raise(Duty::Long, most);
                    thread_priority::thread_schedule_policy().unwrap()
                });
                let child = child.join().unwrap();
                assert!(matches!(
                    child,
                    thread_priority::ThreadSchedulePolicy::Normal(_)
                ));
                let policy = thread_priority::thread_schedule_policy().unwrap();
                let nice = rustix::process::getpriority_process(Some(rustix::thread::gettid()));
                (
                    matches!(policy, thread_priority::ThreadSchedulePolicy::Realtime(_)),
                    nice.unwrap(),
                )
            })
            .join()
            .unwrap();
            assert_eq!(real, done == WorkerPriority::Fifo);
            assert_eq!(nice < 0, done == WorkerPriority::Nice, "{nice}");
        }
    }
    assert_eq!(WorkerPriority::by_name("fifo"), Some(WorkerPriority::Fifo));
    assert_eq!(WorkerPriority::by_name("FIFO"), None);
}
