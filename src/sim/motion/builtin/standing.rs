//! Motions with both feet planted flat.

use super::RATE;
use super::shape::{COM_AHEAD, Measures, Plan, posture, reach_right, set};
use crate::body::topology::{DOF_COUNT, DOF_NAMES};
use crate::body::{Body, Posture};
use crate::math::Vec3;
use crate::math::curve::ramp;
use std::f64::consts::TAU;

/// See [`super::LIFT_GRASP`].
pub const LIFT_GRASP: f64 = 1.7;
/// Half the distance between the ankles, reference body, m.
pub const HALF_STANCE: f64 = 0.11;
/// Arms hanging at ease, degrees.
const HANGING: [(&str, f64); 8] = [
    ("l_shoulder_flexion", 2.0),
    ("l_shoulder_abduction", 9.0),
    ("l_elbow_flexion", 15.0),
    ("l_elbow_pronation", 15.0),
    ("r_shoulder_flexion", 2.0),
    ("r_shoulder_abduction", 9.0),
    ("r_elbow_flexion", 15.0),
    ("r_elbow_pronation", 15.0),
];

/// Upper body at ease.
pub fn at_ease() -> [f64; DOF_COUNT] {
    let mut angles = [0.0; DOF_COUNT];
    set(&mut angles, &HANGING);
    angles
}

/// Standing at ease, knees a little bent.
pub fn stand(body: &Body, half_stance: f64) -> Plan {
    let m = Measures::of(body);
    let y = half_stance * m.scale;
    Plan {
        angles: at_ease(),
        pelvis: Vec3::zero(),
        height: 0.99,
        com: [COM_AHEAD * m.scale, 0.0],
        feet: [m.flat(0.0, y), m.flat(0.0, -y)],
    }
}

fn planted(
    body: &Body,
    seconds: f64,
    plan: impl Fn(f64) -> Plan,
) -> (Vec<Posture>, Vec<[bool; 2]>) {
    let count = (seconds * RATE).round() as usize + 1;
    let postures: Vec<Posture> = (0..count)
        .map(|i| posture(body, &plan(i as f64 / RATE)))
        .collect();
    (postures, vec![[true; 2]; count])
}

pub fn idle(body: &Body) -> (Vec<Posture>, Vec<[bool; 2]>) {
    const PERIOD: f64 = 8.0;
    let stand = stand(body, HALF_STANCE);
    let scale = Measures::of(body).scale;
    planted(body, PERIOD, |t| {
        let phase = TAU * t / PERIOD;
        let breath = 0.5 - 0.5 * (2.0 * phase).cos(); // two breaths
        let sway = phase.sin() * (1.0 - phase.cos()) / 1.299; // −1…1, starts and ends without speed
        let mut plan = stand;
        plan.com[0] += 0.004 * scale * (0.5 - 0.5 * phase.cos());
        plan.com[1] += 0.018 * scale * sway;
        plan.pelvis.x = 0.02 * sway;
        let a = |d: f64| d.to_degrees();
        set(
            &mut plan.angles,
            &[
                ("waist_lateral", a(-0.025 * sway)),
                ("thorax_flexion", -1.2 * breath),
                ("neck_flexion", 1.0 * breath),
                ("neck_rotation", 3.0 * sway),
                ("l_shoulder_abduction", 9.0 + 1.2 * breath),
                ("r_shoulder_abduction", 9.0 + 1.2 * breath),
            ],
        );
        plan
    })
}

/// How the built-in lift ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiftEnd {
    /// Share of the semi-squat that legs and trunk keep, 0…1.
    pub squat: f64,
    /// How far in front of the ankles the hand is, reference body, m.
    pub reach: f64,
}

impl Default for LiftEnd {
    /// Upright, the arm nearly straight.
    fn default() -> Self {
        Self {
            squat: 0.0,
            reach: 0.58,
        }
    }
}

pub fn lift(body: &Body, end: LiftEnd) -> (Vec<Posture>, Vec<[bool; 2]>) {
    const REACHED: f64 = LIFT_GRASP - 0.3;
    const RAISED: f64 = LIFT_GRASP + 0.8;
    let scale = Measures::of(body).scale;
    let stand = stand(body, 0.12);
    let elbow_axis = -Vec3::Y;

    let mut low = stand;
    low.height = 0.75;
    low.pelvis.y = 29f64.to_radians();
    set(
        &mut low.angles,
        &[
            ("waist_flexion", 24.0),
            ("thorax_flexion", 13.0),
            ("neck_flexion", -20.0),
            ("l_shoulder_flexion", 25.0),
            ("l_elbow_flexion", 25.0),
        ],
    );
    reach_right(
        body,
        &mut low,
        Vec3::from_array([0.46, -0.16, 0.50]) * scale,
        elbow_axis,
    );

    let mut high = if end.squat > 0.0 {
        stand.mix(&low, end.squat)
    } else {
        stand
    };
    let height = 1.28 - end.squat * (stand.height - low.height);
    reach_right(
        body,
        &mut high,
        Vec3::from_array([end.reach, -0.20, height]) * scale,
        elbow_axis,
    );

    planted(body, RAISED + 1.5, |t| {
        if t < LIFT_GRASP {
            stand.mix(&low, ramp(t, 0.2, REACHED))
        } else {
            low.mix(&high, ramp(t, LIFT_GRASP, RAISED))
        }
    })
}

/// Both hands at `target` and its mirror image.
fn reach_both(body: &Body, plan: &mut Plan, target: Vec3) {
    // The left arm moves the centre of mass, and with it the pelvis and the right hand: the two settle within a few
    // rounds.
    for _ in 0..4 {
        reach_right(body, plan, target, -Vec3::Y);
        for (d, name) in DOF_NAMES.iter().enumerate() {
            let arm = name.strip_prefix("r_").filter(|n| {
                n.starts_with("shoulder") || n.starts_with("elbow") || n.starts_with("wrist")
            });
            if let Some(arm) = arm {
                plan.angles[super::shape::dof(&format!("l_{arm}"))] = plan.angles[d];
            }
        }
    }
}

pub fn lift_crate(body: &Body) -> (Vec<Posture>, Vec<[bool; 2]>) {
    let scale = Measures::of(body).scale;
    let at = |x: f64, z: f64| Vec3::from_array([x, -0.19, z]) * scale;
    let stand = stand(body, 0.14);

    let mut waist = stand;
    reach_both(body, &mut waist, at(0.34, 0.98));

    let mut low = stand;
    low.height = 0.72;
    low.pelvis.y = 32f64.to_radians();
    set(
        &mut low.angles,
        &[
            ("waist_flexion", 24.0),
            ("thorax_flexion", 13.0),
            ("neck_flexion", -20.0),
        ],
    );
    reach_both(body, &mut low, at(0.42, 0.48));

    let mut high = stand;
    reach_both(body, &mut high, at(0.48, 1.24));

    planted(body, 7.6, |t| {
        if t < 2.5 {
            waist.mix(&low, ramp(t, 0.5, 2.1))
        } else if t < 5.3 {
            low.mix(&high, ramp(t, 2.5, 4.3))
        } else {
            high.mix(&waist, ramp(t, 5.3, 6.9))
        }
    })
}

pub fn squat(body: &Body) -> (Vec<Posture>, Vec<[bool; 2]>) {
    let stand = stand(body, 0.13);
    let mut low = stand;
    low.height = 0.60;
    low.pelvis.y = 32f64.to_radians();
    set(
        &mut low.angles,
        &[
            ("waist_flexion", 14.0),
            ("thorax_flexion", 8.0),
            ("neck_flexion", -25.0),
            ("l_shoulder_flexion", 120.0),
            ("r_shoulder_flexion", 120.0),
            ("l_shoulder_abduction", 5.0),
            ("r_shoulder_abduction", 5.0),
        ],
    );
    planted(body, 5.0, |t| {
        stand.mix(&low, ramp(t, 0.3, 2.0) - ramp(t, 2.6, 4.4))
    })
}

pub fn wave(body: &Body) -> (Vec<Posture>, Vec<[bool; 2]>) {
    let stand = stand(body, HALF_STANCE);
    let mut raised = stand;
    raised.com[1] += 0.01 * Measures::of(body).scale;
    set(
        &mut raised.angles,
        &[
            ("waist_lateral", -2.0),
            ("neck_rotation", -8.0),
            ("r_shoulder_flexion", 25.0),
            ("r_shoulder_abduction", 92.0),
            ("r_shoulder_rotation", -68.0),
            ("r_elbow_flexion", 75.0),
            ("r_elbow_pronation", 35.0),
        ],
    );
    planted(body, 5.0, |t| {
        let mut plan = stand.mix(&raised, ramp(t, 0.2, 1.3) - ramp(t, 3.7, 4.8));
        let strength = ramp(t, 1.0, 1.6) - ramp(t, 3.4, 4.0);
        let beat = strength * (TAU * 1.5 * (t - 1.0)).sin();
        let elbow = super::shape::dof("r_elbow_flexion");
        let wrist = super::shape::dof("r_wrist_deviation");
        plan.angles[elbow] += 25f64.to_radians() * beat;
        plan.angles[wrist] += 6f64.to_radians() * beat;
        plan
    })
}
