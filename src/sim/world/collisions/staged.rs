//! Collisions of figures that are moved by their accelerations, in the two stages of §3 of the paper: the impact
//! changes velocities, then angles are corrected until nothing overlaps. The reaction is a contact force in the next
//! tick: the controller includes it in its inverse dynamics, so a part keeps touching as long as there is enough torque
//! to press it on, and parts otherwise.

use super::cast::Cast;
use super::{Candidate, Cluster, Participant};
use crate::body::SegmentId;
use crate::body::topology::NV;
use crate::dynamics::jacobian::for_each_column;
use crate::dynamics::terms::WIDTH;
use crate::figure::params::staged::{CORRECTION, CORRECTIONS, OVERLAP};
use crate::figure::touches::Contacting;
use crate::math::Vec3;
use crate::paper::impact::{Impact, ImpactRow};
use crate::tick_context::TickContext;

/// Purpose of one system.
#[derive(Clone, Copy, PartialEq)]
enum StagedPass {
    Impact,
    Correction,
}

impl Cluster {
    /// Whether a pair can meet in stages: staged figures, and obstacles that do not move freely.
    pub(super) fn in_stages(cast: &Cast<'_>, pair: [Participant; 2]) -> bool {
        pair.into_iter().all(|p| match p {
            Participant::Figure(i) => cast.figures[i].1.meets_in_stages(),
            Participant::Firm(_) => true,
            _ => false,
        })
    }

    /// Both stages, for figures that have moved by their accelerations in this tick, with `pairs` of such figures.
    ///
    /// Section 3 of the paper.
    pub(super) fn meet(&mut self, world: &TickContext, cast: &mut Cast<'_>) {
        if self.staged.is_empty() {
            return;
        }
        std::mem::swap(&mut self.pairs, &mut self.staged);
        self.find_staged(world, cast);
        if self.set_up(world, cast, StagedPass::Impact) {
            self.impact.solve();
            self.apply_impact(world, cast);
        }
        for _ in 0..CORRECTIONS {
            self.find_staged(world, cast);
            if !self.set_up(world, cast, StagedPass::Correction) {
                break;
            }
            self.impact.solve();
            for (i, (_, f)) in cast.figures.iter_mut().enumerate() {
                if let Some(b) = self.block[i] {
                    f.correct(self.impact.velocity(b));
                }
            }
        }
        std::mem::swap(&mut self.pairs, &mut self.staged);
    }

    /// Finds the contacts of the figures in their new state.
    fn find_staged(&mut self, world: &TickContext, cast: &mut Cast<'_>) {
        for (_, f) in cast.figures.iter_mut() {
            if f.meets_in_stages() {
                f.show_moved(world);
            }
        }
        self.find_contacts(cast, 0.0, world.dt);
        let deep = |c: &Candidate| c.near.gap <= 0.0 && Self::in_stages(cast, c.participant);
        self.candidates.retain(deep);
    }

    /// Sets up the rows of the present candidates. Returns false if there is nothing to do.
    fn set_up(&mut self, world: &TickContext, cast: &Cast<'_>, stage: StagedPass) -> bool {
        self.impact.clear();
        self.block.clear();
        self.block.resize(cast.figures.len(), None);
        let matters = |c: &Candidate| stage == StagedPass::Impact || c.near.gap < -OVERLAP;
        if !self.candidates.iter().any(matters) {
            return false;
        }
        // Feet come first, because they must hold even if other rows are left out for lack of room.
        for c in self.candidates.iter().filter(|c| matters(c)) {
            for participant in c.participant {
                let Participant::Figure(i) = participant else {
                    continue;
                };
                if self.block[i].is_some() {
                    continue;
                }
                let f = &cast.figures[i].1;
                let t = f.substep_dynamics();
                let velocity = match stage {
                    StagedPass::Impact => t.state.velocity,
                    StagedPass::Correction => [0.0; NV],
                };
                let b = self.impact.add_body(&t.mass_matrix, &velocity);
                self.block[i] = Some(b);
                // A foot pulls on the floor by at most the impulse of the body's weight in this tick.
                let least = match stage {
                    StagedPass::Impact => -t.composite.mass[0] * world.gravity * world.dt,
                    StagedPass::Correction => f64::NEG_INFINITY,
                };
                hold_feet(&mut self.impact, f, b, least);
            }
        }
        self.rows.clear();
        for (k, c) in self.candidates.iter().enumerate() {
            if !matters(c) {
                continue;
            }
            let mut row = ImpactRow::new([None; 2], HOLDS + k);
            (row.least, row.one_sided) = (0.0, true);
            for side in 0..2 {
                let n = c.near.normal * if side == 0 { 1.0 } else { -1.0 };
                match c.participant[side] {
                    Participant::Figure(i) => {
                        row.bodies[side] = self.block[i];
                        let t = cast.figures[i].1.substep_dynamics();
                        let r = c.near.position - t.state.posture.root_position;
                        let j = &mut row.jacobian[side];
                        for_each_column(&t.kin, c.part[side], r, |d, _, v| j[d] = n.dot(v));
                    }
                    other if stage == StagedPass::Impact => {
                        row.wanted -= n.dot(cast.velocity(other, c.part[side], c.near.position));
                    }
                    _ => {}
                }
            }
            if stage == StagedPass::Correction {
                row.wanted = (-c.near.gap - OVERLAP).min(CORRECTION);
            }
            if self.impact.add_row(row) {
                self.rows.push(k);
            }
        }
        true
    }

    /// Gives the figures their velocities and their touches.
    fn apply_impact(&mut self, world: &TickContext, cast: &mut Cast<'_>) {
        let first = self.impact.rows() - self.rows.len();
        for (at, &k) in self.rows.iter().enumerate() {
            let (c, p) = (&self.candidates[k], self.impact.impulse(first + at));
            self.report.contacts += u64::from(p > 0.0);
            for side in 0..2 {
                let (me, other) = (c.participant[side], c.participant[1 - side]);
                let (Participant::Figure(i), Some(what)) =
                    (me, cast.other(other, c.part[1 - side]))
                else {
                    continue;
                };
                let normal = c.near.normal * if side == 0 { 1.0 } else { -1.0 };
                let contacting = Contacting {
                    segment: SegmentId::new(c.part[side]).expect("parts of figures are segments"),
                    other: what,
                    position: c.near.position,
                    impulse: normal * p,
                    normal,
                    depth: (-c.near.gap).max(0.0),
                    firm: matches!(other, Participant::Firm(_)),
                };
                cast.figures[i].1.record_impact(&contacting, world.dt);
            }
        }
        for (i, (_, f)) in cast.figures.iter_mut().enumerate() {
            if let Some(b) = self.block[i] {
                f.set_velocity(self.impact.velocity(b));
            }
        }
    }
}

/// Groups of rows below this number belong to supports that hold.
const HOLDS: usize = 1 << 16;

/// Adds rows that keep the supports of the figure still: whole feet, or the point about which a foot tips.
fn hold_feet(impact: &mut Impact, f: &crate::figure::Figure, body: usize, least: f64) {
    let t = f.substep_dynamics();
    for (n, (segment, point)) in f.held_still().into_iter().flatten().enumerate() {
        let group = 4 * body + n;
        let s = segment.index();
        let mut jacobian = [[0.0; WIDTH]; 6];
        match point {
            None => t.segment_jacobian(s, &mut jacobian),
            Some(p) => {
                let r = p - t.state.posture.root_position;
                for_each_column(&t.kin, s, r, |d, _, v: Vec3| {
                    (jacobian[3][d], jacobian[4][d], jacobian[5][d]) = (v.x, v.y, v.z);
                });
            }
        }
        let rows = if point.is_some() { 3..6 } else { 0..6 };
        for k in rows {
            let mut row = ImpactRow::new([Some(body), None], group);
            row.jacobian[0].copy_from_slice(&jacobian[k][..NV]);
            // Only the vertical force decides whether it pulls.
            if k == 5 {
                row.least = least;
            }
            impact.add_row(row);
        }
    }
}
