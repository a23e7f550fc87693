//! The due times of ticks: absolute deadlines, and the handling of missed ones.

use sinew_wire::types::Overrun;
use std::time::{Duration, Instant};

/// Deadlines of one world. Deadlines are multiples of the period from a start, so that they do not drift.
#[derive(Clone, Debug)]
pub struct TickClock {
    period: Duration,
    policy: Overrun,
    deadline: Instant,
    /// Place of its deadlines among those of other worlds: a start, and a part of the period after it.
    phase: Option<(Instant, f64)>,
    /// Ticks done in a row after a missed deadline.
    caught_up: u32,
    /// Deadlines skipped until now.
    pub skipped: u64,
    /// Ticks that were not done by the next deadline.
    pub overruns: u64,
    /// Time skipped or passed while the clock was held up, in ticks.
    lost: f64,
}

impl TickClock {
    /// A clock whose first tick is due one period from `now`.
    pub fn new(rate_hz: f64, speed: f64, policy: Overrun, now: Instant) -> Self {
        let period = Duration::from_secs_f64(1.0 / (rate_hz * speed));
        Self {
            period,
            policy,
            deadline: now + period,
            phase: None,
            caught_up: 0,
            skipped: 0,
            overruns: 0,
            lost: 0.0,
        }
    }

    /// Keeps the counts and sets another pace; the next tick is due within one period from `now`, at its phase.
    pub fn restart(&mut self, rate_hz: f64, speed: f64, policy: Overrun, now: Instant) {
        let (skipped, overruns, lost) = (self.skipped, self.overruns, self.lost);
        let phase = self.phase;
        *self = Self {
            skipped,
            overruns,
            lost,
            ..Self::new(rate_hz, speed, policy, now)
        };
        if let Some((start, part)) = phase {
            self.stagger(start, part, now);
        }
    }

    /// Places deadlines `part` of a period after multiples of it from `start`, so that worlds that begin together do
    /// not tick together. The next tick is due within one period from `now`.
    pub fn stagger(&mut self, start: Instant, part: f64, now: Instant) {
        self.phase = Some((start, part));
        let period = self.period.as_nanos().max(1);
        let first = start + self.period.mul_f64(part);
        self.deadline = match now.checked_duration_since(first) {
            Some(past) => {
                let into = (past.as_nanos() % period) as u64;
                now + self.period - Duration::from_nanos(into)
            }
            None => first,
        };
    }

    /// Time between ticks.
    pub fn period(&self) -> Duration {
        self.period
    }

    /// Ticks by which world time is behind a clock that never skipped one.
    pub fn lost(&self) -> f64 {
        self.lost
    }

    /// Ticks from the next deadline to `instant`; negative before it.
    pub fn since_deadline(&self, instant: Instant) -> f64 {
        let ahead = self.deadline.saturating_duration_since(instant);
        let past = instant.saturating_duration_since(self.deadline);
        (past.as_secs_f64() - ahead.as_secs_f64()) / self.period.as_secs_f64()
    }

    /// When the next tick is due.
    pub fn deadline(&self) -> Instant {
        self.deadline
    }

    /// Delays the next tick until at least `instant`; skipped time is lost as in a long tick.
    pub fn rest(&mut self, instant: Instant) {
        if self.deadline >= instant {
            return;
        }
        let held = (instant - self.deadline).as_secs_f64() / self.period.as_secs_f64();
        if self.policy == Overrun::Dilate {
            self.deadline = instant;
            self.lost += held;
        } else {
            let slots = held.ceil() as u32;
            self.skipped += u64::from(slots);
            self.lost += f64::from(slots);
            self.deadline += self.period * slots;
            self.caught_up = 0;
        }
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
            Overrun::Dilate => {
                self.deadline = now + self.period;
                self.lost += (self.deadline - next).as_secs_f64() / self.period.as_secs_f64();
            }
            Overrun::CatchUp(most) if self.caught_up < most => {
                self.caught_up += 1;
                self.deadline = next;
            }
            Overrun::CatchUp(_) | Overrun::Skip => {
                let missed = (now - next).as_nanos() / self.period.as_nanos().max(1);
                // The slot that has begun is skipped as well, because its deadline has passed.
                let slots = u32::try_from(missed + 1).unwrap_or(u32::MAX);
                self.skipped += u64::from(slots);
                self.lost += f64::from(slots);
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

    fn clock(policy: Overrun, start: Instant) -> TickClock {
        TickClock::new(100.0, 1.0, policy, start)
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
    fn worlds_that_begin_together_tick_apart() {
        let start = Instant::now();
        let now = start + MS * 12_345;
        let mut due: Vec<Instant> = (0..100)
            .map(|n| {
                let mut c = clock(Overrun::Skip, now);
                c.stagger(start, (f64::from(n) * 0.618_034).fract(), now);
                let first = c.deadline();
                assert!(first > now && first <= now + MS * 10);
                // Another pace and back: the same grid.
                c.restart(50.0, 1.0, Overrun::Skip, now);
                c.restart(100.0, 1.0, Overrun::Skip, now + MS * 30);
                assert_eq!(c.deadline(), first + MS * 30);
                first
            })
            .collect();
        due.sort_unstable();
        let gaps = due.windows(2).map(|w| w[1] - w[0]);
        assert!(gaps.max().unwrap() < MS / 4, "100 worlds in 10 ms: {due:?}");
    }

    #[test]
    fn a_clock_that_has_to_rest_leaves_deadlines_out() {
        let start = Instant::now();
        for (policy, deadline, skipped, lost) in [
            (Overrun::Skip, 40, 3, 3.0),
            (Overrun::CatchUp(5), 40, 3, 3.0),
            (Overrun::Dilate, 34, 0, 2.4),
        ] {
            let mut c = clock(policy, start);
            c.rest(start + MS * 5); // before the deadline anyway
            assert_eq!(c.deadline(), start + MS * 10);
            c.rest(start + MS * 34);
            assert_eq!((c.deadline(), c.skipped), (start + MS * deadline, skipped));
            assert!((c.lost() - lost).abs() < 1e-9);
        }
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
        assert_eq!((dilate.deadline(), dilate.skipped), (late + MS * 10, 0));
        let mut catch_up = clock(Overrun::CatchUp(2), start);
        catch_up.advance(late); // tick of deadline 20 is done at once
        assert_eq!(catch_up.deadline(), start + MS * 20);
        catch_up.advance(late + MS);
        assert_eq!(
            (catch_up.deadline(), catch_up.skipped),
            (start + MS * 30, 0)
        );
        catch_up.advance(late + MS * 2); // two were caught up: the rest is skipped
        assert_eq!(
            (catch_up.deadline(), catch_up.skipped),
            (start + MS * 50, 1)
        );
        for (clock, lost) in [(&skip, 3.0), (&dilate, 3.4), (&catch_up, 1.0)] {
            assert!((clock.lost() - lost).abs() < 1e-9, "{clock:?}");
        }
        assert!((skip.since_deadline(start + MS * 55) - 0.5).abs() < 1e-9);
        assert!((skip.since_deadline(start + MS * 35) + 1.5).abs() < 1e-9);
    }
}
