//! Goal: a figure that has fallen gets up when its motion does, within its strength, and nothing else makes it try. Method: the recording
//! `get-up` (lies prone, stands after 3 s), falls from pushes, and the built-in way up judged by itself.

use crate::common::{Scene, authored, figure, man, play, recorded};
use crate::vec3;
use sinew::sim::body::Body;
use sinew::sim::body::topology::{CHEST, L_FOOT, L_TOES, R_FOOT, R_TOES, SegmentId};
use sinew::sim::figure::{ClipPlayback, ControllerKind, FigureEvent, Flags, Perturbation};
use sinew::sim::math::Vec3;
use std::sync::Arc;

/// Feet and toes.
const FEET: [SegmentId; 4] = [L_FOOT, L_TOES, R_FOOT, R_TOES];

/// Strength that suffices to get up from the belly.
const STRONG: f64 = 1.5;

/// What came of `get-up`, played from its first frame for `seconds`.
struct Outcome {
    scene: Scene,
    /// When it stood, s.
    up: Option<f64>,
    /// Largest relative violation of strength, and deepest point in the floor, m.
    over: f64,
    depth: f64,
}

/// Runs on and looks at everything that must hold at all times.
fn watch(mut scene: Scene, seconds: f64) -> Outcome {
    let (mut up, mut over, mut depth) = (None, 0.0f64, 0.0f64);
    scene.run(seconds, |s| {
        let f = s.figure();
        let r = f.report().unwrap();
        assert!(f.state().is_finite());
        assert!(!r.flags.has(Flags::QUARANTINED));
        assert!(r.assist.iter().all(|a| *a == 0.0));
        (over, depth) = (over.max(r.over_limit), depth.max(r.penetration));
        if f.events().contains(&FigureEvent::GotUp) {
            up = Some(s.world.time());
        }
        if f.events().contains(&FigureEvent::Fell) {
            up = None;
        }
    });
    Outcome {
        scene,
        up,
        over,
        depth,
    }
}

fn get_up(body: &Arc<Body>, strength: f64, seconds: f64) -> Outcome {
    let clip = recorded(body, "get-up");
    let mut setup = figure(body, ControllerKind::Modern, clip.sample(0.0).state());
    setup.strength.all = strength;
    let mut scene = Scene::of(setup);
    scene.figure_mut().set_drive(play(&clip));
    watch(scene, seconds)
}

#[test]
fn who_lies_as_his_motion_lies_gets_up_when_it_does_and_stays_up() {
    let out = get_up(&man(), STRONG, 45.0);
    let up = out.up.expect("it gets up");
    let f = out.scene.figure();
    let report = f.report().unwrap();
    let standing = out.scene.world.time() - up;
    println!(
        "up at {up:.2} s, {:.1e} over strength, {:.1} mm deep",
        out.over,
        1e3 * out.depth
    );
    assert!(standing > 5.0, "stands for {standing:.1} s only");
    assert!(!f.is_fallen() && !report.flags.has(Flags::BALANCE_LOST));
    assert!(report.com.z > 0.9, "{}", report.com.z);
    assert!(report.contacts.iter().all(|c| FEET.contains(&c.segment)));
    assert!(out.over < 1e-9, "{}", out.over);
    assert!(out.depth < 0.02, "{}", out.depth);
}

#[test]
fn who_is_too_weak_stays_down() {
    let out = get_up(&man(), 0.3, 30.0);
    assert!(out.up.is_none());
    let f = out.scene.figure();
    assert!(f.is_fallen() && f.report().unwrap().com.z < 0.3);
    assert!(out.over < 1e-9, "{}", out.over);
}

#[test]
fn a_fall_is_no_command_to_get_up() {
    let body = man();
    let clip = authored(&body, "idle");
    let mut scene = Scene::playing(&body, ControllerKind::Modern, &clip);
    let push = Perturbation::Force {
        segment: CHEST,
        point: vec3(0.0, 0.0, 0.1),
        force: vec3(1500.0, 0.0, 0.0),
        from: 0.5,
        to: 0.7,
    };
    scene.world.perturb(scene.key, push).unwrap();
    let out = watch(scene, 6.0);
    assert!(out.scene.figure().is_fallen() && out.up.is_none());
    // Limp: nothing moves any more, though the motion stands.
    let mut scene = out.scene;
    let mut fastest = 0.0f64;
    scene.run(2.0, |s| {
        let v = &s.figure().state().velocity;
        fastest = v.iter().fold(fastest, |m, v| m.max(v.abs()));
    });
    assert!(fastest < 0.5, "{fastest}");
}

/// Felled on its face under a clip that stands, it stays down until another one is played that lies there and rises.
#[test]
fn who_was_felled_gets_up_when_a_clip_that_does_is_played() {
    let body = man();
    let idle = authored(&body, "idle");
    let mut setup = figure(&body, ControllerKind::Modern, idle.sample(0.0).state());
    setup.strength.all = STRONG;
    let mut scene = Scene::of(setup);
    scene.figure_mut().set_drive(play(&idle));
    let push = Perturbation::Force {
        segment: CHEST,
        point: vec3(0.0, 0.0, 0.1),
        force: vec3(500.0, 0.0, 0.0),
        from: 0.5,
        to: 0.7,
    };
    scene.world.perturb(scene.key, push).unwrap();
    let out = watch(scene, 6.0);
    let felled = out.scene.figure();
    let front = felled.state().posture.root_rotation.rotate(Vec3::X);
    assert!(
        felled.is_fallen() && out.up.is_none() && front.z < -0.8,
        "{front:?}"
    );
    let mut scene = out.scene;
    let now = scene.world.time();
    let clip = ClipPlayback::new(recorded(&body, "get-up"), now);
    scene.figure_mut().play(clip, false, now);
    let out = watch(scene, 60.0);
    println!("up at {:?} s", out.up);
    assert!(out.up.is_some() && !out.scene.figure().is_fallen());
}
