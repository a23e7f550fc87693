//! The interface of a store of worlds and clips, in terms of bytes. One machine keeps them in files
//! ([`LocalStore`](super::local::LocalStore)); several machines will keep them elsewhere behind the same trait.

use bytes::Bytes;
use std::fmt;
use std::ops::Range;
use std::path::PathBuf;
use std::time::Duration;

/// Number of a stored world. No number is assigned twice, so that a later world of the same name has its own history.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct WorldKey(pub u64);

impl WorldKey {
    /// The key that is printed as `text`.
    pub fn parse(text: &str) -> Option<Self> {
        let key = u64::from_str_radix(text, 16).ok().map(Self);
        key.filter(|k| k.to_string() == text)
    }
}

impl fmt::Display for WorldKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

/// Amount of a world that may be lost when the process or the machine ends without notice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Durability {
    /// Everything since the last orderly end.
    None,
    /// The last group of inputs: those of 10 ms and of the time of one commit.
    #[default]
    Group,
    /// No answered request: a request is answered only once its input is on disk.
    Each,
}

impl Durability {
    /// Its name in settings and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Group => "group",
            Self::Each => "each",
        }
    }

    /// By its name.
    pub fn by_name(name: &str) -> Option<Self> {
        [Self::None, Self::Group, Self::Each]
            .into_iter()
            .find(|d| d.name() == name)
    }
}

/// A stored world: its existence and its settings at creation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WorldRecord {
    /// Its number.
    pub key: WorldKey,
    /// Last part of its name.
    pub name: String,
    /// Its guarantee against loss.
    pub durability: Durability,
    /// Reason why it is not brought back when the server starts.
    pub quarantined: Option<String>,
    /// Its settings at creation, in the caller's encoding.
    pub settings: Bytes,
}

/// A stored clip.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClipRecord {
    /// Last part of its name.
    pub name: String,
    /// Its description, in the caller's encoding.
    pub description: Bytes,
    /// The motion itself.
    pub content: Bytes,
}

/// A clip rehearsed for a figure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RehearsalRecord {
    /// Name of the clip.
    pub clip: String,
    /// The figure for which it was rehearsed, as a short name of letters and digits; a clip has one rehearsal for each.
    pub figure: String,
    /// The rehearsal, in the caller's encoding.
    pub content: Bytes,
}

/// Data written for a world.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StoreItem {
    /// The whole state after a tick.
    Checkpoint {
        /// The state.
        bytes: Bytes,
        /// Whether something before it was not written, so that the earlier entries do not lead here.
        after_gap: bool,
    },
    /// Changes to the world before a tick.
    Input(Bytes),
    /// Hash of the state after a tick.
    Hash(u64),
}

/// One entry of one world. The order of entries is the order of events.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StoreEntry {
    /// World.
    pub world: WorldKey,
    /// Tick to which it belongs.
    pub tick: u64,
    /// Its content.
    pub item: StoreItem,
}

impl StoreEntry {
    /// Approximate size in bytes.
    pub fn size(&self) -> usize {
        32 + match &self.item {
            StoreItem::Checkpoint { bytes, .. } | StoreItem::Input(bytes) => bytes.len(),
            StoreItem::Hash(_) => 8,
        }
    }
}

/// Input or hash of a tick, as it is read back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoggedTick {
    /// Tick to which it belongs.
    pub tick: u64,
    /// Its content; never a checkpoint.
    pub item: StoreItem,
}

/// A loss in the history of a world.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loss {
    /// The last intact tick; `None` if there is none.
    pub after_tick: Option<u64>,
    /// Why.
    pub why: String,
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.after_tick {
            Some(tick) => write!(f, "ticks after {tick} are lost: {}", self.why),
            None => write!(f, "all ticks are lost: {}", self.why),
        }
    }
}

/// A world as it can be brought back: a checkpoint and everything written after it. It contains only data as they were
/// written; at a damaged place it ends and reports the loss.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StoredHistory {
    /// Tick and bytes.
    pub checkpoint: Option<(u64, Bytes)>,
    /// Inputs and hashes after it, in order.
    pub entries: Vec<LoggedTick>,
    /// Known losses.
    pub losses: Vec<Loss>,
}

impl StoredHistory {
    /// The last known tick.
    pub fn last_tick(&self) -> Option<u64> {
        let checkpoint = self.checkpoint.as_ref().map(|c| c.0);
        self.entries.last().map(|e| e.tick).max(checkpoint)
    }
}

/// Limits on the history that is held.
#[derive(Clone, Copy, Debug)]
pub struct Retention {
    /// Age of the oldest.
    pub age: Duration,
    /// Bytes of one world.
    pub world_bytes: u64,
    /// Bytes of all worlds.
    pub total_bytes: u64,
}

/// Amount of history that is held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StoreUsage {
    /// Bytes of history.
    pub history_bytes: u64,
    /// Checkpoints.
    pub checkpoints: usize,
    /// Whether there may be more rows to delete.
    pub unswept: bool,
}

/// Data that the store found in its own directory.
#[derive(Clone, Debug, Default)]
pub struct StoreContents<T> {
    /// Intact records.
    pub whole: Vec<T>,
    /// Damaged files: place and fault of each.
    pub damaged: Vec<String>,
}

/// Reason why the store could not do something.
#[derive(Clone, Debug, thiserror::Error)]
pub enum StoreError {
    /// Another process uses the directory.
    #[error(
        "{path}: another server uses this directory ({holder}); one directory serves one server"
    )]
    InUse {
        /// The directory.
        path: PathBuf,
        /// Known data about the other process.
        holder: String,
    },
    /// It was written by a later version.
    #[error(
        "{path}: written in format {found} by a later version of sinew; this one reads format {known}"
    )]
    NewerFormat {
        /// The file or directory.
        path: PathBuf,
        /// Format found.
        found: u32,
        /// Latest format known to this version.
        known: u32,
    },
    /// The directory cannot be used.
    #[error("{path}: {why}")]
    Directory {
        /// The directory.
        path: PathBuf,
        /// Why.
        why: String,
    },
    /// No space is left on the disk, or the permitted space is used up.
    #[error("{0}: the disk is full")]
    Full(String),
    /// The disk takes no writes.
    #[error("{0}: the disk is read-only")]
    ReadOnly(String),
    /// Another program holds an exclusive lock. The data themselves are fine.
    #[error("{0}: another program uses it")]
    Busy(String),
    /// The data on disk are not those that were written.
    #[error("{0}")]
    Damaged(String),
    /// Any other error of the disk.
    #[error("{0}")]
    Io(String),
    /// The store has ended.
    #[error("the store has ended")]
    Ended,
}

/// Remedy for an error of the log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// The operation is repeated once, immediately.
    Retry,
    /// Old history is given up to make space; then the operation is repeated once.
    Free,
    /// Nothing is written until a later attempt succeeds. The log stays.
    Pause,
    /// The log is set aside, and a new one is begun.
    NewLog,
}

impl StoreError {
    /// The remedy for this error of the log. `before`: the error of the previous attempt, if any.
    ///
    /// The whole history is given up only for known damage; every other fault is temporary.
    pub fn remedy(&self, before: Option<&Self>) -> Remedy {
        match (before, self) {
            (None, Self::Full(_)) => Remedy::Free,
            // This may be temporary: SQLite calls the file damaged even when the disk only fails to read a page.
            (None, Self::Io(_) | Self::Damaged(_)) => Remedy::Retry,
            (Some(Self::Damaged(_)), Self::Damaged(_)) => Remedy::NewLog,
            // Busy, read-only, still full, still failing: the data on disk may be intact.
            _ => Remedy::Pause,
        }
    }
}

/// Keeps worlds and clips. Every method blocks until it is done, and its data are on disk when it returns;
/// [`Keeper`](super::keeper::Keeper) calls them on its own thread.
pub trait CheckpointStore: Send {
    /// All worlds.
    ///
    /// # Errors
    /// The directory cannot be read.
    fn worlds(&mut self) -> Result<StoreContents<WorldRecord>, StoreError>;

    /// A number for a new world.
    fn new_key(&mut self) -> WorldKey;

    /// Writes a world, replacing its earlier record.
    ///
    /// # Errors
    /// It could not be written; the earlier record is still there.
    fn put_world(&mut self, world: &WorldRecord) -> Result<(), StoreError>;

    /// Forgets a world and its history.
    ///
    /// # Errors
    /// It could not be done.
    fn delete_world(&mut self, key: WorldKey) -> Result<(), StoreError>;

    /// Writes entries: all of them or, with an error, none. The first entry of a world since the store was opened must
    /// be a checkpoint, and so must the first entry after a gap.
    ///
    /// # Errors
    /// They could not be written.
    fn commit(&mut self, entries: &[StoreEntry]) -> Result<(), StoreError>;

    /// For each world, the latest intact state and everything written after it.
    ///
    /// # Errors
    /// Nothing can be read. Damage to single worlds is reported in their histories.
    fn latest(&mut self, worlds: &[WorldKey]) -> Result<Vec<StoredHistory>, StoreError>;

    /// As [`latest`](Self::latest) for one world, from its last checkpoint at or before a tick.
    ///
    /// # Errors
    /// Nothing can be read.
    fn history_at(&mut self, world: WorldKey, tick: u64) -> Result<StoredHistory, StoreError>;

    /// The tick of the oldest checkpoint of a world that is held.
    fn oldest(&mut self, world: WorldKey) -> Option<u64>;

    /// Hashes of the states after ticks, as last written.
    ///
    /// # Errors
    /// Nothing can be read.
    fn hashes(
        &mut self,
        world: WorldKey,
        ticks: Range<u64>,
    ) -> Result<Vec<(u64, u64)>, StoreError> {
        let mut out = std::collections::BTreeMap::new();
        let mut from = ticks.start;
        // Histories end where the server was restarted; the next one begins with its own checkpoint.
        while from < ticks.end {
            let history = self.history_at(world, from)?;
            let Some(last) = history.last_tick().filter(|last| *last >= from) else {
                break;
            };
            for entry in &history.entries {
                if let StoreItem::Hash(hash) = entry.item
                    && ticks.contains(&entry.tick)
                {
                    out.insert(entry.tick, hash);
                }
            }
            from = last.saturating_add(1);
        }
        Ok(out.into_iter().collect())
    }

    /// Cuts off old history. The latest checkpoint of each world and everything after it stay.
    ///
    /// # Errors
    /// It could not be done.
    fn cut(&mut self, limits: &Retention) -> Result<StoreUsage, StoreError>;

    /// Applies a [`remedy`](StoreError::remedy), if it concerns the store. Returns a description of the action.
    ///
    /// # Errors
    /// It could not be done.
    fn repair(&mut self, remedy: Remedy) -> Result<Option<String>, StoreError>;

    /// All clips.
    ///
    /// # Errors
    /// The directory cannot be read.
    fn clips(&mut self) -> Result<StoreContents<ClipRecord>, StoreError>;

    /// Writes a clip; it has no rehearsals afterwards.
    ///
    /// # Errors
    /// It could not be written.
    fn put_clip(&mut self, clip: &ClipRecord) -> Result<(), StoreError>;

    /// Forgets a clip and its rehearsals.
    ///
    /// # Errors
    /// It could not be done.
    fn delete_clip(&mut self, name: &str) -> Result<(), StoreError>;

    /// All rehearsals.
    ///
    /// # Errors
    /// The directory cannot be read.
    fn rehearsals(&mut self) -> Result<StoreContents<RehearsalRecord>, StoreError>;

    /// Writes a rehearsal, replacing that of the same clip for the same figure.
    ///
    /// # Errors
    /// It could not be written.
    fn put_rehearsal(&mut self, rehearsal: &RehearsalRecord) -> Result<(), StoreError>;

    /// Forgets a rehearsal.
    ///
    /// # Errors
    /// It could not be done.
    fn delete_rehearsal(&mut self, clip: &str, figure: &str) -> Result<(), StoreError>;

    /// Notes that this end is orderly. Nothing is written afterwards.
    ///
    /// # Errors
    /// It could not be noted, so the next start looks for a crash.
    fn close(&mut self) -> Result<(), StoreError>;
}
