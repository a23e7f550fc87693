//! Everything that changes a world between ticks, as values.
//!
//! [`Scene::apply`](super::Scene::apply) is the only way by which one of them takes effect, so a world that is driven
//! now, one that is brought back and one that is replayed go through the same code. Two things come in each tick and
//! have a form of their own in the record ([`record`](super::record)): frames of desired motion as they arrived, and
//! which plans were late.

use crate::engine::{Clip, FigureKey, ObstacleKey};
use serde::{Deserialize, Serialize};
use sinew_physics::body::Body;
use sinew_physics::collide::ObstacleSetup;
use sinew_physics::world::RehearsedMotion;
use sinew_wire::types::{
    DriveSettings, FigureDisturbance, FigureSettings, FigureUpdate, Place, Playback, WorldPace,
};
use std::sync::Arc;

/// Number of a player in its scene: none is given twice.
pub type PlayerKey = u64;

/// A change of a world.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum SceneInput {
    /// Name for people, speed and overrun policy.
    Pace(WorldPace),
    /// A new figure, standing at its place.
    AddFigure {
        /// Last part of its name.
        id: String,
        /// Settings.
        settings: Box<FigureSettings>,
        /// The body, where it is at hand; it follows from its profile.
        #[serde(skip)]
        body: Option<Arc<Body>>,
    },
    /// A figure is gone, with what plays to it.
    RemoveFigure(FigureKey),
    /// Other settings of a figure.
    UpdateFigure(FigureKey, Box<FigureUpdate>),
    /// A figure stands still at a place, without loads.
    ResetFigure(FigureKey, Option<Place>),
    /// A figure plays a clip.
    Play {
        /// Figure.
        figure: FigureKey,
        /// Last part of the name of the clip.
        name: String,
        /// The clip, prepared for its body.
        #[serde(with = "sinew_physics::saved::definition")]
        clip: Arc<Clip>,
        /// How.
        playback: Playback,
    },
    /// A figure finishes its step and stands.
    Stop(FigureKey),
    /// Loads and forces, all or none.
    Perturb(Vec<FigureDisturbance>),
    /// A figure is free of loads and forces.
    ClearPerturbations(FigureKey),
    /// A new obstacle.
    AddObstacle {
        /// Last part of its name.
        id: String,
        /// The obstacle.
        setup: ObstacleSetup,
    },
    /// Another obstacle in the place of one.
    UpdateObstacle(ObstacleKey, ObstacleSetup),
    /// An obstacle is gone.
    RemoveObstacle(ObstacleKey),
    /// Live motion begins to be played to a figure.
    Follow {
        /// Figure.
        figure: FigureKey,
        /// How its motion is played.
        settings: DriveSettings,
        /// Window in which it is prepared, s; 0: none.
        window: f64,
        /// The figure goes over from what is played to it, in so many seconds, once its own motion is there.
        takeover: Option<f64>,
    },
    /// Live motion is no longer played to a figure, which goes on with what it does.
    Unfollow(PlayerKey),
    /// Plays the most recently requested clip from its rehearsal, provided that the clip starts from a stand.
    Rehearsed {
        /// Figure.
        figure: FigureKey,
        /// The rehearsal.
        #[serde(with = "sinew_physics::saved::definition")]
        motion: Arc<RehearsedMotion>,
    },
}

/// The result of an input.
#[derive(Clone, Debug)]
pub enum InputResult {
    /// Nothing that has to be told.
    Changed,
    /// A figure of this key.
    Figure(FigureKey),
    /// An obstacle of this name and key.
    Obstacle(String, ObstacleKey),
    /// A clip begins at this world time, s.
    Begins(f64),
    /// A player of this key.
    Player(PlayerKey),
}
