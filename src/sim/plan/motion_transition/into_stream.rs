//! From a stand into a stream that begins in motion.
//!
//! The samples already received are treated as a clip. Among the moments of its first step, the search takes the one
//! that steps from the stand reach with the smallest unsupported force ([`super::from_stand`]). The stream continues
//! after that path.

use super::NextClip;
use crate::body::{Body, Posture};
use crate::motion::clip::Clip;
use crate::plan::StreamPlan;
use crate::plan::cycle::relabel_prepared;
use crate::plan::feasibility::infeasibility;
use crate::plan::params::{stop, stream, transition};
use crate::plan::splice::Sample;
use crate::time::{MotionTime, StreamTime};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A posture, and the planted feet if the sender knows.
pub type Came = (Posture, Option<[bool; 2]>);

/// The beginning of a stream, and the stand of the figure that is to follow it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct StreamBeginning {
    #[serde(with = "crate::saved::definition")]
    body: Arc<Body>,
    came: Vec<Came>,
    stand: Posture,
}

/// The path from a stand into a stream.
#[derive(Clone, Debug)]
pub struct StreamEntry {
    /// Samples of the path, in the place of the stream, 1/[`stream::RATE`] s apart.
    pub samples: Vec<Sample>,
    /// Sample of the stream that follows the path.
    pub goes_on: usize,
}

/// Samples after the moment to which the steps lead; they are prepared together with the steps.
fn samples_after() -> usize {
    ((stop::BLEND_TIME + stop::PREPARED_TIME) * stream::RATE).ceil() as usize
}

impl StreamBeginning {
    /// Number of samples of a stream that are needed.
    pub fn needed() -> usize {
        // A step, which is half a stride, so that there is a moment to which steps can lead.
        (0.5 * transition::AHEAD * stream::RATE) as usize + samples_after() + 1
    }

    /// Number of samples of a stream that has ended with which a path can be sought.
    pub fn least() -> usize {
        samples_after() + 1
    }

    /// * `came`: [`Self::needed`] samples, or all of a stream that has ended, if they are at least [`Self::least`];
    ///   1/[`stream::RATE`] s apart.
    /// * `stand`: how the figure stands.
    pub fn new(body: &Arc<Body>, came: Vec<Came>, stand: Posture) -> Self {
        Self {
            body: Arc::clone(body),
            came,
            stand,
        }
    }

    /// Whether this value is one that a checkpoint could hold.
    pub fn is_valid(&self) -> bool {
        (1..=2 * Self::needed()).contains(&self.came.len())
            && self.stand.is_finite()
            && self.came.iter().all(|(p, _)| p.is_finite())
    }

    /// Feet on the floor, as the window of a stream labels them.
    fn labelled(&self) -> Vec<[bool; 2]> {
        let mut plan = StreamPlan::new(Arc::clone(&self.body), stream::SHORTEST_WINDOW);
        for (posture, planted) in &self.came {
            plan.push(posture, *planted);
        }
        let came = self.came.len();
        plan.advance(StreamTime(came as f64 / stream::RATE - plan.window()));
        let (_, known) = plan.known(StreamTime(0.0), came as i64);
        let mut labels: Vec<_> = known.into_iter().map(|s| s.1).collect();
        labels.resize(came, labels.last().copied().unwrap_or([true; 2]));
        labels
    }

    /// The path; `None` if there is none that a body can follow. Allocates.
    pub fn way(&self) -> Option<StreamEntry> {
        let body = &*self.body;
        let postures = self.came.iter().map(|c| c.0).collect();
        let clip = Clip::from_postures("stream", stream::RATE, postures, self.labelled()).ok()?;
        let next = NextClip {
            clip: Arc::new(clip),
            speed: 1.0,
            looped: false,
        };
        let latest = self.came.len().checked_sub(samples_after() + 1)?;
        let mut best = None;
        // Later moments first: the later, the less the figure is behind.
        for entered in (0..=latest).rev().step_by(stop::SEARCH_STRIDE / 2) {
            let first = MotionTime(entered as f64 / stream::RATE);
            let Some(way) = next.from_stand(body, first, &self.stand) else {
                continue;
            };
            let (postures, planted): (Vec<_>, Vec<_>) =
                way.clip.samples().map(|(p, f)| (*p, f)).unzip();
            let label = relabel_prepared(body, stop::RATE, &postures, &planted);
            let asks = infeasibility(body, &postures, &label);
            if best.as_ref().is_none_or(|(least, _)| asks < *least) {
                best = Some((asks, way));
            }
            if asks < stop::EASY {
                break;
            }
        }
        let (asks, way) = best?;
        if asks > transition::MOST_INFEASIBLE {
            return None;
        }
        let goes_on = (way.until.0 * stream::RATE).round() as usize;
        let until = MotionTime(goes_on as f64 / stream::RATE);
        let count = ((until - way.begin) * stream::RATE + 1e-6).floor() as usize;
        let sample = |k: usize| {
            let t = way.clip.sample(until - k as f64 / stream::RATE - way.begin);
            (t.posture, t.planted)
        };
        Some(StreamEntry {
            samples: (1..=count).rev().map(sample).collect(),
            goes_on,
        })
    }
}
