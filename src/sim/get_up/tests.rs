//! Goal: a body can perform the motion of getting up. Method: bodies of four people follow the motion exactly, from
//! belly, back and sides.

use super::params::solver::FASTEST;
use super::*;
use crate::body::topology::{DOF_COUNT, DOF_NAMES};
use crate::body::{Links, Profile, Sex, State};
use crate::motion::builtin::at_ease;

const DT: f64 = 1.0 / 60.0;

/// Observations during the motion.
#[derive(Debug, Default)]
struct Seen {
    /// Deepest penetration of the floor, m, and fastest joint, rad/s.
    deep: f64,
    fastest: f64,
    /// Height of the centre of mass at the end, and uprightness of the trunk.
    com: f64,
    up: f64,
    over: bool,
}

/// Follows the motion of a straight body that is turned by `turn` rad from lying on its belly.
fn follow(body: &Body, turn: f64, seconds: f64) -> Seen {
    let links = Links::new(body);
    let mut with = GetUpSolver::new(body, &at_ease(body));
    let mut way = GetUpMotion::new(body);
    let mut state = State::default();
    state.posture.root_position.z = 0.12;
    state.posture.root_rotation =
        Quat::exp(Vec3::Y * std::f64::consts::FRAC_PI_2) * Quat::exp(Vec3::Z * turn);
    let mut terms = Terms::default();
    terms.compute(&links, &state, &[], 9.81);
    way.begin(&with, &terms);
    let mut seen = Seen::default();
    for tick in 0..(seconds / DT) as u32 {
        let next = way.advance(body, &mut with, &terms, DT, 1.0).next;
        state = next.state();
        terms.compute(&links, &state, &[], 9.81);
        let angles = anatomical_angles(&state.posture);
        for d in 0..DOF_COUNT {
            let (lower, upper) = (body.lower[d] - 1e-6, body.upper[d] + 1e-6);
            let a = angles[d];
            assert!(a >= lower && a <= upper, "{}: {a} at {tick}", DOF_NAMES[d]);
            seen.fastest = seen.fastest.max(state.velocity[6 + d].abs());
        }
        // It lies down on the floor first.
        if f64::from(tick) * DT > 1.0 {
            for s in SegmentId::all() {
                seen.deep = seen.deep.max(-with.solver.lowest(&terms, s));
            }
        }
    }
    seen.com = terms.com.z;
    seen.up = state.posture.root_rotation.rotate(Vec3::Z).z;
    seen.over = way.is_over();
    seen
}

fn people() -> [Body; 4] {
    let person = |sex, height, mass| {
        Body::humanoid(Profile {
            sex,
            age: 40.0,
            height,
            mass,
        })
        .unwrap()
    };
    [
        Body::adult_man(),
        Body::adult_woman(),
        person(Sex::Female, 1.5, 55.0),
        person(Sex::Male, 2.05, 105.0),
    ]
}

#[test]
fn anybody_who_lies_on_the_belly_comes_to_stand() {
    for body in people() {
        let seen = follow(&body, 0.0, 26.0);
        println!("{seen:?}");
        assert!(seen.over && seen.up > 0.99, "{seen:?}");
        assert!(seen.com > 0.93 * body.standing_root_height(), "{seen:?}");
        assert!(
            seen.deep < 0.03 && seen.fastest < 1.01 * FASTEST,
            "{seen:?}"
        );
    }
}

#[test]
fn the_way_from_back_and_sides_goes_over_the_belly_and_is_the_same_mirrored() {
    let body = Body::adult_man();
    for turn in [1.5, 2.5, 3.1] {
        let [right, left] = [turn, -turn].map(|turn| follow(&body, turn, 36.0));
        println!("{right:?}");
        assert!(right.over && right.up > 0.99, "{right:?}");
        assert!(left.over && (left.com - right.com).abs() < 0.01, "{left:?}");
    }
}
