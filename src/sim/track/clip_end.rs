//! Stops after a motion that ends while the figure moves, or that is broken off. The present step is completed, and the
//! last posture turns into standing at ease.

use super::foot_places::{FootPlace, FootPlaces, middle};
use super::params::common::STOP_TIME;
use super::planned_to_world::Anchor;
use super::trailing::Trailing;
use super::{Purpose, RecoveryStep, StepTracker};
use crate::body::Posture;
use crate::dynamics::Terms;
use crate::math::Vec3;
use crate::math::exp::exp;
use crate::motion::target::RestTimes;
use crate::motion::{Target, TargetPair};
use serde::{Deserialize, Serialize};

/// State of a figure that is coming to a stand.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct PlannedStand {
    /// The last of the motion, in the coordinates of the map.
    from: Target,
    /// Rate of the pendulum, 1/s.
    omega: f64,
    /// Time since the end of the clip, s.
    since: f64,
}

impl PlannedStand {
    /// The target `t` seconds after the motion: joints come to rest and to the stand, and the pelvis follows on the
    /// stable mode of the pendulum ([`super::trailing`]), so that the capture point of the target is that of the stand
    /// at once.
    fn target(&self, stand: &Posture, t: f64, dt: f64) -> Target {
        const TIMES: RestTimes = RestTimes {
            stopping: STOP_TIME,
            settling: STOP_TIME,
        };
        let mut out = self.from.to_rest(stand, TIMES, t, dt);
        let left = (self.from.posture.root_position - stand.root_position).horizontal()
            * exp(-self.omega * t);
        let z = out.posture.root_position.z;
        out.posture.root_position = (stand.root_position + left).horizontal() + Vec3::Z * z;
        let rate = left * -self.omega;
        (out.velocity[3], out.velocity[4]) = (rate.x, rate.y);
        out.planted = [true; 2];
        out
    }
}

impl StepTracker {
    /// Posture of a stand at ease.
    pub fn at_ease(&self) -> &Posture {
        &self.legs.at_ease
    }

    /// The posture in which the figure comes to a stand, after a motion that ended while it moved.
    pub fn stop_posture(&self) -> Option<&Posture> {
        self.is_stopping().then_some(&self.legs.at_ease)
    }

    /// Whether a clip has ended in motion and the figure, whose centre of mass moves at `com_velocity` (m/s), has not
    /// yet settled.
    pub fn comes_to_stand(&self, com_velocity: Vec3) -> bool {
        self.is_stopping() && !self.is_settled(com_velocity)
    }

    /// Whether a clip has ended in motion and no other motion has begun since.
    pub(super) fn is_stopping(&self) -> bool {
        self.followed.as_ref().is_some_and(|f| f.stop.is_some())
    }

    /// Breaks off a stepping motion at `last`, the present target (world). None of its later steps is made, and the
    /// figure comes to a stand in place. Returns the posture of that stand (world).
    pub fn break_off(&mut self, terms: &Terms, last: &Target) -> Posture {
        let planned = self.anchor.transform().power(-1.0).apply(last);
        self.trailing = Trailing::default();
        self.begin_stop(terms, &planned, Purpose::Recover);
        if let Some(f) = &mut self.followed {
            f.plan.break_off();
        }
        let mut stand = self.legs.at_ease;
        self.anchor.transform().apply_posture(&mut stand);
        stand
    }

    /// Turns the motion into standing, because it is over while the figure still moves. The present step is completed
    /// as a recovery step with this `purpose`, and more steps follow if the capture point requires them.
    pub(super) fn begin_stop(&mut self, terms: &Terms, last: &Target, purpose: Purpose) {
        let now = self.places(terms);
        let poses = self.capture.feet(&self.legs.at_ease);
        let home: FootPlaces = std::array::from_fn(|k| self.place_of(k, poses[k]));
        // The figure comes to a stand at the foot over which the body moves, with the mean heading of both feet.
        let xi = self.capture.point();
        let far = |k: usize| (now[k].at - Vec3::on_floor(xi)).level();
        let side = self.only_stance();
        let side = side.unwrap_or_else(|| usize::from(far(1) < far(0)));
        let before = self.anchor.transform();
        let facing = |places: &FootPlaces| FootPlace {
            yaw: middle(places).yaw,
            ..places[side]
        };
        self.anchor = Anchor::between(facing(&home), facing(&now));
        // Express the same posture at the same place in the world in coordinates of the new anchor.
        let change = self.anchor.transform().power(-1.0).after(before);
        let from = change.apply(last);
        self.trailing.rebase(self.anchor.transform());
        if let Some(f) = &mut self.followed {
            f.stop = Some(PlannedStand {
                from,
                omega: self.capture.omega(),
                since: 0.0,
            });
        }
        for side in 0..2 {
            if !self.feet[side].down {
                let step =
                    RecoveryStep::new(side, purpose, Self::ankle(terms, side), now[side].yaw);
                self.recovery.step.begin(step);
            }
        }
    }

    /// The next tick of `dt` seconds of a motion that comes to a stand; `None` before its clip has ended.
    pub(super) fn advance_stop(&mut self, dt: f64) -> Option<TargetPair> {
        let stop = self.followed.as_mut()?.stop.as_mut()?;
        stop.since += dt;
        let standing = &self.legs.at_ease;
        Some(TargetPair {
            now: stop.target(standing, stop.since - dt, dt),
            next: stop.target(standing, stop.since, dt),
        })
    }
}
