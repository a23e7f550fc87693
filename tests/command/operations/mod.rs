//! The operator's view of a running server. Method: a real client uses the real binary briefly; its pages are compared
//! with the manual, and the files of `deploy/` with its pages.

mod load;
mod soak;
pub mod support;

use sinew_client::Client;
use sinew_wire::pb;
use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;
use support::{Page, Server, text};

/// Playout delay of the driver of these tests, s.
const DELAY: f64 = 0.05;

/// Makes at least one request of every counted kind.
async fn use_it(client: &Client) {
    let world = client
        .worlds()
        .create_world(pb::CreateWorldRequest {
            world_id: "w".into(),
            ..Default::default()
        })
        .await
        .unwrap()
        .into_inner()
        .world
        .unwrap()
        .name;
    client
        .figures()
        .create_figure(pb::CreateFigureRequest {
            parent: world.clone(),
            figure_id: "a".into(),
            figure: None,
            ..Default::default()
        })
        .await
        .unwrap();
    let checkpoint = pb::CheckpointWorldRequest {
        name: world.clone(),
        ..Default::default()
    };
    client
        .checkpoints()
        .checkpoint_world(checkpoint)
        .await
        .unwrap();
    let missing = pb::GetWorldRequest {
        name: "worlds/none".into(),
    };
    client.worlds().get_world(missing).await.unwrap_err();

    let mut frames = client
        .states()
        .watch_world(pb::WatchWorldRequest {
            world: world.clone(),
            ..Default::default()
        })
        .await
        .unwrap()
        .into_inner();
    let header = pb::DriveHeader {
        world,
        figure_ids: vec!["a".into()],
        driver_id: "me".into(),
        playout_delay_ms: Some(1e3 * DELAY),
        ..Default::default()
    };
    let driver = client.drive(header).await.unwrap();
    let mut tick = tokio::time::interval(Duration::from_secs_f64(1.0 / 60.0));
    for i in 0..60 {
        tick.tick().await;
        assert!(driver.send(vec![support::arm_frame("a", i)]).await);
        frames.message().await.unwrap().unwrap();
    }
    driver.finish().await.unwrap();
}

/// Rows of the manual: name, label, kind.
fn manual() -> BTreeMap<String, (Option<String>, String)> {
    let page = text("docs/operations.md");
    let rows = page.lines().filter(|l| l.starts_with("| `sinew_"));
    rows.map(|row| {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let name = cells[1].trim_matches('`');
        let (name, label) = match name.split_once('{') {
            Some((name, label)) => (name, Some(label.trim_end_matches('}').to_owned())),
            None => (name, None),
        };
        (name.to_owned(), (label, cells[2].to_owned()))
    })
    .collect()
}

/// Metrics that a file of `deploy/` names.
fn named(file: &str) -> BTreeSet<String> {
    let text = text(file);
    let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || "_:".contains(c)));
    words
        .filter(|w| w.starts_with("sinew_") || w.starts_with("process_"))
        .map(|w| {
            let part = ["_bucket", "_sum", "_count"]
                .into_iter()
                .find_map(|e| w.strip_suffix(e));
            part.unwrap_or(w).to_owned()
        })
        .collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_running_server_exports_what_manual_rules_and_dashboard_name() {
    let dir = support::Temporary::new("metrics");
    let server = Server::start(&["--data-dir", dir.path()]);
    let unused = Page::of(&server).await;
    let client = Client::connect(&server.address).await.unwrap();
    use_it(&client).await;
    tokio::time::sleep(Duration::from_millis(600)).await; // calls end, times are counted
    let page = Page::of(&server).await;

    let manual = manual();
    assert!(manual.len() > 30, "{}", manual.len());
    for (name, (label, kind)) in &manual {
        assert_eq!(page.kinds.get(name), Some(kind), "{name}");
        if let Some(label) = label {
            let labelled = page.samples.keys().any(|s| {
                s.strip_prefix(name.as_str()).is_some_and(|rest| {
                    let rest = rest.trim_start_matches("_bucket");
                    rest.starts_with('{') && rest.contains(&format!("{label}=\""))
                })
            });
            assert!(labelled, "{name} has no label {label}");
        }
    }
    for name in page.kinds.keys().filter(|n| n.starts_with("sinew_")) {
        assert!(manual.contains_key(name), "the manual does not list {name}");
    }
    for file in ["deploy/prometheus/rules.yaml", "deploy/grafana/sinew.json"] {
        let named = named(file);
        assert!(named.len() > 15, "{file}: {named:?}");
        for name in named {
            assert!(
                page.kinds.contains_key(&name),
                "{file}: {name} is not exported"
            );
        }
    }

    // Each event was counted once.
    assert_eq!(page.get("sinew_worlds"), 1.0);
    assert_eq!(page.get("sinew_checkpoints"), 1.0);
    assert!(page.get("sinew_checkpoint_bytes") > 1000.0);
    assert!(page.get("sinew_checkpoint_seconds_count{operation=\"capture\"}") >= 1.0);
    assert_eq!(page.get("sinew_calls_total{code=\"NOT_FOUND\"}"), 1.0);
    assert_eq!(
        page.get("sinew_faults_total{reason=\"RESOURCE_NOT_FOUND\"}"),
        1.0
    );
    let created = "sinew_call_seconds_count{method=\"WorldService/CreateWorld\"}";
    assert_eq!(page.get(created), 1.0);
    // The stream that its viewer left.
    assert_eq!(page.get("sinew_calls_total{code=\"CANCELLED\"}"), 1.0);
    assert!(page.get("sinew_budget_used_ratio") > 0.0);
    assert!(page.get("process_resident_memory_bytes") > 1e6);
    let ticks = page.get("sinew_ticks_total");
    assert!(ticks > 60.0);
    for stage in ["commands", "motion", "step", "publish"] {
        let counted = page.get(&format!(
            "sinew_tick_stage_seconds_count{{stage=\"{stage}\"}}"
        ));
        assert!(
            (counted - ticks).abs() < 20.0,
            "{stage}: {counted} of {ticks}"
        );
    }
    // Every sent frame was shown once, and not before its delay was over.
    let shown = page.get("sinew_input_to_frame_seconds_count");
    assert!((30.0..=60.0).contains(&shown), "{shown}");
    let mean = page.get("sinew_input_to_frame_seconds_sum") / shown;
    assert!(mean >= DELAY, "{mean}");

    // Series whose names are known in advance exist before anything happens.
    let late = "sinew_motion_frames_dropped_total{reason=\"overflow\"}";
    assert_eq!(unused.get(late), 0.0);
    assert_eq!(unused.get("sinew_tick_lateness_seconds_count"), 0.0);
}

/// The content of a page does not grow with the requests.
#[tokio::test(flavor = "multi_thread")]
async fn strangers_make_no_series() {
    let server = Server::start(&[]);
    let client = Client::connect(&server.address).await.unwrap();
    let ask = |name: String| {
        let mut worlds = client.worlds();
        async move { worlds.get_world(pb::GetWorldRequest { name }).await }
    };
    ask("worlds/first".into()).await.unwrap_err();
    let http = |path: String| support::http(server.address.clone(), path);
    http("/sinew.v1.WorldService/First".into()).await;
    let before = Page::of(&server).await.samples.len();
    for i in 0..50 {
        ask(format!("worlds/stranger-{i}")).await.unwrap_err();
        http(format!("/sinew.v1.WorldService/Stranger{i}")).await;
    }
    assert_eq!(Page::of(&server).await.samples.len(), before);
}
