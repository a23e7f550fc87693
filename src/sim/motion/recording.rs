//! The common form of every motion file format: the joints of a recorded skeleton and how those that matter move.
//!
//! A format gives its skeleton, its rate, its unit and axis where it states them, and the world pose of each joint in
//! each frame. [`Recording`] finds the bones of the body in the skeleton and keeps, as rotations and translations
//! relative to the parent, only the joints that lead to them: the memory is bounded by [`MAX_POINTS`], however many
//! joints the file has. Numbers stay in file units and file axes.
//!
//! [`read`](super::read::read) chooses the format of a file.

use super::filter::{align_signs, renormalised};
use super::skeleton::{JointPose, RecordedJoint};
use super::skeleton_map::{MapError, SideMap, SkeletonMap, map_skeleton};
use crate::math::{Quat, Vec3};

/// Largest number of frames of a recording: bounds time and memory (8 min at 120 Hz).
pub const MAX_FRAMES: usize = 60_000;
/// Largest number of frames times joints that matter, 60 joints in the longest file: bounds memory.
pub const MAX_POINTS: usize = 60 * MAX_FRAMES;
/// Bytes that a [`Recording`] takes for each point of a frame.
pub const POINT_BYTES: u64 = 56;
/// Shortest bone end that is kept, file units.
const SHORTEST_TIP: f64 = 1e-9;
/// Farthest place of a joint that is accepted, file units.
const FARTHEST: f64 = 1e9;

/// A file format of motion.
pub(super) struct MotionFormat {
    /// Everyday name of the format.
    pub name: &'static str,
    /// Whether a file that begins with these bytes is of this format.
    pub recognises: fn(&[u8]) -> bool,
    /// Reads the data needed to bound the memory of reading the rest.
    pub head: fn(&[u8]) -> Result<RecordingHead, RecordingError>,
    /// Reads the whole file.
    pub read: fn(&[u8]) -> Result<Recording, RecordingError>,
}

/// Axis of a file that points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
#[allow(missing_docs)]
pub enum UpAxis {
    Y,
    Z,
}

/// The head of a file, before its frames are read.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordingHead {
    /// Joints in file order.
    pub joints: Vec<RecordedJoint>,
    /// Number of frames as declared, at most as many as the bytes can hold.
    pub frame_count: u64,
    /// Frames per second as declared.
    pub rate_hz: f64,
    /// Bytes that the reader of the format holds while it reads the frames.
    pub reading_bytes: u64,
}

/// Facts that a file states besides its frames.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordingFacts {
    /// Joints in file order.
    pub joints: Vec<RecordedJoint>,
    /// Number of frames that are present.
    pub frame_count: usize,
    /// Frames per second as declared. Files lie about it.
    pub rate_hz: f64,
    /// Metres per unit, where the format states it.
    pub unit_m: Option<f64>,
    /// Axis that points up, where the format states it.
    pub up: Option<UpAxis>,
    /// Oddities of the file, for the user's report.
    pub warnings: Vec<String>,
}

/// Motion of one point of the skeleton relative to its parent, frame by frame.
#[derive(Clone, Debug, PartialEq)]
pub struct PointPath {
    /// Number of the point: a joint, or joint count + joint for the end of a joint's bone.
    pub point: usize,
    /// Index of the parent among the paths.
    pub parent: Option<usize>,
    /// Rotation relative to the parent, per frame; neighbours have the same sign.
    pub rotations: Vec<Quat>,
    /// Translation in the parent's frame, file units, per frame.
    pub translations: Vec<Vec3>,
}

/// A recorded motion, whatever file it came from.
///
/// The end of a bone without a joint of its own (finger tip, toe tip, an ankle's end site) is kept as a *tip*: point
/// number `joint count + joint`, which turns with its joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Skeleton, rate, unit and axis.
    pub facts: RecordingFacts,
    /// The bones of the body among the joints.
    pub map: SkeletonMap,
    /// Joints that matter and tips, parents first.
    pub paths: Vec<PointPath>,
    /// Index into `paths`, by point.
    index: Vec<Option<usize>>,
}

/// Why a file is no recording of a human figure.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RecordingError {
    /// The bytes are not of the format.
    #[error("{reason}")]
    Unreadable {
        /// Name of the format.
        format: &'static str,
        /// The part that cannot be read, with its place in the file.
        reason: String,
    },
    /// The skeleton has no human shape or names.
    #[error(transparent)]
    Map(#[from] MapError),
    /// No motion.
    #[error("{0} frames; a motion needs at least 2")]
    TooShort(usize),
    /// Too much to fit at once.
    #[error("{frames} frames; at most {MAX_FRAMES} are read: cut the clip")]
    TooLong {
        /// Frames in the file.
        frames: usize,
    },
    /// Too much to hold at once.
    #[error(
        "{frames} frames of {joints} joints that matter; at most {MAX_POINTS} places are held: cut the clip"
    )]
    TooMuch {
        /// Frames in the file.
        frames: usize,
        /// Joints that are mapped, with those above them.
        joints: usize,
    },
    /// A number is NaN, infinite or absurd.
    #[error("frame {frame}: bone {bone} is not at a finite place")]
    NotFinite {
        /// 0-based.
        frame: usize,
        /// Bone name.
        bone: String,
    },
}

impl RecordingHead {
    /// Joints that matter; 0 if the skeleton has no bones of a body.
    pub fn kept_joints(&self) -> usize {
        map_skeleton(&self.joints).map_or(0, |map| {
            let kept = kept(&self.joints, &map);
            kept.into_iter().filter(|k| *k).count()
        })
    }
}

/// Whether each joint matters: those that are mapped do, and all above them.
fn kept(joints: &[RecordedJoint], map: &SkeletonMap) -> Vec<bool> {
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

/// The points of a recording before its frames are read.
struct RecordedPointPaths {
    paths: Vec<PointPath>,
    index: Vec<Option<usize>>,
    /// Number of joints among them; the others are tips.
    bones: usize,
}

impl RecordedPointPaths {
    fn of(facts: &RecordingFacts, map: &SkeletonMap) -> Result<Self, RecordingError> {
        let (all, n) = (&facts.joints, facts.joints.len());
        let frames = facts.frame_count;
        let keep = kept(all, map);
        let joints: Vec<usize> = (0..n).filter(|i| keep[*i]).collect();
        if frames * joints.len() > MAX_POINTS {
            return Err(RecordingError::TooMuch {
                frames,
                joints: joints.len(),
            });
        }
        let mut index = vec![None; 2 * n];
        for (k, j) in joints.iter().enumerate() {
            index[*j] = Some(k);
        }
        let path = |point, parent| PointPath {
            point,
            parent,
            rotations: Vec::with_capacity(frames),
            translations: Vec::with_capacity(frames),
        };
        let mut paths: Vec<PointPath> = joints
            .iter()
            .map(|j| path(*j, all[*j].parent.and_then(|p| index[p])))
            .collect();
        let bones = paths.len();
        // Tips: the ends of bones with no mapped joint below.
        for s in &map.sides {
            let hand = s.hand.is_none().then_some(s.forearm);
            for j in [s.toes.or(Some(s.foot)), hand].into_iter().flatten() {
                let child = (j + 1..n).find(|c| all[*c].parent == Some(j));
                let Some(end) = all[j].end_site.or(child.map(|c| all[c].offset)) else {
                    continue;
                };
                if end.is_finite() && end.norm() > SHORTEST_TIP {
                    index[n + j] = Some(paths.len());
                    let mut tip = path(n + j, index[j]);
                    tip.rotations.resize(frames, Quat::identity());
                    tip.translations.resize(frames, end);
                    paths.push(tip);
                }
            }
        }
        Ok(Self {
            paths,
            index,
            bones,
        })
    }

    /// Adds one frame from the world poses of all joints.
    fn add(&mut self, world: &[JointPose]) -> Result<(), usize> {
        for k in 0..self.bones {
            let j = self.paths[k].point;
            let (p, q) = (world[j].position, world[j].rotation);
            if !(p.is_finite() && q.is_finite() && p.norm() < FARTHEST) {
                return Err(j);
            }
            let (local, offset) = match self.paths[k].parent {
                None => (q, p),
                Some(up) => {
                    let w = &world[self.paths[up].point];
                    let back = w.rotation.conjugate();
                    (back * q, back.rotate(p - w.position))
                }
            };
            self.paths[k].rotations.push(renormalised(local));
            self.paths[k].translations.push(offset);
        }
        Ok(())
    }
}

impl Recording {
    /// Makes a recording from the facts of a file and the world poses of its joints.
    ///
    /// * `world`: writes the poses of all joints in one frame, in file order, into the vector, which it clears first.
    ///
    /// O(frames × joints).
    ///
    /// # Errors
    /// A skeleton without the bones of a body, a motion that is too short or too long, a place that is not finite.
    pub(super) fn new(
        facts: RecordingFacts,
        world: impl Fn(usize, &mut Vec<JointPose>),
    ) -> Result<Self, RecordingError> {
        let frames = facts.frame_count;
        if frames < 2 {
            return Err(RecordingError::TooShort(frames));
        }
        if frames > MAX_FRAMES {
            return Err(RecordingError::TooLong { frames });
        }
        let map = map_skeleton(&facts.joints)?;
        let mut points = RecordedPointPaths::of(&facts, &map)?;
        let mut poses = Vec::new();
        for frame in 0..frames {
            world(frame, &mut poses);
            points.add(&poses).map_err(|j| RecordingError::NotFinite {
                frame,
                bone: facts.joints[j].name.clone(),
            })?;
        }
        for path in &mut points.paths {
            align_signs(&mut path.rotations);
        }
        Ok(Self {
            facts,
            map,
            paths: points.paths,
            index: points.index,
        })
    }

    /// Index of the path of a point that is kept.
    pub fn path_of(&self, point: usize) -> Option<usize> {
        self.index[point]
    }

    /// Point at the end of the bone of `joint`, if it is kept as a tip.
    pub fn tip(&self, joint: usize) -> Option<usize> {
        let point = self.facts.joints.len() + joint;
        self.index[point].map(|_| point)
    }

    /// Whether the file records the position of the pelvis, or of a joint above it.
    pub fn has_positions(&self) -> bool {
        let mut at = Some(self.map.pelvis);
        while let Some(j) = at {
            let joint = &self.facts.joints[j];
            if joint.has_position {
                return true;
            }
            at = joint.parent;
        }
        false
    }
}
