//! Limits how much one driver may send.
//!
//! The cost of a batch grows with the desired postures in it, so the allowance counts those and not batches. It is
//! checked before a batch is converted.

use std::time::{Duration, Instant};

/// Frames per second that a driver may send for each of its figures in the long run: the fastest rate that a drive can
/// name.
pub const FRAMES_PER_SECOND: f64 = 1000.0;
/// Frames per figure that may arrive at once, after a pause of the network: as many as a jitter buffer holds.
pub const FRAME_BURST: f64 = super::jitter_buffer::CAPACITY as f64;

/// Token bucket of one driver. A token is the desired posture of one figure in one frame.
#[derive(Debug)]
pub struct Admission {
    rate: f64,
    burst: f64,
    tokens: f64,
    last: Instant,
}

impl Admission {
    /// A full bucket for a driver with this number of figures.
    pub fn new(figures: usize, now: Instant) -> Self {
        let burst = FRAME_BURST * figures as f64;
        Self {
            rate: FRAMES_PER_SECOND * figures as f64,
            burst,
            tokens: burst,
            last: now,
        }
    }

    /// Takes the tokens for a batch with `postures` desired postures; a batch without any counts as one.
    ///
    /// # Errors
    /// It came too fast. The fault has the time after which it may come.
    pub fn admit(&mut self, postures: usize, now: Instant) -> Result<(), Duration> {
        let passed = now.saturating_duration_since(self.last).as_secs_f64();
        self.last = now;
        self.tokens = (self.tokens + passed * self.rate).min(self.burst);
        // More than the bucket holds would never be admitted.
        let cost = (postures.max(1) as f64).min(self.burst);
        if self.tokens < cost {
            return Err(Duration::from_secs_f64((cost - self.tokens) / self.rate));
        }
        self.tokens -= cost;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_burst_is_taken_and_a_flood_is_not_however_it_is_cut_into_batches() {
        let start = Instant::now();
        for (figures, postures) in [(1, 1), (1, 64), (16, 1024), (3, 0)] {
            let mut a = Admission::new(figures, start);
            let taken = (0..10_000).filter(|_| a.admit(postures, start).is_ok());
            let frames = taken.count() * postures.max(1) / figures;
            let burst = FRAME_BURST as usize;
            assert!(frames <= burst && frames + 64 > burst, "{frames}");
            let wait = a.admit(postures, start).unwrap_err();
            assert!(a.admit(postures, start + wait / 2).is_err());
            let wait = wait + Duration::from_micros(1);
            assert!(a.admit(postures, start + wait).is_ok(), "{wait:?}");
        }
    }
}
