//! Loads and pushes.

use super::Shard;
use crate::server::engine;
use crate::sim::figure::Perturbation;
use crate::sim::figure::loads::MAX_PERTURBATIONS;
use crate::wire::status::Fault;
use crate::wire::types::FigureDisturbance;

impl Shard {
    /// Checks a batch: what it comes to, by member.
    fn planned(&self, batch: &[FigureDisturbance]) -> Result<Vec<(usize, Perturbation)>, Fault> {
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
        Ok(plan)
    }

    /// Checks a batch as [`Self::perturb`] does and returns what it would.
    pub fn would_perturb(&self, batch: &[FigureDisturbance]) -> Result<u64, Fault> {
        self.planned(batch)?;
        Ok(self.world.tick())
    }

    /// Applies a batch, all or nothing. Returns the tick at whose start it acts.
    pub fn perturb(&mut self, batch: &[FigureDisturbance]) -> Result<u64, Fault> {
        for (i, p) in self.planned(batch)? {
            engine::perturb(&mut self.world, self.members[i].key, p)?;
        }
        Ok(self.world.tick())
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
}
