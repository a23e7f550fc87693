//! One foot of a stream: its stances, their places, and the swings between them.

use super::{H, RATE, is_sample};
use crate::math::curve::{fall, quintic, smoothstep_to};
use crate::math::{Quat, Vec3, trig};
use crate::plan::foot_lock::{FootOffset, FootPlacement, FootPose, Sole, swing_toe};
use crate::plan::least_without;
use crate::plan::params::{contact, pitch, stance, swing};
use serde::{Deserialize, Serialize};

/// Samples for which labels are kept.
const KEPT: usize = 192;
/// Stances that are kept.
pub(super) const STANCES: usize = 8;
/// One stance of one foot. Times in samples of the grid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stance {
    /// First sample.
    pub start: i64,
    /// One past the last sample; `i64::MAX` while it lasts.
    pub end: i64,
    /// Point of the floor under the flat ankle, m.
    pub place: Vec3,
    /// Heading, rad.
    pub yaw: f64,
    /// Whether place and heading are final.
    settled: bool,
    /// Whether it has been flat, after which it does not rise on its heel again.
    rolled: bool,
}

/// A foot treated as if it were planted.
#[derive(Clone, Copy, Debug)]
pub struct StandingSample {
    /// Point of the floor under the flat ankle, m.
    pub place: Vec3,
    /// Heading, rad.
    pub yaw: f64,
    /// Pitch, rad, toe-up positive.
    pub pitch: f64,
    /// How steep or rolled it is; beyond 1 it is not on its sole.
    pub steep: f64,
    /// Speed of the place, m/s.
    pub speed: f64,
}

/// A foot posed as it should be.
#[derive(Clone, Copy, Debug)]
pub struct PosedFoot {
    /// Pose, without clearance.
    pub pose: FootPose,
    /// Whether it is planted.
    pub down: bool,
    /// Height that it lacks to clear the floor, m.
    pub lift: f64,
}

/// Labels, stances and the swing of one foot.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct StreamFoot {
    #[serde(with = "crate::saved::array")]
    on: [bool; KEPT],
    #[serde(with = "crate::saved::array")]
    down: [bool; KEPT],
    level: [f64; 3],
    touches: [bool; 3],
    stances: [Stance; STANCES],
    count: usize,
    /// The next landing, as far as it is known.
    coming: Option<Stance>,
    /// Sample until which a foot that has moved on the floor is taken off it, and number of samples for which it has
    /// strayed.
    moving: i64,
    strayed: i64,
    /// Number of samples for which it has been steep.
    steep: i64,
    /// Offset from the recording, and its first two derivatives.
    offset: [FootOffset; 3],
    posed: i64,
}

/// How steep or rolled a foot is; beyond 1 it is not on its sole.
pub fn steepness(rotation: Quat, pitch: f64) -> f64 {
    let roll = rotation.rotate(Vec3::Y).z.abs() / trig::sin_cos(contact::MOST_TILT).0;
    roll.max(pitch / contact::LEAST_PITCH)
        .max(pitch / contact::MOST_TILT)
}

/// Pitch of a planted foot: flat within a band, with a smooth beginning, and toe-up for a moment only. `age`: samples
/// since it was planted.
fn stance_pitch(raw: f64, age: i64, rolled: bool) -> f64 {
    let stood = age as f64 * H;
    let u = ((stood - pitch::STREAM_LONG_STANCE)
        / (pitch::LONG_STANCE - pitch::STREAM_LONG_STANCE))
        .clamp(0.0, 1.0);
    let flat = pitch::DEAD_BAND + u * (pitch::LONG_DEAD_BAND - pitch::DEAD_BAND);
    let beyond = (raw.abs() - flat).max(0.0);
    let p = (beyond * beyond / (beyond + pitch::DEAD_BAND)).copysign(raw);
    let p = p.clamp(contact::LEAST_PITCH, contact::MOST_TILT);
    if p < 0.0 {
        p
    } else if rolled {
        0.0
    } else {
        p * fall(stood, (pitch::HEEL_BEGINS, pitch::HEEL_ENDS))
    }
}

/// Pitch of a planted foot that its leg reaches: it rises on its toes by as little as that takes.
///
/// * `lacks`: how far an ankle is out of reach, m.
pub fn risen(sole: &Sole, at: &FootPlacement, lacks: &impl Fn(Vec3) -> f64) -> f64 {
    let left = |rise: f64| lacks(sole.stand(at.place, at.yaw, at.pitch - rise).ankle);
    let most = pitch::MOST_RISE.min(at.pitch.min(0.0) - contact::LEAST_PITCH);
    if left(0.0) <= 0.0 || most <= 0.0 || left(most) >= left(0.0) {
        return at.pitch;
    }
    at.pitch - least_without(most, pitch::RISE_HALVINGS, |rise| left(rise) > 0.0)
}

/// How far a stream is known.
#[derive(Clone, Copy, Debug)]
pub struct KnownUpTo {
    /// Last sample whose contact is settled.
    pub labelled: i64,
    /// Last sample that was seen.
    pub seen: i64,
}

impl Stance {
    /// A stance from sample `start` on, with nothing else known.
    fn since(start: i64) -> Self {
        Self {
            start,
            end: i64::MAX,
            place: Vec3::zero(),
            yaw: 0.0,
            settled: false,
            rolled: false,
        }
    }

    /// Placement of the foot in sample `j` for a received pitch of `raw` (rad).
    fn at(&self, j: i64, raw: f64) -> FootPlacement {
        FootPlacement {
            tip: 0.0,
            place: self.place,
            yaw: self.yaw,
            pitch: stance_pitch(raw, j - self.start, self.rolled),
        }
    }
}

impl StreamFoot {
    /// Whether this value is one that a checkpoint could hold after `samples` samples, of which number `posed` was
    /// posed last.
    pub fn is_valid(&self, samples: i64, posed: i64) -> bool {
        let known = is_sample;
        let times = |s: &Stance| known(s.start) && (known(s.end) || s.end == i64::MAX);
        self.count <= STANCES
            && self.stances.iter().chain(&self.coming).all(times)
            && [self.strayed, self.steep]
                .iter()
                .all(|n| (0..=samples).contains(n))
            && self.posed == posed
            && (known(self.moving) || self.moving == i64::MIN)
    }

    /// A foot of which nothing is known.
    pub fn new() -> Self {
        let none = Stance {
            end: 0,
            ..Stance::since(0)
        };
        Self {
            on: [false; KEPT],
            down: [false; KEPT],
            level: [f64::INFINITY; 3],
            touches: [false; 3],
            stances: [none; STANCES],
            count: 0,
            coming: None,
            moving: i64::MIN,
            strayed: 0,
            steep: 0,
            offset: [[0.0; 7]; 3],
            posed: -1,
        }
    }

    /// Stances that are known, oldest first, with the one to come.
    pub fn stances(&self) -> impl Iterator<Item = &Stance> {
        self.stances[..self.count].iter().chain(&self.coming)
    }

    fn slot(i: i64) -> usize {
        i.rem_euclid(KEPT as i64) as usize
    }

    /// Whether it is planted in sample `i`.
    pub fn is_down(&self, i: i64) -> bool {
        self.down[Self::slot(i.max(0))]
    }

    /// Whether it touches the floor in sample `j`.
    pub fn touches(&self, j: i64) -> bool {
        self.on[Self::slot(j)]
    }

    /// Whether it touches the floor in sample `j` or soon enough after it that the time between is no flight.
    fn lands(&self, j: i64, last: i64) -> bool {
        (j..=(j + contact::STREAM_SHORTEST_FLIGHT).min(last)).any(|i| self.on[Self::slot(i)])
    }

    fn stance_at(&self, i: i64) -> Option<usize> {
        (0..self.count).find(|k| (self.stances[*k].start..self.stances[*k].end).contains(&i))
    }

    /// Notes whether it touches the floor in sample `i`: whether any of its `points` does, by height over its own level
    /// and by speed (`None`: unknown, as before).
    pub fn touch(
        &mut self,
        i: i64,
        points: [Vec3; 3],
        standing: [f64; 3],
        speed: impl Fn(usize) -> Option<f64>,
        hint: Option<bool>,
    ) {
        for k in 0..3 {
            let z = points[k].z;
            let level = (self.level[k] + contact::LEVEL_RISE * H).min(z);
            self.level[k] = level.clamp(
                standing[k] - contact::LEVEL_OFFSET,
                standing[k] + contact::LEVEL_OFFSET,
            );
            let (fast, high) = if self.touches[k] {
                (contact::SPEED_OFF, contact::HEIGHT_OFF)
            } else {
                (contact::SPEED_ON, contact::STREAM_HEIGHT_ON)
            };
            let low = z - self.level[k] < high;
            self.touches[k] = low && speed(k).map_or(self.touches[k], |v| v < fast);
        }
        self.on[Self::slot(i)] = hint.unwrap_or(self.touches != [false; 3]);
        if i == 1 {
            self.on[0] = self.on[1];
        }
    }

    /// Decides whether it is planted in sample `j`; `last` is the newest sample that [`Self::touch`] has seen. If a
    /// stance turns out to have ended earlier, returns the sample from which on the foot is not planted.
    pub fn label(
        &mut self,
        j: i64,
        last: i64,
        upright: bool,
        other: &Self,
        standing: impl Fn(i64) -> StandingSample,
    ) -> Option<i64> {
        let before = j > 0 && self.down[Self::slot(j - 1)];
        let on = |i: i64| self.on[Self::slot(i)];
        // A foot this steep does not come down; one that is leaving the floor may be this steep for a moment.
        let now = standing(j);
        let most = if before {
            1.0
        } else {
            contact::LANDING_STEEPNESS
        };
        self.steep = if now.steep > most { self.steep + 1 } else { 0 };
        let upright = upright && self.steep < if before { contact::LEAVING_TIME } else { 1 };
        let wanted = on(j) && upright;
        let steady = j == 0 || (j..=(j + contact::STREAM_STEADY).min(last)).all(|i| on(i) == on(j));
        let mut down = if wanted == before || steady {
            wanted
        } else {
            before && upright
        };
        // One foot is planted unless the body flies: the foot that lands counts as planted earlier.
        down |= upright && !other.touches(j) && self.lands(j, last);
        let given_up = if down {
            self.give_up(j, &now, other, &standing)
        } else {
            None
        };
        if j < self.moving {
            down = false;
        }
        self.down[Self::slot(j)] = down;
        match (before && given_up.is_none(), down) {
            (false, true) => {
                if self.count == STANCES {
                    self.stances.rotate_left(1);
                    self.count -= 1;
                }
                self.stances[self.count] = self.estimate(j, last, &standing);
                self.count += 1;
                self.coming = None;
                self.strayed = 0;
            }
            (true, false) => self.stances[self.count - 1].end = j,
            _ => {}
        }
        given_up
    }

    /// Takes a foot that has moved while it was planted off the floor, to set it down again; returns the sample from
    /// which on it is off. A foot gives way only while the other one is really planted, and where there is enough time
    /// the body gets some of it to come over that other foot.
    fn give_up(
        &mut self,
        j: i64,
        now: &StandingSample,
        other: &Self,
        standing: &impl Fn(i64) -> StandingSample,
    ) -> Option<i64> {
        let k = self.stance_at(j)?;
        let st = self.stances[k];
        // As long as its place may still change, a foot that turns slowly is where it is on average.
        let at = if st.settled {
            st
        } else {
            self.estimate(st.start, j, standing)
        };
        let strays = (now.place - at.place).norm() > stance::STRAY_DISTANCE
            || trig::wrapped(now.yaw - at.yaw).abs() > stance::STRAY_ANGLE;
        self.strayed = if strays { self.strayed + 1 } else { 0 };
        let carried = |i: i64| (1..=stance::STREAM_OVERLAP).all(|k| other.is_down(i - k));
        if self.strayed <= contact::STREAM_STEADY
            || !(other.touches(j) && carried(j) && j >= other.moving)
        {
            return None;
        }
        // A foot planted for less time than this is not taken off the floor again.
        let least = (stance::SHORTEST * RATE) as i64;
        let wanted = j - self.strayed - stance::STREAM_SHUFFLE / 2;
        let first = wanted
            .max(self.posed + stance::STREAM_NOTICE)
            .max(st.start + least)
            .min(j);
        let from = (first..j).rev().take_while(|i| carried(*i)).last();
        let from = from.unwrap_or(j);
        for i in from..j {
            self.down[Self::slot(i)] = false;
        }
        self.stances[k].end = from;
        self.moving = (from + stance::STREAM_SHUFFLE).max(j + 1);
        Some(from)
    }

    /// A stance from sample `start` on, placed by the samples known up to `last`: where the foot moves least.
    fn estimate(&self, start: i64, last: i64, standing: &impl Fn(i64) -> StandingSample) -> Stance {
        let first = standing(start);
        let (mut sum, mut place, mut yaw) = (0.0, Vec3::zero(), 0.0);
        for i in start..=last.min(start + stance::STREAM_AVERAGED).max(start) {
            if i > start && !self.on[Self::slot(i)] {
                break;
            }
            let s = standing(i);
            let w = stance::QUIET_SPEED * stance::QUIET_SPEED
                / (stance::QUIET_SPEED * stance::QUIET_SPEED + s.speed * s.speed);
            sum += w;
            place += (s.place - first.place) * w;
            yaw += trig::wrapped(s.yaw - first.yaw) * w;
        }
        Stance {
            place: first.place + place * (1.0 / sum),
            yaw: first.yaw + yaw / sum,
            ..Stance::since(start)
        }
    }

    /// Placement in sample `j`; `None` if it is not planted.
    pub fn anchor(
        &self,
        j: i64,
        standing: impl Fn(i64) -> StandingSample,
    ) -> Option<FootPlacement> {
        let st = &self.stances[self.stance_at(j)?];
        Some(st.at(j, standing(j).pitch))
    }

    /// First sample after `f` in which it is planted, with that stance: final up to the last label, provisional after
    /// that.
    fn landing(
        &self,
        f: i64,
        known: KnownUpTo,
        standing: &impl Fn(i64) -> StandingSample,
    ) -> Option<Stance> {
        let KnownUpTo { labelled, seen } = known;
        let known = self.stances[..self.count].iter().find(|s| s.start > f);
        if let Some(st) = known {
            return Some(*st);
        }
        let mut start = seen + 1;
        while start > labelled.max(f) + 1 && self.on[Self::slot(start - 1)] {
            start -= 1;
        }
        let comes = start <= seen
            && start >= self.moving
            && standing(start).steep < contact::LANDING_STEEPNESS;
        comes.then(|| self.estimate(start, seen, standing))
    }

    /// Poses it in sample `f`, the one after the last posed; `lacks` says how far an ankle is out of the leg's reach,
    /// m.
    pub fn pose(
        &mut self,
        sole: &Sole,
        f: i64,
        known: KnownUpTo,
        raw: impl Fn(i64) -> (Vec3, Quat),
        standing: impl Fn(i64) -> StandingSample,
        lacks: impl Fn(Vec3) -> f64,
    ) -> PosedFoot {
        let seen = known.seen;
        let now = standing(f);
        let recorded_pose = |i: i64, pitch: f64| {
            let (ankle, rotation) = raw(i);
            FootPose {
                ankle,
                rotation,
                toe: swing_toe(pitch),
            }
        };
        let recorded = recorded_pose(f, now.pitch);
        if let Some(k) = self.stance_at(f) {
            if !self.stances[k].settled {
                let (start, end) = (self.stances[k].start, self.stances[k].end);
                let better = self.estimate(start, seen.min(end - 1), &standing);
                let st = &mut self.stances[k];
                (st.place, st.yaw, st.settled) = (better.place, better.yaw, true);
            }
            let st = &mut self.stances[k];
            st.rolled |= now.pitch < pitch::DEAD_BAND;
            let at = st.at(f, now.pitch);
            let pose = sole.stand(at.place, at.yaw, risen(sole, &at, &lacks));
            let o = pose.offset_from(&recorded);
            let o0 = if self.posed >= 0 { self.offset[0] } else { o };
            let v: FootOffset = std::array::from_fn(|c| (o[c] - o0[c]) / H);
            // Differences of differences would lead the swing astray.
            self.offset = [o, v, [0.0; 7]];
            self.posed = f;
            self.coming = None;
            return PosedFoot {
                pose,
                down: true,
                lift: 0.0,
            };
        }
        self.coming = self.landing(f, known, &standing);
        let (goal, slope, left) = match &self.coming {
            Some(st) => {
                let at = |i: i64| {
                    let s = standing(i);
                    let pose = sole.stand(st.place, st.yaw, stance_pitch(s.pitch, 0, false));
                    pose.offset_from(&recorded_pose(i, s.pitch))
                };
                let (a, b) = (at(st.start), at((st.start + 1).min(seen)));
                let slope: FootOffset = std::array::from_fn(|c| (b[c] - a[c]) / H);
                (a, slope, (st.start - f + 1) as f64 * H)
            }
            None => ([0.0; 7], [0.0; 7], swing::STREAM_DEPARTURE),
        };
        let [o0, v0, a0] = self.offset;
        for c in 0..7 {
            let [p, v, a] = quintic(left, H, v0[c], a0[c], goal[c] - o0[c], slope[c], 0.0);
            self.offset[0][c] = o0[c] + p;
            self.offset[1][c] = v;
            self.offset[2][c] = a;
        }
        self.posed = f;
        let mut pose = recorded.moved(&self.offset[0]);
        pose.toe = pose.toe.max(0.0);
        PosedFoot {
            lift: self.lift(sole, f, &pose, now.place),
            pose,
            down: false,
        }
    }

    /// Height that a swinging sole lacks, m, compared with the clearance due for its time in the air and its distance.
    fn lift(&self, sole: &Sole, f: i64, pose: &FootPose, place: Vec3) -> f64 {
        let last = self.stances[..self.count].iter().rev().find(|s| s.end <= f);
        let since = last.map_or(1.0, |s| (f + 1 - s.end) as f64 * H);
        let until = self.coming.map_or(1.0, |s| (s.start - f) as f64 * H);
        let from = last.map_or(place, |s| s.place);
        let reach = (place - from)
            .norm()
            .max(self.coming.map_or(0.0, |s| (s.place - from).norm()));
        let most = (swing::CLEARANCE_SHARE * reach).clamp(swing::LEAST_CLEARANCE, swing::CLEARANCE);
        let need = most
            .min(swing::RISE_SPEED * since * since / (since + swing::LIFT_TIME))
            .min(swing::SINK_SPEED * until);
        let lacks = (need - (pose.ankle.z + sole.lowest(pose.rotation, pose.toe))).max(0.0);
        let w = (since.min(until) / swing::LIFT_TIME).min(1.0);
        smoothstep_to(lacks, w)
    }
}
