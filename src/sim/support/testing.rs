//! A plain mannequin and random states for tests of support and control: no tables, no files.

use crate::body::angles::{clamp_to_limits, set_anatomical_angles};
use crate::body::model::{Body, Mesh, Profile, Segment, Sex};
use crate::body::topology::{DOF_COUNT, DOF_LEN, DOF_START, NV, SEGMENT_COUNT, SEGMENT_NAMES};
use crate::body::{Links, Posture, State};
use crate::dynamics::Terms;
use crate::math::{Sym3, Vec3, vec3::vec3};

pub(crate) const GRAVITY: f64 = 9.81;

/// Small multiplicative generator: tests need repeatable numbers, not good ones.
pub(crate) struct Rng(u64);

impl Rng {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(2_862_933_555_777_941_757) + 3_037_000_493)
    }
    /// Uniform in −1…1.
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / 2f64.powi(52) - 1.0
    }
    pub(crate) fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * 0.5 * (self.unit() + 1.0)
    }
}

/// A figure of boxes: 70 kg, 1.7 m.
pub(crate) fn mannequin() -> Body {
    // Mass (kg), centre of mass z, half extents of the box (m), joint offset in the parent.
    let one = |name: &str| -> (f64, Vec3, Vec3, Vec3) {
        let side = if name.starts_with("l_") { 1.0 } else { -1.0 };
        match name.trim_start_matches("l_").trim_start_matches("r_") {
            "pelvis" => (
                8.0,
                vec3(0.0, 0.0, 0.05),
                vec3(0.10, 0.16, 0.09),
                Vec3::zero(),
            ),
            "abdomen" => (
                10.0,
                vec3(0.0, 0.0, 0.08),
                vec3(0.10, 0.15, 0.09),
                vec3(0.0, 0.0, 0.12),
            ),
            "chest" => (
                15.0,
                vec3(0.0, 0.0, 0.15),
                vec3(0.11, 0.17, 0.15),
                vec3(0.0, 0.0, 0.17),
            ),
            "head" => (
                5.0,
                vec3(0.01, 0.0, 0.13),
                vec3(0.09, 0.08, 0.13),
                vec3(0.0, 0.0, 0.28),
            ),
            "upper_arm" => (
                2.0,
                vec3(0.0, 0.0, -0.13),
                vec3(0.04, 0.04, 0.14),
                vec3(0.0, 0.19 * side, 0.24),
            ),
            "forearm" => (
                1.2,
                vec3(0.0, 0.0, -0.11),
                vec3(0.03, 0.03, 0.12),
                vec3(0.0, 0.0, -0.29),
            ),
            "hand" => (
                0.4,
                vec3(0.0, 0.0, -0.07),
                vec3(0.015, 0.04, 0.08),
                vec3(0.0, 0.0, -0.25),
            ),
            "thigh" => (
                7.5,
                vec3(0.0, 0.0, -0.18),
                vec3(0.07, 0.07, 0.20),
                vec3(0.0, 0.09 * side, 0.0),
            ),
            "shank" => (
                3.2,
                vec3(0.0, 0.0, -0.17),
                vec3(0.05, 0.05, 0.19),
                vec3(0.0, 0.0, -0.41),
            ),
            "foot" => (
                0.85,
                vec3(0.04, 0.0, -0.05),
                vec3(0.10, 0.04, 0.03),
                vec3(0.0, 0.0, -0.40),
            ),
            _ => (
                0.15,
                vec3(0.03, 0.0, 0.0),
                vec3(0.035, 0.04, 0.01),
                vec3(0.13, 0.0, -0.065),
            ),
        }
    };
    let segments: Vec<_> = SEGMENT_NAMES
        .iter()
        .map(|name| {
            let (mass, com, half, _) = one(name);
            let (x, y, z) = (half.x * half.x, half.y * half.y, half.z * half.z);
            let contact_points = if name.ends_with("foot") {
                [(-0.06, -0.04), (0.13, -0.04), (0.13, 0.04), (-0.06, 0.04)]
                    .map(|(x, y)| vec3(x, y, -0.08))
                    .to_vec()
            } else if name.ends_with("toes") {
                [(0.06, -0.04), (0.06, 0.04)]
                    .map(|(x, y)| vec3(x, y, -0.015))
                    .to_vec()
            } else {
                let s = [-1.0, 1.0];
                s.iter()
                    .flat_map(|i| s.iter().map(move |j| (*i, *j)))
                    .flat_map(|(i, j)| s.map(|k| com + vec3(i * half.x, j * half.y, k * half.z)))
                    .collect()
            };
            Segment {
                mass,
                com,
                inertia: Sym3::diagonal(y + z, x + z, x + y) * (mass / 3.0),
                mesh: Mesh::default(),
                contact_points,
                tip: com * 2.0,
            }
        })
        .collect();
    let joint_offset = std::array::from_fn(|s| one(SEGMENT_NAMES[s]).3);
    let (mut lower, mut upper) = ([-0.9; DOF_COUNT], [0.9; DOF_COUNT]);
    for s in 1..SEGMENT_COUNT {
        let range = match SEGMENT_NAMES[s]
            .trim_start_matches("l_")
            .trim_start_matches("r_")
        {
            "shank" => Some((-0.05, 2.4)),
            "forearm" => Some((-0.05, 2.5)),
            "upper_arm" | "thigh" => Some((-1.0, 2.0)),
            _ => None,
        };
        if let Some((a, b)) = range {
            (lower[DOF_START[s]], upper[DOF_START[s]]) = (a, b);
        }
        debug_assert!(DOF_LEN[s] > 0);
    }
    let mass = segments.iter().map(|s| s.mass).sum();
    let body = Body {
        profile: Profile {
            sex: Sex::Male,
            age: 30.0,
            height: 1.7,
            mass,
        },
        segments,
        joint_offset,
        lower,
        upper,
        armature: [0.02; DOF_COUNT],
    };
    body.validate().unwrap();
    body
}

/// Joint torques of a person of this size, N·m (constant; strength curves are tested elsewhere).
pub(crate) fn strength(scale: f64) -> ([f64; DOF_COUNT], [f64; DOF_COUNT]) {
    let mut upper = [60.0; DOF_COUNT];
    for s in 1..SEGMENT_COUNT {
        let t = match SEGMENT_NAMES[s]
            .trim_start_matches("l_")
            .trim_start_matches("r_")
        {
            "abdomen" | "chest" => 200.0,
            "thigh" | "shank" => 180.0,
            "foot" => 120.0,
            "hand" | "toes" => 12.0,
            _ => 60.0,
        };
        upper[DOF_START[s]..DOF_START[s] + DOF_LEN[s]].fill(t);
    }
    (upper.map(|u| -0.8 * u * scale), upper.map(|u| u * scale))
}

/// Standing with slightly bent knees and elbows, soles on the floor, centre of mass over the feet.
pub(crate) fn standing(body: &Body) -> State {
    let mut a = [0.0; DOF_COUNT];
    for (thigh, shank, foot) in [(23, 26, 27), (31, 34, 35)] {
        (a[thigh], a[shank], a[foot]) = (0.10, 0.20, 0.10);
    }
    for forearm in [12, 19] {
        a[forearm] = 0.3;
    }
    let mut posture = Posture::default();
    set_anatomical_angles(&mut posture, &a);
    State {
        posture: on_floor(body, posture),
        velocity: [0.0; NV],
    }
}

/// Lifts or lowers the pelvis so that the lowest contact point is at height 0.
pub(crate) fn on_floor(body: &Body, mut posture: Posture) -> Posture {
    let state = State {
        posture,
        velocity: [0.0; NV],
    };
    let terms = terms(body, &state);
    let mut low = f64::INFINITY;
    for (s, g) in body.segments.iter().enumerate() {
        for p in &g.contact_points {
            low = low.min(terms.point_world(s, *p).z);
        }
    }
    posture.root_position.z -= low;
    posture
}

/// Random joint angles within limits and random rates; the feet may be anywhere.
pub(crate) fn random_state(body: &Body, rng: &mut Rng, spread: f64, rate: f64) -> State {
    let mut state = standing(body);
    let step: [f64; NV] = std::array::from_fn(|_| spread * rng.unit());
    state.posture.integrate(&step, 1.0);
    clamp_to_limits(body, &mut state.posture, 0.0);
    state.velocity = std::array::from_fn(|_| rate * rng.unit());
    state
}

/// A random posture near standing whose feet stay flat on the floor: only joints above the hips differ, and the pelvis
/// stays still.
pub(crate) fn random_stance(body: &Body, rng: &mut Rng, spread: f64, rate: f64) -> State {
    let mut state = standing(body);
    let mut step = [0.0; NV];
    for d in 0..23 {
        step[6 + d] = spread * rng.unit();
        state.velocity[6 + d] = rate * rng.unit();
    }
    state.posture.integrate(&step, 1.0);
    clamp_to_limits(body, &mut state.posture, 0.0);
    state
}

pub(crate) fn terms(body: &Body, state: &State) -> Terms {
    let mut t = Terms::default();
    t.compute(&Links::new(body), state, &[], GRAVITY);
    t
}
