//! Worlds and clips that are created and deleted: the view of other clients agrees with the disk, even if a client goes
//! away in between.

#![allow(clippy::unwrap_used)] // a panic here is the failure message

use super::*;
use crate::access::caller::Identity;
use crate::access::roles::Rule;
use crate::checkpoints::KeptCheckpoint;
use crate::durable::local::LocalStore;
use crate::durable::store::CheckpointStore;
use crate::progress::WorkProgress;
use crate::testing::{Temporary, close};
use crate::worlds::WorldHandle;
use futures_util::FutureExt;
use sinew_wire::convert::world::settings;
use sinew_wire::types::WorldSettings;
use std::time::SystemTime;

fn titled(title: &str) -> WorldSettings {
    let world = pb::World {
        display_name: title.to_owned(),
        ..Default::default()
    };
    settings(Some(world)).unwrap()
}

/// A world that is not written yet.
fn begun(app: &App, id: &str, owner: &str) -> Result<Arc<WorldHandle>, Fault> {
    let owner = (owner.into(), Vec::new());
    (app.worlds).create(Some(id.to_owned()), titled(id), true, owner)
}

async fn made(app: &Arc<App>, id: &str, title: &str) -> Arc<WorldHandle> {
    let owner = ("user:ann".into(), Vec::new());
    let world = app
        .worlds
        .create(Some(id.to_owned()), titled(title), true, owner);
    let world = world.unwrap();
    app.written(&world).await.unwrap();
    world
}

/// Names and titles of all worlds.
fn names(app: &App) -> Vec<String> {
    let worlds = app.worlds.list();
    let name = |w: &Arc<WorldHandle>| format!("{} {}", w.id, w.info().settings.pace.display_name);
    worlds.iter().map(name).collect()
}

fn kept(owner: &str) -> KeptCheckpoint {
    KeptCheckpoint {
        world: "w".to_owned(),
        id: "c".to_owned(),
        tick: 0,
        time: 0.0,
        hash: 0,
        bytes: vec![1],
        created: SystemTime::now(),
        owner: owner.into(),
    }
}

#[tokio::test]
async fn what_has_begun_with_a_world_is_stored_also_if_its_client_goes_away() {
    let dir = Temporary::new();
    let app = dir.open(&[]).await;
    let persistence = app.persistence.clone().unwrap();
    let world = begun(&app, "new", "user:ann").unwrap();
    // Others see it and change it. They are not told that this is stored before the world is.
    assert!(persistence.changed(&world).now_or_never().is_none());
    assert!(app.written(&world).now_or_never().is_none());
    persistence.changed(&world).await.unwrap();

    let gone = made(&app, "gone", "").await;
    assert!(app.delete(&gone, "ann").now_or_never().is_none());
    let free = || {
        let id = Some("gone".to_owned());
        app.worlds.would_create(id, titled(""), true, &"x".into())
    };
    while free().is_err() {
        tokio::task::yield_now().await;
    }
    // A change to a world that does not exist is not stored, and its caller learns that.
    let late = persistence.changed(&gone).await;
    assert_eq!(late.unwrap_err().reason(), "WORLD_ENDED");

    // A world that is deleted before it is written does not come back.
    let both = begun(&app, "both", "user:ann").unwrap();
    assert!(app.written(&both).now_or_never().is_none());
    app.delete(&both, "ann").await.unwrap();
    close(app).await;
    assert_eq!(names(&*dir.open(&[]).await), ["new new"]);
}

#[tokio::test]
async fn a_name_is_taken_until_all_that_belongs_to_it_is_forgotten() {
    let dir = Temporary::new();
    let app = dir.open(&[]).await;
    let first = made(&app, "w", "first").await;
    let there = |world: &Arc<WorldHandle>| {
        let (app, world) = (app.clone(), world.clone());
        move || app.still_there(&world)
    };
    app.checkpoints.keep(kept("ann"), there(&first)).unwrap();
    let leaving = app.worlds.delete("w", "ann").await.unwrap();
    let taken = begun(&app, "w", "user:bob").unwrap_err();
    assert_eq!(taken.reason(), "ALREADY_EXISTS");
    app.forget_world(leaving).await.unwrap();
    assert!(app.checkpoints.of_world("w").is_empty());
    // A checkpoint that was being taken at that time is not kept.
    let late = app.checkpoints.keep(kept("ann"), there(&first));
    assert_eq!(late.unwrap_err().reason(), "WORLD_ENDED");
    assert!(app.checkpoints.of_world("w").is_empty());

    let second = made(&app, "w", "second").await;
    app.checkpoints.keep(kept("bob"), there(&second)).unwrap();
    // A client that still holds the first world does not affect the second.
    assert!(app.stored(&first).await.is_err());
    assert!(app.delete(&first, "ann").await.is_err());
    assert_eq!(app.checkpoints.of_world("w").len(), 1);
    close(app).await;
    assert_eq!(names(&*dir.open(&[]).await), ["w second"]);
}

#[tokio::test]
async fn of_two_stored_worlds_of_one_name_the_later_comes_back() {
    let dir = Temporary::new();
    let app = dir.open(&[]).await;
    made(&app, "a", "first").await;
    made(&app, "b", "second").await;
    close(app).await;
    let mut store = LocalStore::open(&dir.0).unwrap();
    let mut worlds = store.worlds().unwrap().whole.into_iter();
    let mut second = worlds.find(|w| w.name == "b").unwrap();
    second.name = "a".to_owned();
    store.put_world(&second).unwrap();
    store.close().unwrap();
    drop(store);

    let app = dir.open(&[]).await;
    assert_eq!(names(&app), ["a second"]);
    // The other one does not come back in its place.
    let second = app.worlds.get("a").unwrap();
    app.delete(&second, "ann").await.unwrap();
    close(app).await;
    assert!(names(&*dir.open(&[]).await).is_empty());
}

#[tokio::test]
async fn the_share_of_a_client_outlives_the_server() {
    let dir = Temporary::new();
    let app = dir.open(&[]).await;
    for (id, owner) in [
        ("a", "user:ann"),
        ("b", "user:ann"),
        ("c", "127.0.0.1:50000"),
    ] {
        let world = begun(&app, id, owner).unwrap();
        app.written(&world).await.unwrap();
    }
    close(app).await;
    // All of them come back, even if fewer may be created now.
    let app = dir
        .open(&[("max_worlds", "8"), ("max_client_share", "0.125")])
        .await;
    assert_eq!(names(&app), ["a a", "b b", "c c"]);
    let refused = begun(&app, "d", "user:ann").unwrap_err();
    assert_eq!(refused.reason(), "LIMIT_REACHED");
    begun(&app, "d", "user:bob").unwrap();
    // Another connection may have the port of an earlier one.
    begun(&app, "e", "127.0.0.1:50000").unwrap();
}

#[tokio::test]
async fn a_clip_that_is_deleted_as_soon_as_it_is_seen_does_not_come_back() {
    let dir = Temporary::new();
    let app = dir.open(&[]).await;
    let caller = Caller {
        identity: Identity::anonymous(),
        client: "c".into(),
        order: "c".into(),
        rule: Rule::Open,
        call: "CreateClip".into(),
    };
    let frame = pb::FigureMotion {
        joint_angles_rad: vec![0.0; 39],
        root: Some(pb::Pose {
            position_m: Some(pb::Vector3 {
                z: 0.95,
                ..Default::default()
            }),
            rotation: None,
        }),
        ..Default::default()
    };
    let request = pb::CreateClipRequest {
        clip_id: "k".to_owned(),
        source: Some(pb::create_clip_request::Source::Frames(pb::FrameSource {
            rate_hz: 60.0,
            frames: vec![frame; 30],
        })),
        ..Default::default()
    };
    let api = Api(app.clone());
    let create = tokio::spawn(async move {
        let who = (&caller, "c".into());
        let request = (request, Upload::default());
        clips::create(&api, who, request, WorkProgress::default()).await
    });
    let persistence = app.persistence.clone().unwrap();
    let mut writing = None;
    let mut delete = || {
        app.clips.delete("k", |_| {
            writing = Some(persistence.clip_deleted("k")?);
            Ok(())
        })
    };
    while delete().is_err() {
        assert!(!create.is_finished(), "it was there");
        tokio::task::yield_now().await;
    }
    writing.unwrap().done().await.unwrap();
    create.await.unwrap().unwrap();
    close(app).await;
    let app = dir.open(&[]).await;
    assert!(app.clips.info("k").is_err());
}
