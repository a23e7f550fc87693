//! Whether a motion keeps its balance on its planted feet, and the shift of the trunk that makes it do so.
//!
//! Everything is computed from the postures alone: centre of mass, zero-moment point (with the change of angular
//! momentum), support polygon of the planted feet. Where the zero-moment point leaves the polygon, the pelvis is
//! shifted by the least amount that brings it back; it answers to a shift Δ of the centre of mass by `Δ − Δ̈/ω²`, `ω² =
//! (g + c̈_z)/c_z` (cart-table model of Kajita et al. 2003).

use super::free_fall::in_free_fall;
use crate::body::topology::SEGMENT_COUNT;
use crate::body::{Body, Posture};
use crate::math::Vec3;
use crate::math::banded::Pentadiagonal;
use crate::math::curve::smoothstep_to;
use crate::math::polygon::{Region, margin};
use crate::motion::GRAVITY;
use crate::motion::filter::low_pass;
use crate::motion::leg_ik::forward;
use crate::plan::params::balance;

/// The wrench that the ground gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundWrench {
    /// Force, N.
    pub force: Vec3,
    /// Moment about the centre of mass, N·m. About the world origin it would be the small difference of moments that
    /// grow with the distance from it, and differentiation makes them differ by more than the length of the sole.
    pub moment: Vec3,
}

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
    /// The wrench that the ground has to give.
    pub wrench: Vec<GroundWrench>,
}

/// Computes [`MassTrack`] by central differences of the postures.
///
/// The zero-moment point is that of [`zero_moment_point`], with the change of angular momentum about the centre of
/// mass.
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
        omega2: com
            .iter()
            .map(|c| GRAVITY / c.z.max(balance::LEAST_HEIGHT))
            .collect(),
        load: vec![1.0; n],
        wrench: vec![
            GroundWrench {
                force: Vec3::Z * (mass * GRAVITY),
                moment: Vec3::zero(),
            };
            n
        ],
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
        out.wrench[i] = GroundWrench {
            force: (acc + Vec3::Z * GRAVITY) * mass,
            moment: rate,
        };
        out.omega2[i] = pendulum_omega2(c.z, acc.z);
        // Near flight the zero-moment point is not defined; the centre of mass is used instead.
        if out.load[i] > balance::LEAST_LOAD {
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

/// Square of the frequency of a pendulum whose mass is at `height` (m) and accelerates upwards by `rising` (m/s²),
/// 1/s².
pub(super) fn pendulum_omega2(height: f64, rising: f64) -> f64 {
    ((GRAVITY + rising) / height.max(balance::LEAST_HEIGHT))
        .clamp(balance::LEAST_OMEGA2, balance::MOST_OMEGA2)
}

/// How strongly a zero-moment point that stays outside by `distance` (m) indicates that something other than the feet
/// carries the body: 0 not at all, 1 for sure.
pub(super) fn lasts_outside(distance: f64) -> f64 {
    let begins = balance::OTHER_SUPPORT_BEGINS * balance::OTHER_SUPPORT;
    let range = balance::OTHER_SUPPORT_RANGE * balance::OTHER_SUPPORT;
    ((distance - begins) / range).clamp(0.0, 1.0)
}

/// The point of the floor (z = 0) at which the ground force acts without a horizontal moment.
///
/// * `com`: centre of mass, m.
pub(crate) fn zero_moment_point(com: Vec3, wrench: GroundWrench) -> [f64; 2] {
    let GroundWrench { force, moment } = wrench;
    [
        com.x - (com.z * force.x + moment.y) / force.z,
        com.y - (com.z * force.y - moment.x) / force.z,
    ]
}

/// How much a body may rest on something other than its feet in one sample, from 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OtherSupport {
    /// How much on a seat.
    pub seat: f64,
    /// How much on its hands.
    pub hands: f64,
}

/// The support of the body in one sample.
#[derive(Clone, Debug, PartialEq)]
pub enum SupportPhase {
    /// Feet on the floor: convex hull of their footprints.
    Feet(Vec<[f64; 2]>),
    /// Nothing: free flight.
    Air,
    /// Something this preparation does not model: other body parts, a chair.
    Other,
}

/// How the zero-moment point answers to a shift of the centre of mass: Δ − Δ̈/ω², tridiagonal, with the motion mirrored
/// at both ends.
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

/// The answer of sample `i` to a shift.
fn answered(rows: &[[f64; 3]], shift: &[[f64; 2]], i: usize) -> [f64; 2] {
    let [l, d, r] = rows[i];
    let (before, after) = (
        shift[i.saturating_sub(1)],
        shift[(i + 1).min(shift.len() - 1)],
    );
    std::array::from_fn(|a| l * before[a] + d * shift[i][a] + r * after[a])
}

/// Price of a zero-moment point outside, 1/m².
pub(super) const PRICE: f64 = 1.0 / (balance::OUTSIDE_COST * balance::OUTSIDE_COST);

/// The inputs from which a shift of the pelvis is computed.
#[derive(Clone, Copy)]
pub struct ShiftProblem<'a> {
    /// The motion as shifted by `so_far`.
    pub track: &'a MassTrack,
    /// Shift of the pelvis that `track` already contains, per sample, m.
    pub so_far: &'a [[f64; 2]],
    /// The support of the body.
    pub support: &'a [SupportPhase],
    /// Other supports that the body may use. A body on a seat is left alone, as is one in flight. One that may lean on
    /// its hands does so where its zero-moment point is outside by more than [`balance::OTHER_SUPPORT`] for long.
    pub other_support: &'a [OtherSupport],
    /// Distance inside the support at which the zero-moment point is kept, m.
    pub inset: f64,
    /// Samples per second.
    pub rate_hz: f64,
}

/// Share of the distance into the support by which the zero-moment point is moved in each sample: 0 where something
/// other than feet carries.
///
/// * `plain`: zero-moment point without any shift, m.
fn correction_shares(problem: &ShiftProblem<'_>, plain: &[[f64; 2]]) -> Vec<f64> {
    let &ShiftProblem {
        track,
        support,
        other_support,
        rate_hz,
        ..
    } = problem;
    let outside = |(i, c): (usize, &SupportPhase)| match c {
        SupportPhase::Feet(p) => (-margin(p, plain[i])).clamp(0.0, balance::MOST_OUTSIDE),
        _ => 0.0,
    };
    // The distance outside, averaged over about a second: peaks of gait are corrected, a chair is not.
    let mut lasting: Vec<f64> = support.iter().enumerate().map(outside).collect();
    low_pass(&mut lasting, balance::LASTING_CUTOFF, rate_hz);
    let share = |(i, c): (usize, &SupportPhase)| {
        let meant = if matches!(c, SupportPhase::Feet(_)) {
            let leans = smoothstep_to(other_support[i].hands, lasts_outside(lasting[i]));
            (1.0 - other_support[i].seat) * (1.0 - leans)
        } else {
            0.0
        };
        // The zero-moment point of a lightly loaded body says little.
        let load = track.load[i].clamp(0.0, 1.0);
        let sigma = PRICE * meant * load * load;
        sigma / (sigma + PRICE)
    };
    support.iter().enumerate().map(share).collect()
}

/// `1 + PRICE Aᵀ A + τ⁴ D²ᵀ D²` with the answers A (`rows`) of the zero-moment point.
fn shift_system(rows: &[[f64; 3]], support: &[SupportPhase], rate_hz: f64) -> Pentadiagonal {
    let n = rows.len();
    let mut matrix = Pentadiagonal::new(vec![1.0; n]);
    for i in 0..n {
        matrix.add_row(i as isize - 1, rows[i], PRICE);
        if i > 0 && i + 1 < n {
            // Nothing bends the path of a body in the air.
            let weight = if support[i] == SupportPhase::Air {
                balance::FLIGHT_PRICE * PRICE * rate_hz.powi(4)
            } else {
                (balance::BEND_TIME * rate_hz).powi(4)
            };
            matrix.add_row(i as isize - 1, [1.0, -2.0, 1.0], weight);
        }
    }
    matrix
}

/// Shift of the pelvis, m per sample, that brings the zero-moment point inside the support: the smallest and smoothest
/// one.
///
/// Minimises `Σ s² + τ⁴ s̈² + Σ (outside/COST)²` where the zero-moment point answers to a shift Δ = s/LEAD of the
/// centre of mass by Δ − Δ̈/ω² (cart-table model of Kajita et al. 2003), by alternating between the trajectory (a
/// banded solve per axis) and the polygons (alternating direction method of multipliers).
///
/// O(n).
pub fn pelvis_shift(problem: &ShiftProblem<'_>) -> Vec<[f64; 2]> {
    shift_with(problem, None)
}

/// The same for a running body, which flies where `air` is set: the path of its mass is straight there, whatever it was
/// before.
pub(crate) fn pelvis_shift_in_run(problem: &ShiftProblem<'_>, air: &[bool]) -> Vec<[f64; 2]> {
    let mut straight = vec![[0.0; 2]; air.len()];
    let (com, so_far) = (&problem.track.com, problem.so_far);
    let plain = |i: usize, k: usize| com[i].to_array()[k] - so_far[i][k] / balance::PELVIS_LEAD;
    let price = balance::FLIGHT_PRICE * PRICE * problem.rate_hz.powi(4);
    for i in (1..air.len() - 1).filter(|i| in_free_fall(air, *i)) {
        for k in 0..2 {
            let bend = plain(i - 1, k) - 2.0 * plain(i, k) + plain(i + 1, k);
            for (j, r) in [(i - 1, 1.0), (i, -2.0), (i + 1, 1.0)] {
                straight[j][k] -= price * r * balance::PELVIS_LEAD * bend;
            }
        }
    }
    shift_with(problem, Some(&straight))
}

/// [`pelvis_shift`] with an additional pull on the shift, per sample, from other requirements.
fn shift_with(problem: &ShiftProblem<'_>, pull: Option<&[[f64; 2]]>) -> Vec<[f64; 2]> {
    let &ShiftProblem {
        track,
        so_far,
        support,
        inset,
        rate_hz,
        ..
    } = problem;
    let n = track.com.len();
    let rows: Vec<[f64; 3]> = (0..n)
        .map(|i| answer(track.omega2[i], rate_hz, i, n).map(|x| x / balance::PELVIS_LEAD))
        .collect();
    // The zero-moment point without any shift.
    let plain: Vec<[f64; 2]> = (0..n)
        .map(|i| minus(track.zmp[i], answered(&rows, so_far, i)))
        .collect();
    let inner: Vec<Option<Region>> = support
        .iter()
        .map(|c| match c {
            SupportPhase::Feet(p) => Some(Region::inside(p, inset)),
            _ => None,
        })
        .collect();
    let shares = correction_shares(problem, &plain);
    let factor = shift_system(&rows, support, rate_hz).factor();
    let mut shift = vec![[0.0; 2]; n];
    let mut goal = plain.clone();
    let mut debt = vec![[0.0; 2]; n];
    for _ in 0..balance::ALTERNATIONS {
        // PRICE Aᵀ (goal − debt − plain)
        match pull {
            Some(pull) => shift.copy_from_slice(pull),
            None => shift.fill([0.0; 2]),
        }
        for i in 0..n {
            let want = minus(minus(goal[i], debt[i]), plain[i]).map(|w| PRICE * w);
            let [l, d, r] = rows[i];
            let mut add = |k: usize, share: f64| {
                for (x, w) in shift[k].iter_mut().zip(want) {
                    *x += share * w;
                }
            };
            add(i, d);
            if i > 0 {
                add(i - 1, l);
            }
            if i + 1 < n {
                add(i + 1, r);
            }
        }
        factor.solve(&mut shift);
        let mut change = 0.0f64;
        for i in 0..n {
            let a = answered(&rows, &shift, i);
            let v: [f64; 2] = std::array::from_fn(|k| plain[i][k] + a[k] + debt[i][k]);
            let inside = match &inner[i] {
                Some(region) => region.nearest(v),
                None => v,
            };
            for k in 0..2 {
                let next = v[k] + shares[i] * (inside[k] - v[k]);
                let owed = v[k] - next;
                change = change
                    .max((next - goal[i][k]).abs())
                    .max((owed - debt[i][k]).abs());
                (goal[i][k], debt[i][k]) = (next, owed);
            }
        }
        if change < balance::SETTLED {
            break;
        }
    }
    shift
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::builtin::builtin;

    #[test]
    fn the_answer_to_a_shift_is_that_of_the_pendulum() {
        // c = cos(at) has z = (1 + a²/ω²) c; the slopes at both ends vanish over whole periods.
        let (rate, a, w2) = (120.0, std::f64::consts::TAU / 2.0, 11.0);
        let n = 481;
        let c: Vec<f64> = (0..n).map(|i| (a * i as f64 / rate).cos()).collect();
        let rows: Vec<_> = (0..n).map(|i| answer(w2, rate, i, n)).collect();
        let both: Vec<[f64; 2]> = c.iter().map(|c| [*c, -*c]).collect();
        let worst = (0..n)
            .flat_map(|i| {
                let z = answered(&rows, &both, i);
                [0, 1].map(|k| (z[k] - (1.0 + a * a / w2) * both[i][k]).abs())
            })
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
}
