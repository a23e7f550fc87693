//! When ticks are due: absolute deadlines, and what happens to those that were missed.

use crate::wire::types::Overrun;
use std::time::{Duration, Instant};

/// Deadlines of one world. Deadlines are multiples of the period from a start, so that they do not drift.
#[derive(Clone, Debug)]
pub struct Clock {
    period: Duration,
    policy: Overrun,
    deadline: Instant,
    /// Ticks done in a row after a missed deadline.
    caught_up: u32,
    /// Deadlines left out so far.
    pub skipped: u64,
    /// Ticks that were not done by the next deadline.
    pub overruns: u64,
}

impl Clock {
    /// A clock whose first tick is due one period from `now`.
    pub fn new(rate_hz: f64, speed: f64, policy: Overrun, now: Instant) -> Self {
        let period = Duration::from_secs_f64(1.0 / (rate_hz * speed));
        Self {
            period,
            policy,
            deadline: now + period,
            caught_up: 0,
            skipped: 0,
            overruns: 0,
        }
    }

    /// The same counts with another pace; the next tick is due one period from `now`.
    pub fn restart(&mut self, rate_hz: f64, speed: f64, policy: Overrun, now: Instant) {
        let (skipped, overruns) = (self.skipped, self.overruns);
        *self = Self {
            skipped,
            overruns,
            ..Self::new(rate_hz, speed, policy, now)
        };
    }

    /// Time between ticks.
    pub fn period(&self) -> Duration {
        self.period
    }

    /// When the next tick is due.
    pub fn deadline(&self) -> Instant {
        self.deadline
    }

    /// Moves to the next deadline after a tick that ended at `now`.
    pub fn advance(&mut self, now: Instant) {
        let next = self.deadline + self.period;
        if now <= next {
            self.deadline = next;
            self.caught_up = 0;
            return;
        }
        self.overruns += 1;
        match self.policy {
            Overrun::Dilate => self.deadline = now,
            Overrun::CatchUp(most) if self.caught_up < most => {
                self.caught_up += 1;
                self.deadline = next;
            }
            Overrun::CatchUp(_) | Overrun::Skip => {
                let missed = (now - next).as_nanos() / self.period.as_nanos().max(1);
                // The slot that has begun is left out as well: its deadline has passed.
                let slots = u32::try_from(missed + 1).unwrap_or(u32::MAX);
                self.skipped += u64::from(slots);
                self.deadline = next + self.period * slots;
                self.caught_up = 0;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: Duration = Duration::from_millis(1);

    fn clock(policy: Overrun, start: Instant) -> Clock {
        Clock::new(100.0, 1.0, policy, start)
    }

    #[test]
    fn deadlines_do_not_drift() {
        let start = Instant::now();
        let mut c = clock(Overrun::Skip, start);
        for i in 1..1000 {
            assert_eq!(c.deadline(), start + MS * 10 * i);
            c.advance(c.deadline() + MS * 3);
        }
        assert_eq!((c.skipped, c.overruns), (0, 0));
    }

    #[test]
    fn policies_on_a_tick_of_34_ms() {
        let start = Instant::now();
        let late = start + MS * 10 + MS * 34;
        let mut skip = clock(Overrun::Skip, start);
        skip.advance(late);
        assert_eq!((skip.deadline(), skip.skipped), (start + MS * 50, 3));
        let mut dilate = clock(Overrun::Dilate, start);
        dilate.advance(late);
        assert_eq!((dilate.deadline(), dilate.skipped), (late, 0));
        let mut catch_up = clock(Overrun::CatchUp(2), start);
        catch_up.advance(late); // tick of deadline 20 is done at once
        assert_eq!(catch_up.deadline(), start + MS * 20);
        catch_up.advance(late + MS);
        assert_eq!(
            (catch_up.deadline(), catch_up.skipped),
            (start + MS * 30, 0)
        );
        catch_up.advance(late + MS * 2); // two were caught up: the rest is left out
        assert_eq!(
            (catch_up.deadline(), catch_up.skipped),
            (start + MS * 50, 1)
        );
    }
}
