//! Scenes shared by the tests that run whole figures: bodies, clips, one figure in a world, and its measures.
#![allow(dead_code, clippy::unwrap_used)] // every test file uses its own part

use sinew::evaluate::pose::segment_poses;
use sinew::evaluate::{Metrics, RunReport, Tick};
use sinew::sim::body::angles::set_anatomical_angles;
use sinew::sim::body::topology::{DOF_NAMES, L_FOOT, R_FOOT};
use sinew::sim::body::{Body, DOF_COUNT, Posture, State};
use sinew::sim::figure::{
    ControlParams, ControllerKind, FigureOptions, StepperKind, StrengthScale,
};
use sinew::sim::motion::builtin::builtin;
use sinew::sim::motion::retarget::{RetargetOptions, retarget};
use sinew::sim::motion::{Bvh, Clip, PlanarTransform};
use sinew::sim::world::{ClipPlayback, Drive, Figure, FigureKey, FigureSetup, World, WorldParams};
use std::path::PathBuf;
use std::sync::Arc;

/// All recordings of the data set.
pub const CLIPS: [&str; 18] = [
    "carry",
    "dance",
    "fall-rise",
    "get-up",
    "hit",
    "idle",
    "jump",
    "lift",
    "punch",
    "quick-stop",
    "run",
    "salsa-a",
    "salsa-b",
    "sit-stand",
    "turn",
    "walk",
    "walk-around",
    "wave",
];

/// The reference body: a man of 30 years, 1.75 m, 75 kg.
pub fn man() -> Arc<Body> {
    Arc::new(Body::adult_man())
}

/// The recording `name` fitted to `body`; panics if the data set is missing.
pub fn recorded(body: &Body, name: &str) -> Arc<Clip> {
    recorded_with(body, name, &RetargetOptions::default())
}

/// The same, fitted as `options` say.
pub fn recorded_with(body: &Body, name: &str, options: &RetargetOptions) -> Arc<Clip> {
    let folder = std::env::var_os("SINEW_MOCAP_DIR").map_or_else(
        || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/mocap"),
        PathBuf::from,
    );
    let path = folder.join(format!("{name}.bvh"));
    let bytes = std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let bvh = Bvh::parse(&bytes).unwrap_or_else(|e| panic!("{name}: {e}"));
    let fitted = retarget(&bvh, body, options);
    Arc::new(fitted.unwrap_or_else(|e| panic!("{name}: {e}")).clip)
}

/// The built-in motion `name` for `body`.
pub fn authored(body: &Body, name: &str) -> Arc<Clip> {
    Arc::new(builtin(body, name).unwrap_or_else(|| panic!("no built-in motion {name}")))
}

/// At rest in `posture`.
pub fn still(posture: Posture) -> State {
    State {
        posture,
        ..State::default()
    }
}

/// A figure of human strength with default gains.
pub fn figure(body: &Arc<Body>, controller: ControllerKind, state: State) -> FigureSetup {
    FigureSetup {
        name: "figure".to_owned(),
        body: Arc::clone(body),
        strength: StrengthScale::default(),
        controller,
        stepper: StepperKind::Torque,
        params: ControlParams::default(),
        options: FigureOptions::default(),
        state,
    }
}

/// `clip` from world time 0 on, once.
pub fn play(clip: &Arc<Clip>) -> Drive {
    Drive::Clip(ClipPlayback {
        clip: Arc::clone(clip),
        start: 0.0,
        speed: 1.0,
        looped: false,
        origin: PlanarTransform::default(),
    })
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

    /// The same in a world of other parameters.
    pub fn with(params: WorldParams, setup: FigureSetup) -> Self {
        let mut world = World::new(params).unwrap();
        let key = world.add_figure(setup).unwrap();
        Self { world, key }
    }

    /// One figure that starts in the first posture of `clip`, with its velocity, and plays it.
    pub fn playing(body: &Arc<Body>, controller: ControllerKind, clip: &Arc<Clip>) -> Self {
        let first = clip.sample(0.0);
        let state = State {
            posture: first.posture,
            velocity: first.velocity,
        };
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

    /// What the last tick shows of the figure.
    pub fn tick(&self) -> Tick<'_> {
        let figure = self.figure();
        Tick {
            body: figure.body(),
            links: figure.links(),
            target: figure.target(),
            report: figure.report().unwrap(),
            state: figure.state(),
            strength: (figure.strength(), figure.muscles()),
            gravity: self.world.params().gravity,
        }
    }
}

/// Knees bent by `2·bend` rad over flat feet, trunk upright, arms hanging; ankles below the world origin, soles on the floor.
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
