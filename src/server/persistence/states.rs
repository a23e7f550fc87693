//! Writes the states of worlds to disk while they run.

use super::{Persistence, origin};
use crate::app::App;
use crate::checkpoints;
use crate::durable::store::Durability;
use crate::tick::hosted_world::HostedWorld;
use crate::worlds::{Persisted, WorldHandle};
use sinew_wire::status::Fault;
use std::sync::Arc;
use std::time::Duration;

/// Interval at which a world is checked for changes that it does not announce.
const LOOK_EVERY: Duration = Duration::from_secs(1);

/// Tick and hash of a state.
type StateId = (u64, u64);

/// Hands the latest checkpoint of a world to the disk, unless it is the one that was written before. Returns which
/// state is being written.
///
/// # Errors
/// It cannot be encoded.
pub(super) async fn write(
    handle: &WorldHandle,
    before: Option<StateId>,
) -> Result<Option<StateId>, Fault> {
    let Some(journal) = &handle.journal else {
        return Ok(before);
    };
    // If the world is rewound in the meantime, there is another checkpoint to write.
    while let Some(capture) = journal.to_write(before) {
        let encoded = Arc::clone(&capture);
        let bytes = tokio::task::spawn_blocking(move || checkpoints::encode(&encoded));
        let bytes = bytes.await.map_err(|e| Fault::Internal(e.to_string()))??;
        if journal.write(&capture, bytes.into()) {
            return Ok(Some((capture.tick(), capture.hash())));
        }
    }
    Ok(before)
}

impl Persistence {
    /// Writes the state of every world.
    pub async fn checkpoint_all(&self, app: &App) {
        let worlds = app.worlds.list();
        let all = worlds.iter().map(|handle| async move {
            let now = |s: &mut HostedWorld| {
                s.checkpoint_now();
                Ok(())
            };
            let written = match handle.call(origin(), now).await {
                Ok(()) => write(handle, None).await,
                Err(error) => Err(error),
            };
            if let Err(error) = &written {
                tracing::error!(world = &*handle.id, %error, "the last state is not written");
            }
        });
        futures_util::future::join_all(all).await;
    }

    /// Writes states of a world, and changes that no client waits for, until the world ends.
    pub(super) fn follow(self: &Arc<Self>, handle: &Arc<WorldHandle>) {
        let mut changes = handle.outlet.described.subscribe();
        let mut closed = handle.closed.clone();
        let place = *handle.stored.borrow();
        let record = self.catalogue.get(&handle.id);
        let record = record.filter(|w| Persisted::At(w.key) == place);
        let Some(recorder) = record.map(|w| self.keeper.recorder(&w)) else {
            return;
        };
        let writes = recorder.durability() != Durability::None;
        if let Some(journal) = &handle.journal {
            journal.write_to(recorder);
        }
        let mut written = None;
        let (this, handle) = (Arc::downgrade(self), Arc::downgrade(handle));
        tokio::spawn(async move {
            loop {
                tokio::select! {
                    _ = closed.changed() => break,
                    changed = changes.changed() => if changed.is_err() { break },
                    () = tokio::time::sleep(LOOK_EVERY) => {}
                }
                let (Some(this), Some(handle)) = (this.upgrade(), handle.upgrade()) else {
                    break;
                };
                if writes {
                    match write(&handle, written).await {
                        Ok(state) => written = state,
                        Err(error) => {
                            tracing::warn!(world = &*handle.id, %error, "a state is not written");
                        }
                    }
                }
                match this.changed(&handle).await {
                    Ok(()) => {}
                    Err(Fault::Draining | Fault::Aborted { .. }) => break, // it has ended
                    Err(error) => {
                        tracing::warn!(world = &*handle.id, %error, "a change is not written");
                        tokio::time::sleep(LOOK_EVERY).await;
                    }
                }
            }
        });
    }
}
