//! Limits and their reports; runs, and motions that are merely as fast.

use crate::reading::dof;
use crate::reading::file::{File, RATE, bare, lower_soles, motion, range};
use sinew_physics::body::angles::{anatomical_angles, set_anatomical_angles};
use sinew_physics::body::topology::{L_FOOT, R_FOOT};
use sinew_physics::body::{Body, Posture};
use sinew_physics::math::curve::smoothstep;
use sinew_physics::math::vec3::vec3;
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::motion::leg_ik::{forward, solve_leg};
use sinew_physics::reference::{Preparation, RetargetOptions};

/// Stands, squats down until the pelvis is `height` m over the floor and leans by `lean` rad, and stands up again; the
/// feet stay in place.
fn squat(body: &Body, height: f64, lean: f64) -> Vec<Posture> {
    let start = motion(body, "idle")[0];
    let poses = forward(body, &start);
    let feet = [L_FOOT, R_FOOT].map(|f| poses[f.index()]);
    (0..480)
        .map(|i| {
            let t = f64::from(i) / RATE;
            let u = smoothstep((t - 0.5).clamp(0.0, 1.0)) * smoothstep((3.5 - t).clamp(0.0, 1.0));
            let mut p = start;
            let sink = (start.root_position.z - height) * u;
            // Over the feet: the pelvis goes back as the trunk leans.
            p.root_position -= vec3(0.25 * u, 0.0, sink);
            p.root_rotation = Quat::exp(Vec3::Y * (lean * u)) * p.root_rotation;
            for (s, foot) in feet.into_iter().enumerate() {
                solve_leg(body, &mut p, s == 0, foot, 0.0);
            }
            p
        })
        .collect()
}

#[test]
fn the_feet_of_a_deep_squat_stay_on_the_floor() {
    let body = Body::adult_man();
    for (height, lean) in [(0.35, 0.75), (0.3, 0.5), (0.26, 0.4)] {
        let postures = squat(&body, height, lean);
        let flexion = anatomical_angles(&postures[240])[dof("l_hip_flexion")];
        assert!(
            flexion > body.upper[dof("l_hip_flexion")] + 0.2,
            "{flexion} rad is within the limits"
        );
        let r = File::new(&body, &postures).read(&body, &bare());
        let (low, high) = range(lower_soles(&body, &r.clip));
        assert!(
            low > -0.02 && high < 0.02,
            "{height} m, {lean} rad: soles from {low} m to {high} m"
        );
        assert!(
            r.report.warnings.iter().any(|w| w.contains("tilted back")),
            "{:?}",
            r.report.warnings
        );
        for i in 0..r.clip.len() {
            let angles = anatomical_angles(r.clip.posture(i));
            for d in 0..angles.len() {
                assert!((body.lower[d] - 1e-6..=body.upper[d] + 1e-6).contains(&angles[d]));
            }
        }
    }
}

/// The head turned by `angle` rad during `share` of four seconds.
fn looks_aside(body: &Body, angle: f64, share: f64) -> Vec<Posture> {
    let start = motion(body, "idle")[0];
    (0..480)
        .map(|i| {
            let t = f64::from(i) / 480.0;
            let on = smoothstep(((t - 0.3) * 20.0).clamp(0.0, 1.0))
                * smoothstep(((0.3 + share + 0.05 - t) * 20.0).clamp(0.0, 1.0));
            let mut angles = anatomical_angles(&start);
            angles[dof("neck_rotation")] = angle * on;
            let mut p = start;
            set_anatomical_angles(&mut p, &angles);
            p
        })
        .collect()
}

#[test]
fn clamps_worth_knowing_are_warnings_in_words() {
    let body = Body::adult_man();
    let limit = body.upper[dof("neck_rotation")];
    let warnings = |excess: f64, share: f64| {
        let postures = looks_aside(&body, limit + excess.to_radians(), share);
        File::new(&body, &postures)
            .read(&body, &bare())
            .report
            .warnings
    };
    for (excess, share) in [(7.0, 0.3), (20.0, 0.08), (20.0, 0.5)] {
        let w = warnings(excess, share);
        assert_eq!(w.len(), 1, "{w:?}");
        let text = w[0].strip_prefix("neck: rotation cut by up to ").unwrap();
        let (degrees, rest) = text.split_once('°').unwrap();
        let percent = rest
            .strip_prefix(" in ")
            .unwrap()
            .strip_suffix(" % of the clip")
            .unwrap();
        let (degrees, percent): (f64, f64) = (degrees.parse().unwrap(), percent.parse().unwrap());
        assert!((degrees - excess).abs() < 3.0, "{w:?}");
        assert!((percent - 100.0 * share).abs() < 6.0, "{w:?}");
    }
    for (excess, share) in [(3.0, 0.5), (-5.0, 0.5)] {
        assert!(
            warnings(excess, share).is_empty(),
            "{excess}° during {share}"
        );
    }
}

/// Stands, flies forward by `way` m within half a second while it turns over backwards by `turn` rad, and stands.
fn leap(body: &Body, way: f64, turn: f64) -> Vec<Posture> {
    let start = motion(body, "idle")[0];
    (0..300)
        .map(|i| {
            let t = ((f64::from(i) / RATE - 1.0) / 0.5).clamp(0.0, 1.0);
            let mut p = start;
            p.root_position += vec3(way * t, 0.0, 4.0 * 0.306 * t * (1.0 - t));
            p.root_rotation = Quat::exp(Vec3::Y * (-turn * t)) * p.root_rotation;
            p
        })
        .collect()
}

#[test]
fn what_is_fast_but_no_run_is_not_walked() {
    let body = Body::adult_man();
    let options = |walk_runs| RetargetOptions {
        preparation: Preparation {
            walk_runs,
            ..bare().preparation
        },
        ..bare()
    };
    for (what, turn, reason) in [
        ("flip", std::f64::consts::TAU, "the trunk is not upright"),
        ("jump", 0.0, "the feet do not take several steps"),
    ] {
        let file = File::new(&body, &leap(&body, 1.8, turn));
        let kept = file.read(&body, &options(false));
        let asked = file.read(&body, &options(true));
        assert!(
            kept.clip.samples().eq(asked.clip.samples()),
            "{what} is changed"
        );
        assert!(
            asked.report.runs.speed.is_none() && !asked.report.runs.walked,
            "{what}"
        );
        let said = |w: &String| w.contains(reason) && w.contains("no run, kept as recorded");
        assert!(
            asked.report.warnings.iter().any(said),
            "{what}: {:?}",
            asked.report.warnings
        );
    }
}
