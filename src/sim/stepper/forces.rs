//! The forces that a stepper found in one tick.

use crate::body::topology::DOF_COUNT;
use crate::math::Vec3;
use crate::report::{Audit, ContactPoint, Flags};
use crate::setup::MAX_PERTURBATIONS;
use crate::stepper::self_contact::MAX_PAIRS;

/// Most forces of other bodies in the audit of one figure.
pub const MAX_EXTERNAL: usize = crate::touch::MAX_ISLAND_CONTACTS;
/// Most applied forces in an audit: perturbations, a bar, other bodies, the body itself.
pub const MAX_APPLIED: usize = MAX_PERTURBATIONS + 2 + MAX_EXTERNAL + 2 * MAX_PAIRS;

/// Means over a tick and the last substep.
#[derive(Clone, Debug)]
pub struct TickForces {
    /// Mean muscle torque, N·m.
    pub torque: [f64; DOF_COUNT],
    /// Mean torque of joint limits and stretched tissue, N·m.
    pub ligament_torque: [f64; DOF_COUNT],
    /// Mean assist on the pelvis: moment about its origin, N·m, then force, N.
    pub assist: [f64; 6],
    /// Mean force of the bar on its second end, N; the first end feels the opposite.
    pub bar: Vec3,
    /// Mean contact force by segment and vertex; zero at points that did not touch.
    pub contact: Vec<ContactPoint>,
    /// Largest relative violation of strength by any substep.
    pub over_limit: f64,
    /// Newton iterations of all substeps.
    pub iterations: u32,
    /// Flags raised while stepping.
    pub flags: Flags,
    /// The last substep.
    pub audit: Audit,
}

impl TickForces {
    /// No forces, with room for the given numbers of contacts and applied forces.
    pub fn new(contacts: usize, applied: usize) -> Self {
        Self {
            torque: [0.0; DOF_COUNT],
            ligament_torque: [0.0; DOF_COUNT],
            assist: [0.0; 6],
            bar: Vec3::zero(),
            contact: Vec::with_capacity(contacts),
            over_limit: 0.0,
            iterations: 0,
            flags: Flags::default(),
            audit: Audit::with_capacity(applied),
        }
    }
}
