//! Tests of the store, and their shared helpers: worlds whose every byte follows from world and tick, and copies of the
//! files of an open store, as a killed process leaves them.

#![allow(clippy::unwrap_used)] // a panic here is the failure message

mod contents;
mod damage;
mod disk;
#[cfg(unix)] // links that lead nowhere
mod faults;
mod writing;

use super::keeper::{Keeper, KeeperSizes, Recorder};
use super::local::LocalStore;
use super::memory::{MemoryDisk, MemoryStore};
use super::recovery::recover;
use super::store::*;
use crate::testing::Temporary;
use bytes::Bytes;
use proptest::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

const RETENTION: Retention = Retention {
    age: Duration::from_secs(60),
    world_bytes: 1 << 30,
    total_bytes: 1 << 30,
};
const SIZES: KeeperSizes = KeeperSizes {
    queue_bytes: 1 << 20,
    retention: RETENTION,
};
const WORLDS: usize = 3;
const TICKS: u64 = 60;
/// Ticks between two checkpoints.
const EVERY: u64 = 25;

fn bytes_of(world: u64, tick: u64, salt: u64, length: usize) -> Bytes {
    let mut x = (world << 1) ^ (tick << 20) ^ (salt << 50) | 1;
    (0..length)
        .map(|_| {
            x = x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (x >> 56) as u8
        })
        .collect()
}

fn state(n: u64, tick: u64) -> Bytes {
    bytes_of(n, tick, 1, 20_000)
}

fn tick_entries(world: &WorldRecord, n: u64, tick: u64) -> Vec<StoreEntry> {
    let entry = |item| StoreEntry {
        world: world.key,
        tick,
        item,
    };
    let input = bytes_of(n, tick, 2, 300);
    let mut out = vec![
        entry(StoreItem::Input(input)),
        entry(StoreItem::Hash(n << 32 | tick)),
    ];
    if tick.is_multiple_of(EVERY) {
        out.push(entry(StoreItem::Checkpoint {
            bytes: state(n, tick),
            after_gap: false,
        }));
    }
    out
}

fn world(store: &mut dyn CheckpointStore, n: u64) -> WorldRecord {
    let world = WorldRecord {
        key: store.new_key(),
        name: format!("w{n}"),
        durability: Durability::Group,
        quarantined: None,
        settings: bytes_of(n, 0, 3, 100),
    };
    store.put_world(&world).unwrap();
    world
}

fn clip(n: u64) -> ClipRecord {
    ClipRecord {
        name: format!("clip-{n}"),
        description: bytes_of(n, 0, 4, 60),
        content: bytes_of(n, 0, 5, 3000),
    }
}

/// Writes all worlds from tick 0, all of them in each commit.
fn fill(store: &mut dyn CheckpointStore, ticks: u64) -> Vec<WorldRecord> {
    let worlds: Vec<WorldRecord> = (0..WORLDS as u64).map(|n| world(store, n)).collect();
    let first: Vec<StoreEntry> = worlds
        .iter()
        .zip(0..)
        .map(|(w, n)| StoreEntry {
            world: w.key,
            tick: 0,
            item: StoreItem::Checkpoint {
                bytes: state(n, 0),
                after_gap: false,
            },
        })
        .collect();
    store.commit(&first).unwrap();
    for tick in 1..=ticks {
        let entries: Vec<StoreEntry> = worlds
            .iter()
            .zip(0..)
            .flat_map(|(w, n)| tick_entries(w, n, tick))
            .collect();
        store.commit(&entries).unwrap();
    }
    worlds
}

/// Checks that it contains only written data, in order and without a hole. Returns the last tick.
fn check(n: u64, history: &StoredHistory) -> Result<Option<u64>, TestCaseError> {
    let Some((from, bytes)) = &history.checkpoint else {
        prop_assert!(history.entries.is_empty());
        return Ok(None);
    };
    prop_assert_eq!(bytes, &state(n, *from));
    let (pairs, rest) = history.entries.as_chunks::<2>();
    prop_assert!(rest.is_empty());
    for (i, [input, hash]) in pairs.iter().enumerate() {
        let tick = from + 1 + i as u64;
        prop_assert_eq!((input.tick, hash.tick), (tick, tick));
        prop_assert_eq!(&input.item, &StoreItem::Input(bytes_of(n, tick, 2, 300)));
        prop_assert_eq!(&hash.item, &StoreItem::Hash(n << 32 | tick));
    }
    Ok(history.last_tick())
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            copy(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), target).unwrap();
        }
    }
}

fn files(dir: &Path) -> Vec<PathBuf> {
    let mut out = Vec::new();
    for entry in std::fs::read_dir(dir).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            out.extend(files(&path));
        } else {
            out.push(path);
        }
    }
    out.sort();
    out
}

/// The files left by a process killed while writing, with the last rows either in the write-ahead log or in their final
/// places.
fn killed(checkpointed: bool) -> &'static Path {
    static LEFT: [OnceLock<Temporary>; 2] = [OnceLock::new(), OnceLock::new()];
    let left = LEFT[usize::from(checkpointed)].get_or_init(|| {
        let (live, left) = (Temporary::new(), Temporary::new());
        let mut store = LocalStore::open(&live.0).unwrap();
        fill(&mut store, TICKS);
        for n in 0..4 {
            store.put_clip(&clip(n % 3)).unwrap();
        }
        for _ in 0..WORLDS {
            store.cut(&RETENTION).unwrap(); // writes states beside the log
        }
        if checkpointed {
            store.repair(Remedy::Free).unwrap();
        }
        copy(&live.0, &left.0);
        left
    });
    &left.0
}

/// The files after an orderly end, with one world resting while others continue.
fn with_one_at_rest() -> (Temporary, Vec<WorldRecord>) {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let worlds = fill(&mut store, 40);
    for tick in 41..=TICKS {
        let entries = worlds.iter().zip(0..).skip(1);
        let entries: Vec<StoreEntry> = entries
            .flat_map(|(w, n)| tick_entries(w, n, tick))
            .collect();
        store.commit(&entries).unwrap();
    }
    store.log().move_to_place();
    (dir, worlds)
}

/// Opens and reads everything, and compares it with the written data. Returns whether something is reported as lost or
/// damaged.
fn judged(dir: &Path) -> Result<bool, TestCaseError> {
    let mut store = match LocalStore::open(dir) {
        Ok(store) => store,
        Err(error) => {
            prop_assert!(
                error.to_string().contains(&*dir.to_string_lossy()),
                "{error}"
            );
            return Ok(true);
        }
    };
    let found = match recover(&mut store, &[]) {
        Ok(found) => found,
        Err(_) => return Ok(true),
    };
    let mut reported = !found.damaged.is_empty();
    let named = found.damaged.len();
    prop_assert!(found.worlds.len() + named >= WORLDS, "{found:?}");
    prop_assert!(found.clips.len() + named >= 3);
    prop_assert!(found.quarantined.is_empty());
    for (world, history) in &found.worlds {
        let n: u64 = world.name[1..].parse().unwrap();
        prop_assert_eq!(&world.settings, &bytes_of(n, 0, 3, 100));
        let last = check(n, history)?;
        let whole = last == Some(TICKS);
        prop_assert!(
            whole || !history.losses.is_empty() || named > 0,
            "{} ends at {last:?}, and nothing says so",
            world.name
        );
        reported |= !history.losses.is_empty();
        let middle = store.history_at(world.key, 30);
        if let Ok(history) = middle {
            check(n, &history)?;
        }
    }
    for clip in &found.clips {
        let n = clip.name["clip-".len()..].parse().unwrap();
        prop_assert_eq!(clip, &self::clip(n));
    }
    Ok(reported)
}

fn recorded(disk: &MemoryDisk, sizes: KeeperSizes, durability: Durability) -> (Keeper, Recorder) {
    let mut store = MemoryStore(disk.clone());
    let mut world = world(&mut store, 0);
    world.durability = durability;
    let keeper = Keeper::start(Box::new(store), sizes).unwrap();
    let recorder = keeper.recorder(&world);
    (keeper, recorder)
}

fn wait(what: &str, mut done: impl FnMut() -> bool) {
    let begun = Instant::now();
    while !done() {
        assert!(begun.elapsed() < Duration::from_secs(20), "{what}");
        std::thread::park_timeout(Duration::from_millis(1));
    }
}
