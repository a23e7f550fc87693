//! Live desired motion: the stream, its unary twin, permission to drive, the effect of silence.

use crate::support::{TestServer, arm_frame, header, refusal};
use sinew_wire::pb;
use tonic::Code;

/// Waits until the server has taken everything up to `sequence`.
async fn taken(driver: &mut sinew_client::LiveDriver, sequence: i64) {
    while driver.feedback().await.unwrap().unwrap().received_sequence < sequence {}
}

#[tokio::test(flavor = "multi_thread")]
async fn the_stream_and_its_unary_twin_do_the_same() {
    let server = TestServer::start().await;
    let frames: Vec<_> = (0..90).map(|i| arm_frame("a", i)).collect();
    let mut hashes = Vec::new();
    for id in ["stream", "push"] {
        let world = server.paused_world(id).await;
        server.figure(&world, "a").await;
        let header = header(&world, "a", "me");
        if id == "stream" {
            let mut driver = server.client.drive(header).await.unwrap();
            for batch in frames.chunks(30) {
                assert!(driver.send(batch.to_vec()).await);
            }
            taken(&mut driver, 89).await;
            hashes.push(server.step(&world, 80).await.state_hash);
            let last = driver.finish().await.unwrap().unwrap();
            let f = &last.figures[0];
            assert_eq!(
                f.present_count + f.interpolated_count,
                80,
                "every tick had motion: {f:?}"
            );
        } else {
            let mut feedback = None;
            for batch in frames.chunks(30) {
                feedback = server
                    .client
                    .motions()
                    .push_motion(pb::PushMotionRequest {
                        header: Some(header.clone()),
                        batch: Some(pb::MotionBatch {
                            frames: batch.to_vec(),
                        }),
                    })
                    .await
                    .unwrap()
                    .into_inner()
                    .feedback;
            }
            assert_eq!(feedback.unwrap().received_sequence, 89);
            hashes.push(server.step(&world, 80).await.state_hash);
        }
        let frame = server.frame(&world, &["desired"]).await;
        let f = &frame.figures[0];
        assert!(f.applied_sequence >= 0);
    }
    assert_eq!(hashes[0], hashes[1]);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn one_figure_has_one_driver_and_can_be_handed_on() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    server.figure(&world, "b").await;
    let first = server
        .client
        .drive(header(&world, "a", "first"))
        .await
        .unwrap();
    let e = server
        .client
        .drive(header(&world, "a", "second"))
        .await
        .unwrap_err();
    let (code, reason, _) = refusal(&e);
    assert_eq!(
        (code, reason.as_str()),
        (Code::FailedPrecondition, "FIGURE_CONTROLLED")
    );
    let e = server
        .client
        .motions()
        .play_clip(pb::PlayClipRequest {
            figure: format!("{world}/figures/a"),
            clip: "clips/wave".into(),
            ..Default::default()
        })
        .await
        .unwrap_err();
    assert_eq!(refusal(&e).1, "FIGURE_CONTROLLED");
    // Another figure is still free.
    server
        .client
        .drive(header(&world, "b", "second"))
        .await
        .unwrap();
    // Once released, it is free at once.
    first.finish().await.unwrap();
    let second = server
        .client
        .drive(header(&world, "a", "third"))
        .await
        .unwrap();
    second.finish().await.unwrap();
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_same_driver_comes_back_and_the_old_stream_is_fenced() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let mut old = server
        .client
        .drive(header(&world, "a", "me"))
        .await
        .unwrap();
    old.send((0..30).map(|i| arm_frame("a", i)).collect()).await;
    taken(&mut old, 29).await;
    // The connection broke without the server noticing: the driver connects again.
    let mut new = server
        .client
        .drive(header(&world, "a", "me"))
        .await
        .unwrap();
    let e = loop {
        match old.feedback().await {
            Ok(Some(_)) => {}
            Ok(None) => panic!("ended without a reason"),
            Err(e) => break e,
        }
    };
    assert_eq!(refusal(&e).1, "CONTROL_FENCED");
    // Its motion continues where it was.
    new.send((30..60).map(|i| arm_frame("a", i)).collect())
        .await;
    taken(&mut new, 59).await;
    server.step(&world, 40).await;
    let last = new.finish().await.unwrap().unwrap();
    assert_eq!(last.figures[0].held_count, 0);
    assert_eq!(last.figures[0].stale_count, 0);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn silence_is_bridged_and_counted() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let mut driver = server
        .client
        .drive(pb::DriveHeader {
            hold_limit_ms: Some(500.0),
            ..header(&world, "a", "me")
        })
        .await
        .unwrap();
    driver
        .send((0..30).map(|i| arm_frame("a", i)).collect())
        .await;
    taken(&mut driver, 29).await;
    server.step(&world, 120).await;
    let f = driver.finish().await.unwrap().unwrap().figures.remove(0);
    assert!(
        f.extrapolated_count >= 5 && f.extrapolated_count <= 7,
        "{f:?}"
    );
    assert!(f.held_count >= 28 && f.held_count <= 32, "{f:?}");
    assert!(f.relaxed_count > 40, "{f:?}");
    assert_eq!(f.supply(), pb::Supply::Relaxed);
    let frame = server.frame(&world, &["status"]).await;
    let flags = frame.figures[0].status.as_ref().unwrap().flags;
    assert_eq!(flags & 0b1100_0000, 0, "it neither fell nor froze");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_bad_batch_ends_the_stream_with_its_field() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let mut driver = server
        .client
        .drive(header(&world, "a", "me"))
        .await
        .unwrap();
    let mut frame = arm_frame("a", 0);
    frame.figures[0].joint_angles_rad[7] = f64::NAN;
    driver.send(vec![frame]).await;
    let e = loop {
        match driver.feedback().await {
            Ok(Some(_)) => {}
            Ok(None) => panic!("ended without a reason"),
            Err(e) => break e,
        }
    };
    assert_eq!(
        refusal(&e),
        (
            Code::InvalidArgument,
            "INVALID_FIELD".into(),
            "batch.frames[0].figures[0].joint_angles_rad[7]".into()
        )
    );
    server.stop().await;
}

/// Whether a file below a directory contains a text.
fn is_in(dir: &std::path::Path, text: &str) -> bool {
    std::fs::read_dir(dir).unwrap().any(|entry| {
        let path = entry.unwrap().path();
        if path.is_dir() {
            return is_in(&path, text);
        }
        let bytes = std::fs::read(path).unwrap();
        bytes.windows(text.len()).any(|w| w == text.as_bytes())
    })
}

#[tokio::test(flavor = "multi_thread")]
async fn a_lease_outlives_the_server_and_its_secret_is_not_on_disk() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("leases");
    let _ = std::fs::remove_dir_all(&folder); // of an earlier run
    let settings = [("data_dir", folder.to_str().unwrap())];
    let acquire = async |server: &TestServer, figure: &str, control_token: &str, grace_ms: f64| {
        let request = pb::AcquireControlRequest {
            figure: format!("worlds/w/figures/{figure}"),
            control_token: control_token.into(),
            grace_ms,
            ..Default::default()
        };
        let taken = server.client.control().acquire_control(request).await;
        taken.map(tonic::Response::into_inner)
    };
    let server = TestServer::with(&settings).await;
    let world = server.paused_world("w").await;
    for id in ["a", "b"] {
        server.figure(&world, id).await;
    }
    let long = acquire(&server, "a", "", 60_000.0).await.unwrap();
    let short = acquire(&server, "b", "", 60_000.0).await.unwrap();
    // Kept for a moment only.
    let token = &short.control_token;
    acquire(&server, "b", token, 100.0).await.unwrap();
    let epoch = long.lease.unwrap().control_epoch;
    server.stop().await;
    assert!(is_in(&folder, "figures/a"), "the world is on disk");
    assert!(!is_in(&folder, &long.control_token));

    let server = TestServer::with(&settings).await;
    server.app.restore().await;
    // Others are kept out, with and without a token.
    for (token, reason) in [("", "FIGURE_CONTROLLED"), ("x", "CONTROL_FENCED")] {
        let refused = acquire(&server, "a", token, 0.0).await.unwrap_err();
        assert_eq!(refusal(&refused).1, reason);
    }
    let stranger = server.client.drive(header(&world, "a", "stranger")).await;
    assert!(match stranger {
        Ok(mut driver) => driver.feedback().await.is_err(),
        Err(_) => true,
    });
    // Its holder comes back.
    let mine = pb::DriveHeader {
        control_tokens: vec![long.control_token.clone()],
        ..header(&world, "a", "me")
    };
    let mut driver = server.client.drive(mine).await.unwrap();
    assert!(
        driver
            .send((0..10).map(|i| arm_frame("a", i)).collect())
            .await
    );
    taken(&mut driver, 9).await;
    let renewed = acquire(&server, "a", &long.control_token, 0.0)
        .await
        .unwrap();
    assert_eq!(renewed.lease.unwrap().control_epoch, epoch);
    // A lease whose holder does not return ends.
    let get = pb::GetControlRequest {
        figure: "worlds/w/figures/b".into(),
    };
    let ended = async {
        loop {
            let now = server.client.control().get_control(get.clone()).await;
            if now.unwrap().into_inner().lease.unwrap().holder.is_empty() {
                break;
            }
            tokio::time::sleep(std::time::Duration::from_millis(20)).await;
        }
    };
    let limit = std::time::Duration::from_secs(30);
    tokio::time::timeout(limit, ended).await.unwrap();
    let again = acquire(&server, "b", token, 0.0).await.unwrap_err();
    assert_eq!(refusal(&again).1, "CONTROL_FENCED");
    server.stop().await;
}
