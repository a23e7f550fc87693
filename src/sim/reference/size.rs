//! How large the recorded person is, and which axis of the file points up.

use super::error::RetargetError;
use super::take::Take;
use crate::math::Vec3;
use crate::motion::filter::percentile;
use crate::motion::recording::UpAxis;
use crate::motion::skeleton_map::SkeletonMap;
use crate::reference::params::size;

/// Units that files use, m: metre, decimetre, centimetre, millimetre, inch, CMU (inch / 0.45), foot.
const UNITS: [f64; 7] = [1.0, 0.1, 0.01, 0.001, 0.0254, 0.0254 / 0.45, 0.3048];
/// Lengths of the figure in file units.
pub(super) struct FigureMeasure {
    pub leg: f64,
    pub stature: f64,
}

/// Leg and stature of the recording.
pub(super) fn measure(
    places: &[Vec<Vec3>],
    take: &Take<'_>,
    map: &SkeletonMap,
) -> Result<FigureMeasure, RetargetError> {
    let n = take.len();
    let median_length = |a: usize, b: usize| {
        let v: Vec<f64> = (0..n)
            .step_by((n / 500).max(1))
            .map(|i| (places[take.at(a)][i] - places[take.at(b)][i]).norm())
            .collect();
        percentile(&v, 0.5)
    };
    let mut leg = 0.0;
    for s in &map.sides {
        for (a, b) in [
            (s.thigh, s.shank),
            (s.shank, s.foot),
            (s.upper_arm, s.forearm),
        ] {
            let l = median_length(a, b);
            if !(l > 0.0 && l.is_finite()) {
                return Err(RetargetError::Degenerate {
                    bone: take.joint_name(a),
                });
            }
            if a != s.upper_arm {
                leg += 0.5 * l;
            }
        }
        if !take
            .wrist(s)
            .is_some_and(|w| median_length(s.forearm, w) > 0.0)
        {
            return Err(RetargetError::Degenerate {
                bone: take.joint_name(s.forearm),
            });
        }
    }
    // Hip to shoulder height is about 0.29 of stature; many rigs have odd heads, so head tops are not used.
    let trunk: Vec<f64> = (0..n)
        .step_by((n / 500).max(1))
        .map(|i| {
            let mid = |a: usize, b: usize| (places[take.at(a)][i] + places[take.at(b)][i]) * 0.5;
            (mid(map.sides[0].upper_arm, map.sides[1].upper_arm)
                - mid(map.sides[0].thigh, map.sides[1].thigh))
            .norm()
        })
        .collect();
    let trunk = percentile(&trunk, 0.8);
    Ok(FigureMeasure {
        leg,
        stature: size::LEG_WEIGHT * leg / size::LEG_OF_STATURE
            + size::TRUNK_WEIGHT * trunk / size::TRUNK_OF_STATURE,
    })
}

/// Length of a file unit and the stature that follows from it, m.
pub(super) struct FileUnit {
    pub unit_m: f64,
    pub stature: f64,
}

/// The unit of a file, from the stature in file units.
pub(super) fn unit(given: Option<f64>, measured: f64) -> Result<FileUnit, RetargetError> {
    match given {
        Some(unit_m) => {
            let stature = measured * unit_m;
            if !(size::LEAST_STATURE..=size::MOST_STATURE).contains(&stature) {
                return Err(RetargetError::Stature {
                    unit_m,
                    stature,
                    measured,
                });
            }
            Ok(FileUnit { unit_m, stature })
        }
        None => UNITS
            .into_iter()
            .find(|u| {
                (size::LEAST_LIKELY_STATURE..=size::MOST_LIKELY_STATURE).contains(&(measured * u))
            })
            .map(|unit_m| FileUnit {
                unit_m,
                stature: measured * unit_m,
            })
            .ok_or(RetargetError::Unit { measured }),
    }
}

/// The axis along which shoulders are over ankles most of the time.
pub(super) fn guess_up(places: &[Vec<Vec3>], take: &Take<'_>, map: &SkeletonMap) -> UpAxis {
    let mut sum = Vec3::zero();
    for i in 0..take.len() {
        let p = |j: usize| places[take.at(j)][i];
        let top = p(map.sides[0].upper_arm) + p(map.sides[1].upper_arm);
        let low = p(map.sides[0].foot) + p(map.sides[1].foot);
        sum += (top - low).normalized_or(Vec3::zero());
    }
    if sum.z > sum.y { UpAxis::Z } else { UpAxis::Y }
}
