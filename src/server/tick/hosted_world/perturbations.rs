//! Loads and pushes.

use super::HostedWorld;
use super::bounds::{Bound, PerturbationShare};
use crate::tick::scene::SceneInput;
use sinew_wire::status::Fault;
use sinew_wire::types::{Disturbance, EventKind, FigureDisturbance};

impl HostedWorld {
    /// Checks that the figures of a batch exist.
    fn known(&self, batch: &[FigureDisturbance]) -> Result<(), Fault> {
        self.working()?;
        let mut figures = batch.iter().map(|d| &d.figure);
        figures.try_for_each(|figure| self.member(figure).map(|_| ()))
    }

    /// The share of a batch in the bound of its principal, if it has one.
    ///
    /// # Errors
    /// The batch exceeds the bound.
    fn shares(
        &mut self,
        batch: &[FigureDisturbance],
        bound: Option<&Bound>,
    ) -> Result<Vec<PerturbationShare>, Fault> {
        let Some(bound) = bound else {
            return Ok(Vec::new());
        };
        let (tick, dt) = (self.scene.world().tick(), self.scene.world().dt());
        let mut shares = Vec::with_capacity(batch.len());
        for d in batch {
            let figure = self.scene.members()[self.member(&d.figure)?].key;
            let from = d.tick.map_or(tick, |at| u64::try_from(at).unwrap_or(0));
            let whose = (&bound.principal, figure);
            shares.push(PerturbationShare::of(&d.what, whose, (from, dt)));
        }
        self.shares.check(bound, &shares, tick)?;
        Ok(shares)
    }

    /// Checks a batch like [`Self::perturb`], and returns what that would return.
    pub fn would_perturb(
        &mut self,
        batch: &[FigureDisturbance],
        bound: Option<&Bound>,
    ) -> Result<u64, Fault> {
        self.known(batch)?;
        self.shares(batch, bound)?;
        self.scene.would_perturb(batch)?;
        Ok(self.scene.world().tick())
    }

    /// Applies a batch, all or nothing. Returns the tick at whose start it acts.
    pub fn perturb(
        &mut self,
        batch: &[FigureDisturbance],
        bound: Option<&Bound>,
    ) -> Result<u64, Fault> {
        self.known(batch)?;
        let shares = self.shares(batch, bound)?;
        self.scene.apply(SceneInput::Perturb(batch.to_vec()))?;
        self.shares.add(shares);
        for d in batch {
            // A force without end is not a push.
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
        self.scene.apply(SceneInput::ClearPerturbations(key))?;
        self.shares.forget(key);
        Ok(self.scene.world().tick())
    }
}
