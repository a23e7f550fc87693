//! The index in memory of each world in the log: the places of its checkpoints, and its next row.

use super::row::{CHECKPOINT, LogRow};
use super::track::CheckpointPlace;
use super::{Log, now_ms};
use crate::durable::store::{StoreError, WorldKey};
use std::collections::BTreeMap;

/// Number above that of any row: a million a second for ten thousand years.
const MAX_ID: i64 = 1 << 58;

/// Checkpoints by the number of their row.
type FoundCheckpoints = BTreeMap<i64, (WorldKey, CheckpointPlace)>;

impl Log {
    /// Reads the places of the checkpoints, and the free numbers.
    ///
    /// # Errors
    /// The log is damaged or cannot be read.
    pub(super) fn load(&mut self) -> Result<(), StoreError> {
        self.next_id = self.last_id()? + 1;
        let mut found = FoundCheckpoints::new();
        if self.list_checkpoints(&mut found).is_err() {
            self.find_checkpoints(&mut found)?;
        }
        self.take_places(found);
        Ok(())
    }

    /// Finds the checkpoints of worlds for which the table has lost all. Otherwise their rows would be deleted as
    /// belonging to no world.
    ///
    /// # Errors
    /// The log is damaged or cannot be read.
    pub(super) fn find_again(&mut self, worlds: &[WorldKey]) -> Result<(), StoreError> {
        let mut found = FoundCheckpoints::new();
        self.find_checkpoints(&mut found)?;
        found.retain(|_, (world, _)| worlds.contains(world));
        self.take_places(found);
        Ok(())
    }

    fn take_places(&mut self, found: FoundCheckpoints) {
        for (world, place) in found.into_values() {
            self.session = self.session.max(place.session.saturating_add(1));
            let track = self.tracks.entry(world).or_default();
            track.written = track.written.max(place.bytes_before);
            track.places.push_back(place);
            self.known.insert(world);
        }
    }

    /// The largest number of a row in either table; 0 if there is none.
    fn last_id(&self) -> Result<i64, StoreError> {
        let last = |table: &str| {
            let sql = format!("SELECT COALESCE(MAX(id), 0) FROM {table}");
            self.db.query_row(&sql, [], |r| r.get::<_, i64>(0))
        };
        let last = last("log").and_then(|log| Ok(log.max(last("checkpoints")?)));
        let last = last.map_err(|e| self.fault(&e))?;
        if last > MAX_ID {
            let place = self.path.display();
            return Err(StoreError::Damaged(format!("{place}: row {last}")));
        }
        Ok(last)
    }

    /// Reads the table of checkpoints, as far as it can be read.
    fn list_checkpoints(&self, found: &mut FoundCheckpoints) -> rusqlite::Result<()> {
        let mut all = self.db.prepare("SELECT * FROM checkpoints ORDER BY id")?;
        let mut rows = all.query([])?;
        while let Some(row) = rows.next()? {
            let place = CheckpointPlace {
                id: row.get(0)?,
                session: row.get(2)?,
                seq: row.get(3)?,
                tick: row.get::<_, i64>(4)? as u64,
                time_ms: row.get(5)?,
                bytes_before: row.get::<_, i64>(6)? as u64,
            };
            found.insert(place.id, (WorldKey(row.get::<_, i64>(1)? as u64), place));
        }
        Ok(())
    }

    /// Finds checkpoints by reading all rows. Their time and the bytes before them are unknown, so they count as
    /// written at this start.
    fn find_checkpoints(&self, found: &mut FoundCheckpoints) -> Result<(), StoreError> {
        self.scan(0, &mut |_, row: Option<&LogRow>| {
            let Some(row) = row.filter(|r| r.kind == CHECKPOINT) else {
                return;
            };
            let place = CheckpointPlace {
                id: row.id,
                session: row.session,
                seq: row.seq,
                tick: row.tick,
                time_ms: now_ms(),
                bytes_before: 0,
            };
            found.insert(row.id, (row.world, place));
        })
    }
}
