//! Clients that ask for more than their share of processors, workers and places.

use crate::abuse::harness::{attack_time, survives};
use sinew_client::Client;
use sinew_wire::pb;
use std::time::Instant;
use tonic::{Code, Status};
use tonic_types::StatusExt;

fn reason(e: &Status) -> String {
    let details = e.get_error_details();
    details
        .error_info()
        .map(|i| i.reason.clone())
        .unwrap_or_default()
}

async fn create(client: &Client, id: &str, world: pb::World) -> Result<(), Status> {
    let request = pb::CreateWorldRequest {
        world_id: id.into(),
        world: Some(world),
        paused: false,
        ..Default::default()
    };
    client.worlds().create_world(request).await.map(|_| ())
}

async fn figure(client: &Client, world: &str) -> Result<(), Status> {
    let request = pb::CreateFigureRequest {
        parent: format!("worlds/{world}"),
        ..Default::default()
    };
    client.figures().create_figure(request).await.map(|_| ())
}

/// Worlds at 1000 Hz, ten times as fast, with 16 substeps and 16 figures each: none is created.
#[test]
fn worlds_that_no_machine_could_bear_are_refused() {
    survives(&[], |address| async move {
        let address = address.to_string();
        let healthy = Client::connect(&address).await.unwrap();
        create(&healthy, "healthy", pb::World::default())
            .await
            .unwrap();
        figure(&healthy, "healthy").await.unwrap();
        let greedy = Client::connect(&address).await.unwrap();
        let mut refused = 0;
        for n in 0..4 {
            let id = format!("greedy-{n}");
            let world = pb::World {
                rate_hz: 1000.0,
                speed: 10.0,
                substep_count: 16,
                ..Default::default()
            };
            match create(&greedy, &id, world).await {
                Ok(()) => {
                    for _ in 0..16 {
                        let e = figure(&greedy, &id).await.unwrap_err();
                        assert_eq!(reason(&e), "TICK_BUDGET", "{e:?}");
                        refused += 1;
                    }
                }
                Err(e) => assert_eq!(reason(&e), "TICK_BUDGET", "{e:?}"),
            }
        }
        tokio::time::sleep(attack_time()).await;
        let request = pb::GetServerStatsRequest {
            world: "worlds/healthy".into(),
        };
        let stats = healthy.server().get_server_stats(request).await;
        let stats = stats.unwrap().into_inner();
        let late = &stats.worlds[0].stages[0];
        eprintln!(
            "{refused} figures refused; the healthy world is late by {:.0} µs (p99)",
            late.p99_us
        );
        assert!(stats.worlds[0].tick_count > 0);
    });
}

async fn stats(client: &Client) -> pb::GetServerStatsResponse {
    let request = pb::GetServerStatsRequest::default();
    let stats = client.server().get_server_stats(request).await;
    stats.unwrap().into_inner()
}

/// Worlds are filled with cheap figures up to the budget, which then become expensive. It is too late to refuse them,
/// so they are throttled, and a cheap world continues.
#[test]
fn worlds_that_become_expensive_leave_time_for_others() {
    survives(&[], |address| async move {
        let address = address.to_string();
        let healthy = Client::connect(&address).await.unwrap();
        create(&healthy, "healthy", pb::World::default())
            .await
            .unwrap();
        figure(&healthy, "healthy").await.unwrap();
        let greedy = Client::connect(&address).await.unwrap();
        let mut names = Vec::new();
        for n in 0..4 {
            let id = format!("greedy-{n}");
            let world = pb::World {
                rate_hz: 200.0,
                ..Default::default()
            };
            if create(&greedy, &id, world).await.is_err() {
                break;
            }
            loop {
                let request = pb::CreateFigureRequest {
                    parent: format!("worlds/{id}"),
                    figure: Some(pb::Figure {
                        controller: pb::Controller::Motors.into(),
                        ..Default::default()
                    }),
                    ..Default::default()
                };
                match greedy.figures().create_figure(request).await {
                    Ok(made) => names.push(made.into_inner().figure.unwrap().name),
                    Err(_) => break,
                }
            }
        }
        for name in &names {
            let request = pb::UpdateFigureRequest {
                control_token: String::new(),
                figure: Some(pb::Figure {
                    name: name.clone(),
                    controller: pb::Controller::Modern.into(),
                    ..Default::default()
                }),
                update_mask: Some(prost_types::FieldMask {
                    paths: vec!["controller".into()],
                }),
                ..Default::default()
            };
            let _ = greedy.figures().update_figure(request).await; // its world may be too busy
        }
        let before = stats(&healthy).await;
        tokio::time::sleep(attack_time()).await;
        let after = stats(&healthy).await;
        let [before, world] = [&before, &after].map(|s| {
            s.worlds
                .iter()
                .find(|w| w.world == "worlds/healthy")
                .unwrap()
        });
        eprintln!(
            "{} figures need {:.0} % of the processors; the healthy world is late by {:.0} µs (p99), {} of {} \
             deadlines left out",
            names.len(),
            100.0 * after.budget_used,
            world.stages[0].p99_us,
            world.skipped_count - before.skipped_count,
            world.tick_count - before.tick_count,
        );
        assert!(world.tick_count > before.tick_count);
    });
}

/// Long simulations and uploads by four connections, some of which disconnect; the work of others is done in the
/// meantime.
#[test]
fn long_work_of_some_does_not_stop_others() {
    survives(&[], |address| async move {
        let address = address.to_string();
        let until = Instant::now() + attack_time();
        let long = pb::SimulateClipRequest {
            source: Some(pb::simulate_clip_request::Source::Clip("clips/wave".into())),
            rate_hz: 1000.0,
            substep_count: 16,
            duration_s: 120.0,
            r#loop: true,
            ..Default::default()
        };
        let attack = async {
            let mut running = Vec::new();
            for n in 0..4 {
                let attacker = Client::connect(&address).await.unwrap();
                for _ in 0..20 {
                    let (attacker, long) = (attacker.clone(), long.clone());
                    running.push(tokio::spawn(async move {
                        attacker.simulations().simulate_clip(long).await
                    }));
                }
                if n == 3 {
                    running.drain(60..).for_each(|r| r.abort()); // the last one goes away
                }
            }
            tokio::time::sleep(until.saturating_duration_since(Instant::now())).await;
            for r in &running {
                r.abort();
            }
        };
        let honest = async {
            let client = Client::connect(&address).await.unwrap();
            let mut done = 0;
            while done < 3 || Instant::now() < until {
                let short = pb::SimulateClipRequest {
                    rate_hz: 60.0,
                    substep_count: 2,
                    duration_s: 0.2,
                    ..long.clone()
                };
                client.simulations().simulate_clip(short).await.unwrap();
                let frame = pb::FigureMotion {
                    root: Some(pb::Pose::default()),
                    joint_angles_rad: vec![0.0; 39],
                    ..Default::default()
                };
                let request = pb::CreateClipRequest {
                    clip_id: format!("clip-of-{done}"),
                    source: Some(pb::create_clip_request::Source::Frames(pb::FrameSource {
                        rate_hz: 60.0,
                        frames: vec![frame; 10],
                    })),
                    ..Default::default()
                };
                client.motions().create_clip(request).await.unwrap();
                // There is room for 256 clips, fewer than are made in half a minute.
                let request = pb::DeleteClipRequest {
                    name: format!("clips/clip-of-{done}"),
                    ..Default::default()
                };
                client.motions().delete_clip(request).await.unwrap();
                done += 1;
            }
            done
        };
        let ((), done) = tokio::join!(attack, honest);
        eprintln!("{done} simulations and uploads done meanwhile");
    });
}

/// One client takes worlds, views, viewers and drivers until it is refused; another one still gets some.
#[test]
fn who_takes_all_gets_half() {
    // Few enough that processor time does not run out first.
    survives(&[("max_worlds", "16")], |address| async move {
        let address = address.to_string();
        let greedy = Client::connect(&address).await.unwrap();
        let other = Client::connect(&address).await.unwrap();
        create(&other, "w", pb::World::default()).await.unwrap();
        for _ in 0..2 {
            figure(&other, "w").await.unwrap();
        }
        let mut worlds = 0;
        let refused = loop {
            match create(&greedy, "", pb::World::default()).await {
                Ok(()) => worlds += 1,
                Err(e) => break e,
            }
        };
        assert_eq!(refused.code(), Code::ResourceExhausted);
        create(&other, "", pb::World::default()).await.unwrap();
        // Every view different from the last.
        let mut held = Vec::new();
        let refused = loop {
            let view = pb::View {
                rate_divisor: 1 + held.len() as i32,
                ..Default::default()
            };
            match greedy.watch("worlds/w", view, None).await {
                Ok(stream) => held.push(stream),
                Err(e) => break e,
            }
        };
        assert_eq!(refused.code(), Code::ResourceExhausted);
        let view = pb::View {
            rate_divisor: 999,
            ..Default::default()
        };
        let mut seen = other.watch("worlds/w", view, None).await.unwrap();
        seen.message().await.unwrap().unwrap();
        eprintln!("{worlds} worlds and {} views for one client", held.len());
    });
}
