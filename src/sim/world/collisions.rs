//! Stage 6 of a tick for everything that is near something else: who is near whom, what touches, and one solve for all that touch.

use crate::sim::body::SegmentId;
use crate::sim::body::topology::{L_FOOT, L_TOES, NV, R_FOOT, R_TOES, SEGMENT_COUNT};
use crate::sim::collide::broad::{self, Bounds};
use crate::sim::collide::island::Island;
use crate::sim::collide::narrow::{self, Near, PosedBox};
use crate::sim::collide::shape::Capsule;
use crate::sim::collide::touch::MAX_ISLAND_CONTACTS as MAX_CONTACTS;
use crate::sim::collide::{Mobility, Obstacle, ObstacleKey, Other, Shape};
use crate::sim::dynamics::Terms;
use crate::sim::dynamics::jacobian::for_each_column;
use crate::sim::figure::touches::Contacting;
use crate::sim::figure::{Figure, FigureKey, TickContext};
use crate::sim::math::Vec3;
use crate::sim::math::vec3::vec3;

/// Parts nearer than this take part in the solve even if they move apart, m.
const NEARBY: f64 = 0.02;
/// How much a body may exceed the way that its speed at the start of a tick predicts, m.
const SLACK: f64 = 0.05;
/// Figures that are put deeper into each other than this pass through each other until they have parted, m.
const THROUGH: f64 = 0.03;
/// Friction between two figures: skin and cloth.
const FIGURE_FRICTION: f64 = 0.6;
/// Compliance of a contact between bodies, 1/kg.
const COMPLIANCE: f64 = 1e-4;
/// Share of a penetration beyond the slop that is taken back per substep.
const RETURN_SHARE: f64 = 0.2;
/// Penetration that is left alone, m.
const SLOP: f64 = 1e-4;
/// Fastest push-out, m/s.
const RETURN_SPEED: f64 = 1.0;
/// Most points between two figures' segments, and between a segment and a flat thing.
const POINTS_ROUND: usize = 3;
const POINTS_FLAT: usize = 8;

/// What the collisions of one tick came to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
    /// Work of contacts between bodies, J: impulse times the mean of the relative velocities before and after; never positive but for
    /// the return from overlaps and the work of led obstacles.
    pub work: f64,
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
    }
}

/// A body of a cluster.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Who {
    Figure(usize),
    Free(usize),
    /// Fixed or led.
    Firm(usize),
    Ground,
}

/// Two parts that are near.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    who: [Who; 2],
    part: [usize; 2],
    near: Near,
    mu: f64,
}

/// Bodies that may meet in this tick, with the buffers to let them.
#[derive(Debug, Default)]
pub(super) struct Cluster {
    figures: (usize, usize),
    free: (usize, usize),
    pairs: Vec<[Who; 2]>,
    candidates: Vec<Candidate>,
    parent: Vec<usize>,
    block: Vec<Option<usize>>,
    before: Vec<f64>,
    island: Island,
    report: CollisionReport,
}

/// Who is near whom, and the clusters that follow.
#[derive(Debug, Default)]
pub(super) struct Neighbourhood {
    bounds: Vec<Bounds>,
    pairs: Vec<(usize, usize)>,
    /// Figures that were put into each other: they do not meet before they have parted. In ascending order.
    through: Vec<(FigureKey, FigureKey)>,
    still_through: Vec<(FigureKey, FigureKey)>,
    parent: Vec<usize>,
    label: Vec<usize>,
    place: Vec<usize>,
    clusters: Vec<Cluster>,
    count: usize,
    /// Result of the last tick.
    pub(super) report: CollisionReport,
}

/// Label of what is near nothing.
pub(super) const ALONE: usize = usize::MAX;

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

/// A box around the figure for a tick of `dt`.
fn figure_bounds(f: &Figure, body: usize, dt: f64) -> Bounds {
    let (t, shape) = (f.tick_terms(), f.shape());
    let (mut low, mut high) = (t.com, t.com);
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
    /// True if the last [`Self::gather`] found a cluster.
    pub(super) fn any(&self) -> bool {
        self.count > 0
    }

    /// Finds who may meet whom and orders `figures` and `obstacles` by cluster; what is alone comes last, and obstacles that do not move
    /// freely after all that do. Returns how many figures are in clusters.
    pub(super) fn gather(
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
        // Every free body is in a cluster, if only with the ground.
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

    /// Leaves out the pairs of figures that were put into each other and have not parted since.
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
            let passes = if a.is_new || b.is_new {
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
            f.is_new = false;
        }
    }

    fn sort(
        &mut self,
        figures: &mut [(FigureKey, Box<Figure>)],
        obstacles: &mut [(ObstacleKey, Obstacle)],
    ) {
        let nf = figures.len();
        for (i, (_, f)) in figures.iter_mut().enumerate() {
            f.cluster = self.label[i];
        }
        for (i, (_, o)) in obstacles.iter_mut().enumerate() {
            o.cluster = self.label[nf + i];
        }
        // Where everything goes, before it goes there.
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
            let who = |k: usize| {
                if k < nf {
                    Who::Figure(place[k])
                } else if self.label[k] == ALONE {
                    Who::Firm(place[k])
                } else {
                    Who::Free(place[k])
                }
            };
            let (a, b) = (who(*i), who(*j));
            // Figures come first by index; of two obstacles the one that moves.
            let (a, b, k) = if matches!(a, Who::Firm(_)) {
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
                    .push([Who::Free(place[k]), Who::Ground]);
            }
        }
        figures.sort_unstable_by_key(|(k, f)| (f.cluster, *k));
        obstacles.sort_unstable_by_key(|(k, o)| (o.cluster, *k));
    }

    /// Stage 6 and what follows, for all clusters. `figures` and `obstacles` as [`Self::gather`] ordered them.
    pub(super) fn simulate(
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

/// The bodies of one cluster.
struct Cast<'a> {
    figures: &'a mut [(FigureKey, Box<Figure>)],
    free: &'a mut [(ObstacleKey, Obstacle)],
    firm: &'a [(ObstacleKey, Obstacle)],
    friction: f64,
}

impl Cast<'_> {
    /// Velocity of a world point of a part.
    fn velocity(&self, who: Who, part: usize, p: Vec3) -> Vec3 {
        match who {
            Who::Figure(i) => {
                let t = self.figures[i].1.substep_terms();
                t.kin.velocity[part] + t.kin.omega[part].cross(p - t.segment_position(part))
            }
            Who::Free(i) => self.free[i].1.point_velocity(p),
            Who::Firm(i) => self.firm[i].1.point_velocity(p),
            Who::Ground => Vec3::zero(),
        }
    }

    fn other(&self, who: Who, part: usize) -> Option<Other> {
        match who {
            Who::Figure(i) => Some(Other::Figure(self.figures[i].0.0, SegmentId::new(part)?)),
            Who::Free(i) => Some(Other::Obstacle(self.free[i].0)),
            Who::Firm(i) => Some(Other::Obstacle(self.firm[i].0)),
            Who::Ground => None,
        }
    }

    /// The obstacle behind a body, and for how long it has moved since its pose was stored.
    fn obstacle(&self, who: Who, led_for: f64) -> Option<Posed> {
        match who {
            Who::Free(i) => Some(Posed::new(&self.free[i].1, 0.0)),
            Who::Firm(i) => Some(Posed::new(&self.firm[i].1, led_for)),
            _ => None,
        }
    }
}

/// An obstacle's shape in the world.
struct Posed {
    shape: PosedShape,
    friction: f64,
}

enum PosedShape {
    Round(Capsule),
    Box(PosedBox),
    Plane { origin: Vec3, normal: Vec3 },
}

impl Posed {
    fn new(o: &Obstacle, later: f64) -> Self {
        let s = o.setup();
        let (position, axes) = o.pose_after(later);
        let shape = match s.shape {
            Shape::Box { half } => PosedShape::Box(PosedBox {
                centre: position,
                axes,
                half,
            }),
            Shape::Plane => PosedShape::Plane {
                origin: position,
                normal: axes.z,
            },
            round => {
                let c = round.capsule().expect("spheres and capsules are round");
                PosedShape::Round(Capsule {
                    a: position + axes * c.a,
                    b: position + axes * c.b,
                    ..c
                })
            }
        };
        Self {
            shape,
            friction: s.friction,
        }
    }

    fn ground(friction: f64) -> Self {
        Self {
            shape: PosedShape::Plane {
                origin: Vec3::zero(),
                normal: Vec3::Z,
            },
            friction,
        }
    }
}

/// The few points of two parts that will be nearest, or deepest, at the end of the substep.
struct Best<'a, const N: usize> {
    cast: &'a Cast<'a>,
    who: [Who; 2],
    part: [usize; 2],
    h: f64,
    /// Points with their gap now or at the end, whichever is less.
    list: [Option<(Near, f64)>; N],
}

impl<'a, const N: usize> Best<'a, N> {
    fn new(cast: &'a Cast<'a>, who: [Who; 2], part: [usize; 2], h: f64) -> Self {
        Self {
            cast,
            who,
            part,
            h,
            list: [None; N],
        }
    }
    fn push(&mut self, near: Near) {
        let [a, b] = [0, 1].map(|k| self.cast.velocity(self.who[k], self.part[k], near.position));
        let rate = (a - b).dot(near.normal);
        let end = near.gap.min(near.gap + self.h * rate);
        if near.gap >= NEARBY && end >= 0.0 {
            return;
        }
        let twin = |o: &&mut Option<(Near, f64)>| {
            o.is_some_and(|(o, _)| (o.position - near.position).norm() < narrow::MERGE)
        };
        if let Some(slot) = self.list.iter_mut().find(twin) {
            if slot.is_some_and(|(_, e)| end < e) {
                *slot = Some((near, end));
            }
            return;
        }
        let mut x = (near, end);
        for slot in &mut self.list {
            match slot {
                None => {
                    *slot = Some(x);
                    return;
                }
                Some(old) if x.1 < old.1 => std::mem::swap(old, &mut x),
                Some(_) => {}
            }
        }
    }
}

fn is_foot(s: usize) -> bool {
    [L_FOOT, L_TOES, R_FOOT, R_TOES]
        .iter()
        .any(|f| f.index() == s)
}

/// A round thing (A) at a shape (B).
fn round_at(c: &Capsule, shape: &PosedShape, mut emit: impl FnMut(Near)) {
    match shape {
        PosedShape::Round(o) => narrow::capsule_points(c, o, emit),
        PosedShape::Box(b) => narrow::capsule_box(c, b, emit),
        PosedShape::Plane { origin, normal } => {
            emit(narrow::ball_plane(c.a, c.ra, *origin, *normal));
            if (c.b - c.a).norm() > 1e-6 {
                emit(narrow::ball_plane(c.b, c.rb, *origin, *normal));
            }
        }
    }
}

/// A point (A) at a flat shape (B).
fn point_at(p: Vec3, shape: &PosedShape) -> Option<Near> {
    match shape {
        PosedShape::Round(_) => None,
        PosedShape::Box(b) => Some(narrow::ball_box(p, 0.0, b)),
        PosedShape::Plane { origin, normal } => Some(narrow::ball_plane(p, 0.0, *origin, *normal)),
    }
}

/// Distance of the surface of `shape` from a ball, at least.
fn clearance(p: Vec3, radius: f64, shape: &PosedShape) -> f64 {
    match shape {
        PosedShape::Round(c) => {
            let ball = Capsule {
                a: p,
                b: p,
                ra: radius,
                rb: radius,
            };
            narrow::capsules(&ball, c).gap
        }
        PosedShape::Box(b) => narrow::ball_box(p, radius, b).gap,
        PosedShape::Plane { origin, normal } => (p - *origin).dot(*normal) - radius,
    }
}

/// True if two figures are deeper in each other than touching can explain.
fn overlap(a: &Figure, b: &Figure) -> bool {
    (0..SEGMENT_COUNT).any(|s| {
        a.shape().capsules[s].iter().any(|c| {
            let c = posed(a.tick_terms(), s, c);
            (0..SEGMENT_COUNT).any(|t| {
                b.shape().capsules[t]
                    .iter()
                    .any(|e| narrow::capsules(&c, &posed(b.tick_terms(), t, e)).gap < -THROUGH)
            })
        })
    })
}

fn posed(t: &Terms, s: usize, c: &Capsule) -> Capsule {
    let (p, r) = (t.segment_position(s), t.segment_rotation(s));
    Capsule {
        a: p + r * c.a,
        b: p + r * c.b,
        ..*c
    }
}

/// Ball around a segment with the speed of its fastest point.
fn ball(f: &Figure, s: usize) -> (Vec3, f64, f64) {
    let (t, (c, radius)) = (f.substep_terms(), f.shape().bound[s]);
    let r = t.kin.rotation[s] * c;
    let v = t.kin.velocity[s] + t.kin.omega[s].cross(r);
    (
        t.segment_position(s) + r,
        radius,
        v.norm() + t.kin.omega[s].norm() * radius,
    )
}

impl Cluster {
    /// A tick of all bodies of the cluster, from the first substep to the reports.
    fn tick(&mut self, world: &TickContext, mut cast: Cast<'_>) {
        let h = world.dt / f64::from(world.substeps);
        for (_, f) in cast.figures.iter_mut() {
            f.begin_substeps();
        }
        for (_, o) in cast.free.iter_mut() {
            o.force = Vec3::zero();
        }
        for i in 0..world.substeps {
            for (_, f) in cast.figures.iter_mut() {
                f.open_substep(world, i);
            }
            self.find_contacts(&cast, h, f64::from(i) * h);
            for (_, o) in cast.free.iter_mut() {
                o.setup.velocity.z -= h * world.gravity;
            }
            self.solve(world, &mut cast, h, i);
            for (_, f) in cast.figures.iter_mut() {
                f.close_substep(world, i);
            }
            for (_, o) in cast.free.iter_mut() {
                o.advance(h);
            }
        }
        for (_, f) in cast.figures.iter_mut() {
            f.end_substeps(world);
            f.finish(world);
        }
    }

    fn find_contacts(&mut self, cast: &Cast<'_>, h: f64, led_for: f64) {
        self.candidates.clear();
        for k in 0..self.pairs.len() {
            let who = self.pairs[k];
            match who {
                [Who::Figure(i), Who::Figure(j)] => self.figures(cast, [i, j], h),
                [Who::Figure(i), b] => {
                    if let Some(o) = cast.obstacle(b, led_for) {
                        self.figure_at(cast, i, (b, &o), h);
                    }
                }
                [a, b] => {
                    let Some(x) = cast.obstacle(a, led_for) else {
                        continue;
                    };
                    let y = match b {
                        Who::Ground => Posed::ground(cast.friction),
                        _ => match cast.obstacle(b, led_for) {
                            Some(y) => y,
                            None => continue,
                        },
                    };
                    self.obstacles(cast, [(a, &x), (b, &y)], h);
                }
            }
        }
    }

    /// Keeps the points that matter.
    fn keep<const N: usize>(&mut self, best: &Best<'_, N>, mu: f64) {
        for (near, _) in best.list.iter().flatten() {
            self.report.depth = self.report.depth.max(-near.gap);
            self.candidates.push(Candidate {
                who: best.who,
                part: best.part,
                near: *near,
                mu,
            });
        }
    }

    fn figures(&mut self, cast: &Cast<'_>, [i, j]: [usize; 2], h: f64) {
        let (a, b) = (&cast.figures[i].1, &cast.figures[j].1);
        let others: [_; SEGMENT_COUNT] = std::array::from_fn(|s| ball(b, s));
        for s in 0..SEGMENT_COUNT {
            let (p, ra, va) = ball(a, s);
            for (t, (q, rb, vb)) in others.iter().enumerate() {
                let reach = ra + rb + NEARBY + h * (va + vb);
                let d = p - *q;
                if d.dot(d) > reach * reach {
                    continue;
                }
                let who = [Who::Figure(i), Who::Figure(j)];
                let mut best = Best::<POINTS_ROUND>::new(cast, who, [s, t], h);
                for c in &a.shape().capsules[s] {
                    let c = posed(a.substep_terms(), s, c);
                    for e in &b.shape().capsules[t] {
                        let e = posed(b.substep_terms(), t, e);
                        narrow::capsule_points(&c, &e, |near| best.push(near));
                    }
                }
                self.keep(&best, FIGURE_FRICTION);
            }
        }
    }

    fn figure_at(&mut self, cast: &Cast<'_>, i: usize, (b, o): (Who, &Posed), h: f64) {
        let f = &cast.figures[i].1;
        for s in 0..SEGMENT_COUNT {
            let (p, radius, speed) = ball(f, s);
            let other = cast.velocity(b, 0, p).norm();
            if clearance(p, radius, &o.shape) > NEARBY + h * (speed + other) {
                continue;
            }
            let who = [Who::Figure(i), b];
            let mut best = Best::<POINTS_FLAT>::new(cast, who, [s, 0], h);
            if is_foot(s) {
                // Soles are flat: their own points carry, as on the ground.
                let t = f.substep_terms();
                for point in &f.body().segments[s].contact_points {
                    if let Some(near) = point_at(t.point_world(s, *point), &o.shape) {
                        best.push(near);
                    }
                }
            }
            for c in &f.shape().capsules[s] {
                round_at(&posed(f.substep_terms(), s, c), &o.shape, |near| {
                    best.push(near)
                });
            }
            self.keep(&best, o.friction);
        }
    }

    fn obstacles(&mut self, cast: &Cast<'_>, [(a, x), (b, y)]: [(Who, &Posed); 2], h: f64) {
        let mut best = Best::<POINTS_FLAT>::new(cast, [a, b], [0, 0], h);
        match (&x.shape, &y.shape) {
            (PosedShape::Round(c), other) => round_at(c, other, |near| best.push(near)),
            (other, PosedShape::Round(c)) => round_at(c, other, |near| best.push(near.flipped())),
            (PosedShape::Box(p), other) => {
                for corner in narrow::corners(p) {
                    if let Some(near) = point_at(corner, other) {
                        best.push(near);
                    }
                }
                if let PosedShape::Box(q) = other {
                    for corner in narrow::corners(q) {
                        best.push(narrow::ball_box(corner, 0.0, p).flipped());
                    }
                }
            }
            (PosedShape::Plane { .. }, _) => {} // planes do not move
        }
        self.keep(&best, x.friction.min(y.friction));
    }

    /// Solves every island of bodies that are near each other, and lets the impulses act.
    fn solve(&mut self, world: &TickContext, cast: &mut Cast<'_>, h: f64, substep: u32) {
        if self.candidates.is_empty() {
            return;
        }
        let nf = cast.figures.len();
        let total = nf + cast.free.len();
        let index = |who: Who| match who {
            Who::Figure(i) => Some(i),
            Who::Free(i) => Some(nf + i),
            _ => None,
        };
        self.parent.clear();
        self.parent.extend(0..total);
        for c in &self.candidates {
            if let (Some(i), Some(j)) = (index(c.who[0]), index(c.who[1])) {
                unite(&mut self.parent, i, j);
            }
        }
        for root in 0..total {
            if find(&mut self.parent, root) != root {
                continue;
            }
            let parent = &mut self.parent;
            self.block.clear();
            self.block.resize(total, None);
            let mut mine = |c: &Candidate| index(c.who[0]).is_some_and(|i| find(parent, i) == root);
            // Too many: the deepest stay.
            let count = self.candidates.iter().filter(|c| mine(c)).count();
            if count == 0 {
                continue;
            }
            let mut limit = f64::INFINITY;
            if count > MAX_CONTACTS {
                self.before.clear();
                let gaps = self
                    .candidates
                    .iter()
                    .filter(|c| mine(c))
                    .map(|c| c.near.gap);
                self.before.extend(gaps);
                self.before.sort_unstable_by(f64::total_cmp);
                limit = self.before[MAX_CONTACTS];
            }
            self.island.clear();
            for c in &self.candidates {
                if !mine(c) || c.near.gap >= limit {
                    continue;
                }
                let mut block = [None; 2];
                for side in 0..2 {
                    let Some(i) = index(c.who[side]) else {
                        continue;
                    };
                    block[side] = Some(match self.block[i] {
                        Some(k) => k,
                        None => {
                            let k = add_block(&mut self.island, cast, i);
                            self.block[i] = Some(k);
                            k
                        }
                    });
                }
                add_contact(&mut self.island, cast, c, block, index, h);
            }
            if self.island.is_active(cast.figures) {
                self.finish_island(world, cast, h, substep);
            }
        }
    }

    fn finish_island(&mut self, world: &TickContext, cast: &mut Cast<'_>, h: f64, substep: u32) {
        let nf = cast.figures.len();
        let before = |cast: &Cast<'_>, who: (usize, usize), p: Vec3| {
            let body = if who.0 < nf {
                Who::Figure(who.0)
            } else if who.0 < nf + cast.free.len() {
                Who::Free(who.0 - nf)
            } else if who.0 == usize::MAX {
                Who::Ground
            } else {
                Who::Firm(who.0 - nf - cast.free.len())
            };
            (body, cast.velocity(body, who.1, p))
        };
        let outcome = self.island.solve(cast.figures);
        let r = &mut self.report;
        r.islands += 1;
        r.iterations += u64::from(outcome.iterations);
        r.unfinished += u64::from(!outcome.converged);
        // What acts on each body.
        for i in 0..nf {
            if self.block[i].is_none() {
                continue;
            }
            let impulse = self.island.figure_impulse(i).expect("it has a block");
            let figure = &mut cast.figures[i].1;
            if impulse == [0.0; NV] {
                // Near, but not touched: the same bits as if it were alone.
                figure.open_substep(world, substep);
            } else {
                figure.touch(impulse, outcome);
            }
        }
        for k in 0..self.island.contacts().len() {
            let c = &self.island.contacts()[k];
            let impulse = c.world_impulse();
            if impulse == Vec3::zero() {
                continue;
            }
            r.contacts += 1;
            let (a, va) = before(cast, c.ends[0], c.position);
            let (b, vb) = before(cast, c.ends[1], c.position);
            let gravity = |who: Who| match who {
                Who::Free(_) => Vec3::Z * (h * world.gravity),
                _ => Vec3::zero(),
            };
            let u0 = va + gravity(a) - vb - gravity(b);
            r.work += 0.5 * impulse.dot(u0) + 0.5 * c.work_after();
            for (who, part, sign, other) in [
                (a, c.ends[0].1, 1.0, (b, c.ends[1].1)),
                (b, c.ends[1].1, -1.0, (a, c.ends[0].1)),
            ] {
                if let (Who::Figure(i), Some(other)) = (who, cast.other(other.0, other.1)) {
                    let what = Contacting {
                        segment: SegmentId::new(part).expect("parts of figures are segments"),
                        other,
                        position: c.position,
                        impulse: impulse * sign,
                        normal: c.frame[2] * sign,
                        depth: (-c.gap).max(0.0),
                    };
                    cast.figures[i].1.record(&what, h, world.dt);
                }
            }
        }
        for i in 0..cast.free.len() {
            if self.block[nf + i].is_some() {
                let (linear, moment) = self.island.free_impulse(i).expect("it has a block");
                let o = &mut cast.free[i].1;
                o.push(linear, moment);
                o.force += linear * (1.0 / world.dt);
            }
        }
    }
}

fn add_block(island: &mut Island, cast: &Cast<'_>, i: usize) -> usize {
    let nf = cast.figures.len();
    if i < nf {
        return island.add_figure(i);
    }
    let o = &cast.free[i - nf].1;
    let (s, m) = (o.setup(), o.mass().expect("free bodies have a mass"));
    island.add_free(
        i - nf,
        m,
        o.inertia(),
        [o.spin(), s.velocity * m],
        [s.angular_velocity, s.velocity],
    )
}

fn add_contact(
    island: &mut Island,
    cast: &Cast<'_>,
    c: &Candidate,
    block: [Option<usize>; 2],
    index: impl Fn(Who) -> Option<usize>,
    h: f64,
) {
    let n = &c.near;
    let nf = cast.figures.len();
    let approach = if n.gap > 0.0 {
        n.gap / h
    } else {
        -(RETURN_SHARE * (-n.gap - SLOP).max(0.0) / h).min(RETURN_SPEED)
    };
    // What moves by itself brings its velocity along; the second body is the one that can be firm.
    let firm = match block[1] {
        None => cast.velocity(c.who[1], c.part[1], n.position),
        Some(_) => Vec3::zero(),
    };
    let end = |side: usize| {
        let body = index(c.who[side]).unwrap_or(match c.who[side] {
            Who::Firm(k) => nf + cast.free.len() + k,
            _ => usize::MAX,
        });
        (body, c.part[side])
    };
    island.add_contact(
        block,
        [end(0), end(1)],
        (n.position, n.normal, n.gap),
        (approach, firm, c.mu),
        1.0 / COMPLIANCE,
        |side, visit| match c.who[side] {
            Who::Figure(i) => {
                let t = cast.figures[i].1.substep_terms();
                let r = n.position - t.state.posture.root_position;
                for_each_column(&t.kin, c.part[side], r, |k, _, v| visit(k, v));
            }
            Who::Free(i) => {
                let r = n.position - cast.free[i].1.setup().position;
                for (k, e) in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().enumerate() {
                    visit(k, e.cross(r));
                    visit(3 + k, e);
                }
            }
            _ => {}
        },
    );
}

/// Moves the obstacles that are led.
pub(super) fn lead(obstacles: &mut [(ObstacleKey, Obstacle)], dt: f64) {
    for (_, o) in obstacles {
        if o.setup.mobility == Mobility::Led {
            o.advance(dt);
        }
    }
}
