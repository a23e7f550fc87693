//! Runs one piece of work N times and nothing else, for instruction counts under valgrind: `instructions WORK N`.
//! See `benches/instructions.sh`, which takes the difference of two runs, so that start-up cancels.

use sinew::sim::body::{Body, Links, NV, State};
use sinew::sim::dynamics::lanes::rnea_x8;
use sinew::sim::dynamics::{
    CompositeInertia, Kinematics, MassMatrix, RneaWorkspace, Terms, crba, factor, rnea, solve,
};
use sinew::sim::math::{F64x8, Lane};
use std::hint::black_box;

const GRAVITY: f64 = 9.81;

/// A bent posture in motion, and an acceleration.
fn sample() -> (State, [f64; NV]) {
    let wave = |most: f64| std::array::from_fn(|i| most * ((i * i) as f64 * 0.7).sin());
    let mut state = State::default();
    state.posture.integrate(&wave(0.8), 1.0);
    state.velocity = wave(1.0);
    (state, wave(10.0))
}

fn main() {
    let mut args = std::env::args().skip(1);
    let (Some(work), Some(count)) = (args.next(), args.next().and_then(|n| n.parse::<u64>().ok()))
    else {
        eprintln!("usage: instructions kinematics|rnea|rnea_x8|crba_factor_solve|terms N");
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
                    GRAVITY,
                    &[],
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
                    gravity,
                    &[],
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
        other => {
            eprintln!("no work is called {other:?}");
            std::process::exit(2);
        }
    }
}
