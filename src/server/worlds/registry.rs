//! The worlds of this server, and how others talk to them.

use crate::server::access::caller::Caller;
use crate::server::access::grants::{Grant, Grants};
use crate::server::config::Config;
use crate::server::durable::store::WorldKey;
use crate::server::fanout::hub::Hub;
use crate::server::ingest::mailbox::Mailboxes;
use crate::server::shares::{Client, check_part, part};
use crate::server::tick::Outlet;
use crate::server::tick::budget::Budget;
use crate::server::tick::command::{Command, Origin, Queue, Refusal};
use crate::server::tick::history::History;
use crate::server::tick::journal::{Journal, Room, Total};
use crate::server::tick::planners::Planners;
use crate::server::tick::scene::Scene;
use crate::server::tick::scheduler::{Added, Plan, Priority, Scheduler, Ticket};
use crate::server::tick::shard::{Limits, Origin as Past, Shard};
use crate::server::tick::stage_times::{Percentiles, STAGES};
use crate::server::worlds::usage::Usage;
use crate::sim::body::Body;
use crate::wire::status::Fault;
use crate::wire::types::{ControlInfo, Described, FigureInfo, Snapshot, WorldInfo, WorldSettings};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, RwLock};
use std::time::{Duration, Instant};
use tokio::sync::{oneshot, watch};

/// One world, seen from outside the thread that runs it.
#[derive(Debug)]
pub struct WorldHandle {
    /// Last part of its name.
    pub id: Arc<str>,
    /// What leaves that thread.
    pub outlet: Arc<Outlet>,
    /// Its views.
    pub hub: Hub,
    /// Where its drivers leave their motion.
    pub mailboxes: Arc<Mailboxes>,
    /// Its past, if that is kept.
    pub journal: Option<Arc<Journal>>,
    /// Held by who looks for a state of that past to put the world into.
    pub seeking: tokio::sync::Mutex<()>,
    /// Ends when the world does.
    pub closed: watch::Receiver<()>,
    /// Ticks per second.
    pub rate_hz: f64,
    /// Frames that viewers were too slow for.
    pub dropped: AtomicU64,
    /// Requests that found the queue full.
    pub refused: AtomicU64,
    /// Viewers.
    pub viewers: AtomicI64,
    /// When it was used last.
    pub usage: Usage,
    /// Who has which roles in it.
    pub grants: Grants,
    /// Whether it is written down, and where.
    pub stored: watch::Sender<Stored>,
    /// Who created it.
    owner: Client,
    /// When those who watch were last told that someone was refused.
    told_refused: Mutex<Option<Instant>>,
    /// Commands of each client that wait.
    waiting: Waiting,
    commands: Arc<Queue>,
    ticket: Ticket,
    draining: Arc<AtomicBool>,
    queue: u64,
}

/// Whether a world is written down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stored {
    /// Not yet. Whoever changes it waits for that.
    Coming,
    /// Under this number, which no other world has had.
    At(WorldKey),
    /// It is there as long as the server is.
    Never,
}

/// Least time between two events that tell of refusals.
const REFUSALS_EVERY: Duration = Duration::from_secs(1);

/// Commands that wait, by client: one client fills no more than its share of a queue.
#[derive(Clone, Debug)]
struct Waiting {
    by_client: Arc<Mutex<HashMap<Arc<str>, u64>>>,
    most: u64,
    share: f64,
}

/// A command that waits.
struct Waits {
    waiting: Waiting,
    client: Arc<str>,
}

impl Drop for Waits {
    fn drop(&mut self) {
        let mut all = self.waiting.lock();
        if let Some(count) = all.get_mut(&self.client) {
            *count -= 1;
            if *count == 0 {
                all.remove(&self.client);
            }
        }
    }
}

impl Waiting {
    fn lock(&self) -> MutexGuard<'_, HashMap<Arc<str>, u64>> {
        self.by_client
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    fn enter(&self, client: &Arc<str>) -> Result<Waits, Fault> {
        let mut all = self.lock();
        let count = all.entry(client.clone()).or_default();
        let own = part(self.most, self.share);
        if *count >= own {
            return Err(Fault::Exhausted {
                limit: "command_queue",
                value: self.most,
                message: format!("one client may have {own} of them (max_client_share)"),
                retry: Some(Duration::from_millis(20)),
            });
        }
        *count += 1;
        Ok(Waits {
            waiting: self.clone(),
            client: client.clone(),
        })
    }
}

/// How busy a world is.
#[derive(Clone, Debug)]
pub struct WorldStats {
    /// Last part of its name.
    pub id: String,
    /// Ticks computed, overruns, deadlines left out.
    pub ticks: [u64; 3],
    /// Refused requests.
    pub refused: u64,
    /// Dropped frames.
    pub dropped: u64,
    /// Viewers.
    pub viewers: i64,
    /// p99 of a tick relative to its period at the present speed.
    pub budget_used: f64,
    /// Stages of a tick.
    pub stages: [(&'static str, Percentiles); STAGES.len()],
}

impl WorldHandle {
    /// Whose share of the worlds it is.
    pub fn owner(&self) -> &Client {
        &self.owner
    }

    /// Waits until it is known whether and where it is written down.
    ///
    /// # Errors
    /// It has ended before.
    pub async fn place(&self) -> Result<Stored, Fault> {
        let (mut stored, mut closed) = (self.stored.subscribe(), self.closed.clone());
        let known = stored.wait_for(|s| *s != Stored::Coming);
        tokio::select! {
            biased;
            known = known => known.map(|s| *s).map_err(|_| self.ended()),
            _ = closed.changed() => Err(self.ended()),
        }
    }

    fn gone(&self) -> Fault {
        if let Some(why) = self.lost() {
            return why;
        }
        if self.draining.load(Ordering::SeqCst) {
            return Fault::Draining;
        }
        Fault::not_found("world", format!("worlds/{}", self.id))
    }

    /// Why nobody waits for the world any more, if its tick does not end.
    fn lost(&self) -> Option<Fault> {
        self.outlet.lost.borrow().clone()
    }

    /// Waits for an answer of the world, as long as that can give one.
    ///
    /// # Errors
    /// Those of the answer; the world has ended, or its tick does not end.
    pub async fn answer<T>(&self, answer: oneshot::Receiver<Result<T, Fault>>) -> Result<T, Fault> {
        let mut lost = self.outlet.lost.subscribe();
        tokio::select! {
            biased;
            answer = answer => answer.unwrap_or_else(|_| Err(self.ended())),
            // Its sender lives as long as this handle.
            _ = lost.wait_for(Option::is_some) => Err(self.ended()),
        }
    }

    /// What a request learns that the end of the world came in between of.
    pub fn ended(&self) -> Fault {
        if let Some(why) = self.lost() {
            return why;
        }
        if self.draining.load(Ordering::SeqCst) {
            return Fault::Draining;
        }
        Fault::Aborted {
            reason: "WORLD_ENDED",
            message: format!("world {:?} ended before the request was done", &*self.id),
        }
    }

    /// Tells those who watch events that a caller was refused, once in a while.
    pub fn tell_refused(&self, caller: &Caller, figure: &str) {
        let now = Instant::now();
        let mut told = self
            .told_refused
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        if told.is_some_and(|at| now - at < REFUSALS_EVERY) {
            return;
        }
        *told = Some(now);
        drop(told);
        let origin = Origin {
            client: caller.order.clone(),
            sequence: 0,
        };
        let (figure, who, call) = (
            figure.to_owned(),
            caller.principal().clone(),
            caller.call.clone(),
        );
        // A full queue has no room for news.
        let _ = self.send(origin, move |s| {
            // A name that a stranger made up is not repeated.
            let figure = if s.figure(&figure).is_ok() {
                figure.as_str()
            } else {
                ""
            };
            s.tell_refused(figure, &who, &call);
        });
    }

    /// Queues something for the start of the next tick.
    ///
    /// # Errors
    /// The queue is full, the client has its share of it, or the world is gone.
    pub fn send(
        &self,
        origin: Origin,
        action: impl FnOnce(&mut Shard) + Send + 'static,
    ) -> Result<(), Fault> {
        let place = self.waiting.enter(&origin.client)?;
        let command = Command {
            origin,
            action: Box::new(move |shard| {
                drop(place);
                action(shard);
            }),
        };
        self.commands.push(command).map_err(|e| match e {
            Refusal::Full => {
                self.refused.fetch_add(1, Ordering::Relaxed);
                metrics::counter!("sinew_commands_refused_total").increment(1);
                Fault::Exhausted {
                    limit: "command_queue",
                    value: self.queue,
                    message: format!("requests wait for the next tick of world {:?}", &*self.id),
                    retry: Some(Duration::from_secs_f64((2.0 / self.rate_hz).max(0.01))),
                }
            }
            Refusal::Closed => self.gone(),
        })?;
        self.ticket.wake();
        Ok(())
    }

    /// Does something at the start of the next tick and waits for its result.
    ///
    /// # Errors
    /// Those of `f`; the queue is full; the world is gone.
    pub async fn call<T: Send + 'static>(
        &self,
        origin: Origin,
        f: impl FnOnce(&mut Shard) -> Result<T, Fault> + Send + 'static,
    ) -> Result<T, Fault> {
        let (tx, rx) = oneshot::channel();
        let _in_use = self.usage.begin();
        self.send(origin, move |shard| {
            let done = catch_unwind(AssertUnwindSafe(|| f(shard)));
            match done {
                Ok(result) => shard.reply(move || {
                    // The caller may have given up; then nobody wants the answer.
                    let _ = tx.send(result);
                }),
                Err(panic) => {
                    // The caller learns of it when others can see that the world has failed.
                    shard.reply(move || drop(tx));
                    resume_unwind(panic);
                }
            }
        })?;
        let result = self.answer(rx).await?;
        if let Some(journal) = &self.journal {
            journal
                .settled()
                .await
                .map_err(|e| Fault::Storage(e.to_string()))?;
        }
        Ok(result)
    }

    /// The world as it is now. Reading never waits for a tick.
    pub fn info(&self) -> WorldInfo {
        let described = self.outlet.described.borrow().clone();
        let latest = self.latest();
        WorldInfo {
            tick: latest.tick,
            time: latest.time,
            ..described.world.clone()
        }
    }

    /// The latest frame.
    pub fn latest(&self) -> Arc<Snapshot> {
        self.outlet.latest.borrow().clone()
    }

    /// World and figures as they were when something of them changed last.
    pub fn described(&self) -> Arc<Described> {
        self.outlet.described.borrow().clone()
    }

    /// One figure.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn figure(&self, figure: &str) -> Result<FigureInfo, Fault> {
        let described = self.described();
        let found = described.figures.iter().find(|f| f.id == figure);
        let found = found.ok_or_else(|| {
            Fault::not_found("figure", format!("worlds/{}/figures/{figure}", self.id))
        })?;
        Ok(as_of(&self.latest(), found))
    }

    /// All figures, in the order of creation.
    pub fn figures(&self) -> Vec<FigureInfo> {
        let (described, latest) = (self.described(), self.latest());
        let figures = described.figures.iter();
        figures.map(|f| as_of(&latest, f)).collect()
    }

    /// Who controls a figure.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn control(&self, figure: &str) -> Result<ControlInfo, Fault> {
        let described = self.described();
        let found = described.controls.iter().find(|c| c.figure == figure);
        let mut info = found.cloned().ok_or_else(|| {
            Fault::not_found("figure", format!("worlds/{}/figures/{figure}", self.id))
        })?;
        let since = described.at.elapsed();
        info.expires_in = info.expires_in.map(|left| left.saturating_sub(since));
        Ok(info)
    }

    /// The body of a figure, and the last part of its name.
    ///
    /// # Errors
    /// There is no figure of that name.
    pub fn body_of(&self, figure: &str) -> Result<(String, Arc<Body>), Fault> {
        let latest = self.latest();
        let i = latest.roster.iter().position(|e| e.figure == figure);
        let i = i.ok_or_else(|| {
            Fault::not_found("figure", format!("worlds/{}/figures/{figure}", self.id))
        })?;
        Ok((
            latest.roster[i].body.clone(),
            latest.figures[i].body.clone(),
        ))
    }

    /// Frames of the last ticks.
    pub fn history(&self) -> MutexGuard<'_, History> {
        let history = self.outlet.history.lock();
        history.unwrap_or_else(PoisonError::into_inner)
    }

    /// How busy it is.
    pub fn stats(&self) -> WorldStats {
        let times = self
            .outlet
            .times
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone();
        let summary = times.summary();
        let speed = self.described().world.settings.pace.speed;
        let load = |a: &AtomicU64| a.load(Ordering::Relaxed);
        WorldStats {
            id: self.id.to_string(),
            ticks: [
                load(&self.outlet.ticks),
                load(&self.outlet.overruns),
                load(&self.outlet.skipped),
            ],
            refused: load(&self.refused),
            dropped: load(&self.dropped),
            viewers: self.viewers.load(Ordering::Relaxed),
            budget_used: summary[STAGES.len() - 1].p99 * 1e-6 * self.rate_hz * speed,
            stages: std::array::from_fn(|i| (STAGES[i], summary[i])),
        }
    }
}

/// A figure as it was described last, with what a frame says of it that changes from tick to tick.
fn as_of(latest: &Snapshot, described: &FigureInfo) -> FigureInfo {
    let mut figures = latest.roster.iter().zip(&latest.figures);
    let shown = figures.find(|(entry, _)| entry.index == described.index);
    FigureInfo {
        follows: shown.map_or(described.follows, |(_, f)| f.follows),
        ..described.clone()
    }
}

/// A world that is being deleted. Its name is taken until this is dropped, so that what belongs to it can be forgotten
/// by that.
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

/// All worlds.
#[derive(Debug)]
pub struct Registry {
    worlds: RwLock<BTreeMap<String, Arc<WorldHandle>>>,
    /// Names of worlds that are being deleted. Locked after `worlds`.
    leaving: Arc<Mutex<HashSet<Arc<str>>>>,
    next: AtomicU64,
    /// No new worlds.
    draining: AtomicBool,
    /// Worlds end because the server does.
    ending: Arc<AtomicBool>,
    config: Arc<Config>,
    /// What the past of all worlds takes.
    past: Arc<Total>,
    planners: Arc<Planners>,
    scheduler: Scheduler,
    /// What the ticks of all worlds may cost.
    pub budget: Arc<Budget>,
}

impl Registry {
    /// No worlds yet; starts the threads that will run them.
    ///
    /// # Errors
    /// The system gives no threads.
    pub fn new(config: Arc<Config>) -> Result<Self, Fault> {
        let budget = Arc::new(Budget::new(config.max_tick_budget));
        let scheduler = Scheduler::start(Plan {
            workers: config.tick_workers as usize,
            priority: Priority::by_name(&config.tick_priority).unwrap_or(Priority::Fifo),
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

    /// Workers for the ticks of worlds, and how urgent the system lets them be.
    pub fn workers(&self) -> (usize, Priority) {
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
        owner: (Client, Vec<Grant>),
    ) -> Result<Arc<WorldHandle>, Fault> {
        self.start(id, (settings, None), paused, owner, false)
    }

    /// Creates a world in the state of a checkpoint.
    ///
    /// # Errors
    /// Those of [`Self::create`] and of [`Shard::restore`].
    pub fn fork(
        &self,
        id: Option<String>,
        from: Scene,
        paused: bool,
        owner: (Client, Vec<Grant>),
    ) -> Result<Arc<WorldHandle>, Fault> {
        let settings = from.settings().clone();
        self.start(id, (settings, Some(from)), paused, owner, false)
    }

    /// Brings a world back, in a state if there is one. It counts to the share of its owner, and there is room for it
    /// also if that has more than its share.
    ///
    /// # Errors
    /// Those of [`Self::create`] and of [`Shard::restore`].
    pub fn bring_back(
        &self,
        id: String,
        (settings, from): (WorldSettings, Option<Scene>),
        paused: bool,
        owner: (Client, Vec<Grant>),
    ) -> Result<Arc<WorldHandle>, Fault> {
        let settings = from.as_ref().map_or(settings, |f| f.settings().clone());
        self.start(Some(id), (settings, from), paused, owner, true)
    }

    /// The name of a new world, one that is free if none is given; there must be room for it. `owner`: who has to have
    /// a share left.
    fn admit(
        &self,
        worlds: &BTreeMap<String, Arc<WorldHandle>>,
        id: Option<String>,
        owner: Option<&Client>,
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
                let id = format!("world-{}", self.next.fetch_add(1, Ordering::Relaxed));
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
    /// Its own.
    pub fn would_create(
        &self,
        id: Option<String>,
        settings: WorldSettings,
        paused: bool,
        owner: &Client,
    ) -> Result<WorldInfo, Fault> {
        let worlds = self.worlds.read().unwrap_or_else(PoisonError::into_inner);
        let id = self.admit(&worlds, id, Some(owner))?;
        self.shard(id.as_str().into(), settings, paused)
            .map(|shard| shard.info())
    }

    /// A world that has no thread yet.
    fn shard(&self, id: Arc<str>, settings: WorldSettings, paused: bool) -> Result<Shard, Fault> {
        let limits = Limits {
            figures: self.config.max_figures_per_world,
            window: self.config.live_window_ms / 1e3,
        };
        let planners = Arc::clone(&self.planners);
        let budget = Arc::clone(&self.budget);
        Shard::new(id, settings, paused, limits, planners, budget)
    }

    fn start(
        &self,
        id: Option<String>,
        (settings, from): (WorldSettings, Option<Scene>),
        paused: bool,
        (owner, grants): (Client, Vec<Grant>),
        back: bool,
    ) -> Result<Arc<WorldHandle>, Fault> {
        let shares = (!back).then_some(&owner);
        let id = {
            let worlds = self.worlds.read().unwrap_or_else(PoisonError::into_inner);
            self.admit(&worlds, id, shares)?
        };
        let rate_hz = settings.rate_hz;
        let name: Arc<str> = id.as_str().into();
        // Nobody who looks a world up waits for what may take many figures.
        let mut shard = self.shard(name.clone(), settings, paused)?;
        if let Some(from) = from {
            shard.restore(from, Past::Beginning)?;
        }
        let room = Room {
            bytes: self.config.max_world_memory_bytes,
            age: Duration::from_secs_f64(self.config.memory_s),
        };
        let stored = !self.config.data_dir.is_empty();
        let journal =
            (room.any() || stored).then(|| Arc::new(Journal::new(room, Arc::clone(&self.past))));
        if let Some(journal) = &journal {
            shard.keep_past(Arc::clone(journal));
        }
        let commands = Arc::new(Queue::new(self.config.command_queue as usize));
        let outlet = Arc::new(Outlet::new(
            &mut shard,
            self.config.history_ticks as usize,
            self.config.event_queue as usize,
        ));
        let mailboxes = shard.mailboxes();
        let mut worlds = self.worlds.write().unwrap_or_else(PoisonError::into_inner);
        let id = self.admit(&worlds, Some(id), shares)?;
        let Added { ticket, closed } = self.scheduler.add(shard, &commands, &outlet);
        let handle = Arc::new(WorldHandle {
            id: name,
            outlet,
            hub: Hub::new(
                self.config.max_views_per_world,
                self.config.max_client_share,
                self.config.history_ticks as usize,
            ),
            grants: Grants::new(grants),
            stored: watch::Sender::new(Stored::Coming),
            owner,
            told_refused: Mutex::default(),
            waiting: Waiting {
                by_client: Arc::default(),
                most: self.config.command_queue,
                share: self.config.max_client_share,
            },
            mailboxes,
            journal,
            seeking: tokio::sync::Mutex::default(),
            closed,
            rate_hz,
            dropped: AtomicU64::new(0),
            refused: AtomicU64::new(0),
            viewers: AtomicI64::new(0),
            usage: Usage::default(),
            commands,
            ticket,
            draining: Arc::clone(&self.ending),
            queue: self.config.command_queue,
        });
        worlds.insert(id.clone(), handle.clone());
        metrics::gauge!("sinew_worlds").set(worlds.len() as f64);
        tracing::info!(world = id, rate_hz, paused, "world created");
        Ok(handle)
    }

    /// One world.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn get(&self, id: &str) -> Result<Arc<WorldHandle>, Fault> {
        self.worlds
            .read()
            .unwrap_or_else(PoisonError::into_inner)
            .get(id)
            .cloned()
            .ok_or_else(|| self.missing(id))
    }

    /// Whether this very world is there, and not only one of its name.
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

    /// True once the server is about to end.
    pub fn is_draining(&self) -> bool {
        self.draining.load(Ordering::SeqCst)
    }

    /// Lets no world be created any more; those that are there go on.
    pub fn refuse_new(&self) {
        let _worlds = self.worlds.write().unwrap_or_else(PoisonError::into_inner);
        self.draining.store(true, Ordering::SeqCst);
    }

    /// All worlds, by name.
    pub fn list(&self) -> Vec<Arc<WorldHandle>> {
        self.worlds
            .read()
            .unwrap_or_else(PoisonError::into_inner)
            .values()
            .cloned()
            .collect()
    }

    /// Ends a world and waits until it has ended. `by`: who wants it, or why, for those who watch its
    /// events.
    ///
    /// # Errors
    /// There is none of that name.
    pub async fn delete(&self, id: &str, by: &str) -> Result<Leaving, Fault> {
        let deleted = self.delete_if(id, by, |_| true).await?;
        deleted.ok_or_else(|| self.missing(id))
    }

    /// Ends a world if `still` says so once nobody can get hold of it any more; `None` if it goes on.
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
            let mut worlds = self.worlds.write().unwrap_or_else(PoisonError::into_inner);
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
            let mut worlds = self.worlds.write().unwrap_or_else(PoisonError::into_inner);
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
    let origin = Origin {
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
