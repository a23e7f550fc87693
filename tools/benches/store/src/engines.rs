//! The same log in each store.

use std::fs::File;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

/// One record of the log.
pub struct Record<'a> {
    pub key: u64,
    pub world: u32,
    pub tick: u64,
    pub checkpoint: bool,
    pub bytes: &'a [u8],
}

/// A log that is cut off at its old end.
pub trait Engine {
    /// Writes all records and forgets those before `cut`; on return both are on disk.
    fn commit(&mut self, records: &[Record<'_>], cut: Option<u64>);
    /// Records from the newest to the oldest, until `f` says false.
    fn backwards(&mut self, f: &mut dyn FnMut(Record<'_>) -> bool);
}

/// Opens a store by its name.
pub fn open(engine: &str, dir: &Path) -> Box<dyn Engine> {
    match engine {
        #[cfg(feature = "sqlite")]
        "sqlite" => Box::new(sqlite::Sqlite::open(dir)),
        #[cfg(feature = "redb")]
        "redb" => Box::new(redb_log::Redb::open(dir)),
        #[cfg(feature = "fjall")]
        "fjall" => Box::new(fjall_log::Fjall::open(dir)),
        "plain" => Box::new(Plain::open(dir)),
        _ => panic!("there is no engine {engine:?} in this build"),
    }
}

/// World, tick, kind and checksum in front of the bytes.
const HEAD: usize = 17;

#[allow(dead_code)] // in a build with few engines
fn packed(r: &Record<'_>) -> Vec<u8> {
    let mut out = Vec::with_capacity(HEAD + r.bytes.len());
    out.extend_from_slice(&[0; 4]);
    out.extend_from_slice(&r.world.to_le_bytes());
    out.extend_from_slice(&r.tick.to_le_bytes());
    out.push(u8::from(r.checkpoint));
    out.extend_from_slice(r.bytes);
    let sum = crc32fast::hash(&out[4..]);
    out[..4].copy_from_slice(&sum.to_le_bytes());
    out
}

fn unpacked(key: u64, bytes: &[u8]) -> Option<Record<'_>> {
    let (head, rest) = bytes.split_at_checked(HEAD)?;
    let sum = u32::from_le_bytes(head[..4].try_into().ok()?);
    (crc32fast::hash(&bytes[4..]) == sum).then_some(())?;
    Some(Record {
        key,
        world: u32::from_le_bytes(head[4..8].try_into().ok()?),
        tick: u64::from_le_bytes(head[8..16].try_into().ok()?),
        checkpoint: head[16] == 1,
        bytes: rest,
    })
}

#[cfg(feature = "sqlite")]
mod sqlite {
    use super::{Engine, Path, Record, packed, unpacked};
    use rusqlite::{Connection, params};

    pub struct Sqlite(Connection);

    impl Sqlite {
        pub fn open(dir: &Path) -> Self {
            let db = Connection::open(dir.join("log.sqlite")).expect("sqlite opens");
            db.execute_batch(
                "PRAGMA page_size = 16384; PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL;
                 PRAGMA wal_autocheckpoint = 2000;
                 CREATE TABLE IF NOT EXISTS log (key INTEGER PRIMARY KEY, bytes BLOB NOT NULL);",
            )
            .expect("its settings");
            Self(db)
        }
    }

    impl Engine for Sqlite {
        fn commit(&mut self, records: &[Record<'_>], cut: Option<u64>) {
            let tx = self.0.transaction().expect("a transaction");
            {
                let mut insert = tx
                    .prepare_cached("INSERT INTO log VALUES (?1, ?2)")
                    .expect("a statement");
                for r in records {
                    insert
                        .execute(params![r.key as i64, packed(r)])
                        .expect("an insert");
                }
                if let Some(cut) = cut {
                    let mut delete = tx
                        .prepare_cached("DELETE FROM log WHERE key < ?1")
                        .expect("a statement");
                    delete.execute([cut as i64]).expect("a delete");
                }
            }
            tx.commit().expect("a commit");
        }

        fn backwards(&mut self, f: &mut dyn FnMut(Record<'_>) -> bool) {
            let mut all = self
                .0
                .prepare("SELECT key, bytes FROM log ORDER BY key DESC")
                .expect("a statement");
            let mut rows = all.query([]).expect("rows");
            while let Some(row) = rows.next().expect("a row") {
                let key: i64 = row.get(0).expect("a key");
                let bytes = row.get_ref(1).expect("a blob");
                let bytes = bytes.as_blob().expect("a blob");
                if !f(unpacked(key as u64, bytes).expect("a whole record")) {
                    return;
                }
            }
        }
    }
}

#[cfg(feature = "redb")]
mod redb_log {
    use super::{Engine, Path, Record, packed, unpacked};
    use redb::{Database, ReadableDatabase, ReadableTable, TableDefinition};

    const LOG: TableDefinition<'_, u64, &[u8]> = TableDefinition::new("log");

    pub struct Redb(Database);

    impl Redb {
        pub fn open(dir: &Path) -> Self {
            let db = Database::builder()
                .set_cache_size(64 << 20)
                .create(dir.join("log.redb"));
            Self(db.expect("redb opens"))
        }
    }

    impl Engine for Redb {
        fn commit(&mut self, records: &[Record<'_>], cut: Option<u64>) {
            let mut tx = self.0.begin_write().expect("a transaction");
            // Write the state of the allocator with each commit, so that opening after a kill needs no repair.
            tx.set_quick_repair(std::env::var("REDB_QUICK_REPAIR").is_ok());
            {
                let mut log = tx.open_table(LOG).expect("a table");
                for r in records {
                    log.insert(r.key, packed(r).as_slice()).expect("an insert");
                }
                if let Some(cut) = cut {
                    log.retain_in(..cut, |_, _| false).expect("a delete");
                }
            }
            tx.commit().expect("a commit");
        }

        fn backwards(&mut self, f: &mut dyn FnMut(Record<'_>) -> bool) {
            let tx = self.0.begin_read().expect("a transaction");
            let log = tx.open_table(LOG).expect("a table");
            for entry in log.iter().expect("entries").rev() {
                let (key, bytes) = entry.expect("an entry");
                if !f(unpacked(key.value(), bytes.value()).expect("a whole record")) {
                    return;
                }
            }
        }
    }
}

#[cfg(feature = "fjall")]
mod fjall_log {
    use super::{Engine, Path, Record, packed, unpacked};
    use fjall::compaction::Fifo;
    use fjall::{
        Database, Keyspace, KeyspaceCreateOptions, KvSeparationOptions, PersistMode, Readable,
    };
    use std::sync::Arc;

    pub struct Fjall {
        db: Database,
        log: Keyspace,
    }

    impl Fjall {
        pub fn open(dir: &Path) -> Self {
            let db = Database::builder(dir.join("log.fjall"))
                .cache_size(64 << 20)
                .open()
                .expect("fjall opens");
            let mut options = KeyspaceCreateOptions::default();
            match std::env::var("FJALL_LAYOUT").as_deref() {
                // Drop old tables as a whole, which for a log is the least that this engine can write.
                Ok("fifo") => {
                    let keep = Fifo::new(1 << 40, Some(super::super::KEEP_S as u64));
                    options = options.compaction_strategy(Arc::new(keep));
                }
                Ok("leveled") => {}
                _ => options = options.with_kv_separation(Some(KvSeparationOptions::default())),
            }
            let log = db.keyspace("log", || options).expect("a keyspace");
            Self { db, log }
        }
    }

    impl Engine for Fjall {
        fn commit(&mut self, records: &[Record<'_>], cut: Option<u64>) {
            let mut batch = self.db.batch().durability(Some(PersistMode::SyncData));
            for r in records {
                batch.insert(&self.log, r.key.to_be_bytes(), packed(r));
            }
            if let Some(cut) = cut
                && std::env::var("FJALL_LAYOUT").as_deref() != Ok("fifo")
            {
                let old: Vec<_> = self
                    .db
                    .snapshot()
                    .range(&self.log, ..cut.to_be_bytes())
                    .map(|g| g.key().expect("a key"))
                    .collect();
                for key in old {
                    batch.remove(&self.log, key);
                }
            }
            batch.commit().expect("a commit");
        }

        fn backwards(&mut self, f: &mut dyn FnMut(Record<'_>) -> bool) {
            for entry in self.log.iter().rev() {
                let (key, bytes) = entry.into_inner().expect("an entry");
                let key = u64::from_be_bytes(key[..].try_into().expect("eight bytes"));
                if !f(unpacked(key, &bytes).expect("a whole record")) {
                    return;
                }
            }
        }
    }
}

/// Cost of the disk itself: files that are only appended to and deleted. This is not a store, but the yardstick for the
/// others.
struct Plain {
    dir: PathBuf,
    file: Option<(File, u64)>,
    /// First keys of the files.
    files: Vec<u64>,
}

/// Bytes of one file.
const FILE_BYTES: u64 = 64 << 20;

impl Plain {
    fn open(dir: &Path) -> Self {
        let entries = std::fs::read_dir(dir).expect("a directory").flatten();
        let mut files: Vec<u64> = entries
            .filter_map(|e| e.file_name().to_str().and_then(|n| n.parse().ok()))
            .collect();
        files.sort_unstable();
        Self {
            dir: dir.to_owned(),
            file: None,
            files,
        }
    }

    fn path(&self, first: u64) -> PathBuf {
        self.dir.join(format!("{first:020}"))
    }
}

impl Engine for Plain {
    fn commit(&mut self, records: &[Record<'_>], cut: Option<u64>) {
        let Some(first) = records.first() else { return };
        if self.file.as_ref().is_none_or(|f| f.1 > FILE_BYTES) {
            self.files.push(first.key);
            self.file = Some((File::create(self.path(first.key)).expect("a file"), 0));
        }
        let mut out = Vec::new();
        for r in records {
            let bytes = packed(r);
            out.extend_from_slice(&r.key.to_le_bytes());
            out.extend_from_slice(&(bytes.len() as u32).to_le_bytes());
            out.extend_from_slice(&bytes);
        }
        let (file, length) = self.file.as_mut().expect("just made");
        file.write_all(&out).expect("a write");
        file.sync_data().expect("a sync");
        *length += out.len() as u64;
        while cut.is_some_and(|cut| self.files.get(1).is_some_and(|next| *next <= cut)) {
            let old = self.files.remove(0);
            std::fs::remove_file(self.path(old)).expect("a deletion");
        }
    }

    fn backwards(&mut self, f: &mut dyn FnMut(Record<'_>) -> bool) {
        for first in self.files.clone().into_iter().rev() {
            let mut bytes = Vec::new();
            File::open(self.path(first))
                .and_then(|mut f| f.read_to_end(&mut bytes))
                .expect("a file");
            let (mut at, mut records) = (0, Vec::new());
            while let Some(head) = bytes.get(at..at + 12) {
                let key = u64::from_le_bytes(head[..8].try_into().expect("eight"));
                let length = u32::from_le_bytes(head[8..].try_into().expect("four")) as usize;
                let Some(r) = bytes
                    .get(at + 12..at + 12 + length)
                    .and_then(|b| unpacked(key, b))
                else {
                    break;
                };
                records.push(r);
                at += 12 + length;
            }
            for r in records.into_iter().rev() {
                if !f(r) {
                    return;
                }
            }
        }
    }
}
