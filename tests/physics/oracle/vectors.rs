//! States of random and human bodies, with and without loads, with the numbers on which Pinocchio and MuJoCo agree
//! (`data/dynamics_vectors.json`, made by `make_vectors.py`, which states the versions). No Python is needed to check
//! them.

use super::{inverse, relative, terms};
use serde_json::Value;
use sinew_physics::body::topology::{JOINT, Joint};
use sinew_physics::body::{DOF_COUNT, Links, NV, Posture, SEGMENT_COUNT, SegmentId, State};
use sinew_physics::dynamics::momentum;
use sinew_physics::math::{Quat, Sym3, Vec3};

/// Two correct answers differ only by rounding; inputs read from text may be off by one unit in the last place.
const ROUNDING: f64 = 1e-12;

/// All numbers of a value, nested lists included, in order.
fn numbers(v: &Value) -> Vec<f64> {
    match v {
        Value::Array(a) => a.iter().flat_map(numbers).collect(),
        x => vec![x.as_f64().unwrap()],
    }
}

fn vec3(v: &Value) -> Vec3 {
    Vec3::from_array(numbers(v).try_into().unwrap())
}

fn links(model: &Value) -> Links {
    let mut l = Links {
        offset: [Vec3::zero(); SEGMENT_COUNT],
        mass: [0.0; SEGMENT_COUNT],
        moment: [Vec3::zero(); SEGMENT_COUNT],
        inertia: [Sym3::zero(); SEGMENT_COUNT],
        armature: numbers(&model["armature"]).try_into().unwrap(),
    };
    let segments = model["segments"].as_array().unwrap();
    assert_eq!(segments.len(), SEGMENT_COUNT);
    for (s, x) in segments.iter().enumerate() {
        let (mass, com) = (x["mass"].as_f64().unwrap(), vec3(&x["com"]));
        let [xx, yy, zz, xy, xz, yz]: [f64; 6] = numbers(&x["inertia"]).try_into().unwrap();
        let own = Sym3 {
            xx,
            yy,
            zz,
            xy,
            xz,
            yz,
        };
        l.offset[s] = vec3(&x["offset"]);
        l.mass[s] = mass;
        l.moment[s] = com * mass;
        l.inertia[s] = own + Sym3::point_mass(mass, com);
    }
    for load in model["loads"].as_array().unwrap() {
        let s = load[0].as_u64().unwrap() as usize;
        l.add_load(
            SegmentId::new(s).unwrap(),
            vec3(&load[1]),
            load[2].as_f64().unwrap(),
        );
    }
    l
}

fn state(case: &Value) -> State {
    let p = numbers(&case["positions"]);
    let quat = |at: usize| Quat::from_xyzw([p[at], p[at + 1], p[at + 2], p[at + 3]]);
    let mut posture = Posture {
        root_position: Vec3::from_array([p[0], p[1], p[2]]),
        root_rotation: quat(3),
        ..Posture::default()
    };
    let mut at = 7;
    for joint in JOINT {
        match joint {
            Joint::Free => {}
            Joint::Ball(b) => {
                posture.ball[b] = quat(at);
                at += 4;
            }
            Joint::Hinge2(h) => {
                posture.hinge[h..h + 2].copy_from_slice(&p[at..at + 2]);
                at += 2;
            }
            Joint::Hinge1(h) => {
                posture.hinge[h] = p[at];
                at += 1;
            }
        }
    }
    assert_eq!(at, p.len());
    State {
        posture,
        velocity: numbers(&case["velocity"]).try_into().unwrap(),
    }
}

#[test]
fn recorded_vectors_of_other_engines_are_reproduced() {
    let data: Value =
        serde_json::from_str(include_str!("../../oracle/data/dynamics_vectors.json")).unwrap();
    let gravity = data["gravity"].as_f64().unwrap();
    let models = data["models"].as_array().unwrap();
    assert!(models.len() >= 10);
    for model in models {
        let l = links(model);
        assert!(relative(&[l.total_mass()], &numbers(&model["mass"])) < ROUNDING);
        assert_eq!(l.armature.len(), DOF_COUNT);
        for case in model["cases"].as_array().unwrap() {
            let s = state(case);
            let t = terms(&l, &s);
            let check = |what: &str, ours: &[f64], recorded: &Value| {
                let off = relative(ours, &numbers(recorded));
                assert!(off < ROUNDING, "{} {what}: {off:e}", model["name"]);
            };
            let a: [f64; NV] = numbers(&case["acceleration"]).try_into().unwrap();
            let tau = inverse(&l, &s, &a, gravity);
            check("torque", &tau, &case["torque"]);
            check("bias", &t.h, &case["bias"]);
            let lower: Vec<f64> = (0..NV).flat_map(|i| t.m[i][..=i].to_vec()).collect();
            check("inertia", &lower, &case["inertia_lower"]);
            check("com", &t.com.to_array(), &case["com"]);
            check(
                "com velocity",
                &t.com_velocity.to_array(),
                &case["com_velocity"],
            );
            check("com bias", &t.com_bias.to_array(), &case["com_bias"]);
            let jc: Vec<f64> = t.jc.iter().flat_map(|row| row[..NV].to_vec()).collect();
            check("com Jacobian", &jc, &case["com_jacobian"]);
            let p = momentum(&l, &t.kin);
            check("momentum", &p.linear.to_array(), &case["linear_momentum"]);
            check(
                "angular momentum",
                &p.angular.to_array(),
                &case["angular_momentum"],
            );
            let (force, moment) = t.ground_wrench(&a);
            let zmp = [-moment.y / force.z, moment.x / force.z];
            check("zero-moment point", &zmp, &case["zero_moment_point"]);
            for probe in case["probes"].as_array().unwrap() {
                let k = probe["segment"].as_u64().unwrap() as usize;
                check(
                    "position",
                    &t.segment_position(k).to_array(),
                    &probe["position"],
                );
                let r = t.segment_rotation(k).transpose(); // rows of the rotation, as recorded
                let rows = [r.x, r.y, r.z].map(Vec3::to_array).concat();
                check("rotation", &rows, &probe["rotation"]);
                let mut j = [[0.0; 48]; 6];
                t.segment_jacobian(k, &mut j);
                let ja: Vec<f64> = j
                    .iter()
                    .map(|row| (0..NV).map(|i| row[i] * a[i]).sum())
                    .collect();
                check("Jacobian", &ja, &probe["jacobian_times_acceleration"]);
                let (alpha, acc) = t.segment_bias(k);
                let bias = [alpha.to_array(), acc.to_array()].concat();
                check("segment bias", &bias, &probe["bias"]);
            }
        }
    }
}
