//! Recovers Coulomb's law from the convex one, for points that slide (ADR 0020).
//!
//! The convex solve keeps forces within the friction cone and therefore velocities within its dual: a point that slides
//! at v_t cannot come nearer to the ground than μ v_t h, so a foot swinging at 3 m/s would ride on 2 cm of air. De
//! Saxcé's correction removes this gap: the condition that holds a point up is `v_n + c ≥ μ v_t`, so its row is offset
//! by `s = μ v_t`. As v_t is part of the solution, it is found by a few solves, starting from the present velocity of
//! the point. In each solve the forces lie within the cone and remove energy, however far it is from the last one: f·v
//! = −f_n (s + c).

use super::newton::NewtonWorkspace;
use super::rows::ContactRows;
use crate::body::topology::NV;
use crate::math::Vec3;
use crate::report::MAX_CONTACTS;

/// Largest number of solves in one substep after the first. Nearly all need one, in which a landing foot stops; the
/// error of a point that keeps sliding halves with each solve.
const ROUNDS: u32 = 4;
/// Change of an offset that counts as zero, m/s.
const SETTLED: f64 = 1e-9;
/// Slower points do not count as sliding, m/s: they hover by less than 0.75 mm (at 120 substeps a second), and standing
/// feet, which creep, need no further solves.
pub const CREEP: f64 = 0.1;
/// The offset of faster points is capped at this speed, m/s: no limb slides faster, and huge offsets would spoil the
/// scale of a solve.
const FASTEST: f64 = 10.0;

/// Offsets of the contact rows of one substep.
#[derive(Clone, Debug)]
pub struct Slides {
    /// `s` of each point, m/s.
    offset: Box<[f64; MAX_CONTACTS]>,
    rounds: u32,
    most: u32,
}

impl Default for Slides {
    fn default() -> Self {
        Self {
            offset: Box::new([0.0; MAX_CONTACTS]),
            rounds: 0,
            most: ROUNDS,
        }
    }
}

impl Slides {
    /// Limits the further solves to `most`, 4 by default; the offsets after the last solve are final.
    pub fn limit_rounds(&mut self, most: u32) {
        self.most = most.min(ROUNDS);
    }

    /// Offsets the rows as if every point kept its motion at velocity `v`.
    pub fn begin(&mut self, contacts: &mut ContactRows, v: &[f64; NV], ws: &mut NewtonWorkspace) {
        self.rounds = 0;
        contacts.velocities(v, &mut ws.velocity);
        for k in 0..contacts.points.len() {
            self.offset[k] = offset(contacts.friction, ws.velocity[k]);
            contacts.points[k].c.z += self.offset[k];
        }
    }

    /// Offsets the rows by the sliding of the points in the last solve. Returns false if that changes nothing for
    /// touching points, or after the last round.
    pub fn again(&mut self, contacts: &mut ContactRows, ws: &NewtonWorkspace) -> bool {
        self.rounds += 1;
        if self.rounds > self.most {
            return false;
        }
        let mut change = 0.0f64;
        for k in 0..contacts.points.len() {
            let p = &mut contacts.points[k];
            // Do not count elastic deformation as sliding.
            let slid = ws.velocity[k] + ws.force[k] * (1.0 / p.inverse_r);
            let s = offset(contacts.friction, slid);
            if ws.force[k].z > 0.0 {
                change = change.max((s - self.offset[k]).abs());
            }
            p.c.z += s - self.offset[k];
            self.offset[k] = s;
        }
        change > SETTLED
    }
}

fn offset(friction: f64, v: Vec3) -> f64 {
    friction * ((v.x * v.x + v.y * v.y).sqrt() - CREEP).clamp(0.0, FASTEST)
}
