//! Goal: clients see in which way a figure follows its motion, and how much help it needs. Method: a waving figure is
//! pushed so that it loses its motion, with and without permission to be helped. Rehearsed motions are tested in
//! `rehearsals`.

use crate::support::{TestServer, header};
use sinew_physics::body::Body;
use sinew_physics::motion::builtin::at_ease;
use sinew_wire::convert::motion::figure_motion;
use sinew_wire::pb;
use std::time::Duration;
use tonic::Code;

const WORLD: &str = "worlds/w";
const FIGURE: &str = "worlds/w/figures/a";

async fn push(server: &TestServer, impulse: f64) {
    let request = pb::ApplyPerturbationsRequest {
        world: WORLD.into(),
        perturbations: vec![pb::Perturbation {
            figure_id: "a".into(),
            kind: Some(pb::perturbation::Kind::Impulse(pb::Impulse {
                segment: "chest".into(),
                impulse_newton_seconds: Some(pb::Vector3 {
                    x: 0.0,
                    y: impulse,
                    z: 0.0,
                }),
                duration_s: 0.2,
                ..Default::default()
            })),
            ..Default::default()
        }],
        ..Default::default()
    };
    let api = &server.client;
    api.perturbations()
        .apply_perturbations(request)
        .await
        .unwrap();
}

async fn play(server: &TestServer, follow: pb::Follow) {
    let request = pb::PlayClipRequest {
        figure: FIGURE.into(),
        clip: "clips/wave".into(),
        r#loop: true,
        follow: follow.into(),
        ..Default::default()
    };
    server.client.motions().play_clip(request).await.unwrap();
}

/// The status after some more ticks; the frame says the same, also in a list.
async fn status(server: &TestServer, ticks: i32) -> pb::FigureStatus {
    server.step(WORLD, ticks).await;
    let status = server.look(FIGURE).await.status.unwrap();
    let request = pb::ListFiguresRequest {
        parent: WORLD.into(),
        ..Default::default()
    };
    let listed = server.client.figures().list_figures(request).await.unwrap();
    let listed = listed.into_inner().figures[0].status.clone();
    assert_eq!(listed.as_ref(), Some(&status));
    let frame = server.frame(WORLD, &["status"]).await;
    let shown = frame.figures[0].status.as_ref().unwrap();
    assert_eq!(shown.following, status.following);
    let help = |a, b| (a, b);
    assert_eq!(
        help(shown.help_newton_seconds, shown.help_ratio),
        help(status.help_newton_seconds, status.help_ratio)
    );
    status
}

#[tokio::test(flavor = "multi_thread")]
async fn clients_see_in_which_way_a_figure_follows_its_clip() {
    let server = TestServer::start().await;
    server.paused_world("w").await;
    server.figure(WORLD, "a").await;
    let still = status(&server, 2).await;
    assert_eq!(still.following(), pb::FollowWay::Unspecified);

    play(&server, pb::Follow::Strict).await;
    let strict = status(&server, 60).await;
    assert_eq!(strict.following(), pb::FollowWay::Tracked);
    assert_eq!(strict.max_help_weights, 0.0);
    push(&server, 130.0).await;
    let alone = status(&server, 240).await;
    assert_eq!(alone.following(), pb::FollowWay::Unspecified, "it lies");
    assert_eq!(alone.help_newton_seconds, 0.0);

    let reset = pb::ResetFigureRequest {
        name: FIGURE.into(),
        ..Default::default()
    };
    server.client.figures().reset_figure(reset).await.unwrap();
    play(&server, pb::Follow::Assisted).await;
    let before = status(&server, 60).await;
    assert_eq!(before.following(), pb::FollowWay::Tracked);
    assert!(before.max_help_weights > 0.2 && before.help_newton_seconds == 0.0);
    push(&server, 90.0).await;
    let mut helped = 0;
    let mut last = before;
    for _ in 0..60 {
        let now = status(&server, 10).await;
        let acts = now.following() == pb::FollowWay::Helped;
        helped += i32::from(acts);
        assert!(acts || now.following() == pb::FollowWay::Tracked);
        assert!(now.help_newton_seconds >= last.help_newton_seconds);
        last = now;
    }
    assert!(helped > 0, "nothing helped");
    assert_eq!(last.following(), pb::FollowWay::Tracked, "it is let go");
    assert!(last.help_newton_seconds > 1.0 && last.help_ratio > 0.0);
    assert!(last.help_ratio < 0.3, "{last:?}");
    server.stop().await;
}

/// Status of the figure while a stream commands it to stand, and it is pushed after a second.
async fn streamed(most_help: f64) -> Vec<pb::FigureStatus> {
    let server = TestServer::start().await;
    server.paused_world("w").await;
    server.figure(WORLD, "a").await;
    let request = pb::UpdateFigureRequest {
        figure: Some(pb::Figure {
            name: FIGURE.into(),
            max_help_weights: Some(most_help),
            ..Default::default()
        }),
        update_mask: Some(prost_types::FieldMask {
            paths: vec!["max_help_weights".into()],
        }),
        ..Default::default()
    };
    server
        .client
        .figures()
        .update_figure(request)
        .await
        .unwrap();
    let header = pb::DriveHeader {
        nominal_rate_hz: 60.0,
        reset: true,
        ..header(WORLD, "a", "me")
    };
    let body = Body::adult_man();
    let frame = |sequence: i64| {
        let mut motion = figure_motion("a", &at_ease(&body), &[0.0; 45], None);
        motion.velocity.clear();
        pb::MotionFrame {
            sequence,
            source_time_ns: sequence * 1_000_000_000 / 60,
            figures: vec![motion],
        }
    };
    let mut client = server.client.motions();
    let mut out = Vec::new();
    for step in 0..200 {
        if step == 20 {
            push(&server, 90.0).await;
        }
        let request = pb::PushMotionRequest {
            header: Some(header.clone()),
            batch: Some(pb::MotionBatch {
                frames: (3 * step..3 * (step + 1)).map(frame).collect(),
            }),
        };
        // The test runs faster than real time, but the allowance of batches does not.
        while let Err(e) = client.push_motion(request.clone()).await {
            assert_eq!(e.code(), Code::ResourceExhausted, "{e:?}");
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
        out.push(status(&server, 3).await);
    }
    server.stop().await;
    out
}

#[tokio::test(flavor = "multi_thread")]
async fn a_stream_is_helped_where_that_is_allowed_and_clients_see_it() {
    let ways = |all: &[pb::FigureStatus], way| all.iter().filter(|s| s.following() == way).count();

    let alone = streamed(0.0).await;
    assert_eq!(ways(&alone, pb::FollowWay::Helped), 0);
    assert!(alone.iter().all(|s| s.help_newton_seconds == 0.0));

    let helped = streamed(0.3).await;
    let (before, later) = helped[1..].split_at(18);
    assert_eq!(ways(before, pb::FollowWay::Tracked), before.len());
    assert!(ways(later, pb::FollowWay::Helped) > 3);
    let last = helped.last().unwrap();
    assert_eq!(last.following(), pb::FollowWay::Tracked, "it is let go");
    assert_eq!(last.max_help_weights, 0.3);
    assert!(last.help_newton_seconds > 1.0 && last.help_ratio < 0.3);
}

#[tokio::test(flavor = "multi_thread")]
async fn whether_a_figure_meets_itself_is_a_choice() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    let update = async |figure: pb::Figure, paths: &[&str]| {
        let request = pb::UpdateFigureRequest {
            figure: Some(figure),
            update_mask: Some(prost_types::FieldMask {
                paths: paths.iter().map(|p| (*p).to_owned()).collect(),
            }),
            ..Default::default()
        };
        let out = server.client.figures().update_figure(request).await;
        out.unwrap().into_inner().figure.unwrap().self_contact
    };
    let request = pb::CreateFigureRequest {
        parent: world.clone(),
        figure_id: "a".into(),
        figure: Some(pb::Figure {
            self_contact: Some(true),
            ..Default::default()
        }),
        ..Default::default()
    };
    let made = server.client.figures().create_figure(request).await;
    let made = made.unwrap().into_inner().figure.unwrap();
    assert_eq!(made.self_contact, Some(true));
    let named = pb::Figure {
        name: made.name,
        ..Default::default()
    };
    assert_eq!(update(named.clone(), &["assist"]).await, Some(true));
    assert_eq!(update(named.clone(), &["self_contact"]).await, Some(false));
    let on = pb::Figure {
        self_contact: Some(true),
        ..named
    };
    assert_eq!(update(on, &[]).await, Some(true));
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn how_far_a_figure_may_go_is_a_choice_and_its_bound_follows_from_it() {
    use pb::Follow::{Always, Assisted, Rehearsed, Strict, Unspecified};
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    let shown = |f: pb::Figure| (f.follow(), f.max_help_weights);
    let figure = |follow: pb::Follow, most| pb::Figure {
        follow: follow.into(),
        max_help_weights: most,
        ..Default::default()
    };
    let create = async |id: &str, follow, most| {
        let request = pb::CreateFigureRequest {
            parent: world.clone(),
            figure_id: id.into(),
            figure: Some(figure(follow, most)),
            ..Default::default()
        };
        let made = server.client.figures().create_figure(request).await;
        made.map(|r| shown(r.into_inner().figure.unwrap()))
    };
    for (id, follow, most, then) in [
        ("a", Unspecified, None, (Strict, 0.0)),
        ("b", Strict, Some(0.0), (Strict, 0.0)),
        ("c", Rehearsed, None, (Rehearsed, 0.0)),
        ("d", Assisted, None, (Assisted, 0.3)),
        ("e", Assisted, Some(0.0), (Assisted, 0.0)),
        ("f", Always, None, (Always, 1.0)),
        ("g", Always, Some(1.5), (Always, 1.5)),
        ("h", Unspecified, Some(0.2), (Assisted, 0.2)),
    ] {
        let (follow_now, most_now) = create(id, follow, most).await.unwrap();
        assert_eq!((follow_now, most_now), (then.0, Some(then.1)), "{id}");
    }
    for (id, follow) in [("i", Strict), ("j", Rehearsed)] {
        let refused = create(id, follow, Some(0.2)).await.unwrap_err();
        assert_eq!(refused.code(), Code::InvalidArgument);
        let said = refused.message();
        assert!(said.contains("figure.max_help_weights"), "{said}");
    }

    // One figure, changed again and again.
    let update = async |follow, most, paths: &[&str]| {
        let request = pb::UpdateFigureRequest {
            figure: Some(pb::Figure {
                name: FIGURE.into(),
                ..figure(follow, most)
            }),
            update_mask: Some(prost_types::FieldMask {
                paths: paths.iter().map(|p| (*p).to_owned()).collect(),
            }),
            ..Default::default()
        };
        let out = server.client.figures().update_figure(request).await;
        shown(out.unwrap().into_inner().figure.unwrap())
    };
    let most = "max_help_weights";
    for (follow, bound, paths, then) in [
        (Unspecified, Some(0.5), vec![most], (Assisted, 0.5)),
        (Assisted, None, vec!["follow"], (Assisted, 0.5)),
        // A bound belongs to its means.
        (Always, None, vec!["follow"], (Always, 1.0)),
        (Unspecified, Some(0.7), vec![], (Always, 0.7)),
        (Unspecified, None, vec![most], (Always, 1.0)),
        (Strict, None, vec![], (Strict, 0.0)),
        (Unspecified, None, vec!["assist"], (Strict, 0.0)),
        (Assisted, Some(0.1), vec!["follow", most], (Assisted, 0.1)),
        // Named by the mask but absent: the default.
        (Unspecified, None, vec!["follow"], (Strict, 0.0)),
    ] {
        let (follow_now, most_now) = update(follow, bound, &paths).await;
        assert_eq!(
            (follow_now, most_now),
            (then.0, Some(then.1)),
            "{follow:?} {bound:?} {paths:?}"
        );
    }
    server.stop().await;
}
