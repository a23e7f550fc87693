//! Faults of a file are left out, solved again or reported: poses held before the motion, hips at their limit, a root
//! without positions, joints cut by their limits.

use crate::corpus::angles::upper_errors;
use crate::corpus::labels::{agreement, labelled};
use crate::corpus::preparation::lowest;
use crate::corpus::recorded::{Fit, all_fits};

/// Recordings that begin with a held pose.
fn held() -> impl Iterator<Item = &'static Fit> {
    all_fits().iter().filter(|f| f.dialect.held > 0)
}

#[test]
fn held_first_frames_are_left_out() {
    let wrong: Vec<String> = held()
        .filter(|f| f.fitted.report.frames.skipped_frames != f.dialect.held)
        .map(|f| {
            format!(
                "{}: {} frames left out of {} held",
                f.what(),
                f.fitted.report.frames.skipped_frames,
                f.dialect.held
            )
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn trunk_head_and_arms_turn_as_recorded_after_a_held_pose() {
    for f in held() {
        let (rms, most) = upper_errors(f);
        let (rms_bound, bound) = if f.motion.script.kind == "run" {
            (0.5, 2.5)
        } else {
            (0.12, 0.5)
        };
        assert!(
            rms < rms_bound && most < bound,
            "{}: {rms}° rms, {most}° at most",
            f.what()
        );
    }
}

#[test]
fn touch_downs_are_labelled_after_a_held_pose() {
    for f in held() {
        let a = agreement(f, labelled);
        let on_time = |e: &Option<f64>| e.is_some_and(|e| e.abs() < 0.12);
        assert!(
            a.events[0].iter().all(on_time),
            "{}: {:?}",
            f.what(),
            a.events[0]
        );
        let (precision, recall) = (a.overlap.precision(), a.overlap.recall());
        assert!(
            precision > 0.9 && recall > 0.9,
            "{}: precision {precision}, recall {recall}",
            f.what()
        );
    }
}

#[test]
fn soles_stay_out_of_the_floor_where_hips_are_at_their_limit() {
    for f in all_fits()
        .iter()
        .filter(|f| f.motion.script.kind == "floor")
    {
        let (low, when) = lowest(f);
        assert!(
            low > -5e-3,
            "{}: sole {low} m over the floor at {when} s",
            f.what()
        );
    }
}

#[test]
fn a_root_without_positions_is_reported() {
    for f in all_fits().iter().filter(|f| f.dialect.name == "rot-only") {
        let warnings = &f.fitted.report.warnings;
        assert!(
            warnings.iter().any(|w| w.contains("position")),
            "{}: {warnings:?}",
            f.what()
        );
    }
}

#[test]
fn every_long_clamp_is_a_warning() {
    for f in all_fits() {
        let r = &f.fitted.report;
        for c in r
            .clamped
            .iter()
            .filter(|c| c.max.to_degrees() > 5.0 && c.fraction > 0.05)
        {
            assert!(
                r.warnings.iter().any(|w| w.contains(c.dof)),
                "{}: {c:?} is not in {:?}",
                f.what(),
                r.warnings
            );
        }
    }
}
