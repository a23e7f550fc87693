//! Primary constraint: available torque, Eqs. (7)–(11), by an active set that only grows
//! (`docs/equations.md#the-paper`).

use crate::body::DOF_COUNT;
use crate::control::rows::{JointRow, ROW, RowQr, Square, dot};
use crate::math::dense::eliminate;
use crate::setup::Metric;

/// A torque may exceed its limit by this share of it (or of 1 N·m) before it counts as a violation.
pub const TOLERANCE: f64 = 1e-9;

/// Whether `torque` is outside `lower…upper` by more than `slack` times the limit (at least 1 N·m).
#[inline(always)]
pub(crate) fn violates(torque: f64, lower: f64, upper: f64, slack: f64) -> bool {
    // Written so that NaN counts as a violation.
    !(torque <= upper + slack * upper.abs().max(1.0)
        && torque >= lower - slack * lower.abs().max(1.0))
}

/// Torques `τ + H Δ` of the joints under a change Δ of their accelerations, and the torques available to the joints.
#[derive(Clone, Copy, Debug)]
pub struct JointTorques<'a> {
    /// H, rad/s² → N·m.
    pub h: &'a Square,
    /// τ: torques without a change, N·m.
    pub tau: &'a JointRow,
    /// Least available torques, N·m.
    pub lower: &'a [f64; DOF_COUNT],
    /// Largest available torques, N·m.
    pub upper: &'a [f64; DOF_COUNT],
}

impl JointTorques<'_> {
    /// Torque of joint `j` after the change.
    #[inline(always)]
    pub(crate) fn changed(&self, j: usize, change: &JointRow) -> f64 {
        self.tau[j] + dot(&self.h[j], change)
    }
    /// Whether `torque` of joint `j` is outside its limits by more than `slack` times the limit.
    #[inline(always)]
    pub(crate) fn violates(&self, j: usize, torque: f64, slack: f64) -> bool {
        violates(torque, self.lower[j], self.upper[j], slack)
    }
    /// The limit that `torque` of joint `j` violates.
    #[inline(always)]
    pub(crate) fn violated(&self, j: usize, torque: f64) -> f64 {
        if torque > self.upper[j] {
            self.upper[j]
        } else {
            self.lower[j]
        }
    }
}

/// The result of an active set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LimitOutcome {
    /// Members of the set (bit = DOF).
    pub set: u64,
    /// Rounds taken.
    pub rounds: u32,
    /// Rows were nearly dependent and the solution was damped.
    pub damped: bool,
    /// Whether the set was completed, not abandoned because it outgrew the allowed size or numbers became infinite.
    pub complete: bool,
}

/// Active set of (7)–(11); keeps its buffers.
#[derive(Clone, Debug)]
pub struct TorqueLimits {
    qr: RowQr,
    system: Box<Square>,
    order: [usize; DOF_COUNT],
    goal: [f64; 2 * ROW],
    /// Δθ̈₁ of the last call.
    pub change: JointRow,
}

impl Default for TorqueLimits {
    fn default() -> Self {
        Self {
            qr: RowQr::default(),
            system: Box::new([[0.0; ROW]; DOF_COUNT]),
            order: [0; DOF_COUNT],
            goal: [0.0; 2 * ROW],
            change: [0.0; ROW],
        }
    }
}

impl TorqueLimits {
    /// Least change Δθ̈₁ (in the chosen norm) that brings `τ₀ + H Δθ̈₁` within the limits, written to [`Self::change`].
    ///
    /// τ = τ₀ + HΔ; K = K ∪ {violators}; H_K Δ = τ_lim,K − τ₀,K; Δ = H_K⁺(…) — Oshita & Makinouchi 2000, Eqs. 7–11
    ///
    /// * `torques`: τ₀ of the initial accelerations, H, and the limits.
    /// * `held`: rows that must not change (kinematic loops); respected by [`Metric::Identity`] while there is room for
    ///   them.
    /// * `most`: larger sets are abandoned (`complete` = false).
    ///
    /// K only grows, hence at most 39 rounds. No allocation.
    ///
    /// Equations (7)–(11) of the paper.
    ///
    /// Repair S4.
    #[inline(always)]
    pub fn solve(
        &mut self,
        torques: JointTorques<'_>,
        metric: Metric,
        held: &[JointRow],
        most: usize,
    ) -> LimitOutcome {
        self.change = [0.0; ROW];
        let mut out = LimitOutcome::default();
        if metric == Metric::Torque {
            return self.clip(torques);
        }
        let JointTorques { h, tau: tau0, .. } = torques;
        self.qr.clear();
        let (mut k, mut fixed) = (0, 0);
        loop {
            let first = k;
            for j in 0..DOF_COUNT {
                let tau = torques.changed(j, &self.change);
                if out.set >> j & 1 == 0 && torques.violates(j, tau, TOLERANCE) {
                    out.set |= 1 << j;
                    self.order[k] = j;
                    // The limit that is violated now, including for joints that enter late.
                    self.goal[k] = torques.violated(j, tau) - tau0[j];
                    k += 1;
                }
            }
            if k == first {
                out.complete = self.change.iter().all(|x| x.is_finite());
                return out;
            }
            out.rounds += 1;
            if k > most || !self.goal[..k].iter().all(|t| t.is_finite()) {
                return out;
            }
            match metric {
                Metric::Inertia => out.damped |= !self.solve_members(h, k),
                _ => {
                    fixed = self.qr.grow(h, &self.order[..k], first, held, fixed);
                    self.least_norm(h, k, fixed);
                    out.damped |= self.qr.is_dependent();
                }
            }
        }
    }

    /// W = I: Δ = H_K⁺ t by QR, refined once.
    #[inline(always)]
    fn least_norm(&mut self, h: &Square, k: usize, fixed: usize) {
        let mut t = [0.0; 2 * ROW];
        t[fixed..fixed + k].copy_from_slice(&self.goal[..k]);
        self.qr.solve(&t[..fixed + k], &mut self.change);
        for i in 0..k {
            t[fixed + i] = self.goal[i] - dot(&h[self.order[i]], &self.change);
        }
        let mut correction = [0.0; ROW];
        self.qr.solve(&t[..fixed + k], &mut correction);
        for d in 0..ROW {
            self.change[d] += correction[d];
        }
    }

    /// W = H: only the members accelerate differently, H_KK Δ_K = t, refined once. Returns `false` if singular (then
    /// least norm is used).
    #[inline(always)]
    fn solve_members(&mut self, h: &Square, k: usize) -> bool {
        self.change = [0.0; ROW];
        for _ in 0..2 {
            let mut b = [0.0; ROW];
            for i in 0..k {
                b[i] = self.goal[i] - dot(&h[self.order[i]], &self.change);
                for j in 0..k {
                    self.system[i][j] = h[self.order[i]][self.order[j]];
                }
                self.system[i][k..].fill(0.0);
            }
            if !eliminate(&mut self.system[..], k, &mut b) {
                self.qr.clear();
                (0..k).for_each(|i| self.qr.push(&h[self.order[i]]));
                self.least_norm(h, k, 0);
                return false;
            }
            for i in 0..k {
                self.change[self.order[i]] += b[i];
            }
        }
        true
    }

    /// W = H²: only the saturated torques change, HΔ = clip(τ₀) − τ₀. No iteration.
    #[inline(always)]
    fn clip(&mut self, torques: JointTorques<'_>) -> LimitOutcome {
        let JointTorques {
            h,
            tau: tau0,
            lower,
            upper,
        } = torques;
        let mut out = LimitOutcome::default();
        let mut excess = [0.0; ROW];
        for j in 0..DOF_COUNT {
            if torques.violates(j, tau0[j], TOLERANCE) {
                out.set |= 1 << j;
                excess[j] = tau0[j].max(lower[j]).min(upper[j]) - tau0[j];
            }
        }
        if out.set != 0 {
            out.rounds = 1;
            for _ in 0..2 {
                *self.system = *h;
                let mut b = [0.0; ROW];
                for j in 0..DOF_COUNT {
                    b[j] = excess[j] - dot(&h[j], &self.change);
                }
                if !eliminate(&mut self.system[..], DOF_COUNT, &mut b) {
                    out.damped = true;
                    break;
                }
                for d in 0..DOF_COUNT {
                    self.change[d] += b[d];
                }
            }
        }
        out.complete = self.change.iter().all(|x| x.is_finite());
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOWER: [f64; DOF_COUNT] = [-4.0; DOF_COUNT];
    const UPPER: [f64; DOF_COUNT] = [4.0; DOF_COUNT];

    fn limited<'a>(h: &'a Square, tau: &'a JointRow) -> JointTorques<'a> {
        JointTorques {
            h,
            tau,
            lower: &LOWER,
            upper: &UPPER,
        }
    }

    /// An example with two limits in the first two DOFs; the others are unit inertias without torque.
    fn example(metric: Metric) -> (JointRow, JointRow, LimitOutcome) {
        let mut h = Box::new([[0.0; ROW]; DOF_COUNT]);
        (0..DOF_COUNT).for_each(|j| h[j][j] = 1.0);
        (h[0][0], h[0][1], h[1][0], h[1][1]) = (2.0, 1.0, 1.0, 3.0);
        let mut tau0 = [0.0; ROW];
        (tau0[0], tau0[1]) = (5.0, 1.0);
        let mut t = TorqueLimits::default();
        let out = t.solve(limited(&h, &tau0), metric, &[], 39);
        let mut dtau = [0.0; ROW];
        (0..DOF_COUNT).for_each(|j| dtau[j] = dot(&h[j], &t.change));
        (t.change, dtau, out)
    }

    /// Equations (7)–(11) of the paper.
    ///
    /// Repair S4.
    #[test]
    fn two_joint_example_in_three_metrics() {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-14;
        let (d, _, o) = example(Metric::Identity);
        assert!(near(d[0], -0.4) && near(d[1], -0.2) && o.set == 1 && o.rounds == 1 && o.complete);
        let (d, _, o) = example(Metric::Inertia);
        assert!(near(d[0], -0.5) && near(d[1], 0.0) && o.set == 1);
        let (_, tau, o) = example(Metric::Torque);
        assert!(near(tau[0], -1.0) && near(tau[1], 0.0) && o.set == 1);
    }

    /// Equations (7)–(11) of the paper.
    #[test]
    fn sets_beyond_the_bound_and_infinite_demands_are_given_up() {
        let mut h = Box::new([[0.0; ROW]; DOF_COUNT]);
        (0..DOF_COUNT).for_each(|j| h[j][j] = 1.0);
        let mut t = TorqueLimits::default();
        let o = t.solve(limited(&h, &[9.0; ROW]), Metric::Identity, &[], 20);
        assert!(!o.complete);
        let o = t.solve(limited(&h, &[9.0; ROW]), Metric::Identity, &[], 39);
        assert!(o.complete && o.set.count_ones() == 39);
        let mut tau0 = [0.0; ROW];
        tau0[3] = f64::NAN;
        for metric in [Metric::Identity, Metric::Inertia, Metric::Torque] {
            let o = t.solve(limited(&h, &tau0), metric, &[], 39);
            assert!(!o.complete);
        }
    }

    #[test]
    fn held_rows_do_not_move() {
        let mut h = Box::new([[0.0; ROW]; DOF_COUNT]);
        (0..DOF_COUNT).for_each(|j| h[j][j] = 1.0 + 0.1 * j as f64);
        (h[0][1], h[1][0]) = (0.5, 0.5);
        let mut held = [[0.0; ROW]; 1];
        (held[0][0], held[0][5]) = (1.0, -1.0);
        let mut tau0 = [0.0; ROW];
        tau0[0] = 5.0;
        let mut t = TorqueLimits::default();
        let o = t.solve(limited(&h, &tau0), Metric::Identity, &held, 39);
        assert!(o.complete && dot(&held[0], &t.change).abs() < 1e-15);
        assert!((tau0[0] + dot(&h[0], &t.change) - 4.0).abs() < 1e-14);
    }
}
