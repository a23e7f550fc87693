//! Goal: data confirmed to be on disk are there at that time, and lost data are reported. Method: the writing thread
//! has a store in memory whose disk fails, is slow or panics.

use super::*;

#[tokio::test]
async fn inputs_are_written_in_groups_and_each_is_on_disk_when_that_is_promised() {
    let disk = MemoryDisk::default();
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

    let disk = MemoryDisk::default();
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
    let disk = MemoryDisk::default();
    let (keeper, recorder) = recorded(&disk, SIZES, Durability::Each);
    recorder.checkpoint(0, state(0, 0));
    let ticket = recorder.input(1, bytes_of(0, 1, 2, 10));
    recorder.durable(ticket).await.unwrap();

    disk.fail(Some(StoreError::Full("disk".to_owned())));
    let ticket = recorder.input(2, bytes_of(0, 2, 2, 10));
    let error = recorder.durable(ticket).await.unwrap_err().to_string();
    assert!(error.contains("full"), "{error}");
    assert!(keeper.degraded().unwrap().contains("full"));
    // Until there is a whole state, no entry that depends on the gap is written.
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
    // From a checkpoint before the gap, a history cannot continue after it.
    let before = MemoryStore(disk).history_at(recorder.world(), 1).unwrap();
    assert_eq!(before.last_tick(), Some(1));
    assert_eq!(before.losses.len(), 1);
}

#[test]
fn a_slow_disk_bounds_the_queue() {
    let disk = MemoryDisk::default();
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
    let written: usize = disk.log().iter().map(StoreEntry::size).sum();
    assert!(written < 3 * SIZES.queue_bytes, "{written}");
    let last = disk.log().pop().unwrap();
    assert!(matches!(
        last.item,
        StoreItem::Checkpoint {
            after_gap: true,
            ..
        }
    ));
}

#[tokio::test]
async fn nobody_waits_for_a_thread_that_has_panicked() {
    let disk = MemoryDisk::default();
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
async fn who_asks_late_learns_what_was_lost() {
    let disk = MemoryDisk::default();
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
