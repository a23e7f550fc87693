//! Recorded numbers of a body made of hinge chains (`data/reference.json`: six states, from Pinocchio by a prototype of
//! this project).
//!
//! The same figure with ball joints moves the same way in other coordinates: `v = A(q) u` with hinge rates `u`, so that
//! `M_u = Aᵀ M A`, `h_u = Aᵀ (M Ȧu + h)`, `τ_u = Aᵀ τ`. A and Ȧu themselves are tested against finite differences.

use super::bodies::{components, generator};
use super::{GRAVITY, relative, terms};
use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Unit, Vector3};
use serde_json::Value;
use sinew_physics::body::topology::{
    DOF_AXIS, DOF_LEN, DOF_START, JOINT, Joint, L_FOOT, PARENT, R_HAND,
};
use sinew_physics::body::{DOF_COUNT, Links, NV, Posture, SEGMENT_COUNT, SegmentId, State};
use sinew_physics::dynamics::{Terms, kinetic_energy};
use sinew_physics::math::{Mat3, Quat, Sym3, Vec3};

/// The numbers were printed with 17 digits by another program: rounding of a few hundred operations on both sides.
const AGREES: f64 = 1e-10;

fn data() -> Value {
    serde_json::from_str(include_str!("../../oracle/data/reference.json")).unwrap()
}

fn numbers(v: &Value) -> Vec<f64> {
    v.as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect()
}

fn vec3(v: &Value) -> Vec3 {
    let n = numbers(v);
    Vec3 {
        x: n[0],
        y: n[1],
        z: n[2],
    }
}

/// The recorded body as links; checks that it has Sinew's tree and axes.
fn links(data: &Value) -> Links {
    let mut l = Links {
        offset: [Vec3::zero(); SEGMENT_COUNT],
        mass: [0.0; SEGMENT_COUNT],
        moment: [Vec3::zero(); SEGMENT_COUNT],
        inertia: [Sym3::zero(); SEGMENT_COUNT],
        armature: [0.0; DOF_COUNT],
    };
    for s in 0..SEGMENT_COUNT {
        let x = &data["segments"][SegmentId::new(s).unwrap().name()];
        let mass = x["mass"].as_f64().unwrap();
        let (com, d) = (vec3(&x["com"]), vec3(&x["inertia_diagonal"]));
        l.mass[s] = mass;
        l.moment[s] = com * mass;
        l.inertia[s] = Sym3::diagonal(d.x, d.y, d.z) + Sym3::point_mass(mass, com);
    }
    let joints = data["joints"].as_array().unwrap();
    assert_eq!(joints.len(), SEGMENT_COUNT - 1);
    for (k, j) in joints.iter().enumerate() {
        let s = k + 1;
        assert_eq!(j["child"], SegmentId::new(s).unwrap().name());
        assert_eq!(j["parent"], SegmentId::new(PARENT[s]).unwrap().name());
        l.offset[s] = vec3(&j["offset"]);
        let axes = j["axes"].as_array().unwrap();
        assert_eq!(axes.len(), DOF_LEN[s]);
        for (k, a) in axes.iter().enumerate() {
            assert_eq!(vec3(a).to_array(), DOF_AXIS[DOF_START[s] + k].vector());
        }
    }
    l
}

/// Positions and velocities of hinge chains: pelvis pose, 39 angles; twist (linear, angular, pelvis axes), 39 rates.
#[derive(Clone)]
struct Chain {
    position: Vec3,
    rotation: Quat,
    angle: Vec<f64>,
    velocity: Vec<f64>,
}

fn chain(case: &Value) -> Chain {
    let (q, v) = (numbers(&case["q"]), numbers(&case["v"]));
    Chain {
        position: Vec3::from_array([q[0], q[1], q[2]]),
        rotation: Quat::from_xyzw([q[3], q[4], q[5], q[6]]),
        angle: q[7..].to_vec(),
        velocity: v,
    }
}

fn axis(d: usize) -> Vector3<f64> {
    Vector3::from(DOF_AXIS[d].vector())
}

fn turn(d: usize, angle: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Unit::new_unchecked(axis(d)), angle)
}

/// `E` with `ω = E θ̇` (child axes) of three hinges from DOF `d` on, and `Ė θ̇`.
fn ball_map(d: usize, angle: &[f64], rate: &[f64]) -> (Matrix3<f64>, Vector3<f64>) {
    let (r2, r3) = (turn(d + 1, angle[1]), turn(d + 2, angle[2]));
    let e = Matrix3::from_columns(&[
        r3.inverse() * (r2.inverse() * axis(d)),
        r3.inverse() * axis(d + 1),
        axis(d + 2),
    ]);
    // Each axis, seen from the child, turns opposite to the hinges after it.
    let w3 = e.column(2) * rate[2];
    let w2 = e.column(1) * rate[1] + w3;
    let bias = -w2.cross(&e.column(0)) * rate[0] - w3.cross(&e.column(1)) * rate[1];
    (e, bias)
}

/// The same posture and velocity in Sinew's coordinates, the map A (45×45) and the bias Ȧu.
fn ours(c: &Chain) -> (State, DMatrix<f64>, DVector<f64>) {
    let mut posture = Posture {
        root_position: c.position,
        root_rotation: c.rotation,
        ..Posture::default()
    };
    let mut a = DMatrix::zeros(NV, NV);
    let mut bias = DVector::zeros(NV);
    let m: Mat3 = c.rotation.to_mat3();
    let r = Matrix3::from_columns(&[m.x, m.y, m.z].map(|v| Vector3::from(v.to_array())));
    a.view_mut((0, 3), (3, 3)).copy_from(&r);
    a.view_mut((3, 0), (3, 3)).copy_from(&r);
    let (v, w) = (
        Vector3::from_column_slice(&c.velocity[0..3]),
        Vector3::from_column_slice(&c.velocity[3..6]),
    );
    bias.rows_mut(3, 3).copy_from(&(r * w.cross(&v)));
    for s in 1..SEGMENT_COUNT {
        let d = DOF_START[s];
        match JOINT[s] {
            Joint::Free => {}
            Joint::Ball(b) => {
                let (angle, rate) = (&c.angle[d..d + 3], &c.velocity[6 + d..9 + d]);
                let q = (0..3).fold(Quat::identity(), |q, k| {
                    q * Quat::from_axis_angle(Vec3::from_array(DOF_AXIS[d + k].vector()), angle[k])
                });
                posture.ball[b] = q;
                let (e, e_dot) = ball_map(d, angle, rate);
                let signed = Matrix3::from_columns(&[axis(d), axis(d + 1), axis(d + 2)]);
                a.view_mut((6 + d, 6 + d), (3, 3))
                    .copy_from(&(signed.transpose() * e));
                bias.rows_mut(6 + d, 3)
                    .copy_from(&(signed.transpose() * e_dot));
            }
            Joint::Hinge2(h) | Joint::Hinge1(h) => {
                for k in 0..DOF_LEN[s] {
                    posture.hinge[h + k] = c.angle[d + k];
                    a[(6 + d + k, 6 + d + k)] = 1.0;
                }
            }
        }
    }
    let velocity = &a * DVector::from_column_slice(&c.velocity);
    let state = State {
        posture,
        velocity: std::array::from_fn(|i| velocity[i]),
    };
    (state, a, bias)
}

fn dense(t: &Terms) -> DMatrix<f64> {
    DMatrix::from_fn(NV, NV, |i, j| t.m[i][j])
}

#[test]
fn the_maps_between_hinge_chains_and_ball_joints_match_differences() {
    let data = data();
    for (n, case) in data["cases"].as_array().unwrap().iter().enumerate() {
        let mut c = chain(case);
        if n == 0 {
            // The first state rests; let it move.
            c.velocity = components(&mut generator(9), 1.0).to_vec();
        }
        let at = |dt: f64| {
            let mut x = c.clone();
            x.position += c.rotation.rotate(Vec3::from_array([
                c.velocity[0],
                c.velocity[1],
                c.velocity[2],
            ])) * dt;
            let w = Vec3::from_array([c.velocity[3], c.velocity[4], c.velocity[5]]);
            x.rotation = (c.rotation * Quat::exp(w * dt)).normalized();
            (0..DOF_COUNT).for_each(|d| x.angle[d] += c.velocity[6 + d] * dt);
            ours(&x).0
        };
        let (state, _, bias) = ours(&c);
        let h = 1e-5;
        let (plus, minus) = (at(h), at(-h));
        let moved = minus.posture.difference(&plus.posture);
        for i in 0..NV {
            assert!(
                (moved[i] / (2.0 * h) - state.velocity[i]).abs() < 1e-8,
                "rate {i}"
            );
            let rate = (plus.velocity[i] - minus.velocity[i]) / (2.0 * h);
            assert!(
                (rate - bias[i]).abs() < 1e-8,
                "bias {i}: {rate} against {}",
                bias[i]
            );
        }
    }
}

#[test]
fn recorded_dynamics_are_reproduced() {
    let data = data();
    let l = links(&data);
    assert_eq!(data["gravity"], GRAVITY);
    for case in data["cases"].as_array().unwrap() {
        let c = chain(case);
        let (state, a, bias) = ours(&c);
        let t = terms(&l, &state);
        let m = dense(&t);
        let check = |what: &str, ours: &[f64], recorded: &Value| {
            let recorded = numbers(recorded);
            let off = relative(ours, &recorded);
            assert!(off < AGREES, "{what}: {off:e}");
        };
        let mu = a.transpose() * &m * &a;
        let row: Vec<f64> = mu.row(10).iter().copied().collect();
        check("M diagonal", mu.diagonal().as_slice(), &case["M_diag"]);
        check("M row 10", &row, &case["M_row10"]);
        let h = a.transpose() * (&m * &bias + DVector::from_column_slice(&t.h));
        check("h", h.as_slice(), &case["h"]);
        check("com", &t.com.to_array(), &case["com"]);
        let velocity = t.com_velocity.to_array();
        let recorded = numbers(&case["Jcom_v"]);
        assert!((0..3).all(|k| (velocity[k] - recorded[k]).abs() < AGREES));
        // Bias in the recorded coordinates: acceleration at u̇ = 0, that is v̇ = Ȧu.
        let com_bias: Vec<f64> = (0..3)
            .map(|k| t.com_bias.to_array()[k] + (0..NV).map(|i| t.jc[k][i] * bias[i]).sum::<f64>())
            .collect();
        let recorded = numbers(&case["com_bias"]);
        assert!((0..3).all(|k| (com_bias[k] - recorded[k]).abs() < AGREES));
        let energy = |name: &str| case[name].as_f64().unwrap();
        let kinetic = kinetic_energy(&l, &t.kin);
        assert!((kinetic - energy("kinetic")).abs() < AGREES * kinetic.max(1.0));
        let potential = t.mass * GRAVITY * t.com.z;
        assert!((potential - energy("potential")).abs() < AGREES * potential);
        let grip = Vec3 {
            x: 0.0,
            y: 0.0,
            z: -0.085,
        };
        let hand = R_HAND.index();
        check(
            "hand",
            &t.point_world(hand, grip).to_array(),
            &case["r_hand_pos"],
        );
        let mut j = [[0.0; 48]; 3];
        t.point_jacobian(hand, grip, &mut j);
        let acc: Vec<f64> = (0..3)
            .map(|k| {
                t.point_bias(hand, grip).to_array()[k]
                    + (0..NV).map(|i| j[k][i] * bias[i]).sum::<f64>()
            })
            .collect();
        let recorded = numbers(&case["r_hand_bias"]);
        assert!((0..3).all(|k| (acc[k] - recorded[k]).abs() < AGREES * 10.0));
    }
}

/// `v̇ = N θ̈ + b` with the left foot held still, from dense algebra on our Jacobian.
fn held_by_left_foot(t: &Terms) -> (DMatrix<f64>, DVector<f64>) {
    let mut j = [[0.0; 48]; 6];
    t.segment_jacobian(L_FOOT.index(), &mut j);
    let base = DMatrix::from_fn(6, 6, |i, k| j[i][k]).lu();
    let joints = DMatrix::from_fn(6, DOF_COUNT, |i, k| j[i][6 + k]);
    let (alpha, acc) = t.segment_bias(L_FOOT.index());
    let gamma: Vec<f64> = [alpha.to_array(), acc.to_array()].concat();
    let mut n = DMatrix::zeros(NV, DOF_COUNT);
    n.view_mut((0, 0), (6, DOF_COUNT))
        .copy_from(&-base.solve(&joints).unwrap());
    n.view_mut((6, 0), (DOF_COUNT, DOF_COUNT))
        .fill_with_identity();
    let mut b = DVector::zeros(NV);
    b.rows_mut(0, 6)
        .copy_from(&-base.solve(&DVector::from_vec(gamma)).unwrap());
    (n, b)
}

/// Equation (6) of the paper.
#[test]
fn recorded_support_dynamics_are_reproduced() {
    let data = data();
    let l = links(&data);
    for case in data["cases"].as_array().unwrap() {
        let c = chain(case);
        let (state, a, bias) = ours(&c);
        let t = terms(&l, &state);
        let m = dense(&t);
        let h0 = DVector::from_column_slice(&t.h);
        let (n, b) = held_by_left_foot(&t);
        let h = n.transpose() * &m * &n;
        let c0 = n.transpose() * (&m * &b + &h0);
        // Joint blocks of the coordinate map.
        let aj = a.view((6, 6), (DOF_COUNT, DOF_COUNT)).into_owned();
        let bj = bias.rows(6, DOF_COUNT).into_owned();
        let thdd = DVector::from_vec(numbers(&case["thdd"]));
        let hu = aj.transpose() * &h * &aj;
        let cu = aj.transpose() * (&h * &bj + &c0);
        let tau = &hu * &thdd + &cu;
        let check = |what: &str, ours: &[f64]| {
            let off = relative(ours, &numbers(&case[what]));
            assert!(off < AGREES, "{what}: {off:e}");
        };
        let row: Vec<f64> = hu.row(3).iter().copied().collect();
        check("H_diag", hu.diagonal().as_slice());
        check("H_row3", &row);
        check("c", cu.as_slice());
        check("tau", tau.as_slice());
        let vdot = &n * (&aj * &thdd + &bj) + &b;
        let vdot: [f64; NV] = std::array::from_fn(|i| vdot[i]);
        let (force, moment) = t.ground_wrench(&vdot);
        check("ground_force", &force.to_array());
        check("ground_moment_origin", &moment.to_array());
        // The foot does not accelerate, and Newton–Euler gives the same torques with the wrench at the foot.
        let mut j = [[0.0; 48]; 6];
        t.segment_jacobian(L_FOOT.index(), &mut j);
        let (alpha, acc) = t.segment_bias(L_FOOT.index());
        let gamma = [alpha.to_array(), acc.to_array()].concat();
        for k in 0..6 {
            let x: f64 = (0..NV).map(|i| j[k][i] * vdot[i]).sum::<f64>() + gamma[k];
            assert!(x.abs() < AGREES * 100.0, "foot accelerates by {x}");
        }
        let foot = t.segment_position(L_FOOT.index());
        let at_foot = moment - foot.cross(force);
        let wrench = [at_foot.to_array(), force.to_array()].concat();
        let whole = super::inverse(&l, &state, &vdot, GRAVITY);
        let newton = DVector::from_fn(DOF_COUNT, |d, _| {
            whole[6 + d] - (0..6).map(|k| j[k][6 + d] * wrench[k]).sum::<f64>()
        });
        let ours = &h * (&aj * &thdd + &bj) + &c0;
        assert!(relative(newton.as_slice(), ours.as_slice()) < AGREES);
    }
}
