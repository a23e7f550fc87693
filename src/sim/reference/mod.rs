//! Fits a recording to a body, by geometry, whatever its skeleton.
//!
//! World positions and rotations of the recording are smoothed, brought to metres with z up, levelled and scaled by leg
//! length. Each segment's frame comes from its end points and the plane of its hinge; near a straight limb, it comes
//! from the bone's own rotation with the hinge axis that the bent frames of the clip show in it. Trunk, head, hands and
//! feet follow their bones relative to a calibration pose: the file's rest pose if it looks like a standing person,
//! else the mean over the most upright samples; so the zero pose of the file means nothing by itself. Relative
//! rotations are split into the joints' own degrees of freedom. The planning of contacts, feet and balance starts from
//! the result: `plan::recording`.

mod error;
mod feet;
mod joints;
mod options;
pub mod params;
pub(crate) mod report;
mod root;
mod run_detection;
mod run_to_walk;
mod sampling;
mod scene;
mod segments;
mod size;
mod stages;
mod take;
pub(crate) mod units;

pub use crate::motion::recording::UpAxis;
pub use error::RetargetError;
pub use options::{FileFacts, Preparation, RetargetOptions, TEMPI};
pub use report::{
    Bridged, FittingReport, FrameReport, LimbFitReport, MappedBone, PlaceReport, RecordingOrigin,
    SizeReport, SkeletonReport,
};
pub use sampling::{SAMPLE_BYTES, memory};

use crate::body::{Body, Posture};
use crate::math::{Quat, Vec3};
use crate::motion::filter::renormalised;
use crate::motion::recording::Recording;
use report::{mapped_bones, missing_segments};
use run_to_walk::RunToWalk;
use scene::RecordedScene;
use stages::{FittedPaths, MeasuredRecording, measured};
use take::Take;

/// A recording in the size and place of a body, floor at z = 0: input of the planning.
#[derive(Debug)]
pub struct FittedReference {
    /// Samples per second, at the tempo of the recording.
    pub rate_hz: f64,
    /// Pelvis pose, spine, neck and arms; legs at zero.
    pub postures: Vec<Posture>,
    /// Left and right: knee axis (world, towards the figure's left) per sample.
    pub knee_axis: [Vec<Vec3>; 2],
    /// Left and right: ankle position per sample, m.
    pub ankle: [Vec<Vec3>; 2],
    /// Left and right: `world_from_foot` per sample.
    pub foot: [Vec<Quat>; 2],
    /// Points of either foot as recorded, not smoothed (ankle, toe joint, tip), `[side][point][sample]`. Contact labels
    /// are read from them.
    pub foot_points: [Vec<Vec<Vec3>>; 2],
    /// Speed of the fastest run, m/s, if the recording runs anywhere.
    pub fastest_run: Option<f64>,
    /// How its runs are turned into walking, if it has any and they are to be walked.
    slowed: Option<RunToWalk>,
    /// Findings and decisions.
    pub report: FittingReport,
    /// Messages for the user.
    pub warnings: Vec<String>,
}

impl FittedReference {
    /// Whether its runs are walked.
    pub fn walks_runs(&self) -> bool {
        self.slowed.is_some()
    }

    /// Whether the recording runs and its runs are kept.
    pub fn keeps_run(&self) -> bool {
        self.fastest_run.is_some() && self.slowed.is_none()
    }

    /// Removes every flight from runs that are walked: each foot stays down until the other one has landed. Ankles,
    /// feet and `label` (left and right foot on the floor, per sample) are changed.
    pub fn walk_runs(&mut self, label: &mut [[bool; 2]]) {
        if let Some(slowed) = &self.slowed {
            slowed.replace_flights(&mut self.ankle, &mut self.foot, label, self.rate_hz);
        }
    }
}

/// Fits a recording to `body`. Gives up between two of its stages once `stop` returns true.
///
/// Offline: time and memory are linear in frames × joints.
///
/// # Errors
/// [`RetargetError`] names what is missing: the bone, the unit with the measured figure, the frame;
/// [`RetargetError::Stopped`].
pub fn fit(
    recording: &Recording,
    body: &Body,
    options: &RetargetOptions,
    stop: &dyn Fn() -> bool,
) -> Result<FittedReference, RetargetError> {
    let go_on = || RetargetError::unless(stop);
    let source_rate = sampling::check(recording, options)?;
    let mut warnings = recording.facts.warnings.clone();

    // The motion in the recording, its size and its paths.
    let mut take = Take::of(recording, source_rate, &mut warnings)?;
    go_on()?;
    let MeasuredRecording { size, paths } =
        measured(recording, &mut take, options, source_rate, &mut warnings)?;
    go_on()?;
    let mut map = recording.map.clone();
    let (mut scene, mut seen) = RecordedScene::new(&take, &map, paths, options)?;
    go_on()?;
    warnings.extend(seen.notes(source_rate));
    let sides_swapped = scene.settle_sides(&mut map);
    if sides_swapped {
        seen.feet.swap(0, 1);
        warnings.push("left and right were exchanged: the file names them the other way round than its feet and knees \
            point".into());
    }

    // In the size and place of the body.
    let rate_hz = scene.rate;
    let mut fitted = FittedPaths::new(&scene, &map, &size, body, options);
    fitted.place_feet(&mut seen.feet, seen.slowed.as_ref(), rate_hz);
    let limbs = fitted.limbs(&scene, &map);
    go_on()?;
    drop(scene);
    let (mut postures, arms) = limbs.joints.postures(&std::mem::take(&mut fitted.pelvis));
    drop(limbs.joints);
    go_on()?;
    for p in &mut postures {
        p.root_rotation = renormalised(p.root_rotation);
    }

    let report = FittingReport {
        skeleton: SkeletonReport {
            mapped: mapped_bones(recording, &map),
            missing: missing_segments(&map),
            by_structure: map.by_structure,
            sides_swapped,
        },
        size: size.report(fitted.scale),
        frames: FrameReport {
            source_rate_hz: source_rate,
            rate_hz,
            skipped_frames: take.skipped_frames,
            bridged: take.bridged,
            smoothing_rms: seen.smoothing_rms,
        },
        place: fitted.place_report(),
        joints: LimbFitReport {
            knee_off_axis: limbs.knee_off_axis,
            elbow_off_axis: arms.off_axis,
            wrist_bias: arms.wrist_bias,
            pronation_shift: arms.pronation_shift,
        },
        from_rest: fitted.calibration.from_rest,
    };
    Ok(FittedReference {
        rate_hz,
        postures,
        knee_axis: limbs.knee_axis,
        ankle: fitted.ankle,
        foot: fitted.foot,
        fastest_run: seen.fastest_run(),
        foot_points: seen.feet,
        slowed: seen.slowed,
        report,
        warnings,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Body;
    use crate::motion::clip::{ClipError, MAX_SAMPLES};
    use crate::motion::read::read;

    /// A recording at 30 Hz with `frames` frames.
    fn recording(frames: usize) -> String {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../tests/corpus/walk-normal.vrm.bvh"
        );
        let text = std::fs::read_to_string(path).unwrap();
        let (head, motion) = text.split_once("MOTION").unwrap();
        let lines = motion.lines().filter(|l| !l.trim().is_empty());
        let rows: Vec<&str> = lines.skip(2).collect();
        let rows: Vec<&str> = rows.into_iter().cycle().take(frames).collect();
        let rows = rows.join("\n");
        format!("{head}MOTION\nFrames: {frames}\nFrame Time: 0.0333333\n{rows}\n")
    }

    #[test]
    fn what_makes_too_many_samples_is_refused_before_any_is_made() {
        let frames = MAX_SAMPLES / 4 + 100;
        let file = read(recording(frames).as_bytes()).unwrap();
        let asked = || panic!("it has begun");
        let refused = fit(
            &file,
            &Body::adult_man(),
            &RetargetOptions::default(),
            &asked,
        );
        assert!(
            matches!(
                refused,
                Err(RetargetError::Clip(ClipError::TooLong { count })) if count > MAX_SAMPLES
            ),
            "{refused:?}"
        );
    }

    #[test]
    fn the_head_of_a_file_tells_what_memory_it_takes() {
        let [short, long] = [100, 1000].map(recording);
        let samples = 4 * 1000;
        let found = memory(long.as_bytes(), None);
        let least = SAMPLE_BYTES * samples;
        assert!((least..2 * least).contains(&found), "{found}");
        assert!(memory(short.as_bytes(), None) < found / 9);
        // Read as 120 Hz, each frame is one sample.
        assert!(memory(long.as_bytes(), Some(120.0)) < found / 2);
        // Frames that are declared but not present take no memory.
        let declared = short.replace("Frames: 100", "Frames: 1000000000000");
        assert!(memory(declared.as_bytes(), None) <= SAMPLE_BYTES * MAX_SAMPLES as u64 * 2);
        assert_eq!(memory(b"no recording", None), 0);
    }
}
