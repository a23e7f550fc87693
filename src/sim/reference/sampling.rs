//! Number of samples of a clip, and the memory that fitting takes.

use super::error::RetargetError;
use super::options::{RATES, RetargetOptions, check_options};
use crate::motion::clip::{ClipError, MAX_SAMPLES};
use crate::motion::read::read_head;
use crate::motion::recording::{MAX_POINTS, POINT_BYTES, Recording};

/// Bytes for each sample of a clip while it is being prepared.
pub const SAMPLE_BYTES: u64 = 4096;

/// Approximate upper bound of the bytes needed to read a file and fit it, known from the head of the file. `rate_hz`:
/// as [`FileFacts::rate_hz`](super::FileFacts::rate_hz).
pub fn memory(file: &[u8], rate_hz: Option<f64>) -> u64 {
    let Ok(head) = read_head(file) else {
        return 0; // the rest of the file is not read
    };
    let kept = head.kept_joints();
    let frames = head.frame_count as usize;
    let points = frames.saturating_mul(kept).min(MAX_POINTS) as u64;
    let source_rate = rate_hz.unwrap_or(head.rate_hz);
    let rate = output_rate(source_rate, &RetargetOptions::default());
    let samples = match kept {
        0 => 0,
        _ => sample_count(frames, source_rate, rate).min(MAX_SAMPLES) as u64,
    };
    // First the numbers of the file and the recording are held together, then the recording and the paths in the world.
    let recording = POINT_BYTES * points;
    recording + head.reading_bytes.max(recording) + SAMPLE_BYTES * samples
}

/// Samples per second of the clip at tempo 1.
pub(super) fn output_rate(source_rate: f64, options: &RetargetOptions) -> f64 {
    let kept = (59.0..=240.5).contains(&source_rate);
    let usual = if kept { source_rate } else { 120.0 };
    options.output_rate_hz.unwrap_or(usual)
}

/// Samples of a clip of `frames` frames.
pub(super) fn sample_count(frames: usize, source_rate: f64, rate: f64) -> usize {
    let last = (frames.max(1) - 1) as f64 * rate / source_rate;
    ((last + 1e-6).floor() as usize).saturating_add(1)
}

/// Refuses more samples than a clip may have, before any memory is taken for them.
pub(super) fn check_samples(count: usize) -> Result<(), ClipError> {
    match count > MAX_SAMPLES {
        true => Err(ClipError::TooLong { count }),
        false => Ok(()),
    }
}

/// Frames per second of a recording, if it and the options are within bounds.
pub(super) fn check(
    recording: &Recording,
    options: &RetargetOptions,
) -> Result<f64, RetargetError> {
    check_options(options)?;
    let facts = &recording.facts;
    let source_rate = options.file.rate_hz.unwrap_or(facts.rate_hz);
    if !(source_rate >= RATES.0 && source_rate <= RATES.1) {
        return Err(RetargetError::Rate {
            rate_hz: source_rate,
            lower: RATES.0,
            upper: RATES.1,
        });
    }
    let rate = output_rate(source_rate, options);
    check_samples(sample_count(facts.frame_count, source_rate, rate))?;
    Ok(source_rate)
}
