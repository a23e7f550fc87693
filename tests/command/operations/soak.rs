//! Goal: a server used for hours holds no more resources than one used for a minute. Method: the real server with a
//! data directory; clients create worlds, drive, watch, perturb, upload, checkpoint, restore and delete endlessly, each
//! over its own connections. Memory, descriptors, threads and tasks are sampled repeatedly; their trend (the median
//! slope of all pairs, Theil–Sen) must be flat. When all clients have gone, nothing is left.
//!
//! `SINEW_SOAK_SECONDS` sets the duration; `tests/soak.sh` runs half an hour and prints the table.

use crate::operations::support::{Page, Server, Temporary, arm_frame};
use sinew_client::Client;
use sinew_wire::pb;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};
use tonic::{Code, Status};

/// Clients at a time.
const CLIENTS: u64 = 6;
/// Interval of samples, s.
const EVERY: f64 = 2.0;
/// Part of the time that is left out of the trend, while caches fill and history grows to its limit.
const WARM_UP: f64 = 0.25;
/// Shortest run in which trends are judged, s: in a shorter one, a single world is a trend.
const JUDGED: f64 = 600.0;

/// Sampled quantities, each with the largest growth of its trend over the measured time: a share of its mean, and a
/// minimum.
const LOOKED_AT: [(&str, f64, f64); 6] = [
    ("process_resident_memory_bytes", 0.05, 4e6),
    ("process_open_fds", 0.05, 3.0),
    ("process_threads", 0.05, 2.0),
    ("sinew_runtime_tasks", 0.05, 10.0),
    ("sinew_connections", 0.05, 1.0),
    ("sinew_store_history_bytes", 0.10, 4e6),
];

/// One round of all actions of a client.
async fn round(address: &str, id: &str) -> Result<(), Status> {
    let client = Client::connect(address)
        .await
        .map_err(|e| Status::unavailable(e.to_string()))?;
    let world = client.world(&format!("worlds/{id}")).await?.name;
    for figure in ["a", "b"] {
        let request = pb::CreateFigureRequest {
            parent: world.clone(),
            figure_id: figure.into(),
            ..Default::default()
        };
        client.figures().create_figure(request).await?;
    }
    let play = pb::PlayClipRequest {
        figure: format!("{world}/figures/b"),
        clip: "clips/idle".into(),
        r#loop: true,
        ..Default::default()
    };
    client.motions().play_clip(play).await?;
    let mut frames = client.watch(&world, pb::View::default(), None).await?;
    let events = pb::WatchEventsRequest {
        world: world.clone(),
        ..Default::default()
    };
    let events = client.states().watch_events(events).await?;
    let header = pb::DriveHeader {
        world: world.clone(),
        figure_ids: vec!["a".into()],
        driver_id: "soak".into(),
        ..Default::default()
    };
    let driver = client.drive(header).await?;
    let mut tick = tokio::time::interval(Duration::from_secs_f64(1.0 / 60.0));
    for i in 0..60 {
        tick.tick().await;
        driver.send(vec![arm_frame("a", i)]).await;
        frames.message().await?;
    }
    let push = pb::ApplyPerturbationsRequest {
        world: world.clone(),
        perturbations: vec![pb::Perturbation {
            figure_id: "b".into(),
            kind: Some(pb::perturbation::Kind::Force(pb::Force {
                segment: "chest".into(),
                force_newtons: Some(pb::Vector3 {
                    x: 50.0,
                    y: 0.0,
                    z: 0.0,
                }),
                duration_s: 0.1,
                ..Default::default()
            })),
            ..Default::default()
        }],
        ..Default::default()
    };
    client.perturbations().apply_perturbations(push).await?;
    let checkpoint = pb::CheckpointWorldRequest {
        name: world.clone(),
        ..Default::default()
    };
    let kept = client.checkpoints().checkpoint_world(checkpoint).await?;
    let kept = kept.into_inner().checkpoint.unwrap_or_default().name;
    driver.finish().await?;
    let restore = pb::RestoreWorldRequest {
        name: world.clone(),
        source: Some(pb::restore_world_request::Source::Checkpoint(kept.clone())),
        ..Default::default()
    };
    client.checkpoints().restore_world(restore).await?;
    let delete = pb::DeleteCheckpointRequest {
        name: kept,
        ..Default::default()
    };
    client.checkpoints().delete_checkpoint(delete).await?;

    let clip = pb::CreateClipRequest {
        clip_id: id.into(),
        source: Some(pb::create_clip_request::Source::Bvh(pb::BvhSource {
            data: include_bytes!("../../corpus/wave.vrm.bvh").to_vec().into(),
            ..Default::default()
        })),
        ..Default::default()
    };
    client.motions().create_clip(clip).await?;
    let delete = pb::DeleteClipRequest {
        name: format!("clips/{id}"),
        ..Default::default()
    };
    client.motions().delete_clip(delete).await?;
    // A request that fails, a stream that is left, and the end.
    let missing = pb::GetWorldRequest {
        name: "worlds/none".into(),
    };
    assert_eq!(
        client.worlds().get_world(missing).await.unwrap_err().code(),
        Code::NotFound
    );
    drop((frames, events));
    client
        .worlds()
        .delete_world(pb::DeleteWorldRequest {
            name: world,
            ..Default::default()
        })
        .await?;
    Ok(())
}

/// The median of the slopes of all pairs.
fn trend(points: &[(f64, f64)]) -> f64 {
    let mut slopes: Vec<f64> = points
        .iter()
        .enumerate()
        .flat_map(|(i, a)| {
            points[i + 1..]
                .iter()
                .map(move |b| (b.1 - a.1) / (b.0 - a.0))
        })
        .collect();
    slopes.sort_by(f64::total_cmp);
    slopes.get(slopes.len() / 2).copied().unwrap_or(0.0)
}

#[test]
fn a_trend_is_that_of_most_pairs() {
    let noisy = |slope: f64| -> Vec<(f64, f64)> {
        (0..100)
            .map(|i| {
                let outlier = if i % 10 == 9 { 500.0 } else { 0.0 };
                (
                    f64::from(i),
                    slope * f64::from(i) + outlier + f64::from(i * 7919 % 13),
                )
            })
            .collect()
    };
    assert!(trend(&noisy(0.0)).abs() < 0.02, "{}", trend(&noisy(0.0)));
    assert!((trend(&noisy(2.0)) - 2.0).abs() < 0.02);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_server_that_is_used_without_end_holds_no_more() {
    let seconds = std::env::var("SINEW_SOAK_SECONDS").map_or(12.0, |s| s.parse().unwrap());
    let dir = Temporary::new("soak");
    let settings = ["--data-dir", dir.path(), "--set", "max_client_share=1"];
    let server = Server::start(&settings);
    // Run once, so that everything created on first use exists.
    round(&server.address, "first").await.unwrap();
    tokio::time::sleep(Duration::from_secs(1)).await;
    let quiet = Page::of(&server).await;

    let (stop, rounds) = (
        Arc::new(AtomicBool::new(false)),
        Arc::new(AtomicU64::new(0)),
    );
    let clients: Vec<_> = (0..CLIENTS)
        .map(|c| {
            let (stop, rounds, address) = (stop.clone(), rounds.clone(), server.address.clone());
            tokio::spawn(async move {
                while !stop.load(Ordering::Relaxed) {
                    let n = rounds.fetch_add(1, Ordering::Relaxed);
                    round(&address, &format!("c{c}-{n}")).await.unwrap();
                }
            })
        })
        .collect();
    let begun = Instant::now();
    let mut samples: Vec<Vec<(f64, f64)>> = vec![Vec::new(); LOOKED_AT.len()];
    while begun.elapsed().as_secs_f64() < seconds {
        tokio::time::sleep(Duration::from_secs_f64(EVERY)).await;
        let page = Page::of(&server).await;
        for (series, (name, ..)) in samples.iter_mut().zip(LOOKED_AT) {
            series.push((begun.elapsed().as_secs_f64(), page.get(name)));
        }
        assert!(clients.iter().all(|c| !c.is_finished()), "a client ended");
    }
    stop.store(true, Ordering::Relaxed);
    for client in clients {
        client.await.unwrap();
    }
    let length = (1.0 - WARM_UP) * seconds;
    println!(
        "{} rounds by {CLIENTS} clients in {seconds:.0} s",
        rounds.load(Ordering::Relaxed)
    );
    println!(
        "| measured, mean | 1st quarter | 2nd | 3rd | 4th | trend over {length:.0} s | bound |"
    );
    println!("|---|---|---|---|---|---|---|");
    let mut leads_somewhere = Vec::new();
    for (series, (name, part, least)) in samples.iter().zip(LOOKED_AT) {
        let steady: Vec<_> = series
            .iter()
            .filter(|p| p.0 > WARM_UP * seconds)
            .copied()
            .collect();
        let values = || steady.iter().map(|p| p.1);
        let mean = values().sum::<f64>() / steady.len().max(1) as f64;
        let grown = trend(&steady) * length;
        let bound = (part * mean).max(least);
        // The four parts of that time distinguish a trend that ends from one that does not.
        let part = steady.len().div_ceil(4).max(1);
        let parts: String = steady
            .chunks(part)
            .map(|p| {
                format!(
                    " {:.0} |",
                    p.iter().map(|p| p.1).sum::<f64>() / p.len() as f64
                )
            })
            .collect();
        println!("| `{name}` |{parts} {grown:+.1} | {bound:.1} |");
        if grown > bound {
            leads_somewhere.push(name);
        }
    }
    if seconds >= JUDGED {
        assert!(leads_somewhere.is_empty(), "{leads_somewhere:?}");
    }

    // All clients have gone, so usage must be as before.
    let gone = async || {
        let page = Page::of(&server).await;
        let named = [
            "sinew_worlds",
            "sinew_viewers",
            "sinew_drivers",
            "sinew_checkpoints",
            "sinew_clips",
        ];
        let left = named.into_iter().filter(|n| page.get(n) != quiet.get(n));
        let more = [
            ("process_open_fds", 3.0),
            ("process_threads", 2.0),
            ("sinew_runtime_tasks", 4.0),
        ];
        let grown = more
            .into_iter()
            .filter(|(n, few)| page.get(n) > quiet.get(n) + few);
        left.chain(grown.map(|g| g.0))
            .map(|n| format!("{n}: {} → {}", quiet.get(n), page.get(n)))
            .collect::<Vec<_>>()
    };
    let until = Instant::now() + Duration::from_secs(10);
    loop {
        let left = gone().await;
        if left.is_empty() {
            break;
        }
        assert!(Instant::now() < until, "left behind: {left:?}");
        tokio::time::sleep(Duration::from_millis(250)).await;
    }
}
