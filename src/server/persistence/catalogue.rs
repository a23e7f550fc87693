//! The stored world of each name.

use crate::durable::recovery::Recovered;
use crate::durable::store::{WorldKey, WorldRecord};
use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Worlds that are on disk, by name: those that are running and those in quarantine.
#[derive(Default)]
pub(super) struct Catalogue(Mutex<CatalogueNames>);

#[derive(Default)]
struct CatalogueNames {
    /// The latest of those with one name.
    latest: BTreeMap<String, WorldRecord>,
    /// Worlds that stay out because a later one has their name. They are deleted together with it.
    older: BTreeMap<String, Vec<WorldKey>>,
}

impl Catalogue {
    /// The catalogue of a recovered directory.
    pub fn of(recovered: &Recovered) -> Self {
        let mut all: Vec<_> = recovered.worlds.iter().map(|(w, _)| w).collect();
        all.extend(&recovered.quarantined);
        all.sort_unstable_by_key(|w| w.key);
        let mut names = CatalogueNames::default();
        for world in all {
            let Some(out) = names.latest.insert(world.name.clone(), world.clone()) else {
                continue;
            };
            let (name, number) = (&*world.name, out.key.to_string());
            tracing::error!(
                world = name,
                number,
                "a world stays out: a later one has its name"
            );
            let older = names.older.entry(world.name.clone());
            older.or_default().push(out.key);
        }
        Self(Mutex::new(names))
    }

    fn names(&self) -> MutexGuard<'_, CatalogueNames> {
        // Entries are inserted whole.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The world of this name.
    pub fn get(&self, name: &str) -> Option<WorldRecord> {
        self.names().latest.get(name).cloned()
    }

    /// The world of this name, if it has this number and is not in quarantine.
    pub fn running(&self, name: &str, key: WorldKey) -> Option<WorldRecord> {
        self.get(name)
            .filter(|w| w.key == key && w.quarantined.is_none())
    }

    /// Whether this very world has its name.
    pub fn holds(&self, world: &WorldRecord) -> bool {
        let names = self.names();
        let latest = names.latest.get(&world.name);
        latest.is_some_and(|w| w.key == world.key)
    }

    /// All names.
    pub fn all(&self) -> Vec<String> {
        self.names().latest.keys().cloned().collect()
    }

    /// A world of this name and those that it keeps out.
    pub fn with_older(&self, name: &str, key: WorldKey) -> Vec<WorldKey> {
        let mut keys = self.names().older.get(name).cloned().unwrap_or_default();
        keys.push(key);
        keys
    }

    /// Records a world as it was written.
    pub fn put(&self, world: WorldRecord) {
        self.names().latest.insert(world.name.clone(), world);
    }

    /// Forgets a world and those that it has kept out. If a later world has its name by then, that one stays.
    pub fn remove(&self, name: &str, key: WorldKey) {
        let mut names = self.names();
        if names.latest.get(name).is_some_and(|w| w.key == key) {
            names.latest.remove(name);
            names.older.remove(name);
        }
    }

    /// Keeps a world from being used as long as this server runs. It is not written: the next start tries again.
    pub fn quarantine(&self, name: &str, key: WorldKey, why: String) {
        let mut names = self.names();
        if let Some(w) = names.latest.get_mut(name).filter(|w| w.key == key) {
            w.quarantined = Some(why);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::durable::store::{Durability, StoredHistory};

    fn world(name: &str, key: u64) -> WorldRecord {
        WorldRecord {
            key: WorldKey(key),
            name: name.to_owned(),
            durability: Durability::Group,
            quarantined: None,
            settings: Default::default(),
        }
    }

    #[test]
    fn the_latest_world_has_the_name_and_takes_the_older_ones_along() {
        let all = [world("a", 2), world("b", 1), world("a", 3), world("a", 1)];
        let catalogue = Catalogue::of(&Recovered {
            worlds: all.map(|w| (w, StoredHistory::default())).into(),
            ..Recovered::default()
        });
        assert!(catalogue.holds(&world("a", 3)) && !catalogue.holds(&world("a", 2)));
        let keys = catalogue.with_older("a", WorldKey(3));
        assert_eq!(keys, [1, 2, 3].map(WorldKey));
        catalogue.remove("a", WorldKey(3));
        assert_eq!(catalogue.get("a"), None);
        assert_eq!(catalogue.with_older("a", WorldKey(4)), [WorldKey(4)]);
        assert_eq!(catalogue.all(), ["b"]);
    }

    /// Two clients delete the same world in quarantine, and a third one takes the name in between.
    #[test]
    fn a_late_deletion_does_not_forget_the_next_world_of_the_name() {
        let catalogue = Catalogue::default();
        catalogue.put(world("a", 1));
        catalogue.remove("a", WorldKey(1));
        catalogue.put(world("a", 2));
        catalogue.remove("a", WorldKey(1));
        catalogue.quarantine("a", WorldKey(1), "why".to_owned());
        assert_eq!(catalogue.running("a", WorldKey(2)), Some(world("a", 2)));
        assert_eq!(catalogue.running("a", WorldKey(1)), None);
    }
}
