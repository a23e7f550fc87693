//! Everything that changes a world between ticks, as values.
//!
//! A change takes effect only through [`Scene::apply`](super::Scene::apply), so a live world, one that is brought back
//! and one that is replayed run the same code. Two things come in each tick and have a form of their own in the record
//! ([`record`](super::record)): frames of desired motion as they arrived, and the plans that were late.

use crate::engine::{Clip, FigureKey, ObstacleKey};
use serde::{Deserialize, Serialize};
use sinew_physics::body::Body;
use sinew_physics::collide::ObstacleSetup;
use sinew_physics::world::RehearsedMotion;
use sinew_wire::types::{
    ClipBeginning, DriveSettings, FigureDisturbance, FigureSettings, FigureUpdate, Place, Playback,
    WorldPace,
};
use std::sync::Arc;

/// Number of a player in its scene. No number is assigned twice.
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
        /// The body, if available; otherwise it is built from its profile.
        #[serde(skip)]
        body: Option<Arc<Body>>,
    },
    /// A figure is removed, together with its players.
    RemoveFigure(FigureKey),
    /// New settings of a figure.
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
        /// Its rehearsal for a figure like this one.
        #[serde(with = "sinew_physics::saved::definition::option")]
        rehearsed: Option<Arc<RehearsedMotion>>,
        /// The manner of playing it.
        playback: Playback,
    },
    /// A figure finishes its step and stands.
    Stop(FigureKey),
    /// Loads and forces, all or none.
    Perturb(Vec<FigureDisturbance>),
    /// A figure is freed of loads and forces.
    ClearPerturbations(FigureKey),
    /// A new obstacle.
    AddObstacle {
        /// Last part of its name.
        id: String,
        /// The obstacle.
        setup: ObstacleSetup,
    },
    /// An obstacle replaces another one.
    UpdateObstacle(ObstacleKey, ObstacleSetup),
    /// An obstacle is removed.
    RemoveObstacle(ObstacleKey),
    /// Live motion begins to play to a figure.
    Follow {
        /// Figure.
        figure: FigureKey,
        /// The settings of its playback.
        settings: DriveSettings,
        /// Window in which it is prepared, s; 0: none.
        window: f64,
        /// Time over which the figure changes from its present player to this one, s, once the motion has arrived.
        takeover: Option<f64>,
    },
    /// Live motion no longer plays to a figure, which continues what it does.
    Unfollow(PlayerKey),
}

/// The result of an input.
#[derive(Clone, Debug)]
pub enum InputResult {
    /// Nothing that needs an answer.
    Changed,
    /// A new figure has this key.
    Figure(FigureKey),
    /// A new obstacle has this name and key.
    Obstacle(String, ObstacleKey),
    /// A clip begins like this.
    Begins(ClipBeginning),
    /// A new player has this key.
    Player(PlayerKey),
}
