//! Constraints that a client sets: a point of a segment or the centre of mass at a place, or the orientation of a
//! segment, while the rest of the body follows its motion as well as it can.

use crate::body::topology::{
    L_FOOT, L_FOREARM, L_HAND, L_TOES, L_UPPER_ARM, R_FOOT, R_FOREARM, R_HAND, R_TOES, R_UPPER_ARM,
};
use crate::body::{Body, SegmentId};
use crate::control::goals::MAX_GOALS;
use crate::control::{ConstraintGoal, Effector, PointTarget};
use crate::dynamics::Terms;
use crate::figure::params::constraints::{
    COM_INSET, COM_LEASH, STREAM_INTERVAL, STREAM_SMOOTHING, STREAM_SPEED, TRUNK_REACH,
};
use crate::math::curve::smoothstep;
use crate::math::{Quat, Vec3};
use crate::support::{Polygon, Support};
use serde::{Deserialize, Serialize};

/// Most constraints on one figure.
pub const MAX_CONSTRAINTS: usize = 8;
/// Largest `ease`, s.
pub const MAX_EASE: f64 = 60.0;

/// The part that a constraint is on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Constrained {
    /// The centre of mass, loads included.
    CenterOfMass,
    /// A point of a segment, segment frame, m.
    Point(SegmentId, Vec3),
}

/// The desired place of the centre of mass or of a point of a segment, and the desired orientation of the segment.
///
/// At least one of `position` and `rotation` is given; the centre of mass has no rotation. The part moves there from
/// its present place. A goal out of reach is approached as closely as balance, strength and joints allow.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Constraint {
    /// The part that it is on.
    pub on: Constrained,
    /// Desired position, world, m.
    pub position: Option<Vec3>,
    /// Weight of each world axis of the position, 0…1.
    pub axes: [f64; 3],
    /// Desired rotation, `world_from_segment`.
    pub rotation: Option<Quat>,
    /// Weight of the whole constraint, 0…1.
    pub weight: f64,
    /// Time over which it comes into force, and over which it fades when it ends, s.
    pub ease: f64,
    /// Time at which it begins, s.
    pub from: f64,
    /// Time at which it has ended, s; `f64::INFINITY` = when it is removed.
    pub to: f64,
}

impl Constraint {
    /// Share of it that is in force at `time` (s), 0…1: rises after `from` and falls before `to` within `ease`, C¹.
    pub fn level(&self, time: f64) -> f64 {
        let ramp = |t: f64| {
            let u = if self.ease > 0.0 {
                t / self.ease
            } else {
                f64::from(u8::from(t >= 0.0))
            };
            smoothstep(u)
        };
        let ends = if self.to.is_finite() {
            ramp(self.to - time)
        } else {
            1.0
        };
        ramp(time - self.from).min(ends)
    }
}

/// A place that the client keeps updating.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct PlaceStream {
    on: Constrained,
    position: Vec3,
    velocity: Vec3,
    /// Time of the last update, s.
    at: f64,
}

impl PlaceStream {
    /// The place that `c` gives at `time`, following `before`.
    fn next(before: Option<&Self>, c: &Constraint, time: f64) -> Option<Self> {
        let mut next = Self {
            on: c.on,
            position: c.position?,
            velocity: Vec3::zero(),
            at: time,
        };
        if let Some(b) = before.filter(|b| time - b.at <= STREAM_INTERVAL) {
            let elapsed = time - b.at;
            next.velocity = b.velocity;
            if elapsed > 0.0 {
                let velocity = (next.position - b.position) * (1.0 / elapsed);
                let share = elapsed / (elapsed + STREAM_SMOOTHING);
                next.velocity = if velocity.norm() < STREAM_SPEED {
                    b.velocity + (velocity - b.velocity) * share
                } else {
                    Vec3::zero()
                };
            }
        }
        Some(next)
    }
}

/// The constraints of a figure: those that are set, and those that are fading after their removal.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Constraints {
    given: Vec<Constraint>,
    streams: Vec<PlaceStream>,
    fading: Vec<Constraint>,
    #[serde(skip)]
    goals: Vec<ConstraintGoal>,
    #[serde(skip)]
    hands: [Option<Effector>; 2],
    #[serde(skip)]
    polygon: Polygon,
    #[serde(skip)]
    inset: Polygon,
    #[serde(skip)]
    errors: Vec<[f64; 2]>,
}

impl Default for Constraints {
    fn default() -> Self {
        Self {
            given: Vec::with_capacity(MAX_CONSTRAINTS),
            streams: Vec::with_capacity(MAX_CONSTRAINTS),
            fading: Vec::with_capacity(MAX_CONSTRAINTS),
            goals: Vec::with_capacity(MAX_GOALS),
            hands: [None; 2],
            polygon: Polygon::with_capacity(64),
            inset: Polygon::with_capacity(128),
            errors: Vec::with_capacity(MAX_CONSTRAINTS),
        }
    }
}

impl Constraints {
    /// Replaces all constraints; at most [`MAX_CONSTRAINTS`] are taken. A constraint on a part that was already
    /// constrained continues from there, without easing in again; those on other parts fade out within their `ease`. A
    /// new place for the same part within 0.1 s counts as a moving place, and is assumed to keep moving.
    pub fn replace(&mut self, new: &[Constraint], time: f64) {
        let new = &new[..new.len().min(MAX_CONSTRAINTS)];
        let streams: [Option<PlaceStream>; MAX_CONSTRAINTS] = std::array::from_fn(|i| {
            let c = new.get(i)?;
            let before = self.streams.iter().find(|s| s.on == c.on);
            PlaceStream::next(before, c, time)
        });
        self.streams.clear();
        self.streams.extend(streams.into_iter().flatten());
        let given: [Option<Constraint>; MAX_CONSTRAINTS] = std::array::from_fn(|i| {
            let mut c = *new.get(i)?;
            let before = self.given.iter().find(|o| o.on == c.on && o.to > time);
            if let Some(before) = before {
                c.from = c.from.min(before.from);
            }
            Some(c)
        });
        for o in self.given.drain(..) {
            if new.iter().all(|c| c.on != o.on) && self.fading.len() < MAX_CONSTRAINTS {
                // It falls from its present level: one that was still rising has less to fall.
                let risen = (time - o.from).clamp(0.0, o.ease);
                let to = o.to.min(time + risen);
                self.fading.push(Constraint { to, ..o });
            }
        }
        self.given.extend(given.into_iter().flatten());
    }

    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        let most = MAX_CONSTRAINTS;
        let numbers = |c: &Constraint| {
            let place = c.position.map_or([0.0; 3], Vec3::to_array);
            let [x, y, z, w] = c.rotation.unwrap_or_default().to_xyzw();
            (0.0..=1.0).contains(&c.weight)
                && (0.0..=MAX_EASE).contains(&c.ease)
                && c.axes.iter().all(|a| (0.0..=1.0).contains(a))
                && place.iter().chain(&[x, y, z, w]).all(|x| x.is_finite())
                && !(c.from.is_nan() || c.to.is_nan())
        };
        self.given.len() <= most
            && self.streams.len() <= most
            && self.fading.len() <= most
            && self.given.iter().chain(&self.fading).all(numbers)
    }

    /// The constraints that are set, in the order in which they were set.
    pub fn given(&self) -> &[Constraint] {
        &self.given
    }

    /// Removes all at once: the figure was put somewhere else.
    pub fn forget(&mut self) {
        self.given.clear();
        self.streams.clear();
        self.fading.clear();
        self.goals.clear();
        self.errors.clear();
    }

    /// Applies the constraints in force at `time`, the start of a tick: shifts the desired centre of mass and collects
    /// the goals. No allocation.
    pub(crate) fn begin(
        &mut self,
        time: f64,
        body: &Body,
        terms: &Terms,
        support: &Support,
        com: &mut PointTarget,
        hands: &[Effector; 2],
        desired: impl Fn(SegmentId, Vec3) -> Vec3,
    ) {
        self.given.retain(|c| c.to > time);
        self.fading.retain(|c| c.to > time);
        self.goals.clear();
        self.hands = hands.map(Some);
        if self.given.is_empty() && self.fading.is_empty() {
            return;
        }
        for i in 0..self.fading.len() + self.given.len() {
            // Set constraints come before fading ones: they matter more if there is not room for all.
            let c = match self.given.get(i) {
                Some(c) => *c,
                None => self.fading[i - self.given.len()],
            };
            let level = c.weight * c.level(time);
            let velocity = self.velocity(c.on, time);
            match c.on {
                Constrained::CenterOfMass => {
                    if let Some(at) = c.position {
                        let share = c.axes.map(|a| a * level);
                        self.shift_com(body, terms, support, at, velocity, share, com);
                    }
                }
                Constrained::Point(segment, point) => {
                    if c.position.is_some() {
                        self.release(segment);
                    }
                    let mut goal = ConstraintGoal {
                        segment,
                        point,
                        position: c.position,
                        velocity,
                        axes: c.axes,
                        rotation: c.rotation,
                        weight: level,
                    };
                    if let (Some(at), false) = (c.position, goal.is_on_arm()) {
                        let home = desired(segment, point);
                        let off = goal.along_axes(at - home);
                        let share = (TRUNK_REACH / off.norm().max(TRUNK_REACH)).min(1.0);
                        goal.position = Some(home + off * share);
                    }
                    self.goals.push(goal);
                }
            }
        }
    }

    /// Speed of the desired place of a part, m/s: zero unless the client keeps updating it.
    fn velocity(&self, on: Constrained, time: f64) -> Vec3 {
        let fresh = |s: &&PlaceStream| s.on == on && time - s.at <= STREAM_INTERVAL;
        let stream = self.streams.iter().find(fresh);
        stream.map_or(Vec3::zero(), |s| s.velocity)
    }

    /// A hand whose arm is constrained, or led elsewhere, does not also follow the motion in space.
    pub(in crate::figure) fn release(&mut self, segment: SegmentId) {
        match segment {
            L_UPPER_ARM | L_FOREARM | L_HAND => self.hands[0] = None,
            R_UPPER_ARM | R_FOREARM | R_HAND => self.hands[1] = None,
            _ => {}
        }
    }

    /// Blends the desired centre of mass with a constraint on it: horizontally inside the area that the supports cover,
    /// and never far ahead of the present centre of mass.
    fn shift_com(
        &mut self,
        body: &Body,
        terms: &Terms,
        support: &Support,
        wanted: Vec3,
        moves: Vec3,
        share: [f64; 3],
        com: &mut PointTarget,
    ) {
        let mut at = Vec3 {
            x: if share[0] > 0.0 { wanted.x } else { com.now.x },
            y: if share[1] > 0.0 { wanted.y } else { com.now.y },
            z: wanted.z,
        };
        // The whole of each foot that touches with any part, since it can be put down again.
        let touches = |s: SegmentId| support.points().iter().any(|p| p.segment == s);
        let toes = |s: SegmentId| s == L_TOES || s == R_TOES;
        let feet = [(L_FOOT, L_TOES), (R_FOOT, R_TOES)];
        let feet = feet.into_iter().filter(|(a, b)| touches(*a) || touches(*b));
        let points = feet.flat_map(|(a, b)| [a, b]).flat_map(|s| {
            let points = &body.segment(s).contact_points;
            let ball = move |p: &Vec3| {
                if toes(s) {
                    Vec3 {
                        x: p.x.min(0.0),
                        ..*p
                    }
                } else {
                    *p
                }
            };
            points
                .iter()
                .map(move |p| terms.point_world(s.index(), ball(p)))
        });
        let rests = support.rests().iter().filter(|r| r.is_level());
        let rests = rests.map(|r| r.position);
        self.polygon
            .set_hull(points.chain(rests).map(|p| [p.x, p.y]));
        self.inset.set_inset(&self.polygon, COM_INSET);
        if let Some(c) = self.inset.closest([at.x, at.y]).filter(|c| c.margin < 0.0) {
            [at.x, at.y] = c.point;
        }
        let present = terms.com.to_array();
        let (at, moves) = (at.to_array(), moves.to_array());
        // Each blended with the motion's own target: the goal moves there gradually, never far ahead of the body.
        let blend = |from: Vec3, wanted: [f64; 3]| {
            let mut out = from.to_array();
            for k in 0..3 {
                out[k] += share[k] * (wanted[k] - out[k]);
            }
            Vec3::from_array(out)
        };
        let near =
            std::array::from_fn(|k| present[k] + (at[k] - present[k]).clamp(-COM_LEASH, COM_LEASH));
        *com = PointTarget {
            now: blend(com.now, near),
            next: blend(com.next, near),
            now_velocity: blend(com.now_velocity, moves),
            next_velocity: blend(com.next_velocity, moves),
        };
    }

    /// Whether one of these segments is constrained, or still has a fading constraint.
    pub(in crate::figure) fn holds(&self, segments: [SegmentId; 3]) -> bool {
        let on = |c: &Constraint| match c.on {
            Constrained::Point(s, _) => segments.contains(&s),
            Constrained::CenterOfMass => false,
        };
        self.given.iter().chain(&self.fading).any(on)
    }

    /// The goals of the controllers in this tick.
    pub(crate) fn goals(&self) -> &[ConstraintGoal] {
        &self.goals
    }

    /// The hands that follow the motion in space.
    pub(crate) fn free_hands(&self) -> impl Iterator<Item = Effector> + '_ {
        self.hands.iter().flatten().copied()
    }

    /// Remaining distance (m, along the axes that count) and angle (rad) at the start of the tick, one pair per set
    /// constraint.
    pub(crate) fn errors(&mut self, terms: &Terms) -> &[[f64; 2]] {
        self.errors.clear();
        for c in &self.given {
            let (segment, point) = match c.on {
                Constrained::Point(s, p) => (s, p),
                Constrained::CenterOfMass => {
                    let e = c.position.map_or(Vec3::zero(), |p| p - terms.com);
                    let e = e.to_array();
                    let on = |k: usize| if c.axes[k] > 0.0 { e[k] * e[k] } else { 0.0 };
                    self.errors.push([(on(0) + on(1) + on(2)).sqrt(), 0.0]);
                    continue;
                }
            };
            let goal = ConstraintGoal {
                segment,
                point,
                position: c.position,
                velocity: Vec3::zero(),
                axes: c.axes,
                rotation: c.rotation,
                weight: 1.0,
            };
            let error = [goal.distance(terms).norm(), goal.turn(terms).norm()];
            self.errors.push(error);
        }
        &self.errors
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec3::vec3;

    fn hand(x: f64, from: f64) -> Constraint {
        Constraint {
            on: Constrained::Point(R_HAND, Vec3::zero()),
            position: Some(vec3(x, 0.0, 1.0)),
            axes: [1.0; 3],
            rotation: None,
            weight: 1.0,
            ease: 0.5,
            from,
            to: f64::INFINITY,
        }
    }

    #[test]
    fn a_constraint_eases_in_goes_on_when_replaced_and_fades_when_taken_off() {
        let mut set = Constraints::default();
        set.replace(&[hand(0.3, 1.0)], 1.0);
        assert_eq!(set.given()[0].level(1.0), 0.0);
        assert_eq!(set.given()[0].level(1.25), 0.5);
        assert_eq!(set.given()[0].level(1.5), 1.0);
        // A new place for the same hand keeps the level that was reached.
        set.replace(&[hand(0.4, 1.25)], 1.25);
        assert_eq!(set.given()[0].level(1.25), 0.5);
        set.replace(&[], 2.0);
        assert!(set.given().is_empty());
        let gone = set.fading[0];
        assert_eq!(
            (gone.level(2.0), gone.level(2.25), gone.level(2.5)),
            (1.0, 0.5, 0.0)
        );
    }

    #[test]
    fn a_place_that_is_given_again_and_again_moves_and_one_that_jumps_or_stays_does_not() {
        let mut set = Constraints::default();
        let on = hand(0.0, 0.0).on;
        let dt = 1.0 / 60.0;
        for i in 0..60 {
            let time = f64::from(i) * dt;
            set.replace(&[hand(1.3 * time, 0.0)], time);
        }
        let last = 59.0 * dt;
        let v = set.velocity(on, last);
        assert!((v - vec3(1.3, 0.0, 0.0)).norm() < 1e-6, "{v:?}");
        // No longer updated: it rests at its last place.
        assert_eq!(set.velocity(on, last + 0.2), Vec3::zero());
        // Twice in one tick: the last place counts, and its speed is no higher for that.
        set.replace(&[hand(9.0, 0.0)], last);
        assert_eq!(set.velocity(on, last), v);
        set.replace(&[hand(1.0, 0.0)], last + dt);
        assert_eq!(set.velocity(on, last + dt), Vec3::zero());
        set.replace(&[hand(0.2, 0.0)], last + 5.0);
        set.replace(&[hand(0.3, 0.0)], last + 6.0);
        assert_eq!(set.velocity(on, last + 6.0), Vec3::zero());
    }

    #[test]
    fn no_more_than_there_is_room_for() {
        let mut set = Constraints::default();
        for round in 0..5 {
            let time = f64::from(round);
            let many: Vec<_> = (0..20)
                .map(|i| Constraint {
                    on: Constrained::Point(L_HAND, vec3(time, f64::from(i), 0.0)),
                    ease: MAX_EASE,
                    ..hand(0.0, time)
                })
                .collect();
            set.replace(&many, time);
            assert!(set.given.len() == MAX_CONSTRAINTS && set.fading.len() <= MAX_CONSTRAINTS);
        }
    }
}
