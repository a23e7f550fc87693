//! The parts of a figure. [`PhysicalState`], [`MotionState`](crate::figure::motion::activity::MotionState),
//! [`DesiredMotion`], [`Surroundings`] and [`HandOver`](crate::paper::hand_over::HandOver) are its state: together with
//! the memory of controllers and steppers ([`Loan`](crate::figure::state::workspace::Loan)), they pass from tick to
//! tick and decide what comes next. [`Scratch`] holds the results that stages pass on; after the tick, only its
//! dynamics and its state at the start of the tick are read.

use crate::body::angles::{Swings, anatomical_angles, swings};
use crate::body::topology::DOF_COUNT;
use crate::body::{Body, Links, Posture, State};
use crate::collide::shape::BodyShape;
use crate::contact::Tissue;
use crate::control::PointTarget;
use crate::dynamics::{Kinematics, Placement, center_of_mass};
use crate::figure::balance::live_help::LiveHelp;
use crate::figure::balance::loss::BalanceWatch;
use crate::figure::constraints::Constraints;
use crate::figure::events::Watcher;
use crate::figure::loads::compensation::LoadCompensation;
use crate::figure::loads::disturbances::Disturbances;
use crate::figure::loads::second_hand::HelpingHand;
use crate::figure::motion::get_up::GetUp;
use crate::figure::motion::plan_task::LatePlans;
use crate::figure::motion::tasks::TaskPoints;
use crate::figure::touches::Touches;
use crate::get_up::GetUpSolver;
use crate::math::Vec3;
use crate::motion::builtin::at_ease;
use crate::motion::{Target, TargetPair};
use crate::report::{MAX_CONTACTS, TickReport};
use crate::setup::{FigureOptions, FigureSetup, StrengthScale};
use crate::stepper::command::{MotorCommand, TorqueRange};
use crate::stepper::pelvis_wrench::Assist;
use crate::strength::fatigue::Fatigue;
use crate::strength::{MuscleScale, Strength};
use crate::support::Support;
use crate::track::StepTracker;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Values that follow from the body alone.
#[derive(Debug)]
pub(in crate::figure) struct BodyConstants {
    /// Strength curves.
    pub strength: Arc<Strength>,
    /// The shapes it collides with.
    pub shape: Arc<BodyShape>,
    /// Height of the centre of mass over the soles in the zero pose, m.
    pub standing_com_height: f64,
}

impl BodyConstants {
    pub fn new(body: &Body, scale: &StrengthScale) -> Self {
        let mut kin = Kinematics::default();
        let links = Links::new(body);
        kin.set_posture(&links, &Posture::default());
        let height = center_of_mass(&links, &kin).0.z + body.standing_root_height();
        Self {
            strength: Arc::new(Strength::at_percentile(body, scale.percentile)),
            shape: Arc::new(BodyShape::new(body)),
            standing_com_height: height,
        }
    }
}

/// Body and muscles: their state, and the torque that they can give.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::figure) struct PhysicalState {
    /// Positions and velocities.
    pub state: State,
    /// The last one that was finite.
    pub last_good: State,
    /// Whether the state was not finite: the figure stays at its last good one.
    pub frozen: bool,
    /// Mass properties with the present loads.
    pub links: Links,
    /// Factors on the muscles in the last tick.
    pub muscles: MuscleScale,
    /// Fatigue, if it is on.
    pub fatigue: Option<Box<Fatigue>>,
    /// Acceleration of the centre of mass in the last tick, world axes, m/s².
    pub com_acceleration: Vec3,
}

impl PhysicalState {
    pub fn new(setup: &FigureSetup) -> Self {
        Self {
            state: setup.state,
            last_good: setup.state,
            frozen: false,
            links: Links::new(&setup.body),
            muscles: setup.strength.muscles(1.0),
            fatigue: rested(&setup.options),
            com_acceleration: Vec3::zero(),
        }
    }
}

/// Fatigue of a rested figure, if it is on.
pub(in crate::figure) fn rested(options: &FigureOptions) -> Option<Box<Fatigue>> {
    let scale = options.fatigue_time_scale;
    (scale > 0.0).then(|| Box::new(Fatigue::rested(scale)))
}

/// The desired motion of a tick, and everything that changes it from its source.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::figure) struct DesiredMotion {
    /// Desired motion of the tick.
    pub target: TargetPair,
    /// Desired centre of mass, world, m and m/s.
    pub com: PointTarget,
    /// Steps: contact by events, and footholds.
    pub tracker: Box<StepTracker>,
    /// The effect of loads.
    pub load_compensation: Box<LoadCompensation>,
    /// The other hand's part in a load.
    pub second_hand: HelpingHand,
    /// Constraints that clients set.
    pub constraints: Constraints,
    /// Getting up from the floor.
    pub get_up: Box<GetUp>,
    /// Whether the motion worked on hands and knees in the last tick.
    pub on_limbs: bool,
}

impl DesiredMotion {
    pub fn new(setup: &FigureSetup) -> Self {
        let still = Target::still(setup.state.posture);
        Self {
            target: TargetPair {
                now: still.clone(),
                next: still,
            },
            com: TaskPoints::none().com,
            tracker: Box::new(StepTracker::new(&setup.body)),
            load_compensation: Box::new(LoadCompensation::new(&setup.body)),
            second_hand: HelpingHand::default(),
            constraints: Constraints::default(),
            get_up: Box::new(GetUp::new(&setup.body)),
            on_limbs: false,
        }
    }
}

/// External effects on the figure, and its support.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(in crate::figure) struct Surroundings {
    /// Loads and pushes.
    pub disturbances: Disturbances,
    /// Its support.
    pub support: Support,
    /// Its contacts besides the ground.
    pub touches: Touches,
    /// Watches whether its balance is lost.
    pub balance: BalanceWatch,
    /// Decides whether its motion is being lost, and helps if so.
    pub help: LiveHelp,
}

/// Buffers of a tick, and the results that its stages pass to each other.
#[derive(Debug)]
pub(in crate::figure) struct Scratch {
    /// Poses of the segments at the start of the tick.
    pub placement: Placement,
    /// Velocity of the centre of mass then, m/s.
    pub com_velocity: Vec3,
    /// Inverse kinematics of getting up.
    pub get_up: Box<GetUpSolver>,
    /// Heights of the contact points while getting up, m.
    pub floor: Box<[f64; MAX_CONTACTS]>,
    /// Results of earlier stages that later ones need.
    pub results: StageResults,
}

impl Scratch {
    pub fn new(setup: &FigureSetup) -> Self {
        Self {
            placement: Placement::default(),
            com_velocity: Vec3::zero(),
            get_up: Box::new(GetUpSolver::new(&setup.body, &at_ease(&setup.body))),
            floor: Box::new([0.0; MAX_CONTACTS]),
            results: StageResults::new(&setup.state),
        }
    }
}

/// The results that the stages of a tick pass on.
#[derive(Debug)]
pub(in crate::figure) struct StageResults {
    /// Swings, anatomical angles, rad, and rates of the joints, rad/s, at the start of the tick.
    pub swings: Swings,
    pub angles: [f64; DOF_COUNT],
    pub rates: [f64; DOF_COUNT],
    /// Available torque at these.
    pub available: TorqueRange,
    /// Stretched tissue; `None` if none acts.
    pub tissue: Option<Tissue>,
    /// The command to the motors.
    pub command: MotorCommand,
    /// The controller found no command: numbers of the desired motion or of the state are out of range.
    pub undecided: bool,
    /// Assist towards the desired pose of the pelvis, if it is on.
    pub assist: Option<Assist>,
    /// The wrench on the pelvis that the controller planned, N·m and N, if it was allowed one.
    pub planned_help: Option<[Vec3; 2]>,
    /// State at the start of the tick.
    pub before: State,
}

impl StageResults {
    fn new(state: &State) -> Self {
        let z = [0.0; DOF_COUNT];
        Self {
            swings: swings(&state.posture),
            angles: anatomical_angles(&state.posture),
            rates: z,
            available: TorqueRange { lower: z, upper: z },
            tissue: None,
            command: MotorCommand {
                acceleration: z,
                torque: z,
                saturation_speed: 1.0,
            },
            undecided: false,
            assist: None,
            planned_help: None,
            before: *state,
        }
    }
}

/// The results of the last tick.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::figure) struct TickOutcome {
    pub report: TickReport,
    /// Whether there was a tick.
    pub reported: bool,
    /// Events.
    pub watcher: Watcher,
    /// Plans that it needed and that were missing.
    pub late: LatePlans,
    /// Plans that the next tick has to do without.
    pub told_late: LatePlans,
}

/// The world's notes on the figure when it looks for neighbours.
#[derive(Debug)]
pub(crate) struct Neighbours {
    /// The cluster of figures and obstacles that it is near in this tick.
    pub cluster: usize,
    /// Whether it has moved in this tick, ahead of the figures that are moved together.
    pub moved_alone: bool,
    /// Whether it was put in its place since the last tick.
    pub is_new: bool,
}
