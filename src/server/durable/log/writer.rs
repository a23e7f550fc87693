//! Commits: the entries of all worlds become rows, and either all of them are on disk or none.

use super::row::{CHECKPOINT, GROUP, HASH, INPUT, LogRow, frame};
use super::track::{CheckpointPlace, WorldTrack};
use super::{Log, now_ms};
use crate::durable::store::{StoreEntry, StoreError, StoreItem, WorldKey};
use bytes::Bytes;
use rusqlite::params;
use std::collections::BTreeMap;

/// Rows of one commit in their order.
struct Rows {
    next_id: i64,
    session: i64,
    out: Vec<LogRow>,
}

/// The part of one commit that belongs to one world.
struct CommitPart {
    world: WorldKey,
    /// As in [`WorldTrack`], once this is on disk.
    written: u64,
    /// Likewise.
    next: Option<i64>,
    /// Checkpoints among its rows.
    places: Vec<CheckpointPlace>,
    /// Frames that are not in a row yet, and the tick of the first.
    group: Option<(u64, Vec<u8>)>,
}

impl CommitPart {
    /// Continues after the indexed rows of the world.
    fn behind(world: WorldKey, track: Option<&WorldTrack>) -> Self {
        Self {
            world,
            written: track.map_or(0, |t| t.written),
            next: track.and_then(|t| t.next),
            places: Vec::new(),
            group: None,
        }
    }

    fn push(&mut self, rows: &mut Rows, kind: u8, tick: u64, bytes: Bytes) {
        self.written += bytes.len() as u64;
        rows.out.push(LogRow {
            id: rows.next_id,
            world: self.world,
            session: rows.session,
            seq: self.next.unwrap_or(0),
            kind,
            tick,
            bytes,
        });
        rows.next_id += 1;
    }

    /// Makes a row of the collected frames.
    fn end_group(&mut self, rows: &mut Rows) {
        if let Some((tick, bytes)) = self.group.take() {
            self.push(rows, GROUP, tick, bytes.into());
            self.next = self.next.map(|n| n + 1);
        }
    }

    /// A gap before it is marked by a number that no group has.
    fn checkpoint(&mut self, rows: &mut Rows, tick: u64, bytes: &Bytes, after_gap: bool) {
        self.end_group(rows);
        let seq = self.next.map_or(0, |n| n + i64::from(after_gap));
        self.next = Some(seq);
        self.places.push(CheckpointPlace {
            id: rows.next_id,
            session: rows.session,
            seq,
            tick,
            time_ms: now_ms(),
            bytes_before: self.written,
        });
        self.push(rows, CHECKPOINT, tick, bytes.clone());
    }

    /// # Errors
    /// There is no checkpoint for it to follow.
    fn frame(&mut self, tick: u64, kind: u8, bytes: &[u8]) -> Result<(), StoreError> {
        if self.next.is_none() {
            return Err(StoreError::Io(format!(
                "world {}: input of tick {tick} without a checkpoint before it",
                self.world
            )));
        }
        let (_, group) = self.group.get_or_insert((tick, Vec::new()));
        frame(group, kind, tick, bytes);
        Ok(())
    }
}

impl Log {
    /// Writes entries: all or none. Those of deleted worlds are left out.
    ///
    /// # Errors
    /// They could not be written.
    pub fn commit(&mut self, entries: &[StoreEntry]) -> Result<(), StoreError> {
        let mut rows = Rows {
            next_id: self.next_id,
            session: self.session,
            out: Vec::new(),
        };
        let parts = self.parts(entries, &mut rows)?;
        self.insert(&rows, &parts).map_err(|e| self.fault(&e))?;
        self.next_id = rows.next_id;
        self.ends.extend(rows.out.iter().map(|r| (r.world, r.id)));
        for part in parts {
            let track = self.tracks.entry(part.world).or_default();
            track.written = part.written;
            track.next = part.next;
            track.places.extend(part.places);
        }
        self.note_end();
        Ok(())
    }

    /// Makes rows of entries, by the order of entries and then of worlds.
    fn parts(
        &self,
        entries: &[StoreEntry],
        rows: &mut Rows,
    ) -> Result<Vec<CommitPart>, StoreError> {
        let mut parts: BTreeMap<WorldKey, CommitPart> = BTreeMap::new();
        for entry in entries.iter().filter(|e| self.known.contains(&e.world)) {
            let (world, tick) = (entry.world, entry.tick);
            let part = parts
                .entry(world)
                .or_insert_with(|| CommitPart::behind(world, self.tracks.get(&world)));
            match &entry.item {
                StoreItem::Checkpoint { bytes, after_gap } => {
                    part.checkpoint(rows, tick, bytes, *after_gap);
                }
                StoreItem::Input(bytes) => part.frame(tick, INPUT, bytes)?,
                StoreItem::Hash(hash) => part.frame(tick, HASH, &hash.to_le_bytes())?,
            }
        }
        let mut parts: Vec<CommitPart> = parts.into_values().collect();
        parts.iter_mut().for_each(|part| part.end_group(rows));
        Ok(parts)
    }

    fn insert(&mut self, rows: &Rows, parts: &[CommitPart]) -> rusqlite::Result<()> {
        let tx = self.db.transaction()?;
        {
            let sql = "INSERT INTO log VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)";
            let mut insert = tx.prepare_cached(sql)?;
            for r in &rows.out {
                let (world, tick) = (r.world.0 as i64, r.tick as i64);
                let bytes = &r.bytes[..];
                insert.execute(params![
                    r.id,
                    world,
                    r.session,
                    r.seq,
                    r.kind,
                    tick,
                    r.sum(),
                    bytes
                ])?;
            }
            let sql = "INSERT INTO checkpoints VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)";
            let mut insert = tx.prepare_cached(sql)?;
            for (part, p) in parts
                .iter()
                .flat_map(|p| p.places.iter().map(move |q| (p, q)))
            {
                let (world, tick) = (part.world.0 as i64, p.tick as i64);
                let before = p.bytes_before as i64;
                insert.execute(params![
                    p.id, world, p.session, p.seq, tick, p.time_ms, before
                ])?;
            }
        }
        tx.commit()
    }
}
