//! A page of results in Markdown, with its tables, plots and strips.

use super::number::counted;
use super::output::write;
use super::terminal::print_line;
use anyhow::{Context, Result};
use indicatif::{ProgressBar, ProgressStyle};
use sinew_evaluate::experiments::ExperimentRecord;
use sinew_evaluate::plot::Plot;
use sinew_evaluate::strip::{StripOptions, View, draw, raster};
use sinew_physics::body::Body;
use std::path::{Path, PathBuf};

/// Scale of strips, pixels per metre.
const SCALE: f64 = 82.0;

/// A bar for `steps` experiments of the command `name`.
pub fn progress(name: &'static str, steps: u64) -> ProgressBar {
    let bar = ProgressBar::new(steps).with_style(
        ProgressStyle::with_template("{prefix:>14} {wide_bar:.cyan/dim} {pos}/{len} {msg}")
            .expect("the template is a constant")
            .progress_chars("━╸─"),
    );
    bar.set_prefix(name);
    bar
}

/// The page as it grows, and the folder of its pictures.
pub struct Page {
    folder: PathBuf,
    text: String,
}

impl Page {
    /// An empty page in `folder`, which is created if necessary.
    ///
    /// # Errors
    /// A folder that cannot be created.
    pub fn new(folder: &Path) -> Result<Self> {
        std::fs::create_dir_all(folder)
            .with_context(|| format!("cannot create {}", folder.display()))?;
        Ok(Self {
            folder: folder.to_owned(),
            text: String::new(),
        })
    }

    /// Writes the page as `README.md`; prints its path, and number and size of the files in the folder.
    ///
    /// # Errors
    /// A file that cannot be written, a folder that cannot be read.
    pub fn finish(self) -> Result<()> {
        self.finish_as("README.md")
    }

    /// Writes the page under `name`; prints its path, and number and size of the files in the folder.
    ///
    /// # Errors
    /// A file that cannot be written, a folder that cannot be read.
    pub fn finish_as(self, name: &str) -> Result<()> {
        let path = self.folder.join(name);
        write(&path, self.text.trim_end().to_owned() + "\n")?;
        let size = size(&self.folder)?;
        print_line(&format!("wrote {} ({size} in the folder)", path.display()))
    }

    /// One line.
    pub fn line(&mut self, text: &str) {
        self.text.push_str(text);
        self.text.push('\n');
    }

    /// A paragraph.
    pub fn say(&mut self, text: &str) {
        self.line(text);
        self.line("");
    }

    /// A table in Markdown.
    pub fn table(&mut self, head: &[&str], rows: &[Vec<String>]) {
        self.line(&format!("| {} |", head.join(" | ")));
        self.line(&format!("|{}", "---|".repeat(head.len())));
        for row in rows {
            self.line(&format!("| {} |", row.join(" | ")));
        }
        self.line("");
    }

    /// A drawing with its alternative text, as `name.svg`.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn svg(&mut self, name: &str, title: &str, svg: String) -> Result<()> {
        write(&self.folder.join(format!("{name}.svg")), svg)?;
        self.say(&format!("![{title}]({name}.svg)"));
        Ok(())
    }

    /// A plot, as `name.svg`.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn plot(&mut self, name: &str, plot: &Plot) -> Result<()> {
        self.svg(name, &plot.title, plot.svg())
    }

    /// A strip of figures, as `name.png`.
    ///
    /// # Errors
    /// A strip that cannot be drawn or written.
    pub fn strip(
        &mut self,
        name: &str,
        body: &Body,
        run: &ExperimentRecord,
        view: View,
        title: &str,
    ) -> Result<()> {
        let options = StripOptions {
            view,
            scale: SCALE,
            title: title.to_owned(),
        };
        let png = raster::png(&draw(body, &run.frames, &options))
            .with_context(|| format!("cannot draw {name}.png"))?;
        write(&self.folder.join(format!("{name}.png")), png)?;
        self.say(&format!("![{title}]({name}.png)"));
        Ok(())
    }

    /// Adds strips seen from the side: file name, description, title.
    pub fn strips(
        &mut self,
        body: &Body,
        strips: &[(String, ExperimentRecord, String)],
    ) -> Result<()> {
        for (name, run, title) in strips {
            self.strip(name, body, run, View::Side, title)?;
        }
        Ok(())
    }
}

/// Number and total size of the files in the folder.
fn size(folder: &Path) -> Result<String> {
    let mut bytes = 0;
    let mut files = 0u64;
    for entry in std::fs::read_dir(folder).context("the folder cannot be listed")? {
        bytes += entry?.metadata()?.len();
        files += 1;
    }
    Ok(format!("{}, {} kB", counted(files, "file"), bytes / 1000))
}
