//! Goal: a fault of the disk loses only the data that it affects. Method: single files are made unreadable, single
//! commits and reads fail, single rows are removed.

use super::*;

/// Makes a file unreadable even for root: replaces it by a directory of its name, or by a link to itself.
fn make_unreadable(path: &Path, as_directory: bool) {
    std::fs::remove_file(path).unwrap();
    if as_directory {
        std::fs::create_dir(path).unwrap();
    } else {
        std::os::unix::fs::symlink(path.file_name().unwrap(), path).unwrap();
    }
}

/// A store with one clip for each world, and rehearsals of the clips.
fn with_everything() -> (Temporary, Vec<WorldRecord>) {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let worlds = fill(&mut store, 5);
    for n in 0..WORLDS as u64 {
        store.put_clip(&clip(n)).unwrap();
        let rehearsal = RehearsalRecord {
            clip: clip(n).name,
            figure: "f".to_owned(),
            content: bytes_of(n, 0, 6, 40),
        };
        store.put_rehearsal(&rehearsal).unwrap();
    }
    store.close().unwrap();
    (dir, worlds)
}

#[test]
fn a_file_that_cannot_be_read_takes_nothing_else_with_it() {
    let (whole, worlds) = with_everything();
    let first = |folder: &str, end: &str| {
        super::super::files::list(&whole.0.join(folder), end).unwrap()[0].clone()
    };
    let key = worlds[0].key;
    for (path, lost) in [
        (first("worlds", "world"), [1, 0, 0]),
        (first("clips", "clip"), [0, 1, 0]),
        (first("contents", "motion"), [0, 1, 0]),
        (first("rehearsals", "rehearsal"), [0, 0, 1]),
    ] {
        for as_directory in [false, true] {
            let dir = Temporary::new();
            copy(&whole.0, &dir.0);
            let path = dir.0.join(path.strip_prefix(&whole.0).unwrap());
            make_unreadable(&path, as_directory);
            // Twice, because later starts must behave the same.
            for _ in 0..2 {
                let mut store = LocalStore::open(&dir.0).unwrap();
                let found = recover(&mut store, &[]).unwrap();
                let there = [
                    found.worlds.len(),
                    found.clips.len(),
                    found.rehearsals.len(),
                ];
                assert_eq!(there, lost.map(|n| WORLDS - n), "{}", path.display());
                let name = path.file_name().unwrap().to_str().unwrap();
                assert_eq!(found.damaged.len(), 1, "{:?}", found.damaged);
                assert!(found.damaged[0].contains(name), "{:?}", found.damaged);
                assert!(
                    found.damaged[0].contains("cannot be read"),
                    "{:?}",
                    found.damaged
                );
                assert!(store.new_key() > key, "its number is taken");
            }
        }
    }
}

#[test]
fn a_world_whose_file_can_be_read_again_comes_back_whole() {
    let (dir, worlds) = with_everything();
    let path = dir
        .0
        .join("worlds")
        .join(format!("{}.world", worlds[0].key));
    let kept = std::fs::read(&path).unwrap();
    make_unreadable(&path, false);
    let mut store = LocalStore::open(&dir.0).unwrap();
    assert_eq!(recover(&mut store, &[]).unwrap().worlds.len(), WORLDS - 1);
    // Its rows belong to no known world, but they stay.
    while store.cut(&RETENTION).unwrap().unswept {}
    store.close().unwrap();
    drop(store);
    std::fs::remove_file(&path).unwrap();
    std::fs::write(&path, kept).unwrap();
    let found = recover(&mut LocalStore::open(&dir.0).unwrap(), &[]).unwrap();
    assert_eq!(found.damaged, Vec::<String>::new());
    for (world, history) in &found.worlds {
        let n = world.name[1..].parse().unwrap();
        assert_eq!(check(n, history).unwrap(), Some(5));
        assert!(history.losses.is_empty(), "{:?}", history.losses);
    }
}

#[test]
fn the_number_of_a_world_that_cannot_be_read_is_not_given_again() {
    let dir = Temporary::new();
    drop(LocalStore::open(&dir.0).unwrap());
    let later = WorldKey(u64::MAX / 2); // the clock was ahead
    std::fs::create_dir(dir.0.join("worlds").join(format!("{later}.world"))).unwrap();
    let mut store = LocalStore::open(&dir.0).unwrap();
    assert_eq!(store.worlds().unwrap().damaged.len(), 1);
    assert!(store.new_key() > later);
}

#[test]
fn an_earlier_state_that_cannot_be_read_is_a_loss_of_its_world() {
    for as_directory in [false, true] {
        let (dir, worlds) = with_everything();
        let key = worlds[0].key;
        let path = dir.0.join("worlds").join(format!("{key}.state"));
        make_unreadable(&path, as_directory);
        for file in ["log.sqlite", "log.end"] {
            std::fs::remove_file(dir.0.join(file)).unwrap();
        }
        let found = recover(&mut LocalStore::open(&dir.0).unwrap(), &[]).unwrap();
        assert_eq!(found.worlds.len(), WORLDS);
        for (world, history) in &found.worlds {
            let lost = world.key == key;
            assert_eq!(history.checkpoint.is_none(), lost, "{history:?}");
            assert!(
                !lost || history.losses[0].why.contains("cannot be read"),
                "{history:?}"
            );
        }
    }
}

#[test]
fn what_is_left_of_others_does_not_keep_a_start_back() {
    let (dir, worlds) = with_everything();
    // Half a file and the rest of a deleted world that cannot be removed.
    std::fs::create_dir(dir.0.join("clips").join("half.new")).unwrap();
    let key = worlds[0].key;
    let path = dir.0.join("worlds").join(format!("{key}.gone"));
    std::fs::rename(path.with_extension("world"), &path).unwrap();
    make_unreadable(&path.with_extension("state"), true);
    let found = recover(&mut LocalStore::open(&dir.0).unwrap(), &[]).unwrap();
    assert_eq!(found.worlds.len(), WORLDS - 1);
    assert!(path.exists(), "the next start tries again");
}

#[test]
fn a_directory_that_cannot_be_read_is_refused() {
    for folder in ["worlds", "clips", "rehearsals"] {
        let (dir, _) = with_everything();
        let path = dir.0.join(folder);
        std::fs::rename(&path, dir.0.join("elsewhere")).unwrap();
        std::os::unix::fs::symlink(folder, &path).unwrap();
        let error = LocalStore::open(&dir.0).map(drop).unwrap_err();
        assert!(matches!(error, StoreError::Directory { .. }), "{error}");
    }
    // A directory whose format cannot be read is not taken for a new one either.
    let (dir, _) = with_everything();
    make_unreadable(&dir.0.join("format"), false);
    let error = LocalStore::open(&dir.0).map(drop).unwrap_err().to_string();
    assert!(error.contains("format: it cannot be read"), "{error}");
}

fn io() -> StoreError {
    StoreError::Io("EIO".to_owned())
}

fn damaged() -> StoreError {
    StoreError::Damaged("SQLITE_CORRUPT".to_owned())
}

fn full() -> StoreError {
    StoreError::Full("ENOSPC".to_owned())
}

#[test]
fn only_known_damage_begins_a_new_log() {
    let busy = StoreError::Busy(String::new());
    let read_only = StoreError::ReadOnly(String::new());
    for (before, fault, remedy) in [
        (None, io(), Remedy::Retry),
        (None, damaged(), Remedy::Retry),
        (None, full(), Remedy::Free),
        (None, busy, Remedy::Pause),
        (None, read_only, Remedy::Pause),
        (Some(io()), io(), Remedy::Pause),
        (Some(io()), damaged(), Remedy::Pause),
        (Some(damaged()), io(), Remedy::Pause),
        (Some(full()), full(), Remedy::Pause),
        (Some(full()), io(), Remedy::Pause),
        (Some(damaged()), damaged(), Remedy::NewLog),
    ] {
        let found = fault.remedy(before.as_ref());
        assert_eq!(found, remedy, "{fault} after {before:?}");
    }
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let worlds = fill(&mut store, 5);
    for remedy in [Remedy::Retry, Remedy::Pause] {
        assert_eq!(store.repair(remedy).unwrap(), None);
    }
    let kept = |store: &mut LocalStore| store.latest(&[worlds[0].key]).unwrap()[0].clone();
    assert_eq!(check(0, &kept(&mut store)).unwrap(), Some(5));
    let done = store.repair(Remedy::NewLog).unwrap().unwrap();
    assert!(done.contains("damaged-"), "{done}");
    assert!(kept(&mut store).entries.is_empty());
}

#[tokio::test]
async fn a_fault_of_a_moment_costs_nothing() {
    for fault in [io(), damaged()] {
        let disk = MemoryDisk::default();
        let (keeper, recorder) = recorded(&disk, SIZES, Durability::Each);
        recorder.checkpoint(0, state(0, 0));
        for tick in 1..=3 {
            disk.fail_next(std::slice::from_ref(&fault));
            let ticket = recorder.input(tick, bytes_of(0, tick, 2, 10));
            recorder.durable(ticket).await.unwrap();
        }
        assert_eq!(keeper.degraded(), None);
        let ticks: Vec<u64> = disk.log().iter().map(|e| e.tick).collect();
        assert_eq!(ticks, [0, 1, 2, 3]);
        assert!(disk.remedies().iter().all(|r| *r == Remedy::Retry));
    }
}

#[tokio::test]
async fn a_fault_that_lasts_pauses_the_store_and_leaves_the_log() {
    let disk = MemoryDisk::default();
    let (keeper, recorder) = recorded(&disk, SIZES, Durability::Each);
    let ticket = recorder.checkpoint(0, state(0, 0));
    recorder.durable(ticket).await.unwrap();
    disk.fail(Some(io()));
    let ticket = recorder.input(1, bytes_of(0, 1, 2, 10));
    recorder.durable(ticket).await.unwrap_err();
    assert!(keeper.degraded().unwrap().contains("EIO"));
    disk.fail(None);
    wait("a checkpoint is asked for", || recorder.needs_checkpoint());
    let ticket = recorder.checkpoint(1, state(0, 1));
    recorder.durable(ticket).await.unwrap();
    assert_eq!(keeper.degraded(), None);
    assert_eq!(disk.remedies(), [Remedy::Retry, Remedy::Pause]);
    let ticks: Vec<u64> = disk.log().iter().map(|e| e.tick).collect();
    assert_eq!(ticks, [0, 1]);
}

/// Retention leaves a world that does not continue with one checkpoint.
#[test]
fn a_checkpoint_that_the_table_has_lost_is_found_by_its_row() {
    for lost in 1..=WORLDS {
        let dir = Temporary::new();
        let mut store = LocalStore::open(&dir.0).unwrap();
        let worlds = fill(&mut store, 10);
        drop(store);
        let log = rusqlite::Connection::open(dir.0.join("log.sqlite")).unwrap();
        for world in &worlds[..lost] {
            let sql = "DELETE FROM checkpoints WHERE world = ?1";
            assert_eq!(log.execute(sql, [world.key.0 as i64]).unwrap(), 1);
        }
        drop(log);
        // Its rows are not swept either, so the next start finds them, too.
        for _ in 0..2 {
            let mut store = LocalStore::open(&dir.0).unwrap();
            while store.cut(&RETENTION).unwrap().unswept {}
            let found = recover(&mut store, &[]).unwrap();
            assert_eq!(found.damaged, Vec::<String>::new());
            for (world, history) in &found.worlds {
                let n = world.name[1..].parse().unwrap();
                assert_eq!(check(n, history).unwrap(), Some(10), "{lost}");
                assert!(history.losses.is_empty(), "{:?}", history.losses);
            }
        }
    }
}
