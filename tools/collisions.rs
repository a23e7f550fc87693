//! Figures that collide with figures and obstacles: runs each scene, draws it as a strip and reports the result.
//!
//! ```sh
//! cargo run --release -p tools --bin collisions -- out
//! ```
use sinew_evaluate::Tick;
use sinew_evaluate::strip::{
    StripFrame, StripOptions, Thing, View, draw, evenly_spaced, raster, svg,
};
use sinew_physics::body::topology::CHEST;
use sinew_physics::body::{Body, State};
use sinew_physics::collide::{Mobility, ObstacleSetup, Shape};
use sinew_physics::figure::{ControllerKind, Perturbation};
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::motion::builtin::builtin;
use sinew_physics::world::{FigureKey, FigureSetup, World, WorldParams};
use std::path::Path;
use std::sync::Arc;

fn at(x: f64, y: f64, z: f64) -> Vec3 {
    Vec3 { x, y, z }
}

/// Adds a figure that stands at x, y and faces along `yaw`.
fn stander(world: &mut World, x: f64, y: f64, yaw: f64) -> FigureKey {
    let body = Arc::new(Body::adult_man());
    let idle = builtin(&body, "idle").expect("a built-in motion");
    let mut state = State::at_rest(*idle.posture(0));
    let turn = Quat::exp(Vec3::Z * yaw);
    let p = &mut state.posture;
    p.root_position = turn.rotate(p.root_position) + at(x, y, 0.0);
    p.root_rotation = turn * p.root_rotation;
    let setup = FigureSetup::new(body, ControllerKind::Modern, state);
    world.add_figure(setup).expect("a valid figure")
}

fn push(world: &mut World, key: FigureKey, impulse: f64, from: f64) {
    let what = Perturbation::Force {
        segment: CHEST,
        point: at(0.0, 0.0, 0.1),
        force: at(impulse / 0.1, 0.0, 0.0),
        from,
        to: from + 0.1,
    };
    world.perturb(key, what).expect("a valid push");
}

fn into_each_other() -> (World, FigureKey, f64) {
    let mut world = World::new(WorldParams::default()).expect("a valid world");
    let a = stander(&mut world, -0.35, 0.0, 0.0);
    let b = stander(&mut world, 0.35, 0.0, std::f64::consts::PI);
    push(&mut world, a, 60.0, 0.2);
    push(&mut world, b, -60.0, 0.2);
    (world, a, 3.0)
}

fn ball() -> (World, FigureKey, f64) {
    let mut world = World::new(WorldParams::default()).expect("a valid world");
    let a = stander(&mut world, 0.0, 0.0, 0.0);
    let thrown = ObstacleSetup {
        name: "ball".to_owned(),
        shape: Shape::Sphere { radius: 0.12 },
        mobility: Mobility::Free(5.0),
        friction: 0.6,
        position: at(1.2, 0.0, 1.35),
        rotation: Quat::identity(),
        velocity: at(-5.0, 0.0, 0.9),
        angular_velocity: Vec3::zero(),
    };
    world.add_obstacle(thrown).expect("a valid obstacle");
    (world, a, 1.5)
}

fn onto_another() -> (World, FigureKey, f64) {
    let mut world = World::new(WorldParams::default()).expect("a valid world");
    let a = stander(&mut world, -0.45, 0.05, 0.0);
    stander(&mut world, 0.45, 0.0, 0.0);
    push(&mut world, a, 100.0, 0.1);
    (world, a, 4.0)
}

fn main() -> std::io::Result<()> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "out".to_owned());
    std::fs::create_dir_all(&folder)?;
    let scenes = [
        ("pushed-together", into_each_other()),
        ("ball", ball()),
        ("falls-onto", onto_another()),
    ];
    for (name, (mut world, key, seconds)) in scenes {
        let ticks = (seconds * world.params().rate_hz) as u64;
        let shown = evenly_spaced(ticks, 8);
        let (mut frames, mut depth, mut most) = (Vec::new(), 0.0f64, 0.0f64);
        for n in 0..ticks {
            world.step();
            depth = depth.max(world.collisions().depth);
            let figure = world.figure(key).expect("nobody removes it");
            let report = figure.report().expect("a stepped figure has a report");
            let force = report.touches.iter().fold(Vec3::zero(), |f, t| f + t.force);
            most = most.max(force.norm());
            if shown.contains(&n) {
                let tick = Tick {
                    body: figure.body(),
                    links: figure.links(),
                    target: figure.target(),
                    report,
                    state: figure.state(),
                    strength: (figure.strength(), figure.muscles()),
                    gravity: world.params().gravity,
                };
                let others = world.figures().filter(|(k, _)| *k != key);
                let others = others.flat_map(|(_, f)| Thing::figure(f.body(), &f.state().posture));
                let things = world.obstacles().map(|(_, o)| Thing::obstacle(o.setup()));
                let frame = StripFrame::of(&tick, world.time().0, Vec::new());
                frames.push(frame.among(others.chain(things)));
            }
        }
        let fallen = world.figures().filter(|(_, f)| f.is_fallen()).count();
        println!(
            "{name}: {} of {} fell; largest force of others {most:.0} N, deepest overlap {:.1} mm",
            fallen,
            world.figures().count(),
            1e3 * depth
        );
        let options = StripOptions {
            view: View::Side,
            title: name.to_owned(),
            ..StripOptions::default()
        };
        let body = Body::adult_man();
        let drawing = draw(&body, &frames, &options);
        let path = Path::new(&folder).join(format!("{name}.svg"));
        std::fs::write(&path, svg::write(&drawing))?;
        let png = raster::png(&drawing).expect("it fits in memory");
        std::fs::write(path.with_extension("png"), png)?;
    }
    Ok(())
}
