//! Replays the recorded past of a world.

use super::journal::{JournalItem, JournalSegment};
use super::scene::{RecordItem, RecordReader, Scene, Unreadable};
use crate::engine::Planning;
use sinew_wire::status::Fault;
use std::sync::Arc;

/// Why a world differs from its record.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReplayError {
    /// Its state differs.
    #[error("after tick {tick} the state has hash {found:016x}, recorded was {expected:016x}")]
    Differs {
        /// The first such tick.
        tick: u64,
        /// Hash that was recorded.
        expected: u64,
        /// Hash of the state.
        found: u64,
    },
    /// A record cannot be read, or belongs to another time.
    #[error("before tick {tick}: {why}")]
    Record {
        /// Ticks done.
        tick: u64,
        /// Reason.
        why: &'static str,
    },
    /// It was told to stop.
    #[error("it was stopped")]
    Stopped,
}

impl From<Unreadable> for ReplayError {
    fn from(e: Unreadable) -> Self {
        Self::Record { tick: 0, why: e.0 }
    }
}

/// A scene that replays records.
#[derive(Debug)]
pub struct Replay {
    /// The scene.
    pub scene: Scene,
    reader: RecordReader,
    /// World time that the clock has skipped until now, s.
    lost: f64,
    threads: Option<usize>,
    /// Number of hashes compared.
    pub compared: u64,
}

impl Replay {
    /// Begins at a checkpoint.
    pub fn new(scene: Scene) -> Self {
        Self {
            scene,
            reader: RecordReader::default(),
            lost: 0.0,
            threads: None,
            compared: 0,
        }
    }

    /// Begins at the first of the segments of a past.
    ///
    /// # Errors
    /// There is none.
    pub fn of(past: &[Arc<JournalSegment>]) -> Result<Self, Fault> {
        let first = past.first();
        let first = first.ok_or_else(|| Fault::Internal("an empty past".into()))?;
        Ok(Self::new(first.scene()?))
    }

    /// Steps with this number of threads. The result does not depend on it.
    pub fn with_threads(mut self, threads: usize) -> Self {
        self.threads = Some(threads);
        self.scene.set_threads(threads);
        self
    }

    /// Goes through the segments of a past, of which the first is where this replay began, like [`Self::through`].
    /// Where the world was put into another state, so is the scene; the players of live motion were not continued then.
    ///
    /// # Errors
    /// Same as [`Self::through`].
    pub fn through_past(
        &mut self,
        past: &[Arc<JournalSegment>],
        until: u64,
        each: &mut dyn FnMut(&Scene) -> bool,
    ) -> Result<(), ReplayError> {
        for (i, segment) in past.iter().enumerate() {
            let (tick, expected) = (segment.start.tick(), segment.start.hash());
            if i > 0 && segment.restored && tick <= until {
                let found = self.scene.world().state_hash();
                if (self.scene.world().tick(), found) != (tick, expected) {
                    return Err(ReplayError::Differs {
                        tick,
                        expected,
                        found,
                    });
                }
                let why = "a checkpoint that cannot be read";
                let scene = segment.scene();
                self.scene = scene.map_err(|_| ReplayError::Record { tick, why })?;
                if let Some(threads) = self.threads {
                    self.scene.set_threads(threads);
                }
            }
            self.through(&segment.entries, until, each)?;
        }
        Ok(())
    }

    /// Goes through the entries logged after the checkpoint, up to the state after tick `until`; changes after that
    /// tick are not applied. `each` sees the scene after each tick, and returns whether to continue.
    ///
    /// # Errors
    /// The first difference from the record; or `each` stopped it.
    pub fn through<'a>(
        &mut self,
        logged: impl IntoIterator<Item = &'a JournalItem>,
        until: u64,
        each: &mut dyn FnMut(&Scene) -> bool,
    ) -> Result<(), ReplayError> {
        for entry in logged {
            let now = self.scene.world().tick();
            match entry {
                // Written twice, because a checkpoint came in between.
                JournalItem::Record(r) if r.seq <= self.scene.seq() => {}
                JournalItem::Record(r) => {
                    let why = match (r.seq == self.scene.seq() + 1, r.tick == now) {
                        (true, true) => None,
                        (false, _) => Some("a record is missing"),
                        (_, false) => Some("a record of another tick"),
                    };
                    if let Some(why) = why {
                        return Err(ReplayError::Record { tick: now, why });
                    }
                    if now >= until {
                        return Ok(());
                    }
                    self.record(&r.bytes, &r.definitions).map_err(|e| match e {
                        ReplayError::Record { why, .. } => ReplayError::Record { tick: now, why },
                        e => e,
                    })?;
                    self.scene.passed(r.seq);
                }
                JournalItem::Hash(tick, _) if *tick < now => {}
                JournalItem::Hash(tick, hash) => {
                    if *tick > now + 1 {
                        let why = "a tick is missing";
                        return Err(ReplayError::Record { tick: now, why });
                    }
                    if *tick > now {
                        if now >= until {
                            return Ok(());
                        }
                        self.scene.sample(self.lost);
                        self.scene.step(Planning::InTick);
                    }
                    let found = self.scene.world().state_hash();
                    self.compared += 1;
                    if found != *hash {
                        return Err(ReplayError::Differs {
                            tick: *tick,
                            expected: *hash,
                            found,
                        });
                    }
                    if *tick > now && !each(&self.scene) {
                        return Err(ReplayError::Stopped);
                    }
                }
            }
        }
        Ok(())
    }

    fn record(
        &mut self,
        bytes: &[u8],
        definitions: &[sinew_physics::saved::Definition],
    ) -> Result<(), ReplayError> {
        let Self {
            scene,
            reader,
            lost,
            ..
        } = self;
        reader.read(bytes, definitions, |item| {
            match item {
                // A change that was refused then is refused now.
                RecordItem::Input(input) => drop(scene.apply(*input)),
                RecordItem::Frame(player, frame, at) => {
                    scene.take_frame(player, *frame, at);
                }
                RecordItem::Tick(left_out) => *lost = left_out,
                RecordItem::Late(figure, late) => scene.delay_plans(figure, late),
            }
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests;
