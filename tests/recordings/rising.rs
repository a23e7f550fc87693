//! Goal: a figure that has fallen gets up when its motion does, within its strength, and nothing else makes it try.
//! Method: the recordings `get-up` (lies prone, stands after 3 s) and `fall-rise` (falls onto its back, stands after 7
//! s), as clips and as a stream, and falls from pushes.

use crate::common::{Scene, authored, figure, man, people, play, recorded, recorded_with};
use crate::vec3;
use sinew_physics::body::topology::{CHEST, L_FOOT, L_TOES, R_FOOT, R_TOES, SegmentId};
use sinew_physics::body::{Body, Sex};
use sinew_physics::figure::{ControllerKind, FigureEvent, Flags, Perturbation};
use sinew_physics::math::Vec3;
use sinew_physics::plan::stream::{RATE, StreamPlan};
use sinew_physics::reference::{Preparation, RetargetOptions};
use sinew_physics::time::{StreamTime, WorldTime};
use sinew_physics::world::{ClipPlayback, LivePlayback, MotionSource, WorldParams};
use std::sync::Arc;

/// Feet and toes.
const FEET: [SegmentId; 4] = [L_FOOT, L_TOES, R_FOOT, R_TOES];

/// Result of `get-up`, played from its first frame for `seconds`.
struct Outcome {
    scene: Scene,
    /// Time at which it stood, s.
    up: Option<f64>,
    /// Largest relative violation of strength, and deepest point in the floor, m.
    over: f64,
    depth: f64,
}

/// Continues the run and checks everything that must always hold.
fn watch(mut scene: Scene, seconds: f64) -> Outcome {
    let (mut up, mut over, mut depth) = (None, 0.0f64, 0.0f64);
    scene.run(seconds, |s| {
        let f = s.figure();
        let r = f.report().unwrap();
        assert!(f.state().is_finite());
        assert!(!r.flags.has(Flags::QUARANTINED));
        assert!(r.assist.iter().all(|a| *a == 0.0));
        (over, depth) = (over.max(r.joints.over_limit), depth.max(r.penetration));
        if f.events().contains(&FigureEvent::GotUp) {
            up = Some(s.world.time().0);
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
    get_up_in(WorldParams::default(), body, strength, seconds)
}

fn get_up_in(params: WorldParams, body: &Arc<Body>, strength: f64, seconds: f64) -> Outcome {
    let clip = recorded(body, "get-up");
    let mut setup = figure(body, ControllerKind::Modern, clip.sample(0.0).state());
    setup.strength.all = strength;
    let mut scene = Scene::with(params, setup);
    scene.figure_mut().set_drive(play(&clip));
    watch(scene, seconds)
}

/// The figure stands playing `idle`, is pushed at the chest for 0.2 s, and runs for six more seconds.
fn felled(body: &Arc<Body>, force: Vec3) -> Outcome {
    let clip = authored(body, "idle");
    let mut scene = Scene::playing(body, ControllerKind::Modern, &clip);
    let push = Perturbation::Force {
        segment: CHEST,
        point: vec3(0.0, 0.0, 0.1),
        force,
        from: 0.5,
        to: 0.7,
    };
    scene.world.perturb(scene.key, push).unwrap();
    watch(scene, 6.0)
}

/// Plays `get-up` on a lying figure, for `seconds`.
fn command(mut scene: Scene, seconds: f64) -> Outcome {
    let now = scene.world.time();
    let clip = recorded(scene.figure().body(), "get-up");
    let clip = ClipPlayback::new(clip, now);
    scene.figure_mut().play(clip, false, now);
    watch(scene, seconds)
}

#[test]
fn who_lies_as_his_motion_lies_gets_up_when_it_does_and_stays_up() {
    let out = get_up(&man(), 1.0, 32.0);
    let up = out.up.expect("it gets up");
    let f = out.scene.figure();
    let report = f.report().unwrap();
    let standing = out.scene.world.time().0 - up;
    println!(
        "up at {up:.2} s, {:.1e} over strength, {:.1} mm deep",
        out.over,
        1e3 * out.depth
    );
    assert!(standing > 5.0, "stands for {standing:.1} s only");
    assert!(!f.is_fallen() && !report.flags.has(Flags::BALANCE_LOST));
    assert!(report.balance.com.z > 0.9, "{}", report.balance.com.z);
    assert!(report.contacts.iter().all(|c| FEET.contains(&c.segment)));
    assert!(out.over < 1e-9, "{}", out.over);
    assert!(out.depth < 0.02, "{}", out.depth);
}

#[test]
fn who_is_too_weak_stays_down() {
    let out = get_up(&man(), 0.3, 30.0);
    assert!(out.up.is_none());
    let f = out.scene.figure();
    assert!(f.is_fallen() && f.report().unwrap().balance.com.z < 0.3);
    assert!(out.over < 1e-9, "{}", out.over);
}

/// Average strength suffices for all these people.
#[test]
fn average_strength_suffices_for_men_and_women_of_all_sizes() {
    for strength in [0.8, 0.9, 1.1, 1.2, 1.5, 2.0, 3.0] {
        let out = get_up(&man(), strength, 30.0);
        println!("{strength} of his strength: {:?} s", out.up);
        assert!(out.up.is_some(), "{strength} of his strength");
    }
    let others = people(&[
        (Sex::Female, 30.0, 1.63, 62.0),
        (Sex::Female, 30.0, 1.5, 50.0),
        (Sex::Male, 30.0, 1.55, 58.0),
        (Sex::Male, 30.0, 1.95, 95.0),
    ]);
    for body in &others {
        let out = get_up(body, 1.0, 30.0);
        println!("{:?}: {:?} s", body.profile, out.up);
        assert!(out.up.is_some(), "{:?}", body.profile);
    }
}

#[test]
fn neither_friction_nor_the_rate_decides_who_gets_up() {
    for (rate_hz, friction) in [(60.0, 0.7), (60.0, 1.0), (50.0, 0.9), (120.0, 0.9)] {
        let params = WorldParams {
            rate_hz,
            friction,
            ..WorldParams::default()
        };
        let out = get_up_in(params, &man(), 1.0, 30.0);
        println!("{rate_hz} Hz, friction {friction}: {:?} s", out.up);
        assert!(out.up.is_some(), "{rate_hz} Hz, friction {friction}");
    }
}

/// The clip ends on its back or side: it rolls over first. Rolling may take any number of tries.
#[test]
fn who_lies_on_the_back_rolls_over_and_gets_up() {
    let clip = recorded(&man(), "fall-rise");
    let lead = clip.lead_in();
    let mut setup = figure(&man(), ControllerKind::Modern, clip.sample(-lead).state());
    setup.strength.all = 1.0;
    let mut scene = Scene::of(setup);
    let clip = ClipPlayback::new(clip, WorldTime(lead));
    scene.figure_mut().set_drive(MotionSource::Clip(clip));
    let mut on_back = false;
    scene.run(9.0, |s| {
        let front = s.figure().state().posture.root_rotation.rotate(Vec3::X);
        on_back |= s.figure().is_fallen() && front.z > 0.7;
    });
    assert!(on_back && scene.figure().is_fallen());
    let out = watch(scene, 80.0);
    println!("up at {:?} s", out.up);
    assert!(out.up.is_some() && !out.scene.figure().is_fallen());
    assert!(out.over < 1e-9, "{}", out.over);
}

/// 300 N·s from eight directions: face, back and sides.
#[test]
fn most_who_were_felled_get_up() {
    let (mut up, mut backs) = (0, 0);
    for k in 0..8 {
        let (s, c) = (f64::from(k) * std::f64::consts::FRAC_PI_4).sin_cos();
        let out = felled(&man(), vec3(1500.0 * c, 1500.0 * s, 0.0));
        assert!(out.scene.figure().is_fallen());
        let front = out.scene.figure().state().posture.root_rotation;
        let back = front.rotate(Vec3::X).z > 0.5;
        let out = command(out.scene, 90.0);
        println!("{} deg, on its back: {back}: up at {:?} s", 45 * k, out.up);
        up += u32::from(out.up.is_some());
        backs += u32::from(back && out.up.is_some());
        assert!(out.over < 1e-9, "{}", out.over);
    }
    assert!(up >= 6 && backs >= 1, "{up} of 8, {backs} from the back");
}

/// A clip that waits until its figure stands commands like any other.
#[test]
fn a_queued_clip_that_lies_and_rises_commands_getting_up() {
    let body = man();
    let walk = recorded(&body, "walk");
    let mut scene = Scene::playing(&body, ControllerKind::Modern, &walk);
    scene.run(1.0, |_| ());
    let now = scene.world.time();
    let clip = ClipPlayback::new(recorded(&body, "get-up"), now);
    scene.figure_mut().play(clip, false, now);
    assert!(scene.figure().next_clip().is_some(), "it waits");
    // Told to lie down at once, it falls; whether it gets up from there is not tested here.
    let (mut fell, mut rises) = (false, false);
    scene.run(10.0, |s| {
        fell |= s.figure().events().contains(&FigureEvent::Fell);
        rises |= fell && s.figure().rising().is_some();
    });
    assert!(scene.figure().next_clip().is_none(), "it has begun");
    assert!(fell && rises, "fell: {fell}, gets up: {rises}");
}

/// A stream commands getting up as a clip does.
#[test]
fn who_lies_under_a_stream_gets_up_when_it_does() {
    let body = man();
    let raw = RetargetOptions {
        preparation: Preparation::NONE,
        ..RetargetOptions::default()
    };
    let clip = recorded_with(&body, "get-up", &raw);
    let mut motion = StreamPlan::new(Arc::clone(&body), 0.5);
    let mut fed = 0.0;
    while fed / RATE <= motion.window() {
        motion.push(&clip.sample(fed / RATE).posture, None);
        fed += 1.0;
    }
    motion.advance(StreamTime(1.0 / RATE));
    let setup = figure(&body, ControllerKind::Modern, clip.sample(0.0).state());
    let mut scene = Scene::of(setup);
    let live = LivePlayback {
        motion,
        offset: 0.0,
    };
    scene
        .figure_mut()
        .set_drive(MotionSource::Live(Box::new(live)));
    let mut up = None;
    for _ in 0..scene.ticks(40.0) {
        if let Some(live) = scene.figure_mut().stream_mut() {
            for _ in 0..(RATE / 60.0) as u32 {
                live.motion.push(&clip.sample(fed / RATE).posture, None);
                fed += 1.0;
            }
        }
        scene.world.step();
        if scene.figure().events().contains(&FigureEvent::GotUp) {
            up = Some(scene.world.time().0);
        }
    }
    println!("up at {up:?} s");
    assert!(up.is_some() && !scene.figure().is_fallen());
}

#[test]
fn a_fall_is_no_command_to_get_up() {
    let out = felled(&man(), vec3(1500.0, 0.0, 0.0));
    assert!(out.scene.figure().is_fallen() && out.up.is_none());
    // Limp: nothing moves any more, although the motion stands.
    let mut scene = out.scene;
    let mut fastest = 0.0f64;
    scene.run(2.0, |s| {
        let v = &s.figure().state().velocity;
        fastest = v.iter().fold(fastest, |m, v| m.max(v.abs()));
    });
    assert!(fastest < 0.5, "{fastest}");
}

/// A figure felled on its face while its clip stands stays down until another clip, which lies and rises, is played.
#[test]
fn who_was_felled_gets_up_when_a_clip_that_does_is_played() {
    let out = felled(&man(), vec3(500.0, 0.0, 0.0));
    let felled = out.scene.figure();
    let front = felled.state().posture.root_rotation.rotate(Vec3::X);
    assert!(
        felled.is_fallen() && out.up.is_none() && front.z < -0.8,
        "{front:?}"
    );
    let out = command(out.scene, 40.0);
    println!("up at {:?} s", out.up);
    assert!(out.up.is_some() && !out.scene.figure().is_fallen());
}
