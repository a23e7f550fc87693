//! One tick of one figure (ALGORITHM §10). The world calls `Figure::prepare` (stages 1–5), `simulate` (stage 6; `among`
//! for figures that are near something) and `finish` (stages 7 and 8); their bodies are the list of stages.

mod access;
mod actuation;
mod cluster;
mod fall_detection;
mod motion_switch;
mod playback;
mod reporting;

use motion_switch::MotionSwitch;
use reporting::empty_report;

use super::assist::Assist;
use super::balance_loss::BalanceWatch;
use super::constraints::Constraints;
use super::drive::{Drive, Queued};
use super::events::Watcher;
use super::get_up::GetUp;
use super::kinematic_step::{Decision, KinematicStepper};
use super::load_compensation::LoadCompensation;
use super::loads::Disturbances;
use super::report::{Flags, TickReport};
use super::setup::{ControllerKind, FigureOptions, FigureSetup, Share};
use super::tasks::{TaskPoints, TaskWorkspace};
use super::torque_step::{MotorCommand, StepInput, Stepper, TorqueStepper};
use super::touches::Touches;
use crate::sim::body::angles::anatomical_angles;
use crate::sim::body::topology::DOF_COUNT;
use crate::sim::body::{Body, Links, Posture, State};
use crate::sim::collide::shape::BodyShape;
use crate::sim::contact::Tissue;
use crate::sim::control::{CentroidalTarget, Command, Modern, Paper};
use crate::sim::dynamics::{Kinematics, Terms, center_of_mass};
use crate::sim::math::Vec3;
use crate::sim::motion::builtin::at_ease;
use crate::sim::motion::{Target, TargetPair};
use crate::sim::strength::fatigue::Fatigue;
use crate::sim::strength::{MuscleScale, Strength};
use crate::sim::support::Support;
use crate::sim::track::{StepTracker, TaskTargets};
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

impl TickContext {
    /// When it begins, s.
    pub fn time(&self) -> f64 {
        self.tick as f64 * self.dt
    }
}

/// A part rests on something that carries this share of the weight.
const RESTS: f64 = 0.02;

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
    /// The way out of its motion, while it is worked out.
    leaving: Option<Box<MotionSwitch>>,
    /// What it does as soon as it stands, or goes over to.
    queued: Option<Box<Queued>>,
    tracker: Box<StepTracker>,
    target: TargetPair,
    carrying: Box<LoadCompensation>,
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
    rising: GetUp,
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
    /// Stretched tissue, where it acts.
    tissue: Option<Tissue>,
    assist: Option<Assist>,
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
            leaving: None,
            queued: None,
            tracker: Box::new(StepTracker::new(&setup.body)),
            target: TargetPair {
                now: still.clone(),
                next: still,
            },
            carrying: Box::new(LoadCompensation::new(&setup.body)),
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
            rising: GetUp::new(&setup.body, &at_ease(&setup.body)),
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
        self.watcher.begin();
        self.take_up(world); // 1. commands
        if self.frozen {
            self.report.flags = Flags::QUARANTINED;
            return false;
        }
        self.look(world); // 2. dynamics of the state, desired motion
        self.stand(world); // 3. supports, and whether they still balance it
        self.flex(world); // 4. strength
        self.decide(world); // 5. accelerations and torques within strength
        true
    }

    /// Stage 1: loads and pushes that are due.
    fn take_up(&mut self, world: &TickContext) {
        self.disturbances.apply(
            world.time(),
            world.dt,
            &self.setup.body,
            &mut self.links,
            &mut self.state,
            &mut self.watcher,
        );
    }

    /// Stage 2: everything of the present state, and what is asked of it: of a fallen figure that it gets up, if its
    /// motion does.
    fn look(&mut self, world: &TickContext) {
        let applied = self.disturbances.applied();
        self.terms
            .compute(&self.links, &self.state, applied, world.gravity);
        self.leave_broken_stream(world.time());
        self.begin_to_leave(world);
        self.begin_queued(world.time());
        self.get_up(world.time());
        self.target = self.desired(world.time(), world.dt);
        let steps = self.steps() && self.tracker.is_walking();
        self.carrying.lean(
            &self.setup.body,
            &self.links,
            &mut self.target,
            steps,
            world.dt,
        );
        // The paper's controller as published takes them where they are.
        if self.setup.controller != ControllerKind::Paper {
            self.target
                .set_velocities_back(0.5 / f64::from(world.substeps));
        }
    }

    /// Stage 3: what it holds, what it stands and rests on, and whether it keeps its balance.
    fn stand(&mut self, world: &TickContext) {
        let bar = self.stepper.forces.bar;
        self.disturbances
            .check_grip(world.time(), world.dt, &self.terms, world.gravity, bar);
        let body = &self.setup.body;
        self.support
            .update(&self.terms, body, self.com_acceleration, world.gravity);
        let least = self.least_rest(world);
        self.support.rest_on(self.touches.rests(&self.terms, least));
        self.watch_balance(world);
    }

    /// Force from which a part counts as resting on something, N.
    fn least_rest(&self, world: &TickContext) -> f64 {
        RESTS * self.terms.mass * world.gravity
    }

    /// Stage 4: what the muscles can give at these angles and rates, and what stretched tissue gives. The paper's body
    /// has none.
    fn flex(&mut self, world: &TickContext) {
        let tissue = self.setup.controller != ControllerKind::Paper;
        let p = &mut self.pending;
        let h = world.dt / f64::from(world.substeps);
        p.tissue = tissue.then(|| Tissue::new(&self.strength, &self.state, world.substeps, h));
        p.angles = anatomical_angles(&self.state.posture);
        p.rates = std::array::from_fn(|j| self.state.velocity[6 + j]);
        self.muscles = self.available_strength();
        let p = &mut self.pending;
        self.strength.range(
            &p.angles,
            &p.rates,
            &self.muscles,
            &mut p.lower,
            &mut p.upper,
        );
    }

    /// Stage 5: constraints and steps shift what is asked for, then the controller decides. What the figure leans on,
    /// and what its stretched tissue gives, is known to it.
    fn decide(&mut self, world: &TickContext) {
        let bias = self.terms.h;
        let least = self.least_rest(world);
        let modern = self.active_controller() == ControllerKind::Modern;
        self.touches.lean(&mut self.terms, modern.then_some(least));
        let tissue = self.pending.tissue.as_ref();
        let inertia = tissue.map(|t| t.add_to(&mut self.terms));
        let body = Arc::clone(&self.setup.body);
        let mut tasks = self.tasks.points(&body, &self.links, &self.target);
        self.constraints.begin(
            world.time(),
            &body,
            &self.terms,
            &self.support,
            &mut tasks.com,
            &tasks.hands,
            |s, p| self.tasks.desired_point(&self.target, s, p),
        );
        self.support.plan_rests(&self.terms, |s, p| {
            self.tasks.desired_point(&self.target, s, p)
        });
        if self.rising.is_rising() {
            self.rising
                .touch(&body, &self.terms, &self.tasks, &self.target, &tasks.com);
        }
        let (mut acceleration, mut momentum) = (None, None);
        if self.steps() {
            let mut targets = TaskTargets {
                com: &mut tasks.com,
                momentum: tasks.spin[0],
                momentum_rate: (tasks.spin[1] - tasks.spin[0]) * (1.0 / world.dt),
                feet: &mut tasks.feet,
                unplanned_steps: self.setup.params.protective_steps,
            };
            acceleration = self.tracker.update_tasks(
                &self.terms,
                &self.support,
                world.gravity,
                world.dt,
                &mut targets,
            );
            momentum = self.lift_off_momentum();
        }
        self.prescribed = self.prescribes();
        let (lower, upper) = (self.pending.lower, self.pending.upper);
        let centroidal = CentroidalTarget {
            com: &tasks.com,
            acceleration,
            momentum,
        };
        self.pending.command = self.control(world, &tasks, centroidal, (&lower, &upper));
        self.judge_hand_over(world.dt);
        self.terms.h = bias;
        if let Some(inertia) = inertia {
            Tissue::restore(&inertia, &mut self.terms);
        }
        self.pending.tasks = tasks;
        self.pending.before = self.state;
        self.pending.assist = Assist::new(&body, self.setup.options.assist);
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
            tissue: pending.tissue.as_ref(),
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
            tissue: None,
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

#[cfg(test)]
mod tests;
