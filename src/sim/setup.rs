//! What a figure is made of and how it is controlled: set at creation, changeable between ticks.

use crate::body::topology::{L_HAND, R_HAND};
use crate::body::{Body, SegmentId, State};
use crate::math::Vec3;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

pub use crate::strength::StrengthScale;

/// Everything a figure is made of.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct FigureSetup {
    /// Name, for people.
    pub name: String,
    /// The body.
    #[serde(with = "crate::saved::definition")]
    pub body: Arc<Body>,
    /// Scale of its strength.
    pub strength: StrengthScale,
    /// What computes accelerations and torques.
    pub controller: ControllerKind,
    /// What moves the body.
    pub stepper: StepperKind,
    /// Choices and gains.
    pub params: ControlParams,
    /// Fatigue and assist.
    pub options: FigureOptions,
    /// Where it starts.
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

/// What computes accelerations and torques.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ControllerKind {
    /// The paper's controller, equations (4)–(17), with safeguards (docs/equations.md).
    Paper,
    /// Whole-body quadratic program solved through its dual (docs/equations.md).
    Modern,
    /// Strength-limited motors alone (docs/equations.md); what is left after balance is lost.
    Motors,
}

impl StepperKind {
    /// True if accelerations are applied as they are.
    pub fn prescribes(self) -> bool {
        self != Self::Torque
    }
}

/// What moves the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum StepperKind {
    /// Torques drive full rigid-body dynamics with contact (docs/equations.md).
    Torque,
    /// The controller's accelerations are applied as they are; the support holds, tips about an edge or a vertex, or
    /// flies. For the paper's controller. Motors alone need torques: with them this is `Torque`. Near something that
    /// can be met torques take over.
    Kinematic,
    /// The same, but collisions are those of §3 of the paper: an impact changes velocities, then angles are corrected
    /// until nothing overlaps, and the reaction counts in the inverse dynamics of the next tick. Between figures that
    /// are all moved so, and with things that do not move freely.
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
    /// Let members of L go to their limit instead of staying where (7)–(11) left them.
    pub to_limit: bool,
    /// Tilting support (S1).
    pub tilt: bool,
    /// Keep the demanded CoM acceleration feasible for the ZMP.
    pub zmp_feasible: bool,
    /// Control both hands as end-effectors.
    pub track_hands: bool,
    /// Control the centre of mass.
    pub track_com: bool,
    /// Hand over what cannot go on: to torques, while the kinematic stepper's prescribed accelerations cannot
    /// go on; to motors alone, while balance is lost.
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
    /// The paper to the letter, all safeguards off: dead-beat demand, W = I, (12) as printed, sharing by ratios (2), a
    /// support that tips but whose torques do not know it. Meant for [`StepperKind::Kinematic`], 30 ticks a second and
    /// a body without armature; for comparison only.
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

/// What a figure can have beyond its controller; everything is off by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FigureOptions {
    /// Seconds of muscle fatigue per simulated second, 0…1000; 0: muscles never tire.
    pub fatigue_time_scale: f64,
    /// Help towards the desired pose of the pelvis, 0…1: [`Assist`](crate::figure::assist::Assist). 0: none.
    pub assist: f64,
    /// Largest force over the weight of the help while a motion is being lost, 0…2:
    /// [`Help`](crate::figure::help::Help). 0: none. It needs the modern controller, and no `assist`.
    pub max_help: f64,
    /// The body does not pass through itself: [`self_contact`](crate::figure::self_contact). Not within a
    /// rehearsed motion. Off by default: controllers do not know of it, and catch themselves a little worse with it.
    pub self_contact: bool,
}

/// A disturbance of one figure. Times are world seconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Perturbation {
    /// A point mass held by a segment.
    Load {
        /// Carrying segment.
        segment: SegmentId,
        /// Where, segment frame, m.
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
        /// Where, segment frame, m.
        point: Vec3,
        /// World axes, N.
        force: Vec3,
        /// Begins at, s.
        from: f64,
        /// Ends at, s.
        to: f64,
    },
    /// A load with all that can matter: see [`HeldLoad`].
    Held(HeldLoad),
    /// A load in one hand that the other hand reaches for.
    Helped {
        /// The load; its `second` is `None`.
        load: HeldLoad,
        /// When it does.
        when: SecondHand,
    },
}

/// When the other hand helps to hold a load.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SecondHand {
    /// As long as one arm is too weak for the load in the desired motion, and the other is free.
    Auto,
    /// As long as it is free.
    Always,
}

/// A load that may come flying, be held in two hands, and slip.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeldLoad {
    /// Carrying segment.
    pub segment: SegmentId,
    /// Where, segment frame, m.
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
    /// What each point carries: segment, point (segment frame, m), mass (kg).
    pub fn shares(&self) -> impl Iterator<Item = (SegmentId, Vec3, f64)> + use<> {
        let each = if self.second.is_some() { 0.5 } else { 1.0 } * self.mass;
        [Some((self.segment, self.point)), self.second]
            .into_iter()
            .flatten()
            .map(move |(s, p)| (s, p, each))
    }
}

impl Perturbation {
    /// The load, if it is one.
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

    /// True if the other hand is to help with this load while that hand holds another one.
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

    /// When it ends, s.
    pub fn ends(&self) -> f64 {
        match self {
            Self::Load { to, .. } | Self::Force { to, .. } => *to,
            Self::Held(load) | Self::Helped { load, .. } => load.to,
        }
    }

    /// Lets it end at `time`, s.
    pub fn end_at(&mut self, time: f64) {
        *self.end() = time;
    }
}
