//! The past of a world as frames, for viewers who join late: it is done again beside the world, some ticks at a time
//! and no faster than the viewer reads, until what is held as frames goes on from there.

use super::App;
use crate::shares::Client;
use crate::tick::journal::Segment;
use crate::tick::replay::{Replay, ReplayError};
use crate::tick::scene::Scene;
use crate::workers::Turn;
use crate::worlds::WorldHandle;
use sinew_wire::status::Fault;
use sinew_wire::types::{RosterEntry, Snapshot};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

/// Frames of figures that are worked out ahead of a viewer.
const AHEAD: usize = 256;
/// Ticks at a time, at most.
const MOST_TICKS: usize = 64;
/// Rosters of the past count up from here: numbers that no world gives its own.
const FIRST_ROSTER: i32 = i32::MIN / 2;

/// Viewers for which something is kept, at most: those that have read last. What was kept for others is done again when
/// they go on reading, so one that never reads costs nothing for long.
const KEPT: usize = 16;

/// What is kept for a viewer between two of its frames.
#[derive(Default)]
struct Kept {
    ready: VecDeque<Arc<Snapshot>>,
    work: Option<Work>,
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // Every holder leaves the value whole.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The viewers for which something is kept, in the order in which they have read.
#[derive(Default)]
pub struct LateViewers(Mutex<VecDeque<Weak<Mutex<Kept>>>>);

impl LateViewers {
    /// Notes that a viewer reads; what is kept for the one that has not for the longest is let go.
    fn reads(&self, kept: &Arc<Mutex<Kept>>) {
        let mut all = locked(&self.0);
        all.retain(|k| k.strong_count() > 0 && !Weak::ptr_eq(k, &Arc::downgrade(kept)));
        all.push_back(Arc::downgrade(kept));
        while all.len() > KEPT {
            if let Some(gone) = all.pop_front().and_then(|k| k.upgrade()) {
                *locked(&gone) = Kept::default();
            }
        }
    }
}

/// The past on its way to a viewer.
pub(super) struct Late {
    app: Arc<App>,
    client: Client,
    handle: Arc<WorldHandle>,
    epoch: i32,
    /// The next tick that is wanted.
    next: u64,
    /// The last version of a roster.
    version: i32,
    kept: Arc<Mutex<Kept>>,
}

/// A part of the past that is being done again.
struct Work {
    replay: Option<Replay>,
    past: Vec<Arc<Segment>>,
    /// Its last tick.
    until: u64,
    /// Of the last frame.
    roster: Option<Arc<[RosterEntry]>>,
    version: i32,
}

impl Late {
    /// Frames after `tick`.
    ///
    /// # Errors
    /// The next one is not held any more, or is not computed yet.
    pub fn after(
        app: &Arc<App>,
        client: Client,
        handle: &Arc<WorldHandle>,
        tick: i64,
    ) -> Result<Self, Fault> {
        let next = u64::try_from(tick.saturating_add(1)).unwrap_or(0);
        let journal = super::history::journal(handle)?;
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

    /// The next frame; `None` once the frames that are held go on from there.
    ///
    /// # Errors
    /// What is wanted is not held any more; it cannot be done again.
    pub async fn take_next(&mut self) -> Result<Option<Arc<Snapshot>>, Fault> {
        loop {
            // A world that was put elsewhere meanwhile shows that in its next frame.
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
            *locked(&self.kept) = Kept {
                ready: frames.into(),
                work: Some(work),
            };
            self.app.late.reads(&self.kept);
        }
    }

    /// What is held of the past from here on.
    fn begin(&mut self) -> Result<Work, Fault> {
        let journal = super::history::journal(&self.handle)?;
        let (_, newest) = journal.held().unwrap_or_default();
        let until = newest.max(self.next);
        Ok(Work {
            past: journal.past(self.next, until)?,
            replay: None,
            until,
            roster: None,
            version: self.version,
        })
    }
}

impl Work {
    /// Does the next ticks, from tick `from` on.
    fn go_on(
        mut self,
        world: &Arc<str>,
        (from, epoch): (u64, i32),
        turn: &Turn,
    ) -> Result<(Self, Vec<Arc<Snapshot>>), Fault> {
        let begins = self.replay.is_none();
        let mut replay = match self.replay.take() {
            Some(replay) => replay,
            None => Replay::of(&self.past)?,
        };
        // Segments that are done are let go.
        let now = replay.scene.world().tick();
        let done = self.past.partition_point(|s| s.start.tick() < now);
        self.past.drain(..done.saturating_sub(1));
        let figures = replay.scene.members().len().max(1);
        let ticks = (AHEAD / figures).clamp(1, MOST_TICKS) as u64;
        let until = self.until.min(from + ticks - 1);
        let mut frames = Vec::new();
        let (roster, version) = (&mut self.roster, &mut self.version);
        let mut each = |scene: &Scene| {
            if scene.world().tick() >= from {
                let names = |all: &[RosterEntry]| -> Vec<(i32, String)> {
                    all.iter().map(|e| (e.index, e.figure.clone())).collect()
                };
                let now = scene.roster();
                let same = roster.take_if(|before| names(before) == names(&now));
                *version += i32::from(same.is_none());
                let now = same.unwrap_or(now);
                *roster = Some(Arc::clone(&now));
                let shown = scene.snapshot(world, (now, *version));
                frames.push(Arc::new(Snapshot { epoch, ..shown }));
            }
            !turn.stop()
        };
        if begins && now == from {
            each(&replay.scene);
        }
        // Those behind it have their turn later.
        let begun = self.past.partition_point(|s| s.start.tick() <= until);
        let done = replay.through_past(&self.past[..begun], until, &mut each);
        match done {
            Ok(()) => {}
            Err(ReplayError::Stopped) => return Err(Turn::gone()),
            Err(why) => {
                return Err(Fault::DataLoss {
                    reason: "REPLAY_DIFFERS",
                    message: why.to_string(),
                });
            }
        }
        if frames.is_empty() {
            return Err(Fault::Internal(
                "a past without the tick that it holds".into(),
            ));
        }
        self.replay = Some(replay);
        Ok((self, frames))
    }
}
