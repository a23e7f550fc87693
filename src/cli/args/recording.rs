//! How a recording is read.

use crate::sim::motion::retarget::RetargetOptions;

/// What a BVH file does not say, or says wrong.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct RecordingArgs {
    /// Metres per unit of the file; guessed from the figure's size unless given.
    #[arg(long, value_name = "M")]
    pub unit: Option<f64>,
    /// Frame rate of the file, Hz, where its frame time is wrong.
    #[arg(long, value_name = "HZ")]
    pub file_rate: Option<f64>,
    /// Walk what the recording runs: slower, with shorter steps.
    #[arg(long)]
    pub walk_runs: bool,
    /// Times as fast as recorded, 0.5 to 2: steps and balance are prepared for that pace.
    #[arg(long, value_name = "F", default_value_t = 1.0)]
    pub tempo: f64,
}

impl RecordingArgs {
    /// The ordinary preparation of a file that is read so.
    pub fn options(&self) -> RetargetOptions {
        RetargetOptions {
            unit_m: self.unit,
            rate_hz: self.file_rate,
            walk_runs: self.walk_runs,
            tempo: self.tempo,
            ..RetargetOptions::default()
        }
    }
}
