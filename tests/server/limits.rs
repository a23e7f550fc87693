//! Limits for one client, and limits of the machine.

use crate::support::{TestServer, header, refusal, view};
use sinew_client::Client;
use sinew_wire::pb;
use tonic::{Code, Status};
use tonic_types::StatusExt;

/// The limit that a refusal names.
fn limit(e: &Status) -> String {
    assert_eq!(e.code(), Code::ResourceExhausted, "{e:?}");
    let details = e.get_error_details();
    details.quota_failure().unwrap().violations[0]
        .subject
        .clone()
}

async fn create(client: &Client, id: &str) -> Result<pb::World, Status> {
    let request = pb::CreateWorldRequest {
        world_id: id.into(),
        world: None,
        paused: true,
        ..Default::default()
    };
    let created = client.worlds().create_world(request).await?;
    Ok(created.into_inner().world.unwrap())
}

#[tokio::test(flavor = "multi_thread")]
async fn one_client_leaves_half_for_others() {
    let server = TestServer::with(&[
        ("max_worlds", "4"),
        ("max_viewers", "8"),
        ("max_drivers", "2"),
        ("max_views_per_world", "4"),
    ])
    .await;
    let greedy = &server.client;
    let other = Client::connect(&server.address.to_string()).await.unwrap();
    let world = create(greedy, "a").await.unwrap().name;
    create(greedy, "b").await.unwrap();
    assert_eq!(limit(&create(greedy, "c").await.unwrap_err()), "max_worlds");
    create(&other, "c").await.unwrap();

    server.figure(&world, "x").await;
    server.figure(&world, "y").await;
    let _held = greedy.drive(header(&world, "x", "g")).await.unwrap();
    let refused = greedy.drive(header(&world, "y", "h")).await.unwrap_err();
    assert_eq!(limit(&refused), "max_drivers");
    let _other = other.drive(header(&world, "y", "h")).await.unwrap();

    // Two different views are allowed, but no third; a shared view costs nothing.
    let watch = |c: &Client, fields: &'static [&'static str]| {
        let (c, world) = (c.clone(), world.clone());
        async move { c.watch(&world, view(fields), None).await }
    };
    let _one = watch(greedy, &["torque"]).await.unwrap();
    let _two = watch(greedy, &["status"]).await.unwrap();
    let refused = watch(greedy, &["velocity"]).await.unwrap_err();
    assert_eq!(limit(&refused), "max_views_per_world");
    let _same = watch(greedy, &["torque"]).await.unwrap();
    let _others = watch(&other, &["velocity"]).await.unwrap();
    let _last = watch(greedy, &["velocity"]).await.unwrap();
    // Four streams are half of eight.
    let refused = watch(greedy, &["torque"]).await.unwrap_err();
    assert_eq!(limit(&refused), "max_viewers");
    let _more = watch(&other, &["torque"]).await.unwrap();
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_the_machine_cannot_bear_is_refused_before_it_is_done() {
    let server = TestServer::with(&[("max_tick_budget", "0.7")]).await;
    let mut worlds = server.client.worlds();
    let fast = pb::World {
        rate_hz: 1000.0,
        substep_count: 16,
        speed: 10.0,
        ..Default::default()
    };
    let world = server.world("fast", false, fast).await;
    let figure = || pb::CreateFigureRequest {
        parent: world.clone(),
        ..Default::default()
    };
    let mut figures = server.client.figures();
    let refused = figures.create_figure(figure()).await.unwrap_err();
    assert_eq!(limit(&refused), "max_tick_budget");
    assert_eq!(refusal(&refused).1, "TICK_BUDGET");
    let details = refused.get_error_details();
    let facts = &details.error_info().unwrap().metadata;
    let percent = |key: &str| facts[key].parse::<f64>().unwrap();
    assert!(percent("needed_percent") > 300.0, "{facts:?}");
    assert_eq!(percent("limit_percent"), 70.0);
    // A stopped clock costs nothing until it should run.
    let name = world.clone();
    worlds
        .pause_world(pb::PauseWorldRequest { name })
        .await
        .unwrap();
    figures.create_figure(figure()).await.unwrap();
    let name = world.clone();
    let resume = worlds.resume_world(pb::ResumeWorldRequest { name }).await;
    assert_eq!(refusal(&resume.unwrap_err()).1, "TICK_BUDGET");
    let name = world.clone();
    let got = worlds.get_world(pb::GetWorldRequest { name }).await;
    let state = got.unwrap().into_inner().world.unwrap().state();
    assert_eq!(state, pb::WorldState::Paused, "a refusal changes nothing");
    // An ordinary world fits, but its clock may not be set to a rate that does not.
    let slow = pb::World {
        substep_count: 16,
        ..Default::default()
    };
    let world = server.world("slow", false, slow).await;
    let mut made = 0;
    let refused = loop {
        let request = pb::CreateFigureRequest {
            parent: world.clone(),
            ..Default::default()
        };
        match figures.create_figure(request).await {
            Ok(_) => made += 1,
            Err(e) => break refusal(&e).1,
        }
    };
    assert!(made > 0 && refused == "TICK_BUDGET", "{made}, {refused}");
    let name = world.clone();
    let faster = pb::SetWorldSpeedRequest { name, speed: 10.0 };
    let refused = worlds.set_world_speed(faster).await.unwrap_err();
    assert_eq!(refusal(&refused).1, "TICK_BUDGET");
    let mut client = server.client.server();
    let stats = client
        .get_server_stats(pb::GetServerStatsRequest::default())
        .await
        .unwrap()
        .into_inner();
    assert_eq!(stats.budget_limit, 0.7);
    assert!(stats.budget_used > 0.0, "{stats:?}");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_budget_that_is_shown_counts_the_speed() {
    let server = TestServer::start().await;
    let world = server.world("w", false, pb::World::default()).await;
    server.figure(&world, "a").await;
    let used = || async {
        let request = pb::GetServerStatsRequest {
            world: world.clone(),
        };
        let stats = server.client.server().get_server_stats(request).await;
        let w = stats.unwrap().into_inner().worlds.remove(0);
        let total = w.stages.iter().find(|s| s.stage == "total").unwrap().p99_us;
        (w.budget_used, total * 1e-6 * 60.0)
    };
    while used().await.1 == 0.0 {
        tokio::task::yield_now().await;
    }
    let (shown, share) = used().await;
    assert!((shown / share - 1.0).abs() < 1e-9);
    let name = world.clone();
    let speed = pb::SetWorldSpeedRequest { name, speed: 5.0 };
    server.client.worlds().set_world_speed(speed).await.unwrap();
    let (shown, share) = used().await;
    assert!((shown / share - 5.0).abs() < 1e-9, "{shown} of {share}");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn fields_outside_the_mask_are_ignored_whatever_they_hold() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    let made = server.figure(&world, "a").await;
    let request = pb::UpdateFigureRequest {
        control_token: String::new(),
        figure: Some(pb::Figure {
            name: made.name.clone(),
            display_name: "Anna".into(),
            assist: f64::NAN,
            fatigue_time_scale: f64::INFINITY,
            placement: Some(pb::Placement {
                x_m: f64::NAN,
                ..Default::default()
            }),
            ..Default::default()
        }),
        update_mask: Some(prost_types::FieldMask {
            paths: vec!["display_name".into()],
        }),
        ..Default::default()
    };
    let updated = server.client.figures().update_figure(request).await;
    let updated = updated.unwrap().into_inner().figure.unwrap();
    assert_ne!(updated.etag, made.etag);
    let expected = pb::Figure {
        display_name: "Anna".into(),
        etag: updated.etag.clone(),
        ..made
    };
    assert_eq!(updated, expected);
    server.stop().await;
}

/// A clip of 1000 frames and its preparation are 1.6 MB; prepared for a second body they are 2.9 MB.
#[tokio::test(flavor = "multi_thread")]
async fn prepared_clips_count_as_stored_bytes() {
    let server = TestServer::with(&[
        ("max_clip_total_bytes", "2500000"),
        // A world could play a clip again from its memory.
        ("memory_s", "0"),
    ])
    .await;
    let world = server.paused_world("w").await;
    let figure = |id: &str, body: &str| pb::CreateFigureRequest {
        parent: world.clone(),
        figure_id: id.into(),
        figure: Some(pb::Figure {
            body: format!("bodies/{body}"),
            ..Default::default()
        }),
        ..Default::default()
    };
    let mut figures = server.client.figures();
    let man = figures.create_figure(figure("a", "adult-man")).await;
    man.unwrap();
    let woman = figures.create_figure(figure("b", "adult-woman")).await;
    woman.unwrap();
    let frame = pb::FigureMotion {
        root: Some(pb::Pose::default()),
        joint_angles_rad: vec![0.0; 39],
        planted: vec![true, true],
        ..Default::default()
    };
    let request = pb::CreateClipRequest {
        clip_id: "still".into(),
        source: Some(pb::create_clip_request::Source::Frames(pb::FrameSource {
            rate_hz: 60.0,
            frames: vec![frame; 1000],
        })),
        ..Default::default()
    };
    server.client.motions().create_clip(request).await.unwrap();
    let play = |figure: &str| pb::PlayClipRequest {
        figure: format!("{world}/figures/{figure}"),
        clip: "clips/still".into(),
        reset: true,
        ..Default::default()
    };
    let mut motions = server.client.motions();
    motions.play_clip(play("a")).await.unwrap();
    // The first figure plays its preparation, so it stays, and there is no room for one more.
    let refused = motions.play_clip(play("b")).await.unwrap_err();
    assert_eq!(limit(&refused), "max_clip_total_bytes");
    let name = format!("{world}/figures/a");
    figures
        .delete_figure(pb::DeleteFigureRequest {
            name,
            ..Default::default()
        })
        .await
        .unwrap();
    motions.play_clip(play("b")).await.unwrap();
    server.stop().await;
}
