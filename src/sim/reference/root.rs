//! Path of a figure's root where the file does not state it, derived from the planted feet.
//!
//! In a file without root positions the figure hangs at one place, and the feet of a squat rise. The lowest points of a
//! figure are on the floor and do not slide on it: that gives the height of the root and its path.

use super::take::Take;
use crate::math::Vec3;
use crate::motion::filter::{low_pass, percentile};
use crate::motion::recording::UpAxis;
use crate::motion::skeleton_map::SkeletonMap;
use crate::reference::params::root;

/// Heights of joints over the floor on which they rest, in leg lengths: ankle, toe joint, tip of the toes, knee, hip,
/// wrist or elbow, shoulder or head.
const CLEARANCE: [f64; 7] = [
    root::ANKLE_HEIGHT,
    root::TOE_JOINT_HEIGHT,
    root::TOE_TIP_HEIGHT,
    root::KNEE_HEIGHT,
    root::HIP_HEIGHT,
    root::ARM_HEIGHT,
    root::HEAD_HEIGHT,
];
/// How much a file states about the place of the root.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RootEvidence {
    /// Its whole path.
    Given,
    /// Its height only; nothing moves along the floor.
    InPlace,
    /// Nothing.
    Missing,
}

impl RootEvidence {
    /// * `leg`: length of a leg, file units.
    pub(super) fn of(take: &Take<'_>, map: &SkeletonMap, up: UpAxis, leg: f64) -> Self {
        let mut ranges = [0.0f64; 3];
        let mut at = Some(take.at(map.pelvis));
        while let Some(k) = at {
            for (c, range) in ranges.iter_mut().enumerate() {
                let values = take.step[k].iter().map(|p| p.to_array()[c]);
                let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| {
                    (l.min(v), h.max(v))
                });
                *range = range.max(high - low);
            }
            at = take.parent(k);
        }
        let axis = match up {
            UpAxis::Y => 1,
            UpAxis::Z => 2,
        };
        let moves = |c: usize| ranges[c] > root::LEAST_MOTION * leg;
        match ((0..3).any(|c| c != axis && moves(c)), moves(axis)) {
            (true, _) => Self::Given,
            (false, true) => Self::InPlace,
            (false, false) => Self::Missing,
        }
    }

    /// Message for the user.
    pub(super) fn warning(self) -> Option<&'static str> {
        match self {
            Self::Given => None,
            Self::InPlace => Some(
                "the file's root does not move along the floor: its path follows from the planted feet",
            ),
            Self::Missing => Some(
                "the file has no root positions: the path of the pelvis follows from the planted feet, without flights",
            ),
        }
    }
}

/// The root of a figure whose file does not state its whole path.
pub(super) struct RootFollowing<'a> {
    pub take: &'a Take<'a>,
    pub map: &'a SkeletonMap,
    pub path: RootEvidence,
    pub up: UpAxis,
    /// Length of a leg, file units.
    pub leg: f64,
    /// Frames per second.
    pub rate_hz: f64,
}

/// A point that may touch the floor: index of its path, and its height over the floor at contact, file units.
#[derive(Clone, Copy)]
struct FloorPoint {
    path: usize,
    clearance: f64,
}

impl RootFollowing<'_> {
    /// Moves every point so that the lowest ones are planted on a level floor. Returns whether anything was moved: a
    /// figure that would hardly move stays where it is.
    ///
    /// * `places`: world positions, `[bone][frame]`, file units and axes.
    ///
    /// O(frames).
    pub(super) fn follow_feet(&self, places: &mut [Vec<Vec3>]) -> bool {
        let way = self.path_by_feet(places);
        let first = way.first().copied().unwrap_or_default();
        let far = way.iter().map(|w| (*w - first).norm());
        if far.fold(0.0, f64::max) < root::LEAST_WAY * self.leg {
            return false;
        }
        for place in places {
            place.iter_mut().zip(&way).for_each(|(p, w)| *p += *w);
        }
        true
    }

    /// How far the root has to be moved in each frame.
    fn path_by_feet(&self, places: &[Vec<Vec3>]) -> Vec<Vec3> {
        let (n, leg) = (self.take.len(), self.leg);
        let vertical = match self.up {
            UpAxis::Y => Vec3::Y,
            UpAxis::Z => Vec3::Z,
        };
        let points = self.touching();
        let height = |p: FloorPoint, i: usize| places[p.path][i].dot(vertical) - p.clearance;
        let lowest: Vec<f64> = (0..n)
            .map(|i| {
                let heights = points.iter().map(|p| height(*p, i));
                heights.fold(f64::INFINITY, f64::min)
            })
            .collect();
        let level = percentile(&lowest, root::LOW_SHARE);
        let floor = Sliding {
            vertical,
            soft: root::WEIGHT_HEIGHT * leg,
            still: root::STILL * leg / self.rate_hz,
        };
        let mut way = vec![Vec3::zero(); n];
        let mut step = Vec3::zero();
        for i in 1..n {
            let off = self.path == RootEvidence::InPlace
                && lowest[i].min(lowest[i - 1]) - level > root::OFF_FLOOR * leg;
            if !off {
                let over = |p, j| height(p, j) - lowest[j];
                let moved = points.iter().map(|&p| PointMotion {
                    way: places[p.path][i] - places[p.path][i - 1],
                    height: over(p, i) + over(p, i - 1),
                });
                step = -floor.common_way(moved);
            }
            way[i] = way[i - 1] + step;
        }
        if self.path == RootEvidence::Missing {
            let mut down = lowest;
            low_pass(&mut down, root::CUTOFF, self.rate_hz);
            for (w, z) in way.iter_mut().zip(down) {
                *w -= vertical * z;
            }
        }
        way
    }

    /// Kept bones and tips that may touch the floor.
    fn touching(&self) -> Vec<FloorPoint> {
        let (take, map) = (self.take, self.map);
        let mut out = Vec::new();
        let mut add = |point: Option<usize>, which: usize| {
            out.extend(point.map(|p| FloorPoint {
                path: take.at(p),
                clearance: CLEARANCE[which] * self.leg,
            }));
        };
        for side in &map.sides {
            add(Some(side.foot), 0);
            add(side.toes, 1);
            add(take.tip(side.toes.unwrap_or(side.foot)), 2);
            add(Some(side.shank), 3);
            add(Some(side.thigh), 4);
            add(Some(side.forearm), 5);
            add(take.wrist(side), 5);
            add(Some(side.upper_arm), 6);
        }
        add(map.head, 6);
        out
    }
}

/// Displacement of a point between two frames, and the sum of its heights over the lowest point in both.
struct PointMotion {
    way: Vec3,
    height: f64,
}

/// How points that slide on the floor are weighted.
struct Sliding {
    vertical: Vec3,
    /// Height over which a point's weight falls to 1/e, file units.
    soft: f64,
    /// Displacement allowed to a point at rest, per frame, file units.
    still: f64,
}

impl Sliding {
    /// The common displacement along the floor of the points on it: a mean in which a point that slides less than the
    /// others has a larger weight.
    fn common_way(&self, points: impl Iterator<Item = PointMotion>) -> Vec3 {
        let moved: Vec<(Vec3, f64)> = points
            .map(|p| {
                let weight = (-0.5 * p.height / self.soft).exp();
                (p.way - self.vertical * p.way.dot(self.vertical), weight)
            })
            .collect();
        let mut common = Vec3::zero();
        for round in 0..root::ROUNDS {
            let (mut sum, mut weights) = (Vec3::zero(), 0.0);
            for (way, weight) in &moved {
                let off = if round == 0 {
                    0.0
                } else {
                    (*way - common).norm()
                };
                let w = weight / (off + self.still);
                sum += *way * w;
                weights += w;
            }
            common = sum * (1.0 / weights.max(1e-300));
        }
        common
    }
}
