//! Goal: what a client gets for a clip is what `sinew survey` measures offline. Method: each recording is uploaded and
//! played with help by a figure that stands as the clip begins, and followed in a trial without a server; distances
//! from the recording, verdicts and help are equal.

use crate::support::TestServer;
use sinew_physics::body::{Body, NV, SEGMENT_COUNT};
use sinew_physics::figure::{FigureOptions, StrengthScale};
use sinew_physics::math::Vec3;
use sinew_physics::motion::leg_ik::forward;
use sinew_physics::motion::{Clip, GRAVITY};
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::{Preparation, RetargetOptions};
use sinew_physics::rehearsal::result::LOST;
use sinew_physics::rehearsal::trial::{Conditions, TrackingReference, Trial};
use sinew_physics::world::WorldParams;
use sinew_wire::convert::motion::figure_motion;
use sinew_wire::frame::values;
use sinew_wire::pb;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Largest force of the help over the weight.
const HELP: f64 = 0.3;
/// Ticks in which a figure settles in a stand.
const SETTLES: i32 = 60;
/// Ticks between two looks at a figure.
const EVERY: usize = 6;
/// Largest difference of the mean distances from the recording, m, and of the shares of help: world times are rounded,
/// and contacts amplify that.
const ALIKE: f64 = 1e-3;

/// A run, seen every [`EVERY`] ticks.
#[derive(Debug, Default)]
struct SampledRun {
    /// Mean distance of the segment origins from the recording while that lasts, m.
    distance: Vec<f64>,
    /// Impulse of the help over weight × time.
    help: f64,
}

impl SampledRun {
    fn farthest(&self) -> f64 {
        self.distance.iter().copied().fold(0.0, f64::max)
    }

    fn mean(&self) -> f64 {
        self.distance.iter().sum::<f64>() / self.distance.len() as f64
    }

    fn look(&mut self, recorded: &Clip, body: &Body, time: f64, at: &[Vec3; SEGMENT_COUNT]) {
        if (0.0..=recorded.duration()).contains(&time) {
            let wanted = forward(body, &recorded.sample(time).posture);
            let far = |s: usize| (at[s] - wanted[s].0).norm();
            let sum = (0..SEGMENT_COUNT).map(far).sum::<f64>();
            self.distance.push(sum / SEGMENT_COUNT as f64);
        }
    }
}

/// A recording as fitted and as the server prepares it.
fn read(bytes: &[u8], body: &Body) -> TrackingReference {
    let recording = sinew_physics::motion::read(bytes).unwrap();
    let prepared = |preparation| {
        let options = RetargetOptions {
            preparation,
            ..RetargetOptions::default()
        };
        prepare_recording(&recording, body, &options).unwrap()
    };
    let recorded = prepared(Preparation::NONE);
    TrackingReference {
        phases: recorded.report.feet.phases,
        recorded: Arc::new(recorded.clip),
        prepared: Arc::new(prepared(Preparation::walking(true)).clip),
    }
}

fn offline(body: &Arc<Body>, reference: &TrackingReference) -> SampledRun {
    let conditions = Conditions {
        body: Arc::clone(body),
        world: WorldParams::default(),
        strength: StrengthScale::default(),
        options: FigureOptions {
            max_help: HELP,
            ..FigureOptions::default()
        },
        perturbations: Vec::new(),
        live_window: None,
        rehearsed: None,
    };
    let mut trial = Trial::new(&conditions, reference).unwrap();
    let mut run = SampledRun::default();
    let mut impulse = 0.0;
    let mut ticks = 0;
    while let Some(time) = trial.step() {
        ticks += 1;
        let figure = trial.figure();
        let [.., x, y, z] = figure.report().unwrap().assist;
        impulse += Vec3 { x, y, z }.norm() * trial.world().dt();
        if ticks % EVERY == 0 {
            let at = forward(body, &figure.state().posture).map(|(p, _)| p);
            run.look(&reference.recorded, body, time, &at);
        }
    }
    run.help = impulse / (body.profile.mass * GRAVITY * trial.world().time().0);
    run
}

/// Segment origins of the only figure of a world.
async fn look(server: &TestServer, world: &str) -> [Vec3; SEGMENT_COUNT] {
    let mut frame = server.frame(world, &["segment_transforms"]).await;
    let poses = values(&frame.figures.remove(0).segment_transforms.unwrap());
    std::array::from_fn(|s| Vec3::from_array([0, 1, 2].map(|i| poses[7 * s + i])))
}

async fn upload(server: &TestServer, id: &str, source: pb::create_clip_request::Source) {
    let make = pb::CreateClipRequest {
        clip_id: id.into(),
        source: Some(source),
        ..Default::default()
    };
    server.client.motions().create_clip(make).await.unwrap();
}

async fn served(server: &TestServer, bytes: Vec<u8>, reference: &TrackingReference) -> SampledRun {
    let body = Body::adult_man();
    let clip = &reference.prepared;
    let first = clip.sample(-clip.lead_in()).posture;
    let stand = || figure_motion("", &first, &[0.0; NV], None);
    let stand = pb::FrameSource {
        rate_hz: 60.0,
        frames: vec![stand(); 2],
    };
    let file = pb::BvhSource {
        data: bytes.into(),
        options: None,
    };
    upload(
        server,
        "stand",
        pb::create_clip_request::Source::Frames(stand),
    )
    .await;
    upload(server, "clip", pb::create_clip_request::Source::Bvh(file)).await;
    let world = server.paused_world("w").await;
    server.figure(&world, "a").await;
    let name = format!("{world}/figures/a");
    let play = |clip: &str| pb::PlayClipRequest {
        figure: name.clone(),
        clip: format!("clips/{clip}"),
        placement: Some(pb::Placement {
            x_m: first.root_position.x,
            y_m: first.root_position.y,
            yaw_rad: first.root_rotation.heading(),
        }),
        reset: true,
        follow: pb::Follow::Assisted.into(),
        max_help_weights: Some(HELP),
        ..Default::default()
    };
    let mut request = play("clip");
    if clip.lead_in() > 0.0 {
        let stand = server.client.motions().play_clip(play("stand")).await;
        stand.unwrap();
        server.step(&world, SETTLES).await;
        request.reset = false;
    }
    let began = server.client.motions().play_clip(request).await.unwrap();
    let start = began.into_inner().start;
    let at_once = [pb::ClipStart::Reset, pb::ClipStart::AtOnce];
    assert!(at_once.contains(&pb::ClipStart::try_from(start).unwrap()));
    let before = server.look(&name).await.status.unwrap();
    let from = before.help_newton_seconds;
    let length = clip.lead_in() + clip.duration() + clip.lead_out() + 1.0;
    let mut run = SampledRun::default();
    let mut time = -clip.lead_in();
    let mut left = (length * 60.0).round() as usize;
    while left > 0 {
        let ticks = left.min(EVERY);
        server.step(&world, ticks as i32).await;
        left -= ticks;
        time += ticks as f64 / 60.0;
        let at = look(server, &world).await;
        run.look(&reference.recorded, &body, time, &at);
    }
    let status = server.look(&name).await.status.unwrap();
    let help = status.help_newton_seconds - from;
    run.help = help / (body.profile.mass * GRAVITY * length);
    let delete = pb::DeleteWorldRequest {
        name: world,
        ..Default::default()
    };
    server.client.worlds().delete_world(delete).await.unwrap();
    for clip in ["stand", "clip"] {
        let delete = pb::DeleteClipRequest {
            name: format!("clips/{clip}"),
            ..Default::default()
        };
        server.client.motions().delete_clip(delete).await.unwrap();
    }
    run
}

async fn compare(folder: &Path) {
    let server = TestServer::start().await;
    let body = Arc::new(Body::adult_man());
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|f| f.unwrap().path())
        .filter(|f| f.extension().is_some_and(|e| e == "bvh"))
        .collect();
    files.sort();
    assert!(!files.is_empty());
    let mut different = Vec::new();
    for file in &files {
        let bytes = std::fs::read(file).unwrap();
        let reference = read(&bytes, &body);
        let (mine, theirs) = (
            offline(&body, &reference),
            served(&server, bytes, &reference).await,
        );
        let name = file.file_name().unwrap().to_string_lossy();
        let text = format!(
            "{name}: offline {:.3} m at most, {:.3} m on average, help {:.4}; served {:.3}, {:.3}, {:.4}",
            mine.farthest(),
            mine.mean(),
            mine.help,
            theirs.farthest(),
            theirs.mean(),
            theirs.help
        );
        let [a, b] = [&mine, &theirs].map(|c| c.farthest() > LOST);
        let alike = (mine.mean() - theirs.mean()).abs() < ALIKE;
        let helped = (mine.help - theirs.help).abs() < ALIKE;
        // A fall is chaotic.
        if a != b || !(a || alike && helped) {
            different.push(text);
        }
    }
    assert!(different.is_empty(), "{different:#?}");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_clip_is_followed_over_the_api_as_it_is_offline() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    compare(&root.join("tests/corpus")).await;
}

/// The same with the recordings of docs/corpus.md.
#[ignore = "needs recordings: make recordings"]
#[tokio::test(flavor = "multi_thread")]
async fn a_recording_is_followed_over_the_api_as_it_is_offline() {
    let folders = std::env::var_os("SINEW_MOCAP_DIR").expect("SINEW_MOCAP_DIR is set");
    for folder in std::env::split_paths(&folders) {
        compare(&folder).await;
    }
}
