//! When a motion counts as lost, by published rules.

use super::errors::{PlacedPosture, TrackedTick};
use sinew_physics::rehearsal::result::LOST;

/// Error of the pelvis height beyond which a clip is lost, m (Liao et al. 2025, *BeyondMimic*, and the trackers that
/// adopted its rule).
pub const ANCHOR_HEIGHT_M: f64 = 0.25;
/// Difference of the vertical parts of the pelvis's upward axes beyond which a clip is lost (same rule): 0.8 of 2.
pub const ANCHOR_TILT: f64 = 0.8;

/// First time at which the mean distance from the motion that `of` picks exceeds [`LOST`], s.
pub fn phc_lost(
    samples: &[TrackedTick],
    of: impl Fn(&TrackedTick) -> &PlacedPosture,
) -> Option<f64> {
    let lost = |s: &&TrackedTick| s.actual.distance(of(s)) > LOST;
    samples.iter().find(lost).map(|s| s.time)
}

/// Largest mean distance from the motion that `of` picks, m; 0 without samples.
pub fn farthest(samples: &[TrackedTick], of: impl Fn(&TrackedTick) -> &PlacedPosture) -> f64 {
    let distances = samples.iter().map(|s| s.actual.distance(of(s)));
    distances.fold(0.0, f64::max)
}

/// First time at which the pelvis is too high or too low, or tilted too far, s.
pub fn anchor_lost(samples: &[TrackedTick]) -> Option<f64> {
    let lost = |s: &&TrackedTick| {
        let height = s.actual.position[0].z - s.recorded.position[0].z;
        let tilt = s.actual.upright() - s.recorded.upright();
        height.abs() > ANCHOR_HEIGHT_M || tilt.abs() > ANCHOR_TILT
    };
    samples.iter().find(lost).map(|s| s.time)
}

#[cfg(test)]
mod tests {
    use super::super::errors::tests::apart;
    use super::*;
    use sinew_physics::math::{Quat, Vec3};

    #[test]
    fn one_tick_beyond_half_a_metre_is_lost() {
        let far = |at: f64| move |i: usize| Vec3::X * if i == 30 { at } else { 0.1 };
        let of = |s: &[TrackedTick]| phc_lost(s, |s| &s.recorded);
        assert_eq!(of(&apart(far(0.6), 60)), Some(0.5));
        assert_eq!(of(&apart(far(0.49), 60)), None);
        let most = farthest(&apart(far(0.49), 60), |s| &s.recorded);
        assert!((most - 0.49).abs() < 1e-9, "{most}");
    }

    #[test]
    fn the_anchor_rule_sees_height_and_tilt_but_not_place() {
        let up = |h: f64| anchor_lost(&apart(move |_| Vec3::Z * h, 3));
        assert_eq!(
            (up(0.26), up(-0.26), up(0.24)),
            (Some(0.0), Some(0.0), None)
        );
        assert_eq!(anchor_lost(&apart(|_| Vec3::X * 5.0, 3)), None);
        for (angle, lost) in [(1.3, false), (1.5, true)] {
            let mut samples = apart(|_| Vec3::zero(), 3);
            // cos 1.3 = 0.27, cos 1.5 = 0.07
            samples[2].actual.posture.root_rotation = Quat::exp(Vec3::X * angle);
            let upright = samples[2].recorded.upright();
            assert!((upright - 1.0).abs() < 0.01, "{upright}");
            assert_eq!(anchor_lost(&samples).is_some(), lost, "{angle}");
        }
    }
}
