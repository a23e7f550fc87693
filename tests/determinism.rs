//! Goal: a figure's motion is a function of its input alone: the same on every run, on any number of threads, and
//! whoever else is in the world. Method: hashes over all bits of the state after a run. Golden hashes are committed in
//! `tests/golden/hashes.txt`; their scenes are built with the arithmetic of the simulation alone (no platform
//! mathematics), so they hold on every machine. After an intended change of the physics:
//! `SINEW_MINT_GOLDEN=1 cargo test --no-default-features --test determinism golden`.
#![allow(clippy::unwrap_used)]

mod common;

use common::{Scene, authored, bent, figure, man, people, play, still};
use sinew::sim::body::angles::{anatomical_angles, set_anatomical_angles};
use sinew::sim::body::topology::{CHEST, DOF_NAMES, R_HAND};
use sinew::sim::body::{Body, Posture, Profile, Sex};
use sinew::sim::figure::{ControllerKind, FigureSetup, Perturbation};
use sinew::sim::math::Vec3;
use sinew::sim::motion::Clip;
use sinew::sim::world::{Drive, FigureKey, World, WorldParams};
use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::Arc;

const KINDS: [ControllerKind; 3] = [
    ControllerKind::Modern,
    ControllerKind::Paper,
    ControllerKind::Motors,
];

fn push(newtons: Vec3, from: f64) -> Perturbation {
    Perturbation::Force {
        segment: CHEST,
        point: Vec3 {
            x: 0.0,
            y: 0.0,
            z: 0.1,
        },
        force: newtons,
        from,
        to: from + 0.1,
    }
}

fn load(kg: f64, from: f64, to: f64) -> Perturbation {
    Perturbation::Load {
        segment: R_HAND,
        point: Vec3 {
            x: 0.0,
            y: 0.0,
            z: -0.08,
        },
        mass: kg,
        from,
        to,
    }
}

/// Both arms swing up and down twice over bent knees; 3 s at 60 Hz. No platform mathematics.
fn swing(body: &Body) -> Arc<Clip> {
    let names = [
        "l_shoulder_flexion",
        "r_shoulder_flexion",
        "r_elbow_flexion",
    ];
    let dofs = names.map(|n| DOF_NAMES.iter().position(|m| *m == n).unwrap());
    let stand = bent(body, 0.35);
    let postures: Vec<Posture> = (0..=180)
        .map(|i| {
            let s = f64::from(i) / 90.0; // two strokes
            let u = (s - s.floor()).min(1.0);
            let up = 16.0 * u * u * (1.0 - u) * (1.0 - u); // 0 → 1 → 0
            let mut angles = anatomical_angles(&stand);
            for (d, reach) in dofs.iter().zip([0.9, 1.1, 0.5]) {
                angles[*d] += reach * up;
            }
            let mut posture = stand;
            set_anatomical_angles(&mut posture, &angles);
            posture
        })
        .collect();
    let planted = vec![[true; 2]; postures.len()];
    Arc::new(Clip::from_postures("swing", 60.0, postures, planted).unwrap())
}

/// A figure, its drive and what happens to it.
struct Actor {
    setup: FigureSetup,
    drive: Drive,
    perturbations: Vec<Perturbation>,
}

impl Actor {
    /// Puts figure and motion elsewhere.
    fn shift(&mut self, by: Vec3) {
        let p = &mut self.setup.state.posture.root_position;
        *p += by;
        if let Drive::Clip(play) = &mut self.drive {
            (play.origin.x, play.origin.y) = (play.origin.x + by.x, play.origin.y + by.y);
        }
    }

    fn enter(&self, world: &mut World) -> FigureKey {
        let key = world.add_figure(self.setup.clone()).unwrap();
        world.figure_mut(key).unwrap().set_drive(self.drive.clone());
        for p in &self.perturbations {
            world.perturb(key, *p).unwrap();
        }
        key
    }
}

/// Plays the swing, carries 2 kg for a while and is pushed.
fn subject(kind: ControllerKind, newtons: f64) -> Actor {
    let body = man();
    let clip = swing(&body);
    Actor {
        setup: figure(&body, kind, still(clip.posture(0).to_owned())),
        drive: play(&clip),
        perturbations: vec![load(2.0, 0.5, 1.4), push(Vec3::X * newtons, 1.0)],
    }
}

/// Different people who do different things, some of them falling.
fn crowd(count: usize) -> Vec<Actor> {
    let bodies = people(&[
        (Sex::Male, 25.0, 1.88, 92.0),
        (Sex::Female, 34.0, 1.62, 58.0),
        (Sex::Male, 61.0, 1.70, 81.0),
    ]);
    let clips: Vec<Vec<Arc<Clip>>> = bodies
        .iter()
        .map(|b| ["idle", "lift", "walk"].map(|n| authored(b, n)).to_vec())
        .collect();
    (0..count)
        .map(|i| {
            let (b, c) = (i % bodies.len(), (i / bodies.len()) % clips[0].len());
            let clip = &clips[b][c];
            let mut setup = figure(
                &bodies[b],
                KINDS[i % 7 % 3],
                still(clip.posture(0).to_owned()),
            );
            setup.strength.all = 0.4 + 0.1 * (i % 8) as f64;
            Actor {
                setup,
                drive: play(clip),
                perturbations: vec![
                    load(i as f64 % 6.0, 0.1, 2.0),
                    push(Vec3::Y * (40.0 * (i % 9) as f64 - 160.0), 0.3),
                ],
            }
        })
        .collect()
}

fn world(threads: usize) -> World {
    World::new(WorldParams {
        threads,
        ..WorldParams::default()
    })
    .unwrap()
}

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
    // Out of reach: whoever is touched does notice.
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
        // In the middle of the crowd, so that any split over threads or lanes puts others beside it; one leaves
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
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/golden/hashes.txt");
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
