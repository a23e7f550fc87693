//! The loads that people can hold still: arm straight out in front, and elbow bent.

use sinew_physics::body::angles::{anatomical_angles, set_anatomical_angles};
use sinew_physics::body::topology::{DOF_COUNT, DOF_NAMES, R_HAND};
use sinew_physics::body::{Body, Links, Posture, State};
use sinew_physics::dynamics::Terms;
use sinew_physics::figure::StrengthScale;
use sinew_physics::figure::motion::tasks::grip;
use sinew_physics::motion::GRAVITY;
use sinew_physics::strength::Strength;

/// A posture that is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeldPosture {
    /// Right arm level and straight, forwards; shoulder flexion decides.
    StraightArm,
    /// Right upper arm hanging, forearm level; elbow flexion decides.
    Curl,
}

/// Share of strength that the deciding joint needs with the empty hand, and the load in the hand that takes all of its
/// strength, kg.
pub fn hold(body: &Body, what: HeldPosture) -> (f64, f64) {
    let name = match what {
        HeldPosture::StraightArm => "r_shoulder_flexion",
        HeldPosture::Curl => "r_elbow_flexion",
    };
    let dof = DOF_NAMES
        .iter()
        .position(|n| *n == name)
        .expect("the joint exists");
    let mut angles = [0.0; DOF_COUNT];
    angles[dof] = std::f64::consts::FRAC_PI_2;
    let mut posture = Posture::default();
    set_anatomical_angles(&mut posture, &angles);
    let state = State::at_rest(posture);
    let need = |kg: f64| {
        let mut links = Links::new(body);
        if kg > 0.0 {
            links.add_load(R_HAND, grip(body, R_HAND), kg);
        }
        let mut terms = Terms::default();
        terms.compute(&links, &state, &[], GRAVITY);
        terms.h[6 + dof]
    };
    let (mut lower, mut upper) = ([0.0; DOF_COUNT], [0.0; DOF_COUNT]);
    Strength::for_body(body).range(
        &anatomical_angles(&posture),
        &[0.0; DOF_COUNT],
        &StrengthScale::default().muscles(1.0),
        &mut lower,
        &mut upper,
    );
    let (empty, per_kg) = (need(0.0), need(1.0) - need(0.0));
    (empty / upper[dof], (upper[dof] - empty) / per_kg)
}
