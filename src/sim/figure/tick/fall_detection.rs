//! Detection of lost balance and of falls, the choice of the stepper, and containment of states that are not finite.

use crate::body::SegmentId;
use crate::body::topology::{HEAD, L_FOOT, L_TOES, NV, R_FOOT, R_TOES};
use crate::control::Mode;
use crate::control::PointTarget;
use crate::figure::balance::live_help::LiveHelp;
use crate::figure::balance::loss::Observation;
use crate::figure::constraints::MAX_CONSTRAINTS;
use crate::figure::events::FigureEvent;
use crate::figure::motion::source::MotionSource;
use crate::figure::params::balance::PAPER_REACH;
use crate::figure::params::fall::{FALLEN_HEIGHT, RISEN_HEIGHT};
use crate::figure::params::get_up::STILL_SPEED;
use crate::figure::state::controllers::mode;
use crate::figure::state::figure::Figure;
use crate::figure::state::parts::rested;
use crate::motion::{Target, TargetPair};
use crate::paper::hand_over::HandOverView;
use crate::report::TickReport;
use crate::setup::ControllerKind;
use crate::stepper::forces::MAX_APPLIED;
use crate::tick_context::TickContext;

/// Parts that a figure stands on.
pub(in crate::figure) const FEET: [SegmentId; 4] = [L_FOOT, L_TOES, R_FOOT, R_TOES];

impl Figure {
    /// Decides whether balance is lost. Full assist holds the pelvis, so there is none to lose; and prescribed
    /// accelerations fall by themselves.
    pub(in crate::figure) fn watch_balance(&mut self, world: &TickContext) {
        let s = &self.setup;
        let falls = self.may_prescribe();
        let helped = self.is_carried() || self.surroundings.help.acts();
        let low = self.motion.gets_up() || self.is_on_limbs();
        let knows = low || self.motion.rehearsed().is_some() || helped;
        let watched = !(knows || falls || !s.params.hand_over || s.options.assist > 0.0);
        let reach = self.mode().balance_reach(&s.params);
        let Some(reach) = reach.filter(|_| watched) else {
            self.surroundings.balance.reset();
            return;
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

    /// Makes controllers and steps forget a figure that has fallen or stumbled since.
    pub(in crate::figure) fn start_afresh(&mut self) {
        self.workspace.reset_controllers();
        self.desired.tracker.reset();
    }

    /// The mode that is set.
    pub(in crate::figure) fn mode(&self) -> &'static dyn Mode {
        mode(self.setup.controller)
    }

    /// The mode in charge.
    pub(in crate::figure) fn mode_in_charge(&self) -> &'static dyn Mode {
        mode(self.controller_in_charge())
    }

    /// Whether accelerations should move the figure, and torques have not taken over.
    fn may_prescribe(&self) -> bool {
        self.setup.stepper.prescribes() && !self.stepping.is_handed_over()
    }

    /// The chosen controller, or motors alone once balance is lost or the figure lies on the ground.
    pub(in crate::figure) fn controller_in_charge(&self) -> ControllerKind {
        let motors = self.motion.is_limp() || self.motion.rehearsed().is_some() || self.is_stiff();
        if motors || self.surroundings.balance.lost() {
            ControllerKind::Motors
        } else {
            self.setup.controller
        }
    }

    /// Whether it falls as a person does ([`bracing`](crate::figure::balance::bracing)): from the loss of balance until
    /// neither body nor head moves down any more. This excludes a motion that goes to the floor by itself, or that has
    /// lost its balance as the figure has, like one that sits down on a seat. It also excludes the paper's controller,
    /// whose falls are those of the paper, and feet that have to stay in place.
    pub(in crate::figure) fn braces(&self) -> bool {
        let s = &self.setup;
        let person = self.mode().braces_falls(&s.params);
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

    /// Whether accelerations are applied as they are. A load held in two hands and the assist act by forces, which need
    /// torques.
    pub(in crate::figure) fn prescribes(&self) -> bool {
        self.may_prescribe()
            && self.setup.options.assist == 0.0
            && !self.surroundings.help.acts()
            && self.surroundings.disturbances.bar().is_none()
            && self.mode_in_charge().decides()
            && !self.motion.gets_up()
    }

    /// Lets torques take over from prescribed accelerations, or hand back to them.
    pub(in crate::figure) fn update_hand_over(&mut self, dt: f64) {
        let upright = !self.motion.has_fallen() && !self.surroundings.balance.lost();
        let seen = HandOverView {
            allowed: self.setup.params.hand_over,
            body: &self.setup.body,
            terms: &self.workspace.terms,
            state: &self.physical.state,
            support: &self.surroundings.support,
            report: &self.outcome.report,
            upright,
            alone: self.surroundings.touches.list().next().is_none(),
        };
        self.stepping.update(&seen, dt);
    }

    /// Freezes a figure at its last good state if its state or desired motion is not finite, or if no finite decision
    /// was found for it; the rest of the world continues.
    pub(in crate::figure) fn contain(&mut self) -> bool {
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

    /// Forgets the memory that a frozen figure has of its last ticks: numbers that are not finite could not be read
    /// back from a checkpoint, and would freeze it again after a reset.
    pub(in crate::figure) fn forget_numbers(&mut self) {
        self.forget();
        self.desired.tracker.reset_clock();
        self.workspace.forget_bar();
        self.surroundings.help = LiveHelp::default();
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

    /// Commands a frozen figure to stay as it is. A motion with numbers out of range is forgotten.
    fn forget_what_was_asked(&mut self) {
        let posture = self.physical.state.posture;
        let still = Target::still(posture);
        self.desired.target = TargetPair {
            now: still.clone(),
            next: still,
        };
        self.desired.com = PointTarget::still(self.outcome.report.balance.com);
        if !self.motion.is_valid() {
            self.set_drive(MotionSource::Hold(posture));
        }
    }

    /// Empties the report of a frozen figure's last tick, which must not be read as physics: only that it was set
    /// aside, and its place, remain.
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

    /// Detects falls and recoveries from them.
    pub(in crate::figure) fn detect_fall(&mut self) {
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
        let held = self.motion.rehearsed().is_some() || self.is_held_up() || self.is_on_limbs();
        if !self.motion.has_fallen() && !held && height < FALLEN_HEIGHT && on_other {
            self.motion.fall();
        } else if self.motion.is_limp() && height > RISEN_HEIGHT {
            self.motion.rise();
            self.start_afresh();
        }
    }
}
