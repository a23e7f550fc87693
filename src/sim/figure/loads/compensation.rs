//! The effect of a load on a motion with steps: the trunk leans to the other side, and the arm hangs.
//!
//! A motion is prepared for an unloaded body. A load moves the centre of mass by m/M of the distance to the load: 10 kg
//! in one hand move it 5 cm to that side, half a foot's width away from where every step of the motion has its
//! zero-moment point. So the trunk leans and the pelvis shifts until the centre of mass of the loaded body, projected
//! on the floor, is where the motion has that of the unloaded one. The feet stay, and the head keeps its direction. The
//! carrying arm moves its load with the forces that an empty hand would take: a hanging arm swings less the more it
//! carries, and quick movements of any arm become smaller.

mod arm;

use crate::body::topology::{
    ABDOMEN, CHEST, HEAD, JOINT, Joint, L_FOOT, L_TOES, L_UPPER_ARM, PARENT, R_FOOT, R_TOES,
    R_UPPER_ARM, SEGMENT_COUNT,
};
use crate::body::{Body, Links, NV, Posture, SegmentId};
use crate::figure::params::load::{
    LARGEST_LEAN, LARGEST_SHIFT, LEAN, ONSET_TIME, RATE_SPAN, SAME_LOAD, SHIFT_ROUNDS,
};
use crate::math::exp::exp;
use crate::math::{Quat, Vec3};
use crate::motion::arm_ik::{ARMS, Arm};
use crate::motion::leg_ik::{forward, solve_leg};
use crate::motion::{Target, TargetPair};
use crate::plan::params::balance::PELVIS_LEAD;
use arm::{ArmPoses, Habit};
use serde::{Deserialize, Serialize};

/// Masses and first moments of mass of the segments with a load, segment frames, kg and kg·m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Masses {
    mass: [f64; SEGMENT_COUNT],
    moment: [Vec3; SEGMENT_COUNT],
}

/// Masses, and the weight of their difference.
#[derive(Clone, Copy)]
struct Weighted<'a> {
    load: &'a Masses,
    share: f64,
}

impl Masses {
    fn of(links: &Links) -> Self {
        Self {
            mass: links.mass,
            moment: links.moment,
        }
    }

    /// Centre of mass, m.
    fn center(&self, poses: &ArmPoses) -> Vec3 {
        let (mut sum, mut mass) = (Vec3::zero(), 0.0);
        for (s, (position, rotation)) in poses.iter().enumerate() {
            sum += *position * self.mass[s] + rotation.rotate(self.moment[s]);
            mass += self.mass[s];
        }
        sum * (1.0 / mass)
    }

    /// `self + a·x + b·y`, where x and y are the differences of two others from `self`.
    fn toward(&self, first: Weighted<'_>, second: Weighted<'_>) -> Self {
        let Weighted { load: x, share: a } = first;
        let Weighted { load: y, share: b } = second;
        let mut out = *self;
        for s in 0..SEGMENT_COUNT {
            out.mass[s] += a * (x.mass[s] - self.mass[s]) + b * (y.mass[s] - self.mass[s]);
            out.moment[s] +=
                (x.moment[s] - self.moment[s]) * a + (y.moment[s] - self.moment[s]) * b;
        }
        out
    }

    /// Whether a body with permitted loads could have these masses.
    fn is_valid(&self) -> bool {
        let number = |x: f64| x.abs() <= 1e6;
        self.mass.iter().all(|m| *m > 0.0 && number(*m))
            && self.moment.iter().flat_map(|v| v.to_array()).all(number)
    }

    fn is_near(&self, other: &Self) -> bool {
        (0..SEGMENT_COUNT).all(|s| {
            (self.mass[s] - other.mass[s]).abs() < SAME_LOAD
                && (self.moment[s] - other.moment[s]).norm() < SAME_LOAD
        })
    }
}

/// The effect of a load at a moment.
struct LoadEffect {
    load: Masses,
    /// At the start of the tick: the recent habits of the arms, how much they hung, 0…1, and how long ago that was, s.
    before: [Habit; 2],
    hung: [f64; 2],
    ahead: f64,
}

/// The loads that one figure carries, and their effect on the motion.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::figure) struct LoadCompensation {
    unloaded: Masses,
    /// The carried masses, smoothed because loads come and go at once: after one time constant, and after both.
    halfway: Masses,
    effect: Masses,
    /// Recent habits of each arm; `None` until something is carried.
    habits: Option<[Habit; 2]>,
}

impl LoadCompensation {
    /// For figures with this body, without a load.
    pub fn new(body: &Body) -> Self {
        let unloaded = Masses::of(&Links::new(body));
        Self {
            unloaded,
            halfway: unloaded,
            effect: unloaded,
            habits: None,
        }
    }

    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        let masses = [&self.unloaded, &self.halfway, &self.effect];
        masses.iter().all(|m| m.is_valid()) && self.habits.iter().flatten().all(Habit::is_valid)
    }

    /// The loads that the left and the right hand of a stepping figure feel, kg. A figure that stays in place lifts its
    /// loads as the motion has it.
    pub fn in_hands(&self) -> [f64; 2] {
        ARMS.map(|[.., hand]| self.effect.mass[hand.index()] - self.unloaded.mass[hand.index()])
    }

    /// Forgets the past.
    pub fn reset(&mut self) {
        (self.halfway, self.effect) = (self.unloaded, self.unloaded);
        self.habits = None;
    }

    /// Changes the desired motion of a tick of `dt` seconds for a body with the present loads, `links`. `steps`:
    /// whether the motion steps. A figure that stays in place has room in its feet and is left alone. No allocation;
    /// does nothing without a load.
    pub fn compensate(
        &mut self,
        body: &Body,
        links: &Links,
        target: &mut TargetPair,
        steps: bool,
        dt: f64,
    ) {
        let real = Masses::of(links);
        let carried = if steps { real } else { self.unloaded };
        if carried == self.unloaded && self.effect == self.unloaded {
            self.habits = None;
            return;
        }
        let lean = LoadLean {
            body,
            unloaded: &self.unloaded,
            real: &real,
        };
        let now = ARMS.map(|arm| Habit::of(body, &target.now.posture, arm));
        let before = self.habits.unwrap_or(now);
        let hung = now.map(|h| h.hangs);
        let next = target.next.posture;
        let effect = |ahead: f64| LoadEffect {
            load: self.effect_after(&carried, ahead).1,
            before,
            hung,
            ahead,
        };
        let around = |t: f64| [t - RATE_SPAN, t, t + RATE_SPAN].map(effect);
        lean.change(&mut target.now, &around(0.0));
        lean.change(&mut target.next, &around(dt));
        self.habits = Some([0, 1].map(|k| before[k].after(dt, hung[k], Arm::of(&next, ARMS[k]))));
        (self.halfway, self.effect) = self.effect_after(&carried, dt);
        if self.effect.is_near(&carried) && self.halfway.is_near(&carried) {
            (self.halfway, self.effect) = (carried, carried);
        }
    }

    /// The effect, `ahead` seconds from now, of the loads carried then: after one time constant, and after both.
    fn effect_after(&self, carried: &Masses, ahead: f64) -> (Masses, Masses) {
        let left = exp(-ahead / ONSET_TIME);
        let weighted = |load, share| Weighted { load, share };
        let none = weighted(carried, 0.0);
        let halfway = |share| weighted(&self.halfway, share);
        let effect = weighted(&self.effect, left);
        (
            carried.toward(halfway(left), none),
            carried.toward(effect, halfway(left * ahead / ONSET_TIME)),
        )
    }
}

/// How a body leans under a load.
struct LoadLean<'a> {
    body: &'a Body,
    unloaded: &'a Masses,
    real: &'a Masses,
}

impl LoadLean<'_> {
    /// Changes a target and its rates for the effect of a load just before, at, and just after its time.
    fn change(&self, target: &mut Target, [before, effect, after]: &[LoadEffect; 3]) {
        let moved = |seconds: f64| {
            let mut p = target.posture;
            p.integrate(&target.velocity, seconds);
            p
        };
        let from = self.compensated(&moved(-RATE_SPAN), before);
        let way = from.difference(&self.compensated(&moved(RATE_SPAN), after));
        target.posture = self.compensated(&target.posture, effect);
        target.velocity = std::array::from_fn::<f64, NV, _>(|i| way[i] * (0.5 / RATE_SPAN));
    }

    /// The posture in which the body with the load that has `effect` has its centre of mass where the unloaded body has
    /// it in `posture`.
    fn compensated(&self, posture: &Posture, effect: &LoadEffect) -> Posture {
        let planned = forward(self.body, posture);
        let mut out = *posture;
        for (k, arm) in ARMS.into_iter().enumerate() {
            let hand = arm[2].index();
            let load = effect.load.mass[hand] - self.unloaded.mass[hand];
            if load > 0.0 {
                let habit =
                    effect.before[k].after(effect.ahead, effect.hung[k], Arm::of(posture, arm));
                arm::slow(&mut out, arm, load, &habit);
                arm::hang(self.body, &mut out, &planned, arm, load, &habit);
            }
        }
        let poses = forward(self.body, &out);
        let by = self.unloaded.center(&planned) - effect.load.center(&poses);
        let by = Vec3 { z: 0.0, ..by };
        tilt(&mut out, &poses, by);
        let goal = self.real.center(&poses) + by;
        let mut shift = Vec3::zero();
        for _ in 0..SHIFT_ROUNDS {
            let off = goal - self.real.center(&forward(self.body, &out));
            shift = (shift + off.horizontal() * PELVIS_LEAD).capped(LARGEST_SHIFT);
            out.root_position = posture.root_position + shift;
            for (left, foot, toes) in [(true, L_FOOT, L_TOES), (false, R_FOOT, R_TOES)] {
                if let Joint::Hinge1(toe) = JOINT[toes.index()] {
                    let toe = posture.hinge[toe];
                    solve_leg(self.body, &mut out, left, planned[foot.index()], toe);
                }
            }
        }
        out
    }
}

/// Tilts the trunk towards `by`, half of it in the waist; head and arms keep their directions in `poses`.
fn tilt(posture: &mut Posture, poses: &ArmPoses, by: Vec3) {
    let tilt = (Vec3::Z.cross(by) * LEAN).capped(LARGEST_LEAN);
    let mut turned = poses.map(|(_, rotation)| rotation);
    turned[ABDOMEN.index()] = Quat::exp(tilt * 0.5) * turned[ABDOMEN.index()];
    turned[CHEST.index()] = Quat::exp(tilt) * turned[CHEST.index()];
    for s in [ABDOMEN, CHEST, HEAD, L_UPPER_ARM, R_UPPER_ARM].map(SegmentId::index) {
        if let Joint::Ball(b) = JOINT[s] {
            posture.ball[b] = (turned[PARENT[s]].conjugate() * turned[s]).normalized();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::topology::{L_HAND, R_FOREARM, R_HAND};
    use crate::motion::Clip;
    use crate::motion::builtin::builtin;

    const DT: f64 = 1.0 / 60.0;

    fn walk(body: &Body) -> Clip {
        builtin(body, "walk").expect("there is a built-in walk")
    }

    fn at(clip: &Clip, t: f64, dt: f64) -> TargetPair {
        TargetPair {
            now: clip.sample_looped(t),
            next: clip.sample_looped(t + dt),
        }
    }

    fn with_load(body: &Body, hand: SegmentId, mass: f64) -> Links {
        let mut links = Links::new(body);
        links.add_load(hand, body.segment(hand).com, mass);
        links
    }

    /// The compensation of a figure that has carried `links` for a long time.
    fn used_to(body: &Body, clip: &Clip, links: &Links) -> LoadCompensation {
        let mut compensation = LoadCompensation::new(body);
        for _ in 0..600 {
            compensation.compensate(body, links, &mut at(clip, 1.0, DT), true, DT);
        }
        compensation
    }

    #[test]
    fn the_loaded_body_is_where_the_unloaded_one_was_and_its_feet_stay() {
        let body = Body::adult_man();
        let clip = walk(&body);
        for (hand, mass) in [(R_HAND, 5.0), (L_HAND, 10.0), (R_HAND, 15.0)] {
            let links = with_load(&body, hand, mass);
            let mut compensation = used_to(&body, &clip, &links);
            for k in 0..20 {
                let before = at(&clip, 0.2 + 0.1 * f64::from(k), DT);
                let mut after = before.clone();
                compensation.compensate(&body, &links, &mut after, true, DT);
                let (p, q) = (&before.now.posture, &after.now.posture);
                let (p, q) = (forward(&body, p), forward(&body, q));
                let off = Masses::of(&links).center(&q) - compensation.unloaded.center(&p);
                assert!(off.x.hypot(off.y) < 1e-3, "{mass} kg: {off:?}");
                let shift = after.now.posture.root_position - before.now.posture.root_position;
                assert!(shift.norm() > 1.5e-3 * mass && shift.norm() < 0.08);
                for foot in [L_FOOT, R_FOOT].map(SegmentId::index) {
                    assert!((p[foot].0 - q[foot].0).norm() < 2e-3, "{mass} kg");
                    assert!((p[foot].1.conjugate() * q[foot].1).log().norm() < 1e-9);
                }
                let head = HEAD.index();
                assert!((p[head].1.conjugate() * q[head].1).log().norm() < 1e-9);
            }
        }
    }

    #[test]
    fn rates_are_those_of_the_posture_also_while_a_load_comes() {
        let body = Body::adult_man();
        let links = with_load(&body, R_HAND, 12.0);
        let mut compensation = LoadCompensation::new(&body);
        let dt = 1e-4;
        let clip = walk(&body);
        for k in 0..40 {
            let mut pair = at(&clip, 0.7 + f64::from(k) * dt, dt);
            compensation.compensate(&body, &links, &mut pair, true, dt);
            let way = pair.now.posture.difference(&pair.next.posture);
            for i in 0..NV {
                let mean = 0.5 * (pair.now.velocity[i] + pair.next.velocity[i]);
                assert!((way[i] / dt - mean).abs() < 2e-2, "{i}: {way:?}");
            }
        }
    }

    #[test]
    fn without_a_load_or_steps_nothing_changes_and_a_load_let_go_is_forgotten() {
        let body = Body::adult_man();
        let clip = walk(&body);
        let (bare, links) = (Links::new(&body), with_load(&body, R_HAND, 15.0));
        for (links, steps) in [(&bare, true), (&links, false)] {
            let mut pair = at(&clip, 1.0, DT);
            LoadCompensation::new(&body).compensate(&body, links, &mut pair, steps, DT);
            assert_eq!(pair, at(&clip, 1.0, DT));
        }
        let mut compensation = used_to(&body, &clip, &links);
        let mut last = f64::INFINITY;
        for _ in 0..600 {
            let mut pair = at(&clip, 1.0, DT);
            let planned = pair.now.posture.root_position;
            compensation.compensate(&body, &bare, &mut pair, true, DT);
            let off = (pair.now.posture.root_position - planned).norm();
            assert!(off <= last + 1e-9, "it does not overshoot");
            last = off;
        }
        assert_eq!(last, 0.0);
    }

    #[test]
    fn arms_that_hold_something_in_front_do_not_drop_it() {
        let body = Body::adult_man();
        let clip = walk(&body);
        let links = with_load(&body, R_HAND, 10.0);
        let mut compensation = used_to(&body, &clip, &links);
        let (Joint::Ball(shoulder), Joint::Hinge2(elbow)) =
            (JOINT[R_UPPER_ARM.index()], JOINT[R_FOREARM.index()])
        else {
            unreachable!()
        };
        let mut before = at(&clip, 1.0, DT);
        for t in [&mut before.now, &mut before.next] {
            t.posture.ball[shoulder] = Quat::identity();
            t.posture.hinge[elbow] = 1.6;
        }
        // Once the effect has settled: a load that changes at once has its effect slowly.
        let mut pair = before.clone();
        for _ in 0..1800 {
            pair = before.clone();
            compensation.compensate(&body, &links, &mut pair, true, DT);
        }
        let arms = before.now.posture.hinge[..8].iter();
        for (is, meant) in pair.now.posture.hinge.iter().zip(arms) {
            assert!((is - meant).abs() < 1e-9, "{is} for {meant} rad");
        }
    }
}
