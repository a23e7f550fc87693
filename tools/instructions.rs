//! Runs one piece of work N times and nothing else, for instruction counts under valgrind: `instructions WORK N`.
//! See `tools/benches/instructions.sh`, which takes the difference of two runs, so that start-up cancels.

use sinew_physics::body::{Body, Links, NV, State};
use sinew_physics::dynamics::lanes::rnea_x8;
use sinew_physics::dynamics::{
    CompositeInertia, ExternalForces, Kinematics, MassMatrix, RneaWorkspace, Terms, crba, factor,
    rnea, solve,
};
use sinew_physics::figure::ControllerKind;
use sinew_physics::math::{F64x8, Lane};
use sinew_physics::motion::builtin::builtin;
use sinew_physics::time::WorldTime;
use sinew_physics::world::{ClipPlayback, FigureSetup, MotionSource, World, WorldParams};
use std::hint::black_box;
use std::sync::Arc;

const GRAVITY: f64 = 9.81;

/// A bent posture in motion, and an acceleration.
fn sample() -> (State, [f64; NV]) {
    let wave = |most: f64| std::array::from_fn(|i| most * ((i * i) as f64 * 0.7).sin());
    let mut state = State::default();
    state.posture.integrate(&wave(0.8), 1.0);
    state.velocity = wave(1.0);
    (state, wave(10.0))
}

/// A world with one man, squatting endlessly.
fn squatting(controller: ControllerKind) -> World {
    let body = Arc::new(Body::adult_man());
    let clip = Arc::new(builtin(&body, "squat").expect("a built-in motion"));
    let start = clip.sample_looped(0.0);
    let mut world = World::new(WorldParams::default()).expect("default parameters");
    let key = world
        .add_figure(FigureSetup::new(body, controller, start.state()))
        .expect("a valid figure");
    let figure = world.figure_mut(key).expect("just added");
    figure.set_drive(MotionSource::Clip(ClipPlayback {
        looped: true,
        ..ClipPlayback::new(clip, WorldTime(0.0))
    }));
    world
}

fn main() {
    let mut args = std::env::args().skip(1);
    let (Some(work), Some(count)) = (args.next(), args.next().and_then(|n| n.parse::<u64>().ok()))
    else {
        eprintln!(
            "usage: instructions kinematics|rnea|rnea_x8|crba_factor_solve|terms|paper_tick|modern_tick N"
        );
        std::process::exit(2);
    };
    let links = Links::new(&Body::adult_man());
    let (state, acceleration) = sample();
    let mut kin = Kinematics::default();
    match work.as_str() {
        "kinematics" => {
            for _ in 0..count {
                kin.set_state(black_box(&links), black_box(&state));
            }
            black_box(&kin);
        }
        "rnea" => {
            let (mut ws, mut tau) = (RneaWorkspace::default(), [0.0; NV]);
            for _ in 0..count {
                kin.set_state(black_box(&links), black_box(&state));
                rnea(
                    &links,
                    &kin,
                    &state.velocity,
                    &acceleration,
                    ExternalForces::gravity(GRAVITY),
                    &mut ws,
                    &mut tau,
                );
                black_box(&tau);
            }
        }
        "rnea_x8" => {
            let links = Links::<F64x8>::splat(&links);
            let mut states = State::default();
            for k in 0..8 {
                states.set_lane(k, &state);
            }
            let acceleration = acceleration.map(F64x8::splat);
            let mut kin = Kinematics::default();
            let (mut ws, mut tau) = (RneaWorkspace::default(), [F64x8::zero(); NV]);
            for _ in 0..count {
                let gravity = F64x8::splat(GRAVITY);
                rnea_x8(
                    black_box(&links),
                    black_box(&states),
                    &acceleration,
                    ExternalForces::gravity(gravity),
                    &mut kin,
                    &mut ws,
                    &mut tau,
                );
                black_box(&tau);
            }
        }
        "crba_factor_solve" => {
            let (mut composite, mut mass) = (CompositeInertia::default(), MassMatrix::default());
            for _ in 0..count {
                kin.set_posture(black_box(&links), black_box(&state.posture));
                crba(&links, &kin, &mut composite, &mut mass);
                factor(&mut mass);
                let mut x = acceleration;
                solve(&mass, &mut x);
                black_box(&x);
            }
        }
        "terms" => {
            let mut terms = Terms::default();
            for _ in 0..count {
                terms.compute(black_box(&links), black_box(&state), &[], GRAVITY);
            }
            black_box(&terms);
        }
        "paper_tick" | "modern_tick" => {
            let controller = if work == "paper_tick" {
                ControllerKind::Paper
            } else {
                ControllerKind::Modern
            };
            let mut world = squatting(controller);
            for _ in 0..count {
                world.step();
            }
            black_box(world.state_hash());
        }
        other => {
            eprintln!("no work is called {other:?}");
            std::process::exit(2);
        }
    }
}
