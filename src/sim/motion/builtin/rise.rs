//! Getting up from the belly, for any body: up on hands and knees, back onto the heels, the hands one after the other to the knees, onto the
//! feet, up.
//!
//! A plan of [`Stage`]s, each a handful of goals: where pelvis, knees, balls of the feet and hands are, over which point the centre of mass is, what the
//! joints should look like. Between two stages goals and weights pass over smoothly, and every sample is solved for all joints at once by
//! damped least squares, starting from the sample before it. At all times the centre of mass is over what touches, so the motion can be followed at any pace.

use crate::sim::body::angles::{anatomical_angles, clamp_to_limits, set_anatomical_angles};
use crate::sim::body::topology::{
    CHEST, DOF_COUNT, DOF_LEN, DOF_NAMES, DOF_START, L_FOOT, L_HAND, L_SHANK, L_TOES, L_UPPER_ARM,
    NV, PELVIS, R_FOOT, R_HAND, R_SHANK, R_TOES, SegmentId,
};
use crate::sim::body::{Body, Links, Posture, State};
use crate::sim::dynamics::Terms;
use crate::sim::dynamics::terms::WIDTH;
use crate::sim::math::{Quat, Vec3};

/// Samples per second: slow enough to be solved quickly; between samples the clip is smooth.
pub const RATE: f64 = 20.0;
/// Leg length (hip to ankle) that distances are written for, m.
const REFERENCE_LEG: f64 = 0.867;
/// Half the distance between the knees, and between the feet, reference body, m.
const HALF_WIDTH: f64 = 0.12;
/// A wrist is this high over a hand that lies flat, reference body, m.
const WRIST: f64 = 0.045;
/// Most steps of the solution of one sample, of the first sample, and the step at which it is solved, rad.
const STEPS: usize = 12;
const FIRST_STEPS: usize = 60;
const SOLVED: f64 = 1e-4;
/// Longest step, rad over all joints.
const LONGEST: f64 = 0.5;
/// Joints stay this far from their limits, rad.
const MARGIN: f64 = 0.02;
/// Rounds of finding the joints at their limits, and the weight that holds them there.
const LIMIT_ROUNDS: usize = 4;
const LIMIT_WEIGHT: f64 = 1e3;
/// Weights: what the joints should look like, the sample before, damping of joints and of the pelvis, upright pelvis, centre of mass to
/// the side, nothing in the floor, fingers to the front.
const LOOKS: f64 = 5e-3;
const STEADY: f64 = 0.03;
const DAMPING: (f64, f64) = (1e-3, 1e-4);
const LEVEL: f64 = 1.0;
const ACROSS: f64 = 3.0;
const FLOOR: f64 = 30.0;
const FINGERS: f64 = 0.3;
/// Bend of the knees that takes the feet off the floor, rad.
const KNEES_BENT: f64 = 0.8;
/// Seconds for which the last stage is held.
const HELD: f64 = 0.8;

/// One hand: place of the wrist (forward, outward, up, m) with its weight, and the weight of a palm that is level.
#[derive(Clone, Copy, Debug)]
struct Hand {
    wrist: [f64; 3],
    weight: f64,
    palm: f64,
}

/// What an instant looks like. Places along x, from where the knees are at first, m; a goal without weight is none.
#[derive(Clone, Copy, Debug)]
struct Stage {
    /// Pelvis: x and z, with weight; pitch, with weight, rad.
    pelvis: ([f64; 2], f64),
    pitch: (f64, f64),
    /// Centre of mass: x, with weight; y.
    com: (f64, f64),
    aside: f64,
    /// Weight of the knees on the floor, at x = 0, and of the heels.
    knees: f64,
    heels: f64,
    /// Weight of the front of the chest on the floor.
    chest: f64,
    hands: [Hand; 2],
    angles: [f64; DOF_COUNT],
}

/// Between `a` and `b`; a goal that has weight in only one of two stages stays where that has it.
fn between(a: (f64, f64), b: (f64, f64), u: f64) -> f64 {
    match (a.1 > 0.0, b.1 > 0.0) {
        (true, false) => a.0,
        (false, true) => b.0,
        _ => a.0 + u * (b.0 - a.0),
    }
}

impl Stage {
    /// The same with the hands elsewhere.
    fn with_hands(mut self, left: Hand, right: Hand) -> Self {
        self.hands = [left, right];
        self
    }

    /// The same with the centre of mass so far to the left, m.
    fn leaning(mut self, aside: f64) -> Self {
        self.aside = aside;
        self
    }

    fn mix(&self, to: &Self, u: f64) -> Self {
        let m = |a: f64, b: f64| a + u * (b - a);
        let hand = |h: usize| {
            let (a, b) = (self.hands[h], to.hands[h]);
            Hand {
                wrist: std::array::from_fn(|k| {
                    between((a.wrist[k], a.weight), (b.wrist[k], b.weight), u)
                }),
                weight: m(a.weight, b.weight),
                palm: m(a.palm, b.palm),
            }
        };
        let pair = |a: (f64, f64), b: (f64, f64)| (between(a, b, u), m(a.1, b.1));
        let (p, q) = (self.pelvis, to.pelvis);
        Self {
            pelvis: (
                std::array::from_fn(|k| between((p.0[k], p.1), (q.0[k], q.1), u)),
                m(p.1, q.1),
            ),
            pitch: pair(self.pitch, to.pitch),
            com: pair(self.com, to.com),
            aside: m(self.aside, to.aside),
            knees: m(self.knees, to.knees),
            heels: m(self.heels, to.heels),
            chest: m(self.chest, to.chest),
            hands: [hand(0), hand(1)],
            angles: std::array::from_fn(|d| m(self.angles[d], to.angles[d])),
        }
    }
}

/// Joint angles in degrees by name; a name without side means both.
fn looks(list: &[(&str, f64)]) -> [f64; DOF_COUNT] {
    const ARMS: [(&str, f64); 3] = [
        ("shoulder_abduction", 12.0),
        ("elbow_pronation", 75.0),
        ("wrist_flexion", -70.0),
    ];
    let mut out = [0.0; DOF_COUNT];
    for (name, degrees) in ARMS.iter().chain(list) {
        for (angle, dof) in out.iter_mut().zip(DOF_NAMES) {
            let both = dof.strip_prefix("l_").or(dof.strip_prefix("r_"));
            if dof == *name || both == Some(*name) {
                *angle = degrees.to_radians();
            }
        }
    }
    out
}

/// The stages and when each is reached, s, for a body `scale` times as large as the reference body that ends standing `at_ease`.
fn stages(scale: f64, at_ease: &Posture) -> Vec<(f64, Stage)> {
    let hand = |x: f64, y: f64, z: f64, palm: f64| Hand {
        wrist: [x, y, z].map(|x| x * scale),
        weight: 5.0,
        palm,
    };
    let place = |x: f64, z: f64| [x * scale, z * scale];
    // On the knees the hands are first where the chest was, last beside the knees.
    let (far, near) = (hand(0.56, 0.27, WRIST, 5.0), hand(0.07, 0.25, WRIST, 5.0));
    let free = hand(0.56, 0.25, WRIST + 0.017, 5.0);
    let off = hand(0.54, 0.25, 0.14, 1.0);
    let on_the_way = hand(0.28, 0.25, 0.18, 1.0);
    let prone = Stage {
        pelvis: (place(0.43, 0.09), 1.0),
        pitch: (1.6, 1.0),
        com: (0.0, 0.0),
        aside: 0.0,
        knees: 10.0,
        heels: 0.0,
        chest: 0.0,
        hands: [far; 2],
        angles: looks(&[
            ("shoulder_flexion", -35.0),
            ("elbow_flexion", 100.0),
            ("toe_extension", 50.0),
            ("ankle_flexion", 20.0),
            ("neck_flexion", -30.0),
        ]),
    };
    let flat = Stage {
        pitch: (1.57, 0.1),
        chest: 10.0,
        ..prone
    };
    let on_all_fours = Stage {
        pelvis: (place(0.02, 0.46), 1.0),
        pitch: (1.35, 1.0),
        angles: looks(&[
            ("shoulder_flexion", 100.0),
            ("elbow_flexion", 20.0),
            ("toe_extension", 50.0),
            ("ankle_flexion", 20.0),
            ("neck_flexion", -30.0),
        ]),
        ..prone
    };
    // The centre of mass behind the knees, so that the hands are free.
    let back = Stage {
        pelvis: (place(-0.28, 0.38), 1.0),
        pitch: (1.4, 0.5),
        com: (-0.07 * scale, 10.0),
        aside: -0.03 * scale,
        ..on_all_fours
    };
    let left = |h: Hand| back.with_hands(h, far);
    let over = left(near).leaning(0.03 * scale);
    let right = |h: Hand| over.with_hands(near, h);
    let beside = Stage {
        pelvis: (place(-0.29, 0.37), 1.0),
        pitch: (1.0, 2.0),
        com: (-0.06 * scale, 0.5),
        aside: 0.0,
        angles: looks(&[
            ("shoulder_flexion", 60.0),
            ("elbow_flexion", 20.0),
            ("toe_extension", 60.0),
            ("ankle_flexion", 30.0),
            ("waist_flexion", 25.0),
            ("thorax_flexion", 15.0),
        ]),
        ..right(near)
    };
    let rock = Stage {
        pelvis: (place(-0.44, 0.41), 3.0),
        com: (-0.20 * scale, 2.0),
        knees: 0.0,
        pitch: (1.0, 1.0),
        angles: looks(&[
            ("shoulder_flexion", 60.0),
            ("elbow_flexion", 15.0),
            ("toe_extension", 50.0),
            ("ankle_flexion", 30.0),
            ("hip_flexion", 110.0),
            ("hip_abduction", 12.0),
            ("knee_flexion", 135.0),
            ("waist_flexion", 30.0),
            ("thorax_flexion", 20.0),
            ("neck_flexion", -20.0),
        ]),
        ..beside
    };
    let crouch = Stage {
        pelvis: (place(-0.62, 0.40), 0.5),
        com: (-0.41 * scale, 30.0),
        pitch: (0.9, 0.1),
        angles: looks(&[
            ("shoulder_flexion", 60.0),
            ("elbow_flexion", 5.0),
            ("toe_extension", 30.0),
            ("ankle_flexion", 30.0),
            ("hip_flexion", 115.0),
            ("hip_abduction", 15.0),
            ("knee_flexion", 140.0),
            ("waist_flexion", 40.0),
            ("thorax_flexion", 25.0),
            ("neck_flexion", -20.0),
        ]),
        ..rock
    };
    let settle = Stage {
        pelvis: (place(-0.68, 0.43), 0.5),
        com: (-0.445 * scale, 30.0),
        heels: 3.0,
        hands: [Hand {
            weight: 1.0,
            palm: 0.5,
            ..near
        }; 2],
        ..crouch
    };
    let squat = Stage {
        pelvis: (place(-0.60, 0.50), 0.3),
        com: (-0.46 * scale, 30.0),
        heels: 10.0,
        pitch: (0.7, 1.0),
        hands: [Hand {
            weight: 1.0,
            ..hand(-0.10, 0.25, 0.40, 0.0)
        }; 2],
        angles: looks(&[
            ("shoulder_flexion", 80.0),
            ("elbow_flexion", 10.0),
            ("hip_flexion", 110.0),
            ("knee_flexion", 115.0),
            ("ankle_flexion", 33.0),
            ("waist_flexion", 40.0),
            ("thorax_flexion", 20.0),
            ("wrist_flexion", 0.0),
        ]),
        ..settle
    };
    let stand = Stage {
        pelvis: ([0.0; 2], 0.0),
        com: (-0.50 * scale, 30.0),
        pitch: (0.0, 0.3),
        hands: [Hand {
            weight: 0.0,
            ..squat.hands[0]
        }; 2],
        angles: anatomical_angles(at_ease),
        ..squat
    };
    vec![
        (0.0, flat),
        (1.6, prone),
        (3.6, on_all_fours),
        (4.1, back),
        (4.5, left(free)),
        (4.8, left(off)),
        (5.3, left(on_the_way)),
        (5.8, left(near)),
        (6.6, over),
        (7.0, right(free)),
        (7.3, right(off)),
        (7.8, right(on_the_way)),
        (8.3, right(near).leaning(0.0)),
        (8.9, beside),
        (9.8, rock),
        (10.7, crouch),
        (11.4, settle),
        (12.2, squat),
        (13.4, stand),
        (13.4 + HELD, stand),
    ]
}

/// Normal equations of one step, and what they are built with.
struct Solver<'a> {
    body: &'a Body,
    scale: f64,
    links: Links,
    terms: Terms,
    matrix: Box<[[f64; NV]; NV]>,
    right: [f64; NV],
}

impl Solver<'_> {
    /// Adds a goal: `row · step = error`.
    fn add(&mut self, row: &[f64; WIDTH], error: f64, weight: f64) {
        for i in 0..NV {
            if row[i] == 0.0 {
                continue;
            }
            self.right[i] += weight * row[i] * error;
            for (m, r) in self.matrix[i].iter_mut().zip(row).take(i + 1) {
                *m += weight * row[i] * r;
            }
        }
    }

    /// Adds one for component `i` alone.
    fn pull(&mut self, i: usize, error: f64, weight: f64) {
        self.matrix[i][i] += weight;
        self.right[i] += weight * error;
    }

    /// A point of a segment goes where coordinates are given.
    fn point(&mut self, s: SegmentId, point: Vec3, to: [Option<f64>; 3], weight: f64) {
        if weight == 0.0 {
            return;
        }
        let mut rows = [[0.0; WIDTH]; 3];
        self.terms.point_jacobian(s.index(), point, &mut rows);
        let at = self.terms.point_world(s.index(), point).to_array();
        for ((row, to), at) in rows.iter().zip(to).zip(at) {
            if let Some(to) = to {
                self.add(row, to - at, weight);
            }
        }
    }

    /// One step of `q` towards `stage`, not far from `near`; how long it was, rad.
    fn step(&mut self, q: &mut Posture, stage: &Stage, near: Option<&Posture>) -> f64 {
        self.terms
            .compute(&self.links, &State::at_rest(*q), &[], 0.0);
        for row in self.matrix.iter_mut() {
            row.fill(0.0);
        }
        self.right.fill(0.0);
        self.joint_goals(q, stage, near);
        self.trunk_goals(q, stage);
        for side in 0..2 {
            self.limb_goals(side, stage);
        }
        let body = self.body;
        for s in SegmentId::all() {
            for p in &body.segment(s).contact_points {
                if self.terms.point_world(s.index(), *p).z < 0.0 {
                    self.point(s, *p, [None, None, Some(0.0)], FLOOR);
                }
            }
        }
        let mut step = self.solve(q);
        let length = step[6..].iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > LONGEST {
            step = step.map(|x| x * LONGEST / length);
        }
        q.integrate(&step, 1.0);
        clamp_to_limits(body, q, MARGIN);
        length
    }

    fn joint_goals(&mut self, q: &Posture, stage: &Stage, near: Option<&Posture>) {
        let mut looks = *q;
        set_anatomical_angles(&mut looks, &stage.angles);
        let (to, back) = (
            q.joint_difference(&looks),
            near.map(|n| q.joint_difference(n)),
        );
        for j in 0..DOF_COUNT {
            self.pull(6 + j, to[j], LOOKS);
            if let Some(back) = &back {
                self.pull(6 + j, back[j], STEADY);
            }
            self.pull(6 + j, 0.0, DAMPING.0);
        }
        for i in 0..6 {
            self.pull(i, 0.0, DAMPING.1);
        }
    }

    fn trunk_goals(&mut self, q: &Posture, stage: &Stage) {
        let turn = (Quat::exp(Vec3::Y * stage.pitch.0) * q.root_rotation.conjugate()).log();
        self.pull(0, turn.x, LEVEL);
        self.pull(1, turn.y, stage.pitch.1);
        self.pull(2, turn.z, LEVEL);
        let ([x, z], weight) = stage.pelvis;
        self.point(PELVIS, Vec3::zero(), [Some(x), None, Some(z)], weight);
        let (com, jc) = (self.terms.com, self.terms.jc);
        self.add(&jc[0], stage.com.0 - com.x, stage.com.1);
        self.add(&jc[1], stage.aside - com.y, ACROSS);
        for k in [2, 3] {
            let p = self.body.segment(CHEST).contact_points[k];
            self.point(CHEST, p, [None, None, Some(0.0)], stage.chest);
        }
    }

    fn limb_goals(&mut self, side: usize, stage: &Stage) {
        let outward = if side == 0 { 1.0 } else { -1.0 };
        let [shank, foot, toes, hand] = [
            [L_SHANK, L_FOOT, L_TOES, L_HAND],
            [R_SHANK, R_FOOT, R_TOES, R_HAND],
        ][side];
        let (body, scale) = (self.body, self.scale);
        let y = outward * HALF_WIDTH * scale;
        let knee = body.segment(shank).contact_points[0];
        self.point(shank, knee, [Some(0.0), Some(y), Some(0.0)], stage.knees);
        for (i, p) in body.segment(toes).contact_points.iter().enumerate() {
            // The ball of the foot stays where it is; the tips of the toes only stay down.
            let ball = i < 2;
            let to = [
                ball.then_some(-0.43 * scale),
                ball.then_some(y + p.y),
                Some(0.0),
            ];
            self.point(toes, *p, to, 10.0);
        }
        for p in &body.segment(foot).contact_points {
            self.point(foot, *p, [None, None, Some(0.0)], stage.heels);
        }
        let goal = stage.hands[side];
        let [x, out, z] = goal.wrist;
        let to = [Some(x), Some(outward * out), Some(z)];
        self.point(hand, Vec3::zero(), to, goal.weight);
        let points = &body.segment(hand).contact_points;
        for k in [0, 1, 3, 4] {
            self.point(
                hand,
                points[k],
                [None, None, Some(z - WRIST * scale)],
                goal.palm,
            );
        }
        let wrist = self.terms.point_world(hand.index(), Vec3::zero());
        let ahead = [None, Some(wrist.y), None];
        self.point(hand, points[0], ahead, FINGERS * goal.palm);
    }

    /// The step that meets the goals best within the limits of the joints.
    fn solve(&self, q: &Posture) -> [f64; NV] {
        let angles = anatomical_angles(q);
        let mut held: [Option<f64>; DOF_COUNT] = [None; DOF_COUNT];
        let mut step = self.least_squares(&held);
        for _ in 0..LIMIT_ROUNDS {
            let mut found = false;
            for d in 0..DOF_COUNT {
                let (low, high) = (self.body.lower[d] + MARGIN, self.body.upper[d] - MARGIN);
                let next = angles[d] + step[6 + d];
                let limit = next.clamp(low, high);
                if held[d].is_none() && (next - limit).abs() > 1e-6 {
                    held[d] = Some(limit - angles[d]);
                    found = true;
                }
            }
            if !found {
                break;
            }
            step = self.least_squares(&held);
        }
        step
    }

    /// Cholesky of the normal equations, with the joints that are held where they are to go.
    fn least_squares(&self, held: &[Option<f64>; DOF_COUNT]) -> [f64; NV] {
        let (mut a, mut x) = (self.matrix.clone(), self.right);
        for (d, to) in held.iter().enumerate() {
            if let Some(to) = to {
                a[6 + d][6 + d] += LIMIT_WEIGHT;
                x[6 + d] += LIMIT_WEIGHT * to;
            }
        }
        for j in 0..NV {
            for k in 0..j {
                let l = a[j][k];
                for row in a.iter_mut().skip(j) {
                    row[j] -= row[k] * l;
                }
            }
            let d = a[j][j].sqrt();
            for row in a.iter_mut().skip(j) {
                row[j] /= d;
            }
        }
        for i in 0..NV {
            for k in 0..i {
                x[i] -= a[i][k] * x[k];
            }
            x[i] /= a[i][i];
        }
        for i in (0..NV).rev() {
            for k in i + 1..NV {
                x[i] -= a[k][i] * x[k];
            }
            x[i] /= a[i][i];
        }
        x
    }
}

/// The same with the arms out to the sides, elbows bent, and the feet off the floor, so that the toes can be tucked under.
pub fn arms_out(prone: &Posture) -> Posture {
    let mut angles = anatomical_angles(prone);
    let arms = looks(&[
        ("shoulder_flexion", -10.0),
        ("shoulder_abduction", 80.0),
        ("elbow_flexion", 80.0),
        ("wrist_flexion", 0.0),
    ]);
    let first = DOF_START[L_UPPER_ARM.index()];
    let last = DOF_START[R_HAND.index()] + DOF_LEN[R_HAND.index()];
    angles[first..last].copy_from_slice(&arms[first..last]);
    for shank in [L_SHANK, R_SHANK] {
        angles[DOF_START[shank.index()]] += KNEES_BENT;
    }
    let mut out = *prone;
    set_anatomical_angles(&mut out, &angles);
    out
}

/// Postures and planted feet of the way up, [`RATE`] per second.
pub fn rise(body: &Body, at_ease: &Posture) -> (Vec<Posture>, Vec<[bool; 2]>) {
    let leg = body.joint_offset[L_FOOT.index()].norm() + body.joint_offset[L_SHANK.index()].norm();
    let scale = leg / REFERENCE_LEG;
    let stages = stages(scale, at_ease);
    let mut solver = Solver {
        body,
        scale,
        links: Links::new(body),
        terms: Terms::default(),
        matrix: Box::new([[0.0; NV]; NV]),
        right: [0.0; NV],
    };
    let mut q = Posture {
        root_position: Vec3 {
            x: 0.43 * scale,
            y: 0.0,
            z: 0.12 * scale,
        },
        root_rotation: Quat::exp(Vec3::Y * stages[0].1.pitch.0),
        ..Posture::default()
    };
    set_anatomical_angles(&mut q, &stages[0].1.angles);
    for _ in 0..FIRST_STEPS {
        solver.step(&mut q, &stages[0].1, None);
    }
    let (mut postures, mut planted) = (Vec::new(), Vec::new());
    for pair in stages.windows(2) {
        let [(from, a), (to, b)] = pair else { continue };
        // Samples after `from` up to `to`, and the very first.
        let first = (from * RATE).round() as usize + usize::from(!postures.is_empty());
        for i in first..=(to * RATE).round() as usize {
            let u = (i as f64 / RATE - from) / (to - from);
            let u = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
            let stage = a.mix(b, u);
            let before = q;
            for _ in 0..STEPS {
                if solver.step(&mut q, &stage, Some(&before)) < SOLVED {
                    break;
                }
            }
            postures.push(q);
            planted.push([stage.knees == 0.0; 2]);
        }
    }
    (postures, planted)
}
