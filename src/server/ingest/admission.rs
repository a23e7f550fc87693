//! How much one sender may put into a world's queue.

use std::time::Instant;

/// Batches per second that one driver may send in the long run: twice the fastest tick rate that a person could want to
/// feed.
pub const BATCHES_PER_SECOND: f64 = 500.0;
/// Batches that may come at once, after a pause of the network.
pub const BATCH_BURST: f64 = 250.0;

/// Token bucket of one sender.
#[derive(Debug)]
pub struct Admission {
    tokens: f64,
    last: Instant,
}

impl Admission {
    /// A full bucket.
    pub fn new(now: Instant) -> Self {
        Self {
            tokens: BATCH_BURST,
            last: now,
        }
    }

    /// Takes one batch's worth; false if it came too fast.
    pub fn admit(&mut self, now: Instant) -> bool {
        let passed = now.saturating_duration_since(self.last).as_secs_f64();
        self.last = now;
        self.tokens = (self.tokens + passed * BATCHES_PER_SECOND).min(BATCH_BURST);
        if self.tokens < 1.0 {
            return false;
        }
        self.tokens -= 1.0;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn a_burst_is_taken_and_a_flood_is_not() {
        let start = Instant::now();
        let mut a = Admission::new(start);
        let taken = (0..1000).filter(|_| a.admit(start)).count();
        assert_eq!(taken, BATCH_BURST as usize);
        assert!(a.admit(start + Duration::from_millis(3)));
        assert!(!a.admit(start + Duration::from_millis(3)));
    }
}
