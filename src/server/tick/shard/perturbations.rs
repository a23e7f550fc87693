//! Loads and pushes.

use super::Shard;
use crate::server::tick::scene::Input;
use crate::wire::status::Fault;
use crate::wire::types::{Disturbance, EventKind, FigureDisturbance};

impl Shard {
    /// Checks that a batch is of figures that there are.
    fn known(&self, batch: &[FigureDisturbance]) -> Result<(), Fault> {
        self.working()?;
        let mut figures = batch.iter().map(|d| &d.figure);
        figures.try_for_each(|figure| self.member(figure).map(|_| ()))
    }

    /// Checks a batch as [`Self::perturb`] does and returns what it would.
    pub fn would_perturb(&self, batch: &[FigureDisturbance]) -> Result<u64, Fault> {
        self.known(batch)?;
        self.scene.would_perturb(batch)?;
        Ok(self.scene.world().tick())
    }

    /// Applies a batch, all or nothing. Returns the tick at whose start it acts.
    pub fn perturb(&mut self, batch: &[FigureDisturbance]) -> Result<u64, Fault> {
        self.known(batch)?;
        self.scene.apply(Input::Perturb(batch.to_vec()))?;
        for d in batch {
            // A force without end is no push.
            if let Disturbance::Force {
                segment,
                force,
                duration,
                ..
            } = d.what
                && duration.is_finite()
            {
                let impulse = force.norm() * duration;
                self.event(&d.figure, EventKind::Pushed(segment, impulse));
            }
        }
        Ok(self.scene.world().tick())
    }

    /// Takes all loads and forces off a figure. Returns the tick at whose start it acts.
    pub fn clear_perturbations(&mut self, figure: &str) -> Result<u64, Fault> {
        self.working()?;
        let key = self.scene.members()[self.member(figure)?].key;
        self.scene.apply(Input::ClearPerturbations(key))?;
        Ok(self.scene.world().tick())
    }
}
