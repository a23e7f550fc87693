//! Convex polygons on the ground plane: hull, margin, closest point, inset.
//!
//! The support polygon is often degenerate (a figure on the edge of a shoe or on one corner), so a point and a segment
//! are polygons here too, and thin sets are reduced to them. Buffers are kept between ticks: nothing allocates once
//! they have grown.

/// Distance below which points count as one, m.
const SAME_POINT: f64 = 1e-7;
/// A set narrower than this is an edge, one shorter than this is a vertex (ALGORITHM §6), m.
pub const THIN: f64 = 0.01;

/// Corners of a convex set, counter-clockwise seen from above; one corner is a point, two are a segment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polygon {
    corners: Vec<[f64; 2]>,
    scratch: Vec<[f64; 2]>,
}

/// Which part of a polygon is closest to a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// The point is inside (or on the border); the polygon has an area.
    Inside,
    /// The edge from this corner to the next one.
    Edge(usize),
    /// This corner.
    Vertex(usize),
}

/// The point of a polygon that is closest to a given point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// The closest point; the given point itself when it is inside.
    pub point: [f64; 2],
    /// Where that is.
    pub feature: Feature,
    /// Signed distance to the border, m: positive inside.
    pub margin: f64,
}

fn sub(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}
fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
fn length(a: [f64; 2]) -> f64 {
    dot(a, a).sqrt()
}

impl Polygon {
    /// An empty polygon with room for `capacity` points.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            corners: Vec::with_capacity(capacity + 1),
            scratch: Vec::with_capacity(capacity + 1),
        }
    }

    /// Corners, counter-clockwise.
    pub fn corners(&self) -> &[[f64; 2]] {
        &self.corners
    }

    /// True if there is no corner at all.
    pub fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }

    /// True if the polygon has an area (three corners or more).
    pub fn has_area(&self) -> bool {
        self.corners.len() >= 3
    }

    /// Becomes the convex hull of `points` (monotone chain). Points closer than 0.1 µm are merged; collinear ones are
    /// left out.
    ///
    /// O(k log k) for k points; allocates only while the buffers grow.
    pub fn set_hull(&mut self, points: impl Iterator<Item = [f64; 2]>) {
        let p = &mut self.scratch;
        p.clear();
        p.extend(points);
        p.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        p.dedup_by(|a, b| length(sub(*a, *b)) <= SAME_POINT);
        let h = &mut self.corners;
        h.clear();
        if p.len() <= 2 {
            h.extend_from_slice(p);
            return;
        }
        // Lower chain from left to right, then the upper one back; a corner that does not turn left is no corner.
        for &q in p.iter() {
            while h.len() >= 2 && !turns_left(h[h.len() - 2], h[h.len() - 1], q) {
                h.pop();
            }
            h.push(q);
        }
        let lower = h.len();
        for &q in p.iter().rev().skip(1) {
            while h.len() > lower && !turns_left(h[h.len() - 2], h[h.len() - 1], q) {
                h.pop();
            }
            h.push(q);
        }
        h.pop(); // the first corner again
    }

    /// Reduces a set thinner than [`THIN`] to its longest extent, and one shorter than [`THIN`] to its middle.
    pub fn reduce_thin(&mut self) {
        let c = &self.corners;
        if c.len() < 2 {
            return;
        }
        let (mut a, mut b, mut longest) = (c[0], c[0], 0.0);
        for i in 0..c.len() {
            for j in i + 1..c.len() {
                let d = length(sub(c[j], c[i]));
                if d > longest {
                    (a, b, longest) = (c[i], c[j], d);
                }
            }
        }
        if longest < THIN {
            let m = self.centroid().unwrap_or(a);
            self.corners.clear();
            self.corners.push(m);
            return;
        }
        if c.len() > 2 && self.width() < THIN {
            self.corners.clear();
            self.corners.extend_from_slice(&[a, b]);
        }
    }

    /// Least distance between two parallel lines that hold the set, m; 0 for a point or a segment.
    pub fn width(&self) -> f64 {
        let c = &self.corners;
        if c.len() < 3 {
            return 0.0;
        }
        let mut width = f64::INFINITY;
        for i in 0..c.len() {
            let e = sub(c[(i + 1) % c.len()], c[i]);
            let reach = c
                .iter()
                .map(|q| cross(e, sub(*q, c[i])))
                .fold(0.0, f64::max);
            width = width.min(reach / length(e));
        }
        width
    }

    /// Mean of the corners; `None` if empty.
    pub fn centroid(&self) -> Option<[f64; 2]> {
        let k = self.corners.len() as f64;
        if self.corners.is_empty() {
            return None;
        }
        let s = self
            .corners
            .iter()
            .fold([0.0; 2], |s, c| [s[0] + c[0], s[1] + c[1]]);
        Some([s[0] / k, s[1] / k])
    }

    /// Closest point to `z`, its feature and the signed margin; `None` if the polygon is empty or `z` is not finite.
    pub fn closest(&self, z: [f64; 2]) -> Option<Closest> {
        let c = &self.corners;
        if c.is_empty() || !(z[0].is_finite() && z[1].is_finite()) {
            return None;
        }
        if c.len() == 1 {
            return Some(Closest {
                point: c[0],
                feature: Feature::Vertex(0),
                margin: -length(sub(z, c[0])),
            });
        }
        let edges = if c.len() == 2 { 1 } else { c.len() };
        let (mut inside, mut margin) = (c.len() >= 3, f64::INFINITY);
        let (mut best, mut best_distance) = ((c[0], Feature::Vertex(0)), f64::INFINITY);
        for i in 0..edges {
            let j = (i + 1) % c.len();
            let e = sub(c[j], c[i]);
            let s = cross(e, sub(z, c[i]));
            margin = margin.min(s / length(e));
            inside &= s >= 0.0;
            let t = dot(sub(z, c[i]), e) / dot(e, e);
            let (p, f) = if t <= 0.0 {
                (c[i], Feature::Vertex(i))
            } else if t >= 1.0 {
                (c[j], Feature::Vertex(j))
            } else {
                ([c[i][0] + t * e[0], c[i][1] + t * e[1]], Feature::Edge(i))
            };
            let d = length(sub(z, p));
            if d < best_distance {
                (best, best_distance) = ((p, f), d);
            }
        }
        Some(if inside {
            Closest {
                point: z,
                feature: Feature::Inside,
                margin,
            }
        } else {
            Closest {
                point: best.0,
                feature: best.1,
                margin: -best_distance,
            }
        })
    }

    /// Unit direction of the edge from corner `i` to the next one.
    pub fn edge_direction(&self, i: usize) -> [f64; 2] {
        let e = sub(self.corners[(i + 1) % self.corners.len()], self.corners[i]);
        let l = length(e).max(SAME_POINT);
        [e[0] / l, e[1] / l]
    }

    /// Becomes `of` with every edge moved inwards by `distance` (m). A polygon that would vanish is inset by half as
    /// much, and so on; a point or a segment, and a polygon too small for any inset, becomes its middle.
    pub fn set_inset(&mut self, of: &Polygon, distance: f64) {
        let mut d = distance;
        for _ in 0..6 {
            if of.has_area() && self.try_inset(of, d) {
                return;
            }
            d *= 0.5;
        }
        self.corners.clear();
        self.corners.extend(of.centroid());
    }

    /// Cuts `of` with each of its edges' half-planes, moved inwards; false if nothing with an area is left.
    fn try_inset(&mut self, of: &Polygon, distance: f64) -> bool {
        let (c, n) = (&of.corners, of.corners.len());
        self.corners.clear();
        self.corners.extend_from_slice(c);
        for i in 0..n {
            let e = sub(c[(i + 1) % n], c[i]);
            let (a, l) = (c[i], length(e));
            let depth = |q: [f64; 2]| cross(e, sub(q, a)) / l - distance;
            std::mem::swap(&mut self.corners, &mut self.scratch);
            self.corners.clear();
            for k in 0..self.scratch.len() {
                let (p, q) = (self.scratch[k], self.scratch[(k + 1) % self.scratch.len()]);
                let (dp, dq) = (depth(p), depth(q));
                if dp >= 0.0 {
                    self.corners.push(p);
                }
                if (dp > 0.0 && dq < 0.0) || (dp < 0.0 && dq > 0.0) {
                    let t = dp / (dp - dq);
                    self.corners
                        .push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
                }
            }
        }
        self.corners.len() >= 3
    }
}

/// True if the way from `a` over `b` to `c` bends left by more than rounding.
fn turns_left(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> bool {
    let (u, v) = (sub(b, a), sub(c, b));
    cross(u, v) > 1e-9 * length(u) * length(v)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::support::testing::Rng;

    fn hull(points: &[[f64; 2]]) -> Polygon {
        let mut p = Polygon::default();
        p.set_hull(points.iter().copied());
        p
    }
    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

    #[test]
    fn hull_of_square_drops_inner_double_and_collinear_points() {
        let mut p = SQUARE.to_vec();
        p.extend([
            [0.5, 0.5],
            [1.0, 0.0],
            [0.5, 0.0],
            [0.0, 0.3],
            [1.0, 1.0 - 1e-9],
        ]);
        let h = hull(&p);
        assert_eq!(h.corners().len(), 4);
        for q in SQUARE {
            assert!(h.corners().iter().any(|c| length(sub(*c, q)) < 1e-8));
        }
    }

    #[test]
    fn hull_is_convex_and_holds_every_point() {
        let mut rng = Rng::new(3);
        for round in 0..300 {
            let n = 1 + round % 40;
            let p: Vec<_> = (0..n).map(|_| [rng.unit(), rng.unit()]).collect();
            let h = hull(&p);
            let c = h.corners();
            if c.len() < 3 {
                continue;
            }
            for i in 0..c.len() {
                let (a, b) = (c[i], c[(i + 1) % c.len()]);
                for q in &p {
                    assert!(cross(sub(b, a), sub(*q, a)) > -1e-9);
                }
            }
        }
    }

    #[test]
    fn degenerate_sets_are_points_and_segments() {
        assert!(hull(&[]).is_empty() && hull(&[]).closest([0.0, 0.0]).is_none());
        assert_eq!(hull(&[[1.0, 2.0]; 5]).corners(), &[[1.0, 2.0]]);
        let line: Vec<_> = (0..7)
            .map(|i| [0.1 * f64::from(i), 0.2 * f64::from(i)])
            .collect();
        assert_eq!(hull(&line).corners().len(), 2);
        let c = hull(&line).closest([0.3, 0.6 + 1.0]).unwrap();
        assert!(matches!(c.feature, Feature::Vertex(_) | Feature::Edge(0)) && c.margin < 0.0);
    }

    #[test]
    fn thin_sets_reduce_to_edge_and_vertex() {
        let mut p = hull(&[[0.0, 0.0], [0.1, 0.0], [0.1, 0.009], [0.0, 0.009]]);
        p.reduce_thin();
        assert_eq!(p.corners().len(), 2);
        let mut p = hull(&[[0.0, 0.0], [0.005, 0.0], [0.0, 0.005]]);
        p.reduce_thin();
        assert_eq!(p.corners().len(), 1);
        let mut p = hull(&SQUARE);
        p.reduce_thin();
        assert_eq!(p.corners().len(), 4);
    }

    #[test]
    fn margin_and_features_of_square() {
        let h = hull(&SQUARE);
        let c = h.closest([0.5, 0.2]).unwrap();
        assert_eq!(c.feature, Feature::Inside);
        assert!((c.margin - 0.2).abs() < 1e-15);
        let c = h.closest([0.4, -0.3]).unwrap();
        let Feature::Edge(i) = c.feature else {
            panic!("{c:?}")
        };
        assert!((h.edge_direction(i)[1]).abs() < 1e-15 && (c.margin + 0.3).abs() < 1e-15);
        assert!((c.point[0] - 0.4).abs() < 1e-15 && c.point[1].abs() < 1e-15);
        let c = h.closest([2.0, 2.0]).unwrap();
        assert!(matches!(c.feature, Feature::Vertex(i) if h.corners()[i] == [1.0, 1.0]));
        assert!(h.closest([f64::NAN, 0.0]).is_none());
    }

    #[test]
    fn inset_moves_every_edge_in_by_the_distance() {
        let h = hull(&SQUARE);
        let mut s = Polygon::default();
        s.set_inset(&h, 0.02);
        assert_eq!(s.corners().len(), 4);
        for c in s.corners() {
            assert!((h.closest(*c).unwrap().margin - 0.02).abs() < 1e-12);
        }
        // Narrower than twice the distance: inset by less, still inside.
        let h = hull(&[[0.0, 0.0], [0.3, 0.0], [0.3, 0.03], [0.0, 0.03]]);
        s.set_inset(&h, 0.02);
        assert!(s.has_area());
        for c in s.corners() {
            assert!(h.closest(*c).unwrap().margin >= 0.0099);
        }
        s.set_inset(&hull(&[[1.0, 1.0], [3.0, 1.0]]), 0.02);
        assert_eq!(s.corners(), &[[2.0, 1.0]]);
    }
}
