//! What a store of worlds and clips has to do, in terms of bytes. One machine keeps them in files
//! ([`LocalStore`](super::local::LocalStore)); several machines will keep them elsewhere behind the same trait.

use bytes::Bytes;
use std::fmt;
use std::ops::Range;
use std::path::PathBuf;
use std::time::Duration;

/// Number of a stored world. None is given twice, so that a later world of the same name has a history of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct WorldKey(pub u64);

impl WorldKey {
    /// The key that is printed like this.
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

/// How much of a world may be lost when the process or the machine ends without notice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Durability {
    /// Everything since the last orderly end.
    None,
    /// What the last group of inputs holds: the inputs of 10 ms and the time of one commit.
    #[default]
    Group,
    /// Nothing that was answered: a request is answered when its input is on disk.
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

/// A stored world: that it exists, and what it was created with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WorldRecord {
    /// Its number.
    pub key: WorldKey,
    /// Last part of its name.
    pub name: String,
    /// How much of it may be lost.
    pub durability: Durability,
    /// Why it is not brought back when the server starts.
    pub quarantined: Option<String>,
    /// What it was created with, in the encoding of who stores it.
    pub settings: Bytes,
}

/// A stored clip.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClipRecord {
    /// Last part of its name.
    pub name: String,
    /// What is known about it, in the encoding of who stores it.
    pub description: Bytes,
    /// The motion itself.
    pub content: Bytes,
}

/// A clip rehearsed for a figure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RehearsalRecord {
    /// Name of the clip.
    pub clip: String,
    /// Whom for, as a short name of letters and digits: one clip has one rehearsal of each.
    pub figure: String,
    /// It, in the encoding of who stores it.
    pub content: Bytes,
}

/// What is written of a world.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Item {
    /// The whole state after a tick.
    Checkpoint {
        /// The state.
        bytes: Bytes,
        /// Something before it was not written: what is before does not lead here.
        after_gap: bool,
    },
    /// What changed the world before a tick.
    Input(Bytes),
    /// Hash of the state after a tick.
    Hash(u64),
}

/// One thing that is written of one world. The order of entries is the order of what happened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// World.
    pub world: WorldKey,
    /// Tick that it belongs to.
    pub tick: u64,
    /// What it is.
    pub item: Item,
}

impl Entry {
    /// Bytes that it takes, about.
    pub fn size(&self) -> usize {
        32 + match &self.item {
            Item::Checkpoint { bytes, .. } | Item::Input(bytes) => bytes.len(),
            Item::Hash(_) => 8,
        }
    }
}

/// Input or hash of a tick, as it is read back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Logged {
    /// Tick that it belongs to.
    pub tick: u64,
    /// What it is; never a checkpoint.
    pub item: Item,
}

/// What is lost of a world.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loss {
    /// The last tick that is whole; `None`: nothing is.
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

/// A world as it can be brought back: a checkpoint and everything that was written behind it. What is here is what was
/// written; where something is damaged, it ends, and says so.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct History {
    /// Tick and bytes.
    pub checkpoint: Option<(u64, Bytes)>,
    /// Inputs and hashes behind it, in order.
    pub entries: Vec<Logged>,
    /// What is known to be missing.
    pub losses: Vec<Loss>,
}

impl History {
    /// The last tick that is known.
    pub fn last_tick(&self) -> Option<u64> {
        let checkpoint = self.checkpoint.as_ref().map(|c| c.0);
        self.entries.last().map(|e| e.tick).max(checkpoint)
    }
}

/// How much history is held.
#[derive(Clone, Copy, Debug)]
pub struct Retention {
    /// Age of the oldest.
    pub age: Duration,
    /// Bytes of one world.
    pub world_bytes: u64,
    /// Bytes of all worlds.
    pub total_bytes: u64,
}

/// What is held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Usage {
    /// Bytes of history.
    pub history_bytes: u64,
    /// Checkpoints.
    pub checkpoints: usize,
    /// There may be more to delete of what has been cut off.
    pub unswept: bool,
}

/// What the store found when it read its own directory.
#[derive(Clone, Debug, Default)]
pub struct Found<T> {
    /// What is whole.
    pub whole: Vec<T>,
    /// What is damaged: where it lies, and what is wrong with it.
    pub damaged: Vec<String>,
}

/// Why the store could not do something.
#[derive(Clone, Debug, thiserror::Error)]
pub enum StoreError {
    /// Another process uses the directory.
    #[error(
        "{path}: another server uses this directory ({holder}); one directory serves one server"
    )]
    InUse {
        /// The directory.
        path: PathBuf,
        /// What is known of the other.
        holder: String,
    },
    /// It was written by a later version.
    #[error(
        "{path}: written in format {found} by a later version of sinew; this one reads format {known}"
    )]
    NewerFormat {
        /// Where.
        path: PathBuf,
        /// Format found.
        found: u32,
        /// Latest format that is known.
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
    /// No space is left on the disk, or as much as is allowed is taken.
    #[error("{0}: the disk is full")]
    Full(String),
    /// The disk takes no writes.
    #[error("{0}: the disk is read-only")]
    ReadOnly(String),
    /// Another program keeps the disk to itself. Nothing is wrong with what is on it.
    #[error("{0}: another program uses it")]
    Busy(String),
    /// What is on disk is not what was written.
    #[error("{0}")]
    Damaged(String),
    /// Anything else that the disk says.
    #[error("{0}")]
    Io(String),
    /// The store has ended.
    #[error("the store has ended")]
    Ended,
}

/// What is done about an error of the log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// The same is tried once more, at once.
    Retry,
    /// Old history is given up to make space; then the same is tried once more.
    Free,
    /// Nothing is written until a later try goes well. The log stays.
    Pause,
    /// The log is set aside, and a new one is begun.
    NewLog,
}

impl StoreError {
    /// What is done about this error of the log. `before`: what the same said when it was tried just before.
    ///
    /// The whole history is given up only for what is known to be damaged, and nothing else lasts.
    pub fn remedy(&self, before: Option<&Self>) -> Remedy {
        match (before, self) {
            (None, Self::Full(_)) => Remedy::Free,
            // A moment, perhaps. SQLite calls the file damaged when the disk fails to read a page, too.
            (None, Self::Io(_) | Self::Damaged(_)) => Remedy::Retry,
            (Some(Self::Damaged(_)), Self::Damaged(_)) => Remedy::NewLog,
            // Busy, read-only, still full, still failing: what is on disk may be whole.
            _ => Remedy::Pause,
        }
    }
}

/// Keeps worlds and clips. Every method blocks until it is done, and what it has written is on disk when it returns;
/// [`Keeper`](super::keeper::Keeper) calls it on a thread of its own.
pub trait CheckpointStore: Send {
    /// All worlds.
    ///
    /// # Errors
    /// The directory cannot be read.
    fn worlds(&mut self) -> Result<Found<WorldRecord>, StoreError>;

    /// A number for a new world.
    fn new_key(&mut self) -> WorldKey;

    /// Writes a world, in place of what was written of it before.
    ///
    /// # Errors
    /// It could not be written; what was written before is still there.
    fn put_world(&mut self, world: &WorldRecord) -> Result<(), StoreError>;

    /// Forgets a world and its history.
    ///
    /// # Errors
    /// It could not be done.
    fn delete_world(&mut self, key: WorldKey) -> Result<(), StoreError>;

    /// Writes entries: all of them or, with an error, none. The first entry of a world since the store was opened must
    /// be a checkpoint, and so must the first after something was not written.
    ///
    /// # Errors
    /// They could not be written.
    fn commit(&mut self, entries: &[Entry]) -> Result<(), StoreError>;

    /// For each world the latest state that is whole, and what was written behind it.
    ///
    /// # Errors
    /// Nothing can be read. Damage to single worlds stands in their histories.
    fn latest(&mut self, worlds: &[WorldKey]) -> Result<Vec<History>, StoreError>;

    /// As [`latest`](Self::latest) for one world, from its last checkpoint at or before a tick.
    ///
    /// # Errors
    /// Nothing can be read.
    fn history_at(&mut self, world: WorldKey, tick: u64) -> Result<History, StoreError>;

    /// The tick of the oldest checkpoint of a world that is held.
    fn oldest(&mut self, world: WorldKey) -> Option<u64>;

    /// Hashes of the states after ticks, as they were written last.
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
        // Histories end where the server was started anew; the next one begins with a checkpoint of its own.
        while from < ticks.end {
            let history = self.history_at(world, from)?;
            let Some(last) = history.last_tick().filter(|last| *last >= from) else {
                break;
            };
            for entry in &history.entries {
                if let Item::Hash(hash) = entry.item
                    && ticks.contains(&entry.tick)
                {
                    out.insert(entry.tick, hash);
                }
            }
            from = last.saturating_add(1);
        }
        Ok(out.into_iter().collect())
    }

    /// Cuts old history off. The latest checkpoint of each world and what is behind it stay.
    ///
    /// # Errors
    /// It could not be done.
    fn cut(&mut self, limits: &Retention) -> Result<Usage, StoreError>;

    /// Does what [`remedy`](StoreError::remedy) says, if that is something for the store to do. Returns what was done.
    ///
    /// # Errors
    /// It could not be done.
    fn repair(&mut self, remedy: Remedy) -> Result<Option<String>, StoreError>;

    /// All clips.
    ///
    /// # Errors
    /// The directory cannot be read.
    fn clips(&mut self) -> Result<Found<ClipRecord>, StoreError>;

    /// Writes a clip, which has no rehearsals then.
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
    fn rehearsals(&mut self) -> Result<Found<RehearsalRecord>, StoreError>;

    /// Writes a rehearsal, in place of one of the same clip for the same figure.
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
    /// It could not be noted; the next start looks for what crashed.
    fn close(&mut self) -> Result<(), StoreError>;
}
