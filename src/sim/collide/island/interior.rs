//! A fallback for islands at which Newton's method jams: the interior-point method of [`crate::contact::interior`], for
//! all bodies at once.
//!
//! Motor values, joint limits, contacts with the ground and contacts between bodies are separate unknowns, strictly
//! inside their bounds. Eliminating them leaves Newton's matrix of the island with other slopes, so the same code
//! (`direction`) builds and solves it. The number of iterations does not depend on the number of corners along the
//! path.

use super::{Articulated, ArticulatedParts, BlockKind, Island, relative};
use crate::body::topology::{DOF_COUNT, NV};
use crate::contact::cone::{Cone, squared};
use crate::contact::interior::{Inner, TO_BOUNDARY, Wall, aim, to_cone, to_world};
use crate::contact::projection::Region;
use crate::contact::{ContactRows, Motors};
use crate::math::Vec3;

/// Forces at the start, in units of the largest present force; multipliers are as large as the largest velocity. With
/// smaller forces, bodies thrown into walls crawl along the boundary; with much larger ones, a few iterations are
/// wasted.
const FIRST_FORCE: f64 = 3.0;
/// Complementarity, relative to that at the start, below which the velocities are tested as a solution of the island.
/// Handing over to Newton's method without this test is not enough: bodies start with the force of the largest blow,
/// and even 10⁻¹² of that may be as large as the forces on the smallest limbs.
const NEARLY: f64 = 1e-12;
/// A motor whose range is less than this share of the widest, or that has no gain, is treated as constant.
const NARROW: f64 = 1e-9;
/// Smallest friction coefficient used here, because a narrower cone has almost no interior; Newton's method then uses
/// the true one.
const LEAST_FRICTION: f64 = 1e-3;

/// Sum and number of the products of multiplier and distance.
#[derive(Clone, Copy, Debug, Default)]
struct Gap {
    sum: f64,
    count: f64,
}

impl Gap {
    fn add(&mut self, product: f64, count: f64) {
        self.sum += product;
        self.count += count;
    }
}

fn friction(mu: f64) -> f64 {
    mu.max(LEAST_FRICTION)
}

/// Whether motor `j` has no range or no gain.
fn is_fixed(motors: &Motors, j: usize, widest: f64) -> bool {
    let half = 0.5 * (motors.upper[j] - motors.lower[j]);
    half.is_nan() || half <= NARROW * widest || motors.gain[j] <= 0.0
}

fn widest(motors: &Motors) -> f64 {
    (0..DOF_COUNT).fold(0.0f64, |m, j| {
        m.max(0.5 * (motors.upper[j] - motors.lower[j]))
    })
}

/// Velocity of a contact with the ground in its cone's coordinates.
fn ground(contacts: &ContactRows, k: usize, v: Vec3) -> Vec3 {
    let turn = contacts.points[k].turn.as_ref();
    to_cone(turn, friction(contacts.friction), v)
}

impl Island {
    /// Leads the velocities to the solution from any start, in at most `iterations` iterations; returns the number of
    /// iterations. Bounded work.
    pub(super) fn approach<F: Articulated>(&mut self, figures: &mut [F], iterations: u32) -> u32 {
        self.enter(figures);
        let (mut start, mut last_step, mut done) = (0.0, 1.0f64, 0);
        for round in 0..iterations {
            let gap = self.gap(figures);
            if round == 0 {
                start = gap;
            }
            let aim = aim(gap, last_step);
            self.linearise(figures, aim);
            done = round + 1;
            if !self.direction(figures, true) {
                break;
            }
            let step = (TO_BOUNDARY * self.way(figures, aim)).min(1.0);
            self.walk(figures, step);
            last_step = step;
            if step > 0.9 && gap < NEARLY * start && self.judge(figures).1 {
                break;
            }
        }
        for c in &mut self.contacts {
            c.inside = None;
        }
        done
    }

    /// Starts every unknown in the middle of its range.
    fn enter<F: Articulated>(&mut self, figures: &mut [F]) {
        let most = self.most(figures);
        let (mut force, mut fastest) = (most, 1e-9f64);
        for b in &self.blocks {
            fastest = b.x.iter().fold(fastest, |m, x| m.max(x.abs()));
            if let BlockKind::Figure(i) = b.kind {
                let p = figures[i].parts();
                force = p.b.iter().fold(force, |m, b| m.max(b.abs()));
                let forces = &p.newton.force[..p.contacts.points.len()];
                force = forces.iter().fold(force, |m, f| m.max(f.norm()));
            }
        }
        for c in &self.contacts {
            force = force.max(c.impulse.norm());
        }
        let force = FIRST_FORCE * if force > 0.0 { force } else { 1.0 };
        let size = fastest;
        for b in &self.blocks {
            let BlockKind::Figure(i) = b.kind else {
                continue;
            };
            let p = figures[i].parts();
            let inner = &mut *p.interior;
            for (j, m) in inner.motors.iter_mut().enumerate() {
                *m = if is_fixed(p.motors, j, most) {
                    Inner::default()
                } else {
                    Inner::begin(p.motors, j, b.x[6 + j], size, force)
                };
            }
            for (row, w) in p.limits.rows.iter().zip(&mut inner.walls) {
                *w = Wall::begin(row.rate(&b.x) + row.allowed, size, force);
            }
            for (k, point) in p.contacts.points.iter().enumerate() {
                let v = ground(p.contacts, k, p.newton.velocity[k] + point.c);
                inner.cones[k] = Cone::begin(v, size, force);
            }
        }
        self.cones.clear();
        for c in &self.contacts {
            let v = to_cone(None, friction(c.mu), c.u + c.c);
            self.cones.push(Cone::begin(v, size, force));
        }
    }

    /// Mean product of multiplier and distance.
    fn gap<F: Articulated>(&self, figures: &mut [F]) -> f64 {
        let most = self.most(figures);
        let mut gap = Gap::default();
        for b in &self.blocks {
            let BlockKind::Figure(i) = b.kind else {
                continue;
            };
            let p = figures[i].parts();
            let inner = &*p.interior;
            for (j, m) in inner.motors.iter().enumerate() {
                if !is_fixed(p.motors, j, most) {
                    gap.add(m.gap(), 2.0);
                }
            }
            for w in &inner.walls[..p.limits.rows.len()] {
                gap.add(w.gap(), 1.0);
            }
            for c in &inner.cones[..p.contacts.points.len()] {
                gap.add(c.gap(), 1.0);
            }
        }
        for c in &self.cones {
            gap.add(c.gap(), 1.0);
        }
        gap.sum / gap.count.max(1.0)
    }

    /// Half-range of the widest motor, N·m·s.
    fn most<F: Articulated>(&self, figures: &mut [F]) -> f64 {
        self.blocks.iter().fold(0.0f64, |m, b| match b.kind {
            BlockKind::Figure(i) => m.max(widest(figures[i].parts().motors)),
            BlockKind::Free(_) => m,
        })
    }

    /// Eliminates motors, limits and contacts: computes their slopes and the residual of the equations of motion.
    fn linearise<F: Articulated>(&mut self, figures: &mut [F], aim: f64) {
        let most = self.most(figures);
        for b in &mut self.blocks {
            match b.kind {
                BlockKind::Figure(i) => {
                    let mut p = figures[i].parts();
                    for k in 0..NV {
                        b.grad[k] = b.ax[k] - p.b[k];
                    }
                    linearise_figure(&mut p, &b.x, most, aim, &mut b.slope, &mut b.grad);
                }
                BlockKind::Free(_) => {
                    // Clear all entries: values that an interior point outside its cone wrote behind the sixth entry
                    // would stay there.
                    b.grad = [0.0; NV];
                    for k in 0..6 {
                        b.grad[k] = b.ax[k] - b.b[k];
                    }
                }
            }
        }
        for (c, cone) in self.contacts.iter_mut().zip(&mut self.cones) {
            let mu = friction(c.mu);
            let root = cone.eliminate(1.0 / c.inverse_r, mu, to_cone(None, mu, c.u + c.c), aim);
            c.inside = Some(root.map(|e| to_world(None, mu, e)));
            c.region = Region::Stick;
            c.impulse = to_world(None, mu, cone.next());
            for side in 0..2 {
                let Some(b) = c.block[side] else { continue };
                for (row, f) in c.rows[side].iter().zip(c.impulse.to_array()) {
                    for (g, r) in self.blocks[b].grad.iter_mut().zip(row) {
                        *g -= f * r;
                    }
                }
            }
        }
    }

    /// Steps of all eliminated unknowns, and the distance to the nearest boundary.
    fn way<F: Articulated>(&mut self, figures: &mut [F], aim: f64) -> f64 {
        let most = self.most(figures);
        let mut step = 1.0 / TO_BOUNDARY;
        for b in &self.blocks {
            let BlockKind::Figure(i) = b.kind else {
                continue;
            };
            let p = figures[i].parts();
            p.contacts.velocities(&b.d, &mut p.newton.direction);
            let inner = &mut *p.interior;
            for (j, m) in inner.motors.iter_mut().enumerate() {
                if !is_fixed(p.motors, j, most) {
                    step = m.direct((b.slope[j], b.d[6 + j]), aim, step);
                }
            }
            for (row, w) in p.limits.rows.iter().zip(&mut inner.walls) {
                step = w.direct(row.rate(&b.d), aim, step);
            }
            for k in 0..p.contacts.points.len() {
                let dv = ground(p.contacts, k, p.newton.direction[k]);
                step = inner.cones[k].direct(dv, aim, step);
            }
        }
        let blocks = &self.blocks;
        for (c, cone) in self.contacts.iter_mut().zip(&mut self.cones) {
            c.du = relative(c, |b| &blocks[b].d);
            let mu = friction(c.mu);
            let dv = to_cone(None, mu, c.du);
            step = cone.direct(dv, aim, step);
        }
        step
    }

    fn walk<F: Articulated>(&mut self, figures: &mut [F], step: f64) {
        for b in &mut self.blocks {
            match b.kind {
                BlockKind::Figure(i) => {
                    let p = figures[i].parts();
                    p.m.mul(&b.d, &mut b.ad);
                    for k in 0..p.contacts.points.len() {
                        p.newton.velocity[k] += p.newton.direction[k] * step;
                    }
                    let inner = &mut *p.interior;
                    // Fixed motors take no steps.
                    inner.motors.iter_mut().for_each(|m| m.advance(step));
                    let limits = &mut inner.walls[..p.limits.rows.len()];
                    limits.iter_mut().for_each(|w| w.advance(step));
                    let cones = &mut inner.cones[..p.contacts.points.len()];
                    cones.iter_mut().for_each(|c| c.advance(step));
                }
                BlockKind::Free(_) => {
                    b.ad = [0.0; NV];
                    for i in 0..6 {
                        b.ad[i] = (0..6).map(|j| b.a[i][j] * b.d[j]).sum();
                    }
                }
            }
            for k in 0..NV {
                b.x[k] += step * b.d[k];
                b.ax[k] += step * b.ad[k];
            }
        }
        for (c, cone) in self.contacts.iter_mut().zip(&mut self.cones) {
            cone.advance(step);
            c.u += c.du * step;
        }
    }
}

/// One figure's motors, limits and contacts with the ground: slopes, and their part of the residual.
fn linearise_figure(
    p: &mut ArticulatedParts<'_>,
    x: &[f64; NV],
    most: f64,
    aim: f64,
    slope: &mut [f64; DOF_COUNT],
    grad: &mut [f64; NV],
) {
    let inner = &mut *p.interior;
    for (j, m) in inner.motors.iter_mut().enumerate() {
        let value = if is_fixed(p.motors, j, most) {
            slope[j] = 0.0;
            p.motors.value(j, x[6 + j]).0
        } else {
            slope[j] = m.eliminate(p.motors, j, x[6 + j], aim);
            m.next(p.motors, j)
        };
        grad[6 + j] -= value;
    }
    for (row, w) in p.limits.rows.iter().zip(&mut inner.walls) {
        w.eliminate(1.0 / row.stiffness, row.rate(x) + row.allowed, aim);
        for k in 0..row.len {
            grad[row.first + k] -= (w.q + w.dq) * row.coefficients[k];
        }
    }
    let mu = friction(p.contacts.friction);
    for (k, point) in p.contacts.points.iter().enumerate() {
        let turn = point.turn.as_ref();
        let v = to_cone(turn, mu, p.newton.velocity[k] + point.c);
        let cone = &mut inner.cones[k];
        let root = cone.eliminate(1.0 / point.inverse_r, mu, v, aim);
        inner.stiffness[k] = squared(&root.map(|e| to_world(turn, mu, e)));
        p.newton.force[k] = to_world(turn, mu, cone.next());
    }
    p.contacts.add_transposed(&p.newton.force, -1.0, grad);
}

#[cfg(test)]
mod tests;
