//! A server of its own for a bench: another process, so that both do not share threads.

use super::Args;
use anyhow::Context as _;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};

/// A server that ends with this.
pub(super) struct OwnServer {
    child: Child,
    address: String,
}

impl OwnServer {
    /// Starts this binary as a server with room for the load.
    pub(super) fn start(args: &Args) -> anyhow::Result<Self> {
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
        for setting in &args.set {
            command.args(["--set", setting]);
        }
        let mut child = command.spawn().context("the server cannot be started")?;
        let mut first = String::new();
        let out = child.stdout.take().context("the server has no output")?;
        BufReader::new(out).read_line(&mut first)?;
        let address = first
            .split("http://")
            .nth(1)
            .and_then(|rest| rest.split_whitespace().next())
            .map(str::to_owned);
        match address {
            Some(address) => Ok(Self { child, address }),
            None => {
                let _ = child.kill();
                let _ = child.wait();
                anyhow::bail!("the server did not start: its messages are above")
            }
        }
    }

    /// Where it listens.
    pub(super) fn address(&self) -> &str {
        &self.address
    }
}

impl Drop for OwnServer {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
