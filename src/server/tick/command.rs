//! What is done to a world between ticks.

use super::shard::Shard;
use std::sync::Arc;

/// Who asks and in which order: commands that meet in one tick are carried out by (client, sequence), so that a replay
/// is exact.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Origin {
    /// Who asks.
    pub client: Arc<str>,
    /// Number of the request at that client.
    pub sequence: i64,
}

/// A change of a world or a question to it, carried out by its thread at the start of a tick.
pub struct Command {
    /// Who asks.
    pub origin: Origin,
    /// What is done.
    pub action: Box<dyn FnOnce(&mut Shard) + Send>,
}

/// Puts commands that meet in one tick into their order; those of one client and sequence stay in the order of arrival.
pub fn order(commands: &mut [Command]) {
    commands.sort_by(|a, b| a.origin.cmp(&b.origin));
}
