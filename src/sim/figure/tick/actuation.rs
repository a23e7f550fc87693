//! Stages 4 and 5: the torque that the muscles can give, the demands of the motion, and the controller's answer.

use crate::body::SegmentId;
use crate::body::topology::DOF_COUNT;
use crate::control::{
    CentroidalTarget, ContactTargets, ControlInput, HelpAllowance, MomentumTarget, StancePhase,
};
use crate::figure::balance::bracing;
use crate::figure::motion::source::MotionSource;
use crate::figure::motion::tasks::TaskPoints;
use crate::figure::params::bracing::HORIZON;
use crate::figure::params::fall;
use crate::figure::params::help::HOME_TIME;
use crate::figure::state::controllers::mode;
use crate::figure::state::figure::Figure;
use crate::figure::state::parts::StageResults;
use crate::figure::state::workspace::Workspace;
use crate::figure::tick::{StepDemand, low_motion};
use crate::math::Vec3;
use crate::motion::{Target, TargetPair};
use crate::report::POINTS_PER_SEGMENT;
use crate::setup::{ControlParams, StrengthScale};
use crate::stepper::command::MotorCommand;
use crate::stepper::pelvis_wrench::Assist;
use crate::strength::MuscleScale;
use crate::tick_context::TickContext;
use crate::time::WorldTime;

/// The law of motors without a controller.
struct UnledMotors {
    /// Parameters with the horizon of the law.
    params: ControlParams,
    /// Target that braces a fall, in place of the motion's.
    braced: Option<TargetPair>,
    /// Rate error at which a motor gives its full torque, rad/s, if it differs from that of the mode.
    saturation_speed: Option<f64>,
}

impl Figure {
    /// Desired motion of the tick: getting up, or the source of the motion, at the pace of its steps.
    pub(in crate::figure) fn sample_motion(&mut self, time: WorldTime, dt: f64) -> TargetPair {
        if let MotionSource::Live(live) = self.motion.source_mut() {
            live.motion.advance(live.stream_time(time + dt));
            self.desired.tracker.follow_stream(&live.motion);
        }
        if self.motion.gets_up() {
            let last = self.desired.target.next.posture;
            let (body, get_up) = (&self.setup.body, &mut self.scratch.get_up);
            let terms = &self.workspace.terms;
            return self.desired.get_up.targets(body, get_up, terms, &last, dt);
        }
        if !self.steps() {
            return self.motion.source().targets(time, dt);
        }
        let led = self.is_carried() || self.is_on_limbs();
        let fade = led.then_some(HOME_TIME);
        let drive = self.motion.source();
        let plan_time = |t| drive.plan_time(t);
        let (tracker, terms) = (&mut self.desired.tracker, &self.workspace.terms);
        let pair = |now, next| drive.pair(now, next);
        tracker.targets(time, dt, terms, plan_time, pair, fade)
    }

    /// Whether steps follow events: the mode makes steps, and the figure is up. Full assist pins the pelvis to its
    /// path, so the motion keeps its clock and its place there.
    pub(in crate::figure) fn steps(&self) -> bool {
        !self.motion.has_fallen()
            && !self.surroundings.balance.lost()
            && self.motion.rehearsed().is_none()
            && self.mode().makes_steps()
            && self.setup.options.assist < 1.0
    }

    /// Angular momentum of the motion in its next flight, which must be reached at lift-off; `None` if no flight begins
    /// soon, or if its momentum is unknown.
    pub(in crate::figure) fn lift_off_momentum(&mut self) -> Option<MomentumTarget> {
        let flight = self.desired.tracker.next_flight()?;
        let spin = match self.motion.source() {
            MotionSource::Clip(play) => self
                .workspace
                .tasks
                .spin(&self.physical.links, &play.sample(flight.middle)),
            MotionSource::Live(live) => live.motion.spin_at(live.stream_time(flight.middle))?,
            MotionSource::Hold(_) | MotionSource::External(_) | MotionSource::Rehearsed(_) => {
                return None;
            }
        };
        Some(MomentumTarget {
            value: self.desired.tracker.turned(spin),
            within: flight.after,
        })
    }

    /// Factors on the muscles: a fallen figure relaxes, and a tired one is weaker.
    pub(in crate::figure) fn available_strength(&self) -> MuscleScale {
        let fallen = if self.motion.is_limp() && !self.braces() {
            fall::STRENGTH
        } else {
            1.0
        };
        let mut out = self.setup.strength.muscles(fallen);
        if let Some(fatigue) = &self.physical.fatigue {
            for (scale, left) in out.0.iter_mut().zip(fatigue.remaining()) {
                scale[0] *= left[0];
                scale[1] *= left[1];
            }
        }
        out
    }

    /// Fatigue of a tick of `dt` seconds: loads are torques over those that the rested person could give at full
    /// effort.
    pub(in crate::figure) fn update_fatigue(&mut self, dt: f64) {
        let Some(fatigue) = &mut self.physical.fatigue else {
            return;
        };
        let rested = StrengthScale {
            effort: 1.0,
            ..self.setup.strength.clone()
        };
        let StageResults { angles, rates, .. } = &self.scratch.results;
        let (mut lower, mut upper) = ([0.0; DOF_COUNT], [0.0; DOF_COUNT]);
        self.constants
            .strength
            .range(angles, rates, &rested.muscles(1.0), &mut lower, &mut upper);
        let steppers = &self.workspace.steppers;
        let forces = steppers.result(self.stepping.is_prescribed()).forces;
        fatigue.step(&forces.torque, &lower, &upper, dt);
        self.outcome.report.joints.remaining = fatigue.remaining();
    }

    /// Runs the controller in charge and turns its command into work for the motors.
    pub(in crate::figure) fn control(
        &mut self,
        world: &TickContext,
        tasks: &TaskPoints,
        steps: StepDemand,
    ) -> MotorCommand {
        self.scratch.results.planned_help = None;
        let stiff = self.rehearsed_command(world);
        if let Some(command) = stiff.or_else(|| self.carried_command(world)) {
            return command;
        }
        let (mut hands, mut free) = (tasks.hands, 0);
        for hand in self.desired.constraints.free_hands() {
            hands[free] = hand;
            free += 1;
        }
        let kind = self.controller_in_charge();
        let mode = mode(kind);
        let unled = (!mode.decides()).then(|| self.unled(world.gravity));
        let unled = unled.as_ref();
        let help = self.help_terms(world.dt).filter(|_| mode.can_be_helped());
        let on_limbs = self.is_on_limbs();
        if help.is_some() || on_limbs {
            self.look_at_floor();
        }
        let as_it_lies = self.is_carried();
        let Workspace {
            terms,
            controllers,
            floor,
            ..
        } = &mut *self.workspace;
        let input = ControlInput {
            carried: self.desired.load_compensation.in_hands(),
            terms,
            body: &self.setup.body,
            support: &self.surroundings.support,
            target: unled
                .and_then(|u| u.braced.as_ref())
                .unwrap_or(&self.desired.target),
            centroidal: CentroidalTarget {
                com: &tasks.com,
                acceleration: steps.acceleration,
                momentum: steps.momentum,
            },
            contacts: ContactTargets {
                feet: &tasks.feet,
                phase: steps
                    .momentum
                    .map_or(StancePhase::Stance, |_| StancePhase::LiftOff),
                places_known: self.desired.tracker.has_planned_footholds(),
                floor: if self.motion.gets_up() {
                    Some(self.desired.get_up.on_floor(&self.scratch.floor))
                } else {
                    on_limbs.then(|| low_motion::on_limbs(&floor.heights))
                },
            },
            effectors: &hands[..free],
            goals: self.desired.constraints.goals(),
            lower: &self.scratch.results.available.lower,
            upper: &self.scratch.results.available.upper,
            params: unled.map_or(&self.setup.params, |u| &u.params),
            gravity: world.gravity,
            dt: world.dt,
            assist: Assist::new(&self.setup.body, self.setup.options.assist)
                .map_or([0.0; 2], |a| a.planned()),
            help: help.map(|help| HelpAllowance {
                compliance: help.compliance,
                most: help.most,
                kept: help.kept,
                heights: &floor.heights,
                floor: &floor.forces,
                as_it_lies,
            }),
            kinematic: self.stepping.is_prescribed(),
        };
        let command = controllers.get_mut(kind).control(&input);
        self.scratch.results.planned_help = help.map(|_| command.wrench);
        let saturation_speed = unled
            .and_then(|u| u.saturation_speed)
            .unwrap_or(mode.saturation_speed());
        let out = MotorCommand {
            acceleration: command.joint_acceleration,
            torque: command.torque,
            saturation_speed,
        };
        self.outcome.report.joints.saturated = command.saturated;
        self.outcome.report.joints.saturated_secondary = command.saturated_secondary;
        self.outcome.report.control_iterations = command.iterations;
        self.outcome.report.flags = command.flags;
        self.stepping.note_tipping(command.pivot.is_some());
        out
    }

    /// Notes for each contact point how high the motion has it, and how the floor pushed it in the last tick.
    fn look_at_floor(&mut self) {
        let Workspace { tasks, floor, .. } = &mut *self.workspace;
        let (body, target) = (&self.setup.body, &self.desired.target);
        for s in SegmentId::all() {
            let points = body.segment(s).contact_points.iter();
            for (vertex, p) in points.take(POINTS_PER_SEGMENT).enumerate() {
                floor.heights[s.index() * POINTS_PER_SEGMENT + vertex] =
                    tasks.desired_point(target, s, *p).z;
            }
        }
        floor.forces.fill(Vec3::zero());
        for c in &self.outcome.report.contacts {
            floor.forces[c.segment.index() * POINTS_PER_SEGMENT + c.vertex] = c.force;
        }
    }

    /// The target of motors without a controller: a fallen figure is limp, and a falling one braces itself.
    fn unled(&self, gravity: f64) -> UnledMotors {
        let braces = self.braces();
        let limp = self.motion.is_limp() && !braces;
        let braced = braces.then(|| {
            let body = &self.setup.body;
            let desired = &self.desired.target.next.posture;
            let held = bracing::posture(body, &self.workspace.terms, desired, gravity);
            TargetPair {
                now: Target::still(held),
                next: Target::still(held),
            }
        });
        let horizon = if limp {
            Some(fall::HORIZON)
        } else if braces {
            Some(HORIZON)
        } else {
            self.setup.params.horizon
        };
        UnledMotors {
            params: ControlParams {
                horizon,
                ..self.setup.params.clone()
            },
            braced,
            saturation_speed: limp.then_some(fall::SATURATION_SPEED),
        }
    }
}
