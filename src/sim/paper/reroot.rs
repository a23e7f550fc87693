//! Dynamics seen from the support (`docs/equations.md#repairs`): accelerations and torques as affine functions of the
//! joint accelerations.
//!
//! The state is always rooted at the pelvis; "the support is the root" (paper §3.1) is a projection. With
//! `v̇ = N θ̈ + b` and the unknown wrench at the support removed by `Nᵀ`, torques are `τ = H θ̈ + c₀` (6). The same
//! form holds for a tilting support (S1), in flight, and with other contacts sharing the load (S2); only N, b, H, c₀
//! differ.

use crate::body::{DOF_COUNT, NV, SegmentId};
use crate::control::rows::{JointRow, ROW, Square, dot};
use crate::dynamics::Terms;
use crate::math::dense::solve_up_to_2;
use crate::math::{Vec3, vec3::vec3};
use crate::support::sharing::Sharing;
use crate::support::tipping::{base_directions, base_product};
use crate::support::{Pivot, SupportPoint};

/// The maps of one tick: `v̇ = N θ̈ + b`, `τ = H θ̈ + c₀`, ground wrench `W = W_θ θ̈ + W₀`.
///
/// Only the six pelvis rows of N and b are stored; the rest is the identity and zero.
#[derive(Clone, Debug)]
pub struct SupportMap {
    /// Pelvis rows of N as it acts on accelerations.
    base: [JointRow; 6],
    /// Pelvis part of b.
    bias: [f64; 6],
    /// Pelvis rows of N with the support at rest: Nᵀ removes the wrench at the support even while it tilts.
    rest: [JointRow; 6],
    /// Ground wrench per joint acceleration, about the pelvis origin (moment, force).
    wrench: [JointRow; 6],
    /// Ground wrench without joint acceleration.
    wrench_bias: [f64; 6],
    /// H of (6); not symmetric with balanced sharing.
    pub h: Box<Square>,
    /// c₀ of (6): C + G − KF of the paper.
    pub c: JointRow,
}

impl Default for SupportMap {
    fn default() -> Self {
        Self {
            base: [[0.0; ROW]; 6],
            bias: [0.0; 6],
            rest: [[0.0; ROW]; 6],
            wrench: [[0.0; ROW]; 6],
            wrench_bias: [0.0; 6],
            h: Box::new([[0.0; ROW]; DOF_COUNT]),
            c: [0.0; ROW],
        }
    }
}

impl SupportMap {
    /// Support `s` accelerates by `angular` and, at its origin, `linear`, world axes: zero for a support at rest.
    ///
    /// Section 3.1 of the paper.
    #[inline(always)]
    pub fn set_support(&mut self, terms: &Terms, s: SegmentId, angular: Vec3, linear: Vec3) {
        use crate::body::topology::{DOF_LEN, DOF_START, PARENT};
        let s = s.index();
        // J_S = [J_Sb J_Sj] with J_Sb = [1 0; −[r]× 1], so −J_Sb⁻¹ J_Sj is minus the joint's velocity field at the
        // pelvis origin.
        self.base = [[0.0; ROW]; 6];
        let mut a = s;
        while a != 0 {
            let position = terms.kin.position[a];
            for d in DOF_START[a]..DOF_START[a] + DOF_LEN[a] {
                // A unit rate turns the support by `axis` and moves its point at the pelvis origin by axis × (0 −
                // position); the pelvis has to do the opposite.
                let axis = terms.kin.axis[d];
                let v = axis.cross(position);
                for (k, x) in [-axis.x, -axis.y, -axis.z, v.x, v.y, v.z]
                    .into_iter()
                    .enumerate()
                {
                    self.base[k][d] = x;
                }
            }
            a = PARENT[a];
        }
        let (alpha, acc) = terms.segment_bias(s);
        let (alpha, acc) = (angular - alpha, linear - acc);
        let acc = acc + terms.kin.position[s].cross(alpha); // J_Sb⁻¹
        self.bias = [alpha.x, alpha.y, alpha.z, acc.x, acc.y, acc.z];
        self.rest = self.base;
        self.finish(terms);
    }

    /// No support: the ground gives nothing, `N = [−M_bb⁻¹ M_bj; 1]`, `b = [−M_bb⁻¹ h_b; 0]`.
    #[inline(always)]
    pub fn set_flight(&mut self, terms: &Terms) {
        let mut l = [[0.0; 6]; 6];
        for i in 0..6 {
            for j in 0..=i {
                let mut s = terms.m[i][j];
                for k in 0..j {
                    s -= l[i][k] * l[j][k];
                }
                l[i][j] = if i == j { s.sqrt() } else { s / l[j][j] };
            }
        }
        let mut rows = [[0.0; ROW]; 7]; // the six columns of −M_bj per DOF, then −h_b as one more column
        for i in 0..6 {
            for d in 0..DOF_COUNT {
                rows[i][d] = -terms.m[i][6 + d];
            }
            rows[i][DOF_COUNT] = -terms.h[i];
        }
        for i in 0..6 {
            for k in 0..i {
                let f = l[i][k];
                let from = rows[k];
                (0..ROW).for_each(|d| rows[i][d] -= f * from[d]);
            }
            (0..ROW).for_each(|d| rows[i][d] /= l[i][i]);
        }
        for i in (0..6).rev() {
            for k in i + 1..6 {
                let f = l[k][i];
                let from = rows[k];
                (0..ROW).for_each(|d| rows[i][d] -= f * from[d]);
            }
            (0..ROW).for_each(|d| rows[i][d] /= l[i][i]);
        }
        for i in 0..6 {
            self.base[i] = rows[i];
            self.bias[i] = rows[i][DOF_COUNT];
            self.base[i][DOF_COUNT] = 0.0;
        }
        self.rest = self.base;
        self.finish(terms);
    }

    /// Support `s` rotates about a pivot (S1). The wrench that the pivot cannot give becomes rotation of the whole
    /// body: `N_t = N − E Q M N`, `b_t = b − E Q (M b + h)`, `Q = (Eᵀ M E)⁻¹ Eᵀ`; `H = Nᵀ M N_t`, `c₀ = Nᵀ (M b_t +
    /// h)`.
    #[inline(always)]
    pub fn set_tilting(&mut self, terms: &Terms, s: SegmentId, pivot: &Pivot) {
        let i = s.index();
        let spin = pivot.project(terms.kin.omega[i]);
        let arm = terms.segment_position(i) - pivot.point;
        self.set_support(terms, s, Vec3::zero(), spin.cross(spin.cross(arm)));
        let (e, n) = (base_directions(terms, pivot), pivot.axes().len());
        let mut g = [[0.0; 2]; 2];
        let mut moment = [[0.0; ROW]; 2]; // Eᵀ M N: moment about the free axes per joint acceleration
        let mut moment_bias = [0.0; 2];
        for a in 0..n {
            for b in 0..n {
                g[a][b] = base_product(terms, &e[a], &e[b]);
            }
            for k in 0..6 {
                for d in 0..ROW {
                    moment[a][d] += e[a][k] * self.wrench[k][d];
                }
                moment_bias[a] += e[a][k] * self.wrench_bias[k];
            }
        }
        let mut turn = [[0.0; ROW]; 2]; // Q M N
        for d in 0..DOF_COUNT {
            let x = solve_up_to_2(&g, [moment[0][d], moment[1][d]], n);
            (turn[0][d], turn[1][d]) = (x[0], x[1]);
        }
        let turn_bias = solve_up_to_2(&g, moment_bias, n);
        for a in 0..n {
            for k in 0..6 {
                for d in 0..ROW {
                    self.base[k][d] -= e[a][k] * turn[a][d];
                }
                self.bias[k] -= e[a][k] * turn_bias[a];
            }
            for j in 0..DOF_COUNT {
                let m = moment[a][j];
                for d in 0..ROW {
                    self.h[j][d] -= m * turn[a][d];
                }
                self.c[j] -= m * turn_bias[a];
            }
        }
        // The ground wrench of the resulting motion.
        for k in 0..6 {
            for a in 0..n {
                let me: f64 = (0..6).map(|l| terms.m[k][l] * e[a][l]).sum();
                for d in 0..ROW {
                    self.wrench[k][d] -= me * turn[a][d];
                }
                self.wrench_bias[k] -= me * turn_bias[a];
            }
        }
    }

    /// H, c₀ and the ground wrench from N and b, in block form: `H = M_jj + NbᵀY + YᵀNb` with `Y = M_bj + ½ M_bb Nb`.
    #[inline(always)]
    fn finish(&mut self, terms: &Terms) {
        let mut y = [[0.0; ROW]; 6];
        for k in 0..6 {
            let mut w = [0.0; ROW];
            w[..DOF_COUNT].copy_from_slice(&terms.m[k][6..NV]);
            y[k] = w;
            for l in 0..6 {
                let m = terms.m[k][l];
                for d in 0..ROW {
                    w[d] += m * self.base[l][d];
                    y[k][d] += 0.5 * m * self.base[l][d];
                }
            }
            self.wrench[k] = w;
            self.wrench_bias[k] =
                terms.h[k] + (0..6).map(|l| terms.m[k][l] * self.bias[l]).sum::<f64>();
        }
        for j in 0..DOF_COUNT {
            let row = &mut self.h[j];
            row[..DOF_COUNT].copy_from_slice(&terms.m[6 + j][6..NV]);
            row[DOF_COUNT..].fill(0.0);
            let mut c = terms.h[6 + j];
            for k in 0..6 {
                let (n, yk) = (self.base[k][j], y[k][j]);
                for d in 0..ROW {
                    row[d] += n * y[k][d] + yk * self.base[k][d];
                }
                c += terms.m[6 + j][k] * self.bias[k] + n * self.wrench_bias[k];
            }
            self.c[j] = c;
        }
    }

    /// Lets other contacts carry their share (S2): `τ = (H − KᵀΛW_θ) θ̈ + (c₀ − KᵀΛW₀)`. Contacts of `main` change
    /// nothing; it carries the rest.
    #[inline(always)]
    pub fn add_sharing(&mut self, terms: &Terms, sharing: &Sharing, main: SegmentId) {
        use crate::body::topology::SEGMENT_COUNT;
        // u_j = Σ_s G_s (velocity field of segment s about the reference, per joint acceleration), so that the torque
        // is u_jᵀ G⁺ W.
        let mut u = [[0.0; ROW]; 6];
        let mut any = false;
        let reference = sharing.reference - terms.state.posture.root_position;
        for s in 0..SEGMENT_COUNT {
            if s == main.index() || !sharing.carries(s) {
                continue;
            }
            any = true;
            let twist = self.relative_twist(terms, s, reference);
            let g = sharing.gram(s);
            for i in 0..6 {
                for j in 0..6 {
                    for d in 0..ROW {
                        u[i][d] += g[i][j] * twist[j][d];
                    }
                }
            }
        }
        if !any {
            return;
        }
        // y = G⁺ W about the reference.
        let (mut y, mut y0) = ([[0.0; ROW]; 6], [0.0; 6]);
        let shifted = self.wrench_about(reference);
        for d in 0..DOF_COUNT {
            let w: [f64; 6] = std::array::from_fn(|k| shifted[k][d]);
            let m = sharing.multiplier(&w);
            (0..6).for_each(|k| y[k][d] = m[k]);
        }
        let w0 = shift(&self.wrench_bias, reference);
        y0.copy_from_slice(&sharing.multiplier(&w0));
        for j in 0..DOF_COUNT {
            for k in 0..6 {
                let f = u[k][j];
                if f != 0.0 {
                    for d in 0..ROW {
                        self.h[j][d] -= f * y[k][d];
                    }
                    self.c[j] -= f * y0[k];
                }
            }
        }
    }

    /// Takes a known force (N, world axes) at a world point of segment `s` into c₀: the paper's "external force at the
    /// end of a path".
    #[inline(always)]
    pub fn add_force(&mut self, terms: &Terms, s: SegmentId, point: Vec3, force: Vec3) {
        let r = point - terms.state.posture.root_position;
        let twist = self.relative_twist(terms, s.index(), r);
        for d in 0..DOF_COUNT {
            self.c[d] -= twist[3][d] * force.x + twist[4][d] * force.y + twist[5][d] * force.z;
        }
    }

    /// `J_s N` with the support at rest, for the point of segment `s` at `r` (world axes, from the pelvis origin).
    #[inline(always)]
    fn relative_twist(&self, terms: &Terms, s: usize, r: Vec3) -> [JointRow; 6] {
        use crate::body::topology::{DOF_LEN, DOF_START, PARENT};
        let mut t = self.rest;
        for d in 0..ROW {
            // velocity at r of a pelvis twist: v + ω × r
            let w = vec3(t[0][d], t[1][d], t[2][d]).cross(r);
            t[3][d] += w.x;
            t[4][d] += w.y;
            t[5][d] += w.z;
        }
        let mut a = s;
        while a != 0 {
            for d in DOF_START[a]..DOF_START[a] + DOF_LEN[a] {
                let axis = terms.kin.axis[d];
                let v = axis.cross(r - terms.kin.position[a]);
                for (k, x) in [axis.x, axis.y, axis.z, v.x, v.y, v.z]
                    .into_iter()
                    .enumerate()
                {
                    t[k][d] += x;
                }
            }
            a = PARENT[a];
        }
        t
    }

    fn wrench_about(&self, r: Vec3) -> [JointRow; 6] {
        let mut out = self.wrench;
        for d in 0..DOF_COUNT {
            let w: [f64; 6] = std::array::from_fn(|k| self.wrench[k][d]);
            let s = shift(&w, r);
            (0..6).for_each(|k| out[k][d] = s[k]);
        }
        out
    }

    /// v̇ = N θ̈ + b.
    #[inline(always)]
    pub fn acceleration(&self, qdd: &JointRow) -> [f64; NV] {
        let mut v = [0.0; NV];
        for k in 0..6 {
            v[k] = dot(&self.base[k], qdd) + self.bias[k];
        }
        v[6..].copy_from_slice(&qdd[..DOF_COUNT]);
        v
    }

    /// τ = H θ̈ + c₀.
    ///
    /// Equation (6) of the paper.
    #[inline(always)]
    pub fn torque(&self, qdd: &JointRow) -> JointRow {
        let mut t = [0.0; ROW];
        for j in 0..DOF_COUNT {
            t[j] = dot(&self.h[j], qdd) + self.c[j];
        }
        t
    }

    /// Ground wrench about the pelvis origin (moment, force).
    #[inline(always)]
    pub fn ground_wrench(&self, qdd: &JointRow) -> [f64; 6] {
        std::array::from_fn(|k| dot(&self.wrench[k], qdd) + self.wrench_bias[k])
    }

    /// Ground force and moment about the world origin.
    pub fn ground_wrench_world(&self, terms: &Terms, qdd: &JointRow) -> (Vec3, Vec3) {
        let w = self.ground_wrench(qdd);
        let f = vec3(w[3], w[4], w[5]);
        let n = vec3(w[0], w[1], w[2]) + terms.state.posture.root_position.cross(f);
        (f, n)
    }

    /// One row of a Jacobian (45 velocity components, padded) as a row of joint components: `J N`.
    #[inline(always)]
    pub fn project(&self, jacobian: &[f64]) -> JointRow {
        let mut r = [0.0; ROW];
        r[..DOF_COUNT].copy_from_slice(&jacobian[6..NV]);
        for k in 0..6 {
            if jacobian[k] != 0.0 {
                for d in 0..ROW {
                    r[d] += jacobian[k] * self.base[k][d];
                }
            }
        }
        r
    }

    /// `J b` of one row of a Jacobian.
    #[inline(always)]
    pub fn project_bias(&self, jacobian: &[f64]) -> f64 {
        (0..6).map(|k| jacobian[k] * self.bias[k]).sum()
    }
}

/// A wrench (moment, force) about the pelvis origin, taken about the point at `r` from it.
pub(crate) fn shift(w: &[f64; 6], r: Vec3) -> [f64; 6] {
    let f = vec3(w[3], w[4], w[5]);
    let n = vec3(w[0], w[1], w[2]) - r.cross(f);
    [n.x, n.y, n.z, f.x, f.y, f.z]
}

/// Whether all points of the set lie on `main`: then there is nothing to share.
pub(crate) fn only_main(points: &[SupportPoint], main: SegmentId) -> bool {
    points.iter().all(|p| p.segment == main)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::topology::{L_FOOT, NV, PELVIS, R_FOOT, R_HAND, R_TOES, SEGMENT_COUNT};
    use crate::body::{Links, State};
    use crate::dynamics::{External, ExternalForces, RneaWorkspace, rnea};
    use crate::support::testing::{
        GRAVITY, Rng, mannequin, random_stance, random_state, standing, terms,
    };
    use crate::support::{Support, tipping_acceleration};

    fn random_row(rng: &mut Rng, scale: f64) -> JointRow {
        let mut r = [0.0; ROW];
        (0..DOF_COUNT).for_each(|d| r[d] = scale * rng.unit());
        r
    }

    /// Generalised forces by Newton–Euler with wrenches (moment, force about a world point) on segments.
    fn inverse_dynamics(
        state: &State,
        t: &Terms,
        vdot: &[f64; NV],
        on: &[(usize, [f64; 6], Vec3)],
    ) -> [f64; NV] {
        let body = mannequin();
        let mut external = [External {
            moment: Vec3::zero(),
            force: Vec3::zero(),
        }; SEGMENT_COUNT];
        for (s, w, about) in on {
            let f = vec3(w[3], w[4], w[5]);
            let arm = *about - t.segment_position(*s);
            external[*s].force += f;
            external[*s].moment += vec3(w[0], w[1], w[2]) + arm.cross(f);
        }
        let mut tau = [0.0; NV];
        rnea(
            &Links::new(&body),
            &t.kin,
            &state.velocity,
            vdot,
            ExternalForces {
                gravity: GRAVITY,
                on_segments: &external,
            },
            &mut RneaWorkspace::default(),
            &mut tau,
        );
        tau
    }

    /// Section 3.1 of the paper.
    #[test]
    fn rerooted_support_does_not_accelerate() {
        let (body, mut rng) = (mannequin(), Rng::new(31));
        for s in [L_FOOT, R_FOOT, R_TOES, R_HAND, PELVIS] {
            let state = random_state(&body, &mut rng, 1.0, 3.0);
            let t = terms(&body, &state);
            let mut map = SupportMap::default();
            map.set_support(&t, s, Vec3::zero(), Vec3::zero());
            let v = map.acceleration(&random_row(&mut rng, 30.0));
            let mut j = [[0.0; 48]; 6];
            t.segment_jacobian(s.index(), &mut j);
            let (alpha, acc) = t.segment_bias(s.index());
            let bias = [alpha.x, alpha.y, alpha.z, acc.x, acc.y, acc.z];
            for k in 0..6 {
                let a = (0..NV).map(|i| j[k][i] * v[i]).sum::<f64>() + bias[k];
                assert!(a.abs() < 1e-9, "{s:?} row {k}: {a}");
            }
        }
    }

    /// Section 3.1 of the paper.
    #[test]
    fn rerooted_torque_is_newton_euler_with_the_support_wrench() {
        let (body, mut rng) = (mannequin(), Rng::new(32));
        for s in [L_FOOT, R_TOES, R_HAND] {
            for _ in 0..5 {
                let state = random_state(&body, &mut rng, 1.0, 3.0);
                let t = terms(&body, &state);
                let mut map = SupportMap::default();
                map.set_support(&t, s, vec3(0.1, -0.2, 0.3), vec3(1.0, 0.5, -0.7));
                let qdd = random_row(&mut rng, 20.0);
                let (v, tau) = (map.acceleration(&qdd), map.torque(&qdd));
                let w = map.ground_wrench(&qdd);
                let (f, n) = t.ground_wrench(&v);
                let (f2, n2) = map.ground_wrench_world(&t, &qdd);
                assert!((f - f2).norm() + (n - n2).norm() < 1e-9 * (1.0 + f.norm()));
                let all = inverse_dynamics(
                    &state,
                    &t,
                    &v,
                    &[(s.index(), w, t.state.posture.root_position)],
                );
                let scale = tau.iter().fold(1.0f64, |m, x| m.max(x.abs()));
                for k in 0..6 {
                    assert!(all[k].abs() < 1e-9 * scale);
                }
                for d in 0..DOF_COUNT {
                    assert!((all[6 + d] - tau[d]).abs() < 1e-10 * scale);
                }
            }
        }
    }

    /// Section 3.1 of the paper.
    #[test]
    fn every_choice_of_support_gives_the_same_torque_with_the_other_wrench() {
        let (body, mut rng) = (mannequin(), Rng::new(33));
        let state = random_state(&body, &mut rng, 0.5, 2.0);
        let t = terms(&body, &state);
        // Keeping both feet still would need loops, but any v̇ is valid here: choose θ̈, root at the left foot.
        let mut left = SupportMap::default();
        left.set_support(&t, L_FOOT, Vec3::zero(), Vec3::zero());
        let qdd = random_row(&mut rng, 5.0);
        let v = left.acceleration(&qdd);
        // A force at the right foot, known.
        let (at, force) = (t.segment_position(R_FOOT.index()), vec3(20.0, -10.0, 300.0));
        left.add_force(&t, R_FOOT, at, force);
        let tau = left.torque(&qdd);
        // Rooted at the right foot with its true acceleration, given the left foot's wrench (the rest).
        let mut j = [[0.0; 48]; 6];
        t.segment_jacobian(R_FOOT.index(), &mut j);
        let (alpha, acc) = t.segment_bias(R_FOOT.index());
        let row = |k: usize| (0..NV).map(|i| j[k][i] * v[i]).sum::<f64>();
        let mut right = SupportMap::default();
        let a = (
            vec3(row(0), row(1), row(2)) + alpha,
            vec3(row(3), row(4), row(5)) + acc,
        );
        right.set_support(&t, R_FOOT, a.0, a.1);
        let total = right.ground_wrench(&qdd);
        let twist = right.relative_twist(&t, L_FOOT.index(), Vec3::zero());
        let r = at - t.state.posture.root_position;
        let m = r.cross(force);
        let given = [m.x, m.y, m.z, force.x, force.y, force.z];
        let v2 = right.acceleration(&qdd);
        assert!((0..NV).all(|i| (v[i] - v2[i]).abs() < 1e-9));
        let tau2 = right.torque(&qdd);
        for d in 0..DOF_COUNT {
            let other: f64 = (0..6).map(|k| twist[k][d] * (total[k] - given[k])).sum();
            assert!((tau2[d] - other - tau[d]).abs() < 1e-8);
        }
    }

    #[test]
    fn flight_needs_no_ground_and_keeps_momentum() {
        let (body, mut rng) = (mannequin(), Rng::new(34));
        let state = random_state(&body, &mut rng, 1.0, 3.0);
        let t = terms(&body, &state);
        let mut map = SupportMap::default();
        map.set_flight(&t);
        let qdd = random_row(&mut rng, 30.0);
        let (v, tau) = (map.acceleration(&qdd), map.torque(&qdd));
        let (f, n) = t.ground_wrench(&v);
        assert!(f.norm() < 1e-8 && n.norm() < 1e-8);
        let all = inverse_dynamics(&state, &t, &v, &[]);
        for d in 0..DOF_COUNT {
            assert!((all[6 + d] - tau[d]).abs() < 1e-8);
        }
        // H is symmetric.
        for i in 0..DOF_COUNT {
            for j in 0..i {
                assert!((map.h[i][j] - map.h[j][i]).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn tilting_map_obeys_the_equations_of_motion_with_a_wrench_that_has_no_moment_about_the_pivot()
    {
        let (body, mut rng) = (mannequin(), Rng::new(35));
        for count in [1, 2] {
            for _ in 0..5 {
                let state = random_stance(&body, &mut rng, 0.4, 1.0);
                let t = terms(&body, &state);
                let p = vec3(t.com.x + 0.05, 0.0, 0.0);
                let pivot = if count == 1 {
                    Pivot::edge(p, vec3(0.6, 0.8, 0.0))
                } else {
                    Pivot::vertex(p)
                };
                let mut map = SupportMap::default();
                map.set_tilting(&t, L_FOOT, &pivot);
                let qdd = random_row(&mut rng, 5.0);
                let (v, tau) = (map.acceleration(&qdd), map.torque(&qdd));
                let (f, n) = t.ground_wrench(&v);
                let moment = n - p.cross(f);
                for u in pivot.axes() {
                    assert!(u.dot(moment).abs() < 1e-8, "the pivot gives no moment");
                }
                // Inverse dynamics with that wrench on the foot gives the same torques.
                let w = [n.x, n.y, n.z, f.x, f.y, f.z];
                let all = inverse_dynamics(&state, &t, &v, &[(L_FOOT.index(), w, Vec3::zero())]);
                for d in 0..DOF_COUNT {
                    assert!((all[6 + d] - tau[d]).abs() < 1e-8);
                }
                let w = map.ground_wrench(&qdd);
                assert!((vec3(w[3], w[4], w[5]) - f).norm() < 1e-8);
                // The support rotates as the paper's −n₀/I says, from the wrench with the support at rest.
                let mut rest = SupportMap::default();
                let spin = pivot.project(t.kin.omega[L_FOOT.index()]);
                let arm = t.segment_position(L_FOOT.index()) - p;
                rest.set_support(&t, L_FOOT, Vec3::zero(), spin.cross(spin.cross(arm)));
                let (f0, n0) = rest.ground_wrench_world(&t, &qdd);
                let turn = tipping_acceleration(&t, &pivot, f0, n0);
                let mut j = [[0.0; 48]; 6];
                t.segment_jacobian(L_FOOT.index(), &mut j);
                let (alpha, _) = t.segment_bias(L_FOOT.index());
                let row = |k: usize| (0..NV).map(|i| j[k][i] * v[i]).sum::<f64>();
                let got = vec3(row(0), row(1), row(2)) + alpha;
                assert!((got - turn).norm() < 1e-8 * (1.0 + turn.norm()));
                for i in 0..DOF_COUNT {
                    for k in 0..i {
                        assert!((map.h[i][k] - map.h[k][i]).abs() < 1e-9);
                    }
                }
            }
        }
    }

    /// Repair S2.
    #[test]
    fn balanced_sharing_is_newton_euler_with_the_shared_wrenches() {
        let (body, mut rng) = (mannequin(), Rng::new(36));
        for _ in 0..10 {
            let state = random_stance(&body, &mut rng, 0.4, 1.0);
            let t = terms(&body, &state);
            let mut support = Support::default();
            support.update(&t, &body, Vec3::zero(), GRAVITY);
            let main = support.main().unwrap();
            let mut sharing = Sharing::default();
            assert!(sharing.set_balanced(support.points(), support.ratio(), &[false; 64]));
            let mut map = SupportMap::default();
            map.set_support(&t, main, Vec3::zero(), Vec3::zero());
            map.add_sharing(&t, &sharing, main);
            let qdd = random_row(&mut rng, 3.0);
            let (v, tau) = (map.acceleration(&qdd), map.torque(&qdd));
            // Point forces, summed per segment.
            let (f, n) = t.ground_wrench(&v);
            let n = n - sharing.reference.cross(f);
            let y = sharing.multiplier(&[n.x, n.y, n.z, f.x, f.y, f.z]);
            let mut on = Vec::new();
            let mut total = Vec3::zero();
            for p in support.points() {
                let force = sharing.point_force(p, support.ratio(), &y);
                total += force;
                let w = [0.0, 0.0, 0.0, force.x, force.y, force.z];
                on.push((p.segment.index(), w, p.position));
            }
            assert!((total - f).norm() < 1e-9 * f.norm());
            let all = inverse_dynamics(&state, &t, &v, &on);
            for (k, x) in all.iter().take(6).enumerate() {
                assert!(x.abs() < 1e-7, "base row {k}");
            }
            for d in 0..DOF_COUNT {
                assert!((all[6 + d] - tau[d]).abs() < 1e-7, "DOF {d}");
            }
        }
    }

    #[test]
    fn h_of_standing_is_positive_definite_and_sees_the_whole_body_at_the_ankle() {
        let body = mannequin();
        let t = terms(&body, &standing(&body));
        let mut map = SupportMap::default();
        map.set_support(&t, L_FOOT, Vec3::zero(), Vec3::zero());
        let h = nalgebra::DMatrix::from_fn(39, 39, |i, j| map.h[i][j]);
        assert!(h.clone().cholesky().is_some());
        let ankle = map.h[27][27];
        assert!(ankle > 40.0 && ankle < 90.0, "{ankle} kg·m²");
    }
}
