//! Checks the kernel against its optimality conditions, and its storages against each other.

use super::*;
use crate::body::topology::{DOF_COUNT, NV};
use crate::contact::cone::{Cone, squared};
use crate::contact::interior::{Inner, TO_BOUNDARY, aim, to_cone, to_world};
use crate::contact::newton::{LineSearch, NewtonWorkspace};
use crate::contact::projection::{derivative, project};
use crate::contact::rows::PointRow;
use crate::dynamics::Terms;
use crate::dynamics::tests::{random_links, random_state};
use crate::math::Vec3;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Problem 14.2.
#[test]
fn projection_is_nearest_point_of_the_cone_and_its_derivative_matches_differences() {
    let mut rng = Pcg64Mcg::seed_from_u64(1);
    for _ in 0..2000 {
        let u = Vec3 {
            x: rng.random_range(-2.0..2.0),
            y: rng.random_range(-2.0..2.0),
            z: rng.random_range(-2.0..2.0),
        };
        let (f, region) = project(u, 0.7);
        assert!((f.x * f.x + f.y * f.y).sqrt() <= 0.7 * f.z + 1e-12);
        // Moreau: u − f is in the polar cone and orthogonal to f.
        let r = u - f;
        assert!(r.dot(f).abs() < 1e-12);
        assert!(0.7 * (r.x * r.x + r.y * r.y).sqrt() <= -r.z + 1e-12);
        let d = derivative(u, 0.7, region);
        let h = 1e-6;
        for (c, e) in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().enumerate() {
            let (a, ra) = project(u + e * h, 0.7);
            let (b, rb) = project(u - e * h, 0.7);
            if ra != region || rb != region {
                continue;
            }
            let num = (a - b) * (0.5 / h);
            assert!(
                (num - Vec3 {
                    x: d[0][c],
                    y: d[1][c],
                    z: d[2][c]
                })
                .norm()
                    < 1e-6
            );
        }
    }
}

/// The force of a contact or a motor at a given velocity is known. The interior method reaches it to all digits, at
/// sliding speeds from micrometres to kilometres a second: the distance to the cone's surface falls to 1e-16 of the
/// force, and stiffnesses stay positive.
#[test]
fn from_inside_contacts_and_motors_come_to_their_force() {
    let mut rng = Pcg64Mcg::seed_from_u64(3);
    let (mut nearest, mut most) = (f64::INFINITY, 0);
    for case in 0..3000 {
        let mut size = |most: f64| most * 10f64.powf(rng.random_range(-8.0..0.0));
        let (mu, r) = (size(2.0).max(0.05), size(1e-2).max(1e-6));
        let (fast, steep) = (size(1e5), size(1.0));
        let v = Vec3 {
            x: fast * rng.random_range(-1.0..1.0),
            y: fast * rng.random_range(-1.0..1.0),
            z: fast * steep * rng.random_range(-1.0..1.0),
        };
        let want = project(v * (-1.0 / r), mu).0;
        let mut cone = Cone::begin(to_cone(None, mu, v), fast, 3.0 * (fast / r));
        let (start, mut step, mut rounds) = (cone.gap(), 1.0, 0);
        while cone.gap() > 1e-22 * start {
            let aim = aim(cone.gap(), step);
            let root = cone.eliminate(r, mu, to_cone(None, mu, v), aim);
            let d = squared(&root);
            let inner = to_cone(None, mu, Vec3::Z).z; // 1/μ
            assert!(d[0][0] > 0.0 && d[0][0] <= (1.0 + 1e-9) / r, "case {case}");
            assert!(d[2][2] > 0.0 && d[2][2] <= (1.0 + 1e-9) / (r * inner * inner));
            step = (TO_BOUNDARY * cone.direct(Vec3::zero(), aim, 1.0 / TO_BOUNDARY)).min(1.0);
            cone.advance(step);
            assert!(cone.gap() > 0.0, "case {case}: outside after {rounds}");
            rounds += 1;
            assert!(rounds < 100, "case {case}: {} of {start}", cone.gap());
        }
        most = most.max(rounds);
        let got = to_world(None, mu, cone.force());
        let off = (got - want).norm();
        assert!(
            off < 1e-12 * v.norm() / r,
            "case {case}: off by {off:e} of {:e}",
            v.norm() / r
        );
        nearest = nearest.min(cone.nearness());
    }
    println!("at most {most} rounds");
    assert!(nearest < 1e-15, "{nearest:e}");
    for case in 0..3000 {
        let mut motors = Motors::default();
        let mut size = |most: f64| most * 10f64.powf(rng.random_range(-8.0..0.0));
        let (lower, room) = (-size(10.0), size(20.0));
        (motors.lower[0], motors.upper[0]) = (lower, lower + room);
        motors.gain[0] = size(1e3);
        let fast = size(1e4);
        motors.rest[0] = rng.random_range(-1.0..1.0);
        let x = fast * rng.random_range(-1.0..1.0);
        let want = motors.value(0, x).0;
        let mut inner = Inner::begin(&motors, 0, x, fast, room);
        let (start, mut step, mut rounds) = (inner.gap(), 1.0, 0);
        while inner.gap() > 1e-22 * start {
            let aim = 0.5 * aim(inner.gap(), step);
            let slope = inner.eliminate(&motors, 0, x, aim);
            step = (TO_BOUNDARY * inner.direct((slope, 0.0), aim, 1.0 / TO_BOUNDARY)).min(1.0);
            inner.advance(step);
            rounds += 1;
            assert!(inner.gap() > 0.0 && rounds < 100, "case {case}");
        }
        inner.eliminate(&motors, 0, x, 0.0);
        let off = (inner.value(&motors, 0) - want).abs();
        assert!(off < 1e-9 * room, "case {case}: off by {off:e} of {room:e}");
    }
}

/// Problem 14.2.
///
/// Problem 14.3.
#[test]
fn newton_reaches_the_minimum_and_both_storages_agree() {
    let mut rng = Pcg64Mcg::seed_from_u64(2);
    for case in 0..40 {
        let (links, state) = (random_links(&mut rng), random_state(&mut rng));
        let mut t = Terms::default();
        t.compute(&links, &state, &[], 9.81);
        let mut contacts = ContactRows::new(0.9);
        for segment in [6, 12, 16] {
            let slot = contacts.slot(&t.kin, segment);
            for vertex in 0..4 {
                let mut r = || rng.random_range(-0.1..0.1);
                let r = Vec3 {
                    x: r(),
                    y: r(),
                    z: r(),
                };
                let c = Vec3 {
                    x: 0.0,
                    y: 0.0,
                    z: rng.random_range(-1.0..1.0),
                };
                contacts.points.push(PointRow {
                    slot,
                    r,
                    c,
                    inverse_r: 1e4,
                    segment,
                    vertex,
                    turn: None,
                });
            }
        }
        let motors = Motors {
            gain: std::array::from_fn(|_| rng.random_range(0.1..10.0)),
            rest: std::array::from_fn(|_| rng.random_range(-3.0..3.0)),
            lower: [-0.5; DOF_COUNT],
            upper: [0.5; DOF_COUNT],
        };
        let limits = LimitRows {
            rows: (0..39)
                .map(|d| LimitRow {
                    first: 6 + d,
                    len: 1,
                    coefficients: [if d % 2 == 0 { 1.0 } else { -1.0 }, 0.0, 0.0],
                    allowed: rng.random_range(-0.5..4.0),
                    stiffness: limits::LIMIT_STIFFNESS,
                })
                .collect(),
        };
        let mut b = [0.0; NV];
        t.mass_matrix.mul(&state.velocity, &mut b);
        let (mut x, mut ws) = (state.velocity, NewtonWorkspace::default());
        let stop = StopRule {
            iterations: 60,
            tolerance: 1e-9,
        };
        let sparse = ConvexProblem {
            system: SparseSystem(&t.mass_matrix),
            b: &b,
            motors: &motors,
            limits: &limits,
            contacts: &contacts,
            wrench: None,
        };
        let o = minimise(&sparse, stop, &mut t.mass_matrix.clone(), &mut x, &mut ws);
        assert!(
            o.converged,
            "case {case}: residual {:e} after {}",
            o.residual, o.iterations
        );
        let (mut y, mut ws2) = (state.velocity, NewtonWorkspace::default());
        let dense = ConvexProblem {
            system: DenseSystem(&t.m),
            b: &b,
            motors: &motors,
            limits: &limits,
            contacts: &contacts,
            wrench: None,
        };
        let o2 = minimise(&dense, stop, &mut t.m.clone(), &mut y, &mut ws2);
        assert!(o2.converged);
        for i in 0..NV {
            assert!((x[i] - y[i]).abs() < 1e-8, "component {i}");
        }
        for (k, f) in ws.force.iter().enumerate().take(contacts.points.len()) {
            assert!(
                (f.x * f.x + f.y * f.y).sqrt() <= 0.9 * f.z * (1.0 + 1e-12) + 1e-15,
                "cone of point {k}"
            );
        }
        assert!(ws.motor.iter().all(|t| t.abs() <= 0.5));
        assert_ne!(
            ws.force[0],
            Vec3 {
                x: f64::NAN,
                ..Vec3::zero()
            }
        );
    }
}

#[test]
fn a_line_search_ends_near_the_zero_of_a_slope_that_grows() {
    // Slopes at a: linear, with a kink, with a step, nearly flat before it grows.
    let slopes: [fn(f64) -> f64; 5] = [
        |a| -1.0 + 4.0 * a,
        |a| -1.0 + 30.0 * (a - 0.7).max(0.0) + 0.1 * a,
        |a| if a < 0.3 { -1.0 } else { -0.02 },
        |a| -1.0 + a + 1e2 * (a - 0.02).max(0.0),
        |a| -1.0 + 0.5 * a,
    ];
    for (i, slope) in slopes.iter().enumerate() {
        let mut search = LineSearch::new(-1.0, 12);
        let mut evaluations = 1;
        while !search.ends_at(slope(search.step)) {
            evaluations += 1;
        }
        let left = slope(search.step);
        assert!(evaluations <= 13, "{i}: {evaluations}");
        let whole = search.step == 1.0 && left <= 0.1;
        assert!(whole || left.abs() < 0.05, "{i}: {left} at {}", search.step);
    }
}
