//! Goal: a load is inertia of the segment that holds it: it weighs, it has to be accelerated when taken, and it is gone when dropped.
//! Method: statics of a stretched arm; conservation of momentum in weightless flight.

use crate::common::{Scene, authored, bent, figure, man, still};
use crate::{GRAVITY, integrals};
use sinew::evaluate::audit::inertial_forces;
use sinew::evaluate::pose::segment_poses;
use sinew::sim::body::angles::{anatomical_angles, set_anatomical_angles};
use sinew::sim::body::topology::{DOF_NAMES, R_FOREARM, R_HAND, R_UPPER_ARM};
use sinew::sim::body::{NV, Posture};
use sinew::sim::figure::{ControllerKind, FigureEvent, Perturbation};
use sinew::sim::math::Vec3;
use sinew::sim::world::WorldParams;

const KG: f64 = 3.0;
const GRIP: Vec3 = Vec3 {
    x: 0.0,
    y: 0.0,
    z: -0.08,
};

fn load(from: f64, to: f64) -> Perturbation {
    Perturbation::Load {
        segment: R_HAND,
        point: GRIP,
        mass: KG,
        from,
        to,
    }
}

fn dof(name: &str) -> usize {
    DOF_NAMES.iter().position(|n| *n == name).unwrap()
}

/// Standing at ease, the right upper arm hanging and the forearm level.
fn forearm_level() -> Posture {
    let body = man();
    let mut posture = authored(&body, "idle").posture(0).to_owned();
    let mut angles = anatomical_angles(&posture);
    angles[dof("r_shoulder_flexion")] = 0.2;
    angles[dof("r_elbow_flexion")] = 1.4;
    set_anatomical_angles(&mut posture, &angles);
    posture
}

fn holds_by_statics(kind: ControllerKind) {
    let body = man();
    let run = |kg: bool| {
        let mut scene = Scene::of(figure(&body, kind, still(forearm_level())));
        if kg {
            scene
                .world
                .perturb(scene.key, load(f64::NEG_INFINITY, f64::INFINITY))
                .unwrap();
        }
        scene.run(5.0, |_| ());
        scene
    };
    let (free, loaded) = (run(false), run(true));
    assert!(!loaded.figure().is_fallen());
    // Every joint of the arm against the weights beyond it, from Newton–Euler at rest.
    let f = loaded.figure();
    let statics = inertial_forces(f.links(), &still(f.state().posture), &[0.0; NV], GRAVITY);
    let r = f.report().unwrap();
    for d in dof("r_shoulder_flexion")..=dof("r_wrist_deviation") {
        let (got, want) = (r.torque[d] + r.ligament_torque[d], statics[6 + d]);
        println!("{kind:?} {}: {got:.4} N·m, statics {want:.4}", DOF_NAMES[d]);
        assert!(
            (got - want).abs() < 0.02,
            "{kind:?} {}: {got} against {want}",
            DOF_NAMES[d]
        );
    }
    // What the load alone adds at shoulder and elbow: its weight times its lever.
    let poses = segment_poses(&f.links().offset, &f.state().posture);
    let held = poses[R_HAND.index()].point(GRIP);
    let without = free.figure().report().unwrap();
    for (name, joint) in [
        ("r_shoulder_flexion", R_UPPER_ARM),
        ("r_elbow_flexion", R_FOREARM),
    ] {
        let arm = held - poses[joint.index()].position;
        let want = KG * GRAVITY * arm.x; // the joints flex about −y
        let got = r.torque[dof(name)] - without.torque[dof(name)];
        println!("{kind:?} {name}: load adds {got:.3} N·m, lever says {want:.3}");
        assert!(
            (got - want).abs() < 0.03 * want,
            "{kind:?} {name}: {got} against {want}"
        );
    }
}

#[test]
fn holding_a_load_takes_the_torque_of_statics() {
    holds_by_statics(ControllerKind::Modern);
    holds_by_statics(ControllerKind::Paper);
}

#[test]
fn a_load_taken_in_motion_conserves_momentum_and_dropping_it_changes_nothing() {
    let body = man();
    let mut state = still(bent(&body, 0.4));
    state.posture.root_position.z += 2.0;
    state.velocity[..6].copy_from_slice(&[0.5, 1.0, 2.0, 1.5, 0.4, 0.2]);
    state.velocity[6 + dof("r_shoulder_flexion")] = 3.0;
    let params = WorldParams {
        rate_hz: 1000.0,
        substeps: 16,
        gravity: 0.0,
        ..WorldParams::default()
    };
    let mut scene = Scene::with(params, figure(&body, ControllerKind::Motors, state));
    scene.world.perturb(scene.key, load(0.01, 0.02)).unwrap();
    let kinetic = |s: &Scene| {
        let f = s.figure();
        let i = integrals(f.links(), f.state());
        let about_origin = i.momentum.angular + i.com.cross(i.momentum.linear);
        let energy = i.energy - f.links().total_mass() * GRAVITY * i.com.z;
        (i.momentum.linear, about_origin, energy)
    };
    let step_until = |scene: &mut Scene, wanted: fn(&FigureEvent) -> bool| loop {
        let before = (kinetic(scene), *scene.figure().state());
        scene.world.step();
        assert!(scene.world.time() < 0.05, "the event is due");
        if scene.figure().events().iter().any(wanted) {
            return before;
        }
    };
    let mass = body.profile.mass;

    let ((p, l, e), _) = step_until(&mut scene, |e| matches!(e, FigureEvent::LoadTaken { .. }));
    assert!((scene.figure().links().total_mass() - mass - KG).abs() < 1e-12);
    let (p1, l1, e1) = kinetic(&scene);
    let (dp, dl) = ((p1 - p).norm() / p.norm(), (l1 - l).norm() / l.norm());
    println!(
        "taken: momentum {dp:.2e}, angular momentum {dl:.2e}, energy {:.4} → {:.4} J",
        e, e1
    );
    assert!(
        dp < 1e-6 && dl < 1e-6,
        "momentum: {dp:e}, angular momentum: {dl:e}"
    );
    assert!(
        e1 < e - 0.1,
        "a load that was at rest takes energy: {e} → {e1} J"
    );

    let (_, before) = step_until(&mut scene, |e| matches!(e, FigureEvent::LoadDropped { .. }));
    assert!((scene.figure().links().total_mass() - mass).abs() < 1e-12);
    let now = scene.figure().state();
    let jump = (0..NV)
        .map(|i| (now.velocity[i] - before.velocity[i]).abs())
        .fold(0.0, f64::max);
    println!("dropped: largest change of a rate {jump:.2e}");
    assert!(
        jump < 0.2,
        "dropping changes forces, not velocities: {jump}"
    );
}

#[test]
fn a_dropped_load_is_forgotten() {
    for kind in [ControllerKind::Modern, ControllerKind::Paper] {
        let body = man();
        let mut scene = Scene::of(figure(&body, kind, still(forearm_level())));
        scene.run(2.0, |_| ());
        let before = scene.figure().report().unwrap().clone();
        let now = scene.world.time();
        scene
            .world
            .perturb(scene.key, load(now, now + 1.0))
            .unwrap();
        scene.run(0.9, |_| ());
        let carried: f64 = scene
            .figure()
            .report()
            .unwrap()
            .contacts
            .iter()
            .map(|c| c.force.z)
            .sum();
        let want = (body.profile.mass + KG) * GRAVITY;
        assert!(
            (carried - want).abs() < 0.01 * want,
            "{kind:?}: {carried} N on the ground, {want} N held"
        );
        scene.run(4.0, |_| ());
        let after = scene.figure().report().unwrap();
        assert!(!scene.figure().is_fallen() && scene.figure().perturbations().count() == 0);
        for d in dof("r_shoulder_flexion")..=dof("r_wrist_deviation") {
            let off = (after.torque[d] - before.torque[d]).abs();
            assert!(
                off < 0.05,
                "{kind:?} {}: {off} N·m from before",
                DOF_NAMES[d]
            );
        }
        let moved = after.com - before.com;
        println!(
            "{kind:?}: centre of mass {:.2e} m from before",
            moved.norm()
        );
        assert!(moved.norm() < 2e-3, "{kind:?}: {} m", moved.norm());
    }
}
