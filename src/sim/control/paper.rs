//! The controller of Oshita & Makinouchi 2000, Eqs. (4)–(17): track, stay within strength, keep centre of mass and hands.
//!
//! Two passes (ALGORITHM §9): first with the support at rest; if the zero-moment point of that solution leaves the support polygon, once
//! more with the support free to tip about its edge (S1).

use super::feasible_com::{INSET, feasible};
use super::reroot::{SupportMap, only_main, shift};
use super::rows::{ROW, Row, RowQr, cholesky_solve, dot};
use super::spatial_targets::{SpatialLimits, Task, wish};
use super::torque_limits::{Outcome, TorqueLimits, violates};
use super::tracking::{Law, initial_acceleration};
use super::{Command, ControlInput, Controller, Effector};
use crate::sim::body::topology::{DOF_START, L_FOOT, L_THIGH, R_FOOT, R_THIGH};
use crate::sim::body::{DOF_COUNT, NV, SegmentId};
use crate::sim::dynamics::terms::WIDTH;
use crate::sim::figure::report::MAX_CONTACTS;
use crate::sim::figure::{ControlParams, Flags, Metric, Share};
use crate::sim::math::{Quat, Vec3};
use crate::sim::support::zmp::LEAST_NORMAL_FORCE;
use crate::sim::support::{Pivot, Polygon, Sharing, pivot, zmp};

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
/// Part of a pose error of a planted foot that is taken back per step (kinematic loops).
const LOOP_RETURN: f64 = 0.2;
/// Clamped torques beyond this relative excess are worth a flag.
const CLAMP_NOTICE: f64 = 1e-6;

/// What the support does in a pass.
#[derive(Clone, Copy, Debug)]
enum Mode {
    Rest(SegmentId),
    Tilt(SegmentId, Pivot),
    Flight,
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
    polygon: Polygon,
    inset: Polygon,
    held: Box<[Row; 12]>,
    held_count: usize,
    held_qr: RowQr,
    anchors: [Option<(Vec3, Quat)>; 2],
    previous: Option<Row>,
    overload: bool,
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
            polygon: Polygon::with_capacity(MAX_CONTACTS),
            inset: Polygon::with_capacity(2 * MAX_CONTACTS),
            held: Box::new([[0.0; ROW]; 12]),
            held_count: 0,
            held_qr: RowQr::default(),
            anchors: [None; 2],
            previous: None,
            overload: false,
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
        self.share(input, initial, mode);
        let mut initial = *initial;
        self.hold_planted_feet(input, &mut initial, mode);

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
            if !(self.com_task.is_empty() && self.hand_task.is_empty()) {
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
        if self.overload {
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
        let (terms, support) = (input.terms, input.support);
        let (main, tilt) = match mode {
            Mode::Rest(s) => (s, None),
            Mode::Tilt(s, p) => (s, Some(p)),
            Mode::Flight => return,
        };
        let points = support.points();
        if only_main(points, main) {
            return;
        }
        match input.params.share {
            Share::Balanced => {
                let mut dropped = 0u32;
                loop {
                    let any = self.sharing.set_balanced(points, support.ratio(), |p| {
                        dropped >> p.support.index() & 1 == 0
                            && tilt.is_none_or(|t| t.distance(p.position) < PIVOT_REACH)
                    });
                    if !any {
                        return;
                    }
                    // A support that would have to pull carries nothing.
                    let r = self.sharing.reference - terms.state.posture.root_position;
                    let w = shift(&self.map.ground_wrench(initial), r);
                    match self.sharing.pulling_support(points, &w) {
                        Some(s) => dropped |= 1 << s.index(),
                        None => break,
                    }
                }
                self.map.add_sharing(terms, &self.sharing, main);
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
                    if s == main || points[..i].iter().any(|q| q.support == s) {
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
        if params.track_com && matches!(mode, Mode::Rest(_)) {
            self.push_com(input, law, qdd);
        }
        if params.track_hands {
            for e in input.effectors.iter().take(2) {
                self.push_effector(input, law, qdd, e, matches!(mode, Mode::Flight));
            }
        }
        if self.held_count > 0 {
            self.com_task.restrict(&self.held_qr);
            self.hand_task.restrict(&self.held_qr);
        }
        debug_assert!(terms.mass > 0.0);
        wish(&self.com_task, &self.hand_task, params.priority)
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
            self.inset.set_inset(input.support.polygon(), INSET);
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
            bias = bias - terms.com_bias;
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

    /// Three rows with the wanted `J v̇`; rows and wish scaled by `length`.
    fn push_rows(&mut self, jacobian: &[[f64; WIDTH]], wanted: Vec3, qdd: &Row, length: f64) {
        for (j, want) in jacobian.iter().zip(wanted.to_array()) {
            let row = self.map.project(j);
            let change = want - dot(&row, qdd) - self.map.project_bias(j); // Eq. 15 with its bias
            self.hand_task
                .push(row.map(|x| x * length), change * length);
        }
    }
}

impl Controller for Paper {
    fn control(&mut self, input: &ControlInput<'_>) -> &Command {
        let (terms, support) = (input.terms, input.support);
        let law = Law::new(input.params, input.dt);
        let initial = initial_acceleration(input.body, &terms.state, input.target, &law);
        self.update_anchors(input);
        let mut flags = Flags::default();
        let (mut point, mut margin, mut tips_about) = (None, None, None);

        let mut pass = match support.main() {
            None => {
                flags.set(Flags::FLIGHT);
                self.pass(input, &law, &initial, Mode::Flight)
            }
            Some(main) => {
                let first = self.pass(input, &law, &initial, Mode::Rest(main));
                // Decide with the support at rest: when it tips, the zero-moment point lies on the pivot by construction.
                let (force, moment) = self.map.ground_wrench_world(terms, &first.qdd);
                if force.z <= LEAST_NORMAL_FORCE {
                    flags.set(Flags::FLIGHT);
                    self.pass(input, &law, &initial, Mode::Flight)
                } else {
                    point = zmp(force, moment);
                    margin = point.and_then(|z| support.margin(z));
                    tips_about = point.and_then(|z| pivot(support.polygon(), z));
                    match tips_about {
                        Some(p) => {
                            flags.set(Flags::TIPPING);
                            if input.params.tilt {
                                self.pass(input, &law, &initial, Mode::Tilt(main, p))
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
