//! Goal: colliding figures and obstacles push each other equally; nothing passes through, no momentum or energy appears
//! from nowhere, and untouched figures are unaffected. Method: a ball thrown at a figure, two figures pushed into each
//! other, one falling onto another, two that dance; the balance of momentum and the work of contacts in each tick,
//! overlaps, and the hashes of bystanders.

use crate::acceptance::vec3;
use crate::common::actors::in_both_hands;
use crate::common::collisions::{Meter, obstacle};
use crate::common::{authored, figure, man, still};
use sinew_physics::body::Body;
use sinew_physics::body::topology::CHEST;
use sinew_physics::collide::{MAX_OBSTACLES, Mobility, ObstacleSetup, Shape};
use sinew_physics::figure::{ControllerKind, Flags, Perturbation, StepperKind};
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::world::{FigureKey, FigureSetup, World, WorldError, WorldParams};
use std::sync::Arc;

/// A ball of 5 kg.
fn ball(position: Vec3, velocity: Vec3) -> ObstacleSetup {
    ObstacleSetup {
        velocity,
        ..obstacle(
            Shape::Sphere { radius: 0.12 },
            Mobility::Free(5.0),
            position,
        )
    }
}

/// A figure standing at `x`, `y`, turned by `yaw`.
fn stander(body: &Arc<Body>, kind: ControllerKind, x: f64, y: f64, yaw: f64) -> FigureSetup {
    let posture = authored(body, "idle").posture(0).to_owned();
    let mut setup = figure(body, kind, still(posture));
    let turn = Quat::exp(Vec3::Z * yaw);
    let p = &mut setup.state.posture;
    p.root_position = turn.rotate(p.root_position) + vec3(x, y, 0.0);
    p.root_rotation = turn * p.root_rotation;
    setup
}

/// A ball of 5 kg at 5 m/s from three sides, for every controller. Balance of the ball: its momentum changes by the
/// contact force and by gravity.
#[test]
fn a_ball_hits_a_figure() {
    let body = man();
    for kind in [
        ControllerKind::Modern,
        ControllerKind::Paper,
        ControllerKind::Motors,
    ] {
        for (name, from) in [("front", Vec3::X), ("side", Vec3::Y), ("back", -Vec3::X)] {
            let mut world = World::new(WorldParams::default()).unwrap();
            let key = world
                .add_figure(stander(&body, kind, 0.0, 0.0, 0.0))
                .unwrap();
            let start = vec3(0.0, 0.0, 1.35) + from * 0.9;
            let thrown = ball(start, from * -5.0 + Vec3::Z * 0.6);
            let b = world.add_obstacle(thrown).unwrap();
            let mut m = Meter::default();
            for _ in 0..180 {
                let before = world.obstacle(b).unwrap().setup().velocity;
                world.step();
                m.observe(&world);
                let o = world.obstacle(b).unwrap();
                let (dv, dt) = (o.setup().velocity - before, world.dt());
                let want = (o.force() - Vec3::Z * (5.0 * super::GRAVITY)) * dt;
                assert!(
                    (dv * 5.0 - want).norm() < 1e-6 * 25.0,
                    "momentum of the ball"
                );
            }
            let fell = world.figure(key).unwrap().is_fallen();
            m.judge(&format!("{kind:?} {name}, fell {fell}"), 60.0);
            let o = world.obstacle(b).unwrap().setup();
            assert!(
                (o.position.z - 0.12).abs() < 0.005,
                "the ball lies on the ground"
            );
        }
    }
}

fn push(world: &mut World, key: FigureKey, newtons: f64, from: f64) {
    let what = Perturbation::Force {
        segment: CHEST,
        point: vec3(0.0, 0.0, 0.1),
        force: vec3(newtons, 0.0, 0.0),
        from,
        to: from + 0.1,
    };
    world.perturb(key, what).unwrap();
}

/// Face to face, each pushed towards the other with 60 N·s.
fn face_to_face(kind: ControllerKind, threads: usize) -> World {
    let body = man();
    let mut world = World::new(WorldParams {
        threads,
        ..WorldParams::default()
    })
    .unwrap();
    let half_turn = std::f64::consts::PI;
    for (x, yaw, newtons) in [(-0.35, 0.0, 600.0), (0.35, half_turn, -600.0)] {
        let key = world.add_figure(stander(&body, kind, x, 0.0, yaw)).unwrap();
        push(&mut world, key, newtons, 0.2);
    }
    world
}

#[test]
fn two_figures_are_pushed_into_each_other() {
    for kind in [
        ControllerKind::Modern,
        ControllerKind::Paper,
        ControllerKind::Motors,
    ] {
        let mut world = face_to_face(kind, 1);
        let mut m = Meter::default();
        for _ in 0..240 {
            world.step();
            m.observe(&world);
        }
        let fell: Vec<bool> = world.figures().map(|(_, f)| f.is_fallen()).collect();
        m.judge(&format!("{kind:?}, fell {fell:?}"), 60.0);
    }
}

#[test]
fn a_figure_falls_onto_another() {
    let body = man();
    for kind in [ControllerKind::Modern, ControllerKind::Motors] {
        let mut world = World::new(WorldParams::default()).unwrap();
        let setup = stander(&body, kind, -0.45, 0.05, 0.0);
        let a = world.add_figure(setup).unwrap();
        world
            .add_figure(stander(&body, kind, 0.45, 0.0, 0.0))
            .unwrap();
        push(&mut world, a, 1000.0, 0.1);
        let mut m = Meter::default();
        for _ in 0..300 {
            world.step();
            m.observe(&world);
        }
        let fell: Vec<bool> = world.figures().map(|(_, f)| f.is_fallen()).collect();
        m.judge(&format!("{kind:?}, fell {fell:?}"), 60.0);
    }
}

/// A figure within arm's length of a collision and a figure out of reach keep the bits that they have alone. The number
/// of threads changes nothing.
#[test]
fn bystanders_and_threads_do_not_matter() {
    let body = man();
    let kind = ControllerKind::Modern;
    let places = [(0.0, 1.3), (0.0, 30.0)];
    let alone: Vec<Vec<u64>> = places
        .iter()
        .map(|(x, y)| {
            let mut world = World::new(WorldParams::default()).unwrap();
            let key = world.add_figure(stander(&body, kind, *x, *y, 0.0)).unwrap();
            (0..90)
                .map(|_| {
                    world.step();
                    world.figure(key).unwrap().state_hash()
                })
                .collect()
        })
        .collect();
    let mut hashes: Vec<Vec<u64>> = Vec::new();
    for threads in [1, 2, 7] {
        let mut world = face_to_face(kind, threads);
        let keys: Vec<FigureKey> = places
            .iter()
            .map(|(x, y)| world.add_figure(stander(&body, kind, *x, *y, 0.0)).unwrap())
            .collect();
        let mut met = 0;
        let mut all = Vec::new();
        for i in 0..90 {
            world.step();
            met += world.collisions().contacts;
            for (key, want) in keys.iter().zip(&alone) {
                assert_eq!(world.figure(*key).unwrap().state_hash(), want[i]);
            }
            all.push(world.state_hash());
        }
        assert!(met > 0, "the other two have met");
        hashes.push(all);
    }
    assert!(hashes.iter().all(|h| *h == hashes[0]));
}

/// The same holds beside a free-standing wall that is near but not touched, while both hands hold a load, and while
/// help carries a figure that was pushed along it: the start of a substep does not depend on how often it is opened.
#[test]
fn a_wall_that_is_near_changes_nothing_for_full_hands_or_with_help() {
    let body = man();
    let load = in_both_hands(0.1);
    let along = Perturbation::Force {
        segment: CHEST,
        point: vec3(0.0, 0.0, 0.1),
        force: vec3(900.0, 0.0, 0.0),
        from: 0.2,
        to: 0.3,
    };
    for (what, max_help) in [(Perturbation::Held(load), 0.0), (along, 0.3)] {
        let world = |wall: Option<f64>| {
            let mut world = World::new(WorldParams::default()).unwrap();
            let mut setup = stander(&body, ControllerKind::Modern, 0.0, 0.0, 0.0);
            setup.options.max_help = max_help;
            let key = world.add_figure(setup).unwrap();
            world.perturb(key, what).unwrap();
            if let Some(y) = wall {
                let half = vec3(3.0, 0.1, 0.8);
                let place = vec3(0.0, y + half.y, half.z);
                let wall = obstacle(Shape::Box { half }, Mobility::Free(200.0), place);
                world.add_obstacle(wall).unwrap();
            }
            (world, key)
        };
        let (mut alone, key) = world(None);
        let mut carried = Vec::new();
        let hashes: Vec<u64> = (0..90)
            .map(|_| {
                alone.step();
                let f = alone.figure(key).unwrap();
                carried.push(f.is_carried());
                f.state_hash()
            })
            .collect();
        let mut beside_it = 0;
        for cm in 30..48 {
            let (mut beside, key) = world(Some(0.01 * f64::from(cm)));
            for (hash, carried) in hashes.iter().zip(&carried) {
                beside.step();
                let f = beside.figure(key).unwrap();
                if !f.report().unwrap().touches.is_empty() {
                    break;
                }
                assert_eq!(f.state_hash(), *hash, "{cm} cm, tick {}", beside.tick());
                beside_it += u32::from(max_help == 0.0 || *carried);
            }
        }
        assert!(beside_it > 300, "beside it for {beside_it} ticks");
    }
}

/// A tower of a ball, a box and a long object comes to rest and stays.
#[test]
fn things_come_to_rest() {
    let mut world = World::new(WorldParams::default()).unwrap();
    let half = vec3(0.3, 0.3, 0.2);
    let free = Mobility::Free(20.0);
    let low = obstacle(Shape::Box { half }, free, vec3(0.0, 0.0, 0.25));
    let high = obstacle(
        Shape::Box { half: half * 0.5 },
        Mobility::Free(3.0),
        vec3(0.05, 0.02, 0.6),
    );
    let log = ObstacleSetup {
        rotation: Quat::exp(vec3(0.3, 1.2, 0.0)),
        ..obstacle(
            Shape::Capsule {
                radius: 0.1,
                half_length: 0.4,
            },
            Mobility::Free(10.0),
            vec3(2.0, 0.0, 0.7),
        )
    };
    let keys = [low, high, log].map(|o| world.add_obstacle(o).unwrap());
    for _ in 0..300 {
        world.step();
    }
    for (key, z) in keys.into_iter().zip([0.2, 0.5, 0.1]) {
        let s = world.obstacle(key).unwrap().setup();
        let text = format!("{:?} {:?}", s.position, s.velocity);
        assert!((s.position.z - z).abs() < 2e-3, "{text}");
        assert!(s.velocity.norm() < 0.02, "{text}");
    }
}

/// An invalid obstacle is refused with its fault named, and changes nothing.
#[test]
fn bad_obstacles_are_refused() {
    let mut world = World::new(WorldParams::default()).unwrap();
    let good = || ball(vec3(0.0, 0.0, 1.0), Vec3::zero());
    let key = world.add_obstacle(good()).unwrap();
    let before = world.state_hash();
    let edits: [(&str, fn(&mut ObstacleSetup, f64)); 7] = [
        ("obstacle.position_m", |o, x| o.position.y = x),
        ("obstacle.rotation", |o, x| o.rotation.w = x),
        ("obstacle.velocity_mps", |o, x| o.velocity.z = x),
        ("obstacle.angular_velocity_radps", |o, x| {
            o.angular_velocity.x = x
        }),
        ("obstacle.friction", |o, x| o.friction = x),
        ("obstacle.mass_kg", |o, x| o.mobility = Mobility::Free(x)),
        ("obstacle.sphere.radius_m", |o, x| {
            o.shape = Shape::Sphere { radius: x }
        }),
    ];
    for (field, edit) in edits {
        for x in [f64::NAN, f64::INFINITY, -1e9, 1e9] {
            let mut o = good();
            edit(&mut o, x);
            for refused in [
                world.add_obstacle(o.clone()).map(drop),
                world.update_obstacle(key, o),
            ] {
                match refused {
                    Err(WorldError::Range { field: f, .. }) => assert_eq!(f, field),
                    other => panic!("{field} {x}: {other:?}"),
                }
            }
        }
    }
    let plane = obstacle(Shape::Plane, Mobility::Free(1.0), Vec3::zero());
    assert_eq!(world.add_obstacle(plane), Err(WorldError::FreePlane));
    assert_eq!(world.state_hash(), before);
    for _ in 1..MAX_OBSTACLES {
        world.add_obstacle(good()).unwrap();
    }
    let full = world.add_obstacle(good());
    assert_eq!(full, Err(WorldError::TooManyObstacles));
    assert!(world.remove_obstacle(key) && !world.remove_obstacle(key));
    let gone = world.update_obstacle(key, good());
    assert_eq!(gone, Err(WorldError::UnknownObstacle(key)));
}

/// Prescribed accelerations ignore forces, so torques take over before a contact, and only then.
#[test]
fn a_kinematic_figure_is_handed_over_when_a_ball_comes() {
    let body = man();
    let still = || FigureSetup {
        stepper: StepperKind::Kinematic,
        ..stander(&body, ControllerKind::Paper, 0.0, 0.0, 0.0)
    };
    let mut alone = World::new(WorldParams::default()).unwrap();
    let a = alone.add_figure(still()).unwrap();
    let mut world = World::new(WorldParams::default()).unwrap();
    let key = world.add_figure(still()).unwrap();
    let thrown = ball(vec3(2.0, 0.0, 1.2), vec3(-5.0, 0.0, 1.7));
    world.add_obstacle(thrown).unwrap();
    let mut m = Meter::default();
    let mut handed = None;
    for tick in 0..60 {
        alone.step();
        world.step();
        m.observe(&world);
        let f = world.figure(key).unwrap();
        let r = f.report().unwrap();
        let over = r.flags.has(Flags::HANDED_OVER);
        assert!(over || r.touches.is_empty(), "touches need torques");
        if over {
            handed.get_or_insert(tick);
        } else if handed.is_none() {
            let bits = alone.figure(a).unwrap().state_hash();
            assert_eq!(f.state_hash(), bits, "nothing was near yet");
        }
    }
    assert!(handed.is_some_and(|t| t > 5), "handed over at {handed:?}");
    m.judge("kinematic", 60.0);
}
