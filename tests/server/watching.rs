//! Streams of frames and events.

use crate::support::{TestServer, refusal, view};
use sinew_wire::pb;
use sinew_wire::watched::WatchWorldResponse;
use std::time::Duration;
use tonic::{Code, Streaming};

async fn next(stream: &mut Streaming<WatchWorldResponse>) -> WatchWorldResponse {
    tokio::time::timeout(Duration::from_secs(20), stream.message())
        .await
        .expect("a frame comes in time")
        .unwrap()
        .expect("the stream goes on")
}

async fn next_frame(stream: &mut Streaming<WatchWorldResponse>) -> pb::WorldFrame {
    loop {
        if let WatchWorldResponse::Frame(f) = next(stream).await {
            return *f;
        }
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_roster_comes_first_and_again_when_figures_change() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let mut frames = server
        .client
        .watch(&world, view(&["root_pose"]), None)
        .await
        .unwrap();
    let WatchWorldResponse::Roster(roster) = next(&mut frames).await else {
        panic!("the roster comes first");
    };
    assert_eq!(roster.figures[0].figure_id, "a");
    assert_eq!(next_frame(&mut frames).await.figures.len(), 1);
    server.figure(&world, "b").await;
    let roster = loop {
        if let WatchWorldResponse::Roster(r) = next(&mut frames).await {
            break r;
        }
    };
    assert_eq!(roster.figures.len(), 2);
    let frame = next_frame(&mut frames).await;
    assert_eq!(
        (frame.roster_version, frame.figures.len()),
        (roster.version, 2)
    );
    server
        .client
        .worlds()
        .delete_world(pb::DeleteWorldRequest {
            name: world,
            ..Default::default()
        })
        .await
        .unwrap();
    let end = loop {
        match frames.message().await {
            Ok(Some(_)) => {}
            Ok(None) => panic!("ended without a reason"),
            Err(e) => break e,
        }
    };
    assert_eq!(end.code(), Code::NotFound);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_viewer_that_lost_its_connection_resumes_without_a_gap() {
    let server = TestServer::with(&[("history_ticks", "20"), ("memory_s", "0")]).await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    server.step(&world, 30).await;
    let mut frames = server
        .client
        .watch(&world, view(&["root_pose"]), Some(20))
        .await
        .unwrap();
    for tick in 21..=30 {
        assert_eq!(next_frame(&mut frames).await.tick, tick);
    }
    server.step(&world, 1).await;
    assert_eq!(next_frame(&mut frames).await.tick, 31);
    let e = server
        .client
        .watch(&world, view(&["root_pose"]), Some(3))
        .await
        .unwrap_err();
    let (code, reason, _) = refusal(&e);
    assert_eq!(
        (code, reason.as_str()),
        (Code::OutOfRange, "RESUME_EXPIRED")
    );
    let held = server
        .client
        .states()
        .get_world_frame(pb::GetWorldFrameRequest {
            world,
            tick: Some(25),
            view: None,
        })
        .await
        .unwrap()
        .into_inner();
    assert_eq!(held.frame.unwrap().tick, 25);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_slow_viewer_gets_the_latest_frame_and_slows_nobody() {
    let server = TestServer::start().await;
    let world = server
        .world(
            "w",
            false,
            pb::World {
                rate_hz: 200.0,
                ..Default::default()
            },
        )
        .await;
    server.figure(&world, "a").await;
    // 5 kB a frame: the window of the slow one is full within a few.
    let mut slow = server
        .client
        .watch(&world, view(&["*"]), None)
        .await
        .unwrap();
    let quick_client = sinew_client::Client::connect(&server.address.to_string())
        .await
        .unwrap();
    let mut quick = quick_client
        .watch(&world, view(&["root_pose"]), None)
        .await
        .unwrap();
    next_frame(&mut slow).await;
    let first = next_frame(&mut quick).await.tick;
    let mut seen = 1;
    let mut last = first;
    while last < first + 300 {
        last = next_frame(&mut quick).await.tick;
        seen += 1;
    }
    assert!(seen > 150, "the quick one saw {seen} of 300");
    // The frames under way when the window closed, then the latest one, with nothing in between.
    let mut ticks = Vec::new();
    while ticks.last().is_none_or(|t| *t < last) {
        ticks.push(next_frame(&mut slow).await.tick);
    }
    let gap = ticks.windows(2).map(|w| w[1] - w[0]).max().unwrap();
    assert!(gap > 100, "frames were left out: {ticks:?}");
    let stats = server
        .client
        .server()
        .get_server_stats(pb::GetServerStatsRequest {
            world: world.clone(),
        })
        .await
        .unwrap()
        .into_inner();
    assert!(stats.worlds[0].dropped_frame_count >= gap - 1);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn equal_views_share_their_bytes_and_too_many_are_refused() {
    let server = TestServer::with(&[
        ("max_views_per_world", "1"),
        ("max_viewers", "2"),
        ("max_client_share", "1"),
    ])
    .await;
    let world = server.paused_world("w").await;
    let one = server.client.watch(&world, view(&["torque"]), None).await;
    let two = server.client.watch(&world, view(&["torque"]), None).await;
    assert!(one.is_ok() && two.is_ok());
    let e = server
        .client
        .watch(&world, view(&["torque"]), None)
        .await
        .unwrap_err();
    assert_eq!(refusal(&e).0, Code::ResourceExhausted);
    drop(two);
    // The place is free again once the server has noticed.
    let e = loop {
        match server.client.watch(&world, view(&["velocity"]), None).await {
            Err(e) if e.message().contains("max_viewers") => tokio::task::yield_now().await,
            Err(e) => break e,
            Ok(_) => panic!("a second view was accepted"),
        }
    };
    assert!(e.message().contains("max_views_per_world"), "{e:?}");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn events_say_what_happens() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    let watch = |figure_ids: Vec<String>| pb::WatchEventsRequest {
        world: world.clone(),
        figure_ids,
        types: vec![],
    };
    let mut events = server
        .client
        .states()
        .watch_events(watch(vec![]))
        .await
        .unwrap()
        .into_inner();
    assert!(events.message().await.unwrap().unwrap().events.is_empty());
    server.figure(&world, "a").await;
    server
        .client
        .perturbations()
        .apply_perturbations(pb::ApplyPerturbationsRequest {
            world: world.clone(),
            perturbations: vec![pb::Perturbation {
                figure_id: "a".into(),
                tick: Some(2),
                kind: Some(pb::perturbation::Kind::Load(pb::Load {
                    segment: "l_hand".into(),
                    mass_kg: 2.0,
                    ..Default::default()
                })),
            }],
            ..Default::default()
        })
        .await
        .unwrap();
    server.step(&world, 5).await;
    let mut seen = Vec::new();
    while !seen.contains(&pb::EventType::LoadTaken) {
        for e in events.message().await.unwrap().unwrap().events {
            if e.r#type() == pb::EventType::LoadTaken {
                assert_eq!((e.segment.as_str(), e.mass_kg, e.tick), ("l_hand", 2.0, 3));
            }
            seen.push(e.r#type());
        }
    }
    assert!(seen.contains(&pb::EventType::FigureAdded));
    let e = server
        .client
        .states()
        .watch_events(watch(vec!["zz".into()]))
        .await
        .unwrap_err();
    assert_eq!(e.code(), Code::NotFound);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn who_joins_late_gets_the_past_and_then_what_comes_without_a_gap() {
    let server = TestServer::with(&[("history_ticks", "8"), ("memory_s", "3600")]).await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    server
        .play(&format!("{world}/figures/a"), "clips/walk", true)
        .await;
    let mut hashes = vec![0];
    hashes.extend(server.hashes(&world, 20).await);
    server.figure(&world, "b").await;
    hashes.extend(server.hashes(&world, 130).await);
    let mut frames = server
        .client
        .watch(&world, view(&["root_pose"]), Some(2))
        .await
        .unwrap();
    let mut names = Vec::new();
    let mut tick = 2;
    while tick < 150 {
        match next(&mut frames).await {
            WatchWorldResponse::Roster(r) => names.push((tick, r.figures.len(), r.version)),
            WatchWorldResponse::Frame(f) => {
                tick += 1;
                assert_eq!((f.tick, f.state_hash), (tick, hashes[tick as usize]));
                assert_eq!(f.figures.len(), if tick > 20 { 2 } else { 1 });
                assert_eq!(f.roster_version, names.last().unwrap().2);
                assert_eq!(f.epoch, 1);
            }
            other => panic!("{other:?}"),
        }
    }
    // The names come before the first frame, when they change, and where held frames resume.
    let counts: Vec<_> = names.iter().map(|n| (n.0, n.1)).collect();
    assert_eq!(counts, [(2, 1), (20, 2), (142, 2)]);
    server.step(&world, 1).await;
    assert_eq!(next_frame(&mut frames).await.tick, 151);
    // Other viewers begin and do not read; those that read still get their frames.
    let mut idle = Vec::new();
    let first = server
        .client
        .watch(&world, view(&["root_pose"]), Some(-1))
        .await;
    let mut first = first.unwrap();
    assert_eq!(next_frame(&mut first).await.tick, 0);
    for _ in 0..20 {
        let watched = server
            .client
            .watch(&world, view(&["root_pose"]), Some(-1))
            .await;
        let mut frames = watched.unwrap();
        assert_eq!(next_frame(&mut frames).await.tick, 0);
        idle.push(frames);
    }
    for tick in 1..=151 {
        assert_eq!(next_frame(&mut first).await.tick, tick);
    }
    drop(idle);
    // Every third frame; ticks not yet computed are not part of the past.
    let third = pb::View {
        rate_divisor: 3,
        ..view(&["root_pose"])
    };
    let mut frames = server.client.watch(&world, third, Some(-1)).await.unwrap();
    for tick in (0..=150).step_by(3) {
        assert_eq!(next_frame(&mut frames).await.tick, tick);
    }
    for tick in [152, -2] {
        let watched = server
            .client
            .watch(&world, view(&["root_pose"]), Some(tick))
            .await;
        assert_eq!(refusal(&watched.unwrap_err()).0, Code::OutOfRange, "{tick}");
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn who_joins_a_world_late_that_runs_catches_up_with_it() {
    let server = TestServer::with(&[("history_ticks", "16"), ("memory_s", "3600")]).await;
    let world = server.world("w", false, pb::World::default()).await;
    server.figure(&world, "a").await;
    let begun = async {
        while server.get_world(&world).await.tick < 120 {
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    };
    tokio::time::timeout(Duration::from_secs(60), begun)
        .await
        .unwrap();
    let mut frames = server
        .client
        .watch(&world, view(&["root_pose"]), Some(30))
        .await
        .unwrap();
    let now = server.get_world(&world).await.tick;
    // No replayed frame is left out; a viewer that is too slow for new frames gets the latest.
    let mut last = 30;
    while last < now + 10 {
        let tick = next_frame(&mut frames).await.tick;
        assert!(
            tick == last + 1 || tick > last && last > now - 17,
            "{tick} after {last}, at {now}"
        );
        last = tick;
    }
    server.stop().await;
}
