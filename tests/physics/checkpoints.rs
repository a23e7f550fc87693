//! Goal: a world restored from a checkpoint continues bit for bit, whatever its figures are doing, on any number of
//! threads; and bytes that are not a checkpoint are refused. Method: scenes of everything that figures do are run once.
//! New worlds are made from the checkpoints along the way and stepped with the same commands. The hash of each tick is
//! compared, and at later checkpoints every byte of the state with its reports. Values missing from a checkpoint are
//! fresh in the new world, so a state that was left out shows as soon as it matters.

mod forged;

use crate::common::actors::{Actor, KINDS, crowd, in_both_hands, load, push, subject, world};
use crate::common::collisions::obstacle;
use crate::common::{
    Scene, authored, bent, corpus, figure, man, play, still, synthesised, synthesised_cycle,
};
use sinew_physics::body::palm::load_point;
use sinew_physics::body::topology::{L_HAND, PELVIS, R_HAND};
use sinew_physics::body::{Body, Profile, Sex};
use sinew_physics::collide::{Mobility, Shape};
use sinew_physics::figure::motion::rehearsed::RehearsalWorld;
use sinew_physics::figure::{
    Constrained, Constraint, ControllerKind, FigureOptions, HeldLoad, LatePlans, Perturbation,
    Planning, SecondHand, StepperKind, StrengthScale,
};
use sinew_physics::math::Vec3;
use sinew_physics::math::vec3::vec3;
use sinew_physics::motion::{Bvh, Clip};
use sinew_physics::plan::prepare_recording;
use sinew_physics::plan::stream::{RATE, StreamPlan};
use sinew_physics::reference::RetargetOptions;
use sinew_physics::rehearsal::{Problem, Settings, rehearse};
use sinew_physics::time::{StreamTime, WorldTime};
use sinew_physics::world::checkpoint::{
    Checkpoint, CheckpointError, DefinitionHash, Definitions, FORMAT,
};
use sinew_physics::world::{
    ClipPlayback, FigureKey, LivePlayback, MotionSource, RehearsedPlayback, World, WorldParams,
};
use std::sync::Arc;

/// A world, its commands before each tick, and the ticks to check.
struct Scenario {
    name: &'static str,
    world: World,
    commands: Box<dyn Fn(&mut World, u64)>,
    ticks: u64,
    /// Ticks between checkpoints; more at the times of commands.
    stride: u64,
    also: &'static [u64],
}

impl Scenario {
    fn new(name: &'static str, world: World, ticks: u64, stride: u64) -> Self {
        Self {
            name,
            world,
            commands: Box::new(|_, _| ()),
            ticks,
            stride,
            also: &[],
        }
    }

    fn with(mut self, also: &'static [u64], commands: impl Fn(&mut World, u64) + 'static) -> Self {
        self.also = also;
        self.commands = Box::new(commands);
        self
    }
}

fn bytes(world: &World) -> Vec<u8> {
    let capture = world.capture();
    assert_eq!(capture.tick(), world.tick());
    assert_eq!(capture.hash(), world.state_hash());
    capture
        .checkpoint(&mut Definitions::default())
        .unwrap()
        .to_bytes()
}

fn restored(bytes: &[u8]) -> World {
    let read = Checkpoint::from_bytes(bytes).unwrap();
    assert!(read.is_of_this_numerics() && read.needs().next().is_none());
    read.restore(|_| None).unwrap()
}

fn same(what: &str, a: &[u8], b: &[u8]) {
    let first = a.iter().zip(b).position(|(a, b)| a != b);
    assert!(
        a == b,
        "{what}: {} and {} bytes, the first difference at {first:?}",
        a.len(),
        b.len()
    );
}

/// Runs the scene, and from each checkpoint two strides further in a new world.
fn goes_on_bit_for_bit(mut s: Scenario) {
    let mut hashes = vec![s.world.state_hash()];
    let mut kept: Vec<(u64, Vec<u8>)> = Vec::new();
    for tick in 0..s.ticks {
        if tick % s.stride == 0 || s.also.contains(&tick) {
            kept.push((tick, bytes(&s.world)));
        }
        (s.commands)(&mut s.world, tick);
        s.world.step();
        hashes.push(s.world.state_hash());
    }
    kept.push((s.ticks, bytes(&s.world)));
    for (i, (from, state)) in kept.iter().enumerate() {
        let mut world = restored(state);
        same(&format!("{} read at {from}", s.name), &bytes(&world), state);
        for (until, later) in kept.iter().skip(i + 1).take(2) {
            while world.tick() < *until {
                let tick = world.tick();
                (s.commands)(&mut world, tick);
                world.step();
                assert_eq!(
                    hashes[world.tick() as usize],
                    world.state_hash(),
                    "{} from {from}, tick {}",
                    s.name,
                    world.tick()
                );
            }
            same(
                &format!("{} from {from} at {until}", s.name),
                &bytes(&world),
                later,
            );
        }
    }
    // Other threads, from the middle to the end.
    let (from, state) = &kept[kept.len() / 2];
    for threads in [1, 2, 7] {
        let mut world = restored(state);
        world.set_threads(threads);
        for tick in *from..s.ticks.min(from + 3 * s.stride) {
            (s.commands)(&mut world, tick);
            world.step();
            assert_eq!(
                hashes[tick as usize + 1],
                world.state_hash(),
                "{} on {threads} threads from {from}, tick {tick}",
                s.name
            );
        }
    }
}

fn alone(actor: &Actor) -> World {
    let mut world = world(1);
    actor.enter(&mut world);
    world
}

fn of_figure(world: &mut World) -> &mut sinew_physics::world::Figure {
    let (key, _) = world.figures().next().unwrap();
    world.figure_mut(key).unwrap()
}

#[test]
fn the_golden_scenes() {
    for kind in KINDS {
        for newtons in [100.0, 800.0] {
            goes_on_bit_for_bit(Scenario::new(
                "swing, load and push",
                alone(&subject(kind, newtons)),
                180,
                13,
            ));
        }
    }
    let profile = Profile {
        sex: Sex::Female,
        age: 68.0,
        height: 1.58,
        mass: 66.0,
    };
    let body = Arc::new(Body::humanoid(profile).unwrap());
    let params = WorldParams {
        rate_hz: 120.0,
        substeps: 4,
        gravity: 3.7,
        friction: 0.4,
        ..WorldParams::default()
    };
    let setup = figure(&body, ControllerKind::Modern, still(bent(&body, 0.5)));
    goes_on_bit_for_bit(Scenario::new(
        "Mars",
        Scene::with(params, setup).world,
        240,
        31,
    ));
}

/// The second hand reaches for a load that is too heavy for one arm, helps to hold it, is needed elsewhere, and
/// returns.
#[test]
fn a_second_hand() {
    for kind in KINDS {
        let body = man();
        let lift = authored(&body, "lift");
        let mut scene = Scene::playing(&body, kind, &lift);
        let load = |segment, mass, from, to| HeldLoad {
            segment,
            point: load_point(&body, segment),
            mass,
            velocity: Vec3::zero(),
            second: None,
            grip: 1e4,
            from,
            to,
        };
        let heavy = Perturbation::Helped {
            load: load(R_HAND, 14.0, 1.7, 6.0),
            when: SecondHand::Auto,
        };
        let other = Perturbation::Held(load(L_HAND, 1.0, 5.0, 5.2));
        for what in [heavy, other] {
            scene.world.perturb(scene.key, what).unwrap();
        }
        let also = &[103, 120, 140, 299, 300, 301, 305, 320];
        goes_on_bit_for_bit(
            Scenario::new("second hand", scene.world, 420, 37).with(also, |_, _| ()),
        );
    }
}

#[test]
fn people_who_touch_each_other() {
    let mut world = world(2);
    for (i, mut actor) in crowd(9).into_iter().enumerate() {
        // Some begin inside each other, and some touch later.
        actor.shift(vec3(0.45 * (i / 2) as f64, 0.35 * (i % 3) as f64, 0.0));
        actor.enter(&mut world);
    }
    goes_on_bit_for_bit(Scenario::new("crowd", world, 90, 11));
}

/// Pairs of figures that pass through each other contain only existing figures, even before the next tick.
#[test]
fn a_figure_that_is_gone_passes_through_nobody() {
    let mut world = world(1);
    for mut actor in crowd(4) {
        let at = actor.setup.state.posture.root_position;
        actor.shift(vec3(-at.x, -at.y, 0.0)); // all in one place
        actor.enter(&mut world);
    }
    world.step();
    let keys: Vec<FigureKey> = world.figures().map(|(k, _)| k).collect();
    for key in &keys[1..] {
        assert!(world.remove_figure(*key));
        let state = bytes(&world);
        same("a smaller crowd", &bytes(&restored(&state)), &state);
    }
}

#[test]
fn prescribed_accelerations() {
    for kind in [ControllerKind::Modern, ControllerKind::Paper] {
        for newtons in [0.0, 150.0, 500.0] {
            let mut actor = subject(kind, newtons);
            actor.setup.stepper = StepperKind::Kinematic;
            actor.setup.options.fatigue_time_scale = 60.0;
            goes_on_bit_for_bit(Scenario::new("kinematic", alone(&actor), 150, 13));
        }
    }
}

/// Walks, stops, lifts, walks again, switches to another walk, and is moved elsewhere.
fn transitions() -> Scenario {
    let body = man();
    let (walk, lift) = (authored(&body, "walk"), authored(&body, "lift"));
    let other = synthesised(&body, "walk-fast.vrm");
    let cycle = synthesised_cycle(&body);
    let state = cycle.sample(0.0).state();
    let mut scene = Scene::of(figure(&body, ControllerKind::Modern, state));
    scene
        .figure_mut()
        .set_drive(MotionSource::Clip(ClipPlayback {
            looped: true,
            ..ClipPlayback::new(Arc::clone(&cycle), WorldTime(0.0))
        }));
    Scenario::new("transitions", scene.world, 520, 23).with(
        &[60, 61, 62, 70, 71, 200, 201, 203, 330, 331, 333, 480],
        move |world, tick| {
            let time = world.time();
            let f = of_figure(world);
            let looped = |clip: &Arc<Clip>| ClipPlayback {
                looped: true,
                ..ClipPlayback::new(Arc::clone(clip), time)
            };
            match tick {
                60 => f.stop(time),
                70 => drop(f.play(ClipPlayback::new(Arc::clone(&lift), time), false, time)),
                200 => drop(f.play(looped(&walk), false, time)),
                330 => drop(f.play(ClipPlayback::new(Arc::clone(&other), time), false, time)),
                480 => f.reset(still(bent(f.body(), 0.2))),
                _ => {}
            }
        },
    )
}

#[test]
fn transitions_between_motions() {
    goes_on_bit_for_bit(transitions());
}

#[test]
fn a_rehearsed_motion_and_what_comes_after_it() {
    let body = man();
    let clip = authored(&body, "squat");
    let params = WorldParams::default();
    let stage = RehearsalWorld {
        dt: 1.0 / params.rate_hz,
        substeps: params.substeps,
        gravity: params.gravity,
    };
    let problem = Problem::new(
        Arc::clone(&body),
        &StrengthScale::default(),
        params.friction,
        stage,
    );
    let mut settings = Settings::default();
    (settings.trials.near.samples, settings.trials.budget) = (12, 12);
    settings.trials.far.samples = 12;
    settings.trials.least_budget = 0;
    let found = rehearse(&problem, &clip, &settings, 2, &mut |_| true).unwrap();
    let motion = Arc::new(found.motion);
    let mut scene = Scene::of(figure(&body, ControllerKind::Modern, motion.start()));
    let play = RehearsedPlayback::new(Arc::clone(&motion), WorldTime(0.0));
    scene.figure_mut().set_drive(MotionSource::Rehearsed(play));
    // Held back on its path, then pushed out of reach.
    let gentle = push(vec3(60.0, 0.0, 0.0), 0.2);
    scene.world.perturb(scene.key, gentle).unwrap();
    let ticks = motion.ticks() as u64 + 60;
    let scenario = Scenario::new("rehearsed", scene.world, ticks, 29);
    goes_on_bit_for_bit(scenario.with(&[13, 14, 15], |world, tick| {
        if tick == 60 {
            let key = world.figures().next().unwrap().0;
            let hard = Perturbation::Force {
                segment: PELVIS,
                point: vec3(0.0, 0.0, 0.0),
                force: vec3(900.0, 0.0, 0.0),
                from: 1.0,
                to: 1.5,
            };
            world.perturb(key, hard).unwrap();
        }
    }));
}

/// Follows a stream that stops in mid-step and repeats its last sample.
fn streamed() -> Scenario {
    let body = man();
    let walk = synthesised(&body, "walk-normal.vrm");
    let sample = move |i: f64| walk.sample(i / RATE).posture;
    let first = sample(0.0);
    let mut motion = StreamPlan::new(Arc::clone(&body), 0.4);
    let lead = (motion.window() * RATE) as u64 + 6;
    (0..lead).for_each(|i| motion.push(&sample(i as f64), None));
    motion.advance(StreamTime(1.0 / RATE));
    let mut scene = Scene::of(figure(&body, ControllerKind::Modern, still(first)));
    let live = LivePlayback {
        motion,
        offset: 0.0,
    };
    scene
        .figure_mut()
        .set_drive(MotionSource::Live(Box::new(live)));
    Scenario::new("stream", scene.world, 280, 17).with(&[1, 5], move |world, tick| {
        // It stops in mid-step after 2.5 s, and repeats its last sample.
        if let Some(live) = of_figure(world).stream_mut() {
            live.motion
                .push(&sample((lead + tick.min(150)) as f64), None);
        }
    })
}

#[test]
fn a_live_stream_that_breaks_off() {
    goes_on_bit_for_bit(streamed());
}

/// Lies down, and rises by the reversed motion.
fn lying_down_and_up(body: &Body) -> Arc<Clip> {
    let bvh = Bvh::parse(&corpus::read("lie-down.vrm")).unwrap();
    let clip = prepare_recording(&bvh.recording().unwrap(), body, &RetargetOptions::default())
        .unwrap()
        .clip;
    let there: Vec<_> = clip.samples().map(|(p, planted)| (*p, planted)).collect();
    let lies = std::iter::repeat_n(there[there.len() - 1], clip.rate_hz() as usize);
    let back = there.iter().rev().copied();
    let (postures, planted) = lies.chain(back).unzip();
    Arc::new(Clip::from_postures("rise", clip.rate_hz(), postures, planted).unwrap())
}

#[test]
fn a_figure_gets_up() {
    let body = man();
    let clip = lying_down_and_up(&body);
    let mut scene = Scene::playing(&body, ControllerKind::Modern, &clip);
    let mut rose = false;
    for _ in 0..900 {
        scene.world.step();
        rose |= scene.figure().rising().is_some();
    }
    assert!(rose, "the scene is one of getting up");
    let scene = Scene::playing(&body, ControllerKind::Modern, &clip);
    goes_on_bit_for_bit(Scenario::new("getting up", scene.world, 900, 41));
}

#[test]
fn a_figure_is_carried() {
    let body = man();
    let helped = || {
        let mut world = world(1);
        let mut setup = figure(&body, ControllerKind::Modern, still(bent(&body, 0.1)));
        setup.options.max_help = 0.3;
        let key = world.add_figure(setup).unwrap();
        world
            .perturb(key, push(vec3(900.0, 0.0, 0.0), 0.5))
            .unwrap();
        world
    };
    let mut seen = helped();
    let mut carried = false;
    for _ in 0..240 {
        seen.step();
        carried |= of_figure(&mut seen).is_carried();
    }
    assert!(carried, "the scene is one of help");
    goes_on_bit_for_bit(Scenario::new("carried", helped(), 240, 13));
}

/// The impulse between the hands is computed again, starting from the last one, and hardly changes.
#[test]
fn a_load_in_both_hands_is_held_at_rest() {
    let body = man();
    let mut world = world(1);
    let setup = figure(&body, ControllerKind::Modern, still(bent(&body, 0.1)));
    let key = world.add_figure(setup).unwrap();
    world
        .perturb(key, Perturbation::Held(in_both_hands(0.2)))
        .unwrap();
    goes_on_bit_for_bit(Scenario::new("at rest", world, 900, 19));
}

/// Carries, is pushed, tired and helped, meets things, and has constraints that come and go.
fn things() -> Scenario {
    let body = man();
    let stand = bent(&body, 0.25);
    let mut world = world(1);
    let mut setup = figure(&body, ControllerKind::Modern, still(stand));
    setup.options = FigureOptions {
        fatigue_time_scale: 30.0,
        assist: 0.3,
        max_help: 0.0,
        self_contact: true,
    };
    let key = world.add_figure(setup).unwrap();
    let both = HeldLoad {
        velocity: vec3(-1.0, 0.0, 0.0),
        grip: 250.0,
        to: 1.5,
        ..in_both_hands(0.2)
    };
    world.perturb(key, Perturbation::Held(both)).unwrap();
    world
        .perturb(key, push(vec3(60.0, 20.0, 0.0), 1.0))
        .unwrap();
    let box_ = |x: f64, y: f64, z: f64| Shape::Box {
        half: vec3(x, y, z),
    };
    let ball = Shape::Sphere { radius: 0.15 };
    let mut thrown = obstacle(ball, Mobility::Free(3.0), vec3(1.5, 0.1, 1.0));
    thrown.velocity = vec3(-3.0, 0.0, 2.0);
    let mut led = obstacle(box_(0.1, 0.5, 0.5), Mobility::Led, vec3(-1.0, 0.0, 0.9));
    led.velocity = vec3(0.4, 0.0, 0.0);
    let seat = obstacle(
        box_(0.2, 0.3, 0.25),
        Mobility::Fixed,
        vec3(-0.35, 0.0, 0.25),
    );
    for setup in [thrown, led, seat] {
        world.add_obstacle(setup).unwrap();
    }
    let hand = move |x: f64| Constraint {
        on: Constrained::Point(R_HAND, Vec3::zero()),
        position: Some(vec3(x, -0.3, 1.2)),
        axes: [1.0; 3],
        rotation: None,
        weight: 0.8,
        ease: 0.3,
        from: 0.1,
        to: f64::INFINITY,
    };
    Scenario::new("things", world, 200, 11).with(&[30, 33, 36, 60], move |world, tick| {
        match tick {
            // A constraint that is set again and again, then removed.
            20..60 if tick % 3 == 0 => {
                let com = Constraint {
                    on: Constrained::CenterOfMass,
                    position: Some(vec3(0.02, 0.0, 0.9)),
                    ..hand(0.0)
                };
                let x = 0.3 + 0.004 * tick as f64;
                world.set_constraints(key, &[hand(x), com]).unwrap();
            }
            60 => world.set_constraints(key, &[]).unwrap(),
            120 => {
                let on = Constrained::Point(PELVIS, Vec3::zero());
                world
                    .set_constraints(key, &[Constraint { on, ..hand(0.1) }])
                    .unwrap();
                world.perturb(key, load(3.0, 2.1, 2.6)).unwrap();
            }
            _ => {}
        }
    })
}

#[test]
fn loads_things_constraints_and_help() {
    goes_on_bit_for_bit(things());
}

#[test]
fn targets_that_the_caller_sets() {
    let body = man();
    let wave = authored(&body, "wave");
    let state = wave.sample(0.0).state();
    for kind in KINDS {
        let world = Scene::of(figure(&body, kind, state)).world;
        let wave = Arc::clone(&wave);
        let s = Scenario::new("external", world, 60, 9).with(&[], move |world, _| {
            let targets = play(&wave).targets(world.time(), world.dt());
            of_figure(world).set_drive(MotionSource::External(Box::new(targets)));
        });
        goes_on_bit_for_bit(s);
    }
}

#[test]
fn what_threads_decided_about_plans_is_an_input() {
    // Plans that no thread computes are late in every tick until they are computed.
    let mut s = transitions();
    s.world.set_planning(Planning::Aside);
    let start = bytes(&s.world);
    let (mut hashes, mut late) = (Vec::new(), Vec::<Vec<(FigureKey, LatePlans)>>::new());
    for tick in 0..300 {
        (s.commands)(&mut s.world, tick);
        if !(60..90).contains(&tick) && !(200..215).contains(&tick) {
            s.world.plan_requests().for_each(|r| r.solve());
        }
        s.world.step();
        hashes.push(s.world.state_hash());
        late.push(s.world.late_plans_of_figures().collect());
    }
    assert!(late.iter().flatten().count() >= 3);
    let replay = |late: &[Vec<(FigureKey, LatePlans)>]| {
        let mut world = restored(&start);
        (0..300)
            .map(|tick| {
                (s.commands)(&mut world, tick);
                for (key, plans) in late.get(tick as usize).into_iter().flatten() {
                    assert!(world.delay_plans(*key, *plans));
                }
                world.step();
                world.state_hash()
            })
            .collect::<Vec<_>>()
    };
    assert_eq!(replay(&late), hashes);
    assert_ne!(replay(&[]), hashes, "it matters");
}

#[test]
fn definitions_are_written_once_and_kept_elsewhere_by_hash() {
    let mut world = world(1);
    for actor in crowd(9) {
        actor.enter(&mut world);
    }
    (0..20).for_each(|_| world.step());
    let mut known = Definitions::default();
    let whole = world.capture().checkpoint(&mut known).unwrap();
    let size = whole.to_bytes().len();
    let (lean, definitions) = whole.without_definitions();
    // Three bodies, three clips of each.
    assert_eq!(definitions.len(), 12);
    let bytes = lean.to_bytes();
    assert!(bytes.len() < 9 * 40_000, "{} of {size} bytes", bytes.len());
    let lean = Checkpoint::from_bytes(&bytes).unwrap();
    let needs: Vec<DefinitionHash> = lean.needs().collect();
    assert_eq!(needs.len(), 12);
    let missing = lean.restore(|_| None).unwrap_err();
    assert_eq!(missing, CheckpointError::Missing(needs[0]));
    let find = |h: &DefinitionHash| {
        definitions
            .iter()
            .find(|(d, _)| d == h)
            .map(|d| d.1.clone())
    };
    let mut again = lean.restore(find).unwrap();
    let wrong = |h: &DefinitionHash| {
        find(h).map(|mut bytes| {
            bytes[7] ^= 1;
            bytes
        })
    };
    assert!(matches!(
        lean.restore(wrong),
        Err(CheckpointError::Content(_))
    ));
    for _ in 0..20 {
        world.step();
        again.step();
        assert_eq!(world.state_hash(), again.state_hash());
    }
    // The definitions of a dropped world are forgotten.
    let held = known.bytes();
    drop(world);
    known.prune();
    assert!(held > 0 && known.bytes() == 0);
}

#[test]
fn damage_is_found() {
    let good = bytes(&alone(&subject(ControllerKind::Modern, 0.0)));
    let read = |b: &[u8]| Checkpoint::from_bytes(b).map(|_| ());
    assert_eq!(read(&good), Ok(()));
    for at in (0..good.len()).step_by(good.len() / 700).chain(0..44) {
        let mut bad = good.clone();
        bad[at] ^= 1 << (at % 8);
        assert!(read(&bad).is_err(), "a bit at {at}");
        assert!(read(&good[..at]).is_err(), "cut at {at}");
    }
    let longer = [&good[..], &[0]].concat();
    assert!(matches!(read(&longer), Err(CheckpointError::Length { .. })));
    let mut other = good.clone();
    other[8] = FORMAT as u8 + 1;
    let found = FORMAT + 1;
    assert_eq!(read(&other), Err(CheckpointError::Format { found }));
    assert_eq!(read(b"BVH"), Err(CheckpointError::NotACheckpoint));
}
