//! One controller tick from a state in mid-squat: dynamics, supports, strength, desired points and the decision,
//! without stepping. `paper` does the work of the assembled Pinocchio + Eigen tick; `decide` is the controller alone.
#![allow(missing_docs)] // criterion's macro writes undocumented functions

use benches::{DT, Decision};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use sinew_physics::body::Body;
use sinew_physics::control::Modern;
use sinew_physics::motion::TargetPair;
use sinew_physics::motion::builtin::builtin;
use sinew_physics::paper::Paper;
use std::hint::black_box;

/// In the middle of a squat.
fn squatting() -> Decision {
    let body = Body::adult_man();
    let clip = builtin(&body, "squat").expect("a built-in motion");
    let (now, next) = (clip.sample(1.5), clip.sample(1.5 + DT));
    let mut bench = Decision::new(body);
    bench.look(&now.state(), &TargetPair { now, next });
    bench
}

fn control(c: &mut Criterion) {
    let mut group = c.benchmark_group("control");
    let mut bench = squatting();
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
