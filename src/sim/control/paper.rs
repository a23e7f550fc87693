//! The controller of Oshita & Makinouchi 2000, Eqs. (4)–(17): track, stay within strength, keep centre of mass and hands.
//!
//! Two passes (ALGORITHM §9): first with the support at rest; if the zero-moment point of that solution leaves the support polygon, once
//! more with the support free to tip about its edge (S1).

use super::feasible_com::{INSET, feasible};
use super::goals::Pace;
use super::reroot::{SupportMap, only_main, shift};
use super::rows::{ROW, Row, RowQr, cholesky_solve, dot};
use super::spatial_targets::{SpatialLimits, Task, wish};
use super::torque_limits::{Outcome, TorqueLimits, violates};
use super::tracking::{Law, initial_acceleration};
use super::{Command, ControlInput, Controller, Effector, Goal};
use crate::sim::body::topology::{
    DOF_LEN, DOF_START, L_FOOT, L_THIGH, L_TOES, R_FOOT, R_THIGH, R_TOES,
};
use crate::sim::body::{DOF_COUNT, NV, SegmentId};
use crate::sim::dynamics::terms::WIDTH;
use crate::sim::figure::report::MAX_CONTACTS;
use crate::sim::figure::{ControlParams, Flags, Metric, Share};
use crate::sim::math::{Quat, Vec3};
use crate::sim::support::zmp::LEAST_NORMAL_FORCE;
use crate::sim::support::{Pivot, Polygon, Sharing, pivot, unblocked_pivot, zmp};

/// Overload: more members of K and L together than this (0.6 n).
const OVERLOAD_ENTER: u32 = 23;
/// Overload ends below this many members (0.3 n).
const OVERLOAD_LEAVE: u32 = 12;
/// While tilting, only points this close to the pivot line carry load, m.
const PIVOT_REACH: f64 = 0.012;
/// Length that makes rotations of an end-effector comparable with its motion, m.
const ROTATION_LENGTH: f64 = 0.3;
/// Horizon of the ZMP-feasible centre-of-mass law if the joints have none, s: gains 25 and 10.
const COM_HORIZON: f64 = 0.1;
/// A support that turns faster than this is tipping, rad/s (ALGORITHM §6).
const AT_REST: f64 = 1e-3;
/// Part of a pose error of a planted foot that is taken back per step (kinematic loops).
const LOOP_RETURN: f64 = 0.2;
/// How constraints from outside are approached.
const GOAL_PACE: Pace = Pace {
    horizon: 0.05,
    most: 4.0,
    most_trunk: 2.0,
    most_turn: 10.0,
};
/// A capture point nearer to the edge than the first lets go of constraints on the whole body, one farther inside than the second does not, m.
const SURE: (f64, f64) = (0.02, 0.045);
/// Constraints from outside that (12) takes.
const MOST_GOALS: usize = 8;
/// Clamped torques beyond this relative excess are worth a flag.
const CLAMP_NOTICE: f64 = 1e-6;

/// What the support does in a pass.
#[derive(Clone, Copy, Debug)]
enum Mode {
    Rest(SegmentId),
    Tilt(SegmentId, Pivot),
    Flight,
}

/// Which feet the desired motion keeps on the floor. A foot that it lifts carries nothing, or it could never be lifted.
#[derive(Clone, Copy, Debug)]
struct Planned([bool; 2]);

impl Planned {
    /// The plan of a motion; if it would leave no touching point to stand on, everything that touches carries.
    fn new(input: &ControlInput<'_>) -> Self {
        let plan = Self(input.target.next.planted);
        let points = input.support.points();
        if points.iter().any(|p| plan.holds(p.segment)) {
            plan
        } else {
            Self([true; 2])
        }
    }

    /// True if points of this segment may carry load.
    fn holds(self, segment: SegmentId) -> bool {
        match segment {
            L_FOOT | L_TOES => self.0[0],
            R_FOOT | R_TOES => self.0[1],
            _ => true,
        }
    }

    /// The main support: the usual one, but a foot that stays if the usual one is to be lifted.
    fn main(self, input: &ControlInput<'_>) -> Option<SegmentId> {
        let support = input.support;
        let main = support.main()?;
        if self.holds(main) {
            return Some(main);
        }
        let stays = support
            .points()
            .iter()
            .map(|p| p.support)
            .filter(|s| self.holds(*s));
        let ratio = support.ratio();
        let best = stays.reduce(|a, b| {
            if ratio[b.index()] > ratio[a.index()] {
                b
            } else {
                a
            }
        });
        best.or(Some(main))
    }
}

/// The paper's controller with its workspace.
#[derive(Clone, Debug)]
pub struct Paper {
    map: SupportMap,
    sharing: Sharing,
    limits: TorqueLimits,
    spatial: SpatialLimits,
    com_task: Task,
    hand_task: Task,
    led_task: Task,
    polygon: Polygon,
    inset: Polygon,
    held: Box<[Row; 12]>,
    held_count: usize,
    held_qr: RowQr,
    planned: Planned,
    anchors: [Option<(Vec3, Quat)>; 2],
    previous: Option<Row>,
    overload: bool,
    left_out: Option<[bool; MAX_CONTACTS]>,
    command: Command,
}

impl Default for Paper {
    fn default() -> Self {
        Self {
            map: SupportMap::default(),
            sharing: Sharing::default(),
            limits: TorqueLimits::default(),
            spatial: SpatialLimits::default(),
            com_task: Task::default(),
            hand_task: Task::default(),
            led_task: Task::default(),
            polygon: Polygon::with_capacity(MAX_CONTACTS),
            inset: Polygon::with_capacity(2 * MAX_CONTACTS),
            held: Box::new([[0.0; ROW]; 12]),
            held_count: 0,
            held_qr: RowQr::default(),
            planned: Planned([true; 2]),
            anchors: [None; 2],
            previous: None,
            overload: false,
            left_out: None,
            command: Command::default(),
        }
    }
}

/// Result of one pass.
struct Pass {
    qdd: Row,
    tau: Row,
    first: Outcome,
    second: Outcome,
}

impl Paper {
    /// A controller that has seen nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The last decision.
    pub fn command(&self) -> &Command {
        &self.command
    }

    /// Touching points that carry nothing in the last decision, by index; `None` unless it balances several supports.
    pub fn left_out(&self) -> Option<&[bool; MAX_CONTACTS]> {
        self.left_out.as_ref()
    }

    /// The maps of the last pass, for steppers and checks.
    pub fn map(&self) -> &SupportMap {
        &self.map
    }

    /// One pass of (6)–(17) for a given behaviour of the support.
    fn pass(&mut self, input: &ControlInput<'_>, law: &Law, initial: &Row, mode: Mode) -> Pass {
        let (terms, params) = (input.terms, input.params);
        match mode {
            Mode::Rest(s) => {
                let zero = Vec3::zero();
                self.map.set_support(terms, s, (zero, zero));
            }
            Mode::Tilt(s, pivot) => self.map.set_tilting(terms, s, &pivot),
            Mode::Flight => self.map.set_flight(terms),
        }
        let mut initial = *initial;
        self.hold_planted_feet(input, &mut initial, mode);

        self.balance_first(input, law, &mut initial, mode);
        self.share(input, &initial, mode);

        let tau0 = self.map.torque(&initial);
        let held = &self.held[..self.held_count];
        let mut first = self.limits.solve(
            &self.map.h,
            &tau0,
            input.lower,
            input.upper,
            params.metric,
            held,
            OVERLOAD_ENTER as usize,
        );
        let mut second = Outcome {
            complete: true,
            ..Outcome::default()
        };
        let mut qdd = initial;
        if first.complete {
            if first.set != 0 {
                (0..ROW).for_each(|d| qdd[d] += self.limits.change[d]);
            }
            let mut x = self.wish(input, law, &qdd, mode);
            let wishes = [&self.com_task, &self.hand_task, &self.led_task];
            if wishes.iter().any(|t| !t.is_empty()) {
                let tau1 = self.map.torque(&qdd);
                second = self.spatial.solve(
                    &self.map.h,
                    &tau1,
                    input.lower,
                    input.upper,
                    &mut x,
                    params.to_limit,
                    &self.held[..self.held_count],
                    OVERLOAD_ENTER as usize,
                );
                (0..ROW).for_each(|d| qdd[d] += x[d]); // Eq. 17
            }
        }
        let members = first.set.count_ones() + second.set.count_ones();
        let complete = first.complete && second.complete && qdd.iter().all(|a| a.is_finite());
        self.overload = !complete
            || members
                > if self.overload {
                    OVERLOAD_LEAVE - 1
                } else {
                    OVERLOAD_ENTER
                };
        // Motors clip what a tipping figure cannot have: to spread it would bend a body that only falls.
        let clip = match mode {
            Mode::Tilt(..) => {
                !input.kinematic && first.set != 0 && !input.support.polygon().has_area()
            }
            _ => false,
        };
        if self.overload || clip {
            (qdd, first) = self.overloaded(input, law, &initial, &tau0, mode);
            second = Outcome::default();
        }
        Pass {
            qdd,
            tau: self.map.torque(&qdd),
            first,
            second,
        }
    }

    /// True if a support under prescribed accelerations tips already: what it stands on has no area, or it turns.
    fn tilted(input: &ControlInput<'_>, main: SegmentId) -> bool {
        let spin = input.terms.kin.omega[main.index()].norm();
        !input.support.polygon().has_area() || (input.kinematic && spin > AT_REST)
    }

    /// With the ZMP-feasible demand, θ̈_initial gets the centre-of-mass part of (12) before strength is looked at. Without saturation the
    /// result is the same. With it, (7)–(11) would otherwise act on a demand whose zero-moment point may be far outside the foot:
    /// ankle and toes saturate, and the least change spreads over the whole body.
    fn balance_first(
        &mut self,
        input: &ControlInput<'_>,
        law: &Law,
        initial: &mut Row,
        mode: Mode,
    ) {
        let p = input.params;
        if !(p.zmp_feasible && p.track_com && matches!(mode, Mode::Rest(_))) {
            return;
        }
        self.com_task.clear();
        self.hand_task.clear();
        self.push_com(input, law, initial);
        if self.held_count > 0 {
            self.com_task.restrict(&self.held_qr);
        }
        self.led_task.clear();
        let x = wish(&self.com_task, &self.hand_task, &self.led_task, p.priority);
        (0..ROW).for_each(|d| initial[d] += x[d]);
    }

    /// The overload rule (ALGORITHM §8). With motors behind it, the intent of (4) and (12) as it is, to be clipped; for accelerations that
    /// are applied as they are, those of the clipped torques (W = H²) without secondary constraints.
    fn overloaded(
        &mut self,
        input: &ControlInput<'_>,
        law: &Law,
        initial: &Row,
        tau0: &Row,
        mode: Mode,
    ) -> (Row, Outcome) {
        let mut qdd = *initial;
        let mut out = Outcome::default();
        if input.kinematic {
            let (h, n) = (&self.map.h, DOF_COUNT);
            out = self
                .limits
                .solve(h, tau0, input.lower, input.upper, Metric::Torque, &[], n);
            (0..ROW).for_each(|d| qdd[d] += self.limits.change[d]);
        } else {
            let x = self.wish(input, law, initial, mode);
            (0..ROW).for_each(|d| qdd[d] += x[d]);
            let tau = self.map.torque(&qdd);
            for j in 0..DOF_COUNT {
                if violates(
                    tau[j],
                    input.lower[j],
                    input.upper[j],
                    super::torque_limits::TOLERANCE,
                ) {
                    out.set |= 1 << j;
                }
            }
        }
        if !qdd.iter().all(|a| a.is_finite()) {
            qdd = [0.0; ROW];
        }
        (qdd, out)
    }

    /// Lets contacts other than those of S carry their share of the ground reaction (ALGORITHM §5).
    fn share(&mut self, input: &ControlInput<'_>, initial: &Row, mode: Mode) {
        self.left_out = None;
        let (terms, support) = (input.terms, input.support);
        let (main, tilt) = match mode {
            Mode::Rest(s) => (s, None),
            Mode::Tilt(s, p) => (s, Some(p)),
            Mode::Flight => return,
        };
        let points = support.points();
        let planned = self.planned;
        if only_main(points, main) {
            return;
        }
        match input.params.share {
            Share::Balanced => {
                let mut out = [false; MAX_CONTACTS];
                for (o, p) in out.iter_mut().zip(points) {
                    *o = !planned.holds(p.segment)
                        || tilt.is_some_and(|t| t.distance(p.position) >= PIVOT_REACH);
                }
                let (w, root) = (
                    self.map.ground_wrench(initial),
                    terms.state.posture.root_position,
                );
                let total = |about: Vec3| shift(&w, about - root);
                if !self
                    .sharing
                    .set_unilateral(points, support.ratio(), &mut out, total)
                {
                    return;
                }
                self.map.add_sharing(terms, &self.sharing, main);
                self.left_out = Some(out);
            }
            Share::Paper => {
                // The reaction of the last step, at the point of each polygon closest to its zero-moment point.
                let before = self.previous.unwrap_or(*initial);
                let (force, moment) = self.map.ground_wrench_world(terms, &before);
                let Some(z) = zmp(force, moment) else {
                    return;
                };
                for (i, p) in points.iter().enumerate() {
                    let s = p.support;
                    if s == main || !planned.holds(s) || points[..i].iter().any(|q| q.support == s)
                    {
                        continue;
                    }
                    support.support_polygon(s, &mut self.polygon);
                    if let Some(c) = self.polygon.closest([z.x, z.y]) {
                        let at = Vec3::from_array([c.point[0], c.point[1], 0.0]);
                        let f = force * support.ratio()[s.index()];
                        self.map.add_force(terms, s, at, f);
                    }
                }
            }
        }
    }

    /// Kinematic loops (ALGORITHM §5): a second planted foot stays where it was put down. Its leg takes θ̈_initial there, and its rows may
    /// not change afterwards.
    fn hold_planted_feet(&mut self, input: &ControlInput<'_>, initial: &mut Row, mode: Mode) {
        self.held_count = 0;
        self.held_qr.clear();
        let Mode::Rest(main) = mode else {
            return;
        };
        let terms = input.terms;
        for (side, (foot, thigh)) in [(L_FOOT, L_THIGH), (R_FOOT, R_THIGH)]
            .into_iter()
            .enumerate()
        {
            let Some((position, rotation)) = self.anchors[side].filter(|_| foot != main) else {
                continue;
            };
            let s = foot.index();
            let mut jacobian = [[0.0; WIDTH]; 6];
            terms.segment_jacobian(s, &mut jacobian);
            let (alpha, acc) = terms.segment_bias(s);
            let now = Quat::from_mat3(&terms.segment_rotation(s)).conjugate();
            let turn = (rotation * now).log();
            let shift = position - terms.segment_position(s);
            let (w, v) = (terms.kin.omega[s], terms.kin.velocity[s]);
            let dt = input.dt;
            let wanted = [
                (turn * (LOOP_RETURN / dt) - w) * (1.0 / dt) - alpha,
                (shift * (LOOP_RETURN / dt) - v) * (1.0 / dt) - acc,
            ];
            // The seven DOFs of the leg are contiguous: hip, knee, ankle.
            let leg = DOF_START[thigh.index()]..DOF_START[thigh.index()] + 7;
            let (mut g, mut y) = ([[0.0; 6]; 6], [0.0; 6]);
            let rows: [Row; 6] = std::array::from_fn(|i| self.map.project(&jacobian[i]));
            for i in 0..6 {
                let want = wanted[i / 3].to_array()[i % 3] - self.map.project_bias(&jacobian[i]);
                y[i] = want - dot(&rows[i], initial);
                for j in 0..6 {
                    g[i][j] = leg.clone().map(|d| rows[i][d] * rows[j][d]).sum();
                }
                g[i][i] += 1e-8;
            }
            cholesky_solve(&mut g, 6, &mut y);
            for d in leg {
                initial[d] += (0..6).map(|i| rows[i][d] * y[i]).sum::<f64>();
            }
            for r in rows {
                self.held[self.held_count] = r;
                self.held_count += 1;
                self.held_qr.push(&r);
            }
        }
    }

    /// Remembers where planted feet stand; forgets feet that roll, lift, or are meant to lift.
    fn update_anchors(&mut self, input: &ControlInput<'_>) {
        let support = input.support;
        let on_foot = matches!(support.main(), Some(L_FOOT | R_FOOT));
        for (side, foot) in [L_FOOT, R_FOOT].into_iter().enumerate() {
            let touching = support.points().iter().filter(|p| p.support == foot);
            let flat = touching.count() >= 3;
            let keep = input.kinematic && on_foot && flat && input.target.next.planted[side];
            self.anchors[side] = if keep {
                let s = foot.index();
                self.anchors[side].or_else(|| {
                    let r = Quat::from_mat3(&input.terms.segment_rotation(s));
                    Some((input.terms.segment_position(s), r))
                })
            } else {
                None
            };
        }
    }

    /// Rows and wanted changes of centre of mass and end-effectors (14), (15), at joint accelerations `qdd`, and the wish x of (12).
    fn wish(&mut self, input: &ControlInput<'_>, law: &Law, qdd: &Row, mode: Mode) -> Row {
        let (terms, params) = (input.terms, input.params);
        self.com_task.clear();
        self.hand_task.clear();
        self.led_task.clear();
        if params.track_com && matches!(mode, Mode::Rest(_)) {
            self.push_com(input, law, qdd);
        }
        // A tipping figure turns as a whole: hands held at their place in the world would bend it.
        if params.track_hands && !matches!(mode, Mode::Tilt(..)) {
            for e in input.effectors.iter().take(2) {
                self.push_effector(input, law, qdd, e, matches!(mode, Mode::Flight));
            }
        }
        if !matches!(mode, Mode::Tilt(..)) {
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

    fn push_com(&mut self, input: &ControlInput<'_>, law: &Law, qdd: &Row) {
        let (terms, c) = (input.terms, input.com);
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
            self.polygon
                .set_hull(planned.map(|p| [p.position.x, p.position.y]));
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

    fn push_effector(
        &mut self,
        input: &ControlInput<'_>,
        law: &Law,
        qdd: &Row,
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
            // The centre of mass flies by itself: targets are relative to it.
            for k in 0..3 {
                (0..NV).for_each(|i| jacobian[k][i] -= terms.jc[k][i]);
            }
            bias -= terms.com_bias;
            (at, velocity) = (at - terms.com, velocity - terms.com_velocity);
            let c = input.com;
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

    /// How surely it stands, 0…1: what moves the whole body from outside is let go of where the capture point nears the edge of the support.
    fn sure(input: &ControlInput<'_>) -> f64 {
        let t = input.terms;
        let rise = (t.com.z.max(0.1) / input.gravity.max(1.0)).sqrt();
        let margin = input.support.margin(t.com + t.com_velocity * rise);
        margin.map_or(0.0, |m| ((m - SURE.0) / (SURE.1 - SURE.0)).clamp(0.0, 1.0))
    }

    /// A constraint from outside: what it demands, by its weight blended with the motion that there is without it.
    fn push_goal(&mut self, input: &ControlInput<'_>, qdd: &Row, goal: &Goal) {
        let (terms, s) = (input.terms, goal.segment.index());
        let arm = goal.is_on_arm();
        let first = self.led_task.rows().len();
        if goal.position.is_some() {
            let mut jacobian = [[0.0; WIDTH]; 3];
            terms.point_jacobian(s, goal.point, &mut jacobian);
            let wanted = goal.acceleration(terms, &GOAL_PACE) - terms.point_bias(s, goal.point);
            let share = goal.axes.map(|a| a * goal.weight);
            self.push_shares(&jacobian, wanted, qdd, 1.0, (share, arm));
        }
        if goal.rotation.is_some() {
            let mut jacobian = [[0.0; WIDTH]; 6];
            terms.segment_jacobian(s, &mut jacobian);
            let (alpha, _) = terms.segment_bias(s);
            let wanted = goal.angular_acceleration(terms, &GOAL_PACE) - alpha;
            let share = ([goal.weight; 3], arm);
            self.push_shares(&jacobian[..3], wanted, qdd, ROTATION_LENGTH, share);
        }
        if arm {
            let dofs = goal
                .limb()
                .fold(0, |set, s| set | ((1u64 << DOF_LEN[s]) - 1) << DOF_START[s]);
            self.led_task.only(first, dofs);
        }
    }

    /// Three rows with the wanted `J v̇`; rows and wish scaled by `length`.
    fn push_rows(&mut self, jacobian: &[[f64; WIDTH]], wanted: Vec3, qdd: &Row, length: f64) {
        self.push_shares(jacobian, wanted, qdd, length, ([1.0; 3], false));
    }

    /// The same with a share of the change, for a led limb or for all; a row of which nothing counts is left free.
    fn push_shares(
        &mut self,
        jacobian: &[[f64; WIDTH]],
        wanted: Vec3,
        qdd: &Row,
        length: f64,
        (share, led): ([f64; 3], bool),
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

impl Controller for Paper {
    fn control(&mut self, input: &ControlInput<'_>) -> &Command {
        let (terms, support) = (input.terms, input.support);
        let law = Law::new(input.params, input.dt);
        let initial = initial_acceleration(input.body, &terms.state, input.target, &law);
        self.planned = Planned::new(input);
        self.update_anchors(input);
        let mut flags = Flags::default();
        let (mut point, mut margin, mut tips_about) = (None, None, None);

        let mut pass = match self.planned.main(input) {
            None => {
                flags.set(Flags::FLIGHT);
                self.pass(input, &law, &initial, Mode::Flight)
            }
            Some(main) => {
                let first = self.pass(input, &law, &initial, Mode::Rest(main));
                // Decide with the support at rest: when it tips, the zero-moment point lies on the pivot by construction.
                // One that tips already can do nothing for the balance any more: what counts there is where the joints alone, holding
                // their posture, would put it.
                let tilted = Self::tilted(input, main);
                let qdd = if tilted { &initial } else { &first.qdd };
                let (force, moment) = self.map.ground_wrench_world(terms, qdd);
                if force.z <= LEAST_NORMAL_FORCE {
                    flags.set(Flags::FLIGHT);
                    self.pass(input, &law, &initial, Mode::Flight)
                } else {
                    point = zmp(force, moment);
                    margin = point.and_then(|z| support.margin(z));
                    tips_about = point.and_then(|z| {
                        if input.kinematic {
                            let at_rest = (z, force, moment);
                            unblocked_pivot(terms, support.polygon(), main, at_rest, input.dt)
                        } else {
                            pivot(support.polygon(), z)
                        }
                    });
                    match tips_about {
                        Some(p) => {
                            flags.set(Flags::TIPPING);
                            if input.params.tilt {
                                let tilting = self.pass(input, &law, &initial, Mode::Tilt(main, p));
                                let (f, _) = self.map.ground_wrench_world(terms, &tilting.qdd);
                                if input.kinematic && f.z <= LEAST_NORMAL_FORCE {
                                    // The floor cannot pull: the edge leaves it.
                                    flags.set(Flags::FLIGHT);
                                    tips_about = None;
                                    self.pass(input, &law, &initial, Mode::Flight)
                                } else {
                                    tilting
                                }
                            } else {
                                first
                            }
                        }
                        None => first,
                    }
                }
            }
        };
        if self.overload {
            flags.set(Flags::OVERLOAD);
        }
        if pass.first.damped || pass.second.damped {
            flags.set(Flags::DAMPED);
        }
        let mut torque = [0.0; DOF_COUNT];
        for j in 0..DOF_COUNT {
            let (lower, upper) = (input.lower[j], input.upper[j]);
            let tau = pass.tau[j];
            // Within limits by construction; rounding, overload and a damped solution are cut here. (`max` first: NaN becomes a limit.)
            torque[j] = tau.max(lower).min(upper);
            if !self.overload && violates(tau, lower, upper, CLAMP_NOTICE) {
                flags.set(Flags::DAMPED);
            }
        }
        for a in &mut pass.qdd {
            *a = if a.is_finite() { *a } else { 0.0 };
        }
        let mut qdd = [0.0; DOF_COUNT];
        qdd.copy_from_slice(&pass.qdd[..DOF_COUNT]);
        self.previous = Some(pass.qdd);
        self.command = Command {
            joint_acceleration: qdd,
            acceleration: self.map.acceleration(&pass.qdd),
            torque,
            saturated: pass.first.set,
            saturated_secondary: pass.second.set,
            iterations: pass.first.rounds + pass.second.rounds,
            flags,
            zmp: point,
            margin,
            pivot: tips_about,
        };
        &self.command
    }

    fn reset(&mut self) {
        self.anchors = [None; 2];
        self.previous = None;
        self.overload = false;
    }
}

#[cfg(test)]
mod tests {
    use super::super::PointTarget;
    use super::*;
    use crate::sim::body::topology::{L_HAND, R_HAND};
    use crate::sim::body::{Body, State};
    use crate::sim::control::rows::padded;
    use crate::sim::dynamics::Terms;
    use crate::sim::figure::Priority;
    use crate::sim::math::vec3::vec3;
    use crate::sim::motion::{Target, TargetPair};
    use crate::sim::support::Support;
    use crate::sim::support::testing::{
        GRAVITY, Rng, mannequin, on_floor, random_stance, random_state, standing, strength, terms,
    };

    const DT: f64 = 1.0 / 60.0;

    /// One tick's input, owned.
    struct Scene {
        body: Body,
        terms: Terms,
        support: Support,
        target: TargetPair,
        com: PointTarget,
        effectors: Vec<Effector>,
        feet: [(PointTarget, super::super::RotationTarget); 2],
        lower: [f64; DOF_COUNT],
        upper: [f64; DOF_COUNT],
        params: ControlParams,
        kinematic: bool,
    }

    impl Scene {
        /// The figure is in `state` and should stand still in `desired`.
        fn new(state: &State, desired: &State, scale: f64) -> Self {
            let body = mannequin();
            let (t, d) = (terms(&body, state), terms(&body, desired));
            let mut support = Support::default();
            support.update(&t, &body, Vec3::zero(), GRAVITY);
            let still = |p: Vec3| PointTarget {
                now: p,
                next: p,
                ..PointTarget::default()
            };
            let effectors = [L_HAND, R_HAND]
                .map(|segment| Effector {
                    segment,
                    point: vec3(0.0, 0.0, -0.08),
                    position: still(d.point_world(segment.index(), vec3(0.0, 0.0, -0.08))),
                    rotation: None,
                })
                .to_vec();
            let target = Target::still(desired.posture);
            let (lower, upper) = strength(scale);
            Self {
                com: still(d.com),
                body,
                terms: t,
                support,
                target: TargetPair {
                    now: target.clone(),
                    next: target,
                },
                effectors,
                feet: Default::default(),
                lower,
                upper,
                params: ControlParams::default(),
                kinematic: false,
            }
        }
        fn input(&self) -> ControlInput<'_> {
            ControlInput {
                terms: &self.terms,
                body: &self.body,
                support: &self.support,
                target: &self.target,
                com: &self.com,
                effectors: &self.effectors,
                goals: &[],
                feet: &self.feet,
                balance: None,
                lower: &self.lower,
                upper: &self.upper,
                params: &self.params,
                gravity: GRAVITY,
                dt: DT,
                assist: [0.0; 2],
                kinematic: self.kinematic,
            }
        }
        fn bare(mut self) -> Self {
            (self.params.track_com, self.params.track_hands) = (false, false);
            self
        }
    }

    #[test]
    fn without_saturation_and_targets_the_output_is_the_initial_acceleration_to_the_bit() {
        let (body, mut rng) = (mannequin(), Rng::new(41));
        for _ in 0..20 {
            let s = Scene::new(
                &random_stance(&body, &mut rng, 0.05, 0.1),
                &standing(&body),
                1000.0,
            )
            .bare();
            let law = Law::new(&s.params, DT);
            let initial = initial_acceleration(&s.body, &s.terms.state, &s.target, &law);
            let mut paper = Paper::new();
            let c = paper.control(&s.input());
            assert_eq!((c.saturated, c.saturated_secondary), (0, 0));
            assert_eq!(padded(&c.joint_acceleration), initial);
        }
    }

    #[test]
    fn standing_at_rest_holds_still_with_the_weight_on_both_feet() {
        let body = mannequin();
        let state = standing(&body);
        let s = Scene::new(&state, &state, 1.0);
        let mut paper = Paper::new();
        let c = paper.control(&s.input()).clone();
        assert_eq!(c.flags, Flags::default());
        assert!(c.joint_acceleration.iter().all(|a| a.abs() < 1e-6));
        let z = c.zmp.unwrap();
        assert!((z.x - s.terms.com.x).abs() < 1e-6 && (z.y - s.terms.com.y).abs() < 1e-6);
        assert!(c.margin.unwrap() > 0.03 && c.pivot.is_none());
        // Mirror symmetry: knees, hips and ankles of both legs give the same.
        for d in 23..31 {
            assert!((c.torque[d] - c.torque[d + 8]).abs() < 1e-6, "DOF {d}");
        }
        let (f, _) = s.terms.ground_wrench(&c.acceleration);
        assert!((f.z - s.terms.mass * GRAVITY).abs() < 1e-3);
    }

    #[test]
    fn torques_are_within_limits_and_belong_to_the_accelerations() {
        let (body, mut rng) = (mannequin(), Rng::new(42));
        let mut paper = Paper::new();
        let mut seen = [0; 4];
        for round in 0..400 {
            let state = match round % 4 {
                0 => random_stance(&body, &mut rng, 0.3, 1.0),
                1 => random_stance(&body, &mut rng, 0.8, 4.0),
                2 => {
                    let mut s = random_state(&body, &mut rng, 1.0, 5.0);
                    s.posture = on_floor(&body, s.posture);
                    s
                }
                _ => random_state(&body, &mut rng, 2.0, 15.0),
            };
            let desired = random_state(&body, &mut rng, 1.0, 0.0);
            let mut s = Scene::new(
                &state,
                &desired,
                [0.05, 0.3, 1.0, 20.0][rng_index(&mut rng)],
            );
            s.params.metric = [Metric::Identity, Metric::Inertia, Metric::Torque][round % 3];
            s.params.priority = [Priority::Paper, Priority::Nested][round % 2];
            s.params.share = [Share::Balanced, Share::Paper][round / 2 % 2];
            s.params.horizon = [Some(0.1), None][round / 3 % 2];
            s.params.to_limit = round % 5 == 0;
            s.params.tilt = round % 7 != 0;
            s.kinematic = round % 2 == 0;
            if round % 3 == 0 {
                paper.reset();
            }
            let c = paper.control(&s.input()).clone();
            for j in 0..DOF_COUNT {
                assert!(c.torque[j] >= s.lower[j] && c.torque[j] <= s.upper[j]);
                assert!(c.joint_acceleration[j].is_finite());
            }
            assert!(c.acceleration.iter().all(|a| a.is_finite()));
            let qdd = padded(&c.joint_acceleration);
            assert_eq!(paper.map().acceleration(&qdd), c.acceleration);
            if !c.flags.has(Flags::OVERLOAD) && !c.flags.has(Flags::DAMPED) {
                let tau = paper.map().torque(&qdd);
                for j in 0..DOF_COUNT {
                    let scale = tau[j].abs().max(1.0);
                    assert!((tau[j] - c.torque[j]).abs() < 1e-6 * scale, "DOF {j}");
                }
            }
            for (n, f) in [Flags::FLIGHT, Flags::TIPPING, Flags::OVERLOAD]
                .into_iter()
                .enumerate()
            {
                seen[n] += usize::from(c.flags.has(f));
            }
            seen[3] += usize::from(c.saturated != 0 && !c.flags.has(Flags::OVERLOAD));
        }
        assert!(
            seen.iter().all(|n| *n > 10),
            "every regime was met: {seen:?}"
        );
    }
    fn rng_index(rng: &mut Rng) -> usize {
        ((rng.unit() + 1.0) * 2.0) as usize % 4
    }

    #[test]
    fn limits_hold_after_both_stages_for_any_scale_of_the_demand_and_every_metric() {
        let (body, mut rng) = (mannequin(), Rng::new(43));
        let (mut first, mut second) = (TorqueLimits::default(), SpatialLimits::default());
        let mut worst_rounds = 0;
        for round in 0..120 {
            let state = random_stance(&body, &mut rng, 0.5, 2.0);
            let s = Scene::new(&state, &state, 1.0);
            let main = s.support.main().unwrap();
            let mut map = SupportMap::default();
            map.set_support(&s.terms, main, (Vec3::zero(), Vec3::zero()));
            let balanced = round % 2 == 0;
            if balanced {
                let mut sharing = Sharing::default();
                sharing.set_balanced(s.support.points(), s.support.ratio(), &[false; 64]);
                map.add_sharing(&s.terms, &sharing, main);
            }
            for scale in [1.0, 10.0, 100.0, 1000.0] {
                let mut initial = [0.0; ROW];
                (0..DOF_COUNT).for_each(|d| initial[d] = 5.0 * scale * rng.unit());
                let tau0 = map.torque(&initial);
                for metric in [Metric::Identity, Metric::Inertia, Metric::Torque] {
                    let o = first.solve(&map.h, &tau0, &s.lower, &s.upper, metric, &[], DOF_COUNT);
                    assert!(o.complete && o.rounds <= 39);
                    worst_rounds = worst_rounds.max(o.rounds);
                    let mut qdd = initial;
                    (0..ROW).for_each(|d| qdd[d] += first.change[d]);
                    let tau1 = map.torque(&qdd);
                    // At k = 39 with balanced sharing H is not symmetric and may be badly conditioned.
                    let slack = if balanced && o.set.count_ones() >= 36 {
                        1e-4
                    } else {
                        1e-9 * scale.max(3.0)
                    };
                    for j in 0..DOF_COUNT {
                        assert!(
                            !violates(tau1[j], s.lower[j], s.upper[j], slack),
                            "{metric:?} ×{scale} k {} DOF {j}: {} of {}…{}",
                            o.set.count_ones(),
                            tau1[j],
                            s.lower[j],
                            s.upper[j]
                        );
                    }
                    let mut x = [0.0; ROW];
                    (0..DOF_COUNT).for_each(|d| x[d] = scale * rng.unit());
                    let o = second.solve(&map.h, &tau1, &s.lower, &s.upper, &mut x, false, &[], 39);
                    assert!(o.complete && o.rounds <= 39);
                    (0..ROW).for_each(|d| qdd[d] += x[d]);
                    let tau2 = map.torque(&qdd);
                    for j in 0..DOF_COUNT {
                        assert!(!violates(tau2[j], s.lower[j], s.upper[j], 2.0 * slack));
                        if o.set >> j & 1 == 1 {
                            assert!(dot(&map.h[j], &x).abs() < 1e-9 * scale.max(1.0));
                        }
                    }
                }
            }
        }
        assert!(worst_rounds > 2, "{worst_rounds}");
    }

    #[test]
    fn centre_of_mass_gets_its_acceleration_when_nothing_saturates() {
        let (body, mut rng) = (mannequin(), Rng::new(44));
        for _ in 0..20 {
            let state = random_stance(&body, &mut rng, 0.1, 0.2);
            let mut s = Scene::new(&state, &standing(&body), 100.0);
            (s.params.track_hands, s.params.zmp_feasible) = (false, false);
            let mut paper = Paper::new();
            let c = paper.control(&s.input());
            if c.pivot.is_some() {
                continue;
            }
            let wanted = (s.com.now - s.terms.com) * 25.0 - s.terms.com_velocity * 10.0;
            let row = |k: usize| {
                (0..NV)
                    .map(|i| s.terms.jc[k][i] * c.acceleration[i])
                    .sum::<f64>()
            };
            assert!((row(0) + s.terms.com_bias.x - wanted.x).abs() < 1e-4);
            assert!((row(1) + s.terms.com_bias.y - wanted.y).abs() < 1e-4);
        }
    }

    #[test]
    fn hands_get_their_acceleration_under_nested_priority() {
        let (body, mut rng) = (mannequin(), Rng::new(45));
        for _ in 0..20 {
            let state = random_stance(&body, &mut rng, 0.1, 0.2);
            let mut s = Scene::new(&state, &state, 100.0);
            for (k, e) in s.effectors.iter_mut().enumerate() {
                e.position.now += vec3(0.01, 0.02, -0.01);
                if k == 0 {
                    let r = Quat::from_mat3(&s.terms.segment_rotation(e.segment.index()));
                    let goal = Quat::exp(vec3(0.1, 0.0, -0.05)) * r;
                    e.rotation = Some(super::super::RotationTarget {
                        now: goal,
                        next: goal,
                        ..Default::default()
                    });
                }
            }
            let mut paper = Paper::new();
            let c = paper.control(&s.input());
            if c.pivot.is_some() {
                continue;
            }
            for e in &s.effectors {
                let mut j = [[0.0; WIDTH]; 3];
                let i = e.segment.index();
                s.terms.point_jacobian(i, e.point, &mut j);
                let bias = s.terms.point_bias(i, e.point).to_array();
                let wanted = ((e.position.now - s.terms.point_world(i, e.point)) * 25.0
                    - s.terms.point_velocity(i, e.point) * 10.0)
                    .to_array();
                for k in 0..3 {
                    let a = (0..NV).map(|i| j[k][i] * c.acceleration[i]).sum::<f64>() + bias[k];
                    assert!((a - wanted[k]).abs() < 0.02, "{a} {}", wanted[k]);
                }
            }
        }
    }

    #[test]
    fn the_same_input_gives_the_same_bits_and_the_workspace_carries_nothing_over() {
        let (body, mut rng) = (mannequin(), Rng::new(46));
        let mut used = Paper::new();
        for _ in 0..30 {
            let state = random_stance(&body, &mut rng, 0.5, 2.0);
            let s = Scene::new(&state, &standing(&body), 0.5);
            let mut fresh = Paper::new();
            used.reset();
            assert_eq!(used.control(&s.input()), fresh.control(&s.input()));
        }
    }

    #[test]
    fn where_in_the_world_a_figure_stands_does_not_matter() {
        let body = mannequin();
        let state = random_stance(&body, &mut Rng::new(47), 0.2, 0.5);
        let mut far = state;
        far.posture.root_position += vec3(800.0, -300.0, 0.0);
        let mut desired = standing(&body);
        let near = Scene::new(&state, &desired, 0.3);
        desired.posture.root_position += vec3(800.0, -300.0, 0.0);
        let far = Scene::new(&far, &desired, 0.3);
        let a = Paper::new().control(&near.input()).clone();
        let b = Paper::new().control(&far.input()).clone();
        for j in 0..DOF_COUNT {
            assert!((a.torque[j] - b.torque[j]).abs() < 1e-6);
        }
    }

    #[test]
    fn a_leaning_figure_tips_and_a_lifted_one_flies() {
        let body = mannequin();
        let mut state = standing(&body);
        // Lean forward about the ankles until the centre of mass is in front of the toes.
        let mut a = crate::sim::body::angles::anatomical_angles(&state.posture);
        (a[27], a[35]) = (0.6, 0.6);
        crate::sim::body::angles::set_anatomical_angles(&mut state.posture, &a);
        state.posture.root_rotation = Quat::exp(vec3(0.0, 0.5, 0.0));
        state.posture = on_floor(&body, state.posture);
        let s = Scene::new(&state, &state, 20.0).bare();
        let mut paper = Paper::new();
        let c = paper.control(&s.input());
        let p = c.pivot.expect("tips");
        assert!(c.flags.has(Flags::TIPPING) && c.margin.unwrap() < 0.0);
        assert!(p.axes()[0].y.abs() > 0.99 && s.terms.com.x > p.point.x);
        // Forward: the centre of mass accelerates forward and down.
        let row = |k: usize| {
            (0..NV)
                .map(|i| s.terms.jc[k][i] * c.acceleration[i])
                .sum::<f64>()
        };
        assert!(row(0) > 0.0 && row(2) < 0.0);

        let mut state = standing(&body);
        state.posture.root_position.z += 1.0;
        let s = Scene::new(&state, &state, 1.0);
        let c = paper.control(&s.input());
        assert!(c.flags.has(Flags::FLIGHT) && c.zmp.is_none() && c.margin.is_none());
        let (f, n) = s.terms.ground_wrench(&c.acceleration);
        assert!(f.norm() < 1e-6 && n.norm() < 1e-6);
    }

    #[test]
    fn a_second_planted_foot_stays_put_in_kinematic_stepping() {
        let (body, mut rng) = (mannequin(), Rng::new(48));
        for _ in 0..10 {
            let state = random_stance(&body, &mut rng, 0.1, 0.3);
            let desired = random_stance(&body, &mut rng, 0.1, 0.0);
            let mut s = Scene::new(&state, &desired, 1.0);
            s.kinematic = true;
            let mut paper = Paper::new();
            let c = paper.control(&s.input()).clone();
            if c.pivot.is_some() || c.flags.has(Flags::OVERLOAD) {
                continue;
            }
            for foot in [L_FOOT, R_FOOT] {
                let mut j = [[0.0; WIDTH]; 6];
                s.terms.segment_jacobian(foot.index(), &mut j);
                let (alpha, acc) = s.terms.segment_bias(foot.index());
                let bias = [alpha.x, alpha.y, alpha.z, acc.x, acc.y, acc.z];
                for k in 0..6 {
                    let v: f64 = (0..NV).map(|i| j[k][i] * s.terms.state.velocity[i]).sum();
                    let a = (0..NV).map(|i| j[k][i] * c.acceleration[i]).sum::<f64>() + bias[k];
                    assert!((a + v / DT).abs() < 1e-3, "{foot:?} row {k}: {a}");
                }
            }
        }
    }
}
