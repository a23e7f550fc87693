//! Steps that come sooner than the clip has them. An error of the capture point grows nearly threefold in a third of a
//! second, and a clip's own step takes half a second: who is pushed hard puts the swinging foot down at once, and takes
//! the next step quickly too (Hof, Vermerris & Gjaltema 2010; Vlutters et al. 2016).
//!
//! The motion is played faster until the foot lands. Time and place of the landing are chosen together, such that the
//! capture point then lies from the foot as the motion has it (Koolen et al. 2012). The centre of mass meanwhile
//! follows the pendulum, not the motion: that would run away from the body.

use super::step_plan::Footfall;
use super::{FOOT, StepTracker, capture_point, level, stance_points};
use crate::sim::dynamics::Terms;
use crate::sim::math::Vec3;
use crate::sim::motion::Target;
use crate::sim::support::Support;

/// A capture point nearer to the motion's than this is left to the step as planned, m: those of clips that nobody
/// disturbs are.
const HURRIES: f64 = 0.15;
/// Rates at which a motion may be played: up to the first, in so many steps.
const FASTEST: f64 = 2.0;
const RATES: u32 = 8;
/// Times to a landing that are decided about, s: in less nothing changes any more, and over more the pendulum foretells
/// nothing.
const AHEAD: (f64, f64) = (0.08, 0.7);
/// Mean speed at which a foot gets to another place, m/s.
const FOOT_SPEED: f64 = 5.0;
/// By how much a step may get shorter, m: who is off his plan by a walking speed cannot go on with its stride.
const SHORTER: f64 = 0.6;
/// What a doubled rate and a metre of displacement may cost of the error that is left, m.
const EFFORT: f64 = 0.1;

/// Where the motion has its capture point at a touch-down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlannedLanding {
    side: usize,
    /// Clip time of the touch-down, s.
    on: f64,
    /// From the foothold to the capture point, as planned, m.
    offset: Vec3,
}

/// A step made in a hurry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HastenedStep {
    /// Foot: 0 left, 1 right.
    pub(super) side: usize,
    /// Clip time of the touch-down, s.
    on: f64,
    /// Rate at which the motion is played.
    pub(super) rate: f64,
    /// The foothold, m.
    pub(super) place: Vec3,
    /// Where the zero-moment point is wanted, m.
    zmp: [f64; 2],
}

impl StepTracker {
    /// The next touch-down: its foot, and what is planned. A stream cannot be played faster than it comes, and who
    /// flies before he lands is no pendulum.
    fn coming_step(&self) -> Option<(usize, Footfall)> {
        let plan = self.plan.as_ref()?;
        let flies = self.flies() || plan.next_flight(self.phase).is_some();
        if flies || plan.is_live() || plan.is_over(self.phase) {
            return None;
        }
        let stand = self.feet.iter().all(|f| f.down);
        (0..2)
            .filter(|side| stand || !self.feet[*side].down)
            .filter_map(|side| Some((side, self.next(side)?)))
            .min_by(|a, b| a.1.on.total_cmp(&b.1.on))
    }

    /// Looks ahead to where the motion has its capture point at the next touch-down; `sample`: the motion so many
    /// seconds from now.
    pub(super) fn foresee(&mut self, sample: impl Fn(f64) -> Target) {
        let known = self.arrival.take();
        if !self.walks() || (self.quick.is_none() && self.capture.off() < HURRIES) {
            return;
        }
        let Some((side, f)) = self.coming_step() else {
            return;
        };
        if let Some(known) = known.filter(|k| (k.side, k.on) == (side, f.on)) {
            self.arrival = Some(known);
            return;
        }
        let place = self.placed(&f).place;
        let target = sample((f.on - self.phase) / self.speed);
        let xi = self.capture.point_of(&target);
        self.arrival = Some(PlannedLanding {
            side,
            on: f.on,
            offset: level([xi[0] - place.x, xi[1] - place.y]),
        });
    }

    /// Decides whether the next foot lands sooner than planned, and where then.
    pub(super) fn quicken(&mut self, terms: &Terms, support: &Support) {
        let before = self.quick.take();
        let Some(((side, f), arrival)) = self.coming_step().zip(self.arrival) else {
            return;
        };
        let same = |a: (usize, f64)| a == (side, f.on);
        if !same((arrival.side, arrival.on)) {
            return;
        }
        let before = before.filter(|q| same((q.side, q.on)));
        let planned = (f.on - self.phase) / self.speed;
        if planned < AHEAD.0 {
            self.quick = before;
        }
        if !(AHEAD.0..AHEAD.1).contains(&planned) {
            return;
        }
        let stands = |now: Footfall| (now.off - self.phase).max(0.0) / self.speed;
        let stands = (self.planned(side).filter(|_| self.feet[side].down)).map_or(0.0, stands);
        let placed = self.placed(&f);
        let home = self.anchor.point(placed.place);
        let heading = self.anchor.yaw() + placed.yaw;
        let offset = self.turned(arrival.offset);
        let [swing, stance] = [side, 1 - side].map(|k| {
            let ankle = terms.segment_position(FOOT[k].index());
            level([ankle.x, ankle.y])
        });
        let goal = home + offset;
        self.capture.stand_on(stance_points(support, side));
        let tried = (0..=RATES).map(|k| {
            let rate = 1.0 + (FASTEST - 1.0) * f64::from(k) / f64::from(RATES);
            let time = planned / rate;
            let wanted = self.capture.zmp_for([goal.x, goal.y], time);
            let lands = self.capture.lands(self.capture.within(wanted), time);
            let catches = level(lands) - offset;
            let d = catches - home;
            let d = capture_point::within_reach([d.x, d.y], home, stance, heading, side, SHORTER);
            let mut place = home + level(d);
            let (way, air) = (place - swing, (time - stands / rate).max(0.0));
            if k > 0 && way.norm() > FOOT_SPEED * air {
                place = swing + way * (FOOT_SPEED * air / way.norm());
            }
            let left = (catches - place).norm();
            let cost = left + EFFORT * (rate - 1.0 + (place - home).norm());
            let quick = HastenedStep {
                side,
                on: f.on,
                rate,
                place,
                zmp: wanted,
            };
            (cost, left, quick)
        });
        let best = tried.min_by(|a, b| a.0.total_cmp(&b.0));
        self.quick = best
            .filter(|(_, left, quick)| before.is_some() || quick.rate > 1.0 || *left > 0.0)
            .map(|(.., quick)| quick);
    }

    /// Horizontal acceleration that a step made in a hurry asks for, m/s².
    pub(super) fn hurries(&mut self, terms: &Terms, support: &Support) -> Option<[f64; 2]> {
        let quick = self.quick?;
        Some(self.capture.about(terms, support.polygon(), quick.zmp))
    }
}
