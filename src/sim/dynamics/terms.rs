//! Everything of one state that controllers and steppers share: inertia, bias, centre of mass, Jacobians
//! (`docs/notation.md`, §4).

use super::crba::{CompositeInertia, crba};
use super::jacobian::{bias_accelerations, for_each_column};
use super::kinematics::Kinematics;
use super::mass_matrix::MassMatrix;
use super::rnea::{External, ExternalForces, RneaWorkspace, rnea};
use crate::body::topology::{NV, SEGMENT_COUNT, SegmentId};
use crate::body::{Links, State};
use crate::math::{Mat3, Quat, Vec3};
use std::ops::{Deref, DerefMut};

pub use crate::math::dense::WIDTH;

/// A force on a point of a segment: segment, point (segment frame, m), force (world axes, N).
pub type AppliedForce = (SegmentId, Vec3, Vec3);

/// Positions and motion of the segments in one state.
#[derive(Clone, Debug, Default)]
pub struct Placement {
    /// The state.
    pub state: State,
    /// Segments in world axes.
    pub kin: Kinematics<f64>,
}

/// Placement, inertia and bias forces of one state: everything that a simulation substep needs. [`Terms`] has more.
#[derive(Debug)]
pub struct Dynamics {
    placement: Placement,
    /// Inertia matrix, tree-sparse, armature included.
    pub mass_matrix: MassMatrix<f64>,
    /// Coriolis, centrifugal and gravity forces minus applied forces.
    pub h: [f64; NV],
    /// Mass properties of subtrees.
    pub composite: CompositeInertia<f64>,
    bias: RneaWorkspace<f64>,
    scratch: RneaWorkspace<f64>,
    external: [External; SEGMENT_COUNT],
}

impl Deref for Dynamics {
    type Target = Placement;

    fn deref(&self) -> &Placement {
        &self.placement
    }
}

impl Default for Dynamics {
    fn default() -> Self {
        Self {
            placement: Placement::default(),
            mass_matrix: MassMatrix::default(),
            h: [0.0; NV],
            composite: CompositeInertia::default(),
            bias: RneaWorkspace::default(),
            scratch: RneaWorkspace::default(),
            external: [External::default(); SEGMENT_COUNT],
        }
    }
}

impl Clone for Dynamics {
    fn clone(&self) -> Self {
        let mut out = Self::default();
        out.clone_from(self);
        out
    }

    /// Copies field by field, in place. `scratch` and `external` are not copied: their contents are not needed again.
    fn clone_from(&mut self, other: &Self) {
        self.placement.clone_from(&other.placement);
        self.mass_matrix.rows = other.mass_matrix.rows;
        self.h = other.h;
        self.composite.clone_from(&other.composite);
        self.bias.clone_from(&other.bias);
    }
}

impl Placement {
    /// Computes the placement of a state.
    pub fn set_state(&mut self, links: &Links, state: &State) {
        self.state = *state;
        self.kin.set_state(links, state);
    }

    /// World position of a segment origin, m.
    pub fn segment_position(&self, s: usize) -> Vec3 {
        self.state.posture.root_position + self.kin.position[s]
    }
    /// `world_from_segment`.
    pub fn segment_rotation(&self, s: usize) -> Mat3 {
        self.kin.rotation[s]
    }
    /// Pose of a segment in the world, for `nalgebra`.
    pub fn segment_pose(&self, s: usize) -> nalgebra::Isometry3<f64> {
        let rotation = Quat::from_mat3(&self.segment_rotation(s));
        nalgebra::Isometry3::from_parts(
            nalgebra::Vector3::from(self.segment_position(s)).into(),
            rotation.into(),
        )
    }
    /// World position of a point given in the segment frame, m.
    pub fn point_world(&self, s: usize, local: Vec3) -> Vec3 {
        self.segment_position(s) + self.kin.rotation[s] * local
    }
    /// Velocity of a point given in the segment frame, m/s.
    pub fn point_velocity(&self, s: usize, local: Vec3) -> Vec3 {
        self.kin.velocity[s] + self.kin.omega[s].cross(self.kin.rotation[s] * local)
    }
}

impl Dynamics {
    /// Computes everything from a state. `gravity` is a magnitude (m/s²) along −z.
    pub fn compute(
        &mut self,
        links: &Links,
        state: &State,
        applied: &[AppliedForce],
        gravity: f64,
    ) {
        self.placement.set_state(links, state);
        self.compute_forces(links, applied, gravity);
    }

    /// Computes the rest, given the placement. `gravity` is a magnitude (m/s²) along −z.
    fn compute_forces(&mut self, links: &Links, applied: &[AppliedForce], gravity: f64) {
        let Placement { state, kin } = &self.placement;
        crba(links, kin, &mut self.composite, &mut self.mass_matrix);
        bias_accelerations(kin, &state.velocity, &mut self.bias);
        let zero = [0.0; NV];
        let external: &[External] = if applied.is_empty() {
            &[]
        } else {
            self.external.fill(External::default());
            for (s, point, force) in applied {
                let e = &mut self.external[s.index()];
                e.force += *force;
                e.moment += (kin.rotation[s.index()] * *point).cross(*force);
            }
            &self.external
        };
        rnea(
            links,
            kin,
            &state.velocity,
            &zero,
            ExternalForces {
                gravity,
                on_segments: external,
            },
            &mut self.scratch,
            &mut self.h,
        );
    }

    /// Adds one more force to those that act on the body.
    ///
    /// * `r`: its point of application on segment `s`, minus the pelvis origin, world axes, m. `force`: world axes, N.
    pub fn add_force(&mut self, s: usize, r: Vec3, force: Vec3) {
        for_each_column(&self.placement.kin, s, r, |i, _, v| {
            self.h[i] -= v.dot(force);
        });
    }
    /// Bias acceleration `J̇ v` of a point given in the segment frame, m/s².
    pub fn point_bias(&self, s: usize, local: Vec3) -> Vec3 {
        self.bias_at(s, self.kin.rotation[s] * local)
    }
    /// [`Self::point_bias`] of a point at offset `r` from the origin of the segment, world axes.
    pub fn bias_at(&self, s: usize, r: Vec3) -> Vec3 {
        let w = self.kin.omega[s];
        self.bias.acceleration[s] + self.bias.alpha[s].cross(r) + w.cross(w.cross(r))
    }
    /// Bias angular acceleration and bias acceleration of the origin of a segment.
    pub fn segment_bias(&self, s: usize) -> (Vec3, Vec3) {
        (self.bias.alpha[s], self.bias.acceleration[s])
    }
    /// Jacobian (rows x, y, z) of a point given in the segment frame.
    pub fn point_jacobian(&self, s: usize, local: Vec3, out: &mut [[f64; WIDTH]; 3]) {
        *out = [[0.0; WIDTH]; 3];
        let r = self.kin.position[s] + self.kin.rotation[s] * local;
        for_each_column(&self.kin, s, r, |i, _, v| {
            out[0][i] = v.x;
            out[1][i] = v.y;
            out[2][i] = v.z;
        });
    }
    /// Jacobian of a segment, angular rows first, then the velocity of its origin; world axes.
    pub fn segment_jacobian(&self, s: usize, out: &mut [[f64; WIDTH]; 6]) {
        *out = [[0.0; WIDTH]; 6];
        for_each_column(&self.kin, s, self.kin.position[s], |i, a, v| {
            (out[0][i], out[1][i], out[2][i]) = (a.x, a.y, a.z);
            (out[3][i], out[4][i], out[5][i]) = (v.x, v.y, v.z);
        });
    }
}

/// Dynamics of one state. [`Terms::compute`] and `clone_from` allocate nothing.
#[derive(Debug)]
pub struct Terms {
    dynamics: Dynamics,
    /// The inertia matrix, dense and symmetric, rows padded with zeros.
    pub m: Box<[[f64; WIDTH]; NV]>,
    /// Total mass, kg.
    pub mass: f64,
    /// Centre of mass, world, m.
    pub com: Vec3,
    /// Velocity of the centre of mass, m/s.
    pub com_velocity: Vec3,
    /// Bias acceleration of the centre of mass `J̇_c v`, m/s².
    pub com_bias: Vec3,
    /// Jacobian of the centre of mass, rows x, y, z.
    pub jc: [[f64; WIDTH]; 3],
}

impl Deref for Terms {
    type Target = Dynamics;

    fn deref(&self) -> &Dynamics {
        &self.dynamics
    }
}

impl DerefMut for Terms {
    fn deref_mut(&mut self) -> &mut Dynamics {
        &mut self.dynamics
    }
}

impl Clone for Terms {
    fn clone(&self) -> Self {
        let mut out = Self::default();
        out.clone_from(self);
        out
    }

    /// Copies field by field: the derived implementation would drop the box and allocate another one in every tick.
    fn clone_from(&mut self, other: &Self) {
        let Self {
            dynamics,
            m,
            mass,
            com,
            com_velocity,
            com_bias,
            jc,
        } = other;
        self.dynamics.clone_from(dynamics);
        self.m.clone_from(m);
        self.mass = *mass;
        self.com = *com;
        self.com_velocity = *com_velocity;
        self.com_bias = *com_bias;
        self.jc = *jc;
    }
}

impl Default for Terms {
    fn default() -> Self {
        Self {
            dynamics: Dynamics::default(),
            m: Box::new([[0.0; WIDTH]; NV]),
            mass: 0.0,
            com: Vec3::zero(),
            com_velocity: Vec3::zero(),
            com_bias: Vec3::zero(),
            jc: [[0.0; WIDTH]; 3],
        }
    }
}

impl Terms {
    /// Computes everything from a state. `gravity` is a magnitude (m/s²) along −z.
    pub fn compute(
        &mut self,
        links: &Links,
        state: &State,
        applied: &[AppliedForce],
        gravity: f64,
    ) {
        self.dynamics.placement.set_state(links, state);
        self.compute_forces(links, applied, gravity);
    }

    /// [`Self::compute`] for a state whose placement is known.
    pub fn compute_placed(
        &mut self,
        links: &Links,
        placement: &Placement,
        applied: &[AppliedForce],
        gravity: f64,
    ) {
        self.dynamics.placement.clone_from(placement);
        self.compute_forces(links, applied, gravity);
    }

    fn compute_forces(&mut self, links: &Links, applied: &[AppliedForce], gravity: f64) {
        self.dynamics.compute_forces(links, applied, gravity);
        let d = &self.dynamics;
        let state = &d.state;
        d.mass_matrix.to_dense(&mut self.m);
        self.mass = d.composite.mass[0];
        let inv = 1.0 / self.mass;
        self.com = state.posture.root_position + d.composite.moment[0] * inv;
        for i in 0..NV {
            for k in 0..3 {
                self.jc[k][i] = self.m[3 + k][i] * inv;
            }
        }
        let row = |k: usize| {
            (0..NV)
                .map(|i| self.jc[k][i] * state.velocity[i])
                .sum::<f64>()
        };
        self.com_velocity = Vec3 {
            x: row(0),
            y: row(1),
            z: row(2),
        };
        let mut f = Vec3::zero();
        for s in 0..SEGMENT_COUNT {
            let (w, h) = (d.kin.omega[s], d.kin.moment[s]);
            f += d.bias.acceleration[s] * links.mass[s]
                + d.bias.alpha[s].cross(h)
                + w.cross(w.cross(h));
        }
        self.com_bias = f * inv;
    }

    /// Rows A and bias b of the centroidal angular momentum L, world axes: `L = A v`, N·m·s, and `L̇ = A v̇ + b`, N·m
    /// (the angular half of the centroidal momentum matrix of Orin, Goswami & Lee 2013).
    ///
    /// The first three rows of `M v̇ + h` are a moment about the pelvis, the next three a force; taken about the centre
    /// of mass, gravity contributes no moment.
    pub fn spin_rows(&self) -> ([[f64; WIDTH]; 3], Vec3) {
        let c = self.com - self.state.posture.root_position;
        let about = |moment: Vec3, force: Vec3| moment - c.cross(force);
        let column = |i: usize, first: usize| Vec3 {
            x: self.m[first][i],
            y: self.m[first + 1][i],
            z: self.m[first + 2][i],
        };
        let mut rows = [[0.0; WIDTH]; 3];
        for i in 0..NV {
            let a = about(column(i, 0), column(i, 3)).to_array();
            for (row, a) in rows.iter_mut().zip(a) {
                row[i] = a;
            }
        }
        let [mx, my, mz, fx, fy, fz, ..] = self.h;
        let bias = about(
            Vec3::from_array([mx, my, mz]),
            Vec3::from_array([fx, fy, fz]),
        );
        (rows, bias)
    }
    /// Force and moment about the world origin that the ground must supply for the acceleration `vdot` (first six rows
    /// of `M v̇ + h`, `docs/notation.md`).
    pub fn ground_wrench(&self, vdot: &[f64; NV]) -> (Vec3, Vec3) {
        let row = |i: usize| self.h[i] + (0..NV).map(|j| self.m[i][j] * vdot[j]).sum::<f64>();
        let moment = Vec3 {
            x: row(0),
            y: row(1),
            z: row(2),
        };
        let force = Vec3 {
            x: row(3),
            y: row(4),
            z: row(5),
        };
        (
            force,
            moment + self.state.posture.root_position.cross(force),
        )
    }
}
