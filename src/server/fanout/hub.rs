//! Views of one world: for each that someone watches, a task that encodes the latest frame and hands the bytes to all
//! its viewers.

use crate::server::shares::{Client, check_part};
use crate::wire::frame::{shared_frame, shared_roster};
use crate::wire::status::Fault;
use crate::wire::types::{Snapshot, ViewSpec};
use prost::bytes::Bytes;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError, Weak};
use tokio::sync::watch;

/// A frame of a view, encoded.
#[derive(Clone, Debug)]
pub struct Encoded {
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
    /// Who asked for it first.
    owner: Client,
    latest: watch::Sender<Option<Encoded>>,
}

impl Channel {
    /// The latest frame, now and whenever it changes.
    pub fn subscribe(&self) -> watch::Receiver<Option<Encoded>> {
        self.latest.subscribe()
    }
}

/// The views of one world.
#[derive(Debug)]
pub struct Hub {
    channels: Mutex<HashMap<ViewSpec, Weak<Channel>>>,
    most: u64,
    share: f64,
}

impl Hub {
    /// No views yet; at most `most` different ones, of which one client may have asked for a `share`.
    pub fn new(most: u64, share: f64) -> Self {
        Self {
            channels: Mutex::default(),
            most,
            share,
        }
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
        client: Client,
    ) -> Result<Arc<Channel>, Fault> {
        // A poisoned map is as good as any: entries are whole.
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
            channel.latest.send_replace(Some(Encoded {
                tick: snapshot.tick,
                roster_version: version,
                frame: shared_frame(&snapshot, &view),
                roster,
            }));
            last = Some(snapshot.tick);
        }
        drop(channel);
        if latest.changed().await.is_err() {
            return; // the world is gone; so are its viewers' streams
        }
    }
}
