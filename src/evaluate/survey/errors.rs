//! Distance of a figure from a motion that is fixed in the world, tick by tick.

use super::outcome::TrackingErrors;
use crate::pose::segment_poses;
use sinew_physics::body::{Body, DOF_COUNT, Posture, SEGMENT_COUNT};
use sinew_physics::math::Vec3;
use sinew_physics::math::rounding::short;

/// A posture with the positions of its segments.
#[derive(Clone, Debug)]
pub struct PlacedPosture {
    /// The posture.
    pub posture: Posture,
    /// World positions of the segment origins, m.
    pub position: [Vec3; SEGMENT_COUNT],
}

impl PlacedPosture {
    /// For a body in `posture`.
    pub fn new(body: &Body, posture: &Posture) -> Self {
        Self {
            posture: *posture,
            position: segment_poses(&body.joint_offset, posture).map(|p| p.position),
        }
    }

    /// Mean distance of the segment origins, m.
    pub fn distance(&self, other: &Self) -> f64 {
        self.mean(|s| (self.position[s] - other.position[s]).norm())
    }

    /// The same with both pelvis origins in one place, m.
    pub fn distance_from_root(&self, other: &Self) -> f64 {
        let shift = self.position[0] - other.position[0];
        self.mean(|s| (self.position[s] - other.position[s] - shift).norm())
    }

    /// Vertical part of the pelvis's upward axis: 1 upright, −1 upside down.
    pub fn upright(&self) -> f64 {
        self.posture.root_rotation.rotate(Vec3::Z).z
    }

    fn mean(&self, of: impl Fn(usize) -> f64) -> f64 {
        (0..SEGMENT_COUNT).map(of).sum::<f64>() / SEGMENT_COUNT as f64
    }
}

/// One tick within the clip.
#[derive(Clone, Debug)]
pub struct TrackedTick {
    /// Time on the clip's clock, s.
    pub time: f64,
    /// The figure.
    pub actual: PlacedPosture,
    /// The recording as fitted to the body.
    pub recorded: PlacedPosture,
    /// The motion as prepared.
    pub prepared: PlacedPosture,
    /// Left and right foot that the floor pushes.
    pub down: [bool; 2],
    /// Left and right foot that the recording has on the floor.
    pub labelled: [bool; 2],
}

/// Mean errors of the samples against the motion that `of` picks; zeros for no samples.
pub fn errors(
    samples: &[TrackedTick],
    of: impl Fn(&TrackedTick) -> &PlacedPosture,
) -> TrackingErrors {
    let n = samples.len().max(1) as f64;
    let mut out = TrackingErrors::default();
    let mut square = 0.0;
    for s in samples {
        let wanted = of(s);
        out.mpjpe_root_mm += 1e3 * s.actual.distance_from_root(wanted) / n;
        out.mpjpe_global_mm += 1e3 * s.actual.distance(wanted) / n;
        let off = s.actual.posture.joint_difference(&wanted.posture);
        square += off.iter().map(|e| e * e).sum::<f64>() / DOF_COUNT as f64;
    }
    out.joint_rms_deg = (square / n).sqrt().to_degrees();
    TrackingErrors {
        mpjpe_root_mm: short(out.mpjpe_root_mm),
        mpjpe_global_mm: short(out.mpjpe_global_mm),
        joint_rms_deg: short(out.joint_rms_deg),
    }
}

/// Root mean square of the third differences of all segment origins, figure over recording; `None` without four ticks
/// or without any in the recording.
pub fn jerk_ratio(samples: &[TrackedTick]) -> Option<f64> {
    let square = |of: &dyn Fn(&TrackedTick) -> &PlacedPosture| {
        let third = |w: &[TrackedTick], s: usize| {
            let p = |i: usize| of(&w[i]).position[s];
            (p(3) - p(2) * 3.0 + p(1) * 3.0 - p(0)).norm()
        };
        samples
            .windows(4)
            .flat_map(|w| (0..SEGMENT_COUNT).map(move |s| third(w, s)))
            .map(|j| j * j)
            .sum::<f64>()
    };
    let (actual, recorded) = (square(&|s| &s.actual), square(&|s| &s.recorded));
    (recorded > 1e-12).then(|| short((actual / recorded).sqrt()))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use sinew_physics::motion::builtin::at_ease;

    /// A figure that stands `off` from a recording that stands, at 60 ticks a second.
    pub(in crate::survey) fn apart(off: impl Fn(usize) -> Vec3, n: usize) -> Vec<TrackedTick> {
        let body = Body::adult_man();
        let posture = at_ease(&body);
        let there = PlacedPosture::new(&body, &posture);
        (0..n)
            .map(|i| {
                let mut moved = posture;
                moved.root_position += off(i);
                TrackedTick {
                    time: i as f64 / 60.0,
                    actual: PlacedPosture::new(&body, &moved),
                    recorded: there.clone(),
                    prepared: there.clone(),
                    down: [true; 2],
                    labelled: [true; 2],
                }
            })
            .collect()
    }

    #[test]
    fn a_constant_offset_is_all_of_the_global_and_none_of_the_root_relative_error() {
        let samples = apart(|_| Vec3::from_array([0.03, 0.04, 0.0]), 10);
        let e = errors(&samples, |s| &s.recorded);
        assert!((e.mpjpe_global_mm - 50.0).abs() < 1e-6, "{e:?}");
        assert!(e.mpjpe_root_mm < 1e-9 && e.joint_rms_deg < 1e-9, "{e:?}");
    }

    #[test]
    fn one_joint_off_is_shared_by_all_dofs() {
        let mut samples = apart(|_| Vec3::zero(), 4);
        for s in &mut samples {
            s.actual.posture.hinge[0] += 0.39; // the left elbow
        }
        let e = errors(&samples, |s| &s.recorded);
        let want = (0.39f64 * 0.39 / 39.0).sqrt().to_degrees();
        assert!((e.joint_rms_deg - want).abs() < 1e-5, "{e:?}");
    }

    #[test]
    fn jerk_is_that_of_the_third_differences() {
        // Both move along the same cubic, the figure twice as far: jerk is the third derivative, which is constant.
        let body = Body::adult_man();
        let mut samples = apart(|i| Vec3::X * (2e-4 * (i as f64).powi(3)), 12);
        let posture = at_ease(&body);
        for (i, s) in samples.iter_mut().enumerate() {
            let mut moved = posture;
            moved.root_position += Vec3::X * (1e-4 * (i as f64).powi(3));
            s.recorded = PlacedPosture::new(&body, &moved);
        }
        assert!((jerk_ratio(&samples).expect("moves") - 2.0).abs() < 1e-6);
        assert_eq!(
            jerk_ratio(&apart(|_| Vec3::zero(), 10)),
            None,
            "no jerk to compare with"
        );
    }
}
