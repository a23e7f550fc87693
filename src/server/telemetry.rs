//! Logs and metrics.

use super::config::Config;
use crate::wire::status::Fault;
use metrics_exporter_prometheus::{Matcher, PrometheusBuilder, PrometheusHandle};
use std::sync::OnceLock;
use std::time::Duration;
use tracing_subscriber::EnvFilter;

/// Time of one tick.
const TICK_SECONDS: &str = "sinew_tick_seconds";
/// Upper bounds of the buckets that times of ticks are counted in, s: from an empty world to one that is far too late.
const TICK_BUCKETS_S: [f64; 12] = [
    0.000_01, 0.000_1, 0.000_5, 0.001, 0.002, 0.004, 0.008, 0.016, 0.033, 0.066, 0.25, 1.0,
];
/// Times of the disk: one group, one look at what can be cut off.
const STORE_SECONDS: &str = "sinew_store_";
/// Upper bounds of their buckets, s: from a fast disk to one that holds the server up.
const STORE_BUCKETS_S: [f64; 11] = [
    0.000_5, 0.001, 0.002, 0.004, 0.008, 0.016, 0.033, 0.066, 0.25, 1.0, 5.0,
];
/// Interval at which times are counted into buckets. An empty world that is stepped by hand does a million and a half
/// ticks a second, of 16 bytes each: 6 MB within this time.
const UPKEEP_EVERY: Duration = Duration::from_millis(250);

/// Metrics of this process; the recorder is installed by the first call.
pub fn metrics() -> Option<PrometheusHandle> {
    static HANDLE: OnceLock<Option<PrometheusHandle>> = OnceLock::new();
    HANDLE
        .get_or_init(|| {
            let handle = PrometheusBuilder::new()
                .set_buckets_for_metric(Matcher::Full(TICK_SECONDS.to_owned()), &TICK_BUCKETS_S)
                .and_then(|b| {
                    b.set_buckets_for_metric(
                        Matcher::Prefix(STORE_SECONDS.to_owned()),
                        &STORE_BUCKETS_S,
                    )
                })
                .and_then(PrometheusBuilder::install_recorder)
                .ok()?;
            describe();
            // What is recorded is kept until it is counted into the buckets.
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

fn describe() {
    use metrics::{Unit, describe_counter, describe_gauge, describe_histogram};
    describe_counter!("sinew_ticks_total", "Ticks computed by all worlds.");
    describe_histogram!(TICK_SECONDS, Unit::Seconds, "Time of one tick.");
    describe_gauge!("sinew_worlds", "Worlds.");
    describe_gauge!("sinew_clips", "Stored clips.");
    describe_gauge!("sinew_viewers", "Open streams of frames and events.");
    describe_gauge!("sinew_drivers", "Open streams of desired motion.");
    describe_counter!("sinew_worlds_failed_total", "Worlds that failed.");
    describe_counter!(
        "sinew_plans_late_total",
        "Plans that were not there in their tick."
    );
    describe_counter!("sinew_frames_sent_total", "Frames sent to viewers.");
    describe_counter!(
        "sinew_frames_dropped_total",
        "Frames that viewers were too slow for."
    );
    describe_counter!(
        "sinew_commands_refused_total",
        "Requests that found the queue of a world full."
    );
    describe_counter!(
        "sinew_commands_deferred_total",
        "Times that a request waited one more tick because its tick had no time for it."
    );
    describe_counter!(
        "sinew_slow_ticks_total",
        "Ticks that took longer than the setting slow_tick_s."
    );
    describe_gauge!("sinew_stuck_worlds", "Worlds whose ticks do not end.");
    describe_counter!(
        "sinew_worlds_stolen_total",
        "Times that a worker ran the world of another one, which was busy."
    );
    describe_counter!("sinew_connections_total", "Connections accepted.");
    describe_gauge!("sinew_connections", "Open connections.");
    describe_counter!(
        "sinew_connections_closed_total",
        "Connections that ended other than by their clients' wish, by reason."
    );
    describe_histogram!(
        "sinew_store_commit_seconds",
        Unit::Seconds,
        "Time in which one group of worlds was written to disk."
    );
    describe_histogram!(
        "sinew_store_checkpoint_seconds",
        Unit::Seconds,
        "Time in which the state of one world became bytes."
    );
    describe_histogram!(
        "sinew_store_upkeep_seconds",
        Unit::Seconds,
        "Time in which old history was cut off."
    );
    describe_counter!(
        "sinew_store_written_bytes_total",
        "Bytes of worlds written to disk."
    );
    describe_counter!(
        "sinew_store_lost_entries_total",
        "States, inputs and hashes that were not written to disk."
    );
    describe_gauge!("sinew_store_queue_bytes", "Bytes that wait for the disk.");
    describe_gauge!(
        "sinew_store_history_bytes",
        "Bytes of history of all worlds on disk."
    );
    describe_gauge!(
        "sinew_store_degraded",
        "1: less is written to disk than was promised."
    );
    describe_counter!("sinew_faults_total", "Requests refused, by reason.");
}

/// Counts a request that is refused, by reason, and logs it.
pub fn count_refusal(fault: &Fault) {
    metrics::counter!("sinew_faults_total", "reason" => fault.reason()).increment(1);
    if let Fault::Internal(why) = fault {
        tracing::error!(why, "request failed");
    } else {
        tracing::debug!(%fault, "request refused");
    }
}

/// The filter of the setting `log`.
///
/// # Errors
/// The filter is not understood.
pub fn log_filter(config: &Config) -> Result<EnvFilter, String> {
    let filter =
        EnvFilter::try_new(&config.log).map_err(|e| format!("log: {e} in {:?}", config.log))?;
    // The transport warns of each client that floods it; such connections are counted (`edge::connections`).
    let quiet = "h2=error".parse().expect("the directive is one");
    Ok(if config.log.contains("h2") {
        filter
    } else {
        filter.add_directive(quiet)
    })
}

/// Sends logs to standard error. Only the first call in a process has an effect.
///
/// `colour`: with ANSI escape codes, for a terminal. A standard error that cannot be written to loses messages; it
/// stops nothing.
pub fn init_logs(filter: EnvFilter, json: bool, colour: bool) {
    let logs = tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_ansi(colour)
        .log_internal_errors(false) // they would go to standard error, and panic when it is closed
        .with_writer(std::io::stderr);
    // Already installed: the caller of this library logs in its own way.
    let _ = if json {
        logs.json().try_init()
    } else {
        logs.try_init()
    };
}
