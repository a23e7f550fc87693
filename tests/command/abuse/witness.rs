//! A bystander world beside every attack, with a walking figure. It has to continue as if it were alone.

use sinew_client::Client;
use sinew_physics::plan::cycle;
use sinew_server::engine::{self, Planning};
use sinew_server::tick::scene::{InputResult, Scene, SceneInput};
use sinew_wire::convert;
use sinew_wire::pb;
use sinew_wire::types::Playback;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;
use tonic::Status;

const WORLD: &str = "worlds/witness";
const CLIP: &str = "walk";
/// Time before the attack in which the lateness of a world alone on the machine is measured.
const QUIET: Duration = Duration::from_secs(1);

/// Lateness of its ticks, p99 of recent ones, µs.
async fn lateness(client: &Client) -> Result<f64, Status> {
    let request = pb::GetServerStatsRequest {
        world: WORLD.into(),
    };
    let stats = client.server().get_server_stats(request).await?;
    Ok(stats.into_inner().worlds[0].stages[0].p99_us)
}

/// Lets the figure walk from tick 0. Returns the lateness of its ticks without other load.
pub async fn begin(address: SocketAddr) -> f64 {
    let client = Client::connect(&address.to_string()).await.unwrap();
    let request = pb::CreateWorldRequest {
        world_id: "witness".into(),
        paused: true,
        ..Default::default()
    };
    client.worlds().create_world(request).await.unwrap();
    let request = pb::CreateFigureRequest {
        parent: WORLD.into(),
        figure_id: "a".into(),
        ..Default::default()
    };
    client.figures().create_figure(request).await.unwrap();
    let request = pb::PlayClipRequest {
        figure: format!("{WORLD}/figures/a"),
        clip: format!("clips/{CLIP}"),
        r#loop: true,
        reset: true,
        ..Default::default()
    };
    client.motions().play_clip(request).await.unwrap();
    let request = pb::ResumeWorldRequest { name: WORLD.into() };
    client.worlds().resume_world(request).await.unwrap();
    tokio::time::sleep(QUIET).await;
    lateness(&client).await.unwrap()
}

/// Its latest lateness, µs, and a tick with the hash of its state.
async fn last(address: SocketAddr) -> Result<(f64, i64, i64), Status> {
    let client = Client::connect(&address.to_string()).await;
    let client = client.map_err(|e| Status::unavailable(e.to_string()))?;
    let late = lateness(&client).await?;
    let request = pb::GetWorldFrameRequest {
        world: WORLD.into(),
        ..Default::default()
    };
    let frame = client.states().get_world_frame(request).await?;
    let frame = frame.into_inner().frame.unwrap_or_default();
    Ok((late, frame.tick, frame.state_hash))
}

/// Compares it with a world alone; `quiet_us` is the result of [`begin`].
pub async fn judge(address: SocketAddr, quiet_us: f64) {
    // The attack may have left every place occupied, for some seconds.
    let mut found = last(address).await;
    for _ in 0..50 {
        if found.is_ok() {
            break;
        }
        tokio::time::sleep(Duration::from_millis(200)).await;
        found = last(address).await;
    }
    let (late, tick, hash) = found.unwrap();
    assert!(tick > 30, "the other world stood still: tick {tick}");
    eprintln!(
        "the world beside it is late by {late:.0} µs (p99 of recent ticks), {quiet_us:.0} µs before the attack; \
         tick {tick}"
    );
    assert_eq!(hash, alone(tick), "the world beside it at tick {tick}");
}

/// The hash of its state after a tick, in a world alone.
fn alone(tick: i64) -> i64 {
    let settings = convert::world::settings(Some(pb::World::default())).unwrap();
    let mut scene = Scene::new(settings).unwrap();
    let settings = convert::figure::settings("figure", Some(&pb::Figure::default())).unwrap();
    let body = Arc::new(engine::build_body(settings.body.profile).unwrap());
    // A walk repeats its best cycle.
    let walk = engine::builtin(&body, CLIP).unwrap();
    let clip = Arc::new(cycle(&body, &walk).unwrap_or(walk));
    let added = scene.apply(SceneInput::AddFigure {
        id: "a".into(),
        settings: Box::new(settings),
        body: Some(body),
    });
    let Ok(InputResult::Figure(figure)) = added else {
        panic!("{added:?}")
    };
    let played = scene.apply(SceneInput::Play {
        figure,
        name: CLIP.into(),
        clip,
        rehearsed: None,
        playback: Playback {
            speed: 1.0,
            looped: true,
            start: None,
            reset: true,
            max_help: 0.0,
            place: None,
        },
    });
    played.unwrap();
    while (scene.world().tick() as i64) < tick {
        scene.sample(0.0);
        scene.step(Planning::InTick);
    }
    scene.world().state_hash() as i64
}
