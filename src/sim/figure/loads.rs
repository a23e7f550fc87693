//! Loads and pushes of one figure: which act in a tick, and what taking up a load does to the body.

use super::events::{FigureEvent, Watcher};
use super::setup::Perturbation;
use crate::sim::body::topology::NV;
use crate::sim::body::{Body, Links, State};
use crate::sim::dynamics::crba::CompositeInertia;
use crate::sim::dynamics::jacobian::for_each_column;
use crate::sim::dynamics::terms::AppliedForce;
use crate::sim::dynamics::{Kinematics, MassMatrix, crba, factor, solve};
use crate::sim::math::Vec3;

/// Most perturbations a figure can have scheduled at once.
pub const MAX_PERTURBATIONS: usize = 64;

#[derive(Clone, Copy, Debug)]
struct Scheduled {
    what: Perturbation,
    carried: bool,
}

/// The perturbations of a figure.
#[derive(Clone, Debug)]
pub struct Disturbances {
    scheduled: Vec<Scheduled>,
    applied: Vec<AppliedForce>,
    started: bool,
}

impl Default for Disturbances {
    fn default() -> Self {
        Self {
            scheduled: Vec::with_capacity(MAX_PERTURBATIONS),
            applied: Vec::with_capacity(MAX_PERTURBATIONS),
            started: false,
        }
    }
}

impl Disturbances {
    /// Schedules one; false if there is no room.
    pub fn add(&mut self, what: Perturbation) -> bool {
        let room = self.scheduled.len() < MAX_PERTURBATIONS;
        if room {
            self.scheduled.push(Scheduled {
                what,
                carried: false,
            });
        }
        room
    }

    /// Drops everything that is scheduled or acts; the loads are let go at the next tick.
    pub fn clear(&mut self) {
        for s in &mut self.scheduled {
            match &mut s.what {
                Perturbation::Load { to, .. } | Perturbation::Force { to, .. } => {
                    *to = f64::NEG_INFINITY
                }
            }
        }
    }

    /// What is scheduled.
    pub fn scheduled(&self) -> impl Iterator<Item = &Perturbation> {
        self.scheduled.iter().map(|s| &s.what)
    }

    /// Forces of the current tick.
    pub fn applied(&self) -> &[AppliedForce] {
        &self.applied
    }

    /// Takes up and lets go loads that are due at `time`, and collects the forces of the tick that begins then.
    ///
    /// A load taken up in motion was at rest: momentum is conserved,
    /// `v⁺ = v⁻ − M'⁻¹ J_pᵀ m J_p v⁻` with M' the loaded inertia (ALGORITHM §10). What is due before the first tick was carried all along.
    pub fn apply(
        &mut self,
        time: f64,
        dt: f64,
        body: &Body,
        links: &mut Links,
        state: &mut State,
        watcher: &mut Watcher,
    ) {
        self.applied.clear();
        let soon = time + 1e-9 * dt; // times on a tick boundary belong to that tick
        let (mut changed, started) = (false, self.started);
        for s in &mut self.scheduled {
            match s.what {
                Perturbation::Load {
                    segment,
                    mass,
                    from,
                    to,
                    ..
                } => {
                    let carried = from <= soon && soon < to;
                    if carried != s.carried {
                        s.carried = carried;
                        changed = true;
                        watcher.push(if carried {
                            FigureEvent::LoadTaken { segment, mass }
                        } else {
                            FigureEvent::LoadDropped { segment, mass }
                        });
                    }
                }
                Perturbation::Force {
                    segment,
                    point,
                    force,
                    from,
                    to,
                } => {
                    let overlap = to.min(time + dt) - from.max(time);
                    if overlap > 0.0 {
                        self.applied
                            .push((segment, point, force * (overlap / dt).min(1.0)));
                    }
                }
            }
        }
        if changed {
            let before = links.mass;
            *links = Links::new(body);
            for s in self.scheduled.iter().filter(|s| s.carried) {
                if let Perturbation::Load {
                    segment,
                    point,
                    mass,
                    from,
                    ..
                } = s.what
                {
                    links.add_load(segment, point, mass);
                    let taken_now = started
                        && from > time - dt
                        && before[segment.index()] < links.mass[segment.index()];
                    if taken_now {
                        take_up(links, state, segment.index(), point, mass);
                    }
                }
            }
        }
        self.scheduled.retain(|s| match s.what {
            Perturbation::Load { to, .. } | Perturbation::Force { to, .. } => to > soon,
        });
        self.started = true;
    }
}

/// Velocity after a resting point mass has been welded on; `links` carry it already.
fn take_up(links: &Links, state: &mut State, segment: usize, point: Vec3, mass: f64) {
    let (mut kin, mut ci, mut m) = (
        Kinematics::default(),
        CompositeInertia::default(),
        MassMatrix::default(),
    );
    kin.set_state(links, state);
    crba(links, &kin, &mut ci, &mut m);
    factor(&mut m);
    let r = kin.rotation[segment] * point;
    let p = (kin.velocity[segment] + kin.omega[segment].cross(r)) * mass; // momentum the load must be given
    let mut x = [0.0; NV];
    for_each_column(&kin, segment, kin.position[segment] + r, |i, _, v| {
        x[i] = v.dot(p)
    });
    solve(&m, &mut x);
    for i in 0..NV {
        state.velocity[i] -= x[i];
    }
}
