//! `sinew strength`: the strength that recordings need, as a file for `sinew run --strength-file` and the API.

use super::args::{BodyArgs, FileArgs, LoadSpec, StrengthFile};
use super::exit::within;
use super::output::{check_folder, write};
use super::source::{load, warn};
use super::terminal::print;
use anyhow::{Context, Result};
use sinew_evaluate::envelope::{Envelope, Speed};
use sinew_physics::body::Links;
use sinew_physics::body::topology::DOF_NAMES;
use sinew_physics::motion::Clip;
use sinew_physics::reference::{Preparation, RetargetOptions};
use sinew_physics::strength::Strength;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Estimates the strength that motions need, by inverse dynamics with the forces of the floor, and merges it with that
/// of the body: muscles that gave more than their curves say are scaled up, none down.
#[derive(Clone, Debug, clap::Args)]
pub struct StrengthArgs {
    /// Motions that the person did: BVH files or builtin:NAME.
    #[arg(required = true, value_name = "CLIP")]
    pub clips: Vec<String>,
    /// Body of the person.
    #[command(flatten)]
    pub body: BodyArgs,
    /// Unit and axes of the files.
    #[command(flatten)]
    pub file: FileArgs,
    /// Load held throughout; for example 3@r_hand or 8@l_hand+r_hand (repeatable).
    #[arg(long, value_name = "KG@SEGMENT[+SEGMENT]", allow_hyphen_values = true)]
    pub load: Vec<LoadSpec>,
    /// Percentile of strength whose curves are scaled, 5 to 95.
    #[arg(long, value_name = "P", default_value_t = 50.0)]
    pub percentile: f64,
    /// Quantile of the needed torque over all samples that counts, 0.5 to 1: recordings are noisy, so not the peak.
    /// Torques are means over 0.1 s, of motion that is low-passed at 6 Hz.
    #[arg(long, value_name = "Q", default_value_t = 0.98)]
    pub quantile: f64,
    /// How much more than needed a muscle gets, 1 to 2: feedback takes some.
    #[arg(long, value_name = "F", default_value_t = 1.1)]
    pub margin: f64,
    /// Keep recorded runs, instead of turning them into walks.
    #[arg(long)]
    pub keep_runs: bool,
    /// Writes the strength file: `sinew.v1.StrengthScale` as JSON.
    #[arg(long, value_name = "FILE.json")]
    pub out: Option<PathBuf>,
    /// Writes the torque-angle-velocity envelope behind it as JSON.
    #[arg(long, value_name = "FILE.json")]
    pub envelope: Option<PathBuf>,
}

/// Runs the command.
///
/// # Errors
/// Bad arguments, unreadable clips, files that cannot be written.
pub fn run(args: &StrengthArgs) -> Result<()> {
    for (name, value, range) in [
        ("--percentile", args.percentile, [5.0, 95.0]),
        ("--quantile", args.quantile, [0.5, 1.0]),
        ("--margin", args.margin, [1.0, 2.0]),
    ] {
        within(name, value, range)?;
    }
    check_folder("--out", args.out.as_deref())?;
    check_folder("--envelope", args.envelope.as_deref())?;
    let body = args.body.build()?;
    let options = args.file.apply(RetargetOptions {
        preparation: Preparation::walking(!args.keep_runs),
        ..RetargetOptions::default()
    });
    let sources = (args.clips.iter())
        .map(|spec| load(spec, &body, &options))
        .collect::<Result<Vec<_>>>()?;
    sources.iter().for_each(warn);
    let mut links = Links::new(&body);
    for held in &args.load {
        let shares = held.perturbation(&body, f64::INFINITY).load();
        for (segment, point, mass) in shares.iter().flat_map(|l| l.shares()) {
            links.add_load(segment, point, mass);
        }
    }
    let strength = Strength::at_percentile(&body, args.percentile);
    let clips: Vec<&Clip> = sources.iter().map(|s| &s.clip).collect();
    let envelope = Envelope::of(&body, &links, &strength, &clips, args.quantile);
    let file = StrengthFile::from(&envelope.merged(args.percentile, args.margin));
    let text = serde_json::to_string_pretty(&file).context("the strength is no JSON")? + "\n";
    if let Some(path) = &args.envelope {
        let cells =
            serde_json::to_string_pretty(&envelope.cells).context("the envelope is no JSON")?;
        write(path, cells + "\n")?;
    }
    match &args.out {
        Some(path) => {
            write(path, text)?;
            print(&table(&envelope, &file))
        }
        None => print(&text),
    }
}

/// The directions that need most, and their values in the file.
fn table(envelope: &Envelope, file: &StrengthFile) -> String {
    let mut all: Vec<(usize, usize)> = (0..DOF_NAMES.len())
        .flat_map(|d| [(d, 0), (d, 1)])
        .collect();
    all.sort_by(|a, b| envelope.ratio[b.0][b.1].total_cmp(&envelope.ratio[a.0][a.1]));
    let mut out = format!(
        "{:<24} {:>9} {:>8} {:>9} {:>6} {:>8}\n",
        "dof", "direction", "needed", "torque", "angle", "factor"
    );
    for (d, side) in all.into_iter().take(12) {
        let name = DOF_NAMES[d];
        let mine = envelope.cells.iter();
        let mine = mine.filter(|c| c.dof == name && c.positive == (side == 0));
        let hardest =
            mine.max_by(|a, b| (a.torque / a.available).total_cmp(&(b.torque / b.available)));
        let (torque, angle, speed) = hardest.map_or((0.0, 0.0, Speed::Still), |c| {
            (c.torque, c.angle_deg, c.speed)
        });
        let mark = match speed {
            Speed::Lengthening => "-",
            Speed::Still => " ",
            Speed::Shortening => "+",
        };
        writeln!(
            out,
            "{name:<24} {:>9} {:>6.0} % {torque:>6.0} Nm {angle:>4.0}°{mark} {:>8.2}",
            if side == 0 { "positive" } else { "negative" },
            100.0 * envelope.ratio[d][side],
            file.factor(name),
        )
        .expect("a string takes any text");
    }
    out + "needed: torque over the strength of the profile; angle: + shortening, - lengthening\n"
}
