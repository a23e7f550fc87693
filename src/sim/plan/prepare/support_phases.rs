//! The support of the body in each sample, and how well the plan stays over it.

use crate::body::angles::clamp_to_limits;
use crate::body::{Body, Posture};
use crate::math::polygon::{hull, margin};
use crate::motion::filter::{low_pass, percentile};
use crate::motion::leg_ik::forward;
use crate::plan::ankle_torque_limit::{AnkleTorqueLimit, Over};
use crate::plan::foot_lock::{AnklePose, LockedFoot, Sole};
use crate::plan::params::{ankle, balance, leg, pelvis};
use crate::plan::pelvis_shift::{MassTrack, OtherSupport, SupportPhase};
use crate::reference::units::millimetres;
use serde::Serialize;

/// How far the zero-moment point is outside the support polygon of planted feet, over the samples that feet carry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ZmpOutside {
    /// Fraction of the samples outside.
    #[serde(rename = "share")]
    pub fraction: f64,
    /// Mean excess over all samples (0 inside), m.
    #[serde(rename = "mean_mm", serialize_with = "millimetres")]
    pub mean: f64,
    /// 95th percentile of the excess, m.
    #[serde(rename = "p95_mm", serialize_with = "millimetres")]
    pub p95: f64,
    /// Largest excess, m.
    #[serde(rename = "max_mm", serialize_with = "millimetres")]
    pub max: f64,
}

/// Whether each foot is planted, per sample.
pub(in crate::plan) fn planted_of(locked: &[LockedFoot; 2]) -> Vec<[bool; 2]> {
    let [left, right] = locked;
    let both = left.planted.iter().zip(&right.planted);
    both.map(|(l, r)| [*l, *r]).collect()
}

/// Feet that are locked to the floor, and which of them carry the body.
#[derive(Clone, Copy)]
pub(in crate::plan) struct StandingFeet<'a> {
    /// Soles of the left and the right foot.
    pub soles: &'a [Sole; 2],
    /// The locks of both feet.
    pub locked: &'a [LockedFoot; 2],
    /// Whether each foot carries, per sample.
    pub carries: &'a [[bool; 2]],
}

/// Whether each planted foot carries the body. Where both feet are planted and only one leg, within its limits, holds
/// its foot near its place, the other foot does not carry: it will be declared free in the end, which would leave a
/// body that is balanced on two feet standing on one.
pub(super) fn within_reach(
    body: &Body,
    postures: &[Posture],
    planted: &[[bool; 2]],
    soles: &[Sole; 2],
    locked: &[LockedFoot; 2],
) -> Vec<[bool; 2]> {
    let carries = |(i, planted): (usize, &[bool; 2])| {
        let mut posture = postures[i];
        clamp_to_limits(body, &mut posture, leg::LIMIT_MARGIN * 0.5);
        let poses = forward(body, &posture);
        let near = |s: usize| {
            let stray = soles[s].stray(AnklePose::of(&poses, s), &locked[s].poses[i]);
            stray <= leg::SEAM_HELD
        };
        match *planted {
            [true, true] if near(0) != near(1) => [near(0), near(1)],
            as_locked => as_locked,
        }
    };
    planted.iter().enumerate().map(carries).collect()
}

/// The support of the body in each sample.
pub(in crate::plan) fn support_phases(
    body: &Body,
    feet: StandingFeet<'_>,
    upper: &[Posture],
    label: &[[bool; 2]],
) -> Vec<SupportPhase> {
    let standing = body.standing_root_height();
    let mut corners = Vec::new();
    (0..upper.len())
        .map(|i| {
            corners.clear();
            for s in (0..2).filter(|s| feet.carries[i][*s]) {
                feet.soles[s].footprint(&feet.locked[s].placements[i], &mut corners);
            }
            if upper[i].root_position.z < pelvis::SEATED * standing {
                SupportPhase::Other
            } else if corners.len() >= 3 {
                SupportPhase::Feet(hull(&corners))
            } else if label[i] == [false, false] {
                SupportPhase::Air
            } else {
                SupportPhase::Other
            }
        })
        .collect()
}

/// The same, such that no foot alone needs more torque than its ankle has; for a body that `runs` or walks.
pub(in crate::plan) fn limit_ankle_torques(
    support: &[SupportPhase],
    feet: StandingFeet<'_>,
    limit: &AnkleTorqueLimit,
    track: &MassTrack,
    runs: bool,
    rate_hz: f64,
) -> Vec<SupportPhase> {
    let half = (0.5 * ankle::SPEED_TIME * rate_hz) as usize;
    // Without the jumps at touch-down, which would keep the rounds from settling.
    let lean: [Vec<f64>; 2] = std::array::from_fn(|k| {
        let both = track.com.iter().zip(&track.zmp);
        let mut lean: Vec<f64> = both.map(|(c, z)| c.to_array()[k] - z[k]).collect();
        low_pass(&mut lean, ankle::LEAN_CUTOFF, rate_hz);
        lean
    });
    let mut corners = Vec::new();
    let limited = |(i, phase): (usize, &SupportPhase)| {
        let side = match feet.carries[i] {
            [true, false] => 0,
            [false, true] => 1,
            _ => return phase.clone(),
        };
        if !matches!(phase, SupportPhase::Feet(_)) {
            return phase.clone();
        }
        corners.clear();
        let (before, after) = (i.saturating_sub(half), (i + half).min(support.len() - 1));
        let way = track.com[after] - track.com[before];
        let over = Over {
            height: track.com[i].z,
            speed: way.level() * rate_hz / (after - before).max(1) as f64,
            lean: [lean[0][i], lean[1][i]],
            load: runs.then(|| track.load[i]),
        };
        let at = &feet.locked[side].placements[i];
        limit.each_corner(&feet.soles[side], at, &over, |p| corners.push(p));
        SupportPhase::Feet(hull(&corners))
    };
    support.iter().enumerate().map(limited).collect()
}

/// Supports other than the feet that may carry the body: a seat where the pelvis is low, hands where both feet stay for
/// a while. A body that steps is carried by its feet.
pub(in crate::plan) fn other_support(
    body: &Body,
    upper: &[Posture],
    planted: &[[bool; 2]],
    rate_hz: f64,
) -> Vec<OtherSupport> {
    let standing = body.standing_root_height();
    let n = upper.len();
    let half = (balance::STAYS * rate_hz) as usize;
    let smooth = |mut x: Vec<f64>| {
        low_pass(&mut x, balance::OTHER_CUTOFF, rate_hz);
        x
    };
    let seat = upper.iter().map(|p| {
        ((pelvis::NO_SEAT - p.root_position.z / standing) / (pelvis::NO_SEAT - pelvis::SEAT))
            .clamp(0.0, 1.0)
    });
    let stays = |i: usize| {
        let around = i.saturating_sub(half)..(i + half).min(n);
        planted[around].iter().all(|p| *p == [true; 2])
    };
    let hands = (0..n).map(|i| f64::from(stays(i)));
    let (seat, hands) = (smooth(seat.collect()), smooth(hands.collect()));
    let both = seat.into_iter().zip(hands);
    both.map(|(seat, hands)| OtherSupport {
        seat: seat.clamp(0.0, 1.0),
        hands: hands.clamp(0.0, 1.0),
    })
    .collect()
}

pub(super) fn zmp_outside(track: &MassTrack, support: &[SupportPhase]) -> ZmpOutside {
    let outside: Vec<f64> = track
        .zmp
        .iter()
        .zip(support)
        .zip(&track.load)
        .filter_map(|((z, c), load)| match c {
            SupportPhase::Feet(p) if *load > balance::LEAST_LOAD => Some((-margin(p, *z)).max(0.0)),
            _ => None,
        })
        .collect();
    let n = outside.len().max(1) as f64;
    ZmpOutside {
        fraction: outside.iter().filter(|x| **x > 0.0).count() as f64 / n,
        mean: outside.iter().sum::<f64>() / n,
        p95: percentile(&outside, 0.95),
        max: outside.iter().copied().fold(0.0, f64::max),
    }
}
