//! Whole ticks: `World::step` with 1, 10 and 100 figures that squat, on one thread, per controller. Throughput is
//! figure-ticks.
#![allow(missing_docs)] // criterion's macro writes undocumented functions

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use sinew_physics::body::Body;
use sinew_physics::figure::ControllerKind;
use sinew_physics::motion::builtin::builtin;
use sinew_physics::time::WorldTime;
use sinew_physics::world::{ClipPlayback, FigureSetup, MotionSource, World, WorldParams};
use std::sync::Arc;

/// A world of `count` endlessly squatting men, each at another phase of the motion.
fn world(controller: ControllerKind, count: usize) -> World {
    let body = Arc::new(Body::adult_man());
    let clip = Arc::new(builtin(&body, "squat").expect("a built-in motion"));
    let mut world = World::new(WorldParams::default()).expect("default parameters");
    for i in 0..count {
        let lead = clip.duration() * i as f64 / count as f64;
        let start = clip.sample_looped(lead);
        let key = world
            .add_figure(FigureSetup {
                name: format!("figure {i}"),
                ..FigureSetup::new(Arc::clone(&body), controller, start.state())
            })
            .expect("a valid figure");
        let figure = world.figure_mut(key).expect("just added");
        figure.set_drive(MotionSource::Clip(ClipPlayback {
            looped: true,
            ..ClipPlayback::new(Arc::clone(&clip), WorldTime(-lead))
        }));
    }
    world
}

fn world_step(c: &mut Criterion) {
    let mut group = c.benchmark_group("world_step");
    for (name, controller) in [
        ("paper", ControllerKind::Paper),
        ("modern", ControllerKind::Modern),
        ("motors", ControllerKind::Motors),
    ] {
        for count in [1, 10, 100] {
            group.throughput(Throughput::Elements(count as u64));
            let mut world = world(controller, count);
            group.bench_function(BenchmarkId::new(name, count), |b| b.iter(|| world.step()));
        }
    }
    group.finish();
}

criterion_group!(benches, world_step);
criterion_main!(benches);
