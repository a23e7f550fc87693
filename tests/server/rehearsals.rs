//! Goal: a rehearsal of a clip is played by a figure like the one for which it was made, is visible in its frames, and
//! survives a restart of the server. Method: a body slides on its soles, which is impossible without help; the clip is
//! short, so that help is found soon; then the directory is damaged.

use crate::support::TestServer;
use sinew_physics::body::Body;
use sinew_physics::motion::builtin::at_ease;
use sinew_wire::convert::motion::figure_motion;
use sinew_wire::frame::values;
use sinew_wire::pb;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

const FIGURE: &str = "worlds/w/figures/a";
/// Frames of the clip, 60 per second.
const FRAMES: i64 = 40;
/// Frames in which it would come to a stand; it ends earlier, in motion.
const MOVES: f64 = 50.0;
/// Number of ticks after which it is over.
const TICKS: usize = 240;
/// Largest help, in weights.
const HELP: f64 = 2.0;
/// Paths closer than this count as equal, and those farther apart as different, m.
const SAME: f64 = 1e-3;
const OTHER: f64 = 0.05;
/// Bit of `status.flags`.
const FALLEN: i32 = 1 << 6;

/// A body at ease slides forward from a stand, faster than it could walk.
fn slide(id: &str) -> pb::CreateClipRequest {
    slide_from(id, 0)
}

/// The same from a later frame on, in motion.
fn slide_from(id: &str, first: i64) -> pb::CreateClipRequest {
    let body = Body::adult_man();
    let frame = |i: i64| {
        let mut posture = at_ease(&body);
        let u = (i as f64 / MOVES).min(1.0);
        posture.root_position.x += 1.35 * u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
        let mut motion = figure_motion("", &posture, &[0.0; 45], None);
        motion.velocity.clear();
        motion
    };
    pb::CreateClipRequest {
        clip_id: id.into(),
        source: Some(pb::create_clip_request::Source::Frames(pb::FrameSource {
            rate_hz: 60.0,
            frames: (first..FRAMES).map(frame).collect(),
        })),
        follow: pb::Follow::Assisted.into(),
        max_help_weights: Some(HELP),
        ..Default::default()
    }
}

/// A server with a paused world and a figure in it.
async fn start(settings: &[(&str, &str)]) -> TestServer {
    let server = TestServer::with(settings).await;
    server.app.restore().await;
    server
}

/// Rehearses a clip until the result is better than help during tracking; the time that this takes depends on the load
/// of the machine.
async fn rehearse(server: &TestServer, clip: &str) -> pb::Rehearsal {
    for seconds in [10, 20, 40] {
        let found = rehearse_for(server, clip, seconds).await;
        if found.way() != pb::FollowWay::Lost && !found.reason.contains("while it is being lost") {
            return found;
        }
    }
    rehearse_for(server, clip, 80).await
}

async fn rehearse_for(server: &TestServer, clip: &str, seconds: i64) -> pb::Rehearsal {
    let request = pb::RehearseClipRequest {
        clip: format!("clips/{clip}"),
        figure: FIGURE.into(),
        budget: Some(prost_types::Duration { seconds, nanos: 0 }),
        ..Default::default()
    };
    let done = server.client.motions().rehearse_clip(request).await;
    done.unwrap().into_inner().rehearsal.unwrap()
}

/// A clip as it was played.
#[derive(Clone, Debug)]
struct Played {
    /// Pose of the pelvis after each tick.
    path: Vec<f64>,
    /// Largest help, N·m or N.
    help: f64,
    fallen: bool,
    /// Ways in which it was followed, according to its frames.
    ways: BTreeSet<pb::FollowWay>,
    /// Status of the figure after the last tick.
    status: pb::FigureStatus,
}

impl Played {
    /// Largest difference from `other` within the first `ticks`, m or quaternion components.
    fn off(&self, other: &Self, ticks: usize) -> f64 {
        let pairs = self.path.iter().zip(&other.path).take(7 * ticks);
        pairs.fold(0.0, |m, (a, b)| m.max((a - b).abs()))
    }

    /// Whether it equals `other`. A fall amplifies the rounding of world time, so it is not compared to its end.
    fn is(&self, other: &Self) -> bool {
        self.off(other, 100) < SAME
    }
}

/// Plays a clip from the same stand each time.
async fn played(server: &TestServer, clip: &str, follow: pb::Follow) -> Played {
    let request = pb::PlayClipRequest {
        clip: format!("clips/{clip}"),
        follow: follow.into(),
        ..Default::default()
    };
    played_as(server, request).await.1
}

/// [`played`] by a request for it, with its answer.
async fn played_as(
    server: &TestServer,
    mut request: pb::PlayClipRequest,
) -> (pb::PlayClipResponse, Played) {
    let reset = pb::ResetFigureRequest {
        name: FIGURE.into(),
        ..Default::default()
    };
    server.client.figures().reset_figure(reset).await.unwrap();
    request.figure = FIGURE.into();
    let answer = server.client.motions().play_clip(request).await;
    let mut out = Played {
        path: Vec::new(),
        help: 0.0,
        fallen: false,
        ways: BTreeSet::new(),
        status: pb::FigureStatus::default(),
    };
    for _ in 0..TICKS {
        server.step("worlds/w", 1).await;
        let fields = ["root_pose", "assist", "status"];
        let frame = server.frame("worlds/w", &fields).await;
        let f = &frame.figures[0];
        out.path.extend(values(f.root_pose.as_ref().unwrap()));
        let help = values(f.assist.as_ref().unwrap());
        out.help = help.iter().fold(out.help, |m, x| m.max(x.abs()));
        let status = f.status.as_ref().unwrap();
        out.fallen |= status.flags & FALLEN != 0;
        out.ways.insert(status.following());
    }
    out.status = server.look(FIGURE).await.status.unwrap();
    (answer.unwrap().into_inner(), out)
}

/// The files of rehearsals in a data directory.
fn files(folder: &Path) -> Vec<PathBuf> {
    let all = std::fs::read_dir(folder.join("rehearsals")).unwrap();
    all.map(|f| f.unwrap().path()).collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_figure_does_what_was_rehearsed_for_it_also_after_a_restart() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("rehearsals");
    let _ = std::fs::remove_dir_all(&folder); // of an earlier run
    let settings = [("data_dir", folder.to_str().unwrap())];
    let first = start(&settings).await;
    first.paused_world("w").await;
    first.figure("worlds/w", "a").await;
    let made = first.client.motions().create_clip(slide("slide")).await;
    made.unwrap();
    let plain = played(&first, "slide", pb::Follow::Assisted).await;
    let found = rehearse(&first, "slide").await;
    let way = found.way();
    assert!(
        matches!(way, pb::FollowWay::Helped | pb::FollowWay::Rehearsed),
        "{found:?}"
    );
    assert!(found.reason.starts_with("plain tracking loses it"));
    assert!(found.help_peak_newtons <= HELP * 900.0);

    // It follows its rehearsal, which frames show while it is helped, and moves as before if no rehearsal is requested.
    let helped = way == pb::FollowWay::Helped;
    let follows = played(&first, "slide", pb::Follow::Assisted).await;
    let off = follows.off(&plain, TICKS);
    assert!(off > OTHER, "{off}");
    assert_eq!(helped, follows.help > 20.0, "{}", follows.help);
    assert!(follows.ways.contains(&way), "{:?}", follows.ways);
    assert_eq!(helped, follows.status.help_newton_seconds > 0.0);
    let strict = played(&first, "slide", pb::Follow::Strict).await;
    assert!(strict.is(&plain) && strict.help == 0.0);
    let alone = [pb::FollowWay::Unspecified, pb::FollowWay::Tracked];
    assert!(strict.ways.iter().eq(&alone), "{:?}", strict.ways);
    assert_eq!(strict.status.help_newton_seconds, 0.0);
    let strong = played(&first, "slide", pb::Follow::Rehearsed).await;
    assert!(strong.is(if helped { &plain } else { &follows }));
    assert_eq!(files(&folder).len(), 1);
    first.stop().await;

    let second = start(&settings).await;
    let again = played(&second, "slide", pb::Follow::Assisted).await;
    assert!(again.is(&follows), "{}", again.off(&follows, 100));
    assert_eq!(again.fallen, follows.fallen);
    second.stop().await;

    // A damaged rehearsal is ignored. The clip exists, and can be rehearsed again, which repairs the file.
    let file = files(&folder).remove(0);
    let mut bytes = std::fs::read(&file).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 4;
    std::fs::write(&file, &bytes).unwrap();
    let third = start(&settings).await;
    let without = played(&third, "slide", pb::Follow::Assisted).await;
    assert!(without.is(&plain));
    rehearse(&third, "slide").await;
    let again = played(&third, "slide", pb::Follow::Assisted).await;
    assert!(again.off(&plain, TICKS) > OTHER);
    assert_eq!(files(&folder), [file]);

    // They are deleted with their clip, and a new clip of the same name has none.
    let delete = pb::DeleteClipRequest {
        name: "clips/slide".into(),
        ..Default::default()
    };
    third.client.motions().delete_clip(delete).await.unwrap();
    assert!(files(&folder).is_empty());
    third.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_clip_that_begins_in_motion_is_played_as_it_was_rehearsed() {
    let server = start(&[]).await;
    server.paused_world("w").await;
    server.figure("worlds/w", "a").await;
    let made = server
        .client
        .motions()
        .create_clip(slide_from("slide", 15))
        .await;
    made.unwrap();
    let found = rehearse(&server, "slide").await;
    assert!(found.begins_in_motion, "{found:?}");
    let request = pb::PlayClipRequest {
        clip: "clips/slide".into(),
        ..Default::default()
    };
    let reset = pb::PlayClipRequest {
        reset: true,
        ..request.clone()
    };
    let (answer, put) = played_as(&server, reset.clone()).await;
    assert!(answer.rehearsed && answer.start() == pb::ClipStart::Reset);
    let (_, again) = played_as(&server, reset.clone()).await;
    assert!(put.is(&again), "{}", put.off(&again, 100));
    assert!(put.ways.contains(&found.way()), "{:?}", put.ways);

    // From a stand only with help, and the answer says so.
    let (answer, led) = played_as(&server, request.clone()).await;
    assert!(answer.rehearsed && answer.start() == pb::ClipStart::Led);
    assert!(led.ways.contains(&found.way()), "{:?}", led.ways);
    let strict = pb::PlayClipRequest {
        follow: pb::Follow::Strict.into(),
        ..reset
    };
    let (answer, plain) = played_as(&server, strict).await;
    assert!(!answer.rehearsed && answer.start() == pb::ClipStart::Reset);
    assert!(plain.help == 0.0 && plain.off(&put, 60) > SAME);
    let alone = pb::PlayClipRequest {
        max_help_weights: Some(0.0),
        ..request
    };
    let (answer, _) = played_as(&server, alone).await;
    let own = [pb::ClipStart::AtOnce, pb::ClipStart::Switch];
    assert!(
        !answer.rehearsed && own.contains(&answer.start()),
        "{answer:?}"
    );
    server.stop().await;
}
