//! Stops after a motion that ends while the figure moves, or that is broken off. The present step is completed, and the
//! last posture turns into standing at ease.

use super::foot_places::{FootPlace, FootPlaces, middle};
use super::params::common::STOP_TIME;
use super::planned_to_world::Anchor;
use super::{Purpose, RecoveryStep, StepTracker};
use crate::body::Posture;
use crate::body::topology::NV;
use crate::dynamics::Terms;
use crate::math::Vec3;
use crate::math::curve::smoothstep;
use crate::motion::{Target, TargetPair};
use serde::{Deserialize, Serialize};

/// State of a figure that is coming to a stand.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct PlannedStand {
    /// Last posture of the clip, as mapped to the world.
    from: Posture,
    /// Time since the end of the clip, s.
    since: f64,
}

/// From posture `a` to posture `b`. `u` beyond 0…1 is clamped.
fn interpolated(a: &Posture, b: &Posture, u: f64) -> Posture {
    let s = smoothstep(u);
    let spin = (b.root_rotation * a.root_rotation.conjugate()).log() * s;
    let mut rates = [0.0; NV];
    rates[..3].copy_from_slice(&spin.to_array());
    for (r, w) in rates[6..].iter_mut().zip(a.joint_difference(b)) {
        *r = s * w;
    }
    let mut out = *a;
    out.integrate(&rates, 1.0);
    out.root_position = a.root_position + (b.root_position - a.root_position) * s;
    out
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

    /// Breaks off a stepping motion at `last`, its present posture (world). None of its later steps is made, and the
    /// figure comes to a stand in place. Returns the posture of that stand (world).
    pub fn break_off(&mut self, terms: &Terms, last: &Posture) -> Posture {
        let mut planned = *last;
        self.anchor
            .transform()
            .power(-1.0)
            .apply_posture(&mut planned);
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
    pub(super) fn begin_stop(&mut self, terms: &Terms, last: &Posture, purpose: Purpose) {
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
        let mut from = *last;
        let change = self.anchor.transform().power(-1.0).after(before);
        change.apply_posture(&mut from);
        if let Some(f) = &mut self.followed {
            f.stop = Some(PlannedStand { from, since: 0.0 });
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
        let at = |t: f64| Target::still(interpolated(&stop.from, standing, t / STOP_TIME));
        Some(TargetPair {
            now: at(stop.since - dt),
            next: at(stop.since),
        })
    }
}
