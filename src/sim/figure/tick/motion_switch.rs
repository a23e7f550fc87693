//! The exit from the motion under way: directly to another clip, by steps, or by the steps that bring it to a stand.
//! Both are planned in the background, and taken in a tick that is fixed when they are requested.

use crate::figure::events::FigureEvent;
use crate::figure::motion::clip_playback::ClipPlayback;
use crate::figure::motion::exit::{ExitGoal, ExitPlan, ExitProblem};
use crate::figure::motion::plan_task::PlanTask;
use crate::figure::motion::source::{MotionSource, QueuedClip};
use crate::figure::params::switch::{LEAD, MOST_LEAD, PATIENCE, SLOW, STOP_AHEAD, STOP_TIME};
use crate::figure::state::figure::Figure;
use crate::motion::clip::{Clip, PlanarTransform};
use crate::plan::motion_transition;
use crate::plan::motion_transition::{LeavingSamples, TransitionCandidates, TransitionClip};
use crate::plan::splice;
use crate::plan::splice::{RUN_UP, Sample, StandGoal, StopCandidates};
use crate::tick_context::{Planning, TickContext};
use crate::time::{MotionTime, WorldTime};
use crate::track::{PlacedPlan, StepPlan};
use std::sync::Arc;

/// The input from which a stop is planned.
struct Given {
    /// When the first sample plays, and the time of the present motion's plan then, s.
    begin: WorldTime,
    before: f64,
    /// Sample up to which the motion still plays.
    now: usize,
    streamed: bool,
    /// Whether it is a stream of which no more is expected.
    ended: bool,
}

/// Times of a switch.
#[derive(Clone, Copy)]
struct Times {
    /// The present.
    now: WorldTime,
    /// The exit from the present motion.
    due: WorldTime,
    /// The earliest beginning of the next clip.
    from: WorldTime,
}

impl Figure {
    /// Begins to work out the exit from the motion for a clip that should play from world time `from` on: directly to
    /// the clip, unless its place is `fixed`, or to a stand. The stand is at ease, or like `goal` if the figure hardly
    /// moves or stands in another way. A motion that is already ending is not ended again. Returns when the figure
    /// should stand and, if a direct switch is expected, when the clip's time 0 plays.
    pub(in crate::figure) fn leave(
        &mut self,
        play: &ClipPlayback,
        goal: ExitGoal,
        lead: usize,
        time: WorldTime,
    ) -> (WorldTime, Option<WorldTime>) {
        let stands = match self.motion.source() {
            MotionSource::Clip(end) if self.motion.stops() => {
                end.start + end.clip.duration() + self.desired.tracker.lag()
            }
            MotionSource::Hold(_) if self.crouches() => time + STOP_TIME,
            MotionSource::Hold(_) | MotionSource::External(_) | MotionSource::Rehearsed(_) => time,
            MotionSource::Clip(_) | MotionSource::Live(_) => time + STOP_TIME,
        };
        let pending = self.motion.exit().map(|l| l.problem.due);
        // A stream that is being stopped has ended.
        if matches!(self.motion.source(), MotionSource::Live(_)) && pending.is_some() {
            return (stands, None);
        }
        let due = pending.unwrap_or(time + lead as f64 / splice::RATE);
        let mut leaving = ExitProblem::at(due, goal, lead);
        leaving.ways = if goal.fixed {
            None
        } else {
            self.ways_over(
                play,
                Times {
                    now: time,
                    due,
                    from: goal.from,
                },
            )
        };
        let entered = leaving.ways.as_ref().map(|ways| {
            leaving.known_from = time - self.desired.tracker.lag() - motion_transition::RUN_UP;
            let first = &ways.moments()[0];
            let at = time - motion_transition::RUN_UP + first.left as f64 / motion_transition::RATE;
            play.start_for(ways.enters(first), at)
        });
        let ends = !self.motion.stops()
            && match self.motion.source() {
                MotionSource::Clip(_) | MotionSource::Live(_) => true,
                MotionSource::Hold(_) => self.crouches(),
                MotionSource::External(_) | MotionSource::Rehearsed(_) => false,
            };
        if ends {
            self.plan_stops(&mut leaving, time);
        }
        let leaving = (ends || leaving.ways.is_some()).then(|| ExitPlan::of(leaving));
        self.motion.plan_exit(leaving);
        (stands, entered)
    }

    /// The ways from the playing clip into another one that begins in full stride, if there are moments at which they
    /// are alike.
    fn ways_over(&self, play: &ClipPlayback, times: Times) -> Option<Arc<TransitionCandidates>> {
        let Times {
            now: time,
            due,
            from,
        } = times;
        let MotionSource::Clip(now) = self.motion.source() else {
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
        let sample = |t: WorldTime| {
            let ahead = (t - time + motion_transition::RUN_UP).max(0.0);
            (ahead * motion_transition::RATE - 1e-6).ceil() as usize
        };
        let left = LeavingSamples {
            now: sample(due),
            earliest: sample(from),
        };
        let ways = TransitionCandidates::new(&self.setup.body, known, left, play.motion());
        (!ways.moments().is_empty()).then(|| Arc::new(ways))
    }

    /// Begins to work out how the motion is led to a stand at ease.
    pub(in crate::figure) fn leave_for_a_stand(&mut self, lead: usize, time: WorldTime) {
        let goal = ExitGoal {
            posture: None,
            fixed: false,
            from: time,
        };
        let mut leaving = ExitProblem::at(time + lead as f64 / splice::RATE, goal, lead);
        self.plan_stops(&mut leaving, time);
        self.motion.plan_exit(Some(ExitPlan::of(leaving)));
    }

    /// Whether the motion hardly moves, or stands.
    pub(in crate::figure) fn is_slow(&self) -> bool {
        self.scratch.com_velocity.level() < SLOW || !self.desired.tracker.is_walking()
    }

    /// States the ends of the motion.
    fn plan_stops(&mut self, leaving: &mut ExitProblem, time: WorldTime) {
        // Never more than the longest lead, whatever a checkpoint says.
        let after = ((leaving.due - time) * splice::RATE).round() as usize;
        let after = after.min(MOST_LEAD);
        let (given, so_far) = self.motion_until_stop(time, after);
        (leaving.begin, leaving.before) = (given.begin, given.before);
        let posture = leaving.goal.posture.filter(|_| self.is_slow());
        let to = StandGoal {
            posture,
            streamed: given.streamed,
            whole: given.ended,
        };
        let ends = StopCandidates::new(&self.setup.body, so_far, given.now, to);
        leaving.ends = Some(Arc::new(ends));
    }

    /// A stream that has broken off in the middle of a step, or fallen silent there, is left for a motion that plays
    /// the rest of it and then walks to a stand. The window would prepare the rest as if the body stopped within a
    /// sample, and balance would be lost on that; a carried figure does not rely on it, and plays the rest as it came.
    /// Allocates in that case.
    pub(in crate::figure) fn leave_ended_stream(&mut self, time: WorldTime) {
        let from = time - self.desired.tracker.lag();
        let MotionSource::Live(live) = self.motion.source() else {
            return;
        };
        let Some(end) = live.motion.ends_at() else {
            return;
        };
        let ahead = LEAD as f64 / splice::RATE;
        let over = end - live.stream_time(from) < ahead + 0.5 / splice::RATE;
        // Samples that wait before the window, behind a way into the stream, are not known yet.
        let known = live.motion.taken() >= live.motion.moved();
        let may = self.motion.exit().is_none() && self.steps() && known;
        if may && (over || !self.is_carried()) && self.desired.tracker.is_walking() {
            self.leave_for_a_stand(LEAD, time);
        }
    }

    /// Comes to a stand where its way is barred: something that presses from the side has pushed it too far off its
    /// motion to keep its steps, and continuing would only increase the pressure. A clip ends in this way; a queued one
    /// begins from that stand, and so does the rest of a stream. Allocates in that case.
    pub(in crate::figure) fn break_off_if_barred(&mut self, world: &TickContext) {
        let (least, tracker) = (self.least_rest(world), &self.desired.tracker);
        let pressed = (self.surroundings.touches).press_aside(least, tracker.is_on_plan());
        let walks = self.steps() && !self.is_carried();
        if !(pressed && walks && tracker.is_far_off_plan()) {
            return;
        }
        let last = &self.desired.target.next;
        let stand = self.desired.tracker.break_off(&self.workspace.terms, last);
        let next = self.motion.take_next();
        self.motion.follow(MotionSource::Hold(stand));
        if let Some(next) = next {
            self.motion.queue(next);
            self.plan_entry(world.time());
        }
        self.outcome.watcher.push(FigureEvent::WayBarred);
    }

    /// Leaves a clip in which a step has to catch the body, with steps still to come, for a stand, and begins it again
    /// from there: by its own way in, or where it was. The second time the figure stays where it stands. Help that is
    /// allowed leads it back into the clip instead. Allocates in that case.
    pub(in crate::figure) fn begin_again_if_lost(&mut self, world: &TickContext) {
        let switches =
            self.motion.next().is_some() || self.motion.exit().is_some() || self.motion.stops();
        let MotionSource::Clip(play) = self.motion.source() else {
            return;
        };
        let alone = self.steps() && self.allowed_help() == 0.0 && !switches;
        if !(alone && self.desired.tracker.has_lost_plan()) {
            return;
        }
        let phase = self.desired.tracker.phase();
        let first = if phase < 0.0 {
            -play.clip.lead_in()
        } else {
            phase
        };
        let (time, second) = (world.time(), play.again);
        let play = ClipPlayback {
            way_in: None,
            again: true,
            ..play.clone()
        };
        let first = MotionTime(first);
        let plan = StepPlan::new(&self.setup.body, &play.clip, play.looped);
        let begins = play.clip.sample(first.0).posture;
        let last = &self.desired.target.next;
        let stand = self.desired.tracker.break_off(&self.workspace.terms, last);
        self.motion.follow(MotionSource::Hold(stand));
        if second {
            self.outcome.watcher.push(FigureEvent::ClipGivenUp);
            return;
        }
        self.outcome.watcher.push(FigureEvent::ClipRestarts);
        let stance = self.desired.tracker.stance_of(&self.setup.body, &begins);
        self.motion.queue(QueuedClip {
            plan,
            first,
            from: time,
            stance: Some(stance),
            due: time + STOP_TIME + 3.0 * PATIENCE,
            led: true,
            entry: None,
            play,
        });
        self.plan_entry(time);
    }

    /// Leaves the motion in the last tick that begins before its exit differs from it. A tick that does not wait for
    /// plans continues without a missing one: the exit begins with samples that the motion has passed by then, so it is
    /// planned again from a later one.
    pub(in crate::figure) fn follow_exit_if_due(&mut self, world: &TickContext) {
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

    /// Follows the exit that is planned now, if there is one.
    pub(in crate::figure) fn follow_exit(&mut self) {
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
            let (way, place) = way;
            self.go_over(way, place, known_from);
            return;
        }
        // A motion that is already ending continues to do so.
        if stops.is_empty() {
            self.plan_entry(due);
            return;
        }
        let best = StopCandidates::best(stops.into_iter().map(PlanTask::take));
        let clip = best.or_else(|| last_resort?.take());
        self.follow_end(clip, begin, before);
        let stands = match self.motion.source() {
            MotionSource::Clip(end) => end.start + end.clip.duration() + self.desired.tracker.lag(),
            _ => due,
        };
        self.motion.update_next(|q| q.due = stands);
        self.plan_entry(due);
    }

    /// Switches to the queued clip, with its origin at `place`. The first sample of the way plays at world time
    /// `begin`.
    fn go_over(&mut self, way: TransitionClip, place: PlanarTransform, begin: WorldTime) {
        let next = self.motion.take_next();
        let (Some(next), MotionSource::Clip(now)) = (next, self.motion.source()) else {
            return;
        };
        let QueuedClip { mut play, plan, .. } = next;
        play.start = play.start_for(way.begin, begin);
        play.origin = place;
        let plan = plan.entered_by(&self.setup.body, &way);
        let before = now.motion_time(play.start).0;
        self.desired
            .tracker
            .continue_with(PlacedPlan::new(plan, play.speed, place), before);
        play.way_in = Some(Arc::new(way));
        self.motion.enter(MotionSource::Clip(play));
    }

    /// Turns to a clip that begins at world time `begin`, which is `before` (s) in the plan of the present motion.
    /// Without a clip, holds the motion as it is: standing takes no movement, or is not possible.
    fn follow_end(&mut self, clip: Option<Clip>, begin: WorldTime, before: f64) {
        let Some(clip) = clip else {
            let (next, posture) = (self.motion.take_next(), self.desired.target.next.posture);
            self.set_drive(MotionSource::Hold(posture));
            if let Some(next) = next {
                self.motion.queue(next);
            }
            return;
        };
        let plan = StepPlan::new(&self.setup.body, &clip, false);
        let here = PlanarTransform::default();
        self.desired
            .tracker
            .continue_with(PlacedPlan::new(plan, 1.0, here), before);
        let steps = ClipPlayback::new(Arc::new(clip), begin);
        self.motion.follow_to_stand(MotionSource::Clip(steps));
    }

    /// The motion under way, at the rate of joins: from the run-up that a stop planned at world time `time` needs, to
    /// the end of what is known. It still plays for `after` samples.
    fn motion_until_stop(&mut self, time: WorldTime, after: usize) -> (Given, Vec<Sample>) {
        let from = time - self.desired.tracker.lag();
        let (begin, so_far) = self.motion_around(from, after as f64 / splice::RATE);
        let (live, before) = match self.motion.source() {
            MotionSource::Clip(play) => (None, play.motion_time(begin).0),
            MotionSource::Live(live) => (Some(live), live.stream_time(begin).0),
            MotionSource::Hold(_) | MotionSource::External(_) | MotionSource::Rehearsed(_) => {
                (None, 0.0)
            }
        };
        let now = ((from - begin) * splice::RATE).max(0.0) as usize;
        let given = Given {
            begin,
            before,
            // It continues at least to that sample, even if a checkpoint says otherwise.
            now: now.saturating_add(after).min(so_far.len()),
            streamed: live.is_some(),
            ended: live.is_some_and(|live| live.motion.ends_at().is_some()),
        };
        (given, so_far)
    }

    /// Postures and planted feet, with the world time of the first.
    fn motion_around(&mut self, from: WorldTime, still: f64) -> (WorldTime, Vec<Sample>) {
        match self.motion.source_mut() {
            MotionSource::Clip(play) => {
                let count = (RUN_UP * splice::RATE) as usize;
                let at = |i: usize| from + (i as f64 - count as f64) / splice::RATE;
                let ahead = (STOP_AHEAD * splice::RATE) as usize;
                let so_far = (0..=count + ahead)
                    .map(|i| play.sample(at(i)))
                    .map(|t| (t.posture, t.planted))
                    .collect();
                (at(0), so_far)
            }
            MotionSource::Live(live) => {
                // The part that still plays is prepared now, so that the way to the stand begins with it.
                let (t, came) = (live.stream_time(from), live.motion.moved());
                live.motion.advance(t + still);
                let (first, so_far) = live.motion.known(t - RUN_UP, came);
                // Only here a stream's time becomes world time. The last bits depend on the order.
                (WorldTime(from.0 + first.0 - t.0), so_far)
            }
            MotionSource::Hold(posture) => {
                let count = ((RUN_UP + STOP_AHEAD) * splice::RATE) as usize;
                (from - RUN_UP, vec![(*posture, [true; 2]); count])
            }
            MotionSource::External(_) | MotionSource::Rehearsed(_) => {
                (WorldTime::default(), Vec::new())
            }
        }
    }
}
