//! Goal: a standing figure joins a stream that begins in the middle of a walk on its own feet, in any phase of the
//! gait, and soon catches up with it. Method: the recorded walk, repeated, and the built-in walk to its stand, each
//! from many moments; the world is stepped by hand, so every run is the same.

use crate::access::leases::{Scene, Walker};
use crate::corpus;
use sinew_physics::body::{Body, Posture};
use sinew_physics::motion::Bvh;
use sinew_physics::motion::builtin::builtin;
use sinew_physics::motion::clip::PlanarTransform;
use sinew_physics::plan::cycle;
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::RetargetOptions;
use sinew_wire::pb;
use std::sync::Arc;

/// Number of moments from which a motion is streamed.
const PHASES: u32 = 12;

type Motion = Arc<dyn Fn(f64) -> Posture + Send + Sync>;

/// Result of a stream.
#[derive(Debug)]
struct Outcome {
    /// Time of the motion at which the stream began, s.
    from: f64,
    /// Time at which the figure first walked, and time at which it was close to the stream, s after the stream began.
    walks: f64,
    near: f64,
    /// Time of its fall, s.
    fell: Option<f64>,
    /// Lag at the end, s.
    behind: f64,
    /// Lowest speed in the last two seconds, and speed at the end, m/s.
    slowest: f64,
    last: f64,
}

/// A figure is close to a stream if it lags by less than this, a stride, s.
const NEAR: f64 = 1.25;

/// A standing figure follows a stream of a motion from its time `from` (s), for `long` seconds.
async fn follow(motion: Motion, from: f64, long: f64) -> Outcome {
    let scene = Scene::new(true).await;
    let alice = scene.someone("alice").await;
    let posture = |t: f64| motion(from + t);
    let mut walker = Walker {
        header: pb::DriveHeader {
            preparation_window_ms: Some(500.0),
            playout_delay_ms: Some(80.0),
            nominal_rate_hz: 120.0,
            ..scene.header("alice", &[])
        },
        posture: &posture,
        place: PlanarTransform {
            x: 7.0,
            y: -2.0,
            yaw: 2.1,
        },
        clock: 1000.0,
        sent: 0,
    };
    let mut out = Outcome {
        from,
        walks: f64::INFINITY,
        near: f64::INFINITY,
        fell: None,
        behind: 0.0,
        slowest: f64::INFINITY,
        last: 0.0,
    };
    for tick in (0..(long * 60.0) as i32).step_by(3) {
        let now = f64::from(tick) / 60.0;
        let said = walker.send(&scene, &alice, 0.0, now).await.unwrap();
        scene.step(3).await;
        let (fallen, speed) = scene.seen().await;
        out.fell = out.fell.or(fallen.then_some(now));
        out.behind = 1e-3 * said.figures[0].behind_ms;
        out.last = speed;
        if speed > 0.5 {
            out.walks = out.walks.min(now);
        }
        if out.walks.is_finite() && out.behind < NEAR {
            out.near = out.near.min(now);
        }
        if now > long - 2.0 {
            out.slowest = out.slowest.min(speed);
        }
    }
    out
}

/// Results of streams that begin at moments spread over `within` seconds from `from`.
async fn from_all_phases(motion: Motion, (from, within): (f64, f64), long: f64) -> Vec<Outcome> {
    let phases = (0..PHASES).map(|k| from + within * f64::from(k) / f64::from(PHASES));
    let runs: Vec<_> = phases
        .map(|from| tokio::spawn(follow(Arc::clone(&motion), from, long)))
        .collect();
    let mut out = Vec::new();
    for run in runs {
        out.push(run.await.unwrap());
    }
    for o in &out {
        println!("from {:.3} s on: {o:?}", o.from);
    }
    out
}

#[tokio::test(flavor = "multi_thread")]
async fn a_figure_that_stands_comes_into_a_walk_whose_beginning_it_has_missed() {
    let body = Body::adult_man();
    let bvh = Bvh::parse(&corpus::piece("walk-normal.vrm", 1.8, 5.4)).unwrap();
    let clip = prepare_recording(
        &bvh.recording().unwrap(),
        &body,
        &RetargetOptions::default(),
    )
    .unwrap()
    .clip;
    let walk = cycle(&body, &clip).unwrap();
    let round = walk.duration();
    let motion: Motion = Arc::new(move |t| walk.sample_looped(t).posture);
    for o in from_all_phases(motion, (0.0, round), 12.0).await {
        assert!(o.fell.is_none() && o.walks < 5.0 && o.near < 6.5, "{o:?}");
        assert!(o.behind < NEAR && o.slowest > 0.4, "{o:?}");
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn it_stands_with_that_walk_where_that_ends() {
    let body = Body::adult_man();
    let walk = builtin(&body, "walk").unwrap();
    let motion: Motion = Arc::new(move |t| walk.sample(t).posture);
    // Moments spread over a stride.
    for o in from_all_phases(motion, (2.4, 1.2), 14.0).await {
        assert!(o.fell.is_none() && o.walks < 5.0 && o.near < 6.5, "{o:?}");
        assert!(o.behind < 0.1 && o.last < 0.05, "{o:?}");
    }
}
