//! Files of a data directory, as a server finds them at its start.

use crate::fuzz::edit::{damaged, edits};
use crate::fuzz::runner;
use bytes::Bytes;
use proptest::prelude::*;
use sinew_server::durable::local::LocalStore;
use sinew_server::durable::recovery::recover;
use sinew_server::durable::store::{
    CheckpointStore, ClipRecord, Durability, StoreEntry, StoreItem, WorldRecord,
};
use std::cell::Cell;
use std::path::{Path, PathBuf};

/// In memory if possible, because a million directories are made.
fn folder(name: &str) -> PathBuf {
    let memory = Path::new("/dev/shm");
    let place = if memory.is_dir() {
        memory.to_owned()
    } else {
        std::env::temp_dir()
    };
    let dir = place.join(format!("sinew-fuzz-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&dir);
    dir
}

/// Two worlds with a little history, and a clip.
fn fill(dir: &Path) {
    let mut store = LocalStore::open(dir).unwrap();
    for name in ["first", "second"] {
        let world = WorldRecord {
            key: store.new_key(),
            name: name.into(),
            durability: Durability::Group,
            quarantined: None,
            settings: Bytes::from_static(b"settings of a world"),
        };
        store.put_world(&world).unwrap();
        let entry = |tick, item| StoreEntry {
            world: world.key,
            tick,
            item,
        };
        let checkpoint = |n: u8| StoreItem::Checkpoint {
            bytes: vec![n; 300].into(),
            after_gap: false,
        };
        let entries = [
            entry(0, checkpoint(1)),
            entry(1, StoreItem::Input(Bytes::from_static(b"input"))),
            entry(2, StoreItem::Hash(7)),
            entry(3, checkpoint(2)),
            entry(4, StoreItem::Input(Bytes::from_static(b"another"))),
        ];
        store.commit(&entries).unwrap();
    }
    let clip = ClipRecord {
        name: "clip".into(),
        description: Bytes::from_static(b"what it is"),
        content: vec![3; 200].into(),
    };
    store.put_clip(&clip).unwrap();
}

fn files(dir: &Path, out: &mut Vec<(PathBuf, Vec<u8>)>) {
    for entry in std::fs::read_dir(dir).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, out);
        } else {
            let bytes = std::fs::read(&path).unwrap();
            out.push((path, bytes));
        }
    }
    out.sort();
}

/// A start on damaged files reports the loss, or finds the content; it never fails in another way.
#[test]
fn a_start_on_damaged_files_finds_or_names() {
    let good = folder("good");
    fill(&good);
    let mut there = Vec::new();
    files(&good, &mut there);
    let there: Vec<_> = there
        .into_iter()
        .map(|(path, bytes)| (path.strip_prefix(&good).unwrap().to_owned(), bytes))
        .collect();
    let count = there.len();
    assert!(count >= 4, "{there:?}");
    let dir = folder("bad");
    let (whole, named, refused) = (Cell::new(0u64), Cell::new(0u64), Cell::new(0u64));
    let strategy = (0..count, edits(3), any::<bool>());
    let done = runner(60).run(&strategy, |(which, edits, checksum)| {
        let _ = std::fs::remove_dir_all(&dir);
        for (i, (path, bytes)) in there.iter().enumerate() {
            let path = dir.join(path);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            let mut bytes = bytes.clone();
            if i == which {
                bytes = damaged(bytes, &edits);
                if checksum {
                    sign(&mut bytes);
                }
            }
            std::fs::write(path, bytes).unwrap();
        }
        match LocalStore::open(&dir).and_then(|mut store| recover(&mut store, &[])) {
            Err(e) => {
                refused.set(refused.get() + 1);
                prop_assert!(!e.to_string().is_empty());
            }
            Ok(found) => {
                let lost = found.worlds.iter().any(|(_, h)| !h.losses.is_empty());
                let all = found.worlds.len() == 2 && found.clips.len() == 1;
                let counter = if all && !lost && found.damaged.is_empty() {
                    &whole
                } else {
                    &named
                };
                counter.set(counter.get() + 1);
            }
        }
        Ok(())
    });
    let _ = std::fs::remove_dir_all(&dir);
    let _ = std::fs::remove_dir_all(&good);
    if let Err(e) = done {
        panic!("{e}");
    }
    println!(
        "{} whole, {} named what is lost, {} refused",
        whole.get(),
        named.get(),
        refused.get()
    );
    assert!(whole.get() > 0 && named.get() + refused.get() > 0);
}

/// Gives a small file (magic 5, kind 1, format 4, checksum 4) a correct checksum, as a forger would.
fn sign(bytes: &mut [u8]) {
    if bytes.len() < 14 || !bytes.starts_with(b"SINEW") {
        return;
    }
    let mut sum = crc32fast::Hasher::new();
    sum.update(&bytes[..10]);
    sum.update(&bytes[14..]);
    bytes[10..14].copy_from_slice(&sum.finalize().to_le_bytes());
}
