//! One tick of one figure (ALGORITHM §10): the list of stages is [`Figure::step`].

mod transitions;

use super::FigureKey;
use super::assist::Assist;
use super::balance::{BalanceWatch, Reach};
use super::constraints::{Constraint, Constraints, MAX_CONSTRAINTS};
use super::drive::{Drive, LivePlayback, Queued};
use super::events::{FigureEvent, Watcher};
use super::kinematic_step::{Decision, KinematicStepper, SPEED_CAP, other_part_arrives};
use super::loads::Disturbances;
use super::report::{Audit, Flags, MAX_CONTACTS, TickReport};
use super::setup::{
    ControlParams, ControllerKind, FigureOptions, FigureSetup, Perturbation, Share, StepperKind,
    StrengthScale,
};
use super::tasks::{TaskPoints, TaskWorkspace};
use super::torque_step::{
    FALLEN_SPEED, FEED_FORWARD_SPEED, MODERN_SPEED, MOTORS_ALONE_SPEED, MotorCommand, StepInput,
    Stepper, TorqueStepper,
};
use super::touches::{Contacting, Touches};
use crate::sim::body::angles::anatomical_angles;
use crate::sim::body::topology::{DOF_COUNT, L_FOOT, L_TOES, NV, R_FOOT, R_TOES, SEGMENT_COUNT};
use crate::sim::body::{Body, Links, Posture, State};
use crate::sim::collide::MAX_TOUCHES;
use crate::sim::collide::island::{Articulated, Parts};
use crate::sim::collide::shape::BodyShape;
use crate::sim::contact::Outcome;
use crate::sim::control::{
    Balance, Command, ControlInput, Controller, Law, Modern, Paper, tracking,
};
use crate::sim::dynamics::{Kinematics, Terms, center_of_mass};
use crate::sim::gait::{Gait, Led, StepPlan};
use crate::sim::math::Vec3;
use crate::sim::motion::{PlanarTransform, Target, TargetPair};
use crate::sim::strength::fatigue::Fatigue;
use crate::sim::strength::{MuscleScale, Strength};
use crate::sim::support::Support;
use std::sync::Arc;

/// What a tick needs to know about the world.
#[derive(Clone, Copy, Debug)]
pub struct TickContext {
    /// Tick that is computed; it begins at `tick · dt`.
    pub tick: u64,
    /// Length of the tick, s.
    pub dt: f64,
    /// Substeps of torque simulation.
    pub substeps: u32,
    /// Magnitude of gravity, m/s².
    pub gravity: f64,
}
/// A figure has fallen when its CoM is below this share of its standing height and something other than a foot carries it.
const FALLEN_HEIGHT: f64 = 0.45;
/// A fallen figure relaxes: share of its strength, and time constant of its demand, s (ALGORITHM §12).
const FALLEN_STRENGTH: f64 = 0.3;
const FALLEN_HORIZON: f64 = 0.3;
/// Torques give back to prescribed accelerations after the figure has stood this long on flat feet with strength to spare, s.
const CALM_TIME: f64 = 0.5;
/// A part rests on something that carries this share of the weight.
const RESTS: f64 = 0.02;
/// It stands again when its CoM is above this share of the standing height.
const RISEN_HEIGHT: f64 = 0.6;

/// One figure of a world.
#[derive(Debug)]
pub struct Figure {
    setup: FigureSetup,
    strength: Arc<Strength>,
    state: State,
    last_good: State,
    links: Links,
    muscles: MuscleScale,
    fatigue: Option<Box<Fatigue>>,
    disturbances: Disturbances,
    drive: Drive,
    /// The drive brings it to a stand.
    ending: bool,
    /// What it does as soon as it stands.
    queued: Option<Box<Queued>>,
    gait: Box<Gait>,
    target: TargetPair,
    terms: Terms,
    support: Support,
    tasks: TaskWorkspace,
    constraints: Constraints,
    paper: Box<Paper>,
    modern: Box<Modern>,
    motors: Command,
    stepper: TorqueStepper,
    kinematic: Box<KinematicStepper>,
    /// Torques move the figure though accelerations should: for how long it has been calm since, s.
    handed_over: Option<f64>,
    /// The decision of the tick tips over an edge or a vertex.
    tips: bool,
    /// Accelerations moved the figure in the last tick.
    prescribed: bool,
    com_acceleration: Vec3,
    standing_com_height: f64,
    balance: BalanceWatch,
    fallen: bool,
    frozen: bool,
    report: TickReport,
    reported: bool,
    watcher: Watcher,
    pending: Pending,
    touches: Touches,
    shape: Arc<BodyShape>,
    /// Who it is near in this tick.
    pub(crate) cluster: usize,
    /// Put where it is since the last tick.
    pub(crate) is_new: bool,
}

/// What stage 6 works with.
struct Stage<'a> {
    input: StepInput<'a>,
    stepper: &'a mut TorqueStepper,
    kinematic: &'a mut KinematicStepper,
    controllers: (&'a Paper, &'a Modern),
    support: &'a Support,
    state: &'a mut State,
}

/// What the stages of a tick hand on.
#[derive(Debug)]
struct Pending {
    command: MotorCommand,
    lower: [f64; DOF_COUNT],
    upper: [f64; DOF_COUNT],
    tasks: TaskPoints,
    before: State,
    angles: [f64; DOF_COUNT],
    rates: [f64; DOF_COUNT],
    assist: Option<Assist>,
}

impl Articulated for (FigureKey, Box<Figure>) {
    fn parts(&mut self) -> Parts<'_> {
        self.1.stepper.parts()
    }
}

impl Figure {
    /// A figure on ground with friction coefficient `friction`; the world has validated the setup.
    pub(crate) fn new(setup: FigureSetup, friction: f64) -> Self {
        let still = Target::still(setup.state.posture);
        Self {
            strength: Arc::new(Strength::at_percentile(
                &setup.body,
                setup.strength.percentile,
            )),
            muscles: setup.strength.muscles(1.0),
            fatigue: rested(&setup.options),
            state: setup.state,
            last_good: setup.state,
            links: Links::new(&setup.body),
            disturbances: Disturbances::default(),
            drive: Drive::Hold(setup.state.posture),
            ending: false,
            queued: None,
            gait: Box::new(Gait::new(&setup.body)),
            target: TargetPair {
                now: still.clone(),
                next: still,
            },
            terms: Terms::default(),
            support: Support::default(),
            tasks: TaskWorkspace::default(),
            constraints: Constraints::default(),
            paper: Box::default(),
            modern: Box::new(Modern::new(friction)),
            motors: Command::default(),
            stepper: TorqueStepper::new(friction),
            kinematic: Box::new(KinematicStepper::new(friction)),
            handed_over: None,
            tips: false,
            prescribed: false,
            com_acceleration: Vec3::zero(),
            standing_com_height: standing_com_height(&setup.body),
            balance: BalanceWatch::default(),
            fallen: false,
            frozen: false,
            report: empty_report(&setup.state),
            reported: false,
            watcher: Watcher::default(),
            pending: Pending::new(&setup.state),
            touches: Touches::default(),
            shape: Arc::new(BodyShape::new(&setup.body)),
            cluster: 0,
            is_new: true,
            setup,
        }
    }

    /// Stages 1–5 of a tick: everything before the body moves. False for a frozen figure, whose tick ends here.
    pub(crate) fn prepare(&mut self, world: &TickContext) -> bool {
        let (time, dt) = (world.tick as f64 * world.dt, world.dt);
        self.watcher.begin();
        // 1. Commands: loads, pushes.
        let body = Arc::clone(&self.setup.body);
        self.disturbances.apply(
            time,
            dt,
            &body,
            &mut self.links,
            &mut self.state,
            &mut self.watcher,
        );
        if self.frozen {
            self.report.flags = Flags::QUARANTINED;
            return false;
        }
        // 2. Dynamics of the state, desired motion, 3. supports, 4. strength.
        self.terms.compute(
            &self.links,
            &self.state,
            self.disturbances.applied(),
            world.gravity,
        );
        self.begin_queued(time);
        self.target = self.desired(time, dt);
        self.disturbances.check_grip(
            time,
            dt,
            &self.terms,
            world.gravity,
            self.stepper.forces.bar,
        );
        self.support
            .update(&self.terms, &body, self.com_acceleration, world.gravity);
        let least = RESTS * self.terms.mass * world.gravity;
        self.support.rest_on(self.touches.rests(&self.terms, least));
        self.watch_balance(world);
        let angles = anatomical_angles(&self.state.posture);
        let rates: [f64; DOF_COUNT] = std::array::from_fn(|j| self.state.velocity[6 + j]);
        self.muscles = self.available_strength();
        let scale = &self.muscles;
        let (mut lower, mut upper) = ([0.0; DOF_COUNT], [0.0; DOF_COUNT]);
        self.strength
            .range(&angles, &rates, scale, &mut lower, &mut upper);
        // 5. Control: accelerations and torques within strength. What the figure leans on is known to it.
        let bias = self.terms.h;
        let modern = self.active_controller() == ControllerKind::Modern;
        self.touches.lean(&mut self.terms, modern.then_some(least));
        let mut tasks = self.tasks.points(&body, &self.links, &self.target);
        self.constraints.begin(
            time,
            &body,
            &self.terms,
            &self.support,
            &mut tasks.com,
            &tasks.hands,
            |s, p| self.tasks.desired_point(&self.target, s, p),
        );
        let mut balance = None;
        if self.steps() {
            let mut led = Led {
                com: &mut tasks.com,
                feet: &mut tasks.feet,
                unplanned: self.setup.params.protective_steps,
            };
            balance = self
                .gait
                .lead(&self.terms, &self.support, world.gravity, dt, &mut led);
        }
        self.prescribed = self.prescribes();
        let command = self.control(world, &tasks, balance, (&lower, &upper));
        self.judge_hand_over(dt);
        self.terms.h = bias;
        self.pending = Pending {
            command,
            lower,
            upper,
            tasks,
            before: self.state,
            angles,
            rates,
            assist: Assist::new(&body, self.setup.options.assist),
        };
        true
    }

    /// Stage 6: motors, limits and ground move the body, or its accelerations do.
    pub(crate) fn simulate(&mut self, world: &TickContext) {
        self.touches.begin();
        let paper = self.setup.controller == ControllerKind::Paper;
        let prescribed = self.prescribed;
        let as_commanded = paper && self.setup.params.share == Share::Paper;
        let within_strength = self.setup.params.hand_over;
        let planted = self.target.next.planted;
        if prescribed {
            let Stage {
                input,
                kinematic,
                controllers: (first, second),
                support,
                state,
                ..
            } = self.stage(world);
            let decision = Decision {
                command: if paper {
                    first.command()
                } else {
                    second.command()
                },
                left_out: first.left_out().filter(|_| paper),
                as_commanded,
                within_strength,
                support,
                planted,
            };
            if kinematic.step(&input, &decision, state) {
                return;
            }
            self.hand_over();
        }
        let Stage {
            input,
            stepper,
            kinematic,
            state,
            ..
        } = self.stage(world);
        kinematic.reset();
        stepper.step(&input, state);
    }

    /// What the steppers read, the steppers, and the state they move.
    fn stage(&mut self, world: &TickContext) -> Stage<'_> {
        let Self {
            setup,
            links,
            strength,
            muscles,
            terms,
            pending,
            disturbances,
            target,
            stepper,
            kinematic,
            paper,
            modern,
            support,
            state,
            ..
        } = self;
        let input = StepInput {
            body: &setup.body,
            links,
            strength,
            scale: muscles,
            terms,
            command: &pending.command,
            lower: &pending.lower,
            upper: &pending.upper,
            applied: disturbances.applied(),
            bar: disturbances.bar(),
            assist: pending.assist.as_ref().map(|a| (a, &*target)),
            gravity: world.gravity,
            dt: world.dt,
            substeps: world.substeps,
        };
        Stage {
            input,
            stepper,
            kinematic,
            controllers: (paper, modern),
            support,
            state,
        }
    }

    /// True if accelerations move it in this tick, whatever it meets.
    pub(crate) fn is_prescribed(&self) -> bool {
        self.prescribed
    }
    /// Something will be met, and contact acts by forces: torques take over before the tick begins.
    pub(crate) fn hand_over(&mut self) {
        self.prescribed = false;
        self.handed_over = Some(0.0);
    }
    /// Stage 6 among others: shows where the segments are before it is known who moves them.
    pub(crate) fn show(&mut self) {
        self.stepper.terms.clone_from(&self.terms);
    }

    /// Stage 6 among others: starts the tick.
    pub(crate) fn begin_substeps(&mut self) {
        self.kinematic.reset();
        self.stepper.begin(&self.state);
        self.touches.begin();
    }
    /// Stage 6 among others: substep `i` as if nothing but the ground were touched.
    pub(crate) fn open_substep(&mut self, world: &TickContext, i: u32) {
        let Stage {
            input,
            stepper,
            state,
            ..
        } = self.stage(world);
        stepper.open_substep(&input, state, i);
    }
    /// Stage 6 among others: takes the impulse of an island in velocity components.
    pub(crate) fn touch(&mut self, impulse: [f64; NV], outcome: Outcome) {
        self.stepper.touch(impulse, outcome);
    }
    /// Stage 6 among others: one contact of the substep, with its impulse on this figure.
    pub(crate) fn record(&mut self, what: &Contacting, h: f64, dt: f64) {
        self.stepper
            .push(what.segment, what.position, what.impulse * (1.0 / h));
        self.touches.add(&self.stepper.terms, what, dt);
    }
    /// Stage 6 among others: closes substep `i` and moves.
    pub(crate) fn close_substep(&mut self, world: &TickContext, i: u32) {
        let Stage {
            input,
            stepper,
            state,
            ..
        } = self.stage(world);
        stepper.close_substep(&input, state, i);
    }
    /// Stage 6 among others: ends the tick.
    pub(crate) fn end_substeps(&mut self, world: &TickContext) {
        let Stage { input, stepper, .. } = self.stage(world);
        stepper.end(&input);
    }

    /// Stages 7 and 8: contain trouble, report.
    pub(crate) fn finish(&mut self, world: &TickContext) {
        self.touches.end(&mut self.watcher);
        let (angles, rates) = (self.pending.angles, self.pending.rates);
        self.tire(&angles, &rates, world.dt);
        let frozen = self.contain();
        self.fill_report(world, frozen);
        self.judge_fall();
        self.watcher
            .observe(&self.report, &self.support, self.fallen);
    }

    /// Desired motion of the tick: as the drive has it, or as its steps come out.
    fn desired(&mut self, time: f64, dt: f64) -> TargetPair {
        if let Drive::Live(live) = &mut self.drive {
            live.motion.advance(live.stream_time(time + dt));
            self.gait.follow_stream(&live.motion);
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
        self.gait
            .targets(time, dt, &self.terms, clip_time, |now, next| {
                drive.pair(now, next)
            })
    }

    /// True if steps follow events: the modern controller, and a figure that is up. Full assist pins the pelvis to its path, so the motion
    /// keeps its clock and its place there.
    fn steps(&self) -> bool {
        !self.fallen
            && !self.balance.lost()
            && self.setup.controller == ControllerKind::Modern
            && self.setup.options.assist < 1.0
    }

    /// Runs the controller in charge and turns its command into work for the motors.
    fn control(
        &mut self,
        world: &TickContext,
        tasks: &TaskPoints,
        balance: Option<Balance>,
        (lower, upper): (&[f64; DOF_COUNT], &[f64; DOF_COUNT]),
    ) -> MotorCommand {
        let (mut hands, mut free) = (tasks.hands, 0);
        for hand in self.constraints.free_hands() {
            hands[free] = hand;
            free += 1;
        }
        let input = ControlInput {
            terms: &self.terms,
            body: &self.setup.body,
            support: &self.support,
            target: &self.target,
            com: &tasks.com,
            effectors: &hands[..free],
            goals: self.constraints.goals(),
            feet: &tasks.feet,
            balance,
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
                let horizon = if self.fallen {
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
                    if self.fallen {
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

    /// Is balance lost? Full assist holds the pelvis, so there is none to lose; and prescribed accelerations fall by themselves.
    fn watch_balance(&mut self, world: &TickContext) {
        let s = &self.setup;
        let falls = s.stepper == StepperKind::Kinematic && self.handed_over.is_none();
        let motors = s.controller == ControllerKind::Motors;
        if falls || motors || !s.params.hand_over || s.options.assist > 0.0 {
            self.balance.reset();
            return;
        }
        let modern = s.controller == ControllerKind::Modern;
        let reach = match s.params.protective_steps {
            true if modern => Reach::Step,
            false if modern => Reach::Body,
            _ => Reach::Paper,
        };
        let height = self.terms.com.z / self.standing_com_height;
        let before = self.balance.lost();
        let off = self.gait.off_plan().filter(|_| self.steps());
        self.balance.observe(
            &s.body,
            &self.terms,
            &self.support,
            (world.gravity, world.dt),
            (reach, height),
            off,
        );
        if before && !self.balance.lost() {
            self.start_afresh();
        }
    }

    /// Controllers and steps forget what they knew of a figure that has fallen or stumbled since.
    fn start_afresh(&mut self) {
        self.modern.reset();
        self.paper.reset();
        self.gait.reset();
    }

    /// The chosen controller, or motors alone once balance is lost or the figure lies on the ground.
    fn active_controller(&self) -> ControllerKind {
        if self.fallen || self.balance.lost() {
            ControllerKind::Motors
        } else {
            self.setup.controller
        }
    }

    /// True if accelerations are to be applied as they are. A load held in two hands and the assist act by forces, which need torques.
    fn prescribes(&self) -> bool {
        self.setup.stepper == StepperKind::Kinematic
            && self.setup.options.assist == 0.0
            && self.disturbances.bar().is_none()
            && self.active_controller() != ControllerKind::Motors
            && self.handed_over.is_none()
    }

    /// Prescribed accelerations on a tilting support create energy once joints saturate, and they know nothing of parts other than feet:
    /// there torques take over (ALGORITHM §6), until the figure has stood calmly for a while. The state is the same for both.
    fn judge_hand_over(&mut self, dt: f64) {
        let r = &self.report;
        let feet = [L_FOOT, L_TOES, R_FOOT, R_TOES];
        if self.prescribed && self.setup.params.hand_over {
            let saturated = (r.saturated | r.saturated_secondary) != 0;
            let arrives = other_part_arrives(&self.setup.body, &self.terms, dt);
            let fast = self.state.velocity[6..].iter().any(|v| v.abs() > SPEED_CAP);
            if arrives || fast || (self.tips && saturated) || r.flags.has(Flags::OVERLOAD) {
                self.prescribed = false;
                self.handed_over = Some(0.0);
            }
        } else if let Some(calm) = self.handed_over {
            let points = self.support.points();
            let flat = points.len() >= 3 && points.iter().all(|p| feet.contains(&p.segment));
            let upright = !self.fallen && !self.balance.lost();
            let alone = self.touches.list().next().is_none();
            let stands = flat && upright && alone && !self.tips && r.saturated == 0;
            self.handed_over = match calm + dt {
                t if !stands && t > 0.0 => Some(0.0),
                t if t > CALM_TIME => None,
                t => Some(t),
            };
        }
    }

    /// Factors on the muscles: a fallen figure relaxes, a tired one has less.
    fn available_strength(&self) -> MuscleScale {
        let fallen = if self.fallen { FALLEN_STRENGTH } else { 1.0 };
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
    fn tire(&mut self, angles: &[f64; DOF_COUNT], rates: &[f64; DOF_COUNT], dt: f64) {
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

    /// Freezes a figure whose state is not finite at its last good state; the world goes on.
    fn contain(&mut self) -> bool {
        let good = self.state.is_finite();
        if good {
            self.last_good = self.state;
        } else {
            self.state = self.last_good;
            self.state.velocity = [0.0; NV];
            self.frozen = true;
            self.watcher.push(FigureEvent::Quarantined);
        }
        !good
    }

    fn fill_report(&mut self, world: &TickContext, frozen: bool) {
        let Pending {
            before,
            tasks,
            lower,
            upper,
            ..
        } = &self.pending;
        let (f, penetration) = if self.prescribed {
            (&self.kinematic.forces, self.kinematic.penetration())
        } else {
            (&self.stepper.forces, self.stepper.penetration())
        };
        let r = &mut self.report;
        r.touches.clear();
        r.touches.extend(self.touches.list());
        r.torque = f.torque;
        r.ligament_torque = f.ligament_torque;
        r.assist = f.assist;
        r.torque_lower = *lower;
        r.torque_upper = *upper;
        r.over_limit = f.over_limit;
        for i in 0..NV {
            r.acceleration[i] = (self.state.velocity[i] - before.velocity[i]) / world.dt;
        }
        r.contacts.clone_from(&f.contact);
        r.main_support = self.support.main();
        r.support_ratio = *self.support.ratio();
        r.support_polygon.clear();
        r.support_polygon
            .extend_from_slice(self.support.polygon().corners());
        // Zero-moment point of the forces that acted, (3): z = (−N_y, N_x)/F_z about the world origin.
        let (mut force, mut moment) = (0.0, (0.0, 0.0));
        for c in &r.contacts {
            let n = c.position.cross(c.force);
            force += c.force.z;
            moment = (moment.0 + n.x, moment.1 + n.y);
        }
        r.zmp = (force > 1e-3 * self.terms.mass).then(|| Vec3 {
            x: -moment.1 / force,
            y: moment.0 / force,
            z: 0.0,
        });
        r.margin = r.zmp.and_then(|z| self.support.margin(z));
        r.com = self.terms.com;
        r.com_velocity = self.terms.com_velocity;
        r.com_desired = tasks.com.now;
        r.constraint_error.clear();
        let missing = self.constraints.errors(&self.terms);
        r.constraint_error.extend_from_slice(missing);
        r.joint_error = before.posture.joint_difference(&self.target.now.posture);
        r.penetration = penetration;
        r.step_iterations = f.iterations;
        r.flags.set(f.flags);
        if r.contacts.is_empty() && r.touches.is_empty() {
            r.flags.set(Flags::FLIGHT);
        }
        if self.fallen {
            r.flags.set(Flags::FALLEN);
        }
        if self.balance.lost() {
            r.flags.set(Flags::BALANCE_LOST);
        }
        if self.handed_over.is_some() {
            r.flags.set(Flags::HANDED_OVER);
        }
        if frozen {
            r.flags.set(Flags::QUARANTINED);
        }
        r.audit.clone_from(&f.audit);
        let a = &r.acceleration;
        self.com_acceleration = self.terms.com_bias
            + Vec3 {
                x: (0..NV).map(|i| self.terms.jc[0][i] * a[i]).sum(),
                y: (0..NV).map(|i| self.terms.jc[1][i] * a[i]).sum(),
                z: (0..NV).map(|i| self.terms.jc[2][i] * a[i]).sum(),
            };
        self.reported = true;
    }

    /// Falls and rises (ALGORITHM §12).
    fn judge_fall(&mut self) {
        let height = self.terms.com.z / self.standing_com_height;
        let feet = [L_FOOT, L_TOES, R_FOOT, R_TOES];
        let on_other = self
            .report
            .contacts
            .iter()
            .any(|c| !feet.contains(&c.segment))
            || self.touches.list().any(|t| !feet.contains(&t.segment));
        if !self.fallen && height < FALLEN_HEIGHT && on_other {
            self.fallen = true;
        } else if self.fallen && height > RISEN_HEIGHT {
            self.fallen = false;
            self.start_afresh();
        }
    }
}

impl Figure {
    /// Name, for people.
    pub fn name(&self) -> &str {
        &self.setup.name
    }
    /// The body.
    pub fn body(&self) -> &Arc<Body> {
        &self.setup.body
    }
    /// What it was made of, with later changes.
    pub fn setup(&self) -> &FigureSetup {
        &self.setup
    }
    /// Strength curves of the body.
    pub fn strength(&self) -> &Strength {
        &self.strength
    }
    /// Factors on its muscles in the last tick: scale, effort, fatigue, and relaxation of a fallen figure.
    pub fn muscles(&self) -> &MuscleScale {
        &self.muscles
    }
    /// Fatigue, if it is on.
    pub fn fatigue(&self) -> Option<&Fatigue> {
        self.fatigue.as_deref()
    }
    /// State after the last tick.
    pub fn state(&self) -> &State {
        &self.state
    }
    /// Mass properties with the present loads.
    pub fn links(&self) -> &Links {
        &self.links
    }
    /// Report of the last tick; `None` before the first.
    pub fn report(&self) -> Option<&TickReport> {
        self.reported.then_some(&self.report)
    }
    /// Desired motion of the last tick.
    pub fn target(&self) -> &TargetPair {
        &self.target
    }
    /// The shapes it collides with.
    pub fn shape(&self) -> &BodyShape {
        &self.shape
    }
    /// True while it is frozen after trouble.
    pub(crate) fn is_frozen(&self) -> bool {
        self.frozen
    }
    /// Where its segments are in the present substep.
    pub(crate) fn substep_terms(&self) -> &Terms {
        &self.stepper.terms
    }
    /// Where its segments were at the start of the tick.
    pub(crate) fn tick_terms(&self) -> &Terms {
        &self.terms
    }
    /// Events of the last tick.
    pub fn events(&self) -> &[FigureEvent] {
        self.watcher.events()
    }
    /// True once it lies on the ground, until it has risen again.
    pub fn is_fallen(&self) -> bool {
        self.fallen
    }
    /// Where the desired motion comes from.
    pub fn drive(&self) -> &Drive {
        &self.drive
    }
    /// Replaces the source of the desired motion from the next tick on, whatever the figure does. What waits is forgotten.
    pub fn set_drive(&mut self, drive: Drive) {
        self.gait.follow(match &drive {
            Drive::Clip(play) => {
                let plan = StepPlan::new(&self.setup.body, &play.clip, play.looped);
                Some((plan, play.speed, play.origin))
            }
            Drive::Live(_) => Some((StepPlan::live(), 1.0, PlanarTransform::default())),
            _ => None,
        });
        self.drive = drive;
        self.queued = None;
        self.ending = false;
    }
    /// The stream that drives it with a window, if one does: to feed it.
    pub fn stream_mut(&mut self) -> Option<&mut LivePlayback> {
        match &mut self.drive {
            Drive::Live(live) => Some(live),
            _ => None,
        }
    }
    /// Its steps.
    pub fn gait(&self) -> &Gait {
        &self.gait
    }
    /// Scheduled perturbations.
    pub fn perturbations(&self) -> impl Iterator<Item = &Perturbation> {
        self.disturbances.scheduled()
    }
    /// Lets go of all loads and stops all pushes at the next tick.
    pub fn clear_perturbations(&mut self) {
        self.disturbances.clear();
    }
    /// Schedules a checked perturbation; false if there is no room.
    pub(crate) fn schedule(&mut self, what: Perturbation) -> bool {
        self.disturbances.add(what)
    }
    /// Puts the figure into a state and forgets its past; loads stay.
    pub fn reset(&mut self, state: State) {
        self.state = state;
        self.is_new = true;
        self.last_good = state;
        self.fallen = false;
        self.frozen = false;
        self.gait.reset();
        self.com_acceleration = Vec3::zero();
        self.support.reset();
        self.touches = Touches::default();
        self.paper.reset();
        self.modern.reset();
        self.kinematic.reset();
        self.handed_over = None;
        self.balance.reset();
        self.fatigue = rested(&self.setup.options);
        self.report.remaining = [[1.0; 2]; DOF_COUNT];
    }
    /// Changes the scale of its strength. Another percentile makes new curves: about 20 µs, allocates.
    pub fn set_strength(&mut self, scale: StrengthScale) {
        if scale.percentile != self.setup.strength.percentile {
            self.strength = Arc::new(Strength::at_percentile(&self.setup.body, scale.percentile));
        }
        self.setup.strength = scale;
    }
    /// Changes fatigue and assist. Fatigue that goes on keeps its state; turned off it is forgotten.
    pub fn set_options(&mut self, options: FigureOptions) {
        match (&mut self.fatigue, options.fatigue_time_scale > 0.0) {
            (Some(fatigue), true) => fatigue.time_scale = options.fatigue_time_scale,
            (fatigue, _) => {
                *fatigue = rested(&options);
                self.report.remaining = [[1.0; 2]; DOF_COUNT];
            }
        }
        self.setup.options = options;
    }
    /// Constraints from outside, in the order in which they were given; those that have ended are gone.
    pub fn constraints(&self) -> &[Constraint] {
        self.constraints.given()
    }
    /// Replaces all checked constraints at `time`, s.
    pub(crate) fn set_constraints(&mut self, constraints: &[Constraint], time: f64) {
        self.constraints.replace(constraints, time);
    }
    /// Takes all constraints off at once, without fading.
    pub fn clear_constraints(&mut self) {
        self.constraints.forget();
    }
    /// Changes controller and gains.
    pub fn set_controller(&mut self, controller: ControllerKind, params: ControlParams) {
        if controller != self.setup.controller {
            self.paper.reset();
            self.modern.reset();
        }
        self.setup.controller = controller;
        self.setup.params = params;
    }
    /// Hash of the state's bits (64-bit FNV-1a over little-endian words).
    pub fn state_hash(&self) -> u64 {
        let mut h = crate::sim::math::hash::Fnv::default();
        let p = &self.state.posture;
        h.f64s(&p.root_position.to_array());
        h.f64s(&p.root_rotation.to_xyzw());
        for q in &p.ball {
            h.f64s(&q.to_xyzw());
        }
        h.f64s(&p.hinge);
        h.f64s(&self.state.velocity);
        if let Some(fatigue) = &self.fatigue {
            fatigue.add_to(&mut h);
        }
        h.finish()
    }
}

impl Pending {
    fn new(state: &State) -> Self {
        let z = [0.0; DOF_COUNT];
        Self {
            command: MotorCommand {
                acceleration: z,
                torque: z,
                saturation_speed: 1.0,
            },
            lower: z,
            upper: z,
            tasks: TaskPoints::none(),
            before: *state,
            angles: z,
            rates: z,
            assist: None,
        }
    }
}

fn rested(options: &FigureOptions) -> Option<Box<Fatigue>> {
    let scale = options.fatigue_time_scale;
    (scale > 0.0).then(|| Box::new(Fatigue::rested(scale)))
}

/// Height of the centre of mass over the soles in the zero pose, m.
fn standing_com_height(body: &Body) -> f64 {
    let mut kin = Kinematics::default();
    let links = Links::new(body);
    kin.set_posture(&links, &Posture::default());
    center_of_mass(&links, &kin).0.z + body.standing_root_height()
}

fn empty_report(state: &State) -> TickReport {
    let z = [0.0; DOF_COUNT];
    TickReport {
        torque: z,
        ligament_torque: z,
        assist: [0.0; 6],
        remaining: [[1.0; 2]; DOF_COUNT],
        torque_lower: z,
        torque_upper: z,
        over_limit: 0.0,
        acceleration: [0.0; NV],
        saturated: 0,
        saturated_secondary: 0,
        contacts: Vec::with_capacity(MAX_CONTACTS),
        touches: Vec::with_capacity(MAX_TOUCHES),
        main_support: None,
        support_ratio: [0.0; SEGMENT_COUNT],
        support_polygon: Vec::with_capacity(MAX_CONTACTS),
        zmp: None,
        margin: None,
        com: Vec3::zero(),
        com_velocity: Vec3::zero(),
        com_desired: Vec3::zero(),
        constraint_error: Vec::with_capacity(MAX_CONSTRAINTS),
        joint_error: z,
        penetration: 0.0,
        control_iterations: 0,
        step_iterations: 0,
        flags: Flags::default(),
        audit: Audit {
            state: *state,
            acceleration: [0.0; NV],
            torque: z,
            ligament_torque: z,
            contacts: Vec::with_capacity(MAX_CONTACTS),
            applied: Vec::with_capacity(super::loads::MAX_APPLIED),
            assist: [0.0; 6],
        },
    }
}

#[cfg(test)]
mod tests;
