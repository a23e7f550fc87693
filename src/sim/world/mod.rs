//! A shared scene: a clock and figures on one ground. The physics of one tick is [`World::step`].

pub mod checkpoint;
mod collisions;
mod validate;

pub use collisions::CollisionReport;

pub use crate::figure::{
    ClipPlayback, Figure, FigureEvent, FigureKey, FigureSetup, LivePlayback, MotionSource,
    RehearsedMotion, RehearsedPlayback,
};

use crate::body::State;
use crate::collide::{MAX_OBSTACLES, Obstacle, ObstacleKey, ObstacleSetup};
use crate::figure::{
    Constraint, ControlParams, ControllerKind, FigureOptions, LatePlans, MAX_CONSTRAINTS,
    Perturbation, PlanRequest, StrengthScale, WorkspaceSlot,
};
use crate::math::hash::Fnv;
use crate::motion::GRAVITY;
use crate::setup::MAX_PERTURBATIONS;
use crate::tick_context::{Planning, TickContext};
use crate::time::WorldTime;
use serde::{Deserialize, Serialize};
use std::cell::RefCell;

/// Fixed properties of a world.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldParams {
    /// Ticks per second, 10…1000.
    pub rate_hz: f64,
    /// Substeps of torque simulation per tick, 1…16.
    pub substeps: u32,
    /// Magnitude of gravity along −z, m/s², 0…30.
    pub gravity: f64,
    /// Coulomb friction coefficient of the ground, 0.05…2.
    pub friction: f64,
    /// Threads that step the figures, 1…64. The result does not depend on it.
    pub threads: usize,
    /// Whether figures and obstacles collide. If not, figures touch only the ground.
    pub collisions: bool,
}

impl Default for WorldParams {
    fn default() -> Self {
        Self {
            rate_hz: 60.0,
            substeps: 2,
            gravity: GRAVITY,
            friction: 0.9,
            threads: 1,
            collisions: true,
        }
    }
}

/// Reason why a world refuses a request. The world is unchanged.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WorldError {
    /// A number is outside its range or not finite.
    #[error("{field} is {value}, expected {lower}…{upper}")]
    Range {
        /// Field name with unit, as on the wire.
        field: &'static str,
        /// Offending value.
        value: f64,
        /// Least accepted.
        lower: f64,
        /// Largest accepted.
        upper: f64,
    },
    /// A time interval ends before it begins.
    #[error("{field} ends at {to} s, before it begins at {from} s")]
    Interval {
        /// Field to which it belongs.
        field: &'static str,
        /// Beginning, s.
        from: f64,
        /// End, s.
        to: f64,
    },
    /// No such figure.
    #[error("no figure {0:?} in this world")]
    UnknownFigure(FigureKey),
    /// The figure has the largest number of perturbations already.
    #[error("a figure can have {MAX_PERTURBATIONS} perturbations scheduled at once")]
    TooManyPerturbations,
    /// More constraints than a figure can have at once.
    #[error("a figure can have {MAX_CONSTRAINTS} constraints at once")]
    TooManyConstraints,
    /// A constraint that is empty or impossible.
    #[error("constraints: {0}")]
    Constraint(&'static str),
    /// The other hand can help only a hand.
    #[error("load.two_hands: the load must be in one hand, l_hand or r_hand")]
    NotInOneHand,
    /// The other hand, which should help with a load, holds another load at that time.
    #[error("load.two_hands: the other hand holds a load at that time")]
    OtherHandHoldsLoad,
    /// No such obstacle.
    #[error("no obstacle {0:?} in this world")]
    UnknownObstacle(ObstacleKey),
    /// The world has the largest number of obstacles already.
    #[error("a world can have {MAX_OBSTACLES} obstacles")]
    TooManyObstacles,
    /// A plane can only be fixed or led.
    #[error("obstacle.mobility: a plane cannot move freely")]
    FreePlane,
}

/// A scene that is stepped tick by tick.
#[derive(Debug)]
pub struct World {
    params: WorldParams,
    tick: u64,
    figures: Vec<(FigureKey, Box<Figure>)>,
    next_key: u64,
    obstacles: Vec<(ObstacleKey, Obstacle)>,
    next_obstacle: u64,
    planning: Planning,
    neighbourhood: collisions::Neighbourhood,
}

impl World {
    /// An empty world at tick 0.
    ///
    /// # Errors
    /// [`WorldError::Range`] naming the parameter.
    pub fn new(params: WorldParams) -> Result<Self, WorldError> {
        validate::params(&params)?;
        Ok(Self {
            params,
            tick: 0,
            figures: Vec::new(),
            next_key: 1,
            obstacles: Vec::new(),
            next_obstacle: 1,
            planning: Planning::InTick,
            neighbourhood: collisions::Neighbourhood::default(),
        })
    }

    /// Advances every figure by one tick; afterwards reports and events are those of this tick.
    ///
    /// Stages of one figure: commands (desired motion, loads, pushes) → dynamics, supports, strength → control →
    /// motors, limits and contact → report; see [`Figure`]. Up to and including control, figures do not see each other.
    /// Afterwards, figures that are near nothing move alone, and the others move in clusters of nearby bodies
    /// (docs/adr/0009-collisions.md). The result depends neither on the order nor on the number of threads. With one
    /// thread, nothing is allocated once the buffers have grown.
    pub fn step(&mut self) {
        let context = TickContext {
            tick: self.tick,
            dt: self.dt(),
            substeps: self.params.substeps,
            gravity: self.params.gravity,
            planning: self.planning,
        };
        let WorldParams {
            threads, friction, ..
        } = self.params;
        each(&mut self.figures, threads, |f| f.begin(&context));
        let gathered = self.neighbourhood.gather(
            &mut self.figures,
            &mut self.obstacles,
            context.dt,
            self.params.collisions,
        );
        let (near, alone) = self.figures.split_at_mut(gathered);
        let Slots { mut slots, unused } = SLOTS.take();
        let needed = threads.max(near.len());
        if slots.len() < needed {
            slots.resize_with(needed, WorkspaceSlot::default);
        }
        each_with(alone, &mut slots[..threads], |f, slot| {
            if !f.is_frozen() {
                f.borrow(slot, friction);
                f.decide(&context);
                f.integrate(&context);
                f.finish(&context);
                f.give_back(slot);
            }
        });
        if self.neighbourhood.any() {
            for ((_, f), slot) in near.iter_mut().zip(&mut slots) {
                f.borrow(slot, friction);
            }
            each(near, threads, |f| f.decide(&context));
            let obstacles = &mut self.obstacles;
            let neighbourhood = &mut self.neighbourhood;
            neighbourhood.simulate(&context, friction, threads, near, obstacles);
            for ((_, f), slot) in near.iter_mut().zip(&mut slots) {
                f.give_back(slot);
            }
            self.figures.sort_unstable_by_key(|(k, _)| *k);
            self.obstacles.sort_unstable_by_key(|(k, _)| *k);
        }
        SLOTS.set(Slots { slots, unused }.kept(needed));
        collisions::lead(&mut self.obstacles, context.dt);
        self.tick += 1;
    }

    /// Sets how later ticks handle a plan that is needed but not ready. Default: [`Planning::InTick`].
    pub fn set_planning(&mut self, planning: Planning) {
        self.planning = planning;
    }
    /// Problems that figures need solved by a later tick, and that no thread has accepted yet.
    pub fn plan_requests(&self) -> impl Iterator<Item = PlanRequest> + '_ {
        self.figures.iter().flat_map(|(_, f)| f.plan_requests())
    }
    /// Number of plans that the last tick needed and that were not ready; 0 with [`Planning::InTick`].
    pub fn late_plans(&self) -> usize {
        self.figures
            .iter()
            .map(|(_, f)| f.late_plans().count())
            .sum()
    }
    /// Plans that the last tick needed and that were not ready, by figure.
    pub fn late_plans_of_figures(&self) -> impl Iterator<Item = (FigureKey, LatePlans)> + '_ {
        let all = self.figures.iter().map(|(k, f)| (*k, f.late_plans()));
        all.filter(|(_, late)| late.count() > 0)
    }
    /// Makes the next tick do without these plans of a figure, as if they were late, so that a replay repeats the
    /// timing of the planning threads. Returns false if there is no such figure.
    pub fn delay_plans(&mut self, key: FigureKey, late: LatePlans) -> bool {
        let figure = self.figure_mut(key);
        figure.map(|f| f.delay_plans(late)).is_some()
    }
    /// Sets the number of threads (1…64) for later steps. The result does not depend on it.
    pub fn set_threads(&mut self, threads: usize) {
        self.params.threads = threads.clamp(1, 64);
    }
    /// Fixed properties.
    pub fn params(&self) -> &WorldParams {
        &self.params
    }
    /// Ticks done.
    pub fn tick(&self) -> u64 {
        self.tick
    }
    /// Length of a tick, s.
    pub fn dt(&self) -> f64 {
        1.0 / self.params.rate_hz
    }
    /// Simulated time.
    pub fn time(&self) -> WorldTime {
        WorldTime(self.tick as f64 * self.dt())
    }

    /// Adds a figure.
    ///
    /// # Errors
    /// [`WorldError::Range`] naming the field of the setup.
    pub fn add_figure(&mut self, setup: FigureSetup) -> Result<FigureKey, WorldError> {
        validate::setup(&setup)?;
        let key = FigureKey(self.next_key);
        self.next_key += 1;
        self.figures.push((key, Box::new(Figure::new(setup))));
        Ok(key)
    }

    /// Removes a figure; returns false if there is none with that key.
    pub fn remove_figure(&mut self, key: FigureKey) -> bool {
        let before = self.figures.len();
        self.figures.retain(|(k, _)| *k != key);
        self.neighbourhood.forget(key);
        self.figures.len() < before
    }

    /// A figure by key.
    pub fn figure(&self, key: FigureKey) -> Option<&Figure> {
        self.figures
            .iter()
            .find(|(k, _)| *k == key)
            .map(|(_, f)| &**f)
    }
    /// A figure by key, to change its drive.
    pub fn figure_mut(&mut self, key: FigureKey) -> Option<&mut Figure> {
        self.figures
            .iter_mut()
            .find(|(k, _)| *k == key)
            .map(|(_, f)| &mut **f)
    }
    /// All figures in the order they were added.
    pub fn figures(&self) -> impl Iterator<Item = (FigureKey, &Figure)> {
        self.figures.iter().map(|(k, f)| (*k, &**f))
    }

    /// Checks an obstacle that will be added to the world (`new`) or will replace another one.
    ///
    /// # Errors
    /// As [`Self::add_obstacle`].
    pub fn check_obstacle(&self, setup: &ObstacleSetup, new: bool) -> Result<(), WorldError> {
        validate::obstacle(setup)?;
        if new && self.obstacles.len() >= MAX_OBSTACLES {
            return Err(WorldError::TooManyObstacles);
        }
        Ok(())
    }

    /// Puts an obstacle into the world.
    ///
    /// # Errors
    /// [`WorldError::Range`] naming the field; a plane that would move freely; or no room.
    pub fn add_obstacle(&mut self, setup: ObstacleSetup) -> Result<ObstacleKey, WorldError> {
        self.check_obstacle(&setup, true)?;
        let key = ObstacleKey(self.next_obstacle);
        self.next_obstacle += 1;
        self.obstacles.push((key, Obstacle::new(setup)));
        Ok(key)
    }

    /// Replaces an obstacle under the same key: shape, mobility, pose and velocity.
    ///
    /// # Errors
    /// As [`Self::add_obstacle`], and an unknown key.
    pub fn update_obstacle(
        &mut self,
        key: ObstacleKey,
        setup: ObstacleSetup,
    ) -> Result<(), WorldError> {
        self.check_obstacle(&setup, false)?;
        let found = self.obstacles.iter_mut().find(|(k, _)| *k == key);
        let (_, old) = found.ok_or(WorldError::UnknownObstacle(key))?;
        *old = Obstacle::new(setup);
        Ok(())
    }

    /// Removes an obstacle; returns false if there is none with that key.
    pub fn remove_obstacle(&mut self, key: ObstacleKey) -> bool {
        let before = self.obstacles.len();
        self.obstacles.retain(|(k, _)| *k != key);
        self.obstacles.len() < before
    }

    /// An obstacle by key.
    pub fn obstacle(&self, key: ObstacleKey) -> Option<&Obstacle> {
        let found = self.obstacles.iter().find(|(k, _)| *k == key);
        found.map(|(_, o)| o)
    }
    /// All obstacles in the order they were added.
    pub fn obstacles(&self) -> impl Iterator<Item = (ObstacleKey, &Obstacle)> {
        self.obstacles.iter().map(|(k, o)| (*k, o))
    }
    /// Report on the collisions of the last tick.
    pub fn collisions(&self) -> &CollisionReport {
        &self.neighbourhood.report
    }

    /// Schedules a perturbation of a figure.
    ///
    /// # Errors
    /// Unknown figure, a number out of range, no room, or a load that the other hand cannot help with.
    pub fn perturb(&mut self, key: FigureKey, what: Perturbation) -> Result<(), WorldError> {
        validate::perturbation(&what)?;
        let figure = self.figure_mut(key).ok_or(WorldError::UnknownFigure(key))?;
        if figure.perturbations().any(|p| what.wants_hand_of(p)) {
            return Err(WorldError::OtherHandHoldsLoad);
        }
        if figure.schedule(what) {
            Ok(())
        } else {
            Err(WorldError::TooManyPerturbations)
        }
    }

    /// Puts a figure into a state and forgets its past.
    ///
    /// # Errors
    /// Unknown figure or a state that is not finite.
    pub fn reset_figure(&mut self, key: FigureKey, state: State) -> Result<(), WorldError> {
        validate::state(&state)?;
        self.figure_mut(key)
            .ok_or(WorldError::UnknownFigure(key))?
            .reset(state);
        Ok(())
    }

    /// Changes strength, controller and gains of a figure from the next tick on.
    ///
    /// # Errors
    /// Unknown figure or a number out of range.
    pub fn retune_figure(
        &mut self,
        key: FigureKey,
        strength: StrengthScale,
        controller: ControllerKind,
        params: ControlParams,
    ) -> Result<(), WorldError> {
        validate::strength(&strength)?;
        validate::control(&params)?;
        let figure = self.figure_mut(key).ok_or(WorldError::UnknownFigure(key))?;
        figure.set_strength(strength);
        figure.set_controller(controller, params);
        Ok(())
    }

    /// Changes fatigue and assist of a figure from the next tick on.
    ///
    /// # Errors
    /// Unknown figure or a number out of range.
    pub fn set_figure_options(
        &mut self,
        key: FigureKey,
        options: FigureOptions,
    ) -> Result<(), WorldError> {
        validate::options(&options)?;
        self.figure_mut(key)
            .ok_or(WorldError::UnknownFigure(key))?
            .set_options(options);
        Ok(())
    }

    /// Replaces the constraints of a figure from the next tick on. A constraint on a part that was already constrained
    /// continues from its present state; the others come into force and fade within their `ease`.
    ///
    /// # Errors
    /// Unknown figure, a number out of range, more than [`MAX_CONSTRAINTS`], or an empty constraint.
    pub fn set_constraints(
        &mut self,
        key: FigureKey,
        constraints: &[Constraint],
    ) -> Result<(), WorldError> {
        validate::constraints(constraints)?;
        let time = self.time();
        self.figure_mut(key)
            .ok_or(WorldError::UnknownFigure(key))?
            .set_constraints(constraints, time);
        Ok(())
    }

    /// Hash of the whole world: tick and the state of every figure in order.
    pub fn state_hash(&self) -> u64 {
        let mut h = Fnv::default();
        h.u64(self.tick);
        for (k, f) in &self.figures {
            h.u64(k.0);
            h.u64(f.state_hash());
        }
        for (k, o) in &self.obstacles {
            h.u64(k.0);
            o.add_to(&mut h);
        }
        h.finish()
    }
}

thread_local! {
    /// Workspaces of the worlds that this thread steps. A tick takes them and puts them back. A tick that panics loses
    /// them, and the next one makes new ones.
    static SLOTS: RefCell<Slots> = const { RefCell::new(Slots { slots: Vec::new(), unused: 0 }) };
}

/// Number of consecutive ticks after which unused workspaces are freed: each is several hundred kB, and a crowd that
/// has dispersed may not return.
const UNUSED_TICKS: u32 = 10_000;

#[derive(Default)]
struct Slots {
    slots: Vec<WorkspaceSlot>,
    /// Number of consecutive ticks that did not need all of them.
    unused: u32,
}

impl Slots {
    /// Keeps the workspaces after a tick that needed `needed` of them, and frees those that stay unused.
    fn kept(mut self, needed: usize) -> Self {
        if self.slots.len() <= needed {
            self.unused = 0;
        } else if self.unused < UNUSED_TICKS {
            self.unused += 1;
        } else {
            self.slots.truncate(needed);
            self.slots.shrink_to_fit();
            self.unused = 0;
        }
        self
    }
}

/// Does `work` for every figure, on `threads` threads.
fn each(
    figures: &mut [(FigureKey, Box<Figure>)],
    threads: usize,
    work: impl Fn(&mut Figure) + Sync,
) {
    each_with(figures, &mut vec![(); threads], |f, ()| work(f));
}

/// Does `work` for every figure on one thread per element of `own`, each with its own element.
fn each_with<T: Send>(
    figures: &mut [(FigureKey, Box<Figure>)],
    own: &mut [T],
    work: impl Fn(&mut Figure, &mut T) + Sync,
) {
    let threads = own.len().min(figures.len());
    if threads <= 1 {
        for (_, f) in figures {
            work(f, &mut own[0]);
        }
        return;
    }
    let share = figures.len().div_ceil(threads);
    std::thread::scope(|scope| {
        for (chunk, own) in figures.chunks_mut(share).zip(own) {
            let work = &work;
            scope.spawn(move || chunk.iter_mut().for_each(|(_, f)| work(f, own)));
        }
    });
}
