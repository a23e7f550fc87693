//! Independent algorithms agree: RNEA against CRBA, ABA and the factor against both, bias against finite differences.

use super::*;
use crate::body::topology::{DOF_COUNT, NV, SEGMENT_COUNT};
use crate::body::{Links, State};
use crate::math::{F64x8, Sym3, Vec3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

pub(crate) fn random_links(rng: &mut Pcg64Mcg) -> Links {
    let v = |rng: &mut Pcg64Mcg, s: f64| Vec3 {
        x: rng.random_range(-s..s),
        y: rng.random_range(-s..s),
        z: rng.random_range(-s..s),
    };
    let mut l = Links {
        offset: std::array::from_fn(|_| v(rng, 0.3)),
        mass: std::array::from_fn(|_| rng.random_range(0.3..10.0)),
        moment: [Vec3::zero(); SEGMENT_COUNT],
        inertia: [Sym3::zero(); SEGMENT_COUNT],
        armature: std::array::from_fn::<_, DOF_COUNT, _>(|_| rng.random_range(0.0..0.05)),
    };
    for s in 0..SEGMENT_COUNT {
        let c = v(rng, 0.1);
        l.moment[s] = c * l.mass[s];
        l.inertia[s] =
            Sym3::diagonal(0.01, 0.012, 0.009) * l.mass[s] + Sym3::point_mass(l.mass[s], c);
    }
    l
}

pub(crate) fn random_state(rng: &mut Pcg64Mcg) -> State {
    let mut s = State::default();
    let step: [f64; NV] = std::array::from_fn(|_| rng.random_range(-1.0..1.0));
    s.posture.integrate(&step, 1.0);
    s.velocity = std::array::from_fn(|_| rng.random_range(-3.0..3.0));
    s
}

#[test]
fn inverse_forward_and_factor_agree() {
    let mut rng = Pcg64Mcg::seed_from_u64(5);
    for _ in 0..100 {
        let (l, s) = (random_links(&mut rng), random_state(&mut rng));
        let a: [f64; NV] = std::array::from_fn(|_| rng.random_range(-20.0..20.0));
        let (mut kin, mut ws, mut tau) =
            (Kinematics::default(), RneaWorkspace::default(), [0.0; NV]);
        kin.set_state(&l, &s);
        rnea(
            &l,
            &kin,
            &s.velocity,
            &a,
            ExternalForces::gravity(9.81),
            &mut ws,
            &mut tau,
        );
        let mut t = Terms::default();
        t.compute(&l, &s, &[], 9.81);
        let scale = tau.iter().fold(1.0f64, |m, x| m.max(x.abs()));
        let (mut ma, mut back) = ([0.0; NV], [0.0; NV]);
        t.mass_matrix.mul(&a, &mut ma);
        for i in 0..NV {
            assert!((ma[i] + t.h[i] - tau[i]).abs() < 1e-12 * scale, "row {i}");
            let dense: f64 = (0..NV).map(|j| t.m[i][j] * a[j]).sum();
            assert!((dense - ma[i]).abs() < 1e-12 * scale);
        }
        aba(
            &l,
            &kin,
            &s.velocity,
            &tau,
            ExternalForces::gravity(9.81),
            &mut AbaWorkspace::default(),
            &mut back,
        );
        let mut x: [f64; NV] = std::array::from_fn(|i| tau[i] - t.h[i]);
        let mut f = t.mass_matrix.clone();
        factor(&mut f);
        solve(&f, &mut x);
        for i in 0..NV {
            assert!(
                (back[i] - a[i]).abs() < 1e-9,
                "aba {i}: {} against {}",
                back[i],
                a[i]
            );
            assert!(
                (x[i] - a[i]).abs() < 1e-9,
                "solve {i}: {} against {}",
                x[i],
                a[i]
            );
        }
        let (f, _) = t.ground_wrench(&a);
        let acc: f64 = (0..NV).map(|j| t.jc[2][j] * a[j]).sum::<f64>() + t.com_bias.z;
        assert!((f.z - t.mass * (acc + 9.81)).abs() < 1e-10 * t.mass * 100.0);
    }
}

#[test]
fn eight_lanes_carry_the_bits_of_one() {
    let mut rng = Pcg64Mcg::seed_from_u64(6);
    let mut links = Links::<F64x8>::splat(&random_links(&mut rng));
    let (mut state, mut a) = (State::<F64x8>::default(), [F64x8::default(); NV]);
    let one: Vec<_> = (0..8)
        .map(|k| {
            let (l, s) = (random_links(&mut rng), random_state(&mut rng));
            let acc: [f64; NV] = std::array::from_fn(|_| rng.random_range(-20.0..20.0));
            links.set_lane(k, &l);
            state.set_lane(k, &s);
            (0..NV).for_each(|i| a[i].0[k] = acc[i]);
            (l, s, acc)
        })
        .collect();
    let (mut kin, mut ws, mut tau) = (
        Kinematics::default(),
        RneaWorkspace::default(),
        [F64x8::default(); NV],
    );
    lanes::rnea_x8(
        &links,
        &state,
        &a,
        ExternalForces::gravity(F64x8([9.81; 8])),
        &mut kin,
        &mut ws,
        &mut tau,
    );
    let (mut ci, mut m) = (CompositeInertia::default(), MassMatrix::default());
    lanes::crba_x8(&links, &kin, &mut ci, &mut m);
    let mut x = tau;
    lanes::factor_solve_x8(&mut m, &mut x);
    let mut acc = [F64x8::default(); NV];
    lanes::aba_x8(
        &links,
        &kin,
        &state.velocity,
        &tau,
        ExternalForces::gravity(F64x8([9.81; 8])),
        &mut AbaWorkspace::default(),
        &mut acc,
    );
    for (k, (l, s, a1)) in one.iter().enumerate() {
        let (mut kin1, mut ws1, mut tau1) =
            (Kinematics::default(), RneaWorkspace::default(), [0.0; NV]);
        kin1.set_state(l, s);
        rnea(
            l,
            &kin1,
            &s.velocity,
            a1,
            ExternalForces::gravity(9.81),
            &mut ws1,
            &mut tau1,
        );
        let (mut ci1, mut m1, mut x1, mut acc1) = (
            CompositeInertia::default(),
            MassMatrix::default(),
            tau1,
            [0.0; NV],
        );
        crba(l, &kin1, &mut ci1, &mut m1);
        factor(&mut m1);
        solve(&m1, &mut x1);
        aba(
            l,
            &kin1,
            &s.velocity,
            &tau1,
            ExternalForces::gravity(9.81),
            &mut AbaWorkspace::default(),
            &mut acc1,
        );
        for i in 0..NV {
            assert_eq!(
                tau[i].0[k].to_bits(),
                tau1[i].to_bits(),
                "rnea lane {k} row {i}"
            );
            assert_eq!(
                x[i].0[k].to_bits(),
                x1[i].to_bits(),
                "factor lane {k} row {i}"
            );
            assert_eq!(
                acc[i].0[k].to_bits(),
                acc1[i].to_bits(),
                "aba lane {k} row {i}"
            );
        }
    }
}

#[test]
fn point_jacobian_and_bias_match_differences() {
    let mut rng = Pcg64Mcg::seed_from_u64(7);
    let p = Vec3 {
        x: 0.1,
        y: -0.05,
        z: 0.2,
    };
    for seg in [0, 6, 12, 17] {
        let (l, s) = (random_links(&mut rng), random_state(&mut rng));
        let mut t = Terms::default();
        t.compute(&l, &s, &[], 9.81);
        let mut j = [[0.0; 48]; 3];
        t.point_jacobian(seg, p, &mut j);
        let h = 1e-6;
        let at = |dt: f64| {
            let mut s2 = s;
            s2.posture.integrate(&s.velocity, dt);
            let mut t2 = Terms::default();
            t2.compute(&l, &s2, &[], 9.81);
            (
                t2.point_world(seg, p),
                t2.point_velocity(seg, p),
                t2.com,
                t2.com_velocity,
            )
        };
        let (a, b) = (at(h), at(-h));
        let v: Vec<f64> = (0..3)
            .map(|k| (0..NV).map(|i| j[k][i] * s.velocity[i]).sum())
            .collect();
        let num = (a.0 - b.0) * (0.5 / h);
        assert!(
            (num.x - v[0])
                .abs()
                .max((num.y - v[1]).abs())
                .max((num.z - v[2]).abs())
                < 1e-7
        );
        let bias = (a.1 - b.1) * (0.5 / h) - t.point_bias(seg, p);
        assert!(
            bias.norm() < 1e-6,
            "bias of segment {seg} off by {}",
            bias.norm()
        );
        assert!(((a.2 - b.2) * (0.5 / h) - t.com_velocity).norm() < 1e-7);
        assert!(((a.3 - b.3) * (0.5 / h) - t.com_bias).norm() < 1e-6);
    }
}

#[test]
fn rows_of_the_angular_momentum_give_it_and_its_rate() {
    let mut rng = Pcg64Mcg::seed_from_u64(61);
    for _ in 0..50 {
        let (l, s) = (random_links(&mut rng), random_state(&mut rng));
        let a: [f64; NV] = std::array::from_fn(|_| rng.random_range(-5.0..5.0));
        let mut t = Terms::default();
        t.compute(&l, &s, &[], 9.81);
        let (rows, bias) = t.spin_rows();
        let spin = |s: &State| {
            let mut kin = Kinematics::default();
            kin.set_state(&l, s);
            momentum(&l, &kin).angular.to_array()
        };
        let h = 1e-5;
        let at = |sign: f64| {
            let mut s = s;
            let way: [f64; NV] =
                std::array::from_fn(|i| sign * h * s.velocity[i] + 0.5 * h * h * a[i]);
            s.posture.integrate(&way, 1.0);
            s.velocity = std::array::from_fn(|i| s.velocity[i] + sign * h * a[i]);
            spin(&s)
        };
        let (now, before, after) = (spin(&s), at(-1.0), at(1.0));
        for (k, (row, bias)) in rows.iter().zip(bias.to_array()).enumerate() {
            let times = |v: &[f64; NV]| row.iter().zip(v).map(|(r, v)| r * v).sum::<f64>();
            assert!((times(&s.velocity) - now[k]).abs() < 1e-11 * (1.0 + now[k].abs()));
            let (rate, seen) = (times(&a) + bias, (after[k] - before[k]) / (2.0 * h));
            assert!(
                (rate - seen).abs() < 1e-4 * (1.0 + rate.abs()),
                "{rate} against {seen}"
            );
        }
    }
}
