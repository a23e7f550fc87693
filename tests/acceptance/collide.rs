//! Goal: figures and obstacles that meet push each other, as much as they are pushed; nothing passes through, nothing comes from nowhere,
//! and whoever is not touched does not notice.
//! Method: a ball thrown at a figure, two figures pushed into each other, one falling onto another, two that dance; books of momentum and of
//! the work of contacts by the tick, overlaps, and the hashes of bystanders.

use crate::common::{Scene, authored, bent, figure, man, play, recorded_with, still};
use crate::{integrals, vec3};
use sinew::evaluate::audit;
use sinew::sim::body::topology::{CHEST, HEAD};
use sinew::sim::body::{Body, State};
use sinew::sim::collide::{Mobility, ObstacleKey, ObstacleSetup, Other, Shape};
use sinew::sim::figure::{ControllerKind, FigureEvent, Flags, Perturbation};
use sinew::sim::math::{Quat, Vec3};
use sinew::sim::motion::Clip;
use sinew::sim::motion::retarget::RetargetOptions;
use sinew::sim::world::{Drive, FigureKey, FigureSetup, World, WorldParams};
use std::sync::Arc;

/// An obstacle at rest.
fn obstacle(shape: Shape, mobility: Mobility, position: Vec3) -> ObstacleSetup {
    ObstacleSetup {
        name: "obstacle".to_owned(),
        shape,
        mobility,
        friction: 0.6,
        position,
        rotation: Quat::identity(),
        velocity: Vec3::zero(),
        angular_velocity: Vec3::zero(),
    }
}

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

/// Someone who stands at `x`, `y`, turned by `yaw`.
fn stander(body: &Arc<Body>, kind: ControllerKind, x: f64, y: f64, yaw: f64) -> FigureSetup {
    let posture = authored(body, "idle").posture(0).to_owned();
    let mut setup = figure(body, kind, still(posture));
    let turn = Quat::exp(Vec3::Z * yaw);
    let p = &mut setup.state.posture;
    p.root_position = turn.rotate(p.root_position) + vec3(x, y, 0.0);
    p.root_rotation = turn * p.root_rotation;
    setup
}

/// What a run of a world with collisions showed.
#[derive(Debug, Default)]
struct Meter {
    ticks: u64,
    touched: u64,
    switches: u64,
    /// Largest sum of all forces between bodies over the largest of them.
    unbalanced: f64,
    /// Largest overlap in the last 0.2 s … end.
    depth: f64,
    late_depth: f64,
    /// Work of contacts, J, and the largest gain of one tick.
    work: f64,
    gain: f64,
    unfinished: u64,
    islands: u64,
    iterations: u64,
    residual: f64,
    speed: f64,
    first: Option<u64>,
}

impl Meter {
    fn observe(&mut self, world: &World) {
        self.ticks += 1;
        let c = world.collisions();
        let (mut sum, mut most, mut touching) = (Vec3::zero(), 0.0f64, false);
        for (_, f) in world.figures() {
            let r = f.report().unwrap();
            assert!(r.over_limit <= 1e-9, "torques stay within strength");
            assert!(!r.flags.has(Flags::QUARANTINED));
            for t in &r.touches {
                if t.depth > 0.008 && std::env::var_os("DIAG").is_some() {
                    println!(
                        "  tick {} {} at {:?} depth {:.1} mm force {:.0} n {:.2?}",
                        world.tick(),
                        t.segment.name(),
                        match t.other {
                            Other::Figure(_, s) => s.name(),
                            _ => "obstacle",
                        },
                        1e3 * t.depth,
                        t.force.norm(),
                        t.normal.to_array()
                    );
                }
                touching = true;
                most = most.max(t.force.norm());
                let free = match t.other {
                    Other::Figure(..) => true,
                    Other::Obstacle(k) => world.obstacle(k).unwrap().mass().is_some(),
                };
                if free {
                    sum += t.force;
                }
            }
            for e in f.events() {
                let switch = matches!(e, FigureEvent::Touched { .. } | FigureEvent::Parted { .. });
                self.switches += u64::from(switch);
            }
            self.speed = f.state().velocity[6..]
                .iter()
                .fold(self.speed, |m, v| m.max(v.abs()));
            let a = audit::audit(f.links(), &r.audit, world.params().gravity);
            self.residual = self.residual.max(a.relative);
        }
        for (_, o) in world.obstacles() {
            if o.mass().is_some() {
                sum += o.force();
            }
        }
        if most > 0.0 {
            self.unbalanced = self.unbalanced.max(sum.norm() / most);
        }
        if touching {
            self.touched += 1;
            self.first.get_or_insert(self.ticks);
        }
        self.depth = self.depth.max(c.depth);
        if self.first.is_some_and(|f| self.ticks > f + 12) {
            self.late_depth = self.late_depth.max(c.depth);
        }
        self.work += c.work;
        self.gain = self.gain.max(c.work);
        self.unfinished += c.unfinished;
        self.islands += c.islands;
        self.iterations += c.iterations;
    }
}

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
            let b = world
                .add_obstacle(ball(start, from * -5.0 + Vec3::Z * 0.6))
                .unwrap();
            let mut m = Meter::default();
            for _ in 0..180 {
                world.step();
                m.observe(&world);
            }
            let f = world.figure(key).unwrap();
            let o = world.obstacle(b).unwrap().setup();
            println!(
                "{kind:?} {name}: fell {} ball {:?} {:?}",
                f.is_fallen(),
                o.position,
                m
            );
        }
    }
}

#[test]
fn two_figures_pushed_into_each_other() {
    let body = man();
    for kind in [
        ControllerKind::Modern,
        ControllerKind::Paper,
        ControllerKind::Motors,
    ] {
        let mut world = World::new(WorldParams::default()).unwrap();
        let a = world
            .add_figure(stander(&body, kind, -0.35, 0.0, 0.0))
            .unwrap();
        let b = world
            .add_figure(stander(&body, kind, 0.35, 0.0, 3.141592653589793))
            .unwrap();
        for (k, s) in [(a, 1.0), (b, -1.0)] {
            world
                .perturb(
                    k,
                    Perturbation::Force {
                        segment: CHEST,
                        point: vec3(0.0, 0.0, 0.1),
                        force: vec3(s * 600.0, 0.0, 0.0),
                        from: 0.2,
                        to: 0.3,
                    },
                )
                .unwrap();
        }
        let mut m = Meter::default();
        for _ in 0..240 {
            world.step();
            m.observe(&world);
        }
        println!(
            "{kind:?}: fell {} {} {:?}",
            world.figure(a).unwrap().is_fallen(),
            world.figure(b).unwrap().is_fallen(),
            m
        );
    }
}

#[test]
fn a_figure_falls_onto_another() {
    let body = man();
    for kind in [ControllerKind::Modern, ControllerKind::Motors] {
        let mut world = World::new(WorldParams::default()).unwrap();
        let a = world
            .add_figure(stander(&body, kind, -0.45, 0.05, 0.0))
            .unwrap();
        let b = world
            .add_figure(stander(&body, kind, 0.45, 0.0, 0.0))
            .unwrap();
        world
            .perturb(
                a,
                Perturbation::Force {
                    segment: CHEST,
                    point: vec3(0.0, 0.0, 0.1),
                    force: vec3(1000.0, 0.0, 0.0),
                    from: 0.1,
                    to: 0.2,
                },
            )
            .unwrap();
        let mut m = Meter::default();
        for _ in 0..300 {
            world.step();
            m.observe(&world);
        }
        println!(
            "{kind:?}: fell {} {} {:?}",
            world.figure(a).unwrap().is_fallen(),
            world.figure(b).unwrap().is_fallen(),
            m
        );
    }
}

/// A recording where and as it was taken, so that partners stay partners.
fn dancing(body: &Body, name: &str) -> Arc<Clip> {
    let options = RetargetOptions {
        keep_origin: true,
        ..RetargetOptions::default()
    };
    recorded_with(body, name, &options)
}

#[test]
fn salsa() {
    let body = man();
    let mut world = World::new(WorldParams::default()).unwrap();
    let mut keys = Vec::new();
    for name in ["salsa-a", "salsa-b"] {
        let clip = dancing(&body, name);
        let first = clip.sample(0.0);
        println!("{name} starts at {:?}", first.posture.root_position);
        let state = State {
            posture: first.posture,
            velocity: first.velocity,
        };
        let k = world
            .add_figure(figure(&body, ControllerKind::Modern, state))
            .unwrap();
        world.figure_mut(k).unwrap().set_drive(play(&clip));
        keys.push(k);
    }
    let mut m = Meter::default();
    for i in 0..600 {
        world.step();
        m.observe(&world);
        if i % 60 == 0 {
            let c: Vec<_> = keys
                .iter()
                .map(|k| world.figure(*k).unwrap().report().unwrap().com)
                .collect();
            println!(
                "{i} {:.2} {:.2} apart {:.2} {} {} {}",
                c[0].z,
                c[1].z,
                (c[0] - c[1]).norm(),
                m.depth,
                m.unfinished,
                m.switches
            );
        }
    }
    println!("{:?}", m);
}
