//! A note beside the log of its last rows, because SQLite silently drops a damaged end of its write-ahead log.
//!
//! ```text
//!   CRC-32 of the rest u32 │ number of worlds u32 │ last row i64 │ for each world:  key u64 │ its last row i64
//! ```
//!
//! Rows of resting worlds are followed by those of others, so the last row alone would not be enough.

use super::Log;
use crate::durable::store::{StoreError, WorldKey};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Write;
use std::path::PathBuf;

/// Number of worlds and last row, bytes.
const HEAD: usize = 4 + 8;
/// A world and its last row, bytes.
const WORLD: usize = 8 + 8;

fn to_bytes(last: i64, worlds: &BTreeMap<WorldKey, i64>) -> Vec<u8> {
    let mut rest = Vec::with_capacity(HEAD + WORLD * worlds.len());
    rest.extend_from_slice(&(worlds.len() as u32).to_le_bytes());
    rest.extend_from_slice(&last.to_le_bytes());
    for (world, id) in worlds {
        rest.extend_from_slice(&world.0.to_le_bytes());
        rest.extend_from_slice(&id.to_le_bytes());
    }
    let sum = crc32fast::hash(&rest).to_le_bytes();
    [&sum[..], &rest].concat()
}

/// The last row of each world; `None` if the note is damaged, as after a power cut.
fn from_bytes(bytes: &[u8]) -> Option<BTreeMap<WorldKey, i64>> {
    let (sum, rest) = bytes.split_first_chunk::<4>()?;
    let count = u32::from_le_bytes(*rest.first_chunk::<4>()?) as usize;
    // Bytes after it are from a time with more worlds.
    let rest = rest.get(..count.checked_mul(WORLD)?.checked_add(HEAD)?)?;
    if crc32fast::hash(rest).to_le_bytes() != *sum {
        return None;
    }
    let (worlds, _) = rest[HEAD..].as_chunks::<WORLD>();
    let number = |bytes: &[u8]| u64::from_le_bytes(bytes.try_into().expect("eight bytes"));
    let world = |w: &[u8; WORLD]| (WorldKey(number(&w[..8])), number(&w[8..]) as i64);
    Some(worlds.iter().map(world).collect())
}

impl Log {
    fn note_path(&self) -> PathBuf {
        self.path.with_extension("end")
    }

    /// Notes the end of the log without waiting for the disk: after a power cut, the note may lag behind the log, but
    /// never lead it. A note that cannot be written is therefore no fault of the preceding commit, which is on disk.
    pub(super) fn note_end(&mut self) {
        let path = self.note_path();
        let note = to_bytes(self.next_id - 1, &self.ends);
        let written = File::options()
            .write(true)
            .create(true)
            .truncate(false)
            .open(&path)
            .and_then(|mut f| f.write_all(&note));
        let went_well = std::mem::replace(&mut self.noted, written.is_ok());
        if let (true, Err(error)) = (went_well, &written) {
            let path = path.display();
            tracing::warn!(%path, %error, "how far the log goes is not noted: the loss of its end would not be seen");
        }
    }

    /// Reads the note: a log that ends before it has lost something. Returns the losses of the log as a whole; those of
    /// single worlds show when their histories are read. `is_there`: rows of worlds that were deleted since are not
    /// missing, because the note is written with commits only.
    ///
    /// # Errors
    /// A world has rows but no known checkpoint, and the log cannot be searched for it.
    pub fn compare_with_note(
        &mut self,
        is_there: impl Fn(WorldKey) -> bool,
    ) -> Result<Option<String>, StoreError> {
        let note = std::fs::read(self.note_path()).ok();
        let Some(ends) = note.and_then(|note| from_bytes(&note)) else {
            return Ok(None);
        };
        self.ends = ends;
        let noted = self.ends.iter().filter(|(w, _)| is_there(**w));
        let lost = noted.clone().filter(|(w, _)| !self.tracks.contains_key(w));
        let lost: Vec<WorldKey> = lost.map(|(w, _)| *w).collect();
        let noted = noted.map(|(_, id)| *id).max().unwrap_or(0);
        if !lost.is_empty() {
            self.find_again(&lost)?;
        }
        let last = self.next_id - 1;
        Ok((last < noted).then(|| {
            format!(
                "{}: the last {} rows of worlds are missing: the log is damaged",
                self.path.display(),
                noted - last
            )
        }))
    }
}
