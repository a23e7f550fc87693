//! The promises of docs/api.md for every resource: repeats, etags, masks, pages, trying out, idle worlds.

use crate::support::{TestServer, arm_frame, header, refusal};
use sinew_wire::pb;
use std::time::{Duration, Instant};
use tonic::Code;

fn mask(paths: &[&str]) -> Option<prost_types::FieldMask> {
    Some(prost_types::FieldMask {
        paths: paths.iter().map(|p| (*p).to_owned()).collect(),
    })
}

fn ball() -> pb::Obstacle {
    pb::Obstacle {
        shape: Some(pb::obstacle::Shape::Sphere(pb::SphereShape {
            radius_m: 0.2,
        })),
        mobility: pb::ObstacleMobility::Free.into(),
        mass_kg: 2.0,
        pose: Some(pb::Pose {
            position_m: Some(pb::Vector3 {
                x: 5.0,
                y: 0.0,
                z: 3.0,
            }),
            rotation: None,
        }),
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

impl TestServer {
    async fn worlds(&self) -> Vec<String> {
        let request = pb::ListWorldsRequest::default();
        let listed = self.client.worlds().list_worlds(request).await;
        let listed = listed.unwrap().into_inner().worlds;
        listed.into_iter().map(|w| w.name).collect()
    }

    pub async fn get_world(&self, name: &str) -> pb::World {
        let request = pb::GetWorldRequest { name: name.into() };
        let got = self.client.worlds().get_world(request).await;
        got.unwrap().into_inner().world.unwrap()
    }

    async fn ball(&self, world: &str, id: &str) -> pb::Obstacle {
        let request = pb::CreateObstacleRequest {
            parent: world.into(),
            obstacle_id: id.into(),
            obstacle: Some(ball()),
            ..Default::default()
        };
        let made = self.client.obstacles().create_obstacle(request).await;
        made.unwrap().into_inner().obstacle.unwrap()
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_request_under_one_name_is_done_once() {
    let server = TestServer::start().await;
    let create = pb::CreateWorldRequest {
        paused: true,
        request_id: "create-1".into(),
        ..Default::default()
    };
    // The same from several connections at once.
    let mut all = Vec::new();
    for _ in 0..8 {
        let client = sinew_client::Client::connect(&server.address.to_string())
            .await
            .unwrap();
        let create = create.clone();
        all.push(tokio::spawn(async move {
            let made = client.worlds().create_world(create).await;
            made.unwrap().into_inner().world.unwrap().name
        }));
    }
    let mut names = Vec::new();
    for made in all {
        names.push(made.await.unwrap());
    }
    names.dedup();
    assert_eq!(names.len(), 1, "all got the answer of the first: {names:?}");
    assert_eq!(server.worlds().await, names);
    let world = &names[0];

    // A request carried out twice would be visible.
    let step = pb::StepWorldRequest {
        name: world.clone(),
        tick_count: 5,
        request_id: "step-1".into(),
    };
    let mut worlds = server.client.worlds();
    let first = worlds.step_world(step.clone()).await.unwrap().into_inner();
    let again = worlds.step_world(step.clone()).await.unwrap().into_inner();
    assert_eq!(first, again);
    assert_eq!(server.get_world(world).await.tick, 5);
    let other = pb::StepWorldRequest {
        tick_count: 6,
        ..step.clone()
    };
    let (code, reason, _) = refusal(&worlds.step_world(other).await.unwrap_err());
    assert_eq!(
        (code, reason.as_str()),
        (Code::FailedPrecondition, "REQUEST_ID_REUSED")
    );
    // The id counts only within its call, and a new id is a new request.
    let resume = pb::ResetFigureRequest {
        name: format!("{world}/figures/none"),
        request_id: "step-1".into(),
        ..Default::default()
    };
    let refused = server.client.figures().reset_figure(resume).await;
    assert_eq!(refused.unwrap_err().code(), Code::NotFound);
    let new = pb::StepWorldRequest {
        request_id: "step-2".into(),
        ..step
    };
    worlds.step_world(new).await.unwrap();
    assert_eq!(server.get_world(world).await.tick, 10);

    // A refused request is tried again under its id.
    let delete = pb::DeleteWorldRequest {
        name: "worlds/later".into(),
        request_id: "delete-1".into(),
        ..Default::default()
    };
    let refused = worlds.delete_world(delete.clone()).await.unwrap_err();
    assert_eq!(refused.code(), Code::NotFound);
    server.paused_world("later").await;
    worlds.delete_world(delete.clone()).await.unwrap();
    worlds.delete_world(delete).await.unwrap();
    let long = pb::CreateWorldRequest {
        request_id: "x".repeat(65),
        ..Default::default()
    };
    let refused = worlds.create_world(long).await.unwrap_err();
    assert_eq!(refusal(&refused).2, "request_id");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_etag_keeps_one_from_overwriting_what_somebody_else_has_set() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    let figure = server.figure(&world, "a").await;
    let ball = server.ball(&world, "ball").await;
    let before = server.get_world(&world).await;
    assert!(!before.etag.is_empty() && !figure.etag.is_empty() && !ball.etag.is_empty());

    // Passing time, falling obstacles and playing clips change no setting.
    server.play(&figure.name, "clips/walk", true).await;
    server.step(&world, 20).await;
    let now = server.get_world(&world).await;
    assert_eq!((now.tick, &now.etag), (20, &before.etag));
    let playing = server.look(&figure.name).await;
    assert_eq!(playing.status.unwrap().clip, "clips/walk");
    assert_eq!(playing.etag, figure.etag);
    let mut obstacles = server.client.obstacles();
    let get = pb::GetObstacleRequest {
        name: ball.name.clone(),
    };
    let fallen = obstacles.get_obstacle(get).await.unwrap().into_inner();
    let fallen = fallen.obstacle.unwrap();
    assert!(fallen.pose.unwrap().position_m.unwrap().z < 2.9);
    assert_eq!(fallen.etag, ball.etag);

    let rename = |etag: &str, display_name: &str| pb::UpdateWorldRequest {
        world: Some(pb::World {
            name: world.clone(),
            display_name: display_name.into(),
            etag: etag.into(),
            ..Default::default()
        }),
        ..Default::default()
    };
    let mut worlds = server.client.worlds();
    let renamed = worlds.update_world(rename(&before.etag, "ours")).await;
    let renamed = renamed.unwrap().into_inner().world.unwrap();
    assert_ne!(renamed.etag, before.etag);
    let stale = worlds.update_world(rename(&before.etag, "theirs")).await;
    let (code, reason, _) = refusal(&stale.unwrap_err());
    assert_eq!((code, reason.as_str()), (Code::Aborted, "ETAG_MISMATCH"));
    assert_eq!(server.get_world(&world).await.display_name, "ours");

    let weaker = pb::UpdateFigureRequest {
        figure: Some(pb::Figure {
            name: figure.name.clone(),
            assist: 0.5,
            etag: figure.etag.clone(),
            ..Default::default()
        }),
        ..Default::default()
    };
    let mut figures = server.client.figures();
    figures.update_figure(weaker.clone()).await.unwrap();
    let stale = figures.update_figure(weaker).await.unwrap_err();
    assert_eq!(refusal(&stale).1, "ETAG_MISMATCH");
    let delete = |etag: &str| pb::DeleteFigureRequest {
        name: figure.name.clone(),
        etag: etag.into(),
        ..Default::default()
    };
    let stale = figures.delete_figure(delete(&figure.etag)).await;
    assert_eq!(refusal(&stale.unwrap_err()).1, "ETAG_MISMATCH");
    let fresh = server.look(&figure.name).await.etag;
    figures.delete_figure(delete(&fresh)).await.unwrap();

    let slippery = |etag: &str| pb::UpdateObstacleRequest {
        obstacle: Some(pb::Obstacle {
            name: ball.name.clone(),
            friction: Some(0.1),
            etag: etag.into(),
            ..Default::default()
        }),
        ..Default::default()
    };
    obstacles
        .update_obstacle(slippery(&ball.etag))
        .await
        .unwrap();
    let stale = obstacles.update_obstacle(slippery(&ball.etag)).await;
    assert_eq!(refusal(&stale.unwrap_err()).1, "ETAG_MISMATCH");
    let delete = pb::DeleteObstacleRequest {
        name: ball.name.clone(),
        etag: ball.etag.clone(),
        ..Default::default()
    };
    let stale = obstacles.delete_obstacle(delete).await.unwrap_err();
    assert_eq!(refusal(&stale).1, "ETAG_MISMATCH");
    let stale = pb::DeleteWorldRequest {
        name: world.clone(),
        etag: before.etag,
        ..Default::default()
    };
    let stale = worlds.delete_world(stale).await.unwrap_err();
    assert_eq!(refusal(&stale).1, "ETAG_MISMATCH");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_etag_outlives_a_checkpoint() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    let figure = server.figure(&world, "a").await;
    let request = pb::CheckpointWorldRequest {
        name: world.clone(),
        ..Default::default()
    };
    let mut checkpoints = server.client.checkpoints();
    let kept = checkpoints
        .checkpoint_world(request)
        .await
        .unwrap()
        .into_inner();
    server.step(&world, 10).await;
    let assisted = pb::UpdateFigureRequest {
        figure: Some(pb::Figure {
            name: figure.name.clone(),
            assist: 1.0,
            ..Default::default()
        }),
        ..Default::default()
    };
    server
        .client
        .figures()
        .update_figure(assisted)
        .await
        .unwrap();
    assert_ne!(server.look(&figure.name).await.etag, figure.etag);
    let restore = pb::RestoreWorldRequest {
        name: world.clone(),
        source: Some(pb::restore_world_request::Source::Checkpoint(
            kept.checkpoint.unwrap().name,
        )),
        ..Default::default()
    };
    checkpoints.restore_world(restore).await.unwrap();
    let back = server.look(&figure.name).await;
    assert_eq!((back.assist, &back.etag), (0.0, &figure.etag));
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_mask_says_what_an_update_takes() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    let mut worlds = server.client.worlds();
    let given = pb::World {
        name: world.clone(),
        display_name: "studio".into(),
        speed: 2.0,
        rate_hz: 240.0, // set at creation: not taken
        tick: 99,       // set by the server
        ..Default::default()
    };
    let update = |update_mask| pb::UpdateWorldRequest {
        world: Some(given.clone()),
        update_mask,
        ..Default::default()
    };
    let mut set = async |update_mask| {
        let updated = worlds.update_world(update(update_mask)).await;
        updated.map(|r| r.into_inner().world.unwrap())
    };
    let now = set(mask(&["speed", "tick", "etag"])).await.unwrap();
    assert_eq!((now.speed, now.display_name.as_str()), (2.0, ""));
    for empty in [None, mask(&[])] {
        let now = set(empty).await.unwrap();
        assert_eq!((now.speed, now.display_name.as_str()), (2.0, "studio"));
        assert_eq!((now.rate_hz, now.tick), (60.0, 0));
    }
    for (paths, at) in [
        (&["rate_hz"][..], 0),
        (&["speed", "colour"], 1),
        (&["*", "speed"], 0),
    ] {
        let (code, _, field) = refusal(&set(mask(paths)).await.unwrap_err());
        assert_eq!(code, Code::InvalidArgument);
        assert_eq!(field, format!("update_mask.paths[{at}]"));
    }
    // All fields: those not given get their default.
    let all = pb::UpdateWorldRequest {
        world: Some(pb::World {
            name: world.clone(),
            ..Default::default()
        }),
        update_mask: mask(&["*"]),
        ..Default::default()
    };
    let now = server.client.worlds().update_world(all).await.unwrap();
    let now = now.into_inner().world.unwrap();
    assert_eq!((now.speed, now.display_name.as_str()), (1.0, ""));
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn trying_out_answers_and_changes_nothing() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    let figure = server.figure(&world, "a").await;
    let ball = server.ball(&world, "ball").await;
    let hash = server.step(&world, 1).await.state_hash;
    let c = &server.client;

    let create = |id: &str| pb::CreateWorldRequest {
        world_id: id.into(),
        world: Some(pb::World {
            rate_hz: 120.0,
            ..Default::default()
        }),
        validate_only: true,
        ..Default::default()
    };
    let made = c.worlds().create_world(create("x")).await.unwrap();
    let made = made.into_inner().world.unwrap();
    assert_eq!((made.name.as_str(), made.rate_hz), ("worlds/x", 120.0));
    let taken = c.worlds().create_world(create("w")).await.unwrap_err();
    assert_eq!(taken.code(), Code::AlreadyExists);
    assert_eq!(server.worlds().await, std::slice::from_ref(&world));

    let create = |id: &str, height_m| pb::CreateFigureRequest {
        parent: world.clone(),
        figure_id: id.into(),
        figure: Some(pb::Figure {
            profile: Some(pb::BodyProfile {
                sex: pb::Sex::Female.into(),
                age_years: 30.0,
                height_m,
                ..Default::default()
            }),
            ..Default::default()
        }),
        validate_only: true,
        ..Default::default()
    };
    let made = c.figures().create_figure(create("", 1.7)).await.unwrap();
    let made = made.into_inner().figure.unwrap();
    assert_eq!(made.status.unwrap().figure_index, 1);
    let bad = c.figures().create_figure(create("", 2.9)).await;
    assert_eq!(bad.unwrap_err().code(), Code::InvalidArgument);
    let bad = c.figures().create_figure(create("a", 1.7)).await;
    assert_eq!(bad.unwrap_err().code(), Code::AlreadyExists);

    let update = pb::UpdateFigureRequest {
        figure: Some(pb::Figure {
            name: figure.name.clone(),
            assist: 0.7,
            ..Default::default()
        }),
        validate_only: true,
        ..Default::default()
    };
    let would = c.figures().update_figure(update).await.unwrap();
    let would = would.into_inner().figure.unwrap();
    assert_eq!(would.assist, 0.7);
    assert_ne!(would.etag, figure.etag);
    assert_eq!(server.look(&figure.name).await.etag, figure.etag);

    let update = pb::UpdateWorldRequest {
        world: Some(pb::World {
            name: world.clone(),
            speed: 3.0,
            ..Default::default()
        }),
        validate_only: true,
        ..Default::default()
    };
    let would = c.worlds().update_world(update).await.unwrap();
    assert_eq!(would.into_inner().world.unwrap().speed, 3.0);
    assert_eq!(server.get_world(&world).await.speed, 1.0);

    let update = pb::UpdateObstacleRequest {
        obstacle: Some(pb::Obstacle {
            name: ball.name.clone(),
            mass_kg: 9.0,
            ..Default::default()
        }),
        validate_only: true,
        ..Default::default()
    };
    let would = c.obstacles().update_obstacle(update).await.unwrap();
    assert_eq!(would.into_inner().obstacle.unwrap().mass_kg, 9.0);
    let create = pb::CreateObstacleRequest {
        parent: world.clone(),
        obstacle: Some(self::ball()),
        validate_only: true,
        ..Default::default()
    };
    let would = c.obstacles().create_obstacle(create).await.unwrap();
    assert!(
        would
            .into_inner()
            .obstacle
            .unwrap()
            .name
            .ends_with("/obstacle-2")
    );

    let push = |figure: &str| pb::ApplyPerturbationsRequest {
        world: world.clone(),
        perturbations: vec![pb::Perturbation {
            figure_id: figure.into(),
            tick: None,
            kind: Some(pb::perturbation::Kind::Impulse(pb::Impulse {
                segment: "chest".into(),
                impulse_newton_seconds: Some(pb::Vector3 {
                    x: 90.0,
                    y: 0.0,
                    z: 0.0,
                }),
                ..Default::default()
            })),
        }],
        validate_only: true,
        ..Default::default()
    };
    let tick = c.perturbations().apply_perturbations(push("a")).await;
    assert_eq!(tick.unwrap().into_inner().tick, 1);
    let none = c.perturbations().apply_perturbations(push("zz")).await;
    assert_eq!(none.unwrap_err().code(), Code::NotFound);

    let clip = |frames: usize| pb::CreateClipRequest {
        clip_id: "raised".into(),
        source: Some(pb::create_clip_request::Source::Frames(pb::FrameSource {
            rate_hz: 60.0,
            frames: (0..frames as i64).flat_map(lifted).collect(),
        })),
        validate_only: true,
        ..Default::default()
    };
    let would = c.motions().create_clip(clip(60)).await.unwrap();
    let would = would.into_inner().clip.unwrap();
    assert_eq!((would.frame_count, would.forecast.is_some()), (60, true));
    let bad = c.motions().create_clip(clip(1)).await.unwrap_err();
    assert_eq!(bad.code(), Code::InvalidArgument);
    let get = pb::GetClipRequest {
        name: "clips/raised".into(),
    };
    assert_eq!(
        c.motions().get_clip(get).await.unwrap_err().code(),
        Code::NotFound
    );

    // None of the trials has left a trace in the state.
    let twin = server.paused_world("twin").await;
    server.figure(&twin, "a").await;
    server.ball(&twin, "ball").await;
    assert_eq!(server.step(&twin, 1).await.state_hash, hash);
    assert_eq!(
        server.step(&world, 30).await.state_hash,
        server.step(&twin, 30).await.state_hash
    );
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn lists_come_in_pages_with_opaque_tokens() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    for id in ["c", "a", "b"] {
        server.ball(&world, id).await;
    }
    let mut obstacles = server.client.obstacles();
    let mut list = async |page_size, page_token: &str| {
        let request = pb::ListObstaclesRequest {
            parent: world.clone(),
            page_size,
            page_token: page_token.into(),
        };
        obstacles.list_obstacles(request).await.map(|r| {
            let r = r.into_inner();
            let last = |o: &pb::Obstacle| o.name.rsplit('/').next().unwrap().to_owned();
            let names: Vec<_> = r.obstacles.iter().map(last).collect();
            (names.join(""), r.next_page_token)
        })
    };
    let (first, token) = list(2, "").await.unwrap();
    assert_eq!(first, "ca", "in the order they were added");
    assert!(!token.is_empty() && !token.contains('a'.to_string().repeat(3).as_str()));
    let (rest, end) = list(2, &token).await.unwrap();
    assert_eq!((rest.as_str(), end.as_str()), ("b", ""));
    assert_eq!(list(0, "").await.unwrap().0, "cab");
    assert_eq!(list(i32::MAX, "").await.unwrap().0, "cab");
    let refused = list(-1, "").await.unwrap_err();
    assert_eq!(refusal(&refused).2, "page_size");
    for bad in ["a", "00000000000000000000000000000000", "ä"] {
        let refused = list(2, bad).await.unwrap_err();
        assert_eq!(refusal(&refused).2, "page_token", "{bad}");
    }
    // A token of another list.
    let figures = pb::ListFiguresRequest {
        parent: world.clone(),
        page_size: 1,
        page_token: token,
    };
    let refused = server.client.figures().list_figures(figures).await;
    assert_eq!(refusal(&refused.unwrap_err()).2, "page_token");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_world_that_nobody_uses_ends_and_says_so() {
    let server = TestServer::start().await;
    let ttl = |seconds| pb::World {
        idle_ttl: Some(prost_types::Duration { seconds, nanos: 0 }),
        ..Default::default()
    };
    let refused = server
        .client
        .worlds()
        .create_world(pb::CreateWorldRequest {
            world: Some(ttl(-1)),
            ..Default::default()
        })
        .await;
    assert_eq!(refusal(&refused.unwrap_err()).2, "world.idle_ttl");
    let lasting = server.paused_world("lasting").await;
    let watched = server.world("watched", false, ttl(1)).await;
    let driven = server.world("driven", true, ttl(1)).await;
    server.figure(&driven, "a").await;
    let asked = server.world("asked", true, ttl(1)).await;
    let idle = server.world("idle", false, ttl(1)).await;
    let got = server.get_world(&idle).await.idle_ttl;
    assert_eq!(got.unwrap().seconds, 1);

    let request = pb::WatchEventsRequest {
        world: watched.clone(),
        ..Default::default()
    };
    let mut states = server.client.states();
    let mut events = states.watch_events(request).await.unwrap().into_inner();
    events.message().await.unwrap();
    let drive = server
        .client
        .drive(header(&driven, "a", "me"))
        .await
        .unwrap();
    let begun = Instant::now();
    let mut left = server.worlds().await;
    while left.contains(&idle) || begun.elapsed() < Duration::from_secs(3) {
        assert!(begun.elapsed() < Duration::from_secs(30), "{left:?}");
        tokio::time::sleep(Duration::from_millis(100)).await;
        server.get_world(&asked).await; // lists do not count as use, single requests do
        left = server.worlds().await;
    }
    assert_eq!(left, [asked, driven.clone(), lasting, watched.clone()]);

    // The streams end, and their worlds after them. The deleter of a world is told.
    let delete = pb::DeleteWorldRequest {
        name: watched.clone(),
        ..Default::default()
    };
    server.client.worlds().delete_world(delete).await.unwrap();
    let last = events.message().await.unwrap().unwrap().events;
    let last = last.last().unwrap();
    assert_eq!(last.r#type(), pb::EventType::WorldDeleted);
    assert_eq!(last.detail, "anonymous");
    let end = events.message().await.unwrap_err();
    assert_eq!(end.code(), Code::NotFound);
    drop(drive);
    let begun = Instant::now();
    while server.worlds().await.contains(&driven) {
        assert!(begun.elapsed() < Duration::from_secs(30));
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_etag_outlives_the_server_that_stores_its_world() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("etags");
    let _ = std::fs::remove_dir_all(&folder); // of an earlier run
    let settings = [("data_dir", folder.to_str().unwrap())];
    let server = TestServer::with(&settings).await;
    let given = pb::World {
        display_name: "studio".into(),
        idle_ttl: Some(prost_types::Duration {
            seconds: 600,
            nanos: 0,
        }),
        ..Default::default()
    };
    let world = server.world("w", true, given).await;
    let figure = server.figure(&world, "a").await;
    let ball = server.ball(&world, "ball").await;
    let before = server.get_world(&world).await;
    server.stop().await;

    let server = TestServer::with(&settings).await;
    server.app.restore().await;
    let after = server.get_world(&world).await;
    assert_eq!(
        (after.idle_ttl, &after.etag),
        (before.idle_ttl, &before.etag)
    );
    assert_eq!(server.look(&figure.name).await.etag, figure.etag);
    let get = pb::GetObstacleRequest {
        name: ball.name.clone(),
    };
    let found = server.client.obstacles().get_obstacle(get).await.unwrap();
    assert_eq!(found.into_inner().obstacle.unwrap().etag, ball.etag);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_request_that_only_tries_does_not_use_its_name_up() {
    let server = TestServer::start().await;
    let create = pb::CreateWorldRequest {
        world_id: "w".into(),
        request_id: "once".into(),
        validate_only: true,
        ..Default::default()
    };
    for _ in 0..2 {
        let tried = server.client.worlds().create_world(create.clone()).await;
        assert_eq!(tried.unwrap().into_inner().world.unwrap().name, "worlds/w");
    }
    let create = pb::CreateWorldRequest {
        validate_only: false,
        ..create
    };
    for _ in 0..2 {
        let made = server.client.worlds().create_world(create.clone()).await;
        assert_eq!(made.unwrap().into_inner().world.unwrap().name, "worlds/w");
    }
    server.stop().await;
}
