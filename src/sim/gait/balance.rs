//! The capture point (divergent component of motion) and where to step so that the error it has is gone when the foot lands (WALKING §4).

use crate::sim::body::topology::{L_FOOT, R_FOOT};
use crate::sim::body::{Body, Links, Posture};
use crate::sim::control::PointTarget;
use crate::sim::dynamics::{Kinematics, Terms};
use crate::sim::math::exp::exp;
use crate::sim::math::{Quat, Vec3};
use crate::sim::support::Polygon;

/// Gain k of `p* = p_ref + (1 + k) e`.
const GAIN: f64 = 1.0;
/// The zero-moment point stays this far inside the polygon, m.
const INSET: f64 = 0.01;
/// Largest displacement of a foothold along and across its heading, m.
const REACH: (f64, f64) = (0.30, 0.60);
/// Least distance to the side from the stance foot, m, unless the plan itself comes closer or crosses.
const SEPARATION: f64 = 0.03;
/// A displacement to the side greater than the first brings the foot closer by this many times what it is greater, even across, by up to
/// the last, m: most pushes to the side cannot be caught otherwise. A foot that crosses passes before or behind the other, by `PASSING`, m.
const ACROSS: (f64, f64, f64) = (0.03, 4.0, 0.4);
const PASSING: f64 = 0.16;
/// Closer than this to the side of the stance foot counts as crossing, m.
const BESIDE: f64 = 0.08;
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
    inner: Polygon,
    stance: Polygon,
    links: Option<Links>,
    kin: Kinematics<f64>,
}

impl Default for Capture {
    fn default() -> Self {
        Self {
            error: [0.0; 2],
            handled: [0.0; 2],
            omega: 3.0,
            point: [0.0; 2],
            inner: Polygon::with_capacity(64),
            stance: Polygon::with_capacity(64),
            links: None,
            kin: Kinematics::default(),
        }
    }
}

/// Share of the way to a new value in `dt` seconds.
pub(super) fn smoothing(dt: f64) -> f64 {
    1.0 - exp(-dt / SMOOTHING)
}

impl Capture {
    /// For figures with this body.
    pub fn new(body: &Body) -> Self {
        Self {
            links: Some(Links::new(body)),
            ..Self::default()
        }
    }

    /// Ankles and rotations of both feet of a posture.
    pub(super) fn feet(&mut self, posture: &Posture) -> [(Vec3, Quat); 2] {
        let Some(links) = &self.links else {
            return [(Vec3::zero(), Quat::identity()); 2];
        };
        self.kin.set_posture(links, posture);
        [L_FOOT, R_FOOT].map(|s| {
            (
                posture.root_position + self.kin.position[s.index()],
                Quat::from_mat3(&self.kin.rotation[s.index()]),
            )
        })
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
        self.stance.set_hull(points);
        self.inner.set_inset(&self.stance, INSET);
        self.inner.closest(xi).map_or(xi, |c| c.point)
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
        let w2 = self.omega * self.omega;
        [w2 * (terms.com.x - p[0]), w2 * (terms.com.y - p[1])]
    }

    /// The wanted acceleration `a` of the centre of mass with its zero-moment point brought back into the support: what lies beyond would only
    /// turn the trunk. A leg that is braked before it lands moves that point by centimetres: `moment` is the rate of the motion's angular
    /// momentum, N·m. `None` without a support.
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
        let wanted = [middle[0] - a.x / w2, middle[1] - a.y / w2];
        let p = polygon.closest(wanted)?.point;
        Some([w2 * (middle[0] - p[0]), w2 * (middle[1] - p[1])])
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

/// Limits a displacement `d` (m, world) of a foothold at `home` with heading `yaw` to what a leg can do beside the stance foot.
pub(super) fn within_reach(
    d: [f64; 2],
    home: Vec3,
    stance: Vec3,
    yaw: f64,
    side: usize,
) -> [f64; 2] {
    let back = Quat::exp(Vec3::Z * -yaw);
    let level = |x: f64, y: f64| Vec3 { x, y, z: 0.0 };
    let mut local = back.rotate(level(d[0], d[1]));
    let pressed = (ACROSS.1 * (local.y.abs() - ACROSS.0)).clamp(0.0, SEPARATION + ACROSS.2);
    local.x = local.x.clamp(-REACH.0, REACH.0);
    local.y = local.y.clamp(-REACH.1, REACH.1);
    let outward = if side == 0 { 1.0 } else { -1.0 };
    let planned = back.rotate(level(home.x - stance.x, home.y - stance.y));
    // A step that the plan itself crosses with may.
    let least = (SEPARATION - pressed).min(planned.y * outward);
    let away = (planned.y + local.y) * outward;
    if away < least {
        local.y = least * outward - planned.y;
    }
    let ahead = planned.x + local.x;
    if away < BESIDE.min(planned.y * outward) && ahead.abs() < PASSING {
        local.x = PASSING.copysign(ahead) - planned.x;
    }
    let world = Quat::exp(Vec3::Z * yaw).rotate(local);
    [world.x, world.y]
}
