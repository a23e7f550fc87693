//! Bad input is refused with the right code and the path of the field, and changes nothing.

use crate::support::{TestServer, arm_frame, header, refusal, view};
use sinew_wire::pb;
use tonic::{Code, Status};

fn expect(status: Status, code: Code, field: &str) {
    let (c, _, f) = refusal(&status);
    assert_eq!((c, f.as_str()), (code, field), "{status:?}");
}

/// A server with the paused world `w` and the figure `a`, and its state before the requests that it refuses.
struct Asked {
    server: TestServer,
    world: String,
    before: pb::StepWorldResponse,
}

impl Asked {
    async fn new() -> Self {
        let server = TestServer::with(&[
            ("max_worlds", "2"),
            ("max_client_share", "1"),
            ("max_clip_bytes", "65536"),
        ])
        .await;
        let world = server.paused_world("w").await;
        server.figure(&world, "a").await;
        let before = server.step(&world, 1).await;
        Self {
            server,
            world,
            before,
        }
    }

    /// Nothing changed: the same tick, state, figures and clips.
    async fn unchanged(self) {
        let after = self.server.frame(&self.world, &["root_pose"]).await;
        assert_eq!(
            (after.tick, after.state_hash),
            (self.before.tick, self.before.state_hash)
        );
        assert_eq!(after.figures.len(), 1);
        let worlds = self
            .server
            .client
            .worlds()
            .list_worlds(pb::ListWorldsRequest::default())
            .await
            .unwrap()
            .into_inner()
            .worlds;
        assert_eq!(worlds.len(), 1);
        self.server.stop().await;
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn bad_worlds_are_refused() {
    let asked = Asked::new().await;
    let c = &asked.server.client;
    let create = |world_id: &str, world: pb::World| pb::CreateWorldRequest {
        world_id: world_id.into(),
        world: Some(world),
        paused: true,
        ..Default::default()
    };
    for (request, code, field) in [
        (
            create("Ü", pb::World::default()),
            Code::InvalidArgument,
            "world_id",
        ),
        (create("w", pb::World::default()), Code::AlreadyExists, ""),
        (
            create(
                "x",
                pb::World {
                    rate_hz: f64::NAN,
                    ..Default::default()
                },
            ),
            Code::InvalidArgument,
            "world.rate_hz",
        ),
        (
            create(
                "x",
                pb::World {
                    rate_hz: 5000.0,
                    ..Default::default()
                },
            ),
            Code::InvalidArgument,
            "world.rate_hz",
        ),
        (
            create(
                "x",
                pb::World {
                    substep_count: -1,
                    ..Default::default()
                },
            ),
            Code::InvalidArgument,
            "world.substep_count",
        ),
        (
            create(
                "x",
                pb::World {
                    gravity_mps2: Some(f64::INFINITY),
                    ..Default::default()
                },
            ),
            Code::InvalidArgument,
            "world.gravity_mps2",
        ),
        (
            create(
                "x",
                pb::World {
                    overrun_policy: 77,
                    ..Default::default()
                },
            ),
            Code::InvalidArgument,
            "world.overrun_policy",
        ),
    ] {
        expect(
            c.worlds().create_world(request).await.unwrap_err(),
            code,
            field,
        );
    }
    asked.unchanged().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn bad_steps_are_refused() {
    let asked = Asked::new().await;
    let world = &asked.world;
    let c = &asked.server.client;
    let step = |name: &str, tick_count| pb::StepWorldRequest {
        name: name.into(),
        tick_count,
        ..Default::default()
    };
    for (request, code, field) in [
        (step("w", 1), Code::InvalidArgument, "name"),
        (step("worlds/none", 1), Code::NotFound, ""),
        (step(world, -1), Code::InvalidArgument, "tick_count"),
        (step(world, 10_001), Code::InvalidArgument, "tick_count"),
    ] {
        expect(
            c.worlds().step_world(request).await.unwrap_err(),
            code,
            field,
        );
    }
    asked.unchanged().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn bad_figures_are_refused() {
    let asked = Asked::new().await;
    let world = &asked.world;
    let c = &asked.server.client;
    let figure = |figure: pb::Figure| pb::CreateFigureRequest {
        parent: world.clone(),
        figure_id: "b".into(),
        figure: Some(figure),
        ..Default::default()
    };
    let profile = |sex: pb::Sex, height_m, mass_kg| pb::Figure {
        profile: Some(pb::BodyProfile {
            sex: sex.into(),
            age_years: 30.0,
            height_m,
            mass_kg,
        }),
        ..Default::default()
    };
    let strength = |all, dof: &str, factor| pb::Figure {
        strength: Some(pb::StrengthScale {
            all,
            dofs: vec![pb::DofStrength {
                dof: dof.into(),
                factor,
            }],
            ..Default::default()
        }),
        ..Default::default()
    };
    for (request, code, field) in [
        (
            figure(profile(pb::Sex::Male, f64::NAN, 70.0)),
            Code::InvalidArgument,
            "figure.profile.height_m",
        ),
        (
            figure(profile(pb::Sex::Male, 2.9, 70.0)),
            Code::InvalidArgument,
            "figure.profile.height_m",
        ),
        (
            figure(profile(pb::Sex::Unspecified, 1.7, 70.0)),
            Code::InvalidArgument,
            "figure.profile.sex",
        ),
        (
            figure(strength(1e9, "r_elbow_flexion", 1.0)),
            Code::InvalidArgument,
            "figure.strength.all",
        ),
        (
            figure(strength(1.0, "tail_wag", 1.0)),
            Code::InvalidArgument,
            "figure.strength.dofs[0].dof",
        ),
        (
            figure(strength(1.0, "r_elbow_flexion", f64::NAN)),
            Code::InvalidArgument,
            "figure.strength.dofs[0].factor",
        ),
        (
            figure(pb::Figure {
                body: "bodies/robot".into(),
                ..Default::default()
            }),
            Code::NotFound,
            "",
        ),
        (
            figure(pb::Figure {
                controller: 99,
                ..Default::default()
            }),
            Code::InvalidArgument,
            "figure.controller",
        ),
        (
            figure(pb::Figure {
                placement: Some(pb::Placement {
                    x_m: f64::NAN,
                    ..Default::default()
                }),
                ..Default::default()
            }),
            Code::InvalidArgument,
            "figure.placement.x_m",
        ),
    ] {
        expect(
            c.figures().create_figure(request).await.unwrap_err(),
            code,
            field,
        );
    }
    asked.unchanged().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn bad_plays_are_refused() {
    let asked = Asked::new().await;
    let world = &asked.world;
    let c = &asked.server.client;
    let play = |figure: &str, clip: &str, speed| pb::PlayClipRequest {
        figure: figure.into(),
        clip: clip.into(),
        speed,
        ..Default::default()
    };
    let a = format!("{world}/figures/a");
    for (request, code, field) in [
        (
            play("a", "clips/wave", 1.0),
            Code::InvalidArgument,
            "figure",
        ),
        (
            play(&format!("{world}/figures/zz"), "clips/wave", 1.0),
            Code::NotFound,
            "",
        ),
        (play(&a, "clips/none", 1.0), Code::NotFound, ""),
        (
            play(&a, "clips/wave", f64::NAN),
            Code::InvalidArgument,
            "speed",
        ),
    ] {
        expect(
            c.motions().play_clip(request).await.unwrap_err(),
            code,
            field,
        );
    }
    asked.unchanged().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn bad_clips_are_refused() {
    let asked = Asked::new().await;
    let c = &asked.server.client;
    let clip = |source| pb::CreateClipRequest {
        clip_id: "c".into(),
        source,
        ..Default::default()
    };
    use pb::create_clip_request::Source;
    let bvh = |data: Vec<u8>, options| {
        Some(Source::Bvh(pb::BvhSource {
            data: data.into(),
            options,
        }))
    };
    for (request, code, field) in [
        (clip(None), Code::InvalidArgument, "source"),
        (clip(bvh(vec![], None)), Code::InvalidArgument, "bvh.data"),
        (
            clip(bvh(b"what is this".to_vec(), None)),
            Code::InvalidArgument,
            "bvh.data",
        ),
        (
            clip(bvh(vec![b'x'; 65_537], None)),
            Code::ResourceExhausted,
            "",
        ),
        (
            clip(bvh(
                b"x".to_vec(),
                Some(pb::BvhOptions {
                    unit_m: Some(f64::NAN),
                    ..Default::default()
                }),
            )),
            Code::InvalidArgument,
            "bvh.options.unit_m",
        ),
        (
            clip(Some(Source::Frames(pb::FrameSource {
                rate_hz: 60.0,
                frames: vec![],
            }))),
            Code::InvalidArgument,
            "frames.frames",
        ),
    ] {
        expect(
            c.motions().create_clip(request).await.unwrap_err(),
            code,
            field,
        );
    }
    let e = c
        .motions()
        .create_clip(clip(bvh(vec![b'x'; 2_000_000], None)))
        .await
        .unwrap_err();
    let (code, reason, _) = refusal(&e);
    assert_eq!(
        (code, reason.as_str()),
        (Code::ResourceExhausted, "MESSAGE_TOO_LARGE"),
        "{e:?}"
    );
    asked.unchanged().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn bad_motion_is_refused_and_takes_no_control() {
    let asked = Asked::new().await;
    let world = &asked.world;
    let c = &asked.server.client;
    let push = |frames: Vec<pb::MotionFrame>| pb::PushMotionRequest {
        header: Some(header(world, "a", "me")),
        batch: Some(pb::MotionBatch { frames }),
    };
    let spoiled = |spoil: &dyn Fn(&mut pb::FigureMotion)| {
        let mut frame = arm_frame("a", 1);
        spoil(&mut frame.figures[0]);
        push(vec![arm_frame("a", 0), frame])
    };
    let at = |part: &str| format!("batch.frames[1].figures[0].{part}");
    for (request, field) in [
        (
            spoiled(&|m| m.joint_angles_rad[3] = f64::NAN),
            at("joint_angles_rad[3]"),
        ),
        (
            spoiled(&|m| m.joint_angles_rad.truncate(38)),
            at("joint_angles_rad"),
        ),
        (
            spoiled(&|m| m.velocity[44] = f64::INFINITY),
            at("velocity[44]"),
        ),
        (spoiled(&|m| m.velocity.push(0.0)), at("velocity")),
        (spoiled(&|m| m.planted.push(true)), at("planted")),
        (spoiled(&|m| m.figure_id = "nobody".into()), at("figure_id")),
        (
            spoiled(&|m| {
                m.root = Some(pb::Pose {
                    position_m: Some(pb::Vector3 {
                        z: 1e9,
                        ..Default::default()
                    }),
                    rotation: None,
                });
            }),
            at("root.position_m.z"),
        ),
        (
            push((0..65).map(|i| arm_frame("a", i)).collect()),
            "batch.frames".to_owned(),
        ),
    ] {
        expect(
            c.motions().push_motion(request).await.unwrap_err(),
            Code::InvalidArgument,
            &field,
        );
    }
    let mut nobody = push(vec![]);
    nobody.header.as_mut().unwrap().figure_ids = vec!["zz".into()];
    expect(
        c.motions().push_motion(nobody).await.unwrap_err(),
        Code::NotFound,
        "",
    );
    let driven = asked.server.look(&format!("{world}/figures/a")).await;
    assert_eq!(
        driven.status.unwrap().driver_id,
        "",
        "a refused push takes no control"
    );
    asked.unchanged().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn errors_echo_no_more_of_a_name_than_fits_into_headers() {
    let asked = Asked::new().await;
    let world = &asked.world;
    let c = &asked.server.client;
    let long = format!("{world}/figures/{}", "x".repeat(60_000));
    let request = pb::GetFigureRequest { name: long };
    let e = c.figures().get_figure(request).await.unwrap_err();
    assert_eq!(e.code(), Code::NotFound, "{e:?}");
    assert!(e.message().len() < 400, "{}", e.message().len());
    asked.unchanged().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn bad_views_are_refused() {
    let asked = Asked::new().await;
    let world = &asked.world;
    let c = &asked.server.client;
    let frame = |view: pb::View, tick| pb::GetWorldFrameRequest {
        world: world.clone(),
        tick,
        view: Some(view),
    };
    for (request, code, field) in [
        (
            frame(view(&["torque", "colour"]), None),
            Code::InvalidArgument,
            "view.fields.paths[1]",
        ),
        (
            frame(
                pb::View {
                    figure_ids: vec!["zz".into()],
                    ..Default::default()
                },
                None,
            ),
            Code::NotFound,
            "",
        ),
        (
            frame(
                pb::View {
                    encoding: 9,
                    ..Default::default()
                },
                None,
            ),
            Code::InvalidArgument,
            "view.encoding",
        ),
        (
            frame(pb::View::default(), Some(1_000)),
            Code::OutOfRange,
            "",
        ),
        (frame(pb::View::default(), Some(-1)), Code::OutOfRange, ""),
    ] {
        expect(
            c.states().get_world_frame(request).await.unwrap_err(),
            code,
            field,
        );
    }
    asked.unchanged().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn bad_simulations_and_exports_are_refused() {
    let asked = Asked::new().await;
    let c = &asked.server.client;
    let simulate = |clip: &str, duration_s| pb::SimulateClipRequest {
        source: Some(pb::simulate_clip_request::Source::Clip(clip.into())),
        duration_s,
        ..Default::default()
    };
    for (request, code, field) in [
        (simulate("wave", 1.0), Code::InvalidArgument, "clip"),
        (simulate("clips/none", 1.0), Code::NotFound, ""),
        (
            simulate("clips/wave", 1e6),
            Code::InvalidArgument,
            "duration_s",
        ),
        (
            simulate("clips/wave", f64::NAN),
            Code::InvalidArgument,
            "duration_s",
        ),
    ] {
        expect(
            c.simulations().simulate_clip(request).await.unwrap_err(),
            code,
            field,
        );
    }
    expect(
        c.bodies()
            .export_body(pb::ExportBodyRequest {
                name: "bodies/adult-man".into(),
                format: 0,
            })
            .await
            .unwrap_err(),
        Code::InvalidArgument,
        "format",
    );
    asked.unchanged().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_world_too_many_is_refused() {
    let asked = Asked::new().await;
    let server = &asked.server;
    server.paused_world("second").await;
    let full = server
        .client
        .worlds()
        .create_world(pb::CreateWorldRequest {
            world_id: "third".into(),
            world: Some(pb::World::default()),
            paused: true,
            ..Default::default()
        })
        .await
        .unwrap_err();
    assert_eq!(refusal(&full).0, Code::ResourceExhausted);
    asked.server.stop().await;
}
