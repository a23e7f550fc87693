//! Jacobians, bias terms and rates against central differences of the kinematics.

use super::bodies::{generator, loaded, random_body, random_loads, random_state, vector};
use super::identities::moved;
use super::{GRAVITY, inverse, largest, terms};
use sinew_physics::body::{Links, NV, SEGMENT_COUNT, State};
use sinew_physics::dynamics::Terms;
use sinew_physics::math::{Quat, Vec3};

/// Step of central differences: truncation h² ≈ 1e-10 and rounding 1e-16/h ≈ 1e-11, times third derivatives (speeds of
/// 5 rad/s).
const STEP: f64 = 1e-5;
/// Relative resolution of central differences.
const RESOLVED: f64 = 1e-7;

fn case(seed: u64) -> (Links, State, rand_pcg::Pcg64Mcg) {
    let mut rng = generator(seed);
    let body = random_body(&mut rng, 0.02);
    let loads = random_loads(&mut rng);
    let state = random_state(&mut rng, 2.5);
    (loaded(&body, &loads), state, rng)
}

fn along(state: &State, direction: &[f64; NV], dt: f64) -> State {
    let mut s = *state;
    s.posture.integrate(direction, dt);
    s
}

#[test]
fn every_jacobian_column_is_a_displacement() {
    for seed in 0..4 {
        let (links, state, mut rng) = case(seed);
        let t = terms(&links, &state);
        let points: Vec<Vec3> = (0..SEGMENT_COUNT).map(|_| vector(&mut rng, 0.3)).collect();
        let mut jp = vec![[[0.0; 48]; 3]; SEGMENT_COUNT];
        let mut js = vec![[[0.0; 48]; 6]; SEGMENT_COUNT];
        for s in 0..SEGMENT_COUNT {
            t.point_jacobian(s, points[s], &mut jp[s]);
            t.segment_jacobian(s, &mut js[s]);
        }
        for i in 0..NV {
            let mut unit = [0.0; NV];
            unit[i] = 1.0;
            let plus = terms(&links, &along(&state, &unit, STEP));
            let minus = terms(&links, &along(&state, &unit, -STEP));
            let half = 0.5 / STEP;
            let com = (plus.com - minus.com) * half;
            for (k, c) in com.to_array().into_iter().enumerate() {
                assert!((c - t.jc[k][i]).abs() < RESOLVED);
            }
            for s in 0..SEGMENT_COUNT {
                let p = (plus.point_world(s, points[s]) - minus.point_world(s, points[s])) * half;
                let o = (plus.segment_position(s) - minus.segment_position(s)) * half;
                let r = Quat::from_mat3(
                    &(plus.segment_rotation(s) * minus.segment_rotation(s).transpose()),
                )
                .log()
                    * half;
                for k in 0..3 {
                    assert!((p.to_array()[k] - jp[s][k][i]).abs() < RESOLVED);
                    assert!((r.to_array()[k] - js[s][k][i]).abs() < RESOLVED);
                    assert!((o.to_array()[k] - js[s][3 + k][i]).abs() < RESOLVED);
                }
            }
        }
    }
}

#[test]
fn velocities_are_jacobians_times_rates() {
    for seed in 10..20 {
        let (links, state, mut rng) = case(seed);
        let t = terms(&links, &state);
        for s in 0..SEGMENT_COUNT {
            let p = vector(&mut rng, 0.3);
            let mut j = [[0.0; 48]; 3];
            t.point_jacobian(s, p, &mut j);
            let v = t.point_velocity(s, p).to_array();
            for k in 0..3 {
                let jv: f64 = (0..NV).map(|i| j[k][i] * state.velocity[i]).sum();
                assert!((jv - v[k]).abs() < 1e-12 * largest(&state.velocity) * NV as f64);
            }
        }
    }
}

#[test]
fn bias_terms_are_rates_of_velocity_at_constant_rates() {
    for seed in 20..30 {
        let (links, state, mut rng) = case(seed);
        let t = terms(&links, &state);
        let at = |dt: f64| terms(&links, &along(&state, &state.velocity, dt));
        let (plus, minus) = (at(STEP), at(-STEP));
        let half = 0.5 / STEP;
        let bound = RESOLVED * 1e4; // accelerations reach 10³ and their second derivatives 10⁵
        let com = (plus.com_velocity - minus.com_velocity) * half;
        assert!((com - t.com_bias).norm() < bound);
        for s in 0..SEGMENT_COUNT {
            let p = vector(&mut rng, 0.3);
            let acc = (plus.point_velocity(s, p) - minus.point_velocity(s, p)) * half;
            assert!((acc - t.point_bias(s, p)).norm() < RESOLVED * (acc.norm() + 1e4));
            let alpha = (plus.kin.omega[s] - minus.kin.omega[s]) * half;
            let (a, o) = t.segment_bias(s);
            assert!((alpha - a).norm() < RESOLVED * (alpha.norm() + 1e4));
            let origin = (plus.kin.velocity[s] - minus.kin.velocity[s]) * half;
            assert!((origin - o).norm() < RESOLVED * (origin.norm() + 1e4));
        }
    }
}

/// `d/dt ½vᵀMv = vᵀτ` for motion without gravity means `½ vᵀ Ṁ v = vᵀ C v`: Ṁ − 2C does no work.
#[test]
fn coriolis_forces_do_no_work_beyond_the_change_of_inertia() {
    for seed in 30..40 {
        let (links, state, _) = case(seed);
        let coriolis = inverse(&links, &state, &[0.0; NV], 0.0);
        let power: f64 = (0..NV).map(|i| coriolis[i] * state.velocity[i]).sum();
        let form = |t: &Terms| -> f64 {
            (0..NV)
                .map(|i| {
                    state.velocity[i] * (0..NV).map(|j| t.m[i][j] * state.velocity[j]).sum::<f64>()
                })
                .sum()
        };
        let at = |dt: f64| form(&terms(&links, &along(&state, &state.velocity, dt)));
        let h = 1e-4;
        let rate = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
        let scale = form(&terms(&links, &state));
        assert!(
            (0.5 * rate - power).abs() < 1e-7 * scale.max(power.abs()),
            "{} against {power}",
            0.5 * rate
        );
    }
}

#[test]
fn energy_changes_by_the_power_of_the_torques_in_flight() {
    for seed in 40..50 {
        let (links, state, mut rng) = case(seed);
        let a = super::bodies::components(&mut rng, 30.0);
        // Any wrench on the pelvis and any torques: inverse dynamics gives the forces of this motion.
        let tau = inverse(&links, &state, &a, GRAVITY);
        let power: f64 = (0..NV).map(|i| tau[i] * state.velocity[i]).sum();
        let energy = |dt: f64| {
            let (s, _) = moved(&state, &a, dt);
            let t = terms(&links, &s);
            let kinetic: f64 = 0.5
                * (0..NV)
                    .map(|i| {
                        s.velocity[i] * (0..NV).map(|j| t.m[i][j] * s.velocity[j]).sum::<f64>()
                    })
                    .sum::<f64>();
            kinetic + t.mass * GRAVITY * t.com.z
        };
        let h = 1e-4;
        let rate =
            (8.0 * (energy(h) - energy(-h)) - (energy(2.0 * h) - energy(-2.0 * h))) / (12.0 * h);
        let scale = power.abs().max(energy(0.0).abs());
        assert!(
            (rate - power).abs() < 1e-6 * scale,
            "{rate} against {power}"
        );
    }
}
