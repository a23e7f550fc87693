//! Goal: runs are distinguished from other fast motions. Method: points of figures that move by formula, 120 Hz.

use super::*;
use crate::math::vec3::vec3;
use std::f64::consts::PI;

const RATE: f64 = 120.0;
const STEP: f64 = 0.35;

struct Points {
    middle: Vec<Vec3>,
    feet: [Vec<Vec3>; 2],
    trunk: [Vec<Vec3>; 2],
}

/// Two seconds. `at(t)`: the middle of the body, the lead of the left foot over the right one and the direction of the
/// trunk.
fn points(at: impl Fn(f64) -> (Vec3, f64, Vec3)) -> Points {
    let samples: Vec<_> = (0..240).map(|i| at(f64::from(i) / RATE)).collect();
    let of = |f: &dyn Fn(&(Vec3, f64, Vec3)) -> Vec3| samples.iter().map(f).collect::<Vec<_>>();
    let foot =
        |side: f64| of(&|(m, lead, _)| vec3(m.x + 0.5 * side * lead, m.y + 0.1 * side, 0.08));
    Points {
        middle: of(&|s| s.0),
        feet: [foot(1.0), foot(-1.0)],
        trunk: [of(&|s| s.0), of(&|s| s.0 + s.2 * 0.5)],
    }
}

fn gaits(p: &Points) -> Vec<Gait> {
    let figure = RecordedPoints {
        middle: &p.middle,
        feet: [&p.feet[0], &p.feet[1]],
        trunk: [&p.trunk[0], &p.trunk[1]],
    };
    fast_stretches(&figure, RATE)
        .into_iter()
        .map(|s| s.gait)
        .collect()
}

/// With `bounce` > 0 the body falls while the feet are farthest apart; with `bounce` < 0 it is highest in the middle of
/// a stance.
fn gait(speed: f64, bounce: f64, lead: f64) -> Points {
    points(|t| {
        let phase = PI * t / STEP;
        let z = 1.0 + bounce * (2.0 * phase).cos();
        (vec3(speed * t, 0.0, z), lead * phase.cos(), Vec3::Z)
    })
}

#[test]
fn steps_in_turns_with_flights_are_a_run() {
    assert_eq!(gaits(&gait(3.0, 0.03, 0.9)), [Gait::Run]);
}

#[test]
fn a_walk_is_not_fast_and_a_fast_walk_does_not_fly() {
    assert_eq!(gaits(&gait(1.4, -0.02, 0.7)), []);
    assert_eq!(gaits(&gait(2.6, -0.03, 0.9)), [Gait::NoFlights]);
}

#[test]
fn a_jump_forward_has_no_steps() {
    // Both feet side by side; half a second of free fall.
    let jump = points(|t| {
        let u = (t - 0.7).clamp(0.0, 0.5);
        let z = 1.0 + 4.9 * u * (0.5 - u);
        (vec3(3.0 * u, 0.0, z), 0.0, Vec3::Z)
    });
    assert_eq!(gaits(&jump), [Gait::FewSteps]);
}

#[test]
fn a_body_that_turns_over_does_not_run() {
    let dive = points(|t| {
        let phase = PI * t / STEP;
        let bow = PI * (t - 0.9).clamp(0.0, 1.0);
        let up = vec3(bow.sin(), 0.0, bow.cos());
        let z = 1.0 + 0.03 * (2.0 * phase).cos();
        (vec3(3.0 * t, 0.0, z), 0.9 * phase.cos(), up)
    });
    assert_eq!(gaits(&dive), [Gait::NotUpright]);
}

#[test]
fn a_lunge_to_and_fro_goes_nowhere() {
    let lunge = points(|t| {
        let phase = PI * t / STEP;
        let x = 0.4 * (2.0 * PI * t).sin();
        (
            vec3(x, 0.0, 1.0 + 0.03 * (2.0 * phase).cos()),
            0.9 * phase.cos(),
            Vec3::Z,
        )
    });
    assert!(
        !gaits(&lunge).is_empty() && !gaits(&lunge).contains(&Gait::Run),
        "{:?}",
        gaits(&lunge)
    );
}
