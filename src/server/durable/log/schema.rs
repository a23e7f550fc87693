//! Tables and settings of the log in SQLite, and the meaning of SQLite's errors for a store.

use crate::durable::store::StoreError;
use rusqlite::{Connection, ErrorCode};
use std::path::Path;
use std::time::Duration;

/// "SNWL", so that no other database is taken for a log.
const APPLICATION: i32 = 0x534e_574c;
/// Format of the tables and of their content.
const FORMAT: u32 = 1;
/// Bytes of one page: a row of ten figures fits into one.
const PAGE_BYTES: u32 = 16_384;
/// Pages of the write-ahead log after which they are copied to their final places: 32 MB.
const WAL_PAGES: u32 = 2000;
/// Memory for pages, kibibytes.
const CACHE_KIB: u32 = 16_384;
/// Time for which another program may hold the file exclusively, for example to copy it.
const PATIENCE: Duration = Duration::from_secs(5);

const TABLES: &str = "
    CREATE TABLE log (
        id INTEGER PRIMARY KEY, world INTEGER NOT NULL, session INTEGER NOT NULL, seq INTEGER NOT NULL,
        kind INTEGER NOT NULL, tick INTEGER NOT NULL, sum INTEGER NOT NULL, bytes BLOB NOT NULL
    );
    -- Where in the log the checkpoints are. What is lost of it is found again by a look at all rows.
    CREATE TABLE checkpoints (
        id INTEGER PRIMARY KEY, world INTEGER NOT NULL, session INTEGER NOT NULL, seq INTEGER NOT NULL,
        tick INTEGER NOT NULL, time_ms INTEGER NOT NULL, bytes_before INTEGER NOT NULL
    );";

/// Opens the database of a log, or makes one.
///
/// # Errors
/// It is damaged, no log, of a later format, or cannot be read.
pub(super) fn open(path: &Path) -> Result<Connection, StoreError> {
    let failed = |e: rusqlite::Error| fault(path, &e);
    let (db, application, version) = connect(path).map_err(failed)?;
    match (application, version) {
        (0, 0) => {
            let begin = format!(
                "BEGIN; {TABLES} PRAGMA application_id = {APPLICATION}; PRAGMA user_version = {FORMAT}; COMMIT;"
            );
            db.execute_batch(&begin).map_err(failed)?;
        }
        (APPLICATION, FORMAT) => {}
        (APPLICATION, found) if found > FORMAT => {
            return Err(StoreError::NewerFormat {
                path: path.to_owned(),
                found,
                known: FORMAT,
            });
        }
        _ => {
            let place = path.display();
            return Err(StoreError::Damaged(format!("{place}: not a log of sinew")));
        }
    }
    Ok(db)
}

/// A connection, and the application and version stated in the file; 0 in a new one.
fn connect(path: &Path) -> rusqlite::Result<(Connection, i32, u32)> {
    let db = Connection::open(path)?;
    db.busy_timeout(PATIENCE)?;
    db.execute_batch(&format!(
        "PRAGMA page_size = {PAGE_BYTES};
         PRAGMA journal_mode = WAL;
         PRAGMA synchronous = FULL;
         PRAGMA cell_size_check = ON;
         PRAGMA wal_autocheckpoint = {WAL_PAGES};
         PRAGMA cache_size = -{CACHE_KIB};"
    ))?;
    let application = db.pragma_query_value(None, "application_id", |r| r.get(0))?;
    let version = db.pragma_query_value(None, "user_version", |r| r.get(0))?;
    Ok((db, application, version))
}

/// Converts an error of SQLite about the log at this path; [`StoreError::remedy`] has its remedy.
pub(super) fn fault(path: &Path, error: &rusqlite::Error) -> StoreError {
    let place = path.display();
    match error.sqlite_error_code() {
        Some(ErrorCode::DiskFull | ErrorCode::TooBig) => StoreError::Full(place.to_string()),
        Some(ErrorCode::ReadOnly | ErrorCode::CannotOpen | ErrorCode::PermissionDenied) => {
            StoreError::ReadOnly(place.to_string())
        }
        Some(ErrorCode::DatabaseBusy | ErrorCode::DatabaseLocked) => {
            StoreError::Busy(place.to_string())
        }
        // Rows have numbers that should be free, so the end stated in the file is wrong.
        Some(
            ErrorCode::DatabaseCorrupt | ErrorCode::NotADatabase | ErrorCode::ConstraintViolation,
        ) => StoreError::Damaged(format!("{place}: {error}")),
        // Tables or columns are missing, so the list of tables is damaged.
        Some(ErrorCode::Unknown) => StoreError::Damaged(format!("{place}: {error}")),
        _ => StoreError::Io(format!("{place}: {error}")),
    }
}
