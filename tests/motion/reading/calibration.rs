//! Orientation of segments relative to the bones of a file whose zero pose does not define it.

use crate::reading::dof;
use crate::reading::file::{File, bare, bones_along_one_axis, motion, turned};
use sinew_physics::body::angles::{anatomical_angles, set_anatomical_angles};
use sinew_physics::body::topology::{DOF_COUNT, DOF_NAMES, HEAD, L_HAND, R_HAND};
use sinew_physics::body::{Body, Posture};
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::motion::Clip;

/// Median difference of each angle, rad.
fn off(clip: &Clip, truth: &[Posture]) -> [f64; DOF_COUNT] {
    let samples: Vec<[f64; DOF_COUNT]> = (0..clip.len().min(truth.len()))
        .map(|i| {
            let (a, b) = (
                anatomical_angles(clip.posture(i)),
                anatomical_angles(&truth[i]),
            );
            std::array::from_fn(|d| a[d] - b[d])
        })
        .collect();
    std::array::from_fn(|d| {
        let mut v: Vec<f64> = samples.iter().map(|a| a[d]).collect();
        v.sort_by(f64::total_cmp);
        v[v.len() / 2]
    })
}

#[test]
fn one_odd_frame_does_not_calibrate_the_clip() {
    let body = Body::adult_man();
    let lean = Quat::exp(Vec3::Y * 0.1);
    let truth = turned(&motion(&body, "idle"), lean);
    let mut seen = truth.clone();
    // A moment in which the body is more upright than ever, and looks aside with its hands turned over.
    let n = seen.len();
    for (k, p) in seen[n / 2..n / 2 + 48].iter_mut().enumerate() {
        let on = (std::f64::consts::PI * k as f64 / 48.0).sin();
        *p = turned(&[*p], Quat::exp(Vec3::Y * (-0.1 * on)))[0];
        let mut angles = anatomical_angles(p);
        for (d, angle) in [
            ("neck_rotation", 1.1),
            ("l_elbow_pronation", -1.0),
            ("r_elbow_pronation", -1.0),
        ] {
            angles[dof(d)] += (angle - angles[dof(d)]) * on;
        }
        set_anatomical_angles(p, &angles);
    }
    let file = File::with_axes(&body, &seen, &bones_along_one_axis(&body));
    let r = file.read(&body, &bare());
    assert!(
        r.report.warnings.iter().any(|w| w.contains("zero pose")),
        "{:?}",
        r.report.warnings
    );
    let off = off(&r.clip, &truth);
    for d in 0..DOF_COUNT {
        let most: f64 = 12.0;
        let degrees = off[d].to_degrees();
        assert!(
            degrees.abs() < most,
            "{} is {degrees:.1}° off",
            DOF_NAMES[d]
        );
    }
}

#[test]
fn hands_that_are_turned_over_for_a_whole_clip_leave_forearms_within_their_limits() {
    let body = Body::adult_man();
    let truth = motion(&body, "wave");
    for twist in [-160.0f64, 100.0, 170.0] {
        let mut file = File::new(&body, &truth);
        // The hand's own rotation includes a twist that the zero pose lacks.
        for row in &mut file.rows {
            for s in [L_HAND, R_HAND] {
                row[3 + 3 * s.index() + 2] += twist;
            }
        }
        let r = file.read(&body, &bare());
        for side in ["l", "r"] {
            let name = format!("{side}_elbow_pronation");
            let d = dof(&name);
            let clamped = r.report.clamped.iter().find(|c| c.dof == name);
            assert!(
                clamped.is_none_or(|c| c.fraction < 0.05),
                "{twist}°: {clamped:?}"
            );
            let at_limit = (0..r.clip.len())
                .filter(|i| anatomical_angles(r.clip.posture(*i))[d].abs() > 1.45)
                .count();
            assert!(
                (at_limit as f64) < 0.05 * r.clip.len() as f64,
                "{twist}°: {name}"
            );
        }
        let said = |w: &&String| w.contains("forearm: its rotation was taken");
        assert_eq!(
            r.report.warnings.iter().filter(said).count(),
            2,
            "{:?}",
            r.report.warnings
        );
    }
}

#[test]
fn a_head_that_is_turned_is_turned() {
    // Knowledge from a calibration by the zero pose is not averaged away.
    let body = Body::adult_man();
    let mut file = File::new(&body, &motion(&body, "idle"));
    for row in &mut file.rows {
        row[3 + 3 * HEAD.index() + 2] += 40.0;
    }
    let r = file.read(&body, &bare());
    let angle = anatomical_angles(r.clip.posture(60))[dof("neck_rotation")].to_degrees();
    assert!((angle.abs() - 40.0).abs() < 3.0, "{angle}");
}
