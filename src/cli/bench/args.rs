//! Arguments of `sinew bench`.

use crate::args::CredentialArgs;
use clap::ValueEnum as _;
use serde::Serialize;
use std::path::PathBuf;
use std::time::Duration;

/// Time after the end in which viewers can still receive the last frames.
pub(super) const TAIL: Duration = Duration::from_secs(1);

/// Arguments of `sinew bench`.
#[derive(Clone, Debug, clap::Args)]
pub struct BenchArgs {
    /// Server, host:port [default: one that is started for this, in a process of its own]
    pub(super) address: Option<String>,
    /// Worlds
    #[arg(long, default_value_t = 120, value_parser = clap::value_parser!(u32).range(1..=100_000), value_name = "N")]
    pub(super) worlds: u32,
    /// Figures in each, driven live; 0: empty worlds
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(0..=1000), value_name = "M")]
    pub(super) figures: u32,
    /// Viewers of each
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(0..=1000), value_name = "V")]
    pub(super) viewers: u32,
    #[command(flatten)]
    pub(super) traffic: Traffic,
    /// Time that is measured, s
    #[arg(long, default_value_t = 30.0, value_parser = between(1.0, 86_400.0), value_name = "S")]
    pub(super) seconds: f64,
    /// Time before that, s
    #[arg(long, default_value_t = 5.0, value_parser = between(0.0, 3600.0), value_name = "S")]
    pub(super) warm_up: f64,
    /// Print JSON
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) own: OwnArgs,
    #[command(flatten)]
    pub(super) credentials: CredentialArgs,
}

/// The traffic to each server.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct Traffic {
    /// Frames of desired motion per second and driver
    #[arg(long, default_value_t = 60.0, value_parser = between(1.0, 1000.0), value_name = "HZ")]
    pub(super) rate: f64,
    /// Playout delay of the drivers, ms: it is part of what is measured
    #[arg(long, default_value_t = 0.0, value_parser = between(0.0, 2000.0), value_name = "MS")]
    pub(super) playout: f64,
    /// Reads of the latest frame per second, of all worlds in turn; 0: none
    #[arg(long, default_value_t = 50.0, value_parser = between(0.0, 100_000.0), value_name = "N")]
    pub(super) calls: f64,
    /// Calls per second that change a figure (ClearPerturbations), of all worlds in turn; 0: none
    #[arg(long, default_value_t = 0.0, value_parser = between(0.0, 100_000.0), value_name = "N")]
    pub(super) changes: f64,
}

/// Parses a number within limits.
fn between(least: f64, most: f64) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| {
        let value = text
            .parse::<f64>()
            .ok()
            .filter(|v| (least..=most).contains(v));
        value.ok_or_else(|| format!("expected a number in {least}…{most}"))
    }
}

/// Arguments of a server that is started for the bench.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct OwnArgs {
    /// A setting of the server that is started (repeatable)
    #[arg(long = "set", value_name = "NAME=VALUE", conflicts_with = "address")]
    pub set: Vec<String>,
    /// Bench servers that store in these ways, one after the other, and print what each costs
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        value_name = "HOW,…",
        conflicts_with = "address"
    )]
    pub durability: Vec<Storing>,
    /// Times that each of them is benched; medians are printed
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=100), requires = "durability")]
    pub rounds: u32,
    /// Where their data directories are made; they are removed again [default: for temporary files]
    #[arg(long, value_name = "DIR", requires = "durability")]
    pub data_dir: Option<PathBuf>,
}

impl OwnArgs {
    /// Whether several servers are compared.
    pub(super) fn compares(&self) -> bool {
        !self.durability.is_empty()
    }
}

/// How a server stores its worlds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, clap::ValueEnum)]
#[serde(rename_all = "snake_case")]
pub(super) enum Storing {
    /// It has no data directory
    Off,
    /// States at orderly ends
    None,
    /// All inputs of 10 ms together
    Group,
    /// Each input at once
    Each,
}

impl Storing {
    /// The name used by the arguments and the settings.
    pub(super) fn name(self) -> String {
        let value = self.to_possible_value().expect("no value is hidden");
        value.get_name().to_owned()
    }
}
