//! Stances of the feet. Stretches labelled as near the floor become stances: shuffling or turning stretches are split,
//! and swings get the time they need.

use super::sole::{Sole, turn, yaw_pitch};
use super::{RecordedFoot, median};
use crate::math::runs::runs;
use crate::math::{Quat, Vec3, trig};
use crate::plan::params::{contact, stance};
use std::ops::Range;

/// One stance of one foot, with fixed place and heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stance {
    /// First sample.
    pub start: usize,
    /// One past the last sample.
    pub end: usize,
}

/// Foot point and heading per sample: where the flat ankle would be over the floor.
pub(super) struct FootTrack {
    pub point: Vec<Vec3>,
    pub yaw: Vec<f64>,
    pub pitch: Vec<f64>,
    pub roll: Vec<f64>,
}

impl FootTrack {
    pub fn new(sole: &Sole, ankles: &[Vec3], rotations: &[Quat]) -> Self {
        let n = ankles.len();
        let mut t = Self {
            point: Vec::with_capacity(n),
            yaw: Vec::with_capacity(n),
            pitch: Vec::with_capacity(n),
            roll: Vec::with_capacity(n),
        };
        for (a, q) in ankles.iter().zip(rotations) {
            let (yaw, pitch) = yaw_pitch(*q);
            let before = t.yaw.last().copied().unwrap_or(yaw);
            t.yaw.push(before + turn(before, yaw));
            t.pitch.push(pitch);
            t.roll.push(trig::asin(q.rotate(Vec3::Y).z));
            let lift = sole.stand(Vec3::zero(), yaw, pitch).ankle;
            t.point.push((*a - lift).horizontal());
        }
        t
    }

    /// Median place and heading over the middle 70 % of a stance.
    pub fn anchor(&self, start: usize, end: usize) -> (Vec3, f64) {
        let margin = (end - start) * stance::PLACE_MARGIN / 100;
        let mid = start + margin..(end - margin).max(start + margin + 1);
        let of = |f: &dyn Fn(usize) -> f64| median(mid.clone().map(f).collect());
        let place = [of(&|i| self.point[i].x), of(&|i| self.point[i].y)];
        (Vec3::on_floor(place), of(&|i| self.yaw[i]))
    }

    /// Distance of a sample from an anchor in units of [`stance::STRAY_DISTANCE`].
    pub fn stray(&self, i: usize, anchor: Vec3, yaw: f64) -> f64 {
        ((self.point[i] - anchor).norm() / stance::STRAY_DISTANCE)
            .max((self.yaw[i] - yaw).abs() / stance::STRAY_ANGLE)
    }

    /// Splits a stance in which the foot visibly shuffles or pivots into stances joined by short steps, or moves its
    /// start or end past that movement. Only done while the `other` foot is on the floor: a foot that shuffles alone
    /// stays.
    fn split(&self, samples: Range<usize>, other: &[bool], rate_hz: f64, out: &mut StancePieces) {
        let Range { start, end } = samples;
        let shortest = (stance::SHORTEST * rate_hz) as usize;
        let (anchor, yaw) = self.anchor(start, end);
        let margin = (end - start) / stance::SPLIT_MARGIN;
        let inner = start + margin..end - margin;
        let worst = inner
            .clone()
            .map(|i| self.stray(i, anchor, yaw))
            .fold(0.0, f64::max);
        if worst <= 1.0 {
            out.push((start, end));
            return;
        }
        let moved = |a: usize, b: usize| self.stray(b, self.point[a], self.yaw[a]);
        // Around the sample at which the foot moves fastest over one shuffle's time; the first choice that fits is
        // taken.
        for half in [
            stance::HALF_SHUFFLE,
            stance::HALF_QUICK_SHUFFLE,
            stance::HALF_QUICKEST_SHUFFLE,
        ] {
            let half = (half * rate_hz) as usize;
            let at = (start + shortest + half..end.saturating_sub(half + shortest))
                .filter(|i| other[i - half..=i + half].iter().all(|o| *o))
                .map(|i| (i, moved(i - half, i + half)))
                .max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
            if let Some((i, _)) = at.filter(|(_, far)| *far > stance::LEAST_SHUFFLE) {
                self.split(start..i - half, other, rate_hz, out);
                self.split(i + half..end, other, rate_hz, out);
                return;
            }
        }
        // A foot that drags on after the other has landed is lifted there; one that slides on while the other is still
        // planted comes down later.
        let alone_until = (start..end)
            .rev()
            .find(|i| !other[*i])
            .map_or(start, |i| i + 1);
        let alone_from = (start..end).find(|i| !other[*i]).unwrap_or(end);
        let least = shortest.max((end - start) / 3).max(1);
        let drags = (stance::OVERLAP * rate_hz) as usize;
        let tail = (alone_until + drags).max(start + least);
        let head = alone_from.min(end.saturating_sub(least));
        if tail < end && moved(tail, end - 1) > stance::LEAST_SHUFFLE {
            self.split(start..tail, other, rate_hz, out);
        } else if head > start && moved(start, head) > stance::LEAST_SHUFFLE {
            self.split(head..end, other, rate_hz, out);
        } else {
            out.push((start, end));
        }
    }

    /// Shortens a stance at either end by the samples that stray while the other foot is planted too. A foot that
    /// begins to turn away, or that is still arriving, is not planted, and the rest of the stance must not pivot
    /// because of it.
    fn trim(&self, samples: Range<usize>, other: &[bool], rate_hz: f64) -> Range<usize> {
        let Range { start, end } = samples;
        let (anchor, yaw) = self.anchor(start, end);
        let edge = ((end - start) / stance::TRIM_SHARE).min((stance::TRIM_TIME * rate_hz) as usize);
        let astray = |i: usize| self.stray(i, anchor, yaw);
        let leaves = |i: &usize| other[*i] && astray(*i) > stance::TRIM_STRAY;
        let cut = |outermost: usize, n: usize| if astray(outermost) > 1.0 { n } else { 0 };
        // Where the recording begins or ends there is no swing to which the samples could belong.
        let clip = |at: usize, n: usize| if at == 0 || at == other.len() { 0 } else { n };
        let head = (start..start + edge).take_while(leaves).count();
        let tail = (end - edge..end).rev().take_while(leaves).count();
        let (head, tail) = (clip(start, head), clip(end, tail));
        let (from, to) = (start + cut(start, head), end - cut(end - 1, tail));
        if (from..to).any(|i| astray(i) > stance::STEADY_STRAY) {
            return start..end;
        }
        from..to
    }

    /// Lengthens swings that are too short for their distance, using time in which both feet are on the floor. The time
    /// is taken from the stance before or the one after, wherever the recorded foot is further from its anchor, and at
    /// most half of it, since the other foot may need some as well. Labels see only the fastest part of a low step.
    fn unhurry(&self, pieces: &mut [(usize, usize)], other: &[bool], rate_hz: f64) {
        let shortest = (stance::SHORTEST * rate_hz) as usize;
        let placements: Vec<_> = pieces.iter().map(|&(i, j)| self.anchor(i, j)).collect();
        for w in 1..pieces.len() {
            let ((from, yaw_from), (to, yaw_to)) = (placements[w - 1], placements[w]);
            let way = (to - from).norm() + stance::TURN_ARM * (yaw_to - yaw_from).abs();
            let needed = ((way / stance::SWING_ACCELERATION).sqrt() * rate_hz).ceil() as usize;
            let ((start, mut end), (mut begin, finish)) = (pieces[w - 1], pieces[w]);
            let both = |k: &usize| other[*k];
            let (first, last) = ((start + shortest).min(end), finish.saturating_sub(shortest));
            let mut before = (first..end).rev().take_while(both).count() / 2;
            let mut after = (begin..last.max(begin)).take_while(both).count() / 2;
            while begin - end < needed && before + after > 0 {
                let left = self.stray(end - 1, from, yaw_from);
                let right = self.stray(begin, to, yaw_to);
                if after == 0 || (before > 0 && left >= right) {
                    (end, before) = (end - 1, before - 1);
                } else {
                    (begin, after) = (begin + 1, after - 1);
                }
            }
            (pieces[w - 1].1, pieces[w].0) = (end, begin);
        }
    }

    /// Stances of the foot, from its `label` of being on the floor and that of the `other` foot.
    pub fn pieces(&self, label: &[bool], other: &[bool], rate_hz: f64) -> StancePieces {
        let mut pieces = Vec::new();
        for (i, j, on) in runs(label) {
            let of = |v: &[f64]| median(v[i..j].to_vec());
            let (pitch, roll) = (of(&self.pitch), of(&self.roll));
            if on
                && pitch > contact::LEAST_PITCH
                && pitch < contact::MOST_TILT
                && roll.abs() < contact::MOST_TILT
            {
                self.split(i..j, other, rate_hz, &mut pieces);
            }
        }
        pieces
    }

    /// Distance of the recorded foot from its stances, squared and summed, in units of [`stance::STRAY_DISTANCE`].
    fn strays(&self, pieces: &[(usize, usize)]) -> f64 {
        let of = |&(i, j): &(usize, usize)| {
            let (anchor, yaw) = self.anchor(i, j);
            (i..j)
                .map(|k| self.stray(k, anchor, yaw).powi(2))
                .sum::<f64>()
        };
        pieces.iter().map(of).sum()
    }
}

/// Stances of both feet: where their labels have them on the floor and they neither shuffle nor turn away. The foot
/// that gives way to the other first is the one whose choice keeps the stances closer to the recorded feet.
///
/// * `labels`: where the feet are on the floor.
/// * `rate_hz`: samples per second.
pub fn stances(
    soles: &[Sole; 2],
    recorded: [RecordedFoot<'_>; 2],
    labels: [&[bool]; 2],
    rate_hz: f64,
) -> [Vec<Stance>; 2] {
    let tracks: [FootTrack; 2] = std::array::from_fn(|s| {
        FootTrack::new(&soles[s], recorded[s].ankles, recorded[s].rotations)
    });
    let first = |first: usize| sequence(&tracks, labels, [first, 1 - first], rate_hz);
    let (left, right) = (first(0), first(1));
    let strays =
        |pieces: &[StancePieces; 2]| tracks[0].strays(&pieces[0]) + tracks[1].strays(&pieces[1]);
    let best = if strays(&left) <= strays(&right) {
        left
    } else {
        right
    };
    best.map(|pieces| {
        let stance = |(start, end)| Stance { start, end };
        pieces.into_iter().map(stance).collect()
    })
}

/// Stances of one foot as half-open ranges of samples, in order.
pub(super) type StancePieces = Vec<(usize, usize)>;

/// The stances of both feet if foot `order[0]` gives way first. The other foot relies on the stances of the first, not
/// on its labels: two feet that turn on the floor would each leave the body to the other one.
fn sequence(
    tracks: &[FootTrack; 2],
    labels: [&[bool]; 2],
    order: [usize; 2],
    rate_hz: f64,
) -> [StancePieces; 2] {
    let held = |pieces: &StancePieces| {
        let mut held = vec![false; labels[0].len()];
        pieces.iter().for_each(|&(i, j)| held[i..j].fill(true));
        held
    };
    let [first, second] = order;
    let mut out: [StancePieces; 2] = Default::default();
    out[first] = tracks[first].pieces(labels[first], labels[second], rate_hz);
    out[second] = tracks[second].pieces(labels[second], &held(&out[first]), rate_hz);
    for s in order {
        let other = held(&out[1 - s]);
        for piece in &mut out[s] {
            let trimmed = tracks[s].trim(piece.0..piece.1, &other, rate_hz);
            *piece = (trimmed.start, trimmed.end);
        }
    }
    for s in order {
        let other = held(&out[1 - s]);
        tracks[s].unhurry(&mut out[s], &other, rate_hz);
    }
    out
}
