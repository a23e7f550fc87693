//! A store in memory, for tests. Its content lives as long as its [`Disk`], and the disk can be made to fail.

use super::store::{
    CheckpointStore, ClipRecord, LoggedTick, Loss, RehearsalRecord, Remedy, Retention,
    StoreContents, StoreEntry, StoreError, StoreItem, StoreUsage, StoredHistory, WorldKey,
    WorldRecord,
};
use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The disk of a [`MemoryStore`].
#[derive(Clone, Debug, Default)]
pub struct MemoryDisk(Arc<Mutex<DiskContent>>);

#[derive(Debug, Default)]
struct DiskContent {
    worlds: BTreeMap<WorldKey, WorldRecord>,
    clips: BTreeMap<String, ClipRecord>,
    rehearsals: BTreeMap<(String, String), RehearsalRecord>,
    log: Vec<StoreEntry>,
    fault: Option<StoreError>,
    /// Errors of the next commits, in order.
    next_faults: VecDeque<StoreError>,
    /// Remedies that were applied to faults.
    remedies: Vec<Remedy>,
    commit_time: Duration,
    commits: u64,
    last_key: u64,
    closed: bool,
}

impl MemoryDisk {
    fn content(&self) -> MutexGuard<'_, DiskContent> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Lets every write fail from now on, or none.
    pub fn fail(&self, fault: Option<StoreError>) {
        self.content().fault = fault;
    }

    /// Lets only the next commits fail, each with one of these.
    pub fn fail_next(&self, faults: &[StoreError]) {
        self.content().next_faults.extend(faults.iter().cloned());
    }

    /// Remedies applied to faults until now.
    pub fn remedies(&self) -> Vec<Remedy> {
        self.content().remedies.clone()
    }

    /// Sets the duration of each commit.
    pub fn slow_down(&self, commit_time: Duration) {
        self.content().commit_time = commit_time;
    }

    /// Number of commits.
    pub fn commits(&self) -> u64 {
        self.content().commits
    }

    /// Everything that was written, in order.
    pub fn log(&self) -> Vec<StoreEntry> {
        self.content().log.clone()
    }

    /// Whether a store on it has ended in good order.
    pub fn is_closed(&self) -> bool {
        self.content().closed
    }
}

/// A store in memory.
#[derive(Clone, Debug, Default)]
pub struct MemoryStore(pub MemoryDisk);

impl MemoryStore {
    fn writable(&self) -> Result<MutexGuard<'_, DiskContent>, StoreError> {
        let content = self.0.content();
        match &content.fault {
            Some(fault) => Err(fault.clone()),
            None => Ok(content),
        }
    }

    fn history(content: &DiskContent, world: WorldKey, at: Option<u64>) -> StoredHistory {
        let mut history = StoredHistory::default();
        for entry in content.log.iter().filter(|e| e.world == world) {
            match &entry.item {
                StoreItem::Checkpoint { bytes, after_gap } => {
                    if at.is_none_or(|at| entry.tick <= at) {
                        history.checkpoint = Some((entry.tick, bytes.clone()));
                        history.entries.clear();
                    } else if *after_gap {
                        history.losses.push(Loss {
                            after_tick: history.last_tick(),
                            why: "a part of its log was not written".to_owned(),
                        });
                        break;
                    }
                }
                item => history.entries.push(LoggedTick {
                    tick: entry.tick,
                    item: item.clone(),
                }),
            }
        }
        history
    }
}

impl CheckpointStore for MemoryStore {
    fn worlds(&mut self) -> Result<StoreContents<WorldRecord>, StoreError> {
        Ok(StoreContents {
            whole: self.0.content().worlds.values().cloned().collect(),
            damaged: Vec::new(),
        })
    }

    fn new_key(&mut self) -> WorldKey {
        let mut content = self.0.content();
        content.last_key += 1;
        WorldKey(content.last_key)
    }

    fn put_world(&mut self, world: &WorldRecord) -> Result<(), StoreError> {
        self.writable()?.worlds.insert(world.key, world.clone());
        Ok(())
    }

    fn delete_world(&mut self, key: WorldKey) -> Result<(), StoreError> {
        let mut content = self.writable()?;
        content.worlds.remove(&key);
        content.log.retain(|e| e.world != key);
        Ok(())
    }

    fn commit(&mut self, entries: &[StoreEntry]) -> Result<(), StoreError> {
        let until = Instant::now() + self.0.content().commit_time;
        while let Some(left) = until
            .checked_duration_since(Instant::now())
            .filter(|d| !d.is_zero())
        {
            std::thread::park_timeout(left);
        }
        if let Some(fault) = self.0.content().next_faults.pop_front() {
            return Err(fault);
        }
        let mut content = self.writable()?;
        content.log.extend_from_slice(entries);
        content.commits += 1;
        Ok(())
    }

    fn latest(&mut self, worlds: &[WorldKey]) -> Result<Vec<StoredHistory>, StoreError> {
        let content = self.0.content();
        let history = |w: &WorldKey| Self::history(&content, *w, None);
        Ok(worlds.iter().map(history).collect())
    }

    fn history_at(&mut self, world: WorldKey, tick: u64) -> Result<StoredHistory, StoreError> {
        Ok(Self::history(&self.0.content(), world, Some(tick)))
    }

    fn oldest(&mut self, world: WorldKey) -> Option<u64> {
        let content = self.0.content();
        let checkpoint =
            |e: &&StoreEntry| e.world == world && matches!(e.item, StoreItem::Checkpoint { .. });
        content.log.iter().find(checkpoint).map(|e| e.tick)
    }

    /// Holds everything: tests are short.
    fn cut(&mut self, _limits: &Retention) -> Result<StoreUsage, StoreError> {
        let content = self.0.content();
        let checkpoint = |e: &&StoreEntry| matches!(e.item, StoreItem::Checkpoint { .. });
        Ok(StoreUsage {
            history_bytes: content.log.iter().map(|e| e.size() as u64).sum(),
            checkpoints: content.log.iter().filter(checkpoint).count(),
            unswept: false,
        })
    }

    fn repair(&mut self, remedy: Remedy) -> Result<Option<String>, StoreError> {
        self.0.content().remedies.push(remedy);
        Ok(None)
    }

    fn clips(&mut self) -> Result<StoreContents<ClipRecord>, StoreError> {
        Ok(StoreContents {
            whole: self.0.content().clips.values().cloned().collect(),
            damaged: Vec::new(),
        })
    }

    fn put_clip(&mut self, clip: &ClipRecord) -> Result<(), StoreError> {
        let mut content = self.writable()?;
        content.clips.insert(clip.name.clone(), clip.clone());
        content.rehearsals.retain(|(c, _), _| *c != clip.name);
        Ok(())
    }

    fn delete_clip(&mut self, name: &str) -> Result<(), StoreError> {
        let mut content = self.writable()?;
        content.clips.remove(name);
        content.rehearsals.retain(|(clip, _), _| clip != name);
        Ok(())
    }

    fn rehearsals(&mut self) -> Result<StoreContents<RehearsalRecord>, StoreError> {
        Ok(StoreContents {
            whole: self.0.content().rehearsals.values().cloned().collect(),
            damaged: Vec::new(),
        })
    }

    fn put_rehearsal(&mut self, r: &RehearsalRecord) -> Result<(), StoreError> {
        let key = (r.clip.clone(), r.figure.clone());
        self.writable()?.rehearsals.insert(key, r.clone());
        Ok(())
    }

    fn delete_rehearsal(&mut self, clip: &str, figure: &str) -> Result<(), StoreError> {
        let key = (clip.to_owned(), figure.to_owned());
        self.writable()?.rehearsals.remove(&key);
        Ok(())
    }

    fn close(&mut self) -> Result<(), StoreError> {
        self.0.content().closed = true;
        Ok(())
    }
}
