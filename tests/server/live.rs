//! Walking streams: a window prepares them, whatever the network does. World time is stepped, so every run is the same.

use crate::corpus;
use crate::support::{FALLEN, FROZEN, TestServer, header, refusal};
use sinew_client::Network;
use sinew_physics::body::{Body, Posture};
use sinew_physics::motion::{Bvh, Clip};
use sinew_physics::plan::cycle;
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::RetargetOptions;
use sinew_server::engine;
use sinew_wire::convert::motion::figure_motion;
use sinew_wire::pb;
use std::time::Duration;
use tonic::Code;

fn walk(body: &Body) -> Clip {
    let bvh = Bvh::parse(&corpus::piece("walk-normal.vrm", 1.8, 5.4)).unwrap();
    let clip = prepare_recording(&bvh.recording().unwrap(), body, &RetargetOptions::default())
        .unwrap()
        .clip;
    cycle(body, &clip).unwrap()
}

/// Header of a driver of figure `a` that sends 120 frames per second, with a window of `window_ms`.
fn windowed(world: &str, window_ms: f64) -> pb::DriveHeader {
    pb::DriveHeader {
        playout_delay_ms: None,
        nominal_rate_hz: 120.0,
        reset: true,
        grace_ms: Some(60_000.0),
        preparation_window_ms: Some(window_ms),
        ..header(world, "a", "me")
    }
}

struct Streamed {
    /// World time at which it fell, s.
    fell: Option<f64>,
    feedback: pb::FigureFeedback,
    /// Time from capture to use: mean and largest, s.
    delay: (f64, f64),
    /// Farthest from the start, m.
    far: f64,
    /// Speed of the pelvis at the end, m/s.
    speed: f64,
}

/// Streams `posture` for `seconds`, with 120 frames per second, through a network, followed by `silence` seconds
/// without frames.
async fn stream(
    id: &str,
    posture: impl Fn(f64) -> Option<Posture>,
    (seconds, silence): (f64, f64),
    network: &mut Network,
    window_ms: f64,
) -> Streamed {
    let server = TestServer::start().await;
    let world = server.paused_world(id).await;
    server.figure(&world, "a").await;
    let header = windowed(&world, window_ms);
    let mut client = server.client.motions();
    let mut out = Streamed {
        fell: None,
        feedback: pb::FigureFeedback::default(),
        delay: (0.0, 0.0),
        far: 0.0,
        speed: 0.0,
    };
    let (mut sequence, mut count) = (0i64, 0);
    let mut waiting: Option<(f64, pb::MotionFrame)> = None;
    let mut refused = 0;
    let step = 3;
    for tick in (0..((seconds + silence) * 60.0) as i64).step_by(step) {
        let now = tick as f64 / 60.0;
        let mut frames = Vec::new();
        loop {
            if let Some((at, frame)) = waiting.take() {
                if at > now {
                    waiting = Some((at, frame));
                    break;
                }
                frames.push(frame);
            }
            let t = sequence as f64 / 120.0;
            if t > now || t > seconds {
                break;
            }
            let arrival = network.arrival(t);
            if let (Some(at), Some(p)) = (arrival, posture(t)) {
                let frame = pb::MotionFrame {
                    sequence,
                    source_time_ns: (t * 1e9) as i64,
                    figures: vec![figure_motion("a", &p, &[0.0; 45], None)],
                };
                let mut frame = frame;
                frame.figures[0].velocity.clear();
                waiting = Some((at, frame));
            }
            sequence += 1;
        }
        let request = pb::PushMotionRequest {
            header: Some(header.clone()),
            batch: Some(pb::MotionBatch { frames }),
        };
        let response = loop {
            match client.push_motion(request.clone()).await {
                Ok(response) => break response.into_inner(),
                // The test runs faster than real time, the allowance of batches does not.
                Err(e) if e.code() == Code::ResourceExhausted => {
                    refused += 1;
                    tokio::time::sleep(Duration::from_millis(20)).await;
                }
                Err(e) => panic!("{e:?}"),
            }
        };
        let feedback = response.feedback.unwrap();
        assert_eq!(feedback.refused_batch_count, refused);
        out.feedback = feedback.figures[0].clone();
        if out.feedback.applied_sequence > 0 && now < seconds {
            let delay = now - out.feedback.applied_source_time_ns as f64 * 1e-9;
            out.delay.0 += delay;
            out.delay.1 = out.delay.1.max(delay);
            count += 1;
        }
        server.step(&world, step as i32).await;
        let frame = server
            .frame(&world, &["status", "root_pose", "velocity"])
            .await;
        let f = &frame.figures[0];
        let flags = f.status.as_ref().unwrap().flags;
        assert_eq!(flags & FROZEN, 0);
        let v = sinew_wire::frame::values(f.velocity.as_ref().unwrap());
        let p = sinew_wire::frame::values(f.root_pose.as_ref().unwrap());
        out.speed = v[3].hypot(v[4]);
        out.far = out.far.max(p[0].hypot(p[1]));
        if flags & FALLEN != 0 && out.fell.is_none() {
            out.fell = Some(now);
            break;
        }
    }
    out.delay.0 /= f64::from(count.max(1));
    server.stop().await;
    out
}

#[tokio::test(flavor = "multi_thread")]
async fn a_walk_comes_through_jitter_and_loss() {
    let body = Body::adult_man();
    let walk = walk(&body);
    let seconds: f64 = std::env::var("SINEW_LIVE_SECONDS").map_or(60.0, |s| s.parse().unwrap());
    let windows = std::env::var("SINEW_LIVE_WINDOW")
        .map_or(vec![300.0, 500.0, 1000.0], |w| vec![w.parse().unwrap()]);
    for window in windows {
        let mut network = Network::new(0.05, 0.02, 7);
        let s = stream(
            "w",
            |t| Some(walk.sample_looped(t).posture),
            (seconds, 3.0),
            &mut network,
            window,
        )
        .await;
        println!(
            "window {window} ms: fell {:?}, capture to use {:.0} ms mean, {:.0} ms at most, {} interpolated, {} \
             extrapolated, {} late, {:.1} m, {:.2} m/s in the end",
            s.fell,
            1e3 * s.delay.0,
            1e3 * s.delay.1,
            s.feedback.interpolated_count + s.feedback.present_count,
            s.feedback.extrapolated_count,
            s.feedback.late_count,
            s.far,
            s.speed
        );
        // `tests/recordings/live.rs` tests the motion after the stream, at every phase of the gait.
        assert!(
            s.fell.is_none_or(|t| t > seconds),
            "window {window} ms: fell at {:?} s",
            s.fell
        );
        assert!(s.far > 0.9 * seconds, "{} m", s.far);
        assert_eq!(s.feedback.preparation_window_ms, window);
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_window_that_is_too_short_or_long_is_refused() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    for window in [1.0, 299.0, 1001.0, f64::NAN, -5.0] {
        let e = server
            .client
            .drive(pb::DriveHeader {
                preparation_window_ms: Some(window),
                ..header(&world, "a", "me")
            })
            .await
            .unwrap_err();
        assert_eq!(
            refusal(&e),
            (
                Code::InvalidArgument,
                "INVALID_FIELD".into(),
                "header.preparation_window_ms".into()
            )
        );
    }
    server.stop().await;
}

/// Frame `i` of a stream of 120 frames per second, without velocities.
fn frame_of(i: i64, posture: &Posture) -> pb::MotionFrame {
    let mut motion = figure_motion("a", posture, &[0.0; 45], None);
    motion.velocity.clear();
    pb::MotionFrame {
        sequence: i,
        source_time_ns: i * 1_000_000_000 / 120,
        figures: vec![motion],
    }
}

/// Pushes frames; waits while the allowance of batches is used up: tests run faster than real time.
async fn push_frames(
    server: &TestServer,
    header: &pb::DriveHeader,
    frames: Vec<pb::MotionFrame>,
) -> Option<pb::DriveFeedback> {
    let request = pb::PushMotionRequest {
        header: Some(header.clone()),
        batch: Some(pb::MotionBatch { frames }),
    };
    loop {
        match server.client.motions().push_motion(request.clone()).await {
            Ok(pushed) => return pushed.into_inner().feedback,
            Err(e) if e.code() == Code::ResourceExhausted => {
                tokio::time::sleep(Duration::from_millis(20)).await;
            }
            Err(e) => panic!("{e:?}"),
        }
    }
}

/// Speed of the pelvis of the only figure, m/s, which must not have fallen.
async fn upright_speed(server: &TestServer, world: &str) -> f64 {
    let frame = server.frame(world, &["status", "velocity"]).await;
    let f = &frame.figures[0];
    let flags = f.status.as_ref().unwrap().flags;
    assert_eq!(flags & (FALLEN | FROZEN), 0, "after {} s", frame.time_s);
    let v = sinew_wire::frame::values(f.velocity.as_ref().unwrap());
    v[3].hypot(v[4])
}

/// A driver is restarted while its figure walks, and commands it to stand: the figure finishes its step and stands.
#[tokio::test(flavor = "multi_thread")]
async fn a_walk_ends_in_a_stand_if_its_driver_starts_again() {
    let (body, seconds) = (Body::adult_man(), 4);
    let walk = walk(&body);
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let header = windowed(&world, 500.0);
    let restart = seconds * 120; // frames after which sequence and time begin at 0 again
    let last = walk.sample_looped(seconds as f64).posture;
    let stand = engine::standing(&body, engine::place_of(&last));
    let (mut feedback, mut speed) = (None, Vec::new());
    for push in 0..200i64 {
        // 50 ms each, in a world that is stepped by the same time.
        let frames = (push * 6..(push + 1) * 6)
            .map(|i| match i - restart {
                past @ 0.. => frame_of(past, &stand),
                _ => frame_of(i, &walk.sample_looped(i as f64 / 120.0).posture),
            })
            .collect();
        feedback = push_frames(&server, &header, frames).await;
        server.step(&world, 3).await;
        speed.push(upright_speed(&server, &world).await);
    }
    let f = &feedback.unwrap().figures[0];
    assert_eq!(f.resync_count, 1, "{f:?}");
    assert!(f.applied_sequence > 600, "it is followed again: {f:?}");
    assert!(
        speed[40..80].iter().all(|v| *v > 0.5),
        "it walked: {speed:?}"
    );
    assert!(
        speed[160..].iter().all(|v| *v < 0.1),
        "it stands: {speed:?}"
    );
    server.stop().await;
}

/// A stream leads its figure into a wall. The figure comes to a stand in front of it and, once the wall is removed,
/// rejoins the stream, which has kept walking.
#[tokio::test(flavor = "multi_thread")]
async fn who_is_led_into_a_wall_stands_and_walks_on_when_it_is_gone() {
    let body = Body::adult_man();
    let walk = walk(&body);
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let header = windowed(&world, 500.0);
    let point = |t: f64| walk.sample_looped(t).posture.root_position;
    let (from, way) = (point(0.0), point(60.0) - point(0.0));
    let turned = 0.5 * way.y.atan2(way.x);
    let at = from + way * (2.5 / way.norm());
    let wall = pb::Obstacle {
        shape: Some(pb::obstacle::Shape::Box(pb::BoxShape {
            half_m: Some(pb::Vector3 {
                x: 0.1,
                y: 4.0,
                z: 1.5,
            }),
        })),
        pose: Some(pb::Pose {
            position_m: Some(pb::Vector3 {
                x: at.x,
                y: at.y,
                z: 1.5,
            }),
            rotation: Some(pb::Quaternion {
                w: turned.cos(),
                z: turned.sin(),
                ..Default::default()
            }),
        }),
        ..Default::default()
    };
    server.add_obstacle(&world, "wall", wall).await.unwrap();
    let watch = pb::WatchEventsRequest {
        world: world.clone(),
        types: vec![pb::EventType::WayBarred.into()],
        ..Default::default()
    };
    let events = server.client.states().watch_events(watch).await;
    let mut events = events.unwrap().into_inner();
    let (mut far, mut speed) = (Vec::new(), Vec::new());
    for push in 0..280i64 {
        let frames = (push * 6..(push + 1) * 6)
            .map(|i| frame_of(i, &walk.sample_looped(i as f64 / 120.0).posture))
            .collect();
        push_frames(&server, &header, frames).await;
        if push == 60 {
            let name = format!("{world}/obstacles/wall");
            let request = pb::DeleteObstacleRequest {
                name,
                ..Default::default()
            };
            let mut obstacles = server.client.obstacles();
            obstacles.delete_obstacle(request).await.unwrap();
        }
        server.step(&world, 3).await;
        let frame = server
            .frame(&world, &["status", "root_pose", "velocity"])
            .await;
        let f = &frame.figures[0];
        let flags = f.status.as_ref().unwrap().flags;
        let v = sinew_wire::frame::values(f.velocity.as_ref().unwrap());
        let p = sinew_wire::frame::values(f.root_pose.as_ref().unwrap());
        assert_eq!(flags & (FALLEN | FROZEN), 0, "after {} s", frame.time_s);
        speed.push(v[3].hypot(v[4]));
        far.push((p[0] - from.x).hypot(p[1] - from.y));
    }
    let kind = loop {
        let told = events.message().await.unwrap().unwrap();
        if let Some(event) = told.events.first() {
            break event.r#type();
        }
    };
    assert_eq!(kind, pb::EventType::WayBarred);
    assert!(
        speed[100..140].iter().all(|v| *v < 0.3),
        "it stands: {speed:.2?}"
    );
    assert!(far[260] > far[140] + 0.5, "it walks on: {far:.2?}");
    server.stop().await;
}

/// A stream that begins in motion for a figure that stands.
struct Entered {
    /// Largest speed of the figure, and its speed in the end, m/s.
    fastest: f64,
    last: f64,
    /// Why it was not played, if its driver was told.
    told: Vec<String>,
}

/// Streams the middle of a walk for `seconds` to a figure that stands, then nothing.
async fn walk_from_its_middle(seconds: f64) -> Entered {
    let body = Body::adult_man();
    let walk = walk(&body);
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let header = pb::DriveHeader {
        reset: false,
        ..windowed(&world, 500.0)
    };
    let watch = pb::WatchEventsRequest {
        world: world.clone(),
        types: vec![
            pb::EventType::DriveResynced.into(),
            pb::EventType::DriveBegan.into(),
        ],
        ..Default::default()
    };
    let mut events = (server.client.states().watch_events(watch).await)
        .unwrap()
        .into_inner();
    let mut out = Entered {
        fastest: 0.0,
        last: 0.0,
        told: Vec::new(),
    };
    let count = (seconds * 120.0) as i64;
    for push in 0..160i64 {
        let frames: Vec<_> = (push * 6..((push + 1) * 6).min(count))
            .map(|i| frame_of(i, &walk.sample_looped(i as f64 / 120.0).posture))
            .collect();
        if !frames.is_empty() {
            push_frames(&server, &header, frames).await;
        }
        server.step(&world, 3).await;
        out.last = upright_speed(&server, &world).await;
        out.fastest = out.fastest.max(out.last);
    }
    while let Ok(Ok(Some(told))) =
        tokio::time::timeout(Duration::from_millis(200), events.message()).await
    {
        let resynced = (told.events.iter()).filter(|e| e.r#type() == pb::EventType::DriveResynced);
        out.told.extend(resynced.map(|e| e.detail.clone()));
    }
    server.stop().await;
    out
}

/// A stream that begins in motion and has ended before the steps that lead into it are planned is played all the same;
/// its figure then walks to a stand. One that is too short for steps is not played, and its driver is told why.
#[tokio::test(flavor = "multi_thread")]
async fn a_short_stream_that_begins_in_motion_is_played_or_its_driver_is_told_why_not() {
    let played = walk_from_its_middle(1.3).await;
    assert!(played.told.is_empty(), "{:?}", played.told);
    assert!(
        played.fastest > 0.5 && played.last < 0.1,
        "{} m/s",
        played.fastest
    );
    let refused = walk_from_its_middle(0.4).await;
    assert_eq!(refused.told.len(), 1, "{:?}", refused.told);
    assert!(
        refused.told[0].contains("before steps"),
        "{:?}",
        refused.told
    );
    assert!(refused.fastest < 0.3, "{} m/s", refused.fastest);
}
