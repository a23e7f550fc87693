//! The capture point (divergent component of motion) and where to step so that the error it has is gone when the foot
//! lands (WALKING §4).

use super::leg_collision::{BESIDE, foothold};
use crate::sim::body::topology::{L_FOOT, R_FOOT};
use crate::sim::body::{Body, Links, Posture};
use crate::sim::control::PointTarget;
use crate::sim::dynamics::{Kinematics, Terms, center_of_mass, momentum};
use crate::sim::math::exp::exp;
use crate::sim::math::{Quat, Vec3};
use crate::sim::motion::Target;
use crate::sim::support::Polygon;

/// Gain k of `p* = p_ref + (1 + k) e`.
const GAIN: f64 = 1.0;
/// The zero-moment point stays this far inside the polygon, m.
const INSET: f64 = 0.01;
/// Largest displacement of a foothold along and across its heading, m.
pub(super) const REACH: (f64, f64) = (0.30, 0.60);
/// Least distance to the side from the stance foot, m, unless the plan itself comes closer or crosses.
const SEPARATION: f64 = 0.03;
/// A displacement to the side greater than the first brings the foot closer by this many times what it is greater, even
/// across, by up to the last, m: most pushes to the side cannot be caught otherwise.
const ACROSS: (f64, f64, f64) = (0.03, 4.0, 0.5);
/// Time constant of the foothold, s, and time before touch-down in which it does not change any more.
const SMOOTHING: f64 = 0.015;
pub(super) const FREEZE: f64 = 0.06;
/// Furthest that planned moments may move the zero-moment point, m.
const MOST_TURNED: f64 = 0.05;
/// Least downward acceleration the pendulum is computed with, m/s².
const LEAST_LOAD: f64 = 3.0;

/// The capture point `ξ = c + ċ/ω` against the motion's.
#[derive(Clone, Debug)]
pub struct Capture {
    /// e = ξ − ξ_ref on the ground, m.
    pub error: [f64; 2],
    /// Part of it that the zero-moment point can take care of, m.
    handled: [f64; 2],
    omega: f64,
    point: [f64; 2],
    /// How far the angular momentum beyond the motion's moves the capture point once it is given up, m.
    turning: [f64; 2],
    /// What pushes the body from outside accelerates it by this, m/s².
    pushed: [f64; 2],
    inner: Polygon,
    stance: Polygon,
    /// Without loads.
    links: Links,
    kin: Kinematics<f64>,
}

/// Share of the way to a new value in `dt` seconds.
pub(super) fn smoothing(dt: f64) -> f64 {
    1.0 - exp(-dt / SMOOTHING)
}

impl Capture {
    /// For figures with this body.
    pub fn new(body: &Body) -> Self {
        Self {
            error: [0.0; 2],
            handled: [0.0; 2],
            omega: 3.0,
            point: [0.0; 2],
            turning: [0.0; 2],
            pushed: [0.0; 2],
            inner: Polygon::with_capacity(64),
            stance: Polygon::with_capacity(64),
            links: Links::new(body),
            kin: Kinematics::default(),
        }
    }

    /// Ankles and rotations of both feet of a posture.
    pub(super) fn feet(&mut self, posture: &Posture) -> [(Vec3, Quat); 2] {
        self.kin.set_posture(&self.links, posture);
        [L_FOOT, R_FOOT].map(|s| {
            (
                posture.root_position + self.kin.position[s.index()],
                Quat::from_mat3(&self.kin.rotation[s.index()]),
            )
        })
    }

    /// The capture point of a motion as it is planned, which is without loads, m.
    pub(super) fn point_of(&mut self, target: &Target) -> [f64; 2] {
        let links = &self.links;
        self.kin.set_posture(links, &target.posture);
        self.kin.set_velocity(&target.velocity);
        let (c, mass) = center_of_mass(links, &self.kin);
        let c = target.posture.root_position + c;
        let v = momentum(links, &self.kin).linear * (1.0 / mass);
        [c.x + v.x / self.omega, c.y + v.y / self.omega]
    }

    /// Takes in what pushes the body, and how it turns while the motion has the angular momentum `spin`, N·m·s, if that
    /// is asked for. Blows seldom go through the centre of mass, and who gives up the momentum that he got pays with
    /// the capture point: about the foot it is kept. Who walks goes with the push; who stands gives way with his trunk
    /// until it is over.
    pub(super) fn feel(&mut self, terms: &Terms, spin: Option<Vec3>, walks: bool) {
        self.turning = [0.0; 2];
        if let Some(spin) = spin {
            let (rows, _) = terms.spin_rows();
            let of = |k: usize| -> f64 {
                let velocity = &terms.state.velocity;
                rows[k].iter().zip(velocity).map(|(a, v)| a * v).sum()
            };
            let per = 1.0 / (terms.mass * terms.com.z.max(0.1) * self.omega);
            self.turning = [(of(1) - spin.y) * per, (spin.x - of(0)) * per];
        }
        // Of `M v̇ + h`, which is what the floor gives, the rows of the force hold what others push with.
        let (bias, h) = (terms.com_bias, &terms.h);
        let pushed = [bias.x - h[3] / terms.mass, bias.y - h[4] / terms.mass];
        self.pushed = if walks { pushed } else { [0.0; 2] };
    }

    /// Sets the support within which [`Capture::within`] looks.
    pub(super) fn stand_on(&mut self, points: impl Iterator<Item = [f64; 2]>) {
        self.stance.set_hull(points);
        self.inner.set_inset(&self.stance, INSET);
    }

    /// The nearest point to `p` of the support that was set last.
    pub(super) fn within(&self, p: [f64; 2]) -> [f64; 2] {
        self.inner.closest(p).map_or(p, |c| c.point)
    }

    /// The zero-moment point about which the capture point would come to `goal` in `time` seconds, as
    /// [`Capture::lands`] has it.
    pub(super) fn zmp_for(&self, goal: [f64; 2], time: f64) -> [f64; 2] {
        let grows = exp(self.omega * time);
        std::array::from_fn(|k| (goal[k] - self.turning[k] - self.point[k] * grows) / (1.0 - grows))
    }

    /// Where the capture point comes to about `zmp` in `time` seconds, with the angular momentum given up.
    pub(super) fn lands(&self, zmp: [f64; 2], time: f64) -> [f64; 2] {
        let grows = exp(self.omega * time);
        std::array::from_fn(|k| zmp[k] + (self.point[k] - zmp[k]) * grows + self.turning[k])
    }

    /// Horizontal acceleration of the pendulum about the point of `polygon` nearest to `zmp`, m/s².
    pub(super) fn about(&mut self, terms: &Terms, polygon: &Polygon, zmp: [f64; 2]) -> [f64; 2] {
        self.inner.set_inset(polygon, INSET);
        self.falls(terms, self.within(zmp))
    }

    /// Horizontal acceleration of the pendulum about `zmp`, m/s².
    fn falls(&self, terms: &Terms, zmp: [f64; 2]) -> [f64; 2] {
        let w2 = self.omega * self.omega;
        let c = [terms.com.x, terms.com.y];
        std::array::from_fn(|k| w2 * (c[k] - zmp[k]) + self.pushed[k])
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
        let height = com.now.z.max(0.1);
        let w = (gravity.max(LEAST_LOAD) / height).sqrt();
        self.omega = w;
        let ff = (com.next_velocity - com.now_velocity) * (1.0 / dt);
        let w2 = (gravity + ff.z).max(LEAST_LOAD) / height;
        let (c, r) = (terms.com, com.now);
        let (dc, dr) = (terms.com_velocity, com.now_velocity);
        self.point = [c.x + dc.x / w, c.y + dc.y / w];
        self.error = [c.x - r.x + (dc.x - dr.x) / w, c.y - r.y + (dc.y - dr.y) / w];
        let planned = [r.x - ff.x / w2, r.y - ff.y / w2];
        let wanted = [
            planned[0] + (1.0 + GAIN) * self.error[0],
            planned[1] + (1.0 + GAIN) * self.error[1],
        ];
        self.inner.set_inset(polygon, INSET);
        let can = self.inner.closest(wanted).map_or(wanted, |c| c.point);
        // What it takes care of lies along the error, and is at most all of it.
        let e = self.error;
        let along = (can[0] - planned[0]) * e[0] + (can[1] - planned[1]) * e[1];
        let share = (along / (e[0] * e[0] + e[1] * e[1]).max(1e-12)).clamp(0.0, 1.0);
        self.handled = e.map(|x| share * x);
    }

    /// Length of the error, m.
    pub fn off(&self) -> f64 {
        let e = self.error;
        (e[0] * e[0] + e[1] * e[1]).sqrt()
    }

    /// The capture point ξ, m.
    pub fn point(&self) -> [f64; 2] {
        self.point
    }

    /// ω of the pendulum, 1/s.
    pub fn omega(&self) -> f64 {
        self.omega
    }

    /// The zero-moment point over the stance `points` that slows the capture point `xi` most.
    pub(super) fn hold(
        &mut self,
        points: impl Iterator<Item = [f64; 2]>,
        xi: [f64; 2],
    ) -> [f64; 2] {
        self.stand_on(points);
        self.within(xi)
    }

    /// How far the capture point is inside the hull of `points`, m.
    pub(super) fn margin(&mut self, points: impl Iterator<Item = [f64; 2]>) -> Option<f64> {
        self.stance.set_hull(points);
        self.stance.closest(self.point).map(|c| c.margin)
    }

    /// Horizontal acceleration with which the pendulum over the stance `points` falls slowest, m/s².
    pub(super) fn slowest(
        &mut self,
        terms: &Terms,
        points: impl Iterator<Item = [f64; 2]>,
    ) -> [f64; 2] {
        let p = self.hold(points, self.point);
        self.falls(terms, p)
    }

    /// The wanted acceleration `a` of the centre of mass with its zero-moment point brought back into the support: what
    /// lies beyond would only turn the trunk. A leg that is braked before it lands moves that point by centimetres:
    /// `moment` is the rate of the motion's angular momentum, N·m. `None` without a support.
    pub(super) fn feasible(
        &self,
        terms: &Terms,
        (a, moment): (Vec3, Vec3),
        polygon: &Polygon,
        gravity: f64,
    ) -> Option<[f64; 2]> {
        let c = terms.com;
        let load = (gravity + a.z).max(LEAST_LOAD);
        let w2 = load / c.z.max(0.1);
        let turned = [moment.y, -moment.x].map(|m| m / (terms.mass * load));
        let far = (turned[0] * turned[0] + turned[1] * turned[1]).sqrt();
        let far = far.max(MOST_TURNED);
        let turned = turned.map(|t| t * MOST_TURNED / far);
        let middle = [c.x - turned[0], c.y - turned[1]];
        let push = self.pushed;
        let wanted = [
            middle[0] - (a.x - push[0]) / w2,
            middle[1] - (a.y - push[1]) / w2,
        ];
        let p = polygon.closest(wanted)?.point;
        Some(std::array::from_fn(|k| w2 * (middle[k] - p[k]) + push[k]))
    }

    /// Error that is left after `remaining` seconds of swing: a foothold displaced by it makes the error zero.
    pub fn left_over(&self, remaining: f64) -> [f64; 2] {
        let grows = exp(self.omega * remaining.min(1.0));
        std::array::from_fn(|k| {
            let (e, d) = (self.error[k], self.handled[k]);
            (e - d) * grows + d
        })
    }
}

/// Limits a displacement `d` (m, world) of a foothold at `home` with heading `yaw` to what a leg can do beside the
/// stance foot; `shorter`: by how much the step may get shorter along its heading, m.
pub(super) fn within_reach(
    d: [f64; 2],
    home: Vec3,
    stance: Vec3,
    yaw: f64,
    side: usize,
    shorter: f64,
) -> [f64; 2] {
    let back = Quat::exp(Vec3::Z * -yaw);
    let level = |x: f64, y: f64| Vec3 { x, y, z: 0.0 };
    let mut local = back.rotate(level(d[0], d[1]));
    let pressed = (ACROSS.1 * (local.y.abs() - ACROSS.0)).clamp(0.0, SEPARATION + ACROSS.2);
    local.y = local.y.clamp(-REACH.1, REACH.1);
    let outward = if side == 0 { 1.0 } else { -1.0 };
    let planned = back.rotate(level(home.x - stance.x, home.y - stance.y));
    local.x = if planned.x < 0.0 {
        local.x.clamp(-REACH.0, shorter)
    } else {
        local.x.clamp(-shorter, REACH.0)
    };
    // A step that the plan itself crosses with may.
    let least = (SEPARATION - pressed).min(planned.y * outward);
    let away = (planned.y + local.y) * outward;
    if away < least {
        local.y = least * outward - planned.y;
    }
    let beside = BESIDE.min(planned.y * outward);
    let away = (planned.y + local.y) * outward;
    let (x, y) = foothold((planned.x + local.x, away), beside);
    local.x = x - planned.x;
    local.y = y * outward - planned.y;
    let world = Quat::exp(Vec3::Z * yaw).rotate(local);
    [world.x, world.y]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
        (a[0] - b[0]).hypot(a[1] - b[1])
    }

    #[test]
    fn about_the_point_chosen_for_it_the_capture_point_lands_where_it_should() {
        let capture = Capture {
            omega: 3.1,
            point: [0.3, 0.2],
            turning: [0.01, -0.04],
            ..Capture::new(&Body::adult_man())
        };
        for time in [0.1, 0.3, 0.6] {
            let goal = [0.6, 0.1];
            let zmp = capture.zmp_for(goal, time);
            let off = apart(capture.lands(zmp, time), goal);
            assert!(off < 1e-12, "{off:e} m after {time} s");
        }
    }

    #[test]
    fn steps_get_shorter_by_more_than_longer() {
        let home = Vec3::X * 0.6 + Vec3::Y * 0.2;
        let ahead = |d: f64, shorter: f64| {
            let at = |home| within_reach([d, 0.0], home, Vec3::zero(), 0.0, 0, shorter)[0];
            // Who walks backwards shortens his steps forwards.
            let back = Vec3 { x: -home.x, ..home };
            let mirrored = within_reach([-d, 0.0], back, Vec3::zero(), 0.0, 0, shorter)[0];
            assert!((at(home) + mirrored).abs() < 1e-15);
            at(home)
        };
        assert!((ahead(1.0, 0.5) - REACH.0).abs() < 1e-15);
        assert!((ahead(-1.0, 0.5) + 0.5).abs() < 1e-15);
        assert!((ahead(-1.0, REACH.0) + REACH.0).abs() < 1e-15);
    }

    #[test]
    fn a_step_that_the_plan_crosses_with_goes_where_it_catches_the_body() {
        // Who turns on his right foot sets the left one down 36 cm to its right.
        for ahead in [-0.2, -0.03, 0.03, 0.2] {
            let home = Vec3 {
                x: ahead,
                y: -0.36,
                z: 0.0,
            };
            for d in [[0.0, 0.0], [0.01, -0.01], [-0.01, -0.01], [0.0, 0.02]] {
                let at = within_reach(d, home, Vec3::zero(), 0.0, 0, REACH.0);
                let away = apart(at, d);
                assert!(
                    away <= d[0].hypot(d[1]) + 1e-12,
                    "{d:?} from {ahead}: {at:?}"
                );
            }
        }
        // One that does not lands beside the other foot, or passes it.
        let home = Vec3::Y * 0.15 + Vec3::X * 0.05;
        let at = within_reach([0.0, -0.2], home, Vec3::zero(), 0.0, 0, REACH.0);
        let (x, y) = (home.x + at[0], home.y + at[1]);
        assert!(y >= BESIDE - 1e-12 || x >= 0.16, "{at:?}");
    }
}
