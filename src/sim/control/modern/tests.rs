//! Goal: the kernel solves the intended problem. Method: the same problem in its primal form (accelerations, torques,
//! contact forces, assist), put together from M, h and Jacobians of [`Terms`], and solved by an interior-point method
//! with second-order cones (clarabel).

use super::contacts::FORCE_MEMORY;
use super::*;
use crate::control::ConstraintGoal;
use crate::control::testing::{DT, Scene, SceneHelp};
use crate::math::vec3::vec3;
use crate::support::testing::{
    GRAVITY, Rng, mannequin, on_floor, random_stance, random_state, standing,
};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT,
};

/// Problems.
const ROUNDS: usize = 320;
/// Friction of the ground; the controller plans with less.
const FRICTION: f64 = 0.9;

/// The unknowns of the primal: v̇, τ, contact forces, assist (moment and force on the pelvis).
#[derive(Clone, Debug)]
struct Solution {
    acceleration: [f64; NV],
    torque: [f64; DOF_COUNT],
    force: Vec<Vec3>,
    assist: [f64; 6],
}

/// A least-squares term `½ w (row · v̇ − value)²`.
struct Term {
    row: [f64; NV],
    weight: f64,
    value: f64,
}

/// The problem in primal form.
struct Primal {
    terms: Vec<Term>,
    m: Vec<[f64; NV]>,
    h: [f64; NV],
    lower: [f64; DOF_COUNT],
    upper: [f64; DOF_COUNT],
    /// Rest and cost `½ k (τ − rest)²` of each torque.
    torque: Vec<(f64, f64)>,
    /// Jacobian (3 rows), rest and cost of each contact force.
    contacts: Vec<([[f64; WIDTH]; 3], Vec3, f64)>,
    /// Cost of assist, or of help; `None` without either.
    assist: Option<[f64; 2]>,
    /// The wrench that help is pulled to, and its largest moment and force.
    help: Option<([Vec3; 2], [f64; 2])>,
    mu: f64,
}

impl Primal {
    /// For the problem that `c` has just solved for `s`; `torques`, `forces` and `wrench` are those of the previous
    /// tick, by DOF, by contact point, and on the pelvis.
    fn new(
        c: &Modern,
        s: &Scene,
        torques: &[f64; DOF_COUNT],
        forces: &[Vec3; MAX_CONTACTS],
        wrench: &[Vec3; 2],
    ) -> Self {
        let t = &s.terms;
        let input = s.input();
        let danger = danger(&input);
        let law = sharp_law(&input, danger);
        let least = blend(JOINT_WEIGHT, LEAST_JOINT_WEIGHT, danger);
        let mut all = Vec::new();
        let unit = |d: usize| {
            let mut row = [0.0; NV];
            row[d] = 1.0;
            row
        };
        // Posture: joints, pelvis.
        let demand = initial_acceleration(&s.body, &t.state, &s.target, &law);
        let mut weight = [0.0; DOF_COUNT];
        for j in 0..DOF_COUNT {
            weight[j] = t.m[6 + j][6 + j].max(least).min(JOINT_WEIGHT);
        }
        for g in &s.goals {
            for l in g.limb() {
                for d in DOF_START[l]..DOF_START[l] + DOF_LEN[l] {
                    let wrist = l == L_HAND.index() || l == R_HAND.index();
                    let led = if wrist { LED_WRIST } else { LED_LIMB };
                    weight[d] += g.weight * (led - weight[d]);
                }
            }
        }
        for j in 0..DOF_COUNT {
            all.push(Term {
                row: unit(6 + j),
                weight: weight[j],
                value: demand[j],
            });
        }
        let w = pelvis_demand(t, &s.target, &law, DT).to_array();
        for d in 0..6 {
            all.push(Term {
                row: unit(d),
                weight: weight::BASE,
                value: 0.0,
            });
            if d < 3 {
                all.push(Term {
                    row: unit(d),
                    weight: weight::PELVIS,
                    value: w[d],
                });
            }
        }
        // Tasks: their demands are the controller's own, but the way they enter the problem is not.
        for task in &c.rows {
            let mut row = [0.0; NV];
            row.copy_from_slice(&task.row[..NV]);
            all.push(Term {
                row,
                weight: task.weight,
                value: task.value,
            });
        }
        // Points that are kept down, and their forces.
        let mut contacts = Vec::new();
        for (p, (hold, a)) in c.contacts.points.iter().zip(&c.hold) {
            let local = t.kin.rotation[p.segment].transpose_mul(p.r);
            let mut j = [[0.0; WIDTH]; 3];
            t.point_jacobian(p.segment, local, &mut j);
            for (axis, (row, value)) in j.iter().zip(a.to_array()).enumerate() {
                let mut r = [0.0; NV];
                r.copy_from_slice(&row[..NV]);
                all.push(Term {
                    row: r,
                    weight: hold[axis][axis],
                    value,
                });
            }
            let foot = crate::body::topology::FEET.map(|f| f.index());
            let on_foot = foot.contains(&p.segment) || foot.contains(&p.segment.wrapping_sub(1));
            let last = if s.help.is_some() && !on_foot {
                &s.floor
            } else {
                forces
            };
            let rest = last[p.segment * POINTS + p.vertex] * FORCE_MEMORY;
            contacts.push((j, rest, 1.0 / p.inverse_r));
        }
        let torque = (0..DOF_COUNT).map(|j| {
            let half = 0.5 * (s.upper[j] - s.lower[j]);
            let rest = torques[j].clamp(s.lower[j], s.upper[j]);
            (rest, weight::TORQUE / (half * half))
        });
        let with = s.assist[0] > 0.0;
        let assist = with.then(|| input.assist.map(|a| 1.0 / a));
        // ½ w²/c + ½ (w − last)² k/((1 − k) c), up to a constant.
        let helped = s.help.map(|help| {
            let cost = help.compliance.map(|c| 1.0 / ((1.0 - help.kept) * c));
            let rest = std::array::from_fn(|i| wrench[i].capped(help.most[i]) * help.kept);
            (cost, (rest, help.most))
        });
        Self {
            terms: all,
            m: (0..NV)
                .map(|i| std::array::from_fn(|k| t.m[i][k]))
                .collect(),
            h: t.h,
            lower: s.lower,
            upper: s.upper,
            torque: torque.collect(),
            contacts,
            assist: helped.map(|h| h.0).or(assist),
            help: helped.map(|h| h.1),
            mu: FRICTION * FRICTION_MARGIN,
        }
    }

    fn unknowns(&self) -> usize {
        NV + DOF_COUNT + 3 * self.contacts.len() + if self.assist.is_some() { 6 } else { 0 }
    }

    fn objective(&self, s: &Solution) -> f64 {
        let mut sum = 0.0;
        for t in &self.terms {
            let a: f64 = t.row.iter().zip(&s.acceleration).map(|(x, y)| x * y).sum();
            sum += 0.5 * t.weight * (a - t.value).powi(2);
        }
        for (tau, (rest, k)) in s.torque.iter().zip(&self.torque) {
            sum += 0.5 * k * (tau - rest).powi(2);
        }
        for (f, (_, rest, k)) in s.force.iter().zip(&self.contacts) {
            sum += 0.5 * k * (*f - *rest).dot(*f - *rest);
        }
        if let Some(k) = self.assist {
            for (i, w) in s.assist.iter().enumerate() {
                sum += 0.5 * k[i / 3] * (w - self.rest(i)).powi(2);
            }
        }
        sum
    }

    /// Component of the wrench that help is pulled to.
    fn rest(&self, i: usize) -> f64 {
        self.help.map_or(0.0, |h| h.0[i / 3].to_array()[i % 3])
    }

    /// Largest component of `M v̇ + h − Sᵀτ − Jᵀf − assist`, N·m or N.
    fn residual(&self, s: &Solution) -> f64 {
        let mut worst = 0.0f64;
        for i in 0..NV {
            let mut r = self.h[i];
            for k in 0..NV {
                r += self.m[i][k] * s.acceleration[k];
            }
            if i >= 6 {
                r -= s.torque[i - 6];
            } else {
                r -= s.assist[i];
            }
            for (f, (j, ..)) in s.force.iter().zip(&self.contacts) {
                r -= j[0][i] * f.x + j[1][i] * f.y + j[2][i] * f.z;
            }
            worst = worst.max(r.abs());
        }
        worst
    }

    /// Largest excess over limits and cones, N·m or N.
    fn excess(&self, s: &Solution) -> f64 {
        let mut worst = 0.0f64;
        for j in 0..DOF_COUNT {
            worst = worst.max(s.torque[j] - self.upper[j]);
            worst = worst.max(self.lower[j] - s.torque[j]);
        }
        for f in &s.force {
            worst = worst.max(-f.z);
            worst = worst.max(f.x.hypot(f.y) - self.mu * f.z);
        }
        if let Some((_, most)) = self.help {
            for (w, most) in s.assist.chunks(3).zip(most) {
                worst = worst.max(vec3(w[0], w[1], w[2]).norm() - most);
            }
        }
        worst
    }

    /// The exact solution.
    fn solve(&self) -> Solution {
        let n = self.unknowns();
        let (tau, force) = (NV, NV + DOF_COUNT);
        let assist = force + 3 * self.contacts.len();
        // ½ zᵀP z + qᵀz.
        let mut p = vec![vec![0.0; n]; n];
        let mut q = vec![0.0; n];
        for t in &self.terms {
            for i in 0..NV {
                if t.row[i] != 0.0 {
                    q[i] -= t.weight * t.row[i] * t.value;
                    for k in i..NV {
                        p[i][k] += t.weight * t.row[i] * t.row[k];
                    }
                }
            }
        }
        for (j, (rest, k)) in self.torque.iter().enumerate() {
            p[tau + j][tau + j] = *k;
            q[tau + j] = -k * rest;
        }
        for (c, (_, rest, k)) in self.contacts.iter().enumerate() {
            for (axis, r) in rest.to_array().into_iter().enumerate() {
                let i = force + 3 * c + axis;
                p[i][i] = *k;
                q[i] = -k * r;
            }
        }
        if let Some(k) = self.assist {
            for i in 0..6 {
                p[assist + i][assist + i] = k[i / 3];
                q[assist + i] = -k[i / 3] * self.rest(i);
            }
        }
        // A z + s = b, s in the cones.
        let mut rows: Vec<(usize, usize, f64)> = Vec::new();
        let mut b = Vec::new();
        let mut cones = vec![SupportedConeT::ZeroConeT(NV)];
        for i in 0..NV {
            for k in 0..NV {
                rows.push((i, k, self.m[i][k]));
            }
            if i >= 6 {
                rows.push((i, tau + i - 6, -1.0));
            } else if self.assist.is_some() {
                rows.push((i, assist + i, -1.0));
            }
            for (c, (j, ..)) in self.contacts.iter().enumerate() {
                for axis in 0..3 {
                    rows.push((i, force + 3 * c + axis, -j[axis][i]));
                }
            }
            b.push(-self.h[i]);
        }
        cones.push(SupportedConeT::NonnegativeConeT(2 * DOF_COUNT));
        for j in 0..DOF_COUNT {
            rows.push((b.len(), tau + j, 1.0));
            b.push(self.upper[j]);
            rows.push((b.len(), tau + j, -1.0));
            b.push(-self.lower[j]);
        }
        for c in 0..self.contacts.len() {
            cones.push(SupportedConeT::SecondOrderConeT(3));
            for (axis, scale) in [(2, self.mu), (0, 1.0), (1, 1.0)] {
                rows.push((b.len(), force + 3 * c + axis, -scale));
                b.push(0.0);
            }
        }
        for (part, most) in self.help.iter().flat_map(|h| h.1).enumerate() {
            cones.push(SupportedConeT::SecondOrderConeT(4));
            b.push(1.0);
            for axis in 0..3 {
                rows.push((b.len(), assist + 3 * part + axis, -1.0 / most));
                b.push(0.0);
            }
        }
        rows.retain(|r| r.2 != 0.0);
        let a = sparse(b.len(), n, rows);
        let mut upper = Vec::new();
        for (i, row) in p.iter().enumerate() {
            for (k, x) in row.iter().enumerate().skip(i) {
                if *x != 0.0 {
                    upper.push((i, k, *x));
                }
            }
        }
        let p = sparse(n, n, upper);
        let settings = DefaultSettingsBuilder::default()
            .verbose(false)
            .tol_gap_abs(1e-10)
            .tol_gap_rel(1e-11)
            .tol_feas(1e-11)
            .max_iter(200)
            .build()
            .unwrap();
        let mut solver = DefaultSolver::new(&p, &q, &a, &b, &cones, settings).unwrap();
        solver.solve();
        let ok = matches!(
            solver.solution.status,
            SolverStatus::Solved | SolverStatus::AlmostSolved
        );
        assert!(ok, "{:?}", solver.solution.status);
        let x = &solver.solution.x;
        Solution {
            acceleration: std::array::from_fn(|i| x[i]),
            torque: std::array::from_fn(|j| x[tau + j]),
            force: (0..self.contacts.len())
                .map(|c| {
                    let at = force + 3 * c;
                    vec3(x[at], x[at + 1], x[at + 2])
                })
                .collect(),
            assist: std::array::from_fn(|i| {
                if self.assist.is_some() {
                    x[assist + i]
                } else {
                    0.0
                }
            }),
        }
    }
}

fn sparse(m: usize, n: usize, mut entries: Vec<(usize, usize, f64)>) -> CscMatrix<f64> {
    entries.sort_by_key(|e| (e.1, e.0));
    let mut colptr = vec![0; n + 1];
    for e in &entries {
        colptr[e.1 + 1] += 1;
    }
    for k in 0..n {
        colptr[k + 1] += colptr[k];
    }
    let rowval = entries.iter().map(|e| e.0).collect();
    let nzval = entries.iter().map(|e| e.2).collect();
    CscMatrix::new(m, n, colptr, rowval, nzval)
}

/// The kernel's decision, as a solution of the primal.
fn decided(c: &Modern) -> Solution {
    let n = c.contacts.points.len();
    Solution {
        acceleration: c.command.acceleration,
        torque: c.command.torque,
        force: c.newton.force[..n].to_vec(),
        assist: std::array::from_fn(|i| match c.wrench {
            Some(_) => c.command.wrench[i / 3].to_array()[i % 3],
            // Stationarity: assist = −compliance × price.
            None => -c.assist[i / 3] * c.memory.price[i],
        }),
    }
}

/// A figure at a random place with a target somewhere else, of one of eight kinds.
fn scene(rng: &mut Rng, kind: usize, round: usize) -> Scene {
    let body = mannequin();
    let scale = [1.0, 0.3, 0.08, 5.0][round / 8 % 4];
    let (spread, rate) = [(0.05, 0.1), (0.3, 1.0), (0.8, 4.0)][round % 3];
    let mut state = random_stance(&body, rng, spread, rate);
    let mut desired = random_state(&body, rng, 0.6, 0.0);
    if kind == 0 {
        desired = standing(&body);
    }
    if kind == 3 {
        state = random_state(&body, rng, 1.0, 5.0);
        state.posture.root_position.z += 1.0;
    }
    if kind == 4 {
        state = random_state(&body, rng, 1.0, 5.0);
        state.posture = on_floor(&body, state.posture);
    }
    let mut s = Scene::new(&state, &desired, scale);
    match kind {
        1 => s.plant([true, false]),
        2 => s.plant([false, true]),
        3 => s.plant([round.is_multiple_of(2); 2]),
        5 => s.assist = [40.0 * 40.0, 500.0 * 500.0].map(|a| a * (0.1 + rng.unit().abs())),
        6 => {
            for _ in 0..4 {
                let segment = crate::body::SegmentId::new(rng.between(1.0, 10.0) as usize);
                let axis = vec3(rng.unit(), rng.unit(), rng.unit());
                s.goals.push(ConstraintGoal {
                    segment: segment.unwrap(),
                    point: vec3(0.0, 0.02, -0.05),
                    position: Some(vec3(rng.unit(), rng.unit(), 1.0 + rng.unit())),
                    velocity: axis * 0.5,
                    axes: [1.0, 0.5, rng.unit().abs()],
                    rotation: Some(Quat::exp(axis)),
                    weight: rng.unit().abs(),
                });
            }
        }
        7 => {
            let weight = s.terms.mass * GRAVITY;
            let most = [0.01, 0.1, 0.3, 1.0][rng.between(0.0, 4.0) as usize % 4] * weight;
            let price = 0.02 + 10.0 * rng.unit().abs();
            let compliance = [0.9 * most, most].map(|m| 0.5 * m * m / price);
            let kept = [0.0, 0.5, 0.9][round / 8 % 3];
            s.help = Some(SceneHelp {
                compliance,
                most: [0.9 * most, most],
                kept,
            });
            for (f, z) in s.floor.iter_mut().zip(s.heights.iter_mut()) {
                *f = vec3(rng.unit(), rng.unit(), 2.0 + rng.unit()) * 20.0;
                *z = 0.05 * rng.unit();
            }
        }
        _ => {}
    }
    s
}

/// Problem 14.1.
///
/// Problem 14.2.
#[test]
fn the_kernel_solves_the_problem_that_an_interior_point_method_solves() {
    let mut rng = Rng::new(77);
    let mut c = Modern::new(FRICTION);
    let (mut jammed, mut saturated, mut sliding, mut flying) = (0, 0, 0, 0);
    // Helps within, and at, their bounds.
    let mut helped = [0; 2];
    let mut counts = Vec::new();
    let (mut cost, mut torque, mut force, mut acceleration) = (0.0f64, 0.0f64, 0.0f64, 0.0f64);
    for round in 0..ROUNDS {
        let s = scene(&mut rng, round % 8, round);
        if round % 5 == 0 {
            c.reset();
        }
        let (torques, forces) = (c.memory.torque, c.memory.force.clone());
        let wrench = c.memory.wrench;
        c.control(&s.input());
        let forces: [Vec3; MAX_CONTACTS] = *forces;
        counts.push(c.command.iterations);
        // Within limits and cones, whatever the residual.
        let primal = Primal::new(&c, &s, &torques, &forces, &wrench);
        let ours = decided(&c);
        assert!(
            primal.excess(&ours) < 1e-9,
            "{round}: {}",
            primal.excess(&ours)
        );
        // It converges whatever its starting prices are, more often than not those of another figure's problem.
        assert!(!c.command.flags.has(Flags::CONTROL_BOUND), "{round}");
        jammed += usize::from(c.command.iterations > NEWTON_ITERATIONS);
        let exact = primal.solve();
        assert!(primal.excess(&exact) < 1e-4, "{round}: the oracle itself");
        assert!(primal.residual(&exact) < 1e-4, "{round}: the oracle itself");
        assert!(primal.residual(&ours) < 2.0 * TOLERANCE, "{round}");
        let (a, b) = (primal.objective(&ours), primal.objective(&exact));
        let d = (a - b).abs() / b.abs().max(1.0);
        cost = cost.max(d);
        for j in 0..DOF_COUNT {
            let range = s.upper[j] - s.lower[j];
            torque = torque.max((ours.torque[j] - exact.torque[j]).abs() / range);
        }
        let sum = |x: &Solution| x.force.iter().fold(Vec3::zero(), |f, g| f + *g);
        let weight = s.terms.mass * GRAVITY;
        force = force.max((sum(&ours) - sum(&exact)).norm() / weight);
        let scale = exact
            .acceleration
            .iter()
            .fold(1.0f64, |m, a| m.max(a.abs()));
        for (x, y) in ours.acceleration.iter().zip(&exact.acceleration) {
            acceleration = acceleration.max((x - y).abs() / scale);
        }
        saturated += usize::from(c.command.saturated != 0);
        flying += usize::from(ours.force.is_empty());
        for (w, most) in (c.command.wrench)
            .iter()
            .zip(s.help.map_or([0.0; 2], |h| h.most))
        {
            if most > 0.0 {
                helped[usize::from(w.norm() > (1.0 - 1e-9) * most)] += 1;
            }
        }
        let edge = |f: &&Vec3| f.z > 1.0 && f.x.hypot(f.y) > 0.999 * primal.mu * f.z;
        sliding += usize::from(ours.force.iter().any(|f| edge(&f)));
    }
    counts.sort_unstable();
    let text = format!(
        "{ROUNDS} compared ({saturated} saturated, {sliding} at the cone, {flying} in flight, {helped:?} wrenches \
         within and at their bounds); iterations: median {}, 99 % {}, {} at most, {jammed} through the interior; cost \
         {cost:.1e}, torque {torque:.1e} of its range, force {force:.1e} of the weight, acceleration \
         {acceleration:.1e} of the largest",
        counts[ROUNDS / 2],
        counts[ROUNDS * 99 / 100],
        counts[ROUNDS - 1],
    );
    println!("{text}");
    assert!(
        jammed > 60 && saturated > 60 && sliding > 20 && flying > 20,
        "{text}"
    );
    assert!(helped.iter().all(|n| *n > 10), "{text}");
    assert!(cost < 1e-6, "{text}");
    assert!(
        torque < 1e-4 && force < 1e-4 && acceleration < 1e-4,
        "{text}"
    );
}

/// A man in a desired stand, allowed a wrench with these bounds over his weight.
fn helped_stand(most: f64) -> Scene {
    let body = mannequin();
    let state = standing(&body);
    let mut s = Scene::new(&state, &state, 1.0);
    s.plant([true; 2]);
    let most = most * s.terms.mass * GRAVITY;
    s.help = Some(SceneHelp {
        compliance: [0.05 * most * most; 2],
        most: [most; 2],
        kept: 0.0,
    });
    s
}

#[test]
fn a_wrench_without_room_or_without_need_is_zero() {
    let mut c = Modern::new(FRICTION);
    let mut off = helped_stand(0.0);
    off.help = Some(SceneHelp {
        compliance: [1e4; 2],
        most: [0.0; 2],
        kept: 0.9,
    });
    off.com.shift(vec3(0.3, 0.1, 0.2));
    for _ in 0..3 {
        let command = c.control(&off.input());
        assert_eq!(command.wrench, [Vec3::zero(); 2]);
        assert!(!command.flags.has(Flags::CONTROL_BOUND));
    }
    // In a desired stand the floor carries all of the weight: its force costs next to nothing.
    let mut c = Modern::new(FRICTION);
    let mut stands = helped_stand(1.0);
    let weight = stands.terms.mass * GRAVITY;
    // The price while all is well.
    stands.help.as_mut().unwrap().compliance = [1.5e-5 * weight * weight; 2];
    let mut force = 0.0;
    for _ in 0..60 {
        force = c.control(&stands.input()).wrench[1].norm();
    }
    println!("a stand is helped by {force:.3} N");
    assert!(force < 1e-3 * weight, "{force} N");
}

/// Optimality of the ball: inside, the wrench is what its price buys; at the bound it points where the price asks for
/// more.
#[test]
fn a_wrench_is_what_its_price_buys_or_at_its_bound_along_it() {
    let (mut inside, mut bound) = (0, 0);
    for far in [0.01, 0.03, 0.1, 0.3, 1.0] {
        for direction in [Vec3::X, Vec3::Y, Vec3::Z, vec3(1.0, -1.0, 1.0)] {
            let mut c = Modern::new(FRICTION);
            let mut s = helped_stand(0.3);
            s.com.shift(direction * far);
            c.control(&s.input());
            let ball = c.wrench.unwrap();
            for (part, ball) in ball.0.iter().enumerate() {
                let price = RootWrench::seen(&c.memory.price, part);
                let (w, free) = (c.command.wrench[part], price * -ball.gain);
                if free.norm() <= ball.most {
                    inside += 1;
                    assert!((w - free).norm() < 1e-9, "{w:?} {free:?}");
                } else {
                    bound += 1;
                    assert!((w.norm() - ball.most).abs() < 1e-9 * ball.most);
                    assert!(
                        w.cross(free).norm() < 1e-9 * w.norm() * free.norm() && w.dot(free) > 0.0
                    );
                }
            }
        }
    }
    assert!(
        inside > 5 && bound > 5,
        "{inside} inside, {bound} at the bound"
    );
}

/// The price on its change: a wrench that is needed all at once comes in steps.
#[test]
fn a_wrench_whose_change_has_a_price_comes_gradually_to_the_same_size() {
    let forces = |kept: f64| -> Vec<f64> {
        let mut c = Modern::new(FRICTION);
        let mut s = helped_stand(1.0);
        s.help.as_mut().unwrap().kept = kept;
        s.com.shift(Vec3::Z * 0.1);
        (0..200)
            .map(|_| c.control(&s.input()).wrench[1].norm())
            .collect()
    };
    let (at_once, gradual) = (forces(0.0), forces(0.9));
    assert!(
        gradual[0] < 0.5 * at_once[0],
        "{} {}",
        gradual[0],
        at_once[0]
    );
    let ends = [at_once[199], gradual[199]];
    assert!((ends[0] - ends[1]).abs() < 0.05 * ends[0], "{ends:?}");
}
