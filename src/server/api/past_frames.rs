//! Frames of the past of a world: it is simulated again, and its frames are sent as they are computed.

use super::long;
use crate::progress::WorkProgress;
use crate::tick::journal::JournalSegment;
use crate::tick::replay::{Replay, ReplayError};
use crate::tick::scene::Scene;
use crate::workers::Turn;
use sinew_wire::frame::{roster, world_frame};
use sinew_wire::pb;
use sinew_wire::status::Fault;
use sinew_wire::types::{RosterEntry, ViewSpec};
use std::sync::Arc;
use std::time::Instant;

/// The part of the past to show.
pub(super) struct PastPart {
    /// Last part of the name of the world.
    pub world: Arc<str>,
    /// The segments that lead to it.
    pub past: Vec<Arc<JournalSegment>>,
    /// First tick and last.
    pub ticks: (u64, u64),
    /// The view.
    pub view: ViewSpec,
}

/// Sends the frames of a part of the past, and returns those that are left at its end.
///
/// # Errors
/// A state differs from the recorded one; the frames have no reader any more.
pub(super) fn read(
    part: &PastPart,
    out: long::MessageSender<pb::ReadHistoryResponse>,
    progress: &WorkProgress,
    turn: &Turn,
) -> Result<pb::ReadHistoryResponse, Fault> {
    let (first, last) = part.ticks;
    let mut replay = Replay::of(&part.past)?;
    let begun = replay.scene.world().tick();
    let mut frames = PastFrameStream {
        part,
        out,
        turn,
        roster: Arc::new([]),
        version: 0,
        ready: pb::ReadHistoryResponse::default(),
        bytes: 0,
        since: Instant::now(),
    };
    let mut failed = None;
    let mut each = |scene: &Scene| {
        let tick = scene.world().tick();
        progress.tell((tick - begun) as f64, (last - begun + 1) as f64);
        if turn.stop() {
            return false;
        }
        if tick < first || !tick.is_multiple_of(u64::from(part.view.divisor)) {
            return true;
        }
        failed = frames.take(scene).err();
        failed.is_none()
    };
    let done = if begun == first && !each(&replay.scene) {
        Err(ReplayError::Stopped)
    } else {
        replay.through_past(&part.past, last, &mut each)
    };
    match (done, failed) {
        (_, Some(fault)) => Err(fault),
        (Ok(()), None) => Ok(frames.ready),
        (Err(ReplayError::Stopped), None) => Err(Turn::gone()),
        (Err(why), None) => Err(Fault::DataLoss {
            reason: "REPLAY_DIFFERS",
            message: why.to_string(),
        }),
    }
}

/// Frames on their way to a client, a few at a time.
struct PastFrameStream<'a> {
    part: &'a PastPart,
    out: long::MessageSender<pb::ReadHistoryResponse>,
    turn: &'a Turn,
    roster: Arc<[RosterEntry]>,
    /// Of the roster; 0: none yet.
    version: i32,
    ready: pb::ReadHistoryResponse,
    bytes: usize,
    since: Instant,
}

impl PastFrameStream<'_> {
    fn take(&mut self, scene: &Scene) -> Result<(), Fault> {
        let now = scene.roster();
        let anew = self.version == 0 || now != self.roster;
        if anew {
            self.send()?;
            self.version += 1;
            self.roster = now;
        }
        let shown = (Arc::clone(&self.roster), self.version);
        let snapshot = scene.snapshot(&self.part.world, shown);
        if anew {
            self.ready.roster = Some(roster(&snapshot, &self.part.view));
        }
        let frame = world_frame(&snapshot, &self.part.view);
        self.bytes += long::memory(&frame);
        self.ready.frames.push(frame);
        if self.bytes >= long::PART.0 || self.since.elapsed() >= long::PART.1 {
            self.send()?;
        }
        Ok(())
    }

    /// Sends the collected frames when the client has room for them.
    fn send(&mut self) -> Result<(), Fault> {
        self.bytes = 0;
        let ready = std::mem::take(&mut self.ready);
        if !ready.frames.is_empty() {
            long::hand_over(&self.out, ready, self.turn)?;
        }
        self.since = Instant::now();
        Ok(())
    }
}
