//! Common parts of the formats of `--load`, `--push`, `--constrain`, `--obstacle` and `--then`.

use sinew_physics::body::SegmentId;
use sinew_physics::body::topology::SEGMENT_NAMES;

/// Why a `--load`, `--push`, `--constrain`, `--obstacle` or `--then` cannot be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SpecError {
    /// Wrong form.
    #[error("{got:?} is not of the form {form}")]
    Form {
        /// The given text.
        got: String,
        /// The expected form.
        form: &'static str,
    },
    /// Not a number.
    #[error("{what}: {got:?} is not a number")]
    Number {
        /// The part concerned.
        what: &'static str,
        /// The given text.
        got: String,
    },
    /// Out of range.
    #[error("{what}: {value} is outside {lower}…{upper}")]
    Range {
        /// The part concerned, with unit.
        what: &'static str,
        /// The given value.
        value: f64,
        /// Least.
        lower: f64,
        /// Largest.
        upper: f64,
    },
    /// Unknown segment.
    #[error("there is no segment {0:?}; the segments are {names}", names = SEGMENT_NAMES.join(", "))]
    Segment(String),
    /// An interval that ends before it starts.
    #[error("the interval {from}..{to} s is empty")]
    Interval {
        /// Begin, s.
        from: f64,
        /// End, s.
        to: f64,
    },
    /// A push or a plane without direction.
    #[error("0,0,0 has no direction")]
    Direction,
}

/// A number within `lower..=upper`; `what` names it, with its unit.
pub(super) fn number(
    what: &'static str,
    text: &str,
    lower: f64,
    upper: f64,
) -> Result<f64, SpecError> {
    let value: f64 = text.trim().parse().map_err(|_| SpecError::Number {
        what,
        got: text.to_owned(),
    })?;
    if (lower..=upper).contains(&value) {
        Ok(value)
    } else {
        Err(SpecError::Range {
            what,
            value,
            lower,
            upper,
        })
    }
}

/// A segment by its name.
pub(super) fn segment(text: &str) -> Result<SegmentId, SpecError> {
    SegmentId::from_name(text.trim()).ok_or_else(|| SpecError::Segment(text.to_owned()))
}

/// Largest time an argument may name, s.
pub(super) const MAX_TIME: f64 = 1e6;

/// `T0..T1` in seconds; either end may be left out.
pub(super) fn interval(times: &str, form: impl Fn() -> SpecError) -> Result<(f64, f64), SpecError> {
    let (mut from_s, mut to_s) = (0.0, f64::INFINITY);
    let (a, b) = times.split_once("..").ok_or_else(form)?;
    if !a.trim().is_empty() {
        from_s = number("start (s)", a, 0.0, MAX_TIME)?;
    }
    if !b.trim().is_empty() {
        to_s = number("end (s)", b, 0.0, MAX_TIME)?;
    }
    if to_s <= from_s {
        return Err(SpecError::Interval {
            from: from_s,
            to: to_s,
        });
    }
    Ok((from_s, to_s))
}

/// Comma-separated numbers, each within ±`most`.
pub(super) fn numbers(what: &'static str, text: &str, most: f64) -> Result<Vec<f64>, SpecError> {
    text.split(',')
        .map(|t| number(what, t, -most, most))
        .collect()
}
