//! Control of a figure: leases, their tokens, and their visibility to others.

use crate::access::support::{Guarded, figure, grant, refusal, role, world};
use crate::corpus;
use sinew_client::Client;
use sinew_physics::body::{Body, Posture};
use sinew_physics::motion::Bvh;
use sinew_physics::motion::clip::PlanarTransform;
use sinew_physics::plan::cycle;
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::RetargetOptions;
use sinew_server::access::roles::Role;
use sinew_wire::convert::motion::figure_motion;
use sinew_wire::pb;
use std::time::Duration;
use tonic::{Code, Status, Streaming};

/// Bit of `status.flags`.
const FALLEN: i32 = 1 << 6;

/// A paused world of `owner` with figure `a`, which `alice`, `bob` and `rival` may drive.
pub struct Scene {
    server: Guarded,
    pub owner: Client,
    pub world: String,
    pub figure: String,
}

impl Scene {
    pub async fn new(paused: bool) -> Self {
        let server = Guarded::start(&[]).await;
        let owner = server.client("owner", &[Role::Creator], None).await;
        let world = world(&owner, "w", paused).await;
        let figure = figure(&owner, &world, "a").await;
        for who in ["user:alice", "user:bob", "user:rival"] {
            let driver = pb::Grant {
                figure_ids: vec!["a".into()],
                ..role(who, pb::Role::Driver)
            };
            grant(&owner, &world, driver).await;
        }
        Self {
            server,
            owner,
            world,
            figure,
        }
    }

    pub async fn someone(&self, name: &str) -> Client {
        self.server.client(name, &[], None).await
    }

    async fn acquire(
        &self,
        client: &Client,
        token: &str,
        priority: i32,
    ) -> Result<pb::AcquireControlResponse, Status> {
        let request = pb::AcquireControlRequest {
            figure: self.figure.clone(),
            control_token: token.into(),
            priority,
            grace_ms: 60_000.0,
            ..Default::default()
        };
        client
            .control()
            .acquire_control(request)
            .await
            .map(tonic::Response::into_inner)
    }

    pub fn header(&self, driver: &str, tokens: &[&str]) -> pb::DriveHeader {
        pb::DriveHeader {
            world: self.world.clone(),
            figure_ids: vec!["a".into()],
            driver_id: driver.into(),
            control_tokens: tokens.iter().map(|t| (*t).to_owned()).collect(),
            playout_delay_ms: Some(0.0),
            grace_ms: Some(60_000.0),
            ..Default::default()
        }
    }

    async fn push(
        &self,
        client: &Client,
        header: &pb::DriveHeader,
        frames: Vec<pb::MotionFrame>,
    ) -> Result<pb::DriveFeedback, Status> {
        let request = pb::PushMotionRequest {
            header: Some(header.clone()),
            batch: Some(pb::MotionBatch { frames }),
        };
        let pushed = client.motions().push_motion(request).await?;
        Ok(pushed.into_inner().feedback.unwrap())
    }

    async fn events(&self) -> Events {
        let request = pb::WatchEventsRequest {
            world: self.world.clone(),
            ..Default::default()
        };
        let mut stream = self
            .owner
            .states()
            .watch_events(request)
            .await
            .unwrap()
            .into_inner();
        stream.message().await.unwrap();
        Events(stream)
    }

    /// Whether the figure has fallen, and how fast it moves over the floor, m/s.
    pub async fn seen(&self) -> (bool, f64) {
        let view = pb::View {
            fields: Some(prost_types::FieldMask {
                paths: vec!["status".into(), "velocity".into()],
            }),
            ..Default::default()
        };
        let request = pb::GetWorldFrameRequest {
            world: self.world.clone(),
            tick: None,
            view: Some(view),
        };
        let got = self.owner.states().get_world_frame(request).await.unwrap();
        let frame = got.into_inner().frame.unwrap();
        let f = &frame.figures[0];
        let v = sinew_wire::frame::values(f.velocity.as_ref().unwrap());
        let flags = f.status.as_ref().unwrap().flags;
        (flags & FALLEN != 0, v[3].hypot(v[4]))
    }

    pub async fn step(&self, ticks: i32) {
        let request = pb::StepWorldRequest {
            name: self.world.clone(),
            tick_count: ticks,
            ..Default::default()
        };
        self.owner.worlds().step_world(request).await.unwrap();
    }
}

struct Events(Streaming<pb::WatchEventsResponse>);

impl Events {
    /// The next event of this type.
    async fn next(&mut self, wanted: pb::EventType) -> pb::Event {
        loop {
            let message = tokio::time::timeout(Duration::from_secs(20), self.0.message()).await;
            let message = message.expect("the event does not come").unwrap().unwrap();
            if let Some(e) = message.events.into_iter().find(|e| e.r#type() == wanted) {
                return e;
            }
        }
    }
}

fn arm(sequence: i64) -> pb::MotionFrame {
    let t = sequence as f64 / 60.0;
    let mut angles = vec![0.0; 39];
    angles[19] = 0.6 - 0.6 * (1.5 * t).cos(); // right elbow
    pb::MotionFrame {
        sequence,
        source_time_ns: (t * 1e9) as i64,
        figures: vec![pb::FigureMotion {
            figure_id: "a".into(),
            joint_angles_rad: angles,
            planted: vec![true, true],
            ..Default::default()
        }],
    }
}

/// Result of each call that could disturb the controller of figure `a`.
async fn attack(
    scene: &Scene,
    client: &Client,
    token: &str,
) -> Vec<(&'static str, Result<(), Status>)> {
    let (figure, control_token) = (scene.figure.clone(), token.to_owned());
    let tokens: &[&str] = if token.is_empty() { &[] } else { &[token] };
    let mut out = Vec::new();
    // Under the driver's own name, far ahead in sequence.
    let header = scene.header("alice", tokens);
    out.push((
        "PushMotion",
        scene
            .push(client, &header, vec![arm(1_000_000)])
            .await
            .map(|_| ()),
    ));
    out.push(("DriveFigures", client.drive(header).await.map(|_| ())));
    let play = pb::PlayClipRequest {
        figure: figure.clone(),
        clip: "clips/wave".into(),
        control_token: control_token.clone(),
        reset: true,
        ..Default::default()
    };
    out.push((
        "PlayClip",
        client.motions().play_clip(play).await.map(|_| ()),
    ));
    let stop = pb::StopClipRequest {
        figure: figure.clone(),
        control_token: control_token.clone(),
        ..Default::default()
    };
    out.push((
        "StopClip",
        client.motions().stop_clip(stop).await.map(|_| ()),
    ));
    let reset = pb::ResetFigureRequest {
        name: figure.clone(),
        placement: None,
        control_token: control_token.clone(),
        ..Default::default()
    };
    out.push((
        "ResetFigure",
        client.figures().reset_figure(reset).await.map(|_| ()),
    ));
    let weaken = pb::UpdateFigureRequest {
        figure: Some(pb::Figure {
            name: figure.clone(),
            strength: Some(pb::StrengthScale {
                all: 0.01,
                ..Default::default()
            }),
            ..Default::default()
        }),
        update_mask: Some(prost_types::FieldMask {
            paths: vec!["strength".into()],
        }),
        control_token: control_token.clone(),
        ..Default::default()
    };
    out.push((
        "UpdateFigure",
        client.figures().update_figure(weaken).await.map(|_| ()),
    ));
    let release = pb::ReleaseControlRequest {
        figure: figure.clone(),
        control_token: control_token.clone(),
        ..Default::default()
    };
    out.push((
        "ReleaseControl",
        client.control().release_control(release).await.map(|_| ()),
    ));
    let transfer = pb::TransferControlRequest {
        figure: figure.clone(),
        control_token: control_token.clone(),
        ..Default::default()
    };
    out.push((
        "TransferControl",
        client
            .control()
            .transfer_control(transfer)
            .await
            .map(|_| ()),
    ));
    let accept = pb::AcceptControlRequest {
        figure,
        offer_token: control_token,
        ..Default::default()
    };
    out.push((
        "AcceptControl",
        client.control().accept_control(accept).await.map(|_| ()),
    ));
    out
}

#[tokio::test(flavor = "multi_thread")]
async fn a_stranger_and_a_rival_change_nothing_and_the_driver_sees_it() {
    let scene = Scene::new(true).await;
    let alice = scene.someone("alice").await;
    let lease = scene.acquire(&alice, "", 0).await.unwrap();
    let header = scene.header("alice", &[&lease.control_token]);
    scene
        .push(&alice, &header, (0..30).map(arm).collect())
        .await
        .unwrap();
    let mut events = scene.events().await;

    // A stranger, with any token.
    let stranger = scene.someone("mallory").await;
    for token in ["", "0123456789abcdef", &lease.control_token] {
        for (call, result) in attack(&scene, &stranger, token).await {
            let (code, reason) = refusal(&result.expect_err(call));
            assert_eq!(
                (code, reason.as_str()),
                (Code::PermissionDenied, "ROLE_REQUIRED"),
                "{call}"
            );
        }
    }
    let mut more = Vec::new();
    let name = scene.figure.clone();
    more.push(
        stranger
            .figures()
            .delete_figure(pb::DeleteFigureRequest {
                name,
                ..Default::default()
            })
            .await
            .map(|_| ()),
    );
    let name = scene.world.clone();
    more.push(
        stranger
            .worlds()
            .delete_world(pb::DeleteWorldRequest {
                name,
                ..Default::default()
            })
            .await
            .map(|_| ()),
    );
    let (name, speed) = (scene.world.clone(), 0.01);
    more.push(
        stranger
            .worlds()
            .set_world_speed(pb::SetWorldSpeedRequest { name, speed })
            .await
            .map(|_| ()),
    );
    for result in more {
        assert_eq!(refusal(&result.unwrap_err()).0, Code::PermissionDenied);
    }
    let told = events.next(pb::EventType::AccessRefused).await;
    assert_eq!(told.figure_id, "a");
    assert!(
        told.detail.starts_with("user:mallory: sinew.v1."),
        "{}",
        told.detail
    );

    // A rival may drive the figure, but has no valid token: guessed, stolen or none.
    let rival = scene.someone("rival").await;
    for token in ["0123456789abcdef", &lease.control_token] {
        for (call, result) in attack(&scene, &rival, token).await {
            let (code, reason) = refusal(&result.expect_err(call));
            assert_eq!(
                (code, reason.as_str()),
                (Code::Aborted, "CONTROL_FENCED"),
                "{call}"
            );
        }
    }
    for (call, result) in attack(&scene, &rival, "").await {
        let reason = refusal(&result.expect_err(call)).1;
        let lease_call = call.ends_with("Control");
        assert_eq!(
            reason,
            if lease_call {
                "CONTROL_FENCED"
            } else {
                "FIGURE_CONTROLLED"
            },
            "{call}"
        );
    }
    let e = scene.acquire(&rival, "", 0).await.unwrap_err();
    assert_eq!(refusal(&e).1, "FIGURE_CONTROLLED");
    let e = scene.acquire(&rival, "", 1).await.unwrap_err();
    assert_eq!(
        refusal(&e).1,
        "INVALID_FIELD",
        "its grant gives no priority"
    );

    // Nothing of it has reached the figure.
    scene.step(20).await;
    let feedback = scene.push(&alice, &header, vec![arm(30)]).await.unwrap();
    assert_eq!(feedback.figures[0].stale_count, 0);
    assert_eq!(feedback.received_sequence, 30);
    let name = scene.figure.clone();
    let found = alice
        .figures()
        .get_figure(pb::GetFigureRequest { name })
        .await
        .unwrap();
    let found = found.into_inner().figure.unwrap();
    assert!(found.strength.is_none_or(|s| s.all != 0.01));
    assert_eq!(found.status.unwrap().driver_id, "alice");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_higher_priority_takes_the_figure_and_every_further_frame_is_fenced() {
    let scene = Scene::new(true).await;
    let alice = scene.someone("alice").await;
    let first = scene.acquire(&alice, "", 0).await.unwrap();
    let header = scene.header("alice", &[&first.control_token]);
    let mut driver = alice.drive(header.clone()).await.unwrap();
    driver.send((0..30).map(arm).collect()).await;
    let mut events = scene.events().await;
    let director = scene.acquire(&scene.owner, "", 50).await.unwrap();
    let (before, after) = (first.lease.unwrap(), director.lease.unwrap());
    assert!(after.control_epoch > before.control_epoch);
    assert_eq!((after.holder.as_str(), after.priority), ("user:owner", 50));
    let told = events.next(pb::EventType::ControlPreempted).await;
    assert_eq!(
        (told.figure_id.as_str(), told.detail.as_str()),
        ("a", "user:owner from user:alice")
    );
    let e = loop {
        match driver.feedback().await {
            Ok(Some(_)) => {}
            Ok(None) => panic!("ended without a reason"),
            Err(e) => break e,
        }
    };
    assert_eq!(refusal(&e), (Code::Aborted, "CONTROL_FENCED".into()));
    let e = scene
        .push(&alice, &header, vec![arm(31)])
        .await
        .unwrap_err();
    assert_eq!(refusal(&e), (Code::Aborted, "CONTROL_FENCED".into()));
    // Once released, it is free for the next driver.
    let release = pb::ReleaseControlRequest {
        figure: scene.figure.clone(),
        control_token: director.control_token,
        ..Default::default()
    };
    scene
        .owner
        .control()
        .release_control(release)
        .await
        .unwrap();
    let told = events.next(pb::EventType::ControlReleased).await;
    assert_eq!(told.detail, "user:owner: given back");
    scene.acquire(&alice, "", 0).await.unwrap();
}

#[tokio::test(flavor = "multi_thread")]
async fn a_lost_driver_keeps_its_lease_for_the_grace_time_and_the_figure_stands() {
    let scene = Scene::new(false).await;
    let alice = scene.someone("alice").await;
    let request = pb::AcquireControlRequest {
        figure: scene.figure.clone(),
        grace_ms: 400.0,
        ..Default::default()
    };
    let lease = alice
        .control()
        .acquire_control(request)
        .await
        .unwrap()
        .into_inner();
    let header = pb::DriveHeader {
        grace_ms: Some(300.0),
        ..scene.header("alice", &[&lease.control_token])
    };
    let driver = alice.drive(header).await.unwrap();
    driver.send((0..30).map(arm).collect()).await;
    let get = || async {
        let figure = scene.figure.clone();
        let got = scene
            .owner
            .control()
            .get_control(pb::GetControlRequest { figure })
            .await;
        got.unwrap().into_inner().lease.unwrap()
    };
    assert_eq!(get().await.expire_time, None, "a stream uses it");
    let mut events = scene.events().await;
    // Its connection breaks; its lease does not.
    drop((driver, alice));
    let rival = scene.someone("rival").await;
    let e = scene.acquire(&rival, "", 0).await.unwrap_err();
    assert_eq!(refusal(&e).1, "FIGURE_CONTROLLED");
    events.next(pb::EventType::DriveEnded).await;
    let told = events.next(pb::EventType::ControlReleased).await;
    assert_eq!(told.detail, "user:alice: its time is over");
    assert_eq!(get().await.holder, "");
    scene.acquire(&rival, "", 0).await.unwrap();
}

#[tokio::test(flavor = "multi_thread")]
async fn a_driver_without_a_lease_has_its_figure_for_itself_all_the_same() {
    let scene = Scene::new(true).await;
    let (alice, rival) = (scene.someone("alice").await, scene.someone("rival").await);
    let header = scene.header("me", &[]);
    scene.push(&alice, &header, vec![arm(0)]).await.unwrap();
    // Another principal of the same name is another driver.
    let e = scene
        .push(&rival, &header, vec![arm(1_000_000)])
        .await
        .unwrap_err();
    assert_eq!(
        refusal(&e),
        (Code::FailedPrecondition, "FIGURE_CONTROLLED".into())
    );
    let e = scene.acquire(&rival, "", 0).await.unwrap_err();
    assert_eq!(refusal(&e).1, "FIGURE_CONTROLLED");
    // The driver itself may take the lease in the middle of its drive.
    let lease = scene.acquire(&alice, "", 0).await.unwrap();
    assert!(!lease.lease.unwrap().implicit);
    scene.push(&alice, &header, vec![arm(1)]).await.unwrap();
    // It may lose its token, not its figure: a new one fences the old one.
    let again = scene.acquire(&alice, "", 0).await.unwrap();
    assert_ne!(again.control_token, lease.control_token);
    let e = scene
        .acquire(&alice, &lease.control_token, 0)
        .await
        .unwrap_err();
    assert_eq!(refusal(&e), (Code::Aborted, "CONTROL_FENCED".into()));
}

/// A walk in progress, as a capture system at another place sends it: 120 frames per second.
pub struct Walker<'a> {
    pub header: pb::DriveHeader,
    pub posture: &'a (dyn Fn(f64) -> Posture + Sync),
    /// Place of the walker's stage.
    pub place: PlanarTransform,
    /// The walker's clock at the start, s.
    pub clock: f64,
    pub sent: i64,
}

impl Walker<'_> {
    /// Sends the frames captured until `now`, s. Returns the server's answer.
    pub async fn send(
        &mut self,
        scene: &Scene,
        client: &Client,
        from: f64,
        now: f64,
    ) -> Result<pb::DriveFeedback, Status> {
        let mut frames = Vec::new();
        while from + self.sent as f64 / 120.0 <= now {
            let t = from + self.sent as f64 / 120.0;
            let mut posture = (self.posture)(t);
            self.place.apply_posture(&mut posture);
            let mut motion = figure_motion("a", &posture, &[0.0; 45], None);
            motion.velocity.clear();
            frames.push(pb::MotionFrame {
                sequence: self.sent,
                source_time_ns: ((self.clock + t) * 1e9) as i64,
                figures: vec![motion],
            });
            self.sent += 1;
        }
        loop {
            match scene.push(client, &self.header, frames.clone()).await {
                // The test runs faster than real time, but the allowance of frames does not.
                Err(e) if e.code() == Code::ResourceExhausted => {
                    tokio::time::sleep(Duration::from_millis(20)).await;
                }
                other => return other,
            }
        }
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_figure_is_handed_over_in_mid_walk_without_a_fall_and_without_a_stop() {
    // At different phases of the gait, to a walker in the same phase, and to walkers in other phases.
    let cases = [
        (4.0, 0.0),
        (4.2, 0.01),
        (4.4, -0.02),
        (4.6, 0.04),
        (4.8, 0.15),
        (4.1, 0.55),
        (4.3, 0.35),
        (4.5, 0.75),
        (4.7, -0.15),
    ];
    for slowest in beside_each_other(cases).await {
        // It never stopped walking: a stand would be close to 0.
        assert!(slowest > 0.4, "slowest {slowest:.2} m/s");
    }
}

/// [`hand_over`] at these times and phases, all at the same time.
async fn beside_each_other(cases: impl IntoIterator<Item = (f64, f64)>) -> Vec<f64> {
    let runs = cases
        .into_iter()
        .map(|(offered, phase)| hand_over(offered, phase));
    let runs: Vec<_> = runs.map(tokio::spawn).collect();
    let mut slowest = Vec::new();
    for run in runs {
        slowest.push(run.await.unwrap());
    }
    slowest
}

/// Two walkers walk the same way, each on a separate stage, the second one `phase` s ahead; one hands the figure over
/// to the other at `offered` s. The figure does not fall, and walks again at the end. Returns its lowest speed in
/// between, m/s.
async fn hand_over(offered: f64, phase: f64) -> f64 {
    let scene = Scene::new(true).await;
    let (alice, bob) = (scene.someone("alice").await, scene.someone("bob").await);
    let body = Body::adult_man();
    let bvh = Bvh::parse(&corpus::piece("walk-normal.vrm", 1.8, 5.4)).unwrap();
    let clip = prepare_recording(
        &bvh.recording().unwrap(),
        &body,
        &RetargetOptions::default(),
    )
    .unwrap()
    .clip;
    let walk = cycle(&body, &clip).unwrap();
    let posture = |t: f64| walk.sample_looped(t).posture;
    let ahead = |t: f64| posture(t + phase);
    let lease = scene.acquire(&alice, "", 0).await.unwrap();
    let window = |header| pb::DriveHeader {
        preparation_window_ms: Some(500.0),
        playout_delay_ms: Some(80.0),
        nominal_rate_hz: 120.0,
        ..header
    };
    let mut first = Walker {
        header: pb::DriveHeader {
            reset: true,
            ..window(scene.header("alice", &[&lease.control_token]))
        },
        posture: &posture,
        place: PlanarTransform::default(),
        clock: 1000.0,
        sent: 0,
    };
    let mut second = Walker {
        header: window(scene.header("bob", &[])),
        posture: &ahead,
        // On a separate stage, seven metres away and turned by a third of a circle.
        place: PlanarTransform {
            x: 7.0,
            y: -2.0,
            yaw: 2.1,
        },
        clock: 5.0,
        sent: 0,
    };
    let mut events = scene.events().await;
    let begins = offered + 0.4;
    let mut fenced = None;
    let (mut slowest, mut last) = (f64::INFINITY, 0.0);
    for tick in (0..720).step_by(3) {
        let now = f64::from(tick) / 60.0;
        if fenced.is_none()
            && let Err(e) = first.send(&scene, &alice, 0.0, now).await
        {
            fenced = Some((now, refusal(&e).1));
        }
        if tick == (offered * 60.0).round() as i32 {
            let request = pb::TransferControlRequest {
                figure: scene.figure.clone(),
                control_token: lease.control_token.clone(),
                to: "user:bob".into(),
                blend_ms: 400.0,
                ..Default::default()
            };
            let offer = alice
                .control()
                .transfer_control(request)
                .await
                .unwrap()
                .into_inner();
            assert_eq!(offer.lease.unwrap().offered_to, "user:bob");
            let accept = pb::AcceptControlRequest {
                figure: scene.figure.clone(),
                offer_token: offer.offer_token,
                ..Default::default()
            };
            // Only the addressee can accept it.
            let rival = scene.someone("rival").await;
            let e = rival
                .control()
                .accept_control(accept.clone())
                .await
                .unwrap_err();
            assert_eq!(refusal(&e).1, "CONTROL_FENCED");
            let taken = bob
                .control()
                .accept_control(accept)
                .await
                .unwrap()
                .into_inner();
            second.header.control_tokens = vec![taken.control_token];
            let told = events.next(pb::EventType::ControlAcquired).await;
            assert_eq!(told.detail, "user:bob from user:alice");
        }
        if now >= begins {
            second.send(&scene, &bob, begins, now).await.unwrap();
        }
        scene.step(3).await;
        let (fallen, speed) = scene.seen().await;
        assert!(
            !fallen,
            "handed over at {offered} s, {phase} s ahead: fell at {now} s"
        );
        last = speed;
        if now > 2.0 {
            slowest = slowest.min(last);
        }
    }
    let (at, reason) = fenced.expect("the one before is fenced");
    assert_eq!(reason, "CONTROL_FENCED");
    assert!(
        at >= begins && at < begins + 1.7,
        "until the new motion was there: {at} s"
    );
    assert!(last > 0.5, "it walks at the end: {last:.2} m/s");
    slowest
}
