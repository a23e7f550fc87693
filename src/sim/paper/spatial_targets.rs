//! Secondary constraints: centre of mass and end-effectors, Eqs. (12)–(16) (`docs/equations.md#the-paper`).

use crate::body::DOF_COUNT;
use crate::control::rows::{JointRow, ROW, RowQr, add_scaled, dot};
use crate::math::dense::cholesky_solve;
use crate::paper::torque_limits::{JointTorques, LimitOutcome, TOLERANCE};
use crate::setup::Priority;

/// Most rows of one task: positions of both hands, and eight client constraints with position and rotation.
pub const MAX_ROWS: usize = 54;
/// Most rows of the centre of mass.
const COM_ROWS: usize = 6;
/// Damping λ² of the centre-of-mass rows, for rows of unit length.
const COM_DAMPING: f64 = 1e-6;
/// Damping λ² of end-effector rows, for rows of unit length: a straight arm makes them dependent.
const EFFECTOR_DAMPING: f64 = 1e-4;
/// The same for client constraints: a body that is stretched already is not pulled apart towards a point that is higher
/// still.
const GOAL_DAMPING: f64 = 1e-2;
/// The same for led limbs: they are not asked for more than their length.
const LED_DAMPING: f64 = 1e-3;

/// Rows of a Jacobian on joint accelerations, with the desired change of each row's acceleration.
#[derive(Clone, Debug)]
pub struct Task {
    rows: [JointRow; MAX_ROWS],
    change: [f64; MAX_ROWS],
    /// DOFs that may serve each row (bits).
    serving: [u64; MAX_ROWS],
    /// Number of rows with their own damping; rows after them have that of goals.
    own: usize,
    len: usize,
}

impl Default for Task {
    fn default() -> Self {
        Self {
            rows: [[0.0; ROW]; MAX_ROWS],
            change: [0.0; MAX_ROWS],
            serving: [u64::MAX; MAX_ROWS],
            own: MAX_ROWS,
            len: 0,
        }
    }
}

impl Task {
    /// Forgets all rows.
    pub fn clear(&mut self) {
        self.len = 0;
        self.own = MAX_ROWS;
    }
    /// Adds a row; ignored beyond [`MAX_ROWS`].
    pub fn push(&mut self, row: JointRow, change: f64) {
        if self.len < MAX_ROWS {
            self.rows[self.len] = row;
            self.change[self.len] = change;
            self.serving[self.len] = u64::MAX;
            self.len += 1;
        }
    }
    /// The rows.
    pub fn rows(&self) -> &[JointRow] {
        &self.rows[..self.len]
    }
    /// Desired change per row.
    pub fn change(&self) -> &[f64] {
        &self.change[..self.len]
    }
    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }
    /// Marks the rows that follow as client constraints, which may ask for the impossible.
    pub(crate) fn begin_goals(&mut self) {
        self.own = self.len;
    }
    /// Damping λ² of each effector row.
    fn damping(&self) -> [f64; MAX_ROWS] {
        std::array::from_fn(|i| {
            if i < self.own {
                EFFECTOR_DAMPING
            } else {
                GOAL_DAMPING
            }
        })
    }
    /// Lets only some DOFs (bits) serve the rows from `first` on.
    pub(crate) fn only(&mut self, first: usize, dofs: u64) {
        self.serving[first..self.len].fill(dofs);
    }
    /// A row without the DOFs that do not serve it.
    fn served(&self, i: usize) -> JointRow {
        let mut r = self.rows[i];
        for (d, x) in r.iter_mut().enumerate() {
            *x = if self.serving[i] >> d & 1 == 1 {
                *x
            } else {
                0.0
            };
        }
        r
    }
    /// Restricts the rows to changes that leave the rows of `held` alone.
    pub(crate) fn restrict(&mut self, held: &RowQr) {
        for r in &mut self.rows[..self.len] {
            held.project_out(r);
        }
    }
}

/// Adds to `x` the damped least-norm solution `J⁺ t`: rows scaled by `1/lengths`, then `Jᵀ(J Jᵀ + λ²)⁻¹`. At most `N`
/// rows count.
#[inline(always)]
fn add_damped<const N: usize>(
    rows: &[JointRow],
    lengths: &[f64; MAX_ROWS],
    damping: &[f64; MAX_ROWS],
    t: &[f64; MAX_ROWS],
    x: &mut JointRow,
) {
    let n = rows.len().min(N);
    let mut g = [[0.0; N]; N];
    let mut y = [0.0; N];
    for i in 0..n {
        for j in 0..=i {
            g[i][j] = dot(&rows[i], &rows[j]) / (lengths[i] * lengths[j]);
        }
        g[i][i] += damping[i];
        y[i] = t[i] / lengths[i];
    }
    cholesky_solve(&mut g, n, &mut y);
    for i in 0..n {
        add_scaled(x, y[i] / lengths[i], &rows[i]);
    }
}

/// Lengths that scale rows before damping; one for each group of `group` rows, the components of one vector. With a
/// length for every row the damping would depend on the directions of the world axes.
fn lengths(rows: &[JointRow], group: usize) -> [f64; MAX_ROWS] {
    let mut l = [1.0; MAX_ROWS];
    for (l, r) in l.chunks_mut(group).zip(rows.chunks(group)) {
        let square = r.iter().map(|r| dot(r, r)).sum::<f64>() / r.len() as f64;
        l.fill(square.sqrt().max(1e-9));
    }
    l
}

/// The wish x of Eq. (12) for the centre of mass and the end-effectors.
///
/// `Priority::Paper`:  x = J_g⁺Δg̈ + (I − J_g⁺J_g) J_e⁺Δë. `Priority::Nested`: x = J_g⁺Δg̈ + (J_e P)⁺(Δë − J_e
/// J_g⁺Δg̈), P = I − J_g⁺J_g: exact for the end-effector where the centre of mass allows.
///
/// Rows of `led` come last, each served by its own limb only: with all joints, the least change would first bend ankles
/// and knees, which have the longest lever.
///
/// Pseudo-inverses are damped. The printed (13) and (15) exchange J_e and J_g; this follows the meaning of the text. No
/// allocation.
#[inline(always)]
pub fn wish(com: &Task, effector: &Task, led: &Task, priority: Priority) -> JointRow {
    let mut x = [0.0; ROW];
    let lg = lengths(com.rows(), 2);
    add_damped::<COM_ROWS>(
        com.rows(),
        &lg,
        &[COM_DAMPING; MAX_ROWS],
        &com.change,
        &mut x,
    );
    // P r for a joint vector: removes the part that would move the centre of mass.
    let project = |r: &mut JointRow| {
        let mut t = [0.0; MAX_ROWS];
        for (t, g) in t.iter_mut().zip(com.rows()) {
            *t = -dot(g, r);
        }
        add_damped::<COM_ROWS>(com.rows(), &lg, &[COM_DAMPING; MAX_ROWS], &t, r);
    };
    let le = lengths(effector.rows(), 3);
    match priority {
        _ if effector.is_empty() => {}
        Priority::Paper => {
            let mut y = [0.0; ROW];
            add_damped::<MAX_ROWS>(
                effector.rows(),
                &le,
                &effector.damping(),
                &effector.change,
                &mut y,
            );
            project(&mut y);
            add_scaled(&mut x, 1.0, &y);
        }
        Priority::Nested => {
            let mut rest = effector.change;
            let mut rows = effector.rows;
            for (i, r) in effector.rows().iter().enumerate() {
                rest[i] -= dot(r, &x);
                project(&mut rows[i]); // P is symmetric: rows of J_e P
            }
            add_damped::<MAX_ROWS>(
                &rows[..effector.len],
                &le,
                &effector.damping(),
                &rest,
                &mut x,
            );
        }
    }
    if !led.is_empty() {
        // The rest of the wish, by the limbs alone.
        let (mut rest, mut rows, n) = (led.change, led.rows, led.len);
        for (i, r) in led.rows().iter().enumerate() {
            rest[i] -= dot(r, &x);
            rows[i] = led.served(i);
        }
        let ll = lengths(&rows[..n], 3);
        rows[..n].iter_mut().for_each(project);
        add_damped::<MAX_ROWS>(&rows[..n], &ll, &[LED_DAMPING; MAX_ROWS], &rest, &mut x);
    }
    x
}

/// Active set of (16); keeps its buffers.
#[derive(Clone, Debug, Default)]
pub struct SpatialLimits {
    qr: RowQr,
}

impl SpatialLimits {
    /// The part of the wish `x` that the torque limits allow, in place: Δ₂ = x − H_L⁺H_L x (16).
    ///
    /// L starts empty and takes in every DOF whose torque `τ₁ + HΔ₂` would leave its limits; its torque then stays at
    /// τ₁, or goes to the violated limit with `to_limit`. At 39 members Δ₂ = 0 (or the change that the limits require):
    /// the loop cannot fail.
    ///
    /// * `torques`: τ₁ of the accelerations before this, H, and the limits.
    /// * `held`: rows that keep their value for `x` (kinematic loops), dropped when there is no room.
    /// * `most`: larger sets are abandoned.
    #[inline(always)]
    pub fn solve(
        &mut self,
        torques: JointTorques<'_>,
        x: &mut JointRow,
        to_limit: bool,
        held: &[JointRow],
        most: usize,
    ) -> LimitOutcome {
        let JointTorques { h, tau: tau1, .. } = torques;
        let wish = *x;
        let mut out = LimitOutcome::default();
        let (mut order, mut goal, mut k, mut fixed) = ([0; DOF_COUNT], [0.0; 2 * ROW], 0, 0);
        self.qr.clear();
        loop {
            let first = k;
            for j in 0..DOF_COUNT {
                let tau = torques.changed(j, x);
                // Members of K sit on their limit up to rounding: allow them twice the tolerance.
                if out.set >> j & 1 == 0 && torques.violates(j, tau, 2.0 * TOLERANCE) {
                    out.set |= 1 << j;
                    order[k] = j;
                    if to_limit {
                        goal[k] = torques.violated(j, tau) - tau1[j];
                    }
                    k += 1;
                }
            }
            if k == first {
                out.complete = x.iter().all(|v| v.is_finite());
                return out;
            }
            out.rounds += 1;
            if k > most {
                return out;
            }
            fixed = self.qr.grow(h, &order[..k], first, held, fixed);
            *x = wish;
            self.qr.project_out(x);
            if to_limit || fixed > 0 {
                let mut t = [0.0; 2 * ROW];
                for (i, r) in held.iter().enumerate().take(fixed) {
                    t[i] = dot(r, &wish);
                }
                t[fixed..fixed + k].copy_from_slice(&goal[..k]);
                out.damped |= self.qr.is_dependent();
                let mut y = [0.0; ROW];
                self.qr.solve(&t[..fixed + k], &mut y);
                add_scaled(x, 1.0, &y);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::support::testing::Rng;

    fn random_task(rng: &mut Rng, rows: usize) -> Task {
        let mut t = Task::default();
        for _ in 0..rows {
            let mut r = [0.0; ROW];
            (0..DOF_COUNT).for_each(|i| r[i] = rng.unit());
            t.push(r, 3.0 * rng.unit());
        }
        t
    }
    fn miss(task: &Task, x: &JointRow) -> f64 {
        let rows = task.rows().iter().zip(task.change());
        rows.map(|(r, c)| (dot(r, x) - c).abs()).fold(0.0, f64::max)
    }

    /// Equations (12), (13) of the paper.
    #[test]
    fn centre_of_mass_alone_gets_what_it_asks_for() {
        let mut rng = Rng::new(21);
        for _ in 0..50 {
            let com = random_task(&mut rng, 2);
            let x = wish(&com, &Task::default(), &Task::default(), Priority::Paper);
            assert!(miss(&com, &x) < 1e-5 * 3.0);
        }
    }

    /// Equations (12), (13) of the paper.
    #[test]
    fn nested_priority_reaches_both_and_the_papers_only_the_first() {
        let mut rng = Rng::new(22);
        let mut missed = 0;
        for _ in 0..50 {
            let (com, hands) = (random_task(&mut rng, 2), random_task(&mut rng, 6));
            let x = wish(&com, &hands, &Task::default(), Priority::Nested);
            assert!(
                miss(&com, &x) < 1e-4 && miss(&hands, &x) < 5e-3,
                "{}",
                miss(&hands, &x)
            );
            let x = wish(&com, &hands, &Task::default(), Priority::Paper);
            assert!(miss(&com, &x) < 1e-4);
            missed += usize::from(miss(&hands, &x) > 0.05);
        }
        assert!(missed > 40);
    }

    #[test]
    fn dependent_effector_rows_stay_finite() {
        let mut rng = Rng::new(23);
        let com = random_task(&mut rng, 2);
        let mut hands = random_task(&mut rng, 1);
        let (row, _) = (hands.rows()[0], 0);
        hands.push(row, -1.0);
        hands.push([0.0; ROW], 1.0);
        for p in [Priority::Paper, Priority::Nested] {
            let x = wish(&com, &hands, &Task::default(), p);
            assert!(x.iter().all(|v| v.is_finite()) && dot(&x, &x) < 1e3);
        }
    }

    /// Equation (16) of the paper.
    #[test]
    fn members_keep_their_torque_and_the_others_get_the_wish() {
        let mut rng = Rng::new(24);
        for round in 0..60 {
            // A positive definite H.
            let mut h = Box::new([[0.0; ROW]; DOF_COUNT]);
            let b: Vec<[f64; 39]> = (0..39)
                .map(|_| std::array::from_fn(|_| 0.4 * rng.unit()))
                .collect();
            for i in 0..39 {
                for j in 0..39 {
                    h[i][j] = b.iter().map(|r| r[i] * r[j]).sum::<f64>();
                }
                h[i][i] += 0.05;
            }
            let (lower, upper) = (&[-4.0; 39], &[5.0; 39]);
            let mut tau1 = [0.0; ROW];
            (0..39).for_each(|j| tau1[j] = rng.between(-4.0, 5.0));
            (tau1[0], tau1[1]) = (5.0, -4.0);
            let scale = [0.3, 3.0, 300.0][round % 3];
            let mut x = [0.0; ROW];
            (0..39).for_each(|j| x[j] = scale * rng.unit());
            for to_limit in [false, true] {
                let (mut s, mut d) = (SpatialLimits::default(), x);
                let torques = JointTorques {
                    h: &h,
                    tau: &tau1,
                    lower,
                    upper,
                };
                let o = s.solve(torques, &mut d, to_limit, &[], 39);
                assert!(o.complete && o.rounds <= 39);
                for j in 0..39 {
                    let tau = torques.changed(j, &d);
                    if !to_limit && o.set >> j & 1 == 1 {
                        let change = dot(&h[j], &d);
                        assert!(change.abs() < 1e-9 * scale.max(1.0), "H_L Δ₂ = 0");
                    }
                    assert!(!torques.violates(j, tau, 3e-9 * scale.max(1.0)));
                }
            }
        }
    }
}
