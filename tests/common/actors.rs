//! Figures in action, for tests that compare the bits of whole worlds. No platform mathematics.

use super::{authored, bent, figure, man, people, play, still};
use sinew_physics::body::angles::{anatomical_angles, set_anatomical_angles};
use sinew_physics::body::topology::{CHEST, DOF_NAMES, L_HAND, R_HAND};
use sinew_physics::body::{Body, Posture, Sex};
use sinew_physics::figure::{ControllerKind, FigureSetup, HeldLoad, Perturbation};
use sinew_physics::math::Vec3;
use sinew_physics::motion::Clip;
use sinew_physics::world::{FigureKey, MotionSource, World, WorldParams};
use std::sync::Arc;

/// All controllers.
pub const KINDS: [ControllerKind; 3] = [
    ControllerKind::Modern,
    ControllerKind::Paper,
    ControllerKind::Motors,
];

/// A push at the chest for a tenth of a second from `from`, s.
pub fn push(newtons: Vec3, from: f64) -> Perturbation {
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

/// A load in the right hand.
pub fn load(kg: f64, from: f64, to: f64) -> Perturbation {
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

/// Four kilograms in both hands from `from` on, s.
pub fn in_both_hands(from: f64) -> HeldLoad {
    let point = Vec3 {
        x: 0.0,
        y: 0.0,
        z: -0.08,
    };
    HeldLoad {
        segment: R_HAND,
        point,
        mass: 4.0,
        velocity: Vec3::zero(),
        second: Some((L_HAND, point)),
        grip: f64::INFINITY,
        from,
        to: f64::INFINITY,
    }
}

/// Both arms swing up and down twice over bent knees; 3 s at 60 Hz. No platform mathematics.
pub fn swing(body: &Body) -> Arc<Clip> {
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

/// A figure, its drive and its disturbances.
pub struct Actor {
    pub setup: FigureSetup,
    pub drive: MotionSource,
    pub perturbations: Vec<Perturbation>,
}

impl Actor {
    /// Moves figure and motion to another place.
    pub fn shift(&mut self, by: Vec3) {
        let p = &mut self.setup.state.posture.root_position;
        *p += by;
        if let MotionSource::Clip(play) = &mut self.drive {
            (play.origin.x, play.origin.y) = (play.origin.x + by.x, play.origin.y + by.y);
        }
    }

    /// Adds the figure to a world.
    pub fn enter(&self, world: &mut World) -> FigureKey {
        let key = world.add_figure(self.setup.clone()).unwrap();
        world.figure_mut(key).unwrap().set_drive(self.drive.clone());
        for p in &self.perturbations {
            world.perturb(key, *p).unwrap();
        }
        key
    }
}

/// Plays the swing, carries 2 kg for a while and is pushed.
pub fn subject(kind: ControllerKind, newtons: f64) -> Actor {
    let body = man();
    let clip = swing(&body);
    Actor {
        setup: figure(&body, kind, still(clip.posture(0).to_owned())),
        drive: play(&clip),
        perturbations: vec![load(2.0, 0.5, 1.4), push(Vec3::X * newtons, 1.0)],
    }
}

/// Different people performing different motions, some of them falling.
pub fn crowd(count: usize) -> Vec<Actor> {
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

/// An empty world stepped by `threads` threads.
pub fn world(threads: usize) -> World {
    World::new(WorldParams {
        threads,
        ..WorldParams::default()
    })
    .unwrap()
}
