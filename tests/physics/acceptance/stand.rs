//! Goal: a figure commanded to stand still on bent knees does so, under both controllers and at any tick rate, and the
//! ground carries exactly its weight under its centre of mass. Method: statics.

use super::GRAVITY;
use crate::common::{Scene, authored, figure, man, still};
use sinew_physics::figure::{ControllerKind, FigureSetup, Flags, StepperKind};
use sinew_physics::world::WorldParams;

/// `drift_limit`: degrees, any joint, after ten seconds.
fn stands(kind: ControllerKind, rate_hz: f64, substeps: u32, drift_limit: f64) {
    stands_with(StepperKind::Torque, kind, rate_hz, substeps, drift_limit);
}

fn stands_with(
    stepper: StepperKind,
    kind: ControllerKind,
    rate_hz: f64,
    substeps: u32,
    drift_limit: f64,
) {
    let body = man();
    // Half-way down: knees well bent, centre of mass over the feet.
    let posture = authored(&body, "squat").sample(1.2).posture;
    let params = WorldParams {
        rate_hz,
        substeps,
        ..WorldParams::default()
    };
    let setup = FigureSetup {
        stepper,
        ..figure(&body, kind, still(posture))
    };
    let mut scene = Scene::with(params, setup);
    let (mut off, mut ticks, mut least, mut most, mut force) = (0.0, 0.0, f64::MAX, 0.0f64, 0.0);
    let mut drift = 0.0f64;
    scene.run(10.0, |s| {
        let r = s.figure().report().unwrap();
        assert!(!r.flags.has(Flags::HANDED_OVER), "{:?} s", s.world.time().0);
        let z = r.balance.zmp.expect("it stands");
        let f: f64 = r.contacts.iter().map(|c| c.force.z).sum();
        ticks += 1.0;
        force += f;
        off += (z.x - r.balance.com.x).hypot(z.y - r.balance.com.y);
        drift = r
            .joints
            .joint_error
            .iter()
            .fold(drift, |m, e| m.max(e.abs()));
        if s.world.time().0 > 1.0 {
            (least, most) = (least.min(f), most.max(f));
        }
    });
    let weight = body.profile.mass * GRAVITY;
    let (drift, off, force) = (drift.to_degrees(), 1e3 * off / ticks, force / ticks);
    let text = format!(
        "{kind:?} {stepper:?} at {rate_hz} Hz × {substeps}: drift {drift:.4}°, ZMP off {off:.3} mm, force {force:.3} N \
         ({least:.2}…{most:.2}) of {weight:.3} N"
    );
    println!("{text}");
    assert!(!scene.figure().is_fallen(), "{text}");
    assert!(drift < drift_limit, "{text}");
    assert!(off < 1.0, "{text}");
    for f in [force, least, most] {
        assert!((f - weight).abs() < 5e-3 * weight, "{text}");
    }
}

#[test]
fn modern_stands() {
    stands(ControllerKind::Modern, 60.0, 2, 0.1);
}

#[test]
fn modern_stands_at_other_rates() {
    stands(ControllerKind::Modern, 30.0, 2, 0.2);
    stands(ControllerKind::Modern, 120.0, 2, 0.1);
}

#[test]
fn paper_stands() {
    stands(ControllerKind::Paper, 60.0, 2, 0.1);
}

#[test]
fn paper_stands_at_other_rates() {
    stands(ControllerKind::Paper, 30.0, 2, 0.2);
    stands(ControllerKind::Paper, 120.0, 2, 0.1);
}

#[test]
fn paper_stands_with_prescribed_accelerations() {
    for rate in [30.0, 60.0, 120.0] {
        stands_with(StepperKind::Kinematic, ControllerKind::Paper, rate, 1, 0.1);
    }
}
