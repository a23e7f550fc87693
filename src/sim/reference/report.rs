//! Findings of the fit to a recording, and its decisions.
//!
//! Serialised, this is the output of `sinew lint --json`: errors in mm, other lengths in m, angles in degrees.

use super::units::{degrees, each_in_degrees, millimetres};
use crate::body::topology::{SEGMENT_COUNT, SEGMENT_NAMES};
use crate::motion::recording::{Recording, UpAxis};
use crate::motion::skeleton_map::SkeletonMap;
use serde::Serialize;

/// A segment and the bones of the file from which it was read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct MappedBone {
    /// Segment name.
    pub segment: &'static str,
    /// Bone names, parent first.
    pub bones: Vec<String>,
}

/// A stretch of frames that was replaced by interpolation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Bridged {
    /// Bone name.
    pub bone: String,
    /// First replaced frame of the file (0-based).
    #[serde(rename = "first_frame")]
    pub first: usize,
    /// Number of frames.
    #[serde(rename = "frames")]
    pub count: usize,
}

/// Original place of the floor and heading: maps clip to file (metres, z up).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct RecordingOrigin {
    /// Pelvis at the first frame, m, along the file's forward and left axes.
    #[serde(rename = "x_m")]
    pub x: f64,
    /// See `x`.
    #[serde(rename = "y_m")]
    pub y: f64,
    /// Heading at the first frame, rad.
    #[serde(rename = "yaw_deg", serialize_with = "degrees")]
    pub yaw: f64,
}

/// Interpretation of the file's skeleton.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SkeletonReport {
    /// Segments and their bones.
    pub mapped: Vec<MappedBone>,
    /// Segments without a bone; they keep their neutral angle.
    pub missing: Vec<&'static str>,
    /// Whether bones were found by the structure of the skeleton, because names failed.
    pub by_structure: bool,
    /// Whether the file's left and right were exchanged because positions contradict the names.
    pub sides_swapped: bool,
}

/// Size of the recorded person, and of the body relative to it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SizeReport {
    /// Metres per unit of the file.
    pub unit_m: f64,
    /// Whether the caller gave the unit.
    pub unit_given: bool,
    /// Up axis.
    pub up: UpAxis,
    /// Recorded person's stature, m, from leg and trunk length.
    #[serde(rename = "stature_m")]
    pub stature: f64,
    /// Body size over recorded size.
    pub scale: f64,
}

/// Frames of the file, and samples of the clip.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FrameReport {
    /// Frame rate of the file as used, Hz.
    pub source_rate_hz: f64,
    /// Rate of the clip, Hz.
    pub rate_hz: f64,
    /// Frames left out at the start (T-pose).
    pub skipped_frames: usize,
    /// Glitches.
    pub bridged: Vec<Bridged>,
    /// Root mean square distance that smoothing moved the joints, m.
    #[serde(rename = "smoothing_rms_mm", serialize_with = "millimetres")]
    pub smoothing_rms: f64,
}

/// Place of the recorded motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PlaceReport {
    /// Height of the recorded floor over z = 0 of the file, m, before scaling.
    #[serde(rename = "floor_offset_m")]
    pub floor_offset: f64,
    /// Slope of the recorded floor before it was levelled.
    pub floor_slope: f64,
    /// Place and heading of the first frame.
    pub origin: RecordingOrigin,
}

/// How joint angles of the recording differ from those of a human body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LimbFitReport {
    /// 95th percentile of the angle by which the left and right shank leave the plane of the knee hinge, rad.
    #[serde(rename = "knee_off_axis_deg", serialize_with = "each_in_degrees")]
    pub knee_off_axis: [f64; 2],
    /// The same for forearm and elbow, rad.
    #[serde(rename = "elbow_off_axis_deg", serialize_with = "each_in_degrees")]
    pub elbow_off_axis: [f64; 2],
    /// Constant angle taken out of the left and right wrist, rad: the recording's hands do not continue its forearms.
    #[serde(skip)]
    pub wrist_bias: [f64; 2],
    /// Constant angle taken out of the pronation of the left and right forearm, rad: the recorded range does not fit a
    /// forearm.
    #[serde(skip)]
    pub pronation_shift: [f64; 2],
}

/// Findings and decisions of the fit.
#[derive(Clone, Debug, PartialEq)]
pub struct FittingReport {
    /// Bones.
    pub skeleton: SkeletonReport,
    /// Units, axes and scale.
    pub size: SizeReport,
    /// Frames and samples.
    pub frames: FrameReport,
    /// Floor, place and heading.
    pub place: PlaceReport,
    /// Joint angles.
    pub joints: LimbFitReport,
    /// Whether the file's zero pose served as calibration.
    pub from_rest: bool,
}

/// Segments and the bones that move them.
pub(super) fn mapped_bones(recording: &Recording, map: &SkeletonMap) -> Vec<MappedBone> {
    let names = |bones: &[usize]| {
        bones
            .iter()
            .map(|b| recording.facts.joints[*b].name.clone())
            .collect::<Vec<_>>()
    };
    let split = (map.abdomen + 1).min(map.trunk.len());
    // A single bone bends both joints of the body's trunk.
    let (waist, thorax) = if map.trunk.len() == 1 {
        (&map.trunk[..], &map.trunk[..])
    } else {
        map.trunk.split_at(split)
    };
    let mut out = Vec::new();
    let mut add = |s: usize, bones: Vec<String>| {
        if !bones.is_empty() {
            out.push(MappedBone {
                segment: SEGMENT_NAMES[s],
                bones,
            });
        }
    };
    add(0, names(&[map.pelvis]));
    add(1, names(waist));
    add(2, names(thorax));
    add(3, names(map.head.as_slice()));
    for (s, side) in map.sides.iter().enumerate() {
        let (arm, leg) = ([4, 7][s], [10, 14][s]);
        add(arm, names(&[side.upper_arm]));
        add(arm + 1, names(&[side.forearm]));
        add(arm + 2, names(side.hand.as_slice()));
        add(leg, names(&[side.thigh]));
        add(leg + 1, names(&[side.shank]));
        add(leg + 2, names(&[side.foot]));
        add(leg + 3, names(side.toes.as_slice()));
    }
    out.sort_by_key(|m| {
        SEGMENT_NAMES
            .iter()
            .position(|n| *n == m.segment)
            .unwrap_or(SEGMENT_COUNT)
    });
    out
}

/// Segments that no bone moves.
pub(super) fn missing_segments(map: &SkeletonMap) -> Vec<&'static str> {
    let mut out = Vec::new();
    if map.trunk.is_empty() {
        out.extend([SEGMENT_NAMES[1], SEGMENT_NAMES[2]]);
    }
    if map.head.is_none() {
        out.push(SEGMENT_NAMES[3]);
    }
    for (s, side) in map.sides.iter().enumerate() {
        if side.hand.is_none() {
            out.push(SEGMENT_NAMES[[6, 9][s]]);
        }
        if side.toes.is_none() {
            out.push(SEGMENT_NAMES[[13, 17][s]]);
        }
    }
    out
}
