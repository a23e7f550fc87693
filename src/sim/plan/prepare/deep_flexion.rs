//! Legs that fold further than the body's can: the pelvis gives way where limits would put feet into the floor.
//!
//! Hips flex by 125°, and the spine adds to that: a person in a deep squat tilts the pelvis back and rounds the back.
//! The same is done here. Where a hip lacks flexion, the pelvis is tilted back about the line of the hips, and the
//! spine brings the chest forward again as far as it can. Whatever the knees and ankles still lack raises the pelvis.
//! Both come and go smoothly, and the legs are solved again.

use super::pelvis_yaw::turn_about;
use crate::body::angles::{anatomical_angles, clamp_to_limits};
use crate::body::topology::{DOF_COUNT, DOF_START, FEET, THIGHS};
use crate::body::{Body, Posture};
use crate::math::{Quat, Vec3};
use crate::motion::leg_ik::{forward, solve_leg};
use crate::plan::envelope::smoothest_below;
use crate::plan::foot_lock::{LockedFoot, Sole};
use crate::plan::params::leg;
use crate::plan::{least_without, toe_hinge};

/// How far the pelvis gave way.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct DeepFlexion {
    /// Largest tilt, rad.
    pub tilt_max: f64,
    /// Largest raise, m.
    pub raise_max: f64,
}

/// Depth of each foot in the floor when a posture is within its limits, m; 0 for a leg that would have to reach further
/// back, which the knee lifts.
fn depths(body: &Body, posture: &Posture, soles: &[Sole; 2]) -> [f64; 2] {
    let mut within = *posture;
    let off = clamp_to_limits(body, &mut within, leg::LIMIT_MARGIN * 0.5);
    let poses = forward(body, &within);
    [0, 1].map(|s| {
        if off[DOF_START[THIGHS[s].index()]] < 0.0 {
            return 0.0;
        }
        let (ankle, rotation) = poses[FEET[s].index()];
        -(ankle.z + soles[s].lowest(rotation, within.hinge[toe_hinge(s)]))
    })
}

/// Depth of the deeper foot, m.
fn deepest(body: &Body, posture: &Posture, soles: &[Sole; 2]) -> f64 {
    depths(body, posture, soles).into_iter().fold(0.0, f64::max)
}

/// How far the hips of the feet that are `deep` in the floor flex beyond their limit, rad.
fn lacks_flexion(body: &Body, posture: &Posture, deep: [bool; 2]) -> f64 {
    let angles: [f64; DOF_COUNT] = anatomical_angles(posture);
    (0..2)
        .filter(|s| deep[*s])
        .map(|s| DOF_START[THIGHS[s].index()])
        .map(|d| angles[d] - (body.upper[d] - leg::PLANTED_MARGIN))
        .fold(0.0, f64::max)
}

/// Moves the pelvis while the feet stay as they are in `like`; planted ones stay locked.
fn give_way(
    body: &Body,
    like: &Posture,
    tilt: f64,
    raise: f64,
    feet: [((Vec3, Quat), f64); 2],
) -> Posture {
    let mut posture = *like;
    let before = like.root_rotation;
    let hips = THIGHS.map(|t| body.joint_offset[t.index()]);
    let middle = (hips[0] + hips[1]) * 0.5;
    let left = before.rotate(hips[0] - hips[1]).normalized_or(Vec3::Y);
    // Backwards is a negative angle about the left axis.
    turn_about(&mut posture, left, -tilt);
    let root = posture.root_rotation;
    posture.root_position += before.rotate(middle) - root.rotate(middle) + Vec3::Z * raise;
    for (s, (pose, toe)) in feet.into_iter().enumerate() {
        solve_leg(body, &mut posture, s == 0, pose, toe);
    }
    posture
}

/// Tilts back and raises the pelvis where the limits of folded legs would put feet into the floor by more than
/// [`leg::DEEP`].
///
/// * `postures`: legs solved, not yet within their limits; `planted`: of each sample; `soles`, `locked`: intended
///   places of planted feet.
///
/// O(n).
pub(super) fn unfold(
    body: &Body,
    postures: &mut [Posture],
    planted: &[[bool; 2]],
    soles: &[Sole; 2],
    locked: &[LockedFoot; 2],
    rate_hz: f64,
) -> DeepFlexion {
    let n = postures.len();
    let deep: Vec<[bool; 2]> = postures
        .iter()
        .map(|p| depths(body, p, soles).map(|d| d > leg::DEEP))
        .collect();
    if deep.iter().all(|d| *d == [false; 2]) {
        return DeepFlexion::default();
    }
    let original = postures.to_vec();
    // Places of the feet: the lock of a planted one, the solved pose of any other.
    let feet: Vec<[((Vec3, Quat), f64); 2]> = (0..n)
        .map(|i| {
            let poses = forward(body, &original[i]);
            std::array::from_fn(|s| {
                let lock = &locked[s].poses[i];
                if planted[i][s] {
                    ((lock.ankle, lock.rotation), lock.toe)
                } else {
                    (poses[FEET[s].index()], original[i].hinge[toe_hinge(s)])
                }
            })
        })
        .collect();
    let with = |i: usize, tilt: f64, raise: f64| give_way(body, &original[i], tilt, raise, feet[i]);
    let smooth = |need: &[f64]| -> Vec<f64> {
        let ceiling: Vec<f64> = need.iter().map(|x| -x).collect();
        let curve = smoothest_below(&ceiling, leg::DROP_TIME, rate_hz);
        curve.into_iter().map(|x| (-x).max(0.0)).collect()
    };

    let mut need = vec![0.0f64; n];
    for i in (0..n).filter(|i| deep[*i] != [false; 2]) {
        for _ in 0..leg::TILT_ROUNDS {
            let lacks = lacks_flexion(body, &with(i, need[i], 0.0), deep[i]);
            need[i] = (need[i] + lacks).min(leg::MOST_TILT);
        }
        // Where another joint is clamped, a tilt may put the feet deeper.
        if deepest(body, &with(i, need[i], 0.0), soles) >= deepest(body, &original[i], soles) {
            need[i] = 0.0;
        }
    }
    let tilt = smooth(&need);
    let mut need = vec![0.0f64; n];
    for i in 0..n {
        // A free foot is raised later, by its own leg.
        let depth = |raise: f64| {
            let both = depths(body, &with(i, tilt[i], raise), soles);
            let standing = both.into_iter().zip(planted[i]).filter(|(_, on)| *on);
            standing.fold(0.0f64, |most, (depth, _)| most.max(depth))
        };
        let first = depth(0.0);
        if first <= leg::DEEP {
            continue;
        }
        let most = first.min(leg::MOST_RAISE);
        need[i] = least_without(most, leg::RAISE_HALVINGS, |raise| depth(raise) > leg::DEEP);
    }
    let raise = smooth(&need);
    for (i, posture) in postures.iter_mut().enumerate() {
        if tilt[i].max(raise[i]) > 1e-6 {
            *posture = with(i, tilt[i], raise[i]);
        }
    }
    let most = |v: &[f64]| v.iter().copied().fold(0.0, f64::max);
    DeepFlexion {
        tilt_max: most(&tilt),
        raise_max: most(&raise),
    }
}
