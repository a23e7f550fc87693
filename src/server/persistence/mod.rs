//! Worlds and clips of this server in its data directory. Existing ones are brought back at a start. Whatever is
//! created, changed or deleted is on disk before the client gets its answer.
//!
//! A world is brought back from its last state on disk, which is at most some seconds old, and from its settings,
//! figures and obstacles, which are always those of the last answer.
//!
//! [`described`] is the form of worlds and clips on disk, [`catalogue`] the stored world of each name. [`worlds`] and
//! [`clips`] write their creation, changes and deletion to disk, [`states`] the states of worlds. [`restore`] runs at a
//! start; it gets the past of a world from [`past`].

mod catalogue;
mod clips;
mod described;
mod past;
mod restore;
mod states;
#[cfg(test)]
mod tests;
mod worlds;

use super::config::Config;
use super::durable::keeper::{HandedIn, Keeper, KeeperSizes};
use super::durable::local::LocalStore;
use super::durable::marks::Marks;
use super::durable::recovery::{Recovered, recover};
use super::durable::store::{CheckpointStore, Durability, Retention, StoreError};
use super::recordings::Recordings;
use super::tick::command::CommandOrigin;
use catalogue::Catalogue;
use sinew_wire::status::Fault;
use std::path::Path;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// The data directory of a server.
pub struct Persistence {
    keeper: Arc<Keeper>,
    marks: Arc<Marks>,
    /// Whether the server before this one ended abnormally.
    crashed: bool,
    durability: Durability,
    catalogue: Catalogue,
    /// The contents to restore.
    recovered: Mutex<Option<Recovered>>,
    /// Recordings, whose content is in the log.
    recordings: Arc<Recordings>,
    /// Held while the description of a world is written.
    writing: tokio::sync::Mutex<()>,
}

/// A write in progress, at its place in the order of all.
pub struct Writing(HandedIn<()>);

impl Writing {
    /// Waits until it is on disk.
    ///
    /// # Errors
    /// It could not be written.
    pub async fn done(self) -> Result<(), Fault> {
        self.0.done().await.map_err(storage)
    }

    /// The same. Blocks: not on an async thread.
    ///
    /// # Errors
    /// It could not be written.
    pub fn wait(self) -> Result<(), Fault> {
        self.0.wait().map_err(storage)
    }
}

fn storage(error: StoreError) -> Fault {
    match error {
        StoreError::Ended => Fault::Draining,
        other => Fault::Storage(other.to_string()),
    }
}

/// The origin of commands that the server itself sends to worlds.
fn origin() -> CommandOrigin {
    CommandOrigin {
        client: "".into(),
        sequence: 0,
    }
}

impl Persistence {
    /// Opens the data directory; `None` without one. Blocks.
    ///
    /// # Errors
    /// It cannot be used: another server uses it, it cannot be written to, or a later version has written it.
    pub fn open(config: &Config, recordings: &Arc<Recordings>) -> Result<Option<Self>, StoreError> {
        if config.data_dir.is_empty() {
            return Ok(None);
        }
        let begun = Instant::now();
        let mut store = LocalStore::open(Path::new(&config.data_dir))?;
        let release: Vec<&str> = config.release_worlds.split(',').map(str::trim).collect();
        let mut recovered = recover(&mut store, &release)?;
        let (marks, crashed) = (store.marks(), !store.last_end().orderly);
        let catalogue = Catalogue::of(&recovered);
        recovered.worlds.retain(|(w, _)| catalogue.holds(w));
        tell(&recovered);
        let sizes = KeeperSizes {
            queue_bytes: config.max_store_queue_bytes as usize,
            retention: Retention {
                age: Duration::from_secs_f64(config.history_s),
                world_bytes: config.max_world_history_bytes,
                total_bytes: config.max_history_bytes,
            },
        };
        let keeper = Keeper::start(Box::new(store), sizes)?;
        let (directory, seconds) = (&*config.data_dir, begun.elapsed().as_secs_f64());
        tracing::info!(directory, crashed, seconds, "data directory opened");
        Ok(Some(Self {
            keeper: Arc::new(keeper),
            marks,
            crashed,
            durability: Durability::by_name(&config.durability).unwrap_or_default(),
            catalogue,
            recovered: Mutex::new(Some(recovered)),
            recordings: Arc::clone(recordings),
            writing: tokio::sync::Mutex::default(),
        }))
    }

    /// Refuses an action that a world in quarantine does not allow.
    ///
    /// # Errors
    /// The world of that name is in quarantine.
    pub fn check(&self, name: &str) -> Result<(), Fault> {
        let record = self.catalogue.get(name);
        let Some(why) = record.and_then(|w| w.quarantined) else {
            return Ok(());
        };
        Err(Fault::Precondition {
            reason: "WORLD_QUARANTINED",
            message: format!("world {name:?} is in quarantine: {why}"),
            facts: vec![("world", name.to_owned())],
        })
    }

    /// Runs `f` on the store, after everything that was handed in before, and waits for it.
    ///
    /// # Errors
    /// Those of `f`; too many requests wait; the store has ended.
    async fn on_disk<T: Send + 'static>(
        &self,
        f: impl FnOnce(&mut dyn CheckpointStore) -> Result<T, StoreError> + Send + 'static,
    ) -> Result<T, Fault> {
        self.keeper.call(f).await.map_err(storage)
    }

    /// Writes the remaining data and ends.
    pub async fn close(&self) {
        let keeper = self.keeper.clone();
        // An error means that the thread panicked, which was reported where it happened.
        let _ = tokio::task::spawn_blocking(move || keeper.close()).await;
    }
}

/// Logs everything that is not brought back.
fn tell(recovered: &Recovered) {
    for why in &recovered.damaged {
        tracing::error!(why, "a part of the data directory is damaged");
    }
    for world in &recovered.quarantined {
        let (world, why) = (&*world.name, world.quarantined.as_deref());
        tracing::error!(
            world,
            why,
            "a world is in quarantine: release_worlds lets it out"
        );
    }
}
