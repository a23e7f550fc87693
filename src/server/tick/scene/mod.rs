//! The part of a world that replays identically: physics, figures and obstacles by name, players of live motion.
//! Clocks, connections, leases and permissions are outside (`hosted_world`).
//!
//! A scene is changed by [`Scene::apply`], by frames that arrive ([`Scene::take_frame`]) and by ticks
//! ([`Scene::sample`], [`Scene::step`]). Each of them notes its changes in a record. An earlier scene that is put
//! through the same records has the same states, bit for bit (`replay`).

mod input;
mod motion;
mod player;
mod record;
mod saved;
mod shown;

pub use input::{InputResult, PlayerKey, SceneInput};
pub use player::{Player, PlayoutWindow};
pub use record::{RecordItem, RecordReader, RoundRecord, Unreadable};
pub use saved::SavedScene;

use crate::engine::{self, FigureKey, Motion, ObstacleKey, Planning, World};
use crate::ingest::jitter_buffer::{BufferedFrame, Now, Resync};
use crate::ingest::time::ScheduledTime;
use record::RecordWriter;
use serde::{Deserialize, Serialize};
use sinew_physics::body::{Body, State};
use sinew_physics::figure::{ControlParams, LatePlans, Perturbation};
use sinew_physics::setup::MAX_PERTURBATIONS;
use sinew_wire::status::Fault;
use sinew_wire::types::{FigureDisturbance, FigureSettings, FigureUpdate, Place, WorldSettings};
use std::sync::Arc;
use std::time::Instant;

/// A figure with everything known about it besides its physics.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Member {
    /// Last part of its name.
    pub id: String,
    /// The figure.
    pub key: FigureKey,
    /// Index in frames.
    pub index: i32,
    /// Settings.
    pub settings: FigureSettings,
    /// Last part of the name of the most recently requested clip.
    pub clip: Option<String>,
}

/// A world that can be replayed.
#[derive(Debug)]
pub struct Scene {
    world: World,
    settings: WorldSettings,
    members: Vec<Member>,
    obstacles: Vec<(String, ObstacleKey)>,
    next_obstacle: u64,
    next_index: i32,
    players: Vec<Player>,
    next_player: PlayerKey,
    record: RecordWriter,
}

impl Scene {
    /// An empty world.
    ///
    /// # Errors
    /// Settings that the physics refuses.
    pub fn new(settings: WorldSettings) -> Result<Self, Fault> {
        Ok(Self {
            world: engine::new_world(&settings)?,
            settings,
            members: Vec::new(),
            obstacles: Vec::new(),
            next_obstacle: 1,
            next_index: 0,
            players: Vec::new(),
            next_player: 1,
            record: RecordWriter::default(),
        })
    }

    /// Its physics.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Its settings.
    pub fn settings(&self) -> &WorldSettings {
        &self.settings
    }

    /// Its figures, in the order of creation.
    pub fn members(&self) -> &[Member] {
        &self.members
    }

    /// Its obstacles, in the order in which they were added.
    pub fn obstacles(&self) -> &[(String, ObstacleKey)] {
        &self.obstacles
    }

    /// Index of the next figure.
    pub fn next_index(&self) -> i32 {
        self.next_index
    }

    /// The player of live motion.
    pub fn player(&self, key: PlayerKey) -> Option<&Player> {
        self.players.iter().find(|p| p.key == key)
    }

    /// All players of live motion.
    pub fn players(&self) -> &[Player] {
        &self.players
    }

    /// The physics of a member.
    pub fn figure(&self, key: FigureKey) -> &engine::Figure {
        self.world.figure(key).expect("members are in the world")
    }

    fn figure_mut(&mut self, key: FigureKey) -> Result<&mut engine::Figure, Fault> {
        let found = self.world.figure_mut(key);
        found.ok_or_else(|| Fault::Internal(format!("there is no figure {}", key.0)))
    }

    fn member_mut(&mut self, key: FigureKey) -> Result<&mut Member, Fault> {
        let found = self.members.iter_mut().find(|m| m.key == key);
        found.ok_or_else(|| Fault::Internal(format!("there is no figure {}", key.0)))
    }

    /// Writes records from now on.
    pub fn keep_records(&mut self) {
        self.record.turn_on();
    }

    /// The changes since the last call.
    pub fn take_record(&mut self) -> Option<RoundRecord> {
        self.record.take()
    }

    /// Forgets the changes since the last call of [`Self::take_record`], because the round did not finish.
    pub fn discard_record(&mut self) {
        self.record.discard();
    }

    /// Number of records until now.
    pub fn seq(&self) -> u64 {
        self.record.seq()
    }

    /// Notes that a record has been replayed.
    pub(super) fn passed(&mut self, seq: u64) {
        self.record.passed(seq);
    }

    /// Changes the world. This is the only place that does so, whatever the source of the change.
    ///
    /// # Errors
    /// The physics refuses the input, named by its place in the request.
    pub fn apply(&mut self, input: SceneInput) -> Result<InputResult, Fault> {
        // These are checked before anything changes. Refused requests cost nothing to send, so recording them would
        // fill the past.
        let checked = matches!(
            input,
            SceneInput::Perturb(_)
                | SceneInput::AddObstacle { .. }
                | SceneInput::UpdateObstacle(..)
        );
        let mark = self.record.mark();
        self.record.input(self.world.tick(), &input);
        let done = self.carry_out(input);
        if done.is_err() && checked {
            self.record.retract(mark);
        }
        done
    }

    fn carry_out(&mut self, input: SceneInput) -> Result<InputResult, Fault> {
        match input {
            SceneInput::Pace(pace) => {
                self.settings.pace = pace;
                Ok(InputResult::Changed)
            }
            SceneInput::AddFigure { id, settings, body } => self.add_figure(id, *settings, body),
            SceneInput::RemoveFigure(key) => {
                self.members.retain(|m| m.key != key);
                self.players.retain(|p| p.figure != key);
                self.world.remove_figure(key);
                Ok(InputResult::Changed)
            }
            SceneInput::UpdateFigure(key, update) => self.update_figure(key, *update),
            SceneInput::ResetFigure(key, place) => self.reset_figure(key, place),
            SceneInput::Play {
                figure,
                name,
                clip,
                rehearsed,
                playback,
            } => self.play(figure, name, (clip, rehearsed), playback),
            SceneInput::Stop(key) => {
                self.member_mut(key)?.clip = None;
                let time = self.world.time();
                // It finishes its step and stands.
                self.figure_mut(key)?.stop(time);
                Ok(InputResult::Changed)
            }
            SceneInput::Perturb(batch) => self.perturb(&batch),
            SceneInput::ClearPerturbations(key) => {
                self.figure_mut(key)?.clear_perturbations();
                Ok(InputResult::Changed)
            }
            SceneInput::AddObstacle { id, setup } => {
                let key = engine::add_obstacle(&mut self.world, setup)?;
                self.next_obstacle += 1;
                self.obstacles.push((id.clone(), key));
                Ok(InputResult::Obstacle(id, key))
            }
            SceneInput::UpdateObstacle(key, setup) => {
                engine::update_obstacle(&mut self.world, key, setup)?;
                Ok(InputResult::Changed)
            }
            SceneInput::RemoveObstacle(key) => {
                self.obstacles.retain(|(_, k)| *k != key);
                self.world.remove_obstacle(key);
                Ok(InputResult::Changed)
            }
            SceneInput::Follow {
                figure,
                settings,
                window,
                takeover,
            } => self.follow(figure, settings, window, takeover),
            SceneInput::Unfollow(key) => {
                self.players.retain(|p| p.key != key);
                Ok(InputResult::Changed)
            }
        }
    }

    /// A name for a new obstacle.
    pub fn free_obstacle(&self) -> String {
        (self.next_obstacle..)
            .map(|n| format!("obstacle-{n}"))
            .find(|id| self.obstacles.iter().all(|(o, _)| o != id))
            .expect("there is a free number")
    }

    fn add_figure(
        &mut self,
        id: String,
        settings: FigureSettings,
        body: Option<Arc<Body>>,
    ) -> Result<InputResult, Fault> {
        let same = |m: &&Member| m.settings.body == settings.body;
        let known = || self.members.iter().find(same).map(|m| m.key);
        let body = match body.or_else(|| Some(Arc::clone(self.figure(known()?).body()))) {
            Some(body) => body,
            None => Arc::new(engine::build_body(settings.body.profile)?),
        };
        let key = engine::add_figure(&mut self.world, &id, &settings, body)?;
        self.members.push(Member {
            id,
            key,
            index: self.next_index,
            settings,
            clip: None,
        });
        self.next_index += 1;
        Ok(InputResult::Figure(key))
    }

    fn update_figure(&mut self, key: FigureKey, u: FigureUpdate) -> Result<InputResult, Fault> {
        if let Some(all) = &u.constraints {
            engine::set_constraints(&mut self.world, key, all)?;
        }
        let steps = u.protective_steps;
        let found = self.members.iter_mut().find(|m| m.key == key);
        let m = found.ok_or_else(|| Fault::Internal(format!("there is no figure {}", key.0)))?;
        let options = u.options(&m.settings);
        m.settings.follow = m.settings.follow.changed(u.follow);
        if u.controller.is_some() || u.strength.is_some() || u.params.is_some() || steps.is_some() {
            let controller = u.controller.unwrap_or(m.settings.controller);
            let strength = u.strength.unwrap_or_else(|| m.settings.strength.clone());
            // The paper's controller has no choice of stepping.
            let params = ControlParams {
                protective_steps: steps.unwrap_or(m.settings.params.protective_steps),
                ..u.params.unwrap_or_else(|| m.settings.params.clone())
            };
            let world = &mut self.world;
            engine::retune(world, key, strength.clone(), controller, params.clone())?;
            m.settings.controller = controller;
            m.settings.params = params;
            m.settings.strength = strength;
        }
        if options != m.settings.options {
            engine::set_options(&mut self.world, key, options)?;
            m.settings.options = options;
        }
        if let Some(name) = u.display_name {
            m.settings.display_name = name;
        }
        Ok(InputResult::Changed)
    }

    fn reset_figure(&mut self, key: FigureKey, place: Option<Place>) -> Result<InputResult, Fault> {
        let place = place.unwrap_or(self.member_mut(key)?.settings.place);
        let f = self.figure_mut(key)?;
        let posture = engine::standing(f.body(), place);
        f.clear_perturbations();
        f.clear_constraints();
        f.set_drive(Motion::Hold(posture));
        engine::reset(&mut self.world, key, State::at_rest(posture))?;
        self.member_mut(key)?.clip = None;
        Ok(InputResult::Changed)
    }

    /// The result that a batch would have.
    ///
    /// # Errors
    /// It would be refused.
    pub fn would_perturb(
        &self,
        batch: &[FigureDisturbance],
    ) -> Result<Vec<(FigureKey, Perturbation)>, Fault> {
        let (tick, now, dt) = (self.world.tick(), self.world.time().0, self.world.dt());
        let mut plan: Vec<(FigureKey, Perturbation)> = Vec::with_capacity(batch.len());
        for (n, d) in batch.iter().enumerate() {
            let found = self.members.iter().find(|m| m.id == d.figure);
            let key = found.map(|m| m.key);
            let key = key.ok_or_else(|| Fault::not_found("figure", d.figure.clone()))?;
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
            let f = self.figure(key);
            let planned = plan.iter().filter(|(k, _)| *k == key).count();
            if planned >= engine::perturbation_room(f) {
                return Err(Fault::Exhausted {
                    limit: "max_perturbations_per_figure",
                    value: MAX_PERTURBATIONS as u64,
                    message: format!("one more perturbation of figure {:?}", d.figure),
                    retry: None,
                });
            }
            let p = engine::perturbation(f.body(), &d.what, from);
            let before = plan.iter().filter(|(k, _)| *k == key).map(|(_, p)| p);
            engine::check_beside(
                &format!("perturbations[{n}]"),
                &p,
                f.perturbations().chain(before),
            )?;
            plan.push((key, p));
        }
        Ok(plan)
    }

    /// Applies a batch, all or nothing.
    fn perturb(&mut self, batch: &[FigureDisturbance]) -> Result<InputResult, Fault> {
        for (key, p) in self.would_perturb(batch)? {
            engine::perturb(&mut self.world, key, p)?;
        }
        Ok(InputResult::Changed)
    }

    // ── live motion and ticks ──

    /// Takes a frame for a player that arrived at scheduled time `at`. Returns whether its stream restarts with it.
    pub fn take_frame(&mut self, key: PlayerKey, frame: BufferedFrame, at: ScheduledTime) -> bool {
        self.record.frame(self.world.tick(), key, &frame, at);
        let player = self.players.iter_mut().find(|p| p.key == key);
        player.is_some_and(|p| p.buffer.push(frame, at))
    }

    /// Why the stream of a player restarted since the last call, if it did.
    pub fn take_notice(&mut self, key: PlayerKey) -> Option<Resync> {
        let player = self.players.iter_mut().find(|p| p.key == key);
        player?.buffer.take_notice()
    }

    /// Arrival times of the frames in use, once for each: their effect has been published.
    pub fn take_shown(&mut self) -> impl Iterator<Item = Instant> + '_ {
        self.players
            .iter_mut()
            .filter_map(|p| p.buffer.take_shown())
    }

    /// Hands the desired motion of the next tick to figures with players. The clock has skipped `lost` seconds of world
    /// time until now. Returns players that have ended because others have taken over.
    pub fn sample(&mut self, lost: f64) -> Vec<PlayerKey> {
        if self.players.is_empty() {
            return Vec::new();
        }
        self.record.sampled(self.world.tick(), lost);
        let now = Now {
            time: self.world.time(),
            lost,
        };
        let ended = self.take_over(now);
        self.play_live(now);
        ended
    }

    /// One tick of the physics.
    pub fn step(&mut self, planning: Planning) {
        let tick = self.world.tick();
        self.world.set_planning(planning);
        self.world.step();
        for (key, late) in self.world.late_plans_of_figures() {
            self.record.late(tick, key, late);
        }
    }

    /// Makes the next tick do without these plans of a figure.
    pub(super) fn delay_plans(&mut self, key: FigureKey, late: LatePlans) {
        self.world.delay_plans(key, late);
    }

    /// Steps with this number of threads from now on. The result does not depend on it.
    pub fn set_threads(&mut self, threads: usize) {
        self.world.set_threads(threads);
    }

    /// Makes the physics lose a figure that is still shown, which breaks the world.
    #[cfg(test)]
    pub(super) fn forget_in_physics(&mut self, key: FigureKey) {
        self.world.remove_figure(key);
    }
}

#[cfg(test)]
mod tests;
