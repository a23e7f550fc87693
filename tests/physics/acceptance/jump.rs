//! Goal: a figure that pushes itself off the floor flies on a parabola and lands without gaining energy. Method: a
//! motion that crouches, stretches until the pelvis rises at 1.5 m/s, holds its posture for the resulting flight of 0.3
//! s, and yields on landing.

use super::{GRAVITY, integrals};
use crate::common::{Scene, figure, man, on_floor, play};
use sinew_physics::body::angles::set_anatomical_angles;
use sinew_physics::body::topology::DOF_NAMES;
use sinew_physics::body::{Body, DOF_COUNT, Posture};
use sinew_physics::figure::{ControllerKind, Flags, StepperKind};
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::motion::Clip;
use sinew_physics::world::WorldParams;
use std::sync::Arc;

/// Time in the air, s.
const FLIGHT: f64 = 0.3;
/// Bend of the legs (hip and ankle; the knee twice that) standing, crouched, and stretched for the leap, rad.
const BENDS: [f64; 3] = [0.25, 0.85, 0.35];
/// Duration of crouching, waiting, pushing off, yielding, and rising, s.
const TIMES: [f64; 5] = [0.8, 0.3, 0.45, 0.45, 0.8];
/// Time over which the effect of touch-down on the energy is measured, s: within one tick, muscles may supply more than
/// the floor absorbs.
const LANDING: f64 = 0.1;
/// Factor on its strength: the jumper is an athlete.
const STRENGTH: f64 = 3.0;
/// The pelvis rises faster than the body before it pulls the resting feet along.
const PULL: f64 = 1.4;
const RATE: f64 = 240.0;

/// Part of the bend by which the trunk leans forward, so that the weight stays over the feet.
const LEAN: f64 = 0.45;

/// Bent legs, leaning trunk, soles flat.
fn bent(body: &Body, bend: f64) -> Posture {
    let mut angles = [0.0; DOF_COUNT];
    for (joint, angle) in [
        ("hip_flexion", (1.0 + LEAN) * bend),
        ("knee_flexion", 2.0 * bend),
        ("ankle_flexion", bend),
        ("elbow_flexion", 0.3),
    ] {
        for side in ["l", "r"] {
            let name = format!("{side}_{joint}");
            angles[DOF_NAMES.iter().position(|n| *n == name).unwrap()] = angle;
        }
    }
    let mut posture = Posture::default();
    set_anatomical_angles(&mut posture, &angles);
    posture.root_rotation = Quat::exp(Vec3::Y * (LEAN * bend));
    on_floor(body, &mut posture);
    posture
}

/// Quintic from `a` at speed `va` to `b` at speed `vb` in `t` seconds, without acceleration at the ends; `u` = 0…1.
fn ease((a, va): (f64, f64), (b, vb): (f64, f64), t: f64, u: f64) -> f64 {
    let (d, p, q) = (b - a, va * t, vb * t);
    let (u2, u3) = (u * u, u * u * u);
    a + p * u
        + u3 * (10.0 * d - 6.0 * p - 4.0 * q)
        + u3 * u * (-15.0 * d + 8.0 * p + 7.0 * q)
        + u3 * u2 * (6.0 * d - 3.0 * (p + q))
}

/// The motion, and its time of take-off, s.
fn leap(body: &Body) -> (Arc<Clip>, f64) {
    let height = |b: f64| bent(body, b).root_position.z;
    let [stand, crouch, stretch] = BENDS.map(height);
    let speed = 0.5 * GRAVITY * FLIGHT;
    let bend_of = |z: f64| {
        let (mut low, mut high) = (0.0, 1.2);
        for _ in 0..50 {
            let mid = 0.5 * (low + high);
            if height(mid) > z {
                low = mid;
            } else {
                high = mid;
            }
        }
        0.5 * (low + high)
    };
    let still = 0.5;
    let starts = {
        let mut t = still;
        let mut out = vec![t];
        for d in [TIMES[0], TIMES[1], TIMES[2], FLIGHT, TIMES[3], TIMES[4]] {
            t += d;
            out.push(t);
        }
        out
    };
    let (mut postures, mut planted) = (Vec::new(), Vec::new());
    let n = ((starts[6] + 1.0) * RATE) as usize;
    for i in 0..n {
        let t = i as f64 / RATE;
        let u = |k: usize, d: f64| ((t - starts[k]) / d).clamp(0.0, 1.0);
        let (z, lift) = if t < starts[2] {
            (ease((stand, 0.0), (crouch, 0.0), 1.0, u(0, TIMES[0])), 0.0)
        } else if t < starts[3] {
            let u = u(2, TIMES[2]);
            (
                ease((crouch, 0.0), (stretch, PULL * speed), TIMES[2], u),
                0.0,
            )
        } else if t < starts[4] {
            let s = t - starts[3];
            (stretch, speed * s - 0.5 * GRAVITY * s * s)
        } else if t < starts[5] {
            let u = u(4, TIMES[3]);
            (ease((stretch, -speed), (crouch, 0.0), TIMES[3], u), 0.0)
        } else {
            (ease((crouch, 0.0), (stand, 0.0), 1.0, u(5, TIMES[4])), 0.0)
        };
        let mut posture: Posture = bent(body, bend_of(z));
        posture.root_position.z += lift;
        postures.push(posture);
        planted.push([lift <= 0.0; 2]);
    }
    let clip = Clip::from_postures("leap", RATE, postures, planted).unwrap();
    (Arc::new(clip), starts[3])
}

/// Performs one leap at 240 Hz and returns whether it ends in a fall. `allowed`: largest distance from the parabola, m.
fn leaps(kind: ControllerKind, stepper: StepperKind, allowed: f64) -> bool {
    let rate_hz = 240.0;
    let body = man();
    let (clip, off) = leap(&body);
    let first = clip.sample(0.0);
    let mut setup = figure(&body, kind, first.state());
    setup.stepper = stepper;
    setup.strength.all = STRENGTH;
    let params = WorldParams {
        rate_hz,
        ..WorldParams::default()
    };
    let mut scene = Scene::with(params, setup);
    scene.figure_mut().set_drive(play(&clip));
    // Semi-implicit steps: one per tick, or two substeps.
    let step = match stepper {
        StepperKind::Kinematic | StepperKind::Staged => 1.0 / rate_hz,
        StepperKind::Torque => 0.5 / rate_hz,
    };
    let (mut start, mut air, mut path, mut spun) = (None, 0.0, 0.0f64, 0.0f64);
    let (mut top, mut fell, mut last) = (0.0f64, false, 0.0);
    let (mut down, mut landed) = (None, None::<f64>);
    scene.run(clip.duration(), |s| {
        let r = s.figure().report().unwrap();
        let now = integrals(s.figure().links(), s.figure().state());
        let t = s.world.time().0;
        fell |= s.figure().is_fallen();
        let flies = r.flags.has(Flags::FLIGHT) && r.contacts.is_empty() && t > off - 0.1;
        if flies && down.is_none() {
            let (t0, c0, p0, l0) =
                *start.get_or_insert((t, now.com, now.momentum.linear, now.momentum.angular));
            air = t - t0 + 1.0 / rate_hz;
            let s = t - t0;
            let v = p0 * (1.0 / 75.0);
            // The sum of the speeds of semi-implicit steps.
            let parabola = c0 + v * s - Vec3::Z * (0.5 * GRAVITY * s * (s + step));
            path = path.max((now.com - parabola).norm());
            spun = spun.max((now.momentum.angular - l0).norm());
            top = top.max(now.com.z - c0.z);
        } else if air > 0.1 && landed.is_none() {
            let (since, energy) = *down.get_or_insert((t, last));
            if t > since + LANDING {
                landed = Some(now.energy - energy);
            }
        }
        last = now.energy;
    });
    let landed = landed.expect("it comes down");
    let text = format!(
        "{kind:?} {stepper:?}: {air:.3} s in the air, {top:.3} m up, path {:.2} mm, spin {spun:.1e} kg·m²/s, energy \
         {landed:+.2} J on landing, fell {fell}",
        1e3 * path
    );
    println!("{text}");
    assert!(air > 0.2, "{text}");
    assert!(path < allowed, "{text}");
    assert!(spun < 0.15, "{text}");
    assert!(landed < 0.0, "{text}");
    fell
}

/// The error of the steps comes from moving limbs and halves with the step size (`flight.rs` shows that it tends to
/// zero).
#[test]
fn leaps_follow_the_parabola_and_land_without_gaining_energy() {
    let fell = leaps(ControllerKind::Modern, StepperKind::Torque, 1e-3);
    assert!(!fell, "it lands on its feet");
    leaps(ControllerKind::Paper, StepperKind::Torque, 1.5e-3);
    leaps(ControllerKind::Paper, StepperKind::Kinematic, 3e-3);
}
