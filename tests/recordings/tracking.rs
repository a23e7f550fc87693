//! Goal: figures of human strength follow built-in standing motions closely, and whatever the command, their torques
//! stay within their strength, no unexplained force holds them up, and every number is finite. Method: recordings and
//! built-in motions through whole worlds; every tick is audited by [`sinew_evaluate`], which rebuilds the equations of
//! motion from the body alone.

use crate::common::mocap::CLIPS;
use crate::common::{Scene, authored, man, recorded};
use sinew_evaluate::RunReport;
use sinew_physics::body::Body;
use sinew_physics::figure::ControllerKind;
use sinew_physics::motion::Clip;
use std::sync::Arc;

/// A torque may exceed its limit only by rounding, relative.
const OVER_LIMIT: f64 = 1e-9;
/// Equations of motion, relative.
const RESIDUAL: f64 = 1e-9;
/// Unexplained force on the pelvis in units of the body weight, and moment in body weights times metres.
const UNEXPLAINED: f64 = 1e-6;
/// Errors of a followed motion, degrees.
const JOINT_RMS: f64 = 1.5;
/// Depth of a followed motion below the ground, mm.
const PENETRATION: f64 = 5.0;

fn run(body: &Arc<Body>, controller: ControllerKind, clip: &Arc<Clip>) -> RunReport {
    Scene::playing(body, controller, clip).measure(clip.duration())
}

fn line(name: &str, r: &RunReport) -> String {
    format!(
        "{name:>14}: fell {:?}, rms {:.3}°, max {:.2}°, over {:.1e}, residual {:.1e}, root {:.1e} N {:.1e} N·m, depth \
         {:.2} mm, slip {:.2} mm/s, use {:.2}",
        r.fell_at_s,
        r.tracking_joint_rms_deg,
        r.tracking_joint_max_deg,
        r.over_limit_max,
        r.dynamics_residual_max,
        r.root_wrench_unexplained_max_n,
        r.root_wrench_unexplained_max_nm,
        r.penetration_max_mm,
        r.foot_slip_mm_per_s,
        r.max_utilisation
    )
}

/// Faults that no figure may ever show, however it is driven.
fn faults(body: &Body, r: &RunReport) -> Vec<String> {
    let weight = body.profile.mass * 9.81;
    let mut out = Vec::new();
    let mut check = |ok: bool, what: String| {
        if !ok {
            out.push(what);
        }
    };
    check(
        r.non_finite_ticks == 0,
        format!("{} ticks not finite", r.non_finite_ticks),
    );
    check(
        r.quarantined_at_s.is_none(),
        format!("quarantined at {:?} s", r.quarantined_at_s),
    );
    check(
        r.over_limit_max <= OVER_LIMIT,
        format!("over limit by {:e}", r.over_limit_max),
    );
    check(
        r.dynamics_residual_max <= RESIDUAL,
        format!("residual {:e}", r.dynamics_residual_max),
    );
    let force = r.root_wrench_unexplained_max_n / weight;
    let moment = r.root_wrench_unexplained_max_nm / weight;
    check(force < UNEXPLAINED, format!("unexplained force {force:e}"));
    check(
        moment < UNEXPLAINED,
        format!("unexplained moment {moment:e}"),
    );
    out
}

fn assert_none(faults: &[String]) {
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Runs the standing motions; all must be followed.
fn follows(controller: ControllerKind, motions: &[(&str, Arc<Clip>)], body: &Arc<Body>) {
    let mut wrong = Vec::new();
    for (name, clip) in motions {
        let r = run(body, controller, clip);
        let text = line(name, &r);
        println!("{text}");
        let mut found = faults(body, &r);
        if r.fell_at_s.is_some() {
            found.push("fell".to_owned());
        }
        if r.tracking_joint_rms_deg >= JOINT_RMS {
            found.push("strays".to_owned());
        }
        if r.penetration_max_mm >= PENETRATION {
            found.push("sinks in".to_owned());
        }
        if !found.is_empty() {
            wrong.push(format!("{text}\n    {}", found.join(", ")));
        }
    }
    assert_none(&wrong);
}

#[test]
fn modern_follows_built_in_standing_motions() {
    let body = man();
    let motions = ["idle", "lift", "squat", "wave"].map(|n| (n, authored(&body, n)));
    follows(ControllerKind::Modern, &motions, &body);
}

/// Plays every recording to its end, through falls if necessary: walking and jumping may fail, but physics may not.
fn stays_physical(controller: ControllerKind) {
    let body = man();
    let mut wrong = Vec::new();
    for name in CLIPS {
        let r = run(&body, controller, &recorded(&body, name));
        let text = line(name, &r);
        println!("{text}");
        let found = faults(&body, &r);
        if !found.is_empty() {
            wrong.push(format!("{text}\n    {}", found.join(", ")));
        }
    }
    assert_none(&wrong);
}

#[test]
fn modern_stays_physical_on_every_recording() {
    stays_physical(ControllerKind::Modern);
}

#[test]
fn paper_stays_physical_on_every_recording() {
    stays_physical(ControllerKind::Paper);
}
