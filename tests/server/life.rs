//! Worlds that end while clients still wait for their results, or read from them.

use crate::support::{TestServer, refusal};
use sinew_wire::pb;
use std::sync::Arc;
use std::sync::mpsc::{SyncSender, sync_channel};
use std::time::Duration;
use tonic::Code;

/// Longest time for something that takes milliseconds.
const SOON: Duration = Duration::from_secs(20);

/// Keeps a worker of a pool busy until the returned value is dropped.
macro_rules! hold {
    ($server:expr, $pool:ident) => {{
        let (held, wait) = sync_channel::<()>(1);
        let app = $server.app.clone();
        let work = move |_: &sinew_server::workers::Turn| {
            let _ = wait.recv();
            Ok(())
        };
        tokio::spawn(async move { app.$pool.run(&"busy".into(), work).await });
        while $server.app.$pool.running() == 0 {
            tokio::task::yield_now().await;
        }
        let held: SyncSender<()> = held;
        held
    }};
}

async fn until(what: impl Fn() -> bool) {
    let waits = async {
        while !what() {
            tokio::time::sleep(Duration::from_millis(10)).await;
        }
    };
    tokio::time::timeout(SOON, waits)
        .await
        .expect("it is so soon");
}

fn checkpoint(world: &str, id: &str, return_data: bool) -> pb::CheckpointWorldRequest {
    pb::CheckpointWorldRequest {
        name: world.into(),
        checkpoint_id: id.into(),
        return_data,
        ..Default::default()
    }
}

async fn checkpoints(server: &TestServer, world: &str) -> usize {
    let request = pb::ListCheckpointsRequest {
        parent: world.into(),
        ..Default::default()
    };
    let listed = server.client.checkpoints().list_checkpoints(request).await;
    listed.unwrap().into_inner().checkpoints.len()
}

#[tokio::test(flavor = "multi_thread")]
async fn who_waits_for_a_worker_is_told_when_the_world_is_deleted() {
    let server = TestServer::with(&[("max_conversions", "1")]).await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let client = server.client.clone();
    let first = checkpoint(&world, "", true);
    let first = client.checkpoints().checkpoint_world(first).await;
    let data = first.unwrap().into_inner().data;

    let busy = hold!(server, conversions);
    let mut waiting = Vec::new();
    for id in ["", "repeatable"] {
        let (client, request) = (
            client.clone(),
            pb::RestoreWorldRequest {
                name: world.clone(),
                source: Some(pb::restore_world_request::Source::Data(data.clone().into())),
                request_id: id.into(),
            },
        );
        waiting.push(tokio::spawn(async move {
            let done = client.checkpoints().restore_world(request).await;
            done.map(|_| "restored")
        }));
        let (client, request) = (
            server.client.clone(),
            pb::PlayClipRequest {
                figure: format!("{world}/figures/a"),
                clip: "clips/wave".into(),
                r#loop: true, // which has to be prepared
                request_id: id.into(),
                ..Default::default()
            },
        );
        waiting.push(tokio::spawn(async move {
            let done = client.motions().play_clip(request).await;
            done.map(|_| "played")
        }));
        let (client, mut request) = (server.client.clone(), checkpoint(&world, "", false));
        request.request_id = id.into();
        waiting.push(tokio::spawn(async move {
            let done = client.checkpoints().checkpoint_world(request).await;
            done.map(|_| "kept")
        }));
    }
    tokio::time::sleep(Duration::from_millis(300)).await; // all of them wait
    let left = Arc::downgrade(&server.app.worlds.get("w").unwrap());
    let delete = pb::DeleteWorldRequest {
        name: world.clone(),
        ..Default::default()
    };
    client.worlds().delete_world(delete).await.unwrap();
    drop(busy);
    for call in waiting {
        let answer = tokio::time::timeout(SOON, call).await;
        let refused = answer.expect("it is answered").unwrap().unwrap_err();
        let (code, reason, _) = refusal(&refused);
        assert!(
            matches!(code, Code::NotFound | Code::Aborted),
            "{code:?} {reason}"
        );
    }
    until(|| left.strong_count() == 0).await;
    // Pending writes of the old world do not affect the next one of the same name.
    server.paused_world("w").await;
    assert_eq!(checkpoints(&server, &world).await, 0);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_checkpoint_that_no_answer_has_room_for_is_not_kept() {
    let server = TestServer::with(&[("max_response_bytes", "65536")]).await;
    let world = server.paused_world("w").await;
    let mut client = server.client.checkpoints();
    let mut size = 0;
    let mut figures = 0;
    while size <= 65_536 {
        server.figure(&world, &format!("f{figures}")).await;
        figures += 1;
        let kept = checkpoint(&world, "small", false);
        let kept = client.checkpoint_world(kept).await.unwrap().into_inner();
        let kept = kept.checkpoint.unwrap();
        size = kept.size_bytes;
        let request = pb::DeleteCheckpointRequest {
            name: kept.name,
            ..Default::default()
        };
        client.delete_checkpoint(request).await.unwrap();
    }
    let refused = client.checkpoint_world(checkpoint(&world, "c", true)).await;
    assert_eq!(refusal(&refused.unwrap_err()).1, "LIMIT_REACHED");
    assert_eq!(checkpoints(&server, &world).await, 0);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_world_of_which_somebody_reads_is_not_idle() {
    const TTL: Duration = Duration::from_secs(1);
    let server = TestServer::with(&[("max_simulations", "1")]).await;
    let settings = pb::World {
        idle_ttl: Some(TTL.try_into().unwrap()),
        ..Default::default()
    };
    let world = server.world("w", true, settings).await;
    let busy = hold!(server, simulations);
    let request = pb::ReadHistoryRequest {
        name: world,
        ..Default::default()
    };
    let history = server.client.history().read_history(request).await;
    let mut parts = history.unwrap().into_inner();
    tokio::time::sleep(3 * TTL).await;
    let there = || server.app.worlds.get("w").is_ok();
    assert!(there(), "it has ended under its reader");
    drop(busy);
    let mut frames = 0;
    while let Some(part) = parts.message().await.unwrap() {
        frames += part.frames.len();
    }
    assert_eq!(frames, 1);
    drop(parts);
    until(|| !there()).await;
}
