//! The CSV file of `--out`.

use anyhow::{Context, Result};
use sinew_physics::motion::table::{Torques, header, row};
use sinew_physics::world::Figure;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// Posture, torques and limits of every tick, written during the run.
pub(super) struct RunCsv {
    path: PathBuf,
    file: BufWriter<File>,
    line: String,
}

impl RunCsv {
    pub(super) fn create(path: &Path) -> Result<Self> {
        let file =
            File::create(path).with_context(|| format!("cannot write {}", path.display()))?;
        let mut out = Self {
            path: path.to_owned(),
            file: BufWriter::new(file),
            line: header(true),
        };
        out.flush_line()?;
        Ok(out)
    }

    pub(super) fn row(&mut self, time: f64, figure: &Figure) -> Result<()> {
        let report = figure.report().expect("a stepped figure has a report");
        let torques = Torques {
            torque: &report.joints.torque,
            lower: &report.joints.torque_lower,
            upper: &report.joints.torque_upper,
        };
        row(&mut self.line, time, &figure.state().posture, Some(torques));
        self.flush_line()
    }

    fn flush_line(&mut self) -> Result<()> {
        let done = self.file.write_all(self.line.as_bytes());
        self.line.clear();
        done.with_context(|| format!("cannot write {}", self.path.display()))
    }

    pub(super) fn finish(mut self) -> Result<()> {
        self.file
            .flush()
            .with_context(|| format!("cannot write {}", self.path.display()))
    }
}
