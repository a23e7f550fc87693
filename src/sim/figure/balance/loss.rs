//! Decides whether balance is lost for good. If so, the controller, which would bend ankles and knees to keep soles
//! flat that cannot stay flat, hands over to the motors alone, and the figure falls passively.

use crate::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES};
use crate::body::{Body, SegmentId};
use crate::control::mode::BalanceReach;
use crate::dynamics::Terms;
use crate::figure::params::balance::{
    BODY_REACH, LEAST_HEIGHT, LOWEST_STEP, PAPER_REACH, RECOVERY_TIME, STEP_REACH,
};
use crate::report::MAX_CONTACTS;
use crate::support::{Polygon, Support};
use serde::{Deserialize, Serialize};

/// Distance outside its support from which a capture point can be brought back, m.
fn length(reach: BalanceReach, height: f64) -> f64 {
    match reach {
        BalanceReach::Body => BODY_REACH,
        BalanceReach::Step if height > LOWEST_STEP => STEP_REACH,
        BalanceReach::Paper | BalanceReach::Step => PAPER_REACH,
    }
}

/// The data by which balance is judged.
#[derive(Clone, Copy, Debug)]
pub struct Observation<'a> {
    /// The body.
    pub body: &'a Body,
    /// Dynamics of its state.
    pub terms: &'a Terms,
    /// Its support.
    pub support: &'a Support,
    /// Magnitude of gravity, m/s².
    pub gravity: f64,
    /// Length of the tick, s.
    pub dt: f64,
    /// The means that can bring the capture point back.
    pub reach: BalanceReach,
    /// Height of the centre of mass, as a share of the standing one.
    pub height: f64,
    /// Distance of the capture point from its place in the motion, m, while that motion walks. A walk falls from foot
    /// to foot: nothing is lost while the body falls towards the next foothold.
    pub off: Option<f64>,
}

/// Watches the capture point.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct BalanceWatch {
    #[serde(skip)]
    polygon: Polygon,
    lost: bool,
    inside: f64,
}

impl Default for BalanceWatch {
    fn default() -> Self {
        Self {
            polygon: Polygon::with_capacity(MAX_CONTACTS),
            lost: false,
            inside: 0.0,
        }
    }
}

impl BalanceWatch {
    /// Whether balance is lost.
    pub fn lost(&self) -> bool {
        self.lost
    }

    /// Forgets the past.
    pub fn reset(&mut self) {
        (self.lost, self.inside) = (false, 0.0);
    }

    /// Observes the state at the start of a tick. Allocates nothing.
    pub fn observe(&mut self, seen: &Observation<'_>) {
        let Observation {
            body,
            terms,
            support,
            gravity,
            ..
        } = *seen;
        if (support.points().is_empty() && support.rests().is_empty()) || gravity <= 0.0 {
            return; // Flight: there is no balance to lose.
        }
        let (c, v) = (terms.com, terms.com_velocity);
        let time = (c.z.max(LEAST_HEIGHT) / gravity).sqrt();
        let capture = [c.x + v.x * time, c.y + v.y * time];
        self.cover(body, terms, support);
        let outside = self.polygon.closest(capture).map_or(0.0, |c| -c.margin);
        let off = seen.off.unwrap_or(f64::INFINITY);
        if outside.min(off) > length(seen.reach, seen.height) {
            (self.lost, self.inside) = (true, 0.0);
        } else if self.lost {
            self.inside = if outside > 0.0 {
                0.0
            } else {
                self.inside + seen.dt
            };
            self.lost = self.inside < RECOVERY_TIME;
        }
    }

    /// The area that the supports can cover: the whole of each foot that touches with any part, since it can be put
    /// down again; of other segments the part that touches.
    fn cover(&mut self, body: &Body, terms: &Terms, support: &Support) {
        let points = support.points();
        let touches = |s: SegmentId| points.iter().any(|p| p.segment == s);
        let feet = [[L_FOOT, L_TOES], [R_FOOT, R_TOES]];
        let down = feet.map(|f| f.into_iter().any(touches));
        let soles = feet
            .iter()
            .zip(down)
            .filter(|(_, down)| *down)
            .flat_map(|(foot, _)| foot)
            .flat_map(|s| {
                let points = &body.segment(*s).contact_points;
                points.iter().map(|p| terms.point_world(s.index(), *p))
            });
        let others = points
            .iter()
            .filter(|p| !feet.iter().flatten().any(|s| *s == p.segment))
            .map(|p| p.position);
        let seats = support.rests().iter().filter(|r| r.is_level());
        let seats = seats.map(|r| r.position);
        self.polygon
            .set_hull(soles.chain(others).chain(seats).map(|p| [p.x, p.y]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::topology::SEGMENT_COUNT;
    use crate::math::Vec3;
    use crate::support::testing::{GRAVITY, mannequin, standing, terms};

    const DT: f64 = 1.0 / 60.0;

    /// Standing, with the whole body moving at `speed` to the front.
    fn moving(speed: f64) -> (Body, Terms, Support) {
        let body = mannequin();
        let mut state = standing(&body);
        state.velocity[3] = speed;
        let t = terms(&body, &state);
        let mut support = Support::default();
        support.update(&t, &body, Vec3::zero(), GRAVITY);
        (body, t, support)
    }

    fn seen<'a>(
        body: &'a Body,
        terms: &'a Terms,
        support: &'a Support,
        reach: BalanceReach,
    ) -> Observation<'a> {
        Observation {
            body,
            terms,
            support,
            gravity: GRAVITY,
            dt: DT,
            reach,
            height: 1.0,
            off: None,
        }
    }

    fn lost_after(watch: &mut BalanceWatch, speed: f64, reach: BalanceReach) -> bool {
        let (body, t, support) = moving(speed);
        watch.observe(&seen(&body, &t, &support, reach));
        watch.lost()
    }

    #[test]
    fn the_capture_point_decides_and_steps_reach_farther() {
        // Speed of the body at which the capture point is this far outside the toes.
        let (body, t, _) = moving(0.0);
        let front = (0..SEGMENT_COUNT)
            .flat_map(|s| {
                let points = &body.segments[s].contact_points;
                points.iter().map(move |p| (s, *p))
            })
            .map(|(s, p)| t.point_world(s, p))
            .filter(|p| p.z < 0.02)
            .fold(f64::MIN, |m, p| m.max(p.x));
        let speed = |outside: f64| (front + outside - t.com.x) * (GRAVITY / t.com.z).sqrt();
        for (reach, length) in [
            (BalanceReach::Body, 0.04),
            (BalanceReach::Paper, 0.15),
            (BalanceReach::Step, 0.6),
        ] {
            let mut watch = BalanceWatch::default();
            assert!(!lost_after(&mut watch, speed(length - 1e-3), reach));
            assert!(lost_after(&mut watch, speed(length + 1e-3), reach));
            // Balance counts as regained only after some time inside.
            let mut ticks = 0;
            while lost_after(&mut watch, 0.0, reach) {
                ticks += 1;
                assert!(ticks < 20, "found within a third of a second");
            }
            assert!(ticks >= 16);
        }
    }

    #[test]
    fn who_falls_where_the_motion_goes_has_lost_nothing() {
        let (body, t, support) = moving(5.0);
        let lost = |off: f64| {
            let mut watch = BalanceWatch::default();
            watch.observe(&Observation {
                off: Some(off),
                ..seen(&body, &t, &support, BalanceReach::Step)
            });
            watch.lost()
        };
        assert!(!lost(0.0) && !lost(0.59) && lost(0.61));
    }

    #[test]
    fn nothing_is_lost_in_the_air() {
        let (body, mut t, mut support) = moving(5.0);
        t.com_velocity.x = 5.0;
        let mut state = standing(&body);
        state.posture.root_position.z += 1.0;
        support.update(&terms(&body, &state), &body, Vec3::zero(), GRAVITY);
        let mut watch = BalanceWatch::default();
        watch.observe(&seen(&body, &t, &support, BalanceReach::Body));
        assert!(!watch.lost());
    }
}
