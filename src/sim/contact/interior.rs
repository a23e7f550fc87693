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
//! contact, with the scaling W of Nesterov and Todd for second-order cones (Andersen, Dahl & Vandenberghe 2003). Joint limits have no part in
//! it: the controller's problem has none. Newton's method finishes from the prices that come out.

use super::newton::{Motors, NewtonWorkspace, System};
use super::rows::{ContactRows, PointRow, add_point_stiffness};
use crate::sim::body::topology::{DOF_COUNT, NV, SEGMENT_COUNT};
use crate::sim::figure::report::MAX_CONTACTS;
use crate::sim::math::{Mat3, Vec3};

/// Share of the way to the boundary that a step takes at most.
const TO_BOUNDARY: f64 = 0.97;
/// Complementarity, as a share of that at the start, at which Newton's method takes over.
const DONE: f64 = 1e-8;
/// Multipliers at the start, in units of the prices of the linear problem. Far too large is a few iterations lost, too small is a crawl along
/// the boundary.
const FIRST_MULTIPLIER: f64 = 1e3;

/// A motor between its limits.
#[derive(Clone, Copy, Debug, Default)]
struct Inner {
    t: f64,
    /// Multipliers of the lower and the upper limit.
    z: [f64; 2],
    /// Steps of all three.
    dt: f64,
    dz: [f64; 2],
}

/// A contact in its cone. Coordinates in which the cone is `|(x, y)| ≤ z` and its own dual: normal force times μ, normal velocity over μ.
#[derive(Clone, Copy, Debug, Default)]
struct Cone {
    f: Vec3,
    l: Vec3,
    df: Vec3,
    dl: Vec3,
}

/// Unknowns of the method.
#[derive(Clone, Debug)]
pub(crate) struct Interior {
    motors: [Inner; DOF_COUNT],
    cones: Box<[Cone; MAX_CONTACTS]>,
}

impl Default for Interior {
    fn default() -> Self {
        Self {
            motors: [Inner::default(); DOF_COUNT],
            cones: Box::new([Cone::default(); MAX_CONTACTS]),
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

/// A velocity-like vector from world axes to the coordinates of the cone, where a multiplier lives.
#[inline(always)]
fn to_cone(turn: Option<&Mat3>, mu: f64, v: Vec3) -> Vec3 {
    let v = turn.map_or(v, |t| t.transpose_mul(v));
    Vec3 { z: v.z / mu, ..v }
}

/// A force from the cone's coordinates to world axes.
#[inline(always)]
fn to_world(turn: Option<&Mat3>, mu: f64, f: Vec3) -> Vec3 {
    let f = Vec3 { z: f.z / mu, ..f };
    turn.map_or(f, |t| *t * f)
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
            inner.start(motors, contacts, x, velocity);
        }
        let gap = if first { 0.0 } else { inner.gap(motors, n) };
        // Whoever was stopped by a boundary first gets back to the middle.
        let aim = match shorter {
            s if s > 0.9 => 0.03 * gap,
            s if s > 0.5 => 0.15 * gap,
            _ => 0.4 * gap,
        };
        // Residual of the dynamics, and the right-hand side with t and f eliminated.
        let mut rhs: [f64; NV] = std::array::from_fn(|i| b[i] - ax[i]);
        system.load(hessian);
        let slope = if first {
            std::array::from_fn(|j| {
                rhs[6 + j] += motors.gain[j] * motors.rest[j];
                motors.gain[j]
            })
        } else {
            inner.eliminate_motors(motors, aim, x, &mut rhs)
        };
        for j in 0..DOF_COUNT {
            S::add(hessian, 6 + j, 6 + j, slope[j]);
        }
        let mut stiffness = [[[0.0; 6]; 6]; SEGMENT_COUNT];
        for (k, p) in contacts.points.iter().enumerate() {
            let c = &mut inner.cones[k];
            let (f, d) = if first {
                c.guess(p, contacts.friction)
            } else {
                c.eliminate(p, contacts.friction, aim, velocity[k])
            };
            force[k] = f;
            add_point_stiffness(&mut stiffness[p.slot], p.r, &d);
        }
        contacts.add_transposed(force, 1.0, &mut rhs);
        for (slot, s) in contacts.segments.iter().enumerate() {
            S::add_segment(hessian, s, &s.stiffened(&stiffness[slot]));
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
        contacts.velocities(&d, direction);
        let way = inner.complete_step(motors, contacts, aim, &slope, &d, direction);
        let step = (TO_BOUNDARY * way).min(1.0);
        shorter = step;
        inner.go(step, n);
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

impl Interior {
    /// Begins in the middle of everything, with multipliers of the size of the prices `x`; `velocity` is `J x`.
    #[inline(always)]
    fn start(
        &mut self,
        motors: &Motors,
        contacts: &ContactRows,
        x: &[f64; NV],
        velocity: &[Vec3; MAX_CONTACTS],
    ) {
        let mut size = 0.0;
        let half = |j: usize| 0.5 * (motors.upper[j] - motors.lower[j]);
        let widest = (0..DOF_COUNT).fold(0.0f64, |m, j| m.max(half(j)));
        for j in 0..DOF_COUNT {
            size += x[6 + j].abs() / DOF_COUNT as f64;
        }
        size = FIRST_MULTIPLIER * size.max(1e-9);
        for (j, m) in self.motors.iter_mut().enumerate() {
            let t = motors.lower[j] + half(j);
            let v = t / motors.gain[j] - motors.rest[j] + x[6 + j];
            let z = size * widest / half(j);
            *m = Inner {
                t,
                z: [v.max(0.0) + z, (-v).max(0.0) + z],
                ..Inner::default()
            };
        }
        for (k, p) in contacts.points.iter().enumerate() {
            let v = to_cone(p.turn.as_ref(), contacts.friction, velocity[k] + p.c);
            self.cones[k] = Cone {
                f: Vec3::Z * widest,
                l: Vec3::Z * (size + v.norm()),
                ..Cone::default()
            };
        }
    }

    /// Mean complementarity of the motors and the first `n` contacts.
    #[inline(always)]
    fn gap(&self, motors: &Motors, n: usize) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for (j, m) in self.motors.iter().enumerate() {
            sum += m.z[0] * (m.t - motors.lower[j]) + m.z[1] * (motors.upper[j] - m.t);
            count += 2.0;
        }
        for c in &self.cones[..n] {
            sum += c.f.dot(c.l);
            count += 1.0;
        }
        sum / count
    }

    /// Takes the motor values out of the equations: adds what they give to `rhs`, returns their slopes on `x`. Leaves in each motor the part
    /// of its step that does not depend on that of `x`.
    #[inline(always)]
    fn eliminate_motors(
        &mut self,
        motors: &Motors,
        aim: f64,
        x: &[f64; NV],
        rhs: &mut [f64; NV],
    ) -> [f64; DOF_COUNT] {
        let mut slope = [0.0; DOF_COUNT];
        for (j, m) in self.motors.iter_mut().enumerate() {
            let g = motors.gain[j];
            let s = [m.t - motors.lower[j], motors.upper[j] - m.t];
            slope[j] = 1.0 / (1.0 / g + m.z[0] / s[0] + m.z[1] / s[1]);
            // dt = slope (−r − dx), r with the multipliers that the aim asks for.
            let r = m.t / g - motors.rest[j] + x[6 + j] - aim / s[0] + aim / s[1];
            m.dt = -slope[j] * r;
            rhs[6 + j] += m.t + m.dt;
        }
        slope
    }

    /// Steps of motors, contacts and their multipliers for the step `d` of `x`, `direction = J d`; returns how much of it can be gone until the
    /// first of them meets a boundary.
    #[inline(always)]
    fn complete_step(
        &mut self,
        motors: &Motors,
        contacts: &ContactRows,
        aim: f64,
        slope: &[f64; DOF_COUNT],
        d: &[f64; NV],
        direction: &[Vec3; MAX_CONTACTS],
    ) -> f64 {
        let mut step = 1.0 / TO_BOUNDARY;
        for (j, m) in self.motors.iter_mut().enumerate() {
            m.dt -= slope[j] * d[6 + j];
            let s = [m.t - motors.lower[j], motors.upper[j] - m.t];
            m.dz = [
                (aim - m.z[0] * m.dt) / s[0] - m.z[0],
                (aim + m.z[1] * m.dt) / s[1] - m.z[1],
            ];
            for (value, change) in [
                (s[0], m.dt),
                (s[1], -m.dt),
                (m.z[0], m.dz[0]),
                (m.z[1], m.dz[1]),
            ] {
                if change < 0.0 {
                    step = step.min(-value / change);
                }
            }
        }
        let mu = contacts.friction;
        for (k, p) in contacts.points.iter().enumerate() {
            let c = &mut self.cones[k];
            let w = scaling(c.f, c.l);
            let q = with_regularisation(w, p, mu);
            c.df -= times(&inverse(&q), to_cone(p.turn.as_ref(), mu, direction[k]));
            c.dl = mirrored(c.f) * (aim / square(c.f)) - c.l - times(&w, c.df);
            step = way_to_boundary(c.f, c.df, step);
            step = way_to_boundary(c.l, c.dl, step);
        }
        step
    }

    /// Goes a share of the step, with the first `n` contacts.
    #[inline(always)]
    fn go(&mut self, step: f64, n: usize) {
        for m in &mut self.motors {
            m.t += step * m.dt;
            m.z[0] += step * m.dz[0];
            m.z[1] += step * m.dz[1];
        }
        for c in &mut self.cones[..n] {
            c.f += c.df * step;
            c.l += c.dl * step;
        }
    }
}

impl Cone {
    /// Force of point `p` and its slope, in world axes, as if it could push and pull in every direction.
    #[inline(always)]
    fn guess(&mut self, p: &PointRow, mu: f64) -> (Vec3, [[f64; 3]; 3]) {
        let turn = p.turn.as_ref();
        let h = inverse(&with_regularisation([[0.0; 3]; 3], p, mu));
        self.df = times(&h, to_cone(turn, mu, p.c)) * -1.0;
        self.f = Vec3::zero();
        (
            to_world(turn, mu, self.f + self.df),
            slope_to_world(turn, mu, &h),
        )
    }

    /// The same with the scaling of the present force and multiplier: what the force is to be when `x` stays, and how it depends on `x`.
    /// `velocity` is that of the point.
    #[inline(always)]
    fn eliminate(
        &mut self,
        p: &PointRow,
        mu: f64,
        aim: f64,
        velocity: Vec3,
    ) -> (Vec3, [[f64; 3]; 3]) {
        let turn = p.turn.as_ref();
        let v = to_cone(turn, mu, velocity + p.c);
        let residual = times(&with_regularisation([[0.0; 3]; 3], p, mu), self.f) + v
            - mirrored(self.f) * (aim / square(self.f));
        let h = inverse(&with_regularisation(scaling(self.f, self.l), p, mu));
        self.df = times(&h, residual) * -1.0;
        (
            to_world(turn, mu, self.f + self.df),
            slope_to_world(turn, mu, &h),
        )
    }
}

/// `m + R` of point `p` in the coordinates of its cone.
#[inline(always)]
fn with_regularisation(mut m: [[f64; 3]; 3], p: &PointRow, mu: f64) -> [[f64; 3]; 3] {
    let r = 1.0 / p.inverse_r;
    m[0][0] += r;
    m[1][1] += r;
    m[2][2] += r / (mu * mu);
    m
}

/// A slope of forces on velocities from the coordinates of the cone to world axes, on both sides.
#[inline(always)]
fn slope_to_world(turn: Option<&Mat3>, mu: f64, h: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
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
