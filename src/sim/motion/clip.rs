//! A motion at a uniform rate, and sampling it at any time.
//!
//! Between two samples every coordinate is a quintic in the exponential chart of the earlier one, so that position,
//! velocity and acceleration are continuous and the sampled velocity and acceleration are exact derivatives of the
//! sampled posture. The derivatives at the samples are finite differences of their neighbours. Sampling allocates
//! nothing, and its rounding is the same on every machine, since it feeds the tick.

mod planar;
mod seam;

pub use planar::PlanarTransform;

use super::target::Target;
use crate::body::state::{ball_rate_vector, ball_rates};
use crate::body::topology::{
    BALL_COUNT, DOF_LEN, DOF_START, JOINT, JOINT_NAMES, Joint, SEGMENT_COUNT,
};
use crate::body::{NV, Posture};
use crate::math::curve;
use crate::math::rotation_vector;
use crate::math::{Quat, Vec3, trig};
use seam::Seam;
use serde::{Deserialize, Serialize, Serializer};

/// Largest number of samples of a clip: 15 minutes at 120 Hz, some 130 MB.
pub const MAX_SAMPLES: usize = 108_000;
/// Accepted sample rates, Hz.
pub const RATE_RANGE: [f64; 2] = [1.0, 1000.0];
/// Largest coordinate of the pelvis, m. Differences of positions up to there are exact to far better than a micrometre.
const FARTHEST: f64 = 1e5;
/// Largest hinge angle, rad; beyond it is noise, not a joint.
const LARGEST_ANGLE: f64 = 100.0;
/// How far a quaternion's length may be from 1.
const UNIT_TOLERANCE: f64 = 1e-6;

/// Why samples are not a clip.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)]
pub enum ClipError {
    #[error("a clip needs at least one sample")]
    Empty,
    #[error("{count} samples, at most {MAX_SAMPLES} are taken")]
    TooLong { count: usize },
    #[error("rate {rate_hz} Hz is outside {}…{} Hz", RATE_RANGE[0], RATE_RANGE[1])]
    Rate { rate_hz: f64 },
    #[error("{postures} postures, but planted feet for {planted}")]
    PlantedCount { postures: usize, planted: usize },
    #[error("sample {sample}: {joint} is not finite or out of bounds")]
    Value { sample: usize, joint: &'static str },
    #[error("sample {sample}: {joint} has a quaternion of length {length}, not 1")]
    NotUnit {
        sample: usize,
        joint: &'static str,
        length: f64,
    },
}

/// A sample with its rates, in the layout of a state's velocity, but with the pelvis's angular part in pelvis axes.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Knot {
    /// Posture.
    pub posture: Posture,
    /// First derivative.
    #[serde(with = "crate::saved::array")]
    pub first: [f64; NV],
    /// Second derivative.
    #[serde(with = "crate::saved::array")]
    pub second: [f64; NV],
    /// Feet that the motion keeps on the floor.
    pub planted: [bool; 2],
}

impl Knot {
    /// Sample `i` of `postures`, `h` seconds apart, with rates from its neighbours. No allocation.
    pub fn of(postures: &[Posture], i: usize, h: f64, planted: [bool; 2]) -> Self {
        let (first, second) = differences(postures, i, h);
        Self {
            posture: postures[i],
            first,
            second,
            planted,
        }
    }
}

/// A motion at a uniform rate. Immutable.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "ClipSamples")]
pub struct Clip {
    name: String,
    rate_hz: f64,
    /// All samples: those of the lead-in, the motion itself, the lead-out.
    knots: Vec<Knot>,
    lead_in: usize,
    lead_out: usize,
    seam: Option<Box<Seam>>,
}

/// The serialised parts of a clip.
#[derive(Serialize, Deserialize)]
struct ClipSamples {
    name: String,
    rate_hz: f64,
    samples: Vec<(Posture, [bool; 2])>,
    ends: [usize; 2],
}

impl Serialize for Clip {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let samples = self.samples().map(|(p, planted)| (*p, planted));
        ClipSamples {
            name: self.name.clone(),
            rate_hz: self.rate_hz,
            samples: samples.collect(),
            ends: [self.lead_in, self.lead_out],
        }
        .serialize(to)
    }
}

impl TryFrom<ClipSamples> for Clip {
    type Error = ClipError;

    /// Takes postures as they are: they are checked, but not normalised again, since that would change their last bits.
    fn try_from(from: ClipSamples) -> Result<Self, ClipError> {
        let (postures, planted) = from.samples.into_iter().unzip();
        let clip = Self::of(&from.name, from.rate_hz, postures, planted, false)?;
        let [lead_in, lead_out] = from.ends;
        Ok(clip.with_ends(lead_in, lead_out))
    }
}

impl Clip {
    /// A clip from smooth postures, `1/rate_hz` seconds apart.
    ///
    /// * `planted`: which feet (left, right) the motion keeps on the floor, one entry per posture.
    ///
    /// Velocities and accelerations at the samples are differences over five neighbours (fourth order; second order at
    /// the ends) in the exponential chart.
    ///
    /// # Errors
    /// Rate or number of samples out of range, `planted` of another length, a number that is not finite, a quaternion
    /// that is not of unit length.
    pub fn from_postures(
        name: &str,
        rate_hz: f64,
        postures: Vec<Posture>,
        planted: Vec<[bool; 2]>,
    ) -> Result<Self, ClipError> {
        Self::of(name, rate_hz, postures, planted, true)
    }

    fn of(
        name: &str,
        rate_hz: f64,
        postures: Vec<Posture>,
        planted: Vec<[bool; 2]>,
        normalise: bool,
    ) -> Result<Self, ClipError> {
        let count = postures.len();
        if count == 0 {
            return Err(ClipError::Empty);
        }
        if count > MAX_SAMPLES {
            return Err(ClipError::TooLong { count });
        }
        if !(RATE_RANGE[0]..=RATE_RANGE[1]).contains(&rate_hz) {
            return Err(ClipError::Rate { rate_hz });
        }
        if planted.len() != count {
            return Err(ClipError::PlantedCount {
                postures: count,
                planted: planted.len(),
            });
        }
        let mut postures = postures;
        for (sample, posture) in postures.iter_mut().enumerate() {
            let mut checked = *posture;
            check(sample, &mut checked)?;
            if normalise {
                *posture = checked;
            }
        }
        let h = 1.0 / rate_hz;
        let knots: Vec<Knot> = (0..count)
            .map(|i| Knot::of(&postures, i, h, planted[i]))
            .collect();
        let mut clip = Self {
            name: name.to_owned(),
            rate_hz,
            knots,
            lead_in: 0,
            lead_out: 0,
            seam: None,
        };
        clip.seam = clip.make_seam();
        Ok(clip)
    }

    /// Declares the first `lead_in` and the last `lead_out` samples to be the path into the motion and out of it
    /// ([`crate::plan::stop`]): times count from the first sample between them, and repetition leaves them out. At
    /// least one sample stays between.
    pub fn with_ends(mut self, lead_in: usize, lead_out: usize) -> Self {
        let most = self.knots.len() - 1;
        self.lead_in = lead_in.min(most);
        self.lead_out = lead_out.min(most - self.lead_in);
        self.seam = self.make_seam();
        self
    }

    /// Name.
    pub fn name(&self) -> &str {
        &self.name
    }
    /// Samples per second.
    pub fn rate_hz(&self) -> f64 {
        self.rate_hz
    }
    /// Number of samples without lead-in and lead-out, at least 1.
    #[allow(clippy::len_without_is_empty)] // never empty
    pub fn len(&self) -> usize {
        self.knots.len() - self.lead_in - self.lead_out
    }
    /// Time of the last sample before the lead-out, s; 0 for a single posture.
    pub fn duration(&self) -> f64 {
        (self.len() - 1) as f64 / self.rate_hz
    }
    /// Length of the path into the motion, s: it plays at negative times.
    pub fn lead_in(&self) -> f64 {
        self.lead_in as f64 / self.rate_hz
    }
    /// Length of the path out of the motion, s: it plays after [`Self::duration`].
    pub fn lead_out(&self) -> f64 {
        self.lead_out as f64 / self.rate_hz
    }
    /// Posture of sample `i`. Panics if there is none.
    pub fn posture(&self, i: usize) -> &Posture {
        &self.knots[self.lead_in + i].posture
    }
    /// Whether each foot (left, right) is planted at sample `i`. Panics if there is no such sample.
    pub fn planted(&self, i: usize) -> [bool; 2] {
        self.knots[self.lead_in + i].planted
    }
    /// All samples with lead-in and lead-out, in order: posture and planted feet. The first one is that of time
    /// −[`Self::lead_in`].
    pub fn samples(&self) -> impl ExactSizeIterator<Item = (&Posture, [bool; 2])> {
        self.knots.iter().map(|k| (&k.posture, k.planted))
    }

    /// Displacement along the ground and change of heading of one round of [`Self::sample_looped`].
    pub fn advance(&self) -> PlanarTransform {
        self.seam
            .as_ref()
            .map_or_else(PlanarTransform::default, |s| s.advance)
    }

    /// The motion at time `t` (s).
    ///
    /// Lead-in and lead-out are included. Before and after them the motion stands still in the first or last posture
    /// (also for a time that is NaN). In between, posture, velocity and acceleration are continuous. A recording
    /// without lead-in and lead-out that starts or ends in full motion has its true velocity up to its ends, so it
    /// stops there at once.
    ///
    /// Section 3.2 of the paper.
    pub fn sample(&self, t: f64) -> Target {
        let last = self.knots.len() - 1;
        if t >= self.duration() + self.lead_out() {
            self.rest(last)
        } else if t >= -self.lead_in() {
            self.inside(t)
        } else {
            self.rest(0)
        }
    }

    /// The motion at time `t` (s) when it repeats for ever, in both directions.
    ///
    /// Each round starts where the last one ended: displacement along the ground and change of heading are carried
    /// over. Towards the end of a round the remaining difference to the start (posture, velocity, acceleration) is
    /// blended in, so that the seam is as smooth as the clip. A NaN time counts as 0. A clip with a lead-in comes from
    /// there instead of from earlier rounds.
    pub fn sample_looped(&self, t: f64) -> Target {
        let Some(seam) = &self.seam else {
            return self.rest(self.lead_in);
        };
        let t = if t.is_finite() { t } else { 0.0 };
        if t < 0.0 && self.lead_in > 0 {
            return self.sample(t);
        }
        let period = self.duration();
        let round = (t / period).floor();
        let local = (t - round * period).clamp(0.0, period);
        let mut target = self.inside(local);
        let into = local - (period - seam.length);
        if into > 0.0 {
            seam.blend(into, &mut target);
        }
        seam.advance.power(round).apply_to(&mut target);
        target
    }

    fn rest(&self, i: usize) -> Target {
        let knot = &self.knots[i];
        Target {
            planted: knot.planted,
            ..Target::still(knot.posture)
        }
    }

    /// Sample at −lead-in ≤ t ≤ duration + lead-out.
    fn inside(&self, t: f64) -> Target {
        let position = (t * self.rate_hz + self.lead_in as f64).max(0.0);
        let i = (position.floor() as usize).min(self.knots.len().saturating_sub(2));
        let Some(b) = self.knots.get(i + 1) else {
            return self.rest(i);
        };
        let u = (position - i as f64).clamp(0.0, 1.0);
        between(&self.knots[i], b, 1.0 / self.rate_hz, u)
    }
}

/// The motion at share `u` (0…1) of the `h` seconds from knot `a` to knot `b`. No allocation.
pub(crate) fn between(a: &Knot, b: &Knot, h: f64, u: f64) -> Target {
    let x = u * h;
    let step = local_difference(&a.posture, &b.posture);
    let mut target = Target {
        posture: a.posture,
        velocity: [0.0; NV],
        acceleration: [0.0; NV],
        planted: if u < 0.5 { a.planted } else { b.planted },
    };
    let fifth = |k: usize, end: [f64; 3]| {
        curve::quintic(h, x, a.first[k], a.second[k], end[0], end[1], end[2])
    };
    for_each_part(|part| match part {
        Part::Scalar(k) => {
            let [p, v, w] = fifth(k, [step[k], b.first[k], b.second[k]]);
            add_scalar(&mut target.posture, k, p);
            target.velocity[k] = v;
            target.acceleration[k] = w;
        }
        Part::Rotation { start, ball } => {
            let phi = vector(ball, start, &step);
            let (d1, a1) = rotation_vector::vector_rates(
                phi,
                vector(ball, start, &b.first),
                vector(ball, start, &b.second),
            );
            let (d0, a0) = (
                vector(ball, start, &a.first).to_array(),
                vector(ball, start, &a.second).to_array(),
            );
            let (phi, d1, a1) = (phi.to_array(), d1.to_array(), a1.to_array());
            let curve: [[f64; 3]; 3] =
                std::array::from_fn(|c| curve::quintic(h, x, d0[c], a0[c], phi[c], d1[c], a1[c]));
            let row = |r: usize| Vec3 {
                x: curve[0][r],
                y: curve[1][r],
                z: curve[2][r],
            };
            let (omega, alpha) = rotation_vector::rates(row(0), row(1), row(2));
            let q = rotation_mut(&mut target.posture, ball);
            *q = (*q * Quat::exp(row(0))).normalized();
            set_vector(ball, start, omega, &mut target.velocity);
            set_vector(ball, start, alpha, &mut target.acceleration);
        }
    });
    turn_root_rates(&mut target);
    target
}

/// Bounds and unit length of one posture; quaternions are scaled to unit length exactly.
fn check(sample: usize, posture: &mut Posture) -> Result<(), ClipError> {
    let position = posture.root_position.to_array();
    if !position.iter().all(|c| c.abs() <= FARTHEST) {
        return Err(ClipError::Value {
            sample,
            joint: "root position",
        });
    }
    for s in 0..SEGMENT_COUNT {
        let joint = JOINT_NAMES[s];
        let rotation = match JOINT[s] {
            Joint::Free => &mut posture.root_rotation,
            Joint::Ball(b) => &mut posture.ball[b],
            Joint::Hinge2(h) | Joint::Hinge1(h) => {
                let angles = &posture.hinge[h..h + DOF_LEN[s]];
                if angles.iter().all(|a| a.abs() <= LARGEST_ANGLE) {
                    continue;
                }
                return Err(ClipError::Value { sample, joint });
            }
        };
        let length = rotation.to_xyzw().iter().map(|c| c * c).sum::<f64>().sqrt();
        if !length.is_finite() {
            return Err(ClipError::Value { sample, joint });
        }
        if (length - 1.0).abs() > UNIT_TOLERANCE {
            return Err(ClipError::NotUnit {
                sample,
                joint,
                length,
            });
        }
        *rotation = rotation.normalized();
    }
    Ok(())
}

/// One independent part of a velocity vector.
enum Part {
    /// A component that simply adds: pelvis position, hinge angle.
    Scalar(usize),
    /// Three components that are an angular velocity in child axes: the pelvis (`None`) or a ball joint.
    Rotation { start: usize, ball: Option<usize> },
}

fn for_each_part(mut visit: impl FnMut(Part)) {
    visit(Part::Rotation {
        start: 0,
        ball: None,
    });
    for k in 3..6 {
        visit(Part::Scalar(k));
    }
    for s in 1..SEGMENT_COUNT {
        let start = 6 + DOF_START[s];
        match JOINT[s] {
            Joint::Free => {}
            Joint::Ball(b) => visit(Part::Rotation {
                start,
                ball: Some(b),
            }),
            Joint::Hinge2(_) | Joint::Hinge1(_) => {
                for k in 0..DOF_LEN[s] {
                    visit(Part::Scalar(start + k));
                }
            }
        }
    }
}

/// Index of the hinge behind each velocity component; `usize::MAX` where there is none.
const HINGE_OF: [usize; NV] = {
    let mut out = [usize::MAX; NV];
    let mut s = 1;
    while s < SEGMENT_COUNT {
        if let Joint::Hinge2(h) | Joint::Hinge1(h) = JOINT[s] {
            let mut k = 0;
            while k < DOF_LEN[s] {
                out[6 + DOF_START[s] + k] = h + k;
                k += 1;
            }
        }
        s += 1;
    }
    out
};

fn add_scalar(posture: &mut Posture, k: usize, value: f64) {
    match k {
        3 => posture.root_position.x += value,
        4 => posture.root_position.y += value,
        5 => posture.root_position.z += value,
        _ => posture.hinge[HINGE_OF[k]] += value,
    }
}

fn rotation_mut(posture: &mut Posture, ball: Option<usize>) -> &mut Quat {
    match ball {
        None => &mut posture.root_rotation,
        Some(b) => {
            debug_assert!(b < BALL_COUNT);
            &mut posture.ball[b]
        }
    }
}

/// Three components as a vector in child axes.
fn vector(ball: Option<usize>, start: usize, v: &[f64; NV]) -> Vec3 {
    match ball {
        None => Vec3 {
            x: v[0],
            y: v[1],
            z: v[2],
        },
        Some(_) => ball_rate_vector(start - 6, &v[start..start + 3]),
    }
}

fn set_vector(ball: Option<usize>, start: usize, w: Vec3, v: &mut [f64; NV]) {
    let rates = match ball {
        None => w.to_array(),
        Some(_) => ball_rates(start - 6, w),
    };
    v[start..start + 3].copy_from_slice(&rates);
}

/// `to ⊖ from` with the pelvis's rotation vector in pelvis axes.
fn local_difference(from: &Posture, to: &Posture) -> [f64; NV] {
    let mut e = from.difference(to);
    turn_root(from.root_rotation.conjugate(), &mut e);
    e
}

fn turn_root(rotation: Quat, v: &mut [f64; NV]) {
    let turned = rotation.rotate(Vec3 {
        x: v[0],
        y: v[1],
        z: v[2],
    });
    v[..3].copy_from_slice(&turned.to_array());
}

/// Pelvis axes to world axes for both rates; the same rotation serves for the acceleration, because ω × ω = 0.
fn turn_root_rates(target: &mut Target) {
    let rotation = target.posture.root_rotation;
    turn_root(rotation, &mut target.velocity);
    turn_root(rotation, &mut target.acceleration);
}

/// First and second derivative at sample `i` in the chart of that sample, where they are the rates themselves.
fn differences(postures: &[Posture], i: usize, h: f64) -> ([f64; NV], [f64; NV]) {
    // Stencils (offset, weight for the first, weight for the second derivative); the sample itself is the chart's zero.
    const FIVE: &[(isize, f64, f64)] = &[
        (-2, 1.0 / 12.0, -1.0 / 12.0),
        (-1, -8.0 / 12.0, 16.0 / 12.0),
        (1, 8.0 / 12.0, 16.0 / 12.0),
        (2, -1.0 / 12.0, -1.0 / 12.0),
    ];
    const THREE: &[(isize, f64, f64)] = &[(-1, -0.5, 1.0), (1, 0.5, 1.0)];
    const START: &[(isize, f64, f64)] = &[(1, 2.0, -5.0), (2, -0.5, 4.0), (3, 0.0, -1.0)];
    const START_OF_THREE: &[(isize, f64, f64)] = &[(1, 2.0, -2.0), (2, -0.5, 1.0)];
    const START_OF_TWO: &[(isize, f64, f64)] = &[(1, 1.0, 0.0)];
    let (before, after) = (i, postures.len() - 1 - i);
    let (stencil, backwards) = match (before.min(after), before + after) {
        (_, 0) => (&[] as &[_], false),
        (0, 1) => (START_OF_TWO, after == 0),
        (0, 2) => (START_OF_THREE, after == 0),
        (0, _) => (START, after == 0),
        (1, _) => (THREE, false),
        _ => (FIVE, false),
    };
    let sign = if backwards { -1.0 } else { 1.0 };
    let (mut first, mut second) = ([0.0; NV], [0.0; NV]);
    for (offset, one, two) in stencil {
        let offset = if backwards { -offset } else { *offset };
        let e = local_difference(&postures[i], &postures[i.wrapping_add_signed(offset)]);
        for k in 0..NV {
            first[k] += sign * one / h * e[k];
            second[k] += two / (h * h) * e[k];
        }
    }
    (first, second)
}

#[cfg(test)]
mod tests;
