//! Goal: worlds and clips are created, deleted and kept as requested, and one directory serves one server. Method: the
//! store is opened, used and opened again.

use super::*;

#[test]
fn what_is_held_of_deleted_worlds_is_nothing() {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let checkpoint = |world: WorldKey| StoreEntry {
        world,
        tick: 1,
        item: StoreItem::Checkpoint {
            bytes: state(0, 1),
            after_gap: false,
        },
    };
    for _ in 0..50 {
        let key = world(&mut store, 0).key;
        store.commit(&[checkpoint(key)]).unwrap();
        store.delete_world(key).unwrap();
        // Its thread hands in a last state before it learns of the deletion.
        store.commit(&[checkpoint(key)]).unwrap();
    }
    assert_eq!(store.log().known().count(), 0);
    assert_eq!(store.log().worlds().count(), 0);
    assert!(store.log().ends().is_empty());
}

#[test]
fn each_file_of_a_store_is_needed() {
    // Shows that the test above can fail: here every file is overwritten, and the damage is noticed in all but
    // auxiliary files.
    let left = killed(true);
    let mut missed = 0;
    for path in files(left) {
        let name = path.strip_prefix(left).unwrap();
        let dir = Temporary::new();
        copy(left, &dir.0);
        let length = path.metadata().unwrap().len() as usize;
        std::fs::write(dir.0.join(name), bytes_of(9, 9, 9, length)).unwrap();
        let harmless = [
            "lock",
            "stepping",
            "log.end",
            "log.sqlite-shm",
            "log.sqlite-wal",
        ];
        let spare = name.extension().is_some_and(|e| e == "state");
        let reported = judged(&dir.0).unwrap();
        if !spare && !harmless.contains(&&*name.to_string_lossy()) {
            assert!(reported, "{}", name.display());
            missed += 1;
        }
    }
    assert!(missed >= 1 + 1 + WORLDS + 3 + 3, "{missed}");
}

#[test]
fn one_directory_serves_one_server() {
    let dir = Temporary::new();
    let first = LocalStore::open(&dir.0).unwrap();
    let error = LocalStore::open(&dir.0).map(drop).unwrap_err().to_string();
    assert!(
        error.contains("another server uses this directory"),
        "{error}"
    );
    assert!(error.contains(&std::process::id().to_string()), "{error}");
    drop(first);
    LocalStore::open(&dir.0).unwrap();
}

#[test]
fn a_later_format_and_a_file_are_refused() {
    let dir = Temporary::new();
    drop(LocalStore::open(&dir.0).unwrap());
    super::super::files::write(&dir.0.join("format"), b'D', 2, b"").unwrap();
    let error = LocalStore::open(&dir.0).map(drop).unwrap_err().to_string();
    assert!(
        error.contains("format 2") && error.contains("later version"),
        "{error}"
    );

    let dir = Temporary::new();
    drop(LocalStore::open(&dir.0).unwrap());
    let log = rusqlite::Connection::open(dir.0.join("log.sqlite")).unwrap();
    log.pragma_update(None, "user_version", 7).unwrap();
    drop(log);
    let error = LocalStore::open(&dir.0).map(drop).unwrap_err().to_string();
    assert!(
        error.contains("format 7") && error.contains("later version"),
        "{error}"
    );

    let error = LocalStore::open(&dir.0.join("format"))
        .map(drop)
        .unwrap_err();
    assert!(error.to_string().contains("must be a directory"), "{error}");
}

#[test]
fn old_history_is_cut_off_and_the_latest_state_stays() {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let worlds = fill(&mut store, 10);
    // The first world rests; the others continue.
    for tick in 11..=120 {
        let entries: Vec<StoreEntry> = worlds[1..]
            .iter()
            .zip(1..)
            .flat_map(|(w, n)| tick_entries(w, n, tick))
            .collect();
        store.commit(&entries).unwrap();
    }
    let before = store.cut(&RETENTION).unwrap();
    let after = store
        .cut(&Retention {
            world_bytes: 30_000,
            ..RETENTION
        })
        .unwrap();
    assert!(
        after.history_bytes < before.history_bytes / 2,
        "{before:?} {after:?}"
    );
    assert_eq!(after.checkpoints, WORLDS);
    drop(store);
    let mut store = LocalStore::open(&dir.0).unwrap();
    for (n, last) in [(0, 10), (1, 120), (2, 120)] {
        let history = &store.latest(&[worlds[n].key]).unwrap()[0];
        assert_eq!(check(n as u64, history).unwrap(), Some(last));
        assert!(history.losses.is_empty(), "{:?}", history.losses);
    }
    // Rows that were cut off no longer exist, and cause no other report.
    assert_eq!(
        store.history_at(worlds[1].key, 60).unwrap(),
        StoredHistory::default()
    );
    let hashes = store.hashes(worlds[1].key, 100..121).unwrap();
    assert_eq!(
        hashes,
        (101..=120).map(|t| (t, 1 << 32 | t)).collect::<Vec<_>>()
    );
}

#[test]
fn a_deleted_world_is_gone_and_its_name_is_free() {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let worlds = fill(&mut store, 5);
    store.delete_world(worlds[0].key).unwrap();
    let again = world(&mut store, 0);
    drop(store);
    let mut store = LocalStore::open(&dir.0).unwrap();
    let found = recover(&mut store, &[]).unwrap();
    assert!(found.damaged.is_empty(), "{:?}", found.damaged);
    assert_eq!(found.worlds.len(), WORLDS);
    let history = found.worlds.iter().find(|(w, _)| w.key == again.key);
    assert_eq!(history.unwrap().1, StoredHistory::default());
}

#[test]
fn a_kill_in_the_middle_of_a_deletion_is_no_damage() {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let worlds = fill(&mut store, 5);
    let key = worlds[0].key;
    let whole = dir.0.join("worlds").join(format!("{key}.world"));
    let kept = std::fs::read(&whole).unwrap();
    store.delete_world(key).unwrap();
    // The thread of the world hands in a last state before it learns of the deletion.
    store
        .commit(&[StoreEntry {
            world: key,
            tick: 6,
            item: StoreItem::Checkpoint {
                bytes: state(0, 6),
                after_gap: false,
            },
        }])
        .unwrap();
    drop(store);
    for killed_after_the_first_step in [false, true] {
        if killed_after_the_first_step {
            std::fs::write(whole.with_extension("gone"), &kept).unwrap();
        }
        let mut store = LocalStore::open(&dir.0).unwrap();
        let found = recover(&mut store, &[]).unwrap();
        assert!(found.damaged.is_empty(), "{:?}", found.damaged);
        assert_eq!(found.worlds.len(), WORLDS - 1);
        assert!(!whole.with_extension("gone").exists());
    }
}

#[test]
fn clips_share_their_content() {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let twin = ClipRecord {
        name: "twin".to_owned(),
        ..clip(1)
    };
    store.put_clip(&clip(1)).unwrap();
    store.put_clip(&twin).unwrap();
    let contents = || super::super::files::list(&dir.0.join("contents"), "motion").unwrap();
    assert_eq!(contents().len(), 1);
    store.delete_clip("clip-1").unwrap();
    assert_eq!(store.clips().unwrap().whole, [twin]);
    store.delete_clip("twin").unwrap();
    assert!(contents().is_empty() && store.clips().unwrap().whole.is_empty());
}

#[test]
fn a_world_that_was_stepped_at_two_crashes_is_quarantined() {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let worlds = fill(&mut store, 5);
    drop(store); // the first crash: the world that caused it is unknown
    let store = LocalStore::open(&dir.0).unwrap();
    assert!(!store.last_end().orderly);
    let marks = store.marks();
    let (good, bad) = (marks.place(worlds[0].key), marks.place(worlds[1].key));
    let (good, bad) = (good.unwrap(), bad.unwrap());
    good.begin(6);
    good.end();
    bad.begin(6);
    let crashed = Temporary::new();
    copy(&dir.0, &crashed.0);
    let mut store = LocalStore::open(&crashed.0).unwrap();
    let found = recover(&mut store, &[]).unwrap();
    assert_eq!(found.quarantined.len(), 1);
    assert_eq!(found.quarantined[0].key, worlds[1].key);
    let why = found.quarantined[0].quarantined.clone().unwrap();
    assert!(why.contains("tick 6"), "{why}");
    assert_eq!(found.worlds.len(), WORLDS - 1);
    // It stays so, and an orderly end does not count as a crash.
    store.close().unwrap();
    drop(store);
    let mut store = LocalStore::open(&crashed.0).unwrap();
    assert!(store.last_end().orderly);
    assert_eq!(recover(&mut store, &[]).unwrap().quarantined.len(), 1);
    // Until it is released.
    assert!(recover(&mut store, &["w1"]).unwrap().quarantined.is_empty());
    assert!(recover(&mut store, &[]).unwrap().quarantined.is_empty());
}

#[test]
fn what_a_killed_process_was_writing_is_removed() {
    let dir = Temporary::new();
    drop(LocalStore::open(&dir.0).unwrap());
    let left = ["end", "worlds/0", "clips/0", "contents/0", "rehearsals/0"];
    let left = left.map(|name| dir.0.join(name).with_extension("new"));
    left.iter().for_each(|p| std::fs::write(p, "half").unwrap());
    drop(LocalStore::open(&dir.0).unwrap());
    assert!(left.iter().all(|p| !p.exists()));
}

#[test]
fn a_copy_of_the_file_of_a_world_is_no_other_world() {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let key = fill(&mut store, 3)[0].key;
    let file = dir.0.join("worlds").join(format!("{key}.world"));
    std::fs::copy(&file, file.with_file_name("spare.world")).unwrap();
    drop(store);
    let found = recover(&mut LocalStore::open(&dir.0).unwrap(), &[]).unwrap();
    assert_eq!(found.worlds.len(), WORLDS);
    assert!(
        found.damaged[0].contains("spare.world"),
        "{:?}",
        found.damaged
    );
}
