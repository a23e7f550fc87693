//! A shared scene: a clock and figures on one ground. The physics of one tick is [`World::step`].

mod validate;

pub use crate::sim::figure::{ClipPlayback, Drive, Figure, FigureEvent, FigureSetup};

use crate::sim::body::{SegmentId, State};
use crate::sim::figure::loads::MAX_PERTURBATIONS;
use crate::sim::figure::{
    ControlParams, ControllerKind, FigureOptions, Perturbation, StrengthScale, TickContext,
};
use crate::sim::math::hash::Fnv;

/// Fixed properties of a world.
#[derive(Clone, Copy, Debug, PartialEq)]
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
}

impl Default for WorldParams {
    fn default() -> Self {
        Self {
            rate_hz: 60.0,
            substeps: 2,
            gravity: 9.81,
            friction: 0.9,
            threads: 1,
        }
    }
}

/// Identity of a figure in a world; never used again after removal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FigureKey(pub u64);

/// Why a world refuses something. Nothing has changed then.
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
        /// What it belongs to.
        field: &'static str,
        /// Beginning, s.
        from: f64,
        /// End, s.
        to: f64,
    },
    /// No such figure.
    #[error("no figure {0:?} in this world")]
    UnknownFigure(FigureKey),
    /// A figure can have only so many perturbations at once.
    #[error("a figure can have {MAX_PERTURBATIONS} perturbations scheduled at once")]
    TooManyPerturbations,
}

/// A scene that is stepped tick by tick.
#[derive(Debug)]
pub struct World {
    params: WorldParams,
    tick: u64,
    figures: Vec<(FigureKey, Figure)>,
    next_key: u64,
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
        })
    }

    /// Advances every figure by one tick; afterwards reports and events are those of this tick.
    ///
    /// Stages of one figure: commands (desired motion, loads, pushes) → dynamics, supports, strength → control → motors, limits and
    /// contact → report; see [`Figure`]. Figures do not see each other, so they step in any order and on any number of threads with the
    /// same result. With one thread nothing is allocated.
    pub fn step(&mut self) {
        let context = TickContext {
            tick: self.tick,
            dt: self.dt(),
            substeps: self.params.substeps,
            gravity: self.params.gravity,
        };
        let threads = self.params.threads.min(self.figures.len());
        if threads <= 1 {
            for (_, figure) in &mut self.figures {
                figure.step(&context);
            }
        } else {
            let share = self.figures.len().div_ceil(threads);
            std::thread::scope(|scope| {
                for chunk in self.figures.chunks_mut(share) {
                    scope.spawn(move || {
                        chunk
                            .iter_mut()
                            .for_each(|(_, figure)| figure.step(&context))
                    });
                }
            });
        }
        self.tick += 1;
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
    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.tick as f64 * self.dt()
    }

    /// Adds a figure.
    ///
    /// # Errors
    /// [`WorldError::Range`] naming the field of the setup.
    pub fn add_figure(&mut self, setup: FigureSetup) -> Result<FigureKey, WorldError> {
        validate::setup(&setup)?;
        let key = FigureKey(self.next_key);
        self.next_key += 1;
        self.figures
            .push((key, Figure::new(setup, self.params.friction)));
        Ok(key)
    }

    /// Removes a figure; false if there is none of that key.
    pub fn remove_figure(&mut self, key: FigureKey) -> bool {
        let before = self.figures.len();
        self.figures.retain(|(k, _)| *k != key);
        self.figures.len() < before
    }

    /// A figure by key.
    pub fn figure(&self, key: FigureKey) -> Option<&Figure> {
        self.figures.iter().find(|(k, _)| *k == key).map(|(_, f)| f)
    }
    /// A figure by key, to change its drive.
    pub fn figure_mut(&mut self, key: FigureKey) -> Option<&mut Figure> {
        self.figures
            .iter_mut()
            .find(|(k, _)| *k == key)
            .map(|(_, f)| f)
    }
    /// All figures in the order they were added.
    pub fn figures(&self) -> impl Iterator<Item = (FigureKey, &Figure)> {
        self.figures.iter().map(|(k, f)| (*k, f))
    }

    /// Schedules a perturbation of a figure.
    ///
    /// # Errors
    /// Unknown figure, a number out of range, or no room.
    pub fn perturb(&mut self, key: FigureKey, what: Perturbation) -> Result<(), WorldError> {
        validate::perturbation(&what)?;
        let figure = self.figure_mut(key).ok_or(WorldError::UnknownFigure(key))?;
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

    /// Hash of the whole world: tick and the state of every figure in order.
    pub fn state_hash(&self) -> u64 {
        let mut h = Fnv::default();
        h.u64(self.tick);
        for (k, f) in &self.figures {
            h.u64(k.0);
            h.u64(f.state_hash());
        }
        h.finish()
    }
}

/// Segments a perturbation may name, for messages.
pub fn segment_by_name(name: &str) -> Option<SegmentId> {
    SegmentId::from_name(name)
}
