//! Cost of a checkpoint per figure: bytes, the time on the thread of the world (`capture`), the rest of writing it, and
//! making a world from it. One step of the same world, in the same run, serves for comparison.

use sinew_physics::body::Body;
use sinew_physics::figure::ControllerKind;
use sinew_physics::motion::builtin::builtin;
use sinew_physics::plan::StreamPlan;
use sinew_physics::plan::stream::RATE;
use sinew_physics::time::{StreamTime, WorldTime};
use sinew_physics::world::checkpoint::{Checkpoint, Definitions};
use sinew_physics::world::{
    ClipPlayback, FigureSetup, LivePlayback, MotionSource, World, WorldParams,
};
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

const FIGURES: usize = 100;
const ROUNDS: usize = 200;

/// A world of walking men, following a clip or a live stream, one second after their start.
fn world(live: bool) -> World {
    let body = Arc::new(Body::adult_man());
    let clip = Arc::new(builtin(&body, "walk").expect("a built-in motion"));
    let mut world = World::new(WorldParams::default()).expect("default parameters");
    for i in 0..FIGURES {
        let mut state = clip.sample(0.0).state();
        state.posture.root_position.y += 3.0 * i as f64;
        let setup = FigureSetup::new(Arc::clone(&body), ControllerKind::Modern, state);
        let key = world.add_figure(setup).expect("a valid figure");
        let drive = if live {
            let mut motion = StreamPlan::new(Arc::clone(&body), 0.5);
            for k in 0..120 {
                motion.push(&clip.sample(f64::from(k) / RATE).posture, None);
            }
            motion.advance(StreamTime(1.0 / RATE));
            MotionSource::Live(Box::new(LivePlayback {
                motion,
                offset: 0.0,
            }))
        } else {
            let mut play = ClipPlayback::new(Arc::clone(&clip), WorldTime(0.0));
            play.origin.y = 3.0 * i as f64;
            MotionSource::Clip(play)
        };
        world.figure_mut(key).expect("just added").set_drive(drive);
    }
    (0..60).for_each(|_| world.step());
    world
}

/// Median time of `work`, µs per figure.
fn median(mut work: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    1e6 * times[ROUNDS / 2] / FIGURES as f64
}

fn main() {
    println!("per figure      bytes  capture   encode  restore     step  capture/step");
    for (name, live) in [("clip", false), ("live", true)] {
        let mut world = world(live);
        let mut known = Definitions::default();
        let capture = world.capture();
        let whole = capture.checkpoint(&mut known).expect("it can be written");
        let (lean, definitions) = whole.without_definitions();
        let bytes = lean.to_bytes();
        let find = |h: &_| {
            let found = definitions.iter().find(|(d, _)| d == h);
            found.map(|d| d.1.clone())
        };
        let taken = median(|| {
            black_box(world.capture());
        });
        let written = median(|| {
            let whole = capture.checkpoint(&mut known).expect("it can be written");
            black_box(whole.without_definitions().0.to_bytes());
        });
        let restored = median(|| {
            let read = Checkpoint::from_bytes(&bytes).expect("it was written");
            black_box(read.restore(find).expect("it was written"));
        });
        let step = median(|| world.step());
        println!(
            "{name:10} {:10} {taken:8.1} {written:8.1} {restored:8.1} {step:8.1} {:13.2}",
            bytes.len() / FIGURES,
            taken / step
        );
    }
}
