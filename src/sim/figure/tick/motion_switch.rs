//! How what is under way is left: over to another clip from step to step, or by the steps that bring it to a stand.
//! Both are worked out aside, and taken in a tick that is fixed when they are asked for.

use super::{Figure, TickContext};
use crate::body::Posture;
use crate::figure::drive::{ClipPlayback, Drive, LivePlayback, QueuedClip};
use crate::figure::events::FigureEvent;
use crate::figure::params::switch::{LEAD, MOST_LEAD, SLOW, STOP_AHEAD, STOP_TIME};
use crate::figure::plan_task::{PlanRequest, PlanTask, Planning};
use crate::motion::clip::{Clip, PlanarTransform};
use crate::plan::motion_transition;
use crate::plan::motion_transition::{TransitionCandidates, TransitionClip};
use crate::plan::splice;
use crate::plan::splice::{RUN_UP, Sample, StopCandidates};
use crate::track::StepPlan;
use serde::{Deserialize, Serialize, Serializer};
use std::sync::Arc;

/// A way to a stand, with what it asks of the ground.
type Stop = Option<(f64, Clip)>;
/// A way into a clip, and where that puts the clip's origin.
type Over = Option<(TransitionClip, PlanarTransform)>;

/// What the exit from a motion is to lead to.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct ExitGoal {
    /// The posture in which the figure is to stand if it hardly moves or does not reach the clip from step to step; at
    /// ease if not given.
    pub posture: Option<Posture>,
    /// The clip's origin is meant: the figure may not go over to it where it is.
    pub fixed: bool,
    /// World time before which the clip does not begin, s.
    pub from: f64,
}

/// How a motion is left, while that is planned.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "ExitProblem")]
pub(in crate::figure) struct ExitPlan {
    problem: ExitProblem,
    /// Over to the clip that waits, best first.
    over: Vec<PlanTask<Over>>,
    /// To a stand.
    stops: Vec<PlanTask<Stop>>,
    /// To a stand like the beginning of the next clip, if there is no such way.
    last_resort: Option<PlanTask<Option<Clip>>>,
}

/// What [`ExitPlan`] is planned from.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct ExitProblem {
    goal: ExitGoal,
    /// Samples that there were to plan it.
    lead: usize,
    /// The ways over to the clip that waits, if there are any.
    ways: Option<Arc<TransitionCandidates>>,
    /// World time of the first sample of these, s.
    known_from: f64,
    /// The ways to a stand, if the motion is to be ended.
    ends: Option<Arc<StopCandidates>>,
    /// When the motion turns from its own way to that one, s.
    due: f64,
    /// World time of the first sample of the way to a stand, and time of the present motion then, s.
    begin: f64,
    before: f64,
}

impl ExitPlan {
    /// Everything that is to be planned, the more urgent first.
    pub fn requests(&self) -> impl Iterator<Item = PlanRequest> + '_ {
        let over = self.over.iter().filter_map(|t| t.request());
        let ends = self.stops.iter().filter_map(|t| t.request());
        let last = self.last_resort.iter().filter_map(|t| t.request());
        over.chain(ends).chain(last)
    }

    /// True if nothing that decides is still to be worked out.
    fn is_ready(&self) -> bool {
        for way in &self.over {
            match way.result() {
                Some(Some(_)) => return true,
                _ if way.is_ready() => {}
                _ => return false,
            }
        }
        let found = |end: &PlanTask<Stop>| matches!(end.result(), Some(Some(_)));
        self.stops.iter().all(PlanTask::is_ready)
            && (self.stops.iter().any(found)
                || self.last_resort.as_ref().is_none_or(PlanTask::is_ready))
    }

    /// True if it may lead over to the clip that waits.
    pub fn leads_over(&self) -> bool {
        !self.over.is_empty()
    }
}

impl ExitProblem {
    fn at(due: f64, goal: ExitGoal, lead: usize) -> Self {
        Self {
            goal,
            lead,
            ways: None,
            known_from: 0.0,
            ends: None,
            due,
            begin: 0.0,
            before: 0.0,
        }
    }

    /// False if it cannot be what was written into a checkpoint.
    fn is_valid(&self) -> bool {
        let times = [
            self.goal.from,
            self.known_from,
            self.due,
            self.begin,
            self.before,
        ];
        self.lead <= MOST_LEAD
            && times.iter().all(|t| t.is_finite())
            && self.ways.as_ref().is_none_or(|w| w.is_valid())
            && self.ends.as_ref().is_none_or(|e| e.is_valid())
    }
}

impl TryFrom<ExitProblem> for ExitPlan {
    type Error = &'static str;

    /// Of what was read from a checkpoint.
    fn try_from(problem: ExitProblem) -> Result<Self, Self::Error> {
        if problem.is_valid() {
            Ok(Self::of(problem))
        } else {
            Err("an exit from a motion that cannot be")
        }
    }
}

impl ExitPlan {
    fn of(problem: ExitProblem) -> Self {
        let ways = problem.ways.as_ref();
        let over = |k| {
            let ways = Arc::clone(ways?);
            Some(PlanTask::new(move || ways.way(k)))
        };
        let count = ways.map_or(0, |w| w.moments().len());
        let over = (0..count).filter_map(over).collect();
        let Some(ends) = &problem.ends else {
            return Self {
                over,
                stops: Vec::new(),
                last_resort: None,
                problem,
            };
        };
        // Ends are left out if there is a way over.
        let end = |k| {
            let (ends, ways) = (Arc::clone(ends), ways.cloned());
            PlanTask::new(move || {
                let needed = ways.as_ref().is_none_or(|w| !w.found());
                needed.then(|| ends.end(k)).flatten()
            })
        };
        let stops: Vec<_> = (0..StopCandidates::MOST).map(end).collect();
        let posture = problem.goal.posture.filter(|_| !ends.have_goal());
        let last_resort = posture.map(|posture| {
            let (ends, ways, stops) = (Arc::clone(ends), ways.cloned(), stops.clone());
            PlanTask::new(move || {
                let found = stops.iter().any(|e| matches!(e.result(), Some(Some(_))));
                if found || ways.as_ref().is_some_and(|w| w.found()) {
                    return None;
                }
                ends.like(posture)
            })
        });
        Self {
            over,
            stops,
            last_resort,
            problem,
        }
    }
}

impl Serialize for ExitPlan {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.problem.serialize(to)
    }
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

impl Figure {
    /// Begins to work out how the motion is left for a clip that is to play from world time `from` on: over to it,
    /// unless its place is `fixed`, or to a stand at ease, or like `goal` if it hardly moves or stands in another way.
    /// A motion that ends already does not end anew. Returns when it should stand and, if it is expected to go over,
    /// when the clip's time 0 plays, s.
    pub(super) fn leave(
        &mut self,
        play: &ClipPlayback,
        goal: ExitGoal,
        lead: usize,
        time: f64,
    ) -> (f64, Option<f64>) {
        let stands = match self.motion.source() {
            Drive::Clip(end) if self.motion.stops() => {
                end.start + end.clip.duration() + self.desired.tracker.lag()
            }
            Drive::Hold(_) if self.crouches() => time + STOP_TIME,
            Drive::Hold(_) | Drive::External(_) | Drive::Rehearsed(_) => time,
            Drive::Clip(_) | Drive::Live(_) => time + STOP_TIME,
        };
        let pending = self.motion.exit().map(|l| l.problem.due);
        // A stream that is being stopped has ended.
        if matches!(self.motion.source(), Drive::Live(_)) && pending.is_some() {
            return (stands, None);
        }
        let due = pending.unwrap_or(time + lead as f64 / splice::RATE);
        let mut leaving = ExitProblem::at(due, goal, lead);
        leaving.ways = if goal.fixed {
            None
        } else {
            self.ways_over(play, (due, goal.from), time)
        };
        let entered = leaving.ways.as_ref().map(|ways| {
            leaving.known_from = time - self.desired.tracker.lag() - motion_transition::RUN_UP;
            let first = &ways.moments()[0];
            let at = time - motion_transition::RUN_UP + first.left as f64 / motion_transition::RATE;
            at - ways.enters(first) / play.speed
        });
        let ends = !self.motion.stops()
            && match self.motion.source() {
                Drive::Clip(_) | Drive::Live(_) => true,
                Drive::Hold(_) => self.crouches(),
                Drive::External(_) | Drive::Rehearsed(_) => false,
            };
        if ends {
            self.plan_stops(&mut leaving, time);
        }
        let leaving = (ends || leaving.ways.is_some()).then(|| ExitPlan::of(leaving));
        self.motion.plan_exit(leaving);
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
        let Drive::Clip(now) = self.motion.source() else {
            return None;
        };
        let walks = self.desired.tracker.is_walking() && !self.motion.gets_up();
        if !walks || play.clip.lead_in() <= 0.0 {
            return None;
        }
        let long = motion_transition::RUN_UP + motion_transition::AHEAD + motion_transition::BEYOND;
        let count = (long * motion_transition::RATE).round() as usize;
        let first = time - self.desired.tracker.lag() - motion_transition::RUN_UP;
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
    pub(super) fn leave_for_a_stand(&mut self, lead: usize, time: f64) {
        let goal = ExitGoal {
            posture: None,
            fixed: false,
            from: time,
        };
        let mut leaving = ExitProblem::at(time + lead as f64 / splice::RATE, goal, lead);
        self.plan_stops(&mut leaving, time);
        self.motion.plan_exit(Some(ExitPlan::of(leaving)));
    }

    /// True if it hardly moves, or stands in its motion.
    pub(super) fn is_slow(&self) -> bool {
        self.scratch.com_velocity.level() < SLOW || !self.desired.tracker.is_walking()
    }

    /// States the ends of the motion.
    fn plan_stops(&mut self, leaving: &mut ExitProblem, time: f64) {
        // Never more than the longest lead, whatever a state that was read says.
        let after = ((leaving.due - time) * splice::RATE).round() as usize;
        let after = after.min(MOST_LEAD);
        let (given, so_far) = self.motion_until_stop(time, after);
        (leaving.begin, leaving.before) = (given.begin, given.before);
        let posture = leaving.goal.posture.filter(|_| self.is_slow());
        let how = (posture, given.streamed);
        let ends = StopCandidates::new(&self.setup.body, so_far, given.now, how);
        leaving.ends = Some(Arc::new(ends));
    }

    /// A stream that breaks off in the middle of a step, its last posture held, is left by the steps to a stand.
    /// Allocates.
    pub(super) fn leave_broken_stream(&mut self, time: f64) {
        let broken = |live: &LivePlayback| live.motion.breaks_off();
        let streams = self.motion.exit().is_none()
            && matches!(self.motion.source(), Drive::Live(live) if broken(live));
        if streams && self.steps() && self.desired.tracker.is_walking() {
            self.leave_for_a_stand(LEAD, time);
        }
    }

    /// Comes to a stand where its way is barred: what presses on it from aside has taken it so far off its motion that
    /// its steps have to change, and going on would only press more. A clip ends so; one that waits begins from that
    /// stand, and so does what comes of a stream. Allocates then.
    pub(super) fn break_off_if_barred(&mut self, world: &TickContext) {
        let (least, tracker) = (self.least_rest(world), &self.desired.tracker);
        let pressed = (self.surroundings.touches).press_aside(least, tracker.is_on_plan());
        let walks = self.steps() && !self.is_carried();
        if !(pressed && walks && tracker.is_far_off_plan()) {
            return;
        }
        let last = &self.desired.target.next.posture;
        let stand = self.desired.tracker.break_off(&self.workspace.terms, last);
        let next = self.motion.take_next();
        self.motion.follow(Drive::Hold(stand));
        if let Some(next) = next {
            self.motion.queue(next);
            self.plan_entry(world.time());
        }
        self.outcome.watcher.push(FigureEvent::WayBarred);
    }

    /// Leaves the motion in the last tick that begins before its exit differs from it. A tick that does not wait for
    /// plans goes on without one that is not there: the way out begins with samples that the motion has passed by then,
    /// so it is planned anew from a later one.
    pub(super) fn follow_exit_if_due(&mut self, world: &TickContext) {
        let due = |l: &&ExitPlan| world.time() + world.dt > l.problem.due + 1e-9;
        let Some(exit) = self.motion.exit().filter(due) else {
            return;
        };
        let missing = world.planning == Planning::Aside && !exit.is_ready();
        if !(missing || self.outcome.told_late.exit) {
            self.follow_exit();
            return;
        }
        let (goal, lead) = (exit.problem.goal, (2 * exit.problem.lead).min(MOST_LEAD));
        self.outcome.late.exit = true;
        self.motion.plan_exit(None);
        let time = world.time();
        match self.motion.next().map(|q| q.play.clone()) {
            Some(play) => {
                let (due, _) = self.leave(&play, goal, lead, time);
                self.motion.update_next(|q| q.due = due);
                if self.motion.exit().is_none() {
                    self.plan_entry(time);
                }
            }
            None => self.leave_for_a_stand(lead, time),
        }
    }

    /// Follows the exit that is planned now, if one is.
    pub(super) fn follow_exit(&mut self) {
        let Some(leaving) = self.motion.take_exit() else {
            return;
        };
        let ExitPlan {
            over,
            stops,
            last_resort,
            problem:
                ExitProblem {
                    known_from,
                    due,
                    begin,
                    before,
                    ..
                },
        } = leaving;
        if let Some(way) = over.into_iter().find_map(PlanTask::take) {
            self.go_over(way, known_from);
            return;
        }
        // One that ends already goes on to do so.
        if stops.is_empty() {
            self.plan_entry(due);
            return;
        }
        let best = StopCandidates::best(stops.into_iter().map(PlanTask::take));
        let clip = best.or_else(|| last_resort?.take());
        self.follow_end(clip, begin, before);
        let stands = match self.motion.source() {
            Drive::Clip(end) => end.start + end.clip.duration() + self.desired.tracker.lag(),
            _ => due,
        };
        self.motion.update_next(|q| q.due = stands);
        self.plan_entry(due);
    }

    /// Goes over to the clip that waits. World time of the first sample of the way is `begin`, s.
    fn go_over(&mut self, (way, place): (TransitionClip, PlanarTransform), begin: f64) {
        let next = self.motion.take_next();
        let (Some(next), Drive::Clip(now)) = (next, self.motion.source()) else {
            return;
        };
        let QueuedClip { mut play, plan, .. } = next;
        play.start = begin - way.begin / play.speed;
        play.origin = place;
        let plan = plan.entered_by(&self.setup.body, &way);
        let before = now.clip_time(play.start);
        self.desired
            .tracker
            .continue_with((plan, play.speed, place), before);
        play.way_in = Some(Arc::new(way));
        self.motion.enter(Drive::Clip(play));
    }

    /// Turns to a clip that begins at world time `begin`, s, which is `before` of the present motion. Without one holds
    /// the motion as it is: a stand takes no movement, or is not possible.
    fn follow_end(&mut self, clip: Option<Clip>, begin: f64, before: f64) {
        let Some(clip) = clip else {
            let (next, posture) = (self.motion.take_next(), self.desired.target.next.posture);
            self.set_drive(Drive::Hold(posture));
            if let Some(next) = next {
                self.motion.queue(next);
            }
            return;
        };
        let plan = StepPlan::new(&self.setup.body, &clip, false);
        let here = PlanarTransform::default();
        self.desired
            .tracker
            .continue_with((plan, 1.0, here), before);
        let steps = ClipPlayback::new(Arc::new(clip), begin);
        self.motion.follow_to_stand(Drive::Clip(steps));
    }

    /// The motion under way, by the rate of joins, from the run-up that planning a stop at world time `time` needs to
    /// as far ahead as it is known. It still plays for `after` samples.
    fn motion_until_stop(&mut self, time: f64, after: usize) -> (Given, Vec<Sample>) {
        let from = time - self.desired.tracker.lag();
        let (begin, so_far) = self.motion_around(from, after as f64 / splice::RATE);
        let (streamed, before) = match self.motion.source() {
            Drive::Clip(play) => (false, play.clip_time(begin)),
            Drive::Live(live) => (true, live.stream_time(begin)),
            Drive::Hold(_) | Drive::External(_) | Drive::Rehearsed(_) => (false, 0.0),
        };
        let now = ((from - begin) * splice::RATE).max(0.0) as usize;
        let given = Given {
            begin,
            before,
            // It goes on at least that far, also where a state that was read says otherwise.
            now: now.saturating_add(after).min(so_far.len()),
            streamed,
        };
        (given, so_far)
    }

    /// Postures and planted feet, with the world time of the first, s.
    fn motion_around(&mut self, from: f64, still: f64) -> (f64, Vec<Sample>) {
        match self.motion.source_mut() {
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
            Drive::External(_) | Drive::Rehearsed(_) => (0.0, Vec::new()),
        }
    }
}
