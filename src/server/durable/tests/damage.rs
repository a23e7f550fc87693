//! Goal: data read from a store are as they were written, or are reported as lost, whatever happens to its files.
//! Method: files of a killed process are damaged in single bytes, rows and pages, cut off, exchanged, and read.

use super::*;

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
        // Most bytes of a store are in its log, but small files must have their turn too.
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
    // A flipped bit in each column, in the last rows too, after which no hole is visible.
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

#[test]
fn the_end_of_a_world_that_rests_is_missed() {
    // The log is intact, except that rows in the middle are missing.
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
    // It is reported once: the end note of the old log is not applied to the new one.
    drop(store);
    let store = LocalStore::open(&dir.0).unwrap();
    assert_eq!(store.last_end().damage, Vec::<String>::new());
}

#[tokio::test]
async fn a_hole_in_the_log_is_not_stepped_over() {
    // The same as above, in files: rows before and after an unwritten gap.
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let world = world(&mut store, 0);
    let keeper = Keeper::start(Box::new(store), SIZES).unwrap();
    let recorder = keeper.recorder(&world);
    recorder.checkpoint(0, state(0, 0));
    let last = recorder.input(1, bytes_of(0, 1, 2, 10));
    recorder.durable(last).await.unwrap();
    recorder.input(2, bytes_of(0, 2, 2, 2 << 20)); // more than the queue accepts
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
fn an_earlier_state_is_never_that_of_another_world() {
    // The table of checkpoints has no checksums, so it may name rows of other worlds, or rows that do not exist.
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
        // The end is still orderly.
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
