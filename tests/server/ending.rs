//! The end of the server, which is announced in advance and told to all clients, and the end of driven figures.

use crate::support::{TestServer, arm_frame, header, refusal};
use sinew_client::Client;
use sinew_wire::pb;
use std::time::Duration;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tonic::{Code, Status};
use tonic_health::pb::HealthCheckRequest;
use tonic_health::pb::health_check_response::ServingStatus;
use tonic_health::pb::health_client::HealthClient;
use tonic_types::StatusExt;

/// Health, asked over a new connection.
async fn health(server: &TestServer) -> ServingStatus {
    health_of(server, "").await
}

async fn health_of(server: &TestServer, service: &str) -> ServingStatus {
    let endpoint = format!("http://{}", server.address);
    let channel = tonic::transport::Endpoint::from_shared(endpoint);
    let channel = channel.unwrap().connect().await.unwrap();
    let mut client = HealthClient::new(channel);
    let request = HealthCheckRequest {
        service: service.into(),
    };
    client.check(request).await.unwrap().into_inner().status()
}

/// The first line of the answer of `/readyz`.
async fn ready(server: &TestServer) -> String {
    page(server, "/readyz").await
}

async fn page(server: &TestServer, path: &str) -> String {
    let mut stream = tokio::net::TcpStream::connect(server.address)
        .await
        .unwrap();
    let request = format!(
        "GET {path} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n",
        server.address
    );
    stream.write_all(request.as_bytes()).await.unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).await.unwrap();
    answer.lines().next().unwrap_or_default().to_owned()
}

fn is_draining(e: &Status) {
    let (code, reason, _) = refusal(e);
    assert_eq!(
        (code, reason.as_str()),
        (Code::Unavailable, "DRAINING"),
        "{e:?}"
    );
    assert!(e.get_error_details().retry_info().is_some());
}

#[tokio::test(flavor = "multi_thread")]
async fn the_end_of_the_server_is_seen_before_it_comes() {
    let mut server = TestServer::with(&[("lame_duck_s", "1.5")]).await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    assert_eq!(health(&server).await, ServingStatus::Serving);
    assert_eq!(ready(&server).await, "HTTP/1.1 200 OK");
    server.begin_stop();
    while health(&server).await == ServingStatus::Serving {
        tokio::task::yield_now().await;
    }
    // New connections see it, and existing work continues; but nothing new begins.
    assert_eq!(ready(&server).await, "HTTP/1.1 503 Service Unavailable");
    assert_eq!(page(&server, "/livez").await, "HTTP/1.1 200 OK");
    for (service, status) in [
        ("readiness", ServingStatus::NotServing),
        ("liveness", ServingStatus::Serving),
    ] {
        assert_eq!(health_of(&server, service).await, status, "{service}");
    }
    while health_of(&server, "sinew.v1.MotionService").await == ServingStatus::Serving {
        tokio::task::yield_now().await;
    }
    let client = Client::connect(&server.address.to_string()).await.unwrap();
    let name = world.clone();
    let mut worlds = client.worlds();
    let got = worlds.get_world(pb::GetWorldRequest { name }).await;
    assert_eq!(got.unwrap().into_inner().world.unwrap().name, world);
    server.step(&world, 1).await;
    let create = pb::CreateWorldRequest::default();
    is_draining(&client.worlds().create_world(create).await.unwrap_err());
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn who_waits_when_the_server_ends_is_told_to_come_again() {
    let mut server = TestServer::with(&[("shutdown_grace_s", "0.3")]).await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let mut worlds = server.client.worlds();
    let name = world.clone();
    let steps = tokio::spawn(async move {
        let tick_count = 10_000;
        worlds
            .step_world(pb::StepWorldRequest {
                name,
                tick_count,
                ..Default::default()
            })
            .await
    });
    let mut simulations = server.client.simulations();
    let simulation = tokio::spawn(async move {
        let source = pb::simulate_clip_request::Source::Clip("clips/wave".into());
        simulations
            .simulate_clip(pb::SimulateClipRequest {
                source: Some(source),
                rate_hz: 1000.0,
                substep_count: 16,
                duration_s: 120.0,
                r#loop: true,
                ..Default::default()
            })
            .await
    });
    let driver = server.client.drive(header(&world, "a", "me")).await;
    while server.app.simulations.running() == 0 || server.frame(&world, &["status"]).await.tick == 0
    {
        tokio::time::sleep(Duration::from_millis(5)).await;
    }
    server.begin_stop();
    is_draining(&steps.await.unwrap().unwrap_err());
    is_draining(&simulation.await.unwrap().unwrap_err());
    is_draining(&end_of(driver.unwrap()).await);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_runs_may_end_and_what_comes_meanwhile_is_refused() {
    let mut server = TestServer::with(&[("shutdown_grace_s", "60")]).await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let mut worlds = server.client.worlds();
    let name = world.clone();
    let steps = tokio::spawn(async move {
        let tick_count = 1000;
        worlds
            .step_world(pb::StepWorldRequest {
                name,
                tick_count,
                ..Default::default()
            })
            .await
    });
    while server.frame(&world, &["status"]).await.tick == 0 {
        tokio::time::sleep(Duration::from_millis(1)).await;
    }
    server.begin_stop();
    // The steps continue; other requests are refused, over new connections too.
    let client = Client::connect(&server.address.to_string()).await.unwrap();
    let get = || {
        let name = world.clone();
        let mut worlds = client.worlds();
        async move { worlds.get_world(pb::GetWorldRequest { name }).await }
    };
    let refused = loop {
        if let Err(e) = get().await {
            break e;
        }
    };
    is_draining(&refused);
    assert!(!steps.is_finished(), "more steps are needed for this test");
    assert_eq!(health(&server).await, ServingStatus::NotServing);
    assert_eq!(steps.await.unwrap().unwrap().into_inner().tick, 1000);
    drop(client);
    server.stop().await;
}

/// Connections are asked to close when they are old enough, at different ages, and closed if they do not.
#[tokio::test(flavor = "multi_thread")]
async fn connections_grow_only_so_old() {
    let settings = [
        ("max_connection_age_s", "1"),
        ("connection_age_grace_s", "0.5"),
    ];
    let server = TestServer::with(&settings).await;
    let begun = std::time::Instant::now();
    // HTTP/1: a connection that is asked to close closes after its answer, or at once if it has none to give.
    let idle = (0..8).map(|_| async {
        let mut stream = tokio::net::TcpStream::connect(server.address)
            .await
            .unwrap();
        let request = format!("GET /livez HTTP/1.1\r\nHost: {}\r\n\r\n", server.address);
        stream.write_all(request.as_bytes()).await.unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).await.unwrap();
        assert!(answer.starts_with("HTTP/1.1 200"));
        begun.elapsed().as_secs_f64()
    });
    let mut ages = futures_util::future::join_all(idle).await;
    ages.sort_by(f64::total_cmp);
    assert!(ages[0] > 0.85 && ages[7] > ages[0] + 0.1, "{ages:?}");
    // A stream continues until the grace time is over, and a client that is asked to close reconnects by itself.
    let world = server.world("w", false, pb::World::default()).await;
    let began = std::time::Instant::now();
    let mut frames = server
        .client
        .watch(&world, pb::View::default(), None)
        .await
        .unwrap();
    while let Ok(Some(_)) = frames.message().await {}
    assert!(began.elapsed() < Duration::from_secs(10));
    // A call that was handed to a connection in the moment when it closed comes back unsent: it may be made again.
    let mut worlds = server.client.worlds();
    let mut answer = worlds.list_worlds(pb::ListWorldsRequest::default()).await;
    if answer.as_ref().is_err_and(was_never_sent) {
        answer = worlds.list_worlds(pb::ListWorldsRequest::default()).await;
    }
    answer.unwrap();
    server.stop().await;
}

/// Whether the transport gave a call back because the connection closed before it took the call. The server's own
/// answers have no source.
fn was_never_sent(status: &Status) -> bool {
    let transport =
        std::error::Error::source(status).is_some_and(|e| e.is::<tonic::transport::Error>());
    transport && status.code() == Code::Cancelled
}

/// The reason why a drive ended.
async fn end_of(mut driver: sinew_client::LiveDriver) -> Status {
    loop {
        match driver.feedback().await {
            Ok(Some(_)) => {}
            Ok(None) => panic!("ended without a reason"),
            Err(e) => break e,
        }
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_driver_whose_figure_is_removed_is_told_so() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    for figure in ["a", "b", "c"] {
        server.figure(&world, figure).await;
    }
    let watch = pb::WatchEventsRequest {
        world: world.clone(),
        figure_ids: vec![],
        types: vec![pb::EventType::DriveEnded.into()],
    };
    let mut events = server.client.states().watch_events(watch).await;
    let events = events.as_mut().unwrap().get_mut();
    events.message().await.unwrap().unwrap();
    let two = pb::DriveHeader {
        figure_ids: vec!["a".into(), "b".into()],
        ..header(&world, "", "two")
    };
    let mut two = server.client.drive(two).await.unwrap();
    let one = server
        .client
        .drive(header(&world, "c", "one"))
        .await
        .unwrap();
    let remove = |figure: &str| {
        let name = format!("{world}/figures/{figure}");
        let mut figures = server.client.figures();
        async move {
            figures
                .delete_figure(pb::DeleteFigureRequest {
                    name,
                    ..Default::default()
                })
                .await
                .unwrap();
        }
    };
    // One of two figures is removed: the drive continues with the other.
    remove("a").await;
    let told = events.message().await.unwrap().unwrap().events.remove(0);
    assert_eq!(told.figure_id, "a");
    assert_eq!(told.detail, "two: the figure was removed");
    assert!(two.send(vec![arm_frame("b", 0)]).await);
    loop {
        let feedback = two.feedback().await.unwrap().unwrap();
        let left: Vec<&str> = feedback
            .figures
            .iter()
            .map(|f| f.figure_id.as_str())
            .collect();
        if feedback.received_sequence == 0 && left == ["b"] {
            break;
        }
    }
    // The last one.
    remove("c").await;
    let told = events.message().await.unwrap().unwrap().events.remove(0);
    assert_eq!(told.figure_id, "c");
    let e = end_of(one).await;
    let details = e.get_error_details();
    let resource = details.resource_info().unwrap();
    assert_eq!(refusal(&e).0, Code::NotFound);
    assert_eq!(resource.resource_name, format!("{world}/figures/c"));
    // Pushes are refused in the same way.
    server.figure(&world, "d").await;
    let push = || pb::PushMotionRequest {
        header: Some(header(&world, "d", "pusher")),
        batch: Some(pb::MotionBatch {
            frames: vec![arm_frame("d", 0)],
        }),
    };
    server.client.motions().push_motion(push()).await.unwrap();
    remove("d").await;
    let e = server.client.motions().push_motion(push()).await;
    assert_eq!(refusal(&e.unwrap_err()).0, Code::NotFound);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_world_whose_tick_does_not_end_is_given_up_and_no_other_notices() {
    let settings = [("slow_tick_s", "0.05"), ("stuck_tick_s", "0.3")];
    let server = TestServer::with(&settings).await;
    let other = server.world("other", false, pb::World::default()).await;
    server.figure(&other, "a").await;
    let world = server.world("w", false, pb::World::default()).await;
    let (go, wait) = std::sync::mpsc::sync_channel::<()>(1);
    let handle = server.app.worlds.get("w").unwrap();
    let origin = sinew_server::tick::command::CommandOrigin {
        client: "c".into(),
        sequence: 0,
    };
    // The round of this world hangs, as if its step never ended.
    let hangs = move |_: &mut _| {
        let _ = wait.recv();
    };
    handle.send(origin, hangs).unwrap();

    let failed = async {
        while server.get_world(&world).await.state != i32::from(pb::WorldState::Failed) {
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    };
    tokio::time::timeout(Duration::from_secs(30), failed)
        .await
        .unwrap();
    assert!(
        server
            .get_world(&world)
            .await
            .failure
            .contains("did not end")
    );
    // Requests for this world are refused with the reason; the server is not ready, but reports that it is alive.
    let pause = pb::PauseWorldRequest {
        name: world.clone(),
    };
    let refused = server.client.worlds().pause_world(pause).await;
    let (code, reason, _) = refusal(&refused.unwrap_err());
    assert_eq!(
        (code, reason.as_str()),
        (Code::FailedPrecondition, "WORLD_FAILED")
    );
    assert_eq!(ready(&server).await, "HTTP/1.1 503 Service Unavailable");
    assert_eq!(page(&server, "/livez").await, "HTTP/1.1 200 OK");
    // The other world continues and takes commands, and new worlds can be created.
    let before = server.get_world(&other).await.tick;
    let ticks = async {
        while server.get_world(&other).await.tick < before + 20 {
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    };
    tokio::time::timeout(Duration::from_secs(30), ticks)
        .await
        .unwrap();
    server.figure(&other, "b").await;
    let new = server.paused_world("new").await;
    server.step(&new, 3).await;
    // Once the tick has ended after all, the server is ready again. The world stays abandoned.
    go.send(()).unwrap();
    let again = async {
        while ready(&server).await != "HTTP/1.1 200 OK" {
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    };
    tokio::time::timeout(Duration::from_secs(30), again)
        .await
        .unwrap();
    assert_eq!(
        server.get_world(&world).await.state,
        i32::from(pb::WorldState::Failed)
    );
    server.stop().await;
}
