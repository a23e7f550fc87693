//! The information that a scene gives about its figures: how they follow their desired motion, and that frames and
//! checkpoints agree on it.

use super::*;
use crate::engine::Planning;
use sinew_physics::body::topology::DOF_COUNT;
use sinew_physics::figure::motion::rehearsed::{JointOffset, RehearsalWorld};
use sinew_physics::figure::{Flags, FollowMode, RehearsedMotion};
use sinew_physics::math::Vec3;
use sinew_physics::motion::{Clip, Target, TargetPair};
use sinew_physics::stepper::motor_law::MotorLaw;
use sinew_physics::stepper::pelvis_wrench::{PelvisHold, RootStep};
use sinew_wire::convert;
use sinew_wire::frame::figure_frame;
use sinew_wire::pb;
use sinew_wire::types::{Disturbance, FieldSet, Follows, NumberFormat, Playback};

/// Ticks of the rehearsed motion.
const TICKS: usize = 30;
/// Force of its help, N.
const HELP: f64 = 20.0;

/// A scene with one figure.
fn scene() -> (Scene, FigureKey) {
    let settings = convert::world::settings(Some(pb::World::default())).unwrap();
    let mut scene = Scene::new(settings).unwrap();
    let done = scene.apply(SceneInput::AddFigure {
        id: "anna".into(),
        settings: Box::new(convert::figure::settings("", None).unwrap()),
        body: Some(Arc::new(Body::adult_man())),
    });
    let Ok(InputResult::Figure(key)) = done else {
        panic!("{done:?}")
    };
    (scene, key)
}

/// A rehearsed stand, with or without help.
fn stand(scene: &Scene, key: FigureKey, force: f64) -> Arc<RehearsedMotion> {
    let p = scene.world.params();
    let stage = RehearsalWorld {
        dt: 1.0 / p.rate_hz,
        substeps: p.substeps,
        gravity: p.gravity,
    };
    let posture = scene.figure(key).state().posture;
    let h = stage.dt / f64::from(stage.substeps);
    let step = RootStep {
        position: posture.root_position,
        rotation: posture.root_rotation,
        velocity: [Vec3::zero(); 2],
        help: [Vec3::zero(), Vec3::Z * (force * h)],
    };
    let motion = RehearsedMotion {
        stage,
        motors: MotorLaw::STIFF,
        hold: PelvisHold {
            frequency: 8.0,
            inertia: [80.0, 40.0],
            most: [0.0; 2],
            reach: 0.5,
        },
        lead: 0,
        window: TICKS,
        ramp: 1,
        desired: vec![Target::still(posture); TICKS + 1],
        offsets: vec![JointOffset([0.0; DOF_COUNT])],
        path: vec![step; TICKS * stage.substeps as usize],
    };
    assert!(motion.is_valid());
    Arc::new(motion)
}

fn wave(scene: &Scene, key: FigureKey) -> Clip {
    engine::builtin(scene.figure(key).body(), "wave").unwrap()
}

/// A second of a figure's own standing.
fn still(scene: &Scene, key: FigureKey) -> Clip {
    let posture = scene.figure(key).state().posture;
    Clip::from_postures("still", 60.0, vec![posture; 61], vec![[true; 2]; 61]).unwrap()
}

fn play(scene: &mut Scene, key: FigureKey, clip: Clip, max_help: f64) {
    play_rehearsed(scene, key, clip, None, max_help);
}

fn play_rehearsed(
    scene: &mut Scene,
    key: FigureKey,
    clip: Clip,
    rehearsed: Option<Arc<RehearsedMotion>>,
    max_help: f64,
) {
    let done = scene.apply(SceneInput::Play {
        figure: key,
        name: "clip".into(),
        clip: Arc::new(clip),
        rehearsed,
        playback: Playback {
            speed: 1.0,
            looped: false,
            start: None,
            reset: false,
            max_help,
            place: None,
        },
    });
    done.unwrap();
}

/// Steps, and returns the information given after that, by the scene and by its frames.
fn told(scene: &mut Scene, ticks: usize) -> Follows {
    (0..ticks).for_each(|_| scene.step(Planning::InTick));
    let figure = &scene.figures()[0];
    let frame = figure_frame(0, figure, 9.81, FieldSet::DEFAULT, NumberFormat::Double);
    let status = frame.status.unwrap();
    let follows = figure.follows;
    let way = match follows.so_far.mode {
        FollowMode::Nothing => pb::FollowWay::Unspecified,
        FollowMode::Tracked => pb::FollowWay::Tracked,
        FollowMode::Rehearsed => pb::FollowWay::Rehearsed,
        FollowMode::Helped => pb::FollowWay::Helped,
    };
    assert_eq!(status.following(), way);
    let help = (status.help_newton_seconds, status.help_ratio);
    assert_eq!(help, (follows.so_far.impulse, follows.so_far.help_share()));
    follows
}

#[test]
fn what_is_refused_is_not_recorded() {
    let (mut scene, _) = scene();
    scene.keep_records();
    let push = |tick| {
        SceneInput::Perturb(vec![FigureDisturbance {
            figure: "anna".into(),
            tick,
            what: Disturbance::Force {
                segment: sinew_physics::body::topology::CHEST,
                point: None,
                force: Vec3::X,
                duration: 0.1,
            },
        }])
    };
    assert!(scene.apply(push(Some(-1))).is_err());
    assert!(scene.take_record().is_none());
    scene.apply(push(None)).unwrap();
    let alone = scene.take_record().unwrap();
    scene.apply(push(None)).unwrap();
    assert!(scene.apply(push(Some(-1))).is_err());
    let both = scene.take_record().unwrap();
    // The first record of a past is marked as fresh.
    assert_eq!(both.bytes[2..], alone.bytes[2..]);
    assert_eq!((alone.bytes[1], both.bytes[1]), (1, 0));
}

#[test]
fn it_is_told_in_which_way_a_motion_is_followed() {
    let (mut scene, key) = scene();
    assert_eq!(told(&mut scene, 5), Follows::default());

    let clip = wave(&scene, key);
    play(&mut scene, key, clip, 0.25);
    let tracked = told(&mut scene, 20);
    assert_eq!(tracked.so_far.mode, FollowMode::Tracked);
    assert_eq!((tracked.so_far.impulse, tracked.most_help), (0.0, 0.25));
    let over = told(&mut scene, 900);
    assert_eq!(over.so_far.mode, FollowMode::Nothing, "the clip is over");
}

#[test]
fn what_a_rehearsal_needs_is_told_also_after_a_checkpoint() {
    for force in [0.0, HELP] {
        let (mut scene, key) = scene();
        let motion = stand(&scene, key, force);
        let clip = still(&scene, key);
        play_rehearsed(&mut scene, key, clip, Some(motion), 0.25);
        let mode = [FollowMode::Rehearsed, FollowMode::Helped][usize::from(force > 0.0)];
        let dt = scene.world.dt();
        let first = told(&mut scene, 10);
        assert_eq!((first.so_far.mode, first.most_help), (mode, 0.0));
        assert!((first.so_far.impulse - 10.0 * force * dt).abs() < 1e-9);
        let weight = first.so_far.weight_time / (10.0 * dt);
        assert!((600.0..900.0).contains(&weight), "{weight} N");

        let (world, saved) = scene.capture().restore_with().unwrap();
        let mut again = Scene::restored(world, saved).unwrap();
        assert_eq!(again.figures()[0].follows, first);
        let last = told(&mut scene, TICKS - 10);
        assert_eq!(told(&mut again, TICKS - 10), last);
        // The help stays reported once it is over, until the next motion begins.
        let after = told(&mut scene, 5).so_far;
        assert_eq!(after.mode, FollowMode::Nothing);
        assert!((after.impulse - TICKS as f64 * force * dt).abs() < 1e-9);
        let clip = wave(&scene, key);
        play(&mut scene, key, clip, 0.0);
        let next = told(&mut scene, 120).so_far;
        assert_eq!((next.mode, next.impulse), (FollowMode::Tracked, 0.0));
    }
}

/// All fields of a scene's figures in all formats, of which none may be infinite or not a number.
fn shows_finite_numbers(scene: &Scene) {
    for format in [
        NumberFormat::Float,
        NumberFormat::Double,
        NumberFormat::Fixed16,
    ] {
        for figure in scene.figures() {
            let frame = format!(
                "{:?}",
                figure_frame(0, &figure, 9.81, FieldSet::ALL, format)
            );
            assert!(frame.contains("audit: Some"), "there was a tick");
            let broken = ["NaN", "inf"].map(|word| frame.contains(word));
            assert_eq!(broken, [false; 2], "{format:?}");
        }
    }
}

#[test]
fn no_number_that_is_not_finite_is_shown_or_stored() {
    type Break = fn(&mut Target);
    let breaks: [Break; 6] = [
        |t| t.posture.hinge[8] = f64::NAN,
        |t| t.posture.hinge[3] = 1e200,
        |t| t.posture.root_position.x = f64::INFINITY,
        |t| t.posture.root_position.y = 1e300,
        |t| t.velocity[4] = f64::NEG_INFINITY,
        |t| t.velocity[9] = 1e300,
    ];
    for controller in [
        pb::Controller::Modern,
        pb::Controller::Paper,
        pb::Controller::Motors,
    ] {
        for change in breaks {
            let (mut scene, key) = scene();
            let figure = pb::Figure {
                controller: controller.into(),
                ..Default::default()
            };
            let update = convert::figure::update(&figure, None).unwrap();
            let update = SceneInput::UpdateFigure(key, Box::new(update));
            scene.apply(update).unwrap();
            told(&mut scene, 2);
            let mut target = Target::still(scene.figure(key).state().posture);
            change(&mut target);
            let pair = TargetPair {
                now: target.clone(),
                next: target,
            };
            let asked = Motion::External(Box::new(pair));
            scene.world.figure_mut(key).unwrap().set_drive(asked);
            for _ in 0..3 {
                told(&mut scene, 1);
                shows_finite_numbers(&scene);
            }
            let frozen = scene.figures()[0].report.as_ref().unwrap().flags;
            if frozen.has(Flags::QUARANTINED) {
                let (world, saved) = scene.capture().restore_with().unwrap();
                shows_finite_numbers(&Scene::restored(world, saved).unwrap());
            }
        }
    }
}
