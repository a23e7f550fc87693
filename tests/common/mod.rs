//! Scenes shared by the tests that run whole figures: bodies, clips, one figure in a world, and its measures.
#![allow(dead_code, clippy::unwrap_used)] // every test file uses its own part

pub mod actors;
pub mod collisions;
pub mod corpus;
pub mod mocap;

use sinew_evaluate::pose::segment_poses;
use sinew_evaluate::{Metrics, RunReport, Tick};
use sinew_physics::body::angles::set_anatomical_angles;
use sinew_physics::body::topology::{DOF_NAMES, L_FOOT, R_FOOT};
use sinew_physics::body::{Body, DOF_COUNT, Posture, Profile, Sex, State};
use sinew_physics::figure::ControllerKind;
use sinew_physics::motion::builtin::builtin;
use sinew_physics::motion::{Bvh, Clip};
use sinew_physics::plan::cycle;
use sinew_physics::plan::prepare_recording;
use sinew_physics::reference::RetargetOptions;
use sinew_physics::time::WorldTime;
use sinew_physics::world::{
    ClipPlayback, Figure, FigureKey, FigureSetup, MotionSource, World, WorldParams,
};
use std::sync::Arc;

/// The reference body: a man of 30 years, 1.75 m, 75 kg.
pub fn man() -> Arc<Body> {
    Arc::new(Body::adult_man())
}

/// The synthesised recording `name` (`walk-normal.vrm`) fitted to `body`.
pub fn synthesised(body: &Body, name: &str) -> Arc<Clip> {
    let bvh = Bvh::parse(&corpus::read(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    let fitted = prepare_recording(&bvh.recording().unwrap(), body, &RetargetOptions::default());
    Arc::new(fitted.unwrap_or_else(|e| panic!("{name}: {e}")).clip)
}

/// A walk that repeats: the strides in the middle of the synthesised one.
pub fn synthesised_cycle(body: &Body) -> Arc<Clip> {
    let bvh = Bvh::parse(&corpus::piece("walk-normal.vrm", 1.8, 5.4)).unwrap();
    let clip = prepare_recording(&bvh.recording().unwrap(), body, &RetargetOptions::default())
        .unwrap()
        .clip;
    Arc::new(cycle(body, &clip).expect("a walk repeats"))
}

/// The recording `name` fitted to `body`; panics if the data set is missing.
pub fn recorded(body: &Body, name: &str) -> Arc<Clip> {
    recorded_with(body, name, &RetargetOptions::default())
}

/// [`recorded`], fitted with `options`.
pub fn recorded_with(body: &Body, name: &str, options: &RetargetOptions) -> Arc<Clip> {
    let bvh =
        Bvh::parse(&mocap::read(&format!("{name}.bvh"))).unwrap_or_else(|e| panic!("{name}: {e}"));
    let fitted = prepare_recording(&bvh.recording().unwrap(), body, options);
    Arc::new(fitted.unwrap_or_else(|e| panic!("{name}: {e}")).clip)
}

/// People of these sexes, ages, heights (m) and masses (kg).
pub fn people(profiles: &[(Sex, f64, f64, f64)]) -> Vec<Arc<Body>> {
    profiles
        .iter()
        .map(|&(sex, age, height, mass)| {
            let profile = Profile {
                sex,
                age,
                height,
                mass,
            };
            Arc::new(Body::humanoid(profile).unwrap())
        })
        .collect()
}

/// The built-in motion `name` for `body`.
pub fn authored(body: &Body, name: &str) -> Arc<Clip> {
    Arc::new(builtin(body, name).unwrap_or_else(|| panic!("no built-in motion {name}")))
}

/// A state at rest in `posture`.
pub fn still(posture: Posture) -> State {
    State::at_rest(posture)
}

/// A figure of human strength with default gains.
pub fn figure(body: &Arc<Body>, controller: ControllerKind, state: State) -> FigureSetup {
    FigureSetup {
        name: "figure".to_owned(),
        ..FigureSetup::new(Arc::clone(body), controller, state)
    }
}

/// `clip` from world time 0 on, once.
pub fn play(clip: &Arc<Clip>) -> MotionSource {
    MotionSource::Clip(ClipPlayback::new(Arc::clone(clip), WorldTime(0.0)))
}

/// A world (60 ticks/s, two substeps) with one figure.
pub struct Scene {
    /// The world.
    pub world: World,
    /// Its figure.
    pub key: FigureKey,
}

impl Scene {
    /// One figure as described, holding the posture it starts in.
    pub fn of(setup: FigureSetup) -> Self {
        Self::with(WorldParams::default(), setup)
    }

    /// [`Self::of`] in a world with other parameters.
    pub fn with(params: WorldParams, setup: FigureSetup) -> Self {
        let mut world = World::new(params).unwrap();
        let key = world.add_figure(setup).unwrap();
        Self { world, key }
    }

    /// One figure that starts in the first posture of `clip`, with its velocity, and plays it.
    pub fn playing(body: &Arc<Body>, controller: ControllerKind, clip: &Arc<Clip>) -> Self {
        let first = clip.sample(0.0);
        let state = first.state();
        let mut scene = Self::of(figure(body, controller, state));
        scene.figure_mut().set_drive(play(clip));
        scene
    }

    /// The figure.
    pub fn figure(&self) -> &Figure {
        self.world.figure(self.key).unwrap()
    }

    /// The figure, to change its drive.
    pub fn figure_mut(&mut self) -> &mut Figure {
        self.world.figure_mut(self.key).unwrap()
    }

    /// Number of ticks in `seconds`.
    pub fn ticks(&self, seconds: f64) -> u64 {
        (seconds * self.world.params().rate_hz).round() as u64
    }

    /// Runs for `seconds`; `each` sees the scene after every tick.
    pub fn run(&mut self, seconds: f64, mut each: impl FnMut(&Self)) {
        for _ in 0..self.ticks(seconds) {
            self.world.step();
            each(self);
        }
    }

    /// Runs for `seconds` and measures.
    pub fn measure(&mut self, seconds: f64) -> RunReport {
        let mut metrics = Metrics::new(
            self.world.params().rate_hz,
            &self.figure().state().posture.clone(),
        );
        self.run(seconds, |scene| metrics.observe(scene.tick(), 0.0));
        metrics.finish(self.world.state_hash())
    }

    /// The figure's report of the last tick.
    pub fn tick(&self) -> Tick<'_> {
        let figure = self.figure();
        Tick::of(figure, self.world.params().gravity)
    }
}

/// Knees bent by `2·bend` rad over flat feet, trunk upright, arms hanging; ankles below the world origin, soles on the
/// floor.
///
/// Made with the arithmetic of the simulation alone, so that it has the same bits on every machine.
pub fn bent(body: &Body, bend: f64) -> Posture {
    let mut angles = [0.0; DOF_COUNT];
    for side in ["l", "r"] {
        let mut set = |joint: &str, angle: f64| {
            let name = format!("{side}_{joint}");
            angles[DOF_NAMES.iter().position(|n| *n == name).unwrap()] = angle;
        };
        set("hip_flexion", bend);
        set("knee_flexion", 2.0 * bend);
        set("ankle_flexion", bend);
        set("elbow_flexion", 0.3);
    }
    let mut posture = Posture::default();
    set_anatomical_angles(&mut posture, &angles);
    on_floor(body, &mut posture);
    posture
}

/// Shifts a posture so that its lowest point is on the floor and the mean of its ankles above the world origin.
pub fn on_floor(body: &Body, posture: &mut Posture) {
    let poses = segment_poses(&body.joint_offset, posture);
    let ankles = (poses[L_FOOT.index()].position + poses[R_FOOT.index()].position) * 0.5;
    let mut lowest = f64::INFINITY;
    for (segment, pose) in body.segments.iter().zip(&poses) {
        for p in &segment.contact_points {
            lowest = lowest.min(pose.point(*p).z);
        }
    }
    posture.root_position.x -= ankles.x;
    posture.root_position.y -= ankles.y;
    posture.root_position.z -= lowest;
}
