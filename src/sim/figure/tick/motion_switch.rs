//! How what is under way is left: over to another clip from step to step, or by the steps that bring it to a stand.
//! Both are worked out aside, and taken in a tick that is fixed when they are asked for.

use super::{Figure, TickContext};
use crate::sim::body::{Body, Posture};
use crate::sim::figure::background::Plan;
use crate::sim::figure::drive::{ClipPlayback, Drive, LivePlayback, Queued};
use crate::sim::motion::clip::{Clip, PlanarTransform};
use crate::sim::plan::motion_transition;
use crate::sim::plan::motion_transition::{TransitionCandidates, TransitionClip};
use crate::sim::plan::splice;
use crate::sim::plan::splice::{RUN_UP, Sample, StopCandidates};
use crate::sim::track::StepPlan;
use std::sync::Arc;

/// How far ahead a clip is looked at for a place to stop, s.
const STOP_AHEAD: f64 = 0.8;
/// Samples (of joins) that still play before a motion is left: the time that there is to work out how.
pub(super) const ASIDE: usize = 4;
/// A body slower than this is led into the posture in which the next clip begins; a faster one comes to its ease first,
/// m/s.
const SLOW: f64 = 0.2;
/// Time that the steps to a stand take, as is expected before they are worked out, s.
const STANDS_AFTER: f64 = 2.2;

/// A way to a stand, with what it asks of the ground.
type End = Option<(f64, Clip)>;
/// A way into a clip, and where that puts the clip's origin.
type Over = Option<(TransitionClip, PlanarTransform)>;

/// What a motion is stopped from if no planned way leads out of it.
#[derive(Debug)]
struct LastResort {
    so_far: Vec<Sample>,
    /// Sample up to which it still plays.
    now: usize,
    streamed: bool,
    /// How it is to stand.
    goal: Posture,
}

impl LastResort {
    fn end(self, body: &Arc<Body>) -> Option<Clip> {
        splice::stop(
            body,
            self.so_far,
            self.now,
            (Some(self.goal), self.streamed),
        )
    }
}

/// What is worked out aside when a motion is left.
#[derive(Debug, Default)]
pub(super) struct MotionSwitch {
    /// Over to the clip that waits, best first.
    over: Vec<Plan<Over>>,
    /// To a stand.
    ends: Vec<Plan<End>>,
    /// What is tried if there is no such way: to stand as the next clip begins.
    last_resort: Option<LastResort>,
    /// World time of the first sample of the ways over, s.
    known_from: f64,
    /// When the motion turns from its own way to that one, s.
    due: f64,
    /// World time of the first sample of the way to a stand, and time of the present motion then, s.
    begin: f64,
    before: f64,
}

/// What a stop is planned from.
struct Given {
    /// World time of the first sample, and time of the present motion then, s.
    begin: f64,
    before: f64,
    /// Sample up to which it still plays.
    now: usize,
    streamed: bool,
}

impl MotionSwitch {
    fn at(due: f64) -> Self {
        Self {
            due,
            ..Self::default()
        }
    }

    /// True if it may lead over to the clip that waits.
    pub fn leads_over(&self) -> bool {
        !self.over.is_empty()
    }
}

impl Figure {
    /// Begins to work out how the motion is left for a clip that is to play from world time `from` on: over to it,
    /// unless its place is `fixed`, or to a stand at ease, or like `goal` if it hardly moves or stands in another way.
    /// A motion that ends already does not end anew. Returns when it should stand and, if it is expected to go over,
    /// when the clip's time 0 plays, s.
    pub(super) fn leave(
        &mut self,
        play: &ClipPlayback,
        (goal, fixed): (Option<Posture>, bool),
        from: f64,
        time: f64,
    ) -> (f64, Option<f64>) {
        let stands = match &self.drive {
            Drive::Clip(end) if self.ending => end.start + end.clip.duration() + self.tracker.lag(),
            Drive::Hold(_) if self.crouches() => time + STANDS_AFTER,
            Drive::Hold(_) | Drive::External(_) => time,
            Drive::Clip(_) | Drive::Live(_) => time + STANDS_AFTER,
        };
        let pending = self.leaving.as_ref().map(|l| l.due);
        // A stream that is being stopped has ended.
        if matches!(self.drive, Drive::Live(_)) && pending.is_some() {
            return (stands, None);
        }
        let mut leaving = MotionSwitch::at(pending.unwrap_or(time + ASIDE as f64 / splice::RATE));
        let over = if fixed {
            None
        } else {
            self.ways_over(play, (leaving.due, from), time)
        };
        let entered = over.as_ref().map(|ways| {
            leaving.known_from = time - self.tracker.lag() - motion_transition::RUN_UP;
            let plan = |k| {
                let ways = Arc::clone(ways);
                Plan::new(move || ways.way(k))
            };
            leaving.over = (0..ways.moments().len()).map(plan).collect();
            let first = &ways.moments()[0];
            let at = time - motion_transition::RUN_UP + first.left as f64 / motion_transition::RATE;
            at - ways.enters(first) / play.speed
        });
        let ends = !self.ending
            && match &self.drive {
                Drive::Clip(_) | Drive::Live(_) => true,
                Drive::Hold(_) => self.crouches(),
                Drive::External(_) => false,
            };
        if ends {
            self.plan_ends(&mut leaving, goal, over.as_ref(), time);
        }
        self.leaving = (ends || leaving.leads_over()).then(|| Box::new(leaving));
        (stands, entered)
    }

    /// The ways from the clip that plays into another one that begins in full stride, at world time `due` or `from` or
    /// later, if there are moments at which they are alike.
    fn ways_over(
        &self,
        play: &ClipPlayback,
        (due, from): (f64, f64),
        time: f64,
    ) -> Option<Arc<TransitionCandidates>> {
        let Drive::Clip(now) = &self.drive else {
            return None;
        };
        let walks = self.tracker.is_walking() && !self.rising.is_rising();
        if !walks || play.clip.lead_in() <= 0.0 {
            return None;
        }
        let long = motion_transition::RUN_UP + motion_transition::AHEAD + motion_transition::BEYOND;
        let count = (long * motion_transition::RATE).round() as usize;
        let first = time - self.tracker.lag() - motion_transition::RUN_UP;
        let known = (0..=count).map(|i| now.sample(first + i as f64 / motion_transition::RATE));
        let known = known.map(|t| (t.posture, t.planted)).collect();
        let sample = |t: f64| {
            let ahead = (t - time + motion_transition::RUN_UP).max(0.0);
            (ahead * motion_transition::RATE - 1e-6).ceil() as usize
        };
        let from = (sample(due), sample(from));
        let ways = TransitionCandidates::new(&self.setup.body, known, from, play.motion());
        (!ways.moments().is_empty()).then(|| Arc::new(ways))
    }

    /// Begins to work out how the motion is led to a stand at ease.
    pub(super) fn leave_for_a_stand(&mut self, time: f64) {
        let mut leaving = MotionSwitch::at(time + ASIDE as f64 / splice::RATE);
        self.plan_ends(&mut leaving, None, None, time);
        self.leaving = Some(Box::new(leaving));
    }

    /// True if it hardly moves, or stands in its motion.
    pub(super) fn is_slow(&self) -> bool {
        let v = self.terms.com_velocity;
        (v.x * v.x + v.y * v.y).sqrt() < SLOW || !self.tracker.is_walking()
    }

    /// Begins to work out the ends of the motion; they are left out if there is a way over.
    fn plan_ends(
        &mut self,
        leaving: &mut MotionSwitch,
        goal: Option<Posture>,
        over: Option<&Arc<TransitionCandidates>>,
        time: f64,
    ) {
        let after = ((leaving.due - time) * splice::RATE).round() as usize;
        let (given, so_far) = self.motion_until_stop(time, after);
        (leaving.begin, leaving.before) = (given.begin, given.before);
        let slow = self.is_slow();
        let plans = |so_far: Vec<Sample>, goal: Option<Posture>| -> Vec<Plan<End>> {
            let how = (goal, given.streamed);
            let ends = Arc::new(StopCandidates::new(
                &self.setup.body,
                so_far,
                given.now,
                how,
            ));
            let plan = |k| {
                let (ends, over) = (Arc::clone(&ends), over.cloned());
                Plan::new(move || {
                    let needed = over.is_none_or(|o| !o.found());
                    needed.then(|| ends.end(k)).flatten()
                })
            };
            (0..StopCandidates::MOST).map(plan).collect()
        };
        if slow && goal.is_some() {
            leaving.ends = plans(so_far, goal);
        } else {
            leaving.ends = plans(so_far.clone(), None);
            leaving.last_resort = goal.map(|goal| LastResort {
                so_far,
                now: given.now,
                streamed: given.streamed,
                goal,
            });
        }
    }

    /// A stream that breaks off in the middle of a step, its last posture held, is left by the steps to a stand.
    /// Allocates.
    pub(super) fn leave_broken_stream(&mut self, time: f64) {
        let broken = |live: &LivePlayback| live.motion.breaks_off();
        let streams =
            self.leaving.is_none() && matches!(&self.drive, Drive::Live(live) if broken(live));
        if streams && self.steps() && self.tracker.is_walking() {
            self.leave_for_a_stand(time);
        }
    }

    /// Leaves the motion in the last tick that begins before the way out differs from it. Always in that one, however
    /// long that took to work out.
    pub(super) fn begin_to_leave(&mut self, world: &TickContext) {
        let due = |l: &MotionSwitch| world.time() + world.dt > l.due + 1e-9;
        if self.leaving.as_deref().is_some_and(due) {
            self.follow_way_out();
        }
    }

    /// Turns to the way out now, if one is being worked out.
    pub(super) fn follow_way_out(&mut self) {
        let Some(leaving) = self.leaving.take() else {
            return;
        };
        let MotionSwitch {
            over,
            ends,
            last_resort,
            known_from,
            due,
            begin,
            before,
        } = *leaving;
        if let Some(way) = over.into_iter().find_map(Plan::take) {
            self.go_over(way, known_from);
            return;
        }
        // One that ends already goes on to do so.
        if ends.is_empty() {
            self.plan_entry(due);
            return;
        }
        let best = StopCandidates::best(ends.into_iter().map(Plan::take));
        let clip = best.or_else(|| last_resort?.end(&self.setup.body));
        self.follow_end(clip, begin, before);
        if let Some(q) = &mut self.queued {
            q.due = match &self.drive {
                Drive::Clip(end) => end.start + end.clip.duration() + self.tracker.lag(),
                _ => due,
            };
        }
        self.plan_entry(due);
    }

    /// Goes over to the clip that waits. World time of the first sample of the way is `begin`, s.
    fn go_over(&mut self, (way, place): (TransitionClip, PlanarTransform), begin: f64) {
        let (Some(queued), Drive::Clip(now)) = (self.queued.take(), &self.drive) else {
            return;
        };
        let Queued { mut play, plan, .. } = *queued;
        play.start = begin - way.begin / play.speed;
        play.origin = place;
        let plan = plan.entered_by(&self.setup.body, &way);
        let before = now.clip_time(play.start);
        self.tracker.go_on((plan, play.speed, place), before);
        play.way_in = Some(Arc::new(way));
        self.drive = Drive::Clip(play);
        self.ending = false;
    }

    /// Turns to a clip that begins at world time `begin`, s, which is `before` of the present motion. Without one holds
    /// the motion as it is: a stand takes no movement, or is not possible.
    fn follow_end(&mut self, clip: Option<Clip>, begin: f64, before: f64) {
        let Some(clip) = clip else {
            let (queued, posture) = (self.queued.take(), self.target.next.posture);
            self.set_drive(Drive::Hold(posture));
            self.queued = queued;
            return;
        };
        let plan = StepPlan::new(&self.setup.body, &clip, false);
        let here = PlanarTransform::default();
        self.tracker.go_on((plan, 1.0, here), before);
        self.drive = Drive::Clip(ClipPlayback::new(Arc::new(clip), begin));
        self.ending = true;
    }

    /// The motion under way, by the rate of joins, from the run-up that planning a stop at world time `time` needs to
    /// as far ahead as it is known. It still plays for `after` samples.
    fn motion_until_stop(&mut self, time: f64, after: usize) -> (Given, Vec<Sample>) {
        let from = time - self.tracker.lag();
        let (begin, so_far) = self.motion_around(from, after as f64 / splice::RATE);
        let (streamed, before) = match &self.drive {
            Drive::Clip(play) => (false, play.clip_time(begin)),
            Drive::Live(live) => (true, live.stream_time(begin)),
            Drive::Hold(_) | Drive::External(_) => (false, 0.0),
        };
        let given = Given {
            begin,
            before,
            now: ((from - begin) * splice::RATE).max(0.0) as usize + after,
            streamed,
        };
        (given, so_far)
    }

    /// Postures and planted feet, with the world time of the first, s.
    fn motion_around(&mut self, from: f64, still: f64) -> (f64, Vec<Sample>) {
        match &mut self.drive {
            Drive::Clip(play) => {
                let count = (RUN_UP * splice::RATE) as usize;
                let at = |i: usize| from + (i as f64 - count as f64) / splice::RATE;
                let ahead = (STOP_AHEAD * splice::RATE) as usize;
                let so_far = (0..=count + ahead)
                    .map(|i| play.sample(at(i)))
                    .map(|t| (t.posture, t.planted))
                    .collect();
                (at(0), so_far)
            }
            Drive::Live(live) => {
                // What still plays is prepared now, so that the way to the stand begins with it.
                let (t, came) = (live.stream_time(from), live.motion.moved());
                live.motion.advance(t + still);
                let (first, so_far) = live.motion.known(t - RUN_UP, came);
                (from + first - t, so_far)
            }
            Drive::Hold(posture) => {
                let count = ((RUN_UP + STOP_AHEAD) * splice::RATE) as usize;
                (from - RUN_UP, vec![(*posture, [true; 2]); count])
            }
            Drive::External(_) => (0.0, Vec::new()),
        }
    }
}
