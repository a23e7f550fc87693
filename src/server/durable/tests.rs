//! Goal: what is read from a store is what was written, or is named as lost, whatever happens to its files; and what
//! was promised to be on disk is there after the process has gone. Method: worlds whose every byte follows from world
//! and tick are written, the files are copied while the store is open (what a killed process leaves), damaged, and
//! read.

#![allow(clippy::unwrap_used)] // a panic here is the failure message

#[cfg(unix)] // links that lead nowhere
mod faults;

use super::keeper::{Keeper, Sizes};
use super::local::LocalStore;
use super::memory::{Disk, MemoryStore};
use super::recovery::recover;
use super::store::*;
use bytes::Bytes;
use proptest::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

const RETENTION: Retention = Retention {
    age: Duration::from_secs(60),
    world_bytes: 1 << 30,
    total_bytes: 1 << 30,
};
const SIZES: Sizes = Sizes {
    queue_bytes: 1 << 20,
    retention: RETENTION,
};
const WORLDS: usize = 3;
const TICKS: u64 = 60;
/// Ticks between two checkpoints.
const EVERY: u64 = 25;

/// A directory that goes when the test ends.
struct Temporary(PathBuf);

impl Temporary {
    fn new() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        let n = NEXT.fetch_add(1, Ordering::Relaxed);
        let name = format!("sinew-store-{}-{n}", std::process::id());
        let dir = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&dir).unwrap();
        Self(dir)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

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

fn tick_entries(world: &WorldRecord, n: u64, tick: u64) -> Vec<Entry> {
    let entry = |item| Entry {
        world: world.key,
        tick,
        item,
    };
    let input = bytes_of(n, tick, 2, 300);
    let mut out = vec![entry(Item::Input(input)), entry(Item::Hash(n << 32 | tick))];
    if tick.is_multiple_of(EVERY) {
        out.push(entry(Item::Checkpoint {
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

/// Writes all worlds from tick 0 on, all of them in each commit.
fn fill(store: &mut dyn CheckpointStore, ticks: u64) -> Vec<WorldRecord> {
    let worlds: Vec<WorldRecord> = (0..WORLDS as u64).map(|n| world(store, n)).collect();
    let first: Vec<Entry> = worlds
        .iter()
        .zip(0..)
        .map(|(w, n)| Entry {
            world: w.key,
            tick: 0,
            item: Item::Checkpoint {
                bytes: state(n, 0),
                after_gap: false,
            },
        })
        .collect();
    store.commit(&first).unwrap();
    for tick in 1..=ticks {
        let entries: Vec<Entry> = worlds
            .iter()
            .zip(0..)
            .flat_map(|(w, n)| tick_entries(w, n, tick))
            .collect();
        store.commit(&entries).unwrap();
    }
    worlds
}

/// Nothing in it that was not written, in order and without a hole. Returns the last tick.
fn check(n: u64, history: &History) -> Result<Option<u64>, TestCaseError> {
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
        prop_assert_eq!(&input.item, &Item::Input(bytes_of(n, tick, 2, 300)));
        prop_assert_eq!(&hash.item, &Item::Hash(n << 32 | tick));
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

/// What a process leaves that is killed while it writes, once with the last rows in the write-ahead log and once with
/// them in their places.
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

/// Opens, reads and holds everything against what was written. True: something is reported as lost or damaged.
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

#[test]
fn what_a_killed_process_leaves_is_whole() {
    for checkpointed in [false, true] {
        let dir = Temporary::new();
        copy(killed(checkpointed), &dir.0);
        assert!(!judged(&dir.0).unwrap());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(), failure_persistence: None, ..Default::default() })]

    #[test]
    fn damage_is_named_or_harmless(
        checkpointed: bool,
        file: prop::sample::Index,
        at: prop::sample::Index,
        bit in 0..8_u8,
        kind in 0..3,
    ) {
        let dir = Temporary::new();
        copy(killed(checkpointed), &dir.0);
        let mut files = files(&dir.0);
        // Most bytes of a store are in its log; small files have their turn all the same.
        files.retain(|f| f.metadata().unwrap().len() > 0);
        let path = file.get(&files);
        let mut bytes = std::fs::read(path).unwrap();
        let at = at.index(bytes.len());
        match kind {
            0 => bytes[at] ^= 1 << bit,
            1 => bytes.truncate(at),
            _ => {
                // A block that the disk has lost.
                let end = (at + 512).min(bytes.len());
                bytes[at..end].fill(0);
            }
        }
        std::fs::write(path, bytes).unwrap();
        judged(&dir.0).map_err(|e| TestCaseError::fail(format!("{}: {e}", path.display())))?;
    }
}

/// A few here; `PROPTEST_CASES` for more.
fn cases() -> u32 {
    let given = std::env::var("PROPTEST_CASES").ok();
    given.and_then(|n| n.parse().ok()).unwrap_or(96)
}

#[test]
fn no_number_of_a_row_is_trusted() {
    // What a flipped bit leaves in each column, in the last rows too, behind which no hole can be seen.
    for (table, column, lost) in [
        ("log", "world", true),
        ("log", "session", true),
        ("log", "seq", true),
        ("log", "kind", true),
        ("log", "tick", true),
        ("log", "sum", true),
        ("checkpoints", "world", false),
        ("checkpoints", "session", false),
        ("checkpoints", "seq", false),
        ("checkpoints", "tick", false),
        ("checkpoints", "id", false),
    ] {
        for back in 0..WORLDS + 1 {
            for bit in [0, 1, 5] {
                let dir = Temporary::new();
                copy(killed(true), &dir.0);
                let log = rusqlite::Connection::open(dir.0.join("log.sqlite")).unwrap();
                let flip = format!(
                    "UPDATE OR IGNORE {table} SET {column} = ({column} | {mask}) - ({column} & {mask})
                     WHERE rowid = (SELECT rowid FROM {table} ORDER BY rowid DESC LIMIT 1 OFFSET {back})",
                    mask = 1 << bit
                );
                log.execute(&flip, []).unwrap();
                drop(log);
                let reported = judged(&dir.0).unwrap_or_else(|e| panic!("{flip}: {e}"));
                assert!(reported || !lost, "{flip}");
            }
        }
    }
}

/// What an orderly end leaves of a world that rests while others go on.
fn with_one_at_rest() -> (Temporary, Vec<WorldRecord>) {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let worlds = fill(&mut store, 40);
    for tick in 41..=TICKS {
        let entries = worlds.iter().zip(0..).skip(1);
        let entries: Vec<Entry> = entries
            .flat_map(|(w, n)| tick_entries(w, n, tick))
            .collect();
        store.commit(&entries).unwrap();
    }
    store.log().move_to_place();
    (dir, worlds)
}

#[test]
fn the_end_of_a_world_that_rests_is_missed() {
    // Nothing is wrong with the log but that rows in the middle of it are not there.
    for (rows, lost) in [(0, false), (1, true), (7, true), (60, true)] {
        let (dir, worlds) = with_one_at_rest();
        let log = rusqlite::Connection::open(dir.0.join("log.sqlite")).unwrap();
        let key = worlds[0].key.0 as i64;
        let cut = "DELETE FROM log WHERE id IN (SELECT id FROM log WHERE world = ?1 ORDER BY id DESC LIMIT ?2)";
        log.execute(cut, [key, rows]).unwrap();
        drop(log);
        let mut store = LocalStore::open(&dir.0).unwrap();
        let found = recover(&mut store, &[]).unwrap();
        assert!(found.damaged.is_empty(), "{:?}", found.damaged);
        for (world, history) in &found.worlds {
            let rests = world.key == worlds[0].key;
            let last = check(world.name[1..].parse().unwrap(), history).unwrap();
            assert_eq!(
                !history.losses.is_empty(),
                rests && lost,
                "{rows}: {history:?}"
            );
            if !(rests && lost) {
                assert_eq!(last, Some(if rests { 40 } else { TICKS }));
            }
        }
    }
}

#[test]
fn a_page_count_that_is_wrong_loses_nothing_unseen() {
    let (whole, worlds) = with_one_at_rest();
    for bit in 0..32 {
        let dir = Temporary::new();
        copy(&whole.0, &dir.0);
        for end in ["wal", "shm"] {
            let _ = std::fs::remove_file(dir.0.join(format!("log.sqlite-{end}")));
        }
        let path = dir.0.join("log.sqlite");
        let mut bytes = std::fs::read(&path).unwrap();
        bytes[28 + bit / 8] ^= 1 << (bit % 8); // size of the database in pages
        std::fs::write(&path, bytes).unwrap();
        let Ok(mut store) = LocalStore::open(&dir.0) else {
            continue;
        };
        let Ok(found) = recover(&mut store, &[]) else {
            continue;
        };
        for (world, history) in &found.worlds {
            let n = world.name[1..].parse().unwrap();
            let meant = if world.key == worlds[0].key {
                40
            } else {
                TICKS
            };
            let last = check(n, history).unwrap();
            let named = !history.losses.is_empty() || !found.damaged.is_empty();
            assert!(
                last == Some(meant) || named,
                "bit {bit}: w{n} ends at {last:?}"
            );
        }
    }
}

#[test]
fn what_is_held_of_deleted_worlds_is_nothing() {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let checkpoint = |world: WorldKey| Entry {
        world,
        tick: 1,
        item: Item::Checkpoint {
            bytes: state(0, 1),
            after_gap: false,
        },
    };
    for _ in 0..50 {
        let key = world(&mut store, 0).key;
        store.commit(&[checkpoint(key)]).unwrap();
        store.delete_world(key).unwrap();
        // Its thread hands in a last state before it hears of it.
        store.commit(&[checkpoint(key)]).unwrap();
    }
    assert_eq!(store.log().known().count(), 0);
    assert_eq!(store.log().worlds().count(), 0);
    assert!(store.log().ends().is_empty());
}

#[test]
fn rows_of_deleted_worlds_are_not_missed() {
    for left in 0..WORLDS {
        let dir = Temporary::new();
        let mut store = LocalStore::open(&dir.0).unwrap();
        let worlds = fill(&mut store, 30);
        for world in &worlds[left..] {
            store.delete_world(world.key).unwrap();
        }
        while store.cut(&RETENTION).unwrap().unswept {}
        store.close().unwrap();
        drop(store);
        let mut store = LocalStore::open(&dir.0).unwrap();
        assert!(store.last_end().damage.is_empty(), "{:?}", store.last_end());
        let found = recover(&mut store, &[]).unwrap();
        assert!(found.damaged.is_empty(), "{:?}", found.damaged);
        assert_eq!(found.worlds.len(), left);
        for (n, (_, history)) in found.worlds.iter().enumerate() {
            assert!(history.losses.is_empty(), "{:?}", history.losses);
            assert_eq!(check(n as u64, history).unwrap(), Some(30));
        }
    }
}

#[test]
fn each_file_of_a_store_is_needed() {
    // The test above fails if damage is not seen: here every file is overwritten, and all but the notes are missed.
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
fn a_lost_log_leaves_earlier_states() {
    let dir = Temporary::new();
    copy(killed(true), &dir.0);
    std::fs::write(dir.0.join("log.sqlite"), "no database at all").unwrap();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let found = recover(&mut store, &[]).unwrap();
    assert!(found.damaged[0].contains("damaged-"), "{:?}", found.damaged);
    assert_eq!(found.worlds.len(), WORLDS);
    for (world, history) in &found.worlds {
        let n: u64 = world.name[1..].parse().unwrap();
        assert_eq!(check(n, history).unwrap(), Some(50));
        assert_eq!(history.losses[0].after_tick, Some(50));
    }
}

#[test]
fn a_full_disk_loses_the_group_and_nothing_before_it() {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let worlds = fill(&mut store, 30);
    store.log().fill_disk();
    let big = Entry {
        world: worlds[0].key,
        tick: 31,
        item: Item::Input(bytes_of(0, 31, 2, 4_000_000)),
    };
    let error = store.commit(&[big]).unwrap_err();
    assert!(matches!(error, StoreError::Full(_)), "{error}");
    for (n, history) in store
        .latest(&worlds.iter().map(|w| w.key).collect::<Vec<_>>())
        .unwrap()
        .iter()
        .enumerate()
    {
        assert_eq!(check(n as u64, history).unwrap(), Some(30));
    }
    // What can be freed is freed, and then smaller groups fit again.
    store.repair(error.remedy(None)).unwrap();
    store.commit(&tick_entries(&worlds[0], 0, 31)).unwrap();
    let history = &store.latest(&[worlds[0].key]).unwrap()[0];
    assert_eq!(check(0, history).unwrap(), Some(31));
}

#[test]
fn a_read_only_disk_is_named() {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let worlds = fill(&mut store, 3);
    store.log().refuse_writes();
    let error = store.commit(&tick_entries(&worlds[0], 0, 4)).unwrap_err();
    assert!(matches!(error, StoreError::ReadOnly(_)), "{error}");
    let history = &store.latest(&[worlds[0].key]).unwrap()[0];
    assert_eq!(check(0, history).unwrap(), Some(3));
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
    super::files::write(&dir.0.join("format"), b'D', 2, b"").unwrap();
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
    // The first world rests; the others go on.
    for tick in 11..=120 {
        let entries: Vec<Entry> = worlds[1..]
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
    // What was cut off is not there any more, and says nothing else.
    assert_eq!(
        store.history_at(worlds[1].key, 60).unwrap(),
        History::default()
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
    assert_eq!(history.unwrap().1, History::default());
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
    // The thread of the world hands in a last state before it hears of it.
    store
        .commit(&[Entry {
            world: key,
            tick: 6,
            item: Item::Checkpoint {
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
    let contents = || super::files::list(&dir.0.join("contents"), "motion").unwrap();
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
    drop(store); // the first crash: nobody knows which world it was
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
    // It stays so, and an orderly end is no crash.
    store.close().unwrap();
    drop(store);
    let mut store = LocalStore::open(&crashed.0).unwrap();
    assert!(store.last_end().orderly);
    assert_eq!(recover(&mut store, &[]).unwrap().quarantined.len(), 1);
    // Until it is let out.
    assert!(recover(&mut store, &["w1"]).unwrap().quarantined.is_empty());
    assert!(recover(&mut store, &[]).unwrap().quarantined.is_empty());
}

fn recorded(
    disk: &Disk,
    sizes: Sizes,
    durability: Durability,
) -> (Keeper, super::keeper::Recorder) {
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

#[tokio::test]
async fn inputs_are_written_in_groups_and_each_is_on_disk_when_that_is_promised() {
    let disk = Disk::default();
    let (keeper, recorder) = recorded(&disk, SIZES, Durability::Group);
    assert!(recorder.needs_checkpoint());
    recorder.checkpoint(0, state(0, 0));
    assert!(!recorder.needs_checkpoint());
    let mut ticket = None;
    for tick in 1..=500 {
        ticket = Some(recorder.input(tick, bytes_of(0, tick, 2, 10)));
    }
    recorder.durable(ticket.unwrap()).await.unwrap();
    assert_eq!(disk.log().len(), 501);
    assert_eq!(recorder.durable_tick(), 500);
    assert!(disk.commits() < 100, "{} commits", disk.commits());
    drop(recorder);
    keeper.close();
    assert!(disk.is_closed());

    let disk = Disk::default();
    let (keeper, recorder) = recorded(&disk, SIZES, Durability::Each);
    recorder.checkpoint(0, state(0, 0));
    for tick in 1..=20 {
        let ticket = recorder.input(tick, bytes_of(0, tick, 2, 10));
        recorder.durable(ticket).await.unwrap();
        assert_eq!(disk.log().last().unwrap().tick, tick);
    }
    let (_, none) = recorded(&disk, SIZES, Durability::None);
    assert!(!none.needs_checkpoint());
    drop(keeper);
}

#[tokio::test]
async fn a_failing_disk_costs_what_it_fails_at_and_is_told() {
    let disk = Disk::default();
    let (keeper, recorder) = recorded(&disk, SIZES, Durability::Each);
    recorder.checkpoint(0, state(0, 0));
    let ticket = recorder.input(1, bytes_of(0, 1, 2, 10));
    recorder.durable(ticket).await.unwrap();

    disk.fail(Some(StoreError::Full("disk".to_owned())));
    let ticket = recorder.input(2, bytes_of(0, 2, 2, 10));
    let error = recorder.durable(ticket).await.unwrap_err().to_string();
    assert!(error.contains("full"), "{error}");
    assert!(keeper.degraded().unwrap().contains("full"));
    // Until there is a whole state, nothing that would not fit is written.
    disk.fail(None);
    let ticket = recorder.input(3, bytes_of(0, 3, 2, 10));
    recorder.durable(ticket).await.unwrap_err();
    wait("a checkpoint is asked for", || recorder.needs_checkpoint());
    recorder.checkpoint(3, state(0, 3));
    let ticket = recorder.input(4, bytes_of(0, 4, 2, 10));
    recorder.durable(ticket).await.unwrap();
    assert_eq!(keeper.degraded(), None);
    let ticks: Vec<u64> = disk.log().iter().map(|e| e.tick).collect();
    assert_eq!(ticks, [0, 1, 3, 4]);
    let history = MemoryStore(disk.clone())
        .latest(&[recorder.world()])
        .unwrap();
    assert_eq!(history[0].checkpoint.as_ref().unwrap().0, 3);
    // From before it, nobody gets behind the hole.
    let before = MemoryStore(disk).history_at(recorder.world(), 1).unwrap();
    assert_eq!(before.last_tick(), Some(1));
    assert_eq!(before.losses.len(), 1);
}

#[test]
fn a_slow_disk_bounds_the_queue() {
    let disk = Disk::default();
    let (keeper, recorder) = recorded(&disk, SIZES, Durability::Group);
    recorder.checkpoint(0, state(0, 0));
    disk.slow_down(Duration::from_millis(300));
    let begun = Instant::now();
    for tick in 1..=5000 {
        recorder.input(tick, bytes_of(0, tick, 2, 1000));
    }
    assert!(begun.elapsed() < Duration::from_secs(5), "worlds waited");
    assert!(keeper.degraded().unwrap().contains("too slow"));
    disk.slow_down(Duration::ZERO);
    wait("a checkpoint is asked for", || recorder.needs_checkpoint());
    recorder.checkpoint(5000, state(0, 5000));
    wait("it is written", || recorder.durable_tick() == 5000);
    wait("the store is well", || keeper.degraded().is_none());
    let written: usize = disk.log().iter().map(Entry::size).sum();
    assert!(written < 3 * SIZES.queue_bytes, "{written}");
    let last = disk.log().pop().unwrap();
    assert!(matches!(
        last.item,
        Item::Checkpoint {
            after_gap: true,
            ..
        }
    ));
}

#[tokio::test]
async fn nobody_waits_for_a_thread_that_has_panicked() {
    let disk = Disk::default();
    let (keeper, recorder) = recorded(&disk, SIZES, Durability::Each);
    recorder.checkpoint(0, state(0, 0));
    let ticket = recorder.input(1, bytes_of(0, 1, 2, 10));
    recorder.durable(ticket).await.unwrap();
    let panics = |_: &mut dyn CheckpointStore| -> Result<(), StoreError> { panic!("on purpose") };
    let ended = |result: Result<(), StoreError>| matches!(result, Err(StoreError::Ended));
    assert!(ended(keeper.call(panics).await));
    let ticket = recorder.input(2, bytes_of(0, 2, 2, 10));
    assert!(recorder.durable(ticket).await.is_err());
    assert!(ended(keeper.call(|_| Ok(())).await));
    assert!(keeper.degraded().unwrap().contains("panicked"));
    assert_eq!(recorder.durable_tick(), 1);
}

#[tokio::test]
async fn a_hole_in_the_log_is_not_stepped_over() {
    // The same as above, in files: rows before and behind what was not written.
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let world = world(&mut store, 0);
    let keeper = Keeper::start(Box::new(store), SIZES).unwrap();
    let recorder = keeper.recorder(&world);
    recorder.checkpoint(0, state(0, 0));
    let last = recorder.input(1, bytes_of(0, 1, 2, 10));
    recorder.durable(last).await.unwrap();
    recorder.input(2, bytes_of(0, 2, 2, 2 << 20)); // more than the queue takes
    recorder.checkpoint(2, state(0, 2));
    let last = recorder.input(3, bytes_of(0, 3, 2, 10));
    recorder.durable(last).await.unwrap();
    let key = world.key;
    let (before, latest) = keeper
        .call(move |s| Ok((s.history_at(key, 1)?, s.latest(&[key])?)))
        .await
        .unwrap();
    assert_eq!(before.last_tick(), Some(1));
    assert_eq!(before.losses.len(), 1);
    assert_eq!(latest[0].checkpoint.as_ref().unwrap().0, 2);
    assert_eq!(latest[0].last_tick(), Some(3));
    assert!(latest[0].losses.is_empty());
}

#[test]
fn a_note_that_cannot_be_written_costs_nothing() {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let worlds = fill(&mut store, 3);
    let note = dir.0.join("log.end");
    std::fs::remove_file(&note).unwrap();
    std::fs::create_dir(&note).unwrap();
    // It is on disk, so it is not called a failure: the log would be set aside for that.
    for tick in 4..=5 {
        store.commit(&tick_entries(&worlds[0], 0, tick)).unwrap();
    }
    drop(store);
    let mut store = LocalStore::open(&dir.0).unwrap();
    let history = &store.latest(&[worlds[0].key]).unwrap()[0];
    assert_eq!(check(0, history).unwrap(), Some(5));
    assert!(history.losses.is_empty(), "{:?}", history.losses);
}

#[test]
fn a_log_that_another_program_holds_is_not_given_up() {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let worlds = fill(&mut store, 3);
    store.log().wait_for_nobody();
    let other = rusqlite::Connection::open(dir.0.join("log.sqlite")).unwrap();
    other.execute_batch("BEGIN IMMEDIATE").unwrap();
    let next = tick_entries(&worlds[0], 0, 4);
    let error = store.commit(&next).unwrap_err();
    assert!(matches!(error, StoreError::Busy(_)), "{error}");
    assert_eq!(error.remedy(None), Remedy::Pause);
    other.execute_batch("ROLLBACK").unwrap();
    drop(other);
    store.commit(&next).unwrap();
    let history = &store.latest(&[worlds[0].key]).unwrap()[0];
    assert_eq!(check(0, history).unwrap(), Some(4));
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
fn an_earlier_state_is_never_that_of_another_world() {
    // The table that says where checkpoints are has no checksums: it may name rows of others, or none at all.
    for wrong in ["two change places", "there is no such row"] {
        let dir = Temporary::new();
        let mut store = LocalStore::open(&dir.0).unwrap();
        fill(&mut store, 30);
        drop(store);
        let log = rusqlite::Connection::open(dir.0.join("log.sqlite")).unwrap();
        let last = |back: usize| -> i64 {
            let sql = "SELECT id FROM checkpoints ORDER BY id DESC LIMIT 1 OFFSET ?1";
            log.query_row(sql, [back as i64], |r| r.get(0)).unwrap()
        };
        let (a, b) = (last(0), last(1));
        let moves = match wrong {
            "two change places" => vec![(a, 0), (b, a), (0, b)],
            _ => vec![(a, a + 1000)],
        };
        for (from, to) in moves {
            let sql = "UPDATE checkpoints SET id = ?2 WHERE id = ?1";
            assert_eq!(log.execute(sql, [from, to]).unwrap(), 1);
        }
        drop(log);
        let mut store = LocalStore::open(&dir.0).unwrap();
        // An end is orderly all the same.
        store.close().unwrap();
        drop(store);
        std::fs::write(dir.0.join("log.sqlite"), "no database at all").unwrap();
        let mut store = LocalStore::open(&dir.0).unwrap();
        assert!(store.last_end().orderly);
        let found = recover(&mut store, &[]).unwrap();
        assert_eq!(found.worlds.len(), WORLDS);
        for (world, history) in &found.worlds {
            let n: u64 = world.name[1..].parse().unwrap();
            check(n, history).unwrap_or_else(|e| panic!("{wrong}: {e}"));
        }
    }
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

#[tokio::test]
async fn who_asks_late_learns_what_was_lost() {
    let disk = Disk::default();
    let (_keeper, recorder) = recorded(&disk, SIZES, Durability::Each);
    recorder.checkpoint(0, state(0, 0));
    let mut lost = Vec::new();
    for tick in [1, 3] {
        let ticket = recorder.input(tick, bytes_of(0, tick, 2, 10));
        recorder.durable(ticket).await.unwrap();
        disk.fail(Some(StoreError::Full("disk".to_owned())));
        let ticket = recorder.input(tick + 1, bytes_of(0, tick + 1, 2, 10));
        recorder.durable(ticket).await.unwrap_err();
        lost.push(ticket);
        disk.fail(None);
        wait("a checkpoint is asked for", || recorder.needs_checkpoint());
        let whole = recorder.checkpoint(tick + 1, state(0, tick + 1));
        recorder.durable(whole).await.unwrap();
    }
    for ticket in lost {
        recorder.durable(ticket).await.unwrap_err();
    }
}
