//! Goal: help acts only while a motion is being lost, keeps its bounds, is reported to the last newton, fades, and lets
//! go of a motion that it cannot hold. Streams and held postures follow one rule.

use crate::common::{Scene, bent, corpus, figure, man, still};
use sinew_evaluate::survey::{SurveyOutcome, watched};
use sinew_physics::body::topology::CHEST;
use sinew_physics::figure::{ControllerKind, Figure, FigureOptions, Perturbation, StrengthScale};
use sinew_physics::math::Vec3;
use sinew_physics::motion::Bvh;
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::{Preparation, RetargetOptions};
use sinew_physics::rehearsal::{Conditions, TrackingReference};
use sinew_physics::world::WorldParams;
use std::sync::Arc;

/// Weight of the average man, N, and his stature, m.
const WEIGHT: f64 = 75.0 * 9.81;
const STATURE: f64 = 1.75;
const MOST: f64 = 0.3;

/// Streams a recording of the corpus to the average man through a window of a second.
fn streamed(name: &str, max_help: f64, watch: impl FnMut(&Figure, f64)) -> SurveyOutcome {
    let body = man();
    let bvh = Bvh::parse(&corpus::read(name)).unwrap();
    let options = RetargetOptions {
        preparation: Preparation::NONE,
        ..RetargetOptions::default()
    };
    let recorded = Arc::new(
        prepare_recording(&bvh.recording().unwrap(), &body, &options)
            .unwrap()
            .clip,
    );
    let conditions = Conditions {
        body,
        world: WorldParams::default(),
        strength: StrengthScale::default(),
        options: FigureOptions {
            max_help,
            ..FigureOptions::default()
        },
        perturbations: Vec::new(),
        live_window: Some(1.0),
        rehearsed: None,
    };
    watched(&conditions, &TrackingReference::authored(recorded), watch).unwrap()
}

#[test]
fn streams_of_walking_and_standing_get_no_help() {
    for name in ["walk-normal.vrm", "wave.vrm", "squat.vrm"] {
        let run = |max_help| {
            let mut states = Vec::new();
            let outcome = streamed(name, max_help, |f, _| states.push(*f.state()));
            (outcome, states)
        };
        let ((alone, a), (helped, b)) = (run(0.0), run(MOST));
        assert!(alone.completed && helped.completed, "{name}");
        assert_eq!(helped.assist_share, 0.0, "{name}");
        assert!(
            a == b,
            "{name}: what may be helped and is not moves as ever"
        );
    }
}

#[test]
fn a_stream_that_is_lost_alone_is_kept_with_bounded_help() {
    for name in ["hops.vrm", "hops.noisy"] {
        let alone = streamed(name, 0.0, |_, _| ());
        let (mut force, mut moment, mut carried) = (0.0_f64, 0.0_f64, 0);
        let helped = streamed(name, MOST, |f, _| {
            let a = f.report().unwrap().assist;
            let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
            moment = moment.max(size(&a[..3]));
            force = force.max(size(&a[3..]));
            carried += usize::from(f.is_carried());
        });
        println!(
            "{name}: alone lost at {:?} s; helped {:.1} % of weight × time, at most {force:.0} N and {moment:.0} N·m",
            alone.lost_at_s,
            100.0 * helped.assist_share
        );
        assert!(!alone.completed, "{name} is a case for help");
        assert!(helped.completed && helped.fell_at_s.is_none(), "{name}");
        assert!(carried > 0 && helped.assist_share < MOST, "{name}");
        assert!(force <= MOST * WEIGHT * (1.0 + 1e-9), "{name}: {force} N");
        let most = MOST * WEIGHT * 0.5 * STATURE;
        assert!(moment <= most * (1.0 + 1e-9), "{name}: {moment} N·m");
    }
}

/// A standing man, pushed forwards on the chest by `push` N·s after half a second.
fn pushed(max_help: f64, push: f64) -> Scene {
    let body = man();
    let mut setup = figure(&body, ControllerKind::Modern, still(bent(&body, 0.1)));
    setup.options.max_help = max_help;
    let mut scene = Scene::of(setup);
    let force = Perturbation::Force {
        segment: CHEST,
        point: Vec3::zero(),
        force: Vec3::X * (push / 0.2),
        from: 0.5,
        to: 0.7,
    };
    scene.world.perturb(scene.key, force).unwrap();
    scene
}

#[test]
fn every_tick_closes_and_help_fades_after_a_push() {
    let alone = pushed(0.0, 90.0).measure(4.0);
    assert!(alone.fell_at_s.is_some(), "the push is one that fells");
    let helped = pushed(MOST, 90.0).measure(4.0);
    assert!(helped.fell_at_s.is_none());
    assert!(helped.dynamics_residual_max < 1e-9 && helped.over_limit_max < 1e-9);
    assert!(helped.root_wrench_unexplained_max_n < 1e-6 * WEIGHT);
    assert!(helped.assist_max_n > 1.0 && helped.assist_max_n < MOST * WEIGHT * (1.0 + 1e-9));
    // It stands by itself again.
    let mut scene = pushed(MOST, 90.0);
    let mut last = 0.0;
    for _ in 0..480 {
        scene.world.step();
        if scene.figure().report().unwrap().assist != [0.0; 6] {
            last = scene.world.time().0;
        }
    }
    println!("help acts until {last:.2} s");
    assert!(last < 7.0 && !scene.figure().is_carried());
}

#[test]
fn what_cannot_be_held_is_let_fall() {
    let mut scene = pushed(0.05, 400.0);
    let mut let_go = false;
    let mut carried = false;
    for _ in 0..600 {
        scene.world.step();
        let figure = scene.figure();
        carried |= figure.is_carried();
        let_go |= carried && !figure.is_carried() && figure.is_fallen();
    }
    assert!(let_go, "carried: {carried}");
}
