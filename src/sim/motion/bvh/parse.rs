//! Text of a BVH file to joints and numbers. Every error is reported with its line, frame and column.

use super::{BvhChannel, BvhError, BvhJoint};
use crate::motion::skeleton::MAX_JOINTS;
use std::collections::BTreeMap;

/// Largest number of warnings that are kept.
const MAX_WARNINGS: usize = 32;
/// Largest number that is accepted: far beyond any unit in which a figure is measured, small enough that no sum of them
/// overflows.
const LARGEST: f64 = 1e12;
/// Longest excerpt of the file that an error quotes, bytes.
const QUOTE: usize = 40;

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

/// Position in the bytes, with its line.
pub(super) struct BvhReader<'a> {
    bytes: &'a [u8],
    at: usize,
    pub line: usize,
}

impl<'a> BvhReader<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
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

    /// The next word: a brace, or the text up to the next blank, line end or brace.
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
pub(super) struct Warnings(pub Vec<String>);

impl Warnings {
    pub(super) fn add(&mut self, text: impl FnOnce() -> String) {
        if self.0.len() < MAX_WARNINGS {
            self.0.push(text());
        }
    }
}

/// The data already read of a joint whose brace is open.
pub(super) struct OpenJoint {
    index: usize,
    /// Line of its name.
    line: usize,
    has_offset: bool,
    has_channels: bool,
}

pub(super) fn parse_hierarchy(
    reader: &mut BvhReader<'_>,
    warnings: &mut Warnings,
) -> Result<Vec<BvhJoint>, BvhError> {
    reader.expect("HIERARCHY")?;
    reader.expect("ROOT")?;
    let mut joints: Vec<BvhJoint> = Vec::new();
    let mut open: Vec<OpenJoint> = Vec::new(); // in place of recursion: depth is the sender's choice
    let mut lines = vec![open_joint(reader, &mut joints, &mut open, warnings)?];
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
            lines.push(open_joint(reader, &mut joints, &mut open, warnings)?);
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
                return Err(BvhError::NoOffset {
                    line: top.line,
                    joint: joints[index].name.clone(),
                });
            }
            open.pop();
        } else {
            return Err(reader.unexpected("OFFSET, CHANNELS, JOINT, End Site or }", word));
        }
    }
    note_duplicate_names(&joints, &lines, warnings);
    Ok(joints)
}

/// One warning per name that several joints have. Whether it matters is known only when bones are mapped.
fn note_duplicate_names(joints: &[BvhJoint], lines: &[usize], warnings: &mut Warnings) {
    let mut by_name: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (joint, line) in joints.iter().zip(lines) {
        by_name.entry(&joint.name).or_default().push(*line);
    }
    for (name, lines) in by_name.into_iter().filter(|(_, lines)| lines.len() > 1) {
        let first: Vec<String> = lines.iter().take(4).map(usize::to_string).collect();
        let more = if lines.len() > first.len() {
            ", …"
        } else {
            ""
        };
        warnings.add(|| {
            format!(
                "{} joints are named {name:?} (lines {}{more})",
                lines.len(),
                first.join(", ")
            )
        });
    }
}

/// Reads the name and the opening brace of a ROOT or JOINT and puts it on the stack. Returns the line of the name.
fn open_joint(
    reader: &mut BvhReader<'_>,
    joints: &mut Vec<BvhJoint>,
    open: &mut Vec<OpenJoint>,
    warnings: &mut Warnings,
) -> Result<usize, BvhError> {
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
        line,
        has_offset: false,
        has_channels: false,
    });
    Ok(line)
}

/// Reads the rest of an End Site; an empty block counts as zero length.
fn parse_end_site(reader: &mut BvhReader<'_>) -> Result<[f64; 3], BvhError> {
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
            // An End Site has no motion; a few writers state that explicitly.
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
pub(super) fn parse_motion_head(reader: &mut BvhReader<'_>) -> Result<(u64, f64), BvhError> {
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
pub(super) fn parse_frames(
    reader: &mut BvhReader<'_>,
    columns: usize,
    declared: u64,
    warnings: &mut Warnings,
) -> Result<(Vec<f64>, usize), BvhError> {
    // A number takes two bytes with its separator, so the remaining bytes bound the memory that a declaration can make
    // us reserve.
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
