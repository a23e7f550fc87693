//! Small files that are whole or damaged, never half written: a new one is written beside the old one, brought to disk
//! and renamed. Each begins with its kind, its format and a checksum.

use super::store::StoreError;
use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

/// First bytes of each file.
const MAGIC: &[u8; 5] = b"SINEW";
/// Magic, kind, format, checksum.
const HEAD: usize = MAGIC.len() + 1 + 4 + 4;

/// Extension of a file that is being written.
const UNFINISHED: &str = "new";

/// A disk error about a file.
pub(super) fn io_error(path: &Path, error: &std::io::Error) -> StoreError {
    let place = path.display();
    match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
            StoreError::Full(place.to_string())
        }
        ErrorKind::ReadOnlyFilesystem | ErrorKind::PermissionDenied => {
            StoreError::ReadOnly(place.to_string())
        }
        _ => StoreError::Io(format!("{place}: {error}")),
    }
}

fn framed(kind: u8, format: u32, bytes: &[u8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(HEAD + bytes.len());
    out.extend_from_slice(MAGIC);
    out.push(kind);
    out.extend_from_slice(&format.to_le_bytes());
    let mut sum = crc32fast::Hasher::new();
    sum.update(&out);
    sum.update(bytes);
    out.extend_from_slice(&sum.finalize().to_le_bytes());
    out.extend_from_slice(bytes);
    out
}

/// Brings a directory to disk, so that names in it are there after a power cut.
pub(super) fn sync_directory(dir: &Path) -> Result<(), StoreError> {
    // Elsewhere directories cannot be opened, and names are on disk when files are.
    if cfg!(unix) {
        let synced = File::open(dir).and_then(|d| d.sync_all());
        synced.map_err(|e| io_error(dir, &e))?;
    }
    Ok(())
}

/// Writes a file as a whole.
///
/// # Errors
/// It could not be written; the previous content is still there.
pub(super) fn write(path: &Path, kind: u8, format: u32, bytes: &[u8]) -> Result<(), StoreError> {
    let fresh = path.with_extension(UNFINISHED);
    let written = File::create(&fresh).and_then(|mut file| {
        file.write_all(&framed(kind, format, bytes))?;
        file.sync_all()?;
        std::fs::rename(&fresh, path)
    });
    if let Err(error) = written {
        let _ = std::fs::remove_file(&fresh); // it is of no further use
        return Err(io_error(path, &error));
    }
    sync_directory(path.parent().unwrap_or(Path::new(".")))
}

/// Reads a file whole. An unreadable file is as lost as a damaged one, and no reason to give up the others.
///
/// # Errors
/// It is damaged, of another kind, or of a later format.
pub(super) fn read(path: &Path, kind: u8, format: u32) -> Result<Vec<u8>, StoreError> {
    let damaged = |why: &str| StoreError::Damaged(format!("{}: {why}", path.display()));
    let read = std::fs::read(path);
    let mut bytes = read.map_err(|e| damaged(&format!("it cannot be read: {e}")))?;
    let head = bytes
        .first_chunk::<HEAD>()
        .ok_or_else(|| damaged("the file is cut off"))?;
    let (front, sum) = head.split_at(HEAD - 4);
    let mut expected = crc32fast::Hasher::new();
    expected.update(front);
    expected.update(&bytes[HEAD..]);
    if expected.finalize().to_le_bytes() != sum || !front.starts_with(MAGIC) {
        return Err(damaged("the checksum is wrong"));
    }
    if front[MAGIC.len()] != kind {
        return Err(damaged("it is a file of another kind"));
    }
    let found = u32::from_le_bytes([front[6], front[7], front[8], front[9]]);
    if found > format {
        return Err(StoreError::NewerFormat {
            path: path.to_owned(),
            found,
            known: format,
        });
    }
    bytes.drain(..HEAD);
    Ok(bytes)
}

/// Whether a file of this name exists, readable or not.
pub(super) fn is_there(path: &Path) -> bool {
    let looked = path.symlink_metadata();
    !looked.is_err_and(|e| e.kind() == ErrorKind::NotFound)
}

/// Removes a file; a missing file counts as removed.
///
/// # Errors
/// It could not be removed.
pub(super) fn remove(path: &Path) -> Result<(), StoreError> {
    match std::fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(io_error(path, &error)),
        Err(_) => Ok(()),
        Ok(()) => sync_directory(path.parent().unwrap_or(Path::new("."))),
    }
}

/// Renames a file within its directory; a missing file counts as renamed.
///
/// # Errors
/// It could not be done.
pub(super) fn rename(from: &Path, to: &Path) -> Result<(), StoreError> {
    match std::fs::rename(from, to) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(io_error(from, &error)),
        Err(_) => Ok(()),
        Ok(()) => sync_directory(to.parent().unwrap_or(Path::new("."))),
    }
}

/// Removes the unfinished files that an interrupted process left in this directory. A file that cannot be removed is
/// reported and stays, but is never read.
///
/// # Errors
/// The directory cannot be read.
pub(super) fn remove_unfinished(dir: &Path) -> Result<(), StoreError> {
    for path in list(dir, UNFINISHED)? {
        if let Err(error) = remove(&path) {
            let path = path.display();
            tracing::warn!(%path, %error, "half a file is not removed");
        }
    }
    Ok(())
}

/// Files of a directory with an extension, by name.
///
/// # Errors
/// The directory cannot be read.
pub(super) fn list(dir: &Path, extension: &str) -> Result<Vec<PathBuf>, StoreError> {
    let unreadable = |e: std::io::Error| StoreError::Directory {
        path: dir.to_owned(),
        why: format!("the directory cannot be read: {e}"),
    };
    let entries = std::fs::read_dir(dir).map_err(unreadable)?;
    let mut out = Vec::new();
    for entry in entries {
        let path = entry.map_err(unreadable)?.path();
        if path.extension().is_some_and(|e| e == extension) {
            out.push(path);
        }
    }
    out.sort();
    Ok(out)
}

/// Writes values one behind the other.
#[derive(Default)]
pub(super) struct Packed(pub Vec<u8>);

impl Packed {
    /// Appends bytes with their length.
    pub fn bytes(mut self, bytes: &[u8]) -> Self {
        let length = u32::try_from(bytes.len()).expect("records are smaller than 4 GiB");
        self.0.extend_from_slice(&length.to_le_bytes());
        self.0.extend_from_slice(bytes);
        self
    }
}

/// Reads the output of [`Packed`].
pub(super) struct Unpacked<'a>(pub &'a [u8]);

impl<'a> Unpacked<'a> {
    /// The next bytes; `None` if they are cut off.
    pub fn bytes(&mut self) -> Option<&'a [u8]> {
        let (length, rest) = self.0.split_first_chunk::<4>()?;
        let (bytes, rest) = rest.split_at_checked(u32::from_le_bytes(*length) as usize)?;
        self.0 = rest;
        Some(bytes)
    }

    /// The next text; `None` if it is cut off or no text.
    pub fn text(&mut self) -> Option<&'a str> {
        std::str::from_utf8(self.bytes()?).ok()
    }
}
