//! A figure's contacts besides the ground: sums over a tick, and what they predict for the next.

use crate::body::SegmentId;
use crate::collide::{MAX_TOUCHES, Other, Touch};
use crate::control::mode::ChosenRests;
use crate::dynamics::{Dynamics, Terms};
use crate::figure::events::{FigureEvent, Watcher};
use crate::figure::params::support::{LARGEST_REACTION, REACTION_GAIN, SPOT_FORGOTTEN, SPOT_SIZE};
use crate::math::Vec3;
use crate::support::Rest;
use serde::{Deserialize, Serialize};

/// Places by which one part rests on one thing: a stool supports buttocks and thighs over an area, not at a point.
const SPOTS: usize = 4;

/// One contact of a substep, as one figure sees it.
#[derive(Clone, Copy, Debug)]
pub struct Contacting {
    /// Own segment.
    pub segment: SegmentId,
    /// The body that it touches.
    pub other: Other,
    /// World, m.
    pub position: Vec3,
    /// Impulse on this figure, world axes, N·s.
    pub impulse: Vec3,
    /// From the other body to this one.
    pub normal: Vec3,
    /// Overlap, m.
    pub depth: f64,
    /// Whether the other is an obstacle that nothing moves.
    pub firm: bool,
}

/// A place by which a part rests.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Spot {
    /// Place on the segment, segment frame, m.
    local: Vec3,
    /// Sum of normal forces, weight of the mean place, N.
    weight: f64,
    /// Reaction of this tick, world axes, N.
    force: Vec3,
    /// Its part of the reaction, for a controller that chooses the force at each place of a rest, N.
    expected: Vec3,
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct TouchRecord {
    touch: Touch,
    /// Sum of normal forces, weight of the mean position, N.
    weight: f64,
    /// Mean place on the segment, segment frame, m.
    local: Vec3,
    /// Reaction of the whole part, for controllers that rely on it as a force, N. It is learned separately from the
    /// reactions of the spots: those come and go and divide it differently from tick to tick, while their sum has to
    /// stay smooth; and a touch counts from its second tick on.
    expected: Vec3,
    spots: [Spot; SPOTS],
    /// Number of spots in use.
    count: usize,
    firm: bool,
}

impl TouchRecord {
    fn spots(&self) -> &[Spot] {
        &self.spots[..self.count]
    }

    /// The spot at `local`: a new one if there is room, otherwise the closest.
    fn spot(&mut self, local: Vec3) -> &mut Spot {
        let closest = self.closest(local);
        let i = match closest {
            Some((i, d)) if d < SPOT_SIZE || self.count == SPOTS => i,
            _ => {
                self.spots[self.count] = Spot {
                    local,
                    ..Spot::default()
                };
                self.count += 1;
                self.count - 1
            }
        };
        &mut self.spots[i]
    }

    /// The closest spot to `local` with its distance.
    fn closest(&self, local: Vec3) -> Option<(usize, f64)> {
        let distances = self.spots().iter().map(|s| (s.local - local).norm());
        distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1))
    }

    fn press(&mut self, local: Vec3, force: Vec3, weight: f64) {
        let spot = self.spot(local);
        spot.weight += weight;
        spot.force += force;
        if spot.weight > 0.0 {
            let share = weight / spot.weight;
            spot.local += (local - spot.local) * share;
        }
    }

    /// The reactions expected of the next tick, from those of this one and the earlier expectation, spot by spot.
    fn learn(&mut self, old: Option<&Self>) {
        let mut taken = [false; SPOTS];
        for spot in &mut self.spots[..self.count] {
            let before = old.and_then(|o| {
                let (i, d) = o.closest(spot.local)?;
                (d < SPOT_SIZE && !taken[i]).then(|| {
                    taken[i] = true;
                    o.spots[i].expected
                })
            });
            let before = before.unwrap_or_default();
            spot.expected = before + (spot.force - before) * REACTION_GAIN;
        }
        for (spot, _) in old
            .into_iter()
            .flat_map(Self::spots)
            .zip(taken)
            .filter(|(_, taken)| !taken)
        {
            let expected = spot.expected * (1.0 - REACTION_GAIN);
            if self.count < SPOTS && expected.norm() > SPOT_FORGOTTEN {
                self.spots[self.count] = Spot {
                    local: spot.local,
                    expected,
                    ..Spot::default()
                };
                self.count += 1;
            }
        }
        let before = old.map_or_else(Vec3::zero, |o| o.expected);
        if old.is_some() {
            self.expected = before + (self.touch.force - before) * REACTION_GAIN;
        }
        let size = self.expected.norm();
        if size > LARGEST_REACTION {
            self.expected = self.expected * (LARGEST_REACTION / size);
            for spot in &mut self.spots[..self.count] {
                spot.expected = spot.expected * (LARGEST_REACTION / size);
            }
        }
    }

    /// Whether it carries more than `least` N: in its learned reaction or, with `at_once`, in the last tick.
    fn carries(&self, least: f64, at_once: bool) -> bool {
        let now = if at_once {
            self.touch.force.dot(self.touch.normal)
        } else {
            0.0
        };
        self.firm && self.expected.dot(self.touch.normal).max(now) > least
    }
}

/// Touches of one tick and of the one before.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Touches {
    now: Vec<TouchRecord>,
    before: Vec<TouchRecord>,
    /// Whether something has pressed on the figure from the side since it was last at its place in the motion.
    pressed: bool,
}

impl Default for Touches {
    fn default() -> Self {
        Self {
            now: Vec::with_capacity(MAX_TOUCHES),
            before: Vec::with_capacity(MAX_TOUCHES),
            pressed: false,
        }
    }
}

fn key(e: &TouchRecord) -> (SegmentId, Other) {
    (e.touch.segment, e.touch.other)
}

impl Touches {
    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        [&self.now, &self.before]
            .into_iter()
            .all(|all| all.len() <= MAX_TOUCHES && all.iter().all(|e| e.count <= SPOTS))
    }

    /// Starts the substeps of a tick.
    pub fn begin(&mut self) {
        std::mem::swap(&mut self.now, &mut self.before);
        self.now.clear();
    }

    /// Adds a contact of a substep to the means over the tick of `dt` s.
    pub fn add(&mut self, dynamics: &Dynamics, c: &Contacting, dt: f64) {
        let force = c.impulse * (1.0 / dt);
        let weight = force.dot(c.normal).max(0.0);
        let s = c.segment.index();
        let local =
            dynamics.kin.rotation[s].transpose_mul(c.position - dynamics.segment_position(s));
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
            e.press(local, force, weight);
            e.weight = total;
            e.touch.force += force;
            e.touch.depth = e.touch.depth.max(c.depth);
        } else if self.now.len() < MAX_TOUCHES {
            let mut e = TouchRecord {
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
                spots: [Spot::default(); SPOTS],
                count: 0,
                firm: c.firm,
            };
            e.press(local, force, weight);
            self.now.push(e);
        }
    }

    /// Ends a tick: order, events, and the reactions expected of the next.
    pub fn end(&mut self, watcher: &mut Watcher) {
        self.now.sort_unstable_by_key(key);
        for e in &mut self.now {
            let old = self.before.iter().find(|o| key(o) == key(e));
            e.learn(old);
            if old.is_none() {
                watcher.push(FigureEvent::Touched {
                    segment: e.touch.segment,
                    other: e.touch.other,
                });
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

    /// Whether something has pressed on the figure from the side, not only from below or above, with more than `least`
    /// N, in the last tick or since it was last at its place in the motion. `is_back`: whether it is there now.
    pub fn press_aside(&mut self, least: f64, is_back: bool) -> bool {
        let pressure = |t: Touch| Vec3 { z: 0.0, ..t.normal } * t.force.dot(t.normal).max(0.0);
        let sum = self.list().fold(Vec3::zero(), |sum, t| sum + pressure(t));
        self.pressed = sum.norm() > least || (self.pressed && !is_back);
        self.pressed
    }

    /// Touches of the last tick.
    pub fn list(&self) -> impl Iterator<Item = Touch> + '_ {
        self.now.iter().map(|e| e.touch)
    }

    /// Its supports: firm things that push with more than `least` N, with their places in the state of `terms`.
    ///
    /// * `at_once`: a touch of one tick counts, for a controller that does not learn the force.
    pub fn rests<'a>(
        &'a self,
        terms: &'a Terms,
        least: f64,
        at_once: bool,
    ) -> impl Iterator<Item = Rest> + 'a {
        let carrying = self.now.iter().filter(move |e| e.carries(least, at_once));
        carrying.flat_map(move |e| {
            e.spots().iter().map(move |spot| Rest {
                segment: e.touch.segment,
                position: terms.point_world(e.touch.segment.index(), spot.local),
                normal: e.touch.normal,
                force: spot.expected,
                lift: 0.0,
            })
        })
    }

    /// Adds the expected reactions to the forces in `terms.h`, except those that the controller chooses.
    pub fn add_reactions(&self, terms: &mut Dynamics, chosen: ChosenRests) {
        for e in &self.now {
            let left = match chosen {
                ChosenRests::None => false,
                ChosenRests::Level(least) => Rest::level(e.touch.normal) && e.carries(least, false),
                ChosenRests::All(least) => e.carries(least, true),
            };
            if left || e.expected == Vec3::zero() {
                continue;
            }
            let s = e.touch.segment.index();
            let r = terms.kin.position[s] + terms.kin.rotation[s] * e.local;
            terms.add_force(s, r, e.expected);
        }
    }
}
