//! Motions that need no recording: written for any body, balanced and within its limits.
//!
//! Each motion is a smooth plan (joint angles of the upper body, orientation and height of the pelvis, poses of the
//! feet, path of the centre of mass over the floor). `shape` turns it into postures: legs by inverse kinematics, and
//! the pelvis shifted until the centre of mass is where the plan wants it. Lengths scale with the body's legs. The
//! figure starts at the origin, facing +x, on the floor z = 0.

mod gait;
mod shape;
mod standing;

use super::clip::Clip;
use crate::body::{Body, Posture};

/// Names that [`builtin`] knows.
pub const BUILTIN_NAMES: [&str; 7] = ["idle", "lift", "crate", "squat", "wave", "step", "walk"];

/// Samples per second of every built-in motion.
pub const RATE: f64 = 120.0;

pub use shape::REFERENCE_LEG;
pub use standing::LiftEnd;

/// Time at which the hand of `lift` is at rest on the object and starts to raise it, s.
pub const LIFT_GRASP: f64 = standing::LIFT_GRASP;

/// The built-in motion `name` for `body`; `None` if there is no such name.
///
/// * `idle` (8 s, loops): breathing and a slight shift of weight.
/// * `lift` (4 s): semi-squat, right hand to an object half a metre up, grasp ([`LIFT_GRASP`]), raise it in front to
///   shoulder height.
/// * `crate` (7.6 s, loops): both hands hold a crate at the waist, set it low, raise it to the chest, and take it back.
/// * `squat` (5 s): down with the arms forward, and up.
/// * `wave` (5 s): the right arm waves beside the head.
/// * `step` (8.4 s, loops): steps on the spot.
/// * `walk` (6.6 s): from standing, six steps forward, to standing.
///
/// Some thousand postures are solved: tens to a few hundred milliseconds; allocates.
pub fn builtin(body: &Body, name: &str) -> Option<Clip> {
    let (postures, planted): (Vec<Posture>, Vec<[bool; 2]>) = match name {
        "idle" => standing::idle(body),
        "lift" => standing::lift(body, LiftEnd::default()),
        "crate" => standing::lift_crate(body),
        "squat" => standing::squat(body),
        "wave" => standing::wave(body),
        "step" => gait::step(body),
        "walk" => gait::walk(body),
        _ => return None,
    };
    Some(clip(name, postures, planted))
}

/// The built-in lift with another end.
pub fn lift_to(body: &Body, end: LiftEnd) -> Clip {
    let (postures, planted) = standing::lift(body, end);
    clip("lift", postures, planted)
}

fn clip(name: &str, postures: Vec<Posture>, planted: Vec<[bool; 2]>) -> Clip {
    Clip::from_postures(name, RATE, postures, planted)
        .expect("plans are finite, of bounded length, and their rotations are unit quaternions")
}

/// Standing at ease at the origin, feet side by side under the hips.
pub fn at_ease(body: &Body) -> Posture {
    shape::posture(body, &standing::stand(body, standing::HALF_STANCE))
}

#[cfg(test)]
mod tests;
