//! Entry points that pick the widest vector instructions the machine has, at run time.
//!
//! The kernels are plain generic code. Compiled here once more for AVX-512 and AVX2, they run eight figures in
//! lock-step. No path uses fused multiply-add, so all of them give the same bits.

use super::aba::{AbaWorkspace, aba};
use super::crba::{CompositeInertia, crba};
use super::factor::{factor, solve};
use super::kinematics::Kinematics;
use super::mass_matrix::MassMatrix;
use super::rnea::{ExternalForces, RneaWorkspace, rnea};
use crate::body::topology::NV;
use crate::body::{Links, State};
use crate::math::F64x8;
use multiversion::multiversion;

/// [`Kinematics::set_state`] and [`rnea`] for eight figures.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
pub fn rnea_x8(
    links: &Links<F64x8>,
    state: &State<F64x8>,
    vdot: &[F64x8; NV],
    external: ExternalForces<'_, F64x8>,
    kin: &mut Kinematics<F64x8>,
    ws: &mut RneaWorkspace<F64x8>,
    tau: &mut [F64x8; NV],
) {
    kin.set_state(links, state);
    rnea(links, kin, &state.velocity, vdot, external, ws, tau);
}

/// [`crba`] for eight figures.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
pub fn crba_x8(
    links: &Links<F64x8>,
    kin: &Kinematics<F64x8>,
    ci: &mut CompositeInertia<F64x8>,
    m: &mut MassMatrix<F64x8>,
) {
    crba(links, kin, ci, m);
}

/// [`factor`] and [`solve`] for eight figures.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
pub fn factor_solve_x8(m: &mut MassMatrix<F64x8>, x: &mut [F64x8; NV]) {
    factor(m);
    solve(m, x);
}

/// [`aba`] for eight figures.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
pub fn aba_x8(
    links: &Links<F64x8>,
    kin: &Kinematics<F64x8>,
    velocity: &[F64x8; NV],
    tau: &[F64x8; NV],
    external: ExternalForces<'_, F64x8>,
    ws: &mut AbaWorkspace<F64x8>,
    vdot: &mut [F64x8; NV],
) {
    aba(links, kin, velocity, tau, external, ws, vdot);
}
