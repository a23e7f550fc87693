//! Every tunable number of retargeting, grouped by subject.

use crate::params::Param;

/// Detection of the runs in a recording.
pub mod run_detection {
    crate::params::params! {
        /// People run above this speed: half of that at which a leg of 0.9 m would leave the floor, squared.
        RUN_SPEED: f64 = 2.2, "m/s", 1.8..=3.0, "docs/locomotion.md#runs";
        /// Motion before or after a run that is faster than this belongs to it; a run that is walked gets this speed.
        WALK_SPEED: f64 = 1.05, "m/s", 0.6..=1.8, "docs/locomotion.md#runs";
        /// Cut-off of the path of the body, for its direction, its speed and its pace.
        PATH_CUTOFF: f64 = 2.0, "Hz", 0.5..=5.0, "docs/locomotion.md#runs";
        /// Least cut-off of a run: its steps come three to five times a second.
        RUN_CUTOFF: f64 = 10.0, "Hz", 6.0..=20.0, "docs/locomotion.md#runs";
        /// Time before and after over which a pace is taken.
        PACE_TIME: f64 = 0.05, "s", 0.02..=0.2, "docs/locomotion.md#runs";
        /// Cut-off of the height of the body, for its fall.
        FALL_CUTOFF: f64 = 12.0, "Hz", 6.0..=20.0, "docs/locomotion.md#runs";
        /// Cut-off of the lead of one foot over the other.
        LEAD_CUTOFF: f64 = 8.0, "Hz", 4.0..=15.0, "docs/locomotion.md#runs";
        /// The lead has turned once it is back by so much.
        LEAD_TURN: f64 = 0.05, "m", 0.01..=0.15, "docs/locomotion.md#runs";
        /// A smaller lead is no step.
        LEAST_LEAD: f64 = 0.12, "m", 0.03..=0.3, "docs/locomotion.md#runs";
        /// Longest step of a run.
        LONGEST_STEP: f64 = 0.5, "s", 0.3..=0.8, "docs/locomotion.md#runs";
        /// A body that accelerates downwards with this share of gravity flies.
        FALL_SHARE: f64 = 0.4, "1", 0.1..=0.9, "docs/locomotion.md#runs";
        /// It is looked at within this share of a step from where the feet are farthest apart.
        FALL_WINDOW: f64 = 0.25, "1", 0.1..=0.5, "docs/locomotion.md#runs";
        /// Fewest steps of a run.
        FEWEST_STEPS: usize = 2, "1", 1..=6, "docs/locomotion.md#runs";
        /// Least share of its steps that have a flight.
        FLYING_SHARE: f64 = 0.5, "1", 0.1..=1.0, "docs/locomotion.md#runs";
        /// Cosine of the largest tilt of a runner's trunk.
        UPRIGHT: f64 = 0.5, "1", 0..=0.9, "docs/locomotion.md#runs";
        /// Least share of the samples that are so upright.
        UPRIGHT_SHARE: f64 = 0.95, "1", 0.5..=1.0, "docs/locomotion.md#runs";
        /// Least distance between the ends of a run.
        LEAST_WAY: f64 = 1.0, "m", 0.3..=3.0, "docs/locomotion.md#runs";
    }
}

/// How runs are turned into walking.
pub mod run_to_walk {
    crate::params::params! {
        /// Duration of a walked step.
        WALKED_STEP: f64 = 0.5, "s", 0.35..=0.8, "docs/locomotion.md#runs";
        /// Duration of the slowest step that is slowed down.
        LONGEST_STEP: f64 = 0.4, "s", 0.25..=0.6, "docs/locomotion.md#runs";
        /// Farthest that a body leans that walks: slowed down, it brakes less than its lean would have it.
        MOST_LEAN: f64 = 0.15, "m", 0.05..=0.4, "docs/locomotion.md#runs";
        /// Least share of their length that steps keep.
        LEAST_LENGTH: f64 = 0.35, "1", 0.1..=1.0, "docs/locomotion.md#runs";
        /// Cut-off above which the height of the body bounces with its steps.
        BOUNCE_CUTOFF: f64 = 0.7, "Hz", 0.2..=2.0, "docs/locomotion.md#runs";
        /// Time before and after over which the least pace is held.
        PACE_HELD: f64 = 0.1, "s", 0..=0.5, "docs/locomotion.md#runs";
        /// Least share of its pace that time keeps.
        LEAST_PACE: f64 = 0.1, "1", 0.02..=0.5, "numerical";
        /// A way that is shortened to a larger share is not shortened.
        WHOLE: f64 = 0.999, "1", 0.95..=1.0, "numerical";
        /// Time after a run that belongs to it: its last step.
        LAST_STEP: f64 = 0.08, "s", 0..=0.4, "docs/locomotion.md#runs";
        /// Longest flight that is closed, in time of the walk.
        LONGEST_FLIGHT: f64 = 0.8, "s", 0.3..=2.0, "docs/locomotion.md#runs";
        /// Double support in place of a flight.
        DOUBLE_SUPPORT: f64 = 0.035, "s", 0..=0.2, "docs/locomotion.md#runs";
        /// Height of a swinging ankle over the line between its places.
        ARC_HEIGHT: f64 = 0.08, "m", 0.02..=0.2, "docs/locomotion.md#runs";
        /// Time in which a foot comes to rest over its place that the recording has in the air there.
        REST_TIME: f64 = 0.1, "s", 0.03..=0.3, "docs/locomotion.md#runs";
    }
}

/// Glitches, and frames that are not part of the motion.
pub mod recording {
    crate::params::params! {
        /// Longest pose at the start that is no part of the motion.
        LONGEST_POSE: f64 = 30.0, "s", 1.0..=120, "cargo test --test motion corpus";
        /// Most such poses.
        MOST_POSES: usize = 2, "1", 1..=5, "cargo test --test motion corpus";
        /// Least jump between two frames: root of the sum of squares of all turns and of the root's way in body sizes.
        LEAST_JUMP: f64 = 0.15, "rad", 0.05..=0.5, "cargo test --test motion corpus";
        /// Most that a held pose has strayed from its first frame, in the same measure.
        MOST_DRIFT: f64 = 0.3, "rad", 0.1..=1.0, "cargo test --test motion corpus";
        /// Least ratio of a jump to any change after it.
        JUMP_RATIO: f64 = 3.0, "1", 1.5..=10, "cargo test --test motion corpus";
        /// Time after a jump that it is compared with.
        AFTER_JUMP: f64 = 0.1, "s", 0.03..=0.5, "cargo test --test motion corpus";
        /// Least number of frames for that.
        AFTER_JUMP_FRAMES: usize = 3, "frames", 1..=10, "cargo test --test motion corpus";
        /// Longest blend from the rest pose into the motion.
        LONGEST_BLEND: f64 = 0.06, "s", 0..=0.3, "cargo test --test motion corpus";
        /// Least ratio of the change at its end to the next one.
        BLEND_END_RATIO: f64 = 2.0, "1", 1.2..=5.0, "cargo test --test motion corpus";
        /// Least ratio of a jump to the 95th percentile of the changes of the clip.
        USUAL_RATIO: f64 = 2.5, "1", 1.2..=10, "cargo test --test motion corpus";
        /// Least fourth largest turn of a bone, or turn of the root, of a jump out of a pose held for several frames.
        POSE_JUMP: f64 = 0.12, "rad", 0.03..=0.4, "cargo test --test motion corpus";
        /// A bone within this of the file's rest pose is at rest.
        REST_ANGLE: f64 = 0.09, "rad", 0.02..=0.2, "cargo test --test motion corpus";
        /// A bone that turns further in one frame and back is bridged.
        GLITCH_ANGLE: f64 = 0.45, "rad", 0.2..=1.0, "cargo test --test motion corpus";
        /// The same as a speed: at low frame rates honest motion turns far in one frame.
        GLITCH_RATE: f64 = 45.0, "rad/s", 20..=100, "cargo test --test motion corpus";
        /// A root that moves further in one frame and back is bridged, in sizes of the figure.
        ROOT_STEP: f64 = 0.1, "1", 0.03..=0.5, "cargo test --test motion corpus";
        /// The same as a speed, in sizes of the figure.
        ROOT_RATE: f64 = 12.0, "1/s", 4.0..=40, "cargo test --test motion corpus";
        /// Longest glitch that is bridged.
        GLITCH_FRAMES: usize = 4, "frames", 1..=10, "cargo test --test motion corpus";
        /// After a glitch a bone, or the root, is back to within this share of it.
        GLITCH_BACK: f64 = 0.4, "1", 0.1..=0.8, "cargo test --test motion corpus";
    }
}

/// How large the recorded person is.
pub mod size {
    crate::params::params! {
        /// Least stature that a unit leads to when it is guessed.
        LEAST_LIKELY_STATURE: f64 = 1.3, "m", 1.0..=1.6, "cargo test --test motion corpus";
        /// Largest stature that a unit leads to when it is guessed.
        MOST_LIKELY_STATURE: f64 = 2.0, "m", 1.8..=2.3, "cargo test --test motion corpus";
        /// Least stature that is accepted with a given unit.
        LEAST_STATURE: f64 = 0.7, "m", 0.4..=1.0, "cargo test --test motion corpus";
        /// Largest stature that is accepted with a given unit.
        MOST_STATURE: f64 = 2.6, "m", 2.2..=3.0, "cargo test --test motion corpus";
        /// Leg (hip to ankle) over stature, both sexes; about 0.495 for men and 0.465 for women.
        LEG_OF_STATURE: f64 = 0.485, "1", 0.46..=0.5, "de Leva 1996";
        /// Hips to shoulders over stature.
        TRUNK_OF_STATURE: f64 = 0.29, "1", 0.26..=0.32, "estimate, no source known";
        /// Weight of the leg in the stature; the trunk has the rest.
        LEG_WEIGHT: f64 = 0.7, "1", 0.3..=1.0, "cargo test --test motion corpus";
        /// The rest.
        TRUNK_WEIGHT: f64 = 0.3, "1", 0..=0.7, "derived: 1 − LEG_WEIGHT";
    }
}

/// Path of the root where the file does not state it; heights over the floor are in leg lengths.
pub mod root {
    crate::params::params! {
        /// Height of the ankle on a flat foot.
        ANKLE_HEIGHT: f64 = 0.095, "1", 0.05..=0.15, "cargo test --test motion corpus";
        /// Height of the toe joint on a flat foot.
        TOE_JOINT_HEIGHT: f64 = 0.03, "1", 0.01..=0.06, "cargo test --test motion corpus";
        /// Height of the tip of the toes on a flat foot.
        TOE_TIP_HEIGHT: f64 = 0.02, "1", 0..=0.05, "cargo test --test motion corpus";
        /// Height of a knee that kneels.
        KNEE_HEIGHT: f64 = 0.07, "1", 0.03..=0.12, "cargo test --test motion corpus";
        /// Height of a hip that sits on the floor.
        HIP_HEIGHT: f64 = 0.12, "1", 0.06..=0.2, "cargo test --test motion corpus";
        /// Height of a wrist or elbow that rests on the floor.
        ARM_HEIGHT: f64 = 0.05, "1", 0.02..=0.1, "cargo test --test motion corpus";
        /// Height of a shoulder or head that lies on the floor.
        HEAD_HEIGHT: f64 = 0.1, "1", 0.05..=0.2, "cargo test --test motion corpus";
        /// A point weighs less by a factor of e for each of these lengths that it is higher than the lowest one.
        WEIGHT_HEIGHT: f64 = 0.015, "1", 0.005..=0.05, "cargo test --test motion corpus";
        /// Nothing touches the floor where the lowest point is higher than this over its usual lowest level.
        OFF_FLOOR: f64 = 0.06, "1", 0.02..=0.2, "cargo test --test motion corpus";
        /// Share of the samples below that level.
        LOW_SHARE: f64 = 0.05, "1", 0.01..=0.2, "cargo test --test motion corpus";
        /// Differences of speed below this are noise, in lengths of the leg.
        STILL: f64 = 0.03, "1/s", 0.005..=0.1, "cargo test --test motion corpus";
        /// Rounds of weighting points by how little they slide.
        ROUNDS: usize = 12, "rounds", 3..=50, "numerical";
        /// Cut-off of the path.
        CUTOFF: f64 = 6.0, "Hz", 2.0..=12, "cargo test --test motion corpus";
        /// A root that moves less does not move, in lengths of the leg.
        LEAST_MOTION: f64 = 1e-6, "1", 1e-9..=1e-3, "numerical";
        /// A figure that would stray by less stands still, in lengths of the leg.
        LEAST_WAY: f64 = 0.02, "1", 0.005..=0.1, "cargo test --test motion corpus";
    }
}

/// When a foot is flat on the floor, and where the floor is.
pub mod floor {
    crate::params::params! {
        /// A slower ankle may stand.
        SLOW: f64 = 0.25, "m/s", 0.05..=0.5, "cargo test --test motion corpus";
        /// Least height of the hip over it, in lengths of the leg: feet of a lying person are slow and not flat.
        HIP_HEIGHT: f64 = 0.4, "1", 0.1..=0.8, "cargo test --test motion corpus";
        /// Share of the slow samples below the level of a flat foot.
        LEVEL_SHARE: f64 = 0.15, "1", 0.05..=0.5, "cargo test --test motion corpus";
        /// An ankle within this of that level stands flat.
        FLAT_HEIGHT: f64 = 0.012, "m", 0.003..=0.03, "cargo test --test motion corpus";
        /// Fewest flat samples that tell something.
        FEWEST: usize = 5, "samples", 1..=50, "cargo test --test motion corpus";
        /// Least level share of the line from ankle to toes of a foot that stands.
        LEVEL_TOES: f64 = 0.5, "1", 0.2..=0.9, "cargo test --test motion corpus";
        /// Least agreement of the flat samples: length of the mean of their unit quaternions.
        AGREEMENT: f64 = 0.9, "1", 0.5..=1.0, "cargo test --test motion corpus";
        /// Variance of the feet over the ground that halves what they say of its slope.
        SPREAD2: f64 = 0.05, "m²", 0.005..=0.5, "cargo test --test motion corpus";
        /// Steeper than this is no floor but a motion that the fit misread.
        MOST_SLOPE: f64 = 0.05, "1", 0.01..=0.2, "cargo test --test motion corpus";
        /// Feet that stand on one floor differ by less in height.
        SAME_HEIGHT: f64 = 0.04, "m", 0.01..=0.1, "cargo test --test motion corpus";
        /// Share of the samples below the floor where no foot stands flat.
        LOWEST_SHARE: f64 = 0.02, "1", 0..=0.1, "cargo test --test motion corpus";
    }
}

/// Frames of segments and the calibration pose.
pub mod segments {
    crate::params::params! {
        /// Bend below which the plane of a limb is noise.
        PLANE_NOISE: f64 = 0.26, "rad", 0.1..=0.5, "cargo test --test motion corpus";
        /// Bend from which the plane of a limb is trusted.
        PLANE_TRUSTED: f64 = 0.70, "rad", 0.4..=1.2, "cargo test --test motion corpus";
        /// Bend from which a frame tells something about the hinge axis.
        PLANE_LEAST: f64 = 0.30, "rad", 0.1..=0.7, "cargo test --test motion corpus";
        /// Samples this much less upright than the most upright one serve for calibration.
        UPRIGHT_RANGE: f64 = 0.06, "1", 0.01..=0.3, "cargo test --test motion corpus";
        /// Most samples that do.
        MOST_POSES: usize = 400, "samples", 10..=5000, "cargo test --test motion corpus";
        /// A forearm that points down by more hangs: cosine.
        HANGING: f64 = 0.7, "1", 0.3..=0.95, "cargo test --test motion corpus";
        /// Largest median deviation of a wrist that is believed: a hand's rest pose is often off.
        WRIST_DEVIATION: f64 = 0.15, "rad", 0.05..=0.5, "cargo test --test motion corpus";
        /// Largest median flexion of a wrist that is believed.
        WRIST_FLEXION: f64 = 0.6, "rad", 0.2..=1.2, "cargo test --test motion corpus";
        /// Pronation, either way, that a forearm keeps to but for one sample in twenty at each end of its range.
        PRONATION: f64 = 1.5, "rad", 1.2..=1.7, "cargo test --test motion corpus";
        /// A range of pronation that is out of that by more has a zero that means nothing.
        PRONATION_OUT: f64 = 0.5, "rad", 0.2..=1.0, "cargo test --test motion corpus";
        /// And so has one whose median is further from 0.
        PRONATION_MEDIAN: f64 = 1.3, "rad", 0.8..=1.5, "cargo test --test motion corpus";
        /// Pronation of hands that hang or work.
        PRONATION_MIDDLE: f64 = 0.4, "rad", 0..=0.8, "cargo test --test motion corpus";
        /// A hand that is bent further has no twist of its own: cosine of the angle.
        TWIST_DEFINED: f64 = 0.2, "1", 0.05..=0.5, "cargo test --test motion corpus";
    }
}

/// Findings that deserve a warning.
pub mod warning {
    crate::params::params! {
        /// A clamp that is larger is worth a warning if it lasts.
        CLAMP: f64 = 0.0873, "rad", 0.02..=0.3, "5°";
        /// It lasts for more than this share of the clip.
        CLAMP_SHARE: f64 = 0.05, "1", 0.01..=0.3, "cargo test --test motion corpus";
        /// A clamp that is larger is worth a warning if it lasts less; so is a limb this far out of its hinge plane.
        LARGE_CLAMP: f64 = 0.17, "rad", 0.05..=0.5, "10°";
        /// A large clamp lasts for more than this share of the clip.
        LARGE_CLAMP_SHARE: f64 = 0.02, "1", 0..=0.2, "cargo test --test motion corpus";
        /// Least raise of the pelvis that is worth one.
        PELVIS_RAISE: f64 = 0.01, "m", 0..=0.05, "cargo test --test motion corpus";
        /// Least share of foot samples that were declared free.
        FREED_SHARE: f64 = 0.01, "1", 0..=0.1, "cargo test --test motion corpus";
        /// Least share of the clip in which something other than the feet carries.
        CARRIED_SHARE: f64 = 0.02, "1", 0..=0.2, "cargo test --test motion corpus";
    }
}

/// All parameters of retargeting by group.
pub fn groups() -> [(&'static str, &'static [Param]); 8] {
    [
        ("run_detection", run_detection::ALL),
        ("run_to_walk", run_to_walk::ALL),
        ("recording", recording::ALL),
        ("size", size::ALL),
        ("root", root::ALL),
        ("floor", floor::ALL),
        ("segments", segments::ALL),
        ("warning", warning::ALL),
    ]
}
