//! Detection of lost balance and of falls, the choice of the stepper, and containment of states that are not finite.

use super::state::rested;
use super::{Figure, TickContext};
use crate::body::SegmentId;
use crate::body::topology::{HEAD, L_FOOT, L_TOES, NV, R_FOOT, R_TOES};
use crate::control::PointTarget;
use crate::figure::balance_loss::{Observation, Reach};
use crate::figure::constraints::MAX_CONSTRAINTS;
use crate::figure::drive::Drive;
use crate::figure::events::FigureEvent;
use crate::figure::help::Help;
use crate::figure::kinematic_step::other_part_arrives;
use crate::figure::loads::MAX_APPLIED;
use crate::figure::params::balance::PAPER_REACH;
use crate::figure::params::fall::{FALLEN_HEIGHT, RISEN_HEIGHT};
use crate::figure::params::get_up::STILL_SPEED;
use crate::figure::params::kinematic::{CALM_TIME, SPEED_CAP};
use crate::motion::{Target, TargetPair};
use crate::report::{Flags, TickReport};
use crate::setup::ControllerKind;

/// Parts that a figure stands on.
pub(super) const FEET: [SegmentId; 4] = [L_FOOT, L_TOES, R_FOOT, R_TOES];

impl Figure {
    /// Is balance lost? Full assist holds the pelvis, so there is none to lose; and prescribed accelerations fall by
    /// themselves.
    pub(super) fn watch_balance(&mut self, world: &TickContext) {
        let s = &self.setup;
        let falls = s.stepper.prescribes() && self.stepping.handed_over.is_none();
        let motors = s.controller == ControllerKind::Motors;
        let knows = self.motion.gets_up() || self.motion.rehearsed().is_some() || self.is_carried();
        if knows || falls || motors || !s.params.hand_over || s.options.assist > 0.0 {
            self.surroundings.balance.reset();
            return;
        }
        let modern = s.controller == ControllerKind::Modern;
        let reach = match s.params.protective_steps {
            true if modern => Reach::Step,
            false if modern => Reach::Body,
            _ => Reach::Paper,
        };
        let height = self.workspace.terms.com.z / self.constants.standing_com_height;
        let before = self.surroundings.balance.lost();
        let off = self.desired.tracker.off_plan().filter(|_| self.steps());
        self.surroundings.balance.observe(&Observation {
            body: &s.body,
            terms: &self.workspace.terms,
            support: &self.surroundings.support,
            gravity: world.gravity,
            dt: world.dt,
            reach,
            height,
            off,
        });
        if before && !self.surroundings.balance.lost() {
            self.start_afresh();
        }
    }

    /// Controllers and steps forget what they knew of a figure that has fallen or stumbled since.
    pub(super) fn start_afresh(&mut self) {
        self.workspace.reset_controllers();
        self.desired.tracker.reset();
    }

    /// The chosen controller, or motors alone once balance is lost or the figure lies on the ground.
    pub(super) fn active_controller(&self) -> ControllerKind {
        let motors =
            self.motion.is_limp() || self.motion.rehearsed().is_some() || self.is_carried();
        if motors || self.surroundings.balance.lost() {
            ControllerKind::Motors
        } else {
            self.setup.controller
        }
    }

    /// True while it falls as a person does ([`bracing`](crate::figure::bracing)): from the loss of balance until
    /// neither body nor head go down any more. Not where its motion goes to the floor by itself, or has lost balance as
    /// the figure has, as one that sits down on a seat; nor with the paper's controller, whose falls are those of the
    /// paper, nor where feet have to stay.
    pub(super) fn braces(&self) -> bool {
        let s = &self.setup;
        let person = s.controller == ControllerKind::Modern && s.params.protective_steps;
        let terms = &self.workspace.terms;
        let wanted = self.desired.com.now;
        let falls = if self.motion.is_limp() {
            let head = terms.point_velocity(HEAD.index(), s.body.segment(HEAD).com);
            terms.com_velocity.z.min(head.z) < -STILL_SPEED
        } else {
            let departs = (terms.com - wanted).norm() > PAPER_REACH;
            self.surroundings.balance.lost() && departs && !self.motion.gets_up()
        };
        let height = wanted.z / self.constants.standing_com_height;
        person && falls && self.motion.rehearsed().is_none() && height > RISEN_HEIGHT
    }

    /// True if accelerations are to be applied as they are. A load held in two hands and the assist act by forces,
    /// which need torques.
    pub(super) fn prescribes(&self) -> bool {
        self.setup.stepper.prescribes()
            && self.setup.options.assist == 0.0
            && !self.surroundings.help.acts()
            && self.surroundings.disturbances.bar().is_none()
            && self.active_controller() != ControllerKind::Motors
            && self.stepping.handed_over.is_none()
            && !self.motion.gets_up()
    }

    /// Prescribed accelerations on a tilting support create energy once joints saturate, and they know nothing of parts
    /// other than feet: there torques take over, until the figure has stood calmly for a while. The
    /// state is the same for both.
    pub(super) fn update_hand_over(&mut self, dt: f64) {
        let r = &self.outcome.report;
        if self.stepping.prescribed && self.setup.params.hand_over {
            let saturated = (r.joints.saturated | r.joints.saturated_secondary) != 0;
            let arrives = other_part_arrives(&self.setup.body, &self.workspace.terms, dt);
            let fast = self.physical.state.velocity[6..]
                .iter()
                .any(|v| v.abs() > SPEED_CAP);
            if arrives || fast || (self.stepping.tips && saturated) || r.flags.has(Flags::OVERLOAD)
            {
                self.stepping.prescribed = false;
                self.stepping.handed_over = Some(0.0);
            }
        } else if let Some(calm) = self.stepping.handed_over {
            let points = self.surroundings.support.points();
            let flat = points.len() >= 3 && points.iter().all(|p| FEET.contains(&p.segment));
            let upright = !self.motion.has_fallen() && !self.surroundings.balance.lost();
            let alone = self.surroundings.touches.list().next().is_none();
            let stands = flat && upright && alone && !self.stepping.tips && r.joints.saturated == 0;
            self.stepping.handed_over = match calm + dt {
                t if !stands && t > 0.0 => Some(0.0),
                t if t > CALM_TIME => None,
                t => Some(t),
            };
        }
    }

    /// Freezes a figure whose state or desired motion is not finite, or for which no finite decision was found, at its
    /// last good state; the world goes on.
    pub(super) fn contain(&mut self) -> bool {
        let asked = [&self.desired.target.now, &self.desired.target.next];
        let good = self.physical.state.is_finite()
            && !self.scratch.results.undecided
            && asked.iter().all(|t| t.is_finite())
            && self.desired.com.is_finite();
        if good {
            self.physical.last_good = self.physical.state;
        } else {
            self.physical.state = self.physical.last_good;
            self.physical.state.velocity = [0.0; NV];
            self.physical.frozen = true;
            self.outcome.watcher.push(FigureEvent::Quarantined);
        }
        !good
    }

    /// Forgets what a frozen figure remembers of its last ticks: numbers that are not finite could not be read back
    /// from a checkpoint, and would freeze it again when it is reset.
    pub(super) fn forget_numbers(&mut self) {
        self.forget();
        self.desired.tracker.reset_clock();
        self.workspace.forget_bar();
        self.surroundings.help = Help::default();
        if self
            .physical
            .fatigue
            .as_ref()
            .is_some_and(|f| !f.is_valid())
        {
            self.physical.fatigue = rested(&self.setup.options);
        }
        self.scratch.results.before = self.physical.state;
        self.forget_what_was_asked();
        self.empty_report();
    }

    /// What a frozen figure is asked to do is to stay as it is. A motion that cannot be is forgotten.
    fn forget_what_was_asked(&mut self) {
        let posture = self.physical.state.posture;
        let still = Target::still(posture);
        self.desired.target = TargetPair {
            now: still.clone(),
            next: still,
        };
        self.desired.com = PointTarget::still(self.outcome.report.balance.com);
        if !self.motion.is_valid() {
            self.set_drive(Drive::Hold(posture));
        }
    }

    /// What the last tick of a frozen figure came to is not to be read as physics: only that it was set aside, and
    /// where it is.
    fn empty_report(&mut self) {
        let com = self.outcome.report.balance.com;
        let mut empty = TickReport::empty(&self.physical.state, MAX_CONSTRAINTS, MAX_APPLIED);
        empty.flags = self.outcome.report.flags;
        (empty.balance.com, empty.balance.com_desired) = (com, com);
        if let Some(fatigue) = &self.physical.fatigue {
            empty.joints.remaining = fatigue.remaining();
        }
        self.outcome.report = empty;
    }

    /// Falls and rises.
    pub(super) fn detect_fall(&mut self) {
        let height = self.workspace.terms.com.z / self.constants.standing_com_height;
        let on_other = self
            .outcome
            .report
            .contacts
            .iter()
            .any(|c| !FEET.contains(&c.segment))
            || self
                .surroundings
                .touches
                .list()
                .any(|t| !FEET.contains(&t.segment));
        let held = self.motion.rehearsed().is_some() || self.is_held_up();
        if !self.motion.has_fallen() && !held && height < FALLEN_HEIGHT && on_other {
            self.motion.fall();
        } else if self.motion.is_limp() && height > RISEN_HEIGHT {
            self.motion.rise();
            self.start_afresh();
        }
    }
}
