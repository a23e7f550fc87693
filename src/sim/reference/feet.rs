//! Feet and the floor: when a foot is flat on it, how the foot is turned, and where the recorded floor is.

use super::params::floor;
use super::scene::RecordedScene;
use super::segments::{Calibration, FootBone, shortest};
use crate::math::{Quat, Vec3};
use crate::motion::filter::{percentile, renormalised, speeds};
use crate::motion::skeleton_map::SkeletonMap;

/// Place of the recorded floor: the rotation that levels it, the ankle height over it for each foot (after levelling),
/// and its slope.
pub(super) struct Ground {
    pub level: Quat,
    pub height: [f64; 2],
    pub slope: f64,
}

impl RecordedScene<'_> {
    /// Samples in which a foot is flat on the floor: slow, with its ankle low among the slow samples.
    pub(super) fn flat_samples(&self, map: &SkeletonMap, s: usize, leg: f64) -> Vec<usize> {
        let ankle = self.place(map.sides[s].foot);
        let hip = self.place(map.sides[s].thigh);
        let speed = speeds(ankle, self.rate);
        // Only below a standing or squatting body: the feet of a person lying down are slow and low, but not flat.
        let slow: Vec<usize> = (0..self.count)
            .filter(|i| {
                speed[*i] < floor::SLOW && hip[*i].z - ankle[*i].z > floor::HIP_HEIGHT * leg
            })
            .collect();
        let heights: Vec<f64> = slow.iter().map(|i| ankle[*i].z).collect();
        let low = percentile(&heights, floor::LEVEL_SHARE);
        slow.into_iter()
            .filter(|i| (ankle[*i].z - low).abs() < floor::FLAT_HEIGHT)
            .collect()
    }

    /// `world_from_foot` per sample. While the foot is flat on the floor, x points from ankle to toes, made level, and
    /// z points up. `leg`: its length, m.
    pub(super) fn foot_frames(
        &self,
        map: &SkeletonMap,
        s: usize,
        flat: &[usize],
        calibration: &Calibration,
        leg: f64,
    ) -> Vec<Quat> {
        let side = &map.sides[s];
        let turns = self.turn(side.foot);
        let toe = self.take.toe(side);
        let from_rest = || {
            let is_tip = side.toes.is_none();
            self.follow(side.foot, calibration, |pose| {
                toe.map_or(Quat::identity(), |t| {
                    let bone = FootBone {
                        ankle: side.foot,
                        toe: t,
                        is_tip,
                    };
                    self.foot_in_pose(bone, pose, leg)
                })
            })
        };
        let Some(toe) = toe.filter(|_| flat.len() >= floor::FEWEST) else {
            return from_rest();
        };
        let toe = self.place(toe);
        let ankle = self.place(side.foot);
        let mut sum = [0.0; 4];
        let mut first: Option<Quat> = None;
        for &i in flat {
            let d = toe[i] - ankle[i];
            // The foot must be on its sole: one that lies on its side or hangs tells nothing.
            if d.x.hypot(d.y) < floor::LEVEL_TOES * d.norm() {
                continue;
            }
            let q = turns[i].conjugate() * Quat::exp(Vec3::Z * d.y.atan2(d.x));
            let like = *first.get_or_insert(q);
            let sign = if like
                .to_xyzw()
                .iter()
                .zip(q.to_xyzw())
                .map(|(a, b)| a * b)
                .sum::<f64>()
                < 0.0
            {
                -1.0
            } else {
                1.0
            };
            for (s, c) in sum.iter_mut().zip(q.to_xyzw()) {
                *s += sign * c;
            }
        }
        let length = sum.iter().map(|c| c * c).sum::<f64>().sqrt();
        // Scattered answers (norm well below the count) are no calibration.
        if length < floor::AGREEMENT * flat.len() as f64 {
            return from_rest();
        }
        let bone_from_foot = renormalised(Quat::from_xyzw(sum.map(|c| c / length)));
        turns
            .iter()
            .map(|q| (*q * bone_from_foot).normalized())
            .collect()
    }
}

/// Fits the floor to ankles of flat feet: height, and slope where the feet visit enough ground to tell.
pub(super) fn fit_floor(ankle: &[Vec<Vec3>; 2], flat: &[Vec<usize>; 2]) -> Ground {
    let mut points = Vec::new();
    for s in 0..2 {
        let own = flat[s].iter().map(|i| ankle[s][*i]);
        // The feet may differ in height relative to their joints, so slopes are compared instead of levels.
        let mean = percentile(&own.clone().map(|p| p.z).collect::<Vec<_>>(), 0.5);
        points.extend(own.map(|p| Vec3 { z: p.z - mean, ..p }));
    }
    let n = points.len().max(1) as f64;
    let centre = points.iter().fold(Vec3::zero(), |s, p| s + *p) * (1.0 / n);
    // Regularised least squares: a spread of 0.2 m gives the data half its weight, so a small patch of floor is taken
    // as level.
    let (mut xx, mut xy, mut yy, mut xz, mut yz) =
        (floor::SPREAD2 * n, 0.0, floor::SPREAD2 * n, 0.0, 0.0);
    for p in &points {
        let d = *p - centre;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
        xz += d.x * d.z;
        yz += d.y * d.z;
    }
    let det = xx * yy - xy * xy;
    let (sx, sy) = if det > 1e-9 {
        ((xz * yy - yz * xy) / det, (yz * xx - xz * xy) / det)
    } else {
        (0.0, 0.0)
    };
    // A slope above 5 % is not a floor but a motion that the fit misread.
    let slope = sx.hypot(sy);
    let (sx, sy) = if slope < floor::MOST_SLOPE {
        (sx, sy)
    } else {
        (0.0, 0.0)
    };
    let normal = Vec3 {
        x: -sx,
        y: -sy,
        z: 1.0,
    }
    .normalized_or(Vec3::Z);
    let level = shortest(normal, Vec3::Z);
    let heights = [0, 1].map(|s| {
        let of_flat: Vec<f64> = flat[s]
            .iter()
            .map(|i| level.rotate(ankle[s][*i]).z)
            .collect();
        if of_flat.len() >= floor::FEWEST {
            Some(percentile(&of_flat, 0.5))
        } else {
            None
        }
    });
    let lowest = || {
        let all: Vec<f64> = ankle.iter().flatten().map(|p| level.rotate(*p).z).collect();
        percentile(&all, floor::LOWEST_SHARE)
    };
    let height = match heights {
        // Both feet are on one floor. If their heights differ by more than 4 cm, the lower one is right.
        [Some(a), Some(b)] if (a - b).abs() < floor::SAME_HEIGHT => [a, b],
        [Some(a), Some(b)] => [a.min(b); 2],
        [Some(a), None] | [None, Some(a)] => [a; 2],
        [None, None] => [lowest(); 2],
    };
    Ground {
        level,
        height,
        slope: sx.hypot(sy),
    }
}
