//! Views of one world: each watched view has a task that encodes the latest frame and hands the bytes to all its
//! viewers.

use crate::shares::{ClientKey, check_part};
use prost::bytes::Bytes;
use sinew_wire::frame::{shared_frame, shared_roster};
use sinew_wire::status::Fault;
use sinew_wire::types::{Snapshot, ViewSpec};
use std::collections::{BTreeMap, HashMap, VecDeque};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use tokio::sync::watch;

/// Bytes of encoded frames that one world keeps for viewers that resume.
const PAST_BYTES: usize = 4 * 1024 * 1024;

/// A frame of a view, encoded.
#[derive(Clone, Debug)]
pub struct EncodedFrame {
    /// Its tick.
    pub tick: u64,
    /// Version of the roster it refers to.
    pub roster_version: i32,
    /// The frame, as a message of a watch.
    pub frame: Bytes,
    /// The roster, as a message of a watch.
    pub roster: Bytes,
}

/// A view that is encoded while it has viewers.
#[derive(Debug)]
pub struct Channel {
    /// The client that first requested it.
    owner: ClientKey,
    number: u64,
    latest: watch::Sender<Option<EncodedFrame>>,
}

impl Channel {
    /// The latest frame, now and whenever it changes.
    pub fn subscribe(&self) -> watch::Receiver<Option<EncodedFrame>> {
        self.latest.subscribe()
    }
}

/// The views of one world.
#[derive(Debug)]
pub struct Hub {
    channels: Mutex<HashMap<ViewSpec, Weak<Channel>>>,
    most: u64,
    share: f64,
    next: AtomicU64,
    past: Mutex<ResumePast>,
    most_past: usize,
}

/// The data that resuming viewers still need. Viewers do not hold them themselves, because a viewer that never reads
/// must cost nothing.
#[derive(Debug, Default)]
struct ResumePast {
    /// Viewers that have not caught up yet.
    viewers: usize,
    /// Ticks that they may ask for, at most as many as the world's history.
    snapshots: BTreeMap<u64, Arc<Snapshot>>,
    /// Frames of them, by channel, epoch and tick, and in the order in which they were encoded.
    frames: HashMap<(u64, i32, u64), Bytes>,
    order: VecDeque<(u64, i32, u64)>,
    bytes: usize,
}

/// A resuming viewer: keeps the data that it may need until it has caught up.
#[derive(Debug)]
pub struct Resuming {
    ticks: VecDeque<Weak<Snapshot>>,
}

impl Resuming {
    /// The next tick that is still there.
    pub fn take_next(&mut self) -> Option<Arc<Snapshot>> {
        std::iter::from_fn(|| self.ticks.pop_front()).find_map(|s| s.upgrade())
    }
}

impl Hub {
    /// No views yet; at most `most` different ones, of which one client may have asked for a `share`, and at most
    /// `most_past` ticks for viewers that resume.
    pub fn new(most: u64, share: f64, most_past: usize) -> Self {
        Self {
            channels: Mutex::default(),
            most,
            share,
            next: AtomicU64::new(0),
            past: Mutex::default(),
            most_past,
        }
    }

    fn past(&self) -> MutexGuard<'_, ResumePast> {
        // A poisoned value is still usable: at worst some bytes are counted twice until the last viewer has caught up.
        self.past.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Begins to resume with these ticks. They are kept until all viewers have caught up, but never more than the
    /// world's history holds. Beyond that the oldest are dropped, and a slow viewer misses those frames.
    pub fn resume(&self, ticks: impl IntoIterator<Item = Arc<Snapshot>>) -> Resuming {
        let mut past = self.past();
        past.viewers += 1;
        let held = ticks.into_iter().map(|snapshot| {
            let weak = Arc::downgrade(&snapshot);
            past.snapshots.insert(snapshot.tick, snapshot);
            weak
        });
        let held = held.collect();
        while past.snapshots.len() > self.most_past {
            past.snapshots.pop_first();
        }
        Resuming { ticks: held }
    }

    /// Notes that a viewer has caught up, or is gone.
    pub fn resumed(&self) {
        let mut past = self.past();
        past.viewers -= 1;
        if past.viewers == 0 {
            *past = ResumePast::default();
        }
    }

    /// A past frame of a view, encoded once for all that ask for it soon after each other.
    pub fn past_frame(&self, channel: &Channel, snapshot: &Snapshot, view: &ViewSpec) -> Bytes {
        let key = (channel.number, snapshot.epoch, snapshot.tick);
        if let Some(bytes) = self.past().frames.get(&key) {
            return bytes.clone();
        }
        let bytes = shared_frame(snapshot, view);
        let mut past = self.past();
        if past.frames.insert(key, bytes.clone()).is_none() {
            past.order.push_back(key);
            past.bytes += bytes.len();
        }
        while past.bytes > PAST_BYTES
            && let Some(oldest) = past.order.pop_front()
        {
            past.bytes -= past.frames.remove(&oldest).map_or(0, |b| b.len());
        }
        bytes
    }

    /// The channel of a view of the world whose frames come from `latest`; its task starts with the first viewer and
    /// ends with the last.
    ///
    /// # Errors
    /// Too many different views, or too many of this client.
    pub fn channel(
        &self,
        view: &ViewSpec,
        latest: &watch::Sender<Arc<Snapshot>>,
        client: ClientKey,
    ) -> Result<Arc<Channel>, Fault> {
        // A poisoned map is still usable, because its entries are consistent.
        let mut channels = self.channels.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(channel) = channels.get(view).and_then(Weak::upgrade) {
            return Ok(channel);
        }
        channels.retain(|_, c| c.strong_count() > 0);
        if channels.len() as u64 >= self.most {
            return Err(Fault::Exhausted {
                limit: "max_views_per_world",
                value: self.most,
                message: "one more view that differs in figures, fields, encoding or rate".into(),
                retry: None,
            });
        }
        let own = channels.values().filter_map(Weak::upgrade);
        let own = own.filter(|c| c.owner == client).count() as u64;
        check_part("max_views_per_world", own, self.most, self.share)?;
        let channel = Arc::new(Channel {
            owner: client,
            number: self.next.fetch_add(1, Ordering::Relaxed),
            latest: watch::Sender::new(None),
        });
        channels.insert(view.clone(), Arc::downgrade(&channel));
        tokio::spawn(encode(
            Arc::downgrade(&channel),
            view.clone(),
            latest.subscribe(),
        ));
        Ok(channel)
    }
}

async fn encode(
    channel: Weak<Channel>,
    view: ViewSpec,
    mut latest: watch::Receiver<Arc<Snapshot>>,
) {
    let mut roster: Option<(i32, Bytes)> = None;
    let mut last: Option<u64> = None;
    loop {
        let snapshot = latest.borrow_and_update().clone();
        let Some(channel) = channel.upgrade() else {
            return;
        };
        let version = snapshot.roster_version;
        let new_roster = roster.as_ref().is_none_or(|(v, _)| *v != version);
        let divisor = u64::from(view.divisor);
        let due = last.is_none_or(|l| snapshot.tick / divisor > l / divisor);
        if new_roster || due {
            let roster = match &roster {
                Some((_, bytes)) if !new_roster => bytes.clone(),
                _ => {
                    let bytes = shared_roster(&snapshot, &view);
                    roster = Some((version, bytes.clone()));
                    bytes
                }
            };
            channel.latest.send_replace(Some(EncodedFrame {
                tick: snapshot.tick,
                roster_version: version,
                frame: shared_frame(&snapshot, &view),
                roster,
            }));
            last = Some(snapshot.tick);
        }
        drop(channel);
        if latest.changed().await.is_err() {
            return; // the world is gone, and so are its viewers' streams
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_wire::convert::state::view;

    fn snapshot(tick: u64) -> Arc<Snapshot> {
        Arc::new(Snapshot {
            world: "w".into(),
            rate_hz: 60.0,
            gravity: 9.81,
            tick,
            time: tick as f64 / 60.0,
            hash: 0,
            epoch: 0,
            server_ns: 0,
            roster_version: 0,
            roster: Vec::new().into(),
            figures: Vec::new(),
            obstacles: Vec::new(),
        })
    }

    fn ticks(resuming: &mut Resuming) -> Vec<u64> {
        std::iter::from_fn(|| resuming.take_next())
            .map(|s| s.tick)
            .collect()
    }

    #[test]
    fn viewers_that_never_catch_up_hold_no_more_than_the_history() {
        let hub = Hub::new(8, 1.0, 10);
        // The world continues and forgets; viewers come, resume and never read.
        let mut history: VecDeque<_> = (0..9).map(snapshot).collect();
        let mut stalled = Vec::new();
        for tick in 9..109 {
            history.push_back(snapshot(tick));
            stalled.push(hub.resume(history.iter().cloned()));
            history.pop_front();
        }
        drop(history);
        assert_eq!(hub.past().snapshots.len(), 10);
        assert_eq!(
            ticks(stalled.last_mut().unwrap()),
            (99..109).collect::<Vec<_>>()
        );
        assert_eq!(
            ticks(&mut stalled[95]),
            [99, 100, 101, 102, 103, 104],
            "frames that it missed"
        );
        assert!(ticks(&mut stalled[0]).is_empty());
        for _ in &stalled {
            hub.resumed();
        }
        assert!(
            hub.past().snapshots.is_empty(),
            "all have caught up or are gone"
        );
    }

    #[tokio::test]
    async fn a_past_frame_is_encoded_once_and_few_are_kept() {
        let hub = Hub::new(8, 1.0, 10);
        let latest = watch::Sender::new(snapshot(0));
        let view = view(None).unwrap();
        let channel = hub.channel(&view, &latest, "client".into()).unwrap();
        let _resuming = hub.resume([snapshot(1)]);
        let first = hub.past_frame(&channel, &snapshot(1), &view);
        let again = hub.past_frame(&channel, &snapshot(1), &view);
        assert_eq!(first.as_ptr(), again.as_ptr(), "the same bytes");
        let mut sum = 0;
        let mut tick = 2;
        while sum <= 2 * PAST_BYTES {
            sum += hub.past_frame(&channel, &snapshot(tick), &view).len();
            tick += 1;
        }
        let past = hub.past();
        assert!(past.bytes <= PAST_BYTES, "{}", past.bytes);
        assert_eq!(past.frames.len(), past.order.len());
        let counted: usize = past.frames.values().map(Bytes::len).sum();
        assert_eq!(counted, past.bytes);
    }
}
