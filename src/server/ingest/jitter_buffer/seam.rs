//! Joins one stream to another at a moment where they are alike.
//!
//! Two drivers of the same walk are never quite in phase: their clocks, networks and delays differ. A figure that is
//! handed over is in mid-step, and a jump in the phase of its step would cost it its balance. So the second stream is
//! searched for the moment that is most like the one at which the first is left, in posture and rates. It is joined
//! there, a little older or newer than its delay asks for, and slowly makes up for the difference.

use super::{JitterBuffer, Supply, grid_time};
use crate::ingest::time::PlayoutTime;
use sinew_physics::body::Posture;
use sinew_physics::plan::likeness;

/// Largest amount by which the joining motion may be older than its delay asks for, s: a stride, so that every walk
/// contains a like moment. It is made up for by two hundredths of time.
const MOST_OLDER: f64 = 1.2;
/// Share of the motion that has arrived early that may be used up.
const MOST_NEWER: f64 = 0.75;
/// Time after the beginning of the second stream for which a like moment is awaited, s: a stride and its neighbours.
const PATIENCE: f64 = 1.5;
/// Moments compared for each sample of the grid; the best one is interpolated between them.
const MOMENTS: i64 = 1;

/// How a stream can continue from another one in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StreamSeam {
    /// Not yet: a better match may still arrive.
    Later,
    /// Here.
    Here(StreamStart),
    /// There is no like moment.
    Nowhere,
}

/// The place where a stream is joined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StreamStart {
    /// How much later than the time that is due, s.
    later: f64,
    /// Newest time that the window has, and its next sample: those of the other stream, in the times of this one.
    head: PlayoutTime,
    next: i64,
    /// Offset of its times, s, so that its grid matches that of the other stream.
    renamed: f64,
}

impl JitterBuffer {
    /// Finds the place at which this stream, of which time `p` is due, can continue `before`. A window holds the
    /// samples of `before` on a grid of `rate` per second.
    pub fn seam(&self, p: PlayoutTime, before: &Self, rate: f64) -> StreamSeam {
        let (Some(head), Some(newest)) = (before.grid.head, self.frames.back()) else {
            return StreamSeam::Nowhere;
        };
        let next = before.grid.next;
        let last = [3, 2, 1].map(|k| before.at(grid_time(next - k, rate)));
        let comes = |s: Supply| {
            matches!(
                s,
                Supply::Present | Supply::Interpolated | Supply::Extrapolated
            )
        };
        if !last.iter().all(|a| comes(a.supply)) {
            return StreamSeam::Nowhere;
        }
        let last = last.map(|a| a.target.posture);
        // How far the next sample of the grid is ahead of the time that is due.
        let ahead = grid_time(next, rate) - (head + self.tick);
        let stride = 1.0 / (rate * MOMENTS as f64);
        let room = (self.time_of(newest) - p - ahead).max(0.0);
        let first = ((3.0 / rate - p.0 - ahead).max(-MOST_OLDER) / stride).ceil() as i64;
        // A driver may announce times far ahead; no more of them are searched than of those behind.
        let ahead_of_delay = (MOST_NEWER * room).min(MOST_OLDER);
        let end = (ahead_of_delay / stride).floor() as i64;
        let waits = p.0 < PATIENCE;
        let otherwise = if waits {
            StreamSeam::Later
        } else {
            StreamSeam::Nowhere
        };
        let at = |k: i64| self.at(p + ahead + k as f64 * stride).target.posture;
        let postures: Vec<Posture> = (first - 3 * MOMENTS..=end - MOMENTS).map(at).collect();
        let hip = self.stand.root_position.z;
        let like = |k: i64| {
            let around = [0, 1, 2].map(|n| postures[(k - first + n * MOMENTS) as usize]);
            let seam = likeness::Seam::new(&last, &around, hip, k as f64 * stride);
            (seam.cost, seam.fits)
        };
        let costs: Vec<(f64, bool)> = (first..=end).map(like).collect();
        let best = (0..costs.len()).min_by(|a, b| costs[*a].0.total_cmp(&costs[*b].0));
        let Some(i) = best.filter(|i| costs[*i].1) else {
            return otherwise;
        };
        // The best match is at an end of the range, so a better one may still come.
        let between = match (
            i.checked_sub(1).and_then(|b| costs.get(b)),
            costs.get(i + 1),
        ) {
            (Some((before, _)), Some((after, _))) => {
                let bend = before - 2.0 * costs[i].0 + after;
                if bend > 0.0 {
                    0.5 * (before - after) / bend
                } else {
                    0.0
                }
            }
            _ if waits => return StreamSeam::Later,
            _ => 0.0,
        };
        let later = ((first + i as i64) as f64 + between) * stride;
        let due = p + later;
        // From here on both grids have the same phase.
        let samples = ((due - head - self.tick) * rate).round();
        let named = head + self.tick + samples / rate;
        StreamSeam::Here(StreamStart {
            later,
            head: named - self.tick,
            next: next + samples as i64,
            renamed: named - due,
        })
    }

    /// Continues from another stream at a seam of this tick.
    pub fn enter(&mut self, entry: StreamStart) {
        self.pace.shift(entry.later, entry.renamed, &self.settings);
        self.grid.head = Some(entry.head);
        self.grid.next = entry.next;
        self.grid.joins = false;
    }
}

#[cfg(test)]
mod tests {
    use super::super::{BufferedFrame, DueSample, GridEnd, Now};
    use super::*;
    use crate::ingest::time::{ScheduledTime, SourceTime};
    use sinew_physics::body::Body;
    use sinew_physics::motion::Target;
    use sinew_physics::time::WorldTime;
    use sinew_wire::types::{Delay, DriveSettings};
    use std::cell::Cell;
    use std::sync::Arc;
    use std::time::Instant;

    const RATE: f64 = 60.0;
    /// Ticks that are no multiple of samples.
    const TICK: f64 = 1.0 / 75.0;

    /// A figure whose knees and hips swing while it moves on, at time `t` (s) of its motion.
    fn motion(t: f64) -> Posture {
        let mut p = Posture::default();
        p.root_position.x = 1.2 * t;
        p.root_position.z = 0.9;
        for (k, angle) in p.hinge.iter_mut().enumerate() {
            *angle = 1.0 + 0.9 * (8.0 * t + k as f64).sin();
        }
        p
    }

    fn buffer(delay: Delay) -> JitterBuffer {
        let settings = DriveSettings {
            rate_hz: RATE,
            delay,
            extrapolation: 0.1,
            hold: 0.5,
            grace: 5.0,
            reset: false,
            window: Some(0.5),
        };
        let stand = motion(0.0);
        let body = Arc::new(Body::adult_man());
        JitterBuffer::new(settings, TICK, body, Target::still(stand), stand)
    }

    /// World time `time` (s) of a world that keeps up.
    fn at(time: f64) -> Now {
        Now {
            time: WorldTime(time),
            lost: 0.0,
        }
    }

    /// A driver with its own clock that began to send at `began` (s) and is `ahead` (s) in the motion.
    struct SeamDriver {
        buffer: JitterBuffer,
        began: f64,
        ahead: f64,
        motion: fn(f64) -> Posture,
        sent: i64,
    }

    impl SeamDriver {
        fn send(&mut self, now: f64) {
            while self.began + self.sent as f64 / RATE <= now {
                let t = self.began + self.sent as f64 / RATE;
                let frame = BufferedFrame {
                    sequence: self.sent,
                    source: SourceTime((t * 1e9) as i64 + 77_000_000_123),
                    posture: (self.motion)(t + self.ahead),
                    velocity: None,
                    planted: None,
                    guess: Cell::new(Some([true; 2])),
                    arrival: Instant::now(),
                };
                self.buffer.push(frame, ScheduledTime(t));
                self.sent += 1;
            }
        }
    }

    /// The samples of a window: the time of the motion (s) of each, read from its pelvis, and how time runs there.
    #[derive(Default)]
    struct HeldSamples {
        samples: Vec<f64>,
        lead: Vec<f64>,
    }

    impl HeldSamples {
        fn feed(&mut self, buffer: &mut JitterBuffer, time: f64) {
            let now = at(time);
            let samples = &mut self.samples;
            let fed = buffer.feed(now, (RATE, 0.5), |due| {
                if let DueSample::Sample(p, _) | DueSample::Guess(p, _) = due {
                    samples.push(p.root_position.x / 1.2);
                }
            });
            if let Some(GridEnd { head, next }) = fed {
                let fed = self.samples.len() as f64 - next as f64;
                self.lead.push(head.0 + fed / RATE - time);
            }
        }
    }

    /// Hands over from one stream to the other. Returns when, s after the second one began, and the content of the
    /// window.
    fn go_over(ahead: f64, delay: Delay, other: fn(f64) -> Posture) -> (Option<f64>, HeldSamples) {
        let mut first = SeamDriver {
            buffer: buffer(delay),
            began: 0.0,
            ahead: 0.0,
            motion,
            sent: 0,
        };
        let mut second = SeamDriver {
            buffer: buffer(delay),
            began: 2.0071,
            ahead,
            motion: other,
            sent: 0,
        };
        let mut held = HeldSamples::default();
        let mut entered = None;
        for tick in 0..600 {
            let time = f64::from(tick) * TICK;
            first.send(time);
            second.send(time);
            let now = at(time);
            if entered.is_none()
                && let Some(p) = second.buffer.due(now)
                && let StreamSeam::Here(entry) = second.buffer.seam(p, &first.buffer, RATE)
            {
                second.buffer.enter(entry);
                entered = Some(time - second.began);
            }
            match entered {
                Some(_) => held.feed(&mut second.buffer, time),
                None => held.feed(&mut first.buffer, time),
            }
        }
        (entered, held)
    }

    #[test]
    fn one_stream_goes_on_where_the_other_is_left_whatever_their_phase() {
        for delay in [Delay::Fixed(0.08), Delay::Adaptive { most: 0.2 }] {
            let newest = if delay == Delay::Fixed(0.08) {
                -0.02
            } else {
                -0.001
            };
            for ahead in [0.0, 0.004, 0.05, 0.15, 0.7, newest] {
                let (entered, held) = go_over(ahead, delay, motion);
                let entered = entered.unwrap_or_else(|| panic!("{ahead} s ahead: never"));
                assert!(
                    entered < 0.1 + ahead.max(0.0) + 0.1,
                    "{ahead} s: {entered} s"
                );
                // The samples form a grid of the motion without a seam: the difference is made up for by two
                // hundredths.
                let steps = held.samples.windows(2).map(|w| (w[1] - w[0]) * RATE);
                for (k, step) in steps.enumerate() {
                    assert!(
                        (step - 1.0).abs() < 0.12,
                        "{ahead} s: step {k} of {step} samples"
                    );
                }
                // The time that the window tells its figure has no seam either.
                for w in held.lead.windows(2).skip(10) {
                    assert!(
                        (w[1] - w[0]).abs() < 0.11 * TICK,
                        "{ahead} s: {} s",
                        w[1] - w[0]
                    );
                }
            }
        }
    }

    #[test]
    fn what_is_nowhere_alike_is_not_gone_over_to() {
        let slow = |t: f64| Posture {
            root_position: motion(t).root_position,
            ..motion(0.2 * t)
        };
        let (entered, _) = go_over(0.0, Delay::Fixed(0.08), slow);
        assert_eq!(entered, None);
    }
}
