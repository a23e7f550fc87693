//! A plain adult body for tests of motion preparation: lengths near de Leva's, boxes for feet, rounded limits.

use crate::sim::body::topology::{DOF_COUNT, DOF_NAMES, SEGMENT_COUNT, SEGMENT_NAMES};
use crate::sim::body::{Body, Mesh, Profile, Segment, Sex};
use crate::sim::math::{Sym3, Vec3, vec3::vec3};

/// A man of 1.75 m and 70 kg.
pub fn body() -> Body {
    let side = |name: &str| if name.starts_with("l_") { 1.0 } else { -1.0 };
    let mut offset = [Vec3::zero(); SEGMENT_COUNT];
    let mut segments = Vec::new();
    for (i, name) in SEGMENT_NAMES.iter().enumerate() {
        let y = side(name);
        let (at, mass, com, tip) = match name.trim_start_matches("l_").trim_start_matches("r_") {
            "pelvis" => ([0.0; 3], 7.82, [0.0, 0.0, 0.06], [0.0, 0.0, 0.146]),
            "abdomen" => (
                [0.0, 0.0, 0.146],
                11.43,
                [0.0, 0.0, 0.12],
                [0.0, 0.0, 0.217],
            ),
            "chest" => (
                [0.0, 0.0, 0.217],
                11.17,
                [0.0, 0.0, 0.12],
                [0.0, 0.0, 0.172],
            ),
            "head" => (
                [-0.01, 0.0, 0.172],
                4.86,
                [0.01, 0.0, 0.13],
                [0.01, 0.0, 0.27],
            ),
            "upper_arm" => (
                [0.0, 0.186 * y, 0.127],
                1.9,
                [0.0, 0.0, -0.163],
                [0.0, 0.0, -0.283],
            ),
            "forearm" => (
                [0.0, 0.0, -0.283],
                1.13,
                [0.0, 0.0, -0.124],
                [0.0, 0.0, -0.27],
            ),
            "hand" => (
                [0.0, 0.0, -0.27],
                0.43,
                [0.0, 0.0, -0.068],
                [0.0, 0.0, -0.18],
            ),
            "thigh" => (
                [0.0, 0.088 * y, 0.0],
                9.91,
                [0.0, 0.0, -0.174],
                [0.0, 0.0, -0.424],
            ),
            "shank" => (
                [0.0, 0.0, -0.424],
                3.03,
                [0.0, 0.0, -0.197],
                [0.0, 0.0, -0.442],
            ),
            "foot" => (
                [0.0, 0.0, -0.442],
                0.83,
                [0.04, 0.0, -0.043],
                [0.13, 0.0, -0.059],
            ),
            _ => (
                [0.13, 0.0, -0.059],
                0.13,
                [0.03, 0.0, 0.0],
                [0.073, 0.0, -0.02],
            ),
        };
        offset[i] = Vec3::from_array(at);
        let contact_points = match name.trim_start_matches("l_").trim_start_matches("r_") {
            "foot" => vec![
                vec3(-0.055, 0.03, -0.079),
                vec3(-0.055, -0.03, -0.079),
                vec3(0.13, 0.045, -0.079),
                vec3(0.13, -0.045, -0.079),
            ],
            "toes" => vec![vec3(0.073, 0.03, -0.02), vec3(0.073, -0.03, -0.02)],
            _ => Vec::new(),
        };
        let r2 = 0.004;
        segments.push(Segment {
            mass,
            com: Vec3::from_array(com),
            inertia: Sym3::diagonal(mass * r2, mass * r2, mass * r2),
            mesh: Mesh::default(),
            contact_points,
            tip: Vec3::from_array(tip),
        });
    }
    let (mut lower, mut upper) = ([0.0; DOF_COUNT], [0.0; DOF_COUNT]);
    for (d, name) in DOF_NAMES.iter().enumerate() {
        let (a, b): (f64, f64) = match name.trim_start_matches("l_").trim_start_matches("r_") {
            "waist_flexion" => (-20.0, 60.0),
            "thorax_flexion" => (-20.0, 40.0),
            "neck_flexion" => (-55.0, 55.0),
            "waist_lateral" | "thorax_lateral" => (-30.0, 30.0),
            "neck_lateral" => (-40.0, 40.0),
            "neck_rotation" => (-75.0, 75.0),
            "shoulder_flexion" => (-60.0, 175.0),
            "shoulder_abduction" => (-30.0, 150.0),
            "shoulder_rotation" => (-80.0, 80.0),
            "elbow_flexion" | "knee_flexion" => (0.0, 145.0),
            "elbow_pronation" => (-85.0, 85.0),
            "wrist_flexion" => (-65.0, 75.0),
            "hip_flexion" => (-20.0, 125.0),
            "hip_abduction" => (-30.0, 45.0),
            "hip_rotation" => (-45.0, 45.0),
            "ankle_flexion" => (-50.0, 35.0),
            "toe_extension" => (-30.0, 60.0),
            _ => (-35.0, 35.0),
        };
        (lower[d], upper[d]) = (a.to_radians(), b.to_radians());
    }
    let mass = segments.iter().map(|s| s.mass).sum();
    let body = Body {
        profile: Profile {
            sex: Sex::Male,
            age: 30.0,
            height: 1.75,
            mass,
        },
        segments,
        joint_offset: offset,
        lower,
        upper,
        armature: [0.0; DOF_COUNT],
    };
    body.validate().expect("the test body is physical");
    body
}
