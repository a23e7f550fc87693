//! Moments at which a motion resembles the beginning of another one.

use crate::body::{Body, Posture};
use crate::math::{Quat, Vec3, trig};
use crate::motion::GRAVITY;
use crate::motion::clip::PlanarTransform;
use crate::motion::leg_ik::{center_of_mass, forward};
use crate::plan::foot_lock::{AnklePose, FootPlacement, Sole};
use crate::plan::likeness::unlike;
use crate::plan::params::{balance, likeness, stop, transition};
use crate::plan::splice::Sample;
use crate::plan::turned_on_floor;
use serde::{Deserialize, Serialize};

/// A moment at which a motion resembles the beginning of another one.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Moment {
    /// Sample at which the first one is left.
    pub left: usize,
    /// Samples from the start of the second motion to the one at which it is entered.
    pub entered: usize,
    /// Resulting place of the origin of the second motion.
    pub place: PlanarTransform,
    /// Distance of the capture points, m.
    pub capture: f64,
    /// Unlikeness of the postures, rad rms.
    pub unlike: f64,
    /// Distance of the other feet, m.
    pub step: f64,
    /// Turn of the standing foot, rad.
    pub turn: f64,
}

/// The features by which a motion is compared.
pub(super) struct Features<'a> {
    samples: &'a [Sample],
    pub com: Vec<Vec3>,
    pub feet: Vec<[FootPlacement; 2]>,
}

impl<'a> Features<'a> {
    pub fn new(body: &Body, samples: &'a [Sample]) -> Self {
        let soles = [Sole::new(body, 0), Sole::new(body, 1)];
        let of = |(posture, _): &Sample| {
            let poses = forward(body, posture);
            let feet = [0, 1].map(|side| soles[side].footing(AnklePose::of(&poses, side)));
            (center_of_mass(body, &poses), feet)
        };
        let (com, feet) = samples.iter().map(of).unzip();
        Self { samples, com, feet }
    }

    fn posture(&self, i: usize) -> &Posture {
        &self.samples[i].0
    }

    /// Feet planted at sample `i` and at both of its neighbours; `None` where that changes.
    fn planted(&self, i: usize) -> Option<[bool; 2]> {
        let p = self.samples[i].1;
        let same = |k: usize| self.samples[k].1 == p;
        (p != [false; 2] && same(i - 1) && same(i + 1)).then_some(p)
    }

    /// The points from which the turn between two motions is found, seen from foot `side`: centre of mass, the part of
    /// the capture point that comes from its velocity, the other foot, and the headings of pelvis and foot.
    fn points(&self, i: usize, side: usize, omega: f64) -> [[f64; 2]; 5] {
        let at = self.feet[i][side].place;
        let from = |p: Vec3| [p.x - at.x, p.y - at.y];
        let v = (self.com[i + 1] - self.com[i - 1]) * (0.5 * stop::RATE / omega);
        let ahead = |q: Quat, long: f64| {
            let x = q.rotate(Vec3::X);
            let level = x.level().max(1e-9);
            x.xy().map(|c| long * c / level)
        };
        let foot = Quat::exp(Vec3::Z * self.feet[i][side].yaw);
        [
            from(self.com[i]),
            v.xy(),
            from(self.feet[i][1 - side].place),
            ahead(self.posture(i).root_rotation, transition::PELVIS_HEADING),
            ahead(foot, transition::FOOT_HEADING),
        ]
    }
}

/// The turn that brings points `b` nearest to points `a`, rad (Kovar, Gleicher & Pighin 2002, without the shift: both
/// are seen from the planted foot).
fn nearest_turn(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    let (mut dot, mut cross) = (0.0, 0.0);
    for (p, q) in a.iter().zip(b) {
        dot += p[0] * q[0] + p[1] * q[1];
        cross += q[0] * p[1] - q[1] * p[0];
    }
    trig::atan2(cross, dot)
}

pub(super) fn far(a: [f64; 2], b: [f64; 2]) -> f64 {
    (Vec3::on_floor(a) - Vec3::on_floor(b)).level()
}

/// Compares sample `i` of one motion with sample `j` of another: returns the cost of going from one to the other and
/// the moment itself; `None` if they are not alike.
fn compare(
    left: &Features<'_>,
    i: usize,
    entered: &Features<'_>,
    j: usize,
) -> Option<(f64, Moment)> {
    let planted = left.planted(i)?;
    if entered.planted(j)? != planted {
        return None;
    }
    let omega = (GRAVITY / left.com[i].z.max(balance::LEAST_HEIGHT)).sqrt();
    // Of two planted feet, use the one that stays longer.
    let stays = |s: usize| {
        let on = entered.samples[j..].iter().take_while(|k| k.1[s]);
        on.count()
    };
    let side = match planted {
        [true, false] => 0,
        [false, true] => 1,
        _ => usize::from(stays(1) > stays(0)),
    };
    let a = left.points(i, side, omega);
    let b = entered.points(j, side, omega);
    let yaw = nearest_turn(&a, &b);
    let b = b.map(|p| turned_on_floor(p, yaw));
    let sum = |p: &[[f64; 2]; 5]| [p[0][0] + p[1][0], p[0][1] + p[1][1]];
    let capture = far(sum(&a), sum(&b));
    let step = far(a[2], b[2]);
    let (from, to) = (&entered.feet[j][side], &left.feet[i][side]);
    let turn = trig::wrapped(to.yaw - from.yaw - yaw).abs();
    if capture > transition::MOST_CAPTURE
        || step > transition::MOST_STEP
        || turn > transition::MOST_TURN
    {
        return None;
    }
    let around = |f: &Features<'_>, k: usize| [k - 1, k, k + 1].map(|k| *f.posture(k));
    let unlike = unlike(&around(left, i), &around(entered, j));
    if unlike > likeness::TRANSITION {
        return None;
    }
    let at = turned_on_floor([from.place.x, from.place.y], yaw);
    let moment = Moment {
        left: i,
        entered: j - 1,
        place: PlanarTransform {
            x: to.place.x - at[0],
            y: to.place.y - at[1],
            yaw,
        },
        capture,
        unlike,
        step,
        turn,
    };
    let parts = [
        capture / transition::MOST_CAPTURE,
        unlike / likeness::TRANSITION,
        step / transition::MOST_STEP,
        turn / transition::MOST_TURN,
    ];
    let wait = transition::WAITING_COST * i as f64 / stop::RATE;
    Some((parts.iter().map(|p| p * p).sum::<f64>() + wait, moment))
}

/// The moments from sample `from` of `left` on at which `left` resembles the beginning of `entered`, most alike first.
/// The first sample of `entered` is the one before its beginning.
pub(super) fn moments(left: &Features<'_>, from: usize, entered: &Features<'_>) -> Vec<Moment> {
    let mut found: Vec<(f64, Moment)> = Vec::new();
    for i in (from.max(1)..left.samples.len().saturating_sub(1)).step_by(transition::STRIDE) {
        let beginnings = (1..entered.samples.len() - 1).step_by(transition::STRIDE);
        let like = beginnings.filter_map(|j| compare(left, i, entered, j));
        found.extend(like.min_by(|a, b| a.0.total_cmp(&b.0)));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut out: Vec<Moment> = Vec::new();
    for (_, moment) in found {
        let near = |m: &Moment| m.left.abs_diff(moment.left) < transition::CANDIDATE_STRIDE;
        if out.len() < transition::CANDIDATES && !out.iter().any(near) {
            out.push(moment);
        }
    }
    out
}
