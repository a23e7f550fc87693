//! A body does not pass through itself: arms against trunk, head and legs, arms against each other, legs against each
//! other.
//!
//! Segments are the capsules with which they collide elsewhere ([`BodyShape`]). If two of them would come closer in a
//! substep than they may, equal and opposite impulses act at their nearest points, without friction. The impulses only
//! push, and as they act at one point, they change neither momentum nor angular momentum.
//!
//! The permitted distance of a pair depends on the desired motion: no closer than touching, or than `SLACK` deeper than
//! in the desired posture at the beginning or end of the tick, whichever is closer. Overlaps that a recording contains
//! are not resisted.
//!
//! Between the two lies soft tissue: a spring with a damper, whose force is that at the end of the substep, so that the
//! step is stable at any stiffness. The impulses are part of the momentum with which a substep is solved, so that
//! motors, limits and contacts respond to them. Each is found from the velocity at the end. While a pair is pushed too
//! little or too much, the substep is solved again, at most three times. A correction uses the mass that resists the
//! pair, for all pairs at once: first with motors, limits and floor as they were in the previous solve, and in the end
//! with every joint free. Motors and floor only add to that mass, so the last correction does not overshoot. Nothing
//! passes from one substep to the next.

use crate::body::topology::{
    ABDOMEN, CHEST, HEAD, L_FOOT, L_FOREARM, L_HAND, L_SHANK, L_THIGH, L_TOES, L_UPPER_ARM, NV,
    PELVIS, R_FOOT, R_FOREARM, R_HAND, R_SHANK, R_THIGH, R_TOES, R_UPPER_ARM, SEGMENT_COUNT,
    SegmentId,
};
use crate::body::{Body, Posture};
use crate::collide::narrow::{Near, capsules};
use crate::collide::shape::{BodyShape, Capsule};
use crate::dynamics::jacobian::for_each_column;
use crate::dynamics::{Dynamics, MassMatrix, factor, solve};
use crate::math::{Mat3, Quat, Vec3};
use crate::motion::TargetPair;
use crate::motion::leg_ik::forward;
use crate::stepper::params::contact::SPECULATIVE_HEIGHT;
use crate::stepper::params::self_contact::{RELAXATION, SLACK, STIFFNESS, TOLERANCE};

/// Most pairs that are near each other in one substep; further pairs do not collide.
pub const MAX_PAIRS: usize = 32;

/// Segments that can collide. A joint's own two segments overlap and are left out.
const PAIRS: &[(&[SegmentId], &[SegmentId])] = &[
    (
        &[L_FOREARM, L_HAND, R_FOREARM, R_HAND],
        &[
            PELVIS, ABDOMEN, CHEST, HEAD, L_THIGH, R_THIGH, L_SHANK, R_SHANK,
        ],
    ),
    (
        &[L_UPPER_ARM, R_UPPER_ARM],
        &[PELVIS, ABDOMEN, HEAD, L_THIGH, R_THIGH],
    ),
    (
        &[L_UPPER_ARM, L_FOREARM, L_HAND],
        &[R_UPPER_ARM, R_FOREARM, R_HAND],
    ),
    (
        &[L_THIGH, L_SHANK, L_FOOT, L_TOES],
        &[R_THIGH, R_SHANK, R_FOOT, R_TOES],
    ),
];

/// Facts about a body that contact with itself requires.
#[derive(Clone, Copy, Debug)]
pub struct OwnBody<'a> {
    /// Capsules of its segments.
    pub shape: &'a BodyShape,
    /// Desired motion of the tick: the body may overlap itself as deeply as this does.
    pub desired: &'a TargetPair,
}

/// Two segments that are near each other.
#[derive(Clone, Debug)]
struct SegmentPair {
    segments: [SegmentId; 2],
    /// Nearest point, world, m.
    point: Vec3,
    /// From the second segment to the first, world axes.
    normal: Vec3,
    /// Distance of the surfaces, m.
    gap: f64,
    /// Derivative of the distance by the velocity.
    row: [f64; NV],
    /// Whether the two have come closer than they may, in one of the solves of the substep.
    met: bool,
    /// Change of the velocity per impulse between them.
    answer: [f64; NV],
    /// Rate of the distance below which the two push each other, m/s; computed on demand.
    least_rate: Option<f64>,
    /// Amount by which the rate is too low, m/s.
    missing: f64,
    /// Impulse that separates the two, N·s.
    impulse: f64,
}

impl SegmentPair {
    fn rate(&self, v: &[f64; NV]) -> f64 {
        product(&self.row, v)
    }
}

fn product(a: &[f64; NV], b: &[f64; NV]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Poses of the segments of a posture.
#[derive(Clone, Debug)]
struct PlacedCapsules {
    position: [Vec3; SEGMENT_COUNT],
    rotation: [Mat3; SEGMENT_COUNT],
}

impl PlacedCapsules {
    /// Relative to the pelvis, so that nothing depends on the figure's place in the world.
    fn of(body: &Body, posture: &Posture) -> Self {
        let poses = forward(
            body,
            &Posture {
                root_position: Vec3::zero(),
                root_rotation: Quat::identity(),
                ..*posture
            },
        );
        Self {
            position: poses.map(|(at, _)| at),
            rotation: poses.map(|(_, turned)| turned.to_mat3()),
        }
    }
}

/// Whether only the distal half of a limb collides with the other segment: thighs are side by side where they come from
/// the pelvis, and shoulders are part of the trunk. A force there would turn nothing.
fn meets_with_half(limb: SegmentId, other: SegmentId) -> bool {
    let of = |all: [SegmentId; 2]| all.contains(&limb);
    let thighs = [L_THIGH, R_THIGH];
    of([L_UPPER_ARM, R_UPPER_ARM]) || of(thighs) && thighs.contains(&other)
}

/// Nearest points of two segments.
fn nearest(
    shape: &BodyShape,
    position: &[Vec3; SEGMENT_COUNT],
    rotation: &[Mat3; SEGMENT_COUNT],
    [a, b]: [SegmentId; 2],
) -> Option<Near> {
    let placed = |s: SegmentId, other: SegmentId| {
        let (i, half) = (s.index(), meets_with_half(s, other));
        let all = shape.capsules[i].iter();
        let part = move |c: &Capsule| if half { c.first_half() } else { *c };
        all.map(move |c| part(c).placed(position[i], &rotation[i]))
    };
    let mut least: Option<Near> = None;
    for first in placed(a, b) {
        for second in placed(b, a) {
            let near = capsules(&first, &second);
            if least.is_none_or(|l| near.gap < l.gap) {
                least = Some(near);
            }
        }
    }
    least
}

/// Calls `each` with the nearest points of every pair of segments that can collide, relative to the pelvis. No
/// allocation.
pub fn distances(
    body: &Body,
    shape: &BodyShape,
    posture: &Posture,
    mut each: impl FnMut([SegmentId; 2], Near),
) {
    let at = PlacedCapsules::of(body, posture);
    for (first, second) in PAIRS {
        for a in *first {
            for b in *second {
                if let Some(near) = nearest(shape, &at.position, &at.rotation, [*a, *b]) {
                    each([*a, *b], near);
                }
            }
        }
    }
}

/// Contacts of a body with itself in the current substep.
#[derive(Clone, Debug)]
pub(crate) struct SelfContact {
    pairs: Vec<SegmentPair>,
    /// The desired postures at both ends of the tick, computed on demand.
    desired: Option<[PlacedCapsules; 2]>,
    /// Factor of the inertia matrix, if it is that of this substep.
    free: MassMatrix<f64>,
    factored: bool,
    /// Length of the substep, s.
    h: f64,
}

impl Default for SelfContact {
    fn default() -> Self {
        Self {
            pairs: Vec::with_capacity(MAX_PAIRS),
            desired: None,
            free: MassMatrix::default(),
            factored: false,
            h: 0.0,
        }
    }
}

impl SelfContact {
    /// Starts a tick.
    pub fn begin(&mut self) {
        self.desired = None;
    }

    /// Starts a substep of `h` s: finds the pairs that are near each other or could collide. No allocation.
    pub fn open(&mut self, own: Option<&OwnBody<'_>>, terms: &Dynamics, h: f64) {
        self.pairs.clear();
        self.factored = false;
        self.h = h;
        let Some(OwnBody { shape, .. }) = own else {
            return;
        };
        let kin = &terms.kin;
        let balls: [(Vec3, f64); SEGMENT_COUNT] = std::array::from_fn(|s| {
            let (centre, radius) = shape.bound[s];
            let r = kin.rotation[s] * centre;
            let speed =
                (kin.velocity[s] + kin.omega[s].cross(r)).norm() + kin.omega[s].norm() * radius;
            (
                kin.position[s] + r,
                radius + h * speed + 0.5 * SPECULATIVE_HEIGHT,
            )
        });
        for (first, second) in PAIRS {
            for a in *first {
                for b in *second {
                    let ((p, r), (q, s)) = (balls[a.index()], balls[b.index()]);
                    let (d, reach) = (p - q, r + s);
                    if d.dot(d) < reach * reach && self.pairs.len() < MAX_PAIRS {
                        self.look_at(shape, terms, [*a, *b]);
                    }
                }
            }
        }
    }

    /// Adds a pair if it is near or approaching.
    fn look_at(&mut self, shape: &BodyShape, terms: &Dynamics, segments: [SegmentId; 2]) {
        let kin = &terms.kin;
        let Some(near) = nearest(shape, &kin.position, &kin.rotation, segments) else {
            return;
        };
        let velocity = |s: SegmentId| {
            let i = s.index();
            kin.velocity[i] + kin.omega[i].cross(near.position - kin.position[i])
        };
        let [a, b] = segments;
        let rate = near.normal.dot(velocity(a) - velocity(b));
        if near.gap > SPECULATIVE_HEIGHT && near.gap + self.h * rate > 0.0 {
            return;
        }
        let mut row = [0.0; NV];
        for (sign, s) in [(1.0, a), (-1.0, b)] {
            for_each_column(kin, s.index(), near.position, |i, _, v| {
                row[i] += sign * v.dot(near.normal)
            });
        }
        self.pairs.push(SegmentPair {
            segments,
            point: terms.state.posture.root_position + near.position,
            normal: near.normal,
            gap: near.gap,
            row,
            met: false,
            answer: [0.0; NV],
            least_rate: None,
            missing: 0.0,
            impulse: 0.0,
        });
    }

    /// Corrects the impulses for a substep at whose end the velocity would be `v`. Returns `false` if that changes
    /// nothing: no pair comes closer than it may, and none is pushed more than necessary. No allocation.
    ///
    /// * `own`: shape and desired posture of the body; without it the body passes through itself.
    /// * `mass`: inertia matrix of the substep.
    /// * `solved`: factor of the matrix with which the substep was solved, stiffness of motors, limits and contacts
    ///   included; without it every joint counts as free.
    pub fn correct(
        &mut self,
        body: &Body,
        own: Option<&OwnBody<'_>>,
        mass: &MassMatrix<f64>,
        solved: Option<&MassMatrix<f64>>,
        v: &[f64; NV],
    ) -> bool {
        let Some(own) = own else {
            return false;
        };
        let mut off = false;
        for k in 0..self.pairs.len() {
            let pair = &self.pairs[k];
            let rate = pair.rate(v);
            let parted = pair.impulse == 0.0;
            if parted && pair.gap + self.h * rate >= 0.0 {
                self.pairs[k].missing = 0.0;
                continue;
            }
            let given = self.compliance() * self.pairs[k].impulse;
            let missing = self.least_rate(own, body, k) - rate - given;
            off |= missing > TOLERANCE || (!parted && missing < -TOLERANCE);
            self.pairs[k].met |= missing > 0.0;
            self.pairs[k].missing = missing;
        }
        if off {
            self.push(mass, solved);
        }
        off
    }

    /// Rate at which tissue yields per impulse, 1/kg. Its force is that at the end of the substep: stiffness times
    /// depth, and damping times rate.
    fn compliance(&self) -> f64 {
        1.0 / (STIFFNESS * self.h * (self.h + RELAXATION))
    }

    /// Rate of the distance of pair `k` below which its tissue pushes, m/s: the remaining gap may close within the
    /// substep.
    fn least_rate(&mut self, own: &OwnBody<'_>, body: &Body, k: usize) -> f64 {
        let SegmentPair {
            segments,
            gap,
            least_rate,
            ..
        } = self.pairs[k];
        if let Some(known) = least_rate {
            return known;
        }
        let TargetPair { now, next } = own.desired;
        let desired = self
            .desired
            .get_or_insert_with(|| [now, next].map(|t| PlacedCapsules::of(body, &t.posture)));
        let deepest = desired.iter().fold(0.0f64, |least, at| {
            let near = nearest(own.shape, &at.position, &at.rotation, segments);
            near.map_or(least, |near| least.min(near.gap - SLACK))
        });
        let left = gap - deepest;
        let rate = -left
            / if left > 0.0 {
                self.h
            } else {
                self.h + RELAXATION
            };
        self.pairs[k].least_rate = Some(rate);
        rate
    }

    /// Corrects the impulses of all pairs in contact. Each uses the mass from the sum of its row of `J M⁻¹ Jᵀ`, so that
    /// together they give no pair more than it needs.
    fn push(&mut self, mass: &MassMatrix<f64>, solved: Option<&MassMatrix<f64>>) {
        if solved.is_none() && !self.factored {
            self.free.rows = mass.rows;
            factor(&mut self.free);
            self.factored = true;
        }
        let matrix = solved.unwrap_or(&self.free);
        for pair in self.pairs.iter_mut().filter(|p| p.met) {
            pair.answer = pair.row;
            solve(matrix, &mut pair.answer);
        }
        for k in 0..self.pairs.len() {
            let SegmentPair {
                met,
                missing,
                impulse,
                ..
            } = self.pairs[k];
            if met {
                let others = self.pairs.iter().filter(|p| p.met);
                let answers = others.map(|p| product(&p.row, &self.pairs[k].answer).abs());
                let mobility = answers.sum::<f64>() + self.compliance();
                self.pairs[k].impulse = (impulse + missing / mobility).max(0.0);
            }
        }
    }

    /// Adds the impulses to a momentum.
    pub fn add_to(&self, momentum: &mut [f64; NV]) {
        for pair in self.pairs.iter().filter(|p| p.impulse > 0.0) {
            for (x, r) in momentum.iter_mut().zip(&pair.row) {
                *x += pair.impulse * r;
            }
        }
    }

    /// The forces of the substep: segment, world point, world force, N.
    pub fn forces(&self) -> impl Iterator<Item = (SegmentId, Vec3, Vec3)> {
        let pushed = self.pairs.iter().filter(|p| p.impulse > 0.0);
        pushed.flat_map(|p| {
            let force = p.normal * (p.impulse / self.h);
            [
                (p.segments[0], p.point, force),
                (p.segments[1], p.point, -force),
            ]
        })
    }
}

#[cfg(test)]
mod tests;
