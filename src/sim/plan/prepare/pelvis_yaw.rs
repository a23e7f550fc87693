//! A pelvis turned ahead of its recording, or behind it, where one stance asks for more rotation than a hip has in both
//! directions.

use crate::body::angles::{clamp_to_limits, swing_twist};
use crate::body::topology::{ABDOMEN, CHEST, DOF_START, THIGHS, outward};
use crate::body::{Body, Posture};
use crate::math::{Quat, Vec3};
use crate::motion::filter::smooth_minimum;
use crate::plan::ball_joint;
use crate::plan::foot_lock::Stance;
use crate::plan::params::leg;

/// Adds to `yaw` (rad per sample, anticlockwise seen from above) the rotation that the hips of planted feet lack.
///
/// This applies only to stances in which a hip turns further than from limit to limit; in others a different heading of
/// the foot is enough. The hip of the other foot, if that is planted as well, is not turned beyond its limits. When the
/// pelvis turns anticlockwise, the hip of a foot that stays turns inwards on the left and outwards on the right. O(n ·
/// window).
pub(super) fn add(
    body: &Body,
    postures: &[Posture],
    planted: &[[bool; 2]],
    stances: [&[Stance]; 2],
    yaw: &mut [f64],
    rate_hz: f64,
) {
    let dof = THIGHS.map(|t| DOF_START[t.index()]);
    let rotation = |side: usize, i: usize| {
        let hip = postures[i].ball[ball_joint(THIGHS[side])];
        swing_twist(hip).angles(dof[side])[2]
    };
    let limits = dof.map(|d| (body.lower[d + 2], body.upper[d + 2]));
    let mut lacks = vec![0.0; postures.len()];
    for side in 0..2 {
        let other = 1 - side;
        let (way, other_way) = (outward(side), outward(other));
        let half = 0.5 * (limits[side].1 - limits[side].0);
        for stance in stances[side] {
            let samples = stance.start..stance.end;
            let (least, most) = samples
                .clone()
                .map(|i| rotation(side, i))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), a| {
                    (l.min(a), m.max(a))
                });
            if most - least <= 2.0 * half {
                continue;
            }
            for i in samples {
                // The heading of the foot will spread the excess over both ends.
                let a = rotation(side, i) - 0.5 * (least + most);
                let lack =
                    -way * (a - a.clamp(leg::PLANTED_MARGIN - half, half - leg::PLANTED_MARGIN));
                lacks[i] += if planted[i][other] {
                    let a = rotation(other, i);
                    let (lower, upper) = limits[other];
                    let (down, up) = (
                        (a - lower - leg::PLANTED_MARGIN).max(0.0),
                        (upper - leg::PLANTED_MARGIN - a).max(0.0),
                    );
                    other_way * (other_way * lack).clamp(-down, up)
                } else {
                    lack
                };
            }
        }
    }
    if lacks.iter().all(|l| *l == 0.0) {
        return;
    }
    let half = (leg::YAW_TIME * rate_hz) as usize;
    let around = |sign: f64| {
        let part: Vec<f64> = lacks.iter().map(|l| -(sign * l).max(0.0)).collect();
        smooth_minimum(&part, half)
    };
    let both = around(1.0).into_iter().zip(around(-1.0));
    for (yaw, (plus, minus)) in yaw.iter_mut().zip(both) {
        *yaw = (*yaw + minus - plus).clamp(-leg::MOST_YAW, leg::MOST_YAW);
    }
}

/// Turns the pelvis by `yaw`, rad, about the vertical; the chest stays as far as the limits of waist and thorax allow.
pub(super) fn turn(body: &Body, posture: &mut Posture, yaw: f64) {
    if yaw != 0.0 {
        turn_about(posture, Vec3::Z, yaw);
        clamp_to_limits(body, posture, leg::LIMIT_MARGIN);
    }
}

/// Turns the pelvis by `angle`, rad, about an axis of the world. Waist and thorax turn back by half of it each.
pub(super) fn turn_about(posture: &mut Posture, axis: Vec3, angle: f64) {
    let (waist, thorax) = (ball_joint(ABDOMEN), ball_joint(CHEST));
    let about = |angle: f64| Quat::exp(axis * angle);
    let abdomen = posture.root_rotation * posture.ball[waist];
    let chest = abdomen * posture.ball[thorax];
    let abdomen = about(0.5 * angle) * abdomen;
    posture.root_rotation = (about(angle) * posture.root_rotation).normalized();
    posture.ball[waist] = (posture.root_rotation.conjugate() * abdomen).normalized();
    posture.ball[thorax] = (abdomen.conjugate() * chest).normalized();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::topology::{L_THIGH, R_THIGH};

    /// A right leg that turns from one end to the other while its foot stays, beside a left one that is not planted or
    /// is planted with `spare` rad left; 60 Hz.
    fn turned(ends: f64, left: Option<f64>) -> Vec<f64> {
        let body = Body::adult_man();
        let n = 60;
        let upper = body.upper[DOF_START[L_THIGH.index()] + 2];
        let postures: Vec<Posture> = (0..n)
            .map(|i| {
                let mut p = Posture::default();
                let u = 2.0 * i as f64 / (n - 1) as f64 - 1.0;
                // Inwards is anticlockwise for the right leg, clockwise for the left one.
                p.ball[ball_joint(R_THIGH)] = Quat::exp(Vec3::Z * (u * ends));
                p.ball[ball_joint(L_THIGH)] = Quat::exp(Vec3::Z * (left.unwrap_or(upper) - upper));
                p
            })
            .collect();
        let mut yaw = vec![0.0; n];
        let stance = [Stance { start: 0, end: n }];
        let stances: [&[Stance]; 2] = [&[], &stance];
        let planted = vec![[left.is_some(), true]; n];
        add(&body, &postures, &planted, stances, &mut yaw, 60.0);
        yaw
    }

    #[test]
    fn a_pelvis_gives_a_hip_what_it_lacks() {
        let body = Body::adult_man();
        let upper = body.upper[DOF_START[R_THIGH.index()] + 2];
        assert!(turned(upper - 0.01, None).iter().all(|y| *y == 0.0));
        let yaw = turned(upper + 0.1, None);
        assert!(
            (yaw[0] + 0.13).abs() < 1e-9 && (yaw[59] - 0.13).abs() < 1e-9,
            "{yaw:?}"
        );
        assert!(yaw[30].abs() < 0.01, "{yaw:?}");
        // A left hip with only 0.05 rad left inwards is not turned further that way.
        let yaw = turned(upper + 0.1, Some(0.05));
        assert!(
            (yaw[0] + 0.13).abs() < 1e-9 && (yaw[59] - 0.02).abs() < 1e-9,
            "{yaw:?}"
        );
    }

    #[test]
    fn the_chest_stays_where_the_spine_lets_it() {
        let body = Body::adult_man();
        let chest =
            |p: &Posture| p.root_rotation * p.ball[ball_joint(ABDOMEN)] * p.ball[ball_joint(CHEST)];
        let before = Posture::default();
        let mut after = before;
        turn(&body, &mut after, 0.2);
        assert!((after.root_rotation.heading() - 0.2).abs() < 1e-12);
        assert!((chest(&after) * chest(&before).conjugate()).log().norm() < 1e-12);
    }
}
