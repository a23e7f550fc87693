//! Worlds, figures, perturbations, and the pages on the port.

use crate::support::{TestServer, refusal, view};
use sinew_wire::frame::values;
use sinew_wire::pb;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tonic::Code;

#[tokio::test(flavor = "multi_thread")]
async fn a_stepped_world_is_exact_and_reproducible() {
    let server = TestServer::start().await;
    let mut hashes = Vec::new();
    for id in ["one", "two"] {
        let world = server.paused_world(id).await;
        server.figure(&world, "a").await;
        server
            .play(&format!("{world}/figures/a"), "clips/wave", true)
            .await;
        let r = server.step(&world, 30).await;
        assert_eq!((r.tick, r.time_s), (30, 0.5));
        hashes.push(r.state_hash);
        let frame = server.frame(&world, &["*"]).await;
        assert_eq!(frame.tick, 30);
        assert_eq!(frame.state_hash, r.state_hash);
        let f = &frame.figures[0];
        assert_eq!(values(f.joint_angles.as_ref().unwrap()).len(), 39);
        assert_eq!(values(f.joint_rotations.as_ref().unwrap()).len(), 68);
        assert_eq!(values(f.segment_transforms.as_ref().unwrap()).len(), 126);
        assert_eq!(values(f.positions.as_ref().unwrap()).len(), 55);
        assert_eq!(values(f.torque_limits.as_ref().unwrap()).len(), 78);
        let audit = f.audit.as_ref().unwrap();
        assert_eq!(values(audit.acceleration.as_ref().unwrap()).len(), 45);
        assert!(
            !f.contacts.as_ref().unwrap().segment.is_empty(),
            "it stands"
        );
    }
    assert_eq!(hashes[0], hashes[1], "equal inputs by tick, equal bits");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_clock_runs_pauses_resumes_and_changes_speed() {
    let server = TestServer::start().await;
    let world = server.world("w", false, pb::World::default()).await;
    let mut frames = server
        .client
        .watch(&world, view(&["root_pose"]), None)
        .await
        .unwrap();
    for _ in 0..5 {
        frames.message().await.unwrap().unwrap();
    }
    let mut worlds = server.client.worlds();
    let name = || world.clone();
    let paused = worlds
        .pause_world(pb::PauseWorldRequest { name: name() })
        .await
        .unwrap()
        .into_inner()
        .world
        .unwrap();
    assert_eq!(paused.state(), pb::WorldState::Paused);
    assert!(paused.tick > 0);
    let again = worlds
        .get_world(pb::GetWorldRequest { name: name() })
        .await
        .unwrap()
        .into_inner()
        .world
        .unwrap();
    assert_eq!(again.tick, paused.tick, "a paused clock stands still");
    assert_eq!(server.step(&world, 3).await.tick, paused.tick + 3);
    worlds
        .resume_world(pb::ResumeWorldRequest { name: name() })
        .await
        .unwrap();
    let e = worlds
        .step_world(pb::StepWorldRequest {
            name: name(),
            tick_count: 1,
            ..Default::default()
        })
        .await
        .unwrap_err();
    let (code, reason, _) = refusal(&e);
    assert_eq!(
        (code, reason.as_str()),
        (Code::FailedPrecondition, "WORLD_NOT_PAUSED")
    );
    let fast = worlds
        .set_world_speed(pb::SetWorldSpeedRequest {
            name: name(),
            speed: 2.0,
        })
        .await
        .unwrap()
        .into_inner()
        .world
        .unwrap();
    assert_eq!(fast.speed, 2.0);
    let updated = worlds
        .update_world(pb::UpdateWorldRequest {
            world: Some(pb::World {
                name: name(),
                overrun_policy: pb::OverrunPolicy::Dilate.into(),
                display_name: "Stage".into(),
                ..Default::default()
            }),
            update_mask: Some(prost_types::FieldMask {
                paths: vec!["overrun_policy".into(), "display_name".into()],
            }),
            ..Default::default()
        })
        .await
        .unwrap()
        .into_inner()
        .world
        .unwrap();
    assert_eq!(updated.overrun_policy(), pb::OverrunPolicy::Dilate);
    assert_eq!(
        (updated.display_name.as_str(), updated.speed),
        ("Stage", 2.0)
    );
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn figures_come_change_and_go() {
    let server = TestServer::with(&[("max_figures_per_world", "2")]).await;
    let world = server.paused_world("w").await;
    let mut figures = server.client.figures();
    let made = figures
        .create_figure(pb::CreateFigureRequest {
            parent: world.clone(),
            figure_id: "anna".into(),
            figure: Some(pb::Figure {
                profile: Some(pb::BodyProfile {
                    sex: pb::Sex::Female.into(),
                    age_years: 25.0,
                    height_m: 1.7,
                    mass_kg: 60.0,
                }),
                strength: Some(pb::StrengthScale {
                    all: 0.8,
                    dofs: vec![pb::DofStrength {
                        dof: "r_elbow_flexion".into(),
                        factor: 0.5,
                    }],
                    ..Default::default()
                }),
                placement: Some(pb::Placement {
                    x_m: 2.0,
                    ..Default::default()
                }),
                ..Default::default()
            }),
            ..Default::default()
        })
        .await
        .unwrap()
        .into_inner()
        .figure
        .unwrap();
    assert_eq!(made.body, "bodies/female-25y-1700mm-60000g");
    assert_eq!(made.name, format!("{world}/figures/anna"));
    let body = server
        .client
        .bodies()
        .get_body(pb::GetBodyRequest {
            name: made.body.clone(),
            include_geometry: true,
            ..Default::default()
        })
        .await
        .unwrap()
        .into_inner()
        .body
        .unwrap();
    let mass: f64 = body.segments.iter().map(|s| s.mass_kg).sum();
    assert!((mass - 60.0).abs() < 1e-6);
    assert_eq!(
        (body.segments.len(), body.joints.len(), body.dofs.len()),
        (18, 18, 39)
    );
    assert!(body.segments.iter().all(|s| !s.mesh_triangles.is_empty()));

    server.figure(&world, "bert").await;
    let e = figures
        .create_figure(pb::CreateFigureRequest {
            parent: world.clone(),
            ..Default::default()
        })
        .await
        .unwrap_err();
    assert_eq!(refusal(&e).0, Code::ResourceExhausted);
    server.step(&world, 2).await;
    let f = server.frame(&world, &["root_pose"]).await;
    assert!((values(f.figures[0].root_pose.as_ref().unwrap())[0] - 2.0).abs() < 0.05);

    let weaker = figures
        .update_figure(pb::UpdateFigureRequest {
            control_token: String::new(),
            figure: Some(pb::Figure {
                name: made.name.clone(),
                controller: pb::Controller::Motors.into(),
                ..Default::default()
            }),
            update_mask: Some(prost_types::FieldMask {
                paths: vec!["controller".into()],
            }),
            ..Default::default()
        })
        .await
        .unwrap()
        .into_inner()
        .figure
        .unwrap();
    assert_eq!(weaker.controller(), pb::Controller::Motors);
    assert_eq!(
        weaker.strength.unwrap().all,
        0.8,
        "what the mask leaves out stays"
    );
    figures
        .delete_figure(pb::DeleteFigureRequest {
            name: made.name.clone(),
            ..Default::default()
        })
        .await
        .unwrap();
    let left = figures
        .list_figures(pb::ListFiguresRequest {
            parent: world.clone(),
            ..Default::default()
        })
        .await
        .unwrap()
        .into_inner()
        .figures;
    assert_eq!(left.len(), 1);
    assert_eq!(
        left[0].status.as_ref().unwrap().figure_index,
        1,
        "indices are not used again"
    );
    server.stop().await;
}

/// A lift that is too much for one arm: the other hand helps, and events and frames show it.
#[tokio::test(flavor = "multi_thread")]
async fn the_other_hand_helps_with_a_load_that_asks_for_it() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    server
        .play(&format!("{world}/figures/a"), "clips/lift", true)
        .await;
    let watch = pb::WatchEventsRequest {
        world: world.clone(),
        types: vec![pb::EventType::LoadShared.into()],
        ..Default::default()
    };
    let mut states = server.client.states();
    let mut events = states.watch_events(watch).await.unwrap().into_inner();
    assert!(events.message().await.unwrap().unwrap().events.is_empty());
    let load = |segment: &str, two_hands: pb::TwoHands, tick| pb::Perturbation {
        figure_id: "a".into(),
        tick: Some(tick),
        kind: Some(pb::perturbation::Kind::Load(pb::Load {
            segment: segment.into(),
            mass_kg: 14.0,
            two_hands: two_hands.into(),
            duration_s: 4.0,
            ..Default::default()
        })),
    };
    let asked = |perturbations: Vec<pb::Perturbation>| pb::ApplyPerturbationsRequest {
        world: world.clone(),
        perturbations,
        ..Default::default()
    };
    let mut perturbations = server.client.perturbations();
    // All or nothing: a hand that is given a load in the same batch cannot help.
    let both = vec![
        load("l_hand", pb::TwoHands::Never, 102),
        load("r_hand", pb::TwoHands::Auto, 102),
    ];
    let e = perturbations.apply_perturbations(asked(both)).await;
    let (code, reason, _) = refusal(&e.unwrap_err());
    assert_eq!(
        (code, reason.as_str()),
        (Code::FailedPrecondition, "OTHER_HAND_HOLDS_LOAD")
    );
    let alone = vec![load("r_hand", pb::TwoHands::Auto, 102)];
    perturbations
        .apply_perturbations(asked(alone))
        .await
        .unwrap();
    server.step(&world, 240).await;
    let e = events.message().await.unwrap().unwrap().events.remove(0);
    assert_eq!(
        (e.segment.as_str(), e.other_segment.as_str(), e.mass_kg),
        ("r_hand", "l_hand", 14.0)
    );
    assert!(e.need_alone > 1.0 && e.need_shared < e.need_alone, "{e:?}");
    let frame = server.frame(&world, &["status", "audit"]).await;
    let f = &frame.figures[0];
    let loads = &f.status.as_ref().unwrap().loads;
    assert_eq!(loads, &f.audit.as_ref().unwrap().loads);
    assert_eq!(loads.len(), 2);
    let sum: f64 = loads.iter().map(|l| l.mass_kg).sum();
    assert!(
        (sum - 14.0).abs() < 1e-9 && loads[1].mass_kg > 2.0,
        "{loads:?}"
    );
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn loads_and_pushes_act_at_their_tick() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let perturb = |p: pb::Perturbation| pb::ApplyPerturbationsRequest {
        world: world.clone(),
        perturbations: vec![p],
        ..Default::default()
    };
    let load = pb::Perturbation {
        figure_id: "a".into(),
        tick: Some(5),
        kind: Some(pb::perturbation::Kind::Load(pb::Load {
            segment: "r_hand".into(),
            mass_kg: 3.0,
            duration_s: 5.0 / 60.0,
            ..Default::default()
        })),
    };
    let mut perturbations = server.client.perturbations();
    let at = perturbations
        .apply_perturbations(perturb(load))
        .await
        .unwrap()
        .into_inner();
    assert_eq!(at.tick, 0);
    let mut carried = Vec::new();
    for _ in 0..12 {
        server.step(&world, 1).await;
        let frame = server.frame(&world, &["status", "audit"]).await;
        let f = &frame.figures[0];
        let loads = &f.status.as_ref().unwrap().loads;
        assert_eq!(loads, &f.audit.as_ref().unwrap().loads);
        carried.push(loads.iter().map(|l| l.mass_kg).sum::<f64>());
    }
    let expected: Vec<f64> = (0..12)
        .map(|i| if (5..10).contains(&i) { 3.0 } else { 0.0 })
        .collect();
    assert_eq!(carried, expected);

    let push = pb::Perturbation {
        figure_id: "a".into(),
        kind: Some(pb::perturbation::Kind::Impulse(pb::Impulse {
            segment: "chest".into(),
            impulse_newton_seconds: Some(pb::Vector3 {
                x: 5.0,
                ..Default::default()
            }),
            ..Default::default()
        })),
        tick: None,
    };
    perturbations
        .apply_perturbations(perturb(push.clone()))
        .await
        .unwrap();
    server.step(&world, 1).await;
    let frame = server.frame(&world, &["audit"]).await;
    let applied = frame.figures[0]
        .audit
        .as_ref()
        .unwrap()
        .applied
        .clone()
        .unwrap();
    let force = values(applied.force.as_ref().unwrap());
    assert!(
        (force[0] - 50.0).abs() < 1e-9 && force[1..] == [0.0, 0.0],
        "5 N·s over 0.1 s: {force:?}"
    );

    // A bad entry in a batch leaves the good ones out as well.
    let mut batch = perturb(push.clone());
    batch.perturbations.push(pb::Perturbation {
        tick: Some(1),
        ..push
    });
    perturbations
        .clear_perturbations(pb::ClearPerturbationsRequest {
            figure: format!("{world}/figures/a"),
            ..Default::default()
        })
        .await
        .unwrap();
    let e = perturbations.apply_perturbations(batch).await.unwrap_err();
    assert_eq!(refusal(&e).2, "perturbations[1].tick");
    server.step(&world, 1).await;
    let frame = server.frame(&world, &["audit"]).await;
    let applied = frame.figures[0]
        .audit
        .as_ref()
        .unwrap()
        .applied
        .clone()
        .unwrap();
    assert!(applied.segment.is_empty(), "nothing acts");
    server.stop().await;
}

async fn http(address: std::net::SocketAddr, request: &str) -> String {
    let mut stream = tokio::net::TcpStream::connect(address).await.unwrap();
    stream.write_all(request.as_bytes()).await.unwrap();
    let mut out = Vec::new();
    stream.read_to_end(&mut out).await.unwrap();
    String::from_utf8_lossy(&out).into_owned()
}

#[tokio::test(flavor = "multi_thread")]
async fn one_port_has_pages_metrics_health_reflection_and_grpc_web() {
    let server = TestServer::start().await;
    let world = server.paused_world("shown").await;
    server.figure(&world, "a").await;
    server.step(&world, 1).await;
    let get =
        |path: &str| format!("GET {path} HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n\r\n");
    let page = http(server.address, &get("/status")).await;
    assert!(page.starts_with("HTTP/1.1 200") && page.contains("worlds/shown"));
    let viewer = http(server.address, &get("/")).await;
    assert!(
        viewer.starts_with("HTTP/1.1 200")
            && viewer.contains("content-security-policy: default-src 'none'; script-src 'self'")
    );
    for (file, kind) in [
        ("/viewer.js", "text/javascript"),
        ("/viewer.css", "text/css"),
    ] {
        assert!(
            http(server.address, &get(file))
                .await
                .contains(&format!("content-type: {kind}"))
        );
    }
    let metrics = http(server.address, &get("/metrics")).await;
    assert!(metrics.contains("sinew_ticks_total"), "{metrics}");
    assert!(
        http(server.address, &get("/nothing"))
            .await
            .starts_with("HTTP/1.1 404")
    );

    // gRPC-Web: an empty message to GetServerInfo.
    let request = "POST /sinew.v1.ServerService/GetServerInfo HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n\
        content-type: application/grpc-web+proto\r\nx-grpc-web: 1\r\norigin: http://localhost:5173\r\n\
        content-length: 5\r\n\r\n\0\0\0\0\0";
    let answer = http(server.address, request).await;
    assert!(answer.contains("grpc-status:0"), "{answer}");
    assert!(answer.contains("access-control-allow-origin: http://localhost:5173"));
    let foreign = http(
        server.address,
        &request.replace("localhost:5173", "evil.example"),
    )
    .await;
    assert!(!foreign.contains("access-control-allow-origin"));

    let channel = tonic::transport::Endpoint::from_shared(format!("http://{}", server.address))
        .unwrap()
        .connect()
        .await
        .unwrap();
    for service in sinew_server::api::SERVICE_NAMES {
        let status = tonic_health::pb::health_client::HealthClient::new(channel.clone())
            .check(tonic_health::pb::HealthCheckRequest {
                service: service.into(),
            })
            .await
            .unwrap()
            .into_inner();
        assert_eq!(
            status.status(),
            tonic_health::pb::health_check_response::ServingStatus::Serving
        );
    }
    use tonic_reflection::pb::v1::{
        ServerReflectionRequest, server_reflection_client::ServerReflectionClient,
        server_reflection_request::MessageRequest, server_reflection_response::MessageResponse,
    };
    let request = ServerReflectionRequest {
        host: String::new(),
        message_request: Some(MessageRequest::ListServices(String::new())),
    };
    let reply = ServerReflectionClient::new(channel.clone())
        .server_reflection_info(tokio_stream::iter([request]))
        .await
        .unwrap()
        .into_inner()
        .message()
        .await
        .unwrap()
        .unwrap();
    let Some(MessageResponse::ListServicesResponse(list)) = reply.message_response else {
        panic!("no list");
    };
    assert_eq!(
        list.service
            .iter()
            .filter(|s| s.name.starts_with("sinew.v1."))
            .count(),
        15
    );
    // The types in errors are described, too.
    for file in ["google/rpc/error_details.proto", "sinew/v1/operation.proto"] {
        let request = ServerReflectionRequest {
            host: String::new(),
            message_request: Some(MessageRequest::FileByFilename(file.into())),
        };
        let reply = ServerReflectionClient::new(channel.clone())
            .server_reflection_info(tokio_stream::iter([request]))
            .await
            .unwrap()
            .into_inner()
            .message()
            .await
            .unwrap()
            .unwrap();
        let found = matches!(
            reply.message_response,
            Some(MessageResponse::FileDescriptorResponse(f)) if !f.file_descriptor_proto.is_empty()
        );
        assert!(found, "{file}");
    }

    // A service that does not exist is a gRPC answer, not an HTTP one.
    let mut unknown = tonic::client::Grpc::new(channel);
    unknown.ready().await.unwrap();
    let codec =
        tonic_prost::ProstCodec::<pb::GetServerInfoRequest, pb::GetServerInfoResponse>::default();
    let e = unknown
        .unary(
            tonic::Request::new(pb::GetServerInfoRequest {}),
            http::uri::PathAndQuery::from_static("/sinew.v9.X/Y"),
            codec,
        )
        .await
        .unwrap_err();
    assert_eq!(e.code(), Code::Unimplemented);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn info_and_stats_say_what_the_server_does() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    server.step(&world, 20).await;
    let info = server
        .client
        .server()
        .get_server_info(pb::GetServerInfoRequest {})
        .await
        .unwrap()
        .into_inner();
    assert!(
        info.limits
            .iter()
            .any(|l| l.name == "max_worlds" && l.value == 1024)
    );
    assert!(info.builtin_clips.contains(&"clips/wave".to_owned()));
    let stats = server
        .client
        .server()
        .get_server_stats(pb::GetServerStatsRequest { world })
        .await
        .unwrap()
        .into_inner();
    let w = &stats.worlds[0];
    assert_eq!(w.tick_count, 20);
    let step = w.stages.iter().find(|s| s.stage == "step").unwrap();
    assert!(step.p50_us > 0.0 && step.p50_us <= step.p99_us);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn shutting_down_ends_streams_and_worlds() {
    let server = TestServer::start().await;
    let world = server.world("w", false, pb::World::default()).await;
    let client = server.client.clone();
    let mut frames = client
        .watch(&world, view(&["root_pose"]), None)
        .await
        .unwrap();
    frames.message().await.unwrap().unwrap();
    server.stop().await;
    let end = loop {
        match frames.message().await {
            Ok(Some(_)) => {}
            Ok(None) => panic!("ended without a reason"),
            Err(e) => break e,
        }
    };
    assert_eq!(end.code(), Code::Unavailable);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_panic_fails_its_world_and_no_other() {
    let server = TestServer::start().await;
    let broken = server.paused_world("broken").await;
    let sound = server.paused_world("sound").await;
    server.figure(&broken, "a").await;
    server.figure(&sound, "a").await;
    server.step(&broken, 3).await;
    let origin = sinew_server::tick::command::CommandOrigin {
        client: "test".into(),
        sequence: 0,
    };
    let lost = server
        .app
        .worlds
        .get("broken")
        .unwrap()
        .call::<()>(origin, |_| panic!("on purpose"))
        .await;
    assert!(lost.is_err());
    let failed = server
        .client
        .worlds()
        .get_world(pb::GetWorldRequest {
            name: broken.clone(),
        })
        .await
        .unwrap()
        .into_inner()
        .world
        .unwrap();
    assert_eq!(failed.state(), pb::WorldState::Failed);
    assert!(failed.failure.contains("on purpose"));
    assert_eq!(
        server.frame(&broken, &["root_pose"]).await.tick,
        3,
        "its last frame stays"
    );
    let e = server
        .client
        .worlds()
        .step_world(pb::StepWorldRequest {
            name: broken.clone(),
            tick_count: 1,
            ..Default::default()
        })
        .await
        .unwrap_err();
    assert_eq!(refusal(&e).1, "WORLD_FAILED");
    assert_eq!(server.step(&sound, 3).await.tick, 3);
    server
        .client
        .worlds()
        .delete_world(pb::DeleteWorldRequest {
            name: broken,
            ..Default::default()
        })
        .await
        .unwrap();
    server.stop().await;
}
