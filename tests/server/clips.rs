//! Files to clips, playing them, simulating without a world.

use crate::support::{TestServer, recording};
use sinew::wire::pb;

#[tokio::test(flavor = "multi_thread")]
async fn a_recording_is_uploaded_played_and_simulated() {
    let server = TestServer::start().await;
    let data = recording("wave.bvh");
    let clip = server
        .client
        .motions()
        .create_clip(pb::CreateClipRequest {
            clip_id: "greeting".into(),
            source: Some(pb::create_clip_request::Source::Bvh(pb::BvhSource {
                data: data.clone().into(),
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
    assert!((clip.duration_s - 10.0).abs() < 0.2, "{}", clip.duration_s);
    let report = clip.report.unwrap();
    assert!(
        (report.unit_m - 0.056_444_4).abs() < 1e-3,
        "{}",
        report.unit_m
    );
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
            })
            .await
            .unwrap();
        server
            .client
            .motions()
            .play_clip(pb::PlayClipRequest {
                figure: format!("{world}/figures/{id}"),
                clip: clip.name.clone(),
                reset: true,
                ..Default::default()
            })
            .await
            .unwrap();
    }
    server.step(&world, 120).await;
    let frame = server.frame(&world, &["status"]).await;
    for f in &frame.figures {
        let error = f.status.as_ref().unwrap().joint_rms_rad.to_degrees();
        assert!(error < 3.0, "figure {} is off by {error}°", f.figure_index);
    }

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
    assert!(summary.joint_rms_deg < 3.0, "{}", summary.joint_rms_deg);
    assert!(simulated.report.is_some());

    server
        .client
        .motions()
        .delete_clip(pb::DeleteClipRequest {
            name: clip.name.clone(),
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
