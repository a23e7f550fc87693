//! Work that takes long: converting files to clips, and offline simulations. Each kind has its own few workers, off the
//! async threads, and is given up soon after its client is gone.
//!
//! Clients share the workers of a pool. The client with the least work running is next. If a client has more running
//! than a waiting one, its work makes room at its next [`Turn::stop`] and continues later. So no client waits for the
//! end of another client's work.
//!
//! Work that takes much memory declares that in advance. It begins when there is room for it beside other such work.

use crate::shares::ClientKey;
use sinew_wire::status::Fault;
use std::any::Any;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::oneshot;

/// How long work runs before it makes room for that of another client.
const SLICE: Duration = Duration::from_millis(100);
/// Most pieces of work per worker that may have begun: each holds a thread and its data, even while others have their
/// turns.
const BEGUN: usize = 8;
/// Bytes of all work that has begun, as declared. A single piece of work may take more, alone.
const MEMORY: u64 = 512 * 1024 * 1024;
/// Work that takes no more than this is not counted, because little of it has begun at a time.
const LITTLE: u64 = 8 * 1024 * 1024;
/// Weight of the latest duration in the mean.
const RECENT: f64 = 0.2;
/// Least and most time after which a client is told to try again, s.
const RETRY: (f64, f64) = (0.1, 30.0);
/// Niceness of the threads: threads with a clock come first.
#[cfg(target_os = "linux")]
const NICE: i32 = 10;

/// The workers for one kind of work.
#[derive(Clone, Debug)]
pub struct Pool(Arc<PoolShared>);

#[derive(Debug)]
struct PoolShared {
    what: &'static str,
    limit: &'static str,
    most: usize,
    most_waiting: u64,
    state: Mutex<PoolState>,
}

#[derive(Debug, Default)]
struct PoolState {
    running: usize,
    /// Pieces of work that have begun and have not ended.
    begun: usize,
    /// Bytes that they take.
    memory: u64,
    clients: BTreeMap<ClientKey, PoolUse>,
    waiting: Vec<Waiter>,
    turns: u64,
    /// Whether the server is ending: no work is begun or finished any more.
    closed: bool,
    /// Mean time that a piece of work takes, s.
    mean: f64,
}

/// The part of a pool that one client has.
#[derive(Debug, Default)]
struct PoolUse {
    running: usize,
    waiting: usize,
    /// Number of its last turn.
    turn: u64,
}

#[derive(Debug)]
struct Waiter {
    client: ClientKey,
    cancelled: Cancelled,
    /// Whether it had a turn before, so that its place in the queue is not counted.
    begun: bool,
    /// Bytes that it takes, if they are many.
    memory: u64,
    grant: oneshot::Sender<Turn>,
}

/// Tells the work that no client waits for it any more.
#[derive(Clone, Debug, Default)]
struct Cancelled(Arc<AtomicBool>);

impl Cancelled {
    fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

struct CancelOnDrop(Pool, Cancelled);
impl Drop for CancelOnDrop {
    fn drop(&mut self) {
        self.1.0.store(true, Ordering::Relaxed);
        self.0.state().grant(&self.0);
    }
}

/// The right to work, for a while.
#[derive(Debug)]
pub struct Turn {
    pool: Pool,
    client: ClientKey,
    cancelled: Cancelled,
    since: Cell<Instant>,
    /// Whether it occupies a worker.
    works: Cell<bool>,
    memory: u64,
    /// Whether another turn of the same work stands for this one, or it never got to its work.
    replaced: Cell<bool>,
}

impl Drop for Turn {
    fn drop(&mut self) {
        if self.replaced.get() {
            return;
        }
        // The work is done, or was given up while others had their turns.
        let mut state = self.pool.state();
        state.begun -= 1;
        state.memory -= self.memory;
        if self.works.get() {
            state.leave(&self.client);
        }
        state.grant(&self.pool);
    }
}

impl Turn {
    /// Whether the work has to be given up. Work calls this often; a call may take as long as the turns of others.
    pub fn stop(&self) -> bool {
        if self.cancelled.is_set() {
            return true;
        }
        if self.since.get().elapsed() < SLICE {
            return false;
        }
        self.since.set(Instant::now());
        let Some(next) = self.make_room() else {
            return self.pool.state().closed;
        };
        let Ok(turn) = next.blocking_recv() else {
            return true; // only cancelled work waits in vain
        };
        turn.replaced.set(true); // this turn continues instead
        self.works.set(true);
        self.since.set(Instant::now());
        self.cancelled.is_set()
    }

    /// Whether another client's work cannot begin because too much has begun.
    pub fn is_wanted(&self) -> bool {
        let state = self.pool.state();
        let mut new = state.waiting.iter().filter(|w| !w.begun);
        state.begun >= BEGUN * self.pool.0.most
            && new.any(|w| w.client != self.client && !w.cancelled.is_set())
    }

    /// Gives the worker to a waiting client with less running work, if there is one. Returns the next turn of this
    /// work.
    fn make_room(&self) -> Option<oneshot::Receiver<Turn>> {
        let mut state = self.pool.state();
        let mine = state.running_of(&self.client);
        let owed = state.waiting.iter().any(|w| {
            w.client != self.client
                && !w.cancelled.is_set()
                && state.may_go_on(w, &self.pool)
                && state.running_of(&w.client) < mine
        });
        if !owed {
            return None;
        }
        self.works.set(false);
        let next = state.wait(&self.client, &self.cancelled, (true, self.memory));
        state.leave(&self.client);
        state.grant(&self.pool);
        Some(next)
    }

    /// The fault of work that was given up.
    pub fn gone() -> Fault {
        Fault::Aborted {
            reason: "CANCELLED",
            message: "the client is gone".into(),
        }
    }
}

impl PoolState {
    fn running_of(&self, client: &ClientKey) -> usize {
        self.clients.get(client).map_or(0, |u| u.running)
    }

    fn wait(
        &mut self,
        client: &ClientKey,
        cancelled: &Cancelled,
        (begun, memory): (bool, u64),
    ) -> oneshot::Receiver<Turn> {
        let (grant, granted) = oneshot::channel();
        self.clients.entry(client.clone()).or_default().waiting += 1;
        self.waiting.push(Waiter {
            client: client.clone(),
            cancelled: cancelled.clone(),
            begun,
            memory,
            grant,
        });
        granted
    }

    fn leave(&mut self, client: &ClientKey) {
        self.running -= 1;
        if let Some(used) = self.clients.get_mut(client) {
            used.running -= 1;
        }
    }

    /// Whether work may run. New work must not begin while too much has begun, in number or in bytes.
    fn may_go_on(&self, waiter: &Waiter, pool: &Pool) -> bool {
        let fits = waiter.memory == 0
            || self.memory == 0
            || self.memory.saturating_add(waiter.memory) <= MEMORY;
        waiter.begun || self.begun < BEGUN * pool.0.most && fits
    }

    /// The next work to begin among that which takes much memory: no other such work goes before it.
    fn next_large(&self) -> Option<usize> {
        let all = self.waiting.iter().enumerate();
        let large = all.filter(|(_, w)| !w.begun && w.memory > 0);
        let next = large.min_by_key(|(_, w)| (self.running_of(&w.client), self.turn_of(&w.client)));
        next.map(|(i, _)| i)
    }

    fn turn_of(&self, client: &ClientKey) -> u64 {
        self.clients.get(client).map_or(0, |u| u.turn)
    }

    /// Gives free workers to waiting work: first to the client with the least work running, then to the client whose
    /// last turn is longest ago. A client's begun work continues before more of it begins; otherwise the order is that
    /// of arrival.
    fn grant(&mut self, pool: &Pool) {
        for w in self.waiting.extract_if(.., |w| w.cancelled.is_set()) {
            if let Some(used) = self.clients.get_mut(&w.client) {
                used.waiting -= 1;
            }
        }
        while self.running < pool.0.most {
            let large = self.next_large();
            let all = self.waiting.iter().enumerate();
            let next = all
                .filter(|(_, w)| self.may_go_on(w, pool))
                .filter(|(i, w)| w.begun || w.memory == 0 || large == Some(*i))
                .min_by_key(|(_, w)| {
                    let used = &self.clients[&w.client];
                    (used.running, used.turn, !w.begun)
                });
            let Some((next, _)) = next else { break };
            let waiter = self.waiting.remove(next);
            let used = self.clients.entry(waiter.client.clone()).or_default();
            used.waiting -= 1;
            let turn = Turn {
                pool: pool.clone(),
                client: waiter.client,
                cancelled: waiter.cancelled,
                since: Cell::new(Instant::now()),
                works: Cell::new(true),
                memory: waiter.memory,
                replaced: Cell::new(false),
            };
            match waiter.grant.send(turn) {
                Ok(()) => {
                    self.turns += 1;
                    used.running += 1;
                    used.turn = self.turns;
                    self.running += 1;
                    if !waiter.begun {
                        self.begun += 1;
                        self.memory += waiter.memory;
                    }
                }
                // The work was cancelled; the turn must not give back what it never got.
                Err(turn) => turn.replaced.set(true),
            }
        }
        self.clients.retain(|_, u| u.running + u.waiting > 0);
    }
}

impl Pool {
    /// `most` run at a time, and `most_waiting` wait. `limit` is the setting that bounds the latter, `what` the name of
    /// one piece of work.
    pub fn new(what: &'static str, limit: &'static str, most: u64, most_waiting: u64) -> Self {
        Self(Arc::new(PoolShared {
            what,
            limit,
            most: most as usize,
            most_waiting,
            state: Mutex::default(),
        }))
    }

    fn state(&self) -> MutexGuard<'_, PoolState> {
        // No change is left half done by a panic.
        self.0.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Pieces of work that are being done.
    pub fn running(&self) -> usize {
        self.state().running
    }

    /// Queues work. One client has at most half of the places.
    fn queue(
        &self,
        client: &ClientKey,
        cancelled: &Cancelled,
        memory: u64,
    ) -> Result<oneshot::Receiver<Turn>, Fault> {
        let mut state = self.state();
        if state.closed {
            return Err(Fault::Draining);
        }
        let new = state.waiting.iter().filter(|w| !w.begun);
        let own = new.clone().filter(|w| w.client == *client).count() as u64;
        let all = new.count() as u64;
        let busy = state.running >= self.0.most || all > 0;
        if busy && (all >= self.0.most_waiting || own >= self.0.most_waiting.div_ceil(2)) {
            let turns = (all + 1) as f64 / self.0.most as f64;
            let retry = (state.mean * turns).clamp(RETRY.0, RETRY.1);
            return Err(Fault::Exhausted {
                limit: self.0.limit,
                value: self.0.most_waiting,
                message: format!("one more {}", self.0.what),
                retry: Some(Duration::from_secs_f64(retry)),
            });
        }
        let memory = if memory > LITTLE { memory } else { 0 };
        let granted = state.wait(client, cancelled, (false, memory));
        state.grant(self);
        Ok(granted)
    }

    /// Does long work for a client when its turn comes. The work often asks its turn whether to stop.
    ///
    /// # Errors
    /// Same as those of the work; too much work waits; the work panicked.
    pub async fn run<T: Send + 'static>(
        &self,
        client: &ClientKey,
        work: impl FnOnce(&Turn) -> Result<T, Fault> + Send + 'static,
    ) -> Result<T, Fault> {
        self.run_large(client, 0, work).await
    }

    /// The same for work that takes `memory` bytes.
    ///
    /// # Errors
    /// Those of [`Self::run`].
    pub async fn run_large<T: Send + 'static>(
        &self,
        client: &ClientKey,
        memory: u64,
        work: impl FnOnce(&Turn) -> Result<T, Fault> + Send + 'static,
    ) -> Result<T, Fault> {
        let cancelled = Cancelled::default();
        let granted = self.queue(client, &cancelled, memory)?;
        let _cancel = CancelOnDrop(self.clone(), cancelled);
        let turn = granted.await.map_err(|_| Fault::Draining)?;
        let (done, result) = oneshot::channel();
        let pool = self.clone();
        std::thread::Builder::new()
            .name("worker".into())
            .spawn(move || {
                let begun = Instant::now();
                be_nice();
                let out = catch_unwind(AssertUnwindSafe(|| work(&turn)));
                let out = out.unwrap_or_else(|panic| Err(abnormal(&*panic)));
                pool.took(begun.elapsed());
                drop(turn);
                let _ = done.send(out); // the client may be gone
            })
            .map_err(|e| Fault::Exhausted {
                limit: self.0.limit,
                value: self.0.most as u64,
                message: format!("the system gives no thread for the work: {e}"),
                retry: Some(Duration::from_secs_f64(RETRY.0)),
            })?;
        match result.await {
            Ok(Err(gone)) if gone == Turn::gone() => Err(Fault::Draining), // the pool was closed
            Ok(out) => out,
            Err(_) => Err(Fault::Internal("the work gave no result".into())),
        }
    }

    /// Gives up all work, because the server is ending.
    pub fn close(&self) {
        let mut state = self.state();
        state.closed = true;
        state.waiting.clear();
        for used in state.clients.values_mut() {
            used.waiting = 0;
        }
    }

    fn took(&self, time: Duration) {
        let mut state = self.state();
        state.mean += RECENT * (time.as_secs_f64() - state.mean);
    }
}

fn abnormal(panic: &(dyn Any + Send)) -> Fault {
    let text = panic
        .downcast_ref::<&str>()
        .map(|s| (*s).to_owned())
        .or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_default();
    Fault::Internal(format!("the work ended abnormally: {text}"))
}

/// Lets the threads of worlds go first. Where that is not possible, work competes with them equally.
fn be_nice() {
    #[cfg(target_os = "linux")]
    if let Err(e) = rustix::process::nice(NICE) {
        tracing::debug!("the priority of a worker stays: {e}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::sync_channel;

    fn client(name: &str) -> ClientKey {
        name.into()
    }

    fn pool(most: u64, waiting: u64) -> Pool {
        Pool::new("piece of work", "max_waiting_work", most, waiting)
    }

    /// Work until told to stop or until `ended` is set.
    fn until(ended: Arc<AtomicBool>) -> impl FnOnce(&Turn) -> Result<i32, Fault> {
        move |turn| {
            while !ended.load(Ordering::Relaxed) {
                if turn.stop() {
                    return Err(Turn::gone());
                }
                std::thread::yield_now();
            }
            Ok(0)
        }
    }

    #[tokio::test]
    async fn work_that_panics_or_crowds_is_refused_and_the_rest_goes_on() {
        let pool = pool(1, 0);
        let me = client("me");
        let panicked = pool
            .run(&me, |_| -> Result<(), Fault> { panic!("oh") })
            .await;
        assert!(matches!(panicked, Err(Fault::Internal(_))));
        let (go, wait) = sync_channel::<()>(1);
        let first = pool.run(&me, move |_| {
            wait.recv().ok();
            Ok(1)
        });
        tokio::pin!(first);
        assert!(futures_util::FutureExt::now_or_never(&mut first).is_none());
        let refused = pool.run(&me, |_| Ok(2)).await;
        assert!(matches!(
            refused,
            Err(Fault::Exhausted { retry: Some(_), .. })
        ));
        go.send(()).unwrap();
        assert_eq!(first.await.unwrap(), 1);
        assert_eq!(pool.run(&me, |_| Ok(3)).await.unwrap(), 3);
    }

    #[tokio::test(flavor = "multi_thread")]
    async fn one_client_does_not_wait_for_the_end_of_anothers_work() {
        for most in [1, 2] {
            let pool = pool(most, 64);
            let ended = Arc::new(AtomicBool::new(false));
            let long: Vec<_> = (0..4)
                .map(|_| {
                    let (pool, ended) = (pool.clone(), ended.clone());
                    tokio::spawn(async move { pool.run(&client("greedy"), until(ended)).await })
                })
                .collect();
            while pool.running() < most as usize {
                tokio::task::yield_now().await;
            }
            for n in 0..3 {
                let done = pool.run(&client("other"), move |_| Ok(n)).await;
                assert_eq!(done.unwrap(), n);
            }
            assert!(long.iter().all(|l| !l.is_finished()));
            ended.store(true, Ordering::Relaxed);
            for work in long {
                assert_eq!(work.await.unwrap().unwrap(), 0, "it goes on where it was");
            }
            let state = pool.state();
            assert_eq!((state.running, state.begun), (0, 0));
            assert!(state.clients.is_empty());
        }
    }

    #[tokio::test(flavor = "multi_thread")]
    async fn who_goes_away_frees_the_worker_and_the_queue() {
        let pool = pool(1, 64);
        let never = Arc::new(AtomicBool::new(false));
        let (a, b) = (client("a"), client("b"));
        {
            let running = pool.run(&a, until(never.clone()));
            let waiting = pool.run(&a, until(never.clone()));
            let other = pool.run(&b, until(never.clone()));
            tokio::pin!(running, waiting, other);
            let long = tokio::time::sleep(SLICE * 4); // turns change hands
            tokio::select! {
                _ = &mut running => unreachable!(),
                _ = &mut waiting => unreachable!(),
                _ = &mut other => unreachable!(),
                () = long => {}
            }
            assert_eq!(pool.running(), 1);
        }
        // All three are gone.
        assert_eq!(pool.run(&a, |_| Ok(7)).await.unwrap(), 7);
        // The worker answers first and is free an instant later.
        let busy = || {
            let state = pool.state();
            !state.waiting.is_empty() || (state.running, state.begun) != (0, 0)
        };
        let freed = async {
            while busy() {
                tokio::time::sleep(SLICE).await;
            }
        };
        let freed = tokio::time::timeout(std::time::Duration::from_secs(10), freed);
        freed.await.expect("worker and queue are free");
    }

    #[tokio::test(flavor = "multi_thread")]
    async fn of_much_work_little_has_begun() {
        let pool = pool(1, 200);
        let ended = Arc::new(AtomicBool::new(false));
        let begun = Arc::new(std::sync::atomic::AtomicUsize::new(0));
        let mut all = Vec::new();
        for n in 0..60 {
            let (pool, ended, begun) = (pool.clone(), ended.clone(), begun.clone());
            all.push(tokio::spawn(async move {
                let work = until(ended);
                let counted = move |turn: &Turn| {
                    begun.fetch_add(1, Ordering::Relaxed);
                    work(turn)
                };
                pool.run(&client(&format!("{}", n % 20)), counted).await
            }));
        }
        tokio::time::sleep(SLICE * 20).await;
        assert!(begun.load(Ordering::Relaxed) <= BEGUN);
        ended.store(true, Ordering::Relaxed);
        for work in all {
            assert_eq!(work.await.unwrap().unwrap(), 0);
        }
        assert_eq!(begun.load(Ordering::Relaxed), 60);
    }

    #[tokio::test(flavor = "multi_thread")]
    async fn what_takes_much_memory_waits_for_room_and_the_rest_does_not() {
        let pool = pool(4, 64);
        let ended = Arc::new(AtomicBool::new(false));
        let large = |name: &'static str, memory: u64| {
            let (pool, ended) = (pool.clone(), ended.clone());
            tokio::spawn(async move { pool.run_large(&client(name), memory, until(ended)).await })
        };
        // However large, one piece of work has room alone.
        let first = large("a", 2 * MEMORY);
        while pool.running() < 1 {
            tokio::task::yield_now().await;
        }
        let second = large("b", MEMORY / 2);
        let third = large("c", MEMORY / 2);
        while pool.state().waiting.len() < 2 {
            tokio::task::yield_now().await;
        }
        assert_eq!(
            pool.run_large(&client("d"), LITTLE, |_| Ok(1))
                .await
                .unwrap(),
            1
        );
        assert_eq!(pool.run(&client("e"), |_| Ok(2)).await.unwrap(), 2);
        assert_eq!((pool.running(), pool.state().memory), (1, 2 * MEMORY));
        ended.store(true, Ordering::Relaxed);
        for work in [first, second, third] {
            assert_eq!(work.await.unwrap().unwrap(), 0);
        }
        assert_eq!(pool.state().memory, 0);
    }

    #[tokio::test(flavor = "multi_thread")]
    async fn one_client_cannot_fill_the_queue() {
        let pool = pool(1, 4);
        let never = Arc::new(AtomicBool::new(false));
        let (tx, rx) = sync_channel(16);
        for _ in 0..8 {
            let (pool, never, tx) = (pool.clone(), never.clone(), tx.clone());
            tokio::spawn(async move {
                let out = pool.run(&client("greedy"), until(never)).await;
                let _ = tx.send(out.is_err());
            });
        }
        // One runs and two wait.
        for _ in 0..5 {
            assert!(rx.recv().unwrap());
        }
        assert_eq!(pool.run(&client("other"), |_| Ok(1)).await.unwrap(), 1);
        never.store(true, Ordering::Relaxed);
        for _ in 0..3 {
            assert!(!rx.recv().unwrap());
        }
    }
}
