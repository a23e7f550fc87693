//! One row of the log: the part of one commit that belongs to one world, with a checksum over all of it.
//!
//! ```text
//!   checkpoint   the state
//!   group        frames one behind the other:  kind u8 │ tick u64 │ length u32 │ bytes
//! ```

use crate::durable::store::{LoggedTick, StoreItem, WorldKey};
use bytes::Bytes;

/// Kind of a row: the state after a tick.
pub(super) const CHECKPOINT: u8 = 1;
/// Kind of a row: inputs and hashes in order of arrival.
pub(super) const GROUP: u8 = 2;

// Kinds of frames.
pub(super) const INPUT: u8 = 1;
pub(super) const HASH: u8 = 2;

/// Kind, tick and length of a frame, bytes.
const FRAME_HEAD: usize = 1 + 8 + 4;

/// One row, as it is on disk.
#[derive(Debug)]
pub(super) struct LogRow {
    pub id: i64,
    pub world: WorldKey,
    pub session: i64,
    /// Number of the next group of its world; for a group, its own number.
    pub seq: i64,
    pub kind: u8,
    pub tick: u64,
    pub bytes: Bytes,
}

impl LogRow {
    /// CRC-32 of everything in it.
    pub fn sum(&self) -> i64 {
        let mut sum = crc32fast::Hasher::new();
        for number in [self.id, self.world.0 as i64, self.session, self.seq] {
            sum.update(&number.to_le_bytes());
        }
        sum.update(&[self.kind]);
        sum.update(&self.tick.to_le_bytes());
        sum.update(&self.bytes);
        i64::from(sum.finalize())
    }

    /// The row on disk, and whether it is intact. Values of a wrong type are not intact.
    ///
    /// # Errors
    /// SQLite cannot read it.
    pub fn read(row: &rusqlite::Row<'_>) -> rusqlite::Result<(Self, bool)> {
        let number = |i: usize| row.get_ref(i).map(|v| v.as_i64().unwrap_or(-1));
        let bytes = row.get_ref(7)?.as_blob().unwrap_or_default();
        let read = Self {
            id: number(0)?,
            world: WorldKey(number(1)? as u64),
            session: number(2)?,
            seq: number(3)?,
            kind: u8::try_from(number(4)?).unwrap_or(0),
            tick: number(5)? as u64,
            bytes: Bytes::copy_from_slice(bytes),
        };
        let whole = read.sum() == number(6)?;
        Ok((read, whole))
    }

    /// The content of a group; `None` if these bytes are not a group.
    pub fn frames(&self) -> Option<Vec<LoggedTick>> {
        let mut rest = self.bytes.clone();
        let mut out = Vec::new();
        while !rest.is_empty() {
            let head = rest.first_chunk::<FRAME_HEAD>()?;
            let kind = head[0];
            let tick = u64::from_le_bytes(head[1..9].try_into().ok()?);
            let length = u32::from_le_bytes(head[9..].try_into().ok()?) as usize;
            let _ = rest.split_to(FRAME_HEAD);
            if rest.len() < length {
                return None;
            }
            let bytes = rest.split_to(length);
            let item = match kind {
                INPUT => StoreItem::Input(bytes),
                HASH => StoreItem::Hash(u64::from_le_bytes(bytes[..].try_into().ok()?)),
                _ => return None,
            };
            out.push(LoggedTick { tick, item });
        }
        Some(out)
    }
}

/// Appends a frame to a group.
pub(super) fn frame(group: &mut Vec<u8>, kind: u8, tick: u64, bytes: &[u8]) {
    group.push(kind);
    group.extend_from_slice(&tick.to_le_bytes());
    let length = u32::try_from(bytes.len()).expect("requests are smaller than 4 GiB");
    group.extend_from_slice(&length.to_le_bytes());
    group.extend_from_slice(bytes);
}
