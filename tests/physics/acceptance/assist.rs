//! Goal: assist holds the pelvis on its path, is bounded, is reported to the last newton, and is zero when it is off.

use crate::common::{Scene, authored, bent, figure, man, still};
use sinew_evaluate::audit::audit;
use sinew_physics::body::topology::CHEST;
use sinew_physics::figure::{ControllerKind, FigureOptions, Perturbation};
use sinew_physics::math::Vec3;

fn walking(kind: ControllerKind, assist: f64) -> Scene {
    let body = man();
    let clip = authored(&body, "walk");
    let mut scene = Scene::playing(&body, kind, &clip);
    let options = FigureOptions {
        assist,
        ..FigureOptions::default()
    };
    scene.world.set_figure_options(scene.key, options).unwrap();
    scene
}

#[test]
fn full_assist_walks_with_the_pelvis_on_its_path() {
    for (kind, joints) in [(ControllerKind::Modern, 8.0), (ControllerKind::Motors, 8.0)] {
        let mut scene = walking(kind, 1.0);
        let r = scene.measure(authored(&man(), "walk").duration());
        println!(
            "{kind:?}: rms {:.2}°, root within {:.3} mm, {:.0} N mean, {:.0} N and {:.0} N·m at most, residual {:.1e}",
            r.tracking_joint_rms_deg,
            r.tracking_root_max_mm,
            r.assist_mean_n,
            r.assist_max_n,
            r.assist_max_nm,
            r.dynamics_residual_max
        );
        assert!(r.fell_at_s.is_none() && r.tracking_joint_rms_deg < joints);
        assert!(
            r.tracking_root_max_mm < 2.0,
            "{} {}",
            r.tracking_root_max_mm,
            r.tracking_joint_rms_deg
        );
        assert!(r.dynamics_residual_max < 1e-9 && r.over_limit_max < 1e-9);
        assert!(r.root_wrench_unexplained_max_n < 1e-6 * 75.0 * 9.81);
        assert!(r.assist_max_n > 1.0, "it is reported");
    }
}

#[test]
fn assist_is_bounded_and_every_tick_closes() {
    let body = man();
    for (assist, force, moment) in [(0.1, 147.2, 64.4), (0.4, 588.6, 257.6)] {
        let mut setup = figure(&body, ControllerKind::Modern, still(bent(&body, 0.3)));
        setup.options.assist = assist;
        let mut scene = Scene::of(setup);
        let push = Perturbation::Force {
            segment: CHEST,
            point: Vec3::zero(),
            force: Vec3 {
                x: 900.0,
                y: 500.0,
                z: 0.0,
            },
            from: 0.5,
            to: 1.0,
        };
        scene.world.perturb(scene.key, push).unwrap();
        let (mut largest, mut largest_moment) = (0.0f64, 0.0f64);
        scene.run(3.0, |s| {
            let r = s.figure().report().unwrap();
            let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
            for wrench in [&r.assist, &r.audit.assist] {
                largest_moment = largest_moment.max(size(&wrench[..3]));
                largest = largest.max(size(&wrench[3..]));
            }
            let found = audit(s.figure().links(), &r.audit, 9.81);
            assert!(found.relative < 1e-9, "{}", found.relative);
        });
        println!("assist {assist}: at most {largest:.1} N, {largest_moment:.1} N·m");
        assert!(
            largest <= force * 1.001 && largest > 0.5 * force,
            "{largest}"
        );
        assert!(largest_moment <= moment * 1.001, "{largest_moment}");
    }
}

#[test]
fn no_assist_is_bit_for_bit_what_there_was() {
    let run = |touch: bool| {
        let mut scene = walking(ControllerKind::Modern, 0.0);
        if touch {
            // Switch it on for a moment before anything moves, then off again.
            for assist in [1.0, 0.0] {
                let options = FigureOptions {
                    assist,
                    ..FigureOptions::default()
                };
                scene.world.set_figure_options(scene.key, options).unwrap();
            }
        }
        scene.run(3.0, |s| {
            assert_eq!(s.figure().report().unwrap().assist, [0.0; 6])
        });
        scene.world.state_hash()
    };
    assert_eq!(run(false), run(true));
    let mut scene = walking(ControllerKind::Modern, 0.0);
    let options = FigureOptions {
        assist: 1.1,
        ..FigureOptions::default()
    };
    let refused = scene.world.set_figure_options(scene.key, options);
    assert!(refused.unwrap_err().to_string().contains("assist"));
}
