//! Goal: in the air nothing but gravity acts on a figure, whatever its motors do; without torque it gains no energy anywhere.
//! Method: the parabola and both momenta of a thrown figure, with the order at which they converge; energy of a limp one, tick by tick.

use crate::common::{Scene, authored, bent, figure, man, still};
use crate::{GRAVITY, integrals, vec3};
use sinew::sim::body::angles::anatomical_angles;
use sinew::sim::body::{DOF_COUNT, Links, State};
use sinew::sim::dynamics::Terms;
use sinew::sim::figure::torque_step::{MotorCommand, StepInput, Stepper, TorqueStepper};
use sinew::sim::figure::{ControllerKind, Flags, StrengthScale};
use sinew::sim::math::{Quat, Vec3};
use sinew::sim::strength::Strength;
use sinew::sim::world::WorldParams;

/// Thrown up and tumbling.
fn thrown() -> State {
    let body = man();
    let mut state = still(bent(&body, 0.4));
    state.posture.root_position.z += 1.0;
    state.posture.root_rotation = Quat::exp(vec3(0.2, -0.1, 0.3));
    state.velocity[..6].copy_from_slice(&[0.8, 1.5, 0.4, 0.6, -0.3, 2.0]);
    state
}

/// Largest distance from the parabola (m) and change of the momenta, relative, within 0.3 s.
fn flight(substeps: u32, moving: bool) -> [f64; 3] {
    let body = man();
    let state = thrown();
    let params = WorldParams {
        substeps,
        ..WorldParams::default()
    };
    let mut scene = Scene::with(params, figure(&body, ControllerKind::Motors, state));
    if moving {
        // Limbs swing towards another posture: torques act, momenta may not notice.
        let other = authored(&body, "wave").sample(2.0).posture;
        scene
            .figure_mut()
            .set_drive(sinew::sim::world::Drive::Hold(other));
    }
    let links = scene.figure().links().clone();
    let start = integrals(&links, &state);
    let mass = links.total_mass();
    let p0 = start.momentum.linear;
    let mut worst = [0.0f64; 3];
    scene.run(0.3, |s| {
        let t = s.world.time();
        assert!(s.figure().report().unwrap().flags.has(Flags::FLIGHT));
        let now = integrals(&links, s.figure().state());
        let com = start.com + p0 * (t / mass) - Vec3::Z * (0.5 * GRAVITY * t * t);
        let p = p0 - Vec3::Z * (mass * GRAVITY * t);
        let spin = (now.momentum.angular - start.momentum.angular).norm();
        worst[0] = worst[0].max((now.com - com).norm());
        worst[1] = worst[1].max((now.momentum.linear - p).norm() / p0.norm());
        worst[2] = worst[2].max(spin / start.momentum.angular.norm());
    });
    worst
}

#[test]
fn a_thrown_figure_keeps_parabola_and_momenta() {
    for moving in [false, true] {
        let errors = [1, 2, 4, 8, 16].map(|substeps| (substeps, flight(substeps, moving)));
        for (substeps, e) in errors {
            println!(
                "moving {moving}, {substeps} substeps: parabola {:.3e} m, momentum {:.3e}, angular momentum {:.3e}",
                e[0], e[1], e[2]
            );
        }
    }
}

/// Steps a body whose motors give a millionth of a millionth of its strength; returns energies after each tick, and how often
/// it touched the ground.
fn limp(start: &State, seconds: f64, rate_hz: f64, substeps: u32) -> (Vec<f64>, usize) {
    let body = man();
    let (links, strength) = (Links::new(&body), Strength::for_body(&body));
    let scale = StrengthScale {
        all: 1e-12,
        ..StrengthScale::default()
    };
    let (mut stepper, mut terms) = (TorqueStepper::new(0.9), Terms::default());
    let command = MotorCommand {
        acceleration: [0.0; DOF_COUNT],
        torque: [0.0; DOF_COUNT],
        saturation_speed: 1.0,
    };
    let mut state = *start;
    let mut energies = vec![integrals(&links, &state).energy];
    let mut touched = 0;
    for _ in 0..(seconds * rate_hz).round() as usize {
        terms.compute(&links, &state, &[], GRAVITY);
        let rates: [f64; DOF_COUNT] = std::array::from_fn(|j| state.velocity[6 + j]);
        let (mut lower, mut upper) = ([0.0; DOF_COUNT], [0.0; DOF_COUNT]);
        strength.range(
            &anatomical_angles(&state.posture),
            &rates,
            &scale,
            &mut lower,
            &mut upper,
        );
        let input = StepInput {
            body: &body,
            links: &links,
            strength: &strength,
            scale: &scale,
            terms: &terms,
            command: &command,
            lower: &lower,
            upper: &upper,
            applied: &[],
            gravity: GRAVITY,
            dt: 1.0 / rate_hz,
            substeps,
        };
        stepper.step(&input, &mut state);
        touched += usize::from(!stepper.forces.contact.is_empty());
        energies.push(integrals(&links, &state).energy);
    }
    (energies, touched)
}

#[test]
fn a_limp_figure_gains_no_energy() {
    let body = man();
    let standing = still(bent(&body, 0.3));
    let mut dropped = thrown();
    dropped.velocity[5] = 0.0;
    for (name, state) in [("collapse", standing), ("drop", dropped)] {
        for substeps in [2, 4, 8] {
            let (energies, touched) = limp(&state, 3.0, 60.0, substeps);
            let rise = energies
                .windows(2)
                .map(|w| w[1] - w[0])
                .fold(f64::MIN, f64::max);
            let above = energies
                .iter()
                .fold(f64::MIN, |m, e| m.max(e - energies[0]));
            println!(
                "{name} × {substeps}: {:.1} J → {:.1} J, largest rise of a tick {rise:.3e} J, above start {above:.3e} J, touched {touched}",
                energies[0],
                energies.last().unwrap()
            );
        }
    }
}
