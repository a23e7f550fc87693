//! What is sent, and not yet taken by those who read slowly.
//!
//! A response is asked for its next part when the connection has room for it. Until then the part before waits in
//! memory, for as long as the client does not read. All parts that wait are counted. When they become too many, the
//! connections whose clients have read nothing for the longest are closed, and nobody else gets a new part until there
//! is room again.

use super::connections::{Open, Why};
use axum::body::{Body, Bytes};
use http_body::{Body as HttpBody, Frame, SizeHint};
use std::collections::BTreeMap;
use std::pin::Pin;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Context, Poll, ready};
use std::time::Duration;
use tokio::sync::OwnedSemaphorePermit;
use tokio::time::{Instant, Sleep};

/// How long a client that reads may take for a part while others wait for room.
const PATIENCE: Duration = Duration::from_millis(250);
/// Interval at which a response looks for room.
const RETRY: Duration = Duration::from_millis(20);

/// Parts that wait.
#[derive(Debug)]
pub(super) struct Unread {
    bytes: AtomicU64,
    most: u64,
    next: AtomicU64,
    waiting: Mutex<BTreeMap<u64, Waiting>>,
}

/// A part that waits. Numbers grow, so the first of the map is the oldest.
#[derive(Debug)]
struct Waiting {
    since: Instant,
    open: Arc<Open>,
}

/// A part that is counted as long as this lives.
struct Part {
    unread: Arc<Unread>,
    number: u64,
    bytes: u64,
}

impl Drop for Part {
    fn drop(&mut self) {
        self.unread.bytes.fetch_sub(self.bytes, Ordering::Relaxed);
        self.unread.lock().remove(&self.number);
    }
}

impl Unread {
    pub(super) fn new(most: u64) -> Arc<Self> {
        Arc::new(Self {
            bytes: AtomicU64::new(0),
            most,
            next: AtomicU64::new(0),
            waiting: Mutex::default(),
        })
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, BTreeMap<u64, Waiting>> {
        // A poisoned map is as good as any: entries are whole.
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn add(self: &Arc<Self>, bytes: u64, open: &Arc<Open>) -> Part {
        self.bytes.fetch_add(bytes, Ordering::Relaxed);
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        self.lock().insert(
            number,
            Waiting {
                since: Instant::now(),
                open: open.clone(),
            },
        );
        Part {
            unread: self.clone(),
            number,
            bytes,
        }
    }

    /// Whether there is room for one more part; closes connections to make some.
    fn room(&self, now: Instant) -> bool {
        if self.bytes.load(Ordering::Relaxed) <= self.most {
            return true;
        }
        // Closing one takes a moment to be felt here, so all that have waited too long go at once.
        for part in self
            .lock()
            .values()
            .take_while(|w| now - w.since >= PATIENCE)
        {
            part.open.close(Why::Unread);
        }
        false
    }
}

/// The body of a response on its way to the client.
pub(super) struct Reply {
    body: Body,
    /// `None` for answers that never wait.
    unread: Option<Arc<Unread>>,
    open: Arc<Open>,
    part: Option<Part>,
    wait: Option<Pin<Box<Sleep>>>,
    _place: Option<OwnedSemaphorePermit>,
}

impl Reply {
    pub(super) fn new(
        body: Body,
        unread: Option<Arc<Unread>>,
        open: Open,
        place: Option<OwnedSemaphorePermit>,
    ) -> Self {
        Self {
            body,
            unread,
            open: Arc::new(open),
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
        self.part = None; // there is room in the connection: the part before is on its way
        while self
            .unread
            .as_ref()
            .is_some_and(|u| !u.room(Instant::now()))
        {
            let wait = self
                .wait
                .get_or_insert_with(|| Box::pin(tokio::time::sleep(RETRY)));
            ready!(wait.as_mut().poll(cx));
            self.wait = None;
        }
        let frame = ready!(Pin::new(&mut self.body).poll_frame(cx));
        if let Some(data) = frame.as_ref().and_then(|f| f.as_ref().ok()?.data_ref()) {
            let add = |unread: &Arc<Unread>| unread.add(data.len() as u64, &self.open);
            self.part = self.unread.as_ref().map(add);
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
        Reply::new(body, Some(unread.clone()), peer.open(), None)
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
        assert!(!unread.room(Instant::now()));
        assert!(stalled.iter().all(|p| !p.is_closed()));
        assert!(!unread.room(Instant::now() + PATIENCE));
        assert!(stalled.iter().all(|p| p.is_closed()));
        held.clear(); // as the connections do when they close
        let reader = Peer::alone();
        assert_eq!(part(&mut reply(&unread, &reader)).await, 100);
        assert!(unread.room(Instant::now()) && !reader.is_closed());
        assert_eq!(unread.bytes.load(Ordering::Relaxed), 0);
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
