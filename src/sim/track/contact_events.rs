//! Contact by events: feet are down when they touch, not when the clock says (WALKING §3).

use super::step_plan::{Footfall, StepPlan};
use super::{FOOT, Landing, StepTracker, TOUCH};
use crate::sim::dynamics::Terms;
use crate::sim::motion::Target;

/// A foot may land this long before its time, s; earlier touches are scuffs.
const EARLY: f64 = 0.06;
/// Who comes down from a flight may do so this long before, s.
const EARLY_DOWN: f64 = 0.2;
/// A foot that finds no floor counts as planted after this time, s.
const LATE: f64 = 0.15;
/// Rate at which the plan catches up with a foot that landed early.
const HURRY: f64 = 2.0;
/// A landing that the plan has within this time is waited for, s.
const SOON: f64 = 0.03;
/// Least rate of a motion in the air; feet that leave within this time of each other jump, s; no flight lasts longer
/// than this, s, nor is there any with less gravity than this, m/s².
const SLOWS: f64 = 0.5;
const TOGETHER: f64 = 0.1;
const LONGEST_FLIGHT: f64 = 1.0;
const LIGHT: f64 = 1.0;
/// Rate at which a figure that is behind its stream makes up for it, and how far it may fall behind in a step of its
/// own, s.
const CATCH_UP: f64 = 1.05;
const MOST_BEHIND: f64 = 0.5;

impl StepTracker {
    /// Contact by events: lifts feet when planned, plants them when they touch. Returns the rate at which the plan goes
    /// on.
    pub(super) fn schedule(&mut self, terms: &Terms, dt: f64, sample: impl Fn() -> Target) -> f64 {
        // A stream does not wait for its figure: what it is behind it makes up for. Nor can it be ahead of what has
        // come.
        let live = self.is_live();
        let most = |rate: f64| {
            if live {
                (1.0 + self.lag / dt).clamp(1.0, rate)
            } else {
                rate
            }
        };
        let (mut rate, hurry) = (if live { most(CATCH_UP) } else { 1.0 }, most(HURRY));
        if live && let Some(side) = self.wait.foot() {
            // Down before its turn, and still when that has come: the step under way was its own.
            if self.step.is_none()
                && let Some(f) = self.planned(side)
            {
                self.land(terms, side, &f, 0.0);
                self.wait.end();
            }
            return rate;
        }
        self.wait.keep(dt);
        if let Some(pace) = self.wait.pace().filter(|_| self.wait.waits()) {
            return pace;
        }
        if self.step.is_some() {
            return if self.lag < MOST_BEHIND { 0.0 } else { rate };
        }
        if !live && self.started && self.flies() {
            rate = self.rate_aloft(terms);
        }
        if let Some(quick) = &self.quick {
            rate = quick.rate;
        }
        let mut lifted = [false; 2];
        let comes_down = self.started && self.flies() && terms.com_velocity.z < 0.0;
        let early = if comes_down { EARLY_DOWN } else { EARLY };
        if !self.started {
            self.started = true;
            for side in 0..2 {
                self.feet[side].down = self.planned(side).is_some();
                self.feet[side].lifted = self.last_off(side);
            }
        }
        for side in 0..2 {
            let planned = self.planned(side);
            let touches = self.lowest(terms, side) < TOUCH;
            let mut foot = self.feet[side];
            if foot.down {
                if planned.is_some() {
                    foot.early = false;
                } else if foot.early {
                    if !self.is_due(side) {
                        rate = hurry;
                    }
                } else {
                    let other = 1 - side;
                    let waits = !self.feet[other].down && self.planned(other).is_some();
                    if !waits {
                        foot.lift(self.phase);
                        lifted[side] = true;
                    }
                }
                self.feet[side] = foot;
                continue;
            }
            if let Some(f) = planned {
                if touches || foot.late > LATE {
                    self.land(terms, side, &f, foot.late);
                } else {
                    rate = 0.0;
                    self.feet[side].late += dt;
                }
            } else if touches
                && let Some(f) = self.next(side)
                && (f.on - self.phase) / self.speed < early
            {
                self.land(terms, side, &f, (self.phase - f.on) / self.speed);
                self.feet[side].early = true;
            }
        }
        if lifted != [false; 2] {
            let mut target = sample();
            self.anchor.transform().apply_to(&mut target);
            let poses = self.capture.feet(&target.posture);
            for side in 0..2 {
                if lifted[side] {
                    self.feet[side].release =
                        terms.segment_position(FOOT[side].index()) - poses[side].0;
                }
            }
        }
        self.wait.pace().map_or(rate, |pace| rate.min(pace))
    }

    /// True if the plan has foot `side`, which landed early, down so soon that to hurry would only jolt the whole body.
    /// Who runs has no time to lose for the next flight.
    fn is_due(&self, side: usize) -> bool {
        let flies_on = |p: &StepPlan, f: &Footfall| p.next_flight(f.on).is_some();
        self.next(side).is_some_and(|f| {
            let soon = (f.on - self.phase) / self.speed < SOON;
            soon && !self.plan.as_ref().is_some_and(|p| flies_on(p, &f))
        })
    }

    /// Rate at which a jump goes on in the air: its feet are ready to land when the body comes down, which is earlier
    /// than planned for who left the floor too slowly. The legs of a runner swing all the time; hurried, they would
    /// turn the trunk.
    fn rate_aloft(&self, terms: &Terms) -> f64 {
        let next = (0..2).filter_map(|side| self.planned(side).or(self.next(side)));
        let on = next.map(|f| f.on).fold(f64::INFINITY, f64::min);
        let planned = (on - self.phase) / self.speed;
        let g = self.above.gravity;
        let apart = (self.feet[0].lifted - self.feet[1].lifted).abs() / self.speed;
        if apart > TOGETHER || !(planned > 0.0 && planned < LONGEST_FLIGHT) || g < LIGHT {
            return 1.0;
        }
        let v = terms.com_velocity.z;
        // Both fall alike: the height at which the motion lands, from here.
        let drop =
            self.above.height - (v - self.above.speed) * planned + 0.5 * g * planned * planned;
        let real = (v + (v * v + 2.0 * g * drop).max(0.0).sqrt()) / g;
        (planned / real.max(1e-3)).clamp(SLOWS, HURRY)
    }

    fn land(&mut self, terms: &Terms, side: usize, planned: &Footfall, late: f64) {
        let planned = self.placed(planned);
        let (actual, yaw) = self.place(terms, side);
        self.landing = Some(Landing {
            side,
            late,
            off: actual - self.anchor.point(planned.place),
        });
        self.anchor.land(planned.place, planned.yaw, actual, yaw);
        let foot = &mut self.feet[side];
        foot.down = true;
        foot.early = false;
        foot.late = 0.0;
        foot.shift = [0.0; 2];
    }
}
