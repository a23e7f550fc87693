//! Report on one tick of one figure, with enough data to check it from outside.

use crate::body::{DOF_COUNT, NV, SEGMENT_COUNT, SegmentId, State};
use crate::math::Vec3;
use crate::touch::{MAX_TOUCHES, Touch};
use serde::{Deserialize, Serialize};

/// Largest number of contact points on one segment.
pub const POINTS_PER_SEGMENT: usize = 8;
/// Largest number of contact points that one figure can have at once.
pub const MAX_CONTACTS: usize = POINTS_PER_SEGMENT * SEGMENT_COUNT;

/// One touching point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContactPoint {
    /// Segment that touches.
    pub segment: SegmentId,
    /// Index of the point in [`Segment::contact_points`](crate::body::Segment::contact_points).
    pub vertex: usize,
    /// World position at the start of the tick (mean values) or substep (audit), m.
    pub position: Vec3,
    /// Force on the figure, world axes, N.
    pub force: Vec3,
}

/// The safeguards that acted and the state of the figure, as a set of flags.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Flags(pub u32);

#[allow(missing_docs)]
impl Flags {
    /// No support: ballistic flight.
    pub const FLIGHT: Self = Self(1);
    /// The zero-moment point is outside the support polygon.
    pub const TIPPING: Self = Self(1 << 1);
    /// The overload rule replaced the active set.
    pub const OVERLOAD: Self = Self(1 << 2);
    /// A pseudo-inverse was damped because its rows were nearly dependent.
    pub const DAMPED: Self = Self(1 << 3);
    /// The controller's iteration bound was hit.
    pub const CONTROL_BOUND: Self = Self(1 << 4);
    /// A substep's iteration bound was hit.
    pub const STEP_BOUND: Self = Self(1 << 5);
    /// The figure has fallen: its centre of mass is below 45 % of its standing height on something other than its feet.
    pub const FALLEN: Self = Self(1 << 6);
    /// Non-finite or runaway state: frozen at its last good state.
    pub const QUARANTINED: Self = Self(1 << 7);
    /// Balance is lost: the controller handed over to motors alone.
    pub const BALANCE_LOST: Self = Self(1 << 8);
    /// Prescribed accelerations could not continue (saturated joints on a tilting support, overload, a part other than
    /// a foot touching), so a figure with the kinematic stepper is moved by its torques for the time being.
    pub const HANDED_OVER: Self = Self(1 << 9);
    /// The state was faster than any body can move and was braked.
    pub const SPEED_BOUND: Self = Self(1 << 10);
    /// Names of the flags, by bit.
    pub const NAMES: [&'static str; 11] = [
        "FLIGHT",
        "TIPPING",
        "OVERLOAD",
        "DAMPED",
        "CONTROL_BOUND",
        "STEP_BOUND",
        "FALLEN",
        "QUARANTINED",
        "BALANCE_LOST",
        "HANDED_OVER",
        "SPEED_BOUND",
    ];
    /// Whether every flag of `f` is set.
    pub const fn has(self, f: Self) -> bool {
        self.0 & f.0 == f.0
    }
    /// Sets the flags of `f`.
    pub const fn set(&mut self, f: Self) {
        self.0 |= f.0;
    }
}

/// The last substep as it was solved. It satisfies the equations of motion to rounding:
/// `M v̇ + h = Sᵀτ + Σ Jᵀ f + assist`, with `h` from Coriolis forces and gravity.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub struct Audit {
    /// State at the start of the substep.
    pub state: State,
    /// Acceleration over the substep `(v⁺ − v)/h`, layout of `State::velocity`; with the kinematic stepper, the applied
    /// acceleration, without impacts and the return of the support to its place.
    #[serde(with = "crate::saved::array")]
    pub acceleration: [f64; NV],
    /// Joint torques of muscles, N·m.
    #[serde(with = "crate::saved::array")]
    pub torque: [f64; DOF_COUNT],
    /// Passive joint torques, from joint limits and stretched tissue, N·m.
    #[serde(with = "crate::saved::array")]
    pub ligament_torque: [f64; DOF_COUNT],
    /// Ground and object contacts, at the start of the substep.
    pub contacts: Vec<ContactPoint>,
    /// Forces of perturbations and of other bodies: segment, world point, world force (N).
    pub applied: Vec<(SegmentId, Vec3, Vec3)>,
    /// Assist on the pelvis: moment about its origin (N·m), then force (N), world axes.
    pub assist: [f64; 6],
}

impl Audit {
    /// An empty audit with room for every contact and for `applied` forces.
    pub fn with_capacity(applied: usize) -> Self {
        Self {
            state: State::default(),
            acceleration: [0.0; NV],
            torque: [0.0; DOF_COUNT],
            ligament_torque: [0.0; DOF_COUNT],
            assist: [0.0; 6],
            contacts: Vec::with_capacity(MAX_CONTACTS),
            applied: Vec::with_capacity(applied),
        }
    }
}

impl Clone for Audit {
    fn clone(&self) -> Self {
        Self {
            state: self.state,
            acceleration: self.acceleration,
            torque: self.torque,
            ligament_torque: self.ligament_torque,
            contacts: self.contacts.clone(),
            applied: self.applied.clone(),
            assist: self.assist,
        }
    }

    /// Reuses the lists' memory; the derived implementation would allocate in every tick.
    fn clone_from(&mut self, other: &Self) {
        let Self {
            state,
            acceleration,
            torque,
            ligament_torque,
            contacts,
            applied,
            assist,
        } = other;
        self.state = *state;
        self.acceleration = *acceleration;
        self.torque = *torque;
        self.ligament_torque = *ligament_torque;
        self.contacts.clone_from(contacts);
        self.applied.clone_from(applied);
        self.assist = *assist;
    }
}

/// Joints in one tick; torques are means over the tick.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointReport {
    /// Muscle torque, N·m.
    #[serde(with = "crate::saved::array")]
    pub torque: [f64; DOF_COUNT],
    /// Ligament torque (joint limits), N·m.
    #[serde(with = "crate::saved::array")]
    pub ligament_torque: [f64; DOF_COUNT],
    /// Least available torque at the start of the tick, N·m (negative).
    #[serde(with = "crate::saved::array")]
    pub torque_lower: [f64; DOF_COUNT],
    /// Largest available torque at the start of the tick, N·m.
    #[serde(with = "crate::saved::array")]
    pub torque_upper: [f64; DOF_COUNT],
    /// Strength that fatigue leaves at the end of the tick, in the positive and negative direction of each DOF; 1 when
    /// fatigue is off.
    #[serde(with = "crate::saved::array")]
    pub remaining: [[f64; 2]; DOF_COUNT],
    /// Largest violation of the strength of any substep relative to that limit (0 when none).
    pub over_limit: f64,
    /// DOFs in the saturated set K of the primary constraint (bit = DOF); for other controllers: DOFs at their limit.
    pub saturated: u64,
    /// DOFs in the saturated set L of the secondary constraints.
    pub saturated_secondary: u64,
    /// Joint error `desired ⊖ actual` at the start of the tick, rad.
    #[serde(with = "crate::saved::array")]
    pub joint_error: [f64; DOF_COUNT],
}

/// Supports of the body in one tick, and its centre of mass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BalanceReport {
    /// Main supporting segment, if any.
    pub main_support: Option<SegmentId>,
    /// Support ratio (2) per segment (0 where it does not support).
    pub support_ratio: [f64; SEGMENT_COUNT],
    /// Convex hull of the supports on the ground, counter-clockwise, world x, y, m. At most 64 corners.
    pub support_polygon: Vec<[f64; 2]>,
    /// Zero-moment point (3), world, m; `None` in flight.
    pub zmp: Option<Vec3>,
    /// Signed distance of the ZMP inside the support polygon, m; `None` in flight.
    pub margin: Option<f64>,
    /// Centre of mass (loads included) of the state at the end of the tick, world, m.
    pub com: Vec3,
    /// Velocity of that centre of mass, world axes, m/s.
    pub com_velocity: Vec3,
    /// Desired centre of mass at the end of the tick, world, m.
    pub com_desired: Vec3,
}

/// Report on one tick of one figure. Torques and forces are means over the tick.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TickReport {
    /// Torques, limits and errors of the joints.
    pub joints: JointReport,
    /// Supports, zero-moment point and centre of mass.
    pub balance: BalanceReport,
    /// Assist on the pelvis: moment about its origin (N·m), then force (N), world axes; zero unless it is on.
    pub assist: [f64; 6],
    /// Acceleration over the tick, layout of `State::velocity`.
    #[serde(with = "crate::saved::array")]
    pub acceleration: [f64; NV],
    /// Touching points with their mean force.
    pub contacts: Vec<ContactPoint>,
    /// Parts that touch other figures and obstacles, by segment, then by the touched object; at most [`MAX_TOUCHES`].
    pub touches: Vec<Touch>,
    /// Error of each constraint set by a client, at the start of the tick: distance along the constrained axes (m),
    /// angle (rad).
    pub constraint_error: Vec<[f64; 2]>,
    /// Largest depth of any contact point below the surface at the start of any substep, m.
    pub penetration: f64,
    /// Iterations of the controller.
    pub control_iterations: u32,
    /// Iterations of all substeps.
    pub step_iterations: u32,
    /// Safeguards and state.
    pub flags: Flags,
    /// The last substep, for checks from outside.
    pub audit: Audit,
}

impl TickReport {
    /// An empty report of a figure in `state`, with room for every contact and touch, and for the given numbers of
    /// constraints and applied forces.
    pub fn empty(state: &State, constraints: usize, applied: usize) -> Self {
        let z = [0.0; DOF_COUNT];
        Self {
            joints: JointReport {
                torque: z,
                ligament_torque: z,
                torque_lower: z,
                torque_upper: z,
                remaining: [[1.0; 2]; DOF_COUNT],
                over_limit: 0.0,
                saturated: 0,
                saturated_secondary: 0,
                joint_error: z,
            },
            balance: BalanceReport {
                main_support: None,
                support_ratio: [0.0; SEGMENT_COUNT],
                support_polygon: Vec::with_capacity(MAX_CONTACTS),
                zmp: None,
                margin: None,
                com: Vec3::zero(),
                com_velocity: Vec3::zero(),
                com_desired: Vec3::zero(),
            },
            assist: [0.0; 6],
            acceleration: [0.0; NV],
            contacts: Vec::with_capacity(MAX_CONTACTS),
            touches: Vec::with_capacity(MAX_TOUCHES),
            constraint_error: Vec::with_capacity(constraints),
            penetration: 0.0,
            control_iterations: 0,
            step_iterations: 0,
            flags: Flags::default(),
            audit: Audit {
                state: *state,
                ..Audit::with_capacity(applied)
            },
        }
    }
}
