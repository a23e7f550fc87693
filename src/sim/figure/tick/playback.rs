//! Switches motions while the figure is moving: directly, at a matching step, or else through a stand, after which the
//! queued clip starts.

use crate::body::Posture;
use crate::figure::motion::clip_playback::ClipPlayback;
use crate::figure::motion::exit::ExitGoal;
use crate::figure::motion::get_up::GetUpDecision;
use crate::figure::motion::rehearsal_playback::RehearsalEntry;
use crate::figure::motion::source::{ClipEntry, ClipEntryProblem, MotionSource, QueuedClip};
use crate::figure::params::get_up::UP_HEIGHT;
use crate::figure::params::switch::{EARLIEST_BEGIN, ENTRY_TIME, LEAD, PATIENCE, STILL, UPRIGHT};
use crate::figure::state::figure::Figure;
use crate::figure::tick::fall_detection::FEET;
use crate::motion::{Clip, Target};
use crate::plan::splice;
use crate::tick_context::{Planning, TickContext};
use crate::time::{MotionTime, WorldTime};
use crate::track::{PlacedPlan, StepPlan};
use std::sync::Arc;

/// How a clip begins.
struct Beginning {
    /// Time of the clip at which it begins, and the posture then.
    first: MotionTime,
    posture: Posture,
    /// Standing, on one foot or both.
    upright: bool,
    /// On both feet, and at rest.
    rests: bool,
}

impl Figure {
    /// Plays a clip from world time `time` on, as it was rehearsed if it was and can be
    /// ([`Self::rehearsal_entry`]). A figure that walks, or is in the middle of another clip, switches
    /// directly at a matching step if the two motions have one; otherwise it first finishes its step and stands as the
    /// clip begins. The clip then begins at the place of the feet, unless `fixed` says that its origin stays; a way of
    /// its own leads into it if it begins neither as the figure stands nor with steps from there. A figure that already
    /// stands as the clip begins, has fallen, or makes no steps, begins at once.
    ///
    /// Returns the world time at which the clip's time 0 plays. It is an estimate if the figure switches directly,
    /// has to stand first, or needs a way into the clip: ways are planned in the background, and taken in a tick that
    /// is fixed now. Allocates.
    pub fn play(&mut self, mut play: ClipPlayback, fixed: bool, time: WorldTime) -> WorldTime {
        if self.motion.rehearsed().is_some() {
            self.leave_rehearsal();
        }
        let rehearsal = self.rehearsal_entry(&play);
        if rehearsal.is_none() {
            play.rehearsed = None;
        }
        let helped = rehearsal == Some(RehearsalEntry::Led);
        let begin = self.beginning(&play, time);
        let first = begin.first;
        let led = begin.upright && !fixed && !helped;
        let rises = self.motion.gets_up();
        let moves = rises || self.is_busy(time) || led && self.crouches();
        let stands = !moves
            && !self
                .desired
                .tracker
                .comes_to_stand(self.scratch.com_velocity);
        let begins_so = |stand: &Posture| {
            let motion = play.motion();
            !led || motion.begins_as(&self.setup.body, first, stand)
        };
        if !(rises || self.steps()) || (stands && begins_so(&self.comes_to())) {
            let start = play.start;
            self.set_drive(MotionSource::Clip(play));
            return start;
        }
        let ease = *self.desired.tracker.at_ease();
        let goal = if begin.rests { begin.posture } else { ease };
        let stand = match (moves, self.is_slow()) {
            (false, _) => self.comes_to(),
            (true, true) => goal,
            (true, false) => ease,
        };
        let led_after = if begins_so(&stand) { 0.0 } else { ENTRY_TIME };
        let from = play.world_time(first);
        let (due, entered) = if moves {
            let goal = begin.upright.then_some(goal);
            let goal = ExitGoal {
                posture: goal,
                fixed,
                from,
            };
            self.leave(&play, goal, LEAD, time)
        } else {
            (time, None)
        };
        let expected = entered.unwrap_or_else(|| play.start_for(first, due.max(from) + led_after));
        let plan = StepPlan::new(&self.setup.body, &play.clip, play.looped);
        let stance = self
            .desired
            .tracker
            .stance_of(&self.setup.body, &begin.posture);
        self.motion.queue(QueuedClip {
            plan,
            first,
            from,
            stance: (!fixed).then_some(stance),
            due,
            led,
            entry: None,
            play,
        });
        if self.motion.exit().is_none() {
            self.plan_entry(time);
        }
        expected
    }

    /// How a clip begins, if it should play from world time `time` on.
    fn beginning(&self, play: &ClipPlayback, time: WorldTime) -> Beginning {
        let first = MotionTime(play.motion_time(time).0.clamp(-play.clip.lead_in(), 0.0));
        let Target {
            posture, planted, ..
        } = play.clip.sample(first.0);
        let body = &self.setup.body;
        let slow = play.motion().begins_as(body, first, &posture);
        Beginning {
            first,
            posture,
            upright: posture.root_position.z > UPRIGHT * body.standing_root_height(),
            rests: planted == [true; 2] && slow,
        }
    }

    /// Whether it does not stand upright when its motion is over.
    pub(in crate::figure) fn crouches(&self) -> bool {
        self.comes_to().root_position.z < UPRIGHT * self.setup.body.standing_root_height()
    }

    /// The posture in which it stands when its motion is over.
    fn comes_to(&self) -> Posture {
        if let Some(ease) = self.desired.tracker.stop_posture() {
            return *ease;
        }
        match self.motion.source() {
            MotionSource::Hold(posture) => *posture,
            MotionSource::Clip(play) => play.clip.sample(f64::INFINITY).posture,
            MotionSource::External(_) | MotionSource::Live(_) | MotionSource::Rehearsed(_) => {
                self.desired.target.next.posture
            }
        }
    }

    /// Whether the motion that is ending has stopped moving any joint.
    fn has_come(&self, time: WorldTime) -> bool {
        let MotionSource::Clip(end) = self.motion.source() else {
            return true;
        };
        let here = end.sample(time - self.desired.tracker.lag()).posture;
        let left = here.joint_difference(&self.comes_to());
        self.desired.tracker.stop_posture().is_some() || left.iter().all(|e| e.abs() < STILL)
    }

    /// Begins to work out the way into the queued clip from the stand to which the motion leads, if the clip needs one.
    pub(in crate::figure) fn plan_entry(&mut self, time: WorldTime) {
        let Some(q) = self.motion.next() else { return };
        let stands = !self.motion.has_fallen() && !self.crouches();
        let (next, first) = (q.play.motion(), q.first);
        let (body, stand) = (Arc::clone(&self.setup.body), self.comes_to());
        let problem = ClipEntryProblem {
            body,
            next,
            first,
            stand,
        };
        if !stands || !q.led || problem.begins() {
            return;
        }
        self.motion.update_next(|q| {
            q.from = q.from.max(time + LEAD as f64 / splice::RATE);
            q.entry = Some(ClipEntry::from(problem));
        });
    }

    /// The next clip, if one is queued or being switched to.
    pub fn next_clip(&self) -> Option<&Arc<Clip>> {
        let coming = |play: &ClipPlayback| {
            let way = play.way_in.as_ref();
            way.is_some_and(|w| self.desired.tracker.phase() < w.enters.0)
        };
        match (self.motion.next(), self.motion.source()) {
            (Some(q), _) => Some(&q.play.clip),
            (None, MotionSource::Clip(play)) if coming(play) => Some(&play.clip),
            _ => None,
        }
    }

    /// Whether nothing of a clip is left to play at world time `time`.
    fn is_over(&self, play: &ClipPlayback, time: WorldTime) -> bool {
        let end = play.clip.duration() + play.clip.lead_out();
        !play.looped && play.motion_time(time - self.desired.tracker.lag()).0 >= end
    }

    /// Whether there is a motion to follow: a clip that has begun and is not over, or a stream.
    pub(in crate::figure) fn has_motion(&self, time: WorldTime) -> bool {
        let moves = match self.motion.source() {
            MotionSource::Clip(play) => {
                let begins =
                    play.way_in.is_some() || play.motion_time(time).0 >= -play.clip.lead_in();
                begins && !self.is_over(play, time)
            }
            MotionSource::External(_) | MotionSource::Live(_) => true,
            MotionSource::Hold(_) | MotionSource::Rehearsed(_) => false,
        };
        moves && !self.motion.has_fallen()
    }

    /// Whether it is in the middle of a clip or of a step.
    fn is_busy(&self, time: WorldTime) -> bool {
        let plays = match self.motion.source() {
            MotionSource::Clip(play) => !self.is_over(play, time),
            MotionSource::Live(_) => self.desired.tracker.is_walking(),
            MotionSource::Hold(_) | MotionSource::External(_) | MotionSource::Rehearsed(_) => false,
        };
        plays || self.motion.exit().is_some() || self.desired.tracker.recovery_step().is_some()
    }

    /// Whether it is in the middle of a clip or a step, or on its way to a stand. False for a fallen figure.
    pub fn comes_to_stand(&self, time: WorldTime) -> bool {
        let ends = || {
            self.desired
                .tracker
                .comes_to_stand(self.scratch.com_velocity)
        };
        self.steps() && !self.motion.has_fallen() && (self.is_busy(time) || ends())
    }

    /// Begins the queued clip, once the figure stands.
    pub(in crate::figure) fn begin_next_if_ready(&mut self, world: &TickContext) {
        let time = world.time();
        let Some(q) = self.motion.next() else { return };
        if self.motion.exit().is_some() {
            return;
        }
        let ready = if self.motion.gets_up()
            || (self.surroundings.balance.lost() && !self.motion.has_fallen())
        {
            false
        } else if !self.steps() || time > q.due + PATIENCE {
            true
        } else {
            let due = if q.play.again {
                q.from
            } else {
                q.due - EARLIEST_BEGIN
            };
            let soon = time >= q.from.max(due)
                && self.desired.tracker.is_settled(self.scratch.com_velocity);
            soon && self.has_come(time)
        };
        if !ready {
            return;
        }
        let planned = q.entry.as_ref().is_none_or(|e| e.task.is_ready());
        let missing = !planned && world.planning == Planning::Aside;
        if missing || self.outcome.told_late.entry {
            self.outcome.late.entry = true;
            return;
        }
        let stance = self.desired.tracker.stance(&self.scratch.placement);
        if let Some(mut q) = self.motion.take_next() {
            if let Some(way) = q.entry.take().and_then(|e| e.task.take()) {
                let begins = way.clip.sample(0.0).posture;
                q.stance = Some(self.desired.tracker.stance_of(&self.setup.body, &begins));
                q.first = way.begin;
                q.plan = q.plan.entered_by(&self.setup.body, &way);
                q.play.way_in = Some(Arc::new(way));
            }
            let (play, plan) = q.begin(time, stance);
            self.desired
                .tracker
                .follow(Some(PlacedPlan::new(plan, play.speed, play.origin)));
            self.motion.lie_down();
            self.motion.enter(MotionSource::Clip(play));
            self.desired.get_up.reset();
        }
    }

    /// A fallen figure gets up when its motion, which lay down, does: in its own way, after which it stands. Requests
    /// in between are queued.
    pub(in crate::figure) fn update_get_up(&mut self, time: WorldTime) {
        let able = self.mode().gets_up();
        if !self.motion.has_fallen() || !able || self.setup.options.assist >= 1.0 {
            self.motion.lie_down();
            if self.is_on_limbs() {
                self.desired.get_up.note_low_motion();
            } else if !self.is_low(self.workspace.terms.com.z) {
                self.desired.get_up.reset();
            }
            return;
        }
        let height = self.desired.com.now.z / self.constants.standing_com_height;
        let get_up = &mut self.desired.get_up;
        let (terms, solver) = (&self.workspace.terms, &self.scratch.get_up);
        match get_up.decide(solver, terms, height, self.motion.gets_up()) {
            GetUpDecision::Continue => {}
            GetUpDecision::Begin => {
                self.workspace.reset_modern();
                self.motion.begin_to_get_up();
            }
            GetUpDecision::GiveUp => {
                self.workspace.reset_modern();
                self.motion.give_up();
            }
        }
        let is_up = self.motion.gets_up() && self.desired.get_up.is_over();
        if is_up && self.stands_on_feet() {
            self.stand_up();
            self.plan_entry(time);
        }
    }

    /// It stands, and holds the posture that it has reached.
    fn stand_up(&mut self) {
        self.motion.stand_up(self.desired.target.next.posture);
        self.desired.get_up.reset();
        self.desired.tracker.follow(None);
        self.start_afresh();
    }

    /// Whether only its feet touch, as its way has it, and it is up.
    fn stands_on_feet(&self) -> bool {
        let points = self.surroundings.support.points();
        self.workspace.terms.com.z > UP_HEIGHT * self.constants.standing_com_height
            && self.desired.target.next.planted == [true; 2]
            && points.iter().all(|p| FEET.contains(&p.segment))
            && self.surroundings.support.rests().is_empty()
    }

    /// Comes to a stand from world time `time` on: a walk ends with the steps that this takes, and any other motion is
    /// held as it is. The steps are planned in the background, while the motion continues. Allocates.
    pub fn stop(&mut self, time: WorldTime) {
        self.motion.take_next();
        self.motion.take_stream_entry();
        // Stops may have been left out in favour of a direct switch.
        let exit = self.motion.take_exit().filter(|l| !l.leads_over());
        self.motion.plan_exit(exit);
        // It is stopping already: a step that is under way is finished.
        if self.motion.stops()
            || self.motion.exit().is_some()
            || matches!(self.motion.source(), MotionSource::Hold(_))
        {
            return;
        }
        if !self.steps() || !self.desired.tracker.is_walking() {
            let posture = self.desired.target.next.posture;
            self.set_drive(MotionSource::Hold(posture));
            return;
        }
        self.leave_for_a_stand(LEAD, time);
    }
}
