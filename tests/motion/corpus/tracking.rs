//! Motions that the default figure follows to the end.

use crate::common::Scene;
use crate::corpus::plans;
use crate::corpus::recorded::{Fit, fits, man};
use sinew_evaluate::RunReport;
use sinew_evaluate::experiments::walk::{WalkTrial, Walker, walk};
use sinew_physics::figure::ControllerKind;
use std::sync::Arc;

fn run(f: &Fit) -> RunReport {
    let clip = Arc::new(f.fitted.clip.clone());
    Scene::playing(&Arc::new(man()), ControllerKind::Modern, &clip).measure(clip.duration())
}

/// Runs the clean files of `names`; none may fall, stray or slip.
fn follows(names: &[&str], joints_deg: f64, places_mm: f64) {
    for f in
        fits().filter(|f| f.dialect.name == "vrm" && names.contains(&f.motion.script.name.as_str()))
    {
        let r = run(f);
        let what = f.what();
        assert_eq!(r.fell_at_s, None, "{what} fell");
        assert!(
            r.tracking_joint_rms_deg < joints_deg,
            "{what}: joints {}° rms",
            r.tracking_joint_rms_deg
        );
        assert!(
            r.tracking_mpjpe_global_mm < places_mm,
            "{what}: segments {} mm off in the world",
            r.tracking_mpjpe_global_mm
        );
        assert!(
            r.foot_slip_mm_per_s < 2.0 && r.penetration_max_mm < 3.0,
            "{what}: {} mm/s, {} mm",
            r.foot_slip_mm_per_s,
            r.penetration_max_mm
        );
        assert!(r.over_limit_max < 1e-9 && r.non_finite_ticks == 0, "{what}");
    }
}

#[test]
fn standing_motions_are_followed() {
    follows(&["stand", "wave", "squat", "lift"], 0.1, 2.0);
}

#[test]
fn steps_and_turns_are_followed() {
    follows(&["turn", "side-steps", "back-steps", "kick"], 0.5, 5.0);
}

#[test]
fn walks_are_followed() {
    follows(
        &[
            "walk-slow",
            "walk-crouched",
            "walk-arc",
            "walk-stop-start",
            "walk-broad",
            "walk-normal",
            "walk-normal-tall",
        ],
        1.0,
        20.0,
    );
}

#[test]
fn the_jump_ends_on_its_feet() {
    follows(&["jump"], 3.0, 40.0);
}

/// Fastest walk that figures follow today, m/s (docs/limits.md).
const BRISK: f64 = 1.4;

/// Walks cut out of their recordings begin and end with steps that were not recorded.
#[test]
fn strides_are_walked_from_standing_to_standing() {
    let body = Arc::new(man());
    for name in plans::walks() {
        let clip = plans::strides(name);
        let way = clip.advance();
        if way.x.hypot(way.y) / clip.duration() > BRISK {
            continue;
        }
        let w = walk(&Walker::new(&body), &WalkTrial::once(&clip));
        let text = format!(
            "{name}: {:.2} deg, capture point {:.0} mm, slides {:.1} mm",
            w.report.tracking_joint_rms_deg,
            1e3 * w.capture[1],
            1e3 * w.slip
        );
        println!("{text}");
        assert!(w.stood(), "{text}: fell at {:?} s", w.fell_s);
    }
}
