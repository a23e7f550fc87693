//! The points at which two parts are nearest, or will be at the end of the substep.

use super::cast::{Cast, Posed, PosedShape, posed};
use super::{Candidate, Cluster, Participant};
use crate::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES, SEGMENT_COUNT};
use crate::collide::OBSTACLE_FRICTION;
use crate::collide::narrow::{self, Near};
use crate::collide::shape::Capsule;
use crate::figure::Figure;
use crate::math::Vec3;

/// Parts nearer than this take part in the solve even if they move apart, m.
const NEARBY: f64 = 0.02;
/// Largest number of points between two figures' segments, and between a segment and a flat obstacle.
const POINTS_ROUND: usize = 3;
const POINTS_FLAT: usize = 8;

/// The few points of two parts that will be nearest or deepest at the end of the substep.
struct Best<'a, const N: usize> {
    cast: &'a Cast<'a>,
    participant: [Participant; 2],
    part: [usize; 2],
    h: f64,
    /// Points with their gap now or at the end, whichever is less.
    list: [Option<(Near, f64)>; N],
}

impl<'a, const N: usize> Best<'a, N> {
    fn new(cast: &'a Cast<'a>, participant: [Participant; 2], part: [usize; 2], h: f64) -> Self {
        Self {
            cast,
            participant,
            part,
            h,
            list: [None; N],
        }
    }
    fn push(&mut self, near: Near) {
        let [a, b] = [0, 1].map(|k| {
            self.cast
                .velocity(self.participant[k], self.part[k], near.position)
        });
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

/// Lower bound on the distance of the surface of `shape` from a ball.
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

/// Ball around a segment with the speed of its fastest point.
fn ball(f: &Figure, s: usize) -> (Vec3, f64, f64) {
    let (t, (c, radius)) = (f.substep_dynamics(), f.shape().bound[s]);
    let r = t.kin.rotation[s] * c;
    let v = t.kin.velocity[s] + t.kin.omega[s].cross(r);
    (
        t.segment_position(s) + r,
        radius,
        v.norm() + t.kin.omega[s].norm() * radius,
    )
}

impl Cluster {
    /// Finds all points of the cluster at which bodies may push each other within `h` seconds.
    pub(super) fn find_contacts(&mut self, cast: &Cast<'_>, h: f64, led_for: f64) {
        self.candidates.clear();
        for k in 0..self.pairs.len() {
            let participant = self.pairs[k];
            match participant {
                [Participant::Figure(i), Participant::Figure(j)] => self.figures(cast, [i, j], h),
                [Participant::Figure(i), b] => {
                    if let Some(o) = cast.obstacle(b, led_for) {
                        self.figure_at(cast, i, (b, &o), h);
                    }
                }
                [a, b] => {
                    let Some(x) = cast.obstacle(a, led_for) else {
                        continue;
                    };
                    let y = match b {
                        Participant::Ground => Posed::ground(cast.friction),
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
                participant: best.participant,
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
                let participant = [Participant::Figure(i), Participant::Figure(j)];
                let mut best = Best::<POINTS_ROUND>::new(cast, participant, [s, t], h);
                for c in &a.shape().capsules[s] {
                    let c = posed(a.substep_dynamics(), s, c);
                    for e in &b.shape().capsules[t] {
                        let e = posed(b.substep_dynamics(), t, e);
                        narrow::capsule_points(&c, &e, |near| best.push(near));
                    }
                }
                self.keep(&best, OBSTACLE_FRICTION);
            }
        }
    }

    fn figure_at(&mut self, cast: &Cast<'_>, i: usize, (b, o): (Participant, &Posed), h: f64) {
        let f = &cast.figures[i].1;
        for s in 0..SEGMENT_COUNT {
            let (p, radius, speed) = ball(f, s);
            let other = cast.velocity(b, 0, p).norm();
            if clearance(p, radius, &o.shape) > NEARBY + h * (speed + other) {
                continue;
            }
            let participant = [Participant::Figure(i), b];
            let mut best = Best::<POINTS_FLAT>::new(cast, participant, [s, 0], h);
            if is_foot(s) {
                // Soles are flat, so their own contact points carry, as on the ground.
                let t = f.substep_dynamics();
                for point in &f.body().segments[s].contact_points {
                    if let Some(near) = point_at(t.point_world(s, *point), &o.shape) {
                        best.push(near);
                    }
                }
            }
            for c in &f.shape().capsules[s] {
                round_at(&posed(f.substep_dynamics(), s, c), &o.shape, |near| {
                    best.push(near)
                });
            }
            self.keep(&best, o.friction);
        }
    }

    fn obstacles(&mut self, cast: &Cast<'_>, [(a, x), (b, y)]: [(Participant, &Posed); 2], h: f64) {
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
}
