//! Goal: the paper's three regimes of lifting with an arm that is 2 % too weak for 3 kg. Method: the built-in
//! semi-squat lift; the strength of the right arm is scaled to 98 % of that needed to hold the most demanding posture
//! of the motion still with 3 kg.

use crate::common::{Scene, figure, man, play};
use sinew_evaluate::experiments::ControlPair;
use sinew_evaluate::experiments::lift::{is_arm, weak_arm};
use sinew_evaluate::experiments::person::{Lifter, trial};
use sinew_physics::body::topology::{DOF_NAMES, R_HAND};
use sinew_physics::body::{DOF_COUNT, Profile, Sex};
use sinew_physics::figure::motion::tasks::grip;
use sinew_physics::figure::{ControllerKind, Perturbation, StepperKind};
use sinew_physics::motion::builtin::{LIFT_GRASP, LiftEnd, builtin};
use sinew_physics::world::WorldParams;
use std::sync::Arc;

/// Height of the centre of mass below which it has fallen, m.
const LOW: f64 = 0.55;

/// Measurements of a lift, until the end or the fall.
struct Lifted {
    mass: f64,
    /// Time at which the centre of mass was low, s.
    fell: Option<f64>,
    /// Joint error, rms, degrees.
    rms: f64,
    /// Time during which a DOF of the arm was at its limit, s.
    arm_saturated: f64,
    /// Whether any DOF of the arm was.
    saturated: bool,
    /// Largest error of ankles, knees, hips and back, degrees.
    others: f64,
    /// Least margin of the zero-moment point, m.
    margin: f64,
    /// Top joint speed, rad/s.
    speed: f64,
    /// Mean change of torque per tick, as a share of the range.
    chatter: f64,
    /// Sag of the arm: its largest joint error, degrees.
    arm: f64,
    /// Largest excess of a torque over its limit, relative.
    over: f64,
    text: String,
}

fn lift(mass: f64, kind: ControllerKind, stepper: StepperKind, rate_hz: f64) -> Lifted {
    let body = man();
    let clip = Arc::new(builtin(&body, "lift").unwrap());
    let factor = weak_arm(&body, &clip, 3.0);
    let first = clip.sample(0.0);
    let state = first.state();
    let mut setup = figure(&body, kind, state);
    setup.stepper = stepper;
    for j in (0..DOF_COUNT).filter(|j| is_arm(*j)) {
        setup.strength.dof[j] = factor;
    }
    let params = WorldParams {
        rate_hz,
        ..WorldParams::default()
    };
    let mut scene = Scene::with(params, setup);
    scene.figure_mut().set_drive(play(&clip));
    let load = Perturbation::Load {
        segment: R_HAND,
        point: grip(&body, R_HAND),
        mass,
        from: LIFT_GRASP,
        to: f64::INFINITY,
    };
    scene.world.perturb(scene.key, load).unwrap();
    let mut out = Lifted {
        mass,
        fell: None,
        rms: 0.0,
        arm_saturated: 0.0,
        saturated: false,
        others: 0.0,
        margin: f64::MAX,
        speed: 0.0,
        chatter: 0.0,
        arm: 0.0,
        over: 0.0,
        text: String::new(),
    };
    let (mut last, mut n) = (None::<[f64; DOF_COUNT]>, 0.0);
    scene.run(8.0, |s| {
        let r = s.figure().report().unwrap();
        out.over = out.over.max(r.joints.over_limit);
        if out.fell.is_some() {
            return;
        }
        if r.balance.com.z < LOW {
            out.fell = Some(s.world.time().0);
        }
        n += 1.0;
        out.rms += r.joints.joint_error.iter().map(|e| e * e).sum::<f64>() / DOF_COUNT as f64;
        let at_limit = |j: &usize| r.joints.saturated >> j & 1 == 1;
        if (0..DOF_COUNT).filter(|j| is_arm(*j)).any(|j| at_limit(&j)) {
            out.arm_saturated += 1.0 / rate_hz;
        }
        out.saturated |= r.joints.saturated != 0;
        for j in 0..DOF_COUNT {
            let error = r.joints.joint_error[j].abs().to_degrees();
            if is_arm(j) {
                out.arm = out.arm.max(error);
            } else if helps(j) {
                out.others = out.others.max(error);
            }
            out.speed = out.speed.max(s.figure().state().velocity[6 + j].abs());
            if let Some(last) = last {
                let range = r.joints.torque_upper[j] - r.joints.torque_lower[j];
                out.chatter += (r.joints.torque[j] - last[j]).abs() / range / DOF_COUNT as f64;
            }
        }
        last = Some(r.joints.torque);
        out.margin = out
            .margin
            .min(r.balance.margin.unwrap_or(f64::NEG_INFINITY));
    });
    out.rms = (out.rms / n).sqrt().to_degrees();
    out.chatter /= n;
    out.text = format!(
        "{kind:?} {stepper:?} {rate_hz} Hz {mass} kg: fell {:?}, rms {:.2}°, arm {:.1}° at its limit for {:.2} s, \
         others {:.1}°, margin {:.3} m, speed {:.1} rad/s, chatter {:.4}, over {:.1e}",
        out.fell,
        out.rms,
        out.arm,
        out.arm_saturated,
        out.others,
        out.margin,
        out.speed,
        out.chatter,
        out.over
    );
    println!("{}", out.text);
    out
}

/// Ankles, knees, hips and back, which yield when the arm is too weak.
fn helps(j: usize) -> bool {
    ["ankle", "knee", "hip", "waist", "thorax"]
        .iter()
        .any(|p| DOF_NAMES[j].contains(p))
}

fn tracked(l: &Lifted) {
    assert!(
        l.fell.is_none() && l.rms < 0.5 && !l.saturated,
        "{}",
        l.text
    );
    assert!(l.over < 1e-9, "{}", l.text);
}

/// The paper's account: the arm is at its limit, other joints yield slightly, and balance is kept.
fn borne(l: &Lifted) {
    assert!(l.fell.is_none() && l.arm_saturated >= 1.0, "{}", l.text);
    assert!(l.others > 1.0 && l.others < 8.0, "{}", l.text);
    assert!(l.margin > 0.03 && l.over < 1e-9, "{}", l.text);
}

/// Too heavy: the figure falls, at any time. Or the arm gives way altogether, and a load that hangs from it at the side
/// does not make the figure fall.
fn overcome(l: &Lifted) {
    let dropped = l.mass > 4.5 && l.arm > 90.0 && l.margin < 1e-3;
    assert!(l.fell.is_some() || dropped, "{}", l.text);
    assert!(l.speed < 25.0 && l.over < 1e-9, "{}", l.text);
}

/// Each regime with the paper's controller, in both steppers, at three rates.
#[test]
fn the_papers_three_regimes() {
    for stepper in [StepperKind::Kinematic, StepperKind::Torque] {
        for rate_hz in [30.0, 60.0, 120.0] {
            let run = |mass| lift(mass, ControllerKind::Paper, stepper, rate_hz);
            tracked(&run(1.0));
            borne(&run(3.0));
            overcome(&run(4.0));
            overcome(&run(5.0));
        }
    }
}

/// The modern controller lets the arm sink and stays up.
#[test]
fn modern_keeps_its_balance_under_every_load() {
    for rate_hz in [30.0, 60.0, 120.0] {
        let mut sunk = 0.0;
        for mass in [1.0, 3.0, 4.0, 5.0] {
            let l = lift(mass, ControllerKind::Modern, StepperKind::Torque, rate_hz);
            assert!(l.fell.is_none() && l.margin > 0.03, "{}", l.text);
            assert!(l.chatter < 0.005 && l.over < 1e-9, "{}", l.text);
            assert!(l.arm > sunk, "{}: {} kg", l.text, l.mass);
            sunk = l.arm;
            if mass == 1.0 {
                tracked(&l);
            }
        }
    }
}

/// No arm is scaled here: the person is the one found by the search of `sinew paper`, with the strength of the tables.
#[test]
fn a_named_person_lifts_as_the_paper_shows() {
    let candidate = Lifter {
        profile: Profile::ordinary(Sex::Female, 18.0),
        percentile: 5.0,
        end: LiftEnd {
            squat: 0.5,
            reach: 0.45,
        },
    };
    let t = trial(&candidate, &ControlPair::paper_kinematic(), 0).expect("worth a run");
    for r in &t.results {
        println!(
            "{} kg: {}, {:.2}° rms, knees, hips, back {:.1?}°, bends {:.1}°, at the fall {:.0}°, jerk {:.1}",
            r.mass,
            r.record.result(),
            r.rms,
            r.helps,
            r.bends,
            r.folds,
            r.jerk
        );
        assert!(r.record.over_limit < 1e-9);
    }
    assert_eq!(t.shows(), [true; 4]);
    // The arm's strength ends at 3 kg, which causes a jerk that 1 kg does not cause.
    assert!(t.need[0] < 0.5 && t.need[2] > 1.0 && t.results[1].jerk > 10.0 * t.results[0].jerk);
}
