//! Worlds and clips of this server in its data directory: what there was is brought back, what is created, changed or
//! deleted is written down before the client learns that it is done.
//!
//! A world is brought back from its last state on disk, which is at most some seconds old, and from its settings,
//! figures and obstacles, which are always those of the last answer.

use super::api::{App, access};
use super::checkpoints;
use super::config::Config;
use super::durable::keeper::{HandedIn, Keeper, Sizes};
use super::durable::local::LocalStore;
use super::durable::marks::Marks;
use super::durable::recovery::{Recovered, recover};
use super::durable::store::{
    self, ClipRecord, Durability, History, Item, RehearsalRecord, Retention, StoreError, WorldKey,
    WorldRecord,
};
use super::library::NewClip;
use super::recordings::{Recordings, StoredRecording};
use super::rehearsals::Rehearsed;
use super::shares::comes_back;
use super::tick::command::Origin;
use super::tick::journal::{self, Logged, Segment};
use super::tick::replay::Replay;
use super::tick::scene::Scene;
use super::tick::shard::Shard;
use super::worlds::{Stored, WorldHandle};
use crate::wire::convert::{body, figure, motion, new_id, obstacle, world};
use crate::wire::pb;
use crate::wire::status::Fault;
use crate::wire::types::{ClipInfo, ControlInfo, FollowSettings, KeptLease, WorldUpdate};
use bytes::Bytes;
use prost::Message;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// How often a world is looked at for changes that it does not announce.
const LOOK_EVERY: Duration = Duration::from_secs(1);
/// How long worlds note each step after an end that was not orderly.
const NOTE_STEPS: Duration = Duration::from_secs(3);

/// What is stored of a world besides its states.
#[derive(Clone, PartialEq, Message)]
struct Described {
    #[prost(message, optional, tag = "1")]
    world: Option<pb::World>,
    #[prost(message, repeated, tag = "2")]
    figures: Vec<pb::Figure>,
    #[prost(message, repeated, tag = "3")]
    obstacles: Vec<pb::Obstacle>,
    #[prost(message, repeated, tag = "4")]
    grants: Vec<pb::Grant>,
    #[prost(message, repeated, tag = "5")]
    recordings: Vec<StoredRecording>,
    #[prost(message, repeated, tag = "6")]
    controls: Vec<StoredControl>,
    /// Whose share of the worlds it is; empty: nobody's who can come back.
    #[prost(string, tag = "7")]
    owner: String,
}

/// What is stored of who controls a figure.
#[derive(Clone, PartialEq, Message)]
struct StoredControl {
    /// Last part of the name of the figure.
    #[prost(string, tag = "1")]
    figure: String,
    #[prost(int64, tag = "2")]
    epoch: i64,
    /// Who has the lease; empty: nobody.
    #[prost(string, tag = "3")]
    holder: String,
    /// SHA-256 of its token.
    #[prost(bytes = "vec", tag = "4")]
    token: Vec<u8>,
    #[prost(int32, tag = "5")]
    priority: i32,
    #[prost(uint64, tag = "6")]
    grace_ms: u64,
}

impl StoredControl {
    fn of(info: &ControlInfo) -> Self {
        let lease = info.kept.as_ref();
        Self {
            figure: info.figure.clone(),
            epoch: info.epoch,
            holder: lease.map_or_else(String::new, |l| l.holder.to_string()),
            token: lease.map_or_else(Vec::new, |l| l.token.to_vec()),
            priority: lease.map_or(0, |l| l.priority),
            grace_ms: lease.map_or(0, |l| l.grace.as_millis() as u64),
        }
    }

    /// Figure, epoch, and the lease if there was one.
    fn kept(self) -> (String, i64, Option<KeptLease>) {
        let token = self.token.try_into().ok();
        let lease = token.map(|token| KeptLease {
            holder: self.holder.into(),
            token,
            priority: self.priority,
            grace: Duration::from_millis(self.grace_ms),
        });
        (self.figure, self.epoch, lease)
    }
}

/// What is stored of a clip besides the request that made it.
#[derive(Clone, PartialEq, Message)]
struct DescribedClip {
    #[prost(message, optional, tag = "1")]
    clip: Option<pb::Clip>,
    /// Principal whose it is.
    #[prost(string, optional, tag = "2")]
    owner: Option<String>,
}

fn storage(error: StoreError) -> Fault {
    match error {
        StoreError::Ended => Fault::Draining,
        other => Fault::Storage(other.to_string()),
    }
}

/// Something that is being written, in its place in the order of all.
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

/// Worlds by name: of several the latest. Those that stay out for it, by name as well.
type ByName = (
    BTreeMap<String, WorldRecord>,
    BTreeMap<String, Vec<WorldKey>>,
);

fn by_name(recovered: &Recovered) -> ByName {
    let mut all: Vec<_> = recovered.worlds.iter().map(|(w, _)| w).collect();
    all.extend(&recovered.quarantined);
    all.sort_unstable_by_key(|w| w.key);
    let (mut latest, mut older) = (
        BTreeMap::<_, WorldRecord>::new(),
        BTreeMap::<_, Vec<_>>::new(),
    );
    for world in all {
        if let Some(out) = latest.insert(world.name.clone(), world.clone()) {
            let (name, number) = (&*world.name, out.key.to_string());
            tracing::error!(
                world = name,
                number,
                "a world stays out: a later one has its name"
            );
            older.entry(world.name.clone()).or_default().push(out.key);
        }
    }
    (latest, older)
}

/// The data directory of a server.
pub struct Persistence {
    keeper: Arc<Keeper>,
    marks: Arc<Marks>,
    /// The server before this one did not end in good order.
    crashed: bool,
    durability: Durability,
    worlds: Mutex<BTreeMap<String, WorldRecord>>,
    /// Worlds that stay out because a later one has their name. They are deleted with that.
    older: Mutex<BTreeMap<String, Vec<WorldKey>>>,
    recovered: Mutex<Option<Recovered>>,
    /// Parts of the past that are kept, of which the log has the content.
    recordings: Arc<Recordings>,
    /// Held while the description of a world is written.
    writing: tokio::sync::Mutex<()>,
}

impl Persistence {
    /// Opens the data directory; `None` without one. Blocks.
    ///
    /// # Errors
    /// It cannot be used: another server has it, it cannot be written to, or a later version has written it.
    pub fn open(config: &Config, recordings: &Arc<Recordings>) -> Result<Option<Self>, StoreError> {
        if config.data_dir.is_empty() {
            return Ok(None);
        }
        let begun = Instant::now();
        let mut store = LocalStore::open(Path::new(&config.data_dir))?;
        let release: Vec<&str> = config.release_worlds.split(',').map(str::trim).collect();
        let mut recovered = recover(&mut store, &release)?;
        let (marks, crashed) = (store.marks(), !store.last_end().orderly);
        let sizes = Sizes {
            queue_bytes: config.max_store_queue_bytes as usize,
            retention: Retention {
                age: Duration::from_secs_f64(config.history_s),
                world_bytes: config.max_world_history_bytes,
                total_bytes: config.max_history_bytes,
            },
        };
        let (worlds, older) = by_name(&recovered);
        recovered
            .worlds
            .retain(|(w, _)| worlds[&w.name].key == w.key);
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
        let (directory, seconds) = (&*config.data_dir, begun.elapsed().as_secs_f64());
        tracing::info!(directory, crashed, seconds, "data directory opened");
        Ok(Some(Self {
            keeper: Arc::new(Keeper::start(Box::new(store), sizes)?),
            marks,
            crashed,
            durability: Durability::by_name(&config.durability).unwrap_or_default(),
            worlds: Mutex::new(worlds),
            older: Mutex::new(older),
            recovered: Mutex::new(Some(recovered)),
            recordings: Arc::clone(recordings),
            writing: tokio::sync::Mutex::default(),
        }))
    }

    fn older(&self) -> MutexGuard<'_, BTreeMap<String, Vec<WorldKey>>> {
        // Entries are inserted whole.
        self.older.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn worlds(&self) -> MutexGuard<'_, BTreeMap<String, WorldRecord>> {
        // Entries are inserted whole.
        self.worlds.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Refuses what a world in quarantine cannot do.
    ///
    /// # Errors
    /// The world of that name is in quarantine.
    pub fn check(&self, name: &str) -> Result<(), Fault> {
        let worlds = self.worlds();
        let Some(why) = worlds.get(name).and_then(|w| w.quarantined.clone()) else {
            return Ok(());
        };
        Err(Fault::Precondition {
            reason: "WORLD_QUARANTINED",
            message: format!("world {name:?} is in quarantine: {why}"),
            facts: vec![("world", name.to_owned())],
        })
    }

    /// Why less is written than was promised.
    pub fn degraded(&self) -> Option<String> {
        self.keeper.degraded()
    }

    /// Writes the state of every world.
    pub async fn checkpoint_all(&self, app: &App) {
        let worlds = app.worlds.list();
        let all = worlds.iter().map(|handle| async move {
            let now = |s: &mut Shard| {
                s.checkpoint_now();
                Ok(())
            };
            let taken = handle.call(origin(), now).await;
            let written = match taken {
                Ok(()) => write_state(handle, None).await,
                Err(error) => Err(error),
            };
            if let Err(error) = &written {
                tracing::error!(world = &*handle.id, %error, "the last state is not written");
            }
        });
        futures_util::future::join_all(all).await;
    }

    /// Brings everything back that can be.
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
        let mut counts = (0_usize, 0_usize);
        for clip in &recovered.clips {
            match restore_clip(app, clip) {
                Ok(()) => {
                    counts.1 += 1;
                    self.complete_clip(app, clip.name.clone());
                }
                Err(why) => tracing::error!(clip = clip.name, %why, "clip is not brought back"),
            }
        }
        for (clip, why) in restore_rehearsals(app, &recovered.rehearsals) {
            tracing::error!(clip, %why, "a rehearsal is not brought back: the clip has to be rehearsed again");
        }
        // Each waits for ticks of its own; together they wait once.
        let worlds = recovered.worlds.iter().map(|(record, history)| async move {
            let restored = self.restore_world(app, record, history).await;
            restored.map_err(|why| (record, why))
        });
        for restored in futures_util::future::join_all(worlds).await {
            match restored {
                Ok(()) => counts.0 += 1,
                Err((record, why)) => {
                    let world = &*record.name;
                    tracing::error!(world, %why, "world is not brought back");
                    if let Some(w) = self.worlds().get_mut(&record.name) {
                        // Not written: the next start tries again, perhaps with other limits.
                        w.quarantined = Some(format!("it could not be brought back: {why}"));
                    }
                }
            }
        }
        let (worlds, clips) = counts;
        let seconds = begun.elapsed().as_secs_f64();
        tracing::info!(worlds, clips, seconds, "brought back");
    }

    async fn restore_world(
        self: &Arc<Self>,
        app: &Arc<App>,
        record: &WorldRecord,
        history: &History,
    ) -> Result<(), Fault> {
        for loss in &history.losses {
            tracing::error!(world = record.name, %loss, "a part of a world is lost");
        }
        let described = Described::decode(record.settings.clone());
        let mut described = described.map_err(|e| Fault::Internal(e.to_string()))?;
        let paused = described
            .world
            .as_ref()
            .is_some_and(|w| w.state == i32::from(pb::WorldState::Paused));
        let settings = world::settings(described.world.take())?;
        let grants = described.grants.iter().map(access::grant_in);
        let grants = grants.collect::<Result<Vec<_>, _>>()?;
        let pace = settings.pace.clone();
        let owner = match described.owner.as_str() {
            // It belongs to nobody who is connected.
            "" => format!("stored {}", record.name),
            owner => owner.to_owned(),
        };
        let state = replayed(record, history).await;
        let has_state = state.is_some();
        let handle = app.worlds.bring_back(
            record.name.clone(),
            (settings, state),
            paused,
            (owner.into(), grants),
        )?;
        handle.stored.send_replace(Stored::At(record.key));
        let update = has_state.then_some(WorldUpdate {
            display_name: Some(pace.display_name),
            overrun: Some(pace.overrun),
            catch_up_limit: Some(pace.catch_up_limit),
            speed: Some(pace.speed),
            idle_ttl: Some(pace.idle_ttl),
        });
        let done = self.complete_world(app, &handle, (described, update)).await;
        if done.is_err() {
            // What is there in part is not left for others to find, and stays on disk as it was.
            let same = |there: &Arc<WorldHandle>| Arc::ptr_eq(there, &handle);
            let by = "it came back in part";
            let _ = app.worlds.delete_if(&record.name, by, same).await; // the error is told already
        }
        done
    }

    /// Does in a world that was brought back what its last state does not know of.
    async fn complete_world(
        self: &Arc<Self>,
        app: &Arc<App>,
        handle: &Arc<WorldHandle>,
        (described, update): (Described, Option<WorldUpdate>),
    ) -> Result<(), Fault> {
        let Stored::At(key) = handle.place().await? else {
            return Ok(()); // it was not brought back
        };
        if let Some(update) = update {
            handle.call(origin(), move |s| s.update(update)).await?;
        }
        if self.crashed
            && let Some(mark) = self.marks.place(key)
        {
            let until = Instant::now() + NOTE_STEPS;
            handle.send(origin(), move |s| s.note_steps(mark, until))?;
        }
        // What was created or deleted since the state was written is done again.
        let there = handle
            .call(origin(), |s| Ok((s.figures(), s.obstacles())))
            .await?;
        let last = |name: &str| name.rsplit('/').next().unwrap_or_default().to_owned();
        let figures: Vec<String> = described.figures.iter().map(|f| last(&f.name)).collect();
        for f in there.0.iter().filter(|f| !figures.contains(&f.id)) {
            let id = f.id.clone();
            handle.call(origin(), move |s| s.delete_figure(&id)).await?;
        }
        let obstacles = described.obstacles.iter().map(|o| last(&o.name));
        let obstacles: Vec<String> = obstacles.collect();
        for o in there.1.iter().filter(|o| !obstacles.contains(&o.id)) {
            let id = o.id.clone();
            handle
                .call(origin(), move |s| s.remove_obstacle(&id))
                .await?;
        }
        for (f, id) in described.figures.iter().zip(figures) {
            if there.0.iter().any(|t| t.id == id) {
                continue;
            }
            let id = new_id("figure_id", &id)?;
            let settings = figure::settings("figure", Some(f))?;
            let built = app.bodies.get("figure.profile", &settings.body)?;
            handle
                .call(origin(), move |s| s.create_figure(id, settings, built))
                .await?;
        }
        for (o, id) in described.obstacles.iter().zip(obstacles) {
            if there.1.iter().any(|t| t.id == id) {
                continue;
            }
            let setup = obstacle::setup("obstacle", Some(o))?;
            let id = new_id("obstacle_id", &id)?;
            handle
                .call(origin(), move |s| s.add_obstacle(id, setup))
                .await?;
        }
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

    /// Brings a recording back, with what the log has of it.
    async fn bring_recording_back(
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

    /// What the log has of the past of a world from tick `first` to tick `until`, at most `most` bytes of it: a part of
    /// each server that has written it.
    async fn recorded(
        &self,
        key: WorldKey,
        (first, until): (u64, u64),
        most: u64,
    ) -> Result<Vec<Arc<Segment>>, Fault> {
        let read = |from: u64| self.keeper.call(move |store| store.history_at(key, from));
        let oldest = self.keeper.call(move |store| Ok(store.oldest(key))).await;
        let oldest = oldest.map_err(storage)?.unwrap_or(u64::MAX);
        let (mut from, mut bytes, mut out) = (first.max(oldest), 0, Vec::new());
        while from <= until && bytes <= most {
            let history = read(from).await.map_err(storage)?;
            let (Some((_, state)), Some(last)) = (&history.checkpoint, history.last_tick()) else {
                break;
            };
            if last < from {
                break;
            }
            let (state, entries) = (state.clone(), read_entries(&history.entries).0);
            let segment = tokio::task::spawn_blocking(move || {
                let scene = checkpoints::decode("checkpoint", &state)?;
                Ok::<_, Fault>(Segment::of_disk(scene, entries, until))
            });
            let segment = segment
                .await
                .map_err(|e| Fault::Internal(e.to_string()))??;
            bytes += segment.bytes();
            from = segment.last_tick().max(last) + 1;
            out.push(segment);
        }
        Ok(out)
    }

    /// What is stored of a world, without what changes in each tick.
    fn describe(&self, handle: &WorldHandle) -> Described {
        let described = handle.described();
        let obstacles = &handle.latest().obstacles;
        let figures = described.figures.iter().map(|f| {
            pb::Figure {
                profile: None, // the name of the body says it
                status: None,
                constraints: Vec::new(),
                ..figure::figure_out(f)
            }
        });
        let obstacles = obstacles.iter().map(|o| obstacle::out(&handle.id, o));
        Described {
            world: Some(pb::World {
                tick: 0,
                time_s: 0.0,
                ..world::world_out(&described.world)
            }),
            figures: figures.collect(),
            obstacles: obstacles.collect(),
            grants: (handle.grants.list().iter())
                .map(|g| access::grant_out(&handle.id, g))
                .collect(),
            recordings: self.recordings.stored(&handle.id),
            controls: (described.controls.iter())
                .filter(|c| c.epoch > 0 || c.kept.is_some())
                .map(StoredControl::of)
                .collect(),
            owner: match handle.owner() {
                owner if comes_back(owner) => owner.to_string(),
                _ => String::new(),
            },
        }
    }

    /// Writes a new world down. Who changes or deletes it meanwhile waits for that.
    ///
    /// # Errors
    /// It could not be written.
    pub async fn created(self: &Arc<Self>, handle: &Arc<WorldHandle>) -> Result<(), Fault> {
        let written = self.write_new(handle).await;
        let place = written
            .as_ref()
            .map_or(Stored::Never, |key| Stored::At(*key));
        handle.stored.send_replace(place);
        written?;
        self.follow(handle);
        // What is done to it from now on follows this state.
        if self.durability != Durability::None {
            write_state(handle, None).await?;
        }
        Ok(())
    }

    /// Writes down that there is a new world; its number.
    async fn write_new(&self, handle: &WorldHandle) -> Result<WorldKey, Fault> {
        let mut record = WorldRecord {
            key: WorldKey(0),
            name: handle.id.to_string(),
            durability: self.durability,
            quarantined: None,
            settings: self.describe(handle).encode_to_vec().into(),
        };
        let record = self
            .keeper
            .call(move |store| {
                record.key = store.new_key();
                store.put_world(&record)?;
                Ok(record)
            })
            .await
            .map_err(storage)?;
        let key = record.key;
        self.worlds().insert(record.name.clone(), record);
        Ok(key)
    }

    /// Writes down what has changed of a world.
    ///
    /// # Errors
    /// It could not be written; it is tried again. The world has ended.
    pub async fn changed(&self, handle: &WorldHandle) -> Result<(), Fault> {
        let Stored::At(key) = handle.place().await? else {
            return Ok(()); // it is not to be stored
        };
        // One after the other, so that what is described last is written last.
        let _turn = self.writing.lock().await;
        let settings = self.describe(handle).encode_to_vec();
        let record = self.worlds().get(&*handle.id).cloned();
        // There may be another one of its name. One whose deletion has failed is not there either.
        let record = record.filter(|w| w.key == key && w.quarantined.is_none());
        let Some(record) = record else {
            return Err(handle.ended());
        };
        if record.settings == settings || at_rest(&record.settings) == at_rest(&settings) {
            return Ok(());
        }
        let changed = WorldRecord {
            settings: settings.into(),
            ..record
        };
        let written = changed.clone();
        let done = self
            .keeper
            .call(move |store| store.put_world(&written))
            .await;
        done.map_err(storage)?;
        self.worlds().insert(changed.name.clone(), changed); // its turn: nobody else has removed it
        Ok(())
    }

    /// Writes states of a world down, and changes that nobody waits for, until it ends.
    fn follow(self: &Arc<Self>, handle: &Arc<WorldHandle>) {
        let mut changes = handle.outlet.described.subscribe();
        let mut closed = handle.closed.clone();
        let place = *handle.stored.borrow();
        let record = self.worlds().get(&*handle.id).cloned();
        let record = record.filter(|w| Stored::At(w.key) == place);
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
                    match write_state(&handle, written).await {
                        Ok(state) => written = state,
                        Err(Fault::Draining) => break,
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

    /// Forgets a world that has ended.
    ///
    /// # Errors
    /// It could not be done. Its name is taken by a world in quarantine then, which can be deleted again.
    pub async fn deleted(&self, handle: &WorldHandle) -> Result<(), Fault> {
        let mut stored = handle.stored.subscribe();
        // One that is being created is written first.
        let place = stored.wait_for(|s| *s != Stored::Coming).await.map(|s| *s);
        match place {
            Ok(Stored::At(key)) => self.forget(&handle.id, key).await,
            _ => Ok(()),
        }
    }

    /// Forgets a world in quarantine.
    ///
    /// # Errors
    /// There is none of that name; it could not be done.
    pub async fn deleted_in_quarantine(&self, name: &str) -> Result<(), Fault> {
        let record = self.worlds().get(name).cloned();
        let record = record.filter(|w| w.quarantined.is_some());
        let record = record.ok_or_else(|| Fault::not_found("world", format!("worlds/{name}")))?;
        self.forget(name, record.key).await
    }

    /// Forgets the world of this number, and those that it has kept out.
    async fn forget(&self, name: &str, key: WorldKey) -> Result<(), Fault> {
        // A change of it that is being written would bring it back.
        let _turn = self.writing.lock().await;
        let older = self.older().get(name).cloned().unwrap_or_default();
        let delete = move |store: &mut dyn store::CheckpointStore| {
            older.iter().try_for_each(|key| store.delete_world(*key))?;
            store.delete_world(key)
        };
        let done = self.keeper.call(delete).await;
        let mut worlds = self.worlds();
        match done {
            Ok(()) => {
                worlds.remove(name);
                self.older().remove(name);
                Ok(())
            }
            Err(error) => {
                if let Some(w) = worlds.get_mut(name).filter(|w| w.key == key) {
                    w.quarantined = Some(format!("its deletion could not be stored: {error}"));
                }
                Err(storage(error))
            }
        }
    }

    /// Begins to write a clip down: the request that made it and what it became. What becomes of its name afterwards is
    /// written afterwards.
    ///
    /// # Errors
    /// It cannot be written now.
    pub fn clip_created(
        &self,
        clip: &ClipInfo,
        request: pb::CreateClipRequest,
    ) -> Result<Writing, Fault> {
        let mut record = ClipRecord {
            name: clip.id.clone(),
            description: DescribedClip {
                clip: Some(motion::clip_out(clip, false)),
                owner: clip.owner.as_deref().map(str::to_owned),
            }
            .encode_to_vec()
            .into(),
            content: Bytes::new(),
        };
        let written = self.keeper.hand_in(move |store| {
            record.content = request.encode_to_vec().into(); // large: nobody holds a lock here
            store.put_clip(&record)
        });
        written.map(Writing).map_err(storage)
    }

    /// Begins to forget a clip; likewise.
    ///
    /// # Errors
    /// It cannot be written now.
    pub fn clip_deleted(&self, name: &str) -> Result<Writing, Fault> {
        let name = name.to_owned();
        let done = self.keeper.hand_in(move |store| store.delete_clip(&name));
        done.map(Writing).map_err(storage)
    }

    /// Writes a rehearsal of a clip down, in the place of others.
    ///
    /// # Errors
    /// It could not be written.
    pub async fn rehearsed(
        &self,
        clip: &str,
        found: &Arc<Rehearsed>,
        instead_of: &[Arc<Rehearsed>],
    ) -> Result<(), Fault> {
        let (clip, found) = (clip.to_owned(), Arc::clone(found));
        let figure = found.figure();
        let gone: Vec<String> = instead_of.iter().map(|r| r.figure()).collect();
        let write = move |store: &mut dyn store::CheckpointStore| {
            store.put_rehearsal(&RehearsalRecord {
                clip: clip.clone(),
                figure: figure.clone(),
                content: found.to_bytes().into(),
            })?;
            for other in gone.iter().filter(|other| **other != figure) {
                store.delete_rehearsal(&clip, other)?;
            }
            Ok(())
        };
        self.keeper.call(write).await.map_err(storage)
    }

    /// Forgets a rehearsal of a clip.
    ///
    /// # Errors
    /// It could not be done.
    pub async fn forget_rehearsal(&self, clip: &str, found: &Rehearsed) -> Result<(), Fault> {
        let (clip, figure) = (clip.to_owned(), found.figure());
        let done = self
            .keeper
            .call(move |store| store.delete_rehearsal(&clip, &figure))
            .await;
        done.map_err(storage)
    }

    /// Works out again what is not stored of a clip: how its file was understood, and what will come of it.
    fn complete_clip(&self, app: &Arc<App>, name: String) {
        let app = app.clone();
        tokio::spawn(async move {
            let library = app.clone();
            let id = name.clone();
            let turns = "stored".into();
            let done = app.conversions.run(&turns, move |turn| {
                let reference = library.clips.info(&id)?.body;
                let reference = crate::wire::convert::body::by_id(&reference)
                    .ok_or_else(|| Fault::not_found("body", reference))?;
                let built = library.bodies.get("body", &reference)?;
                library.clips.complete(&id, &built, &|| turn.stop())
            });
            if let Err(why) = done.await {
                tracing::debug!(clip = name, %why, "the report of a clip is not there");
            }
        });
    }

    /// Writes what is left and ends.
    pub async fn close(&self) {
        let keeper = self.keeper.clone();
        // An error: it panicked, which was reported where it happened.
        let _ = tokio::task::spawn_blocking(move || keeper.close()).await;
    }
}

/// Hands the latest checkpoint of a world to the disk, unless tick and hash are those that were written before. Returns
/// both.
async fn write_state(
    handle: &Arc<WorldHandle>,
    before: Option<(u64, u64)>,
) -> Result<Option<(u64, u64)>, Fault> {
    let Some(journal) = &handle.journal else {
        return Ok(before);
    };
    // A world that goes back meanwhile has another one by then.
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

/// The last state of a world that is whole: its checkpoint, and what was recorded behind it. `None`: there is none, or
/// this program cannot go on from it.
async fn replayed(record: &WorldRecord, history: &History) -> Option<Scene> {
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
        let done = tokio::task::spawn_blocking(move || {
            let scene = checkpoints::decode("checkpoint", &bytes)?;
            let mut replay = Replay::new(scene);
            let through = replay.through(&*entries, until, &mut |scene| {
                reached.store(scene.world().tick(), Ordering::Relaxed);
                true
            });
            let compared = replay.compared;
            Ok::<_, Fault>((replay.scene, through, compared))
        });
        let (why, state) = match done.await {
            Ok(Ok((scene, Ok(()), compared))) => {
                let (tick, hash) = (scene.world().tick(), scene.world().state_hash());
                let hash = format!("{hash:016x}");
                tracing::info!(world, tick, hash, compared, "world is as it was");
                return Some(scene);
            }
            Ok(Ok((_, Err(why), _))) => (why.to_string(), last.load(Ordering::Relaxed)),
            Ok(Err(why)) => {
                tracing::error!(world, tick, %why, "the state is lost: the world begins anew");
                return None;
            }
            Err(panic) => (panic.to_string(), last.load(Ordering::Relaxed)),
        };
        if state >= until || until == tick {
            tracing::error!(
                world,
                tick,
                why,
                "the state has another hash: the world begins anew"
            );
            return None;
        }
        tracing::error!(world, after_tick = state, why, "what follows is lost");
        until = state;
    }
}

/// What was logged, up to the first entry that cannot be read: its tick, and why.
fn read_entries(entries: &[store::Logged]) -> (Vec<Logged>, Option<(u64, String)>) {
    let mut out = Vec::with_capacity(entries.len());
    for entry in entries {
        out.push(match &entry.item {
            Item::Hash(hash) => Logged::Hash(entry.tick, *hash),
            Item::Input(bytes) => match journal::from_disk(entry.tick, bytes) {
                Ok(record) => Logged::Record(record),
                Err(why) => return (out, Some((entry.tick, why))),
            },
            Item::Checkpoint { .. } => continue,
        });
    }
    (out, None)
}

fn origin() -> Origin {
    Origin {
        client: "".into(),
        sequence: 0,
    }
}

/// What is described without that which moves by itself: states have it.
fn at_rest(settings: &[u8]) -> Option<Described> {
    let mut described = Described::decode(settings).ok()?;
    let fixed = i32::from(pb::ObstacleMobility::Fixed);
    for o in described
        .obstacles
        .iter_mut()
        .filter(|o| o.mobility != fixed)
    {
        *o = pb::Obstacle {
            pose: None,
            velocity_mps: None,
            angular_velocity_rad_s: None,
            etag: String::new(),
            ..std::mem::take(o)
        };
    }
    Some(described)
}

/// Brings rehearsals back, the oldest first. Returns those that cannot be used, and why.
fn restore_rehearsals<'a>(app: &App, all: &'a [RehearsalRecord]) -> Vec<(&'a str, Fault)> {
    let (mut whole, mut left_out) = (Vec::new(), Vec::new());
    for record in all {
        match Rehearsed::from_bytes(&record.content) {
            Ok(found) => whole.push((&*record.clip, Arc::new(found))),
            Err(why) => left_out.push((&*record.clip, why)),
        }
    }
    whole.sort_by_key(|(_, found)| found.found_ms);
    for (clip, found) in whole {
        let kept = app.clips.score(clip);
        let kept = kept.and_then(|score| app.clips.keep_rehearsed(&score, &found));
        left_out.extend(kept.err().map(|why| (clip, why)));
    }
    left_out
}

fn restore_clip(app: &Arc<App>, clip: &ClipRecord) -> Result<(), Fault> {
    let unreadable = |e: prost::DecodeError| Fault::Internal(e.to_string());
    let described = DescribedClip::decode(clip.description.clone()).map_err(unreadable)?;
    let shown = described.clip.unwrap_or_default();
    let request = pb::CreateClipRequest::decode(clip.content.clone()).map_err(unreadable)?;
    let source = motion::clip_source(request.source, app.config.max_clip_bytes)?;
    let reference = body::reference("body", &request.body, "profile", None)?;
    let new = NewClip {
        id: Some(clip.name.clone()),
        display_name: shown.display_name.clone(),
        owner: described.owner.map(Into::into),
        follow: motion::follow_settings(
            request.follow,
            request.max_help_weights,
            FollowSettings::default(),
        )?,
    };
    app.clips.restore(new, &shown, &reference, source)
}
