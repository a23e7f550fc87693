//! Loads and pushes.

use super::Shard;
use crate::server::tick::scene::Input;
use crate::wire::status::Fault;
use crate::wire::types::FigureDisturbance;

impl Shard {
    /// Applies a batch, all or nothing. Returns the tick at whose start it acts.
    pub fn perturb(&mut self, batch: &[FigureDisturbance]) -> Result<u64, Fault> {
        self.working()?;
        batch
            .iter()
            .try_for_each(|d| self.member(&d.figure).map(|_| ()))?;
        self.scene.apply(Input::Perturb(batch.to_vec()))?;
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
