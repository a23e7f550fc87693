//! The whole posture of a sample: feet in their stances or swings, a pelvis that both legs reach, and a shifted trunk.

use super::foot::{self, KnownUpTo, StreamFoot};
use super::{H, Sample, StreamPlan};
use crate::body::Posture;
use crate::body::angles::clamp_to_limits;
use crate::body::topology::FEET;
use crate::math::Vec3;
use crate::motion::leg_ik::{knee_axis, solve_leg_in_plane};
use crate::plan::leg_reach::{leg_geometry, room_above};
use crate::plan::params::{balance, leg};
use serde::{Deserialize, Serialize};

/// Lowering of the pelvis: as low as was needed in the last seconds, so that it does not add to the ups and downs of
/// the gait.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct PelvisLowering {
    /// The lowering needed, m, forgotten slowly.
    needed: f64,
    at: f64,
    speed: f64,
}

impl PelvisLowering {
    /// Takes the next need; the first one applies at once.
    fn take(&mut self, need: f64, first: bool) {
        if first {
            (self.needed, self.at) = (need, need);
        }
        self.needed = need.min(self.needed + leg::STREAM_RISE_SPEED * H).min(0.0);
        let pull = leg::STREAM_DROP_RATE * leg::STREAM_DROP_RATE * (self.needed - self.at)
            - 2.0 * leg::STREAM_DROP_RATE * self.speed;
        self.speed += pull * H;
        self.at += self.speed * H;
    }
}

impl StreamPlan {
    /// Poses the feet of sample `f` and computes the lowering of the pelvis that they need.
    pub(super) fn pose_feet(&mut self, f: i64, seen: i64, labelled: i64) {
        for side in 0..2 {
            let mut foot = std::mem::replace(&mut self.feet[side], StreamFoot::new());
            let sole = &self.soles[side];
            let raw = |i: i64| self.at(i).poses[FEET[side].index()];
            let standing = |i: i64| self.standing(side, i);
            let lacks = |ankle: Vec3| self.lacks(f, side, ankle);
            let posed = foot.pose(sole, f, KnownUpTo { labelled, seen }, raw, standing, lacks);
            self.feet[side] = foot;
            let s = self.at_mut(f);
            s.feet[side] = posed.pose;
            s.down[side] = posed.down;
            s.lift[side] = posed.lift;
        }
        let mut drop = self.needs(f, |s, side| (s.feet[side].ankle, s.down[side]));
        // The pelvis comes down in time for stances that are already known.
        for i in f + 1..=labelled.min(f + leg::STREAM_AHEAD) {
            let ankle = |s: &Sample, side: usize| {
                let sole = &self.soles[side];
                match self.feet[side].anchor(i, |i| self.standing(side, i)) {
                    Some(at) => {
                        let pitch = foot::risen(sole, &at, &|a| self.lacks(i, side, a));
                        (sole.stand(at.place, at.yaw, pitch).ankle, true)
                    }
                    None => (s.feet[side].ankle, false),
                }
            };
            drop = drop.min(self.needs(i, ankle));
        }
        self.lowering.take(drop, f == 0);
        self.at_mut(f).drop = self.lowering.at;
    }

    /// Hip of a side in sample `i` without the lowering of the pelvis, m, and how far its ankle may be from it, m.
    fn hip(&self, i: i64, side: usize) -> (Vec3, f64) {
        let s = self.at(i);
        let (hip, length) = leg_geometry(&self.body, side);
        let shift = Vec3::on_floor(self.planned(i).map(|d| balance::PELVIS_LEAD * d));
        let offset = s.smooth.root_rotation.rotate(hip);
        (s.smooth.root_position + offset + shift, leg::REACH * length)
    }

    /// How far an ankle is out of the leg's reach in sample `i` with the pelvis as low as it is now, m.
    fn lacks(&self, i: i64, side: usize, ankle: Vec3) -> f64 {
        let (hip, most) = self.hip(i, side);
        let far = hip + Vec3::Z * self.lowering.at - ankle;
        // The body rises on the toes of a foot left behind; over a foot below it the pelvis comes down.
        let ahead = self.at(i).smooth.root_rotation.rotate(Vec3::X);
        let behind = (far.x * ahead.x + far.y * ahead.y) / leg::STREAM_TRAILING;
        far.norm() - most - leg::STREAM_SPARED * (1.0 - behind.clamp(0.0, 1.0))
    }

    /// How far the pelvis of sample `i` has to come down so that both legs reach their ankles, m (≤ 0).
    ///
    /// * `ankle`: of a side, and whether that foot is planted.
    fn needs(&self, i: i64, ankle: impl Fn(&Sample, usize) -> (Vec3, bool)) -> f64 {
        let s = self.at(i);
        let of = |side: usize| {
            let (ankle, down) = ankle(s, side);
            let (hip, most) = self.hip(i, side);
            let room = room_above(hip - ankle, most, down);
            if room > 0.0 { 0.0 } else { room }
        };
        of(0).min(of(1))
    }

    /// The shift of the centre of mass planned for sample `i` with the present knowledge, m.
    pub(super) fn planned(&self, i: i64) -> [f64; 2] {
        let planned = self.balance.horizon.planned(i);
        planned.map(|x| x.clamp(-balance::STREAM_MOST_SHIFT, balance::STREAM_MOST_SHIFT))
    }

    /// Advances the shift of the trunk to sample `out`.
    pub(super) fn shift_on(&mut self, out: i64) {
        let next = self
            .balance
            .horizon
            .next((out > 0).then_some(self.balance.shift));
        let next = next.map(|x| x.clamp(-balance::STREAM_MOST_SHIFT, balance::STREAM_MOST_SHIFT));
        self.balance.shift = if out > 0 {
            [self.balance.shift[1], next]
        } else {
            [next; 2]
        };
    }

    /// The whole posture of sample `i` with a shift of the centre of mass, m.
    pub(super) fn posture(&self, i: i64, shift: [f64; 2]) -> Posture {
        let s = self.at(i);
        let [x, y] = shift.map(|d| d * balance::PELVIS_LEAD);
        let mut posture = s.smooth;
        posture.root_position += Vec3 { x, y, z: s.drop };
        for side in 0..2 {
            let left = side == 0;
            let lift = (-2..=2i64)
                .map(|d| {
                    [3.0, 2.0, 1.0][d.unsigned_abs() as usize] / 9.0 * self.at(i + d).lift[side]
                })
                .sum::<f64>();
            let mut pose = s.feet[side];
            if !s.down[side] {
                pose.ankle.z += lift;
            }
            let axis = knee_axis(&s.smooth, left);
            let foot = (pose.ankle, pose.rotation);
            solve_leg_in_plane(&self.body, &mut posture, left, foot, pose.toe, axis);
        }
        clamp_to_limits(&self.body, &mut posture, leg::LIMIT_MARGIN * 0.5);
        posture
    }
}
