//! The controller of Oshita & Makinouchi 2000, Eqs. (4)–(17): tracks the motion, stays within strength, and controls
//! the centre of mass and the hands.
//!
//! Two passes (`docs/tick.md`, stage 5): first with the support at rest; if the zero-moment point of that solution
//! leaves the support polygon, once more with the support free to tip about its edge (S1).
//!
//! [`Paper::decide`] chooses the pass that counts; [`Paper::pass`] is the list of equations. The rest is in `supports`
//! (which feet carry, and how they share), in `targets` (centre of mass, hands and other points), and in the siblings
//! of this module for (4), (7)–(11) and (16).

mod planned;
mod supports;
mod targets;

use crate::body::{DOF_COUNT, SegmentId};
use crate::control::rows::{JointRow, ROW, RowQr};
use crate::control::tracking::{Law, initial_acceleration};
use crate::control::{Command, ControlInput, Controller};
use crate::math::{Quat, Vec3};
use crate::paper::reroot::SupportMap;
use crate::paper::spatial_targets::{SpatialLimits, Task, wish};
use crate::paper::torque_limits::{JointTorques, LimitOutcome, TOLERANCE, TorqueLimits, violates};
use crate::report::Flags;
use crate::report::MAX_CONTACTS;
use crate::setup::Metric;
use crate::support::zmp::LEAST_NORMAL_FORCE;
use crate::support::{
    Pivot, Polygon, Sharing, is_stopped, pivot, tipping_acceleration, unblocked_pivot, zmp,
};
use crate::touch::MAX_TOUCHES;
use planned::Planned;
use serde::{Deserialize, Serialize};

/// Overload begins when K and L together have more members than this (0.6 n).
const OVERLOAD_ENTER: u32 = 23;
/// Overload ends below this number of members (0.3 n).
const OVERLOAD_LEAVE: u32 = 12;
/// A support that turns faster than this is tipping, rad/s (`docs/equations.md#repairs`).
const AT_REST: f64 = 1e-3;
/// Clamped torques beyond this relative excess are worth a flag.
const CLAMP_NOTICE: f64 = 1e-6;

/// The behaviour of the support in a pass.
#[derive(Clone, Copy, Debug)]
enum SupportMotion {
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
    led_task: Task,
    polygon: Polygon,
    inset: Polygon,
    held: Box<[JointRow; 12]>,
    held_count: usize,
    held_qr: RowQr,
    planned: Planned,
    memory: PaperMemory,
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
            polygon: Polygon::with_capacity(MAX_CONTACTS + MAX_TOUCHES),
            inset: Polygon::with_capacity(2 * (MAX_CONTACTS + MAX_TOUCHES)),
            held: Box::new([[0.0; ROW]; 12]),
            held_count: 0,
            held_qr: RowQr::default(),
            planned: Planned([true; 2]),
            memory: PaperMemory::default(),
            left_out: None,
            command: Command::default(),
        }
    }
}

/// Result of one pass.
struct Pass {
    qdd: JointRow,
    tau: JointRow,
    first: LimitOutcome,
    second: LimitOutcome,
}

/// The figure's stance according to the pass with its support at rest.
#[derive(Default)]
struct Stand {
    flags: Flags,
    zmp: Option<Vec3>,
    /// Distance of the zero-moment point from the edge of the support, m.
    margin: Option<f64>,
    /// The pivot of its tipping.
    pivot: Option<Pivot>,
}

/// The memory of [`Paper`] from tick to tick.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct PaperMemory {
    anchors: [Option<(Vec3, Quat)>; 2],
    previous: Option<Previous>,
    overload: bool,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
struct Previous(#[serde(with = "crate::saved::array")] JointRow);

impl PaperMemory {
    /// Forgets the last tick.
    pub fn reset(&mut self) {
        *self = Self::default();
    }
}

impl Paper {
    /// Exchanges its memory for `memory`: that of a figure when its tick begins, and the same back when it ends.
    pub fn swap_memory(&mut self, memory: &mut PaperMemory) {
        std::mem::swap(&mut self.memory, memory);
    }

    /// A controller without a memory.
    pub fn new() -> Self {
        Self::default()
    }

    /// The maps of the last pass, for steppers and checks.
    pub fn map(&self) -> &SupportMap {
        &self.map
    }

    /// The pass that counts: with the support at rest, tipping, or in flight, depending on the zero-moment point of the
    /// first one.
    fn decide(&mut self, input: &ControlInput<'_>, law: &Law, initial: &JointRow) -> (Pass, Stand) {
        let (terms, support) = (input.terms, input.support);
        let mut stand = Stand::default();
        let Some(main) = self.planned.main(input) else {
            stand.flags.set(Flags::FLIGHT);
            return (self.pass(input, law, initial, SupportMotion::Flight), stand);
        };
        let first = self.pass(input, law, initial, SupportMotion::Rest(main));
        // Decided with the support at rest, because when it tips, the zero-moment point lies on the pivot by
        // construction. A figure that tips already can do nothing more for its balance: its test is the zero-moment
        // point for joints that only hold their posture.
        let tilted = Self::tilted(input, main);
        let qdd = if tilted { initial } else { &first.qdd };
        let (force, moment) = self.map.ground_wrench_world(terms, qdd);
        if force.z <= LEAST_NORMAL_FORCE {
            stand.flags.set(Flags::FLIGHT);
            return (self.pass(input, law, initial, SupportMotion::Flight), stand);
        }
        stand.zmp = zmp(force, moment);
        stand.margin = stand.zmp.and_then(|z| support.margin(z));
        stand.pivot = stand.zmp.and_then(|z| {
            if input.kinematic {
                let at_rest = (z, force, moment);
                unblocked_pivot(terms, support.polygon(), main, at_rest, input.dt)
            } else {
                pivot(support.polygon(), z)
            }
        });
        let stopped = |p: &Pivot| {
            let spin = terms.kin.omega[main.index()]
                + tipping_acceleration(terms, p, force, moment) * input.dt;
            is_stopped(p, spin, support.rests().iter())
        };
        stand.pivot = stand.pivot.filter(|p| !stopped(p));
        let Some(p) = stand.pivot else {
            return (first, stand);
        };
        stand.flags.set(Flags::TIPPING);
        if !input.params.tilt {
            return (first, stand);
        }
        let tilting = self.pass(input, law, initial, SupportMotion::Tilt(main, p));
        let (f, _) = self.map.ground_wrench_world(terms, &tilting.qdd);
        if input.kinematic && f.z <= LEAST_NORMAL_FORCE {
            // The floor cannot pull, so the edge leaves it.
            stand.flags.set(Flags::FLIGHT);
            stand.pivot = None;
            return (self.pass(input, law, initial, SupportMotion::Flight), stand);
        }
        (tilting, stand)
    }

    /// One pass of (6)–(17) for a given behaviour of the support.
    fn pass(
        &mut self,
        input: &ControlInput<'_>,
        law: &Law,
        initial: &JointRow,
        mode: SupportMotion,
    ) -> Pass {
        let (terms, params) = (input.terms, input.params);
        match mode {
            SupportMotion::Rest(s) => {
                let zero = Vec3::zero();
                self.map.set_support(terms, s, zero, zero);
            }
            SupportMotion::Tilt(s, pivot) => self.map.set_tilting(terms, s, &pivot),
            SupportMotion::Flight => self.map.set_flight(terms),
        }
        let mut initial = *initial;
        self.hold_planted_feet(input, &mut initial, mode);

        self.balance_first(input, law, &mut initial, mode);
        self.share(input, &initial, mode);

        let tau0 = self.map.torque(&initial);
        let held = &self.held[..self.held_count];
        let torques = JointTorques {
            h: &self.map.h,
            tau: &tau0,
            lower: input.lower,
            upper: input.upper,
        };
        let most = OVERLOAD_ENTER as usize;
        let mut first = self.limits.solve(torques, params.metric, held, most);
        let mut second = LimitOutcome {
            complete: true,
            ..LimitOutcome::default()
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
                let torques = JointTorques {
                    h: &self.map.h,
                    tau: &tau1,
                    lower: input.lower,
                    upper: input.upper,
                };
                let held = &self.held[..self.held_count];
                second = (self.spatial).solve(torques, &mut x, params.to_limit, held, most);
                (0..ROW).for_each(|d| qdd[d] += x[d]); // Eq. 17
            }
        }
        let members = first.set.count_ones() + second.set.count_ones();
        let complete = first.complete && second.complete && qdd.iter().all(|a| a.is_finite());
        self.memory.overload = !complete
            || members
                > if self.memory.overload {
                    OVERLOAD_LEAVE - 1
                } else {
                    OVERLOAD_ENTER
                };
        // Motors clip torques that a tipping figure cannot have: spreading the excess would bend a body that only
        // falls.
        let clip = match mode {
            SupportMotion::Tilt(..) => {
                !input.kinematic && first.set != 0 && !input.support.polygon().has_area()
            }
            _ => false,
        };
        if self.memory.overload || clip {
            (qdd, first) = self.overloaded(input, law, &initial, &tau0, mode);
            second = LimitOutcome::default();
        }
        Pass {
            qdd,
            tau: self.map.torque(&qdd),
            first,
            second,
        }
    }

    /// Whether a support under prescribed accelerations tips already: its contact has no area, or it turns.
    fn tilted(input: &ControlInput<'_>, main: SegmentId) -> bool {
        let spin = input.terms.kin.omega[main.index()].norm();
        !input.support.polygon().has_area() || (input.kinematic && spin > AT_REST)
    }

    /// With the ZMP-feasible demand, θ̈_initial gets the centre-of-mass part of (12) before strength is considered.
    /// Without saturation the result is the same. With saturation, (7)–(11) would otherwise act on a demand whose
    /// zero-moment point may be far outside the foot: ankle and toes saturate, and the least change spreads over the
    /// whole body.
    fn balance_first(
        &mut self,
        input: &ControlInput<'_>,
        law: &Law,
        initial: &mut JointRow,
        mode: SupportMotion,
    ) {
        let p = input.params;
        if !(p.zmp_feasible && p.track_com && matches!(mode, SupportMotion::Rest(_))) {
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

    /// The overload rule (`docs/equations.md#repairs`). With motors behind it, it returns the intent of (4) and (12)
    /// unchanged, to be clipped; for accelerations that are applied as they are, those of the clipped torques (W = H²)
    /// without secondary constraints.
    fn overloaded(
        &mut self,
        input: &ControlInput<'_>,
        law: &Law,
        initial: &JointRow,
        tau0: &JointRow,
        mode: SupportMotion,
    ) -> (JointRow, LimitOutcome) {
        let mut qdd = *initial;
        let mut out = LimitOutcome::default();
        if input.kinematic {
            let torques = JointTorques {
                h: &self.map.h,
                tau: tau0,
                lower: input.lower,
                upper: input.upper,
            };
            out = (self.limits).solve(torques, Metric::Torque, &[], DOF_COUNT);
            (0..ROW).for_each(|d| qdd[d] += self.limits.change[d]);
        } else {
            let x = self.wish(input, law, initial, mode);
            (0..ROW).for_each(|d| qdd[d] += x[d]);
            let tau = self.map.torque(&qdd);
            for j in 0..DOF_COUNT {
                if violates(tau[j], input.lower[j], input.upper[j], TOLERANCE) {
                    out.set |= 1 << j;
                }
            }
        }
        if !qdd.iter().all(|a| a.is_finite()) {
            qdd = [0.0; ROW];
        }
        (qdd, out)
    }
}

impl Controller for Paper {
    fn control(&mut self, input: &ControlInput<'_>) -> &Command {
        let law = Law::new(input.params, input.dt);
        let state = &input.terms.state;
        let initial = initial_acceleration(input.body, state, input.target, &law);
        self.planned = Planned::new(input);
        self.update_anchors(input);
        let (mut pass, stand) = self.decide(input, &law, &initial);
        let mut flags = stand.flags;
        if self.memory.overload {
            flags.set(Flags::OVERLOAD);
        }
        if pass.first.damped || pass.second.damped {
            flags.set(Flags::DAMPED);
        }
        let mut torque = [0.0; DOF_COUNT];
        for j in 0..DOF_COUNT {
            let (lower, upper) = (input.lower[j], input.upper[j]);
            let tau = pass.tau[j];
            // Within limits by construction; rounding, overload and a damped solution are cut here. (`max` first: NaN
            // becomes a limit.)
            torque[j] = tau.max(lower).min(upper);
            if !self.memory.overload && violates(tau, lower, upper, CLAMP_NOTICE) {
                flags.set(Flags::DAMPED);
            }
        }
        for a in &mut pass.qdd {
            *a = if a.is_finite() { *a } else { 0.0 };
        }
        let mut qdd = [0.0; DOF_COUNT];
        qdd.copy_from_slice(&pass.qdd[..DOF_COUNT]);
        self.memory.previous = Some(Previous(pass.qdd));
        self.command = Command {
            joint_acceleration: qdd,
            acceleration: self.map.acceleration(&pass.qdd),
            torque,
            saturated: pass.first.set,
            saturated_secondary: pass.second.set,
            iterations: pass.first.rounds + pass.second.rounds,
            flags,
            zmp: stand.zmp,
            margin: stand.margin,
            pivot: stand.pivot,
            wrench: [Vec3::zero(); 2],
        };
        &self.command
    }

    fn command(&self) -> &Command {
        &self.command
    }

    /// Touching points that carry nothing in the last decision, by index; `None` unless the controller balances several
    /// supports.
    fn left_out(&self) -> Option<&[bool; MAX_CONTACTS]> {
        self.left_out.as_ref()
    }

    fn reset(&mut self) {
        self.memory.reset();
    }
}

#[cfg(test)]
mod tests;
