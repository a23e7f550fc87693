//! Support ratios, Eq. (2): which support carries most, and which one serves as the root.

use super::contact_set::SupportPoint;
use crate::body::{SEGMENT_COUNT, SegmentId};
use crate::math::Vec3;

/// The main support is kept while its share is within this much of the largest. Otherwise it would flicker in symmetric
/// stance.
pub const MAIN_HYSTERESIS: f64 = 0.1;

/// Shares that differ by less count as equal, and the first support is taken.
const TIE: f64 = 1e-9;

/// A surface that a segment touches: the floor, a slope, a table, a wall, another figure.
#[derive(Clone, Copy, Debug)]
pub struct Touching {
    /// The support to which it counts.
    pub support: SegmentId,
    /// World, m.
    pub position: Vec3,
    /// Unit vector out of the surface, world axes.
    pub normal: Vec3,
}

impl From<&SupportPoint> for Touching {
    fn from(point: &SupportPoint) -> Self {
        Self {
            support: point.support,
            position: point.position,
            normal: point.normal,
        }
    }
}

/// Ratios of all supports, Eq. (2), normalised to a sum of 1.
///
/// α_i = max(0, (a_m·l̂_i)(n_i·l̂_i)), l_i from the centroid of the support's contacts to the centre of mass, n_i the
/// mean of their normals. `a_m` includes gravity, `a_m = c̈ − g`: without it every ratio of a resting figure is zero.
///
/// * `com`: world, m. `pull`: a_m, world axes, m/s².
/// * Returns one number per segment, 0 where it does not support. Equal shares if every α is zero.
pub fn support_ratios(
    contacts: impl Iterator<Item = Touching>,
    com: Vec3,
    pull: Vec3,
) -> [f64; SEGMENT_COUNT] {
    let mut count = [0.0; SEGMENT_COUNT];
    let (mut sum, mut normals) = ([Vec3::zero(); SEGMENT_COUNT], [Vec3::zero(); SEGMENT_COUNT]);
    for c in contacts {
        let s = c.support.index();
        sum[s] += c.position;
        normals[s] += c.normal;
        count[s] += 1.0;
    }
    let mut ratio = [0.0; SEGMENT_COUNT];
    let (mut total, mut supports) = (0.0, 0.0);
    for s in 0..SEGMENT_COUNT {
        if count[s] > 0.0 {
            let normal = normals[s].normalized_or(Vec3::Z);
            let l = (com - sum[s] * (1.0 / count[s])).normalized_or(normal);
            ratio[s] = (pull.dot(l) * normal.dot(l)).max(0.0); // Eq. 2
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
