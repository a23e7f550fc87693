//! Disturbances of a figure.

use serde::{Deserialize, Serialize};
use sinew_physics::body::SegmentId;
use sinew_physics::figure::SecondHand;
use sinew_physics::math::Vec3;

/// The second holder of a load. In bytes, the first two are an option.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum SecondSegment {
    /// None.
    Never,
    /// Another segment from the beginning, at a point as for the first.
    Holds(SegmentId, Option<Vec3>),
    /// The other hand reaches for it.
    Helps(SecondHand),
}

/// A disturbance of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Disturbance {
    /// A carried mass, kg.
    Load {
        /// Carrying segment.
        segment: SegmentId,
        /// Point, segment frame; `None`: the tip of hands and feet, else the centre of mass.
        point: Option<Vec3>,
        /// Mass, kg.
        mass: f64,
        /// Velocity before it is taken, world axes, m/s.
        velocity: Vec3,
        /// The second holder.
        second: SecondSegment,
        /// Force at one hand beyond which the load is lost, N.
        grip: f64,
        /// Duration, s; infinite until cleared.
        duration: f64,
    },
    /// A force, N, world axes. An impulse is the force that produces it over its duration.
    Force {
        /// Pushed segment.
        segment: SegmentId,
        /// Point, segment frame; `None`: the centre of mass.
        point: Option<Vec3>,
        /// Force, N.
        force: Vec3,
        /// Duration, s; infinite until cleared.
        duration: f64,
    },
}

/// A disturbance of one figure of a world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FigureDisturbance {
    /// Last part of the figure's name.
    pub figure: String,
    /// Tick at whose start it begins; `None`: the next.
    pub tick: Option<i64>,
    /// The disturbance.
    pub what: Disturbance,
}
