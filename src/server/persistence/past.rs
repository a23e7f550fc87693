//! The past of a world in the log: its last state, and the parts that recordings keep.

use super::Persistence;
use crate::checkpoints;
use crate::durable::store::{self, StoreItem, StoredHistory, WorldKey, WorldRecord};
use crate::recordings::StoredRecording;
use crate::tick::journal::{self, JournalItem, JournalSegment};
use crate::tick::replay::{Replay, ReplayError};
use crate::tick::scene::Scene;
use crate::worlds::WorldHandle;
use sinew_wire::status::Fault;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// The log up to the first entry that cannot be read: its tick, and the reason.
fn read_entries(entries: &[store::LoggedTick]) -> (Vec<JournalItem>, Option<(u64, String)>) {
    let mut out = Vec::with_capacity(entries.len());
    for entry in entries {
        out.push(match &entry.item {
            StoreItem::Hash(hash) => JournalItem::Hash(entry.tick, *hash),
            StoreItem::Input(bytes) => match journal::from_disk(entry.tick, bytes) {
                Ok(record) => JournalItem::Record(record),
                Err(why) => return (out, Some((entry.tick, why))),
            },
            StoreItem::Checkpoint { .. } => continue,
        });
    }
    (out, None)
}

/// Result of a replay: the scene, the differences from the record, and how many hashes were compared.
struct Replayed {
    scene: Scene,
    through: Result<(), ReplayError>,
    compared: u64,
}

/// Replays the entries logged after a state, up to tick `until`. `reached` is set to the last tick that was done, even
/// if this panics.
///
/// # Errors
/// The state cannot be used.
fn replay(
    state: &[u8],
    entries: &[JournalItem],
    until: u64,
    reached: &AtomicU64,
) -> Result<Replayed, Fault> {
    let scene = checkpoints::decode("checkpoint", state)?;
    let mut replay = Replay::new(scene);
    let through = replay.through(entries, until, &mut |scene| {
        reached.store(scene.world().tick(), Ordering::Relaxed);
        true
    });
    Ok(Replayed {
        through,
        compared: replay.compared,
        scene: replay.scene,
    })
}

/// The last intact state of a world: its checkpoint, and the entries recorded after it. `None`: there is none, or this
/// program cannot continue from it.
pub(super) async fn last_state(record: &WorldRecord, history: &StoredHistory) -> Option<Scene> {
    let (tick, bytes) = history.checkpoint.clone()?;
    let world = &*record.name;
    let (entries, unreadable) = read_entries(&history.entries);
    if let Some((tick, why)) = unreadable {
        tracing::error!(world, tick, why, "what follows is lost");
    }
    let entries = Arc::new(entries);
    let mut until = u64::MAX;
    loop {
        let last = Arc::new(AtomicU64::new(tick));
        let (bytes, entries, reached) = (bytes.clone(), entries.clone(), last.clone());
        let work = move || replay(&bytes, &entries, until, &reached);
        let why = match tokio::task::spawn_blocking(work).await {
            Ok(Ok(done)) => match done.through {
                Ok(()) => {
                    let state = done.scene.world();
                    let (tick, hash) = (state.tick(), format!("{:016x}", state.state_hash()));
                    let compared = done.compared;
                    tracing::info!(world, tick, hash, compared, "world is as it was");
                    return Some(done.scene);
                }
                Err(why) => why.to_string(),
            },
            Ok(Err(why)) => {
                tracing::error!(world, tick, %why, "the state is lost: the world begins anew");
                return None;
            }
            Err(panic) => panic.to_string(),
        };
        let after = last.load(Ordering::Relaxed);
        if after >= until || until == tick {
            tracing::error!(
                world,
                tick,
                why,
                "the state has another hash: the world begins anew"
            );
            return None;
        }
        tracing::error!(world, after_tick = after, why, "what follows is lost");
        until = after;
    }
}

impl Persistence {
    /// Brings back a recording, with the part of it that the log still has.
    pub(super) async fn bring_recording_back(
        &self,
        handle: &Arc<WorldHandle>,
        key: WorldKey,
        stored: StoredRecording,
    ) {
        let Some(journal) = &handle.journal else {
            return; // no past is kept at all
        };
        let now = handle.latest().tick;
        let until = stored.last.unwrap_or(now);
        let most = self.recordings.most_bytes();
        let kept = self.recorded(key, (stored.first, until), most).await;
        let kept = kept.unwrap_or_else(|why| {
            let (world, recording) = (&*handle.id, &*stored.id);
            tracing::error!(world, recording, %why, "a recording cannot be read");
            Vec::new()
        });
        let at = (&*handle.id, now);
        self.recordings.bring_back(journal, at, stored, kept);
    }

    /// The part of the log of a world's past from tick `first` to tick `until`, at most `most` bytes of it: one part
    /// for each server that has written it.
    async fn recorded(
        &self,
        key: WorldKey,
        (first, until): (u64, u64),
        most: u64,
    ) -> Result<Vec<Arc<JournalSegment>>, Fault> {
        let oldest = self.on_disk(move |store| Ok(store.oldest(key))).await?;
        let oldest = oldest.unwrap_or(u64::MAX);
        let (mut next, mut bytes, mut out) = (Some(first.max(oldest)), 0, Vec::new());
        while let Some(from) = next.filter(|from| *from <= until && bytes <= most) {
            let read = self.on_disk(move |store| store.history_at(key, from));
            let history = read.await?;
            let (Some((_, state)), Some(last)) = (&history.checkpoint, history.last_tick()) else {
                break;
            };
            if last < from {
                break;
            }
            let (state, entries) = (state.clone(), read_entries(&history.entries).0);
            let segment = tokio::task::spawn_blocking(move || {
                let scene = checkpoints::decode("checkpoint", &state)?;
                Ok::<_, Fault>(JournalSegment::of_disk(scene, entries, until))
            });
            let segment = segment
                .await
                .map_err(|e| Fault::Internal(e.to_string()))??;
            bytes += segment.bytes();
            next = segment.last_tick().max(last).checked_add(1);
            out.push(segment);
        }
        Ok(out)
    }
}
