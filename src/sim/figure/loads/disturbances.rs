//! Loads and pushes of one figure: those that act in a tick, and the effect on the body of taking up a load.

use crate::body::topology::{L_HAND, R_HAND};
use crate::body::topology::{NV, SegmentId};
use crate::body::{Body, Links, State};
use crate::dynamics::crba::CompositeInertia;
use crate::dynamics::jacobian::for_each_column;
use crate::dynamics::terms::AppliedForce;
use crate::dynamics::{Kinematics, MassMatrix, Terms, crba, factor, solve};
use crate::figure::events::{FigureEvent, Watcher};
use crate::figure::params::second_hand::AHEAD;
use crate::math::Vec3;
use crate::setup::MAX_PERTURBATIONS;
use crate::setup::{HeldLoad, Perturbation, SecondHand};
use crate::stepper::command::Bar;
use crate::stepper::forces::MAX_APPLIED;
use serde::{Deserialize, Serialize};

/// The other hand's part in holding a load.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoadShare {
    /// The other hand.
    pub hand: SegmentId,
    /// Point at which it holds, segment frame, m.
    pub point: Vec3,
    /// Its share of the mass, 0…1.
    pub share: f64,
    /// Share of its strength that the arm needs for the load alone, and that the harder-working arm needs when both
    /// hold it, as of the last change of `share`.
    pub need: [f64; 2],
}

impl LoadShare {
    /// Whether this value is one that a checkpoint could hold.
    pub(in crate::figure) fn is_valid(&self) -> bool {
        (self.hand == L_HAND || self.hand == R_HAND)
            && self.point.is_finite()
            && (0.0..=1.0).contains(&self.share)
            && self.need.iter().all(|n| n.is_finite())
    }
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Scheduled {
    what: Perturbation,
    carried: bool,
    /// Velocity of the points that carry it at the start of the last tick, m/s.
    moved: Option<[Vec3; 2]>,
    slipped: bool,
    /// The other hand's part in it now, and from the next tick on.
    help: Option<LoadShare>,
    wish: Option<LoadShare>,
}

impl Scheduled {
    /// The second point that holds it.
    fn second(&self) -> Option<(SegmentId, Vec3)> {
        let helped = self.help.map(|h| (h.hand, h.point));
        helped.or_else(|| self.what.load()?.second)
    }

    /// For a load, the mass that each point carries: segment, point (segment frame, m), mass (kg).
    fn shares(&self) -> impl Iterator<Item = (SegmentId, Vec3, f64)> + use<> {
        let load = self.what.load();
        let helped = self.help.zip(load).map(|(help, load)| {
            let other = help.share * load.mass;
            [
                (load.segment, load.point, load.mass - other),
                (help.hand, help.point, other),
            ]
        });
        let alone = load.filter(|_| helped.is_none());
        let alone = alone.into_iter().flat_map(|l| l.shares());
        helped.into_iter().flatten().chain(alone)
    }

    /// Whether it is carried at `time`, s, or will be soon, and the other hand may help with it.
    fn is_helpable(&self, time: f64) -> bool {
        let Perturbation::Helped { load, .. } = self.what else {
            return false;
        };
        time < load.to && (self.carried || load.from - time <= AHEAD)
    }
}

/// A load that the other hand may help with.
#[derive(Clone, Copy, Debug)]
pub struct Helpable {
    /// The load.
    pub load: HeldLoad,
    /// The setting for when the other hand helps.
    pub when: SecondHand,
    /// The other hand's present part.
    pub help: Option<LoadShare>,
    /// Whether the load is carried already.
    pub carried: bool,
}

/// A part of a load that passes from one hand to the other.
struct Moved {
    from: (SegmentId, Vec3),
    to: (SegmentId, Vec3),
    mass: f64,
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
    /// Schedules one; returns `false` without room for it.
    pub fn add(&mut self, what: Perturbation) -> bool {
        let room = self.scheduled.len() < MAX_PERTURBATIONS;
        if room {
            self.scheduled.push(Scheduled {
                what,
                carried: false,
                moved: None,
                slipped: false,
                help: None,
                wish: None,
            });
        }
        room
    }

    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        let helps = self.scheduled.iter().flat_map(|s| [s.help, s.wish]);
        self.scheduled.len() <= MAX_PERTURBATIONS
            && self.applied.len() <= MAX_APPLIED
            && helps.flatten().all(|h| h.is_valid())
    }

    /// Drops everything that is scheduled or acts; the loads are released at the next tick.
    pub fn clear(&mut self) {
        for s in &mut self.scheduled {
            s.what.end_at(f64::NEG_INFINITY);
        }
    }

    /// The scheduled perturbations.
    pub fn scheduled(&self) -> impl Iterator<Item = &Perturbation> {
        self.scheduled.iter().map(|s| &s.what)
    }

    /// Mass properties of `body` with the loads that it carries and that have not been removed since. No allocation.
    pub fn loaded(&self, body: &Body) -> Links {
        let mut links = Links::new(body);
        let kept = |s: &&Scheduled| s.carried && s.what.ends() > f64::NEG_INFINITY;
        for load in self.scheduled.iter().filter(kept) {
            for (segment, point, mass) in load.shares() {
                links.add_load(segment, point, mass);
            }
        }
        links
    }

    /// The loads that each hand holds at `time`: segment, point (segment frame, m), mass (kg).
    pub fn held(&self, time: f64) -> impl Iterator<Item = (SegmentId, Vec3, f64)> {
        let holds = move |s: &&Scheduled| {
            let load = s.what.load();
            load.is_some_and(|l| l.from <= time && time < l.to)
        };
        self.scheduled
            .iter()
            .filter(holds)
            .flat_map(Scheduled::shares)
    }

    /// The load that the other hand helps with at `time`, s; if there is none, the heaviest that it may help with.
    pub fn helpable(&self, time: f64) -> Option<Helpable> {
        let s = &self.scheduled[self.helped(time)?];
        let Perturbation::Helped { load, when } = s.what else {
            return None;
        };
        Some(Helpable {
            load,
            when,
            help: s.help,
            carried: s.carried,
        })
    }

    /// Index of the load of [`Self::helpable`].
    fn helped(&self, time: f64) -> Option<usize> {
        let may = |i: &usize| self.scheduled[*i].is_helpable(time);
        let all = || (0..self.scheduled.len()).filter(may);
        let mass = |i: usize| self.scheduled[i].what.load().map_or(0.0, |l| l.mass);
        let held = all().find(|i| self.scheduled[*i].help.is_some());
        // The first among equals.
        held.or_else(|| all().reduce(|a, b| if mass(b) > mass(a) { b } else { a }))
    }

    /// Sets the other hand's part in the load of [`Self::helpable`] from the next tick on.
    pub fn help(&mut self, time: f64, help: Option<LoadShare>) {
        if let Some(i) = self.helped(time) {
            self.scheduled[i].wish = help;
        }
    }

    /// Makes the other hand let go of any load that it helps with, at the next tick.
    pub fn stop_help(&mut self) {
        for s in &mut self.scheduled {
            s.wish = None;
        }
    }

    /// The other hand's part in a load, while it holds it.
    pub fn present_help(&self) -> Option<LoadShare> {
        self.scheduled.iter().find_map(|s| s.help)
    }

    /// Whether one of these segments carries anything besides its share of a load that the other hand holds too.
    pub fn burdens(&self, segments: [SegmentId; 3]) -> bool {
        let own = |s: &&Scheduled| s.carried && s.help.is_none();
        let mut parts = self
            .scheduled
            .iter()
            .filter(own)
            .flat_map(Scheduled::shares);
        parts.any(|(segment, ..)| segments.contains(&segment))
    }

    /// Forces of the current tick.
    pub fn applied(&self) -> &[AppliedForce] {
        &self.applied
    }

    /// The bar between two hands that hold one load, if there is one.
    pub fn bar(&self) -> Option<&Bar> {
        self.bar.as_ref()
    }

    /// Takes up and releases the loads that are due at `time`, and collects the forces of the tick that begins then.
    ///
    /// Taking up a load is inelastic and conserves momentum: `v⁺ = v⁻ − M'⁻¹ Σ J_pᵀ m (J_p v⁻ − v_load)` with M' the
    /// loaded inertia. A load that is due before the first tick counts as carried from the start.
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
        let mut moved = None;
        for s in &mut self.scheduled {
            match s.what {
                Perturbation::Load { .. } | Perturbation::Held(_) | Perturbation::Helped { .. } => {
                    let HeldLoad {
                        segment,
                        mass,
                        from,
                        to,
                        ..
                    } = s.what.load().expect("all three kinds are loads");
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
                        if !carried {
                            (s.help, s.wish) = (None, None);
                        }
                    }
                    if s.wish != s.help {
                        moved = s.follow_wish(watcher).or(moved);
                        changed = true;
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
            self.carry(time, dt, moved.as_ref(), body, links, state);
        }
        self.scheduled.retain(|s| s.what.ends() > soon);
        self.started = true;
    }
}

impl Disturbances {
    /// Masses, bar and velocity after loads were taken up or released in the tick of `dt` seconds that begins at
    /// `time`, or after a part of one has `moved` from one hand to the other.
    fn carry(
        &mut self,
        time: f64,
        dt: f64,
        moved: Option<&Moved>,
        body: &Body,
        links: &mut Links,
        state: &mut State,
    ) {
        let before = links.mass;
        *links = Links::new(body);
        let old_bar = self.bar.take();
        let mut kin = Kinematics::default();
        kin.set_state(links, state);
        let loads = self.scheduled.iter().filter(|s| s.carried);
        for s in loads.clone() {
            for (segment, point, mass) in s.shares() {
                links.add_load(segment, point, mass);
            }
            if let (None, Some(load), Some(second)) = (self.bar, s.what.load(), s.second()) {
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
        if let Some(Moved { from, to, mass }) = moved {
            let i = from.0.index();
            let r = kin.rotation[i] * from.1;
            let velocity = kin.velocity[i] + kin.omega[i].cross(r);
            add_momentum(&kin, to.0.index(), to.1, *mass, velocity, &mut impulse);
            taken = true;
        }
        for load in loads.filter_map(|s| s.what.load()) {
            let i = load.segment.index();
            // Not carried in the previous tick, by the same tolerance.
            if load.from > time - dt + 1e-9 * dt && before[i] < links.mass[i] {
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

    /// Finds loads whose force at a hand exceeds the grip: they are dropped at the start of the next tick.
    ///
    /// The force is that of the previous tick, `m (a + g) − f`, where a comes from the velocities of the point at the
    /// start and end of that tick, and f is the force of the bar.
    ///
    /// * `terms`: of the state at the start of this tick; `bar_force`: mean force of the bar on its second end in the
    ///   last tick, N.
    pub fn check_grip(&mut self, time: f64, dt: f64, terms: &Terms, gravity: f64, bar_force: Vec3) {
        for s in self.scheduled.iter_mut().filter(|s| s.carried) {
            let Some(load) = s.what.load().filter(|l| l.grip.is_finite()) else {
                continue;
            };
            let in_two = s.second().is_some();
            let mut now = [Vec3::zero(); 2];
            let mut most = 0.0f64;
            for (k, (segment, point, mass)) in s.shares().enumerate() {
                now[k] = terms.point_velocity(segment.index(), point);
                if let Some(before) = s.moved {
                    let a = (now[k] - before[k]) * (1.0 / dt) + Vec3::Z * gravity;
                    let bar = match (in_two, k) {
                        (false, _) => Vec3::zero(),
                        (true, 0) => bar_force * -1.0,
                        (true, _) => bar_force,
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

impl Scheduled {
    /// Makes the other hand take hold of the load, let go of it, or take another share of it; returns the part that
    /// changes hands.
    fn follow_wish(&mut self, watcher: &mut Watcher) -> Option<Moved> {
        let (before, now) = (self.help, self.wish);
        self.help = now;
        let load = self.what.load()?;
        let (segment, mass) = (load.segment, load.mass);
        match (before, now) {
            (None, Some(help)) => watcher.push(FigureEvent::LoadShared {
                segment,
                mass,
                hand: help.hand,
                need: help.need,
            }),
            (Some(help), None) => watcher.push(FigureEvent::LoadUnshared {
                segment,
                mass,
                hand: help.hand,
                need: help.need,
            }),
            _ => {}
        }
        if before.is_some() != now.is_some() {
            self.moved = None;
        }
        let help = now.or(before)?;
        let share = |h: Option<LoadShare>| h.map_or(0.0, |h| h.share);
        let more = (share(now) - share(before)) * mass;
        let (own, other) = ((load.segment, load.point), (help.hand, help.point));
        let (from, to) = if more > 0.0 {
            (own, other)
        } else {
            (other, own)
        };
        (more.abs() > 0.0).then_some(Moved {
            from,
            to,
            mass: more.abs(),
        })
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
