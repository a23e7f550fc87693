//! The capture point, and the foothold that removes its error when the foot lands.
//!
//! The body is a linear inverted pendulum of height `z` about the zero-moment point `p`: `c̈ = ω²(c − p) + a` with
//! `ω² = (g + z̈)/z` and the acceleration `a` by outside forces. Its unstable part is the capture point `ξ = c + ċ/ω`
//! (divergent component of motion; Hof 2008, Englsberger et al. 2015), `ξ̇ = ω(ξ − p)`, so about a fixed `p`
//!
//! `ξ(t) = p + (ξ − p) e^{ωt}`.
//!
//! The error `e = ξ − ξ_ref` against the motion's is driven out by `p = p_ref + (1 + k) e` as far as the support
//! allows. That removes a part `d` of it; `(e − d) e^{ωt} + d` remains at the touch-down in `t` seconds.
//!
//! A foothold displaced by `δ` moves the plan, but not the foot that stands behind. While the weight shifts forward,
//! the zero-moment point differs from the plan's by `−δ` times the share that the foot behind still carries. If that
//! share falls evenly from one to zero in the double support `D`, an error `e` at the touch-down is gone at the end of
//! `D` with `δ = e x/(1 − e^{−x})`, `x = ωD` ([`Capture::displacement_gain`]).

use super::filter_gain;
use super::foot_places::{FootPlace, turn};
use super::leg_collision::foothold;
use super::params::capture::{
    CROSSING_GAIN, CROSSING_MOST, GAIN, LEAST_HEIGHT, LEAST_LOAD, LONGEST_FORECAST, MOMENT_OFFSET,
    REACH_ACROSS, REACH_ALONG, SEPARATION, SMOOTHING_TIME, YIELDED,
};
use super::params::leg_collision::FOOTHOLD_DISTANCE;
use crate::body::topology::{FEET, outward};
use crate::body::{Body, Links, Posture};
use crate::control::PointTarget;
use crate::dynamics::{Kinematics, Terms, center_of_mass, momentum};
use crate::math::curve::fall;
use crate::math::exp::exp;
use crate::math::{Quat, Vec3};
use crate::motion::Target;
use crate::plan::foot_lock::AnklePose;
use crate::plan::params::common::ZMP_INSET;
use crate::support::Polygon;
use serde::{Deserialize, Serialize};

/// Capacity for corners of a support polygon.
const CORNERS: usize = 64;

/// The capture point against the motion's. Points and directions are horizontal, world axes.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Capture {
    /// Error `e` of the capture point, m.
    pub error: [f64; 2],
    /// Part `d` of it that the zero-moment point can remove, m.
    handled: [f64; 2],
    /// Frequency `ω` of the pendulum, 1/s.
    omega: f64,
    /// The capture point `ξ`, m.
    point: [f64; 2],
    /// Displacement of the capture point once the angular momentum beyond the motion's is given up, m.
    momentum_offset: [f64; 2],
    /// Acceleration `a` of the body by outside forces, m/s².
    disturbance: [f64; 2],
    #[serde(skip)]
    inner: Polygon,
    #[serde(skip)]
    stance: Polygon,
    /// Inertia of the body without loads.
    #[serde(skip)]
    links: Links,
    #[serde(skip)]
    kin: Kinematics<f64>,
}

/// Filter gain towards a new foothold in `dt` seconds.
pub(super) fn smoothing(dt: f64) -> f64 {
    filter_gain(dt, SMOOTHING_TIME)
}

impl Capture {
    /// A capture point for figures with this body.
    pub fn new(body: &Body) -> Self {
        Self {
            error: [0.0; 2],
            handled: [0.0; 2],
            omega: 1.0,
            point: [0.0; 2],
            momentum_offset: [0.0; 2],
            disturbance: [0.0; 2],
            inner: Polygon::with_capacity(CORNERS),
            stance: Polygon::with_capacity(CORNERS),
            links: Links::new(body),
            kin: Kinematics::default(),
        }
    }

    /// Adds the values that follow from the body, after reading from a checkpoint.
    pub(super) fn complete(&mut self, body: &Body) {
        self.links = Links::new(body);
    }

    /// Poses of both feet in a posture.
    pub(super) fn feet(&mut self, posture: &Posture) -> [AnklePose; 2] {
        self.kin.set_posture(&self.links, posture);
        FEET.map(|s| AnklePose {
            at: posture.root_position + self.kin.position[s.index()],
            rotation: Quat::from_mat3(&self.kin.rotation[s.index()]),
        })
    }

    /// The capture point of a planned motion, which carries no loads, m.
    pub(super) fn point_of(&mut self, target: &Target) -> [f64; 2] {
        let links = &self.links;
        self.kin.set_posture(links, &target.posture);
        self.kin.set_velocity(&target.velocity);
        let (c, mass) = center_of_mass(links, &self.kin);
        let c = target.posture.root_position + c;
        let v = momentum(links, &self.kin).linear * (1.0 / mass);
        [c.x + v.x / self.omega, c.y + v.y / self.omega]
    }

    /// Updates outside forces and angular momentum.
    ///
    /// * `planned`: angular momentum of the motion, N·m·s.
    /// * `lands`: whether a step is timed. Pushes seldom go through the centre of mass. When a body gives up the
    ///   angular momentum `L` that it received, its capture point moves, because angular momentum about the foot is
    ///   conserved: `Δξ = (L_y, −L_x)/(m z ω)`.
    /// * `steps`: a stepping body moves with a push. A standing body yields with its trunk, which takes up the push as
    ///   angular momentum; the more of that it has, the more it moves with the push, too.
    pub(super) fn update_disturbance(
        &mut self,
        terms: &Terms,
        planned: Vec3,
        lands: bool,
        steps: bool,
    ) {
        let (rows, _) = terms.spin_rows();
        let of = |k: usize| -> f64 {
            let velocity = &terms.state.velocity;
            rows[k].iter().zip(velocity).map(|(a, v)| a * v).sum()
        };
        let excess = [of(0) - planned.x, of(1) - planned.y];
        self.momentum_offset = [0.0; 2];
        if lands {
            let per = 1.0 / (terms.mass * terms.com.z.max(LEAST_HEIGHT) * self.omega);
            self.momentum_offset = [excess[1] * per, -excess[0] * per];
        }
        // `M v̇ + h` is the floor's force; the force rows of `h` contain the outside forces.
        let (bias, h) = (terms.com_bias, &terms.h);
        let pushed = [bias.x - h[3] / terms.mass, bias.y - h[4] / terms.mass];
        let turns = Vec3::on_floor(excess).level();
        let share = if steps {
            1.0
        } else {
            1.0 - fall(turns, (0.2 * YIELDED, YIELDED))
        };
        self.disturbance = pushed.map(|a| share * a);
    }

    /// Sets the support that [`Capture::within`] uses.
    pub(super) fn set_stance(&mut self, points: impl Iterator<Item = [f64; 2]>) {
        self.stance.set_hull(points);
        self.inner.set_inset(&self.stance, ZMP_INSET);
    }

    /// The nearest point to `p` in the support that was set last.
    pub(super) fn within(&self, p: [f64; 2]) -> [f64; 2] {
        self.inner.closest(p).map_or(p, |c| c.point)
    }

    /// The zero-moment point about which the capture point comes to `goal` in `time` seconds: the inverse of
    /// [`Capture::after`].
    pub(super) fn zmp_for(&self, goal: [f64; 2], time: f64) -> [f64; 2] {
        let grows = exp(self.omega * time);
        std::array::from_fn(|k| {
            (goal[k] - self.momentum_offset[k] - self.point[k] * grows) / (1.0 - grows)
        })
    }

    /// The capture point after `time` seconds about `zmp`, m.
    pub(super) fn pendulum(&self, zmp: [f64; 2], time: f64) -> [f64; 2] {
        let grows = exp(self.omega * time);
        std::array::from_fn(|k| zmp[k] + (self.point[k] - zmp[k]) * grows)
    }

    /// The same with the excess of angular momentum given up.
    pub(super) fn after(&self, zmp: [f64; 2], time: f64) -> [f64; 2] {
        let at = self.pendulum(zmp, time);
        std::array::from_fn(|k| at[k] + self.momentum_offset[k])
    }

    /// Horizontal acceleration of the pendulum about the point of `polygon` nearest to `zmp`, m/s².
    pub(super) fn fall_about(
        &mut self,
        terms: &Terms,
        polygon: &Polygon,
        zmp: [f64; 2],
    ) -> [f64; 2] {
        self.inner.set_inset(polygon, ZMP_INSET);
        self.acceleration(terms, self.within(zmp))
    }

    /// Horizontal acceleration of the pendulum over the stance `points` with which it falls slowest, m/s².
    pub(super) fn slowest_fall(
        &mut self,
        terms: &Terms,
        points: impl Iterator<Item = [f64; 2]>,
    ) -> [f64; 2] {
        let p = self.holding_zmp(points);
        self.acceleration(terms, p)
    }

    /// Horizontal acceleration of the pendulum about `zmp`, m/s².
    fn acceleration(&self, terms: &Terms, zmp: [f64; 2]) -> [f64; 2] {
        let w2 = self.omega * self.omega;
        let c = [terms.com.x, terms.com.y];
        std::array::from_fn(|k| w2 * (c[k] - zmp[k]) + self.disturbance[k])
    }

    /// Compares the state with the desired centre of mass over a support `polygon`.
    pub fn update(
        &mut self,
        terms: &Terms,
        com: &PointTarget,
        polygon: &Polygon,
        gravity: f64,
        dt: f64,
    ) {
        let height = com.now.z.max(LEAST_HEIGHT);
        let w = (gravity.max(LEAST_LOAD) / height).sqrt();
        self.omega = w;
        let ff = (com.next_velocity - com.now_velocity) * (1.0 / dt);
        let w2 = (gravity + ff.z).max(LEAST_LOAD) / height;
        let (c, r) = (terms.com, com.now);
        let (dc, dr) = (terms.com_velocity, com.now_velocity);
        self.point = [c.x + dc.x / w, c.y + dc.y / w];
        let e = [c.x - r.x + (dc.x - dr.x) / w, c.y - r.y + (dc.y - dr.y) / w];
        self.error = e;
        let planned = [r.x - ff.x / w2, r.y - ff.y / w2];
        self.inner.set_inset(polygon, ZMP_INSET);
        let can = self.within(std::array::from_fn(|k| planned[k] + (1.0 + GAIN) * e[k]));
        // The part that the zero-moment point removes lies along the error, and is at most the whole error.
        let along = (can[0] - planned[0]) * e[0] + (can[1] - planned[1]) * e[1];
        let share = (along / (e[0] * e[0] + e[1] * e[1]).max(1e-12)).clamp(0.0, 1.0);
        self.handled = e.map(|x| share * x);
    }

    /// Length of the error, m.
    pub fn off(&self) -> f64 {
        Vec3::on_floor(self.error).level()
    }

    /// The capture point `ξ`, m.
    pub fn point(&self) -> [f64; 2] {
        self.point
    }

    /// Frequency `ω` of the pendulum, 1/s.
    pub fn omega(&self) -> f64 {
        self.omega
    }

    /// The zero-moment point over the stance `points` that slows the capture point most.
    pub(super) fn holding_zmp(&mut self, points: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
        self.set_stance(points);
        self.within(self.point)
    }

    /// Distance of the capture point inside the hull of `points`, m.
    pub(super) fn margin(&mut self, points: impl Iterator<Item = [f64; 2]>) -> Option<f64> {
        self.stance.set_hull(points);
        self.stance.closest(self.point).map(|c| c.margin)
    }

    /// The wanted acceleration `a` of the centre of mass (m/s²) with its zero-moment point brought back into the
    /// support, because a point beyond it would only turn the trunk. Returns the horizontal part. `None` without a
    /// support.
    ///
    /// `momentum_rate`, N·m, is the rate of the motion's angular momentum. It matters because a leg that brakes before
    /// it lands moves the zero-moment point by centimetres.
    pub(super) fn feasible(
        &self,
        terms: &Terms,
        a: Vec3,
        momentum_rate: Vec3,
        polygon: &Polygon,
        gravity: f64,
    ) -> Option<[f64; 2]> {
        let c = terms.com;
        let load = (gravity + a.z).max(LEAST_LOAD);
        let w2 = load / c.z.max(LEAST_HEIGHT);
        let moved = [momentum_rate.y, -momentum_rate.x].map(|m| m / (terms.mass * load));
        let far = Vec3::on_floor(moved).level().max(MOMENT_OFFSET);
        let moved = moved.map(|t| t * MOMENT_OFFSET / far);
        let middle = [c.x - moved[0], c.y - moved[1]];
        let push = self.disturbance;
        let wanted = [
            middle[0] - (a.x - push[0]) / w2,
            middle[1] - (a.y - push[1]) / w2,
        ];
        let p = polygon.closest(wanted)?.point;
        Some(std::array::from_fn(|k| w2 * (middle[k] - p[k]) + push[k]))
    }

    /// Displacement of a foothold per metre of error at its touch-down, such that the error is gone after the following
    /// `double_support` (s): after the touch-down `ė = ω (e + δ (1 − t/D))` from `e − δ`.
    pub(super) fn displacement_gain(&self, double_support: f64) -> f64 {
        let x = self.omega * double_support;
        // Closer to 0 the quotient, which tends to 1, loses its digits.
        if x > f64::EPSILON.sqrt() {
            x / (1.0 - exp(-x))
        } else {
            1.0
        }
    }

    /// Error that remains after `remaining` seconds of swing, m.
    pub fn left_over(&self, remaining: f64) -> [f64; 2] {
        let grows = exp(self.omega * remaining.min(LONGEST_FORECAST));
        std::array::from_fn(|k| {
            let (e, d) = (self.error[k], self.handled[k]);
            (e - d) * grows + d
        })
    }
}

/// Limits the displacement `d` (m) of the foothold `home` of foot `side` to the reach of a leg beside the stance foot,
/// whose ankle is at `stance`. `shorter`: largest reduction of the step along its heading, m.
///
/// A displacement to the side is limited by the separation of the feet. A larger one may bring the foot closer, and
/// across the stance foot, because most pushes to the side cannot be caught otherwise; the foothold then lies before or
/// behind the stance foot.
pub(super) fn within_reach(
    d: [f64; 2],
    home: FootPlace,
    stance: Vec3,
    side: usize,
    shorter: f64,
) -> [f64; 2] {
    let (back, outward) = (turn(-home.yaw), outward(side));
    let mut local = back.rotate(Vec3::on_floor(d));
    let pressed =
        (CROSSING_GAIN * (local.y.abs() - SEPARATION)).clamp(0.0, SEPARATION + CROSSING_MOST);
    local.y = local.y.clamp(-REACH_ACROSS, REACH_ACROSS);
    let planned = back.rotate((home.at - stance).horizontal());
    local.x = if planned.x < 0.0 {
        local.x.clamp(-REACH_ALONG, shorter)
    } else {
        local.x.clamp(-shorter, REACH_ALONG)
    };
    // If the planned step itself crosses, crossing is allowed.
    let least = (SEPARATION - pressed).min(planned.y * outward);
    let away = (planned.y + local.y) * outward;
    if away < least {
        local.y = least * outward - planned.y;
    }
    let beside = FOOTHOLD_DISTANCE.min(planned.y * outward);
    let away = (planned.y + local.y) * outward;
    let (x, y) = foothold((planned.x + local.x, away), beside);
    local.x = x - planned.x;
    local.y = y * outward - planned.y;
    let world = turn(home.yaw).rotate(local);
    [world.x, world.y]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
        (a[0] - b[0]).hypot(a[1] - b[1])
    }

    fn place(at: Vec3) -> FootPlace {
        FootPlace { at, yaw: 0.0 }
    }

    #[test]
    fn about_the_zmp_chosen_for_it_the_capture_point_comes_to_its_goal() {
        let capture = Capture {
            omega: 3.1,
            point: [0.3, 0.2],
            momentum_offset: [0.01, -0.04],
            ..Capture::new(&Body::adult_man())
        };
        for time in [0.1, 0.3, 0.6] {
            let goal = [0.6, 0.1];
            let zmp = capture.zmp_for(goal, time);
            let off = apart(capture.after(zmp, time), goal);
            assert!(off < 1e-12, "{off:e} m after {time} s");
        }
    }

    #[test]
    fn a_displaced_foothold_takes_the_error_away_by_the_end_of_the_double_support() {
        let capture = Capture {
            omega: 3.1,
            ..Capture::new(&Body::adult_man())
        };
        assert_eq!(capture.displacement_gain(0.0), 1.0);
        for time in [1e-3, 0.1, 0.3] {
            let (before, steps) = (0.12, 20_000);
            let dt = time / f64::from(steps);
            let moved = before * capture.displacement_gain(time);
            let mut error = before - moved;
            for k in 0..steps {
                let carried = 1.0 - (f64::from(k) + 0.5) / f64::from(steps);
                error += dt * capture.omega * (error + moved * carried);
            }
            assert!(error.abs() < 1e-4 * before, "{error} m after {time} s");
        }
    }

    #[test]
    fn steps_get_shorter_by_more_than_longer() {
        let home = Vec3::X * 0.6 + Vec3::Y * 0.2;
        let ahead = |d: f64, shorter: f64| {
            let at = |home| within_reach([d, 0.0], place(home), Vec3::zero(), 0, shorter)[0];
            // A backward step gets shorter in the forward direction.
            let back = Vec3 { x: -home.x, ..home };
            let mirrored = within_reach([-d, 0.0], place(back), Vec3::zero(), 0, shorter)[0];
            assert!((at(home) + mirrored).abs() < 1e-15);
            at(home)
        };
        assert!((ahead(1.0, 0.5) - REACH_ALONG).abs() < 1e-15);
        assert!((ahead(-1.0, 0.5) + 0.5).abs() < 1e-15);
        assert!((ahead(-1.0, REACH_ALONG) + REACH_ALONG).abs() < 1e-15);
    }

    #[test]
    fn a_step_that_the_plan_crosses_with_goes_where_it_catches_the_body() {
        // In a turn on the right foot, the left foot lands 36 cm to the right of it.
        for ahead in [-0.2, -0.03, 0.03, 0.2] {
            let home = Vec3 {
                x: ahead,
                y: -0.36,
                z: 0.0,
            };
            for d in [[0.0, 0.0], [0.01, -0.01], [-0.01, -0.01], [0.0, 0.02]] {
                let at = within_reach(d, place(home), Vec3::zero(), 0, REACH_ALONG);
                let away = apart(at, d);
                assert!(
                    away <= d[0].hypot(d[1]) + 1e-12,
                    "{d:?} from {ahead}: {at:?}"
                );
            }
        }
        // A step that does not cross lands beside the other foot, or passes it.
        let home = Vec3::Y * 0.15 + Vec3::X * 0.05;
        let at = within_reach([0.0, -0.2], place(home), Vec3::zero(), 0, REACH_ALONG);
        let (x, y) = (home.x + at[0], home.y + at[1]);
        assert!(y >= FOOTHOLD_DISTANCE - 1e-12 || x >= 0.16, "{at:?}");
    }
}
