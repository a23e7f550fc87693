//! Removal of old history: whole checkpoints with the rows after them are cut off in memory, and the rows are deleted
//! bit by bit, so that commits do not wait for long.

use super::track::WorldTrack;
use super::{Log, now_ms};
use crate::durable::store::{Retention, StoreError, StoreUsage, WorldKey};
use rusqlite::params;
use std::ops::Range;

/// Number of rows checked in one call of [`Log::cut`], so that commits do not wait for long.
const CUT_ROWS: usize = 20_000;

impl WorldTrack {
    /// Drops the oldest of two or more checkpoints. Returns the ids from it to the next; rows of this world among them
    /// are deleted.
    fn cut_first(&mut self) -> Option<Range<i64>> {
        let first = self.places.pop_front()?;
        Some(first.id..self.places.front()?.id)
    }
}

/// The same ranges in order and apart from each other.
fn joined(mut ranges: Vec<Range<i64>>) -> Vec<Range<i64>> {
    ranges.sort_unstable_by_key(|r| r.start);
    let mut out: Vec<Range<i64>> = Vec::with_capacity(ranges.len());
    for range in ranges {
        match out.last_mut() {
            Some(last) if range.start <= last.end => last.end = last.end.max(range.end),
            _ => out.push(range),
        }
    }
    out
}

impl Log {
    /// Forgets a world, including entries still to be written; its rows are deleted by the next cuts.
    ///
    /// # Errors
    /// It could not be done.
    pub fn forget(&mut self, world: WorldKey) -> Result<(), StoreError> {
        let sql = "DELETE FROM checkpoints WHERE world = ?1";
        let done = self.db.execute(sql, [world.0 as i64]);
        done.map_err(|e| self.fault(&e))?;
        let track = self.tracks.remove(&world);
        let first = track.and_then(|t| t.places.front().map(|p| p.id));
        self.unswept.push(first.unwrap_or(0)..self.next_id);
        self.known.remove(&world);
        self.ends.remove(&world);
        Ok(())
    }

    /// Cuts off old history, and deletes some of the rows that were cut off.
    ///
    /// # Errors
    /// It could not be done.
    pub fn cut(&mut self, limits: &Retention) -> Result<StoreUsage, StoreError> {
        self.cut_each(limits);
        let history_bytes = self.cut_largest(limits.total_bytes);
        self.unswept = joined(std::mem::take(&mut self.unswept));
        self.unswept = self.sweep().map_err(|e| self.fault(&e))?;
        Ok(StoreUsage {
            history_bytes,
            checkpoints: self.tracks.values().map(|t| t.places.len()).sum(),
            unswept: !self.unswept.is_empty(),
        })
    }

    /// Cuts off the history of each world that is too old or too large.
    fn cut_each(&mut self, limits: &Retention) {
        let age = i64::try_from(limits.age.as_millis()).unwrap_or(i64::MAX);
        let oldest = now_ms().saturating_sub(age);
        for track in self.tracks.values_mut() {
            // Entries after the first checkpoint are as old as the second one.
            while let Some(second) = track.places.get(1)
                && (second.time_ms <= oldest || track.held() > limits.world_bytes)
            {
                self.unswept.extend(track.cut_first());
            }
        }
    }

    /// Cuts off history above the total limit, starting with the largest world. Returns the remaining bytes.
    fn cut_largest(&mut self, total_bytes: u64) -> u64 {
        let mut total: u64 = self.tracks.values().map(WorldTrack::held).sum();
        while total > total_bytes {
            let largest = self.tracks.values_mut().filter(|t| t.places.len() > 1);
            let Some(track) = largest.max_by_key(|t| t.held()) else {
                break;
            };
            total -= track.held();
            self.unswept.extend(track.cut_first());
            total += track.held();
        }
        total
    }

    /// Deletes rows that no world needs any more, and their entries in the table of checkpoints. Returns ranges that it
    /// has not yet checked.
    fn sweep(&mut self) -> rusqlite::Result<Vec<Range<i64>>> {
        let (old, rest) = self.not_needed()?;
        if old.is_empty() {
            return Ok(rest);
        }
        let tx = self.db.transaction()?;
        for table in ["log", "checkpoints"] {
            let mut delete = tx.prepare_cached(&format!("DELETE FROM {table} WHERE id = ?1"))?;
            for id in &old {
                delete.execute([id])?;
            }
        }
        tx.commit()?;
        Ok(rest)
    }

    /// Some rows that no world needs any more, and ranges that may contain others.
    fn not_needed(&self) -> rusqlite::Result<(Vec<i64>, Vec<Range<i64>>)> {
        let sql = "SELECT id, world FROM log WHERE id >= ?1 AND id < ?2 ORDER BY id LIMIT ?3";
        let mut found = self.db.prepare_cached(sql)?;
        let (mut old, mut rest) = (Vec::new(), Vec::new());
        let mut left = CUT_ROWS;
        for range in &self.unswept {
            if left == 0 {
                rest.push(range.clone());
                continue;
            }
            let mut rows = found.query(params![range.start, range.end, left as i64])?;
            let mut next = range.end;
            while let Some(row) = rows.next()? {
                let (id, world): (i64, i64) = (row.get(0)?, row.get(1)?);
                // Each world keeps the rows after its oldest checkpoint.
                let track = self.tracks.get(&WorldKey(world as u64));
                let kept = track.and_then(|t| t.places.front());
                if kept.is_none_or(|kept| id < kept.id) {
                    old.push(id);
                }
                left -= 1;
                if left == 0 {
                    next = id + 1;
                }
            }
            if next < range.end {
                rest.push(next..range.end);
            }
        }
        Ok((old, rest))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::durable::store::{StoreEntry, StoreItem};
    use crate::testing::Temporary;
    use bytes::Bytes;
    use std::time::Duration;

    /// Many worlds rest, and their rows are older than all that a busy world writes and cuts off.
    #[test]
    fn what_others_keep_does_not_hide_what_can_be_deleted() {
        const RESTING: u64 = 100;
        let dir = Temporary::new();
        let mut log = Log::open(&dir.0.join("log.sqlite")).unwrap();
        let entry = |world, tick, item| StoreEntry {
            world: WorldKey(world),
            tick,
            item,
        };
        let checkpoint = |world, tick| {
            let bytes = Bytes::from_static(&[0; 100]);
            entry(
                world,
                tick,
                StoreItem::Checkpoint {
                    bytes,
                    after_gap: false,
                },
            )
        };
        (0..=RESTING).for_each(|world| log.know(WorldKey(world)));
        let mut rows = 0;
        let mut commit = |log: &mut Log, entries: Vec<StoreEntry>| {
            rows += entries.len();
            log.commit(&entries).unwrap();
        };
        commit(&mut log, (0..=RESTING).map(|w| checkpoint(w, 0)).collect());
        for tick in 1..=CUT_ROWS as u64 / RESTING {
            let hashes = (0..RESTING).map(|w| entry(w, tick, StoreItem::Hash(tick)));
            commit(&mut log, hashes.collect());
        }
        for tick in 1..=20 {
            let hash = entry(RESTING, tick, StoreItem::Hash(tick));
            commit(&mut log, vec![hash, checkpoint(RESTING, tick)]);
        }
        let limits = Retention {
            age: Duration::from_secs(3600),
            world_bytes: u64::MAX,
            total_bytes: 0,
        };
        let count = |log: &Log| {
            let sql = "SELECT COUNT(*) FROM log";
            log.db.query_row(sql, [], |r| r.get::<_, i64>(0)).unwrap() as usize
        };
        assert_eq!(count(&log), rows);
        let mut calls = 1;
        while log.cut(&limits).unwrap().unswept {
            calls += 1;
        }
        assert_eq!(count(&log), rows - 2 * 20, "after {calls} calls");
        // All at once, as left by a process that ended before it had swept.
        log.unswept.push(0..log.next_id);
        assert!(log.cut(&limits).unwrap().unswept, "a call is bounded");
        assert!(!log.cut(&limits).unwrap().unswept);
        assert_eq!(count(&log), rows - 2 * 20);
    }
}
