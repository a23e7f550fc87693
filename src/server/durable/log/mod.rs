//! The log of all worlds in one SQLite file: checkpoints, inputs and hashes in the order in which they were committed.
//!
//! A row holds the part of one group commit that belongs to one world. Rows are only appended at one end and deleted at
//! the other, so a commit writes few pages besides those of its own data. SQLite has no checksums of pages; each row
//! has its own, and the rows of a world are numbered, so that damage shows as a wrong checksum or as a hole, and never
//! as other input.
//!
//! [`schema`] has the tables and the meaning of SQLite's errors, [`row`] one row and its checksum. [`index`] is the
//! index of each world in memory. [`writer`] commits, [`reader`] reads histories back, [`retention`] cuts them off at
//! their old end, [`repair`] handles a full disk and a damaged file. [`end_note`] is the note beside the log of its
//! last rows.

mod end_note;
mod index;
mod reader;
mod repair;
mod retention;
mod row;
mod schema;
mod track;
mod writer;

pub(super) use repair::set_aside;

use super::store::{StoreError, WorldKey};
use rusqlite::Connection;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::SystemTime;
use track::WorldTrack;

/// The log.
pub(super) struct Log {
    db: Connection,
    path: PathBuf,
    /// Number of this run of the server: later than that of every run before it.
    session: i64,
    /// Number of the next row.
    next_id: i64,
    tracks: HashMap<WorldKey, WorldTrack>,
    /// Existing worlds. The last entries of deleted worlds may still be on their way.
    known: HashSet<WorldKey>,
    /// The last row of each world, as it should be.
    ends: BTreeMap<WorldKey, i64>,
    /// Whether the last note of the end could be written.
    noted: bool,
    /// Ids among which there are rows that no world needs any more, in order and apart from each other.
    unswept: Vec<Range<i64>>,
}

impl Log {
    /// Opens the log or begins one.
    ///
    /// # Errors
    /// It is damaged, of a later format, or cannot be read.
    pub fn open(path: &Path) -> Result<Self, StoreError> {
        let mut log = Self {
            db: schema::open(path)?,
            path: path.to_owned(),
            session: now_ms(),
            next_id: 1,
            tracks: HashMap::new(),
            known: HashSet::new(),
            ends: BTreeMap::new(),
            noted: true,
            unswept: Vec::new(),
        };
        log.load()?;
        // The previous process may have ended before it had deleted the rows that were cut off.
        log.unswept.push(0..log.next_id);
        Ok(log)
    }

    /// An error of SQLite about this log.
    fn fault(&self, error: &rusqlite::Error) -> StoreError {
        schema::fault(&self.path, error)
    }

    /// Accepts entries of this world from now on.
    pub fn know(&mut self, world: WorldKey) {
        self.known.insert(world);
    }

    /// Worlds of which the log has checkpoints.
    pub fn worlds(&self) -> impl Iterator<Item = WorldKey> + '_ {
        self.tracks.keys().copied()
    }

    /// The tick of the oldest checkpoint of a world.
    pub fn oldest(&self, world: WorldKey) -> Option<u64> {
        Some(self.tracks.get(&world)?.places.front()?.tick)
    }
}

/// Milliseconds since 1970.
fn now_ms() -> i64 {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    i64::try_from(since.unwrap_or_default().as_millis()).unwrap_or(i64::MAX)
}

#[cfg(test)]
impl Log {
    /// Worlds of which entries are accepted.
    pub fn known(&self) -> impl Iterator<Item = WorldKey> + '_ {
        self.known.iter().copied()
    }

    /// The last row of each world that was written.
    pub fn ends(&self) -> &BTreeMap<WorldKey, i64> {
        &self.ends
    }

    /// Lets the log have no more pages than now and a few, as on a full disk.
    pub fn fill_disk(&self) {
        let pages: i64 = self
            .db
            .pragma_query_value(None, "page_count", |r| r.get(0))
            .expect("a count");
        self.db
            .pragma_update_and_check(None, "max_page_count", pages, |_| Ok(()))
            .expect("a limit");
    }

    /// Copies the pages of the write-ahead log to their final places.
    pub fn move_to_place(&self) {
        self.shrink().expect("no reader");
    }

    /// Refuses further writes, as on a read-only disk.
    pub fn refuse_writes(&self) {
        self.db
            .pragma_update(None, "query_only", true)
            .expect("a setting");
    }

    /// Does not wait for other programs that use the file.
    pub fn wait_for_nobody(&self) {
        self.db
            .busy_timeout(std::time::Duration::ZERO)
            .expect("a setting");
    }
}
