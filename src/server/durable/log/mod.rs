//! The log of all worlds in one SQLite file: checkpoints, inputs and hashes in the order in which they were committed.
//!
//! A row holds what one group commit has of one world. Rows are only appended at one end and deleted at the other, so a
//! commit writes few pages besides those of its own bytes. SQLite has no checksums of pages; each row has its own, and
//! the rows of a world are numbered, so that damage shows as a wrong checksum or as a hole, and never as other input.
//!
//! [`schema`] has the tables and what SQLite's errors mean, [`row`] one row and its checksum. [`index`] is what is
//! known in memory of each world. [`writer`] commits, [`reader`] reads histories back, [`retention`] cuts them off at
//! their old end, [`repair`] helps a full disk and a damaged file. [`end_note`] is the note beside the log of how far
//! it went.

mod end_note;
mod index;
mod reader;
mod repair;
mod retention;
mod row;
mod schema;
mod writer;

pub(super) use repair::set_aside;

use super::store::{StoreError, WorldKey};
use index::Track;
use rusqlite::Connection;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// The log.
pub(super) struct Log {
    db: Connection,
    path: PathBuf,
    /// Number of this run of the server: later than that of every run before it.
    session: i64,
    /// Number of the next row.
    next_id: i64,
    tracks: HashMap<WorldKey, Track>,
    /// Worlds that there are. Of those that are gone the last entries may still be on their way.
    known: HashSet<WorldKey>,
    /// The last row of each world, as it should be.
    ends: BTreeMap<WorldKey, i64>,
    /// The last note of the end could be written.
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
        // The process may have ended before it had deleted what was cut off.
        log.unswept.push(0..log.next_id);
        Ok(log)
    }

    /// What SQLite said about this log.
    fn fault(&self, error: &rusqlite::Error) -> StoreError {
        schema::fault(&self.path, error)
    }

    /// From now on entries of this world are taken.
    pub fn know(&mut self, world: WorldKey) {
        self.known.insert(world);
    }

    /// Worlds that the log has checkpoints of.
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
    /// Worlds of which entries are taken.
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

    /// Copies the write-ahead log to where its pages belong.
    pub fn move_to_place(&self) {
        self.shrink().expect("no reader");
    }

    /// Takes no writes any more, as on a read-only disk.
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
