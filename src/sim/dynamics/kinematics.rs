//! Positions, velocities and inertias of all segments in world axes.

use crate::body::topology::{DOF_AXIS, DOF_COUNT, DOF_START, JOINT, Joint, PARENT, SEGMENT_COUNT};
use crate::body::{Links, Posture, State};
use crate::math::{Lane, Mat3, Sym3, Vec3, trig};

/// Position and motion of every segment; world axes, positions relative to the pelvis origin.
#[derive(Clone, Debug)]
pub struct Kinematics<L = f64> {
    /// `world_from_segment`.
    pub rotation: [Mat3<L>; SEGMENT_COUNT],
    /// Segment origin minus pelvis origin, m.
    pub position: [Vec3<L>; SEGMENT_COUNT],
    /// Rotation axis of each joint DOF (it passes through the origin of the DOF's segment).
    pub axis: [Vec3<L>; DOF_COUNT],
    /// First moment of mass about the segment origin, kg·m.
    pub moment: [Vec3<L>; SEGMENT_COUNT],
    /// Inertia about the segment origin, kg·m².
    pub inertia: [Sym3<L>; SEGMENT_COUNT],
    /// Angular velocity, rad/s.
    pub omega: [Vec3<L>; SEGMENT_COUNT],
    /// Velocity of the segment origin, m/s.
    pub velocity: [Vec3<L>; SEGMENT_COUNT],
    /// Angular velocity after the first of two hinges in series (equals the parent's for other joints).
    pub omega_between: [Vec3<L>; SEGMENT_COUNT],
}

impl<L: Lane> Default for Kinematics<L> {
    fn default() -> Self {
        Self {
            rotation: [Mat3::identity(); SEGMENT_COUNT],
            position: [Vec3::zero(); SEGMENT_COUNT],
            axis: [Vec3::zero(); DOF_COUNT],
            moment: [Vec3::zero(); SEGMENT_COUNT],
            inertia: [Sym3::zero(); SEGMENT_COUNT],
            omega: [Vec3::zero(); SEGMENT_COUNT],
            velocity: [Vec3::zero(); SEGMENT_COUNT],
            omega_between: [Vec3::zero(); SEGMENT_COUNT],
        }
    }
}

/// `frame` turned by `angle` about its own signed coordinate axis; also returns that axis in the world.
#[inline(always)]
fn turn<L: Lane>(frame: Mat3<L>, dof: usize, angle: L) -> (Mat3<L>, Vec3<L>) {
    let a = DOF_AXIS[dof];
    let (s, c) = trig::sin_cos(angle);
    let s = if a.sign > 0 { s } else { -s };
    let Mat3 { x, y, z } = frame;
    let (turned, axis) = match a.axis {
        0 => (
            Mat3 {
                x,
                y: y * c + z * s,
                z: z * c - y * s,
            },
            x,
        ),
        1 => (
            Mat3 {
                x: x * c - z * s,
                y,
                z: z * c + x * s,
            },
            y,
        ),
        _ => (
            Mat3 {
                x: x * c + y * s,
                y: y * c - x * s,
                z,
            },
            z,
        ),
    };
    (turned, if a.sign > 0 { axis } else { -axis })
}

/// Signed axis of a ball DOF: a column of the child's rotation.
#[inline(always)]
fn column<L: Lane>(rotation: &Mat3<L>, dof: usize) -> Vec3<L> {
    let a = DOF_AXIS[dof];
    let v = match a.axis {
        0 => rotation.x,
        1 => rotation.y,
        _ => rotation.z,
    };
    if a.sign > 0 { v } else { -v }
}

impl<L: Lane> Kinematics<L> {
    /// Rotations, positions, axes and world inertias from a posture. O(n), no allocation.
    #[inline(always)]
    pub fn set_posture(&mut self, links: &Links<L>, posture: &Posture<L>) {
        self.rotation[0] = posture.root_rotation.to_mat3();
        self.position[0] = Vec3::zero();
        for s in 1..SEGMENT_COUNT {
            let (p, d) = (PARENT[s], DOF_START[s]);
            let parent = self.rotation[p];
            self.position[s] = self.position[p] + parent * links.offset[s];
            self.rotation[s] = match JOINT[s] {
                Joint::Free => parent,
                Joint::Ball(b) => {
                    let r = parent * posture.ball[b].to_mat3();
                    for k in 0..3 {
                        self.axis[d + k] = column(&r, d + k);
                    }
                    r
                }
                Joint::Hinge2(h) => {
                    let (r1, a1) = turn(parent, d, posture.hinge[h]);
                    let (r2, a2) = turn(r1, d + 1, posture.hinge[h + 1]);
                    self.axis[d] = a1;
                    self.axis[d + 1] = a2;
                    r2
                }
                Joint::Hinge1(h) => {
                    let (r, a) = turn(parent, d, posture.hinge[h]);
                    self.axis[d] = a;
                    r
                }
            };
        }
        for s in 0..SEGMENT_COUNT {
            self.moment[s] = self.rotation[s] * links.moment[s];
            self.inertia[s] = links.inertia[s].rotated(self.rotation[s]);
        }
    }

    /// Angular and linear velocities; needs [`Self::set_posture`] of the same posture. O(n), no allocation.
    #[inline(always)]
    pub fn set_velocity(&mut self, v: &[L]) {
        self.omega[0] = Vec3 {
            x: v[0],
            y: v[1],
            z: v[2],
        };
        self.velocity[0] = Vec3 {
            x: v[3],
            y: v[4],
            z: v[5],
        };
        self.omega_between[0] = self.omega[0];
        for s in 1..SEGMENT_COUNT {
            let (p, d) = (PARENT[s], DOF_START[s]);
            let w = self.omega[p];
            self.velocity[s] = self.velocity[p] + w.cross(self.position[s] - self.position[p]);
            let first = w + self.axis[d] * v[6 + d];
            match JOINT[s] {
                Joint::Free => {}
                Joint::Ball(_) => {
                    self.omega_between[s] = w;
                    self.omega[s] =
                        first + self.axis[d + 1] * v[7 + d] + self.axis[d + 2] * v[8 + d];
                }
                Joint::Hinge2(_) => {
                    self.omega_between[s] = first;
                    self.omega[s] = first + self.axis[d + 1] * v[7 + d];
                }
                Joint::Hinge1(_) => {
                    self.omega_between[s] = w;
                    self.omega[s] = first;
                }
            }
        }
    }

    /// Both of the above.
    #[inline(always)]
    pub fn set_state(&mut self, links: &Links<L>, state: &State<L>) {
        self.set_posture(links, &state.posture);
        self.set_velocity(&state.velocity);
    }

    /// `J̇v` of the joint of segment `s`: the part of the relative angular acceleration of child and parent that is not
    /// the axes times `q̈`.
    #[inline(always)]
    pub fn joint_bias(&self, s: usize, v: &[L]) -> Vec3<L> {
        let (p, d) = (PARENT[s], DOF_START[s]);
        let w = self.omega[p];
        match JOINT[s] {
            Joint::Free => Vec3::zero(),
            // The axes of a ball joint turn with the child: ω_c × w_rel = ω_p × w_rel.
            Joint::Ball(_) => w.cross(self.omega[s] - w),
            Joint::Hinge1(_) => w.cross(self.axis[d] * v[6 + d]),
            Joint::Hinge2(_) => {
                w.cross(self.axis[d] * v[6 + d])
                    + self.omega_between[s].cross(self.axis[d + 1] * v[7 + d])
            }
        }
    }
}
