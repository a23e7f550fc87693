//! One tick of one figure (docs/tick.md). The world calls [`Figure::begin`], lends a [`workspace`], and calls
//! [`Figure::decide`], then [`Figure::integrate`], or the substeps of [`cluster`] for figures that are near something,
//! then [`Figure::finish`]. Their bodies are the list of stages:
//!
//! 1. `commands`: loads and pushes that are due.
//! 2. `sense`: dynamics of the present state; `update_activity` and `update_desired_motion`: its activity and target.
//! 3. `update_support`: its support, and whether its balance is lost; `update_help`: whether its motion is being lost.
//! 4. `limit_torques`: the torque that muscles and tissue can give.
//! 5. `solve_control`: tasks, then accelerations and torques within strength.
//! 6. `integrate`: motors, joint limits and contact move the body.
//! 7. `contain`: freezes a state that is not finite, or for which no finite decision was found.
//! 8. `write_report`: the results of the tick.

mod actuation;
mod cluster;
mod fall_detection;
mod helping;
mod low_motion;
mod motion_switch;
mod playback;
mod rehearsal;
mod reporting;
mod second_hand;
mod stream_entry;

use crate::figure::params::support::REST_SHARE;
use crate::figure::state::figure::Figure;
use crate::figure::state::parts::{DesiredMotion, PhysicalState, Surroundings, TickOutcome};
use crate::figure::state::workspace::Workspace;
use crate::figure::state::workspace::WorkspaceSlot;
use crate::tick_context::TickContext;

use crate::body::State;
use crate::body::angles::{angles_of, swings};
use crate::contact::Tissue;
use crate::control::{Controller, MomentumTarget};
use crate::figure::motion::following::FollowMode;
use crate::figure::motion::plan_task::LatePlans;
use crate::figure::motion::tasks::TaskPoints;
use crate::math::Vec3;
use crate::motion::arm_ik::ARMS;
use crate::paper::prescribed_step::{Decision, KinematicStepper};
use crate::report::Flags;
use crate::stepper::command::{StepForces, StepInput, Stepper, TickStart};
use crate::stepper::pelvis_wrench::{Assist, PelvisHelp};
use crate::stepper::self_contact::OwnBody;
use crate::stepper::torque_step::{Accuracy, TorqueStepper};
use crate::support::Support;
use crate::track::TaskTargets;

/// Everything that moves the body in a tick: the steppers, their input, and the state that they move.
struct Integration<'a> {
    input: StepInput<'a>,
    torque: &'a mut TorqueStepper,
    kinematic: &'a mut KinematicStepper,
    controller: &'a dyn Controller,
    support: &'a Support,
    state: &'a mut State,
}

/// The demands of the steps on the controller.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::figure) struct StepDemand {
    /// Horizontal acceleration of the centre of mass that keeps the balance, world axes, m/s².
    acceleration: Option<[f64; 2]>,
    /// Angular momentum to be reached at lift-off.
    momentum: Option<MomentumTarget>,
}

impl Figure {
    /// Stage 1, and the dynamics of the present state: these must be known for every figure before it is known which
    /// figures are near each other. The tick of a frozen figure ends here.
    pub(crate) fn begin(&mut self, world: &TickContext) {
        self.neighbours.moved_alone = false;
        self.outcome.watcher.begin();
        self.outcome.late = LatePlans::default();
        self.commands(world);
        if self.physical.frozen {
            self.outcome.report.flags = Flags::QUARANTINED;
            self.motion
                .note(FollowMode::Nothing, [0.0; 2], 0.0, world.dt);
        } else {
            let PhysicalState { links, state, .. } = &self.physical;
            self.scratch.placement.set_state(links, state);
        }
    }

    /// Takes the workspace of `slot` for the rest of a tick on ground with friction coefficient `friction`.
    pub(crate) fn borrow(&mut self, slot: &mut WorkspaceSlot, friction: f64) {
        self.workspace.borrow(slot, friction);
    }

    /// Returns it.
    pub(crate) fn give_back(&mut self, slot: &mut WorkspaceSlot) {
        self.workspace.give_back(slot, !self.physical.frozen);
    }

    /// Stages 2–5 of a tick: the rest of the work before the body moves.
    pub(crate) fn decide(&mut self, world: &TickContext) {
        self.sense(world);
        self.update_activity(world);
        self.update_desired_motion(world);
        self.update_support(world);
        self.update_help(world);
        self.limit_torques(world);
        self.solve_control(world);
    }

    /// Stages 7 and 8 of a tick, after the body has moved.
    pub(crate) fn finish(&mut self, world: &TickContext) {
        self.surroundings.touches.end(&mut self.outcome.watcher);
        self.update_fatigue(world.dt);
        let frozen = self.contain();
        self.write_report(world, frozen);
        if frozen {
            self.forget_numbers();
        }
        self.detect_fall();
        let TickOutcome {
            report, watcher, ..
        } = &mut self.outcome;
        watcher.observe(report, &self.surroundings.support, self.motion.has_fallen());
    }

    /// Stage 1: loads and pushes that are due.
    fn commands(&mut self, world: &TickContext) {
        self.surroundings.disturbances.apply(
            world.time().0,
            world.dt,
            &self.setup.body,
            &mut self.physical.links,
            &mut self.physical.state,
            &mut self.outcome.watcher,
        );
    }

    /// Stage 2: dynamics of the present state.
    fn sense(&mut self, world: &TickContext) {
        let links = &self.physical.links;
        let applied = self.surroundings.disturbances.applied();
        let terms = &mut self.workspace.terms;
        terms.compute_placed(links, &self.scratch.placement, applied, world.gravity);
        self.scratch.com_velocity = terms.com_velocity;
    }

    /// Stage 2: switches between motions that are due; a fallen figure gets up if its motion does.
    fn update_activity(&mut self, world: &TickContext) {
        self.break_off_if_barred(world);
        self.begin_again_if_lost(world);
        self.leave_rehearsal_if_over(world);
        self.leave_ended_stream(world.time());
        self.follow_exit_if_due(world);
        self.begin_next_if_ready(world);
        self.settle_stream_entry_if_due(world);
        self.outcome.told_late = LatePlans::default();
        self.update_get_up(world.time());
        self.begin_rehearsal_if_due(world);
    }

    /// Stage 2: desired motion of the tick.
    fn update_desired_motion(&mut self, world: &TickContext) {
        self.desired.target = self.sample_motion(world.time(), world.dt);
        let steps = self.steps() && self.desired.tracker.is_walking();
        // A rehearsal already took the loads into account.
        if self.motion.rehearsed().is_none() {
            self.desired.load_compensation.compensate(
                &self.setup.body,
                &self.physical.links,
                &mut self.desired.target,
                steps,
                world.dt,
            );
        }
        if self.steps() && !self.motion.gets_up() {
            let (body, out) = (&self.setup.body, &mut self.desired.target);
            self.desired.tracker.trail(body, out, world.dt);
        }
        self.lead_second_hand(world);
        if self.mode().sets_velocities_back() {
            let share = 0.5 / f64::from(world.substeps);
            self.desired.target.set_velocities_back(share);
        }
    }

    /// Stage 3: its grips and supports, and whether it keeps its balance.
    fn update_support(&mut self, world: &TickContext) {
        let bar = self.workspace.steppers.torque.forces.bar;
        let least = self.least_rest(world);
        let at_once = self.mode_in_charge().rests_at_once();
        let terms = &self.workspace.terms;
        let Surroundings {
            disturbances,
            support,
            touches,
            ..
        } = &mut self.surroundings;
        disturbances.check_grip(world.time().0, world.dt, terms, world.gravity, bar);
        let acceleration = self.physical.com_acceleration;
        support.update(terms, &self.setup.body, acceleration, world.gravity);
        let pull = acceleration + Vec3::Z * world.gravity;
        support.rest_on(touches.rests(terms, least, at_once), terms.com, pull);
        self.watch_balance(world);
    }

    /// Force from which a part counts as resting on something, N.
    fn least_rest(&self, world: &TickContext) -> f64 {
        REST_SHARE * self.workspace.terms.mass * world.gravity
    }

    /// Stage 4: the torque of the muscles at these angles and rates, and of stretched tissue. A mode may do without
    /// tissue.
    fn limit_torques(&mut self, world: &TickContext) {
        let has_tissue = self.mode().has_tissue();
        let strength = &self.constants.strength;
        let state = &self.physical.state;
        let results = &mut self.scratch.results;
        let h = world.dt / f64::from(world.substeps);
        results.swings = swings(&state.posture);
        results.tissue =
            has_tissue.then(|| Tissue::new(strength, (state, &results.swings), world.substeps, h));
        results.angles = angles_of(&results.swings, &state.posture);
        results.rates = std::array::from_fn(|j| state.velocity[6 + j]);
        self.physical.muscles = self.available_strength();
        let results = &mut self.scratch.results;
        self.constants.strength.range(
            &results.angles,
            &results.rates,
            &self.physical.muscles,
            &mut results.available.lower,
            &mut results.available.upper,
        );
    }

    /// Stage 5: tasks of the tick, then the controller's decision. The controller relies on the figure's supports and
    /// on its stretched tissue.
    fn solve_control(&mut self, world: &TickContext) {
        let bias = self.workspace.terms.h;
        let least = self.least_rest(world);
        let stands = self.surroundings.support.main().is_some();
        let chosen = self.mode_in_charge().chosen_rests(least, stands);
        let (terms, results) = (&mut self.workspace.terms, &self.scratch.results);
        self.surroundings.touches.add_reactions(terms, chosen);
        let inertia = results.tissue.as_ref().map(|t| t.add_to(terms));
        let (tasks, steps) = self.plan_tasks(world);
        self.look_for_limbs(tasks.com.now.z);
        let prescribes = self.prescribes();
        self.stepping.prescribe(prescribes);
        let mut command = self.control(world, &tasks, steps);
        self.scratch.results.undecided = !command.is_finite();
        if self.scratch.results.undecided {
            // The tick ends with `contain`; until then the numbers must not reach any figure nearby.
            command.acceleration.fill(0.0);
            command.torque.fill(0.0);
            self.scratch.results.planned_help = None;
        }
        self.scratch.results.command = command;
        self.update_hand_over(world.dt);
        let (terms, results) = (&mut self.workspace.terms, &mut self.scratch.results);
        terms.h = bias;
        if let Some(inertia) = inertia {
            Tissue::restore(&inertia, terms);
        }
        self.desired.com = tasks.com;
        results.before = self.physical.state;
        results.assist = Assist::new(&self.setup.body, self.setup.options.assist);
    }

    /// Centre of mass, hands and feet of the desired motion, changed by constraints and steps.
    fn plan_tasks(&mut self, world: &TickContext) -> (TaskPoints, StepDemand) {
        let makes_steps = self.steps() && !self.is_carried() && !self.is_on_limbs();
        let body = &self.setup.body;
        let Workspace {
            terms,
            tasks: buffers,
            ..
        } = &mut *self.workspace;
        let floor = &mut self.scratch.floor;
        let DesiredMotion {
            target,
            constraints,
            get_up,
            second_hand,
            ..
        } = &mut self.desired;
        let support = &mut self.surroundings.support;
        let mut tasks = buffers.points(body, &self.physical.links, target);
        constraints.begin(
            world.time().0,
            body,
            terms,
            support,
            &mut tasks.com,
            &tasks.hands,
            |s, p| buffers.desired_point(target, s, p),
        );
        if let Some(hand) = second_hand.led() {
            constraints.release(ARMS[hand][2]);
        }
        support.plan_rests(terms, |s, p| buffers.desired_point(target, s, p));
        if self.motion.gets_up() {
            let off = tasks.com.now - terms.com;
            get_up.plan_contacts(body, buffers, target, off, floor);
        }
        let mut steps = StepDemand::default();
        if makes_steps {
            let mut targets = TaskTargets {
                com: &mut tasks.com,
                momentum: tasks.spin[0],
                momentum_rate: (tasks.spin[1] - tasks.spin[0]) * (1.0 / world.dt),
                feet: &mut tasks.feet,
                unplanned_steps: self.setup.params.protective_steps,
            };
            steps.acceleration = self.desired.tracker.update_tasks(
                terms,
                &self.surroundings.support,
                world.gravity,
                world.dt,
                &mut targets,
            );
            steps.momentum = self.lift_off_momentum();
        }
        (tasks, steps)
    }

    /// Stage 6: motors, limits and ground move the body, or its accelerations do.
    pub(crate) fn integrate(&mut self, world: &TickContext) {
        self.surroundings.touches.begin();
        if self.stepping.is_prescribed() {
            if self.integrate_accelerations(world) {
                return;
            }
            self.hand_over();
        }
        let Integration {
            input,
            torque,
            kinematic,
            state,
            ..
        } = self.integration(world);
        kinematic.reset();
        torque.step(&input, state);
    }

    /// Applies the controller's accelerations. Returns `false` if they must be within strength and are not.
    fn integrate_accelerations(&mut self, world: &TickContext) -> bool {
        let as_commanded = self.mode().keeps_torques(self.setup.params.share);
        let within_strength = self.setup.params.hand_over;
        let planted = self.desired.target.next.planted;
        let Integration {
            input,
            kinematic,
            controller,
            support,
            state,
            ..
        } = self.integration(world);
        let decision = Decision {
            command: controller.command(),
            left_out: controller.left_out(),
            as_commanded,
            within_strength,
            support,
            planted,
        };
        kinematic.step(&input, &decision, state)
    }

    /// Whether the body cannot pass through itself in this tick. A rehearsed motion was found without self-collision.
    fn meets_itself(&self) -> bool {
        self.setup.options.self_contact && self.motion.rehearsed().is_none()
    }

    /// The steppers, their input, and the state that they move.
    fn integration<'a>(&'a mut self, world: &'a TickContext) -> Integration<'a> {
        let (stiff, pull) = (self.is_stiff(), self.pull());
        let meets_itself = self.meets_itself();
        let results = &self.scratch.results;
        let target = &self.desired.target;
        let spring = results.assist.as_ref();
        let assist = match self.motion.rehearsed() {
            Some(play) => play.help(world.time(), &self.setup.body, target),
            None => match (pull, results.planned_help) {
                (Some(pull), _) => Some(PelvisHelp::Pull(pull, target)),
                (None, Some(wrench)) => Some(PelvisHelp::Planned(wrench)),
                (None, None) => spring.map(|a| PelvisHelp::Desired(*a, target)),
            },
        };
        let accuracy = if stiff || self.motion.rehearsed().is_some() {
            Accuracy::REHEARSED
        } else {
            Accuracy::default()
        };
        let Workspace {
            terms,
            controllers,
            steppers,
            ..
        } = &mut *self.workspace;
        steppers.torque.set_accuracy(accuracy);
        let disturbances = &self.surroundings.disturbances;
        let input = StepInput {
            world,
            body: &self.setup.body,
            links: &self.physical.links,
            strength: &self.constants.strength,
            scale: &self.physical.muscles,
            start: TickStart {
                terms,
                swings: &results.swings,
                available: &results.available,
            },
            last_acceleration: &self.outcome.report.audit.acceleration,
            command: &results.command,
            tissue: results.tissue.as_ref(),
            forces: StepForces {
                applied: disturbances.applied(),
                bar: disturbances.bar(),
                assist,
            },
            own: meets_itself.then_some(OwnBody {
                shape: &self.constants.shape,
                desired: target,
            }),
        };
        Integration {
            input,
            torque: &mut steppers.torque,
            kinematic: &mut steppers.kinematic,
            controller: controllers.get(self.setup.controller),
            support: &self.surroundings.support,
            state: &mut self.physical.state,
        }
    }
}

#[cfg(test)]
mod tests;
