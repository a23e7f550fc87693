//! Work that is too long for a tick, done aside: begun in one tick, needed in a later one that is fixed beforehand.
//!
//! Who needs it waits if it is not done by then, and does it itself if nobody has begun: what comes out, and when it
//! counts, depends neither on how fast the machine is nor on how many threads it has.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread;

/// Most threads that plan, for all worlds together.
const MOST_PLANNERS: usize = 4;
/// Most plans that wait for one of them; what finds no room is worked out by who needs it.
const MOST_WAITING: usize = 256;

type Work<T> = Box<dyn FnOnce() -> T + Send>;

enum Stage<T> {
    Waiting(Work<T>),
    Begun,
    Done(thread::Result<T>),
    Taken,
}

struct Shared<T> {
    stage: Mutex<Stage<T>>,
    done: Condvar,
}

impl<T> Shared<T> {
    /// No code of others runs under the lock, so that it is never left in between.
    fn stage(&self) -> MutexGuard<'_, Stage<T>> {
        self.stage.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

trait Task: Send + Sync {
    fn run(&self);
}

impl<T: Send> Task for Shared<T> {
    /// Does it, unless somebody has begun or nobody wants it any more.
    fn run(&self) {
        let work = {
            let mut stage = self.stage();
            match std::mem::replace(&mut *stage, Stage::Begun) {
                Stage::Waiting(work) => work,
                other => {
                    *stage = other;
                    return;
                }
            }
        };
        let out = catch_unwind(AssertUnwindSafe(work));
        *self.stage() = Stage::Done(out);
        self.done.notify_all();
    }
}

/// Work that somebody else does meanwhile. Dropped, it is not begun any more.
pub struct Plan<T>(Arc<Shared<T>>);

impl<T> std::fmt::Debug for Plan<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Plan")
    }
}

impl<T> Drop for Plan<T> {
    fn drop(&mut self) {
        let mut stage = self.0.stage();
        if let Stage::Waiting(_) = *stage {
            *stage = Stage::Taken;
        }
    }
}

impl<T: Send + 'static> Plan<T> {
    /// Begins `work` aside.
    pub fn new(work: impl FnOnce() -> T + Send + 'static) -> Self {
        let shared = Arc::new(Shared {
            stage: Mutex::new(Stage::Waiting(Box::new(work))),
            done: Condvar::new(),
        });
        // Without room, or without anybody, it waits for who needs it.
        let _ = planners().try_send(Arc::clone(&shared) as Arc<dyn Task>);
        Self(shared)
    }

    /// What came out: at once, if it is done by now.
    pub fn take(self) -> T {
        self.0.run();
        let mut stage = self.0.stage();
        while let Stage::Begun = *stage {
            let waited = self.0.done.wait(stage);
            stage = waited.unwrap_or_else(PoisonError::into_inner);
        }
        match std::mem::replace(&mut *stage, Stage::Taken) {
            Stage::Done(Ok(out)) => out,
            Stage::Done(Err(panic)) => {
                drop(stage);
                resume_unwind(panic)
            }
            Stage::Waiting(_) | Stage::Begun | Stage::Taken => {
                unreachable!("it was done, and is taken once")
            }
        }
    }
}

/// The threads that plan, begun with the first plan.
fn planners() -> &'static SyncSender<Arc<dyn Task>> {
    static PLANNERS: OnceLock<SyncSender<Arc<dyn Task>>> = OnceLock::new();
    PLANNERS.get_or_init(|| {
        let (send, receive) = sync_channel(MOST_WAITING);
        let receive = Arc::new(Mutex::new(receive));
        let count = thread::available_parallelism().map_or(1, usize::from);
        for _ in 0..count.min(MOST_PLANNERS) {
            let receive = Arc::clone(&receive);
            let plan = move || serve(&receive);
            // A machine that has no thread to spare plans in the tick.
            let _ = thread::Builder::new().name("planner".into()).spawn(plan);
        }
        send
    })
}

fn serve(receive: &Mutex<Receiver<Arc<dyn Task>>>) {
    loop {
        let next = receive
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .recv();
        let Ok(task) = next else { return };
        task.run();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn every_plan_is_worked_out_once_whoever_does_it() {
        static DONE: AtomicUsize = AtomicUsize::new(0);
        // More than fit into the queue.
        let plans: Vec<_> = (0..3 * MOST_WAITING)
            .map(|i| {
                Plan::new(move || {
                    DONE.fetch_add(1, Ordering::Relaxed);
                    i * i
                })
            })
            .collect();
        let count = plans.len();
        for (i, plan) in plans.into_iter().enumerate() {
            assert_eq!(plan.take(), i * i);
        }
        assert_eq!(DONE.load(Ordering::Relaxed), count);
    }

    #[test]
    fn a_panic_is_the_one_of_who_takes_it() {
        let plan = Plan::new(|| -> u32 { panic!("no way") });
        assert!(catch_unwind(AssertUnwindSafe(|| plan.take())).is_err());
        assert_eq!(Plan::new(|| 7).take(), 7);
    }

    #[test]
    fn what_nobody_wants_any_more_is_not_begun() {
        let shared = Arc::new(Shared {
            stage: Mutex::new(Stage::Waiting(Box::new(|| panic!("begun")))),
            done: Condvar::new(),
        });
        drop(Plan::<u32>(Arc::clone(&shared)));
        shared.run();
        assert!(matches!(*shared.stage(), Stage::Taken));
    }
}
