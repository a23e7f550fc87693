//! One world with everything that belongs to its clock: figures by name, drivers, held frames. Owned by the thread that
//! runs it; others send [`Command`](super::command::Command)s that call these methods between ticks.

pub mod bounds;
mod checkpoint;
mod clips;
mod control;
mod desired_motion;
mod figures;
mod obstacles;
mod perturbations;

pub use checkpoint::StateOrigin;

use super::budget::{Account, Budget, Meter};
use super::clock::TickClock;
use super::drives::DriverSession;
use super::journal::Journal;
use super::leases::Leases;
use super::planners::Planners;
use super::scene::{PlayerKey, Scene, SceneInput};
use crate::durable::marks::WorldMark;
use crate::engine::{self, FigureKey, Planning};
use crate::ingest::mailbox::Mailboxes;
use bounds::Shares;
use sinew_physics::time::WorldTime;
use sinew_wire::status::Fault;
use sinew_wire::types::{
    Described, EventKind, RosterEntry, Snapshot, WorldCondition, WorldEvent, WorldInfo,
    WorldSettings, WorldUpdate,
};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::time::{Instant, SystemTime};

/// Limits of one world, from the configuration.
#[derive(Clone, Copy, Debug)]
pub struct WorldLimits {
    /// Figures.
    pub figures: u64,
    /// Window of live motion for drivers that name none, s; 0: none.
    pub window: f64,
}

/// Steps that a client waits for.
pub struct StepRequest {
    /// Ticks left.
    pub left: u32,
    /// Called with the last snapshot, or with the reason why the steps were interrupted.
    pub done: Box<dyn FnOnce(Result<Arc<Snapshot>, Fault>) + Send>,
    /// Whether the client no longer waits.
    pub abandoned: Box<dyn Fn() -> bool + Send>,
}

/// A clip that plays: its id, and when it started.
type PlayingClip = (String, WorldTime);

/// A world and what belongs to its clock.
pub struct HostedWorld {
    id: Arc<str>,
    created: SystemTime,
    /// Counts the times that its past was replaced.
    epoch: i32,
    limits: WorldLimits,
    planners: Arc<Planners>,
    budget: Arc<Budget>,
    account: Arc<Account>,
    scene: Scene,
    /// The clips that events have announced.
    told: BTreeMap<FigureKey, PlayingClip>,
    /// The journal of its past.
    journal: Option<Arc<Journal>>,
    roster: Arc<[RosterEntry]>,
    roster_version: i32,
    drives: Vec<DriverSession>,
    /// Players of live motion without a driver, and the tick until which they stay: they came with the state that the
    /// world began with.
    undriven: BTreeMap<PlayerKey, u64>,
    /// World time that earlier clocks had skipped, s: live motion counts with it.
    lost_before: f64,
    leases: Leases,
    /// The perturbations of perturbers with bounds.
    shares: Shares,
    mailboxes: Arc<Mailboxes>,
    next_driver: u64,
    described: bool,
    passing: bool,
    events: Vec<WorldEvent>,
    pub(super) clock: TickClock,
    pub(super) steps: VecDeque<StepRequest>,
    pub(super) paused: bool,
    pub(super) failed: Option<String>,
    replies: Vec<Box<dyn FnOnce() + Send>>,
    /// Whether the view changed without a tick.
    pub(super) changed: bool,
    /// Reason why the world ends after this round.
    pub(super) closing: Option<Fault>,
    /// The place where it notes each step, and the time until which it does so.
    step_notes: Option<(WorldMark, Instant)>,
}

impl HostedWorld {
    /// A world without figures.
    ///
    /// # Errors
    /// The physics refuses the settings, or there is no room for its ticks.
    pub fn new(
        id: Arc<str>,
        settings: WorldSettings,
        paused: bool,
        limits: WorldLimits,
        planners: Arc<Planners>,
        budget: Arc<Budget>,
    ) -> Result<Self, Fault> {
        let scene = Scene::new(settings.clone())?;
        let pace = &settings.pace;
        let speed = if paused { 0.0 } else { pace.speed };
        let account = budget.open(settings.rate_hz * speed, settings.substeps)?;
        let clock = TickClock::new(settings.rate_hz, pace.speed, pace.overrun, Instant::now());
        Ok(Self {
            id,
            created: SystemTime::now(),
            epoch: 1,
            limits,
            planners,
            budget,
            account,
            scene,
            told: BTreeMap::new(),
            journal: None,
            roster: Arc::new([]),
            roster_version: 1,
            drives: Vec::new(),
            undriven: BTreeMap::new(),
            lost_before: 0.0,
            leases: Leases::default(),
            shares: Shares::default(),
            mailboxes: Arc::default(),
            next_driver: 1,
            described: false,
            passing: false,
            events: Vec::new(),
            clock,
            steps: VecDeque::new(),
            replies: Vec::new(),
            paused,
            failed: None,
            changed: true,
            closing: None,
            step_notes: None,
        })
    }

    /// Notes each step for some time, so that a world that crashes the process is known afterwards.
    pub fn note_steps(&mut self, mark: WorldMark, until: Instant) {
        self.step_notes = Some((mark, until));
    }

    /// Last part of its name.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Number of figures.
    pub(super) fn figure_count(&self) -> usize {
        self.scene.members().len()
    }

    /// Its clock stands still for good, so it needs nothing of the budget.
    pub(super) fn needs_nothing(&self) {
        // A lower need is never refused.
        let _ = self.budget.set_pace(&self.account, 0.0);
    }

    /// Its account, and the budget that contains it.
    pub(super) fn books(&self) -> (Arc<Account>, Arc<Budget>) {
        (Arc::clone(&self.account), Arc::clone(&self.budget))
    }

    /// Places its deadlines at a part of the period, counted from `start`.
    pub(super) fn stagger(&mut self, start: Instant, part: f64) {
        self.clock.stagger(start, part, Instant::now());
    }

    /// Whether something in it can expire by wall clock or arrive without a command, even while its clock stands still.
    pub(super) fn needs_looks(&self) -> bool {
        !self.drives.is_empty() || self.leases.are_held()
    }

    /// The meter of this world.
    pub(super) fn meter(&self) -> Meter {
        Meter::new(Arc::clone(&self.account), Arc::clone(&self.budget))
    }

    /// The mailboxes in which drivers leave their motion.
    pub fn mailboxes(&self) -> Arc<Mailboxes> {
        Arc::clone(&self.mailboxes)
    }

    // ── the world ──

    /// The world as it is now.
    pub fn info(&self) -> WorldInfo {
        WorldInfo {
            id: self.id.to_string(),
            settings: self.scene.settings().clone(),
            condition: match (&self.failed, self.paused) {
                (Some(why), _) => WorldCondition::Failed(why.clone()),
                (None, true) => WorldCondition::Paused,
                (None, false) => WorldCondition::Running,
            },
            tick: self.scene.world().tick(),
            time: self.scene.world().time().0,
            figures: self.scene.members().len(),
            epoch: self.epoch,
            created: self.created,
        }
    }

    fn working(&self) -> Result<(), Fault> {
        self.failure().map_or(Ok(()), Err)
    }

    /// The answer to clients of a failed world.
    pub(super) fn failure(&self) -> Option<Fault> {
        self.failed.as_ref().map(|why| Fault::Precondition {
            reason: "WORLD_FAILED",
            message: format!("world {:?} failed: {why}", &*self.id),
            facts: vec![],
        })
    }

    fn restart_clock(&mut self) {
        let pace = &self.scene.settings().pace;
        self.clock.restart(
            self.scene.settings().rate_hz,
            pace.speed,
            pace.overrun,
            Instant::now(),
        );
    }

    /// The world as [`Self::update`] would leave it.
    pub fn would_update(&self, u: WorldUpdate) -> Result<WorldInfo, Fault> {
        self.working()?;
        if let Some(speed) = u.speed.filter(|_| !self.paused) {
            let rate = self.scene.settings().rate_hz;
            self.budget.would_set_pace(&self.account, rate * speed)?;
        }
        let mut info = self.info();
        u.apply(&mut info.settings.pace);
        Ok(info)
    }

    /// Changes pace or name.
    pub fn update(&mut self, u: WorldUpdate) -> Result<WorldInfo, Fault> {
        self.working()?;
        if let Some(speed) = u.speed.filter(|_| !self.paused) {
            self.budget
                .set_pace(&self.account, self.scene.settings().rate_hz * speed)?;
        }
        let timed = u.overrun.is_some() || u.catch_up_limit.is_some() || u.speed.is_some();
        let mut pace = self.scene.settings().pace.clone();
        u.apply(&mut pace);
        self.scene.apply(SceneInput::Pace(pace))?;
        if timed {
            self.restart_clock();
        }
        Ok(self.info())
    }

    /// Stops the clock.
    pub fn pause(&mut self) -> Result<WorldInfo, Fault> {
        self.working()?;
        if !self.paused {
            self.budget.set_pace(&self.account, 0.0)?;
            self.paused = true;
            self.world_event(EventKind::Paused);
        }
        Ok(self.info())
    }

    /// Starts the clock; pending steps are given up.
    ///
    /// # Errors
    /// The world has failed, or there is no room for its ticks.
    pub fn resume(&mut self) -> Result<WorldInfo, Fault> {
        self.working()?;
        if self.paused {
            let pace = self.scene.settings().rate_hz * self.scene.settings().pace.speed;
            self.budget.set_pace(&self.account, pace)?;
            self.paused = false;
            self.restart_clock();
            self.world_event(EventKind::Resumed);
            for step in self.steps.drain(..) {
                (step.done)(Err(Fault::Aborted {
                    reason: "WORLD_RESUMED",
                    message: "the world was resumed before its steps were done".into(),
                }));
            }
        }
        Ok(self.info())
    }

    /// Queues ticks of a paused world.
    pub fn step(&mut self, request: StepRequest) {
        let ready = self.working().and_then(|()| {
            if self.paused {
                Ok(())
            } else {
                Err(Fault::Precondition {
                    reason: "WORLD_NOT_PAUSED",
                    message: format!("world {:?} is running: pause it to step it", &*self.id),
                    facts: vec![],
                })
            }
        });
        match ready {
            Ok(()) => self.steps.push_back(request),
            Err(fault) => (request.done)(Err(fault)),
        }
    }

    /// World and figures as described to clients, if anything in the description may have changed since the last call:
    /// by a command, or because clips follow each other and constraints expire.
    pub(super) fn describe(&mut self) -> Option<Arc<Described>> {
        let passing = self.scene.members().iter().any(|m| {
            let f = self.scene.figure(m.key);
            f.next_clip().is_some() || !f.constraints().is_empty()
        });
        let passing = passing || self.control_passes();
        let before = std::mem::replace(&mut self.passing, passing);
        if std::mem::replace(&mut self.described, true) && !passing && !before {
            return None;
        }
        Some(Arc::new(Described {
            world: self.info(),
            figures: self.figures(),
            controls: self.controls(),
            at: Instant::now(),
        }))
    }

    /// Marks the description of the world for clients as outdated.
    pub(super) fn touch(&mut self) {
        self.described = false;
    }

    /// Answers a command once viewers can see its effect, so that a client sees its own changes.
    pub fn reply(&mut self, answer: impl FnOnce() + Send + 'static) {
        self.replies.push(Box::new(answer));
    }

    pub(super) fn send_replies(&mut self) {
        for answer in self.replies.drain(..) {
            answer();
        }
    }

    /// Ends the world after this round of commands; clients that wait for steps are told why. `by`: the caller that
    /// deleted it, for viewers of its events.
    pub fn close(&mut self, why: Fault, by: Option<String>) {
        if let Some(by) = by {
            self.world_event(EventKind::Deleted(by));
        }
        self.closing.get_or_insert(why);
    }

    // ── the tick ──

    /// Keeps the past of this world from now on.
    pub fn keep_past(&mut self, journal: Arc<Journal>) {
        self.scene.keep_records();
        journal.begin(self.scene.capture(), Instant::now());
        self.journal = Some(journal);
    }

    /// Hands the changes of the world since the last call to its journal.
    pub(super) fn flush(&mut self) {
        let record = self.scene.take_record();
        if let (Some(journal), Some(record)) = (&self.journal, record) {
            journal.append(record);
        }
    }

    /// Notes the results of this round: changes, a tick if there was one, and a checkpoint if one is due. A failed
    /// world keeps its past up to the failure. Returns the hash of the state after the tick if it was noted.
    pub(super) fn note(&mut self, stepped: bool, now: Instant) -> Option<u64> {
        if self.failed.is_some() {
            self.scene.discard_record();
            return None;
        }
        self.flush();
        let journal = self.journal.as_ref()?;
        let world = self.scene.world();
        let hash = stepped.then(|| world.state_hash());
        if let Some(hash) = hash {
            journal.stepped(world.tick(), hash);
        }
        if journal.wants_checkpoint(now) {
            journal.begin(self.scene.capture(), now);
        }
        hash
    }

    /// Takes a checkpoint now, for its journal.
    pub fn checkpoint_now(&mut self) {
        self.flush();
        if let Some(journal) = &self.journal {
            journal.begin(self.scene.capture(), Instant::now());
        }
    }

    /// One tick of the physics.
    pub(super) fn step_world(&mut self) {
        // Steps requested by a client have no deadline, so they plan in the tick: their result must not depend on the
        // speed of the planning threads.
        let planning = if self.paused {
            Planning::InTick
        } else {
            self.planners.planning()
        };
        if let Some((mark, until)) = &self.step_notes {
            if Instant::now() < *until {
                mark.begin(self.scene.world().tick() + 1);
            } else {
                self.step_notes = None;
            }
        }
        self.scene.step(planning);
        if let Some((mark, _)) = &self.step_notes {
            mark.end();
        }
        let late = self.scene.world().late_plans();
        if late > 0 {
            metrics::counter!("sinew_plans_late_total").increment(late as u64);
            tracing::warn!(
                world = &*self.id,
                late,
                "plans came too late for their tick"
            );
        }
        self.offer_plans();
        let (tick, time) = (self.scene.world().tick(), self.scene.world().time().0);
        let mut events = std::mem::take(&mut self.events);
        for m in self.scene.members() {
            let f = self.scene.figure(m.key);
            events.extend(f.events().iter().map(|e| WorldEvent {
                tick,
                time,
                figure: m.id.clone(),
                kind: engine::event_kind(e, |o| self.scene.name_of(o)),
            }));
        }
        self.events = events;
    }

    /// Hands the plans that figures need to the planning threads. A world that is stepped by hand plans in its ticks.
    pub(super) fn offer_plans(&self) {
        if !self.paused {
            self.planners.offer(self.scene.world().plan_requests());
        }
    }

    fn event(&mut self, figure: &str, kind: EventKind) {
        self.events.push(WorldEvent {
            tick: self.scene.world().tick(),
            time: self.scene.world().time().0,
            figure: figure.to_owned(),
            kind,
        });
    }

    pub(super) fn world_event(&mut self, kind: EventKind) {
        self.event("", kind);
    }

    /// Events since the last call.
    pub(super) fn take_events(&mut self) -> Vec<WorldEvent> {
        self.tell_clips();
        std::mem::take(&mut self.events)
    }

    /// The view of the world now. `hash`: of its state, if known.
    pub fn snapshot(&mut self, hash: Option<u64>) -> Arc<Snapshot> {
        let figures = self.scene.figures();
        let obstacles = self.obstacles();
        let since = SystemTime::now()
            .duration_since(SystemTime::UNIX_EPOCH)
            .unwrap_or_default();
        let snapshot = Arc::new(Snapshot {
            world: self.id.clone(),
            rate_hz: self.scene.settings().rate_hz,
            gravity: self.scene.settings().gravity,
            tick: self.scene.world().tick(),
            time: self.scene.world().time().0,
            hash: hash.unwrap_or_else(|| self.scene.world().state_hash()),
            epoch: self.epoch,
            server_ns: i64::try_from(since.as_nanos()).unwrap_or(i64::MAX),
            roster_version: self.roster_version,
            roster: self.roster.clone(),
            figures,
            obstacles,
        });
        self.changed = false;
        snapshot
    }
}
