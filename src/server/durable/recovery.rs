//! Start of a server on an existing directory: intact data are read, damaged data are reported, and worlds that crashed
//! the process twice stay out.

use super::local::LocalStore;
use super::store::{
    CheckpointStore, ClipRecord, RehearsalRecord, StoreError, StoredHistory, WorldRecord,
};

/// The data found at a start.
#[derive(Debug, Default)]
pub struct Recovered {
    /// Worlds to bring back, with everything known about them.
    pub worlds: Vec<(WorldRecord, StoredHistory)>,
    /// Worlds that stay out; each record has the reason.
    pub quarantined: Vec<WorldRecord>,
    /// Clips.
    pub clips: Vec<ClipRecord>,
    /// Rehearsals of the clips.
    pub rehearsals: Vec<RehearsalRecord>,
    /// Damaged data that could not be read at all.
    pub damaged: Vec<String>,
}

/// Reads everything that a start needs. A world that was being stepped when the process ended twice in a row is put
/// into quarantine; those named in `release` are released.
///
/// # Errors
/// The directory cannot be read, or a decision could not be written down.
pub fn recover(store: &mut LocalStore, release: &[&str]) -> Result<Recovered, StoreError> {
    let last_end = store.last_end().clone();
    let mut out = Recovered {
        damaged: last_end.damage,
        ..Recovered::default()
    };
    let worlds = store.worlds()?;
    out.damaged.extend(worlds.damaged);
    let mut whole = Vec::new();
    for mut world in worlds.whole {
        let stepping = last_end.stepping.iter().find(|(key, _)| *key == world.key);
        if let Some((_, tick)) = stepping {
            world.quarantined.get_or_insert_with(|| {
                format!("the process ended twice in a row, the second time while tick {tick} was computed")
            });
            store.put_world(&world)?;
        } else if release.contains(&&*world.name) && world.quarantined.take().is_some() {
            store.put_world(&world)?;
        }
        if world.quarantined.is_some() {
            out.quarantined.push(world);
        } else {
            whole.push(world);
        }
    }
    let keys: Vec<_> = whole.iter().map(|w| w.key).collect();
    let histories = store.latest(&keys)?;
    out.worlds = whole.into_iter().zip(histories).collect();
    let clips = store.clips()?;
    out.damaged.extend(clips.damaged);
    out.clips = clips.whole;
    let rehearsals = store.rehearsals()?;
    out.damaged.extend(rehearsals.damaged);
    out.rehearsals = rehearsals.whole;
    Ok(out)
}
