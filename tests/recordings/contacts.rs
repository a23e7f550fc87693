//! Goal: figures that touch each other or their seat follow their recorded motion, and contact forces balance. Method:
//! a dancing couple, and a person sitting down on stools of several sizes at several places.

use crate::common::collisions::{Meter, obstacle};
use crate::common::{figure, man, play, recorded_with};
use crate::vec3;
use sinew_evaluate::pose::segment_poses;
use sinew_physics::body::Body;
use sinew_physics::body::topology::{L_FOOT, R_FOOT};
use sinew_physics::collide::{Mobility, ObstacleSetup, Shape};
use sinew_physics::figure::ControllerKind;
use sinew_physics::math::{Quat, Vec3};
use sinew_physics::motion::Clip;
use sinew_physics::reference::RetargetOptions;
use sinew_physics::world::{World, WorldParams};
use std::sync::Arc;

/// A recording at its original place and size, so that partners stay together.
fn dancing(body: &Body, name: &str) -> Arc<Clip> {
    let options = RetargetOptions {
        keep_origin: true,
        ..RetargetOptions::default()
    };
    recorded_with(body, name, &options)
}

#[test]
fn a_couple_dances_salsa() {
    let body = man();
    let mut world = World::new(WorldParams::default()).unwrap();
    for name in ["salsa-a", "salsa-b"] {
        let clip = dancing(&body, name);
        let first = clip.sample(0.0);
        let state = first.state();
        let setup = figure(&body, ControllerKind::Modern, state);
        let key = world.add_figure(setup).unwrap();
        world.figure_mut(key).unwrap().set_drive(play(&clip));
    }
    let mut m = Meter::default();
    for _ in 0..600 {
        world.step();
        m.observe(&world);
    }
    let fell: Vec<bool> = world.figures().map(|(_, f)| f.is_fallen()).collect();
    m.judge(&format!("salsa, fell {fell:?}"), 60.0);
}

/// Sits down on a stool, moves about on it, gets up, turns and walks away: wherever the stool is, within reason. While
/// it sits, its feet stay in place.
#[test]
fn a_figure_sits_down_and_gets_up() {
    let body = man();
    let clip = recorded_with(&body, "sit-stand", &RetargetOptions::default());
    // Side, height and place of the stool, m, and joint error that is allowed, degrees. The first is at the seat of the
    // motion: under the pelvis, and as high as a rigid pelvis can be there. On one that is too high or low the legs
    // cannot be as recorded, and a small one ends under the thighs.
    for (side, height, x, most) in [
        (0.44, 0.35, 0.41, 1.0),
        (0.38, 0.355, 0.41, 1.0),
        (0.34, 0.345, 0.43, 1.25),
        (0.34, 0.35, 0.41, 1.25),
        (0.34, 0.36, 0.389, 1.5),
        (0.34, 0.38, 0.389, 1.9),
        (0.40, 0.38, 0.429, 1.9),
        (0.34, 0.38, 0.349, 1.9),
    ] {
        let text = format!("stool {side} wide and {height} m high at {x}");
        let first = clip.sample(0.0);
        let state = first.state();
        let mut world = World::new(WorldParams::default()).unwrap();
        let setup = figure(&body, ControllerKind::Modern, state);
        let key = world.add_figure(setup).unwrap();
        world.figure_mut(key).unwrap().set_drive(play(&clip));
        let half = vec3(0.5 * side, 0.5 * side, 0.5 * height);
        let stool = ObstacleSetup {
            rotation: Quat::exp(Vec3::Z * -51f64.to_radians()),
            ..obstacle(
                Shape::Box { half },
                Mobility::Fixed,
                vec3(x, 0.54, 0.5 * height),
            )
        };
        world.add_obstacle(stool).unwrap();
        let mut m = Meter::default();
        let mut seated = 0;
        let mut error = [(0.0, 0.0); 2];
        let mut feet = [Vec3::zero(); 2];
        let mut crept = 0.0f64;
        for tick in 0..(60.0 * clip.duration()) as u64 {
            world.step();
            m.observe(&world);
            let f = world.figure(key).unwrap();
            assert!(!f.is_fallen(), "{text}: fell at {:.2} s", world.time().0);
            let r = f.report().unwrap();
            let carried: f64 = r.touches.iter().map(|t| t.force.z).sum();
            seated += u64::from(carried > 0.1 * 75.0 * 9.81);
            let square = r.joints.joint_error.iter().map(|e| e * e).sum::<f64>() / 39.0;
            // It has settled on the stool, and has not begun to get up.
            let still = (210..390).contains(&tick);
            for (sum, count) in &mut error[..if still { 2 } else { 1 }] {
                *sum += square;
                *count += 1.0;
            }
            let poses = segment_poses(&f.links().offset, &f.state().posture);
            for (side, foot) in [L_FOOT, R_FOOT].into_iter().enumerate() {
                let at = poses[foot.index()].position;
                if tick == 210 {
                    feet[side] = at;
                }
                if still {
                    crept = crept.max((at - feet[side]).norm());
                }
            }
        }
        let up = world.figure(key).unwrap().report().unwrap().balance.com.z;
        let [whole, sitting] = error.map(|(sum, count): (f64, f64)| (sum / count).sqrt());
        println!(
            "{text}: seated for {:.2} s, {:.2}° rms, {:.2}° while it sits, feet creep {:.1} mm",
            seated as f64 / 60.0,
            whole.to_degrees(),
            sitting.to_degrees(),
            1e3 * crept
        );
        assert!(
            whole.to_degrees() < most && sitting.to_degrees() < most + 0.4,
            "{text}"
        );
        assert!(crept < 0.01, "{text}: feet crept {crept} m");
        assert!(
            seated > 3 * 60,
            "{text}: the seat carried for {seated} ticks"
        );
        assert!(up > 0.8, "{text}: not up at the end, {up:.2} m");
        m.judge(&text, 60.0);
    }
}
