//! Worlds and clips in a directory of this machine.
//!
//! What is small and rarely written is a file of its own, so that damage to one takes nothing else with it: that a
//! world exists, one earlier state of it, a clip, its content. What is written all the time is in one log
//! ([`Log`](super::log::Log)), because one `fsync` then serves all worlds.

use super::files::{self, Packed, Unpacked};
use super::log::Log;
use super::marks::Marks;
use super::store::{
    CheckpointStore, ClipRecord, Durability, Entry, Found, History, Loss, RehearsalRecord,
    Retention, StoreError, Usage, WorldKey, WorldRecord,
};
use bytes::Bytes;
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, HashMap};
use std::fs::{File, TryLockError};
use std::io::{Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime};

/// Format of the directory.
const FORMAT: u32 = 1;
/// Age at which the earlier state of a world, which is kept beside the log in case that is lost, is written anew.
const STATE_EVERY: Duration = Duration::from_secs(60);
/// States that are written in one go, so that commits do not wait for long.
const STATES_AT_ONCE: usize = 2;

// Kinds of files.
const DIRECTORY: u8 = b'D';
const WORLD: u8 = b'W';
const STATE: u8 = b'S';
const CLIP: u8 = b'C';
const CONTENT: u8 = b'M';
const REHEARSAL: u8 = b'R';
const END: u8 = b'E';

/// Extension of the file of a world that is being deleted.
const GONE: &str = "gone";

/// How the server before this one ended.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LastEnd {
    /// In good order, or there was none.
    pub orderly: bool,
    /// Worlds that were being stepped when it ended otherwise, and the ticks.
    pub stepping: Vec<(WorldKey, u64)>,
    /// What is wrong with the log as a whole.
    pub damage: Vec<String>,
}

/// How far the log went: its last row, and that of each world. Rows of worlds that rest are followed by those of
/// others, so that the last one alone would not tell.
struct EndNote {
    end: i64,
    worlds: BTreeMap<WorldKey, i64>,
}

impl EndNote {
    /// Checksum, length, rows.
    fn to_bytes(&self) -> Vec<u8> {
        let mut rest = Vec::with_capacity(12 + 16 * self.worlds.len());
        rest.extend_from_slice(&(self.worlds.len() as u32).to_le_bytes());
        rest.extend_from_slice(&self.end.to_le_bytes());
        for (world, id) in &self.worlds {
            rest.extend_from_slice(&world.0.to_le_bytes());
            rest.extend_from_slice(&id.to_le_bytes());
        }
        let sum = crc32fast::hash(&rest).to_le_bytes();
        [&sum[..], &rest].concat()
    }

    /// `None`: it is not what was written, as after a power cut.
    fn read(bytes: &[u8]) -> Option<Self> {
        let (sum, rest) = bytes.split_first_chunk::<4>()?;
        let count = u32::from_le_bytes(*rest.first_chunk::<4>()?) as usize;
        // What is behind it is from a time with more worlds.
        let rest = rest.get(..count.checked_mul(16)?.checked_add(12)?)?;
        if crc32fast::hash(rest).to_le_bytes() != *sum {
            return None;
        }
        let (rows, _) = rest[12..].as_chunks::<16>();
        let number = |bytes: &[u8]| u64::from_le_bytes(bytes.try_into().expect("eight bytes"));
        let row = |r: &[u8; 16]| (WorldKey(number(&r[..8])), number(&r[8..]) as i64);
        Some(Self {
            end: number(&rest[4..12]) as i64,
            worlds: rows.iter().map(row).collect(),
        })
    }
}

/// A directory with worlds and clips. It is locked as long as this lives.
pub struct LocalStore {
    dir: PathBuf,
    log: Log,
    marks: Arc<Marks>,
    last_end: LastEnd,
    last_key: u64,
    /// When and at which tick the earlier states were written.
    states: HashMap<WorldKey, (Instant, u64)>,
    /// Held for its lock.
    _lock: File,
}

impl LocalStore {
    /// Whether a directory, if it holds worlds, holds those of this version. Changes nothing.
    ///
    /// # Errors
    /// A later version has written it, or it is damaged.
    pub fn check_format(dir: &Path) -> Result<(), StoreError> {
        let format = dir.join("format");
        match files::read(&format, DIRECTORY, FORMAT) {
            Err(StoreError::Io(_)) if !format.exists() => Ok(()),
            other => other.map(|_| ()),
        }
    }

    /// Opens a directory, or makes one, and locks it.
    ///
    /// # Errors
    /// It is no directory or cannot be written to, another server uses it, or a later version has written it.
    pub fn open(dir: &Path) -> Result<Self, StoreError> {
        let unusable = |why: String| StoreError::Directory {
            path: dir.to_owned(),
            why,
        };
        if dir.exists() && !dir.is_dir() {
            return Err(unusable("data_dir must be a directory".to_owned()));
        }
        for sub in ["", "worlds", "clips", "contents", "rehearsals"] {
            std::fs::create_dir_all(dir.join(sub))
                .map_err(|e| unusable(format!("the directory cannot be made: {e}")))?;
        }
        let lock = lock(dir)?;
        Self::check_format(dir)?;
        let format = dir.join("format");
        if !format.exists() {
            files::write(&format, DIRECTORY, FORMAT, b"worlds and clips of sinew")?;
        }
        let mut last_end = LastEnd::default();
        let end = dir.join("end");
        let fresh = !dir.join("log.sqlite").exists();
        last_end.orderly = fresh || files::read(&end, END, FORMAT).is_ok();
        files::remove(&end)?;
        let marks = Marks::open(&dir.join("stepping"))?;
        if !last_end.orderly {
            last_end.stepping = marks.found().to_vec();
        }
        let log = match Log::open(&dir.join("log.sqlite")) {
            Err(StoreError::Damaged(why)) => {
                let aside = set_aside(dir)?;
                last_end.damage.push(format!(
                    "{why}; it is kept in {}, worlds come back from their earlier states",
                    aside.display()
                ));
                Log::open(&dir.join("log.sqlite"))?
            }
            log => log?,
        };
        let mut store = Self {
            dir: dir.to_owned(),
            log,
            marks: Arc::new(marks),
            last_end,
            last_key: 0,
            states: HashMap::new(),
            _lock: lock,
        };
        if let Some(missing) = store.missing_end() {
            store.last_end.damage.push(missing);
        }
        store.finish_deletions()?;
        Ok(store)
    }

    /// How the server before this one ended.
    pub fn last_end(&self) -> &LastEnd {
        &self.last_end
    }

    /// Where worlds note that they are being stepped.
    pub fn marks(&self) -> Arc<Marks> {
        self.marks.clone()
    }

    fn world_path(&self, key: WorldKey, extension: &str) -> PathBuf {
        self.dir.join("worlds").join(format!("{key}.{extension}"))
    }

    fn clip_path(&self, name: &str) -> PathBuf {
        let file = format!("{}.clip", file_name(name));
        self.dir.join("clips").join(file)
    }

    fn rehearsal_path(&self, clip: &str, figure: &str) -> PathBuf {
        let file = format!("{}-{}.rehearsal", file_name(clip), file_name(figure));
        self.dir.join("rehearsals").join(file)
    }

    fn read_rehearsal(path: &Path) -> Result<RehearsalRecord, StoreError> {
        let bytes = files::read(path, REHEARSAL, FORMAT).map_err(|e| match e {
            StoreError::Damaged(why) => {
                StoreError::Damaged(format!("{why}: a clip has to be rehearsed again"))
            }
            other => other,
        })?;
        let mut fields = Unpacked(&bytes);
        (|| {
            Some(RehearsalRecord {
                clip: fields.text()?.to_owned(),
                figure: fields.text()?.to_owned(),
                content: Bytes::copy_from_slice(fields.bytes()?),
            })
        })()
        .ok_or_else(|| StoreError::Damaged(format!("{}: fields are missing", path.display())))
    }

    /// Forgets the rehearsals of a clip, damaged ones too.
    fn delete_rehearsals(&self, clip: &str) -> Result<(), StoreError> {
        let of_clip = format!("{}-", file_name(clip));
        for path in files::list(&self.dir.join("rehearsals"), "rehearsal")? {
            let name = path.file_name().and_then(|n| n.to_str());
            if name.is_some_and(|n| n.starts_with(&of_clip)) {
                files::remove(&path)?;
            }
        }
        Ok(())
    }

    fn content_path(&self, hash: &[u8]) -> PathBuf {
        let name = format!("{}.motion", hex::encode(hash));
        self.dir.join("contents").join(name)
    }

    /// Notes how far the log goes, without waiting for the disk: after a power cut the note may be behind the log,
    /// never before it.
    fn note_end(&self) -> Result<(), StoreError> {
        let path = self.dir.join("log.end");
        let note = EndNote {
            end: self.log.end(),
            worlds: self.log.ends().clone(),
        };
        let note = note.to_bytes();
        let written = File::options()
            .write(true)
            .create(true)
            .truncate(false)
            .open(&path)
            .and_then(|mut f| f.write_all(&note));
        written.map_err(|e| files::io_error(&path, &e))
    }

    /// What a log that ends before its note has lost: SQLite leaves damaged ends of its write-ahead log out silently.
    /// Whether worlds end before theirs shows when they are read.
    fn missing_end(&mut self) -> Option<String> {
        let note = std::fs::read(self.dir.join("log.end")).ok()?;
        let note = EndNote::read(&note)?;
        // A log that was begun anew has nothing of what was noted.
        if !self.last_end.damage.is_empty() {
            return None;
        }
        // Rows of worlds that were deleted since are not missing: the note is written with commits only.
        let there = |w: &WorldKey| self.world_path(*w, "world").exists();
        let ends = note.worlds.iter().filter(|(w, _)| there(w));
        let end = ends.map(|(_, id)| *id).max().unwrap_or(0);
        self.log.expect(note.worlds);
        (self.log.end() < end).then(|| {
            format!(
                "{}: the last {} rows of worlds are missing: the log is damaged",
                self.dir.join("log.sqlite").display(),
                end - self.log.end()
            )
        })
    }

    /// Writes states beside the log, in case the log is lost.
    fn write_states(&mut self) -> Result<(), StoreError> {
        let mut worlds: Vec<WorldKey> = self.log.worlds().collect();
        worlds.retain(|w| {
            let state = self.states.get(w);
            state.is_none_or(|(at, _)| at.elapsed() >= STATE_EVERY)
        });
        for world in worlds.into_iter().take(STATES_AT_ONCE) {
            self.write_state(world)?;
        }
        Ok(())
    }

    fn write_state(&mut self, world: WorldKey) -> Result<(), StoreError> {
        let written = self.states.get(&world).map(|(_, tick)| *tick);
        let checkpoint = self.log.checkpoint(world)?;
        let tick = checkpoint.as_ref().map_or(0, |c| c.0);
        if let Some((tick, bytes)) = checkpoint
            && written != Some(tick)
        {
            let packed = Packed::default().bytes(&tick.to_le_bytes()).bytes(&bytes);
            files::write(&self.world_path(world, "state"), STATE, FORMAT, &packed.0)?;
        }
        self.states.insert(world, (Instant::now(), tick));
        Ok(())
    }

    /// Removes what is left of a world whose file is marked as gone; the mark goes last.
    fn finish_deletion(&mut self, key: WorldKey) -> Result<(), StoreError> {
        self.log.forget(key)?;
        self.states.remove(&key);
        files::remove(&self.world_path(key, "state"))?;
        files::remove(&self.world_path(key, GONE))
    }

    /// Ends deletions that the process before this one has begun.
    fn finish_deletions(&mut self) -> Result<(), StoreError> {
        for path in files::list(&self.dir.join("worlds"), GONE)? {
            let key = path.file_stem().and_then(|k| k.to_str());
            if let Some(key) = key.and_then(WorldKey::parse) {
                self.finish_deletion(key)?;
            }
        }
        Ok(())
    }

    /// The state beside the log.
    fn state(&self, world: WorldKey) -> Result<(u64, Bytes), StoreError> {
        let path = self.world_path(world, "state");
        let bytes = files::read(&path, STATE, FORMAT)?;
        let mut fields = Unpacked(&bytes);
        let tick = fields.bytes().and_then(|t| t.try_into().ok());
        tick.map(u64::from_le_bytes)
            .zip(fields.bytes())
            .map(|(tick, bytes)| (tick, Bytes::copy_from_slice(bytes)))
            .ok_or_else(|| StoreError::Damaged(format!("{}: fields are missing", path.display())))
    }

    fn read_world(path: &Path) -> Result<WorldRecord, StoreError> {
        let bytes = files::read(path, WORLD, FORMAT)?;
        let mut fields = Unpacked(&bytes);
        (|| {
            Some(WorldRecord {
                key: WorldKey(u64::from_le_bytes(fields.bytes()?.try_into().ok()?)),
                name: fields.text()?.to_owned(),
                durability: Durability::by_name(fields.text()?)?,
                quarantined: Some(fields.text()?.to_owned()).filter(|why| !why.is_empty()),
                settings: Bytes::copy_from_slice(fields.bytes()?),
            })
        })()
        .ok_or_else(|| StoreError::Damaged(format!("{}: fields are missing", path.display())))
    }

    fn read_clip(&self, path: &Path) -> Result<ClipRecord, StoreError> {
        let bytes = files::read(path, CLIP, FORMAT)?;
        let mut fields = Unpacked(&bytes);
        let damaged = |why: &str| StoreError::Damaged(format!("{}: {why}", path.display()));
        let (name, description, hash) =
            (|| Some((fields.text()?, fields.bytes()?, fields.bytes()?)))()
                .ok_or_else(|| damaged("fields are missing"))?;
        let content = files::read(&self.content_path(hash), CONTENT, FORMAT);
        let content = content.map_err(|e| damaged(&format!("clip {name:?} is lost: {e}")))?;
        if Sha256::digest(&content)[..] != *hash {
            return Err(damaged(&format!(
                "clip {name:?} is lost: its content is another one"
            )));
        }
        Ok(ClipRecord {
            name: name.to_owned(),
            description: Bytes::copy_from_slice(description),
            content: content.into(),
        })
    }

    /// Contents that clips refer to.
    fn contents(&self) -> Result<Vec<PathBuf>, StoreError> {
        let mut used = Vec::new();
        for path in files::list(&self.dir.join("clips"), "clip")? {
            let bytes = files::read(&path, CLIP, FORMAT)?;
            let mut fields = Unpacked(&bytes);
            let hash = (|| {
                fields.bytes()?;
                fields.bytes()?;
                fields.bytes()
            })();
            used.extend(hash.map(|h| self.content_path(h)));
        }
        Ok(used)
    }
}

/// What the file of something is called: names are as long as clients like, and of their letters.
fn file_name(name: &str) -> String {
    hex::encode(&Sha256::digest(name)[..16])
}

fn found<T>(
    paths: Vec<PathBuf>,
    read: impl Fn(&Path) -> Result<T, StoreError>,
) -> Result<Found<T>, StoreError> {
    let mut out = Found {
        whole: Vec::new(),
        damaged: Vec::new(),
    };
    for path in paths {
        match read(&path) {
            Ok(item) => out.whole.push(item),
            Err(StoreError::Damaged(why)) => out.damaged.push(why),
            Err(error) => return Err(error),
        }
    }
    Ok(out)
}

fn lock(dir: &Path) -> Result<File, StoreError> {
    let path = dir.join("lock");
    let failed = |e: std::io::Error| files::io_error(&path, &e);
    let mut lock = File::options()
        .read(true)
        .write(true)
        .create(true)
        .truncate(false)
        .open(&path)
        .map_err(failed)?;
    match lock.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => {
            let mut holder = String::new();
            let _ = lock.read_to_string(&mut holder); // the message does without it
            return Err(StoreError::InUse {
                path: dir.to_owned(),
                holder: holder.trim().to_owned(),
            });
        }
        Err(TryLockError::Error(error)) => return Err(failed(error)),
    }
    let holder = format!("process {}\n", std::process::id());
    lock.set_len(0)
        .and_then(|()| lock.rewind())
        .and_then(|()| lock.write_all(holder.as_bytes()))
        .map_err(failed)?;
    Ok(lock)
}

/// Moves a damaged log out of the way, where it can be looked at.
fn set_aside(dir: &Path) -> Result<PathBuf, StoreError> {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    let aside = dir.join(format!("damaged-{}", since.unwrap_or_default().as_millis()));
    std::fs::create_dir_all(&aside).map_err(|e| files::io_error(&aside, &e))?;
    for name in ["log.sqlite", "log.sqlite-wal", "log.sqlite-shm"] {
        let from = dir.join(name);
        if from.exists() {
            std::fs::rename(&from, aside.join(name)).map_err(|e| files::io_error(&from, &e))?;
        }
    }
    files::sync_directory(dir)?;
    Ok(aside)
}

impl CheckpointStore for LocalStore {
    fn worlds(&mut self) -> Result<Found<WorldRecord>, StoreError> {
        let paths = files::list(&self.dir.join("worlds"), "world")?;
        let mut out = found(paths.clone(), Self::read_world)?;
        out.whole.iter().for_each(|w| self.log.know(w.key));
        // A world of which only the log knows: its own file is gone. One whose file is damaged is named already.
        for key in self.log.worlds() {
            let path = self.world_path(key, "world");
            if !paths.contains(&path) {
                out.damaged
                    .push(format!("{}: the file is missing", path.display()));
            }
        }
        Ok(out)
    }

    fn new_key(&mut self) -> WorldKey {
        let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
        let now = u64::try_from(since.unwrap_or_default().as_micros()).unwrap_or(0);
        let known = self.log.worlds().map(|w| w.0).max().unwrap_or(0);
        self.last_key = now.max(self.last_key + 1).max(known + 1);
        WorldKey(self.last_key)
    }

    fn put_world(&mut self, world: &WorldRecord) -> Result<(), StoreError> {
        self.log.know(world.key);
        let packed = Packed::default()
            .bytes(&world.key.0.to_le_bytes())
            .bytes(world.name.as_bytes())
            .bytes(world.durability.name().as_bytes())
            .bytes(world.quarantined.as_deref().unwrap_or("").as_bytes())
            .bytes(&world.settings);
        files::write(
            &self.world_path(world.key, "world"),
            WORLD,
            FORMAT,
            &packed.0,
        )
    }

    fn delete_world(&mut self, key: WorldKey) -> Result<(), StoreError> {
        let (there, gone) = (self.world_path(key, "world"), self.world_path(key, GONE));
        // From here on it is gone, whatever becomes of the process. It may be another try.
        if there.exists() || !gone.exists() {
            files::rename(&there, &gone)?;
        }
        self.finish_deletion(key)
    }

    fn commit(&mut self, entries: &[Entry]) -> Result<(), StoreError> {
        self.log.commit(entries)?;
        self.note_end()
    }

    fn latest(&mut self, worlds: &[WorldKey]) -> Result<Vec<History>, StoreError> {
        let mut out = self.log.read(worlds, None)?;
        for (history, world) in out.iter_mut().zip(worlds) {
            if history.checkpoint.is_some() {
                continue;
            }
            // A world that has just been created has neither.
            match self.state(*world) {
                Ok((tick, bytes)) => {
                    history.losses.push(Loss {
                        after_tick: Some(tick),
                        why: "its log is lost; this is its earlier state".to_owned(),
                    });
                    history.checkpoint = Some((tick, bytes));
                }
                Err(StoreError::Damaged(why)) => history.losses.push(Loss {
                    after_tick: None,
                    why,
                }),
                Err(StoreError::Io(_)) => {}
                Err(error) => return Err(error),
            }
        }
        Ok(out)
    }

    fn history_at(&mut self, world: WorldKey, tick: u64) -> Result<History, StoreError> {
        let mut histories = self.log.read(&[world], Some(tick))?;
        Ok(histories.pop().unwrap_or_default())
    }

    fn oldest(&mut self, world: WorldKey) -> Option<u64> {
        self.log.oldest(world)
    }

    fn cut(&mut self, limits: &Retention) -> Result<Usage, StoreError> {
        let usage = self.log.cut(limits)?;
        self.write_states()?;
        Ok(usage)
    }

    fn repair(&mut self, fault: &StoreError) -> Result<Option<String>, StoreError> {
        match fault {
            StoreError::Full(_) => {
                // The copy of the write-ahead log to where its pages belong frees it for new rows.
                self.log.shrink()?;
                let nothing = Retention {
                    age: Duration::ZERO,
                    world_bytes: 0,
                    total_bytes: 0,
                };
                while self.log.cut(&nothing)?.unswept {}
                self.log.shrink()?;
                Ok(Some("the oldest history is given up".to_owned()))
            }
            StoreError::Damaged(_) | StoreError::Io(_) => {
                // Closed first: SQLite removes files by their names when it closes.
                self.log.close();
                let aside = set_aside(&self.dir)?;
                let mut log = Log::open(&self.dir.join("log.sqlite"))?;
                self.log.known().for_each(|world| log.know(world));
                self.log = log;
                Ok(Some(format!(
                    "a new log is begun; the old one is kept in {}",
                    aside.display()
                )))
            }
            _ => Ok(None),
        }
    }

    fn clips(&mut self) -> Result<Found<ClipRecord>, StoreError> {
        let paths = files::list(&self.dir.join("clips"), "clip")?;
        found(paths, |path| self.read_clip(path))
    }

    fn put_clip(&mut self, clip: &ClipRecord) -> Result<(), StoreError> {
        self.delete_rehearsals(&clip.name)?;
        let hash = Sha256::digest(&clip.content);
        let content = self.content_path(&hash);
        // What is there may be damaged: it is not taken for the same.
        if files::read(&content, CONTENT, FORMAT).is_ok_and(|there| there == clip.content) {
            tracing::debug!(
                clip = clip.name,
                "the content of the clip is stored already"
            );
        } else {
            files::write(&content, CONTENT, FORMAT, &clip.content)?;
        }
        let packed = Packed::default()
            .bytes(clip.name.as_bytes())
            .bytes(&clip.description)
            .bytes(&hash);
        files::write(&self.clip_path(&clip.name), CLIP, FORMAT, &packed.0)
    }

    fn rehearsals(&mut self) -> Result<Found<RehearsalRecord>, StoreError> {
        let paths = files::list(&self.dir.join("rehearsals"), "rehearsal")?;
        found(paths, Self::read_rehearsal)
    }

    fn put_rehearsal(&mut self, r: &RehearsalRecord) -> Result<(), StoreError> {
        let packed = Packed::default()
            .bytes(r.clip.as_bytes())
            .bytes(r.figure.as_bytes())
            .bytes(&r.content);
        let path = self.rehearsal_path(&r.clip, &r.figure);
        files::write(&path, REHEARSAL, FORMAT, &packed.0)
    }

    fn delete_rehearsal(&mut self, clip: &str, figure: &str) -> Result<(), StoreError> {
        files::remove(&self.rehearsal_path(clip, figure))
    }

    fn delete_clip(&mut self, name: &str) -> Result<(), StoreError> {
        self.delete_rehearsals(name)?;
        files::remove(&self.clip_path(name))?;
        // With a clip that cannot be read it is not known what the others need.
        let Ok(used) = self.contents() else {
            return Ok(());
        };
        for path in files::list(&self.dir.join("contents"), "motion")? {
            if !used.contains(&path) {
                files::remove(&path)?;
            }
        }
        Ok(())
    }

    fn close(&mut self) -> Result<(), StoreError> {
        let worlds: Vec<WorldKey> = self.log.worlds().collect();
        for world in worlds {
            self.write_state(world)?;
        }
        self.log.shrink()?;
        self.marks.clear_all()?;
        files::write(&self.dir.join("end"), END, FORMAT, b"in good order")
    }
}

#[cfg(test)]
impl LocalStore {
    /// The log, to take its disk away.
    pub(super) fn log(&self) -> &Log {
        &self.log
    }
}
