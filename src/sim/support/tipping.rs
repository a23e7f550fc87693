//! Minimum-moment point and the axes about which a support tips (`docs/equations.md#repairs`).

use super::{Feature, Polygon, Rest};
use crate::body::SegmentId;
use crate::dynamics::Terms;
use crate::math::dense::solve_up_to_2;
use crate::math::{Vec3, vec3::vec3};

/// A corner that moves down faster than this blocks the rotation, m/s.
const BLOCKED: f64 = 1e-9;

/// The point at which a support tips, and the axes about which it does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pivot {
    /// The minimum-moment point, world, m.
    pub point: Vec3,
    axes: [Vec3; 2],
    count: usize,
}

impl Pivot {
    /// A pivot on an edge: one free axis (unit vector, horizontal).
    pub fn edge(point: Vec3, axis: Vec3) -> Self {
        Self {
            point,
            axes: [axis, Vec3::zero()],
            count: 1,
        }
    }
    /// A pivot on a vertex: both horizontal axes are free, friction holds the yaw.
    pub fn vertex(point: Vec3) -> Self {
        Self {
            point,
            axes: [Vec3::X, Vec3::Y],
            count: 2,
        }
    }
    /// Free axes, unit vectors.
    pub fn axes(&self) -> &[Vec3] {
        &self.axes[..self.count]
    }
    /// The part of a rotation vector along the free axes.
    pub fn project(&self, w: Vec3) -> Vec3 {
        self.axes()
            .iter()
            .fold(Vec3::zero(), |s, u| s + *u * u.dot(w))
    }
    /// Distance of a point from the part that stays on the floor, which is the edge line or the vertex, m.
    pub fn distance(&self, p: Vec3) -> f64 {
        let mut r = p - self.point;
        if self.count == 1 {
            r = r - self.axes[0] * self.axes[0].dot(r);
        }
        r.norm()
    }
}

/// The pivot of a figure whose zero-moment point, evaluated with the support at rest, is `zmp`; `None` if the support
/// does not move.
///
/// Outside the polygon the pivot is its closest point (minimum-moment point). On an edge or a vertex the figure is
/// already tilted, and pivots on the touching edge or vertex, on whichever side the zero-moment point lies.
///
/// Repair S1.
pub fn pivot(polygon: &Polygon, zmp: Vec3) -> Option<Pivot> {
    let c = polygon.closest([zmp.x, zmp.y])?;
    let point = vec3(c.point[0], c.point[1], 0.0);
    match c.feature {
        Feature::Inside => None,
        Feature::Edge(i) => {
            let u = polygon.edge_direction(i);
            Some(Pivot::edge(point, vec3(u[0], u[1], 0.0)))
        }
        Feature::Vertex(_) => Some(Pivot::vertex(point)),
    }
}

/// As [`pivot`], for support `s` of the state in `terms`: a rotation about a vertex that would push a neighbouring
/// corner into the floor is blocked by that corner, so that only rotation about the edge between the two remains.
///
/// * `force`, `moment` (about the world origin): the ground wrench that the accelerations with the support *at rest*
///   would need; its zero-moment point is `zmp`.
/// * `dt`: tick, s.
pub fn unblocked_pivot(
    terms: &Terms,
    polygon: &Polygon,
    s: SegmentId,
    (zmp, force, moment): (Vec3, Vec3, Vec3),
    dt: f64,
) -> Option<Pivot> {
    let c = polygon.closest([zmp.x, zmp.y])?;
    let p = pivot(polygon, zmp)?;
    let (Feature::Vertex(i), n) = (c.feature, polygon.corners().len()) else {
        return Some(p);
    };
    let spin = terms.kin.omega[s.index()] + tipping_acceleration(terms, &p, force, moment) * dt;
    let spin = p.project(spin);
    let (mut out, mut deepest) = (p, -BLOCKED);
    for j in [(i + 1) % n, (i + n - 1) % n] {
        let to = polygon.corners()[j];
        let r = vec3(to[0], to[1], 0.0) - p.point;
        let down = spin.cross(r).z;
        if down < deepest {
            (out, deepest) = (Pivot::edge(p.point, r * (1.0 / r.norm())), down);
        }
    }
    Some(out)
}

/// Whether a rotation about the pivot would push a part into something that it rests on. A hand on a wall or a table
/// stops the rotation about the foot's edge (figure 3 of the paper).
///
/// * `spin`: angular velocity that the support is about to have, rad/s. Only its part along the free axes counts.
pub fn is_stopped<'a>(
    pivot: &Pivot,
    spin: Vec3,
    mut rests: impl Iterator<Item = &'a Rest>,
) -> bool {
    let spin = pivot.project(spin);
    rests.any(|r| spin.cross(r.position - pivot.point).dot(r.normal) < -BLOCKED)
}

/// Rotational acceleration of a tipping support, rad/s² (world axes): ω̇ = −U (Uᵀ I_p U)⁻¹ Uᵀ n_p.
///
/// * I_p: inertia of all segments about the pivot.
/// * `force`, `moment` (about the world origin): the ground wrench that the accelerations with the support *at rest*
///   would need.
///
/// Repair S1.
pub fn tipping_acceleration(terms: &Terms, pivot: &Pivot, force: Vec3, moment: Vec3) -> Vec3 {
    let n = moment - pivot.point.cross(force);
    let (e, u) = (base_directions(terms, pivot), pivot.axes());
    let mut g = [[0.0; 2]; 2];
    for (i, a) in e.iter().enumerate().take(u.len()) {
        for (j, b) in e.iter().enumerate().take(u.len()) {
            g[i][j] = base_product(terms, a, b);
        }
    }
    let rhs = [u[0].dot(n), u.get(1).map_or(0.0, |a| a.dot(n))];
    let w = solve_up_to_2(&g, rhs, u.len());
    u.iter().zip(w).fold(Vec3::zero(), |s, (a, w)| s - *a * w)
}

/// Pelvis velocity (angular, linear) for unit rotation of the whole stiff body about the pivot along each free axis:
/// the base rows of `E` (`docs/equations.md#repairs`). Unused entries are zero.
pub(crate) fn base_directions(terms: &Terms, pivot: &Pivot) -> [[f64; 6]; 2] {
    let arm = terms.segment_position(0) - pivot.point;
    let mut e = [[0.0; 6]; 2];
    for (out, u) in e.iter_mut().zip(pivot.axes()) {
        let v = u.cross(arm);
        *out = [u.x, u.y, u.z, v.x, v.y, v.z];
    }
    e
}

/// `aᵀ M_bb b` for two pelvis velocities: with those of [`base_directions`], the inertia of all segments about the
/// pivot axes.
pub(crate) fn base_product(terms: &Terms, a: &[f64; 6], b: &[f64; 6]) -> f64 {
    let mut s = 0.0;
    for i in 0..6 {
        for j in 0..6 {
            s += a[i] * terms.m[i][j] * b[j];
        }
    }
    s
}
