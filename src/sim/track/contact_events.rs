//! Contact by events: a foot is down when it touches the floor, not when the clock says so.
//!
//! The plan's time advances at a rate between 0 and [`FASTEST_RATE`]. It waits for a foot that should be down but finds
//! no floor, catches up after a foot that landed early, and adapts to the time of fall in the air. A stream cannot wait
//! for its figure, nor run ahead of the frames received, so its rate is at least 1, and exceeds 1 only while the figure
//! is behind.

use super::params::common::FREEZE_TIME;
use super::params::contact::{
    EARLIEST_AFTER_FLIGHT, FASTEST_RATE, IMMINENT, LATEST, LONGEST_LAG, STREAM_RATE,
};
use super::params::flight::{JUMP_INTERVAL, LEAST_FALL_TIME, LEAST_GRAVITY, LONGEST, SLOWEST_RATE};
use super::step_plan::{Footfall, StepPlan};
use super::{Landing, StepTracker};
use crate::dynamics::Terms;
use crate::motion::Target;

impl StepTracker {
    /// Lifts feet when planned and plants them when they touch. Returns the rate at which the plan advances. `sample`:
    /// the motion now.
    pub(super) fn update_contacts(
        &mut self,
        terms: &Terms,
        dt: f64,
        sample: impl Fn() -> Target,
    ) -> f64 {
        let live = self.is_live();
        let at_most = |rate: f64| (1.0 + self.clock.lag / dt).clamp(1.0, rate);
        let (mut rate, catch_up) = if live {
            (at_most(STREAM_RATE), at_most(FASTEST_RATE))
        } else {
            (1.0, FASTEST_RATE)
        };
        if live && let Some(side) = self.recovery.support.foot() {
            // The foot came down early. If its time has come and it still stands, this was its step.
            if self.recovery_step().is_none()
                && let Some(f) = self.planned(side)
            {
                self.land(terms, side, &f, 0.0);
                self.recovery.support.end();
            }
            return rate;
        }
        self.recovery.support.update_pace(dt);
        let pace = self.recovery.support.pace();
        if let Some(pace) = pace.filter(|_| self.recovery.support.is_active()) {
            return pace;
        }
        if self.recovery_step().is_some() {
            return if self.clock.lag < LONGEST_LAG {
                0.0
            } else {
                rate
            };
        }
        let airborne = self.clock.started && self.is_airborne();
        if !live && airborne {
            rate = self.rate_in_flight(terms);
        }
        if let Some(early) = &self.timing.early {
            rate = early.rate;
        }
        let earliest = if airborne && terms.com_velocity.z < 0.0 {
            EARLIEST_AFTER_FLIGHT
        } else {
            FREEZE_TIME
        };
        if !self.clock.started {
            self.clock.started = true;
            let phase = self.clock.phase;
            for side in 0..2 {
                self.feet[side].down = self.planned(side).is_some();
                self.feet[side].lifted = self.plan().map_or(0.0, |p| p.last_off(side, phase));
            }
        }
        let mut lifted = [false; 2];
        for side in 0..2 {
            let planned = self.planned(side);
            let (foot, other) = (self.feet[side], 1 - side);
            match planned {
                Some(_) if foot.down => self.feet[side].early = false,
                None if foot.down && foot.early => {
                    if !self.is_due(side) {
                        rate = catch_up;
                    }
                }
                None if foot.down => {
                    // Wait until the other foot, which is due, has landed.
                    if self.feet[other].down || self.planned(other).is_none() {
                        self.feet[side].lift(self.clock.phase);
                        lifted[side] = true;
                    }
                }
                Some(f) => {
                    if self.touches(terms, side) || foot.late > LATEST {
                        self.land(terms, side, &f, foot.late);
                    } else {
                        rate = 0.0;
                        self.feet[side].late += dt;
                    }
                }
                None => {
                    if self.touches(terms, side)
                        && let Some(f) = self.next(side)
                        && self.until(f.on) < earliest
                    {
                        let late = (self.clock.phase - f.on) / self.speed();
                        self.land(terms, side, &f, late);
                        self.feet[side].early = true;
                    }
                }
            }
        }
        if lifted != [false; 2] {
            let mut target = sample();
            self.anchor.transform().apply_to(&mut target);
            let poses = self.capture.feet(&target.posture);
            for side in (0..2).filter(|side| lifted[*side]) {
                self.feet[side].release = Self::ankle(terms, side) - poses[side].at;
            }
        }
        pace.map_or(rate, |pace| rate.min(pace))
    }

    /// Whether the plan has foot `side`, which landed early, down so soon that catching up would only jolt the body.
    /// Not before another flight, for which no time can be lost.
    fn is_due(&self, side: usize) -> bool {
        let flies_on = |p: &StepPlan, f: &Footfall| p.next_flight(f.on).is_some();
        self.next(side).is_some_and(|f| {
            self.until(f.on) < IMMINENT && !self.plan().is_some_and(|p| flies_on(p, &f))
        })
    }

    /// Rate at which a jump plays in the air, so that its feet are ready when the body lands, which is earlier than
    /// planned if the take-off was too slow. The legs of a runner never stop swinging, and accelerating them would turn
    /// the trunk, so a plan whose feet leave one after the other keeps its rate.
    ///
    /// The body falls from its height `h` above the motion's with speed `v`: `v t − g t²/2` is the height of the
    /// landing at the real time `t`.
    fn rate_in_flight(&self, terms: &Terms) -> f64 {
        let next = (0..2).filter_map(|side| self.planned(side).or(self.next(side)));
        let on = next.map(|f| f.on).fold(f64::INFINITY, f64::min);
        let planned = self.until(on);
        let error = &self.height_error;
        let g = error.gravity;
        let apart = (self.feet[0].lifted - self.feet[1].lifted).abs() / self.speed();
        if apart > JUMP_INTERVAL || !(planned > 0.0 && planned < LONGEST) || g < LEAST_GRAVITY {
            return 1.0;
        }
        let v = terms.com_velocity.z;
        let drop = error.height - (v - error.speed) * planned + 0.5 * g * planned * planned;
        let real = (v + (v * v + 2.0 * g * drop).max(0.0).sqrt()) / g;
        (planned / real.max(LEAST_FALL_TIME)).clamp(SLOWEST_RATE, FASTEST_RATE)
    }

    /// Plants a foot, and anchors the plan where it stands.
    fn land(&mut self, terms: &Terms, side: usize, planned: &Footfall, late: f64) {
        let planned = self.placed(planned);
        let actual = self.places(terms)[side];
        self.events.landing = Some(Landing {
            side,
            late,
            off: actual.at - self.anchor.point(planned.at),
        });
        self.anchor
            .land(planned.at, planned.yaw, actual.at, actual.yaw);
        self.clock.landings += 1;
        let foot = &mut self.feet[side];
        foot.down = true;
        foot.early = false;
        foot.late = 0.0;
        foot.shift = [0.0; 2];
    }
}
