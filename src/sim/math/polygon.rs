//! Convex polygons on the floor: hull, margin, nearest point, inset.
//!
//! One hull and one inset serve three storages: [`Polygon`] keeps its buffers from tick to tick, [`SmallPolygon`] is
//! plain data of fixed size, and the functions on slices allocate (offline). A point and a segment are polygons here
//! too, because a figure may stand on the edge of a shoe or on one corner.

use serde::{Deserialize, Serialize};

/// A point of the floor, m.
type Point = [f64; 2];

/// Distance below which points of a [`Polygon`] count as one, m.
const SAME_POINT: f64 = 1e-7;
/// Sine of the smallest turn that counts as a corner of a [`Polygon`].
const STRAIGHT: f64 = 1e-9;
/// A [`Polygon`] narrower than this is reduced to an edge, one shorter than this to a vertex, m.
pub const THIN: f64 = 0.01;
/// Largest number of corners of a [`SmallPolygon`]: enough for two feet.
const MOST: usize = 40;

fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}
fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
fn length(a: Point) -> f64 {
    dot(a, a).sqrt()
}

/// The length, rounded as clip preparation has always rounded it, so that recorded clips keep their bits.
fn hypot(a: Point) -> f64 {
    a[0].hypot(a[1])
}

/// Distance of `z` to the left of the line from `a` to `b`, m.
fn left_of(a: Point, b: Point, z: Point, length: impl Fn(Point) -> f64) -> f64 {
    let e = sub(b, a);
    cross(e, sub(z, a)) / length(e).max(1e-12)
}

fn by_coordinates(a: &Point, b: &Point) -> std::cmp::Ordering {
    a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
}

/// Mean of the corners; `None` if there are no corners.
fn middle(corners: &[Point]) -> Option<Point> {
    let k = corners.len() as f64;
    let sum = corners
        .iter()
        .fold([0.0; 2], |s, c| [s[0] + c[0], s[1] + c[1]]);
    (!corners.is_empty()).then(|| sum.map(|s| s / k))
}

/// A list of corners, on the heap or of fixed size.
trait Corners {
    fn list(&self) -> &[Point];
    fn push(&mut self, p: Point);
    fn pop(&mut self);
    fn clear(&mut self);
}

impl Corners for Vec<Point> {
    fn list(&self) -> &[Point] {
        self
    }
    fn push(&mut self, p: Point) {
        Vec::push(self, p);
    }
    fn pop(&mut self) {
        Vec::pop(self);
    }
    fn clear(&mut self) {
        Vec::clear(self);
    }
}

/// Appends the convex hull of `sorted` points, counter-clockwise (monotone chain, Andrew 1979): the lower chain from
/// left to right, then the upper one back.
///
/// * `straight`: whether the path from the first point through the second to the third does not turn left.
fn append_hull(
    sorted: &[Point],
    out: &mut impl Corners,
    straight: impl Fn(Point, Point, Point) -> bool,
) {
    let n = sorted.len();
    for back in [false, true] {
        let base = out.list().len();
        for k in 0..n {
            let q = sorted[if back { n - 1 - k } else { k }];
            while let [.., a, b] = out.list()[base..]
                && straight(a, b, q)
            {
                out.pop();
            }
            out.push(q);
        }
        if out.list().len() > base {
            out.pop(); // the last point begins the other chain
        }
    }
}

/// Whether the corner `b` does not turn left, compared exactly.
fn no_left_turn(a: Point, b: Point, c: Point) -> bool {
    cross(sub(b, a), sub(c, a)) <= 0.0
}

/// Leaves in `inner` the part of a convex polygon that is at least `distance` (m) inside: it is cut with the half-plane
/// of each edge, moved inwards.
///
/// * `crosses`: whether the border passes between corners of these two depths; decides the fate of corners on it.
/// * `length`: of an edge; [`length`] or [`hypot`], which round differently.
fn cut_edges<C: Corners>(
    of: &[Point],
    distance: f64,
    (inner, spare): (&mut C, &mut C),
    crosses: impl Fn(f64, f64) -> bool,
    length: impl Fn(Point) -> f64,
) {
    inner.clear();
    of.iter().for_each(|p| inner.push(*p));
    let n = of.len();
    for i in 0..n {
        let depth = |q: Point| left_of(of[i], of[(i + 1) % n], q, &length) - distance;
        std::mem::swap(inner, spare);
        inner.clear();
        let from = spare.list();
        for k in 0..from.len() {
            let (p, q) = (from[k], from[(k + 1) % from.len()]);
            let (dp, dq) = (depth(p), depth(q));
            if dp >= 0.0 {
                inner.push(p);
            }
            if crosses(dp, dq) {
                let t = dp / (dp - dq);
                inner.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
            }
        }
    }
}

/// The border passes between two corners unless both are outside or neither is.
fn one_outside(a: f64, b: f64) -> bool {
    (a >= 0.0) != (b >= 0.0)
}

/// Convex hull, counter-clockwise. Allocates.
pub fn hull(points: &[Point]) -> Vec<Point> {
    let mut p = points.to_vec();
    p.sort_by(by_coordinates);
    p.dedup();
    if p.len() < 3 {
        return p;
    }
    let mut out = Vec::with_capacity(p.len() + 1);
    append_hull(&p, &mut out, no_left_turn);
    out
}

/// Signed distance of `z` from the border of a convex counter-clockwise polygon: positive inside, m. For fewer than
/// three corners, minus the distance to the nearest one.
pub fn margin(polygon: &[Point], z: Point) -> f64 {
    let n = polygon.len();
    if n < 3 {
        let distances = polygon.iter().map(|p| hypot(sub(*p, z)));
        return -distances.fold(f64::INFINITY, f64::min);
    }
    let inside = (0..n)
        .map(|i| left_of(polygon[i], polygon[(i + 1) % n], z, hypot))
        .fold(f64::INFINITY, f64::min);
    if inside >= 0.0 {
        inside
    } else {
        -Region::new(polygon.to_vec()).border(z).0.sqrt()
    }
}

/// One side of a region.
#[derive(Clone, Copy, Debug)]
struct Edge {
    from: Point,
    /// Unit vector to the other end, and its distance, m.
    along: Point,
    length: f64,
}

/// A convex polygon whose sides are computed once, because many points are projected into it.
#[derive(Clone, Debug)]
pub struct Region {
    /// Counter-clockwise. A single point is stored as one edge of zero length.
    edges: Vec<Edge>,
}

impl Region {
    /// The polygon with these corners, counter-clockwise.
    fn new(corners: Vec<Point>) -> Self {
        let n = corners.len();
        let edges = (0..n).map(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % n]);
            let [dx, dy] = sub(b, a);
            let length = hypot([dx, dy]);
            let unit = 1.0 / length.max(1e-12);
            Edge {
                from: a,
                along: [dx * unit, dy * unit],
                length,
            }
        });
        Self {
            edges: edges.collect(),
        }
    }

    /// The part of a convex counter-clockwise polygon that is at least `inset` (m) inside; its middle if it is too
    /// narrow for that.
    pub fn inside(polygon: &[Point], inset: f64) -> Self {
        let (mut inner, mut spare) = (Vec::new(), Vec::new());
        if polygon.len() >= 3 {
            cut_edges(polygon, inset, (&mut inner, &mut spare), one_outside, hypot);
        }
        if inner.is_empty() {
            inner.extend(middle(polygon));
        }
        Self::new(inner)
    }

    /// The nearest point of the region; `z` itself if the region is empty. No allocation.
    pub fn nearest(&self, z: Point) -> Point {
        let left =
            |e: &Edge| e.along[0] * (z[1] - e.from[1]) - e.along[1] * (z[0] - e.from[0]) >= 0.0;
        if self.edges.len() >= 3 && self.edges.iter().all(left) {
            return z;
        }
        self.border(z).1
    }

    /// The nearest point on the border, and the square of its distance, m².
    fn border(&self, z: Point) -> (f64, Point) {
        let mut best = (f64::INFINITY, z);
        for e in &self.edges {
            let d = [z[0] - e.from[0], z[1] - e.from[1]];
            // Not `clamp`, which panics when a length is NaN.
            let u = (d[0] * e.along[0] + d[1] * e.along[1])
                .max(0.0)
                .min(e.length);
            let off = [u * e.along[0] - d[0], u * e.along[1] - d[1]];
            let far = off[0] * off[0] + off[1] * off[1];
            if far < best.0 {
                best = (far, [z[0] + off[0], z[1] + off[1]]);
            }
        }
        best
    }
}

/// Corners of a convex polygon without allocation, at most 40; any further corners are dropped.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(into = "Vec<Point>", try_from = "Vec<Point>")]
pub struct SmallPolygon {
    points: [Point; MOST],
    len: usize,
}

impl From<SmallPolygon> for Vec<Point> {
    fn from(p: SmallPolygon) -> Self {
        p.points[..p.len].to_vec()
    }
}

impl TryFrom<Vec<Point>> for SmallPolygon {
    type Error = &'static str;

    fn try_from(corners: Vec<Point>) -> Result<Self, Self::Error> {
        let mut out = Self::default();
        let to = out.points.get_mut(..corners.len());
        to.ok_or("too many corners")?.copy_from_slice(&corners);
        out.len = corners.len();
        Ok(out)
    }
}

impl Default for SmallPolygon {
    fn default() -> Self {
        Self {
            points: [[0.0; 2]; MOST],
            len: 0,
        }
    }
}

impl Corners for SmallPolygon {
    fn list(&self) -> &[Point] {
        &self.points[..self.len]
    }
    fn push(&mut self, p: Point) {
        if self.len < MOST {
            self.points[self.len] = p;
            self.len += 1;
        }
    }
    fn pop(&mut self) {
        self.len -= 1;
    }
    fn clear(&mut self) {
        self.len = 0;
    }
}

impl SmallPolygon {
    /// Adds a point.
    pub fn add(&mut self, p: Point) {
        self.push(p);
    }

    /// The part of the hull of the points that is at least `distance` (m) inside; its middle if it is too narrow for
    /// that; `None` if the hull has no area.
    pub fn inner(mut self, distance: f64) -> Option<Self> {
        self.points[..self.len].sort_unstable_by(by_coordinates);
        let mut hull = Self::default();
        append_hull(self.list(), &mut hull, no_left_turn);
        if hull.len < 3 {
            return None;
        }
        let (mut inner, mut spare) = (Self::default(), Self::default());
        cut_edges(
            hull.list(),
            distance,
            (&mut inner, &mut spare),
            one_outside,
            length,
        );
        if inner.len < 3 {
            inner.clear();
            middle(hull.list()).into_iter().for_each(|p| inner.push(p));
        }
        Some(inner)
    }

    /// The point of the polygon nearest to `z`, or `z` itself if the polygon is empty. The corners must form a convex
    /// polygon, counter-clockwise.
    pub fn nearest(&self, z: Point) -> Point {
        let m = self.len;
        let edge = |k: usize| {
            (
                self.points[k],
                sub(self.points[(k + 1) % m], self.points[k]),
            )
        };
        if m > 2 && (0..m).all(|k| cross(edge(k).1, sub(z, edge(k).0)) >= 0.0) {
            return z;
        }
        let mut best = (f64::INFINITY, z);
        for k in 0..m {
            let (a, e) = edge(k);
            let u = (dot(sub(z, a), e) / dot(e, e).max(1e-18)).clamp(0.0, 1.0);
            let p = [a[0] + u * e[0], a[1] + u * e[1]];
            let far = dot(sub(p, z), sub(p, z));
            if far < best.0 {
                best = (far, p);
            }
        }
        best.1
    }
}

/// Corners of a convex set, counter-clockwise seen from above; one corner is a point, two are a segment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Polygon {
    corners: Vec<Point>,
    #[serde(skip)]
    scratch: Vec<Point>,
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
    pub point: Point,
    /// The feature on which that point lies.
    pub feature: Feature,
    /// Signed distance to the border, m: positive inside.
    pub margin: f64,
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
    pub fn corners(&self) -> &[Point] {
        &self.corners
    }

    /// Whether there is no corner at all.
    pub fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }

    /// Whether the polygon has an area (three corners or more).
    pub fn has_area(&self) -> bool {
        self.corners.len() >= 3
    }

    /// Becomes the convex hull of `points` (monotone chain). Points closer than 0.1 µm are merged; collinear ones are
    /// left out.
    ///
    /// O(k log k) for k points; allocates only while the buffers grow.
    pub fn set_hull(&mut self, points: impl Iterator<Item = Point>) {
        let p = &mut self.scratch;
        p.clear();
        p.extend(points);
        p.sort_unstable_by(by_coordinates);
        p.dedup_by(|a, b| length(sub(*a, *b)) <= SAME_POINT);
        self.corners.clear();
        if p.len() <= 2 {
            self.corners.extend_from_slice(p);
            return;
        }
        append_hull(p, &mut self.corners, |a, b, c| {
            let (u, v) = (sub(b, a), sub(c, b));
            let turns_left = cross(u, v) > STRAIGHT * length(u) * length(v);
            !turns_left
        });
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
    pub fn centroid(&self) -> Option<Point> {
        middle(&self.corners)
    }

    /// Closest point to `z`, its feature and the signed margin; `None` if the polygon is empty or `z` is not finite.
    pub fn closest(&self, z: Point) -> Option<Closest> {
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
    pub fn edge_direction(&self, i: usize) -> Point {
        let e = sub(self.corners[(i + 1) % self.corners.len()], self.corners[i]);
        let l = length(e).max(SAME_POINT);
        [e[0] / l, e[1] / l]
    }

    /// Becomes `of` with every edge moved inwards by `distance` (m). A polygon that would vanish is inset by half as
    /// much, and so on; a point or a segment, and a polygon too small for any inset, becomes its middle.
    pub fn set_inset(&mut self, of: &Polygon, distance: f64) {
        let mut d = distance;
        for _ in 0..6 {
            if of.has_area() {
                let buffers = (&mut self.corners, &mut self.scratch);
                let crosses = |a, b| (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0);
                cut_edges(&of.corners, d, buffers, crosses, length);
                if self.has_area() {
                    return;
                }
            }
            d *= 0.5;
        }
        self.corners.clear();
        self.corners.extend(of.centroid());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::support::testing::Rng;
    use rand::{Rng as _, SeedableRng};
    use rand_pcg::Pcg64;

    fn polygon(points: &[[f64; 2]]) -> Polygon {
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
        let h = polygon(&p);
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
            let h = polygon(&p);
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
        assert!(polygon(&[]).is_empty() && polygon(&[]).closest([0.0, 0.0]).is_none());
        assert_eq!(polygon(&[[1.0, 2.0]; 5]).corners(), &[[1.0, 2.0]]);
        let line: Vec<_> = (0..7)
            .map(|i| [0.1 * f64::from(i), 0.2 * f64::from(i)])
            .collect();
        assert_eq!(polygon(&line).corners().len(), 2);
        let c = polygon(&line).closest([0.3, 0.6 + 1.0]).unwrap();
        assert!(matches!(c.feature, Feature::Vertex(_) | Feature::Edge(0)) && c.margin < 0.0);
    }

    #[test]
    fn thin_sets_reduce_to_edge_and_vertex() {
        let mut p = polygon(&[[0.0, 0.0], [0.1, 0.0], [0.1, 0.009], [0.0, 0.009]]);
        p.reduce_thin();
        assert_eq!(p.corners().len(), 2);
        let mut p = polygon(&[[0.0, 0.0], [0.005, 0.0], [0.0, 0.005]]);
        p.reduce_thin();
        assert_eq!(p.corners().len(), 1);
        let mut p = polygon(&SQUARE);
        p.reduce_thin();
        assert_eq!(p.corners().len(), 4);
    }

    #[test]
    fn margin_and_features_of_square() {
        let h = polygon(&SQUARE);
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
        let h = polygon(&SQUARE);
        let mut s = Polygon::default();
        s.set_inset(&h, 0.02);
        assert_eq!(s.corners().len(), 4);
        for c in s.corners() {
            assert!((h.closest(*c).unwrap().margin - 0.02).abs() < 1e-12);
        }
        // A strip narrower than twice the distance is inset by less, and the result is still inside.
        let h = polygon(&[[0.0, 0.0], [0.3, 0.0], [0.3, 0.03], [0.0, 0.03]]);
        s.set_inset(&h, 0.02);
        assert!(s.has_area());
        for c in s.corners() {
            assert!(h.closest(*c).unwrap().margin >= 0.0099);
        }
        s.set_inset(&polygon(&[[1.0, 1.0], [3.0, 1.0]]), 0.02);
        assert_eq!(s.corners(), &[[2.0, 1.0]]);
    }

    #[test]
    fn clipping_keeps_the_inset() {
        let square = hull(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5]]);
        assert_eq!(square.len(), 4);
        assert_eq!(Region::inside(&square, 0.1).nearest([0.5, 0.4]), [0.5, 0.4]);
        let p = Region::inside(&square, 0.1).nearest([2.0, 0.5]);
        assert!((p[0] - 0.9).abs() < 1e-12 && (p[1] - 0.5).abs() < 1e-12);
        assert!((margin(&square, p) - 0.1).abs() < 1e-12);
        assert!((margin(&square, [2.0, 0.5]) + 1.0).abs() < 1e-12);
        let m = Region::inside(&square, 0.6).nearest([9.0, 9.0]);
        assert!((m[0] - 0.5).abs() < 1e-12, "too narrow: the middle");
    }

    #[test]
    fn small_polygons_are_what_the_preparation_of_clips_computes() {
        let mut random = Pcg64::seed_from_u64(5);
        for _ in 0..2000 {
            let count = random.random_range(3..20);
            let points: Vec<[f64; 2]> = (0..count)
                .map(|_| [0, 1].map(|_| random.random_range(-0.2..0.2)))
                .collect();
            let z = [0, 1].map(|_| random.random_range(-0.5..0.5));
            let mut polygon = SmallPolygon::default();
            points.iter().for_each(|p| polygon.add(*p));
            let (a, b) = (
                polygon.inner(0.02).unwrap().nearest(z),
                Region::inside(&hull(&points), 0.02).nearest(z),
            );
            assert!((a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12);
        }
    }
}
