//! Goal: a standing figure withstands a push after which its centre of mass can still be stopped over its feet;
//! otherwise it falls in the direction of the push. Method: pushes at the chest of 0.1 s, in units of the bound of the
//! linear inverted pendulum `m ω d`, with `ω² = g/h` and d the distance from the centre of mass to the edge of the
//! support.

use super::{GRAVITY, vec3};
use crate::common::{Scene, authored, figure, man, still};
use sinew_evaluate::pose::segment_poses;
use sinew_physics::body::topology::CHEST;
use sinew_physics::figure::{ControllerKind, FigureEvent, Flags, Perturbation};
use sinew_physics::math::Vec3;

const DIRECTIONS: [(&str, Vec3); 4] = [
    ("forward", vec3_const(1.0, 0.0)),
    ("backward", vec3_const(-1.0, 0.0)),
    ("left", vec3_const(0.0, 1.0)),
    ("right", vec3_const(0.0, -1.0)),
];

const fn vec3_const(x: f64, y: f64) -> Vec3 {
    Vec3 { x, y, z: 0.0 }
}

/// A figure that has stood for half a second, with feet fixed in place or allowed to step.
fn standing(kind: ControllerKind, steps: bool) -> Scene {
    let body = man();
    let posture = authored(&body, "idle").posture(0).to_owned();
    let mut setup = figure(&body, kind, still(posture));
    setup.params.protective_steps = steps;
    let mut scene = Scene::of(setup);
    scene.run(0.5, |_| ());
    scene
}

/// Impulse that the linear pendulum can just stop, N·s.
fn bound(scene: &Scene, direction: Vec3) -> f64 {
    let r = scene.figure().report().unwrap();
    let edge = r
        .balance
        .support_polygon
        .iter()
        .map(|c| vec3(c[0], c[1], 0.0).dot(direction))
        .fold(f64::MIN, f64::max);
    let mass = scene.figure().links().total_mass();
    mass * (GRAVITY / r.balance.com.z).sqrt() * (edge - r.balance.com.dot(direction))
}

/// Result of a push.
struct Outcome {
    fell: bool,
    /// Displacement of the centre of mass until it fell, or until the end, m.
    moved: Vec3,
    /// Speed of the centre of mass at the end, m/s.
    speed: f64,
}

fn push(kind: ControllerKind, direction: Vec3, impulse: f64, steps: bool) -> Outcome {
    let mut scene = standing(kind, steps);
    let start = scene.figure().report().unwrap().balance.com;
    let now = scene.world.time().0;
    let what = Perturbation::Force {
        segment: CHEST,
        point: vec3(0.0, 0.0, 0.1),
        force: direction * (impulse / 0.1),
        from: now,
        to: now + 0.1,
    };
    scene.world.perturb(scene.key, what).unwrap();
    let mut fell_at = None;
    scene.run(6.0, |s| {
        let r = s.figure().report().unwrap();
        if fell_at.is_none() && (s.figure().is_fallen() || r.balance.com.z < 0.5) {
            fell_at = Some(r.balance.com);
        }
        assert!(r.joints.over_limit <= 1e-9, "torques stay within strength");
        assert!(!r.flags.has(Flags::QUARANTINED));
    });
    let r = scene.figure().report().unwrap();
    Outcome {
        fell: fell_at.is_some(),
        moved: fell_at.unwrap_or(r.balance.com) - start,
        speed: r.balance.com_velocity.norm(),
    }
}

fn recovers(kind: ControllerKind, direction: Vec3, impulse: f64) {
    let o = push(kind, direction, impulse, false);
    let text = format!(
        "{kind:?} pushed {impulse:.1} N·s: fell {}, moved {:.3} {:.3} {:.3} m, {:.4} m/s",
        o.fell, o.moved.x, o.moved.y, o.moved.z, o.speed
    );
    println!("{text}");
    assert!(!o.fell, "{text}");
    assert!(o.moved.norm() < 0.03 && o.speed < 0.01, "{text}");
}

#[test]
fn both_recover_from_light_pushes_forward() {
    for kind in [ControllerKind::Modern, ControllerKind::Paper] {
        for impulse in [10.0, 12.5, 15.0] {
            recovers(kind, Vec3::X, impulse);
        }
    }
}

#[test]
fn modern_recovers_from_most_of_what_a_pendulum_can() {
    for (name, direction) in DIRECTIONS {
        let bound = bound(&standing(ControllerKind::Modern, false), direction);
        println!("{name}: bound {bound:.1} N·s");
        recovers(ControllerKind::Modern, direction, 0.9 * bound);
    }
}

fn falls(kind: ControllerKind) {
    for (name, direction) in DIRECTIONS {
        let bound = bound(&standing(kind, false), direction);
        for share in [1.3, 2.0] {
            let o = push(kind, direction, share * bound, false);
            let text = format!(
                "{kind:?} {name} {:.1} N·s ({share} of {bound:.1}): fell {}, moved {:.2} {:.2} {:.2} m",
                share * bound,
                o.fell,
                o.moved.x,
                o.moved.y,
                o.moved.z
            );
            println!("{text}");
            assert!(o.fell, "{text}");
            let along = o.moved.dot(direction);
            let across = (o.moved - direction * along - Vec3::Z * o.moved.z).norm();
            assert!(along > 0.2 && across < 0.5 * along, "{text}");
        }
    }
}

#[test]
fn modern_falls_the_way_it_is_pushed() {
    falls(ControllerKind::Modern);
}

#[test]
fn paper_falls_the_way_it_is_pushed() {
    falls(ControllerKind::Paper);
}

/// Beyond the bound a figure that may step does, and stands again; the same push fells one that may not.
#[test]
fn steps_catch_what_feet_in_place_cannot() {
    for (name, direction, share) in [
        ("forward", Vec3::X, 1.1),
        ("backward", -Vec3::X, 1.25),
        ("left", Vec3::Y, 1.15),
        ("right", -Vec3::Y, 1.15),
    ] {
        let kind = ControllerKind::Modern;
        let impulse = share * bound(&standing(kind, false), direction);
        let (still, steps) = (
            push(kind, direction, impulse, false),
            push(kind, direction, impulse, true),
        );
        let text = format!(
            "{name} {impulse:.1} N·s ({share} of the bound): in place fell {}, stepping fell {}, {:.4} m/s",
            still.fell, steps.fell, steps.speed
        );
        println!("{text}");
        assert!(still.fell && !steps.fell && steps.speed < 0.05, "{text}");
    }
}

/// A body that had to hold its mass still against a hard push could do so only by bowing.
#[test]
fn a_standing_body_goes_with_a_hard_push_instead_of_bowing() {
    for (name, direction) in DIRECTIONS {
        let mut scene = standing(ControllerKind::Modern, true);
        let from = scene.world.time().0;
        let what = Perturbation::Force {
            segment: CHEST,
            point: vec3(0.0, 0.0, 0.1),
            force: direction * 400.0,
            from,
            to: from + 0.1,
        };
        scene.world.perturb(scene.key, what).unwrap();
        let mut tilt: f64 = 0.0;
        scene.run(4.0, |s| {
            let body = s.figure().body();
            let chest =
                segment_poses(&body.joint_offset, &s.figure().state().posture)[CHEST.index()];
            tilt = tilt.max(chest.rotation.rotate(Vec3::Z).z.acos().to_degrees());
        });
        println!("{name}: {tilt:.0}°");
        assert!(
            !scene.figure().is_fallen() && tilt < 45.0,
            "{name}: {tilt}°"
        );
    }
}

/// The flag of lost balance is cleared when motors can no longer save anything, but that is not a recovery.
#[test]
fn who_lies_on_the_ground_has_found_no_balance() {
    let mut scene = standing(ControllerKind::Modern, false);
    let direction = Vec3::X;
    let now = scene.world.time().0;
    let what = Perturbation::Force {
        segment: CHEST,
        point: vec3(0.0, 0.0, 0.1),
        force: direction * (2.0 * bound(&scene, direction) / 0.1),
        from: now,
        to: now + 0.1,
    };
    scene.world.perturb(scene.key, what).unwrap();
    let mut told = Vec::new();
    scene.run(4.0, |s| told.extend_from_slice(s.figure().events()));
    let balance: Vec<_> = told
        .iter()
        .filter(|e| {
            matches!(
                e,
                FigureEvent::BalanceLost
                    | FigureEvent::Recovered
                    | FigureEvent::Fell
                    | FigureEvent::GotUp
            )
        })
        .collect();
    assert_eq!(balance, [&FigureEvent::BalanceLost, &FigureEvent::Fell]);
}
