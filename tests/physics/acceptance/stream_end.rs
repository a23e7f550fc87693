//! Goal: a stream that ends in mid-stride is played to its end, and its figure then walks to a stand. A stream ends
//! when its driver repeats a posture in motion, or falls silent.

use crate::common::{Scene, figure, man, synthesised_cycle};
use sinew_physics::figure::ControllerKind;
use sinew_physics::plan::StreamPlan;
use sinew_physics::plan::stream::RATE;
use sinew_physics::time::{StreamTime, WorldTime};
use sinew_physics::world::{LivePlayback, MotionSource};
use std::sync::Arc;

/// How a driver ends its stream.
#[derive(Clone, Copy, Debug, PartialEq)]
enum End {
    Repeats,
    /// Some samples are guessed before the stream counts as silent.
    Silent,
}

/// Result of a stream.
struct Followed {
    /// Distance of the pelvis from that of the last sample when that was to be played, m.
    off: f64,
    /// Speed of the pelvis some seconds later, m/s.
    speed: f64,
}

/// Streams a walk of `count` samples through a window.
fn streamed(count: i64, window: f64, how: End) -> Followed {
    let body = man();
    let walk = synthesised_cycle(&body);
    let posture = |i: i64| walk.sample_looped(i as f64 / RATE).posture;
    let mut motion = StreamPlan::new(Arc::clone(&body), window);
    let mut fed = 0;
    while fed as f64 / RATE <= motion.window() {
        motion.push(&posture(fed), None);
        fed += 1;
    }
    motion.advance(StreamTime(1.0 / RATE));
    let drive = MotionSource::Live(Box::new(LivePlayback {
        motion,
        offset: 0.0,
    }));
    let state = drive.targets(WorldTime(0.0), 1.0 / RATE).now.state();
    let mut scene = Scene::of(figure(&body, ControllerKind::Modern, state));
    scene.figure_mut().set_drive(drive);
    let (end, last) = ((count - 1) as f64 / RATE, posture(count - 1).root_position);
    let mut off = f64::NAN;
    for _ in 0..scene.ticks(count as f64 / RATE + 4.0) {
        if let Some(live) = scene.figure_mut().stream_mut() {
            match how {
                _ if fed < count => live.motion.push(&posture(fed), None),
                End::Repeats => live.motion.push(&posture(count - 1), None),
                End::Silent if fed < count + 4 => live.motion.push_guess(&posture(fed), None),
                End::Silent => live.motion.fall_silent(),
            }
            fed += 1;
        }
        scene.world.step();
        let figure = scene.figure();
        if (scene.world.time() - figure.tracker().lag()).0 < end + 1e-9 {
            off = (figure.state().posture.root_position - last).norm();
        }
        assert!(!scene.figure().is_fallen(), "at {:?}", scene.world.time());
    }
    let v = &scene.figure().state().velocity;
    Followed {
        off,
        speed: v[3].hypot(v[4]),
    }
}

#[test]
fn a_stream_that_ends_in_mid_stride_is_played_to_its_end_and_left_by_steps_to_a_stand() {
    for window in [0.3, 1.0] {
        for how in [End::Repeats, End::Silent] {
            for phase in 0..4 {
                let count = 200 + 16 * phase;
                let Followed { off, speed } = streamed(count, window, how);
                println!("{how:?}, {window} s, {count} samples: {off:.3} m off, {speed:.3} m/s");
                // A walker that stops early is half a metre behind, and so is one that freezes.
                assert!(off < 0.15, "{how:?}, {window} s, {count} samples: {off} m");
                assert!(
                    speed < 0.1,
                    "{how:?}, {window} s, {count} samples: {speed} m/s"
                );
            }
        }
    }
}
