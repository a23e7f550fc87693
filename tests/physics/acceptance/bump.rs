//! Goal: figures that bump into each other at walking pace, or into a wall, stagger and stay up; an unobstructed figure
//! walks as usual. Method: encounters of two walkers, or of a walker and a standing figure, in ten ways, each in five
//! phases of the stride. They are counted, not judged one by one, because the outcome of a single one is chance.

use crate::acceptance::vec3;
use crate::common::collisions::obstacle;
use crate::common::{authored, figure, man, synthesised_cycle};
use sinew_physics::body::topology::CHEST;
use sinew_physics::body::{Body, Profile, Sex};
use sinew_physics::collide::{Mobility, Shape};
use sinew_physics::figure::{ControllerKind, FigureEvent, Perturbation};
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::motion::{Clip, PlanarTransform};
use sinew_physics::time::WorldTime;
use sinew_physics::world::{ClipPlayback, FigureKey, MotionSource, World, WorldParams};
use std::sync::Arc;

/// A participant of an encounter at the world's origin.
#[derive(Clone, Copy)]
struct Comer {
    /// Heading, degrees.
    heading: f64,
    /// Distance by which its path passes the origin on the left, m.
    aside: f64,
    walks: bool,
}

const fn walks(heading: f64, aside: f64) -> Comer {
    Comer {
        heading,
        aside,
        walks: true,
    }
}

const fn stands(heading: f64) -> Comer {
    Comer {
        heading,
        aside: 0.0,
        walks: false,
    }
}

const MEETINGS: [(&str, [Comer; 2]); 10] = [
    ("head-on", [walks(0.0, 0.0), walks(180.0, 0.0)]),
    ("half of the chest", [walks(0.0, 0.1), walks(180.0, 0.1)]),
    ("left shoulders", [walks(0.0, -0.2), walks(180.0, -0.2)]),
    ("right shoulders", [walks(0.0, 0.2), walks(180.0, 0.2)]),
    ("crossing", [walks(0.0, 0.0), walks(90.0, 0.0)]),
    ("crossing aside", [walks(0.0, 0.0), walks(90.0, 0.25)]),
    ("into a front", [walks(0.0, 0.0), stands(180.0)]),
    ("into a back", [walks(0.0, 0.0), stands(0.0)]),
    ("into a side", [walks(0.0, 0.0), stands(90.0)]),
    ("into a shoulder", [walks(0.0, 0.2), stands(180.0)]),
];

/// Starting distances in excess of two metres, m, each of which gives another phase of the stride at the encounter.
const PHASES: [f64; 5] = [0.0, 0.14, 0.28, 0.42, 0.56];

/// A person and its walk.
type Person = (Arc<Body>, Arc<Clip>);

fn person(body: Arc<Body>) -> Person {
    let clip = synthesised_cycle(&body);
    (body, clip)
}

fn woman() -> Arc<Body> {
    Arc::new(Body::humanoid(Profile::ordinary(Sex::Female, 30.0)).unwrap())
}

/// Adds a figure that walks from `back` m before the origin, or stands there.
fn add(world: &mut World, (body, clip): &Person, comer: Comer, back: f64) -> FigureKey {
    let yaw = comer.heading.to_radians();
    let ahead = Quat::exp(Vec3::Z * yaw);
    let place = |first: Vec3, back: f64, yaw: f64| {
        let at =
            ahead.rotate(vec3(-back, comer.aside, 0.0)) - Quat::exp(Vec3::Z * yaw).rotate(first);
        PlanarTransform {
            x: at.x,
            y: at.y,
            yaw,
        }
    };
    let (mut target, origin) = if comer.walks {
        let [first, last] = [0.0, clip.duration()].map(|t| clip.sample(t).posture.root_position);
        let way = last - first;
        let origin = place(first, back, yaw - way.y.atan2(way.x));
        (clip.sample(0.0), origin)
    } else {
        let stand = authored(body, "idle").sample(0.0);
        (stand, place(Vec3::zero(), 0.0, yaw))
    };
    origin.apply_to(&mut target);
    let setup = figure(body, ControllerKind::Modern, target.state());
    let key = world.add_figure(setup).unwrap();
    if comer.walks {
        let walk = ClipPlayback {
            looped: true,
            origin,
            ..ClipPlayback::new(Arc::clone(clip), WorldTime(0.0))
        };
        world
            .figure_mut(key)
            .unwrap()
            .set_drive(MotionSource::Clip(walk));
    }
    key
}

/// Result of an encounter.
#[derive(Default)]
struct Outcome {
    met: bool,
    barred: bool,
    fell: bool,
    /// Speed of the fastest at the end, m/s.
    speed: f64,
}

fn run(world: &mut World, keys: &[FigureKey]) -> Outcome {
    let mut out = Outcome::default();
    for _ in 0..480 {
        world.step();
        out.speed = 0.0;
        for key in keys {
            let f = world.figure(*key).unwrap();
            let r = f.report().unwrap();
            out.met |= !r.touches.is_empty();
            out.barred |= f.events().contains(&FigureEvent::WayBarred);
            out.fell |= f.is_fallen();
            out.speed = out.speed.max(r.balance.com_velocity.norm());
        }
    }
    out
}

/// Counts the encounters of two people in which both stay up.
fn count(people: [&Person; 2]) -> usize {
    let mut up = 0;
    for (name, comers) in MEETINGS {
        let stay = PHASES.map(|early| {
            let mut world = World::new(WorldParams::default()).unwrap();
            let keys = [0, 1].map(|k| add(&mut world, people[k], comers[k], 2.0 + early));
            let o = run(&mut world, &keys);
            assert!(o.met, "{name} from {early} m");
            usize::from(!o.fell)
        });
        let stay: usize = stay.iter().sum();
        println!("{name}: {stay} of {} pairs stay up", PHASES.len());
        up += stay;
    }
    println!("{up} of {}", MEETINGS.len() * PHASES.len());
    up
}

#[test]
fn two_men_who_bump_stay_up_in_eight_of_ten_meetings() {
    let man = person(man());
    assert!(count([&man, &man]) >= 40);
}

#[test]
fn a_woman_and_a_man_who_bump_stay_up_in_eight_of_ten_meetings() {
    let (woman, man) = (person(woman()), person(man()));
    assert!(count([&woman, &man]) >= 40);
}

/// A figure that walks into a wall, straight or at an angle, finally stands in front of it, and has reported why.
#[test]
fn who_walks_into_a_wall_stands_before_it() {
    let man = person(man());
    let mut up = 0;
    for heading in [0.0, 20.0, 40.0] {
        for early in PHASES {
            let mut world = World::new(WorldParams::default()).unwrap();
            let wall = Shape::Box {
                half: vec3(0.1, 4.0, 1.5),
            };
            let at = vec3(0.3, 0.0, 1.5);
            world
                .add_obstacle(obstacle(wall, Mobility::Fixed, at))
                .unwrap();
            let key = add(&mut world, &man, walks(heading, 0.0), 2.0 + early);
            let o = run(&mut world, &[key]);
            assert!(o.met && (o.barred || o.fell), "{heading}° from {early} m");
            if !o.fell {
                assert!(o.speed < 0.1, "{heading}° from {early} m: {} m/s", o.speed);
                up += 1;
            }
        }
    }
    println!("{up} of 15 stand before the wall");
    assert!(up >= 12);
}

#[test]
fn who_meets_nobody_walks_on() {
    let man = person(man());
    let mut world = World::new(WorldParams::default()).unwrap();
    let keys = [
        add(&mut world, &man, walks(0.0, 0.6), 2.0),
        add(&mut world, &man, walks(180.0, 0.6), 2.0),
    ];
    let o = run(&mut world, &keys);
    assert!(!o.met && !o.barred && !o.fell && o.speed > 0.7);
}

/// Pushes of 0.1 s at the chest from four sides, at ten phases of the stride: the number out of each 40 that the walker
/// survives.
#[test]
fn pushes_fell_the_synthesised_walker_soon() {
    let man = person(man());
    let survived = [5.0, 10.0, 20.0].map(|impulse| {
        let mut up = 0;
        for to in [Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y] {
            for phase in 0..10 {
                let mut world = World::new(WorldParams::default()).unwrap();
                let key = add(&mut world, &man, walks(0.0, 0.0), 2.0);
                let from = 1.5 + 0.11 * f64::from(phase);
                let push = Perturbation::Force {
                    segment: CHEST,
                    point: vec3(0.0, 0.0, 0.1),
                    force: to * (impulse / 0.1),
                    from,
                    to: from + 0.1,
                };
                world.perturb(key, push).unwrap();
                up += usize::from(!run(&mut world, &[key]).fell);
            }
        }
        println!("{impulse} N·s: {up} of 40 are survived");
        up
    });
    let [slight, light, hard] = survived;
    assert!(slight == 40 && light >= 38 && hard >= 19, "{survived:?}");
}
