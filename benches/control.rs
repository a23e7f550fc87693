//! One controller tick from a state in mid-squat: dynamics, supports, strength, desired points and the decision, without stepping.
//! `paper` is what the assembled Pinocchio + Eigen tick does; `decide` is the controller alone.
#![allow(missing_docs)] // criterion's macro writes undocumented functions

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use sinew::sim::body::angles::anatomical_angles;
use sinew::sim::body::topology::DOF_COUNT;
use sinew::sim::body::{Body, Links, State};
use sinew::sim::control::{ControlInput, Controller, Modern, Paper};
use sinew::sim::dynamics::Terms;
use sinew::sim::figure::ControlParams;
use sinew::sim::figure::tasks::TaskWorkspace;
use sinew::sim::math::Vec3;
use sinew::sim::motion::TargetPair;
use sinew::sim::motion::builtin::builtin;
use sinew::sim::strength::{MuscleScale, Strength};
use sinew::sim::support::Support;
use std::hint::black_box;

const DT: f64 = 1.0 / 60.0;
const GRAVITY: f64 = 9.81;

/// Everything between a state and a command.
struct Bench {
    body: Body,
    links: Links,
    strength: Strength,
    scale: MuscleScale,
    params: ControlParams,
    state: State,
    target: TargetPair,
    terms: Terms,
    support: Support,
    tasks: TaskWorkspace,
    lower: [f64; DOF_COUNT],
    upper: [f64; DOF_COUNT],
}

impl Bench {
    fn new() -> Self {
        let body = Body::adult_man();
        let clip = builtin(&body, "squat").expect("a built-in motion");
        let now = clip.sample(1.5);
        let next = clip.sample(1.5 + DT);
        let state = now.state();
        Self {
            links: Links::new(&body),
            strength: Strength::for_body(&body),
            scale: MuscleScale::default(),
            params: ControlParams::default(),
            state,
            target: TargetPair { now, next },
            terms: Terms::default(),
            support: Support::default(),
            tasks: TaskWorkspace::default(),
            lower: [0.0; DOF_COUNT],
            upper: [0.0; DOF_COUNT],
            body,
        }
    }

    fn prepare(&mut self) {
        self.terms.compute(&self.links, &self.state, &[], GRAVITY);
        self.support
            .update(&self.terms, &self.body, Vec3::zero(), GRAVITY);
        let angles = anatomical_angles(&self.state.posture);
        let rates: [f64; DOF_COUNT] = std::array::from_fn(|j| self.state.velocity[6 + j]);
        self.strength.range(
            &angles,
            &rates,
            &self.scale,
            &mut self.lower,
            &mut self.upper,
        );
    }

    fn decide(&mut self, controller: &mut impl Controller) -> f64 {
        let tasks = self.tasks.points(&self.body, &self.links, &self.target);
        let command = controller.control(&ControlInput {
            terms: &self.terms,
            body: &self.body,
            support: &self.support,
            target: &self.target,
            com: &tasks.com,
            effectors: &tasks.hands,
            goals: &[],
            feet: &tasks.feet,
            balance: None,
            lower: &self.lower,
            upper: &self.upper,
            params: &self.params,
            gravity: GRAVITY,
            dt: DT,
            assist: [0.0; 2],
            kinematic: false,
        });
        command.torque[0]
    }
}

fn control(c: &mut Criterion) {
    let mut group = c.benchmark_group("control");
    let mut bench = Bench::new();
    group.bench_function("terms_support_strength", |b| b.iter(|| bench.prepare()));
    let mut paper = Paper::default();
    group.bench_function(BenchmarkId::new("decide", "paper"), |b| {
        b.iter(|| black_box(bench.decide(&mut paper)))
    });
    group.bench_function(BenchmarkId::new("tick", "paper"), |b| {
        b.iter(|| {
            bench.prepare();
            black_box(bench.decide(&mut paper))
        });
    });
    let mut modern = Modern::new(0.9);
    group.bench_function(BenchmarkId::new("decide", "modern"), |b| {
        b.iter(|| black_box(bench.decide(&mut modern)))
    });
    group.finish();
}

criterion_group!(benches, control);
criterion_main!(benches);
