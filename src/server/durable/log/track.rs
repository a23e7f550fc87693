//! The place of each world in the log: its checkpoints, its size and its next row.

use std::collections::VecDeque;

/// A checkpoint in the log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct CheckpointPlace {
    pub id: i64,
    pub session: i64,
    /// Number of the first group behind it.
    pub seq: i64,
    pub tick: u64,
    /// When it was written, milliseconds since 1970.
    pub time_ms: i64,
    /// Bytes of this world before it.
    pub bytes_before: u64,
}

/// The part of the log that belongs to one world.
#[derive(Debug, Default)]
pub(super) struct WorldTrack {
    /// From the oldest to the latest.
    pub places: VecDeque<CheckpointPlace>,
    /// Bytes ever written.
    pub written: u64,
    /// Number of the next group of this session; `None` until there is a checkpoint.
    pub next: Option<i64>,
}

impl WorldTrack {
    /// Bytes from its oldest checkpoint on.
    pub fn held(&self) -> u64 {
        let first = self.places.front();
        first.map_or(0, |p| self.written.saturating_sub(p.bytes_before))
    }
}
