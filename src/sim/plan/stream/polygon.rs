//! Convex polygons of a few corners without allocation: what two feet cover.

/// Most corners of two feet.
const MOST: usize = 40;

/// Corners on the way to a convex polygon.
#[derive(Clone, Copy, Debug)]
pub struct Polygon {
    points: [[f64; 2]; MOST],
    len: usize,
}

impl Default for Polygon {
    fn default() -> Self {
        Self {
            points: [[0.0; 2]; MOST],
            len: 0,
        }
    }
}

fn cross(o: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
}

/// Distance of `z` to the left of the line from `a` to `b`.
fn left_of(a: [f64; 2], b: [f64; 2], z: [f64; 2]) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    cross(a, b, z) / (dx * dx + dy * dy).sqrt().max(1e-12)
}

impl Polygon {
    /// Adds a point; what does not fit is left out.
    pub fn add(&mut self, p: [f64; 2]) {
        if self.len < MOST {
            self.points[self.len] = p;
            self.len += 1;
        }
    }

    fn corners(&self) -> &[[f64; 2]] {
        &self.points[..self.len]
    }

    /// Convex hull, counter-clockwise.
    fn hull(mut self) -> Self {
        let p = &mut self.points[..self.len];
        p.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        let mut out = Self::default();
        let n = self.len;
        for round in 0..2 {
            let base = out.len;
            for k in 0..n {
                let q = self.points[if round == 0 { k } else { n - 1 - k }];
                while out.len >= base + 2
                    && cross(out.points[out.len - 2], out.points[out.len - 1], q) <= 0.0
                {
                    out.len -= 1;
                }
                out.add(q);
            }
            out.len -= usize::from(out.len > base);
        }
        out
    }

    /// The part to the left of the line from `a` to `b`, `inset` away from it.
    fn cut(&self, a: [f64; 2], b: [f64; 2], inset: f64) -> Self {
        let side = |p: [f64; 2]| left_of(a, b, p) - inset;
        let mut out = Self::default();
        for k in 0..self.len {
            let (p, q) = (self.points[k], self.points[(k + 1) % self.len]);
            let (sp, sq) = (side(p), side(q));
            if sp >= 0.0 {
                out.add(p);
            }
            if (sp >= 0.0) != (sq >= 0.0) {
                let u = sp / (sp - sq);
                out.add([p[0] + u * (q[0] - p[0]), p[1] + u * (q[1] - p[1])]);
            }
        }
        out
    }

    /// The part of the hull of the points that is at least `inset` inside; its middle if it is too narrow for that;
    /// `None` for fewer than three points.
    pub fn inner(&self, inset: f64) -> Option<Self> {
        let hull = self.hull();
        let n = hull.len;
        if n < 3 {
            return None;
        }
        let mut inner = hull;
        for k in 0..n {
            inner = inner.cut(hull.points[k], hull.points[(k + 1) % n], inset);
        }
        if inner.len < 3 {
            let sum = hull
                .corners()
                .iter()
                .fold([0.0; 2], |s, p| [s[0] + p[0], s[1] + p[1]]);
            inner = Self::default();
            inner.add(sum.map(|s| s / n as f64));
        }
        Some(inner)
    }

    /// The point of a convex polygon, counter-clockwise, that is nearest to `z`; `None` if there is none.
    pub fn nearest(&self, z: [f64; 2]) -> Option<[f64; 2]> {
        let m = self.len;
        let edge = |k: usize| (self.points[k], self.points[(k + 1) % m]);
        if m == 0 {
            return None;
        }
        if m > 2 && (0..m).all(|k| cross(edge(k).0, edge(k).1, z) >= 0.0) {
            return Some(z);
        }
        let mut best = (f64::INFINITY, z);
        for k in 0..m {
            let (a, b) = edge(k);
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            let u = (((z[0] - a[0]) * dx + (z[1] - a[1]) * dy) / (dx * dx + dy * dy).max(1e-18))
                .clamp(0.0, 1.0);
            let p = [a[0] + u * dx, a[1] + u * dy];
            let far = (p[0] - z[0]) * (p[0] - z[0]) + (p[1] - z[1]) * (p[1] - z[1]);
            if far < best.0 {
                best = (far, p);
            }
        }
        Some(best.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::math::polygon::{Region, hull};
    use rand::{Rng, SeedableRng};
    use rand_pcg::Pcg64;

    #[test]
    fn it_is_what_the_preparation_of_clips_computes() {
        let mut random = Pcg64::seed_from_u64(5);
        for _ in 0..2000 {
            let count = random.random_range(3..20);
            let points: Vec<[f64; 2]> = (0..count)
                .map(|_| [0, 1].map(|_| random.random_range(-0.2..0.2)))
                .collect();
            let z = [0, 1].map(|_| random.random_range(-0.5..0.5));
            let mut polygon = Polygon::default();
            points.iter().for_each(|p| polygon.add(*p));
            let (a, b) = (
                polygon.inner(0.02).unwrap().nearest(z).unwrap(),
                Region::inside(&hull(&points), 0.02).nearest(z),
            );
            assert!((a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12);
        }
    }
}
