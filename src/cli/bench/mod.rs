//! `sinew bench`: loads a server by a schedule and reports how late its ticks and frames are.
//!
//! The load is open: every message has a due time set in advance, and each delay is counted from that time, whether or
//! not the server kept up. If a server stalls for a second, every message due in that second is charged with the delay
//! (no coordinated omission).

mod args;
mod comparison;
mod load;
mod own;
mod page;
mod report;

pub use args::BenchArgs;

use super::interrupt::interrupted;
use super::page::progress;
use super::remote::explain;
use super::terminal::{note, print_line};
use anyhow::Context as _;
use args::{Storing, TAIL};
use comparison::BenchComparison;
use futures_util::FutureExt as _;
use futures_util::future::BoxFuture;
use load::{Load, Schedule};
use own::OwnServer;
use page::MetricsPage;
use report::BenchReport;
use sinew_client::Client;
use sinew_wire::pb;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Streams over one connection: below what servers and proxies allow.
const STREAMS_PER_CONNECTION: usize = 64;
/// Number of worlds created at the same time.
const AT_A_TIME: usize = 8;
/// Time for the server to update its counters.
const COUNTING: Duration = Duration::from_millis(500);

/// Ready when the bench should end early.
type Interrupt = BoxFuture<'static, ()>;

/// Loads the server, prints the measurements, and removes everything it made, also if it is interrupted.
///
/// # Errors
/// No server, a world that cannot be created, an empty measurement, or an interruption.
pub fn run(args: &BenchArgs) -> anyhow::Result<()> {
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .enable_all()
        .build()?;
    runtime.block_on(async {
        let mut interrupt = interrupted().boxed();
        // Polled once, so that it listens before there is anything to clean up.
        if (&mut interrupt).now_or_never().is_some() {
            anyhow::bail!("interrupted");
        }
        if args.own.compares() {
            let comparison = compare(args, &mut interrupt).await?;
            return if args.json {
                print_line(&serde_json::to_string_pretty(&comparison)?)
            } else {
                print_line(&comparison.text())
            };
        }
        let report = match &args.address {
            Some(address) => bench(args, address, None, &mut interrupt).await?,
            None => bench_own(args, None, &mut interrupt).await?,
        };
        if args.json {
            print_line(&serde_json::to_string_pretty(&report)?)
        } else {
            print_line(&report.text())
        }
    })
}

/// The same load on one server after the other, each of which stores in another way. Rounds are interleaved, so that
/// other activity of the machine affects all of them.
async fn compare(args: &BenchArgs, interrupt: &mut Interrupt) -> anyhow::Result<BenchComparison> {
    let mut comparison = BenchComparison::new(&args.own.durability);
    for round in 1..=args.own.rounds {
        for storing in &args.own.durability {
            note(&format!("round {round}: {}", storing.name()));
            let report = bench_own(args, Some(*storing), interrupt).await?;
            comparison.add(*storing, report);
        }
    }
    Ok(comparison)
}

/// Loads a server of its own, which ends with the bench.
async fn bench_own(
    args: &BenchArgs,
    storing: Option<Storing>,
    interrupt: &mut Interrupt,
) -> anyhow::Result<BenchReport> {
    let own = OwnServer::start(args, storing)?;
    bench(args, own.address(), Some(&own), interrupt).await
}

async fn bench(
    args: &BenchArgs,
    address: &str,
    own: Option<&OwnServer>,
    interrupt: &mut Interrupt,
) -> anyhow::Result<BenchReport> {
    let streams = args.worlds as usize * (args.viewers as usize + usize::from(args.figures > 0));
    let names: Vec<String> = (0..args.worlds)
        .map(|i| format!("bench-{}-{i}", std::process::id()))
        .collect();
    let mut clients = Vec::new();
    let work = async {
        for _ in 0..streams.div_ceil(STREAMS_PER_CONNECTION).max(1) {
            clients.push(args.credentials.connect(address).await?);
        }
        create(args, &clients[0], &names).await?;
        measure(args, &clients, &names, own).await
    };
    let measured = tokio::select! {
        () = interrupt => Err(anyhow::anyhow!("interrupted")),
        measured = work => measured,
    };
    if let (Some(_), Some(client)) = (&args.address, clients.first()) {
        tokio::select! {
            // A second interruption ends the wait for a server that does not answer.
            () = interrupted() => {}
            () = delete(client, &names) => {}
        }
    }
    measured
}

/// Creates worlds and figures.
async fn create(args: &BenchArgs, client: &Client, names: &[String]) -> anyhow::Result<()> {
    let bar = progress("worlds", names.len() as u64);
    for some in names.chunks(AT_A_TIME) {
        let bar = &bar;
        let made = some.iter().map(|id| async move {
            let request = pb::CreateWorldRequest {
                world_id: id.clone(),
                ..Default::default()
            };
            client.worlds().create_world(request).await?;
            for i in 0..args.figures {
                let request = pb::CreateFigureRequest {
                    parent: format!("worlds/{id}"),
                    figure_id: load::figure(i),
                    ..Default::default()
                };
                client.figures().create_figure(request).await?;
            }
            bar.inc(1);
            Ok::<_, tonic::Status>(())
        });
        for made in futures_util::future::join_all(made).await {
            made.map_err(|e| explain(&e))
                .with_context(|| format!("making {} worlds", names.len()))?;
        }
    }
    bar.finish_and_clear();
    Ok(())
}

/// Deletes the worlds again.
async fn delete(client: &Client, names: &[String]) {
    for some in names.chunks(AT_A_TIME) {
        let gone = some.iter().map(|id| async move {
            let name = format!("worlds/{id}");
            client
                .worlds()
                .delete_world(pb::DeleteWorldRequest {
                    name,
                    ..Default::default()
                })
                .await
        });
        // Worlds that were never created are simply not there.
        futures_util::future::join_all(gone).await;
    }
}

async fn measure(
    args: &BenchArgs,
    clients: &[Client],
    names: &[String],
    own: Option<&OwnServer>,
) -> anyhow::Result<BenchReport> {
    let load = Arc::new(Load::new(Schedule {
        warm_up: Duration::from_secs_f64(args.warm_up),
        length: Duration::from_secs_f64(args.seconds),
    })?);
    let page = async || MetricsPage::read(&clients[0]).await;
    let disk = || own.and_then(OwnServer::disk_bytes);
    page().await?; // a server without metrics is reported at once
    let work = load::start(&load, args, clients, names).await?;
    let window = load.window();
    tokio::time::sleep_until(window.start.into()).await;
    let (before, disk_before) = (page().await?, disk());
    let bar = progress("measuring", args.seconds.ceil() as u64);
    while !bar.is_finished() {
        let left = window.end.saturating_duration_since(Instant::now());
        tokio::time::sleep(left.min(Duration::from_secs(1))).await;
        bar.inc(1);
        if left.is_zero() {
            bar.finish_and_clear();
        }
    }
    tokio::time::sleep(COUNTING).await;
    let (after, disk_after) = (page().await?, disk());
    tokio::time::sleep(TAIL.saturating_sub(COUNTING)).await;
    load.stop();
    for task in work {
        if let Err(e) = task.await {
            note(&format!("warning: a part of the load ended: {e}"));
        }
    }
    let disk = disk_before.zip(disk_after).map(|(a, b)| b - a);
    BenchReport::new(args, &load, [&before, &after], disk)
}
