//! Converting files to clips, playing them, and simulating without a world.

use crate::corpus;
use crate::support::{FALLEN, TestServer};
use sinew_wire::frame::values;
use sinew_wire::pb;

#[tokio::test(flavor = "multi_thread")]
async fn a_recording_is_uploaded_played_and_deleted() {
    let server = TestServer::start().await;
    let data = corpus::read("wave.mixamo");
    let clip = server
        .client
        .motions()
        .create_clip(pb::CreateClipRequest {
            clip_id: "greeting".into(),
            source: Some(pb::create_clip_request::Source::Bvh(pb::BvhSource {
                data: data.into(),
                options: None,
            })),
            ..Default::default()
        })
        .await
        .unwrap()
        .into_inner()
        .clip
        .unwrap();
    assert_eq!(clip.name, "clips/greeting");
    assert!((clip.duration_s - 5.6).abs() < 0.1, "{}", clip.duration_s);
    let report = clip.report.unwrap();
    assert_eq!(report.unit_m, 0.01);
    assert!(report.mapped.iter().any(|m| m.bone == "rightUpperArm"));
    let listed = server
        .client
        .motions()
        .list_clips(pb::ListClipsRequest::default())
        .await
        .unwrap()
        .into_inner()
        .clips;
    assert!(listed.iter().any(|c| c.name == clip.name && !c.builtin));
    assert!(listed.iter().any(|c| c.name == "clips/walk" && c.builtin));

    // On the body it was prepared for, and on another.
    let world = server.paused_world("w").await;
    for (id, body) in [("man", "bodies/adult-man"), ("woman", "bodies/adult-woman")] {
        server
            .client
            .figures()
            .create_figure(pb::CreateFigureRequest {
                parent: world.clone(),
                figure_id: id.into(),
                figure: Some(pb::Figure {
                    body: body.into(),
                    controller: pb::Controller::Modern.into(),
                    ..Default::default()
                }),
                ..Default::default()
            })
            .await
            .unwrap();
        let figure = format!("{world}/figures/{id}");
        server.play(&figure, &clip.name, true).await;
    }
    server.step(&world, 120).await;
    let frame = server.frame(&world, &["status"]).await;
    for f in &frame.figures {
        let error = f
            .status
            .as_ref()
            .unwrap()
            .tracking_joint_rms_rad
            .to_degrees();
        assert!(error < 3.0, "figure {} is off by {error}°", f.figure_index);
    }

    server
        .client
        .motions()
        .delete_clip(pb::DeleteClipRequest {
            name: clip.name.clone(),
            ..Default::default()
        })
        .await
        .unwrap();
    let gone = server
        .client
        .motions()
        .get_clip(pb::GetClipRequest { name: clip.name })
        .await
        .unwrap_err();
    assert_eq!(gone.code(), tonic::Code::NotFound);
    server.stop().await;
}

/// A recording is prepared for its playing speed, up to twice its own speed; at higher speeds that preparation is
/// played faster.
#[tokio::test(flavor = "multi_thread")]
async fn a_recording_is_played_faster_and_slower() {
    let server = TestServer::start().await;
    let source = |data: Vec<u8>| {
        pb::create_clip_request::Source::Bvh(pb::BvhSource {
            data: data.into(),
            options: None,
        })
    };
    let clip = server
        .client
        .motions()
        .create_clip(pb::CreateClipRequest {
            clip_id: "around".into(),
            source: Some(source(corpus::piece("walk-arc.vrm", 1.8, 5.4))),
            ..Default::default()
        })
        .await
        .unwrap()
        .into_inner()
        .clip
        .unwrap();
    for (speed, stands) in [(0.8, true), (1.2, true), (3.0, false)] {
        let id = format!("at-{}", (10.0 * speed) as u32);
        let world = server.paused_world(&id).await;
        let figure = server
            .client
            .figures()
            .create_figure(pb::CreateFigureRequest {
                parent: world.clone(),
                figure_id: "f".into(),
                figure: Some(pb::Figure {
                    body: "bodies/adult-man".into(),
                    controller: pb::Controller::Modern.into(),
                    ..Default::default()
                }),
                ..Default::default()
            })
            .await
            .unwrap()
            .into_inner()
            .figure
            .unwrap()
            .name;
        let played = server
            .client
            .motions()
            .play_clip(pb::PlayClipRequest {
                figure: figure.clone(),
                clip: clip.name.clone(),
                speed,
                ..Default::default()
            })
            .await
            .unwrap();
        let start = played.into_inner().start_time_s;
        // Places at the end of the recording, and at half of it before that.
        let place = |f: &pb::WorldFrame| {
            let d = f.figures[0].desired.as_ref().unwrap();
            values(d.root_pose.as_ref().unwrap())
        };
        let mut at = Vec::new();
        let mut ticks = 0;
        for share in [0.5, 1.0] {
            let until = ((start + share * clip.duration_s / speed) * 60.0).round() as i32;
            server.step(&world, until - ticks).await;
            ticks = until;
            let frame = server.frame(&world, &["status", "desired"]).await;
            let status = frame.figures[0].status.as_ref().unwrap();
            let error = status.tracking_joint_rms_rad.to_degrees();
            let fell = status.flags & FALLEN != 0;
            assert!(!stands || (!fell && error < 4.0), "at {speed}: {error}°");
            at.push(place(&frame));
        }
        let way = (at[1][0] - at[0][0]).hypot(at[1][1] - at[0][1]);
        assert!(!stands || way > 0.3, "at {speed} it moves {way} m");
    }
    server.stop().await;
}

/// A run is reported, and walked unless it should be kept.
#[tokio::test(flavor = "multi_thread")]
async fn a_run_is_walked_unless_it_is_to_be_kept() {
    let server = TestServer::start().await;
    let mut clips = Vec::new();
    for walk_runs in [Some(false), None] {
        let options = pb::BvhOptions {
            walk_runs,
            ..Default::default()
        };
        let made = server
            .client
            .motions()
            .create_clip(pb::CreateClipRequest {
                source: Some(pb::create_clip_request::Source::Bvh(pb::BvhSource {
                    data: corpus::read("jog.vrm").into(),
                    options: Some(options),
                })),
                ..Default::default()
            })
            .await
            .unwrap();
        clips.push(made.into_inner().clip.unwrap());
    }
    let reports = [0, 1].map(|k: usize| clips[k].report.clone().unwrap());
    assert_eq!(reports.clone().map(|r| r.runs_walked), [false, true]);
    for r in &reports {
        assert!(r.run_speed_mps.is_some_and(|v| v > 2.0 && v < 3.0), "{r:?}");
    }
    assert!(
        clips[1].duration_s > 1.2 * clips[0].duration_s,
        "{} s, {} s",
        clips[0].duration_s,
        clips[1].duration_s
    );
}

#[tokio::test(flavor = "multi_thread")]
async fn a_recording_is_simulated_without_a_world() {
    let server = TestServer::start().await;
    let data = corpus::read("wave.mixamo");
    let simulated = server
        .client
        .simulations()
        .simulate_clip(pb::SimulateClipRequest {
            source: Some(pb::simulate_clip_request::Source::Bvh(pb::BvhSource {
                data: data.into(),
                options: None,
            })),
            figure: Some(pb::Figure {
                controller: pb::Controller::Modern.into(),
                ..Default::default()
            }),
            duration_s: 1.0,
            view: Some(pb::View {
                rate_divisor: 2,
                ..Default::default()
            }),
            ..Default::default()
        })
        .await
        .unwrap()
        .into_inner();
    let summary = simulated.summary.unwrap();
    assert_eq!((summary.tick_count, simulated.frames.len()), (60, 30));
    assert!(summary.fell_at_s.is_none());
    assert!(
        summary.tracking_joint_rms_rad.to_degrees() < 3.0,
        "{}",
        summary.tracking_joint_rms_rad.to_degrees()
    );
    assert!(simulated.report.is_some());
    server.stop().await;
}

/// Requested in mid-walk, a clip waits until the figure stands. Until then it is shown as the next clip, and can be
/// replaced and withdrawn.
#[tokio::test(flavor = "multi_thread")]
async fn a_clip_waits_until_a_walking_figure_stands() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    let (goes_on, stays) = (
        server.figure(&world, "goes-on").await.name,
        server.figure(&world, "stays").await.name,
    );
    let plays = |f: pb::Figure| {
        let status = f.status.unwrap();
        (status.clip, status.next_clip)
    };
    for figure in [&goes_on, &stays] {
        server.play(figure, "clips/walk", true).await;
        let now = plays(server.look(figure).await);
        assert_eq!(now, ("clips/walk".into(), String::new()));
    }
    let asked = server.step(&world, 90).await.time_s;
    for figure in [&goes_on, &stays] {
        server.play(figure, "clips/lift", false).await;
        let expected = server.play(figure, "clips/wave", false).await;
        assert!(
            (asked..asked + 4.0).contains(&expected) && expected > asked + 0.2,
            "asked at {asked} s, expected at {expected} s"
        );
        let now = plays(server.look(figure).await);
        assert_eq!(now, (String::new(), "clips/wave".into()));
    }
    let name = stays.clone();
    let request = pb::StopClipRequest {
        figure: name,
        control_token: String::new(),
        ..Default::default()
    };
    server.client.motions().stop_clip(request).await.unwrap();
    let expected = server.play(&goes_on, "clips/wave", false).await;
    let mut began = None;
    while began.is_none() {
        let now = server.step(&world, 3).await.time_s;
        assert!(now < expected + 2.0, "still waits at {now} s");
        match plays(server.look(&goes_on).await) {
            (clip, next) if next.is_empty() => {
                assert_eq!(clip, "clips/wave");
                began = Some(now);
            }
            (clip, _) => assert_eq!(clip, ""),
        }
        let idle = plays(server.look(&stays).await);
        assert_eq!(idle, (String::new(), String::new()));
    }
    let began = began.unwrap();
    assert!(began > expected - 1.0, "began at {began} of {expected} s");
    server.step(&world, 120).await;
    let frame = server.frame(&world, &["status", "positions"]).await;
    for f in &frame.figures {
        assert_eq!(f.status.as_ref().unwrap().flags & FALLEN, 0);
    }
    server.stop().await;
}

/// A walking figure that is told to turn does so directly, at a step, at the time given in the answer; until then the
/// turn is shown as the next clip.
#[tokio::test(flavor = "multi_thread")]
async fn a_walking_figure_goes_over_to_a_turn_without_a_stand() {
    let server = TestServer::start().await;
    // Both begin and end in full stride.
    for (name, file) in [("walk", "walk-normal.vrm"), ("turn", "walk-arc.vrm")] {
        let data = corpus::piece(file, 1.8, 5.4).into();
        let source = pb::BvhSource {
            data,
            options: None,
        };
        let request = pb::CreateClipRequest {
            clip_id: format!("recorded-{name}"),
            source: Some(pb::create_clip_request::Source::Bvh(source)),
            ..Default::default()
        };
        server.client.motions().create_clip(request).await.unwrap();
    }
    let world = server.paused_world("w").await;
    let figure = server.figure(&world, "f").await.name;
    let request = pb::PlayClipRequest {
        figure: figure.clone(),
        clip: "clips/recorded-walk".into(),
        r#loop: true,
        ..Default::default()
    };
    server.client.motions().play_clip(request).await.unwrap();
    let asked = server.step(&world, 420).await.time_s;
    let begins = server.play(&figure, "clips/recorded-turn", false).await;
    assert!(
        (asked - 0.4..asked + 1.5).contains(&begins),
        "asked at {asked} s, expected at {begins} s"
    );
    let (walks, turns) = (String::new(), "clips/recorded-turn".to_owned());
    let look = server.look(&figure).await.status.unwrap();
    assert_eq!((look.clip, look.next_clip), (walks, turns.clone()));
    let mut began = None;
    for _ in 0..60 {
        let now = server.step(&world, 2).await.time_s;
        let look = server.look(&figure).await.status.unwrap();
        if began.is_none() && look.next_clip.is_empty() {
            assert_eq!(look.clip, turns);
            began = Some(now);
        }
        let frame = server.frame(&world, &["status", "velocity"]).await;
        let f = &frame.figures[0];
        assert_eq!(f.status.as_ref().unwrap().flags & FALLEN, 0);
        let v = sinew_wire::frame::values(f.velocity.as_ref().unwrap());
        assert!(v[3].hypot(v[4]) > 0.3, "it stands at {now} s");
    }
    // Up to 0.4 s of the clip are skipped.
    let began = began.expect("it has begun");
    assert!((begins..begins + 0.5).contains(&began), "{began} s");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn frames_make_a_clip_too() {
    let server = TestServer::start().await;
    let frames = (0..60)
        .map(|i| {
            let mut m = crate::support::arm_frame("", i).figures.remove(0);
            m.root = Some(pb::Pose {
                position_m: Some(pb::Vector3 {
                    z: 0.93,
                    ..Default::default()
                }),
                rotation: None,
            });
            m
        })
        .collect();
    let clip = server
        .client
        .motions()
        .create_clip(pb::CreateClipRequest {
            source: Some(pb::create_clip_request::Source::Frames(pb::FrameSource {
                rate_hz: 60.0,
                frames,
            })),
            ..Default::default()
        })
        .await
        .unwrap()
        .into_inner()
        .clip
        .unwrap();
    assert_eq!((clip.frame_count, clip.rate_hz), (60, 60.0));
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn bodies_are_exported() {
    let server = TestServer::start().await;
    for (format, root) in [
        (pb::ExportFormat::Mjcf, "<mujoco"),
        (pb::ExportFormat::Urdf, "<robot"),
    ] {
        let text = server
            .client
            .bodies()
            .export_body(pb::ExportBodyRequest {
                name: "bodies/adult-woman".into(),
                format: format.into(),
            })
            .await
            .unwrap()
            .into_inner()
            .text;
        assert!(text.contains(root));
    }
    server.stop().await;
}
