//! Secondary constraints, (12)–(15): the errors of centre of mass, hands and client constraints, as rows, and the wish
//! x that corrects them.

use crate::body::NV;
use crate::body::topology::{DOF_LEN, DOF_START};
use crate::control::goals::GoalPace;
use crate::control::rows::{JointRow, dot};
use crate::control::tracking::Law;
use crate::control::{ConstraintGoal, ControlInput, Effector};
use crate::dynamics::terms::WIDTH;
use crate::math::{Quat, Vec3};
use crate::paper::controller::{Paper, SupportMotion};
use crate::paper::feasible_com::{INSET, feasible};
use crate::paper::spatial_targets::wish;
use crate::setup::ControlParams;

/// Length that makes rotations of an end-effector comparable with its motion, m.
const ROTATION_LENGTH: f64 = 0.3;
/// Horizon of the ZMP-feasible centre-of-mass law if the joints have none, s: gains 25 and 10.
const COM_HORIZON: f64 = 0.1;
/// Pace at which client constraints are approached.
const GOAL_PACE: GoalPace = GoalPace {
    horizon: 0.05,
    most: 4.0,
    most_trunk: 2.0,
    most_turn: 10.0,
};
/// Distances of the capture point inside the edge, m: below the first, constraints on the whole body are released;
/// above the second, they act fully.
const SURE: (f64, f64) = (0.02, 0.045);
/// Most client constraints that (12) takes.
const MOST_GOALS: usize = 8;

impl Paper {
    /// Rows and desired changes of centre of mass and end-effectors (14), (15), at joint accelerations `qdd`, and the
    /// wish x of (12).
    pub(super) fn wish(
        &mut self,
        input: &ControlInput<'_>,
        law: &Law,
        qdd: &JointRow,
        mode: SupportMotion,
    ) -> JointRow {
        let (terms, params) = (input.terms, input.params);
        self.com_task.clear();
        self.hand_task.clear();
        self.led_task.clear();
        if params.track_com && matches!(mode, SupportMotion::Rest(_)) {
            self.push_com(input, law, qdd);
        }
        // A tipping figure turns as a whole: hands held at their place in the world would bend it.
        if params.track_hands && !matches!(mode, SupportMotion::Tilt(..)) {
            for e in input.effectors.iter().take(2) {
                self.push_effector(input, law, qdd, e, matches!(mode, SupportMotion::Flight));
            }
        }
        if !matches!(mode, SupportMotion::Tilt(..)) {
            self.hand_task.begin_goals();
            for goal in input.goals.iter().take(MOST_GOALS) {
                let mut goal = *goal;
                if !goal.is_on_arm() {
                    goal.weight *= Self::sure(input);
                }
                self.push_goal(input, qdd, &goal);
            }
        }
        if self.held_count > 0 {
            self.com_task.restrict(&self.held_qr);
            self.hand_task.restrict(&self.held_qr);
            self.led_task.restrict(&self.held_qr);
        }
        debug_assert!(terms.mass > 0.0);
        wish(
            &self.com_task,
            &self.hand_task,
            &self.led_task,
            params.priority,
        )
    }

    /// Two rows of (14): the change that the centre of mass needs at `qdd`, limited to what the feet can give if the
    /// parameters say so.
    pub(super) fn push_com(&mut self, input: &ControlInput<'_>, law: &Law, qdd: &JointRow) {
        let (terms, c) = (input.terms, input.centroidal.com);
        let law = if input.params.zmp_feasible {
            let horizon = input.params.horizon.or(Some(COM_HORIZON));
            Law::new(
                &ControlParams {
                    horizon,
                    ..input.params.clone()
                },
                input.dt,
            )
        } else {
            *law
        };
        let g = law.demand_vector(
            (c.now - terms.com, c.now_velocity),
            (c.next - terms.com, c.next_velocity),
            terms.com_velocity,
        );
        let mut g = [g.x, g.y];
        if input.params.zmp_feasible {
            let (points, planned) = (input.support.points(), self.planned);
            let planned = points.iter().filter(|p| planned.holds(p.segment));
            // A wall or a table stops a body that comes over it: the area between it and the feet counts as supported.
            let rests = input.support.rests().iter().map(|r| r.position);
            let all = planned.map(|p| p.position).chain(rests);
            self.polygon.set_hull(all.map(|p| [p.x, p.y]));
            self.polygon.reduce_thin();
            self.inset.set_inset(&self.polygon, INSET);
            g = feasible(terms.com, g, &self.inset, input.gravity);
        }
        let bias = [terms.com_bias.x, terms.com_bias.y];
        for k in 0..2 {
            let row = self.map.project(&terms.jc[k]);
            let initial = dot(&row, qdd) + self.map.project_bias(&terms.jc[k]) + bias[k]; // Eq. 14 with its bias
            self.com_task.push(row, g[k] - initial);
        }
    }

    /// Rows of (15): the change that a hand needs at `qdd`.
    fn push_effector(
        &mut self,
        input: &ControlInput<'_>,
        law: &Law,
        qdd: &JointRow,
        e: &Effector,
        flight: bool,
    ) {
        let (terms, s) = (input.terms, e.segment.index());
        let mut jacobian = [[0.0; WIDTH]; 3];
        terms.point_jacobian(s, e.point, &mut jacobian);
        let mut bias = terms.point_bias(s, e.point);
        let (mut at, mut velocity) = (
            terms.point_world(s, e.point),
            terms.point_velocity(s, e.point),
        );
        let mut t = e.position;
        if flight {
            // The centre of mass flies ballistically: targets are relative to it.
            for k in 0..3 {
                (0..NV).for_each(|i| jacobian[k][i] -= terms.jc[k][i]);
            }
            bias -= terms.com_bias;
            (at, velocity) = (at - terms.com, velocity - terms.com_velocity);
            let c = input.centroidal.com;
            (t.now, t.now_velocity) = (t.now - c.now, t.now_velocity - c.now_velocity);
            (t.next, t.next_velocity) = (t.next - c.next, t.next_velocity - c.next_velocity);
        }
        let demand = law.demand_vector(
            (t.now - at, t.now_velocity),
            (t.next - at, t.next_velocity),
            velocity,
        );
        self.push_rows(&jacobian, demand - bias, qdd, 1.0);
        if let Some(r) = e.rotation {
            let mut jacobian = [[0.0; WIDTH]; 6];
            terms.segment_jacobian(s, &mut jacobian);
            let present = Quat::from_mat3(&terms.segment_rotation(s)).conjugate();
            let demand = law.demand_vector(
                ((r.now * present).log(), r.now_velocity),
                ((r.next * present).log(), r.next_velocity),
                terms.kin.omega[s],
            );
            let (alpha, _) = terms.segment_bias(s);
            self.push_rows(&jacobian[..3], demand - alpha, qdd, ROTATION_LENGTH);
        }
    }

    /// Certainty of the stance, 0…1: client constraints that move the whole body are released as the capture point
    /// nears the edge of the support.
    fn sure(input: &ControlInput<'_>) -> f64 {
        let t = input.terms;
        let rise = (t.com.z.max(0.1) / input.gravity.max(1.0)).sqrt();
        let margin = input.support.margin(t.com + t.com_velocity * rise);
        margin.map_or(0.0, |m| ((m - SURE.0) / (SURE.1 - SURE.0)).clamp(0.0, 1.0))
    }

    /// A client constraint: its demand, blended by its weight with the motion without it.
    fn push_goal(&mut self, input: &ControlInput<'_>, qdd: &JointRow, goal: &ConstraintGoal) {
        let (terms, s) = (input.terms, goal.segment.index());
        let arm = goal.is_on_arm();
        let first = self.led_task.rows().len();
        if goal.position.is_some() {
            let mut jacobian = [[0.0; WIDTH]; 3];
            terms.point_jacobian(s, goal.point, &mut jacobian);
            let wanted = goal.acceleration(terms, &GOAL_PACE) - terms.point_bias(s, goal.point);
            let share = goal.axes.map(|a| a * goal.weight);
            self.push_shares(&jacobian, wanted, qdd, 1.0, share, arm);
        }
        if goal.rotation.is_some() {
            let mut jacobian = [[0.0; WIDTH]; 6];
            terms.segment_jacobian(s, &mut jacobian);
            let (alpha, _) = terms.segment_bias(s);
            let wanted = goal.angular_acceleration(terms, &GOAL_PACE) - alpha;
            let share = [goal.weight; 3];
            self.push_shares(&jacobian[..3], wanted, qdd, ROTATION_LENGTH, share, arm);
        }
        if arm {
            let dofs = goal
                .limb()
                .fold(0, |set, s| set | ((1u64 << DOF_LEN[s]) - 1) << DOF_START[s]);
            self.led_task.only(first, dofs);
        }
    }

    /// Three rows with the desired `J v̇`; rows and change are scaled by `length`.
    fn push_rows(&mut self, jacobian: &[[f64; WIDTH]], wanted: Vec3, qdd: &JointRow, length: f64) {
        self.push_shares(jacobian, wanted, qdd, length, [1.0; 3], false);
    }

    /// The same with a share of the change, for a led limb or for all; a row whose share is zero is left free.
    fn push_shares(
        &mut self,
        jacobian: &[[f64; WIDTH]],
        wanted: Vec3,
        qdd: &JointRow,
        length: f64,
        share: [f64; 3],
        led: bool,
    ) {
        for ((j, want), share) in jacobian.iter().zip(wanted.to_array()).zip(share) {
            let row = self.map.project(j);
            let change = want - dot(&row, qdd) - self.map.project_bias(j); // Eq. 15 with its bias
            let length = if share > 0.0 { length } else { 0.0 };
            let task = if led {
                &mut self.led_task
            } else {
                &mut self.hand_task
            };
            task.push(row.map(|x| x * length), change * length * share);
        }
    }
}
