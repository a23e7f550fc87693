//! The small files of a store: their kinds, and the fields of each.

use super::files::{self, Packed, Unpacked};
use super::store::{Durability, RehearsalRecord, StoreError, WorldKey, WorldRecord};
use bytes::Bytes;
use std::path::Path;

/// Format of the directory and of each file in it.
const FORMAT: u32 = 1;

// Kinds of files.
const DIRECTORY: u8 = b'D';
const WORLD: u8 = b'W';
const STATE: u8 = b'S';
const CLIP: u8 = b'C';
const CONTENT: u8 = b'M';
const REHEARSAL: u8 = b'R';
const END: u8 = b'E';

/// Reads a file and the fields in it. Every `read_…` below has the same errors.
///
/// # Errors
/// It is damaged or cannot be read, of another kind, or of a later format.
fn read<T>(
    path: &Path,
    kind: u8,
    fields: impl FnOnce(&mut Unpacked<'_>) -> Option<T>,
) -> Result<T, StoreError> {
    let bytes = files::read(path, kind, FORMAT)?;
    fields(&mut Unpacked(&bytes))
        .ok_or_else(|| StoreError::Damaged(format!("{}: fields are missing", path.display())))
}

/// Checks that the file that marks a directory of worlds and clips is of this version, or missing.
///
/// # Errors
/// A later version has written it, or it is damaged.
pub(super) fn check_format(path: &Path) -> Result<(), StoreError> {
    if !files::is_there(path) {
        return Ok(());
    }
    files::read(path, DIRECTORY, FORMAT).map(drop)
}

pub(super) fn write_format(path: &Path) -> Result<(), StoreError> {
    files::write(path, DIRECTORY, FORMAT, b"worlds and clips of sinew")
}

pub(super) fn write_end(path: &Path) -> Result<(), StoreError> {
    files::write(path, END, FORMAT, b"in good order")
}

pub(super) fn is_end(path: &Path) -> bool {
    files::read(path, END, FORMAT).is_ok()
}

pub(super) fn write_world(path: &Path, world: &WorldRecord) -> Result<(), StoreError> {
    let packed = Packed::default()
        .bytes(&world.key.0.to_le_bytes())
        .bytes(world.name.as_bytes())
        .bytes(world.durability.name().as_bytes())
        .bytes(world.quarantined.as_deref().unwrap_or("").as_bytes())
        .bytes(&world.settings);
    files::write(path, WORLD, FORMAT, &packed.0)
}

pub(super) fn read_world(path: &Path) -> Result<WorldRecord, StoreError> {
    read(path, WORLD, |fields| {
        Some(WorldRecord {
            key: WorldKey(u64::from_le_bytes(fields.bytes()?.try_into().ok()?)),
            name: fields.text()?.to_owned(),
            durability: Durability::by_name(fields.text()?)?,
            quarantined: Some(fields.text()?.to_owned()).filter(|why| !why.is_empty()),
            settings: Bytes::copy_from_slice(fields.bytes()?),
        })
    })
}

/// The state of a world after a tick.
pub(super) fn write_state(path: &Path, tick: u64, state: &[u8]) -> Result<(), StoreError> {
    let packed = Packed::default().bytes(&tick.to_le_bytes()).bytes(state);
    files::write(path, STATE, FORMAT, &packed.0)
}

pub(super) fn read_state(path: &Path) -> Result<(u64, Bytes), StoreError> {
    read(path, STATE, |fields| {
        let tick = u64::from_le_bytes(fields.bytes()?.try_into().ok()?);
        Some((tick, Bytes::copy_from_slice(fields.bytes()?)))
    })
}

/// Content of a clip's file; the motion itself has its own file.
pub(super) struct ClipFile {
    pub name: String,
    pub description: Bytes,
    /// SHA-256 of its content.
    pub hash: Vec<u8>,
}

pub(super) fn write_clip(path: &Path, clip: &ClipFile) -> Result<(), StoreError> {
    let packed = Packed::default()
        .bytes(clip.name.as_bytes())
        .bytes(&clip.description)
        .bytes(&clip.hash);
    files::write(path, CLIP, FORMAT, &packed.0)
}

pub(super) fn read_clip(path: &Path) -> Result<ClipFile, StoreError> {
    read(path, CLIP, |fields| {
        Some(ClipFile {
            name: fields.text()?.to_owned(),
            description: Bytes::copy_from_slice(fields.bytes()?),
            hash: fields.bytes()?.to_vec(),
        })
    })
}

pub(super) fn write_content(path: &Path, content: &[u8]) -> Result<(), StoreError> {
    files::write(path, CONTENT, FORMAT, content)
}

pub(super) fn read_content(path: &Path) -> Result<Vec<u8>, StoreError> {
    files::read(path, CONTENT, FORMAT)
}

pub(super) fn write_rehearsal(path: &Path, r: &RehearsalRecord) -> Result<(), StoreError> {
    let packed = Packed::default()
        .bytes(r.clip.as_bytes())
        .bytes(r.figure.as_bytes())
        .bytes(&r.content);
    files::write(path, REHEARSAL, FORMAT, &packed.0)
}

pub(super) fn read_rehearsal(path: &Path) -> Result<RehearsalRecord, StoreError> {
    read(path, REHEARSAL, |fields| {
        Some(RehearsalRecord {
            clip: fields.text()?.to_owned(),
            figure: fields.text()?.to_owned(),
            content: Bytes::copy_from_slice(fields.bytes()?),
        })
    })
}
