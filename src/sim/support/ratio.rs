//! Support ratios, Eq. (2): which support carries most, and which one is taken as the root.

use super::contact_set::SupportPoint;
use crate::sim::body::{SEGMENT_COUNT, SegmentId};
use crate::sim::math::{Vec3, vec3::vec3};

/// The main support is kept while its share is within this much of the largest (else it flickers in symmetric stance).
pub const MAIN_HYSTERESIS: f64 = 0.1;

/// Shares that differ by less are equal; the first support is taken then.
const TIE: f64 = 1e-9;

/// Ratios of all supports, Eq. (2), normalised to a sum of 1.
///
/// α_i = max(0, (a_m·l̂_i)(n·l̂_i)), l_i from the contact centroid to the centre of mass. `a_m` includes gravity,
/// `a_m = c̈ − g`: without it every ratio of a resting figure is zero.
///
/// * `com`: world, m. `com_acceleration`: c̈ of the last tick, m/s². `gravity`: magnitude, m/s².
/// * Returns one number per segment, 0 where it does not support. Equal shares if every α is zero.
pub fn support_ratios(
    points: &[SupportPoint],
    com: Vec3,
    com_acceleration: Vec3,
    gravity: f64,
) -> [f64; SEGMENT_COUNT] {
    let (mut sum, mut count) = ([Vec3::zero(); SEGMENT_COUNT], [0.0; SEGMENT_COUNT]);
    for p in points {
        sum[p.support.index()] += p.position;
        count[p.support.index()] += 1.0;
    }
    let pull = com_acceleration + vec3(0.0, 0.0, gravity);
    let mut ratio = [0.0; SEGMENT_COUNT];
    let (mut total, mut supports) = (0.0, 0.0);
    for s in 0..SEGMENT_COUNT {
        if count[s] > 0.0 {
            let l = (com - sum[s] * (1.0 / count[s])).normalized_or(Vec3::Z);
            ratio[s] = (pull.dot(l) * l.z).max(0.0); // Eq. 2, floor normal z
            total += ratio[s];
            supports += 1.0;
        }
    }
    for s in 0..SEGMENT_COUNT {
        if count[s] > 0.0 {
            ratio[s] = if total > 1e-9 {
                ratio[s] / total
            } else {
                1.0 / supports
            };
        }
    }
    ratio
}

/// The main supporting segment: largest share, but `previous` while that is within [`MAIN_HYSTERESIS`] of it.
pub fn main_support(
    points: &[SupportPoint],
    ratio: &[f64; SEGMENT_COUNT],
    previous: Option<SegmentId>,
) -> Option<SegmentId> {
    let supports = |s: SegmentId| points.iter().any(|p| p.support == s);
    let mut best: Option<SegmentId> = None;
    for p in points {
        if best.is_none_or(|b| ratio[p.support.index()] > ratio[b.index()] + TIE) {
            best = Some(p.support);
        }
    }
    let top = ratio[best?.index()];
    previous
        .filter(|s| supports(*s) && ratio[s.index()] > top - MAIN_HYSTERESIS)
        .or(best)
}
