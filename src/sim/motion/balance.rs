//! Does a motion keep its balance on the feet it stands on, and what shift of the trunk makes it do so?
//!
//! From the postures alone: centre of mass, zero-moment point (with the change of angular momentum), support polygon of the planted
//! feet. Where the zero-moment point leaves the polygon, the centre of mass that belongs to a point inside solves, per axis,
//! `Δ − Δ̈/ω² = p − z`, `ω² = (g + c̈_z)/c_z`, a tridiagonal system over the clip (cart-table model of Kajita et al. 2003).

use super::filter::low_pass;
use super::leg_ik::forward;
use crate::sim::body::topology::SEGMENT_COUNT;
use crate::sim::body::{Body, Posture};
use crate::sim::math::Vec3;

/// Standard gravity, m/s².
const GRAVITY: f64 = 9.81;
/// Ground force over weight below which the zero-moment point is meaningless.
pub const LIGHT: f64 = 0.25;

/// Centre of mass and zero-moment point of every sample of a motion.
#[derive(Clone, Debug)]
pub struct MassTrack {
    /// Centre of mass, m.
    pub com: Vec<Vec3>,
    /// Zero-moment point on the floor z = 0, m.
    pub zmp: Vec<[f64; 2]>,
    /// Square of the pendulum frequency `(g + c̈_z)/c_z`, 1/s², limited to 3…40.
    pub omega2: Vec<f64>,
    /// Vertical ground force over weight.
    pub load: Vec<f64>,
    /// What the ground has to give: force, N, and moment about the centre of mass, N·m.
    pub wrench: Vec<(Vec3, Vec3)>,
}

/// Computes [`MassTrack`] by central differences of the postures.
///
/// z = Σ-moment balance about the floor: `z_x = −M_y/F_z`, `z_y = M_x/F_z` with `M = L̇ + g Σ m c × ẑ`, L about the world origin.
///
/// * `rate_hz`: samples per second. The first and last two samples repeat their neighbour. O(n); allocates.
pub fn mass_track(body: &Body, postures: &[Posture], rate_hz: f64) -> MassTrack {
    let n = postures.len();
    let h = 1.0 / rate_hz;
    let mass: f64 = body.segments.iter().map(|s| s.mass).sum();
    let poses: Vec<_> = postures.iter().map(|p| forward(body, p)).collect();
    let centre = |i: usize, s: usize| poses[i][s].0 + poses[i][s].1.rotate(body.segments[s].com);
    let com: Vec<Vec3> = (0..n)
        .map(|i| {
            (0..SEGMENT_COUNT).fold(Vec3::zero(), |sum, s| {
                sum + centre(i, s) * (body.segments[s].mass / mass)
            })
        })
        .collect();
    let momentum: Vec<Vec3> = (0..n)
        .map(|i| {
            let (a, b) = (i.saturating_sub(1), (i + 1).min(n - 1));
            let w = 1.0 / (h * (b - a).max(1) as f64);
            (0..SEGMENT_COUNT).fold(Vec3::zero(), |sum, s| {
                let seg = &body.segments[s];
                let v = (centre(b, s) - centre(a, s)) * w;
                let q = poses[i][s].1;
                let spin = q
                    .conjugate()
                    .rotate((poses[b][s].1 * poses[a][s].1.conjugate()).log() * w);
                sum + centre(i, s).cross(v) * seg.mass + q.rotate(seg.inertia * spin)
            })
        })
        .collect();
    let mut out = MassTrack {
        zmp: com.iter().map(|c| [c.x, c.y]).collect(),
        omega2: com.iter().map(|c| GRAVITY / c.z.max(0.2)).collect(),
        load: vec![1.0; n],
        wrench: vec![(Vec3::Z * (mass * GRAVITY), Vec3::zero()); n],
        com,
    };
    if n < 5 {
        return out;
    }
    for i in 2..n - 2 {
        let c = out.com[i];
        let acc = (out.com[i + 1] - c * 2.0 + out.com[i - 1]) * (1.0 / (h * h));
        let rate = (momentum[i + 1] - momentum[i - 1]) * (0.5 / h);
        let force = mass * (GRAVITY + acc.z);
        out.load[i] = force / (mass * GRAVITY);
        out.wrench[i] = ((acc + Vec3::Z * GRAVITY) * mass, rate - c.cross(acc) * mass);
        out.omega2[i] = ((GRAVITY + acc.z) / c.z.max(0.2)).clamp(3.0, 40.0);
        // Near flight there is no zero-moment point to speak of; the centre of mass stands in.
        if out.load[i] > LIGHT {
            let m_x = rate.x + mass * GRAVITY * c.y;
            let m_y = rate.y - mass * GRAVITY * c.x;
            out.zmp[i] = [-m_y / force, m_x / force];
        }
    }
    for (i, from) in [(0, 2), (1, 2), (n - 2, n - 3), (n - 1, n - 3)] {
        let z = out.zmp[from];
        (out.zmp[i], out.omega2[i], out.load[i]) = (z, out.omega2[from], out.load[from]);
        out.wrench[i] = out.wrench[from];
    }
    out
}

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

/// Signed distance of `z` from the border of a convex counter-clockwise polygon: positive inside, m. For fewer than three corners,
/// minus the distance to the nearest one.
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
        let c = closest(polygon, z);
        -(c[0] - z[0]).hypot(c[1] - z[1])
    }
}

/// Distance of `z` to the left of the line from `a` to `b`.
fn edge_distance(a: [f64; 2], b: [f64; 2], z: [f64; 2]) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let len = dx.hypot(dy).max(1e-12);
    (dx * (z[1] - a[1]) - dy * (z[0] - a[0])) / len
}

/// Nearest point on the border of a polygon.
fn closest(polygon: &[[f64; 2]], z: [f64; 2]) -> [f64; 2] {
    let n = polygon.len();
    let mut best = (f64::INFINITY, z);
    for i in 0..n {
        let (a, b) = (polygon[i], polygon[(i + 1) % n]);
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let u = (((z[0] - a[0]) * dx + (z[1] - a[1]) * dy) / (dx * dx + dy * dy).max(1e-18))
            .clamp(0.0, 1.0);
        let p = [a[0] + u * dx, a[1] + u * dy];
        let d = (p[0] - z[0]).hypot(p[1] - z[1]);
        if d < best.0 {
            best = (d, p);
        }
    }
    best.1
}

/// The nearest point that is at least `inset` inside a convex polygon; its middle if the polygon is too narrow for that.
pub fn clip_inside(polygon: &[[f64; 2]], z: [f64; 2], inset: f64) -> [f64; 2] {
    let n = polygon.len();
    if n == 0 {
        return z;
    }
    let middle = {
        let s = polygon
            .iter()
            .fold([0.0; 2], |s, p| [s[0] + p[0], s[1] + p[1]]);
        [s[0] / n as f64, s[1] / n as f64]
    };
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
    let m = inner.len();
    if m >= 3 && (0..m).all(|i| edge_distance(inner[i], inner[(i + 1) % m], z) >= 0.0) {
        return z;
    }
    closest(&inner, z)
}

/// What carries the body in one sample.
#[derive(Clone, Debug, PartialEq)]
pub enum Carrier {
    /// Feet on the floor: convex hull of their footprints.
    Feet(Vec<[f64; 2]>),
    /// Nothing: free flight.
    Air,
    /// Something this preparation knows nothing about: other body parts, a chair.
    Other,
}

/// Shift of the centre of mass, per sample, that brings the zero-moment point `inset` (m) inside the support.
///
/// Solves Δ − Δ̈/ω² = p − z per axis with Δ̇ = 0 at both ends, Δ̈ = 0 in flight; p is z clipped to the inset polygon and smoothed.
/// Samples that are far outside for long (`reach`, m) are carried by something else and are left alone. O(n).
pub fn com_shift(
    track: &MassTrack,
    carriers: &[Carrier],
    inset: f64,
    reach: f64,
    rate_hz: f64,
) -> Vec<[f64; 2]> {
    let n = track.com.len();
    let mut off: [Vec<f64>; 2] = [vec![0.0; n], vec![0.0; n]];
    for i in 0..n {
        if let Carrier::Feet(p) = &carriers[i] {
            let z = track.zmp[i];
            let c = clip_inside(p, z, inset);
            for axis in 0..2 {
                off[axis][i] = (c[axis] - z[axis]).clamp(-0.3, 0.3);
            }
        }
    }
    // How far outside for about a second: peaks of gait are corrected, a chair is not.
    let mut lasting: Vec<f64> = (0..n).map(|i| off[0][i].hypot(off[1][i])).collect();
    low_pass(&mut lasting, 0.5, rate_hz);
    let mut out = vec![[0.0; 2]; n];
    for axis in 0..2 {
        let mut rhs = off[axis].clone();
        for i in 0..n {
            let u = ((lasting[i] - 0.7 * reach) / (0.6 * reach)).clamp(0.0, 1.0);
            rhs[i] *= 1.0 - u * u * (3.0 - 2.0 * u);
        }
        low_pass(&mut rhs, 8.0, rate_hz);
        for (r, c) in rhs.iter_mut().zip(carriers) {
            if *c == Carrier::Air {
                *r = 0.0;
            }
        }
        let shift = cart_table(&rhs, &track.omega2, carriers, rate_hz);
        for (o, s) in out.iter_mut().zip(shift) {
            o[axis] = s;
        }
    }
    out
}

/// Solves `Δ − Δ̈/ω² = rhs` (Δ̈ = 0 in flight) with Δ̇ = 0 at both ends (the clip mirrored there): Thomas algorithm.
fn cart_table(rhs: &[f64], omega2: &[f64], carriers: &[Carrier], rate_hz: f64) -> Vec<f64> {
    let n = rhs.len();
    let mut upper = vec![0.0; n];
    let mut x = vec![0.0; n];
    for i in 0..n {
        let flight = carriers[i] == Carrier::Air;
        // A trace of the stance equation keeps a clip that is all flight solvable.
        let one = if flight { 1e-6 } else { 1.0 };
        let al = if flight {
            1.0
        } else {
            rate_hz * rate_hz / omega2[i]
        };
        let (lower, diagonal, up) = if n == 1 {
            (0.0, one, 0.0)
        } else if i == 0 {
            (0.0, one + 2.0 * al, -2.0 * al)
        } else if i == n - 1 {
            (-2.0 * al, one + 2.0 * al, 0.0)
        } else {
            (-al, one + 2.0 * al, -al)
        };
        let before = if i > 0 {
            (upper[i - 1], x[i - 1])
        } else {
            (0.0, 0.0)
        };
        let w = 1.0 / (diagonal - lower * before.0);
        upper[i] = up * w;
        x[i] = (rhs[i] - lower * before.1) * w;
    }
    for i in (0..n.saturating_sub(1)).rev() {
        x[i] -= upper[i] * x[i + 1];
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cart_table_inverts_the_pendulum() {
        // c = cos(at) has z = (1 + a²/ω²) c; the mean-free start and end slopes vanish over whole periods.
        let (rate, a, w2) = (120.0, std::f64::consts::TAU / 2.0, 11.0);
        let n = 481;
        let c: Vec<f64> = (0..n).map(|i| (a * f64::from(i) / rate).cos()).collect();
        let z: Vec<f64> = c.iter().map(|c| (1.0 + a * a / w2) * c).collect();
        let ground = vec![Carrier::Other; n as usize];
        let x = cart_table(&z, &vec![w2; n as usize], &ground, rate);
        let worst = x
            .iter()
            .zip(&c)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        assert!(worst < 1e-3, "{worst}");
        let flat = cart_table(&[0.05; 50], &[11.0; 50], &vec![Carrier::Other; 50], rate);
        assert!(flat.iter().all(|x| (x - 0.05).abs() < 1e-12));
    }

    #[test]
    fn clipping_keeps_the_inset() {
        let square = hull(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5]]);
        assert_eq!(square.len(), 4);
        assert_eq!(clip_inside(&square, [0.5, 0.4], 0.1), [0.5, 0.4]);
        let p = clip_inside(&square, [2.0, 0.5], 0.1);
        assert!((p[0] - 0.9).abs() < 1e-12 && (p[1] - 0.5).abs() < 1e-12);
        assert!((margin(&square, p) - 0.1).abs() < 1e-12);
        assert!((margin(&square, [2.0, 0.5]) + 1.0).abs() < 1e-12);
        let m = clip_inside(&square, [9.0, 9.0], 0.6);
        assert!((m[0] - 0.5).abs() < 1e-12, "too narrow: the middle");
    }
}
