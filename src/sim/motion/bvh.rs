//! Reading BVH motion capture (Biovision hierarchy).
//!
//! One pass over the bytes, no recursion, memory and time linear in their number: counts that a file declares (joints,
//! frames, channels) are trusted only as far as the bytes bear them out. The hierarchy and the head of the motion part
//! are read word by word, so line breaks, indentation and brace placement do not matter there; each frame is one line.
//! LF, CRLF and lone CR end a line.
//!
//! Numbers stay in file units and file axes, angles in degrees. Retargeting finds out the unit in metres and the up
//! axis.

mod parse;

use super::recording::{MotionFormat, Recording, RecordingError, RecordingFacts, RecordingHead};
use super::skeleton::{JointPose, MAX_JOINTS, RecordedJoint};
use crate::math::{Quat, Vec3, vec3::vec3};
use parse::{BvhReader, Warnings, parse_frames, parse_hierarchy, parse_motion_head};

/// BVH as one of the supported formats.
pub(super) const FORMAT: MotionFormat = MotionFormat {
    name: "BVH",
    recognises: |bytes| {
        let word = bytes.trim_ascii_start().get(..KEYWORD.len());
        word.is_some_and(|w| w.eq_ignore_ascii_case(KEYWORD))
    },
    head: |bytes| {
        let head = BvhHead::parse(bytes).map_err(unreadable)?;
        Ok(head.recording(bytes.len() as u64))
    },
    read: |bytes| Bvh::parse(bytes).map_err(unreadable)?.recording(),
};
/// First word of a file.
const KEYWORD: &[u8] = b"HIERARCHY";

fn unreadable(e: BvhError) -> RecordingError {
    RecordingError::Unreadable {
        format: FORMAT.name,
        reason: e.to_string(),
    }
}

/// One number of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum BvhChannel {
    Xposition,
    Yposition,
    Zposition,
    Xrotation,
    Yrotation,
    Zrotation,
}

impl BvhChannel {
    const ALL: [(Self, &'static str); 6] = [
        (Self::Xposition, "Xposition"),
        (Self::Yposition, "Yposition"),
        (Self::Zposition, "Zposition"),
        (Self::Xrotation, "Xrotation"),
        (Self::Yrotation, "Yrotation"),
        (Self::Zrotation, "Zrotation"),
    ];

    fn from_word(word: &[u8]) -> Option<Self> {
        Self::ALL
            .iter()
            .find(|(_, name)| name.as_bytes().eq_ignore_ascii_case(word))
            .map(|(channel, _)| *channel)
    }

    /// Name as files write it, for example `Zrotation`.
    pub fn name(self) -> &'static str {
        Self::ALL[self as usize].1
    }

    /// Whether it is a position channel.
    pub fn is_position(self) -> bool {
        (self as usize) < 3
    }

    /// 0 = x, 1 = y, 2 = z.
    pub fn axis(self) -> usize {
        self as usize % 3
    }
}

/// One joint of the file's skeleton.
#[derive(Clone, Debug, PartialEq)]
pub struct BvhJoint {
    /// Name as written, blanks inside kept.
    pub name: String,
    /// Index of the parent; `None` for the root only.
    pub parent: Option<usize>,
    /// Position in the parent's frame where no position channel says otherwise, file units.
    pub offset: [f64; 3],
    /// Channels in the order of the file. Rotations are applied in this order, each about the axes as turned by the one
    /// before.
    pub channels: Vec<BvhChannel>,
    /// Offset of the End Site, if there is one (it may be zero), file units.
    pub end_site: Option<[f64; 3]>,
}

impl BvhJoint {
    fn recorded(&self) -> RecordedJoint {
        RecordedJoint {
            name: self.name.clone(),
            parent: self.parent,
            offset: Vec3::from_array(self.offset),
            end_site: self.end_site.map(Vec3::from_array),
            has_position: self.channels.iter().any(|c| c.is_position()),
        }
    }
}

/// A motion capture file.
#[derive(Clone, Debug, PartialEq)]
pub struct Bvh {
    /// Joints in file order; parents come before their children, the root is first.
    pub joints: Vec<BvhJoint>,
    /// Time between frames as declared, s; positive. Files lie about it.
    pub frame_time: f64,
    /// Number of frames that are present (a declaration off by one is accepted with a warning).
    pub frame_count: usize,
    /// Oddities of the file, for the user's report.
    pub warnings: Vec<String>,
    /// Channel values, frame after frame, each in joint and channel order.
    values: Vec<f64>,
    /// Index of each joint's first channel within a frame.
    first_channel: Vec<usize>,
    /// Channels of one frame.
    channel_count: usize,
    /// Whether position channels are relative to the joint's offset instead of replacing it.
    relative_position: Vec<bool>,
}

/// Bytes of a channel value in memory.
const VALUE_BYTES: u64 = 8;

/// The head of a file, before its frames are read.
#[derive(Clone, Debug, PartialEq)]
pub struct BvhHead {
    /// As [`Bvh::joints`].
    pub joints: Vec<BvhJoint>,
    /// Channels of one frame.
    pub channel_count: usize,
    /// Number of frames as declared.
    pub frame_count: u64,
    /// Time between frames as declared, s.
    pub frame_time: f64,
    /// Index of each joint's first channel within a frame.
    first_channel: Vec<usize>,
}

impl BvhHead {
    /// Reads the head of a file.
    ///
    /// # Errors
    /// The first thing that cannot be read, with its line.
    pub fn parse(bytes: &[u8]) -> Result<Self, BvhError> {
        Self::read(&mut BvhReader::new(bytes), &mut Warnings::default())
    }

    /// The head as a reader of recordings needs it. Of the declared frames, counts only those that `bytes` of a file
    /// can hold: two for each number.
    fn recording(&self, bytes: u64) -> RecordingHead {
        let frame_count = self.frame_count.min(bytes / 2);
        let values = frame_count.saturating_mul(self.channel_count as u64);
        RecordingHead {
            joints: self.joints.iter().map(BvhJoint::recorded).collect(),
            frame_count,
            rate_hz: 1.0 / self.frame_time,
            reading_bytes: VALUE_BYTES * values.min(bytes / 2),
        }
    }

    fn read(reader: &mut BvhReader<'_>, warnings: &mut Warnings) -> Result<Self, BvhError> {
        let joints = parse_hierarchy(reader, warnings)?;
        let mut first_channel = Vec::with_capacity(joints.len());
        let mut channel_count = 0;
        for joint in &joints {
            first_channel.push(channel_count);
            channel_count += joint.channels.len();
        }
        if channel_count == 0 {
            return Err(BvhError::NoChannels { line: reader.line });
        }
        let (frame_count, frame_time) = parse_motion_head(reader)?;
        Ok(Self {
            joints,
            channel_count,
            frame_count,
            frame_time,
            first_channel,
        })
    }
}

/// Why a file is not readable BVH. Lines, frames and columns count from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)]
pub enum BvhError {
    #[error("line {line}: expected {expected}, found {found}")]
    Unexpected {
        line: usize,
        expected: &'static str,
        found: String,
    },
    #[error("line {line}: the file ends where {expected} should follow")]
    UnexpectedEnd { line: usize, expected: &'static str },
    #[error("line {line}: a second ROOT ({name:?}); one file holds one figure")]
    SecondRoot { line: usize, name: String },
    #[error("line {line}: {what} is given twice for joint {joint:?}")]
    Twice {
        line: usize,
        what: &'static str,
        joint: String,
    },
    #[error("line {line}: joint {joint:?} has no OFFSET")]
    NoOffset { line: usize, joint: String },
    #[error("line {line}: {what} is not a number (of at most 1e12): {found}")]
    Number {
        line: usize,
        what: &'static str,
        found: String,
    },
    #[error("line {line}: a joint has 0 to 6 channels, not {found}")]
    ChannelCount { line: usize, found: String },
    #[error("line {line}: more than {MAX_JOINTS} joints")]
    TooManyJoints { line: usize },
    #[error("line {line}: {what} must be positive, not {found}")]
    NotPositive {
        line: usize,
        what: &'static str,
        found: String,
    },
    #[error("line {line}: no joint has a channel, so there is no motion")]
    NoChannels { line: usize },
    #[error("line {line}, frame {frame}, column {column}: not a number (of at most 1e12): {found}")]
    FrameNumber {
        line: usize,
        frame: usize,
        column: usize,
        found: String,
    },
    #[error("line {line}, frame {frame}: {found} columns, the joints have {expected} channels")]
    Columns {
        line: usize,
        frame: usize,
        expected: usize,
        found: usize,
    },
    #[error("line {line}: {declared} frames are declared, {found} are present")]
    Frames {
        line: usize,
        declared: u64,
        /// Rows read; reading stops at two more than declared.
        found: usize,
    },
}

impl Bvh {
    /// Reads a file.
    ///
    /// Accepted beyond the letter of the format: any channel order and number per joint, a rotation order of its own at
    /// each joint, joints without End Site or with an empty one, names with blanks, keywords in any case, one frame
    /// more or fewer than declared. Such deviations are noted in [`Bvh::warnings`] where they may matter.
    ///
    /// # Errors
    /// The first thing that cannot be read, with its line and, in the motion part, its frame and column.
    pub fn parse(bytes: &[u8]) -> Result<Self, BvhError> {
        let mut reader = BvhReader::new(bytes);
        let mut warnings = Warnings::default();
        let head = BvhHead::read(&mut reader, &mut warnings)?;
        let (columns, declared) = (head.channel_count, head.frame_count);
        let (values, frame_count) = parse_frames(&mut reader, columns, declared, &mut warnings)?;

        let mut bvh = Self {
            relative_position: vec![false; head.joints.len()],
            joints: head.joints,
            frame_time: head.frame_time,
            frame_count,
            warnings: Vec::new(),
            values,
            first_channel: head.first_channel,
            channel_count: columns,
        };
        bvh.find_relative_positions(&mut warnings);
        bvh.warnings = warnings.0;
        Ok(bvh)
    }

    /// The motion as a recording.
    ///
    /// # Errors
    /// A skeleton without the bones of a body, a motion that is too short or too long, a place that is not finite.
    pub fn recording(&self) -> Result<Recording, RecordingError> {
        let facts = RecordingFacts {
            joints: self.joints.iter().map(BvhJoint::recorded).collect(),
            frame_count: self.frame_count,
            rate_hz: 1.0 / self.frame_time,
            unit_m: None,
            up: None,
            warnings: self.warnings.clone(),
        };
        Recording::new(facts, |frame, poses| self.world_into(frame, poses))
    }

    /// Channel values of one frame in joint and channel order, file units and degrees.
    ///
    /// Panics if `frame` is not below [`Bvh::frame_count`]: that is a bug in the caller.
    pub fn frame(&self, frame: usize) -> &[f64] {
        assert!(frame < self.frame_count, "frame out of range");
        &self.values[frame * self.channel_count..(frame + 1) * self.channel_count]
    }

    /// Number of channels of one frame.
    pub fn channel_count(&self) -> usize {
        self.channel_count
    }

    /// The same motion as a mirror shows it, x against −x of the file. Names stay: the joint called left is then on the
    /// right.
    pub fn mirrored(&self) -> Self {
        let mut out = self.clone();
        for joint in &mut out.joints {
            joint.offset[0] = -joint.offset[0];
            if let Some(end) = &mut joint.end_site {
                end[0] = -end[0];
            }
        }
        let changes: Vec<bool> = { out.joints.iter() }
            .flat_map(|j| &j.channels)
            .map(|c| {
                use BvhChannel::{Xposition, Yrotation, Zrotation};
                matches!(c, Xposition | Yrotation | Zrotation)
            })
            .collect();
        for (i, value) in out.values.iter_mut().enumerate() {
            if changes[i % changes.len()] {
                *value = -*value;
            }
        }
        out
    }

    /// Pose of every joint in one frame, in file order: positions in file units, both in file axes.
    ///
    /// Panics if `frame` is not below [`Bvh::frame_count`]: that is a bug in the caller.
    pub fn world(&self, frame: usize) -> Vec<JointPose> {
        let mut out = Vec::with_capacity(self.joints.len());
        self.world_into(frame, &mut out);
        out
    }

    /// Like [`Bvh::world`], into a vector that is cleared first and keeps its memory.
    pub fn world_into(&self, frame: usize, out: &mut Vec<JointPose>) {
        let values = self.frame(frame);
        out.clear();
        for (j, joint) in self.joints.iter().enumerate() {
            let mut local = joint.offset;
            let mut turned = Quat::identity();
            let values = &values[self.first_channel[j]..];
            for (channel, value) in joint.channels.iter().zip(values) {
                let k = channel.axis();
                if channel.is_position() {
                    // A position channel gives the whole offset along its axis, unless the file means increments.
                    local[k] = if self.relative_position[j] {
                        joint.offset[k] + value
                    } else {
                        *value
                    };
                } else {
                    let mut axis = [0.0; 3];
                    axis[k] = 1.0;
                    // Whole turns carry no information; taking them off keeps huge angles exact.
                    let angle = (value % 360.0).to_radians();
                    turned = turned * Quat::from_axis_angle(Vec3::from_array(axis), angle);
                }
            }
            let local = Vec3::from_array(local);
            out.push(match joint.parent {
                None => JointPose {
                    position: local,
                    rotation: turned.normalized(),
                },
                Some(p) => {
                    let parent: JointPose = out[p];
                    JointPose {
                        position: parent.position + parent.rotation.rotate(local),
                        rotation: (parent.rotation * turned).normalized(),
                    }
                }
            });
        }
    }

    /// World position of a joint's End Site, given the poses of [`Bvh::world`]; `None` if it has none.
    pub fn end_site_world(&self, joint: usize, poses: &[JointPose]) -> Option<Vec3> {
        let end = self.joints[joint].end_site?;
        let pose = poses[joint];
        Some(pose.position + pose.rotation.rotate(vec3(end[0], end[1], end[2])))
    }

    /// Finds inner joints whose position channels are increments on the offset: all frames stay closer to zero than to
    /// the offset and below half its length, which does not happen to a bone whose position is given in full.
    fn find_relative_positions(&mut self, warnings: &mut Warnings) {
        for (j, joint) in self.joints.iter().enumerate() {
            let positions = joint.channels.iter().filter(|c| c.is_position()).count();
            let length = Vec3::from_array(joint.offset).norm();
            if joint.parent.is_none() || positions == 0 || length <= 0.0 {
                continue;
            }
            let all_near_zero = (0..self.frame_count).all(|f| {
                let values = &self.values[f * self.channel_count + self.first_channel[j]..];
                let (mut to_zero, mut to_offset) = (0.0, 0.0);
                for (channel, value) in joint.channels.iter().zip(values) {
                    if channel.is_position() {
                        to_zero += value * value;
                        to_offset += (value - joint.offset[channel.axis()]).powi(2);
                    }
                }
                to_zero < to_offset && to_zero < 0.25 * length * length
            });
            if all_near_zero {
                self.relative_position[j] = true;
                warnings.add(|| {
                    format!(
                        "joint {:?}: position channels taken as increments on its OFFSET",
                        joint.name
                    )
                });
            }
        }
    }
}

#[cfg(test)]
mod tests;
