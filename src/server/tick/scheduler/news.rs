//! Frames that a worker has yet to tell the network about.
//!
//! Telling wakes a thread, which costs both sides more than a frame does. A worker that has more ticks to run at once
//! tells of several of them together: one wake-up serves all.

use crate::tick::Outlet;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Longest time for which a worker keeps a frame to itself: a sixteenth of the time from one to the next at 60 Hz. A
/// tick that takes longer holds up what waits.
const PATIENCE: Duration = Duration::from_millis(1);

/// Worlds whose latest frame has not been announced.
#[derive(Debug, Default)]
pub(super) struct News {
    outlets: Vec<Arc<Outlet>>,
    since: Option<Instant>,
}

impl News {
    /// One more.
    pub fn add(&mut self, outlet: Arc<Outlet>) {
        self.since.get_or_insert_with(Instant::now);
        self.outlets.push(outlet);
    }

    /// There is nothing to tell.
    pub fn is_empty(&self) -> bool {
        self.outlets.is_empty()
    }

    /// They have waited for long enough.
    pub fn is_due(&self) -> bool {
        self.since.is_some_and(|since| since.elapsed() >= PATIENCE)
    }

    /// Tells of all.
    pub fn tell(&mut self) {
        self.since = None;
        for outlet in self.outlets.drain(..) {
            outlet.tell();
        }
    }
}

impl Drop for News {
    /// A thread that ends leaves nobody waiting.
    fn drop(&mut self) {
        self.tell();
    }
}
