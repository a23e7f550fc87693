//! How a recording is read.

use crate::exit::within;
use clap::ValueEnum;
use sinew_physics::reference::{FileFacts, Preparation, RetargetOptions, TEMPI, UpAxis};

/// Which axis of the file points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum UpArg {
    /// The y axis.
    Y,
    /// The z axis.
    Z,
}

impl From<UpArg> for UpAxis {
    fn from(arg: UpArg) -> Self {
        match arg {
            UpArg::Y => Self::Y,
            UpArg::Z => Self::Z,
        }
    }
}

/// Unit and axes of a BVH file, which the file does not state.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub struct FileArgs {
    /// Length of one file unit, m (0.01 for centimetres); estimated from the stature unless given.
    #[arg(long, value_name = "M", value_parser = unit)]
    pub unit: Option<f64>,
    /// Axis of the file that points up; estimated from the skeleton unless given.
    #[arg(long, value_enum, value_name = "AXIS")]
    pub up: Option<UpArg>,
}

impl FileArgs {
    /// `options` with the given unit and axis.
    #[must_use]
    pub fn apply(&self, options: RetargetOptions) -> RetargetOptions {
        RetargetOptions {
            file: FileFacts {
                unit_m: self.unit,
                up: self.up.map(UpAxis::from),
                ..options.file
            },
            ..options
        }
    }
}

/// Least and largest length of a file unit, m.
const UNIT_RANGE: [f64; 2] = [1e-6, 1e6];

/// A length of a file unit, m.
fn unit(text: &str) -> Result<f64, String> {
    let value: f64 = text
        .trim()
        .parse()
        .map_err(|_| format!("{text:?} is not a number"))?;
    let [least, most] = UNIT_RANGE;
    if (least..=most).contains(&value) {
        Ok(value)
    } else {
        Err(format!("{value} m is outside {least}…{most}"))
    }
}

/// Facts that a BVH file does not state, or states wrongly, and the pace at which it is played.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct RecordingArgs {
    /// Unit and axes.
    #[command(flatten)]
    pub file: FileArgs,
    /// Frame rate of the file, Hz, where its frame time is wrong.
    #[arg(long, value_name = "HZ")]
    pub file_rate: Option<f64>,
    /// Turn recorded runs into walks: slower, with shorter steps.
    #[arg(long)]
    pub walk_runs: bool,
    /// Playback speed relative to the recording, 0.5 to 2; steps and balance are prepared for it.
    #[arg(long, value_name = "F", default_value_t = 1.0)]
    pub tempo: f64,
}

/// Checks a tempo. Retargeting checks it as well, but not for built-in motions, nor does its message name the flag.
///
/// # Errors
/// It is outside its range.
pub fn check_tempo(tempo: f64) -> anyhow::Result<()> {
    within("--tempo", tempo, [TEMPI.0, TEMPI.1])
}

impl RecordingArgs {
    /// The ordinary preparation of a file with these options.
    pub fn options(&self) -> RetargetOptions {
        self.file.apply(RetargetOptions {
            tempo: self.tempo,
            file: FileFacts {
                rate_hz: self.file_rate,
                ..FileFacts::default()
            },
            preparation: Preparation::walking(self.walk_runs),
            ..RetargetOptions::default()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_lengths() {
        assert_eq!(unit("0.01"), Ok(0.01));
        for bad in ["0", "-1", "nan", "inf", "1e7", "cm"] {
            assert!(unit(bad).is_err(), "{bad}");
        }
    }
}
