//! One world with everything that belongs to its clock: figures by name, drivers, held frames. Owned by the world's thread; others send
//! [`Command`](super::command::Command)s that call these methods between ticks.

use super::clock::Clock;
use super::drives::{Drive, Slot, Window};
use crate::server::engine::{self, Clip, Drive as Motion, FigureKey, ObstacleKey, World};
use crate::sim::body::{Body, State};
use crate::sim::collide::{ObstacleSetup, Other};
use crate::sim::figure::ControlParams;
use crate::sim::figure::loads::MAX_PERTURBATIONS;
use crate::wire::status::Fault;
use crate::wire::types::{
    DriveOpen, EventKind, Feedback, FigureDisturbance, FigureInfo, FigureSettings, FigureUpdate,
    MotionSample, ObstacleInfo, Overrun, Place, Playback, RosterEntry, Snapshot, WorldCondition,
    WorldEvent, WorldInfo, WorldSettings, WorldUpdate,
};
use std::collections::VecDeque;
use std::sync::Arc;
use std::time::{Instant, SystemTime};

/// Limits of one world, from the configuration.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Figures.
    pub figures: u64,
    /// Ticks that are held.
    pub history: usize,
    /// Window of live motion for drivers that do not say, s; 0: none.
    pub window: f64,
}

struct Member {
    id: String,
    key: FigureKey,
    index: i32,
    settings: FigureSettings,
    clip: Option<String>,
}

/// Steps that a client waits for.
pub struct StepRequest {
    /// Ticks left.
    pub left: u32,
    /// Called with the last snapshot, or with what came in between.
    pub done: Box<dyn FnOnce(Result<Arc<Snapshot>, Fault>) + Send>,
    /// True if nobody waits any more.
    pub abandoned: Box<dyn Fn() -> bool + Send>,
}

/// A world and what belongs to its clock.
pub struct Shard {
    id: Arc<str>,
    settings: WorldSettings,
    created: SystemTime,
    limits: Limits,
    world: World,
    members: Vec<Member>,
    obstacles: Vec<(String, ObstacleKey)>,
    next_obstacle: u64,
    next_index: i32,
    roster: Arc<[RosterEntry]>,
    roster_version: i32,
    drives: Vec<Drive>,
    next_driver: u64,
    history: VecDeque<Arc<Snapshot>>,
    events: Vec<WorldEvent>,
    pub(super) clock: Clock,
    pub(super) steps: VecDeque<StepRequest>,
    pub(super) paused: bool,
    pub(super) failed: Option<String>,
    replies: Vec<Box<dyn FnOnce() + Send>>,
    /// What viewers see changed without a tick.
    pub(super) changed: bool,
    pub(super) closing: bool,
}

impl Shard {
    /// A world without figures.
    ///
    /// # Errors
    /// Settings that the physics refuses.
    pub fn new(
        id: Arc<str>,
        settings: WorldSettings,
        paused: bool,
        limits: Limits,
    ) -> Result<Self, Fault> {
        let world = engine::new_world(&settings)?;
        let pace = &settings.pace;
        let clock = Clock::new(settings.rate_hz, pace.speed, pace.overrun, Instant::now());
        Ok(Self {
            id,
            created: SystemTime::now(),
            limits,
            world,
            members: Vec::new(),
            obstacles: Vec::new(),
            next_obstacle: 1,
            next_index: 0,
            roster: Arc::new([]),
            roster_version: 1,
            drives: Vec::new(),
            next_driver: 1,
            history: VecDeque::new(),
            events: Vec::new(),
            clock,
            steps: VecDeque::new(),
            replies: Vec::new(),
            paused,
            failed: None,
            changed: true,
            closing: false,
            settings,
        })
    }

    // ── the world ──

    /// The world as it is now.
    pub fn info(&self) -> WorldInfo {
        WorldInfo {
            id: self.id.to_string(),
            settings: self.settings.clone(),
            condition: match (&self.failed, self.paused) {
                (Some(why), _) => WorldCondition::Failed(why.clone()),
                (None, true) => WorldCondition::Paused,
                (None, false) => WorldCondition::Running,
            },
            tick: self.world.tick(),
            time: self.world.time(),
            figures: self.members.len(),
            epoch: 1,
            created: self.created,
        }
    }

    fn working(&self) -> Result<(), Fault> {
        match &self.failed {
            None => Ok(()),
            Some(why) => Err(Fault::Precondition {
                reason: "WORLD_FAILED",
                message: format!("world {:?} failed: {why}", &*self.id),
                facts: vec![],
            }),
        }
    }

    fn restart_clock(&mut self) {
        let pace = &self.settings.pace;
        self.clock.restart(
            self.settings.rate_hz,
            pace.speed,
            pace.overrun,
            Instant::now(),
        );
    }

    /// Changes pace or name.
    pub fn update(&mut self, u: WorldUpdate) -> Result<WorldInfo, Fault> {
        self.working()?;
        let pace = &mut self.settings.pace;
        let timed = u.overrun.is_some() || u.catch_up_limit.is_some() || u.speed.is_some();
        if let Some(name) = u.display_name {
            pace.display_name = name;
        }
        if let Some(limit) = u.catch_up_limit {
            pace.catch_up_limit = limit;
        }
        if let Some(overrun) = u.overrun {
            pace.overrun = overrun;
        }
        if let Overrun::CatchUp(limit) = &mut pace.overrun {
            *limit = pace.catch_up_limit;
        }
        if let Some(speed) = u.speed {
            pace.speed = speed;
        }
        if timed {
            self.restart_clock();
        }
        Ok(self.info())
    }

    /// Stops the clock.
    pub fn pause(&mut self) -> Result<WorldInfo, Fault> {
        self.working()?;
        if !self.paused {
            self.paused = true;
            self.world_event(EventKind::Paused);
        }
        Ok(self.info())
    }

    /// Starts the clock; steps that someone waits for are given up.
    pub fn resume(&mut self) -> Result<WorldInfo, Fault> {
        self.working()?;
        if self.paused {
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

    /// Answers a command once what it did can be seen by viewers, so that a client sees its own changes.
    pub fn reply(&mut self, answer: impl FnOnce() + Send + 'static) {
        self.replies.push(Box::new(answer));
    }

    pub(super) fn send_replies(&mut self) {
        for answer in self.replies.drain(..) {
            answer();
        }
    }

    /// Ends the world after this round of commands.
    pub fn close(&mut self) {
        self.closing = true;
    }

    // ── figures ──

    fn member(&self, figure: &str) -> Result<usize, Fault> {
        self.members
            .iter()
            .position(|m| m.id == figure)
            .ok_or_else(|| {
                Fault::not_found("figure", format!("worlds/{}/figures/{figure}", self.id))
            })
    }

    /// Checks that figures exist.
    pub fn check_figures(&self, figures: &[String]) -> Result<(), Fault> {
        figures.iter().try_for_each(|f| self.member(f).map(|_| ()))
    }

    fn figure_info(&self, m: &Member) -> FigureInfo {
        let f = self.world.figure(m.key).expect("members are in the world");
        // Of two clips the one that was asked for last is known by name: it plays, or the figure comes to a stand for it.
        let (next_clip, clip) = match f.next_clip() {
            Some(_) => (m.clip.clone(), None),
            None => (None, m.clip.clone()),
        };
        FigureInfo {
            world: self.id.to_string(),
            id: m.id.clone(),
            settings: m.settings.clone(),
            clip,
            next_clip,
            driver: self
                .drives
                .iter()
                .find(|d| d.has(&m.id))
                .map(|d| d.driver.clone()),
            index: m.index,
            constraints: engine::constraints(f, self.world.time()),
        }
    }

    /// One figure.
    pub fn figure(&self, figure: &str) -> Result<FigureInfo, Fault> {
        Ok(self.figure_info(&self.members[self.member(figure)?]))
    }

    /// All figures, in the order of creation.
    pub fn figures(&self) -> Vec<FigureInfo> {
        self.members.iter().map(|m| self.figure_info(m)).collect()
    }

    /// Body of a figure, and its name.
    pub fn body_of(&self, figure: &str) -> Result<(String, Arc<Body>), Fault> {
        let m = &self.members[self.member(figure)?];
        let f = self.world.figure(m.key).expect("members are in the world");
        Ok((m.settings.body.id.clone(), f.body().clone()))
    }

    fn roster_changed(&mut self) {
        self.roster_version += 1;
        self.changed = true;
        self.roster = self
            .members
            .iter()
            .map(|m| RosterEntry {
                index: m.index,
                figure: m.id.clone(),
                body: m.settings.body.id.clone(),
            })
            .collect();
    }

    /// Adds a figure.
    pub fn create_figure(
        &mut self,
        id: Option<String>,
        settings: FigureSettings,
        body: Arc<Body>,
    ) -> Result<FigureInfo, Fault> {
        self.working()?;
        if self.members.len() as u64 >= self.limits.figures {
            return Err(Fault::Exhausted {
                limit: "max_figures_per_world",
                value: self.limits.figures,
                message: format!("one more figure in world {:?}", &*self.id),
                retry: None,
            });
        }
        let id = match id {
            Some(id) if self.member(&id).is_ok() => {
                return Err(Fault::Exists {
                    kind: "figure",
                    name: format!("worlds/{}/figures/{id}", self.id),
                });
            }
            Some(id) => id,
            None => (self.next_index + 1..)
                .map(|n| format!("figure-{n}"))
                .find(|id| self.member(id).is_err())
                .expect("there is a free number"),
        };
        let key = engine::add_figure(&mut self.world, &id, &settings, body)?;
        self.members.push(Member {
            id: id.clone(),
            key,
            index: self.next_index,
            settings,
            clip: None,
        });
        self.next_index += 1;
        self.roster_changed();
        self.event(&id, EventKind::FigureAdded);
        self.figure(&id)
    }

    /// Changes strength, controller or name.
    pub fn update_figure(&mut self, figure: &str, u: FigureUpdate) -> Result<FigureInfo, Fault> {
        self.working()?;
        let i = self.member(figure)?;
        let m = &mut self.members[i];
        if let Some(all) = &u.constraints {
            engine::set_constraints(&mut self.world, m.key, all)?;
        }
        let steps = u.protective_steps;
        if u.controller.is_some() || u.strength.is_some() || u.params.is_some() || steps.is_some() {
            let controller = u.controller.unwrap_or(m.settings.controller);
            let strength = u.strength.unwrap_or_else(|| m.settings.strength.clone());
            // Whether it steps is no choice of the paper's controller.
            let params = ControlParams {
                protective_steps: steps.unwrap_or(m.settings.params.protective_steps),
                ..u.params.unwrap_or_else(|| m.settings.params.clone())
            };
            let world = &mut self.world;
            engine::retune(world, m.key, strength.clone(), controller, params.clone())?;
            m.settings.controller = controller;
            m.settings.params = params;
            m.settings.strength = strength;
        }
        if u.fatigue_time_scale.is_some() || u.assist.is_some() {
            let mut options = m.settings.options;
            options.fatigue_time_scale = u.fatigue_time_scale.unwrap_or(options.fatigue_time_scale);
            options.assist = u.assist.unwrap_or(options.assist);
            engine::set_options(&mut self.world, m.key, options)?;
            m.settings.options = options;
        }
        if let Some(name) = u.display_name {
            m.settings.display_name = name;
        }
        self.figure(figure)
    }

    /// Removes a figure.
    pub fn delete_figure(&mut self, figure: &str) -> Result<(), Fault> {
        let i = self.member(figure)?;
        let m = self.members.remove(i);
        self.world.remove_figure(m.key);
        for drive in &mut self.drives {
            for slot in &mut drive.slots {
                if slot.key == Some(m.key) {
                    slot.key = None;
                }
            }
        }
        self.drives
            .retain(|d| d.slots.iter().any(|s| s.key.is_some()));
        self.roster_changed();
        self.event(figure, EventKind::FigureRemoved);
        Ok(())
    }

    /// Puts a figure back to standing still, without loads.
    pub fn reset_figure(
        &mut self,
        figure: &str,
        place: Option<Place>,
    ) -> Result<FigureInfo, Fault> {
        self.working()?;
        let i = self.member(figure)?;
        self.not_driven(figure)?;
        let m = &mut self.members[i];
        let f = self
            .world
            .figure_mut(m.key)
            .expect("members are in the world");
        let posture = engine::standing(f.body(), place.unwrap_or(m.settings.place));
        f.clear_perturbations();
        f.clear_constraints();
        f.set_drive(Motion::Hold(posture));
        let state = State::at_rest(posture);
        engine::reset(&mut self.world, m.key, state)?;
        m.clip = None;
        self.changed = true;
        self.figure(figure)
    }

    // ── obstacles ──

    fn obstacle(&self, id: &str) -> Result<usize, Fault> {
        let found = self.obstacles.iter().position(|(o, _)| o == id);
        found.ok_or_else(|| {
            Fault::not_found("obstacle", format!("worlds/{}/obstacles/{id}", self.id))
        })
    }

    fn obstacle_info(&self, (id, key): &(String, ObstacleKey)) -> ObstacleInfo {
        let o = self.world.obstacle(*key).expect("it is in the world");
        ObstacleInfo {
            id: id.clone(),
            setup: o.setup().clone(),
            force: o.force(),
        }
    }

    /// All obstacles, in the order they were added.
    pub fn obstacles(&self) -> Vec<ObstacleInfo> {
        let all = self.obstacles.iter();
        all.map(|o| self.obstacle_info(o)).collect()
    }

    /// Adds an obstacle.
    pub fn add_obstacle(
        &mut self,
        id: Option<String>,
        setup: ObstacleSetup,
    ) -> Result<ObstacleInfo, Fault> {
        self.working()?;
        let id = match id {
            Some(id) if self.obstacle(&id).is_ok() => {
                return Err(Fault::Exists {
                    kind: "obstacle",
                    name: format!("worlds/{}/obstacles/{id}", self.id),
                });
            }
            Some(id) => id,
            None => (self.next_obstacle..)
                .map(|n| format!("obstacle-{n}"))
                .find(|id| self.obstacle(id).is_err())
                .expect("there is a free number"),
        };
        let key = engine::add_obstacle(&mut self.world, setup)?;
        self.next_obstacle += 1;
        self.obstacles.push((id.clone(), key));
        self.changed = true;
        self.world_event(EventKind::ObstacleAdded(format!("obstacles/{id}")));
        Ok(self.obstacle_info(&(id, key)))
    }

    /// Replaces an obstacle.
    pub fn update_obstacle(
        &mut self,
        id: &str,
        setup: ObstacleSetup,
    ) -> Result<ObstacleInfo, Fault> {
        self.working()?;
        let i = self.obstacle(id)?;
        engine::update_obstacle(&mut self.world, self.obstacles[i].1, setup)?;
        self.changed = true;
        Ok(self.obstacle_info(&self.obstacles[i]))
    }

    /// Removes an obstacle.
    pub fn remove_obstacle(&mut self, id: &str) -> Result<(), Fault> {
        self.working()?;
        let i = self.obstacle(id)?;
        let (_, key) = self.obstacles.remove(i);
        self.world.remove_obstacle(key);
        self.changed = true;
        self.world_event(EventKind::ObstacleRemoved(format!("obstacles/{id}")));
        Ok(())
    }

    /// What a figure touches, as it is called outside; empty for something that has gone.
    fn name_of(&self, other: Other) -> String {
        match other {
            Other::Figure(key, _) => {
                let m = self.members.iter().find(|m| m.key.0 == key);
                m.map_or_else(String::new, |m| format!("figures/{}", m.id))
            }
            Other::Obstacle(key) => {
                let o = self.obstacles.iter().find(|(_, k)| *k == key);
                o.map_or_else(String::new, |(id, _)| format!("obstacles/{id}"))
            }
        }
    }

    // ── perturbations ──

    /// Applies a batch, all or nothing. Returns the tick at whose start it acts.
    pub fn perturb(&mut self, batch: &[FigureDisturbance]) -> Result<u64, Fault> {
        self.working()?;
        let tick = self.world.tick();
        let now = self.world.time();
        let dt = self.world.dt();
        let mut plan = Vec::with_capacity(batch.len());
        for (n, d) in batch.iter().enumerate() {
            let i = self.member(&d.figure)?;
            let from = match d.tick {
                None => now,
                Some(at) if at < tick as i64 => {
                    return Err(Fault::invalid(
                        format!("perturbations[{n}].tick"),
                        format!("must be at least {tick}, the next tick, got {at}"),
                    ));
                }
                // A year of ticks ahead is a mistake, and time must stay exact.
                Some(at) if at - tick as i64 > 31_536_000_000 => {
                    return Err(Fault::invalid(
                        format!("perturbations[{n}].tick"),
                        format!("is too far ahead of {tick}, the next tick"),
                    ));
                }
                Some(at) => at as f64 * dt,
            };
            let f = self
                .world
                .figure(self.members[i].key)
                .expect("members are in the world");
            let planned = plan.iter().filter(|(j, _)| *j == i).count();
            if planned >= engine::perturbation_room(f) {
                return Err(Fault::Exhausted {
                    limit: "max_perturbations_per_figure",
                    value: MAX_PERTURBATIONS as u64,
                    message: format!("one more perturbation of figure {:?}", d.figure),
                    retry: None,
                });
            }
            plan.push((i, engine::perturbation(f.body(), &d.what, from)));
        }
        for (i, p) in plan {
            engine::perturb(&mut self.world, self.members[i].key, p)?;
        }
        Ok(tick)
    }

    /// Takes all loads and forces off a figure. Returns the tick at whose start it acts.
    pub fn clear_perturbations(&mut self, figure: &str) -> Result<u64, Fault> {
        self.working()?;
        let i = self.member(figure)?;
        self.world
            .figure_mut(self.members[i].key)
            .expect("members are in the world")
            .clear_perturbations();
        Ok(self.world.tick())
    }

    // ── desired motion ──

    fn not_driven(&self, figure: &str) -> Result<(), Fault> {
        match self.drives.iter().find(|d| d.has(figure)) {
            Some(d) => Err(d.controlled(figure, Instant::now())),
            None => Ok(()),
        }
    }

    /// Lets a figure play a clip. Returns the world time of its start.
    pub fn play(
        &mut self,
        figure: &str,
        clip_id: &str,
        clip: Arc<Clip>,
        p: Playback,
    ) -> Result<f64, Fault> {
        self.working()?;
        let i = self.member(figure)?;
        self.not_driven(figure)?;
        let now = self.world.time();
        let begin = p.start.unwrap_or(now);
        let m = &mut self.members[i];
        let f = self
            .world
            .figure_mut(m.key)
            .expect("members are in the world");
        let place = p
            .place
            .unwrap_or_else(|| engine::place_of(&f.state().posture));
        let state = engine::first_state(&clip, place);
        // A figure that is put into the clip is in motion at once; one that stands comes into it by the clip's lead-in, and one that moves
        // comes to a stand before that.
        let playback = engine::playback(clip, begin, p.speed, p.looped, (place, !p.reset));
        let mut start = playback.start;
        if p.reset {
            f.set_drive(Motion::Clip(playback));
            engine::reset(&mut self.world, m.key, state)?;
            self.changed = true;
        } else {
            start = f.play(playback, p.place.is_some(), now);
        }
        m.clip = Some(clip_id.to_owned());
        Ok(start)
    }

    fn hold(&mut self, figure: &str) {
        let Ok(i) = self.member(figure) else { return };
        let time = self.world.time();
        let m = &mut self.members[i];
        m.clip = None;
        if let Some(f) = self.world.figure_mut(m.key) {
            // It finishes its step and stands.
            f.stop(time);
        }
    }

    /// Lets a figure finish its step and stand, or hold the posture that is asked of it now if it stands already.
    pub fn stop(&mut self, figure: &str) -> Result<(), Fault> {
        self.working()?;
        self.member(figure)?;
        self.not_driven(figure)?;
        self.hold(figure);
        Ok(())
    }

    /// Begins or takes up a drive. `connection` is the stream that will send; `None` for a push. Returns who drives.
    pub fn open_drive(
        &mut self,
        open: &DriveOpen,
        connection: Option<u64>,
    ) -> Result<String, Fault> {
        self.working()?;
        self.check_figures(&open.figures)?;
        let now = Instant::now();
        let driver = match (open.driver.as_str(), connection) {
            ("", None) => "push".to_owned(),
            ("", Some(_)) => loop {
                let name = format!("driver-{}", self.next_driver);
                self.next_driver += 1;
                if self.drives.iter().all(|d| d.driver != name) {
                    break name;
                }
            },
            (name, _) => name.to_owned(),
        };
        for figure in &open.figures {
            if let Some(other) = self
                .drives
                .iter()
                .find(|d| d.driver != driver && d.has(figure))
            {
                return Err(other.controlled(figure, now));
            }
        }
        if let Some(d) = self.drives.iter_mut().find(|d| d.driver == driver) {
            if d.drives(&open.figures) {
                d.touch(connection, now); // the same driver comes back: its motion goes on
                return Ok(driver);
            }
            self.end_drive(&driver, "drives other figures now");
        }
        let mut slots = Vec::with_capacity(open.figures.len());
        for figure in &open.figures {
            self.hold(figure);
            let key = self.members[self.member(figure)?].key;
            let f = self.world.figure(key).expect("members are in the world");
            let stand = engine::standing(f.body(), Place::default());
            let length = open.settings.window.unwrap_or(self.limits.window);
            let window = (length > 0.0).then(|| Window::new(f.body(), length));
            slots.push(Slot {
                figure: figure.clone(),
                key: Some(key),
                body: f.body().clone(),
                window,
                buffer: crate::server::ingest::jitter_buffer::JitterBuffer::new(
                    open.settings.clone(),
                    self.world.dt(),
                    f.target().next.clone(),
                    stand,
                ),
            });
        }
        if !open.settings.reset {
            for slot in &mut slots {
                let f = slot.key.and_then(|k| self.world.figure(k));
                if let (Some(f), Some(window)) = (f, &mut slot.window) {
                    window.lead_in(&f.target().next.posture);
                }
            }
        }
        self.drives.push(Drive::new(
            driver.clone(),
            connection,
            open.settings.clone(),
            slots,
            now,
        ));
        for figure in &open.figures {
            self.event(figure, EventKind::DriveBegan(driver.clone()));
        }
        Ok(driver)
    }

    /// Takes a batch of a driver. `connection` must be the stream that drives; a push has none.
    pub fn drive(
        &mut self,
        driver: &str,
        connection: Option<u64>,
        batch: Vec<MotionSample>,
    ) -> Result<bool, Fault> {
        self.working()?;
        let time = self.world.time();
        let d = self
            .drives
            .iter_mut()
            .find(|d| d.driver == driver)
            .filter(|d| connection.is_none() || d.connection == connection)
            .ok_or_else(|| Fault::Aborted {
                reason: "CONTROL_FENCED",
                message: format!("{driver:?} has given up its figures or drives by another stream"),
            })?;
        Ok(d.take(batch, time, Instant::now()))
    }

    /// Notes batches that did not find room in the queue.
    pub fn refused(&mut self, driver: &str, batches: u64) {
        if let Some(d) = self.drives.iter_mut().find(|d| d.driver == driver) {
            d.refused += batches;
        }
    }

    /// What a driver is told.
    pub fn feedback(&self, driver: &str, connection: Option<u64>) -> Result<Feedback, Fault> {
        self.drives
            .iter()
            .find(|d| d.driver == driver && (connection.is_none() || d.connection == connection))
            .map(|d| d.feedback(self.world.tick()))
            .ok_or_else(|| Fault::Aborted {
                reason: "CONTROL_FENCED",
                message: format!("{driver:?} has given up its figures or drives by another stream"),
            })
    }

    /// A stream ended: `kept` if it was lost and the driver may come back.
    pub fn close_drive(&mut self, driver: &str, connection: u64, kept: bool) {
        let Some(d) = self
            .drives
            .iter_mut()
            .find(|d| d.driver == driver && d.connection == Some(connection))
        else {
            return; // someone with this name has taken over
        };
        if kept {
            d.lost(Instant::now());
        } else {
            self.end_drive(driver, "given back");
        }
    }

    fn end_drive(&mut self, driver: &str, why: &str) {
        let Some(i) = self.drives.iter().position(|d| d.driver == driver) else {
            return;
        };
        let drive = self.drives.remove(i);
        for slot in drive.slots.iter().filter(|s| s.key.is_some()) {
            self.hold(&slot.figure);
            self.event(
                &slot.figure,
                EventKind::DriveEnded(format!("{driver}: {why}")),
            );
        }
    }

    /// Gives up the figures of drivers that did not come back.
    pub(super) fn expire_drives(&mut self, now: Instant) {
        while let Some(driver) = self
            .drives
            .iter()
            .find(|d| d.expires.is_some_and(|at| at <= now))
            .map(|d| d.driver.clone())
        {
            self.end_drive(&driver, "its time is over");
        }
    }

    /// Hands the desired motion of this tick to driven figures.
    pub(super) fn sample_motion(&mut self) {
        let time = self.world.time();
        for drive in &mut self.drives {
            for slot in &mut drive.slots {
                let Some(key) = slot.key else { continue };
                if slot.window.is_some() {
                    let Some(f) = self.world.figure_mut(key) else {
                        continue;
                    };
                    if let Some(state) = slot.feed(time, f, drive.settings.reset) {
                        let _ = engine::reset(&mut self.world, key, state);
                    }
                    continue;
                }
                let Some((pair, reset)) = slot.sample(time) else {
                    continue;
                };
                if reset {
                    let state = pair.now.state();
                    // What came over the wire was checked there, so there is nothing left to refuse.
                    let _ = engine::reset(&mut self.world, key, state);
                }
                if let Some(f) = self.world.figure_mut(key) {
                    f.set_drive(Motion::External(Box::new(pair)));
                }
            }
        }
    }

    // ── the tick ──

    /// One tick of the physics.
    pub(super) fn step_world(&mut self) {
        self.world.step();
        let (tick, time) = (self.world.tick(), self.world.time());
        let mut events = std::mem::take(&mut self.events);
        for m in &self.members {
            let f = self.world.figure(m.key).expect("members are in the world");
            events.extend(f.events().iter().map(|e| WorldEvent {
                tick,
                time,
                figure: m.id.clone(),
                kind: engine::event_kind(e, |o| self.name_of(o)),
            }));
        }
        self.events = events;
    }

    fn event(&mut self, figure: &str, kind: EventKind) {
        self.events.push(WorldEvent {
            tick: self.world.tick(),
            time: self.world.time(),
            figure: figure.to_owned(),
            kind,
        });
    }

    pub(super) fn world_event(&mut self, kind: EventKind) {
        self.event("", kind);
    }

    /// Events since the last call.
    pub(super) fn take_events(&mut self) -> Vec<WorldEvent> {
        std::mem::take(&mut self.events)
    }

    /// What the world looks like now; held for late readers.
    pub fn snapshot(&mut self) -> Arc<Snapshot> {
        // When the last tick began, which is what its report is about.
        let start = self.world.tick().saturating_sub(1) as f64 * self.world.dt();
        let applied = |key: FigureKey| {
            self.drives
                .iter()
                .flat_map(|d| &d.slots)
                .find(|s| s.key == Some(key))
                .and_then(Slot::applied)
                .unwrap_or((-1, 0))
        };
        let figures = self
            .members
            .iter()
            .map(|m| {
                let f = self.world.figure(m.key).expect("members are in the world");
                let mut shown = engine::snapshot(f, start, self.world.dt(), applied(m.key));
                if let Some(r) = &shown.report {
                    shown.touched = r.touches.iter().map(|t| self.name_of(t.other)).collect();
                }
                shown
            })
            .collect();
        let obstacles = self.obstacles();
        let since = SystemTime::now()
            .duration_since(SystemTime::UNIX_EPOCH)
            .unwrap_or_default();
        let snapshot = Arc::new(Snapshot {
            world: self.id.clone(),
            rate_hz: self.settings.rate_hz,
            gravity: self.settings.gravity,
            tick: self.world.tick(),
            time: self.world.time(),
            hash: self.world.state_hash(),
            epoch: 1,
            server_ns: i64::try_from(since.as_nanos()).unwrap_or(i64::MAX),
            roster_version: self.roster_version,
            roster: self.roster.clone(),
            figures,
            obstacles,
        });
        if self.history.back().is_some_and(|s| s.tick == snapshot.tick) {
            self.history.pop_back(); // the roster changed between ticks
        }
        self.history.push_back(snapshot.clone());
        while self.history.len() > self.limits.history {
            self.history.pop_front();
        }
        self.changed = false;
        snapshot
    }

    fn expired(&self, asked: i64) -> Fault {
        let tick = |s: Option<&Arc<Snapshot>>| s.map_or(-1, |s| s.tick as i64);
        Fault::Expired {
            asked,
            oldest: tick(self.history.front()),
            newest: tick(self.history.back()),
        }
    }

    /// The held frame of one tick.
    pub fn held(&self, tick: i64) -> Result<Arc<Snapshot>, Fault> {
        self.history
            .iter()
            .find(|s| s.tick as i64 == tick)
            .cloned()
            .ok_or_else(|| self.expired(tick))
    }

    /// The held frames after one tick.
    pub fn held_after(&self, tick: i64) -> Result<Vec<Arc<Snapshot>>, Fault> {
        let newest = self.history.back().map_or(-1, |s| s.tick as i64);
        let oldest = self.history.front().map_or(0, |s| s.tick as i64);
        // Resuming after the newest is fine (nothing was missed); beyond it, or with a gap, is not.
        if tick > newest || tick.saturating_add(1) < oldest {
            return Err(self.expired(tick.saturating_add(1)));
        }
        Ok(self
            .history
            .iter()
            .filter(|s| s.tick as i64 > tick)
            .cloned()
            .collect())
    }
}
