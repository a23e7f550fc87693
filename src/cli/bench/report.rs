//! The measurements, as text and as JSON.

use super::args::BenchArgs;
use super::load::Load;
use super::page::{MetricsPage, quantile};
use crate::number;
use hdrhistogram::Histogram;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::atomic::Ordering;

/// A distribution of delays, ms.
#[derive(Debug, Serialize)]
pub(super) struct Delays {
    count: u64,
    pub p50_ms: f64,
    pub p99_ms: f64,
    p999_ms: f64,
    /// For delays that the server counts in buckets: the bound of the largest.
    max_ms: f64,
}

/// The load that the server was given.
#[derive(Debug, Serialize)]
struct Setup {
    worlds: u32,
    figures_per_world: u32,
    viewers_per_world: u32,
    motion_rate_hz: f64,
    playout_ms: f64,
    calls_per_s: f64,
    changes_per_s: f64,
    seconds: f64,
}

/// Measurements of the server during the bench.
#[derive(Debug, Serialize)]
pub(super) struct Server {
    /// How long after its deadline a tick began.
    pub tick_lateness: Option<Delays>,
    /// Duration of a tick.
    tick: Option<Delays>,
    /// From the arrival of motion to its frame, within the server.
    input_to_frame: Option<Delays>,
    pub ticks: f64,
    pub ticks_skipped: f64,
    /// Frames dropped because viewers were too slow.
    frames_dropped: f64,
    budget_used: f64,
    budget_limit: f64,
    /// Processors in use.
    pub processors: f64,
    resident_bytes: f64,
    threads: f64,
}

/// Data written by a server with a data directory during the bench.
#[derive(Debug, Serialize)]
pub(super) struct DiskWrites {
    /// Data of worlds: states, inputs and hashes.
    pub bytes_per_s: f64,
    /// Including everything that the log and the file system add, in whole pages; only for a server of its own, on
    /// Linux.
    pub disk_bytes_per_s: Option<f64>,
    pub commits_per_s: f64,
    /// Duration of a commit.
    pub commit: Option<Delays>,
    /// Entries left out because the disk was too slow.
    pub lost_entries: f64,
}

/// Measurements of the clients.
#[derive(Debug, Serialize)]
pub(super) struct Clients {
    /// From the time motion was due to be sent until a viewer had the frame that shows it.
    pub input_to_frame: Option<Delays>,
    /// From the time motion was due to be sent until it was sent: how well these clients kept the schedule.
    sending: Option<Delays>,
    /// From the time a read was due until its answer.
    calls: Option<Delays>,
    /// From the time a change was due until its answer.
    pub changes: Option<Delays>,
    motion_frames: u64,
    /// Number of those, times figures and viewers, that no viewer had received a second after the end.
    not_shown: u64,
    frames: u64,
    /// Ticks that viewers were not sent.
    ticks_missed: u64,
    errors: BTreeMap<String, u64>,
}

/// The report of a bench.
#[derive(Debug, Serialize)]
pub(super) struct BenchReport {
    setup: Setup,
    pub server: Server,
    pub clients: Clients,
    pub disk: DiskWrites,
}

fn delays(h: &Histogram<u64>) -> Option<Delays> {
    let ms = |micros: u64| micros as f64 * 1e-3;
    (!h.is_empty()).then(|| Delays {
        count: h.len(),
        p50_ms: ms(h.value_at_quantile(0.5)),
        p99_ms: ms(h.value_at_quantile(0.99)),
        p999_ms: ms(h.value_at_quantile(0.999)),
        max_ms: ms(h.max()),
    })
}

fn counted(before: &MetricsPage, after: &MetricsPage, name: &str) -> Option<Delays> {
    let buckets = after.buckets(before, name);
    let at = |q| quantile(&buckets, q).map(|s| s * 1e3);
    Some(Delays {
        count: buckets.last()?.1 as u64,
        p50_ms: at(0.5)?,
        p99_ms: at(0.99)?,
        p999_ms: at(0.999)?,
        max_ms: at(1.0)?,
    })
}

impl BenchReport {
    /// Covers the time between two pages of the server; includes the bytes that it wrote to disk in that time.
    ///
    /// # Errors
    /// No tick was computed in that time.
    pub(super) fn new(
        args: &BenchArgs,
        load: &Load,
        [before, after]: [&MetricsPage; 2],
        disk_bytes: Option<f64>,
    ) -> anyhow::Result<Self> {
        let grown = |name: &str| after.growth(before, name);
        let measured = load.measured();
        let due = load.due.load(Ordering::Relaxed);
        let server = Server {
            tick_lateness: counted(before, after, "sinew_tick_lateness_seconds"),
            tick: counted(before, after, "sinew_tick_seconds"),
            input_to_frame: counted(before, after, "sinew_input_to_frame_seconds"),
            ticks: grown("sinew_ticks_total"),
            ticks_skipped: grown("sinew_ticks_skipped_total"),
            frames_dropped: grown("sinew_frames_dropped_total"),
            budget_used: after.get("sinew_budget_used_ratio"),
            budget_limit: after.get("sinew_budget_limit_ratio"),
            processors: grown("process_cpu_seconds_total") / args.seconds,
            resident_bytes: after.get("process_resident_memory_bytes"),
            threads: after.get("process_threads"),
        };
        anyhow::ensure!(server.ticks > 0.0, "the server computed no tick");
        let all = due * u64::from(args.figures) * u64::from(args.viewers);
        Ok(Self {
            setup: Setup {
                worlds: args.worlds,
                figures_per_world: args.figures,
                viewers_per_world: args.viewers,
                motion_rate_hz: args.traffic.rate,
                playout_ms: args.traffic.playout,
                calls_per_s: args.traffic.calls,
                changes_per_s: args.traffic.changes,
                seconds: args.seconds,
            },
            server,
            clients: Clients {
                input_to_frame: delays(&measured.shown),
                sending: delays(&measured.sent),
                calls: delays(&measured.calls),
                changes: delays(&measured.changes),
                motion_frames: due,
                not_shown: all.saturating_sub(measured.shown.len()),
                frames: load.frames.load(Ordering::Relaxed),
                ticks_missed: load.missed.load(Ordering::Relaxed),
                errors: measured.errors.clone(),
            },
            disk: DiskWrites {
                bytes_per_s: grown("sinew_store_written_bytes_total") / args.seconds,
                disk_bytes_per_s: disk_bytes.map(|b| b / args.seconds),
                commits_per_s: grown("sinew_store_commit_seconds_count") / args.seconds,
                commit: counted(before, after, "sinew_store_commit_seconds"),
                lost_entries: grown("sinew_store_lost_entries_total"),
            },
        })
    }

    /// The report as text.
    pub(super) fn text(&self) -> String {
        let (setup, server, clients) = (&self.setup, &self.server, &self.clients);
        let mut out = format!(
            "{} worlds × {} figures × {} viewers, {:.0} s\n\n{:34} {:>9} {:>9} {:>9} {:>9}\n",
            setup.worlds,
            setup.figures_per_world,
            setup.viewers_per_world,
            setup.seconds,
            "ms",
            "p50",
            "p99",
            "p99.9",
            "max"
        );
        for (name, delays) in [
            ("lateness of ticks (server)", &server.tick_lateness),
            ("time of ticks (server)", &server.tick),
            ("input to frame (server)", &server.input_to_frame),
            ("input to frame (viewer)", &clients.input_to_frame),
            ("  of that, sending late", &clients.sending),
            ("reads", &clients.calls),
            ("changes", &clients.changes),
        ] {
            if let Some(d) = delays {
                let row = [d.p50_ms, d.p99_ms, d.p999_ms, d.max_ms];
                let cells: String = row.iter().map(|v| format!(" {v:>9.3}")).collect();
                let _ = writeln!(out, "{name:34}{cells}");
            }
        }
        let percent = |part: f64| 100.0 * part;
        let _ = write!(
            out,
            "\nbudget {:.0} % of {:.0} %, {:.2} processors, {} threads, {:.0} MB\n\
             {:.0} ticks, {:.0} skipped; {} frames to viewers, {:.0} dropped, {} ticks missed; \
             {} of {} motions not shown\n",
            percent(server.budget_used),
            percent(server.budget_limit),
            server.processors,
            server.threads,
            server.resident_bytes * 1e-6,
            server.ticks,
            server.ticks_skipped,
            clients.frames,
            server.frames_dropped,
            clients.ticks_missed,
            clients.not_shown,
            clients.motion_frames
                * u64::from(setup.figures_per_world)
                * u64::from(setup.viewers_per_world),
        );
        if self.disk.commits_per_s > 0.0 {
            let _ = writeln!(
                out,
                "{:.3} MB/s stored in {:.0} commits/s, {:.0} entries lost",
                self.disk.bytes_per_s * 1e-6,
                self.disk.commits_per_s,
                self.disk.lost_entries,
            );
        }
        let errors: u64 = clients.errors.values().sum();
        let _ = write!(out, "{}", number::counted(errors, "error"));
        for (what, count) in &clients.errors {
            let _ = write!(out, "\n  {count} × {what}");
        }
        out
    }
}
