//! Limits the total effect of bounded perturbers on figures.
//!
//! A bound limits the effect of one principal on one figure at a time, however many calls and perturbations it consists
//! of: twice the force is twice the force, whether it comes in one piece or in two.

use sinew_physics::world::FigureKey;
use sinew_wire::status::Fault;
use sinew_wire::types::Disturbance;
use std::ops::Range;
use std::sync::Arc;

/// The limits of one principal.
#[derive(Clone, Debug)]
pub struct Bound {
    /// The principal.
    pub principal: Arc<str>,
    /// Largest sum of forces on one figure, N.
    pub force: f64,
    /// Largest sum of loads of one figure, kg.
    pub mass: f64,
}

/// One perturbation of such a principal.
#[derive(Clone, Debug)]
pub(super) struct PerturbationShare {
    principal: Arc<str>,
    figure: FigureKey,
    /// Ticks in which it acts.
    ticks: Range<u64>,
    /// Force, N.
    force: f64,
    /// Mass, kg.
    mass: f64,
}

impl PerturbationShare {
    /// The share of a perturbation that begins with tick `from`; ticks take `dt` s.
    pub fn of(
        what: &Disturbance,
        (principal, figure): (&Arc<str>, FigureKey),
        (from, dt): (u64, f64),
    ) -> Self {
        let (force, mass, duration) = match what {
            Disturbance::Force {
                force, duration, ..
            } => (force.norm(), 0.0, *duration),
            Disturbance::Load { mass, duration, .. } => (0.0, *mass, *duration),
        };
        // Infinite times end with the last possible tick.
        let lasts = (duration / dt).ceil() as u64;
        Self {
            principal: Arc::clone(principal),
            figure,
            ticks: from..from.saturating_add(lasts.max(1)),
            force,
            mass,
        }
    }
}

/// Perturbations that act now or will act.
#[derive(Debug, Default)]
pub(super) struct Shares(Vec<PerturbationShare>);

impl Shares {
    /// Checks that these, on top of those that act from tick `now` on, stay within a bound.
    ///
    /// # Errors
    /// They exceed it at some time.
    pub fn check(
        &mut self,
        bound: &Bound,
        new: &[PerturbationShare],
        now: u64,
    ) -> Result<(), Fault> {
        self.0.retain(|s| s.ticks.end > now);
        for (i, at) in new.iter().enumerate() {
            let of_it =
                |s: &&PerturbationShare| s.principal == bound.principal && s.figure == at.figure;
            let all = || self.0.iter().chain(new).filter(of_it);
            // Sums are largest where a perturbation begins.
            let begins = all().map(|s| s.ticks.start.max(now));
            for tick in begins.filter(|t| at.ticks.contains(t)) {
                let acts = || all().filter(|s| s.ticks.contains(&tick));
                for (what, sum, most, unit) in [
                    (
                        "force",
                        acts().map(|s| s.force).sum::<f64>(),
                        bound.force,
                        "N",
                    ),
                    ("mass", acts().map(|s| s.mass).sum(), bound.mass, "kg"),
                ] {
                    // Rounding of the sum must not count as a force.
                    if sum > most * (1.0 + 1e-9) {
                        return Err(refused(
                            i,
                            format!(
                                "the grant allows a {what} of {most} {unit} on one figure at a time; with all that \
                                 acts then it would be {sum:.3}"
                            ),
                        ));
                    }
                }
            }
        }
        Ok(())
    }

    /// Adds perturbations that act from now on.
    pub fn add(&mut self, new: Vec<PerturbationShare>) {
        self.0.extend(new);
    }

    /// No perturbation acts on this figure any more.
    pub fn forget(&mut self, figure: FigureKey) {
        self.0.retain(|s| s.figure != figure);
    }
}

fn refused(i: usize, message: String) -> Fault {
    let field = format!("perturbations[{i}]");
    Fault::Denied {
        reason: "PERTURBATION_BOUND",
        message: format!("{field}: {message}"),
        facts: vec![("field", field)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_physics::body::topology::CHEST;
    use sinew_physics::math::Vec3;

    fn push(
        principal: &Arc<str>,
        figure: FigureKey,
        newtons: f64,
        ticks: Range<u64>,
    ) -> PerturbationShare {
        let what = Disturbance::Force {
            segment: CHEST,
            point: None,
            force: Vec3::X * newtons,
            duration: (ticks.end - ticks.start) as f64 * 0.5,
        };
        PerturbationShare::of(&what, (principal, figure), (ticks.start, 0.5))
    }

    #[test]
    fn a_bound_is_for_all_that_acts_at_a_time() {
        let (p, q): (Arc<str>, Arc<str>) = ("p".into(), "q".into());
        let (a, b) = (FigureKey(0), FigureKey(1));
        let bound = Bound {
            principal: p.clone(),
            force: 100.0,
            mass: f64::INFINITY,
        };
        let mut all = Shares::default();
        let one = |newtons, ticks| vec![push(&p, a, newtons, ticks)];
        assert!(
            all.check(&bound, &[one(60.0, 5..9), one(60.0, 8..12)].concat(), 5)
                .is_err()
        );
        assert!(
            all.check(&bound, &[one(60.0, 5..9), one(60.0, 9..12)].concat(), 5)
                .is_ok()
        );
        all.add(one(60.0, 5..9));
        all.add(one(90.0, 20..21));
        assert!(all.check(&bound, &one(41.0, 5..6), 5).is_err());
        assert!(all.check(&bound, &one(41.0, 8..30), 5).is_err());
        assert!(all.check(&bound, &one(41.0, 9..20), 5).is_ok());
        assert!(
            all.check(&bound, &one(20.0, 9..21), 5).is_err(),
            "a later push counts"
        );
        // Neither those of others nor those on others count.
        all.add(vec![push(&q, a, 1e3, 0..100), push(&p, b, 1e3, 0..100)]);
        assert!(all.check(&bound, &one(40.0, 5..19), 5).is_ok());
        assert!(all.check(&bound, &one(100.0, 9..20), 9).is_ok());
        all.forget(a);
        assert!(all.check(&bound, &one(100.0, 5..u64::MAX), 5).is_ok());
    }
}
