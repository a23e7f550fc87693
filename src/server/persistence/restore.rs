//! A start: brings back everything that can be brought back.

use super::described::{StoredControl, StoredWorld};
use super::{Persistence, clips, origin, past};
use crate::api::access;
use crate::app::App;
use crate::durable::store::{StoredHistory, WorldKey, WorldRecord};
use crate::worlds::{Persisted, WorldHandle};
use prost::Message;
use sinew_wire::convert::{figure, new_id, obstacle, world};
use sinew_wire::status::Fault;
use sinew_wire::types::WorldUpdate;
use std::sync::{Arc, PoisonError};
use std::time::{Duration, Instant};

/// How long worlds note each step after an abnormal end.
const NOTE_STEPS: Duration = Duration::from_secs(3);

impl Persistence {
    /// Brings back everything that can be brought back.
    pub async fn restore(self: &Arc<Self>, app: &Arc<App>) {
        let recovered = self
            .recovered
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .take();
        let Some(recovered) = recovered else {
            return;
        };
        let begun = Instant::now();
        for name in self.catalogue.all() {
            app.worlds.number_behind(&name);
        }
        let clips = clips::restore(app, &recovered.clips);
        clips::restore_rehearsals(app, &recovered.rehearsals);
        let worlds = self.restore_worlds(app, &recovered.worlds).await;
        let seconds = begun.elapsed().as_secs_f64();
        tracing::info!(worlds, clips, seconds, "brought back");
    }

    /// Returns how many were brought back.
    async fn restore_worlds(
        self: &Arc<Self>,
        app: &Arc<App>,
        all: &[(WorldRecord, StoredHistory)],
    ) -> usize {
        // Each waits for its own ticks; together they wait once.
        let worlds = all.iter().map(|(record, history)| async move {
            let restored = self.restore_world(app, record, history).await;
            restored.map_err(|why| (record, why))
        });
        let mut count = 0;
        for restored in futures_util::future::join_all(worlds).await {
            match restored {
                Ok(()) => count += 1,
                Err((record, why)) => {
                    let (world, key) = (&*record.name, record.key);
                    tracing::error!(world, %why, "world is not brought back");
                    // The next start tries again, perhaps with other limits.
                    let why = format!("it could not be brought back: {why}");
                    self.catalogue.quarantine(world, key, why);
                }
            }
        }
        count
    }

    async fn restore_world(
        self: &Arc<Self>,
        app: &Arc<App>,
        record: &WorldRecord,
        history: &StoredHistory,
    ) -> Result<(), Fault> {
        for loss in &history.losses {
            tracing::error!(world = record.name, %loss, "a part of a world is lost");
        }
        let described = StoredWorld::decode(record.settings.clone());
        let mut described = described.map_err(|e| Fault::Internal(e.to_string()))?;
        let paused = described.is_paused();
        let settings = world::settings(described.world.take())?;
        let grants = described.grants.iter().map(access::grant_in);
        let grants = grants.collect::<Result<Vec<_>, _>>()?;
        let pace = settings.pace.clone();
        let owner = match described.owner.as_str() {
            // It belongs to no connected client.
            "" => format!("stored {}", record.name),
            owner => owner.to_owned(),
        };
        let state = past::last_state(record, history).await;
        let update = state.is_some().then_some(WorldUpdate {
            display_name: Some(pace.display_name),
            overrun: Some(pace.overrun),
            catch_up_limit: Some(pace.catch_up_limit),
            speed: Some(pace.speed),
            idle_ttl: Some(pace.idle_ttl),
        });
        let handle = app.worlds.bring_back(
            record.name.clone(),
            (settings, state),
            paused,
            (owner.into(), grants),
        )?;
        handle.stored.send_replace(Persisted::At(record.key));
        let key = record.key;
        let done = self.complete_world(app, (&handle, key), described, update);
        let done = done.await;
        if done.is_err() {
            // A partly restored world must not be left for others to find. It stays unchanged on disk.
            let same = |there: &Arc<WorldHandle>| Arc::ptr_eq(there, &handle);
            let by = "it came back in part";
            let _ = app.worlds.delete_if(&record.name, by, same).await; // the error was reported already
        }
        done
    }

    /// Applies changes that are later than the last state of a world that was brought back. `update`: its pace, if it
    /// was brought back in such a state.
    async fn complete_world(
        self: &Arc<Self>,
        app: &Arc<App>,
        (handle, key): (&Arc<WorldHandle>, WorldKey),
        described: StoredWorld,
        update: Option<WorldUpdate>,
    ) -> Result<(), Fault> {
        if let Some(update) = update {
            handle.call(origin(), move |s| s.update(update)).await?;
        }
        if self.crashed
            && let Some(mark) = self.marks.place(key)
        {
            let until = Instant::now() + NOTE_STEPS;
            handle.send(origin(), move |s| s.note_steps(mark, until))?;
        }
        // Repeats creations and deletions since the state was written.
        let there = handle
            .call(origin(), |s| {
                let figures = s.figures().into_iter().map(|f| f.id);
                let obstacles = s.obstacles().into_iter().map(|o| o.id);
                Ok(Inhabitants {
                    figures: figures.collect(),
                    obstacles: obstacles.collect(),
                })
            })
            .await?;
        let stored = Inhabitants::of(&described);
        remove_others(handle, &there, &stored).await?;
        create_missing(app, handle, &described, &there).await?;
        let controls = described.controls.into_iter().map(StoredControl::kept);
        let controls: Vec<_> = controls.collect();
        handle
            .call(origin(), move |s| {
                s.bring_leases_back(controls);
                Ok(())
            })
            .await?;
        for stored in described.recordings {
            self.bring_recording_back(handle, key, stored).await;
        }
        self.follow(handle);
        Ok(())
    }
}

/// Last parts of the names of everything in a world.
struct Inhabitants {
    figures: Vec<String>,
    obstacles: Vec<String>,
}

fn last_part(name: &str) -> &str {
    name.rsplit('/').next().unwrap_or_default()
}

impl Inhabitants {
    fn of(described: &StoredWorld) -> Self {
        let figures = described.figures.iter().map(|f| last_part(&f.name));
        let obstacles = described.obstacles.iter().map(|o| last_part(&o.name));
        Self {
            figures: figures.map(str::to_owned).collect(),
            obstacles: obstacles.map(str::to_owned).collect(),
        }
    }
}

/// Those in the first list that are not in the second.
fn without<'a>(all: &'a [String], these: &'a [String]) -> impl Iterator<Item = String> + 'a {
    all.iter().filter(move |id| !these.contains(id)).cloned()
}

/// Removes from a world everything that was deleted after its state was written.
async fn remove_others(
    handle: &WorldHandle,
    there: &Inhabitants,
    stored: &Inhabitants,
) -> Result<(), Fault> {
    for id in without(&there.figures, &stored.figures) {
        handle.call(origin(), move |s| s.delete_figure(&id)).await?;
    }
    for id in without(&there.obstacles, &stored.obstacles) {
        handle
            .call(origin(), move |s| s.remove_obstacle(&id))
            .await?;
    }
    Ok(())
}

/// Creates in a world everything that was created after its state was written.
async fn create_missing(
    app: &App,
    handle: &WorldHandle,
    described: &StoredWorld,
    there: &Inhabitants,
) -> Result<(), Fault> {
    for f in &described.figures {
        let id = last_part(&f.name);
        if there.figures.iter().any(|t| t == id) {
            continue;
        }
        let id = new_id("figure_id", id)?;
        let settings = figure::settings("figure", Some(f))?;
        let built = app.bodies.get("figure.profile", &settings.body)?;
        handle
            .call(origin(), move |s| s.create_figure(id, settings, built))
            .await?;
    }
    for o in &described.obstacles {
        let id = last_part(&o.name);
        if there.obstacles.iter().any(|t| t == id) {
            continue;
        }
        let id = new_id("obstacle_id", id)?;
        let setup = obstacle::setup("obstacle", Some(o))?;
        handle
            .call(origin(), move |s| s.add_obstacle(id, setup))
            .await?;
    }
    Ok(())
}
