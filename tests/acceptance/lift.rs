//! Goal: the paper's three regimes of lifting with an arm that is 2 % too weak for 3 kg. Method: the built-in semi-squat lift; the strength of
//! the right arm is scaled to 98 % of what the highest demand of the motion at 3 kg needs when it is held still.

use crate::GRAVITY;
use crate::common::{Scene, figure, man, play};
use sinew::sim::body::angles::anatomical_angles;
use sinew::sim::body::topology::{DOF_NAMES, R_HAND};
use sinew::sim::body::{Body, DOF_COUNT, Links, State};
use sinew::sim::dynamics::Terms;
use sinew::sim::figure::tasks::grip;
use sinew::sim::figure::{
    ControlParams, ControllerKind, FigureSetup, Flags, Perturbation, StepperKind, StrengthScale,
};
use sinew::sim::motion::Clip;
use sinew::sim::motion::builtin::{LIFT_GRASP, builtin};
use sinew::sim::strength::Strength;
use sinew::sim::world::WorldParams;
use std::sync::Arc;

/// Factor on the strength of the right arm at which it holds 98 % of `mass` in the worst posture of the clip, without moving.
fn arm_factor(body: &Arc<Body>, clip: &Clip, mass: f64) -> f64 {
    let strength = Strength::for_body(body);
    let mut links = Links::new(body);
    links.add_load(R_HAND, grip(body, R_HAND), mass);
    let mut terms = Terms::default();
    let mut need = 0.0f64;
    for i in 0..clip.len() {
        if i as f64 / clip.rate_hz() < LIFT_GRASP {
            continue;
        }
        let state = State {
            posture: *clip.posture(i),
            ..State::default()
        };
        terms.compute(&links, &state, &[], GRAVITY);
        let angles = anatomical_angles(&state.posture);
        let (mut lower, mut upper) = ([0.0; DOF_COUNT], [0.0; DOF_COUNT]);
        strength.range(
            &angles,
            &[0.0; DOF_COUNT],
            &StrengthScale::default().muscles(1.0),
            &mut lower,
            &mut upper,
        );
        for j in (0..DOF_COUNT).filter(|j| arm(*j)) {
            let tau = terms.h[6 + j];
            need = need.max(tau / upper[j]).max(tau / lower[j]);
        }
    }
    0.98 * need
}

/// Shoulder and elbow of the right arm.
fn arm(j: usize) -> bool {
    DOF_NAMES[j].starts_with("r_shoulder") || DOF_NAMES[j].starts_with("r_elbow")
}

struct Lifted {
    fell: Option<f64>,
    rms: f64,
    arm_saturated: f64,
    saturated_ever: bool,
    others: f64,
    margin: f64,
    speed: f64,
    chatter: f64,
    over: f64,
    handed: bool,
}

fn lift(
    mass: f64,
    kind: ControllerKind,
    stepper: StepperKind,
    params: ControlParams,
    rate_hz: f64,
) -> Lifted {
    let body = man();
    let clip = Arc::new(builtin(&body, "lift").unwrap());
    let factor = arm_factor(&body, &clip, 3.0);
    let first = clip.sample(0.0);
    let mut setup = FigureSetup {
        stepper,
        params,
        ..figure(
            &body,
            kind,
            State {
                posture: first.posture,
                velocity: first.velocity,
            },
        )
    };
    for j in (0..DOF_COUNT).filter(|j| arm(*j)) {
        setup.strength.dof[j] = factor;
    }
    let mut scene = Scene::with(
        WorldParams {
            rate_hz,
            substeps: if rate_hz > 100.0 { 1 } else { 2 },
            ..WorldParams::default()
        },
        setup,
    );
    scene.figure_mut().set_drive(play(&clip));
    scene
        .world
        .perturb(
            scene.key,
            Perturbation::Load {
                segment: R_HAND,
                point: grip(&body, R_HAND),
                mass,
                from: LIFT_GRASP,
                to: f64::INFINITY,
            },
        )
        .unwrap();
    let mut out = Lifted {
        fell: None,
        rms: 0.0,
        arm_saturated: 0.0,
        saturated_ever: false,
        others: 0.0,
        margin: f64::MAX,
        speed: 0.0,
        chatter: 0.0,
        over: 0.0,
        handed: false,
    };
    let mut last: Option<[f64; DOF_COUNT]> = None;
    let (mut n, mut dt) = (0.0, 1.0 / rate_hz);
    dt += 0.0;
    scene.run(5.5, |s| {
        let r = s.figure().report().unwrap();
        if out.fell.is_none() && r.com.z < 0.55 {
            out.fell = Some(s.world.time());
        }
        n += 1.0;
        out.rms += r.joint_error.iter().map(|e| e * e).sum::<f64>() / DOF_COUNT as f64;
        if (0..DOF_COUNT).any(|j| arm(j) && r.saturated >> j & 1 == 1) {
            out.arm_saturated += dt;
        }
        out.saturated_ever |= r.saturated != 0;
        for j in 0..DOF_COUNT {
            let name = DOF_NAMES[j];
            if ["hip", "knee", "waist", "thorax", "ankle"]
                .iter()
                .any(|p| name.contains(p))
            {
                out.others = out.others.max(r.joint_error[j].abs().to_degrees());
            }
            out.speed = out.speed.max(s.figure().state().velocity[6 + j].abs());
            if let Some(l) = last {
                out.chatter += (r.torque[j] - l[j]).abs()
                    / (r.torque_upper[j] - r.torque_lower[j])
                    / DOF_COUNT as f64;
            }
        }
        last = Some(r.torque);
        out.margin = out.margin.min(r.margin.unwrap_or(f64::NEG_INFINITY));
        out.over = out.over.max(r.over_limit);
        out.handed |= r.flags.has(Flags::HANDED_OVER);
    });
    out.rms = (out.rms / n).sqrt().to_degrees();
    out.chatter /= n;
    out
}

#[test]
fn survey() {
    for (kind, stepper) in [
        (ControllerKind::Paper, StepperKind::Kinematic),
        (ControllerKind::Paper, StepperKind::Torque),
        (ControllerKind::Modern, StepperKind::Torque),
    ] {
        for (label, params) in [
            ("default", ControlParams::default()),
            (
                "no feasible",
                ControlParams {
                    zmp_feasible: false,
                    ..ControlParams::default()
                },
            ),
            (
                "H2",
                ControlParams {
                    metric: sinew::sim::figure::Metric::Torque,
                    ..ControlParams::default()
                },
            ),
            ("paper2000", ControlParams::paper2000()),
        ] {
            if kind == ControllerKind::Modern && label != "default" {
                continue;
            }
            for mass in [1.0, 3.0, 4.0, 5.0] {
                let l = lift(mass, kind, stepper, params.clone(), 60.0);
                println!(
                    "{kind:?} {stepper:?} {label} {mass} kg: fell {:?}, rms {:.2}°, arm sat {:.2} s, any {}, others {:.1}°, margin {:.3}, speed {:.1}, chatter {:.4}, over {:.1e}, handed {}",
                    l.fell,
                    l.rms,
                    l.arm_saturated,
                    l.saturated_ever,
                    l.others,
                    l.margin,
                    l.speed,
                    l.chatter,
                    l.over,
                    l.handed
                );
            }
        }
    }
}
