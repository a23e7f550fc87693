//! The activity of a figure, and every transition from one activity to the next.
//!
//! ```text
//!   Hold, Track ──play, stop──► Switch ──the next motion has begun──► Track, Hold
//!        │                         │
//!        └──────────fall───────────┤
//!                                  ▼
//!   Hold, Track, Switch ◄─rise─── Limp ──get up──► GetUp ──stand up──► Hold, Switch
//!                                  ▲                 │
//!                                  └─────give up─────┘
//! ```
//!
//! Replacing the motion as a whole ([`MotionState::follow`]) ends a switch, and getting up, at once.

use crate::body::Posture;
use crate::figure::motion::exit::ExitPlan;
use crate::figure::motion::following::{FollowMode, Following};
use crate::figure::motion::rehearsal_playback::RehearsedPlayback;
use crate::figure::motion::source::{MotionSource, QueuedClip};
use crate::figure::motion::stream_entry::StreamEntryPlan;
use serde::{Deserialize, Serialize};

/// The activity of a figure.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::figure) enum Activity {
    /// Hold a posture.
    Hold,
    /// Track a clip, a stream, or the targets that the caller sets.
    Track,
    /// Leave the motion for a stand, or for another clip.
    Switch(Switch),
    /// Lie on the floor, relaxed. The motion continues, since it decides when the figure gets up.
    Limp(Switch),
    /// Get up. A queued clip waits until the figure stands.
    GetUp(Switch),
}

/// A switch to another motion; empty if there is none.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(in crate::figure) struct Switch {
    /// The exit from the present motion, while it is planned.
    pub exit: Option<Box<ExitPlan>>,
    /// The present motion leads to a stand.
    pub stops: bool,
    /// The clip that begins next.
    pub next: Option<Box<QueuedClip>>,
    /// The way into a stream that begins in motion, while it is planned.
    pub stream: Option<Box<StreamEntryPlan>>,
}

impl Switch {
    fn is_empty(&self) -> bool {
        self.exit.is_none() && !self.stops && self.next.is_none() && self.stream.is_none()
    }
}

/// The activity of a figure, and the source of its desired motion.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::figure) struct MotionState {
    source: MotionSource,
    activity: Activity,
    following: Following,
}

impl MotionState {
    /// Standing in a posture.
    pub fn hold(posture: Posture) -> Self {
        Self {
            source: MotionSource::Hold(posture),
            activity: Activity::Hold,
            following: Following::default(),
        }
    }

    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        let next = self.next().is_none_or(QueuedClip::is_valid);
        let entry = self.stream_entry().is_none_or(StreamEntryPlan::is_valid);
        self.source.is_valid() && next && entry && self.following.is_valid()
    }

    /// Source of the desired motion.
    pub fn source(&self) -> &MotionSource {
        &self.source
    }

    /// Source of the desired motion, to feed or to advance a stream.
    pub fn source_mut(&mut self) -> &mut MotionSource {
        &mut self.source
    }

    /// Whether the figure has fallen and not yet stood up again.
    pub fn has_fallen(&self) -> bool {
        matches!(self.activity, Activity::Limp(_) | Activity::GetUp(_))
    }

    /// Whether it lies without getting up.
    pub fn is_limp(&self) -> bool {
        matches!(self.activity, Activity::Limp(_))
    }

    /// Whether it is getting up.
    pub fn gets_up(&self) -> bool {
        matches!(self.activity, Activity::GetUp(_))
    }

    /// The rehearsed motion being played. `None` while the figure is down, even if one is queued.
    pub fn rehearsed(&self) -> Option<&RehearsedPlayback> {
        match (&self.source, &self.activity) {
            (MotionSource::Rehearsed(play), Activity::Track) => Some(play),
            _ => None,
        }
    }

    /// How the motion is followed.
    pub fn following(&self) -> &Following {
        &self.following
    }

    /// Notes how the motion was followed in a tick of `dt` s: helped by a moment (N·m) and a force (N) of these norms,
    /// for a body of this weight, N.
    pub fn note(&mut self, mode: FollowMode, help: [f64; 2], weight: f64, dt: f64) {
        self.following.add(mode, help, weight, dt);
    }

    /// Forgets how the motion was followed.
    pub fn forget_following(&mut self) {
        self.following = Following::default();
    }

    fn switch(&self) -> Option<&Switch> {
        match &self.activity {
            Activity::Hold | Activity::Track => None,
            Activity::Switch(s) | Activity::Limp(s) | Activity::GetUp(s) => Some(s),
        }
    }

    /// The exit that is being planned.
    pub fn exit(&self) -> Option<&ExitPlan> {
        self.switch()?.exit.as_deref()
    }

    /// Whether the present motion leads to a stand.
    pub fn stops(&self) -> bool {
        self.switch().is_some_and(|s| s.stops)
    }

    /// The clip that begins next.
    pub fn next(&self) -> Option<&QueuedClip> {
        self.switch()?.next.as_deref()
    }

    /// The way into a stream that is being planned.
    pub fn stream_entry(&self) -> Option<&StreamEntryPlan> {
        self.switch()?.stream.as_deref()
    }

    /// Changes the switch. A figure that stands or moves gets the activity that results.
    fn change<T>(&mut self, change: impl FnOnce(&mut Switch) -> T) -> T {
        let mut switch = match &mut self.activity {
            Activity::Hold | Activity::Track => Switch::default(),
            Activity::Switch(s) | Activity::Limp(s) | Activity::GetUp(s) => std::mem::take(s),
        };
        let out = change(&mut switch);
        self.activity = match self.activity {
            Activity::Limp(_) => Activity::Limp(switch),
            Activity::GetUp(_) => Activity::GetUp(switch),
            _ => self.upright(switch),
        };
        out
    }

    /// The activity of a figure that has not fallen.
    fn upright(&self, switch: Switch) -> Activity {
        match &self.source {
            _ if !switch.is_empty() => Activity::Switch(switch),
            MotionSource::Hold(_) => Activity::Hold,
            MotionSource::Clip(_)
            | MotionSource::External(_)
            | MotionSource::Live(_)
            | MotionSource::Rehearsed(_) => Activity::Track,
        }
    }

    // ── the motion ──

    /// Replaces the motion as a whole. Any switch, and getting up, ends.
    pub fn follow(&mut self, source: MotionSource) {
        match (&self.source, &source) {
            // A held posture is the end of a motion, and targets of a stream are one motion.
            (_, MotionSource::Hold(_)) | (MotionSource::External(_), MotionSource::External(_)) => {
            }
            _ => self.following = Following::default(),
        }
        self.source = source;
        self.lie_down();
        self.change(|s| *s = Switch::default());
    }

    /// Queues a clip to begin next.
    pub fn queue(&mut self, next: QueuedClip) {
        self.change(|s| {
            s.next = Some(Box::new(next));
            s.stream = None;
        });
    }

    /// Plans the way into a stream, which begins next.
    pub fn plan_stream_entry(&mut self, entry: StreamEntryPlan) {
        self.change(|s| {
            s.next = None;
            s.stream = Some(Box::new(entry));
        });
    }

    /// Changes the way into a stream that is being planned.
    pub fn update_stream_entry(&mut self, update: impl FnOnce(&mut StreamEntryPlan)) {
        self.change(|s| s.stream.as_deref_mut().map(update));
    }

    /// Takes the way into a stream that is being planned, to follow it or to forget it.
    pub fn take_stream_entry(&mut self) -> Option<StreamEntryPlan> {
        self.change(|s| s.stream.take()).map(|entry| *entry)
    }

    /// Changes the clip that begins next.
    pub fn update_next(&mut self, update: impl FnOnce(&mut QueuedClip)) {
        self.change(|s| s.next.as_deref_mut().map(update));
    }

    /// Takes the clip that begins next, to begin it or to forget it.
    pub fn take_next(&mut self) -> Option<QueuedClip> {
        self.change(|s| s.next.take()).map(|next| *next)
    }

    /// Plans an exit from the motion; with `None` the motion continues.
    pub fn plan_exit(&mut self, exit: Option<ExitPlan>) {
        self.change(|s| s.exit = exit.map(Box::new));
    }

    /// Takes the exit that is being planned, to follow it or to forget it.
    pub fn take_exit(&mut self) -> Option<ExitPlan> {
        self.change(|s| s.exit.take()).map(|exit| *exit)
    }

    /// Switches to a clip: the switch is complete.
    pub fn enter(&mut self, clip: MotionSource) {
        self.following = Following::default();
        self.source = clip;
        self.change(|s| s.stops = false);
    }

    /// Switches to the steps that lead to a stand.
    pub fn follow_to_stand(&mut self, steps: MotionSource) {
        self.source = steps;
        self.change(|s| s.stops = true);
    }

    // ── falling and getting up ──

    /// Falls: from any upright activity.
    pub fn fall(&mut self) {
        if !self.has_fallen() {
            let switch = self.change(std::mem::take);
            self.activity = Activity::Limp(switch);
        }
    }

    /// Stands again without having got up by itself: its motion continues.
    pub fn rise(&mut self) {
        if self.has_fallen() {
            let switch = self.change(std::mem::take);
            self.activity = self.upright(switch);
        }
    }

    /// Begins to get up, which leads to a stand.
    pub fn begin_to_get_up(&mut self) {
        if let Activity::Limp(switch) = &mut self.activity {
            let switch = std::mem::take(switch);
            self.activity = Activity::GetUp(Switch {
                stops: true,
                ..switch
            });
        }
    }

    /// Abandons getting up; another attempt may follow.
    pub fn give_up(&mut self) {
        self.lie_down();
        self.change(|s| s.stops = false);
    }

    /// Lies relaxed again, if it was getting up.
    pub fn lie_down(&mut self) {
        if self.gets_up() {
            let switch = self.change(std::mem::take);
            self.activity = Activity::Limp(switch);
        }
    }

    /// Has got up: holds the posture that it has reached. A queued clip is kept.
    pub fn stand_up(&mut self, posture: Posture) {
        self.source = MotionSource::Hold(posture);
        let switch = self.change(std::mem::take);
        self.activity = self.upright(Switch {
            next: switch.next,
            ..Switch::default()
        });
    }
}
