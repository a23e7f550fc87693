//! Reads histories back: for each world, a checkpoint and everything written after it, up to the first damaged or
//! missing place.

use super::Log;
use super::row::{CHECKPOINT, GROUP, LogRow};
use super::track::CheckpointPlace;
use crate::durable::store::{Loss, Remedy, StoreError, StoredHistory, WorldKey};
use bytes::Bytes;
use rusqlite::OptionalExtension;
use std::collections::{HashMap, VecDeque};

/// Damaged places in one file after which the rest of it is given up.
const MAX_DAMAGED: u32 = 1000;

/// One world while the log is read. The rows are authoritative, because they have checksums; the table of checkpoints
/// has none and only gives the starting point.
struct Reading {
    /// First row to read.
    from: i64,
    /// Checkpoints after this tick are ignored.
    at: Option<u64>,
    /// Session of the checkpoint and number of the next group; `None` until it is read.
    next: Option<(i64, i64)>,
    history: StoredHistory,
    ended: bool,
    /// Whether there is a damaged place after its last row. Nothing in a damaged row can be trusted, not even its
    /// world.
    doubtful: bool,
    /// Its last intact row.
    last: i64,
}

impl Reading {
    fn new(from: i64, at: Option<u64>) -> Self {
        Self {
            from,
            at,
            next: None,
            history: StoredHistory::default(),
            ended: false,
            doubtful: false,
            last: 0,
        }
    }

    /// Takes an intact row of this world.
    fn take(&mut self, row: &LogRow) {
        if row.id < self.from {
            return;
        }
        if row.kind == CHECKPOINT {
            // This includes a checkpoint that the table has lost. Once it is found, nothing before it matters.
            if self.at.is_none_or(|at| row.tick <= at) {
                *self = Self::new(self.from, self.at);
                self.last = row.id;
                self.next = Some((row.session, row.seq));
                self.history.checkpoint = Some((row.tick, row.bytes.clone()));
            }
            return;
        }
        self.last = row.id;
        let Some((session, next)) = self.next.filter(|_| !self.ended) else {
            return;
        };
        if row.session != session {
            self.ended = true;
        } else if row.kind == GROUP {
            match row.frames().filter(|_| row.seq == next) {
                Some(frames) => {
                    self.history.entries.extend(frames);
                    self.next = Some((session, next + 1));
                    self.doubtful = false;
                }
                None => {
                    self.ended = true;
                    self.lose("a part of its log is damaged or was not written");
                }
            }
        }
    }

    /// Notes one or more unreadable rows, up to this one.
    fn doubt(&mut self, id: i64) {
        self.doubtful |= id > self.from && !self.ended;
    }

    fn lose(&mut self, why: &str) {
        self.history.losses.push(Loss {
            after_tick: self.history.last_tick(),
            why: why.to_owned(),
        });
    }

    /// `latest`: the latest checkpoint known; `end`: its last row, if noted.
    fn end(mut self, latest: CheckpointPlace, end: Option<i64>) -> StoredHistory {
        let (session, next) = self.next.unwrap_or_default();
        let short = session < latest.session
            || session == latest.session && next < latest.seq
            || self.history.last_tick() < Some(latest.tick);
        if self.history.losses.is_empty() {
            if short {
                self.lose("its latest checkpoint is damaged");
            } else if self.doubtful {
                self.lose("a part of the log is damaged that may have been its end");
            } else if self.at.is_none() && end.is_some_and(|end| self.last < end) {
                // Pages that SQLite no longer knows cause no error.
                self.lose("the end of its log is missing");
            }
        }
        self.history
    }
}

/// One world whose history is requested.
struct Asked {
    world: WorldKey,
    /// Its candidates for the starting checkpoint that were not tried yet, from the oldest to the latest.
    candidates: VecDeque<CheckpointPlace>,
    /// The latest of them.
    latest: Option<CheckpointPlace>,
    /// Its last row, if that is noted and valid.
    end: Option<i64>,
    found: Option<StoredHistory>,
}

impl Asked {
    fn history(self) -> StoredHistory {
        let missing = || Loss {
            after_tick: None,
            why: "no checkpoint of it is whole".to_owned(),
        };
        self.found.unwrap_or_else(|| {
            let was_there = self.latest.is_some() || self.end.is_some();
            StoredHistory {
                losses: was_there.then(missing).into_iter().collect(),
                ..StoredHistory::default()
            }
        })
    }
}

impl Log {
    /// For each world, its latest intact state and everything written after it, or from the last checkpoint at or
    /// before the tick `at`, if given.
    ///
    /// # Errors
    /// Nothing can be read, or another program holds the file exclusively.
    pub fn read(
        &self,
        worlds: &[WorldKey],
        at: Option<u64>,
    ) -> Result<Vec<StoredHistory>, StoreError> {
        let mut asked: Vec<Asked> = worlds.iter().map(|w| self.asked(*w, at)).collect();
        while self.read_candidates(&mut asked, at)? {}
        Ok(asked.into_iter().map(Asked::history).collect())
    }

    fn asked(&self, world: WorldKey, at: Option<u64>) -> Asked {
        let places = self.tracks.get(&world).map(|t| &t.places);
        let places = places.into_iter().flatten().copied();
        let candidates: VecDeque<CheckpointPlace> = places
            .filter(|p| at.is_none_or(|at| p.tick <= at))
            .collect();
        Asked {
            world,
            latest: candidates.back().copied(),
            candidates,
            end: self.ends.get(&world).copied().filter(|_| at.is_none()),
            found: None,
        }
    }

    /// Reads the rows once, with the next candidate of each world that has no history yet. Returns false if no
    /// candidate was left.
    fn read_candidates(&self, asked: &mut [Asked], at: Option<u64>) -> Result<bool, StoreError> {
        let mut open: HashMap<WorldKey, (&mut Asked, Reading)> = HashMap::new();
        for one in asked.iter_mut().filter(|a| a.found.is_none()) {
            if let Some(place) = one.candidates.pop_back() {
                open.insert(one.world, (one, Reading::new(place.id, at)));
            }
        }
        let Some(from) = open.values().map(|(_, r)| r.from).min() else {
            return Ok(false);
        };
        self.scan(from, &mut |id, row| match row {
            Some(row) => {
                if let Some((_, reading)) = open.get_mut(&row.world) {
                    reading.take(row);
                }
            }
            None => open.values_mut().for_each(|(_, r)| r.doubt(id)),
        })?;
        for (one, reading) in open.into_values() {
            // If its checkpoint is missing, try the previous one.
            if reading.history.checkpoint.is_some() {
                one.found = one.latest.map(|latest| reading.end(latest, one.end));
            }
        }
        Ok(true)
    }

    /// Calls `f` with the number of each row from `from` and the row, or `None` if the row is damaged. For an
    /// unreadable place, the last number is given.
    ///
    /// # Errors
    /// Too many places cannot be read, or another program holds the file exclusively.
    pub(super) fn scan(
        &self,
        from: i64,
        f: &mut dyn FnMut(i64, Option<&LogRow>),
    ) -> Result<(), StoreError> {
        let (mut from, mut step, mut damaged) = (from, 1, 0);
        let mut before: Option<StoreError> = None;
        while from < self.next_id {
            let mut last = from - 1;
            let Err(error) = self.read_rows(&mut last, f) else {
                break;
            };
            if last >= from {
                (step, before) = (1, None); // another place
            }
            from = last + 1;
            let fault = self.fault(&error);
            if fault.remedy(before.as_ref()) == Remedy::Retry {
                before = Some(fault);
                continue;
            }
            damaged += 1;
            if damaged > MAX_DAMAGED || matches!(fault, StoreError::Busy(_)) {
                return Err(fault);
            }
            // Skip one row and, if that is not enough, twice as many each time.
            from += step;
            step *= 2;
            before = None;
            f(from - 1, None);
        }
        Ok(())
    }

    /// Reads rows after `last`, which is updated to the last one read.
    fn read_rows(
        &self,
        last: &mut i64,
        f: &mut dyn FnMut(i64, Option<&LogRow>),
    ) -> rusqlite::Result<()> {
        let sql = "SELECT * FROM log WHERE id > ?1 ORDER BY id";
        let mut all = self.db.prepare_cached(sql)?;
        let mut rows = all.query([*last])?;
        while let Some(row) = rows.next()? {
            let (row, whole) = LogRow::read(row)?;
            // Rows out of order would be read again and again.
            if row.id <= *last {
                return Err(rusqlite::Error::InvalidQuery);
            }
            *last = row.id;
            f(row.id, whole.then_some(&row));
        }
        Ok(())
    }

    /// The latest checkpoint of a world: its tick and its bytes; `None` if none is intact.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn checkpoint(&self, world: WorldKey) -> Result<Option<(u64, Bytes)>, StoreError> {
        let Some(place) = self.tracks.get(&world).and_then(|t| t.places.back()) else {
            return Ok(None);
        };
        let sql = "SELECT * FROM log WHERE id = ?1";
        let read = self.db.query_row(sql, [place.id], LogRow::read).optional();
        let (row, whole) = match read.map_err(|e| self.fault(&e))? {
            Some(read) => read,
            None => return Ok(None),
        };
        // The table of its place has no checksum, so the row may belong to another world.
        let its_own = whole && row.world == world && row.kind == CHECKPOINT;
        Ok(its_own.then_some((row.tick, row.bytes)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::row::{HASH, INPUT, frame};
    use super::*;
    use crate::durable::store::{StoreEntry, StoreItem};
    use crate::testing::Temporary;
    use proptest::prelude::*;

    fn row(id: i64, kind: u8, (session, seq): (i64, i64), bytes: Vec<u8>) -> LogRow {
        LogRow {
            id,
            world: WorldKey(1),
            session,
            seq,
            kind,
            tick: id as u64,
            bytes: bytes.into(),
        }
    }

    /// The bytes of a group of frames.
    fn group(frames: &[(u8, u64, Vec<u8>)]) -> Vec<u8> {
        let mut out = Vec::new();
        for (kind, tick, bytes) in frames {
            frame(&mut out, *kind, *tick, bytes);
        }
        out
    }

    proptest! {
        /// `PROPTEST_CASES` sets their number.
        #[test]
        fn rows_of_any_bytes_are_read_or_lost(
            rows in proptest::collection::vec(
                (
                    0u8..4,
                    (0i64..3, 0i64..4),
                    proptest::collection::vec(
                        (0u8..4, any::<u64>(), proptest::collection::vec(any::<u8>(), 0..20)),
                        0..4,
                    ),
                    proptest::option::of((any::<usize>(), any::<u8>())),
                ),
                0..8,
            ),
            at in proptest::option::of(0u64..8),
        ) {
            let mut reading = Reading::new(0, at);
            for (i, (kind, place, frames, damage)) in rows.into_iter().enumerate() {
                let mut bytes = group(&frames);
                if let (Some((at, to)), false) = (damage, bytes.is_empty()) {
                    let n = bytes.len();
                    bytes[at % n] = to;
                } else if kind == GROUP {
                    let known = |f: &(u8, u64, Vec<u8>)| f.0 == INPUT || f.0 == HASH && f.2.len() == 8;
                    let read = row(0, kind, place, bytes.clone()).frames();
                    prop_assert_eq!(read.is_some(), frames.iter().all(known));
                }
                reading.take(&row(i as i64, kind, place, bytes));
            }
            let history = reading.history;
            prop_assert!(history.checkpoint.is_some() || history.entries.is_empty());
        }
    }

    /// SQLite reports an interrupted read and a temporary failure in the same way.
    #[test]
    fn a_read_that_fails_once_loses_no_row() {
        let dir = Temporary::new();
        let mut log = Log::open(&dir.0.join("log.sqlite")).unwrap();
        log.know(WorldKey(1));
        let checkpoint = |tick| StoreEntry {
            world: WorldKey(1),
            tick,
            item: StoreItem::Checkpoint {
                bytes: Bytes::from_static(&[0; 20_000]),
                after_gap: false,
            },
        };
        (0..20).for_each(|tick| log.commit(&[checkpoint(tick)]).unwrap());
        let interrupt = log.db.get_interrupt_handle();
        let mut seen = Vec::new();
        log.scan(0, &mut |id, row| {
            seen.push((id, row.is_some()));
            if id % 7 == 0 {
                interrupt.interrupt();
            }
        })
        .unwrap();
        let all: Vec<_> = (1..=20).map(|id| (id, true)).collect();
        assert_eq!(seen, all);
    }
}
