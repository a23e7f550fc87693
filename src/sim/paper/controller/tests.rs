//! Goal: the equations do what the paper says. Method: identities, on a plain mannequin in random stances.

use super::*;
use crate::body::NV;
use crate::body::topology::{L_FOOT, R_FOOT};
use crate::control::rows::{dot, padded};
use crate::control::testing::{DT, Scene};
use crate::dynamics::terms::WIDTH;
use crate::math::Quat;
use crate::math::vec3::vec3;
use crate::setup::{Priority, Share};
use crate::support::testing::{
    GRAVITY, Rng, mannequin, on_floor, random_stance, random_state, standing,
};

/// A scene without secondary constraints.
fn bare(mut s: Scene) -> Scene {
    (s.params.track_com, s.params.track_hands) = (false, false);
    s
}

/// Equation (17) of the paper.
#[test]
fn without_saturation_and_targets_the_output_is_the_initial_acceleration_to_the_bit() {
    let (body, mut rng) = (mannequin(), Rng::new(41));
    for _ in 0..20 {
        let s = bare(Scene::new(
            &random_stance(&body, &mut rng, 0.05, 0.1),
            &standing(&body),
            1000.0,
        ));
        let law = Law::new(&s.params, DT);
        let initial = initial_acceleration(&s.body, &s.terms.state, &s.target, &law);
        let mut paper = Paper::new();
        let c = paper.control(&s.input());
        assert_eq!((c.saturated, c.saturated_secondary), (0, 0));
        assert_eq!(padded(&c.joint_acceleration), initial);
    }
}

#[test]
fn standing_at_rest_holds_still_with_the_weight_on_both_feet() {
    let body = mannequin();
    let state = standing(&body);
    let s = Scene::new(&state, &state, 1.0);
    let mut paper = Paper::new();
    let c = paper.control(&s.input()).clone();
    assert_eq!(c.flags, Flags::default());
    assert!(c.joint_acceleration.iter().all(|a| a.abs() < 1e-6));
    let z = c.zmp.unwrap();
    assert!((z.x - s.terms.com.x).abs() < 1e-6 && (z.y - s.terms.com.y).abs() < 1e-6);
    assert!(c.margin.unwrap() > 0.03 && c.pivot.is_none());
    // Mirror symmetry: knees, hips and ankles of both legs have equal results.
    for d in 23..31 {
        assert!((c.torque[d] - c.torque[d + 8]).abs() < 1e-6, "DOF {d}");
    }
    let (f, _) = s.terms.ground_wrench(&c.acceleration);
    assert!((f.z - s.terms.mass * GRAVITY).abs() < 1e-3);
}

/// Equation (17) of the paper.
#[test]
fn torques_are_within_limits_and_belong_to_the_accelerations() {
    let (body, mut rng) = (mannequin(), Rng::new(42));
    let mut paper = Paper::new();
    let mut seen = [0; 4];
    for round in 0..400 {
        let state = match round % 4 {
            0 => random_stance(&body, &mut rng, 0.3, 1.0),
            1 => random_stance(&body, &mut rng, 0.8, 4.0),
            2 => {
                let mut s = random_state(&body, &mut rng, 1.0, 5.0);
                s.posture = on_floor(&body, s.posture);
                s
            }
            _ => random_state(&body, &mut rng, 2.0, 15.0),
        };
        let desired = random_state(&body, &mut rng, 1.0, 0.0);
        let mut s = Scene::new(
            &state,
            &desired,
            [0.05, 0.3, 1.0, 20.0][rng_index(&mut rng)],
        );
        s.params.metric = [Metric::Identity, Metric::Inertia, Metric::Torque][round % 3];
        s.params.priority = [Priority::Paper, Priority::Nested][round % 2];
        s.params.share = [Share::Balanced, Share::Paper][round / 2 % 2];
        s.params.horizon = [Some(0.1), None][round / 3 % 2];
        s.params.to_limit = round % 5 == 0;
        s.params.tilt = round % 7 != 0;
        s.kinematic = round % 2 == 0;
        if round % 3 == 0 {
            paper.reset();
        }
        let c = paper.control(&s.input()).clone();
        for j in 0..DOF_COUNT {
            assert!(c.torque[j] >= s.lower[j] && c.torque[j] <= s.upper[j]);
            assert!(c.joint_acceleration[j].is_finite());
        }
        assert!(c.acceleration.iter().all(|a| a.is_finite()));
        let qdd = padded(&c.joint_acceleration);
        assert_eq!(paper.map().acceleration(&qdd), c.acceleration);
        if !c.flags.has(Flags::OVERLOAD) && !c.flags.has(Flags::DAMPED) {
            let tau = paper.map().torque(&qdd);
            for j in 0..DOF_COUNT {
                let scale = tau[j].abs().max(1.0);
                assert!((tau[j] - c.torque[j]).abs() < 1e-6 * scale, "DOF {j}");
            }
        }
        for (n, f) in [Flags::FLIGHT, Flags::TIPPING, Flags::OVERLOAD]
            .into_iter()
            .enumerate()
        {
            seen[n] += usize::from(c.flags.has(f));
        }
        seen[3] += usize::from(c.saturated != 0 && !c.flags.has(Flags::OVERLOAD));
    }
    assert!(
        seen.iter().all(|n| *n > 10),
        "every regime was met: {seen:?}"
    );
}
fn rng_index(rng: &mut Rng) -> usize {
    ((rng.unit() + 1.0) * 2.0) as usize % 4
}

/// Equations (7)–(11) of the paper.
///
/// Repair S4.
#[test]
fn limits_hold_after_both_stages_for_any_scale_of_the_demand_and_every_metric() {
    let (body, mut rng) = (mannequin(), Rng::new(43));
    let (mut first, mut second) = (TorqueLimits::default(), SpatialLimits::default());
    let mut worst_rounds = 0;
    for round in 0..120 {
        let state = random_stance(&body, &mut rng, 0.5, 2.0);
        let s = Scene::new(&state, &state, 1.0);
        let main = s.support.main().unwrap();
        let mut map = SupportMap::default();
        map.set_support(&s.terms, main, Vec3::zero(), Vec3::zero());
        let balanced = round % 2 == 0;
        if balanced {
            let mut sharing = Sharing::default();
            sharing.set_balanced(s.support.points(), s.support.ratio(), &[false; 64]);
            map.add_sharing(&s.terms, &sharing, main);
        }
        for scale in [1.0, 10.0, 100.0, 1000.0] {
            let mut initial = [0.0; ROW];
            (0..DOF_COUNT).for_each(|d| initial[d] = 5.0 * scale * rng.unit());
            let tau0 = map.torque(&initial);
            for metric in [Metric::Identity, Metric::Inertia, Metric::Torque] {
                let torques = |tau| JointTorques {
                    h: &map.h,
                    tau,
                    lower: &s.lower,
                    upper: &s.upper,
                };
                let o = first.solve(torques(&tau0), metric, &[], DOF_COUNT);
                assert!(o.complete && o.rounds <= 39);
                worst_rounds = worst_rounds.max(o.rounds);
                let mut qdd = initial;
                (0..ROW).for_each(|d| qdd[d] += first.change[d]);
                let tau1 = map.torque(&qdd);
                // At k = 39 with balanced sharing H is not symmetric and may be badly conditioned.
                let slack = if balanced && o.set.count_ones() >= 36 {
                    1e-4
                } else {
                    1e-9 * scale.max(3.0)
                };
                for j in 0..DOF_COUNT {
                    assert!(
                        !violates(tau1[j], s.lower[j], s.upper[j], slack),
                        "{metric:?} ×{scale} k {} DOF {j}: {} of {}…{}",
                        o.set.count_ones(),
                        tau1[j],
                        s.lower[j],
                        s.upper[j]
                    );
                }
                let mut x = [0.0; ROW];
                (0..DOF_COUNT).for_each(|d| x[d] = scale * rng.unit());
                let o = second.solve(torques(&tau1), &mut x, false, &[], 39);
                assert!(o.complete && o.rounds <= 39);
                (0..ROW).for_each(|d| qdd[d] += x[d]);
                let tau2 = map.torque(&qdd);
                for j in 0..DOF_COUNT {
                    assert!(!violates(tau2[j], s.lower[j], s.upper[j], 2.0 * slack));
                    if o.set >> j & 1 == 1 {
                        assert!(dot(&map.h[j], &x).abs() < 1e-9 * scale.max(1.0));
                    }
                }
            }
        }
    }
    assert!(worst_rounds > 2, "{worst_rounds}");
}

/// Equations (14), (15) of the paper.
#[test]
fn centre_of_mass_gets_its_acceleration_when_nothing_saturates() {
    let (body, mut rng) = (mannequin(), Rng::new(44));
    for _ in 0..20 {
        let state = random_stance(&body, &mut rng, 0.1, 0.2);
        let mut s = Scene::new(&state, &standing(&body), 100.0);
        (s.params.track_hands, s.params.zmp_feasible) = (false, false);
        let mut paper = Paper::new();
        let c = paper.control(&s.input());
        if c.pivot.is_some() {
            continue;
        }
        let wanted = (s.com.now - s.terms.com) * 25.0 - s.terms.com_velocity * 10.0;
        let row = |k: usize| {
            (0..NV)
                .map(|i| s.terms.jc[k][i] * c.acceleration[i])
                .sum::<f64>()
        };
        assert!((row(0) + s.terms.com_bias.x - wanted.x).abs() < 1e-4);
        assert!((row(1) + s.terms.com_bias.y - wanted.y).abs() < 1e-4);
    }
}

/// Equations (14), (15) of the paper.
#[test]
fn hands_get_their_acceleration_under_nested_priority() {
    let (body, mut rng) = (mannequin(), Rng::new(45));
    for _ in 0..20 {
        let state = random_stance(&body, &mut rng, 0.1, 0.2);
        let mut s = Scene::new(&state, &state, 100.0);
        for (k, e) in s.effectors.iter_mut().enumerate() {
            e.position.now += vec3(0.01, 0.02, -0.01);
            if k == 0 {
                let r = Quat::from_mat3(&s.terms.segment_rotation(e.segment.index()));
                let goal = Quat::exp(vec3(0.1, 0.0, -0.05)) * r;
                e.rotation = Some(crate::control::RotationTarget {
                    now: goal,
                    next: goal,
                    ..Default::default()
                });
            }
        }
        let mut paper = Paper::new();
        let c = paper.control(&s.input());
        if c.pivot.is_some() {
            continue;
        }
        for e in &s.effectors {
            let mut j = [[0.0; WIDTH]; 3];
            let i = e.segment.index();
            s.terms.point_jacobian(i, e.point, &mut j);
            let bias = s.terms.point_bias(i, e.point).to_array();
            let wanted = ((e.position.now - s.terms.point_world(i, e.point)) * 25.0
                - s.terms.point_velocity(i, e.point) * 10.0)
                .to_array();
            for k in 0..3 {
                let a = (0..NV).map(|i| j[k][i] * c.acceleration[i]).sum::<f64>() + bias[k];
                assert!((a - wanted[k]).abs() < 0.02, "{a} {}", wanted[k]);
            }
        }
    }
}

#[test]
fn the_same_input_gives_the_same_bits_and_the_workspace_carries_nothing_over() {
    let (body, mut rng) = (mannequin(), Rng::new(46));
    let mut used = Paper::new();
    for _ in 0..30 {
        let state = random_stance(&body, &mut rng, 0.5, 2.0);
        let s = Scene::new(&state, &standing(&body), 0.5);
        let mut fresh = Paper::new();
        used.reset();
        assert_eq!(used.control(&s.input()), fresh.control(&s.input()));
    }
}

#[test]
fn where_in_the_world_a_figure_stands_does_not_matter() {
    let body = mannequin();
    let state = random_stance(&body, &mut Rng::new(47), 0.2, 0.5);
    let mut far = state;
    far.posture.root_position += vec3(800.0, -300.0, 0.0);
    let mut desired = standing(&body);
    let near = Scene::new(&state, &desired, 0.3);
    desired.posture.root_position += vec3(800.0, -300.0, 0.0);
    let far = Scene::new(&far, &desired, 0.3);
    let a = Paper::new().control(&near.input()).clone();
    let b = Paper::new().control(&far.input()).clone();
    for j in 0..DOF_COUNT {
        assert!((a.torque[j] - b.torque[j]).abs() < 1e-6);
    }
}

/// Repair S1.
#[test]
fn a_leaning_figure_tips_and_a_lifted_one_flies() {
    let body = mannequin();
    let mut state = standing(&body);
    // Lean forward about the ankles until the centre of mass is in front of the toes.
    let mut a = crate::body::angles::anatomical_angles(&state.posture);
    (a[27], a[35]) = (0.6, 0.6);
    crate::body::angles::set_anatomical_angles(&mut state.posture, &a);
    state.posture.root_rotation = Quat::exp(vec3(0.0, 0.5, 0.0));
    state.posture = on_floor(&body, state.posture);
    let s = bare(Scene::new(&state, &state, 20.0));
    let mut paper = Paper::new();
    let c = paper.control(&s.input());
    let p = c.pivot.expect("tips");
    assert!(c.flags.has(Flags::TIPPING) && c.margin.unwrap() < 0.0);
    assert!(p.axes()[0].y.abs() > 0.99 && s.terms.com.x > p.point.x);
    // Forward: the centre of mass accelerates forward and down.
    let row = |k: usize| {
        (0..NV)
            .map(|i| s.terms.jc[k][i] * c.acceleration[i])
            .sum::<f64>()
    };
    assert!(row(0) > 0.0 && row(2) < 0.0);

    let mut state = standing(&body);
    state.posture.root_position.z += 1.0;
    let s = Scene::new(&state, &state, 1.0);
    let c = paper.control(&s.input());
    assert!(c.flags.has(Flags::FLIGHT) && c.zmp.is_none() && c.margin.is_none());
    let (f, n) = s.terms.ground_wrench(&c.acceleration);
    assert!(f.norm() < 1e-6 && n.norm() < 1e-6);
}

#[test]
fn a_second_planted_foot_stays_put_in_kinematic_stepping() {
    let (body, mut rng) = (mannequin(), Rng::new(48));
    for _ in 0..10 {
        let state = random_stance(&body, &mut rng, 0.1, 0.3);
        let desired = random_stance(&body, &mut rng, 0.1, 0.0);
        let mut s = Scene::new(&state, &desired, 1.0);
        s.kinematic = true;
        let mut paper = Paper::new();
        let c = paper.control(&s.input()).clone();
        if c.pivot.is_some() || c.flags.has(Flags::OVERLOAD) {
            continue;
        }
        for foot in [L_FOOT, R_FOOT] {
            let mut j = [[0.0; WIDTH]; 6];
            s.terms.segment_jacobian(foot.index(), &mut j);
            let (alpha, acc) = s.terms.segment_bias(foot.index());
            let bias = [alpha.x, alpha.y, alpha.z, acc.x, acc.y, acc.z];
            for k in 0..6 {
                let v: f64 = (0..NV).map(|i| j[k][i] * s.terms.state.velocity[i]).sum();
                let a = (0..NV).map(|i| j[k][i] * c.acceleration[i]).sum::<f64>() + bias[k];
                assert!((a + v / DT).abs() < 1e-3, "{foot:?} row {k}: {a}");
            }
        }
    }
}
