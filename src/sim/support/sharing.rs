//! Sharing of the ground reaction between contact points: balanced (S2) and the paper's (`docs/equations.md#repairs`).
//!
//! Among all point forces with the right total wrench W, balanced sharing finds those that are smallest in a norm
//! weighted by the support ratios: f = D Aᵀ (A D Aᵀ)⁺ W with A = [… [p_k]×; 1 …]. Only the wrench per segment matters
//! afterwards, so the point forces are never formed: with the Gram matrix G_s of the points of segment s, that wrench
//! is G_s G⁺ W, G = Σ G_s. Everything is referred to the centroid of the points, so the result does not depend on where
//! in the world the figure stands.

use super::contact_set::SupportPoint;
use super::rest::NO_VERTEX;
use crate::body::SEGMENT_COUNT;
use crate::body::topology::{L_TOES, R_TOES};
use crate::math::{Vec3, vec3::vec3};

/// A 6×6 matrix; spatial order, moment first.
pub type Mat6 = [[f64; 6]; 6];

/// Length that makes moments comparable with forces, m (half the breadth of a stance).
const MOMENT_LENGTH: f64 = 0.3;
/// Singular values below this part of the largest are cut off in the pseudo-inverse.
const CUT_OFF: f64 = 1e-6;
/// Weight of toe points relative to points of the foot.
const TOE_WEIGHT: f64 = 0.2;
/// Weight of forces along the surface on which a part rests, relative to the force into it: a hand pushes on a table,
/// and its friction cannot carry as much as that of a sole.
pub const ALONG_REST: f64 = 0.1;
/// Least weight of a support, so that a ratio of zero does not remove it.
pub const LEAST_WEIGHT: f64 = 0.02;
/// Largest number of solutions in the search for forces that only push.
pub const MOST_ROUNDS: usize = 8;
/// A point pulls if its normal force is below minus this part of the total.
const PULL_TOLERANCE: f64 = 1e-3;

/// Linear map from the total ground wrench to the wrench on each touching segment.
#[derive(Clone, Debug)]
pub struct Sharing {
    /// Point about which wrenches are taken, world, m.
    pub reference: Vec3,
    gram: [Mat6; SEGMENT_COUNT],
    active: [bool; SEGMENT_COUNT],
    pinv: Mat6,
    /// Independent wrench directions that the points can give (6 for a set with an area, 5 on an edge, 3 on a point).
    pub rank: usize,
}

impl Default for Sharing {
    fn default() -> Self {
        Self {
            reference: Vec3::zero(),
            gram: [[[0.0; 6]; 6]; SEGMENT_COUNT],
            active: [false; SEGMENT_COUNT],
            pinv: [[0.0; 6]; 6],
            rank: 0,
        }
    }
}

/// Weight of a point in the norm of the forces: that of its support, less for toes.
pub fn point_weight(p: &SupportPoint, ratio: &[f64; SEGMENT_COUNT]) -> f64 {
    let toes = p.segment == L_TOES || p.segment == R_TOES;
    ratio[p.support.index()].max(LEAST_WEIGHT) * if toes { TOE_WEIGHT } else { 1.0 }
}

/// Weight of forces along the surface relative to that of the force into it.
fn along(p: &SupportPoint) -> f64 {
    if p.vertex == NO_VERTEX {
        ALONG_REST
    } else {
        1.0
    }
}

impl Sharing {
    /// Balanced sharing over the points that are not `excluded` (by index). No allocation. Returns false if no point
    /// remains.
    ///
    /// Repair S2.
    pub fn set_balanced(
        &mut self,
        points: &[SupportPoint],
        ratio: &[f64; SEGMENT_COUNT],
        excluded: &[bool],
    ) -> bool {
        self.active = [false; SEGMENT_COUNT];
        self.rank = 0;
        let (mut sum, mut count) = (Vec3::zero(), 0.0);
        let kept = || {
            let k = points.iter().zip(excluded);
            k.filter(|(_, out)| !**out).map(|(p, _)| p)
        };
        for p in kept() {
            sum += p.position;
            count += 1.0;
        }
        if count == 0.0 {
            return false;
        }
        self.reference = sum * (1.0 / count);
        let mut total = [[0.0; 6]; 6];
        for p in kept() {
            let (s, d) = (p.segment.index(), point_weight(p, ratio));
            if !self.active[s] {
                self.active[s] = true;
                self.gram[s] = [[0.0; 6]; 6];
            }
            // A_k A_kᵀ with A_k = [[r]×; 1]: blocks |r|²1 − r rᵀ, [r]×, [r]×ᵀ, 1.
            let r = p.position - self.reference;
            let (x, y, z) = (r.x, r.y, r.z);
            let a = [
                [y * y + z * z, -x * y, -x * z, 0.0, -z, y],
                [-x * y, x * x + z * z, -y * z, z, 0.0, -x],
                [-x * z, -y * z, x * x + y * y, -y, x, 0.0],
                [0.0, z, -y, 1.0, 0.0, 0.0],
                [-z, 0.0, x, 0.0, 1.0, 0.0],
                [y, -x, 0.0, 0.0, 0.0, 1.0],
            ];
            let along = along(p);
            let n = p.normal;
            let m = r.cross(n);
            let into = [m.x, m.y, m.z, n.x, n.y, n.z];
            for i in 0..6 {
                for j in 0..6 {
                    let mut x = d * a[i][j];
                    if along < 1.0 {
                        x = along * x + (1.0 - along) * d * into[i] * into[j];
                    }
                    self.gram[s][i][j] += x;
                    total[i][j] += x;
                }
            }
        }
        let scale = |i: usize| if i < 3 { 1.0 / MOMENT_LENGTH } else { 1.0 };
        for i in 0..6 {
            for j in 0..6 {
                total[i][j] *= scale(i) * scale(j);
            }
        }
        (self.pinv, self.rank) = pseudo_inverse(&total);
        for i in 0..6 {
            for j in 0..6 {
                self.pinv[i][j] *= scale(i) * scale(j);
            }
        }
        true
    }

    /// Balanced sharing in which points that would have to pull carry nothing.
    ///
    /// The smallest forces may be negative when the load is near an edge, and a foot that has to supply such a wrench
    /// rolls over its edge. Therefore the point that pulls most is left out and the rest is solved again, as long as
    /// the others can still give every wrench that the whole set could give.
    ///
    /// * `excluded`: points that carry nothing from the start (by index); points that are left out are added.
    /// * `total`: wrench (moment, force) to be shared, about the given world point.
    /// * Returns false if there is no point. At most [`MOST_ROUNDS`] solutions; no allocation.
    ///
    /// Repair S2.
    pub fn set_unilateral(
        &mut self,
        points: &[SupportPoint],
        ratio: &[f64; SEGMENT_COUNT],
        excluded: &mut [bool],
        total: impl Fn(Vec3) -> [f64; 6],
    ) -> bool {
        if !self.set_balanced(points, ratio, excluded) {
            return false;
        }
        let full = self.rank;
        for _ in 1..MOST_ROUNDS {
            let w = total(self.reference);
            let y = self.multiplier(&w);
            let (mut worst, mut least) = (None, -PULL_TOLERANCE * w[5].abs());
            for (k, p) in points.iter().enumerate().filter(|(k, _)| !excluded[*k]) {
                let normal = self.point_force(p, ratio, &y).dot(p.normal);
                if normal < least {
                    (worst, least) = (Some(k), normal);
                }
            }
            let Some(k) = worst else {
                return true;
            };
            excluded[k] = true;
            if !self.set_balanced(points, ratio, excluded) || self.rank < full {
                excluded[k] = false;
                return self.set_balanced(points, ratio, excluded);
            }
        }
        true
    }

    /// Whether the segment has points that carry load.
    pub fn carries(&self, s: usize) -> bool {
        self.active[s]
    }

    /// G_s: point forces `D Aᵀ y` of segment s give the wrench `G_s y` about [`Self::reference`].
    pub fn gram(&self, s: usize) -> &Mat6 {
        &self.gram[s]
    }

    /// y = G⁺ W for a total wrench W about [`Self::reference`] (moment, force).
    pub fn multiplier(&self, wrench: &[f64; 6]) -> [f64; 6] {
        mul(&self.pinv, wrench)
    }

    /// Wrench on segment `s` about [`Self::reference`] from the multiplier; zero if it carries nothing.
    pub fn segment_wrench(&self, s: usize, multiplier: &[f64; 6]) -> [f64; 6] {
        if self.active[s] {
            mul(&self.gram[s], multiplier)
        } else {
            [0.0; 6]
        }
    }

    /// Force at one point from the multiplier, N.
    pub fn point_force(
        &self,
        p: &SupportPoint,
        ratio: &[f64; SEGMENT_COUNT],
        multiplier: &[f64; 6],
    ) -> Vec3 {
        let y = multiplier;
        let (m, f) = (vec3(y[0], y[1], y[2]), vec3(y[3], y[4], y[5]));
        let g = (f + m.cross(p.position - self.reference)) * point_weight(p, ratio);
        match along(p) {
            1.0 => g,
            along => g * along + p.normal * ((1.0 - along) * p.normal.dot(g)),
        }
    }
}

/// Product of a 6×6 matrix and a vector.
pub(crate) fn mul(m: &Mat6, v: &[f64; 6]) -> [f64; 6] {
    std::array::from_fn(|i| (0..6).map(|j| m[i][j] * v[j]).sum())
}

/// Pseudo-inverse of a symmetric positive semidefinite matrix, eigenvalues below [`CUT_OFF`] of the largest cut off;
/// and its rank.
///
/// Cyclic Jacobi rotations: only square roots, the same bits on every platform.
fn pseudo_inverse(a: &Mat6) -> (Mat6, usize) {
    let mut a = *a;
    let mut v = [[0.0; 6]; 6];
    for (i, row) in v.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    let trace: f64 = (0..6).map(|i| a[i][i].abs()).sum();
    for _ in 0..30 {
        let mut off = 0.0;
        for i in 0..6 {
            for j in i + 1..6 {
                off += a[i][j] * a[i][j];
            }
        }
        if off <= 1e-32 * trace * trace {
            break;
        }
        for p in 0..6 {
            for q in p + 1..6 {
                if a[p][q] == 0.0 {
                    continue;
                }
                let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
                let c = 1.0 / (t * t + 1.0).sqrt();
                let s = t * c;
                for k in 0..6 {
                    let (x, y) = (a[k][p], a[k][q]);
                    (a[k][p], a[k][q]) = (c * x - s * y, s * x + c * y);
                }
                for k in 0..6 {
                    let (x, y) = (a[p][k], a[q][k]);
                    (a[p][k], a[q][k]) = (c * x - s * y, s * x + c * y);
                }
                for row in &mut v {
                    let (x, y) = (row[p], row[q]);
                    (row[p], row[q]) = (c * x - s * y, s * x + c * y);
                }
            }
        }
    }
    let largest = (0..6).map(|i| a[i][i]).fold(0.0, f64::max);
    let (mut out, mut rank) = ([[0.0; 6]; 6], 0);
    for k in 0..6 {
        if a[k][k] > CUT_OFF * largest {
            rank += 1;
            for i in 0..6 {
                for j in 0..6 {
                    out[i][j] += v[i][k] * v[j][k] / a[k][k];
                }
            }
        }
    }
    (out, rank)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::topology::{L_FOOT, R_FOOT};
    use crate::support::testing::Rng;

    /// Two square feet of 20 × 8 cm at y = ±0.1, shifted by `at`.
    fn stance(at: Vec3) -> Vec<SupportPoint> {
        let mut out = Vec::new();
        for (segment, y) in [(L_FOOT, 0.1), (R_FOOT, -0.1)] {
            for (vertex, (dx, dy)) in [(-0.05, -0.04), (0.15, -0.04), (0.15, 0.04), (-0.05, 0.04)]
                .into_iter()
                .enumerate()
            {
                out.push(SupportPoint {
                    segment,
                    vertex,
                    support: segment,
                    position: at + vec3(dx, y + dy, 0.0),
                    normal: Vec3::Z,
                });
            }
        }
        out
    }
    fn even() -> [f64; SEGMENT_COUNT] {
        let mut r = [0.0; SEGMENT_COUNT];
        (r[L_FOOT.index()], r[R_FOOT.index()]) = (0.5, 0.5);
        r
    }
    /// Wrench of a force at a point, about `about`.
    fn wrench(at: Vec3, f: Vec3, about: Vec3) -> [f64; 6] {
        let n = (at - about).cross(f);
        [n.x, n.y, n.z, f.x, f.y, f.z]
    }

    /// Repair S2.
    #[test]
    fn point_forces_add_up_to_the_total_wrench() {
        let mut rng = Rng::new(11);
        for k in 0..200 {
            let at = vec3(rng.unit() * 100.0, rng.unit() * 100.0, 0.0);
            let (points, mut ratio) = (stance(at), even());
            ratio[L_FOOT.index()] = 0.5 + 0.5 * rng.unit();
            ratio[R_FOOT.index()] = 1.0 - ratio[L_FOOT.index()];
            let mut s = Sharing::default();
            assert!(s.set_balanced(&points, &ratio, &[false; 8]));
            assert_eq!(s.rank, 6, "round {k}");
            let w: [f64; 6] = std::array::from_fn(|_| 700.0 * rng.unit());
            let y = s.multiplier(&w);
            let mut total = [0.0; 6];
            let mut by_segment = [0.0; 6];
            for p in &points {
                let f = s.point_force(p, &ratio, &y);
                let one = wrench(p.position, f, s.reference);
                (0..6).for_each(|i| total[i] += one[i]);
            }
            for g in [L_FOOT, R_FOOT] {
                let one = s.segment_wrench(g.index(), &y);
                (0..6).for_each(|i| by_segment[i] += one[i]);
            }
            for i in 0..6 {
                assert!((total[i] - w[i]).abs() < 1e-9 * 700.0, "{total:?} {w:?}");
                assert!((by_segment[i] - w[i]).abs() < 1e-9 * 700.0);
            }
        }
    }

    /// Repair S2.
    #[test]
    fn symmetric_stance_shares_evenly_and_weight_over_one_foot_stays_there() {
        let (points, ratio) = (stance(vec3(3.0, -2.0, 0.0)), even());
        let mut s = Sharing::default();
        s.set_balanced(&points, &ratio, &[false; 8]);
        let weight = vec3(0.0, 0.0, 700.0);
        let share = |s: &Sharing, com: Vec3| {
            let y = s.multiplier(&wrench(com, weight, s.reference));
            s.segment_wrench(L_FOOT.index(), &y)[5] / 700.0
        };
        assert!((share(&s, vec3(3.05, -2.0, 1.0)) - 0.5).abs() < 1e-12);
        assert!(share(&s, vec3(3.05, -1.9, 1.0)) > 0.9);
    }

    #[test]
    fn unilateral_sharing_pushes_only_and_keeps_the_total() {
        let mut rng = Rng::new(12);
        let (points, ratio) = (stance(Vec3::zero()), even());
        let mut s = Sharing::default();
        for round in 0..200 {
            // Weight somewhere inside the hull of both feet, with a modest horizontal force.
            let at = vec3(rng.between(-0.03, 0.13), rng.between(-0.12, 0.12), 0.0);
            let force = vec3(30.0 * rng.unit(), 30.0 * rng.unit(), 700.0);
            let mut out = [false; 8];
            assert!(s.set_unilateral(&points, &ratio, &mut out, |p| wrench(at, force, p)));
            let y = s.multiplier(&wrench(at, force, s.reference));
            let (mut total, mut least) = ([0.0; 6], 0.0f64);
            for (p, _) in points.iter().zip(out).filter(|(_, o)| !o) {
                let f = s.point_force(p, &ratio, &y);
                least = least.min(f.z);
                let one = wrench(p.position, f, s.reference);
                (0..6).for_each(|i| total[i] += one[i]);
            }
            let w = wrench(at, force, s.reference);
            for i in 0..6 {
                assert!((total[i] - w[i]).abs() < 1e-6 * 700.0, "round {round}");
            }
            assert!(least > -0.05 * 700.0, "round {round}: {least}");
        }
        // With the weight above the middle of the left foot, the far edge of the right foot would pull, so it is left
        // out.
        let mut out = [false; 8];
        let at = vec3(0.05, 0.1, 0.0);
        s.set_unilateral(&points, &ratio, &mut out, |p| {
            wrench(at, vec3(0.0, 0.0, 700.0), p)
        });
        assert!(out[4..].iter().any(|o| *o) && !out[..4].iter().all(|o| *o));
    }

    #[test]
    fn edge_and_vertex_lose_the_moments_they_cannot_give() {
        let (points, ratio) = (stance(Vec3::zero()), even());
        let mut s = Sharing::default();
        let except = |keep: &dyn Fn(&SupportPoint) -> bool| -> Vec<bool> {
            points.iter().map(|p| !keep(p)).collect()
        };
        s.set_balanced(&points, &ratio, &except(&|p| p.position.x > 0.1));
        assert_eq!(s.rank, 5);
        s.set_balanced(
            &points,
            &ratio,
            &except(&|p| p.segment == L_FOOT && p.vertex == 1),
        );
        assert_eq!(s.rank, 3);
        assert!(!s.set_balanced(&points, &ratio, &[true; 8]));
    }

    #[test]
    fn pseudo_inverse_inverts_on_the_range() {
        let mut rng = Rng::new(5);
        for round in 0..100 {
            let rank = 1 + round % 6;
            let b: Vec<[f64; 6]> = (0..rank)
                .map(|_| std::array::from_fn(|_| rng.unit()))
                .collect();
            let mut a = [[0.0; 6]; 6];
            for v in &b {
                for i in 0..6 {
                    for j in 0..6 {
                        a[i][j] += v[i] * v[j];
                    }
                }
            }
            let (p, r) = pseudo_inverse(&a);
            assert!(r <= rank);
            if r < rank {
                continue; // an accidental near-dependence, cut off as it should be
            }
            for v in &b {
                let back = mul(&a, &mul(&p, v));
                for i in 0..6 {
                    assert!((back[i] - v[i]).abs() < 1e-8);
                }
            }
        }
    }
}
