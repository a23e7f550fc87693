//! Recorded skeletons of any shape onto the body, by geometry.
//!
//! World positions and rotations of the file are smoothed, brought to metres with z up, levelled and scaled by leg
//! length. Each segment's frame comes from its end points and the plane of its hinge; near a straight limb, from the
//! bone's own rotation with the hinge axis that the bent frames of the clip show in it. Trunk, head, hands and feet
//! follow their bones relative to a calibration pose: the file's rest pose if it looks like a standing person, else the
//! mean over the most upright samples; so the zero pose of the file means nothing by itself. Relative rotations are
//! split into the joints' own degrees of freedom. Feet and balance: [`super::plan::prepare`].

mod feet;
mod joints;
pub mod params;
mod recording;
mod report;
mod root;
mod run_detection;
mod run_to_walk;
mod scene;
mod segments;
mod size;
mod stages;

pub use report::{
    BalanceReport, Bridged, ClampedDof, FootReport, FrameReport, JointReport, MappedBone, Origin,
    PelvisReport, PlaceReport, RetargetError, RetargetReport, Retargeted, RunReport, SizeReport,
    SkeletonReport,
};

use super::motion::bvh::{Bvh, BvhHead};
use super::motion::clip::{Clip, ClipError, MAX_SAMPLES};
use super::motion::filter::renormalised;
use super::motion::skeleton_map::map_skeleton;
use super::plan::contact_labels::phases;
use super::plan::flight_phases;
use super::plan::params::leg;
use super::plan::prepare::{Draft, PrepareOptions, prepare};
use crate::body::topology::{DOF_COUNT, DOF_NAMES};
use crate::body::{Body, Posture};
use recording::Recording;
use report::{mapped_bones, missing_segments};
use scene::Scene;
use stages::{Fitted, Footage};

/// Most frames of a clip: bounds time and memory (8 min at 120 Hz).
pub const MAX_FRAMES: usize = 60_000;
/// Most frames times joints that matter, 60 joints in the longest file: bounds memory.
pub const MAX_POINTS: usize = 60 * MAX_FRAMES;
/// Bytes for each joint that matters in a frame.
const POINT_BYTES: u64 = 80;
/// Bytes for each sample of a clip while it is prepared.
pub const SAMPLE_BYTES: u64 = 4096;
/// Least and largest [`RetargetOptions::tempo`].
pub const TEMPI: (f64, f64) = (0.5, 2.0);
/// Rates that are believed, Hz.
const RATES: (f64, f64) = (10.0, 1000.0);

/// Which axis of the file points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum UpAxis {
    Y,
    Z,
}

/// What the caller knows better than the file. `Default` guesses everything.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FileFacts {
    /// Metres per unit of the file; guessed from stature if absent.
    pub unit_m: Option<f64>,
    /// Up axis; guessed from where the head is if absent.
    pub up: Option<UpAxis>,
    /// True frame rate of the file, Hz, where its frame time is wrong.
    pub rate_hz: Option<f64>,
}

/// What is done so that a body can follow the motion on its feet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Preparation {
    /// Lock planted feet.
    pub lock_feet: bool,
    /// Shift the trunk so that the zero-moment point stays over the planted feet.
    pub balance: bool,
    /// Let the motion begin and end standing, with steps before its first and after its last frame where it takes them.
    pub ends: bool,
    /// Walk what the recording runs: slower and with shorter steps. The muscles that are measured in people's joints do
    /// not run.
    pub walk_runs: bool,
}

impl Preparation {
    /// The recording as it fits the body.
    pub const NONE: Self = Self {
        lock_feet: false,
        balance: false,
        ends: false,
        walk_runs: false,
    };

    /// What is rehearsed: feet that stand do not slide, it begins and ends standing if that can be, and nothing else is
    /// changed.
    pub const REHEARSED: Self = Self {
        lock_feet: true,
        balance: false,
        ends: true,
        walk_runs: false,
    };

    /// Everything; runs are walked if `walk_runs` says so.
    pub const fn walking(walk_runs: bool) -> Self {
        Self {
            lock_feet: true,
            balance: true,
            ends: true,
            walk_runs,
        }
    }
}

impl Default for Preparation {
    /// Everything; runs are kept.
    fn default() -> Self {
        Self::walking(false)
    }
}

/// What the caller knows better than the file, and what to do with the motion. `Default` guesses everything and
/// prepares fully.
#[derive(Clone, Debug, PartialEq)]
pub struct RetargetOptions {
    /// Name of the clip.
    pub name: String,
    /// What the file does not say, or says wrongly.
    pub file: FileFacts,
    /// Rate of the clip at tempo 1, Hz; absent: the file's own rate if that is 60…240, else 120.
    pub output_rate_hz: Option<f64>,
    /// Body size over recorded size, for paths and heights; absent: ratio of leg lengths. Two people of one recording
    /// need one value.
    pub scale: Option<f64>,
    /// Bring the recorded floor to z = 0 (level and height). Otherwise z = 0 of the file is the floor.
    pub floor: bool,
    /// Cut-off of the zero-phase low-pass, Hz.
    pub cutoff_hz: f64,
    /// Times as fast as it was recorded, [`TEMPI`]: feet and postures are those of the recording, steps and balance are
    /// prepared for this pace.
    pub tempo: f64,
    /// Keep the file's place and heading (x forward = the file's z where y is up). Otherwise the clip starts at the
    /// origin facing +x.
    pub keep_origin: bool,
    /// What is done for the feet and for balance.
    pub preparation: Preparation,
}

impl Default for RetargetOptions {
    fn default() -> Self {
        Self {
            name: "clip".into(),
            file: FileFacts::default(),
            output_rate_hz: None,
            scale: None,
            floor: true,
            tempo: 1.0,
            cutoff_hz: 6.0,
            keep_origin: false,
            preparation: Preparation::default(),
        }
    }
}

/// Bytes that reading a file and retargeting it take meanwhile, near enough; they are known from the head of the file.
/// `rate_hz`: as [`FileFacts::rate_hz`].
pub fn memory(file: &[u8], rate_hz: Option<f64>) -> u64 {
    let Ok(head) = BvhHead::parse(file) else {
        return 0; // nothing more is read of it
    };
    let frames = head.frame_count.min(file.len() as u64 / 2);
    let values = frames.saturating_mul(head.channel_count as u64);
    let values = 8 * values.min(file.len() as u64 / 2);
    let kept = map_skeleton(&head.joints).map_or(0, |map| {
        let kept = Recording::kept(&head.joints, &map);
        kept.into_iter().filter(|k| *k).count()
    });
    let points = (frames as usize).saturating_mul(kept).min(MAX_POINTS) as u64;
    let source_rate = rate_hz.unwrap_or(1.0 / head.frame_time);
    let rate = output_rate(source_rate, &RetargetOptions::default());
    let samples = match kept {
        0 => 0,
        _ => sample_count(frames as usize, source_rate, rate).min(MAX_SAMPLES) as u64,
    };
    values + POINT_BYTES * points + SAMPLE_BYTES * samples
}

/// Samples per second of the clip at tempo 1.
fn output_rate(source_rate: f64, options: &RetargetOptions) -> f64 {
    let kept = (59.0..=240.5).contains(&source_rate);
    let usual = if kept { source_rate } else { 120.0 };
    options.output_rate_hz.unwrap_or(usual)
}

/// Samples of a clip of so many frames.
fn sample_count(frames: usize, source_rate: f64, rate: f64) -> usize {
    let last = (frames.max(1) - 1) as f64 * rate / source_rate;
    ((last + 1e-6).floor() as usize).saturating_add(1)
}

/// Refuses more samples than a clip may have, before anything is made for them.
fn check_samples(count: usize) -> Result<(), ClipError> {
    match count > MAX_SAMPLES {
        true => Err(ClipError::TooLong { count }),
        false => Ok(()),
    }
}

/// Retargets a recording onto `body`.
///
/// Offline: time and memory are linear in frames × joints, about 0.2 s for 10 s at 120 Hz.
///
/// # Errors
/// [`RetargetError`] names what is missing: the bone, the unit with the measured figure, the frame.
pub fn retarget(
    bvh: &Bvh,
    body: &Body,
    options: &RetargetOptions,
) -> Result<Retargeted, RetargetError> {
    retarget_unless(bvh, body, options, &|| false)
}

/// As [`retarget`], given up between two of its stages once `stop` says so.
///
/// # Errors
/// Those of [`retarget`]; [`RetargetError::Stopped`].
pub fn retarget_unless(
    bvh: &Bvh,
    body: &Body,
    options: &RetargetOptions,
    stop: &dyn Fn() -> bool,
) -> Result<Retargeted, RetargetError> {
    let go_on = || match stop() {
        true => Err(RetargetError::Stopped),
        false => Ok(()),
    };
    let source_rate = check(bvh, options)?;
    let mut warnings: Vec<String> = bvh.warnings.clone();
    let mut file = Footage::read(bvh, source_rate, &mut warnings)?;
    go_on()?;
    let (size, recorded) = file.measured(bvh, options, &mut warnings)?;
    go_on()?;
    let (mut scene, mut seen) = Scene::new(&file.take, &file.map, recorded, options)?;
    go_on()?;
    warnings.extend(seen.notes(source_rate));
    let sides_swapped = scene.settle_sides(&mut file.map);
    if sides_swapped {
        seen.feet.swap(0, 1);
        warnings.push("left and right were exchanged: the file names them the other way round than its feet and knees \
            point".into());
    }

    let mut fitted = Fitted::new(&scene, &file.map, &size, body, options);
    let label = fitted.steps(&mut seen.feet, seen.slowed.as_ref(), scene.rate);
    let (joints, knee_axis, knee_off_axis) = fitted.joints(&scene, &file.map);
    go_on()?;
    let rate = scene.rate;
    drop(scene);
    let (mut postures, arms) = joints.postures(&std::mem::take(&mut fitted.pelvis));
    drop(joints);
    go_on()?;
    for p in &mut postures {
        p.root_rotation = renormalised(p.root_rotation);
    }

    // Feet and balance.
    let mut draft = Draft {
        rate_hz: rate,
        postures,
        knee_axis,
        ankle: std::mem::take(&mut fitted.ankle),
        foot: std::mem::take(&mut fitted.foot),
        label,
    };
    let fastest_run = seen.fastest_run();
    let mut how = PrepareOptions {
        lock_feet: false,
        balance: false,
        runs: fastest_run.is_some(),
        held: leg::HELD,
    };
    if seen.keeps_run() {
        let recorded = prepare(body, &draft, how).postures;
        flight_phases::label_runs(body, &recorded, &mut draft.label, rate);
        go_on()?;
    }
    how.lock_feet = options.preparation.lock_feet && options.floor;
    how.balance = options.preparation.balance;
    let rate = rate * options.tempo;
    draft.rate_hz = rate;
    let phases = phases(&draft.label, rate);
    let mut prepared = prepare(body, &draft, how);
    go_on()?;
    let made = (
        std::mem::take(&mut prepared.postures),
        std::mem::take(&mut prepared.planted),
    );
    let (postures, planted, lead_in, lead_out) = if options.preparation.ends && how.lock_feet {
        with_ends(body, draft, made, how)
    } else {
        (made.0, made.1, 0, 0)
    };

    let mut report = RetargetReport {
        skeleton: SkeletonReport {
            mapped: mapped_bones(bvh, &file.map),
            missing: missing_segments(&file.map),
            by_structure: file.map.by_structure,
            sides_swapped,
        },
        size: size.report(options, fitted.scale),
        frames: FrameReport {
            source_rate_hz: source_rate,
            rate_hz: rate,
            skipped_frames: file.skipped_frames,
            bridged: file.bridged,
            smoothing_rms: seen.smoothing_rms,
        },
        place: fitted.place_report(),
        joints: JointReport {
            clamped: clamped_dofs(&prepared.clamped),
            knee_off_axis,
            elbow_off_axis: arms.off_axis,
            wrist_bias: arms.wrist_bias,
            pronation_shift: arms.pronation_shift,
        },
        feet: FootReport {
            phases,
            slide: prepared.slide,
            penetration: prepared.penetration,
            freed: prepared.freed,
        },
        balance: BalanceReport {
            zmp_outside: prepared.zmp,
            // Without feet that are locked nothing says what carries the body.
            carried: match how.lock_feet {
                true => prepared.carried,
                false => 0.0,
            },
        },
        pelvis: PelvisReport {
            shift: prepared.shift_max,
            drop: prepared.drop_max,
            tilt: prepared.tilt_max,
            raise: prepared.raise_max,
        },
        runs: RunReport {
            speed: fastest_run,
            walked: seen.slowed.is_some(),
        },
        warnings,
    };
    report.note_warnings(fitted.calibration.from_rest);
    let clip =
        Clip::from_postures(&options.name, rate, postures, planted)?.with_ends(lead_in, lead_out);
    Ok(Retargeted { clip, report })
}

/// The angles that had to be clamped.
fn clamped_dofs(clamped: &[(f64, f64); DOF_COUNT]) -> Vec<ClampedDof> {
    let all = clamped.iter().zip(DOF_NAMES);
    all.filter(|((max, _), _)| *max > 0.0)
        .map(|(&(max, fraction), dof)| ClampedDof { dof, max, fraction })
        .collect()
}

/// Postures and planted feet with the way into the motion and out of it, and the lengths of both in samples. `made`
/// are those that were prepared of the draft.
fn with_ends(
    body: &Body,
    draft: Draft,
    made: (Vec<Posture>, Vec<[bool; 2]>),
    how: PrepareOptions,
) -> (Vec<Posture>, Vec<[bool; 2]>, usize, usize) {
    let (rate_hz, label) = (draft.rate_hz, draft.label.clone());
    drop(draft); // of a long clip it is large
    let mut whole = Draft::of_postures(body, rate_hz, made.0.clone(), label.clone());
    let (before, after) = whole.add_ends(body);
    // Where no way is needed at either end a foot may still have been put down.
    if (before, after) == (0, 0) && whole.label == label {
        return (made.0, made.1, before, after);
    }
    drop(made);
    let whole = prepare(body, &whole, how);
    (whole.postures, whole.planted, before, after)
}

/// Frames per second of the file, if it and the options are within bounds.
fn check(bvh: &Bvh, options: &RetargetOptions) -> Result<f64, RetargetError> {
    check_options(options)?;
    let frames = bvh.frame_count;
    if frames < 2 {
        return Err(RetargetError::TooShort(frames));
    }
    if frames > MAX_FRAMES {
        return Err(RetargetError::TooLong { frames });
    }
    let source_rate = options.file.rate_hz.unwrap_or(1.0 / bvh.frame_time);
    if !(source_rate >= RATES.0 && source_rate <= RATES.1) {
        return Err(RetargetError::Rate {
            rate_hz: source_rate,
            lower: RATES.0,
            upper: RATES.1,
        });
    }
    let rate = output_rate(source_rate, options);
    check_samples(sample_count(frames, source_rate, rate))?;
    Ok(source_rate)
}

fn check_options(o: &RetargetOptions) -> Result<(), RetargetError> {
    let check = |field, value: Option<f64>, lower: f64, upper: f64| match value {
        Some(value) if !(value >= lower && value <= upper) => Err(RetargetError::Option {
            field,
            value,
            lower,
            upper,
        }),
        _ => Ok(()),
    };
    check("unit_m", o.file.unit_m, 1e-6, 1e6)?;
    check("rate_hz", o.file.rate_hz, RATES.0, RATES.1)?;
    check("output_rate_hz", o.output_rate_hz, 30.0, 240.0)?;
    check("scale", o.scale, 0.05, 20.0)?;
    check("tempo", Some(o.tempo), TEMPI.0, TEMPI.1)?;
    check("cutoff_hz", Some(o.cutoff_hz), 0.5, 60.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A recording at 30 Hz of so many frames.
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
        let bvh = Bvh::parse(recording(frames).as_bytes()).unwrap();
        let asked = || panic!("it has begun");
        let refused = retarget_unless(
            &bvh,
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
        // What is declared and not there takes nothing.
        let declared = short.replace("Frames: 100", "Frames: 1000000000000");
        assert!(memory(declared.as_bytes(), None) <= SAMPLE_BYTES * MAX_SAMPLES as u64 * 2);
        assert_eq!(memory(b"no recording", None), 0);
    }
}
