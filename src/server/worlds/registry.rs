//! The worlds of this server by name: they come, are found, and go.

use super::handle::{Persisted, WorldHandle};
use super::usage::WorldUsage;
use super::waiting::WaitingCommands;
use crate::access::grants::{Grant, Grants};
use crate::config::Config;
use crate::fanout::hub::Hub;
use crate::shares::{ClientKey, check_part};
use crate::tick::Outlet;
use crate::tick::budget::Budget;
use crate::tick::command::{CommandOrigin, CommandQueue};
use crate::tick::hosted_world::{HostedWorld, StateOrigin as Past, WorldLimits};
use crate::tick::journal::{Journal, Room, Total};
use crate::tick::planners::Planners;
use crate::tick::scene::Scene;
use crate::tick::scheduler::{Added, Scheduler, SchedulerPlan, WorkerPriority};
use sinew_wire::status::Fault;
use sinew_wire::types::{WorldInfo, WorldSettings};
use std::collections::{BTreeMap, HashSet};
use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};
use std::time::Duration;
use tokio::sync::watch;

/// Prefix of names that the server chooses for worlds; a number follows.
const GIVEN: &str = "world-";

/// A world that is being deleted. Its name stays taken until this is dropped, so that its data can be deleted by that
/// name.
#[derive(Debug)]
pub struct Leaving {
    /// The world.
    pub handle: Arc<WorldHandle>,
    names: Arc<Mutex<HashSet<Arc<str>>>>,
}

impl Drop for Leaving {
    fn drop(&mut self) {
        locked(&self.names).remove(&self.handle.id);
    }
}

fn locked(names: &Mutex<HashSet<Arc<str>>>) -> MutexGuard<'_, HashSet<Arc<str>>> {
    // One name more or less at a time.
    names.lock().unwrap_or_else(PoisonError::into_inner)
}

type Worlds = BTreeMap<String, Arc<WorldHandle>>;

/// All worlds.
#[derive(Debug)]
pub struct Registry {
    worlds: RwLock<Worlds>,
    /// Names of worlds that are being deleted. Locked after `worlds`.
    leaving: Arc<Mutex<HashSet<Arc<str>>>>,
    /// Number for the next name that the server chooses.
    next: AtomicU64,
    /// Whether new worlds are refused.
    draining: AtomicBool,
    /// Worlds end because the server does.
    ending: Arc<AtomicBool>,
    config: Arc<Config>,
    /// Memory used by the past of all worlds.
    past: Arc<Total>,
    planners: Arc<Planners>,
    scheduler: Scheduler,
    /// Budget for the ticks of all worlds.
    pub budget: Arc<Budget>,
}

impl Registry {
    /// No worlds yet; starts the threads that will run them.
    ///
    /// # Errors
    /// The system gives no threads.
    pub fn new(config: Arc<Config>) -> Result<Self, Fault> {
        let budget = Arc::new(Budget::new(config.max_tick_budget));
        let scheduler = Scheduler::start(SchedulerPlan {
            workers: config.tick_workers as usize,
            priority: WorkerPriority::by_name(&config.tick_priority)
                .unwrap_or(WorkerPriority::Fifo),
            slow: Duration::from_secs_f64(config.slow_tick_s),
            stuck: Duration::from_secs_f64(config.stuck_tick_s),
        });
        let scheduler = scheduler
            .map_err(|e| Fault::Internal(format!("no threads for the ticks of worlds: {e}")))?;
        let past = Arc::new(Total::new(config.max_memory_bytes));
        Ok(Self {
            budget,
            scheduler,
            worlds: RwLock::default(),
            leaving: Arc::default(),
            next: AtomicU64::new(1),
            draining: AtomicBool::new(false),
            ending: Arc::default(),
            config,
            past,
            planners: Arc::new(Planners::start()),
        })
    }

    fn read(&self) -> RwLockReadGuard<'_, Worlds> {
        // Worlds are inserted and removed whole.
        self.worlds.read().unwrap_or_else(PoisonError::into_inner)
    }

    fn write(&self) -> RwLockWriteGuard<'_, Worlds> {
        // Likewise.
        self.worlds.write().unwrap_or_else(PoisonError::into_inner)
    }

    /// Never again chooses the number of this stored world for a name: the world may be in quarantine, or come back
    /// later.
    pub fn number_behind(&self, name: &str) {
        let number = name.strip_prefix(GIVEN).and_then(|n| n.parse::<u64>().ok());
        if let Some(number) = number {
            self.next
                .fetch_max(number.saturating_add(1), Ordering::Relaxed);
        }
    }

    /// Workers for the ticks of worlds, and the priority that the system grants them.
    pub fn workers(&self) -> (usize, WorkerPriority) {
        self.scheduler.workers()
    }

    /// Worlds whose ticks do not end.
    pub fn stuck(&self) -> Vec<Arc<str>> {
        self.scheduler.stuck()
    }

    /// Creates a world for a client, with its grants, and lets it run.
    ///
    /// # Errors
    /// The name is taken, there are too many worlds or too many of this client, there is no room for its ticks, or the
    /// server shuts down.
    pub fn create(
        &self,
        id: Option<String>,
        settings: WorldSettings,
        paused: bool,
        owner: (ClientKey, Vec<Grant>),
    ) -> Result<Arc<WorldHandle>, Fault> {
        self.start(id, (settings, None), paused, owner, false)
    }

    /// Creates a world in the state of a checkpoint.
    ///
    /// # Errors
    /// Those of [`Self::create`] and of [`HostedWorld::restore`].
    pub fn fork(
        &self,
        id: Option<String>,
        from: Scene,
        paused: bool,
        owner: (ClientKey, Vec<Grant>),
    ) -> Result<Arc<WorldHandle>, Fault> {
        let settings = from.settings().clone();
        self.start(id, (settings, Some(from)), paused, owner, false)
    }

    /// Brings a world back, in a state if there is one. It counts towards the share of its owner, but is admitted even
    /// if that exceeds the share.
    ///
    /// # Errors
    /// Those of [`Self::create`] and of [`HostedWorld::restore`].
    pub fn bring_back(
        &self,
        id: String,
        (settings, from): (WorldSettings, Option<Scene>),
        paused: bool,
        owner: (ClientKey, Vec<Grant>),
    ) -> Result<Arc<WorldHandle>, Fault> {
        let settings = from.as_ref().map_or(settings, |f| f.settings().clone());
        self.start(Some(id), (settings, from), paused, owner, true)
    }

    /// The name of a new world, or a free one if none is given; there must be room for it. `owner`: the client that
    /// must have a share left.
    fn admit(
        &self,
        worlds: &Worlds,
        id: Option<String>,
        owner: Option<&ClientKey>,
    ) -> Result<String, Fault> {
        let taken = |id: &str| worlds.contains_key(id) || locked(&self.leaving).contains(id);
        if self.draining.load(Ordering::SeqCst) {
            return Err(Fault::Draining);
        }
        let id = match id {
            Some(id) if taken(&id) => {
                return Err(Fault::Exists {
                    kind: "world",
                    name: format!("worlds/{id}"),
                });
            }
            Some(id) => id,
            None => loop {
                let id = format!("{GIVEN}{}", self.next.fetch_add(1, Ordering::Relaxed));
                if !taken(&id) {
                    break id;
                }
            },
        };
        if worlds.len() as u64 >= self.config.max_worlds {
            return Err(Fault::Exhausted {
                limit: "max_worlds",
                value: self.config.max_worlds,
                message: "one more world".into(),
                retry: None,
            });
        }
        if let Some(owner) = owner {
            let own = worlds.values().filter(|w| w.owner == *owner).count() as u64;
            let (most, share) = (self.config.max_worlds, self.config.max_client_share);
            check_part("max_worlds", own, most, share)?;
        }
        Ok(id)
    }

    /// The world that [`Self::create`] would create.
    ///
    /// # Errors
    /// Those of [`Self::create`].
    pub fn would_create(
        &self,
        id: Option<String>,
        settings: WorldSettings,
        paused: bool,
        owner: &ClientKey,
    ) -> Result<WorldInfo, Fault> {
        let id = self.admit(&self.read(), id, Some(owner))?;
        self.hosted(id.as_str().into(), settings, paused)
            .map(|hosted| hosted.info())
    }

    /// A world that has no thread yet.
    fn hosted(
        &self,
        id: Arc<str>,
        settings: WorldSettings,
        paused: bool,
    ) -> Result<HostedWorld, Fault> {
        let limits = WorldLimits {
            figures: self.config.max_figures_per_world,
            window: self.config.live_window_ms / 1e3,
        };
        let planners = Arc::clone(&self.planners);
        let budget = Arc::clone(&self.budget);
        HostedWorld::new(id, settings, paused, limits, planners, budget)
    }

    /// The past of a new world, if one is kept.
    fn journal(&self) -> Option<Arc<Journal>> {
        let room = Room {
            bytes: self.config.max_world_memory_bytes,
            age: Duration::from_secs_f64(self.config.memory_s),
        };
        let stored = !self.config.data_dir.is_empty();
        (room.any() || stored).then(|| Arc::new(Journal::new(room, Arc::clone(&self.past))))
    }

    fn start(
        &self,
        id: Option<String>,
        (settings, from): (WorldSettings, Option<Scene>),
        paused: bool,
        (owner, grants): (ClientKey, Vec<Grant>),
        back: bool,
    ) -> Result<Arc<WorldHandle>, Fault> {
        let shares = (!back).then_some(&owner);
        let id = self.admit(&self.read(), id, shares)?;
        let rate_hz = settings.rate_hz;
        let name: Arc<str> = id.as_str().into();
        // Do this outside the lock: it may create many figures, and look-ups of worlds must not wait for it.
        let mut hosted = self.hosted(name.clone(), settings, paused)?;
        if let Some(from) = from {
            hosted.restore(from, Past::Beginning)?;
        }
        let journal = self.journal();
        if let Some(journal) = &journal {
            hosted.keep_past(Arc::clone(journal));
        }
        let commands = Arc::new(CommandQueue::new(self.config.command_queue as usize));
        let outlet = Arc::new(Outlet::new(
            &mut hosted,
            self.config.history_ticks as usize,
            self.config.event_queue as usize,
        ));
        let mailboxes = hosted.mailboxes();
        let mut worlds = self.write();
        let id = self.admit(&worlds, Some(id), shares)?;
        let Added { ticket, closed } = self.scheduler.add(hosted, &commands, &outlet);
        let handle = Arc::new(WorldHandle {
            id: name,
            outlet,
            hub: Hub::new(
                self.config.max_views_per_world,
                self.config.max_client_share,
                self.config.history_ticks as usize,
            ),
            grants: Grants::new(grants),
            stored: watch::Sender::new(Persisted::Coming),
            owner,
            told_refused: Mutex::default(),
            waiting: WaitingCommands::new(self.config.command_queue, self.config.max_client_share),
            mailboxes,
            journal,
            seeking: tokio::sync::Mutex::default(),
            closed,
            rate_hz,
            dropped: AtomicU64::new(0),
            refused: AtomicU64::new(0),
            viewers: AtomicI64::new(0),
            usage: WorldUsage::default(),
            commands,
            ticket,
            ending: Arc::clone(&self.ending),
        });
        worlds.insert(id.clone(), handle.clone());
        metrics::gauge!("sinew_worlds").set(worlds.len() as f64);
        drop(worlds);
        tracing::info!(world = id, rate_hz, paused, "world created");
        Ok(handle)
    }

    /// One world.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn get(&self, id: &str) -> Result<Arc<WorldHandle>, Fault> {
        let found = self.read().get(id).cloned();
        found.ok_or_else(|| self.missing(id))
    }

    /// Whether this very world exists, and not only one of the same name.
    pub fn holds(&self, handle: &WorldHandle) -> bool {
        let found = self.get(&handle.id);
        found.is_ok_and(|there| std::ptr::eq(&*there, handle))
    }

    fn missing(&self, id: &str) -> Fault {
        if self.ending.load(Ordering::SeqCst) {
            return Fault::Draining; // it may have been there
        }
        Fault::not_found("world", format!("worlds/{id}"))
    }

    /// Whether the server is about to end.
    pub fn is_draining(&self) -> bool {
        self.draining.load(Ordering::SeqCst)
    }

    /// Refuses new worlds; existing ones continue.
    pub fn refuse_new(&self) {
        let _worlds = self.write();
        self.draining.store(true, Ordering::SeqCst);
    }

    /// All worlds, by name.
    pub fn list(&self) -> Vec<Arc<WorldHandle>> {
        self.read().values().cloned().collect()
    }

    /// Ends a world and waits until it has ended. `by`: the caller or the reason, for viewers of its events.
    ///
    /// # Errors
    /// There is none of that name.
    pub async fn delete(&self, id: &str, by: &str) -> Result<Leaving, Fault> {
        let deleted = self.delete_if(id, by, |_| true).await?;
        deleted.ok_or_else(|| self.missing(id))
    }

    /// Ends a world if `still` agrees once no caller can obtain it any more; `None` if it continues.
    ///
    /// # Errors
    /// There is none of that name.
    pub async fn delete_if(
        &self,
        id: &str,
        by: &str,
        still: impl FnOnce(&Arc<WorldHandle>) -> bool,
    ) -> Result<Option<Leaving>, Fault> {
        let leaving = {
            let mut worlds = self.write();
            let found = worlds.get(id).ok_or_else(|| self.missing(id))?;
            if !still(found) {
                return Ok(None);
            }
            let handle = worlds.remove(id).ok_or_else(|| self.missing(id))?;
            metrics::gauge!("sinew_worlds").set(worlds.len() as f64);
            locked(&self.leaving).insert(handle.id.clone());
            Leaving {
                handle,
                names: Arc::clone(&self.leaving),
            }
        };
        let why = Fault::Aborted {
            reason: "WORLD_DELETED",
            message: "the world was deleted before its steps were done".into(),
        };
        end(&leaving.handle, why, Some(by)).await;
        tracing::info!(world = id, by, "world deleted");
        Ok(Some(leaving))
    }

    /// Ends all worlds; none can be created afterwards.
    pub async fn drain(&self) {
        let all = {
            let mut worlds = self.write();
            self.draining.store(true, Ordering::SeqCst);
            self.ending.store(true, Ordering::SeqCst);
            std::mem::take(&mut *worlds)
        };
        let ends = all
            .values()
            .map(|handle| end(handle, Fault::Draining, None));
        futures_util::future::join_all(ends).await;
    }
}

async fn end(handle: &WorldHandle, why: Fault, by: Option<&str>) {
    // A full queue must not keep the world alive; it drains within a tick.
    let origin = CommandOrigin {
        client: "".into(),
        sequence: i64::MIN,
    };
    loop {
        let (why, by) = (why.clone(), by.map(str::to_owned));
        let sent = handle.send(origin.clone(), |s| s.close(why, by));
        if !matches!(sent, Err(Fault::Exhausted { .. })) {
            break;
        }
        tokio::time::sleep(Duration::from_millis(5)).await;
    }
    let mut closed = handle.closed.clone();
    let mut lost = handle.outlet.lost.subscribe();
    tokio::select! {
        _ = closed.changed() => {} // an error: it has ended, as it should
        _ = lost.wait_for(Option::is_some) => handle.ticket.abandon(),
    }
}
