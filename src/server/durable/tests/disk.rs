//! Goal: a disk that is full, read-only or held by another program loses only the data being written, and nothing
//! before them. Method: the log is made to refuse writes.

use super::*;

#[test]
fn a_full_disk_loses_the_group_and_nothing_before_it() {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let worlds = fill(&mut store, 30);
    store.log().fill_disk();
    let big = StoreEntry {
        world: worlds[0].key,
        tick: 31,
        item: StoreItem::Input(bytes_of(0, 31, 2, 4_000_000)),
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
    // Space is freed, and then smaller groups fit again.
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
fn a_note_that_cannot_be_written_costs_nothing() {
    let dir = Temporary::new();
    let mut store = LocalStore::open(&dir.0).unwrap();
    let worlds = fill(&mut store, 3);
    let note = dir.0.join("log.end");
    std::fs::remove_file(&note).unwrap();
    std::fs::create_dir(&note).unwrap();
    // The data are on disk, so this must not count as a failure, for which the log would be set aside.
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
