//! The metrics of the server: one table of names, kinds and meanings, which `/metrics` exports and the manual lists.
//!
//! Buckets are fixed and labels are enumerations, so the export of a process does not grow with its requests. Every
//! series known in advance is exported from the start, as zero: a rate over a counter that appears with its first event
//! misses that event.

use metrics::{Histogram, Unit};
use metrics_exporter_prometheus::{Matcher, PrometheusBuilder, PrometheusHandle};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// Interval at which times are counted into buckets; until then each takes 16 bytes. A world without figures that is
/// stepped by hand does a million and a half ticks a second, with one time each: 6 MB within this interval. Times of
/// stages are kept only for worlds that run against the clock, which cannot be that fast.
const UPKEEP_EVERY: Duration = Duration::from_millis(250);

/// From an empty world to a tick that is far too late, s.
const TICK_BUCKETS_S: &[f64] = &[
    0.000_01, 0.000_1, 0.000_5, 0.001, 0.002, 0.004, 0.008, 0.016, 0.033, 0.066, 0.25, 1.0,
];
/// From one command to a tick that is far too late, s.
const STAGE_BUCKETS_S: &[f64] = &[
    0.000_001, 0.000_003, 0.000_01, 0.000_03, 0.000_1, 0.000_3, 0.001, 0.003, 0.01, 0.03, 0.1, 1.0,
];
/// Finest around a millisecond, which is the goal, s.
const LATENESS_BUCKETS_S: &[f64] = &[
    0.000_01, 0.000_02, 0.000_05, 0.000_07, 0.000_1, 0.000_15, 0.000_2, 0.000_3, 0.000_4, 0.000_5,
    0.000_7, 0.000_85, 0.001, 0.001_25, 0.001_5, 0.002, 0.003, 0.004, 0.005, 0.007, 0.01, 0.015,
    0.025, 0.05, 0.1, 0.25, 1.0,
];
/// From a tenth of a tick to a stream played with a long delay, s.
const INPUT_BUCKETS_S: &[f64] = &[
    0.001, 0.002, 0.004, 0.006, 0.008, 0.01, 0.013, 0.017, 0.02, 0.025, 0.033, 0.05, 0.075, 0.1,
    0.15, 0.2, 0.3, 0.5, 0.75, 1.0, 2.0, 5.0,
];
/// From a fast disk to one that holds the server up, s.
const STORE_BUCKETS_S: &[f64] = &[
    0.000_5, 0.001, 0.002, 0.004, 0.008, 0.016, 0.033, 0.066, 0.25, 1.0, 5.0,
];
/// From one figure to a full world, s.
const CHECKPOINT_BUCKETS_S: &[f64] = &[
    0.000_02, 0.000_05, 0.000_1, 0.000_2, 0.000_5, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.5,
    2.0,
];
/// From a read of the latest frame to a stream that was open all day, s.
const CALL_BUCKETS_S: &[f64] = &[
    0.000_1, 0.000_2, 0.000_5, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.25, 1.0, 5.0, 30.0,
    300.0,
];

/// Kind of a metric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MetricKind {
    /// It only grows.
    Counter,
    /// A present value.
    Gauge,
    /// Times, with the upper bounds of their buckets, s.
    Histogram(&'static [f64]),
}

impl MetricKind {
    /// Its name in Prometheus.
    pub fn name(self) -> &'static str {
        match self {
            Self::Counter => "counter",
            Self::Gauge => "gauge",
            Self::Histogram(_) => "histogram",
        }
    }
}

/// One metric.
#[derive(Clone, Copy, Debug)]
pub struct MetricInfo {
    /// Its name.
    pub name: &'static str,
    /// Its kind.
    pub kind: MetricKind,
    /// Its label and the label's values; without values, series appear as needed, each from an enumeration.
    pub label: Option<(&'static str, &'static [&'static str])>,
    /// Text of the manual, and of the page itself.
    pub help: &'static str,
}

const fn metric(name: &'static str, kind: MetricKind, help: &'static str) -> MetricInfo {
    MetricInfo {
        name,
        kind,
        label: None,
        help,
    }
}

const fn by(
    label: &'static str,
    values: &'static [&'static str],
    metric: MetricInfo,
) -> MetricInfo {
    MetricInfo {
        label: Some((label, values)),
        ..metric
    }
}

use MetricKind::{Counter, Gauge, Histogram as Times};

/// All metrics except those of the process (`process_…`).
pub const METRICS: &[MetricInfo] = &[
    metric("sinew_ticks_total", Counter, "ticks computed by all worlds"),
    metric(
        "sinew_tick_seconds",
        Times(TICK_BUCKETS_S),
        "time of one tick",
    ),
    metric(
        "sinew_tick_lateness_seconds",
        Times(LATENESS_BUCKETS_S),
        "how long after its deadline a tick began, in worlds that run against the clock",
    ),
    by(
        "stage",
        &["commands", "motion", "step", "publish"],
        metric(
            "sinew_tick_stage_seconds",
            Times(STAGE_BUCKETS_S),
            "time of one stage of a tick, in worlds that run against the clock",
        ),
    ),
    metric(
        "sinew_ticks_overrun_total",
        Counter,
        "ticks that were not done by the next deadline",
    ),
    metric(
        "sinew_ticks_skipped_total",
        Counter,
        "deadlines that were left out",
    ),
    metric(
        "sinew_input_to_frame_seconds",
        Times(INPUT_BUCKETS_S),
        "from the arrival of desired motion to the frame that shows it; contains the playout delay and the window of \
         its driver",
    ),
    by(
        "reason",
        &["stale", "overflow", "late"],
        metric(
            "sinew_motion_frames_dropped_total",
            Counter,
            "frames of desired motion that were not used as sent: `stale` (not newer than what was there), `overflow` \
             (no room), `late` (kept, but due before they came)",
        ),
    ),
    metric(
        "sinew_budget_used_ratio",
        Gauge,
        "share of the processors that ticks of running worlds need",
    ),
    metric(
        "sinew_budget_limit_ratio",
        Gauge,
        "share of the processors that they may need (`max_tick_budget`)",
    ),
    metric("sinew_worlds", Gauge, "worlds"),
    metric("sinew_clips", Gauge, "stored clips"),
    metric("sinew_viewers", Gauge, "open streams of frames and events"),
    metric("sinew_drivers", Gauge, "open streams of desired motion"),
    metric(
        "sinew_checkpoints",
        Gauge,
        "checkpoints that are kept in memory",
    ),
    metric("sinew_checkpoint_bytes", Gauge, "bytes of them"),
    by(
        "operation",
        &["capture", "encode", "decode"],
        metric(
            "sinew_checkpoint_seconds",
            Times(CHECKPOINT_BUCKETS_S),
            "time of a checkpoint: taking the state of a world within a tick, making bytes of it, making a world of \
             them",
        ),
    ),
    metric(
        "sinew_plans_late_total",
        Counter,
        "stops and transitions that were not planned in time: the figure goes on with what it does and switches later",
    ),
    metric(
        "sinew_slow_ticks_total",
        Counter,
        "ticks that took longer than `slow_tick_s`",
    ),
    metric(
        "sinew_stuck_worlds",
        Gauge,
        "worlds whose ticks do not end: should stay 0",
    ),
    metric(
        "sinew_worlds_stolen_total",
        Counter,
        "times that a worker ran the world of another one, which was busy",
    ),
    metric(
        "sinew_worlds_failed_total",
        Counter,
        "worlds whose step ended abnormally: should stay 0",
    ),
    metric("sinew_frames_sent_total", Counter, "frames sent to viewers"),
    metric(
        "sinew_frames_dropped_total",
        Counter,
        "frames that viewers were too slow for",
    ),
    metric(
        "sinew_events_missed_total",
        Counter,
        "event messages that viewers were too slow for",
    ),
    metric(
        "sinew_commands_refused_total",
        Counter,
        "requests that found a world's queue full",
    ),
    metric(
        "sinew_commands_deferred_total",
        Counter,
        "times that a request waited one more tick because its tick had no time for it",
    ),
    by(
        "method",
        &[],
        metric(
            "sinew_call_seconds",
            Times(CALL_BUCKETS_S),
            "time of one call, from its arrival to the end of its answer; streams count when they end",
        ),
    ),
    by(
        "code",
        &[],
        metric(
            "sinew_calls_total",
            Counter,
            "calls that ended, by gRPC code",
        ),
    ),
    by(
        "reason",
        &[],
        metric("sinew_faults_total", Counter, "requests refused, by reason"),
    ),
    metric("sinew_connections", Gauge, "open connections"),
    metric("sinew_connections_total", Counter, "connections accepted"),
    by(
        "reason",
        &["silent", "room", "unread", "reset", "tls", "age"],
        metric(
            "sinew_connections_closed_total",
            Counter,
            "connections that ended other than by their clients' wish: `silent` (no request in time), `room` (evicted \
             for another one), `unread` (the client did not read), `reset` (by the client), `tls` (no TLS was agreed \
             on), `age` (it did not close when it was asked to)",
        ),
    ),
    by(
        "result",
        &["ok", "failed"],
        metric(
            "sinew_key_fetches_total",
            Counter,
            "times that the keys of tokens were fetched: `ok`, `failed` (those from before stay)",
        ),
    ),
    metric(
        "sinew_store_commit_seconds",
        Times(STORE_BUCKETS_S),
        "time in which one group of worlds was written to disk",
    ),
    metric(
        "sinew_store_upkeep_seconds",
        Times(STORE_BUCKETS_S),
        "time in which old history was cut off",
    ),
    metric(
        "sinew_store_written_bytes_total",
        Counter,
        "bytes of worlds written to disk",
    ),
    metric(
        "sinew_store_lost_entries_total",
        Counter,
        "states, inputs and hashes that were not written to disk",
    ),
    metric(
        "sinew_store_queue_bytes",
        Gauge,
        "bytes that wait for the disk",
    ),
    metric(
        "sinew_store_history_bytes",
        Gauge,
        "bytes of history of all worlds on disk",
    ),
    metric(
        "sinew_store_degraded",
        Gauge,
        "1: less is written to disk than was promised",
    ),
    metric(
        "sinew_runtime_tasks",
        Gauge,
        "tasks of the network side that are not done",
    ),
];

/// Metrics of this process; the recorder is installed by the first call.
pub fn metrics() -> Option<PrometheusHandle> {
    static HANDLE: OnceLock<Option<PrometheusHandle>> = OnceLock::new();
    HANDLE
        .get_or_init(|| {
            let mut builder = PrometheusBuilder::new();
            for m in METRICS {
                if let Times(buckets) = m.kind {
                    let name = Matcher::Full(m.name.to_owned());
                    builder = builder.set_buckets_for_metric(name, buckets).ok()?;
                }
            }
            let handle = builder.install_recorder().ok()?;
            METRICS.iter().for_each(begin);
            metrics_process::Collector::default().describe();
            // Recorded times are kept until they are counted into the buckets.
            let counted = handle.clone();
            let counting = move || {
                loop {
                    std::thread::park_timeout(UPKEEP_EVERY);
                    counted.run_upkeep();
                }
            };
            let thread = std::thread::Builder::new().name("metrics".to_owned());
            thread.spawn(counting).ok()?;
            Some(handle)
        })
        .clone()
}

/// Describes a metric and creates its series, if their labels are known in advance.
fn begin(m: &MetricInfo) {
    use metrics::{describe_counter, describe_gauge, describe_histogram};
    let start = |labels: Vec<metrics::Label>| match m.kind {
        Counter => metrics::counter!(m.name, labels).increment(0),
        Gauge => metrics::gauge!(m.name, labels).set(0.0),
        Times(_) => drop(metrics::histogram!(m.name, labels)),
    };
    match m.kind {
        Counter => describe_counter!(m.name, m.help),
        Gauge => describe_gauge!(m.name, m.help),
        Times(_) => describe_histogram!(m.name, Unit::Seconds, m.help),
    }
    match m.label {
        None => start(Vec::new()),
        Some((label, values)) => {
            for value in values {
                start(vec![metrics::Label::from_static_parts(label, value)]);
            }
        }
    }
}

/// The text of the page; `None`: another recorder was installed by the program that embeds this one.
///
/// Values not counted at their source are read now: the process, and the tasks of the calling runtime.
pub(crate) fn render() -> Option<String> {
    let handle = metrics()?;
    metrics_process::Collector::default().collect();
    if let Ok(runtime) = tokio::runtime::Handle::try_current() {
        let tasks = runtime.metrics().num_alive_tasks();
        metrics::gauge!("sinew_runtime_tasks").set(tasks as f64);
    }
    Some(handle.render())
}

/// Counters of ticks and their times, so that a tick looks nothing up.
pub(crate) struct TickMeters {
    /// A whole tick.
    pub total: Histogram,
    /// Lateness of its start.
    pub late: Histogram,
    /// Its stages: commands, motion, step, publish.
    pub stages: [Histogram; 4],
    /// From the arrival of desired motion to its frame.
    pub input_to_frame: Histogram,
    /// Ticks.
    pub ticks: metrics::Counter,
    /// Ticks that were not done by the next deadline.
    pub overrun: metrics::Counter,
    /// Skipped deadlines.
    pub skipped: metrics::Counter,
    /// Commands that a tick had no time for.
    pub deferred: metrics::Counter,
}

/// The meters of ticks.
pub(crate) fn ticks() -> &'static TickMeters {
    static METERS: OnceLock<TickMeters> = OnceLock::new();
    METERS.get_or_init(|| {
        metrics(); // before: handles of no recorder count nothing
        let stage =
            |name: &'static str| metrics::histogram!("sinew_tick_stage_seconds", "stage" => name);
        TickMeters {
            total: metrics::histogram!("sinew_tick_seconds"),
            late: metrics::histogram!("sinew_tick_lateness_seconds"),
            stages: ["commands", "motion", "step", "publish"].map(stage),
            input_to_frame: metrics::histogram!("sinew_input_to_frame_seconds"),
            ticks: metrics::counter!("sinew_ticks_total"),
            overrun: metrics::counter!("sinew_ticks_overrun_total"),
            skipped: metrics::counter!("sinew_ticks_skipped_total"),
            deferred: metrics::counter!("sinew_commands_deferred_total"),
        }
    })
}

/// Counter of sent frames, so that nothing is looked up for each.
pub(crate) fn frames_sent() -> &'static metrics::Counter {
    static SENT: OnceLock<metrics::Counter> = OnceLock::new();
    SENT.get_or_init(|| {
        metrics(); // before: handles of no recorder count nothing
        metrics::counter!("sinew_frames_sent_total")
    })
}

/// Measures the duration of an operation on a checkpoint, until this is dropped.
pub(crate) struct CheckpointTimer(&'static str, Instant);

impl CheckpointTimer {
    /// Begins one of the operations of `sinew_checkpoint_seconds`.
    pub(crate) fn new(operation: &'static str) -> Self {
        Self(operation, Instant::now())
    }
}

impl Drop for CheckpointTimer {
    fn drop(&mut self) {
        metrics::histogram!("sinew_checkpoint_seconds", "operation" => self.0)
            .record(self.1.elapsed());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rows of the manual, in this order and these words.
    #[test]
    fn the_manual_lists_every_metric_with_its_words() {
        let path =
            std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/operations.md");
        let page = std::fs::read_to_string(&path).unwrap();
        let rows: Vec<String> = METRICS
            .iter()
            .map(|m| {
                let label = m.label.map_or(String::new(), |(l, _)| format!("{{{l}}}"));
                format!("| `{}{label}` | {} | {} |", m.name, m.kind.name(), m.help)
            })
            .collect();
        let there: Vec<&str> = page
            .lines()
            .filter(|l| l.starts_with("| `sinew_"))
            .collect();
        if std::env::var_os("SINEW_REWRITE").is_some() && !there.is_empty() {
            let (first, last) = (there[0], there[there.len() - 1]);
            let at = page.find(first).unwrap();
            let end = page.find(last).unwrap() + last.len();
            let new = format!("{}{}{}", &page[..at], rows.join("\n"), &page[end..]);
            std::fs::write(&path, new).unwrap();
            return;
        }
        assert_eq!(there, rows, "SINEW_REWRITE=1 writes the table");
    }

    #[test]
    fn buckets_grow() {
        for m in METRICS {
            if let Times(buckets) = m.kind {
                assert!(buckets.is_sorted_by(|a, b| a < b), "{}", m.name);
            }
        }
    }
}
