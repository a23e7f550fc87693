//! The equations of motion rebuilt from outside.
//!
//! A tick report carries its last substep: state, acceleration, torques and forces. Here they are put into Newton's and
//! Euler's laws of every segment, in world axes about the centres of mass, with joint axes taken from the topology
//! table: no kernel of `sim::dynamics` and no intermediate result of the solver takes part. The remainder is
//! unexplained force; a real figure has none.

use super::pose::{SegmentPose, segment_poses};
use sinew_physics::body::state::ball_rate_vector;
use sinew_physics::body::topology::{DOF_AXIS, DOF_LEN, DOF_START, JOINT, Joint, PARENT};
use sinew_physics::body::{DOF_COUNT, Links, NV, SEGMENT_COUNT, State};
use sinew_physics::figure::Audit;
use sinew_physics::math::{Sym3, Vec3};

/// The result of an audit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AuditResult {
    /// `M v̇ + h − Sᵀτ − Σ Jᵀf`, layout of `State::velocity` (N·m, N, N·m).
    pub residual: [f64; NV],
    /// Length of the residual relative to the lengths of its parts: `|r| / (|M v̇ + h| + |Sᵀτ| + |ΣJᵀf|)`; NaN if any
    /// part is.
    pub relative: f64,
    /// Force on the pelvis that neither contacts nor perturbations nor assist explain, N.
    pub root_force: f64,
    /// Moment on the pelvis (about its origin) that neither contacts nor perturbations nor assist explain, N·m.
    pub root_moment: f64,
}

/// Checks the substep in `sample` against Newton–Euler for the masses in `links`; `gravity` in m/s², positive
/// downwards.
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
    let mut external = project(&wrench, &poses, pivot);
    for (e, a) in external.iter_mut().zip(&sample.assist) {
        *e += a;
    }
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

/// Generalised force `M v̇ + h` that the motion requires (armature included): Newton's and Euler's law of every
/// segment, projected on the joint axes.
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
        let SegmentMotion {
            omega,
            alpha,
            acceleration,
        } = motion[s];
        let a_com = acceleration + alpha.cross(r) + omega.cross(omega.cross(r));
        // Links hold the inertia about the joint; Steiner's theorem takes it to the centre of mass, where Euler's law
        // has no coupling terms.
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
struct SegmentMotion {
    omega: Vec3,
    alpha: Vec3,
    acceleration: Vec3,
}

fn segment_motions(
    links: &Links,
    state: &State,
    acceleration: &[f64; NV],
    poses: &[SegmentPose; SEGMENT_COUNT],
) -> [SegmentMotion; SEGMENT_COUNT] {
    let (v, a) = (&state.velocity, acceleration);
    let mut out = [SegmentMotion::default(); SEGMENT_COUNT];
    out[0] = SegmentMotion {
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
        let SegmentMotion {
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
        out[s] = SegmentMotion {
            omega,
            alpha,
            acceleration,
        };
    }
    out
}

/// Generalised force of wrenches on the segments (moments about `pivot`, the pelvis origin): sums over subtrees, seen
/// along each joint axis.
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

/// World axis of DOF `k` of segment `s`'s joint. Ball rates are components along child axes; the first hinge is fixed
/// in the parent, and the second in the child, since turning about an axis leaves it where it is.
fn joint_axis(s: usize, k: usize, poses: &[SegmentPose; SEGMENT_COUNT]) -> Vec3 {
    let axis = Vec3::from_array(DOF_AXIS[DOF_START[s] + k].vector());
    let frame = match JOINT[s] {
        Joint::Free | Joint::Ball(_) => s,
        Joint::Hinge2(_) | Joint::Hinge1(_) if k == 0 => PARENT[s],
        Joint::Hinge2(_) | Joint::Hinge1(_) => s,
    };
    poses[frame].rotation.rotate(axis)
}

#[cfg(test)]
#[allow(dead_code, reason = "shared with tests/physics")]
#[path = "../../tests/physics/oracle/bodies.rs"]
mod bodies;

#[cfg(test)]
mod tests {
    //! The rebuilt equations agree with the kernels of `sim::dynamics`, which they do not use, and wrong physics is far
    //! off.

    use super::bodies::{random_body, random_state};
    use super::*;
    use rand::{Rng, SeedableRng};
    use rand_pcg::Pcg64Mcg;
    use sinew_physics::body::SegmentId;
    use sinew_physics::dynamics::{External, ExternalForces, Kinematics, RneaWorkspace, rnea};
    use sinew_physics::figure::ContactPoint;

    fn random_vector<const N: usize>(rng: &mut Pcg64Mcg, most: f64) -> [f64; N] {
        std::array::from_fn(|_| rng.random_range(-most..most))
    }

    /// A sample that `rnea` calls consistent: a contact couple supplies its root wrench, and the torques supply its
    /// joints.
    fn consistent_sample(rng: &mut Pcg64Mcg, links: &Links) -> Audit {
        let state = random_state(rng, 1.0);
        let acceleration: [f64; NV] = random_vector(rng, 20.0);
        let mut kin = Kinematics::default();
        kin.set_state(links, &state);
        let origin = state.posture.root_position;
        let none = External {
            moment: Vec3::zero(),
            force: Vec3::zero(),
        };
        let mut external = [none; SEGMENT_COUNT];
        let mut contacts = Vec::new();
        let mut applied = Vec::new();
        let mut touch = |s: usize, point: Vec3, force: Vec3, contact: bool| {
            external[s].force += force;
            external[s].moment += (point - origin - kin.position[s]).cross(force);
            let segment = SegmentId::new(s).expect("a segment");
            if contact {
                contacts.push(ContactPoint {
                    segment,
                    vertex: 0,
                    position: point,
                    force,
                });
            } else {
                applied.push((segment, point, force));
            }
        };
        for s in [2, 6, 12, 17] {
            let point = Vec3::from_array(random_vector(rng, 1.0));
            touch(
                s,
                point,
                Vec3::from_array(random_vector(rng, 300.0)),
                s > 10,
            );
        }
        let mut tau = [0.0; NV];
        let mut solve = |external: &[External]| {
            rnea(
                links,
                &kin,
                &state.velocity,
                &acceleration,
                ExternalForces {
                    gravity: 9.81,
                    on_segments: external,
                },
                &mut RneaWorkspace::default(),
                &mut tau,
            );
            tau
        };
        let missing = solve(&external);
        // A force at the pelvis origin, and the moment as three couples of forces one metre apart.
        let moment = Vec3::from_array([missing[0], missing[1], missing[2]]);
        let force = Vec3::from_array([missing[3], missing[4], missing[5]]);
        let mut add = |point: Vec3, force: Vec3| {
            external[0].force += force;
            external[0].moment += (point - origin).cross(force);
            contacts.push(ContactPoint {
                segment: sinew_physics::body::topology::PELVIS,
                vertex: 0,
                position: point,
                force,
            });
        };
        add(origin, force);
        for (arm, push) in [
            (Vec3::Y, Vec3::Z * moment.x),
            (Vec3::Z, Vec3::X * moment.y),
            (Vec3::X, Vec3::Y * moment.z),
        ] {
            add(origin + arm, push);
            add(origin, -push);
        }
        let tau = solve(&external);
        let ligament: [f64; DOF_COUNT] = random_vector(rng, 5.0);
        Audit {
            state,
            acceleration,
            torque: std::array::from_fn(|d| tau[6 + d] - ligament[d]),
            ligament_torque: ligament,
            contacts,
            applied,
            assist: [0.0; 6],
        }
    }

    #[test]
    fn inertial_forces_agree_with_recursive_newton_euler() {
        let mut rng = Pcg64Mcg::seed_from_u64(11);
        for _ in 0..200 {
            let (links, state) = (
                Links::new(&random_body(&mut rng, 0.05)),
                random_state(&mut rng, 1.0),
            );
            let a: [f64; NV] = random_vector(&mut rng, 20.0);
            let (mut kin, mut tau) = (Kinematics::default(), [0.0; NV]);
            kin.set_state(&links, &state);
            rnea(
                &links,
                &kin,
                &state.velocity,
                &a,
                ExternalForces::gravity(9.81),
                &mut RneaWorkspace::default(),
                &mut tau,
            );
            let ours = inertial_forces(&links, &state, &a, 9.81);
            let scale = tau.iter().fold(1.0f64, |m, x| m.max(x.abs()));
            for i in 0..NV {
                assert!(
                    (ours[i] - tau[i]).abs() < 1e-12 * scale,
                    "row {i}: {} against {}",
                    ours[i],
                    tau[i]
                );
            }
        }
    }

    #[test]
    fn consistent_sample_leaves_no_residual_and_wrong_ones_leave_much() {
        let mut rng = Pcg64Mcg::seed_from_u64(12);
        for _ in 0..50 {
            let links = Links::new(&random_body(&mut rng, 0.05));
            let sample = consistent_sample(&mut rng, &links);
            let found = audit(&links, &sample, 9.81);
            assert!(found.relative < 1e-12, "{found:?}");
            assert!(
                found.root_force < 1e-9 && found.root_moment < 1e-9,
                "{found:?}"
            );

            let weight = links.total_mass() * 9.81;
            let weightless = audit(&links, &sample, 0.0);
            assert!(
                (weightless.root_force - weight).abs() < 1e-6 * weight,
                "gravity is on the books"
            );
            let mut slow = sample.clone();
            slow.state.velocity = [0.0; NV];
            assert!(
                audit(&links, &slow, 9.81).relative > 1e-4,
                "Coriolis forces are on the books"
            );
            let mut pulled = sample.clone();
            pulled.contacts[0].force += Vec3::X * 10.0;
            assert!((audit(&links, &pulled, 9.81).root_force - 10.0).abs() < 1e-6);
            let mut loaded = links.clone();
            loaded.add_load(SegmentId::new(9).expect("a hand"), Vec3::zero(), 5.0);
            assert!(
                audit(&loaded, &sample, 9.81).relative > 1e-3,
                "a load is on the books"
            );
        }
    }

    #[test]
    fn weightless_rest_is_exact() {
        let mut rng = Pcg64Mcg::seed_from_u64(13);
        let links = Links::new(&random_body(&mut rng, 0.05));
        let sample = Audit {
            state: State::default(),
            acceleration: [0.0; NV],
            torque: [0.0; DOF_COUNT],
            ligament_torque: [0.0; DOF_COUNT],
            contacts: Vec::new(),
            applied: Vec::new(),
            assist: [0.0; 6],
        };
        assert_eq!(audit(&links, &sample, 0.0).relative, 0.0);
    }
}
