//! Reading BVH motion capture (Biovision hierarchy).
//!
//! One pass over the bytes, no recursion, memory and time linear in their number: what a file declares (joints, frames, channels) is
//! believed only as far as the bytes bear it out. The hierarchy and the head of the motion part are read word by word, so line
//! breaks, indentation and brace placement do not matter there; each frame is one line. LF, CRLF and lone CR end a line.
//!
//! Numbers stay in file units and file axes, angles in degrees; what they mean in metres and which way is up is for
//! retargeting to find out.

use crate::sim::math::{Quat, Vec3, vec3::vec3};

/// Most joints a file may have; a hand-animated figure with fingers and face has a few hundred.
pub const MAX_JOINTS: usize = 4096;
/// Most warnings that are kept.
const MAX_WARNINGS: usize = 32;
/// Largest number that is read: far beyond any unit a figure is measured in, small enough that no sum of them overflows.
const LARGEST: f64 = 1e12;
/// Longest excerpt of the file that an error quotes, bytes.
const QUOTE: usize = 40;

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

    /// True for a position channel.
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
    /// Channels in the order of the file; rotations are applied in this order, each about the axes the one before has turned.
    pub channels: Vec<BvhChannel>,
    /// Offset of the End Site, if there is one (it may be zero), file units.
    pub end_site: Option<[f64; 3]>,
}

/// Pose of one joint in file units and file axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointPose {
    /// Joint position.
    pub position: Vec3,
    /// `world_from_joint`.
    pub rotation: Quat,
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
    /// What was odd about the file, for the user's report.
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

fn quote(bytes: &[u8]) -> String {
    if bytes.len() > QUOTE {
        format!("{:?}…", String::from_utf8_lossy(&bytes[..QUOTE]))
    } else {
        format!("{:?}", String::from_utf8_lossy(bytes))
    }
}

fn number(word: &[u8]) -> Option<f64> {
    // The letters of `inf` and `nan` never get as far as the conversion.
    if !word
        .iter()
        .all(|b| matches!(b, b'0'..=b'9' | b'.' | b'+' | b'-' | b'e' | b'E'))
    {
        return None;
    }
    let value: f64 = std::str::from_utf8(word).ok()?.parse().ok()?;
    (value.abs() <= LARGEST).then_some(value)
}

fn is_blank(b: u8) -> bool {
    matches!(b, b' ' | b'\t' | 0x0b | 0x0c)
}

fn is_line_end(b: u8) -> bool {
    matches!(b, b'\n' | b'\r')
}

/// Position in the bytes, with the line it is on.
struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
}

impl<'a> Reader<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        let mut bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        // DOS writers end the text with Ctrl-Z, some C writers with the string's NUL.
        while let [rest @ .., 0x1a | 0] = bytes {
            bytes = rest;
        }
        Self {
            bytes,
            at: 0,
            line: 1,
        }
    }

    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn skip_blanks(&mut self) {
        while self.peek().is_some_and(is_blank) {
            self.at += 1;
        }
    }

    /// Steps over one line end, if the reader is at one.
    fn skip_line_end(&mut self) -> bool {
        match self.peek() {
            Some(b'\r') => {
                self.at += 1;
                if self.peek() == Some(b'\n') {
                    self.at += 1;
                }
            }
            Some(b'\n') => self.at += 1,
            _ => return false,
        }
        self.line += 1;
        true
    }

    fn skip_white(&mut self) {
        loop {
            self.skip_blanks();
            if !self.skip_line_end() {
                return;
            }
        }
    }

    fn take_while(&mut self, keep: impl Fn(u8) -> bool) -> &'a [u8] {
        let start = self.at;
        while self.peek().is_some_and(&keep) {
            self.at += 1;
        }
        &self.bytes[start..self.at]
    }

    /// The next word: a brace, or what reaches to the next blank, line end or brace.
    fn word(&mut self, expected: &'static str) -> Result<&'a [u8], BvhError> {
        self.skip_white();
        match self.peek() {
            None => Err(BvhError::UnexpectedEnd {
                line: self.line,
                expected,
            }),
            Some(b'{' | b'}') => {
                self.at += 1;
                Ok(&self.bytes[self.at - 1..self.at])
            }
            Some(_) => {
                Ok(self.take_while(|b| !is_blank(b) && !is_line_end(b) && b != b'{' && b != b'}'))
            }
        }
    }

    /// A word without its colon: `Frames:`, `Frames :` and `Frames` are the same.
    fn header_word(&mut self, expected: &'static str) -> Result<&'a [u8], BvhError> {
        loop {
            self.skip_white();
            if self.peek() == Some(b':') {
                self.at += 1;
                continue;
            }
            if self.peek().is_none() {
                return Err(BvhError::UnexpectedEnd {
                    line: self.line,
                    expected,
                });
            }
            return Ok(self.take_while(|b| !is_blank(b) && !is_line_end(b) && b != b':'));
        }
    }

    fn expect(&mut self, keyword: &'static str) -> Result<(), BvhError> {
        let word = self.word(keyword)?;
        if word.eq_ignore_ascii_case(keyword.as_bytes()) {
            Ok(())
        } else {
            Err(self.unexpected(keyword, word))
        }
    }

    fn unexpected(&self, expected: &'static str, word: &[u8]) -> BvhError {
        BvhError::Unexpected {
            line: self.line,
            expected,
            found: quote(word),
        }
    }

    fn number(&mut self, what: &'static str) -> Result<f64, BvhError> {
        let word = self.word(what)?;
        number(word).ok_or_else(|| BvhError::Number {
            line: self.line,
            what,
            found: quote(word),
        })
    }

    fn offset(&mut self) -> Result<[f64; 3], BvhError> {
        Ok([
            self.number("an offset")?,
            self.number("an offset")?,
            self.number("an offset")?,
        ])
    }

    /// The rest of the line, or up to an opening brace on it, without blanks at the ends.
    fn name(&mut self) -> String {
        self.skip_blanks();
        let raw = self.take_while(|b| !is_line_end(b) && b != b'{');
        String::from_utf8_lossy(raw).trim().to_owned()
    }
}

#[derive(Default)]
struct Warnings(Vec<String>);

impl Warnings {
    fn add(&mut self, text: impl FnOnce() -> String) {
        if self.0.len() < MAX_WARNINGS {
            self.0.push(text());
        }
    }
}

/// What has been said so far about a joint whose brace is open.
struct OpenJoint {
    index: usize,
    has_offset: bool,
    has_channels: bool,
}

impl Bvh {
    /// Reads a file.
    ///
    /// Accepted beyond the letter of the format: any channel order and number per joint, a rotation order of its own at each
    /// joint, joints without End Site or with an empty one, names with blanks, keywords in any case, one frame more or
    /// fewer than declared. Such things are noted in [`Bvh::warnings`] where they may matter.
    ///
    /// # Errors
    /// The first thing that cannot be read, with its line and, in the motion part, its frame and column.
    pub fn parse(bytes: &[u8]) -> Result<Self, BvhError> {
        let mut reader = Reader::new(bytes);
        let mut warnings = Warnings::default();
        let joints = parse_hierarchy(&mut reader, &mut warnings)?;

        let mut first_channel = Vec::with_capacity(joints.len());
        let mut channel_count = 0;
        for joint in &joints {
            first_channel.push(channel_count);
            channel_count += joint.channels.len();
        }
        if channel_count == 0 {
            return Err(BvhError::NoChannels { line: reader.line });
        }

        let (declared, frame_time) = parse_motion_head(&mut reader)?;
        let (values, frame_count) =
            parse_frames(&mut reader, channel_count, declared, &mut warnings)?;

        let mut bvh = Self {
            relative_position: vec![false; joints.len()],
            joints,
            frame_time,
            frame_count,
            warnings: Vec::new(),
            values,
            first_channel,
            channel_count,
        };
        bvh.find_relative_positions(&mut warnings);
        bvh.warnings = warnings.0;
        Ok(bvh)
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

    /// Finds inner joints whose position channels are increments on the offset: all frames stay closer to zero than to the offset
    /// and below half its length, which no bone does that is given whole.
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

fn parse_hierarchy(
    reader: &mut Reader<'_>,
    warnings: &mut Warnings,
) -> Result<Vec<BvhJoint>, BvhError> {
    reader.expect("HIERARCHY")?;
    reader.expect("ROOT")?;
    let mut joints: Vec<BvhJoint> = Vec::new();
    let mut open: Vec<OpenJoint> = Vec::new(); // in place of recursion: depth is the sender's choice
    open_joint(reader, &mut joints, &mut open, warnings)?;
    while let Some(top) = open.last_mut() {
        let index = top.index;
        let word = reader.word("OFFSET, CHANNELS, JOINT, End Site or }")?;
        let twice = |line, what, joints: &[BvhJoint]| BvhError::Twice {
            line,
            what,
            joint: joints[index].name.clone(),
        };
        if word.eq_ignore_ascii_case(b"OFFSET") {
            if std::mem::replace(&mut top.has_offset, true) {
                return Err(twice(reader.line, "OFFSET", &joints));
            }
            joints[index].offset = reader.offset()?;
        } else if word.eq_ignore_ascii_case(b"CHANNELS") {
            if std::mem::replace(&mut top.has_channels, true) {
                return Err(twice(reader.line, "CHANNELS", &joints));
            }
            let count = reader.word("a number of channels")?;
            let count = number(count)
                .filter(|n| (0.0..=6.0).contains(n) && n.fract() == 0.0)
                .ok_or_else(|| BvhError::ChannelCount {
                    line: reader.line,
                    found: quote(count),
                })? as usize;
            let mut channels = Vec::with_capacity(count);
            for _ in 0..count {
                let word = reader.word("a channel")?;
                let channel = BvhChannel::from_word(word)
                    .ok_or_else(|| reader.unexpected("a channel such as Zrotation", word))?;
                if channels.contains(&channel) {
                    return Err(twice(reader.line, channel.name(), &joints));
                }
                channels.push(channel);
            }
            joints[index].channels = channels;
        } else if word.eq_ignore_ascii_case(b"JOINT") {
            open_joint(reader, &mut joints, &mut open, warnings)?;
        } else if word.eq_ignore_ascii_case(b"ROOT") {
            return Err(BvhError::SecondRoot {
                line: reader.line,
                name: reader.name(),
            });
        } else if word.eq_ignore_ascii_case(b"End") || word.eq_ignore_ascii_case(b"EndSite") {
            let end = parse_end_site(reader)?;
            let joint = &mut joints[index];
            if joint.end_site.is_none() {
                joint.end_site = Some(end);
            } else {
                let line = reader.line;
                warnings.add(|| {
                    format!(
                        "line {line}: joint {:?} has several End Sites, the first counts",
                        joint.name
                    )
                });
            }
        } else if word == b"}" {
            if !top.has_offset {
                let (line, name) = (reader.line, &joints[index].name);
                warnings.add(|| format!("line {line}: joint {name:?} has no OFFSET, taken as 0"));
            }
            open.pop();
        } else {
            return Err(reader.unexpected("OFFSET, CHANNELS, JOINT, End Site or }", word));
        }
    }
    Ok(joints)
}

/// Reads the name and the opening brace of a ROOT or JOINT and puts it on the stack.
fn open_joint(
    reader: &mut Reader<'_>,
    joints: &mut Vec<BvhJoint>,
    open: &mut Vec<OpenJoint>,
    warnings: &mut Warnings,
) -> Result<(), BvhError> {
    let index = joints.len();
    if index == MAX_JOINTS {
        return Err(BvhError::TooManyJoints { line: reader.line });
    }
    let line = reader.line;
    let mut name = reader.name();
    if name.is_empty() {
        name = format!("unnamed_{index}");
        warnings.add(|| format!("line {line}: a joint without a name, called {name:?}"));
    }
    reader.expect("{")?;
    joints.push(BvhJoint {
        name,
        parent: open.last().map(|top| top.index),
        offset: [0.0; 3],
        channels: Vec::new(),
        end_site: None,
    });
    open.push(OpenJoint {
        index,
        has_offset: false,
        has_channels: false,
    });
    Ok(())
}

/// Reads the rest of an End Site; an empty block counts as zero length.
fn parse_end_site(reader: &mut Reader<'_>) -> Result<[f64; 3], BvhError> {
    let _site = reader.name(); // "Site", in some files with a name
    reader.expect("{")?;
    let mut offset = None;
    loop {
        let word = reader.word("OFFSET or }")?;
        if word == b"}" {
            return Ok(offset.unwrap_or([0.0; 3]));
        }
        let channels = word.eq_ignore_ascii_case(b"CHANNELS");
        if offset.is_none() && word.eq_ignore_ascii_case(b"OFFSET") {
            offset = Some(reader.offset()?);
        } else if channels {
            // An End Site has no motion; a few writers say so.
            let count = reader.number("a number of channels")?;
            if count != 0.0 {
                return Err(BvhError::ChannelCount {
                    line: reader.line,
                    found: format!("{count} at an End Site"),
                });
            }
        } else {
            return Err(reader.unexpected("OFFSET or }", word));
        }
    }
}

/// Reads from `MOTION` to the frame time; the two settings come in either order.
fn parse_motion_head(reader: &mut Reader<'_>) -> Result<(u64, f64), BvhError> {
    let word = reader.header_word("MOTION")?;
    if word.eq_ignore_ascii_case(b"ROOT") {
        return Err(BvhError::SecondRoot {
            line: reader.line,
            name: reader.name(),
        });
    }
    if !word.eq_ignore_ascii_case(b"MOTION") {
        return Err(reader.unexpected("MOTION", word));
    }
    let (mut frames, mut frame_time) = (None, None);
    while frames.is_none() || frame_time.is_none() {
        let expected = if frames.is_none() {
            "Frames:"
        } else {
            "Frame Time:"
        };
        let mut word = reader.header_word(expected)?;
        if frames.is_none() && word.eq_ignore_ascii_case(b"Frames") {
            let value = reader.header_word("a number of frames")?;
            let count = number(value)
                .filter(|n| n.fract() == 0.0 && *n < 9e15)
                .ok_or_else(|| BvhError::Number {
                    line: reader.line,
                    what: "the number of frames",
                    found: quote(value),
                })?;
            if count < 1.0 {
                return Err(BvhError::NotPositive {
                    line: reader.line,
                    what: "the number of frames",
                    found: quote(value),
                });
            }
            frames = Some(count as u64);
            continue;
        }
        let split = word.eq_ignore_ascii_case(b"Frame") || word.eq_ignore_ascii_case(b"Frames");
        if split {
            word = reader.header_word("Frame Time:")?;
        }
        if frame_time.is_some()
            || !(split && word.eq_ignore_ascii_case(b"Time")
                || word.eq_ignore_ascii_case(b"FrameTime"))
        {
            return Err(reader.unexpected(expected, word));
        }
        let value = reader.header_word("a frame time")?;
        let time = number(value).ok_or_else(|| BvhError::Number {
            line: reader.line,
            what: "the frame time",
            found: quote(value),
        })?;
        if time <= 0.0 {
            return Err(BvhError::NotPositive {
                line: reader.line,
                what: "the frame time",
                found: quote(value),
            });
        }
        frame_time = Some(time);
    }
    Ok(frames
        .zip(frame_time)
        .expect("the loop ends when both are set"))
}

/// Reads one frame per line to the end of the bytes.
fn parse_frames(
    reader: &mut Reader<'_>,
    columns: usize,
    declared: u64,
    warnings: &mut Warnings,
) -> Result<(Vec<f64>, usize), BvhError> {
    // A number takes two bytes with its separator, so the bytes left bound what a declaration can make us reserve.
    let most = (reader.bytes.len() - reader.at) / 2 + 1;
    let wanted = declared.saturating_mul(columns as u64);
    let mut values = Vec::with_capacity(usize::try_from(wanted).unwrap_or(most).min(most));
    let mut frames = 0usize;
    let mut last_line = reader.line;
    loop {
        reader.skip_white();
        if reader.peek().is_none() {
            break;
        }
        last_line = reader.line;
        if frames as u64 > declared {
            return Err(BvhError::Frames {
                line: last_line,
                declared,
                found: frames + 1,
            });
        }
        let mut column = 0;
        while reader.peek().is_some_and(|b| !is_line_end(b)) {
            let word = reader.take_while(|b| !is_blank(b) && !is_line_end(b));
            column += 1;
            if column <= columns {
                values.push(number(word).ok_or_else(|| BvhError::FrameNumber {
                    line: last_line,
                    frame: frames + 1,
                    column,
                    found: quote(word),
                })?);
            }
            reader.skip_blanks();
        }
        if column != columns {
            return Err(BvhError::Columns {
                line: last_line,
                frame: frames + 1,
                expected: columns,
                found: column,
            });
        }
        frames += 1;
    }
    if frames == 0 || (frames as u64) + 1 < declared {
        return Err(BvhError::Frames {
            line: last_line,
            declared,
            found: frames,
        });
    }
    if frames as u64 != declared {
        warnings.add(|| format!("{declared} frames are declared, {frames} are present and used"));
    }
    Ok((values, frames))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const PLAIN: &str = "HIERARCHY\nROOT Hips\n{\n\tOFFSET 0 1 0\n\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n\
        \tJOINT Leg\n\t{\n\t\tOFFSET 0 -2 0\n\t\tCHANNELS 3 Xrotation Yrotation Zrotation\n\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 -3 0\n\t\t}\n\t}\n}\n\
        MOTION\nFrames: 2\nFrame Time: 0.01\n1 2 3 0 0 0 0 0 0\n1 2 3 90 0 0 90 0 0\n";

    fn close(a: Vec3, b: [f64; 3]) {
        assert!((a - Vec3::from_array(b)).norm() < 1e-12, "{a:?} {b:?}");
    }

    fn error(text: &str) -> String {
        Bvh::parse(text.as_bytes())
            .expect_err("must fail")
            .to_string()
    }

    #[test]
    fn plain_file_is_read_and_placed() {
        let bvh = Bvh::parse(PLAIN.as_bytes()).unwrap();
        assert_eq!((bvh.joints.len(), bvh.frame_count), (2, 2));
        assert_eq!(bvh.frame_time, 0.01);
        assert!(bvh.warnings.is_empty());
        assert_eq!(bvh.joints[1].parent, Some(0));
        let rest = bvh.world(0);
        close(rest[0].position, [1.0, 2.0, 3.0]); // the channels replace the root's offset
        close(rest[1].position, [1.0, 0.0, 3.0]);
        let turned = bvh.world(1);
        close(turned[1].position, [3.0, 2.0, 3.0]); // Z 90°: down becomes +x
        // then X 90° in the turned frame: the end, down at first, points along −z of the root frame, which Z leaves alone
        close(bvh.end_site_world(1, &turned).unwrap(), [3.0, 2.0, 0.0]);
    }

    #[test]
    fn rotations_apply_in_channel_order() {
        let text = PLAIN
            .replace(
                "Zrotation Xrotation Yrotation",
                "Xrotation Zrotation Yrotation",
            )
            .replace("1 2 3 90 0 0 90 0 0", "1 2 3 90 90 0 0 0 0");
        let bvh = Bvh::parse(text.as_bytes()).unwrap();
        // R = Rx(90)·Rz(90): (0,−2,0) → Rz → (2,0,0) → Rx → (2,0,0); the other order would give (0,0,−2).
        close(bvh.world(1)[1].position, [3.0, 2.0, 3.0]);
    }

    #[test]
    fn dialects_read_alike() {
        let plain = Bvh::parse(PLAIN.as_bytes()).unwrap();
        let variants = [
            PLAIN.replace('\n', "\r\n"),
            PLAIN.replace('\n', "\r"),
            PLAIN.replace(' ', "\t"),
            PLAIN.replace('\n', "  \n\n"),
            PLAIN.replace("\n{", " {"),
            PLAIN.replace("Frames: 2", "Frames:2"),
            PLAIN.replace("Frames: 2", "FRAMES :\t2"),
            PLAIN.replace("Frame Time: 0.01", "Frame Time:1e-2"),
            PLAIN.replace("Frame Time: 0.01", "FrameTime: +1.0E-02"),
            PLAIN.replace(
                "Frames: 2\nFrame Time: 0.01",
                "Frame Time: .01\nFrames: 2.0",
            ),
            PLAIN.replace("Xposition", "XPOSITION").to_string(),
            PLAIN.replace("1 2 3 90", "1e0 +2. 3.0E+00 9.0e1"),
            PLAIN.replace("1 2 3 90", "1 2 3 -270"),
            format!("\u{feff}{PLAIN}"),
            format!("{PLAIN}\u{1a}"),
            PLAIN.trim_end().to_string(),
        ];
        for text in variants {
            let bvh = Bvh::parse(text.as_bytes()).unwrap_or_else(|e| panic!("{text:?}: {e}"));
            for f in 0..2 {
                for (a, b) in bvh.world(f).iter().zip(plain.world(f)) {
                    close(a.position, b.position.to_array());
                }
            }
            assert_eq!(bvh.frame_time, 0.01);
            assert_eq!(bvh.joints[0].name, "Hips");
        }
    }

    #[test]
    fn names_keep_blanks_and_end_sites_may_be_missing_or_empty() {
        let text = PLAIN.replace("JOINT Leg", "JOINT  Left Leg 01 \t");
        assert_eq!(
            Bvh::parse(text.as_bytes()).unwrap().joints[1].name,
            "Left Leg 01"
        );
        let none = PLAIN.replace("\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 -3 0\n\t\t}\n", "");
        assert_eq!(
            Bvh::parse(none.as_bytes()).unwrap().joints[1].end_site,
            None
        );
        let empty = PLAIN.replace("\t\t\tOFFSET 0 -3 0\n", "");
        assert_eq!(
            Bvh::parse(empty.as_bytes()).unwrap().joints[1].end_site,
            Some([0.0; 3])
        );
        let nameless = PLAIN.replace("JOINT Leg", "JOINT");
        let bvh = Bvh::parse(nameless.as_bytes()).unwrap();
        assert_eq!(bvh.joints[1].name, "unnamed_1");
        assert_eq!(bvh.warnings.len(), 1);
    }

    #[test]
    fn rotation_only_root_stands_at_its_offset_and_dead_roots_pass() {
        let text = PLAIN
            .replace(
                "CHANNELS 6 Xposition Yposition Zposition Zrotation",
                "CHANNELS 3 Zrotation",
            )
            .replace("1 2 3 ", "");
        close(
            Bvh::parse(text.as_bytes()).unwrap().world(0)[0].position,
            [0.0, 1.0, 0.0],
        );
        let dead = PLAIN
            .replace(
                "ROOT Hips\n{",
                "ROOT reference\n{\nOFFSET 0 0 0\nCHANNELS 0\nJOINT Hips\n{",
            )
            .replace("}\nMOTION", "}\n}\nMOTION");
        let bvh = Bvh::parse(dead.as_bytes()).unwrap();
        assert_eq!(bvh.joints[1].name, "Hips");
        close(bvh.world(0)[2].position, [1.0, 0.0, 3.0]);
    }

    #[test]
    fn inner_positions_replace_the_offset_or_add_to_it() {
        let six = PLAIN.replace(
            "CHANNELS 3 Xrotation Yrotation Zrotation",
            "CHANNELS 6 Xrotation Yrotation Zrotation Xposition Yposition Zposition",
        );
        let whole = six
            .replace("0 0 0 0 0 0\n", "0 0 0 0 0 0 0 -2.1 0\n")
            .replace("90 0 0 90 0 0\n", "90 0 0 90 0 0 0 -2.1 0\n");
        let bvh = Bvh::parse(whole.as_bytes()).unwrap();
        close(bvh.world(0)[1].position, [1.0, 2.0 - 2.1, 3.0]);
        let delta = whole.replace("0 -2.1 0\n", "0.25 0 0\n");
        let bvh = Bvh::parse(delta.as_bytes()).unwrap();
        close(bvh.world(0)[1].position, [1.25, 0.0, 3.0]);
        assert!(bvh.warnings[0].contains("increments"));
    }

    #[test]
    fn one_row_more_or_fewer_is_accepted_two_are_not() {
        for (declared, ok) in [
            (1, true),
            (2, true),
            (3, true),
            (4, false),
            (100_000_000_000u64, false),
        ] {
            let text = PLAIN.replace("Frames: 2", &format!("Frames: {declared}"));
            let bvh = Bvh::parse(text.as_bytes());
            assert_eq!(bvh.is_ok(), ok, "{declared}");
            if let Ok(bvh) = bvh {
                assert_eq!(bvh.frame_count, 2);
                assert_eq!(bvh.warnings.len(), usize::from(declared != 2));
            }
        }
        let text = format!(
            "{}0 0 0 0 0 0 0 0 0\n",
            PLAIN.replace("Frames: 2", "Frames: 1")
        );
        assert!(error(&text).contains("1 frames are declared, 3"));
    }

    #[test]
    fn errors_name_line_frame_and_column() {
        assert!(error("").contains("line 1"));
        assert!(error("<html>").contains("HIERARCHY"));
        assert!(
            error(&PLAIN.replace("1 2 3 90", "1 2 nan 90"))
                .starts_with("line 20, frame 2, column 3")
        );
        assert!(error(&PLAIN.replace("1 2 3 90", "1 2 1e999 90")).contains("column 3"));
        assert!(
            error(&PLAIN.replace("1 2 3 90", "1 2 3 9 90"))
                .contains("line 20, frame 2: 10 columns")
        );
        assert!(error(&PLAIN.replace("1 2 3 90 0 0 ", "1 2 ")).contains("5 columns"));
        assert!(error(&PLAIN.replace("0 -3 0", "0 inf 0")).starts_with("line 12"));
        assert!(error(&PLAIN.replace("CHANNELS 3", "CHANNELS 7")).contains("not \"7\""));
        assert!(error(&PLAIN.replace("CHANNELS 3", "CHANNELS 4")).contains("a channel"));
        assert!(error(&PLAIN.replace("0.01", "0")).contains("must be positive"));
        assert!(error(&PLAIN.replace("0.01", "0,01")).contains("frame time"));
        assert!(error(&PLAIN.replace("Frames: 2", "Frames: 0")).contains("must be positive"));
        assert!(
            error(&PLAIN.replace(
                "Xrotation Yrotation Zrotation\n\t\tEnd",
                "Xrotation Xrotation Zrotation\n\t\tEnd"
            ))
            .contains("twice")
        );
        assert!(
            error(&PLAIN.replace("MOTION", "ROOT other\n{\nOFFSET 0 0 0\n}\nMOTION"))
                .contains("second ROOT")
        );
        assert!(error(&PLAIN.replace("JOINT", "ROOT")).contains("second ROOT"));
        assert!(
            error("HIERARCHY ROOT a { OFFSET 0 0 0 } MOTION Frames: 1 Frame Time: 1\n")
                .contains("no joint has a channel")
        );
        let cut = &PLAIN[..PLAIN.find("\t\tEnd").unwrap()];
        assert!(error(cut).contains("ends where"));
    }

    #[test]
    fn depth_and_joint_count_are_bounded() {
        let deep = format!("HIERARCHY ROOT a {{ {}", "JOINT b\n{ ".repeat(1_000_000));
        assert!(error(&deep).contains("more than 4096 joints"));
        let n = 4000;
        let text = format!(
            "HIERARCHY ROOT a\n{{ CHANNELS 1 Zrotation {} {} }} MOTION Frames: 1 Frame Time: 1\n0\n",
            "JOINT b\n{ OFFSET 0 1 0 ".repeat(n),
            "}".repeat(n)
        );
        let bvh = Bvh::parse(text.as_bytes()).unwrap();
        close(bvh.world(0)[n].position, [0.0, n as f64, 0.0]);
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn any_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
            let _ = Bvh::parse(&bytes);
        }

        #[test]
        fn mutated_files_never_panic(
            edits in proptest::collection::vec((0usize..10_000, 0u8..5, any::<u8>()), 1..8),
        ) {
            let mut bytes = PLAIN.as_bytes().to_vec();
            for (at, kind, byte) in edits {
                let at = at % bytes.len().max(1);
                match kind {
                    0 if at < bytes.len() => bytes[at] = byte,
                    1 if at < bytes.len() => { bytes.remove(at); }
                    2 => bytes.insert(at, byte),
                    3 => bytes.truncate(at.max(1)),
                    _ => { let tail = bytes[at..].to_vec(); bytes.extend_from_slice(&tail); }
                }
            }
            if let Ok(bvh) = Bvh::parse(&bytes) {
                for f in 0..bvh.frame_count {
                    prop_assert_eq!(bvh.world(f).len(), bvh.joints.len());
                }
            }
        }
    }
}
