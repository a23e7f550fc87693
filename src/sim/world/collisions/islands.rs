//! Solves every island of touching bodies, and applies the impulses.

use super::cast::Cast;
use super::{Candidate, Cluster, Participant, find, unite};
use crate::body::SegmentId;
use crate::body::topology::NV;
use crate::collide::island::{ContactLaw, Island};
use crate::dynamics::jacobian::for_each_column;
use crate::figure::touches::Contacting;
use crate::math::Vec3;
use crate::tick_context::TickContext;
use crate::touch::MAX_ISLAND_CONTACTS as MAX_CONTACTS;

/// Compliance of a contact between bodies, 1/kg.
const COMPLIANCE: f64 = 1e-4;
/// Share of a penetration beyond the slop that is corrected per substep.
const RETURN_SHARE: f64 = 0.1;
/// Penetration that is not corrected, m.
const SLOP: f64 = 1e-4;
/// The same for contacts of a figure, m, because flesh yields. Round parts that slide past each other sink in by a
/// millimetre or two, and pushing out a body that lies on them would give it energy.
const FLESH: f64 = 4e-3;
/// Fastest push-out, m/s. It is slow because it gives energy to the body that presses on the contact.
const RETURN_SPEED: f64 = 0.05;

impl Cluster {
    /// Solves every island of nearby bodies, and applies the impulses.
    pub(super) fn solve(&mut self, world: &TickContext, cast: &mut Cast<'_>, h: f64, substep: u32) {
        if self.candidates.is_empty() {
            return;
        }
        let nf = cast.figures.len();
        let total = nf + cast.free.len();
        let index = |participant: Participant| match participant {
            Participant::Figure(i) => Some(i),
            Participant::Free(i) => Some(nf + i),
            _ => None,
        };
        self.parent.clear();
        self.parent.extend(0..total);
        for c in &self.candidates {
            if let (Some(i), Some(j)) = (index(c.participant[0]), index(c.participant[1])) {
                unite(&mut self.parent, i, j);
            }
        }
        for root in 0..total {
            if find(&mut self.parent, root) != root {
                continue;
            }
            let parent = &mut self.parent;
            self.block.clear();
            self.block.resize(total, None);
            let mut mine =
                |c: &Candidate| index(c.participant[0]).is_some_and(|i| find(parent, i) == root);
            // If there are too many, keep the deepest.
            let count = self.candidates.iter().filter(|c| mine(c)).count();
            if count == 0 {
                continue;
            }
            let mut limit = f64::INFINITY;
            if count > MAX_CONTACTS {
                self.before.clear();
                let gaps = self
                    .candidates
                    .iter()
                    .filter(|c| mine(c))
                    .map(|c| c.near.gap);
                self.before.extend(gaps);
                self.before.sort_unstable_by(f64::total_cmp);
                limit = self.before[MAX_CONTACTS];
            }
            self.island.clear();
            for c in &self.candidates {
                if !mine(c) || c.near.gap >= limit {
                    continue;
                }
                let mut block = [None; 2];
                for side in 0..2 {
                    let Some(i) = index(c.participant[side]) else {
                        continue;
                    };
                    block[side] = Some(match self.block[i] {
                        Some(k) => k,
                        None => {
                            let k = add_block(&mut self.island, cast, i);
                            self.block[i] = Some(k);
                            k
                        }
                    });
                }
                add_contact(&mut self.island, cast, c, block, index, h);
            }
            if self.island.is_active(cast.figures) {
                self.finish_island(world, cast, h, substep);
            }
        }
    }

    fn finish_island(&mut self, world: &TickContext, cast: &mut Cast<'_>, h: f64, substep: u32) {
        let nf = cast.figures.len();
        let before = |cast: &Cast<'_>, participant: (usize, usize), p: Vec3| {
            let body = if participant.0 < nf {
                Participant::Figure(participant.0)
            } else if participant.0 < nf + cast.free.len() {
                Participant::Free(participant.0 - nf)
            } else if participant.0 == usize::MAX {
                Participant::Ground
            } else {
                Participant::Firm(participant.0 - nf - cast.free.len())
            };
            (body, cast.velocity(body, participant.1, p))
        };
        let outcome = self.island.solve(cast.figures);
        let r = &mut self.report;
        r.islands += 1;
        r.iterations += u64::from(outcome.iterations);
        r.unfinished += u64::from(!outcome.converged);
        // Apply the impulses to each body.
        for i in 0..nf {
            if self.block[i].is_none() {
                continue;
            }
            let impulse = self.island.figure_impulse(i).expect("it has a block");
            let figure = &mut cast.figures[i].1;
            if impulse == [0.0; NV] {
                // A figure that is near but not touched keeps the bits that it has alone.
                figure.open_substep(world, substep);
            } else {
                figure.touch(impulse, outcome);
            }
        }
        for k in 0..self.island.contacts().len() {
            let c = &self.island.contacts()[k];
            let impulse = c.world_impulse();
            if impulse == Vec3::zero() {
                continue;
            }
            r.contacts += 1;
            let (a, va) = before(cast, c.ends[0], c.position);
            let (b, vb) = before(cast, c.ends[1], c.position);
            let gravity = |participant: Participant| match participant {
                Participant::Free(_) => Vec3::Z * (h * world.gravity),
                _ => Vec3::zero(),
            };
            let u0 = va + gravity(a) - vb - gravity(b);
            let after = c.work_after();
            r.work += 0.5 * impulse.dot(u0) + 0.5 * after;
            r.driven += 0.5 * after.max(0.0);
            for (participant, part, sign, other) in [
                (a, c.ends[0].1, 1.0, (b, c.ends[1].1)),
                (b, c.ends[1].1, -1.0, (a, c.ends[0].1)),
            ] {
                let of = other.0;
                if let (Participant::Figure(i), Some(other)) =
                    (participant, cast.other(of, other.1))
                {
                    let what = Contacting {
                        segment: SegmentId::new(part).expect("parts of figures are segments"),
                        other,
                        position: c.position,
                        impulse: impulse * sign,
                        normal: c.frame[2] * sign,
                        depth: (-c.gap).max(0.0),
                        firm: matches!(of, Participant::Firm(_)),
                    };
                    cast.figures[i].1.record(&what, h, world.dt);
                }
            }
        }
        for i in 0..cast.free.len() {
            if self.block[nf + i].is_some() {
                let (linear, moment) = self.island.free_impulse(i).expect("it has a block");
                let o = &mut cast.free[i].1;
                o.push(linear, moment);
                o.force += linear * (1.0 / world.dt);
            }
        }
    }
}

fn add_block(island: &mut Island, cast: &Cast<'_>, i: usize) -> usize {
    let nf = cast.figures.len();
    if i < nf {
        return island.add_figure(i);
    }
    let o = &cast.free[i - nf].1;
    let (s, m) = (o.setup(), o.mass().expect("free bodies have a mass"));
    island.add_free(
        i - nf,
        m,
        o.inertia(),
        [o.spin(), s.velocity * m],
        [s.angular_velocity, s.velocity],
    )
}

fn add_contact(
    island: &mut Island,
    cast: &Cast<'_>,
    c: &Candidate,
    block: [Option<usize>; 2],
    index: impl Fn(Participant) -> Option<usize>,
    h: f64,
) {
    let n = &c.near;
    let nf = cast.figures.len();
    let fleshy = c
        .participant
        .iter()
        .any(|w| matches!(w, Participant::Figure(_)));
    let slop = if fleshy { FLESH } else { SLOP };
    let approach = if n.gap > 0.0 {
        n.gap / h
    } else {
        -(RETURN_SHARE * (-n.gap - slop).max(0.0) / h).min(RETURN_SPEED)
    };
    // A firm body enters with its velocity; only the second body can be firm.
    let firm = match block[1] {
        None => cast.velocity(c.participant[1], c.part[1], n.position),
        Some(_) => Vec3::zero(),
    };
    let end = |side: usize| {
        let body = index(c.participant[side]).unwrap_or(match c.participant[side] {
            Participant::Firm(k) => nf + cast.free.len() + k,
            _ => usize::MAX,
        });
        (body, c.part[side])
    };
    island.add_contact(
        block,
        [end(0), end(1)],
        *n,
        ContactLaw {
            approach,
            firm,
            mu: c.mu,
            inverse_r: 1.0 / COMPLIANCE,
        },
        |side, visit| match c.participant[side] {
            Participant::Figure(i) => {
                let t = cast.figures[i].1.substep_dynamics();
                let r = n.position - t.state.posture.root_position;
                for_each_column(&t.kin, c.part[side], r, |k, _, v| visit(k, v));
            }
            Participant::Free(i) => {
                let r = n.position - cast.free[i].1.setup().position;
                for (k, e) in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().enumerate() {
                    visit(k, e.cross(r));
                    visit(3 + k, e);
                }
            }
            _ => {}
        },
    );
}
