//! Capsules fitted to the segments of a body.

use crate::body::topology::{
    ABDOMEN, CHEST, L_FOOT, L_TOES, PELVIS, R_FOOT, R_TOES, SEGMENT_COUNT,
};
use crate::body::{Body, model::Mesh};
use crate::math::vec3::vec3;
use crate::math::{Mat3, Vec3};

/// All points within `ra…rb` of a line from `a` to `b`; the radius changes linearly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// One end of the axis, m.
    pub a: Vec3,
    /// The other end, m.
    pub b: Vec3,
    /// Radius at `a`, m.
    pub ra: f64,
    /// Radius at `b`, m.
    pub rb: f64,
}

impl Capsule {
    /// Radius of a ball around the middle of the axis that holds the capsule.
    pub fn reach(&self) -> f64 {
        0.5 * (self.b - self.a).norm() + self.ra.max(self.rb)
    }

    /// Its half at the first end; for a limb, the half away from the joint that carries it.
    pub fn first_half(&self) -> Self {
        Self {
            b: (self.a + self.b) * 0.5,
            rb: 0.5 * (self.ra + self.rb),
            ..*self
        }
    }

    /// The capsule of a segment whose origin is at `at` and that is turned by `turned`.
    pub fn placed(&self, at: Vec3, turned: &Mat3) -> Self {
        Self {
            a: at + *turned * self.a,
            b: at + *turned * self.b,
            ..*self
        }
    }
}

/// The shapes that a body collides with, by segment, in segment frames.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyShape {
    /// Capsules of each segment.
    pub capsules: [Vec<Capsule>; SEGMENT_COUNT],
    /// A ball that holds capsules and contact points of each segment: centre (segment frame, m), radius (m).
    pub bound: [(Vec3, f64); SEGMENT_COUNT],
}

impl BodyShape {
    /// Fits capsules to the surfaces of `body`. Offline: allocates.
    pub fn new(body: &Body) -> Self {
        let mut out = Self::default();
        for (s, segment) in body.segments.iter().enumerate() {
            let mesh = &segment.mesh;
            if mesh.vertices.len() >= 4 {
                out.capsules[s] = match s {
                    _ if s == PELVIS.index() || s == ABDOMEN.index() || s == CHEST.index() => {
                        trunk(mesh)
                    }
                    _ if [L_FOOT, R_FOOT, L_TOES, R_TOES]
                        .iter()
                        .any(|f| f.index() == s) =>
                    {
                        vec![along(mesh, 0)]
                    }
                    _ => vec![along(mesh, 2)],
                };
            }
            let points = segment.contact_points.iter().map(|p| (*p, 0.0));
            let ends = out.capsules[s]
                .iter()
                .flat_map(|c| [(c.a, c.ra), (c.b, c.rb)]);
            let all: Vec<(Vec3, f64)> = points.chain(ends).collect();
            let n = all.len().max(1) as f64;
            let centre = all.iter().fold(Vec3::zero(), |z, (p, _)| z + *p) * (1.0 / n);
            let radius = all
                .iter()
                .map(|(p, r)| (*p - centre).norm() + r)
                .fold(0.0, f64::max);
            out.bound[s] = (centre, radius);
        }
        out
    }
}

fn component(v: Vec3, axis: usize) -> f64 {
    v.to_array()[axis]
}

/// Least and largest coordinate.
fn extent(mesh: &Mesh, axis: usize, keep: impl Fn(&Vec3) -> bool) -> Option<(f64, f64)> {
    let mut out: Option<(f64, f64)> = None;
    for v in mesh.vertices.iter().filter(|v| keep(v)) {
        let x = component(*v, axis);
        out = Some(out.map_or((x, x), |(l, h)| (l.min(x), h.max(x))));
    }
    out
}

/// Half extents and centre of the slice of `mesh` around `at` along `axis`.
fn slice(mesh: &Mesh, axis: usize, at: f64, half: f64) -> [(f64, f64); 2] {
    let near = |v: &Vec3| (component(*v, axis) - at).abs() <= half;
    let other = [(axis + 1) % 3, (axis + 2) % 3];
    other.map(|k| {
        let (l, h) = extent(mesh, k, near)
            .or_else(|| extent(mesh, k, |_| true))
            .unwrap_or((0.0, 0.0));
        (0.5 * (l + h), 0.5 * (h - l))
    })
}

/// One tapered capsule along a coordinate axis. Its radii are the mean half extents at a quarter of the length from the
/// ends, extrapolated to the ends, so that limbs taper. Its ends reach as far as the surface.
fn along(mesh: &Mesh, axis: usize) -> Capsule {
    let (low, high) = extent(mesh, axis, |_| true).unwrap_or((0.0, 0.0));
    let length = high - low;
    let end = |share: f64| {
        let c = slice(mesh, axis, low + share * length, 0.14 * length);
        let flat = c[0].1.min(c[1].1);
        // The radius of a flat part (hand, foot) is at most 1.5 times its half thickness.
        let radius = (0.5 * (c[0].1 + c[1].1)).min(1.5 * flat).min(0.45 * length);
        (c[0].0, c[1].0, radius)
    };
    let (l, h) = (end(0.25), end(0.75));
    let point = |x: f64, c: (f64, f64, f64)| {
        let mut p = [0.0; 3];
        p[axis] = x;
        p[(axis + 1) % 3] = c.0;
        p[(axis + 2) % 3] = c.1;
        vec3(p[0], p[1], p[2])
    };
    Capsule {
        a: point(low + l.2, l),
        b: point(high - h.2, h),
        ra: l.2,
        rb: h.2,
    }
}

/// Distance by which the capsules of the trunk may reach beyond the ends of their part, m.
const BULGE: f64 = 0.035;

/// Capsules from side to side, one above the other, as deep as the trunk is there.
fn trunk(mesh: &Mesh) -> Vec<Capsule> {
    let (low, high) = extent(mesh, 2, |_| true).unwrap_or((0.0, 0.0));
    let length = high - low;
    let rows = 3;
    (0..rows)
        .map(|i| {
            let z = low + length * (0.2 + 0.6 * f64::from(i) / f64::from(rows - 1));
            let [(x, depth), (y, width)] = slice(mesh, 2, z, 0.12 * length);
            let r = (0.92 * depth).min(0.5 * length);
            // Shoulders slope and the seat is flat: no bulge far beyond the ends.
            let z = z.clamp(low + r - BULGE, high - r + BULGE);
            let w = (0.96 * width - r).max(0.0);
            Capsule {
                a: vec3(x, y - w, z),
                b: vec3(x, y + w, z),
                ra: r,
                rb: r,
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    //! Goal: capsules lie close to the surface that they represent, and are mirror images of each other.
    use super::*;

    /// Distance of a point to the nearest capsule surface, negative inside.
    fn distance(capsules: &[Capsule], p: Vec3) -> f64 {
        capsules
            .iter()
            .map(|c| {
                let d = c.b - c.a;
                let t = ((p - c.a).dot(d) / d.dot(d).max(1e-12)).clamp(0.0, 1.0);
                (p - c.a - d * t).norm() - (c.ra + t * (c.rb - c.ra))
            })
            .fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn surfaces_are_within_a_few_centimetres_of_their_capsules() {
        for body in [Body::adult_man(), Body::adult_woman()] {
            let shape = BodyShape::new(&body);
            for (s, segment) in body.segments.iter().enumerate() {
                let d: Vec<f64> = segment
                    .mesh
                    .vertices
                    .iter()
                    .map(|v| distance(&shape.capsules[s], *v))
                    .collect();
                let out = d.iter().fold(0.0f64, |m, x| m.max(*x));
                let deep = d.iter().fold(0.0f64, |m, x| m.max(-x));
                println!(
                    "segment {s}: {:.0} mm out, {:.0} mm in",
                    1e3 * out,
                    1e3 * deep
                );
                assert!(out < 0.06 && deep < 0.05, "segment {s}: {out} {deep}");
            }
        }
    }
}
