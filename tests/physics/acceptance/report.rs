//! Goal: the reported centre of mass belongs to the state at the end of the tick, and loads in hands are where they are
//! drawn. Method: masses and poses of the segments; the velocity by moving the posture a little along it and back.

use crate::acceptance::vec3;
use crate::common::{Scene, figure, man, still};
use sinew_evaluate::pose::segment_poses;
use sinew_physics::body::palm::load_point;
use sinew_physics::body::topology::{CHEST, R_HAND};
use sinew_physics::body::{Body, Posture, SegmentId};
use sinew_physics::figure::{ControllerKind, Perturbation};
use sinew_physics::math::Vec3;
use sinew_physics::motion::builtin::at_ease;

const EXACT: f64 = 1e-9;
/// Time by which the posture is moved, s.
const MOMENT: f64 = 1e-6;

/// Centre of mass of a posture: segments and loads, each where it is.
fn com(body: &Body, loads: &[(SegmentId, Vec3, f64)], posture: &Posture) -> Vec3 {
    let poses = segment_poses(&body.joint_offset, posture);
    let segments = (0..body.segments.len()).map(|i| {
        let s = &body.segments[i];
        (i, s.com, s.mass)
    });
    let loads = loads.iter().map(|(s, p, m)| (s.index(), *p, *m));
    let (mut moment, mut mass) = (Vec3::zero(), 0.0);
    for (i, local, m) in segments.chain(loads) {
        moment += (poses[i].position + poses[i].rotation.rotate(local)) * m;
        mass += m;
    }
    moment * (1.0 / mass)
}

/// A figure is pushed and, if `kg` > 0, takes up a load; every report is compared with its own state.
fn reports_its_own_state(kind: ControllerKind, kg: f64) {
    let body = man();
    let mut scene = Scene::of(figure(&body, kind, still(at_ease(&body))));
    let (push, load) = (
        Perturbation::Force {
            segment: CHEST,
            point: Vec3::zero(),
            force: vec3(300.0, 100.0, 0.0),
            from: 0.1,
            to: 0.2,
        },
        Perturbation::Load {
            segment: R_HAND,
            point: load_point(&body, R_HAND),
            mass: kg,
            from: 0.3,
            to: f64::INFINITY,
        },
    );
    scene.world.perturb(scene.key, push).unwrap();
    if kg > 0.0 {
        scene.world.perturb(scene.key, load).unwrap();
    }
    let mut fastest = 0.0f64;
    scene.run(1.0, |s| {
        let f = s.figure();
        let (r, state) = (f.report().unwrap(), f.state());
        let carried = f.links().mass[R_HAND.index()] - body.segment(R_HAND).mass;
        assert!((carried - if s.world.time().0 > 0.31 { kg } else { 0.0 }).abs() < EXACT);
        let loads = [(R_HAND, load_point(&body, R_HAND), carried)];
        let off = (r.balance.com - com(&body, &loads, &state.posture)).norm();
        assert!(off < EXACT, "{kind:?}: centre of mass off by {off} m");
        let moved = |time: f64| {
            let mut posture = state.posture;
            posture.integrate(&state.velocity, time);
            com(&body, &loads, &posture)
        };
        let velocity = (moved(MOMENT) - moved(-MOMENT)) * (0.5 / MOMENT);
        let off = (r.balance.com_velocity - velocity).norm();
        // The difference loses half of the digits.
        assert!(off < 1e-8, "{kind:?}: velocity off by {off} m/s");
        fastest = fastest.max(velocity.norm());
    });
    assert!(fastest > 0.1, "{kind:?}: nothing moved");
}

#[test]
fn centre_of_mass_and_its_velocity_are_of_the_state_at_the_end_of_the_tick() {
    for kind in [
        ControllerKind::Modern,
        ControllerKind::Paper,
        ControllerKind::Motors,
    ] {
        for kg in [0.0, 4.0] {
            reports_its_own_state(kind, kg);
        }
    }
}

#[test]
fn a_reset_puts_the_reported_centre_of_mass_where_the_figure_is_put() {
    let body = man();
    let mut scene = Scene::of(figure(&body, ControllerKind::Modern, still(at_ease(&body))));
    let held = |kg| Perturbation::Load {
        segment: R_HAND,
        point: load_point(&body, R_HAND),
        mass: kg,
        from: f64::NEG_INFINITY,
        to: f64::INFINITY,
    };
    scene.world.perturb(scene.key, held(5.0)).unwrap();
    scene.run(0.2, |_| ());
    let mut posture = at_ease(&body);
    posture.root_position.x = 7.0;
    for (cleared, kg) in [(false, 5.0), (true, 0.0)] {
        if cleared {
            scene.figure_mut().clear_perturbations();
        }
        scene.figure_mut().reset(still(posture));
        let r = scene.figure().report().unwrap();
        let loads = [(R_HAND, load_point(&body, R_HAND), kg)];
        assert!((r.balance.com - com(&body, &loads, &posture)).norm() < EXACT);
        assert_eq!(r.balance.com_velocity, Vec3::zero());
    }
}
