//! From one motion to another while the figure moves: from step to step where they fit, else by a stand for which what was asked for waits.

use super::Figure;
use super::judgement::FEET;
use crate::sim::control::Controller;
use crate::sim::figure::drive::{ClipPlayback, Drive, Queued};
use crate::sim::figure::setup::ControllerKind;
use crate::sim::gait::StepPlan;
use crate::sim::motion::Clip;
use std::sync::Arc;

/// A clip that waits begins so long before the motion that leads to it is over, if the figure has settled, s.
const SOONER: f64 = 0.4;
/// It begins at the latest so long after that motion is over, s.
const PATIENCE: f64 = 2.0;
/// A clip that begins with the pelvis above this share of its standing height, on both feet, begins standing.
const UPRIGHT: f64 = 0.9;
/// Who gets up stands once the centre of mass is above this share of its standing height.
const UP: f64 = 0.75;

impl Figure {
    /// Plays a clip from world time `time` on. A figure that walks, or is in the middle of another clip, goes over to it from step to step where the one
    /// is like the beginning of the other; else it finishes its step and stands first, as the clip begins. Then the clip begins where its feet are, unless
    /// `fixed` says that its origin is meant. One that stands already, has fallen, or makes no steps begins at once.
    ///
    /// Returns the world time at which the clip's time 0 plays, s. If the figure goes over or has to stand first, that is expected: the way is worked out
    /// aside, and taken in a tick that is fixed now. Allocates.
    pub fn play(&mut self, play: ClipPlayback, fixed: bool, time: f64) -> f64 {
        if !self.rising.is_rising() && (!self.steps() || !self.is_busy(time)) {
            let start = play.start;
            self.set_drive(Drive::Clip(play));
            return start;
        }
        let first = play.clip_time(time).clamp(-play.clip.lead_in(), 0.0);
        let begin = play.clip.sample(first);
        let from = play.start + first / play.speed;
        let upright =
            begin.posture.root_position.z > UPRIGHT * self.setup.body.standing_root_height();
        let goal = (upright && begin.planted == [true; 2]).then_some(begin.posture);
        let (due, entered) = self.leave(&play, (goal, fixed), from, time);
        let plan = StepPlan::new(&self.setup.body, &play.clip, play.looped);
        let stance = self.gait.stance_of(&self.setup.body, &begin.posture);
        let expected = entered.unwrap_or(due.max(from) - first / play.speed);
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

    /// The clip that is to begin, if one waits or is gone over to.
    pub fn next_clip(&self) -> Option<&Arc<Clip>> {
        let coming = |play: &ClipPlayback| {
            let way = play.way_in.as_ref();
            way.is_some_and(|w| self.gait.phase() < w.enters)
        };
        match (&self.queued, &self.drive) {
            (Some(q), _) => Some(&q.play.clip),
            (None, Drive::Clip(play)) if coming(play) => Some(&play.clip),
            _ => None,
        }
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
        plays || self.leaving.is_some() || self.gait.unplanned().is_some()
    }

    /// Begins the clip that waits, once the figure stands.
    pub(super) fn begin_queued(&mut self, time: f64) {
        let Some(q) = &self.queued else { return };
        if self.leaving.is_some() {
            return;
        }
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
        self.leaving = None;
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
    /// aside, while the motion goes on. Allocates.
    pub fn stop(&mut self, time: f64) {
        self.queued = None;
        // Ends may have been left out for a way over.
        self.leaving = self.leaving.take().filter(|l| !l.leads_over());
        // It does so already: a step that is under way is finished.
        if self.ending || self.leaving.is_some() || matches!(self.drive, Drive::Hold(_)) {
            return;
        }
        if !self.steps() || !self.gait.is_walking() {
            let posture = self.target.next.posture;
            self.set_drive(Drive::Hold(posture));
            return;
        }
        self.leave_for_a_stand(time);
    }
}
