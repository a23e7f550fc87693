//! The source of a figure's desired motion.

use crate::body::{Body, Posture};
use crate::figure::motion::clip_playback::ClipPlayback;
use crate::figure::motion::plan_task::{PlanRequest, PlanTask};
use crate::figure::motion::rehearsal_playback::RehearsedPlayback;
use crate::motion::{Target, TargetPair};
use crate::plan::StreamPlan;
use crate::plan::motion_transition::{NextClip, TransitionClip};
use crate::time::{MotionTime, StreamTime, WorldTime};
use crate::track::planned_to_world::Anchor;
use crate::track::{FootPlace, StepPlan};
use serde::{Deserialize, Serialize, Serializer};
use std::sync::Arc;

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
    /// Time of the stream at world time `t`.
    pub fn stream_time(&self, t: WorldTime) -> StreamTime {
        StreamTime(t.0 + self.offset)
    }

    /// Lets time `at` of the stream be due at world time `now`.
    pub fn align(&mut self, now: WorldTime, at: StreamTime) {
        self.offset = at.0 - now.0;
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

/// A clip that begins as soon as its figure stands.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::figure) struct QueuedClip {
    /// The clip, as it would play if it began now.
    pub play: ClipPlayback,
    /// Its steps.
    pub plan: StepPlan,
    /// Time of the clip at which it begins.
    pub first: MotionTime,
    /// It does not begin before this time.
    pub from: WorldTime,
    /// Stance of its feet at that time, in clip coordinates. `None`: the caller fixed its origin.
    pub stance: Option<FootPlace>,
    /// When the figure should stand.
    pub due: WorldTime,
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
    /// The clip, entered at its time `first`.
    pub next: NextClip,
    pub first: MotionTime,
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
        self.play.is_valid()
            && self.plan.is_valid()
            && self.first.is_finite()
            && self.from.is_finite()
            && self.due.is_finite()
            && self.entry.as_ref().is_none_or(|e| e.problem.is_valid())
    }

    /// Requests the way into the clip, if it has to be planned.
    pub fn request(&self) -> Option<PlanRequest> {
        self.entry.as_ref()?.task.request()
    }

    /// Begins at world time `time`, for a figure whose feet stand at `stance`.
    pub fn begin(mut self, time: WorldTime, stance: FootPlace) -> (ClipPlayback, StepPlan) {
        self.play.start = self.play.start_for(self.first, time);
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
            Self::Rehearsed(play) => play.is_valid(),
        }
    }

    /// Desired motion at the start and the end of a tick of `dt` seconds that begins at world time `t`.
    ///
    /// Section 3.2 of the paper.
    pub fn targets(&self, t: WorldTime, dt: f64) -> TargetPair {
        self.pair(t, t + dt)
    }

    /// Time of the step plan of this motion at world time `t`, s: that of the clip or of the stream. For a motion
    /// without a plan it is world time.
    pub(in crate::figure) fn plan_time(&self, t: WorldTime) -> f64 {
        match self {
            Self::Clip(play) => play.motion_time(t).0,
            Self::Live(live) => live.stream_time(t).0,
            Self::Hold(_) | Self::External(_) | Self::Rehearsed(_) => t.0,
        }
    }

    /// Desired motion at the world times `now` and `next`. Targets set by the caller are the same at all times.
    pub fn pair(&self, now: WorldTime, next: WorldTime) -> TargetPair {
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
