//! The log of all worlds in one SQLite file: checkpoints, inputs and hashes in the order in which they were committed.
//!
//! A row holds what one group commit has of one world. Rows are only appended at one end and deleted at the other, so a
//! commit writes few pages besides those of its own bytes. SQLite has no checksums of pages; each row has its own, and
//! the rows of a world are numbered, so that damage shows as a wrong checksum or as a hole, and never as other input.

use super::store::{Entry, History, Item, Logged, Loss, Retention, StoreError, Usage, WorldKey};
use bytes::Bytes;
use rusqlite::{Connection, ErrorCode, Row, params};
use std::collections::{BTreeMap, HashMap, HashSet, VecDeque};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// "SNWL", so that no other database is taken for a log.
const APPLICATION: i32 = 0x534e_574c;
/// Format of the tables and of what is in them.
pub(super) const FORMAT: u32 = 1;
/// Bytes of one page: a row of ten figures fits into one.
const PAGE_BYTES: u32 = 16_384;
/// Pages of the write-ahead log after which they are copied to where they belong: 32 MB.
const WAL_PAGES: u32 = 2000;
/// Bytes of pages that are held in memory.
const CACHE_KIB: u32 = 16_384;
/// Rows that one call of [`Log::cut`] looks at, so that commits do not wait for long.
const CUT_ROWS: usize = 20_000;
/// Damaged places in one file after which the rest of it is given up.
const MAX_DAMAGED: u32 = 1000;

/// Number that no row has: a million a second for ten thousand years.
const MAX_ID: i64 = 1 << 58;

const CHECKPOINT: u8 = 1;
const GROUP: u8 = 2;
const INPUT: u8 = 1;
const HASH: u8 = 2;

const TABLES: &str = "
    CREATE TABLE log (
        id INTEGER PRIMARY KEY, world INTEGER NOT NULL, session INTEGER NOT NULL, seq INTEGER NOT NULL,
        kind INTEGER NOT NULL, tick INTEGER NOT NULL, sum INTEGER NOT NULL, bytes BLOB NOT NULL
    );
    -- Where in the log the checkpoints are. What is lost of it is found again by a look at all rows.
    CREATE TABLE checkpoints (
        id INTEGER PRIMARY KEY, world INTEGER NOT NULL, session INTEGER NOT NULL, seq INTEGER NOT NULL,
        tick INTEGER NOT NULL, time_ms INTEGER NOT NULL, bytes_before INTEGER NOT NULL
    );";

/// A checkpoint in the log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Place {
    id: i64,
    session: i64,
    /// Number of the first group behind it.
    seq: i64,
    tick: u64,
    time_ms: i64,
    /// Bytes of this world before it.
    bytes_before: u64,
}

/// What the log knows of one world.
#[derive(Clone, Debug, Default)]
struct Track {
    /// From the oldest to the latest.
    places: VecDeque<Place>,
    /// Bytes ever written.
    written: u64,
    /// Number of the next group of this session; `None` until there is a checkpoint.
    next: Option<i64>,
}

impl Track {
    fn held(&self) -> u64 {
        self.places
            .front()
            .map_or(0, |p| self.written.saturating_sub(p.bytes_before))
    }

    /// Drops the oldest of two or more checkpoints. Ids from it to the next: rows of this world among them go.
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

/// One row, as it is on disk.
struct Record {
    id: i64,
    world: WorldKey,
    session: i64,
    seq: i64,
    kind: u8,
    tick: u64,
    bytes: Bytes,
}

impl Record {
    fn sum(&self) -> i64 {
        let mut sum = crc32fast::Hasher::new();
        for number in [self.id, self.world.0 as i64, self.session, self.seq] {
            sum.update(&number.to_le_bytes());
        }
        sum.update(&[self.kind]);
        sum.update(&self.tick.to_le_bytes());
        sum.update(&self.bytes);
        i64::from(sum.finalize())
    }

    /// What is on disk, and whether it is what was written.
    fn read(row: &Row<'_>) -> rusqlite::Result<(Self, bool)> {
        let number = |i: usize| row.get_ref(i).map(|v| v.as_i64().unwrap_or(-1));
        let bytes = row.get_ref(7)?.as_blob().unwrap_or_default();
        let record = Self {
            id: number(0)?,
            world: WorldKey(number(1)? as u64),
            session: number(2)?,
            seq: number(3)?,
            kind: u8::try_from(number(4)?).unwrap_or(0),
            tick: number(5)? as u64,
            bytes: Bytes::copy_from_slice(bytes),
        };
        let whole = record.sum() == number(6)?;
        Ok((record, whole))
    }

    fn frames(&self) -> Option<Vec<Logged>> {
        let mut rest = self.bytes.clone();
        let mut out = Vec::new();
        while !rest.is_empty() {
            let head = rest.first_chunk::<13>()?;
            let tick = u64::from_le_bytes(head[1..9].try_into().ok()?);
            let length = u32::from_le_bytes(head[9..].try_into().ok()?) as usize;
            let kind = head[0];
            let _ = rest.split_to(13);
            if rest.len() < length {
                return None;
            }
            let bytes = rest.split_to(length);
            let item = match kind {
                INPUT => Item::Input(bytes),
                HASH => Item::Hash(u64::from_le_bytes(bytes[..].try_into().ok()?)),
                _ => return None,
            };
            out.push(Logged { tick, item });
        }
        Some(out)
    }
}

fn frame(out: &mut Vec<u8>, kind: u8, tick: u64, bytes: &[u8]) {
    out.push(kind);
    out.extend_from_slice(&tick.to_le_bytes());
    let length = u32::try_from(bytes.len()).expect("requests are smaller than 4 GiB");
    out.extend_from_slice(&length.to_le_bytes());
    out.extend_from_slice(bytes);
}

fn now_ms() -> i64 {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    i64::try_from(since.unwrap_or_default().as_millis()).unwrap_or(i64::MAX)
}

/// What SQLite said.
fn fault(path: &Path, error: &rusqlite::Error) -> StoreError {
    let place = path.display();
    let code = error.sqlite_error_code();
    match code {
        Some(ErrorCode::DiskFull | ErrorCode::TooBig) => StoreError::Full(place.to_string()),
        Some(ErrorCode::ReadOnly | ErrorCode::CannotOpen | ErrorCode::PermissionDenied) => {
            StoreError::ReadOnly(place.to_string())
        }
        Some(
            ErrorCode::DatabaseCorrupt | ErrorCode::NotADatabase | ErrorCode::ConstraintViolation,
        ) => StoreError::Damaged(format!("{place}: {error}")),
        // Tables or columns that are not there: the list of tables is damaged.
        Some(ErrorCode::Unknown) => StoreError::Damaged(format!("{place}: {error}")),
        _ => StoreError::Io(format!("{place}: {error}")),
    }
}

/// One world while the log is read. What the rows say counts, because they have checksums; the table of checkpoints,
/// which has none, only says where to begin.
struct Reading {
    /// Row to begin at.
    from: i64,
    /// Checkpoints behind this tick are left alone.
    at: Option<u64>,
    /// Session of the checkpoint and number of the next group; `None` until it is read.
    next: Option<(i64, i64)>,
    history: History,
    ended: bool,
    /// A damaged place behind the last row of it. Nothing in a damaged row can be trusted, the world included.
    doubtful: bool,
    /// Its last row that is whole.
    last: i64,
}

impl Reading {
    fn new(from: i64, at: Option<u64>) -> Self {
        Self {
            from,
            at,
            next: None,
            history: History::default(),
            ended: false,
            doubtful: false,
            last: 0,
        }
    }

    /// Takes a row of this world that is whole.
    fn take(&mut self, record: &Record) {
        if record.id < self.from {
            return;
        }
        let last = record.id;
        if record.kind == CHECKPOINT {
            // Also one that the table has lost. With it, nothing before it matters.
            if self.at.is_none_or(|at| record.tick <= at) {
                *self = Self::new(self.from, self.at);
                self.last = last;
                self.next = Some((record.session, record.seq));
                self.history.checkpoint = Some((record.tick, record.bytes.clone()));
            }
            return;
        }
        self.last = last;
        let Some((session, next)) = self.next.filter(|_| !self.ended) else {
            return;
        };
        if record.session != session {
            self.ended = true;
        } else if record.kind == GROUP {
            match record.frames().filter(|_| record.seq == next) {
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

    /// A row or some that cannot be read, up to this one.
    fn doubt(&mut self, id: i64) {
        self.doubtful |= id > self.from && !self.ended;
    }

    fn lose(&mut self, why: &str) {
        self.history.losses.push(Loss {
            after_tick: self.history.last_tick(),
            why: why.to_owned(),
        });
    }

    /// `latest`: the latest checkpoint there has been; `end`: its last row, if it was noted.
    fn end(mut self, latest: Place, end: Option<i64>) -> History {
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
                // Pages that SQLite does not know of any more are no error to it.
                self.lose("the end of its log is missing");
            }
        }
        self.history
    }
}

/// The log.
pub(super) struct Log {
    db: Connection,
    path: PathBuf,
    session: i64,
    next_id: i64,
    tracks: HashMap<WorldKey, Track>,
    /// Worlds that there are. Of those that are gone the last entries may still be on their way.
    known: HashSet<WorldKey>,
    /// The last row of each world, as it should be.
    ends: BTreeMap<WorldKey, i64>,
    /// Ids among which there are rows that no world needs any more, in order and apart from each other.
    unswept: Vec<Range<i64>>,
    /// Rows with wrong checksums that were met, and places that could not be read.
    pub damaged_rows: u64,
}

impl Log {
    /// Opens the log or begins one.
    ///
    /// # Errors
    /// It is damaged, of a later format, or cannot be read.
    pub fn open(path: &Path) -> Result<Self, StoreError> {
        let open = || -> rusqlite::Result<(Connection, i32, u32)> {
            let db = Connection::open(path)?;
            db.busy_timeout(Duration::from_secs(5))?; // a backup that reads it
            db.execute_batch(&format!(
                "PRAGMA page_size = {PAGE_BYTES};
                 PRAGMA journal_mode = WAL;
                 PRAGMA synchronous = FULL;
                 PRAGMA cell_size_check = ON;
                 PRAGMA wal_autocheckpoint = {WAL_PAGES};
                 PRAGMA cache_size = -{CACHE_KIB};"
            ))?;
            let application = db.pragma_query_value(None, "application_id", |r| r.get(0))?;
            let version = db.pragma_query_value(None, "user_version", |r| r.get(0))?;
            Ok((db, application, version))
        };
        let failed = |e: rusqlite::Error| fault(path, &e);
        let (db, application, version) = open().map_err(failed)?;
        if version > FORMAT && application == APPLICATION {
            return Err(StoreError::NewerFormat {
                path: path.to_owned(),
                found: version,
                known: FORMAT,
            });
        }
        if version == 0 && application == 0 {
            let begin = format!(
                "BEGIN; {TABLES} PRAGMA application_id = {APPLICATION}; PRAGMA user_version = {FORMAT}; COMMIT;"
            );
            db.execute_batch(&begin).map_err(failed)?;
        } else if application != APPLICATION || version != FORMAT {
            return Err(StoreError::Damaged(format!(
                "{}: not a log of sinew",
                path.display()
            )));
        }
        let mut log = Self {
            db,
            path: path.to_owned(),
            session: now_ms(),
            next_id: 1,
            tracks: HashMap::new(),
            known: HashSet::new(),
            ends: BTreeMap::new(),
            unswept: Vec::new(),
            damaged_rows: 0,
        };
        log.load()?;
        // The process may have ended before it had deleted what was cut off.
        log.unswept.push(0..log.next_id);
        Ok(log)
    }

    fn fault(&self, error: &rusqlite::Error) -> StoreError {
        fault(&self.path, error)
    }

    /// Reads where the checkpoints are.
    fn load(&mut self) -> Result<(), StoreError> {
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
        self.next_id = last + 1;
        let mut found = BTreeMap::new();
        let listed = (|| {
            let mut all = self.db.prepare("SELECT * FROM checkpoints ORDER BY id")?;
            let mut rows = all.query([])?;
            while let Some(row) = rows.next()? {
                let place = Place {
                    id: row.get(0)?,
                    session: row.get(2)?,
                    seq: row.get(3)?,
                    tick: row.get::<_, i64>(4)? as u64,
                    time_ms: row.get(5)?,
                    bytes_before: row.get::<_, i64>(6)? as u64,
                };
                found.insert(place.id, (WorldKey(row.get::<_, i64>(1)? as u64), place));
            }
            Ok::<_, rusqlite::Error>(())
        })();
        if listed.is_err() {
            self.damaged_rows += 1;
            let mut rest = Vec::new();
            self.scan(0, &mut |_, record| {
                if let Some(record) = record.filter(|r| r.kind == CHECKPOINT) {
                    rest.push((
                        record.world,
                        record.id,
                        record.session,
                        record.seq,
                        record.tick,
                    ));
                }
            })?;
            for (world, id, session, seq, tick) in rest {
                let place = Place {
                    id,
                    session,
                    seq,
                    tick,
                    time_ms: now_ms(),
                    bytes_before: 0,
                };
                found.insert(id, (world, place));
            }
        }
        for (world, place) in found.into_values() {
            self.session = self.session.max(place.session.saturating_add(1));
            let track = self.tracks.entry(world).or_default();
            track.written = track.written.max(place.bytes_before);
            track.places.push_back(place);
            self.known.insert(world);
        }
        Ok(())
    }

    /// The tick of the oldest checkpoint of a world.
    pub fn oldest(&self, world: WorldKey) -> Option<u64> {
        Some(self.tracks.get(&world)?.places.front()?.tick)
    }

    /// Worlds of which entries are taken.
    pub fn known(&self) -> impl Iterator<Item = WorldKey> + '_ {
        self.known.iter().copied()
    }

    /// From now on entries of this world are taken.
    pub fn know(&mut self, world: WorldKey) {
        self.known.insert(world);
    }

    /// The last row of each world that was written, for the note beside the log.
    pub fn ends(&self) -> &BTreeMap<WorldKey, i64> {
        &self.ends
    }

    /// Where the note says that worlds end: what is read and ends before that has lost something.
    pub fn expect(&mut self, ends: BTreeMap<WorldKey, i64>) {
        self.ends = ends;
    }

    /// Worlds that the log knows.
    pub fn worlds(&self) -> impl Iterator<Item = WorldKey> + '_ {
        self.tracks.keys().copied()
    }

    /// Number of the last row, for the note beside the log.
    pub fn end(&self) -> i64 {
        self.next_id - 1
    }

    /// Writes entries: all or none.
    ///
    /// # Errors
    /// They could not be written.
    pub fn commit(&mut self, entries: &[Entry]) -> Result<(), StoreError> {
        let mut changed: HashMap<WorldKey, Track> = HashMap::new();
        let mut groups: BTreeMap<WorldKey, (u64, Vec<u8>)> = BTreeMap::new();
        let mut rows = Rows {
            next_id: self.next_id,
            session: self.session,
            out: Vec::new(),
        };
        let mut places = Vec::new();
        for entry in entries {
            if !self.known.contains(&entry.world) {
                continue;
            }
            let track = changed.entry(entry.world).or_insert_with(|| {
                // Only what commits change of it.
                let known = self.tracks.get(&entry.world);
                Track {
                    places: VecDeque::new(),
                    written: known.map_or(0, |t| t.written),
                    next: known.and_then(|t| t.next),
                }
            });
            let (kind, bytes) = match &entry.item {
                Item::Checkpoint { bytes, after_gap } => {
                    rows.group(entry.world, track, groups.remove(&entry.world));
                    let next = track.next.map_or(0, |n| n + i64::from(*after_gap));
                    track.next = Some(next);
                    let place = Place {
                        id: rows.next_id,
                        session: self.session,
                        seq: next,
                        tick: entry.tick,
                        time_ms: now_ms(),
                        bytes_before: track.written,
                    };
                    rows.push(entry.world, track, CHECKPOINT, entry.tick, bytes.clone());
                    track.places.push_back(place);
                    places.push((entry.world, place));
                    continue;
                }
                Item::Input(bytes) => (INPUT, bytes.clone()),
                Item::Hash(hash) => (HASH, Bytes::copy_from_slice(&hash.to_le_bytes())),
            };
            if track.next.is_none() {
                return Err(StoreError::Io(format!(
                    "world {}: input of tick {} without a checkpoint before it",
                    entry.world, entry.tick
                )));
            }
            let group = groups
                .entry(entry.world)
                .or_insert((entry.tick, Vec::new()));
            frame(&mut group.1, kind, entry.tick, &bytes);
        }
        for (world, group) in groups {
            let track = changed.get_mut(&world).expect("each group has a track");
            rows.group(world, track, Some(group));
        }
        self.write(&rows.out, &places).map_err(|e| self.fault(&e))?;
        self.next_id = rows.next_id;
        self.ends.extend(rows.out.iter().map(|r| (r.world, r.id)));
        for (world, new) in changed {
            let track = self.tracks.entry(world).or_default();
            track.written = new.written;
            track.next = new.next;
            track.places.extend(new.places);
        }
        Ok(())
    }

    fn write(&mut self, rows: &[Record], places: &[(WorldKey, Place)]) -> rusqlite::Result<()> {
        let tx = self.db.transaction()?;
        {
            let mut insert =
                tx.prepare_cached("INSERT INTO log VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)")?;
            for r in rows {
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
            let mut insert =
                tx.prepare_cached("INSERT INTO checkpoints VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)")?;
            for (world, p) in places {
                let (world, tick) = (world.0 as i64, p.tick as i64);
                let before = p.bytes_before as i64;
                insert.execute(params![
                    p.id, world, p.session, p.seq, tick, p.time_ms, before
                ])?;
            }
        }
        tx.commit()
    }

    /// Calls `f` with the number of each row from `from` on and the row, which is `None` where it is not what was
    /// written. Of a place that cannot be read the last number is given.
    fn scan(
        &mut self,
        from: i64,
        f: &mut dyn FnMut(i64, Option<&Record>),
    ) -> Result<(), StoreError> {
        let sql = "SELECT * FROM log WHERE id >= ?1 ORDER BY id";
        let (mut from, mut step, mut damaged) = (from, 1, 0);
        while from < self.next_id {
            let mut last = from - 1;
            let mut bad = 0;
            let read = (|| {
                let mut all = self.db.prepare_cached(sql)?;
                let mut rows = all.query([from])?;
                while let Some(row) = rows.next()? {
                    let (record, whole) = Record::read(row)?;
                    // Rows out of order would be read again and again.
                    if record.id <= last {
                        return Err(rusqlite::Error::InvalidQuery);
                    }
                    last = record.id;
                    bad += u64::from(!whole);
                    f(record.id, whole.then_some(&record));
                }
                Ok(())
            })();
            self.damaged_rows += bad;
            match read {
                Ok(()) => break,
                Err(error) => {
                    damaged += 1;
                    self.damaged_rows += 1;
                    if damaged > MAX_DAMAGED {
                        return Err(self.fault(&error));
                    }
                    step = if last >= from { 1 } else { step * 2 };
                    from = last + 1 + step;
                    f(from - 1, None);
                }
            }
        }
        Ok(())
    }

    /// For each world its latest state that is whole and what was written behind it, from the last checkpoint at or
    /// before a tick if one is given.
    ///
    /// # Errors
    /// Nothing can be read.
    pub fn read(
        &mut self,
        worlds: &[WorldKey],
        at: Option<u64>,
    ) -> Result<Vec<History>, StoreError> {
        // Candidates from the oldest to the latest.
        let mut candidates: Vec<VecDeque<Place>> = worlds
            .iter()
            .map(|w| {
                let places = self.tracks.get(w).map(|t| t.places.clone());
                let mut places = places.unwrap_or_default();
                places.retain(|p| at.is_none_or(|at| p.tick <= at));
                places
            })
            .collect();
        let latest: Vec<Option<Place>> = candidates.iter().map(|c| c.back().copied()).collect();
        let mut out: Vec<Option<History>> = vec![None; worlds.len()];
        loop {
            let mut open: HashMap<WorldKey, (usize, Reading)> = HashMap::new();
            for (i, places) in candidates.iter_mut().enumerate() {
                if out[i].is_some() {
                    continue;
                }
                let Some(place) = places.pop_back() else {
                    continue;
                };
                open.insert(worlds[i], (i, Reading::new(place.id, at)));
            }
            let Some(from) = open.values().map(|(_, r)| r.from).min() else {
                break;
            };
            self.scan(from, &mut |id, record| match record {
                Some(record) => {
                    if let Some((_, reading)) = open.get_mut(&record.world) {
                        reading.take(record);
                    }
                }
                None => open.values_mut().for_each(|(_, r)| r.doubt(id)),
            })?;
            for (i, reading) in open.into_values() {
                // Without its checkpoint the one before it is looked for.
                if reading.history.checkpoint.is_some() {
                    let end = self.ends.get(&worlds[i]).copied();
                    out[i] = latest[i].map(|latest| reading.end(latest, end));
                }
            }
        }
        let noted = |i: usize| at.is_none() && self.ends.contains_key(&worlds[i]);
        let missing = |i: usize| History {
            losses: (latest[i].is_some() || noted(i))
                .then(|| Loss {
                    after_tick: None,
                    why: "no checkpoint of it is whole".to_owned(),
                })
                .into_iter()
                .collect(),
            ..History::default()
        };
        Ok(out
            .into_iter()
            .enumerate()
            .map(|(i, history)| history.unwrap_or_else(|| missing(i)))
            .collect())
    }

    /// The bytes of the latest checkpoint of a world and its tick.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn checkpoint(&mut self, world: WorldKey) -> Result<Option<(u64, Bytes)>, StoreError> {
        let Some(place) = self.tracks.get(&world).and_then(|t| t.places.back()) else {
            return Ok(None);
        };
        let read = self
            .db
            .query_row("SELECT * FROM log WHERE id = ?1", [place.id], |row| {
                Record::read(row)
            });
        match read {
            Ok((record, true)) => Ok(Some((record.tick, record.bytes))),
            Ok((_, false)) => Ok(None),
            Err(error) => Err(self.fault(&error)),
        }
    }

    /// Forgets a world, and what is still written of it; its rows go with the next cuts.
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

    /// Cuts old history off, and deletes some of what has been cut off.
    ///
    /// # Errors
    /// It could not be done.
    pub fn cut(&mut self, limits: &Retention) -> Result<Usage, StoreError> {
        let age = i64::try_from(limits.age.as_millis()).unwrap_or(i64::MAX);
        let oldest = now_ms().saturating_sub(age);
        for track in self.tracks.values_mut() {
            while let [_, second, ..] = *track.places.make_contiguous()
                && (second.time_ms <= oldest || track.held() > limits.world_bytes)
            {
                self.unswept.extend(track.cut_first());
            }
        }
        let mut total: u64 = self.tracks.values().map(Track::held).sum();
        while total > limits.total_bytes {
            let largest = self.tracks.values_mut().filter(|t| t.places.len() > 1);
            let Some(track) = largest.max_by_key(|t| t.held()) else {
                break;
            };
            total -= track.held();
            self.unswept.extend(track.cut_first());
            total += track.held();
        }
        self.unswept = joined(std::mem::take(&mut self.unswept));
        let swept = self.sweep().map_err(|e| self.fault(&e))?;
        self.unswept = swept;
        Ok(Usage {
            history_bytes: total,
            checkpoints: self.tracks.values().map(|t| t.places.len()).sum(),
            unswept: !self.unswept.is_empty(),
        })
    }

    /// Deletes rows that no world needs any more, and where checkpoints among them were. Where there may be others that
    /// it has not come to.
    fn sweep(&mut self) -> rusqlite::Result<Vec<Range<i64>>> {
        let (mut old, mut rest) = (Vec::new(), Vec::new());
        let mut left = CUT_ROWS;
        for range in &self.unswept {
            if left == 0 {
                rest.push(range.clone());
                continue;
            }
            let sql = "SELECT id, world FROM log WHERE id >= ?1 AND id < ?2 ORDER BY id LIMIT ?3";
            let mut found = self.db.prepare_cached(sql)?;
            let mut rows = found.query(params![range.start, range.end, left as i64])?;
            let mut next = range.end;
            while let Some(row) = rows.next()? {
                let (id, world): (i64, i64) = (row.get(0)?, row.get(1)?);
                // Each world keeps what is behind its oldest checkpoint.
                let track = self.tracks.get(&WorldKey(world as u64));
                if track
                    .and_then(|t| t.places.front())
                    .is_none_or(|kept| id < kept.id)
                {
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

    /// Lets go of the file. What is asked of the log afterwards fails.
    pub fn close(&mut self) {
        if let Ok(nothing) = Connection::open_in_memory() {
            self.db = nothing;
        }
    }

    /// Gives the space of the write-ahead log back.
    ///
    /// # Errors
    /// It could not be done.
    pub fn shrink(&mut self) -> Result<(), StoreError> {
        let done = self
            .db
            .query_row("PRAGMA wal_checkpoint(TRUNCATE)", [], |_| Ok(()));
        done.map_err(|e| self.fault(&e))
    }
}

/// Rows of one commit.
struct Rows {
    next_id: i64,
    session: i64,
    out: Vec<Record>,
}

impl Rows {
    fn push(&mut self, world: WorldKey, track: &mut Track, kind: u8, tick: u64, bytes: Bytes) {
        track.written += bytes.len() as u64;
        self.out.push(Record {
            id: self.next_id,
            world,
            session: self.session,
            seq: track.next.unwrap_or(0),
            kind,
            tick,
            bytes,
        });
        self.next_id += 1;
    }

    fn group(&mut self, world: WorldKey, track: &mut Track, group: Option<(u64, Vec<u8>)>) {
        if let Some((tick, bytes)) = group {
            self.push(world, track, GROUP, tick, bytes.into());
            track.next = track.next.map(|n| n + 1);
        }
    }
}

#[cfg(test)]
impl Log {
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
        self.db
            .query_row("PRAGMA wal_checkpoint(TRUNCATE)", [], |_| Ok(()))
            .expect("no reader");
    }

    /// Takes no writes any more, as on a read-only disk.
    pub fn refuse_writes(&self) {
        self.db
            .pragma_update(None, "query_only", true)
            .expect("a setting");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn row(id: i64, kind: u8, (session, seq): (i64, i64), bytes: Vec<u8>) -> Record {
        Record {
            id,
            world: WorldKey(1),
            session,
            seq,
            kind,
            tick: id as u64,
            bytes: bytes.into(),
        }
    }

    /// What a group of frames is written as.
    fn group(frames: &[(u8, u64, Vec<u8>)]) -> Vec<u8> {
        let mut out = Vec::new();
        for (kind, tick, bytes) in frames {
            frame(&mut out, *kind, *tick, bytes);
        }
        out
    }

    /// Many worlds rest, and what they keep is older than all that a busy one writes and cuts off.
    #[test]
    fn what_others_keep_does_not_hide_what_can_be_deleted() {
        const RESTING: u64 = 100;
        let name = format!("sinew-log-{}.sqlite", std::process::id());
        let path = std::env::temp_dir().join(name);
        let mut log = Log::open(&path).unwrap();
        let entry = |world, tick, item| Entry {
            world: WorldKey(world),
            tick,
            item,
        };
        let checkpoint = |world, tick| {
            let bytes = Bytes::from_static(&[0; 100]);
            entry(
                world,
                tick,
                Item::Checkpoint {
                    bytes,
                    after_gap: false,
                },
            )
        };
        (0..=RESTING).for_each(|world| log.know(WorldKey(world)));
        let mut rows = 0;
        let mut commit = |log: &mut Log, entries: Vec<Entry>| {
            rows += entries.len();
            log.commit(&entries).unwrap();
        };
        commit(&mut log, (0..=RESTING).map(|w| checkpoint(w, 0)).collect());
        for tick in 1..=CUT_ROWS as u64 / RESTING {
            let hashes = (0..RESTING).map(|w| entry(w, tick, Item::Hash(tick)));
            commit(&mut log, hashes.collect());
        }
        for tick in 1..=20 {
            let hash = entry(RESTING, tick, Item::Hash(tick));
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
        // All at once: what a process left that ended before it had swept.
        log.unswept.push(0..log.next_id);
        assert!(log.cut(&limits).unwrap().unswept, "a call is bounded");
        assert!(!log.cut(&limits).unwrap().unswept);
        assert_eq!(count(&log), rows - 2 * 20);
        drop(log);
        let _ = std::fs::remove_file(path);
    }

    proptest! {
        /// `PROPTEST_CASES` says how many of them.
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
}
