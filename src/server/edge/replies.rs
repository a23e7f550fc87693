//! Bytes that are being sent, but not yet taken by slow readers.
//!
//! A response is asked for its next part when the connection has room for it. Until then the part before waits in
//! memory, for as long as the client does not read. All parts that wait are counted. When they become too many, the
//! connections whose clients have read nothing for the longest are closed, and no client gets a new part until there is
//! room again.
//!
//! A complete answer ([`super::answers`]) is counted from its completion, less the bytes already sent. A further answer
//! without room is refused, because it would wait in memory.

use super::connections::{Open, Why};
use axum::body::{Body, Bytes};
use http_body::{Body as HttpBody, Frame, SizeHint};
use sinew_wire::status::Fault;
use std::collections::BTreeMap;
use std::pin::Pin;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Context, Poll, ready};
use std::time::Duration;
use tokio::sync::OwnedSemaphorePermit;
use tokio::time::{Instant, Sleep};

/// Time that a reading client may take for a part while others wait for room.
const PATIENCE: Duration = Duration::from_millis(250);
/// Interval at which a response looks for room.
const RETRY: Duration = Duration::from_millis(20);

/// Parts that wait.
#[derive(Debug)]
pub(super) struct Unread {
    /// Times are counted from here.
    start: Instant,
    bytes: AtomicU64,
    /// Bytes of whole answers.
    whole: AtomicU64,
    most: u64,
    next: AtomicU64,
    responses: Mutex<BTreeMap<u64, Arc<Response>>>,
}

/// A response of which a part may wait.
#[derive(Debug)]
struct Response {
    /// Time since which a part waits, ns after the start; [`NOTHING`] if none does.
    since: AtomicU64,
    open: Arc<Open>,
}

/// Marks a response of which nothing waits.
const NOTHING: u64 = u64::MAX;

/// A response that is tracked as long as this lives.
struct ResponseEntry {
    unread: Arc<Unread>,
    number: u64,
    response: Arc<Response>,
}

impl ResponseEntry {
    /// Restarts the time of its waiting part.
    fn touch(&self) {
        let since = self.unread.start.elapsed().as_nanos() as u64;
        self.response.since.store(since, Ordering::Relaxed);
    }
}

impl Drop for ResponseEntry {
    fn drop(&mut self) {
        self.unread.lock().remove(&self.number);
    }
}

/// The part of a response that waits, if one does. It is counted.
struct WaitingPart {
    entry: ResponseEntry,
    bytes: u64,
}

impl WaitingPart {
    /// Notes that a part waits.
    fn waits(&mut self, bytes: u64) {
        self.taken();
        self.bytes = bytes;
        self.entry.unread.bytes.fetch_add(bytes, Ordering::Relaxed);
        self.entry.touch();
    }

    /// Notes that the part is on its way.
    fn taken(&mut self) {
        let bytes = std::mem::take(&mut self.bytes);
        self.entry.unread.bytes.fetch_sub(bytes, Ordering::Relaxed);
        self.entry.response.since.store(NOTHING, Ordering::Relaxed);
    }
}

impl Drop for WaitingPart {
    fn drop(&mut self) {
        self.taken();
    }
}

/// An answer that is counted as a whole as long as this lives.
pub(super) struct WholeAnswer {
    entry: ResponseEntry,
    bytes: u64,
}

impl WholeAnswer {
    /// Notes that `bytes` of it were sent.
    pub(super) fn sent(&mut self, bytes: u64) {
        let bytes = bytes.min(self.bytes);
        self.bytes -= bytes;
        self.entry.unread.whole.fetch_sub(bytes, Ordering::Relaxed);
        self.entry.touch(); // the client reads
    }
}

impl Drop for WholeAnswer {
    fn drop(&mut self) {
        let unread = &self.entry.unread;
        unread.whole.fetch_sub(self.bytes, Ordering::Relaxed);
    }
}

impl Unread {
    pub(super) fn new(most: u64) -> Arc<Self> {
        Arc::new(Self {
            start: Instant::now(),
            bytes: AtomicU64::new(0),
            whole: AtomicU64::new(0),
            most,
            next: AtomicU64::new(0),
            responses: Mutex::default(),
        })
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, BTreeMap<u64, Arc<Response>>> {
        // A poisoned map is still usable, because its entries are consistent.
        let responses = self.responses.lock();
        responses.unwrap_or_else(PoisonError::into_inner)
    }

    fn enter(self: &Arc<Self>, open: &Arc<Open>) -> ResponseEntry {
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        let response = Arc::new(Response {
            since: AtomicU64::new(NOTHING),
            open: open.clone(),
        });
        self.lock().insert(number, response.clone());
        ResponseEntry {
            unread: self.clone(),
            number,
            response,
        }
    }

    /// A response of which nothing waits yet.
    fn part(self: &Arc<Self>, open: &Arc<Open>) -> WaitingPart {
        WaitingPart {
            entry: self.enter(open),
            bytes: 0,
        }
    }

    /// Counts a whole answer. One has room in any case.
    ///
    /// # Errors
    /// There is no room for it beside those that are being sent.
    pub(super) fn add_whole(
        self: &Arc<Self>,
        bytes: u64,
        open: &Arc<Open>,
    ) -> Result<WholeAnswer, Fault> {
        let fits = |waiting: u64| {
            let all = waiting.saturating_add(bytes);
            (waiting == 0 || all <= self.most).then_some(all)
        };
        let (order, whole) = (Ordering::Relaxed, &self.whole);
        if whole.fetch_update(order, order, fits).is_err() {
            self.close_stalled(Instant::now());
            return Err(Fault::Exhausted {
                limit: "max_unread_bytes",
                value: self.most,
                message: format!("an answer of {bytes} bytes beside those that are not read yet"),
                retry: Some(4 * PATIENCE),
            });
        }
        let entry = self.enter(open);
        entry.touch();
        Ok(WholeAnswer { entry, bytes })
    }

    /// Whether there is room for one more part; closes connections to make some. Whole answers leave half of it.
    fn room(&self, now: impl Fn() -> Instant) -> bool {
        let whole = self.whole.load(Ordering::Relaxed).min(self.most / 2);
        if self.bytes.load(Ordering::Relaxed) + whole <= self.most {
            return true;
        }
        self.close_stalled(now());
        false
    }

    fn close_stalled(&self, now: Instant) {
        let now = now - self.start;
        let stalled = |r: &&Arc<Response>| {
            let since = r.since.load(Ordering::Relaxed);
            since != NOTHING && now.saturating_sub(Duration::from_nanos(since)) >= PATIENCE
        };
        // Closing one takes a moment to be felt here, so all that have waited too long go at once.
        for response in self.lock().values().filter(stalled) {
            response.open.close(Why::Unread);
        }
    }
}

/// The body of a response on its way to the client.
pub(super) struct Reply {
    body: Body,
    /// `None` for answers that never wait.
    unread: Option<Arc<Unread>>,
    open: Arc<Open>,
    part: Option<WaitingPart>,
    wait: Option<Pin<Box<Sleep>>>,
    _place: Option<OwnedSemaphorePermit>,
}

impl Reply {
    pub(super) fn new(
        body: Body,
        unread: Option<Arc<Unread>>,
        open: Arc<Open>,
        place: Option<OwnedSemaphorePermit>,
    ) -> Self {
        Self {
            body,
            unread,
            open,
            part: None,
            wait: None,
            _place: place,
        }
    }
}

impl HttpBody for Reply {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        if let Some(part) = &mut self.part {
            part.taken(); // there is room in the connection: the part before is on its way
        }
        while self.unread.as_ref().is_some_and(|u| !u.room(Instant::now)) {
            let wait = self
                .wait
                .get_or_insert_with(|| Box::pin(tokio::time::sleep(RETRY)));
            ready!(wait.as_mut().poll(cx));
            self.wait = None;
        }
        let frame = ready!(Pin::new(&mut self.body).poll_frame(cx));
        if let Some(data) = frame.as_ref().and_then(|f| f.as_ref().ok()?.data_ref()) {
            let Self {
                unread, part, open, ..
            } = &mut *self;
            if let Some(unread) = unread {
                let part = part.get_or_insert_with(|| unread.part(open));
                part.waits(data.len() as u64);
            }
        }
        Poll::Ready(frame)
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

#[cfg(test)]
mod tests {
    use super::super::connections::Peer;
    use super::*;
    use std::future::poll_fn;

    fn reply(unread: &Arc<Unread>, peer: &Arc<Peer>) -> Reply {
        let body = Body::from(vec![0; 100]);
        Reply::new(body, Some(unread.clone()), Arc::new(peer.open()), None)
    }

    async fn part(reply: &mut Reply) -> usize {
        let frame = poll_fn(|cx| Pin::new(&mut *reply).poll_frame(cx)).await;
        frame.unwrap().unwrap().data_ref().unwrap().len()
    }

    #[tokio::test]
    async fn those_who_never_read_lose_their_connection_and_others_go_on() {
        let unread = Unread::new(250);
        let stalled: Vec<Arc<Peer>> = (0..3).map(|_| Peer::alone()).collect();
        let mut held: Vec<Reply> = stalled.iter().map(|p| reply(&unread, p)).collect();
        for r in &mut held {
            assert_eq!(part(r).await, 100);
        }
        // 300 of 250 bytes wait, but not for long enough.
        assert!(!unread.room(Instant::now));
        assert!(stalled.iter().all(|p| !p.is_closed()));
        assert!(!unread.room(|| Instant::now() + PATIENCE));
        assert!(stalled.iter().all(|p| p.is_closed()));
        held.clear(); // as the connections do when they close
        let reader = Peer::alone();
        assert_eq!(part(&mut reply(&unread, &reader)).await, 100);
        assert!(unread.room(Instant::now) && !reader.is_closed());
        assert_eq!(unread.bytes.load(Ordering::Relaxed), 0);
        assert!(unread.lock().is_empty());
    }

    #[tokio::test]
    async fn a_whole_answer_has_room_or_is_refused() {
        let unread = Unread::new(100);
        let (slow, other) = (Peer::alone(), Peer::alone());
        let (slow_open, other_open) = (Arc::new(slow.open()), Arc::new(other.open()));
        let mut first = unread.add_whole(60, &slow_open).unwrap();
        let refused = unread.add_whole(60, &other_open).err().unwrap();
        assert!(
            refused.to_string().contains("max_unread_bytes"),
            "{refused}"
        );
        // Sent bytes make room.
        first.sent(30);
        let second = unread.add_whole(60, &other_open).unwrap();
        // Parts of streams have half of it in any case.
        let mut part = unread.part(&other_open);
        part.waits(50);
        assert!(unread.room(Instant::now));
        drop((part, second));
        unread.close_stalled(Instant::now() + PATIENCE);
        assert!(slow.is_closed() && !other.is_closed());
        drop(first);
        // An answer larger than the limit has room if it is alone.
        drop(unread.add_whole(1000, &other_open).unwrap());
        assert_eq!(unread.whole.load(Ordering::Relaxed), 0);
        assert!(unread.lock().is_empty());
    }

    #[tokio::test]
    async fn a_part_waits_for_room() {
        let unread = Unread::new(50);
        let peer = Peer::alone();
        let mut first = reply(&unread, &peer);
        assert_eq!(part(&mut first).await, 100);
        let mut second = reply(&unread, &peer);
        let now = poll_fn(|cx| Poll::Ready(Pin::new(&mut second).poll_frame(cx).is_ready())).await;
        assert!(!now, "there was no room");
        drop(first);
        assert_eq!(part(&mut second).await, 100);
    }
}
