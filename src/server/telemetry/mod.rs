//! Logs, metrics, and the observation of every call.

pub(super) mod calls;
pub mod metrics;
#[cfg(feature = "otlp")]
pub mod traces;

pub use metrics::metrics;

use super::config::Config;
use sinew_wire::status::Fault;
use tracing_subscriber::EnvFilter;

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
