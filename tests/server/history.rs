//! The past of a world over the wire: going back, forking, replaying and recording it.

use crate::support::{TestServer, arm_frame, header, refusal, view};
use sinew_client::LiveDriver;
use sinew_physics::motion::Bvh;
use sinew_wire::pb;
use sinew_wire::pb::fork_world_request::Source as From;
use sinew_wire::watched::WatchWorldResponse;
use std::path::{Path, PathBuf};
use tonic::{Code, Status};

impl TestServer {
    async fn seek(&self, world: &str, tick: i64) -> Result<pb::World, Status> {
        let request = pb::SeekWorldRequest {
            name: world.into(),
            tick,
            ..Default::default()
        };
        let done = self.client.history().seek_world(request).await?;
        Ok(done.into_inner().world.unwrap())
    }

    async fn fork_at(&self, id: &str, world: &str, tick: i64) -> Result<pb::World, Status> {
        let request = pb::ForkWorldRequest {
            world_id: id.into(),
            paused: true,
            source: Some(From::World(world.into())),
            tick: Some(tick),
            ..Default::default()
        };
        let done = self.client.checkpoints().fork_world(request).await?;
        Ok(done.into_inner().world.unwrap())
    }

    async fn replay(&self, world: &str, thread_count: i32) -> pb::ReplayWorldResponse {
        let request = pb::ReplayWorldRequest {
            name: world.into(),
            thread_count,
            ..Default::default()
        };
        let done = self.client.history().replay_world(request).await;
        done.unwrap().into_inner()
    }

    async fn held(&self, world: &str) -> (i64, i64) {
        let request = pb::GetHistoryRequest { name: world.into() };
        let held = self.client.history().get_history(request).await;
        let held = held.unwrap().into_inner();
        (held.oldest_tick, held.newest_tick)
    }

    /// Frames of the past, and the rosters that came with them.
    async fn past(
        &self,
        world: &str,
        (first_tick, last_tick): (Option<i64>, Option<i64>),
        rate_divisor: i32,
    ) -> Result<(Vec<pb::WorldFrame>, Vec<pb::Roster>), Status> {
        let request = pb::ReadHistoryRequest {
            name: world.into(),
            view: Some(pb::View {
                rate_divisor,
                ..view(&["root_pose", "torque"])
            }),
            first_tick,
            last_tick,
        };
        let mut history = self.client.history();
        let mut parts = history.read_history(request).await?.into_inner();
        let (mut frames, mut rosters) = (Vec::new(), Vec::new());
        while let Some(part) = parts.message().await? {
            frames.extend(part.frames);
            rosters.extend(part.roster);
        }
        Ok((frames, rosters))
    }

    async fn export(
        &self,
        recording: &str,
        format: pb::RecordingFormat,
        figure_id: &str,
    ) -> Result<Vec<u8>, Status> {
        let request = pb::ExportRecordingRequest {
            name: recording.into(),
            format: format.into(),
            figure_id: figure_id.into(),
        };
        let mut pieces = self
            .client
            .recordings()
            .export_recording(request)
            .await?
            .into_inner();
        let mut file = Vec::new();
        while let Some(piece) = pieces.message().await? {
            file.extend(piece.data);
        }
        Ok(file)
    }
}

/// A folder of a test, empty.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder); // of an earlier run
    folder
}

/// The files that a process would leave if it were killed now.
fn killed(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        if entry.file_type().unwrap().is_dir() {
            killed(&entry.path(), &to.join(entry.file_name()));
        } else {
            std::fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
        }
    }
}

/// Ticks and hashes of an MCAP file.
fn frames_of(file: &[u8]) -> Vec<(i64, i64)> {
    let frame = |m: Result<mcap::Message<'_>, mcap::McapError>| {
        let frame = <pb::WorldFrame as prost::Message>::decode(&*m.unwrap().data).unwrap();
        (frame.tick, frame.state_hash)
    };
    mcap::MessageStream::new(file).unwrap().map(frame).collect()
}

/// A world with a figure that walks and one that is driven, after some ticks; the hash after each.
async fn driven(server: &TestServer) -> (String, Vec<i64>, LiveDriver) {
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    server.figure(&world, "b").await;
    let figure = format!("{world}/figures/a");
    server.play(&figure, "clips/walk", true).await;
    let mut driver = server
        .client
        .drive(header(&world, "b", "me"))
        .await
        .unwrap();
    let mut hashes = vec![server.frame(&world, &["root_pose"]).await.state_hash];
    for round in 0..6 {
        let frames: Vec<_> = (0..10).map(|i| arm_frame("b", 10 * round + i)).collect();
        assert!(driver.send(frames).await);
        while driver.feedback().await.unwrap().unwrap().received_sequence < 10 * round + 9 {}
        if round == 3 {
            server.push_it(&world, "a", 40.0).await;
        }
        hashes.extend(server.hashes(&world, 10).await);
    }
    (world, hashes, driver)
}

#[tokio::test(flavor = "multi_thread")]
async fn a_world_is_done_again_and_goes_back_to_any_tick_of_its_past() {
    let server = TestServer::start().await;
    let (world, hashes, mut driver) = driven(&server).await;
    assert_eq!(server.held(&world).await, (0, 60));
    for threads in [0, 2, 7] {
        let done = server.replay(&world, threads).await;
        let ticks = (done.first_tick, done.last_tick, done.compared_tick_count);
        assert_eq!(ticks, (0, 60, 60));
        assert_eq!(done.difference, None);
    }
    // The past, bit for bit; later commands are not repeated from there on.
    let fork = server.fork_at("then", &world, 23).await.unwrap();
    assert_eq!((fork.tick, fork.figure_count), (23, 2));
    let then = server.frame("worlds/then", &["root_pose"]).await;
    assert_eq!(then.state_hash, hashes[23]);
    assert_ne!(server.hashes("worlds/then", 20).await, hashes[24..44]);

    let mut frames = server
        .client
        .watch(&world, view(&["root_pose"]), None)
        .await
        .unwrap();
    let back = server.seek(&world, 41).await.unwrap();
    assert_eq!((back.tick, back.epoch), (41, 2));
    assert_eq!(server.held(&world).await, (0, 41));
    let shown = loop {
        let message = frames.message().await.unwrap().unwrap();
        if let WatchWorldResponse::Frame(f) = message
            && f.epoch == 2
        {
            break f;
        }
    };
    assert_eq!((shown.tick, shown.state_hash), (41, hashes[41]));
    // Its driver continues, and its new future becomes part of its past.
    let frames: Vec<_> = (60..120).map(|i| arm_frame("b", i)).collect();
    assert!(driver.send(frames).await);
    while driver.feedback().await.unwrap().unwrap().received_sequence < 119 {}
    server.step(&world, 40).await;
    let frame = server.frame(&world, &["status"]).await;
    assert!(frame.figures[1].applied_sequence >= 60, "it is driven");
    let done = server.replay(&world, 2).await;
    assert_eq!((done.compared_tick_count, done.difference), (81, None));
    // Earlier ticks are still held.
    let back = server.seek(&world, 5).await.unwrap();
    assert_eq!(back.tick, 5);
    let shown = server.frame(&world, &["root_pose"]).await;
    assert_eq!(shown.state_hash, hashes[5]);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn frames_of_the_past_are_those_that_were_and_the_world_is_not_changed() {
    let server = TestServer::start().await;
    let (world, hashes, _driver) = driven(&server).await;
    let before = server.frame(&world, &["root_pose", "torque"]).await;
    let (frames, rosters) = server.past(&world, (Some(23), Some(41)), 0).await.unwrap();
    let seen: Vec<_> = frames.iter().map(|f| (f.tick, f.state_hash)).collect();
    let were: Vec<_> = (23..=41).map(|t| (t, hashes[t as usize])).collect();
    assert_eq!(seen, were);
    let [roster] = &rosters[..] else {
        panic!("one roster: {rosters:?}");
    };
    let names: Vec<_> = roster.figures.iter().map(|f| &*f.figure_id).collect();
    assert_eq!(names, ["a", "b"]);
    assert!(
        frames
            .iter()
            .all(|f| f.figures.len() == 2 && f.roster_version == roster.version)
    );
    // Read the whole history at every tenth tick; the last frame is the present one.
    let (frames, _) = server.past(&world, (None, None), 10).await.unwrap();
    let ticks: Vec<_> = frames.iter().map(|f| f.tick).collect();
    assert_eq!(ticks, [0, 10, 20, 30, 40, 50, 60]);
    assert_eq!(frames[6].figures, before.figures);
    let after = server.frame(&world, &["root_pose", "torque"]).await;
    assert_eq!(after, before, "the world is not changed");
    // A removed figure stays in the past as long as that is held.
    let request = pb::DeleteFigureRequest {
        name: format!("{world}/figures/a"),
        ..Default::default()
    };
    server
        .client
        .figures()
        .delete_figure(request)
        .await
        .unwrap();
    server.step(&world, 5).await;
    let (frames, rosters) = server.past(&world, (Some(58), None), 0).await.unwrap();
    let figures: Vec<_> = frames.iter().map(|f| f.figures.len()).collect();
    assert_eq!(figures, [2, 2, 2, 1, 1, 1, 1, 1]);
    assert_eq!(rosters.len(), 2);
    assert_eq!(rosters[1].figures[0].figure_id, "b");
    // Spans that are not held, or that make no sense, are refused.
    for (span, code, reason) in [
        ((Some(3), Some(70)), Code::OutOfRange, "RESUME_EXPIRED"),
        ((Some(9), Some(8)), Code::InvalidArgument, "INVALID_FIELD"),
        ((Some(-1), None), Code::InvalidArgument, "INVALID_FIELD"),
    ] {
        let refused = server.past(&world, span, 0).await.unwrap_err();
        let (found, why, _) = refusal(&refused);
        assert_eq!((found, why.as_str()), (code, reason), "{span:?}");
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_happened_in_the_past_is_told_with_it_until_the_world_goes_back() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    server
        .play(&format!("{world}/figures/a"), "clips/walk", true)
        .await;
    server.step(&world, 10).await;
    server.push_it(&world, "a", 40.0).await;
    server.step(&world, 10).await;
    let told = async || {
        let request = pb::GetHistoryRequest {
            name: world.clone(),
        };
        let held = server.client.history().get_history(request).await.unwrap();
        let events = held.into_inner().events;
        let named = events.into_iter().map(|e| (e.r#type(), e));
        named.collect::<Vec<_>>()
    };
    let events = told().await;
    let (_, push) = events
        .iter()
        .find(|(kind, _)| *kind == pb::EventType::Pushed)
        .expect("the push is told");
    assert_eq!((push.tick, push.figure_id.as_str()), (10, "a"));
    // 40 N for 0.2 s.
    assert!((push.impulse_newton_seconds - 8.0).abs() < 1e-9);
    assert!(!push.segment.is_empty());
    assert!(
        events
            .iter()
            .any(|(kind, e)| { *kind == pb::EventType::ClipBegan && e.detail == "clips/walk" })
    );
    let ticks: Vec<_> = events.iter().map(|(_, e)| e.tick).collect();
    assert!(ticks.is_sorted(), "{ticks:?}");
    let often = [pb::EventType::SupportGained, pb::EventType::Saturated];
    assert!(events.iter().all(|(kind, _)| !often.contains(kind)));
    server.seek(&world, 5).await.unwrap();
    let events = told().await;
    assert!(events.iter().all(|(_, e)| e.tick <= 5), "{events:?}");
    let last = events.last().map(|(kind, _)| *kind);
    assert_eq!(last, Some(pb::EventType::WorldRestored));
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_tick_that_is_not_held_is_named() {
    let server = TestServer::start().await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    server.step(&world, 10).await;
    for refused in [
        server.seek(&world, 11).await.unwrap_err(),
        server.fork_at("x", &world, 11).await.unwrap_err(),
    ] {
        let (code, reason, _) = refusal(&refused);
        assert_eq!(
            (code, reason.as_str()),
            (Code::OutOfRange, "RESUME_EXPIRED")
        );
    }
    let refused = server.seek(&world, -1).await.unwrap_err();
    assert_eq!(refusal(&refused).0, Code::InvalidArgument);
    server.stop().await;

    let server = TestServer::with(&[("memory_s", "0")]).await;
    let world = server.paused_world("w").await;
    server.step(&world, 10).await;
    assert_eq!(server.held(&world).await, (-1, -1));
    let refused = server.seek(&world, 5).await.unwrap_err();
    assert_eq!(refusal(&refused).0, Code::OutOfRange);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_recording_outlives_its_past_and_becomes_files() {
    let server = TestServer::start().await;
    let (world, mut hashes, _driver) = driven(&server).await;
    let request = pb::StartRecordingRequest {
        parent: world.clone(),
        recording_id: "r".into(),
        first_tick: Some(30),
        ..Default::default()
    };
    let mut recordings = server.client.recordings();
    let begun = recordings.start_recording(request.clone()).await.unwrap();
    let begun = begun.into_inner().recording.unwrap();
    assert_eq!(begun.name, "worlds/w/recordings/r");
    let running = pb::RecordingState::Running as i32;
    assert_eq!(
        (begun.state, begun.first_tick, begun.last_tick),
        (running, 30, 60)
    );
    let taken = recordings.start_recording(request).await.unwrap_err();
    assert_eq!(refusal(&taken).0, Code::AlreadyExists);

    hashes.extend(server.hashes(&world, 15).await);
    let name = begun.name.clone();
    let request = pb::StopRecordingRequest {
        name: name.clone(),
        ..Default::default()
    };
    let ended = recordings.stop_recording(request).await.unwrap();
    let ended = ended.into_inner().recording.unwrap();
    assert_eq!(
        (ended.last_tick, ended.end_reason.as_str()),
        (75, "STOPPED")
    );
    // Even when the world has another past, the recording stays.
    server.seek(&world, 10).await.unwrap();
    server.step(&world, 3).await;

    let file = server
        .export(&name, pb::RecordingFormat::Mcap, "")
        .await
        .unwrap();
    let mut ticks = 30;
    for message in mcap::MessageStream::new(&file).unwrap() {
        let message = message.unwrap();
        assert_eq!(message.channel.topic, "/worlds/w");
        let schema = message.channel.schema.as_ref().unwrap();
        assert_eq!(
            (&*schema.name, &*schema.encoding),
            ("sinew.v1.WorldFrame", "protobuf")
        );
        let frame = <pb::WorldFrame as prost::Message>::decode(&*message.data).unwrap();
        assert_eq!(frame.tick, ticks);
        assert_eq!(frame.state_hash, hashes[ticks as usize]);
        assert_eq!(frame.figures.len(), 2);
        ticks += 1;
    }
    assert_eq!(ticks, 76);
    let bvh = server
        .export(&name, pb::RecordingFormat::Bvh, "b")
        .await
        .unwrap();
    assert_eq!(Bvh::parse(&bvh).unwrap().frame_count, 46);
    let csv = server
        .export(&name, pb::RecordingFormat::Csv, "")
        .await
        .unwrap();
    let csv = String::from_utf8(csv).unwrap();
    assert_eq!(csv.lines().count(), 47, "{csv}");
    assert!(csv.starts_with("time_s,root_x_m"));
    let nobody = server
        .export(&name, pb::RecordingFormat::Csv, "nobody")
        .await
        .unwrap_err();
    assert_eq!(refusal(&nobody).0, Code::NotFound);

    let request = pb::DeleteRecordingRequest {
        name: name.clone(),
        ..Default::default()
    };
    recordings.delete_recording(request).await.unwrap();
    let request = pb::GetRecordingRequest { name };
    let gone = recordings.get_recording(request).await.unwrap_err();
    assert_eq!(refusal(&gone).0, Code::NotFound);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_fork_goes_on_as_the_world_would_to_which_nothing_more_comes() {
    for window_ms in [0.0, 400.0] {
        let window = format!("{window_ms}");
        let settings = [("live_window_ms", window.as_str()), ("memory_s", "3600")];
        let server = TestServer::with(&settings).await;
        let (world, _, mut driver) = driven(&server).await;
        // In the middle of the sent frames, and of a clip.
        let frames: Vec<_> = (60..80).map(|i| arm_frame("b", i)).collect();
        assert!(driver.send(frames).await);
        while driver.feedback().await.unwrap().unwrap().received_sequence < 79 {}
        server.step(&world, 5).await;
        let then = server.frame(&world, &["root_pose"]).await;
        server
            .fork("now", From::World(world.clone()))
            .await
            .unwrap();
        let alone = server.hashes(&world, 120).await;
        assert_eq!(server.hashes("worlds/now", 120).await, alone);
        // The same from its past.
        server.fork_at("then", &world, then.tick).await.unwrap();
        assert_eq!(server.hashes("worlds/then", 120).await, alone);
        // In the fork the figure has no driver: any driver may take it, and it obeys.
        let driving = |f: &pb::Figure| f.status.as_ref().unwrap().driver_id.clone();
        let figure = server.look("worlds/then/figures/b").await;
        assert_eq!(driving(&figure), "");
        let mut other = server
            .client
            .drive(header("worlds/then", "b", "other"))
            .await
            .unwrap();
        assert!(
            other
                .send((0..60).map(|i| arm_frame("b", i)).collect())
                .await
        );
        while other.feedback().await.unwrap().unwrap().received_sequence < 59 {}
        server.step("worlds/then", 60).await;
        let shown = server.frame("worlds/then", &["status"]).await;
        assert!(shown.figures[1].applied_sequence >= 0, "{shown:?}");
        server
            .play("worlds/now/figures/b", "clips/walk", true)
            .await;
        server.step("worlds/now", 30).await;
        let walks = server.look("worlds/now/figures/b").await.status.unwrap();
        assert_eq!(walks.clip, "clips/walk");
        // Left alone, the figure stands after the grace time of its driver, five seconds, and stays standing.
        server.fork_at("left", &world, then.tick).await.unwrap();
        server.step("worlds/left", 400).await;
        let shown = server.frame("worlds/left", &["status"]).await;
        assert_eq!(
            shown.figures[1].applied_sequence, -1,
            "nothing plays to it any more"
        );
        server.stop().await;
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn recordings_outlive_the_server_as_far_as_its_log_reaches() {
    let (live, left, lost) = (
        folder("recorded"),
        folder("recorded-kill"),
        folder("recorded-lost"),
    );
    let on = |dir: &Path| {
        let dir = dir.to_str().unwrap().to_owned();
        async move {
            // However slow this machine is, none of the history expires.
            let settings = [
                ("data_dir", dir.as_str()),
                ("durability", "each"),
                ("history_s", "3600"),
                ("memory_s", "3600"),
            ];
            let server = TestServer::with(&settings).await;
            server.app.restore().await;
            server
        }
    };
    let recording = |name: &str| pb::GetRecordingRequest {
        name: format!("worlds/w/recordings/{name}"),
    };
    let get = async |server: &TestServer, name: &str| {
        let found = server
            .client
            .recordings()
            .get_recording(recording(name))
            .await;
        found.unwrap().into_inner().recording.unwrap()
    };
    let server = on(&live).await;
    let (world, mut hashes, driver) = driven(&server).await;
    for (id, first_tick) in [("whole", Some(30)), ("ended", Some(10)), ("gone", None)] {
        let request = pb::StartRecordingRequest {
            parent: world.clone(),
            recording_id: id.into(),
            first_tick,
            ..Default::default()
        };
        server
            .client
            .recordings()
            .start_recording(request)
            .await
            .unwrap();
    }
    hashes.extend(server.hashes(&world, 10).await);
    let stop = pb::StopRecordingRequest {
        name: recording("ended").name,
        ..Default::default()
    };
    server
        .client
        .recordings()
        .stop_recording(stop)
        .await
        .unwrap();
    let delete = pb::DeleteRecordingRequest {
        name: recording("gone").name,
        ..Default::default()
    };
    server
        .client
        .recordings()
        .delete_recording(delete)
        .await
        .unwrap();
    hashes.extend(server.hashes(&world, 5).await);
    let begun = get(&server, "whole").await.create_time;
    // The files after a kill at this moment, and after an orderly end. Inputs are handed over every 10 ms.
    tokio::time::sleep(std::time::Duration::from_millis(500)).await;
    killed(&live, &left);
    drop(driver);
    server.stop().await;

    for dir in [&left, &live] {
        let mut hashes = hashes.clone();
        let server = on(dir).await;
        let whole = get(&server, "whole").await;
        let running = i32::from(pb::RecordingState::Running);
        assert_eq!(
            (whole.state, whole.first_tick, whole.last_tick),
            (running, 30, 75)
        );
        assert_eq!(
            whole.create_time.map(|t| (t.seconds, t.nanos / 1_000_000)),
            begun.map(|t| (t.seconds, t.nanos / 1_000_000))
        );
        let ended = get(&server, "ended").await;
        assert_eq!((ended.first_tick, ended.last_tick), (10, 70));
        assert_eq!(ended.end_reason, "STOPPED");
        let gone = server
            .client
            .recordings()
            .get_recording(recording("gone"))
            .await;
        assert_eq!(refusal(&gone.unwrap_err()).0, Code::NotFound);
        // The recording continues with the world.
        hashes.extend(server.hashes(&world, 20).await);
        let mcap = pb::RecordingFormat::Mcap;
        for (name, first, last) in [("whole", 30, 95), ("ended", 10, 70)] {
            let file = server
                .export(&recording(name).name, mcap, "")
                .await
                .unwrap();
            let meant: Vec<_> = (first..=last).map(|t| (t, hashes[t as usize])).collect();
            assert_eq!(frames_of(&file), meant, "{name}");
        }
        server.stop().await;
    }

    // Without the log there is no content, and the error says so.
    killed(&live, &lost);
    for file in ["log.sqlite", "log.sqlite-wal", "log.sqlite-shm", "log.end"] {
        let _ = std::fs::remove_file(lost.join(file));
    }
    let server = on(&lost).await;
    let whole = get(&server, "whole").await;
    assert_eq!(whole.end_reason, "HISTORY_LOST");
    let file = server
        .export(&whole.name, pb::RecordingFormat::Mcap, "")
        .await;
    let (code, reason, _) = refusal(&file.unwrap_err());
    assert_eq!((code, reason.as_str()), (Code::DataLoss, "RECORDING_LOST"));
    server.stop().await;
}
