//! The past of a world as frames, for viewers that join late. It is simulated again beside the world, some ticks at a
//! time and no faster than the viewer reads, until it reaches the frames that are still held.

use super::history::journal;
use crate::app::App;
use crate::late_viewers::{KeptForViewer, ReplayWork, locked};
use crate::shares::ClientKey;
use crate::workers::Turn;
use crate::worlds::WorldHandle;
use sinew_wire::status::Fault;
use sinew_wire::types::Snapshot;
use std::sync::{Arc, Mutex};

/// Rosters of the past count up from here: numbers that no world gives its own.
const FIRST_ROSTER: i32 = i32::MIN / 2;

/// The past on its way to a viewer.
pub(super) struct LateFrames {
    app: Arc<App>,
    client: ClientKey,
    handle: Arc<WorldHandle>,
    epoch: i32,
    /// The next tick to send.
    next: u64,
    /// The last version of a roster.
    version: i32,
    kept: Arc<Mutex<KeptForViewer>>,
}

impl LateFrames {
    /// Frames after `tick`.
    ///
    /// # Errors
    /// The next one is no longer held, or not computed yet.
    pub fn after(
        app: &Arc<App>,
        client: ClientKey,
        handle: &Arc<WorldHandle>,
        tick: i64,
    ) -> Result<Self, Fault> {
        let next = u64::try_from(tick.saturating_add(1)).unwrap_or(0);
        let journal = journal(handle)?;
        journal.past(next, next)?;
        Ok(Self {
            app: Arc::clone(app),
            client,
            handle: Arc::clone(handle),
            epoch: handle.latest().epoch,
            next,
            version: FIRST_ROSTER,
            kept: Arc::default(),
        })
    }

    /// The next frame; `None` once the held frames continue from there.
    ///
    /// # Errors
    /// A tick that is needed is no longer held, or it cannot be simulated again.
    pub async fn take_next(&mut self) -> Result<Option<Arc<Snapshot>>, Fault> {
        loop {
            // If the world was restored elsewhere in the meantime, its next frame shows that.
            let gone = self.handle.latest().epoch != self.epoch;
            if gone || self.handle.history().after(self.next as i64 - 1).is_ok() {
                return Ok(None);
            }
            let ready = locked(&self.kept).ready.pop_front();
            if let Some(snapshot) = ready {
                self.next = snapshot.tick + 1;
                return Ok(Some(snapshot));
            }
            let work = locked(&self.kept).work.take();
            let work = match work.filter(|w| self.next <= w.until) {
                Some(work) => work,
                None => self.begin()?,
            };
            let (world, from, epoch) = (Arc::clone(&self.handle.id), self.next, self.epoch);
            let done = move |turn: &Turn| work.go_on(&world, (from, epoch), turn);
            let (work, frames) = self.app.simulations.run(&self.client, done).await?;
            self.version = work.version;
            *locked(&self.kept) = KeptForViewer {
                ready: frames.into(),
                work: Some(work),
            };
            self.app.late.reads(&self.kept);
        }
    }

    /// The held past from here on.
    fn begin(&mut self) -> Result<ReplayWork, Fault> {
        let journal = journal(&self.handle)?;
        let (_, newest) = journal.held().unwrap_or_default();
        let until = newest.max(self.next);
        Ok(ReplayWork {
            past: journal.past(self.next, until)?,
            replay: None,
            until,
            roster: None,
            version: self.version,
        })
    }
}
