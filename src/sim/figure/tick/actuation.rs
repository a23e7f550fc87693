//! Stages 4 and 5: what the muscles can give, what the motion asks for, and the controller's answer.

use super::{Figure, TickContext};
use crate::sim::body::topology::DOF_COUNT;
use crate::sim::control::{
    CentroidalTarget, ContactPhase, ContactTargets, ControlInput, Controller, Law, MomentumTarget,
    tracking,
};
use crate::sim::figure::assist::Assist;
use crate::sim::figure::drive::Drive;
use crate::sim::figure::setup::{ControlParams, ControllerKind, StrengthScale};
use crate::sim::figure::tasks::TaskPoints;
use crate::sim::figure::torque_step::{
    FALLEN_SPEED, FEED_FORWARD_SPEED, MODERN_SPEED, MOTORS_ALONE_SPEED, MotorCommand,
};
use crate::sim::motion::TargetPair;
use crate::sim::strength::MuscleScale;

/// A fallen figure relaxes: share of its strength, and time constant of its demand, s (ALGORITHM §12).
const FALLEN_STRENGTH: f64 = 0.3;
const FALLEN_HORIZON: f64 = 0.3;

impl Figure {
    /// Desired motion of the tick: as the drive has it, or as its steps come out.
    pub(super) fn desired(&mut self, time: f64, dt: f64) -> TargetPair {
        if let Drive::Live(live) = &mut self.drive {
            live.motion.advance(live.stream_time(time + dt));
            self.tracker.follow_stream(&live.motion);
        }
        let last = self.target.next.posture;
        let body = &self.setup.body;
        if let Some(way) = self.rising.targets(body, &self.terms, &last, dt) {
            return way;
        }
        if !self.steps() {
            return self.drive.targets(time, dt);
        }
        let drive = &self.drive;
        let clip_time = |t: f64| match drive {
            Drive::Clip(play) => play.clip_time(t),
            Drive::Live(live) => live.stream_time(t),
            _ => t,
        };
        self.tracker
            .targets(time, dt, &self.terms, clip_time, |now, next| {
                drive.pair(now, next)
            })
    }

    /// True if steps follow events: the modern controller, and a figure that is up. Full assist pins the pelvis to its
    /// path, so the motion keeps its clock and its place there.
    pub(super) fn steps(&self) -> bool {
        !self.fallen
            && !self.balance.lost()
            && self.setup.controller == ControllerKind::Modern
            && self.setup.options.assist < 1.0
    }

    /// Angular momentum that the motion has in its next flight, to be reached at lift-off; `None` if no flight begins
    /// soon, or if its momentum is not known.
    pub(super) fn lift_off_momentum(&mut self) -> Option<MomentumTarget> {
        let flight = self.tracker.next_flight()?;
        let spin = match &self.drive {
            Drive::Clip(play) => self.tasks.spin(&self.links, &play.sample(flight.middle)),
            Drive::Live(live) => live.motion.spin_at(live.stream_time(flight.middle))?,
            Drive::Hold(_) | Drive::External(_) => return None,
        };
        Some(MomentumTarget {
            value: self.tracker.turned(spin),
            within: flight.after,
        })
    }

    /// Factors on the muscles: a fallen figure relaxes, a tired one has less.
    pub(super) fn available_strength(&self) -> MuscleScale {
        let fallen = if self.is_limp() { FALLEN_STRENGTH } else { 1.0 };
        let mut out = self.setup.strength.muscles(fallen);
        if let Some(fatigue) = &self.fatigue {
            for (scale, left) in out.0.iter_mut().zip(fatigue.remaining()) {
                scale[0] *= left[0];
                scale[1] *= left[1];
            }
        }
        out
    }

    /// Fatigue of a tick: loads are torques over what the rested person could give at full effort.
    pub(super) fn tire(&mut self, angles: &[f64; DOF_COUNT], rates: &[f64; DOF_COUNT], dt: f64) {
        let Some(fatigue) = &mut self.fatigue else {
            return;
        };
        let rested = StrengthScale {
            effort: 1.0,
            ..self.setup.strength.clone()
        };
        let (mut lower, mut upper) = ([0.0; DOF_COUNT], [0.0; DOF_COUNT]);
        self.strength
            .range(angles, rates, &rested.muscles(1.0), &mut lower, &mut upper);
        let torque = if self.prescribed {
            &self.kinematic.forces.torque
        } else {
            &self.stepper.forces.torque
        };
        fatigue.step(torque, &lower, &upper, dt);
        self.report.remaining = fatigue.remaining();
    }

    /// Runs the controller in charge and turns its command into work for the motors.
    pub(super) fn control(
        &mut self,
        world: &TickContext,
        tasks: &TaskPoints,
        centroidal: CentroidalTarget<'_>,
        (lower, upper): (&[f64; DOF_COUNT], &[f64; DOF_COUNT]),
    ) -> MotorCommand {
        let (mut hands, mut free) = (tasks.hands, 0);
        for hand in self.constraints.free_hands() {
            hands[free] = hand;
            free += 1;
        }
        let input = ControlInput {
            carried: self.carrying.in_hands(),
            terms: &self.terms,
            body: &self.setup.body,
            support: &self.support,
            target: &self.target,
            centroidal,
            contacts: ContactTargets {
                feet: &tasks.feet,
                phase: centroidal
                    .momentum
                    .map_or(ContactPhase::Stance, |_| ContactPhase::LiftOff),
                places_known: self.tracker.has_planned_footholds(),
                floor: self.rising.on_floor(),
            },
            effectors: &hands[..free],
            goals: self.constraints.goals(),
            lower,
            upper,
            params: &self.setup.params,
            gravity: world.gravity,
            dt: world.dt,
            assist: Assist::new(&self.setup.body, self.setup.options.assist)
                .map_or([0.0; 2], |a| a.planned()),
            kinematic: self.prescribed,
        };
        let (command, saturation_speed) = match self.active_controller() {
            ControllerKind::Paper => (self.paper.control(&input), FEED_FORWARD_SPEED),
            ControllerKind::Modern => (self.modern.control(&input), MODERN_SPEED),
            ControllerKind::Motors => {
                let horizon = if self.is_limp() {
                    Some(FALLEN_HORIZON)
                } else {
                    self.setup.params.horizon
                };
                let params = ControlParams {
                    horizon,
                    ..self.setup.params.clone()
                };
                let law = Law::new(&params, world.dt);
                let demand = tracking::initial_acceleration(
                    &self.setup.body,
                    &self.state,
                    &self.target,
                    &law,
                );
                self.motors
                    .joint_acceleration
                    .copy_from_slice(&demand[..DOF_COUNT]);
                (
                    &self.motors,
                    if self.is_limp() {
                        FALLEN_SPEED
                    } else {
                        MOTORS_ALONE_SPEED
                    },
                )
            }
        };
        let out = MotorCommand {
            acceleration: command.joint_acceleration,
            torque: command.torque,
            saturation_speed,
        };
        self.report.saturated = command.saturated;
        self.report.saturated_secondary = command.saturated_secondary;
        self.report.control_iterations = command.iterations;
        self.report.flags = command.flags;
        self.tips = command.pivot.is_some();
        out
    }
}
