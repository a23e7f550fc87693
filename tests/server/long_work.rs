//! Long work: operations with progress and cancellation, and streams that do the same.

use crate::support::{TestServer, arm_frame, refusal, view};
use sinew_server::workers::Turn;
use sinew_wire::pb;
use sinew_wire::pb::operation::Result as Done;
use sinew_wire::pb::start_operation_request::Work;
use std::time::{Duration, Instant};
use tonic::Code;
use tonic_types::StatusExt;

fn lift(id: &str, frames: i64) -> pb::CreateClipRequest {
    pb::CreateClipRequest {
        clip_id: id.into(),
        source: Some(pb::create_clip_request::Source::Frames(pb::FrameSource {
            rate_hz: 60.0,
            frames: (0..frames).flat_map(lifted).collect(),
        })),
        ..Default::default()
    }
}

/// A frame of a clip.
fn lifted(i: i64) -> Vec<pb::FigureMotion> {
    let mut figures = arm_frame("", i).figures;
    figures[0].root = Some(pb::Pose {
        position_m: Some(pb::Vector3 {
            x: 0.0,
            y: 0.0,
            z: 0.95,
        }),
        rotation: None,
    });
    figures
}

fn simulation(duration_s: f64) -> pb::SimulateClipRequest {
    pb::SimulateClipRequest {
        source: Some(pb::simulate_clip_request::Source::Clip("clips/wave".into())),
        duration_s,
        r#loop: true,
        ..Default::default()
    }
}

impl TestServer {
    async fn start_operation(&self, work: Work) -> pb::Operation {
        let request = pb::StartOperationRequest {
            work: Some(work),
            ..Default::default()
        };
        let started = self.client.operations().start_operation(request).await;
        started.unwrap().into_inner().operation.unwrap()
    }

    async fn get_operation(&self, name: &str) -> pb::Operation {
        let request = pb::GetOperationRequest { name: name.into() };
        let got = self.client.operations().get_operation(request).await;
        got.unwrap().into_inner().operation.unwrap()
    }

    async fn wait_operation(&self, name: &str, seconds: i64) -> pb::Operation {
        let request = pb::WaitOperationRequest {
            name: name.into(),
            timeout: Some(prost_types::Duration { seconds, nanos: 0 }),
        };
        let waited = self.client.operations().wait_operation(request).await;
        waited.unwrap().into_inner().operation.unwrap()
    }

    async fn operations(&self) -> Vec<pb::Operation> {
        let request = pb::ListOperationsRequest::default();
        let listed = self.client.operations().list_operations(request).await;
        listed.unwrap().into_inner().operations
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn an_operation_answers_with_the_frames_of_the_call() {
    let server = TestServer::start().await;
    let request = pb::SimulateClipRequest {
        view: Some(pb::View::default()),
        ..simulation(0.5)
    };
    let mut simulations = server.client.simulations();
    let called = simulations.simulate_clip(request.clone()).await;
    let called = called.unwrap().into_inner();
    assert!(called.frames.len() > 10 && called.summary.is_some());
    let started = server.start_operation(Work::SimulateClip(request)).await;
    let ended = server.wait_operation(&started.name, 60).await;
    // The result can be fetched by any request, any number of times.
    for operation in [ended, server.get_operation(&started.name).await] {
        let Some(Done::SimulateClip(done)) = operation.result else {
            panic!("{operation:?}");
        };
        assert_eq!(done.frames, called.frames);
        assert_eq!(done.events, called.events);
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn what_was_sent_counts_until_the_work_has_used_it() {
    let settings = [
        ("max_clip_bytes", "1048576"),
        ("max_pending_bytes", "1048576"),
        ("max_conversions", "1"),
    ];
    let server = TestServer::with(&settings).await;
    let (go, wait) = std::sync::mpsc::sync_channel::<()>(1);
    let pool = server.app.conversions.clone();
    let busy = tokio::spawn(async move {
        let work = move |_: &Turn| {
            wait.recv().ok();
            Ok(())
        };
        pool.run(&"other".into(), work).await
    });
    while server.app.conversions.running() < 1 {
        tokio::task::yield_now().await;
    }
    let upload = || pb::StartOperationRequest {
        work: Some(Work::CreateClip(pb::CreateClipRequest {
            source: Some(pb::create_clip_request::Source::Bvh(pb::BvhSource {
                data: vec![b'x'; 700_000].into(),
                ..Default::default()
            })),
            ..Default::default()
        })),
        ..Default::default()
    };
    let start = || async { server.client.operations().start_operation(upload()).await };
    let first = start().await.unwrap().into_inner().operation.unwrap();
    // The call is answered, and its result waits for its turn.
    let refused = start().await.unwrap_err();
    assert_eq!(refused.code(), Code::ResourceExhausted);
    assert!(refused.message().contains("max_pending_bytes"), "{refused}");
    go.send(()).unwrap();
    busy.await.unwrap().unwrap();
    let first = server.wait_operation(&first.name, 60).await;
    assert_eq!(first.state(), pb::OperationState::Failed, "it is no file");
    start().await.unwrap();
}

#[tokio::test(flavor = "multi_thread")]
async fn operations_end_with_what_the_call_would_have_answered() {
    let server = TestServer::start().await;
    let made = server
        .start_operation(Work::CreateClip(lift("raised", 60)))
        .await;
    assert_eq!(made.name, "operations/operation-1");
    let simulated = server
        .start_operation(Work::SimulateClip(simulation(1.0)))
        .await;
    let made = server.wait_operation(&made.name, 60).await;
    assert_eq!(made.state(), pb::OperationState::Succeeded);
    assert!(made.progress == 1.0 && made.end_time.is_some() && made.expire_time.is_some());
    let Some(Done::CreateClip(clip)) = &made.result else {
        panic!("{made:?}");
    };
    assert_eq!(clip.clip.as_ref().unwrap().name, "clips/raised");
    let simulated = server.wait_operation(&simulated.name, 60).await;
    let Some(Done::SimulateClip(result)) = &simulated.result else {
        panic!("{simulated:?}");
    };
    let called = server
        .client
        .simulations()
        .simulate_clip(simulation(1.0))
        .await;
    let called = called.unwrap().into_inner().summary.unwrap();
    assert_eq!(
        result.summary.as_ref().unwrap().state_hash,
        called.state_hash
    );

    // A failed operation gives its reason, as the call would have.
    let taken = server
        .start_operation(Work::CreateClip(lift("raised", 60)))
        .await;
    let taken = server.wait_operation(&taken.name, 60).await;
    assert_eq!(taken.state(), pb::OperationState::Failed);
    let Some(Done::Error(status)) = &taken.result else {
        panic!("{taken:?}");
    };
    assert_eq!(status.code, i32::from(Code::AlreadyExists));
    let info = status
        .details
        .iter()
        .find(|d| d.type_url.ends_with("google.rpc.ErrorInfo"));
    assert!(info.is_some(), "{status:?}");
    let bad = server
        .start_operation(Work::CreateClip(lift("short", 1)))
        .await;
    let bad = server.wait_operation(&bad.name, 60).await;
    let Some(Done::Error(status)) = &bad.result else {
        panic!("{bad:?}");
    };
    assert!(
        status.message.starts_with("create_clip.frames"),
        "{status:?}"
    );

    // Lists contain no results; finished operations can be deleted.
    let all = server.operations().await;
    assert_eq!(all.len(), 4);
    assert!(all.iter().all(|o| o.result.is_none()));
    let delete = pb::DeleteOperationRequest {
        name: made.name.clone(),
    };
    let mut operations = server.client.operations();
    operations.delete_operation(delete.clone()).await.unwrap();
    let gone = operations.delete_operation(delete).await.unwrap_err();
    assert_eq!(refusal(&gone).0, Code::NotFound);
    assert_eq!(server.operations().await.len(), 3);
    for (work, field) in [
        (None, "work"),
        (
            Some(Work::CreateClip(pb::CreateClipRequest {
                validate_only: true,
                ..lift("x", 60)
            })),
            "create_clip.validate_only",
        ),
    ] {
        let request = pb::StartOperationRequest {
            work,
            ..Default::default()
        };
        let refused = operations.start_operation(request).await.unwrap_err();
        assert_eq!(refusal(&refused).2, field);
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_operation_tells_how_far_it_is_and_is_cancelled() {
    let server = TestServer::with(&[("max_simulations", "1"), ("max_simulation_s", "80000")]).await;
    let long = server
        .start_operation(Work::SimulateClip(simulation(70_000.0)))
        .await;
    let next = server
        .start_operation(Work::SimulateClip(simulation(1.0)))
        .await;
    let begun = Instant::now();
    let running = loop {
        let now = server.get_operation(&long.name).await;
        if now.state() == pb::OperationState::Running {
            break now;
        }
        assert!(begun.elapsed() < Duration::from_secs(60));
    };
    assert!((0.0..1.0).contains(&running.progress) && running.end_time.is_none());
    // A wait ends with the state at that time.
    let waited = server.wait_operation(&long.name, 0).await;
    assert_eq!(waited.state(), pb::OperationState::Running);
    let delete = pb::DeleteOperationRequest {
        name: long.name.clone(),
    };
    let mut operations = server.client.operations();
    let refused = operations.delete_operation(delete).await.unwrap_err();
    assert_eq!(refusal(&refused).1, "OPERATION_RUNNING");
    let cancel = pb::CancelOperationRequest {
        name: long.name.clone(),
    };
    let cancelled = operations.cancel_operation(cancel.clone()).await.unwrap();
    let cancelled = cancelled.into_inner().operation.unwrap();
    assert_eq!(cancelled.state(), pb::OperationState::Cancelled);
    assert!(cancelled.result.is_none());
    operations.cancel_operation(cancel).await.unwrap();
    // Its worker is free, so the waiting operation is done.
    let next = server.wait_operation(&next.name, 60).await;
    assert_eq!(next.state(), pb::OperationState::Succeeded);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn operations_are_bounded_and_a_repeat_starts_none() {
    let server = TestServer::with(&[
        ("max_operations", "2"),
        ("max_client_share", "1"),
        ("max_simulation_s", "80000"),
    ])
    .await;
    let start = |id: &str| pb::StartOperationRequest {
        work: Some(Work::SimulateClip(simulation(70_000.0))),
        request_id: id.into(),
    };
    let mut operations = server.client.operations();
    let mut names = Vec::new();
    for id in ["one", "one", "two"] {
        let started = operations.start_operation(start(id)).await.unwrap();
        names.push(started.into_inner().operation.unwrap().name);
    }
    assert_eq!(names[0], names[1]);
    let full = operations
        .start_operation(start("three"))
        .await
        .unwrap_err();
    assert_eq!(refusal(&full).1, "LIMIT_REACHED");
    let quota = full.get_error_details().quota_failure().unwrap().violations[0].clone();
    assert_eq!(quota.subject, "max_operations");
    // A finished operation makes room.
    let cancel = pb::CancelOperationRequest {
        name: names[0].clone(),
    };
    operations.cancel_operation(cancel).await.unwrap();
    operations.start_operation(start("three")).await.unwrap();
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_stream_sends_frames_as_they_are_computed() {
    let server = TestServer::start().await;
    let request = || pb::SimulateClipRequest {
        view: Some(view(&["root_pose"])),
        ..simulation(3.0)
    };
    let stream = pb::StreamSimulateClipRequest {
        simulate_clip: Some(request()),
    };
    let mut simulations = server.client.simulations();
    let mut stream = simulations
        .stream_simulate_clip(stream)
        .await
        .unwrap()
        .into_inner();
    let (mut ticks, mut told, mut last) = (Vec::new(), 0.0, None);
    while let Some(message) = stream.message().await.unwrap() {
        use pb::stream_simulate_clip_response::Message;
        assert!(last.is_none(), "the result is the last message");
        match message.message.unwrap() {
            Message::Progress(p) => {
                assert!(
                    (told..=1.0).contains(&p.progress),
                    "{} after {told}",
                    p.progress
                );
                told = p.progress;
                ticks.extend(p.frames.iter().map(|f| f.tick));
            }
            Message::SimulateClip(done) => last = Some(done),
        }
    }
    let last = last.expect("it ended");
    assert_eq!(ticks, (1..=180).collect::<Vec<_>>());
    let called = simulations
        .simulate_clip(request())
        .await
        .unwrap()
        .into_inner();
    assert_eq!(called.frames.len(), 180);
    assert!(last.frames.is_empty());
    assert_eq!(
        last.summary.unwrap().state_hash,
        called.summary.unwrap().state_hash
    );
    let refused = simulations
        .stream_simulate_clip(pb::StreamSimulateClipRequest {
            simulate_clip: Some(simulation(f64::NAN)),
        })
        .await;
    let refused = match refused {
        Ok(mut stream) => stream.get_mut().message().await.unwrap_err(),
        Err(status) => status,
    };
    assert_eq!(refusal(&refused).2, "simulate_clip.duration_s");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_stream_that_is_left_gives_its_work_up() {
    let server = TestServer::with(&[("max_simulations", "1"), ("max_simulation_s", "80000")]).await;
    let stream = pb::StreamSimulateClipRequest {
        simulate_clip: Some(simulation(70_000.0)),
    };
    let mut simulations = server.client.simulations();
    let mut stream = simulations
        .stream_simulate_clip(stream)
        .await
        .unwrap()
        .into_inner();
    assert!(stream.message().await.unwrap().is_some());
    drop(stream);
    let after = simulations.simulate_clip(simulation(0.5)).await;
    assert!(after.is_ok(), "the only worker is free again: {after:?}");

    let stream = pb::StreamCreateClipRequest {
        create_clip: Some(lift("raised", 60)),
    };
    let mut motions = server.client.motions();
    let mut stream = motions
        .stream_create_clip(stream)
        .await
        .unwrap()
        .into_inner();
    let mut made = None;
    while let Some(message) = stream.message().await.unwrap() {
        use pb::stream_create_clip_response::Message;
        match message.message.unwrap() {
            Message::Progress(share) => assert!((0.0..1.0).contains(&share)),
            Message::CreateClip(clip) => made = clip.clip,
        }
    }
    assert_eq!(made.unwrap().name, "clips/raised");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn events_tell_when_a_clip_begins_and_ends() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    let figure = server.figure(&world, "a").await.name;
    let request = pb::WatchEventsRequest {
        world: world.clone(),
        figure_ids: vec![],
        types: vec![
            pb::EventType::ClipBegan.into(),
            pb::EventType::ClipEnded.into(),
        ],
    };
    let mut states = server.client.states();
    let mut events = states.watch_events(request).await.unwrap().into_inner();
    events.message().await.unwrap();
    let mut next = async || {
        let told = events.message().await.unwrap().unwrap().events;
        let told = told.into_iter();
        let told = told.map(|e| (e.r#type(), e.figure_id.clone(), e.detail.clone(), e.tick));
        told.collect::<Vec<_>>()
    };
    let (began, ended) = (pb::EventType::ClipBegan, pb::EventType::ClipEnded);
    let request = pb::GetClipRequest {
        name: "clips/wave".into(),
    };
    let clip = server.client.motions().get_clip(request).await.unwrap();
    let ticks = (clip.into_inner().clip.unwrap().duration_s * 60.0) as i64;

    // One that plays to its end, and stands.
    server.play(&figure, "clips/wave", true).await;
    server.step(&world, ticks as i32 + 10).await;
    assert_eq!(next().await, [(began, "a".into(), "clips/wave".into(), 0)]);
    let told = next().await;
    assert_eq!((told[0].0, told[0].2.as_str()), (ended, "clips/wave"));
    assert!((told[0].3 - ticks).abs() <= 2, "{told:?} of {ticks}");
    // One that replaces another, and is stopped.
    server.play(&figure, "clips/walk", true).await;
    server.step(&world, 5).await;
    assert_eq!(next().await[0].0, began);
    server.play(&figure, "clips/idle", true).await;
    let told = next().await;
    let told: Vec<_> = told.iter().map(|t| (t.0, t.2.as_str())).collect();
    assert_eq!(told, [(ended, "clips/walk"), (began, "clips/idle")]);
    let stop = pb::StopClipRequest {
        figure: figure.clone(),
        ..Default::default()
    };
    server.client.motions().stop_clip(stop).await.unwrap();
    let told = next().await;
    assert_eq!((told[0].0, told[0].2.as_str()), (ended, "clips/idle"));
    server.stop().await;
}

/// Stored as frames: a body that slides on its soles, faster than it could walk.
fn slide(id: &str) -> pb::CreateClipRequest {
    let mut clip = lift(id, 40);
    if let Some(pb::create_clip_request::Source::Frames(source)) = &mut clip.source {
        for (i, frame) in source.frames.iter_mut().enumerate() {
            let root = frame.root.as_mut().unwrap();
            root.position_m.as_mut().unwrap().x = 3.0 * i as f64 / 60.0;
        }
    }
    clip.follow = pb::Follow::Assisted.into();
    clip.max_help_weights = Some(0.2);
    clip
}

#[tokio::test(flavor = "multi_thread")]
async fn clips_are_rehearsed_for_a_figure() {
    let server = TestServer::start().await;
    server.paused_world("studio").await;
    server.figure("worlds/studio", "anna").await;
    let rehearsal = |clip: &str, seconds: i64| pb::RehearseClipRequest {
        clip: format!("clips/{clip}"),
        figure: "worlds/studio/figures/anna".into(),
        budget: Some(prost_types::Duration { seconds, nanos: 0 }),
        ..Default::default()
    };
    // A clip that is tracked without help needs none.
    let easy = server
        .start_operation(Work::RehearseClip(rehearsal("wave", 60)))
        .await;
    let easy = server.wait_operation(&easy.name, 60).await;
    let Some(Done::RehearseClip(done)) = &easy.result else {
        panic!("{easy:?}");
    };
    let found = done.rehearsal.as_ref().unwrap();
    assert_eq!(found.way(), pb::FollowWay::Tracked, "{found:?}");
    assert!(found.lost_at_s.is_none() && found.help_newton_seconds == 0.0);

    let clip = server.client.motions().create_clip(slide("slide")).await;
    let clip = clip.unwrap().into_inner().clip.unwrap();
    assert_eq!(clip.follow(), pb::Follow::Assisted);
    assert_eq!(clip.max_help_weights, 0.2);
    let hard = server
        .client
        .motions()
        .rehearse_clip(rehearsal("slide", 2))
        .await;
    let hard = hard.unwrap().into_inner().rehearsal.unwrap();
    assert!(hard.way() != pb::FollowWay::Tracked && !hard.reason.is_empty());
    let weight = 9.81 * 90.0;
    assert!(hard.help_peak_newtons <= 0.2 * weight, "{hard:?}");
    let kept = matches!(hard.way(), pb::FollowWay::Helped | pb::FollowWay::Rehearsed);
    assert_eq!(kept, hard.lost_at_s.is_none());

    // Each wrong field is named, and a missing figure is not found.
    let wrong = |change: fn(&mut pb::RehearseClipRequest)| {
        let mut request = rehearsal("wave", 60);
        change(&mut request);
        let motion = server.client.motions();
        async move { motion.clone().rehearse_clip(request).await.unwrap_err() }
    };
    for (refused, field) in [
        (wrong(|r| r.follow = 9).await, "follow"),
        (
            wrong(|r| r.max_help_weights = Some(f64::NAN)).await,
            "max_help_weights",
        ),
        (
            wrong(|r| r.max_help_weights = Some(2.1)).await,
            "max_help_weights",
        ),
        (
            wrong(|r| r.budget = Some(Default::default())).await,
            "budget",
        ),
        (wrong(|r| r.clip = "wave".into()).await, "clip"),
        (wrong(|r| r.figure = "anna".into()).await, "figure"),
    ] {
        assert_eq!(refusal(&refused).2, field);
    }
    for absent in [
        wrong(|r| r.clip = "clips/none".into()).await,
        wrong(|r| r.figure = "worlds/studio/figures/bob".into()).await,
    ] {
        assert_eq!(absent.code(), Code::NotFound);
    }

    // A cancelled operation ends.
    let long = server
        .start_operation(Work::RehearseClip(rehearsal("slide", 600)))
        .await;
    let request = pb::CancelOperationRequest {
        name: long.name.clone(),
    };
    let cancelled = server.client.operations().cancel_operation(request).await;
    let cancelled = cancelled.unwrap().into_inner().operation.unwrap();
    assert_eq!(cancelled.state(), pb::OperationState::Cancelled);
}
