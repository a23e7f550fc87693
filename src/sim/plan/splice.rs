//! Out of a motion that is playing: into a stand, or into a clip at the place where that looks most alike.
//!
//! The seam is a draft like any other: the motion already planned and its continuation are prepared together, so that
//! feet are locked and the zero-moment point is kept across the seam. Planned once when a figure gets a new task;
//! allocates, 10 to 20 ms for each end.

use super::cycle::relabel_prepared;
use super::feasibility::infeasibility;
use super::foot_lock::{turn, yaw_pitch};
use super::prepare::{Draft, PrepareOptions, prepare_in};
use crate::body::{Body, Posture};
use crate::math::curve::{fade, smootherstep};
use crate::motion::clip::{Clip, PlanarTransform};
use crate::plan::params::{balance, leg, likeness, stop, stream};
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

pub(crate) const SEAM_OPTIONS: PrepareOptions = PrepareOptions {
    // A foot that an ankle at its limit moves by millimetres stays planted: taken off the floor it would step in place,
    // and a stop has no time for that.
    held: leg::SEAM_HELD,
    ..PrepareOptions::FULL
};

pub(crate) use super::params::stop::RUN_UP;
pub(crate) use super::params::stream::RATE;

/// A sample: its posture, and whether each foot is planted.
pub type Sample = (Posture, [bool; 2]);

/// The ways to end a motion by steps that bring it to a stand. Moments are tried in turn as the beginning of the end,
/// until one asks little of the ground; if none does, the one that asks least is taken. A clip tries those of the
/// coming step, a stream that is over those around its end. Each can be planned on its own.
#[derive(Serialize, Deserialize)]
pub struct StopCandidates {
    #[serde(with = "crate::saved::definition")]
    body: Arc<Body>,
    known: Vec<Sample>,
    now: usize,
    goal: Option<Posture>,
    streamed: bool,
    whole: bool,
    #[serde(skip)]
    way: OnceLock<Option<KnownMotion>>,
    /// The first end already found to be easy: those after it are not needed.
    #[serde(skip, default = "none_yet")]
    easy: AtomicUsize,
}

/// The number of the first path that serves, before any is known.
pub(super) fn none_yet() -> AtomicUsize {
    AtomicUsize::new(usize::MAX)
}

/// The part that all ends share: the motion with samples at [`stop::RATE`], with its step finished, and its labels.
struct KnownMotion {
    known: Vec<Sample>,
    postures: Vec<Posture>,
    label: Vec<[bool; 2]>,
    now: usize,
    /// The first sample after which it should end.
    wanted: usize,
}

/// The stand in which a stopped motion ends, wherever that is.
#[derive(Clone, Copy, Debug, Default)]
pub struct StandGoal {
    /// The stand; at ease if absent.
    pub posture: Option<Posture>,
    /// Whether the motion is a stream, which is known less well than a clip.
    pub streamed: bool,
    /// Whether the motion goes to the end of what is known if it can be stopped there, rather than to the first moment
    /// at which it can.
    pub whole: bool,
}

impl std::fmt::Debug for StopCandidates {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("StopCandidates")
    }
}

impl StopCandidates {
    /// Largest number of ends that are tried.
    pub const MOST: usize = (stop::SEARCH_TIME * stop::RATE) as usize / stop::SEARCH_STRIDE + 1;

    /// * `known`: the motion up to now and as far ahead as it is known, samples at [`stream::RATE`]; it continues at
    ///   least up to sample `now`.
    pub fn new(body: &Arc<Body>, known: Vec<Sample>, now: usize, to: StandGoal) -> Self {
        let StandGoal {
            posture: goal,
            streamed,
            whole,
        } = to;
        Self {
            body: Arc::clone(body),
            known,
            now,
            goal,
            streamed,
            whole,
            way: OnceLock::new(),
            easy: none_yet(),
        }
    }

    /// Whether this value is one that a checkpoint could hold: a stream is known as far as its ring goes, any other
    /// motion for a shorter time.
    pub fn is_valid(&self) -> bool {
        let window = (stream::LONGEST_WINDOW * stream::RATE) as i64;
        self.known.len() as i64 <= 2 * stream::PAST + window && self.now <= self.known.len()
    }

    /// Whether the final stand is given.
    pub fn have_goal(&self) -> bool {
        self.goal.is_some()
    }

    /// The same ends with a stand like `goal`: the best of them all.
    pub fn like(&self, goal: Posture) -> Option<Clip> {
        let to = StandGoal {
            posture: Some(goal),
            streamed: self.streamed,
            whole: self.whole,
        };
        stop(&self.body, self.known.clone(), self.now, to)
    }

    fn way(&self) -> Option<&KnownMotion> {
        let way = || {
            if self.known.len() < 4 {
                return None;
            }
            let (known, now) = (twice_as_fine(&self.known)?, 2 * self.now);
            let (mut postures, planted): (Vec<_>, Vec<_>) = known.iter().copied().unzip();
            let mut label = relabel_prepared(&self.body, stop::RATE, &postures, &planted);
            let wanted = if self.whole { label.len() - 1 } else { now };
            if (wanted..label.len()).all(|i| label[i] != [true; 2]) {
                finish_step(&mut postures, &mut label);
            }
            Some(KnownMotion {
                known,
                postures,
                label,
                now,
                wanted,
            })
        };
        self.way.get_or_init(way).as_ref()
    }

    /// The `k`-th end, below [`Self::MOST`], and how much it asks of the ground. Time 0 of the clip is the first given
    /// sample. `None` if there is none, if the body stands, sits or lies anyway, or if an earlier end was easy.
    pub fn end(&self, k: usize) -> Option<(f64, Clip)> {
        if k > self.easy.load(Ordering::Relaxed) {
            return None;
        }
        let way = self.way()?;
        let end = way.moment(k)?;
        let found = way.stop_after(&self.body, end, self.goal.as_ref(), self.streamed)?;
        if found.0 < stop::EASY {
            self.easy.fetch_min(k, Ordering::Relaxed);
        }
        Some(found)
    }

    /// The end to take out of all in their order. Looks at none after an easy one.
    pub fn best(ends: impl IntoIterator<Item = Option<(f64, Clip)>>) -> Option<Clip> {
        let mut best: Option<(f64, Clip)> = None;
        for found in ends.into_iter().flatten() {
            if best.as_ref().is_none_or(|b| found.0 < b.0) {
                let easy = found.0 < stop::EASY;
                best = Some(found);
                if easy {
                    break;
                }
            }
        }
        best.map(|(_, clip)| clip)
    }
}

/// Ends a motion by the steps that bring it to a stand ([`StopCandidates`]).
pub fn stop(body: &Arc<Body>, known: Vec<Sample>, now: usize, to: StandGoal) -> Option<Clip> {
    let ends = StopCandidates::new(body, known, now, to);
    StopCandidates::best((0..StopCandidates::MOST).map(|k| ends.end(k)))
}

impl KnownMotion {
    /// The sample after which the `k`-th end begins: from the first that is wanted on forwards, as far as the step
    /// goes; then backwards, since a body that cannot be stopped there loses more than the last moments of its motion.
    fn moment(&self, k: usize) -> Option<usize> {
        let last = self.postures.len() - 1;
        let first = self.wanted.min(last);
        let latest = (first + (stop::SEARCH_TIME * stop::RATE) as usize).min(last);
        let after = (latest - first) / stop::SEARCH_STRIDE;
        if k <= after {
            return Some(first + k * stop::SEARCH_STRIDE);
        }
        let end = first.checked_sub((k - after) * stop::SEARCH_STRIDE)?;
        (end >= self.now).then_some(end)
    }

    /// The motion up to sample `end`, then to a stand like `goal`, or at ease, and the unsupported force that this
    /// needs.
    fn stop_after(
        &self,
        body: &Body,
        end: usize,
        goal: Option<&Posture>,
        streamed: bool,
    ) -> Option<(f64, Clip)> {
        // Samples from long ago have no part in it.
        let cut = (self.now).saturating_sub((stop::PREPARED_TIME * stop::RATE) as usize);
        let now = self.now - cut;
        let (postures, label) = (&self.postures[cut..=end], &self.label[cut..=end]);
        let mut draft = Draft::of_postures(body, stop::RATE, postures.to_vec(), label.to_vec());
        let added = match goal {
            Some(goal) => draft.end_like(body, goal),
            None => draft.end_standing(body, streamed),
        };
        if added == 0 {
            return None;
        }
        let mut whole = prepare_in(body, &draft, SEAM_OPTIONS, balance::SEAM_ROUNDS);
        blend_from_played(&mut whole.postures, &self.known[cut..], now);
        let from = now.saturating_sub(4);
        let (postures, label) = (&whole.postures[from..], &draft.label[from..]);
        let asked = infeasibility(body, postures, label);
        let (mut all, mut planted): (Vec<_>, Vec<_>) = self.known[..cut].iter().copied().unzip();
        all.extend(whole.postures);
        planted.extend(whole.planted);
        let clip = Clip::from_postures("stop", stop::RATE, all, planted).ok()?;
        Some((asked, clip))
    }
}

/// The same motion with one more sample between each two.
fn twice_as_fine(known: &[Sample]) -> Option<Vec<Sample>> {
    let (postures, planted) = known.iter().copied().unzip();
    let clip = Clip::from_postures("", stream::RATE, postures, planted).ok()?;
    let count = 2 * (known.len() - 1);
    let samples = (0..=count).map(|i| clip.sample(i as f64 / stop::RATE));
    Some(samples.map(|t| (t.posture, t.planted)).collect())
}

/// Keeps samples unchanged that are playing already: the difference that preparation makes to the samples `before` up
/// to `now` fades in after that.
pub(crate) fn blend_from_played(postures: &mut [Posture], before: &[Sample], now: usize) {
    if now < 1 || now >= postures.len().min(before.len()) {
        return;
    }
    let off = |i: usize| postures[i].difference(&before[i].0);
    let (last, off) = (off(now - 1), off(now));
    let span = stop::BLEND_TIME * stop::RATE;
    for (p, b) in postures.iter_mut().zip(before).take(now) {
        *p = b.0;
    }
    for (i, p) in postures.iter_mut().enumerate().skip(now) {
        let u = (i - now) as f64 / span;
        if u >= 1.0 {
            break;
        }
        let left = std::array::from_fn(|k| fade(off[k], (off[k] - last[k]) * span, 0.0, u));
        p.integrate(&left, 1.0);
    }
}

/// Continues a motion that breaks off in mid-step until both feet are planted, by repeating what followed the last time
/// it was in a similar state. Does nothing if it never was.
fn finish_step(postures: &mut Vec<Posture>, label: &mut Vec<[bool; 2]>) {
    let end = postures.len() - 1;
    let rates = |i: usize| postures[i - 1].joint_difference(&postures[i]);
    let last = rates(end);
    let unlike = |i: usize| -> f64 {
        let angles = postures[i].joint_difference(&postures[end]);
        let rates = rates(i);
        let sum: f64 = (0..angles.len())
            .map(|k| {
                angles[k].powi(2)
                    + (likeness::RATE_SHARE * stop::RATE * (rates[k] - last[k])).powi(2)
            })
            .sum();
        (sum / angles.len() as f64).sqrt()
    };
    let best = (1..end.saturating_sub(stop::LEAST_STEP))
        .filter(|i| label[*i] == label[end])
        .map(|i| (unlike(i), i))
        .min_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, from)) = best.filter(|(u, _)| *u < likeness::SAME_STEP) else {
        return;
    };
    let moved = between(&postures[from], &postures[end]);
    let placed = |p: &Posture| {
        let mut p = *p;
        moved.apply_posture(&mut p);
        p
    };
    let off = placed(&postures[from]).difference(&postures[end]);
    for i in from + 1..=end {
        let u = ((i - from) as f64 / (stop::BLEND_TIME * stop::RATE)).min(1.0);
        let s = 1.0 - smootherstep(u);
        let mut p = placed(&postures[i]);
        p.integrate(&off.map(|e| e * s), 1.0);
        postures.push(p);
        label.push(label[i]);
        if label[i] == [true; 2] {
            return;
        }
    }
}

/// The transform that moves a posture to the place and heading of another one.
pub fn between(from: &Posture, to: &Posture) -> PlanarTransform {
    let heading = |p: &Posture| yaw_pitch(p.root_rotation).0;
    let turn = PlanarTransform {
        x: 0.0,
        y: 0.0,
        yaw: turn(heading(from), heading(to)),
    };
    let at = turn.point(from.root_position);
    PlanarTransform {
        x: to.root_position.x - at.x,
        y: to.root_position.y - at.y,
        ..turn
    }
}
