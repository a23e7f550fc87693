//! Streams of frames and events. A stream is asked for its next message when the connection has room, so a slow viewer
//! skips frames instead of collecting them.

use super::late::LateFrames;
use super::permit::Ending;
use super::{HeldPlace, refusal};
use crate::fanout::hub::{Channel, EncodedFrame, Resuming};
use crate::telemetry::metrics::frames_sent;
use crate::worlds::WorldHandle;
use prost::bytes::Bytes;
use sinew_wire::convert::state::{event_out, wanted};
use sinew_wire::frame::shared_roster;
use sinew_wire::pb;
use sinew_wire::types::{EventFilter, Snapshot, ViewSpec, WorldEvent};
use sinew_wire::watched::WatchWorldResponse;
use std::collections::VecDeque;
use std::pin::Pin;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use tokio::sync::{broadcast, watch};
use tokio_stream::Stream;
use tonic::Status;

/// Frames in order.
pub type FrameStream = Pin<Box<dyn Stream<Item = Result<WatchWorldResponse, Status>> + Send>>;
/// Events in order.
pub type Events = Pin<Box<dyn Stream<Item = Result<pb::WatchEventsResponse, Status>> + Send>>;

/// Ticks before the latest.
pub(super) enum PastStart {
    /// Frames that are no longer held.
    Late(Box<LateFrames>),
    /// Frames that are held.
    Held(Resuming),
}

struct Viewer {
    handle: Arc<WorldHandle>,
    channel: Arc<Channel>, // keeps its encoder running
    view: ViewSpec,
    frames: watch::Receiver<Option<EncodedFrame>>,
    /// Ticks before the latest, to be sent first.
    past: Option<PastStart>,
    /// At most a roster and a frame.
    ready: VecDeque<Bytes>,
    roster: Option<i32>,
    last: Option<u64>,
    ending: Ending,
    over: bool,
    _place: HeldPlace,
}

impl Drop for Viewer {
    fn drop(&mut self) {
        if let Some(PastStart::Held(_)) = self.past {
            self.handle.hub.resumed();
        }
        self.handle.viewers.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Frames of a view: first those of the past, then live ones.
pub(super) fn frames(
    handle: Arc<WorldHandle>,
    (view, channel): (&ViewSpec, Arc<Channel>),
    past: PastStart,
    ending: Ending,
    place: HeldPlace,
) -> FrameStream {
    let mut frames = channel.subscribe();
    frames.mark_changed(); // the frame that is there already is sent first
    handle.viewers.fetch_add(1, Ordering::Relaxed);
    let viewer = Viewer {
        handle,
        channel,
        view: view.clone(),
        frames,
        past: Some(past),
        ready: VecDeque::new(),
        roster: None,
        last: None,
        ending,
        over: false,
        _place: place,
    };
    Box::pin(futures_util::stream::unfold(viewer, |mut v| async move {
        let item = v.next().await?;
        Some((item, v))
    }))
}

/// Frames of a view that are held.
pub(super) fn held(handle: &WorldHandle, view: &ViewSpec, held: Vec<Arc<Snapshot>>) -> PastStart {
    let divisor = u64::from(view.divisor);
    let held = held.into_iter().filter(|s| s.tick % divisor == 0);
    PastStart::Held(handle.hub.resume(held))
}

impl Viewer {
    /// Makes a past tick ready to be sent.
    fn catch_up(&mut self, snapshot: &Snapshot) {
        if self.roster != Some(snapshot.roster_version) {
            self.roster = Some(snapshot.roster_version);
            self.ready.push_back(shared_roster(snapshot, &self.view));
        }
        let frame = (self.handle.hub).past_frame(&self.channel, snapshot, &self.view);
        self.ready.push_back(frame);
        self.last = Some(snapshot.tick);
    }

    /// The held frames after the last one that was simulated again.
    fn held_on(&self) -> PastStart {
        let last = self.last.map_or(-1, |l| l as i64);
        // Frames dropped in the meantime are missed, as by any viewer that is too slow.
        let after = self.handle.history().after(last).unwrap_or_default();
        held(&self.handle, &self.view, after)
    }

    async fn next(&mut self) -> Option<Result<WatchWorldResponse, Status>> {
        loop {
            if let Some(bytes) = self.ready.pop_front() {
                frames_sent().increment(1);
                return Some(Ok(WatchWorldResponse::Encoded(bytes)));
            }
            if self.over {
                return None;
            }
            match &mut self.past {
                Some(PastStart::Held(past)) => {
                    match past.take_next() {
                        Some(snapshot) => self.catch_up(&snapshot),
                        None => {
                            self.past = None;
                            self.handle.hub.resumed();
                        }
                    }
                    continue;
                }
                Some(PastStart::Late(late)) => {
                    let next = tokio::select! {
                        next = late.take_next() => next,
                        fault = &mut self.ending => Err(fault),
                    };
                    match next {
                        Ok(Some(s)) if s.tick % u64::from(self.view.divisor) != 0 => {
                            self.last = Some(s.tick);
                        }
                        Ok(Some(snapshot)) => self.catch_up(&snapshot),
                        Ok(None) => self.past = Some(self.held_on()),
                        Err(fault) => {
                            self.over = true;
                            return Some(Err(refusal(fault)));
                        }
                    }
                    continue;
                }
                None => {}
            }
            let ended = tokio::select! {
                changed = self.frames.changed() => changed.err().map(|_| self.handle.no_more()),
                fault = &mut self.ending => Some(fault),
            };
            if let Some(fault) = ended {
                self.over = true;
                return Some(Err(refusal(fault)));
            }
            let Some(new) = self.frames.borrow_and_update().clone() else {
                continue;
            };
            let known = self.roster == Some(new.roster_version);
            if known && self.last.is_some_and(|l| new.tick <= l) {
                continue;
            }
            if let Some(last) = self.last {
                let divisor = u64::from(self.view.divisor);
                let missed = (new.tick / divisor)
                    .saturating_sub(last / divisor)
                    .saturating_sub(1);
                if missed > 0 {
                    self.handle.dropped.fetch_add(missed, Ordering::Relaxed);
                    metrics::counter!("sinew_frames_dropped_total").increment(missed);
                }
            }
            if !known {
                self.roster = Some(new.roster_version);
                self.ready.push_back(new.roster);
            }
            self.last = Some(new.tick);
            self.ready.push_back(new.frame);
        }
    }
}

struct Listener {
    handle: Arc<WorldHandle>,
    filter: EventFilter,
    events: broadcast::Receiver<Arc<Vec<WorldEvent>>>,
    missed: u64,
    begun: bool,
    ending: Ending,
    over: bool,
    _place: HeldPlace,
}

impl Drop for Listener {
    fn drop(&mut self) {
        self.handle.viewers.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Events that pass a filter.
pub(super) fn events(
    handle: Arc<WorldHandle>,
    filter: EventFilter,
    ending: Ending,
    place: HeldPlace,
) -> Events {
    handle.viewers.fetch_add(1, Ordering::Relaxed);
    let listener = Listener {
        events: handle.outlet.events.subscribe(),
        handle,
        filter,
        ending,
        missed: 0,
        begun: false,
        over: false,
        _place: place,
    };
    Box::pin(futures_util::stream::unfold(listener, |mut l| async move {
        let item = l.next().await?;
        Some((item, l))
    }))
}

impl Listener {
    async fn next(&mut self) -> Option<Result<pb::WatchEventsResponse, Status>> {
        if !std::mem::replace(&mut self.begun, true) {
            return Some(Ok(pb::WatchEventsResponse::default()));
        }
        while !self.over {
            let fault = tokio::select! {
                // The last events come before the end of their world.
                biased;
                received = self.events.recv() => match received {
                    Ok(batch) => {
                        let events: Vec<pb::Event> = batch
                            .iter()
                            .filter(|e| wanted(&self.filter, e))
                            .map(event_out)
                            .collect();
                        if events.is_empty() {
                            continue;
                        }
                        return Some(Ok(pb::WatchEventsResponse {
                            events,
                            missed_count: self.missed as i64,
                        }));
                    }
                    Err(broadcast::error::RecvError::Lagged(n)) => {
                        self.missed += n;
                        metrics::counter!("sinew_events_missed_total").increment(n);
                        continue;
                    }
                    Err(broadcast::error::RecvError::Closed) => self.handle.no_more(),
                },
                fault = &mut self.ending => fault,
            };
            self.over = true;
            return Some(Err(refusal(fault)));
        }
        None
    }
}
