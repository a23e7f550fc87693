//! Contact points as rows on the velocity, grouped by segment.

use super::projection::{Region, derivative, project};
use crate::body::topology::{DOF_LEN, DOF_START, NV, SEGMENT_COUNT};
use crate::dynamics::Kinematics;
use crate::dynamics::jacobian::for_each_column;
use crate::dynamics::mass_matrix::{CHAIN, DEPTH, ROW};
use crate::math::{Mat3, Vec3};
use crate::report::MAX_CONTACTS;

/// Padded length of a chain of velocity components.
pub const CHAIN_WIDTH: usize = ROW;

/// The deepest velocity component that moves a segment.
pub const fn last_component(s: usize) -> usize {
    if s == 0 {
        5
    } else {
        6 + DOF_START[s] + DOF_LEN[s] - 1
    }
}

/// A segment with touching points and its Jacobian along its chain (angular rows first, at the segment origin).
#[derive(Clone, Debug)]
pub struct SegmentRows {
    /// Segment index.
    pub segment: usize,
    /// Number of velocity components that move it.
    pub len: usize,
    /// Jacobian, column `k` belongs to component `chain()[k]`.
    pub jacobian: [[f64; CHAIN_WIDTH]; 6],
}

impl SegmentRows {
    /// The components that move the segment, root first.
    #[inline(always)]
    pub fn chain(&self) -> &'static [usize] {
        &CHAIN[last_component(self.segment)][..self.len]
    }

    /// `K J` for a stiffness `K` on the segment's twist, as [`System::add_segment`](super::newton::System::add_segment)
    /// takes it.
    #[inline(always)]
    pub fn stiffened(&self, stiffness: &[[f64; 6]; 6]) -> [[f64; CHAIN_WIDTH]; 6] {
        let mut kj = [[0.0; CHAIN_WIDTH]; 6];
        for a in 0..6 {
            for c in 0..6 {
                let y = stiffness[a][c];
                for i in 0..CHAIN_WIDTH {
                    kj[a][i] += y * self.jacobian[c][i];
                }
            }
        }
        kj
    }
}

/// One point: force `Proj_K(−(J x + c)/R)`.
#[derive(Clone, Copy, Debug)]
pub struct PointRow {
    /// Index into the segment list.
    pub slot: usize,
    /// Position relative to the segment origin, world axes, m.
    pub r: Vec3,
    /// Offset c.
    pub c: Vec3,
    /// 1/R.
    pub inverse_r: f64,
    /// Segment index, kept for reports.
    pub segment: usize,
    /// Vertex index in the segment's contact points, kept for reports.
    pub vertex: usize,
    /// Axes of the cone as columns, the normal last, if the normal is not vertical.
    pub turn: Option<Mat3>,
}

/// All contact rows of one figure. Capacity for every contact point is reserved once.
#[derive(Clone, Debug)]
pub struct ContactRows {
    /// Segments with rows.
    pub segments: Vec<SegmentRows>,
    /// Points.
    pub points: Vec<PointRow>,
    /// Friction coefficient μ.
    pub friction: f64,
}

impl ContactRows {
    /// No rows, with room for all.
    pub fn new(friction: f64) -> Self {
        Self {
            segments: Vec::with_capacity(SEGMENT_COUNT),
            points: Vec::with_capacity(MAX_CONTACTS),
            friction,
        }
    }

    /// Forgets all rows.
    pub fn clear(&mut self) {
        self.segments.clear();
        self.points.clear();
    }

    /// Slot of `segment`, added with its Jacobian if it has none yet. Points must be added segment by segment.
    pub fn slot(&mut self, kin: &Kinematics<f64>, segment: usize) -> usize {
        if self
            .segments
            .last()
            .is_some_and(|last| last.segment == segment)
        {
            return self.segments.len() - 1;
        }
        let mut jacobian = [[0.0; CHAIN_WIDTH]; 6];
        for_each_column(kin, segment, kin.position[segment], |i, a, v| {
            let k = DEPTH[i];
            let col = [a.x, a.y, a.z, v.x, v.y, v.z];
            for (row, x) in jacobian.iter_mut().zip(col) {
                row[k] = x;
            }
        });
        self.segments.push(SegmentRows {
            segment,
            len: DEPTH[last_component(segment)] + 1,
            jacobian,
        });
        self.segments.len() - 1
    }

    /// Velocity `J_k x` of every point into `out`.
    #[inline(always)]
    pub fn velocities(&self, x: &[f64; NV], out: &mut [Vec3; MAX_CONTACTS]) {
        let mut twist = [[0.0; 6]; SEGMENT_COUNT];
        for (s, t) in self.segments.iter().zip(twist.iter_mut()) {
            for (row, y) in s.jacobian.iter().zip(t.iter_mut()) {
                let mut z = 0.0;
                for (k, c) in s.chain().iter().enumerate() {
                    z += row[k] * x[*c];
                }
                *y = z;
            }
        }
        for (p, o) in self.points.iter().zip(out.iter_mut()) {
            let t = &twist[p.slot];
            let w = Vec3 {
                x: t[0],
                y: t[1],
                z: t[2],
            };
            *o = Vec3 {
                x: t[3],
                y: t[4],
                z: t[5],
            } + w.cross(p.r);
        }
    }

    /// `out += sign · Σ J_kᵀ f_k`.
    #[inline(always)]
    pub fn add_transposed(&self, f: &[Vec3; MAX_CONTACTS], sign: f64, out: &mut [f64; NV]) {
        let mut wrench = [[0.0; 6]; SEGMENT_COUNT];
        for (p, f) in self.points.iter().zip(f) {
            let n = p.r.cross(*f);
            let w = &mut wrench[p.slot];
            for (a, b) in w.iter_mut().zip([n.x, n.y, n.z, f.x, f.y, f.z]) {
                *a += b;
            }
        }
        for (s, w) in self.segments.iter().zip(&wrench) {
            for (row, x) in s.jacobian.iter().zip(w) {
                if *x == 0.0 {
                    continue;
                }
                let y = sign * x;
                for (k, c) in s.chain().iter().enumerate() {
                    out[*c] += y * row[k];
                }
            }
        }
    }

    /// Force of point `k` whose velocity is `velocity`.
    #[inline(always)]
    pub fn force(&self, k: usize, velocity: Vec3) -> (Vec3, Region) {
        let p = &self.points[k];
        let u = (velocity + p.c) * -p.inverse_r;
        match &p.turn {
            None => project(u, self.friction),
            Some(turn) => {
                let (f, region) = project(turn.transpose_mul(u), self.friction);
                (*turn * f, region)
            }
        }
    }

    /// Derivative of the force of point `k` with respect to minus its velocity, for the region of [`Self::force`].
    #[inline(always)]
    pub fn stiffness(&self, k: usize, velocity: Vec3, region: Region) -> [[f64; 3]; 3] {
        let p = &self.points[k];
        let u = (velocity + p.c) * -p.inverse_r;
        let mut d = match &p.turn {
            None => derivative(u, self.friction, region),
            Some(turn) => {
                let d = derivative(turn.transpose_mul(u), self.friction, region);
                let axes = [turn.x, turn.y, turn.z].map(Vec3::to_array);
                let mut out = [[0.0; 3]; 3];
                for (a, row) in out.iter_mut().enumerate() {
                    for (b, x) in row.iter_mut().enumerate() {
                        for i in 0..3 {
                            for j in 0..3 {
                                *x += axes[i][a] * d[i][j] * axes[j][b];
                            }
                        }
                    }
                }
                out
            }
        };
        for row in &mut d {
            for x in row {
                *x *= p.inverse_r;
            }
        }
        d
    }
}

/// Adds `Xᵀ D X` to a segment's 6×6 stiffness, `X = [−[r]×, 1]` (velocity of the point from the segment's twist).
#[inline(always)]
pub fn add_point_stiffness(total: &mut [[f64; 6]; 6], r: Vec3, d: &[[f64; 3]; 3]) {
    let x = [
        [0.0, r.z, -r.y, 1.0, 0.0, 0.0],
        [-r.z, 0.0, r.x, 0.0, 1.0, 0.0],
        [r.y, -r.x, 0.0, 0.0, 0.0, 1.0],
    ];
    let mut dx = [[0.0; 6]; 3];
    for a in 0..3 {
        for c in 0..6 {
            dx[a][c] = d[a][0] * x[0][c] + d[a][1] * x[1][c] + d[a][2] * x[2][c];
        }
    }
    for a in 0..6 {
        for c in 0..6 {
            total[a][c] += x[0][a] * dx[0][c] + x[1][a] * dx[1][c] + x[2][a] * dx[2][c];
        }
    }
}
