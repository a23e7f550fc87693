//! What of a file moves: the bones that matter as local motions, without held poses and glitches.

use super::report::{Bridged, RetargetError};
use crate::sim::math::{Quat, Vec3};
use crate::sim::motion::bvh::Bvh;
use crate::sim::motion::filter::{align_signs, renormalised};
use crate::sim::motion::skeleton_map::{SideMap, SkeletonMap};

/// A first frame from which bones jump further than this is a pose, not motion, rad.
const POSE_JUMP: f64 = 0.6;
/// A bone that turns further than this in one frame and back within [`GLITCH_FRAMES`] is bridged, rad.
const GLITCH_STEP: f64 = 0.45;
/// The same as a speed, rad/s: at low frame rates honest motion turns far in one frame.
const GLITCH_RATE: f64 = 45.0;
/// Longest glitch that is bridged, frames.
const GLITCH_FRAMES: usize = 4;

fn angle_of(q: Quat) -> f64 {
    q.log().norm()
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
    pub(super) fn read(bvh: &Bvh, map: &SkeletonMap) -> Result<Self, RetargetError> {
        let n = bvh.joints.len();
        let mut keep = vec![false; n];
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
                at = bvh.joints[i].parent;
            }
        }
        let mut joints: Vec<usize> = (0..n).filter(|i| keep[*i]).collect();
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
        self.turn.first().map_or(0, Vec::len)
    }

    pub(super) fn at(&self, joint: usize) -> usize {
        self.index[joint].expect("every mapped bone is kept")
    }

    /// Largest turns of a single bone from one frame to the next: (second largest angle, rad; root distance).
    fn jump(&self, frame: usize) -> f64 {
        let mut angles: Vec<f64> = self
            .turn
            .iter()
            .map(|t| angle_of(t[frame].conjugate() * t[frame + 1]))
            .collect();
        angles.sort_by(f64::total_cmp);
        // Several bones must jump at once; one alone is a glitch.
        angles.iter().rev().nth(3).copied().unwrap_or(0.0)
    }

    /// Drops a pose (usually a T) held before the motion starts. Returns the number of frames dropped.
    pub(super) fn skip_pose(&mut self, rate_hz: f64, warnings: &mut Vec<String>) -> usize {
        let n = self.len();
        // The pose may be held for a while; it is over at the first jump, if nothing moved before.
        let mut held = 0;
        let mut cut = 0;
        while held + 1 < n && held < (30.0 * rate_hz) as usize {
            let j = self.jump(held);
            if j > POSE_JUMP.max(12.0 / rate_hz) {
                cut = held + 1;
                break;
            }
            if j > 0.02 {
                break;
            }
            held += 1;
        }
        if cut > 0 && n - cut >= 2 {
            for t in &mut self.turn {
                t.drain(..cut);
            }
            for s in &mut self.step {
                s.drain(..cut);
            }
            warnings.push(format!(
                "the first {cut} frame(s) hold a pose and jump into the motion: left out"
            ));
            return cut;
        }
        0
    }

    /// Replaces short excursions of single bones by interpolation.
    pub(super) fn bridge(&mut self, bvh: &Bvh, rate_hz: f64, skipped: usize) -> Vec<Bridged> {
        let limit = GLITCH_STEP.max(GLITCH_RATE / rate_hz);
        let n = self.len();
        let mut out = Vec::new();
        for k in 0..self.joints.len() {
            let turn = &mut self.turn[k];
            let mut i = 1;
            while i + 1 < n {
                let step = angle_of(turn[i - 1].conjugate() * turn[i]);
                if step > limit {
                    // The bone must come back: after the glitch it is about where it was before.
                    let back = (i + 1..(i + 1 + GLITCH_FRAMES).min(n))
                        .find(|j| angle_of(turn[i - 1].conjugate() * turn[*j]) < 0.4 * step);
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

    /// World positions and rotations, `[bone][frame]`, file units and axes.
    pub(super) fn forward(&self) -> (Vec<Vec<Vec3>>, Vec<Vec<Quat>>) {
        let (mut places, mut turns) = (self.step.clone(), self.turn.clone());
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
