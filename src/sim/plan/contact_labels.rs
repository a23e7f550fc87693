//! Which foot stands when, from trajectories of points of the feet.
//!
//! A captured foot slides a little in stance, and its floor is off by centimetres. So a foot counts as planted while
//! one of its points moves slowly near its *own* lowest level; hysteresis, short gaps and short touches are cleaned up
//! afterwards.

use crate::math::Vec3;
use crate::motion::filter::{low_pass_points, percentile, speeds};
use crate::plan::params::contact;

/// A stretch of the clip with the same feet on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPhase {
    /// Start, s from the start of the clip.
    pub start: f64,
    /// End, s.
    pub end: f64,
    /// Left foot, right foot planted.
    pub planted: [bool; 2],
}

impl ContactPhase {
    /// `D` both feet, `L`, `R`, or `-` none.
    pub fn letter(&self) -> char {
        match self.planted {
            [true, true] => 'D',
            [true, false] => 'L',
            [false, true] => 'R',
            [false, false] => '-',
        }
    }
}

/// Runs of equal value as half-open index ranges: `(start, end, value)`.
pub fn runs<T: PartialEq + Copy>(flags: &[T]) -> Vec<(usize, usize, T)> {
    let mut out = Vec::new();
    let mut start = 0;
    for i in 1..=flags.len() {
        if i == flags.len() || flags[i] != flags[start] {
            out.push((start, i, flags[start]));
            start = i;
        }
    }
    out
}

/// The [`runs`] of true values: `(start, end)`.
pub(crate) fn stretches(on: &[bool]) -> impl Iterator<Item = (usize, usize)> + use<> {
    let all = runs(on).into_iter().filter(|run| run.2);
    all.map(|(start, end, _)| (start, end))
}

/// Takes out what lasts for fewer than so many samples between others: first gaps, then what they are between.
pub(crate) fn remove_short(on: &mut [bool], shortest: f64) {
    for value in [false, true] {
        for (i, j, v) in runs(on) {
            if v == value && i > 0 && j < on.len() && ((j - i) as f64) < shortest {
                on[i..j].fill(!value);
            }
        }
    }
}

/// Labels both feet.
///
/// * `points`: for each foot the trajectories of its points (ankle, toe joint, toe tip; those the file has), m, z up,
///   all of one length.
/// * `rate_hz`: samples per second.
///
/// Returns left and right label per sample. O(n log n).
pub fn label_feet(points: [&[Vec<Vec3>]; 2], rate_hz: f64) -> Vec<[bool; 2]> {
    let n = points[0].first().map_or(0, Vec::len);
    let mut feet = points.map(|p| label_foot(p, n, rate_hz));
    // One foot stands unless it is a flight: a very short gap is closed by the foot that lands.
    let none: Vec<bool> = (0..n).map(|i| !feet[0][i] && !feet[1][i]).collect();
    for (i, j, gap) in runs(&none) {
        if gap && i > 0 && j < n && ((j - i) as f64) < contact::SHORTEST_FLIGHT * rate_hz {
            let side = usize::from(!feet[0][j]);
            feet[side][i..j].fill(true);
        }
    }
    (0..n).map(|i| [feet[0][i], feet[1][i]]).collect()
}

fn label_foot(points: &[Vec<Vec3>], n: usize, rate_hz: f64) -> Vec<bool> {
    let mut on = vec![false; n];
    for p in points {
        let mut p = p.clone();
        low_pass_points(&mut p, contact::CUTOFF, rate_hz);
        let speed = speeds(&p, rate_hz);
        let heights: Vec<f64> = p.iter().map(|p| p.z).collect();
        let level = percentile(&heights, contact::LEVEL_SHARE);
        let mut down = false;
        for i in 0..n {
            let (fast, high) = if down {
                (contact::SPEED_OFF, contact::HEIGHT_OFF)
            } else {
                (contact::SPEED_ON, contact::HEIGHT_ON)
            };
            down = speed[i] < fast && heights[i] - level < high;
            on[i] |= down;
        }
    }
    remove_short(&mut on, contact::SHORTEST * rate_hz);
    on
}

/// Phases of a label sequence, in order, without gaps between them.
pub fn phases(planted: &[[bool; 2]], rate_hz: f64) -> Vec<ContactPhase> {
    runs(planted)
        .into_iter()
        .map(|(i, j, planted)| ContactPhase {
            start: i as f64 / rate_hz,
            end: j as f64 / rate_hz,
            planted,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point that stands at height `z` for half a second, moves 0.6 m in an arc during half a second, and stands
    /// again.
    fn step(z: f64) -> Vec<Vec3> {
        (0..180)
            .map(|i| {
                let u = ((f64::from(i) - 60.0) / 60.0).clamp(0.0, 1.0);
                let s = u * u * (3.0 - 2.0 * u);
                Vec3::from_array([0.6 * s, 0.0, z + 0.3 * (s * (1.0 - s))])
            })
            .collect()
    }

    #[test]
    fn a_step_is_two_stances_whatever_the_level_of_the_floor() {
        for z in [-0.7, 0.0, 0.08] {
            let moving = [step(z)];
            let still = [vec![Vec3::from_array([0.0, 0.2, z]); 180]];
            let p = phases(&label_feet([&moving, &still], 120.0), 120.0);
            let letters: String = p.iter().map(ContactPhase::letter).collect();
            assert_eq!(letters, "DRD");
            assert!(
                (p[1].start - 0.5).abs() < 0.15 && (p[1].end - 1.0).abs() < 0.15,
                "{p:?}"
            );
        }
    }
}
