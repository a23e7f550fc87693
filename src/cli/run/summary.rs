//! What is said on the terminal while clips run and when they are done.

use crate::evaluate::RunReport;
use indicatif::{ProgressBar, ProgressStyle};

/// Progress of one clip.
pub(super) fn progress_bar(name: &str, ticks: u64) -> ProgressBar {
    let style = ProgressStyle::with_template(
        "{prefix:>14} {wide_bar:.cyan/dim} {pos}/{len} ticks, {per_sec}, {eta} left",
    )
    .expect("the template is a constant")
    .progress_chars("━╸─");
    ProgressBar::new(ticks)
        .with_style(style)
        .with_prefix(name.to_owned())
}

/// Heads of the columns of [`summary_line`].
pub(super) fn summary_header() -> String {
    format!(
        "{:<14} {:>7} {:>8} {:>8} {:>8} {:>9} {:>7} {:>9} {:>8} {:>8}  result",
        "clip",
        "time s",
        "rms deg",
        "max deg",
        "root mm",
        "global mm",
        "use max",
        "margin m",
        "slip mm",
        "us/tick"
    )
}

/// The measures of one clip in a line.
pub(super) fn summary_line(name: &str, r: &RunReport) -> String {
    let mut result = match r.fell_at_s {
        Some(t) => format!("fell at {t:.2} s"),
        None => "stood".to_owned(),
    };
    if let Some(t) = r.quarantined_at_s {
        result += &format!(", frozen at {t:.2} s");
    }
    let margin = r
        .margin_min_m
        .map_or_else(|| "none".to_owned(), |m| format!("{m:.3}"));
    let longest = r.longest_saturated().map_or_else(String::new, |(d, s)| {
        format!(", {d} at its limit for {s:.2} s")
    });
    format!(
        "{name:<14} {:>7.2} {:>8.3} {:>8.2} {:>8.1} {:>9.1} {:>7.2} {margin:>9} {:>8.1} {:>8.0}  {result}{longest}",
        r.ticks as f64 / r.rate_hz,
        r.joint_rms_deg,
        r.joint_max_deg,
        r.mpjpe_root_mm,
        r.mpjpe_global_mm,
        r.max_utilisation,
        r.foot_slip_mm_per_s,
        r.us_per_tick_p50,
    )
}
