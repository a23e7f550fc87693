//! Long work that continues whether or not a client waits for it, kept in memory with its result.

use crate::progress::WorkProgress;
use crate::shares::part;
use sinew_wire::convert::names::OPERATION;
use sinew_wire::status::Fault;
use std::collections::BTreeMap;
use std::future::Future;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, SystemTime};
use tokio::sync::watch;
use tokio::task::AbortHandle;

/// Progress of an operation.
#[derive(Debug)]
pub enum OperationState<T> {
    /// It waits for its turn or is being worked on.
    Going,
    /// It has ended.
    Ended {
        /// End time.
        at: SystemTime,
        /// The result; `None`: it was given up.
        outcome: Option<Result<Arc<T>, Fault>>,
        /// Bytes of the result.
        bytes: u64,
    },
}

// A derived `Clone` would require the result to be `Clone`, too.
impl<T> Clone for OperationState<T> {
    fn clone(&self) -> Self {
        match self {
            Self::Going => Self::Going,
            Self::Ended { at, outcome, bytes } => Self::Ended {
                at: *at,
                outcome: outcome.clone(),
                bytes: *bytes,
            },
        }
    }
}

/// One operation.
#[derive(Debug)]
pub struct Operation<T> {
    /// Counts up from operation to operation.
    pub number: u64,
    /// Last part of its name.
    pub id: String,
    /// The principal that started it.
    pub principal: Arc<str>,
    /// Creation time.
    pub created: SystemTime,
    /// Progress of its work.
    pub progress: WorkProgress,
    state: watch::Sender<OperationState<T>>,
    work: Mutex<Option<AbortHandle>>,
}

/// All operations.
#[derive(Debug)]
pub struct Operations<T> {
    held: Mutex<HeldOperations<T>>,
    limits: OperationLimits,
}

/// How many operations are kept, and for how long.
#[derive(Clone, Copy, Debug)]
pub struct OperationLimits {
    /// Operations (`max_operations`).
    pub most: u64,
    /// Share of them that one principal may have.
    pub share: f64,
    /// Bytes of results (`max_operation_bytes`).
    pub bytes: u64,
    /// How long an operation that has ended is kept.
    pub ttl: Duration,
}

#[derive(Debug)]
struct HeldOperations<T> {
    /// By number: oldest first.
    all: BTreeMap<u64, Arc<Operation<T>>>,
    next: u64,
}

impl<T> Operation<T> {
    /// Its progress.
    pub fn state(&self) -> OperationState<T> {
        self.state.borrow().clone()
    }

    /// Whether it has ended.
    pub fn has_ended(&self) -> bool {
        matches!(*self.state.borrow(), OperationState::Ended { .. })
    }

    /// Waits until it has ended.
    pub async fn ended(&self) {
        let ended = |state: &OperationState<T>| matches!(state, OperationState::Ended { .. });
        // The sender lives in this operation.
        let _ = self.state.subscribe().wait_for(ended).await;
    }

    fn bytes(&self) -> u64 {
        match *self.state.borrow() {
            OperationState::Going => 0,
            OperationState::Ended { bytes, .. } => bytes,
        }
    }

    /// Notes the end. Only the first one counts.
    fn end(&self, outcome: Option<Result<T, Fault>>, bytes: u64) {
        self.state.send_if_modified(|state| {
            let going = matches!(state, OperationState::Going);
            if going {
                *state = OperationState::Ended {
                    at: SystemTime::now(),
                    outcome: outcome.map(|o| o.map(Arc::new)),
                    bytes,
                };
            }
            going
        });
    }

    /// Gives the work up, unless it has ended.
    pub fn cancel(&self) {
        self.end(None, 0);
        let work = self.work.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(work) = &*work {
            work.abort(); // the awaited future notices that nothing waits for it any more
        }
    }
}

impl<T: Send + Sync + 'static> Operations<T> {
    /// None yet.
    pub fn new(limits: OperationLimits) -> Arc<Self> {
        let held = HeldOperations {
            all: BTreeMap::new(),
            next: 1,
        };
        Arc::new(Self {
            held: Mutex::new(held),
            limits,
        })
    }

    /// The held operations, without the expired ones.
    fn lock(&self) -> MutexGuard<'_, HeldOperations<T>> {
        // Entries are whole.
        let mut held = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        let now = SystemTime::now();
        held.all.retain(|_, o| match *o.state.borrow() {
            OperationState::Going => true,
            OperationState::Ended { at, .. } => {
                now.duration_since(at).unwrap_or_default() < self.limits.ttl
            }
        });
        held
    }

    /// Starts an operation. `size` returns the number of bytes of its result.
    ///
    /// # Errors
    /// Too many are still running.
    pub fn start<W>(
        self: &Arc<Self>,
        principal: Arc<str>,
        work: impl FnOnce(WorkProgress) -> W,
        size: fn(&T) -> u64,
    ) -> Result<Arc<Operation<T>>, Fault>
    where
        W: Future<Output = Result<T, Fault>> + Send + 'static,
    {
        let mut held = self.lock();
        held.make_room(&self.limits, &principal)?;
        let number = held.next;
        held.next += 1;
        let operation = Arc::new(Operation {
            number,
            id: format!("operation-{number}"),
            principal,
            created: SystemTime::now(),
            progress: WorkProgress::default(),
            state: watch::Sender::new(OperationState::Going),
            work: Mutex::default(),
        });
        held.all.insert(number, operation.clone());
        drop(held);
        let done = work(operation.progress.clone());
        let (all, of) = (self.clone(), operation.clone());
        let task = tokio::spawn(async move {
            let ends = Ends(of);
            let outcome = done.await;
            all.finish(&ends.0, outcome, size);
        });
        *operation
            .work
            .lock()
            .unwrap_or_else(PoisonError::into_inner) = Some(task.abort_handle());
        if operation.has_ended() {
            task.abort(); // it was cancelled before the handle was there
        }
        Ok(operation)
    }

    fn finish(&self, operation: &Operation<T>, outcome: Result<T, Fault>, size: fn(&T) -> u64) {
        let bytes = outcome.as_ref().map_or(0, size);
        let outcome = if bytes > self.limits.bytes {
            Err(Fault::Exhausted {
                limit: "max_operation_bytes",
                value: self.limits.bytes,
                message: format!("a result of {bytes} bytes"),
                retry: None,
            })
        } else {
            outcome
        };
        let mut held = self.lock();
        let outcome = outcome.and_then(|done| {
            held.free(&operation.principal, bytes, self.limits.bytes)?;
            Ok(done)
        });
        let bytes = if outcome.is_ok() { bytes } else { 0 };
        operation.end(Some(outcome), bytes);
    }

    /// An operation of a principal.
    ///
    /// # Errors
    /// It has none of that name.
    pub fn get(&self, principal: &str, id: &str) -> Result<Arc<Operation<T>>, Fault> {
        let held = self.lock();
        let mut mine = held.all.values().filter(|o| *o.principal == *principal);
        let found = mine.find(|o| o.id == id).cloned();
        found.ok_or_else(|| Fault::not_found("operation", OPERATION.name([id])))
    }

    /// Those of a principal, in the order in which they were started.
    pub fn list(&self, principal: &str) -> Vec<Arc<Operation<T>>> {
        let held = self.lock();
        let mine = held.all.values().filter(|o| *o.principal == *principal);
        mine.cloned().collect()
    }

    /// Forgets an operation that has ended.
    ///
    /// # Errors
    /// There is none of that name, or it is still running.
    pub fn delete(&self, principal: &str, id: &str) -> Result<(), Fault> {
        let operation = self.get(principal, id)?;
        if !operation.has_ended() {
            return Err(Fault::Precondition {
                reason: "OPERATION_RUNNING",
                message: format!("operation {id:?} goes on: cancel it first"),
                facts: vec![],
            });
        }
        self.lock().all.remove(&operation.number);
        Ok(())
    }
}

impl<T> HeldOperations<T> {
    /// Makes room for one more operation of a principal by forgetting the oldest that have ended.
    fn make_room(&mut self, limits: &OperationLimits, principal: &str) -> Result<(), Fault> {
        let own = part(limits.most, limits.share);
        for (most, whose) in [(own, Some(principal)), (limits.most, None)] {
            let is_theirs = |o: &Operation<T>| whose.is_none_or(|p| *o.principal == *p);
            while self.all.values().filter(|o| is_theirs(o)).count() as u64 >= most {
                let mut theirs = self.all.iter().filter(|(_, o)| is_theirs(o));
                let oldest = theirs.find(|(_, o)| o.has_ended()).map(|(n, _)| *n);
                let Some(oldest) = oldest else {
                    return Err(Fault::Exhausted {
                        limit: "max_operations",
                        value: limits.most,
                        message: "one more operation; those that go on are as many as there may be"
                            .into(),
                        retry: Some(Duration::from_secs(1)),
                    });
                };
                self.all.remove(&oldest);
            }
        }
        Ok(())
    }

    /// Makes room for a number of bytes of a principal. The oldest result of the principal with the most bytes is
    /// always forgotten first, counting the new one. So no principal loses a result within an equal share of all.
    fn free(&mut self, principal: &Arc<str>, bytes: u64, most: u64) -> Result<(), Fault> {
        let mut used = BTreeMap::from([(principal.clone(), bytes)]);
        for o in self.all.values() {
            *used.entry(o.principal.clone()).or_default() += o.bytes();
        }
        while used.values().sum::<u64>() > most {
            // Among principals with equal bytes, the one that needs the room.
            let all = used.iter_mut();
            let largest = all.max_by_key(|(p, used)| (**used, *p == principal));
            let oldest = largest.and_then(|(whose, used)| {
                let theirs = |o: &Operation<T>| o.principal == *whose && o.bytes() > 0;
                let (n, o) = self.all.iter().find(|(_, o)| theirs(o))?;
                *used -= o.bytes();
                Some(*n)
            });
            let Some(oldest) = oldest else {
                return Err(Fault::Exhausted {
                    limit: "max_operation_bytes",
                    value: most,
                    message: format!(
                        "a result of {bytes} bytes; others have as much as their share"
                    ),
                    retry: Some(Duration::from_secs(1)),
                });
            };
            self.all.remove(&oldest);
        }
        Ok(())
    }
}

/// Ends an operation whose work has panicked.
struct Ends<T>(Arc<Operation<T>>);

impl<T> Drop for Ends<T> {
    fn drop(&mut self) {
        // One that was cancelled has ended already.
        let abnormal = Fault::Internal("the operation ended abnormally".into());
        self.0.end(Some(Err(abnormal)), 0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicBool, Ordering};
    use tokio::sync::Notify;

    fn all(most: u64, bytes: u64) -> Arc<Operations<String>> {
        Operations::new(OperationLimits {
            most,
            share: 0.5,
            bytes,
            ttl: Duration::from_secs(60),
        })
    }

    #[allow(clippy::ptr_arg, reason = "what operations of texts are measured with")]
    fn size(text: &String) -> u64 {
        text.len() as u64
    }

    fn outcome(o: &Operation<String>) -> Option<Result<String, Fault>> {
        match o.state() {
            OperationState::Going => panic!("it goes on"),
            OperationState::Ended { outcome, .. } => outcome.map(|o| o.map(|text| (*text).clone())),
        }
    }

    #[tokio::test]
    async fn an_operation_ends_with_what_came_of_it() {
        let all = all(8, 100);
        let text = |_: WorkProgress| async { Ok("done".to_owned()) };
        let o = all.start("ann".into(), text, size).unwrap();
        o.ended().await;
        assert_eq!(outcome(&o), Some(Ok("done".into())));
        let refused = |_: WorkProgress| async { Err(Fault::invalid("bvh.data", "is empty")) };
        let o = all.start("ann".into(), refused, size).unwrap();
        o.ended().await;
        assert_eq!(outcome(&o).unwrap().unwrap_err().reason(), "INVALID_FIELD");
        let broken = |_: WorkProgress| async { panic!("on purpose") };
        let o = all.start("ann".into(), broken, size).unwrap();
        o.ended().await;
        assert_eq!(outcome(&o).unwrap().unwrap_err().reason(), "INTERNAL");
    }

    #[tokio::test]
    async fn one_that_is_cancelled_is_given_up() {
        struct Dropped(Arc<AtomicBool>);
        impl Drop for Dropped {
            fn drop(&mut self) {
                self.0.store(true, Ordering::SeqCst);
            }
        }
        let all = all(8, 100);
        let (gone, begun) = (Arc::new(AtomicBool::new(false)), Arc::new(Notify::new()));
        let (watched, told) = (gone.clone(), begun.clone());
        let work = |_: WorkProgress| async move {
            let _dropped = Dropped(watched);
            told.notify_one();
            std::future::pending::<Result<String, Fault>>().await
        };
        let o = all.start("ann".into(), work, size).unwrap();
        begun.notified().await;
        assert!(all.delete("ann", &o.id).is_err(), "it goes on");
        o.cancel();
        o.ended().await;
        assert_eq!(outcome(&o), None);
        while !gone.load(Ordering::SeqCst) {
            tokio::task::yield_now().await;
        }
        o.cancel(); // again: nothing happens
        all.delete("ann", &o.id).unwrap();
        assert!(all.get("ann", &o.id).is_err());
    }

    #[tokio::test]
    async fn nobody_sees_those_of_others_or_fills_their_room() {
        let all = all(8, 100);
        let text = |_: WorkProgress| async { Ok("done".to_owned()) };
        let bobs = all.start("bob".into(), text, size).unwrap();
        bobs.ended().await;
        let endless = |_: WorkProgress| std::future::pending::<Result<String, Fault>>();
        for _ in 0..4 {
            all.start("ann".into(), endless, size).unwrap();
        }
        let refused = all.start("ann".into(), endless, size).unwrap_err();
        assert_eq!(refused.reason(), "LIMIT_REACHED");
        assert!(all.get("ann", &bobs.id).is_err());
        assert!(all.delete("ann", &bobs.id).is_err());
        assert_eq!(all.list("ann").len(), 4);
        // The oldest one that has ended makes room.
        for _ in 0..6 {
            let o = all.start("bob".into(), text, size).unwrap();
            o.ended().await;
        }
        assert_eq!(all.list("bob").len(), 4);
        assert!(all.get("bob", &bobs.id).is_err());
    }

    #[tokio::test]
    async fn who_has_the_most_makes_room() {
        let all = all(64, 100);
        let text = |n: usize| move |_: WorkProgress| async move { Ok("x".repeat(n)) };
        let start = async |who: &str, n: usize| {
            let o = all.start(who.into(), text(n), size).unwrap();
            o.ended().await;
            o
        };
        let bobs = start("bob", 10).await;
        // However many results one principal has, those of another are kept.
        for _ in 0..20 {
            start("ann", 30).await;
        }
        assert!(all.get("bob", &bobs.id).is_ok());
        assert_eq!(all.list("ann").len(), 3);
        // Beyond a fair share it is displaced: bob's are more than half of all in the end.
        for _ in 0..4 {
            start("bob", 15).await;
        }
        assert_eq!((all.list("ann").len(), all.list("bob").len()), (1, 5));
        // A result is refused if it fits neither in its own share nor in the excess of others over theirs.
        let large = start("ann", 71).await;
        assert_eq!(
            outcome(&large).unwrap().unwrap_err().reason(),
            "LIMIT_REACHED"
        );
        assert_eq!(all.list("bob").len(), 5);
    }

    #[tokio::test]
    async fn results_are_bounded_by_their_bytes() {
        let all = all(64, 100);
        let text = |n: usize| move |_: WorkProgress| async move { Ok("x".repeat(n)) };
        let large = all.start("ann".into(), text(101), size).unwrap();
        large.ended().await;
        assert_eq!(
            outcome(&large).unwrap().unwrap_err().reason(),
            "LIMIT_REACHED"
        );
        for _ in 0..10 {
            let o = all.start("ann".into(), text(40), size).unwrap();
            o.ended().await;
            let held: u64 = all.list("ann").iter().map(|o| o.bytes()).sum();
            assert!(held <= 100, "{held}");
        }
    }
}
