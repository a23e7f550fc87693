//! Duration of slow ticks: medians and percentiles of the modern controller's decision and of the whole tick (two
//! substeps, with stretched tissue), for a figure that walks, that is pushed while it walks and while it stands, and
//! that stands. A mean or a single state would hide the ticks for which a live world waits. One thread; the decision is
//! made by a separate controller that sees every state and target of the run.
#![allow(missing_docs)]

use benches::Decision;
use sinew_physics::body::Body;
use sinew_physics::body::topology::CHEST;
use sinew_physics::control::Modern;
use sinew_physics::figure::{ControllerKind, Perturbation};
use sinew_physics::math::Vec3;
use sinew_physics::motion::builtin::builtin;
use sinew_physics::time::WorldTime;
use sinew_physics::world::{ClipPlayback, FigureSetup, MotionSource, World, WorldParams};
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

/// Length of one run, s, and number of runs. The fastest run counts at each tick, so that other work on the machine
/// does not matter.
const SECONDS: f64 = 20.0;
const RUNS: usize = 5;

/// An endless motion, and the interval (s) and impulse (N·s) of pushes at the chest, each from another side.
struct Scene {
    name: &'static str,
    clip: &'static str,
    push: Option<(f64, f64)>,
}

/// Microseconds of the decision and of the whole tick, by tick; up to a fall.
fn run(scene: &Scene) -> [Vec<f64>; 2] {
    let body = Arc::new(Body::adult_man());
    let clip = Arc::new(builtin(&body, scene.clip).expect("a built-in motion"));
    let mut world = World::new(WorldParams::default()).expect("default parameters");
    let state = clip.sample(0.0).state();
    let setup = FigureSetup::new(Arc::clone(&body), ControllerKind::Modern, state);
    let key = world.add_figure(setup).expect("a valid figure");
    let figure = world.figure_mut(key).expect("just added");
    figure.set_drive(MotionSource::Clip(ClipPlayback {
        looped: true,
        ..ClipPlayback::new(Arc::clone(&clip), WorldTime(0.0))
    }));
    if let Some((every, impulse)) = scene.push {
        for i in 0..(SECONDS / every) as u32 - 1 {
            let (from, angle) = (f64::from(i + 1) * every, 2.4 * f64::from(i));
            let what = Perturbation::Force {
                segment: CHEST,
                point: Vec3::zero(),
                force: Vec3 {
                    x: angle.cos(),
                    y: angle.sin(),
                    z: 0.0,
                } * (impulse / 0.1),
                from,
                to: from + 0.1,
            };
            world.perturb(key, what).expect("a valid push");
        }
    }
    let mut decision = Decision::new(Body::adult_man());
    let mut controller = Modern::new(world.params().friction);
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..(SECONDS * world.params().rate_hz) as usize {
        let before = *world.figure(key).expect("there").state();
        let start = Instant::now();
        world.step();
        let whole = start.elapsed();
        let figure = world.figure(key).expect("there");
        if figure.is_fallen() {
            break;
        }
        decision.look(&before, figure.target());
        let start = Instant::now();
        black_box(decision.decide(&mut controller));
        times[0].push(1e6 * start.elapsed().as_secs_f64());
        times[1].push(1e6 * whole.as_secs_f64());
    }
    times
}

fn main() {
    let scene = |name, clip, push| Scene { name, clip, push };
    let scenes = [
        scene("standing", "idle", None),
        scene("squatting", "squat", None),
        scene("walking", "walk", None),
        scene("walking, 10 N·s every 0.7 s", "walk", Some((0.7, 10.0))),
        scene("standing, 25 N·s every 2 s", "idle", Some((2.0, 25.0))),
    ];
    println!(
        "{:30} {:>8} {:>8} {:>8} {:>8}   {:>8} {:>8} {:>8} {:>8}",
        "µs", "decide", "90 %", "99 %", "most", "tick", "90 %", "99 %", "most"
    );
    for s in &scenes {
        let mut best = run(s);
        for _ in 1..RUNS {
            for (best, again) in best.iter_mut().zip(run(s)) {
                for (b, a) in best.iter_mut().zip(again) {
                    *b = b.min(a);
                }
            }
        }
        print!("{:30}", s.name);
        for times in &mut best {
            times.sort_by(f64::total_cmp);
            let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize];
            print!(
                " {:8.1} {:8.1} {:8.1} {:8.1}  ",
                at(0.5),
                at(0.9),
                at(0.99),
                at(1.0)
            );
        }
        println!(" {} ticks", best[0].len());
    }
}
