//! Independent algorithms agree on random bodies and states. Tolerances are relative to the largest entry of the
//! quantity; [`ROUNDING`] is some hundred operations' worth of rounding, [`SOLVED`] allows for the condition number of
//! M (10⁵–10⁶).

use super::bodies::{
    components, generator, loaded, random_body, random_loads, random_state, vector,
};
use super::{GRAVITY, inverse, relative, terms};
use nalgebra::{DMatrix, DVector};
use sinew_physics::body::{Links, NV, SEGMENT_COUNT, SegmentId, State};
use sinew_physics::dynamics::{
    AbaWorkspace, External, ExternalForces, Kinematics, RneaWorkspace, aba, center_of_mass, factor,
    kinetic_energy, momentum, rnea, solve,
};
use sinew_physics::math::{Quat, Vec3};

const ROUNDING: f64 = 1e-12;
const SOLVED: f64 = 1e-9;
const CASES: u64 = 60;

fn cases(mut check: impl FnMut(&Links, &State, &[f64; NV], &mut rand_pcg::Pcg64Mcg)) {
    for seed in 0..CASES {
        let mut rng = generator(1000 + seed);
        let body = random_body(&mut rng, if seed % 3 == 0 { 0.0 } else { 0.05 });
        let loads = if seed % 2 == 0 {
            Vec::new()
        } else {
            random_loads(&mut rng)
        };
        let links = loaded(&body, &loads);
        let state = random_state(&mut rng, 2.5);
        let a = components(&mut rng, 30.0);
        check(&links, &state, &a, &mut rng);
    }
}

#[test]
fn columns_of_the_inertia_matrix_are_torques_of_unit_accelerations() {
    cases(|links, state, _, _| {
        let t = terms(links, state);
        let h = inverse(links, state, &[0.0; NV], GRAVITY);
        assert!(relative(&t.h, &h) < ROUNDING);
        let still = State {
            velocity: [0.0; NV],
            ..*state
        };
        let (mut ours, mut theirs) = (Vec::new(), Vec::new());
        for j in 0..NV {
            let mut unit = [0.0; NV];
            unit[j] = 1.0;
            // Without gravity and velocity nothing is subtracted: column j is the torque itself.
            let column = inverse(links, &still, &unit, 0.0);
            theirs.extend(column);
            ours.extend((0..NV).map(|i| t.m[i][j]));
        }
        assert!(relative(&ours, &theirs) < ROUNDING);
    });
}

#[test]
fn the_inertia_matrix_is_symmetric_positive_definite_and_holds_the_kinetic_energy() {
    cases(|links, state, _, _| {
        let t = terms(links, state);
        for i in 0..NV {
            for j in 0..NV {
                assert_eq!(t.m[i][j].to_bits(), t.m[j][i].to_bits());
                assert_eq!(t.m[i][j], t.mass_matrix.get(i, j));
            }
        }
        let m = DMatrix::from_fn(NV, NV, |i, j| t.m[i][j]);
        assert!(m.clone().cholesky().is_some());
        let least = m.symmetric_eigenvalues().min();
        assert!(least > 0.0, "least eigenvalue {least}");
        let v = DVector::from_row_slice(&state.velocity);
        let m = DMatrix::from_fn(NV, NV, |i, j| t.m[i][j]);
        let reflected: f64 = (0..39)
            .map(|d| 0.5 * links.armature[d] * state.velocity[6 + d].powi(2))
            .sum();
        let energy = kinetic_energy(links, &t.kin) + reflected;
        let form = 0.5 * v.dot(&(m * &v));
        assert!(relative(&[energy], &[form]) < ROUNDING);
    });
}

/// Equation (6) of the paper.
#[test]
fn inverse_dynamics_is_inertia_times_acceleration_plus_bias() {
    cases(|links, state, a, _| {
        let t = terms(links, state);
        let tau = inverse(links, state, a, GRAVITY);
        let sum: Vec<f64> = (0..NV)
            .map(|i| t.h[i] + (0..NV).map(|j| t.m[i][j] * a[j]).sum::<f64>())
            .collect();
        assert!(relative(&sum, &tau) < ROUNDING);
        let mut product = [0.0; NV];
        t.mass_matrix.mul(a, &mut product);
        let sum: Vec<f64> = (0..NV).map(|i| t.h[i] + product[i]).collect();
        assert!(relative(&sum, &tau) < ROUNDING);
    });
}

#[test]
fn forward_dynamics_undoes_inverse_dynamics() {
    cases(|links, state, a, rng| {
        let external: Vec<External> = (0..SEGMENT_COUNT)
            .map(|_| External {
                moment: vector(rng, 20.0),
                force: vector(rng, 200.0),
            })
            .collect();
        for external in [&[][..], &external] {
            let mut kin = Kinematics::default();
            kin.set_state(links, state);
            let (mut tau, mut back) = ([0.0; NV], [0.0; NV]);
            let mut ws = RneaWorkspace::default();
            rnea(
                links,
                &kin,
                &state.velocity,
                a,
                ExternalForces {
                    gravity: GRAVITY,
                    on_segments: external,
                },
                &mut ws,
                &mut tau,
            );
            let mut work = AbaWorkspace::default();
            aba(
                links,
                &kin,
                &state.velocity,
                &tau,
                ExternalForces {
                    gravity: GRAVITY,
                    on_segments: external,
                },
                &mut work,
                &mut back,
            );
            assert!(relative(&back, a) < SOLVED);
        }
    });
}

#[test]
fn the_tree_factor_solves_as_a_dense_factor_does() {
    cases(|links, state, a, _| {
        let t = terms(links, state);
        let mut l = t.mass_matrix.clone();
        factor(&mut l);
        let mut x = *a;
        solve(&l, &mut x);
        let m = DMatrix::from_fn(NV, NV, |i, j| t.m[i][j]);
        let dense = m.cholesky().unwrap().solve(&DVector::from_row_slice(a));
        assert!(relative(&x, dense.as_slice()) < SOLVED);
        // And the residual is at rounding level, whatever the condition.
        let mut b = [0.0; NV];
        t.mass_matrix.mul(&x, &mut b);
        let scale = (0..NV)
            .map(|i| (0..NV).map(|j| (t.m[i][j] * x[j]).abs()).sum::<f64>())
            .fold(0.0, f64::max);
        for i in 0..NV {
            assert!((b[i] - a[i]).abs() < ROUNDING * scale);
        }
    });
}

#[test]
fn applied_forces_act_through_the_jacobian_of_their_point() {
    cases(|links, state, _, rng| {
        let t = terms(links, state);
        let forces: Vec<(SegmentId, Vec3, Vec3)> = [3usize, 9, 9, 17]
            .map(|s| {
                (
                    SegmentId::new(s).unwrap(),
                    vector(rng, 0.3),
                    vector(rng, 300.0),
                )
            })
            .to_vec();
        let mut with = sinew_physics::dynamics::Terms::default();
        with.compute(links, state, &forces, GRAVITY);
        let mut expected = t.h;
        for (s, point, force) in &forces {
            let mut j = [[0.0; 48]; 3];
            t.point_jacobian(s.index(), *point, &mut j);
            for i in 0..NV {
                expected[i] -= j[0][i] * force.x + j[1][i] * force.y + j[2][i] * force.z;
            }
        }
        assert!(relative(&with.h, &expected) < ROUNDING);
    });
}

#[test]
fn the_ground_wrench_is_the_rate_of_momentum_minus_gravity() {
    cases(|links, state, a, _| {
        let t = terms(links, state);
        let (force, moment) = t.ground_wrench(a);
        let row = |k: usize| (0..NV).map(|i| t.jc[k][i] * a[i]).sum::<f64>();
        let acc = Vec3 {
            x: row(0),
            y: row(1),
            z: row(2) + GRAVITY,
        } + t.com_bias;
        let expected = acc * t.mass;
        assert!(relative(&force.to_array(), &expected.to_array()) < ROUNDING);
        // Rate of the centroidal angular momentum, from momenta a little before and after.
        let at = |dt: f64| {
            let (s, _) = moved(state, a, dt);
            let mut kin = Kinematics::default();
            kin.set_state(links, &s);
            momentum(links, &kin)
        };
        let h = 1e-4;
        // Five-point difference: error O(h⁴).
        let d = |f: &dyn Fn(f64) -> Vec3| {
            (f(h) - f(-h)) * (8.0 / (12.0 * h)) - (f(2.0 * h) - f(-2.0 * h)) * (1.0 / (12.0 * h))
        };
        let rate = d(&|dt| at(dt).angular);
        let about_com = moment - t.com.cross(force);
        assert!(relative(&rate.to_array(), &about_com.to_array()) < 1e-6);
        let rate = d(&|dt| at(dt).linear);
        let expected = force
            - Vec3 {
                x: 0.0,
                y: 0.0,
                z: t.mass * GRAVITY,
            };
        assert!(relative(&rate.to_array(), &expected.to_array()) < 1e-6);
    });
}

/// The state `dt` seconds along the motion that starts with acceleration `a`. It is exact to second order in the
/// posture and first order in the velocity, which suffices for first derivatives at 0 (odd differences cancel the even
/// terms).
pub fn moved(state: &State, a: &[f64; NV], dt: f64) -> (State, [f64; NV]) {
    let mean: [f64; NV] = std::array::from_fn(|i| state.velocity[i] + 0.5 * dt * a[i]);
    let mut s = *state;
    s.posture.integrate(&mean, dt);
    s.velocity = std::array::from_fn(|i| state.velocity[i] + dt * a[i]);
    (s, mean)
}

#[test]
fn the_centre_of_mass_is_the_mean_of_the_segments() {
    cases(|links, state, _, _| {
        let t = terms(links, state);
        let mut sum = Vec3::zero();
        for s in 0..SEGMENT_COUNT {
            let com = links.moment[s] * (1.0 / links.mass[s]);
            sum += t.point_world(s, com) * links.mass[s];
        }
        let com = sum * (1.0 / links.total_mass());
        assert!((com - t.com).norm() < ROUNDING * 10.0);
        let (rel, mass) = center_of_mass(links, &t.kin);
        assert!((state.posture.root_position + rel - t.com).norm() < ROUNDING * 10.0);
        assert!(relative(&[mass], &[links.total_mass()]) < ROUNDING);
        let p = momentum(links, &t.kin);
        let v = t.com_velocity * t.mass;
        assert!(relative(&p.linear.to_array(), &v.to_array()) < ROUNDING);
    });
}

#[test]
fn torques_do_not_depend_on_where_the_figure_stands_or_looks() {
    cases(|links, state, a, rng| {
        let tau = inverse(links, state, a, GRAVITY);
        let shift = vector(rng, 50.0);
        let turn = Quat::from_axis_angle(Vec3::Z, 1.234);
        let turned = |x: &[f64; NV]| {
            let mut y = *x;
            for k in [0, 3] {
                let v = turn.rotate(Vec3::from_array([x[k], x[k + 1], x[k + 2]]));
                y[k..k + 3].copy_from_slice(&v.to_array());
            }
            y
        };
        let mut other = *state;
        other.posture.root_position = turn.rotate(state.posture.root_position) + shift;
        other.posture.root_rotation = turn * state.posture.root_rotation;
        other.velocity = turned(&state.velocity);
        let expected = turned(&tau);
        let got = inverse(links, &other, &turned(a), GRAVITY);
        assert!(relative(&got, &expected) < ROUNDING);
    });
}

/// A check that cannot fail proves nothing: wrong physics must be detected, by a wide margin.
#[test]
fn wrong_physics_is_off_by_a_wide_margin() {
    let wide = 1e6 * ROUNDING;
    cases(|links, state, a, _| {
        let t = terms(links, state);
        let tau = inverse(links, state, a, GRAVITY);
        let sum = |h: &[f64; NV]| -> Vec<f64> {
            (0..NV)
                .map(|i| h[i] + (0..NV).map(|j| t.m[i][j] * a[j]).sum::<f64>())
                .collect()
        };
        let wrong_gravity = inverse(links, state, &[0.0; NV], GRAVITY + 0.1);
        assert!(relative(&sum(&wrong_gravity), &tau) > wide);
        let still = State {
            velocity: [0.0; NV],
            ..*state
        };
        let no_coriolis = inverse(links, &still, &[0.0; NV], GRAVITY);
        assert!(relative(&sum(&no_coriolis), &tau) > wide * 100.0);
        // Jacobian rows swapped.
        let mut j = [[0.0; 48]; 3];
        t.point_jacobian(9, Vec3::X, &mut j);
        let v = |k: usize| (0..NV).map(|i| j[k][i] * state.velocity[i]).sum::<f64>();
        let true_velocity = t.point_velocity(9, Vec3::X).to_array();
        assert!(relative(&[v(0), v(1), v(2)], &true_velocity) < ROUNDING);
        assert!(relative(&[v(1), v(0), v(2)], &true_velocity) > wide);
        // A load forgotten.
        let mut heavier = links.clone();
        heavier.add_load(SegmentId::new(9).unwrap(), Vec3::X * 0.1, 1.0);
        assert!(relative(&inverse(&heavier, state, a, GRAVITY), &tau) > wide);
    });
}
