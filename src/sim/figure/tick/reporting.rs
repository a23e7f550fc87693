//! Stage 8: what a tick showed.

use super::state::StageResults;
use super::{Figure, TickContext};
use crate::sim::body::State;
use crate::sim::body::topology::{DOF_COUNT, NV, SEGMENT_COUNT};
use crate::sim::collide::MAX_TOUCHES;
use crate::sim::figure::constraints::MAX_CONSTRAINTS;
use crate::sim::figure::loads::MAX_APPLIED;
use crate::sim::math::Vec3;
use crate::sim::report::{Audit, Flags, MAX_CONTACTS, TickReport};

impl Figure {
    /// What the tick showed, for everyone outside.
    pub(super) fn write_report(&mut self, world: &TickContext, frozen: bool) {
        let StageResults {
            before, available, ..
        } = &self.scratch.results;
        let (f, penetration) = if self.stepping.prescribed {
            (
                &self.steppers.kinematic.forces,
                self.steppers.kinematic.penetration(),
            )
        } else {
            (
                &self.steppers.torque.forces,
                self.steppers.torque.penetration(),
            )
        };
        let r = &mut self.outcome.report;
        r.touches.clear();
        r.touches.extend(self.surroundings.touches.list());
        r.torque = f.torque;
        r.ligament_torque = f.ligament_torque;
        r.assist = f.assist;
        r.torque_lower = available.lower;
        r.torque_upper = available.upper;
        r.over_limit = f.over_limit;
        for i in 0..NV {
            r.acceleration[i] = (self.physical.state.velocity[i] - before.velocity[i]) / world.dt;
        }
        r.contacts.clone_from(&f.contact);
        r.main_support = self.surroundings.support.main();
        r.support_ratio = *self.surroundings.support.ratio();
        r.support_polygon.clear();
        r.support_polygon
            .extend_from_slice(self.surroundings.support.polygon().corners());
        // Zero-moment point of the forces that acted, (3): z = (−N_y, N_x)/F_z about the world origin.
        let (mut force, mut moment) = (0.0, (0.0, 0.0));
        for c in &r.contacts {
            let n = c.position.cross(c.force);
            force += c.force.z;
            moment = (moment.0 + n.x, moment.1 + n.y);
        }
        r.zmp = (force > 1e-3 * self.scratch.terms.mass).then(|| Vec3 {
            x: -moment.1 / force,
            y: moment.0 / force,
            z: 0.0,
        });
        r.margin = r.zmp.and_then(|z| self.surroundings.support.margin(z));
        (r.com, r.com_velocity) = self
            .scratch
            .tasks
            .center_of_mass(&self.physical.links, &self.physical.state);
        r.com_desired = self.desired.com.next;
        r.constraint_error.clear();
        let missing = self.desired.constraints.errors(&self.scratch.terms);
        r.constraint_error.extend_from_slice(missing);
        r.joint_error = before
            .posture
            .joint_difference(&self.desired.target.now.posture);
        r.penetration = penetration;
        r.step_iterations = f.iterations;
        r.flags.set(f.flags);
        if r.contacts.is_empty() && r.touches.is_empty() {
            r.flags.set(Flags::FLIGHT);
        }
        if self.motion.has_fallen() {
            r.flags.set(Flags::FALLEN);
        }
        if self.surroundings.balance.lost() {
            r.flags.set(Flags::BALANCE_LOST);
        }
        if self.stepping.handed_over.is_some() {
            r.flags.set(Flags::HANDED_OVER);
        }
        if frozen {
            r.flags.set(Flags::QUARANTINED);
        }
        r.audit.clone_from(&f.audit);
        let a = &r.acceleration;
        self.physical.com_acceleration = self.scratch.terms.com_bias
            + Vec3 {
                x: (0..NV).map(|i| self.scratch.terms.jc[0][i] * a[i]).sum(),
                y: (0..NV).map(|i| self.scratch.terms.jc[1][i] * a[i]).sum(),
                z: (0..NV).map(|i| self.scratch.terms.jc[2][i] * a[i]).sum(),
            };
        self.outcome.reported = true;
    }
}

/// A report with room for everything that a tick can show.
pub(super) fn empty_report(state: &State) -> TickReport {
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
            applied: Vec::with_capacity(MAX_APPLIED),
            assist: [0.0; 6],
        },
    }
}
