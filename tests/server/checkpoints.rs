//! Checkpoints over the wire: kept, read, restored and forked, and the effect on viewers and drivers.

use crate::support::{TestServer, header, refusal, view};
use sinew_wire::pb;
use sinew_wire::pb::fork_world_request::Source as From;
use sinew_wire::pb::restore_world_request::Source;
use sinew_wire::watched::WatchWorldResponse;
use tonic::{Code, Status};

impl TestServer {
    async fn checkpoint(
        &self,
        world: &str,
        id: &str,
        return_data: bool,
    ) -> pb::CheckpointWorldResponse {
        let request = pb::CheckpointWorldRequest {
            name: world.into(),
            checkpoint_id: id.into(),
            return_data,
            ..Default::default()
        };
        let kept = self.client.checkpoints().checkpoint_world(request).await;
        kept.unwrap().into_inner()
    }

    async fn restore(&self, world: &str, source: Source) -> Result<pb::World, Status> {
        let request = pb::RestoreWorldRequest {
            name: world.into(),
            source: Some(source),
            ..Default::default()
        };
        let done = self.client.checkpoints().restore_world(request).await?;
        Ok(done.into_inner().world.unwrap())
    }

    pub async fn fork(&self, id: &str, source: From) -> Result<pb::World, Status> {
        let request = pb::ForkWorldRequest {
            world_id: id.into(),
            paused: true,
            source: Some(source),
            ..Default::default()
        };
        let done = self.client.checkpoints().fork_world(request).await?;
        Ok(done.into_inner().world.unwrap())
    }

    pub async fn hashes(&self, world: &str, ticks: usize) -> Vec<i64> {
        let mut out = Vec::new();
        for _ in 0..ticks {
            out.push(self.step(world, 1).await.state_hash);
        }
        out
    }

    pub async fn push_it(&self, world: &str, figure: &str, newtons: f64) {
        let push = pb::Force {
            segment: "chest".into(),
            force_newtons: Some(pb::Vector3 {
                x: newtons,
                ..Default::default()
            }),
            duration_s: 0.2,
            ..Default::default()
        };
        let what = pb::Perturbation {
            figure_id: figure.into(),
            kind: Some(pb::perturbation::Kind::Force(push)),
            ..Default::default()
        };
        let request = pb::ApplyPerturbationsRequest {
            world: world.into(),
            perturbations: vec![what],
            ..Default::default()
        };
        self.client
            .perturbations()
            .apply_perturbations(request)
            .await
            .unwrap();
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_world_goes_back_and_two_futures_part_by_what_is_done_to_them() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let figure = format!("{world}/figures/a");
    server.play(&figure, "clips/walk", true).await;
    server.step(&world, 40).await;
    let kept = server.checkpoint(&world, "before", true).await;
    let told = kept.checkpoint.unwrap();
    assert_eq!(told.name, "worlds/w/checkpoints/before");
    assert_eq!((told.tick, told.size_bytes), (40, kept.data.len() as i64));
    let now = server.frame(&world, &["root_pose"]).await;
    assert_eq!(told.state_hash, now.state_hash);
    let future = server.hashes(&world, 30).await;

    // Let other things happen; then the world is restored and continues as before.
    server.figure(&world, "b").await;
    server.step(&world, 5).await;
    let back = server
        .restore(&world, Source::Checkpoint(told.name.clone()))
        .await
        .unwrap();
    assert_eq!((back.tick, back.epoch, back.figure_count), (40, 2, 1));
    assert_eq!(
        server.look(&figure).await.status.unwrap().clip,
        "clips/walk"
    );
    assert_eq!(server.hashes(&world, 30).await, future);

    // A new world from bytes does the same; another one that is pushed does not.
    let same = server
        .fork("same", From::Data(kept.data.clone().into()))
        .await
        .unwrap();
    assert_eq!((same.tick, same.state), (40, pb::WorldState::Paused as i32));
    assert_eq!(server.hashes("worlds/same", 30).await, future);
    server
        .fork("other", From::Checkpoint(told.name))
        .await
        .unwrap();
    server.push_it("worlds/other", "a", 60.0).await;
    assert_ne!(server.hashes("worlds/other", 30).await, future);
    // A fork of a world as it is now.
    let ahead = server.hashes(&world, 10).await;
    server
        .restore(&world, Source::Data(kept.data.into()))
        .await
        .unwrap();
    server.hashes(&world, 30).await;
    let now = server
        .fork("now", From::World(world.clone()))
        .await
        .unwrap();
    assert_eq!(now.tick, 70);
    assert_eq!(server.hashes("worlds/now", 10).await, ahead);
    server.stop().await;
}

/// A figure with the paper's collisions walks into a box; a fork in the middle of that continues bit for bit.
#[tokio::test(flavor = "multi_thread")]
async fn collisions_in_stages_are_forked_as_well() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    let request = pb::CreateFigureRequest {
        parent: world.clone(),
        figure_id: "a".into(),
        figure: Some(pb::Figure {
            controller: pb::Controller::Paper.into(),
            stepper: pb::Stepper::Staged.into(),
            ..Default::default()
        }),
        ..Default::default()
    };
    let made = server.client.figures().create_figure(request).await;
    let made = made.unwrap().into_inner().figure.unwrap();
    assert_eq!(made.stepper(), pb::Stepper::Staged);
    let vector = |x, y, z| Some(pb::Vector3 { x, y, z });
    let wall = pb::Obstacle {
        shape: Some(pb::obstacle::Shape::Box(pb::BoxShape {
            half_m: vector(0.1, 1.0, 1.0),
        })),
        pose: Some(pb::Pose {
            position_m: vector(0.55, 0.0, 1.0),
            ..Default::default()
        }),
        ..Default::default()
    };
    server.add_obstacle(&world, "wall", wall).await.unwrap();
    server
        .play(&format!("{world}/figures/a"), "clips/lift", true)
        .await;
    let mut touched = 0;
    for _ in 0..150 {
        server.step(&world, 1).await;
        let frame = server.frame(&world, &["touches"]).await;
        let touches = frame.figures[0].touches.as_ref();
        touched += usize::from(touches.is_some_and(|t| !t.segment.is_empty()));
        if touched == 5 {
            break;
        }
    }
    assert_eq!(touched, 5, "the figure meets the wall");
    server
        .fork("same", From::World(world.clone()))
        .await
        .unwrap();
    let future = server.hashes(&world, 40).await;
    assert_eq!(server.hashes("worlds/same", 40).await, future);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn viewers_see_the_jump_and_drivers_are_told() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    server.step(&world, 20).await;
    server.checkpoint(&world, "c", false).await;
    server.step(&world, 20).await;
    let mut frames = server
        .client
        .watch(&world, view(&["root_pose"]), None)
        .await
        .unwrap();
    let request = pb::WatchEventsRequest {
        world: world.clone(),
        ..Default::default()
    };
    let mut events = server
        .client
        .states()
        .watch_events(request)
        .await
        .unwrap()
        .into_inner();
    assert!(events.message().await.unwrap().unwrap().events.is_empty());
    let first = loop {
        let message = frames.message().await.unwrap().unwrap();
        if let WatchWorldResponse::Frame(f) = message {
            break f;
        }
    };
    assert_eq!((first.tick, first.epoch), (40, 1));
    let mut drive = server
        .client
        .drive(header(&world, "a", "me"))
        .await
        .unwrap();

    let name = "worlds/w/checkpoints/c".to_owned();
    server
        .restore(&world, Source::Checkpoint(name))
        .await
        .unwrap();
    let mut roster = false;
    let jumped = loop {
        let message = frames.message().await.unwrap().unwrap();
        match message {
            WatchWorldResponse::Roster(_) => roster = true,
            WatchWorldResponse::Frame(f) => break f,
            _ => {}
        }
    };
    assert_eq!((jumped.tick, jumped.epoch, roster), (20, 2, true));
    let restored = loop {
        let batch = events.message().await.unwrap().unwrap().events;
        let restored = pb::EventType::WorldRestored as i32;
        if let Some(e) = batch.into_iter().find(|e| e.r#type == restored) {
            break e;
        }
    };
    assert_eq!((restored.tick, restored.detail.as_str()), (20, "20"));
    // The figure keeps its driver.
    let told = drive.feedback().await.unwrap().expect("the drive goes on");
    assert_eq!(told.driver_id, "me");
    let figure = server.look(&format!("{world}/figures/a")).await;
    assert_eq!(figure.status.unwrap().driver_id, "me");
    server.step(&world, 1).await;
    let next = loop {
        let message = frames.message().await.unwrap().unwrap();
        if let WatchWorldResponse::Frame(f) = message {
            break f;
        }
    };
    assert_eq!((next.tick, next.epoch), (21, 2));
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn checkpoints_are_resources_with_names() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    let mut checkpoints = server.client.checkpoints();
    for id in ["b", "a", ""] {
        server.checkpoint(&world, id, false).await;
    }
    let mut list = async || {
        let request = pb::ListCheckpointsRequest {
            parent: "worlds/w".into(),
            ..Default::default()
        };
        let all = checkpoints
            .list_checkpoints(request)
            .await?
            .into_inner()
            .checkpoints;
        Ok::<_, Status>(all.into_iter().map(|c| c.name).collect::<Vec<_>>())
    };
    let name = |id: &str| format!("worlds/w/checkpoints/{id}");
    assert_eq!(
        list().await.unwrap(),
        [name("a"), name("b"), name("tick-0")]
    );
    let mut checkpoints = server.client.checkpoints();
    let request = pb::CheckpointWorldRequest {
        name: world.clone(),
        checkpoint_id: "a".into(),
        return_data: false,
        ..Default::default()
    };
    let taken = checkpoints.checkpoint_world(request).await.unwrap_err();
    assert_eq!(refusal(&taken).0, Code::AlreadyExists);
    let delete = |id: &str| pb::DeleteCheckpointRequest {
        name: name(id),
        ..Default::default()
    };
    checkpoints.delete_checkpoint(delete("a")).await.unwrap();
    let gone = checkpoints
        .delete_checkpoint(delete("a"))
        .await
        .unwrap_err();
    assert_eq!(refusal(&gone).0, Code::NotFound);
    let get = |id: &str| pb::GetCheckpointRequest {
        name: name(id),
        return_data: true,
    };
    let got = checkpoints
        .get_checkpoint(get("b"))
        .await
        .unwrap()
        .into_inner();
    assert_eq!(got.data.len() as i64, got.checkpoint.unwrap().size_bytes);
    // They are deleted with their world.
    let request = pb::DeleteWorldRequest {
        name: world,
        ..Default::default()
    };
    server.client.worlds().delete_world(request).await.unwrap();
    let gone = checkpoints.get_checkpoint(get("b")).await.unwrap_err();
    assert_eq!(refusal(&gone).0, Code::NotFound);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_no_checkpoint_changes_nothing() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    server.step(&world, 3).await;
    let good = server.checkpoint(&world, "", true).await.data;
    let fast = pb::World {
        rate_hz: 120.0,
        ..Default::default()
    };
    server.world("fast", true, fast).await;
    let bad = |at: usize| {
        let mut bytes = good.clone();
        bytes[at] ^= 0x10;
        Source::Data(bytes.into())
    };
    let middle = good.len() / 2;
    for (what, source, code) in [
        ("text", Source::Data("hello".into()), Code::InvalidArgument),
        ("magic", bad(0), Code::InvalidArgument),
        ("version", bad(8), Code::FailedPrecondition),
        ("server's part", bad(30), Code::DataLoss),
        ("physics", bad(middle), Code::DataLoss),
        (
            "cut",
            Source::Data(good[..middle].to_vec().into()),
            Code::DataLoss,
        ),
        (
            "name",
            Source::Checkpoint("worlds/w".into()),
            Code::InvalidArgument,
        ),
        (
            "missing",
            Source::Checkpoint("worlds/w/checkpoints/x".into()),
            Code::NotFound,
        ),
    ] {
        let status = server.restore(&world, source).await.unwrap_err();
        assert_eq!(refusal(&status).0, code, "{what}: {status}");
    }
    let source = Source::Data(good.clone().into());
    let other = server.restore("worlds/fast", source).await.unwrap_err();
    assert_eq!(refusal(&other).1, "CHECKPOINT_OF_ANOTHER_RATE");
    let request = pb::RestoreWorldRequest {
        name: world.clone(),
        source: None,
        ..Default::default()
    };
    let none = server.client.checkpoints().restore_world(request).await;
    assert_eq!(refusal(&none.unwrap_err()).0, Code::InvalidArgument);
    let frame = server.frame(&world, &["root_pose"]).await;
    assert_eq!((frame.tick, frame.epoch), (3, 1), "nothing has changed");
    server.stop().await;
}
