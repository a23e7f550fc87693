//! Kernels of `sim::dynamics`, each under the name of the function it times. Lane kernels (`_x8`) step eight figures
//! per call and report throughput per figure.
#![allow(missing_docs)] // criterion's macro writes undocumented functions

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use sinew_physics::body::{Body, Links, NV, State};
use sinew_physics::dynamics::lanes::{aba_x8, crba_x8, factor_solve_x8, rnea_x8};
use sinew_physics::dynamics::{
    AbaWorkspace, CompositeInertia, ExternalForces, Kinematics, MassMatrix, RneaWorkspace, Terms,
    aba, crba, factor, rnea, solve,
};
use sinew_physics::math::{F64x8, Lane};
use std::hint::black_box;

const GRAVITY: f64 = 9.81;
/// Number of states used in turn, so that the branch predictor cannot learn one of them.
const STATES: usize = 64;

/// Reproducible numbers in −1…1 (a 64-bit linear congruential generator).
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
    fn vector(&mut self, most: f64) -> [f64; NV] {
        std::array::from_fn(|_| self.next() * most)
    }
}

struct Samples {
    links: Links,
    states: Vec<State>,
    accelerations: Vec<[f64; NV]>,
}

impl Samples {
    fn new() -> Self {
        let mut noise = Noise(1);
        let states = (0..STATES)
            .map(|_| {
                let mut s = State::default();
                s.posture.integrate(&noise.vector(1.0), 1.0);
                s.velocity = noise.vector(1.0);
                s
            })
            .collect();
        let accelerations = (0..STATES).map(|_| noise.vector(10.0)).collect();
        Self {
            links: Links::new(&Body::adult_man()),
            states,
            accelerations,
        }
    }
}

struct LaneSamples {
    links: Links<F64x8>,
    states: Vec<State<F64x8>>,
    accelerations: Vec<[F64x8; NV]>,
}

impl LaneSamples {
    fn new(one: &Samples) -> Self {
        let groups = STATES / 8;
        let states = (0..groups)
            .map(|g| {
                let mut s = State::default();
                for k in 0..8 {
                    s.set_lane(k, &one.states[g * 8 + k]);
                }
                s
            })
            .collect();
        let accelerations = (0..groups)
            .map(|g| {
                std::array::from_fn(|i| {
                    F64x8(std::array::from_fn(|k| one.accelerations[g * 8 + k][i]))
                })
            })
            .collect();
        Self {
            links: Links::splat(&one.links),
            states,
            accelerations,
        }
    }
}

fn one_figure(c: &mut Criterion) {
    let samples = Samples::new();
    let Samples {
        links,
        states,
        accelerations,
    } = &samples;
    let mut group = c.benchmark_group("one");
    group.throughput(Throughput::Elements(1));
    let (mut kin, mut ws, mut tau) = (Kinematics::default(), RneaWorkspace::default(), [0.0; NV]);
    let mut i = 0;
    let mut next = || {
        i = (i + 1) % STATES;
        i
    };
    group.bench_function("kinematics", |b| {
        b.iter(|| kin.set_state(black_box(links), &states[next()]));
    });
    // Like Pinocchio's `rnea`, this starts from the state and includes the kinematics.
    group.bench_function("rnea", |b| {
        b.iter(|| {
            let n = next();
            kin.set_state(black_box(links), &states[n]);
            rnea(
                links,
                &kin,
                &states[n].velocity,
                &accelerations[n],
                ExternalForces::gravity(GRAVITY),
                &mut ws,
                &mut tau,
            );
            black_box(&tau);
        });
    });
    let (mut composite, mut mass) = (CompositeInertia::default(), MassMatrix::default());
    group.bench_function("crba", |b| {
        b.iter(|| {
            kin.set_posture(black_box(links), &states[next()].posture);
            crba(links, &kin, &mut composite, &mut mass);
            black_box(&mass);
        });
    });
    let mut factored = mass.clone();
    group.bench_function("factor", |b| {
        b.iter(|| {
            factored.clone_from(black_box(&mass));
            factor(&mut factored);
        });
    });
    group.bench_function("solve", |b| {
        b.iter(|| {
            let mut x = accelerations[next()];
            solve(black_box(&factored), &mut x);
            black_box(&x);
        });
    });
    let (mut aba_ws, mut out) = (AbaWorkspace::default(), [0.0; NV]);
    group.bench_function("aba", |b| {
        b.iter(|| {
            let n = next();
            kin.set_state(black_box(links), &states[n]);
            aba(
                links,
                &kin,
                &states[n].velocity,
                &accelerations[n],
                ExternalForces::gravity(GRAVITY),
                &mut aba_ws,
                &mut out,
            );
            black_box(&out);
        });
    });
    let mut terms = Terms::default();
    group.bench_function("terms_compute", |b| {
        b.iter(|| terms.compute(black_box(links), &states[next()], &[], GRAVITY));
    });
    group.finish();
}

fn eight_figures(c: &mut Criterion) {
    let LaneSamples {
        links,
        states,
        accelerations,
    } = LaneSamples::new(&Samples::new());
    let gravity = F64x8::splat(GRAVITY);
    let mut group = c.benchmark_group("eight");
    group.throughput(Throughput::Elements(8));
    let mut kin = Kinematics::default();
    let (mut ws, mut tau) = (RneaWorkspace::default(), [F64x8::zero(); NV]);
    let mut i = 0;
    let mut next = || {
        i = (i + 1) % (STATES / 8);
        i
    };
    group.bench_function("rnea_x8", |b| {
        b.iter(|| {
            let n = next();
            rnea_x8(
                black_box(&links),
                &states[n],
                &accelerations[n],
                ExternalForces::gravity(gravity),
                &mut kin,
                &mut ws,
                &mut tau,
            );
            black_box(&tau);
        });
    });
    let (mut composite, mut mass) = (CompositeInertia::default(), MassMatrix::default());
    group.bench_function("crba_x8", |b| {
        b.iter(|| crba_x8(black_box(&links), &kin, &mut composite, &mut mass));
    });
    let mut factored = mass.clone();
    group.bench_function("factor_solve_x8", |b| {
        b.iter(|| {
            factored.clone_from(black_box(&mass));
            let mut x = accelerations[next()];
            factor_solve_x8(&mut factored, &mut x);
            black_box(&x);
        });
    });
    let (mut aba_ws, mut out) = (AbaWorkspace::default(), [F64x8::zero(); NV]);
    group.bench_function("aba_x8", |b| {
        b.iter(|| {
            let n = next();
            aba_x8(
                black_box(&links),
                &kin,
                &states[n].velocity,
                &accelerations[n],
                ExternalForces::gravity(gravity),
                &mut aba_ws,
                &mut out,
            );
            black_box(&out);
        });
    });
    group.finish();
}

criterion_group!(benches, one_figure, eight_figures);
criterion_main!(benches);
