//! Checkpoints of worlds.

use super::names::CHECKPOINT;
pub use super::names::checkpoint_name;
use super::timestamp;
use crate::pb;
use std::time::SystemTime;

/// The identity of a checkpoint.
#[derive(Clone, Debug)]
pub struct CheckpointInfo<'a> {
    /// Last parts of the names of its world and its own.
    pub name: (&'a str, &'a str),
    /// Tick and time (s) of the state.
    pub tick: u64,
    /// World time, s.
    pub time: f64,
    /// State hash.
    pub hash: u64,
    /// Size, bytes.
    pub size: usize,
    /// Creation time.
    pub created: SystemTime,
}

/// A checkpoint for a response.
pub fn checkpoint_out(c: &CheckpointInfo<'_>) -> pb::Checkpoint {
    let (world, id) = c.name;
    pb::Checkpoint {
        name: CHECKPOINT.name([world, id]),
        tick: c.tick as i64,
        time_s: c.time,
        state_hash: c.hash as i64,
        size_bytes: c.size as i64,
        create_time: Some(timestamp(c.created)),
    }
}
