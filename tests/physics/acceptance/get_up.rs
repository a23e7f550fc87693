//! Goal: a lying figure gets up within seconds when its motion does, from the belly, the back and both sides. Method:
//! people are laid down, straight or with bent knees, and play a synthesised motion that lies and gets up. Rolling over
//! takes a random number of tries, so each person is laid down a second time, a few degrees off.

use crate::common::{Scene, authored, bent, figure, man, on_floor, people, still, synthesised};
use sinew_physics::body::{Body, Posture, Sex};
use sinew_physics::figure::{ControllerKind, FigureEvent};
use sinew_physics::math::vec3::vec3;
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::world::{ClipPlayback, MotionSource};
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// A time at which the body in `lie-down.vrm` is lying, s.
const LIES: f64 = 4.0;
/// Time allowed, s, before the figure counts as staying down.
const PATIENCE: f64 = 60.0;
/// A figure is up once it has stood for this time, s.
const STANDS: f64 = 2.0;

/// Seconds from the first move to standing, or `None` if it stays down.
fn gets_up(body: &Arc<Body>, lying: Posture) -> Option<f64> {
    let mut scene = Scene::of(figure(body, ControllerKind::Modern, still(lying)));
    scene.run(1.0, |_| ());
    let start = scene.world.time() - LIES;
    let clip = ClipPlayback::new(synthesised(body, "lie-down.vrm"), start);
    scene.figure_mut().set_drive(MotionSource::Clip(clip));
    let (mut begins, mut up) = (None, None);
    let end = scene.world.time() + PATIENCE;
    while scene.world.time() < up.map_or(end, |t| t + STANDS) {
        scene.world.step();
        let (f, now) = (scene.figure(), scene.world.time());
        if f.rising().is_some() {
            begins.get_or_insert(now);
        }
        if f.events().contains(&FigureEvent::GotUp) {
            up.get_or_insert(now);
        }
        if f.events().contains(&FigureEvent::Fell) {
            up = None;
        }
    }
    Some(up? - begins?)
}

/// `posture` turned by `turn` and laid on the floor.
fn laid(body: &Body, mut posture: Posture, turn: Quat) -> Posture {
    posture.root_rotation = turn * posture.root_rotation;
    on_floor(body, &mut posture);
    posture
}

#[test]
fn people_get_up_from_belly_back_and_sides() {
    let mut bodies = vec![("average man", man())];
    let others = people(&[
        (Sex::Female, 30.0, 1.63, 62.0),
        (Sex::Male, 25.0, 1.9, 90.0),
        (Sex::Female, 45.0, 1.7, 75.0),
    ]);
    bodies.extend(
        ["average woman", "tall man", "heavy woman"]
            .into_iter()
            .zip(others),
    );
    let ways = [
        ("belly", Quat::exp(Vec3::Y * FRAC_PI_2)),
        ("back", Quat::exp(Vec3::Y * -FRAC_PI_2)),
        ("right side", Quat::exp(Vec3::X * FRAC_PI_2)),
        ("left side", Quat::exp(Vec3::X * -FRAC_PI_2)),
    ];
    println!("| body | lies on | straight, s | knees bent, s |\n|---|---|---|---|");
    let mut times = Vec::new();
    for off in [Vec3::zero(), vec3(0.05, -0.03, 0.04)] {
        for (who, body) in &bodies {
            for (on, turn) in ways {
                let straight = authored(body, "idle").posture(0).to_owned();
                let turn = Quat::exp(off) * turn;
                let took = [straight, bent(body, 0.6)].map(|p| gets_up(body, laid(body, p, turn)));
                let cells = took.map(|t| t.map_or("stays down".to_owned(), |t| format!("{t:.1}")));
                let how = if off == Vec3::zero() {
                    on.to_owned()
                } else {
                    format!("{on}, off")
                };
                println!("| {who} | {how} | {} | {} |", cells[0], cells[1]);
                times.extend(took);
            }
        }
    }
    let mut up: Vec<f64> = times.iter().flatten().copied().collect();
    up.sort_by(f64::total_cmp);
    assert!(
        up.len() + 1 >= times.len(),
        "{} of {}",
        up.len(),
        times.len()
    );
    let median = up[up.len() / 2];
    println!(
        "{} of {} get up, half of them within {median:.1} s",
        up.len(),
        times.len()
    );
    assert!(median < 14.0, "{median} s");
    // From the belly, nothing depends on luck: the average man and the average woman both get up.
    let all = times
        .chunks(8)
        .zip([true, true, false, false].into_iter().cycle());
    for took in all
        .filter(|(_, average)| *average)
        .flat_map(|(body, _)| &body[..2])
    {
        assert!(took.is_some_and(|t| t < 11.0), "{took:?}");
    }
}
