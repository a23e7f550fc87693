//! Goal: pushes while a walk begins do not fell the figure. It steps out of the walk where it has to, stands, and
//! begins it again, once. Motions that work on the floor are followed there.

use super::vec3;
use crate::common::{Scene, figure, man, still, synthesised};
use sinew_physics::body::topology::CHEST;
use sinew_physics::figure::{ControllerKind, FigureEvent, Perturbation};
use sinew_physics::math::Vec3;
use sinew_physics::time::WorldTime;
use sinew_physics::world::{ClipPlayback, MotionSource};

/// Time for which the figure stands before its walk, s.
const STANDS: f64 = 0.3;

/// How a pushed walk went.
#[derive(Debug, Default)]
struct Walk {
    fell: bool,
    restarts: usize,
    given_up: bool,
    /// Way over the floor over that of the clip.
    way: f64,
}

/// The synthesised walk from a stand, with pushes of `impulse` N·s in 0.2 s that begin at these times of the clip, s.
fn walk(direction: Vec3, impulse: f64, moments: &[f64]) -> Walk {
    let body = man();
    let clip = synthesised(&body, "walk-normal.vrm");
    let lead_in = clip.lead_in();
    let first = clip.sample(-lead_in).posture;
    let setup = figure(&body, ControllerKind::Modern, still(first));
    let mut scene = Scene::of(setup);
    let start = WorldTime(STANDS + lead_in);
    let play = ClipPlayback::new(clip.clone(), start);
    scene.figure_mut().set_drive(MotionSource::Clip(play));
    for moment in moments {
        let from = start.0 + moment;
        let push = Perturbation::Force {
            segment: CHEST,
            point: vec3(0.0, 0.0, 0.1),
            force: direction * (impulse / 0.2),
            from,
            to: from + 0.2,
        };
        scene.world.perturb(scene.key, push).unwrap();
    }
    let mut out = Walk::default();
    let whole = start.0 + clip.duration() + clip.lead_out();
    scene.run(whole + 12.0, |s| {
        for event in s.figure().events() {
            match event {
                FigureEvent::Fell => out.fell = true,
                FigureEvent::ClipRestarts => out.restarts += 1,
                FigureEvent::ClipGivenUp => out.given_up = true,
                _ => {}
            }
        }
    });
    let end = clip.sample(f64::INFINITY).posture.root_position;
    let gone = scene.figure().state().posture.root_position - first.root_position;
    out.way = gone.level() / (end - first.root_position).level();
    out
}

#[test]
fn who_is_pushed_while_a_walk_begins_stays_up_and_walks_it_all_the_same() {
    let (mut fell, mut restarted) = (0, 0);
    for direction in [Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y] {
        for moment in [-0.6, 0.0, 0.6, 1.2] {
            let o = walk(direction, 30.0, &[moment]);
            println!("{direction:?} at {moment} s: {o:?}");
            fell += usize::from(o.fell);
            restarted += usize::from(o.restarts == 1 && o.way > 0.5);
            assert!(o.restarts <= 1 && !o.given_up, "{o:?}");
            assert!(
                o.fell || o.restarts > 0 || o.way > 0.8,
                "it is walked: {o:?}"
            );
        }
    }
    assert!(fell <= 1, "{fell} of 16 fall");
    assert!(
        restarted > 0,
        "nobody stepped out of the walk and began it again"
    );
}

#[test]
fn who_has_to_step_out_again_stays_where_it_is() {
    let outcomes: Vec<Walk> = (0..6)
        .map(|k| walk(-Vec3::X, 30.0, &[0.6, 5.0 + 0.5 * f64::from(k)]))
        .collect();
    println!("{outcomes:?}");
    assert!(outcomes.iter().all(|o| o.restarts <= 1));
    assert!(
        outcomes
            .iter()
            .any(|o| o.restarts == 1 && o.given_up && !o.fell && o.way < 0.8)
    );
}
