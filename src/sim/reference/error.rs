//! Why a recording cannot be fitted to a body.

use crate::motion::clip::ClipError;
use crate::motion::recording::RecordingError;

/// Why a recording cannot be fitted to a body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RetargetError {
    /// The file is no recording of a human figure, or has no motion.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// The caller gave it up.
    #[error("given up")]
    Stopped,
    /// The rate is no capture rate.
    #[error(
        "rate {rate_hz} Hz is outside {lower}…{upper} Hz; give rate_hz if the file's frame time is wrong"
    )]
    Rate {
        /// Offending value.
        rate_hz: f64,
        /// Least accepted.
        lower: f64,
        /// Largest accepted.
        upper: f64,
    },
    /// No usual unit gives a human stature.
    #[error(
        "the figure measures {measured:.4} file units from sole to crown, which no usual unit makes 1.3 to 2.0 m; give \
         unit_m"
    )]
    Unit {
        /// Stature in file units.
        measured: f64,
    },
    /// The given unit gives no human stature.
    #[error(
        "with unit_m = {unit_m} the figure measures {stature:.3} m ({measured:.4} file units); people measure 0.7 to \
         2.6 m"
    )]
    Stature {
        /// Unit as given.
        unit_m: f64,
        /// Resulting stature, m.
        stature: f64,
        /// Stature in file units.
        measured: f64,
    },
    /// A bone has no length.
    #[error("bone {bone} has no length")]
    Degenerate {
        /// Name of the upper bone.
        bone: String,
    },
    /// An option is out of range.
    #[error("{field} {value} is outside {lower}…{upper}")]
    Option {
        /// Option name.
        field: &'static str,
        /// Offending value.
        value: f64,
        /// Least accepted.
        lower: f64,
        /// Largest accepted.
        upper: f64,
    },
    /// The postures do not make a clip.
    #[error(transparent)]
    Clip(#[from] ClipError),
}

impl RetargetError {
    /// [`RetargetError::Stopped`] once `stop` returns true.
    pub(crate) fn unless(stop: &dyn Fn() -> bool) -> Result<(), Self> {
        match stop() {
            true => Err(Self::Stopped),
            false => Ok(()),
        }
    }
}
