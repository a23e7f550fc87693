//! A stream that a figure enters later than it began. The path into the stream is played first, and the delay that this
//! causes is made up by skipping samples where the stream returns to a moment like the present one.

use super::{RATE, StreamPlan};
use crate::body::Posture;
use crate::motion::leg_ik::{center_of_mass, forward};
use crate::plan::likeness::Seam;
use crate::plan::motion_transition::StreamEntry;
use crate::plan::params::{pelvis, stop, stream, transition};
use std::sync::Arc;

impl StreamPlan {
    /// Samples that wait to be prepared, with the labels that came with them.
    pub fn waiting(&self) -> impl Iterator<Item = (Posture, Option<[bool; 2]>)> + '_ {
        self.input.pending.iter().map(|r| (r.posture, r.planted))
    }

    /// Number of samples taken.
    pub fn taken(&self) -> i64 {
        self.count
    }

    /// Whether the waiting samples, after the first `lead` ones, begin in motion, so that a standing body cannot join
    /// without a step. False while that is not known.
    pub fn begins_in_motion(&self, lead: usize) -> bool {
        let after = (stop::MEASURED_TIME * RATE).ceil() as usize;
        let came = &self.input.pending;
        let (Some(a), Some(b)) = (came.get(lead), came.get(lead + after)) else {
            return false;
        };
        let [p, q] = [a, b].map(|r| center_of_mass(&self.body, &forward(&self.body, &r.posture)));
        let upright =
            a.posture.root_position.z > pelvis::UPRIGHT * self.body.standing_root_height();
        upright && (q - p).level() * RATE > stop::STANDING_SPEED * after as f64
    }

    /// The same stream, begun by a path into it from a stand: the first `lead` waiting samples, then the path, then the
    /// rest of the stream. Allocates.
    pub fn led_in(&self, lead: usize, way: &StreamEntry) -> Self {
        let mut out = Self::new(Arc::clone(&self.body), self.window());
        for r in self.input.pending.iter().take(lead) {
            out.push(&r.posture, r.planted);
        }
        for (posture, planted) in &way.samples {
            out.push(posture, Some(*planted));
        }
        for r in self.input.pending.iter().skip(lead + way.goes_on) {
            out.push(&r.posture, r.planted);
        }
        out
    }

    /// Skips waiting samples up to a moment that is like the present one, at most `most` seconds. Returns the time
    /// skipped, s; 0 if there is no such moment.
    pub fn catch_up(&mut self, most: f64) -> f64 {
        let waiting = &self.input.pending;
        let end = ((most * RATE) as usize).min(waiting.len().saturating_sub(3));
        // A stride, so that there is a like moment in every walk.
        let first = end.saturating_sub((transition::AHEAD * RATE) as usize);
        // Skipping less than a steady stretch is not worth a seam.
        let first = first.max(transition::STEADY);
        // A stream that is about to be joined to this one does that first.
        if self.count < 3 || first >= end || self.placement.join.is_some() {
            return 0.0;
        }
        let left = [3, 2, 1].map(|k| self.at(self.count - k).raw);
        let hip = self.body.standing_root_height();
        // The cost of continuing without a skip is that of the delay.
        let goes_on = stream::DELAY_COST * most * most;
        let seam = |k: usize| {
            // The next sample is the one after those that are compared.
            let entered = [3, 2, 1].map(|back| waiting[k - back].posture);
            let seam = Seam::new(&left, &entered, hip, (end - k) as f64 / RATE);
            (seam.fits && seam.cost < goes_on).then_some((seam.cost, k))
        };
        let best = (first.max(3)..=end).filter_map(seam);
        let Some((_, k)) = best.min_by(|a, b| a.0.total_cmp(&b.0)) else {
            return 0.0;
        };
        self.input.pending.drain(..k);
        let (from, skipped) = (self.count, k as i64);
        // An end that is skipped with the samples before it is none.
        self.input.ends = match self.input.ends {
            Some(n) if n > from => (n > from + skipped).then(|| n - skipped),
            before => before,
        };
        self.placement.join = Some((self.count, transition::BLEND_TIME));
        k as f64 / RATE
    }
}
