//! Two tenants of one server: the use and floods of one do not harm the other.

use crate::access::support::{Guarded, figure, refusal, token, world};
use sinew_client::Client;
use sinew_server::access::roles::Role;
use sinew_wire::pb;
use tonic::Code;
use tonic_types::StatusExt as _;

fn arm(sequence: i64) -> pb::MotionFrame {
    let t = sequence as f64 / 60.0;
    let mut angles = vec![0.0; 39];
    angles[19] = 0.6 - 0.6 * (1.5 * t).cos(); // right elbow
    pb::MotionFrame {
        sequence,
        source_time_ns: (t * 1e9) as i64,
        figures: vec![pb::FigureMotion {
            joint_angles_rad: angles,
            planted: vec![true, true],
            ..Default::default()
        }],
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_greedy_tenant_gets_its_share_and_the_other_one_everything_it_asks_for() {
    let more = [
        ("max_worlds", "8"),
        ("max_viewers", "16"),
        ("max_clips", "4"),
        ("max_client_calls_per_s", "200"),
    ];
    let server = Guarded::start(&more).await;
    let greedy_token = token(
        &server.secret,
        "greedy",
        &[Role::Owner],
        Some(&["greedy-*"]),
    );
    // Many connections are still one principal.
    let mut greedy: Vec<Client> = Vec::new();
    for _ in 0..4 {
        greedy.push(server.bearing(greedy_token.clone()).await);
    }
    let modest = server
        .client("modest", &[Role::Owner], Some(&["modest-*"]))
        .await;

    let mut made = 0;
    let refused = loop {
        let request = pb::CreateWorldRequest {
            world_id: format!("greedy-{made}"),
            ..Default::default()
        };
        match greedy[made % 4].worlds().create_world(request).await {
            Ok(_) => made += 1,
            Err(e) => break e,
        }
    };
    assert_eq!((made, refusal(&refused).0), (4, Code::ResourceExhausted));
    let mut watches = Vec::new();
    let refused = loop {
        let view = pb::View::default();
        match greedy[watches.len() % 4]
            .watch("worlds/greedy-0", view, None)
            .await
        {
            Ok(frames) => watches.push(frames),
            Err(e) => break e,
        }
    };
    assert_eq!(
        (watches.len(), refusal(&refused).0),
        (8, Code::ResourceExhausted)
    );

    // Flood the server with calls from all of its connections in the meantime.
    let floods: Vec<_> = greedy
        .iter()
        .map(|client| {
            let mut worlds = client.worlds();
            tokio::spawn(async move {
                let mut refused: Option<tonic::Status> = None;
                for _ in 0..2000 {
                    let name = "worlds/greedy-0".to_owned();
                    if let Err(e) = worlds.pause_world(pb::PauseWorldRequest { name }).await {
                        refused = Some(e);
                    }
                }
                refused
            })
        })
        .collect();
    let stage = world(&modest, "modest-stage", false).await;
    figure(&modest, &stage, "a").await;
    let mut frames = modest
        .watch(&stage, pb::View::default(), None)
        .await
        .unwrap();
    for sequence in 0..60 {
        let header = pb::DriveHeader {
            world: stage.clone(),
            figure_ids: vec!["a".into()],
            ..Default::default()
        };
        let request = pb::PushMotionRequest {
            header: Some(header),
            batch: Some(pb::MotionBatch {
                frames: vec![arm(sequence)],
            }),
        };
        modest.motions().push_motion(request).await.unwrap();
    }
    for _ in 0..30 {
        frames.message().await.unwrap().unwrap();
    }
    for flood in floods {
        let refused = flood
            .await
            .unwrap()
            .expect("8000 calls in an instant are too many");
        assert_eq!(
            refusal(&refused),
            (Code::ResourceExhausted, "LIMIT_REACHED".into())
        );
        assert!(
            refused.get_error_details().retry_info().is_some(),
            "when to come again"
        );
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn clips_are_those_of_who_stored_them_and_of_tokens_that_name_them() {
    let server = Guarded::start(&[("max_clips", "4")]).await;
    let a = server
        .client("a", &[Role::Owner], Some(&["studio-a-*"]))
        .await;
    let colleague = server
        .client("bob", &[Role::Driver], Some(&["studio-a-*"]))
        .await;
    let b = server
        .client("b", &[Role::Owner], Some(&["studio-b-*"]))
        .await;
    let store = |client: &Client, id: &str| {
        let (mut motions, clip_id) = (client.motions(), id.to_owned());
        async move {
            let frames = (0..30).map(|i| pb::FigureMotion {
                root: Some(pb::Pose {
                    position_m: Some(pb::Vector3 {
                        x: 0.0,
                        y: 0.0,
                        z: 0.95,
                    }),
                    rotation: None,
                }),
                ..arm(i).figures.remove(0)
            });
            let source = pb::create_clip_request::Source::Frames(pb::FrameSource {
                rate_hz: 60.0,
                frames: frames.collect(),
            });
            let request = pb::CreateClipRequest {
                clip_id,
                source: Some(source),
                ..Default::default()
            };
            motions.create_clip(request).await
        }
    };
    store(&a, "studio-a-wave").await.unwrap();
    let e = store(&a, "studio-b-wave").await.unwrap_err();
    assert_eq!(refusal(&e).1, "NAME_NOT_GRANTED");
    let sees = |client: &Client| {
        let mut motions = client.motions();
        async move {
            let listed = motions.list_clips(pb::ListClipsRequest::default()).await;
            let clips = listed.unwrap().into_inner().clips;
            let own = clips.iter().any(|c| c.name == "clips/studio-a-wave");
            (own, clips.iter().any(|c| c.builtin))
        }
    };
    assert_eq!(sees(&a).await, (true, true));
    assert_eq!(sees(&colleague).await, (true, true));
    assert_eq!(sees(&b).await, (false, true));
    let delete = |client: &Client| {
        let mut motions = client.motions();
        let name = "clips/studio-a-wave".to_owned();
        async move {
            motions
                .delete_clip(pb::DeleteClipRequest {
                    name,
                    ..Default::default()
                })
                .await
        }
    };
    assert_eq!(delete(&b).await.unwrap_err().code(), Code::NotFound);
    assert_eq!(
        delete(&colleague).await.unwrap_err().code(),
        Code::PermissionDenied
    );
    // Half of the clips are for others.
    store(&a, "studio-a-2").await.unwrap();
    let e = store(&a, "studio-a-3").await.unwrap_err();
    assert_eq!(
        refusal(&e),
        (Code::ResourceExhausted, "LIMIT_REACHED".into())
    );
    store(&b, "studio-b-wave").await.unwrap();
    delete(&a).await.unwrap();
}
