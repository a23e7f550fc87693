//! Inverse dynamics: joint torques from accelerations (recursive Newton–Euler).

use super::kinematics::Kinematics;
use crate::body::Links;
use crate::body::topology::{DOF_LEN, DOF_START, NV, PARENT, SEGMENT_COUNT};
use crate::math::{Lane, Vec3};

/// A force and moment on a segment, world axes, moment about the segment origin (N·m, N).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct External<L = f64> {
    /// Moment about the segment origin, N·m.
    pub moment: Vec3<L>,
    /// Force, N.
    pub force: Vec3<L>,
}

/// Everything that acts on a body from outside: gravity, and forces on its segments.
#[derive(Clone, Copy, Debug)]
pub struct ExternalForces<'a, L = f64> {
    /// Magnitude of gravity, m/s², acting along −z.
    pub gravity: L,
    /// One per segment, or empty if nothing else acts.
    pub on_segments: &'a [External<L>],
}

impl<L> ExternalForces<'_, L> {
    /// Gravity alone, m/s².
    pub fn gravity(gravity: L) -> Self {
        Self {
            gravity,
            on_segments: &[],
        }
    }
}

/// Intermediate accelerations and forces of all segments.
#[derive(Clone, Debug)]
pub struct RneaWorkspace<L = f64> {
    /// Angular acceleration, world axes, rad/s².
    pub alpha: [Vec3<L>; SEGMENT_COUNT],
    /// Acceleration of the segment origin minus gravity, m/s².
    pub acceleration: [Vec3<L>; SEGMENT_COUNT],
    moment: [Vec3<L>; SEGMENT_COUNT],
    force: [Vec3<L>; SEGMENT_COUNT],
}

impl<L: Lane> Default for RneaWorkspace<L> {
    fn default() -> Self {
        let z = [Vec3::zero(); SEGMENT_COUNT];
        Self {
            alpha: z,
            acceleration: z,
            moment: z,
            force: z,
        }
    }
}

/// Generalised forces that realise the acceleration `vdot` (recursive Newton–Euler).
///
/// τ = M(q) v̇ + h(q, v) − Jᵀ F — Oshita & Makinouchi 2000, Eq. 6, on the floating base; Featherstone 2008, §5.3
///
/// * `kin`: state, see [`Kinematics::set_state`].
/// * `velocity`, `vdot`: layout of `State::velocity`.
/// * `external`: F, and gravity.
/// * `tau`: result: moment (N·m, about the pelvis origin) and force (N) that must act on the pelvis, world axes, then
///   joint torques.
///
/// O(n), no allocation.
///
/// Equation (6) of the paper.
#[inline(always)]
pub fn rnea<L: Lane>(
    links: &Links<L>,
    kin: &Kinematics<L>,
    velocity: &[L; NV],
    vdot: &[L; NV],
    external: ExternalForces<'_, L>,
    ws: &mut RneaWorkspace<L>,
    tau: &mut [L; NV],
) {
    ws.alpha[0] = Vec3 {
        x: vdot[0],
        y: vdot[1],
        z: vdot[2],
    };
    ws.acceleration[0] = Vec3 {
        x: vdot[3],
        y: vdot[4],
        z: vdot[5] + external.gravity,
    };
    for s in 1..SEGMENT_COUNT {
        let (p, d) = (PARENT[s], DOF_START[s]);
        let r = kin.position[s] - kin.position[p];
        let w = kin.omega[p];
        ws.acceleration[s] = ws.acceleration[p] + ws.alpha[p].cross(r) + w.cross(w.cross(r));
        let mut a = ws.alpha[p] + kin.joint_bias(s, velocity);
        for k in 0..DOF_LEN[s] {
            a += kin.axis[d + k] * vdot[6 + d + k];
        }
        ws.alpha[s] = a;
    }
    for s in 0..SEGMENT_COUNT {
        let (w, al, a) = (kin.omega[s], ws.alpha[s], ws.acceleration[s]);
        let (h, i) = (kin.moment[s], kin.inertia[s]);
        ws.force[s] = a * links.mass[s] + al.cross(h) + w.cross(w.cross(h));
        ws.moment[s] = i * al + w.cross(i * w) + h.cross(a);
    }
    for (s, e) in external.on_segments.iter().enumerate().take(SEGMENT_COUNT) {
        ws.force[s] -= e.force;
        ws.moment[s] -= e.moment;
    }
    for s in (1..SEGMENT_COUNT).rev() {
        let (p, d) = (PARENT[s], DOF_START[s]);
        let (n, f) = (ws.moment[s], ws.force[s]);
        for k in 0..DOF_LEN[s] {
            tau[6 + d + k] = kin.axis[d + k].dot(n) + links.armature[d + k] * vdot[6 + d + k];
        }
        ws.force[p] += f;
        ws.moment[p] += n + (kin.position[s] - kin.position[p]).cross(f);
    }
    let (n, f) = (ws.moment[0], ws.force[0]);
    (tau[0], tau[1], tau[2]) = (n.x, n.y, n.z);
    (tau[3], tau[4], tau[5]) = (f.x, f.y, f.z);
}
