//! The source of a figure's desired motion.

use crate::body::{Body, Posture};
use crate::figure::motion::plan_task::{PlanRequest, PlanTask};
use crate::figure::motion::rehearsed::{RehearsedMotion, RehearsedPlayback};
use crate::motion::clip::{Clip, PlanarTransform};
use crate::motion::{Target, TargetPair};
use crate::plan::StreamPlan;
use crate::plan::motion_transition::{NextClip, TransitionClip};
use crate::track::planned_to_world::Anchor;
use crate::track::{FootPlace, StepPlan};
use serde::{Deserialize, Serialize, Serializer};
use std::sync::Arc;

/// A clip being played.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ClipPlayback {
    /// The motion.
    #[serde(with = "crate::saved::definition")]
    pub clip: Arc<Clip>,
    /// World time at which the clip's time 0 plays, s.
    pub start: f64,
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
    /// Largest help while the motion is being lost, if the figure's own limit is lower: force over the weight, 0…2.
    pub max_help: f64,
}

/// A stream that is prepared while it arrives.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct LivePlayback {
    /// The stream.
    pub motion: StreamPlan,
    /// Time of the stream minus world time, s. The caller that feeds the stream sets it so that the window lies within
    /// the part that has arrived.
    pub offset: f64,
}

impl LivePlayback {
    /// Time of the stream at world time `t`, s.
    pub fn stream_time(&self, t: f64) -> f64 {
        t + self.offset
    }
}

/// Source of the desired motion.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[allow(clippy::large_enum_variant)] // one per figure; boxing a posture would only add a pointer chase
pub enum MotionSource {
    /// Stand still in a posture.
    Hold(Posture),
    /// Play a clip.
    Clip(ClipPlayback),
    /// Targets that the caller sets before each step (live streams).
    External(Box<TargetPair>),
    /// A stream with a window: its feet are locked, its balance is kept, and its steps follow events.
    Live(Box<LivePlayback>),
    /// A rehearsed motion, with motors alone.
    Rehearsed(RehearsedPlayback),
}

impl ClipPlayback {
    /// `clip` once, at its own pace and place, with its time 0 at world time `start`, s.
    pub fn new(clip: Arc<Clip>, start: f64) -> Self {
        Self {
            clip,
            start,
            speed: 1.0,
            looped: false,
            origin: PlanarTransform::default(),
            way_in: None,
            rehearsed: None,
            max_help: 0.0,
        }
    }

    /// Whether this value is one that a checkpoint could hold.
    fn is_valid(&self) -> bool {
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

    /// Clip time at world time `t`, s.
    pub fn clip_time(&self, t: f64) -> f64 {
        (t - self.start) * self.speed
    }

    /// Desired motion at world time `t`, s. No allocation.
    pub fn sample(&self, t: f64) -> Target {
        let s = self.clip_time(t);
        let mut target = match &self.way_in {
            Some(way) if s < way.until => way.clip.sample(s - way.begin),
            _ if self.looped => self.clip.sample_looped(s),
            _ => self.clip.sample(s),
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

/// A clip that begins as soon as its figure stands.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::figure) struct QueuedClip {
    /// The clip, as it would play if it began now.
    pub play: ClipPlayback,
    /// Its steps.
    pub plan: StepPlan,
    /// Clip time at which it begins, s.
    pub first: f64,
    /// World time before which it does not begin, s.
    pub from: f64,
    /// Stance of its feet at that time, in clip coordinates. `None`: the caller fixed its origin.
    pub stance: Option<FootPlace>,
    /// Time at which the figure should stand, s.
    pub due: f64,
    /// Whether it begins standing, at the place of its figure.
    pub led: bool,
    /// The way from that stand into the clip, if the clip does not begin with it.
    pub entry: Option<ClipEntry>,
}

/// The way from a stand into a clip, while it is being planned.
#[derive(Clone, Debug, Deserialize)]
#[serde(from = "ClipEntryProblem")]
pub(in crate::figure) struct ClipEntry {
    problem: ClipEntryProblem,
    pub task: PlanTask<Option<TransitionClip>>,
}

/// The input from which [`ClipEntry`] is planned.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::figure) struct ClipEntryProblem {
    #[serde(with = "crate::saved::definition")]
    pub body: Arc<Body>,
    /// The clip, entered at clip time `first`, s.
    pub next: NextClip,
    pub first: f64,
    pub stand: Posture,
}

impl ClipEntryProblem {
    /// Whether this value is one that a checkpoint could hold.
    fn is_valid(&self) -> bool {
        self.next.is_valid() && self.first.is_finite()
    }

    /// Whether the clip begins as the figure stands, so that there is nothing to plan.
    pub fn begins(&self) -> bool {
        self.next.begins_as(&self.body, self.first, &self.stand)
    }
}

impl From<ClipEntryProblem> for ClipEntry {
    fn from(problem: ClipEntryProblem) -> Self {
        let p = problem.clone();
        Self {
            problem,
            task: PlanTask::new(move || p.next.from_stand(&p.body, p.first, &p.stand)),
        }
    }
}

impl Serialize for ClipEntry {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.problem.serialize(to)
    }
}

impl QueuedClip {
    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        let times = [self.first, self.from, self.due];
        self.play.is_valid()
            && self.plan.is_valid()
            && times.iter().all(|t| t.is_finite())
            && self.entry.as_ref().is_none_or(|e| e.problem.is_valid())
    }

    /// Requests the way into the clip, if it has to be planned.
    pub fn request(&self) -> Option<PlanRequest> {
        self.entry.as_ref()?.task.request()
    }

    /// Begins at world time `time`, for a figure whose feet stand at `stance`.
    pub fn begin(mut self, time: f64, stance: FootPlace) -> (ClipPlayback, StepPlan) {
        self.play.start = time - self.first / self.play.speed;
        if let Some(planned) = self.stance {
            self.play.origin = Anchor::between(planned, stance).transform();
        }
        (self.play, self.plan)
    }
}

impl MotionSource {
    /// Whether this value is one that a checkpoint could hold. A stream is checked later, when it is completed.
    pub(in crate::figure) fn is_valid(&self) -> bool {
        match self {
            Self::Hold(posture) => posture.is_valid(),
            Self::External(pair) => [&pair.now, &pair.next].iter().all(|t| t.state().is_valid()),
            Self::Clip(play) => play.is_valid(),
            Self::Live(live) => live.offset.is_finite(),
            Self::Rehearsed(play) => play.start.is_finite() && play.origin.is_finite(),
        }
    }

    /// Desired motion at the start and the end of a tick from `t` to `t + dt`, s.
    ///
    /// Section 3.2 of the paper.
    pub fn targets(&self, t: f64, dt: f64) -> TargetPair {
        self.pair(t, t + dt)
    }

    /// Desired motion at the world times `now` and `next`, s. Targets set by the caller are the same at all times.
    pub fn pair(&self, now: f64, next: f64) -> TargetPair {
        match self {
            Self::Hold(posture) => {
                let still = Target::still(*posture);
                TargetPair {
                    now: still.clone(),
                    next: still,
                }
            }
            Self::Clip(play) => TargetPair {
                now: play.sample(now),
                next: play.sample(next),
            },
            Self::External(pair) => (**pair).clone(),
            Self::Live(live) => TargetPair {
                now: live.motion.sample(live.stream_time(now)),
                next: live.motion.sample(live.stream_time(next)),
            },
            Self::Rehearsed(play) => TargetPair {
                now: play.sample(now),
                next: play.sample(next),
            },
        }
    }
}
