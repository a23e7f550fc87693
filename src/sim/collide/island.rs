//! One convex problem for all bodies of an island: figures with their motors, limits and ground, free obstacles, and the contacts between.
//!
//! The problem of a figure's substep ([`crate::sim::contact::minimise`]) is a sum of convex terms on its own velocity. A contact between two
//! bodies adds one more on the relative velocity of its two points. Newton's matrix is then block-diagonal plus a term of low rank:
//! contacts with fixed things stay in the blocks' own pattern, those between two moving bodies are taken in by the Woodbury identity. One
//! line search along the common direction keeps the descent of the whole sum, so that the method is as safe as the one for one figure.
//!
//! Each contact's impulse acts on both bodies at one and the same point: momentum is kept whatever residual is left.

use crate::sim::body::topology::{DOF_COUNT, NV, SEGMENT_COUNT};
use crate::sim::contact::limits::LIMIT_STIFFNESS;
use crate::sim::contact::newton::System;
use crate::sim::contact::projection::{Region, derivative, project};
use crate::sim::contact::rows::{CHAIN_WIDTH, add_point_stiffness};
use crate::sim::contact::{ContactRows, LimitRows, Motors, NewtonWorkspace, Outcome, SparseSystem};
use crate::sim::dynamics::factor::{factor, solve};
use crate::sim::dynamics::mass_matrix::{DEPTH, MassMatrix};
use crate::sim::math::Vec3;

/// Most Newton iterations of one island. 5 to 15 are typical; heads, arms and trunks that fall onto each other take up to 100, and a step
/// cut short lets them sink in.
const MAX_ITERATIONS: u32 = 120;
/// Most evaluations of one line search.
const LINE_SEARCH: usize = 16;
/// Residual at which the island counts as solved, N·m·s.
const TOLERANCE: f64 = 1e-6;

/// The parts of a figure's substep that the island needs.
#[derive(Debug)]
pub struct Parts<'a> {
    /// Inertia.
    pub m: &'a MassMatrix<f64>,
    /// Storage for Newton's matrix and its factor.
    pub hessian: &'a mut MassMatrix<f64>,
    /// Momentum without motors, limits and contacts, at the end of the substep.
    pub b: &'a [f64; NV],
    /// Motors.
    pub motors: &'a Motors,
    /// Joint limits.
    pub limits: &'a LimitRows,
    /// Contacts with the ground.
    pub contacts: &'a ContactRows,
    /// Forces of the last iterate.
    pub newton: &'a mut NewtonWorkspace,
    /// Velocity: the first guess, then the solution.
    pub x: &'a mut [f64; NV],
}

/// Something with joints that takes part in an island.
pub trait Articulated {
    /// Its parts in the present substep.
    fn parts(&mut self) -> Parts<'_>;
}

/// Which body a block is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Index into the slice of figures.
    Figure(usize),
    /// Index of the free body, as the caller counts.
    Free(usize),
}

#[derive(Clone, Debug)]
struct Block {
    kind: Kind,
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

/// One contact: force `Proj(−(u + c)/R)` on A at the relative velocity u of its points, the opposite on B.
#[derive(Clone, Debug)]
pub struct Contact {
    /// Block of each side; `None` is something that nothing moves.
    pub block: [Option<usize>; 2],
    /// What touches what: body and part, as the caller counts.
    pub ends: [(usize, usize); 2],
    /// World, m.
    pub position: Vec3,
    /// Two tangents and the normal from B to A.
    pub frame: [Vec3; 3],
    /// Gap at the start of the substep, m.
    pub gap: f64,
    /// Offset of the relative velocity in the frame, m/s; holds the velocity of a side without block too.
    pub c: Vec3,
    /// Part of it that is the velocity of a side without block.
    pub firm: Vec3,
    /// Friction coefficient.
    pub mu: f64,
    /// 1/R, kg.
    pub inverse_r: f64,
    /// Impulse on A in the frame, N·s.
    pub impulse: Vec3,
    rows: [[[f64; NV]; 3]; 2],
    u: Vec3,
    du: Vec3,
    region: Region,
}

impl Contact {
    /// Impulse on A, world axes, N·s.
    pub fn world_impulse(&self) -> Vec3 {
        let (f, t) = (self.impulse, &self.frame);
        t[0] * f.x + t[1] * f.y + t[2] * f.z
    }
    /// Impulse times the relative velocity after the solve, J; a side without block counts with its own velocity.
    pub fn work_after(&self) -> f64 {
        self.impulse.dot(self.u + self.firm)
    }
    fn at(&self, u: Vec3) -> (Vec3, Region) {
        project((u + self.c) * -self.inverse_r, self.mu)
    }
}

/// Two unit vectors that make a right-handed frame with `n`.
pub fn tangents(n: Vec3) -> [Vec3; 2] {
    let other = if n.x.abs() < 0.6 { Vec3::X } else { Vec3::Y };
    let a = n.cross(other).normalized_or(Vec3::X);
    [n.cross(a), a]
}

/// A column of the low-rank part: `Gᵀ E` on up to two blocks, and the same multiplied by the inverse block matrices.
#[derive(Clone, Debug)]
struct Column {
    block: [usize; 2],
    v: [[f64; NV]; 2],
    y: [[f64; NV]; 2],
}

/// Buffers of the solver; made once per world.
#[derive(Clone, Debug, Default)]
pub struct Island {
    blocks: Vec<Block>,
    contacts: Vec<Contact>,
    columns: Vec<Column>,
    small: Vec<f64>,
    rhs: Vec<f64>,
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
    /// Forgets everything but the memory.
    pub fn clear(&mut self) {
        self.blocks.clear();
        self.contacts.clear();
    }

    fn add_block(&mut self, kind: Kind) -> usize {
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

    /// A figure, by its index in the slice given to [`Self::solve`].
    pub fn add_figure(&mut self, index: usize) -> usize {
        self.add_block(Kind::Figure(index))
    }

    /// A free body: mass, columns of the inertia about its centre, momentum (moment, then linear) at the end of the substep if nothing
    /// touched it, and its velocity (angular, then linear) as the first guess.
    pub fn add_free(
        &mut self,
        index: usize,
        mass: f64,
        inertia: [Vec3; 3],
        momentum: [Vec3; 2],
        velocity: [Vec3; 2],
    ) -> usize {
        let k = self.add_block(Kind::Free(index));
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

    /// A contact that pushes where the two approach faster than `approach` (m/s); `firm` is the velocity of a second side without block.
    /// `visit` is called for each side that has a block and gives the velocity of the contact's point, world axes, for a unit of
    /// each velocity component of that body.
    pub fn add_contact(
        &mut self,
        block: [Option<usize>; 2],
        ends: [(usize, usize); 2],
        (position, normal, gap): (Vec3, Vec3, f64),
        (approach, firm, mu): (f64, Vec3, f64),
        inverse_r: f64,
        mut visit: impl FnMut(usize, &mut dyn FnMut(usize, Vec3)),
    ) {
        let t = tangents(normal);
        let frame = [t[0], t[1], normal];
        let mut rows = [[[0.0; NV]; 3]; 2];
        for (side, sign) in [(0, 1.0), (1, -1.0)] {
            if block[side].is_some() {
                visit(side, &mut |i, v| {
                    for (row, axis) in rows[side].iter_mut().zip(&frame) {
                        row[i] = sign * axis.dot(v);
                    }
                });
            }
        }
        let firm = Vec3 {
            x: -frame[0].dot(firm),
            y: -frame[1].dot(firm),
            z: -frame[2].dot(firm),
        };
        let local = firm + Vec3::Z * approach;
        self.contacts.push(Contact {
            block,
            ends,
            position,
            frame,
            gap,
            c: local,
            firm,
            mu,
            inverse_r,
            impulse: Vec3::zero(),
            rows,
            u: Vec3::zero(),
            du: Vec3::zero(),
            region: Region::Open,
        });
    }

    /// Contacts with their impulses.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// True if any contact pushes at the velocities of the first guess. If none does, everybody's own solution solves the island.
    pub fn is_active<F: Articulated>(&mut self, figures: &mut [F]) -> bool {
        for b in &mut self.blocks {
            if let Kind::Figure(i) = b.kind {
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

    /// Solves from the velocities that the figures hold and leaves the solution there. Bounded work.
    pub fn solve<F: Articulated>(&mut self, figures: &mut [F]) -> Outcome {
        for b in &mut self.blocks {
            match b.kind {
                Kind::Figure(i) => {
                    let p = figures[i].parts();
                    b.x = *p.x;
                    p.m.mul(&b.x, &mut b.ax);
                    p.contacts.velocities(&b.x, &mut p.newton.velocity);
                }
                Kind::Free(_) => {
                    b.ax = [0.0; NV];
                    for i in 0..6 {
                        b.ax[i] = (0..6).map(|j| b.a[i][j] * b.x[j]).sum();
                    }
                }
            }
        }
        self.velocities();
        let mut out = Outcome::default();
        loop {
            self.gradients(figures);
            out.residual = self
                .blocks
                .iter()
                .flat_map(|b| &b.grad)
                .fold(0.0, |m: f64, g| m.max(g.abs()));
            out.converged = out.residual < TOLERANCE;
            if out.converged || out.iterations >= MAX_ITERATIONS || !out.residual.is_finite() {
                break;
            }
            out.iterations += 1;
            self.factor_blocks(figures);
            if !self.direction(figures) {
                break;
            }
            self.line_search(figures);
        }
        for b in &self.blocks {
            if let Kind::Figure(i) = b.kind {
                *figures[i].parts().x = b.x;
            }
        }
        out
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
            .position(|b| b.kind == Kind::Figure(index))?;
        let mut x = [0.0; NV];
        self.add_impulses(k, &mut x);
        Some(x)
    }

    /// Impulse (linear) and moment impulse about the centre of all contacts on free body `index`; `None` if it takes no part.
    pub fn free_impulse(&self, index: usize) -> Option<(Vec3, Vec3)> {
        let k = self
            .blocks
            .iter()
            .position(|b| b.kind == Kind::Free(index))?;
        let mut x = [0.0; NV];
        self.add_impulses(k, &mut x);
        Some((
            Vec3::from_array([x[3], x[4], x[5]]),
            Vec3::from_array([x[0], x[1], x[2]]),
        ))
    }

    fn gradients<F: Articulated>(&mut self, figures: &mut [F]) {
        for b in &mut self.blocks {
            match b.kind {
                Kind::Figure(i) => {
                    let p = figures[i].parts();
                    for k in 0..NV {
                        b.grad[k] = b.ax[k] - p.b[k];
                    }
                    for j in 0..DOF_COUNT {
                        let (t, s) = p.motors.value(j, b.x[6 + j]);
                        p.newton.motor[j] = t;
                        b.slope[j] = s;
                        b.grad[6 + j] -= t;
                    }
                    p.newton.limit.fill(0.0);
                    for row in &p.limits.rows {
                        let q = row.impulse(row.rate(&b.x));
                        if q > 0.0 {
                            for k in 0..row.len {
                                p.newton.limit[row.first - 6 + k] += q * row.coefficients[k];
                            }
                        }
                    }
                    for j in 0..DOF_COUNT {
                        b.grad[6 + j] -= p.newton.limit[j];
                    }
                    for k in 0..p.contacts.points.len() {
                        (p.newton.force[k], p.newton.region[k]) =
                            p.contacts.force(k, p.newton.velocity[k]);
                    }
                    p.contacts
                        .add_transposed(&p.newton.force, -1.0, &mut b.grad);
                }
                Kind::Free(_) => {
                    for k in 0..6 {
                        b.grad[k] = b.ax[k] - b.b[k];
                    }
                }
            }
        }
        for c in &mut self.contacts {
            (c.impulse, c.region) = c.at(c.u);
            if c.region == Region::Open {
                continue;
            }
            for side in 0..2 {
                if let Some(b) = c.block[side] {
                    for (row, f) in c.rows[side].iter().zip(c.impulse.to_array()) {
                        for (g, r) in self.blocks[b].grad.iter_mut().zip(row) {
                            *g -= f * r;
                        }
                    }
                }
            }
        }
    }

    /// Newton's matrix of every block, without contacts between two moving bodies; factored.
    fn factor_blocks<F: Articulated>(&mut self, figures: &mut [F]) {
        for (k, b) in self.blocks.iter_mut().enumerate() {
            match b.kind {
                Kind::Figure(i) => {
                    let mut p = figures[i].parts();
                    own_matrix(&mut p, b);
                    for c in &self.contacts {
                        let Some(side) = one_sided(c, k) else {
                            continue;
                        };
                        let d = stiffness(c);
                        let chain = |i: usize| c.rows[side].iter().any(|r| r[i] != 0.0);
                        for i in (0..NV).filter(|i| chain(*i)) {
                            let row = &mut p.hessian.rows[i];
                            for j in (0..=i).filter(|j| chain(*j)) {
                                row[DEPTH[j]] += quadratic(&c.rows[side], &d, i, j);
                            }
                        }
                    }
                    factor(p.hessian);
                }
                Kind::Free(_) => {
                    b.l = b.a;
                    for c in &self.contacts {
                        let Some(side) = one_sided(c, k) else {
                            continue;
                        };
                        let d = stiffness(c);
                        for i in 0..6 {
                            for j in 0..=i {
                                b.l[i][j] += quadratic(&c.rows[side], &d, i, j);
                            }
                        }
                    }
                    for j in 0..6 {
                        for i in j..6 {
                            let mut z = b.l[i][j];
                            for m in 0..j {
                                z -= b.l[i][m] * b.l[j][m];
                            }
                            b.l[i][j] = if i == j {
                                z.max(1e-300).sqrt()
                            } else {
                                z / b.l[j][j]
                            };
                        }
                    }
                }
            }
        }
    }

    /// Newton's direction of the whole island.
    fn direction<F: Articulated>(&mut self, figures: &mut [F]) -> bool {
        for b in &mut self.blocks {
            b.d = std::array::from_fn(|i| -b.grad[i]);
            let mut x = b.d;
            solve_block(b, figures, &mut x);
            b.d = x;
        }
        // Columns of the contacts between two moving bodies.
        self.columns.clear();
        for c in &self.contacts {
            let ([Some(a), Some(b)], true) = (c.block, c.region != Region::Open) else {
                continue;
            };
            let (e, n) = root(c);
            for e in e.iter().take(n) {
                let mut column = Column {
                    block: [a, b],
                    v: [[0.0; NV]; 2],
                    y: [[0.0; NV]; 2],
                };
                for side in 0..2 {
                    for (row, w) in c.rows[side].iter().zip(e) {
                        for (v, r) in column.v[side].iter_mut().zip(row) {
                            *v += w * r;
                        }
                    }
                    column.y[side] = column.v[side];
                    solve_block(
                        &self.blocks[column.block[side]],
                        figures,
                        &mut column.y[side],
                    );
                }
                self.columns.push(column);
            }
        }
        let n = self.columns.len();
        if n > 0 {
            // (1 + Bᵀ H⁻¹ B) z = Bᵀ d₀, then d = d₀ − H⁻¹ B z.
            self.small.clear();
            self.small.resize(n * n, 0.0);
            self.rhs.clear();
            for (i, p) in self.columns.iter().enumerate() {
                for (j, q) in self.columns.iter().enumerate().take(i + 1) {
                    let mut z = if i == j { 1.0 } else { 0.0 };
                    for s in 0..2 {
                        for t in 0..2 {
                            if p.block[s] == q.block[t] {
                                z += dot(&p.v[s], &q.y[t]);
                            }
                        }
                    }
                    self.small[i * n + j] = z;
                }
                let z = dot(&p.v[0], &self.blocks[p.block[0]].d)
                    + dot(&p.v[1], &self.blocks[p.block[1]].d);
                self.rhs.push(z);
            }
            if !cholesky_solve(&mut self.small, &mut self.rhs) {
                return false;
            }
            for (p, z) in self.columns.iter().zip(&self.rhs) {
                for s in 0..2 {
                    for (d, y) in self.blocks[p.block[s]].d.iter_mut().zip(&p.y[s]) {
                        *d -= z * y;
                    }
                }
            }
        }
        self.blocks
            .iter()
            .all(|b| b.d.iter().all(|x| x.is_finite()))
    }

    /// Exact line search along the common direction, and the step.
    fn line_search<F: Articulated>(&mut self, figures: &mut [F]) {
        let (mut q0, mut q1, mut slope0) = (0.0, 0.0, 0.0);
        for b in &mut self.blocks {
            match b.kind {
                Kind::Figure(i) => {
                    let p = figures[i].parts();
                    p.m.mul(&b.d, &mut b.ad);
                    p.contacts.velocities(&b.d, &mut p.newton.direction);
                    for k in 0..NV {
                        q0 += b.d[k] * (b.ax[k] - p.b[k]);
                    }
                }
                Kind::Free(_) => {
                    b.ad = [0.0; NV];
                    for k in 0..6 {
                        b.ad[k] = (0..6).map(|j| b.a[k][j] * b.d[j]).sum();
                        q0 += b.d[k] * (b.ax[k] - b.b[k]);
                    }
                }
            }
            q1 += dot(&b.d, &b.ad);
            slope0 += dot(&b.d, &b.grad);
        }
        let blocks = &self.blocks;
        for c in &mut self.contacts {
            c.du = relative(c, |b| &blocks[b].d);
        }
        let contacts = &self.contacts;
        let mut phi = |a: f64| {
            let mut z = q0 + a * q1;
            for b in blocks {
                if let Kind::Figure(i) = b.kind {
                    let p = figures[i].parts();
                    for j in 0..DOF_COUNT {
                        z -= b.d[6 + j] * p.motors.value(j, b.x[6 + j] + a * b.d[6 + j]).0;
                    }
                    for row in &p.limits.rows {
                        let r = row.rate(&b.d);
                        if r != 0.0 {
                            z -= r * row.impulse(row.rate(&b.x) + a * r);
                        }
                    }
                    for k in 0..p.contacts.points.len() {
                        let v = p.newton.velocity[k] + p.newton.direction[k] * a;
                        z -= p.newton.direction[k].dot(p.contacts.force(k, v).0);
                    }
                }
            }
            for c in contacts {
                z -= c.du.dot(c.at(c.u + c.du * a).0);
            }
            z
        };
        let mut a = 1.0;
        let full = phi(1.0);
        if full > 0.1 * slope0.abs() {
            let (mut lo, mut flo, mut hi, mut fhi) = (0.0, slope0, 1.0, full);
            for _ in 0..LINE_SEARCH {
                a = lo - flo * (hi - lo) / (fhi - flo);
                if a.is_nan() || a <= lo + 1e-3 * (hi - lo) {
                    a = lo + 1e-2 * (hi - lo);
                }
                let p = phi(a);
                if p.abs() < 0.05 * slope0.abs() {
                    break;
                }
                if p < 0.0 {
                    (lo, flo) = (a, p);
                    fhi *= 0.5;
                } else {
                    (hi, fhi) = (a, p);
                    flo *= 0.5;
                }
            }
        }
        for b in &mut self.blocks {
            for k in 0..NV {
                b.x[k] += a * b.d[k];
                b.ax[k] += a * b.ad[k];
            }
            if let Kind::Figure(i) = b.kind {
                let p = figures[i].parts();
                for k in 0..p.contacts.points.len() {
                    p.newton.velocity[k] += p.newton.direction[k] * a;
                }
            }
        }
        for c in &mut self.contacts {
            c.u += c.du * a;
        }
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

/// The side on which an active contact with something fixed has `block`.
fn one_sided(c: &Contact, block: usize) -> Option<usize> {
    if c.region == Region::Open {
        return None;
    }
    match c.block {
        [Some(b), None] if b == block => Some(0),
        [None, Some(b)] if b == block => Some(1),
        _ => None,
    }
}

fn stiffness(c: &Contact) -> [[f64; 3]; 3] {
    let mut d = derivative((c.u + c.c) * -c.inverse_r, c.mu, c.region);
    for row in &mut d {
        for x in row {
            *x *= c.inverse_r;
        }
    }
    d
}

/// `rowsᵀ d rows` at (i, j).
fn quadratic(rows: &[[f64; NV]; 3], d: &[[f64; 3]; 3], i: usize, j: usize) -> f64 {
    let mut z = 0.0;
    for a in 0..3 {
        for b in 0..3 {
            z += rows[a][i] * d[a][b] * rows[b][j];
        }
    }
    z
}

/// Columns e with `Σ e eᵀ` the stiffness of an active contact.
fn root(c: &Contact) -> ([[f64; 3]; 3], usize) {
    let s = c.inverse_r.sqrt();
    if c.region == Region::Stick {
        return ([[s, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, s]], 3);
    }
    let u = (c.u + c.c) * -c.inverse_r;
    let t = (u.x * u.x + u.y * u.y).sqrt();
    let q = 1.0 / (1.0 + c.mu * c.mu);
    let along = s * q.sqrt();
    let side = s * (c.mu * (u.z + c.mu * t) * q / t).max(0.0).sqrt();
    (
        [
            [c.mu * u.x / t * along, c.mu * u.y / t * along, along],
            [-u.y / t * side, u.x / t * side, 0.0],
            [0.0; 3],
        ],
        2,
    )
}

/// The matrix of one figure's own problem into its storage, as in [`crate::sim::contact::minimise`].
fn own_matrix(p: &mut Parts<'_>, b: &Block) {
    type S<'a> = SparseSystem<'a>;
    SparseSystem(p.m).load(p.hessian);
    for j in 0..DOF_COUNT {
        S::add(p.hessian, 6 + j, 6 + j, b.slope[j]);
    }
    for row in &p.limits.rows {
        if row.rate(&b.x) < -row.allowed {
            for i in 0..row.len {
                for j in 0..=i {
                    let v = LIMIT_STIFFNESS * row.coefficients[i] * row.coefficients[j];
                    S::add(p.hessian, row.first + i, row.first + j, v);
                }
            }
        }
    }
    let mut stiffness = [[[0.0; 6]; 6]; SEGMENT_COUNT];
    let mut touching = [false; SEGMENT_COUNT];
    for (k, point) in p.contacts.points.iter().enumerate() {
        let region = p.newton.region[k];
        if region != Region::Open {
            let d = p.contacts.stiffness(k, p.newton.velocity[k], region);
            add_point_stiffness(&mut stiffness[point.slot], point.r, &d);
            touching[point.slot] = true;
        }
    }
    for (slot, s) in p.contacts.segments.iter().enumerate() {
        if touching[slot] {
            let mut kj = [[0.0; CHAIN_WIDTH]; 6];
            for a in 0..6 {
                for c in 0..6 {
                    let y = stiffness[slot][a][c];
                    for i in 0..CHAIN_WIDTH {
                        kj[a][i] += y * s.jacobian[c][i];
                    }
                }
            }
            S::add_segment(p.hessian, s, &kj);
        }
    }
}

fn solve_block<F: Articulated>(b: &Block, figures: &mut [F], x: &mut [f64; NV]) {
    match b.kind {
        Kind::Figure(i) => solve(figures[i].parts().hessian, x),
        Kind::Free(_) => {
            for i in 0..6 {
                let mut z = x[i];
                for j in 0..i {
                    z -= b.l[i][j] * x[j];
                }
                x[i] = z / b.l[i][i];
            }
            for i in (0..6).rev() {
                let mut z = x[i];
                for j in i + 1..6 {
                    z -= b.l[j][i] * x[j];
                }
                x[i] = z / b.l[i][i];
            }
        }
    }
}

/// Solves the symmetric positive definite system with lower triangle `m` (row by row) in place; false if it is not.
fn cholesky_solve(m: &mut [f64], x: &mut [f64]) -> bool {
    let n = x.len();
    for i in 0..n {
        let (head, tail) = m.split_at_mut(i * n);
        let row = &mut tail[..n];
        for j in 0..i {
            let other = &head[j * n..j * n + n];
            let mut z = row[j];
            for k in 0..j {
                z -= row[k] * other[k];
            }
            row[j] = z / other[j];
        }
        let mut z = row[i];
        for k in 0..i {
            z -= row[k] * row[k];
        }
        if z.is_nan() || z <= 0.0 {
            return false;
        }
        row[i] = z.sqrt();
        let mut y = x[i];
        for k in 0..i {
            y -= row[k] * x[k];
        }
        x[i] = y / row[i];
    }
    for i in (0..n).rev() {
        let mut y = x[i];
        for k in i + 1..n {
            y -= m[k * n + i] * x[k];
        }
        x[i] = y / m[i * n + i];
    }
    true
}
