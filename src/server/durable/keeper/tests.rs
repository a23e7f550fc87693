//! Goal: worlds that lose something at the end of the server are named. Method: the writer runs on the thread of the
//! test, where its log is captured.

#![allow(clippy::unwrap_used)] // a panic here is the failure message

use super::*;
use crate::durable::memory::{MemoryDisk, MemoryStore};
use crate::durable::store::{Durability, Retention, WorldKey};
use std::io::Write;
use std::time::Duration;

/// The captured log.
#[derive(Clone, Default)]
struct Told(Arc<Mutex<Vec<u8>>>);

impl Write for Told {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// The log for worlds without a guarantee that hand in checkpoints of the given sizes in bytes at the end of the
/// server.
fn told_at_the_end(disk: &MemoryDisk, bytes: &[usize]) -> Vec<String> {
    let shared = Arc::new(KeeperShared::new(KeeperSizes {
        queue_bytes: 1000,
        retention: Retention {
            age: Duration::from_secs(60),
            world_bytes: 1 << 30,
            total_bytes: 1 << 30,
        },
    }));
    let recorders = bytes.iter().enumerate().map(|(n, _)| {
        let world = Arc::new(WorldState::new(&WorldRecord {
            key: WorldKey(n as u64 + 1),
            name: format!("w{n}"),
            durability: Durability::None,
            quarantined: None,
            settings: Default::default(),
        }));
        locked(&shared.queue).worlds.push(Arc::downgrade(&world));
        let shared = shared.clone();
        Recorder { shared, world }
    });
    let recorders: Vec<Recorder> = recorders.collect();
    let told = Told::default();
    let lines = told.clone();
    let subscriber = tracing_subscriber::fmt()
        .with_ansi(false)
        .with_writer(move || lines.clone())
        .finish();
    tracing::subscriber::with_default(subscriber, || {
        for (recorder, length) in recorders.iter().zip(bytes) {
            if *length > 0 {
                recorder.checkpoint(5, vec![0; *length].into());
            }
        }
        drop(recorders); // worlds have ended by then
        locked(&shared.queue).closing = true;
        StoreWriter::new(shared, Box::new(MemoryStore(disk.clone()))).run();
    });
    let told = String::from_utf8(told.0.lock().unwrap().clone()).unwrap();
    let of_worlds = told.lines().filter(|l| l.contains("world="));
    of_worlds.map(str::to_owned).collect()
}

#[test]
fn a_last_state_that_is_not_written_is_named() {
    let disk = MemoryDisk::default();
    assert_eq!(told_at_the_end(&disk, &[100, 100]), Vec::<String>::new());
    disk.fail(Some(StoreError::Full("disk".to_owned())));
    // The one in the middle had nothing to write.
    let told = told_at_the_end(&disk, &[100, 0, 100]);
    assert_eq!(told.len(), 2, "{told:?}");
    for (line, world) in told.iter().zip(["w0", "w2"]) {
        assert!(line.contains(&format!("world=\"{world}\"")), "{line}");
        assert!(
            line.contains("the last state of the world is not written"),
            "{line}"
        );
        assert!(line.contains("the disk is full"), "{line}");
    }
}

#[test]
fn a_last_state_for_which_there_is_no_room_is_named() {
    let told = told_at_the_end(&MemoryDisk::default(), &[100, 2000]);
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0].contains("w1") && told[0].contains("too slow"),
        "{told:?}"
    );
}
