//! A server started for a bench, in a process of its own so that the two do not share threads.

use super::args::{BenchArgs, Storing};
use anyhow::Context as _;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// A directory that is removed when this value is dropped.
struct DataDir(PathBuf);

impl DataDir {
    fn new(parent: Option<&Path>) -> anyhow::Result<Self> {
        let parent = parent.map_or_else(std::env::temp_dir, Path::to_owned);
        let dir = parent.join(format!("sinew-bench-{}", std::process::id()));
        // An existing directory does not belong to this bench, and stays.
        std::fs::create_dir(&dir).with_context(|| format!("making {}", dir.display()))?;
        Ok(Self(dir))
    }
}

impl Drop for DataDir {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A server that ends when this value is dropped.
pub(super) struct OwnServer {
    child: Child,
    address: String,
    /// Removed after the server has ended.
    _data: Option<DataDir>,
}

impl OwnServer {
    /// Starts this binary as a server with room for the load, storing as its settings say or in a given way.
    pub(super) fn start(args: &BenchArgs, storing: Option<Storing>) -> anyhow::Result<Self> {
        let worlds = u64::from(args.worlds);
        let viewers = worlds * u64::from(args.viewers);
        let room = [
            ("max_worlds", worlds),
            ("max_viewers", viewers.max(1)),
            ("max_drivers", worlds),
            ("max_figures_per_world", u64::from(args.figures).max(1)),
            ("max_client_share", 1),
            ("lame_duck_s", 0),
        ];
        let mut command = Command::new(std::env::current_exe()?);
        command
            .args(["serve", "--no-demo", "--no-viewer", "--log", "warn"])
            .args(["--listen", "127.0.0.1:0"])
            .stdin(Stdio::null())
            .stdout(Stdio::piped());
        for (name, value) in room {
            command.args(["--set", &format!("{name}={value}")]);
        }
        for setting in &args.own.set {
            command.args(["--set", setting]);
        }
        let mut data = None;
        if let Some(storing) = storing.filter(|s| *s != Storing::Off) {
            let dir = data.insert(DataDir::new(args.own.data_dir.as_deref())?);
            command.args(["--set", &format!("durability={}", storing.name())]);
            command.arg("--data-dir").arg(&dir.0);
        }
        // From here on any error ends the server and then removes its directory.
        let mut own = Self {
            child: command.spawn().context("the server cannot be started")?,
            address: String::new(),
            _data: data,
        };
        let mut first = String::new();
        let out = own.child.stdout.take();
        let out = out.context("the server has no output")?;
        BufReader::new(out).read_line(&mut first)?;
        let address = first
            .split("http://")
            .nth(1)
            .and_then(|rest| rest.split_whitespace().next());
        own.address = address
            .context("the server did not start: its messages are above")?
            .to_owned();
        Ok(own)
    }

    /// The address at which it listens.
    pub(super) fn address(&self) -> &str {
        &self.address
    }

    /// Bytes that the server has written to disk, as Linux counts them: whole pages.
    pub(super) fn disk_bytes(&self) -> Option<f64> {
        let counts = std::fs::read_to_string(format!("/proc/{}/io", self.child.id())).ok()?;
        let line = counts.lines().find_map(|l| l.strip_prefix("write_bytes: "));
        line?.parse().ok()
    }
}

impl Drop for OwnServer {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
