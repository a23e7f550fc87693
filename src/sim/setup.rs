//! Properties and control of a figure: set at creation, changeable between ticks.

use crate::body::topology::{L_HAND, R_HAND};
use crate::body::{Body, SegmentId, State};
use crate::math::Vec3;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

pub use crate::strength::StrengthScale;

/// Most perturbations a figure can have scheduled at once.
pub const MAX_PERTURBATIONS: usize = 64;

/// All properties of a figure at its creation.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct FigureSetup {
    /// Name, for people.
    pub name: String,
    /// The body.
    #[serde(with = "crate::saved::definition")]
    pub body: Arc<Body>,
    /// Scale of its strength.
    pub strength: StrengthScale,
    /// The method that computes accelerations and torques.
    pub controller: ControllerKind,
    /// The method that moves the body.
    pub stepper: StepperKind,
    /// Choices and gains.
    pub params: ControlParams,
    /// Fatigue and assist.
    pub options: FigureOptions,
    /// Its state at the start.
    pub state: State,
}

impl FigureSetup {
    /// A nameless figure of human strength with default gains, moved by torques, that starts in `state`.
    pub fn new(body: Arc<Body>, controller: ControllerKind, state: State) -> Self {
        Self {
            name: String::new(),
            body,
            strength: StrengthScale::default(),
            controller,
            stepper: StepperKind::Torque,
            params: ControlParams::default(),
            options: FigureOptions::default(),
            state,
        }
    }
}

/// The method that computes accelerations and torques.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ControllerKind {
    /// The paper's controller, equations (4)–(17), with safeguards (docs/equations.md).
    Paper,
    /// Whole-body quadratic program solved through its dual (docs/equations.md).
    Modern,
    /// Strength-limited motors alone (docs/equations.md); the fallback after balance is lost.
    Motors,
}

impl StepperKind {
    /// Whether accelerations are applied directly.
    pub fn prescribes(self) -> bool {
        self != Self::Torque
    }
}

/// The method that moves the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum StepperKind {
    /// Torques drive full rigid-body dynamics with contact (docs/equations.md).
    Torque,
    /// The controller's accelerations are applied directly; the support holds, tips about an edge or a vertex, or
    /// flies. For the paper's controller. Motors alone need torques, so with them this is `Torque`. Near an object that
    /// can be hit, torques take over.
    Kinematic,
    /// Like `Kinematic`, but collisions are those of §3 of the paper: an impact changes velocities, then angles are
    /// corrected until nothing overlaps, and the reaction enters the inverse dynamics of the next tick. This applies
    /// between figures that all use it, and with obstacles that do not move freely.
    Staged,
}

/// Norm in which the change of acceleration is least (10).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Metric {
    /// `W = I`, the paper's.
    Identity,
    /// `W = H`.
    Inertia,
    /// `W = H²`: torques are clipped.
    Torque,
}

/// How (12) orders centre of mass and end-effectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Priority {
    /// As printed.
    Paper,
    /// Exact task priority.
    Nested,
}

/// How the ground reaction is shared between supports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Share {
    /// Ratios (2) times the total force.
    Paper,
    /// Least weighted forces with the right total wrench (S2).
    Balanced,
}

/// Choices and gains of the tracking controllers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ControlParams {
    /// Blend of position and velocity demand in (4) per 1/30 s; used when `horizon` is `None`.
    pub alpha: f64,
    /// Time constant T of the demand, s (S3); `None` is the paper's dead-beat law.
    pub horizon: Option<f64>,
    /// Norm of (10).
    pub metric: Metric,
    /// Order of (12).
    pub priority: Priority,
    /// Sharing rule.
    pub share: Share,
    /// Move members of L to their limit instead of leaving them where (7)–(11) put them.
    pub to_limit: bool,
    /// Tilting support (S1).
    pub tilt: bool,
    /// Keep the demanded CoM acceleration feasible for the ZMP.
    pub zmp_feasible: bool,
    /// Control both hands as end-effectors.
    pub track_hands: bool,
    /// Control the centre of mass.
    pub track_com: bool,
    /// Hand over when the present mode cannot continue: to torques, while the kinematic stepper cannot prescribe
    /// accelerations; to motors alone, while balance is lost.
    pub hand_over: bool,
    /// Step when the capture point has left the feet (modern controller).
    pub protective_steps: bool,
}

impl Default for ControlParams {
    fn default() -> Self {
        Self {
            alpha: 0.2,
            horizon: Some(0.1),
            metric: Metric::Identity,
            priority: Priority::Nested,
            share: Share::Balanced,
            to_limit: false,
            tilt: true,
            zmp_feasible: true,
            track_hands: true,
            track_com: true,
            hand_over: true,
            protective_steps: true,
        }
    }
}

impl ControlParams {
    /// The paper to the letter, all safeguards off: dead-beat demand, W = I, (12) as printed, sharing by ratios (2),
    /// and a support that tips although the torques do not account for it. Meant for [`StepperKind::Kinematic`], 30
    /// ticks a second and a body without armature; for comparison only.
    pub fn paper2000() -> Self {
        Self {
            horizon: None,
            metric: Metric::Identity,
            priority: Priority::Paper,
            share: Share::Paper,
            tilt: false,
            zmp_feasible: false,
            hand_over: false,
            ..Self::default()
        }
    }
}

/// Options of a figure beyond its controller; all are off by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FigureOptions {
    /// Seconds of muscle fatigue per simulated second, 0…1000; 0: muscles never tire.
    pub fatigue_time_scale: f64,
    /// Help towards the desired pose of the pelvis, 0…1: [`Assist`](crate::stepper::pelvis_wrench::Assist). 0: none.
    pub assist: f64,
    /// Largest force over the weight of the help while a motion is being lost, 0…2:
    /// [`LiveHelp`](crate::figure::balance::live_help::LiveHelp). 0: none. It needs the modern controller, and no
    /// `assist`.
    pub max_help: f64,
    /// Keeps the body from passing through itself: [`self_contact`](crate::figure::self_contact). It does not act
    /// within a rehearsed motion. Off by default, because controllers do not account for it, and recover balance
    /// slightly worse with it.
    pub self_contact: bool,
}

/// A disturbance of one figure. Times are world seconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Perturbation {
    /// A point mass held by a segment.
    Load {
        /// Carrying segment.
        segment: SegmentId,
        /// Point of application, segment frame, m.
        point: Vec3,
        /// Mass, kg, 0…500.
        mass: f64,
        /// Picked up at, s.
        from: f64,
        /// Dropped at, s; `f64::INFINITY` = never.
        to: f64,
    },
    /// A force over time (a push of J N·s over d seconds is a force of J/d).
    Force {
        /// Pushed segment.
        segment: SegmentId,
        /// Point of application, segment frame, m.
        point: Vec3,
        /// World axes, N.
        force: Vec3,
        /// Begins at, s.
        from: f64,
        /// Ends at, s.
        to: f64,
    },
    /// A load with all its properties; see [`HeldLoad`].
    Held(HeldLoad),
    /// A load in one hand that the other hand reaches for.
    Helped {
        /// The load; its `second` is `None`.
        load: HeldLoad,
        /// When the other hand helps.
        when: SecondHand,
    },
}

/// When the other hand helps to hold a load.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SecondHand {
    /// While one arm is too weak for the load in the desired motion, and the other is free.
    Auto,
    /// While it is free.
    Always,
}

/// A load that may arrive in flight, be held in two hands, and slip.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeldLoad {
    /// Carrying segment.
    pub segment: SegmentId,
    /// Point of application, segment frame, m.
    pub point: Vec3,
    /// Mass, kg, 0…500. In two hands each carries half of it.
    pub mass: f64,
    /// Velocity of the load before it is taken, world axes, m/s. Taking it is perfectly inelastic.
    pub velocity: Vec3,
    /// Second hand (or other segment) with its point. From then on the two points keep their distance: the load is a
    /// rigid bar between them, free to turn in either.
    pub second: Option<(SegmentId, Vec3)>,
    /// Force at one hand beyond which the load is lost, N; `f64::INFINITY` = never.
    pub grip: f64,
    /// Picked up at, s.
    pub from: f64,
    /// Dropped at, s; `f64::INFINITY` = never.
    pub to: f64,
}

impl HeldLoad {
    /// The load on each point: segment, point (segment frame, m), mass (kg).
    pub fn shares(&self) -> impl Iterator<Item = (SegmentId, Vec3, f64)> + use<> {
        let each = if self.second.is_some() { 0.5 } else { 1.0 } * self.mass;
        [Some((self.segment, self.point)), self.second]
            .into_iter()
            .flatten()
            .map(move |(s, p)| (s, p, each))
    }
}

impl Perturbation {
    /// The load, if this is a load.
    pub fn load(&self) -> Option<HeldLoad> {
        match *self {
            Self::Load {
                segment,
                point,
                mass,
                from,
                to,
            } => Some(HeldLoad {
                segment,
                point,
                mass,
                velocity: Vec3::zero(),
                second: None,
                grip: f64::INFINITY,
                from,
                to,
            }),
            Self::Held(load) | Self::Helped { load, .. } => Some(load),
            Self::Force { .. } => None,
        }
    }

    /// Whether the other hand should help with this load while it holds `other`.
    pub fn wants_hand_of(&self, other: &Self) -> bool {
        let (Self::Helped { load, .. }, Some(held)) = (self, other.load()) else {
            return false;
        };
        let hand = if load.segment == L_HAND {
            R_HAND
        } else {
            L_HAND
        };
        let meet = load.from < held.to && held.from < load.to;
        meet && held.shares().any(|(segment, ..)| segment == hand)
    }

    fn end(&mut self) -> &mut f64 {
        match self {
            Self::Load { to, .. } | Self::Force { to, .. } => to,
            Self::Held(load) | Self::Helped { load, .. } => &mut load.to,
        }
    }

    /// Time at which it ends, s.
    pub fn ends(&self) -> f64 {
        match self {
            Self::Load { to, .. } | Self::Force { to, .. } => *to,
            Self::Held(load) | Self::Helped { load, .. } => load.to,
        }
    }

    /// Makes it end at `time`, s.
    pub fn end_at(&mut self, time: f64) {
        *self.end() = time;
    }
}
