//! Repeats of requests (AIP-155): a client that does not know whether its request arrived sends it again under the same
//! `request_id` and gets the answer to the first.
//!
//! The work of a request runs in a task of its own, so that it is completed whether or not its client waits. A repeat
//! that arrives in the meantime waits for that task. Answers are kept for some time. Refused requests have changed
//! nothing and are forgotten, so that a repeat is a new attempt.

use crate::shares::part;
use bytes::Bytes;
use sinew_wire::status::Fault;
use std::collections::{HashMap, VecDeque};
use std::future::Future;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::watch;

/// How long an answer is kept.
const KEPT: Duration = Duration::from_secs(600);
/// Most bytes of all kept answers, and of those of one principal.
const BYTES: (usize, usize) = (32 * 1024 * 1024, 16 * 1024 * 1024);
/// Names of forgotten requests that a principal may have in its queue, in addition to its number of requests.
const SPARE: usize = 16;

/// The key of a request.
#[derive(Clone, Debug)]
pub struct RequestKey {
    /// Its principal.
    pub principal: Arc<str>,
    /// Its call.
    pub call: Arc<str>,
    /// Its `request_id`.
    pub id: String,
}

/// The outcome of a request; `None` while it is being worked on.
type RepeatOutcome = Option<Result<Bytes, Fault>>;

#[derive(Debug)]
struct RepeatEntry {
    /// Tells this entry from later ones of the same key.
    number: u64,
    /// Hash of the request: a different request must not have its name.
    request: u64,
    since: Instant,
    bytes: usize,
    outcome: watch::Receiver<RepeatOutcome>,
}

/// Call and id of a request of one principal.
type Name = (Arc<str>, String);

/// Requests of one principal.
#[derive(Debug, Default)]
struct Own {
    entries: HashMap<Name, RepeatEntry>,
    /// Oldest first. Names that are no longer in `entries` under their number are skipped.
    order: VecDeque<(u64, Name)>,
    bytes: usize,
}

#[derive(Debug, Default)]
struct HeldAnswers {
    of: HashMap<Arc<str>, Own>,
    count: usize,
    bytes: usize,
    next: u64,
}

/// Recent requests with their answers.
#[derive(Debug)]
pub struct Repeats {
    held: Mutex<HeldAnswers>,
    most: usize,
    most_of_one: usize,
}

impl Own {
    fn remove(&mut self, name: &Name) -> Option<RepeatEntry> {
        let entry = self.entries.remove(name)?;
        self.bytes -= entry.bytes;
        Some(entry)
    }

    /// Forgets the oldest request, if it is from before `since`; `None`: whatever its age.
    fn forget_oldest(&mut self, since: Option<Instant>) -> Option<RepeatEntry> {
        while let Some((number, name)) = self.order.front() {
            match self.entries.get(name).filter(|e| e.number == *number) {
                Some(entry) if since.is_some_and(|since| entry.since >= since) => return None,
                found => {
                    let live = found.is_some();
                    let (_, name) = self.order.pop_front()?;
                    if live {
                        return self.remove(&name);
                    }
                }
            }
        }
        None
    }
}

impl HeldAnswers {
    fn count_off(&mut self, gone: &RepeatEntry) {
        self.count -= 1;
        self.bytes -= gone.bytes;
    }

    fn remove(&mut self, principal: &Arc<str>, name: &Name) {
        if let Some(gone) = self.of.get_mut(principal).and_then(|own| own.remove(name)) {
            self.count_off(&gone);
        }
    }

    /// Forgets expired requests of a principal, and its oldest ones until it has no more than its part.
    fn trim(&mut self, principal: &Arc<str>, now: Instant, most: usize) {
        let since = now.checked_sub(KEPT);
        while let Some(own) = self.of.get_mut(principal) {
            let over = own.entries.len() > most || own.bytes > BYTES.1;
            let gone = match (over, since) {
                (true, _) => own.forget_oldest(None),
                (false, Some(since)) => own.forget_oldest(Some(since)),
                (false, None) => None,
            };
            let Some(gone) = gone else { break };
            self.count_off(&gone);
        }
    }

    /// Forgets the oldest requests of the principals with the most, until there is room again.
    fn make_room(&mut self, most: usize) {
        while self.count > most || self.bytes > BYTES.0 {
            let by_count = self.count > most;
            let all = self.of.values_mut();
            let largest = all.max_by_key(|own| {
                if by_count {
                    own.entries.len()
                } else {
                    own.bytes
                }
            });
            let Some(gone) = largest.and_then(|own| own.forget_oldest(None)) else {
                break;
            };
            self.count_off(&gone);
        }
        self.of.retain(|_, own| !own.entries.is_empty());
    }
}

/// Puts the outcome into its entry, even if the work ended abnormally.
struct OutcomeGuard {
    repeats: Arc<Repeats>,
    key: RequestKey,
    number: u64,
    tell: watch::Sender<RepeatOutcome>,
}

impl OutcomeGuard {
    fn done(self, result: Result<Bytes, Fault>) {
        self.repeats.settle(&self.key, self.number, &result);
        self.tell.send_replace(Some(result));
    }
}

impl Drop for OutcomeGuard {
    fn drop(&mut self) {
        if self.tell.borrow().is_none() {
            let lost = Err(Fault::Internal("the request ended abnormally".into()));
            self.repeats.settle(&self.key, self.number, &lost);
        }
    }
}

impl Repeats {
    /// Keeps `most` answers, as `max_request_ids` says, of which one principal has a `share`.
    pub fn new(most: u64, share: f64) -> Arc<Self> {
        Arc::new(Self {
            held: Mutex::default(),
            most: most as usize,
            most_of_one: part(most, share) as usize,
        })
    }

    fn lock(&self) -> MutexGuard<'_, HeldAnswers> {
        // Entries are whole.
        self.held.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Keeps an answer; forgets a refused request.
    fn settle(&self, key: &RequestKey, number: u64, result: &Result<Bytes, Fault>) {
        let held = &mut *self.lock();
        let name = (key.call.clone(), key.id.clone());
        let Some(own) = held.of.get_mut(&key.principal) else {
            return;
        };
        let Some(entry) = own.entries.get_mut(&name).filter(|e| e.number == number) else {
            return;
        };
        match result {
            Ok(answer) => {
                entry.bytes = answer.len();
                own.bytes += answer.len();
                held.bytes += answer.len();
                held.trim(&key.principal, Instant::now(), self.most_of_one);
                held.make_room(self.most);
            }
            Err(_) => {
                held.remove(&key.principal, &name);
                held.make_room(self.most);
            }
        }
    }

    /// The answer to a request, which is done once however often it arrives. `request` is its hash.
    ///
    /// # Errors
    /// Same as those of the work; or a different request has the same name.
    pub async fn once(
        self: &Arc<Self>,
        key: RequestKey,
        request: u64,
        work: impl Future<Output = Result<Bytes, Fault>> + Send + 'static,
    ) -> Result<Bytes, Fault> {
        let mut outcome = self.enter(key, request, work)?;
        let settled = outcome.wait_for(Option::is_some).await;
        let result = settled.ok().and_then(|o| o.clone());
        result.unwrap_or_else(|| Err(Fault::Internal("the request ended abnormally".into())))
    }

    fn enter(
        self: &Arc<Self>,
        key: RequestKey,
        request: u64,
        work: impl Future<Output = Result<Bytes, Fault>> + Send + 'static,
    ) -> Result<watch::Receiver<RepeatOutcome>, Fault> {
        let now = Instant::now();
        let mut lock = self.lock();
        let held = &mut *lock;
        let name = (key.call.clone(), key.id.clone());
        held.trim(&key.principal, now, self.most_of_one);
        let own = held.of.entry(key.principal.clone()).or_default();
        if let Some(entry) = own.entries.get(&name) {
            if entry.request == request {
                return Ok(entry.outcome.clone());
            }
            return Err(Fault::Precondition {
                reason: "REQUEST_ID_REUSED",
                message: format!(
                    "request_id {:?} was given to another request of {}",
                    key.id, key.call
                ),
                facts: vec![("field", "request_id".to_owned())],
            });
        }
        let number = held.next;
        held.next += 1;
        held.count += 1;
        let (tell, outcome) = watch::channel(None);
        let entry = RepeatEntry {
            number,
            request,
            since: now,
            bytes: 0,
            outcome: outcome.clone(),
        };
        own.entries.insert(name.clone(), entry);
        own.order.push_back((number, name));
        if own.order.len() > 2 * own.entries.len() + SPARE {
            // Names of requests that were refused in the meantime.
            let live =
                |(n, name): &(u64, Name)| own.entries.get(name).is_some_and(|e| e.number == *n);
            own.order.retain(live);
        }
        held.trim(&key.principal, now, self.most_of_one);
        held.make_room(self.most);
        drop(lock);
        let report = OutcomeGuard {
            repeats: self.clone(),
            key,
            number,
            tell,
        };
        tokio::spawn(async move { report.done(work.await) });
        Ok(outcome)
    }
}

/// Runs work in a task of its own, so that it is completed once begun, whether or not its client waits.
///
/// # Errors
/// Same as those of the work; or it ended abnormally.
pub async fn to_the_end<T: Send + 'static>(
    work: impl Future<Output = Result<T, Fault>> + Send + 'static,
) -> Result<T, Fault> {
    let done = tokio::spawn(work).await;
    done.unwrap_or_else(|_| Err(Fault::Internal("the request ended abnormally".into())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicU32, Ordering};
    use tokio::sync::Notify;

    fn key(principal: &str, id: &str) -> RequestKey {
        RequestKey {
            principal: principal.into(),
            call: "Create".into(),
            id: id.into(),
        }
    }

    /// Counts how often it runs.
    fn work(
        count: &Arc<AtomicU32>,
        result: Result<&'static str, Fault>,
    ) -> impl Future<Output = Result<Bytes, Fault>> + Send + 'static + use<> {
        let count = count.clone();
        async move {
            count.fetch_add(1, Ordering::SeqCst);
            result.map(|r| Bytes::from_static(r.as_bytes()))
        }
    }

    #[tokio::test]
    async fn a_repeat_gets_the_answer_of_the_first() {
        let repeats = Repeats::new(100, 1.0);
        let count = Arc::default();
        for _ in 0..3 {
            let answer = repeats
                .once(key("ann", "1"), 7, work(&count, Ok("a")))
                .await;
            assert_eq!(answer.unwrap(), "a");
        }
        assert_eq!(count.load(Ordering::SeqCst), 1);
        // The same id of another principal, and of another call.
        for other in [key("bob", "1"), key("ann", "2")] {
            repeats.once(other, 7, work(&count, Ok("b"))).await.unwrap();
        }
        assert_eq!(count.load(Ordering::SeqCst), 3);
        let reused = repeats
            .once(key("ann", "1"), 8, work(&count, Ok("c")))
            .await;
        assert_eq!(reused.unwrap_err().reason(), "REQUEST_ID_REUSED");
    }

    #[tokio::test]
    async fn what_was_refused_is_tried_again() {
        let repeats = Repeats::new(100, 1.0);
        let count = Arc::default();
        let refused = Fault::invalid("speed", "is too high");
        let first = repeats
            .once(key("ann", "1"), 7, work(&count, Err(refused)))
            .await;
        assert!(first.is_err());
        assert_eq!(repeats.lock().count, 0);
        for i in 0..100 {
            let refused = Fault::invalid("speed", "is too high");
            let id = key("ann", &i.to_string());
            let _ = repeats.once(id, 7, work(&count, Err(refused))).await;
            let held = repeats.lock();
            let queued: usize = held.of.values().map(|own| own.order.len()).sum();
            assert!(
                queued <= SPARE + 3,
                "{queued} of requests that are forgotten"
            );
        }
        let second = repeats
            .once(key("ann", "1"), 7, work(&count, Ok("a")))
            .await;
        assert_eq!(second.unwrap(), "a");
    }

    #[tokio::test]
    async fn repeats_wait_for_the_first_also_when_its_client_is_gone() {
        let repeats = Repeats::new(100, 1.0);
        let (go, count) = (Arc::new(Notify::new()), Arc::<AtomicU32>::default());
        let slow = |repeats: Arc<Repeats>| {
            let (go, inner) = (go.clone(), work(&count, Ok("a")));
            let waits = async move {
                go.notified().await;
                inner.await
            };
            async move { repeats.once(key("ann", "1"), 7, waits).await }
        };
        let first = tokio::spawn(slow(repeats.clone()));
        while repeats.lock().count == 0 {
            tokio::task::yield_now().await;
        }
        first.abort();
        assert!(first.await.unwrap_err().is_cancelled());
        let repeat = tokio::spawn(slow(repeats.clone()));
        tokio::task::yield_now().await;
        go.notify_waiters();
        go.notify_one();
        assert_eq!(repeat.await.unwrap().unwrap(), "a");
        assert_eq!(count.load(Ordering::SeqCst), 1);
    }

    #[tokio::test]
    async fn what_has_begun_is_done_without_its_client() {
        let (go, count) = (Arc::new(Notify::new()), Arc::<AtomicU32>::default());
        let (waits, inner) = (go.clone(), work(&count, Ok("a")));
        let client = tokio::spawn(to_the_end(async move {
            waits.notified().await;
            inner.await
        }));
        tokio::task::yield_now().await;
        client.abort();
        assert!(client.await.unwrap_err().is_cancelled());
        go.notify_one();
        while count.load(Ordering::SeqCst) == 0 {
            tokio::task::yield_now().await;
        }
        let broken = to_the_end(async { panic!("on purpose") });
        let broken: Result<(), Fault> = broken.await;
        assert_eq!(broken.unwrap_err().reason(), "INTERNAL");
    }

    #[tokio::test]
    async fn work_that_panics_is_told_and_forgotten() {
        let repeats = Repeats::new(100, 1.0);
        let broken = repeats.once(key("ann", "1"), 7, async { panic!("on purpose") });
        assert_eq!(broken.await.unwrap_err().reason(), "INTERNAL");
        assert_eq!(repeats.lock().count, 0);
    }

    #[tokio::test]
    async fn one_principal_pushes_out_only_its_own_answers() {
        let repeats = Repeats::new(8, 0.5);
        let count = Arc::default();
        repeats
            .once(key("bob", "b"), 7, work(&count, Ok("b")))
            .await
            .unwrap();
        for i in 0..20 {
            let mine = key("ann", &i.to_string());
            repeats.once(mine, 7, work(&count, Ok("a"))).await.unwrap();
            let held = repeats.lock();
            let queued: usize = held.of.values().map(|own| own.order.len()).sum();
            assert!(held.count <= 5 && queued <= 6, "{held:?}");
        }
        let before = count.load(Ordering::SeqCst);
        repeats
            .once(key("bob", "b"), 7, work(&count, Ok("b")))
            .await
            .unwrap();
        repeats
            .once(key("ann", "19"), 7, work(&count, Ok("a")))
            .await
            .unwrap();
        assert_eq!(count.load(Ordering::SeqCst), before, "both are still known");
        repeats
            .once(key("ann", "0"), 7, work(&count, Ok("a")))
            .await
            .unwrap();
        assert_eq!(
            count.load(Ordering::SeqCst),
            before + 1,
            "this one is forgotten"
        );
    }

    #[tokio::test]
    async fn large_answers_are_bounded_by_their_bytes() {
        let repeats = Repeats::new(1000, 1.0);
        for i in 0..20 {
            let large = async { Ok(Bytes::from(vec![0; 4 * 1024 * 1024])) };
            repeats
                .once(key("ann", &i.to_string()), 7, large)
                .await
                .unwrap();
            let used = repeats.lock().bytes;
            assert!(used <= BYTES.1, "{used}");
        }
    }
}
