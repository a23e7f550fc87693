//! From one motion to another while the figure moves: what is under way is led to a stand, and what was asked for waits until it stands.

use super::judgement::FEET;
use super::{Figure, TickContext};
use crate::sim::body::Posture;
use crate::sim::control::Controller;
use crate::sim::figure::drive::{ClipPlayback, Drive, Queued};
use crate::sim::figure::planning::Plan;
use crate::sim::figure::setup::ControllerKind;
use crate::sim::gait::StepPlan;
use crate::sim::motion::Clip;
use crate::sim::motion::join::{self, Ends, RUN_UP, Sample};
use std::sync::Arc;

/// How far ahead a clip is looked at for a place to stop, s.
const STOP_AHEAD: f64 = 0.8;
/// Samples that still play before a motion is led to a stop that is worked out at once, and aside: the time that there is for it.
const AT_ONCE: usize = 3;
const ASIDE: usize = 4;
/// A clip that waits begins so long before the motion that leads to it is over, if the figure has settled, s.
const SOONER: f64 = 0.4;
/// It begins at the latest so long after that motion is over, s.
const PATIENCE: f64 = 2.0;
/// A body slower than this is led into the posture in which the next clip begins; a faster one comes to its ease first, m/s.
const SLOW: f64 = 0.2;
/// A clip that begins with the pelvis above this share of its standing height, on both feet, begins standing.
const UPRIGHT: f64 = 0.9;
/// Who gets up stands once the centre of mass is above this share of its standing height.
const UP: f64 = 0.75;

/// What a stop is planned from.
struct Given {
    /// World time of the first sample, and time of the present motion then, s.
    begin: f64,
    before: f64,
    /// Sample up to which it still plays.
    now: usize,
    streamed: bool,
}

/// A way to a stand that is worked out aside.
#[derive(Debug)]
pub(super) struct Stopping {
    ends: Vec<Plan<Option<(f64, Clip)>>>,
    /// When the motion turns from its own way to that one, s.
    due: f64,
    /// World time of the first sample of that way, and time of the present motion then, s.
    begin: f64,
    before: f64,
}

impl Figure {
    /// Plays a clip from world time `time` on. A figure that walks, or is in the middle of another clip, finishes its step and stands first, as
    /// the clip begins; then the clip begins where its feet are, unless `fixed` says that its origin is meant. One that stands already, has
    /// fallen, or makes no steps begins at once. Returns the world time at which the clip's time 0 plays, s: expected, if the figure has to
    /// stand first. Then the way to the stand is worked out at once: tens of milliseconds.
    pub fn play(&mut self, play: ClipPlayback, fixed: bool, time: f64) -> f64 {
        if !self.rising.is_rising() && (!self.steps() || !self.is_busy(time)) {
            let start = play.start;
            self.set_drive(Drive::Clip(play));
            return start;
        }
        self.follow_stop();
        let lead = play.clip.lead_in();
        let first = play.clip_time(time).clamp(-lead, 0.0);
        let begin = play.clip.sample(first);
        let holds = matches!(self.drive, Drive::Hold(_) | Drive::External(_));
        if !self.ending && !holds {
            let upright =
                begin.posture.root_position.z > UPRIGHT * self.setup.body.standing_root_height();
            let goal = (upright && begin.planted == [true; 2]).then_some(&begin.posture);
            self.end_motion(time, goal.copied());
        }
        let due = match &self.drive {
            Drive::Clip(end) if self.ending => end.start + end.clip.duration() + self.gait.lag(),
            _ => time,
        };
        let from = play.start + first / play.speed;
        let plan = StepPlan::new(&self.setup.body, &play.clip, play.looped);
        let stance = self.gait.stance_of(&self.setup.body, &begin.posture);
        let expected = due.max(from) - first / play.speed;
        self.queued = Some(Box::new(Queued {
            plan,
            first,
            from,
            stance: (!fixed).then_some(stance),
            due,
            play,
        }));
        expected
    }

    /// The clip that begins as soon as the figure stands, if one waits.
    pub fn next_clip(&self) -> Option<&Arc<Clip>> {
        self.queued.as_ref().map(|q| &q.play.clip)
    }

    /// True in the middle of a clip or of a step.
    fn is_busy(&self, time: f64) -> bool {
        let plays = match &self.drive {
            Drive::Clip(play) => {
                let over = play.clip.duration() + play.clip.lead_out();
                play.looped || play.clip_time(time - self.gait.lag()) < over
            }
            Drive::Live(_) => self.gait.is_walking(),
            Drive::Hold(_) | Drive::External(_) => false,
        };
        plays || self.stopping.is_some() || self.gait.unplanned().is_some()
    }

    /// Begins the clip that waits, once the figure stands.
    pub(super) fn begin_queued(&mut self, time: f64) {
        let Some(q) = &self.queued else { return };
        let ready = if self.rising.is_rising() || (self.balance.lost() && !self.fallen) {
            false
        } else if !self.steps() || time > q.due + PATIENCE {
            true
        } else {
            time >= q.from.max(q.due - SOONER) && self.gait.is_settled(&self.terms)
        };
        if !ready {
            return;
        }
        let stance = self.gait.stance(&self.terms);
        if let Some(q) = self.queued.take() {
            let (play, plan) = q.begin(time, stance);
            self.gait.follow(Some((plan, play.speed, play.origin)));
            self.drive = Drive::Clip(play);
            self.ending = false;
            self.rising.reset();
        }
    }

    /// A fallen figure gets up when its motion, which lay down, does: in its own way, after which it stands. What it is asked to do meanwhile waits.
    pub(super) fn get_up(&mut self) {
        let able = self.setup.controller == ControllerKind::Modern;
        if !self.fallen || !able || self.setup.options.assist >= 1.0 {
            self.rising.reset();
            return;
        }
        let com = &self.pending.tasks.com.now;
        let height = com.z / self.standing_com_height;
        let before = self.rising.is_rising();
        self.rising.watch(&self.terms, height);
        if before != self.rising.is_rising() {
            self.modern.reset();
            self.ending = !before;
        }
        if self.rising.is_up() && self.stands_on_feet() {
            self.stand_up();
        }
    }

    /// It stands: it holds what it has come to.
    fn stand_up(&mut self) {
        self.drive = Drive::Hold(self.target.next.posture);
        self.rising.reset();
        self.stopping = None;
        self.gait.follow(None);
        self.fallen = false;
        self.start_afresh();
    }

    /// True if only its feet touch, as its way has it, and it is up.
    fn stands_on_feet(&self) -> bool {
        let points = self.support.points();
        self.terms.com.z > UP * self.standing_com_height
            && self.target.next.planted == [true; 2]
            && points.iter().all(|p| FEET.contains(&p.segment))
            && self.support.rests().is_empty()
    }

    /// Comes to a stand from world time `time` on: a walk is ended by the steps that takes, everything else is held as it is. The steps are worked out
    /// aside, while the motion goes on for [`ASIDE`] samples. Allocates.
    pub fn stop(&mut self, time: f64) {
        self.queued = None;
        // It does so already: a step that is under way is finished.
        if self.ending || self.stopping.is_some() || matches!(self.drive, Drive::Hold(_)) {
            return;
        }
        if !self.steps() || !self.gait.is_walking() {
            let posture = self.target.next.posture;
            self.set_drive(Drive::Hold(posture));
            return;
        }
        self.plan_stop(time);
    }

    /// Leads the motion to a stand at ease, or like `goal` if it hardly moves or stands in another way.
    fn end_motion(&mut self, time: f64, goal: Option<Posture>) {
        let (given, so_far) = self.motion_until_stop(time, AT_ONCE);
        let v = self.terms.com_velocity;
        let slow = (v.x * v.x + v.y * v.y).sqrt() < SLOW || !self.gait.is_walking();
        let body = &self.setup.body;
        let stop = |goal| join::stop(body, so_far.clone(), given.now, (goal, given.streamed));
        let ease = if slow && goal.is_some() {
            None
        } else {
            stop(None)
        };
        let clip = ease.or_else(|| goal.and_then(|g| stop(Some(g))));
        self.follow_end(clip, given.begin, given.before);
    }

    /// Begins to work out how the motion is led to a stand at ease.
    fn plan_stop(&mut self, time: f64) {
        let (given, so_far) = self.motion_until_stop(time, ASIDE);
        let how = (None, given.streamed);
        let ends = Arc::new(Ends::new(&self.setup.body, so_far, given.now, how));
        let plan = |k| {
            let ends = Arc::clone(&ends);
            Plan::new(move || ends.end(k))
        };
        self.stopping = Some(Box::new(Stopping {
            ends: (0..Ends::MOST).map(plan).collect(),
            due: time + ASIDE as f64 / join::RATE,
            begin: given.begin,
            before: given.before,
        }));
    }

    /// Turns to the way to a stand in the last tick that begins before it differs from the motion. Always in that one, however long it took to work out.
    pub(super) fn begin_stop(&mut self, world: &TickContext) {
        let due = |s: &Stopping| world.time() + world.dt > s.due + 1e-9;
        if self.stopping.as_deref().is_some_and(due) {
            self.follow_stop();
        }
    }

    /// Turns to the way to a stand now, if one is worked out.
    pub(super) fn follow_stop(&mut self) {
        let Some(stopping) = self.stopping.take() else {
            return;
        };
        let Stopping {
            ends,
            begin,
            before,
            ..
        } = *stopping;
        let clip = Ends::best(ends.into_iter().map(Plan::take));
        self.follow_end(clip, begin, before);
    }

    /// Turns to a clip that begins at world time `begin`, s, which is `before` of the present motion. Without one holds the motion as it is: a stand takes no
    /// movement, or is not possible.
    fn follow_end(&mut self, clip: Option<Clip>, begin: f64, before: f64) {
        let Some(clip) = clip else {
            let posture = self.target.next.posture;
            self.set_drive(Drive::Hold(posture));
            return;
        };
        let plan = StepPlan::new(&self.setup.body, &clip, false);
        self.gait.go_on(plan, before);
        self.drive = Drive::Clip(ClipPlayback::new(Arc::new(clip), begin));
        self.ending = true;
    }

    /// The motion under way, by the rate of joins, from the run-up that planning a stop at world time `time` needs to as far ahead as it is known. It
    /// still plays for `after` samples.
    fn motion_until_stop(&mut self, time: f64, after: usize) -> (Given, Vec<Sample>) {
        let from = time - self.gait.lag();
        let (begin, so_far) = self.motion_around(from, after as f64 / join::RATE);
        let (streamed, before) = match &self.drive {
            Drive::Clip(play) => (false, play.clip_time(begin)),
            Drive::Live(live) => (true, live.stream_time(begin)),
            Drive::Hold(_) | Drive::External(_) => (false, 0.0),
        };
        let given = Given {
            begin,
            before,
            now: ((from - begin) * join::RATE).max(0.0) as usize + after,
            streamed,
        };
        (given, so_far)
    }

    /// Postures and planted feet, with the world time of the first, s.
    fn motion_around(&mut self, from: f64, still: f64) -> (f64, Vec<Sample>) {
        match &mut self.drive {
            Drive::Clip(play) => {
                let count = (RUN_UP * join::RATE) as usize;
                let at = |i: usize| from + (i as f64 - count as f64) / join::RATE;
                let ahead = (STOP_AHEAD * join::RATE) as usize;
                let so_far = (0..=count + ahead)
                    .map(|i| play.sample(at(i)))
                    .map(|t| (t.posture, t.planted))
                    .collect();
                (at(0), so_far)
            }
            Drive::Live(live) => {
                // What still plays is prepared now, so that the way to the stand begins with it.
                let (t, came) = (live.stream_time(from), live.motion.fed());
                live.motion.advance(t + still);
                let (first, so_far) = live.motion.known(t - RUN_UP, came);
                (from + first - t, so_far)
            }
            Drive::Hold(_) | Drive::External(_) => (0.0, Vec::new()),
        }
    }
}
