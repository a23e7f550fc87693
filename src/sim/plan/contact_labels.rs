//! When each foot is planted, from trajectories of points of the feet.
//!
//! A captured foot slides a little in stance, and its floor is off by centimetres. A foot therefore counts as planted
//! while one of its points moves slowly near its *own* lowest level. Hysteresis is applied, and short gaps and short
//! touches are cleaned up afterwards.

use crate::body::topology::{L_FOOT, L_TOES, R_FOOT, R_TOES};
use crate::body::{Body, Posture};
use crate::math::Vec3;
use crate::math::runs::{remove_short, runs};
use crate::motion::filter::{low_pass_points, percentile, speeds};
use crate::motion::leg_ik::forward;
use crate::plan::params::contact;
use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};

/// A stretch of the clip with the same feet on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPhase {
    /// Start, s from the start of the clip.
    pub start: f64,
    /// End, s.
    pub end: f64,
    /// Whether the left and the right foot are planted.
    pub planted: [bool; 2],
}

impl Serialize for ContactPhase {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        let mut out = s.serialize_struct("ContactPhase", 4)?;
        out.serialize_field("from_s", &self.start)?;
        out.serialize_field("to_s", &self.end)?;
        out.serialize_field("left", &self.planted[0])?;
        out.serialize_field("right", &self.planted[1])?;
        out.end()
    }
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
    // One foot is planted unless the body flies: a very short gap is closed by the foot that lands.
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

/// Lowest contact point of each foot (left, right) in a posture, world, m.
fn soles(body: &Body, posture: &Posture) -> [Vec3; 2] {
    let poses = forward(body, posture);
    [[L_FOOT, L_TOES], [R_FOOT, R_TOES]].map(|side| {
        let points = side.iter().flat_map(|s| {
            let (at, turn) = poses[s.index()];
            let points = body.segment(*s).contact_points.iter();
            points.map(move |c| at + turn.rotate(*c))
        });
        let lowest = points.min_by(|a, b| a.z.total_cmp(&b.z));
        lowest.unwrap_or(poses[side[0].index()].0)
    })
}

/// Feet (left, right) that a desired motion keeps on the floor between two postures `dt` seconds apart, on a floor at
/// z = 0: low and slow, by the thresholds of [`label_feet`], without hysteresis.
pub fn planted_between(body: &Body, before: &Posture, after: &Posture, dt: f64) -> [bool; 2] {
    let (a, b) = (soles(body, before), soles(body, after));
    std::array::from_fn(|i| {
        let slow = (b[i] - a[i]).norm() < contact::SPEED_ON * dt.max(1e-3);
        b[i].z < contact::HEIGHT_ON && slow
    })
}

/// [`planted_between`] for the neighbours of each posture.
pub fn label_postures(body: &Body, postures: &[Posture], rate_hz: f64) -> Vec<[bool; 2]> {
    (0..postures.len())
        .map(|i| {
            let (a, b) = (i.saturating_sub(1), (i + 1).min(postures.len() - 1));
            let dt = (b - a).max(1) as f64 / rate_hz;
            planted_between(body, &postures[a], &postures[b], dt)
        })
        .collect()
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
