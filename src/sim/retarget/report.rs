//! What retargeting found, guessed and changed, and why it could not.

use super::{MAX_FRAMES, MAX_POINTS, UpAxis};
use crate::body::topology::{SEGMENT_COUNT, SEGMENT_NAMES};
use crate::motion::bvh::Bvh;
use crate::motion::clip::{Clip, ClipError};
use crate::motion::skeleton_map::{MapError, SkeletonMap};
use crate::plan::contact_labels::ContactPhase;
use crate::plan::prepare::ZmpOutside;
use crate::retarget::params::warning;

/// A retargeted clip with its report.
#[derive(Clone, Debug)]
pub struct Retargeted {
    /// The motion.
    pub clip: Clip,
    /// What was found and done.
    pub report: RetargetReport,
}

/// A segment and the bones of the file that it was read from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MappedBone {
    /// Segment name.
    pub segment: &'static str,
    /// Bone names, parent first.
    pub bones: Vec<String>,
}

/// How much of one DOF was outside the body's limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClampedDof {
    /// DOF name.
    pub dof: &'static str,
    /// Largest excess, rad.
    pub max: f64,
    /// Fraction of the samples that were clamped.
    pub fraction: f64,
}

impl ClampedDof {
    /// Joint and motion as people name them: `right ankle: flexion` for `r_ankle_flexion`.
    fn in_words(&self) -> String {
        let (side, rest) = match self.dof.split_at(2) {
            ("l_", rest) => ("left ", rest),
            ("r_", rest) => ("right ", rest),
            _ => ("", self.dof),
        };
        let (joint, motion) = rest.split_once('_').unwrap_or((rest, "angle"));
        format!("{side}{joint}: {}", motion.replace('_', " "))
    }
}

/// A stretch of frames that was replaced by interpolation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bridged {
    /// Bone name.
    pub bone: String,
    /// First replaced frame of the file (0-based).
    pub first: usize,
    /// How many.
    pub count: usize,
}

/// Where the recorded floor and heading went: maps clip to file (metres, z up).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Origin {
    /// Pelvis at the first frame, m, along the file's forward and left axes.
    pub x: f64,
    /// See `x`.
    pub y: f64,
    /// Heading at the first frame, rad.
    pub yaw: f64,
}

/// How the skeleton of the file was understood.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SkeletonReport {
    /// Segments and their bones.
    pub mapped: Vec<MappedBone>,
    /// Segments without a bone; they keep their neutral angle.
    pub missing: Vec<&'static str>,
    /// True if names failed and the structure of the skeleton decided.
    pub by_structure: bool,
    /// True if the file's left and right were exchanged, told by position.
    pub sides_swapped: bool,
}

/// Size of the recorded person, and of the body against it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SizeReport {
    /// Metres per unit of the file.
    pub unit_m: f64,
    /// True if the caller gave the unit.
    pub unit_given: bool,
    /// Up axis.
    pub up: UpAxis,
    /// Recorded person's stature, m, from leg and trunk length.
    pub stature: f64,
    /// Body size over recorded size.
    pub scale: f64,
}

/// Frames of the file, and samples of the clip.
#[derive(Clone, Debug, PartialEq)]
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
    pub smoothing_rms: f64,
}

/// Where the motion was recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceReport {
    /// Height of the recorded floor over z = 0 of the file, m, before scaling.
    pub floor_offset: f64,
    /// Slope of the recorded floor that was levelled.
    pub floor_slope: f64,
    /// Place and heading of the first frame.
    pub origin: Origin,
}

/// What of the recorded joint angles is no body's, or not this body's.
#[derive(Clone, Debug, PartialEq)]
pub struct JointReport {
    /// Angles that had to be clamped.
    pub clamped: Vec<ClampedDof>,
    /// 95th percentile of the angle by which the left and right shank leave the plane of the knee hinge, rad.
    pub knee_off_axis: [f64; 2],
    /// The same for forearm and elbow, rad.
    pub elbow_off_axis: [f64; 2],
    /// Constant angle taken out of the left and right wrist, rad: the recording's hands do not continue its forearms.
    pub wrist_bias: [f64; 2],
    /// Constant angle taken out of the pronation of the left and right forearm, rad: as recorded its range is no
    /// forearm's.
    pub pronation_shift: [f64; 2],
}

/// How the feet stand.
#[derive(Clone, Debug, PartialEq)]
pub struct FootReport {
    /// Which feet the recording has on the floor, without gaps.
    pub phases: Vec<ContactPhase>,
    /// Largest distance of a planted foot from its place, m: as recorded, and prepared.
    pub slide: (f64, f64),
    /// Largest depth of a sole under the floor in stance, m: as recorded, and prepared.
    pub penetration: (f64, f64),
    /// Fraction of foot samples in stance that were declared free because the leg's limits do not let it hold the foot
    /// in place.
    pub freed: f64,
}

/// What carries the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BalanceReport {
    /// Zero-moment point outside the support polygon before and after balancing.
    pub zmp_outside: (ZmpOutside, ZmpOutside),
    /// Fraction of the clip in which something other than the feet carries the body (chair, hands, back).
    pub carried: f64,
}

/// Largest changes of the pelvis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PelvisReport {
    /// Shift for balance, m.
    pub shift: f64,
    /// Lowering so that planted legs reach, m.
    pub drop: f64,
    /// Angle by which it is tilted back where hips do not flex as far as recorded, rad.
    pub tilt: f64,
    /// Raise where legs do not fold as far as recorded, m.
    pub raise: f64,
}

/// Running in the recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunReport {
    /// Speed over the floor of the fastest run, m/s, if the recording runs anywhere.
    pub speed: Option<f64>,
    /// True if it is walked.
    pub walked: bool,
}

/// What retargeting found, guessed and changed.
#[derive(Clone, Debug, PartialEq)]
pub struct RetargetReport {
    /// Bones.
    pub skeleton: SkeletonReport,
    /// Units, axes and scale.
    pub size: SizeReport,
    /// Frames and samples.
    pub frames: FrameReport,
    /// Floor, place and heading.
    pub place: PlaceReport,
    /// Joint angles.
    pub joints: JointReport,
    /// Contacts of the feet.
    pub feet: FootReport,
    /// Support of the body.
    pub balance: BalanceReport,
    /// Path of the pelvis.
    pub pelvis: PelvisReport,
    /// Running.
    pub runs: RunReport,
    /// What a user should know.
    pub warnings: Vec<String>,
}

/// Why a file cannot be retargeted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RetargetError {
    /// The skeleton has no human shape or names.
    #[error(transparent)]
    Map(#[from] MapError),
    /// The caller gave it up.
    #[error("given up")]
    Stopped,
    /// Nothing to retarget.
    #[error("{0} frames; a motion needs at least 2")]
    TooShort(usize),
    /// Too much to retarget at once.
    #[error("{frames} frames; at most {MAX_FRAMES} are read: cut the clip")]
    TooLong {
        /// Frames in the file.
        frames: usize,
    },
    /// Too much to hold at once.
    #[error(
        "{frames} frames of {joints} joints that matter; at most {MAX_POINTS} places are held: cut the clip"
    )]
    TooMuch {
        /// Frames in the file.
        frames: usize,
        /// Joints that are mapped, with those above them.
        joints: usize,
    },
    /// The rate is no capture rate.
    #[error(
        "rate {rate_hz} Hz is outside {lower}…{upper} Hz; give rate_hz if the file's frame time is wrong"
    )]
    Rate {
        /// Offending value.
        rate_hz: f64,
        /// Least accepted.
        lower: f64,
        /// Largest accepted.
        upper: f64,
    },
    /// No usual unit gives a human stature.
    #[error(
        "the figure measures {measured:.4} file units from sole to crown, which no usual unit makes 1.3 to 2.0 m; give \
         unit_m"
    )]
    Unit {
        /// Stature in file units.
        measured: f64,
    },
    /// The given unit gives no human stature.
    #[error(
        "with unit_m = {unit_m} the figure measures {stature:.3} m ({measured:.4} file units); people measure 0.7 to \
         2.6 m"
    )]
    Stature {
        /// Unit as given.
        unit_m: f64,
        /// Stature that follows, m.
        stature: f64,
        /// Stature in file units.
        measured: f64,
    },
    /// A bone has no length.
    #[error("bone {bone} has no length")]
    Degenerate {
        /// Name of the upper bone.
        bone: String,
    },
    /// A number is NaN, infinite or absurd.
    #[error("frame {frame}: bone {bone} is not at a finite place")]
    NotFinite {
        /// 0-based.
        frame: usize,
        /// Bone name.
        bone: String,
    },
    /// An option is out of range.
    #[error("{field} {value} is outside {lower}…{upper}")]
    Option {
        /// Option name.
        field: &'static str,
        /// Offending value.
        value: f64,
        /// Least accepted.
        lower: f64,
        /// Largest accepted.
        upper: f64,
    },
    /// The postures do not make a clip.
    #[error(transparent)]
    Clip(#[from] ClipError),
}

impl RetargetReport {
    /// Adds a sentence for each finding that a reader should know.
    pub(super) fn note_warnings(&mut self, from_rest: bool) {
        let w = &mut self.warnings;
        if self.skeleton.by_structure {
            w.push(
                "bone names told nothing: the shape of the skeleton decided which bone is which"
                    .into(),
            );
        }
        if !self.skeleton.missing.is_empty() {
            w.push(format!(
                "no bone for {}: held at the neutral angle",
                self.skeleton.missing.join(", ")
            ));
        }
        if !from_rest {
            w.push("the file's zero pose is no standing person: the mean of its most upright frames was taken for \
                calibration".into());
        }
        if !self.frames.bridged.is_empty() {
            let frames: usize = self.frames.bridged.iter().map(|b| b.count).sum();
            w.push(match frames {
                1 => "1 frame with a jump was bridged".to_owned(),
                n => format!("{n} frames with jumps were bridged"),
            });
        }
        let notable = |c: &&ClampedDof| {
            [
                (warning::CLAMP, warning::CLAMP_SHARE),
                (warning::LARGE_CLAMP, warning::LARGE_CLAMP_SHARE),
            ]
            .iter()
            .any(|least| c.max > least.0 && c.fraction > least.1)
        };
        for c in self.joints.clamped.iter().filter(notable) {
            w.push(format!(
                "{} cut by up to {:.0}° in {:.0} % of the clip",
                c.in_words(),
                c.max.to_degrees(),
                100.0 * c.fraction
            ));
        }
        for (side, shift) in ["left", "right"]
            .into_iter()
            .zip(self.joints.pronation_shift)
        {
            if shift.abs() > warning::CLAMP {
                w.push(format!(
                    "{side} forearm: its rotation was taken {:.0}° off, as recorded it is no forearm's",
                    shift.abs().to_degrees()
                ));
            }
        }
        if self.pelvis.tilt > warning::CLAMP {
            w.push(format!(
                "the pelvis is tilted back by up to {:.0}° where hips do not flex as far as recorded",
                self.pelvis.tilt.to_degrees()
            ));
        }
        if self.pelvis.raise > warning::PELVIS_RAISE {
            w.push(format!(
                "the pelvis is raised by up to {:.0} cm where legs do not fold as far as recorded",
                100.0 * self.pelvis.raise
            ));
        }
        if self.feet.freed > warning::FREED_SHARE {
            w.push(format!(
                "planted feet were let go in {:.0} % of the samples: the legs' limits do not let them stand as \
                 recorded",
                100.0 * self.feet.freed
            ));
        }
        if self.balance.carried > warning::CARRIED_SHARE {
            w.push(format!(
                "in {:.0} % of the clip something other than the feet carries the body (chair, hands, back)",
                100.0 * self.balance.carried
            ));
        }
        let off = self
            .joints
            .knee_off_axis
            .iter()
            .chain(&self.joints.elbow_off_axis)
            .copied()
            .fold(0.0, f64::max);
        if off > warning::LARGE_CLAMP {
            w.push(format!(
                "knees or elbows leave their hinge plane by {:.0}° (95th percentile)",
                off.to_degrees()
            ));
        }
    }
}

/// Segments and the bones that move them.
pub(super) fn mapped_bones(bvh: &Bvh, map: &SkeletonMap) -> Vec<MappedBone> {
    let names = |bones: &[usize]| {
        bones
            .iter()
            .map(|b| bvh.joints[*b].name.clone())
            .collect::<Vec<_>>()
    };
    let split = (map.abdomen + 1).min(map.trunk.len());
    // A single bone bends both joints of our trunk.
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
