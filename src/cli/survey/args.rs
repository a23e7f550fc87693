//! Arguments of `sinew survey`.

use super::page::PageSpec;
use super::push::SurveyPush;
use super::pushes_spec::PushesSpec;
use crate::args::{BodyArgs, FollowArg, HelpArgs, LoadSpec};
use sinew_physics::rehearsal::follow::Follow;
use sinew_physics::world::WorldParams;
use std::path::PathBuf;
use std::str::FromStr;

/// Runs every clip of a corpus and says how well it was followed, by kind of motion, with a forecast of each before
/// it is run.
///
/// Exit code 0: the survey is written; clips that cannot be read are rows with their error. 1: it could not be made,
/// or `--compare` found regressions beyond noise. 2: bad arguments, or a motion that is not there. docs/survey.md
/// defines every column.
#[derive(Clone, Debug, clap::Args)]
pub struct SurveyArgs {
    /// Motions: BVH files, folders (all *.bvh in them) or builtin:NAME.
    #[arg(required = true, value_name = "CORPUS")]
    pub corpus: Vec<String>,
    /// Writes the survey as JSON. An interrupted run is continued from FILE.json.partial.
    #[arg(long, value_name = "FILE.json")]
    pub out: PathBuf,
    /// Also runs this many noisy copies of every recording.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub copies: u32,
    /// Noise of the copies, evenly distributed up to: positions, then angles.
    #[arg(
        long,
        value_name = "MM,DEG",
        default_value = "1mm,0.2deg",
        allow_hyphen_values = true
    )]
    pub noise: NoiseSpec,
    /// Compares with an earlier survey of the same clips under the same settings.
    #[arg(long, value_name = "OLD.json")]
    pub compare: Option<PathBuf>,
    /// Settings that may differ from those of the earlier survey, besides build and gravity_mps2 (repeatable).
    #[arg(long, value_name = "SETTING", requires = "compare")]
    pub across: Vec<String>,
    /// Body of the figure.
    #[command(flatten)]
    pub body: BodyArgs,
    /// Factor on the strength of every joint, 0.01 to 100.
    #[arg(long, value_name = "F", default_value_t = 1.0)]
    pub strength: f64,
    /// Percentile of strength among people of that sex, age and size, 5 to 95.
    #[arg(long, value_name = "P", default_value_t = 50.0)]
    pub percentile: f64,
    /// Help towards the desired pose of the pelvis, 0 to 1; reported, not physical.
    #[arg(long, value_name = "A", default_value_t = 0.0)]
    pub assist: f64,
    /// Load held by one or two segments, for example 3@r_hand or 8@l_hand+r_hand (repeatable).
    #[arg(
        long,
        value_name = "KG@SEGMENT[+SEGMENT][@T0..T1]",
        allow_hyphen_values = true
    )]
    pub load: Vec<LoadSpec>,
    /// Push on a segment: 20@chest@1.5:1,0,0 (N·s, start in s from the beginning of the run, world direction), or
    /// 10@random, 10@pelvis@random at a time and in a level direction that follow from the clip and the copy
    /// (repeatable).
    #[arg(
        long,
        value_name = "NS@SEGMENT@T:x,y,z|NS@random",
        allow_hyphen_values = true
    )]
    pub push: Vec<SurveyPush>,
    /// How long a push lasts, s.
    #[arg(long, value_name = "S", default_value_t = 0.2)]
    pub push_duration: f64,
    /// Instead of the survey, pushes the chest while figures start, walk or stand, at 8 moments in 4 or 8 directions,
    /// and counts how often they stay up: start:20,30, walk:40, stand:50 (repeatable).
    #[arg(
        long,
        value_name = "PHASE:NS,NS…",
        conflicts_with_all = [
            "push", "live_window", "rehearse", "compare", "copies", "load", "page", "summary",
        ],
    )]
    pub pushes: Vec<PushesSpec>,
    /// Streams each recording through a preparation window of 0.3 to 1 s instead of preparing it as a whole.
    #[arg(long, value_name = "S")]
    pub live_window: Option<f64>,
    /// Treatment of a clip that plain tracking loses: none (strict), a rehearsal, help (assisted), or help to the end
    /// whatever that takes (always).
    #[arg(long, value_enum, default_value_t = FollowArg::Strict, conflicts_with = "assist")]
    pub follow: FollowArg,
    /// Rehearse what plain tracking loses for less help, instead of helping it while it is being lost. Noise is then on
    /// the state in which a rehearsed clip begins.
    #[arg(long, conflicts_with = "live_window")]
    pub rehearse: bool,
    /// Help and random numbers of rehearsals.
    #[command(flatten)]
    pub help: HelpArgs,
    /// Leave runs as they were recorded. Otherwise, without help, they are walked, slower and with shorter steps.
    #[arg(long)]
    pub keep_runs: bool,
    /// Gravity of the world, m/s², 0 to 30; motions are prepared for 9.81 whatever it is.
    #[arg(long, value_name = "G", default_value_t = WorldParams::default().gravity)]
    pub gravity: f64,
    /// Ticks per second, 30 to 240.
    #[arg(long, value_name = "HZ", default_value_t = 60.0)]
    pub rate: f64,
    /// Runs at the same time; the result does not depend on it. Default: one for each core.
    #[arg(long, value_name = "N")]
    pub jobs: Option<usize>,
    /// Writes FOLDER/README.md about all surveys (*.json) in FOLDER.
    #[arg(long, value_name = "FOLDER")]
    pub summary: Option<PathBuf>,
    /// Puts the table by kind of motion, what came of the forecasts, and the command that makes them between the marks
    /// of a section in a file: `<!-- survey SECTION begin: … -->` and `<!-- survey SECTION end -->`.
    #[arg(long, value_name = "FILE#SECTION")]
    pub page: Option<PageSpec>,
}

impl SurveyArgs {
    /// Threads that run clips.
    pub fn threads(&self) -> usize {
        let cores = || std::thread::available_parallelism().ok().map(usize::from);
        self.jobs.or_else(cores).unwrap_or(1)
    }

    /// Whether runs are followed as they were recorded: with help they can be.
    pub fn keeps_runs(&self) -> bool {
        let helped = Follow::from(self.follow).takes_help() && !self.rehearse;
        self.keep_runs || helped && self.live_window.is_none()
    }

    /// Whether clips that plain tracking loses are rehearsed. Streams are not.
    pub fn rehearses(&self) -> bool {
        let follow = Follow::from(self.follow);
        let wanted = follow == Follow::Rehearsed || (self.rehearse && follow.takes_help());
        wanted && self.live_window.is_none()
    }
}

/// `1mm,0.2deg`: largest error of positions and of angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseSpec {
    /// m.
    pub metres: f64,
    /// Degrees.
    pub degrees: f64,
}

impl FromStr for NoiseSpec {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = || format!("{text:?} is not of the form MMmm,DEGdeg, for example 1mm,0.2deg");
        let (mm, deg) = text.split_once(',').ok_or_else(form)?;
        let number = |text: &str, unit: &str, most: f64| {
            let n: f64 = text
                .trim()
                .strip_suffix(unit)
                .ok_or_else(form)?
                .trim()
                .parse()
                .map_err(|_| form())?;
            if (0.0..=most).contains(&n) {
                Ok(n)
            } else {
                Err(format!("noise {n} {unit}: outside 0…{most}"))
            }
        };
        Ok(Self {
            metres: 1e-3 * number(mm, "mm", 100.0)?,
            degrees: number(deg, "deg", 30.0)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_read_with_its_units() {
        let n: NoiseSpec = "1.5mm, 0.2deg".parse().expect("noise");
        assert!((n.metres - 0.0015).abs() < 1e-12 && n.degrees == 0.2);
        for bad in [
            "1,0.2",
            "1mm",
            "1mm,0.2",
            "xmm,1deg",
            "-1mm,1deg",
            "nanmm,1deg",
            "1mm,90deg",
        ] {
            assert!(bad.parse::<NoiseSpec>().is_err(), "{bad}");
        }
    }
}
