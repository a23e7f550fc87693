//! Writes the creation, changes and deletion of worlds to disk.

use super::described::StoredWorld;
use super::{Persistence, states, storage};
use crate::durable::store::{CheckpointStore, Durability, WorldKey, WorldRecord};
use crate::worlds::{Persisted, WorldHandle};
use prost::Message;
use sinew_wire::status::Fault;
use std::sync::Arc;

impl Persistence {
    /// Writes a new world to disk. Its changes and its deletion wait for that.
    ///
    /// # Errors
    /// It could not be written, or a world in quarantine has its name.
    pub async fn created(self: &Arc<Self>, handle: &Arc<WorldHandle>) -> Result<(), Fault> {
        let written = self.write_new(handle).await;
        let place = written
            .as_ref()
            .map_or(Persisted::Never, |key| Persisted::At(*key));
        handle.stored.send_replace(place);
        written?;
        self.follow(handle);
        // Later changes follow this state.
        if self.durability != Durability::None {
            states::write(handle, None).await?;
        }
        Ok(())
    }

    /// Writes the existence of a new world to disk. Returns its number.
    async fn write_new(&self, handle: &WorldHandle) -> Result<WorldKey, Fault> {
        // At the next start it would be taken for an older world of this name, and be deleted with this one.
        self.check(&handle.id)?;
        let mut record = WorldRecord {
            key: WorldKey(0),
            name: handle.id.to_string(),
            durability: self.durability,
            quarantined: None,
            settings: self.description(handle).into(),
        };
        let write = move |store: &mut dyn CheckpointStore| {
            record.key = store.new_key();
            store.put_world(&record)?;
            Ok(record)
        };
        let record = self.on_disk(write).await?;
        let key = record.key;
        self.catalogue.put(record);
        Ok(key)
    }

    fn description(&self, handle: &WorldHandle) -> Vec<u8> {
        StoredWorld::now(handle, &self.recordings).encode_to_vec()
    }

    /// Writes the changes of a world to disk.
    ///
    /// # Errors
    /// It could not be written, and will be tried again; or the world has ended.
    pub async fn changed(&self, handle: &WorldHandle) -> Result<(), Fault> {
        let Persisted::At(key) = handle.place().await? else {
            return Ok(()); // it is not to be stored
        };
        // One at a time, so that the last description is written last.
        let _turn = self.writing.lock().await;
        let settings = self.description(handle);
        // Another world may have its name. A world whose deletion has failed does not exist either.
        let record = self.catalogue.running(&handle.id, key);
        let record = record.ok_or_else(|| handle.ended())?;
        if !StoredWorld::differ(&record.settings, &settings) {
            return Ok(());
        }
        let changed = WorldRecord {
            settings: settings.into(),
            ..record
        };
        let written = changed.clone();
        self.on_disk(move |store| store.put_world(&written)).await?;
        self.catalogue.put(changed); // its turn: no other task has removed it
        Ok(())
    }

    /// Forgets a world that has ended.
    ///
    /// # Errors
    /// It could not be done. A world in quarantine keeps the name then, and can be deleted again.
    pub async fn deleted(&self, handle: &WorldHandle) -> Result<(), Fault> {
        let mut stored = handle.stored.subscribe();
        // A world that is being created is written first.
        let place = stored
            .wait_for(|s| *s != Persisted::Coming)
            .await
            .map(|s| *s);
        match place {
            Ok(Persisted::At(key)) => self.forget(&handle.id, key).await,
            _ => Ok(()),
        }
    }

    /// Forgets a world in quarantine.
    ///
    /// # Errors
    /// There is none of that name; it could not be done.
    pub async fn deleted_in_quarantine(&self, name: &str) -> Result<(), Fault> {
        let record = self.catalogue.get(name);
        let record = record.filter(|w| w.quarantined.is_some());
        let record = record.ok_or_else(|| Fault::not_found("world", format!("worlds/{name}")))?;
        self.forget(name, record.key).await
    }

    /// Forgets the world of this number, and those that it has kept out.
    async fn forget(&self, name: &str, key: WorldKey) -> Result<(), Fault> {
        // A change that is being written would bring it back.
        let _turn = self.writing.lock().await;
        // It goes last: as long as it exists, the others stay out.
        let keys = self.catalogue.with_older(name, key);
        let delete = move |store: &mut dyn CheckpointStore| {
            keys.iter().try_for_each(|key| store.delete_world(*key))
        };
        match self.keeper.call(delete).await {
            Ok(()) => {
                self.catalogue.remove(name, key);
                Ok(())
            }
            Err(error) => {
                let why = format!("its deletion could not be stored: {error}");
                self.catalogue.quarantine(name, key, why);
                Err(storage(error))
            }
        }
    }
}
