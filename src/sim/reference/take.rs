//! The motion in a recording: without held poses and glitches.

use super::error::RetargetError;
use super::report::Bridged;
use crate::math::{Quat, Vec3};
use crate::motion::filter::{align_signs, percentile};
use crate::motion::recording::{Recording, RecordingError};
use crate::motion::skeleton_map::{SideMap, SkeletonMap};
use crate::reference::params::recording;
use std::borrow::Cow;

fn angle_of(q: Quat) -> f64 {
    q.log().norm()
}

/// How much a pose differs from another one.
struct PoseChange {
    /// Root of the sum of squares of all turns, rad, and of the root's displacement in units of the figure's size.
    all: f64,
    /// Fourth largest turn of a bone, rad.
    bones: f64,
    /// Turn of the root, rad, or its displacement in units of the figure's size.
    root: f64,
}

/// A recording without glitches and without frames that are not part of the motion; changed parts are copied.
pub(super) struct Take<'a> {
    recording: &'a Recording,
    /// `[point][frame]`: rotation and translation relative to the parent.
    turn: Vec<Cow<'a, [Quat]>>,
    pub step: Vec<Cow<'a, [Vec3]>>,
    /// Frames that were left out at the start.
    pub skipped_frames: usize,
    pub bridged: Vec<Bridged>,
}

/// World positions and rotations, `[point][frame]`, file units and axes.
pub(super) struct WorldPaths {
    pub places: Vec<Vec<Vec3>>,
    pub turns: Vec<Vec<Quat>>,
}

impl<'a> Take<'a> {
    /// The whole recording, before anything is left out.
    fn whole(recording: &'a Recording) -> Self {
        let paths = &recording.paths;
        Self {
            recording,
            turn: { paths.iter() }
                .map(|p| Cow::Borrowed(&p.rotations[..]))
                .collect(),
            step: { paths.iter() }
                .map(|p| Cow::Borrowed(&p.translations[..]))
                .collect(),
            skipped_frames: 0,
            bridged: Vec::new(),
        }
    }

    /// The motion of a recording captured at `rate_hz`: poses held at its start are left out, glitches bridged.
    pub(super) fn of(
        recording: &'a Recording,
        rate_hz: f64,
        warnings: &mut Vec<String>,
    ) -> Result<Self, RetargetError> {
        let mut take = Self::whole(recording);
        take.skip_pose(rate_hz, warnings);
        if take.len() < 2 {
            return Err(RecordingError::TooShort(take.len()).into());
        }
        take.bridge(rate_hz);
        Ok(take)
    }

    /// Parent of a point among the points.
    pub(super) fn parent(&self, k: usize) -> Option<usize> {
        self.recording.paths[k].parent
    }

    /// Number of the point: a joint of the file, or its tip.
    pub(super) fn point(&self, k: usize) -> usize {
        self.recording.paths[k].point
    }

    fn points(&self) -> usize {
        self.recording.paths.len()
    }

    /// Name of a joint of the file.
    pub(super) fn joint_name(&self, joint: usize) -> String {
        self.recording.facts.joints[joint].name.clone()
    }

    fn bone_name(&self, k: usize) -> String {
        self.joint_name(self.point(k))
    }

    /// Point of the end of `joint`, if it is kept as a tip.
    pub(super) fn tip(&self, joint: usize) -> Option<usize> {
        self.recording.tip(joint)
    }

    /// Point at the wrist of a side, if the file has one.
    pub(super) fn wrist(&self, side: &SideMap) -> Option<usize> {
        side.hand.or_else(|| self.tip(side.forearm))
    }

    /// Point at the ball or the tip of a foot, if the file has one.
    pub(super) fn toe(&self, side: &SideMap) -> Option<usize> {
        side.toes.or_else(|| self.tip(side.foot))
    }

    pub(super) fn len(&self) -> usize {
        self.step.first().map_or(0, |s| s.len())
    }

    pub(super) fn at(&self, joint: usize) -> usize {
        self.recording
            .path_of(joint)
            .expect("every mapped bone is kept")
    }

    /// How far all bones turn, and the root moves, from frame `a` to frame `b`.
    fn change(&self, a: usize, b: usize, size: f64) -> PoseChange {
        let mut angles: Vec<f64> = self
            .turn
            .iter()
            .map(|t| angle_of(t[a].conjugate() * t[b]))
            .collect();
        let moved = (self.step[0][b] - self.step[0][a]).norm() / size;
        let square = angles.iter().map(|a| a * a).sum::<f64>() + moved * moved;
        angles.sort_by(f64::total_cmp);
        PoseChange {
            all: square.sqrt(),
            bones: angles.iter().rev().nth(3).copied().unwrap_or(0.0),
            root: moved.max(angle_of(self.turn[0][a].conjugate() * self.turn[0][b])),
        }
    }

    /// Longest path down the tree from the root, file units: the unit in which the root's displacement is measured.
    fn size(&self) -> f64 {
        let mut reach = vec![0.0f64; self.points()];
        for k in 0..self.points() {
            if let Some(p) = self.parent(k) {
                reach[k] = reach[p] + self.step[k][0].norm();
            }
        }
        reach.into_iter().fold(0.0, f64::max).max(1e-9)
    }

    /// Whether every bone below the root is turned as in the rest pose of the file.
    fn rests(&self, frame: usize) -> bool {
        let mut below = { self.turn.iter() }
            .zip(&self.recording.paths)
            .filter(|(_, p)| p.parent.is_some());
        below.all(|(t, _)| angle_of(t[frame]) < recording::REST_ANGLE)
    }

    /// Drops a pose from the start that is not part of the motion: one that does not change, or hardly, before it jumps
    /// into the motion.
    ///
    /// A jump is a change between two frames that is several times as large as any change in the time after it, and as
    /// nearly all others in the clip: motion gathers speed over several frames. Where the pose is held for more than a
    /// frame, one flipping bone is not a jump: four bones must flip, or the root, or the pose must be the rest pose of
    /// the file.
    fn skip_pose(&mut self, rate_hz: f64, warnings: &mut Vec<String>) {
        let size = self.size();
        let mut skipped = 0;
        for _ in 0..recording::MOST_POSES {
            let Some(cut) = self.held_pose(rate_hz, size) else {
                break;
            };
            skipped += cut;
            for (k, path) in self.recording.paths.iter().enumerate() {
                self.turn[k] = Cow::Borrowed(&path.rotations[skipped..]);
                self.step[k] = Cow::Borrowed(&path.translations[skipped..]);
            }
        }
        if skipped > 0 {
            warnings.push(format!(
                "the first {skipped} frame(s) hold a pose and jump into the motion: left out"
            ));
        }
        self.skipped_frames = skipped;
    }

    /// First frame after a jump to frame `cut`, and the largest change up to there. Some writers blend the rest pose
    /// into the motion over several frames: such a rush is fast from its first frame, which no motion is.
    fn rush(&self, cut: usize, jump: f64, rate_hz: f64, size: f64) -> (usize, f64) {
        if !self.rests(cut - 1) {
            return (cut, jump);
        }
        let last = (cut + (recording::LONGEST_BLEND * rate_hz) as usize)
            .min(self.len().saturating_sub(recording::AFTER_JUMP_FRAMES));
        let change = |i: usize| self.change(i, i + 1, size).all;
        let (mut end, mut largest) = (cut, jump);
        while end < last {
            let next = change(end);
            let fades = next > recording::BLEND_END_RATIO * change(end + 1);
            if next * recording::JUMP_RATIO < largest && !fades {
                break;
            }
            largest = largest.max(next);
            end += 1;
        }
        if jump < 0.5 * largest {
            return (cut, jump);
        }
        (end, largest)
    }

    /// Number of frames at the start that hold a pose which is not part of the motion.
    fn held_pose(&self, rate_hz: f64, size: f64) -> Option<usize> {
        let n = self.len();
        let longest = ((recording::LONGEST_POSE * rate_hz) as usize)
            .min(n.saturating_sub(recording::AFTER_JUMP_FRAMES));
        let after = ((recording::AFTER_JUMP * rate_hz) as usize).max(recording::AFTER_JUMP_FRAMES);
        for cut in 1..=longest {
            let jump = self.change(cut - 1, cut, size);
            if jump.all < recording::LEAST_JUMP {
                // The pose must still be the same.
                if self.change(0, cut, size).all > recording::MOST_DRIFT {
                    return None;
                }
                continue;
            }
            let (end, largest) = self.rush(cut, jump.all, rate_hz, size);
            let around = (end..(end + after).min(n - 1)).map(|i| self.change(i, i + 1, size).all);
            if largest < recording::JUMP_RATIO * around.fold(0.0, f64::max) {
                return None;
            }
            let stride = (n / 2000).max(1);
            let usual: Vec<f64> = (end..n - 1)
                .step_by(stride)
                .map(|i| self.change(i, i + 1, size).all)
                .collect();
            let several = jump.bones > recording::POSE_JUMP || jump.root > recording::POSE_JUMP;
            let pose = cut == 1 || several || self.rests(cut - 1);
            return (pose && largest > recording::USUAL_RATIO * percentile(&usual, 0.95))
                .then_some(end);
        }
        None
    }

    /// Replaces short excursions of single bones, and of the root's place, by interpolation.
    fn bridge(&mut self, rate_hz: f64) {
        let limit = recording::GLITCH_ANGLE.max(recording::GLITCH_RATE / rate_hz);
        let n = self.len();
        let mut out = self.bridge_root(rate_hz);
        for k in 0..self.points() {
            let before = out.len();
            let mut i = 1;
            while i + 1 < n {
                let turn = &self.turn[k];
                let step = angle_of(turn[i - 1].conjugate() * turn[i]);
                if step > limit {
                    // The bone must come back: after the glitch it must be about where it was before.
                    let back = (i + 1..(i + 1 + recording::GLITCH_FRAMES).min(n)).find(|j| {
                        angle_of(turn[i - 1].conjugate() * turn[*j]) < recording::GLITCH_BACK * step
                    });
                    if let Some(j) = back {
                        let (a, b) = (turn[i - 1], turn[j]);
                        let turn = self.turn[k].to_mut();
                        for m in i..j {
                            turn[m] = a.slerp(b, (m + 1 - i) as f64 / (j + 1 - i) as f64);
                        }
                        out.push(Bridged {
                            bone: self.bone_name(k),
                            first: i + self.skipped_frames,
                            count: j - i,
                        });
                        i = j;
                    }
                }
                i += 1;
            }
            if out.len() > before {
                align_signs(self.turn[k].to_mut());
            }
        }
        self.bridged = out;
    }

    /// Replaces short excursions of the root's place, such as frames in which all channels are 0.
    fn bridge_root(&mut self, rate_hz: f64) -> Vec<Bridged> {
        let limit = self.size() * recording::ROOT_STEP.max(recording::ROOT_RATE / rate_hz);
        let n = self.len();
        let mut out = Vec::new();
        let mut i = 1;
        while i + 1 < n {
            let place = &self.step[0];
            let before = place[i - 1];
            let step = (place[i] - before).norm();
            let back = (i + 1..(i + 1 + recording::GLITCH_FRAMES).min(n))
                .find(|j| (place[*j] - before).norm() < recording::GLITCH_BACK * step);
            if let Some(j) = back.filter(|_| step > limit) {
                let way = place[j] - before;
                let place = self.step[0].to_mut();
                for (m, p) in place.iter_mut().enumerate().take(j).skip(i) {
                    *p = before + way * ((m + 1 - i) as f64 / (j + 1 - i) as f64);
                }
                out.push(Bridged {
                    bone: self.bone_name(0),
                    first: i + self.skipped_frames,
                    count: j - i,
                });
                i = j;
            }
            i += 1;
        }
        out
    }

    /// World positions and rotations.
    pub(super) fn forward(&mut self) -> WorldPaths {
        let turns = std::mem::take(&mut self.turn);
        let mut turns: Vec<Vec<Quat>> = turns.into_iter().map(Cow::into_owned).collect();
        let mut places: Vec<Vec<Vec3>> = self.step.iter().map(|s| s.to_vec()).collect();
        for k in 0..self.points() {
            if let Some(p) = self.parent(k) {
                for i in 0..self.len() {
                    let (at, q) = (places[p][i], turns[p][i]);
                    places[k][i] = at + q.rotate(places[k][i]);
                    turns[k][i] = (q * turns[k][i]).normalized();
                }
            }
        }
        WorldPaths { places, turns }
    }

    /// Releases the copied frames; the list of points stays.
    pub(super) fn forget_frames(&mut self) {
        self.turn = Vec::new();
        self.step = Vec::new();
    }

    /// Whether each kept bone or tip is needed after smoothing; the others only lead to those.
    pub(super) fn is_mapped(&self, map: &SkeletonMap) -> Vec<bool> {
        let of = |s: &SideMap| {
            let limbs = [s.upper_arm, s.forearm, s.thigh, s.shank, s.foot];
            limbs.into_iter().chain(s.hand).chain(s.toes)
        };
        let mut joints: Vec<usize> = map.sides.iter().flat_map(of).collect();
        joints.extend(map.head.into_iter().chain([map.pelvis]));
        joints.extend(&map.trunk);
        let tips = self.recording.facts.joints.len();
        let mapped = |point: usize| point >= tips || joints.contains(&point);
        let paths = self.recording.paths.iter();
        paths.map(|p| mapped(p.point)).collect()
    }

    /// Positions of the points in the file's zero pose.
    pub(super) fn rest(&self) -> Vec<Vec3> {
        let mut out: Vec<Vec3> = Vec::with_capacity(self.points());
        for (k, path) in self.recording.paths.iter().enumerate() {
            // A tip's offset is the same in every frame.
            let joint = self.recording.facts.joints.get(path.point);
            let offset = joint.map_or(self.step[k][0], |j| j.offset);
            out.push(path.parent.map_or(Vec3::zero(), |p| out[p]) + offset);
        }
        out
    }
}
