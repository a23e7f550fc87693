//! The durations of the stages of recent ticks.

use crate::telemetry::metrics::ticks;
use std::time::Duration;

/// Stages of a tick, in order.
pub const STAGES: [&str; 6] = ["late", "commands", "motion", "step", "publish", "total"];
/// Number of remembered ticks: ten seconds at 60 Hz.
const WINDOW: usize = 600;

/// Times of recent ticks.
#[derive(Clone, Debug)]
pub struct StageTimes {
    /// By tick, then by stage: values of one tick are adjacent, because they are written together.
    micros: Vec<[f32; STAGES.len()]>,
    next: usize,
}

impl Default for StageTimes {
    fn default() -> Self {
        Self {
            micros: Vec::with_capacity(WINDOW),
            next: 0,
        }
    }
}

/// Median, p99 and largest time of one stage, µs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Percentiles {
    /// Median.
    pub p50: f64,
    /// 99th percentile.
    pub p99: f64,
    /// Largest.
    pub max: f64,
}

/// Counts one tick in the metrics; `clocked`: its world runs against the clock.
pub fn count(stages: &[Duration; STAGES.len()], clocked: bool) {
    let meters = ticks();
    let [late, parts @ .., total] = stages;
    meters.total.record(*total);
    if clocked {
        meters.late.record(*late);
        for (meter, part) in meters.stages.iter().zip(parts) {
            meter.record(*part);
        }
    }
    #[cfg(feature = "otlp")]
    crate::telemetry::traces::tick(&STAGES[1..STAGES.len() - 1], parts);
}

/// Percentiles of some numbers; all zero if there are none.
pub fn percentiles(values: impl Iterator<Item = f32>) -> Percentiles {
    let mut sorted: Vec<f32> = values.collect();
    sorted.sort_unstable_by(f32::total_cmp);
    let at = |q: usize| {
        let rank = (sorted.len().saturating_sub(1)) * q / 100;
        sorted.get(rank).copied().map_or(0.0, f64::from)
    };
    Percentiles {
        p50: at(50),
        p99: at(99),
        max: at(100),
    }
}

impl StageTimes {
    /// Remembers one tick, forgetting the oldest.
    pub fn record(&mut self, stages: [Duration; STAGES.len()]) {
        let micros = stages.map(|stage| stage.as_secs_f32() * 1e6);
        if self.micros.len() < WINDOW {
            self.micros.push(micros);
        } else {
            self.micros[self.next] = micros;
        }
        self.next = (self.next + 1) % WINDOW;
    }

    /// Percentiles by stage.
    pub fn summary(&self) -> [Percentiles; STAGES.len()] {
        std::array::from_fn(|i| percentiles(self.micros.iter().map(|m| m[i])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_of_recent_ticks() {
        let mut times = StageTimes::default();
        for i in 0..2 * WINDOW as u64 {
            times.record([Duration::from_micros(i); STAGES.len()]);
        }
        let p = times.summary()[0];
        assert!(
            (p.p50 - 899.0).abs() < 1.0 && (p.max - 1199.0).abs() < 0.1,
            "{p:?}"
        );
    }
}
