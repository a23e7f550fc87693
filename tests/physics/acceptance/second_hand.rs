//! Goal: the other hand helps with a load that is too heavy for one arm, reaches it by its own joints alone, shares it,
//! and lets go when it is not needed. Method: the built-in lift with loads that one arm can and cannot hold; the
//! reference is the same lift with one hand.

use super::{GRAVITY, vec3};
use crate::common::{Scene, authored, figure, man, people, still};
use sinew_evaluate::audit::audit;
use sinew_evaluate::experiments::ControlPair;
use sinew_evaluate::experiments::second_hand::{Rung, rung};
use sinew_evaluate::pose::segment_poses;
use sinew_physics::body::palm::load_point;
use sinew_physics::body::topology::{CHEST, DOF_NAMES, L_HAND, R_HAND};
use sinew_physics::body::{Body, Sex};
use sinew_physics::figure::{
    Constrained, Constraint, ControllerKind, FigureEvent, HeldLoad, Perturbation, SecondHand,
};
use sinew_physics::math::Vec3;
use sinew_physics::motion::builtin::LIFT_GRASP;
use sinew_physics::world::{MotionSource, WorldError};
use std::sync::Arc;

fn held(body: &Body, mass: f64, from: f64) -> HeldLoad {
    HeldLoad {
        segment: R_HAND,
        point: load_point(body, R_HAND),
        mass,
        velocity: Vec3::zero(),
        second: None,
        grip: f64::INFINITY,
        from,
        to: f64::INFINITY,
    }
}

fn helped(body: &Body, mass: f64, when: SecondHand) -> Perturbation {
    Perturbation::Helped {
        load: held(body, mass, LIFT_GRASP),
        when,
    }
}

/// The lift of the reference man with a load.
fn lifting(kind: ControllerKind, load: Perturbation) -> Scene {
    let body = man();
    let mut scene = Scene::playing(&body, kind, &authored(&body, "lift"));
    scene.world.perturb(scene.key, load).unwrap();
    scene
}

/// Largest error of the trunk's joints, degrees.
fn trunk(r: &Rung) -> f64 {
    let of_trunk =
        |d: &usize| DOF_NAMES[*d].starts_with("waist") || DOF_NAMES[*d].starts_with("thorax");
    let all = r.record.samples.iter();
    all.flat_map(|s| {
        (0..DOF_NAMES.len())
            .filter(of_trunk)
            .map(|d| s.joint_error[d].abs())
    })
    .fold(0.0, f64::max)
    .to_degrees()
}

#[test]
fn the_other_hand_helps_who_is_too_weak_and_the_load_comes_up() {
    let everyone = people(&[
        (Sex::Male, 30.0, 1.75, 75.0),
        (Sex::Female, 30.0, 1.63, 62.0),
        (Sex::Female, 9.0, 1.34, 29.0),
    ]);
    let (mut shared, mut alone) = (0, 0);
    for body in &everyone {
        for (pair, masses) in [
            (ControlPair::modern(), &[1.0, 3.0, 5.0, 12.0][..]),
            (ControlPair::paper_torque(), &[1.0, 3.0]),
        ] {
            for mass in masses.iter().copied() {
                let one = rung(body, &pair, mass, None, 0);
                let auto = rung(body, &pair, mass, Some(SecondHand::Auto), 0);
                let who = format!("{}, {mass} kg, {}", body.profile.name(), pair.name);
                println!(
                    "{who}: {} {:.3} m below, {:.0} %, trunk {:.1}° → {:?} share {:.2}, {} {:.3} m below, \
                     {:.0} %, trunk {:.1}°",
                    one.record.result(),
                    one.below,
                    100.0 * one.arm_use,
                    trunk(&one),
                    auto.shared,
                    auto.share,
                    auto.record.result(),
                    auto.below,
                    100.0 * auto.arm_use,
                    trunk(&auto),
                );
                if auto.record.fell_s.is_some() {
                    assert!(
                        one.record.fell_s.is_some(),
                        "{who}: it falls with help only"
                    );
                    continue;
                }
                let Some((_, [need, with])) = auto.shared else {
                    alone += 1;
                    assert!(
                        one.arm_use < 0.99 && one.below < 0.02,
                        "{who}: it needs help"
                    );
                    continue;
                };
                shared += 1;
                assert!(need > 1.0 && with < need, "{who}: {need} → {with}");
                assert!((0.2..=0.9).contains(&auto.share), "{who}: {}", auto.share);
                assert!(auto.apart < 0.2, "{who}: {} m", auto.apart);
                if with < 0.9 {
                    assert!(auto.below < 0.03, "{who}: {} m", auto.below);
                    assert!(trunk(&auto) < trunk(&one).max(10.0), "{who}");
                }
            }
        }
    }
    assert!(shared >= 6 && alone >= 4, "{shared} {alone}");
}

#[test]
fn an_option_that_is_not_needed_changes_no_bit() {
    for kind in [ControllerKind::Modern, ControllerKind::Paper] {
        let body = man();
        let mut with = lifting(kind, helped(&body, 1.0, SecondHand::Auto));
        let mut without = lifting(kind, Perturbation::Held(held(&body, 1.0, LIFT_GRASP)));
        for _ in 0..240 {
            with.world.step();
            without.world.step();
            assert_eq!(with.world.state_hash(), without.world.state_hash());
        }
    }
}

/// The hands keep the distance that they have when the second one takes hold, and the equations of motion hold.
#[test]
fn both_hands_hold_one_load_within_the_equations_of_motion() {
    for kind in [ControllerKind::Modern, ControllerKind::Paper] {
        let body = man();
        let mut scene = lifting(kind, helped(&body, 14.0, SecondHand::Auto));
        let (mut first, mut off, mut residual) = (None, 0.0f64, 0.0f64);
        scene.run(6.0, |s| {
            let f = s.figure();
            let found = audit(f.links(), &f.report().unwrap().audit, GRAVITY);
            residual = residual.max(found.relative);
            let Some(help) = f.help() else { return };
            let poses = segment_poses(&f.links().offset, &f.state().posture);
            let at = poses[help.hand.index()].point(help.point);
            let apart = (at - poses[R_HAND.index()].point(load_point(&body, R_HAND))).norm();
            off = off.max((apart - *first.get_or_insert(apart)).abs());
            let mass = f.links().total_mass();
            assert!((mass - body.profile.mass - 14.0).abs() < 1e-9, "{mass}");
        });
        println!("{kind:?}: apart {first:?} m, kept to {off:.1e} m, residual {residual:.1e}");
        assert!(
            first.is_some_and(|d| (0.08..0.17).contains(&d)),
            "{first:?}"
        );
        assert!(off < 2e-3 && residual < 1e-9, "{off} {residual}");
    }
}

#[test]
fn the_hand_lets_go_and_goes_back_when_one_arm_is_enough() {
    let body = man();
    let mut scene = lifting(
        ControllerKind::Modern,
        helped(&body, 12.0, SecondHand::Auto),
    );
    let lets_go = |s: &Scene| {
        let gone = |e: &FigureEvent| matches!(e, FigureEvent::LoadUnshared { .. });
        s.figure().events().iter().any(gone)
    };
    scene.run(5.0, |s| assert!(!lets_go(s)));
    assert!(scene.figure().help().is_some());
    // The arm comes down: it hangs with the load, which takes no strength.
    let down = authored(&body, "idle").sample(0.0).posture;
    let before = scene.figure().target().next.posture;
    let postures: Vec<_> = (0..=60)
        .map(|i| {
            let mut p = before;
            let way = before.difference(&down);
            p.integrate(&way, f64::from(i) / 60.0);
            p
        })
        .collect();
    let planted = vec![[true; 2]; postures.len()];
    let clip = sinew_physics::motion::Clip::from_postures("down", 40.0, postures, planted).unwrap();
    let now = scene.world.time();
    let play = sinew_physics::world::ClipPlayback::new(Arc::new(clip), now);
    scene.figure_mut().set_drive(MotionSource::Clip(play));
    let mut gone = None;
    scene.run(5.0, |s| {
        if lets_go(s) {
            gone = Some(s.world.time() - now);
        }
    });
    assert!(gone.is_some_and(|t| (0.5..3.0).contains(&t)), "{gone:?}");
    assert!(scene.figure().help().is_none() && !scene.figure().is_fallen());
    let f = scene.figure();
    let errors = f.state().posture.joint_difference(&down);
    for (d, e) in errors.iter().enumerate() {
        if DOF_NAMES[d].starts_with("l_shoulder") || DOF_NAMES[d].starts_with("l_elbow") {
            assert!(e.abs() < 0.05, "{}: {e} rad", DOF_NAMES[d]);
        }
    }
    assert!((f.links().mass[R_HAND.index()] - body.segment(R_HAND).mass - 12.0).abs() < 1e-9);
}

#[test]
fn a_hand_that_has_something_to_do_does_not_help() {
    let body = man();
    let shares = |s: &mut Scene| {
        let mut shared = false;
        s.run(5.0, |s| shared |= s.figure().help().is_some());
        shared
    };
    let mut free = lifting(
        ControllerKind::Modern,
        helped(&body, 12.0, SecondHand::Auto),
    );
    assert!(shares(&mut free));
    // A client leads the hand.
    let mut led = lifting(
        ControllerKind::Modern,
        helped(&body, 12.0, SecondHand::Auto),
    );
    let constraint = Constraint {
        on: Constrained::Point(L_HAND, Vec3::zero()),
        position: Some(vec3(0.1, 0.35, 1.0)),
        axes: [1.0; 3],
        rotation: None,
        weight: 1.0,
        ease: 0.3,
        from: 0.0,
        to: f64::INFINITY,
    };
    led.world.set_constraints(led.key, &[constraint]).unwrap();
    assert!(!shares(&mut led));
    // A hand that holds a load cannot be asked to help, and a load that it is given later makes it let go.
    let in_left = |from| {
        Perturbation::Held(HeldLoad {
            segment: L_HAND,
            point: load_point(&body, L_HAND),
            ..held(&body, 1.0, from)
        })
    };
    let mut busy = lifting(ControllerKind::Modern, in_left(0.0));
    let refused = busy
        .world
        .perturb(busy.key, helped(&body, 12.0, SecondHand::Always));
    assert_eq!(refused, Err(WorldError::OtherHandHoldsLoad));
    free.world.perturb(free.key, in_left(5.5)).unwrap();
    free.run(0.4, |_| ());
    assert!(free.figure().help().is_some());
    free.run(0.3, |_| ());
    assert!(free.figure().help().is_none());
    // Only loads in a hand can be helped.
    let on_chest = Perturbation::Helped {
        load: HeldLoad {
            segment: CHEST,
            ..held(&body, 1.0, 0.0)
        },
        when: SecondHand::Auto,
    };
    let refused = busy.world.perturb(busy.key, on_chest);
    assert_eq!(refused, Err(WorldError::NotInOneHand));
}

#[test]
fn always_takes_hold_of_any_load_and_left_is_the_mirror_image_of_right() {
    let body = man();
    let setup = figure(
        &body,
        ControllerKind::Modern,
        still(authored(&body, "crate").sample(0.0).posture),
    );
    for (hand, other) in [(R_HAND, L_HAND), (L_HAND, R_HAND)] {
        let clip = authored(&body, "crate");
        let mut scene = Scene::of(setup.clone());
        scene.figure_mut().set_drive(crate::common::play(&clip));
        let load = Perturbation::Helped {
            load: HeldLoad {
                segment: hand,
                point: load_point(&body, hand),
                ..held(&body, 2.0, 1.0)
            },
            when: SecondHand::Always,
        };
        scene.world.perturb(scene.key, load).unwrap();
        let mut helps = 0.0;
        scene.run(clip.duration(), |s| {
            if let Some(help) = s.figure().help() {
                assert_eq!(help.hand, other);
                helps += 1.0 / 60.0;
            }
        });
        assert!(helps > 1.0, "{helps} s with the load in {}", hand.name());
    }
}
