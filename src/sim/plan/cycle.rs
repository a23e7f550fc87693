//! A stretch of a motion that can repeat: chosen where its end looks most like its beginning, and closed so that
//! nothing jumps and no foot slides.

use super::foot_lock::Sole;
use super::likeness::pelvis_unlike;
use super::prepare::{Draft, PrepareOptions, prepare};
use crate::body::topology::{DOF_COUNT, FEET};
use crate::body::{Body, Posture};
use crate::math::Vec3;
use crate::motion::clip::Clip;
use crate::motion::leg_ik::forward;
use crate::plan::params::{contact, likeness};

/// The features by which two samples are compared.
struct Key {
    posture: Posture,
    rates: [f64; DOF_COUNT],
    planted: [bool; 2],
}

/// Unlikeness of two samples regardless of place and heading, rad rms; `None` if different feet are planted.
fn unlike(a: &Key, b: &Key) -> Option<f64> {
    if a.planted != b.planted {
        return None;
    }
    let angles = a.posture.joint_difference(&b.posture);
    let mut sum: f64 = angles.iter().map(|e| e * e).sum();
    for (x, y) in a.rates.iter().zip(&b.rates) {
        sum += (likeness::RATE_SHARE * (x - y)).powi(2);
    }
    sum += pelvis_unlike(&a.posture, &b.posture);
    Some((sum / DOF_COUNT as f64).sqrt())
}

/// How a motion repeats.
enum Repeat {
    /// The whole motion, unchanged.
    Whole,
    /// From one sample to another.
    Stretch(usize, usize),
    /// Only by standing still in between.
    Standing,
}

fn find(clip: &Clip) -> Repeat {
    let n = clip.len();
    let stride = (clip.rate_hz() / likeness::CYCLE_RATE).round().max(1.0) as usize;
    let at: Vec<usize> = (0..n).step_by(stride).collect();
    let keys: Vec<Key> = at
        .iter()
        .map(|&i| {
            // A clip may be at rest at its very ends.
            let t = clip.sample(i.clamp(1, n.max(3) - 2) as f64 / clip.rate_hz());
            let mut rates = [0.0; DOF_COUNT];
            rates.copy_from_slice(&t.velocity[6..]);
            Key {
                posture: *clip.posture(i),
                rates,
                planted: clip.planted(i),
            }
        })
        .collect();
    let steps = keys.iter().any(|k| k.planted != [true; 2]);
    let whole = unlike(&keys[0], &keys[keys.len() - 1]);
    if whole.is_some_and(|u| u < likeness::WHOLE_CYCLE) {
        return Repeat::Whole;
    }
    if !steps {
        return Repeat::Standing;
    }
    let least =
        (likeness::SHORTEST_CYCLE * clip.rate_hz()).max(likeness::SHORTEST_CYCLE_SHARE * n as f64);
    let shortest = (least / stride as f64).ceil() as usize;
    let mut best = (f64::INFINITY, 0, 0);
    for i in 0..keys.len() {
        for j in i + shortest..keys.len() {
            let Some(u) = unlike(&keys[i], &keys[j]).filter(|u| *u < likeness::CLOSED_CYCLE) else {
                continue;
            };
            let score = u - likeness::LENGTH_WORTH * (j - i) as f64 / keys.len() as f64;
            if score < best.0 {
                best = (score, at[i], at[j]);
            }
        }
    }
    if best.0.is_finite() {
        Repeat::Stretch(best.1, best.2)
    } else {
        Repeat::Standing
    }
}

/// Changes the motion so that it repeats well; `None` if it already does. A stretch that is close to a cycle is closed,
/// with everything before it as the lead-in; a motion without such a stretch stands still between its rounds. Offline:
/// allocates, about a tenth of a second for some seconds of motion.
pub fn cycle(body: &Body, clip: &Clip) -> Option<Clip> {
    match find(clip) {
        Repeat::Whole => None,
        Repeat::Stretch(i, j) => closed(body, clip, i, j),
        Repeat::Standing => through_standing(body, clip),
    }
}

/// Feet on the floor: the planted ones, and those that an earlier preparation set free because the leg could not hold
/// them exactly.
pub(crate) fn relabel_prepared(
    body: &Body,
    rate: f64,
    postures: &[Posture],
    planted: &[[bool; 2]],
) -> Vec<[bool; 2]> {
    let soles = [Sole::new(body, 0), Sole::new(body, 1)];
    let feet: Vec<[(Vec3, f64); 2]> = postures
        .iter()
        .map(|p| {
            let poses = forward(body, p);
            std::array::from_fn(|s| {
                let (ankle, rotation) = poses[FEET[s].index()];
                (ankle, ankle.z + soles[s].lowest(rotation, 0.0))
            })
        })
        .collect();
    (0..postures.len())
        .map(|i| {
            // The first sample has no predecessor, and may belong to a swinging foot.
            let (now, before) = (i.max(1).min(feet.len() - 1), i.max(1) - 1);
            std::array::from_fn(|s| {
                let speed = (feet[now][s].0 - feet[before][s].0).norm() * rate;
                planted[i][s]
                    || (feet[i][s].1 < contact::PREPARED_HEIGHT && speed < contact::PREPARED_SPEED)
            })
        })
        .collect()
}

/// The lead-in and the motion, followed by a return to the stand in which it began.
fn through_standing(body: &Body, clip: &Clip) -> Option<Clip> {
    let rate = clip.rate_hz();
    let count = clip.len() + (clip.lead_in() * rate).round() as usize;
    let (postures, planted): (Vec<_>, Vec<_>) =
        clip.samples().take(count).map(|(p, f)| (*p, f)).unzip();
    let first = *postures.first()?;
    let label = relabel_prepared(body, rate, &postures, &planted);
    let mut draft = Draft::of_postures(body, rate, postures, label);
    if draft.end_like(body, &first) == 0 {
        return None;
    }
    let whole = prepare(body, &draft, PrepareOptions::FULL);
    Clip::from_postures(clip.name(), rate, whole.postures, whole.planted).ok()
}

/// The clip with samples `i` to `j` as its repeated stretch.
fn closed(body: &Body, clip: &Clip, i: usize, j: usize) -> Option<Clip> {
    let rate = clip.rate_hz();
    let lead = (clip.lead_in() * rate).round() as usize + i;
    let samples: Vec<(Posture, [bool; 2])> = clip.samples().map(|(p, f)| (*p, f)).collect();
    let (postures, planted): (Vec<_>, Vec<_>) =
        samples[lead..=lead + j - i].iter().copied().unzip();
    let piece = Clip::from_postures(clip.name(), rate, postures, planted).ok()?;
    // Several rounds are prepared as one motion. The one that is kept has others around it for as long as balance looks
    // ahead and back, and the rounds before it become the lead-in.
    let round = j - i;
    let around = (likeness::CYCLE_AHEAD * rate / round as f64)
        .ceil()
        .max(1.0) as usize;
    let (mut postures, mut planted): (Vec<_>, Vec<_>) = samples[..lead].iter().copied().unzip();
    for k in 0..=(2 * around + 1) * round {
        let t = piece.sample_looped(k as f64 / rate);
        postures.push(t.posture);
        planted.push(t.planted);
    }
    let label = relabel_prepared(body, rate, &postures, &planted);
    let draft = Draft::of_postures(body, rate, postures, label);
    let prepared = prepare(body, &draft, PrepareOptions::FULL);
    let lead = lead + around * round;
    let (mut postures, mut planted) = (prepared.postures, prepared.planted);
    postures.truncate(lead + round + 1);
    planted.truncate(lead + round + 1);
    let out = Clip::from_postures(clip.name(), rate, postures, planted).ok()?;
    Some(out.with_ends(lead, 0))
}
