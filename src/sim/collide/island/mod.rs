//! One convex problem for all bodies of an island: figures with their motors, limits and ground, free obstacles, and
//! the contacts between.
//!
//! The problem of a figure's substep ([`crate::contact::minimise`]) is a sum of convex terms on its own velocity. A
//! contact between two bodies adds one more term on the relative velocity of its two points. Newton's matrix
//! (`direction`) is then block-diagonal plus a term of low rank: contacts with fixed objects stay in the blocks' own
//! pattern, and those between two moving bodies are handled separately. One line search (`newton`) along the common
//! direction ensures descent of the whole sum, so the method is as safe as that for a single figure. If it jams, an
//! interior-point method on the same matrix takes over (`interior`).
//!
//! Each contact's impulse acts on both bodies at the same point, so momentum is conserved whatever the residual.

mod direction;
mod interior;
mod newton;

use crate::body::topology::{DOF_COUNT, NV};
use crate::collide::narrow::Near;
use crate::contact::cone::Cone;
use crate::contact::projection::{Region, project};
use crate::contact::{ContactRows, Interior, LimitRows, Motors, NewtonWorkspace};
use crate::dynamics::mass_matrix::MassMatrix;
use crate::math::Vec3;

/// The parts of a figure's substep that the island needs.
#[derive(Debug)]
pub struct ArticulatedParts<'a> {
    /// Inertia.
    pub m: &'a MassMatrix<f64>,
    /// Storage for Newton's matrix and its factor.
    pub hessian: &'a mut MassMatrix<f64>,
    /// Momentum at the end of the substep without motors, limits and contacts.
    pub b: &'a [f64; NV],
    /// Motors.
    pub motors: &'a Motors,
    /// Joint limits.
    pub limits: &'a LimitRows,
    /// Contacts with the ground.
    pub contacts: &'a ContactRows,
    /// Forces of the last iterate.
    pub newton: &'a mut NewtonWorkspace,
    /// Buffers of the interior-point method.
    pub interior: &'a mut Interior,
    /// Velocity: the first guess, then the solution.
    pub x: &'a mut [f64; NV],
}

/// An articulated body that takes part in an island.
pub trait Articulated {
    /// Its parts in the present substep.
    fn parts(&mut self) -> ArticulatedParts<'_>;
}

/// The body of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum BlockKind {
    /// Index into the slice of figures.
    Figure(usize),
    /// The caller's index of the free body.
    Free(usize),
}

#[derive(Clone, Debug)]
struct Block {
    kind: BlockKind,
    /// Velocity; free bodies use the first six (angular, linear).
    x: [f64; NV],
    ax: [f64; NV],
    grad: [f64; NV],
    d: [f64; NV],
    ad: [f64; NV],
    slope: [f64; DOF_COUNT],
    /// Free bodies: momentum and inertia, and the factor of Newton's matrix.
    b: [f64; 6],
    a: [[f64; 6]; 6],
    l: [[f64; 6]; 6],
}

impl Block {
    /// Number of velocity components.
    fn len(&self) -> usize {
        match self.kind {
            BlockKind::Figure(_) => NV,
            BlockKind::Free(_) => 6,
        }
    }
}

/// One contact: force `Proj(−(u + c)/R)` on A at the relative velocity u of its points, the opposite on B.
#[derive(Clone, Debug)]
pub struct Contact {
    /// Block of each side; `None` is an immovable object.
    pub block: [Option<usize>; 2],
    /// The touching body and part of each side, in the caller's numbering.
    pub ends: [(usize, usize); 2],
    /// World, m.
    pub position: Vec3,
    /// Two tangents and the normal from B to A.
    pub frame: [Vec3; 3],
    /// Gap at the start of the substep, m.
    pub gap: f64,
    /// Offset of the relative velocity in the frame, m/s; includes the velocity of a side without a block.
    pub c: Vec3,
    /// The part of it that is the velocity of a side without a block.
    pub firm: Vec3,
    /// Friction coefficient.
    pub mu: f64,
    /// 1/R, kg.
    pub inverse_r: f64,
    /// Impulse on A in the frame, N·s.
    pub impulse: Vec3,
    rows: [[[f64; NV]; 3]; 2],
    /// The used entries of the rows of each side, in ascending order, and their number.
    used: [([u8; NV], usize); 2],
    u: Vec3,
    du: Vec3,
    region: Region,
    /// Root of the stiffness in the frame while the interior-point method is active: columns c with `Σ c cᵀ`.
    inside: Option<[Vec3; 3]>,
}

impl Contact {
    /// Impulse on A, world axes, N·s.
    pub fn world_impulse(&self) -> Vec3 {
        let (f, t) = (self.impulse, &self.frame);
        t[0] * f.x + t[1] * f.y + t[2] * f.z
    }
    /// Impulse times the relative velocity after the solve, J; a side without a block counts with its own velocity.
    pub fn work_after(&self) -> f64 {
        self.impulse.dot(self.u + self.firm)
    }
    /// Used entries of the rows of a side.
    fn used(&self, side: usize) -> impl Iterator<Item = usize> + Clone + '_ {
        let (list, len) = &self.used[side];
        list[..*len].iter().map(|i| usize::from(*i))
    }
    fn at(&self, u: Vec3) -> (Vec3, Region) {
        project((u + self.c) * -self.inverse_r, self.mu)
    }
}

/// Parameters of a contact's push and friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactLaw {
    /// It pushes if the two sides approach faster than this, m/s.
    pub approach: f64,
    /// Velocity of a second side that has no block, world, m/s.
    pub firm: Vec3,
    /// Friction coefficient.
    pub mu: f64,
    /// 1/R, kg.
    pub inverse_r: f64,
}

/// Two unit vectors that make a right-handed frame with `n`.
pub fn tangents(n: Vec3) -> [Vec3; 2] {
    let other = if n.x.abs() < 0.6 { Vec3::X } else { Vec3::Y };
    let a = n.cross(other).normalized_or(Vec3::X);
    [n.cross(a), a]
}

/// A column of the low-rank part: `Gᵀ E` on up to two blocks, and the same multiplied by the inverse block matrices.
#[derive(Clone, Debug)]
struct CouplingColumn {
    block: [usize; 2],
    v: [[f64; NV]; 2],
    y: [[f64; NV]; 2],
}

/// Buffers of the solver; made once per world.
#[derive(Clone, Debug, Default)]
pub struct Island {
    blocks: Vec<Block>,
    contacts: Vec<Contact>,
    columns: Vec<CouplingColumn>,
    matrix: Vec<f64>,
    rhs: Vec<f64>,
    first: Vec<usize>,
    cones: Vec<Cone>,
}

fn dot(a: &[f64; NV], b: &[f64; NV]) -> f64 {
    let mut s = [0.0; 5];
    for (x, y) in a.chunks_exact(5).zip(b.chunks_exact(5)) {
        for k in 0..5 {
            s[k] += x[k] * y[k];
        }
    }
    s[0] + s[1] + s[2] + s[3] + s[4]
}

impl Island {
    /// Forgets everything but keeps its memory.
    pub fn clear(&mut self) {
        self.blocks.clear();
        self.contacts.clear();
    }

    fn add_block(&mut self, kind: BlockKind) -> usize {
        let z = [0.0; NV];
        self.blocks.push(Block {
            kind,
            x: z,
            ax: z,
            grad: z,
            d: z,
            ad: z,
            slope: [0.0; DOF_COUNT],
            b: [0.0; 6],
            a: [[0.0; 6]; 6],
            l: [[0.0; 6]; 6],
        });
        self.blocks.len() - 1
    }

    /// Adds a figure, by its index in the slice given to [`Self::solve`].
    pub fn add_figure(&mut self, index: usize) -> usize {
        self.add_block(BlockKind::Figure(index))
    }

    /// Adds a free body: mass, columns of the inertia about its centre, momentum (moment, then linear) at the end of
    /// the substep if nothing touched it, and its velocity (angular, then linear) as the first guess.
    pub fn add_free(
        &mut self,
        index: usize,
        mass: f64,
        inertia: [Vec3; 3],
        momentum: [Vec3; 2],
        velocity: [Vec3; 2],
    ) -> usize {
        let k = self.add_block(BlockKind::Free(index));
        let block = &mut self.blocks[k];
        for i in 0..3 {
            let column = inertia[i].to_array();
            for j in 0..3 {
                block.a[j][i] = column[j];
            }
            block.a[3 + i][3 + i] = mass;
            block.b[i] = momentum[0].to_array()[i];
            block.b[3 + i] = momentum[1].to_array()[i];
            block.x[i] = velocity[0].to_array()[i];
            block.x[3 + i] = velocity[1].to_array()[i];
        }
        k
    }

    /// Adds a contact between two sides; `block` and `ends` are as in [`Contact`]. `visit` is called for each side that
    /// has a block and gives the velocity of the contact's point, world axes, for a unit of each velocity component of
    /// that body, each once.
    pub fn add_contact(
        &mut self,
        block: [Option<usize>; 2],
        ends: [(usize, usize); 2],
        near: Near,
        law: ContactLaw,
        mut visit: impl FnMut(usize, &mut dyn FnMut(usize, Vec3)),
    ) {
        let t = tangents(near.normal);
        let frame = [t[0], t[1], near.normal];
        let mut rows = [[[0.0; NV]; 3]; 2];
        let mut used = [([0; NV], 0); 2];
        for (side, sign) in [(0, 1.0), (1, -1.0)] {
            if block[side].is_some() {
                visit(side, &mut |i, v| {
                    for (row, axis) in rows[side].iter_mut().zip(&frame) {
                        row[i] = sign * axis.dot(v);
                    }
                    let (list, len) = &mut used[side];
                    list[*len] = i as u8;
                    *len += 1;
                });
                let (list, len) = &mut used[side];
                list[..*len].sort_unstable();
            }
        }
        let firm = Vec3 {
            x: -frame[0].dot(law.firm),
            y: -frame[1].dot(law.firm),
            z: -frame[2].dot(law.firm),
        };
        let local = firm + Vec3::Z * law.approach;
        self.contacts.push(Contact {
            block,
            ends,
            position: near.position,
            frame,
            gap: near.gap,
            c: local,
            firm,
            mu: law.mu,
            inverse_r: law.inverse_r,
            impulse: Vec3::zero(),
            rows,
            used,
            u: Vec3::zero(),
            du: Vec3::zero(),
            region: Region::Open,
            inside: None,
        });
    }

    /// Contacts with their impulses.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// Whether any contact pushes at the velocities of the first guess. If none does, the separate solutions of the
    /// bodies solve the island.
    pub fn is_active<F: Articulated>(&mut self, figures: &mut [F]) -> bool {
        for b in &mut self.blocks {
            if let BlockKind::Figure(i) = b.kind {
                b.x = *figures[i].parts().x;
            }
        }
        self.velocities();
        self.contacts.iter().any(|c| c.at(c.u).1 != Region::Open)
    }

    fn velocities(&mut self) {
        let blocks = &self.blocks;
        for c in &mut self.contacts {
            c.u = relative(c, |b| &blocks[b].x);
        }
    }

    /// Adds the impulses of all contacts on a block to its momentum.
    fn add_impulses(&self, block: usize, x: &mut [f64; NV]) {
        for c in &self.contacts {
            for side in 0..2 {
                if c.block[side] == Some(block) && c.impulse != Vec3::zero() {
                    for (row, f) in c.rows[side].iter().zip(c.impulse.to_array()) {
                        for (x, r) in x.iter_mut().zip(row) {
                            *x += f * r;
                        }
                    }
                }
            }
        }
    }

    /// Impulse of all contacts on figure `index`, in its velocity components; `None` if it takes no part.
    pub fn figure_impulse(&self, index: usize) -> Option<[f64; NV]> {
        let k = self
            .blocks
            .iter()
            .position(|b| b.kind == BlockKind::Figure(index))?;
        let mut x = [0.0; NV];
        self.add_impulses(k, &mut x);
        Some(x)
    }

    /// Impulse (linear) and moment impulse about the centre of all contacts on free body `index`; `None` if it takes no
    /// part.
    pub fn free_impulse(&self, index: usize) -> Option<(Vec3, Vec3)> {
        let k = self
            .blocks
            .iter()
            .position(|b| b.kind == BlockKind::Free(index))?;
        let mut x = [0.0; NV];
        self.add_impulses(k, &mut x);
        Some((
            Vec3::from_array([x[3], x[4], x[5]]),
            Vec3::from_array([x[0], x[1], x[2]]),
        ))
    }
}

fn relative<'a>(c: &Contact, of: impl Fn(usize) -> &'a [f64; NV]) -> Vec3 {
    let mut u = [0.0; 3];
    for side in 0..2 {
        if let Some(b) = c.block[side] {
            for (u, row) in u.iter_mut().zip(&c.rows[side]) {
                *u += dot(row, of(b));
            }
        }
    }
    Vec3::from_array(u)
}
