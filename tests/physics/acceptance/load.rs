//! Goal: a load is inertia of the segment that holds it: it weighs, it has to be accelerated when taken, and it is gone
//! when dropped. Method: statics of a stretched arm; conservation of momentum in weightless flight.

use super::{GRAVITY, integrals};
use crate::common::{Scene, authored, bent, figure, man, still};
use sinew_evaluate::audit::inertial_forces;
use sinew_evaluate::pose::segment_poses;
use sinew_physics::body::angles::{anatomical_angles, set_anatomical_angles};
use sinew_physics::body::topology::{DOF_NAMES, L_HAND, R_FOREARM, R_HAND, R_UPPER_ARM};
use sinew_physics::body::{NV, Posture};
use sinew_physics::figure::{ControllerKind, FigureEvent, HeldLoad, Perturbation};
use sinew_physics::math::Vec3;
use sinew_physics::world::WorldParams;

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
        let (got, want) = (
            r.joints.torque[d] + r.joints.ligament_torque[d],
            statics[6 + d],
        );
        println!("{kind:?} {}: {got:.4} N·m, statics {want:.4}", DOF_NAMES[d]);
        assert!(
            (got - want).abs() < 0.02,
            "{kind:?} {}: {got} against {want}",
            DOF_NAMES[d]
        );
    }
    // The load alone adds its weight times its lever at shoulder and elbow.
    let poses = segment_poses(&f.links().offset, &f.state().posture);
    let held = poses[R_HAND.index()].point(GRIP);
    let without = free.figure().report().unwrap();
    for (name, joint) in [
        ("r_shoulder_flexion", R_UPPER_ARM),
        ("r_elbow_flexion", R_FOREARM),
    ] {
        let arm = held - poses[joint.index()].position;
        let want = KG * GRAVITY * arm.x; // the joints flex about −y
        let got = r.joints.torque[dof(name)] - without.joints.torque[dof(name)];
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
        assert!(scene.world.time().0 < 0.05, "the event is due");
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
        let now = scene.world.time().0;
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
            let off = (after.joints.torque[d] - before.joints.torque[d]).abs();
            assert!(
                off < 0.05,
                "{kind:?} {}: {off} N·m from before",
                DOF_NAMES[d]
            );
        }
        let moved = after.balance.com - before.balance.com;
        println!(
            "{kind:?}: centre of mass {:.2e} m from before",
            moved.norm()
        );
        assert!(moved.norm() < 2e-3, "{kind:?}: {} m", moved.norm());
    }
}

fn held(mass: f64) -> HeldLoad {
    HeldLoad {
        segment: R_HAND,
        point: GRIP,
        mass,
        velocity: Vec3::zero(),
        second: None,
        grip: f64::INFINITY,
        from: 0.01,
        to: f64::INFINITY,
    }
}

/// A 2 kg ball flies into one hand or between both: the ball's momentum passes to the figure.
#[test]
fn a_flying_load_gives_its_momentum_to_who_catches_it() {
    for second in [None, Some((L_HAND, GRIP))] {
        let body = man();
        let mut state = still(bent(&body, 0.4));
        state.posture.root_position.z += 2.0;
        state.velocity[..6].copy_from_slice(&[0.5, 1.0, 2.0, 1.5, 0.4, 0.2]);
        let params = WorldParams {
            rate_hz: 1000.0,
            substeps: 16,
            gravity: 0.0,
            ..WorldParams::default()
        };
        // Weak muscles and a slow ball: the tick also integrates the motion after the catch, which conserves momentum
        // only to the order of the step.
        let mut setup = figure(&body, ControllerKind::Motors, state);
        setup.strength.all = 0.1;
        let mut scene = Scene::with(params, setup);
        let velocity = Vec3 {
            x: -2.0,
            y: 0.4,
            z: -0.7,
        };
        let load = HeldLoad {
            velocity,
            second,
            ..held(2.0)
        };
        scene
            .world
            .perturb(scene.key, Perturbation::Held(load))
            .unwrap();
        let momenta = |s: &Scene| {
            let f = s.figure();
            let i = integrals(f.links(), f.state());
            let l = i.momentum.angular + i.com.cross(i.momentum.linear);
            (i.momentum.linear, l)
        };
        loop {
            let before = momenta(&scene);
            let posture = scene.figure().state().posture;
            scene.world.step();
            assert!(scene.world.time().0 < 0.05);
            let taken = |e: &FigureEvent| matches!(e, FigureEvent::LoadTaken { .. });
            if !scene.figure().events().iter().any(taken) {
                continue;
            }
            let poses = segment_poses(&body.joint_offset, &posture);
            let (mut p, mut l) = before;
            for (segment, point, kg) in load.shares() {
                p += velocity * kg;
                l += poses[segment.index()].point(point).cross(velocity * kg);
            }
            let after = momenta(&scene);
            let (dp, dl) = (
                (after.0 - p).norm() / p.norm(),
                (after.1 - l).norm() / l.norm(),
            );
            println!("caught: momentum {dp:.1e}, angular momentum {dl:.1e}");
            assert!(dp < 1e-6 && dl < 1e-6, "{dp:e} {dl:e}");
            break;
        }
    }
}

#[test]
fn two_hands_keep_their_distance_on_one_load_and_share_it() {
    for kind in [ControllerKind::Modern, ControllerKind::Paper] {
        let body = man();
        let clip = authored(&body, "squat");
        let mut scene = Scene::playing(&body, kind, &clip);
        let load = HeldLoad {
            second: Some((L_HAND, GRIP)),
            from: f64::NEG_INFINITY,
            ..held(6.0)
        };
        scene
            .world
            .perturb(scene.key, Perturbation::Held(load))
            .unwrap();
        // One hand is pulled away: the other has to follow.
        let pull = Perturbation::Force {
            segment: L_HAND,
            point: GRIP,
            force: Vec3::Y * 60.0,
            from: 1.0,
            to: 2.0,
        };
        scene.world.perturb(scene.key, pull).unwrap();
        let span = |s: &Scene| {
            let f = s.figure();
            let poses = segment_poses(&f.links().offset, &f.state().posture);
            (poses[L_HAND.index()].point(GRIP) - poses[R_HAND.index()].point(GRIP)).norm()
        };
        let first = span(&scene);
        let (mut off, mut pulled, mut residual) = (0.0f64, 0.0f64, 0.0f64);
        scene.run(clip.duration(), |s| {
            let r = s.figure().report().unwrap();
            off = off.max((span(s) - first).abs());
            let bar = r.audit.applied.iter().filter(|a| a.0 == R_HAND);
            pulled = bar.fold(pulled, |m, a| m.max(a.2.norm()));
            let found = sinew_evaluate::audit::audit(s.figure().links(), &r.audit, GRAVITY);
            residual = residual.max(found.relative);
        });
        println!(
            "{kind:?}: distance kept to {:.4} mm, bar pulls {pulled:.1} N",
            1e3 * off
        );
        assert!(!scene.figure().is_fallen());
        assert!(off < 1e-3, "{kind:?}: {off} m");
        assert!(pulled > 10.0, "the pull reaches the other hand: {pulled} N");
        assert!(residual < 1e-9, "{residual}");
        assert!((scene.figure().links().total_mass() - 81.0).abs() < 1e-9);
    }
}

#[test]
fn a_load_beyond_the_grip_slips_and_one_below_stays() {
    let run = |grip: f64| {
        let body = man();
        let mut scene = Scene::of(figure(
            &body,
            ControllerKind::Modern,
            still(forearm_level()),
        ));
        let load = HeldLoad {
            grip,
            from: f64::NEG_INFINITY,
            ..held(5.0)
        };
        scene
            .world
            .perturb(scene.key, Perturbation::Held(load))
            .unwrap();
        let mut slipped = None;
        scene.run(1.0, |s| {
            let lost = |e: &FigureEvent| matches!(e, FigureEvent::LoadSlipped { mass: 5.0, .. });
            if s.figure().events().iter().any(lost) {
                slipped = Some(s.world.time().0);
            }
        });
        (slipped, scene.figure().links().total_mass())
    };
    let (slipped, mass) = run(35.0);
    assert!(
        slipped.is_some_and(|t| t < 0.2) && (mass - 75.0).abs() < 1e-9,
        "{slipped:?}"
    );
    let (slipped, mass) = run(80.0);
    assert!(
        slipped.is_none() && (mass - 80.0).abs() < 1e-9,
        "{slipped:?}"
    );
}
