//! Frames that a worker has yet to announce to the network.
//!
//! An announcement wakes a thread, which costs both sides more than a frame does. A worker with several ticks to run at
//! once announces them together: one wake-up serves all.

use crate::tick::Outlet;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Longest time for which a worker keeps a frame to itself: a sixteenth of the time from one to the next at 60 Hz. A
/// tick that takes longer delays the frames that are waiting.
const PATIENCE: Duration = Duration::from_millis(1);

/// Worlds whose latest frame has not been announced.
#[derive(Debug, Default)]
pub(super) struct News {
    outlets: Vec<Arc<Outlet>>,
    since: Option<Instant>,
}

impl News {
    /// Adds one world.
    pub fn add(&mut self, outlet: Arc<Outlet>) {
        self.since.get_or_insert_with(Instant::now);
        self.outlets.push(outlet);
    }

    /// Whether there is nothing to announce.
    pub fn is_empty(&self) -> bool {
        self.outlets.is_empty()
    }

    /// Whether the frames have waited for long enough.
    pub fn is_due(&self) -> bool {
        self.since.is_some_and(|since| since.elapsed() >= PATIENCE)
    }

    /// Announces all of them.
    pub fn tell(&mut self) {
        self.since = None;
        for outlet in self.outlets.drain(..) {
            outlet.tell();
        }
    }
}

impl Drop for News {
    /// Leaves no reader waiting when the thread ends.
    fn drop(&mut self) {
        self.tell();
    }
}
