//! Output while clips run and when they are done.

use super::args::RunArgs;
use super::forecast;
use crate::number::{fixed, seconds};
use crate::terminal::{OutputClosed, print_line};
use anyhow::Result;
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use sinew_evaluate::RunReport;
use sinew_physics::forecast::Forecast;
use std::sync::atomic::{AtomicBool, Ordering};

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

/// The table that `sinew run` prints on standard output, with progress bars on standard error beside it.
pub(super) struct SummaryTable<'a> {
    bars: &'a MultiProgress,
    /// Width of the column of clip names, characters.
    width: usize,
    /// Whether nothing is printed: with `--json`, or after the reader has ended.
    silent: AtomicBool,
    /// Whether files or the exit code are wanted as well, so that a reader that ends does not end the run.
    more_than_print: bool,
}

impl<'a> SummaryTable<'a> {
    /// A table of clips with these names.
    pub(super) fn new<'n>(
        bars: &'a MultiProgress,
        args: &RunArgs,
        names: impl Iterator<Item = &'n str>,
    ) -> Self {
        let longest = names.map(|n| n.chars().count()).max().unwrap_or(0);
        Self {
            bars,
            width: longest.max(HEADING[1].0.len()),
            silent: args.json.into(),
            more_than_print: args.fail_on_fall
                || args.report.is_some()
                || args.out.is_some()
                || args.strip.is_some(),
        }
    }

    /// Adds a progress bar.
    pub(super) fn add(&self, bar: ProgressBar) -> ProgressBar {
        self.bars.add(bar)
    }

    /// The heading.
    pub(super) fn heading(&self) -> Result<()> {
        let [above, below] =
            HEADING.map(|(name, columns)| format!("{name:<0$} {columns}", self.width));
        self.print(&format!("{above}\n{below}"))
    }

    /// Prints the line of one clip and that of its forecast in one call, because other threads print, too.
    pub(super) fn rows(&self, name: &str, report: &RunReport, told: &Forecast) -> Result<()> {
        let (width, line, forecast) = (self.width, line(report), forecast::line(told));
        self.print(&format!("{name:<width$} {line}\n{forecast}"))
    }

    /// The meaning of the columns.
    pub(super) fn legend(&self) -> Result<()> {
        self.print(LEGEND)
    }

    /// Prints any text between the bars.
    fn print(&self, text: &str) -> Result<()> {
        if self.silent.load(Ordering::Relaxed) {
            return Ok(());
        }
        let done = self.bars.suspend(|| print_line(text));
        match done {
            Err(e) if self.more_than_print && e.is::<OutputClosed>() => {
                self.silent.store(true, Ordering::Relaxed);
                Ok(())
            }
            other => other,
        }
    }
}

/// Heads of the columns of [`line`].
const HEADING: [(&str, &str); 2] = [
    (
        "",
        "          joint error  tracking error  strength  balance   foot  computing",
    ),
    (
        "clip",
        " time s   rms°   max°  local  global    used %  margin  skate    µs/tick  result",
    ),
];

/// The meaning of the columns of [`line`].
const LEGEND: &str = "
joint error     target minus actual joint angle over all degrees of freedom: root mean square and maximum, degrees
tracking error  mean distance of the segment origins from those of the target, mm:
                local = relative to the pelvis, global = in the world.
                The target is moved along with the feet after each step.
                `sinew survey` measures errors against the fixed recording.
strength used   largest muscle torque relative to the available torque, %; 100 = at the limit
balance margin  least distance of the zero-moment point from the edge of the support polygon, cm; negative = outside
foot skate      mean horizontal speed of the loaded contact points of the feet, mm/s
computing       median time to compute one tick, µs";

/// The measures of one clip, without its name.
fn line(r: &RunReport) -> String {
    let mut result = match r.fell_at_s {
        Some(t) => format!("fell at {}", seconds(t)),
        None => "no fall".to_owned(),
    };
    if let Some(t) = r.quarantined_at_s {
        result += &format!(", state diverged at {}", seconds(t));
    }
    if let Some((dof, s)) = r.longest_saturated() {
        result += &format!(", {dof} at its torque limit for {}", seconds(s));
    }
    let margin = r
        .margin_min_m
        .map_or_else(|| "–".to_owned(), |m| fixed(100.0 * m, 1));
    format!(
        "{:>7.2} {:>6.2} {:>6.1} {:>6.1} {:>7.1} {:>9.0} {margin:>7} {:>6.1} {:>10.0}  {result}",
        r.ticks as f64 / r.rate_hz,
        r.tracking_joint_rms_deg,
        r.tracking_joint_max_deg,
        r.tracking_mpjpe_root_mm,
        r.tracking_mpjpe_global_mm,
        100.0 * r.max_utilisation,
        r.foot_slip_mm_per_s,
        r.us_per_tick_p50,
    )
}
