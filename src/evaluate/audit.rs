//! The equations of motion rebuilt from outside.
//!
//! A tick report carries its last substep: state, acceleration, torques and forces. Here they are put into Newton's and Euler's laws of
//! every segment, in world axes about the centres of mass, with joint axes taken from the topology table: no kernel of `sim::dynamics`
//! and no intermediate result of the solver takes part. What remains is force that nothing explains; a real figure has none.

use super::pose::{SegmentPose, segment_poses};
use crate::sim::body::state::ball_rate_vector;
use crate::sim::body::topology::{DOF_AXIS, DOF_LEN, DOF_START, JOINT, Joint, PARENT};
use crate::sim::body::{DOF_COUNT, Links, NV, SEGMENT_COUNT, State};
use crate::sim::figure::Audit;
use crate::sim::math::{Sym3, Vec3};

/// What an audit found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AuditResult {
    /// `M v̇ + h − Sᵀτ − Σ Jᵀf`, layout of `State::velocity` (N·m, N, N·m).
    pub residual: [f64; NV],
    /// Length of the residual relative to the lengths of what it is made of: `|r| / (|M v̇ + h| + |Sᵀτ| + |ΣJᵀf|)`; NaN if any part is.
    pub relative: f64,
    /// Force on the pelvis that neither contacts nor perturbations explain, N.
    pub root_force: f64,
    /// Moment on the pelvis (about its origin) that neither contacts nor perturbations explain, N·m.
    pub root_moment: f64,
}

/// Checks the substep in `sample` against Newton–Euler for the masses in `links`; `gravity` in m/s², positive downwards.
///
/// About 10 µs; no allocation.
pub fn audit(links: &Links, sample: &Audit, gravity: f64) -> AuditResult {
    let inertial = inertial_forces(links, &sample.state, &sample.acceleration, gravity);
    let poses = segment_poses(&links.offset, &sample.state.posture);
    let mut wrench = [Wrench::default(); SEGMENT_COUNT];
    let pivot = sample.state.posture.root_position;
    for c in &sample.contacts {
        wrench[c.segment.index()].add(c.position, c.force, pivot);
    }
    for (segment, point, force) in &sample.applied {
        wrench[segment.index()].add(*point, *force, pivot);
    }
    let external = project(&wrench, &poses, pivot);
    let mut actuation = [0.0; NV];
    for d in 0..DOF_COUNT {
        actuation[6 + d] = sample.torque[d] + sample.ligament_torque[d];
    }
    let residual: [f64; NV] = std::array::from_fn(|i| inertial[i] - actuation[i] - external[i]);
    let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let scale = length(&inertial) + length(&actuation) + length(&external);
    let r = length(&residual);
    AuditResult {
        residual,
        // All parts zero (weightless and at rest) is exact, not 0/0.
        relative: if r == 0.0 { 0.0 } else { r / scale },
        root_force: length(&residual[3..6]),
        root_moment: length(&residual[0..3]),
    }
}

/// Generalised force `M v̇ + h` that the motion needs (armature included): Newton's and Euler's law of every segment, projected on the joint axes.
///
/// * `acceleration`: time derivative of `state.velocity`, same layout.
/// * `gravity`: m/s², positive downwards.
///
/// Returns N·m (0..3, about the pelvis origin), N (3..6), N·m (joints).
pub fn inertial_forces(
    links: &Links,
    state: &State,
    acceleration: &[f64; NV],
    gravity: f64,
) -> [f64; NV] {
    let poses = segment_poses(&links.offset, &state.posture);
    let motion = segment_motions(links, state, acceleration, &poses);
    let pivot = state.posture.root_position;
    let up = Vec3::Z * gravity;
    let mut wrench = [Wrench::default(); SEGMENT_COUNT];
    for s in 0..SEGMENT_COUNT {
        let m = links.mass[s];
        let com_local = links.moment[s] * (1.0 / m);
        let r = poses[s].rotation.rotate(com_local);
        let Motion {
            omega,
            alpha,
            acceleration,
        } = motion[s];
        let a_com = acceleration + alpha.cross(r) + omega.cross(omega.cross(r));
        // Links hold the inertia about the joint; Steiner takes it to the centre of mass, where Euler's law has no coupling terms.
        let about_com = links.inertia[s] - Sym3::point_mass(m, com_local);
        let i_world = about_com.rotated(poses[s].rotation.to_mat3());
        wrench[s].add(poses[s].position + r, (a_com + up) * m, pivot);
        wrench[s].moment += i_world * alpha + omega.cross(i_world * omega);
    }
    let mut out = project(&wrench, &poses, pivot);
    for d in 0..DOF_COUNT {
        out[6 + d] += links.armature[d] * acceleration[6 + d];
    }
    out
}

/// Force and moment about a fixed pivot, world axes.
#[derive(Clone, Copy, Default)]
struct Wrench {
    force: Vec3,
    moment: Vec3,
}

impl Wrench {
    /// Adds a force at a world point.
    fn add(&mut self, point: Vec3, force: Vec3, pivot: Vec3) {
        self.force += force;
        self.moment += (point - pivot).cross(force);
    }
}

/// Angular velocity and acceleration of a segment and acceleration of its origin, world axes.
#[derive(Clone, Copy, Default)]
struct Motion {
    omega: Vec3,
    alpha: Vec3,
    acceleration: Vec3,
}

fn segment_motions(
    links: &Links,
    state: &State,
    acceleration: &[f64; NV],
    poses: &[SegmentPose; SEGMENT_COUNT],
) -> [Motion; SEGMENT_COUNT] {
    let (v, a) = (&state.velocity, acceleration);
    let mut out = [Motion::default(); SEGMENT_COUNT];
    out[0] = Motion {
        omega: Vec3 {
            x: v[0],
            y: v[1],
            z: v[2],
        },
        alpha: Vec3 {
            x: a[0],
            y: a[1],
            z: a[2],
        },
        acceleration: Vec3 {
            x: a[3],
            y: a[4],
            z: a[5],
        },
    };
    for s in 1..SEGMENT_COUNT {
        let p = PARENT[s];
        let (d, n) = (6 + DOF_START[s], DOF_LEN[s]);
        let r = poses[p].rotation.rotate(links.offset[s]);
        let Motion {
            mut omega,
            mut alpha,
            ..
        } = out[p];
        let acceleration = out[p].acceleration + alpha.cross(r) + omega.cross(omega.cross(r));
        match JOINT[s] {
            Joint::Free => {}
            Joint::Ball(_) => {
                let rate = poses[s]
                    .rotation
                    .rotate(ball_rate_vector(DOF_START[s], &v[d..d + n]));
                let rate_change = poses[s]
                    .rotation
                    .rotate(ball_rate_vector(DOF_START[s], &a[d..d + n]));
                alpha += rate_change + omega.cross(rate);
                omega += rate;
            }
            Joint::Hinge2(_) | Joint::Hinge1(_) => {
                for k in 0..n {
                    let axis = joint_axis(s, k, poses);
                    let rate = axis * v[d + k];
                    alpha += axis * a[d + k] + omega.cross(rate);
                    omega += rate;
                }
            }
        }
        out[s] = Motion {
            omega,
            alpha,
            acceleration,
        };
    }
    out
}

/// Generalised force of wrenches on the segments (moments about `pivot`, the pelvis origin): sums over subtrees, seen along each joint axis.
fn project(
    own: &[Wrench; SEGMENT_COUNT],
    poses: &[SegmentPose; SEGMENT_COUNT],
    pivot: Vec3,
) -> [f64; NV] {
    let mut sum = *own;
    for s in (1..SEGMENT_COUNT).rev() {
        let Wrench { force, moment } = sum[s];
        sum[PARENT[s]].force += force;
        sum[PARENT[s]].moment += moment;
    }
    let mut out = [0.0; NV];
    out[..3].copy_from_slice(&sum[0].moment.to_array());
    out[3..6].copy_from_slice(&sum[0].force.to_array());
    for s in 1..SEGMENT_COUNT {
        let d = 6 + DOF_START[s];
        let about_joint = sum[s].moment - (poses[s].position - pivot).cross(sum[s].force);
        for k in 0..DOF_LEN[s] {
            out[d + k] = joint_axis(s, k, poses).dot(about_joint);
        }
    }
    out
}

/// World axis of DOF `k` of segment `s`'s joint. Ball rates are components along child axes; the first hinge is fixed in the parent, and
/// the second in the child, since turning about an axis leaves it where it is.
fn joint_axis(s: usize, k: usize, poses: &[SegmentPose; SEGMENT_COUNT]) -> Vec3 {
    let axis = Vec3::from_array(DOF_AXIS[DOF_START[s] + k].vector());
    let frame = match JOINT[s] {
        Joint::Free | Joint::Ball(_) => s,
        Joint::Hinge2(_) | Joint::Hinge1(_) if k == 0 => PARENT[s],
        Joint::Hinge2(_) | Joint::Hinge1(_) => s,
    };
    poses[frame].rotation.rotate(axis)
}
