//! Live desired motion on its way to the tick.

pub mod admission;
pub mod jitter_buffer;
pub mod mailbox;
pub mod playout;
pub mod saved;
pub mod time;
