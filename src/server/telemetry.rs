//! Logs and metrics.

use super::config::Config;
use metrics_exporter_prometheus::{PrometheusBuilder, PrometheusHandle};
use std::sync::OnceLock;
use tracing_subscriber::EnvFilter;

/// Metrics of this process; the recorder is installed by the first call.
pub fn metrics() -> Option<PrometheusHandle> {
    static HANDLE: OnceLock<Option<PrometheusHandle>> = OnceLock::new();
    HANDLE
        .get_or_init(|| {
            let handle = PrometheusBuilder::new().install_recorder().ok()?;
            describe();
            Some(handle)
        })
        .clone()
}

fn describe() {
    use metrics::{Unit, describe_counter, describe_gauge, describe_histogram};
    describe_counter!("sinew_ticks_total", "Ticks computed by all worlds.");
    describe_histogram!("sinew_tick_seconds", Unit::Seconds, "Time of one tick.");
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
    describe_counter!("sinew_connections_total", "Connections accepted.");
    describe_counter!("sinew_faults_total", "Requests refused, by reason.");
}

/// The filter of the setting `log`.
///
/// # Errors
/// The filter is not understood.
pub fn log_filter(config: &Config) -> Result<EnvFilter, String> {
    EnvFilter::try_new(&config.log).map_err(|e| format!("log: {e} in {:?}", config.log))
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
