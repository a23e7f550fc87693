//! The path from one motion into another at a moment at which they are alike.
//!
//! Both motions can already be followed, so parts that agree stay as they are: without a difference there is no change.
//! Any difference fades from the seam on. A planted foot stays in its place until it leaves the floor, legs follow the
//! feet, and the pelvis is shifted where the zero-moment point would leave the support.

use super::candidates::Moment;
use super::{NextClip, TransitionClip, samples_in};
use crate::body::angles::clamp_to_limits;
use crate::body::topology::{DOF_START, FEET, L_THIGH, L_UPPER_ARM, NV};
use crate::body::{Body, Posture};
use crate::math::curve::{fade, smootherstep};
use crate::math::{Vec3, trig};
use crate::motion::clip::Clip;
use crate::motion::leg_ik::{forward, knee_axis, solve_leg_in_plane};
use crate::plan::ankle_torque_limit::AnkleTorqueLimit;
use crate::plan::cycle::relabel_prepared;
use crate::plan::envelope::smoothest_below;
use crate::plan::feasibility::infeasibility;
use crate::plan::foot_lock::{FootPlacement, FootPose, LockedFoot, Sole};
use crate::plan::leg_reach::leg_geometry;
use crate::plan::params::{balance, leg, stop, transition};
use crate::plan::pelvis_shift::{ShiftProblem, mass_track, pelvis_shift};
use crate::plan::prepare::{
    StandingFeet, limit_ankle_torques, other_support, planted_of, support_phases,
};
use crate::plan::splice::Sample;
use crate::plan::toe_hinge;
use crate::time::MotionTime;

/// A difference before, at and after the seam, which fades from there on.
struct FadingOffset<const N: usize>([[f64; N]; 3]);

impl<const N: usize> FadingOffset<N> {
    /// The remaining difference `k` samples after the seam, if it fades within `span` samples.
    fn left(&self, k: usize, span: impl Fn(usize) -> f64) -> [f64; N] {
        let [before, at, after] = &self.0;
        std::array::from_fn(|c| {
            let span = span(c);
            let u = k as f64 / span;
            let slope = 0.5 * (after[c] - before[c]) * span;
            let bend = (after[c] - 2.0 * at[c] + before[c]) * span * span;
            if u < 1.0 {
                fade(at[c], slope, bend, u)
            } else {
                0.0
            }
        })
    }
}

/// Both motions at the seam.
struct MotionSeam {
    soles: [Sole; 2],
    /// The motion that is left, before, at and after the seam.
    left: [Posture; 3],
    /// The motion that is entered, from the sample before the seam on.
    entered: Vec<Sample>,
    /// Feet that the entered motion has on the floor, from the seam on.
    label: Vec<[bool; 2]>,
    /// Foot poses of the entered motion from the sample before the seam on, and of the motion that is left before, at
    /// and after it.
    feet: Vec<[FootPose; 2]>,
    from: [[FootPose; 2]; 3],
}

fn feet_of(body: &Body, posture: &Posture) -> [FootPose; 2] {
    let poses = forward(body, posture);
    std::array::from_fn(|s| {
        let (ankle, rotation) = poses[FEET[s].index()];
        let toe = posture.hinge[toe_hinge(s)];
        FootPose {
            ankle,
            rotation,
            toe,
        }
    })
}

fn stood(sole: &Sole, pose: &FootPose) -> FootPlacement {
    sole.footing(pose.without_toes())
}

/// The place at which one motion turns into the next.
#[derive(Clone, Copy)]
pub(super) struct ClipEntry<'a> {
    pub(super) moment: &'a Moment,
    /// Time of the next motion at which it is entered.
    pub(super) enters: MotionTime,
}

impl MotionSeam {
    /// * `known`: the motion that is left; `count`: number of samples of `next` to look at.
    fn new(
        body: &Body,
        known: &[Sample],
        next: &NextClip,
        entry: ClipEntry<'_>,
        count: usize,
    ) -> Self {
        let ClipEntry { moment, enters } = entry;
        let at = moment.left;
        let mut entered = next.samples(enters - next.speed / stop::RATE, count + 1);
        for (posture, _) in &mut entered {
            moment.place.apply_posture(posture);
        }
        let (postures, planted): (Vec<_>, Vec<_>) = entered.iter().copied().unzip();
        let left = [at - 1, at, at + 1].map(|i| known[i].0);
        Self {
            soles: [Sole::new(body, 0), Sole::new(body, 1)],
            label: relabel_prepared(body, stop::RATE, &postures, &planted).split_off(1),
            feet: postures.iter().map(|p| feet_of(body, p)).collect(),
            from: [0, 1, 2].map(|k: usize| feet_of(body, &left[k])),
            left,
            entered,
        }
    }

    /// Posture of the second motion `k` samples after the seam.
    fn to(&self, k: usize) -> &Posture {
        &self.entered[k + 1].0
    }

    /// Postures from the seam on: those of the second motion plus the remaining difference.
    fn postures(&self, count: usize) -> Vec<Posture> {
        let off = |k: usize| self.entered[k].0.difference(&self.left[k]);
        let off: FadingOffset<NV> = FadingOffset([off(0), off(1), off(2)]);
        let arms = 6 + DOF_START[L_UPPER_ARM.index()]..6 + DOF_START[L_THIGH.index()];
        let span = |d: usize| {
            stop::RATE
                * if arms.contains(&d) {
                    transition::ARM_BLEND_TIME
                } else {
                    transition::BLEND_TIME
                }
        };
        let posture = |k: usize| {
            let mut p = *self.to(k);
            p.integrate(&off.left(k, span), 1.0);
            p
        };
        (0..count).map(posture).collect()
    }

    /// Samples after the seam at which foot `side` first changes between planted and not.
    fn first_change(&self, side: usize) -> usize {
        let here = self.label[0][side];
        let other = |l: &[bool; 2]| l[side] != here;
        let change = self.label.iter().position(other);
        change.unwrap_or(self.label.len())
    }

    /// Poses of a foot from the seam on. A planted foot stays where it is until it leaves the floor; for a swinging one
    /// the difference fades.
    fn lead(&self, side: usize) -> Vec<FootPose> {
        let sole = &self.soles[side];
        let change = self.first_change(side);
        let mut out: Vec<_> = self.feet[1..].iter().map(|f| f[side]).collect();
        let within = |samples: usize| {
            (stop::RATE * transition::BLEND_TIME)
                .min(samples as f64)
                .max(stop::RATE * transition::LEAST_BLEND_TIME)
        };
        if !self.label[0][side] {
            let off = |k: usize| self.from[k][side].offset_from(&self.feet[k][side]);
            let off = FadingOffset([off(0), off(1), off(2)]);
            for (k, pose) in out.iter_mut().enumerate() {
                *pose = pose.moved(&off.left(k, |_| within(change)));
            }
            return out;
        }
        let pitch = |k: usize| {
            let [is, should] = [&self.from[k], &self.feet[k]].map(|f| stood(sole, &f[side]));
            [is.pitch - should.pitch]
        };
        let pitch = FadingOffset([pitch(0), pitch(1), pitch(2)]);
        let FootPlacement { place, yaw, .. } = stood(sole, &self.from[1][side]);
        let mut last = [0.0; 7];
        for (k, pose) in out.iter_mut().enumerate().take(change) {
            let pitched = stood(sole, pose).pitch + pitch.left(k, |_| within(change))[0];
            let stands = sole.stand(place, yaw, pitched);
            last = stands.offset_from(pose);
            *pose = pose.moved(&last);
        }
        let landed = self.label[change..].iter().position(|l| l[side]);
        let off = FadingOffset([last; 3]);
        let span = within(landed.unwrap_or(usize::MAX));
        for (k, pose) in out[change..].iter_mut().enumerate() {
            *pose = pose.moved(&off.left(k, |_| span));
        }
        out
    }

    /// Samples after the seam from which foot `side` is where the second motion has it, that is, after it has next come
    /// down. `None` if that does not happen.
    fn follows_from(&self, side: usize) -> Option<usize> {
        let change = self.first_change(side);
        if !self.label[0][side] {
            return (change < self.label.len()).then_some(change);
        }
        if let Some(k) = self.label[change..].iter().position(|l| l[side]) {
            return Some(change + k);
        }
        let sole = &self.soles[side];
        let [is, should] = [&self.from[1], &self.feet[1]].map(|f| stood(sole, &f[side]));
        let stays = change == self.label.len();
        let near = (is.place - should.place).norm() < transition::SAME_PLACE
            && trig::wrapped(is.yaw - should.yaw).abs() < transition::SAME_HEADING;
        (stays && near).then_some(0)
    }

    /// Samples after the seam at which the clip itself can take over.
    fn ends(&self) -> Option<usize> {
        let led = self.follows_from(0)?.max(self.follows_from(1)?);
        let earliest =
            led.max(samples_in(transition::ARM_BLEND_TIME)) + samples_in(transition::SHIFT_EDGE);
        let steady = |k: &usize| {
            let around = &self.label[k - transition::STEADY..=k + transition::STEADY];
            around.iter().all(|l| *l == self.label[*k])
        };
        let latest = samples_in(transition::LONGEST).min(self.label.len() - transition::STEADY - 1);
        (earliest..=latest).find(steady)
    }
}

/// A motion on its way to becoming one that a body can follow.
struct SeamMotion<'a> {
    body: &'a Body,
    soles: &'a [Sole; 2],
    /// Postures before legs are solved and the pelvis is moved.
    postures: Vec<Posture>,
    label: Vec<[bool; 2]>,
    feet: [LockedFoot; 2],
    /// The share of a shift of the pelvis that each sample takes.
    share: Vec<f64>,
}

impl SeamMotion<'_> {
    /// Postures with the pelvis shifted and lowered, m, and the feet in their places.
    fn with(&self, shift: &[[f64; 2]], drop: &[f64]) -> Vec<Posture> {
        let posture = |i: usize| {
            let mut p = self.postures[i];
            if self.share[i] <= 0.0 {
                return p;
            }
            p.root_position += Vec3 {
                z: drop[i],
                ..Vec3::on_floor(shift[i])
            };
            for (s, foot) in self.feet.iter().enumerate() {
                let to = &foot.poses[i];
                let axis = knee_axis(&self.postures[i], s == 0);
                let pose = (to.ankle, to.rotation);
                solve_leg_in_plane(self.body, &mut p, s == 0, pose, to.toe, axis);
            }
            clamp_to_limits(self.body, &mut p, 0.0);
            p
        };
        (0..self.postures.len()).map(posture).collect()
    }

    /// How far the pelvis comes down so that planted legs reach, m.
    fn drop(&self) -> Vec<f64> {
        let legs = [0, 1].map(|side| leg_geometry(self.body, side));
        let lacks = |i: usize| {
            let p = &self.postures[i];
            let needs = legs.iter().zip(&self.feet).map(|((hip, length), foot)| {
                if !foot.planted[i] {
                    return 0.0;
                }
                let d = p.root_position + p.root_rotation.rotate(*hip) - foot.poses[i].ankle;
                let level = d.x * d.x + d.y * d.y;
                (leg::SEAM_REACH * leg::SEAM_REACH * length * length - level)
                    .max(0.0)
                    .sqrt()
                    - d.z
            });
            self.share[i] * needs.fold(0.0, f64::min)
        };
        let lacks: Vec<f64> = (0..self.postures.len()).map(lacks).collect();
        let drop = smoothest_below(&lacks, leg::DROP_TIME, stop::RATE);
        drop.iter().zip(&self.share).map(|(d, s)| s * d).collect()
    }

    /// Postures with the pelvis shifted so that the zero-moment point stays in the support.
    fn balanced(&self) -> Vec<Posture> {
        let n = self.postures.len();
        let limit = AnkleTorqueLimit::new(self.body);
        let feet = StandingFeet {
            soles: self.soles,
            locked: &self.feet,
            carries: &planted_of(&self.feet),
        };
        let phases = support_phases(self.body, feet, &self.postures, &self.label);
        let other_support = other_support(self.body, &self.postures, &self.label, stop::RATE);
        let drop = self.drop();
        let mut shift = vec![[0.0; 2]; n];
        let mut postures = self.with(&shift, &drop);
        for _ in 0..balance::SEAM_ROUNDS {
            let track = mass_track(self.body, &postures, stop::RATE);
            shift = pelvis_shift(&ShiftProblem {
                support: &limit_ankle_torques(&phases, feet, &limit, &track, false, stop::RATE),
                track: &track,
                so_far: &shift,
                other_support: &other_support,
                inset: balance::INSET,
                rate_hz: stop::RATE,
            });
            for (s, share) in shift.iter_mut().zip(&self.share) {
                *s = s.map(|x| share * x);
            }
            postures = self.with(&shift, &drop);
        }
        postures
    }

    /// Largest distance of a planted foot from its place, m.
    fn stray(&self, postures: &[Posture]) -> f64 {
        let mut worst = 0.0f64;
        for (i, p) in postures.iter().enumerate() {
            let is = feet_of(self.body, p);
            for s in (0..2).filter(|s| self.label[i][*s]) {
                let stray = self.soles[s].stray(is[s].without_toes(), &self.feet[s].poses[i]);
                worst = worst.max(stray);
            }
        }
        worst
    }
}

/// The path out of a motion at a moment, and the unsupported part of the force it needs, as a share of the weight.
///
/// * `known`: the motion; it plays unchanged up to sample `now`.
pub(super) fn transition_at(
    body: &Body,
    known: &[Sample],
    now: usize,
    next: &NextClip,
    entry: ClipEntry<'_>,
) -> Option<(f64, TransitionClip)> {
    let ClipEntry { moment, enters } = entry;
    let at = moment.left;
    let count = samples_in(transition::LONGEST) + transition::STEADY + 2;
    let seam = MotionSeam::new(body, known, next, entry, count);
    let ends = seam.ends()?;
    let count = (ends + samples_in(transition::MARGIN)).min(count);

    let held = now.max(at.saturating_sub(samples_in(transition::RUN_UP)));
    let cut = held.saturating_sub(samples_in(transition::MARGIN));
    let (mut postures, planted): (Vec<_>, Vec<_>) = known[cut..at].iter().copied().unzip();
    let mut label = relabel_prepared(body, stop::RATE, &postures, &planted);
    let mut poses: Vec<[FootPose; 2]> = postures.iter().map(|p| feet_of(body, p)).collect();
    postures.extend(seam.postures(count));
    label.extend_from_slice(&seam.label[..count]);
    let (left, right) = (seam.lead(0), seam.lead(1));
    poses.extend((0..count).map(|k| [left[k], right[k]]));
    let n = postures.len();
    let feet = [0, 1].map(|s: usize| {
        let placements = poses.iter().map(|f| stood(&seam.soles[s], &f[s]));
        LockedFoot {
            placements: placements.collect(),
            planted: label.iter().map(|l| l[s]).collect(),
            poses: poses.iter().map(|f| f[s]).collect(),
            slide_before: 0.0,
        }
    });
    let ends_at = at - cut + ends;
    let share = |i: usize| {
        let since = (i + cut).saturating_sub(held) as f64;
        let until = ends_at.saturating_sub(i) as f64;
        smootherstep(since.min(until) / (transition::SHIFT_EDGE * stop::RATE))
    };
    let draft = SeamMotion {
        body,
        soles: &seam.soles,
        postures,
        label,
        feet,
        share: (0..n).map(share).collect(),
    };
    let mut postures = draft.balanced();
    let stray = draft.stray(&postures);
    for k in ends..count {
        postures[at - cut + k] = *seam.to(k);
    }
    let from = (held - cut).saturating_sub(4);
    let asked = infeasibility(body, &postures[from..], &draft.label[from..]);
    if stray > transition::MOST_STRAY {
        return None;
    }

    let (mut all, mut planted): (Vec<_>, Vec<_>) = known[..at].iter().copied().unzip();
    all.truncate(cut);
    all.extend(postures);
    planted.extend(seam.entered[1..=count].iter().map(|s| s.1));
    let back = moment.place.power(-1.0);
    all.iter_mut().for_each(|p| back.apply_posture(p));
    let clip = Clip::from_postures(next.clip.name(), stop::RATE / next.speed, all, planted).ok()?;
    let seconds = |samples: usize| samples as f64 * next.speed / stop::RATE;
    let way = TransitionClip {
        clip,
        begin: enters - seconds(at),
        enters,
        until: enters + seconds(ends),
    };
    Some((asked, way))
}
