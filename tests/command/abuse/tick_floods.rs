//! Drivers that send more than they may, and untrustworthy clocks.

use crate::abuse::harness::{attack_time, survives};
use sinew_client::Client;
use sinew_wire::pb;
use std::time::{Duration, Instant};
use tonic::Code;

/// Frames in one batch: the largest number that it may hold.
const BATCH: i64 = 64;

/// The zero pose at `t` seconds, numbered `sequence`, for these figures.
fn frame(figures: &[String], sequence: i64, t: f64) -> pb::MotionFrame {
    pb::MotionFrame {
        sequence,
        source_time_ns: (t * 1e9) as i64,
        figures: figures
            .iter()
            .map(|f| pb::FigureMotion {
                figure_id: f.clone(),
                joint_angles_rad: vec![0.0; 39],
                ..Default::default()
            })
            .collect(),
    }
}

fn push(driver: &str, figures: &[String], frames: Vec<pb::MotionFrame>) -> pb::PushMotionRequest {
    pb::PushMotionRequest {
        header: Some(pb::DriveHeader {
            world: "worlds/w".into(),
            figure_ids: figures.to_vec(),
            driver_id: driver.into(),
            ..Default::default()
        }),
        batch: Some(pb::MotionBatch { frames }),
    }
}

/// A running world with `figures` figures, named from `figure-1`.
async fn world(client: &Client, figures: usize) -> Vec<String> {
    let create = pb::CreateWorldRequest {
        world_id: "w".into(),
        ..Default::default()
    };
    client.worlds().create_world(create).await.unwrap();
    let names: Vec<String> = (1..=figures).map(|n| format!("f{n}")).collect();
    for name in &names {
        let create = pb::CreateFigureRequest {
            parent: "worlds/w".into(),
            figure_id: name.clone(),
            figure: Some(pb::Figure {
                controller: pb::Controller::Motors.into(),
                ..Default::default()
            }),
            ..Default::default()
        };
        client.figures().create_figure(create).await.unwrap();
    }
    names
}

async fn stats(client: &Client) -> pb::WorldStats {
    let request = pb::GetServerStatsRequest::default();
    let stats = client.server().get_server_stats(request).await;
    stats.unwrap().into_inner().worlds.remove(0)
}

/// One driver pushes full batches of eight figures as fast as it can, by four connections; another drives a ninth at 60
/// Hz and loses no frame.
#[test]
fn a_driver_who_floods_harms_only_himself() {
    survives(&[("max_tick_budget", "1000")], |address| async move {
        let address = address.to_string();
        let client = Client::connect(&address).await.unwrap();
        let mut figures = world(&client, 9).await;
        let own = vec![figures.pop().unwrap()];
        let until = Instant::now() + attack_time();
        let attack = async {
            let mut all = Vec::new();
            for _ in 0..4 {
                let attacker = Client::connect(&address).await.unwrap();
                let figures = figures.clone();
                all.push(async move {
                    let (mut sequence, mut refused) = (0, 0);
                    while Instant::now() < until {
                        let frames = (sequence..sequence + BATCH)
                            .map(|i| frame(&figures, i, i as f64 / 60.0))
                            .collect();
                        sequence += BATCH;
                        let sent = attacker
                            .motions()
                            .push_motion(push("flood", &figures, frames))
                            .await;
                        match sent {
                            Ok(_) => {}
                            Err(e) if e.code() == Code::ResourceExhausted => refused += 1,
                            Err(e) => panic!("{e:?}"),
                        }
                    }
                    refused
                });
            }
            futures_util::future::join_all(all)
                .await
                .iter()
                .sum::<i32>()
        };
        let honest = async {
            let (mut sequence, mut last) = (0, None);
            while Instant::now() < until {
                let frames = vec![frame(&own, sequence, sequence as f64 / 60.0)];
                let request = push("honest", &own, frames);
                let pushed = client.motions().push_motion(request).await;
                last = pushed.unwrap().into_inner().feedback;
                sequence += 1;
                tokio::time::sleep(Duration::from_millis(16)).await;
            }
            last.unwrap()
        };
        let (refused, feedback) = tokio::join!(attack, honest);
        let world = stats(&client).await;
        let commands = world.stages.iter().find(|s| s.stage == "commands").unwrap();
        eprintln!(
            "{refused} floods refused; `commands` p99 {:.0} µs, {} of {} deadlines left out",
            commands.p99_us, world.skipped_count, world.tick_count
        );
        assert!(refused > 0);
        let f = &feedback.figures[0];
        assert_eq!(
            (
                feedback.refused_batch_count,
                f.stale_count,
                f.overflow_count,
                f.resync_count
            ),
            (0, 0, 0, 0),
            "{f:?}"
        );
    });
}

/// Clocks that jump by any amount, sequences that restart, times at the ends of their range.
#[test]
fn clocks_that_jump_are_survived_and_followed_in_the_end() {
    survives(&[], |address| async move {
        let client = Client::connect(&address.to_string()).await.unwrap();
        let figures = world(&client, 1).await;
        let mut motions = client.motions();
        let until = Instant::now() + attack_time();
        let mut seed = 1u64;
        let mut random = move || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 16) as i64
        };
        while Instant::now() < until {
            let odd = [
                i64::MAX,
                i64::MIN,
                0,
                -1,
                3_600_000_000_000,
                random(),
                -random(),
            ];
            let mut f = frame(&figures, random().rem_euclid(1_000_000), 0.0);
            f.source_time_ns = odd[random().rem_euclid(odd.len() as i64) as usize];
            if random() % 4 == 0 {
                f.sequence = i64::MAX - random().rem_euclid(3);
            }
            let sent = motions.push_motion(push("me", &figures, vec![f])).await;
            if let Err(e) = sent {
                assert_eq!(e.code(), Code::ResourceExhausted, "{e:?}");
            }
        }
        // A second of an honest clock.
        let mut feedback = None;
        for i in 0..90 {
            let frames = vec![frame(&figures, i, i as f64 / 60.0)];
            let sent = motions.push_motion(push("me", &figures, frames)).await;
            if let Ok(sent) = sent {
                feedback = sent.into_inner().feedback;
            }
            tokio::time::sleep(Duration::from_millis(16)).await;
        }
        let feedback = feedback.unwrap();
        let f = &feedback.figures[0];
        assert!((40..90).contains(&f.applied_sequence), "{feedback:?}");
        assert!(f.resync_count > 0);
    });
}
