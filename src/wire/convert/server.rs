//! The server itself.

use super::super::pb;
use super::names::WORLD;

/// Limits for a response.
pub fn limits(list: &[(&str, i64)]) -> Vec<pb::ServerLimit> {
    list.iter()
        .map(|(name, value)| pb::ServerLimit {
            name: (*name).to_owned(),
            value: *value,
        })
        .collect()
}

/// The load of a world.
#[derive(Debug)]
pub struct Stats<'a> {
    /// Last part of its name.
    pub world: &'a str,
    /// Ticks, overruns, skipped deadlines.
    pub ticks: [u64; 3],
    /// Refused requests.
    pub refused: u64,
    /// Dropped frames.
    pub dropped: u64,
    /// Viewers.
    pub viewers: i64,
    /// p99 of a tick relative to its period.
    pub budget_used: f64,
    /// Stage, and p50, p99, max in µs.
    pub stages: Vec<(&'a str, [f64; 3])>,
}

/// The load of a world, for a response.
pub fn stats(s: &Stats<'_>) -> pb::WorldStats {
    pb::WorldStats {
        world: WORLD.name([s.world]),
        tick_count: s.ticks[0] as i64,
        overrun_count: s.ticks[1] as i64,
        skipped_count: s.ticks[2] as i64,
        refused_count: s.refused as i64,
        dropped_frame_count: s.dropped as i64,
        viewer_count: s.viewers as i32,
        budget_used: s.budget_used,
        stages: s
            .stages
            .iter()
            .map(|(stage, [p50, p99, max])| pb::StageTime {
                stage: (*stage).to_owned(),
                p50_us: *p50,
                p99_us: *p99,
                max_us: *max,
            })
            .collect(),
    }
}
