//! Pairs of bodies that are near each other, and the clusters that follow.

use super::cast::{Cast, posed};
use super::{Cluster, CollisionReport, Participant, find, unite};
use crate::body::topology::SEGMENT_COUNT;
use crate::collide::broad::{self, Bounds};
use crate::collide::narrow;
use crate::collide::{Obstacle, ObstacleKey, Shape};
use crate::figure::{Figure, FigureKey};
use crate::math::Vec3;
use crate::math::vec3::vec3;
use crate::tick_context::TickContext;

/// Distance by which a body may exceed the motion predicted by its speed at the start of a tick, m.
const SLACK: f64 = 0.05;
/// Figures that are placed deeper inside each other than this pass through each other until they have parted, m.
const THROUGH: f64 = 0.03;

/// Pairs of bodies that are near each other, and the clusters that follow.
#[derive(Debug, Default)]
pub(in super::super) struct Neighbourhood {
    bounds: Vec<Bounds>,
    pairs: Vec<(usize, usize)>,
    /// Pairs of figures that were placed inside each other; they do not collide until they have parted. In ascending
    /// order.
    through: Vec<(FigureKey, FigureKey)>,
    still_through: Vec<(FigureKey, FigureKey)>,
    parent: Vec<usize>,
    label: Vec<usize>,
    place: Vec<usize>,
    clusters: Vec<Cluster>,
    count: usize,
    /// Result of the last tick.
    pub(in super::super) report: CollisionReport,
}

/// Label of bodies that are near no other.
const ALONE: usize = usize::MAX;

/// A box around the figure for a tick of `dt`.
fn figure_bounds(f: &Figure, body: usize, dt: f64) -> Bounds {
    let (t, shape) = (f.placement(), f.shape());
    let (mut low, mut high) = (t.segment_position(0), t.segment_position(0));
    for s in 0..SEGMENT_COUNT {
        let (centre, radius) = shape.bound[s];
        let r = t.kin.rotation[s] * centre;
        let p = t.segment_position(s) + r;
        let speed = (t.kin.velocity[s] + t.kin.omega[s].cross(r)).norm();
        let reach = radius + SLACK + 1.5 * dt * speed;
        low = vec3(
            low.x.min(p.x - reach),
            low.y.min(p.y - reach),
            low.z.min(p.z - reach),
        );
        high = vec3(
            high.x.max(p.x + reach),
            high.y.max(p.y + reach),
            high.z.max(p.z + reach),
        );
    }
    Bounds {
        low,
        high,
        body,
        moves: true,
    }
}

/// A box around the obstacle for a tick of `dt`.
fn obstacle_bounds(o: &Obstacle, body: usize, dt: f64) -> Bounds {
    let s = o.setup();
    let reach = match s.shape {
        Shape::Plane => vec3(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        Shape::Box { half } => {
            let (a, w) = (o.axes(), s.angular_velocity.norm() * dt * half.norm());
            let e =
                |r: Vec3| (r.x * half.x).abs() + (r.y * half.y).abs() + (r.z * half.z).abs() + w;
            vec3(
                e(vec3(a.x.x, a.y.x, a.z.x)),
                e(vec3(a.x.y, a.y.y, a.z.y)),
                e(vec3(a.x.z, a.y.z, a.z.z)),
            )
        }
        _ => vec3(1.0, 1.0, 1.0) * s.shape.reach(),
    };
    let more = SLACK + 1.5 * dt * s.velocity.norm();
    let reach = reach + vec3(more, more, more);
    Bounds {
        low: s.position - reach,
        high: s.position + reach,
        body,
        moves: o.mass().is_some(),
    }
}

impl Neighbourhood {
    /// State for the next tick: the pairs that pass through each other, and the report of the last tick.
    pub(in super::super) fn saved(&self) -> (&[(FigureKey, FigureKey)], &CollisionReport) {
        (&self.through, &self.report)
    }

    /// Restores the values of [`Self::saved`]. `through` is sorted.
    pub(in super::super) fn restored(
        mut through: Vec<(FigureKey, FigureKey)>,
        report: CollisionReport,
    ) -> Self {
        through.sort_unstable();
        Self {
            through,
            report,
            ..Self::default()
        }
    }

    /// Forgets a removed figure, which passes through no other from now on.
    pub(in super::super) fn forget(&mut self, key: FigureKey) {
        self.through.retain(|(a, b)| *a != key && *b != key);
    }

    /// Whether the last [`Self::gather`] found a cluster.
    pub(in super::super) fn any(&self) -> bool {
        self.count > 0
    }

    /// Finds the pairs that may meet, and orders `figures` and `obstacles` by cluster. Single bodies come last, and
    /// obstacles that do not move freely come after all that do. Returns the number of figures in clusters.
    pub(in super::super) fn gather(
        &mut self,
        figures: &mut [(FigureKey, Box<Figure>)],
        obstacles: &mut [(ObstacleKey, Obstacle)],
        dt: f64,
        on: bool,
    ) -> usize {
        self.report = CollisionReport::default();
        self.count = 0;
        let nf = figures.len();
        if !on || (nf < 2 && obstacles.is_empty()) {
            return 0;
        }
        self.bounds.clear();
        for (i, (_, f)) in figures.iter().enumerate() {
            if !f.is_frozen() {
                self.bounds.push(figure_bounds(f, i, dt));
            }
        }
        for (i, (_, o)) in obstacles.iter().enumerate() {
            self.bounds.push(obstacle_bounds(o, nf + i, dt));
        }
        broad::pairs(&mut self.bounds, &mut self.pairs);
        self.pass_through(figures);
        self.report.pairs = self.pairs.len() as u64;
        let total = nf + obstacles.len();
        let moves = |i: usize| i < nf || obstacles[i - nf].1.mass().is_some();
        self.parent.clear();
        self.parent.extend(0..total);
        self.label.clear();
        self.label.resize(total, ALONE);
        for (i, j) in &self.pairs {
            if moves(*i) && moves(*j) {
                unite(&mut self.parent, *i, *j);
            }
        }
        // Every free body is in a cluster, even if only with the ground.
        let near = self.pairs.iter().flat_map(|(i, j)| [*i, *j]);
        for i in near.chain(nf..total).filter(|i| moves(*i)) {
            self.label[i] = 0;
        }
        for i in 0..total {
            if self.label[i] != ALONE {
                let root = find(&mut self.parent, i);
                self.label[i] = if root == i {
                    self.count += 1;
                    self.count - 1
                } else {
                    self.label[root]
                };
            }
        }
        if self.count == 0 {
            return 0;
        }
        if self.clusters.len() < self.count {
            self.clusters.resize_with(self.count, Cluster::default);
        }
        self.sort(figures, obstacles);
        self.label[..nf].iter().filter(|l| **l != ALONE).count()
    }

    /// Leaves out the pairs of figures that were placed inside each other and have not parted since.
    fn pass_through(&mut self, figures: &mut [(FigureKey, Box<Figure>)]) {
        let Self {
            pairs,
            through,
            still_through,
            ..
        } = self;
        still_through.clear();
        pairs.retain(|(i, j)| {
            let (Some((ki, a)), Some((kj, b))) = (figures.get(*i), figures.get(*j)) else {
                return true;
            };
            let known = through.binary_search(&(*ki, *kj)).is_ok();
            let passes = if a.neighbours.is_new || b.neighbours.is_new {
                overlap(a, b)
            } else {
                known
            };
            if passes {
                still_through.push((*ki, *kj));
            }
            !passes
        });
        std::mem::swap(through, still_through);
        for (_, f) in figures {
            f.neighbours.is_new = false;
        }
    }

    fn sort(
        &mut self,
        figures: &mut [(FigureKey, Box<Figure>)],
        obstacles: &mut [(ObstacleKey, Obstacle)],
    ) {
        let nf = figures.len();
        for (i, (_, f)) in figures.iter_mut().enumerate() {
            f.neighbours.cluster = self.label[i];
        }
        for (i, (_, o)) in obstacles.iter_mut().enumerate() {
            o.cluster = self.label[nf + i];
        }
        // Compute all destinations before moving anything.
        let place = &mut self.place;
        place.clear();
        place.resize(self.label.len(), 0);
        for c in &mut self.clusters[..self.count] {
            (c.figures, c.free) = ((0, 0), (0, 0));
            c.pairs.clear();
            c.report = CollisionReport::default();
        }
        for l in &self.label[..nf] {
            if *l != ALONE {
                self.clusters[*l].figures.1 += 1;
            }
        }
        for l in &self.label[nf..] {
            if *l != ALONE {
                self.clusters[*l].free.1 += 1;
            }
        }
        let (mut f, mut o) = (0, 0);
        for c in &mut self.clusters[..self.count] {
            c.figures = (f, f + c.figures.1);
            c.free = (o, o + c.free.1);
            (f, o) = (c.figures.1, c.free.1);
        }
        // `place` of a member is its index in its cluster's slice; of a firm obstacle, its index among those.
        let mut firm = 0;
        for (i, l) in self.label.iter().enumerate() {
            if *l == ALONE {
                if i >= nf {
                    place[i] = firm;
                    firm += 1;
                }
                continue;
            }
            let before = if i < nf { 0..i } else { nf..i };
            place[i] = self.label[before].iter().filter(|m| *m == l).count();
        }
        for (i, j) in &self.pairs {
            let participant = |k: usize| {
                if k < nf {
                    Participant::Figure(place[k])
                } else if self.label[k] == ALONE {
                    Participant::Firm(place[k])
                } else {
                    Participant::Free(place[k])
                }
            };
            let (a, b) = (participant(*i), participant(*j));
            // Figures come first by index; of two obstacles, the moving one comes first.
            let (a, b, k) = if matches!(a, Participant::Firm(_)) {
                (b, a, *j)
            } else {
                (a, b, *i)
            };
            self.clusters[self.label[k]].pairs.push([a, b]);
        }
        for (k, l) in self.label.iter().enumerate().skip(nf) {
            if *l != ALONE {
                self.clusters[*l]
                    .pairs
                    .push([Participant::Free(place[k]), Participant::Ground]);
            }
        }
        figures.sort_unstable_by_key(|(k, f)| (f.neighbours.cluster, *k));
        obstacles.sort_unstable_by_key(|(k, o)| (o.cluster, *k));
    }

    /// Stage 6 and the later stages, for all clusters. `figures` and `obstacles` as [`Self::gather`] ordered them.
    pub(in super::super) fn simulate(
        &mut self,
        world: &TickContext,
        friction: f64,
        threads: usize,
        figures: &mut [(FigureKey, Box<Figure>)],
        obstacles: &mut [(ObstacleKey, Obstacle)],
    ) {
        let free = self.clusters[..self.count].last().map_or(0, |c| c.free.1);
        let (mut free, firm) = obstacles.split_at_mut(free);
        let firm = &*firm;
        let mut figures = figures;
        let clusters = &mut self.clusters[..self.count];
        let mut jobs = clusters.iter_mut().map(|c| {
            let (mine, rest) = std::mem::take(&mut figures).split_at_mut(c.figures.1 - c.figures.0);
            figures = rest;
            let (bodies, rest) = std::mem::take(&mut free).split_at_mut(c.free.1 - c.free.0);
            free = rest;
            let cast = Cast {
                figures: mine,
                free: bodies,
                firm,
                friction,
            };
            (c, cast)
        });
        if threads <= 1 {
            for (cluster, cast) in jobs {
                cluster.tick(world, cast);
            }
        } else {
            let mut all: Vec<_> = jobs.by_ref().collect();
            let share = all.len().div_ceil(threads);
            std::thread::scope(|scope| {
                while !all.is_empty() {
                    let mine: Vec<_> = all.drain(..share.min(all.len())).collect();
                    scope.spawn(move || {
                        for (cluster, cast) in mine {
                            cluster.tick(world, cast);
                        }
                    });
                }
            });
        }
        for c in &self.clusters[..self.count] {
            self.report.add(&c.report);
        }
    }
}

/// Whether two figures overlap more deeply than touching can explain.
fn overlap(a: &Figure, b: &Figure) -> bool {
    (0..SEGMENT_COUNT).any(|s| {
        a.shape().capsules[s].iter().any(|c| {
            let c = posed(a.placement(), s, c);
            (0..SEGMENT_COUNT).any(|t| {
                b.shape().capsules[t]
                    .iter()
                    .any(|e| narrow::capsules(&c, &posed(b.placement(), t, e)).gap < -THROUGH)
            })
        })
    })
}
