//! Where a figure is whose file does not say so: the path of its root from the feet that stand.
//!
//! A file without root positions has its figure hang at one place, and the feet of a squat rise. The lowest points of a
//! figure are on the floor, and do not slide on it: that gives the height of the root, and the way it takes.

use super::UpAxis;
use super::recording::Recording;
use crate::math::Vec3;
use crate::motion::filter::{low_pass, percentile};
use crate::motion::skeleton_map::SkeletonMap;
use crate::retarget::params::root;

/// Heights of joints over the floor they rest on, in lengths of the leg: ankle, toe joint, tip of the toes, knee, hip,
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
/// What a file says of the place of the root.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RootPath {
    /// Where it is.
    Given,
    /// How high it is, but nothing moves along the floor.
    InPlace,
    /// Nothing.
    Missing,
}

impl RootPath {
    /// * `leg`: length of a leg, file units.
    pub(super) fn of(take: &Recording, map: &SkeletonMap, up: UpAxis, leg: f64) -> Self {
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
            at = take.parent[k];
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

    /// What a user should know of it.
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

/// Kept bones and tips that may touch the floor, with their height over it then.
fn touching(take: &Recording, map: &SkeletonMap, leg: f64) -> Vec<(usize, f64)> {
    let mut out = Vec::new();
    let mut add = |point: Option<usize>, which: usize| {
        out.extend(point.map(|p| (take.at(p), CLEARANCE[which] * leg)));
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

/// Moves every point so that the lowest ones stand on a level floor. A figure that hardly moves by that stays where it
/// is; false then.
///
/// * `places`: world positions, `[bone][frame]`, file units and axes; `leg`: length of a leg, file units; `rate_hz`:
///   frames per second.
///
/// O(frames).
pub(super) fn follow_feet(
    places: &mut [Vec<Vec3>],
    (take, map): (&Recording, &SkeletonMap),
    (path, up, leg): (RootPath, UpAxis, f64),
    rate_hz: f64,
) -> bool {
    let way = path_by_feet(places, (take, map), (path, up, leg), rate_hz);
    let first = way.first().copied().unwrap_or_default();
    let far = way.iter().map(|w| (*w - first).norm());
    if far.fold(0.0, f64::max) < root::LEAST_WAY * leg {
        return false;
    }
    for place in places {
        place.iter_mut().zip(&way).for_each(|(p, w)| *p += *w);
    }
    true
}

/// How far the root has to be moved in each frame.
fn path_by_feet(
    places: &[Vec<Vec3>],
    (take, map): (&Recording, &SkeletonMap),
    (path, up, leg): (RootPath, UpAxis, f64),
    rate_hz: f64,
) -> Vec<Vec3> {
    let n = take.len();
    let vertical = match up {
        UpAxis::Y => Vec3::Y,
        UpAxis::Z => Vec3::Z,
    };
    let points = touching(take, map, leg);
    let height = |(k, clear): (usize, f64), i: usize| places[k][i].dot(vertical) - clear;
    let lowest: Vec<f64> = (0..n)
        .map(|i| {
            let heights = points.iter().map(|p| height(*p, i));
            heights.fold(f64::INFINITY, f64::min)
        })
        .collect();
    let level = percentile(&lowest, root::LOW_SHARE);
    let still = root::STILL * leg / rate_hz;
    let mut way = vec![Vec3::zero(); n];
    let mut step = Vec3::zero();
    for i in 1..n {
        let off = path == RootPath::InPlace
            && lowest[i].min(lowest[i - 1]) - level > root::OFF_FLOOR * leg;
        if !off {
            step = -slide(
                &points,
                i,
                |k, j| places[k][j],
                |p, j| height(p, j) - lowest[j],
                (vertical, root::WEIGHT_HEIGHT * leg, still),
            );
        }
        way[i] = way[i - 1] + step;
    }
    if path == RootPath::Missing {
        let mut down = lowest;
        low_pass(&mut down, root::CUTOFF, rate_hz);
        for (w, z) in way.iter_mut().zip(down) {
            *w -= vertical * z;
        }
    }
    way
}

/// The way along the floor that the points on it have in common from frame `i − 1` to frame `i`: a mean in which what
/// slides less than the others counts for more.
fn slide(
    points: &[(usize, f64)],
    i: usize,
    place: impl Fn(usize, usize) -> Vec3,
    over: impl Fn((usize, f64), usize) -> f64,
    (vertical, soft, still): (Vec3, f64, f64),
) -> Vec3 {
    let moved: Vec<(Vec3, f64)> = points
        .iter()
        .map(|&p| {
            let way = place(p.0, i) - place(p.0, i - 1);
            let weight = (-0.5 * (over(p, i) + over(p, i - 1)) / soft).exp();
            (way - vertical * way.dot(vertical), weight)
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
            let w = weight / (off + still);
            sum += *way * w;
            weights += w;
        }
        common = sum * (1.0 / weights.max(1e-300));
    }
    common
}
