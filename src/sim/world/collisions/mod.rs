//! Stage 6 of a tick for all bodies that are near others: finds nearby bodies and their contacts, and solves for all
//! touching bodies together.
//!
//! * [`neighbourhood`]: pairs of nearby bodies, and the clusters that they form.
//! * [`cast`]: the bodies of one cluster and their places.
//! * [`contacts`]: the points at which parts are nearest.
//! * [`islands`]: the solve, and its impulses on all bodies.
//! * [`staged`]: the paper's collisions instead, for figures that are moved by accelerations.

mod cast;
mod contacts;
mod islands;
mod neighbourhood;
mod staged;

use crate::collide::island::Island;
use crate::collide::narrow::Near;
use crate::collide::{Mobility, Obstacle, ObstacleKey};
use crate::math::Vec3;
use crate::paper::impact::Impact;
use crate::tick_context::TickContext;
use cast::Cast;
pub(super) use neighbourhood::Neighbourhood;
use serde::{Deserialize, Serialize};

/// Report on the collisions of one tick.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CollisionReport {
    /// Pairs of bodies whose boxes overlapped.
    pub pairs: u64,
    /// Solves of islands.
    pub islands: u64,
    /// Contacts that pushed, over all substeps.
    pub contacts: u64,
    /// Newton iterations of all islands.
    pub iterations: u64,
    /// Islands whose iteration bound was hit.
    pub unfinished: u64,
    /// Deepest overlap of any two bodies at the start of any substep, m.
    pub depth: f64,
    /// Work of contacts between bodies, J: impulse times the mean of the relative velocities before and after; never
    /// positive except for the correction of overlaps, the work of led obstacles, and muscles that reverse a motion
    /// within one substep.
    pub work: f64,
    /// The part of it along the motion after the contacts, J: the motion that they drive instead of stopping it. Zero
    /// except for the correction of overlaps and for led obstacles.
    pub driven: f64,
}

impl CollisionReport {
    fn add(&mut self, o: &Self) {
        self.pairs += o.pairs;
        self.islands += o.islands;
        self.contacts += o.contacts;
        self.iterations += o.iterations;
        self.unfinished += o.unfinished;
        self.depth = self.depth.max(o.depth);
        self.work += o.work;
        self.driven += o.driven;
    }
}

/// A body of a cluster.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Participant {
    Figure(usize),
    Free(usize),
    /// Fixed or led.
    Firm(usize),
    Ground,
}

/// Two parts that are near.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    participant: [Participant; 2],
    part: [usize; 2],
    near: Near,
    mu: f64,
}

/// Bodies that may meet in this tick, with the buffers for their contacts.
#[derive(Debug, Default)]
struct Cluster {
    figures: (usize, usize),
    free: (usize, usize),
    pairs: Vec<[Participant; 2]>,
    candidates: Vec<Candidate>,
    parent: Vec<usize>,
    block: Vec<Option<usize>>,
    before: Vec<f64>,
    island: Island,
    /// Pairs that meet in stages.
    staged: Vec<[Participant; 2]>,
    /// Candidates that have a row.
    rows: Vec<usize>,
    impact: Impact,
    report: CollisionReport,
}

fn find(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}

fn unite(parent: &mut [usize], i: usize, j: usize) {
    let (a, b) = (find(parent, i), find(parent, j));
    // The smaller index is the root, so that labels do not depend on the order of pairs.
    parent[a.max(b)] = a.min(b);
}

impl Cluster {
    /// A tick of all bodies of the cluster, from the first substep to the reports.
    fn tick(&mut self, world: &TickContext, mut cast: Cast<'_>) {
        self.hand_over(world, &mut cast);
        let h = world.dt / f64::from(world.substeps);
        for f in cast.moved_by_torques() {
            f.begin_substeps();
        }
        for (_, o) in cast.free.iter_mut() {
            o.force = Vec3::zero();
        }
        for i in 0..world.substeps {
            for f in cast.moved_by_torques() {
                f.open_substep(world, i);
            }
            self.find_contacts(&cast, h, f64::from(i) * h);
            for (_, o) in cast.free.iter_mut() {
                o.setup.velocity.z -= h * world.gravity;
            }
            self.solve(world, &mut cast, h, i);
            for f in cast.moved_by_torques() {
                f.close_substep(world, i);
            }
            for (_, o) in cast.free.iter_mut() {
                o.advance(h);
            }
        }
        for f in cast.moved_by_torques() {
            f.end_substeps(world);
            f.finish(world);
        }
    }

    /// Contact acts by forces. From here on, figures with prescribed accelerations that may meet another body in this
    /// tick or the next are moved by torques; the others move alone.
    fn hand_over(&mut self, world: &TickContext, cast: &mut Cast<'_>) {
        if cast.figures.iter().all(|(_, f)| !f.is_prescribed()) {
            return;
        }
        for (_, f) in cast.figures.iter_mut() {
            f.show();
        }
        self.find_contacts(cast, 2.0 * world.dt, 0.0);
        self.report.depth = 0.0; // found again, at the start of the first substep
        // A figure that meets a torque-driven figure is moved by torques too.
        let mut settled = false;
        while !settled {
            settled = true;
            for c in &self.candidates {
                if Self::in_stages(cast, c.participant) {
                    continue;
                }
                for participant in c.participant {
                    if let Participant::Figure(i) = participant
                        && cast.figures[i].1.is_prescribed()
                    {
                        cast.figures[i].1.hand_over();
                        settled = false;
                    }
                }
            }
        }
        self.staged.clear();
        let meeting = self.pairs.iter().filter(|p| Self::in_stages(cast, **p));
        self.staged.extend(meeting);
        let apart = |participant: &Participant| match participant {
            Participant::Figure(i) => cast.figures[*i].1.is_prescribed(),
            _ => false,
        };
        self.pairs.retain(|pair| !pair.iter().any(apart));
        for (_, f) in cast.figures.iter_mut().filter(|(_, f)| f.is_prescribed()) {
            f.integrate_alone(world);
        }
        self.meet(world, cast);
        for (_, f) in cast.figures.iter_mut().filter(|(_, f)| f.moved_alone()) {
            f.finish(world);
        }
    }
}

/// Moves the obstacles that are led.
pub(super) fn lead(obstacles: &mut [(ObstacleKey, Obstacle)], dt: f64) {
    for (_, o) in obstacles {
        if o.setup.mobility == Mobility::Led {
            o.advance(dt);
        }
    }
}
