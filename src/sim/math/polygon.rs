//! Convex polygons on the floor: hulls, distances from the border, and the nearest point that is far enough inside.

/// Convex hull, counter-clockwise (monotone chain).
pub fn hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut p = points.to_vec();
    p.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    p.dedup();
    if p.len() < 3 {
        return p;
    }
    let cross = |o: [f64; 2], a: [f64; 2], b: [f64; 2]| {
        (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
    };
    let chain = |it: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut c: Vec<[f64; 2]> = Vec::new();
        for q in it {
            while c.len() >= 2 && cross(c[c.len() - 2], c[c.len() - 1], q) <= 0.0 {
                c.pop();
            }
            c.push(q);
        }
        c.pop();
        c
    };
    let mut out = chain(&mut p.iter().copied());
    out.extend(chain(&mut p.iter().rev().copied()));
    out
}

/// Signed distance of `z` from the border of a convex counter-clockwise polygon: positive inside, m. For fewer than
/// three corners, minus the distance to the nearest one.
pub fn margin(polygon: &[[f64; 2]], z: [f64; 2]) -> f64 {
    let n = polygon.len();
    if n < 3 {
        return -polygon
            .iter()
            .map(|p| (p[0] - z[0]).hypot(p[1] - z[1]))
            .fold(f64::INFINITY, f64::min);
    }
    let inside = (0..n)
        .map(|i| edge_distance(polygon[i], polygon[(i + 1) % n], z))
        .fold(f64::INFINITY, f64::min);
    if inside >= 0.0 {
        inside
    } else {
        -Region::new(polygon.to_vec()).border(z).0.sqrt()
    }
}

/// Distance of `z` to the left of the line from `a` to `b`.
fn edge_distance(a: [f64; 2], b: [f64; 2], z: [f64; 2]) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let len = dx.hypot(dy).max(1e-12);
    (dx * (z[1] - a[1]) - dy * (z[0] - a[0])) / len
}

/// The part of a convex polygon that is at least `inset` inside; its middle if it is too narrow for that.
fn inner_polygon(polygon: &[[f64; 2]], inset: f64) -> Vec<[f64; 2]> {
    let n = polygon.len();
    if n == 0 {
        return Vec::new();
    }
    let sum = polygon
        .iter()
        .fold([0.0; 2], |s, p| [s[0] + p[0], s[1] + p[1]]);
    let middle = vec![[sum[0] / n as f64, sum[1] / n as f64]];
    if n < 3 {
        return middle;
    }
    let mut inner = polygon.to_vec();
    for i in 0..n {
        let (a, b) = (polygon[i], polygon[(i + 1) % n]);
        let side = |p: [f64; 2]| edge_distance(a, b, p) - inset;
        let mut cut = Vec::with_capacity(inner.len() + 1);
        for k in 0..inner.len() {
            let (p, q) = (inner[k], inner[(k + 1) % inner.len()]);
            let (sp, sq) = (side(p), side(q));
            if sp >= 0.0 {
                cut.push(p);
            }
            if (sp >= 0.0) != (sq >= 0.0) {
                let u = sp / (sp - sq);
                cut.push([p[0] + u * (q[0] - p[0]), p[1] + u * (q[1] - p[1])]);
            }
        }
        inner = cut;
        if inner.is_empty() {
            return middle;
        }
    }
    inner
}

/// One side of a region.
#[derive(Clone, Copy, Debug)]
struct Edge {
    from: [f64; 2],
    /// Unit vector to its other end, and how far that is, m.
    along: [f64; 2],
    length: f64,
}

/// A convex polygon whose sides are worked out once: points are brought into it again and again.
#[derive(Clone, Debug)]
pub struct Region {
    /// Counter-clockwise; a single point is one of no length.
    edges: Vec<Edge>,
}

impl Region {
    /// The polygon with these corners, counter-clockwise.
    fn new(corners: Vec<[f64; 2]>) -> Self {
        let n = corners.len();
        let edges = (0..n).map(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % n]);
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            let length = dx.hypot(dy);
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
    pub fn inside(polygon: &[[f64; 2]], inset: f64) -> Self {
        Self::new(inner_polygon(polygon, inset))
    }

    /// The nearest point of the region; `z` itself if there is none. No allocation.
    pub fn nearest(&self, z: [f64; 2]) -> [f64; 2] {
        let left =
            |e: &Edge| e.along[0] * (z[1] - e.from[1]) - e.along[1] * (z[0] - e.from[0]) >= 0.0;
        if self.edges.len() >= 3 && self.edges.iter().all(left) {
            return z;
        }
        self.border(z).1
    }

    /// The nearest point on the border, and the square of its distance, m².
    fn border(&self, z: [f64; 2]) -> (f64, [f64; 2]) {
        let mut best = (f64::INFINITY, z);
        for e in &self.edges {
            let d = [z[0] - e.from[0], z[1] - e.from[1]];
            let u = (d[0] * e.along[0] + d[1] * e.along[1]).clamp(0.0, e.length);
            let off = [u * e.along[0] - d[0], u * e.along[1] - d[1]];
            let far = off[0] * off[0] + off[1] * off[1];
            if far < best.0 {
                best = (far, [z[0] + off[0], z[1] + off[1]]);
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
