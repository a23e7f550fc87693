//! The pace of a stream: the part of its source time that is played in a tick.
//!
//! Arrivals are stamped with *scheduled time* ([`ScheduledTime`]). Motion is played in world time: in a world that
//! skips ticks it falls behind, is never too fast for the body, and catches up slowly.

use super::time::{PlayoutTime, ScheduledTime, SourceTime};
use serde::{Deserialize, Serialize};
use sinew_physics::time::WorldTime;
use sinew_wire::types::{Delay, DriveSettings};
use std::collections::VecDeque;

/// Arrivals over which the jitter is measured.
const WINDOW: usize = 256;
/// Most of these that can be at or above the p99.
const SLOWEST: usize = WINDOW - (WINDOW - 1) * 99 / 100;
/// Share of time by which an adaptive delay shrinks: one hundredth is not visible.
pub(super) const SHRINK: f64 = 0.01;
/// Share of time by which a stream that fell behind with its world catches up: two hundredths do not tax the balance.
pub(super) const CATCH_UP: f64 = 0.02;
/// Largest distance of a stream behind its world's schedule, s: at 240 Hz the buffer is full then.
pub(super) const MOST_BEHIND: f64 = 2.0;

/// Largest time used in calculations, s.
const LARGEST_TIME: f64 = 1e12;

/// An instant of a world.
#[derive(Clone, Copy, Debug, Default)]
pub struct Now {
    /// World time.
    pub time: WorldTime,
    /// World time that the clock has skipped until now, s.
    pub lost: f64,
}

impl Now {
    /// The same instant in scheduled time.
    pub fn scheduled(self) -> ScheduledTime {
        ScheduledTime(self.time.0 + self.lost)
    }
}

/// The motion to play in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PlayoutDue {
    /// None: no frame has arrived.
    Nothing,
    /// None any more: the stream is too far behind.
    TooFarBehind,
    /// The motion at this time.
    At(PlayoutTime),
}

/// Source time against world time.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Playout {
    /// Source time and scheduled time of the first frame.
    origin: Option<(SourceTime, ScheduledTime)>,
    /// Scheduled time minus (first arrival + source time since then) of recent frames.
    transit: VecDeque<f64>,
    /// Scheduled time of the last arrival.
    arrived: ScheduledTime,
    /// p99 of the jitter; `None` if frames have arrived since it was measured.
    jitter: Option<f64>,
    /// Present delay of playout behind the ideal clock, s; may be negative when frames come early.
    delay: Option<f64>,
    /// World time skipped by the last tick, s, and how far the stream is behind, s, because of that or because it took
    /// over another one; negative: ahead.
    lost: Option<f64>,
    behind: f64,
    /// Playout time of the last answer.
    pub(super) played: PlayoutTime,
}

impl Default for Playout {
    fn default() -> Self {
        Self {
            origin: None,
            transit: VecDeque::new(),
            arrived: ScheduledTime::default(),
            jitter: Some(0.0),
            delay: None,
            lost: None,
            behind: 0.0,
            played: PlayoutTime(f64::NEG_INFINITY),
        }
    }
}

/// Whether a stream can get to this time, or difference of times, s.
pub(super) fn is_time(seconds: f64) -> bool {
    seconds.abs() <= LARGEST_TIME
}

impl Playout {
    /// Whether this value is one that a checkpoint could hold.
    pub(super) fn is_valid(&self) -> bool {
        let known = [self.arrived.0, self.behind];
        let first = self.origin.map(|o| o.1.0);
        let optional = [first, self.jitter, self.delay, self.lost];
        self.transit.len() <= WINDOW
            && known.iter().chain(&self.transit).all(|x| is_time(*x))
            && optional.iter().flatten().all(|x| is_time(*x))
            && (is_time(self.played.0) || self.played.0 == f64::NEG_INFINITY)
    }

    /// The playout time of a source time.
    pub(super) fn playout_time(&self, source: SourceTime) -> PlayoutTime {
        let first = self.origin.map_or(source, |(first, _)| first);
        PlayoutTime(source.since(first))
    }

    /// Scheduled time since the last arrival, s.
    pub(super) fn since_arrival(&self, now: ScheduledTime) -> f64 {
        now - self.arrived
    }

    /// Notes a frame that arrived `now`; returns its playout time.
    pub(super) fn arrive(&mut self, source: SourceTime, now: ScheduledTime) -> PlayoutTime {
        self.arrived = now;
        let (_, first) = *self.origin.get_or_insert((source, now));
        let at = self.playout_time(source);
        if self.transit.len() == WINDOW {
            self.transit.pop_front();
        }
        self.transit.push_back(now - first - at.0);
        self.jitter = None;
        at
    }

    fn fastest(&self) -> f64 {
        self.transit
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min)
            .min(LARGEST_TIME)
    }

    /// p99 of the arrival jitter up to the last tick, s.
    pub(super) fn jitter(&self) -> f64 {
        self.jitter.unwrap_or_else(|| self.measured())
    }

    fn measured(&self) -> f64 {
        let count = self.transit.len();
        if count == 0 {
            return 0.0;
        }
        // Few values are above the percentile, so one pass finds them without sorting.
        let rank = (count - 1) * 99 / 100;
        let mut slowest = [f64::NEG_INFINITY; SLOWEST];
        let slowest = &mut slowest[..count - rank];
        for t in &self.transit {
            if t.total_cmp(&slowest[0]).is_gt() {
                let above = slowest.partition_point(|s| s.total_cmp(t).is_lt());
                slowest.copy_within(1..above, 0);
                slowest[above - 1] = *t;
            }
        }
        slowest[0] - self.fastest()
    }

    /// Delay between arrival and use, s.
    pub(super) fn delay(&self, settings: &DriveSettings) -> f64 {
        let delay = match (settings.delay, self.delay) {
            (Delay::Fixed(d), _) => d,
            (Delay::Adaptive { .. }, Some(d)) => d - self.fastest(),
            (Delay::Adaptive { .. }, None) => 0.0,
        };
        delay + self.behind
    }

    /// World time skipped by the last tick, s.
    pub(super) fn lost(&self) -> Option<f64> {
        self.lost
    }

    /// How far the stream is behind because its world skips ticks, or because it took over another one, s; contained in
    /// the delay.
    pub(super) fn behind(&self) -> f64 {
        self.behind.max(0.0)
    }

    /// Plays the motion `later` (s) after the place where it would play, and names its time `renamed` seconds more than
    /// now.
    pub(super) fn shift(&mut self, later: f64, renamed: f64, settings: &DriveSettings) {
        self.behind -= later + renamed;
        if let Some((first, _)) = &mut self.origin {
            *first = first.earlier(renamed);
        }
        // Arrival times count from the first frame.
        self.transit.iter_mut().for_each(|t| *t -= renamed);
        if let (Delay::Adaptive { .. }, Some(delay)) = (settings.delay, &mut self.delay) {
            *delay -= renamed;
            self.behind += renamed;
        }
    }

    /// The motion in the tick of `tick` seconds that begins `now`; updates the adaptive delay.
    pub(super) fn advance(&mut self, now: Now, tick: f64, settings: &DriveSettings) -> PlayoutDue {
        let Some((_, first)) = self.origin else {
            return PlayoutDue::Nothing;
        };
        let left_out = self.lost.replace(now.lost).map_or(0.0, |l| now.lost - l);
        let made_up = self.behind.clamp(-CATCH_UP * tick, CATCH_UP * tick);
        self.behind += left_out - made_up;
        if self.behind > MOST_BEHIND {
            return PlayoutDue::TooFarBehind;
        }
        let jitter = self.jitter();
        self.jitter = Some(jitter);
        let delay = match settings.delay {
            Delay::Fixed(d) => d,
            Delay::Adaptive { most } => {
                let frame = 1.0 / settings.rate_hz;
                // Interpolation also needs the next frame.
                let wanted = self.fastest() + (jitter + frame + tick).min(most);
                match self.delay {
                    None => wanted,
                    Some(d) if wanted > d => wanted,
                    Some(d) if d - wanted > most => wanted, // the clocks jumped
                    Some(d) => (d - SHRINK * tick).max(wanted),
                }
            }
        };
        self.delay = Some(delay);
        let p = PlayoutTime(now.scheduled() - first - delay - self.behind);
        // Time may stand still while a delay grows, but does not run backwards.
        PlayoutDue::At(if self.played.is_finite() {
            p.max(self.played)
        } else {
            p
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_jitter_is_what_sorting_would_find() {
        let mut seed = 1u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 40) as f64
        };
        let mut playout = Playout::default();
        assert_eq!(playout.measured(), 0.0);
        for i in 0..4 * WINDOW as i64 {
            // Steps of 1 ms, so that some are equal, and of any size after that.
            let late = if i < 2 * WINDOW as i64 {
                (random() % 8.0) * 1e-3
            } else {
                random() * 1e-9
            };
            let arrival = ScheduledTime(i as f64 / 60.0 + late);
            playout.arrive(SourceTime(i * 16_666_667), arrival);
            let base = playout.fastest();
            let mut sorted: Vec<f64> = playout.transit.iter().map(|t| t - base).collect();
            sorted.sort_by(f64::total_cmp);
            let p99 = sorted[(sorted.len() - 1) * 99 / 100];
            assert_eq!(playout.measured().to_bits(), p99.to_bits(), "frame {i}");
        }
    }
}
