//! The dynamics against themselves, against closed forms and against numbers recorded from other engines.
//!
//! * `identities`: independent algorithms agree on random bodies and states.
//! * `differences`: Jacobians, bias terms and rates against finite differences.
//! * `closed_forms`: pendulums, free fall, flight, statics.
//! * `lanes`: eight figures in lock-step carry the bits of one.
//! * `reference`, `vectors`: numbers recorded from Pinocchio and MuJoCo, with the scripts that made them.
//!
//! The live comparison with both engines is `test_dynamics.py` beside this file.

mod bodies;
mod closed_forms;
mod differences;
mod identities;
mod lanes;
mod reference;
mod vectors;

use sinew_physics::body::{Links, NV, State};
use sinew_physics::dynamics::{ExternalForces, Kinematics, RneaWorkspace, Terms, rnea};

/// Standard gravity of the tests, m/s².
const GRAVITY: f64 = 9.81;

/// Terms of one state.
fn terms(links: &Links, state: &State) -> Terms {
    let mut t = Terms::default();
    t.compute(links, state, &[], GRAVITY);
    t
}

/// Torques of inverse dynamics.
fn inverse(links: &Links, state: &State, vdot: &[f64; NV], gravity: f64) -> [f64; NV] {
    let mut kin = Kinematics::default();
    kin.set_state(links, state);
    let mut tau = [0.0; NV];
    let mut ws = RneaWorkspace::default();
    rnea(
        links,
        &kin,
        &state.velocity,
        vdot,
        ExternalForces::gravity(gravity),
        &mut ws,
        &mut tau,
    );
    tau
}

/// Largest magnitude.
fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |m, v| m.max(v.abs()))
}

/// Largest difference relative to the largest magnitude of `b`.
fn relative(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let off = a.iter().zip(b).fold(0.0f64, |m, (x, y)| {
        let d = (x - y).abs();
        if d.is_nan() { f64::INFINITY } else { m.max(d) }
    });
    off / largest(b).max(f64::MIN_POSITIVE)
}
