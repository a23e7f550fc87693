//! Worlds and clips in a directory of this machine.
//!
//! Small, rarely written data have their own files, so that damage to one affects no other: the existence of a world,
//! one earlier state of it, a clip, its content. Data that are written all the time are in one log
//! ([`Log`](super::log::Log)), because one `fsync` then serves all worlds.

use super::files;
use super::log::{Log, set_aside};
use super::marks::Marks;
use super::records::{self, ClipFile};
use super::store::{
    CheckpointStore, ClipRecord, Loss, RehearsalRecord, Remedy, Retention, StoreContents,
    StoreEntry, StoreError, StoreUsage, StoredHistory, WorldKey, WorldRecord,
};
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::fs::{File, TryLockError};
use std::io::{Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime};

/// Age at which the earlier state of a world is written again. It is kept beside the log in case the log is lost.
const STATE_EVERY: Duration = Duration::from_secs(60);
/// States that are written in one go, so that commits do not wait for long.
const STATES_AT_ONCE: usize = 2;

/// Folders of a data directory.
const FOLDERS: [&str; 5] = ["", "worlds", "clips", "contents", "rehearsals"];
/// Extension of the file of a world that is being deleted.
const GONE: &str = "gone";

/// How the server before this one ended.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LastEnd {
    /// In good order, or there was none.
    pub orderly: bool,
    /// Worlds that were being stepped when it ended otherwise, and the ticks.
    pub stepping: Vec<(WorldKey, u64)>,
    /// Damage to the log as a whole.
    pub damage: Vec<String>,
}

/// A directory with worlds and clips. It is locked as long as this lives.
pub struct LocalStore {
    dir: PathBuf,
    log: Log,
    marks: Arc<Marks>,
    last_end: LastEnd,
    last_key: u64,
    /// The last check of each earlier state, and the tick of the stored one.
    states: HashMap<WorldKey, (Instant, Option<u64>)>,
    /// Held for its lock.
    _lock: File,
}

impl LocalStore {
    /// Whether a directory, if it holds worlds, holds those of this version. Changes nothing.
    ///
    /// # Errors
    /// A later version has written it, or it is damaged.
    pub fn check_format(dir: &Path) -> Result<(), StoreError> {
        records::check_format(&dir.join("format"))
    }

    /// Opens a directory, or makes one, and locks it.
    ///
    /// # Errors
    /// It is no directory or cannot be written to, another server uses it, or a later version has written it.
    pub fn open(dir: &Path) -> Result<Self, StoreError> {
        make(dir)?;
        let lock = lock(dir)?;
        Self::check_format(dir)?;
        let format = dir.join("format");
        if !files::is_there(&format) {
            records::write_format(&format)?;
        }
        for folder in FOLDERS {
            files::remove_unfinished(&dir.join(folder))?;
        }
        let (marks, mut last_end) = take_last_end(dir)?;
        let log = open_log(dir, &mut last_end)?;
        let mut store = Self {
            dir: dir.to_owned(),
            log,
            marks: Arc::new(marks),
            last_end,
            last_key: 0,
            states: HashMap::new(),
            _lock: lock,
        };
        store.finish_deletions()?;
        Ok(store)
    }

    /// How the server before this one ended.
    pub fn last_end(&self) -> &LastEnd {
        &self.last_end
    }

    /// The notes of worlds that are being stepped.
    pub fn marks(&self) -> Arc<Marks> {
        self.marks.clone()
    }

    fn world_path(&self, key: WorldKey, extension: &str) -> PathBuf {
        world_path(&self.dir, key, extension)
    }

    fn clip_path(&self, name: &str) -> PathBuf {
        let file = format!("{}.clip", file_name(name));
        self.dir.join("clips").join(file)
    }

    fn rehearsal_path(&self, clip: &str, figure: &str) -> PathBuf {
        let file = format!("{}-{}.rehearsal", file_name(clip), file_name(figure));
        self.dir.join("rehearsals").join(file)
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

    /// Writes states beside the log, in case the log is lost. A failure is therefore only reported.
    fn write_states(&mut self, worlds: impl IntoIterator<Item = WorldKey>) {
        for world in worlds {
            if let Err(error) = self.write_state(world) {
                tracing::warn!(%world, %error, "the earlier state of a world is not written");
            }
        }
    }

    /// Worlds whose earlier states are old, a few at a time.
    fn states_due(&self) -> Vec<WorldKey> {
        let due = |w: &WorldKey| {
            let state = self.states.get(w);
            state.is_none_or(|(at, _)| at.elapsed() >= STATE_EVERY)
        };
        let worlds = self.log.worlds().filter(due);
        worlds.take(STATES_AT_ONCE).collect()
    }

    fn write_state(&mut self, world: WorldKey) -> Result<(), StoreError> {
        let written = self.states.get(&world).and_then(|(_, tick)| *tick);
        // Note the time even after a failure, so that the others have their turns before it is tried again.
        self.states.insert(world, (Instant::now(), written));
        let checkpoint = self.log.checkpoint(world)?;
        if let Some((tick, bytes)) = checkpoint
            && written != Some(tick)
        {
            records::write_state(&self.world_path(world, "state"), tick, &bytes)?;
            self.states.insert(world, (Instant::now(), Some(tick)));
        }
        Ok(())
    }

    /// Removes the remains of a world whose file is marked as deleted; the mark is removed last.
    fn finish_deletion(&mut self, key: WorldKey) -> Result<(), StoreError> {
        self.log.forget(key)?;
        self.states.remove(&key);
        files::remove(&self.world_path(key, "state"))?;
        files::remove(&self.world_path(key, GONE))
    }

    /// Completes deletions that the previous process began. Files that cannot be deleted now are left to the next
    /// start; a world marked as deleted does not come back.
    fn finish_deletions(&mut self) -> Result<(), StoreError> {
        for path in files::list(&self.dir.join("worlds"), GONE)? {
            if let Some(key) = key_of(&path)
                && let Err(error) = self.finish_deletion(key)
            {
                tracing::warn!(world = %key, %error, "what is left of a deleted world is not removed");
            }
        }
        Ok(())
    }

    /// A world by its file.
    fn read_world(&self, path: &Path) -> Result<WorldRecord, StoreError> {
        let world = records::read_world(path)?;
        if *path != self.world_path(world.key, "world") {
            // Perhaps a copy: no two worlds have the same number.
            let (path, key) = (path.display(), world.key);
            return Err(StoreError::Damaged(format!(
                "{path}: it is not called by its number, {key}"
            )));
        }
        Ok(world)
    }

    fn read_clip(&self, path: &Path) -> Result<ClipRecord, StoreError> {
        let ClipFile {
            name,
            description,
            hash,
        } = records::read_clip(path)?;
        let lost = |why: &str| {
            let path = path.display();
            StoreError::Damaged(format!("{path}: clip {name:?} is lost: {why}"))
        };
        let content = records::read_content(&self.content_path(&hash));
        let content = content.map_err(|e| lost(&e.to_string()))?;
        if Sha256::digest(&content)[..] != hash {
            return Err(lost("its content is another one"));
        }
        Ok(ClipRecord {
            name,
            description,
            content: content.into(),
        })
    }

    /// Contents that clips refer to.
    fn contents(&self) -> Result<Vec<PathBuf>, StoreError> {
        let clips = files::list(&self.dir.join("clips"), "clip")?;
        let content = |path: &PathBuf| Ok(self.content_path(&records::read_clip(path)?.hash));
        clips.iter().map(content).collect()
    }

    /// Accepts entries of this world from now on, and does not assign its number again.
    fn know(&mut self, world: WorldKey) {
        self.last_key = self.last_key.max(world.0);
        self.log.know(world);
    }
}

fn world_path(dir: &Path, key: WorldKey, extension: &str) -> PathBuf {
    dir.join("worlds").join(format!("{key}.{extension}"))
}

/// The number of the world in a file's name.
fn key_of(path: &Path) -> Option<WorldKey> {
    let key = path.file_stem().and_then(|k| k.to_str());
    key.and_then(WorldKey::parse)
}

/// The file name for a client's name, which may have any length and any characters.
fn file_name(name: &str) -> String {
    hex::encode(&Sha256::digest(name)[..16])
}

/// Reads files. One that is damaged or cannot be read is named and stays where it is: it may be readable another time,
/// and a clip that is there keeps its content from being deleted.
fn found<T>(
    paths: Vec<PathBuf>,
    read: impl Fn(&Path) -> Result<T, StoreError>,
) -> Result<StoreContents<T>, StoreError> {
    let mut out = StoreContents {
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

/// Makes a directory and its folders, unless they exist.
fn make(dir: &Path) -> Result<(), StoreError> {
    let unusable = |why: String| StoreError::Directory {
        path: dir.to_owned(),
        why,
    };
    if dir.exists() && !dir.is_dir() {
        return Err(unusable("data_dir must be a directory".to_owned()));
    }
    for folder in FOLDERS {
        std::fs::create_dir_all(dir.join(folder))
            .map_err(|e| unusable(format!("the directory cannot be made: {e}")))?;
    }
    Ok(())
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
            let _ = lock.read_to_string(&mut holder); // the message is useful without it
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

/// How the server before this one ended. Its notes are removed, so from here on an end is not orderly.
fn take_last_end(dir: &Path) -> Result<(Marks, LastEnd), StoreError> {
    let end = dir.join("end");
    let fresh = !dir.join("log.sqlite").exists();
    let orderly = fresh || records::is_end(&end);
    files::remove(&end)?;
    let marks = Marks::open(&dir.join("stepping"))?;
    let mut last_end = LastEnd {
        orderly,
        ..LastEnd::default()
    };
    if !orderly {
        last_end.stepping = marks.found().to_vec();
    }
    Ok((marks, last_end))
}

/// Opens the log, or begins another one if it is damaged as a whole.
fn open_log(dir: &Path, last_end: &mut LastEnd) -> Result<Log, StoreError> {
    let path = dir.join("log.sqlite");
    let is_there = |w: WorldKey| files::is_there(&world_path(dir, w, "world"));
    let mut before = None;
    loop {
        let opened = Log::open(&path).and_then(|mut log| {
            let damage = log.compare_with_note(is_there)?;
            Ok((log, damage))
        });
        let error = match opened {
            Ok((log, damage)) => {
                last_end.damage.extend(damage);
                return Ok(log);
            }
            Err(error) => error,
        };
        match error.remedy(before.as_ref()) {
            Remedy::Retry => before = Some(error),
            Remedy::NewLog => {
                let aside = set_aside(&path)?.display().to_string();
                last_end.damage.push(format!(
                    "{error}; it is kept in {aside}, worlds come back from their earlier states"
                ));
                // Notes beside the old log do not apply to it.
                return Log::open(&path);
            }
            Remedy::Free | Remedy::Pause => return Err(error),
        }
    }
}

impl CheckpointStore for LocalStore {
    fn worlds(&mut self) -> Result<StoreContents<WorldRecord>, StoreError> {
        let paths = files::list(&self.dir.join("worlds"), "world")?;
        let mut out = found(paths.clone(), |path| self.read_world(path))?;
        out.whole.iter().for_each(|w| self.know(w.key));
        // The numbers of damaged ones are taken, too.
        let taken = paths.iter().filter_map(|p| key_of(p)).map(|k| k.0).max();
        self.last_key = self.last_key.max(taken.unwrap_or(0));
        // A world known only to the log, because its own file is missing. Worlds with damaged files have already been
        // reported.
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
        self.last_key = now.max(self.last_key.max(known).saturating_add(1));
        WorldKey(self.last_key)
    }

    fn put_world(&mut self, world: &WorldRecord) -> Result<(), StoreError> {
        self.know(world.key);
        records::write_world(&self.world_path(world.key, "world"), world)
    }

    fn delete_world(&mut self, key: WorldKey) -> Result<(), StoreError> {
        let (there, gone) = (self.world_path(key, "world"), self.world_path(key, GONE));
        // From here on the world counts as deleted, even if the process ends. This may be another attempt.
        if there.exists() || !gone.exists() {
            files::rename(&there, &gone)?;
        }
        self.finish_deletion(key)
    }

    fn commit(&mut self, entries: &[StoreEntry]) -> Result<(), StoreError> {
        self.log.commit(entries)
    }

    fn latest(&mut self, worlds: &[WorldKey]) -> Result<Vec<StoredHistory>, StoreError> {
        let mut out = self.log.read(worlds, None)?;
        for (history, world) in out.iter_mut().zip(worlds) {
            if history.checkpoint.is_some() {
                continue;
            }
            let path = self.world_path(*world, "state");
            if !files::is_there(&path) {
                continue; // a world that has just been created has neither
            }
            match records::read_state(&path) {
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
                Err(error) => return Err(error),
            }
        }
        Ok(out)
    }

    fn history_at(&mut self, world: WorldKey, tick: u64) -> Result<StoredHistory, StoreError> {
        let mut histories = self.log.read(&[world], Some(tick))?;
        Ok(histories.pop().unwrap_or_default())
    }

    fn oldest(&mut self, world: WorldKey) -> Option<u64> {
        self.log.oldest(world)
    }

    fn cut(&mut self, limits: &Retention) -> Result<StoreUsage, StoreError> {
        let usage = self.log.cut(limits)?;
        self.write_states(self.states_due());
        Ok(usage)
    }

    fn repair(&mut self, remedy: Remedy) -> Result<Option<String>, StoreError> {
        match remedy {
            Remedy::Free => {
                self.log.free()?;
                Ok(Some("the oldest history is given up".to_owned()))
            }
            Remedy::NewLog => {
                let aside = self.log.begin_anew()?;
                Ok(Some(format!(
                    "a new log is begun; the old one is kept in {}",
                    aside.display()
                )))
            }
            Remedy::Retry | Remedy::Pause => Ok(None),
        }
    }

    fn clips(&mut self) -> Result<StoreContents<ClipRecord>, StoreError> {
        let paths = files::list(&self.dir.join("clips"), "clip")?;
        found(paths, |path| self.read_clip(path))
    }

    fn put_clip(&mut self, clip: &ClipRecord) -> Result<(), StoreError> {
        self.delete_rehearsals(&clip.name)?;
        let hash = Sha256::digest(&clip.content);
        let content = self.content_path(&hash);
        // The existing file may be damaged, so do not assume that it is the same.
        if records::read_content(&content).is_ok_and(|there| there == clip.content) {
            tracing::debug!(
                clip = clip.name,
                "the content of the clip is stored already"
            );
        } else {
            records::write_content(&content, &clip.content)?;
        }
        let file = ClipFile {
            name: clip.name.clone(),
            description: clip.description.clone(),
            hash: hash.to_vec(),
        };
        records::write_clip(&self.clip_path(&clip.name), &file)
    }

    fn rehearsals(&mut self) -> Result<StoreContents<RehearsalRecord>, StoreError> {
        let paths = files::list(&self.dir.join("rehearsals"), "rehearsal")?;
        found(paths, |path| {
            records::read_rehearsal(path).map_err(|e| match e {
                StoreError::Damaged(why) => {
                    StoreError::Damaged(format!("{why}: a clip has to be rehearsed again"))
                }
                other => other,
            })
        })
    }

    fn put_rehearsal(&mut self, r: &RehearsalRecord) -> Result<(), StoreError> {
        records::write_rehearsal(&self.rehearsal_path(&r.clip, &r.figure), r)
    }

    fn delete_rehearsal(&mut self, clip: &str, figure: &str) -> Result<(), StoreError> {
        files::remove(&self.rehearsal_path(clip, figure))
    }

    fn delete_clip(&mut self, name: &str) -> Result<(), StoreError> {
        self.delete_rehearsals(name)?;
        files::remove(&self.clip_path(name))?;
        // If a clip cannot be read, the contents still in use are unknown.
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
        self.write_states(worlds);
        self.log.shrink()?;
        self.marks.clear_all()?;
        records::write_end(&self.dir.join("end"))
    }
}

#[cfg(test)]
impl LocalStore {
    /// The log, so that tests can take its disk away.
    pub(super) fn log(&self) -> &Log {
        &self.log
    }
}
