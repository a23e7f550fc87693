//! Random bodies, states and loads, seeded; shared by the tests and by `tools/dump_dynamics.rs`.
//!
//! The bodies share only the tree with humans: they have skew inertias, centres of mass off every axis, and joints
//! anywhere. A result that holds for them holds for any body.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use sinew_physics::body::topology::{DOF_LEN, DOF_START, JOINT, Joint};
use sinew_physics::body::{
    Body, DOF_COUNT, Links, NV, Profile, SEGMENT_COUNT, Segment, SegmentId, Sex, State,
};
use sinew_physics::math::{Mat3, Quat, Sym3, Vec3};

/// A point mass welded to a segment: segment, point in its frame (m), mass (kg).
pub type Load = (SegmentId, Vec3, f64);

/// A seeded generator.
pub fn generator(seed: u64) -> Pcg64Mcg {
    Pcg64Mcg::seed_from_u64(seed)
}

/// A vector with components within ±`size`.
pub fn vector(rng: &mut Pcg64Mcg, size: f64) -> Vec3 {
    Vec3 {
        x: rng.random_range(-size..size),
        y: rng.random_range(-size..size),
        z: rng.random_range(-size..size),
    }
}

/// A rotation by up to `angle` rad about each axis.
pub fn rotation(rng: &mut Pcg64Mcg, angle: f64) -> Quat {
    Quat::exp(vector(rng, angle)).normalized()
}

/// Components within ±`size`.
pub fn components(rng: &mut Pcg64Mcg, size: f64) -> [f64; NV] {
    std::array::from_fn(|_| rng.random_range(-size..size))
}

/// The inertia of three pairs of point masses on skew axes: positive, and with the triangle inequality of a real body.
fn inertia(rng: &mut Pcg64Mcg, mass: f64) -> Sym3 {
    let r: [f64; 3] = std::array::from_fn(|_| rng.random_range(0.0025..0.02) * mass);
    let turn: Mat3 = rotation(rng, 3.0).to_mat3();
    Sym3::diagonal(r[1] + r[2], r[0] + r[2], r[0] + r[1]).rotated(turn)
}

/// A valid body with random offsets, masses and inertias. `armature` is the largest reflected inertia (kg·m²); the DOFs
/// of one joint share theirs, as MuJoCo's joints do.
pub fn random_body(rng: &mut Pcg64Mcg, armature: f64) -> Body {
    let segments: Vec<Segment> = (0..SEGMENT_COUNT)
        .map(|_| {
            let mass = rng.random_range(0.3..12.0);
            Segment {
                mass,
                com: vector(rng, 0.15),
                inertia: inertia(rng, mass),
                mesh: Default::default(),
                contact_points: vec![vector(rng, 0.2)],
                tip: vector(rng, 0.2),
            }
        })
        .collect();
    let mut reflected = [0.0; DOF_COUNT];
    for s in 1..SEGMENT_COUNT {
        let a = armature * rng.random_range(0.0..1.0);
        reflected[DOF_START[s]..DOF_START[s] + DOF_LEN[s]].fill(a);
    }
    let body = Body {
        profile: Profile {
            sex: Sex::Female,
            age: 40.0,
            height: 1.7,
            mass: segments.iter().map(|s| s.mass).sum(),
        },
        segments,
        joint_offset: std::array::from_fn(|_| vector(rng, 0.3)),
        lower: [-2.0; DOF_COUNT],
        upper: [2.0; DOF_COUNT],
        armature: reflected,
    };
    body.validate().expect("a random body is physical");
    body
}

/// Any posture anywhere, moving fast: joints turned by up to `angle` rad about each axis.
pub fn random_state(rng: &mut Pcg64Mcg, angle: f64) -> State {
    let mut state = State::default();
    state.posture.root_position = vector(rng, 2.0);
    state.posture.root_rotation = rotation(rng, 3.0);
    for s in 1..SEGMENT_COUNT {
        match JOINT[s] {
            Joint::Free => {}
            Joint::Ball(b) => state.posture.ball[b] = rotation(rng, angle),
            Joint::Hinge2(h) => {
                state.posture.hinge[h] = rng.random_range(-angle..angle);
                state.posture.hinge[h + 1] = rng.random_range(-angle..angle);
            }
            Joint::Hinge1(h) => state.posture.hinge[h] = rng.random_range(-angle..angle),
        }
    }
    state.velocity = components(rng, 5.0);
    state
}

/// Up to three loads of up to 20 kg.
pub fn random_loads(rng: &mut Pcg64Mcg) -> Vec<Load> {
    (0..rng.random_range(1..4))
        .map(|_| {
            let s = SegmentId::new(rng.random_range(0..SEGMENT_COUNT)).expect("a segment index");
            (s, vector(rng, 0.3), rng.random_range(0.1..20.0))
        })
        .collect()
}

/// Links of `body` with `loads` welded on.
pub fn loaded(body: &Body, loads: &[Load]) -> Links {
    let mut links = Links::new(body);
    for (segment, point, mass) in loads {
        links.add_load(*segment, *point, *mass);
    }
    links
}
