//! A starting method for problems at which the semi-smooth Newton method jams: a primal-dual interior-point method on
//! the same matrix.
//!
//! If many motors and contacts lie far on the wrong side of their corners, an exact line search stops at the nearest
//! corner again and again. Here motor values t and forces f are separate unknowns that stay strictly inside their
//! limits and cones, with multipliers that tend to zero where t and f are free:
//!
//! ```text
//! A x − b − t − Jᵀf = 0
//! t/g − rest + x = z₁ − z₂,   z₁ (t − lower) = z₂ (upper − t) = μ
//! R f + J x + c = λ,          f ∘ λ = μ
//! (w − rest)/κ + x + z w = 0, ½ z (most² − |w|²) = μ
//! ```
//!
//! Eliminating them leaves Newton's matrix with other slopes: `1/(1/g + z₁/(t − lower) + z₂/(upper − t))` for a motor
//! and `(R + W⁻²)⁻¹` for a contact ([`super::cone`]), with the scaling W of Nesterov and Todd for second-order cones
//! (Andersen, Dahl & Vandenberghe 2003). Newton's method finishes from the resulting prices. The controller's problem
//! has no joint limits; islands of bodies ([`crate::collide::island`]) have them, as [`Wall`]s.

use super::cone::{Cone, squared};
use super::limits::MAX_LIMITS;
use super::newton::{ConvexProblem, Motors, NewtonWorkspace, System, add_root_slope};
use super::rows::{CHAIN_WIDTH, add_point_stiffness};
use super::wrench::{InnerForce, RootWrench};
use crate::body::topology::{DOF_COUNT, NV, SEGMENT_COUNT};
use crate::math::{Mat3, Vec3};
use crate::report::MAX_CONTACTS;

/// Largest share of the distance to the boundary that a step may take.
pub(crate) const TO_BOUNDARY: f64 = 0.97;
/// Complementarity, as a share of that at the start, at which Newton's method takes over.
const DONE: f64 = 1e-8;
/// Multipliers at the start, in units of the prices of the linear problem. A far too large value wastes a few
/// iterations, but a too small one makes the method crawl along the boundary.
pub(crate) const FIRST_MULTIPLIER: f64 = 1e3;

/// A motor between its limits. The distance to each limit is stored separately, because near one of them the difference
/// of two values would have no digits left.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Inner {
    /// Distance to the lower and the upper limit, and their multipliers.
    s: [f64; 2],
    z: [f64; 2],
    /// Steps of the value and of the multipliers.
    dt: f64,
    dz: [f64; 2],
}

impl Inner {
    /// Starts in the middle, with multipliers of the size `size · widest / half` that suit the price `x`.
    #[inline(always)]
    pub(crate) fn begin(motors: &Motors, j: usize, x: f64, size: f64, widest: f64) -> Self {
        let half = 0.5 * (motors.upper[j] - motors.lower[j]);
        let t = motors.lower[j] + half;
        let v = t / motors.gain[j] - motors.rest[j] + x;
        let z = size * widest / half;
        Self {
            s: [half; 2],
            z: [v.max(0.0) + z, (-v).max(0.0) + z],
            ..Self::default()
        }
    }

    /// Its value.
    #[inline(always)]
    pub(crate) fn value(&self, motors: &Motors, j: usize) -> f64 {
        if self.s[0] < self.s[1] {
            motors.lower[j] + self.s[0]
        } else {
            motors.upper[j] - self.s[1]
        }
    }

    /// Its value after the step.
    #[inline(always)]
    pub(crate) fn next(&self, motors: &Motors, j: usize) -> f64 {
        self.value(motors, j) + self.dt
    }

    /// Both products of multiplier and distance.
    #[inline(always)]
    pub(crate) fn gap(&self) -> f64 {
        self.z[0] * self.s[0] + self.z[1] * self.s[1]
    }

    /// Eliminates the motor and returns its slope. Afterwards [`Self::next`] is its value at the present price, with
    /// the multipliers that the aim requires.
    #[inline(always)]
    pub(crate) fn eliminate(&mut self, motors: &Motors, j: usize, x: f64, aim: f64) -> f64 {
        let g = motors.gain[j];
        let s = self.s;
        let slope = 1.0 / (1.0 / g + self.z[0] / s[0] + self.z[1] / s[1]);
        let r = self.value(motors, j) / g - motors.rest[j] + x - aim / s[0] + aim / s[1];
        self.dt = -slope * r;
        slope
    }

    /// Its steps for a change `dx` of the price; the largest step ≤ `most` that keeps it inside.
    #[inline(always)]
    pub(crate) fn direct(&mut self, (slope, dx): (f64, f64), aim: f64, most: f64) -> f64 {
        self.dt -= slope * dx;
        let s = self.s;
        self.dz = [
            (aim - self.z[0] * self.dt) / s[0] - self.z[0],
            (aim + self.z[1] * self.dt) / s[1] - self.z[1],
        ];
        let mut step = most;
        for (value, change) in [
            (s[0], self.dt),
            (s[1], -self.dt),
            (self.z[0], self.dz[0]),
            (self.z[1], self.dz[1]),
        ] {
            if change < 0.0 {
                step = step.min(-value / change);
            }
        }
        step
    }

    #[inline(always)]
    pub(crate) fn advance(&mut self, step: f64) {
        self.s[0] += step * self.dt;
        self.s[1] -= step * self.dt;
        self.z[0] += step * self.dz[0];
        self.z[1] += step * self.dz[1];
    }
}

/// A joint limit, or stretched tissue: a force `q` that only pushes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Wall {
    pub(crate) q: f64,
    l: f64,
    pub(crate) dq: f64,
    dl: f64,
    pub(crate) slope: f64,
}

impl Wall {
    /// Force `widest`, multiplier `size` beyond the rate `v` (the allowed rate included).
    #[inline(always)]
    pub(crate) fn begin(v: f64, size: f64, widest: f64) -> Self {
        Self {
            q: widest,
            l: size + v.abs(),
            ..Self::default()
        }
    }

    /// Product of force and multiplier.
    #[inline(always)]
    pub(crate) fn gap(&self) -> f64 {
        self.q * self.l
    }

    /// Eliminates it, as a contact; `r` is the inverse of its stiffness.
    #[inline(always)]
    pub(crate) fn eliminate(&mut self, r: f64, v: f64, aim: f64) {
        self.slope = 1.0 / (r + self.l / self.q);
        self.dq = -self.slope * (r * self.q + v - aim / self.q);
    }

    /// Its steps for a change `dv` of the rate; the largest step ≤ `most` that keeps it inside.
    #[inline(always)]
    pub(crate) fn direct(&mut self, dv: f64, aim: f64, most: f64) -> f64 {
        self.dq -= self.slope * dv;
        self.dl = (aim - self.l * self.dq) / self.q - self.l;
        let mut step = most;
        for (value, change) in [(self.q, self.dq), (self.l, self.dl)] {
            if change < 0.0 {
                step = step.min(-value / change);
            }
        }
        step
    }

    #[inline(always)]
    pub(crate) fn advance(&mut self, step: f64) {
        self.q += step * self.dq;
        self.l += step * self.dl;
    }
}

/// Unknowns of the method: buffers, which the caller owns.
#[derive(Clone, Debug)]
pub struct Interior {
    pub(crate) motors: [Inner; DOF_COUNT],
    pub(crate) cones: Box<[Cone; MAX_CONTACTS]>,
    pub(crate) walls: [Wall; MAX_LIMITS],
    /// Moment and force on the root.
    pub(crate) wrench: [InnerForce; 2],
    /// Stiffness of each contact, world axes.
    pub(crate) stiffness: Box<[[[f64; 3]; 3]; MAX_CONTACTS]>,
}

impl Default for Interior {
    fn default() -> Self {
        Self {
            motors: [Inner::default(); DOF_COUNT],
            cones: Box::new([Cone::default(); MAX_CONTACTS]),
            walls: [Wall::default(); MAX_LIMITS],
            wrench: [InnerForce::default(); 2],
            stiffness: Box::new([[[0.0; 3]; 3]; MAX_CONTACTS]),
        }
    }
}

/// Transforms a velocity-like vector of a point from world axes to the cone's coordinates, those of its multiplier.
#[inline(always)]
pub(crate) fn to_cone(turn: Option<&Mat3>, mu: f64, v: Vec3) -> Vec3 {
    let v = turn.map_or(v, |t| t.transpose_mul(v));
    Vec3 { z: v.z / mu, ..v }
}

/// A force from the cone's coordinates to world axes.
#[inline(always)]
pub(crate) fn to_world(turn: Option<&Mat3>, mu: f64, f: Vec3) -> Vec3 {
    let f = Vec3 { z: f.z / mu, ..f };
    turn.map_or(f, |t| *t * f)
}

/// Complementarity at which the next step aims. It is larger after a step that a boundary stopped, so that the next
/// step leads back to the middle.
#[inline(always)]
pub(crate) fn aim(gap: f64, last_step: f64) -> f64 {
    match last_step {
        s if s > 0.9 => 0.03 * gap,
        s if s > 0.5 => 0.15 * gap,
        _ => 0.4 * gap,
    }
}

/// Leads `x` near the minimum from any start, in at most `iterations` iterations; returns the number of iterations.
/// Bounded work, no allocation. The problem has no joint limits.
///
/// Problem 14.2.
#[inline(always)]
pub(crate) fn approach<S: System>(
    problem: &ConvexProblem<'_, S>,
    iterations: u32,
    hessian: &mut S::Hessian,
    x: &mut [f64; NV],
    inner: &mut Interior,
    ws: &mut NewtonWorkspace,
) -> u32 {
    let ConvexProblem {
        system,
        b,
        motors,
        contacts,
        wrench,
        ..
    } = problem;
    // A ball without room holds nothing.
    let held = |part: usize| wrench.map(|w| &w.0[part]).filter(|ball| ball.most > 0.0);
    let n = contacts.points.len();
    let mu = contacts.friction;
    let NewtonWorkspace {
        force,
        velocity,
        direction,
        ..
    } = ws;
    let mut start = 0.0;
    let mut shorter = 1.0f64;
    let mut done = 0;
    // With all slopes at their largest, the problem is linear. It gives a first guess of the prices and of their size.
    x.fill(0.0);
    let mut ax = [0.0; NV];
    for round in 0..iterations {
        let first = round == 0;
        contacts.velocities(x, velocity);
        if round == 1 {
            // Start in the middle, with multipliers of the size of the prices.
            let mut size = 0.0;
            let half = |j: usize| 0.5 * (motors.upper[j] - motors.lower[j]);
            let widest = (0..DOF_COUNT).fold(0.0f64, |m, j| m.max(half(j)));
            for j in 0..DOF_COUNT {
                size += x[6 + j].abs() / DOF_COUNT as f64;
            }
            size = FIRST_MULTIPLIER * size.max(1e-9);
            for (j, m) in inner.motors.iter_mut().enumerate() {
                *m = Inner::begin(motors, j, x[6 + j], size, widest);
            }
            for (k, p) in contacts.points.iter().enumerate() {
                let v = to_cone(p.turn.as_ref(), mu, velocity[k] + p.c);
                inner.cones[k] = Cone::begin(v, size, widest);
            }
            for (part, f) in inner.wrench.iter_mut().enumerate() {
                if let Some(ball) = held(part) {
                    *f = InnerForce::begin(ball, size, widest);
                }
            }
        }
        // Complementarity, and the value at which the step aims.
        let (mut sum, mut count) = (0.0, 0.0);
        for m in &inner.motors {
            sum += m.gap();
            count += 2.0;
        }
        for c in &inner.cones[..n] {
            sum += c.gap();
            count += 1.0;
        }
        for (part, f) in inner.wrench.iter().enumerate() {
            if let Some(ball) = held(part) {
                sum += f.gap(ball);
                count += 1.0;
            }
        }
        let gap = if first { 0.0 } else { sum / count };
        let aim = aim(gap, shorter);
        // Residual of the dynamics, and the right-hand side with t and f eliminated.
        let mut rhs: [f64; NV] = std::array::from_fn(|i| b[i] - ax[i]);
        system.load(hessian);
        let mut slope = [0.0; DOF_COUNT];
        for (j, m) in inner.motors.iter_mut().enumerate() {
            let g = motors.gain[j];
            if first {
                slope[j] = g;
                rhs[6 + j] += g * motors.rest[j];
                continue;
            }
            slope[j] = m.eliminate(motors, j, x[6 + j], aim);
            rhs[6 + j] += m.next(motors, j);
        }
        for j in 0..DOF_COUNT {
            S::add(hessian, 6 + j, 6 + j, slope[j]);
        }
        for (part, f) in inner.wrench.iter_mut().enumerate() {
            let Some(ball) = held(part) else { continue };
            let next = if first {
                let free = |i, j| if i == j { ball.gain } else { 0.0 };
                f.slope = std::array::from_fn(|i| std::array::from_fn(|j| free(i, j)));
                ball.rest
            } else {
                f.eliminate(ball, RootWrench::seen(x, part), aim);
                f.next()
            };
            add_root_slope::<S>(hessian, part, &f.slope);
            for (i, w) in next.to_array().into_iter().enumerate() {
                rhs[3 * part + i] += w;
            }
        }
        let mut stiffness = [[[0.0; 6]; 6]; SEGMENT_COUNT];
        for (k, p) in contacts.points.iter().enumerate() {
            let turn = p.turn.as_ref();
            let r = 1.0 / p.inverse_r;
            let c = &mut inner.cones[k];
            let root = if first {
                force[k] = p.c * -p.inverse_r;
                [Vec3::X, Vec3::Y, Vec3::Z].map(|e| e * p.inverse_r.sqrt())
            } else {
                let root = c.eliminate(r, mu, to_cone(turn, mu, velocity[k] + p.c), aim);
                force[k] = to_world(turn, mu, c.next());
                root.map(|e| to_world(turn, mu, e))
            };
            add_point_stiffness(&mut stiffness[p.slot], p.r, &squared(&root));
        }
        contacts.add_transposed(force, 1.0, &mut rhs);
        for (slot, s) in contacts.segments.iter().enumerate() {
            let mut kj = [[0.0; CHAIN_WIDTH]; 6];
            for a in 0..6 {
                for c in 0..6 {
                    let y = stiffness[slot][a][c];
                    for i in 0..CHAIN_WIDTH {
                        kj[a][i] += y * s.jacobian[c][i];
                    }
                }
            }
            S::add_segment(hessian, s, &kj);
        }
        done = round + 1;
        if !S::solve(hessian, &mut rhs) {
            break;
        }
        let d = rhs;
        if first {
            *x = d;
            system.mul(x, &mut ax);
            continue;
        }
        // Steps of the other unknowns, and the largest step that keeps all inside.
        contacts.velocities(&d, direction);
        let mut step = 1.0 / TO_BOUNDARY;
        for (j, m) in inner.motors.iter_mut().enumerate() {
            step = m.direct((slope[j], d[6 + j]), aim, step);
        }
        for (k, p) in contacts.points.iter().enumerate() {
            let dv = to_cone(p.turn.as_ref(), mu, direction[k]);
            step = inner.cones[k].direct(dv, aim, step);
        }
        for (part, f) in inner.wrench.iter_mut().enumerate() {
            if let Some(ball) = held(part) {
                step = f.direct(ball, RootWrench::seen(&d, part), aim, step);
            }
        }
        let step = (TO_BOUNDARY * step).min(1.0);
        shorter = step;
        for m in &mut inner.motors {
            m.advance(step);
        }
        for c in &mut inner.cones[..n] {
            c.advance(step);
        }
        for (part, f) in inner.wrench.iter_mut().enumerate() {
            if held(part).is_some() {
                f.advance(step);
            }
        }
        for i in 0..NV {
            x[i] += step * d[i];
        }
        system.mul(x, &mut ax);
        if round == 1 {
            start = gap;
        }
        if step > 0.9 && gap < DONE * start {
            break;
        }
    }
    done
}
