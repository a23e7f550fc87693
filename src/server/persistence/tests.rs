//! Data stored under a name stay under it, and unreadable data keep nothing else away.

#![allow(clippy::unwrap_used)] // a panic here is the failure message

use super::*;
use crate::app::App;
use crate::durable::store::WorldKey;
use crate::testing::{Temporary, close};
use crate::worlds::WorldHandle;
use sinew_wire::convert::world::settings;
use sinew_wire::pb;

/// A world that was created, and whether it could be written.
async fn created(app: &App, id: Option<&str>) -> (Arc<WorldHandle>, Result<(), Fault>) {
    let settings = settings(Some(pb::World::default())).unwrap();
    let owner = ("user:ann".into(), Vec::new());
    let id = id.map(str::to_owned);
    let handle = app.worlds.create(id, settings, true, owner).unwrap();
    let written = app.persistence.as_ref().unwrap().created(&handle).await;
    (handle, written)
}

/// Puts a stored world into quarantine, as a start does. Returns its number.
fn quarantine(dir: &Temporary, name: &str) -> WorldKey {
    let mut store = LocalStore::open(&dir.0).unwrap();
    let mut worlds = store.worlds().unwrap().whole.into_iter();
    let mut world = worlds.find(|w| w.name == name).unwrap();
    world.quarantined = Some("on purpose".to_owned());
    store.put_world(&world).unwrap();
    store.close().unwrap();
    world.key
}

#[tokio::test]
async fn no_world_takes_the_name_of_one_in_quarantine() {
    let dir = Temporary::new();
    let app = dir.open(&[]).await;
    let (first, written) = created(&app, None).await;
    written.unwrap();
    let name = first.id.to_string();
    drop(first);
    close(app).await;
    let key = quarantine(&dir, &name);

    let app = dir.open(&[]).await;
    // A client that lets the server choose a name gets another one.
    let (second, written) = created(&app, None).await;
    written.unwrap();
    assert_ne!(*second.id, *name);
    // A request that got past the check of its service is refused here.
    let (third, written) = created(&app, Some(&name)).await;
    assert_eq!(written.unwrap_err().reason(), "WORLD_QUARANTINED");
    let persistence = app.persistence.clone().unwrap();
    persistence.deleted(&third).await.unwrap();
    app.worlds.delete(&name, "ann").await.unwrap();
    assert_eq!(persistence.catalogue.get(&name).unwrap().key, key);
    // Once the world is forgotten, its name is free.
    persistence.deleted_in_quarantine(&name).await.unwrap();
    let (_, written) = created(&app, Some(&name)).await;
    written.unwrap();
    close(app).await;
}

#[cfg(unix)]
#[tokio::test]
async fn a_world_whose_file_cannot_be_read_keeps_no_other_away() {
    let dir = Temporary::new();
    let app = dir.open(&[]).await;
    for name in ["good", "bad"] {
        created(&app, Some(name)).await.1.unwrap();
    }
    let key = app.persistence.as_ref().unwrap().catalogue.get("bad");
    let key = key.unwrap().key;
    close(app).await;
    let path = dir.0.join("worlds").join(format!("{key}.world"));
    let kept = std::fs::read(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    std::os::unix::fs::symlink(&path, &path).unwrap();
    let app = dir.open(&[]).await;
    assert!(app.worlds.get("good").is_ok());
    assert!(app.worlds.get("bad").is_err());
    created(&app, Some("other")).await.1.unwrap();
    close(app).await;
    // The disk can read it again.
    std::fs::remove_file(&path).unwrap();
    std::fs::write(&path, kept).unwrap();
    let app = dir.open(&[]).await;
    for name in ["good", "bad", "other"] {
        assert!(app.worlds.get(name).is_ok(), "{name}");
    }
    close(app).await;
}
