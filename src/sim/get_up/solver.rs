//! Joint rates that lead a posture towards goals: damped least squares with limits, one solution per tick.

use super::goals::{GoalAim, Goals};
use crate::body::angles::{anatomical_angles, clamp_to_limits, set_anatomical_angles};
use crate::body::topology::{
    CHEST, DOF_COUNT, FEET, HANDS, NV, PELVIS, SEGMENT_COUNT, SHANKS, SegmentId, TOES,
};
use crate::body::{Body, Links, Posture, State};
use crate::dynamics::Terms;
use crate::dynamics::terms::WIDTH;
use crate::get_up::params::layout::NEAR_HEIGHT;
use crate::get_up::params::solver::{
    APPROACH, FASTEST, LIMIT_MARGIN, LIMIT_ROUNDS, RATE_TOLERANCE,
};
use crate::get_up::params::weights::{DAMPING, FINGERS, FLOOR, JOINT_LIMIT, STEADY};
use crate::math::dense::cholesky_solve_summed;
use crate::math::{Quat, Vec3};

/// Point of the shank on which a body kneels, and points of the toes under the ball of the foot.
pub const KNEE: usize = 0;
pub const BALL: [usize; 2] = [0, 1];
/// Points of a palm that lies flat: finger tip, knuckles, palm.
const PALM: [usize; 4] = [0, 1, 3, 4];

/// Normal equations of a tick, and the data from which they are built.
#[derive(Clone, Debug)]
pub struct Solver {
    links: Links,
    terms: Terms,
    matrix: Box<[[f64; NV]; NV]>,
    factor: Box<[[f64; NV]; NV]>,
    right: [f64; NV],
    points: [Vec<Vec3>; SEGMENT_COUNT],
}

impl Solver {
    pub fn new(body: &Body) -> Self {
        Self {
            links: Links::new(body),
            terms: Terms::default(),
            matrix: Box::new([[0.0; NV]; NV]),
            factor: Box::new([[0.0; NV]; NV]),
            right: [0.0; NV],
            points: std::array::from_fn(|s| body.segments[s].contact_points.clone()),
        }
    }

    /// Moves `q`, which has the rates `v`, by `dt` seconds towards `goals`.
    pub fn advance(
        &mut self,
        body: &Body,
        (q, v): (&mut Posture, &mut [f64; NV]),
        goals: &Goals,
        dt: f64,
    ) {
        self.terms
            .compute(&self.links, &State::at_rest(*q), &[], 0.0);
        for row in self.matrix.iter_mut() {
            row.fill(0.0);
        }
        self.right.fill(0.0);
        let steady = STEADY * (APPROACH / dt) * (APPROACH / dt);
        for i in 0..NV {
            self.pull(i, v[i], steady);
            self.pull(i, 0.0, DAMPING);
        }
        self.hold_pose(q, goals);
        self.hold_trunk(body, q, goals);
        for side in 0..2 {
            self.hold_limbs(body, side, goals);
        }
        self.stay_above(body, v, dt);
        *v = self.solve(body, q);
        q.integrate(v, dt);
        clamp_to_limits(body, q, LIMIT_MARGIN);
    }

    /// Adds a goal for a rate: `row · v = rate`.
    fn add(&mut self, row: &[f64; WIDTH], rate: f64, weight: f64) {
        for i in 0..NV {
            if row[i] == 0.0 {
                continue;
            }
            self.right[i] += weight * row[i] * rate;
            for (m, r) in self.matrix[i].iter_mut().zip(row).take(i + 1) {
                *m += weight * row[i] * r;
            }
        }
    }

    /// Adds a goal for the rate of component `i` alone.
    fn pull(&mut self, i: usize, rate: f64, weight: f64) {
        self.matrix[i][i] += weight;
        self.right[i] += weight * rate;
    }

    /// Adds goals that move a point of a segment to the coordinates that have weight.
    fn point(&mut self, s: SegmentId, point: Vec3, to: [GoalAim; 3]) {
        if to.iter().all(|a| a.weight == 0.0) {
            return;
        }
        let mut rows = [[0.0; WIDTH]; 3];
        self.terms.point_jacobian(s.index(), point, &mut rows);
        let at = self.terms.point_world(s.index(), point).to_array();
        for ((row, to), at) in rows.iter().zip(to).zip(at) {
            if to.weight > 0.0 {
                self.add(row, (to.at - at) / APPROACH, to.weight);
            }
        }
    }

    fn hold_pose(&mut self, q: &Posture, goals: &Goals) {
        let mut wanted = *q;
        set_anatomical_angles(&mut wanted, &goals.pose.map(|a| a.at));
        let to = q.joint_difference(&wanted);
        for (j, aim) in goals.pose.iter().enumerate() {
            self.pull(6 + j, to[j] / APPROACH, aim.weight);
        }
    }

    fn hold_trunk(&mut self, body: &Body, q: &Posture, goals: &Goals) {
        let [pitch, roll, yaw] = goals.turn;
        let bent = Quat::exp(Vec3::Z * yaw.at) * Quat::exp(Vec3::Y * pitch.at);
        let wanted = bent * Quat::exp(Vec3::Z * roll.at);
        let turn = (wanted * q.root_rotation.conjugate()).log() * (1.0 / APPROACH);
        self.pull(0, turn.x, roll.weight);
        self.pull(1, turn.y, pitch.weight);
        self.pull(2, turn.z, yaw.weight);
        self.point(PELVIS, Vec3::zero(), goals.pelvis);
        let (com, jc) = (self.terms.com, self.terms.jc);
        for (k, at) in [com.x, com.y].into_iter().enumerate() {
            let aim = goals.com[k];
            self.add(&jc[k], (aim.at - at) / APPROACH, aim.weight);
        }
        for k in [2, 3] {
            let p = body.segment(CHEST).contact_points[k];
            self.point(CHEST, p, [GoalAim::NONE, GoalAim::NONE, goals.chest]);
        }
    }

    fn hold_limbs(&mut self, body: &Body, side: usize, goals: &Goals) {
        let (shank, foot, toes, hand) = (SHANKS[side], FEET[side], TOES[side], HANDS[side]);
        let knee = body.segment(shank).contact_points[KNEE];
        self.point(shank, knee, goals.knees[side]);
        let [x, y, z] = goals.balls[side];
        let points = &body.segment(toes).contact_points;
        let across = |p: &Vec3| self.terms.point_world(toes.index(), *p).y;
        let middle = BALL.map(|k| across(&points[k])).iter().sum::<f64>() / BALL.len() as f64;
        let beside = [0, 1].map(|k| y.at + across(&points[k]) - middle);
        for (i, p) in points.iter().enumerate() {
            // The ball of the foot stays in place, but the tips of the toes only have to stay down.
            let to = match beside.get(i) {
                Some(at) => [x, GoalAim { at: *at, ..y }, z],
                None => [GoalAim::NONE, GoalAim::NONE, goals.tips[side]],
            };
            self.point(toes, *p, to);
        }
        for p in &body.segment(foot).contact_points {
            self.point(foot, *p, [GoalAim::NONE, GoalAim::NONE, goals.heels[side]]);
        }
        self.point(hand, Vec3::zero(), goals.hands[side]);
        let palm = goals.palms[side];
        let points = &body.segment(hand).contact_points;
        for k in PALM {
            self.point(hand, points[k], [GoalAim::NONE, GoalAim::NONE, palm]);
        }
        let wrist = self.terms.point_world(hand.index(), Vec3::zero());
        let ahead = GoalAim {
            at: wrist.y,
            weight: FINGERS * palm.weight,
        };
        self.point(hand, points[0], [GoalAim::NONE, ahead, GoalAim::NONE]);
    }

    /// Adds goals that return points to the floor if they would sink below it at the rates `v`.
    fn stay_above(&mut self, body: &Body, v: &[f64; NV], dt: f64) {
        for s in SegmentId::all() {
            for p in &body.segment(s).contact_points {
                let z = self.terms.point_world(s.index(), *p).z;
                if z > NEAR_HEIGHT {
                    continue;
                }
                let mut rows = [[0.0; WIDTH]; 3];
                self.terms.point_jacobian(s.index(), *p, &mut rows);
                let rate: f64 = rows[2].iter().zip(v).map(|(j, v)| j * v).sum();
                if z + dt * rate < 0.0 {
                    self.add(&rows[2], -z / APPROACH, FLOOR);
                }
            }
        }
    }

    /// The rates that meet the goals best within the limits of the joints.
    fn solve(&mut self, body: &Body, q: &Posture) -> [f64; NV] {
        let angles = anatomical_angles(q);
        let mut held: [Option<f64>; DOF_COUNT] = [None; DOF_COUNT];
        let mut out = self.least_squares(&held);
        for _ in 0..LIMIT_ROUNDS {
            let mut found = false;
            for d in 0..DOF_COUNT {
                let room = [
                    (body.lower[d] + LIMIT_MARGIN - angles[d]) / APPROACH,
                    (body.upper[d] - LIMIT_MARGIN - angles[d]) / APPROACH,
                ];
                let limit = out[6 + d].clamp(
                    room[0].clamp(-FASTEST, FASTEST),
                    room[1].clamp(-FASTEST, FASTEST),
                );
                if held[d].is_none() && (out[6 + d] - limit).abs() > RATE_TOLERANCE {
                    held[d] = Some(limit);
                    found = true;
                }
            }
            if !found {
                break;
            }
            out = self.least_squares(&held);
        }
        out
    }

    /// Solves the normal equations by Cholesky, with the `held` rates fixed.
    fn least_squares(&mut self, held: &[Option<f64>; DOF_COUNT]) -> [f64; NV] {
        let (a, mut x) = (&mut self.factor, self.right);
        a.copy_from_slice(&self.matrix[..]);
        for (d, to) in held.iter().enumerate() {
            if let Some(to) = to {
                a[6 + d][6 + d] += JOINT_LIMIT;
                x[6 + d] += JOINT_LIMIT * to;
            }
        }
        cholesky_solve_summed(a, &mut x);
        x
    }

    /// A contact point of a segment, segment frame, m.
    pub fn contact(&self, s: SegmentId, point: usize) -> Vec3 {
        self.points[s.index()][point]
    }

    /// Height of the lowest contact point of a segment, m.
    pub fn lowest(&self, terms: &Terms, s: SegmentId) -> f64 {
        let points = self.points[s.index()].iter();
        points.fold(f64::INFINITY, |z, p| {
            z.min(terms.point_world(s.index(), *p).z)
        })
    }
}
