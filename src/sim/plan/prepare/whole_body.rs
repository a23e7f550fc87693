//! Postures assembled from parts that are computed one by one: upper body, feet, and the movement of the trunk.

use super::ankle_unloading::AnkleUnloading;
use super::{Draft, pelvis_yaw};
use crate::body::topology::{JOINT, Joint, outward};
use crate::body::{Body, Posture};
use crate::math::curve::smoothstep;
use crate::math::runs::runs;
use crate::math::{Quat, Vec3};
use crate::motion::filter::{low_pass, low_pass_points, low_pass_rotations};
use crate::motion::leg_ik::{leg_segments, solve_leg_in_plane};
use crate::plan::envelope::smoothest_below;
use crate::plan::flight_phases::FlightPhases;
use crate::plan::foot_lock::LockedFoot;
use crate::plan::leg_reach::{leg_geometry, room_above};
use crate::plan::params::{leg, swing};

/// Postures from upper body, feet and trunk shift: pelvis lowered until planted legs reach, legs solved.
pub(super) fn assemble(
    body: &Body,
    upper: &[Posture],
    locked: &[LockedFoot; 2],
    draft: &Draft,
    unloading: &AnkleUnloading,
    shift: &[[f64; 2]],
    flights: Option<&FlightPhases>,
) -> (Vec<Posture>, Vec<f64>) {
    let n = upper.len();
    let legs = [0, 1].map(|side| leg_geometry(body, side));
    let mut out = upper.to_vec();
    let mut drop = vec![f64::INFINITY; n];
    for i in 0..n {
        pelvis_yaw::turn(body, &mut out[i], unloading.yaw[i]);
        out[i].root_position.x += shift[i][0];
        out[i].root_position.y += shift[i][1];
        for ((hip, length), foot) in legs.iter().zip(locked) {
            let line =
                out[i].root_position + out[i].root_rotation.rotate(*hip) - foot.poses[i].ankle;
            let room = room_above(line, leg::REACH * length, foot.planted[i]);
            drop[i] = drop[i].min(room);
        }
    }
    let drop = match flights {
        None => smoothest_below(&drop, leg::DROP_TIME, draft.rate_hz),
        Some(f) => f.heights(&drop),
    };
    let mut path: Vec<Vec3> = (0..n)
        .map(|i| {
            let mut p = out[i].root_position;
            p.z += drop[i];
            p
        })
        .collect();
    if flights.is_none() {
        low_pass_points(&mut path, swing::HEIGHT_CUTOFF, draft.rate_hz);
    }
    let flies = if flights.is_some() {
        vec![0.0; n]
    } else {
        in_flight(locked, draft.rate_hz)
    };
    for i in 0..n {
        // In the air the feet go where the pelvis goes; a runner's swing continues.
        let moved = (path[i] - upper[i].root_position) * flies[i];
        out[i].root_position = path[i];
        for (s, (hip, length)) in legs.iter().enumerate() {
            let mut foot = locked[s].poses[i];
            foot.ankle += moved;
            let hip = path[i] + out[i].root_rotation.rotate(*hip);
            let line = foot.ankle - hip;
            let far = line.norm();
            let most = leg::SWING_REACH * length;
            if !locked[s].planted[i] && far > most {
                foot.ankle = hip + line * (most / far);
            }
            // Inwards is clockwise seen from above for the left leg: positive about the line pointing down.
            let inward = outward(s) * unloading.turn_in[s][i];
            let axis =
                Quat::exp(line.normalized_or(-Vec3::Z) * inward).rotate(draft.knee_axis[s][i]);
            solve_leg_in_plane(
                body,
                &mut out[i],
                s == 0,
                (foot.ankle, foot.rotation),
                foot.toe,
                axis,
            );
        }
    }
    for (s, foot) in locked.iter().enumerate() {
        smooth_swings(&mut out, s, &foot.planted, draft.rate_hz);
    }
    (out, drop)
}

/// From 0 while the foot is planted to 1 inside a stretch where it is not, per sample; rises and falls within `edge` s.
fn off_floor(stands: &[bool], edge: f64, rate_hz: f64) -> Vec<f64> {
    let mut share = vec![0.0; stands.len()];
    for (i, j, _) in runs(stands).into_iter().filter(|run| !run.2) {
        for (k, s) in share.iter_mut().enumerate().take(j).skip(i) {
            let since = if i > 0 { k + 1 - i } else { usize::MAX };
            let until = if j < stands.len() { j - k } else { usize::MAX };
            let u = (since.min(until) as f64 / (edge * rate_hz)).min(1.0);
            *s = smoothstep(u);
        }
    }
    share
}

/// From 0 while a foot is planted to 1 inside a flight, per sample. A stretch at the very beginning or end of the
/// motion does not count as a flight.
fn in_flight(locked: &[LockedFoot; 2], rate_hz: f64) -> Vec<f64> {
    let planted = locked[0].planted.iter().zip(&locked[1].planted);
    let grounded: Vec<bool> = planted.map(|(l, r)| *l || *r).collect();
    let mut share = off_floor(&grounded, swing::FLIGHT_EDGE, rate_hz);
    let first = grounded.iter().position(|on| *on);
    let last = grounded.iter().rposition(|on| *on);
    share[..first.unwrap_or(grounded.len())].fill(0.0);
    share[last.unwrap_or(0)..].fill(0.0);
    share
}

/// Low-pass of the joints of a swinging leg: a nearly straight knee makes inverse kinematics jump. Planted legs stay as
/// they are.
fn smooth_swings(postures: &mut [Posture], side: usize, planted: &[bool], rate_hz: f64) {
    // From 0 while the foot is planted to 1 inside a swing.
    let share = off_floor(planted, swing::JOINT_EDGE, rate_hz);
    for segment in leg_segments(side == 0) {
        match JOINT[segment.index()] {
            Joint::Ball(b) => {
                let mut q: Vec<Quat> = postures.iter().map(|p| p.ball[b]).collect();
                low_pass_rotations(&mut q, swing::JOINT_CUTOFF, rate_hz);
                for ((p, q), s) in postures.iter_mut().zip(q).zip(&share) {
                    let to = (q * p.ball[b].conjugate()).log() * *s;
                    p.ball[b] = (Quat::exp(to) * p.ball[b]).normalized();
                }
            }
            Joint::Hinge1(h) => {
                let mut a: Vec<f64> = postures.iter().map(|p| p.hinge[h]).collect();
                low_pass(&mut a, swing::JOINT_CUTOFF, rate_hz);
                for ((p, a), s) in postures.iter_mut().zip(a).zip(&share) {
                    p.hinge[h] += s * (a - p.hinge[h]);
                }
            }
            _ => unreachable!("legs have ball joints and hinges of one axis"),
        }
    }
}
