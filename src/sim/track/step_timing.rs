//! Step timing: steps that come sooner than in the clip, with time and place chosen together.
//!
//! An error of the capture point grows nearly threefold in a third of a second, and a clip's own step takes half a
//! second. After a hard push, people put the swinging foot down at once, and take the next step quickly too (Hof,
//! Vermerris & Gjaltema 2010; Vlutters et al. 2016). So the plan is played faster until the foot lands.
//!
//! For each rate `ρ` the landing comes after `t = t₀/ρ`. The zero-moment point `p`, within the sole, is chosen such
//! that `ξ(t) = p + (ξ − p) e^{ωt}` comes as near as it can to its place relative to the planned foothold; the foothold
//! `f` with the motion's distance from `ξ(t)` catches the body, displaced by a little more for the following double
//! support ([`super::capture_point`]). The foothold that is `reached` is limited by the leg's length and speed. The
//! rate with the least `|f − reached| + h (ρ − 1) + w |reached − planned|` is taken (Koolen et al. 2012). Until then
//! the centre of mass follows the pendulum about `p`, because the motion's would run away from the body.

use super::StepTracker;
use super::capture_point::within_reach;
use super::foot_places::stance_points;
use super::params::capture::REACH_ACROSS;
use super::params::contact::FASTEST_RATE;
use super::params::step_timing::{
    EARLIEST_DECISION, EFFORT, ERROR, FOOT_SPEED, HURRY, LATEST_DECISION, RATES,
};
use super::step_plan::Footfall;
use crate::dynamics::Terms;
use crate::math::Vec3;
use crate::motion::Target;
use crate::support::Support;
use serde::{Deserialize, Serialize};

/// The motion's capture point at a touch-down.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct PlannedLanding {
    /// Foot: 0 left, 1 right.
    side: usize,
    /// Clip time of the touch-down, s.
    on: f64,
    /// From the foothold to the capture point, as planned, m.
    offset: Vec3,
}

/// A step that comes sooner than planned.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct EarlyStep {
    /// Foot: 0 left, 1 right.
    pub(super) side: usize,
    /// Clip time of the touch-down, s.
    on: f64,
    /// Rate at which the motion is played.
    pub(super) rate: f64,
    /// The foothold, world, m.
    pub(super) place: Vec3,
    /// Desired zero-moment point, world, m.
    pub(super) zmp: [f64; 2],
}

/// The next landing, and the decision about it.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct StepTiming {
    /// The motion's state at the landing, while it matters.
    pub(super) landing: Option<PlannedLanding>,
    /// The step, if it comes sooner than planned.
    pub(super) early: Option<EarlyStep>,
}

impl StepTiming {
    /// The foot that lands next, if that matters.
    pub(super) fn side(&self) -> Option<usize> {
        self.landing.map(|l| l.side)
    }
}

impl StepTracker {
    /// The next touch-down: its foot and its stance. `None` for a stream, which cannot be played faster than it
    /// arrives, and before a flight, in which the body is not a pendulum.
    fn coming_step(&self) -> Option<(usize, Footfall)> {
        let (plan, phase) = (self.plan()?, self.clock.phase);
        let flies = self.is_airborne() || plan.next_flight(phase).is_some();
        if flies || plan.is_live() || plan.is_over(phase) {
            return None;
        }
        let stand = self.feet.iter().all(|f| f.down);
        (0..2)
            .filter(|side| stand || !self.feet[*side].down)
            .filter_map(|side| Some((side, self.next(side)?)))
            .min_by(|a, b| a.1.on.total_cmp(&b.1.on))
    }

    /// Looks up the motion's capture point at the next touch-down. `sample`: the motion at a time from now, s.
    pub(super) fn predict_landing(&mut self, sample: impl Fn(f64) -> Target) {
        let known = self.timing.landing.take();
        if !self.is_stepping() || (self.timing.early.is_none() && self.capture.off() < ERROR) {
            return;
        }
        let Some((side, f)) = self.coming_step() else {
            return;
        };
        let known = known.filter(|k| (k.side, k.on) == (side, f.on));
        self.timing.landing = known.or_else(|| {
            let place = self.placed(&f).at;
            let xi = self.capture.point_of(&sample(self.until(f.on)));
            Some(PlannedLanding {
                side,
                on: f.on,
                offset: Vec3::on_floor(xi) - place.horizontal(),
            })
        });
    }

    /// Decides whether the next foot lands sooner than planned, and if so, where.
    pub(super) fn update_step_timing(&mut self, terms: &Terms, support: &Support) {
        let before = self.timing.early.take();
        let Some(((side, f), landing)) = self.coming_step().zip(self.timing.landing) else {
            return;
        };
        let same = |a: (usize, f64)| a == (side, f.on);
        if !same((landing.side, landing.on)) {
            return;
        }
        let before = before.filter(|e| same((e.side, e.on)));
        let planned = self.until(f.on);
        if planned < LATEST_DECISION {
            self.timing.early = before;
        }
        if !(LATEST_DECISION..EARLIEST_DECISION).contains(&planned) {
            return;
        }
        let stance = self.planned(side).filter(|_| self.feet[side].down);
        let stands = stance.map_or(0.0, |now| self.until(now.off).max(0.0));
        let home = self.mapped(&f);
        let offset = self.turned(landing.offset);
        let [swing, stance] = [side, 1 - side].map(|k| Self::ankle(terms, k).horizontal());
        let goal = home.at + offset;
        let gain = self.displacement_gain(side, &f);
        self.capture.set_stance(stance_points(support, side));
        let tried = (0..=RATES).map(|k| {
            let rate = 1.0 + (FASTEST_RATE - 1.0) * f64::from(k) / f64::from(RATES);
            let time = planned / rate;
            let zmp = self.capture.zmp_for([goal.x, goal.y], time);
            let xi = self.capture.after(self.capture.within(zmp), time);
            let d = Vec3::on_floor([xi[0] - goal.x, xi[1] - goal.y]) * gain;
            let catches = home.at + d;
            // A body that is off its plan by a walking speed cannot keep its stride, so the leg's reach also limits the
            // step along its heading.
            let mut place = home.at
                + Vec3::on_floor(within_reach([d.x, d.y], home, stance, side, REACH_ACROSS));
            let (way, air) = (place - swing, (time - stands / rate).max(0.0));
            if k > 0 && way.norm() > FOOT_SPEED * air {
                place = swing + way * (FOOT_SPEED * air / way.norm());
            }
            let left = (catches - place).norm();
            let cost = left + HURRY * (rate - 1.0) + EFFORT * (place - home.at).norm();
            let step = EarlyStep {
                side,
                on: f.on,
                rate,
                place,
                zmp,
            };
            (cost, left, step)
        });
        let best = tried.min_by(|a, b| a.0.total_cmp(&b.0));
        self.timing.early = best
            .filter(|(_, left, step)| before.is_some() || step.rate > 1.0 || *left > 0.0)
            .map(|(.., step)| step);
    }
}
