//! Reading a motion of any known file format.

use super::bvh;
use super::recording::{MotionFormat, Recording, RecordingError, RecordingHead};

/// The supported formats, one line each. The first that recognises a file reads it; the last one is given the files
/// that none recognises, and reports the error in them.
const FORMATS: &[MotionFormat] = &[bvh::FORMAT];

fn format(bytes: &[u8]) -> &'static MotionFormat {
    let found = FORMATS.iter().find(|f| (f.recognises)(bytes));
    found.unwrap_or(&FORMATS[FORMATS.len() - 1])
}

/// Reads a file of any known format.
///
/// # Errors
/// The first thing that cannot be read, with its place in the file; a skeleton without the bones of a body; a motion
/// that is too short or too long.
pub fn read(bytes: &[u8]) -> Result<Recording, RecordingError> {
    let format = format(bytes);
    (format.read)(bytes)
}

/// Reads the head of a file, before its frames.
///
/// # Errors
/// The first thing that cannot be read, with its place in the file.
pub fn read_head(bytes: &[u8]) -> Result<RecordingHead, RecordingError> {
    let format = format(bytes);
    (format.head)(bytes)
}

/// Name of the format as which a file is read.
pub fn format_name(bytes: &[u8]) -> &'static str {
    format(bytes).name
}
