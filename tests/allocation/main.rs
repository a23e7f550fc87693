//! Goal: after a warm-up, a tick allocates nothing, whatever the figure does: no pauses, no growth.
//! Method: a counting global allocator around [`World::step`] on one thread; a first test shows that it counts.
#![allow(clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;

use allocation_counter::measure;
use common::{Scene, authored, bent, figure, man, play, still, synthesised};
use sinew_physics::body::SegmentId;
use sinew_physics::body::palm::load_point;
use sinew_physics::body::topology::{CHEST, L_HAND, R_HAND};
use sinew_physics::figure::{
    Constrained, Constraint, ControllerKind, Flags, HeldLoad, Perturbation, SecondHand,
};
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::plan::stream::{RATE, StreamPlan};
use sinew_physics::time::{StreamTime, WorldTime};
use sinew_physics::world::{ClipPlayback, LivePlayback, MotionSource, World};
use std::sync::Arc;

const KINDS: [ControllerKind; 3] = [
    ControllerKind::Modern,
    ControllerKind::Paper,
    ControllerKind::Motors,
];
/// Ticks before counting starts.
const WARM_UP: usize = 3;

/// Steps `seconds`; panics if any tick allocates.
fn assert_none(what: &str, scene: &mut Scene, seconds: f64) {
    for _ in 0..WARM_UP {
        scene.world.step();
    }
    for _ in 0..scene.ticks(seconds) {
        let world: &mut World = &mut scene.world;
        let counted = measure(|| world.step());
        assert_eq!(
            (counted.count_total, counted.bytes_total),
            (0, 0),
            "{what}: allocations and bytes of tick {}",
            scene.world.tick()
        );
    }
    assert!(
        !scene
            .figure()
            .report()
            .unwrap()
            .flags
            .has(Flags::QUARANTINED),
        "{what}"
    );
}

fn standing(kind: ControllerKind) -> Scene {
    let body = man();
    Scene::of(figure(&body, kind, still(bent(&body, 0.3))))
}

fn push(scene: &mut Scene, newtons: Vec3, from: f64) {
    let what = Perturbation::Force {
        segment: CHEST,
        point: Vec3::zero(),
        force: newtons,
        from,
        to: from + 0.15,
    };
    scene.world.perturb(scene.key, what).unwrap();
}

fn load(scene: &mut Scene, segment: SegmentId, kg: f64, from: f64, to: f64) {
    let what = Perturbation::Load {
        segment,
        point: Vec3 {
            x: 0.0,
            y: 0.0,
            z: -0.08,
        },
        mass: kg,
        from,
        to,
    };
    scene.world.perturb(scene.key, what).unwrap();
}

#[test]
fn the_counter_counts() {
    let counted = measure(|| drop(std::hint::black_box(vec![0u8; 100])));
    assert_eq!((counted.count_total, counted.bytes_total), (1, 100));
}

#[test]
fn standing_allocates_nothing() {
    for kind in KINDS {
        assert_none(&format!("{kind:?}"), &mut standing(kind), 1.0);
    }
}

#[test]
fn playing_a_clip_allocates_nothing() {
    let body = man();
    for kind in KINDS {
        for name in ["lift", "walk"] {
            let clip = authored(&body, name);
            let mut scene = Scene::playing(&body, kind, &clip);
            assert_none(&format!("{kind:?} {name}"), &mut scene, clip.duration());
        }
        // Over the seam of a loop.
        let clip = authored(&body, "step");
        let mut scene = Scene::playing(&body, kind, &clip);
        if let MotionSource::Clip(mut play) = play(&clip) {
            play.looped = true;
            play.speed = 2.0;
            scene.figure_mut().set_drive(MotionSource::Clip(play));
        }
        assert_none(&format!("{kind:?} loop"), &mut scene, 0.6 * clip.duration());
    }
}

#[test]
fn loads_and_pushes_allocate_nothing() {
    for kind in KINDS {
        let mut scene = standing(kind);
        load(&mut scene, R_HAND, 3.0, 0.2, 0.9);
        load(&mut scene, L_HAND, 1.0, 0.4, 0.6);
        push(&mut scene, Vec3::X * 60.0, 0.3);
        push(&mut scene, Vec3::Y * -40.0, 0.35);
        assert_none(&format!("{kind:?}"), &mut scene, 1.5);
    }
}

#[test]
fn help_allocates_nothing() {
    let body = man();
    let mut setup = figure(&body, ControllerKind::Modern, still(bent(&body, 0.3)));
    setup.options.max_help = 0.3;
    let mut scene = Scene::of(setup);
    push(&mut scene, Vec3::X * 700.0, 0.2);
    assert_none("helped", &mut scene, 2.0);
    let share = scene.figure().following().help_share();
    assert!(share > 0.0, "the scene is one of help");
}

#[test]
fn a_second_hand_allocates_nothing() {
    let body = man();
    for kind in KINDS {
        let mut scene = Scene::playing(&body, kind, &authored(&body, "lift"));
        let load = Perturbation::Helped {
            load: HeldLoad {
                segment: R_HAND,
                point: load_point(&body, R_HAND),
                mass: 14.0,
                velocity: Vec3::zero(),
                second: None,
                grip: 1e4,
                from: 1.7,
                to: 5.0,
            },
            when: SecondHand::Auto,
        };
        scene.world.perturb(scene.key, load).unwrap();
        assert_none(&format!("{kind:?}"), &mut scene, 6.0);
    }
}

#[test]
fn constraints_allocate_nothing() {
    for kind in KINDS {
        let mut scene = standing(kind);
        let place = |x: f64| Some(Vec3 { x, y: -0.2, z: 1.1 });
        let all: Vec<_> = (0..8)
            .map(|i| Constraint {
                on: match i {
                    0 => Constrained::CenterOfMass,
                    i => Constrained::Point(SegmentId::new(1 + i).unwrap(), Vec3::zero()),
                },
                position: place(0.05 * i as f64),
                axes: [1.0; 3],
                rotation: (i > 0).then(Quat::identity),
                weight: 1.0,
                ease: 0.2,
                from: 0.1,
                to: 0.2 + 0.1 * i as f64,
            })
            .collect();
        scene.world.set_constraints(scene.key, &all).unwrap();
        scene.world.set_constraints(scene.key, &all[..4]).unwrap();
        assert_none(&format!("{kind:?}"), &mut scene, 1.0);
    }
}

#[test]
fn a_constraint_that_is_given_anew_at_every_tick_allocates_nothing() {
    let mut scene = standing(ControllerKind::Modern);
    let give = |world: &mut World, key, tick: usize| {
        let hands = [L_HAND, R_HAND].map(|hand| Constraint {
            on: Constrained::Point(hand, Vec3::zero()),
            position: Some(Vec3 {
                x: 0.3 + 0.002 * tick as f64,
                y: if hand == L_HAND { 0.2 } else { -0.2 },
                z: 1.1,
            }),
            axes: [1.0; 3],
            rotation: None,
            weight: 1.0,
            ease: 0.2,
            from: 0.0,
            to: f64::INFINITY,
        });
        // One hand is let go of every ten ticks: it fades.
        let given = if tick % 20 < 10 { &hands } else { &hands[..1] };
        world.set_constraints(key, given).unwrap();
        world.step();
    };
    let key = scene.key;
    let world: &mut World = &mut scene.world;
    (0..WARM_UP).for_each(|tick| give(world, key, tick));
    for tick in WARM_UP..60 {
        let counted = measure(|| give(world, key, tick));
        assert_eq!(counted.count_total, 0, "tick {tick}");
    }
}

#[test]
fn falling_and_lying_allocate_nothing() {
    for kind in KINDS {
        let mut scene = standing(kind);
        push(&mut scene, Vec3::X * 1500.0, 0.2);
        assert_none(&format!("{kind:?}"), &mut scene, 4.0);
        assert!(
            scene.figure().is_fallen(),
            "{kind:?}: the scene must have a fall in it"
        );
    }
}

#[test]
fn getting_up_allocates_nothing() {
    // It lies prone while its motion lies on the back, and begins to get up when the motion does.
    let body = man();
    let clip = synthesised(&body, "lie-down.vrm");
    let mut prone = *clip.posture(0);
    prone.root_rotation = Quat::exp(Vec3::Y * std::f64::consts::FRAC_PI_2);
    prone.root_position.z = 0.13;
    let mut scene = Scene::of(figure(&body, ControllerKind::Modern, still(prone)));
    scene
        .figure_mut()
        .set_drive(MotionSource::Clip(ClipPlayback::new(clip, WorldTime(-4.5))));
    // Whether it comes to its feet is not the subject here; that it tries is.
    let mut tries = 0;
    for _ in 0..40 {
        assert_none("get-up", &mut scene, 0.5);
        tries += u32::from(scene.figure().rising().is_some());
    }
    assert!(tries > 10, "it gets up in {tries} of 40 half seconds");
}

#[test]
fn flight_and_impact_allocate_nothing() {
    let body = man();
    for kind in KINDS {
        let mut state = still(bent(&body, 0.3));
        state.posture.root_position.z += 0.6;
        state.posture.root_rotation = Quat::exp(Vec3::X * 0.7);
        state.velocity[0] = 3.0;
        assert_none(
            &format!("{kind:?}"),
            &mut Scene::of(figure(&body, kind, state)),
            2.5,
        );
    }
}

#[test]
fn the_strongest_blow_allocates_nothing() {
    let mut scene = standing(ControllerKind::Modern);
    for _ in 0..WARM_UP {
        scene.world.step();
    }
    // The strongest push the world accepts, on one hand.
    let what = Perturbation::Force {
        segment: R_HAND,
        point: Vec3::X * 10.0,
        force: Vec3::Y * 1e6,
        from: 0.0,
        to: 1.0,
    };
    scene.world.perturb(scene.key, what).unwrap();
    let mut braked = false;
    for _ in 0..60 {
        let world: &mut World = &mut scene.world;
        let counted = measure(|| world.step());
        assert_eq!(counted.count_total, 0, "tick {}", scene.world.tick());
        let flags = scene.figure().report().unwrap().flags;
        braked |= flags.has(Flags::SPEED_BOUND);
    }
    assert!(braked);
}

#[test]
fn a_prepared_stream_allocates_nothing() {
    let body = man();
    let walk = authored(&body, "walk");
    let lead = walk.lead_in();
    let posture = |i: f64| walk.sample(i / RATE - lead).posture;
    let mut motion = StreamPlan::new(Arc::clone(&body), 0.5);
    let mut fed = 0.0;
    while fed / RATE <= motion.window() + 0.1 {
        motion.push(&posture(fed), None);
        fed += 1.0;
    }
    motion.advance(StreamTime(1.0 / RATE));
    let mut scene = Scene::of(figure(&body, ControllerKind::Modern, still(posture(0.0))));
    let live = LivePlayback {
        motion,
        offset: 0.0,
    };
    scene
        .figure_mut()
        .set_drive(MotionSource::Live(Box::new(live)));
    let mut walked = false;
    for tick in 0..scene.ticks(walk.duration()) {
        let (world, key) = (&mut scene.world, scene.key);
        // Taking a sample is part of the tick.
        let counted = measure(|| {
            let figure = world.figure_mut(key).unwrap();
            figure
                .stream_mut()
                .unwrap()
                .motion
                .push(&posture(fed), None);
            world.step();
        });
        fed += 1.0;
        walked |= scene.figure().tracker().is_walking();
        if tick >= WARM_UP as u64 {
            assert_eq!(
                (counted.count_total, counted.bytes_total),
                (0, 0),
                "tick {tick}"
            );
        }
    }
    assert!(walked && !scene.figure().is_fallen());
}
