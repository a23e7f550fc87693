//! Transitions from step to step: out of a motion into a clip without standing in between.
//!
//! As in motion graphs (Kovar, Gleicher & Pighin 2002), the coming part of the first motion is searched for moments
//! that resemble the beginning of the second. The comparison uses quantities that matter to the body that has to make
//! the change: the capture point over the planted foot, the place of the other foot, and the joints ([`candidates`]).
//! At such a moment the second motion is placed on the planted foot, the difference between the two fades, and both are
//! prepared together as one draft, so that no planted foot slides and the zero-moment point stays in the support
//! ([`seam`]). A body that stands, but not as the clip begins, is led into the clip from its stand ([`from_stand`]),
//! and so is one whose stream begins in motion ([`into_stream`]).

mod candidates;
mod from_stand;
mod into_stream;
mod seam;

pub use candidates::Moment;
pub use into_stream::{StreamBeginning, StreamEntry};

pub(crate) use super::params::stop::RATE;
pub(crate) use super::params::transition::{AHEAD, BEYOND, RUN_UP};

use super::splice::{Sample, none_yet};
use crate::body::Body;
use crate::motion::clip::{Clip, PlanarTransform};
use crate::motion::target::Target;
use crate::plan::params::{stop, transition};
use crate::time::MotionTime;
use candidates::{Features, moments};
use seam::{ClipEntry, transition_at};
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The clip to follow, in its own place and time.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct NextClip {
    /// The clip.
    #[serde(with = "crate::saved::definition")]
    pub clip: Arc<Clip>,
    /// Clip seconds per second.
    pub speed: f64,
    /// Whether it repeats.
    pub looped: bool,
}

fn samples_in(seconds: f64) -> usize {
    (seconds * stop::RATE).round() as usize
}

impl NextClip {
    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        // The amount of planning depends on the speed.
        (0.01..=100.0).contains(&self.speed)
    }

    /// The motion at its time `t`.
    fn sample(&self, t: MotionTime) -> Target {
        if self.looped {
            self.clip.sample_looped(t.0)
        } else {
            self.clip.sample(t.0)
        }
    }

    /// How much of its beginning may be skipped, s of the clip.
    fn skipped(&self) -> f64 {
        let long = self.clip.duration();
        if self.looped {
            transition::MOST_SKIPPED_OF_CYCLE.min(long)
        } else {
            transition::MOST_SKIPPED.min(transition::MOST_SKIPPED_SHARE * long)
        }
    }

    /// The same in samples at [`stop::RATE`].
    fn skipped_samples(&self) -> usize {
        (self.skipped() / self.speed * stop::RATE) as usize
    }

    /// Samples at [`stop::RATE`] of the world from time `from` of the clip on.
    fn samples(&self, from: MotionTime, count: usize) -> Vec<Sample> {
        let at = |k: usize| from + k as f64 * self.speed / stop::RATE;
        let samples = (0..count).map(|k| self.sample(at(k)));
        samples.map(|t| (t.posture, t.planted)).collect()
    }
}

/// The path from a motion or a stand into a clip, in the place and time of the clip. It plays instead of the part of
/// the clip before `until`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TransitionClip {
    /// The motion: it begins as the motion that is left and ends as the clip itself.
    pub clip: Clip,
    /// Time of its first sample.
    pub begin: MotionTime,
    /// Time at which the first motion turns into the second. A path from a stand leads towards the clip from its first
    /// sample on.
    pub enters: MotionTime,
    /// Time from which the path equals the clip.
    pub until: MotionTime,
}

impl TransitionClip {
    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        let times = [self.begin, self.enters, self.until];
        times.iter().all(|t| t.is_finite())
    }

    /// Whether the path comes out of another motion rather than a stand.
    pub fn leads_over(&self) -> bool {
        self.enters > self.begin
    }
}

/// Samples of a known motion between which it can be left.
#[derive(Clone, Copy, Debug)]
pub struct LeavingSamples {
    /// The motion continues at least up to this sample.
    pub now: usize,
    /// First sample at which it may be left.
    pub earliest: usize,
}

/// The paths from a motion into a clip, at the moments that are most alike. Each can be planned on its own; the first
/// one that a body can follow is taken.
#[derive(Serialize, Deserialize)]
pub struct TransitionCandidates {
    #[serde(with = "crate::saved::definition")]
    body: Arc<Body>,
    known: Vec<Sample>,
    now: usize,
    next: NextClip,
    moments: Vec<Moment>,
    /// The first path already found to be one that a body can follow: those after it are not needed.
    #[serde(skip, default = "none_yet")]
    found: AtomicUsize,
}

impl std::fmt::Debug for TransitionCandidates {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("TransitionCandidates")
    }
}

impl TransitionCandidates {
    /// * `known`: the motion from at least [`transition::RUN_UP`] ago to [`transition::AHEAD`] and
    ///   [`transition::BEYOND`] ahead, samples at [`stop::RATE`]; it continues at least up to sample `left.now`.
    pub fn new(body: &Arc<Body>, known: Vec<Sample>, left: LeavingSamples, next: NextClip) -> Self {
        // Includes one sample before and one after, for rates.
        let before = MotionTime(-next.speed / stop::RATE);
        let beginning = next.samples(before, next.skipped_samples() + 3);
        let LeavingSamples { now, earliest } = left;
        let (left, entered) = (Features::new(body, &known), Features::new(body, &beginning));
        let moments = moments(&left, earliest.max(now), &entered);
        Self {
            body: Arc::clone(body),
            known,
            now,
            next,
            moments,
            found: none_yet(),
        }
    }

    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        let known = self.known.len();
        let seconds = transition::RUN_UP + transition::AHEAD + transition::BEYOND;
        let skipped = self.next.skipped_samples();
        let fits = |m: &Moment| {
            m.left >= self.now.max(1)
                && m.left < known.saturating_sub(1)
                && m.entered <= skipped + 1
                && m.place.is_finite()
        };
        self.next.is_valid()
            && known <= (seconds * stop::RATE).ceil() as usize + 1
            && self.moments.len() <= transition::CANDIDATES
            && self.moments.iter().all(fits)
    }

    /// The moments at which the motions are alike, most alike first.
    pub fn moments(&self) -> &[Moment] {
        &self.moments
    }

    /// Time of the clip at which it is entered at a moment.
    pub fn enters(&self, moment: &Moment) -> MotionTime {
        MotionTime(moment.entered as f64 * self.next.speed / stop::RATE)
    }

    /// The path at the `k`-th moment, and where it puts the origin of the clip; `None` if a body cannot follow it, or
    /// if an earlier one has already been found.
    pub fn way(&self, k: usize) -> Option<(TransitionClip, PlanarTransform)> {
        let moment = self.moments.get(k)?;
        if k > self.found.load(Ordering::Relaxed) {
            return None;
        }
        let (asks, way) = transition_at(
            &self.body,
            &self.known,
            self.now,
            &self.next,
            ClipEntry {
                moment,
                enters: self.enters(moment),
            },
        )?;
        if asks > transition::MOST_INFEASIBLE {
            return None;
        }
        self.found.fetch_min(k, Ordering::Relaxed);
        Some((way, moment.place))
    }

    /// Whether a path has been found.
    pub fn found(&self) -> bool {
        self.found.load(Ordering::Relaxed) < usize::MAX
    }
}

#[cfg(test)]
mod tests;
