//! Facts that the caller knows about a recording, and how the recording should be treated.

use super::error::RetargetError;
use crate::motion::recording::UpAxis;

/// Least and largest [`RetargetOptions::tempo`].
pub const TEMPI: (f64, f64) = (0.5, 2.0);
/// Rates that are accepted as plausible, Hz.
pub(super) const RATES: (f64, f64) = (10.0, 1000.0);

/// Facts that the caller knows better than the file. `Default` guesses everything.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FileFacts {
    /// Metres per unit of the file; guessed from stature if absent.
    pub unit_m: Option<f64>,
    /// Up axis; guessed from the position of the head if absent.
    pub up: Option<UpAxis>,
    /// True frame rate of the file, Hz, where its frame time is wrong.
    pub rate_hz: Option<f64>,
}

/// Changes that make a body able to follow the motion on its feet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Preparation {
    /// Lock planted feet.
    pub lock_feet: bool,
    /// Shift the trunk so that the zero-moment point stays over the planted feet.
    pub balance: bool,
    /// Let the motion begin and end in a stand, with extra steps before its first and after its last frame if needed.
    pub ends: bool,
    /// Turn the runs of the recording into walking: slower and with shorter steps. The muscle strengths measured in
    /// people's joints are not enough to run.
    pub walk_runs: bool,
}

impl Preparation {
    /// The recording as it fits the body.
    pub const NONE: Self = Self {
        lock_feet: false,
        balance: false,
        ends: false,
        walk_runs: false,
    };

    /// Preparation for a rehearsal: planted feet do not slide, the motion begins and ends in a stand if possible, and
    /// nothing else is changed.
    pub const REHEARSED: Self = Self {
        lock_feet: true,
        balance: false,
        ends: true,
        walk_runs: false,
    };

    /// Full preparation; runs are walked if `walk_runs` is set.
    pub const fn walking(walk_runs: bool) -> Self {
        Self {
            lock_feet: true,
            balance: true,
            ends: true,
            walk_runs,
        }
    }
}

impl Default for Preparation {
    /// Full preparation; runs are kept.
    fn default() -> Self {
        Self::walking(false)
    }
}

/// Facts that the caller knows better than the file, and how to treat the motion. `Default` guesses everything and
/// prepares fully.
#[derive(Clone, Debug, PartialEq)]
pub struct RetargetOptions {
    /// Name of the clip.
    pub name: String,
    /// Facts that the file lacks or states wrongly.
    pub file: FileFacts,
    /// Rate of the clip at tempo 1, Hz; absent: the file's own rate if that is 60…240, else 120.
    pub output_rate_hz: Option<f64>,
    /// Body size over recorded size, for paths and heights; absent: ratio of leg lengths. Two people of one recording
    /// need the same value.
    pub scale: Option<f64>,
    /// Bring the recorded floor to z = 0 (level and height). Otherwise z = 0 of the file is the floor.
    pub floor: bool,
    /// Cut-off of the zero-phase low-pass, Hz.
    pub cutoff_hz: f64,
    /// Speed relative to the recording, [`TEMPI`]: feet and postures are those of the recording, steps and balance are
    /// prepared for this pace.
    pub tempo: f64,
    /// Keep the file's place and heading (x forward = the file's z where y is up). Otherwise the clip starts at the
    /// origin facing +x.
    pub keep_origin: bool,
    /// Preparation of the feet and the balance.
    pub preparation: Preparation,
}

impl Default for RetargetOptions {
    fn default() -> Self {
        Self {
            name: "clip".into(),
            file: FileFacts::default(),
            output_rate_hz: None,
            scale: None,
            floor: true,
            tempo: 1.0,
            cutoff_hz: 6.0,
            keep_origin: false,
            preparation: Preparation::default(),
        }
    }
}

/// Whether every option is within its bounds.
pub(super) fn check_options(o: &RetargetOptions) -> Result<(), RetargetError> {
    let check = |field, value: Option<f64>, lower: f64, upper: f64| match value {
        Some(value) if !(value >= lower && value <= upper) => Err(RetargetError::Option {
            field,
            value,
            lower,
            upper,
        }),
        _ => Ok(()),
    };
    check("unit_m", o.file.unit_m, 1e-6, 1e6)?;
    check("rate_hz", o.file.rate_hz, RATES.0, RATES.1)?;
    check("output_rate_hz", o.output_rate_hz, 30.0, 240.0)?;
    check("scale", o.scale, 0.05, 20.0)?;
    check("tempo", Some(o.tempo), TEMPI.0, TEMPI.1)?;
    check("cutoff_hz", Some(o.cutoff_hz), 0.5, 60.0)
}
