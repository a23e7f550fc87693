//! A clip being played: its place, its pace and its beginning.

use crate::figure::motion::rehearsed::RehearsedMotion;
use crate::motion::Target;
use crate::motion::clip::{Clip, PlanarTransform};
use crate::plan::motion_transition::{NextClip, TransitionClip};
use crate::time::{MotionTime, WorldTime};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A clip being played.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ClipPlayback {
    /// The motion.
    #[serde(with = "crate::saved::definition")]
    pub clip: Arc<Clip>,
    /// When the clip's time 0 plays.
    pub start: WorldTime,
    /// Clip seconds per world second, 0.1…10.
    pub speed: f64,
    /// Starts over at the end, with the displacement of the root carried on.
    pub looped: bool,
    /// Place of the clip's origin in the world.
    pub origin: PlanarTransform,
    /// How the figure came into it, if it came from another motion without standing in between, or from a stand unlike
    /// its beginning.
    #[serde(with = "crate::saved::definition::option")]
    pub way_in: Option<Arc<TransitionClip>>,
    /// A rehearsal of this clip, played in its place if the figure stands where the clip starts. Same coordinates as
    /// the clip.
    #[serde(with = "crate::saved::definition::option")]
    pub rehearsed: Option<Arc<RehearsedMotion>>,
    /// Whether it has begun again because the figure had to step out of it.
    pub again: bool,
    /// Largest help while the motion is being lost, if the figure's own limit is lower: force over the weight, 0…2.
    pub max_help: f64,
}

impl ClipPlayback {
    /// `clip` once, at its own pace and place, with its time 0 at world time `start`.
    pub fn new(clip: Arc<Clip>, start: WorldTime) -> Self {
        Self {
            clip,
            start,
            speed: 1.0,
            looped: false,
            origin: PlanarTransform::default(),
            way_in: None,
            rehearsed: None,
            again: false,
            max_help: 0.0,
        }
    }

    /// Whether this value is one that a checkpoint could hold.
    pub(in crate::figure) fn is_valid(&self) -> bool {
        self.start.is_finite()
            && self.origin.is_finite()
            && (0.0..=2.0).contains(&self.max_help)
            && self.motion().is_valid()
            && self.way_in.as_ref().is_none_or(|way| way.is_valid())
    }

    /// The motion, without place and time.
    pub(in crate::figure) fn motion(&self) -> NextClip {
        NextClip {
            clip: Arc::clone(&self.clip),
            speed: self.speed,
            looped: self.looped,
        }
    }

    /// Time of the clip at world time `t`.
    pub fn motion_time(&self, t: WorldTime) -> MotionTime {
        MotionTime((t - self.start) * self.speed)
    }

    /// The inverse of [`Self::motion_time`]: when time `t` of the clip plays.
    pub(in crate::figure) fn world_time(&self, t: MotionTime) -> WorldTime {
        self.start + t.0 / self.speed
    }

    /// The start with which time `t` of the clip plays at world time `at`.
    pub(in crate::figure) fn start_for(&self, t: MotionTime, at: WorldTime) -> WorldTime {
        at - t.0 / self.speed
    }

    /// Desired motion at world time `t`. No allocation.
    pub fn sample(&self, t: WorldTime) -> Target {
        let s = self.motion_time(t);
        let mut target = match &self.way_in {
            Some(way) if s < way.until => way.clip.sample(s - way.begin),
            _ if self.looped => self.clip.sample_looped(s.0),
            _ => self.clip.sample(s.0),
        };
        for v in &mut target.velocity {
            *v *= self.speed;
        }
        for a in &mut target.acceleration {
            *a *= self.speed * self.speed;
        }
        self.origin.apply_to(&mut target);
        target
    }
}
