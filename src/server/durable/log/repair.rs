//! Remedies for a full disk and for a damaged file.

use super::Log;
use crate::durable::files;
use crate::durable::store::{Retention, StoreError};
use rusqlite::Connection;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Moves the files of a log aside for inspection, together with the note of its end, because the next log has its own.
/// Returns their new directory.
///
/// # Errors
/// They could not be moved.
pub(in crate::durable) fn set_aside(log: &Path) -> Result<PathBuf, StoreError> {
    let dir = log.parent().unwrap_or(Path::new("."));
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    let aside = dir.join(format!("damaged-{}", since.unwrap_or_default().as_millis()));
    std::fs::create_dir_all(&aside).map_err(|e| files::io_error(&aside, &e))?;
    for extension in ["sqlite", "sqlite-wal", "sqlite-shm", "end"] {
        let from = log.with_extension(extension);
        if let (true, Some(name)) = (from.exists(), from.file_name()) {
            std::fs::rename(&from, aside.join(name)).map_err(|e| files::io_error(&from, &e))?;
        }
    }
    files::sync_directory(dir)?;
    Ok(aside)
}

impl Log {
    /// Begins a new log, which knows the same worlds. Returns the directory in which the old one is kept.
    ///
    /// # Errors
    /// It failed, and nothing can be written until it succeeds.
    pub fn begin_anew(&mut self) -> Result<PathBuf, StoreError> {
        // Close the old one first, because SQLite removes files by name when it closes.
        if let Ok(nothing) = Connection::open_in_memory() {
            self.db = nothing;
        }
        let aside = set_aside(&self.path)?;
        let mut log = Self::open(&self.path)?;
        log.known.extend(self.known.drain());
        *self = log;
        Ok(aside)
    }

    /// Deletes all history except the latest checkpoint of each world and everything after it.
    ///
    /// # Errors
    /// It could not be done.
    pub fn free(&mut self) -> Result<(), StoreError> {
        // Copying the pages of the write-ahead log to their final places frees it for new rows.
        self.shrink()?;
        let nothing = Retention {
            age: Duration::ZERO,
            world_bytes: 0,
            total_bytes: 0,
        };
        while self.cut(&nothing)?.unswept {}
        self.shrink()
    }

    /// Gives the space of the write-ahead log back.
    ///
    /// # Errors
    /// It could not be done.
    pub fn shrink(&self) -> Result<(), StoreError> {
        let sql = "PRAGMA wal_checkpoint(TRUNCATE)";
        let done = self.db.query_row(sql, [], |_| Ok(()));
        done.map_err(|e| self.fault(&e))
    }
}
