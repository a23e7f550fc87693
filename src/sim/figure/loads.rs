//! Loads and pushes of one figure: which act in a tick, and what taking up a load does to the body.

use super::events::{FigureEvent, Watcher};
use crate::sim::body::topology::{NV, SegmentId};
use crate::sim::body::{Body, Links, State};
use crate::sim::dynamics::crba::CompositeInertia;
use crate::sim::dynamics::jacobian::for_each_column;
use crate::sim::dynamics::terms::AppliedForce;
use crate::sim::dynamics::{Kinematics, MassMatrix, Terms, crba, factor, solve};
use crate::sim::math::Vec3;
use crate::sim::setup::{HeldLoad, Perturbation};
use serde::{Deserialize, Serialize};

/// Most perturbations a figure can have scheduled at once.
pub const MAX_PERTURBATIONS: usize = 64;
/// Most forces of other bodies in the audit of one figure.
pub const MAX_EXTERNAL: usize = crate::sim::touch::MAX_ISLAND_CONTACTS;
/// Most applied forces in an audit: perturbations, a bar, other bodies.
pub const MAX_APPLIED: usize = MAX_PERTURBATIONS + 2 + MAX_EXTERNAL;

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Scheduled {
    what: Perturbation,
    carried: bool,
    /// Velocity of the points that carry it at the start of the last tick, m/s.
    moved: Option<[Vec3; 2]>,
    slipped: bool,
}

/// A rigid bar between two points of the body: a load in two hands.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bar {
    /// Segments and points (segment frame, m) of its ends.
    pub ends: [(SegmentId, Vec3); 2],
    /// Its length, m.
    pub length: f64,
}

/// The perturbations of a figure.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Disturbances {
    scheduled: Vec<Scheduled>,
    applied: Vec<AppliedForce>,
    bar: Option<Bar>,
    started: bool,
}

impl Default for Disturbances {
    fn default() -> Self {
        Self {
            scheduled: Vec::with_capacity(MAX_PERTURBATIONS),
            applied: Vec::with_capacity(MAX_PERTURBATIONS),
            bar: None,
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
                moved: None,
                slipped: false,
            });
        }
        room
    }

    /// False if it cannot be what was written into a checkpoint.
    pub fn is_valid(&self) -> bool {
        self.scheduled.len() <= MAX_PERTURBATIONS && self.applied.len() <= MAX_APPLIED
    }

    /// Drops everything that is scheduled or acts; the loads are let go at the next tick.
    pub fn clear(&mut self) {
        for s in &mut self.scheduled {
            s.what.end_at(f64::NEG_INFINITY);
        }
    }

    /// What is scheduled.
    pub fn scheduled(&self) -> impl Iterator<Item = &Perturbation> {
        self.scheduled.iter().map(|s| &s.what)
    }

    /// Mass properties of `body` with the loads that it carries and that were not taken off since. No allocation.
    pub fn loaded(&self, body: &Body) -> Links {
        let mut links = Links::new(body);
        let kept = |s: &&Scheduled| s.carried && s.what.ends() > f64::NEG_INFINITY;
        for load in self.scheduled.iter().filter(kept) {
            for (segment, point, mass) in load.what.load().iter().flat_map(HeldLoad::shares) {
                links.add_load(segment, point, mass);
            }
        }
        links
    }

    /// Forces of the current tick.
    pub fn applied(&self) -> &[AppliedForce] {
        &self.applied
    }

    /// The bar between two hands that hold one load, if there is one.
    pub fn bar(&self) -> Option<&Bar> {
        self.bar.as_ref()
    }

    /// Takes up and lets go loads that are due at `time`, and collects the forces of the tick that begins then.
    ///
    /// A load is taken up inelastically and momentum is conserved: `v⁺ = v⁻ − M'⁻¹ Σ J_pᵀ m (J_p v⁻ − v_load)` with M'
    /// the loaded inertia. What is due before the first tick was carried all along.
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
        let mut changed = false;
        for s in &mut self.scheduled {
            match s.what {
                Perturbation::Load { .. } | Perturbation::Held(_) => {
                    let HeldLoad {
                        segment,
                        mass,
                        from,
                        to,
                        ..
                    } = s.what.load().expect("both kinds are loads");
                    let carried = from <= soon && soon < to;
                    if carried != s.carried {
                        s.carried = carried;
                        s.moved = None;
                        changed = true;
                        watcher.push(match (carried, s.slipped) {
                            (true, _) => FigureEvent::LoadTaken { segment, mass },
                            (false, true) => FigureEvent::LoadSlipped { segment, mass },
                            (false, false) => FigureEvent::LoadDropped { segment, mass },
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
            self.carry(time, dt, body, links, state);
        }
        self.scheduled.retain(|s| s.what.ends() > soon);
        self.started = true;
    }
}

impl Disturbances {
    /// Masses, bar and velocity after loads were taken up or let go.
    fn carry(&mut self, time: f64, dt: f64, body: &Body, links: &mut Links, state: &mut State) {
        let before = links.mass;
        *links = Links::new(body);
        let old_bar = self.bar.take();
        let mut kin = Kinematics::default();
        kin.set_state(links, state);
        let loads = self.scheduled.iter().filter(|s| s.carried);
        for load in loads.clone().filter_map(|s| s.what.load()) {
            for (segment, point, mass) in load.shares() {
                links.add_load(segment, point, mass);
            }
            if let (None, Some(second)) = (self.bar, load.second) {
                let ends = [(load.segment, load.point), second];
                let [a, b] = ends.map(|(s, p)| {
                    let i = s.index();
                    kin.position[i] + kin.rotation[i] * p
                });
                let length = match old_bar {
                    Some(old) if old.ends == ends => old.length,
                    _ => (b - a).norm(),
                };
                self.bar = Some(Bar { ends, length });
            }
        }
        if !self.started {
            return;
        }
        kin.set_state(links, state); // world inertias of the loaded segments
        let mut impulse = [0.0; NV];
        let mut taken = false;
        for load in loads.filter_map(|s| s.what.load()) {
            let i = load.segment.index();
            if load.from > time - dt && before[i] < links.mass[i] {
                taken = true;
                for (segment, point, mass) in load.shares() {
                    add_momentum(
                        &kin,
                        segment.index(),
                        point,
                        mass,
                        load.velocity,
                        &mut impulse,
                    );
                }
            }
        }
        if taken {
            let (mut ci, mut m) = (CompositeInertia::default(), MassMatrix::default());
            crba(links, &kin, &mut ci, &mut m);
            factor(&mut m);
            solve(&m, &mut impulse);
            for i in 0..NV {
                state.velocity[i] -= impulse[i];
            }
        }
    }

    /// Finds loads whose force at a hand exceeds the grip: they go at the start of the next tick.
    ///
    /// The force is that of the tick before, `m (a + g) − f`, a from the velocities of the point at its start and end,
    /// f the bar's.
    ///
    /// * `terms`: of the state at the start of this tick; `bar_force`: mean force of the bar on its second end in the
    ///   last tick, N.
    pub fn check_grip(&mut self, time: f64, dt: f64, terms: &Terms, gravity: f64, bar_force: Vec3) {
        for s in self.scheduled.iter_mut().filter(|s| s.carried) {
            let Some(load) = s.what.load().filter(|l| l.grip.is_finite()) else {
                continue;
            };
            let mut now = [Vec3::zero(); 2];
            let mut most = 0.0f64;
            for (k, (segment, point, mass)) in load.shares().enumerate() {
                now[k] = terms.point_velocity(segment.index(), point);
                if let Some(before) = s.moved {
                    let a = (now[k] - before[k]) * (1.0 / dt) + Vec3::Z * gravity;
                    let bar = match (load.second, k) {
                        (None, _) => Vec3::zero(),
                        (Some(_), 0) => bar_force * -1.0,
                        (Some(_), _) => bar_force,
                    };
                    most = most.max((a * mass - bar).norm());
                }
            }
            s.moved = Some(now);
            if most > load.grip {
                s.slipped = true;
                s.what.end_at(time + dt);
            }
        }
    }
}

/// Adds `J_pᵀ m (J_p v − v_load)`: the momentum that a point mass must be given.
fn add_momentum(
    kin: &Kinematics<f64>,
    segment: usize,
    point: Vec3,
    mass: f64,
    velocity: Vec3,
    x: &mut [f64; NV],
) {
    let r = kin.rotation[segment] * point;
    let p = (kin.velocity[segment] + kin.omega[segment].cross(r) - velocity) * mass;
    for_each_column(kin, segment, kin.position[segment] + r, |i, _, v| {
        x[i] += v.dot(p)
    });
}
