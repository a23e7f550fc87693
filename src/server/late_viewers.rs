//! Frames of the past that are computed for viewers that join late, and the bound on them.

use crate::tick::journal::JournalSegment;
use crate::tick::replay::{Replay, ReplayError};
use crate::tick::scene::Scene;
use crate::workers::Turn;
use sinew_wire::status::Fault;
use sinew_wire::types::{RosterEntry, Snapshot};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

/// Frames, each of one figure, that are computed ahead of a viewer.
const AHEAD: usize = 256;
/// Ticks at a time, at most.
const MOST_TICKS: usize = 64;
/// Most viewers for which something is kept: those that have read last. Frames of others are computed again when they
/// continue reading, so one that never reads costs nothing for long.
const KEPT: usize = 16;

/// Frames and work that are kept for a viewer between two of its reads.
#[derive(Default)]
pub(crate) struct KeptForViewer {
    pub ready: VecDeque<Arc<Snapshot>>,
    pub work: Option<ReplayWork>,
}

/// Locks a value that every holder leaves whole.
pub(crate) fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The viewers for which something is kept, in the order in which they have read.
#[derive(Default)]
pub struct LateViewers(Mutex<VecDeque<Weak<Mutex<KeptForViewer>>>>);

impl LateViewers {
    /// Notes that a viewer reads, and drops what is kept for the viewer that has not read for the longest.
    pub(crate) fn reads(&self, kept: &Arc<Mutex<KeptForViewer>>) {
        let mut all = locked(&self.0);
        all.retain(|k| k.strong_count() > 0 && !Weak::ptr_eq(k, &Arc::downgrade(kept)));
        all.push_back(Arc::downgrade(kept));
        while all.len() > KEPT {
            if let Some(gone) = all.pop_front().and_then(|k| k.upgrade()) {
                *locked(&gone) = KeptForViewer::default();
            }
        }
    }
}

/// A part of the past that is being simulated again.
pub(crate) struct ReplayWork {
    pub replay: Option<Replay>,
    pub past: Vec<Arc<JournalSegment>>,
    /// Its last tick.
    pub until: u64,
    /// Roster of the last frame.
    pub roster: Option<Arc<[RosterEntry]>>,
    pub version: i32,
}

impl ReplayWork {
    /// Simulates the next ticks, from tick `from` on.
    pub(crate) fn go_on(
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
        // Segments that are done are dropped.
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
        // The segments after it have their turn later.
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
