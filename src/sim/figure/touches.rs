//! What a figure touches besides the ground: sums over a tick, and what it knows of them in the next.

use super::events::{FigureEvent, Watcher};
use crate::sim::body::SegmentId;
use crate::sim::collide::{MAX_TOUCHES, Other, Touch};
use crate::sim::dynamics::Terms;
use crate::sim::dynamics::jacobian::for_each_column;
use crate::sim::math::Vec3;
use crate::sim::support::Rest;

/// Part of a reaction that a controller takes in per tick: a blow is over before it is known, a seat is known after some ticks.
const LEARN: f64 = 0.15;
/// Largest reaction a controller counts on, N.
const MOST: f64 = 2000.0;

/// One contact of a substep, as one figure sees it.
#[derive(Clone, Copy, Debug)]
pub struct Contacting {
    /// Own segment.
    pub segment: SegmentId,
    /// What it touches.
    pub other: Other,
    /// World, m.
    pub position: Vec3,
    /// Impulse on this figure, world axes, N·s.
    pub impulse: Vec3,
    /// From the other body to this one.
    pub normal: Vec3,
    /// Overlap, m.
    pub depth: f64,
    /// The other is an obstacle that nothing moves.
    pub firm: bool,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    touch: Touch,
    /// Sum of normal forces, weight of the mean position, N.
    weight: f64,
    /// Where on the segment, segment frame, m.
    local: Vec3,
    /// Reaction that controllers count on, N.
    expected: Vec3,
    firm: bool,
}

/// Touches of one tick and of the one before.
#[derive(Clone, Debug)]
pub struct Touches {
    now: Vec<Entry>,
    before: Vec<Entry>,
}

impl Default for Touches {
    fn default() -> Self {
        Self {
            now: Vec::with_capacity(MAX_TOUCHES),
            before: Vec::with_capacity(MAX_TOUCHES),
        }
    }
}

fn key(e: &Entry) -> (SegmentId, Other) {
    (e.touch.segment, e.touch.other)
}

impl Touches {
    /// Starts the substeps of a tick.
    pub fn begin(&mut self) {
        std::mem::swap(&mut self.now, &mut self.before);
        self.now.clear();
    }

    /// Adds a contact of a substep to the means over the tick of `dt` s.
    pub fn add(&mut self, terms: &Terms, c: &Contacting, dt: f64) {
        let force = c.impulse * (1.0 / dt);
        let weight = force.dot(c.normal).max(0.0);
        let s = c.segment.index();
        let local = terms.kin.rotation[s].transpose_mul(c.position - terms.segment_position(s));
        let found = self
            .now
            .iter_mut()
            .find(|e| e.touch.segment == c.segment && e.touch.other == c.other);
        if let Some(e) = found {
            let total = e.weight + weight;
            if total > 0.0 {
                let share = weight / total;
                e.touch.position += (c.position - e.touch.position) * share;
                e.local += (local - e.local) * share;
            }
            e.weight = total;
            e.touch.force += force;
            e.touch.depth = e.touch.depth.max(c.depth);
        } else if self.now.len() < MAX_TOUCHES {
            self.now.push(Entry {
                touch: Touch {
                    segment: c.segment,
                    other: c.other,
                    position: c.position,
                    force,
                    normal: c.normal,
                    depth: c.depth,
                },
                weight,
                local,
                expected: Vec3::zero(),
                firm: c.firm,
            });
        }
    }

    /// Ends a tick: order, events, and what is expected of the next. `alone`: nothing was near, so nothing can have touched.
    pub fn end(&mut self, watcher: &mut Watcher) {
        self.now.sort_unstable_by_key(key);
        for e in &mut self.now {
            let old = self.before.iter().find(|o| key(o) == key(e));
            match old {
                Some(o) => e.expected = o.expected + (e.touch.force - o.expected) * LEARN,
                None => watcher.push(FigureEvent::Touched {
                    segment: e.touch.segment,
                    other: e.touch.other,
                }),
            }
            let n = e.expected.norm();
            if n > MOST {
                e.expected = e.expected * (MOST / n);
            }
        }
        for o in &self.before {
            if !self.now.iter().any(|e| key(e) == key(o)) {
                watcher.push(FigureEvent::Parted {
                    segment: o.touch.segment,
                    other: o.touch.other,
                });
            }
        }
        self.before.clear();
    }

    /// Touches of the last tick.
    pub fn list(&self) -> impl Iterator<Item = Touch> + '_ {
        self.now.iter().map(|e| e.touch)
    }

    /// What carries it: firm things that push with more than `least` N, with their places in the state of `terms`.
    pub fn rests<'a>(&'a self, terms: &'a Terms, least: f64) -> impl Iterator<Item = Rest> + 'a {
        let firm = self.now.iter().filter(|e| e.firm);
        firm.filter(move |e| e.expected.dot(e.touch.normal) > least)
            .map(|e| Rest {
                segment: e.touch.segment,
                position: terms.point_world(e.touch.segment.index(), e.local),
                normal: e.touch.normal,
                force: e.expected,
            })
    }

    /// Counts the expected reactions among the forces in `terms.h`; those of level rests that carry more than `least` N, if given, are left
    /// to a controller that chooses them.
    pub fn lean(&self, terms: &mut Terms, least: Option<f64>) {
        for e in &self.now {
            let normal = e.touch.normal;
            let chosen =
                least.is_some_and(|l| e.firm && Rest::level(normal) && e.expected.dot(normal) > l);
            if chosen || e.expected == Vec3::zero() {
                continue;
            }
            let s = e.touch.segment.index();
            let Terms { kin, h, .. } = terms;
            let r = kin.position[s] + kin.rotation[s] * e.local;
            for_each_column(kin, s, r, |i, _, v| h[i] -= v.dot(e.expected));
        }
    }
}
