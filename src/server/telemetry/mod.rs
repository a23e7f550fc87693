//! Logs, metrics, and the observation of every call.

pub(super) mod calls;
pub mod metrics;
#[cfg(feature = "otlp")]
pub mod traces;

pub use metrics::metrics;

use super::config::Config;
use sinew_wire::status::Fault;
use tracing_subscriber::filter::{LevelFilter, Targets};
use tracing_subscriber::layer::SubscriberExt as _;
use tracing_subscriber::util::SubscriberInitExt as _;
use tracing_subscriber::{Layer, fmt};

/// Counts a request that is refused, by reason, and logs it.
pub fn count_refusal(fault: &Fault) {
    ::metrics::counter!("sinew_faults_total", "reason" => fault.reason()).increment(1);
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
pub fn log_filter(config: &Config) -> Result<Targets, String> {
    let filter: Targets = config
        .log
        .parse()
        .map_err(|e| format!("log: {e} in {:?}", config.log))?;
    Ok(if config.log.contains("h2") {
        filter
    } else {
        // The transport warns of each client that floods it; such connections are counted (`edge::connections`).
        filter.with_target("h2", LevelFilter::ERROR)
    })
}

/// Sends logs to standard error. Only the first call in a process has an effect.
///
/// `colour`: with ANSI escape codes, for a terminal. A standard error that cannot be written to loses messages; it
/// stops nothing.
pub fn init_logs(filter: Targets, json: bool, colour: bool) {
    let logs = fmt::layer()
        .with_ansi(colour)
        .log_internal_errors(false) // they would go to standard error, and panic when it is closed
        .with_writer(std::io::stderr);
    let logs = if json {
        logs.json().boxed()
    } else {
        logs.boxed()
    };
    // Already installed: the caller of this library logs in its own way.
    let _ = tracing_subscriber::registry()
        .with(logs.with_filter(filter))
        .try_init();
}
