//! Notes in a file that a world is being stepped. They remain when the process ends in the middle of a step, so a world
//! that crashes the whole process is known at the next start.
//!
//! A note costs two writes to the page cache, of which no thread waits for the disk. Worlds make them only for the
//! first seconds after a start that followed a crash: a world that crashes the process again does so soon, from the
//! same state with the same inputs.

use super::files::io_error;
use super::store::{StoreError, WorldKey};
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::PoisonError;

/// World, tick, checksum, and whether it is being stepped.
const SLOT: usize = 24;
/// Worlds that can have a note at a time.
const SLOTS: usize = 4096;

/// The file.
#[derive(Debug)]
pub struct Marks {
    path: PathBuf,
    file: File,
    found: Vec<(WorldKey, u64)>,
    taken: Mutex<Vec<bool>>,
}

fn slot(world: WorldKey, tick: u64) -> [u8; SLOT] {
    let mut out = [0; SLOT];
    out[..8].copy_from_slice(&world.0.to_le_bytes());
    out[8..16].copy_from_slice(&tick.to_le_bytes());
    let sum = crc32fast::hash(&out[..16]);
    out[16..20].copy_from_slice(&sum.to_le_bytes());
    out[20] = 1;
    out
}

impl Marks {
    /// Opens the file, reads its notes, and clears it.
    ///
    /// # Errors
    /// It cannot be opened or written.
    pub fn open(path: &Path) -> Result<Self, StoreError> {
        let failed = |e: std::io::Error| io_error(path, &e);
        let mut file = File::options()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)
            .map_err(failed)?;
        let mut bytes = Vec::new();
        if let Err(error) = file.read_to_end(&mut bytes) {
            // The next crash is recorded again; this must not keep any world away.
            let path = path.display();
            tracing::warn!(%path, %error, "which worlds were being stepped is not known");
        }
        let noted = |s: &[u8; SLOT]| {
            let number = |at: usize| u64::from_le_bytes(s[at..at + 8].try_into().expect("eight"));
            let (world, tick) = (WorldKey(number(0)), number(8));
            (*s == slot(world, tick)).then_some((world, tick))
        };
        let (slots, _) = bytes.as_chunks::<SLOT>();
        let marks = Self {
            path: path.to_owned(),
            file,
            found: slots.iter().filter_map(noted).collect(),
            taken: Mutex::new(vec![false; SLOTS]),
        };
        marks.clear_all()?;
        Ok(marks)
    }

    /// Worlds that were being stepped when the process before this one ended, and the ticks.
    pub fn found(&self) -> &[(WorldKey, u64)] {
        &self.found
    }

    /// Clears all notes.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn clear_all(&self) -> Result<(), StoreError> {
        let length = (SLOT * SLOTS) as u64;
        let cleared = self
            .file
            .set_len(0)
            .and_then(|()| self.file.set_len(length));
        cleared.map_err(|e| io_error(&self.path, &e))
    }

    /// A place for the notes of one world; `None` when all are taken.
    pub fn place(self: &std::sync::Arc<Self>, world: WorldKey) -> Option<WorldMark> {
        let mut taken = self.taken.lock().unwrap_or_else(PoisonError::into_inner);
        let at = taken.iter().position(|t| !t)?;
        taken[at] = true;
        Some(WorldMark {
            marks: self.clone(),
            world,
            at,
        })
    }

    fn write(&self, at: usize, bytes: &[u8; SLOT]) {
        let offset = (at * SLOT) as u64;
        #[cfg(unix)]
        let written = std::os::unix::fs::FileExt::write_all_at(&self.file, bytes, offset);
        #[cfg(windows)]
        let written =
            std::os::windows::fs::FileExt::seek_write(&self.file, bytes, offset).map(drop);
        if let Err(error) = written {
            tracing::debug!(%error, "a note of a step was not written");
        }
    }
}

/// The place for the notes of one world.
#[derive(Debug)]
pub struct WorldMark {
    marks: std::sync::Arc<Marks>,
    world: WorldKey,
    at: usize,
}

impl WorldMark {
    /// Notes that a tick is being computed.
    pub fn begin(&self, tick: u64) {
        self.marks.write(self.at, &slot(self.world, tick));
    }

    /// Notes that it is done.
    pub fn end(&self) {
        self.marks.write(self.at, &[0; SLOT]);
    }
}

impl Drop for WorldMark {
    fn drop(&mut self) {
        self.end();
        let taken = self.marks.taken.lock();
        taken.unwrap_or_else(PoisonError::into_inner)[self.at] = false;
    }
}
