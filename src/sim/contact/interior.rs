//! A way in for problems at which the semi-smooth Newton method jams: a primal-dual interior-point method on the same matrix.
//!
//! Where many motors and contacts lie far on the wrong side of their corners, an exact line search stops at the nearest corner, again and
//! again. Here motor values t and forces f are unknowns of their own that stay strictly inside their limits and cones, with multipliers that
//! tend to zero where t and f are free:
//!
//! ```text
//! A x − b − t − Jᵀf = 0      t/g − rest + x = z₁ − z₂,  z₁ (t − lower) = z₂ (upper − t) = μ      R f + J x + c = λ,  f ∘ λ = μ
//! ```
//!
//! Eliminating them leaves Newton's matrix with other slopes: `1/(1/g + z₁/(t − lower) + z₂/(upper − t))` for a motor and `(R + W⁻²)⁻¹` for a
//! contact, with the scaling W of Nesterov and Todd for second-order cones (Andersen, Dahl & Vandenberghe 2003). Newton's method finishes from the prices
//! that come out. The controller's problem has no joint limits; islands of bodies ([`crate::sim::collide::island`]) have them, as [`Wall`]s.

use super::limits::MAX_LIMITS;
use super::newton::{Motors, NewtonWorkspace, System};
use super::rows::{CHAIN_WIDTH, ContactRows, add_point_stiffness};
use crate::sim::body::topology::{DOF_COUNT, NV, SEGMENT_COUNT};
use crate::sim::figure::report::MAX_CONTACTS;
use crate::sim::math::{Mat3, Vec3};

/// Share of the way to the boundary that a step takes at most.
pub(crate) const TO_BOUNDARY: f64 = 0.97;
/// Complementarity, as a share of that at the start, at which Newton's method takes over.
const DONE: f64 = 1e-8;
/// Multipliers at the start, in units of the prices of the linear problem. Far too large is a few iterations lost, too small is a crawl along
/// the boundary.
pub(crate) const FIRST_MULTIPLIER: f64 = 1e3;

/// A motor between its limits.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Inner {
    pub(crate) t: f64,
    /// Multipliers of the lower and the upper limit.
    z: [f64; 2],
    /// Steps of all three.
    pub(crate) dt: f64,
    dz: [f64; 2],
}

impl Inner {
    /// In the middle, with multipliers of the size `size · widest / half` that suit the price `x`.
    #[inline(always)]
    pub(crate) fn begin(motors: &Motors, j: usize, x: f64, size: f64, widest: f64) -> Self {
        let half = 0.5 * (motors.upper[j] - motors.lower[j]);
        let t = motors.lower[j] + half;
        let v = t / motors.gain[j] - motors.rest[j] + x;
        let z = size * widest / half;
        Self {
            t,
            z: [v.max(0.0) + z, (-v).max(0.0) + z],
            ..Self::default()
        }
    }

    /// Both products of multiplier and distance.
    #[inline(always)]
    pub(crate) fn gap(&self, motors: &Motors, j: usize) -> f64 {
        self.z[0] * (self.t - motors.lower[j]) + self.z[1] * (motors.upper[j] - self.t)
    }

    /// Eliminates it: its slope; `t + dt` is its value at the present price, with the multipliers that the aim asks for.
    #[inline(always)]
    pub(crate) fn eliminate(&mut self, motors: &Motors, j: usize, x: f64, aim: f64) -> f64 {
        let g = motors.gain[j];
        let s = [self.t - motors.lower[j], motors.upper[j] - self.t];
        let slope = 1.0 / (1.0 / g + self.z[0] / s[0] + self.z[1] / s[1]);
        let r = self.t / g - motors.rest[j] + x - aim / s[0] + aim / s[1];
        self.dt = -slope * r;
        slope
    }

    /// Its steps for a change `dx` of the price; the largest step ≤ `most` that keeps it inside.
    #[inline(always)]
    pub(crate) fn direct(
        &mut self,
        motors: &Motors,
        j: usize,
        (slope, dx): (f64, f64),
        aim: f64,
        most: f64,
    ) -> f64 {
        self.dt -= slope * dx;
        let s = [self.t - motors.lower[j], motors.upper[j] - self.t];
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
        self.t += step * self.dt;
        self.z[0] += step * self.dz[0];
        self.z[1] += step * self.dz[1];
    }
}

/// A contact in its cone. Coordinates in which the cone is `|(x, y)| ≤ z` and its own dual: normal force times μ, normal velocity over μ.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cone {
    pub(crate) f: Vec3,
    l: Vec3,
    pub(crate) df: Vec3,
    dl: Vec3,
}

impl Cone {
    /// On the axis: force `widest`, multiplier `size` beyond the velocity `v`.
    #[inline(always)]
    pub(crate) fn begin(v: Vec3, size: f64, widest: f64) -> Self {
        Self {
            f: Vec3::Z * widest,
            l: Vec3::Z * (size + v.norm()),
            ..Self::default()
        }
    }

    /// Product of force and multiplier.
    #[inline(always)]
    pub(crate) fn gap(&self) -> f64 {
        self.f.dot(self.l)
    }

    /// Eliminates it: its stiffness in the cone's coordinates; `f + df` is its force at the velocity `v` (offset included).
    #[inline(always)]
    pub(crate) fn eliminate(&mut self, r: f64, mu: f64, v: Vec3, aim: f64) -> [[f64; 3]; 3] {
        let mut q = [[0.0; 3]; 3];
        (q[0][0], q[1][1], q[2][2]) = (r, r, r / (mu * mu));
        let w = scaling(self.f, self.l);
        let residual = times(&q, self.f) + v - mirrored(self.f) * (aim / square(self.f));
        for a in 0..3 {
            for b in 0..3 {
                q[a][b] += w[a][b];
            }
        }
        let h = inverse(&q);
        self.df = times(&h, residual) * -1.0;
        h
    }

    /// Its steps for a change `dv` of the velocity; the largest step ≤ `most` that keeps it inside.
    #[inline(always)]
    pub(crate) fn direct(&mut self, r: f64, mu: f64, dv: Vec3, aim: f64, most: f64) -> f64 {
        let w = scaling(self.f, self.l);
        let mut q = w;
        q[0][0] += r;
        q[1][1] += r;
        q[2][2] += r / (mu * mu);
        self.df -= times(&inverse(&q), dv);
        self.dl = mirrored(self.f) * (aim / square(self.f)) - self.l - times(&w, self.df);
        let step = way_to_boundary(self.f, self.df, most);
        way_to_boundary(self.l, self.dl, step)
    }

    #[inline(always)]
    pub(crate) fn advance(&mut self, step: f64) {
        self.f += self.df * step;
        self.l += self.dl * step;
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
    /// Force `widest`, multiplier `size` beyond the rate `v` (what is allowed included).
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

/// Unknowns of the method.
#[derive(Clone, Debug)]
pub(crate) struct Interior {
    pub(crate) motors: [Inner; DOF_COUNT],
    pub(crate) cones: Box<[Cone; MAX_CONTACTS]>,
    pub(crate) walls: [Wall; MAX_LIMITS],
    /// Stiffness of each contact, world axes.
    pub(crate) stiffness: Box<[[[f64; 3]; 3]; MAX_CONTACTS]>,
}

impl Default for Interior {
    fn default() -> Self {
        Self {
            motors: [Inner::default(); DOF_COUNT],
            cones: Box::new([Cone::default(); MAX_CONTACTS]),
            walls: [Wall::default(); MAX_LIMITS],
            stiffness: Box::new([[[0.0; 3]; 3]; MAX_CONTACTS]),
        }
    }
}

/// `z² − x² − y²`.
#[inline(always)]
fn square(a: Vec3) -> f64 {
    a.z * a.z - a.x * a.x - a.y * a.y
}

/// Mirrored in the axis.
#[inline(always)]
fn mirrored(a: Vec3) -> Vec3 {
    Vec3 {
        x: -a.x,
        y: -a.y,
        z: a.z,
    }
}

/// Largest step ≤ `most` with which `a + step·d` stays in the cone.
#[inline(always)]
fn way_to_boundary(a: Vec3, d: Vec3, most: f64) -> f64 {
    // q0 + 2 q1 s + q2 s² is positive at 0; the cone is left at its first positive root, or where z changes sign.
    let (q0, q1, q2) = (square(a), a.z * d.z - a.x * d.x - a.y * d.y, square(d));
    let disc = q1 * q1 - q0 * q2;
    let mut s = most;
    if disc >= 0.0 {
        let r = disc.sqrt();
        // Both roots without cancellation.
        let big = if q1 >= 0.0 { -(q1 + r) } else { r - q1 };
        for root in [q0 / big, big / q2] {
            if root > 0.0 && root < s {
                s = root;
            }
        }
    }
    if d.z < 0.0 {
        s = s.min(-a.z / d.z);
    }
    s
}

/// `W⁻²`: maps f to λ, symmetric positive definite.
#[inline(always)]
fn scaling(f: Vec3, l: Vec3) -> [[f64; 3]; 3] {
    let (sf, sl) = (square(f).max(1e-300).sqrt(), square(l).max(1e-300).sqrt());
    let (fb, lb) = (f * (1.0 / sf), l * (1.0 / sl));
    let gamma = (0.5 * (1.0 + fb.dot(lb))).sqrt();
    // J w.
    let w = (mirrored(fb) + lb) * (0.5 / gamma);
    let (w, k) = (w.to_array(), sl / sf);
    let mut out = [[0.0; 3]; 3];
    for a in 0..3 {
        for b in 0..3 {
            out[a][b] = 2.0 * k * w[a] * w[b];
        }
        out[a][a] += if a == 2 { -k } else { k };
    }
    out
}

/// Inverse of a symmetric positive definite matrix.
#[inline(always)]
fn inverse(m: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let c = |a: usize, b: usize, d: usize, e: usize| m[a][d] * m[b][e] - m[a][e] * m[b][d];
    let (x, y, z) = (c(1, 2, 1, 2), c(1, 2, 2, 0), c(1, 2, 0, 1));
    let k = 1.0 / (m[0][0] * x + m[0][1] * y + m[0][2] * z);
    let mut out = [[x, y, z], [0.0; 3], [0.0; 3]];
    out[1] = [y, c(0, 2, 0, 2), c(0, 2, 1, 0)];
    out[2] = [z, out[1][2], c(0, 1, 0, 1)];
    out.map(|row| row.map(|v| v * k))
}

#[inline(always)]
fn times(m: &[[f64; 3]; 3], v: Vec3) -> Vec3 {
    let v = v.to_array();
    Vec3::from_array([0, 1, 2].map(|i| m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2]))
}

/// Point `k`'s velocity-like vector from world axes to the cone's coordinates, where a multiplier lives.
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

/// A stiffness from the cone's coordinates to world axes.
#[inline(always)]
pub(crate) fn world_stiffness(turn: Option<&Mat3>, mu: f64, h: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let axes = turn.map_or([Vec3::X, Vec3::Y, Vec3::Z], |t| [t.x, t.y, t.z]);
    let axes = [axes[0], axes[1], axes[2] * (1.0 / mu)].map(Vec3::to_array);
    let mut d = [[0.0; 3]; 3];
    for (i, a) in axes.iter().enumerate() {
        for (j, e) in axes.iter().enumerate() {
            for row in 0..3 {
                for column in 0..3 {
                    d[row][column] += a[row] * h[i][j] * e[column];
                }
            }
        }
    }
    d
}

/// Complementarity that the next step aims at. Whoever was stopped by a boundary first gets back to the middle.
#[inline(always)]
pub(crate) fn aim(gap: f64, last_step: f64) -> f64 {
    match last_step {
        s if s > 0.9 => 0.03 * gap,
        s if s > 0.5 => 0.15 * gap,
        _ => 0.4 * gap,
    }
}

/// Leads `x` near the minimum, wherever it was, in at most `iterations` iterations; returns how many there were. Bounded work, no allocation.
#[inline(always)]
pub(crate) fn approach<S: System>(
    system: &S,
    hessian: &mut S::Hessian,
    b: &[f64; NV],
    motors: &Motors,
    contacts: &ContactRows,
    iterations: u32,
    x: &mut [f64; NV],
    ws: &mut NewtonWorkspace,
) -> u32 {
    let n = contacts.points.len();
    let mu = contacts.friction;
    let NewtonWorkspace {
        interior: inner,
        force,
        velocity,
        direction,
        ..
    } = ws;
    let mut start = 0.0;
    let mut shorter = 1.0f64;
    let mut done = 0;
    // With all slopes at their largest the problem is linear: a first guess of the prices, and of their size.
    x.fill(0.0);
    let mut ax = [0.0; NV];
    for round in 0..iterations {
        let first = round == 0;
        contacts.velocities(x, velocity);
        if round == 1 {
            // Middle of everything, multipliers of the size of the prices.
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
        }
        // Complementarity, and what the step aims at.
        let (mut sum, mut count) = (0.0, 0.0);
        for (j, m) in inner.motors.iter().enumerate() {
            sum += m.gap(motors, j);
            count += 2.0;
        }
        for c in &inner.cones[..n] {
            sum += c.gap();
            count += 1.0;
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
            rhs[6 + j] += m.t + m.dt;
        }
        for j in 0..DOF_COUNT {
            S::add(hessian, 6 + j, 6 + j, slope[j]);
        }
        let mut stiffness = [[[0.0; 6]; 6]; SEGMENT_COUNT];
        for (k, p) in contacts.points.iter().enumerate() {
            let turn = p.turn.as_ref();
            let r = 1.0 / p.inverse_r;
            let c = &mut inner.cones[k];
            let h = if first {
                let mut q = [[0.0; 3]; 3];
                (q[0][0], q[1][1], q[2][2]) = (r, r, r / (mu * mu));
                let h = inverse(&q);
                c.df = times(&h, to_cone(turn, mu, p.c)) * -1.0;
                c.f = Vec3::zero();
                h
            } else {
                c.eliminate(r, mu, to_cone(turn, mu, velocity[k] + p.c), aim)
            };
            force[k] = to_world(turn, mu, c.f + c.df);
            let d = world_stiffness(turn, mu, &h);
            add_point_stiffness(&mut stiffness[p.slot], p.r, &d);
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
        // Steps of the rest, and how far all may go.
        contacts.velocities(&d, direction);
        let mut step = 1.0 / TO_BOUNDARY;
        for (j, m) in inner.motors.iter_mut().enumerate() {
            step = m.direct(motors, j, (slope[j], d[6 + j]), aim, step);
        }
        for (k, p) in contacts.points.iter().enumerate() {
            let dv = to_cone(p.turn.as_ref(), mu, direction[k]);
            step = inner.cones[k].direct(1.0 / p.inverse_r, mu, dv, aim, step);
        }
        let step = (TO_BOUNDARY * step).min(1.0);
        shorter = step;
        for m in &mut inner.motors {
            m.advance(step);
        }
        for c in &mut inner.cones[..n] {
            c.advance(step);
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
