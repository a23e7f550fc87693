//! Does a motion keep its balance on the feet it stands on, and what shift of the trunk makes it do so?
//!
//! From the postures alone: centre of mass, zero-moment point (with the change of angular momentum), support polygon of the planted
//! feet. Where the zero-moment point leaves the polygon, the pelvis is shifted by as little as brings it back; it answers to a shift Δ of the
//! centre of mass by `Δ − Δ̈/ω²`, `ω² = (g + c̈_z)/c_z` (cart-table model of Kajita et al. 2003).

use super::GRAVITY;
use super::banded::Pentadiagonal;
use super::filter::low_pass;
use super::leg_ik::forward;
use crate::sim::body::topology::SEGMENT_COUNT;
use crate::sim::body::{Body, Posture};
use crate::sim::math::Vec3;

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
/// The zero-moment point is that of [`zero_moment_point`], with the change of angular momentum about the centre of mass.
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
                sum + (centre(i, s) - com[i]).cross(v) * seg.mass + q.rotate(seg.inertia * spin)
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
        let acc = (out.com[i + 2] - c * 2.0 + out.com[i - 2]) * (0.25 / (h * h));
        let rate = (momentum[i + 1] - momentum[i - 1]) * (0.5 / h);
        out.load[i] = 1.0 + acc.z / GRAVITY;
        out.wrench[i] = ((acc + Vec3::Z * GRAVITY) * mass, rate);
        out.omega2[i] = ((GRAVITY + acc.z) / c.z.max(0.2)).clamp(3.0, 40.0);
        // Near flight there is no zero-moment point to speak of; the centre of mass stands in.
        if out.load[i] > LIGHT {
            out.zmp[i] = zero_moment_point(c, out.wrench[i]);
        }
    }
    for (i, from) in [(0, 2), (1, 2), (n - 2, n - 3), (n - 1, n - 3)] {
        let z = out.zmp[from];
        (out.zmp[i], out.omega2[i], out.load[i]) = (z, out.omega2[from], out.load[from]);
        out.wrench[i] = out.wrench[from];
    }
    out
}

/// Where on the floor (z = 0) the ground force acts without a level moment.
///
/// * `com`: centre of mass, m.
/// * `wrench`: force of the ground, N, and its moment about the centre of mass, N·m. About the world origin the same would be the small
///   difference of moments that grow with the distance from it, and differentiation makes them differ by more than the sole is long.
pub(super) fn zero_moment_point(com: Vec3, (force, moment): (Vec3, Vec3)) -> [f64; 2] {
    [
        com.x - (com.z * force.x + moment.y) / force.z,
        com.y - (com.z * force.y - moment.x) / force.z,
    ]
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

/// The part of a convex polygon that is at least `inset` inside; its middle if it is too narrow for that.
pub fn inner_polygon(polygon: &[[f64; 2]], inset: f64) -> Vec<[f64; 2]> {
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

/// The nearest point of a convex counter-clockwise polygon; `z` itself if there is none.
fn nearest(polygon: &[[f64; 2]], z: [f64; 2]) -> [f64; 2] {
    let n = polygon.len();
    if n == 0
        || (n >= 3 && (0..n).all(|i| edge_distance(polygon[i], polygon[(i + 1) % n], z) >= 0.0))
    {
        return z;
    }
    closest(polygon, z)
}

/// The nearest point that is at least `inset` inside a convex polygon; its middle if the polygon is too narrow for that.
pub fn clip_inside(polygon: &[[f64; 2]], z: [f64; 2], inset: f64) -> [f64; 2] {
    nearest(&inner_polygon(polygon, inset), z)
}

/// How much a body may rest on something other than its feet in one sample, from 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Elsewhere {
    /// On a seat.
    pub seat: f64,
    /// On its hands.
    pub hands: f64,
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

/// Pelvis and trunk move by this much more than the centre of mass, because the feet stay.
const LEAD: f64 = 1.15;
/// A zero-moment point this much outside costs as much as a shift of one metre, m.
const COST: f64 = 0.1;
/// Time below which a shift is not to change, s.
const BEND: f64 = 0.08;
/// Price of bending the path of a body in the air, against that of a zero-moment point outside, s⁴.
const FREE: f64 = 1.0;
/// Alternations between trajectory and polygons.
const ALTERNATIONS: usize = 150;
/// Most of a correction of the zero-moment point, m.
const MOST_OFF: f64 = 0.4;

/// How the zero-moment point answers to a shift of the centre of mass: Δ − Δ̈/ω², tridiagonal, the motion mirrored at both ends.
fn answer(omega2: f64, rate_hz: f64, i: usize, n: usize) -> [f64; 3] {
    let a = rate_hz * rate_hz / omega2;
    let side = |edge: bool, other: bool| match (edge, other) {
        (true, _) => 0.0,
        (_, true) => -2.0 * a,
        _ => -a,
    };
    let (first, last) = (i == 0, i + 1 == n);
    [side(first, last), 1.0 + 2.0 * a, side(last, first)]
}

/// The answer of every sample to a shift.
fn answers(rows: &[[f64; 3]], shift: &[f64]) -> Vec<f64> {
    let n = shift.len();
    (0..n)
        .map(|i| {
            let [l, d, r] = rows[i];
            let at = |k: usize| shift[k.min(n - 1)];
            l * at(i.wrapping_sub(1).min(i)) + d * at(i) + r * at(i + 1)
        })
        .collect()
}

/// Price of a zero-moment point outside, 1/m².
const PRICE: f64 = 1.0 / (COST * COST);

/// Share of the way into the support that the zero-moment point is brought in each sample: none where something else than feet carries.
///
/// * `plain`: zero-moment point without any shift, per axis, m.
fn how_much_yields(
    track: &MassTrack,
    plain: &[Vec<f64>; 2],
    carriers: &[Carrier],
    elsewhere: &[Elsewhere],
    (reach, rate_hz): (f64, f64),
) -> Vec<f64> {
    let outside = |(i, c): (usize, &Carrier)| match c {
        Carrier::Feet(p) => (-margin(p, [plain[0][i], plain[1][i]])).clamp(0.0, MOST_OFF),
        _ => 0.0,
    };
    // How far outside for about a second: peaks of gait are corrected, a chair is not.
    let mut lasting: Vec<f64> = carriers.iter().enumerate().map(outside).collect();
    low_pass(&mut lasting, 0.5, rate_hz);
    let share = |(i, c): (usize, &Carrier)| {
        let u = ((lasting[i] - 0.7 * reach) / (0.6 * reach)).clamp(0.0, 1.0);
        let meant = if matches!(c, Carrier::Feet(_)) {
            let leans = elsewhere[i].hands * u * u * (3.0 - 2.0 * u);
            (1.0 - elsewhere[i].seat) * (1.0 - leans)
        } else {
            0.0
        };
        // A light body's zero-moment point says little.
        let load = track.load[i].clamp(0.0, 1.0);
        let sigma = PRICE * meant * load * load;
        sigma / (sigma + PRICE)
    };
    carriers.iter().enumerate().map(share).collect()
}

/// `1 + PRICE Aᵀ A + τ⁴ D²ᵀ D²` with the answers A (`rows`) of the zero-moment point.
fn shift_system(rows: &[[f64; 3]], carriers: &[Carrier], rate_hz: f64) -> Pentadiagonal {
    let n = rows.len();
    let mut matrix = Pentadiagonal::new(vec![1.0; n]);
    for i in 0..n {
        matrix.add_row(i as isize - 1, rows[i], PRICE);
        if i > 0 && i + 1 < n {
            // Nothing bends the path of a body in the air.
            let weight = if carriers[i] == Carrier::Air {
                FREE * PRICE * rate_hz.powi(4)
            } else {
                (BEND * rate_hz).powi(4)
            };
            matrix.add_row(i as isize - 1, [1.0, -2.0, 1.0], weight);
        }
    }
    matrix
}

/// Shift of the pelvis, per sample, that brings the zero-moment point `inset` (m) inside the support: the least one, and the smoothest.
///
/// Minimises `Σ s² + τ⁴ s̈² + Σ (outside/COST)²` where the zero-moment point answers to a shift Δ = s/LEAD of the centre of mass by Δ − Δ̈/ω²
/// (cart-table model of Kajita et al. 2003), by alternating between the trajectory (a banded solve per axis) and the polygons (alternating
/// direction method of multipliers).
///
/// * `track`: of the motion as shifted by `so_far`, m.
/// * `elsewhere`: what else may carry the body. A body on a seat is left alone, as is one in flight; one that may lean on its hands is where its
///   zero-moment point is outside by more than `reach` (m) for long.
///
/// O(n).
pub fn pelvis_shift(
    track: &MassTrack,
    so_far: &[[f64; 2]],
    carriers: &[Carrier],
    elsewhere: &[Elsewhere],
    (inset, reach): (f64, f64),
    rate_hz: f64,
) -> Vec<[f64; 2]> {
    let n = track.com.len();
    let rows: Vec<[f64; 3]> = (0..n)
        .map(|i| answer(track.omega2[i], rate_hz, i, n).map(|x| x / LEAD))
        .collect();
    // Where the zero-moment point would be without any shift.
    let plain: [Vec<f64>; 2] = std::array::from_fn(|axis| {
        let s: Vec<f64> = so_far.iter().map(|s| s[axis]).collect();
        let a = answers(&rows, &s);
        (0..n).map(|i| track.zmp[i][axis] - a[i]).collect()
    });
    let inner: Vec<Option<Vec<[f64; 2]>>> = carriers
        .iter()
        .map(|c| match c {
            Carrier::Feet(p) => Some(inner_polygon(p, inset)),
            _ => None,
        })
        .collect();
    let yields = how_much_yields(track, &plain, carriers, elsewhere, (reach, rate_hz));
    let factor = shift_system(&rows, carriers, rate_hz).factor();
    let mut shift: [Vec<f64>; 2] = [vec![0.0; n], vec![0.0; n]];
    let mut goal = plain.clone();
    let mut debt: [Vec<f64>; 2] = [vec![0.0; n], vec![0.0; n]];
    for _ in 0..ALTERNATIONS {
        let mut zmp: [Vec<f64>; 2] = Default::default();
        for axis in 0..2 {
            let mut x = vec![0.0; n];
            for i in 0..n {
                let want = PRICE * (goal[axis][i] - debt[axis][i] - plain[axis][i]);
                let [l, d, r] = rows[i];
                x[i] += d * want;
                if i > 0 {
                    x[i - 1] += l * want;
                }
                if i + 1 < n {
                    x[i + 1] += r * want;
                }
            }
            factor.solve(&mut x);
            zmp[axis] = answers(&rows, &x);
            for (z, p) in zmp[axis].iter_mut().zip(&plain[axis]) {
                *z += p;
            }
            shift[axis] = x;
        }
        for i in 0..n {
            let v = [zmp[0][i] + debt[0][i], zmp[1][i] + debt[1][i]];
            let inside = match &inner[i] {
                Some(p) => nearest(p, v),
                None => v,
            };
            for axis in 0..2 {
                goal[axis][i] = v[axis] + yields[i] * (inside[axis] - v[axis]);
                debt[axis][i] = v[axis] - goal[axis][i];
            }
        }
    }
    (0..n).map(|i| [shift[0][i], shift[1][i]]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::motion::builtin::builtin;

    #[test]
    fn the_answer_to_a_shift_is_that_of_the_pendulum() {
        // c = cos(at) has z = (1 + a²/ω²) c; the slopes at both ends vanish over whole periods.
        let (rate, a, w2) = (120.0, std::f64::consts::TAU / 2.0, 11.0);
        let n = 481;
        let c: Vec<f64> = (0..n).map(|i| (a * i as f64 / rate).cos()).collect();
        let rows: Vec<_> = (0..n).map(|i| answer(w2, rate, i, n)).collect();
        let worst = answers(&rows, &c)
            .iter()
            .zip(&c)
            .map(|(z, c)| (z - (1.0 + a * a / w2) * c).abs())
            .fold(0.0, f64::max);
        assert!(worst < 1e-3, "{worst}");
    }

    #[test]
    fn the_zero_moment_point_moves_along_with_the_motion() {
        let body = Body::adult_man();
        let clip = builtin(&body, "walk").unwrap();
        let here: Vec<Posture> = (0..clip.len()).map(|i| *clip.posture(i)).collect();
        let far = Vec3 {
            x: 500.0,
            y: -800.0,
            z: 0.0,
        };
        let mut there = here.clone();
        there.iter_mut().for_each(|p| p.root_position += far);
        let [a, b] = [here, there].map(|p| mass_track(&body, &p, clip.rate_hz()));
        for (i, (a, b)) in a.zmp.iter().zip(&b.zmp).enumerate() {
            let off = [b[0] - far.x - a[0], b[1] - far.y - a[1]];
            assert!(off.iter().all(|e| e.abs() < 1e-5), "{i}: {off:?}");
        }
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
