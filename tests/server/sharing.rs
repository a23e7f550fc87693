//! Effects of one client on others: reads and pushes do not wait for a busy world, floods are refused with a retry
//! time, long work is shared, and restarted clocks are followed.

use crate::support::{TestServer, arm_frame, header, refusal, view};
use sinew_client::Client;
use sinew_server::tick::command::CommandOrigin;
use sinew_wire::pb;
use std::sync::mpsc::{SyncSender, sync_channel};
use std::time::Duration;
use tonic::Code;
use tonic_types::StatusExt;

/// Keeps the thread of a world busy until the sender is dropped.
fn busy(server: &TestServer, world: &str) -> SyncSender<()> {
    let (end, ended) = sync_channel::<()>(1);
    let (begin, begun) = sync_channel(1);
    let origin = CommandOrigin {
        client: "test".into(),
        sequence: 0,
    };
    let handle = server.app.worlds.get(world).unwrap();
    handle
        .send(origin, move |_| {
            begin.send(()).unwrap();
            let _ = ended.recv();
        })
        .unwrap();
    begun.recv().unwrap();
    end
}

#[tokio::test(flavor = "multi_thread")]
async fn reads_and_pushes_do_not_wait_for_the_world() {
    let server = TestServer::start().await;
    let world = server.world("w", false, pb::World::default()).await;
    let figure = server.figure(&world, "a").await.name;
    let push = |n: i64| pb::PushMotionRequest {
        header: Some(header(&world, "a", "me")),
        batch: Some(pb::MotionBatch {
            frames: vec![arm_frame("a", n)],
        }),
    };
    let mut motions = server.client.motions();
    motions.push_motion(push(0)).await.unwrap();
    let end = busy(&server, "w");
    let mut worlds = server.client.worlds();
    let name = world.clone();
    let got = worlds.get_world(pb::GetWorldRequest { name }).await;
    assert_eq!(got.unwrap().into_inner().world.unwrap().figure_count, 1);
    let listed = worlds.list_worlds(pb::ListWorldsRequest::default()).await;
    assert_eq!(listed.unwrap().into_inner().worlds.len(), 1);
    assert_eq!(server.look(&figure).await.status.unwrap().driver_id, "me");
    let parent = world.clone();
    let list = pb::ListFiguresRequest {
        parent: parent.clone(),
        ..Default::default()
    };
    let listed = server.client.figures().list_figures(list).await;
    assert_eq!(listed.unwrap().into_inner().figures.len(), 1);
    let list = pb::ListObstaclesRequest {
        parent,
        ..Default::default()
    };
    server
        .client
        .obstacles()
        .list_obstacles(list)
        .await
        .unwrap();
    let tick = server.frame(&world, &["status"]).await.tick;
    let frame = pb::GetWorldFrameRequest {
        world: world.clone(),
        tick: Some(tick),
        view: Some(view(&["status"])),
    };
    let frame = server.client.states().get_world_frame(frame).await;
    assert_eq!(frame.unwrap().into_inner().frame.unwrap().tick, tick);
    for n in 1..20 {
        let pushed = motions.push_motion(push(n)).await.unwrap().into_inner();
        assert_eq!(pushed.feedback.unwrap().received_sequence, n);
    }
    drop(end);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_flood_of_frames_is_refused_and_may_come_again_when_it_is_told() {
    let server = TestServer::start().await;
    let world = server.world("w", false, pb::World::default()).await;
    server.figure(&world, "a").await;
    let mut motions = server.client.motions();
    let mut sequence = 0;
    let mut taken = 0;
    let refused = loop {
        let frames = (sequence..sequence + 64)
            .map(|i| arm_frame("a", i))
            .collect();
        sequence += 64;
        let request = pb::PushMotionRequest {
            header: Some(header(&world, "a", "me")),
            batch: Some(pb::MotionBatch { frames }),
        };
        match motions.push_motion(request).await {
            Ok(_) => taken += 64,
            Err(e) => break e,
        }
        assert!(taken < 100_000, "nothing is refused");
    };
    let (code, reason, _) = refusal(&refused);
    assert_eq!(
        (code, reason.as_str()),
        (Code::ResourceExhausted, "LIMIT_REACHED")
    );
    let details = refused.get_error_details();
    let retry = details.retry_info().unwrap().retry_delay.unwrap();
    assert!(retry > Duration::ZERO && retry < Duration::from_secs(1));
    tokio::time::sleep(retry + Duration::from_millis(60)).await;
    let request = pb::PushMotionRequest {
        header: Some(header(&world, "a", "me")),
        batch: Some(pb::MotionBatch {
            frames: vec![arm_frame("a", sequence)],
        }),
    };
    let feedback = motions.push_motion(request).await.unwrap().into_inner();
    assert_eq!(feedback.feedback.unwrap().refused_batch_count, 1);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_driver_whose_clock_starts_again_is_followed_and_told() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let watch = pb::WatchEventsRequest {
        world: world.clone(),
        figure_ids: vec![],
        types: vec![pb::EventType::DriveResynced.into()],
    };
    let mut events = server.client.states().watch_events(watch).await;
    let events = events.as_mut().unwrap().get_mut();
    events.message().await.unwrap().unwrap();
    let mut motions = server.client.motions();
    let mut feedback = None;
    for n in 0..120 {
        // After a second the driver starts again: sequence and time from 0.
        let request = pb::PushMotionRequest {
            header: Some(header(&world, "a", "me")),
            batch: Some(pb::MotionBatch {
                frames: vec![arm_frame("a", n % 60)],
            }),
        };
        feedback = motions
            .push_motion(request)
            .await
            .unwrap()
            .into_inner()
            .feedback;
        server.step(&world, 1).await;
    }
    let feedback = feedback.unwrap();
    let f = &feedback.figures[0];
    assert_eq!(f.resync_count, 1);
    assert!(f.stale_count < 30, "{f:?}");
    assert!((50..60).contains(&f.applied_sequence), "{f:?}");
    assert_eq!(feedback.received_sequence, 59);
    let told = events.message().await.unwrap().unwrap();
    assert_eq!(told.events[0].r#type(), pb::EventType::DriveResynced);
    assert!(told.events[0].detail.starts_with("me: "));
    server.stop().await;
}

fn simulation(duration_s: f64, rate_hz: f64, substep_count: i32) -> pb::SimulateClipRequest {
    pb::SimulateClipRequest {
        source: Some(pb::simulate_clip_request::Source::Clip("clips/wave".into())),
        duration_s,
        rate_hz,
        substep_count,
        r#loop: true,
        ..Default::default()
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn long_simulations_of_one_client_block_nobody() {
    let server = TestServer::start().await;
    let mut long = Vec::new();
    for _ in 0..4 {
        let mut greedy = server.client.simulations();
        long.push(tokio::spawn(async move {
            greedy.simulate_clip(simulation(120.0, 1000.0, 16)).await
        }));
    }
    let running = || async {
        let mut stats = server.client.server();
        let stats = stats.get_server_stats(pb::GetServerStatsRequest::default());
        stats.await.unwrap().into_inner().simulation_count
    };
    while running().await < 2 {
        tokio::task::yield_now().await;
    }
    let other = Client::connect(&server.address.to_string()).await.unwrap();
    // A simulation of another connection takes its turn, and files are converted all the time.
    let mut simulations = other.simulations();
    simulations
        .simulate_clip(simulation(0.5, 60.0, 2))
        .await
        .unwrap();
    let frames = (0..30)
        .map(|i| pb::FigureMotion {
            root: Some(pb::Pose::default()),
            ..arm_frame("", i).figures.remove(0)
        })
        .collect();
    let source = pb::create_clip_request::Source::Frames(pb::FrameSource {
        rate_hz: 60.0,
        frames,
    });
    let request = pb::CreateClipRequest {
        clip_id: "arm".into(),
        source: Some(source),
        ..Default::default()
    };
    other.motions().create_clip(request).await.unwrap();
    assert!(long.iter().all(|l| !l.is_finished()));
    // A client that disconnects frees the workers.
    for task in long {
        task.abort();
    }
    while running().await > 0 {
        tokio::time::sleep(Duration::from_millis(5)).await;
    }
    server.stop().await;
}
