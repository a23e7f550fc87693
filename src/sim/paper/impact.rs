//! The linear system of a collision as in §3 of the paper: the change of velocities when parts meet, and the change of
//! angles that removes overlaps.
//!
//! The unknowns are impulses p along rows J of both bodies. Standing feet stay still (`J v⁺ = 0`), and touching parts
//! stop approaching each other (`J v⁺ ≥ w`, `p ≥ 0`). With `v⁺ = v + M⁻¹ Jᵀ p` the active rows are one linear system,
//! `J M⁻¹ Jᵀ p = w − J v`. Rows that would pull are removed, and rows that would be violated are added. One body
//! receives the momentum that the other loses. Without led obstacles, `v⁺` is a projection of `v` in the metric of M:
//! kinetic energy cannot rise. The correction of angles is the same system with `v = 0` and w = the overlap: inverse
//! kinematics of least change, weighted by inertia.

use crate::body::topology::NV;
use crate::dynamics::MassMatrix;
use crate::dynamics::factor::{factor, solve};
use crate::math::dense::{factor_rows, solve_rows};

/// Largest number of rows of one system.
pub const MOST_ROWS: usize = 64;
/// Largest number of changes of the set of active rows.
const ROUNDS: usize = 32;
/// Added to the diagonal, relative to its largest element: rows of one face depend on each other.
const RIDGE: f64 = 1e-10;
/// Tolerance, m/s, by which a row must be missed to count as violated; an impulse below minus this, N·s, counts as
/// pulling.
const TOLERANCE: f64 = 1e-9;

#[derive(Clone, Debug)]
struct ImpactBody {
    factor: MassMatrix<f64>,
    velocity: [f64; NV],
}

/// One condition on the velocity after the impact.
#[derive(Clone, Debug)]
pub struct ImpactRow {
    /// Bodies of both sides; `None` is an immovable object.
    pub bodies: [Option<usize>; 2],
    /// `J` of both sides, signs included.
    pub jacobian: [[f64; NV]; 2],
    /// Least value of `J v⁺`; held rows have exactly this.
    pub wanted: f64,
    /// Rows of one group are left out together.
    pub group: usize,
    /// Impulse below which the group is removed, N·s: 0 for touching parts, −∞ for supports that always hold.
    pub least: f64,
    /// Whether it may become active again and need not start active: true for touching parts, false for supports that
    /// hold.
    pub one_sided: bool,
}

impl ImpactRow {
    /// An empty row.
    pub fn new(bodies: [Option<usize>; 2], group: usize) -> Self {
        Self {
            bodies,
            jacobian: [[0.0; NV]; 2],
            wanted: 0.0,
            group,
            least: f64::NEG_INFINITY,
            one_sided: false,
        }
    }
}

/// The system with its buffers; nothing is allocated once they have grown.
#[derive(Clone, Debug)]
pub struct Impact {
    bodies: Vec<ImpactBody>,
    rows: Vec<ImpactRow>,
    /// `M⁻¹ Jᵀ` of both sides.
    response: Vec<[[f64; NV]; 2]>,
    active: Vec<bool>,
    impulse: Vec<f64>,
    gram: Box<[[f64; MOST_ROWS]; MOST_ROWS]>,
    work: Box<[[f64; MOST_ROWS]; MOST_ROWS]>,
}

impl Default for Impact {
    fn default() -> Self {
        Self {
            bodies: Vec::new(),
            rows: Vec::with_capacity(MOST_ROWS),
            response: Vec::with_capacity(MOST_ROWS),
            active: Vec::with_capacity(MOST_ROWS),
            impulse: Vec::with_capacity(MOST_ROWS),
            gram: Box::new([[0.0; MOST_ROWS]; MOST_ROWS]),
            work: Box::new([[0.0; MOST_ROWS]; MOST_ROWS]),
        }
    }
}

impl Impact {
    /// Forgets bodies and rows.
    pub fn clear(&mut self) {
        self.bodies.clear();
        self.rows.clear();
        self.response.clear();
    }

    /// Adds a body with its velocity; returns its index.
    pub fn add_body(&mut self, mass: &MassMatrix<f64>, velocity: &[f64; NV]) -> usize {
        let mut l = mass.clone();
        factor(&mut l);
        self.bodies.push(ImpactBody {
            factor: l,
            velocity: *velocity,
        });
        self.bodies.len() - 1
    }

    /// Adds a condition. Returns whether there was room.
    pub fn add_row(&mut self, row: ImpactRow) -> bool {
        if self.rows.len() == MOST_ROWS {
            return false;
        }
        let mut response = row.jacobian;
        for (r, body) in response.iter_mut().zip(row.bodies) {
            match body {
                Some(b) => solve(&self.bodies[b].factor, r),
                None => *r = [0.0; NV],
            }
        }
        self.response.push(response);
        self.rows.push(row);
        true
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows.len()
    }

    /// `J v` of a row.
    fn value(&self, k: usize) -> f64 {
        let row = &self.rows[k];
        let sides = row.bodies.iter().zip(&row.jacobian);
        sides
            .filter_map(|(b, j)| Some(dot(j, &self.bodies[(*b)?].velocity)))
            .sum()
    }

    /// `J_i M⁻¹ J_kᵀ`.
    fn product(&self, i: usize, k: usize) -> f64 {
        let (a, b) = (&self.rows[i], &self.rows[k]);
        let mut sum = 0.0;
        for (x, j) in a.bodies.iter().zip(&a.jacobian) {
            for (y, r) in b.bodies.iter().zip(&self.response[k]) {
                if x.is_some() && x == y {
                    sum += dot(j, r);
                }
            }
        }
        sum
    }

    /// Finds the impulses and applies them to the velocities. Returns the number of rounds.
    ///
    /// Section 3 of the paper.
    pub fn solve(&mut self) -> usize {
        let n = self.rows.len();
        let mut largest = 0.0f64;
        for i in 0..n {
            for k in 0..=i {
                let g = self.product(i, k);
                (self.gram[i][k], self.gram[k][i]) = (g, g);
            }
            largest = largest.max(self.gram[i][i]);
        }
        let ridge = RIDGE * largest;
        self.active.clear();
        self.impulse.clear();
        self.impulse.resize(n, 0.0);
        for k in 0..n {
            let breaks = self.value(k) < self.rows[k].wanted;
            self.active.push(breaks || !self.rows[k].one_sided);
        }
        let mut rounds = 0;
        while rounds < ROUNDS {
            rounds += 1;
            self.solve_active(ridge);
            let pulls = (0..n)
                .filter(|k| self.active[*k] && self.impulse[*k] < self.rows[*k].least - TOLERANCE)
                .min_by(|a, b| self.impulse[*a].total_cmp(&self.impulse[*b]));
            if let Some(k) = pulls {
                let group = self.rows[k].group;
                for (a, row) in self.active.iter_mut().zip(&self.rows) {
                    *a &= row.group != group;
                }
                continue;
            }
            let missing = |k: usize| {
                let gain: f64 = (0..n).map(|i| self.gram[k][i] * self.impulse[i]).sum();
                self.rows[k].wanted - self.value(k) - gain
            };
            let broken = (0..n)
                .filter(|k| !self.active[*k] && self.rows[*k].one_sided)
                .map(|k| (k, missing(k)))
                .filter(|(_, m)| *m > TOLERANCE)
                .max_by(|a, b| a.1.total_cmp(&b.1));
            match broken {
                Some((k, _)) => self.active[k] = true,
                None => break,
            }
        }
        // Applies to the last round, too: no impulse pulls, and both sides get equal and opposite impulses.
        for k in 0..n {
            if self.rows[k].one_sided {
                self.impulse[k] = self.impulse[k].max(0.0);
            }
            let (p, row) = (self.impulse[k], &self.rows[k]);
            for (b, r) in row.bodies.iter().zip(&self.response[k]) {
                if let Some(b) = b {
                    for (v, r) in self.bodies[*b].velocity.iter_mut().zip(r) {
                        *v += r * p;
                    }
                }
            }
        }
        rounds
    }

    /// Impulses of the active rows, zero for the others.
    fn solve_active(&mut self, ridge: f64) {
        let n = self.rows.len();
        let mut index = [0; MOST_ROWS];
        let mut count = 0;
        for k in (0..n).filter(|k| self.active[*k]) {
            index[count] = k;
            count += 1;
        }
        let mut x = [0.0; MOST_ROWS];
        for (i, &k) in index[..count].iter().enumerate() {
            x[i] = self.rows[k].wanted - self.value(k);
            for (j, &l) in index[..=i].iter().enumerate() {
                self.work[i][j] = self.gram[k][l];
            }
            self.work[i][i] += ridge;
        }
        factor_rows(&mut self.work[..], count);
        solve_rows(&self.work[..], count, &mut x[..count]);
        // Solve once more for the residual left by the ridge.
        let mut rest = [0.0; MOST_ROWS];
        for (i, &k) in index[..count].iter().enumerate() {
            let given: f64 = (index[..count].iter().zip(&x))
                .map(|(&l, p)| self.gram[k][l] * p)
                .sum();
            rest[i] = self.rows[k].wanted - self.value(k) - given;
        }
        solve_rows(&self.work[..], count, &mut rest[..count]);
        self.impulse.fill(0.0);
        for (i, &k) in index[..count].iter().enumerate() {
            self.impulse[k] = x[i] + rest[i];
        }
    }

    /// Velocity of a body; after [`Self::solve`], its velocity after the impact.
    pub fn velocity(&self, body: usize) -> &[f64; NV] {
        &self.bodies[body].velocity
    }

    /// Impulse of a row, N·s.
    pub fn impulse(&self, row: usize) -> f64 {
        self.impulse[row]
    }
}

fn dot(a: &[f64; NV], b: &[f64; NV]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::topology::{CHEST, L_FOOT, R_FOOT, R_HAND};
    use crate::body::{Links, State};
    use crate::dynamics::jacobian::for_each_column;
    use crate::dynamics::{Kinematics, Terms, kinetic_energy, momentum};
    use crate::math::Vec3;
    use crate::support::testing::{GRAVITY, Rng, mannequin, random_stance, terms};

    fn row_of(t: &Terms, s: usize, at: Vec3, n: Vec3, row: &mut [f64; NV]) {
        let r = at - t.state.posture.root_position;
        for_each_column(&t.kin, s, r, |k, _, v| row[k] = n.dot(v));
    }

    /// Total linear momentum of both bodies, and total angular momentum about the world origin.
    fn total(links: &Links, states: &[State]) -> (Vec3, Vec3, f64) {
        let (mut p, mut l, mut e) = (Vec3::zero(), Vec3::zero(), 0.0);
        for s in states {
            let mut kin = Kinematics::default();
            kin.set_state(links, s);
            let m = momentum(links, &kin);
            let mut t = Terms::default();
            t.compute(links, s, &[], GRAVITY);
            p += m.linear;
            l += m.angular + t.com.cross(m.linear);
            e += kinetic_energy(links, &kin);
        }
        (p, l, e)
    }

    /// Section 3 of the paper: two standing figures run into each other. Momentum is conserved, and no energy is
    /// created.
    #[test]
    fn what_one_figure_gets_the_other_loses_and_the_floor_takes_the_rest() {
        let body = {
            let mut b = mannequin();
            b.armature = [0.0; crate::body::DOF_COUNT];
            b
        };
        let links = Links::new(&body);
        let mut rng = Rng::new(31);
        let mut met = 0;
        for round in 0..100 {
            let states = [0, 1].map(|_| random_stance(&body, &mut rng, 0.3, 1.0));
            let t = states.map(|s| terms(&body, &s));
            let at = (t[0].com + t[1].com) * 0.5 + Vec3::Z * 0.2;
            let mut impact = Impact::default();
            for (t, s) in t.iter().zip(&states) {
                impact.add_body(&t.mass_matrix, &s.velocity);
            }
            // In every other round they fly and touch only each other.
            let mut held = Vec::new();
            for (b, t) in t.iter().enumerate().filter(|_| round % 2 == 0) {
                for (g, foot) in [L_FOOT, R_FOOT].into_iter().enumerate() {
                    let mut jacobian = [[0.0; crate::dynamics::terms::WIDTH]; 6];
                    t.segment_jacobian(foot.index(), &mut jacobian);
                    for (k, j) in jacobian.iter().enumerate() {
                        let mut row = ImpactRow::new([Some(b), None], 2 * b + g);
                        row.jacobian[0].copy_from_slice(&j[..NV]);
                        assert!(impact.add_row(row));
                        held.push((b, foot.index(), k));
                    }
                }
            }
            let mut touching = Vec::new();
            for k in 0..3 {
                let n = Vec3 {
                    x: rng.unit(),
                    y: rng.unit(),
                    z: rng.unit(),
                }
                .normalized_or(Vec3::X);
                let p = at + n * (0.05 * f64::from(k));
                let mut row = ImpactRow::new([Some(0), Some(1)], 10 + k as usize);
                let (a, b) = (CHEST.index(), R_HAND.index());
                row_of(&t[0], a, p, n, &mut row.jacobian[0]);
                row_of(&t[1], b, p, n * -1.0, &mut row.jacobian[1]);
                (row.least, row.one_sided) = (0.0, true);
                assert!(impact.add_row(row));
                touching.push((p, n));
            }
            impact.solve();
            let mut after = states;
            for (b, s) in after.iter_mut().enumerate() {
                s.velocity = *impact.velocity(b);
            }
            let (p0, l0, e0) = total(&links, &states);
            let (p1, l1, e1) = total(&links, &after);
            // Impulse of the floor: a wrench about the origin of each foot.
            let (mut p, mut l) = (Vec3::zero(), Vec3::zero());
            for (i, (b, foot, k)) in held.iter().enumerate() {
                let mut part = [0.0; 3];
                part[k % 3] = impact.impulse(i);
                let part = Vec3::from_array(part);
                if *k < 3 {
                    l += part;
                } else {
                    p += part;
                    l += t[*b].segment_position(*foot).cross(part);
                }
            }
            assert!((p1 - p0 - p).norm() < 1e-9, "{round}: {:?}", p1 - p0 - p);
            assert!((l1 - l0 - l).norm() < 1e-9, "{round}: {:?}", l1 - l0 - l);
            assert!(e1 <= e0 * (1.0 + 1e-12), "{round}: {e0} {e1}");
            for (k, (at, n)) in touching.iter().enumerate() {
                let i = held.len() + k;
                assert!(impact.impulse(i) >= 0.0);
                met += u32::from(impact.impulse(i) > 0.0);
                let [a, b] = [(0, CHEST), (1, R_HAND)].map(|(f, s)| {
                    let mut t = Terms::default();
                    t.compute(&links, &after[f], &[], GRAVITY);
                    let s = s.index();
                    t.kin.velocity[s] + t.kin.omega[s].cross(*at - t.segment_position(s))
                });
                assert!((a - b).dot(*n) > -1e-6, "{round}: they go on");
            }
        }
        assert!(met > 50, "{met} contacts pushed");
    }
}
