//! Goal: a figure's motion is a function of its input alone: the same in every run, on any number of threads, and with
//! any other figures in the world. Method: hashes over all bits of the state after a run. Golden hashes are committed
//! in `tests/golden/hashes.txt`; their scenes are built with the arithmetic of the simulation alone (no platform
//! mathematics), so they hold on every machine. After an intended change of the physics: `SINEW_MINT_GOLDEN=1 cargo
//! test --no-default-features --test physics determinism::golden`.

use crate::common::actors::{KINDS, crowd, in_both_hands, subject, world};
use crate::common::{Scene, bent, figure, still};
use sinew_physics::body::{Body, Profile, Sex};
use sinew_physics::figure::{ControllerKind, Perturbation};
use sinew_physics::math::Vec3;
use sinew_physics::world::{FigureKey, World, WorldParams};
use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::Arc;

/// Hash of the subject after every tenth tick.
fn trace(world: &mut World, key: FigureKey, ticks: usize) -> Vec<u64> {
    (0..ticks)
        .filter_map(|i| {
            world.step();
            (i % 10 == 9).then(|| world.figure(key).unwrap().state_hash())
        })
        .collect()
}

#[test]
fn the_same_input_gives_the_same_bits() {
    for kind in KINDS {
        let run = || {
            let mut world = world(1);
            let key = subject(kind, 150.0).enter(&mut world);
            (trace(&mut world, key, 150), world.state_hash())
        };
        let first = run();
        assert_eq!(first, run(), "{kind:?}");
        let mut other = world(1);
        let key = subject(kind, 150.000_001).enter(&mut other);
        let changed = trace(&mut other, key, 150);
        assert_eq!(
            first.0[..5],
            changed[..5],
            "{kind:?}: the same until the push"
        );
        assert_ne!(
            first.0.last(),
            changed.last(),
            "{kind:?}: the hash sees a push that differs by a millionth"
        );
    }
}

#[test]
fn threads_do_not_matter() {
    let run = |threads: usize| {
        let mut world = world(threads);
        for kind in KINDS {
            subject(kind, 300.0).enter(&mut world);
        }
        for actor in crowd(6) {
            actor.enter(&mut world);
        }
        (0..90)
            .map(|_| {
                world.step();
                world.state_hash()
            })
            .collect::<Vec<_>>()
    };
    let one = run(1);
    for threads in [2, 5, 64] {
        assert_eq!(one, run(threads), "{threads} threads");
    }
}

#[test]
fn neighbours_do_not_matter() {
    let mut neighbours = crowd(50);
    // Out of reach, because contact does have an effect.
    for (i, actor) in neighbours.iter_mut().enumerate() {
        actor.shift(Vec3 {
            x: 100.0,
            y: 12.0 * i as f64,
            z: 0.0,
        });
    }
    for kind in [ControllerKind::Modern, ControllerKind::Paper] {
        let actor = subject(kind, 200.0);
        let mut alone = world(1);
        let key = actor.enter(&mut alone);
        let want = trace(&mut alone, key, 90);
        // In the middle of the crowd, so that any split over threads or lanes changes its neighbours; one figure leaves
        // half-way.
        let mut full = world(2);
        let mut keys: Vec<_> = neighbours[..23]
            .iter()
            .map(|a| a.enter(&mut full))
            .collect();
        let key = actor.enter(&mut full);
        keys.extend(neighbours[23..].iter().map(|a| a.enter(&mut full)));
        let mut got = trace(&mut full, key, 40);
        assert!(full.remove_figure(keys[7]));
        got.extend(trace(&mut full, key, 50));
        assert_eq!(want, got, "{kind:?}");
    }
}

#[test]
fn worlds_that_a_thread_steps_in_turns_do_not_matter() {
    // A thread has one workspace, and lends it to a figure of one world after a figure of another.
    let scenes = || -> Vec<(World, FigureKey)> {
        let grounds = [(9.81, 0.9), (3.7, 0.15), (9.81, 0.4)];
        let mut out = Vec::new();
        for ((gravity, friction), newtons) in grounds.into_iter().zip([150.0, 300.0, 800.0]) {
            for kind in KINDS {
                let mut world = World::new(WorldParams {
                    gravity,
                    friction,
                    ..WorldParams::default()
                })
                .unwrap();
                let key = subject(kind, newtons).enter(&mut world);
                out.push((world, key));
            }
        }
        // Two figures that meet need a workspace each.
        let mut meet = world(1);
        let key = subject(ControllerKind::Modern, 800.0).enter(&mut meet);
        let mut other = subject(ControllerKind::Modern, 0.0);
        other.shift(Vec3 {
            x: 0.5,
            y: 0.0,
            z: 0.0,
        });
        other.enter(&mut meet);
        out.push((meet, key));
        // A load in both hands is one more unknown, and starts from the solution of the last substep.
        let mut carries = world(1);
        let mut carrier = subject(ControllerKind::Modern, 20.0);
        carrier.perturbations[0] = Perturbation::Held(in_both_hands(0.1));
        let key = carrier.enter(&mut carries);
        out.push((carries, key));
        out
    };
    let alone: Vec<Vec<u64>> = scenes()
        .into_iter()
        .map(|(mut world, key)| {
            // Run it on a thread that has never stepped another world.
            let run = move || trace(&mut world, key, 90);
            std::thread::spawn(run).join().unwrap()
        })
        .collect();
    let mut together = scenes();
    let mut got = vec![Vec::new(); alone.len()];
    let mut touched = 0;
    for tick in 0..90 {
        for ((world, key), got) in together.iter_mut().zip(&mut got) {
            world.step();
            let figure = world.figure(*key).unwrap();
            touched += figure.report().unwrap().touches.len();
            if tick % 10 == 9 {
                got.push(figure.state_hash());
            }
        }
    }
    assert_eq!(alone, got);
    // The figures moved differently, and two met.
    assert!(touched > 0);
    let mut ends: Vec<u64> = got.iter().map(|g| g[8]).collect();
    ends.sort_unstable();
    ends.dedup();
    assert_eq!(ends.len(), alone.len());
}

/// Name and hash of every golden scene.
fn golden_scenes() -> Vec<(String, u64)> {
    let mut out = Vec::new();
    for kind in KINDS {
        for (name, newtons) in [("swing_push_100N", 100.0), ("swing_fall", 800.0)] {
            let mut world = world(1);
            subject(kind, newtons).enter(&mut world);
            for _ in 0..180 {
                world.step();
            }
            let controller = format!("{kind:?}").to_lowercase();
            out.push((format!("{controller}_{name}"), world.state_hash()));
        }
    }
    let body = Arc::new(
        Body::humanoid(Profile {
            sex: Sex::Female,
            age: 68.0,
            height: 1.58,
            mass: 66.0,
        })
        .unwrap(),
    );
    let mut scene = Scene::with(
        WorldParams {
            rate_hz: 120.0,
            substeps: 4,
            gravity: 3.7,
            friction: 0.4,
            ..WorldParams::default()
        },
        figure(&body, ControllerKind::Modern, still(bent(&body, 0.5))),
    );
    scene.run(2.0, |_| ());
    out.push((
        "modern_older_woman_stands_on_mars".to_owned(),
        scene.world.state_hash(),
    ));
    out
}

#[test]
fn golden_hashes_are_kept() {
    let path = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .join("tests/golden/hashes.txt");
    let mut text = String::new();
    for (name, hash) in golden_scenes() {
        writeln!(text, "{name} {hash:016x}").unwrap();
    }
    if std::env::var_os("SINEW_MINT_GOLDEN").is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, &text).unwrap();
    }
    let want = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    assert_eq!(
        want, text,
        "the physics has changed; if that is intended, mint new hashes as described at the top of this file"
    );
}
