//! From a recording to a clip that a body can follow: fitted, labelled, prepared, with a stand at both ends.

use super::contact_labels::{ContactPhase, label_feet, phases};
use super::flight_phases::label_runs;
use super::params::leg;
use super::prepare::{Draft, PrepareOptions, Prepared, prepare};
use super::reading_report::{
    ClampedDof, FootReport, PelvisReport, ReadingReport, RunningReport, ZmpReport,
};
use crate::body::topology::DOF_NAMES;
use crate::body::{Body, Posture};
use crate::motion::clip::Clip;
use crate::motion::recording::Recording;
use crate::reference::{FittedReference, RetargetError, RetargetOptions, fit};
use std::mem::take;

/// The clip of a recording with its report.
#[derive(Clone, Debug)]
pub struct PreparedRecording {
    /// The motion.
    pub clip: Clip,
    /// Findings and changes.
    pub report: ReadingReport,
}

/// The clip of a recording for `body`.
///
/// Offline: time and memory are linear in frames × joints, about 0.2 s for 10 s at 120 Hz.
///
/// # Errors
/// [`RetargetError`] names what is missing: the bone, the unit with the measured figure, the frame.
pub fn prepare_recording(
    recording: &Recording,
    body: &Body,
    options: &RetargetOptions,
) -> Result<PreparedRecording, RetargetError> {
    prepare_recording_unless(recording, body, options, &|| false)
}

/// As [`prepare_recording`], but gives up between two of its stages once `stop` says so.
///
/// # Errors
/// Those of [`prepare_recording`]; [`RetargetError::Stopped`].
pub fn prepare_recording_unless(
    recording: &Recording,
    body: &Body,
    options: &RetargetOptions,
    stop: &dyn Fn() -> bool,
) -> Result<PreparedRecording, RetargetError> {
    let go_on = || RetargetError::unless(stop);
    let mut fitted = fit(recording, body, options, stop)?;
    let mut draft = labelled(&mut fitted);
    if fitted.keeps_run() {
        label_kept_runs(body, &mut draft);
        go_on()?;
    }
    draft.rate_hz *= options.tempo;
    let rate_hz = draft.rate_hz;
    let phases = phases(&draft.label, rate_hz);
    let how = PrepareOptions {
        lock_feet: options.preparation.lock_feet && options.floor,
        balance: options.preparation.balance,
        runs: fitted.fastest_run.is_some(),
        held: leg::HELD,
    };
    let mut prepared = prepare(body, &draft, how);
    go_on()?;
    let mut motion = PlannedMotion::of(&mut prepared);
    if options.preparation.ends && how.lock_feet {
        motion = motion.with_ends(body, draft, how);
    }
    let clip = Clip::from_postures(&options.name, rate_hz, motion.postures, motion.planted)?
        .with_ends(motion.lead_in, motion.lead_out);
    fitted.report.frames.rate_hz = rate_hz;
    let report = report(fitted, &prepared, phases, how);
    Ok(PreparedRecording { clip, report })
}

/// The fitted motion as a draft, its feet labelled by their recorded points; runs that are walked keep no flight.
fn labelled(fitted: &mut FittedReference) -> Draft {
    let points = take(&mut fitted.foot_points);
    let mut label = label_feet([&points[0], &points[1]], fitted.rate_hz);
    drop(points);
    fitted.walk_runs(&mut label);
    Draft {
        rate_hz: fitted.rate_hz,
        postures: take(&mut fitted.postures),
        knee_axis: take(&mut fitted.knee_axis),
        ankle: take(&mut fitted.ankle),
        foot: take(&mut fitted.foot),
        label,
    }
}

/// Labels the feet of runs by the load that the floor carries, as the fitted body moves.
fn label_kept_runs(body: &Body, draft: &mut Draft) {
    let as_recorded = PrepareOptions {
        lock_feet: false,
        balance: false,
        runs: true,
        held: leg::HELD,
    };
    let recorded = prepare(body, draft, as_recorded).postures;
    label_runs(body, &recorded, &mut draft.label, draft.rate_hz);
}

/// Postures and planted feet of the clip.
struct PlannedMotion {
    postures: Vec<Posture>,
    planted: Vec<[bool; 2]>,
    /// Samples of the path into the motion, and of the path out of it.
    lead_in: usize,
    lead_out: usize,
}

impl PlannedMotion {
    /// Takes the motion out of the prepared one.
    fn of(prepared: &mut Prepared) -> Self {
        Self {
            postures: take(&mut prepared.postures),
            planted: take(&mut prepared.planted),
            lead_in: 0,
            lead_out: 0,
        }
    }

    /// The motion, prepared from `draft`, with the path into it from a stand and the path out of it.
    fn with_ends(self, body: &Body, draft: Draft, how: PrepareOptions) -> Self {
        let (rate_hz, label) = (draft.rate_hz, draft.label.clone());
        drop(draft); // the draft of a long clip is large
        let mut whole = Draft::of_postures(body, rate_hz, self.postures.clone(), label.clone());
        let (lead_in, lead_out) = whole.add_ends(body);
        // A foot may have been put down even if neither end needs a path.
        if (lead_in, lead_out) == (0, 0) && whole.label == label {
            return self;
        }
        drop(self);
        let whole = prepare(body, &whole, how);
        Self {
            postures: whole.postures,
            planted: whole.planted,
            lead_in,
            lead_out,
        }
    }
}

/// The report of a motion that was prepared with `how`; `phases`: the recording's phases by feet on the floor.
fn report(
    fitted: FittedReference,
    prepared: &Prepared,
    phases: Vec<ContactPhase>,
    how: PrepareOptions,
) -> ReadingReport {
    let clamped = prepared.clamped.iter().zip(DOF_NAMES);
    let (walked, found) = (fitted.walks_runs(), fitted.report);
    let mut report = ReadingReport {
        skeleton: found.skeleton,
        size: found.size,
        frames: found.frames,
        place: found.place,
        joints: found.joints,
        clamped: clamped
            .filter(|(c, _)| c.max > 0.0)
            .map(|(c, dof)| ClampedDof {
                dof,
                max: c.max,
                fraction: c.fraction,
            })
            .collect(),
        feet: FootReport {
            phases,
            slide: prepared.slide,
            penetration: prepared.penetration,
            freed: prepared.freed,
        },
        balance: ZmpReport {
            zmp_outside: prepared.zmp,
            // Without locked feet the support of the body is unknown.
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
        runs: RunningReport {
            speed: fitted.fastest_run,
            walked,
        },
        warnings: fitted.warnings,
    };
    report.note_warnings(found.from_rest);
    report
}
