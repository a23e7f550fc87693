//! Semi-smooth Newton method with exact line search, warm start and a bound on its work (`docs/equations.md`, 14.2).

use super::limits::{LimitRows, MAX_LIMITS};
use super::projection::Region;
use super::rows::{CHAIN_WIDTH, ContactRows, SegmentRows, add_point_stiffness};
use super::wrench::{CutForce, RootWrench};
use crate::body::topology::{DOF_COUNT, NV, SEGMENT_COUNT};
use crate::math::Vec3;
use crate::report::MAX_CONTACTS;

/// The quadratic part of the problem, and the matrix with which Newton steps are solved.
pub trait System {
    /// Storage of `A + …` and of its factor.
    type Hessian;
    /// `y = A x`.
    fn mul(&self, x: &[f64; NV], y: &mut [f64; NV]);
    /// `g = A`.
    fn load(&self, g: &mut Self::Hessian);
    /// Adds to entry (i, j), i ≥ j, of the lower triangle.
    fn add(g: &mut Self::Hessian, i: usize, j: usize, x: f64);
    /// Adds `Jᵀ(K J)` of one segment; `kj` is `K J`.
    fn add_segment(g: &mut Self::Hessian, s: &SegmentRows, kj: &[[f64; CHAIN_WIDTH]; 6]);
    /// Factors `g` and solves in place; false if it is not positive definite.
    fn solve(g: &mut Self::Hessian, x: &mut [f64; NV]) -> bool;
}

/// The convex problem of `docs/equations.md`, 14: ½ xᵀA x − bᵀx + motors + limits + contacts + wrench.
#[derive(Debug)]
pub struct ConvexProblem<'a, S> {
    /// A.
    pub system: S,
    /// b.
    pub b: &'a [f64; NV],
    /// Motors.
    pub motors: &'a Motors,
    /// Joint limits.
    pub limits: &'a LimitRows,
    /// Contacts.
    pub contacts: &'a ContactRows,
    /// Wrench on the root, if there is one.
    pub wrench: Option<&'a RootWrench>,
}

/// When a minimisation ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopRule {
    /// Largest number of iterations.
    pub iterations: u32,
    /// Residual at which the problem counts as solved, in the units of b.
    pub tolerance: f64,
}

/// Saturating springs on the 39 joint components: `t_j = clip(g_j (r_j − x_j), lower_j, upper_j)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Motors {
    /// Gain.
    pub gain: [f64; DOF_COUNT],
    /// Rest value.
    pub rest: [f64; DOF_COUNT],
    /// Least value.
    pub lower: [f64; DOF_COUNT],
    /// Largest value.
    pub upper: [f64; DOF_COUNT],
}

impl Default for Motors {
    fn default() -> Self {
        let z = [0.0; DOF_COUNT];
        Self {
            gain: z,
            rest: z,
            lower: z,
            upper: z,
        }
    }
}

impl Motors {
    /// Value and slope at `x`.
    #[inline(always)]
    pub(crate) fn value(&self, j: usize, x: f64) -> (f64, f64) {
        let t = self.gain[j] * (self.rest[j] - x);
        if t > self.upper[j] {
            (self.upper[j], 0.0)
        } else if t < self.lower[j] {
            (self.lower[j], 0.0)
        } else {
            (t, self.gain[j])
        }
    }
}

/// Forces of the last iterate; they respect strength and friction whatever the residual.
#[derive(Clone, Debug)]
pub struct NewtonWorkspace {
    /// Motor values `t`.
    pub motor: [f64; DOF_COUNT],
    /// Limit impulses mapped to the joint components.
    pub limit: [f64; DOF_COUNT],
    /// Contact forces, one per point.
    pub force: Box<[Vec3; MAX_CONTACTS]>,
    /// Moment and force of the wrench on the root.
    pub(crate) wrench: [CutForce; 2],
    pub(crate) velocity: Box<[Vec3; MAX_CONTACTS]>,
    pub(crate) direction: Box<[Vec3; MAX_CONTACTS]>,
    /// Rates of the limit rows at the start of a line search, and along it.
    ways: Box<[[f64; 2]; MAX_LIMITS]>,
    pub(crate) region: Box<[Region; MAX_CONTACTS]>,
}

impl Default for NewtonWorkspace {
    fn default() -> Self {
        let z = || Box::new([Vec3::zero(); MAX_CONTACTS]);
        Self {
            motor: [0.0; DOF_COUNT],
            limit: [0.0; DOF_COUNT],
            force: z(),
            wrench: [CutForce::default(); 2],
            velocity: z(),
            direction: z(),
            ways: Box::new([[0.0; 2]; MAX_LIMITS]),
            region: Box::new([Region::Open; MAX_CONTACTS]),
        }
    }
}

impl NewtonWorkspace {
    /// Prepares a line search from `x` along `d`; the velocities of the contacts at `x` are known.
    #[inline(always)]
    pub(crate) fn aim(
        &mut self,
        limits: &LimitRows,
        contacts: &ContactRows,
        [x, d]: [&[f64; NV]; 2],
    ) {
        contacts.velocities(d, &mut self.direction);
        for (row, way) in limits.rows.iter().zip(self.ways.iter_mut()) {
            *way = [row.rate(x), row.rate(d)];
        }
    }

    /// `z` minus the forces of motors, limits and contacts along `d` at `x + a d`, after [`Self::aim`].
    #[inline(always)]
    pub(crate) fn less_given(
        &self,
        (mut z, a): (f64, f64),
        motors: &Motors,
        limits: &LimitRows,
        contacts: &ContactRows,
        [x, d]: [&[f64; NV]; 2],
    ) -> f64 {
        for j in 0..DOF_COUNT {
            z -= d[6 + j] * motors.value(j, x[6 + j] + a * d[6 + j]).0;
        }
        for (row, [rate, r]) in limits.rows.iter().zip(self.ways.iter()) {
            if *r != 0.0 {
                z -= r * row.impulse(rate + a * r);
            }
        }
        for k in 0..contacts.points.len() {
            let (f, _) = contacts.force(k, self.velocity[k] + self.direction[k] * a);
            z -= self.direction[k].dot(f);
        }
        z
    }
}

/// How a solve ended.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SolveOutcome {
    /// Newton iterations.
    pub iterations: u32,
    /// Largest component of the remaining gradient.
    pub residual: f64,
    /// Residual below the tolerance.
    pub converged: bool,
}

/// Largest entry of a gradient, or length of its part on the root's angular or linear velocity: these are in world
/// axes, and the stop rule must not depend on the direction of north. NaN entries are ignored, because such states are
/// detected where they are stored.
pub(crate) fn largest(gradient: &[f64; NV]) -> f64 {
    let length = |g: &[f64]| g.iter().map(|x| x * x).sum::<f64>().sqrt();
    let root = 0f64
        .max(length(&gradient[..3]))
        .max(length(&gradient[3..6]));
    gradient[6..].iter().fold(root, |m, g| m.max(g.abs()))
}

/// Largest number of evaluations in one line search.
const LINE_SEARCH: usize = 12;

/// Minimises the problem from `x`, which holds the last iterate afterwards. Bounded work, no allocation.
///
/// * `hessian`: storage of Newton's matrix and its factor.
/// * `ws`: holds the forces of the last iterate afterwards.
///
/// The residual is in the units of b.
///
/// Problem 14.2.
#[inline(always)]
pub fn minimise<S: System>(
    problem: &ConvexProblem<'_, S>,
    stop: StopRule,
    hessian: &mut S::Hessian,
    x: &mut [f64; NV],
    ws: &mut NewtonWorkspace,
) -> SolveOutcome {
    let ConvexProblem {
        system,
        b,
        motors,
        limits,
        contacts,
        wrench,
    } = problem;
    let n = contacts.points.len();
    let mut ax = [0.0; NV];
    system.mul(x, &mut ax);
    contacts.velocities(x, &mut ws.velocity);
    let mut out = SolveOutcome::default();
    loop {
        let (grad, slope) = gradient(problem, &ax, x, ws);
        out.residual = largest(&grad);
        out.converged = out.residual < stop.tolerance;
        if out.converged || out.iterations >= stop.iterations || !out.residual.is_finite() {
            return out;
        }
        out.iterations += 1;

        system.load(hessian);
        add_slopes(problem, &slope, x, ws, hessian);
        let mut d: [f64; NV] = std::array::from_fn(|i| -grad[i]);
        if !S::solve(hessian, &mut d) {
            return out;
        }

        // φ'(a) = dᵀ∇(x + a d) is monotone; its quadratic part is q0 + a q1.
        let mut ad = [0.0; NV];
        system.mul(&d, &mut ad);
        ws.aim(limits, contacts, [x, &d]);
        let (mut q0, mut q1, mut slope0) = (0.0, 0.0, 0.0);
        for i in 0..NV {
            q0 += d[i] * (ax[i] - b[i]);
            q1 += d[i] * ad[i];
            slope0 += d[i] * grad[i];
        }
        let mut search = LineSearch::new(slope0, LINE_SEARCH);
        loop {
            let (a, line) = (search.step, [&*x, &d]);
            let mut slope = ws.less_given((q0 + a * q1, a), motors, limits, contacts, line);
            if let Some(wrench) = wrench {
                slope -= wrench.along(x, &d, a);
            }
            if search.ends_at(slope) {
                break;
            }
        }
        let a = search.step;
        for i in 0..NV {
            x[i] += a * d[i];
            ax[i] += a * ad[i];
        }
        for k in 0..n {
            ws.velocity[k] += ws.direction[k] * a;
        }
    }
}

/// Gradient `A x − b − t − limits − Jᵀf`, and the slope of each motor; the forces of motors, limits and contacts go to
/// `ws`.
#[inline(always)]
fn gradient<S>(
    problem: &ConvexProblem<'_, S>,
    ax: &[f64; NV],
    x: &[f64; NV],
    ws: &mut NewtonWorkspace,
) -> ([f64; NV], [f64; DOF_COUNT]) {
    let ConvexProblem {
        b,
        motors,
        limits,
        contacts,
        wrench,
        ..
    } = problem;
    let mut grad = [0.0; NV];
    let mut slope = [0.0; DOF_COUNT];
    for i in 0..6 {
        grad[i] = ax[i] - b[i];
    }
    if let Some(wrench) = wrench {
        for (part, ball) in wrench.0.iter().enumerate() {
            ws.wrench[part] = ball.value(RootWrench::seen(x, part));
            for (i, f) in ws.wrench[part].force.to_array().into_iter().enumerate() {
                grad[3 * part + i] -= f;
            }
        }
    }
    for j in 0..DOF_COUNT {
        let (t, s) = motors.value(j, x[6 + j]);
        ws.motor[j] = t;
        slope[j] = s;
        grad[6 + j] = ax[6 + j] - b[6 + j] - t;
    }
    ws.limit.fill(0.0);
    for row in &limits.rows {
        let p = row.impulse(row.rate(x));
        if p > 0.0 {
            for k in 0..row.len {
                ws.limit[row.first - 6 + k] += p * row.coefficients[k];
            }
        }
    }
    for j in 0..DOF_COUNT {
        grad[6 + j] -= ws.limit[j];
    }
    for k in 0..contacts.points.len() {
        (ws.force[k], ws.region[k]) = contacts.force(k, ws.velocity[k]);
    }
    contacts.add_transposed(&ws.force, -1.0, &mut grad);
    (grad, slope)
}

/// Makes `A` the Newton matrix: adds the slopes of motors, limits and contacts at the point of the last gradient.
#[inline(always)]
fn add_slopes<S: System>(
    problem: &ConvexProblem<'_, S>,
    slope: &[f64; DOF_COUNT],
    x: &[f64; NV],
    ws: &NewtonWorkspace,
    hessian: &mut S::Hessian,
) {
    let ConvexProblem {
        limits,
        contacts,
        wrench,
        ..
    } = problem;
    for j in 0..DOF_COUNT {
        S::add(hessian, 6 + j, 6 + j, slope[j]);
    }
    if let Some(wrench) = wrench {
        for (part, ball) in wrench.0.iter().enumerate() {
            add_root_slope::<S>(hessian, part, &ball.slope(ws.wrench[part]));
        }
    }
    for row in &limits.rows {
        if row.rate(x) < -row.allowed {
            for i in 0..row.len {
                for j in 0..=i {
                    let v = row.stiffness * row.coefficients[i] * row.coefficients[j];
                    S::add(hessian, row.first + i, row.first + j, v);
                }
            }
        }
    }
    let mut stiffness = [[[0.0; 6]; 6]; SEGMENT_COUNT];
    let mut touching = [false; SEGMENT_COUNT];
    for (k, p) in contacts.points.iter().enumerate() {
        if ws.region[k] != Region::Open {
            let d = contacts.stiffness(k, ws.velocity[k], ws.region[k]);
            add_point_stiffness(&mut stiffness[p.slot], p.r, &d);
            touching[p.slot] = true;
        }
    }
    for (slot, s) in contacts.segments.iter().enumerate() {
        if touching[slot] {
            S::add_segment(hessian, s, &s.stiffened(&stiffness[slot]));
        }
    }
}

/// Adds the slope of the moment (part 0) or the force (1) on the root.
#[inline(always)]
pub(super) fn add_root_slope<S: System>(
    hessian: &mut S::Hessian,
    part: usize,
    slope: &[[f64; 3]; 3],
) {
    for (i, row) in slope.iter().enumerate() {
        for (j, x) in row.iter().enumerate().take(i + 1) {
            S::add(hessian, 3 * part + i, 3 * part + j, *x);
        }
    }
}

/// Search for the length of a step that brings the slope along it near zero: the whole step, unless the slope there is
/// well above zero. The slope is increasing. The caller evaluates it, in place, with the vector instructions for which
/// the caller is compiled.
#[derive(Debug)]
pub(crate) struct LineSearch {
    /// Length at which to evaluate the slope; finally, the length of the step.
    pub step: f64,
    /// Slope at the start, < 0.
    start: f64,
    /// Remaining evaluations after the first.
    left: usize,
    /// Lengths between which the slope changes its sign, and the slopes that determine the next length.
    bracket: Option<[(f64, f64); 2]>,
}

impl LineSearch {
    /// A search with at most `most` evaluations after the first.
    #[inline(always)]
    pub fn new(start: f64, most: usize) -> Self {
        Self {
            step: 1.0,
            start,
            left: most,
            bracket: None,
        }
    }

    /// Whether the search ends at a step with this slope; otherwise there is another step to evaluate.
    #[inline(always)]
    pub fn ends_at(&mut self, slope: f64) -> bool {
        let [lo, hi] = match self.bracket {
            None if slope > 0.1 * self.start.abs() => [(0.0, self.start), (1.0, slope)],
            Some([lo, hi]) if slope.abs() >= 0.05 * self.start.abs() || slope.is_nan() => {
                // Illinois variant of regula falsi.
                if slope < 0.0 {
                    [(self.step, slope), (hi.0, 0.5 * hi.1)]
                } else {
                    [(lo.0, 0.5 * lo.1), (self.step, slope)]
                }
            }
            _ => return true,
        };
        if self.left == 0 {
            return true;
        }
        self.left -= 1;
        self.bracket = Some([lo, hi]);
        let way = hi.0 - lo.0;
        self.step = lo.0 - lo.1 * way / (hi.1 - lo.1);
        if self.step.is_nan() || self.step <= lo.0 + 1e-3 * way {
            self.step = lo.0 + 1e-2 * way;
        }
        false
    }
}
