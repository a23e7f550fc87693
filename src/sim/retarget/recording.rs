//! What of a file moves: the bones that matter as local motions, without held poses and glitches.

use super::report::{Bridged, RetargetError};
use crate::math::{Quat, Vec3};
use crate::motion::bvh::{Bvh, BvhJoint};
use crate::motion::filter::{align_signs, percentile, renormalised};
use crate::motion::skeleton_map::{SideMap, SkeletonMap};
use crate::retarget::MAX_POINTS;
use crate::retarget::params::recording;

fn angle_of(q: Quat) -> f64 {
    q.log().norm()
}

/// By how much a pose differs from another one.
struct Change {
    /// Root of the sum of squares of all turns, rad, and of the root's way in units of the figure's size.
    all: f64,
    /// Fourth largest turn of a bone, rad.
    bones: f64,
    /// Turn of the root, rad, or its way in units of the figure's size.
    root: f64,
}

/// The bones that matter, with every ancestor, as local motions.
///
/// A bone's end without a joint of its own (finger tip, toe tip, an ankle's end site) is kept as a *tip*: point number
/// `joint count + joint`, which turns with its joint.
pub(super) struct Recording {
    /// Point of each kept bone or tip, parents first.
    pub joints: Vec<usize>,
    /// Index into `joints`, by point.
    pub index: Vec<Option<usize>>,
    /// Joints in the file.
    pub joint_count: usize,
    pub parent: Vec<Option<usize>>,
    /// `[bone][frame]`: rotation and translation relative to the parent bone.
    pub turn: Vec<Vec<Quat>>,
    pub step: Vec<Vec<Vec3>>,
}

impl Recording {
    /// Whether each joint matters: those that are mapped do, and all above them.
    pub(super) fn kept(joints: &[BvhJoint], map: &SkeletonMap) -> Vec<bool> {
        let mut keep = vec![false; joints.len()];
        let ends = |s: &SideMap| [Some(s.foot), s.toes, s.hand, Some(s.forearm), Some(s.shank)];
        let wanted = map
            .sides
            .iter()
            .flat_map(ends)
            .flatten()
            .chain(map.head)
            .chain(map.trunk.iter().copied());
        for j in wanted {
            let mut at = Some(j);
            while let Some(i) = at {
                if std::mem::replace(&mut keep[i], true) {
                    break;
                }
                at = joints[i].parent;
            }
        }
        keep
    }

    pub(super) fn read(bvh: &Bvh, map: &SkeletonMap) -> Result<Self, RetargetError> {
        let n = bvh.joints.len();
        let keep = Self::kept(&bvh.joints, map);
        let mut joints: Vec<usize> = (0..n).filter(|i| keep[*i]).collect();
        if bvh.frame_count * joints.len() > MAX_POINTS {
            return Err(RetargetError::TooMuch {
                frames: bvh.frame_count,
                joints: joints.len(),
            });
        }
        let mut index = vec![None; 2 * n];
        for (k, j) in joints.iter().enumerate() {
            index[*j] = Some(k);
        }
        let mut parent: Vec<Option<usize>> = joints
            .iter()
            .map(|j| bvh.joints[*j].parent.and_then(|p| index[p]))
            .collect();
        let bones = joints.len();
        // Tips: where a bone ends that has no mapped joint below it.
        let mut tips: Vec<Vec3> = Vec::new();
        for s in &map.sides {
            let tip_of = [
                s.toes.or(Some(s.foot)),
                if s.hand.is_none() {
                    Some(s.forearm)
                } else {
                    None
                },
            ];
            for j in tip_of.into_iter().flatten() {
                let child = (j + 1..n)
                    .find(|c| bvh.joints[*c].parent == Some(j))
                    .map(|c| bvh.joints[c].offset);
                let Some(end) = bvh.joints[j].end_site.or(child).map(Vec3::from_array) else {
                    continue;
                };
                if end.is_finite() && end.norm() > 1e-9 {
                    index[n + j] = Some(joints.len());
                    parent.push(index[j]);
                    joints.push(n + j);
                    tips.push(end);
                }
            }
        }
        let mut turn = vec![Vec::with_capacity(bvh.frame_count); joints.len()];
        let mut step = vec![Vec::with_capacity(bvh.frame_count); joints.len()];
        let mut world = Vec::new();
        for frame in 0..bvh.frame_count {
            bvh.world_into(frame, &mut world);
            for (k, &j) in joints[..bones].iter().enumerate() {
                let (p, q) = (world[j].position, world[j].rotation);
                if !(p.is_finite() && q.is_finite() && p.norm() < 1e9) {
                    return Err(RetargetError::NotFinite {
                        frame,
                        bone: bvh.joints[j].name.clone(),
                    });
                }
                let (local, offset) = match parent[k] {
                    None => (q, p),
                    Some(up) => {
                        let w = &world[joints[up]];
                        let back = w.rotation.conjugate();
                        (back * q, back.rotate(p - w.position))
                    }
                };
                turn[k].push(renormalised(local));
                step[k].push(offset);
            }
            for (k, tip) in tips.iter().enumerate() {
                turn[bones + k].push(Quat::identity());
                step[bones + k].push(*tip);
            }
        }
        for t in &mut turn {
            align_signs(t);
        }
        Ok(Self {
            joints,
            index,
            joint_count: n,
            parent,
            turn,
            step,
        })
    }

    /// True if the pelvis, or a joint above it, has a position channel.
    pub(super) fn has_positions(bvh: &Bvh, map: &SkeletonMap) -> bool {
        let mut at = Some(map.pelvis);
        while let Some(j) = at {
            if bvh.joints[j].channels.iter().any(|c| c.is_position()) {
                return true;
            }
            at = bvh.joints[j].parent;
        }
        false
    }

    /// Point of the end of `joint`, if it is kept as a tip.
    pub(super) fn tip(&self, joint: usize) -> Option<usize> {
        let point = self.joint_count + joint;
        self.index[point].map(|_| point)
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
        self.step.first().map_or(0, Vec::len)
    }

    pub(super) fn at(&self, joint: usize) -> usize {
        self.index[joint].expect("every mapped bone is kept")
    }

    /// How far all bones turn, and the root moves, from frame `a` to frame `b`.
    fn change(&self, a: usize, b: usize, size: f64) -> Change {
        let mut angles: Vec<f64> = self
            .turn
            .iter()
            .map(|t| angle_of(t[a].conjugate() * t[b]))
            .collect();
        let moved = (self.step[0][b] - self.step[0][a]).norm() / size;
        let square = angles.iter().map(|a| a * a).sum::<f64>() + moved * moved;
        angles.sort_by(f64::total_cmp);
        Change {
            all: square.sqrt(),
            bones: angles.iter().rev().nth(3).copied().unwrap_or(0.0),
            root: moved.max(angle_of(self.turn[0][a].conjugate() * self.turn[0][b])),
        }
    }

    /// Longest way down the tree from the root, file units: what the root's way is measured against.
    fn size(&self) -> f64 {
        let mut reach = vec![0.0f64; self.joints.len()];
        for k in 0..self.joints.len() {
            if let Some(p) = self.parent[k] {
                reach[k] = reach[p] + self.step[k][0].norm();
            }
        }
        reach.into_iter().fold(0.0, f64::max).max(1e-9)
    }

    /// True if every bone below the root is turned as in the rest pose of the file.
    fn rests(&self, frame: usize) -> bool {
        let below = self
            .turn
            .iter()
            .zip(&self.parent)
            .filter(|(_, p)| p.is_some());
        below
            .into_iter()
            .all(|(t, _)| angle_of(t[frame]) < recording::REST_ANGLE)
    }

    /// Drops a pose that is no part of the motion from the start: one that does not change, or hardly, before it jumps
    /// into the motion. Returns the number of frames dropped.
    ///
    /// A jump is a change between two frames that is several times as large as any in the time after it, and as nearly
    /// all of the clip's: motion gathers speed over several frames. Where the pose is held for more than a frame, one
    /// bone that flips is no jump: four bones must, or the root, or the pose must be the rest pose of the file.
    pub(super) fn skip_pose(&mut self, rate_hz: f64, warnings: &mut Vec<String>) -> usize {
        let size = self.size();
        let mut skipped = 0;
        for _ in 0..recording::MOST_POSES {
            let Some(cut) = self.held_pose(rate_hz, size) else {
                break;
            };
            for t in &mut self.turn {
                t.drain(..cut);
            }
            for s in &mut self.step {
                s.drain(..cut);
            }
            skipped += cut;
        }
        if skipped > 0 {
            warnings.push(format!(
                "the first {skipped} frame(s) hold a pose and jump into the motion: left out"
            ));
        }
        skipped
    }

    /// First frame after a jump to frame `cut`, and the largest change on the way there. Some writers blend the rest
    /// pose into the motion over several frames: a rush that is fast from its first frame, which no motion is.
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

    /// Frames of a pose held at the start that is no part of the motion.
    fn held_pose(&self, rate_hz: f64, size: f64) -> Option<usize> {
        let n = self.len();
        let longest = ((recording::LONGEST_POSE * rate_hz) as usize)
            .min(n.saturating_sub(recording::AFTER_JUMP_FRAMES));
        let after = ((recording::AFTER_JUMP * rate_hz) as usize).max(recording::AFTER_JUMP_FRAMES);
        for cut in 1..=longest {
            let jump = self.change(cut - 1, cut, size);
            if jump.all < recording::LEAST_JUMP {
                // Still the same pose?
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
    pub(super) fn bridge(&mut self, bvh: &Bvh, rate_hz: f64, skipped: usize) -> Vec<Bridged> {
        let limit = recording::GLITCH_ANGLE.max(recording::GLITCH_RATE / rate_hz);
        let n = self.len();
        let mut out = self.bridge_root(bvh, rate_hz, skipped);
        for k in 0..self.joints.len() {
            let turn = &mut self.turn[k];
            let mut i = 1;
            while i + 1 < n {
                let step = angle_of(turn[i - 1].conjugate() * turn[i]);
                if step > limit {
                    // The bone must come back: after the glitch it is about where it was before.
                    let back = (i + 1..(i + 1 + recording::GLITCH_FRAMES).min(n)).find(|j| {
                        angle_of(turn[i - 1].conjugate() * turn[*j]) < recording::GLITCH_BACK * step
                    });
                    if let Some(j) = back {
                        let (a, b) = (turn[i - 1], turn[j]);
                        for m in i..j {
                            turn[m] = a.slerp(b, (m + 1 - i) as f64 / (j + 1 - i) as f64);
                        }
                        out.push(Bridged {
                            bone: bvh.joints[self.joints[k]].name.clone(),
                            first: i + skipped,
                            count: j - i,
                        });
                        i = j;
                    }
                }
                i += 1;
            }
            align_signs(turn);
        }
        out
    }

    /// Replaces short excursions of the root's place, such as frames in which all channels are 0.
    fn bridge_root(&mut self, bvh: &Bvh, rate_hz: f64, skipped: usize) -> Vec<Bridged> {
        let limit = self.size() * recording::ROOT_STEP.max(recording::ROOT_RATE / rate_hz);
        let (n, place) = (self.len(), &mut self.step[0]);
        let mut out = Vec::new();
        let mut i = 1;
        while i + 1 < n {
            let before = place[i - 1];
            let step = (place[i] - before).norm();
            let back = (i + 1..(i + 1 + recording::GLITCH_FRAMES).min(n))
                .find(|j| (place[*j] - before).norm() < recording::GLITCH_BACK * step);
            if let Some(j) = back.filter(|_| step > limit) {
                let way = place[j] - before;
                for (m, p) in place.iter_mut().enumerate().take(j).skip(i) {
                    *p = before + way * ((m + 1 - i) as f64 / (j + 1 - i) as f64);
                }
                out.push(Bridged {
                    bone: bvh.joints[self.joints[0]].name.clone(),
                    first: i + skipped,
                    count: j - i,
                });
                i = j;
            }
            i += 1;
        }
        out
    }

    /// World positions and rotations, `[bone][frame]`, file units and axes. The local rotations are used up.
    pub(super) fn forward(&mut self) -> (Vec<Vec<Vec3>>, Vec<Vec<Quat>>) {
        let (mut places, mut turns) = (self.step.clone(), std::mem::take(&mut self.turn));
        for k in 0..self.joints.len() {
            if let Some(p) = self.parent[k] {
                for i in 0..self.len() {
                    let (at, q) = (places[p][i], turns[p][i]);
                    places[k][i] = at + q.rotate(places[k][i]);
                    turns[k][i] = (q * turns[k][i]).normalized();
                }
            }
        }
        (places, turns)
    }

    /// Forgets what was read of the frames; which bones are kept stays.
    pub(super) fn forget_frames(&mut self) {
        self.turn = Vec::new();
        self.step = Vec::new();
    }

    /// Whether each kept bone or tip is asked for once all are smooth; the others only lead to them.
    pub(super) fn is_mapped(&self, map: &SkeletonMap) -> Vec<bool> {
        let of = |s: &SideMap| {
            let limbs = [s.upper_arm, s.forearm, s.thigh, s.shank, s.foot];
            limbs.into_iter().chain(s.hand).chain(s.toes)
        };
        let mut joints: Vec<usize> = map.sides.iter().flat_map(of).collect();
        joints.extend(map.head.into_iter().chain([map.pelvis]));
        joints.extend(&map.trunk);
        let mapped = |point: &usize| *point >= self.joint_count || joints.contains(point);
        self.joints.iter().map(mapped).collect()
    }

    /// Positions of the kept bones in the file's zero pose.
    pub(super) fn rest(&self, bvh: &Bvh) -> Vec<Vec3> {
        let mut out: Vec<Vec3> = Vec::with_capacity(self.joints.len());
        for (k, j) in self.joints.iter().enumerate() {
            // A tip's step is the same in every frame.
            let offset = bvh
                .joints
                .get(*j)
                .map_or(self.step[k][0], |b| Vec3::from_array(b.offset));
            out.push(self.parent[k].map_or(Vec3::zero(), |p| out[p]) + offset);
        }
        out
    }
}
