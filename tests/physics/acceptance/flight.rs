//! Goal: in the air nothing but gravity acts on a figure, whatever its motors do; without torque it gains no energy
//! anywhere. Method: the parabola and both momenta of a thrown figure, with the order at which they converge; energy of
//! a limp one, tick by tick.

use super::{GRAVITY, integrals, vec3};
use crate::acceptance::bare::Bare;
use crate::common::{Scene, authored, bent, figure, man, still};
use sinew_physics::body::angles::{anatomical_angles, swings};
use sinew_physics::body::topology::{
    DOF_START, JOINT, Joint, L_FOREARM, L_SHANK, R_FOREARM, R_SHANK,
};
use sinew_physics::body::{DOF_COUNT, Links, Posture, State};
use sinew_physics::contact::Tissue;
use sinew_physics::dynamics::Terms;
use sinew_physics::figure::{ControllerKind, Flags};
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::strength::Strength;
use sinew_physics::world::WorldParams;

/// Thrown up and tumbling.
fn thrown() -> State {
    let body = man();
    let mut state = still(bent(&body, 0.4));
    state.posture.root_position.z += 1.0;
    state.posture.root_rotation = Quat::exp(vec3(0.2, -0.1, 0.3));
    state.velocity[..6].copy_from_slice(&[0.8, 1.5, 0.4, 0.6, -0.3, 2.0]);
    state
}

/// Largest distances within 0.3 s from the parabola and from its semi-implicit Euler counterpart (m), and relative
/// changes of linear and angular momentum.
fn flight(substeps: u32, moving: bool) -> [f64; 4] {
    let body = man();
    let state = thrown();
    let params = WorldParams {
        substeps,
        ..WorldParams::default()
    };
    let mut scene = Scene::with(params, figure(&body, ControllerKind::Motors, state));
    if moving {
        // Limbs swing towards another posture, so torques act, but momenta must not change.
        let other = authored(&body, "wave").sample(2.0).posture;
        scene
            .figure_mut()
            .set_drive(sinew_physics::world::MotionSource::Hold(other));
    }
    let links = scene.figure().links().clone();
    let start = integrals(&links, &state);
    let mass = links.total_mass();
    let p0 = start.momentum.linear;
    let h = scene.world.dt() / f64::from(substeps);
    let mut worst = [0.0f64; 4];
    scene.run(0.3, |s| {
        let t = s.world.time().0;
        assert!(s.figure().report().unwrap().flags.has(Flags::FLIGHT));
        let now = integrals(&links, s.figure().state());
        let com = start.com + p0 * (t / mass) - Vec3::Z * (0.5 * GRAVITY * t * t);
        let stepped = com - Vec3::Z * (0.5 * GRAVITY * t * h); // the sum of its speeds
        let p = p0 - Vec3::Z * (mass * GRAVITY * t);
        let spin = (now.momentum.angular - start.momentum.angular).norm();
        worst[0] = worst[0].max((now.com - com).norm());
        worst[1] = worst[1].max((now.com - stepped).norm());
        worst[2] = worst[2].max((now.momentum.linear - p).norm() / p0.norm());
        worst[3] = worst[3].max(spin / start.momentum.angular.norm());
    });
    worst
}

/// Steps are first order, so errors halve with the substep and two of them tell the limit: there the conservation laws
/// are exact. How far the default substep is from it is bounded too (MuJoCo's Euler at half the step: 5e-4 and 4e-3
/// within 0.5 s).
#[test]
fn a_thrown_figure_keeps_parabola_and_momenta() {
    for moving in [false, true] {
        let errors = [2, 4, 8, 16].map(|substeps| flight(substeps, moving));
        for (i, what) in [
            "parabola, m",
            "stepped parabola, m",
            "momentum",
            "angular momentum",
        ]
        .into_iter()
        .enumerate()
        {
            let e = errors.map(|e| e[i]);
            let limit = (2.0 * e[3] - e[2]).abs();
            let text = format!("moving {moving}, {what}: {e:?} → {limit:.1e}");
            println!("{text}");
            for pair in e.windows(2) {
                let ratio = pair[0] / pair[1];
                assert!((1.9..2.1).contains(&ratio), "{text}");
            }
            assert!(limit < 2e-3 * e[0], "{text}");
        }
        let [_, stepped, linear, angular] = errors[0];
        assert!(
            stepped < 1e-3 && linear < 2e-3 && angular < 5e-3,
            "{:?}",
            errors[0]
        );
    }
}

/// Measurements of a figure without strength.
struct Limp {
    /// Energy before the first tick and after each tick, J.
    energy: Vec<f64>,
    /// The part of it that stretched tissue stores.
    stored: Vec<f64>,
    /// Largest work of contacts and ligaments in one step, beyond the correction of a penetration at its bounded pace,
    /// J.
    pushed: f64,
    /// Total work that corrected penetrations, J.
    returned: f64,
    /// Largest difference between the ligament torque that a controller expects and that in the first step, N·m.
    unforeseen: f64,
    /// Ticks on the ground.
    touched: usize,
}

/// Steps a body whose motors have 10⁻¹² of its strength, for 3 s, with one substep per tick, so that every step is
/// visible.
fn limp(start: &State, rate_hz: f64, gravity: f64) -> Limp {
    let dt = 1.0 / rate_hz;
    let body = man();
    let (links, strength) = (Links::new(&body), Strength::for_body(&body));
    let mut bare = Bare::new(man(), 1e-12, gravity, dt);
    let (mut before, mut terms) = (Terms::default(), Terms::default());
    let mut state = *start;
    // Stretched tissue stores some.
    let stored = |s: &State| strength.stored(&anatomical_angles(&s.posture));
    let total = |s: &State| {
        let all = integrals(&links, s);
        let lighter = links.total_mass() * (GRAVITY - gravity) * all.com.z;
        all.energy - lighter + stored(s)
    };
    let mut out = Limp {
        energy: vec![total(&state)],
        stored: vec![stored(&state)],
        pushed: f64::MIN,
        returned: 0.0,
        unforeseen: 0.0,
        touched: 0,
    };
    for _ in 0..(3.0 * rate_hz) as usize {
        let tissue = Tissue::new(&strength, (&state, &swings(&state.posture)), 1, dt);
        bare.step(&mut state, Some(&tissue));
        let a = &bare.stepper.forces.audit;
        // Work of the constraint forces along the displacement for which they were solved.
        let after = State {
            posture: a.state.posture,
            velocity: state.velocity,
        };
        terms.compute(&links, &after, &[], gravity);
        let ligaments: f64 = (0..DOF_COUNT)
            .map(|d| a.ligament_torque[d] * state.velocity[6 + d])
            .sum();
        let (mut contacts, mut returns) = (0.0, 0.0);
        before.compute(&links, &a.state, &[], gravity);
        for c in &a.contacts {
            let s = c.segment.index();
            let point = body.segments[s].contact_points[c.vertex];
            contacts += c.force.dot(terms.point_velocity(s, point));
            // A resting point is held in its place, because its path bends while the limbs turn.
            if before.point_velocity(s, point).norm() < 0.1 {
                contacts += c.force.dot(before.point_bias(s, point)) * (0.5 * dt);
            }
            // Each step corrects a fifth of the depth beyond 0.1 mm.
            returns += c.force.z * 0.2 * (-c.position.z - 1e-4).max(0.0) / dt;
        }
        let released = stored(&State { ..after }) - stored(&state);
        out.returned += dt * returns;
        out.pushed = out
            .pushed
            .max(dt * (ligaments + contacts - returns) - released);
        if out.energy.len() == 1 {
            let foreseen = tissue.at(&a.acceleration[6..]);
            let off = foreseen.iter().zip(&a.ligament_torque);
            out.unforeseen = off.fold(0.0, |m, (x, y)| m.max((x - y).abs()));
        }
        out.touched += usize::from(!a.contacts.is_empty());
        out.energy.push(total(&state));
        out.stored.push(stored(&state));
    }
    out
}

/// Contacts and ligaments remove energy, except for the small work that corrects a penetration; the correction of an
/// overrun limit per step is bounded. A step may still end with slightly more energy than at its start, because steps
/// of fast limbs are first order. That is bounded too, and the energy stays below its initial value.
#[test]
fn a_limp_figure_gains_no_energy() {
    let body = man();
    let standing = still(bent(&body, 0.3));
    let mut dropped = thrown();
    dropped.velocity[5] = 0.0;
    for (name, state) in [("collapse", standing), ("drop", dropped)] {
        for rate_hz in [120.0, 240.0, 480.0] {
            let Limp {
                energy,
                pushed,
                returned,
                touched,
                ..
            } = limp(&state, rate_hz, GRAVITY);
            let (first, last) = (energy[0], *energy.last().unwrap());
            let rise = energy
                .windows(2)
                .map(|w| w[1] - w[0])
                .fold(f64::MIN, f64::max);
            let text = format!(
                "{name} at {rate_hz} Hz: {first:.1} J → {last:.1} J, largest rise of a tick {rise:.2e} J, pushed in \
                 {pushed:.2e} J, {returned:.2} J for penetrations, on the ground {touched} ticks"
            );
            println!("{text}");
            assert!(energy[1..].iter().all(|e| *e < first), "{text}");
            assert!(rise < 0.01 * first, "{text}");
            assert!(pushed < 1e-7 * first, "{text}");
            assert!(returned < 1e-3 * first, "{text}");
            assert!(last < 0.2 * first && touched > 200, "{text}");
        }
    }
}

/// Weightless, limp, and bent to the limits of its joints: the energy stored in tissue becomes motion, except for
/// internal friction, and no step gains energy.
#[test]
fn stretched_tissue_gives_back_no_more_than_it_stored() {
    let body = man();
    let mut state = still(Posture::default());
    state.posture.root_position.z = 5.0;
    for s in [L_FOREARM, R_FOREARM, L_SHANK, R_SHANK].map(|s| s.index()) {
        if let Joint::Hinge1(i) | Joint::Hinge2(i) = JOINT[s] {
            state.posture.hinge[i] = body.upper[DOF_START[s]] - 0.02;
        }
    }
    let mut kept = Vec::new();
    for rate_hz in [120.0, 480.0, 1920.0] {
        let Limp {
            energy,
            stored,
            unforeseen,
            ..
        } = limp(&state, rate_hz, 0.0);
        assert!(unforeseen < 1e-2, "{unforeseen} N·m");
        let rise = energy
            .windows(2)
            .map(|w| w[1] - w[0])
            .fold(f64::MIN, f64::max);
        let slack = stored.iter().position(|v| *v < 0.05 * stored[0]).unwrap();
        let moving = energy[slack] - stored[slack];
        kept.push(moving / stored[0]);
        println!(
            "{rate_hz} Hz: {:.1} J stored, {moving:.1} J of motion after {:.0} ms, largest rise of a step {rise:.1e} J",
            stored[0],
            1e3 * slack as f64 / rate_hz
        );
        assert!(stored[0] > 1.0);
        assert!(rise < 1e-3 * stored[0], "{rise} J");
    }
    assert!(kept.iter().all(|k| *k < 0.951), "{kept:?}");
    assert!(
        kept[2] > 0.8 && kept[2] > kept[1] && kept[1] > kept[0],
        "{kept:?}"
    );
}
