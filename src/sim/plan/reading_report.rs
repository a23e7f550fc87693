//! Findings, guesses and changes made in reading a recording.
//!
//! One type for every reader. Serialised, it is the output of `sinew lint --json` (errors in mm, other lengths in m,
//! angles in degrees); the server converts it to its message.

use super::contact_labels::ContactPhase;
use super::prepare::{Compared, ZmpOutside};
use crate::reference::params::warning;
use crate::reference::report::{
    FrameReport, LimbFitReport, PlaceReport, SizeReport, SkeletonReport,
};
use crate::reference::units::{degrees, millimetres};
use serde::{Serialize, Serializer};

/// How much of one DOF was outside the body's limits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ClampedDof {
    /// DOF name.
    pub dof: &'static str,
    /// Largest excess, rad.
    #[serde(rename = "max_deg", serialize_with = "degrees")]
    pub max: f64,
    /// Fraction of the samples that were clamped.
    #[serde(rename = "share")]
    pub fraction: f64,
}

impl ClampedDof {
    /// Joint and motion in everyday words: `right ankle: flexion` for `r_ankle_flexion`.
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

/// Contacts of the feet.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FootReport {
    /// Phases of the recording by the feet it has on the floor, without gaps.
    pub phases: Vec<ContactPhase>,
    /// Largest distance of a planted foot from its place, m.
    #[serde(rename = "foot_slide_mm", serialize_with = "both_in_millimetres")]
    pub slide: Compared<f64>,
    /// Largest depth of a sole under the floor in stance, m.
    #[serde(rename = "penetration_mm", serialize_with = "both_in_millimetres")]
    pub penetration: Compared<f64>,
    /// Fraction of foot samples in stance that were declared free because the leg's limits do not let it hold the foot
    /// in place.
    #[serde(skip)]
    pub freed: f64,
}

/// Support of the body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ZmpReport {
    /// Zero-moment point outside the support polygon before and after balancing.
    pub zmp_outside: Compared<ZmpOutside>,
    /// Fraction of the clip in which something other than the feet carries the body (chair, hands, back).
    #[serde(rename = "carried_share")]
    pub carried: f64,
}

/// Largest changes of the pelvis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PelvisReport {
    /// Shift for balance, m.
    #[serde(rename = "shift_max_mm", serialize_with = "millimetres")]
    pub shift: f64,
    /// Lowering so that planted legs reach, m.
    #[serde(rename = "pelvis_drop_max_mm", serialize_with = "millimetres")]
    pub drop: f64,
    /// Angle of tilting back where hips do not flex as far as recorded, rad.
    #[serde(skip)]
    pub tilt: f64,
    /// Raise where legs do not fold as far as recorded, m.
    #[serde(skip)]
    pub raise: f64,
}

/// Running in the recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunningReport {
    /// Speed over the floor of the fastest run, m/s, if the recording runs anywhere.
    pub speed: Option<f64>,
    /// Whether runs are turned into walking.
    pub walked: bool,
}

/// Findings, guesses and changes made in reading a recording.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReadingReport {
    /// Bones.
    #[serde(flatten)]
    pub skeleton: SkeletonReport,
    /// Units, axes and scale.
    #[serde(flatten)]
    pub size: SizeReport,
    /// Frames and samples.
    #[serde(flatten)]
    pub frames: FrameReport,
    /// Floor, place and heading.
    #[serde(flatten)]
    pub place: PlaceReport,
    /// Joint angles.
    #[serde(flatten)]
    pub joints: LimbFitReport,
    /// Angles that had to be clamped.
    pub clamped: Vec<ClampedDof>,
    /// Contacts of the feet.
    #[serde(flatten)]
    pub feet: FootReport,
    /// Support of the body.
    #[serde(flatten)]
    pub balance: ZmpReport,
    /// Path of the pelvis.
    #[serde(flatten)]
    pub pelvis: PelvisReport,
    /// Running.
    #[serde(skip)]
    pub runs: RunningReport,
    /// Messages for the user.
    pub warnings: Vec<String>,
}

/// Lengths in m as mm.
fn both_in_millimetres<S: Serializer>(lengths: &Compared<f64>, s: S) -> Result<S::Ok, S::Error> {
    lengths.map(|l| 1e3 * l).serialize(s)
}

impl ReadingReport {
    /// Adds a sentence for each finding that a user should know.
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
        for c in self.clamped.iter().filter(notable) {
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
