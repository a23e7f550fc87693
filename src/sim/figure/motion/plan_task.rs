//! Plans that take too long for a tick. A figure states a problem in one tick and takes the result in a later one that
//! is fixed beforehand.
//!
//! Nothing here runs on its own. The caller that steps the world may solve the problems in the meantime, on its own
//! threads ([`World::plan_requests`](crate::world::World::plan_requests)). A problem that is not solved by then is
//! solved by the tick that takes it ([`Planning::InTick`]), or planned again for a later tick ([`Planning::Aside`]).

use serde::{Deserialize, Serialize};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock, Weak};

/// Plans that a tick needed and that were missing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct LatePlans {
    /// The exit from the motion.
    pub exit: bool,
    /// The way into the queued clip.
    pub entry: bool,
}

impl LatePlans {
    /// Number of missing plans.
    pub fn count(self) -> usize {
        usize::from(self.exit) + usize::from(self.entry)
    }
}

/// A problem and, once it is solved, its result.
struct SharedTask<T> {
    /// Depends only on its captured values, so that it may run twice.
    work: Box<dyn Fn() -> T + Send + Sync>,
    /// `None` if the work panicked: the tick that takes it sees that panic.
    result: OnceLock<Option<T>>,
    /// Whether a thread has promised to solve it.
    accepted: AtomicBool,
}

trait PlanProblem: Send + Sync {
    fn solve(&self);
    fn accept(&self);
}

impl<T: Send + Sync> PlanProblem for SharedTask<T> {
    fn solve(&self) {
        if self.result.get().is_none() {
            let out = catch_unwind(AssertUnwindSafe(&self.work)).ok();
            // If another thread has set a result by now, it is the same.
            let _ = self.result.set(out);
        }
    }

    fn accept(&self) {
        self.accepted.store(true, Ordering::Relaxed);
    }
}

/// A plan that a figure has asked for. Dropping it cancels the request.
pub(in crate::figure) struct PlanTask<T>(Arc<SharedTask<T>>);

impl<T> Clone for PlanTask<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<T> std::fmt::Debug for PlanTask<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("PlanTask")
    }
}

impl<T: Clone + Send + Sync + 'static> PlanTask<T> {
    /// A problem that `work` solves.
    pub fn new(work: impl Fn() -> T + Send + Sync + 'static) -> Self {
        Self(Arc::new(SharedTask {
            work: Box::new(work),
            result: OnceLock::new(),
            accepted: AtomicBool::new(false),
        }))
    }

    /// Whether [`Self::take`] has nothing left to work out.
    pub fn is_ready(&self) -> bool {
        self.0.result.get().is_some()
    }

    /// The result, if it is there.
    pub fn result(&self) -> Option<&T> {
        self.0.result.get()?.as_ref()
    }

    /// Works out the result if it is missing.
    pub fn settle(&self) {
        self.0.solve();
    }

    /// The result, worked out now if it is missing. Never waits for another thread that is working on it.
    pub fn take(self) -> T {
        match self.result() {
            Some(out) => out.clone(),
            None => (self.0.work)(),
        }
    }

    /// A request to solve it, unless one was accepted.
    pub fn request(&self) -> Option<PlanRequest> {
        let problem: Arc<dyn PlanProblem> = self.0.clone();
        let open = !self.is_ready() && !self.0.accepted.load(Ordering::Relaxed);
        open.then(|| PlanRequest(Arc::downgrade(&problem)))
    }
}

/// A problem that another thread may solve.
#[derive(Clone)]
pub struct PlanRequest(Weak<dyn PlanProblem>);

impl std::fmt::Debug for PlanRequest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("PlanRequest")
    }
}

impl PlanRequest {
    /// Accepts the request, so that it is not made again.
    pub fn accept(&self) {
        if let Some(problem) = self.0.upgrade() {
            problem.accept();
        }
    }

    /// Solves it, on any thread, unless its figure no longer wants it.
    pub fn solve(&self) {
        if let Some(problem) = self.0.upgrade() {
            problem.solve();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicUsize;

    #[test]
    fn a_plan_that_was_solved_is_not_worked_out_again_and_any_other_is() {
        let done = Arc::new(AtomicUsize::new(0));
        let count = Arc::clone(&done);
        let task = PlanTask::new(move || count.fetch_add(1, Ordering::Relaxed));
        let request = task.request().unwrap();
        request.accept();
        assert!(task.request().is_none() && !task.is_ready());
        request.solve();
        request.solve();
        assert!(task.is_ready() && task.result() == Some(&0));
        assert_eq!((task.take(), done.load(Ordering::Relaxed)), (0, 1));
        assert_eq!(PlanTask::new(|| 7).take(), 7);
    }

    #[test]
    fn a_panic_is_the_one_of_whoever_takes_the_plan() {
        let task = PlanTask::new(|| -> u32 { panic!("no plan") });
        task.request().unwrap().solve();
        assert!(task.is_ready() && task.result().is_none());
        assert!(catch_unwind(AssertUnwindSafe(|| task.take())).is_err());
    }

    #[test]
    fn a_plan_that_is_not_wanted_any_more_is_not_begun() {
        let task = PlanTask::new(|| -> u32 { unreachable!("begun") });
        let request = task.request().unwrap();
        drop(task);
        request.solve();
    }
}
