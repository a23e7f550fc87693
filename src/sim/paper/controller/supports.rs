//! The support in a pass: which feet carry, how several of them share the reaction, and how a second one is kept in
//! place.

use crate::body::topology::{DOF_START, L_FOOT, L_THIGH, R_FOOT, R_THIGH};
use crate::control::ControlInput;
use crate::control::rows::{JointRow, dot};
use crate::dynamics::terms::WIDTH;
use crate::math::dense::cholesky_solve;
use crate::math::{Quat, Vec3};
use crate::paper::controller::{Paper, SupportMotion};
use crate::paper::reroot::{only_main, shift};
use crate::report::MAX_CONTACTS;
use crate::setup::Share;
use crate::support::{NO_VERTEX, zmp};

/// While the support tilts, only points this close to the pivot line carry load, m.
const PIVOT_REACH: f64 = 0.012;
/// Share of a planted foot's pose error that is corrected per step (kinematic loops).
const LOOP_RETURN: f64 = 0.2;

impl Paper {
    /// Lets contacts other than those of S carry their share of the ground reaction (`docs/equations.md#repairs`).
    pub(super) fn share(
        &mut self,
        input: &ControlInput<'_>,
        initial: &JointRow,
        mode: SupportMotion,
    ) {
        self.left_out = None;
        let (terms, support) = (input.terms, input.support);
        let (main, tilt) = match mode {
            SupportMotion::Rest(s) => (s, None),
            SupportMotion::Tilt(s, p) => (s, Some(p)),
            SupportMotion::Flight => return,
        };
        let points = support.carriers();
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
                let before = self.memory.previous.as_ref().map_or(*initial, |p| p.0);
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
                    let f = force * support.ratio()[s.index()];
                    if p.vertex == NO_VERTEX {
                        self.map.add_force(terms, s, p.position, f);
                        continue;
                    }
                    support.support_polygon(s, &mut self.polygon);
                    if let Some(c) = self.polygon.closest([z.x, z.y]) {
                        let at = Vec3::from_array([c.point[0], c.point[1], 0.0]);
                        self.map.add_force(terms, s, at, f);
                    }
                }
            }
        }
    }

    /// Kinematic loops (`docs/equations.md#repairs`): a second planted foot stays where it was put down. Its leg's
    /// θ̈_initial holds it there, and its rows may not change afterwards.
    pub(super) fn hold_planted_feet(
        &mut self,
        input: &ControlInput<'_>,
        initial: &mut JointRow,
        mode: SupportMotion,
    ) {
        self.held_count = 0;
        self.held_qr.clear();
        let SupportMotion::Rest(main) = mode else {
            return;
        };
        let terms = input.terms;
        for (side, (foot, thigh)) in [(L_FOOT, L_THIGH), (R_FOOT, R_THIGH)]
            .into_iter()
            .enumerate()
        {
            let Some((position, rotation)) = self.memory.anchors[side].filter(|_| foot != main)
            else {
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
            let rows: [JointRow; 6] = std::array::from_fn(|i| self.map.project(&jacobian[i]));
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

    /// Remembers the places of planted feet; forgets feet that roll, lift, or should lift.
    pub(super) fn update_anchors(&mut self, input: &ControlInput<'_>) {
        let support = input.support;
        let on_foot = matches!(support.main(), Some(L_FOOT | R_FOOT));
        for (side, foot) in [L_FOOT, R_FOOT].into_iter().enumerate() {
            let touching = support.points().iter().filter(|p| p.support == foot);
            let flat = touching.count() >= 3;
            let keep = input.kinematic && on_foot && flat && input.target.next.planted[side];
            self.memory.anchors[side] = if keep {
                let s = foot.index();
                self.memory.anchors[side].or_else(|| {
                    let r = Quat::from_mat3(&input.terms.segment_rotation(s));
                    Some((input.terms.segment_position(s), r))
                })
            } else {
                None
            };
        }
    }
}
