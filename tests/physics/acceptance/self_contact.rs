//! Goal: with self-contact on, a figure does not pass through itself, and a standing figure moves as usual. Method: a
//! limp body that is knocked down, with `self_contact` and without.

use crate::common::{Scene, bent, figure, man, still};
use sinew_physics::body::topology::CHEST;
use sinew_physics::collide::shape::BodyShape;
use sinew_physics::figure::{ControllerKind, Perturbation, StrengthScale};
use sinew_physics::math::Vec3;
use sinew_physics::stepper::self_contact::distances;

/// Depth of the deepest pair of segments in three seconds after a push, m, and the states.
fn knocked_down(self_contact: bool, push: Vec3, strength: f64) -> (f64, Vec<[f64; 3]>) {
    let body = man();
    let shape = BodyShape::new(&body);
    let mut setup = figure(&body, ControllerKind::Modern, still(bent(&body, 0.1)));
    setup.options.self_contact = self_contact;
    setup.strength = StrengthScale {
        all: strength,
        ..StrengthScale::default()
    };
    let mut scene = Scene::of(setup);
    let force = Perturbation::Force {
        segment: CHEST,
        point: Vec3::zero(),
        force: push * (1.0 / 0.2),
        from: 0.5,
        to: 0.7,
    };
    scene.world.perturb(scene.key, force).unwrap();
    let (mut deepest, mut path) = (0.0_f64, Vec::new());
    scene.run(3.0, |s| {
        let posture = &s.figure().state().posture;
        distances(&body, &shape, posture, |_, near| {
            deepest = deepest.max(-near.gap)
        });
        let at = posture.root_position;
        path.push([at.x, at.y, at.z]);
    });
    (deepest, path)
}

#[test]
fn a_limp_body_stays_out_of_itself_if_it_is_told_so() {
    let mut worst = [0.0_f64; 2];
    for push in [Vec3::X, -Vec3::X, Vec3::Y] {
        let [with, without] = [true, false].map(|on| knocked_down(on, push * 60.0, 0.02).0);
        println!(
            "{push:?}: {:.0} mm with, {:.0} mm without",
            1e3 * with,
            1e3 * without
        );
        worst = [worst[0].max(with), worst[1].max(without)];
    }
    assert!(worst[0] < 0.1 && worst[1] > 1.5 * worst[0], "{worst:?} m");
}

#[test]
fn who_stands_as_its_motion_does_feels_nothing() {
    let [with, without] = [true, false].map(|on| knocked_down(on, Vec3::zero(), 1.0).1);
    assert!(with == without);
}
