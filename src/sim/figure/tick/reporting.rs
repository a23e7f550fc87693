//! Stage 8: the report of a tick.

use crate::body::topology::{DOF_COUNT, NV};
use crate::figure::motion::following::FollowMode;
use crate::figure::state::figure::Figure;
use crate::figure::state::parts::{PhysicalState, StageResults};
use crate::math::Vec3;
use crate::motion::GRAVITY;
use crate::report::Flags;
use crate::stepper::command::TorqueRange;
use crate::support::zmp_above;
use crate::tick_context::TickContext;

/// DOFs whose torque is at its limit, one bit each. Limits follow angles and rates within the tick.
fn at_limit(torque: &[f64; DOF_COUNT], available: &TorqueRange) -> u64 {
    (0..DOF_COUNT)
        .filter(|d| torque[*d] >= available.upper[*d] || torque[*d] <= available.lower[*d])
        .fold(0, |mask, d| mask | 1 << d)
}

impl Figure {
    /// Writes the results of the tick, for readers outside.
    pub(in crate::figure) fn write_report(&mut self, world: &TickContext, frozen: bool) {
        let PhysicalState { links, state, .. } = &self.physical;
        let com = self.workspace.tasks.center_of_mass(links, state);
        let StageResults {
            before, available, ..
        } = &self.scratch.results;
        let prescribed = self.stepping.is_prescribed();
        let moved = self.workspace.steppers.result(prescribed);
        let f = moved.forces;
        let r = &mut self.outcome.report;
        r.touches.clear();
        r.touches.extend(self.surroundings.touches.list());
        r.joints.torque = f.torque;
        r.joints.ligament_torque = f.ligament_torque;
        r.assist = f.assist;
        r.joints.torque_lower = available.lower;
        r.joints.torque_upper = available.upper;
        r.joints.over_limit = f.over_limit;
        if self.motion.rehearsed().is_some() {
            r.joints.saturated = at_limit(&f.torque, available);
        }
        for i in 0..NV {
            r.acceleration[i] = (self.physical.state.velocity[i] - before.velocity[i]) / world.dt;
        }
        r.contacts.clone_from(&f.contact);
        r.balance.main_support = self.surroundings.support.main();
        r.balance.support_ratio = *self.surroundings.support.ratio();
        r.balance.support_polygon.clear();
        r.balance
            .support_polygon
            .extend_from_slice(self.surroundings.support.polygon().corners());
        // Zero-moment point of the forces that acted, (3): z = (−N_y, N_x)/F_z about the world origin.
        let (mut force, mut moment) = (Vec3::zero(), Vec3::zero());
        for c in &r.contacts {
            force += c.force;
            moment += c.position.cross(c.force);
        }
        r.balance.zmp = zmp_above(1e-3 * self.workspace.terms.mass, force, moment);
        r.balance.margin = r
            .balance
            .zmp
            .and_then(|z| self.surroundings.support.margin(z));
        (r.balance.com, r.balance.com_velocity) = com;
        r.balance.com_desired = self.desired.com.next;
        r.constraint_error.clear();
        let missing = self.desired.constraints.errors(&self.workspace.terms);
        r.constraint_error.extend_from_slice(missing);
        r.joints.joint_error = before
            .posture
            .joint_difference(&self.desired.target.now.posture);
        r.penetration = moved.penetration;
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
        if self.stepping.is_handed_over() {
            r.flags.set(Flags::HANDED_OVER);
        }
        if frozen {
            r.flags.set(Flags::QUARANTINED);
        }
        r.audit.clone_from(&f.audit);
        let a = &r.acceleration;
        self.physical.com_acceleration = self.workspace.terms.com_bias
            + Vec3 {
                x: (0..NV).map(|i| self.workspace.terms.jc[0][i] * a[i]).sum(),
                y: (0..NV).map(|i| self.workspace.terms.jc[1][i] * a[i]).sum(),
                z: (0..NV).map(|i| self.workspace.terms.jc[2][i] * a[i]).sum(),
            };
        self.outcome.reported = true;
        self.note_following(world, frozen);
    }

    /// Notes how the motion was followed, and the help that it took.
    fn note_following(&mut self, world: &TickContext, frozen: bool) {
        if frozen {
            self.motion
                .note(FollowMode::Nothing, [0.0; 2], 0.0, world.dt);
            return;
        }
        let assist = &self.outcome.report.assist;
        let helped = match self.motion.rehearsed() {
            Some(play) => play.is_helped(),
            None => *assist != [0.0; 6],
        };
        let mode = if helped {
            FollowMode::Helped
        } else if self.motion.rehearsed().is_some() {
            FollowMode::Rehearsed
        } else if self.has_motion(world.time()) {
            FollowMode::Tracked
        } else {
            FollowMode::Nothing
        };
        let [mx, my, mz, fx, fy, fz] = *assist;
        let help = [[mx, my, mz], [fx, fy, fz]].map(|v| Vec3::from_array(v).norm());
        let weight = self.setup.body.profile.mass * GRAVITY;
        self.motion.note(mode, help, weight, world.dt);
    }
}
